!> Oil: laws through their points, closed forms of the pressure laws, the mean over a contact, refusals.
module test_lubricant
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_quadrature, only : integrand_t, integrate
   use camroller_lubricant, only : lubricant_t, oil_t, pressure_law_names, get_oil, relative_viscosity, mean_relative_viscosity, &
      law_barus, law_cameron, law_roelands
   implicit none
   private

   public :: collect_lubricant

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)
   !> Temperatures and viscosities of an engine oil: 25, 60 and 95 degC [K], [Pa s]
   real(wp), parameter :: temperatures(3) = [298.15_wp, 333.15_wp, 368.15_wp], viscosities(3) = [0.15_wp, 0.0305_wp, 0.01_wp]

   !> Viscosity ratio over the angle phi, x = b sin(phi), times cos(phi)
   type, extends(integrand_t) :: profile_t
      !> The oil
      type(oil_t) :: oil
      !> Pressure in the middle [Pa]
      real(wp) :: peak
   contains
      procedure :: value => profile_value
   end type profile_t

contains

   subroutine collect_lubricant(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("Vogel's law passes through its three points", test_vogel_points), &
         new_unittest("Vogel's law is found again from points on it", test_vogel_constants), &
         new_unittest("Walther's law passes through its two points and is the straight line of ASTM D341", test_walther), &
         new_unittest("pressure laws have their closed forms", test_pressure_laws), &
         new_unittest("every pressure law begins with the same slope", test_initial_slope), &
         new_unittest("Roelands' index and the coefficient give each other", test_roelands_index), &
         new_unittest("mean over the contact agrees with adaptive quadrature", test_mean), &
         new_unittest("mean over the contact has its closed form in Barus' first two powers", test_mean_expansion), &
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
      real(wp) :: ratio, slope
      ! alpha p = 11 at 0.5 GPa [-]
      real(wp), parameter :: pressure = 0.5e9_wp, exponent = 11.0_wp

      call make_oil(law_barus, oil)
      call relative_viscosity(oil, pressure, ratio, slope)
      call check(error, ratio, exp(exponent), thr=roundings, rel=.true.)
      if (allocated(error)) return
      call make_oil(law_cameron, oil)
      call relative_viscosity(oil, pressure, ratio, slope)
      call check(error, ratio, (27.0_wp/16.0_wp)**16, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call make_oil(law_roelands, oil)
      call relative_viscosity(oil, pressure, ratio, slope)
      ! Z = alpha/(5.1e-9 (ln 0.0305 + 9.67)) = 0.69802, (1 + 2.55)^Z = 2.42119
      call check(error, oil%roelands_index, 0.69802_wp, thr=0.5e-5_wp)
      if (allocated(error)) return
      call check(error, log(ratio), (log(0.0305_wp) + 9.67_wp)*(3.55_wp**oil%roelands_index - 1.0_wp), thr=roundings, rel=.true.)
   end subroutine test_pressure_laws

   subroutine test_initial_slope(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      real(wp) :: ratio, slope
      real(wp), parameter :: pressure = 10.0_wp
      integer :: law

      do law = 1, size(pressure_law_names)
         call make_oil(law, oil)
         call relative_viscosity(oil, 0.0_wp, ratio, slope)
         call check(error, ratio, 1.0_wp, thr=roundings)
         if (allocated(error)) return
         ! ln(ratio) = alpha p (1 + O(p/p_r)): 10 Pa over 196 MPa leaves 1e-7, and the logarithm of 1 + 2e-7 loses 1e-9
         call relative_viscosity(oil, pressure, ratio, slope)
         call check(error, log(ratio), oil%pressure_viscosity*pressure, thr=1.0e-7_wp, rel=.true.)
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

   function profile_value(self, x) result(f)
      class(profile_t), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp) :: f
      real(wp) :: ratio, slope

      call relative_viscosity(self%oil, self%peak*cos(x), ratio, slope)
      f = ratio*cos(x)
   end function profile_value

   subroutine test_mean(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      ! alpha p0 up to 35: 1.6 GPa [Pa]
      real(wp), parameter :: peaks(4) = [1.0e7_wp, 0.3e9_wp, 0.65e9_wp, 1.59e9_wp]
      real(wp) :: mean, slope, integral, doubt
      integer :: law, i, status

      do law = 1, size(pressure_law_names)
         call make_oil(law, oil)
         do i = 1, size(peaks)
            call mean_relative_viscosity(oil, peaks(i), mean, slope)
            call integrate(profile_t(oil, peaks(i)), 0.0_wp, 0.5_wp*pi, 1.0e-14_wp*mean, integral, doubt, status)
            call check(error, mean, integral, thr=1.0e-12_wp, rel=.true.)
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
