!> Bearing between the roller and its pin: needles or a plain pin with a constant coefficient, needles by SKF's model, or a pin with
!> an oil film.
!>
!> In: load and relative spin. Out: friction torque. Source: Kubiak and Siczek (2016); Islam (2019) eq. (46); for SKF's model
!> `camroller_skf_bearing`, for the oil film `camroller_pin_film`.
module camroller_needle
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_pin_film, only : pin_film_t, pin_part_t, pin_state_t, new_pin_part, set_pin_oil, solve_pin
   use camroller_skf_bearing, only : skf_bearing_t, skf_part_t, skf_state_t, new_skf_part, set_skf_oil, solve_skf
   implicit none
   private

   public :: needle_bearing_t, bearing_part_t, roller_bearing_names, new_bearing_part, friction_radius, bearing_torque, &
      & bearing_torque_slope, set_bearing_oil, loaded_torque, has_needles, kind_journal, kind_needles, kind_skf

   !> What the roller turns on
   character(len=*), parameter :: roller_bearing_names(*) = [character(len=name_length) :: "needles", "needles_skf", "plain_pin", &
      & "journal"]
   !> Places in `roller_bearing_names`
   integer, parameter :: kind_needles = 1, kind_skf = 2, kind_journal = 4

   !> Bearing between roller and pin
   type :: needle_bearing_t
      !> One of `roller_bearing_names`
      character(len=name_length) :: kind = "needles"
      !> Friction coefficient, mu_p; kind `journal`: of touching asperities; kind `needles_skf`: without a film [-]
      real(wp) :: friction_coefficient = 0.0_wp
      !> Radius of a needle [m]; kinds with needles
      real(wp) :: needle_radius = 0.0_wp
      !> Constants of SKF's model; kind `needles_skf`
      type(skf_bearing_t) :: skf
      !> Film and surfaces of the pin; kind `journal`
      type(pin_film_t) :: film
      !> Reversal of the torque is spread over this part of the cam's speed [-]
      real(wp) :: reversal_ratio = 0.01_wp
   end type needle_bearing_t

   !> The same ready for evaluation
   type :: bearing_part_t
      !> Friction coefficient, mu_p; zero where torque and load are not in proportion [-]
      real(wp) :: friction_coefficient
      !> Radius, r_p [m]
      real(wp) :: radius
      !> Film of the pin, where it has one
      type(pin_part_t), allocatable :: film
      !> SKF's model, where it is that
      type(skf_part_t), allocatable :: skf
      !> Spin over which the torque reverses [rad/s]
      real(wp) :: reversal_spin
      !> The same over the cam's speed [-]
      real(wp) :: reversal_ratio
   end type bearing_part_t

contains

   !> Make a bearing ready.
   subroutine new_bearing_part(part, bearing, inner_radius, has_drag, error)
      !> Ready for evaluation
      type(bearing_part_t), intent(out) :: part
      !> As a deck has it
      type(needle_bearing_t), intent(in) :: bearing
      !> Inner radius of the roller [m]
      real(wp), intent(in) :: inner_radius
      !> Has the case a drag of needles?
      logical, intent(in) :: has_drag
      !> Deck error: unknown kind, or numbers that its film cannot have
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call find_name("roller bearing", bearing%kind, roller_bearing_names, choice, error)
      if (allocated(error)) return
      part%friction_coefficient = bearing%friction_coefficient
      part%radius = friction_radius(bearing, inner_radius)
      part%reversal_ratio = bearing%reversal_ratio
      if (choice /= kind_journal .and. choice /= kind_skf) return
      if (has_drag) then
         call raise(error, kind_deck, "needle_bearing: kind '"//trim(bearing%kind)// &
            & "' is not combined with &needle_drag")
         return
      end if
      part%friction_coefficient = 0.0_wp
      if (choice == kind_journal) then
         allocate (part%film)
         call new_pin_part(part%film, bearing%film, inner_radius, bearing%friction_coefficient, error)
      else
         allocate (part%skf)
         call new_skf_part(part%skf, bearing%skf, inner_radius, bearing%needle_radius, bearing%friction_coefficient, error)
      end if
   end subroutine new_bearing_part

   !> Give the bearing its oil, where its torque follows that.
   pure subroutine set_bearing_oil(part, viscosity, density)
      !> The bearing
      type(bearing_part_t), intent(inout) :: part
      !> Viscosity of the oil [Pa s], its density [kg/m^3]
      real(wp), intent(in) :: viscosity, density

      if (allocated(part%film)) call set_pin_oil(part%film, viscosity)
      if (allocated(part%skf)) call set_skf_oil(part%skf, viscosity/density)
   end subroutine set_bearing_oil

   !> Torque of a bearing whose torque and load are not in proportion, less that without load, and its derivatives.
   pure subroutine loaded_torque(part, load, spin, torque, by_load, by_spin, by_reversal)
      !> The bearing, with a film or SKF's model
      type(bearing_part_t), intent(in) :: part
      !> Load [N], spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: load, spin
      !> Torque against the spin [N m]
      real(wp), intent(out) :: torque
      !> Its derivatives over the logarithm of the load [N m], over the spin [N m s/rad], and over the logarithm of the spin over
      !> which it reverses [N m]
      real(wp), intent(out) :: by_load, by_spin, by_reversal

      type(pin_state_t) :: pin
      type(skf_state_t) :: needles

      if (allocated(part%film)) then
         call solve_pin(part%film, load, spin, part%reversal_spin, pin)
         torque = pin%torque
         by_load = pin%by_load
         by_spin = pin%by_spin
         by_reversal = pin%by_reversal
      else
         call solve_skf(part%skf, load, spin, part%reversal_spin, needles)
         torque = needles%torque
         by_load = needles%by_load
         by_spin = needles%by_spin
         by_reversal = needles%by_reversal
      end if
   end subroutine loaded_torque

   !> Has a bearing of this kind needles?
   elemental function has_needles(kind) result(has)
      !> One of `roller_bearing_names`
      character(len=*), intent(in) :: kind
      !> Has it?
      logical :: has

      has = any(kind == roller_bearing_names([kind_needles, kind_skf]))
   end function has_needles

   !> Radius at which the bearing's friction acts: pitch circle of the needles, or bore of the roller on a plain pin.
   pure function friction_radius(bearing, inner_radius) result(radius)
      !> The bearing
      type(needle_bearing_t), intent(in) :: bearing
      !> Inner radius of the roller [m]
      real(wp), intent(in) :: inner_radius
      !> Friction radius, r_p [m]
      real(wp) :: radius

      radius = inner_radius
      if (has_needles(bearing%kind)) radius = inner_radius - bearing%needle_radius
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
