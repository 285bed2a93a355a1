!> Nonlinear remainder of a rate over a step, as a polynomial through values and slopes at three points.
!>
!> In: rates with derivatives at the starts of this step and the one before and at the end of this one. Out: the remainder R of
!> the rate about the start, `f + J (y - y_n) + v (t - t_n) + R(t)`, which vanishes there with its slope, as `R(t_n + x h) = r_2
!> x^2 + ... + r_5 x^5`; its integrals; its derivative with respect to the state at the end.
module camroller_ode_remainder
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : linear_t
   implicit none
   private

   public :: point_t, past_t, remainder_t, look_back, close_remainder, correct_remainder, coefficients_of, integral_of

   !> A point with its rate and derivatives
   type :: point_t
      !> Time [time]
      real(wp) :: time = huge(1.0_wp)
      !> State [state]
      real(wp) :: state = 0.0_wp
      !> Rate [state/time]
      real(wp) :: rate = 0.0_wp
      !> Derivatives of the rate over state [1/time] and time [state/time^2]
      real(wp) :: slope = 0.0_wp, time_slope = 0.0_wp
   end type point_t

   !> What a point says of the remainder of a step
   type :: past_t
      !> Place of the point, negative; positive where there is none [-]
      real(wp) :: place = 1.0_wp
      !> R/x^2 there, and its slope with the place [state/time]
      real(wp) :: value = 0.0_wp, slope = 0.0_wp
   end type past_t

   !> The remainder over the square of the place, R/x^2, as a cubic in Newton's form on the places 1, 1, s, s:
   !> `value + (x - 1) (slope + (x - 1) (bend + (x - s) twist))`
   type :: remainder_t
      !> Coefficients, which are divided differences [state/time]
      real(wp) :: value = 0.0_wp, slope = 0.0_wp, bend = 0.0_wp, twist = 0.0_wp
   end type remainder_t

   !> Decay exponent of a step from which on rates are the decay of rounding errors rather than the slope of the solution [-]
   real(wp), parameter :: fast = 1.0e5_wp

contains

   !> Slope of the solution at a point: the rate, or where the decay is so fast that the rate is the decay of rounding errors,
   !> the slope of the state at which the rate stays zero.
   pure function motion_of(rate, slope, time_slope, step) result(motion)
      !> Rate [state/time], its derivatives over state [1/time] and time [state/time^2]
      real(wp), intent(in) :: rate, slope, time_slope
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Slope of the solution [state/time]
      real(wp) :: motion

      motion = rate
      if (step*abs(slope) >= fast) motion = -time_slope/slope
   end function motion_of

   !> What the step before says of the remainder of this one.
   pure function look_back(start, before, first, state, step) result(past)
      !> Start of this step and of the one before
      type(point_t), intent(in) :: start, before
      !> The first component at the start of the step before
      type(point_t), intent(in) :: first
      !> The first component at the start of this step [state]
      real(wp), intent(in) :: state
      !> Size of this step [time]
      real(wp), intent(in) :: step
      !> What it says
      type(past_t) :: past

      ! Slope of R with the place, over the place [state/time]
      real(wp) :: slope

      if (first%time > start%time) return
      associate (back => first%time - start%time, s => past%place)
         s = back/step
         past%value = (before%rate - start%rate - start%slope*(first%state - state) - start%time_slope*back)/s**2
         slope = step*(before%time_slope - start%time_slope + (before%slope - start%slope)*motion_of(first%rate, first%slope, &
            & first%time_slope, step))/s
         past%slope = (slope - 2.0_wp*past%value)/s
      end associate
   end function look_back

   !> The remainder with what the end says of it, and its derivative over the first component there.
   pure subroutine close_remainder(there, component, start, state, step, predicted, past, remainder, follower)
      !> Rates and derivatives at the end
      type(linear_t), intent(in) :: there
      !> Which component
      integer, intent(in) :: component
      !> It at the start
      type(point_t), intent(in) :: start
      !> First component at the start [state]
      real(wp), intent(in) :: state
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> First component where rate and derivatives at the end have been evaluated [state]
      real(wp), intent(in) :: predicted
      !> What the step before says
      type(past_t), intent(in) :: past
      !> The remainder [state/time], its derivative [1/time]
      type(remainder_t), intent(out) :: remainder, follower

      ! Change of the Jacobian, Jacobian of the first component [1/time]; slope of R with the place [state/time]
      real(wp) :: change, decay, slope
      ! Distance of the places [-]
      real(wp) :: distance

      decay = there%jacobian(1, 1)
      change = there%jacobian(component, 1) - start%slope
      slope = step*(there%time_slope(component) - start%time_slope &
         & + change*motion_of(there%rate(1), decay, there%time_slope(1), step))
      remainder%value = there%rate(component) - start%rate - start%slope*(predicted - state) &
         & - start%time_slope*step
      remainder%slope = slope - 2.0_wp*remainder%value
      ! The derivatives of J and v over the state are not known and left out
      follower%value = change
      follower%slope = -2.0_wp*change
      if (step*abs(decay) < fast) follower%slope = follower%slope + step*change*decay
      if (past%place > 0.0_wp) return
      distance = 1.0_wp - past%place
      associate (secant => (remainder%value - past%value)/distance, follower_secant => follower%value/distance)
         remainder%bend = (remainder%slope - secant)/distance
         remainder%twist = (remainder%bend - (secant - past%slope)/distance)/distance
         follower%bend = (follower%slope - follower_secant)/distance
         follower%twist = (follower%bend - follower_secant/distance)/distance
      end associate
   end subroutine close_remainder

   !> Move a remainder with a correction of the first component at the end.
   pure subroutine correct_remainder(remainder, follower, correction)
      !> The remainder [state/time]
      type(remainder_t), intent(inout) :: remainder
      !> Its derivative [1/time]
      type(remainder_t), intent(in) :: follower
      !> Correction [state]
      real(wp), intent(in) :: correction

      remainder%value = remainder%value + correction*follower%value
      remainder%slope = remainder%slope + correction*follower%slope
      remainder%bend = remainder%bend + correction*follower%bend
      remainder%twist = remainder%twist + correction*follower%twist
   end subroutine correct_remainder

   !> Coefficients of x^2 to x^5 in a remainder.
   pure function coefficients_of(remainder, s) result(r)
      !> The remainder [state/time]
      type(remainder_t), intent(in) :: remainder
      !> Place of the start of the step before [-]
      real(wp), intent(in) :: s
      !> Coefficients [state/time]
      real(wp) :: r(0:3)

      r(0) = remainder%value - remainder%slope + remainder%bend - s*remainder%twist
      r(1) = remainder%slope - 2.0_wp*remainder%bend + (1.0_wp + 2.0_wp*s)*remainder%twist
      r(2) = remainder%bend - (2.0_wp + s)*remainder%twist
      r(3) = remainder%twist
   end function coefficients_of

   !> Integral of a remainder with weights for x^2 to x^5.
   pure function integral_of(remainder, s, weights) result(integral)
      !> The remainder [state/time]
      type(remainder_t), intent(in) :: remainder
      !> Place of the start of the step before [-]
      real(wp), intent(in) :: s
      !> Weights [-]
      real(wp), intent(in) :: weights(0:3)
      !> Integral [state/time]
      real(wp) :: integral

      integral = sum(coefficients_of(remainder, s)*weights)
   end function integral_of

end module camroller_ode_remainder
