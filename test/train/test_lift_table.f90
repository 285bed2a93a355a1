!> Noise of lift tables.
module test_lift_table
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_lift_table, only : estimate_noise
   implicit none
   private

   public :: collect_lift_table

   !> Lift [m] and half angle [rad]
   real(wp), parameter :: height = 9.5e-3_wp, opening = 70.0_wp*degree

contains

   subroutine collect_lift_table(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("noise of a rounded table is that of rounding, finer digits of a noisy one change nothing", test_rounding) &
         ]
   end subroutine collect_lift_table

   !> The median of differences that are whole steps is off by up to a third; where noise is larger than the step it counts.
   subroutine test_rounding(error)
      type(error_type), allocatable, intent(out) :: error
      ! Steps of the values [m]; noise of rounding over its step [-]
      real(wp), parameter :: steps(*) = [1.0e-7_wp, 1.0e-6_wp, 1.0e-5_wp], per_step = 1.0_wp/sqrt(12.0_wp)
      real(wp), allocatable :: angle(:), exact(:), deviate(:) ! [rad], [m], [-]
      real(wp) :: noise, fine ! [m]
      logical :: is_known
      integer :: i, k, rows

      do k = 1, 4
         rows = 75*2**k
         angle = [(opening*(real(2*i, wp)/real(rows, wp) - 1.0_wp), i=0, rows)]
         exact = height*(1.0_wp - (angle/opening)**2)**4
         do i = 1, size(steps)
            call estimate_noise(angle, steps(i)*anint(exact/steps(i)), noise, is_known)
            call check(error, is_known .and. noise >= 0.999_wp*per_step*steps(i) .and. noise < 2.0_wp*per_step*steps(i), "rounded")
            if (allocated(error)) return
         end do
         ! Sines of squares: as good as random, with more large values than a normal deviate
         deviate = sqrt(2.0_wp)*sin([(real(i, wp)**2, i=0, rows)])
         call estimate_noise(angle, exact + 3.0e-6_wp*deviate, noise, is_known)
         call estimate_noise(angle, 1.0e-7_wp*anint((exact + 3.0e-6_wp*deviate)/1.0e-7_wp), fine, is_known)
         call check(error, fine, noise, rel=.true., thr=0.02_wp, message="noise larger than the step")
         if (allocated(error)) return
         call check(error, noise, 3.0e-6_wp, rel=.true., thr=0.5_wp, message="noise")
         if (allocated(error)) return
         call estimate_noise(angle, exact, noise, is_known)
         call check(error, noise < 1.0e-9_wp, "exact values")
         if (allocated(error)) return
      end do
   end subroutine test_rounding

end module test_lift_table
