!> Tests of samples: published points, one point in each slice, independence of seeds.
module test_samples
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_samples, only : sample_sobol, sample_latin_hypercube, sample_independent, sobol_axes
   implicit none
   private

   public :: collect_samples

   !> Axes that are tried
   integer, parameter :: axes = sobol_axes

contains

   !> All tests of this suite.
   subroutine collect_samples(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the Sobol sequence begins as published", sobol_points), &
         new_unittest("two to the power of n points of a Sobol sequence have one in each slice", sobol_slices), &
         new_unittest("a Latin hypercube has one point in each slice", hypercube_slices), &
         new_unittest("independent points fill the cube evenly", independent_points), &
         new_unittest("another seed gives other points", seeds_differ) &
         ]
   end subroutine collect_samples

   !> Points 1 to 7 in Gray code, from the generator that Joe and Kuo publish with their direction numbers,
   !> https://web.maths.unsw.edu.au/~fkuo/sobol/
   subroutine sobol_points(error)
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: points(4, 8) = reshape([ &
         & 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp, &
         & 0.75_wp, 0.25_wp, 0.25_wp, 0.25_wp, &
         & 0.25_wp, 0.75_wp, 0.75_wp, 0.75_wp, &
         & 0.375_wp, 0.375_wp, 0.625_wp, 0.875_wp, &
         & 0.875_wp, 0.875_wp, 0.125_wp, 0.375_wp, &
         & 0.625_wp, 0.125_wp, 0.875_wp, 0.625_wp, &
         & 0.125_wp, 0.625_wp, 0.375_wp, 0.125_wp], [4, 8])
      integer :: i, j

      do i = 1, 8
         do j = 1, 4
            call check(error, sample_sobol(i - 1, j, 0), points(j, i), thr=0.0_wp)
            if (allocated(error)) return
         end do
      end do
   end subroutine sobol_points

   subroutine sobol_slices(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: points = 256
      integer :: axis, seed, i

      do seed = 0, 2
         do axis = 1, axes
            call check_slices(error, [(sample_sobol(i, axis, seed), i=0, points - 1)])
            if (allocated(error)) return
         end do
      end do
   end subroutine sobol_slices

   subroutine hypercube_slices(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: sizes(*) = [1, 2, 3, 64, 65, 331]
      integer :: axis, i, k

      do k = 1, size(sizes)
         do axis = 1, axes
            call check_slices(error, [(sample_latin_hypercube(i, sizes(k), axis, 3), i=0, sizes(k) - 1)])
            if (allocated(error)) return
         end do
      end do
   end subroutine hypercube_slices

   !> One coordinate in each of as many slices as there are coordinates?
   subroutine check_slices(error, coordinates)
      type(error_type), allocatable, intent(out) :: error
      !> Coordinates [-]
      real(wp), intent(in) :: coordinates(:)

      integer :: hits(0:size(coordinates) - 1), i

      hits = 0
      do i = 1, size(coordinates)
         hits(int(coordinates(i)*size(coordinates))) = hits(int(coordinates(i)*size(coordinates))) + 1
      end do
      call check(error, all(hits == 1), "a slice holds no point, or two")
   end subroutine check_slices

   !> Mean and correlation of n points are within five standard deviations, 1/sqrt(12 n) and 1/sqrt(n), of 1/2 and 0.
   subroutine independent_points(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: points = 4000
      !> Coordinates [-]
      real(wp) :: some(points), others(points)
      integer :: i

      some = [(sample_independent(i, 1, 9), i=1, points)]
      others = [(sample_independent(i, 2, 9), i=1, points)]
      call check(error, sum(some)/points, 0.5_wp, thr=5.0_wp/sqrt(12.0_wp*points))
      if (allocated(error)) return
      call check(error, 12.0_wp*sum((some - 0.5_wp)*(others - 0.5_wp))/points, 0.0_wp, thr=5.0_wp/sqrt(real(points, wp)))
      if (allocated(error)) return
      call check(error, minval(some) >= 0.0_wp .and. maxval(some) < 1.0_wp)
   end subroutine independent_points

   subroutine seeds_differ(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, abs(sample_independent(5, 1, 1) - sample_independent(5, 1, 2)) > 0.0_wp)
      if (allocated(error)) return
      call check(error, abs(sample_sobol(5, 1, 1) - sample_sobol(5, 1, 2)) > 0.0_wp)
      if (allocated(error)) return
      call check(error, abs(sample_latin_hypercube(5, 1000, 1, 1) - sample_latin_hypercube(5, 1000, 1, 2)) > 0.0_wp)
   end subroutine seeds_differ

end module test_samples
