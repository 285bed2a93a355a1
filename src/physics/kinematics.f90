module camroller_kinematics
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: mechanism_t, rotation_names

   !> Senses of rotation that can be chosen by name: how the cam surface moves at the contact
   character(len=*), parameter :: rotation_names(*) = [character(len=name_length) :: &
      "away_from_pivot", "towards_pivot"]

   !> Fixed dimensions of the mechanism
   type :: mechanism_t
      !> Distance from the pivot to the roller centre, A [m]
      real(wp) :: pivot_to_roller = 0.0_wp
      !> Distance from the pivot to the centre of curvature of the valve pad, B [m]
      real(wp) :: pivot_to_pad = 0.0_wp
      !> Distance from the pivot to the cam centre, D [m]
      real(wp) :: pivot_to_cam = 0.0_wp
      !> Angle from the pad arm to the roller arm, lambda [rad]
      real(wp) :: roller_arm_angle = 0.0_wp
      !> Angle between the valve's axis and the line from pivot to cam centre, chi [rad]
      real(wp) :: valve_axis_angle = 0.0_wp
      !> Radius of the cam's base circle [m]
      real(wp) :: base_radius = 0.0_wp
      !> Outer radius of the roller [m]
      real(wp) :: roller_radius = 0.0_wp
      !> Full length of the line contact [m]
      real(wp) :: contact_width = 0.0_wp
      !> Radius of the grinding wheel that must fit hollow flanks [m]; zero where not given
      real(wp) :: grinding_wheel_radius = 0.0_wp
      !> One of `rotation_names`
      character(len=name_length) :: rotation = "away_from_pivot"
   end type mechanism_t

end module camroller_kinematics
