!> What a listed effect brings with it, and that an absent one leaves no trace.
module test_effects
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_effect_list, only : effect_names, effect_bearings, effect_ehl, effect_needle, effect_pressure, leave_out
   use camroller_effect_bearings, only : mean_bearing_torque
   use camroller_effect_survey, only : make_survey, survey_t
   use camroller_model, only : model_t, new_model, revise_model
   use camroller_result, only : result_t, quantity_t, find_quantity, get_summary
   use camroller_kept_models, only : kept_models_t
   use camroller_run, only : build_models, run_case, run_next_case
   use camroller_state, only : evaluate_state, state_t
   use closeness, only : check_close, expect_success, has_failed
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case, source_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_effects

contains

   subroutine collect_effects(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("camshaft bearings change no bit of any other result", test_bearings), &
         new_unittest("without bearings several cams keep every bit of their other results", test_several_cams), &
         new_unittest("with energy 'source' the valve guide changes no bit of any other result", test_guide), &
         new_unittest("with energy 'source' the needle bearing changes no bit of the load", test_needle), &
         new_unittest("an absent effect has no series and no scalar", test_absent), &
         new_unittest("a case run after other cases has the same bits as alone", test_kept), &
         new_unittest("bearings of a single cam with the second lobe shape are not surveyed, and kept", &
            & test_lobe), &
         new_unittest("bearings with orbits or heat have at surveyed loads the torque of the cycle, others that of each angle", &
            & test_over_turn), &
         new_unittest("a model without an effect has the bits of a new one, with films kept, solved again or by a formula", &
            & test_revised), &
         new_unittest("leaving out the bearings leaves out the second lobe shape", test_without_bearings) &
         ]
   end subroutine collect_effects

   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      integer :: k

      do k = 1, 2
         case = thesis_case()
         if (k == 2) case = source_case()
         call set_point(case, point_speeds(k + 1), point_viscosities(k))
         call run(case, without, error)
         if (allocated(error)) return
         call add_bearings(case)
         call run(case, with, error)
         if (.not. allocated(error)) call compare(without, with, "torque_bearings", error)
         if (allocated(error)) return
      end do
   end subroutine test_bearings

   subroutine test_several_cams(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      type(error_t), allocatable :: failure

      call get_deck_case("decks/three_cam_head.nml", case, failure)
      call expect_success(error, failure)
      if (.not. allocated(error)) call run(case, with, error)
      if (allocated(error)) return
      call leave_out(case, effect_bearings)
      call run(case, without, error)
      if (.not. allocated(error)) call check(error, find_quantity(without%series, "torque_bearings"), 0, "bearings are left")
      if (.not. allocated(error)) call compare(without, with, "torque_bearings", error)
   end subroutine test_several_cams

   !> The loads are on straight lines between the angles of the survey.
   subroutine test_over_turn(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(2) = [character(len=24) :: "decks/journal_orbits.nml", "decks/warm_bearings.nml"]
      ! The accuracy with which a bearing is followed over the turn [-]
      real(wp), parameter :: allowed = 1.0e-2_wp
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(survey_t) :: survey
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Mean torques over the turn, at each angle, of the cycle [N m]
      real(wp) :: followed, steady, expected
      integer :: i

      do i = 1, size(decks)
         ! with thin oil, where an orbit in the other direction would take 4 % more
         call get_deck_case(trim(decks(i)), case, failure, number=6)
         if (.not. allocated(failure)) call build_models(case, models, failure)
         if (.not. allocated(failure)) call make_survey(models(1), survey)
         if (.not. allocated(failure)) call mean_bearing_torque(case, models(1), survey, .true., followed, failure)
         if (.not. allocated(failure)) call run_case(case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "mean_torque_bearings", expected, failure)
         call expect_success(error, failure)
         if (.not. allocated(error)) call check_close(error, followed, expected, allowed, "over the turn: "//decks(i))
         if (allocated(error)) return
         if (allocated(case%bearing_heat)) deallocate (case%bearing_heat)
         case%cam_bearings%journal_motion = "quasi_steady"
         call mean_bearing_torque(case, models(1), survey, .true., followed, failure)
         if (.not. allocated(failure)) call mean_bearing_torque(case, models(1), survey, .false., steady, failure)
         call expect_success(error, failure)
         if (.not. allocated(error)) call check_close(error, followed, steady, allowed, "quasi-steady: "//decks(i))
         if (allocated(error)) return
      end do
   end subroutine test_over_turn

   subroutine test_revised(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: effects(3) = [effect_needle, effect_pressure, effect_ehl]
      ! Cam angles [rad], sliding speed [m/s]
      real(wp), parameter :: angles(3) = [-0.7_wp, 0.1_wp, 3.0_wp], sliding_speed = 0.02_wp
      type(case_t) :: case, variant
      type(model_t) :: model, revised, new
      type(state_t) :: states(2)
      type(error_t), allocatable :: failure
      integer :: i, place, status(2)

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(2))
      case%lubricant%pressure_law = "roelands"
      allocate (case%ehl)
      case%ehl%accuracy = 0.05_wp
      call new_model(model, case, 1, failure)
      do i = 1, size(effects)
         variant = case
         call leave_out(variant, effects(i))
         revised = model
         if (.not. allocated(failure)) call revise_model(revised, variant, failure)
         if (.not. allocated(failure)) call new_model(new, variant, 1, failure)
         if (has_failed(failure, error)) return
         do place = 1, size(angles)
            call evaluate_state(revised, angles(place), sliding_speed, states(1), status(1))
            call evaluate_state(new, angles(place), sliding_speed, states(2), status(2))
            call check(error, all(status == 0) .and. all(bits_of(states(1)) == bits_of(states(2))), &
               & "bits without "//trim(effect_names(effects(i))))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_revised

   !> Bits of what a contact gives.
   pure function bits_of(state) result(bits)
      type(state_t), intent(in) :: state
      integer(int64) :: bits(3)

      bits = transfer([state%contact%load, state%contact%film_min, state%contact%shear], bits)
   end function bits_of

   subroutine test_guide(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without

      case = source_case()
      call run(case, with, error)
      if (allocated(error)) return
      deallocate (case%valve_guide)
      call run(case, without, error)
      if (.not. allocated(error)) call compare(without, with, "torque_guide", error)
   end subroutine test_guide

   ! Its torque brakes the roller in either bookkeeping, so that spin and what depends on it do change
   subroutine test_needle(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=20) :: "contact_load", "hertz_half_width", "hertz_pressure", &
         "rolling_speed", "cam_surface_speed", "torque_geometric"]
      type(case_t) :: case
      type(result_t) :: with, without
      integer :: i

      case = source_case()
      call run(case, with, error)
      if (allocated(error)) return
      deallocate (case%needle_bearing)
      call run(case, without, error)
      if (allocated(error)) return
      do i = 1, size(names)
         call check(error, all(same_bits(with%series_values(:, find_quantity(with%series, names(i))), &
            without%series_values(:, find_quantity(without%series, names(i))))), trim(names(i))//" has changed")
         if (allocated(error)) return
      end do
      i = find_quantity(with%series, "sliding_speed")
      call check(error, .not. all(same_bits(with%series_values(:, i), without%series_values(:, i))), "the roller is not braked")
   end subroutine test_needle

   subroutine test_without_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: with, without
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      the_case%numerics%method = "automatic"
      call add_bearings(the_case)
      the_case%second_lift = the_case%lift
      call run_case(the_case, with, failure)
      ! Bearings of a single cam change no bit of the slip
      the_case%effects%select = "needed"
      the_case%effects%quantity = "slip"
      if (.not. allocated(failure)) call run_case(the_case, without, failure)
      if (has_failed(failure, error)) return
      call check(error, find_quantity(with%series, "lobe_2_contact_load") > 0 .and. find_quantity(with%series, &
         & "torque_bearings") > 0, "the case has no second lobe shape or no bearings")
      if (allocated(error)) return
      call check(error, find_quantity(without%series, "torque_bearings") == 0, "the bearings are still there")
      if (allocated(error)) return
      call check(error, find_quantity(without%series, "lobe_2_contact_load") == 0 .and. &
         & size(without%series_values, 2) == size(without%series), "the second lobe shape is still there")
   end subroutine test_without_bearings

   subroutine test_kept(error)
      type(error_type), allocatable, intent(out) :: error
      type(kept_models_t) :: kept
      type(case_t) :: the_case
      type(result_t) :: alone, after
      type(error_t), allocatable :: failure
      character(len=*), parameter :: trains(8) = [character(len=14) :: "as it is", "as it is", "as it is", "as it is", &
         & "another lift", "another spring", "another spring", "another way"]
      integer :: k

      the_case = thesis_case()
      the_case%numerics%method = "automatic"
      do k = 1, 8
         select case (k)
         case (2)
            call set_point(the_case, point_speeds(3), point_viscosities(1))
         case (3)
            deallocate (the_case%asperity, the_case%valve_guide)
         case (4)
            the_case%film%law = "moes"
            the_case%lubricant%pressure_law = "roelands"
         case (5)
            the_case%lift%max_lift = 8.0e-3_wp
         case (6)
            the_case%spring%stiffness = 30.0e3_wp
         case (7)
            the_case%effects%select = "needed"
         case (8)
            the_case%mechanism%rotation = "towards_pivot"
         end select
         call run_case(the_case, alone, failure)
         if (.not. allocated(failure)) call run_next_case(kept, trains(k), the_case, after, failure)
         if (has_failed(failure, error)) return
         call check(error, all(same_bits(alone%series_values, after%series_values)) .and. &
            all(same_bits(alone%summary_values, after%summary_values)), "a bit has changed")
         if (allocated(error)) return
      end do
   end subroutine test_kept

   subroutine test_absent(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: effects(*) = [character(len=14) :: "asperity", "needle_bearing", "valve_guide", &
         "cam_bearings"]
      type(case_t) :: case, variant
      type(result_t) :: result
      integer :: i

      case = thesis_case()
      call add_bearings(case)
      call run(case, result, error)
      if (allocated(error)) return
      do i = 1, size(effects)
         call check(error, has_source(result%series, effects(i)) .and. has_source(result%summary, effects(i)), &
            trim(effects(i))//" has no series")
         if (allocated(error)) return
      end do
      do i = 1, size(effects)
         variant = case
         if (effects(i) == "asperity") deallocate (variant%asperity)
         if (effects(i) == "needle_bearing") deallocate (variant%needle_bearing)
         if (effects(i) == "valve_guide") deallocate (variant%valve_guide)
         if (effects(i) == "cam_bearings") deallocate (variant%cam_bearings)
         call run(variant, result, error)
         if (allocated(error)) return
         call check(error, .not. (has_source(result%series, effects(i)) .or. has_source(result%summary, effects(i))), &
            trim(effects(i))//" is absent and has a series or a scalar")
         if (allocated(error)) return
      end do
   end subroutine test_absent

   !> Does any quantity come from an effect?
   pure function has_source(quantities, source) result(has)
      type(quantity_t), intent(in) :: quantities(:)
      character(len=*), intent(in) :: source
      logical :: has
      integer :: i

      has = .false.
      do i = 1, size(quantities)
         has = has .or. quantities(i)%source == source
      end do
   end function has_source

   !> Everything of a result without an effect is there with it, bit by bit, and so is the work. Sums of losses are not compared,
   !> nor is the largest error of all extremes, which takes in what the effect adds.
   subroutine compare(without, with, added, error)
      type(result_t), intent(in) :: without, with
      character(len=*), intent(in) :: added
      type(error_type), allocatable, intent(out) :: error
      integer :: i, other, compared

      compared = 0
      do i = 1, size(without%series)
         other = find_quantity(with%series, without%series(i)%name)
         call check(error, other > 0, without%series(i)%name//" is missing")
         if (allocated(error)) return
         if (is_sum(without%series(i)%name)) cycle
         call check(error, all(same_bits(without%series_values(:, i), with%series_values(:, other))), &
            without%series(i)%name//" has changed")
         if (allocated(error)) return
         compared = compared + 1
      end do
      do i = 1, size(without%summary)
         other = find_quantity(with%summary, without%summary(i)%name)
         call check(error, other > 0, without%summary(i)%name//" is missing")
         if (allocated(error)) return
         if (is_sum(without%summary(i)%name)) cycle
         call check(error, same_bits(without%summary_values(i), with%summary_values(other)), &
            without%summary(i)%name//" has changed")
         if (allocated(error)) return
         compared = compared + 1
      end do
      call check(error, compared > 60, "hardly anything is compared")
      if (allocated(error)) return
      other = find_quantity(with%series, added)
      call check(error, maxval(abs(with%series_values(:, other))) > 0.0_wp, added//" is zero")
   end subroutine compare

   !> Is a quantity a sum over all losses, relative to one, or the largest error of all series?
   pure function is_sum(name)
      character(len=*), intent(in) :: name
      logical :: is_sum

      is_sum = index(name, "torque_friction") + index(name, "torque_drive") + index(name, "power_friction") &
         + index(name, "work_friction") + index(name, "relative_energy_residual") &
         + index(name, "estimated_error_of_extremes") > 0
   end function is_sum

   !> Are two numbers the same, bit by bit?
   elemental function same_bits(one, other) result(same)
      real(wp), intent(in) :: one, other
      logical :: same

      same = storage_size(one) == 64 .and. transfer(one, 0_int64) == transfer(other, 0_int64)
   end function same_bits

   !> Camshaft bearings of Islam (2019), one cam midway.
   subroutine test_lobe(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(2))
      call add_bearings(case)
      case%second_lift = case%lift
      case%second_lift%max_lift = 0.5_wp*case%lift%max_lift
      case%cam_bearings%cam_lobes = [2]
      ! The slip knows nothing of the bearings
      case%effects%select = "needed"
      case%effects%quantity = "slip"
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, find_quantity(result%series, "torque_bearings") > 0, "the bearings are left out")
      if (allocated(error)) return
      call check(error, find_quantity(result%series, "lobe_2_contact_load") > 0, "the second lobe shape is left out")
   end subroutine test_lobe

   subroutine add_bearings(case)
      type(case_t), intent(inout) :: case

      allocate (case%cam_bearings)
      case%cam_bearings%law = "long_full_sommerfeld"
      case%cam_bearings%diameter = 23.0e-3_wp
      case%cam_bearings%width = 20.0e-3_wp
      case%cam_bearings%radial_clearance = 47.5e-6_wp
      case%cam_bearings%bearing_positions = [0.0_wp, 60.0e-3_wp]
      case%cam_bearings%cam_positions = [30.0e-3_wp]
      case%cam_bearings%cam_phases = [0.0_wp]
      case%cam_bearings%cam_lobes = [1]
      case%cam_bearings%follower_angles = [0.0_wp]
   end subroutine add_bearings

   !> Run a case with the default method.
   subroutine run(case, result, error)
      type(case_t), intent(in) :: case
      type(result_t), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: quick
      type(error_t), allocatable :: failure

      quick = case
      quick%numerics%method = "rodas5p"
      quick%numerics%tolerance = 1.0e-5_wp
      call run_case(quick, result, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine run

end module test_effects
