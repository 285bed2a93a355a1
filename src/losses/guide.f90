!> Valve stem in its guide: viscous shear of a concentric film.
!>
!> In: guide dimensions and viscosity. Out: drag per valve speed. Source: Dowson, Taylor and Yang (1996);
!> Islam (2019) eq. (45).
module camroller_guide
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: valve_guide_t, guide_drag_coefficient

   !> Valve stem in its guide
   type :: valve_guide_t
      !> Length of the guide [m]
      real(wp) :: length = 0.0_wp
      !> Diameter of the valve stem [m]
      real(wp) :: stem_diameter = 0.0_wp
      !> Radial clearance [m]
      real(wp) :: radial_clearance = 0.0_wp
   end type valve_guide_t

contains

   !> Drag of the stem per valve speed, `c_g = eta0 pi d_v L_v/c_v`; the drag opposes the valve's motion.
   elemental function guide_drag_coefficient(viscosity, length, stem_diameter, radial_clearance) result(coefficient)
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity
      !> Length of the guide [m]
      real(wp), intent(in) :: length
      !> Diameter of the stem [m]
      real(wp), intent(in) :: stem_diameter
      !> Radial clearance [m]
      real(wp), intent(in) :: radial_clearance
      !> Drag per speed [N s/m]
      real(wp) :: coefficient

      coefficient = viscosity*pi*stem_diameter*length/radial_clearance
   end function guide_drag_coefficient

end module camroller_guide
