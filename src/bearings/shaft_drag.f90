!> Torque that a camshaft takes beside cams and bearings: of its seals, and of the belt or chain that drives it.
!>
!> In: a table over speed and temperature, as it was measured; speed and temperature. Out: the torque. Formulas for it do not carry
!> from one seal or drive to another, so there is none here.
module camroller_shaft_drag
   use camroller_kinds, only : wp, celsius_zero, per_minute
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: shaft_drag_t, check_shaft_drag, find_shaft_drag

   !> Table of the torque on each camshaft
   type :: shaft_drag_t
      !> Speeds [rad/s] and temperatures [K], increasing; one alone: the torque does not depend on it
      real(wp), allocatable :: speed_points(:), temperature_points(:)
      !> Torques, those of all speeds at the first temperature first [N m]
      real(wp), allocatable :: torque_points(:)
   end type shaft_drag_t

contains

   !> Refuse a table that is none.
   subroutine check_shaft_drag(drag, error)
      !> The table
      type(shaft_drag_t), intent(in) :: drag
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (allocated(drag%speed_points) .and. allocated(drag%temperature_points) .and. allocated(drag%torque_points)) then
         if (size(drag%torque_points) > 0 .and. size(drag%torque_points) == size(drag%speed_points)*size(drag%temperature_points) &
            & .and. is_rising(drag%speed_points) .and. is_rising(drag%temperature_points) .and. &
            & all(drag%torque_points >= 0.0_wp)) return
      end if
      call raise(error, kind_deck, "the torque of seals and drive needs rising speeds and temperatures, and one torque, not "// &
         & "negative, for each speed at each temperature")
   end subroutine check_shaft_drag

   !> Do numbers rise?
   pure function is_rising(numbers) result(verdict)
      !> The numbers [any]
      real(wp), intent(in) :: numbers(:)
      !> Do they?
      logical :: verdict

      verdict = all(numbers(2:) > numbers(:size(numbers) - 1))
   end function is_rising

   !> The torque, linear in speed and in temperature between the points of the table.
   subroutine find_shaft_drag(drag, speed, temperature, torque, error)
      !> A table that has been checked
      type(shaft_drag_t), intent(in) :: drag
      !> Speed of the shaft [rad/s], temperature of the oil [K]
      real(wp), intent(in) :: speed, temperature
      !> The torque [N m]
      real(wp), intent(out) :: torque
      !> Domain error outside the table
      type(error_t), allocatable, intent(out) :: error

      ! Point before the place, and the next one with its weight [-]
      real(wp) :: along, across
      integer :: i, j, speeds, next_i, next_j

      torque = 0.0_wp
      speeds = size(drag%speed_points)
      call find_place(drag%speed_points, abs(speed), i, next_i, along)
      call find_place(drag%temperature_points, temperature, j, next_j, across)
      if (min(i, j) == 0) then
         call raise(error, kind_domain, "the torque of seals and drive is not known at "// &
            & number_text(abs(speed)*per_minute, 4)//" rev/min and "//number_text(temperature - celsius_zero, 4)// &
            & " degC: the table of &shaft_drag covers "//number_text(drag%speed_points(1)*per_minute, 4)//" to "// &
            & number_text(drag%speed_points(speeds)*per_minute, 4)//" rev/min and "// &
            & number_text(minval(drag%temperature_points) - celsius_zero, 4)//" to "// &
            & number_text(maxval(drag%temperature_points) - celsius_zero, 4)//" degC")
         return
      end if
      torque = (1.0_wp - across)*between(j) + across*between(next_j)

   contains

      !> Torque at a temperature of the table.
      pure function between(row)
         !> Number of the temperature
         integer, intent(in) :: row
         !> The torque [N m]
         real(wp) :: between

         between = (1.0_wp - along)*drag%torque_points((row - 1)*speeds + i) + along*drag%torque_points((row - 1)*speeds + next_i)
      end function between

   end subroutine find_shaft_drag

   !> Neighbours of a place among the points of a table.
   pure subroutine find_place(points, x, before, next, weight)
      !> The points, rising [any]
      real(wp), intent(in) :: points(:)
      !> The place; one that is off an end of the table by rounding is at that end [any]
      real(wp), intent(in) :: x
      !> Number of the point before, the same as the next where there is one alone; 0 outside the table
      integer, intent(out) :: before, next
      !> Weight of the next one [-]
      real(wp), intent(out) :: weight

      ! Part of an end that counts as rounding, of units that were converted and of inputs that a host interpolates [-]
      real(wp), parameter :: rounding = 1.0e-9_wp
      real(wp) :: place ! [any]

      weight = 0.0_wp
      before = 1
      next = 1
      if (size(points) == 1) return
      associate (ends => points([1, size(points)]))
         place = min(max(x, ends(1)), ends(2))
         if (abs(place - x) > rounding*maxval(abs(ends))) then
            before = 0
            return
         end if
      end associate
      before = min(count(points <= place), size(points) - 1)
      next = before + 1
      weight = (place - points(before))/(points(next) - points(before))
   end subroutine find_place

end module camroller_shaft_drag
