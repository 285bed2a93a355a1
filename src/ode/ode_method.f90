!> Abstract type of an integration method.
!>
!> In: nothing. Out: `method_t`, which methods extend, and `options_t`. The integration loop is in `ode`.
module camroller_ode_method
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, linear_t, counters_t
   implicit none
   private

   public :: method_t, options_t, allow_more

   !> A way to make one step
   type, abstract :: method_t
      !> Order of the error estimate plus one: the local error grows with the step to this power; 0 for a fixed step
      integer :: error_order = 0
      !> Product of decay rate and step at which the method turns unstable; adaptive steps keep within it [-]
      real(wp) :: stability_limit = huge(1.0_wp)
      !> Exponents of a proportional-integral controller times the order of the error estimate: those of explicit methods
      !> at their stability limit, after Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533. One and zero make the plain
      !> controller, which lets steps grow fast where stability does not limit them [-]
      real(wp) :: proportional = 0.7_wp, integral = 0.4_wp
      !> Does a step end with the rate at its end, and with its derivatives in `there` where it needs them at the start? Else
      !> the loop evaluates them, once the step is accepted
      logical :: gives_rate = .true.
      !> Does a step need the Jacobian at its start?
      logical :: needs_jacobian = .false.
      !> Rate with its derivatives at the start of the step and at its end, where needed
      type(linear_t) :: here, there
      !> Time up to which the right-hand side is smooth; set by `integrate` [time]
      real(wp) :: horizon = huge(1.0_wp)
      !> Does a step leave its own curve in `bends`? Else the curve follows from the rates at both ends, which suits
      !> methods whose steps are short against the decay: a rate carries the error of a state times the decay rate
      logical :: has_curve = .false.
      !> Curve of the last step, as `append_curve` takes it, shape (component, numbers given) [state]
      real(wp), allocatable :: bends(:, :)
      !> Error allowed per step, for methods that iterate; set by `integrate` [state]
      real(wp), allocatable :: tolerance(:)
   contains
      procedure(step_interface), deferred :: try_step
   end type method_t

   !> How to integrate
   type :: options_t
      !> Error allowed per step, one value per component [state]; methods with an error estimate
      real(wp), allocatable :: tolerance(:)
      !> Step of a method without error estimate, first step of the others [time]
      real(wp) :: step = 0.0_wp
      !> Is every step of that size, whatever its error? So it is for methods without error estimate
      logical :: is_fixed = .false.
      !> Largest step [time]
      real(wp) :: max_step = huge(1.0_wp)
      !> Steps and evaluations after which the integration is given up
      integer :: max_steps = 1000000, max_evaluations = huge(1)
      !> Fewest steps, shared out evenly between the segments: what happens within a segment shows between its ends only, and a
      !> method may check nothing but the ends of its steps
      integer :: fewest_steps = 32
   end type options_t

   abstract interface
      !> One step from an accepted point, which it leaves untouched
      subroutine step_interface(self, problem, time, state, rate, step, new_state, new_rate, error_estimate, &
         counters, status)
         import :: method_t, problem_t, counters_t, wp
         !> The method with its work space
         class(method_t), intent(inout) :: self
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
         !> Estimate of the error made in this step [state]; zero where the method has none
         real(wp), intent(out) :: error_estimate(:)
         !> Work done so far
         type(counters_t), intent(inout) :: counters
         !> 0 fine, positive: try a smaller step, negative: give up
         integer, intent(out) :: status
      end subroutine step_interface
   end interface

contains

   !> Options of an integration that goes on from another: what it may take is on top of what has been taken.
   pure subroutine allow_more(options, counters, further)
      !> Options as for a single integration
      type(options_t), intent(in) :: options
      !> Work done so far
      type(counters_t), intent(in) :: counters
      !> Options of the next
      type(options_t), intent(out) :: further

      further = options
      further%max_steps = options%max_steps + counters%accepted + counters%rejected
      further%max_evaluations = min(options%max_evaluations, huge(1) - counters%evaluations) + counters%evaluations
   end subroutine allow_more

end module camroller_ode_method
