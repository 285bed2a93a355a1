!> Lift event from a table of cam angle and lift.
!>
!> A part of `lift.f90`. In: a table over an event or over a full turn. Out: a spline over the event. A table with a dwell at
!> zero, or at noise about zero, is cut to its event, which starts and ends with zero lift, slope and curvature; a table of a full
!> turn without dwell is periodic. The estimate of the noise takes sixth differences, in which a smooth lift cancels: uncorrelated
!> noise of standard deviation s has differences of s sqrt(924). Their median is taken, so that the ends of the event and single bad
!> rows do not count. Values that were rounded have the noise of rounding at least, which is a step of their grid over sqrt(12): the
!> median of differences that are whole steps can be smaller.
module camroller_lift_table
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t, raise, add_context, kind_deck
   use camroller_number_text, only : fixed_text
   use camroller_sorting, only : median
   use camroller_spline, only : spline_t, new_clamped_spline, new_periodic_spline
   implicit none
   private

   public :: new_table_event, fit_event, find_event, find_gap, estimate_noise, has_even_rows, least_step, median_deviate
   public :: noise_reach, no_noise

   !> Fewest rows of an event
   integer, parameter :: min_rows = 5
   !> Departure from a full turn that still counts as one [rad]
   real(wp), parameter :: turn_tolerance = 1.0e-6_wp
   !> Step between two rows, over the larger of the steps beside it, that counts as missing rows [-]
   real(wp), parameter :: gap_ratio = 3.5_wp
   !> Farthest that noise goes from the lift, over its root mean square; noise cut at zero seems smaller than it is by a third [-]
   real(wp), parameter :: noise_reach = 6.0_wp
   !> Longest way of the cam in which a lift within the noise may still be a ramp's [rad]
   real(wp), parameter :: longest_ramp = 10.0_wp*degree
   !> Rows of which the mean is taken
   integer, parameter :: few = 5
   !> Lift that is no noise of any table, over the largest lift [-]
   real(wp), parameter :: no_noise = 0.01_wp
   !> Fewest rows of which the noise is known
   integer, parameter :: fewest_noisy = 24
   !> Largest step over the smallest there; or how far at most a step is from the mean of those beside it, over itself, and one [-]
   real(wp), parameter :: most_uneven = 1.01_wp
   !> Order of the differences
   integer, parameter :: order = 6
   !> Sum of their squared coefficients; median of the size of a normal deviate [-]
   real(wp), parameter :: squares = 924.0_wp, median_deviate = 0.6745_wp
   !> Part of the largest lift below which a difference is rounding of the machine [-]
   real(wp), parameter :: machine_rounding = 1.0e-9_wp

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

      integer :: low, high, gap

      first = 0.0_wp
      last = 0.0_wp
      is_periodic = .false.
      call check_lift_table(angle, lift, smoothing, error)
      if (allocated(error)) return
      call find_event(angle, lift, smoothing, low, high)
      if (high - low + 1 < min_rows) then
         call raise(error, kind_deck, "lift table has too few rows with lift")
         return
      end if
      gap = low - 1 + find_gap(angle(low:high))
      if (gap >= low) then
         call raise(error, kind_deck, "lift table has a gap from "//fixed_text(angle(gap)/degree, 3)//" to "// &
            & fixed_text(angle(gap + 1)/degree, 3)//" deg from the nose")
         return
      end if
      if (.not. fills_turn(angle(low), angle(high))) call check_ends(lift, low, high, smoothing, error)
      if (allocated(error)) return
      call fit_event(table, angle(low:high), lift(low:high), smoothing, first, last, is_periodic, error)
   end subroutine new_table_event

   !> Make the spline of an event whose rows are all of the table, from zero to zero.
   !>
   !> Errors (deck): what `new_clamped_spline` and `new_periodic_spline` refuse.
   subroutine fit_event(table, angle, lift, smoothing, first, last, is_periodic, error)
      !> Lift over angle
      type(spline_t), intent(out) :: table
      !> Cam angle from full lift, increasing [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift, its ends taken for zero unless it fills the turn [m]
      real(wp), intent(in) :: lift(:)
      !> Root mean square distance to the table [m]; zero interpolates
      real(wp), intent(in) :: smoothing
      !> Start and end of the event [rad]
      real(wp), intent(out) :: first, last
      !> Whether the event fills the turn
      logical, intent(out) :: is_periodic
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      associate (n => size(angle))
         first = angle(1)
         last = angle(n)
         is_periodic = fills_turn(first, last)
         if (is_periodic) then
            call new_periodic_spline(table, angle, lift, smoothing, error)
         else
            call new_clamped_spline(table, angle, [0.0_wp, lift(2:n - 1), 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
               & smoothing, error)
         end if
      end associate
      if (.not. allocated(error)) return
      error%kind = kind_deck
      call add_context(error, "lift table")
   end subroutine fit_event

   !> Does an event last a full turn?
   elemental function fills_turn(first, last) result(verdict)
      !> Its start and end [rad]
      real(wp), intent(in) :: first, last
      !> Does it?
      logical :: verdict

      verdict = last - first > two_pi - turn_tolerance
   end function fills_turn

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
      else if (any(lift < -noise_reach*smoothing)) then
         call raise(error, kind_deck, "lift table has a negative lift")
      end if
   end subroutine check_lift_table

   !> Row of an event behind which rows are missing: a step much larger than both steps beside it.
   pure function find_gap(angle) result(row)
      !> Cam angles of the event [any]
      real(wp), intent(in) :: angle(:)
      !> The first such row; 0 where there is none
      integer :: row

      associate (step => angle(2:) - angle(:size(angle) - 1))
         associate (n => size(step))
            row = findloc(step(2:n - 1) > gap_ratio*max(step(:n - 2), step(3:)), .true., dim=1)
         end associate
      end associate
      if (row > 0) row = row + 1
   end function find_gap

   !> First and last row of the event: the last zero before it and the first zero after it, where there are any. With noise on the
   !> base circle, rows within it are zero.
   pure subroutine find_event(angle, lift, smoothing, low, high)
      !> Cam angle, increasing [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift, somewhere above zero [m]
      real(wp), intent(in) :: lift(:)
      !> Root mean square distance to the table [m]
      real(wp), intent(in) :: smoothing
      !> First and last row
      integer, intent(out) :: low, high

      ! Root mean square of what may be noise [m]
      real(wp) :: noise
      logical :: is_known

      call estimate_noise(angle, lift, noise, is_known)
      noise = max(noise, smoothing)
      low = start_of_event(angle, lift, noise)
      high = size(lift) + 1 - start_of_event(angle(size(lift):1:-1), lift(size(lift):1:-1), noise)
   end subroutine find_event

   !> Row at which the event starts: the last zero before it, where there is any. Where lifts above zero reach so far out that no
   !> ramp does, they are noise on the base circle; then it is the first row, from one that is beyond the noise on down, that is
   !> within it and has rows before it whose mean is: farther out, a smoothed curve would go below zero and press on the seat.
   pure function start_of_event(angle, lift, noise) result(row)
      !> Cam angle in the order of the search [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift in the order of the search [m]
      real(wp), intent(in) :: lift(:)
      !> Root mean square of the noise [m]
      real(wp), intent(in) :: noise
      !> The row
      integer :: row

      integer :: outermost

      outermost = max(1, findloc(lift > 0.0_wp, .true., dim=1) - 1)
      row = max(1, findloc(lift > min(noise_reach*noise, no_noise*maxval(lift)), .true., dim=1))
      do while (row > outermost)
         associate (before => lift(max(1, row - few):row - 1))
            if (lift(row) <= noise .and. sum(before) <= 0.5_wp*noise*size(before)) exit
         end associate
         row = row - 1
      end do
      if (abs(angle(row) - angle(outermost)) <= longest_ramp) row = outermost
   end function start_of_event

   !> Refuse an event that does not start and end at zero lift, where the table has no rows beyond it.
   subroutine check_ends(lift, low, high, smoothing, error)
      !> Lift [m]
      real(wp), intent(in) :: lift(:)
      !> First and last row of the event
      integer, intent(in) :: low, high
      !> Root mean square distance to the table [m]
      real(wp), intent(in) :: smoothing
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      if (low == 1 .and. abs(lift(low)) > noise_reach*smoothing) then
         call raise(error, kind_deck, "lift table does not start at zero lift")
      else if (high == size(lift) .and. abs(lift(high)) > noise_reach*smoothing) then
         call raise(error, kind_deck, "lift table does not end at zero lift")
      end if
   end subroutine check_ends

   !> Estimate the noise of a table. Its first and last row do not count: they may have been set to zero.
   pure subroutine estimate_noise(angle, lift, noise, is_known)
      !> Cam angle, increasing [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift [m]
      real(wp), intent(in) :: lift(:)
      !> Its root mean square; 0 where it is not known [m]
      real(wp), intent(out) :: noise
      !> Is it known? Not for tables of few rows or of uneven steps
      logical, intent(out) :: is_known

      real(wp), allocatable :: differences(:) ! [m]
      integer :: i, n

      noise = 0.0_wp
      n = size(lift)
      is_known = has_even_rows(angle)
      if (.not. is_known) return
      differences = lift(2:n - 1)
      do i = 1, order
         differences = differences(2:) - differences(:size(differences) - 1)
      end do
      noise = max(median(abs(differences))/(median_deviate*sqrt(squares)), common_step(differences, &
         & machine_rounding*maxval(abs(lift)))/sqrt(12.0_wp))
   end subroutine estimate_noise

   !> Largest step of which some numbers are multiples, by Euclid's algorithm.
   pure function common_step(numbers, nothing) result(step)
      !> The numbers [any]
      real(wp), intent(in) :: numbers(:)
      !> What counts as zero, and so as large as the step of numbers without one [any]
      real(wp), intent(in) :: nothing
      !> The step [any]
      real(wp) :: step

      real(wp) :: rest, next ! [any]
      integer :: i

      step = 0.0_wp
      do i = 1, size(numbers)
         rest = abs(numbers(i))
         do while (rest > nothing)
            next = abs(step - rest*anint(step/rest))
            step = rest
            rest = next
         end do
      end do
   end function common_step

   !> Are there enough rows, at even steps, for differences to tell noise from lift? Steps may change slowly, as those of the polar
   !> angles of a contour at even cam angles do: the lift is a smooth function of the row's number then too.
   pure function has_even_rows(angle) result(verdict)
      !> Cam angle, increasing [any]
      real(wp), intent(in) :: angle(:)
      !> Are there?
      logical :: verdict

      verdict = size(angle) >= fewest_noisy
      if (.not. verdict) return
      associate (steps => angle(2:) - angle(:size(angle) - 1))
         verdict = maxval(steps) <= most_uneven*minval(steps) .or. all(abs(steps(2:size(steps) - 1) - 0.5_wp*(steps(3:) + &
            & steps(:size(steps) - 2))) <= (most_uneven - 1.0_wp)*steps(2:size(steps) - 1))
      end associate
   end function has_even_rows

end module camroller_lift_table
