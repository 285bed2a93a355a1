!> Decks of flexible trains drawn at random: two unlike methods agree within what both promise, or words say why not. How they end
!> is counted and printed.
!>
!> The environment variables FLEXIBLE_CASES and FLEXIBLE_SEED choose how many and which; `make random-flexible` sets them. A case
!> takes seconds, where one of a rigid train takes milliseconds: a usual run has few. FLEXIBLE_ACCURACY asks for an accuracy, as
!> decks do, in the place of a loose tolerance. FLEXIBLE_DECK takes a deck of a file instead:
!> one that an earlier run has kept, whatever its seed draws by now.
module test_random_flexible
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_case, only : case_t, numerics_t
   use camroller_deck, only : deck_t, override_t, make_case, parse_deck
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_text_file, only : read_text_file
   use camroller_remarks, only : long_period, lost_contact, no_period, open_pivot
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : build_models, run_case
   use case_endings, only : tally_t, count_ending, count_error, count_remarks, endings_table
   use enclosed_series, only : check_enclosed
   use result_checks, only : check_numbers, check_sums, compare_results, promised_error, scalar_of, words_of_difference
   use run_settings, only : has_checks, number_from, value_from
   use wide_decks, only : wide_deck_t, draw_wide_deck, save_wide_deck
   use wide_draft, only : style_t
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_random_flexible

   !> Cases of a test run with and without run-time checks, and the seed of the first
   integer, parameter :: usual_cases = 4, few_cases = 1, usual_seed = 1
   !> Error of a step: as loose as is still of use, since a case takes hundreds of cycles [-]
   real(wp), parameter :: tolerance = 1.0e-3_wp
   !> Slowest camshaft: a train rings thousands of times in a slower turn, and each oscillation takes its steps [rad/s]
   real(wp), parameter :: slowest = 30.0_wp
   !> Decks of earlier campaigns in which two methods differed by more than both promised, or that had no rest; why stands in each
   character(len=*), parameter :: kept_decks(*) = [character(len=18) :: "slow_approach", "drifting_plunger", "bouncing_seat", &
      & "bent_steps", "pressure_corner", "little_leak", "rest_along_finger", "oscillating_roller"]
   !> The same at an accuracy of 1e-3, as decks ask for it: they take three quarters of the time, and with run-time checks the first
   !> stands for all
   character(len=*), parameter :: accurate_decks(*) = [character(len=16) :: "rippling_torques", "hot_limited_film", &
      & "bearing_pulses", "energy_kept", "long_steps"]

contains

   !> Collect the tests.
   subroutine collect_random_flexible(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("random flexible trains: two methods agree on load and losses, or a message says why not", test_flexible), &
         new_unittest("trains whose errors are more than those of a turn: two methods agree within what both promise", test_kept) &
         ]
   end subroutine collect_random_flexible

   subroutine test_flexible(error)
      type(error_type), allocatable, intent(out) :: error
      type(schema_t) :: schema
      type(wide_deck_t) :: deck
      type(tally_t) :: tally
      character(len=:), allocatable :: list, trouble
      character(len=40) :: buffer
      character(len=200) :: path
      integer :: seed, i, cases, status

      call get_environment_variable("FLEXIBLE_DECK", path, status=status)
      if (status == 0) then
         call check_file(trim(path), value_from("FLEXIBLE_ACCURACY", 0.0_wp), error)
         return
      end if
      call new_schema(schema)
      cases = number_from("FLEXIBLE_CASES", merge(few_cases, usual_cases, has_checks()))
      list = ""
      do i = 1, cases
         seed = number_from("FLEXIBLE_SEED", usual_seed) + i - 1
         call draw_wide_deck(seed, schema, style_t(ehl_share=0.0_wp, method_share=0.0_wp, dynamics_share=1.0_wp), deck)
         write (buffer, "(a, i0)") "FLEXIBLE_SEED=", seed
         ! One deck is kept however it ends, also where it is stopped
         if (cases == 1) call save_wide_deck(deck, trim(buffer(15:)), "")
         call check_deck(deck, "", value_from("FLEXIBLE_ACCURACY", 0.0_wp), tally, trouble)
         if (trouble == "") cycle
         call save_wide_deck(deck, trim(buffer(15:)), trouble)
         list = list//new_line("a")//trim(buffer)//":"//trouble
      end do
      write (error_unit, "(a)") endings_table(tally)
      if (list /= "") call test_failed(error, list)
   end subroutine test_flexible

   subroutine test_kept(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(kept_decks)
         call check_file("test/data/flexible_trains/"//trim(kept_decks(i))//"/deck.nml", value_from("FLEXIBLE_ACCURACY", 0.0_wp), &
            & error)
         if (allocated(error)) return
      end do
      do i = 1, merge(1, size(accurate_decks), has_checks())
         call check_file("test/data/flexible_trains/"//trim(accurate_decks(i))//"/deck.nml", 1.0e-3_wp, error)
         if (allocated(error)) return
      end do
   end subroutine test_kept

   !> A deck of a file, with the tables beside it.
   subroutine check_file(path, wanted, error)
      character(len=*), intent(in) :: path
      ! Accuracy in the place of a tolerance, where above zero [-]
      real(wp), intent(in) :: wanted
      type(error_type), allocatable, intent(out) :: error
      type(wide_deck_t) :: deck
      type(tally_t) :: tally
      ! Endings without a comparison
      character(len=*), parameter :: others(*) = [character(len=16) :: "not compared", "no model", "no result", &
         & "no second result", "deck refused"]
      type(error_t), allocatable :: read_error
      character(len=:), allocatable :: trouble, endings
      integer :: i

      call read_text_file(path, deck%text, read_error)
      if (has_failed(read_error, error)) return
      call check_deck(deck, path(:index(path, "/", back=.true.)), wanted, tally, trouble)
      endings = endings_table(tally)
      do i = 1, size(others)
         if (index(endings, trim(others(i))) > 0) trouble = trouble//new_line("a")//endings
      end do
      if (trouble /= "") call test_failed(error, path//":"//trouble)
   end subroutine check_file

   !> One deck: read, built, run by both methods.
   subroutine check_deck(deck, folder, wanted, tally, trouble)
      type(wide_deck_t), intent(in) :: deck
      ! Where tables are that it does not bring
      character(len=*), intent(in) :: folder
      ! Accuracy in the place of a tolerance, where above zero [-]
      real(wp), intent(in) :: wanted
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(out) :: trouble
      character(len=*), parameter :: methods(*) = [character(len=7) :: "rodas5p", "radau5"]
      type(deck_t) :: parsed
      type(override_t) :: none(0)
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(result_t) :: results(2)
      type(error_t), allocatable :: error
      integer :: i

      trouble = ""
      call parse_deck(parsed, deck%text, "random deck", folder, none, error, deck%tables)
      if (.not. allocated(error)) call make_case(parsed, none, case, error)
      if (allocated(error)) then
         call count_ending(tally, "deck refused")
         ! A contour that is drawn may have a hollow narrower than the roller
         if (index(error%message, "does not touch the contour") == 0) trouble = " a deck within all ranges is refused: "// &
            & error%message
         return
      end if
      case%numerics = numerics_t(tolerance=tolerance)
      if (wanted > 0.0_wp) case%numerics = numerics_t(accuracy=wanted)
      case%operating_point%speed = max(slowest, case%operating_point%speed)
      call build_models(case, models, error)
      if (allocated(error)) then
         call count_error(tally, error, "no model:", trouble)
         return
      end if
      do i = 1, size(methods)
         case%numerics%method = methods(i)
         call run_case(case, results(i), error)
         if (allocated(error)) then
            call count_error(tally, error, trim(merge("no result:         ", "  no second result:", i == 1)), trouble)
            return
         end if
         if (i == 1) call count_remarks(tally, results(i)%remarks)
         trouble = trouble//check_numbers(results(i))//check_sums(case, results(i))//missing_words(case, results(i)) &
            & //check_enclosed(case, results(i))
         if (allocated(case%lash_adjuster)) trouble = trouble//missing_oil(results(i))
      end do
      if (trouble == "") call compare(case, results(1), results(2), tally, trouble)
      if (trouble /= "") call count_ending(tally, "SILENT: a result that is not right")
   end subroutine check_deck

   !> What happens in a train and no remark tells. What the finger's weight would hold is no tension in its joint.
   function missing_words(case, result) result(trouble)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble

      real(wp), parameter :: gravity = 9.81_wp ! [m/s^2]

      trouble = ""
      associate (kinds => result%remarks%kind)
         if (scalar_of(result, "lost_contact_share") > 0.0_wp .and. all(kinds /= lost_contact)) trouble = &
            & " contact is lost without a word;"
         if (any(periods_of(result) == 0) .and. all(kinds /= no_period)) trouble = trouble//" no period, and no word of it;"
         if (any(periods_of(result) > 1) .and. all(kinds /= long_period)) trouble = trouble// &
            & " a period of several cycles without a word;"
         if (scalar_of(result, "joint_force_min_lowest") < -gravity*case%masses%finger .and. all(kinds /= open_pivot)) trouble = &
            & trouble//" the pivot's joint opens without a word;"
      end associate
   end function missing_words

   !> Cycles after which the train of each lobe shape repeats itself, 0 where it does not. None where the choice of effects has
   !> left a rigid train.
   pure function periods_of(result) result(periods)
      type(result_t), intent(in) :: result
      !> The cycles
      integer, allocatable :: periods(:)
      character(len=*), parameter :: names(*) = [character(len=20) :: "period_cycles", "lobe_2_period_cycles"]
      integer :: i, place

      allocate (periods(0))
      do i = 1, size(names)
         place = find_quantity(result%summary, trim(names(i)))
         if (place > 0) periods = [periods, nint(result%summary_values(place))]
      end do
   end function periods_of

   !> Oil that an adjuster leaks in a period and that does not enter, beyond the error estimated of means.
   function missing_oil(result) result(trouble)
      type(result_t), intent(in) :: result
      character(len=:), allocatable :: trouble
      ! Change of the oil's density with its pressure, air in it included [-]
      real(wp), parameter :: compression = 0.1_wp
      ! Mean flows [m^3/s]
      real(wp) :: leaks, enters

      trouble = ""
      leaks = scalar_of(result, "mean_leak_flow")
      enters = scalar_of(result, "mean_check_valve_flow")
      if (nint(scalar_of(result, "period_cycles")) == 1 .and. abs(enters - leaks) > (scalar_of(result, &
         & "estimated_error_of_means") + compression)*max(enters, leaks)) trouble = " oil that leaks does not enter;"
   end function missing_oil

   !> Two results of trains that repeat each cycle, since others have turns of their own: all that a rigid train is compared by,
   !> and the measures of a flexible one over the largest load, lift and speed of the valve.
   subroutine compare(case, one, other, tally, trouble)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: one, other
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(inout) :: trouble
      ! Measures, and what each is relative to
      character(len=*), parameter :: names(*) = [character(len=16) :: "dynamic_load_max", "dynamic_load_min", "joint_force_min", &
         & "surge_force", "lift_error_min", "lift_error_max", "seating_speed"]
      character(len=*), parameter :: scales(*) = [character(len=18) :: "max_contact_load", "max_contact_load", &
         & "max_contact_load", "max_contact_load", "max_valve_lift", "max_valve_lift", "max_valve_velocity"]
      ! Differences over the largest value, what both promise [-]
      real(wp) :: found, allowed
      integer :: i

      if (find_quantity(one%summary, "period_cycles") == 0) then
         call compare_results(case, one, other, trouble)
         return
      end if
      if (.not. (all(periods_of(one) == 1) .and. all(periods_of(other) == 1))) then
         call count_ending(tally, "  not compared: no period of one cycle, as a remark says")
         return
      end if
      call compare_results(case, one, other, trouble)
      allowed = promised_error(case, one, "estimated_error") + promised_error(case, other, "estimated_error")
      do i = 1, size(names)
         found = abs(scalar_of(one, trim(names(i))) - scalar_of(other, trim(names(i))))/max(abs(scalar_of(one, trim(scales(i)))), &
            & abs(scalar_of(other, trim(scales(i)))), tiny(1.0_wp))
         if (found > allowed) trouble = trouble//" "//trim(names(i))//words_of_difference(found, allowed)
      end do
   end subroutine compare

end module test_random_flexible
