!> Quadrature: exactness of the fixed rules, accuracy and honesty of the adaptive one.
module test_quadrature
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_quadrature, only : gauss_legendre, integrand_t, integrate, integral_reached, integral_not_reached
   implicit none
   private

   public :: collect_quadrature

   !> Round-off allowed in values of order one [-]
   real(wp), parameter :: round_off = 100.0_wp*epsilon(1.0_wp)

   !> x to a power
   type, extends(integrand_t) :: power_t
      integer :: exponent
   contains
      procedure :: value => power_value
   end type power_t

   !> Peak at 0.3 of a given width, 1/(w^2 + (x - 0.3)^2)
   type, extends(integrand_t) :: peak_t
      !> Half width [-]
      real(wp) :: width
   contains
      procedure :: value => peak_value
   end type peak_t

   !> Step at 1/pi
   type, extends(integrand_t) :: step_t
   contains
      procedure :: value => step_value
   end type step_t

contains

   subroutine collect_quadrature(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a Gauss rule of n points is exact to degree 2 n - 1 and not beyond", test_gauss), &
         new_unittest("one interval of the adaptive rule is exact to degree 22", test_kronrod), &
         new_unittest("a sharp peak is integrated to the tolerance", test_peak), &
         new_unittest("exchanged ends change the sign, equal ends give zero", test_ends), &
         new_unittest("a jump is integrated, and an impossible tolerance ends at round-off", test_jump), &
         new_unittest("a peak too sharp for the intervals is reported", test_not_reached) &
         ]
   end subroutine collect_quadrature

   function power_value(self, x) result(f)
      class(power_t), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp) :: f

      f = x**self%exponent
   end function power_value

   function peak_value(self, x) result(f)
      class(peak_t), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp) :: f

      f = 1.0_wp/(self%width**2 + (x - 0.3_wp)**2)
   end function peak_value

   function step_value(self, x) result(f)
      class(step_t), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp) :: f

      f = merge(1.0_wp, 0.0_wp, x > 1.0_wp/pi .and. same_type_as(self, self))
   end function step_value

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

   subroutine test_kronrod(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: integral, doubt
      integer :: k, status

      do k = 0, 22
         ! with a tolerance of 1 no interval is halved
         call integrate(power_t(k), 0.0_wp, 2.0_wp, 1.0e30_wp, integral, doubt, status)
         call check(error, abs(integral/(2.0_wp**(k + 1)/real(k + 1, wp)) - 1.0_wp) < round_off, "power is not exact")
         if (allocated(error)) return
      end do
   end subroutine test_kronrod

   subroutine test_peak(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: width = 1.0e-3_wp
      real(wp) :: integral, doubt, exact
      integer :: status

      exact = (atan(0.7_wp/width) + atan(0.3_wp/width))/width
      call integrate(peak_t(width), 0.0_wp, 1.0_wp, 1.0e-6_wp, integral, doubt, status)
      call check(error, status == integral_reached .and. abs(integral - exact) < 1.0e-6_wp .and. doubt < 1.0e-6_wp)
      if (allocated(error)) return
      call check(error, abs(integral - exact) <= doubt + round_off*exact, "the error is larger than its estimate")
   end subroutine test_peak

   subroutine test_ends(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: integral, doubt
      integer :: status

      call integrate(power_t(2), 1.0_wp, 0.0_wp, 1.0e-12_wp, integral, doubt, status)
      call check(error, abs(integral + 1.0_wp/3.0_wp) < round_off)
      if (allocated(error)) return
      call integrate(power_t(2), 1.0_wp, 1.0_wp, 1.0e-12_wp, integral, doubt, status)
      call check(error, abs(integral) <= 0.0_wp .and. status == integral_reached)
   end subroutine test_ends

   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: integral, doubt
      integer :: status

      call integrate(step_t(), 0.0_wp, 1.0_wp, 0.0_wp, integral, doubt, status)
      call check(error, status == integral_reached .and. abs(integral - (1.0_wp - 1.0_wp/pi)) < round_off)
   end subroutine test_jump

   subroutine test_not_reached(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: integral, doubt
      integer :: status

      call integrate(peak_t(1.0e-100_wp), 0.3_wp, 1.0_wp, 1.0e-6_wp, integral, doubt, status)
      call check(error, status == integral_not_reached)
   end subroutine test_not_reached

end module test_quadrature
