!> Quintic spline: exactness, order, periodicity, smoothing, refusals.
module test_spline
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_positive_inf
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t, kind_domain
   use camroller_spline, only : spline_t, new_clamped_spline, new_periodic_spline, evaluate_spline, &
      sharp_points
   implicit none
   private

   public :: collect_spline

   !> Round-off allowed in values of order one [-]
   real(wp), parameter :: round_off = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_spline(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a quintic on unequal points is met exactly", test_quintic), &
         new_unittest("two points and their ends make one quintic piece", test_two_points), &
         new_unittest("values converge with order 6, third derivatives with order 3", test_order), &
         new_unittest("derivatives agree with central differences", test_derivatives), &
         new_unittest("third derivative is continuous at the points", test_continuity), &
         new_unittest("a periodic spline joins itself", test_seam), &
         new_unittest("a periodic spline does not depend on where the table starts", test_rotation), &
         new_unittest("a corner of a periodic table and points beside it are sharp, a smooth table has none", test_sharp_points), &
         new_unittest("smoothing reaches the distance asked for", test_smoothing_distance), &
         new_unittest("smoothing takes noise out of the second derivative", test_noise), &
         new_unittest("smoothing of a smooth table changes it little", test_small_smoothing), &
         new_unittest("nothing is said outside the table", test_outside), &
         new_unittest("tables without a function are refused", test_refusals) &
         ]
   end subroutine collect_spline

   !> A wave of 90 points, and the same with a corner at point 31. Its slope changes there by 0.01, which makes pieces that differ
   !> by 1.7e-4; far off, each point has 0.43 of the one before, by the largest root of the quintic spline. Four points on both
   !> sides have more than 1e-5, by an independent program.
   subroutine test_sharp_points(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 90, corner = 31
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(n + 1), values(n + 1)
      real(wp), allocatable :: sharp(:)
      integer :: i

      points = [(two_pi*(i - 1)/n, i=1, n + 1)]
      values = cos(points)
      call new_periodic_spline(spline, points, values, 0.0_wp, failure)
      call check(error, size(sharp_points(spline, 1.0e-5_wp)), 0, "a smooth table")
      if (allocated(error)) return
      values = values + 0.01_wp*abs(sin(0.5_wp*(points - points(corner))))
      call new_periodic_spline(spline, points, values, 0.0_wp, failure)
      sharp = sharp_points(spline, 1.0e-5_wp)
      call check(error, size(sharp), 9, "points about the corner")
      if (.not. allocated(error)) call check(error, all(abs(sharp - points(corner - 4:corner + 4)) < round_off), "where they are")
   end subroutine test_sharp_points

   !> Quintic with all powers and its derivatives
   pure function quintic(x) result(f)
      !> Point [-]
      real(wp), intent(in) :: x
      !> Value and derivatives [-]
      real(wp) :: f(0:3)

      f(0) = 1.0_wp + x*(-2.0_wp + x*(3.0_wp + x*(-1.0_wp + x*(0.5_wp + x*0.25_wp))))
      f(1) = -2.0_wp + x*(6.0_wp + x*(-3.0_wp + x*(2.0_wp + x*1.25_wp)))
      f(2) = 6.0_wp + x*(-6.0_wp + x*(6.0_wp + x*5.0_wp))
      f(3) = -6.0_wp + x*(12.0_wp + x*15.0_wp)
   end function quintic

   subroutine test_quintic(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(9), values(9), ends(0:3, 2), f(0:3), x
      integer :: i

      points = [-1.0_wp, -0.8_wp, -0.75_wp, -0.3_wp, 0.0_wp, 0.2_wp, 0.5_wp, 0.9_wp, 1.0_wp]
      do i = 1, size(points)
         f = quintic(points(i))
         values(i) = f(0)
      end do
      ends(:, 1) = quintic(points(1))
      ends(:, 2) = quintic(points(9))
      call new_clamped_spline(spline, points, values, ends(1:2, 1), ends(1:2, 2), 0.0_wp, failure)
      call check(error, allocated(failure), .false., "refused")
      if (allocated(error)) return
      do i = 0, 200
         x = -1.0_wp + 0.01_wp*real(i, wp)
         call evaluate_spline(spline, min(x, 1.0_wp), f)
         ! round-off grows with the third power of the reciprocal of the smallest spacing, 0.05
         call check(error, all(abs(f - quintic(min(x, 1.0_wp))) < &
            round_off*[1.0_wp, 20.0_wp, 400.0_wp, 8000.0_wp]), "quintic not met")
         if (allocated(error)) return
      end do
   end subroutine test_quintic

   subroutine test_two_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: first(0:3), last(0:3), f(0:3)

      first = quintic(0.0_wp)
      last = quintic(1.0_wp)
      call new_clamped_spline(spline, [0.0_wp, 1.0_wp], [first(0), last(0)], first(1:2), last(1:2), 0.0_wp, failure)
      call evaluate_spline(spline, 0.3_wp, f)
      call check(error, all(abs(f - quintic(0.3_wp)) < round_off*[1.0_wp, 10.0_wp, 100.0_wp, 1000.0_wp]))
   end subroutine test_two_points

   !> Largest errors of value and derivatives of exp(sin x) on n periodic points, between the points
   subroutine periodic_errors(n, errors)
      !> Points
      integer, intent(in) :: n
      !> Largest error of each derivative [-]
      real(wp), intent(out) :: errors(0:3)
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(n + 1), values(n + 1), f(0:3), x
      integer :: i

      points = [(two_pi*real(i, wp)/real(n, wp), i=0, n)]
      values = exp(sin(points))
      values(n + 1) = values(1)
      call new_periodic_spline(spline, points, values, 0.0_wp, failure)
      errors = 0.0_wp
      do i = 0, 999
         x = two_pi*real(i, wp)/1000.0_wp
         call evaluate_spline(spline, x, f)
         errors = max(errors, abs(f - exp_sin(x)))
      end do
   end subroutine periodic_errors

   !> exp(sin x) and its derivatives
   pure function exp_sin(x) result(f)
      !> Point [rad]
      real(wp), intent(in) :: x
      !> Value and derivatives [-]
      real(wp) :: f(0:3)
      real(wp) :: s, c

      s = sin(x)
      c = cos(x)
      f = exp(s)*[1.0_wp, c, c**2 - s, c**3 - 3.0_wp*s*c - c]
   end function exp_sin

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: coarse(0:3), fine(0:3), order(0:3)

      call periodic_errors(40, coarse)
      call periodic_errors(80, fine)
      order = log(coarse/fine)/log(2.0_wp)
      ! an interpolating spline of degree 5 errs as h^(6 - k) in derivative k
      call check(error, all(abs(order - [6.0_wp, 5.0_wp, 4.0_wp, 3.0_wp]) < 0.5_wp), "observed order is wrong")
   end subroutine test_order

   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(21), low(0:3), mid(0:3), high(0:3), x
      ! central difference: truncation h^2/6 times a derivative of at most 3^5, round-off of derivative k near 1e-16
      ! 10^k/h
      real(wp), parameter :: h = 1.0e-5_wp
      integer :: i

      points = [(0.1_wp*real(i, wp) + 0.03_wp*sin(real(i, wp)), i=0, 20)]
      call new_clamped_spline(spline, points, sin(3.0_wp*points), [3.0_wp, 0.0_wp], &
         [3.0_wp*cos(3.0_wp*points(21)), -9.0_wp*sin(3.0_wp*points(21))], 0.0_wp, failure)
      do i = 1, 37
         x = points(1) + 0.05_wp*real(i, wp)
         call evaluate_spline(spline, x - h, low)
         call evaluate_spline(spline, x, mid)
         call evaluate_spline(spline, x + h, high)
         call check(error, all(abs((high(0:2) - low(0:2))/(2.0_wp*h) - mid(1:3)) < &
            sqrt(epsilon(h))*[1.0_wp, 10.0_wp, 100.0_wp]), "derivative differs from difference quotient")
         if (allocated(error)) return
      end do
   end subroutine test_derivatives

   subroutine test_continuity(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(11), low(0:3), high(0:3)
      integer :: i

      points = [(real(i, wp), i=0, 10)]
      call new_clamped_spline(spline, points, cos(points), [0.0_wp, -1.0_wp], [0.0_wp, 0.0_wp], 0.0_wp, failure)
      do i = 2, 10
         call evaluate_spline(spline, nearest(points(i), -1.0_wp), low)
         call evaluate_spline(spline, points(i), high)
         call check(error, all(abs(high - low) < round_off), "jump at a point")
         if (allocated(error)) return
         call check(error, abs(high(0) - cos(points(i))) < round_off, "value at a point is missed")
         if (allocated(error)) return
      end do
   end subroutine test_continuity

   !> Something periodic
   elemental function wave(x) result(f)
      !> Angle [rad]
      real(wp), intent(in) :: x
      !> Value [-]
      real(wp) :: f

      f = exp(sin(x)) + cos(2.0_wp*x)
   end function wave

   subroutine test_seam(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: points(8), first(0:3), last(0:3)
      integer :: n

      do n = 7, 8
         points = [0.0_wp, 0.5_wp, 1.5_wp, 2.0_wp, 2.5_wp, 3.5_wp, 4.0_wp, 5.0_wp]
         call new_periodic_spline(spline, points(:n), [wave(two_pi*points(:n - 1)/points(n)), wave(0.0_wp)], &
            0.0_wp, failure)
         call check(error, allocated(failure), .false., "refused")
         if (allocated(error)) return
         call evaluate_spline(spline, points(1), first)
         call evaluate_spline(spline, points(n), last)
         call check(error, all(abs(last - first) < round_off*[1.0_wp, 10.0_wp, 100.0_wp, 1000.0_wp]), &
            "jump at the seam")
         if (allocated(error)) return
      end do
   end subroutine test_seam

   subroutine test_rotation(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline, rotated
      integer, parameter :: n = 31, shift = 11
      real(wp) :: points(n + 1), values(n + 1), shifted(n + 1), f(0:3), g(0:3)
      integer :: i

      points = [(two_pi*real(i, wp)/real(n, wp), i=0, n)]
      values(:n) = [(real(modulo(7*i*i, 13), wp), i=1, n)]
      values(n + 1) = values(1)
      shifted(:n) = cshift(values(:n), shift)
      shifted(n + 1) = shifted(1)
      call new_periodic_spline(spline, points, values, 0.0_wp, failure)
      call new_periodic_spline(rotated, points, shifted, 0.0_wp, failure)
      do i = 1, n - shift
         call evaluate_spline(spline, points(i + shift), f)
         call evaluate_spline(rotated, points(i), g)
         ! values up to 12; derivatives grow with the reciprocal spacing of 5
         call check(error, all(abs(f - g) < round_off*12.0_wp*[1.0_wp, 5.0_wp, 25.0_wp, 125.0_wp]*10.0_wp), &
            "depends on the start of the table")
         if (allocated(error)) return
      end do
   end subroutine test_rotation

   !> A bump with noise that repeats from run to run
   subroutine noisy_bump(points, bump, noise)
      !> Points from -1 to 1 [-]
      real(wp), intent(out) :: points(:)
      !> (1 - x^2)^4 [-]
      real(wp), intent(out) :: bump(:)
      !> Noise of root mean square near 1 [-]
      real(wp), intent(out) :: noise(:)
      integer :: i, n

      n = size(points)
      points = [(-1.0_wp + 2.0_wp*real(i - 1, wp)/real(n - 1, wp), i=1, n)]
      bump = (1.0_wp - points**2)**4
      ! the fractional parts of multiples of an irrational number are evenly spread: rms sqrt(12)/sqrt(12)
      noise = [(sqrt(12.0_wp)*(modulo(real(i*i, wp)*sqrt(2.0_wp), 1.0_wp) - 0.5_wp), i=1, n)]
      noise(1) = 0.0_wp
      noise(n) = 0.0_wp
   end subroutine noisy_bump

   subroutine test_smoothing_distance(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      integer, parameter :: n = 141
      real(wp) :: points(n), bump(n), noise(n), f(0:3), total
      real(wp), parameter :: wanted = 3.0e-4_wp
      integer :: i, kind_of_ends

      call noisy_bump(points, bump, noise)
      bump = bump + wanted*noise
      do kind_of_ends = 1, 2
         if (kind_of_ends == 1) then
            call new_clamped_spline(spline, points, bump, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], wanted, failure)
         else
            call new_periodic_spline(spline, points, bump, wanted, failure)
         end if
         call check(error, allocated(failure), .false., "refused")
         if (allocated(error)) return
         total = 0.0_wp
         do i = 1, n - 1
            call evaluate_spline(spline, points(i), f)
            total = total + (f(0) - bump(i))**2
         end do
         ! the clamped mean counts the last point, too; the weight is found to 1e-10 decades
         total = sqrt(total/real(n - kind_of_ends + 1, wp))
         call check(error, abs(total - wanted) < 1.0e-8_wp*wanted, "distance is not the one asked for")
         if (allocated(error)) return
      end do
   end subroutine test_smoothing_distance

   subroutine test_noise(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: rough, smooth
      integer, parameter :: n = 141
      real(wp) :: points(n), bump(n), noise(n), f(0:3), exact, rough_error, smooth_error, x
      real(wp), parameter :: level = 3.0e-4_wp
      integer :: i

      call noisy_bump(points, bump, noise)
      call new_clamped_spline(rough, points, bump + level*noise, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], 0.0_wp, failure)
      call new_clamped_spline(smooth, points, bump + level*noise, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], level, failure)
      rough_error = 0.0_wp
      smooth_error = 0.0_wp
      do i = 1, 999
         x = -1.0_wp + 0.002_wp*real(i, wp)
         exact = 8.0_wp*(1.0_wp - x**2)**2*(7.0_wp*x**2 - 1.0_wp)
         call evaluate_spline(rough, x, f)
         rough_error = max(rough_error, abs(f(2) - exact))
         call evaluate_spline(smooth, x, f)
         smooth_error = max(smooth_error, abs(f(2) - exact))
      end do
      ! noise of 3e-4 over a spacing of 1/70 is worth 4 * 70^2 * 3e-4 = 6 of a curvature of 8; smoothing leaves a
      ! twentieth
      call check(error, rough_error > 4.0_wp, "the noise is too weak to show anything")
      if (allocated(error)) return
      call check(error, smooth_error < 0.05_wp*rough_error, "noise is left in the second derivative")
   end subroutine test_noise

   subroutine test_small_smoothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: exact, smooth
      integer, parameter :: n = 41
      real(wp) :: points(n), bump(n), noise(n), f(0:3), g(0:3)
      integer :: i

      call noisy_bump(points, bump, noise)
      call new_clamped_spline(exact, points, bump, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], 0.0_wp, failure)
      call new_clamped_spline(smooth, points, bump, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], 1.0e-9_wp, failure)
      do i = 1, n
         call evaluate_spline(exact, points(i), f)
         call evaluate_spline(smooth, points(i), g)
         ! root mean square 1e-9 of n points: no single one is farther off than sqrt(n) 1e-9
         call check(error, abs(f(0) - g(0)) < sqrt(real(n, wp))*1.0e-9_wp)
         if (allocated(error)) return
      end do
   end subroutine test_small_smoothing

   subroutine test_outside(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline
      real(wp) :: f(0:3)

      call new_clamped_spline(spline, [0.0_wp, 1.0_wp, 3.0_wp], [1.0_wp, 2.0_wp, 5.0_wp], [0.0_wp, 0.0_wp], &
         [0.0_wp, 0.0_wp], 0.0_wp, failure)
      call evaluate_spline(spline, nearest(3.0_wp, 1.0_wp), f)
      call check(error, all(abs(f) <= 0.0_wp), "a number is returned beyond the last point")
      if (allocated(error)) return
      call evaluate_spline(spline, -1.0e-300_wp, f)
      call check(error, all(abs(f) <= 0.0_wp), "a number is returned before the first point")
      if (allocated(error)) return
      call evaluate_spline(spline, 0.0_wp, f)
      call check(error, abs(f(0) - 1.0_wp) < round_off, "the first point is inside")
      if (allocated(error)) return
      call evaluate_spline(spline, 3.0_wp, f)
      call check(error, abs(f(0) - 5.0_wp) < 10.0_wp*round_off, "the last point is inside")
   end subroutine test_outside

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: nothing(2) = 0.0_wp
      type(error_t), allocatable :: failure
      type(spline_t) :: spline

      call new_clamped_spline(spline, [0.0_wp], [0.0_wp], nothing, nothing, 0.0_wp, failure)
      call expect(error, failure, "too few points in a table: 1, needed are at least 2")
      if (allocated(error)) return
      call new_clamped_spline(spline, [0.0_wp, 1.0_wp, 1.0_wp], [0.0_wp, 1.0_wp, 2.0_wp], nothing, nothing, &
         0.0_wp, failure)
      call expect(error, failure, "row 3 does not follow row 2")
      if (allocated(error)) return
      call new_clamped_spline(spline, [0.0_wp, 1.0_wp], [0.0_wp, ieee_value(1.0_wp, ieee_positive_inf)], nothing, &
         nothing, &
         0.0_wp, failure)
      call expect(error, failure, "row 2 of the table is not a finite number")
      if (allocated(error)) return
      call new_periodic_spline(spline, [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], &
         [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 2.0_wp, 1.0_wp, 0.5_wp], 0.0_wp, failure)
      call expect(error, failure, "first and last value of a periodic table differ")
      if (allocated(error)) return
      call new_clamped_spline(spline, [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp], [0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp], nothing, &
         nothing, &
         2.0_wp, failure)
      call expect(error, failure, "smoothing is as large as the table's own variation")
   end subroutine test_refusals

   !> Demand an error with given words
   subroutine expect(error, failure, words)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable, intent(in) :: failure
      character(len=*), intent(in) :: words

      call check(error, allocated(failure), "accepted: "//words)
      if (allocated(error)) return
      call check(error, failure%kind == kind_domain .and. index(failure%message, words) > 0, &
         "message is "//failure%message)
   end subroutine expect

end module test_spline
