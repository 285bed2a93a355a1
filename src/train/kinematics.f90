!> Geometry of an end-pivoted roller finger follower at one cam angle.
!>
!> In: fixed dimensions and the valve lift with its derivatives. Out: contact geometry, arms of the contact
!> forces and surface speeds per unit of cam speed; nothing here depends on speed, load or oil.
!> Sources: Dyson (1980) and Islam (2019) eqs. (1)-(11), derived again; `doc/theory.md` lists the differences.
!>
!> Symbols: O cam centre, C pivot, R roller centre; A = CR, B = distance from C to the valve pad's centre of curvature,
!> D = CO; gamma angle between CO and the pad arm, s = gamma + lambda angle OCR; a dash is d/d(cam angle).
!> Tangential speeds and the roller's spin count positive in the sense of normal rolling, for either sense of rotation.
module camroller_kinematics
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_names, only : name_length, find_name
   use camroller_number_text, only : number_text, in_mm => millimetres_text
   implicit none
   private

   public :: mechanism_t, linkage_t, position_t, rotation_names
   public :: new_linkage, evaluate_position, arm_angle_at

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
      !> Angle from the valve's axis to the lash adjuster's axis, chi_h - chi [rad]
      real(wp) :: adjuster_tilt = 0.0_wp
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

   !> Mechanism made ready for evaluation: only what the formulas need
   type :: linkage_t
      !> A, B, D as in the module header [m]
      real(wp) :: a, b, d
      !> Roller radius [m]
      real(wp) :: roller_radius
      !> lambda - chi: added to gamma + chi it gives s [rad]
      real(wp) :: arm_offset
      !> Its cosine and sine [-]
      real(wp) :: offset_cosine, offset_sine
      !> chi [rad]
      real(wp) :: valve_axis_angle
      !> Its cosine and sine [-]
      real(wp) :: axis_cosine, axis_sine
      !> gamma on the base circle [rad]
      real(wp) :: base_angle
      !> cos(gamma_B + chi) [-]
      real(wp) :: base_cosine
      !> +1 where the cam surface moves away from the pivot, -1 where it moves towards it [-]
      real(wp) :: sense
   end type linkage_t

   !> Geometry at one cam angle
   type :: position_t
      !> Valve lift [m]
      real(wp) :: lift
      !> Derivative of the lift with respect to the cam angle [m/rad]
      real(wp) :: lift_slope
      !> Second derivative of the lift [m/rad^2]
      real(wp) :: lift_curvature
      !> Angle s = gamma + lambda between roller arm and line of centres [rad]
      real(wp) :: arm_angle
      !> gamma', turn of the finger per turn of the cam [-]
      real(wp) :: finger_slope
      !> gamma'' [1/rad]
      real(wp) :: finger_curvature
      !> Arm of the valve's force about the pivot, B sin(gamma + chi) [m]
      real(wp) :: valve_arm
      !> Arm of the contact normal about the pivot, A D sin(s)/M [m]
      real(wp) :: normal_arm
      !> Arm of the contact normal taken parallel to the valve's axis, A sin(pi - s - chi) [m]
      real(wp) :: parallel_arm
      !> Arm of the tangent through the roller centre about the pivot, A (D cos s - A g)/M [m]
      real(wp) :: tangent_arm
      !> Arm of the contact tangent about the cam centre [m]
      real(wp) :: cam_arm
      !> Curvature of the path of the roller centre over the cam, L2/M^3 [1/m]
      real(wp) :: pitch_curvature
      !> Equivalent radius of the contact, 1/R = 1/R_c + 1/r_R [m]
      real(wp) :: equivalent_radius
      !> Speed of the contact point over the cam surface per cam speed, V_c/omega [m/rad]
      real(wp) :: surface_travel
      !> Derivative of `surface_travel` with respect to the cam angle [m/rad^2]
      real(wp) :: surface_travel_slope
      !> Peripheral speed of the roller in pure rolling per cam speed, V_roll/omega [m/rad]
      real(wp) :: rolling_travel
      !> Derivative of `rolling_travel` with respect to the cam angle [m/rad^2]
      real(wp) :: rolling_travel_slope
      !> Derivative of that [m/rad^3]
      real(wp) :: rolling_travel_curvature
      !> Third derivative of the lift [m/rad^3]
      real(wp) :: lift_jerk
      !> gamma''' [1/rad^2]
      real(wp) :: finger_jerk
      !> Derivatives of the arms of valve, normal, parallel normal and tangent with respect to the cam angle [m/rad]
      real(wp) :: valve_arm_slope, normal_arm_slope, parallel_arm_slope, tangent_arm_slope
      !> Derivative of `equivalent_radius` with respect to the cam angle [m/rad]
      real(wp) :: radius_slope
      !> Cam angle from full lift; not set by `evaluate_position` [rad]
      real(wp) :: angle = 0.0_wp
   end type position_t

contains

   !> Derive the constants of the formulas; refuse dimensions that close no triangle.
   !>
   !> `cos(gamma_B + lambda) = (A^2 + D^2 - (r_B + r_R)^2)/(2 A D)`; source: Islam (2019) eq. (8).
   subroutine new_linkage(linkage, mechanism, error)
      !> Constants of the formulas
      type(linkage_t), intent(out) :: linkage
      !> Dimensions
      type(mechanism_t), intent(in) :: mechanism
      !> Domain error where the mechanism cannot be put together; deck error for an unknown sense of rotation
      type(error_t), allocatable, intent(out) :: error

      ! Cosine of the angle OCR on the base circle [-]
      real(wp) :: arm_cosine
      ! gamma_B + chi [rad]
      real(wp) :: pad_angle
      integer :: choice

      call find_name("sense of rotation", mechanism%rotation, rotation_names, choice, error)
      if (allocated(error)) return
      linkage%sense = merge(1.0_wp, -1.0_wp, choice == 1)
      linkage%a = mechanism%pivot_to_roller
      linkage%b = mechanism%pivot_to_pad
      linkage%d = mechanism%pivot_to_cam
      linkage%roller_radius = mechanism%roller_radius
      linkage%valve_axis_angle = mechanism%valve_axis_angle
      linkage%arm_offset = mechanism%roller_arm_angle - mechanism%valve_axis_angle
      linkage%offset_cosine = cos(linkage%arm_offset)
      linkage%offset_sine = sin(linkage%arm_offset)
      linkage%axis_cosine = cos(linkage%valve_axis_angle)
      linkage%axis_sine = sin(linkage%valve_axis_angle)
      linkage%base_angle = 0.0_wp
      linkage%base_cosine = 0.0_wp
      if (min(linkage%a, linkage%b, linkage%d, mechanism%roller_radius, mechanism%base_radius) <= 0.0_wp) then
         call raise(error, kind_domain, "mechanism: every length must be positive")
         return
      end if

      arm_cosine = (linkage%a**2 + linkage%d**2 - (mechanism%base_radius + mechanism%roller_radius)**2) &
         & /(2.0_wp*linkage%a*linkage%d)
      if (abs(arm_cosine) >= 1.0_wp) then
         call raise(error, kind_domain, "no closed triangle on the base circle: mechanism.pivot_to_roller_mm = "// &
            & in_mm(linkage%a)//", mechanism.pivot_to_cam_mm = "//in_mm(linkage%d)//" and mechanism.base_radius_mm + "// &
            & "roller.radius_mm = "//in_mm(mechanism%base_radius)//" + "//in_mm(mechanism%roller_radius)// &
            & "; each must be less than the sum of both others")
         return
      end if
      linkage%base_angle = acos(arm_cosine) - mechanism%roller_arm_angle
      pad_angle = linkage%base_angle + mechanism%valve_axis_angle
      if (sin(pad_angle) <= 0.0_wp) then
         call raise(error, kind_domain, "on the base circle the valve pad stands on the wrong side of the valve's axis: the "// &
            & "triangle's angle at the pivot, "//number_text(acos(arm_cosine)/degree, 6)// &
            & " deg, less mechanism.roller_arm_angle_deg = "//number_text(mechanism%roller_arm_angle/degree, 6)// &
            & ", plus mechanism.valve_axis_angle_deg = "//number_text(mechanism%valve_axis_angle/degree, 6)// &
            & " must be between 0 and 180 deg")
         return
      end if
      linkage%base_cosine = cos(pad_angle)
   end subroutine new_linkage

   !> Geometry for one value of the lift and its derivatives.
   !>
   !> Sources: Islam (2019) eqs. (1)-(6), (10), (11) with the last term of (2) as `A D g (1 + g) cos s` and `r_R^2` in (10);
   !> exact arm of the contact normal and speed of pure rolling with the turning of the contact normal, which comes out as
   !> `V_roll = omega (M - r_R)`: `doc/theory.md`.
   !> Note: written in curvatures, so that straight and hollow flanks are regular.
   !> The caller has checked that the lift keeps `|cos(gamma + chi)| < 1`; status is not 0 where it does not.
   pure subroutine evaluate_position(linkage, lift, position, status, path_only, moments_only)
      !> Constants of the mechanism
      type(linkage_t), intent(in) :: linkage
      !> Lift and its first three derivatives with respect to the cam angle [m, m/rad, m/rad^2, m/rad^3]
      real(wp), intent(in) :: lift(0:3)
      !> Geometry at this angle; the lift alone where the finger cannot reach it
      type(position_t), intent(out) :: position
      !> 0 fine, -1 the finger cannot reach this lift
      integer, intent(out) :: status
      !> Are path of the roller's centre over the cam, its curvature, its arms and the slope of the finger all that is wanted?
      logical, intent(in), optional :: path_only
      !> Is only wanted what moments about the pivot take: lift and turn of the finger with two derivatives, arms about the pivot?
      logical, intent(in), optional :: moments_only

      ! cos and sin of gamma + chi; cos and sin of s [-]
      real(wp) :: cos_pad, sin_pad, cos_s, sin_s
      ! gamma', gamma'' and g = 1 + sense gamma' [-]
      real(wp) :: gamma_1, gamma_2, g
      ! M [m]; L2 [m^2]
      real(wp) :: m, l2
      ! A D cos s and A D sin s [m^2]
      real(wp) :: ad_cos, ad_sin

      status = -1
      position%lift = lift(0)
      cos_pad = linkage%base_cosine - lift(0)/linkage%b
      if (abs(cos_pad) >= 1.0_wp) return
      status = 0
      sin_pad = sqrt((1.0_wp - cos_pad)*(1.0_wp + cos_pad))
      position%valve_arm = linkage%b*sin_pad
      cos_s = cos_pad*linkage%offset_cosine - sin_pad*linkage%offset_sine
      sin_s = sin_pad*linkage%offset_cosine + cos_pad*linkage%offset_sine

      ! l' = b sin(gamma+chi) gamma' and its derivatives
      gamma_1 = lift(1)/position%valve_arm
      gamma_2 = (lift(2)/linkage%b - cos_pad*gamma_1**2)/sin_pad
      g = 1.0_wp + linkage%sense*gamma_1
      ad_cos = linkage%a*linkage%d*cos_s
      ad_sin = linkage%a*linkage%d*sin_s
      m = sqrt((linkage%a*g)**2 - 2.0_wp*ad_cos*g + linkage%d**2)
      position%lift_slope = lift(1)
      position%lift_curvature = lift(2)
      position%finger_slope = gamma_1
      position%finger_curvature = gamma_2
      position%normal_arm = ad_sin/m
      position%tangent_arm = (ad_cos - linkage%a**2*g)/m
      position%parallel_arm = linkage%a*(sin_s*linkage%axis_cosine + cos_s*linkage%axis_sine)
      if (present(moments_only)) then
         if (moments_only) return
      end if
      l2 = linkage%a**2*g**3 - ad_sin*gamma_2 + linkage%d**2 - ad_cos*g*(1.0_wp + g)
      position%pitch_curvature = l2/m**3
      ! omega h_F - sense gamma' omega h_t, with the arms written out, is omega (M - r_R)
      position%rolling_travel = m - linkage%roller_radius
      if (present(path_only)) then
         if (path_only) return
      end if

      position%arm_angle = arm_angle_at(linkage, lift(0))
      position%equivalent_radius = linkage%roller_radius*(1.0_wp - linkage%roller_radius*position%pitch_curvature)
      position%surface_travel = m - linkage%roller_radius*l2/m**2
      position%cam_arm = (linkage%d**2 + linkage%a**2*g - ad_cos*(1.0_wp + g))/m - linkage%roller_radius
      call add_slopes(position)

   contains

      !> Slopes, and the third derivatives.
      pure subroutine add_slopes(position)
         !> Geometry without them; out: with them
         type(position_t), intent(inout) :: position

         ! gamma''' [-], derivatives over the cam angle of g [1/rad], of M [m], of L2 [m^2]
         real(wp) :: gamma_3, g_1, m_1, l2_1

         gamma_3 = (lift(3)/linkage%b - 3.0_wp*cos_pad*gamma_1*gamma_2 + sin_pad*gamma_1**3)/sin_pad
         g_1 = linkage%sense*gamma_2
         m_1 = (linkage%a**2*g*g_1 - ad_cos*g_1 + ad_sin*g*gamma_1)/m
         l2_1 = 3.0_wp*(linkage%a*g)**2*g_1 - ad_sin*gamma_3 - ad_cos*gamma_1*gamma_2 &
            & - ad_cos*(1.0_wp + 2.0_wp*g)*g_1 + ad_sin*g*(1.0_wp + g)*gamma_1
         position%surface_travel_slope = m_1 - linkage%roller_radius*(l2_1 - 2.0_wp*l2*m_1/m)/m**2
         position%rolling_travel_slope = m_1
         position%lift_jerk = lift(3)
         position%finger_jerk = gamma_3
         position%valve_arm_slope = linkage%b*cos_pad*gamma_1
         position%normal_arm_slope = (ad_cos*gamma_1 - position%normal_arm*m_1)/m
         position%parallel_arm_slope = linkage%a*gamma_1*(cos_s*linkage%axis_cosine - sin_s*linkage%axis_sine)
         position%tangent_arm_slope = -(ad_sin*gamma_1 + linkage%a**2*g_1 + position%tangent_arm*m_1)/m
         position%radius_slope = -linkage%roller_radius**2*(l2_1 - 3.0_wp*l2*m_1/m)/m**3
         position%rolling_travel_curvature = (linkage%a**2*(g_1**2 + linkage%sense*g*gamma_3) - linkage%sense*ad_cos*gamma_3 &
            & + 2.0_wp*ad_sin*gamma_1*g_1 + g*(ad_cos*gamma_1**2 + ad_sin*gamma_2) - m_1**2)/m
      end subroutine add_slopes

   end subroutine evaluate_position

   !> Angle s between roller arm and line of centres, for a lift that the finger can reach.
   elemental function arm_angle_at(linkage, lift) result(angle)
      !> Constants of the mechanism
      type(linkage_t), intent(in) :: linkage
      !> The lift [m]
      real(wp), intent(in) :: lift
      !> The angle [rad]
      real(wp) :: angle

      angle = acos(linkage%base_cosine - lift/linkage%b) + linkage%arm_offset
   end function arm_angle_at

end module camroller_kinematics
