!> A lubricated line contact of two rough elastic bodies: its data, and the same in dimensionless form.
!>
!> In: load, speeds, radius, modulus, oil, roughness. Out: `ehl_problem_t`. Scales: half width b and peak pressure p_H of the dry
!> contact under the reference load, film b^2/R. Then Reynolds' equation is
!>
!>     d/dX(rho H) = d/dX(rho H^3/(lambda eta) dP/dX),   lambda = 12 u eta0 R^2/(b^3 p_H)
!>
!> with eta and rho relative to their values at ambient pressure; the load is `int P dX = pi/2` for the reference load. Sources:
!> Dowson and Higginson, Elasto-Hydrodynamic Lubrication (1966); density `(5.9e8 Pa + 1.34 p)/(5.9e8 Pa + p)` there.
module camroller_ehl_problem
   use camroller_kinds, only : wp, pi
   use camroller_number_text, only : number_text
   use camroller_lubricant, only : oil_t, log_relative_viscosity
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_traction, only : cap_smooth
   use camroller_film, only : groups_t, film_shape_t, film_shape, law_moes
   use camroller_asperity, only : asperity_constants_t, asperity_load_function, asperity_area_function
   use camroller_conjunction, only : body_t, hot_oil_t, viscosity_by_rise, warm_oil
   implicit none
   private

   public :: ehl_contact_t, ehl_heat_t, ehl_problem_t, new_ehl_problem, range_text, in_range, largest_dry_pressure, speed_range, &
      & load_range
   public :: log_viscosity, log_hot_viscosity, relative_density, asperity_reach, asperity_pressure, real_area_part, &
      & pressure_flow_factor, mean_gap

   !> What a problem may be: in range, or which quantity is out of it
   integer, parameter :: in_range = 0, pressure_out_of_range = 1, exponent_out_of_range = 2, speed_out_of_range = 3, &
      & load_out_of_range = 4

   !> Peak pressure of the dry contact [Pa], and pressure-viscosity coefficient times it [-], up to which solutions are given
   real(wp), parameter :: largest_dry_pressure = 1.5e9_wp, largest_exponent = 35.0_wp
   !> Groups U and W* for which solutions are given [-]; the range of the tests is a part of it
   real(wp), parameter :: speed_range(2) = [1.0e-15_wp, 1.0e-7_wp], load_range(2) = [1.0e-8_wp, 1.0e-2_wp]
   !> Density: reference pressure [Pa] and the largest ratio [-]
   real(wp), parameter :: density_pressure = 5.9e8_wp, density_limit = 1.34_wp
   !> Pressure over its scale below which the viscosity is a straight line on a logarithmic scale [-]
   real(wp), parameter :: smallest_pressure = 1.0e-9_wp
   !> Film ratio below which the flow factor is held [-]
   real(wp), parameter :: smallest_film_ratio = 0.5_wp

   !> What the temperature along a contact depends on
   type :: ehl_heat_t
      !> How the oil follows the temperature from that around on
      type(hot_oil_t) :: hot
      !> Both bodies
      type(body_t) :: bodies(2)
      !> Speed of each surface over the contact [m/s]
      real(wp) :: speeds(2) = 0.0_wp
      !> Thermal conductivity of the oil [W/(m K)], its heat capacity over volume [J/(m^3 K)], fall of its density per kelvin [1/K]
      real(wp) :: conductivity = 0.0_wp, capacity = 0.0_wp, expansion = 0.0_wp
      !> Temperature of the oil around [K]
      real(wp) :: temperature = 0.0_wp
      !> Limiting traction coefficient [-], how it is approached, its fall per kelvin [1/K]; is the stress limited at each point,
      !> then the limiting stress without pressure [Pa]
      real(wp) :: limiting_coefficient = 0.0_wp, limit_fall = 0.0_wp, limiting_stress = 0.0_wp
      logical :: has_local_limit = .false.
      integer :: cap = cap_smooth
      !> Boundary friction over the asperities' load [-] and over the area on which they touch [Pa], as far as slip mobilises it
      real(wp) :: boundary_coefficient = 0.0_wp, boundary_stress = 0.0_wp
   end type ehl_heat_t

   !> A line contact as it is given
   type :: ehl_contact_t
      !> Load over length [N/m]
      real(wp) :: line_load
      !> Equivalent radius, R [m]
      real(wp) :: radius
      !> Equivalent modulus, E' [Pa]
      real(wp) :: modulus
      !> Mean of the surfaces' speeds, positive [m/s]
      real(wp) :: entrainment_speed
      !> Difference of the surfaces' speeds [m/s]
      real(wp) :: sliding_speed = 0.0_wp
      !> The oil
      type(oil_t) :: oil
      !> Does the density of the oil grow with the pressure?
      logical :: is_compressible = .true.
      !> Shear stress at which the oil begins to thin, tau_E [Pa]; zero: never
      real(wp) :: eyring_stress = 0.0_wp
      !> Does the oil that pressure drives thin as well, or that which is sheared alone?
      logical :: thins_flow = .true.
      !> Composite roughness [m]; zero: smooth
      real(wp) :: roughness = 0.0_wp
      !> Constants of the asperities; they touch where the roughness is positive
      type(asperity_constants_t) :: asperity
      !> Does roughness hinder the flow that pressure drives?
      logical :: has_flow_factors = .false.
      !> Heat along the contact; not allocated: all of it is as warm as the oil around
      type(ehl_heat_t), allocatable :: heat
   end type ehl_contact_t

   !> The same without dimension, and the scales
   type :: ehl_problem_t
      !> Scales: length b [m], pressure p_H [Pa], film b^2/R [m]
      real(wp) :: length_scale, pressure_scale, film_scale
      !> Speed parameter, lambda [-]
      real(wp) :: speed
      !> Integral of the pressure [-]
      real(wp) :: load = 0.5_wp*pi
      !> The oil
      type(oil_t) :: oil
      !> Does the density grow with the pressure?
      logical :: is_compressible
      !> Roughness over the film scale [-]
      real(wp) :: roughness = 0.0_wp
      !> Constants of the asperities
      type(asperity_constants_t) :: asperity
      !> Their load factor over the pressure scale; zero: they do not touch [-]
      real(wp) :: asperity_factor = 0.0_wp
      !> Does roughness hinder the flow?
      logical :: has_flow_factors = .false.
      !> Shear stress over tau_E in a film of the film scale at ambient viscosity [-]; zero: no thinning
      real(wp) :: shear = 0.0_wp
      !> Does the oil that pressure drives thin as well?
      logical :: thins_flow = .true.
      !> Film at the centre by Moes' formula, to choose grid and start [-]
      real(wp) :: expected_film
      !> Mean of the surfaces' speeds, and their difference [m/s]
      real(wp) :: entrainment_speed, sliding_speed
      !> Are shear and pressure of the cells kept with film and friction?
      logical :: keeps_cells = .false.
      !> Heat along the contact; not allocated: none
      type(ehl_heat_t), allocatable :: heat
   end type ehl_problem_t

contains

   !> Problem of a contact; a positive status and no numbers beyond the range for which solutions are given.
   pure subroutine new_ehl_problem(problem, contact, status)
      !> The problem
      type(ehl_problem_t), intent(out) :: problem
      !> The contact
      type(ehl_contact_t), intent(in) :: contact
      !> `in_range`, or what is out of it
      integer, intent(out) :: status

      type(groups_t) :: groups
      type(film_shape_t) :: shape

      groups%speed = contact%oil%viscosity*contact%entrainment_speed/(contact%modulus*contact%radius)
      groups%material = contact%oil%pressure_viscosity*contact%modulus
      groups%load = contact%line_load/(contact%modulus*contact%radius)
      groups%roughness = 0.0_wp
      groups%hardness = 0.0_wp
      problem%pressure_scale = peak_pressure(contact%line_load, contact%radius, 1.0_wp, contact%modulus)
      call check_range(groups, problem%pressure_scale, contact%oil%pressure_viscosity*problem%pressure_scale, status)
      if (status /= in_range) return
      problem%length_scale = half_width(contact%line_load, contact%radius, 1.0_wp, contact%modulus)
      problem%film_scale = problem%length_scale**2/contact%radius
      problem%speed = 12.0_wp*contact%entrainment_speed*contact%oil%viscosity*contact%radius**2 &
         & /(problem%length_scale**3*problem%pressure_scale)
      problem%oil = contact%oil
      problem%entrainment_speed = contact%entrainment_speed
      problem%sliding_speed = contact%sliding_speed
      if (allocated(contact%heat)) problem%heat = contact%heat
      problem%is_compressible = contact%is_compressible
      problem%has_flow_factors = contact%has_flow_factors
      problem%roughness = contact%roughness/problem%film_scale
      if (contact%roughness > 0.0_wp) then
         problem%asperity_factor = contact%asperity%load_factor/problem%pressure_scale
         problem%asperity = contact%asperity
      end if
      if (contact%eyring_stress > 0.0_wp) problem%shear = contact%oil%viscosity*abs(contact%sliding_speed) &
         & /(problem%film_scale*contact%eyring_stress)
      problem%thins_flow = contact%thins_flow
      call film_shape(law_moes, groups, shape)
      problem%expected_film = shape%central*contact%radius/problem%film_scale
   end subroutine new_ehl_problem

   !> Distance from the middle at which asperities carry next to nothing: there the gap of a parabola has grown by four times the
   !> roughness, and with it their pressure has fallen by more than four decades. Light contacts of rough surfaces are far wider
   !> than dry ones.
   pure function asperity_reach(problem) result(reach)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The distance; zero for smooth surfaces [half widths]
      real(wp) :: reach

      reach = 0.0_wp
      if (problem%asperity_factor > 0.0_wp) reach = sqrt(2.0_wp*4.0_wp*problem%roughness)
   end function asperity_reach

   !> Is the contact one that solutions are given for?
   pure subroutine check_range(groups, pressure, exponent, status)
      !> Dimensionless groups
      type(groups_t), intent(in) :: groups
      !> Peak pressure of the dry contact [Pa]
      real(wp), intent(in) :: pressure
      !> The same times the pressure-viscosity coefficient [-]
      real(wp), intent(in) :: exponent
      !> `in_range`, or what is out of it
      integer, intent(out) :: status

      status = in_range
      if (.not. (pressure <= largest_dry_pressure)) then
         status = pressure_out_of_range
      else if (.not. (exponent <= largest_exponent)) then
         status = exponent_out_of_range
      else if (.not. (groups%speed >= speed_range(1) .and. groups%speed <= speed_range(2))) then
         status = speed_out_of_range
      else if (.not. (groups%load >= load_range(1) .and. groups%load <= load_range(2))) then
         status = load_out_of_range
      end if
   end subroutine check_range

   !> What a status of `new_ehl_problem` means, in words.
   pure function range_text(status) result(text)
      !> The status
      integer, intent(in) :: status
      !> Words
      character(len=64) :: text

      select case (status)
      case (in_range)
         text = "in range"
      case (pressure_out_of_range)
         text = "peak pressure of the dry contact above "//number_text(1.0e-9_wp*largest_dry_pressure, 3)//" GPa"
      case (exponent_out_of_range)
         text = "pressure-viscosity coefficient times peak pressure above "//number_text(largest_exponent)
      case (speed_out_of_range)
         text = "speed group U outside "//number_text(speed_range(1))//" to "//number_text(speed_range(2))
      case default
         text = "load group W* outside "//number_text(load_range(1))//" to "//number_text(load_range(2))
      end select
   end function range_text

   !> Logarithm of the viscosity ratio at a pressure over the scale, and its slope; the slope at zero below it.
   pure subroutine log_viscosity(problem, pressure, value, slope)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Pressure over its scale [-]
      real(wp), intent(in) :: pressure
      !> ln(eta/eta0) and its derivative with respect to the pressure over its scale [-]
      real(wp), intent(out) :: value, slope

      value = 0.0_wp
      slope = problem%oil%pressure_viscosity
      if (pressure > smallest_pressure) call log_relative_viscosity(problem%oil, pressure*problem%pressure_scale, value, slope)
      slope = slope*problem%pressure_scale
   end subroutine log_viscosity

   !> The same at a rise of the temperature, with its derivative over the rise.
   pure subroutine log_hot_viscosity(problem, pressure, rise, value, slope, by_rise)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> Pressure over its scale [-], rise of the temperature [K]
      real(wp), intent(in) :: pressure, rise
      !> ln(eta/eta0), eta0 at the temperature around, and its derivative over the pressure over its scale [-]
      real(wp), intent(out) :: value, slope
      !> Its derivative over the rise [1/K]
      real(wp), intent(out) :: by_rise

      type(oil_t) :: warm
      ! Change at ambient pressure [-], its derivative over the rise [1/K]
      real(wp) :: change, change_slope

      call warm_oil(problem%heat%hot, problem%oil, rise, warm, change, change_slope)
      value = 0.0_wp
      slope = warm%pressure_viscosity
      if (pressure > smallest_pressure) call log_relative_viscosity(warm, pressure*problem%pressure_scale, value, slope)
      slope = slope*problem%pressure_scale
      by_rise = viscosity_by_rise(problem%heat%hot, warm, change_slope, value, slope*max(pressure, 0.0_wp))
      value = value + change
   end subroutine log_hot_viscosity

   !> Density over that at ambient pressure, and its slope.
   pure subroutine relative_density(problem, pressure, value, slope)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Pressure over its scale [-]
      real(wp), intent(in) :: pressure
      !> Density ratio and its derivative with respect to the pressure over its scale [-]
      real(wp), intent(out) :: value, slope

      ! Reference pressure over the scale [-]
      real(wp) :: reference

      value = 1.0_wp
      slope = 0.0_wp
      if (.not. problem%is_compressible) return
      reference = density_pressure/problem%pressure_scale
      value = (reference + density_limit*max(pressure, 0.0_wp))/(reference + max(pressure, 0.0_wp))
      slope = (density_limit - 1.0_wp)*reference/(reference + max(pressure, 0.0_wp))**2
   end subroutine relative_density

   !> Pressure of touching asperities and its slope; a straight line below zero film.
   pure subroutine asperity_pressure(problem, film, value, slope)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Film over its scale [-]
      real(wp), intent(in) :: film
      !> Pressure over its scale, and its derivative with respect to the film over its scale [-]
      real(wp), intent(out) :: value, slope

      value = 0.0_wp
      slope = 0.0_wp
      if (problem%asperity_factor <= 0.0_wp) return
      call asperity_load_function(problem%asperity, max(film, 0.0_wp)/problem%roughness, value, slope)
      if (film < 0.0_wp) value = value + slope*film/problem%roughness
      value = problem%asperity_factor*value
      slope = problem%asperity_factor*slope/problem%roughness
   end subroutine asperity_pressure

   !> Part of the surface on which asperities touch.
   elemental function real_area_part(problem, film) result(part)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Film over its scale [-]
      real(wp), intent(in) :: film
      !> Real over apparent area [-]
      real(wp) :: part

      ! Derivative that is not used [-]
      real(wp) :: slope

      part = 0.0_wp
      if (problem%asperity_factor <= 0.0_wp) return
      call asperity_area_function(problem%asperity, max(film, 0.0_wp)/problem%roughness, part, slope)
      part = problem%asperity%area_factor*part
   end function real_area_part

   !> Part of the flow driven by pressure that isotropic roughness lets through, `1 - 0.9 exp(-0.56 h/sigma)`, and its slope.
   !>
   !> Source: Patir and Cheng, J. Lubr. Technol. 100 (1978) 12, for a Peklenik number of one; fitted for h/sigma above 0.5, held
   !> below.
   pure subroutine pressure_flow_factor(problem, film, value, slope)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Film over its scale [-]
      real(wp), intent(in) :: film
      !> Factor, and its derivative with respect to the film over its scale [-]
      real(wp), intent(out) :: value, slope

      ! Film ratio, hindered part [-]
      real(wp) :: film_ratio, part

      value = 1.0_wp
      slope = 0.0_wp
      if (.not. problem%has_flow_factors .or. problem%roughness <= 0.0_wp) return
      film_ratio = film/problem%roughness
      part = 0.9_wp*exp(-0.56_wp*max(film_ratio, smallest_film_ratio))
      value = 1.0_wp - part
      if (film_ratio > smallest_film_ratio) slope = 0.56_wp*part/problem%roughness
   end subroutine pressure_flow_factor

   !> Room that rough surfaces leave to the oil over their area, `int_-h^inf (h + s) phi(s) ds`, and its slope; the film without
   !> flow factors.
   !>
   !> Summits that would reach into the other surface are flattened, so the room is larger than the distance of the mean planes: by
   !> 8 % at h = sigma. Source: Patir and Cheng, J. Lubr. Technol. 100 (1978) 12, the mean gap of their equation.
   pure subroutine mean_gap(problem, film, value, slope)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Film over its scale [-]
      real(wp), intent(in) :: film
      !> Mean gap over the scale of the film, and its derivative with respect to the film over its scale [-]
      real(wp), intent(out) :: value, slope

      ! Film ratio from which on nothing touches: double precision has no more figures [-]
      real(wp), parameter :: untouched = 8.5_wp
      ! Film ratio [-]
      real(wp) :: film_ratio

      value = film
      slope = 1.0_wp
      if (.not. problem%has_flow_factors .or. problem%roughness <= 0.0_wp) return
      film_ratio = film/problem%roughness
      if (abs(film_ratio) > untouched) then
         if (film_ratio > 0.0_wp) return
         value = 0.0_wp
         slope = 0.0_wp
         return
      end if
      slope = 0.5_wp*erfc(-film_ratio*sqrt(0.5_wp))
      value = film*slope + problem%roughness*exp(-0.5_wp*film_ratio**2)/sqrt(2.0_wp*pi)
   end subroutine mean_gap

end module camroller_ehl_problem
