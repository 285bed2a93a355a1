!> The result of a case: series at the output angles and the summary.
!>
!> In: case, models, cycles. Out: `result_t`.
module camroller_case_result
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_bearing_remarks, only : judge_bearings
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_contact_forces, only : contact_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_cycle_remarks, only : judge_laws, judge_lobe
   use camroller_film_remarks, only : judge_films, judge_pin, judge_pressure, name_lobe
   use camroller_catalogue, only : follower_count, follower_values, camshaft_columns, camshaft_count, &
      & camshaft_values, lobe_columns, lobe_prefix
   use camroller_sampled_extremes, only : samples_t
   use camroller_follower_samples, only : contact_ahead, extend_trail, trail_t
   use camroller_lobe_curve, only : cam_values, curve_values
   use camroller_series_extremes, only : series_extremes_t, find_extremes, find_lobe_extremes
   use camroller_heat_remarks, only : judge_heat, judge_oil
   use camroller_joint_remarks, only : judge_joints
   use camroller_margins, only : margins_t, find_margins
   use camroller_oil_checks, only : rises_t
   use camroller_remarks, only : remark_t
   use camroller_result, only : result_t, quantity_t, check_numbers, find_quantity, series_name_length, severest
   use camroller_part_series, only : bearing_count, bearing_series_count
   use camroller_bearing_turn, only : complete_shaft
   use camroller_shaft, only : new_shaft, shaft_t, shaft_torques, solved_t
   use camroller_camshaft_statistics, only : mean_bearing_torque
   use camroller_means, only : statistics_t, integrate_lobe
   use camroller_flexible_report, only : compare_turns, flexible_means_t, integrate_turns, list_turns
   use camroller_state, only : state_t
   use camroller_summary, only : make_summary
   use camroller_torque_list, only : torque_count
   implicit none
   private

   public :: take_statistics, search_extremes, make_result, output_angles

   !> What followers of one lobe shape give their cams at the output angles less a phase
   type :: lobe_turn_t
      integer :: lobe = 1
      !> The phase [rad]
      real(wp) :: phase = 0.0_wp
      !> Torques [N m], last the energy residual [W], and force on the cam, zero without bearings [N], shape (value, angle)
      real(wp), allocatable :: values(:, :)
   end type lobe_turn_t

   !> Difference of two cam angles that is rounding [rad]
   real(wp), parameter :: rounding = 1.0e-13_wp

contains

   !> Means of all lobe shapes, with the rows and shares found on the way.
   subroutine take_statistics(case, series, models, cycles, statistics, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its series
      type(quantity_t), intent(in) :: series(:)
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
      ! The first lobe's follower, which stands for any, and the camshaft come first
      associate (listed => series(:follower_count(case) + camshaft_count(case)))
         do lobe = 1, size(models)
            if (allocated(cycles(lobe)%flexible)) then
               call integrate_flexible(case, listed, models(lobe), cycles(lobe), statistics(lobe), error)
            else
               call integrate_lobe(case, listed, models(lobe), cycles(lobe), statistics(lobe), error)
            end if
            if (allocated(error)) return
         end do
      end associate
   end subroutine take_statistics

   !> Means of a lobe shape whose train is flexible.
   subroutine integrate_flexible(case, series, model, cycle, statistics, error)
      type(case_t), intent(in) :: case
      !> Its series: those of one follower and of the camshaft
      type(quantity_t), intent(in) :: series(:)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      !> Its means
      type(statistics_t), intent(out) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(flexible_means_t) :: means
      real(wp) :: mean_errors(size(series)) ! [-]
      integer :: worst

      call integrate_turns(case, model, cycle%flexible, series, follower_count(case) + 1, means, error)
      if (allocated(error)) return
      call move_alloc(means%mean, statistics%mean)
      statistics%rows = means%rows
      statistics%torque_rows = means%torque_rows
      statistics%torques = means%torques
      statistics%shares_t = means%shares_t
      statistics%largest_sliding = means%largest_sliding
      statistics%error = cycle%flexible%error
      statistics%error_angle = cycle%flexible%error_angle
      call compare_turns(case, model, cycle%flexible, series, follower_count(case) + 1, means, mean_errors, &
         & statistics%missing_oil, error)
      if (allocated(error)) return
      worst = maxloc(mean_errors, 1)
      statistics%mean_error = mean_errors(worst)
      statistics%worst_mean = series(worst)%name
   end subroutine integrate_flexible

   !> Margins of each lobe shape, and extremes of its followers with their errors.
   subroutine search_extremes(case, series, models, cycles, statistics, margins, error)
      !> The case
      type(case_t), intent(in), target :: case
      !> Its series
      type(quantity_t), intent(in) :: series(:)
      !> Model of each lobe shape
      type(model_t), intent(in), target :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in), target :: cycles(:)
      !> Means of each lobe shape; out: with the extremes
      type(statistics_t), intent(inout) :: statistics(:)
      !> Margins of each lobe shape
      type(margins_t), allocatable, intent(out) :: margins(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(solved_t) :: solved
      integer :: lobe

      solved%case => case
      solved%models => models
      solved%cycles => cycles
      allocate (margins(size(models)))
      do lobe = 1, size(models)
         call find_margins(models(lobe), cycles(lobe)%stops, margins(lobe))
         call find_lobe_extremes(solved, lobe, series, margins(lobe), statistics(lobe), error)
         if (allocated(error)) return
      end do
   end subroutine search_extremes

   !> Series and summary of a case.
   subroutine make_result(case, series, models, cycles, margins, statistics, with_series, result, error)
      !> The case
      type(case_t), intent(in), target :: case
      !> Its series
      type(quantity_t), intent(in) :: series(:)
      !> Model of each lobe shape
      type(model_t), intent(in), target :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in), target :: cycles(:)
      !> Margins of each lobe shape
      type(margins_t), intent(in) :: margins(:)
      !> Means and extremes of each lobe shape; out: with the error of the mean torque of the bearings
      type(statistics_t), intent(inout), target :: statistics(:)
      !> Does the result hold series at the output angles, or the summary alone, which is the same?
      logical, intent(in) :: with_series
      !> The result
      type(result_t), intent(out) :: result
      !> Convergence or domain error; domain error where a law is used outside its range and the case forbids it
      type(error_t), allocatable, intent(out) :: error

      type(solved_t), target :: solved
      type(series_extremes_t) :: extremes
      ! Series of the camshaft at the angles of its means, smallest films of its bearings there
      type(samples_t) :: torque_rows, films
      ! Mean torque of the bearings of each camshaft [N m], means of series of single bearings [unit of each]
      real(wp), allocatable :: bearing_torque(:), of_bearings(:)
      ! Error of both [-]
      real(wp) :: bearing_error
      ! Name of the series that this is the error of
      character(len=series_name_length) :: worst
      integer :: lobe

      allocate (result%remarks(0))
      result%series = series
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
      call sample_output(solved, with_series, result, error)
      if (allocated(error)) return

      do lobe = 1, size(models)
         call judge_lobe(models(lobe), cycles(lobe), statistics(lobe), margins(lobe), merge(lobe, 0, size(models) > 1), &
            & result%remarks, error)
         if (allocated(error)) return
      end do
      allocate (bearing_torque(solved%shaft%count), of_bearings(bearing_series_count(case)))
      call mean_bearing_torque(solved, result%series, of_bearings, bearing_torque, bearing_error, worst, torque_rows, films, error)
      if (.not. allocated(error)) call judge_bearings(solved, films, result%remarks, error)
      if (allocated(error)) return
      if (allocated(cycles(1)%flexible) .and. .not. allocated(case%cam_bearings)) torque_rows = statistics(1)%torque_rows
      if (bearing_error > maxval(statistics%mean_error)) then
         statistics%mean_error = bearing_error
         statistics%worst_mean = worst
      end if
      lobe = maxloc(statistics%mean_error, 1)
      result%worst_mean = trim(lobe_prefix(lobe))//statistics(lobe)%worst_mean
      ! Torques have no names of other lobe shapes
      if (find_quantity(result%series, trim(result%worst_mean)) == 0) result%worst_mean = statistics(lobe)%worst_mean
      call find_extremes(solved, statistics, torque_rows, result%series, extremes, error)
      if (allocated(error)) return
      result%worst_extreme = statistics(maxloc(statistics%extreme_error, 1))%worst_extreme
      call make_summary(solved, statistics, bearing_torque, of_bearings, margins, extremes, result)
      call list_turns(cycles, result)
      call judge_extremes(case, models, statistics, result)
      call judge_temperature(case, solved%shaft, statistics, result%remarks)
      call judge_heat(solved, films, bearing_torque, result)
      if (.not. with_series) result%series_values = result%series_values(:0, :)
      call check_numbers(result, error)
   end subroutine make_result

   !> Remarks on the smallest and largest values of each lobe shape.
   subroutine judge_extremes(case, models, statistics, result)
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Statistics of each
      type(statistics_t), intent(in) :: statistics(:)
      !> Gets the remarks; has its summary
      type(result_t), intent(inout) :: result

      integer :: lobe, pin, pressure, first

      call judge_laws(models(1), result%remarks)
      do lobe = 1, size(models)
         first = size(result%remarks) + 1
         call judge_films(statistics(lobe), find_quantity(result%summary, "max_"//trim(lobe_prefix(lobe))// &
            & "asperity_friction_share") > 0, result%remarks)
         pressure = find_quantity(result%summary, "max_"//trim(lobe_prefix(lobe))//trim(severest("hertz_pressure", &
            & allocated(case%roller_profile))))
         call judge_pressure(models(lobe), result%summary_values(pressure), result%remarks)
         pin = find_quantity(result%summary, "min_"//trim(lobe_prefix(lobe))//"pin_film_min")
         if (pin > 0) call judge_pin(case%needle_bearing%film%roughness, result%summary_values(pin), result%remarks)
         if (allocated(models(lobe)%joints)) call judge_joints(models(lobe)%joints, models(lobe)%oil%viscosity, &
            & models(lobe)%speed, statistics(lobe), result%remarks)
         call name_lobe(result%remarks, first, merge(lobe, 0, size(models) > 1))
      end do
   end subroutine judge_extremes

   !> Remarks on a temperature of oil or surfaces far from all at which their laws are given, or beyond what they are estimated for.
   subroutine judge_temperature(case, shaft, statistics, remarks)
      type(case_t), intent(in) :: case
      !> Its camshafts
      type(shaft_t), intent(in) :: shaft
      !> Statistics of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Get the remarks
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      type(rises_t) :: rises

      rises%film = maxval(statistics%hot_film%rise)
      if (allocated(shaft%rises)) rises%bearing = max(0.0_wp, maxval(shaft%rises))
      rises%surface = maxval(statistics%hot_film%surface_rise)
      call judge_oil(case, case%operating_point%oil_temperature, rises, remarks)
   end subroutine judge_temperature

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
   !> The states of a follower are solved once for all cams of the shape whose phases differ by whole output steps.
   subroutine sample_output(solved, with_followers, result, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Are the series of followers wanted, or those of the camshafts alone?
      logical, intent(in) :: with_followers
      !> In: list of series, with room for as many angles as there are wanted; out: with their values
      type(result_t), intent(inout) :: result
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(lobe_turn_t), allocatable :: turns(:)
      ! Turn that each cam takes part in, and by how many output steps it is behind
      integer :: turn_of(size(solved%shaft%lobes)), behind(size(solved%shaft%lobes))
      ! Torques on each camshaft [N m]; what each cam takes [N m, N]
      real(wp) :: torques(torque_count, solved%shaft%count), cams(curve_values, size(solved%shaft%lobes))
      real(wp) :: row(size(result%series)) ! [unit of each series]
      ! States of the bearings; allocated where they have series
      type(bearing_state_t), allocatable :: bearings(:, :)
      integer :: columns(2), i, k, cam, angles

      angles = size(result%series_values, 1)
      if (angles == 0) return
      if (.not. with_followers) result%series_values = 0.0_wp
      allocate (turns(0))
      do k = 1, merge(size(solved%models), 0, with_followers)
         turns = [turns, lobe_turn_t(lobe=k)]
      end do
      do cam = 1, size(turn_of)
         call join_turn(turns, solved%shaft%lobes(cam), solved%shaft%phases(cam), two_pi/angles, turn_of(cam), behind(cam))
      end do
      do k = 1, size(turns)
         call solve_turn(solved, turns(k), with_followers .and. k <= size(solved%models), result, error)
         if (allocated(error)) return
      end do
      if (bearing_count(solved%case) > 0) allocate (bearings(bearing_count(solved%case), solved%shaft%count))
      columns = camshaft_columns(solved%case)
      do i = 1, angles
         do cam = 1, size(turn_of)
            cams(:, cam) = turns(turn_of(cam))%values(:, 1 + modulo(i - 1 - behind(cam), angles))
         end do
         call shaft_torques(solved, result%angle(i)*degree - pi, torques, error, cams, bearings)
         if (allocated(error)) return
         call camshaft_values(solved%case, torques, row(columns(1):columns(2)), bearings)
         result%series_values(i, columns(1):columns(2)) = row(columns(1):columns(2))
      end do
   end subroutine sample_output

   !> Turn for a cam: one that is there and whose phase differs by whole output steps, or a new one.
   subroutine join_turn(turns, lobe, phase, step, number, behind)
      type(lobe_turn_t), allocatable, intent(inout) :: turns(:)
      !> Lobe shape of the cam
      integer, intent(in) :: lobe
      !> Its phase, output step [rad]
      real(wp), intent(in) :: phase, step
      !> Number of the turn, and by how many steps the cam is behind it
      integer, intent(out) :: number, behind

      do number = 1, size(turns)
         associate (difference => phase - turns(number)%phase)
            behind = nint(difference/step)
            if (turns(number)%lobe == lobe .and. abs(difference - behind*step) <= rounding) return
         end associate
      end do
      behind = 0
      turns = [turns, lobe_turn_t(lobe=lobe, phase=phase)]
   end subroutine join_turn

   !> Solve the states of a turn.
   subroutine solve_turn(solved, turn, is_wanted, result, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The turn; out: with its values
      type(lobe_turn_t), intent(inout) :: turn
      !> Are the series of the follower wanted?
      logical, intent(in) :: is_wanted
      !> Output angles; out: with the series of the follower
      type(result_t), intent(inout) :: result
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      type(contact_t) :: nearby
      type(trail_t) :: trail
      real(wp) :: angle ! [rad]
      real(wp) :: row(size(result%series)) ! [unit of each series]
      integer :: columns(2), i, hint

      hint = 1
      columns = lobe_columns(solved%case, turn%lobe)
      state%contact%is_touching = .false.
      allocate (turn%values(curve_values, size(result%series_values, 1)))
      associate (model => solved%models(turn%lobe), cycle => solved%cycles(turn%lobe))
         do i = 1, size(turn%values, 2)
            angle = result%angle(i)*degree - pi - turn%phase
            nearby = contact_ahead(trail, angle, state%contact)
            call state_at(cycle, model, angle, hint, state, error, nearby)
            if (allocated(error)) return
            call extend_trail(trail, angle, state%contact)
            turn%values(:, i) = cam_values(model, state)
            if (is_wanted) then
               call follower_values(solved%case, model, state, row(columns(1):columns(2)))
               result%series_values(i, columns(1):columns(2)) = row(columns(1):columns(2))
            end if
         end do
      end associate
   end subroutine solve_turn

end module camroller_case_result
