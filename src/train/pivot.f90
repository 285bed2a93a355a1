!> Force of the finger's pivot on the lash adjuster.
!>
!> In: forces on the rigid finger and its motion. Out: the force along the adjuster's axis. Source: momentum balance of the
!> finger along that axis, `doc/theory.md`.
module camroller_pivot
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_number_text, only : fixed_text
   implicit none
   private

   public :: pivot_t, new_pivot, pivot_force, assumed_inertia, assumed_centre

   !> Distance of a finger's centre of mass from its pivot where none is given [m]
   real(wp), parameter :: usual_centre = 20.0e-3_wp

   !> Joint between finger and lash adjuster
   type :: pivot_t
      !> Mass of the finger with its roller, m_F [kg]
      real(wp) :: mass
      !> Distance from the pivot to its centre of mass, which lies on the roller arm, r_G [m]
      real(wp) :: centre
      !> Angle between the adjuster's axis and the line from pivot to cam centre, chi_h [rad]
      real(wp) :: axis_angle
      !> Its cosine and sine [-]
      real(wp) :: axis_cosine, axis_sine
      !> Angle from the valve's axis to the adjuster's axis, chi_h - chi [rad], and its cosine [-]
      real(wp) :: tilt, tilt_cosine
   end type pivot_t

contains

   !> Inertia of a finger about its pivot where none is given: that of all of its mass at the pad.
   elemental function assumed_inertia(mass, pivot_to_pad) result(inertia)
      !> Mass of the finger with its roller [kg]
      real(wp), intent(in) :: mass
      !> Distance from the pivot to the pad [m]
      real(wp), intent(in) :: pivot_to_pad
      !> The inertia [kg m^2]
      real(wp) :: inertia

      inertia = mass*pivot_to_pad**2
   end function assumed_inertia

   !> Distance of a finger's centre of mass from its pivot where none is given: a usual one, or the radius of gyration about the
   !> pivot where that is less; zero without a mass.
   elemental function assumed_centre(mass, inertia) result(centre)
      !> Mass of the finger with its roller [kg]
      real(wp), intent(in) :: mass
      !> Its inertia about the pivot [kg m^2]
      real(wp), intent(in) :: inertia
      !> The distance [m]
      real(wp) :: centre

      centre = 0.0_wp
      if (mass > 0.0_wp) centre = min(usual_centre, sqrt(inertia/mass))
   end function assumed_centre

   !> The joint of a finger.
   subroutine new_pivot(pivot, mass, inertia, centre, valve_axis_angle, tilt, error)
      !> The joint
      type(pivot_t), intent(out) :: pivot
      !> Mass of the finger with its roller [kg], its inertia about the pivot [kg m^2]
      real(wp), intent(in) :: mass, inertia
      !> Distance from the pivot to its centre of mass; zero where not given [m]
      real(wp), intent(in) :: centre
      !> Angle between the valve's axis and the line from pivot to cam centre, and from it to the adjuster's axis [rad]
      real(wp), intent(in) :: valve_axis_angle, tilt
      !> Deck error where no finger of this mass and inertia has its centre of mass so far out
      type(error_t), allocatable, intent(out) :: error

      ! Part of the radius of gyration that is rounding of a number in mm [-]
      real(wp), parameter :: rounding = 1.0e-12_wp
      ! Radius of gyration about the pivot [m]
      real(wp) :: gyration

      gyration = sqrt(inertia/mass)
      pivot%mass = mass
      pivot%centre = assumed_centre(mass, inertia)
      if (centre > 0.0_wp) pivot%centre = centre
      pivot%tilt = tilt
      pivot%tilt_cosine = cos(tilt)
      pivot%axis_angle = valve_axis_angle + tilt
      pivot%axis_cosine = cos(pivot%axis_angle)
      pivot%axis_sine = sin(pivot%axis_angle)
      if (pivot%centre <= (1.0_wp + rounding)*gyration) return
      call raise(error, kind_deck, "the finger's centre of mass, masses.finger_centre_mm = "// &
         & fixed_text(1.0e3_wp*pivot%centre, 3)//", lies beyond its radius of gyration about the pivot, "// &
         & fixed_text(1.0e3_wp*gyration, 3)//" mm; lower it or masses.finger_kg, or raise masses.finger_inertia_kg_m2")
   end subroutine new_pivot

   !> Force that presses the pivot's ball and socket together, along the adjuster's axis; negative where the joint would open.
   !>
   !> `F_h = -(W u_h.n + F_p cos(chi_h - chi)) + m_F omega^2 (j gamma'' + j' gamma'^2)`, `j = -r_G sin(s + chi_h)`, with the
   !> adjuster's axis `u_h = (cos chi_h, -sin chi_h)` towards the cam.
   pure function pivot_force(pivot, load, normal, tip_force, arm_angle, finger_slope, finger_curvature, speed) result(force)
      !> The joint
      type(pivot_t), intent(in) :: pivot
      !> Contact load, W [N]
      real(wp), intent(in) :: load
      !> Its direction on the roller, x from pivot to cam centre [-]
      real(wp), intent(in) :: normal(2)
      !> Force of the valve on the finger's tip, F_p [N]
      real(wp), intent(in) :: tip_force
      !> Angle of the roller arm from the line of centres, s [rad]
      real(wp), intent(in) :: arm_angle
      !> gamma' [-]
      real(wp), intent(in) :: finger_slope
      !> gamma'' [1/rad]
      real(wp), intent(in) :: finger_curvature
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> The force [N]
      real(wp) :: force

      ! Place of the centre of mass along the adjuster's axis: first and second derivative over the finger's angle [m]
      real(wp) :: j, j_slope

      j = -pivot%centre*sin(arm_angle + pivot%axis_angle)
      j_slope = -pivot%centre*cos(arm_angle + pivot%axis_angle)
      force = -(load*(normal(1)*pivot%axis_cosine - normal(2)*pivot%axis_sine) + tip_force*pivot%tilt_cosine) &
         & + pivot%mass*speed**2*(j*finger_curvature + j_slope*finger_slope**2)
   end function pivot_force

end module camroller_pivot
