!> Cases drawn at random: whatever has a geometry has a cycle, and two unlike methods find the same one.
!>
!> The environment variables RANDOM_CASES and RANDOM_SEED choose how many and which; `make random` sets them.
module test_random_cases
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_domain, kind_deck
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_run, only : build_models
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use cycle_checks, only : sample_t, take_sample, compare_samples
   use random_decks, only : random_t, start_random, random_deck
   implicit none
   private

   public :: collect_random_cases

   !> Cases of a test run, and the seed of the first
   integer, parameter :: usual_cases = 5, usual_seed = 1
   !> Tolerance of both methods [-]
   real(wp), parameter :: tolerance = 1.0e-4_wp
   !> Part of the decks drawn that must have a geometry, lest nothing is tested [-]
   real(wp), parameter :: least_share = 0.2_wp
   !> Part of the cases that may end with an error that names the cam angle: where a sharp limit of traction meets a slip below what
   !> the smallest step can resolve [-]
   real(wp), parameter :: ended_share = 0.02_wp

contains

   !> Collect the tests.
   subroutine collect_random_cases(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("random cases have one cycle, by two unlike methods", test_random)]
   end subroutine collect_random_cases

   subroutine test_random(error)
      type(error_type), allocatable, intent(out) :: error
      ! Failures that are shown
      integer, parameter :: shown = 3
      type(random_t) :: random
      character(len=:), allocatable :: text, trouble, list
      character(len=12) :: buffer
      integer :: seed, last, tested, drawn, failures, ended
      logical :: is_possible, has_ended

      seed = number_from("RANDOM_SEED", usual_seed)
      last = number_from("RANDOM_CASES", usual_cases)
      list = ""
      tested = 0
      drawn = 0
      failures = 0
      ended = 0
      do while (tested < last .and. failures < shown)
         call start_random(random, seed + drawn)
         drawn = drawn + 1
         call random_deck(random, text)
         call check_deck(text, is_possible, has_ended, trouble)
         if (is_possible) tested = tested + 1
         if (has_ended) then
            ended = ended + 1
            if (ended <= max(1, int(ended_share*last)) .and. index(trouble, "at cam angle") > 0) cycle
         end if
         if (trouble /= "") then
            failures = failures + 1
            write (buffer, "(i0)") seed + drawn - 1
            list = list//new_line("a")//"RANDOM_SEED="//trim(buffer)//": "//trouble//new_line("a")//text
         end if
         if (drawn > 100 .and. tested < least_share*drawn) list = list//"too few decks have a geometry"
         if (drawn > 100 .and. tested < least_share*drawn) exit
      end do
      if (list /= "") call test_failed(error, list)
   end subroutine test_random

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

   !> One deck: no geometry, or a cycle by two methods that agree.
   subroutine check_deck(text, is_possible, has_ended, trouble)
      character(len=*), intent(in) :: text
      logical, intent(out) :: is_possible, has_ended
      character(len=:), allocatable, intent(out) :: trouble
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: error
      type(sample_t) :: one, other

      trouble = ""
      is_possible = .true.
      has_ended = .false.
      call parse_deck(deck, text, "random deck", "", none, error)
      if (.not. allocated(error)) call make_case(deck, none, case, error)
      if (allocated(error)) then
         trouble = error%message
         return
      end if
      call build_models(case, models, error)
      if (allocated(error)) then
         is_possible = .false.
         if (error%kind /= kind_domain .and. error%kind /= kind_deck) trouble = error%message
         return
      end if
      call take_sample(models(1), case%numerics, "rodas5p", tolerance, one)
      trouble = one%trouble
      has_ended = one%has_ended
      if (trouble == "") call take_sample(models(1), case%numerics, "hermite", tolerance, other)
      if (trouble == "") then
         trouble = other%trouble
         has_ended = other%has_ended
      end if
      if (trouble == "") trouble = compare_samples(one, other)
      if (trouble == "") trouble = compare_samples(other, one)
   end subroutine check_deck

end module test_random_cases
