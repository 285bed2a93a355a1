!> Friction between cam and roller: shear of the film, boundary friction, rolling resistance.
!>
!> In: film, viscosity, load share, sliding speed. Out: forces, with their derivatives with respect to the sliding speed where
!> the roller equation needs them. Sources: Islam (2019) eqs. (33), (37)-(41); Eyring (1936) as in Johnson and Tevaarwerk (1977);
!> Goksem and Hargreaves (1978); Biboulet and Houpert (2010). The strip from rigid to elastic contacts: doc/theory.md, section 10.
module camroller_traction
   use camroller_kinds, only : wp, pi
   use camroller_names, only : name_length
   use camroller_contact_rule, only : rule_heights, rule_weights
   use camroller_lubricant, only : oil_t, log_relative_viscosity, mean_relative_viscosity, relative_viscosity
   implicit none
   private

   public :: traction_t, shear_law_names, zone_names, limit_names, cap_names, rolling_law_names
   public :: film_pressure, newtonian_shear, eyring_shear, blunt_shear, limit_shear, mobilised_share, sliding_direction, &
      & rolling_resistance, resistance_speed_slope, resistance_length_slope, line_lengths_t, same_lengths, strip_t, &
      & sheared_strip, dry_shear_ratio
   public :: law_newtonian, law_eyring, zone_rigid_to_elastic, limit_local, cap_smooth, cap_sharp, rolling_biboulet_houpert, &
      & rolling_goksem_hargreaves, rolling_none

   !> Shear of the film
   character(len=*), parameter :: shear_law_names(*) = [character(len=name_length) :: "newtonian", "eyring"]
   !> Strip of the film that is sheared: that of the dry contact with its pressure, or one from rigid to elastic contacts
   character(len=*), parameter :: zone_names(*) = [character(len=name_length) :: "hertz", "rigid_to_elastic"]
   !> What is limited: the traction of all of the film, or the stress at each point of it
   character(len=*), parameter :: limit_names(*) = [character(len=name_length) :: "mean", "local"]
   !> How the limiting traction is approached
   character(len=*), parameter :: cap_names(*) = [character(len=name_length) :: "smooth", "sharp"]
   !> Rolling resistance
   character(len=*), parameter :: rolling_law_names(*) = [character(len=name_length) :: &
      "biboulet_houpert", "goksem_hargreaves", "none"]
   !> Positions in the lists of names
   integer, parameter :: law_newtonian = 1, law_eyring = 2, zone_rigid_to_elastic = 2, limit_local = 2, cap_smooth = 1, &
      & cap_sharp = 2, rolling_biboulet_houpert = 1, rolling_goksem_hargreaves = 2, rolling_none = 3

   !> Friction of the film
   type :: traction_t
      !> One of `shear_law_names`
      character(len=name_length) :: shear_law = "newtonian"
      !> Eyring stress of the oil [Pa]; law `eyring`
      real(wp) :: eyring_stress = 0.0_wp
      !> Strip that is sheared: one of `zone_names`
      character(len=name_length) :: sheared_zone = "hertz"
      !> What is limited: one of `limit_names`
      character(len=name_length) :: limit = "mean"
      !> Limiting traction coefficient of the film, or rise of the limiting stress with the pressure [-]
      real(wp) :: limiting_coefficient = 0.08_wp
      !> Limiting stress without pressure; limit `local` [Pa]
      real(wp) :: limiting_stress = 0.0_wp
      !> One of `cap_names`
      character(len=name_length) :: cap = "smooth"
      !> One of `rolling_law_names`
      character(len=name_length) :: rolling_law = "biboulet_houpert"
      !> Does rolling resistance act on the roller's spin?
      logical :: in_roller_balance = .true.
   end type traction_t

   !> Lengths of the one line contact that stands for a roller whose load per length w is not the same all along it: of its mean
   !> weighted with the load, `W^2/int w^2 dy`; of its mean root, `(int sqrt(w) dy)^2/W`; of all that is loaded [m]. Or changes of
   !> their logarithms [-].
   type :: line_lengths_t
      !> The three [m]
      real(wp) :: mean = 0.0_wp, root = 0.0_wp, loaded = 0.0_wp
   end type line_lengths_t

   !> Strip of the film that is sheared
   type :: strip_t
      !> Width over that of the dry contact, pressure in the middle over that of the half ellipse on the latter [-]
      real(wp) :: width = 1.0_wp, pressure = 1.0_wp
      !> Derivatives of the logarithm of the width over those of the rigidity and of the film; of that of the pressure over those
      !> of the rigidity and of the pressure of the half ellipse [-]
      real(wp) :: width_by_rigidity = 0.0_wp, width_by_film = 0.0_wp, pressure_by_rigidity = 0.0_wp, pressure_by_peak = 0.0_wp
   end type strip_t

   !> Exponent of the load group in the law of Goksem and Hargreaves [-]
   real(wp), parameter :: load_exponent = 0.0126_wp

contains

   !> Pressure in the middle of the film, `(4/pi) (W - W_a)/(A_a - A_r)`: a half ellipse over the part of the contact that the
   !> asperities leave. Source: Islam (2019) eq. (37), shaped as (25).
   elemental function film_pressure(film_load, apparent_area, real_area) result(pressure)
      !> Load carried by the film, W - W_a [N]
      real(wp), intent(in) :: film_load
      !> Apparent contact area [m^2]
      real(wp), intent(in) :: apparent_area
      !> Real contact area of the asperities [m^2]
      real(wp), intent(in) :: real_area
      !> Pressure in the middle [Pa]
      real(wp) :: pressure

      pressure = 4.0_wp/pi*film_load/(apparent_area - real_area)
   end function film_pressure

   !> Strip of the film that is sheared, from rigid to elastic contacts.
   !>
   !> In a rigid contact of constant viscosity (Martin's film, Reynolds' exit) the shear is `2.01 sqrt(2 R h) eta V_s L/h`, that of
   !> a strip `2 sqrt(1.0144 2 R h)` wide, and the largest pressure that of a half ellipse `2 sqrt(1.0495 2 R h)` wide, with h =
   !> 4.895 eta u R L/W. Width and pressure go over to those of the dry contact by four constants fitted to contacts that were
   !> solved numerically (doc/theory.md, section 10, has the errors).
   pure subroutine sheared_strip(oil, peak, speed_group, load_group, film_load, film, strip)
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressure in the middle of the film as a half ellipse on the dry contact [Pa]
      real(wp), intent(in) :: peak
      !> U, W/(E' R L), the film's part of that, central film over radius [-]
      real(wp), intent(in) :: speed_group, load_group, film_load, film
      !> The strip
      type(strip_t), intent(out) :: strip

      ! (b_p/b)^2 - 1 of the rigid contact is this times U/(W*^2), 2.0990 4.895 pi/8; (b_s/b)^2 - 1 this times film over W* [-]
      real(wp), parameter :: rigid_pressure = 4.0347_wp, rigid_width = 1.0144_wp*pi/4.0_wp
      ! Part that lets the pressure rise, ln(viscosity ratio) from which on it rises further and its power; rigidity of M = 2.3 [-]
      real(wp), parameter :: part = 0.62_wp, thick = 4.2_wp, power = 4.2_wp, fade = rigid_pressure/(2.0_wp*2.3_wp**2)
      ! (b_p/b)^2 - 1 of the rigid contact; ln(viscosity ratio) at its pressure, its derivative over ln(pressure) [-]
      real(wp) :: rigidity, thickening, by_pressure
      ! What viscosity takes from the rigidity and its logarithmic derivative over that pressure; what is left of it [-]
      real(wp) :: relief, relief_slope, rest
      ! (b_s/b)^2 - 1 of the strip [-]
      real(wp) :: excess
      ! d ln(viscosity ratio)/dp [1/Pa]
      real(wp) :: slope

      rigidity = rigid_pressure*speed_group/(load_group*max(film_load, tiny(1.0_wp)))
      call log_relative_viscosity(oil, peak/sqrt(1.0_wp + rigidity), thickening, slope)
      by_pressure = slope*peak/sqrt(1.0_wp + rigidity)
      relief = part**2 + (thickening/thick)**power
      relief_slope = power*(thickening/thick)**(power - 1.0_wp)*by_pressure/(thick*relief)
      rest = rigidity/(relief + rigidity)
      strip%pressure = sqrt(relief/(relief + rigidity))
      strip%pressure_by_rigidity = -0.5_wp*rest*(1.0_wp + 0.5_wp*relief_slope*rigidity/(1.0_wp + rigidity))
      strip%pressure_by_peak = 0.5_wp*rest*relief_slope
      excess = rigid_width*film/load_group*rigidity/(rigidity + fade)
      strip%width = sqrt(1.0_wp + excess)
      strip%width_by_film = 0.5_wp*excess/(1.0_wp + excess)
      strip%width_by_rigidity = strip%width_by_film*fade/(rigidity + fade)
   end subroutine sheared_strip

   !> Newtonian shear over the strip of the dry contact over that over the strip from rigid to elastic contacts, at the same film.
   pure function dry_shear_ratio(oil, peak, speed_group, load_group, film_load, film) result(ratio)
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressure in the middle of the film as a half ellipse on the dry contact [Pa]
      real(wp), intent(in) :: peak
      !> U, W/(E' R L), the film's part of that, central film over radius [-]
      real(wp), intent(in) :: speed_group, load_group, film_load, film
      !> The ratio [-]
      real(wp) :: ratio

      type(strip_t) :: strip
      ! Mean viscosity ratios over both strips, their logarithmic slopes [-]
      real(wp) :: means(2), slopes(2)

      call sheared_strip(oil, peak, speed_group, load_group, film_load, film, strip)
      call mean_relative_viscosity(oil, peak, means(1), slopes(1))
      call mean_relative_viscosity(oil, peak*strip%pressure, means(2), slopes(2))
      ratio = means(1)/(means(2)*strip%width)
   end function dry_shear_ratio

   !> Shear force of a Newtonian film, `V_s eta A/h_c`, before any limit. Source: Islam (2019) eq. (33).
   elemental function newtonian_shear(sliding_speed, viscosity, area, film) result(force)
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Viscosity, mean over the contact [Pa s]
      real(wp), intent(in) :: viscosity
      !> Apparent contact area, 2 b L [m^2]
      real(wp), intent(in) :: area
      !> Central film thickness [m], positive
      real(wp), intent(in) :: film
      !> Shear force [N]
      real(wp) :: force

      force = sliding_speed*viscosity*area/film
   end function newtonian_shear

   !> Shear force of an Eyring film, `int tau_E asinh(eta V_s/(h_c tau_E)) dA`, and its slopes.
   !>
   !> Quadrature as for the mean viscosity; as the stress tends to infinity the force tends to the Newtonian one.
   pure subroutine eyring_shear(sliding_speed, oil, peak, area, film, eyring_stress, force, slope, peak_slope)
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressure in the middle of the film [Pa]
      real(wp), intent(in) :: peak
      !> Apparent contact area, 2 b L [m^2]
      real(wp), intent(in) :: area
      !> Central film thickness [m], positive
      real(wp), intent(in) :: film
      !> Eyring stress, tau_E [Pa]
      real(wp), intent(in) :: eyring_stress
      !> Shear force [N]
      real(wp), intent(out) :: force
      !> d force/d sliding speed at constant film and pressure [N s/m]
      real(wp), intent(out) :: slope
      !> d force/d ln(peak) at constant film [N]
      real(wp), intent(out) :: peak_slope

      ! eta/(h_c tau_E) at the points of the rule; slopes of asinh over the sliding speed, weighted [s/m]
      real(wp), dimension(size(rule_heights)) :: rates, bends
      ! Viscosity ratios there, their logarithmic slopes; sizes of the arguments of asinh, their asinh and hypot(1, they) [-]
      real(wp), dimension(size(rule_heights)) :: ratios, log_slopes, x, stresses, roots

      call relative_viscosity(oil, peak*rule_heights, ratios, log_slopes)
      rates = oil%viscosity/(film*eyring_stress)*ratios
      x = abs(rates*sliding_speed)
      call stresses_and_roots(x, stresses, roots)
      bends = rule_weights*rates/roots
      force = sign(sum(rule_weights*stresses)*area*eyring_stress, sliding_speed)
      slope = sum(bends)*area*eyring_stress
      peak_slope = sum(bends*log_slopes)*sliding_speed*area*eyring_stress
   end subroutine eyring_shear

   !> asinh(x) and sqrt(1 + x^2), both to round-off, at the cost of one root and one logarithm each. No branch depends on one x, so
   !> that compilers can take several at once.
   pure subroutine stresses_and_roots(x, stresses, roots)
      !> Arguments, not negative [-]
      real(wp), contiguous, intent(in) :: x(:)
      !> asinh(x), sqrt(1 + x^2) [-]
      real(wp), contiguous, intent(out) :: stresses(:), roots(:)

      ! Argument from which on x + sqrt(1 + x^2) is 2 x to round-off [-]
      real(wp), parameter :: large = 1.0e9_wp
      ! exp(asinh(x)) - 1, and 1 more as it is rounded [-]
      real(wp) :: excess, rounded
      ! x, up to `large` [-]
      real(wp) :: held
      integer :: i

      do i = 1, size(x)
         held = min(x(i), large)
         roots(i) = sqrt(1.0_wp + held**2)
         excess = held + held**2/(1.0_wp + roots(i))
         rounded = 1.0_wp + excess
         ! ln(1 + e) as ln(r) + (e - (r - 1))/r, in which the rounding of r = 1 + e cancels to its square
         stresses(i) = log(rounded) + (excess - (rounded - 1.0_wp))/rounded
      end do
      if (all(x <= large)) return
      where (x > large)
         roots = x
         stresses = log(x) + log(2.0_wp)
      end where
   end subroutine stresses_and_roots

   !> Shear in series with a slip that is not resolved: the sliding speed that a force needs grows by at most about `resolution`.
   !>
   !> `1/F = 1/F_free + resolution/(limit V_s)`. Without it the traction of a film that pressure has made solid jumps from one limit
   !> to the other at a sliding speed of zero, which no step of an integration ever meets.
   elemental subroutine blunt_shear(sliding_speed, resolution, limit, slope, force, force_slope, limit_slope, speed_slope)
      !> Sliding speed, V_s, and the difference of it that need not be resolved, positive [m/s]
      real(wp), intent(in) :: sliding_speed, resolution
      !> Limiting force, mu_lim W [N], positive
      real(wp), intent(in) :: limit
      !> d force/d sliding speed before [N s/m]
      real(wp), intent(in) :: slope
      !> Shear force, in and out [N]
      real(wp), intent(inout) :: force
      !> Derivatives of the force over the force before and over the limit [-], and over the sliding speed with both kept [N s/m]
      real(wp), intent(out) :: force_slope, limit_slope, speed_slope

      ! Force over sliding speed [N s/m]; slip not resolved over that of the film, parts of both in their sum [-]
      real(wp) :: secant, ratio, film_part, slip_part

      secant = slope
      if (abs(sliding_speed) > 0.0_wp) secant = force/sliding_speed
      ratio = resolution*secant/limit
      film_part = 1.0_wp/(1.0_wp + ratio)
      slip_part = ratio*film_part
      force = force*film_part
      force_slope = film_part**2
      limit_slope = force*slip_part/limit
      speed_slope = secant*film_part*slip_part
   end subroutine blunt_shear

   !> Limit a shear force to a limiting traction: sharply, or smoothly as `limit tanh(force/limit)`.
   elemental subroutine limit_shear(cap, limit, force, force_slope, limit_slope)
      !> Position in `cap_names`
      integer, intent(in) :: cap
      !> Limiting force, mu_lim W [N], positive
      real(wp), intent(in) :: limit
      !> Shear force, in and out [N]
      real(wp), intent(inout) :: force
      !> d(limited force)/d(force) [-]
      real(wp), intent(out) :: force_slope
      !> d(limited force)/d(limit) [-]
      real(wp), intent(out) :: limit_slope

      ! tanh(force/limit), force over limit [-]
      real(wp) :: part, load_factor

      force_slope = 1.0_wp
      limit_slope = 0.0_wp
      if (cap == cap_smooth) then
         load_factor = force/limit
         part = tanh(load_factor)
         force = limit*part
         force_slope = (1.0_wp - part)*(1.0_wp + part)
         limit_slope = part - load_factor*force_slope
      else if (abs(force) > limit) then
         limit_slope = sign(1.0_wp, force)
         force = limit*limit_slope
         force_slope = 0.0_wp
      end if
   end subroutine limit_shear

   !> Part of the boundary friction that the slip mobilises, `tanh(V_s/v_b)`, with its sign.
   elemental function mobilised_share(sliding_speed, mobilising_speed) result(share)
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Mobilising speed, v_b [m/s], positive
      real(wp), intent(in) :: mobilising_speed
      !> Part between -1 and 1 [-]
      real(wp) :: share

      share = tanh(sliding_speed/mobilising_speed)
   end function mobilised_share

   !> The same in the limit of no mobilising speed: the sign of the sliding speed; zero at rest, where any part may be mobilised.
   elemental function sliding_direction(sliding_speed) result(direction)
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> -1, 0 or 1 [-]
      real(wp) :: direction

      direction = 0.0_wp
      if (abs(sliding_speed) > 0.0_wp) direction = sign(1.0_wp, sliding_speed)
   end function sliding_direction

   !> Rolling resistance of each surface, its size, and its logarithmic slope over the load; zero at standstill or without load.
   !>
   !> Goksem and Hargreaves (1978), elastic regime: `F_r = 4.318 (G U)^0.658 W*^0.0126 L R/alpha`; Islam (2019) eq. (39).
   !> Biboulet and Houpert (2010), doi 10.1243/13506501JET790, rigid to elastic: with U2 = 2 U and M2 = W*/sqrt(U2),
   !> `F_r/(E' R L) = W*^1.5 T`, `T = 1.4/M2 / (1 + ((1.4/1.45) sqrt(M2))^10)^0.1`.
   !>
   !> Where the load differs along the roller, what its parts resist is added up in each regime: with the root of the load in the
   !> rigid one, whatever the load in the elastic one; Goksem and Hargreaves' law, nearly so, counts as elastic.
   elemental subroutine rolling_resistance(law, speed_group, load_group, modulus, radius, lengths, pressure_viscosity, force, &
      & log_slope)
      !> Position in `rolling_law_names`
      integer, intent(in) :: law
      !> U [-]
      real(wp), intent(in) :: speed_group
      !> W/(E' R L): with the whole load for Goksem and Hargreaves, with the film's load for Biboulet and Houpert [-]
      real(wp), intent(in) :: load_group
      !> E' [Pa]
      real(wp), intent(in) :: modulus
      !> Equivalent radius, R [m]
      real(wp), intent(in) :: radius
      !> Lengths of the contact; the load group is that of L = `lengths%mean` [m]
      type(line_lengths_t), intent(in) :: lengths
      !> Pressure-viscosity coefficient, alpha [1/Pa]
      real(wp), intent(in) :: pressure_viscosity
      !> Rolling resistance [N]
      real(wp), intent(out) :: force
      !> d ln(force)/d ln(load group) [-]
      real(wp), intent(out) :: log_slope

      ! sqrt(2 U); lengths of both regimes over that of the load group [-]
      real(wp) :: root, rigid, elastic
      ! M2 (1.4/1.45)^2; its power 5 or -5, the smaller of both, then what it multiplies the force by [-]
      real(wp) :: regime, blend
      ! Blend whose fourth power is round-off [-]
      real(wp), parameter :: small_blend = 1.0e-4_wp

      force = 0.0_wp
      log_slope = 0.0_wp
      if (speed_group <= 0.0_wp .or. load_group <= 0.0_wp) return
      rigid = lengths%root/lengths%mean
      elastic = lengths%loaded/lengths%mean
      select case (law)
      case (rolling_goksem_hargreaves)
         force = 4.318_wp*(pressure_viscosity*modulus*speed_group)**0.658_wp*(load_group/elastic)**load_exponent &
            & *lengths%loaded*radius/pressure_viscosity
         log_slope = load_exponent
      case (rolling_biboulet_houpert)
         root = sqrt(2.0_wp*speed_group)
         regime = load_group/root*(1.4_wp/1.45_wp)**2*(rigid/elastic**2)
         if (regime < 1.0_wp) then
            blend = regime**5
            force = 1.4_wp*sqrt(load_group*rigid)*root
            log_slope = 0.5_wp/(1.0_wp + blend)
         else
            blend = (1.0_wp/regime)**5
            force = 1.45_wp*root*sqrt(root)*elastic
            log_slope = 0.5_wp*blend/(1.0_wp + blend)
         end if
         if (blend < small_blend) then
            ! the first terms of the series, exact there
            blend = 1.0_wp - 0.1_wp*blend*(1.0_wp - 0.55_wp*blend*(1.0_wp - 0.7_wp*blend))
         else
            blend = (1.0_wp + blend)**(-0.1_wp)
         end if
         force = force*blend*modulus*radius*lengths%mean
      end select
   end subroutine rolling_resistance

   !> The same lengths for a load that is the same all along the contact.
   elemental function same_lengths(length) result(lengths)
      !> Length of the contact [m]
      real(wp), intent(in) :: length
      !> The lengths [m]
      type(line_lengths_t) :: lengths

      lengths = line_lengths_t(length, length, length)
   end function same_lengths

   !> Change of the rolling resistance, its logarithm, with the lengths of the contact at the same load group.
   elemental function resistance_length_slope(law, load_slope, change) result(slope)
      !> Position in `rolling_law_names`
      integer, intent(in) :: law
      !> d ln(force)/d ln(load group) [-]
      real(wp), intent(in) :: load_slope
      !> Changes of the lengths, their logarithms [-]
      type(line_lengths_t), intent(in) :: change
      !> The change [-]
      real(wp) :: slope

      slope = load_slope*change%mean + (1.0_wp - load_slope)*change%loaded
      if (law == rolling_biboulet_houpert) slope = slope + load_slope*(change%root - change%loaded)
   end function resistance_length_slope

   !> Logarithmic slope of the rolling resistance over the speed group, from the one over the load group.
   !>
   !> The law of Biboulet and Houpert is a power 3/2 of load and sqrt(2 U) together.
   elemental function resistance_speed_slope(law, load_slope) result(slope)
      !> Position in `rolling_law_names`
      integer, intent(in) :: law
      !> d ln(force)/d ln(load group) [-]
      real(wp), intent(in) :: load_slope
      !> d ln(force)/d ln(U) [-]
      real(wp) :: slope

      select case (law)
      case (rolling_goksem_hargreaves)
         slope = 0.658_wp
      case (rolling_biboulet_houpert)
         slope = 0.5_wp*(1.5_wp - load_slope)
      case default
         slope = 0.0_wp
      end select
   end function resistance_speed_slope

end module camroller_traction
