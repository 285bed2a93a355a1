!> The result of a case: series at the output angles and the summary.
!>
!> In: case, models, cycles. Out: `result_t`.
module camroller_report
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_cycle_remarks, only : has_film_limit, judge_films, judge_lobe, judge_pressure
   use camroller_catalogue, only : list_series, follower_values, camshaft_values, follower_count, camshaft_count, lobe_columns, &
      & lobe_prefix, camshaft_columns
   use camroller_extremes, only : samples_t, search_t, add_sample, narrow_search, start_search
   use camroller_margins, only : margins_t, find_margins
   use camroller_result, only : result_t, quantity_t, find_quantity, check_numbers
   use camroller_shaft, only : solved_t, new_shaft, shaft_torques
   use camroller_mean_bearings, only : mean_bearing_torque
   use camroller_means, only : statistics_t, integrate_lobe
   use camroller_slip_errors, only : error_of_extreme
   use camroller_flexible_report, only : flexible_means_t, integrate_turns
   use camroller_torque_list, only : torque_count
   use camroller_summary, only : make_summary, extremes_t
   implicit none
   private

   public :: take_statistics, make_result, output_angles

   !> Distance of the states on both sides of a stop, where series may jump [rad]
   real(wp), parameter :: beside = 1.0e-9_wp

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
      type(statistics_t), intent(inout) :: statistics(:)
      !> Does the result hold series at the output angles, or the summary alone, which is the same?
      logical, intent(in) :: with_series
      !> The result
      type(result_t), intent(out) :: result
      !> Convergence or domain error; domain error where a law is used outside its range and the case forbids it
      type(error_t), allocatable, intent(out) :: error

      type(solved_t) :: solved
      type(margins_t), allocatable :: margins(:)
      type(extremes_t) :: extremes
      type(samples_t) :: torque_rows
      ! Mean torque of the bearings of each camshaft [N m]; its error over itself [-]
      real(wp), allocatable :: bearing_torque(:)
      real(wp) :: bearing_error
      integer :: lobe

      allocate (result%remarks(0))
      call list_series(case, result%series)
      solved%case => case
      solved%models => models
      solved%cycles => cycles
      call new_shaft(solved%shaft, case, models(1)%oil%viscosity, models(1)%speed, error)
      if (allocated(error)) return
      result%angle = output_angles(case%numerics%output_step)
      allocate (result%series_values(merge(size(result%angle), 0, with_series .or. allocated(case%engine)), &
         & size(result%series)))
      call sample_series(solved, result, error)
      if (allocated(error)) return

      allocate (margins(size(models)))
      do lobe = 1, size(models)
         call find_margins(models(lobe), cycles(lobe)%stops, margins(lobe))
         call judge_lobe(models(lobe), cycles(lobe), statistics(lobe), margins(lobe), merge(lobe, 0, size(models) > 1), &
            & result%remarks, error)
         if (allocated(error)) return
      end do
      allocate (bearing_torque(solved%shaft%count))
      bearing_torque = 0.0_wp
      bearing_error = 0.0_wp
      call mean_bearing_torque(solved, bearing_torque, bearing_error, torque_rows, error)
      if (allocated(error)) return
      if (allocated(cycles(1)%flexible) .and. .not. allocated(case%cam_bearings)) torque_rows = statistics(1)%torque_rows
      if (bearing_error > maxval(statistics%mean_error)) then
         statistics%mean_error = bearing_error
         statistics%worst_mean = "torque_bearings"
      end if
      result%worst_mean = statistics(maxloc(statistics%mean_error, 1))%worst_mean
      call find_extremes(solved, margins, statistics, torque_rows, result, extremes, error)
      if (allocated(error)) return
      result%worst_extreme = statistics(maxloc(statistics%extreme_error, 1))%worst_extreme
      do lobe = 1, size(solved%models)
         call judge_films(statistics(lobe), merge(lobe, 0, size(solved%models) > 1), result%remarks)
      end do
      call make_summary(solved, statistics, bearing_torque, margins, extremes, result)
      do lobe = 1, size(solved%models)
         call judge_pressure(solved%models(lobe), result%summary_values(find_quantity(result%summary, "max_"// &
            & trim(lobe_prefix(lobe))//"hertz_pressure")), merge(lobe, 0, size(solved%models) > 1), result%remarks)
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
   subroutine sample_series(solved, result, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> In: list of series, with room for as many angles as there are wanted; out: with their values
      type(result_t), intent(inout) :: result
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Torques on each camshaft [N m]; values of the series; cam angle from full lift [rad]
      real(wp) :: torques(torque_count, solved%shaft%count), values(size(result%series)), angle
      integer :: hints(size(solved%models)), columns(2, size(solved%models)), of_camshaft(2), i, lobe
      ! Is the first cam's follower the first lobe's, at the same angle?
      logical :: is_first

      hints = 1
      of_camshaft = camshaft_columns(solved%case)
      do lobe = 1, size(solved%models)
         columns(:, lobe) = lobe_columns(solved%case, lobe)
      end do
      is_first = solved%shaft%lobes(1) == 1 .and. abs(solved%shaft%phases(1)) <= 0.0_wp
      do i = 1, size(result%series_values, 1)
         angle = (result%angle(i) - 180.0_wp)*degree
         call shaft_torques(solved, angle, state, torques, error)
         if (allocated(error)) return
         call camshaft_values(solved%case, torques, values(of_camshaft(1):of_camshaft(2)))
         do lobe = 1, size(solved%models)
            if (lobe > 1 .or. .not. is_first) call state_at(solved%cycles(lobe), solved%models(lobe), angle, hints(lobe), state, &
               & error)
            if (allocated(error)) return
            call follower_values(solved%case, solved%models(lobe), state, &
               & values(columns(1, lobe):columns(2, lobe)))
         end do
         result%series_values(i, :) = values
      end do
   end subroutine sample_series

   !> Smallest and largest value of every series, at the stops and between the angles met as well.
   subroutine find_extremes(solved, margins, statistics, torque_rows, result, extremes, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Margins of each lobe shape
      type(margins_t), intent(in) :: margins(:)
      !> Rows of each lobe shape; more are added
      type(statistics_t), intent(inout) :: statistics(:)
      !> Rows of the camshaft; more are added
      type(samples_t), intent(inout) :: torque_rows
      !> List of series
      type(result_t), intent(in) :: result
      !> The extremes
      type(extremes_t), intent(out) :: extremes
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: columns(2), lobe

      allocate (extremes%lowest(size(result%series)), extremes%highest(size(result%series)), &
         & extremes%event_load(size(solved%models)))
      do lobe = 1, size(solved%models)
         columns = lobe_columns(solved%case, lobe)
         associate (samples => statistics(lobe)%rows)
            call add_stops(solved, lobe, margins(lobe), samples, error)
            call find_thickest_film(result%series, statistics(lobe))
            if (.not. allocated(error)) call search_lobe(solved, lobe, result%series(columns(1):columns(2)), statistics(lobe), &
               & extremes%lowest(columns(1):columns(2)), extremes%highest(columns(1):columns(2)), error)
            if (.not. allocated(error)) call judge_extremes(result%series(columns(1):columns(2)), &
               & extremes%lowest(columns(1):columns(2)), extremes%highest(columns(1):columns(2)), statistics(lobe))
            if (allocated(error)) return
            if (allocated(solved%cycles(lobe)%flexible)) then
               statistics(lobe)%extreme_error = solved%cycles(lobe)%flexible%error
               statistics(lobe)%worst_extreme = "contact_load"
            end if
            extremes%event_load(lobe) = smallest_event_load(solved%models(lobe), result, samples)
         end associate
      end do
      columns = camshaft_columns(solved%case)
      call search_camshaft(solved, torque_rows, extremes%lowest(columns(1):columns(2)), &
         & extremes%highest(columns(1):columns(2)), error)
   end subroutine find_extremes

   !> Rows of a lobe's follower at the stops, and at the smallest load of the event without friction.
   subroutine add_stops(solved, lobe, margins, samples, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> Its margins
      type(margins_t), intent(in) :: margins
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angles from full lift [rad]; a row [unit of the series]
      real(wp) :: angles(3*size(solved%cycles(lobe)%stops) + 1), values(size(samples%values, 1))
      integer :: hint, i

      hint = 1
      associate (stops => solved%cycles(lobe)%stops)
         angles = [stops - beside, stops, stops + beside, margins%event%angle]
      end associate
      do i = 1, size(angles)
         call state_at(solved%cycles(lobe), solved%models(lobe), angles(i), hint, state, error)
         if (allocated(error)) return
         call follower_values(solved%case, solved%models(lobe), state, values)
         call add_sample(samples, angles(i), values, i < size(angles))
      end do
   end subroutine add_stops

   !> Largest central film among the rows of a lobe, over the equivalent radius there.
   pure subroutine find_thickest_film(series, statistics)
      !> List of series, of which the first lobe's stand in the order of every lobe's
      type(quantity_t), intent(in) :: series(:)
      !> Statistics of the lobe, with the rows; out: with the film
      type(statistics_t), intent(inout) :: statistics

      integer :: row

      associate (rows => statistics%rows)
         associate (films => rows%values(find_quantity(series, "film_thickness_central"), :rows%count) &
            & /rows%values(find_quantity(series, "equivalent_radius"), :rows%count))
            row = maxloc(films, 1)
            statistics%thickest_film = films(row)
            statistics%thickest_angle = rows%angle(row)
         end associate
      end associate
   end subroutine find_thickest_film

   !> Smallest and largest values of a lobe's follower, from its rows and between them; the rows alone where the solution itself is
   !> only linear between its points.
   subroutine search_lobe(solved, lobe, list, statistics, lowest, highest, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> The series of the follower
      type(quantity_t), intent(in) :: list(:)
      !> Its statistics, with the rows; out: with the errors of the values
      type(statistics_t), intent(inout) :: statistics
      !> The values [unit of the series]
      real(wp), intent(out) :: lowest(:), highest(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(search_t) :: search
      type(state_t) :: state
      ! Series at a cam angle [unit of the series]
      real(wp) :: values(size(lowest))
      integer :: hint, series, sense

      hint = 1
      allocate (statistics%extreme_errors(2, size(lowest)))
      statistics%extreme_errors = 0.0_wp
      associate (model => solved%models(lobe), cycle => solved%cycles(lobe))
         do series = 1, size(lowest)
            do sense = -1, 1, 2
               call start_search(statistics%rows, series, sense, cycle%tolerance, search, &
                  & sense > 0 .and. index(list(series)%name, "film_") > 0)
               do while (search%is_wanted .and. .not. cycle%is_linear)
                  call state_at(cycle, model, search%trial, hint, state, error)
                  if (allocated(error)) return
                  call follower_values(solved%case, model, state, values)
                  call narrow_search(statistics%rows, search, values(series))
               end do
               if (sense > 0) lowest(series) = search%value
               if (sense < 0) highest(series) = -search%value
               ! Errors of a flexible train are those of its load and sliding speed
               if (allocated(cycle%flexible)) cycle
               call state_at(cycle, model, search%point, hint, state, error)
               if (allocated(error)) return
               associate (of_value => statistics%extreme_errors(merge(1, 2, sense > 0), series))
                  call error_of_extreme(statistics%slip_errors, solved, lobe, state, search%point, series, sense, &
                     & sense*search%value, of_value)
                  of_value = of_value + search%left
               end associate
            end do
         end do
      end associate
   end subroutine search_lobe

   !> Largest error of a smallest or largest value, relative to the range of its series; the smallest film counts by itself, and so
   !> does that of every film where the largest has no limit.
   pure subroutine judge_extremes(series, lowest, highest, statistics)
      !> The series of the follower
      type(quantity_t), intent(in) :: series(:)
      !> Smallest and largest values [unit of the series]
      real(wp), intent(in) :: lowest(:), highest(:)
      !> Statistics of the lobe; out: with the largest error
      type(statistics_t), intent(inout) :: statistics

      ! Errors over the range [-]
      real(wp) :: relative(size(series))
      ! Range that counts as none, whose quotients do not overflow [unit of the series]
      real(wp), parameter :: least = sqrt(tiny(1.0_wp))
      integer :: i

      associate (errors => statistics%extreme_errors)
         do i = 1, size(series)
            relative(i) = 0.0_wp
            ! A quantity that is zero throughout has no error
            if (.not. maxval(errors(:, i)) > 0.0_wp) cycle
            if (index(series(i)%name, "film_") > 0 .and. .not. has_film_limit(statistics)) then
               if (lowest(i) > least) relative(i) = errors(1, i)/lowest(i)
               cycle
            end if
            relative(i) = maxval(errors(:, i))/max(highest(i) - lowest(i), least)
            if (index(series(i)%name, "film_thickness_min") > 0) relative(i) = max(relative(i), errors(1, i)/max(lowest(i), least))
         end do
      end associate
      i = maxloc(relative, 1)
      statistics%extreme_error = relative(i)
      statistics%worst_extreme = series(i)%name
   end subroutine judge_extremes

   !> Smallest and largest values of the camshaft's series.
   subroutine search_camshaft(solved, samples, lowest, highest, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Rows of the camshaft; those of the stops are added
      type(samples_t), intent(inout) :: samples
      !> The values [unit of the series]
      real(wp), intent(out) :: lowest(:), highest(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(search_t) :: search
      ! Stops of all cams [rad]; a row [unit of the series]
      real(wp), allocatable :: stops(:)
      real(wp) :: values(size(lowest))
      integer :: i, series, sense

      stops = [(solved%cycles(solved%shaft%lobes(i))%stops + solved%shaft%phases(i), i=1, size(solved%shaft%lobes))]
      stops = [stops - beside, stops, stops + beside]
      do i = 1, size(stops)
         call camshaft_row(solved, stops(i), values, error)
         if (allocated(error)) return
         call add_sample(samples, stops(i), values, .true.)
      end do
      do series = 1, size(values)
         do sense = -1, 1, 2
            call start_search(samples, series, sense, maxval(solved%cycles%tolerance), search)
            do while (search%is_wanted .and. .not. any(solved%cycles%is_linear))
               call camshaft_row(solved, search%trial, values, error)
               if (allocated(error)) return
               call narrow_search(samples, search, values(series))
            end do
            if (sense > 0) lowest(series) = search%value
            if (sense < 0) highest(series) = -search%value
         end do
      end do
   end subroutine search_camshaft

   !> The camshaft's series at a cam angle.
   subroutine camshaft_row(solved, angle, values, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> The series [unit of the series]
      real(wp), intent(out) :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Torques on each camshaft [N m]
      real(wp) :: torques(torque_count, solved%shaft%count)

      call shaft_torques(solved, angle, state, torques, error)
      if (allocated(error)) return
      call camshaft_values(solved%case, torques, values)
   end subroutine camshaft_row

   !> Smallest contact load with the valve off its seat; over the whole cycle where it never leaves it.
   pure function smallest_event_load(model, result, samples) result(load)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Series
      type(result_t), intent(in) :: result
      !> Rows of the lobe
      type(samples_t), intent(in) :: samples
      !> The load [N]
      real(wp) :: load

      ! Part of the lift at the seat that counts as all of it at a stop [-]
      real(wp), parameter :: nearly = 1.0_wp - 1.0e-9_wp
      logical :: in_event(samples%count)

      associate (lift => samples%values(find_quantity(result%series, "valve_lift"), :samples%count), &
         & loads => samples%values(find_quantity(result%series, "contact_load"), :samples%count))
         in_event = lift > 0.0_wp .and. lift >= nearly*model%train%seat_lift
         if (.not. any(in_event)) in_event = .true.
         load = minval(loads, in_event)
      end associate
   end function smallest_event_load

end module camroller_report
