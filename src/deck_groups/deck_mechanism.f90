!> Decks: dimensions of the mechanism, and the roller, whose radius is one of them.
!>
!> In: keys, settings. Out: the groups, the dimensions in SI, the roller.
module camroller_deck_mechanism
   use camroller_deck_binder, only : keys_t, taken_from
   use camroller_deck_schema, only : from_to, group_required, positive
   use camroller_kinds, only : wp
   use camroller_kinematics, only : mechanism_t, rotation_names
   use camroller_roller, only : roller_t, spin_names
   use camroller_settings, only : settings_t
   implicit none
   private

   public :: bind_mechanism, bind_roller, take_mechanism

contains

   !> Dimensions of the mechanism but for the roller's radius.
   subroutine bind_mechanism(keys, mechanism)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The dimensions
      type(mechanism_t), intent(inout) :: mechanism

      call keys%group("mechanism", group_required, "dimensions of the end-pivoted finger follower and its cam")
      call keys%number("pivot_to_roller_mm", positive, "distance from the pivot to the roller's centre", &
         & mechanism%pivot_to_roller, example="20.8", usual=[8.0_wp, 60.0_wp])
      call keys%number("pivot_to_pad_mm", positive, "distance from the pivot to the centre of curvature of the valve pad", &
         & mechanism%pivot_to_pad, example="35.5", usual=[15.0_wp, 120.0_wp])
      call keys%number("pivot_to_cam_mm", positive, "distance from the pivot to the cam's centre", mechanism%pivot_to_cam, &
         & example="31.5", usual=[15.0_wp, 100.0_wp])
      call keys%number("roller_arm_angle_deg", from_to(-180.0_wp, 180.0_wp), "angle from the pad arm to the roller arm", &
         & mechanism%roller_arm_angle, example="-3.5")
      ! The cam stands over the finger, between its pivot and the valve
      call keys%number("valve_axis_angle_deg", from_to(-180.0_wp, 180.0_wp), &
         & "angle between the valve's axis and the line from pivot to cam centre", mechanism%valve_axis_angle, example="37.5", &
         & usual=[5.0_wp, 70.0_wp])
      call keys%number("adjuster_tilt_deg", from_to(-90.0_wp, 90.0_wp), "angle from the valve's axis to the lash adjuster's, "// &
         & "in the sense of valve_axis_angle_deg; for the force in the pivot's joint", mechanism%adjuster_tilt)
      call keys%number("base_radius_mm", positive, "radius of the cam's base circle", mechanism%base_radius, example="18", &
         & usual=[6.0_wp, 60.0_wp])
      call keys%number("contact_width_mm", positive, "full length of the line contact", mechanism%contact_width, example="13.7", &
         & usual=[2.0_wp, 60.0_wp])
      call keys%number("grinding_wheel_radius_mm", positive, &
         & "radius of the wheel that must fit hollow flanks; not checked where not given", mechanism%grinding_wheel_radius, &
         & is_optional=.true., usual=[10.0_wp, 500.0_wp])
      call keys%choice("rotation", rotation_names, "sense in which the cam's surface moves at the contact", mechanism%rotation)
   end subroutine bind_mechanism

   !> The roller, and its radius in the mechanism.
   subroutine bind_roller(keys, mechanism, roller)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The dimensions
      type(mechanism_t), intent(inout) :: mechanism
      !> The roller
      type(roller_t), intent(inout) :: roller

      call keys%group("roller", group_required, "roller, a spinning ring")
      call keys%number("radius_mm", positive, "outer radius", mechanism%roller_radius, example="8.5", usual=[3.0_wp, 30.0_wp])
      call keys%number("mass_kg", positive, "mass of the ring", roller%mass, example="0.0088", usual=[1.0e-3_wp, 0.3_wp])
      call keys%number("wall_thickness_mm", positive, "thickness of the ring's wall", roller%wall_thickness, example="2.4", &
         & usual=[0.8_wp, 15.0_wp])
      call keys%choice("spin", spin_names, "definition of pure rolling: with the rotation of the contact normal, or as in "// &
         & "Islam (2019)", roller%spin)
   end subroutine bind_roller

   !> All dimensions of the mechanism.
   subroutine take_mechanism(settings, mechanism)
      !> The settings
      type(settings_t), intent(in), target :: settings
      !> The dimensions
      type(mechanism_t), intent(out) :: mechanism

      type(keys_t) :: keys
      type(roller_t) :: roller

      keys = taken_from(settings)
      call bind_mechanism(keys, mechanism)
      call bind_roller(keys, mechanism, roller)
   end subroutine take_mechanism

end module camroller_deck_mechanism
