!> Effects that the program leaves out change no more than it says.
!>
!> The environment variables NEEDED_CASES and NEEDED_SEED choose how many random cases and which; `make needed` sets them, and
!> NEEDED_TABLE, which asks for a table of how far below their estimates the changes are.
module test_needed
   use, intrinsic :: iso_fortran_env, only : output_unit
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, quantity_names, quantity_slip
   use camroller_balance, only : least_slip
   use camroller_audit, only : new_audit_table, audit_case, judged
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_effect_choice, only : choose_effects
   use camroller_effect_list, only : choice_t, effect_names, effect_count
   use camroller_model, only : model_t
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : build_models, run_case
   use camroller_study_table, only : study_table_t, word_length, column_of, words_of
   use random_decks, only : random_t, start_random, random_deck
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_needed

   !> Cases of a test run, and the seed of the first
   integer, parameter :: usual_cases = 4, usual_seed = 1
   !> Accuracy of the runs that are compared; of those that decide where a change seems larger than its estimate, since a mean in
   !> which much cancels is less accurate than what it is a mean of [-]
   real(wp), parameter :: accuracy = 1.0e-5_wp, high_accuracy = 1.0e-10_wp
   !> What an accuracy leaves of a change, over the accuracy; and at least, of a mean torque: runs of one deck to 1e-9 and to
   !> 1e-10 differ by up to 9e-8 [-]
   real(wp), parameter :: rest_share = 3.0_wp, least_rest = 1.0e-7_wp
   !> Part of the estimates that must be below what is negligible by default, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.1_wp
   !> Random decks whose changes are hard to bound: friction near its limit hands a small change of slip on to load and film; a spin
   !> that hardly anything damps, with a slip in which forward and backward sliding cancel; slip in a narrow stretch of the cycle;
   !> another such stretch; a slow decay from the end of the event on; torque that bends between the points of the quasi-static
   !> limit; slip below what counts as none, twice
   integer, parameter :: hard_seeds(*) = [7039, 7235, 1234, 54107, 55268, 50894, 403139, 700913]

   !> What came of many audits, by effect and quantity; the last row is everything that a case does not need, left out at once
   type :: tally_t
      character(len=:), allocatable :: misses
      !> Changes; those with an estimate; those whose estimate is small
      integer, dimension(effect_count + 1, size(quantity_names)) :: changes = 0, known = 0, small = 0
      !> Cases that took runs of high accuracy
      integer :: repeated = 0
      !> Changes over their estimates, in the order met [-]
      real(wp), allocatable :: ratios(:)
      !> Largest of them, by effect and quantity [-]
      real(wp) :: largest(effect_count + 1, size(quantity_names)) = 0.0_wp
   end type tally_t

contains

   subroutine collect_needed(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("changes by leaving effects out are within their estimates, for random cases", test_random), &
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

   subroutine test_hard(error)
      type(error_type), allocatable, intent(out) :: error
      type(tally_t) :: tally
      type(case_t) :: case
      character(len=:), allocatable :: text
      integer :: i
      logical :: is_known

      call start_tally(tally)
      do i = 1, size(hard_seeds)
         call draw_case(hard_seeds(i), text, case, is_known)
         if (is_known) call compare_seed(hard_seeds(i), text, case, tally)
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
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
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
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      call check(error, find_quantity(needed%series, "asperity_load"), 0, "an effect left out has a series")
      if (allocated(error)) return
      call check(error, find_quantity(listed%series, "asperity_load") > 0 .and. &
         find_quantity(needed%summary, "asperity_used") > 0, &
         "nothing tells about it")
   end subroutine test_left_out

   !> A random case; can something be said about it?
   subroutine draw_case(seed, text, case, is_known)
      integer, intent(in) :: seed
      character(len=:), allocatable, intent(out) :: text
      type(case_t), intent(out) :: case
      logical, intent(out) :: is_known
      type(random_t) :: random
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: chosen
      type(model_t), allocatable :: models(:)
      type(choice_t) :: choice
      type(error_t), allocatable :: failure
      integer :: i

      is_known = .false.
      call start_random(random, seed)
      call random_deck(random, text)
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      ! Which quantity counts decides what is left out
      case%effects%quantity = quantity_names(modulo(seed, size(quantity_names)) + 1)
      if (.not. allocated(failure)) call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, failure)
      if (allocated(failure)) return
      do i = 1, size(choice%decisions)
         is_known = is_known .or. minval(choice%decisions(i)%estimates) < 1.0_wp
      end do
   end subroutine draw_case

   !> Audit a case once.
   subroutine audit(case, run_accuracy, table)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: run_accuracy
      type(study_table_t), intent(out) :: table
      type(case_t) :: precise
      type(error_t), allocatable :: failure

      precise = case
      precise%numerics%accuracy = run_accuracy
      call new_audit_table(table)
      call audit_case(table, 1, precise, 1, .false., failure)
   end subroutine audit

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

   !> Nothing compared yet.
   subroutine start_tally(tally)
      type(tally_t), intent(out) :: tally

      tally%misses = ""
      allocate (tally%ratios(0))
   end subroutine start_tally

   !> Compare the changes of an audit with their estimates.
   subroutine compare(table, what, run_accuracy, tally)
      type(study_table_t), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: run_accuracy
      type(tally_t), intent(inout) :: tally
      character(len=24) :: buffer
      ! What the runs leave of a change; change beyond that, over its estimate [-]
      real(wp) :: rest, ratio
      ! Changes, their estimates, slip with all effects [-]
      real(wp), dimension(table%rows, size(quantity_names)) :: changes, estimates
      real(wp) :: slip(table%rows)
      character(len=word_length), dimension(table%rows) :: effects, runs
      integer :: row, effect, k

      effects = words_of(table, "effect")
      runs = words_of(table, "run")
      slip = column_of(table, "slip")
      do k = 1, size(judged)
         changes(:, k) = column_of(table, "change_"//trim(judged(k)))
         estimates(:, k) = column_of(table, "estimate_"//trim(judged(k)))
      end do
      do row = 1, table%rows
         effect = findloc(effect_names, effects(row), 1)
         if (effect == 0) effect = effect_count + 1
         do k = 1, size(quantity_names)
            associate (change => changes(row, k), estimate => estimates(row, k))
               if (ieee_is_nan(change) .or. ieee_is_nan(estimate)) cycle
               tally%changes(effect, k) = tally%changes(effect, k) + 1
               if (estimate > 1.0e300_wp) cycle
               tally%known(effect, k) = tally%known(effect, k) + 1
               if (estimate < 1.0e-3_wp) tally%small(effect, k) = tally%small(effect, k) + 1
               rest = max(rest_share*run_accuracy, least_rest)
               ! Runs are accurate to a part of the slip that counts as none; what that hides is left to the more accurate ones
               if (k == quantity_slip .and. run_accuracy <= high_accuracy) rest = rest*max(1.0_wp, least_slip &
                  /max(abs(slip(1)), tiny(1.0_wp)**0.5_wp))
               ratio = max(abs(change) - rest, 0.0_wp)/max(estimate, tiny(1.0_wp)**0.5_wp)
               tally%ratios = [tally%ratios, ratio]
               tally%largest(effect, k) = max(tally%largest(effect, k), ratio)
               if (abs(change) <= estimate + rest) cycle
               write (buffer, "(2es12.3)") change, estimate
               tally%misses = tally%misses//new_line("a")//what//": "//trim(effects(row))//" "// &
                  trim(runs(row))//" "//trim(quantity_names(k))//buffer
            end associate
         end do
      end do
   end subroutine compare

   !> Print how far below their estimates the changes are.
   subroutine print_tally(tally, cases, seed)
      type(tally_t), intent(in) :: tally
      integer, intent(in) :: cases, seed
      ! Ratios that are counted [-]
      real(wp), parameter :: steps(*) = [0.0_wp, 0.05_wp, 0.1_wp, 0.15_wp, 0.2_wp, 0.25_wp, 0.3_wp, 0.5_wp, 1.0_wp]
      integer :: effect, k

      write (output_unit, "(i0, a, i0, a, i0)") cases, " cases, ", tally%repeated, &
         " of them run again with high accuracy, next seed ", seed
      write (output_unit, "(a20, a14, 3a9, a15)") "without", "quantity", "changes", "bounded", "small", "largest ratio"
      do effect = 1, effect_count
         call print_rows(trim(effect_names(effect)), effect)
      end do
      call print_rows("all left out", effect_count + 1)
      do k = 1, size(steps)
         write (output_unit, "(a, f5.2, a, i0)") "ratio above", steps(k), ": ", count(tally%ratios > steps(k))
      end do
      write (output_unit, "(a, i0)") "all ratios: ", size(tally%ratios)

   contains

      subroutine print_rows(name, row)
         character(len=*), intent(in) :: name
         integer, intent(in) :: row
         integer :: quantity

         do quantity = 1, size(quantity_names)
            if (tally%changes(row, quantity) == 0) cycle
            write (output_unit, "(a20, a14, 3i9, f15.3)") name, quantity_names(quantity), tally%changes(row, quantity), &
               tally%known(row, quantity), tally%small(row, quantity), tally%largest(row, quantity)
         end do
      end subroutine print_rows

   end subroutine print_tally

   !> A whole number from the environment, or the usual one.
   function number_from(variable, usual) result(number)
      character(len=*), intent(in) :: variable
      integer, intent(in) :: usual
      integer :: number, status
      character(len=12) :: buffer

      call get_environment_variable(variable, buffer, status=status)
      number = usual
      if (status == 0) read (buffer, *, iostat=status) number
      if (status /= 0) number = usual
   end function number_from

end module test_needed
