!> Camshaft: balance of forces and moments over every span.
module test_camshaft
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_bearing_loads, only : bearing_shares, belt_pull_t, pull_loads
   implicit none
   private

   public :: collect_camshaft

   !> Round-off allowed in values of order one hundred [-]
   real(wp), parameter :: round_off = 1.0e4_wp*epsilon(1.0_wp)

contains

   subroutine collect_camshaft(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a cam in the middle loads both neighbours alike and no other", test_middle), &
         new_unittest("forces and moments balance", test_balance), &
         new_unittest("a cam over a bearing loads this one only", test_over_bearing), &
         new_unittest("a pull beyond the last bearing is balanced by the two beside it", test_overhang) &
         ]
   end subroutine collect_camshaft

   subroutine test_middle(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, all(abs(bearing_shares([0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp], 0.15_wp) - [0.0_wp, 0.5_wp, 0.5_wp, 0.0_wp]) &
         & < round_off))
   end subroutine test_middle

   subroutine test_balance(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: places(4) = [0.01_wp, 0.09_wp, 0.2_wp, 0.23_wp]
      real(wp), parameter :: cams(6) = [0.01_wp, 0.03_wp, 0.08_wp, 0.12_wp, 0.21_wp, 0.23_wp]
      real(wp) :: shares(4)
      integer :: i, span

      do i = 1, size(cams)
         shares = bearing_shares(places, cams(i))
         call check(error, abs(sum(shares) - 1.0_wp) < round_off .and. abs(sum(shares*places) - cams(i)) < round_off, "balance")
         if (allocated(error)) return
         ! each span by itself is a beam on two supports
         span = count(places(2:3) <= cams(i)) + 1
         shares(span:span + 1) = 0.0_wp
         call check(error, all(abs(shares) <= 0.0_wp), "another span")
         if (allocated(error)) return
      end do
   end subroutine test_balance

   subroutine test_over_bearing(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: places(3) = [0.0_wp, 0.1_wp, 0.25_wp]
      real(wp) :: expected(3)
      integer :: i

      do i = 1, 3
         expected = 0.0_wp
         expected(i) = 1.0_wp
         call check(error, all(abs(bearing_shares(places, places(i)) - expected) < epsilon(1.0_wp)))
         if (allocated(error)) return
      end do
   end subroutine test_over_bearing

   subroutine test_overhang(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: places(3) = [0.0_wp, 0.1_wp, 0.25_wp], wheels(4) = [-0.03_wp, 0.02_wp, 0.2_wp, 0.31_wp]
      real(wp) :: loads(2, 3)
      integer :: i

      do i = 1, size(wheels)
         loads = pull_loads(places, belt_pull_t(500.0_wp, 2.0_wp, wheels(i)))
         call check(error, all(abs(sum(loads, 2) - 500.0_wp*[cos(2.0_wp), sin(2.0_wp)]) < round_off) .and. &
            & all(abs(matmul(loads, places) - 500.0_wp*wheels(i)*[cos(2.0_wp), sin(2.0_wp)]) < round_off), "balance")
         if (allocated(error)) return
         ! the span beyond the second bearing does not feel a wheel before it
         call check(error, all(abs(loads(:, merge(3, 1, wheels(i) < 0.1_wp))) <= 0.0_wp), "another span")
         if (allocated(error)) return
      end do
   end subroutine test_overhang

end module test_camshaft
