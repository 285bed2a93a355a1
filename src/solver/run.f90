!> One case from start to end: models, cycles, result.
!>
!> Layer: solver. In: `case_t`. Out: `result_t`. No files, no printing, no state left behind.
module camroller_run
   use camroller_error, only : error_t, add_context
   use camroller_case, only : case_t
   use camroller_model, only : model_t, new_model
   use camroller_events, only : check_geometry
   use camroller_cycle, only : cycle_t, integrate_cycle
   use camroller_report, only : make_result
   use camroller_result, only : result_t
   implicit none
   private

   public :: run_case, build_models

contains

   !> Run a case.
   subroutine run_case(case, result, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(out) :: result
      !> What went wrong, of any kind
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      type(cycle_t), allocatable :: cycles(:)
      integer :: lobe

      call build_models(case, models, error)
      if (allocated(error)) return
      allocate (cycles(size(models)))
      do lobe = 1, size(models)
         call integrate_cycle(cycles(lobe), models(lobe), case%numerics, error)
         if (allocated(error)) return
      end do
      call make_result(case, models, cycles, result, error)
   end subroutine run_case

   !> Models of the lobe shapes of a case, geometry checked over the whole cycle.
   subroutine build_models(case, models, error)
      !> The case
      type(case_t), intent(in) :: case
      !> One model per lobe shape
      type(model_t), allocatable, intent(out) :: models(:)
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      allocate (models(merge(2, 1, allocated(case%second_lift))))
      do lobe = 1, size(models)
         if (lobe == 1) then
            call new_model(models(lobe), case, case%lift, error)
         else
            call new_model(models(lobe), case, case%second_lift, error)
         end if
         if (.not. allocated(error)) call check_geometry(models(lobe), case%mechanism%grinding_wheel_radius, error)
         if (allocated(error)) then
            if (lobe == 2) call add_context(error, "second lift")
            return
         end if
      end do
   end subroutine build_models

end module camroller_run
