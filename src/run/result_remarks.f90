!> Remarks on the error of a result: an accuracy that was not reached, a tolerance that says nothing of the error, a motion without
!> a period.
!>
!> In: numerics as given, the result of a case. Out: remarks, or an error where nothing of the result can be right.
module camroller_accuracy_remarks
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_accuracy, only : is_checked, has_tolerance, far_beyond
   use camroller_case, only : numerics_t
   use camroller_number_text, only : number_text, fixed_text
   use camroller_remarks, only : add_remark, loose_tolerance, missed_accuracy, missed_extremes, missed_means, no_period
   use camroller_result, only : result_t, get_summary
   implicit none
   private

   public :: judge

contains

   !> Remarks on errors that are too large.
   subroutine judge(numerics, result, error)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      !> The result
      type(result_t), intent(inout) :: result
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Estimated errors of sliding speed, means and extremes [-]
      real(wp) :: estimates(3)

      call get_estimates(result, estimates, error)
      if (allocated(error)) return
      if (is_checked(numerics)) call judge_accuracy(result, numerics%accuracy, estimates, error)
      if (has_tolerance(numerics)) call judge_tolerance(numerics, result, estimates)
   end subroutine judge

   !> Remarks on an accuracy that was not reached, or an error where nothing of the result can be right.
   subroutine judge_accuracy(result, accuracy, estimates, error)
      !> The result
      type(result_t), intent(inout) :: result
      !> Accuracy wanted [-]
      real(wp), intent(in) :: accuracy
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Cam angle where the estimate is largest [deg]
      real(wp) :: angle

      if (estimates(1) >= 1.0_wp .and. .not. lacks_period(result)) then
         call get_summary(result, "estimated_error_angle", angle, error)
         if (allocated(error)) return
         call raise(error, kind_convergence, "the cycle was not found: its estimated error is "//number_text(estimates(1), 2)// &
            & " of the sliding speed, largest at cam angle "//fixed_text(angle, 3)//" deg; the spin is hardly damped there, or "// &
            & "friction reaches its limit abruptly")
         return
      end if
      if (estimates(1) > accuracy .and. lacks_period(result)) then
         call say_scatter(result, estimates(1))
      else if (estimates(1) > accuracy) then
         call add_remark(result%remarks, missed_accuracy, "the accuracy asked for was not reached; the estimated error is "// &
            & number_text(estimates(1), 2), estimates(1))
      end if
      if (estimates(2) > accuracy) call add_remark(result%remarks, missed_means, &
         & "the means did not reach the accuracy asked for; the largest estimated error, of mean_"//trim(result%worst_mean)// &
         & ", is "//number_text(estimates(2), 2), estimates(2))
      if (estimates(3) > accuracy .and. lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > accuracy) then
         call add_remark(result%remarks, missed_extremes, "the extremes did not reach the accuracy asked for; the largest "// &
            & "estimated error, of "//trim(result%worst_extreme)//", is "//number_text(estimates(3), 2)//" of its range", &
            & estimates(3))
      end if
   end subroutine judge_accuracy

   !> Is a train of the case without a period?
   pure function lacks_period(result) result(verdict)
      !> The result
      type(result_t), intent(in) :: result
      !> Is one?
      logical :: verdict

      integer :: i

      verdict = any([(result%remarks(i)%kind == no_period, i=1, size(result%remarks))])
   end function lacks_period

   !> Remark on the error of a motion without a period.
   subroutine say_scatter(result, estimate)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result
      !> Error estimated [-]
      real(wp), intent(in) :: estimate

      call add_remark(result%remarks, missed_accuracy, "the motion without a period is known by its statistics alone: within a "// &
         & "turn errors of steps grow to an estimated "//number_text(estimate, 2)//" of the largest load or sliding speed, and "// &
         & "a smaller tolerance leads along other turns; go by the summary and its scatter over the cycles, not by the series", &
         & estimate)
   end subroutine say_scatter

   !> Remark on extremes of a motion without a period: a smaller tolerance leads along other turns, and no accuracy changes that.
   subroutine say_no_period(result)
      !> The result; gets the remark
      type(result_t), intent(inout) :: result

      call add_remark(result%remarks, missed_extremes, "smallest and largest values are those of the turns computed: without a "// &
         & "period they have no error that could be estimated")
   end subroutine say_no_period

   !> Remark on a tolerance given by hand that says nothing of the error: steps keep to it and the curve between them does not, or
   !> errors of steps pile up where hardly anything damps, or means follow the sliding speed too strongly.
   subroutine judge_tolerance(numerics, result, estimates)
      !> Numerics as given
      type(numerics_t), intent(in) :: numerics
      !> The result
      type(result_t), intent(inout) :: result
      !> Estimated errors of sliding speed, means and extremes [-]
      real(wp), intent(in) :: estimates(3)

      if (estimates(1) > numerics%tolerance*far_beyond .and. lacks_period(result)) then
         call say_scatter(result, estimates(1))
      else if (estimates(1) > numerics%tolerance*far_beyond) then
         call say_far("the error", estimates(1))
      end if
      if (estimates(2) > numerics%tolerance*far_beyond) call say_far("the error of mean_"//trim(result%worst_mean), estimates(2))
      if (estimates(3) > numerics%tolerance*far_beyond .and. lacks_period(result)) then
         call say_no_period(result)
      else if (estimates(3) > numerics%tolerance*far_beyond) then
         call say_far("the error of the extremes of "//trim(result%worst_extreme), estimates(3))
      end if

   contains

      !> The remark on one of the errors.
      subroutine say_far(what, estimate)
         !> The error in words
         character(len=*), intent(in) :: what
         !> Its estimate [-]
         real(wp), intent(in) :: estimate

         call add_remark(result%remarks, loose_tolerance, "the tolerance "//number_text(numerics%tolerance, 2)// &
            & " does not control "//what//": its estimate is "//number_text(estimate, 2)// &
            & "; give 'accuracy' instead of 'tolerance'", estimate)
      end subroutine say_far

   end subroutine judge_tolerance

   !> Estimated errors of a result: of the sliding speed, of the means, of the extremes.
   subroutine get_estimates(result, estimates, error)
      !> The result
      type(result_t), intent(in) :: result
      !> Errors [-]
      real(wp), intent(out) :: estimates(3)
      !> Usage error where they are not in the summary
      type(error_t), allocatable, intent(out) :: error

      call get_summary(result, "estimated_error", estimates(1), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_means", estimates(2), error)
      if (.not. allocated(error)) call get_summary(result, "estimated_error_of_extremes", estimates(3), error)
   end subroutine get_estimates

end module camroller_accuracy_remarks
