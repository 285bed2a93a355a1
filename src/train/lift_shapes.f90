!> Shapes of the lift laws that are sums of powers.
!>
!> In: the distance from the nose as a part of the half angle. Out: the lift over the maximum lift, with three derivatives. Sources:
!> Dudley (1948), SAE Quarterly Transactions 2(1), and Stoddart (1953), Machine Design 25.
module camroller_lift_shapes
   use camroller_kinds, only : wp
   implicit none
   private

   public :: power_shape, polydyne_shape

contains

   !> `(1 - y^2)^n`.
   pure subroutine power_shape(n, y, f)
      !> Exponent, at least 3
      integer, intent(in) :: n
      !> Distance from the nose, 0 to 1 [-]
      real(wp), intent(in) :: y
      !> Value and derivatives [-]
      real(wp), intent(out) :: f(0:3)

      !> 1 - y^2 and its power n - 3 [-]
      real(wp) :: v, power
      !> n [-]
      real(wp) :: a

      a = real(n, wp)
      v = (1.0_wp - y)*(1.0_wp + y)
      power = v**(n - 3)
      f(0) = power*v**3
      f(1) = -2.0_wp*a*y*power*v**2
      f(2) = 2.0_wp*a*power*v*(2.0_wp*(a - 1.0_wp)*y**2 - v)
      f(3) = 4.0_wp*a*(a - 1.0_wp)*y*power*(3.0_wp*v - 2.0_wp*(a - 2.0_wp)*y**2)
   end subroutine power_shape

   !> Sum of powers.
   pure subroutine polydyne_shape(exponents, coefficients, y, f)
      !> Exponents, the first one 0, the others at least 2
      integer, intent(in) :: exponents(:)
      !> Coefficients [-]
      real(wp), intent(in) :: coefficients(:)
      !> Distance from the nose, 0 to 1 [-]
      real(wp), intent(in) :: y
      !> Value and derivatives [-]
      real(wp), intent(out) :: f(0:3)

      !> Exponent, and the term over its power of y up to the third derivative [-]
      real(wp) :: e, c
      integer :: i

      f = 0.0_wp
      f(0) = coefficients(1)
      do i = 2, size(exponents)
         e = real(exponents(i), wp)
         c = coefficients(i)
         f(0) = f(0) + c*y**exponents(i)
         f(1) = f(1) + c*e*y**(exponents(i) - 1)
         f(2) = f(2) + c*e*(e - 1.0_wp)*y**(exponents(i) - 2)
         if (exponents(i) > 2) f(3) = f(3) + c*e*(e - 1.0_wp)*(e - 2.0_wp)*y**(exponents(i) - 3)
      end do
   end subroutine polydyne_shape

end module camroller_lift_shapes
