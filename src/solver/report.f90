!> The result of a case: series at the output angles and the summary.
!>
!> Layer: solver. In: case, models, cycles. Out: `result_t`.
module camroller_report
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, add_context, kind_domain
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_number_text, only : number_text, fixed_text
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t
   use camroller_catalogue, only : list_series, series_values, follower_torques, torque_count
   use camroller_result, only : result_t, quantity_t
   use camroller_shaft, only : shaft_t, new_shaft, shaft_torques
   use camroller_mean_bearings, only : mean_bearing_torque
   use camroller_means, only : statistics_t, integrate_lobe
   use camroller_summary, only : make_summary
   implicit none
   private

   public :: make_result, output_angles

   !> Estimate of the error of the sliding speed, over the largest, beyond which a result is worth a warning [-]
   real(wp), parameter :: worth_a_warning = 0.1_wp

contains

   !> Series and summary of a case.
   subroutine make_result(case, models, cycles, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> The result
      type(result_t), intent(out) :: result
      !> Convergence or domain error; domain error where a law is used outside its range and the case forbids it
      type(error_t), allocatable, intent(out) :: error

      type(shaft_t) :: shaft
      type(statistics_t), allocatable :: statistics(:)
      ! Mean torque of the camshaft bearings [N m], its error over itself [-]
      real(wp) :: bearing_torque, bearing_error
      integer :: lobe

      result%warnings = ""
      call list_series(case, result%series)
      call new_shaft(shaft, case, models(1), error)
      if (allocated(error)) return
      call sample_series(case, models, cycles, shaft, result, error)
      if (allocated(error)) return

      allocate (statistics(size(models)))
      do lobe = 1, size(models)
         call integrate_lobe(case, models(lobe), cycles(lobe), size(result%series), statistics(lobe), error)
         if (allocated(error)) return
         call check_range(models(lobe), statistics(lobe), result%warnings, error)
         if (allocated(error)) return
         call check_error(statistics(lobe), result%warnings)
         call check_entrainment(statistics(lobe), result%warnings)
      end do
      bearing_torque = 0.0_wp
      bearing_error = 0.0_wp
      if (allocated(case%cam_bearings)) call mean_bearing_torque(shaft, models, cycles, bearing_torque, bearing_error, error)
      if (allocated(error)) return
      if (bearing_error > maxval(statistics%mean_error)) then
         statistics%mean_error = bearing_error
         statistics%worst_mean = "torque_bearings"
      end if
      call make_summary(case, models, cycles, shaft, statistics, bearing_torque, result)
   end subroutine make_result

   !> Cam angles of the output, 0 to 360 with the nose at 180, end point left out [deg].
   pure function output_angles(step) result(angles)
      !> Angle between output points [rad]
      real(wp), intent(in) :: step
      !> The angles [deg]
      real(wp), allocatable :: angles(:)

      integer :: i, points

      points = max(1, nint(two_pi/step))
      angles = [(360.0_wp*i/points, i=0, points - 1)]
   end function output_angles

   !> Series at the output angles.
   subroutine sample_series(case, models, cycles, shaft, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> The camshaft
      type(shaft_t), intent(inout) :: shaft
      !> In: list of series; out: with their values
      type(result_t), intent(inout) :: result
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Torques of all followers [N m], of all bearings [N m]; values of the series
      real(wp) :: torques(torque_count), bearing_torque, values(size(result%series))
      integer :: i

      result%angle = output_angles(case%numerics%output_step)
      allocate (result%series_values(size(result%angle), size(result%series)))
      do i = 1, size(result%angle)
         call shaft_torques(shaft, models, cycles, (result%angle(i) - 180.0_wp)*degree, state, torques, bearing_torque, error)
         if (allocated(error)) return
         call series_values(case, models(1), state, torques, bearing_torque, values)
         result%series_values(i, :) = values
      end do
   end subroutine sample_series

   !> Warn where the sliding speed is no answer, as with explicit steps beyond the stability limit.
   subroutine check_error(statistics, warnings)
      !> Means over the cycle of a lobe, with the estimate of its error
      type(statistics_t), intent(in) :: statistics
      !> Warnings, one per line
      character(len=:), allocatable, intent(inout) :: warnings

      if (statistics%error <= worth_a_warning) return
      if (len(warnings) > 0) warnings = warnings//new_line("a")
      warnings = warnings//"the sliding speed is not resolved: the estimate of its error is "// &
         & number_text(statistics%error, 2)//" of the largest; take another method, a smaller tolerance or smaller steps"
   end subroutine check_error

   !> Say where the entrainment passes through zero: the smallest film is that of a standstill.
   subroutine check_entrainment(statistics, warnings)
      !> Means over the cycle of a lobe
      type(statistics_t), intent(in) :: statistics
      !> Warnings, one per line
      character(len=:), allocatable, intent(inout) :: warnings

      character(len=12) :: buffer(2)

      if (statistics%standstills == 0) return
      write (buffer(1), "(i0)") statistics%standstills
      write (buffer(2), "(f0.1)") modulo(180.0_wp + statistics%first_standstill/degree, 360.0_wp)
      if (len(warnings) > 0) warnings = warnings//new_line("a")
      warnings = warnings//"the entrainment speed changes its sign "//trim(buffer(1))//" times in contact, first at cam angle "// &
         & trim(buffer(2))//" deg; the smallest film is that of the standstill there, without what squeeze would leave"
   end subroutine check_entrainment

   !> Warn or stop where the film law was used outside its range.
   subroutine check_range(model, statistics, warnings, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Means over its cycle
      type(statistics_t), intent(in) :: statistics
      !> Warnings, one per line
      character(len=:), allocatable, intent(inout) :: warnings
      !> Domain error where the case forbids it
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text

      if (statistics%outside_share <= 0.0_wp) return
      text = "the film law is outside its published range for "//fixed_text(100.0_wp*statistics%outside_share, 1)// &
         & " % of the cycle, e.g. at cam angle "// &
         & fixed_text(modulo(180.0_wp + statistics%first_outside/degree, 360.0_wp), 1)//" deg"
      if (model%stops_outside_range) then
         call raise(error, kind_domain, text//" (range_policy = 'stop')")
      else
         if (len(warnings) > 0) warnings = warnings//new_line("a")
         warnings = warnings//text
      end if
   end subroutine check_range

end module camroller_report
