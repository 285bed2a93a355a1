!> Quadrature: exactness of the rules.
module test_quadrature
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_quadrature, only : gauss_legendre
   implicit none
   private

   public :: collect_quadrature

   !> Round-off allowed in values of order one [-]
   real(wp), parameter :: round_off = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_quadrature(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a Gauss rule of n points is exact to degree 2 n - 1 and not beyond", test_gauss) &
         ]
   end subroutine collect_quadrature

   subroutine test_gauss(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: x(:), w(:)
      integer :: n, k

      do n = 1, 40
         allocate (x(n), w(n))
         call gauss_legendre(x, w)
         do k = 0, 2*n - 2, 2
            call check(error, abs(sum(w*x**k) - 2.0_wp/real(k + 1, wp)) < round_off, "even power is not exact")
            if (allocated(error)) return
            call check(error, abs(sum(w*x**(k + 1))) < round_off, "odd power is not exact")
            if (allocated(error)) return
         end do
         if (n < 12) call check(error, abs(sum(w*x**(2*n)) - 2.0_wp/real(2*n + 1, wp)) > 1.0e-8_wp, "exact beyond its degree")
         if (allocated(error)) return
         deallocate (x, w)
      end do
   end subroutine test_gauss

end module test_quadrature
