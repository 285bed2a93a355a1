!> Smallest values near three points: parabolas, smooth functions, kinks, and brackets without one.
module test_minimum
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_minimum, only : minimum_t, start_minimum, narrow_minimum
   implicit none
   private

   public :: collect_minimum

contains

   subroutine collect_minimum(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("one value finds the lowest point of a parabola", test_parabola), &
         new_unittest("a smooth function is at its lowest within the tolerance after a few values", test_smooth), &
         new_unittest("what a wide part of a bracket may hide is looked for, however little its ends rise", test_uneven), &
         new_unittest("a kink is approached", test_kink), &
         new_unittest("of 1500 kinks none is missed by more than the tolerance or what is said to be left", test_kinks), &
         new_unittest("without a lowest point in the middle nothing is wanted", test_none), &
         new_unittest("where two of the points are one nothing is wanted, and nothing is divided by their distance", test_same) &
         ]
   end subroutine collect_minimum

   !> With run-time checks a division of zero by zero ends the program.
   subroutine test_same(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search

      call start_minimum(search, [1.0_wp, 1.0_wp, 2.0_wp], [3.0_wp, 3.0_wp, 4.0_wp], 1.0e-9_wp)
      call check(error, .not. search%is_wanted)
      if (allocated(error)) return
      call check(error, search%value(2), 3.0_wp)
   end subroutine test_same

   subroutine test_parabola(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search

      call start_minimum(search, [0.0_wp, 1.0_wp, 3.0_wp], parabola([0.0_wp, 1.0_wp, 3.0_wp]), 1.0e-9_wp)
      do while (search%is_wanted)
         call narrow_minimum(search, parabola(search%trial))
      end do
      call check(error, search%point(2), 1.25_wp, thr=1.0e-12_wp)
      if (allocated(error)) return
      call check(error, search%steps, 1)
   end subroutine test_parabola

   subroutine test_smooth(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search
      ! Shift of the three points [-]
      real(wp) :: shift
      integer :: i

      do i = 1, 50
         shift = 0.9_wp*(2*i - 51)/51.0_wp
         call start_minimum(search, shift + [-1.5_wp, 0.0_wp, 1.0_wp], hill(shift + [-1.5_wp, 0.0_wp, 1.0_wp]), 1.0e-6_wp)
         if (.not. search%is_wanted) cycle
         do while (search%is_wanted)
            call narrow_minimum(search, hill(search%trial))
         end do
         ! The lowest value is -1 at 0
         call check(error, search%value(2) + 1.0_wp <= 1.0e-6_wp .and. search%steps <= 8)
         if (allocated(error)) return
         ! What is left is of the order of what the last value missed
         call check(error, search%value(2) + 1.0_wp <= 2.0_wp*search%left .and. search%left <= 1.0e-6_wp)
         if (allocated(error)) return
      end do
   end subroutine test_smooth

   !> Ends that rise by 0.01 and by 0.0002, and a lowest value 0.25 below the middle one.
   subroutine test_uneven(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search
      real(wp), parameter :: lowest = 0.4999_wp, points(3) = [-0.01_wp, 0.0_wp, 1.0_wp], tolerance = 0.02_wp

      call start_minimum(search, points, (points - lowest)**2, tolerance)
      do while (search%is_wanted)
         call narrow_minimum(search, (search%trial - lowest)**2)
      end do
      call check(error, search%value(2) <= tolerance)
   end subroutine test_uneven

   subroutine test_kink(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search
      real(wp), parameter :: points(3) = [0.0_wp, 0.2_wp, 1.0_wp]

      call start_minimum(search, points, kink(points), 1.0e-6_wp)
      do while (search%is_wanted)
         call narrow_minimum(search, kink(search%trial))
      end do
      ! Twelve values at most, each of which about halves the bracket
      call check(error, search%value(2) <= 1.0e-2_wp)
      if (allocated(error)) return
      ! It is at zero
      call check(error, search%value(2) <= search%left)
      if (allocated(error)) return
      call start_minimum(search, points, kink(points), 1.0e-6_wp, 40)
      do while (search%is_wanted)
         call narrow_minimum(search, kink(search%trial))
      end do
      call check(error, search%value(2) <= 1.0e-6_wp)
   end subroutine test_kink

   !> Two legs of any slopes, straight or bent, that meet anywhere in any bracket.
   subroutine test_kinks(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: brackets = 3000, most = 40
      ! Multiples of their roots fill the unit cube evenly; source: Weyl, Math. Ann. 77 (1916) 313 [-]
      real(wp), parameter :: primes(7) = [2.0_wp, 3.0_wp, 5.0_wp, 7.0_wp, 11.0_wp, 13.0_wp, 17.0_wp]
      ! Tolerance over the largest value; sum of the allowed and of what rounding leaves [-]
      real(wp), parameter :: tolerance = 1.0e-6_wp
      type(minimum_t) :: search
      ! Numbers between 0 and 1, points, values there, place of the kink, slope of its right leg over that of the left one, bend
      real(wp) :: numbers(size(primes)), points(3), values(3), place, slope, bend
      integer :: i, k, steps, kinks

      steps = 0
      kinks = 0
      do i = 1, brackets
         numbers = modulo(i*sqrt(primes), 1.0_wp)
         points = [minval(numbers(:3)), sum(numbers(:3)) - minval(numbers(:3)) - maxval(numbers(:3)), maxval(numbers(:3))]
         place = points(1) + numbers(4)*(points(3) - points(1))
         slope = 30.0_wp**(2.0_wp*numbers(5) - 1.0_wp)
         bend = merge(3.0_wp*numbers(7), -0.1_wp*min(slope, 1.0_wp), numbers(6) > 0.3_wp)
         if (numbers(6) > 0.6_wp) bend = 0.0_wp
         values = [(legs(points(k)), k=1, 3)]
         if (values(2) > min(values(1), values(3))) cycle
         call start_minimum(search, points, values, tolerance*maxval(values), most)
         do while (search%is_wanted)
            call narrow_minimum(search, legs(search%trial))
         end do
         kinks = kinks + 1
         steps = steps + search%steps
         ! Two coincidences at once are left to one of ten thousand
         call check(error, search%value(2) <= max(2.0_wp*tolerance*maxval(values), 2.0_wp*search%left), "the kink is missed")
         if (allocated(error)) return
      end do
      ! 14 for each; halving takes 27
      call check(error, steps < 17*kinks, "too many values")

   contains

      !> The function.
      pure function legs(x) result(f)
         real(wp), intent(in) :: x
         real(wp) :: f

         f = max(place - x, 0.0_wp) + slope*max(x - place, 0.0_wp) + bend*(x - place)**2
      end function legs

   end subroutine test_kinks

   subroutine test_none(error)
      type(error_type), allocatable, intent(out) :: error
      type(minimum_t) :: search

      call start_minimum(search, [0.0_wp, 1.0_wp, 2.0_wp], [0.0_wp, 1.0_wp, 2.0_wp], 1.0e-6_wp)
      call check(error, .not. search%is_wanted)
      if (allocated(error)) return
      call start_minimum(search, [0.0_wp, 1.0_wp, 2.0_wp], [1.0_wp, 1.0_wp, 1.0_wp], 1.0e-6_wp)
      call check(error, .not. search%is_wanted)
   end subroutine test_none

   !> Lowest at 1.25.
   elemental function parabola(x) result(f)
      real(wp), intent(in) :: x
      real(wp) :: f

      f = 2.0_wp*(x - 1.25_wp)**2 - 7.0_wp
   end function parabola

   !> Lowest at 0, not even.
   elemental function hill(x) result(f)
      real(wp), intent(in) :: x
      real(wp) :: f

      f = -exp(-x**2) + 0.1_wp*x**3*max(x, 0.0_wp)
   end function hill

   !> Lowest at 0.3.
   elemental function kink(x) result(f)
      real(wp), intent(in) :: x
      real(wp) :: f

      f = abs(x - 0.3_wp) + 2.0_wp*max(x - 0.3_wp, 0.0_wp)
   end function kink

end module test_minimum
