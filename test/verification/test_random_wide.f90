!> Cases drawn at random over everything that a deck may hold: each has a result that is right by more than one measure, or words
!> say why there is none. How they end is counted and printed.
!>
!> The environment variables WIDE_CASES and WIDE_SEED choose how many and which; `make random-wide` sets them. WIDE_FOLDER names a
!> folder for decks and tables of cases that fail and of a case run alone, WIDE_TRACE=1 has each seed printed before its case is run.
module test_random_wide
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_accuracy, only : is_checked, has_tolerance
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_result, only : result_t
   use camroller_run, only : build_models, run_case
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t
   use case_endings, only : tally_t, count_ending, count_error, count_remarks, endings_table, ending_count
   use random_decks, only : random_t, start_random
   use result_checks, only : check_result, compare_results, promised_error
   use run_settings, only : has_checks, number_from
   use wide_decks, only : wide_deck_t, draw_wide_deck, save_wide_deck
   implicit none
   private

   public :: collect_random_wide

   !> Cases of a test run with and without run-time checks, and the seed of the first
   integer, parameter :: usual_cases = 200, few_cases = 20, usual_seed = 1
   !> One deck of so many has numbers at the ends of their ranges
   integer, parameter :: ends_stride = 4
   !> Part of the decks drawn that must have a result, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.25_wp

contains

   !> Collect the tests.
   subroutine collect_random_wide(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("random cases with every option end with a result that is right, or with words", test_wide) &
         ]
   end subroutine collect_random_wide

   subroutine test_wide(error)
      type(error_type), allocatable, intent(out) :: error
      ! Failures after which a run ends
      integer, parameter :: most_shown = 1000
      type(schema_t) :: schema
      type(random_t) :: random
      type(wide_deck_t) :: deck
      type(tally_t) :: tally
      character(len=:), allocatable :: list, trouble
      character(len=40) :: buffer
      integer :: seed, i, cases, failures
      ! [s]
      real(wp) :: start, finish

      call new_schema(schema)
      cases = number_from("WIDE_CASES", merge(few_cases, usual_cases, has_checks()))
      list = ""
      failures = 0
      do i = 1, cases
         seed = number_from("WIDE_SEED", usual_seed) + i - 1
         call start_random(random, seed)
         call draw_wide_deck(random, schema, modulo(seed, ends_stride) == 0, deck)
         write (buffer, "(a, i0)") "WIDE_SEED=", seed
         if (number_from("WIDE_TRACE", 0) > 0) write (error_unit, "(a)") trim(buffer)
         call cpu_time(start)
         call check_deck(deck, modulo(seed, ends_stride) == 0, tally, trouble)
         call cpu_time(finish)
         if (finish - start > 20.0_wp .and. cases > usual_cases) write (error_unit, "(a, f7.1, a)") trim(buffer), finish - start, &
            & " s"
         if (trouble /= "" .or. cases == 1) call save_wide_deck(deck, trim(buffer(11:)), trouble)
         if (trouble == "") cycle
         failures = failures + 1
         list = list//new_line("a")//trim(buffer)//":"//trouble
         if (cases > usual_cases) write (error_unit, "(2a)") trim(buffer)//":", trouble
         if (failures >= most_shown) exit
      end do
      write (error_unit, "(a)") endings_table(tally)
      if (ending_count(tally, "result") < least_share*cases) list = list//new_line("a")//"too few decks have a result"
      if (list /= "") call test_failed(error, list)
   end subroutine test_wide

   !> One deck: read, built, run by its own and by an unlike method.
   subroutine check_deck(deck, with_ends, tally, trouble)
      type(wide_deck_t), intent(in) :: deck
      logical, intent(in) :: with_ends
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(out) :: trouble
      type(deck_t) :: parsed
      type(override_t) :: none(0)
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: error
      type(result_t) :: result

      trouble = ""
      call parse_deck(parsed, deck%text, "random deck", "", none, error, deck%tables)
      if (.not. allocated(error)) call make_case(parsed, none, case, error)
      if (allocated(error)) then
         call count_ending(tally, "deck refused")
         if (.not. with_ends) trouble = " a deck within all ranges is refused: "//error%message
         return
      end if
      call build_models(case, models, error)
      if (allocated(error)) then
         call count_error(tally, error, "no model:", trouble)
         return
      end if
      call run_case(case, result, error)
      if (allocated(error)) then
         call count_error(tally, error, "no result:", trouble)
         return
      end if
      call count_remarks(tally, result%warnings, trouble)
      trouble = trouble//check_result(case, result)
      if (trouble == "") call compare_methods(case, result, tally, trouble)
      if (trouble /= "") call count_ending(tally, "SILENT: a result that is not right")
   end subroutine check_deck

   !> The same case by another method.
   subroutine compare_methods(case, one, tally, trouble)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: one
      type(tally_t), intent(inout) :: tally
      character(len=:), allocatable, intent(inout) :: trouble
      type(case_t) :: changed
      type(result_t) :: other
      type(error_t), allocatable :: error

      ! Euler's steps and the quasi-static limit promise nothing
      if (.not. (is_checked(case%numerics) .or. has_tolerance(case%numerics))) return
      changed = case
      changed%numerics%method = "rodas5p"
      if (case%numerics%method == "rodas5p") changed%numerics%method = "radau5"
      call run_case(changed, other, error)
      if (allocated(error)) then
         call count_error(tally, error, "  no second result:", trouble)
         return
      end if
      trouble = trouble//check_result(changed, other)
      if (trouble /= "") return
      call compare_results(one, other, promised_error(case, one) + promised_error(changed, other), trouble)
   end subroutine compare_methods

end module test_random_wide
