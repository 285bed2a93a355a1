!> Exponential Rosenbrock method of order 3: the linear part of a step is solved exactly, the rest explicitly.
!>
!> Layer: numerics. In: nothing. Out: a `method_t` for problems of one component. With the Jacobian J and the slope with time v
!> at the start of a step h, `z = h J` and `phi_k` the functions of `phi`, the stages are
!>
!>     U = y + h phi_1(z) f + h^2 phi_2(z) v,    D = f(t + h, U) - f - J (U - y) - h v,    y_new = U + 2 h phi_3(z) D
!>
!> U is a method of order 2 by itself, so that the last term is the error estimate. More components would need functions
!> of matrices; Rosenbrock methods serve those.
!>
!> Source: Hochbruck and Ostermann, Acta Numerica 19 (2010) 209, section 2.4, method `exprb32`.
module camroller_ode_exponential
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, counters_t
   use camroller_phi, only : phi_functions
   implicit none
   private

   public :: exponential_method_t, new_exponential_method

   !> The method; it needs no work space of its own
   type, extends(method_t) :: exponential_method_t
   contains
      procedure :: try_step => try_exponential_step
   end type exponential_method_t

   !> Largest growth exponent of a step [-]; beyond it a smaller step is taken
   real(wp), parameter :: largest_growth = 10.0_wp

contains

   !> Make the method.
   pure subroutine new_exponential_method(method)
      !> The method
      type(exponential_method_t), intent(out) :: method

      method%error_order = 3
      method%gives_rate = .false.
      method%needs_jacobian = .true.
      method%proportional = 1.0_wp
      method%integral = 0.0_wp
      method%has_curve = .true.
      allocate (method%bends(1, 3))
   end subroutine new_exponential_method

   !> One step.
   subroutine try_exponential_step(self, problem, time, state, rate, step, new_state, new_rate, error_estimate, &
      counters, status)
      !> The method and the Jacobian at this point
      class(exponential_method_t), intent(inout) :: self
      !> The problem
      class(problem_t), intent(in) :: problem
      !> Time at the start of the step [time]
      real(wp), intent(in) :: time
      !> State there [state]
      real(wp), intent(in) :: state(:)
      !> Rate there [state/time]
      real(wp), intent(in) :: rate(:)
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> State at the end [state]
      real(wp), intent(out) :: new_state(:)
      !> Left to the loop: zero [state/time]
      real(wp), intent(out) :: new_rate(:)
      !> Estimate of the error made in this step [state]
      real(wp), intent(out) :: error_estimate(:)
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Functions of h J [-], what is not linear in the rate at the end [state/time]
      real(wp) :: phi(3), remainder(1), stage_rate(1)
      ! h J [-]
      real(wp) :: z

      new_state = state
      new_rate = 0.0_wp
      error_estimate = 0.0_wp
      z = step*self%here%jacobian(1, 1)
      status = 1
      if (z > largest_growth) return
      phi = phi_functions(3, z)
      counters%factorisations = counters%factorisations + 1
      new_state = state + step*(phi(1)*rate + step*phi(2)*self%here%time_slope)
      call problem%get_rate(time + step, new_state, stage_rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      remainder = stage_rate - rate - self%here%jacobian(1, 1)*(new_state - state) - step*self%here%time_slope
      error_estimate = 2.0_wp*step*phi(3)*remainder
      new_state = new_state + error_estimate
      call bend_curve(self, state, rate, step, remainder, new_state)
   end subroutine try_exponential_step

   !> Bends of the polynomial through the method's own solution at the quarters of the step.
   !>
   !> Within the step the part that is not linear grows with the square of time. Fast transients, which the step itself takes
   !> exactly, are not resolved between its ends; the step is short where they are large.
   pure subroutine bend_curve(self, state, rate, step, remainder, new_state)
      !> The method and the Jacobian at this point
      class(exponential_method_t), intent(inout) :: self
      !> State at the start [state]
      real(wp), intent(in) :: state(:)
      !> Rate there [state/time]
      real(wp), intent(in) :: rate(:)
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> What is not linear in the rate at the end [state/time]
      real(wp), intent(in) :: remainder(1)
      !> State at the end [state]
      real(wp), intent(in) :: new_state(:)

      ! Functions of the Jacobian [-], place on the step [-], part of the step [time], bends there [state]
      real(wp) :: phi(3), place, part, bend(1, 3)
      integer :: i

      do i = 1, 3
         place = 0.25_wp*i
         part = place*step
         phi = phi_functions(3, part*self%here%jacobian(1, 1))
         bend(:, i) = part*(phi(1)*rate + part*phi(2)*self%here%time_slope + 2.0_wp*place**2*phi(3)*remainder)
         bend(:, i) = (bend(:, i) - place*(new_state - state))/(place*(1.0_wp - place))
      end do
      self%bends(:, 3) = 8.0_wp*(bend(:, 1) - 2.0_wp*bend(:, 2) + bend(:, 3))
      self%bends(:, 2) = 2.0_wp*(bend(:, 3) - bend(:, 1)) - self%bends(:, 3)
      self%bends(:, 1) = bend(:, 2) - 0.5_wp*self%bends(:, 2) - 0.25_wp*self%bends(:, 3)
   end subroutine bend_curve

end module camroller_ode_exponential
