!> Mixed friction in the bearings of a camshaft: asperities that share the load where the film is thin.
!>
!> In: a bearing at a speed, roughness and stiffness of its surfaces, load vector. Out: state of the bearing, with the part of the
!> load and of the torque that is due to asperities.
!>
!> The asperities of Greenwood and Tripp (1970) press over the film `h = c (1 - e cos psi)` of a rigid journal, psi from the
!> thinnest place:
!>
!>     W_a = L r int p_a(h) cos psi dpsi            along the line of centres
!>     W   = |W_f (cos A, sin A) + (W_a, 0)|        with the film's load W_f and its attitude angle A at the same eccentricity
!>     M_b = mu r L r int p_a(h) dpsi               boundary friction of the normal forces
!>
!> Friction of film and asperities is left out of the balance of forces, as it is without asperities. Without contact the
!> bearing is, bit for bit, that of its law.
module camroller_bearing_asperity
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_asperity, only : load_factor
   use camroller_greenwood_tripp, only : integral_5_2, largest_film_ratio
   use camroller_journal, only : journal_t, find_tangent, load_at, film_friction, film_direction, journal_solved, &
      & journal_without_film
   use camroller_quadrature, only : gauss_legendre
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_found, root_wanted
   implicit none
   private

   public :: bearing_asperity_t, touch_t, bearing_state_t, new_touch, carry_load, asperity_forces, clearance_is_enough, &
      & clearance_advice

   !> What a case says about the surfaces of its camshaft bearings
   type :: bearing_asperity_t
      !> Root mean square roughness of journal and bearing together [m]
      real(wp) :: roughness = 0.0_wp
      !> `2/[(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]` of journal and bearing [Pa]
      real(wp) :: modulus = 0.0_wp
      !> Friction coefficient of touching asperities [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Density times tip radius times roughness of asperities [-]
      real(wp) :: roughness_product = 0.04_wp
      !> Roughness over tip radius [-]
      real(wp) :: roughness_over_tip_radius = 0.01_wp
   end type bearing_asperity_t

   !> Points of the integral over the contact; the error is below 1e-11 of the integral, see its test
   integer, parameter :: points = 24

   !> Surfaces made ready
   type :: touch_t
      !> Roughness [m]
      real(wp) :: roughness = 0.0_wp
      !> Pressure of the asperities over F_5/2 [Pa]
      real(wp) :: pressure = 0.0_wp
      !> Friction coefficient of touching asperities [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Places and weights of the integral on (0, 1) [-]
      real(wp) :: places(points) = 0.0_wp, weights(points) = 0.0_wp
   end type touch_t

   !> A bearing at one instant
   type :: bearing_state_t
      !> Force of the shaft on it, in the frame of the first follower [N]
      real(wp) :: load(2) = 0.0_wp
      !> Place of the journal on its orbit in that frame; zero where it has none [clearance]
      real(wp) :: place(2) = 0.0_wp
      !> Eccentricity over clearance [-], smallest film [m]
      real(wp) :: eccentricity = 0.0_wp, film = 0.0_wp
      !> Torque against the rotation, and the part of it that is boundary friction [N m]
      real(wp) :: torque = 0.0_wp, boundary_torque = 0.0_wp
      !> Part of the load that asperities carry along the line of centres [N]
      real(wp) :: asperity_load = 0.0_wp
      !> Oil that leaves it at its sides [m^3/s], mean temperature of its oil above that of the oil supplied [K]; zero without a
      !> balance of its heat
      real(wp) :: oil_flow = 0.0_wp, temperature_rise = 0.0_wp
   end type bearing_state_t

   !> What to say where asperities would touch all round
   character(len=*), parameter :: clearance_advice = "mixed friction needs a radial clearance above eight times the roughness "// &
      & "of the bearings; with less their asperities touch all round"

contains

   !> Make surfaces ready.
   subroutine new_touch(touch, surfaces, clearance, error)
      !> The surfaces
      type(touch_t), intent(out) :: touch
      !> What is given
      type(bearing_asperity_t), intent(in) :: surfaces
      !> Radial clearance [m]
      real(wp), intent(in) :: clearance
      !> Deck error: a number that is not positive, or too little clearance
      type(error_t), allocatable, intent(out) :: error

      if (.not. (min(surfaces%roughness, surfaces%modulus, surfaces%roughness_product, surfaces%roughness_over_tip_radius) &
         & > 0.0_wp .and. surfaces%boundary_coefficient >= 0.0_wp)) then
         call raise(error, kind_deck, "mixed friction of bearings needs roughness, modulus and constants of asperities "// &
            & "above zero, and no negative friction coefficient")
      else if (.not. clearance_is_enough(surfaces%roughness, clearance)) then
         call raise(error, kind_deck, clearance_advice)
      end if
      if (allocated(error)) return
      touch%roughness = surfaces%roughness
      touch%pressure = load_factor(surfaces%roughness_product, surfaces%roughness_over_tip_radius, surfaces%modulus)
      touch%boundary_coefficient = surfaces%boundary_coefficient
      call gauss_legendre(touch%places, touch%weights)
      touch%places = 0.5_wp*(1.0_wp + touch%places)
      touch%weights = 0.5_wp*touch%weights
   end subroutine new_touch

   !> Are the surfaces of a bearing apart where its journal is in the middle?
   pure function clearance_is_enough(roughness, clearance) result(answer)
      !> Roughness, radial clearance [m]
      real(wp), intent(in) :: roughness, clearance
      !> Are they?
      logical :: answer

      answer = clearance > largest_film_ratio*roughness
   end function clearance_is_enough

   !> State of a bearing under a load.
   pure subroutine carry_load(journal, load, state, status, touch)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Force of the shaft on it [N]
      real(wp), intent(in) :: load(2)
      !> Its state
      type(bearing_state_t), intent(out) :: state
      !> `journal_solved` or `journal_without_film`
      integer, intent(out) :: status
      !> Its surfaces; without them there is a film only
      type(touch_t), intent(in), optional :: touch

      !> Whole load, that of the film [N]; t, e/sqrt(1 - e^2), and sqrt(1 + t^2) [-]; sum of normal forces of asperities [N]
      real(wp) :: whole, by_film, t, secant, normal

      state%load = load
      whole = norm2(load)
      by_film = whole
      normal = 0.0_wp
      call find_tangent(journal, whole, t, status)
      if (status /= journal_solved) return
      if (present(touch)) then
         if (t > first_touch(journal, touch)) call share_bearing(journal, touch, whole, t, by_film, state%asperity_load, &
            & normal, status)
         if (status /= journal_solved) return
         state%boundary_torque = touch%boundary_coefficient*normal*journal%radius
      end if
      secant = sqrt(1.0_wp + t**2)
      state%eccentricity = t/secant
      state%film = clearance_of(journal)/(secant*(secant + t))
      state%torque = film_friction(journal, by_film, t)*journal%radius
      if (normal > 0.0_wp) state%torque = state%torque + state%boundary_torque
   end subroutine carry_load

   !> Share a load between film and asperities: both grow with the eccentricity, and the film alone bounds it.
   pure subroutine share_bearing(journal, touch, whole, t, by_film, along, normal, status)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(touch_t), intent(in) :: touch
      !> Load [N]
      real(wp), intent(in) :: whole
      !> In: e/sqrt(1 - e^2) that the film alone would have, with asperities in touch; out: with their load [-]
      real(wp), intent(inout) :: t
      !> Load of the film; of asperities, along the line of centres; sum of their normal forces [N]
      real(wp), intent(out) :: by_film, along, normal
      !> `journal_solved` or `journal_without_film`
      integer, intent(out) :: status

      type(bracket_t) :: bracket
      !> Logarithms of the ends, and of the load over that wanted there [-]
      real(wp) :: ends(2), excess(2)
      integer :: i

      ends = log([first_touch(journal, touch), t])
      do i = 1, 2
         call carried(ends(i), excess(i))
      end do
      ! No load is carried by asperities at the one, none is missing at the other, but for rounding
      excess = [min(excess(1), 0.0_wp), max(excess(2), 0.0_wp)]
      call start_bracket(bracket, ends(1), ends(2), excess(1), excess(2), 0.0_wp)
      do while (bracket%status == root_wanted)
         call carried(bracket%trial, excess(1))
         call narrow_bracket(bracket, excess(1))
      end do
      status = journal_without_film
      if (bracket%status /= root_found) return
      status = journal_solved
      t = exp(bracket%trial)
      by_film = load_at(journal, t)
      call asperity_forces(journal, touch, t, along, normal)

   contains

      !> Logarithm of the load carried over that wanted.
      pure subroutine carried(log_t, excess)
         !> Logarithm of t [-]
         real(wp), intent(in) :: log_t
         !> That of the loads' ratio [-]
         real(wp), intent(out) :: excess

         !> Loads [N], attitude angle [rad]
         real(wp) :: film, part, pressed, angle

         film = load_at(journal, exp(log_t))
         call asperity_forces(journal, touch, exp(log_t), part, pressed)
         ! The fit of finite width is a little beyond a right angle where the eccentricity is small; no film pulls
         angle = min(film_direction(journal, exp(log_t)), 0.5_wp*pi)
         excess = log(hypot(film*cos(angle) + part, film*sin(angle))/whole)
      end subroutine carried

   end subroutine share_bearing

   !> Eccentricity at which the first asperities touch, as `t = e/sqrt(1 - e^2)`.
   pure function first_touch(journal, touch) result(t)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(touch_t), intent(in) :: touch
      !> t [-]
      real(wp) :: t

      !> 1 - e [-]
      real(wp) :: gap

      gap = largest_film_ratio*touch%roughness/clearance_of(journal)
      t = (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))
   end function first_touch

   !> Forces of the asperities of a bearing, by Gauss' rule over the part of it where they touch.
   pure subroutine asperity_forces(journal, touch, t, along, normal)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(touch_t), intent(in) :: touch
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> Force along the line of centres, sum of the normal forces [N]
      real(wp), intent(out) :: along, normal

      !> Clearance [m]; e, smallest film over clearance, sine of half the angle where contact ends [-]
      real(wp) :: clearance, eccentricity, gap, sine
      !> Angle where contact ends [rad]
      real(wp) :: last
      !> Angles from the thinnest place [rad]; film over roughness, F_5/2 there and its slope [-]
      real(wp), dimension(points) :: angles, ratios, integrals, slopes

      along = 0.0_wp
      normal = 0.0_wp
      clearance = clearance_of(journal)
      eccentricity = t/sqrt(1.0_wp + t**2)
      gap = 1.0_wp/(sqrt(1.0_wp + t**2)*(sqrt(1.0_wp + t**2) + t))
      ! Before the quotient: a journal on its orbit may be in the middle
      if (.not. largest_film_ratio*touch%roughness/clearance > gap) return
      sine = (largest_film_ratio*touch%roughness/clearance - gap)/(2.0_wp*eccentricity)
      if (.not. sine > 0.0_wp) return
      last = 2.0_wp*asin(sqrt(min(sine, 1.0_wp)))
      angles = last*touch%places
      ratios = clearance/touch%roughness*(gap + 2.0_wp*eccentricity*sin(0.5_wp*angles)**2)
      call integral_5_2(ratios, integrals, slopes)
      ! Both halves of the contact; width times radius
      associate (scale => 2.0_wp*last*touch%pressure*2.0_wp*journal%radius**2*journal%width_ratio)
         along = scale*sum(touch%weights*integrals*cos(angles))
         normal = scale*sum(touch%weights*integrals)
      end associate
   end subroutine asperity_forces

   !> Radial clearance of a bearing.
   pure function clearance_of(journal) result(clearance)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> The clearance [m]
      real(wp) :: clearance

      clearance = journal%clearance_ratio*journal%radius
   end function clearance_of

end module camroller_bearing_asperity
