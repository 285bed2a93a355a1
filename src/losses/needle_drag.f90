!> Drag of the oil in the roller's needle bearing: the part of its torque that does not depend on the load.
!>
!> In: spin of the roller relative to the finger, kinematic viscosity. Out: torque and its slope. Source: Palmgren, Ball and Roller
!> Bearing Engineering (1959), section 2.4, in the form of Harris and Kotzalas, Essential Concepts of Bearing Technology (2006).
!>
!> `M_0 = f_0 1e-7 max((nu n)^(2/3), 160) d_m^3` in N mm, nu in mm^2/s, n in rev/min, d_m in mm. The limit is printed at
!> nu n = 2000, where both branches differ by 0.8 %; here they meet, at 160^(3/2) = 2023.9.
module camroller_needle_drag
   use camroller_kinds, only : wp, per_minute
   use camroller_error, only : error_t, raise, kind_deck
   implicit none
   private

   public :: needle_drag_t, drag_part_t, new_drag_part, set_drag_oil, set_drag_speed, drag_torque, drag_torque_slope, &
      & drag_torque_by_reversal

   !> Drag, as a deck has it
   type :: needle_drag_t
      !> Diameter of the circle through the middles of the needles, d_m [m]
      real(wp) :: pitch_diameter = 0.0_wp
      !> Factor of type and lubrication, f_0 [-]
      real(wp) :: factor = 12.0_wp
      !> Reversal of the torque is spread over this part of the cam's speed [-]
      real(wp) :: reversal_ratio = 0.01_wp
   end type needle_drag_t

   !> The same ready for evaluation
   type :: drag_part_t
      !> Torque on the lower branch, f_0 160e-7 d_m^3 [N m]
      real(wp) :: least = 0.0_wp
      !> Spin at which the branches meet [rad/s]
      real(wp) :: limit = 0.0_wp
      !> Spin over which the torque reverses [rad/s]; the same over the cam's speed [-]
      real(wp) :: reversal_spin = 0.0_wp, reversal_ratio = 0.0_wp
   end type drag_part_t

   !> Value of (nu n)^(2/3) on the lower branch, nu in mm^2/s and n in rev/min [-]
   real(wp), parameter :: floor = 160.0_wp
   !> Palmgren's constant for N mm and mm [1e-7 N mm^-2], in SI [N m/m^3]
   real(wp), parameter :: per_volume = 1.0e-7_wp*1.0e-3_wp*1.0e9_wp
   !> mm^2/s in a m^2/s [-], rev/min in a rad/s [-]
   real(wp), parameter :: square_millimetres = 1.0e6_wp

contains

   !> Make the drag ready.
   subroutine new_drag_part(part, drag, error)
      !> Ready for evaluation
      type(drag_part_t), intent(out) :: part
      !> As a deck has it
      type(needle_drag_t), intent(in) :: drag
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (.not. (drag%pitch_diameter > 0.0_wp .and. drag%factor >= 0.0_wp .and. drag%reversal_ratio > 0.0_wp)) then
         call raise(error, kind_deck, "needle_drag: pitch diameter and reversal ratio must be positive, the factor not negative")
      end if
      part%least = drag%factor*per_volume*floor*drag%pitch_diameter**3
      part%reversal_ratio = drag%reversal_ratio
   end subroutine new_drag_part

   !> Give the drag the oil.
   pure subroutine set_drag_oil(part, kinematic_viscosity)
      !> The drag
      type(drag_part_t), intent(inout) :: part
      !> Kinematic viscosity of the oil, nu [m^2/s]
      real(wp), intent(in) :: kinematic_viscosity

      part%limit = floor**1.5_wp/(kinematic_viscosity*square_millimetres*per_minute)
   end subroutine set_drag_oil

   !> Give the drag the cam's speed.
   pure subroutine set_drag_speed(part, speed)
      !> The drag
      type(drag_part_t), intent(inout) :: part
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed

      part%reversal_spin = part%reversal_ratio*speed
   end subroutine set_drag_speed

   !> Torque on the roller against its spin, `M_0 tanh(spin/reversal spin)`.
   elemental function drag_torque(part, spin) result(torque)
      !> The drag
      type(drag_part_t), intent(in) :: part
      !> Spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: spin
      !> Torque [N m]
      real(wp) :: torque

      torque = part%least*max(abs(spin)/part%limit, 1.0_wp)**(2.0_wp/3.0_wp)*tanh(spin/part%reversal_spin)
   end function drag_torque

   !> Derivative of that torque over the spin; from above where the branches meet.
   elemental function drag_torque_slope(part, spin) result(slope)
      !> The drag
      type(drag_part_t), intent(in) :: part
      !> Spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: spin
      !> Derivative [N m s/rad]
      real(wp) :: slope

      ! Torque over that of the lower branch without its sign, and tanh(spin/reversal spin) [-]
      real(wp) :: growth, part_of_sign

      growth = max(abs(spin)/part%limit, 1.0_wp)**(2.0_wp/3.0_wp)
      part_of_sign = tanh(spin/part%reversal_spin)
      slope = growth*(1.0_wp - part_of_sign)*(1.0_wp + part_of_sign)/part%reversal_spin
      if (abs(spin) >= part%limit) slope = slope + 2.0_wp/3.0_wp*growth/spin*part_of_sign
      slope = part%least*slope
   end function drag_torque_slope

   !> Derivative of that torque over the logarithm of the spin over which it reverses.
   elemental function drag_torque_by_reversal(part, spin) result(slope)
      !> The drag
      type(drag_part_t), intent(in) :: part
      !> Spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: spin
      !> Derivative [N m]
      real(wp) :: slope

      real(wp) :: part_of_sign ! tanh(spin/reversal spin) [-]

      part_of_sign = tanh(spin/part%reversal_spin)
      slope = -part%least*max(abs(spin)/part%limit, 1.0_wp)**(2.0_wp/3.0_wp)*(spin/part%reversal_spin)*(1.0_wp - part_of_sign) &
         & *(1.0_wp + part_of_sign)
   end function drag_torque_by_reversal

end module camroller_needle_drag
