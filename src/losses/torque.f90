!> Torque on the camshaft and power lost, by source.
!>
!> In: forces, speeds and arms of one cam. Out: torques. Sources: equilibrium of roller, finger and cam (`doc/theory.md`); Islam
!> (2019), section 2.5, for the bookkeeping called `source`.
module camroller_torque
   use camroller_kinds, only : wp
   implicit none
   private

   public :: cam_torque, contact_power, normal_direction

contains

   !> Torque that the cam needs against the contact forces, `W h_W gamma' + T' h_F + 2 F_r R`.
   !>
   !> From the equilibrium of the cam alone: independent of how the losses are added up, so that their difference shows whether the
   !> energy balance is closed.
   elemental function cam_torque(load, normal_arm, finger_slope, tangential_force, cam_arm, rolling_resistance, radius) &
      & result(torque)
      !> Normal load, W [N]
      real(wp), intent(in) :: load
      !> Arm of the contact normal about the pivot, h_W [m]
      real(wp), intent(in) :: normal_arm
      !> gamma', which turns an arm about the pivot into one about the cam centre [-]
      real(wp), intent(in) :: finger_slope
      !> Net tangential force, T' [N]
      real(wp), intent(in) :: tangential_force
      !> Arm of the contact tangent about the cam centre, h_F [m]
      real(wp), intent(in) :: cam_arm
      !> Rolling resistance, F_r [N]
      real(wp), intent(in) :: rolling_resistance
      !> Equivalent radius, R [m]
      real(wp), intent(in) :: radius
      !> Torque [N m]
      real(wp) :: torque

      torque = load*normal_arm*finger_slope + tangential_force*cam_arm + 2.0_wp*rolling_resistance*radius
   end function cam_torque

   !> Power lost in the contact, `F_t V_s + F_r (V_c + V_f)`.
   elemental function contact_power(traction, sliding_speed, rolling_resistance, cam_surface_speed, roller_surface_speed) &
      & result(power)
      !> Traction, F_t [N]
      real(wp), intent(in) :: traction
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Rolling resistance of each surface, F_r [N]
      real(wp), intent(in) :: rolling_resistance
      !> Speed of the contact over the cam, V_c [m/s]
      real(wp), intent(in) :: cam_surface_speed
      !> Speed of the contact over the roller, V_f [m/s]
      real(wp), intent(in) :: roller_surface_speed
      !> Power [W]
      real(wp) :: power

      power = traction*sliding_speed + rolling_resistance*(cam_surface_speed + roller_surface_speed)
   end function contact_power

   !> Contact normal and tangent in the fixed frame whose x axis runs from the pivot to the cam centre.
   !>
   !> The normal is the direction of the load on the roller, the tangent that of the traction on the roller. Both follow from
   !> their arms about the pivot: `n = (-h_t, h_W)/A` and `t = sense (h_W, h_t)/A` along and across the roller arm.
   pure subroutine normal_direction(normal_arm, tangent_arm, pivot_to_roller, arm_angle, sense, normal, tangent)
      !> Arm of the contact normal about the pivot, h_W [m]
      real(wp), intent(in) :: normal_arm
      !> Arm of the tangent through the roller centre about the pivot, h_t [m]
      real(wp), intent(in) :: tangent_arm
      !> Length of the roller arm, A [m]
      real(wp), intent(in) :: pivot_to_roller
      !> Angle of the roller arm from the x axis, s [rad]
      real(wp), intent(in) :: arm_angle
      !> Sense of rotation, +1 or -1 [-]
      real(wp), intent(in) :: sense
      !> Unit vector of the load on the roller [-]
      real(wp), intent(out) :: normal(2)
      !> Unit vector of the traction on the roller [-]
      real(wp), intent(out) :: tangent(2)

      ! Unit vectors along and across the roller arm [-]
      real(wp) :: along(2), across(2)

      along = [cos(arm_angle), sin(arm_angle)]
      across = [-sin(arm_angle), cos(arm_angle)]
      normal = (normal_arm*across - tangent_arm*along)/pivot_to_roller
      tangent = sense*(tangent_arm*across + normal_arm*along)/pivot_to_roller
   end subroutine normal_direction

end module camroller_torque
