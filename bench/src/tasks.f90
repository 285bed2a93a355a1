!> What is timed: one cycle of each operating point of the thesis, closed balance and source's bookkeeping, and the roller problem;
!> or one of flexible trains.
!>
!> A task begins at its periodic state (the roller problem: where its statement begins) and asks for the state at given angles.
!> Every solver gets the same compiled right-hand side, stops, largest step, error allowed per component and output angles.
module bench_tasks
   use camroller_kinds, only : wp, pi, two_pi, celsius_zero
   use camroller_error, only : error_t, add_context
   use camroller_case, only : case_t, numerics_t
   use camroller_deck, only : deck_t, override_t, read_deck, make_sweep_case
   use camroller_model, only : model_t, new_model
   use camroller_state, only : state_t, evaluate_state
   use camroller_spin, only : spin_problem_t
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_flexible_cycle, only : flexible_cycle_t, find_periodic, rest_of_train
   use camroller_flexible_turn, only : start_turns, turn_t
   use camroller_events, only : cycle_stops
   use camroller_flexible_problem, only : flexible_problem_t
   use camroller_flexible_train, only : at_sliding, evaluate_train, flexible_state_t
   use camroller_ode_problem, only : problem_t
   use bench_own, only : own_t, new_own, run_own
   use bench_cvode, only : cvode_t, new_cvode, run_cvode, free_cvode
   use bench_roller_problem, only : roller_problem_t, new_roller_problem, roller_stops, pure_rolling_spin, sliding_speed_at
   implicit none
   private

   public :: task_t, make_tasks, task_sets, set_accuracy, measure_errors

   !> Sets of tasks
   character(len=*), parameter :: task_sets(*) = [character(len=6) :: "roller", "trains"]

   !> One cycle to be computed
   type :: task_t
      !> `consistent_300_25`: bookkeeping, rev/min, degrees Celsius; `roller_a` to `roller_c`; `fixed_900`, `adjuster_900`: pivot,
      !> rev/min
      character(len=24) :: name = ""
      !> Model; the roller problem takes its kinematics from it
      type(model_t), pointer :: model => null()
      !> Right-hand side over the cam angle
      class(problem_t), pointer :: problem => null()
      !> Start, stops, end; output angles, the last at the end [rad]
      real(wp), allocatable :: stops(:), angles(:)
      !> State at the start, size that a component's error is measured against [state]
      real(wp), allocatable :: first_state(:), scale(:)
      !> Sliding speed [m/s], of a train the contact load [N], at the output angles
      real(wp), allocatable :: sliding_speed(:)
      !> Mean torque of all losses [N m]; roller problem: loss [J]; train: mean of the load [N]
      real(wp) :: loss = 0.0_wp
      !> Processor time of a run beyond which a solver gets no tighter tolerance [s]
      real(wp) :: patience = 0.02_wp
      !> Difference between two unrelated methods: sliding speed over its largest value, loss over itself [-]
      real(wp) :: doubt = 0.0_wp
   end type task_t

   !> Output angles per turn
   integer, parameter :: outputs = 720
   !> Method of the reference
   character(len=*), parameter :: reference_method = "rodas5p"
   !> Tolerance of it and of the second opinion; where the state is the spin, of which slip is a small difference [-]
   real(wp), parameter :: reference_tolerance = 1.0e-12_wp, spin_tolerance = 1.0e-10_wp
   !> The same of flexible trains, and the sliding speeds that they need not tell apart over the error of a step, as
   !> `flexible_cycle` has it [-]
   real(wp), parameter :: train_tolerance = 1.0e-8_wp, unresolved = 2.0_wp
   !> Tolerance of the periodic state that tasks begin at [-]
   real(wp), parameter :: start_tolerance = 1.0e-9_wp
   !> Part of a tolerance to which the contact is solved, as `integrate_cycle` has it [-]
   real(wp), parameter :: contact_accuracy = 1.0e-3_wp
   !> Roller problem: viscosities [Pa s], speeds [rev/min]
   real(wp), parameter :: viscosities(3) = [0.01_wp, 0.0305_wp, 0.15_wp], speeds(3) = [300.0_wp, 600.0_wp, 900.0_wp]

contains

   !> Make all tasks of a set.
   subroutine make_tasks(tasks, folder, set, error)
      !> Tasks
      type(task_t), allocatable, intent(out) :: tasks(:)
      !> Folder of the decks, one of the sets
      character(len=*), intent(in) :: folder, set
      !> Error of any kind
      type(error_t), allocatable, intent(out) :: error

      integer, parameter :: points = 9
      integer :: i

      if (set == task_sets(2)) then
         call make_trains(tasks, folder, error)
         return
      end if
      allocate (tasks(2*points + size(viscosities)))
      call add_points(tasks(:points), folder//"/thesis.nml", "consistent", error)
      if (allocated(error)) return
      call add_points(tasks(points + 1:2*points), folder//"/thesis_source.nml", "source", error)
      if (allocated(error)) return
      do i = 1, size(viscosities)
         call add_roller_problem(tasks(2*points + i), tasks(1)%model, i, error)
         if (allocated(error)) return
      end do
   end subroutine make_tasks

   !> Tasks of flexible trains: the slow vibration of a fixed pivot, resonance, contacts that open, an adjuster.
   subroutine make_trains(tasks, folder, error)
      !> Tasks
      type(task_t), allocatable, intent(out) :: tasks(:)
      !> Folder of the decks
      character(len=*), intent(in) :: folder
      !> Error of any kind
      type(error_t), allocatable, intent(out) :: error

      ! Decks, what their trains are called, speeds [rev/min]
      character(len=*), parameter :: paths(*) = [character(len=18) :: "/dynamics.nml", "/dynamics.nml", "/dynamics.nml", &
         & "/lash_adjuster.nml"]
      character(len=*), parameter :: names(*) = [character(len=13) :: "fixed_900", "fixed_2500", "fixed_3000", "adjuster_900"]
      real(wp), parameter :: train_speeds(*) = [900.0_wp, 2500.0_wp, 3000.0_wp, 900.0_wp]
      type(deck_t) :: deck
      type(case_t) :: case
      type(override_t), allocatable :: none(:)
      integer :: i

      allocate (tasks(size(names)), none(0))
      do i = 1, size(names)
         call read_deck(deck, folder//trim(paths(i)), none, error)
         if (.not. allocated(error)) call make_sweep_case(deck, 1, case, error)
         if (allocated(error)) return
         case%operating_point%speed = train_speeds(i)*two_pi/60.0_wp
         tasks(i)%name = names(i)
         call add_train(tasks(i), case, error)
         call add_context(error, trim(names(i)))
         if (allocated(error)) return
      end do
   end subroutine make_trains

   !> Task for a flexible train.
   subroutine add_train(task, case, error)
      !> Task
      type(task_t), intent(inout) :: task
      !> Case
      type(case_t), intent(in) :: case
      !> Error of any kind
      type(error_t), allocatable, intent(out) :: error

      ! Tolerance of the periodic state, distance from it [-]
      real(wp), parameter :: tolerance = 1.0e-5_wp, closure = 1.0e-4_wp
      type(flexible_problem_t), pointer :: problem
      type(turn_t) :: turn
      type(flexible_cycle_t) :: cycle
      ! State [state]
      real(wp), allocatable :: state(:)

      allocate (task%model, problem)
      call new_model(task%model, case, 1, error)
      if (.not. allocated(error)) call start_turns(turn, task%model, reference_method, tolerance, error)
      if (.not. allocated(error)) call rest_of_train(task%model, state, error)
      if (.not. allocated(error)) call find_periodic(cycle, turn, state, closure, 40, error)
      if (allocated(error)) return
      ! Kinks of the lift, which other solvers do not find by themselves
      task%stops = cycle_stops(task%model%lift_stops, turn%stops(1))
      task%first_state = state
      task%scale = turn%scales
      task%patience = 0.3_wp
      problem = turn%problem
      task%problem => problem
      call add_reference(task, 1, error)
   end subroutine add_train

   !> Tasks for the sweep of a deck.
   subroutine add_points(tasks, path, prefix, error)
      !> Tasks to fill
      type(task_t), intent(inout) :: tasks(:)
      !> Path of the deck
      character(len=*), intent(in) :: path
      !> First word of the names
      character(len=*), intent(in) :: prefix
      !> Error of any kind
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(override_t), allocatable :: none(:)
      integer :: i

      allocate (none(0))
      call read_deck(deck, path, none, error)
      if (allocated(error)) return
      do i = 1, size(tasks)
         call make_sweep_case(deck, i, case, error)
         if (allocated(error)) return
         write (tasks(i)%name, "(a, '_', i0, '_', i0)") prefix, nint(case%operating_point%speed*60.0_wp/two_pi), &
            & nint(case%operating_point%oil_temperature - celsius_zero)
         call add_point(tasks(i), case, error)
         call add_context(error, trim(tasks(i)%name))
         if (allocated(error)) return
      end do
   end subroutine add_points

   !> Task for one case.
   subroutine add_point(task, case, error)
      !> Task
      type(task_t), intent(inout) :: task
      !> Case
      type(case_t), intent(in) :: case
      !> Error of any kind
      type(error_t), allocatable, intent(out) :: error

      type(spin_problem_t), pointer :: problem
      type(cycle_t) :: cycle
      type(numerics_t) :: numerics

      allocate (task%model, problem)
      call new_model(task%model, case, 1, error)
      if (allocated(error)) return
      numerics%method = reference_method
      numerics%tolerance = start_tolerance
      numerics%periodicity = 1.0e-8_wp
      call integrate_cycle(cycle, task%model, numerics, error)
      if (allocated(error)) return
      task%stops = cycle%stops
      task%first_state = cycle%trajectory%state(:, 1)
      task%scale = [maxval(abs(cycle%trajectory%state(1, :cycle%trajectory%count)))]
      problem%model => task%model
      problem%small_state = task%scale
      task%problem => problem
      call add_reference(task, 1, error)
   end subroutine add_point

   !> Task for one case of the roller problem.
   subroutine add_roller_problem(task, model, number, error)
      !> Task
      type(task_t), intent(inout) :: task
      !> Model with the thesis's kinematics
      type(model_t), intent(in), target :: model
      !> Which case
      integer, intent(in) :: number
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(roller_problem_t), pointer :: problem

      allocate (problem)
      call new_roller_problem(problem, model, viscosities(number), speeds(number)*two_pi/60.0_wp)
      task%name = "roller_"//achar(iachar("a") + number - 1)
      task%model => model
      task%stops = roller_stops()
      task%first_state = [pure_rolling_spin(problem, -pi), 0.0_wp]
      task%scale = [1.0_wp, 0.1_wp]
      task%problem => problem
      call add_reference(task, 2, error)
      if (allocated(error)) return
      task%scale = [maxval(abs(task%sliding_speed))/model%roller_radius, task%loss]
      call add_reference(task, 2, error)
   end subroutine add_roller_problem

   !> Output angles and the solution there; CVODE gives a second opinion on it.
   subroutine add_reference(task, turns, error)
      !> Task, all but its solution set
      type(task_t), intent(inout) :: task
      !> Turns of the cam
      integer, intent(in) :: turns
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(own_t) :: solver
      type(cvode_t) :: second
      ! State at the output angles [state]
      real(wp), allocatable :: states(:, :)
      ! Differences in sliding speed and in the loss [-]
      real(wp) :: slip_error, loss_error
      ! Tolerance of both [-]
      real(wp) :: tolerance
      integer :: i
      logical :: has_failed

      task%angles = task%stops(1) + [(i, i=1, turns*outputs)]*(two_pi/outputs)
      task%angles(turns*outputs) = task%stops(size(task%stops))
      allocate (states(size(task%first_state), turns*outputs))
      tolerance = merge(reference_tolerance, spin_tolerance, turns == 1)
      if (allocated(task%model%flexible)) tolerance = train_tolerance
      call set_accuracy(task, 0.0_wp)
      call new_own(solver, reference_method, size(task%first_state), task%problem%integrals, error)
      if (allocated(error)) return
      call run_own(solver, task%problem, task%stops, task%first_state, tolerance*task%scale, task%angles, states, error)
      if (allocated(error)) return
      task%sliding_speed = sliding_speeds(task, states)
      task%loss = loss_of(task, states)
      call new_cvode(second, task%problem, size(task%first_state), knows_slope=.false., restarts=.false.)
      call run_cvode(second, task%stops, task%first_state, tolerance*task%scale, task%angles, states, has_failed)
      call free_cvode(second)
      call measure_errors(task, states, slip_error, loss_error)
      task%doubt = merge(1.0_wp, max(slip_error, loss_error), has_failed)
   end subroutine add_reference

   !> Let evaluations be as accurate as a tolerance wants them, for every solver alike.
   subroutine set_accuracy(task, tolerance)
      !> Task
      type(task_t), intent(in) :: task
      !> Tolerance of the integration; zero: evaluate to round-off [-]
      real(wp), intent(in) :: tolerance

      select type (problem => task%problem)
      type is (spin_problem_t)
         problem%accuracy = contact_accuracy*tolerance
      type is (flexible_problem_t)
         problem%resolution%forces = contact_accuracy*tolerance
         problem%resolution%sliding_speed = unresolved*tolerance*task%scale(at_sliding)
      end select
   end subroutine set_accuracy

   !> Errors of a solution.
   subroutine measure_errors(task, states, slip_error, loss_error)
      !> Task
      type(task_t), intent(in) :: task
      !> State at the output angles, shape (component, angle) [state]
      real(wp), intent(in) :: states(:, :)
      !> Largest error of the sliding speed over its largest value; error of the mean loss over itself [-]
      real(wp), intent(out) :: slip_error, loss_error

      slip_error = maxval(abs(sliding_speeds(task, states) - task%sliding_speed))/maxval(abs(task%sliding_speed))
      loss_error = abs(loss_of(task, states) - task%loss)/task%loss
   end subroutine measure_errors

   !> Sliding speed at the output angles [m/s]; of a train the contact load [N].
   function sliding_speeds(task, states) result(speeds)
      !> Task
      type(task_t), intent(in) :: task
      !> State at the output angles [state]
      real(wp), intent(in) :: states(:, :)
      !> Sliding speeds [m/s]; of a train the loads [N]
      real(wp) :: speeds(size(states, 2))

      type(flexible_state_t) :: train
      integer :: i, status

      speeds = states(1, :)
      select type (problem => task%problem)
      type is (flexible_problem_t)
         do i = 1, size(speeds)
            call evaluate_train(task%model, task%angles(i), states(:, i), problem%resolution, train, status)
            speeds(i) = train%contact%load
         end do
      type is (roller_problem_t)
         do i = 1, size(speeds)
            speeds(i) = sliding_speed_at(problem, task%angles(i), states(1, i))
         end do
      end select
   end function sliding_speeds

   !> Mean torque of the losses over the output angles [N m]; roller problem: loss at the end [J].
   function loss_of(task, states) result(loss)
      !> Task
      type(task_t), intent(in) :: task
      !> State at the output angles [state]
      real(wp), intent(in) :: states(:, :)
      !> Mean torque [N m] or loss [J], of a train the mean load [N]
      real(wp) :: loss

      type(state_t) :: state
      integer :: i, status

      if (allocated(task%model%flexible)) then
         loss = sum(sliding_speeds(task, states))/size(states, 2)
         return
      end if
      if (size(states, 1) > 1) then
         loss = states(2, size(states, 2))
         return
      end if
      loss = 0.0_wp
      do i = 1, size(states, 2)
         call evaluate_state(task%model, task%angles(i), states(1, i), state, status)
         loss = loss + state%torque_friction/size(states, 2)
      end do
   end function loss_of

end module bench_tasks
