!> Oil film and asperities between a roller and its plain pin: mixed friction by the laws of journal bearings.
!>
!> In: dimensions, surfaces, viscosity, load, spin of the roller relative to the finger. Out: torque on the roller, with its
!> derivatives over load and spin; eccentricity, smallest film and the asperities' part of the load.
!>
!> The pin stands still with the finger and the roller turns on it, so that the work is that of the torque on the roller: the shear
!> of the film and half of the moment by which its load acts beside the centre, `M_f = r F + W_f c e sin(A)/2`, and `mu r N` of
!> asperities with the normal forces N (`camroller_bearing_asperity`). The load is that of the roller's contact, taken as steady
!> at each instant. Sources: Ocvirk (1952) and Butenschoen (1976) as in `camroller_journal`, Greenwood and Tripp (1970).
!>
!> A film needs speed: `s = sqrt(spin^2 + s_0^2)` takes its place, so that torque and slope are continuous where the roller
!> stands still on its pin; at ten times s_0 the torque differs by half a per cent of what the film adds to that.
module camroller_pin_film
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_bearing_asperity, only : bearing_asperity_t, bearing_touch_t, balance_t, new_touch, balance_load
   use camroller_journal, only : journal_t, find_tangent, journal_at_speed, journal_law_names, &
      & journal_solved, law_covers_width, width_advice, with_shear
   implicit none
   private

   public :: pin_film_t, pin_part_t, pin_state_t, pin_law_names, new_pin_part, set_pin_oil, pin_journal, unloaded_torque, &
      & solve_pin

   !> Laws for the film of a pin
   character(len=*), parameter :: pin_law_names(*) = [character(len=name_length) :: "short_ocvirk", "finite"]

   !> Film and surfaces of a pin, as a deck has them
   type :: pin_film_t
      !> One of `pin_law_names`
      character(len=name_length) :: law = "finite"
      !> Width of the bearing, radial clearance [m]
      real(wp) :: width = 0.0_wp, radial_clearance = 0.0_wp
      !> Root mean square roughness of roller and pin together [m]
      real(wp) :: roughness = 0.0_wp
      !> `2/[(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]` of roller and pin [Pa]
      real(wp) :: modulus = 0.0_wp
      !> Density times tip radius times roughness of asperities; roughness over tip radius [-]
      real(wp) :: roughness_product = 0.04_wp, roughness_over_tip_radius = 0.01_wp
   end type pin_film_t

   !> The same ready for evaluation
   type :: pin_part_t
      private
      !> The bearing at a viscosity of 1 Pa s and a spin of 1 rad/s
      type(journal_t) :: journal
      !> Its surfaces
      type(bearing_touch_t) :: touch
      !> Radial clearance [m]
      real(wp) :: clearance = 0.0_wp
      !> Viscosity of the oil [Pa s]
      real(wp) :: viscosity = 0.0_wp
   end type pin_part_t

   !> A pin at one instant
   type :: pin_state_t
      !> Torque on the roller against its spin, less that without load [N m]
      real(wp) :: torque = 0.0_wp
      !> Its derivatives over the logarithm of the load [N m], over the spin [N m s/rad], and over the logarithm of the spin over
      !> which it reverses [N m]
      real(wp) :: by_load = 0.0_wp, by_spin = 0.0_wp, by_reversal = 0.0_wp
      !> Eccentricity over clearance [-], smallest film [m], asperities' load along the line of centres over the load [-]
      real(wp) :: eccentricity = 0.0_wp, film = 0.0_wp, asperity_share = 0.0_wp
   end type pin_state_t

contains

   !> Make a pin ready.
   subroutine new_pin_part(part, given, radius, coefficient, error)
      !> Ready for evaluation
      type(pin_part_t), intent(out) :: part
      !> As a deck has it
      type(pin_film_t), intent(in) :: given
      !> Radius of the pin [m]
      real(wp), intent(in) :: radius
      !> Friction coefficient of touching asperities [-]
      real(wp), intent(in) :: coefficient
      !> Deck error: unknown law, dimensions not above zero or beyond the law's range, too little clearance
      type(error_t), allocatable, intent(out) :: error

      integer :: law

      call find_name("roller bearing law", given%law, journal_law_names, law, error)
      if (allocated(error)) return
      if (.not. min(radius, given%width, given%radial_clearance) > 0.0_wp) then
         call raise(error, kind_deck, "needle_bearing: kind 'journal' needs radius, width and clearance above zero")
      else if (.not. (any(given%law == pin_law_names) .and. law_covers_width(given%law, given%width, 2.0_wp*radius))) then
         call raise(error, kind_deck, "needle_bearing: "//width_advice)
      end if
      if (allocated(error)) return
      call new_touch(part%touch, bearing_asperity_t(given%roughness, given%modulus, coefficient, given%roughness_product, &
         & given%roughness_over_tip_radius), given%radial_clearance, error)
      if (allocated(error)) return
      part%journal = journal_at_speed(law, 2.0_wp*radius, given%width, given%radial_clearance, 1.0_wp, 1.0_wp)
      part%clearance = given%radial_clearance
   end subroutine new_pin_part

   !> Give the pin the oil.
   pure subroutine set_pin_oil(part, viscosity)
      !> The pin
      type(pin_part_t), intent(inout) :: part
      !> Viscosity [Pa s]
      real(wp), intent(in) :: viscosity

      part%viscosity = viscosity
   end subroutine set_pin_oil

   !> The bearing of a pin in the oil that it has.
   pure function pin_journal(part, spin) result(journal)
      !> The pin
      type(pin_part_t), intent(in) :: part
      !> Spin of the roller relative to the pin [rad/s]
      real(wp), intent(in) :: spin
      !> The bearing
      type(journal_t) :: journal

      journal = with_shear(part%journal, part%viscosity*abs(spin))
   end function pin_journal

   !> Torque on a roller without load against its spin, over the spin: Petroff's.
   pure function unloaded_torque(part) result(torque)
      !> The pin
      type(pin_part_t), intent(in) :: part
      !> Torque per spin [N m s/rad]
      real(wp) :: torque

      torque = part%viscosity*part%journal%petroff_friction*part%journal%radius
   end function unloaded_torque

   !> State of a pin under a load.
   pure subroutine solve_pin(part, load, spin, reversal_spin, state)
      !> The pin
      type(pin_part_t), intent(in) :: part
      !> Load [N]
      real(wp), intent(in) :: load
      !> Spin of the roller relative to the pin; spin over which the torque reverses, above zero [rad/s]
      real(wp), intent(in) :: spin, reversal_spin
      !> The state
      type(pin_state_t), intent(out) :: state

      type(balance_t) :: balance
      ! e/sqrt(1 - e^2), sqrt(1 + t^2), sine of the attitude angle, part of the spin in its magnitude [-]; magnitude of the spin
      ! [rad/s], viscosity times that [Pa]
      real(wp) :: t, secant, sine, part_of_spin, magnitude, shear
      ! Torques of shear and of the load beside the centre, over viscosity times spin [m^3]; torque of asperities and the whole
      ! torque [N m], slope of that over ln t at constant spin [N m]
      real(wp) :: drag, beside, rubbing, whole, slope

      state = pin_state_t(film=part%clearance)
      if (.not. load > 0.0_wp) return
      magnitude = hypot(spin, reversal_spin)
      part_of_spin = spin/magnitude
      shear = part%viscosity*magnitude
      call hold_pin(part, load, shear, t, balance)
      secant = sqrt(1.0_wp + t**2)
      state%eccentricity = t/secant
      state%film = part%clearance/(secant*(secant + t))
      state%asperity_share = balance%along/load
      associate (journal => part%journal, film => balance%film)
         sine = sin(film%angle)
         drag = journal%petroff_friction*journal%radius
         beside = 0.5_wp*part%clearance*journal%unit_load*film%number*state%eccentricity*sine
         rubbing = part%touch%boundary_coefficient*journal%radius*balance%normal
         ! secant - 1 without cancellation
         whole = shear*(drag*t**2/(1.0_wp + secant) + beside) + rubbing
         slope = shear*(drag*t**2/secant + beside*(film%number_slope + 1.0_wp/secant**2) + 0.5_wp*part%clearance* &
            & journal%unit_load*film%number*state%eccentricity*cos(film%angle)*film%angle_slope) &
            & + part%touch%boundary_coefficient*journal%radius*balance%normal_slope
      end associate
      state%torque = part_of_spin*whole
      state%by_load = part_of_spin*slope/balance%slope
      state%by_spin = part_of_spin**2/magnitude*(whole - rubbing - slope*balance%by_speed/balance%slope) &
         & + whole*(reversal_spin/magnitude)**2/magnitude
      state%by_reversal = part_of_spin*(reversal_spin/magnitude)**2*(-rubbing - slope*balance%by_speed/balance%slope)
   end subroutine solve_pin

   !> Loads of film and asperities on a pin at the eccentricity that they hold it at.
   pure subroutine hold_pin(part, load, shear, t, balance)
      type(pin_part_t), intent(in) :: part
      !> Load [N], viscosity times spin [Pa]
      real(wp), intent(in) :: load, shear
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(out) :: t
      !> Loads there
      type(balance_t), intent(out) :: balance

      type(journal_t) :: journal
      integer :: status

      journal = with_shear(part%journal, shear)
      call find_tangent(journal, load, t, status)
      if (status == journal_solved .and. t > 0.0_wp) call balance_load(journal, part%touch, load, t, balance, status)
   end subroutine hold_pin

end module camroller_pin_film
