!> Places where the finger is in balance at several loads, and what messages say of them.
module test_fold
   use testdrive, only : new_unittest, unittest_type, error_type, check, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, add_context, kind_convergence, kind_deck, cause_unknown, cause_several_balances
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_run, only : build_models
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_fold, only : has_fold, explain_end
   use reference_cases, only : thesis_case
   use random_decks, only : random_t, start_random, random_deck
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_fold

   !> Seed of a deck in which friction presses the roller onto the cam and thin oil stiffens by Roelands' law
   integer, parameter :: folded_seed = 300363
   !> A large sliding speed [m/s]
   real(wp), parameter :: large = 1.0e-2_wp

contains

   !> Collect the tests.
   subroutine collect_fold(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("several balanced loads at one sliding speed are detected, and an ordinary contact has one", test_seen), &
         new_unittest("an error message names several balances as the cause where there are several", test_words) &
         ]
   end subroutine collect_fold

   !> The case with a fold.
   subroutine folded_case(case, failure)
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: failure
      type(random_t) :: random
      type(deck_t) :: deck
      type(override_t) :: none(0)
      character(len=:), allocatable :: text

      call start_random(random, folded_seed)
      call random_deck(random, text)
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
   end subroutine folded_case

   subroutine test_seen(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure

      call folded_case(case, failure)
      if (.not. allocated(failure)) call build_models(case, models, failure)
      if (has_failed(failure, error)) return
      call check(error, has_fold(models(1), -30.0_wp*degree, large), "the fold is not seen")
      if (.not. allocated(error)) call check(error, .not. has_fold(models(1), 150.0_wp*degree, large), "a fold on the base circle")
      if (allocated(error)) return
      call build_models(thesis_case(), models, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (.not. allocated(error)) call check(error, .not. has_fold(models(1), -30.0_wp*degree, large), "a fold in an ordinary case")
   end subroutine test_seen

   subroutine test_words(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: words = "at several loads"
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure

      call folded_case(case, failure)
      if (.not. allocated(failure)) call build_models(case, models, failure)
      if (has_failed(failure, error)) return
      call explain_end(models(1), -30.0_wp*degree, large, failure)
      call check(error, .not. allocated(failure), "an error out of nothing")
      if (allocated(error)) return
      call raise(failure, kind_convergence, "no end")
      call explain_end(models(1), -30.0_wp*degree, large, failure)
      call check(error, index(failure%message, words) > 0, failure%message)
      if (allocated(error)) return
      call add_context(failure, "case 7")
      call check(error, failure%cause, cause_several_balances, "the mark")
      if (allocated(error)) return
      call raise(failure, kind_convergence, "no end")
      call explain_end(models(1), 150.0_wp*degree, large, failure)
      call check(error, failure%message == "no end" .and. failure%cause == cause_unknown, failure%message)
      if (allocated(error)) return
      call raise(failure, kind_deck, "no deck")
      call explain_end(models(1), -30.0_wp*degree, large, failure)
      call check(error, failure%message == "no deck", failure%message)
   end subroutine test_words

end module test_fold
