!> Error and time of solvers over a ladder of tolerances, measured in turns so that what disturbs the machine disturbs all alike.
module bench_ladder
   use, intrinsic :: iso_fortran_env, only : output_unit
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ode, only : counters_t
   use camroller_sorting, only : median
   use bench_clock, only : seconds_used
   use bench_tasks, only : task_t, set_accuracy, measure_errors
   use bench_own, only : own_t, new_own, run_own
   use bench_cvode, only : cvode_t, new_cvode, run_cvode, free_cvode
   implicit none
   private

   public :: climb_ladder, print_header

   !> One solver at one tolerance
   type :: rung_t
      !> Error allowed per step over the largest size of the component [-]
      real(wp) :: tolerance = 0.0_wp
      !> Runs per measurement
      integer :: repeats = 1
      !> Rounds it takes part in
      integer :: rounds = 1
      type(counters_t) :: counters
      !> Errors reached: sliding speed, mean loss [-]
      real(wp) :: slip_error = 0.0_wp, loss_error = 0.0_wp
      !> Time of a run in each round [s]
      real(wp), allocatable :: seconds(:)
   end type rung_t

   !> A solver, ours or CVODE
   type :: contestant_t
      character(len=32) :: name = ""
      logical :: is_cvode = .false.
      type(own_t) :: own
      type(cvode_t) :: cvode
      type(rung_t), allocatable :: rungs(:)
      !> Rungs in use
      integer :: count = 0
   end type contestant_t

   !> Tolerances per decade, decades from the coarsest one; the coarsest one [-]
   integer, parameter :: per_decade = 2, decades = 11
   real(wp), parameter :: coarsest = 1.0e-1_wp
   !> Rounds of measurement; those for runs longer than `long` [s]
   integer, parameter :: rounds = 5, few_rounds = 2
   real(wp), parameter :: long = 5.0e-3_wp
   !> Time of a measurement [s]
   real(wp), parameter :: measurement = 1.0e-3_wp
   !> Error below which it gets none either [-]
   real(wp), parameter :: enough = 1.0e-9_wp

contains

   !> Names of the columns.
   subroutine print_header()

      write (output_unit, "(a)") "# task, solver, tolerance [-], error of sliding speed [-], error of mean loss [-], "// &
         & "evaluations, Jacobians, steps, rejected steps, median time [us], smallest time [us]"
   end subroutine print_header

   !> Measure solvers on a task and print a line for each tolerance.
   subroutine climb_ladder(task, names)
      !> Task
      type(task_t), intent(in) :: task
      !> Solvers: our methods, `cvode`, `cvode_slope`, `cvode_restart`, `cvode_slope_restart`
      character(len=*), intent(in) :: names(:)

      type(contestant_t), allocatable, target :: contestants(:)
      ! State at the output angles [state]
      real(wp), allocatable :: states(:, :)
      integer :: i, rung, round

      allocate (contestants(size(names)), states(size(task%first_state), size(task%angles)))
      do i = 1, size(names)
         call enter(contestants(i), task, names(i), states)
      end do
      do round = 1, rounds
         do rung = 1, per_decade*decades + 1
            do i = 1, size(names)
               if (rung > contestants(i)%count) cycle
               if (round > contestants(i)%rungs(rung)%rounds) cycle
               call measure(contestants(i), task, contestants(i)%rungs(rung), round, states)
            end do
         end do
      end do
      do i = 1, size(names)
         do rung = 1, contestants(i)%count
            call print_rung(task, contestants(i)%name, contestants(i)%rungs(rung))
         end do
         if (contestants(i)%is_cvode) call free_cvode(contestants(i)%cvode)
      end do
   end subroutine climb_ladder

   !> Make a solver, find its errors, and how often it has to run for a measurement.
   subroutine enter(contestant, task, name, states)
      !> Solver
      type(contestant_t), intent(inout) :: contestant
      !> Task
      type(task_t), intent(in) :: task
      !> Its name
      character(len=*), intent(in) :: name
      !> Room for the state at the output angles [state]
      real(wp), intent(inout) :: states(:, :)

      type(error_t), allocatable :: error
      type(rung_t) :: rung
      ! Time at the start, time of a run [s]
      real(wp) :: start, seconds
      integer :: i
      logical :: has_failed

      contestant%name = name
      contestant%is_cvode = index(name, "cvode") == 1
      allocate (contestant%rungs(per_decade*decades + 1))
      if (contestant%is_cvode) then
         call new_cvode(contestant%cvode, task%problem, size(task%first_state), index(name, "slope") > 0, &
            & index(name, "restart") > 0)
      else
         call new_own(contestant%own, name, size(task%first_state), task%problem%integrals, error)
         if (allocated(error)) return
      end if
      do i = 0, per_decade*decades
         rung%tolerance = coarsest*10.0_wp**(-real(i, wp)/per_decade)
         start = seconds_used()
         call run(contestant, task, rung%tolerance, states, has_failed)
         seconds = seconds_used() - start
         if (has_failed) then
            write (output_unit, "(4a, es10.2)") "# failed: ", trim(task%name), " ", trim(name), rung%tolerance
            cycle
         end if
         rung%counters = contestant%own%counters
         if (contestant%is_cvode) rung%counters = contestant%cvode%counters
         call measure_errors(task, states, rung%slip_error, rung%loss_error)
         rung%repeats = max(1, ceiling(measurement/max(seconds, 1.0e-9_wp)))
         if (allocated(rung%seconds)) deallocate (rung%seconds)
         rung%rounds = merge(few_rounds, rounds, seconds > long)
         allocate (rung%seconds(rung%rounds), source=0.0_wp)
         contestant%count = contestant%count + 1
         contestant%rungs(contestant%count) = rung
         if (seconds > task%patience .or. max(rung%slip_error, rung%loss_error) < enough) exit
      end do
   end subroutine enter

   !> One measurement.
   subroutine measure(contestant, task, rung, round, states)
      !> Solver
      type(contestant_t), intent(inout) :: contestant
      !> Task
      type(task_t), intent(in) :: task
      !> Tolerance
      type(rung_t), intent(inout) :: rung
      !> Number of the round
      integer, intent(in) :: round
      !> Room for the state at the output angles [state]
      real(wp), intent(inout) :: states(:, :)

      ! Time at the start [s]
      real(wp) :: start
      integer :: i
      logical :: has_failed

      start = seconds_used()
      do i = 1, rung%repeats
         call run(contestant, task, rung%tolerance, states, has_failed)
      end do
      rung%seconds(round) = (seconds_used() - start)/rung%repeats
   end subroutine measure

   !> One cycle with output.
   subroutine run(contestant, task, tolerance, states, has_failed)
      !> Solver
      type(contestant_t), intent(inout) :: contestant
      !> Task
      type(task_t), intent(in) :: task
      !> Tolerance [-]
      real(wp), intent(in) :: tolerance
      !> State at the output angles [state]
      real(wp), intent(inout) :: states(:, :)
      !> Did it give up?
      logical, intent(out) :: has_failed

      type(error_t), allocatable :: error

      call set_accuracy(task, tolerance)
      if (contestant%is_cvode) then
         call run_cvode(contestant%cvode, task%stops, task%first_state, tolerance*task%scale, task%angles, states, has_failed)
      else
         call run_own(contestant%own, task%problem, task%stops, task%first_state, tolerance*task%scale, task%angles, states, error)
         has_failed = allocated(error)
      end if
   end subroutine run

   !> One line of the table.
   subroutine print_rung(task, name, rung)
      !> Task
      type(task_t), intent(in) :: task
      !> Solver
      character(len=*), intent(in) :: name
      !> What was measured
      type(rung_t), intent(in) :: rung

      write (output_unit, "(a24, 1x, a20, 3es10.2, i9, i7, 2i8, 2f12.2)") task%name, name, rung%tolerance, rung%slip_error, &
         & rung%loss_error, rung%counters%evaluations, rung%counters%jacobians, rung%counters%accepted, rung%counters%rejected, &
         & 1.0e6_wp*median(rung%seconds), 1.0e6_wp*minval(rung%seconds)
   end subroutine print_rung

end module bench_ladder
