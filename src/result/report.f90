!> The result of a case: series at the output angles and the summary.
!>
!> In: case, models, cycles. Out: `result_t`.
module camroller_report
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_cycle_remarks, only : judge_films, judge_lobe, judge_pressure
   use camroller_catalogue, only : list_series, follower_values, camshaft_values, follower_count, camshaft_count, lobe_columns, &
      & lobe_prefix, camshaft_columns
   use camroller_extremes, only : samples_t
   use camroller_series_extremes, only : extremes_t, find_extremes
   use camroller_margins, only : margins_t, find_margins
   use camroller_names, only : name_length
   use camroller_result, only : result_t, check_numbers, find_quantity
   use camroller_bearing_series, only : bearing_count, bearing_series_count
   use camroller_bearing_turn, only : complete_shaft
   use camroller_shaft, only : new_shaft, shaft_torques, solved_t
   use camroller_mean_bearings, only : mean_bearing_torque
   use camroller_means, only : statistics_t, integrate_lobe
   use camroller_flexible_report, only : flexible_means_t, integrate_turns
   use camroller_torque_list, only : torque_count
   use camroller_summary, only : make_summary
   implicit none
   private

   public :: take_statistics, make_result, output_angles

contains

   !> Means of all lobe shapes, with the rows and shares found on the way.
   subroutine take_statistics(case, models, cycles, statistics, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> Means of each lobe shape
      type(statistics_t), allocatable, intent(out) :: statistics(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      allocate (statistics(size(models)))
      do lobe = 1, size(models)
         if (allocated(cycles(lobe)%flexible)) then
            call integrate_flexible(case, models(lobe), cycles(lobe), statistics(lobe), error)
         else
            call integrate_lobe(case, models(lobe), cycles(lobe), follower_count(case) + camshaft_count(case), statistics(lobe), &
               & error)
         end if
         if (allocated(error)) return
      end do
   end subroutine take_statistics

   !> Means of a lobe shape whose train is flexible.
   subroutine integrate_flexible(case, model, cycle, statistics, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Its means
      type(statistics_t), intent(out) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(flexible_means_t) :: means

      call integrate_turns(case, model, cycle%flexible, follower_count(case) + camshaft_count(case), follower_count(case) + 1, &
         & means, error)
      if (allocated(error)) return
      call move_alloc(means%mean, statistics%mean)
      statistics%rows = means%rows
      statistics%torque_rows = means%torque_rows
      statistics%torques = means%torques
      statistics%shares_t = means%shares_t
      statistics%largest_sliding = means%largest_sliding
      statistics%error = cycle%flexible%error
      statistics%error_angle = cycle%flexible%error_angle
      statistics%mean_error = cycle%flexible%mean_error
      statistics%worst_mean = "torque_friction"
   end subroutine integrate_flexible

   !> Series and summary of a case.
   subroutine make_result(case, models, cycles, statistics, with_series, result, error)
      !> The case
      type(case_t), intent(in), target :: case
      !> Model of each lobe shape
      type(model_t), intent(in), target :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in), target :: cycles(:)
      !> Means of each lobe shape; out: with the rows of the extremes
      type(statistics_t), intent(inout), target :: statistics(:)
      !> Does the result hold series at the output angles, or the summary alone, which is the same?
      logical, intent(in) :: with_series
      !> The result
      type(result_t), intent(out) :: result
      !> Convergence or domain error; domain error where a law is used outside its range and the case forbids it
      type(error_t), allocatable, intent(out) :: error

      type(solved_t), target :: solved
      type(margins_t) :: margins(size(models))
      type(extremes_t) :: extremes
      type(samples_t) :: torque_rows
      ! Mean torque of the bearings of each camshaft [N m], means of series of single bearings [unit of each]; their error [-]
      real(wp), allocatable :: bearing_torque(:), of_bearings(:)
      real(wp) :: bearing_error
      ! Name of the series that this is the error of
      character(len=name_length) :: worst
      integer :: lobe

      allocate (result%remarks(0))
      call list_series(case, result%series)
      solved%case => case
      solved%models => models
      solved%cycles => cycles
      solved%curves => statistics%curve
      call new_shaft(solved%shaft, case, models(1)%oil%viscosity, models(1)%speed, error)
      if (allocated(error)) return
      call complete_shaft(solved, error)
      if (allocated(error)) return
      result%angle = output_angles(case%numerics%output_step)
      allocate (result%series_values(merge(size(result%angle), 0, with_series .or. allocated(case%engine)), &
         & size(result%series)))
      call sample_series(solved, with_series, result, error)
      if (allocated(error)) return

      do lobe = 1, size(models)
         call find_margins(models(lobe), cycles(lobe)%stops, margins(lobe))
         call judge_lobe(models(lobe), cycles(lobe), statistics(lobe), margins(lobe), merge(lobe, 0, size(models) > 1), &
            & result%remarks, error)
         if (allocated(error)) return
      end do
      allocate (bearing_torque(solved%shaft%count), of_bearings(bearing_series_count(case)))
      call mean_bearing_torque(solved, result%series, of_bearings, bearing_torque, bearing_error, worst, torque_rows, error)
      if (allocated(error)) return
      if (allocated(cycles(1)%flexible) .and. .not. allocated(case%cam_bearings)) torque_rows = statistics(1)%torque_rows
      if (bearing_error > maxval(statistics%mean_error)) then
         statistics%mean_error = bearing_error
         statistics%worst_mean = worst
      end if
      result%worst_mean = statistics(maxloc(statistics%mean_error, 1))%worst_mean
      call find_extremes(solved, margins, statistics, torque_rows, result, extremes, error)
      if (allocated(error)) return
      result%worst_extreme = statistics(maxloc(statistics%extreme_error, 1))%worst_extreme
      call make_summary(solved, statistics, bearing_torque, of_bearings, margins, extremes, result)
      do lobe = 1, size(models)
         associate (named => merge(lobe, 0, size(models) > 1))
            call judge_films(statistics(lobe), named, result%remarks)
            call judge_pressure(models(lobe), result%summary_values(find_quantity(result%summary, "max_"// &
               & trim(lobe_prefix(lobe))//"hertz_pressure")), named, result%remarks)
         end associate
      end do
      if (.not. with_series) result%series_values = result%series_values(:0, :)
      call check_numbers(result, error)
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

   !> Series at the output angles: each lobe's follower over the angle from its own nose, torques over that from the first cam's.
   subroutine sample_series(solved, with_followers, result, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Are the series of followers wanted, or those of the camshafts alone?
      logical, intent(in) :: with_followers
      !> In: list of series, with room for as many angles as there are wanted; out: with their values
      type(result_t), intent(inout) :: result
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Torques on each camshaft [N m]; values of the series; cam angle from full lift [rad]
      real(wp) :: torques(torque_count, solved%shaft%count), values(size(result%series)), angle
      ! States of the bearings; allocated where they have series
      type(bearing_state_t), allocatable :: bearings(:, :)
      integer :: hints(size(solved%models)), columns(2, size(solved%models)), of_camshaft(2), i, lobe
      ! Is there one follower, at the angle of the camshaft?
      logical :: is_alone

      hints = 1
      values = 0.0_wp
      of_camshaft = camshaft_columns(solved%case)
      if (bearing_count(solved%case) > 0) allocate (bearings(bearing_count(solved%case), solved%shaft%count))
      do lobe = 1, size(solved%models)
         columns(:, lobe) = lobe_columns(solved%case, lobe)
      end do
      is_alone = size(solved%shaft%lobes) == 1 .and. size(solved%models) == 1 .and. abs(solved%shaft%phases(1)) <= 0.0_wp
      do i = 1, size(result%series_values, 1)
         angle = (result%angle(i) - 180.0_wp)*degree
         associate (first => solved%shaft%lobes(1))
            call state_at(solved%cycles(first), solved%models(first), angle - solved%shaft%phases(1), solved%shaft%hints(1), &
               & state, error)
         end associate
         if (.not. allocated(error)) call shaft_torques(solved, angle, torques, error, state, bearings)
         if (allocated(error)) return
         call camshaft_values(solved%case, torques, values(of_camshaft(1):of_camshaft(2)), bearings)
         do lobe = 1, merge(size(solved%models), 0, with_followers)
            if (.not. is_alone) call state_at(solved%cycles(lobe), solved%models(lobe), angle, hints(lobe), state, error)
            if (allocated(error)) return
            call follower_values(solved%case, solved%models(lobe), state, &
               & values(columns(1, lobe):columns(2, lobe)))
         end do
         result%series_values(i, :) = values
      end do
   end subroutine sample_series

end module camroller_report
