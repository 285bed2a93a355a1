!> One trial of a study: a case integrated in one way, what came of it, the work and the time it took.
!>
!> Layer: solver. In: a case with its numerics. Out: `probe_t`; a failure is recorded with its message and is no error.
!>
!> Timed is what a user waits for: integration until periodic and the sliding speed at the output angles; the complete series
!> and means are timed apart. Times are medians of repeated runs.
module camroller_study_probe
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_ode_problem, only : counters_t
   use camroller_trajectory, only : interpolate_state
   use camroller_report, only : make_result, output_angles
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : build_models
   use camroller_spin, only : rolling_speed_at
   implicit none
   private

   public :: probe_t, loss_names, loss_count, run_probe, sliding_speeds, median

   !> Mean torques that a study compares; the last is their sum
   character(len=*), parameter :: loss_names(*) = [character(len=8) :: "contact", "needle", "guide", "bearings", "friction"]
   !> Their number
   integer, parameter :: loss_count = size(loss_names)
   !> Repetitions end after this time [s]
   real(wp), parameter :: patience = 0.5_wp

   !> What came of a trial
   type :: probe_t
      !> 0, or the kind of the error
      integer :: status = 0
      !> What went wrong, blank where nothing did
      character(len=:), allocatable :: message
      !> Sliding speed at the output angles [m/s]
      real(wp), allocatable :: sliding_speed(:)
      !> Slip ratio at the output angles [-]
      real(wp), allocatable :: slip_ratio(:)
      !> Mean torque of each loss, zero where the case has not got it [N m]
      real(wp) :: losses(loss_count) = 0.0_wp
      !> Is the loss part of the case?
      logical :: has_loss(loss_count) = .false.
      !> Smallest film at the output angles [m]
      real(wp) :: film_min = 0.0_wp
      !> Part of its turns that the roller loses [-]
      real(wp) :: revolution_slip = 0.0_wp
      !> Error that the program itself estimates [-]
      real(wp) :: estimated_error = 0.0_wp
      !> Work done
      type(counters_t) :: counters
      !> Cycles until periodic
      integer :: cycles = 0
      !> Time for the cycle and its sliding speeds, time for series and means [s]
      real(wp) :: time = 0.0_wp, series_time = 0.0_wp
   end type probe_t

contains

   !> Run a case and measure it.
   subroutine run_probe(case, repeats, probe)
      !> The case; its numerics say how it is integrated
      type(case_t), intent(in) :: case
      !> Runs whose median time counts, one at least
      integer, intent(in) :: repeats
      !> What came of it
      type(probe_t), intent(out) :: probe

      type(model_t), allocatable :: models(:)
      type(cycle_t), allocatable :: cycles(:)
      type(result_t) :: result
      type(error_t), allocatable :: error
      integer(int64) :: start

      probe%message = ""
      call build_models(case, models, error)
      if (.not. allocated(error)) call time_cycles(case, models, repeats, cycles, probe, error)
      call system_clock(start)
      if (.not. allocated(error)) call make_result(case, models, cycles, result, error)
      probe%series_time = seconds_since(start)
      if (allocated(error)) then
         probe%status = error%kind
         probe%message = error%message
         return
      end if
      call take_values(result, cycles, probe)
   end subroutine run_probe

   !> Integrate and sample several times; the last result stays.
   subroutine time_cycles(case, models, repeats, cycles, probe, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Runs whose median time counts
      integer, intent(in) :: repeats
      !> Cycle of each lobe shape
      type(cycle_t), allocatable, intent(out) :: cycles(:)
      !> Gets time and sliding speeds
      type(probe_t), intent(inout) :: probe
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: first, start
      ! Time of each run [s]; output angles from full lift [rad]
      real(wp) :: times(max(repeats, 1))
      real(wp), allocatable :: angles(:)
      integer :: run, lobe

      allocate (cycles(size(models)))
      angles = (output_angles(case%numerics%output_step) - 180.0_wp)*degree
      allocate (probe%sliding_speed(size(angles)))
      call system_clock(first)
      do run = 1, size(times)
         call system_clock(start)
         do lobe = size(models), 1, -1
            call integrate_cycle(cycles(lobe), models(lobe), case%numerics, error)
            if (allocated(error)) return
            call sliding_speeds(cycles(lobe), models(lobe), angles, probe%sliding_speed)
         end do
         times(run) = seconds_since(start)
         if (seconds_since(first) > patience) exit
      end do
      probe%time = median(times(:min(run, size(times))))
   end subroutine time_cycles

   !> Values that a study compares, from a complete result.
   subroutine take_values(result, cycles, probe)
      !> The result
      type(result_t), intent(in) :: result
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> Gets the values
      type(probe_t), intent(inout) :: probe

      integer :: i, position

      do i = 1, loss_count
         position = find_quantity(result%summary, "mean_torque_"//trim(loss_names(i)))
         probe%has_loss(i) = position > 0
         if (position > 0) probe%losses(i) = result%summary_values(position)
      end do
      probe%slip_ratio = result%series_values(:, find_quantity(result%series, "slip_ratio"))
      probe%film_min = minval(result%series_values(:, find_quantity(result%series, "film_thickness_min")))
      probe%revolution_slip = result%summary_values(find_quantity(result%summary, "revolution_slip"))
      position = find_quantity(result%summary, "estimated_error")
      if (position > 0) probe%estimated_error = result%summary_values(position)
      probe%counters%evaluations = sum(cycles%counters%evaluations)
      probe%counters%jacobians = sum(cycles%counters%jacobians)
      probe%counters%accepted = sum(cycles%counters%accepted)
      probe%counters%rejected = sum(cycles%counters%rejected)
      probe%cycles = maxval(cycles%cycles)
   end subroutine take_values

   !> Sliding speed of a cycle at cam angles.
   subroutine sliding_speeds(cycle, model, angles, values)
      !> The cycle
      type(cycle_t), intent(in) :: cycle
      !> The model it was integrated with
      type(model_t), intent(in) :: model
      !> Cam angles from full lift, any turn [rad]
      real(wp), intent(in) :: angles(:)
      !> Sliding speed at each of them [m/s]
      real(wp), intent(out) :: values(:)

      type(position_t) :: position
      ! Angle within the cycle [rad]; state there [m/s]
      real(wp) :: inside, state(1)
      integer :: i, hint, status

      hint = 1
      do i = 1, size(angles)
         inside = cycle%start + modulo(angles(i) - cycle%start, two_pi)
         call interpolate_state(cycle%trajectory, inside, hint, state)
         if (cycle%has_surface_speed) then
            call evaluate_geometry(model, inside, position, status)
            state = rolling_speed_at(model, position) - state
         end if
         values(i) = state(1)
      end do
   end subroutine sliding_speeds

   !> Median of some numbers.
   pure function median(values) result(middle)
      !> The numbers, one at least [any]
      real(wp), intent(in) :: values(:)
      !> Their median [any]
      real(wp) :: middle

      ! The numbers in order, the one being placed [any]
      real(wp) :: sorted(size(values)), value
      integer :: i, j

      sorted = values
      do i = 2, size(sorted)
         value = sorted(i)
         do j = i - 1, 1, -1
            if (sorted(j) <= value) exit
            sorted(j + 1) = sorted(j)
         end do
         sorted(j + 1) = value
      end do
      associate (n => size(sorted))
         middle = 0.5_wp*(sorted((n + 1)/2) + sorted(n/2 + 1))
      end associate
   end function median

   !> Time since a reading of the clock.
   function seconds_since(start) result(seconds)
      !> The reading
      integer(int64), intent(in) :: start
      !> Time [s]
      real(wp) :: seconds

      integer(int64) :: now, rate

      call system_clock(now, rate)
      seconds = real(now - start, wp)/real(rate, wp)
   end function seconds_since

end module camroller_study_probe
