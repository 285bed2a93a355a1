!> The roller as a spinning ring.
!>
!> In: dimensions, traction, rolling resistance, bearing torque. Out: inertia and spin acceleration.
!> Sources: Ji and Taylor (1998); Islam (2019) eq. (12) with the coefficient of friction of the contact, and rolling
!> resistance with its sign.
module camroller_roller
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: roller_t, spin_names, ring_inertia, spin_acceleration

   !> What counts as pure rolling: with the turning of the contact normal, or as the source takes it
   character(len=*), parameter :: spin_names(*) = [character(len=name_length) :: "exact", "thesis"]

   !> Roller as a spinning ring
   type :: roller_t
      !> Mass of the roller [kg]
      real(wp) :: mass = 0.0_wp
      !> Wall thickness of the ring [m]
      real(wp) :: wall_thickness = 0.0_wp
      !> One of `spin_names`
      character(len=name_length) :: spin = "exact"
   end type roller_t

contains

   !> Moment of inertia of a ring about its axis, `m (r_o^2 + r_i^2)/2`.
   elemental function ring_inertia(mass, outer_radius, inner_radius) result(inertia)
      !> Mass [kg]
      real(wp), intent(in) :: mass
      !> Outer radius [m]
      real(wp), intent(in) :: outer_radius
      !> Inner radius [m]
      real(wp), intent(in) :: inner_radius
      !> Moment of inertia [kg m^2]
      real(wp) :: inertia

      inertia = 0.5_wp*mass*(outer_radius**2 + inner_radius**2)
   end function ring_inertia

   !> Angular acceleration of the roller, `I domega/dt = (F_t - F_r) r_R - T_B`.
   elemental function spin_acceleration(traction, rolling_resistance, radius, bearing_torque, inertia) result(acceleration)
      !> Traction that drives the roller, F_t [N]
      real(wp), intent(in) :: traction
      !> Rolling resistance that acts on the spin, F_r [N]
      real(wp), intent(in) :: rolling_resistance
      !> Outer radius of the roller, r_R [m]
      real(wp), intent(in) :: radius
      !> Friction torque of the roller's bearing, T_B [N m]
      real(wp), intent(in) :: bearing_torque
      !> Moment of inertia, I [kg m^2]
      real(wp), intent(in) :: inertia
      !> Angular acceleration [rad/s^2]
      real(wp) :: acceleration

      acceleration = ((traction - rolling_resistance)*radius - bearing_torque)/inertia
   end function spin_acceleration

end module camroller_roller
