!> Dual numbers against difference quotients.
module test_dual
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_dual, only : dual_t, constant_part, operator(+), operator(-), operator(*), operator(/), abs, sqrt, tanh
   implicit none
   private

   public :: collect_dual

contains

   subroutine collect_dual(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a formula of all operations has the slope of its difference quotient", test_formula), &
         new_unittest("a constant has no slope, nor has the root of zero", test_constants) &
         ]
   end subroutine collect_dual

   !> Every operation once.
   pure function formula(x) result(y)
      type(dual_t), intent(in) :: x
      type(dual_t) :: y

      y = sqrt(x*x + 1.0_wp)*(3.0_wp - x) - (-(x/4.0_wp)) + tanh(x - constant_part(x)*x)*abs(1.0_wp - 2.0_wp*x)
   end function formula

   subroutine test_formula(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the difference [-]: the cube root of round-off, which leaves its square
      real(wp), parameter :: h = 6.0e-6_wp, tolerance = 1.0e-9_wp
      real(wp), parameter :: places(4) = [-1.7_wp, -0.2_wp, 0.9_wp, 1.5_wp]
      type(dual_t) :: value, high, low
      integer :: i

      do i = 1, size(places)
         value = formula(dual_t(places(i), 1.0_wp))
         high = held_formula(places(i), h)
         low = held_formula(places(i), -h)
         call check(error, value%slope, (high%value - low%value)/(2.0_wp*h), "slope", thr=tolerance)
         if (allocated(error)) return
      end do
   end subroutine test_formula

   !> The same formula with the constant part held at its place.
   pure function held_formula(x, step) result(y)
      real(wp), intent(in) :: x, step
      type(dual_t) :: y, moved

      moved = dual_t(x + step, 0.0_wp)
      y = sqrt(moved*moved + 1.0_wp)*(3.0_wp - moved) - (-(moved/4.0_wp)) + tanh(moved - x*moved)*abs(1.0_wp - 2.0_wp*moved)
   end function held_formula

   subroutine test_constants(error)
      type(error_type), allocatable, intent(out) :: error
      type(dual_t) :: number

      number = constant_part(dual_t(3.0_wp, 2.0_wp))
      call check(error, number%slope, 0.0_wp, "slope of a constant", thr=tiny(1.0_wp))
      if (allocated(error)) return
      number = sqrt(dual_t(0.0_wp, 2.0_wp))
      call check(error, number%slope, 0.0_wp, "slope of the root of zero", thr=tiny(1.0_wp))
      if (allocated(error)) return
      number = abs(dual_t(-2.0_wp, 3.0_wp))
      call check(error, number%slope, -3.0_wp, "slope of a size", thr=epsilon(1.0_wp))
   end subroutine test_constants

end module test_dual
