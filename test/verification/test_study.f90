!> Studies: error measures, ladder, refusal of references, variants, tables.
module test_study
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, kind_convergence
   use camroller_case, only : case_t
   use camroller_ode_methods, only : method_names
   use camroller_result, only : quantity_t
   use camroller_study, only : reference_t, smallest_error, check_reference, make_reference, new_method_table, study_methods
   use camroller_study_errors, only : errors_t, errors_against, largest_error, largest_deviation, relative_error, &
      & total_variation
   use camroller_study_ladder, only : rung_t, make_ladder, numerics_of
   use camroller_study_models, only : make_variant, variant_count, variant_names
   use camroller_study_probe, only : probe_t, run_probe, median
   use camroller_study_table, only : study_table_t, new_table, add_row, column_of
   use reference_cases, only : thesis_case, source_case
   implicit none
   private

   public :: collect_study

contains

   subroutine collect_study(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("errors are relative to the largest value of the reference", test_measures), &
         new_unittest("errors of a trial are those of its parts", test_errors), &
         new_unittest("chatter shows in the total variation", test_variation), &
         new_unittest("the median of runs does not follow one slow run", test_median), &
         new_unittest("references that disagree are refused", test_refusal), &
         new_unittest("the ladder has every method, with tolerances or steps", test_ladder), &
         new_unittest("a rung changes the method and leaves the rest", test_numerics), &
         new_unittest("a table grows and gives its columns back", test_table), &
         new_unittest("each variant changes one thing, and leaves a case alone that has it already", test_variants), &
         new_unittest("a trial that fails is recorded", test_failure), &
         new_unittest("a reference is made, and every method of a quick study is in the table", test_methods) &
         ]
   end subroutine collect_study

   subroutine test_measures(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, largest_deviation([1.0_wp, -3.5_wp], [1.25_wp, -4.0_wp]), 0.125_wp)
      if (allocated(error)) return
      call check(error, largest_deviation([0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp]), 0.0_wp)
      if (allocated(error)) return
      call check(error, relative_error(3.0_wp, -4.0_wp), 1.75_wp)
      if (allocated(error)) return
      call check(error, relative_error(1.0e-300_wp, 0.0_wp), 1.0_wp)
   end subroutine test_measures

   subroutine test_errors(error)
      type(error_type), allocatable, intent(out) :: error
      type(probe_t) :: reference, probe
      type(errors_t) :: errors

      reference%sliding_speed = [1.0_wp, -2.0_wp]
      reference%losses(1) = 4.0_wp
      reference%film_min = 1.0_wp
      probe = reference
      probe%sliding_speed(1) = 1.5_wp
      probe%losses(1) = 3.0_wp
      probe%film_min = 1.125_wp
      errors = errors_against(reference, probe)
      call check(error, all(abs([errors%sliding_speed, errors%losses(1), errors%losses(2), errors%film_min] &
         & - [0.25_wp, 0.25_wp, 0.0_wp, 0.125_wp]) <= 0.0_wp))
      if (allocated(error)) return
      call check(error, largest_error(errors), 0.25_wp)
   end subroutine test_errors

   subroutine test_variation(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, total_variation([0.0_wp, 1.0_wp, 2.0_wp, 1.0_wp]), 4.0_wp)
      if (allocated(error)) return
      call check(error, total_variation([0.0_wp, 2.0_wp, 0.0_wp, 2.0_wp]), 8.0_wp)
   end subroutine test_variation

   subroutine test_median(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, median([2.0_wp, 90.0_wp, 1.0_wp]), 2.0_wp)
      if (allocated(error)) return
      call check(error, median([4.0_wp, 1.0_wp, 90.0_wp, 2.0_wp]), 3.0_wp)
   end subroutine test_median

   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure

      call check_reference(0.09_wp*smallest_error, failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      call check_reference(0.11_wp*smallest_error, failure)
      call check(error, allocated(failure))
      if (allocated(error)) return
      call check(error, failure%kind, kind_convergence)
      if (allocated(error)) return
      call check(error, index(failure%message, "rodas5p and dormand_prince differ by") > 0)
   end subroutine test_refusal

   subroutine test_ladder(error)
      type(error_type), allocatable, intent(out) :: error
      type(rung_t), allocatable :: rungs(:)
      integer :: i

      call make_ladder(rungs, .false.)
      do i = 1, size(method_names)
         call check(error, count(rungs%method == method_names(i)) >= 9, trim(method_names(i)))
         if (allocated(error)) return
      end do
      call check(error, all((rungs%step > 0.0_wp) .eqv. (rungs%method == "euler")))
      if (allocated(error)) return
      call check(error, all((rungs%tolerance > 0.0_wp) .neqv. (rungs%step > 0.0_wp)))
      if (allocated(error)) return
      call check(error, any(abs(rungs%step - degree) <= 0.0_wp), "the printed step is missing")
   end subroutine test_ladder

   subroutine test_numerics(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case

      the_case%numerics%max_cycles = 7
      the_case%numerics = numerics_of(rung_t("radau5", tolerance=1.0e-3_wp), the_case%numerics)
      call check(error, the_case%numerics%method == "radau5" .and. the_case%numerics%max_cycles == 7)
      if (allocated(error)) return
      call check(error, the_case%numerics%tolerance, 1.0e-3_wp)
      if (allocated(error)) return
      the_case%numerics = numerics_of(rung_t("euler", step=0.5_wp), the_case%numerics)
      call check(error, the_case%numerics%step, 0.5_wp)
   end subroutine test_numerics

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(study_table_t) :: table
      integer :: i

      call new_table(table, [quantity_t("word", "", "", "")], [quantity_t("one", "1", "", ""), &
         & quantity_t("two", "1", "", "")])
      do i = 1, 200
         call add_row(table, ["w"], [real(i, wp), -real(i, wp)])
      end do
      call check(error, table%rows, 200)
      if (allocated(error)) return
      call check(error, sum(column_of(table, "two")), -20100.0_wp)
      if (allocated(error)) return
      call check(error, size(column_of(table, "three")), 0)
      if (allocated(error)) return
      call check(error, all(table%words(:200, 1) == "w"))
   end subroutine test_table

   subroutine test_variants(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, variant
      integer :: i, base, differing
      logical :: is_different

      the_case = thesis_case()
      call make_variant(the_case, 1, variant, base, is_different)
      call check(error, is_different .and. base == 1 .and. variant%energy == the_case%energy)
      if (allocated(error)) return
      differing = 0
      do i = 1, variant_count
         call make_variant(the_case, i, variant, base, is_different)
         if (is_different) differing = differing + 1
         call check(error, base == merge(9, 1, index(variant_names(i), "source:") == 1), trim(variant_names(i)))
         if (allocated(error)) return
         if (variant_names(i) == "no asperities") call check(error, .not. allocated(variant%asperity))
         if (variant_names(i) == "source: thesis spin") call check(error, variant%roller%spin == "thesis" &
            & .and. variant%energy == "source" .and. variant%spring%load_arm == the_case%spring%load_arm)
         if (variant_names(i) == "moes") call check(error, variant%film%law == "moes")
         if (variant_names(i) == "dowson_higginson") call check(error, .not. is_different)
         if (allocated(error)) return
      end do
      call check(error, differing >= 14)
      if (allocated(error)) return
      call make_variant(source_case(), 14, variant, base, is_different)
      call check(error, is_different .neqv. source_has_it_all())
   end subroutine test_variants

   !> Does the case in the source's bookkeeping have each of the source's simplifications?
   function source_has_it_all() result(answer)
      logical :: answer
      type(case_t) :: the_case

      the_case = source_case()
      answer = the_case%roller%spin == "thesis" .and. the_case%spring%load_arm == "parallel" .and. &
         & the_case%spring%seating == "maximum"
      if (allocated(the_case%asperity)) answer = answer .and. the_case%asperity%boundary == "full"
   end function source_has_it_all

   subroutine test_failure(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(probe_t) :: probe

      the_case = thesis_case()
      the_case%numerics%method = "euler"
      the_case%numerics%max_cycles = 1
      the_case%numerics%periodicity = 1.0e-12_wp
      call run_probe(the_case, 1, probe)
      call check(error, probe%status, kind_convergence)
      if (allocated(error)) return
      call check(error, index(probe%message, "did not become periodic") > 0, probe%message)
   end subroutine test_failure

   subroutine test_methods(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(reference_t) :: reference
      type(study_table_t) :: table
      type(error_t), allocatable :: failure
      ! Column of the table [-]
      real(wp), allocatable :: status(:), errors(:), tolerances(:)
      logical, allocatable :: is_adaptive(:)

      the_case = thesis_case()
      the_case%operating_point%speed = 40.0_wp
      call make_reference(the_case, reference, failure)
      call check(error, .not. allocated(failure))
      if (allocated(error)) return
      call new_method_table(table)
      call study_methods(table, 1, the_case, reference, 1, .true.)
      is_adaptive = table%words(:table%rows, 1) /= "euler" .and. table%words(:table%rows, 1) /= "quasi_static"
      call check(error, table%rows == 3*size(method_names) + 2 .and. count(is_adaptive) == table%rows - 5)
      if (allocated(error)) return
      status = pack(column_of(table, "status"), is_adaptive)
      call check(error, all(status <= 0.0_wp))
      if (allocated(error)) return
      errors = pack(column_of(table, "error_sliding_speed"), is_adaptive)
      tolerances = pack(column_of(table, "tolerance"), is_adaptive)
      ! The error over a cycle stays within a hundred tolerances of a step, as decay forgets what came before
      call check(error, all(errors <= 100.0_wp*tolerances))
   end subroutine test_methods

end module test_study
