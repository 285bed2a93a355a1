!> Whether the accuracy that a user asks for is kept, and what it costs.
!>
!> Layer: solver. In: a case and its reference. Out: rows of `study_table_t`: accuracy asked for, error found, error estimated, work
!> of the last integration, time of the whole run with all series and means.
module camroller_study_accuracy
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t, automatic_method
   use camroller_result, only : quantity_t, result_t, find_quantity
   use camroller_run, only : run_case
   use camroller_study, only : reference_t, smallest_error
   use camroller_study_errors, only : largest_deviation, relative_error
   use camroller_study_probe, only : loss_count, loss_names, median
   use camroller_study_table, only : study_table_t, new_table, add_row
   implicit none
   private

   public :: new_accuracy_table, study_accuracy

   !> Accuracies asked for [-]
   real(wp), parameter :: accuracies(*) = [1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp, 1.0e-5_wp, 1.0e-6_wp, 1.0e-7_wp]
   !> Columns with numbers
   integer, parameter :: columns = 9

contains

   !> Table of accuracies, one row for each run.
   subroutine new_accuracy_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call new_table(table, [quantity_t("message", "", "what went wrong, or nothing", "study")], [ &
         & quantity_t("case", "1", "case of the sweep", "study"), &
         & quantity_t("status", "1", "0, or the kind of the error", "study"), &
         & quantity_t("accuracy", "1", "accuracy asked for", "study"), &
         & quantity_t("error_sliding_speed", "1", "largest error of the sliding speed over its largest value", "study"), &
         & quantity_t("error_losses", "1", "largest error of a mean torque lost over its value", "study"), &
         & quantity_t("estimated_error", "1", "error of the sliding speed as the program estimates it", "study"), &
         & quantity_t("evaluations", "1", "evaluations of the roller equation", "study"), &
         & quantity_t("steps", "1", "accepted steps", "study"), &
         & quantity_t("time", "s", "median time of the run with all series and means", "study")])
   end subroutine new_accuracy_table

   !> Every accuracy for a case.
   subroutine study_accuracy(table, position, case, reference, repeats)
      !> Table of accuracies
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Its reference
      type(reference_t), intent(in) :: reference
      !> Runs whose median time counts
      integer, intent(in) :: repeats

      type(case_t) :: trial
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Numbers of a row [unit of the column], times [s]
      real(wp) :: numbers(columns), times(max(repeats, 1))
      integer(int64) :: start, finish, rate
      integer :: i, run

      trial = case
      trial%numerics%method = automatic_method
      trial%numerics%tolerance = 0.0_wp
      do i = 1, size(accuracies)
         trial%numerics%accuracy = accuracies(i)
         do run = 1, size(times)
            call system_clock(start, rate)
            call run_case(trial, result, failure)
            call system_clock(finish)
            times(run) = real(finish - start, wp)/real(rate, wp)
         end do
         numbers = ieee_value(1.0_wp, ieee_quiet_nan)
         numbers(:3) = [real(position - 1, wp), 0.0_wp, accuracies(i)]
         if (allocated(failure)) then
            numbers(2) = failure%kind
            call add_row(table, [failure%message], numbers)
            cycle
         end if
         numbers(4:) = [errors_of(result, reference), summary_value(result, "estimated_error"), &
            & summary_value(result, "counter_evaluations"), summary_value(result, "counter_steps"), median(times)]
         call add_row(table, [""], numbers)
      end do
   end subroutine study_accuracy

   !> Error of the sliding speed, largest error of a mean loss.
   pure function errors_of(result, reference) result(errors)
      !> The result
      type(result_t), intent(in) :: result
      !> What counts as right
      type(reference_t), intent(in) :: reference
      !> Both errors [-]
      real(wp) :: errors(2)

      integer :: i

      errors = smallest_error
      errors(1) = max(errors(1), largest_deviation(result%series_values(:, find_quantity(result%series, "sliding_speed")), &
         & reference%probe%sliding_speed))
      do i = 1, loss_count
         if (.not. reference%probe%has_loss(i)) cycle
         errors(2) = max(errors(2), relative_error(summary_value(result, "mean_torque_"//trim(loss_names(i))), &
            & reference%probe%losses(i)))
      end do
   end function errors_of

   !> A scalar of the summary that is there.
   pure function summary_value(result, name) result(value)
      !> The result
      type(result_t), intent(in) :: result
      !> Name of the scalar
      character(len=*), intent(in) :: name
      !> Its value [unit of the scalar]
      real(wp) :: value

      value = result%summary_values(find_quantity(result%summary, name))
   end function summary_value

end module camroller_study_accuracy
