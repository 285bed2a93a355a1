!> Root of a function of one variable inside a bracket.
!>
!> In: two points with values of opposite sign, then the value at each requested point. Out: the root. The caller evaluates its
!> own function between the calls, so no procedure is passed as an argument and all procedures are pure:
!>
!>     call start_bracket(bracket, lower, upper, f(lower), f(upper), tolerance)
!>     do while (bracket%status == root_wanted)
!>        call narrow_bracket(bracket, f(bracket%trial))
!>     end do
!>
!> then `bracket%status` is `root_found` and `bracket%trial` the root, or the status tells why there is none.
module camroller_roots
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   implicit none
   private

   public :: bracket_t, start_bracket, narrow_bracket
   public :: root_found, root_wanted, root_not_bracketed, root_not_reached

   !> The root lies at `trial`
   integer, parameter :: root_found = 0
   !> The value at `trial` is wanted
   integer, parameter :: root_wanted = 1
   !> The values at the ends have the same sign, or a value is not a number
   integer, parameter :: root_not_bracketed = 2
   !> More steps than any bisection to round-off would need
   integer, parameter :: root_not_reached = 3

   !> Steps allowed: a bisection takes at most this many from the largest to the smallest number
   integer, parameter :: max_steps = 2200

   !> A bracket that is being narrowed
   type :: bracket_t
      !> One of the statuses of this module
      integer :: status = root_not_bracketed
      !> Point where the value is wanted, or the root [x]
      real(wp) :: trial = 0.0_wp
      !> Values asked for so far
      integer :: steps = 0
      !> Absolute tolerance of the root [x]
      real(wp), private :: tolerance = 0.0_wp
      !> Newest point, other end of the bracket, point dropped last [x]
      real(wp), private :: x(3) = 0.0_wp
      !> Values there [f]
      real(wp), private :: f(3) = 0.0_wp
   end type bracket_t

contains

   !> Begin with the ends of a bracket.
   pure subroutine start_bracket(bracket, lower, upper, value_lower, value_upper, tolerance)
      !> The bracket
      type(bracket_t), intent(out) :: bracket
      !> One end [x]
      real(wp), intent(in) :: lower
      !> The other end [x]
      real(wp), intent(in) :: upper
      !> Value at `lower` [f]
      real(wp), intent(in) :: value_lower
      !> Value at `upper` [f]
      real(wp), intent(in) :: value_upper
      !> Absolute tolerance of the root, added to four units of round-off [x]; zero asks for round-off
      real(wp), intent(in) :: tolerance

      bracket%tolerance = tolerance
      bracket%x = [upper, lower, lower]
      bracket%f = [value_upper, value_lower, value_lower]
      if (abs(value_lower) <= 0.0_wp) then
         bracket%status = root_found
         bracket%trial = lower
      else if (abs(value_upper) <= 0.0_wp) then
         bracket%status = root_found
         bracket%trial = upper
      else if (have_opposite_signs(value_lower, value_upper)) then
         bracket%status = root_wanted
         bracket%trial = lower + 0.5_wp*(upper - lower)
      end if
   end subroutine start_bracket

   !> Take the value at the trial point, and find the next point or the root.
   !>
   !> Source: Chandrupatla (1997), Advances in Engineering Software 28(3), 145-149: inverse quadratic interpolation
   !> where its criterion shows the function to be monotonic enough, bisection elsewhere; the bracket always shrinks.
   pure subroutine narrow_bracket(bracket, value)
      !> The bracket
      type(bracket_t), intent(inout) :: bracket
      !> Value at `bracket%trial` [f]
      real(wp), intent(in) :: value

      !> Point of the smallest value so far [x]
      real(wp) :: best
      !> Width of the bracket [x]; tolerance as a part of it, all of one that has none [-]
      real(wp) :: width, part
      !> Next step as a part of the bracket, from its newest end [-]
      real(wp) :: step

      bracket%steps = bracket%steps + 1
      if (ieee_is_nan(value)) then
         bracket%status = root_not_bracketed
         return
      end if
      if (have_opposite_signs(value, bracket%f(1))) then
         bracket%x(2:3) = bracket%x(1:2)
         bracket%f(2:3) = bracket%f(1:2)
      else
         bracket%x(3) = bracket%x(1)
         bracket%f(3) = bracket%f(1)
      end if
      bracket%x(1) = bracket%trial
      bracket%f(1) = value

      best = bracket%x(1)
      if (abs(bracket%f(2)) < abs(value)) best = bracket%x(2)
      width = abs(bracket%x(2) - bracket%x(1))
      part = 1.0_wp
      if (width > 0.0_wp) part = (2.0_wp*spacing(best) + 0.5_wp*bracket%tolerance)/width
      if (abs(value) <= 0.0_wp .or. part > 0.5_wp) then
         bracket%status = root_found
         bracket%trial = best
      else if (bracket%steps >= max_steps) then
         bracket%status = root_not_reached
      else
         step = interpolated_step(bracket%x, bracket%f)
         step = min(max(step, part), 1.0_wp - part)
         bracket%trial = bracket%x(1) + step*(bracket%x(2) - bracket%x(1))
      end if
   end subroutine narrow_bracket

   !> Step to the root of the inverse quadratic through three points, or half the bracket where that is not safe.
   pure function interpolated_step(x, f) result(step)
      !> Newest point, other end of the bracket, point dropped last [x]
      real(wp), intent(in) :: x(3)
      !> Values there [f]
      real(wp), intent(in) :: f(3)
      !> Step as a part of the bracket, from the newest point [-]
      real(wp) :: step

      !> Place of the newest point between the two others, in x and in f [-]
      real(wp) :: xi, phi

      step = 0.5_wp
      xi = (x(1) - x(2))/(x(3) - x(2))
      phi = (f(1) - f(2))/(f(3) - f(2))
      if (phi**2 < xi .and. (1.0_wp - phi)**2 < 1.0_wp - xi) then
         step = f(1)/(f(2) - f(1))*(f(3)/(f(2) - f(3))) &
            + (x(3) - x(1))/(x(2) - x(1))*(f(1)/(f(3) - f(1)))*(f(2)/(f(3) - f(2)))
      end if
   end function interpolated_step

   !> Whether two numbers lie on different sides of zero; false where one is not a number.
   elemental function have_opposite_signs(a, b) result(they_have)
      !> First number [any]
      real(wp), intent(in) :: a
      !> Second number [any]
      real(wp), intent(in) :: b
      !> Whether the signs differ
      logical :: they_have

      they_have = (a > 0.0_wp .and. b < 0.0_wp) .or. (a < 0.0_wp .and. b > 0.0_wp)
   end function have_opposite_signs

end module camroller_roots
