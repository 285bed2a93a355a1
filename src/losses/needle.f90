!> Bearing between the roller and its pin: needles or a plain pin, boundary lubricated, or a pin with an oil film.
!>
!> In: load and relative spin. Out: friction torque. Source: Kubiak and Siczek (2016); Islam (2019) eq. (46); for the oil film
!> `camroller_pin_film`.
module camroller_needle
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_pin_film, only : pin_film_t, pin_part_t, new_pin_part, set_pin_oil
   implicit none
   private

   public :: needle_bearing_t, bearing_part_t, roller_bearing_names, new_bearing_part, friction_radius, bearing_torque, &
      & bearing_torque_slope, set_bearing_oil, kind_needles, kind_journal

   !> What the roller turns on
   character(len=*), parameter :: roller_bearing_names(*) = [character(len=name_length) :: "needles", "plain_pin", "journal"]
   !> Places in `roller_bearing_names`
   integer, parameter :: kind_needles = 1, kind_journal = 3

   !> Bearing between roller and pin
   type :: needle_bearing_t
      !> One of `roller_bearing_names`
      character(len=name_length) :: kind = "needles"
      !> Friction coefficient, mu_p; kind `journal`: of touching asperities [-]
      real(wp) :: friction_coefficient = 0.0_wp
      !> Radius of a needle [m]; kind `needles`
      real(wp) :: needle_radius = 0.0_wp
      !> Film and surfaces of the pin; kind `journal`
      type(pin_film_t) :: film
      !> Reversal of the torque is spread over this part of the cam's speed [-]
      real(wp) :: reversal_ratio = 0.01_wp
   end type needle_bearing_t

   !> The same ready for evaluation
   type :: bearing_part_t
      !> Friction coefficient, mu_p; zero where there is a film, which has its own [-]
      real(wp) :: friction_coefficient
      !> Radius, r_p [m]
      real(wp) :: radius
      !> Film of the pin, where it has one
      type(pin_part_t), allocatable :: film
      !> Spin over which the torque reverses [rad/s]
      real(wp) :: reversal_spin
      !> The same over the cam's speed [-]
      real(wp) :: reversal_ratio
   end type bearing_part_t

contains

   !> Make a bearing ready.
   subroutine new_bearing_part(part, bearing, inner_radius, is_flexible, has_others, error)
      !> Ready for evaluation
      type(bearing_part_t), intent(out) :: part
      !> As a deck has it
      type(needle_bearing_t), intent(in) :: bearing
      !> Inner radius of the roller [m]
      real(wp), intent(in) :: inner_radius
      !> Is the train flexible? Has the case a numerical film or a drag of needles?
      logical, intent(in) :: is_flexible, has_others
      !> Deck error: unknown kind, or numbers that its film cannot have
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call find_name("roller bearing", bearing%kind, roller_bearing_names, choice, error)
      if (allocated(error)) return
      part%friction_coefficient = bearing%friction_coefficient
      part%radius = friction_radius(bearing, inner_radius)
      part%reversal_ratio = bearing%reversal_ratio
      if (choice /= kind_journal) return
      if (is_flexible .or. has_others) then
         call raise(error, kind_deck, "needle_bearing: kind 'journal' is not combined with &dynamics, &ehl or &needle_drag")
         return
      end if
      part%friction_coefficient = 0.0_wp
      allocate (part%film)
      call new_pin_part(part%film, bearing%film, inner_radius, bearing%friction_coefficient, error)
   end subroutine new_bearing_part

   !> Give the film of a pin its oil.
   pure subroutine set_bearing_oil(part, viscosity)
      !> The bearing
      type(bearing_part_t), intent(inout) :: part
      !> Viscosity of the oil [Pa s]
      real(wp), intent(in) :: viscosity

      if (allocated(part%film)) call set_pin_oil(part%film, viscosity)
   end subroutine set_bearing_oil

   !> Radius at which the bearing's friction acts: pitch circle of the needles, or bore of the roller on a plain pin.
   pure function friction_radius(bearing, inner_radius) result(radius)
      !> The bearing
      type(needle_bearing_t), intent(in) :: bearing
      !> Inner radius of the roller [m]
      real(wp), intent(in) :: inner_radius
      !> Friction radius, r_p [m]
      real(wp) :: radius

      radius = inner_radius
      if (bearing%kind == roller_bearing_names(kind_needles)) radius = inner_radius - bearing%needle_radius
   end function friction_radius

   !> Friction torque on the roller, `mu_p W r_p sgn(spin)`, the sign spread over a small spin.
   !>
   !> Note: the smooth sign is ours; with a reversal spin of a hundredth of the cam's speed it is exact to round-off
   !> wherever the roller turns at a fifth of the cam's speed or faster.
   elemental function bearing_torque(friction_coefficient, load, radius, spin, reversal_spin) result(torque)
      !> Friction coefficient, mu_p [-]
      real(wp), intent(in) :: friction_coefficient
      !> Load on the bearing [N]
      real(wp), intent(in) :: load
      !> Friction radius, r_p [m]
      real(wp), intent(in) :: radius
      !> Spin of the roller relative to its pin [rad/s]
      real(wp), intent(in) :: spin
      !> Spin over which the torque reverses [rad/s], positive
      real(wp), intent(in) :: reversal_spin
      !> Torque against the spin [N m]
      real(wp) :: torque

      torque = friction_coefficient*load*radius*tanh(spin/reversal_spin)
   end function bearing_torque

   !> Derivative of that torque with respect to the spin.
   elemental function bearing_torque_slope(friction_coefficient, load, radius, spin, reversal_spin) result(slope)
      !> Friction coefficient, mu_p [-]
      real(wp), intent(in) :: friction_coefficient
      !> Load on the bearing [N]
      real(wp), intent(in) :: load
      !> Friction radius, r_p [m]
      real(wp), intent(in) :: radius
      !> Spin of the roller relative to its pin [rad/s]
      real(wp), intent(in) :: spin
      !> Spin over which the torque reverses [rad/s], positive
      real(wp), intent(in) :: reversal_spin
      !> Derivative [N m s/rad]
      real(wp) :: slope

      ! tanh(spin/reversal spin) [-]
      real(wp) :: part

      part = tanh(spin/reversal_spin)
      slope = friction_coefficient*load*radius*(1.0_wp - part)*(1.0_wp + part)/reversal_spin
   end function bearing_torque_slope

end module camroller_needle
