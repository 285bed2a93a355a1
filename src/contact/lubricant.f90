!> Oil: viscosity as a function of temperature and pressure.
!>
!> In: the oil's data from the deck. Out: viscosity at ambient pressure, pressure-viscosity coefficient, and the mean of the
!> viscosity over a Hertzian contact. Sources: Vogel (1921); Walther (1931) as in ASTM D341; Barus (1893); Chu and Cameron
!> (1962); Roelands (1966); So and Klaus (1980).
module camroller_lubricant
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_number_text, only : number_text
   use camroller_names, only : name_length, find_name, index_of_name
   use camroller_contact_rule, only : rule_heights, rule_weights
   use camroller_oil_points, only : coefficient_at, vogel_viscosity
   use camroller_oil_data, only : sae_grade_names, grade_viscosity, grade_index, viscosity_at_40, so_klaus_coefficient, &
      & smallest_indexed, smallest_estimated
   implicit none
   private

   public :: lubricant_t, oil_t, temperature_law_names, pressure_law_names, law_barus, law_cameron, law_roelands
   public :: law_direct, law_vogel, law_walther, law_data_sheet
   public :: get_oil, relative_viscosity, log_relative_viscosity, mean_relative_viscosity, density_at, pressure_limit
   public :: sheet_temperatures

   !> Viscosity over temperature
   character(len=*), parameter :: temperature_law_names(*) = [character(len=name_length) :: "direct", "vogel", "walther", &
      & "data_sheet"]
   !> Viscosity over pressure
   character(len=*), parameter :: pressure_law_names(*) = [character(len=name_length) :: "barus", "cameron", "roelands"]
   !> Positions in `pressure_law_names`
   integer, parameter :: law_barus = 1, law_cameron = 2, law_roelands = 3
   !> Positions in `temperature_law_names`
   integer, parameter :: law_direct = 1, law_vogel = 2, law_walther = 3, law_data_sheet = 4
   !> Temperatures of the viscosities on a data sheet [K]
   real(wp), parameter :: sheet_temperatures(2) = [313.15_wp, 373.15_wp]

   !> Reference pressure of Roelands' law [Pa]: 1/5.1e-9
   real(wp), parameter :: roelands_pressure = 1.0_wp/5.1e-9_wp
   !> ln of Roelands' reference viscosity, 6.315e-5 Pa s, with its sign changed [-]
   real(wp), parameter :: roelands_constant = 9.67_wp
   !> Temperature at which the density is given [K]
   real(wp), parameter :: density_temperature = 288.15_wp
   !> Walther's constant [mm^2/s]
   real(wp), parameter :: walther_constant = 0.7_wp
   !> Square metres per second in one square millimetre per second [-]
   real(wp), parameter :: square_millimetre = 1.0e-6_wp

   !> Oil: what is given about it
   type :: lubricant_t
      !> One of `temperature_law_names`
      character(len=name_length) :: temperature_law = "direct"
      !> Dynamic viscosity at ambient pressure at the oil temperature [Pa s]; law `direct`
      real(wp) :: viscosity = 0.0_wp
      !> Temperatures of the given points [K]; `vogel` three, `walther` two
      real(wp), allocatable :: temperature_points(:)
      !> Dynamic viscosities of the given points [Pa s]
      real(wp), allocatable :: viscosity_points(:)
      !> Kinematic viscosity at 40 and at 100 degC; zero where not given [m^2/s]; `data_sheet`
      real(wp) :: viscosity_at_40 = 0.0_wp, viscosity_at_100 = 0.0_wp
      !> Viscosity index; used where one viscosity is given [-]; `data_sheet`
      real(wp) :: viscosity_index = 0.0_wp
      !> One of `sae_grade_names`, in the place of viscosities; `data_sheet`
      character(len=name_length) :: sae_grade = "none"
      !> Viscosity at 150 degC and 1e6 1/s (HTHS) of the data sheet, compared with the law; zero where not given [Pa s]
      real(wp) :: hths_viscosity = 0.0_wp
      !> Density at 15 degC [kg/m^3]; `walther` and `data_sheet`
      real(wp) :: density = 870.0_wp
      !> Thermal expansion of the density [1/K]; `walther` and `data_sheet`
      real(wp) :: thermal_expansion = 6.5e-4_wp
      !> One of `pressure_law_names`
      character(len=name_length) :: pressure_law = "cameron"
      !> Pressure-viscosity coefficient at ambient pressure [1/Pa]; zero: derived from `roelands_index`, or without one estimated
      !> where the temperature law knows density and slope
      real(wp) :: pressure_viscosity = 0.0_wp
      !> The same at temperatures, in its place [1/Pa]; those temperatures, increasing [K]
      real(wp), allocatable :: pressure_viscosity_points(:), pressure_viscosity_temperatures(:)
      !> Roelands' index Z [-]; zero: derived from the pressure-viscosity coefficient
      real(wp) :: roelands_index = 0.0_wp
   end type lubricant_t

   !> Oil at one temperature
   type :: oil_t
      !> Viscosity at ambient pressure, eta0 [Pa s]
      real(wp) :: viscosity = 0.0_wp
      !> Pressure-viscosity coefficient at ambient pressure, alpha [1/Pa]
      real(wp) :: pressure_viscosity = 0.0_wp
      !> Position in `pressure_law_names`
      integer :: pressure_law = law_cameron
      !> Roelands' index, Z [-]
      real(wp) :: roelands_index = 0.0_wp
      !> ln(eta0/6.315e-5 Pa s), Roelands [-]
      real(wp) :: roelands_exponent = 0.0_wp
      !> Is the pressure-viscosity coefficient estimated by So and Klaus (1980)?
      logical :: is_estimated = .false.
   end type oil_t

   !> Exponent at which a viscosity ratio is held: far above any shear that a limiting traction lets through, below overflow [-]
   real(wp), parameter :: largest_exponent = 600.0_wp
   !> Power of Cameron's law [-]
   integer, parameter :: cameron_power = 16
   !> Its powers of the pressure [-]
   real(wp), parameter :: powers(0:cameron_power) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.0_wp, 8.0_wp, &
      & 9.0_wp, 10.0_wp, 11.0_wp, 12.0_wp, 13.0_wp, 14.0_wp, 15.0_wp, 16.0_wp]
   !> Coefficients of the polynomial in alpha p0 that Cameron's law integrates to: binomial(16, k)/16^k
   !> int_0^1 (1 - u^2)^(k/2) du, the integral being sqrt(pi)/2 Gamma(k/2 + 1)/Gamma(k/2 + 3/2) [-]
   real(wp), parameter :: cameron_coefficients(0:cameron_power) = &
      & gamma(17.0_wp)/(gamma(powers + 1.0_wp)*gamma(17.0_wp - powers))/16.0_wp**powers &
      & *0.5_wp*sqrt(pi)*gamma(0.5_wp*powers + 1.0_wp)/gamma(0.5_wp*powers + 1.5_wp)

   !> Pressure to which these laws hold, roughly, as theory section 6 has them; none for Roelands' [Pa]
   real(wp), parameter :: pressure_limits(*) = [1.0e8_wp, 1.0e9_wp, huge(1.0_wp)]

contains

   !> Pressure to which a lubricant's law of viscosity over pressure holds.
   pure function pressure_limit(lubricant) result(limit)
      !> The lubricant
      type(lubricant_t), intent(in) :: lubricant
      !> The pressure; infinite where none is known [Pa]
      real(wp) :: limit

      limit = pressure_limits(max(1, findloc(pressure_law_names, lubricant%pressure_law, 1)))
   end function pressure_limit

   !> Oil at a temperature: viscosity by the chosen law, and the constants of the pressure law.
   subroutine get_oil(lubricant, temperature, oil, error)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Temperature of the oil [K]
      real(wp), intent(in) :: temperature
      !> Oil at that temperature
      type(oil_t), intent(out) :: oil
      !> Deck error for an unknown law or missing data; domain error where the law has no value at this temperature
      type(error_t), allocatable, intent(out) :: error

      integer :: law
      ! Slope of Walther's law [-]; density at the temperature [kg/m^3]; both zero with other laws
      real(wp) :: slope, density

      call find_name("viscosity-temperature law", lubricant%temperature_law, temperature_law_names, law, error)
      if (allocated(error)) return
      call find_name("viscosity-pressure law", lubricant%pressure_law, pressure_law_names, oil%pressure_law, error)
      if (allocated(error)) return
      if (law == law_vogel .or. law == law_walther) then
         call check_points(lubricant, merge(3, 2, law == law_vogel), error)
         if (allocated(error)) return
      end if
      slope = 0.0_wp
      density = 0.0_wp
      select case (law)
      case (law_direct)
         oil%viscosity = lubricant%viscosity
      case (law_vogel)
         call vogel_viscosity(lubricant%temperature_points, lubricant%viscosity_points, temperature, oil%viscosity, error)
      case (law_walther)
         call walther_viscosity(lubricant, lubricant%temperature_points, lubricant%viscosity_points, .false., temperature, &
            & oil%viscosity, slope, density, error)
      case (law_data_sheet)
         call sheet_viscosity(lubricant, temperature, oil%viscosity, slope, density, error)
      end select
      if (allocated(error)) return
      if (.not. oil%viscosity > 0.0_wp) then
         call raise(error, kind_deck, "lubricant: the viscosity must be positive")
         return
      end if
      oil%pressure_viscosity = lubricant%pressure_viscosity
      if (allocated(lubricant%pressure_viscosity_points)) then
         call coefficient_at(lubricant%pressure_viscosity_temperatures, lubricant%pressure_viscosity_points, temperature, &
            & oil%pressure_viscosity, error)
         if (allocated(error)) return
      end if
      call set_pressure_constants(lubricant, slope, density, oil, error)
   end subroutine get_oil

   !> Enough viscosity points for the law?
   subroutine check_points(lubricant, needed, error)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Number of points that the law takes
      integer, intent(in) :: needed
      !> Deck error where the lists have another length
      type(error_t), allocatable, intent(out) :: error

      logical :: complete

      complete = allocated(lubricant%temperature_points) .and. allocated(lubricant%viscosity_points)
      if (complete) complete = size(lubricant%temperature_points) == needed .and. size(lubricant%viscosity_points) == needed
      if (complete) return
      call raise(error, kind_deck, "lubricant: law '"//trim(lubricant%temperature_law)//"' takes "// &
         & trim(merge("three", "two  ", needed == 3))//" temperatures with as many viscosities")
   end subroutine check_points

   !> Viscosity of an oil given by its data sheet: Walther's law through the kinematic viscosities at 40 and 100 degC.
   subroutine sheet_viscosity(lubricant, temperature, viscosity, slope, density, error)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Requested temperature [K]
      real(wp), intent(in) :: temperature
      !> Dynamic viscosity there [Pa s]
      real(wp), intent(out) :: viscosity
      !> Slope of Walther's law [-]
      real(wp), intent(out) :: slope
      !> Density there [kg/m^3]
      real(wp), intent(out) :: density
      !> Deck error where the data sheet lacks something, domain error where its points are outside the law
      type(error_t), allocatable, intent(out) :: error

      ! Kinematic viscosities at 40 and 100 degC [m^2/s]
      real(wp) :: points(2)

      viscosity = 0.0_wp
      slope = 0.0_wp
      density = 0.0_wp
      call kinematic_points(lubricant, points, error)
      if (allocated(error)) return
      call walther_viscosity(lubricant, sheet_temperatures, points, .true., temperature, viscosity, slope, density, error)
   end subroutine sheet_viscosity

   !> Kinematic viscosities at 40 and 100 degC that a data sheet comes to.
   subroutine kinematic_points(lubricant, points, error)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> The viscosities [m^2/s]
      real(wp), intent(out) :: points(2)
      !> Deck error where the data sheet lacks something or its parts do not fit
      type(error_t), allocatable, intent(out) :: error

      ! Viscosity index [-]
      real(wp) :: quality
      integer :: grade

      points = [lubricant%viscosity_at_40, lubricant%viscosity_at_100]
      quality = lubricant%viscosity_index
      grade = index_of_name(lubricant%sae_grade, sae_grade_names)
      if (grade > 1) then
         points(2) = grade_viscosity(grade)*square_millimetre
         if (.not. quality > 0.0_wp) quality = grade_index(grade)
      end if
      if (.not. points(2) > 0.0_wp .or. .not. max(points(1), quality) > 0.0_wp) then
         call raise(error, kind_deck, "lubricant: law 'data_sheet' takes the kinematic viscosity at 100 degC with that at "// &
            & "40 degC or with the viscosity index, or an SAE grade")
      else if (points(1) > 0.0_wp) then
         if (points(1) <= points(2)) call raise(error, kind_deck, "lubricant: the viscosity at 40 degC must be above that at "// &
            & "100 degC")
      else if (points(2) < smallest_indexed*square_millimetre) then
         call raise(error, kind_domain, "lubricant: the viscosity index is defined from 2 mm^2/s at 100 degC on; give the "// &
            & "viscosity at 40 degC")
      else
         points(1) = viscosity_at_40(points(2)/square_millimetre, quality)*square_millimetre
         if (points(1) <= points(2)) call raise(error, kind_domain, "lubricant: no oil of this viscosity at 100 degC has such "// &
            & "a viscosity index: it would be no thicker at 40 degC")
      end if
   end subroutine kinematic_points

   !> Density at a temperature.
   elemental function density_at(lubricant, temperature) result(density)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Temperature [K]
      real(wp), intent(in) :: temperature
      !> Density there [kg/m^3]
      real(wp) :: density

      density = lubricant%density*(1.0_wp - lubricant%thermal_expansion*(temperature - density_temperature))
   end function density_at

   !> Alpha from Roelands' index or the index from alpha: `Z = alpha p_r/(ln eta0 + 9.67)`; without both alpha by So and Klaus
   !> (1980), where the temperature law knows what that takes.
   subroutine set_pressure_constants(lubricant, slope, density, oil, error)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Slope of Walther's law [-], density at the temperature [kg/m^3]; zero with other laws
      real(wp), intent(in) :: slope, density
      !> Oil with its viscosity, its law and the coefficient as it is given
      type(oil_t), intent(inout) :: oil
      !> Deck error where neither is given, domain error where Roelands' law has no index for this oil
      type(error_t), allocatable, intent(out) :: error

      oil%roelands_index = lubricant%roelands_index
      oil%is_estimated = oil%pressure_viscosity <= 0.0_wp .and. lubricant%roelands_index <= 0.0_wp .and. density > 0.0_wp
      if (oil%is_estimated) then
         if (oil%viscosity < smallest_estimated*square_millimetre*density) then
            call raise(error, kind_domain, "lubricant: the pressure-viscosity coefficient is estimated for 2 mm^2/s and more; "// &
               & "give it, or Roelands' index")
            return
         end if
         oil%pressure_viscosity = so_klaus_coefficient(oil%viscosity/density/square_millimetre, slope, density)
         if (oil%pressure_viscosity <= 0.0_wp) then
            call raise(error, kind_domain, "lubricant: the estimate of the pressure-viscosity coefficient is below zero for "// &
               & "an oil as thick as "//number_text(oil%viscosity/density/square_millimetre, 3)//" mm^2/s; give the "// &
               & "coefficient, or Roelands' index")
            return
         end if
      end if
      oil%roelands_exponent = log(oil%viscosity) + roelands_constant
      if (oil%roelands_exponent <= 0.0_wp) then
         if (oil%pressure_law == law_roelands .or. lubricant%roelands_index > 0.0_wp) then
            call raise(error, kind_domain, "lubricant: Roelands' law needs a viscosity above 6.32e-5 Pa s")
            return
         end if
      end if
      if (oil%pressure_viscosity <= 0.0_wp .and. lubricant%roelands_index <= 0.0_wp) then
         call raise(error, kind_deck, "lubricant: give the pressure-viscosity coefficient or Roelands' index")
      else if (oil%pressure_viscosity <= 0.0_wp) then
         oil%pressure_viscosity = oil%roelands_index*oil%roelands_exponent/roelands_pressure
      else if (oil%pressure_law == law_roelands .and. lubricant%roelands_index <= 0.0_wp) then
         oil%roelands_index = oil%pressure_viscosity*roelands_pressure/oil%roelands_exponent
      else if (oil%pressure_law == law_roelands) then
         call raise(error, kind_deck, "lubricant: Roelands' law takes the pressure-viscosity coefficient or the index, not both")
      end if
   end subroutine set_pressure_constants

   !> Walther's law `log10 log10(nu + 0.7) = A - B log10 T`, nu in mm^2/s, through two points.
   !>
   !> Source: ASTM D341; density falls linearly with temperature.
   subroutine walther_viscosity(lubricant, temperatures, points, is_kinematic, temperature, viscosity, slope, density, error)
      !> What is given about the oil: its density
      type(lubricant_t), intent(in) :: lubricant
      !> Temperatures of the points [K]
      real(wp), intent(in) :: temperatures(2)
      !> Viscosities there, kinematic [m^2/s] or dynamic [Pa s]
      real(wp), intent(in) :: points(2)
      !> Are they kinematic?
      logical, intent(in) :: is_kinematic
      !> Requested temperature [K]
      real(wp), intent(in) :: temperature
      !> Dynamic viscosity there [Pa s]
      real(wp), intent(out) :: viscosity
      !> The slope B [-]
      real(wp), intent(out) :: slope
      !> Density at the requested temperature [kg/m^3]
      real(wp), intent(out) :: density
      !> Domain error where the points are outside the law
      type(error_t), allocatable, intent(out) :: error

      ! Density at the points [kg/m^3]
      real(wp) :: densities(2)
      ! Kinematic viscosity plus Walther's constant [mm^2/s]; its double logarithm [-]
      real(wp) :: shifted(2), double_log(2), value

      viscosity = 0.0_wp
      slope = 0.0_wp
      densities = density_at(lubricant, temperatures)
      density = density_at(lubricant, temperature)
      if (min(minval(densities), density) <= 0.0_wp) then
         call raise(error, kind_domain, "lubricant: density not positive at the temperatures asked for")
         return
      end if
      if (is_kinematic) densities = 1.0_wp
      shifted = points/densities/square_millimetre + walther_constant
      if (minval(shifted) <= 1.0_wp) then
         call raise(error, kind_domain, "lubricant: Walther's law needs kinematic viscosities above 0.3 mm^2/s")
         return
      end if
      double_log = log(log(shifted))
      value = double_log(1) + (double_log(2) - double_log(1))*log(temperature/temperatures(1)) &
         & /log(temperatures(2)/temperatures(1))
      slope = (double_log(1) - double_log(2))/log(temperatures(2)/temperatures(1))
      viscosity = (exp(exp(value)) - walther_constant)*square_millimetre*density
   end subroutine walther_viscosity

   !> Mean of the relative viscosity over a contact with pressure `p0 sqrt(1 - x^2/b^2)`: the integral in
   !> Islam (2019) eq. (33) over `2 b`; and its logarithmic slope over p0.
   !>
   !> Cameron's law integrates to a polynomial of degree 16; the other laws go through Gauss-Legendre quadrature in the
   !> angle phi, x = b sin(phi), with 24 points: better than 1e-12 up to `alpha p0` = 35.
   pure subroutine mean_relative_viscosity(oil, peak, mean, log_slope)
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressure in the middle of the contact, p0 [Pa]
      real(wp), intent(in) :: peak
      !> Mean viscosity ratio [-]
      real(wp), intent(out) :: mean
      !> d ln(mean)/d ln(p0) [-]
      real(wp), intent(out) :: log_slope

      integer :: i
      ! alpha p0; viscosity ratios at the points of the rule and their logarithmic slopes [-]
      real(wp) :: exponent, ratios(size(rule_heights)), slopes(size(rule_heights))
      ! Square of alpha p0; polynomials of its even and odd powers, with each term times its power [-]
      real(wp) :: square, even, odd, even_slope, odd_slope

      if (oil%pressure_law == law_cameron) then
         exponent = oil%pressure_viscosity*peak
         square = exponent**2
         ! Even and odd powers apart, so that one need not wait for the other
         even = cameron_coefficients(cameron_power)
         even_slope = cameron_power*cameron_coefficients(cameron_power)
         odd = 0.0_wp
         odd_slope = 0.0_wp
         do i = cameron_power - 1, 1, -2
            odd = odd*square + cameron_coefficients(i)
            odd_slope = odd_slope*square + powers(i)*cameron_coefficients(i)
            even = even*square + cameron_coefficients(i - 1)
            even_slope = even_slope*square + powers(i - 1)*cameron_coefficients(i - 1)
         end do
         mean = even + exponent*odd
         log_slope = (even_slope + exponent*odd_slope)/mean
         return
      end if
      call relative_viscosity(oil, peak*rule_heights, ratios, slopes)
      mean = sum(rule_weights*ratios)
      log_slope = sum(rule_weights*ratios*slopes)/mean
   end subroutine mean_relative_viscosity

   !> Viscosity at a pressure over that at ambient pressure, and its logarithmic slope.
   !>
   !> Barus `exp(alpha p)`; Cameron `(1 + alpha p/16)^16`, good to about 1 GPa; Roelands
   !> `exp((ln eta0 + 9.67) ((1 + 5.1e-9 p)^Z - 1))`.
   pure subroutine relative_viscosity(oil, pressure, ratio, log_slope)
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressures above ambient [Pa]
      real(wp), contiguous, intent(in) :: pressure(:)
      !> Viscosity ratios [-]
      real(wp), contiguous, intent(out) :: ratio(:)
      !> d ln(ratio)/d ln(pressure), zero where the ratio is held [-]
      real(wp), contiguous, intent(out) :: log_slope(:)

      ! Base of the power in Cameron's and in Roelands' law; the latter's power [-]
      real(wp) :: base, power
      integer :: i

      select case (oil%pressure_law)
      case (law_barus)
         log_slope = merge(oil%pressure_viscosity*pressure, 0.0_wp, oil%pressure_viscosity*pressure <= largest_exponent)
         ratio = exp(min(oil%pressure_viscosity*pressure, largest_exponent))
      case (law_cameron)
         do i = 1, size(pressure)
            base = 1.0_wp + oil%pressure_viscosity*pressure(i)/cameron_power
            ratio(i) = base**cameron_power
            log_slope(i) = oil%pressure_viscosity*pressure(i)/base
         end do
      case default
         do i = 1, size(pressure)
            base = 1.0_wp + pressure(i)/roelands_pressure
            power = exp(oil%roelands_index*log(base))
            ratio(i) = exp(min(oil%roelands_exponent*(power - 1.0_wp), largest_exponent))
            log_slope(i) = oil%roelands_exponent*oil%roelands_index*power*(1.0_wp - 1.0_wp/base)
            if (oil%roelands_exponent*(power - 1.0_wp) > largest_exponent) log_slope(i) = 0.0_wp
         end do
      end select
   end subroutine relative_viscosity

   !> Logarithm of the viscosity at a pressure over that at ambient pressure, however large, and its slope.
   !>
   !> Sources: as for `relative_viscosity`.
   pure subroutine log_relative_viscosity(oil, pressure, value, slope)
      !> Oil at its temperature
      type(oil_t), intent(in) :: oil
      !> Pressure above ambient [Pa]
      real(wp), intent(in) :: pressure
      !> ln of the viscosity ratio [-]
      real(wp), intent(out) :: value
      !> Its derivative over the pressure [1/Pa]
      real(wp), intent(out) :: slope

      ! Base of the power in Cameron's and in Roelands' law; the latter's power [-]
      real(wp) :: base, power

      select case (oil%pressure_law)
      case (law_barus)
         value = oil%pressure_viscosity*pressure
         slope = oil%pressure_viscosity
      case (law_cameron)
         base = 1.0_wp + oil%pressure_viscosity*pressure/cameron_power
         value = cameron_power*log(base)
         slope = oil%pressure_viscosity/base
      case default
         base = 1.0_wp + pressure/roelands_pressure
         power = base**oil%roelands_index
         value = oil%roelands_exponent*(power - 1.0_wp)
         slope = oil%roelands_exponent*oil%roelands_index*power/(base*roelands_pressure)
      end select
   end subroutine log_relative_viscosity

end module camroller_lubricant
