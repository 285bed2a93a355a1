!> Speed, oil and supply pressure of a model over a step of a host program.
!>
!> In: model, cam angles. Out: the speed at an angle; the model set to what it is there; the model at another speed and oil
!> temperature with the films that were solved beforehand.
module camroller_ramp
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ehl_table, only : ehl_t
   use camroller_lash_adjuster, only : set_supply
   use camroller_model, only : model_t, set_operating_point, set_speed
   implicit none
   private

   public :: speed_on_ramp, follow_ramp, keep_films

contains

   !> Speed of the cam at an angle of the step.
   elemental function speed_on_ramp(model, angle) result(speed)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Cam speed [rad/s]
      real(wp) :: speed

      speed = model%speed
      if (model%ramp%is_moving) speed = model%ramp%speed + model%speed_slope*(angle - model%ramp%angle)
   end function speed_on_ramp

   !> Set a model to the inputs at an angle of the step.
   subroutine follow_ramp(model, angle, oil_angle)
      !> The model; left alone where nothing changes
      type(model_t), intent(inout) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Angle whose oil temperature and supply pressure are taken; absent: the same [rad]
      real(wp), intent(in), optional :: oil_angle

      ! Way from the middle of the step [rad]
      real(wp) :: way
      ! What cannot go wrong between two temperatures at which it did not
      type(error_t), allocatable :: error

      if (.not. model%ramp%is_moving) return
      way = angle - model%ramp%angle
      if (present(oil_angle)) way = oil_angle - model%ramp%angle
      if (abs(model%ramp%temperature_slope) > 0.0_wp) then
         call keep_films(model, speed_on_ramp(model, angle), model%ramp%temperature + model%ramp%temperature_slope &
            & *way, error)
      else
         call set_speed(model, speed_on_ramp(model, angle))
      end if
      if (abs(model%ramp%supply_slope) > 0.0_wp) call set_supply(model%flexible%adjuster, model%ramp%supply &
         & + model%ramp%supply_slope*way)
   end subroutine follow_ramp

   !> Set speed and oil temperature without solving films again.
   subroutine keep_films(model, speed, oil_temperature, error)
      !> The model, with films solved beforehand or without
      type(model_t), intent(inout) :: model
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil [K]
      real(wp), intent(in) :: oil_temperature
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_t), allocatable :: ehl

      if (allocated(model%ehl)) call move_alloc(model%ehl, ehl)
      call set_operating_point(model, speed, oil_temperature, error)
      if (allocated(ehl)) call move_alloc(ehl, model%ehl)
   end subroutine keep_films

end module camroller_ramp
