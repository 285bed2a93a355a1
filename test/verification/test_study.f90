!> Studies: error measures, ways, refusal of references, the table.
module test_study
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, kind_convergence
   use camroller_case, only : case_t
   use camroller_ode_methods, only : method_names
   use camroller_study, only : plan_t, plan_for, way_t, apply_way, check_agreement, dial_reference, list_ways, new_study_table, &
      & study_case
   use camroller_study_table, only : study_table_t, add_numbers, add_words, new_row, set_number, set_word, column_of, words_of
   use camroller_sorting, only : median
   use camroller_study_trial, only : trial_t, errors_against, relative_error, run_trial, smallest_error
   use reference_cases, only : thesis_case
   implicit none
   private

   public :: collect_study

contains

   subroutine collect_study(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("errors are relative to the largest value of the reference", test_errors), &
         new_unittest("the median of runs does not follow one slow run", test_median), &
         new_unittest("references that disagree are refused", test_refusal), &
         new_unittest("a study includes the accuracies of decks and every method", test_ways), &
         new_unittest("a study of a flexible train has its own references and settings", test_flexible_plan), &
         new_unittest("a setting of a study changes its own option and no other", test_apply), &
         new_unittest("a table that grows returns its columns", test_table), &
         new_unittest("a trial that fails is recorded", test_failure), &
         new_unittest("a quick study: errors fall with tolerance and accuracy, and accuracies are kept", test_quick) &
         ]
   end subroutine collect_study

   subroutine test_errors(error)
      type(error_type), allocatable, intent(out) :: error
      type(trial_t) :: reference, trial

      reference%sliding_speed = [1.0_wp, -2.0_wp]
      reference%mean_friction = 4.0_wp
      reference%smallest_film = 1.0_wp
      trial = reference
      trial%sliding_speed(1) = 1.5_wp
      trial%mean_friction = 3.0_wp
      trial%smallest_film = 1.125_wp
      call check(error, all(abs(errors_against(reference, trial) - [0.25_wp, 0.25_wp, 0.125_wp]) <= 0.0_wp))
      if (allocated(error)) return
      reference%sliding_speed = 0.0_wp
      trial%sliding_speed = 0.0_wp
      call check(error, all(abs(errors_against(reference, trial) - [0.0_wp, 0.25_wp, 0.125_wp]) <= 0.0_wp), "no sliding")
      if (allocated(error)) return
      call check(error, relative_error(3.0_wp, -4.0_wp), 1.75_wp)
      if (allocated(error)) return
      call check(error, relative_error(1.0e-300_wp, 0.0_wp), 1.0_wp)
   end subroutine test_errors

   subroutine test_median(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, median([2.0_wp, 90.0_wp, 1.0_wp]), 2.0_wp)
      if (allocated(error)) return
      call check(error, median([4.0_wp, 1.0_wp, 90.0_wp, 2.0_wp]), 3.0_wp)
      if (allocated(error)) return
      call check(error, median([5.0_wp]), 5.0_wp)
      if (allocated(error)) return
      call check(error, median([7.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 9.0_wp]), 3.0_wp)
   end subroutine test_median

   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure

      call check_agreement(plan_t(), 0.09_wp*smallest_error, failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      call check_agreement(plan_t(), 0.11_wp*smallest_error, failure)
      call check(error, allocated(failure))
      if (allocated(error)) return
      call check(error, failure%kind, kind_convergence)
      if (allocated(error)) return
      call check(error, index(failure%message, "rodas5p and dormand_prince differ by 1.1e-9; 1e-9 is allowed") > 0, &
         & failure%message)
   end subroutine test_refusal

   subroutine test_flexible_plan(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(plan_t) :: plan
      type(way_t), allocatable :: ways(:)
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call check(error, .not. plan_is_flexible(plan_for(the_case)))
      if (allocated(error)) return
      allocate (the_case%dynamics)
      plan = plan_for(the_case)
      call check(error, plan_is_flexible(plan) .and. plan%methods(2) == "radau5")
      if (allocated(error)) return
      call list_ways(plan, ways, .false.)
      ! four accuracies down to 1e-5, and three methods with six tolerances down to 1e-6 each
      call check(error, size(ways), 4 + 3*6)
      if (allocated(error)) return
      call check(error, all(ways%dial == "accuracy" .or. ways%dial == "tolerance") .and. .not. any(ways%name == "hermite"))
      if (allocated(error)) return
      call check(error, minval(ways%setting) > 0.9e-6_wp)
      if (allocated(error)) return
      call check_agreement(plan, 0.9e-7_wp, failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      call check_agreement(plan, 1.1e-7_wp, failure)
      call check(error, index(failure%message, "rodas5p and radau5 differ by 1.1e-7; 1e-7 is allowed") > 0, failure%message)

   contains

      logical function plan_is_flexible(plan)
         type(plan_t), intent(in) :: plan

         plan_is_flexible = plan%is_flexible
      end function plan_is_flexible

   end subroutine test_flexible_plan

   subroutine test_ways(error)
      type(error_type), allocatable, intent(out) :: error
      type(way_t), allocatable :: ways(:)
      integer :: i

      call list_ways(plan_t(), ways, .false.)
      do i = 1, size(method_names)
         call check(error, count(ways%name == method_names(i)) >= 8, trim(method_names(i)))
         if (allocated(error)) return
      end do
      call check(error, all((ways%dial == "step [deg]") .eqv. (ways%name == "euler")))
      if (allocated(error)) return
      call check(error, count(ways%dial == "accuracy" .and. ways%name == "automatic") == 6)
      if (allocated(error)) return
      call check(error, any(ways%dial == "step [deg]" .and. abs(ways%setting - 1.0_wp) <= 0.0_wp), "the printed step is missing")
   end subroutine test_ways

   subroutine test_apply(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case

      the_case%numerics%max_cycles = 7
      the_case = apply_way(way_t("radau5", "tolerance", 1.0e-3_wp), the_case)
      call check(error, the_case%numerics%method == "radau5" .and. the_case%numerics%max_cycles == 7)
      if (allocated(error)) return
      call check(error, the_case%numerics%tolerance, 1.0e-3_wp)
      if (allocated(error)) return
      the_case = apply_way(way_t("euler", "step [deg]", 0.5_wp), the_case)
      call check(error, the_case%numerics%step, 0.5_wp*degree)
      if (allocated(error)) return
      the_case = apply_way(way_t("automatic", "accuracy", 1.0e-5_wp), the_case)
      call check(error, the_case%numerics%tolerance <= 0.0_wp .and. abs(the_case%numerics%accuracy - 1.0e-5_wp) <= 0.0_wp)
      if (allocated(error)) return
      the_case = apply_way(way_t("numerical film", "film accuracy", 0.03_wp), the_case)
      call check(error, allocated(the_case%ehl))
      if (allocated(error)) return
      call check(error, the_case%ehl%accuracy, 0.03_wp)
      if (allocated(error)) return
      the_case = apply_way(way_t("moes", "", 0.0_wp), the_case)
      call check(error, .not. allocated(the_case%ehl))
   end subroutine test_apply

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(study_table_t) :: table
      integer :: i

      call add_words(table, "word", "", "")
      call add_numbers(table, "one", "1", "", "")
      call add_numbers(table, "two", "1", "", "")
      do i = 1, 200
         call new_row(table)
         call set_word(table, "word", "w")
         call set_number(table, "two", -real(i, wp))
      end do
      call check(error, table%rows, 200)
      if (allocated(error)) return
      call check(error, sum(column_of(table, "two")), -20100.0_wp)
      if (allocated(error)) return
      call check(error, all(ieee_is_nan(column_of(table, "one"))), "a number that was not given")
      if (allocated(error)) return
      call check(error, all(words_of(table, "word") == "w"))
   end subroutine test_table

   subroutine test_failure(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(trial_t) :: trial

      the_case = thesis_case()
      the_case%numerics%method = "euler"
      the_case%numerics%max_cycles = 1
      the_case%numerics%periodicity = 1.0e-12_wp
      call run_trial(the_case, 1, trial)
      call check(error, trial%status, kind_convergence)
      if (allocated(error)) return
      call check(error, index(trial%message, "did not become periodic") > 0, trial%message)
   end subroutine test_failure

   subroutine test_quick(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(study_table_t) :: table
      type(error_t), allocatable :: failure
      ! Columns of the table [-]
      real(wp), allocatable :: status(:), errors(:), settings(:)
      logical, allocatable :: with_tolerance(:), with_accuracy(:)
      character(len=:), allocatable :: dials(:)

      the_case = thesis_case()
      the_case%operating_point%speed = 150.0_wp
      call new_study_table(table)
      call study_case(table, 1, the_case, 1, .true., failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      dials = words_of(table, "dial")
      call check(error, dials(1) == dial_reference .and. table%rows == 1 + 6 + 3*(size(method_names) - 1) + 2 + 1)
      if (allocated(error)) return
      with_tolerance = words_of(table, "dial") == "tolerance" .and. words_of(table, "way") /= "quasi_static"
      with_accuracy = words_of(table, "dial") == "accuracy"
      status = pack(column_of(table, "status"), with_tolerance .or. with_accuracy)
      call check(error, all(status <= 0.0_wp))
      if (allocated(error)) return
      errors = column_of(table, "error_sliding_speed")
      call check(error, errors(1) <= 0.1_wp*smallest_error, "references")
      if (allocated(error)) return
      settings = pack(column_of(table, "setting"), with_tolerance)
      errors = pack(column_of(table, "error_sliding_speed"), with_tolerance)
      ! The error over a cycle stays within a hundred tolerances of a step, as decay forgets what came before
      call check(error, all(errors <= 100.0_wp*settings), "tolerances")
      if (allocated(error)) return
      settings = pack(column_of(table, "setting"), with_accuracy)
      errors = pack(column_of(table, "error_sliding_speed"), with_accuracy)
      call check(error, all(errors <= settings), "accuracies")
      if (allocated(error)) return
      call check(error, .not. any(ieee_is_nan(column_of(table, "time")) .and. (with_tolerance .or. with_accuracy)), "times")
   end subroutine test_quick

end module test_study
