!> Models kept from one case of a sweep for the next that has the same geometry, masses and spring, so that curves are fitted and
!> the geometry is checked only once.
!>
!> In: cases one after the other, with what tells their trains apart. Out: their models, bit by bit those that each case alone would
!> get. Which cases have the same train follows from the keys that vary: all keys belong to the train but those of the groups listed
!> here, from which `revise_model` makes everything anew.
module camroller_kept_models
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, revise_model
   use camroller_names, only : name_length
   implicit none
   private

   public :: kept_models_t, keep_models, recall_models, revised_groups

   !> Groups of a deck that are no part of the train
   character(len=*), parameter :: revised_groups(*) = [character(len=name_length) :: "operating_point", "gas_force", "materials", &
      & "surface", "lubricant", "film", "traction", "heat", "ehl", "asperity", "friction_modifier", "boundary_law", "wear", &
      & "tribofilm", "running_in", "needle_bearing", "needle_drag", "roller_profile", "cam_bearings", "bearing_asperity", &
      & "belt_pull", "bearing_heat", "shaft_drag", "valve_guide", "valve_tip", "stem_seal", "guide_side_load", "finger_pivot", &
      & "effects", "numerics"]

   !> Models of the last case whose train was another one's
   type :: kept_models_t
      private
      !> What tells the train from others
      character(len=:), allocatable :: train
      type(model_t), allocatable :: models(:)
   end type kept_models_t

contains

   !> Keep the models of a case.
   subroutine keep_models(kept, train, models)
      !> What is kept
      type(kept_models_t), intent(inout) :: kept
      !> What tells the train from others
      character(len=*), intent(in) :: train
      !> Its models
      type(model_t), intent(in) :: models(:)

      kept%train = train
      if (allocated(kept%models)) deallocate (kept%models)
      allocate (kept%models, source=models)
   end subroutine keep_models

   !> Models of a case from those that are kept, where they serve.
   subroutine recall_models(kept, train, case, models, error)
      !> What is kept
      type(kept_models_t), intent(in) :: kept
      !> What tells the train from others
      character(len=*), intent(in) :: train
      !> The case
      type(case_t), intent(in) :: case
      !> Its models; not allocated where none that serve are kept
      type(model_t), allocatable, intent(out) :: models(:)
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      if (.not. allocated(kept%models)) return
      if (kept%train /= train .or. len(kept%train) /= len(train)) return
      allocate (models, source=kept%models)
      do lobe = 1, size(models)
         if (allocated(models(lobe)%film_table)) deallocate (models(lobe)%film_table)
         call revise_model(models(lobe), case, error)
         if (allocated(error)) return
      end do
   end subroutine recall_models

end module camroller_kept_models
