!> Systems of units for tests: a kernel must not notice in which units it is asked.
!>
!> A hidden dimensional constant in a formula shows when the units of length, mass, time and temperature change while
!> the physical case stays the same. With powers of two for the ratios of the units nothing is rounded, so results must
!> agree to the last bit; with powers of sixteen this holds behind square roots and fourth roots, too.
module unit_systems
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp
   implicit none
   private

   public :: units_t, dimension_t, unit_systems_tried, scaled, compare

   !> Dimension of a quantity: exponents of length, mass, time and temperature
   type :: dimension_t
      integer :: length, mass, time
      integer :: temperature = 0
   end type dimension_t

   !> Number of the system's units in one SI unit
   type :: units_t
      !> Length, mass, time, temperature [-]
      real(wp) :: length, mass, time, temperature
   end type units_t

   !> Each unit changed by itself, then all together
   type(units_t), parameter :: unit_systems_tried(*) = [ &
      units_t(16.0_wp**3, 1.0_wp, 1.0_wp, 1.0_wp), &
      units_t(1.0_wp, 16.0_wp**(-3), 1.0_wp, 1.0_wp), &
      units_t(1.0_wp, 1.0_wp, 16.0_wp**2, 1.0_wp), &
      units_t(1.0_wp, 1.0_wp, 1.0_wp, 16.0_wp**(-1)), &
      units_t(16.0_wp**(-2), 16.0_wp**2, 16.0_wp**(-3), 16.0_wp)]

   public :: number, angular_speed, length, area, speed, acceleration, mass, inertia, force, torque, power, &
      stiffness, pressure, &
      & viscosity, per_pressure, per_length, temperature, drag, per_speed, angular_acceleration, energy, density, per_temperature, &
      & conductivity, heat_capacity

   !> Dimensions of the quantities in use
   type(dimension_t), parameter :: number = dimension_t(0, 0, 0), angular_speed = dimension_t(0, 0, -1), &
      & length = dimension_t(1, 0, 0), area = dimension_t(2, 0, 0), per_length = dimension_t(-1, 0, 0), &
      & speed = dimension_t(1, 0, -1), acceleration = dimension_t(1, 0, -2), angular_acceleration = dimension_t(0, &
      0, -2), &
      & mass = dimension_t(0, 1, 0), inertia = dimension_t(2, 1, 0), density = dimension_t(-3, 1, 0), &
      & force = dimension_t(1, 1, -2), torque = dimension_t(2, 1, -2), energy = dimension_t(2, 1, -2), &
      & power = dimension_t(2, 1, -3), stiffness = dimension_t(0, 1, -2), drag = dimension_t(0, 1, -1), &
      & per_speed = dimension_t(-1, 0, 1), &
      & pressure = dimension_t(-1, 1, -2), viscosity = dimension_t(-1, 1, -1), per_pressure = dimension_t(1, -1, 2), &
      & temperature = dimension_t(0, 0, 0, 1), per_temperature = dimension_t(0, 0, 0, -1), &
      & conductivity = dimension_t(1, 1, -3, -1), heat_capacity = dimension_t(2, 0, -2, -1)

contains

   !> A value given in SI, in the units of a system.
   elemental function scaled(units, value, dimension) result(number_of_units)
      !> The system
      type(units_t), intent(in) :: units
      !> Value [SI]
      real(wp), intent(in) :: value
      !> Its dimension
      type(dimension_t), intent(in) :: dimension
      !> The same in the system's units
      real(wp) :: number_of_units

      number_of_units = value*units%length**dimension%length*units%mass**dimension%mass*units%time**dimension%time &
         & *units%temperature**dimension%temperature
   end function scaled

   !> Demand that results in SI and in a system of units mean the same.
   subroutine compare(error, name, units, dimension, in_si, in_units, round_off)
      !> Allocated where they do not
      type(error_type), allocatable, intent(out) :: error
      !> What is compared
      character(len=*), intent(in) :: name
      !> The system
      type(units_t), intent(in) :: units
      !> Dimension of the result
      type(dimension_t), intent(in) :: dimension
      !> Results of the kernel called with SI values
      real(wp), intent(in) :: in_si(:)
      !> Results of the kernel called with values in the system's units
      real(wp), intent(in) :: in_units(:)
      !> Relative difference allowed, in units of round-off; absent: none at all [-]
      real(wp), intent(in), optional :: round_off

      !> Difference allowed [SI]
      real(wp) :: allowed(size(in_si))
      character(len=120) :: text
      integer :: i

      allowed = 0.0_wp
      if (present(round_off)) allowed = round_off*epsilon(1.0_wp)*abs(scaled(units, in_si, dimension))
      do i = 1, size(in_si)
         if (abs(scaled(units, in_si(i), dimension) - in_units(i)) <= allowed(i)) cycle
         write (text, "(a,es24.17,a,es24.17)") " is ", in_units(i), " instead of ", scaled(units, in_si(i), dimension)
         call test_failed(error, name//trim(text)//": a hidden constant, or a wrong dimension")
         return
      end do
   end subroutine compare

end module unit_systems
