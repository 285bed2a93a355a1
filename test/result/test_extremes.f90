!> Extremes of series sampled at angles in any order.
module test_extremes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_extremes, only : samples_t, start_samples, add_sample, start_search, most_steps
   use camroller_extremum, only : extremum_t, narrow_extremum
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

   !> Sample at even steps in two passes, then search; the searches' values.
   subroutine sample(samples, steps, shift, lowest, highest, evaluations)
      type(samples_t), intent(out) :: samples
      integer, intent(in) :: steps
      real(wp), intent(in) :: shift
      real(wp), intent(out) :: lowest(3), highest(3)
      integer, intent(out) :: evaluations
      type(extremum_t) :: search
      real(wp) :: angle, values(3)
      integer :: i, half, series, sense

      call start_samples(samples, 3)
      do half = 0, 1
         do i = half, steps - 1, 2
            angle = two_pi*i/steps - pi
            call add_sample(samples, angle, row(angle, shift), .false.)
         end do
      end do
      evaluations = 0
      do series = 1, 3
         do sense = -1, 1, 2
            call start_search(samples, series, sense, search)
            do while (search%is_wanted .and. search%steps < most_steps)
               values = row(search%trial, shift)
               call narrow_extremum(search, sense*values(series))
               evaluations = evaluations + 1
            end do
            if (sense > 0) lowest(series) = search%value(2)
            if (sense < 0) highest(series) = -search%value(2)
         end do
      end do
   end subroutine sample

   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: i, evaluations

      do i = 1, 20
         call sample(samples, 120, 0.1_wp*i, lowest, highest, evaluations)
         ! a gain of 1e-6 of the extent of 2 is not worth a value; the samples alone miss up to 1e-3
         call check(error, maxval(abs(lowest - [-1.0_wp, -1.0_wp, 4.0_wp])) <= 2.0e-6_wp, "smallest")
         if (allocated(error)) return
         call check(error, maxval(abs(highest - [1.0_wp, 1.0_wp, 4.0_wp])) <= 2.0e-6_wp, "largest")
         if (allocated(error)) return
         ! four extremes with a few values each, none for the constant
         call check(error, evaluations <= 4*4, "too many values")
         if (allocated(error)) return
      end do
   end subroutine test_between

   subroutine test_seam(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: evaluations

      ! the first wave is highest at a thousandth before the angle where rows of one turn begin
      call sample(samples, 119, -1.0e-3_wp, lowest, highest, evaluations)
      call check(error, highest(1), 1.0_wp, thr=2.0e-6_wp)
   end subroutine test_seam

   subroutine test_kink(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      type(extremum_t) :: search
      real(wp) :: angle
      integer :: i

      call start_samples(samples, 1)
      do i = 0, 359
         angle = two_pi*i/360
         call add_sample(samples, angle, [abs(angle - 1.0_wp)*merge(5.0_wp, 1.0_wp, angle > 1.0_wp)], .false.)
      end do
      call add_sample(samples, 1.0_wp, [0.0_wp], .true.)
      call start_search(samples, 1, 1, search)
      call check(error, .not. search%is_wanted, "a value beside a kink is wanted")
      if (allocated(error)) return
      call check(error, search%value(2), 0.0_wp, thr=0.0_wp)
   end subroutine test_kink

   subroutine test_room(error)
      type(error_type), allocatable, intent(out) :: error
      type(samples_t) :: samples
      real(wp) :: lowest(3), highest(3)
      integer :: evaluations

      call sample(samples, 5000, 0.3_wp, lowest, highest, evaluations)
      call check(error, samples%count, 5000)
      if (allocated(error)) return
      call check(error, lowest(1), -1.0_wp, thr=2.0e-6_wp)
   end subroutine test_room

end module test_extremes
