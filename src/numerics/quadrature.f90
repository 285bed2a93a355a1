!> Numerical integration: Gauss-Legendre rules of any order.
!>
!> In: an order. Out: places and weights. Source: Davis and Rabinowitz (1984), Methods of Numerical Integration.
module camroller_quadrature
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: gauss_legendre

contains

   !> Places and weights of the Gauss-Legendre rule on (-1, 1); exact for polynomials of degree 2 n - 1.
   !>
   !> Newton's method on the Legendre polynomial from an asymptotic start (Davis and Rabinowitz, section 2.7).
   pure subroutine gauss_legendre(places, weights)
      !> Places, increasing; their number chooses the rule [-]
      real(wp), intent(out) :: places(:)
      !> Weights [-]
      real(wp), intent(out) :: weights(:)

      !> Steps of Newton's method: convergence is quadratic from two digits on
      integer, parameter :: steps = 6
      !> Place, polynomial, its derivative [-]
      real(wp) :: x, p, slope
      integer :: i, n, step

      n = size(places)
      do i = 1, (n + 1)/2
         x = cos(pi*(real(i, wp) - 0.25_wp)/(real(n, wp) + 0.5_wp))
         do step = 1, steps
            call legendre(n, x, p, slope)
            x = x - p/slope
         end do
         if (2*i == n + 1) x = 0.0_wp
         call legendre(n, x, p, slope)
         places(n + 1 - i) = x
         places(i) = -x
         weights(i) = 2.0_wp/((1.0_wp - x)*(1.0_wp + x)*slope**2)
         weights(n + 1 - i) = weights(i)
      end do
   end subroutine gauss_legendre

   !> Legendre polynomial and its derivative inside (-1, 1), by the recurrence of three terms.
   pure subroutine legendre(n, x, p, slope)
      !> Degree, at least 1
      integer, intent(in) :: n
      !> Point [-]
      real(wp), intent(in) :: x
      !> Value [-]
      real(wp), intent(out) :: p
      !> Derivative [-]
      real(wp), intent(out) :: slope

      !> Polynomials of the two degrees below [-]
      real(wp) :: below, before
      integer :: k

      below = 1.0_wp
      p = x
      do k = 2, n
         before = below
         below = p
         p = (real(2*k - 1, wp)*x*below - real(k - 1, wp)*before)/real(k, wp)
      end do
      slope = real(n, wp)*(below - x*p)/((1.0_wp - x)*(1.0_wp + x))
   end subroutine legendre

end module camroller_quadrature
