!> Dimensions of the mechanism from a deck.
!>
!> In: settings. Out: the dimensions in SI.
module camroller_deck_mechanism
   use camroller_kinematics, only : mechanism_t
   use camroller_settings, only : settings_t, take
   implicit none
   private

   public :: take_mechanism

contains

   !> Dimensions of the mechanism.
   subroutine take_mechanism(settings, mechanism)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The dimensions
      type(mechanism_t), intent(out) :: mechanism

      call take(settings, "mechanism", "pivot_to_roller_mm", mechanism%pivot_to_roller)
      call take(settings, "mechanism", "pivot_to_pad_mm", mechanism%pivot_to_pad)
      call take(settings, "mechanism", "pivot_to_cam_mm", mechanism%pivot_to_cam)
      call take(settings, "mechanism", "roller_arm_angle_deg", mechanism%roller_arm_angle)
      call take(settings, "mechanism", "valve_axis_angle_deg", mechanism%valve_axis_angle)
      call take(settings, "mechanism", "adjuster_tilt_deg", mechanism%adjuster_tilt)
      call take(settings, "mechanism", "base_radius_mm", mechanism%base_radius)
      call take(settings, "mechanism", "contact_width_mm", mechanism%contact_width)
      call take(settings, "mechanism", "grinding_wheel_radius_mm", mechanism%grinding_wheel_radius)
      call take(settings, "mechanism", "rotation", mechanism%rotation)
      call take(settings, "roller", "radius_mm", mechanism%roller_radius)
   end subroutine take_mechanism

end module camroller_deck_mechanism
