!> Minimum of a function of one variable, bracketed by three points of which the middle one has the lowest value.
!>
!> In: three points with their values, then the value at each requested point. Out: the lowest value found. The caller evaluates
!> its own function between the calls, as with `roots`:
!>
!>     call start_extremum(search, points, values, tolerance)
!>     do while (search%is_wanted)
!>        call narrow_extremum(search, f(search%trial))
!>     end do
!>
!> then `search%point(2)` is the position and `search%value(2)` the value of the minimum, and `search%left` what may be left to
!> gain:
!> what the last parabola missed or promised, or, at a kink, what its bracket may hide. For a maximum, pass the values with opposite
!> sign.
module camroller_extremum
   use camroller_kinds, only : wp
   implicit none
   private

   public :: extremum_t, start_extremum, narrow_extremum

   !> Values asked for at most, unless the caller has another number: a smooth function takes two to four, a kink one for each
   !> halving
   !> of its error
   integer, parameter :: most_steps = 12
   !> Smallest distance of a trial from a point over the part of the bracket on that side [-]
   real(wp), parameter :: least_part = 0.05_wp
   !> Where the larger part of a bracket is cut, from its middle point [-]: golden section
   real(wp), parameter :: golden = 0.5_wp*(3.0_wp - sqrt(5.0_wp))

   !> A search on its way
   type :: extremum_t
      !> Is the value at `trial` wanted?
      logical :: is_wanted = .false.
      !> Point where it is wanted [x]
      real(wp) :: trial = 0.0_wp
      !> Bracket: a point, the one with the smallest value so far, and one on its other side [x]; values there [f]
      real(wp) :: point(3) = 0.0_wp, value(3) = 0.0_wp
      !> Gain that is not worth a value [f]
      real(wp), private :: tolerance = 0.0_wp
      !> Value that the parabola has at the trial, and how far the last one was from that [f]
      real(wp), private :: expected = 0.0_wp, missed = huge(1.0_wp)
      !> What a lower value than the lowest so far may gain [f]
      real(wp) :: left = 0.0_wp
      !> Values asked for so far, and at most
      integer :: steps = 0
      integer, private :: limit = most_steps
   end type extremum_t

contains

   !> Begin with three points in order; without a lowest one in the middle nothing is wanted.
   pure subroutine start_extremum(search, points, values, tolerance, most)
      !> The search
      type(extremum_t), intent(out) :: search
      !> Three points, increasing [x]
      real(wp), intent(in) :: points(3)
      !> Values there [f]
      real(wp), intent(in) :: values(3)
      !> Gain that is not worth a value [f]
      real(wp), intent(in) :: tolerance
      !> Values asked for at most
      integer, intent(in), optional :: most

      if (present(most)) search%limit = most
      search%point = points
      search%value = values
      search%tolerance = tolerance
      search%trial = points(2)
      search%is_wanted = values(2) <= min(values(1), values(3)) .and. max(values(1), values(3)) > values(2)
      if (search%is_wanted) call choose_trial(search)
   end subroutine start_extremum

   !> Take the value at the trial point.
   pure subroutine narrow_extremum(search, value)
      !> The search
      type(extremum_t), intent(inout) :: search
      !> Value at `search%trial` [f]
      real(wp), intent(in) :: value

      integer :: side

      search%steps = search%steps + 1
      search%missed = abs(value - search%expected)
      side = merge(1, 3, search%trial < search%point(2))
      if (value < search%value(2)) then
         search%point(4 - side) = search%point(2)
         search%value(4 - side) = search%value(2)
         search%point(2) = search%trial
         search%value(2) = value
      else
         search%point(side) = search%trial
         search%value(side) = value
      end if
      call choose_trial(search)
   end subroutine narrow_extremum

   !> Next trial: the lowest point of the parabola, or a cut of the larger part where that is too close to a point. Nothing is
   !> wanted any more where the parabola has told the last value and gains next to nothing.
   pure subroutine choose_trial(search)
      !> The search
      type(extremum_t), intent(inout) :: search

      ! Parts of the bracket [x], rises of the value over them [f], slopes [f/x]
      real(wp) :: left, right, rises(2), slopes(2)
      ! Shift of the lowest point from the middle one [x], what it gains [f]
      real(wp) :: shift, gain

      left = search%point(2) - search%point(1)
      right = search%point(3) - search%point(2)
      rises = [search%value(1) - search%value(2), search%value(3) - search%value(2)]
      search%left = maxval(rises)
      search%is_wanted = search%steps < search%limit .and. maxval(rises) > search%tolerance &
         & .and. min(left, right) > 16.0_wp*spacing(search%point(2))
      if (.not. min(left, right) > 0.0_wp) return
      slopes = rises/[left, right]
      ! A curve bent to one side is nowhere below the lines through its middle point, continued to the other side
      search%left = max(slopes(1)*right, slopes(2)*left)
      if (.not. search%is_wanted) return
      shift = 0.5_wp*(slopes(1)*right - slopes(2)*left)/(slopes(1) + slopes(2))
      gain = shift**2*(slopes(1) + slopes(2))/(left + right)
      if (max(gain, search%missed) <= search%tolerance) then
         search%is_wanted = .false.
         search%left = max(gain, search%missed)
         return
      end if
      if (abs(shift) < least_part*min(left, right)) shift = golden*merge(right, -left, right > left)
      if (shift > 0.0_wp) shift = min(shift, (1.0_wp - least_part)*right)
      if (shift < 0.0_wp) shift = max(shift, -(1.0_wp - least_part)*left)
      search%trial = search%point(2) + shift
      search%expected = search%value(2) + shift*(shift*(slopes(1) + slopes(2)) + slopes(2)*left - slopes(1)*right)/(left + right)
   end subroutine choose_trial

end module camroller_extremum
