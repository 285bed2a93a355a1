!> Runge-Kutta-Chebyshev of order 2: explicit, with as many stages as the decay rate of the problem asks for.
!>
!> Layer: numerics. In: nothing but the number of components. Out: a `method_t`. With s stages a step is stable up to
!> a product of decay rate and step of about 2/3 s^2, against 2 s for s steps of Euler's method.
!>
!> Source: Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315: stages, limit and error estimate.
module camroller_ode_stabilised
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, counters_t
   implicit none
   private

   public :: chebyshev_method_t, new_chebyshev_method, chebyshev_limit

   !> Runge-Kutta-Chebyshev with its work space
   type, extends(method_t) :: chebyshev_method_t
      !> The last two stages [state]
      real(wp), allocatable :: before(:), last(:)
   contains
      procedure :: try_step => try_chebyshev_step
   end type chebyshev_method_t

   !> Damping of the stability polynomial [-]
   real(wp), parameter :: damping = 2.0_wp/13.0_wp
   !> Decay rate that is allowed for over the larger of those at both ends of a step [-]
   real(wp), parameter :: margin = 1.1_wp
   !> Stages beyond which a smaller step is taken
   integer, parameter :: max_stages = 1000

   !> Chebyshev polynomial of one degree and its derivatives at the point of the method
   type :: chebyshev_t
      !> Value, first and second derivative [-]
      real(wp) :: value, slope, curvature
   end type chebyshev_t

contains

   !> Make the method.
   subroutine new_chebyshev_method(method, components)
      !> The method
      type(chebyshev_method_t), intent(out) :: method
      !> Number of components of the state
      integer, intent(in) :: components

      method%error_order = 3
      allocate (method%before(components), method%last(components))
   end subroutine new_chebyshev_method

   !> Largest product of decay rate and step that a number of stages bears.
   pure function chebyshev_limit(stages) result(limit)
      !> Number of stages, 2 at least
      integer, intent(in) :: stages
      !> Limit [-]
      real(wp) :: limit

      limit = 2.0_wp/3.0_wp*(real(stages, wp)**2 - 1.0_wp)*(1.0_wp - 2.0_wp/15.0_wp*damping)
   end function chebyshev_limit

   !> The next Chebyshev polynomial by the recurrence.
   pure function next_polynomial(last, before, point) result(next)
      !> Polynomials of the degree below and of two degrees below
      type(chebyshev_t), intent(in) :: last, before
      !> Argument [-]
      real(wp), intent(in) :: point
      !> The polynomial
      type(chebyshev_t) :: next

      next%value = 2.0_wp*point*last%value - before%value
      next%slope = 2.0_wp*last%value + 2.0_wp*point*last%slope - before%slope
      next%curvature = 4.0_wp*last%slope + 2.0_wp*point*last%curvature - before%curvature
   end function next_polynomial

   !> One step.
   subroutine try_chebyshev_step(self, problem, time, state, rate, step, new_state, new_rate, error_estimate, &
      counters, status)
      !> The method with its work space
      class(chebyshev_method_t), intent(inout) :: self
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
      !> Rate at the end [state/time]
      real(wp), intent(out) :: new_rate(:)
      !> Estimate of the error made in this step [state]
      real(wp), intent(out) :: error_estimate(:)
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Decay rates at both ends [1/time]
      real(wp) :: decay_rate, end_decay_rate
      integer :: stages

      new_state = state
      new_rate = rate
      error_estimate = 0.0_wp
      call problem%get_decay_rate(time, state, decay_rate)
      call problem%get_decay_rate(time + step, state, end_decay_rate)
      counters%decay_rates = counters%decay_rates + 2
      decay_rate = margin*max(decay_rate, end_decay_rate)*step
      status = 1
      if (decay_rate > chebyshev_limit(max_stages)) return
      stages = max(2, ceiling(sqrt(1.0_wp + decay_rate/chebyshev_limit(2)*3.0_wp)))
      call run_stages(self, problem, time, state, rate, step, stages, new_state, new_rate, counters, status)
      if (status /= 0) return
      call problem%get_rate(time + step, new_state, new_rate, status)
      counters%evaluations = counters%evaluations + 1
      error_estimate = 0.8_wp*(state - new_state) + 0.4_wp*step*(rate + new_rate)
   end subroutine try_chebyshev_step

   !> The stages of a step.
   subroutine run_stages(self, problem, time, state, rate, step, stages, new_state, work, counters, status)
      !> The method with its work space
      type(chebyshev_method_t), intent(inout) :: self
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
      !> Number of stages
      integer, intent(in) :: stages
      !> State at the end [state]
      real(wp), intent(out) :: new_state(:)
      !> Rates at the stages, one after the other [state/time]
      real(wp), intent(out) :: work(:)
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, else as from the problem
      integer, intent(out) :: status

      type(chebyshev_t) :: next, last, before
      ! Arguments w0 and w1; b of this stage, of the last and of the one before; a of the last stage [-]
      real(wp) :: w0, w1, b, b_last, b_before, a_last
      ! mu, nu and mu with tilde; time of the last stage, over the step [-]
      real(wp) :: mu, nu, mu_rate, node
      integer :: stage

      w0 = 1.0_wp + damping/stages**2
      call polynomial_at(stages, w0, next)
      w1 = next%slope/next%curvature
      ! b of stages 0 and 1 is that of stage 2, where T_2' = 4 w0, T_2'' = 4
      b_before = 1.0_wp/(4.0_wp*w0**2)
      b_last = b_before
      a_last = 1.0_wp - b_last*w0
      before = chebyshev_t(1.0_wp, 0.0_wp, 0.0_wp)
      last = chebyshev_t(w0, 1.0_wp, 0.0_wp)
      self%before = state
      self%last = state + b_last*w1*step*rate
      node = b_last*w1
      do stage = 2, stages
         call problem%get_rate(time + node*step, self%last, work, status)
         counters%evaluations = counters%evaluations + 1
         if (status /= 0) return
         next = next_polynomial(last, before, w0)
         b = next%curvature/next%slope**2
         mu = 2.0_wp*b*w0/b_last
         nu = -b/b_before
         mu_rate = 2.0_wp*b*w1/b_last
         new_state = (1.0_wp - mu - nu)*state + mu*self%last + nu*self%before + mu_rate*step*(work - a_last*rate)
         node = w1*next%curvature/next%slope
         a_last = 1.0_wp - b*next%value
         b_before = b_last
         b_last = b
         before = last
         last = next
         self%before = self%last
         self%last = new_state
      end do
   end subroutine run_stages

   !> Chebyshev polynomial of a degree.
   pure subroutine polynomial_at(degree, point, polynomial)
      !> Degree, 2 at least
      integer, intent(in) :: degree
      !> Argument [-]
      real(wp), intent(in) :: point
      !> Value and derivatives
      type(chebyshev_t), intent(out) :: polynomial

      type(chebyshev_t) :: last, before
      integer :: i

      last = chebyshev_t(1.0_wp, 0.0_wp, 0.0_wp)
      polynomial = chebyshev_t(point, 1.0_wp, 0.0_wp)
      do i = 2, degree
         before = last
         last = polynomial
         polynomial = next_polynomial(last, before, point)
      end do
   end subroutine polynomial_at

end module camroller_ode_stabilised
