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
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_bearing_asperity, only : bearing_asperity_t, touch_t, new_touch, asperity_forces
   use camroller_greenwood_tripp, only : largest_film_ratio
   use camroller_journal, only : journal_t, film_t, film_at, find_tangent, journal_at_speed, journal_law_names, &
      & journal_solved, law_covers_width, width_advice
   use camroller_spline, only : spline_t, new_clamped_spline, evaluate_spline
   implicit none
   private

   public :: pin_film_t, pin_part_t, pin_state_t, pin_law_names, new_pin_part, set_pin_oil, unloaded_torque, &
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
      !> Radial clearance, roughness [m]; friction coefficient of asperities [-]
      real(wp) :: clearance = 0.0_wp, roughness = 0.0_wp, coefficient = 0.0_wp
      !> Viscosity of the oil [Pa s]
      real(wp) :: viscosity = 0.0_wp
      !> Force of asperities along the line of centres and sum of their normal forces over the smallest film ratio [N]
      type(spline_t) :: along, normal
   end type pin_part_t

   !> A pin at one instant
   type :: pin_state_t
      !> Torque on the roller against its spin, less that without load [N m]
      real(wp) :: torque = 0.0_wp
      !> Its derivatives over the logarithm of the load [N m] and over the spin [N m s/rad]
      real(wp) :: by_load = 0.0_wp, by_spin = 0.0_wp
      !> Eccentricity over clearance [-], smallest film [m], asperities' load along the line of centres over the load [-]
      real(wp) :: eccentricity = 0.0_wp, film = 0.0_wp, asperity_share = 0.0_wp
   end type pin_state_t

   !> Pieces of the tables, up to the film ratio at which asperities part; their error is below 1e-9 of the largest force
   integer, parameter :: pieces = 160
   !> A smallest film ratio of nothing, as e/sqrt(1 - e^2) [-]
   real(wp), parameter :: squeezed = 1.0e100_wp

   !> Loads at one eccentricity
   type :: balance_t
      !> Load over the one wanted, in logarithms, and its slopes over ln t and over the logarithm of viscosity times spin [-]
      real(wp) :: excess = 0.0_wp, slope = 0.0_wp, by_speed = 0.0_wp
      !> Load of asperities along the line of centres, sum of their normal forces and its slope over ln t [N]
      real(wp) :: along = 0.0_wp, normal = 0.0_wp, normal_slope = 0.0_wp
      !> The film
      type(film_t) :: film
   end type balance_t

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

      type(touch_t) :: touch
      integer :: law

      call find_name("roller bearing law", given%law, journal_law_names, law, error)
      if (allocated(error)) return
      if (.not. min(radius, given%width, given%radial_clearance) > 0.0_wp) then
         call raise(error, kind_deck, "needle_bearing: kind 'journal' needs radius, width and clearance above zero")
      else if (.not. (any(given%law == pin_law_names) .and. law_covers_width(given%law, given%width, 2.0_wp*radius))) then
         call raise(error, kind_deck, "needle_bearing: "//width_advice)
      end if
      if (allocated(error)) return
      call new_touch(touch, bearing_asperity_t(given%roughness, given%modulus, coefficient, given%roughness_product, &
         & given%roughness_over_tip_radius), given%radial_clearance, error)
      if (allocated(error)) return
      part%journal = journal_at_speed(law, 2.0_wp*radius, given%width, given%radial_clearance, 1.0_wp, 1.0_wp)
      part%clearance = given%radial_clearance
      part%roughness = given%roughness
      part%coefficient = coefficient
      call tabulate_forces(part, touch, error)
   end subroutine new_pin_part

   !> Forces of the asperities over the smallest film ratio.
   subroutine tabulate_forces(part, touch, error)
      !> Gets the tables
      type(pin_part_t), intent(inout) :: part
      !> The surfaces
      type(touch_t), intent(in) :: touch
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      ! Step for the derivatives at the end [-]
      real(wp), parameter :: h = 2.0e-3_wp
      ! Film ratios [-], forces there, those near the end [N]; slopes and curvatures at both ends [N]
      real(wp) :: ratios(0:pieces), forces(2, 0:pieces), near(2, 0:4), start(2, 2)
      integer :: i

      do i = 0, pieces
         ratios(i) = largest_film_ratio*i/pieces
         call force_at(ratios(i), forces(:, i))
      end do
      do i = 0, 4
         call force_at(h*i, near(:, i))
      end do
      start(1, :) = matmul(near, [-25.0_wp, 48.0_wp, -36.0_wp, 16.0_wp, -3.0_wp])/(12.0_wp*h)
      start(2, :) = matmul(near, [35.0_wp, -104.0_wp, 114.0_wp, -56.0_wp, 11.0_wp])/(12.0_wp*h**2)
      call new_clamped_spline(part%along, ratios, forces(1, :), start(:, 1), [0.0_wp, 0.0_wp], 0.0_wp, error)
      if (allocated(error)) return
      call new_clamped_spline(part%normal, ratios, forces(2, :), start(:, 2), [0.0_wp, 0.0_wp], 0.0_wp, error)

   contains

      !> Forces at a film ratio.
      subroutine force_at(ratio, force)
         !> Smallest film over roughness [-]
         real(wp), intent(in) :: ratio
         !> Along the line of centres, sum of normal forces [N]
         real(wp), intent(out) :: force(2)

         ! 1 - e, e/sqrt(1 - e^2) [-]
         real(wp) :: gap, t

         gap = ratio*part%roughness/part%clearance
         t = squeezed
         if (gap > 0.0_wp) t = (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))
         call asperity_forces(part%journal, touch, t, force(1), force(2))
      end subroutine force_at

   end subroutine tabulate_forces

   !> Give the pin the oil.
   pure subroutine set_pin_oil(part, viscosity)
      !> The pin
      type(pin_part_t), intent(inout) :: part
      !> Viscosity [Pa s]
      real(wp), intent(in) :: viscosity

      part%viscosity = viscosity
   end subroutine set_pin_oil

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
      call balance_load(part, load, shear, t, balance)
      secant = sqrt(1.0_wp + t**2)
      state%eccentricity = t/secant
      state%film = part%clearance/(secant*(secant + t))
      state%asperity_share = balance%along/load
      associate (journal => part%journal, film => balance%film)
         sine = sin(film%angle)
         drag = journal%petroff_friction*journal%radius
         beside = 0.5_wp*part%clearance*journal%unit_load*film%number*state%eccentricity*sine
         rubbing = part%coefficient*journal%radius*balance%normal
         ! secant - 1 without cancellation
         whole = shear*(drag*t**2/(1.0_wp + secant) + beside) + rubbing
         slope = shear*(drag*t**2/secant + beside*(film%number_slope + 1.0_wp/secant**2) + 0.5_wp*part%clearance* &
            & journal%unit_load*film%number*state%eccentricity*cos(film%angle)*film%angle_slope) &
            & + part%coefficient*journal%radius*balance%normal_slope
      end associate
      state%torque = part_of_spin*whole
      state%by_load = part_of_spin*slope/balance%slope
      state%by_spin = part_of_spin**2/magnitude*(whole - rubbing - slope*balance%by_speed/balance%slope) &
         & + whole*(reversal_spin/magnitude)**2/magnitude
   end subroutine solve_pin

   !> Eccentricity at which film and asperities carry a load: both grow with it, and the film alone bounds it.
   pure subroutine balance_load(part, load, shear, t, balance)
      !> The pin
      type(pin_part_t), intent(in) :: part
      !> Load [N], viscosity times spin [Pa]
      real(wp), intent(in) :: load, shear
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(out) :: t
      !> Loads there
      type(balance_t), intent(out) :: balance

      ! A step whose square is rounding [-]
      real(wp), parameter :: last_step = 1.0e-9_wp
      ! Steps at most: bisection of the bracket to rounding
      integer, parameter :: most_steps = 60
      type(journal_t) :: journal
      ! 1 - e where the first asperities touch, logarithms of t, its bounds, step [-]
      real(wp) :: gap, place, low, high, step
      integer :: i, status
      logical :: is_last

      journal = part%journal
      journal%unit_load = shear*journal%unit_load
      call find_tangent(journal, load, t, status)
      balance = balance_t()
      if (status /= journal_solved .or. .not. t > 0.0_wp) return
      gap = largest_film_ratio*part%roughness/part%clearance
      place = log(t)
      call compare_loads(part, load, shear, t, balance)
      if (.not. balance%along > 0.0_wp) return
      low = min(log((1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))), place)
      high = place
      do i = 1, most_steps
         if (balance%excess > 0.0_wp) high = min(high, place)
         if (balance%excess < 0.0_wp) low = max(low, place)
         step = -balance%excess/balance%slope
         is_last = abs(step) <= last_step
         if (.not. (is_last .or. place + step > low .and. place + step < high)) step = 0.5_wp*(low + high) - place
         place = place + step
         t = exp(place)
         call compare_loads(part, load, shear, t, balance)
         if (is_last) return
      end do
   end subroutine balance_load

   !> Loads at one eccentricity.
   pure subroutine compare_loads(part, load, shear, t, balance)
      !> The pin
      type(pin_part_t), intent(in) :: part
      !> Load wanted [N], viscosity times spin [Pa]
      real(wp), intent(in) :: load, shear
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> The loads
      type(balance_t), intent(out) :: balance

      ! sqrt(1 + t^2), smallest film ratio, its slope over ln t [-]; attitude angle and its slope [rad]
      real(wp) :: secant, ratio, ratio_slope, angle, angle_slope
      ! Load of the film, components along the line of centres and across it, and their slopes over ln t [N]
      real(wp) :: film, along, across, along_slope, across_slope, values(0:3)
      integer :: status

      secant = sqrt(1.0_wp + t**2)
      ratio = part%clearance/part%roughness/(secant*(secant + t))
      ratio_slope = -part%clearance/part%roughness*t/secant**3
      balance%film = film_at(part%journal, t)
      ! The fit of finite width is a little beyond a right angle where the eccentricity is small; no film pulls
      angle = min(balance%film%angle, 0.5_wp*pi)
      angle_slope = merge(balance%film%angle_slope, 0.0_wp, balance%film%angle < 0.5_wp*pi)
      film = shear*part%journal%unit_load*balance%film%number
      call evaluate_spline(part%normal, ratio, values, status)
      balance%normal = max(values(0), 0.0_wp)
      balance%normal_slope = values(1)*ratio_slope
      call evaluate_spline(part%along, ratio, values, status)
      balance%along = max(values(0), 0.0_wp)
      across = film*sin(angle)
      along = film*cos(angle)
      along_slope = along*balance%film%number_slope - across*angle_slope + values(1)*ratio_slope
      across_slope = across*balance%film%number_slope + along*angle_slope
      balance%by_speed = (along*(along + balance%along) + across**2)/((along + balance%along)**2 + across**2)
      along = along + balance%along
      balance%slope = (along*along_slope + across*across_slope)/(along**2 + across**2)
      balance%excess = log(hypot(along, across)/load)
   end subroutine compare_loads

end module camroller_pin_film
