!> Cases drawn at random: whatever has a geometry has a cycle, and two unlike methods find the same one, or an error or a remark
!> says that it could not be found.
!>
!> The environment variables RANDOM_CASES and RANDOM_SEED choose how many and which; `make random` sets them.
module test_random_cases
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, cause_several_balances, kind_domain, kind_deck
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_remarks, only : missed_accuracy
   use camroller_result, only : result_t, get_series, get_summary
   use camroller_run, only : build_models, run_case
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use cycle_checks, only : sample_t, take_sample, least_slip
   use random_decks, only : random_t, start_random, random_deck
   use run_settings, only : has_checks, number_from
   implicit none
   private

   public :: collect_random_cases

   !> Cases of a test run with and without run-time checks, and the seed of the first
   integer, parameter :: usual_cases = 60, few_cases = 5, usual_seed = 1
   !> Accuracy asked for, tolerance of the cycle whose states are looked at [-]
   real(wp), parameter :: accuracy = 1.0e-3_wp, tolerance = 1.0e-4_wp
   !> Part of the decks drawn that must have a geometry, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.2_wp
   !> Part of the cases that may end with an error that names the cam angle, and that may have a remark on an accuracy that was not
   !> reached: measured shares are below 0.3 % and 1 % [-]
   real(wp), parameter :: ended_share = 0.005_wp, remarked_share = 0.01_wp

   !> What came of a case
   type :: outcome_t
      logical :: is_possible = .true., has_ended = .false., has_remark = .false.
      !> What is wrong; blank where all is well
      character(len=:), allocatable :: trouble
   end type outcome_t

contains

   !> Collect the tests.
   subroutine collect_random_cases(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("two unrelated methods find the same cycle for random cases", test_random), &
         new_unittest("cases with vanishing slip or hardly any damping have a cycle", test_difficult), &
         new_unittest("a case with several balances at one angle ends with an error that names angle and cause", test_folded) &
         ]
   end subroutine collect_random_cases

   subroutine test_random(error)
      type(error_type), allocatable, intent(out) :: error
      ! Failures after which a usual run ends, and after which any does; cases between two lines of progress; errors or remarks that
      ! are no large share
      integer, parameter :: shown = 3, most_shown = 100, stride = 500, few = 1
      type(random_t) :: random
      type(outcome_t) :: outcome
      character(len=:), allocatable :: text, list
      character(len=100) :: buffer
      integer :: seed, last, tested, drawn, failures, ended, remarked

      seed = number_from("RANDOM_SEED", usual_seed)
      last = number_from("RANDOM_CASES", merge(few_cases, usual_cases, has_checks()))
      list = ""
      tested = 0
      drawn = 0
      failures = 0
      ended = 0
      remarked = 0
      do while (tested < last .and. failures < merge(shown, most_shown, last <= usual_cases))
         call start_random(random, seed + drawn)
         drawn = drawn + 1
         call random_deck(random, text)
         call check_deck(text, outcome)
         if (outcome%is_possible) tested = tested + 1
         if (outcome%has_remark) remarked = remarked + 1
         if (outcome%has_ended) ended = ended + 1
         if (outcome%trouble /= "") then
            failures = failures + 1
            write (buffer, "(i0)") seed + drawn - 1
            list = list//new_line("a")//"RANDOM_SEED="//trim(buffer)//": "//outcome%trouble//new_line("a")//text
         end if
         write (buffer, "(4(i0, a))") tested, " cases of ", drawn, " decks: ", ended, " ended with an error, ", remarked, &
            & " with a remark"
         if (outcome%is_possible .and. modulo(tested, stride) == 0) write (error_unit, "(a)") trim(buffer)
         if (drawn > 100 .and. tested < least_share*drawn) list = list//"too few decks have a geometry"
         if (drawn > 100 .and. tested < least_share*drawn) exit
      end do
      write (error_unit, "(2a)") "   ", trim(buffer)
      if (ended > few + ended_share*tested .or. remarked > few + remarked_share*tested) list = list//trim(buffer)
      if (list /= "") call test_failed(error, list)
   end subroutine test_random

   !> Decks by their seeds that are the hardest of thousands. In the first three the oil is so stiff that the slip is 1e-34, 1e-15
   !> and 1e-9 m/s while friction gives way and catches the roller again; in the fourth the bearing holds the roller; in the next
   !> two friction is at its limit all the way, and only the film damps; then the film carries a billionth of the load. In the next
   !> two friction holds the roller where nothing is entrained; then it gives way within a step of `hermite`, and of `rodas5p`; then
   !> disturbances grow where little is entrained; then friction gives way where the roller needs less than a hundredth more than it
   !> can give; in the last a step ends where friction turns, and its correction crosses that place.
   subroutine test_difficult(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: seeds(*) = [145, 168, 191, 100142, 494, 100217, 400505, 700090, 2004139, 400609, 2104272, 2004347, &
         & 3122139, 2014420, 6006030]
      type(random_t) :: random
      type(outcome_t) :: outcome
      character(len=:), allocatable :: text
      character(len=12) :: buffer
      integer :: i

      do i = 1, merge(2, size(seeds), has_checks())
         call start_random(random, seeds(i))
         call random_deck(random, text)
         call check_deck(text, outcome)
         write (buffer, "(i0)") seeds(i)
         if (outcome%has_ended) outcome%trouble = "it ends with an error"
         if (.not. outcome%is_possible) outcome%trouble = "it has no geometry"
         if (outcome%trouble /= "") call test_failed(error, "RANDOM_SEED="//trim(buffer)//": "//outcome%trouble)
         if (allocated(error)) return
      end do
   end subroutine test_difficult

   !> A cycle that cannot be is not tried with other methods and tolerances: its cause says so.
   subroutine test_folded(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: seed = 300363
      type(random_t) :: random
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text

      if (has_checks()) return ! where the error comes from is computed with run-time checks by the suite `fold`
      call start_random(random, seed)
      call random_deck(random, text)
      call parse_deck(deck, text, "random deck", "", none, failure)
      if (.not. allocated(failure)) call make_case(deck, none, case, failure)
      if (.not. allocated(failure)) call run_case(case, result, failure)
      if (.not. allocated(failure)) then
         call test_failed(error, "it has a cycle")
      else if (index(failure%message, "at cam angle") == 0 .or. index(failure%message, "at several loads") == 0) then
         call test_failed(error, failure%message)
      else if (failure%cause /= cause_several_balances) then
         call test_failed(error, "it does not say what a caller needs to know not to try again")
      end if
   end subroutine test_folded

   !> One deck: no geometry, or a cycle by two methods that agree, or words that say why not.
   subroutine check_deck(text, outcome)
      character(len=*), intent(in) :: text
      type(outcome_t), intent(out) :: outcome
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: error
      type(result_t) :: one, other
      type(sample_t) :: sample

      outcome%trouble = ""
      call parse_deck(deck, text, "random deck", "", none, error)
      if (.not. allocated(error)) call make_case(deck, none, case, error)
      if (allocated(error)) then
         outcome%trouble = error%message
         return
      end if
      call build_models(case, models, error)
      if (allocated(error)) then
         outcome%is_possible = .false.
         if (error%kind /= kind_domain .and. error%kind /= kind_deck) outcome%trouble = error%message
         return
      end if
      case%numerics%accuracy = accuracy
      call run_case(case, one, error)
      case%numerics%method = "rodas5p"
      if (.not. allocated(error)) call run_case(case, other, error)
      if (allocated(error)) then
         outcome%has_ended = .true.
         if (index(error%message, "at cam angle") == 0) outcome%trouble = error%message
         return
      end if
      call compare_results(one, other, outcome)
      if (outcome%trouble /= "" .or. outcome%has_remark) return
      call take_sample(models(1), case%numerics, "rodas5p", tolerance, sample)
      outcome%has_ended = sample%has_ended
      if (.not. (sample%has_ended .and. index(sample%trouble, "at cam angle") > 0)) outcome%trouble = sample%trouble
   end subroutine check_deck

   !> Do two results agree within what they promise, and does neither chatter?
   !>
   !> Chatter shows in the sum of all changes. An error that comes and goes adds twice its size; so the sums may differ by twice
   !> the accuracies that both promise. Among 1300 cases they differ by 0.6 of that at most.
   subroutine compare_results(one, other, outcome)
      type(result_t), intent(in) :: one, other
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable :: error
      ! Sliding speeds and rolling speed [m/s]; errors estimated [-], scale [m/s], difference, the largest allowed [-]
      real(wp), allocatable :: first(:), second(:), rolling(:)
      real(wp) :: estimates(2), scale, found, allowed
      character(len=100) :: buffer

      call get_series(one, "sliding_speed", first, error)
      call get_series(other, "sliding_speed", second, error)
      call get_series(one, "rolling_speed", rolling, error)
      call get_summary(one, "estimated_error", estimates(1), error)
      call get_summary(other, "estimated_error", estimates(2), error)
      outcome%has_remark = any([one%remarks%kind, other%remarks%kind] == missed_accuracy)
      if (outcome%has_remark .neqv. any(estimates > accuracy)) outcome%trouble = "remark and estimate do not agree"
      scale = max(maxval(abs(first)), maxval(abs(second)), least_slip*maxval(abs(rolling)))
      found = maxval(abs(first - second))/scale
      allowed = sum(max(estimates, accuracy))
      ! A largest value leaves out what is not a number
      if (.not. all(abs(first - second) <= allowed*scale)) then
         write (buffer, "(a, es9.2, a, 2es9.2)") "sliding speeds differ by", found, " of the largest, estimated are", estimates
         outcome%trouble = trim(buffer)
      else if (abs(variation(first) - variation(second)) > 2.0_wp*scale*allowed) then
         outcome%trouble = "the sliding speed chatters"
      end if
   end subroutine compare_results

   !> Sum of all changes.
   pure function variation(values)
      ! [m/s]
      real(wp), intent(in) :: values(:)
      real(wp) :: variation

      variation = sum(abs(values(2:) - values(:size(values) - 1)))
   end function variation

end module test_random_cases
