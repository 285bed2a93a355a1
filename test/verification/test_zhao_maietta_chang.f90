!> Summits that yield: against an independent quadrature, their limits, and how they hang together.
module test_zhao_maietta_chang
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_greenwood_tripp, only : integral_2, integral_5_2
   use camroller_asperity, only : asperity_t, asperity_constants_t, new_asperity_constants, asperity_load_function, &
      & asperity_area_function, asperity_law_names, law_zhao_maietta_chang, smallest_product
   use labelled_table, only : read_table
   implicit none
   private

   public :: collect_zhao_maietta_chang

   !> E' [Pa]
   real(wp), parameter :: modulus = 2.28e11_wp
   !> Error that the polynomials claim [-]
   real(wp), parameter :: claimed = 1.0e-11_wp

contains

   subroutine collect_zhao_maietta_chang(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("pressure and area agree with an independent quadrature", test_table), &
         new_unittest("without yield the load is that of elastic summits with their own mean plane and standard deviation", &
            & test_elastic), &
         new_unittest("derivatives agree with central differences", test_derivatives), &
         new_unittest("softer summits carry less load on a larger area; load and area fall with the gap", test_order), &
         new_unittest("beyond the largest gap load and area are zero, and negligible just before it", test_reach) &
         ]
   end subroutine collect_zhao_maietta_chang

   !> Constants of a pair of surfaces.
   function surfaces(product, slenderness, hardness) result(constants)
      !> n beta sigma, sigma/beta; hardness over E' [-]
      real(wp), intent(in) :: product, slenderness, hardness
      type(asperity_constants_t) :: constants
      type(asperity_t) :: asperity

      asperity%law = asperity_law_names(law_zhao_maietta_chang)
      asperity%roughness_product = product
      asperity%roughness_over_tip_radius = slenderness
      call new_asperity_constants(constants, asperity, modulus, hardness*modulus)
   end function surfaces

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: rows(:, :)
      type(asperity_constants_t) :: constants
      real(wp) :: load, area, slope
      integer :: i

      call read_table("zhao_maietta_chang.csv", 6, rows, error)
      if (allocated(error)) return
      call check(error, size(rows, 2), 54)
      do i = 1, size(rows, 2)
         if (allocated(error)) return
         constants = surfaces(rows(1, i), rows(2, i), rows(3, i))
         if (rows(4, i) > constants%reach) then
            call check(error, all(rows(5:6, i) < 1.0e-20_wp), "what is cut off")
            cycle
         end if
         call asperity_load_function(constants, rows(4, i), load, slope)
         call asperity_area_function(constants, rows(4, i), area, slope)
         call check(error, constants%load_factor*load/modulus, rows(5, i), thr=claimed, rel=.true.)
         if (allocated(error)) return
         call check(error, constants%area_factor*area, rows(6, i), thr=claimed, rel=.true.)
      end do
   end subroutine test_table

   !> The derivative of F_5/2 is -5/2 F_3/2, which is what Hertz's law makes of Gaussian heights.
   subroutine test_elastic(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      ! Height and scatter of the summits as they are published for a product of 0.05: five and four digits [-]
      real(wp), parameter :: height = 0.045944_wp/0.05_wp, scatter = sqrt(1.0_wp - 3.717e-4_wp/0.05_wp**2)
      real(wp), parameter :: digits = 1.0e-4_wp
      real(wp) :: film_ratio, value, slope, unused
      integer :: i

      constants = surfaces(0.05_wp, 0.01_wp, 10.0_wp)
      call check(error, constants%load_factor, 2.0_wp/3.0_wp*0.05_wp*0.1_wp*modulus, thr=claimed, rel=.true.)
      do i = 0, 10
         if (allocated(error)) return
         film_ratio = height + 0.3_wp*i
         call asperity_load_function(constants, film_ratio, value, unused)
         call integral_5_2((film_ratio - height)/scatter, unused, slope)
         call check(error, value, -0.4_wp*slope*scatter**1.5_wp, thr=digits, rel=.true.)
         if (allocated(error)) return
         call asperity_area_function(constants, film_ratio, value, unused)
         call integral_2((film_ratio - height)/scatter, unused, slope)
         call check(error, value, -0.5_wp*slope*scatter, thr=digits, rel=.true.)
      end do
   end subroutine test_elastic

   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      real(wp), parameter :: h = 1.0e-5_wp
      real(wp) :: film_ratio, low(2), high(2), slope(2), unused
      integer :: i

      constants = surfaces(0.05_wp, 0.01_wp, 0.01_wp)
      do i = 1, 79
         film_ratio = 0.1_wp*i
         call asperity_load_function(constants, film_ratio - h, low(1), unused)
         call asperity_area_function(constants, film_ratio - h, low(2), unused)
         call asperity_load_function(constants, film_ratio + h, high(1), unused)
         call asperity_area_function(constants, film_ratio + h, high(2), unused)
         call asperity_load_function(constants, film_ratio, unused, slope(1))
         call asperity_area_function(constants, film_ratio, unused, slope(2))
         ! Truncation h^2/6 times about H^2 of the slope; the round-off of a sum of polynomials up to 30, over h
         call check(error, all(abs((high - low)/(2.0_wp*h)/slope - 1.0_wp) < 10.0_wp*sqrt(epsilon(h))))
         if (allocated(error)) return
      end do
   end subroutine test_derivatives

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: hardness(5) = [0.002_wp, 0.005_wp, 0.01_wp, 0.03_wp, 10.0_wp]
      type(asperity_constants_t) :: constants
      real(wp) :: load(5), area(5), before(2, 5), slope(2)
      integer :: i, k

      before = huge(1.0_wp)
      do i = 0, 40
         do k = 1, 5
            constants = surfaces(0.05_wp, 0.01_wp, hardness(k))
            call asperity_load_function(constants, 0.2_wp*i, load(k), slope(1))
            call asperity_area_function(constants, 0.2_wp*i, area(k), slope(2))
            call check(error, all(slope < 0.0_wp) .and. load(k) < before(1, k) .and. area(k) < before(2, k), "falls with the gap")
            if (allocated(error)) return
         end do
         before(1, :) = load
         before(2, :) = area
         ! Far away summits touch so little that next to none yields
         if (i > 20) cycle
         call check(error, all(load(2:) > load(:4)), "harder summits carry more")
         if (allocated(error)) return
         call check(error, all(area(2:) < area(:4)) .and. area(1) <= 2.0_wp*area(5), "softer summits touch on more, up to twice")
         if (allocated(error)) return
      end do
   end subroutine test_order

   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      type(asperity_constants_t) :: constants
      real(wp), parameter :: products(3) = [smallest_product, 0.05_wp, 0.3_wp]
      real(wp) :: value(2), slope(2), zero(2)
      integer :: i

      do i = 1, size(products)
         constants = surfaces(products(i), 0.01_wp, 0.01_wp)
         ! y_s and 8 s
         call check(error, constants%reach, 1.0_wp/(sqrt(48.0_wp)*pi*products(i)) &
            & + 8.0_wp*sqrt(1.0_wp - 0.8968_wp/(768.0_wp*pi*products(i)**2)), thr=1.0e-14_wp, rel=.true.)
         if (allocated(error)) return
         call asperity_load_function(constants, nearest(constants%reach, 1.0_wp), value(1), slope(1))
         call asperity_area_function(constants, huge(1.0_wp), value(2), slope(2))
         call check(error, all(abs(value) <= 0.0_wp) .and. all(abs(slope) <= 0.0_wp), "something is left")
         if (allocated(error)) return
         call asperity_load_function(constants, constants%reach, value(1), slope(1))
         call asperity_area_function(constants, constants%reach, value(2), slope(2))
         call asperity_load_function(constants, 0.0_wp, zero(1), slope(1))
         call asperity_area_function(constants, 0.0_wp, zero(2), slope(2))
         call check(error, all(value < 1.0e-15_wp*zero), "the cut is larger than stated")
         if (allocated(error)) return
      end do
   end subroutine test_reach

end module test_zhao_maietta_chang
