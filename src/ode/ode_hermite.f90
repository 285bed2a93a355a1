!> Exponential Hermite method of order 6, of order 4 in the first step: one evaluation of the rate with derivatives a step.
!>
!> In: nothing. Out: a `method_t` for problems of one component, which may be followed by integrals over it.
!> About the start of a step h the rate is `f + J (y - y_n) + v (t - t_n) + R(t)`. The linear part is solved exactly. R, which
!> vanishes there with its slope, is taken as the polynomial of degree 5 through its values and slopes at the starts of this
!> step and the one before and at the end of this one:
!>
!>     y(t_n + x h) = y_n + x h (phi_1(x z) f + x h phi_2(x z) v + sum over k = 2 to 5 of k! phi_(k+1)(x z) x^k r_k),
!>     R(t_n + x h) = r_2 x^2 + ... + r_5 x^5,    z = h J
!>
!> The end is predicted by the cubic through the two points that are known, in the first step after a stop by R = 0. Rate and
!> derivatives are evaluated there, and one step of Newton's method on the formula above, with these derivatives, corrects state
!> and rate. The error estimate is what the formula loses without the slope at the earliest
!> point (in the first step: without the slope at the end), at the end or in the middle of the step, whichever is larger. No state
!> but y_n enters, so steps may change at will.
!>
!> Components on which no rate depends are integrals: their remainders are polynomials in the same way, and what the first
!> component adds to them is integrated exactly, with the next function phi.
!>
!> The formula is ours; it joins the linearised exponential multistep methods of Hochbruck and Ostermann, BIT Numer. Math. 51
!> (2011) 889, with second derivatives as in Enright, SIAM J. Numer. Anal. 11 (1974) 321.
module camroller_ode_hermite
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, step_t, counters_t
   use camroller_ode_remainder, only : point_t, past_t, remainder_t, look_back, close_remainder, correct_remainder, &
      & coefficients_of, integral_of
   use camroller_phi, only : phi_functions
   use camroller_trajectory, only : curve_numbers
   implicit none
   private

   public :: hermite_method_t, new_hermite_method

   !> The method
   type, extends(method_t) :: hermite_method_t
      !> Start of the step before; start and end of the step tried last
      type(point_t) :: before, start, end
      !> The same of the integrals at the first two of these points; their states do not enter
      type(point_t), allocatable :: others_before(:), others(:)
   contains
      procedure :: try_step => try_hermite_step
      procedure :: forget => forget_points
      procedure :: longest_first_step => resolved_first_step
   end type hermite_method_t

   !> Largest growth exponent of a step [-]; beyond it a smaller step is taken
   real(wp), parameter :: largest_growth = 10.0_wp
   !> Powers of the step that the estimates grow with, in the first step and later
   integer, parameter :: first_order = 4, later_order = 6
   !> Smallest denominator of Newton's step [-]; below it a smaller step is taken
   real(wp), parameter :: least_denominator = 0.1_wp
   !> Distance from the slow motion at a stop, over the tolerance, from which on the decay to it is followed from the first step on
   !> [-]. Nine tenths of the first steps that were as long as a whole piece of a host failed then, with 4 to 6 tries in the mean;
   !> nine tenths of those below a tenth of it did not
   real(wp), parameter :: far_off = 1.0e3_wp
   !> Factorials of 2 to 5 [-]
   real(wp), parameter :: factorials(0:3) = [2.0_wp, 6.0_wp, 24.0_wp, 120.0_wp]

contains

   !> Make the method.
   subroutine new_hermite_method(method, integrals)
      !> The method
      type(hermite_method_t), intent(out) :: method
      !> Number of components that follow the first and are integrals over it
      integer, intent(in) :: integrals

      method%error_order = first_order
      method%needs_jacobian = .true.
      method%gives_rate = .true.
      method%proportional = 1.0_wp
      method%integral = 0.0_wp
      method%has_curve = .true.
      allocate (method%bends(1 + integrals, curve_numbers), method%others_before(integrals), method%others(integrals))
   end subroutine new_hermite_method

   !> Forget the points of earlier steps.
   pure subroutine forget_points(self)
      class(hermite_method_t), intent(inout) :: self

      self%before = point_t()
      self%start = point_t()
      self%end = point_t()
      self%others_before(:) = point_t()
      self%others(:) = point_t()
      self%error_order = first_order
   end subroutine forget_points

   !> Longest first step from a stop. Far from the slow motion, at which state and rate go together, what decays towards it is
   !> exact as long as it is linear, but traction bends with the sliding speed: a step of one decay length begins it.
   pure function resolved_first_step(self, step) result(length)
      !> The method, with the derivatives there
      class(hermite_method_t), intent(in) :: self
      !> The step, with state and rate at its start
      type(step_t), intent(in) :: step
      !> The length [time]
      real(wp) :: length

      length = huge(1.0_wp)
      associate (slope => self%here%jacobian(1, 1))
         if (slope >= 0.0_wp) return
         if (abs(step%rate(1) + self%here%time_slope(1)/slope) > -slope*far_off*self%tolerance(1)) length = -1.0_wp/slope
      end associate
   end function resolved_first_step

   !> One step.
   subroutine try_hermite_step(self, problem, step, counters, status)
      !> The method and the derivatives at this point; out: those at the end, too
      class(hermite_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(remainder_t) :: remainder, follower
      type(past_t) :: past
      ! Functions of h J; weights of x^2 to x^5 in the remainder [-]
      real(wp) :: phi(6), weights(0:3)
      ! Linear part of the new state; state predicted; correction [state]
      real(wp) :: linear, predicted, correction
      ! One minus the derivative of the formula over the state at the end [-]
      real(wp) :: denominator

      associate (h => step%length, new_state => step%new_state, new_rate => step%new_rate)
         new_state(:) = step%state
         new_rate(:) = step%rate
         step%estimate(:) = 0.0_wp
         call remember(self, step%time, step%state(1), step%rate)
         status = 1
         if (h*self%start%slope > largest_growth) return
         phi = phi_functions(6, h*self%start%slope)
         weights = factorials*phi(3:)
         counters%factorisations = counters%factorisations + 1
         linear = step%state(1) + h*(phi(1)*step%rate(1) + h*phi(2)*self%start%time_slope)
         past = look_back(self%start, self%before, self%before, self%start%state, h)
         predicted = linear + h*((past%value - past%slope*past%place)*weights(0) + past%slope*weights(1))
         if (.not. abs(predicted) < huge(1.0_wp)) return
         new_state(1) = predicted
         call problem%linearise(step%time + h, new_state, self%horizon, self%there, counters, status)
         if (status /= 0) return
         call close_remainder(self%there, 1, self%start, self%start%state, h, predicted, past, remainder, follower)
         denominator = 1.0_wp - h*integral_of(follower, past%place, weights)
         status = 1
         if (.not. denominator > least_denominator) return
         status = 0
         correction = (linear + h*integral_of(remainder, past%place, weights) - predicted)/denominator
         new_state(1) = predicted + correction
         call correct_remainder(remainder, follower, correction)
         new_rate(:) = self%there%rate + self%there%jacobian(:, 1)*correction
         step%estimate(1) = h*abs(loss_of(self, h, remainder, past%place, weights))
         call bend_curve(self, h, remainder, past%place, new_state(1))
         if (size(new_state) > 1) call carry_integrals(self, step, predicted, correction, remainder, past%place)
         self%there%rate(:) = new_rate
         self%there%clearance = self%there%clearance - correction
         self%end%time = step%time + h
         self%end%state = new_state(1)
      end associate
   end subroutine try_hermite_step

   !> Keep the start of the step, and with it the start of the one before where this one goes on from its end.
   pure subroutine remember(self, time, state, rate)
      !> The method and the derivatives at this point
      type(hermite_method_t), intent(inout) :: self
      !> Time at the start of the step [time], state of the first component there [state], rates there [state/time]
      real(wp), intent(in) :: time, state, rate(:)

      integer :: i
      ! Is this another try at the same point, does it follow the step before?
      logical :: is_repeated, follows

      is_repeated = .not. (abs(time - self%start%time) > 0.0_wp .or. abs(state - self%start%state) > 0.0_wp)
      if (is_repeated) return
      follows = .not. (abs(time - self%end%time) > 0.0_wp .or. abs(state - self%end%state) > 0.0_wp)
      self%before = point_t()
      if (follows) self%before = self%start
      self%error_order = merge(later_order, first_order, follows)
      self%start = point_t(time, state, rate(1), self%here%jacobian(1, 1), self%here%time_slope(1))
      do i = 2, size(rate)
         self%others_before(i - 1) = self%others(i - 1)
         self%others(i - 1) = point_t(time, 0.0_wp, rate(i), self%here%jacobian(i, 1), self%here%time_slope(i))
      end do
   end subroutine remember

   !> Components that are integrals over the first: states at the end, error estimates, curves.
   pure subroutine carry_integrals(self, step, predicted, correction, first, s)
      type(hermite_method_t), intent(inout) :: self
      !> The step, with the first component and all rates at its end; out: with all components and their errors
      type(step_t), intent(inout) :: step
      !> First component at the end as predicted, its correction [state]
      real(wp), intent(in) :: predicted, correction
      !> Its remainder [state/time]
      type(remainder_t), intent(in) :: first
      !> Place of the start of the step before [-]
      real(wp), intent(in) :: s

      ! Reciprocals of the powers that x^2 to x^5 are integrated to [-]
      real(wp), parameter :: parts(0:3) = [1.0_wp/3.0_wp, 0.25_wp, 0.2_wp, 1.0_wp/6.0_wp]
      type(remainder_t) :: remainder, follower, part
      type(past_t) :: past
      ! Functions, rates of the first component as factorials times a polynomial [state/time], its integral [state time]
      real(wp) :: phi(7), rates(0:5), integrals(2)
      ! Place [-]; change up to the middle and up to the end [state]; what the bends add [state]
      real(wp) :: place, changes(2), middle, ends
      integer :: i, k

      rates = [self%start%rate, step%length*self%start%time_slope, factorials*coefficients_of(first, s)]
      do k = 1, 2
         place = 0.5_wp*k
         phi = phi_functions(7, place*step%length*self%start%slope)
         integrals(k) = (place*step%length)**2*sum(rates*phi(2:)*[1.0_wp, place, place**2, place**3, place**4, place**5])
      end do
      do i = 1, size(self%others)
         past = look_back(self%others(i), self%others_before(i), self%before, self%start%state, step%length)
         call close_remainder(self%there, i + 1, self%others(i), self%start%state, step%length, predicted, past, remainder, &
            & follower)
         call correct_remainder(remainder, follower, correction)
         do k = 1, 2
            place = 0.5_wp*k
            changes(k) = place*step%length*(self%others(i)%rate + place*step%length*self%others(i)%time_slope/2.0_wp &
               & + place**2*sum(coefficients_of(remainder, s)*parts*[1.0_wp, place, place**2, place**3])) &
               & + self%others(i)%slope*integrals(k)
         end do
         step%new_state(i + 1) = step%new_state(i + 1) + changes(2)
         if (s > 0.0_wp) part%slope = remainder%slope
         if (s <= 0.0_wp) part%twist = remainder%twist
         step%estimate(i + 1) = step%length*(abs(integral_of(part, s, parts)) + abs(self%others(i)%slope)*step%estimate(1))
         ! the quartic through slopes at both ends and the middle
         associate (b => self%bends(i + 1, :))
            b = 0.0_wp
            b(1) = step%length*self%others(i)%rate - changes(2)
            middle = 4.0_wp*changes(1) - 2.0_wp*changes(2) - b(1)
            ends = changes(2) - step%length*step%new_rate(i + 1) - b(1)
            b(2) = 4.0_wp*middle - ends
            b(3) = ends - b(2)
         end associate
      end do
   end subroutine carry_integrals

   !> What the formula of the next lower order leaves out, at the end or in the middle of the step.
   !>
   !> Where the decay is fast against the step, the state follows the remainder at once, and an error in the middle is gone at
   !> the end.
   pure function loss_of(self, step, remainder, s, weights) result(loss)
      type(hermite_method_t), intent(in) :: self
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> The remainder [state/time]
      type(remainder_t), intent(in) :: remainder
      !> Place of the start of the step before [-]
      real(wp), intent(in) :: s
      !> Weights of x^2 to x^5 in the remainder [-]
      real(wp), intent(in) :: weights(0:3)
      !> The larger of both, its size [state/time]
      real(wp) :: loss

      type(remainder_t) :: part
      ! Functions of h J/2 [-]
      real(wp) :: phi(6)

      if (s > 0.0_wp) then
         part%slope = remainder%slope
      else
         part%twist = remainder%twist
      end if
      phi = phi_functions(6, 0.5_wp*step*self%start%slope)
      loss = max(abs(integral_of(part, s, weights)), &
         & abs(integral_of(part, s, factorials*phi(3:)*[0.125_wp, 0.0625_wp, 0.03125_wp, 0.015625_wp])))
   end function loss_of

   !> The method's own solution between both ends.
   !>
   !> Taken apart into a decaying layer and a polynomial of degree 5, which is exact but cancels for small exponents; for these
   !> by the polynomial of degree 5 through its slope at the start and its values at the quarters.
   pure subroutine bend_curve(self, step, remainder, s, new_state)
      type(hermite_method_t), intent(inout) :: self
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> The remainder [state/time]
      type(remainder_t), intent(in) :: remainder
      !> Place of the start of the step before [-]
      real(wp), intent(in) :: s
      !> State at the end [state]
      real(wp), intent(in) :: new_state

      ! Exponent from which on the solution is taken apart; height of a layer that counts, over the tolerance [-]
      real(wp), parameter :: far = 2.0_wp, least_layer = 1.0e-3_wp
      ! Exponent, place on the step, functions [-]
      real(wp) :: z, place, phi(6)
      ! Factorials times the polynomial of the rate, and their sums over powers of the exponent [state/time]
      real(wp) :: rates(0:5), sums(0:5)
      ! Change over the step, what the curve adds at the quarters [state]
      real(wp) :: change, bend(3)
      integer :: i

      z = step*self%start%slope
      rates = [self%start%rate, step*self%start%time_slope, factorials*coefficients_of(remainder, s)]
      associate (b => self%bends(1, :))
         b = 0.0_wp
         if (abs(z) > far) then
            sums(5) = rates(5)/z
            do i = 4, 0, -1
               sums(i) = (rates(i) + sums(i + 1))/z
            end do
            b(4) = step*sums(5)/120.0_wp
            b(3) = b(4) + step*sums(4)/24.0_wp
            b(2) = b(3) + step*sums(3)/6.0_wp
            b(1) = b(2) + step*sums(2)/2.0_wp
            ! A layer below round-off needs no exponential function
            if (abs(step*sums(0)) > least_layer*self%tolerance(1)) b(5:6) = [step*sums(0), z]
         else
            change = new_state - self%start%state
            b(1) = step*self%start%rate - change
            do i = 1, 3
               place = 0.25_wp*i
               phi = phi_functions(6, place*z)
               bend(i) = place*step*sum(rates*phi*[1.0_wp, place, place**2, place**3, place**4, place**5])
               bend(i) = ((bend(i) - place*change)/(place*(1.0_wp - place)) - b(1))/place
            end do
            b(4) = 8.0_wp*(bend(1) - 2.0_wp*bend(2) + bend(3))
            b(3) = 4.0_wp*(bend(2) - bend(1)) - 0.75_wp*b(4)
            b(2) = bend(2) - 0.5_wp*b(3) - 0.25_wp*b(4)
         end if
      end associate
   end subroutine bend_curve

end module camroller_ode_hermite
