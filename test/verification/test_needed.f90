!> Effects that the program leaves out change no more than it says.
!>
!> The environment variables NEEDED_CASES and NEEDED_SEED choose how many random cases and which; `make needed` sets them, and
!> NEEDED_TABLE, which asks for tables of how far below their estimates the changes are.
module test_needed
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, numerics_t, quantity_names
   use camroller_audit, only : judged
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t
   use camroller_effect_choice, only : choose_effects
   use camroller_effect_list, only : choice_t
   use camroller_model, only : model_t
   use camroller_number_text, only : integer_text
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : build_models, run_case
   use camroller_study_table, only : study_table_t, column_of
   use change_tally, only : tally_t, start_tally, audit, compare, print_tally
   use random_decks, only : random_t, start_random, random_deck
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   use run_settings, only : number_from
   use wide_decks, only : wide_deck_t, draw_wide_deck
   use wide_draft, only : style_t
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_needed

   !> Cases of a test run, with every option, which take as long as ten others, and the seed of the first
   integer, parameter :: usual_cases = 4, wide_cases = 1, usual_seed = 1
   !> Accuracy of the runs that are compared; of those that decide where a change seems larger than its estimate, since a mean in
   !> which much cancels is less accurate than what it is a mean of [-]
   real(wp), parameter :: accuracy = 1.0e-5_wp, high_accuracy = 1.0e-10_wp
   !> Part of the estimates that must be below what is negligible by default, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.1_wp
   !> Random decks whose changes are hard to bound: friction near its limit hands a small change of slip on to load and film; a spin
   !> that hardly anything damps, with a slip in which forward and backward sliding cancel; slip in a narrow stretch of the cycle;
   !> another such stretch; a slow decay from the end of the event on; torque that bends between the points of the quasi-static
   !> limit; slip below what counts as none, twice
   integer, parameter :: hard_seeds(*) = [7039, 7235, 1234, 54107, 55268, 50894, 403139, 700913]
   !> Those of which nothing is said, since the survey of the cycle does not resolve their slip
   integer, parameter :: unresolved_seeds(*) = [7235, 54107, 55268]

contains

   subroutine collect_needed(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("changes by leaving effects out are within their estimates, for random cases", test_random), &
         new_unittest("changes by leaving effects out are within their estimates, for random cases with every option", test_wide), &
         new_unittest("changes are within their estimates for decks whose changes are hard to bound", test_hard), &
         new_unittest("changes of every quantity are within the fraction allowed at the thesis's operating points", test_thesis), &
         new_unittest("with negligible = 0 every effect that changes anything is kept", test_zero), &
         new_unittest("an effect left out has no series, and the result has the scalars of the choice", test_left_out) &
         ]
   end subroutine collect_needed

   subroutine test_random(error)
      type(error_type), allocatable, intent(out) :: error
      type(tally_t) :: tally
      type(case_t) :: case
      character(len=:), allocatable :: text
      integer :: seed, tested, wanted, status
      logical :: is_known

      wanted = number_from("NEEDED_CASES", usual_cases)
      seed = number_from("NEEDED_SEED", usual_seed)
      call start_tally(tally)
      tested = 0
      do while (tested < wanted)
         call draw_case(seed, text, case, is_known)
         seed = seed + 1
         if (.not. is_known) cycle
         tested = tested + 1
         call compare_seed(seed - 1, text, case, tally)
      end do
      call get_environment_variable("NEEDED_TABLE", status=status)
      if (status == 0) call print_tally(tally, tested, seed)
      if (tally%misses == "" .and. sum(tally%small) < least_share*sum(tally%changes)) then
         tally%misses = new_line("a")//"hardly an estimate is small"
      end if
      if (tally%misses /= "") call test_failed(error, tally%misses)
   end subroutine test_random

   subroutine test_wide(error)
      type(error_type), allocatable, intent(out) :: error
      type(tally_t) :: tally
      type(schema_t) :: schema
      type(case_t) :: case
      character(len=:), allocatable :: text
      integer :: seed, tested, wanted, status
      logical :: is_known

      call new_schema(schema)
      wanted = number_from("NEEDED_CASES", wide_cases)
      seed = number_from("NEEDED_SEED", usual_seed)
      call start_tally(tally)
      tested = 0
      do while (tested < wanted)
         call draw_wide_case(seed, schema, text, case, is_known)
         seed = seed + 1
         if (.not. is_known) cycle
         tested = tested + 1
         call compare_seed(seed - 1, text, case, tally)
      end do
      call get_environment_variable("NEEDED_TABLE", status=status)
      if (status == 0) call print_tally(tally, tested, seed)
      if (tally%misses == "" .and. sum(tally%known) == 0) tally%misses = "nothing is estimated"
      if (tally%misses /= "") call test_failed(error, tally%misses)
   end subroutine test_wide

   subroutine test_hard(error)
      type(error_type), allocatable, intent(out) :: error
      type(tally_t) :: tally
      type(case_t) :: case
      character(len=:), allocatable :: text
      integer :: i
      logical :: is_known, is_valid

      call start_tally(tally)
      do i = 1, size(hard_seeds)
         call draw_case(hard_seeds(i), text, case, is_known, is_valid)
         if (is_known) then
            call compare_seed(hard_seeds(i), text, case, tally)
         else if (.not. (is_valid .and. any(unresolved_seeds == hard_seeds(i)))) then
            tally%misses = tally%misses//new_line("a")//"nothing is said of seed "//integer_text(hard_seeds(i))
         end if
      end do
      if (tally%misses == "" .and. sum(tally%known) == 0) tally%misses = "nothing is estimated"
      if (tally%misses /= "") call test_failed(error, tally%misses)
   end subroutine test_hard

   subroutine test_thesis(error)
      type(error_type), allocatable, intent(out) :: error
      type(study_table_t) :: table
      type(tally_t) :: tally
      type(case_t) :: case
      integer :: k

      call start_tally(tally)
      do k = 1, 3
         case = thesis_case()
         case%numerics%method = "automatic"
         case%numerics%tolerance = 0.0_wp
         case%effects%quantity = quantity_names(k)
         call set_point(case, point_speeds(k), point_viscosities(4 - k))
         call audit(case, accuracy, table)
         call compare(table, trim(quantity_names(k)), accuracy, tally)
      end do
      if (tally%misses /= "") call test_failed(error, tally%misses)
   end subroutine test_thesis

   subroutine test_zero(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, chosen
      type(model_t), allocatable :: models(:)
      type(choice_t) :: choice
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%effects%negligible = 0.0_wp
      call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, failure)
      if (has_failed(failure, error)) return
      call check(error, all(choice%decisions%is_used) .and. allocated(chosen%asperity) .and. allocated(chosen%needle_bearing) &
         .and. allocated(chosen%valve_guide), "an effect is missing")
      if (allocated(error)) return
      ! smooth surfaces never touch, and that is no estimate
      case%surface%cam_roughness = 1.0e-9_wp
      case%surface%roller_roughness = 1.0e-9_wp
      call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, failure)
      call check(error, .not. allocated(chosen%asperity) .and. choice%bound <= 0.0_wp, "surfaces that never touch have asperities")
   end subroutine test_zero

   subroutine test_left_out(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: listed, needed
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%numerics%method = "rodas5p"
      case%surface%cam_roughness = 1.0e-8_wp
      case%surface%roller_roughness = 1.0e-8_wp
      call run_case(case, listed, failure)
      case%effects%select = "needed"
      if (.not. allocated(failure)) call run_case(case, needed, failure)
      if (has_failed(failure, error)) return
      call check(error, find_quantity(needed%series, "asperity_load"), 0, "an effect left out has a series")
      if (allocated(error)) return
      call check(error, find_quantity(listed%series, "asperity_load") > 0 .and. &
         find_quantity(needed%summary, "asperity_used") > 0, &
         "nothing tells about it")
   end subroutine test_left_out

   !> A random case; can something be said about it?
   subroutine draw_case(seed, text, case, is_known, is_valid)
      integer, intent(in) :: seed
      character(len=:), allocatable, intent(out) :: text
      type(case_t), intent(out) :: case
      logical, intent(out) :: is_known
      logical, intent(out), optional :: is_valid
      type(random_t) :: random
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(error_t), allocatable :: failure

      call start_random(random, seed)
      call random_deck(random, text)
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      is_known = .false.
      if (present(is_valid)) is_valid = .not. allocated(failure)
      if (.not. allocated(failure)) call set_quantity(seed, case, is_known)
   end subroutine draw_case

   !> The same with every option of a deck but a numerical film, a flexible train and hours of running: nothing is estimated of the
   !> last, and the train has a campaign of its own. A camshaft has one cam, since bearings of several are not weighed.
   subroutine draw_wide_case(seed, schema, text, case, is_known)
      integer, intent(in) :: seed
      type(schema_t), intent(in) :: schema
      character(len=:), allocatable, intent(out) :: text
      type(case_t), intent(out) :: case
      logical, intent(out) :: is_known
      type(wide_deck_t) :: drawn
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(error_t), allocatable :: failure

      call draw_wide_deck(seed, schema, style_t(ehl_share=0.0_wp, method_share=0.0_wp), drawn)
      text = drawn%text
      call parse_deck(deck, text, "random deck", "", none, failure, drawn%tables)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      is_known = .false.
      if (allocated(failure)) return
      if (allocated(case%running_in)) return
      case%numerics = numerics_t()
      if (allocated(case%cam_bearings)) then
         if (allocated(case%engine)) deallocate (case%engine)
         if (allocated(case%second_lift)) deallocate (case%second_lift)
         associate (bearings => case%cam_bearings)
            if (allocated(bearings%cam_shafts)) deallocate (bearings%cam_shafts)
            bearings%cam_positions = bearings%cam_positions(:1)
            bearings%cam_phases = [0.0_wp]
            bearings%cam_lobes = [1]
            bearings%follower_angles = bearings%follower_angles(:1)
         end associate
      end if
      call set_quantity(seed, case, is_known)
   end subroutine draw_wide_case

   !> Choose the quantity that counts, which decides what is left out; can something be said about the case?
   subroutine set_quantity(seed, case, is_known)
      integer, intent(in) :: seed
      type(case_t), intent(inout) :: case
      logical, intent(out) :: is_known
      type(case_t) :: chosen
      type(model_t), allocatable :: models(:)
      type(choice_t) :: choice
      type(error_t), allocatable :: failure
      integer :: i

      is_known = .false.
      case%effects%quantity = quantity_names(modulo(seed, size(quantity_names)) + 1)
      call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, failure)
      if (allocated(failure)) return
      do i = 1, size(choice%decisions)
         is_known = is_known .or. minval(choice%decisions(i)%estimates) < 1.0_wp
      end do
   end subroutine set_quantity

   !> Audit a random case and compare its changes with their estimates.
   subroutine compare_seed(seed, text, case, tally)
      integer, intent(in) :: seed
      character(len=*), intent(in) :: text
      type(case_t), intent(in) :: case
      type(tally_t), intent(inout) :: tally
      type(study_table_t) :: table, precise
      type(tally_t) :: trial
      character(len=12) :: buffer
      integer :: before
      logical :: is_precise

      call audit(case, accuracy, table)
      write (buffer, "(i0)") seed
      call start_tally(trial)
      call compare(table, "", accuracy, trial)
      is_precise = .false.
      if (trial%misses /= "") then
         call audit(case, high_accuracy, precise)
         ! A run that fails at the high accuracy proves nothing
         is_precise = failures(precise) <= failures(table)
      end if
      before = len(tally%misses)
      if (is_precise) then
         tally%repeated = tally%repeated + 1
         call compare(precise, "NEEDED_SEED="//trim(buffer), high_accuracy, tally)
      else
         call compare(table, "NEEDED_SEED="//trim(buffer), accuracy, tally)
      end if
      if (len(tally%misses) > before) tally%misses = tally%misses//new_line("a")//text
   end subroutine compare_seed

   !> Changes that an audit has not got.
   integer function failures(table)
      type(study_table_t), intent(in) :: table
      integer :: k

      failures = 0
      do k = 1, size(judged)
         failures = failures + count(ieee_is_nan(column_of(table, "change_"//trim(judged(k)))))
      end do
   end function failures

end module test_needed
