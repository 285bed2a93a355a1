!> Models kept from one case of a sweep for the next that has the same geometry, masses and spring, so that curves are fitted and
!> the geometry is checked only once.
!>
!> In: cases one after the other. Out: their models, identical to the last bit to those that each case alone would get.
module camroller_kept_models
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_lift, only : lift_t
   use camroller_model, only : model_t, revise_model
   implicit none
   private

   public :: kept_models_t, keep_models, recall_models

   !> Models of the last case whose geometry was another one's
   type :: kept_models_t
      private
      type(case_t), allocatable :: case
      type(model_t), allocatable :: models(:)
   end type kept_models_t

contains

   !> Keep the models of a case.
   subroutine keep_models(kept, case, models)
      !> What is kept
      type(kept_models_t), intent(inout) :: kept
      !> The case
      type(case_t), intent(in) :: case
      !> Its models
      type(model_t), intent(in) :: models(:)

      if (allocated(kept%case)) deallocate (kept%case)
      if (allocated(kept%models)) deallocate (kept%models)
      allocate (kept%case, source=case)
      allocate (kept%models, source=models)
   end subroutine keep_models

   !> Models of a case from those that are kept, where they serve.
   subroutine recall_models(kept, case, models, error)
      !> What is kept
      type(kept_models_t), intent(in) :: kept
      !> The case
      type(case_t), intent(in) :: case
      !> Its models; not allocated where none that serve are kept
      type(model_t), allocatable, intent(out) :: models(:)
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      if (.not. allocated(kept%case)) return
      if (.not. has_same_train(case, kept%case)) return
      allocate (models, source=kept%models)
      do lobe = 1, size(models)
         if (allocated(models(lobe)%film_table)) deallocate (models(lobe)%film_table)
         call revise_model(models(lobe), case, error)
         if (allocated(error)) return
      end do
   end subroutine recall_models

   !> Have two cases the same geometry, masses and spring?
   pure function has_same_train(one, other) result(same)
      !> Both
      type(case_t), intent(in) :: one, other
      !> Have they?
      logical :: same

      ! What an adjuster makes of the base circle load is not compared
      same = one%energy == other%energy .and. .not. (allocated(one%lash_adjuster) .or. allocated(other%lash_adjuster))
      same = same .and. (allocated(one%second_lift) .eqv. allocated(other%second_lift))
      if (same .and. allocated(one%second_lift)) same = is_same_lift(one%second_lift, other%second_lift)
      associate (a => one%mechanism, b => other%mechanism)
         same = same .and. a%rotation == b%rotation .and. all(same_bits([a%pivot_to_roller, a%pivot_to_pad, a%pivot_to_cam, &
            & a%roller_arm_angle, a%valve_axis_angle, a%adjuster_tilt, a%base_radius, a%roller_radius, a%contact_width, &
            & a%grinding_wheel_radius], &
            & [b%pivot_to_roller, b%pivot_to_pad, b%pivot_to_cam, b%roller_arm_angle, b%valve_axis_angle, b%adjuster_tilt, &
            & b%base_radius, b%roller_radius, b%contact_width, b%grinding_wheel_radius]))
      end associate
      associate (a => one%spring, b => other%spring)
         same = same .and. a%seating == b%seating .and. a%load_arm == b%load_arm .and. all(same_bits([a%stiffness, &
            & a%precompression, a%base_circle_load, a%seat_stiffness], [b%stiffness, b%precompression, b%base_circle_load, &
            & b%seat_stiffness]))
      end associate
      same = same .and. one%roller%spin == other%roller%spin .and. all(same_bits([one%masses%valve, one%masses%finger, &
         & one%masses%finger_inertia, one%masses%finger_centre, one%roller%mass, one%roller%wall_thickness], &
         & [other%masses%valve, other%masses%finger, other%masses%finger_inertia, other%masses%finger_centre, &
         & other%roller%mass, other%roller%wall_thickness]))
      if (same) same = is_same_lift(one%lift, other%lift)
   end function has_same_train

   !> Are two lifts the same?
   pure function is_same_lift(one, other) result(same)
      !> Both
      type(lift_t), intent(in) :: one, other
      !> Are they?
      logical :: same

      same = one%law == other%law .and. all(same_bits([one%max_lift, one%opening_half_angle, one%closing_half_angle, &
         & one%smoothing], [other%max_lift, other%opening_half_angle, other%closing_half_angle, other%smoothing])) .and. &
         & (allocated(one%exponents) .eqv. allocated(other%exponents)) .and. &
         & (allocated(one%table_angle) .eqv. allocated(other%table_angle)) .and. &
         & (allocated(one%table_lift) .eqv. allocated(other%table_lift))
      if (.not. same) return
      if (allocated(one%exponents)) then
         same = size(one%exponents) == size(other%exponents)
         if (same) same = all(one%exponents == other%exponents)
      end if
      if (same .and. allocated(one%table_angle)) same = is_same_list(one%table_angle, other%table_angle)
      if (same .and. allocated(one%table_lift)) same = is_same_list(one%table_lift, other%table_lift)
   end function is_same_lift

   !> Are two lists of numbers the same?
   pure function is_same_list(one, other) result(same)
      !> Both [any]
      real(wp), intent(in) :: one(:), other(:)
      !> Are they?
      logical :: same

      same = size(one) == size(other)
      if (same) same = all(same_bits(one, other))
   end function is_same_list

   !> Are two numbers the same, bit by bit?
   elemental function same_bits(one, other) result(same)
      !> Both [any]
      real(wp), intent(in) :: one, other
      !> Are they?
      logical :: same

      same = transfer(one, 0_int64) == transfer(other, 0_int64)
   end function same_bits

end module camroller_kept_models
