!> Oil: laws through their points, closed forms of the pressure laws, the mean over a contact, refusals.
module test_lubricant
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_quadrature, only : gauss_legendre
   use camroller_lubricant, only : lubricant_t, oil_t, pressure_law_names, get_oil, relative_viscosity, mean_relative_viscosity, &
      law_barus, law_cameron, law_roelands
   use camroller_oil_data, only : reference_viscosities, sae_grade_names, so_klaus_coefficient, viscosity_at_40
   implicit none
   private

   public :: collect_lubricant

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)
   !> Temperatures and viscosities of an engine oil: 25, 60 and 95 degC [K], [Pa s]
   real(wp), parameter :: temperatures(3) = [298.15_wp, 333.15_wp, 368.15_wp], viscosities(3) = [0.15_wp, 0.0305_wp, 0.01_wp]

contains

   subroutine collect_lubricant(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Vogel's law passes through its three points", test_vogel_points), &
         new_unittest("Vogel's law is found again from points on it", test_vogel_constants), &
         new_unittest("Walther's law passes through its two points and is the straight line of ASTM D341", test_walther), &
         new_unittest("pressure laws have their closed forms", test_pressure_laws), &
         new_unittest("a viscosity that is held below overflow has no slope over the pressure", test_held), &
         new_unittest("every pressure law begins with the same slope", test_initial_slope), &
         new_unittest("Roelands' index and the coefficient give each other", test_roelands_index), &
         new_unittest("mean over the contact agrees with quadrature", test_mean), &
         new_unittest("mean over the contact has its closed form in Barus' first two powers", test_mean_expansion), &
         new_unittest("the viscosity index has its table and its joints", test_viscosity_index), &
         new_unittest("a data sheet is Walther's law through its two viscosities", test_data_sheet), &
         new_unittest("a grade and an index come to the viscosities they stand for", test_grades), &
         new_unittest("So and Klaus' coefficient has the size of measured ones and falls with temperature", test_so_klaus), &
         new_unittest("pressure-viscosity coefficients as points: met, geometric mean between, same fall beyond", &
            & test_coefficient_points), &
         new_unittest("oils that cannot be are refused in words", test_refusals) &
         ]
   end subroutine collect_lubricant

   !> An engine oil given by points.
   function given_oil(law, points) result(lubricant)
      character(len=*), intent(in) :: law
      integer, intent(in) :: points
      type(lubricant_t) :: lubricant

      lubricant%temperature_law = law
      lubricant%temperature_points = temperatures(:points)
      lubricant%viscosity_points = viscosities(:points)
      lubricant%pressure_viscosity = 2.2e-8_wp
   end function given_oil

   !> An oil of one viscosity.
   subroutine make_oil(law, oil)
      integer, intent(in) :: law
      type(oil_t), intent(out) :: oil
      type(lubricant_t) :: lubricant
      type(error_t), allocatable :: failure

      lubricant%viscosity = 0.0305_wp
      lubricant%pressure_viscosity = 2.2e-8_wp
      lubricant%pressure_law = pressure_law_names(law)
      call get_oil(lubricant, 333.15_wp, oil, failure)
      if (allocated(failure)) error stop "a valid oil is refused"
   end subroutine make_oil

   subroutine test_vogel_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 3
         call get_oil(given_oil("vogel", 3), temperatures(i), oil, failure)
         if (allocated(failure)) call test_failed(error, failure%message)
         if (allocated(error)) return
         ! the exponent is about 10, and its constants come from differences
         call check(error, oil%viscosity, viscosities(i), thr=1.0e-12_wp, rel=.true.)
         if (allocated(error)) return
      end do
   end subroutine test_vogel_points

   subroutine test_vogel_constants(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      type(error_t), allocatable :: failure

      ! ln eta = -9 + 900/(T - 170 K)
      lubricant = given_oil("vogel", 3)
      lubricant%viscosity_points = exp(-9.0_wp + 900.0_wp/(temperatures - 170.0_wp))
      call get_oil(lubricant, 410.0_wp, oil, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      call check(error, oil%viscosity, exp(-9.0_wp + 3.75_wp), thr=1.0e-12_wp, rel=.true.)
   end subroutine test_vogel_constants

   subroutine test_viscosity_index(error)
      type(error_type), allocatable, intent(out) :: error
      ! Viscosity at 100 degC; those at 40 degC for index 0 and 100 in the table of ASTM D2270 [mm^2/s]
      real(wp), parameter :: at_100(3) = [5.0_wp, 10.0_wp, 20.0_wp], none(3) = [40.23_wp, 147.7_wp, 493.2_wp], &
         & hundred(3) = [28.49_wp, 82.87_wp, 229.5_wp]
      ! Joints of the equations; values on both sides of one [mm^2/s]
      real(wp), parameter :: joints(*) = [3.8_wp, 4.4_wp, 5.0_wp, 6.4_wp, 7.0_wp, 7.7_wp, 9.0_wp, 12.0_wp, 15.0_wp, 18.0_wp, &
         & 22.0_wp, 28.0_wp, 40.0_wp, 55.0_wp, 70.0_wp]
      real(wp) :: below(2), above(2)
      integer :: i

      do i = 1, size(at_100)
         call reference_viscosities(at_100(i), above(1), above(2))
         ! the equations give the table to its last digit or the one before
         call check(error, above(1), none(i), thr=2.0e-3_wp, rel=.true.)
         if (.not. allocated(error)) call check(error, above(2), hundred(i), thr=2.0e-3_wp, rel=.true.)
         if (allocated(error)) return
      end do
      do i = 1, size(joints)
         call reference_viscosities(joints(i), above(1), above(2))
         call reference_viscosities(joints(i)*(1.0_wp - epsilon(1.0_wp)), below(1), below(2))
         ! pieces are fitted each for itself: they meet to 0.3 %
         if (any(abs(below/above - 1.0_wp) > 3.0e-3_wp)) call test_failed(error, "a joint of the viscosity index is open")
         if (allocated(error)) return
      end do
      ! ASTM D2270, example of procedure B: 22.83 and 5.05 mm^2/s have index 156
      call check(error, viscosity_at_40(5.05_wp, 156.0_wp), 22.83_wp, thr=2.0e-3_wp, rel=.true.)
      if (allocated(error)) return
      ! Procedure A: 73.30 and 8.86 mm^2/s have index 92
      call check(error, viscosity_at_40(8.86_wp, 92.0_wp), 73.30_wp, thr=5.0e-3_wp, rel=.true.)
   end subroutine test_viscosity_index

   subroutine test_data_sheet(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: sheet, points
      type(oil_t) :: oil, other
      type(error_t), allocatable :: failure
      ! Densities at 40 and 100 degC [kg/m^3]
      real(wp) :: densities(2)

      sheet%temperature_law = "data_sheet"
      sheet%viscosity_at_40 = 64.0e-6_wp
      sheet%viscosity_at_100 = 11.0e-6_wp
      sheet%density = 855.0_wp
      sheet%pressure_viscosity = 2.0e-8_wp
      densities = 855.0_wp*(1.0_wp - sheet%thermal_expansion*[25.0_wp, 85.0_wp])
      points = sheet
      points%temperature_law = "walther"
      points%temperature_points = [313.15_wp, 373.15_wp]
      points%viscosity_points = [64.0e-6_wp, 11.0e-6_wp]*densities
      call get_oil(sheet, 313.15_wp, oil, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      call check(error, oil%viscosity, 64.0e-6_wp*densities(1), thr=roundings, rel=.true.)
      if (allocated(error)) return
      call get_oil(sheet, 353.15_wp, oil, failure)
      if (.not. allocated(failure)) call get_oil(points, 353.15_wp, other, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (.not. allocated(error)) call check(error, oil%viscosity, other%viscosity, thr=roundings, rel=.true.)
   end subroutine test_data_sheet

   subroutine test_grades(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: sheet
      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      ! Kinematic viscosities [m^2/s]
      real(wp) :: thick, thin
      integer :: i

      sheet%temperature_law = "data_sheet"
      sheet%viscosity_at_100 = 5.05e-6_wp
      sheet%viscosity_index = 156.0_wp
      sheet%thermal_expansion = 0.0_wp
      call get_oil(sheet, 313.15_wp, oil, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      call check(error, oil%viscosity/sheet%density, 22.83e-6_wp, thr=2.0e-3_wp, rel=.true.)
      if (allocated(error)) return
      sheet%viscosity_at_100 = 0.0_wp
      sheet%viscosity_index = 0.0_wp
      do i = 2, size(sae_grade_names)
         sheet%sae_grade = sae_grade_names(i)
         call get_oil(sheet, 373.15_wp, oil, failure)
         if (allocated(failure)) call test_failed(error, failure%message)
         if (allocated(error)) return
         thin = oil%viscosity/sheet%density
         call get_oil(sheet, 313.15_wp, oil, failure)
         if (allocated(failure)) call test_failed(error, failure%message)
         if (allocated(error)) return
         thick = oil%viscosity/sheet%density
         ! SAE J300: 6.1 to 26.1 mm^2/s at 100 degC; engine oils are four to fourteen times as viscous at 40 degC
         if (thin < 6.1e-6_wp .or. thin > 26.1e-6_wp .or. thick < 4.0_wp*thin .or. thick > 14.0_wp*thin) then
            call test_failed(error, "grade "//trim(sheet%sae_grade)//" is no engine oil")
            return
         end if
      end do
   end subroutine test_grades

   subroutine test_so_klaus(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: sheet
      type(oil_t) :: cold, hot
      type(error_t), allocatable :: failure

      ! By hand: log10 100 = 2, slope 3.5, 870 kg/m^3
      call check(error, so_klaus_coefficient(100.0_wp, 3.5_wp, 870.0_wp), 1.0e-8_wp*(1.216_wp + 4.143_wp*2.0_wp**3.0627_wp &
         & + 2.848e-4_wp*3.5_wp**5.1903_wp*2.0_wp**1.5976_wp - 3.999_wp*2.0_wp**3.0975_wp*0.87_wp**0.1162_wp), &
         & thr=roundings, rel=.true.)
      if (allocated(error)) return
      sheet%temperature_law = "data_sheet"
      sheet%sae_grade = "10W-40"
      call get_oil(sheet, 313.15_wp, cold, failure)
      if (.not. allocated(failure)) call get_oil(sheet, 393.15_wp, hot, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      if (.not. (cold%is_estimated .and. hot%is_estimated)) call test_failed(error, "an estimate is not called one")
      ! Mineral engine oils have 15 to 30 1/GPa at 40 degC and 9 to 18 at 120 degC
      if (cold%pressure_viscosity < 1.5e-8_wp .or. cold%pressure_viscosity > 3.0e-8_wp) call test_failed(error, "cold estimate")
      if (hot%pressure_viscosity < 0.9e-8_wp .or. hot%pressure_viscosity > 1.8e-8_wp) call test_failed(error, "hot estimate")
      if (allocated(error)) return
      sheet%pressure_viscosity = 2.0e-8_wp
      call get_oil(sheet, 313.15_wp, cold, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      if (cold%is_estimated) call test_failed(error, "a given coefficient is called an estimate")
      sheet%pressure_viscosity = 0.0_wp
      ! Below 2 mm^2/s the estimate is refused
      call get_oil(sheet, 573.15_wp, hot, failure)
      if (.not. allocated(error)) call check(error, allocated(failure), "an estimate far outside of its data was made")
      if (allocated(error)) return
      call check(error, failure%kind == kind_domain .and. index(failure%message, "is estimated for 2 mm^2/s and more") > 0, &
         & failure%message)
      if (allocated(error)) return
      ! For an oil of 9e4 mm^2/s the formula is below zero
      sheet%sae_grade = "20W-50"
      call get_oil(sheet, 243.15_wp, cold, failure)
      call check(error, allocated(failure), "an estimate below zero")
      if (allocated(error)) return
      call check(error, failure%kind == kind_domain .and. index(failure%message, "is below zero for an oil as thick as") > 0, &
         & failure%message)
   end subroutine test_so_klaus

   subroutine test_coefficient_points(error)
      type(error_type), allocatable, intent(out) :: error
      ! [K], [1/Pa]
      real(wp), parameter :: places(3) = [300.0_wp, 320.0_wp, 380.0_wp], points(3) = [2.4e-8_wp, 2.0e-8_wp, 1.4e-8_wp]
      ! Temperatures [K] and what the coefficient is there [1/Pa]: at the points, in the middle between them, before and beyond
      real(wp), parameter :: tried(7) = [300.0_wp, 320.0_wp, 380.0_wp, 310.0_wp, 350.0_wp, 280.0_wp, 440.0_wp]
      real(wp), parameter :: expected(7) = [points, sqrt(points(1)*points(2)), sqrt(points(2)*points(3)), &
         & points(1)**2/points(2), points(3)**2/points(2)]
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      integer :: i, law

      lubricant%viscosity = 0.0305_wp
      lubricant%pressure_viscosity_temperatures = places
      lubricant%pressure_viscosity_points = points
      do law = 1, size(pressure_law_names)
         lubricant%pressure_law = pressure_law_names(law)
         do i = 1, size(tried)
            call get_oil(lubricant, tried(i), oil, failure)
            if (allocated(failure)) call test_failed(error, failure%message)
            if (allocated(error)) return
            call check(error, oil%pressure_viscosity, expected(i), thr=roundings, rel=.true.)
            if (allocated(error)) return
            call check(error, .not. oil%is_estimated, "given points are called an estimate")
            if (allocated(error)) return
         end do
      end do
      lubricant%pressure_viscosity_points = points(3:1:-1)
      call refused(lubricant, 333.15_wp, kind_deck, "must not rise", error)
      if (allocated(error)) return
      lubricant%pressure_viscosity_points = points(:2)
      call refused(lubricant, 333.15_wp, kind_deck, "two points or more", error)
      if (allocated(error)) return
      lubricant%pressure_viscosity_points = points
      lubricant%pressure_viscosity_temperatures = places([1, 3, 2])
      call refused(lubricant, 333.15_wp, kind_deck, "must increase", error)
   end subroutine test_coefficient_points

   subroutine test_walther(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      ! Kinematic viscosity plus 0.7, its double logarithm; mean of the logarithms of the temperatures [mm^2/s, -]
      real(wp) :: shifted(3), double_log(3), middle
      integer :: i

      lubricant = given_oil("walther", 2)
      middle = sqrt(temperatures(1)*temperatures(2))
      do i = 1, 3
         call get_oil(lubricant, merge(middle, temperatures(min(i, 2)), i == 3), oil, failure)
         if (allocated(failure)) call test_failed(error, failure%message)
         if (allocated(error)) return
         if (i < 3) call check(error, oil%viscosity, viscosities(i), thr=1.0e-12_wp, rel=.true.)
         if (allocated(error)) return
         shifted(i) = oil%viscosity/(lubricant%density*(1.0_wp - lubricant%thermal_expansion &
            *(merge(middle, temperatures(min(i, 2)), i == 3) - 288.15_wp)))*1.0e6_wp + 0.7_wp
      end do
      ! log log(nu + 0.7) is linear in log T
      double_log = log10(log10(shifted))
      call check(error, double_log(3), 0.5_wp*(double_log(1) + double_log(2)), thr=1.0e-12_wp, rel=.true.)
   end subroutine test_walther

   subroutine test_pressure_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      real(wp) :: ratio(1), slope(1)
      ! alpha p = 11 at 0.5 GPa [-]
      real(wp), parameter :: pressure = 0.5e9_wp, exponent = 11.0_wp

      call make_oil(law_barus, oil)
      call relative_viscosity(oil, [pressure], ratio, slope)
      call check(error, ratio(1), exp(exponent), thr=roundings, rel=.true.)
      if (allocated(error)) return
      call make_oil(law_cameron, oil)
      call relative_viscosity(oil, [pressure], ratio, slope)
      call check(error, ratio(1), (27.0_wp/16.0_wp)**16, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call make_oil(law_roelands, oil)
      call relative_viscosity(oil, [pressure], ratio, slope)
      ! Z = alpha/(5.1e-9 (ln 0.0305 + 9.67)) = 0.69802, (1 + 2.55)^Z = 2.42119
      call check(error, oil%roelands_index, 0.69802_wp, thr=0.5e-5_wp)
      if (allocated(error)) return
      call check(error, log(ratio(1)), (log(0.0305_wp) + 9.67_wp)*(3.55_wp**oil%roelands_index - 1.0_wp), thr=roundings, rel=.true.)
   end subroutine test_pressure_laws

   subroutine test_held(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      ! Pressures [Pa]: below and above alpha p = 600, where Barus' law is held; Roelands' at 140 GPa
      real(wp), parameter :: pressures(2) = [2.0e10_wp, 1.0e12_wp]
      real(wp) :: ratios(2), slopes(2), further(2), unused(2)
      integer :: law

      do law = law_barus, law_roelands, law_roelands - law_barus
         call make_oil(law, oil)
         call relative_viscosity(oil, pressures, ratios, slopes)
         call relative_viscosity(oil, pressures*(1.0_wp + 1.0e-6_wp), further, unused)
         ! The second derivative of the logarithm times half the step is below a thousandth of the slope
         call check(error, all(abs(log(further/ratios)/1.0e-6_wp - slopes) <= 1.0e-3_wp*slopes), &
            & "the slope is not that of the ratio: "//pressure_law_names(law))
         if (allocated(error)) return
         call check(error, slopes(1) > 0.0_wp .and. .not. slopes(2) > 0.0_wp, "held where it should not be, or not held: "// &
            & pressure_law_names(law))
         if (allocated(error)) return
      end do
   end subroutine test_held

   subroutine test_initial_slope(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      real(wp) :: ratio(1), slope(1)
      real(wp), parameter :: pressure = 10.0_wp
      integer :: law

      do law = 1, size(pressure_law_names)
         call make_oil(law, oil)
         call relative_viscosity(oil, [0.0_wp], ratio, slope)
         call check(error, ratio(1), 1.0_wp, thr=roundings)
         if (allocated(error)) return
         ! ln(ratio) = alpha p (1 + O(p/p_r)): 10 Pa over 196 MPa leaves 1e-7, and the logarithm of 1 + 2e-7 loses 1e-9
         call relative_viscosity(oil, [pressure], ratio, slope)
         call check(error, log(ratio(1)), oil%pressure_viscosity*pressure, thr=1.0e-7_wp, rel=.true.)
         if (allocated(error)) return
      end do
   end subroutine test_initial_slope

   subroutine test_roelands_index(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil, again
      type(error_t), allocatable :: failure

      call make_oil(law_roelands, oil)
      lubricant%viscosity = oil%viscosity
      lubricant%pressure_law = "roelands"
      lubricant%roelands_index = oil%roelands_index
      call get_oil(lubricant, 333.15_wp, again, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      call check(error, again%pressure_viscosity, 2.2e-8_wp, thr=roundings, rel=.true.)
   end subroutine test_roelands_index

   subroutine test_mean(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      ! alpha p0 up to 35: 1.6 GPa [Pa]
      real(wp), parameter :: peaks(4) = [1.0e7_wp, 0.3e9_wp, 0.65e9_wp, 1.59e9_wp]
      ! Angles phi, x = b sin(phi), with the weights of a rule; viscosity ratios there and their slopes
      real(wp) :: angles(60), weights(60), ratios(60), slopes(60), mean, slope
      integer :: law, i

      call gauss_legendre(angles, weights)
      angles = 0.25_wp*pi*(1.0_wp + angles)
      weights = 0.25_wp*pi*weights*cos(angles)
      do law = 1, size(pressure_law_names)
         call make_oil(law, oil)
         do i = 1, size(peaks)
            call mean_relative_viscosity(oil, peaks(i), mean, slope)
            call relative_viscosity(oil, peaks(i)*cos(angles), ratios, slopes)
            call check(error, mean, sum(weights*ratios), thr=1.0e-12_wp, rel=.true.)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_mean

   subroutine test_mean_expansion(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      real(wp) :: mean, slope, x, second
      ! alpha p0 = 2.2e-4 [Pa]
      real(wp), parameter :: peak = 1.0e4_wp
      integer :: law

      ! int_0^1 sqrt(1 - x^2) dx = pi/4, int_0^1 (1 - x^2) dx = 2/3; the third power leaves 2e-12; Cameron's second power is
      ! 15/16 of Barus'
      do law = law_barus, law_cameron
         call make_oil(law, oil)
         x = oil%pressure_viscosity*peak
         call mean_relative_viscosity(oil, peak, mean, slope)
         second = merge(1.0_wp, 15.0_wp/16.0_wp, law == law_barus)/3.0_wp
         call check(error, mean, 1.0_wp + 0.25_wp*pi*x + second*x**2, thr=4.0e-12_wp)
         if (allocated(error)) return
      end do
   end subroutine test_mean_expansion

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant

      lubricant = given_oil("vogle", 3)
      call refused(lubricant, 333.15_wp, kind_deck, "vogel", error)
      if (allocated(error)) return
      lubricant = given_oil("vogel", 2)
      call refused(lubricant, 333.15_wp, kind_deck, "takes three temperatures", error)
      if (allocated(error)) return
      lubricant = given_oil("vogel", 3)
      lubricant%viscosity_points = viscosities(3:1:-1)
      call refused(lubricant, 333.15_wp, kind_domain, "fit no Vogel law", error)
      if (allocated(error)) return
      lubricant = given_oil("vogel", 3)
      call refused(lubricant, 100.0_wp, kind_domain, "pole of the Vogel law", error)
      if (allocated(error)) return
      lubricant = given_oil("walther", 3)
      call refused(lubricant, 333.15_wp, kind_deck, "takes two temperatures", error)
      if (allocated(error)) return
      lubricant = given_oil("walther", 2)
      lubricant%viscosity_points = [1.0e-4_wp, 0.5e-4_wp]
      call refused(lubricant, 333.15_wp, kind_domain, "above 0.3 mm^2/s", error)
      if (allocated(error)) return
      lubricant = given_oil("direct", 1)
      call refused(lubricant, 333.15_wp, kind_deck, "viscosity must be positive", error)
      if (allocated(error)) return
      lubricant%viscosity = 0.03_wp
      lubricant%pressure_law = "barrus"
      call refused(lubricant, 333.15_wp, kind_deck, "cameron", error)
      if (allocated(error)) return
      lubricant%pressure_law = "barus"
      lubricant%pressure_viscosity = 0.0_wp
      call refused(lubricant, 333.15_wp, kind_deck, "pressure-viscosity coefficient or Roelands' index", error)
      if (allocated(error)) return
      lubricant%pressure_law = "roelands"
      lubricant%pressure_viscosity = 2.2e-8_wp
      lubricant%roelands_index = 0.6_wp
      call refused(lubricant, 333.15_wp, kind_deck, "not both", error)
      if (allocated(error)) return
      lubricant%roelands_index = 0.0_wp
      lubricant%viscosity = 6.0e-5_wp
      call refused(lubricant, 333.15_wp, kind_domain, "above 6.32e-5", error)
   end subroutine test_refusals

   !> An oil is refused with a kind and words.
   subroutine refused(lubricant, temperature, kind, words, error)
      type(lubricant_t), intent(in) :: lubricant
      real(wp), intent(in) :: temperature
      integer, intent(in) :: kind
      character(len=*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      type(error_t), allocatable :: failure

      call get_oil(lubricant, temperature, oil, failure)
      if (.not. allocated(failure)) then
         call test_failed(error, "no error, but expected '"//words//"'")
         return
      end if
      call check(error, failure%kind, kind, failure%message)
      if (allocated(error)) return
      call check(error, index(failure%message, words) > 0, "'"//words//"' is not in '"//failure%message//"'")
   end subroutine refused

end module test_lubricant
