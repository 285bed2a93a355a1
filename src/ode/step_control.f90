!> Length of the next step by the errors of this one and of the one before: proportional-integral control.
!>
!> In: errors over tolerance, order of the error estimate. Out: the next step over this one. Source: Hairer and Wanner (1996),
!> section IV.2.
module camroller_step_control
   use camroller_kinds, only : wp
   implicit none
   private

   public :: control_t, next_step, shorter_step, safety, impossible_error, shortest_step, last_part

   !> How steps follow errors
   type :: control_t
      !> Exponents of this error and of the last one, over one by the order of the error estimate [-]
      real(wp) :: proportional, integral
      !> Error over tolerance below which smaller ones make no difference [-]
      real(wp) :: least_error
      !> Largest growth of a step [-]
      real(wp) :: max_growth
   end type control_t

   !> Part of the optimal step that is taken; smallest part of a step that the next one may be [-]
   real(wp), parameter :: safety = 0.9_wp, max_shrinkage = 0.2_wp
   !> Error over tolerance below which smaller ones make no difference to a step that is tried again [-]
   real(wp), parameter :: least_error = 1.0e-3_wp
   !> Error over tolerance that stands for an impossible trial [-]
   real(wp), parameter :: impossible_error = 1.0e3_wp
   !> Shortest step, over the distance of numbers at its time [-]
   real(wp), parameter :: shortest_step = 16.0_wp
   !> A step that would leave so much of a segment, over its own length, ends it [-]
   real(wp), parameter :: last_part = 1.0e-9_wp

contains

   !> Step after one that was accepted, over that one; the error of this step becomes the last one.
   pure subroutine next_step(control, error_order, scaled_error, last_error, factor)
      !> How steps follow errors
      type(control_t), intent(in) :: control
      !> Order of the error estimate, above zero
      integer, intent(in) :: error_order
      !> Error of the step over tolerance [-]
      real(wp), intent(in) :: scaled_error
      !> In: that of the step accepted before; out: that of this one [-]
      real(wp), intent(inout) :: last_error
      !> Next step over this one [-]
      real(wp), intent(out) :: factor

      ! Error that counts [-]
      real(wp) :: error_in_use

      error_in_use = max(scaled_error, control%least_error)
      factor = safety*error_in_use**(-control%proportional/error_order)*last_error**(control%integral/error_order)
      factor = min(control%max_growth, max(max_shrinkage, factor))
      last_error = error_in_use
   end subroutine next_step

   !> Step that is tried in the place of one with an error too large, over that one.
   pure function shorter_step(error_order, scaled_error) result(factor)
      !> Order of the error estimate
      integer, intent(in) :: error_order
      !> Error over tolerance [-]
      real(wp), intent(in) :: scaled_error
      !> The part; above one where the error was small enough [-]
      real(wp) :: factor

      factor = max(max_shrinkage, safety*max(scaled_error, least_error)**(-1.0_wp/max(error_order, 1)))
   end function shorter_step

end module camroller_step_control
