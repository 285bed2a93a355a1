!> Effects that the program leaves out change no more than it says.
!>
!> The environment variables NEEDED_CASES and NEEDED_SEED choose how many random cases and which; `make needed` sets them.
module test_needed
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, quantity_names
   use camroller_audit, only : new_audit_table, audit_case
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_effect_choice, only : choose_effects
   use camroller_effect_list, only : choice_t
   use camroller_effect_report, only : complete_result
   use camroller_model, only : model_t
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : build_models, run_case
   use camroller_study_table, only : study_table_t
   use random_decks, only : random_t, start_random, random_deck
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_needed

   !> Cases of a test run, and the seed of the first
   integer, parameter :: usual_cases = 4, usual_seed = 1
   !> Accuracy of the runs that are compared [-], and what it leaves of a change: a few times as much
   real(wp), parameter :: accuracy = 1.0e-5_wp, rest = 3.0_wp*accuracy
   !> Part of the estimates that must be below what is negligible by default, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.1_wp

contains

   subroutine collect_needed(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("no change is larger than its estimate, for random cases", test_random), &
         new_unittest("every quantity keeps its promise at the operating points of the thesis", test_thesis), &
         new_unittest("nothing negligible leaves every effect that matters", test_zero), &
         new_unittest("what is left out has its place in a completed result", test_complete) &
         ]
   end subroutine collect_needed

   subroutine test_random(error)
      type(error_type), allocatable, intent(out) :: error
      type(random_t) :: random
      type(study_table_t) :: table
      type(case_t) :: case
      character(len=:), allocatable :: text, misses
      character(len=12) :: buffer
      integer :: seed, tested, wanted, small, known, before
      logical :: is_known

      wanted = number_from("NEEDED_CASES", usual_cases)
      seed = number_from("NEEDED_SEED", usual_seed)
      misses = ""
      small = 0
      known = 0
      tested = 0
      do while (tested < wanted)
         call start_random(random, seed)
         call random_deck(random, text)
         seed = seed + 1
         call draw_case(text, case, is_known)
         if (.not. is_known) cycle
         tested = tested + 1
         call audit(case, table)
         write (buffer, "(i0)") seed - 1
         before = len(misses)
         call compare(table, "NEEDED_SEED="//trim(buffer), misses, known, small)
         if (len(misses) > before) misses = misses//new_line("a")//text
      end do
      if (misses == "" .and. small < least_share*known) misses = new_line("a")//"hardly an estimate is small"
      if (misses /= "") call test_failed(error, misses)
   end subroutine test_random

   subroutine test_thesis(error)
      type(error_type), allocatable, intent(out) :: error
      type(study_table_t) :: table
      type(case_t) :: case
      character(len=:), allocatable :: misses
      integer :: k, known, small

      misses = ""
      known = 0
      small = 0
      do k = 1, 3
         case = thesis_case()
         case%numerics%method = "automatic"
         case%numerics%tolerance = 0.0_wp
         case%effects%quantity = quantity_names(k)
         call set_point(case, point_speeds(k), point_viscosities(4 - k))
         call audit(case, table)
         call compare(table, trim(quantity_names(k)), misses, known, small)
      end do
      if (misses /= "") call test_failed(error, misses)
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
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, .true., failure)
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
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, .true., failure)
      call check(error, .not. allocated(chosen%asperity) .and. choice%bound <= 0.0_wp, "surfaces that never touch have asperities")
   end subroutine test_zero

   subroutine test_complete(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: listed, needed
      type(error_t), allocatable :: failure
      integer :: i

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
      call complete_result(case, needed)
      call check(error, size(needed%series), size(listed%series), "another number of series")
      if (allocated(error)) return
      do i = 1, size(listed%series)
         call check(error, needed%series(i)%name, listed%series(i)%name)
         if (allocated(error)) return
      end do
      call check(error, all(ieee_is_nan(needed%series_values(:, find_quantity(listed%series, "asperity_load")))), &
         "what was left out has values")
      if (allocated(error)) return
      do i = 1, size(listed%summary)
         call check(error, needed%summary(i)%name, listed%summary(i)%name)
         if (allocated(error)) return
      end do
   end subroutine test_complete

   !> A case of a deck, if something can be said about it.
   subroutine draw_case(text, case, is_known)
      character(len=*), intent(in) :: text
      type(case_t), intent(out) :: case
      logical, intent(out) :: is_known
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: chosen
      type(model_t), allocatable :: models(:)
      type(choice_t) :: choice
      type(error_t), allocatable :: failure
      integer :: i

      is_known = .false.
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      if (.not. allocated(failure)) call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, .true., failure)
      if (allocated(failure)) return
      do i = 1, size(choice%decisions)
         is_known = is_known .or. minval(choice%decisions(i)%estimates) < 1.0_wp
      end do
   end subroutine draw_case

   !> Audit a case once.
   subroutine audit(case, table)
      type(case_t), intent(in) :: case
      type(study_table_t), intent(out) :: table
      type(case_t) :: precise
      type(error_t), allocatable :: failure

      precise = case
      precise%numerics%accuracy = accuracy
      call new_audit_table(table)
      call audit_case(table, 1, precise, 1, .false., failure)
   end subroutine audit

   !> Changes beyond their estimates.
   subroutine compare(table, what, misses, known, small)
      type(study_table_t), intent(in) :: table
      character(len=*), intent(in) :: what
      character(len=:), allocatable, intent(inout) :: misses
      integer, intent(inout) :: known, small
      character(len=24) :: buffer
      integer :: row, k

      do row = 1, table%rows
         do k = 1, size(quantity_names)
            associate (change => table%numbers(row, 5 + k), estimate => table%numbers(row, 8 + k))
               if (ieee_is_nan(change) .or. ieee_is_nan(estimate)) cycle
               known = known + 1
               if (estimate < 1.0e-3_wp) small = small + 1
               if (abs(change) <= estimate + rest) cycle
               write (buffer, "(2es12.3)") change, estimate
               misses = misses//new_line("a")//what//": "//trim(table%words(row, 1))//" "//trim(table%words(row, 2))//" "// &
                  trim(quantity_names(k))//buffer
            end associate
         end do
      end do
   end subroutine compare

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
