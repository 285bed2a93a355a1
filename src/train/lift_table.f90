!> Lift event from a table of cam angle and lift.
!>
!> A part of `lift.f90`. In: a table over an event or over a full turn. Out: a spline over the event. A table with a dwell at
!> zero is cut to its event, which starts and ends with zero lift, slope and curvature; a table of a full turn without dwell is
!> periodic.
module camroller_lift_table
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t, raise, add_context, kind_deck
   use camroller_number_text, only : fixed_text
   use camroller_spline, only : spline_t, new_clamped_spline, new_periodic_spline
   implicit none
   private

   public :: least_step, new_table_event

   !> Fewest rows of an event
   integer, parameter :: min_rows = 5
   !> Departure from a full turn that still counts as one [rad]
   real(wp), parameter :: turn_tolerance = 1.0e-6_wp
   !> Step between two rows, over the larger of the steps beside it, that counts as missing rows [-]
   real(wp), parameter :: gap_ratio = 3.5_wp

contains

   !> Make the spline of an event.
   !>
   !> Errors (deck): what `new_clamped_spline` refuses; more than a turn; negative lift; no lift; not starting or ending
   !> at zero lift; smoothing negative or too large; rows missing.
   subroutine new_table_event(table, angle, lift, smoothing, first, last, is_periodic, error)
      !> Lift over angle
      type(spline_t), intent(out) :: table
      !> Cam angle from full lift, increasing [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift [m]
      real(wp), intent(in) :: lift(:)
      !> Root mean square distance to the table [m]; zero interpolates
      real(wp), intent(in) :: smoothing
      !> Start of the event [rad]
      real(wp), intent(out) :: first
      !> End of the event [rad]
      real(wp), intent(out) :: last
      !> Whether the event fills the turn
      logical, intent(out) :: is_periodic
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      integer :: low, high

      first = 0.0_wp
      last = 0.0_wp
      is_periodic = .false.
      call check_lift_table(angle, lift, smoothing, error)
      if (allocated(error)) return
      call cut_rest(lift, low, high)
      if (high - low + 1 < min_rows) then
         call raise(error, kind_deck, "lift table has too few rows with lift")
         return
      end if
      call check_gaps(angle(low:high), error)
      if (allocated(error)) return
      first = angle(low)
      last = angle(high)
      is_periodic = last - first > two_pi - turn_tolerance
      if (is_periodic) then
         call new_periodic_spline(table, angle(low:high), lift(low:high), smoothing, error)
      else
         call check_ends(lift(low), lift(high), smoothing, error)
         if (allocated(error)) return
         call new_clamped_spline(table, angle(low:high), [0.0_wp, lift(low + 1:high - 1), 0.0_wp], &
            [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], smoothing, error)
      end if
      if (.not. allocated(error)) return
      error%kind = kind_deck
      call add_context(error, "lift table")
   end subroutine new_table_event

   !> Smallest step between two rows of an event. A few rows far closer than all others do not count: a quarter of the mean step at
   !> least.
   pure function least_step(angle, first, last) result(step)
      !> Cam angle, increasing; start and end of the event, two of the rows [rad]
      real(wp), intent(in) :: angle(:), first, last
      !> The step [rad]
      real(wp) :: step

      integer :: n

      n = size(angle)
      step = minval(angle(2:) - angle(:n - 1), mask=angle(:n - 1) >= first .and. angle(2:) <= last)
      step = max(step, 0.25_wp*(last - first)/count(angle > first .and. angle <= last))
   end function least_step

   !> Refuse a table that is no lift.
   subroutine check_lift_table(angle, lift, smoothing, error)
      !> Cam angle [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift [m]
      real(wp), intent(in) :: lift(:)
      !> Root mean square distance to the table [m]
      real(wp), intent(in) :: smoothing
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      integer :: n

      n = size(angle)
      if (size(lift) /= n) then
         call raise(error, kind_deck, "lift table needs as many lifts as angles")
      else if (n < min_rows) then
         call raise(error, kind_deck, "lift table has too few rows")
      else if (.not. (all(ieee_is_finite(angle)) .and. all(ieee_is_finite(lift)))) then
         call raise(error, kind_deck, "lift table has a number that is not finite")
      else if (.not. smoothing >= 0.0_wp) then
         call raise(error, kind_deck, "smoothing of the lift table must not be negative")
      else if (angle(n) - angle(1) > two_pi + turn_tolerance) then
         call raise(error, kind_deck, "lift table covers more than one turn of the cam")
      else if (any(lift < -smoothing)) then
         call raise(error, kind_deck, "lift table has a negative lift")
      end if
   end subroutine check_lift_table

   !> Refuse an event with rows missing inside: a step much larger than both steps beside it.
   subroutine check_gaps(angle, error)
      !> Cam angles of the event [rad]
      real(wp), intent(in) :: angle(:)
      !> Where rows are missing
      type(error_t), allocatable, intent(out) :: error

      integer :: i
      !> Steps from row to row [rad]
      real(wp) :: step(size(angle) - 1)

      step = angle(2:) - angle(:size(angle) - 1)
      do i = 2, size(step) - 1
         if (step(i) <= gap_ratio*max(step(i - 1), step(i + 1))) cycle
         call raise(error, kind_deck, "lift table has a gap from "//fixed_text(angle(i)/degree, 3)//" to "// &
            & fixed_text(angle(i + 1)/degree, 3)//" deg")
         return
      end do
   end subroutine check_gaps

   !> First and last row of the event: the last zero before it and the first zero after it, where there are any.
   pure subroutine cut_rest(lift, low, high)
      !> Lift [m]
      real(wp), intent(in) :: lift(:)
      !> First row
      integer, intent(out) :: low
      !> Last row
      integer, intent(out) :: high

      low = 1
      do while (low < size(lift))
         if (lift(low + 1) > 0.0_wp) exit
         low = low + 1
      end do
      if (lift(1) > 0.0_wp) low = 1
      high = size(lift)
      do while (high > low)
         if (lift(high - 1) > 0.0_wp) exit
         high = high - 1
      end do
      if (lift(size(lift)) > 0.0_wp) high = size(lift)
   end subroutine cut_rest

   !> Refuse an event that does not start and end at zero lift.
   subroutine check_ends(first_lift, last_lift, smoothing, error)
      !> Lift at the start [m]
      real(wp), intent(in) :: first_lift
      !> Lift at the end [m]
      real(wp), intent(in) :: last_lift
      !> Root mean square distance to the table [m]
      real(wp), intent(in) :: smoothing
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      if (abs(first_lift) > smoothing) then
         call raise(error, kind_deck, "lift table does not start at zero lift")
      else if (abs(last_lift) > smoothing) then
         call raise(error, kind_deck, "lift table does not end at zero lift")
      end if
   end subroutine check_ends

end module camroller_lift_table
