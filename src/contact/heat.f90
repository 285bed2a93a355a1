!> Heat in the contact of cam and roller: what a deck gives, what follows from it, and the film that a warm inlet leaves.
!>
!> In: constants of oil and bodies, the lubricant. Out: factor on the film by shear heating of the inlet, constants for the
!> temperature of the contact (`camroller_conjunction`). Sources: Murch and Wilson, J. Lubrication Technology 97 (1975) 212; Gupta,
!> Cheng, Zhu, Forster and Schrand, Tribology Transactions 35 (1992) 269.
module camroller_heat
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_number_text, only : number_text
   use camroller_lubricant, only : lubricant_t, oil_t, get_oil, density_at, temperature_law_names, law_direct, law_roelands
   use camroller_conjunction, only : hot_oil_t, body_t, band_t, new_band, warm_oil
   implicit none
   private

   public :: heat_t, heat_part_t, inlet_law_names, contact_heat_names, new_heat_part, set_heat_oil, inlet_factor, &
      & is_inlet_in_range, hot_oil_range, compare_hot_oil, largest_hot_oil_errors
   public :: exponential_range, inlet_none, inlet_murch_wilson, contact_heat_none

   !> Factor on the film by heating of the inlet
   character(len=*), parameter :: inlet_law_names(*) = [character(len=name_length) :: "none", "murch_wilson", "gupta"]
   !> Temperature that the film's shear is taken at: that of the oil around, or the mean over the contact
   character(len=*), parameter :: contact_heat_names(*) = [character(len=name_length) :: "none", "mean"]
   !> Positions in the lists of names
   integer, parameter :: inlet_none = 1, inlet_murch_wilson = 2, inlet_gupta = 3, contact_heat_none = 1

   !> What a deck gives
   type :: heat_t
      !> One of `inlet_law_names`
      character(len=name_length) :: inlet_law = "gupta"
      !> One of `contact_heat_names`
      character(len=name_length) :: contact = "mean"
      !> Thermal conductivity of the oil [W/(m K)]
      real(wp) :: oil_conductivity = 0.14_wp
      !> Fall of ln(viscosity) per kelvin; zero: by the lubricant's temperature law, where it has one [1/K]
      real(wp) :: viscosity_fall = 0.0_wp
      !> Fall of ln(limiting traction coefficient) per kelvin [1/K]
      real(wp) :: limit_fall = 0.0_wp
      !> Thermal conductivity of cam and roller [W/(m K)], their density [kg/m^3] and heat capacity [J/(kg K)]: steel
      real(wp) :: conductivity(2) = 46.0_wp, density(2) = 7850.0_wp, heat_capacity(2) = 460.0_wp
      !> Heat capacity of the oil; of solved contacts alone [J/(kg K)]
      real(wp) :: oil_heat_capacity = 2000.0_wp
   end type heat_t

   !> Ready for evaluation
   type :: heat_part_t
      !> Position in `inlet_law_names`
      integer :: inlet_law
      !> Is the film sheared at the temperature of the contact?
      logical :: has_contact
      !> Thermal conductivity of the oil [W/(m K)], its heat capacity over mass [J/(kg K)] and over volume [J/(m^3 K)], fall of its
      !> density per kelvin [1/K], temperature of the oil around [K]
      real(wp) :: oil_conductivity, oil_heat_capacity, oil_capacity, oil_expansion, temperature
      !> Fall of ln(viscosity) as given [1/K]; fall of ln(limiting traction coefficient) [1/K]
      real(wp) :: given_fall, limit_fall
      !> How the oil follows the temperature
      type(hot_oil_t) :: hot
      !> L over the square of the entrainment speed [s^2/m^2]
      real(wp) :: loading
      !> Cam and roller
      type(body_t) :: bodies(2)
      !> Mean rise over a band
      type(band_t) :: band
   end type heat_part_t

   !> Step between the temperatures that Vogel's law goes through, from that of the oil around on [K]
   real(wp), parameter :: temperature_step = 15.0_wp
   !> Relative error of viscosity or pressure-viscosity coefficient from which on the oil of a hot film is not that of the lubricant
   !> [-]; distance of the rises at which both are compared, and to what the rise is found [K]
   real(wp), parameter :: hot_oil_error = 0.01_wp, compared_step = 10.0_wp, compared_end = 0.25_wp
   !> Distance of the rises at which both are compared for their largest errors [K]
   real(wp), parameter :: close_step = 1.0_wp
   !> Rise of the temperature up to which a viscosity that falls exponentially will do: engine oils of 25 to 95 degC are 1.1 to 1.5
   !> times as thick there, and 1.3 to 4 times where it is twice as large [K]
   real(wp), parameter :: exponential_range = 30.0_wp
   !> How many rises are compared: beyond them no oil is left
   integer, parameter :: most_compared = 30
   !> Constants of Murch and Wilson: level and exponent of L [-]
   real(wp), parameter :: murch_level = 3.94_wp, murch_exponent = 0.62_wp
   !> Constants of Gupta and others: factor of the pressure and its exponent of L; factor of the load and its exponent of L; factor
   !> and exponent of the slip [-]
   real(wp), parameter :: pressure_factor = 13.2_wp, pressure_exponent = 0.42_wp, load_factor = 0.213_wp, &
      & load_exponent = 0.64_wp, slip_factor = 2.23_wp, slip_exponent = 0.83_wp
   !> Slip over mean speed below which its power is rounded off, since its slope has no bound at zero; the power changes by 5e-4 at
   !> most [-]
   real(wp), parameter :: least_slip = 1.0e-4_wp
   !> Fall by the pressure beyond which the printed `1 - x` goes on as `1/(4 x)`, with the same value and slope, and stays positive
   !> [-]
   real(wp), parameter :: largest_pressure_fall = 0.5_wp
   !> L below which the inlet is as cold as the oil around [-]
   real(wp), parameter :: least_loading = 1.0e-30_wp

contains

   !> Prepare what does not depend on the oil.
   subroutine new_heat_part(part, heat, error)
      !> Ready but for the oil
      type(heat_part_t), intent(out) :: part
      !> What a deck gives
      type(heat_t), intent(in) :: heat
      !> Deck error for an unknown name or constants that are not positive
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call find_name("law of heat in the inlet", heat%inlet_law, inlet_law_names, part%inlet_law, error)
      if (allocated(error)) return
      call find_name("heat in the contact", heat%contact, contact_heat_names, choice, error)
      if (allocated(error)) return
      part%has_contact = choice /= contact_heat_none
      if (.not. min(heat%oil_conductivity, heat%oil_heat_capacity, minval(heat%conductivity), minval(heat%density), &
         & minval(heat%heat_capacity)) > 0.0_wp) then
         call raise(error, kind_deck, "heat: conductivities, densities and heat capacities must be positive")
      else if (.not. min(heat%viscosity_fall, heat%limit_fall) >= 0.0_wp) then
         call raise(error, kind_deck, "heat: viscosity and limit of the traction must not rise with temperature")
      end if
      if (allocated(error)) return
      part%oil_conductivity = heat%oil_conductivity
      part%oil_heat_capacity = heat%oil_heat_capacity
      part%given_fall = heat%viscosity_fall
      part%limit_fall = heat%limit_fall
      part%bodies%conductivity = heat%conductivity
      part%bodies%diffusivity = heat%conductivity/(heat%density*heat%heat_capacity)
      if (part%has_contact) call new_band(part%band)
   end subroutine new_heat_part

   !> Make ready for an oil: Vogel's law through its viscosity at three temperatures, or an exponential where its fall is given.
   !>
   !> Vogel's own law comes out exactly; Walther's is met to 0.04 % of the viscosity up to 30 K and to 0.8 % up
   !> to 60 K for an SAE 30 from 25 degC on. The pressure-viscosity coefficient falls as the
   !> lubricant has it between the outer ones. `hot_oil_range` says how far this goes.
   subroutine set_heat_oil(part, lubricant, temperature, oil, error)
      !> Gets the oil
      type(heat_part_t), intent(inout) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Temperature of the oil around [K]
      real(wp), intent(in) :: temperature
      !> Oil there
      type(oil_t), intent(in) :: oil
      !> Deck error where nothing says how the viscosity falls; domain error beyond the range of the temperature law
      type(error_t), allocatable, intent(out) :: error

      type(oil_t) :: warm(2)
      ! Fall of ln(viscosity) per kelvin over one and two steps [1/K]
      real(wp) :: falls(2)
      integer :: i
      logical :: is_direct

      is_direct = lubricant%temperature_law == temperature_law_names(law_direct)
      part%hot = hot_oil_t(part%given_fall, 0.0_wp, 0.0_wp)
      if (is_direct .neqv. part%given_fall > 0.0_wp) then
         call raise(error, kind_deck, "heat: 'viscosity_fall_per_K' goes with lubricant temperature_law = 'direct', which "// &
            & "needs it; other laws have a fall of their own")
         return
      end if
      if (.not. is_direct) then
         do i = 1, size(warm)
            call get_oil(lubricant, temperature + i*temperature_step, warm(i), error)
            if (allocated(error)) then
               call add_context(error, "heat, up to "//number_text(size(warm)*temperature_step)//" K above the oil temperature")
               return
            end if
            falls(i) = log(oil%viscosity/warm(i)%viscosity)/(i*temperature_step)
         end do
         ! fall(T) = coefficient/(1 + bend T) at both temperatures
         part%hot%bend = max((falls(1) - falls(2))/(temperature_step*(2.0_wp*falls(2) - falls(1))), 0.0_wp)
         part%hot%coefficient = falls(1)*(1.0_wp + part%hot%bend*temperature_step)
         ! In the cold the estimate of the coefficient rises with the temperature, as no oil's does: shear would grow with heat
         if (oil%pressure_law /= law_roelands) part%hot%pressure_fall = &
            & max(log(oil%pressure_viscosity/warm(2)%pressure_viscosity)/(2.0_wp*temperature_step), 0.0_wp)
      else if (allocated(lubricant%pressure_viscosity_points) .and. oil%pressure_law /= law_roelands) then
         call get_oil(lubricant, temperature + 2.0_wp*temperature_step, warm(2), error)
         if (allocated(error)) return
         part%hot%pressure_fall = log(oil%pressure_viscosity/warm(2)%pressure_viscosity)/(2.0_wp*temperature_step)
      end if
      part%temperature = temperature
      part%oil_capacity = part%oil_heat_capacity*density_at(lubricant, temperature)
      part%oil_expansion = lubricant%thermal_expansion*lubricant%density/density_at(lubricant, temperature)
      part%loading = part%hot%coefficient*oil%viscosity/part%oil_conductivity
   end subroutine set_heat_oil

   !> Largest rise of the film's temperature with which its oil is that of the lubricant's own laws, to `hot_oil_error`; where one
   !> viscosity is given, an exponential through it has a range of its own.
   function hot_oil_range(part, lubricant, oil) result(good)
      !> Ready for this oil
      type(heat_part_t), intent(in) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> The rise; huge where none is too large [K]
      real(wp) :: good

      ! Rise, step to it [K]; relative errors [-]
      real(wp) :: rise, step, errors(2)
      logical :: has_law

      good = 0.0_wp
      step = compared_step
      do while (step > compared_end)
         rise = good + step
         call compare_hot_oil(part, lubricant, oil, rise, errors, has_law)
         if (has_law .and. maxval(abs(errors)) <= hot_oil_error) then
            good = rise
            if (good >= most_compared*compared_step) exit
         else
            step = 0.5_wp*step
         end if
      end do
      if (step > compared_end) good = huge(1.0_wp)
      if (lubricant%temperature_law == temperature_law_names(law_direct)) good = min(good, exponential_range)
   end function hot_oil_range

   !> How far the oil of a film that is warmer than the oil around is from the lubricant's own law.
   subroutine compare_hot_oil(part, lubricant, oil, rise, errors, has_law)
      !> Ready for this oil
      type(heat_part_t), intent(in) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> Rise of the film's temperature [K]
      real(wp), intent(in) :: rise
      !> Relative errors of the viscosity at ambient pressure and of the pressure-viscosity coefficient, which with Roelands' law
      !> follows from the viscosity, by the index of the oil around; of what has no law none [-]
      real(wp), intent(out) :: errors(2)
      !> Has the lubricant's law a value there?
      logical, intent(out) :: has_law

      type(oil_t) :: warm, own
      type(error_t), allocatable :: failure
      ! Change of ln(viscosity) [-], its slope [1/K]
      real(wp) :: change, slope

      errors = 0.0_wp
      call get_oil(lubricant, part%temperature + rise, own, failure)
      has_law = .not. allocated(failure)
      if (.not. has_law) return
      call warm_oil(part%hot, oil, rise, warm, change, slope)
      ! A viscosity that is given holds at the oil's temperature alone
      if (lubricant%temperature_law /= temperature_law_names(law_direct)) errors(1) = warm%viscosity/own%viscosity - 1.0_wp
      if (oil%pressure_law /= law_roelands) then
         errors(2) = warm%pressure_viscosity/own%pressure_viscosity - 1.0_wp
      else if (own%is_estimated .or. allocated(lubricant%pressure_viscosity_points)) then
         errors(2) = oil%pressure_viscosity*warm%roelands_exponent/oil%roelands_exponent/own%pressure_viscosity - 1.0_wp
      end if
   end subroutine compare_hot_oil

   !> How far the oil of a warmer film is from the lubricant's own law at most on the way to a rise: errors need not grow with it.
   subroutine largest_hot_oil_errors(part, lubricant, oil, rise, errors, has_law)
      !> Ready for this oil
      type(heat_part_t), intent(in) :: part
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> Rise of the film's temperature [K]
      real(wp), intent(in) :: rise
      !> Relative errors as of `compare_hot_oil`, those of the largest size [-]
      real(wp), intent(out) :: errors(2)
      !> Has the lubricant's law a value all the way?
      logical, intent(out) :: has_law

      real(wp) :: here(2) ! errors at a rise [-]
      integer :: i, steps

      errors = 0.0_wp
      has_law = .true.
      steps = ceiling(rise/close_step)
      do i = 1, steps
         call compare_hot_oil(part, lubricant, oil, rise*i/steps, here, has_law)
         if (.not. has_law) return
         where (abs(here) > abs(errors)) errors = here
      end do
   end subroutine largest_hot_oil_errors

   !> Factor on the film by shear heating of the inlet, with its slopes: by `L = beta eta0 u^2/k_oil`, with Gupta and others by
   !> `S = V_s/u` and the pressure, too.
   !>
   !> Murch and Wilson: `3.94/(3.94 + L^0.62)`. Gupta and others: `[1 - 13.2 (p_H/E') L^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L^0.64]`.
   elemental subroutine inlet_factor(law, loading, speed, sliding_speed, pressure, log_factor, by_speed, by_sliding, by_pressure)
      !> Position in `inlet_law_names`
      integer, intent(in) :: law
      !> L over the square of the speed [s^2/m^2]
      real(wp), intent(in) :: loading
      !> Mean surface speed, u, and sliding speed, V_s [m/s]
      real(wp), intent(in) :: speed, sliding_speed
      !> Peak pressure of the dry contact over E', p_H/E' [-]
      real(wp), intent(in) :: pressure
      !> ln of the factor [-]
      real(wp), intent(out) :: log_factor
      !> Its derivatives over ln|u| [-], over V_s [s/m] and over ln(p_H) [-]
      real(wp), intent(out) :: by_speed, by_sliding, by_pressure

      ! L; slip over mean speed; its power, rounded off, and derivative of that over the slip [-]
      real(wp) :: load, slip, power, power_slope
      ! L^0.64, or L^0.62; denominator; fall by the pressure and logarithmic slope of the numerator over it [-]
      real(wp) :: grown, below, fall, fall_slope

      log_factor = 0.0_wp
      by_speed = 0.0_wp
      by_sliding = 0.0_wp
      by_pressure = 0.0_wp
      load = loading*speed**2
      if (load < least_loading) return
      select case (law)
      case (inlet_murch_wilson)
         grown = load**murch_exponent
         log_factor = -log(1.0_wp + grown/murch_level)
         by_speed = -2.0_wp*murch_exponent*grown/(murch_level + grown)
      case (inlet_gupta)
         slip = sliding_speed/abs(speed)
         power = (slip**2 + least_slip**2)**(0.5_wp*slip_exponent)
         power_slope = slip_exponent*slip*power/(slip**2 + least_slip**2)
         power = power - least_slip**slip_exponent
         grown = load_factor*load**load_exponent
         below = 1.0_wp + (1.0_wp + slip_factor*power)*grown
         fall = pressure_factor*pressure*load**pressure_exponent
         if (fall <= largest_pressure_fall) then
            log_factor = log(1.0_wp - fall)
            fall_slope = -fall/(1.0_wp - fall)
         else
            log_factor = -log(4.0_wp*fall)
            fall_slope = -1.0_wp
         end if
         log_factor = log_factor - log(below)
         by_pressure = fall_slope
         by_sliding = -slip_factor*power_slope*grown/(below*abs(speed))
         by_speed = 2.0_wp*(pressure_exponent*fall_slope - load_exponent*(below - 1.0_wp)/below) - by_sliding*sliding_speed
      end select
   end subroutine inlet_factor

   !> Does the factor of the inlet stand as printed, or does its continuation count?
   elemental function is_inlet_in_range(law, loading, speed, pressure) result(inside)
      !> Position in `inlet_law_names`
      integer, intent(in) :: law
      !> L over the square of the speed [s^2/m^2]
      real(wp), intent(in) :: loading
      !> Mean surface speed, u [m/s]
      real(wp), intent(in) :: speed
      !> Peak pressure of the dry contact over E', p_H/E' [-]
      real(wp), intent(in) :: pressure
      !> True as printed
      logical :: inside

      inside = .true.
      if (law == inlet_gupta) inside = pressure_factor*pressure*(loading*speed**2)**pressure_exponent <= largest_pressure_fall
   end function is_inlet_in_range

end module camroller_heat
