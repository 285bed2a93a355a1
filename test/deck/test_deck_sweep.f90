!> Tests of sweeps: which case stands at which place of the grid, and what a sweep may hold.
module test_deck_sweep
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_usage
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, make_sweep_case
   use camroller_key_uses, only : say_use
   use camroller_samples, only : sample_names
   use camroller_deck_sweep, only : sweep_size, sweep_position, sweep_numbers, sweep_words
   use deck_samples, only : changed_deck, parse_sample, sample_deck, expect_mistake
   implicit none
   private

   public :: collect_deck_sweep

   character(len=*), parameter :: grid = "&sweep key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 900 count_1 = 3"// &
      & " key_2 = 'film.law' values_2 = 'moes', ""pan_hamrock"" /"

contains

   !> All tests of this suite.
   subroutine collect_deck_sweep(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a deck without a sweep is one case", one_case), &
         new_unittest("the last key varies fastest", last_key_is_fastest), &
         new_unittest("a case of the grid has the grid's values", case_has_values), &
         new_unittest("values are listed for every case", values_are_listed), &
         new_unittest("a number outside of the grid is a usage error", outside_of_grid), &
         new_unittest("mistakes in a sweep are told with their place", sweep_mistakes), &
         new_unittest("a value that breaks a rule with others is told with its case", broken_rule), &
         new_unittest("the seed is used with every kind of sample", seed_of_samples) &
         ]
   end subroutine collect_deck_sweep

   subroutine one_case(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call parse_sample(sample_deck(), deck, raised)
      if (.not. allocated(raised)) call make_sweep_case(deck, 1, case, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, sweep_size(deck%sweep), 1)
   end subroutine one_case

   subroutine last_key_is_fastest(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: expected(2, 6) = reshape([1, 1, 1, 2, 2, 1, 2, 2, 3, 1, 3, 2], [2, 6])
      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      integer :: i

      call parse_sample(changed_deck("", grid), deck, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, sweep_size(deck%sweep), 6)
      do i = 1, 6
         if (allocated(error)) return
         call check(error, all(sweep_position(deck%sweep, i) == expected(:, i)))
      end do
   end subroutine last_key_is_fastest

   subroutine case_has_values(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call parse_sample(changed_deck("", grid), deck, raised)
      if (.not. allocated(raised)) call make_sweep_case(deck, 4, case, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, case%operating_point%speed, 20.0_wp*pi, rel=.true., thr=4.0_wp*epsilon(1.0_wp))
      if (allocated(error)) return
      call check(error, case%film%law, "pan_hamrock")
      if (allocated(error)) return
      call make_sweep_case(deck, 1, case, raised)
      call check(error, case%operating_point%speed, 10.0_wp*pi, rel=.true., thr=4.0_wp*epsilon(1.0_wp))
   end subroutine case_has_values

   subroutine values_are_listed(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      !> Speeds [rpm]
      real(wp), allocatable :: numbers(:)
      character(len=:), allocatable :: words(:)

      call parse_sample(changed_deck("", grid), deck, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call sweep_numbers(deck%sweep, 1, numbers)
      call check(error, all(nint(numbers) == [300, 300, 600, 600, 900, 900]))
      if (allocated(error)) return
      call sweep_words(deck%sweep, 2, words)
      call check(error, words(1) == "moes" .and. words(6) == "pan_hamrock")
      if (allocated(error)) return
      call check(error, trim(deck%sweep%axes(1)%unit), "rpm")
   end subroutine values_are_listed

   subroutine outside_of_grid(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call parse_sample(changed_deck("", grid), deck, raised)
      call make_sweep_case(deck, 7, case, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, raised%kind, kind_usage)
   end subroutine outside_of_grid

   subroutine sweep_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: speed = "&sweep key_1 = 'operating_point.speed_rpm' "

      call expect_mistake(error, "", "&sweep /", "11:1: &sweep needs 'key_1' with 'values_1'")
      call expect_mistake(error, "", speed//"/", "11:16: 'key_1' needs either 'values_1' or 'from_1', 'to_1' and 'count_1'")
      call expect_mistake(error, "", speed//"values_1 = 1 from_1 = 1 to_1 = 2 count_1 = 2 /", "11:16: 'key_1' needs either")
      call expect_mistake(error, "", speed//"values_1 = 1, fast /", &
         & "11:55: value 2 of operating_point.speed_rpm: 'speed_rpm' takes one number, not fast")
      call expect_mistake(error, "", speed//"values_1 = 1, -2 /", &
         & "11:55: value 2 of operating_point.speed_rpm: 'speed_rpm' must be above 0, not -2")
      call expect_mistake(error, "", speed//"values_1 = 1, 2, 1 /", "11:55: value 1 of operating_point.speed_rpm is there twice")
      call expect_mistake(error, "", speed//"values_1 = 600, 6e2 /", "11:55: value 6e2 of operating_point.speed_rpm is there twice")
      call expect_mistake(error, "", speed//"from_1 = 6e2 to_1 = 600 count_1 = 3 /", &
         & "11:53: value 600 of operating_point.speed_rpm is there twice")
      call expect_mistake(error, "", "&sweep key_1 = 'numerics.max_cycles' from_1 = 2 to_1 = 4 count_1 = 9 "// &
         & "scale_1 = 'logarithmic' /", "11:47: value 2 of numerics.max_cycles is there twice")
      call expect_mistake(error, "", "&sweep key_1 = 'film.law' values_1 = 'moes', moes /", &
         & "11:38: value moes of film.law is there twice")
      call expect_mistake(error, "", speed//"values_1 = 1, 2 count_1 = 5 /", "11:16: 'key_1' needs either")
      call expect_mistake(error, "", speed//"from_1 = 1 to_1 = 2 count_1 = 1 /", "11:74: 'count_1' must be from 2 to 1000000")
      call expect_mistake(error, "", speed//"values_1 = 1 key_2 = 'operating_point.speed_rpm' values_2 = 2 /", &
         & "11:65: 'operating_point.speed_rpm' is swept twice")
      call expect_mistake(error, "", "&sweep key_1 = 'operating_point.speed' values_1 = 1 /", &
         & "11:16: unknown key 'speed' in &operating_point; did you mean 'speed_rpm'?")
      call expect_mistake(error, "", "&sweep key_1 = 'speed_rpm' values_1 = 1 /", "11:16: 'speed_rpm' is no name of a key: "// &
         & "that is given as group.key")
      call expect_mistake(error, "", "&sweep key_1 = 'operating_point.speed_rpm' values_1 = 300,,900 /", &
         & "11:55: 'values_1' has an empty place between commas: 300,,900")
      call expect_mistake(error, "", "&sweep key_1 = 'operating_point.speed_rpm' values_1 = , 300 900 /", &
         & "11:55: 'values_1' has an empty place between commas")
      call expect_mistake(error, "", "&sweep key_1 = 'asperity.boundary' values_1 = 'full' /", "11:16: &asperity is not in")
      call expect_mistake(error, "", "&sweep key_1 = 'lift.exponents' values_1 = 3 4 /", "11:16: 'exponents' is a list")
      call expect_mistake(error, "", "&sweep key_1 = 'output.series' values_1 = .true. /", "11:16: keys of &output cannot be swept")
      call expect_mistake(error, "", "&sweep values_1 = 3 4 /", "11:19: there is no 'key_1' for it")
   end subroutine sweep_mistakes

   subroutine broken_rule(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call parse_sample(changed_deck("", "&sweep key_1 = 'roller.wall_thickness_mm' values_1 = 2, 9 /"), deck, raised)
      if (.not. allocated(raised)) call make_sweep_case(deck, 1, case, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call make_sweep_case(deck, 2, case, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, index(raised%message, "case 1 (roller.wall_thickness_mm=9): override: "// &
         & "'wall_thickness_mm' must be below"), 1, &
         & raised%message)
   end subroutine broken_rule

   subroutine seed_of_samples(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: words
      integer :: i

      call say_use("sweep.seed", words)
      do i = 1, size(sample_names)
         call check(error, index(words, "'"//trim(sample_names(i))//"'") > 0, words)
         if (allocated(error)) return
      end do
   end subroutine seed_of_samples

end module test_deck_sweep
