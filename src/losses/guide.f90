!> Valve stem in its guide: viscous shear of a concentric film.
!>
!> In: guide dimensions, viscosity and speed of the valve. Out: drag with its slope over the speed. Source: Dowson, Taylor and
!> Yang (1996); Islam (2019) eq. (45).
!>
!> The drag is given over the speed, which stays finite where the valve rests: force `D v`, power `D v^2`. All else takes both
!> numbers as they come, so that a law in which the drag does not grow with the speed changes this file alone.
module camroller_guide
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: valve_guide_t, guide_part_t, new_guide_part, set_guide_oil, find_guide_drag, guide_drag_coefficient

   !> Valve stem in its guide
   type :: valve_guide_t
      !> Length of the guide [m]
      real(wp) :: length = 0.0_wp
      !> Diameter of the valve stem [m]
      real(wp) :: stem_diameter = 0.0_wp
      !> Radial clearance [m]
      real(wp) :: radial_clearance = 0.0_wp
   end type valve_guide_t

   !> The same ready for evaluation
   type :: guide_part_t
      private
      !> Drag per speed and viscosity [m]
      real(wp) :: factor = 0.0_wp
      !> Drag per speed with the oil at its temperature [N s/m]
      real(wp) :: coefficient = 0.0_wp
   end type guide_part_t

contains

   !> Make the guide ready.
   pure subroutine new_guide_part(part, guide)
      !> Ready for evaluation
      type(guide_part_t), intent(out) :: part
      !> As a deck has it
      type(valve_guide_t), intent(in) :: guide

      part%factor = guide_drag_coefficient(1.0_wp, guide%length, guide%stem_diameter, guide%radial_clearance)
   end subroutine new_guide_part

   !> Give the guide the oil.
   pure subroutine set_guide_oil(part, viscosity)
      !> The guide
      type(guide_part_t), intent(inout) :: part
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity

      part%coefficient = part%factor*viscosity
   end subroutine set_guide_oil

   !> Drag of the guide at a speed of the valve: over the speed, and how it grows with the speed. Both are the same here.
   elemental subroutine find_guide_drag(part, speed, drag, slope)
      !> The guide
      type(guide_part_t), intent(in) :: part
      !> Speed of the valve [m/s]
      real(wp), intent(in) :: speed
      !> Force against the valve's motion over the speed, D [N s/m]
      real(wp), intent(out) :: drag
      !> Derivative of that force, D v, over the speed [N s/m]
      real(wp), intent(out) :: slope

      ! A film's shear is proportional to the speed
      associate (unused => speed)
      end associate
      drag = part%coefficient
      slope = part%coefficient
   end subroutine find_guide_drag

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
