!> Time of the parts that a cycle is made of.
module bench_parts
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : numerics_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_contact_forces, only : contact_t
   use camroller_ode_problem, only : linear_t, counters_t, new_linear
   use camroller_state, only : state_t, evaluate_loading, evaluate_spin
   use camroller_events, only : find_stops
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_sorting, only : median
   use bench_clock, only : seconds_used
   use bench_tasks, only : task_t, set_accuracy
   use bench_own, only : own_t, new_own, run_own
   implicit none
   private

   public :: part_names, part_units, measure_parts

   !> What is measured
   character(len=*), parameter :: part_names(*) = [character(len=10) :: "rate", "loading", "contact", "rate_4", "slopes_4", &
      & "stops", "cycle", "states", "steps_4"]
   !> Its unit
   character(len=*), parameter :: part_units(*) = [character(len=2) :: "ns", "ns", "ns", "ns", "ns", "us", "us", "us", &
      & "us"]
   !> Repeated measurements
   integer, parameter :: rounds = 7
   !> Tolerance that the parts with a 4 in their names are for [-]
   real(wp), parameter :: tolerance = 1.0e-4_wp
   !> Method of the part `steps_4`
   character(len=*), parameter :: chosen = "hermite"

contains

   !> Measure the parts of one operating point.
   subroutine measure_parts(task, times, evaluations, error)
      !> Task
      type(task_t), intent(in) :: task
      !> Median time of each part, in its unit [ns] or [us]
      real(wp), intent(out) :: times(size(part_names))
      !> Evaluations of the right-hand side that `cycle` and `steps_4` take
      integer, intent(out) :: evaluations(2)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: cycle
      type(numerics_t) :: numerics
      type(own_t) :: own
      ! State at the output angles [m/s]
      real(wp), allocatable :: output(:, :)
      ! Time of each part in each round, time at the start [s]
      real(wp) :: seconds(rounds, size(part_names)), start
      ! Stops [rad]
      real(wp), allocatable :: stops(:)
      integer :: round

      call new_own(own, chosen, 1, 0, error)
      if (allocated(error)) return
      allocate (output(1, size(task%angles)))
      do round = 1, rounds
         call time_evaluations(task, seconds(round, :5))
         start = seconds_used()
         call find_stops(task%model, stops)
         seconds(round, 6) = seconds_used() - start
         start = seconds_used()
         call integrate_cycle(cycle, task%model, numerics, error)
         if (allocated(error)) return
         seconds(round, 7) = seconds_used() - start
         start = seconds_used()
         call take_states(task, cycle, error)
         if (allocated(error)) return
         seconds(round, 8) = seconds_used() - start
         call set_accuracy(task, tolerance)
         start = seconds_used()
         call run_own(own, task%problem, task%stops, task%first_state, tolerance*task%scale, task%angles, output, error)
         if (allocated(error)) return
         seconds(round, 9) = seconds_used() - start
      end do
      do round = 1, size(part_names)
         times(round) = median(seconds(:, round))*merge(1.0e9_wp, 1.0e6_wp, part_units(round) == "ns")
      end do
      evaluations = [cycle%counters%evaluations, own%counters%evaluations]
   end subroutine measure_parts

   !> Time of one evaluation along the solution: right-hand side, geometry and moments, contact, all to round-off; right-hand
   !> side and the same with its derivatives, as accurate as the tolerance wants them.
   subroutine time_evaluations(task, seconds)
      !> Task
      type(task_t), intent(in) :: task
      !> Times [s]
      real(wp), intent(out) :: seconds(5)

      type(position_t), allocatable :: positions(:)
      type(moments_t), allocatable :: moments(:)
      type(contact_t) :: contact
      type(linear_t) :: linear
      type(counters_t) :: counters
      ! Time at the start [s], gas force [N], angular acceleration [rad/s^2], rate [m/s/rad], sliding speed [m/s]
      real(wp) :: start, force, acceleration, rate(1), sliding_speed
      integer :: i, n, status

      n = size(task%angles)
      allocate (positions(n), moments(n))
      call new_linear(linear, 1)
      call set_accuracy(task, 0.0_wp)
      start = seconds_used()
      do i = 1, n
         call task%problem%get_rate(task%angles(i), task%sliding_speed(i:i)*1.001_wp, rate, status)
      end do
      seconds(1) = (seconds_used() - start)/n
      start = seconds_used()
      do i = 1, n
         call evaluate_loading(task%model, task%angles(i), positions(i), force, moments(i), status)
      end do
      seconds(2) = (seconds_used() - start)/n
      start = seconds_used()
      do i = 1, n
         sliding_speed = task%sliding_speed(i)*1.001_wp
         call evaluate_spin(task%model, positions(i), moments(i), sliding_speed, contact, acceleration, status)
      end do
      seconds(3) = (seconds_used() - start)/n
      call set_accuracy(task, tolerance)
      start = seconds_used()
      do i = 1, n
         call task%problem%get_rate(task%angles(i), task%sliding_speed(i:i)*1.001_wp, rate, status)
      end do
      seconds(4) = (seconds_used() - start)/n
      start = seconds_used()
      do i = 1, n
         call task%problem%linearise(task%angles(i), task%sliding_speed(i:i)*1.001_wp, task%angles(i) + 1.0e-3_wp, linear, &
            & counters, status)
      end do
      seconds(5) = (seconds_used() - start)/n
   end subroutine time_evaluations

   !> States at the output angles, as results hold them.
   subroutine take_states(task, cycle, error)
      !> Task
      type(task_t), intent(in) :: task
      !> Cycle
      type(cycle_t), intent(in) :: cycle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      integer :: i, hint

      hint = 1
      do i = 1, size(task%angles)
         call state_at(cycle, task%model, task%angles(i), hint, state, error)
         if (allocated(error)) return
      end do
   end subroutine take_states

end module bench_parts
