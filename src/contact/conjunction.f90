!> Temperature in the contact: rise of both surfaces and of the film between them, and the shear of a film that is warmer than the
!> oil around.
!>
!> In: heat made, speeds of the contact over both bodies, their constants. Out: rise per heat flux; viscosity and shear at a rise,
!> with slopes. Heat enters each body through a band that moves over a half space; it is shared so that both have the same mean
!> rise. Sources: Jaeger, J. Proc. Royal Society of New South Wales 76 (1942) 203, the moving band; Blok (1937), shared heat;
!> Archard, Wear 2 (1959) 438, the film.
module camroller_conjunction
   use camroller_kinds, only : wp, pi
   use camroller_bessel, only : scaled_bessel_k, euler_constant
   use camroller_contact_rule, only : rule_heights, rule_weights
   use camroller_lubricant, only : oil_t, mean_relative_viscosity, relative_viscosity, law_roelands
   use camroller_traction, only : newtonian_shear, law_newtonian
   implicit none
   private

   public :: hot_oil_t, body_t, band_t, sheared_film_t, film_shear_t, band_mean, new_band, flash_resistance, film_resistance, &
      & line_integral, log_viscosity_change, warm_oil, viscosity_by_rise, hot_shear
   public :: film_part, least_log

   !> How the oil follows the temperature from that of the oil around on
   type :: hot_oil_t
      !> Fall of ln(viscosity) per kelvin there [1/K]
      real(wp) :: coefficient = 0.0_wp
      !> One over the distance from the pole of Vogel's law; zero: the viscosity falls exponentially [1/K]
      real(wp) :: bend = 0.0_wp
      !> Fall of ln(pressure-viscosity coefficient) per kelvin; Roelands' law has its own [1/K]
      real(wp) :: pressure_fall = 0.0_wp
   end type hot_oil_t

   !> One of both bodies
   type :: body_t
      !> Thermal conductivity [W/(m K)]
      real(wp) :: conductivity = 0.0_wp
      !> Thermal diffusivity [m^2/s]
      real(wp) :: diffusivity = 0.0_wp
   end type body_t

   !> Mean rise over a band between Peclet numbers, evenly on a logarithmic scale, by cubics with its slopes: to 1e-6
   type :: band_t
      !> ln(mean rise over q b/k), its derivative over ln(V b/kappa) [-]
      real(wp), allocatable :: values(:), slopes(:)
   end type band_t

   !> A film between surfaces that slide
   type :: sheared_film_t
      !> Position in `shear_law_names`
      integer :: law
      !> Sliding speed, V_s [m/s]
      real(wp) :: sliding_speed
      !> Pressure in the middle of the film [Pa]
      real(wp) :: peak
      !> Apparent contact area, 2 b L [m^2]
      real(wp) :: area
      !> Central film thickness, positive [m]
      real(wp) :: thickness
      !> Eyring stress, tau_E; of no meaning with a Newtonian film [Pa]
      real(wp) :: eyring_stress
   end type sheared_film_t

   !> Shear of a film, before any limit
   type :: film_shear_t
      !> Shear force [N]
      real(wp) :: force
      !> Its slopes over the sliding speed [N s/m], ln(peak) [N] and the rise of the temperature [N/K]
      real(wp) :: by_speed, by_peak, by_rise
   end type film_shear_t

   !> Mean rise of the film above surfaces of the same temperature, over flux, thickness and conductivity: heat made evenly across
   !> [-]
   real(wp), parameter :: film_part = 1.0_wp/12.0_wp
   !> Peclet number below which the closed form loses figures and its series is exact to 1e-10 [-]
   real(wp), parameter :: small_peclet = 3.0e-3_wp
   !> Least Peclet number, e^-14: a body at rest has no steady temperature under a line of heat, but then the other one takes all.
   !> The largest, e^18: beyond it the mean falls with the root of the speed [-]
   real(wp), parameter :: least_log = -14.0_wp, largest_log = 18.0_wp
   !> Distance of the numbers between, logarithmic [-], and how many intervals they make
   real(wp), parameter :: band_step = 0.25_wp
   integer, parameter :: intervals = nint((largest_log - least_log)/band_step)

contains

   !> Mean rise over a band of half width b with an even flux q on a half space that moves at the speed V, over `q b/k`.
   !>
   !> With `s = V b/kappa`: `(2/(pi s^2)) int_0^s (s - u) 2 cosh(u) K_0(u) du`, the mean of Jaeger's solution, whose integral is
   !> closed by `int e^u K_0 = u e^u (K_0 + K_1)` and `int e^u u K_1 = (u^2/3) e^u (K_1 + K_2)`. A fast band has two thirds of
   !> `1.1284 sqrt(2 b) q/sqrt(k rho c V)`, its largest rise.
   elemental subroutine band_mean(peclet, mean, log_slope)
      !> V b/kappa, positive [-]
      real(wp), intent(in) :: peclet
      !> Mean rise over q b/k [-]
      real(wp), intent(out) :: mean
      !> d ln(mean)/d ln(V b/kappa) [-]
      real(wp), intent(out) :: log_slope

      ! Functions K_0 and K_1 times e^s, e^(-2 s) [-]
      real(wp) :: zero, one, decay
      ! int_0^s 2 cosh(u) K_0(u) du, and int_0^s u 2 cosh(u) K_0(u) du; s times the first less the second; ln(s/2) + Euler's
      ! constant [-]
      real(wp) :: whole, moment, double, log_half

      associate (s => peclet)
         if (s < small_peclet) then
            log_half = log(0.5_wp*s) + euler_constant
            double = s**2*(1.5_wp - log_half + s**2*(11.0_wp/96.0_wp - 0.125_wp*log_half))
            whole = s*(2.0_wp*(1.0_wp - log_half) + s**2*(1.0_wp/3.0_wp - 0.5_wp*log_half))
         else
            call scaled_bessel_k(s, zero, one)
            decay = exp(-2.0_wp*s)
            whole = s*((zero + one) + decay*(zero - one))
            ! K_2 = K_0 + 2 K_1/s
            moment = 0.5_wp*(s*whole - s**2/3.0_wp*((one + zero) - decay*(one - zero) + 2.0_wp*one/s*(1.0_wp + decay)) &
               & + 4.0_wp/3.0_wp)
            double = s*whole - moment
         end if
         mean = 2.0_wp*double/(pi*s**2)
         log_slope = s*whole/double - 2.0_wp
      end associate
   end subroutine band_mean

   !> Integral of `e^u K_0(|u|)` up to u, up to a constant that is the same on both sides of zero: the rise by a band whose ends are
   !> at other distances is a difference of two.
   !>
   !> `u e^u (K_0(|u|) + sgn(u) K_1(|u|))`, one at zero. Source: Abramowitz and Stegun, 11.3.14 and 11.3.15.
   elemental function line_integral(u) result(value)
      !> Distance behind the source times V/(2 kappa); negative: ahead of it [-]
      real(wp), intent(in) :: u
      !> The integral [-]
      real(wp) :: value

      ! Distance ahead beyond which no heat arrives: e^(-2 u) is less than round-off of one [-]
      real(wp), parameter :: farthest = 18.5_wp
      ! Functions K_0 and K_1 times e^|u| [-]
      real(wp) :: zero, one

      value = 1.0_wp
      if (abs(u) < tiny(u)) return
      value = 0.0_wp
      if (u < -farthest) return
      call scaled_bessel_k(abs(u), zero, one)
      if (u > 0.0_wp) then
         value = u*(zero + one)
      else
         value = -u*exp(2.0_wp*u)*(one - zero)
      end if
   end function line_integral

   !> Work out the mean rise between Peclet numbers.
   pure subroutine new_band(band)
      !> Values and slopes
      type(band_t), intent(out) :: band

      ! Peclet number, mean rise over q b/k [-]
      real(wp) :: peclet, mean
      integer :: i

      allocate (band%values(0:intervals), band%slopes(0:intervals))
      do i = 0, intervals
         peclet = exp(least_log + i*band_step)
         call band_mean(peclet, mean, band%slopes(i))
         band%values(i) = log(mean)
      end do
   end subroutine new_band

   !> Mean rise over a band from the values between, as `band_mean` gives it.
   elemental subroutine find_in_band(band, peclet, mean, log_slope)
      !> Values and slopes
      type(band_t), intent(in) :: band
      !> V b/kappa [-]
      real(wp), intent(in) :: peclet
      !> Mean rise over q b/k [-]
      real(wp), intent(out) :: mean
      !> d ln(mean)/d ln(V b/kappa); zero where that is held at its least value [-]
      real(wp), intent(out) :: log_slope

      ! ln(V b/kappa), place in the interval, secant; second and third coefficient of the cubic [-]
      real(wp) :: place, x, secant, second, third
      integer :: i

      place = (log(max(peclet, tiny(peclet))) - least_log)/band_step
      if (place <= 0.0_wp) then
         mean = exp(band%values(0))
         log_slope = 0.0_wp
      else if (place >= intervals) then
         log_slope = -0.5_wp
         mean = exp(band%values(intervals) + log_slope*(place - intervals)*band_step)
      else
         i = int(place)
         x = place - i
         secant = (band%values(i + 1) - band%values(i))/band_step
         second = 3.0_wp*secant - 2.0_wp*band%slopes(i) - band%slopes(i + 1)
         third = band%slopes(i) + band%slopes(i + 1) - 2.0_wp*secant
         mean = exp(band%values(i) + band_step*x*(band%slopes(i) + x*(second + x*third)))
         log_slope = band%slopes(i) + x*(2.0_wp*second + 3.0_wp*x*third)
      end if
   end subroutine find_in_band

   !> Mean rise of both surfaces per heat flux into both together, and how it follows width and speeds.
   pure subroutine flash_resistance(band, bodies, half_width, speeds, resistance, by_width, by_speed)
      !> Mean rise over a band
      type(band_t), intent(in) :: band
      !> Both bodies
      type(body_t), intent(in) :: bodies(2)
      !> Half width of the contact, b [m]
      real(wp), intent(in) :: half_width
      !> Speed of the contact over each body [m/s]
      real(wp), intent(in) :: speeds(2)
      !> Rise per flux [m^2 K/W]
      real(wp), intent(out) :: resistance
      !> d ln(resistance)/d ln(half width) [-]
      real(wp), intent(out) :: by_width
      !> d ln(resistance)/d(speed) [s/m]
      real(wp), intent(out) :: by_speed(2)

      ! Rises over q b/k and their logarithmic slopes over the Peclet numbers [-]; rise of each body per flux [m^2 K/W]
      real(wp) :: mean(2), slope(2), each(2)

      call find_in_band(band, abs(speeds)*half_width/bodies%diffusivity, mean, slope)
      each = mean*half_width/bodies%conductivity
      resistance = each(1)*each(2)/(each(1) + each(2))
      by_width = sum(resistance/each*(1.0_wp + slope))
      by_speed = 0.0_wp
      where (abs(slope) > 0.0_wp) by_speed = resistance/each*slope/speeds
   end subroutine flash_resistance

   !> Mean rise of the film above its surfaces per heat flux made in it: `h/(12 k_oil)`.
   elemental function film_resistance(film, conductivity) result(resistance)
      !> Central film thickness [m]
      real(wp), intent(in) :: film
      !> Conductivity of the oil [W/(m K)]
      real(wp), intent(in) :: conductivity
      !> Rise per flux [m^2 K/W]
      real(wp) :: resistance

      resistance = film_part*film/conductivity
   end function film_resistance

   !> Change of ln(viscosity) at ambient pressure with a rise of the temperature: Vogel's law `b/(T - c)` from the oil around on.
   elemental subroutine log_viscosity_change(hot, rise, change, slope)
      !> The oil
      type(hot_oil_t), intent(in) :: hot
      !> Rise of the temperature [K], not negative
      real(wp), intent(in) :: rise
      !> Change of ln(viscosity) [-]
      real(wp), intent(out) :: change
      !> Its derivative [1/K]
      real(wp), intent(out) :: slope

      ! Factor of the distance from the pole [-]
      real(wp) :: distance

      distance = 1.0_wp + hot%bend*rise
      change = -hot%coefficient*rise/distance
      slope = -hot%coefficient/distance**2
   end subroutine log_viscosity_change

   !> Oil at a rise of the temperature.
   elemental subroutine warm_oil(hot, oil, rise, warm, change, change_slope)
      !> How the oil follows the temperature
      type(hot_oil_t), intent(in) :: hot
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> Rise of the temperature [K]
      real(wp), intent(in) :: rise
      !> Oil at that rise
      type(oil_t), intent(out) :: warm
      !> Change of ln(viscosity) at ambient pressure [-], its derivative over the rise [1/K]
      real(wp), intent(out) :: change, change_slope

      call log_viscosity_change(hot, rise, change, change_slope)
      warm = oil
      warm%viscosity = oil%viscosity*exp(change)
      warm%pressure_viscosity = oil%pressure_viscosity*exp(-hot%pressure_fall*rise)
      ! Roelands' law has no viscosity below that of its exponent 0
      warm%roelands_exponent = max(oil%roelands_exponent + change, 0.0_wp)
   end subroutine warm_oil

   !> Derivative of ln(viscosity) under pressure over the rise.
   elemental function viscosity_by_rise(hot, warm, change_slope, log_ratio, log_slope) result(by_rise)
      !> How the oil follows the temperature
      type(hot_oil_t), intent(in) :: hot
      !> Oil at its temperature
      type(oil_t), intent(in) :: warm
      !> Derivative of ln(viscosity) at ambient pressure over the rise [1/K]
      real(wp), intent(in) :: change_slope
      !> ln of the viscosity under pressure over that at ambient pressure; its derivative over ln(pressure) [-]
      real(wp), intent(in) :: log_ratio, log_slope
      !> The derivative [1/K]
      real(wp) :: by_rise

      by_rise = change_slope - hot%pressure_fall*log_slope
      ! Roelands: ln(eta/eta_r) is the exponent times a power of the pressure, so both grow by the same factor
      if (warm%pressure_law == law_roelands .and. log_slope > 0.0_wp) then
         by_rise = change_slope*(1.0_wp + log_ratio/warm%roelands_exponent)
      end if
   end function viscosity_by_rise

   !> Shear force of a film that is warmer than the oil around, by either shear law, before any limit, with its slopes.
   pure subroutine hot_shear(film, oil, hot, rise, shear)
      !> The film
      type(sheared_film_t), intent(in) :: film
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> How it follows the temperature
      type(hot_oil_t), intent(in) :: hot
      !> Mean rise of the film's temperature [K]
      real(wp), intent(in) :: rise
      !> Shear force and slopes
      type(film_shear_t), intent(out) :: shear

      type(oil_t) :: warm
      ! Change of ln(viscosity) at ambient pressure [-], its slope [1/K]; mean viscosity ratio, its logarithmic slope [-]
      real(wp) :: change, change_slope, ratio, log_slope

      call warm_oil(hot, oil, rise, warm, change, change_slope)
      if (film%law == law_newtonian .and. oil%pressure_law /= law_roelands) then
         call mean_relative_viscosity(warm, film%peak, ratio, log_slope)
         shear%by_speed = newtonian_shear(1.0_wp, warm%viscosity*ratio, film%area, film%thickness)
         shear%force = shear%by_speed*film%sliding_speed
         shear%by_peak = shear%force*log_slope
         shear%by_rise = shear%force*(change_slope - hot%pressure_fall*log_slope)
      else
         call sum_shear(film, warm, hot, change_slope, shear)
      end if
   end subroutine hot_shear

   !> The same by quadrature over the contact.
   pure subroutine sum_shear(film, warm, hot, change_slope, shear)
      type(sheared_film_t), intent(in) :: film
      !> Oil at the temperature of the film
      type(oil_t), intent(in) :: warm
      !> How the oil follows the temperature
      type(hot_oil_t), intent(in) :: hot
      !> Derivative of ln(viscosity) at ambient pressure over the rise [1/K]
      real(wp), intent(in) :: change_slope
      !> Shear force and slopes
      type(film_shear_t), intent(out) :: shear

      ! Viscosity over film thickness [Pa s/m], at a point; over the Eyring stress [s/m]; what the shear law makes of its slope [-]
      real(wp) :: unit, rate, reduced, bend
      ! Viscosity ratios at the points of the rule, their logarithmic slopes, logarithm of one where it is needed [-]; derivative of
      ! ln(viscosity) at a point over the rise [1/K]
      real(wp) :: ratios(size(rule_heights)), log_slopes(size(rule_heights)), log_ratio, by_rise
      ! Stress at a point [Pa]
      real(wp) :: stress
      integer :: i

      shear = film_shear_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      unit = warm%viscosity/film%thickness
      call relative_viscosity(warm, film%peak*rule_heights, ratios, log_slopes)
      do i = 1, size(rule_heights)
         log_ratio = 0.0_wp
         if (warm%pressure_law == law_roelands) log_ratio = log(ratios(i))
         by_rise = viscosity_by_rise(hot, warm, change_slope, log_ratio, log_slopes(i))
         rate = unit*ratios(i)
         stress = rate*film%sliding_speed
         bend = 1.0_wp
         if (film%law /= law_newtonian) then
            reduced = stress/film%eyring_stress
            stress = film%eyring_stress*asinh(reduced)
            bend = 1.0_wp/hypot(1.0_wp, reduced)
         end if
         rate = rule_weights(i)*bend*rate
         shear%force = shear%force + rule_weights(i)*stress
         shear%by_speed = shear%by_speed + rate
         shear%by_peak = shear%by_peak + rate*log_slopes(i)
         shear%by_rise = shear%by_rise + rate*by_rise
      end do
      shear%force = shear%force*film%area
      shear%by_speed = shear%by_speed*film%area
      shear%by_peak = shear%by_peak*film%area*film%sliding_speed
      shear%by_rise = shear%by_rise*film%area*film%sliding_speed
   end subroutine sum_shear

end module camroller_conjunction
