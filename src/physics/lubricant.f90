module camroller_lubricant
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: lubricant_t, temperature_law_names, pressure_law_names

   !> Viscosity over temperature
   character(len=*), parameter :: temperature_law_names(*) = [character(len=name_length) :: "direct", "vogel", "walther"]
   !> Viscosity over pressure
   character(len=*), parameter :: pressure_law_names(*) = [character(len=name_length) :: "barus", "cameron", "roelands"]

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
      !> Density at 15 degC [kg/m^3]; `walther`
      real(wp) :: density = 870.0_wp
      !> Thermal expansion of the density [1/K]; `walther`
      real(wp) :: thermal_expansion = 6.5e-4_wp
      !> One of `pressure_law_names`
      character(len=name_length) :: pressure_law = "cameron"
      !> Pressure-viscosity coefficient at ambient pressure [1/Pa]; zero: derived from `roelands_index`
      real(wp) :: pressure_viscosity = 0.0_wp
      !> Roelands' index Z [-]; zero: derived from the pressure-viscosity coefficient
      real(wp) :: roelands_index = 0.0_wp
   end type lubricant_t

end module camroller_lubricant
