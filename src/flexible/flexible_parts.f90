!> What a flexible train is made of: the stiffness and damping of its contacts, its spring's modes, its adjuster, its masses.
!>
!> In: what a deck gives. Out: constants for the equations of motion.
module camroller_flexible_parts
   use camroller_kinds, only : wp
   use camroller_contact_compliance, only : line_compliance, damping_of_restitution
   use camroller_spring_modes, only : spring_modes_t
   use camroller_lash_adjuster, only : adjuster_t
   implicit none
   private

   public :: dynamics_t, flexible_t, set_contacts, usual_dynamics
   public :: damper_count, dampers_without_adjuster, damper_series, damper_meanings

   !> Where a train loses energy to damping; the last four are of the adjuster: names of the series and what each is of
   character(len=*), parameter :: damper_series(*) = [character(len=26) :: "damping_power_cam", "damping_power_pad", &
      & "damping_power_seat", "damping_power_spring", "damping_power_plunger", "damping_power_stops", "damping_power_leak", &
      & "damping_power_check_valve"]
   character(len=*), parameter :: damper_meanings(*) = [character(len=54) :: "power lost between cam and roller", &
      & "power lost at the pad of the valve", "power lost at the valve seat", "power lost in the spring's modes", &
      & "power lost in the oil film between plunger and bore", "power lost at the plunger's stops", &
      & "power lost by the oil that leaks along the plunger", "power lost by the oil that passes the check valve"]
   integer, parameter :: damper_count = size(damper_series), dampers_without_adjuster = 4

   !> Stiffness and damping of the train's contacts, as a deck has them; what a deck does not give is that of the reference train,
   !> whose finger is `usual_arm` long. Damping stands for a force over the elastic one, per speed of approach.
   type :: dynamics_t
      !> Stiffness of the finger in bending, with pin and shaft, at the roller [N/m]
      real(wp) :: finger_stiffness = 5.0e7_wp
      !> Damping of cam and roller [s/m]
      real(wp) :: contact_damping = 0.2_wp
      !> Stiffness of pad and stem [N/m] and its damping [s/m]
      real(wp) :: pad_stiffness = 5.0e7_wp, pad_damping = 0.2_wp
      !> Stiffness of seat and valve head [N/m] and its damping [s/m]
      real(wp) :: seat_stiffness = 5.0e7_wp, seat_damping = 1.0_wp
      !> Speed after over speed before an impact on the seat; zero where the damping is given [-]
      real(wp) :: seat_restitution = 0.0_wp
      !> Speed of that impact [m/s]
      real(wp) :: seat_restitution_speed = 0.3_wp
      !> Mechanical lash at the pad of the closed valve; zero where the base circle load presses the train together [m]
      real(wp) :: lash = 0.0_wp
   end type dynamics_t

   !> Constants of a flexible train
   type :: flexible_t
      !> Approach of cam and roller over the load to the power 0.9, c_H [m/N^0.9]
      real(wp) :: compliance
      !> Stiffness in series with it, k_b [N/m]
      real(wp) :: finger_stiffness
      !> Damping of cam and roller, a_c [s/m]
      real(wp) :: contact_damping
      !> Pad: stiffness [N/m], damping [s/m]
      real(wp) :: pad_stiffness, pad_damping
      !> Seat: stiffness [N/m], damping [s/m]
      real(wp) :: seat_stiffness, seat_damping
      !> Lash at the pad, c_L [m]
      real(wp) :: lash
      !> Place of the fixed pivot along the adjuster's axis, or of the adjuster's plunger at rest, y [m]
      real(wp) :: pivot_place = 0.0_wp
      !> Mass that the valve's own equation has, m_N [kg]
      real(wp) :: effective_mass
      !> Mass of the finger with its roller, m_F [kg]
      real(wp) :: finger_mass
      !> Distance of its centre of mass from the pivot, on the roller arm, r_G [m]
      real(wp) :: finger_centre
      !> Direction of the adjuster's axis towards the cam, exp(-i chi_h) [-]
      complex(wp) :: axis
      !> Cosine of the angle from the valve's axis to the adjuster's, chi_h - chi [-]
      real(wp) :: tilt_cosine
      !> Way of a pivot across the valve's axis, over its way along the adjuster's, sin(chi - chi_h) [-]
      real(wp) :: tilt_sine = 0.0_wp
      !> Modes of the spring; without any it has no mass of its own
      type(spring_modes_t) :: modes
      !> Lash adjuster; the pivot is fixed without one
      type(adjuster_t), allocatable :: adjuster
   end type flexible_t

   !> Distance from pivot to roller of the reference train [m]
   real(wp), parameter :: usual_arm = 20.8e-3_wp

contains

   !> Stiffness and damping that a train of some size usually has: bodies of one shape and material are as much stiffer as they are
   !> larger, since the force of one strain goes with the square of the size and the deflection with the size. Damping per speed of
   !> approach stays, as do stresses and speeds of an engine of another size.
   pure function usual_dynamics(arm) result(usual)
      !> Distance from the finger's pivot to the roller's centre, which stands for the size [m]
      real(wp), intent(in) :: arm
      !> Stiffness and damping
      type(dynamics_t) :: usual

      real(wp) :: scale ! [-]

      scale = arm/usual_arm
      usual%finger_stiffness = scale*usual%finger_stiffness
      usual%pad_stiffness = scale*usual%pad_stiffness
      usual%seat_stiffness = scale*usual%seat_stiffness
   end function usual_dynamics

   !> Constants of the contacts.
   pure subroutine set_contacts(flexible, dynamics, modulus, length)
      !> The train
      type(flexible_t), intent(inout) :: flexible
      !> What is given
      type(dynamics_t), intent(in) :: dynamics
      !> Equivalent modulus of cam and roller [Pa]
      real(wp), intent(in) :: modulus
      !> Length of their contact [m]
      real(wp), intent(in) :: length

      flexible%compliance = line_compliance(modulus, length)
      flexible%finger_stiffness = dynamics%finger_stiffness
      flexible%contact_damping = dynamics%contact_damping
      flexible%pad_stiffness = dynamics%pad_stiffness
      flexible%pad_damping = dynamics%pad_damping
      flexible%seat_stiffness = dynamics%seat_stiffness
      flexible%seat_damping = dynamics%seat_damping
      if (dynamics%seat_restitution > 0.0_wp) then
         flexible%seat_damping = damping_of_restitution(dynamics%seat_restitution, dynamics%seat_restitution_speed)
      end if
      flexible%lash = dynamics%lash
   end subroutine set_contacts

end module camroller_flexible_parts
