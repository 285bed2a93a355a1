!> Kernels of the contact in other units: the result must be the same quantity.
module test_unit_rescaling_contact
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_materials, only : combined_modulus, combined_roughness
   use camroller_lubricant, only : lubricant_t, oil_t, get_oil, relative_viscosity, mean_relative_viscosity
   use camroller_film, only : film_line_t, groups_t, film_law_names, new_film_line
   use camroller_asperity, only : asperity_t, asperity_constants_t, new_asperity_constants
   use camroller_load_share, only : share_t, share_load, improve_share
   use camroller_traction, only : rolling_law_names, cap_names, film_pressure, newtonian_shear, eyring_shear, &
      & limit_shear, mobilised_share, rolling_resistance, same_lengths
   use unit_systems, only : units_t, systems => unit_systems_tried, scaled, compare, number, length, area, speed, &
      & force, pressure, viscosity, per_pressure, temperature, drag, per_temperature, density
   implicit none
   private

   public :: collect_unit_rescaling_contact

   !> A contact at the nose [N], [m], [m], [Pa], [Pa s], [1/Pa], [m/s], [m/s]
   real(wp), parameter :: load = 741.0_wp, radius = 4.116e-3_wp, width = 13.7e-3_wp, modulus = 201.8e9_wp, &
      & eta = 0.0305_wp, alpha = 2.2e-8_wp, entrainment = 0.4884_wp, sliding = 3.1e-3_wp

contains

   subroutine collect_unit_rescaling_contact(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Hertz pressure and materials scale with the units", test_contact), &
         new_unittest("viscosity laws of Vogel, Barus and Cameron scale with the units", test_oil), &
         new_unittest("asperity load and area scale with the units", test_asperities), &
         new_unittest("load share scales with the units, for every film law", test_load_share), &
         new_unittest("shear of the film and its limit scale with the units", test_shear), &
         new_unittest("rolling resistance scales with the units, for every law", test_rolling), &
         new_unittest("a changed constant of Roelands or Walther is noticed", test_named_constants) &
         ]
   end subroutine collect_unit_rescaling_contact

   subroutine test_contact(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(systems)
         associate (u => systems(i))
            call compare(error, "half width", u, length, [half_width(load, radius, width, modulus)], &
               & [half_width(scaled(u, load, force), scaled(u, radius, length), scaled(u, width, length), &
               & scaled(u, modulus, pressure))])
            if (allocated(error)) return
            call compare(error, "peak pressure", u, pressure, [peak_pressure(load, radius, width, modulus)], &
               & [peak_pressure(scaled(u, load, force), scaled(u, radius, length), scaled(u, width, length), &
               & scaled(u, modulus, pressure))])
            if (allocated(error)) return
            call compare(error, "equivalent modulus", u, pressure, [combined_modulus(2.0e11_wp, 0.3_wp, 1.7e11_wp, &
               0.28_wp)], &
               & [combined_modulus(scaled(u, 2.0e11_wp, pressure), 0.3_wp, scaled(u, 1.7e11_wp, pressure), 0.28_wp)])
            if (allocated(error)) return
            call compare(error, "composite roughness", u, length, [combined_roughness(0.14e-6_wp, 0.2e-6_wp)], &
               & [combined_roughness(scaled(u, 0.14e-6_wp, length), scaled(u, 0.2e-6_wp, length))])
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_contact

   !> Oil in any units
   subroutine sample_oil(temperature_law, pressure_law, units, oil)
      !> Names of the laws
      character(len=*), intent(in) :: temperature_law, pressure_law
      !> The system
      type(units_t), intent(in) :: units
      type(oil_t), intent(out) :: oil
      type(error_t), allocatable :: failure
      type(lubricant_t) :: lubricant

      lubricant%temperature_law = temperature_law
      lubricant%pressure_law = pressure_law
      lubricant%viscosity = scaled(units, eta, viscosity)
      lubricant%pressure_viscosity = scaled(units, alpha, per_pressure)
      if (temperature_law == "vogel") then
         lubricant%temperature_points = scaled(units, [298.15_wp, 333.15_wp, 368.15_wp], temperature)
         lubricant%viscosity_points = scaled(units, [0.15_wp, 0.0305_wp, 0.01_wp], viscosity)
      else if (temperature_law == "walther") then
         lubricant%temperature_points = scaled(units, [313.15_wp, 373.15_wp], temperature)
         lubricant%viscosity_points = scaled(units, [0.09_wp, 0.01_wp], viscosity)
         lubricant%density = scaled(units, 870.0_wp, density)
         lubricant%thermal_expansion = scaled(units, 6.5e-4_wp, per_temperature)
      end if
      call get_oil(lubricant, scaled(units, 320.0_wp, temperature), oil, failure)
      if (allocated(failure)) oil%viscosity = -1.0_wp
   end subroutine sample_oil

   subroutine test_oil(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil, oil_in_units
      type(units_t) :: u
      character(len=7), parameter :: pressure_laws(2) = [character(len=7) :: "barus", "cameron"]
      real(wp) :: f(2), g(2)
      integer :: i, k

      do i = 1, size(systems)
         u = systems(i)
         do k = 1, 2
            call sample_oil("direct", pressure_laws(k), units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), oil)
            call sample_oil("direct", pressure_laws(k), u, oil_in_units)
            call relative_viscosity(oil, [4.0e8_wp], f(1:1), f(2:2))
            call relative_viscosity(oil_in_units, [scaled(u, 4.0e8_wp, pressure)], g(1:1), g(2:2))
            call compare(error, "relative viscosity", u, number, f, g)
            if (allocated(error)) return
            call mean_relative_viscosity(oil, 6.0e8_wp, f(1), f(2))
            call mean_relative_viscosity(oil_in_units, scaled(u, 6.0e8_wp, pressure), g(1), g(2))
            call compare(error, "mean relative viscosity", u, number, f, g)
            if (allocated(error)) return
         end do
         call sample_oil("vogel", "cameron", units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), oil)
         call sample_oil("vogel", "cameron", u, oil_in_units)
         ! the logarithm of a viscosity carries its unit: round-off of logarithms up to 30, in differences of up to 3
         call compare(error, "Vogel's law", u, viscosity, [oil%viscosity], [oil_in_units%viscosity], &
            round_off=1000.0_wp)
         if (allocated(error)) return
      end do
   end subroutine test_oil

   subroutine test_asperities(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants, constants_in_units
      type(units_t) :: u
      integer :: i

      do i = 1, size(systems)
         u = systems(i)
         call new_asperity_constants(constants, asperity_t(), modulus)
         call new_asperity_constants(constants_in_units, asperity_t(), scaled(u, modulus, pressure))
         call compare(error, "load factor", u, pressure, [constants%load_factor], [constants_in_units%load_factor])
         if (allocated(error)) return
         call compare(error, "area factor", u, number, [constants%area_factor], [constants_in_units%area_factor])
         if (allocated(error)) return
      end do
   end subroutine test_asperities

   !> Film and load share of the contact at the nose, in any units
   subroutine sample_share(law, units, share, improved)
      !> Place of the film law in the list of names
      integer, intent(in) :: law
      !> The system
      type(units_t), intent(in) :: units
      type(share_t), intent(out) :: share, improved
      type(asperity_constants_t) :: constants
      type(film_line_t) :: line
      type(groups_t) :: groups
      real(wp) :: contact_area, force_unit, change

      force_unit = scaled(units, modulus, pressure)*scaled(units, radius, length)*scaled(units, width, length)
      groups%speed = scaled(units, eta, viscosity)*scaled(units, entrainment, speed) &
         & /(scaled(units, modulus, pressure)*scaled(units, radius, length))
      groups%material = scaled(units, alpha, per_pressure)*scaled(units, modulus, pressure)
      groups%load = scaled(units, load, force)/force_unit
      groups%roughness = scaled(units, 0.2e-6_wp, length)/scaled(units, radius, length)
      groups%hardness = scaled(units, 7.0e9_wp, pressure)/scaled(units, modulus, pressure)
      call new_asperity_constants(constants, asperity_t(), scaled(units, modulus, pressure))
      contact_area = scaled(units, 1.4e-6_wp, area)/force_unit
      call new_film_line(line, law, groups)
      call share_load(line, groups%load, share, constants, contact_area)
      call improve_share(line, groups%load, improved, constants, contact_area, &
         1.01_wp*share%film_min/groups%roughness, change)
   end subroutine sample_share

   subroutine test_load_share(error)
      type(error_type), allocatable, intent(out) :: error
      type(share_t) :: p, q, p_improved, q_improved
      integer :: i, law

      do i = 1, size(systems)
         do law = 1, size(film_law_names)
            call sample_share(law, units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), p, p_improved)
            call sample_share(law, systems(i), q, q_improved)
            call compare(error, film_law_names(law), systems(i), number, &
               & [p%film_min, p%film_central, p%asperity_load, p%real_area_ratio, &
               & p_improved%film_min, p_improved%film_central, p_improved%asperity_load, p_improved%real_area_ratio], &
               & [q%film_min, q%film_central, q%asperity_load, q%real_area_ratio, &
               & q_improved%film_min, q_improved%film_central, q_improved%asperity_load, q_improved%real_area_ratio])
            if (allocated(error)) return
         end do
      end do
   end subroutine test_load_share

   subroutine test_shear(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil, oil_in_units
      type(units_t) :: u
      real(wp), parameter :: film = 0.12e-6_wp, contact_area = 1.4e-6_wp, peak = 6.0e8_wp
      real(wp) :: f, g, f_slope, g_slope, f_peak, g_peak
      integer :: i, k

      do i = 1, size(systems)
         u = systems(i)
         call compare(error, "film pressure", u, pressure, [film_pressure(load, contact_area, 1.0e-8_wp)], &
            & [film_pressure(scaled(u, load, force), scaled(u, contact_area, area), scaled(u, 1.0e-8_wp, area))])
         if (allocated(error)) return
         call compare(error, "Newtonian shear", u, force, [newtonian_shear(sliding, eta, contact_area, film)], &
            & [newtonian_shear(scaled(u, sliding, speed), scaled(u, eta, viscosity), scaled(u, contact_area, area), &
            & scaled(u, film, length))])
         if (allocated(error)) return
         call sample_oil("direct", "cameron", units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), oil)
         call sample_oil("direct", "cameron", u, oil_in_units)
         call eyring_shear(sliding, oil, peak, contact_area, film, 5.0e6_wp, f, f_slope, f_peak)
         call eyring_shear(scaled(u, sliding, speed), oil_in_units, scaled(u, peak, pressure), scaled(u, &
            contact_area, area), &
            & scaled(u, film, length), scaled(u, 5.0e6_wp, pressure), g, g_slope, g_peak)
         call compare(error, "Eyring shear", u, force, [f], [g])
         if (allocated(error)) return
         call compare(error, "slope of Eyring shear", u, drag, [f_slope], [g_slope])
         if (allocated(error)) return
         call compare(error, "pressure slope of Eyring shear", u, force, [f_peak], [g_peak])
         if (allocated(error)) return
         do k = 1, size(cap_names)
            f = 50.0_wp
            g = scaled(u, f, force)
            call limit_shear(k, 59.0_wp, f, f_slope, f_peak)
            call limit_shear(k, scaled(u, 59.0_wp, force), g, g_slope, g_peak)
            call compare(error, "limited shear", u, force, [f], [g])
            if (allocated(error)) return
            call compare(error, "slopes of limited shear", u, number, [f_slope, f_peak], [g_slope, g_peak])
            if (allocated(error)) return
         end do
         call compare(error, "mobilised share", u, number, [mobilised_share(sliding, 1.0e-3_wp)], &
            & [mobilised_share(scaled(u, sliding, speed), scaled(u, 1.0e-3_wp, speed))])
         if (allocated(error)) return
      end do
   end subroutine test_shear

   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t) :: u
      real(wp) :: speed_group, load_group, f, g, f_slope, g_slope
      integer :: i, k, law

      speed_group = eta*entrainment/(modulus*radius)
      do i = 1, size(systems)
         u = systems(i)
         do law = 1, size(rolling_law_names)
            do k = 1, 2
               ! the elastic and the rigid side
               load_group = load/(modulus*radius*width)*1.0e-2_wp**(k - 1)
               call rolling_resistance(law, speed_group, load_group, modulus, radius, same_lengths(width), alpha, f, f_slope)
               call rolling_resistance(law, speed_group, load_group, scaled(u, modulus, pressure), &
                  scaled(u, radius, length), same_lengths(scaled(u, width, length)), scaled(u, alpha, per_pressure), g, g_slope)
               call compare(error, rolling_law_names(law), u, force, [f], [g])
               if (allocated(error)) return
               call compare(error, rolling_law_names(law), u, number, [f_slope], [g_slope])
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_rolling

   !> Roelands' and Walther's laws hold constants with units, named in the source: changed units must show them.
   subroutine test_named_constants(error)
      type(error_type), allocatable, intent(out) :: error
      ! What `compare` says; its status is cleared, since it is no failure of the test
      type(error_type), allocatable :: expected
      type(oil_t) :: oil, oil_in_units
      type(units_t), parameter :: si = units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), u = units_t(16.0_wp, 1.0_wp, &
         1.0_wp, 1.0_wp)
      real(wp) :: f(2), g(2)

      call sample_oil("direct", "roelands", si, oil)
      call sample_oil("direct", "roelands", u, oil_in_units)
      call relative_viscosity(oil, [4.0e8_wp], f(1:1), f(2:2))
      call relative_viscosity(oil_in_units, [scaled(u, 4.0e8_wp, pressure)], g(1:1), g(2:2))
      call compare(expected, "Roelands", u, number, f, g, round_off=1.0e12_wp)
      call check(error, allocated(expected), "the reference pressure of Roelands' law is not noticed")
      if (allocated(error)) return
      expected%stat = 0
      call sample_oil("walther", "cameron", si, oil)
      call sample_oil("walther", "cameron", u, oil_in_units)
      call compare(expected, "Walther", u, viscosity, [oil%viscosity], [oil_in_units%viscosity], round_off=1.0e12_wp)
      call check(error, allocated(expected), "the constant of Walther's law is not noticed")
      if (allocated(expected)) expected%stat = 0
   end subroutine test_named_constants

end module test_unit_rescaling_contact
