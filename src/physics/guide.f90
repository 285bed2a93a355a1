module camroller_guide
   use camroller_kinds, only : wp
   implicit none
   private

   public :: valve_guide_t

   !> Valve stem in its guide
   type :: valve_guide_t
      !> Length of the guide [m]
      real(wp) :: length = 0.0_wp
      !> Diameter of the valve stem [m]
      real(wp) :: stem_diameter = 0.0_wp
      !> Radial clearance [m]
      real(wp) :: radial_clearance = 0.0_wp
   end type valve_guide_t

end module camroller_guide
