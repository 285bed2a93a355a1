!> Extremes of series sampled at angles in any order.
module test_extremes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_extremes, only : samples_t, start_samples, add_sample, next_sample, smallest_of, largest_of
   implicit none
   private

   public :: collect_extremes

contains

   subroutine collect_extremes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("extremes between samples are found", test_between), &
         new_unittest("an extreme at the seam of the turn is found", test_seam), &
         new_unittest("a kink that is sampled stays the extreme", test_kink), &
         new_unittest("rows beyond the room at first are kept", test_room) &
         ]
   end subroutine collect_extremes

   !> Two waves with extremes 1 and -1 at places of their own, and a constant.
   pure function row(angle, shift) result(values)
      real(wp), intent(in) :: angle, shift
      real(wp) :: values(3)

      values = [cos(angle - shift), sin(2.0_wp*angle + shift), 4.0_wp]
   end function row

   !> Sample at even steps in two passes, then where a row is wanted.
   subroutine sample(samples, steps, shift)
      type(samples_t), intent(out) :: samples
      integer, intent(in) :: steps
      real(wp), intent(in) :: shift
      real(wp) :: angle
      logical :: is_wanted
      integer :: i, half

      call start_samples(samples, 3)
      do half = 0, 1
         do i = half, steps - 1, 2
            angle = two_pi*i/steps - pi
            call add_sample(samples, angle, row(angle, shift))
         end do
      end do
      do
         call next_sample(samples, angle, is_wanted)
         if (.not. is_wanted) exit
         call add_sample(samples, angle, row(angle, shift))
      end do
   end subroutine sample

   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      integer :: i

      do i = 1, 20
         call sample(samples, 120, 0.1_wp*i)
         ! what a row has to gain: 1e-7 of the range of 2; the samples alone miss up to 1e-3
         call check(error, maxval(abs(smallest_of(samples) - [-1.0_wp, -1.0_wp, 4.0_wp])) <= 2.0e-7_wp, "smallest")
         if (allocated(error)) return
         call check(error, maxval(abs(largest_of(samples) - [1.0_wp, 1.0_wp, 4.0_wp])) <= 2.0e-7_wp, "largest")
         if (allocated(error)) return
         ! four extremes with a few rows each, none for the constant
         call check(error, samples%count <= 120 + 12, "too many rows")
         if (allocated(error)) return
      end do
   end subroutine test_between

   subroutine test_seam(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: highest(3)

      ! the first wave is highest at a thousandth before the angle where rows of one turn begin
      call sample(samples, 119, -1.0e-3_wp)
      highest = largest_of(samples)
      call check(error, highest(1), 1.0_wp, thr=2.0e-7_wp)
   end subroutine test_seam

   subroutine test_kink(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: angle, lowest(1)
      logical :: is_wanted
      integer :: i

      call start_samples(samples, 1)
      do i = 0, 359
         angle = two_pi*i/360
         call add_sample(samples, angle, [abs(angle - 1.0_wp)*merge(5.0_wp, 1.0_wp, angle > 1.0_wp)])
      end do
      call add_sample(samples, 1.0_wp, [0.0_wp])
      do
         call next_sample(samples, angle, is_wanted)
         if (.not. is_wanted) exit
         call add_sample(samples, angle, [abs(angle - 1.0_wp)*merge(5.0_wp, 1.0_wp, angle > 1.0_wp)])
      end do
      lowest = smallest_of(samples)
      call check(error, lowest(1), 0.0_wp, thr=0.0_wp)
   end subroutine test_kink

   subroutine test_room(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3)

      call sample(samples, 5000, 0.3_wp)
      call check(error, samples%count >= 5000, "rows are missing")
      if (allocated(error)) return
      lowest = smallest_of(samples)
      call check(error, lowest(1), -1.0_wp, thr=2.0e-7_wp)
   end subroutine test_room

end module test_extremes
