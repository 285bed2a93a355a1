!> Modified Bessel functions of the second kind, of order 0 and 1.
!>
!> In: a positive number. Out: both functions times its exponential, so that large numbers do no harm. Exact to a few roundings.
!> Sources: Abramowitz and Stegun (1964) eqs. 9.6.10, 9.6.13, 9.6.15, the series; Temme, J. Computational Physics 19 (1975) 324, the
!> continued fraction.
module camroller_bessel
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: scaled_bessel_k, euler_constant

   !> Euler's constant [-]
   real(wp), parameter :: euler_constant = 0.57721566490153286061_wp
   !> Number up to which the series is quicker than the continued fraction [-]
   real(wp), parameter :: small = 2.0_wp
   !> Terms: the series takes up to 12, the fraction up to about 50
   integer, parameter :: max_terms = 200

contains

   !> `e^x K_0(x)` and `e^x K_1(x)`.
   elemental subroutine scaled_bessel_k(x, zero, one)
      !> A positive number [-]
      real(wp), intent(in) :: x
      !> The functions of order 0 and 1, times e^x [-]
      real(wp), intent(out) :: zero, one

      if (x <= small) then
         call by_series(x, zero, one)
      else
         call by_fraction(x, zero, one)
      end if
   end subroutine scaled_bessel_k

   !> Both by the power series of K_0 and I_1; K_1 by the Wronskian `I_0 K_1 + I_1 K_0 = 1/x`.
   elemental subroutine by_series(x, zero, one)
      !> A positive number up to `small` [-]
      real(wp), intent(in) :: x
      !> The functions of order 0 and 1, times e^x [-]
      real(wp), intent(out) :: zero, one

      ! (x/2)^2; a term; sums for I_0, I_1 and K_0; 1 + 1/2 + ... + 1/k [-]
      real(wp) :: square, term, first, second, third, harmonic
      integer :: k

      square = 0.25_wp*x**2
      term = 1.0_wp
      first = 1.0_wp
      second = 1.0_wp
      third = 0.0_wp
      harmonic = 0.0_wp
      do k = 1, max_terms
         term = term*square/real(k, wp)**2
         harmonic = harmonic + 1.0_wp/k
         first = first + term
         second = second + term/(k + 1)
         third = third + term*harmonic
         if (term*harmonic <= epsilon(x)*first) exit
      end do
      zero = third - (log(0.5_wp*x) + euler_constant)*first
      one = (1.0_wp/x - 0.5_wp*x*second*zero)/first*exp(x)
      zero = zero*exp(x)
   end subroutine by_series

   !> Both by Temme's continued fraction, summed from its head.
   elemental subroutine by_fraction(x, zero, one)
      !> A number above `small` [-]
      real(wp), intent(in) :: x
      !> The functions of order 0 and 1, times e^x [-]
      real(wp), intent(out) :: zero, one

      ! Partial numerator and denominator; inverse denominator, change and value of the fraction [-]
      real(wp) :: a, b, d, change, fraction
      ! Recurrence, its coefficient, weights and their sum with its change [-]
      real(wp) :: older, old, new, c, weight, total, share
      integer :: i

      b = 2.0_wp*(1.0_wp + x)
      d = 1.0_wp/b
      fraction = d
      change = d
      older = 0.0_wp
      old = 1.0_wp
      c = 0.25_wp
      weight = c
      a = -c
      total = 1.0_wp + weight*change
      do i = 2, max_terms
         a = a - 2*(i - 1)
         c = -a*c/i
         new = (older - b*old)/a
         older = old
         old = new
         weight = weight + c*new
         b = b + 2.0_wp
         d = 1.0_wp/(b + a*d)
         change = (b*d - 1.0_wp)*change
         fraction = fraction + change
         share = weight*change
         total = total + share
         if (abs(share) <= epsilon(x)*abs(total)) exit
      end do
      zero = sqrt(0.5_wp*pi/x)/total
      one = zero*(x + 0.5_wp - 0.25_wp*fraction)/x
   end subroutine by_fraction

end module camroller_bessel
