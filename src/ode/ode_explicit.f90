!> Explicit Runge-Kutta methods: their coefficients, and the procedure that makes a step with them.
!>
!> In: the name of a method. Out: a `method_t`. Each set of coefficients names its paper; order, stability limit and error
!> estimate are tested.
!>
!> | method | order | stages | source |
!> |---|---|---|---|
!> | `euler` | 1, fixed step | 1 | Euler (1768) |
!> | `dormand_prince` | 5(4) | 7, the last is the first of the next step | J. Comput. Appl. Math. 6 (1980) 19 |
!>
!> Dense output is the cubic Hermite interpolant of states and rates at both ends; `dormand_prince` adds a quartic term, which
!> raises its order by one. Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer
!> (1993), II.6.
module camroller_ode_explicit
   use camroller_kinds, only : wp
   use camroller_ode, only : problem_t, method_t, step_t, counters_t
   implicit none
   private

   public :: explicit_method_t, new_explicit_method

   !> Product of decay rate and step at which Dormand and Prince's pair turns unstable (Hairer and Wanner 1996, section IV.2) [-]
   real(wp), parameter, public :: dormand_prince_limit = 3.306_wp

   !> An explicit method: its table and its work space
   type, extends(method_t) :: explicit_method_t
      !> Stages that each step evaluates
      integer :: stages = 0
      !> Times of the stages [-]
      real(wp), allocatable :: nodes(:)
      !> Weights of the earlier stages in each stage; the last row gives the new state [-]
      real(wp), allocatable :: weights(:, :)
      !> Weights of the error estimate [-]
      real(wp), allocatable :: error_weights(:)
      !> Weights of the quartic term of the curve, where it has one [-]
      real(wp), allocatable :: quartic_weights(:)
      !> Rates at the stages [state/time]
      real(wp), allocatable :: stage_rates(:, :)
   contains
      procedure :: try_step => try_explicit_step
   end type explicit_method_t

contains

   !> Make a method by its name.
   subroutine new_explicit_method(method, name, components)
      !> The method
      type(explicit_method_t), intent(out) :: method
      !> `euler` or `dormand_prince`
      character(len=*), intent(in) :: name
      !> Number of components of the state
      integer, intent(in) :: components

      select case (name)
      case ("dormand_prince")
         call set_dormand_prince(method)
      case default
         method%stages = 1
         allocate (method%nodes(1), method%weights(1, 1), method%error_weights(2))
         method%nodes = 1.0_wp
         method%weights = 1.0_wp
         method%error_weights = 0.0_wp
         method%stability_limit = 2.0_wp
      end select
      allocate (method%stage_rates(components, 0:method%stages), method%bends(components, 3))
      method%has_curve = allocated(method%quartic_weights)
   end subroutine new_explicit_method

   !> Dormand and Prince (1980).
   subroutine set_dormand_prince(method)
      type(explicit_method_t), intent(inout) :: method

      method%stages = 6
      method%error_order = 5
      method%stability_limit = dormand_prince_limit
      allocate (method%nodes(6), method%weights(6, 6), method%error_weights(7))
      method%nodes = [1.0_wp/5.0_wp, 3.0_wp/10.0_wp, 4.0_wp/5.0_wp, 8.0_wp/9.0_wp, 1.0_wp, 1.0_wp]
      method%weights = 0.0_wp
      method%weights(:1, 1) = [1.0_wp/5.0_wp]
      method%weights(:2, 2) = [3.0_wp/40.0_wp, 9.0_wp/40.0_wp]
      method%weights(:3, 3) = [44.0_wp/45.0_wp, -56.0_wp/15.0_wp, 32.0_wp/9.0_wp]
      method%weights(:4, 4) = [19372.0_wp/6561.0_wp, -25360.0_wp/2187.0_wp, 64448.0_wp/6561.0_wp, -212.0_wp/729.0_wp]
      method%weights(:5, 5) = [9017.0_wp/3168.0_wp, -355.0_wp/33.0_wp, 46732.0_wp/5247.0_wp, 49.0_wp/176.0_wp, &
         & -5103.0_wp/18656.0_wp]
      method%weights(:6, 6) = [35.0_wp/384.0_wp, 0.0_wp, 500.0_wp/1113.0_wp, 125.0_wp/192.0_wp, -2187.0_wp/6784.0_wp, &
         & 11.0_wp/84.0_wp]
      method%error_weights = method_difference([method%weights(:, 6), 0.0_wp], &
         & [5179.0_wp/57600.0_wp, 0.0_wp, 7571.0_wp/16695.0_wp, 393.0_wp/640.0_wp, -92097.0_wp/339200.0_wp, &
         & 187.0_wp/2100.0_wp, 1.0_wp/40.0_wp])
      method%quartic_weights = [-12715105075.0_wp/11282082432.0_wp, 0.0_wp, 87487479700.0_wp/32700410799.0_wp, &
         & -10690763975.0_wp/1880347072.0_wp, 701980252875.0_wp/199316789632.0_wp, -1453857185.0_wp/822651844.0_wp, &
         & 69997945.0_wp/29380423.0_wp]
   end subroutine set_dormand_prince

   !> Weights of the error estimate: those of the method minus those of its companion.
   pure function method_difference(weights, companion) result(difference)
      !> Weights of the method [-]
      real(wp), intent(in) :: weights(:)
      !> Weights of the companion of lower order [-]
      real(wp), intent(in) :: companion(:)
      !> Their difference [-]
      real(wp) :: difference(size(weights))

      difference = weights - companion
   end function method_difference

   !> One step of an explicit method.
   subroutine try_explicit_step(self, problem, step, counters, status)
      !> The method with its work space
      class(explicit_method_t), intent(inout) :: self
      class(problem_t), intent(in) :: problem
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      integer :: stage, i

      associate (state => step%state, new_state => step%new_state, new_rate => step%new_rate, length => step%length)
         step%estimate(:) = 0.0_wp
         new_rate(:) = step%rate
         self%stage_rates(:, 0) = step%rate
         do stage = 1, self%stages
            new_state(:) = state
            do i = 1, stage
               new_state(:) = new_state + length*self%weights(i, stage)*self%stage_rates(:, i - 1)
            end do
            call problem%get_rate(step%time + length*self%nodes(stage), new_state, new_rate, status)
            counters%evaluations = counters%evaluations + 1
            if (status /= 0) return
            self%stage_rates(:, stage) = new_rate
         end do
         do i = 0, self%stages
            step%estimate(:) = step%estimate + length*self%error_weights(i + 1)*self%stage_rates(:, i)
         end do
         if (self%has_curve) call bend_curve(self, length, new_state - state)
      end associate
   end subroutine try_explicit_step

   !> Bends of the cubic on the rates at both ends, and a quartic term that vanishes there together with its slope.
   pure subroutine bend_curve(self, step, change)
      !> The method with the rates of a step
      type(explicit_method_t), intent(inout) :: self
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Change of the state over the step [state]
      real(wp), intent(in) :: change(:)

      integer :: i

      self%bends(:, 1) = step*self%stage_rates(:, 0) - change
      self%bends(:, 3) = 0.0_wp
      do i = 0, self%stages
         self%bends(:, 3) = self%bends(:, 3) - step*self%quartic_weights(i + 1)*self%stage_rates(:, i)
      end do
      self%bends(:, 2) = 2.0_wp*change - step*(self%stage_rates(:, 0) + self%stage_rates(:, self%stages)) - self%bends(:, 3)
   end subroutine bend_curve

end module camroller_ode_explicit
