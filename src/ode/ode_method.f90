!> Abstract type of an integration method.
!>
!> In: nothing. Out: `method_t`, which methods extend, `step_t`, which they fill, and `options_t`. The integration loop is in `ode`.
module camroller_ode_method
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, linear_t, counters_t
   use camroller_trajectory, only : trajectory_t, append_curve, append_cubic, curve_numbers
   implicit none
   private

   public :: method_t, options_t, step_t, allow_more, start_step, move_step, take_step, keep_point, keep_stable

   !> Part of the stability limit that a step may use [-]
   real(wp), parameter :: stability_margin = 0.95_wp

   !> A step from an accepted point
   type :: step_t
      !> Time at its start and at its end, its length [time]
      real(wp) :: time = 0.0_wp, end_time = 0.0_wp, length = 0.0_wp
      !> Does it end at a stop?
      logical :: is_last = .false.
      !> State [state] and rate [state/time] at its start, which a try leaves untouched
      real(wp), allocatable :: state(:), rate(:)
      !> State [state] and rate [state/time] at its end
      real(wp), allocatable :: new_state(:), new_rate(:)
      !> Estimate of the error made in it; zero where the method has none [state]
      real(wp), allocatable :: estimate(:)
      !> Error over tolerance [-]
      real(wp) :: scaled_error = 0.0_wp
      !> State at a place within it [state], and its curve there, for who looks
      real(wp), allocatable :: inner_state(:), curve(:, :)
   end type step_t

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
      !> Curve of the last step, as `append_curve` takes it, shape (component, numbers given) [state] and [-]
      real(wp), allocatable :: bends(:, :)
      !> Error allowed per step, for methods that iterate; set by `integrate` [state]
      real(wp), allocatable :: tolerance(:)
      !> Room of the steps of an integration, kept for the next one
      type(step_t) :: room
   contains
      procedure(step_interface), deferred :: try_step
      procedure :: forget => forget_nothing
      procedure :: longest_first_step => unlimited_first_step
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
      !> Try a step: from its start and length to state, rate and error at its end
      subroutine step_interface(self, problem, step, counters, status)
         import :: method_t, problem_t, step_t, counters_t
         !> The method with its work space
         class(method_t), intent(inout) :: self
         class(problem_t), intent(in) :: problem
         type(step_t), intent(inout) :: step
         !> Work done so far
         type(counters_t), intent(inout) :: counters
         !> 0 fine, positive: try a smaller step, negative: give up
         integer, intent(out) :: status
      end subroutine step_interface
   end interface

contains

   !> Forget the steps made so far, so that the next one depends on nothing but its start. A method that remembers steps overrides
   !> this.
   pure subroutine forget_nothing(self)
      class(method_t), intent(inout) :: self

      associate (without_memory => self)
      end associate
   end subroutine forget_nothing

   !> Longest first step from a stop: without a limit. A method that can tell from the start of a step that a long one fails
   !> overrides this.
   pure function unlimited_first_step(self, step) result(length)
      !> The method, with the derivatives there
      class(method_t), intent(in) :: self
      !> The step, with state and rate at its start
      type(step_t), intent(in) :: step
      !> The length [time]
      real(wp) :: length

      length = huge(1.0_wp)
      associate (without_limit => self, at_any_start => step)
      end associate
   end function unlimited_first_step

   !> A step with room for the components of a state.
   pure subroutine start_step(step, state)
      !> The step; its room is kept where it is right
      type(step_t), intent(inout) :: step
      !> State at its start [state]
      real(wp), intent(in) :: state(:)

      if (allocated(step%state)) then
         if (size(step%state) /= size(state)) deallocate (step%state, step%rate, step%new_state, step%new_rate, step%estimate, &
            & step%inner_state, step%curve)
      end if
      if (.not. allocated(step%state)) allocate (step%state(size(state)), step%rate(size(state)), step%new_state(size(state)), &
         & step%new_rate(size(state)), step%estimate(size(state)), step%inner_state(size(state)), &
         & step%curve(size(state), curve_numbers))
      step%state(:) = state
   end subroutine start_step

   !> Move the room of a step.
   pure subroutine move_step(from, to)
      !> A step; out: without room
      type(step_t), intent(inout) :: from
      !> Gets its room
      type(step_t), intent(inout) :: to

      call move_alloc(from%state, to%state)
      call move_alloc(from%rate, to%rate)
      call move_alloc(from%new_state, to%new_state)
      call move_alloc(from%new_rate, to%new_rate)
      call move_alloc(from%estimate, to%estimate)
      call move_alloc(from%inner_state, to%inner_state)
      call move_alloc(from%curve, to%curve)
   end subroutine move_step

   !> Go on to the end of a step.
   pure subroutine take_step(step)
      !> In: a step, accepted; out: the start of the next one, whose end and length are still to be set
      type(step_t), intent(inout) :: step

      step%time = step%end_time
      step%state(:) = step%new_state
      step%rate(:) = step%new_rate
   end subroutine take_step

   !> Append the point where a step starts to a trajectory, with the curve that the method has left of the step before, if any.
   pure subroutine keep_point(method, step, trajectory)
      !> The method
      class(method_t), intent(in) :: method
      !> The step, taken
      type(step_t), intent(in) :: step
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory

      if (method%has_curve) then
         call append_curve(trajectory, step%time, step%state, step%rate, method%bends)
      else
         call append_cubic(trajectory, step%time, step%state, step%rate)
      end if
   end subroutine keep_point

   !> Shorten a step to what the stability of the method allows.
   subroutine keep_stable(method, problem, step, counters)
      !> The method
      class(method_t), intent(in) :: method
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The step
      type(step_t), intent(inout) :: step
      !> Work done
      type(counters_t), intent(inout) :: counters

      ! Fastest decay rate [1/time]
      real(wp) :: decay_rate

      if (method%stability_limit >= huge(1.0_wp)) return
      call problem%get_decay_rate(step%time, step%state, decay_rate)
      counters%decay_rates = counters%decay_rates + 1
      if (decay_rate*step%length > stability_margin*method%stability_limit) then
         step%length = stability_margin*method%stability_limit/decay_rate
      end if
   end subroutine keep_stable

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
