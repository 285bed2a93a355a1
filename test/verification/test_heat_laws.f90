!> Laws of heat in inlet and contact, each by itself.
module test_heat_laws
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, two_pi
   use camroller_bessel, only : scaled_bessel_k
   use camroller_error, only : error_t
   use camroller_conjunction, only : hot_oil_t, body_t, band_t, sheared_film_t, film_shear_t, band_mean, new_band, &
      & flash_resistance, film_resistance, log_viscosity_change, hot_shear
   use camroller_heat, only : heat_t, heat_part_t, new_heat_part, set_heat_oil, inlet_factor, inlet_law_names, &
      & is_inlet_in_range, hot_oil_range, compare_hot_oil
   use camroller_lubricant, only : lubricant_t, oil_t, get_oil, pressure_law_names, law_cameron, law_roelands
   use camroller_names, only : index_of_name
   use camroller_traction, only : law_newtonian, law_eyring, cap_smooth, limit_shear
   use closeness, only : check_close, check_scaled, has_failed, roundings
   use labelled_table, only : label_length, read_table
   implicit none
   private

   public :: collect_heat_laws

contains

   subroutine collect_heat_laws(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Bessel functions K_0 and K_1 agree with tables, and both formulas where they meet", test_bessel), &
         new_unittest("temperature rise under a band and film with both inlet laws agree with Python", test_reference), &
         new_unittest("rises under fast uniform and Hertzian bands have the published factors: largest and mean", test_band), &
         new_unittest("slopes of band and inlet factor, and of the shear over temperature, agree with difference quotients", &
            & test_slopes), &
         new_unittest("the inlet factor continues smoothly beyond its range and stays positive", test_continuation), &
         new_unittest("a film heated uniformly is q h/(12 k) warmer in the mean and q h/(8 k) in the middle", test_film), &
         new_unittest("shear at the temperature that it causes agrees with Python for every shear law", test_shear), &
         new_unittest("the fitted viscosity change agrees with Vogel's law to round-off and Walther's to 0.3 % over 60 K", &
            & test_oils), &
         new_unittest("the oil of a hot film is the lubricant's to 1 % as far as it says, and not beyond", test_hot_range) &
         ]
   end subroutine collect_heat_laws

   subroutine test_bessel(error)
      type(error_type), allocatable, intent(out) :: error
      ! Abramowitz and Stegun (1964), table 9.8: e^x K_0(x), e^x K_1(x), and K_0(0.1), ten digits
      real(wp) :: zero(2), one(2)

      call scaled_bessel_k(0.1_wp, zero(1), one(1))
      call check_close(error, zero(1)*exp(-0.1_wp), 2.4270690247_wp, 1.0e-10_wp, "K_0(0.1)")
      if (allocated(error)) return
      call scaled_bessel_k(5.0_wp, zero(1), one(1))
      call check_close(error, zero(1), 0.5478075643_wp, 1.0e-9_wp, "e^5 K_0(5)")
      if (allocated(error)) return
      call check_close(error, one(1), 0.6002738587_wp, 1.0e-9_wp, "e^5 K_1(5)")
      if (allocated(error)) return
      ! e^x K_0 falls by 0.4 of its size per unit at 2
      call scaled_bessel_k([2.0_wp, nearest(2.0_wp, 1.0_wp)], zero, one)
      call check_close(error, zero(2), zero(1), roundings, "K_0 where the methods meet")
      if (allocated(error)) return
      call check_close(error, one(2), one(1), roundings, "K_1 where the methods meet")
   end subroutine test_bessel

   subroutine test_reference(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      ! Thermal loading, factors of Murch and Wilson and of Gupta and others there [-]
      real(wp), parameter :: loading(2) = [1.0_wp, 0.1_wp]
      real(wp), parameter :: printed(2, 2:3) = reshape([0.7976_wp, 0.9426_wp, 0.7918_wp, 0.9391_wp], [2, 2])
      ! Mean rise, factor and slopes [-]
      real(wp) :: mean, factor, slopes(3)
      integer :: i, law

      call read_table("heat_reference.csv", 4, rows, error, names)
      if (allocated(error)) return
      do i = 1, size(names)
         law = index_of_name(trim(names(i)), inlet_law_names)
         if (names(i) == "band") then
            call band_mean(rows(1, i), mean, slopes(1))
            ! quadrature of the reference; loss of figures in the closed form at small numbers
            call check_close(error, mean, rows(2, i), 1.0e-10_wp, "mean rise")
         else if (law > 0) then
            call inlet_factor(law, rows(1, i), 1.0_wp, rows(3, i), rows(2, i), factor, slopes(1), slopes(2), slopes(3))
            ! the slip's power is less by 5e-4 of 2.23 times up to 0.2 of the denominator
            call check_close(error, exp(factor), rows(4, i), 2.0e-4_wp, "factor by "//trim(names(i)))
            if (allocated(error)) return
            if (abs(rows(3, i)) <= 0.0_wp) call check_close(error, exp(factor), rows(4, i), 1.0e-12_wp, "factor without slip")
         end if
         if (allocated(error)) return
      end do
      ! as printed for p_H/E' = 0.003 and no slip, four digits
      do law = 2, 3
         do i = 1, 2
            call inlet_factor(law, loading(i), 1.0_wp, 0.0_wp, 0.003_wp, factor, slopes(1), slopes(2), slopes(3))
            call check_scaled(error, exp(factor), printed(i, law), 1.0_wp, 5.0e-5_wp, "factor by "//trim(inlet_law_names(law)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_reference

   subroutine test_band(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: peclet = 1.0e8_wp
      integer, parameter :: places = 2000
      ! Rise over q sqrt(2 b)/sqrt(k rho c V), largest and mean; place of the largest over b [-]
      real(wp) :: mean, slope, rise, largest, place, total, x
      integer :: i, k

      ! q b/k over q sqrt(2 b)/sqrt(k rho c V) is sqrt(V b/kappa)/sqrt(2)
      call band_mean(peclet, mean, slope)
      mean = mean*sqrt(0.5_wp*peclet)
      call check_scaled(error, 1.5_wp*mean, 1.1284_wp, 1.0_wp, 5.0e-5_wp, "largest rise of an even band")
      if (allocated(error)) return
      call check_close(error, slope, -0.5_wp, 1.0e-4_wp, "it falls with the root of the speed")
      if (allocated(error)) return
      ! A fast Hertzian band, mean flux 1: sum over what entered before, int q(x') dx'/sqrt(x - x')/sqrt(pi), b = 1, over sqrt(2)
      largest = 0.0_wp
      total = 0.0_wp
      do i = 1, places
         x = -1.0_wp + 2.0_wp*(i - 0.5_wp)/places
         rise = 0.0_wp
         do k = 1, 400
            ! x' = x - (x + 1) u^2: the root's singularity is gone
            rise = rise + 2.0_wp*sqrt(x + 1.0_wp)*hertz(x - (x + 1.0_wp)*((k - 0.5_wp)/400)**2)/400
         end do
         rise = rise/sqrt(two_pi)
         total = total + rise/places
         if (rise > largest) place = x
         largest = max(largest, rise)
      end do
      call check_scaled(error, largest, 1.1115_wp, 1.0_wp, 1.0e-4_wp, "largest rise of a Hertzian band")
      if (allocated(error)) return
      call check_scaled(error, place, 0.652_wp, 1.0_wp, 2.0e-3_wp, "its place")
      if (allocated(error)) return
      call check_scaled(error, total, 0.7662_wp, 1.0_wp, 1.0e-4_wp, "mean rise of a Hertzian band")
      if (allocated(error)) return
      ! what the even band of the model is worth against it
      call check_scaled(error, mean/total, 0.982_wp, 1.0_wp, 1.0e-3_wp, "even over Hertzian band")

   contains

      !> Flux of a Hertzian band whose mean is 1.
      elemental function hertz(place) result(flux)
         !> Place over the half width [-]
         real(wp), intent(in) :: place
         real(wp) :: flux

         flux = 8.0_wp/two_pi*sqrt(max(1.0_wp - place**2, 0.0_wp))
      end function hertz
   end subroutine test_band

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the differences, relative [-]: the cube root of round-off; what they leave, with curvatures of up to 10 [-]
      real(wp), parameter :: h = 6.0e-6_wp, tolerance = 2.0e-8_wp
      real(wp), parameter :: peclets(5) = [1.0e-3_wp, 2.9e-3_wp, 0.1_wp, 3.0_wp, 400.0_wp]
      ! Speed, sliding speed, p_H/E' [m/s], [m/s], [-]
      real(wp), parameter :: points(3, 4) = reshape([1.0_wp, 0.3_wp, 0.003_wp, -0.2_wp, 1.0e-3_wp, 0.001_wp, &
         & 5.0_wp, -4.0_wp, 0.004_wp, 20.0_wp, 1.0_wp, 0.006_wp], [3, 4])
      ! Values to both sides, slopes [any]
      real(wp) :: values(2), slope, unused(3), slopes(3), x(3), step(3)
      integer :: i, k, law
      type(band_t) :: band
      type(body_t) :: bodies(2)
      ! Speed of the band [m/s]
      real(wp) :: pace

      call new_band(band)
      bodies%conductivity = 1.0_wp
      bodies%diffusivity = 1.0_wp
      ! to beyond the values between which the cubics go, where the rise falls with the root of the speed
      do i = -37, 60
         ! two bodies of the same temperature halve the heat; the cubics' error grows with the fourth power of their length
         pace = exp(0.37_wp*i)
         call flash_resistance(band, bodies, 1.0_wp, [pace, -pace], values(1), slope, slopes(:2))
         call band_mean(pace, values(2), unused(1))
         call check_close(error, 2.0_wp*values(1), values(2), 1.0e-6_wp, "band between its values")
         if (allocated(error)) return
         call check_scaled(error, slope - 1.0_wp, unused(1), 1.0_wp, 1.0e-5_wp, "its slope over the width")
         if (allocated(error)) return
         call check_scaled(error, (slopes(1) - slopes(2))*pace, unused(1), 1.0_wp, 1.0e-5_wp, "its slopes over the speeds")
         if (allocated(error)) return
      end do
      do i = 1, size(peclets)
         call band_mean(peclets(i)*exp([-h, h]), values, unused(:2))
         call band_mean(peclets(i), unused(1), slope)
         call check_scaled(error, slope, log(values(2)/values(1))/(2.0_wp*h), 1.0_wp, tolerance, "slope of the band")
         if (allocated(error)) return
      end do
      do law = 2, 3
         do i = 1, size(points, 2)
            call inlet_factor(law, 0.3_wp, points(1, i), points(2, i), points(3, i), values(1), slopes(1), slopes(2), slopes(3))
            do k = 1, 3
               step = 0.0_wp
               step(k) = h*points(k, i)
               x = points(:, i) - step
               call inlet_factor(law, 0.3_wp, x(1), x(2), x(3), values(1), unused(1), unused(2), unused(3))
               x = points(:, i) + step
               call inlet_factor(law, 0.3_wp, x(1), x(2), x(3), values(2), unused(1), unused(2), unused(3))
               slope = slopes(k)
               if (k == 2) slope = slope*points(2, i)
               call check_scaled(error, slope, (values(2) - values(1))/(2.0_wp*h), 1.0_wp, tolerance, "slope of the inlet factor")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_slopes

   subroutine test_continuation(error)
      type(error_type), allocatable, intent(out) :: error
      ! Factors and slopes over the pressure below and above the change, and far beyond [-]
      real(wp) :: factor(3), slope(3), unused(2, 3)
      ! 13.2 (p_H/E') L^0.42 at L = 1 is a half, or ten
      real(wp), parameter :: change = 0.5_wp/13.2_wp, pressures(3) = [change*(1.0_wp - 1.0e-12_wp), change*(1.0_wp + 1.0e-12_wp), &
         & 10.0_wp/13.2_wp]

      call inlet_factor(3, 1.0_wp, 1.0_wp, 0.0_wp, pressures, factor, unused(1, :), unused(2, :), slope)
      call check_scaled(error, factor(2), factor(1), 1.0_wp, 1.0e-11_wp, "factor where the formula changes")
      if (allocated(error)) return
      call check_scaled(error, slope(2), slope(1), 1.0_wp, 1.0e-11_wp, "slope where the formula changes")
      if (allocated(error)) return
      call check_close(error, exp(factor(3)), 1.0_wp/40.0_wp/1.213_wp, roundings, "far beyond")
      if (allocated(error)) return
      call check(error, all(is_inlet_in_range(3, 1.0_wp, 1.0_wp, pressures) .eqv. [.true., .false., .false.]), "what is told")
   end subroutine test_continuation

   subroutine test_film(error)
      type(error_type), allocatable, intent(out) :: error
      ! Film [m], conductivity [W/(m K)], flux made evenly across it [W/m^2]
      real(wp), parameter :: film = 0.3e-6_wp, conductivity = 0.14_wp, flux = 1.0e7_wp
      integer, parameter :: layers = 1000
      ! Temperature in a layer by differences of -k T'' = q/h, T = 0 at both surfaces [K]
      real(wp) :: rise, total, middle, y
      integer :: i

      total = 0.0_wp
      middle = 0.0_wp
      do i = 1, layers
         y = (i - 0.5_wp)/layers
         rise = 0.5_wp*flux*film/conductivity*y*(1.0_wp - y)
         total = total + rise/layers
         middle = max(middle, rise)
      end do
      call check_close(error, flux*film_resistance(film, conductivity), total, 2.0e-6_wp, "mean of the film")
      if (allocated(error)) return
      call check_close(error, 1.5_wp*flux*film_resistance(film, conductivity), middle, 2.0e-6_wp, "middle of the film")
   end subroutine test_film

   subroutine test_shear(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(oil_t) :: oil
      type(body_t) :: bodies(2)
      type(band_t) :: band
      ! Bodies of the reference: conductivities [W/(m K)], densities [kg/m^3], heat capacities [J/(kg K)]
      real(wp), parameter :: conductivity(2) = [46.0_wp, 25.0_wp], density(2) = [7850.0_wp, 3200.0_wp], capacity(2) = [460.0_wp, &
         & 700.0_wp]
      ! Half width, film [m]; pressure in the middle [Pa]; limit of the stress [Pa]
      real(wp), parameter :: width = 60.0e-6_wp, film = 0.2e-6_wp, peak = 0.6e9_wp, limit = 0.02_wp*two_pi/2.0_wp*peak
      ! Rise per flux [m^2 K/W], slopes; stress [Pa]; relative step of the rise [-]
      real(wp) :: flash, unused, pair(2), stress, h
      ! Stress on one square metre with its slopes, on both sides
      type(film_shear_t) :: shear, beside(2)
      type(sheared_film_t) :: sheared
      type(hot_oil_t) :: hot
      integer :: i, law, k, rows_found

      call read_table("heat_reference.csv", 4, rows, error, names)
      if (allocated(error)) return
      bodies%conductivity = conductivity
      bodies%diffusivity = conductivity/(density*capacity)
      oil%viscosity = 0.03_wp
      oil%pressure_viscosity = 2.0e-8_wp
      oil%roelands_index = 0.65_wp
      oil%roelands_exponent = log(0.03_wp) + 9.67_wp
      call new_band(band)
      rows_found = 0
      do i = 1, size(names)
         do law = 1, size(pressure_law_names)
            if (index(names(i), trim(pressure_law_names(law))) == 1) exit
         end do
         if (law > size(pressure_law_names)) cycle
         rows_found = rows_found + 1
         oil%pressure_law = law
         hot = hot_oil_t(0.045_wp, 1.0_wp/150.0_wp, merge(0.0_wp, 0.002_wp, law == law_roelands))
         associate (shear_law => merge(law_eyring, law_newtonian, rows(1, i) > 0.0_wp), slip => rows(2, i), rise => rows(3, i))
            sheared = sheared_film_t(shear_law, slip, peak, 1.0_wp, film, rows(1, i))
            call hot_shear(sheared, oil, hot, rise, shear)
            stress = shear%force
            do k = 1, 2
               h = merge(-1.0e-5_wp, 1.0e-5_wp, k == 1)
               call hot_shear(sheared, oil, hot, rise*(1.0_wp + h), beside(k))
            end do
            ! rounding of the stress over the step beside the truncation
            call check_scaled(error, shear%by_rise*rise, (beside(2)%force - beside(1)%force)/2.0e-5_wp, abs(stress), 1.0e-9_wp, &
               & "slope over the rise, "//trim(names(i)))
            if (allocated(error)) return
            call limit_shear(cap_smooth, limit, stress, unused, pair(1))
            ! 24 points of quadrature where alpha p0 is 12 and the stress bends: 4e-8 at most
            call check_close(error, stress, rows(4, i), merge(1.0e-7_wp, 1.0e-11_wp, shear_law == law_eyring), &
               & "stress, "//trim(names(i)))
            if (allocated(error)) return
            call flash_resistance(band, bodies, width, 3.0_wp + [0.5_wp, -0.5_wp]*slip, flash, unused, pair)
            call check_close(error, slip*stress*(flash + film_resistance(film, 0.14_wp)), rise, 1.0e-6_wp, &
               & "rise, "//trim(names(i)))
            if (allocated(error)) return
         end associate
      end do
      call check(error, rows_found, 18)
   end subroutine test_shear

   subroutine test_oils(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(heat_part_t) :: part
      type(oil_t) :: oil, warm
      type(error_t), allocatable :: failure
      ! Change of ln(viscosity), its slope; its difference from the law, largest [-]
      real(wp) :: change, slope, largest
      integer :: i, law

      do law = 1, 2
         lubricant%temperature_law = merge("vogel  ", "walther", law == 1)
         lubricant%temperature_points = [298.15_wp, 333.15_wp, 368.15_wp]
         lubricant%viscosity_points = [0.15_wp, 0.0305_wp, 0.01_wp]
         if (law == 2) lubricant%temperature_points = [298.15_wp, 368.15_wp]
         if (law == 2) lubricant%viscosity_points = [0.15_wp, 0.01_wp]
         lubricant%pressure_viscosity = 2.2e-8_wp
         call get_oil(lubricant, 320.0_wp, oil, failure)
         call new_heat_part(part, heat_t(), failure)
         call set_heat_oil(part, lubricant, 320.0_wp, oil, failure)
         if (has_failed(failure, error)) return
         largest = 0.0_wp
         do i = 0, 60
            call get_oil(lubricant, 320.0_wp + i, warm, failure)
            call log_viscosity_change(part%hot, real(i, wp), change, slope)
            largest = max(largest, abs(change - log(warm%viscosity/oil%viscosity)))
         end do
         ! Vogel's law comes from differences of logarithms; Walther's by what was measured
         call check(error, largest < merge(1.0e-11_wp, 3.0e-3_wp, law == 1), trim(lubricant%temperature_law)//" is not met")
         if (allocated(error)) return
         call check_close(error, part%loading, part%hot%coefficient*oil%viscosity/0.14_wp, roundings, "L over the speed squared")
         if (allocated(error)) return
      end do
      ! Points of the pressure-viscosity coefficient, on one exponential, tell how it falls, whatever tells the viscosity
      lubricant%pressure_viscosity = 0.0_wp
      lubricant%pressure_viscosity_temperatures = [300.0_wp, 340.0_wp]
      lubricant%pressure_viscosity_points = 2.2e-8_wp*[1.0_wp, exp(-0.2_wp)]
      do law = 1, 2
         lubricant%temperature_law = merge("direct ", "walther", law == 1)
         lubricant%viscosity = 0.05_wp
         call get_oil(lubricant, 320.0_wp, oil, failure)
         call new_heat_part(part, heat_t(viscosity_fall=merge(0.03_wp, 0.0_wp, law == 1)), failure)
         call set_heat_oil(part, lubricant, 320.0_wp, oil, failure)
         if (has_failed(failure, error)) return
         call check_close(error, part%hot%pressure_fall, 0.2_wp/40.0_wp, roundings, "fall of the coefficient")
         if (allocated(error)) return
      end do
   end subroutine test_oils

   !> Vogel's law, one that is given at a temperature, Walther's with a coefficient that is constant, estimated, and estimated with
   !> Roelands' law; with that a coefficient given at one temperature says nothing of others.
   subroutine test_hot_range(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(heat_part_t) :: part
      type(oil_t) :: oil, own, warm
      type(error_t), allocatable :: failure
      ! Largest rise of each [K]; relative errors, change of ln(viscosity) [-], its slope [1/K]
      real(wp) :: ranges(6), errors(2), change, slope
      integer :: i
      logical :: has_law

      do i = 1, size(ranges)
         lubricant = lubricant_t(pressure_viscosity=merge(0.0_wp, 2.2e-8_wp, i == 4 .or. i == 5), &
            & pressure_law=pressure_law_names(merge(law_roelands, law_cameron, i > 4)))
         select case (i)
         case (1)
            lubricant%temperature_law = "vogel"
            lubricant%temperature_points = [298.15_wp, 333.15_wp, 368.15_wp]
            lubricant%viscosity_points = [0.15_wp, 0.0305_wp, 0.01_wp]
         case (2)
            lubricant%viscosity = 0.05_wp
         case default
            lubricant%temperature_law = "data_sheet"
            lubricant%sae_grade = "30"
         end select
         call get_oil(lubricant, 290.0_wp, oil, failure)
         call new_heat_part(part, heat_t(viscosity_fall=merge(0.03_wp, 0.0_wp, i == 2)), failure)
         call set_heat_oil(part, lubricant, 290.0_wp, oil, failure)
         if (has_failed(failure, error)) return
         ranges(i) = hot_oil_range(part, lubricant, oil)
         if (i < 3) call check(error, ranges(i) > merge(1.0e3_wp, 29.9_wp, i == 1), trim(lubricant%temperature_law)//" is not met")
         if (allocated(error) .or. i < 3) cycle
         call compare_hot_oil(part, lubricant, oil, ranges(i), errors, has_law)
         call check(error, has_law .and. maxval(abs(errors)) <= 0.01_wp, "an error within the range")
         if (allocated(error)) return
         call compare_hot_oil(part, lubricant, oil, ranges(i) + 0.7_wp, errors, has_law)
         call check(error, maxval(abs(errors)) > 0.01_wp, "no error beyond the range")
         if (allocated(error)) return
         call log_viscosity_change(part%hot, 100.0_wp, change, slope)
         call get_oil(lubricant, 390.0_wp, own, failure)
         call compare_hot_oil(part, lubricant, oil, 100.0_wp, errors, has_law)
         call check_close(error, 1.0_wp + errors(1), oil%viscosity*exp(change)/own%viscosity, roundings, "viscosity")
         if (allocated(error)) return
         warm%pressure_viscosity = oil%pressure_viscosity*exp(-100.0_wp*part%hot%pressure_fall)
         ! Z = alpha p_r/(ln eta0 + 9.67)
         if (i == 5) warm%pressure_viscosity = oil%pressure_viscosity*(1.0_wp + change/(log(oil%viscosity) + 9.67_wp))
         if (i == 6) own%pressure_viscosity = warm%pressure_viscosity
         call check_close(error, 1.0_wp + errors(2), warm%pressure_viscosity/own%pressure_viscosity, roundings, "coefficient")
         if (allocated(error)) return
      end do
      call check(error, ranges(3) > 30.0_wp .and. ranges(3) < 90.0_wp .and. ranges(4) < ranges(3), "Walther's law")
   end subroutine test_hot_range

end module test_heat_laws
