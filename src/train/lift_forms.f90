!> Lift as people have it: the roller's instead of the valve's.
!>
!> In: how far the roller's centre is from the cam's, beyond the base circle. Out: the lift of the valve.
!> Source: the triangle of pivot, cam and roller, Islam (2019) eqs. (6), (8) and (9).
module camroller_lift_forms
   use camroller_kinds, only : wp
   use camroller_kinematics, only : mechanism_t
   implicit none
   private

   public :: table_kind_names, kind_roller, valve_lift_of, closes_triangle

   !> What a lift table holds: lift of the valve, or of the roller's centre away from the cam's
   character(len=*), parameter :: table_kind_names(*) = [character(len=12) :: "valve_lift", "roller_lift"]
   !> Position in `table_kind_names`
   integer, parameter :: kind_roller = 2

contains

   !> Cosine of the angle between the lines from the pivot to the roller and to the cam.
   elemental function arm_cosine(mechanism, roller_lift) result(cosine)
      !> Dimensions
      type(mechanism_t), intent(in) :: mechanism
      !> Distance of the roller's centre from the cam's, less that on the base circle [m]
      real(wp), intent(in) :: roller_lift
      !> The cosine; beyond one where no triangle closes [-]
      real(wp) :: cosine

      associate (a => mechanism%pivot_to_roller, d => mechanism%pivot_to_cam, m => mechanism)
         cosine = (a**2 + d**2 - (m%base_radius + m%roller_radius + roller_lift)**2)/(2.0_wp*a*d)
      end associate
   end function arm_cosine

   !> Can the roller be there?
   elemental function closes_triangle(mechanism, roller_lift) result(verdict)
      !> Dimensions
      type(mechanism_t), intent(in) :: mechanism
      !> Lift of the roller [m]
      real(wp), intent(in) :: roller_lift
      !> Can it?
      logical :: verdict

      verdict = .false.
      if (min(mechanism%pivot_to_roller, mechanism%pivot_to_cam) <= 0.0_wp) return
      verdict = abs(arm_cosine(mechanism, roller_lift)) <= 1.0_wp .and. abs(arm_cosine(mechanism, 0.0_wp)) <= 1.0_wp
   end function closes_triangle

   !> Lift of the valve where the roller has a lift.
   elemental function valve_lift_of(mechanism, roller_lift) result(lift)
      !> Dimensions, with which the triangle closes
      type(mechanism_t), intent(in) :: mechanism
      !> Lift of the roller [m]
      real(wp), intent(in) :: roller_lift
      !> Lift of the valve; zero for none [m]
      real(wp) :: lift

      ! Angles of the pad's arm from the valve's axis, on the base circle and now [rad]
      real(wp) :: closed, open

      associate (m => mechanism)
         closed = acos(arm_cosine(m, 0.0_wp)) - m%roller_arm_angle + m%valve_axis_angle
         open = acos(arm_cosine(m, roller_lift)) - m%roller_arm_angle + m%valve_axis_angle
         lift = m%pivot_to_pad*(cos(closed) - cos(open))
      end associate
   end function valve_lift_of

end module camroller_lift_forms
