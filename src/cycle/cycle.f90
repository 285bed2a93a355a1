!> The periodic cycle of one follower: initial value, integration, and the state at any angle afterwards.
!>
!> In: model, numerics. Out: `cycle_t`, from which states, series and means are taken. The contraction over a cycle is usually so
!> strong that a start from the quasi-static balance at the angle of fastest decay is periodic after one cycle; this is checked,
!> and further cycles are integrated where it does not hold.
module camroller_cycle
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, add_context, kind_convergence, kind_deck
   use camroller_accuracy, only : resolve_numerics, evaluations_allowed
   use camroller_case, only : numerics_t, quasi_static
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_contact_forces, only : contact_t
   use camroller_dynamics, only : moments_t
   use camroller_state, only : state_t, evaluate_state, evaluate_loading
   use camroller_error_estimate, only : contact_accuracy_for
   use camroller_events, only : find_stops, cycle_stops
   use camroller_fold, only : explain_end
   use camroller_spin, only : spin_problem_t, rolling_speed_at
   use camroller_cycle_start, only : balance_points, check_steps, choose_start, run_up_stops, rolling_speed_at_angle
   use camroller_settled_slip, only : settle
   use camroller_quasi_static, only : quasi_static_cycle
   use camroller_contraction, only : largest_contraction
   use camroller_stick, only : has_stick, share_at_rest, touching_capacity
   use camroller_stick_slip, only : phase_t, integrate_phases, direction_at
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_ode_method, only : allow_more
   use camroller_ode_methods, only : new_method
   use camroller_trajectory, only : trajectory_t, interpolate_state, curve_slope
   use camroller_flexible_solution, only : flexible_solution_t, solve_flexible
   use camroller_flexible_follower, only : contact_changes, follower_on_path
   use camroller_flexible_train, only : at_sliding
   implicit none
   private

   public :: cycle_t, integrate_cycle, choose_method, integrate_spin, state_at, settle_state, load_stops

   !> One periodic cycle
   type :: cycle_t
      type(trajectory_t) :: trajectory
      !> Phases of sliding and sticking; allocated where boundary friction is set-valued
      type(phase_t), allocatable :: phases(:)
      type(counters_t) :: counters
      !> Is the trajectory that of the roller's surface speed instead of the sliding speed?
      logical :: has_surface_speed = .false.
      !> Is nothing known about the solution between its points but that it may be taken as linear?
      logical :: is_linear = .false.
      !> Is the sliding speed that of the quasi-static balance at each angle, as if the roller followed it without delay?
      logical :: is_quasi_static = .false.
      !> Cam angle from full lift where the cycle starts [rad]
      real(wp) :: start = 0.0_wp
      !> Stops of the cycle, with start and end [rad]
      real(wp), allocatable :: stops(:)
      !> Cycles integrated until start and end agreed
      integer :: cycles = 0
      !> Difference of the sliding speed between end and start, relative to its largest value [-]
      real(wp) :: closure = 0.0_wp
      !> Largest sliding speed, or what counts as none where that is less [m/s]
      real(wp) :: scale = 0.0_wp
      !> Distance of the start from the periodic cycle, relative to the largest sliding speed [-]
      real(wp) :: distance = 0.0_wp
      !> Error allowed per step [m/s]; zero for methods without error control
      real(wp) :: step_error = 0.0_wp
      !> Error of the sliding speed that was aimed at, over its largest value; means are integrated to the same [-]
      real(wp) :: tolerance = 0.0_wp
      !> Turns of a flexible train; the trajectory is then that of its states in the last of them
      type(flexible_solution_t), allocatable :: flexible
   end type cycle_t

   !> Part of the integration's tolerance to which the contact is solved at each evaluation [-]
   real(wp), parameter :: contact_accuracy = 1.0e-3_wp
   !> Error allowed per step over the error allowed in the cycle: errors of a few steps add up before they decay [-]
   real(wp), parameter, public :: step_part = 0.2_wp
   !> First step of a method with error control [rad]
   real(wp), parameter :: first_step = 0.1_wp*degree
   !> Steps after which a method that stiffness does not slow down is given up: several times what a lift table of thousands of rows
   !> takes
   integer, parameter :: most_implicit_steps = 100000
   !> Turns after which one that does not halve the closure is followed by one with a finer tolerance
   integer, parameter :: patience = 4
   !> The finer tolerance over the other; the finest [-]
   real(wp), parameter :: finer = 0.1_wp, finest_tolerance = 1.0e-10_wp

contains

   !> Integrate until the cycle is periodic.
   subroutine integrate_cycle(cycle, model, numerics, error, start)
      !> The cycle
      type(cycle_t), intent(out) :: cycle
      !> The model
      type(model_t), intent(in), target :: model
      !> Method, tolerance, criterion
      type(numerics_t), intent(in) :: numerics
      !> Deck error for an unknown method, convergence error where the cycle does not become periodic
      type(error_t), allocatable, intent(out) :: error
      !> Start of a turn of a flexible train near the periodic state; absent or not allocated: not known [state]
      real(wp), allocatable, intent(in), optional :: start(:)

      if (allocated(model%flexible)) then
         call take_flexible(cycle, model, resolve_numerics(numerics), error, start)
      else
         call integrate_roller(cycle, model, numerics, error)
      end if
   end subroutine integrate_cycle

   !> Integrate the roller of a rigid train until its cycle is periodic.
   subroutine integrate_roller(cycle, model, numerics, error)
      type(cycle_t), intent(out) :: cycle
      type(model_t), intent(in), target :: model
      !> Method, tolerance, criterion
      type(numerics_t), intent(in) :: numerics
      !> Deck error for an unknown method, convergence error where the cycle does not become periodic
      type(error_t), allocatable, intent(out) :: error

      type(spin_problem_t) :: problem
      class(method_t), allocatable :: method
      type(options_t) :: options, turn_options
      ! Stops within one turn [rad]
      real(wp), allocatable :: stops(:)
      ! Sliding speed or surface speed; at the start of the cycle; scale of the sliding speed, the least one [m/s]
      real(wp) :: state(1), first(1), scale, least
      ! Start and end of the turn before [m/s]; smallest closure with this tolerance [-]; decay rates of the slip at angles evenly
      ! spaced over the turn [1/rad]
      real(wp) :: last(2), best, decay_rates(balance_points)
      type(numerics_t) :: resolved
      logical :: is_periodic
      integer :: turn

      resolved = resolve_numerics(numerics)
      cycle%tolerance = resolved%tolerance
      call find_stops(model, stops)
      call choose_start(model, cycle%start, state(1), scale, least, cycle%counters%evaluations, decay_rates)
      if (resolved%method == quasi_static) then
         cycle%stops = cycle_stops(stops, cycle%start)
         cycle%scale = least
         call follow_balances(cycle, model, resolved%tolerance*scale, error)
         return
      end if
      call choose_method(cycle, model, resolved, scale, problem, method, options, error)
      if (.not. (allocated(error) .or. method%needs_jacobian .or. cycle%is_linear)) call check_steps(resolved%method, &
         & options%max_steps, decay_rates, error)
      if (allocated(error)) return
      if (cycle%has_surface_speed) state(1) = rolling_speed_at_angle(model, cycle%start) - state(1)
      cycle%stops = cycle_stops(stops, cycle%start)

      ! The balance is not quite the periodic state: a short run up to the start lets the difference decay
      call integrate_spin(cycle, problem, method, options, run_up_stops(cycle%stops), state, error)
      if (allocated(error)) return
      last = huge(1.0_wp)
      best = huge(1.0_wp)
      do turn = 1, resolved%max_cycles
         cycle%cycles = turn
         first = state
         call allow_more(options, cycle%counters, turn_options)
         call integrate_spin(cycle, problem, method, turn_options, cycle%stops, state, error)
         if (allocated(error)) return
         cycle%scale = scale
         if (.not. cycle%has_surface_speed) cycle%scale = max(least, maxval(abs(cycle%trajectory%state(1, &
            & :cycle%trajectory%count))))
         cycle%closure = abs(state(1) - first(1))/cycle%scale
         call judge_closure(cycle, problem, resolved%periodicity, is_periodic)
         if (is_periodic) then
            if (allocated(cycle%phases)) cycle%stops = cycle_stops([cycle%stops, cycle%phases%start], cycle%start)
            if (.not. cycle%is_linear) cycle%step_error = options%tolerance(1)
            return
         end if
         call approach(last, [first(1), state(1)], resolved%tolerance*cycle%scale, state(1))
         if (turn > patience .and. cycle%closure > 0.5_wp*best) call refine(scale, resolved%tolerance, problem, options, best)
         best = min(best, cycle%closure)
      end do
      call raise(error, kind_convergence, "the cycle did not become periodic: after numerics.max_cycles cycles, sliding "// &
         & "speeds at start and end, at "//trim(problem%name_time(cycle%start))//", differ by more than numerics.periodicity. "// &
         & "Reasons may be a spin with little damping, or explicit steps beyond the stability limit")
   end subroutine integrate_roller

   !> Take the quasi-static balances of the roller for the cycle.
   subroutine follow_balances(cycle, model, tolerance, error)
      !> The cycle, with its stops and tolerance
      type(cycle_t), intent(inout) :: cycle
      type(model_t), intent(in), target :: model
      !> Error allowed of the curve [m/s]
      real(wp), intent(in) :: tolerance
      !> Deck error for set-valued friction; convergence error where there is no balance
      type(error_t), allocatable, intent(out) :: error

      type(spin_problem_t) :: problem

      call check_mobilisation(model, error)
      if (allocated(error)) return
      cycle%cycles = 1
      cycle%is_quasi_static = .true.
      problem%model => model
      problem%accuracy = contact_accuracy*cycle%tolerance
      call quasi_static_cycle(problem, cycle%stops, tolerance, cycle%trajectory, cycle%counters, error)
   end subroutine follow_balances

   !> Take the solution of a flexible train for the cycle.
   subroutine take_flexible(cycle, model, numerics, error, start)
      type(cycle_t), intent(inout) :: cycle
      !> The model, with a flexible train
      type(model_t), intent(in), target :: model
      !> Method and tolerance
      type(numerics_t), intent(in) :: numerics
      !> Deck error for a method that cannot; convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Start of a turn near the periodic state; absent or not allocated: not known [state]
      real(wp), allocatable, intent(in), optional :: start(:)

      ! Stops within one turn [rad]
      real(wp), allocatable :: stops(:)

      cycle%tolerance = numerics%tolerance
      call find_stops(model, stops)
      allocate (cycle%flexible)
      call solve_flexible(cycle%flexible, model, numerics, error, start)
      if (allocated(error)) return
      associate (solution => cycle%flexible)
         cycle%trajectory = solution%cycle%trajectory
         cycle%counters = solution%cycle%counters
         cycle%cycles = solution%cycle%cycles
         cycle%closure = solution%cycle%closure
      end associate
      cycle%start = -pi
      cycle%stops = cycle_stops(stops, cycle%start)
      cycle%scale = maxval(abs(cycle%trajectory%state(at_sliding, :cycle%trajectory%count)))
   end subroutine take_flexible

   !> Start of the next turn: the end of this one, or where two turns tell how fast starts and ends approach each other, the point
   !> where they would meet.
   !>
   !> What a turn makes of its start is a function of one variable, which keeps the order of starts since solutions do not cross; so
   !> the secant between two turns finds its fixed point within a few, also where the spin is hardly damped.
   pure subroutine approach(last, this, noise, next)
      !> Start and end of the turn before; out: of this one [m/s]
      real(wp), intent(inout) :: last(2)
      !> Start and end of this turn [m/s]
      real(wp), intent(in) :: this(2)
      !> Error of an end [m/s]
      real(wp), intent(in) :: noise
      !> Start of the next turn [m/s]
      real(wp), intent(out) :: next

      ! Change of the end with the start [-]
      real(wp) :: contraction

      next = this(2)
      if (abs(last(1)) < huge(1.0_wp) .and. abs(this(1) - last(1)) > noise) then
         contraction = (this(2) - last(2))/(this(1) - last(1))
         if (contraction > 0.0_wp .and. contraction < 1.0_wp) next = this(1) + (this(2) - this(1))/(1.0_wp - contraction)
      end if
      last = this
   end subroutine approach

   !> Judge a cycle whose closure is known: is it as close to the periodic one as it must be?
   subroutine judge_closure(cycle, problem, periodicity, is_periodic)
      !> The cycle; out: with its distance from the periodic one where it closes, and the evaluations that this takes
      type(cycle_t), intent(inout) :: cycle
      !> The roller's spin
      type(spin_problem_t), intent(in) :: problem
      !> Largest distance [-]
      real(wp), intent(in) :: periodicity
      !> Is it?
      logical, intent(out) :: is_periodic

      ! What the cycle leaves of a disturbance [-]
      real(wp) :: contraction

      is_periodic = cycle%closure <= periodicity
      if (.not. is_periodic) return
      associate (path => cycle%trajectory)
         call largest_contraction(problem, path, cycle%phases, sign(periodicity*cycle%scale, path%state(1, path%count) &
            & - path%state(1, 1)), contraction, cycle%counters%evaluations)
      end associate
      cycle%distance = cycle%closure/max(1.0_wp - contraction, epsilon(1.0_wp))
      is_periodic = cycle%distance <= periodicity
   end subroutine judge_closure

   !> Problem, method and options of an integration.
   subroutine choose_method(cycle, model, numerics, scale, problem, method, options, error)
      !> The cycle: how its trajectory is to be read
      type(cycle_t), intent(inout) :: cycle
      !> The model
      type(model_t), intent(in), target :: model
      !> Method and tolerance, resolved
      type(numerics_t), intent(in) :: numerics
      !> Scale of the sliding speed [m/s]
      real(wp), intent(in) :: scale
      !> The roller's spin
      type(spin_problem_t), intent(out) :: problem
      !> The method
      class(method_t), allocatable, intent(out) :: method
      !> Tolerance and steps
      type(options_t), intent(out) :: options
      !> Deck error for an unknown method
      type(error_t), allocatable, intent(out) :: error

      cycle%tolerance = numerics%tolerance
      call new_method(method, numerics%method, 1, error)
      if (allocated(error)) return
      cycle%has_surface_speed = method%error_order == 0
      cycle%is_linear = cycle%has_surface_speed
      if (cycle%has_surface_speed) call check_mobilisation(model, error)
      cycle%trajectory%is_linear = cycle%is_linear
      problem%model => model
      problem%has_surface_speed = cycle%has_surface_speed
      problem%accuracy = contact_accuracy*numerics%tolerance
      if (cycle%is_linear) problem%accuracy = 0.0_wp
      options%tolerance = [step_part*numerics%tolerance*scale]
      options%step = merge(numerics%step, first_step, cycle%is_linear)
      if (method%needs_jacobian) then
         options%max_steps = most_implicit_steps
         options%max_evaluations = evaluations_allowed(numerics%tolerance)
      end if
   end subroutine choose_method

   !> Integrate with a finer tolerance from now on: errors of the integration keep start and end of a cycle apart.
   pure subroutine refine(scale, tolerance, problem, options, best)
      !> Scale of the sliding speed [m/s]
      real(wp), intent(in) :: scale
      !> Tolerance of the cycle [-]
      real(wp), intent(inout) :: tolerance
      !> The roller's spin
      type(spin_problem_t), intent(inout) :: problem
      !> Tolerance of a step
      type(options_t), intent(inout) :: options
      !> Smallest closure so far; out: none [-]
      real(wp), intent(out) :: best

      best = huge(1.0_wp)
      tolerance = max(min(tolerance, finest_tolerance), finer*tolerance)
      problem%accuracy = min(problem%accuracy, contact_accuracy*tolerance)
      options%tolerance = [step_part*tolerance*scale]
   end subroutine refine

   !> Refuse set-valued friction with a method without error control.
   subroutine check_mobilisation(model, error)
      type(model_t), intent(in) :: model
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (.not. has_stick(model)) return
      call raise(error, kind_deck, "asperity mobilisation = 'stick_slip' needs an integration method with error control")
   end subroutine check_mobilisation

   !> Integrate between stops, in phases where boundary friction is set-valued.
   subroutine integrate_spin(cycle, problem, method, options, stops, state, error)
      !> The cycle or a piece of one: trajectory, phases, counters
      type(cycle_t), intent(inout) :: cycle
      !> The roller's spin
      type(spin_problem_t), intent(inout) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> First angle, stops between, last angle [rad]
      real(wp), intent(in) :: stops(:)
      !> Sliding speed or surface speed, from first to last angle [m/s]
      real(wp), intent(inout) :: state(1)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (has_stick(problem%model)) then
         call integrate_phases(problem, method, options, stops, state, cycle%trajectory, cycle%phases, cycle%counters, error)
      else
         call integrate(problem, method, options, stops, state, cycle%trajectory, cycle%counters, error)
      end if
      call add_context(error, "integrating the roller's spin")
      associate (path => cycle%trajectory)
         if (allocated(error) .and. path%count > 0) then
            call explain_end(problem%model, path%time(path%count), maxval(abs(path%state(1, :path%count))), error)
         end if
      end associate
   end subroutine integrate_spin

   !> Angles at which the force on the cam may have kinks, with start and end of the cycle: its stops, and where a flexible train
   !> parts from its cam or meets it. Between them contact may be so short that no step or panel would see it.
   function load_stops(cycle, model) result(stops)
      !> The cycle
      type(cycle_t), intent(in) :: cycle
      !> The model it was integrated with
      type(model_t), intent(in) :: model
      !> Cam angles from full lift, rising [rad]
      real(wp), allocatable :: stops(:)

      stops = cycle%stops
      if (allocated(cycle%flexible)) stops = cycle_stops([stops, contact_changes(model, cycle%trajectory)], cycle%start)
   end function load_stops

   !> State of the follower at any cam angle.
   subroutine state_at(cycle, model, angle, hint, state, error, start, settles)
      !> The cycle
      type(cycle_t), intent(in) :: cycle
      !> The model it was integrated with
      type(model_t), intent(in), target :: model
      !> Cam angle from full lift, any turn [rad]
      real(wp), intent(in) :: angle
      !> Interval of the trajectory where the search starts
      integer, intent(inout) :: hint
      !> State
      type(state_t), intent(out) :: state
      !> Convergence error where the contact has no balance
      type(error_t), allocatable, intent(out) :: error
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> May the traction settle, see `settle_state`? It may without this
      logical, intent(in), optional :: settles

      type(position_t) :: position
      type(moments_t) :: moments
      ! Angle within the cycle [rad], sliding speed or surface speed [m/s], gas force [N], mobilised part of the boundary friction,
      ! relative error of load and forces [-]
      real(wp) :: inside, value(1), force, share, accuracy
      integer :: status
      logical :: rests, may_settle

      if (allocated(cycle%flexible)) then
         call follower_on_path(model, cycle%flexible%cycle%trajectory, cycle%flexible%cycle%resolution, angle, hint, state, error)
         return
      end if
      accuracy = contact_accuracy_for(cycle%tolerance)
      inside = cycle%start + modulo(angle - cycle%start, two_pi)
      call interpolate_state(cycle%trajectory, inside, hint, value)
      if (cycle%has_surface_speed) then
         call evaluate_loading(model, inside, position, force, moments, status)
         value = rolling_speed_at(model, position) - value
      end if
      if (allocated(cycle%phases)) then
         share = real(direction_at(cycle%phases, inside), wp)
         status = 0
         rests = abs(share) <= 0.0_wp
         ! A slide in the wrong direction is an error of the curve, however small: friction holds the roller there
         if (share*value(1) < 0.0_wp) rests = touching_capacity(model, inside, value(1)) > 0.0_wp
         if (rests) then
            value = 0.0_wp
            call share_at_rest(model, inside, share, status)
         end if
         if (status == 0) call evaluate_state(model, inside, value(1), state, status, share, start, accuracy)
      else
         call evaluate_state(model, inside, value(1), state, status, start=start, accuracy=accuracy)
         may_settle = status == 0
         if (present(settles)) may_settle = may_settle .and. settles
         if (may_settle) call settle_state(cycle, model, inside, hint, accuracy, state, status)
      end if
      if (status /= 0) call raise(error, kind_convergence, "no load satisfies the equilibrium of the contact at "// &
         & cam_angle_text(angle, 3))
   end subroutine state_at

   !> Give a state on the curve the traction that the slope of the curve asks for, where the curve's error decides about it.
   subroutine settle_state(cycle, model, angle, hint, accuracy, state, status)
      !> The cycle
      type(cycle_t), intent(in) :: cycle
      !> The model it was integrated with
      type(model_t), intent(in), target :: model
      !> Cam angle from full lift, within the cycle [rad]
      real(wp), intent(in) :: angle
      !> Interval of the trajectory where the search starts
      integer, intent(inout) :: hint
      !> Relative error of load and forces [-]
      real(wp), intent(in) :: accuracy
      !> The state
      type(state_t), intent(inout) :: state
      !> 0 where there is a state
      integer, intent(out) :: status

      ! Slope of the curve [m/s/rad], sliding speed [m/s]
      real(wp) :: slope(1), sliding_speed
      logical :: is_moved

      status = 0
      if (.not. cycle%step_error > 0.0_wp) return
      call curve_slope(cycle%trajectory, angle, hint, slope)
      sliding_speed = state%contact%sliding_speed
      call settle(model, angle, slope(1), cycle%step_error, state, sliding_speed, is_moved)
      if (is_moved) call evaluate_state(model, angle, sliding_speed, state, status, accuracy=accuracy)
   end subroutine settle_state

end module camroller_cycle
