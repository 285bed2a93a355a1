!> Contact of rough surfaces: load and real contact area of the asperities.
!>
!> In: ratio of film thickness to roughness, roughness constants, equivalent modulus, apparent area. Out:
!> asperity load and real contact area with their derivatives.
!> Sources: Greenwood and Tripp (1970), Proc. Instn Mech. Engrs 185, 625-633; Islam (2019) eqs. (34)-(36) with
!> (eta beta sigma) squared in the real area as well. Zhao, Maietta and Chang (2000), J. Tribol. 122, 86-93.
module camroller_asperity
   use camroller_kinds, only : wp, pi, gas_constant
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_boundary_law, only : boundary_curve_t, boundary_law_t, evaluate_boundary_curve, new_boundary_curve
   use camroller_names, only : name_length, find_name
   use camroller_greenwood_tripp, only : integral_2, integral_5_2, largest_film_ratio
   use camroller_zhao_maietta_chang, only : summits_t, new_summits, sum_polynomials, first_yield, smallest_product
   implicit none
   private

   public :: asperity_t, asperity_constants_t, asperity_law_names, boundary_names, mobilisation_names
   public :: boundary_part_t, new_boundary_part, friction_modifier_t, coverage, set_boundary_temperature
   public :: boundary_friction_t, find_boundary_friction, largest_coefficient, has_one_coefficient
   public :: law_greenwood_tripp, law_zhao_maietta_chang, law_masjedi_khonsari_asperities, smallest_product
   public :: new_asperity_constants, asperity_load_function, asperity_area_function
   public :: load_factor, spread_load

   !> Laws of touching asperities: elastic summits of both surfaces, summits of one surface that yield against a plane, or
   !> the regression that goes with the rough film of Masjedi and Khonsari
   character(len=*), parameter :: asperity_law_names(*) = [character(len=name_length) :: "greenwood_tripp", "zhao_maietta_chang", &
      & "masjedi_khonsari"]
   !> Their positions in the list
   integer, parameter :: law_greenwood_tripp = 1, law_zhao_maietta_chang = 2, law_masjedi_khonsari_asperities = 3
   !> Boundary friction that is counted: all of it, or what the slip mobilises
   character(len=*), parameter :: boundary_names(*) = [character(len=name_length) :: "mobilised", "full"]
   !> How slip mobilises boundary friction: growing with the sliding speed, or at once, with any part of it at rest
   character(len=*), parameter :: mobilisation_names(*) = [character(len=name_length) :: "regularised", "stick_slip"]

   !> Asperities and their friction
   type :: asperity_t
      !> Product of asperity density, tip radius and roughness, eta beta sigma [-]
      real(wp) :: roughness_product = 0.04_wp
      !> Roughness over tip radius, sigma/beta [-]
      real(wp) :: roughness_over_tip_radius = 0.01_wp
      !> Friction coefficient of touching asperities, mu_B [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Shear strength of the surface film on the real contact area, tau_0 [Pa]
      real(wp) :: film_shear_strength = 0.0_wp
      !> One of `boundary_names`
      character(len=name_length) :: boundary = "mobilised"
      !> One of `mobilisation_names`
      character(len=name_length) :: mobilisation = "regularised"
      !> Sliding speed that mobilises regularised boundary friction, v_b [m/s]
      real(wp) :: mobilising_speed = 1.0e-3_wp
      !> One of `asperity_law_names`
      character(len=name_length) :: law = "greenwood_tripp"
   end type asperity_t

   !> Additive that lays itself on the surfaces and lowers boundary friction
   type :: friction_modifier_t
      !> Friction coefficient of asperities that it covers [-]
      real(wp) :: coefficient = 0.0_wp
      !> Part of the surfaces that it covers at a temperature [-], [K]
      real(wp) :: reference_coverage = 0.0_wp, reference_temperature = 0.0_wp
      !> Heat that it gives off as it is adsorbed [J/mol]
      real(wp) :: adsorption_heat = 0.0_wp
      !> Its concentration over that at which the coverage is known [-]
      real(wp) :: concentration_ratio = 1.0_wp
   end type friction_modifier_t

   !> What a contact needs of the asperities
   type :: asperity_constants_t
      !> One of the laws
      integer :: law = law_greenwood_tripp
      !> Asperity load over apparent area and over the law's function of the film ratio (F_5/2) [Pa]
      real(wp) :: load_factor = 0.0_wp
      !> Real over apparent area and over the law's function of the film ratio (F_2) [-]
      real(wp) :: area_factor = 0.0_wp
      !> Film ratio beyond which no asperity touches [-]
      real(wp) :: reach = largest_film_ratio
      !> Functions of the film ratio by Zhao, Maietta and Chang
      type(summits_t) :: summits
   end type asperity_constants_t

   !> Asperities and their friction, ready for evaluation
   type :: boundary_part_t
      !> Constants of load and area
      type(asperity_constants_t) :: constants
      !> mu_B; with a friction modifier at the temperature set last; with a law also at its reference speed [-]
      real(wp) :: coefficient
      !> mu_B of bare surfaces [-]
      real(wp) :: bare_coefficient
      !> Allocated where the oil has one
      type(friction_modifier_t), allocatable :: modifier
      !> Law of mu_B of bare surfaces over sliding speed and temperature; allocated where it is not constant
      type(boundary_curve_t), allocatable :: curve
      !> mu_B of surfaces that a tribofilm covers; allocated where one grows [-]
      real(wp), allocatable :: film_coefficient
      !> Temperature set last [K], part of the surfaces that the friction modifier covers there [-]
      real(wp) :: temperature = 0.0_wp, modified = 0.0_wp
      !> tau_0 [Pa]
      real(wp) :: film_shear_strength
      !> v_b [m/s]
      real(wp) :: mobilising_speed
      !> Is all of the boundary friction counted, whether mobilised or not?
      logical :: is_full
      !> Does friction take any value up to its limit where nothing slides, and its limit elsewhere?
      logical :: is_set_valued
   end type boundary_part_t

   !> Friction coefficient of asperities with its derivatives
   type :: boundary_friction_t
      !> The coefficient [-]; its derivatives over the sliding speed [s/m], the temperature of the surfaces [1/K] and the part that
      !> a tribofilm covers [-]
      real(wp) :: coefficient = 0.0_wp, by_speed = 0.0_wp, by_temperature = 0.0_wp, by_covered = 0.0_wp
   end type boundary_friction_t

contains

   !> Prepare asperities and their friction.
   subroutine new_boundary_part(part, asperity, modulus, hardness, has_rough_film, error, modifier, law)
      !> Ready for evaluation
      type(boundary_part_t), intent(out) :: part
      !> Asperities
      type(asperity_t), intent(in) :: asperity
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Hardness of the softer body; zero: not known [Pa]
      real(wp), intent(in) :: hardness
      !> Is the film that of rough surfaces by Masjedi and Khonsari?
      logical, intent(in) :: has_rough_film
      !> Deck error for an unknown name, or where the law lacks something
      type(error_t), allocatable, intent(out) :: error
      !> Friction modifier of the oil, where it has one
      type(friction_modifier_t), intent(in), optional :: modifier
      !> Law of the boundary coefficient, where it is not constant
      type(boundary_law_t), intent(in), optional :: law

      integer :: choice

      call find_name("boundary friction", asperity%boundary, boundary_names, choice, error)
      if (allocated(error)) return
      part%is_full = choice == 2
      call find_name("mobilisation of boundary friction", asperity%mobilisation, mobilisation_names, choice, error)
      if (allocated(error)) return
      part%is_set_valued = choice == 2
      part%coefficient = asperity%boundary_coefficient
      part%bare_coefficient = asperity%boundary_coefficient
      if (present(modifier)) then
         part%modifier = modifier
         if (.not. (modifier%coefficient >= 0.0_wp .and. modifier%reference_coverage > 0.0_wp .and. &
            & modifier%reference_coverage < 1.0_wp .and. modifier%adsorption_heat >= 0.0_wp .and. &
            & min(modifier%reference_temperature, modifier%concentration_ratio) > 0.0_wp)) then
            call raise(error, kind_deck, "friction modifier: the coverage lies between 0 and 1, temperature and concentration "// &
               & "are positive, coefficient and heat are not negative")
            return
         end if
      end if
      if (present(law)) then
         allocate (part%curve)
         call new_boundary_curve(part%curve, law, asperity%boundary_coefficient, error)
         if (allocated(error)) return
      end if
      part%film_shear_strength = asperity%film_shear_strength
      part%mobilising_speed = asperity%mobilising_speed
      call find_name("asperity law", asperity%law, asperity_law_names, choice, error)
      if (allocated(error)) return
      if (choice == law_zhao_maietta_chang .and. .not. hardness > 0.0_wp) then
         call raise(error, kind_deck, "materials: the asperity law 'zhao_maietta_chang' needs the hardness")
      else if (choice == law_zhao_maietta_chang .and. .not. asperity%roughness_product >= smallest_product) then
         call raise(error, kind_deck, "asperity: the law 'zhao_maietta_chang' needs a roughness product of 0.025 or more")
      else if (choice == law_masjedi_khonsari_asperities .and. .not. has_rough_film) then
         call raise(error, kind_deck, "asperity: the law 'masjedi_khonsari' goes with film law 'masjedi_khonsari_rough'")
      else if (choice == law_masjedi_khonsari_asperities .and. part%film_shear_strength > 0.0_wp) then
         call raise(error, kind_deck, "asperity: the law 'masjedi_khonsari' has no real area that could be sheared")
      end if
      if (allocated(error)) return
      call new_asperity_constants(part%constants, asperity, modulus, hardness)
   end subroutine new_boundary_part

   !> Boundary friction at a temperature of the surfaces: that of bare and of covered parts in proportion,
   !> `mu_B = mu_0 + theta (mu_fm - mu_0)`; Jahanmir and Beltzer (1986), ASLE Transactions 29, 423, who have another isotherm.
   pure subroutine set_boundary_temperature(part, temperature)
      !> Gets the coefficient
      type(boundary_part_t), intent(inout) :: part
      !> The temperature [K]
      real(wp), intent(in) :: temperature

      ! Slopes of the law that are not wanted here [s/m], [1/K]
      real(wp) :: by_speed, by_temperature

      part%temperature = temperature
      if (allocated(part%curve)) then
         call evaluate_boundary_curve(part%curve, part%curve%reference_speed, temperature, part%bare_coefficient, by_speed, &
            & by_temperature)
         part%coefficient = part%bare_coefficient
      end if
      if (.not. allocated(part%modifier)) return
      part%modified = coverage(part%modifier, temperature)
      part%coefficient = part%bare_coefficient + part%modified*(part%modifier%coefficient - part%bare_coefficient)
   end subroutine set_boundary_temperature

   !> Is the coefficient the same at any sliding speed, temperature of the surfaces and place on the cam?
   pure function has_one_coefficient(part) result(verdict)
      !> Asperities at the temperature of the oil
      type(boundary_part_t), intent(in) :: part
      !> Is it?
      logical :: verdict

      verdict = .not. (allocated(part%curve) .or. allocated(part%film_coefficient))
   end function has_one_coefficient

   !> Friction coefficient at a sliding speed and a temperature: that of bare surfaces by its law, of a tribofilm and of a friction
   !> modifier on both, each in proportion to the part it covers. The modifier's layer is that of the oil's temperature, to which
   !> surfaces return between contacts.
   pure subroutine find_boundary_friction(part, sliding_speed, rise, covered, friction)
      !> Asperities at the temperature of the oil
      type(boundary_part_t), intent(in) :: part
      !> Sliding speed, of either sign [m/s], rise of the surfaces' temperature over that of the oil [K]
      real(wp), intent(in) :: sliding_speed, rise
      !> Part of the surfaces that a tribofilm covers [-]
      real(wp), intent(in) :: covered
      !> The coefficient with its derivatives
      type(boundary_friction_t), intent(out) :: friction

      friction%coefficient = part%coefficient
      if (has_one_coefficient(part)) return
      friction%coefficient = part%bare_coefficient
      if (allocated(part%curve)) call evaluate_boundary_curve(part%curve, sliding_speed, part%temperature + rise, &
         & friction%coefficient, friction%by_speed, friction%by_temperature)
      if (allocated(part%film_coefficient)) then
         friction%by_covered = part%film_coefficient - friction%coefficient
         friction%coefficient = friction%coefficient + covered*friction%by_covered
         friction%by_speed = (1.0_wp - covered)*friction%by_speed
         friction%by_temperature = (1.0_wp - covered)*friction%by_temperature
      end if
      if (.not. allocated(part%modifier)) return
      friction%coefficient = friction%coefficient + part%modified*(part%modifier%coefficient - friction%coefficient)
      friction%by_speed = (1.0_wp - part%modified)*friction%by_speed
      friction%by_temperature = (1.0_wp - part%modified)*friction%by_temperature
      friction%by_covered = (1.0_wp - part%modified)*friction%by_covered
   end subroutine find_boundary_friction

   !> Largest coefficient at any sliding speed and temperature of the surfaces.
   pure function largest_coefficient(part) result(largest)
      !> Asperities at the temperature of the oil
      type(boundary_part_t), intent(in) :: part
      !> The coefficient [-]
      real(wp) :: largest

      largest = part%coefficient
      if (allocated(part%curve)) largest = max(largest, part%curve%largest)
      if (allocated(part%film_coefficient)) largest = max(largest, part%film_coefficient)
   end function largest_coefficient

   !> Part of the surfaces that a friction modifier covers: `theta = K c/(1 + K c)` by Langmuir (1918), J. American Chemical Society
   !> 40, 1361, with `K = K_0 exp(-dH/(R T))`, whose K_0 follows from the coverage that is known.
   pure function coverage(modifier, temperature) result(part)
      !> The friction modifier
      type(friction_modifier_t), intent(in) :: modifier
      !> Temperature of the surfaces [K]
      real(wp), intent(in) :: temperature
      !> The part [-]
      real(wp) :: part

      !> Logarithm of bare over covered part, -ln(K c) [-]
      real(wp) :: bare

      bare = log((1.0_wp - modifier%reference_coverage)/(modifier%reference_coverage*modifier%concentration_ratio)) &
         & + modifier%adsorption_heat/gas_constant*(1.0_wp/modifier%reference_temperature - 1.0_wp/temperature)
      part = 0.0_wp
      if (bare < 700.0_wp) part = 1.0_wp/(1.0_wp + exp(bare))
   end function coverage

   !> Derive the constants of a pair of surfaces.
   pure subroutine new_asperity_constants(constants, asperity, modulus, hardness)
      !> The constants
      type(asperity_constants_t), intent(out) :: constants
      !> Asperities; the law is one of the names
      type(asperity_t), intent(in) :: asperity
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Hardness of the softer body, for Zhao, Maietta and Chang alone; absent: asperities do not yield [Pa]
      real(wp), intent(in), optional :: hardness

      ! Hardness over E' beyond which no asperity in reach yields [-]
      real(wp), parameter :: hard = 10.0_wp
      ! Hardness over E' [-]
      real(wp) :: relative

      associate (product => asperity%roughness_product, slenderness => asperity%roughness_over_tip_radius)
         if (asperity%law == asperity_law_names(law_zhao_maietta_chang)) then
            relative = hard
            if (present(hardness)) relative = hardness/modulus
            constants%law = law_zhao_maietta_chang
            constants%load_factor = 2.0_wp/3.0_wp*product*sqrt(slenderness)*modulus
            constants%area_factor = pi*product
            call new_summits(constants%summits, product, first_yield(relative, slenderness))
            constants%reach = constants%summits%reach
         else if (asperity%law == asperity_law_names(law_masjedi_khonsari_asperities)) then
            ! A part of the load at any film, and no area
            constants%law = law_masjedi_khonsari_asperities
            constants%reach = huge(1.0_wp)
         else
            constants%load_factor = load_factor(product, slenderness, modulus)
            constants%area_factor = area_factor(product)
         end if
      end associate
   end subroutine new_asperity_constants

   !> Asperity load over its factor, a function of the film ratio, and its derivative.
   pure subroutine asperity_load_function(constants, film_ratio, value, slope)
      !> Constants of the surfaces
      type(asperity_constants_t), intent(in) :: constants
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> The function (F_5/2) [-]
      real(wp), intent(out) :: value
      !> Derivative with respect to the film ratio [-]
      real(wp), intent(out) :: slope

      if (constants%law == law_greenwood_tripp) then
         call integral_5_2(film_ratio, value, slope)
      else
         call sum_polynomials(constants%summits%load, constants%summits%reach, film_ratio, value, slope)
      end if
   end subroutine asperity_load_function

   !> Asperity load in and beside the strip of the dry contact, over its factor and the area of the strip: at the film in the strip,
   !> and beside it with the gap of the dry bodies on top.
   !>
   !> Beside a line contact of half width b that gap is `g = (b^2/2R) [X sqrt(X^2 - 1) - ln(X + sqrt(X^2 - 1))]`, X = x/b (Johnson
   !> 1985, section 4.3), so that the load there over that in the strip is `int_1^inf F(H + g/sigma) dX/F(H)`. With F as steep all
   !> along as at H this is a function of `2 sigma R/b^2 F/(-F')` alone; a Gaussian tail is steeper, and takes 2 to 7 % off. The fit
   !> is within 5 % of the integral for Greenwood and Tripp, H up to 3, `sigma R/b^2` from 0.05 to 200.
   pure function spread_load(constants, film_ratio, relative_roughness) result(load)
      !> Constants of the surfaces, of a law with a load over the film
      type(asperity_constants_t), intent(in) :: constants
      !> Film thickness in the strip over roughness, H >= 0; `sigma R/b^2` [-]
      real(wp), intent(in) :: film_ratio, relative_roughness
      !> The load [-]
      real(wp) :: load

      real(wp), parameter :: fit(3) = [0.23_wp, 0.79_wp, 0.96_wp] ! [-]
      ! Slope of the function of the film ratio, root of the parameter [-]
      real(wp) :: slope, root

      call asperity_load_function(constants, film_ratio, load, slope)
      if (.not. slope < 0.0_wp) return
      root = sqrt(2.0_wp*relative_roughness*load/(-slope))
      load = load*(1.0_wp + root*(fit(1) + fit(2)*root)/(1.0_wp + fit(3)*root))
   end function spread_load

   !> Real over apparent area over its factor, a function of the film ratio, and its derivative.
   pure subroutine asperity_area_function(constants, film_ratio, value, slope)
      !> Constants of the surfaces
      type(asperity_constants_t), intent(in) :: constants
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> The function (F_2) [-]
      real(wp), intent(out) :: value
      !> Derivative with respect to the film ratio [-]
      real(wp), intent(out) :: slope

      if (constants%law == law_greenwood_tripp) then
         call integral_2(film_ratio, value, slope)
      else
         call sum_polynomials(constants%summits%area, constants%summits%reach, film_ratio, value, slope)
      end if
   end subroutine asperity_area_function

   !> Asperity load over apparent area and F_5/2, Greenwood and Tripp:
   !> `W_a = (8 sqrt(2)/15) pi (eta beta sigma)^2 sqrt(sigma/beta) E' A_a F_5/2(h/sigma)`.
   elemental function load_factor(roughness_product, roughness_over_tip_radius, modulus) result(factor)
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> sigma/beta [-]
      real(wp), intent(in) :: roughness_over_tip_radius
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> The factor [Pa]
      real(wp) :: factor

      factor = 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*roughness_product**2*sqrt(roughness_over_tip_radius)*modulus
   end function load_factor

   !> Real over apparent area and F_2, Greenwood and Tripp, `A_r = pi^2 (eta beta sigma)^2 A_a F_2(h/sigma)`.
   elemental function area_factor(roughness_product) result(factor)
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> The factor [-]
      real(wp) :: factor

      factor = (pi*roughness_product)**2
   end function area_factor

end module camroller_asperity
