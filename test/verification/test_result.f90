!> Results as a whole: every lobe's series, extremes against a fine scan, finite numbers alone.
module test_result
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_positive_inf, ieee_quiet_nan, ieee_value
   use, intrinsic :: ieee_exceptions, only : ieee_all, ieee_get_halting_mode, ieee_set_flag, ieee_set_halting_mode
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, kind_domain
   use camroller_case, only : case_t
   use camroller_catalogue, only : follower_count, follower_values, list_series
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_dynamics, only : moment_slope, moments_t, seat_force, stored_energy, unseated_share
   use camroller_events, only : contact_losses
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t
   use camroller_means, only : statistics_t
   use camroller_result, only : result_t, check_numbers, find_quantity, get_summary, quantity_t
   use camroller_run, only : run_case
   use camroller_state, only : evaluate_loading, state_t
   use closeness, only : check_close, expect_error, has_failed
   use deck_cases, only : get_deck_case
   use lobe_cases, only : fast, low_lift, run, thesis_lift, two_lobes
   use reference_cases, only : thesis_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_result

contains

   subroutine collect_result(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a second lobe shape with the lift of the first has the series of the first", test_same_lobes), &
         new_unittest("series belong to a lobe shape, whatever its number", test_swapped_lobes), &
         new_unittest("the mean with the largest error is named with its lobe shape", test_worst_mean), &
         new_unittest("every series has a scope", test_scopes), &
         new_unittest("names of series of many bearings fit where a result names its worst mean", test_long_names), &
         new_unittest("lobe 1 has its series if the first cam has lobe 2", test_first_cam), &
         new_unittest("smallest and largest values agree with a fine scan", test_extremes), &
         new_unittest("extremes do not depend on the output step", test_coarse_output), &
         new_unittest("intervals without contact agree with a fine scan", test_intervals), &
         new_unittest("a series that is not finite is refused, and the message has name, angle and value", test_gate), &
         new_unittest("a case whose formulas overflow ends with an error", test_overflow), &
         new_unittest("a lift below zero gives finite numbers where there is no seat force", test_dip) &
         ]
   end subroutine collect_result

   !> Have two results the same series and scalars under two names, bit by bit?
   subroutine compare_named(error, one, prefix, other, other_prefix)
      type(error_type), allocatable, intent(out) :: error
      type(result_t), intent(in) :: one, other
      character(len=*), intent(in) :: prefix, other_prefix
      character(len=*), parameter :: series(*) = [character(len=24) :: "contact_load", "sliding_speed", "film_thickness_min", &
         "friction_contact"]
      character(len=*), parameter :: scalars(*) = [character(len=24) :: "margin_event", "margin_pivot_speed", &
         "lost_contact_share", "outside_film_range_share", "revolution_slip", "spring_margin"]
      character(len=*), parameter :: statistics(*) = [character(len=5) :: "mean_", "min_", "max_"]
      integer :: i, k

      do i = 1, size(series)
         associate (a => one%series_values(:, find_quantity(one%series, prefix//trim(series(i)))), &
            b => other%series_values(:, find_quantity(other%series, other_prefix//trim(series(i)))))
            call check(error, all(transfer(a, 0_int64, size(a)) == transfer(b, 0_int64, size(b))), trim(series(i)))
         end associate
         if (allocated(error)) return
         do k = 1, size(statistics)
            call compare_scalar(error, one, trim(statistics(k))//prefix//trim(series(i)), other, &
               trim(statistics(k))//other_prefix//trim(series(i)))
            if (allocated(error)) return
         end do
      end do
      do i = 1, size(scalars)
         call compare_scalar(error, one, prefix//trim(scalars(i)), other, other_prefix//trim(scalars(i)))
         if (allocated(error)) return
      end do
   end subroutine compare_named

   subroutine compare_scalar(error, one, name, other, other_name)
      type(error_type), allocatable, intent(out) :: error
      type(result_t), intent(in) :: one, other
      character(len=*), intent(in) :: name, other_name
      type(error_t), allocatable :: failure
      real(wp) :: values(2)

      call get_summary(one, name, values(1), failure)
      if (.not. allocated(failure)) call get_summary(other, other_name, values(2), failure)
      if (has_failed(failure, error)) return
      call check(error, transfer(values(1), 0_int64) == transfer(values(2), 0_int64), name//" and "//other_name//" differ")
   end subroutine compare_scalar

   subroutine test_same_lobes(error)
      type(error_type), allocatable, intent(out) :: error
      type(result_t) :: result

      call run(two_lobes(thesis_lift(), thesis_lift(), [1, 2]), result, error)
      if (.not. allocated(error)) call compare_named(error, result, "", result, "lobe_2_")
   end subroutine test_same_lobes

   subroutine test_swapped_lobes(error)
      type(error_type), allocatable, intent(out) :: error
      type(result_t) :: one, other

      call run(two_lobes(thesis_lift(), low_lift(), [1, 2]), one, error)
      if (.not. allocated(error)) call run(two_lobes(low_lift(), thesis_lift(), [2, 1]), other, error)
      if (.not. allocated(error)) call compare_named(error, one, "", other, "lobe_2_")
      if (.not. allocated(error)) call compare_named(error, one, "lobe_2_", other, "")
      ! the camshaft is the same one, so its torques are, too
      if (.not. allocated(error)) call compare_scalar(error, one, "max_torque_bearings", other, "max_torque_bearings")
   end subroutine test_swapped_lobes

   !> Without the inertia of the roller means err by far more than those of bearings: by most where one of both lobes has them.
   subroutine test_worst_mean(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: one, other

      case = two_lobes(thesis_lift(), low_lift(), [1, 2])
      case%numerics%method = "quasi_static"
      call run(case, one, error)
      if (allocated(error)) return
      case = two_lobes(low_lift(), thesis_lift(), [2, 1])
      case%numerics%method = "quasi_static"
      call run(case, other, error)
      if (allocated(error)) return
      call check(error, one%worst_mean == "lobe_2_"//other%worst_mean .or. other%worst_mean == "lobe_2_"//one%worst_mean, &
         & trim(one%worst_mean)//", "//trim(other%worst_mean))
   end subroutine test_worst_mean

   subroutine test_scopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(result_t) :: result
      type(case_t) :: case
      integer :: i, of_lobe

      case = two_lobes(thesis_lift(), low_lift(), [1, 2])
      call list_series(case, result%series)
      of_lobe = follower_count(case)
      do i = 1, size(result%series)
         associate (series => result%series(i))
            if (index(series%name, "lobe_2_") == 1) then
               call check(error, series%scope, "lobe 2")
            else if (index(series%name, "torque_") == 1 .or. series%name == "energy_residual") then
               call check(error, series%scope, "camshaft")
            else
               call check(error, series%scope, "lobe 1")
            end if
         end associate
         if (allocated(error)) return
      end do
      call check(error, count(result%series%scope == "lobe 1"), of_lobe)
      if (.not. allocated(error)) call check(error, count(result%series%scope == "lobe 2"), of_lobe)
   end subroutine test_scopes

   subroutine test_long_names(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(quantity_t), allocatable :: series(:)
      type(result_t) :: result
      type(statistics_t) :: statistics
      type(error_t), allocatable :: failure
      integer :: room, i

      call get_deck_case("decks/four_cylinder.nml", case, failure)
      if (has_failed(failure, error)) return
      allocate (case%bearing_heat, case%bearing_asperity)
      case%bearing_asperity%roughness = 1.0e-6_wp
      case%cam_bearings%by_bearing = .true.
      case%cam_bearings%bearing_positions = [(0.01_wp*i, i=1, 12)]
      call list_series(case, series)
      call check(error, find_quantity(series, "camshaft_2_bearing_12_temperature_rise") > 0, "names")
      room = min(len(result%worst_mean), len(result%worst_extreme), len(statistics%worst_mean), len(statistics%worst_extreme))
      do i = 1, size(series)
         if (allocated(error)) return
         call check(error, len(series(i)%name) <= room, series(i)%name)
      end do
   end subroutine test_long_names

   subroutine test_first_cam(error)
      type(error_type), allocatable, intent(out) :: error
      type(result_t) :: one, other

      call run(two_lobes(thesis_lift(), low_lift(), [1, 2]), one, error)
      if (.not. allocated(error)) call run(two_lobes(thesis_lift(), low_lift(), [2, 1]), other, error)
      if (.not. allocated(error)) call compare_named(error, one, "", other, "")
      if (.not. allocated(error)) call compare_named(error, one, "lobe_2_", other, "lobe_2_")
   end subroutine test_first_cam

   subroutine test_extremes(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(result_t) :: result
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Values of a row; smallest and largest of the scan and of the result; what the extremes may differ by over their range
      real(wp), allocatable :: values(:), lowest(:), highest(:)
      real(wp) :: ends(2), range
      ! A gain of 1e-6 is not worth a value; as much again for what the parabola leaves out
      real(wp), parameter :: allowed = 2.0e-6_wp
      ! A hundredth of a degree: what a valley twenty degrees wide loses between two points is 1e-7 of its depth
      integer, parameter :: steps = 36000
      integer :: i, hint, point

      do point = 1, 2
         case = thesis_case()
         call set_point(case, point_speeds(3), point_viscosities(2*point - 1))
         call run(case, result, error)
         if (allocated(error)) return
         call make_model(case, model, error)
         if (allocated(error)) return
         call integrate_cycle(cycle, model, case%numerics, failure)
         if (has_failed(failure, error)) return
         allocate (values(follower_count(case)), lowest(follower_count(case)), highest(follower_count(case)))
         lowest = huge(1.0_wp)
         highest = -lowest
         hint = 1
         do i = 1, steps
            call state_at(cycle, model, two_pi*i/steps - pi, hint, state, failure)
            if (has_failed(failure, error)) return
            call follower_values(case, model, state, values)
            lowest = min(lowest, values)
            highest = max(highest, values)
         end do
         do i = 1, size(values)
            associate (name => result%series(i)%name)
               call get_summary(result, "min_"//name, ends(1), failure)
               if (.not. allocated(failure)) call get_summary(result, "max_"//name, ends(2), failure)
               if (has_failed(failure, error)) return
               range = highest(i) - lowest(i)
               call check(error, ends(1) <= lowest(i) + allowed*range, "min_"//name//" is too large")
               if (allocated(error)) return
               call check(error, ends(2) >= highest(i) - allowed*range, "max_"//name//" is too small")
               if (allocated(error)) return
               call check(error, ends(1) >= lowest(i) - 1.0e-3_wp*range .and. ends(2) <= highest(i) + 1.0e-3_wp*range, &
                  name//" goes beyond what the cycle has")
               if (allocated(error)) return
            end associate
         end do
         deallocate (values, lowest, highest)
      end do
   end subroutine test_extremes

   subroutine test_coarse_output(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: fine, coarse
      type(error_t), allocatable :: failure
      real(wp) :: values(2)
      character(len=*), parameter :: names(*) = [character(len=24) :: "min_contact_load", "max_contact_load", &
         "min_film_thickness_min", "max_hertz_pressure", "max_torque_geometric"]
      integer :: i

      case = thesis_case()
      call run(case, fine, error)
      if (allocated(error)) return
      case%numerics%output_step = 7.2_wp*degree
      call run(case, coarse, error)
      if (allocated(error)) return
      do i = 1, size(names)
         call get_summary(fine, trim(names(i)), values(1), failure)
         if (.not. allocated(failure)) call get_summary(coarse, trim(names(i)), values(2), failure)
         if (has_failed(failure, error)) return
         ! three vertices of parabolas from points 7 degrees apart: 1e-4 of the value
         call check_close(error, values(2), values(1), 1.0e-4_wp, trim(names(i)))
         if (allocated(error)) return
      end do
   end subroutine test_coarse_output

   subroutine test_intervals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(position_t) :: position
      type(moments_t) :: moments
      type(error_t), allocatable :: failure
      real(wp), allocatable :: intervals(:, :)
      real(wp) :: angle, gas
      integer, parameter :: steps = 7200
      integer :: i, status, lost
      logical :: inside

      case = thesis_case()
      call set_point(case, fast, point_viscosities(3))
      deallocate (case%valve_guide)
      call make_model(case, model, error)
      if (allocated(error)) return
      call integrate_cycle(cycle, model, case%numerics, failure)
      if (has_failed(failure, error)) return
      intervals = contact_losses(model, cycle%stops)
      lost = 0
      do i = 1, steps
         angle = cycle%start + two_pi*i/steps
         call evaluate_loading(model, angle, position, gas, moments, status)
         inside = any(angle > intervals(1, :) .and. angle < intervals(2, :))
         if (inside) lost = lost + 1
         call check(error, inside .eqv. (moments%total <= 0.0_wp), "contact is lost where it is not, or kept where it is lost")
         if (allocated(error)) return
      end do
      call check(error, lost > steps/100, "contact is hardly lost")
   end subroutine test_intervals

   subroutine test_gate(error)
      type(error_type), allocatable, intent(out) :: error
      type(result_t) :: result, changed
      type(error_t), allocatable :: failure
      integer :: place

      call run(thesis_case(), result, error)
      if (allocated(error)) return
      call check_numbers(result, failure)
      if (has_failed(failure, error)) return
      changed = result
      place = find_quantity(result%series, "contact_load")
      changed%series_values(26, place) = ieee_value(1.0_wp, ieee_quiet_nan)
      call check_numbers(changed, failure)
      call expect_error(error, failure, kind_domain, "contact_load at cam angle 12.500 deg is not a number (NaN)")
      if (allocated(error)) return
      changed%series_values(26, place) = -ieee_value(1.0_wp, ieee_positive_inf)
      call check_numbers(changed, failure)
      call expect_error(error, failure, kind_domain, "contact_load at cam angle 12.500 deg is infinite")
      if (allocated(error)) return
      changed = result
      changed%summary_values(find_quantity(result%summary, "mean_torque_drive")) = ieee_value(1.0_wp, ieee_positive_inf)
      call check_numbers(changed, failure)
      call expect_error(error, failure, kind_domain, "mean_torque_drive is infinite")
      if (allocated(error)) return
      ! the speed at which contact would be lost on the base circle is infinite, and may be
      changed = result
      place = find_quantity(result%summary, "margin_base_circle_speed")
      call check(error, .not. ieee_is_finite(result%summary_values(place)), "a finite speed of loss")
      if (allocated(error)) return
      changed%summary_values(place) = ieee_value(1.0_wp, ieee_quiet_nan)
      call check_numbers(changed, failure)
      call expect_error(error, failure, kind_domain, "margin_base_circle_speed is not a number")
   end subroutine test_gate

   subroutine test_overflow(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      logical :: halting(size(ieee_all))

      ! journals as wide as no number allows: their torque is not finite, and everything else is
      case = two_lobes(thesis_lift(), low_lift(), [1, 2])
      case%cam_bearings%diameter = 1.0e200_wp
      case%cam_bearings%law = "long_full_sommerfeld" ! The law of finite width refuses that width
      call ieee_get_halting_mode(ieee_all, halting)
      call ieee_set_halting_mode(ieee_all, .false.)
      call run_case(case, result, failure)
      call ieee_set_flag(ieee_all, .false.)
      call ieee_set_halting_mode(ieee_all, halting)
      call expect_error(error, failure, kind_domain, "torque_bearings at cam angle 0.000 deg is ")
   end subroutine test_overflow

   subroutine test_dip(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: gas, slope
      integer :: status

      case = thesis_case()
      case%energy = "source"
      case%spring%seating = "maximum"
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_loading(model, -pi, position, gas, moments, status)
      position%lift = -1.0e-20_wp
      call check(error, seat_force(model%train, position%lift), 0.0_wp, thr=0.0_wp)
      if (allocated(error)) return
      call check(error, unseated_share(model%train, position%lift), 1.0_wp, thr=0.0_wp)
      if (allocated(error)) return
      slope = moment_slope(model%train, position, model%speed, 0.0_wp, 0.0_wp)
      call check(error, ieee_is_finite(slope) .and. ieee_is_finite(stored_energy(model%train, position, model%speed)), &
         "slope or energy is not finite")
   end subroutine test_dip

end module test_result
