!> Asperities: the integrals against exact values, the constants against their formulas.
module test_asperity
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_quadrature, only : gauss_legendre
   use camroller_greenwood_tripp, only : integral_2, integral_5_2, largest_film_ratio
   use camroller_asperity, only : asperity_t, asperity_constants_t, new_asperity_constants, asperity_load_function, &
      asperity_area_function, spread_load
   use camroller_number_text, only : number_text
   use labelled_table, only : read_table
   implicit none
   private

   public :: collect_asperity

   !> Relative error that the fits claim, with the round-off of exp at exponents up to 32 [-]
   real(wp), parameter :: fit_error = 1.0e-12_wp

contains

   subroutine collect_asperity(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("integrals and derivatives agree with exact values at 60 points", test_exact), &
         new_unittest("integrals agree with tabulated quadratures to the digits given", test_table), &
         new_unittest("F 5/2 agrees with quadrature", test_quadrature), &
         new_unittest("derivatives agree with central differences", test_derivatives), &
         new_unittest("integrals fall and stay positive up to the largest film ratio", test_monotonic), &
         new_unittest("beyond the largest film ratio asperities carry no load", test_out_of_reach), &
         new_unittest("asperity pressure of closed surfaces is 47 MPa", test_closed), &
         new_unittest("constants agree with their formulas", test_constants), &
         new_unittest("load in and beside the dry contact agrees with quadrature over its gap", test_spread) &
         ]
   end subroutine collect_asperity

   subroutine test_exact(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: rows(:, :)
      real(wp) :: value, slope
      integer :: i

      call read_table("greenwood_tripp_integrals.csv", 5, rows, error)
      if (allocated(error)) return
      call check(error, size(rows, 2), 60)
      if (allocated(error)) return
      do i = 1, size(rows, 2)
         call integral_2(rows(1, i), value, slope)
         call check(error, abs(value/rows(4, i) - 1.0_wp) < fit_error .and. &
            abs(slope/(-2.0_wp*rows(2, i)) - 1.0_wp) < fit_error, "F_2 or its derivative")
         if (allocated(error)) return
         call integral_5_2(rows(1, i), value, slope)
         call check(error, abs(value/rows(5, i) - 1.0_wp) < fit_error .and. &
            abs(slope/(-2.5_wp*rows(3, i)) - 1.0_wp) < fit_error, "F_5/2 or its derivative")
         if (allocated(error)) return
      end do
   end subroutine test_exact

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: rows(:, :)
      real(wp) :: value, slope
      ! Greenwood and Tripp, whose functions have no constants
      type(asperity_constants_t) :: constants
      integer :: i

      call read_table("greenwood_tripp_quadrature.csv", 3, rows, error)
      if (allocated(error)) return
      do i = 1, size(rows, 2)
         ! six digits are given: half a unit of the last one is at most 5e-6 of the value
         call asperity_area_function(constants, rows(1, i), value, slope)
         call check(error, abs(value/rows(2, i) - 1.0_wp) < 5.0e-6_wp, "F_2")
         if (allocated(error)) return
         call asperity_load_function(constants, rows(1, i), value, slope)
         call check(error, abs(value/rows(3, i) - 1.0_wp) < 5.0e-6_wp, "F_5/2")
         if (allocated(error)) return
      end do
      call asperity_load_function(constants, 0.0_wp, value, slope)
      call check(error, abs(value - 0.6166342190_wp) < 0.5e-10_wp, "F_5/2(0)")
   end subroutine test_table

   !> (s - H)^(5/2) exp(-s^2/2)/sqrt(2 pi) over t = sqrt(s - H), which is smooth
   subroutine test_quadrature(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: film_ratio, integral, value, slope, t(60), weights(60)
      integer :: i

      call gauss_legendre(t, weights)
      ! beyond t = 4 the integrand is below exp(-128)
      t = 2.0_wp*(1.0_wp + t)
      weights = 2.0_wp*weights
      do i = 0, 8
         film_ratio = 0.9_wp*real(i, wp)
         call integral_5_2(film_ratio, value, slope)
         integral = sum(weights*2.0_wp*t**6*exp(-0.5_wp*(t**2 + film_ratio)**2))/sqrt(2.0_wp*pi)
         call check(error, abs(value/integral - 1.0_wp) < fit_error)
         if (allocated(error)) return
      end do
   end subroutine test_quadrature

   !> F(H + g) over X from 1, with g = G(X)/(2 s) and X = 1 + u^2, which is smooth; the fit claims 5 % of what is beside.
   subroutine test_spread(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      ! Points and weights, X, gap [-]
      real(wp), dimension(60) :: u, weights, x, gap
      ! Function, its slope, what is beside by quadrature and by the fit [-]
      real(wp) :: inside, slope, there, beside, fit
      real(wp), parameter :: film_ratios(4) = [0.1_wp, 0.5_wp, 1.0_wp, 3.0_wp], relative(4) = [0.1_wp, 1.0_wp, 10.0_wp, 100.0_wp]
      integer :: i, j, k

      do i = 1, size(film_ratios)
         do j = 1, size(relative)
            call gauss_legendre(u, weights)
            ! Beyond G = 16 s the gap is beyond the reach of asperities; G is X^2 less next to nothing there
            u = 0.5_wp*(1.0_wp + u)*sqrt(1.0_wp + 4.0_wp*sqrt(relative(j)))
            weights = 0.5_wp*weights*sqrt(1.0_wp + 4.0_wp*sqrt(relative(j)))
            x = 1.0_wp + u**2
            gap = (x*sqrt(x**2 - 1.0_wp) - log(x + sqrt(x**2 - 1.0_wp)))/(2.0_wp*relative(j))
            beside = 0.0_wp
            do k = 1, size(u)
               call asperity_load_function(constants, film_ratios(i) + gap(k), there, slope)
               beside = beside + 2.0_wp*u(k)*weights(k)*there
            end do
            call asperity_load_function(constants, film_ratios(i), inside, slope)
            fit = spread_load(constants, film_ratios(i), relative(j)) - inside
            call check(error, abs(fit/beside - 1.0_wp) < 0.05_wp, number_text(fit/inside, 4)//" for "// &
               & number_text(beside/inside, 4))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_spread

   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: film_ratio, low(2), high(2), slope(2), unused(2)
      real(wp), parameter :: h = 1.0e-5_wp
      integer :: i

      do i = 1, 79
         film_ratio = 0.1_wp*real(i, wp)
         call integral_2(film_ratio - h, low(1), unused(1))
         call integral_5_2(film_ratio - h, low(2), unused(2))
         call integral_2(film_ratio + h, high(1), unused(1))
         call integral_5_2(film_ratio + h, high(2), unused(2))
         call integral_2(film_ratio, unused(1), slope(1))
         call integral_5_2(film_ratio, unused(2), slope(2))
         ! truncation h^2/6 times about H^2 of the slope, round-off epsilon/h of it
         call check(error, all(abs((high - low)/(2.0_wp*h)/slope - 1.0_wp) < sqrt(epsilon(h))))
         if (allocated(error)) return
      end do
   end subroutine test_derivatives

   subroutine test_monotonic(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: value(2), before(2), slope(2)
      integer :: i

      before = 1.0_wp
      do i = 0, 8000
         call integral_2(real(i, wp)/1000.0_wp, value(1), slope(1))
         call integral_5_2(real(i, wp)/1000.0_wp, value(2), slope(2))
         call check(error, all(value < before) .and. all(value > 0.0_wp) .and. all(slope < 0.0_wp))
         if (allocated(error)) return
         before = value
      end do
   end subroutine test_monotonic

   subroutine test_out_of_reach(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: value(2), slope(2), zero(2)

      call integral_2(nearest(largest_film_ratio, 1.0_wp), value(1), slope(1))
      call integral_5_2(huge(1.0_wp), value(2), slope(2))
      call check(error, all(abs(value) <= 0.0_wp) .and. all(abs(slope) <= 0.0_wp), "something is left")
      if (allocated(error)) return
      call integral_2(largest_film_ratio, value(1), slope(1))
      call integral_5_2(largest_film_ratio, value(2), slope(2))
      call integral_2(0.0_wp, zero(1), slope(1))
      call integral_5_2(0.0_wp, zero(2), slope(2))
      call check(error, all(value < 1.0e-16_wp*zero), "the cut is larger than stated")
   end subroutine test_out_of_reach

   subroutine test_closed(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      real(wp) :: value, slope

      ! with eta beta sigma 0.04, sigma/beta 0.01 and E' of steel on steel, 201.8 GPa: two digits
      call new_asperity_constants(constants, asperity_t(0.04_wp, 0.01_wp), 201.8e9_wp)
      call asperity_load_function(constants, 0.0_wp, value, slope)
      call check(error, abs(constants%load_factor*value - 47.0e6_wp) < 0.5e6_wp)
   end subroutine test_closed

   subroutine test_constants(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      real(wp), parameter :: modulus = 2.0e11_wp

      call new_asperity_constants(constants, asperity_t(0.05_wp, 0.02_wp), modulus)
      call check(error, constants%load_factor, 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*0.05_wp**2*sqrt(0.02_wp)*modulus, &
         & thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
      if (allocated(error)) return
      call check(error, constants%area_factor, pi**2*0.05_wp**2, thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
   end subroutine test_constants

end module test_asperity
