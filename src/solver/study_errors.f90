!> How far a trial of a study is from its reference.
!>
!> Layer: solver. In: probes. Out: relative errors; numbers without unit.
!>
!> The sliding speed is measured by its largest deviation over its largest value: speeds of the roller, which pure rolling gives to
!> a few parts in ten thousand, would hide everything.
module camroller_study_errors
   use camroller_kinds, only : wp
   use camroller_study_probe, only : probe_t, loss_count
   implicit none
   private

   public :: errors_t, errors_against, largest_error, largest_deviation, relative_error, total_variation

   !> Errors of a trial
   type :: errors_t
      !> Largest deviation of the sliding speed over its largest value [-]
      real(wp) :: sliding_speed = 0.0_wp
      !> Error of the mean torque of each loss over its value; zero where the case has not got it [-]
      real(wp) :: losses(loss_count) = 0.0_wp
      !> Error of the smallest film over its value [-]
      real(wp) :: film_min = 0.0_wp
   end type errors_t

contains

   !> Errors of a trial against another one.
   pure function errors_against(reference, probe) result(errors)
      !> What counts as right
      type(probe_t), intent(in) :: reference
      !> The trial, without a failure
      type(probe_t), intent(in) :: probe
      !> Its errors
      type(errors_t) :: errors

      errors%sliding_speed = largest_deviation(probe%sliding_speed, reference%sliding_speed)
      errors%losses = relative_error(probe%losses, reference%losses)
      errors%film_min = relative_error(probe%film_min, reference%film_min)
   end function errors_against

   !> Largest of all errors of a trial.
   pure function largest_error(errors) result(largest)
      !> The errors
      type(errors_t), intent(in) :: errors
      !> Largest of them [-]
      real(wp) :: largest

      largest = max(errors%sliding_speed, maxval(errors%losses), errors%film_min)
   end function largest_error

   !> Largest deviation of a series over the largest value of the reference.
   pure function largest_deviation(values, reference) result(error)
      !> Two series at the same angles [any]
      real(wp), intent(in) :: values(:), reference(:)
      !> The deviation, zero where both are zero everywhere [-]
      real(wp) :: error

      error = relative_error(maxval(abs(values - reference)) + maxval(abs(reference)), maxval(abs(reference)))
   end function largest_deviation

   !> Deviation of a number over the reference.
   elemental function relative_error(value, reference) result(error)
      !> The number and what counts as right [any]
      real(wp), intent(in) :: value, reference
      !> Deviation; zero where both are zero, one where the reference alone is [-]
      real(wp) :: error

      error = abs(value - reference)
      if (abs(reference) > 0.0_wp) then
         error = error/abs(reference)
      else if (error > 0.0_wp) then
         error = 1.0_wp
      end if
   end function relative_error

   !> Sum of all changes of a series over a closed cycle: chatter makes it grow where means stay as they are.
   pure function total_variation(values) result(variation)
      !> The series, end point left out [any]
      real(wp), intent(in) :: values(:)
      !> Sum of the sizes of its changes [any]
      real(wp) :: variation

      variation = sum(abs(values - cshift(values, -1)))
   end function total_variation

end module camroller_study_errors
