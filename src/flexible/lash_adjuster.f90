!> A hydraulic lash adjuster: plunger, chamber of aerated oil, leak along the plunger, check valve, stops.
!>
!> In: dimensions, pressure, travel and speed of the plunger. Out: bulk modulus, flows, force, with derivatives;
!> energies. Pressures are gauge. Source: Merritt, Hydraulic Control Systems (1967): flow in an annulus and through an orifice, bulk
!> modulus of oil that holds air; the air's pole at p = -p_a stands in for cavitation.
module camroller_lash_adjuster
   use camroller_kinds, only : wp, pi
   use camroller_names, only : name_length
   implicit none
   private

   public :: lash_adjuster_t, adjuster_t, flows_t, leak_end_names, ambient_pressure, new_adjuster, set_supply, set_adjuster_oil, &
      & relative_volume, bulk_modulus, pressure_work, evaluate_flows, opening_pressure, chamber_volume, adjuster_force, &
      & oil_energy

   !> Where the leak ends: inside, in the feed, or outside, where there is no pressure
   character(len=*), parameter :: leak_end_names(*) = [character(len=name_length) :: "feed", "ambient"]
   !> Pressure of the surroundings [Pa]
   real(wp), parameter :: ambient_pressure = 1.0e5_wp
   !> Gauge pressure of an oil gallery from idling to the relief valve [Pa]
   real(wp), parameter, public :: usual_supply(2) = [0.02e6_wp, 1.0e6_wp]
   !> Exponent of the air's change of state [-]
   real(wp), parameter :: polytropic = 1.4_wp

   !> Adjuster, as a deck has it
   type :: lash_adjuster_t
      !> Diameter of the plunger [m]
      real(wp) :: diameter = 10.0e-3_wp
      !> Volume of the chamber with the plunger in its middle place [m^3]
      real(wp) :: volume = 0.3e-6_wp
      !> Radial gap of the plunger [m]
      real(wp) :: gap = 5.0e-6_wp
      !> Its eccentricity over the gap [-]
      real(wp) :: eccentricity = 0.0_wp
      !> Length of the gap [m]
      real(wp) :: leak_length = 8.0e-3_wp
      !> Mass of the plunger [kg]
      real(wp) :: plunger_mass = 12.0e-3_wp
      !> Stiffness of the plunger's spring [N/m]
      real(wp) :: spring_stiffness = 800.0_wp
      !> Its force in the middle place; zero where the base circle load is given instead [N]
      real(wp) :: spring_force = 0.0_wp
      !> Area of the check valve [m^2]
      real(wp) :: check_area = 3.0e-6_wp
      !> Its discharge coefficient [-]
      real(wp) :: discharge_coefficient = 0.7_wp
      !> Pressure at which it opens, further pressure at which it is full open, pressure below which its flow is laminar [Pa]
      real(wp) :: crack_pressure = 5.0e3_wp, full_pressure = 20.0e3_wp, transition_pressure = 0.2e3_wp
      !> Supply pressure [Pa]
      real(wp) :: supply_pressure = 0.2e6_wp
      !> Volume of free air over that of oil and air, at ambient pressure [-]
      real(wp) :: air_content = 0.01_wp
      !> Bulk modulus of the oil without air [Pa]
      real(wp) :: oil_modulus = 1.4e9_wp
      !> Density of the oil with its air at ambient pressure [kg/m^3]
      real(wp) :: density = 850.0_wp
      !> Lower and upper stop of the plunger, from its middle place, towards the cam positive [m]
      real(wp) :: lowest = -1.5e-3_wp, highest = 1.0e-3_wp
      !> Stiffness of the stops [N/m] and their damping [s/m]
      real(wp) :: stop_stiffness = 5.0e7_wp, stop_damping = 1.0_wp
      !> One of `leak_end_names`
      character(len=name_length) :: leak_end = "feed"
   end type lash_adjuster_t

   !> Adjuster ready for evaluation
   type :: adjuster_t
      !> What is given
      type(lash_adjuster_t) :: given
      !> Area of the plunger, A_p [m^2]
      real(wp) :: area = 0.0_wp
      !> Force of the plunger's spring in the middle place, F_s0 [N]
      real(wp) :: spring_force = 0.0_wp
      !> Supply pressure as it is now, which a host program may change, and pressure where the leak ends, p_e [Pa]
      real(wp) :: supply_pressure = 0.0_wp, end_pressure = 0.0_wp
      !> Leak per pressure, G [m^3/(s Pa)]
      real(wp) :: conductance = 0.0_wp
      !> Drag of the plunger per speed, c_pl [N s/m]
      real(wp) :: drag = 0.0_wp
   end type adjuster_t

   !> Flows of oil and their derivatives
   type :: flows_t
      !> Through the check valve, into the chamber, and through the gap, out of it, at the chamber's density [m^3/s]
      real(wp) :: check = 0.0_wp, leak = 0.0_wp
      !> Their derivatives over the pressure [m^3/(s Pa)]
      real(wp) :: check_slope = 0.0_wp, leak_slope = 0.0_wp
      !> Opening of the check valve, 0 to 1 [-]
      real(wp) :: opening = 0.0_wp
   end type flows_t

contains

   !> Constants of an adjuster; the oil's are set apart.
   subroutine new_adjuster(adjuster, given)
      !> The adjuster
      type(adjuster_t), intent(out) :: adjuster
      !> What is given
      type(lash_adjuster_t), intent(in) :: given

      adjuster%given = given
      adjuster%area = 0.25_wp*pi*given%diameter**2
      adjuster%spring_force = given%spring_force
      call set_supply(adjuster, given%supply_pressure)
   end subroutine new_adjuster

   !> Set the supply pressure; a leak that ends in the feed ends at it.
   pure subroutine set_supply(adjuster, pressure)
      !> The adjuster
      type(adjuster_t), intent(inout) :: adjuster
      !> Gauge pressure of the supply [Pa]
      real(wp), intent(in) :: pressure

      adjuster%supply_pressure = pressure
      adjuster%end_pressure = merge(pressure, 0.0_wp, adjuster%given%leak_end == leak_end_names(1))
   end subroutine set_supply

   !> What depends on the oil's viscosity: leak `pi d h^3 (1 + 1.5 e^2)/(12 eta L)`, drag `eta pi d L/h`.
   pure subroutine set_adjuster_oil(adjuster, viscosity)
      !> The adjuster
      type(adjuster_t), intent(inout) :: adjuster
      !> Viscosity at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity

      associate (given => adjuster%given)
         adjuster%conductance = pi*given%diameter*given%gap**3*(1.0_wp + 1.5_wp*given%eccentricity**2) &
            & /(12.0_wp*viscosity*given%leak_length)
         adjuster%drag = viscosity*pi*given%diameter*given%leak_length/given%gap
      end associate
   end subroutine set_adjuster_oil

   !> Volume of oil and air over that at ambient pressure, `(1 - a0) exp(-p/K_l) + a0 (p_a/(p_a + p))^(1/n)`.
   elemental function relative_volume(given, pressure) result(volume)
      !> What is given
      type(lash_adjuster_t), intent(in) :: given
      !> Gauge pressure, above -p_a [Pa]
      real(wp), intent(in) :: pressure
      !> v [-]
      real(wp) :: volume

      volume = (1.0_wp - given%air_content)*exp(-pressure/given%oil_modulus) &
         & + given%air_content*(ambient_pressure/(ambient_pressure + pressure))**(1.0_wp/polytropic)
   end function relative_volume

   !> Bulk modulus of oil with air, `K = -v/v'`, and its derivative over the pressure.
   elemental subroutine bulk_modulus(given, pressure, modulus, slope)
      !> What is given
      type(lash_adjuster_t), intent(in) :: given
      !> Gauge pressure, above -p_a [Pa]
      real(wp), intent(in) :: pressure
      !> K [Pa]
      real(wp), intent(out) :: modulus
      !> Its derivative [-]
      real(wp), intent(out) :: slope

      ! Parts of oil and air [-], first and second derivative of the sum [1/Pa], [1/Pa^2]
      real(wp) :: oil, air, first, second

      oil = (1.0_wp - given%air_content)*exp(-pressure/given%oil_modulus)
      air = given%air_content*(ambient_pressure/(ambient_pressure + pressure))**(1.0_wp/polytropic)
      first = -oil/given%oil_modulus - air/(polytropic*(ambient_pressure + pressure))
      second = oil/given%oil_modulus**2 + air*(1.0_wp + polytropic)/(polytropic*(ambient_pressure + pressure))**2
      modulus = -(oil + air)/first
      slope = -1.0_wp + (oil + air)*second/first**2
   end subroutine bulk_modulus

   !> Work that a mass of oil with air takes to a pressure, per volume at ambient: `Pi = int_0^p v dp`.
   elemental function pressure_work(given, pressure) result(work)
      !> What is given
      type(lash_adjuster_t), intent(in) :: given
      !> Gauge pressure, above -p_a [Pa]
      real(wp), intent(in) :: pressure
      !> Pi [Pa]
      real(wp) :: work

      ! 1 - 1/n [-]
      real(wp), parameter :: power = 1.0_wp - 1.0_wp/polytropic

      work = (1.0_wp - given%air_content)*given%oil_modulus*(1.0_wp - exp(-pressure/given%oil_modulus)) &
         & + given%air_content*ambient_pressure*((1.0_wp + pressure/ambient_pressure)**power - 1.0_wp)/power
   end function pressure_work

   !> Leak and check valve at a pressure.
   !>
   !> `Q_cv = C_d A_cv a sqrt(2/rho) dp/(dp^2 + p_t^2)^(1/4)` with the opening `a = X^2 (3 - 2 X)`; rho = rho_0/v(p).
   elemental subroutine evaluate_flows(adjuster, pressure, flows)
      !> The adjuster
      type(adjuster_t), intent(in) :: adjuster
      !> Gauge pressure, above -p_a [Pa]
      real(wp), intent(in) :: pressure
      !> The flows
      type(flows_t), intent(out) :: flows

      ! Pressure difference [Pa], place of the ball and its derivative [-], [1/Pa]
      real(wp) :: difference, place, place_slope
      ! Orifice at full opening: speed [m/s], derivative over the difference [m/(s Pa)]
      real(wp) :: speed, speed_slope
      ! Volume of oil over that at ambient pressure [-], its derivative [1/Pa]; area [m^2]; bulk modulus [Pa], its derivative [-]
      real(wp) :: volume, volume_slope, area, modulus, slope

      associate (given => adjuster%given)
         flows%leak = adjuster%conductance*(pressure - adjuster%end_pressure)
         flows%leak_slope = adjuster%conductance
         difference = adjuster%supply_pressure - pressure
         place = (difference - given%crack_pressure)/given%full_pressure
         if (.not. place > 0.0_wp) return
         place_slope = -1.0_wp/given%full_pressure
         if (place >= 1.0_wp) then
            place = 1.0_wp
            place_slope = 0.0_wp
         end if
         flows%opening = place**2*(3.0_wp - 2.0_wp*place)
         area = given%discharge_coefficient*given%check_area*flows%opening
         volume = relative_volume(given, pressure)
         call bulk_modulus(given, pressure, modulus, slope)
         volume_slope = -volume/modulus
         speed = sqrt(2.0_wp*volume/given%density)*difference/sqrt(sqrt(difference**2 + given%transition_pressure**2))
         speed_slope = speed*(0.5_wp*volume_slope/volume - 1.0_wp/difference + 0.5_wp*difference/(difference**2 &
            & + given%transition_pressure**2))
         flows%check = area*speed
         flows%check_slope = area*speed_slope + given%discharge_coefficient*given%check_area*6.0_wp*place*(1.0_wp - place) &
            & *place_slope*speed
      end associate
   end subroutine evaluate_flows

   !> Pressure below which the check valve opens.
   elemental function opening_pressure(adjuster) result(pressure)
      !> The adjuster
      type(adjuster_t), intent(in) :: adjuster
      !> Gauge pressure [Pa]
      real(wp) :: pressure

      pressure = adjuster%supply_pressure - adjuster%given%crack_pressure
   end function opening_pressure

   !> Volume of the chamber at a place of the plunger.
   elemental function chamber_volume(adjuster, travel) result(volume)
      !> The adjuster
      type(adjuster_t), intent(in) :: adjuster
      !> y [m]
      real(wp), intent(in) :: travel
      !> V [m^3]
      real(wp) :: volume

      volume = adjuster%given%volume + adjuster%area*travel
   end function chamber_volume

   !> Force of oil, spring and drag on the plunger, towards the cam, `p A_p + F_s0 - k_pl y - c_pl yd`.
   elemental function adjuster_force(adjuster, travel, speed, pressure) result(force)
      !> The adjuster
      type(adjuster_t), intent(in) :: adjuster
      !> y [m]
      real(wp), intent(in) :: travel
      !> yd [m/s]
      real(wp), intent(in) :: speed
      !> Gauge pressure [Pa]
      real(wp), intent(in) :: pressure
      !> Force [N]
      real(wp) :: force

      force = pressure*adjuster%area + adjuster%spring_force - adjuster%given%spring_stiffness*travel - adjuster%drag*speed
   end function adjuster_force

   !> Energy that the oil in the chamber could give back, `V (Pi(p)/v(p) - p)`.
   elemental function oil_energy(adjuster, travel, pressure) result(energy)
      !> The adjuster
      type(adjuster_t), intent(in) :: adjuster
      !> y [m]
      real(wp), intent(in) :: travel
      !> Gauge pressure [Pa]
      real(wp), intent(in) :: pressure
      !> Energy [J]
      real(wp) :: energy

      energy = chamber_volume(adjuster, travel)*(pressure_work(adjuster%given, pressure)/relative_volume(adjuster%given, pressure) &
         & - pressure)
   end function oil_energy

end module camroller_lash_adjuster
