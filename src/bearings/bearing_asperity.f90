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
   use camroller_journal, only : journal_t, film_t, film_at, find_tangent, film_friction, journal_solved, journal_without_film
   use camroller_lapack, only : dgesv
   use camroller_quadrature, only : gauss_legendre
   implicit none
   private

   public :: bearing_asperity_t, bearing_touch_t, bearing_state_t, balance_t, new_touch, carry_load, balance_load, &
      & asperity_forces, tabulated_forces, clearance_is_enough, clearance_advice, thinnest_smooth_film

   !> Film over roughness below which the law of smooth surfaces lets the film carry what asperities would [-]
   real(wp), parameter :: thinnest_smooth_film = 0.5_wp

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
   !> Pieces of the tables, up to the film ratio at which asperities part, and terms of the polynomial in each: the error of a force
   !> is below 1e-11 of itself up to a film ratio of 7, and below 1e-12 of the largest force beyond, see its test
   integer, parameter :: pieces = 8, terms = 14

   !> Surfaces made ready
   type :: bearing_touch_t
      !> Roughness [m]
      real(wp) :: roughness = 0.0_wp
      !> Pressure of the asperities over F_5/2 [Pa]
      real(wp) :: pressure = 0.0_wp
      !> Friction coefficient of touching asperities [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Places and weights of the integral on (0, 1) [-]
      real(wp) :: places(points) = 0.0_wp, weights(points) = 0.0_wp
      !> Force along the line of centres and sum of the normal forces, over pressure, radius and width, by the smallest film
      !> ratio H: coefficients of the powers of the place in a piece, from -1 to 1, of force times exp(H^2/2), which hardly varies;
      !> shape (term, piece) [-]
      real(wp), dimension(terms, pieces) :: along = 0.0_wp, normal = 0.0_wp
   end type bearing_touch_t

   !> Film and asperities at one eccentricity
   type :: balance_t
      !> Load over the one wanted, in logarithms, and its slopes over ln t and over the logarithm of viscosity times speed [-]
      real(wp) :: excess = 0.0_wp, slope = 0.0_wp, by_speed = 0.0_wp
      !> Load of asperities along the line of centres, sum of their normal forces, and their slopes over ln t [N]
      real(wp) :: along = 0.0_wp, normal = 0.0_wp, along_slope = 0.0_wp, normal_slope = 0.0_wp
      !> The film
      type(film_t) :: film
   end type balance_t

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
      type(bearing_touch_t), intent(out) :: touch
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
      call tabulate_forces(touch, clearance)
   end subroutine new_touch

   !> Tables of the forces of asperities, from a bearing of one metre's radius and width: in each piece the polynomial through the
   !> forces at the zeros of Chebyshev's. The equations are the same for every bearing, and regular.
   pure subroutine tabulate_forces(touch, clearance)
      !> The surfaces; get the tables
      type(bearing_touch_t), intent(inout) :: touch
      !> Radial clearance [m]
      real(wp), intent(in) :: clearance

      type(journal_t) :: journal
      ! Places in a piece; their powers; forces there, then coefficients: along, then normal [-]
      real(wp) :: places(terms), powers(terms, terms), forces(terms, 2*pieces)
      ! Smallest film over roughness; 1 - e; e/sqrt(1 - e^2) [-]
      real(wp) :: ratio, gap, t
      integer :: i, piece, pivots(terms), info

      journal%radius = 1.0_wp
      journal%width_ratio = 0.5_wp
      journal%clearance_ratio = clearance
      places = cos(pi*([(i, i=1, terms)] - 0.5_wp)/terms)
      do i = 1, terms
         powers(:, i) = places**(i - 1)
      end do
      do piece = 1, pieces
         do i = 1, terms
            ratio = largest_film_ratio*(piece - 0.5_wp + 0.5_wp*places(i))/pieces
            gap = ratio*touch%roughness/clearance
            t = (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))
            call asperity_forces(journal, touch, t, forces(i, piece), forces(i, pieces + piece))
            forces(i, [piece, pieces + piece]) = forces(i, [piece, pieces + piece])*exp(0.5_wp*ratio**2)/touch%pressure
         end do
      end do
      call dgesv(terms, 2*pieces, powers, terms, pivots, forces, terms, info)
      touch%along = forces(:, :pieces)
      touch%normal = forces(:, pieces + 1:)
   end subroutine tabulate_forces

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
      type(bearing_touch_t), intent(in), optional :: touch

      type(balance_t) :: balance
      ! Whole load, that of the film [N]; t, e/sqrt(1 - e^2), and sqrt(1 + t^2) [-]
      real(wp) :: whole, by_film, t, secant

      state%load = load
      whole = norm2(load)
      by_film = whole
      call find_tangent(journal, whole, t, status)
      if (status /= journal_solved) return
      if (present(touch)) then
         if (t > first_touch(journal, touch)) then
            call balance_load(journal, touch, whole, t, balance, status)
            if (status /= journal_solved) return
            by_film = journal%unit_load*balance%film%number
            state%asperity_load = balance%along
            state%boundary_torque = touch%boundary_coefficient*balance%normal*journal%radius
         end if
      end if
      secant = sqrt(1.0_wp + t**2)
      state%eccentricity = t/secant
      state%film = clearance_of(journal)/(secant*(secant + t))
      state%torque = film_friction(journal, by_film, t)*journal%radius + state%boundary_torque
   end subroutine carry_load

   !> Eccentricity at which film and asperities carry a load, by Newton's method on logarithms inside a bracket: both grow with
   !> it, and the film alone bounds it. Where asperities begin to press, the slope changes so much that steps may go to and fro
   !> between both sides for ever: a step that is not below half of the one before the last is a bisection.
   pure subroutine balance_load(journal, touch, load, t, balance, status)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(bearing_touch_t), intent(in) :: touch
      !> Load [N]
      real(wp), intent(in) :: load
      !> e/sqrt(1 - e^2); in: that of the film alone, which stays where surfaces are apart [-]
      real(wp), intent(inout) :: t
      !> Loads there
      type(balance_t), intent(out) :: balance
      !> `journal_solved` or `journal_without_film`
      integer, intent(out) :: status

      ! A step whose square is rounding: loads rise with up to the thirtieth power [-]
      real(wp), parameter :: last_step = 1.0e-8_wp
      ! Room above the start for its rounding, far more than that [-]
      real(wp), parameter :: room = 0.1_wp
      ! Steps at most: a bisection of the bracket to the last step, with two steps that fall by half for each
      integer, parameter :: most_steps = 150
      ! Logarithms of t, its bounds, step, the sizes of the last two [-]
      real(wp) :: place, low, high, step, earlier(2)
      integer :: i

      status = journal_solved
      place = log(t)
      low = min(log(first_touch(journal, touch)), place)
      high = place + room
      earlier = huge(1.0_wp)
      call compare_loads(journal, touch, load, t, balance)
      if (.not. balance%along > 0.0_wp) return
      do i = 1, most_steps
         if (balance%excess > 0.0_wp) high = min(high, place)
         if (balance%excess < 0.0_wp) low = max(low, place)
         step = -balance%excess/balance%slope
         if (abs(step) <= last_step) then
            call take_last_step(step, t, balance)
            return
         end if
         if (abs(step) > 0.5_wp*earlier(2) .or. .not. (place + step > low .and. place + step < high)) then
            step = 0.5_wp*(low + high) - place
         end if
         earlier = [abs(step), earlier(1)]
         place = place + step
         t = exp(place)
         call compare_loads(journal, touch, load, t, balance)
      end do
      status = journal_without_film
   end subroutine balance_load

   !> Carry loads on by a step that is so short that slopes say all about it.
   pure subroutine take_last_step(step, t, balance)
      !> Change of ln t [-]
      real(wp), intent(in) :: step
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(inout) :: t
      !> Loads there
      type(balance_t), intent(inout) :: balance

      t = t*(1.0_wp + step)
      balance%film%number = balance%film%number*(1.0_wp + balance%film%number_slope*step)
      balance%film%angle = balance%film%angle + balance%film%angle_slope*step
      balance%along = balance%along + balance%along_slope*step
      balance%normal = balance%normal + balance%normal_slope*step
   end subroutine take_last_step

   !> Loads at one eccentricity.
   pure subroutine compare_loads(journal, touch, load, t, balance)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(bearing_touch_t), intent(in) :: touch
      !> Load wanted [N]
      real(wp), intent(in) :: load
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> The loads
      type(balance_t), intent(out) :: balance

      ! Attitude angle and its slope over ln t [rad]
      real(wp) :: angle, angle_slope
      ! Load of the film, components along the line of centres and across it, and slopes over ln t [N]
      real(wp) :: film, along, across, along_slope, across_slope

      balance%film = film_at(journal, t)
      ! The fit of finite width is a little beyond a right angle where the eccentricity is small; no film pulls
      angle = min(balance%film%angle, 0.5_wp*pi)
      angle_slope = merge(balance%film%angle_slope, 0.0_wp, balance%film%angle < 0.5_wp*pi)
      film = journal%unit_load*balance%film%number
      call tabulated_forces(journal, touch, t, balance%along, balance%normal, balance%along_slope, balance%normal_slope)
      across = film*sin(angle)
      along = film*cos(angle)
      along_slope = along*balance%film%number_slope - across*angle_slope + balance%along_slope
      across_slope = across*balance%film%number_slope + along*angle_slope
      balance%by_speed = (along*(along + balance%along) + across**2)/((along + balance%along)**2 + across**2)
      along = along + balance%along
      balance%slope = (along*along_slope + across*across_slope)/(along**2 + across**2)
      balance%excess = 0.5_wp*log((along**2 + across**2)/load**2)
   end subroutine compare_loads

   !> Eccentricity at which the first asperities touch, as `t = e/sqrt(1 - e^2)`.
   pure function first_touch(journal, touch) result(t)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(bearing_touch_t), intent(in) :: touch
      !> t [-]
      real(wp) :: t

      !> 1 - e [-]
      real(wp) :: gap

      gap = largest_film_ratio*touch%roughness/clearance_of(journal)
      t = (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))
   end function first_touch

   !> Forces of the asperities of a bearing by the tables, with their slopes over ln t.
   pure subroutine tabulated_forces(journal, touch, t, along, normal, along_slope, normal_slope)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(bearing_touch_t), intent(in) :: touch
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> Force along the line of centres, sum of the normal forces, their slopes [N]
      real(wp), intent(out) :: along, normal, along_slope, normal_slope

      ! sqrt(1 + t^2), clearance over roughness, smallest film ratio, its slope over ln t; place in its piece;
      ! exp(-H^2/2) [-]; scale [N]
      real(wp) :: secant, wide, ratio, ratio_slope, place, decay, scale
      ! Forces times exp(H^2/2), and their slopes over the place [-]
      real(wp) :: values(2), slopes(2)
      integer :: piece, i

      along = 0.0_wp
      normal = 0.0_wp
      along_slope = 0.0_wp
      normal_slope = 0.0_wp
      secant = sqrt(1.0_wp + t**2)
      wide = clearance_of(journal)/touch%roughness
      ratio = wide/(secant*(secant + t))
      if (.not. ratio < largest_film_ratio) return
      ratio_slope = -wide*t/secant**3
      place = ratio*pieces/largest_film_ratio
      piece = min(int(place) + 1, pieces)
      place = 2.0_wp*(place - piece) + 1.0_wp
      values = [touch%along(terms, piece), touch%normal(terms, piece)]
      slopes = 0.0_wp
      do i = terms - 1, 1, -1
         slopes = slopes*place + values
         values = values*place + [touch%along(i, piece), touch%normal(i, piece)]
      end do
      decay = exp(-0.5_wp*ratio**2)
      scale = touch%pressure*2.0_wp*journal%radius**2*journal%width_ratio*decay
      along = scale*values(1)
      normal = scale*values(2)
      along_slope = scale*(slopes(1)*2.0_wp*pieces/largest_film_ratio - ratio*values(1))*ratio_slope
      normal_slope = scale*(slopes(2)*2.0_wp*pieces/largest_film_ratio - ratio*values(2))*ratio_slope
   end subroutine tabulated_forces

   !> Forces of the asperities of a bearing, by Gauss' rule over the part of it where they touch.
   pure subroutine asperity_forces(journal, touch, t, along, normal)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Its surfaces
      type(bearing_touch_t), intent(in) :: touch
      !> e/sqrt(1 - e^2) [-]
      real(wp), intent(in) :: t
      !> Force along the line of centres, sum of the normal forces [N]
      real(wp), intent(out) :: along, normal

      !> Clearance [m]; e, smallest film over clearance, sine of half the angle where contact ends [-]
      real(wp) :: clearance, eccentricity, gap, sine
      !> Angle where contact ends [rad]
      real(wp) :: last
      !> Angles from the thinnest place [rad]; film over roughness, F_5/2 there, its slope [-]
      real(wp), dimension(points) :: angles, ratios, integrals, slopes

      along = 0.0_wp
      normal = 0.0_wp
      clearance = clearance_of(journal)
      eccentricity = t/sqrt(1.0_wp + t**2)
      gap = 1.0_wp/(sqrt(1.0_wp + t**2)*(sqrt(1.0_wp + t**2) + t))
      ! Before the quotient: a journal on its orbit may be in the middle
      if (.not. largest_film_ratio*touch%roughness/clearance > gap) return
      sine = (largest_film_ratio*touch%roughness/clearance - gap)/(2.0_wp*eccentricity)
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
