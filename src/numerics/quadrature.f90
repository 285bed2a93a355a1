!> Numerical integration: Gauss-Legendre rules of any order, and an adaptive rule with an error estimate.
!>
!> In: an order, or a function and its interval. Out: nodes and weights, or the integral. The integrand is a type that extends
!> `integrand_t` and carries the data it needs. Sources: Davis and Rabinowitz (1984), Methods of Numerical Integration; Piessens
!> and others (1983), QUADPACK.
module camroller_quadrature
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: gauss_legendre, integrand_t, integrate
   public :: integral_reached, integral_not_reached

   !> The integral is known to the tolerance, or to round-off
   integer, parameter :: integral_reached = 0
   !> The intervals allowed do not reach the tolerance
   integer, parameter :: integral_not_reached = 1

   !> Intervals allowed
   integer, parameter :: max_intervals = 500

   !> Places of the Kronrod rule of 15 points on (-1, 1), positive half; every second one belongs to Gauss' rule of 7
   !> [-]
   real(wp), parameter :: kronrod_places(8) = [ &
      0.991455371120812639206854697526329_wp, 0.949107912342758524526189684047851_wp, &
      0.864864423359769072789712788640926_wp, 0.741531185599394439863864773280788_wp, &
      0.586087235467691130294144838258730_wp, 0.405845151377397166906606412076961_wp, &
      0.207784955007898467600689403773245_wp, 0.0_wp]
   !> Weights of the Kronrod rule [-]
   real(wp), parameter :: kronrod_weights(8) = [ &
      0.022935322010529224963732008058970_wp, 0.063092092629978553290700663189204_wp, &
      0.104790010322250183839876322541518_wp, 0.140653259715525918745189590510238_wp, &
      0.169004726639267902826583426598550_wp, 0.190350578064785409913256402421014_wp, &
      0.204432940075298892414161999234649_wp, 0.209482141084727828012999174891714_wp]
   !> Weights of Gauss' rule [-]
   real(wp), parameter :: gauss_weights(4) = [ &
      0.129484966168869693270611432679082_wp, 0.279705391489276667901467771423780_wp, &
      0.381830050505118944950369775488975_wp, 0.417959183673469387755102040816327_wp]

   !> A function of one variable
   type, abstract :: integrand_t
   contains
      procedure(integrand_value), deferred :: value
   end type integrand_t

   abstract interface
      !> Value of the function at a point
      function integrand_value(self, x) result(f)
         import :: integrand_t, wp
         !> The function
         class(integrand_t), intent(in) :: self
         !> Point [x]
         real(wp), intent(in) :: x
         !> Value [f]
         real(wp) :: f
      end function integrand_value
   end interface

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

   !> Integral over an interval to an absolute tolerance; the interval of the largest error is halved until the sum is
   !> good.
   !>
   !> Errors below round-off of the integral of the magnitude count as reached, whatever the tolerance.
   subroutine integrate(integrand, lower, upper, tolerance, integral, error_estimate, status)
      !> The function
      class(integrand_t), intent(in) :: integrand
      !> Start of the interval [x]
      real(wp), intent(in) :: lower
      !> End of the interval [x]
      real(wp), intent(in) :: upper
      !> Absolute tolerance [f x]
      real(wp), intent(in) :: tolerance
      !> The integral [f x]
      real(wp), intent(out) :: integral
      !> Bound of its error, as a rule far above it [f x]
      real(wp), intent(out) :: error_estimate
      !> `integral_reached` or `integral_not_reached`
      integer, intent(out) :: status

      !> Ends of the intervals [x]
      real(wp) :: left(max_intervals), right(max_intervals)
      !> Integrals, errors and integrals of the magnitude over them [f x]
      real(wp) :: part(max_intervals), doubt(max_intervals), magnitude(max_intervals)
      integer :: n, worst

      left(1) = lower
      right(1) = upper
      call kronrod_rule(integrand, lower, upper, part(1), doubt(1), magnitude(1))
      do n = 1, max_intervals - 1
         integral = sum(part(:n))
         error_estimate = sum(doubt(:n))
         status = integral_reached
         if (error_estimate <= max(tolerance, 50.0_wp*epsilon(1.0_wp)*sum(magnitude(:n)))) return
         worst = maxloc(doubt(:n), dim=1)
         right(n + 1) = right(worst)
         left(n + 1) = 0.5_wp*(left(worst) + right(worst))
         right(worst) = left(n + 1)
         call kronrod_rule(integrand, left(worst), right(worst), part(worst), doubt(worst), magnitude(worst))
         call kronrod_rule(integrand, left(n + 1), right(n + 1), part(n + 1), doubt(n + 1), magnitude(n + 1))
      end do
      status = integral_not_reached
   end subroutine integrate

   !> Gauss-Kronrod rule of 7 and 15 points on one interval, with the error estimate of QUADPACK's QK15.
   subroutine kronrod_rule(integrand, lower, upper, integral, doubt, magnitude)
      !> The function
      class(integrand_t), intent(in) :: integrand
      !> Start of the interval [x]
      real(wp), intent(in) :: lower
      !> End of the interval [x]
      real(wp), intent(in) :: upper
      !> The integral [f x]
      real(wp), intent(out) :: integral
      !> Estimate of its error [f x]
      real(wp), intent(out) :: doubt
      !> Integral of the magnitude [f x]
      real(wp), intent(out) :: magnitude

      !> Middle and half width [x]; values on both sides of the middle, mean value [f]
      real(wp) :: middle, half, left(8), right(8), mean
      !> Integral by Gauss' rule, and of the distance from the mean [f x]
      real(wp) :: coarse, variation
      integer :: i

      integral = 0.0_wp
      doubt = 0.0_wp
      magnitude = 0.0_wp
      if (abs(upper - lower) <= 0.0_wp) return
      middle = 0.5_wp*(lower + upper)
      half = 0.5_wp*(upper - lower)
      do i = 1, 7
         left(i) = integrand%value(middle - half*kronrod_places(i))
         right(i) = integrand%value(middle + half*kronrod_places(i))
      end do
      ! the middle counts once: it stands on the left only
      left(8) = integrand%value(middle)
      right(8) = 0.0_wp
      integral = half*sum(kronrod_weights*(left + right))
      coarse = half*sum(gauss_weights*(left(2:8:2) + right(2:8:2)))
      magnitude = abs(half)*sum(kronrod_weights*(abs(left) + abs(right)))
      mean = 0.5_wp*integral/half
      variation = abs(half)*(sum(kronrod_weights*abs(left - mean)) + sum(kronrod_weights(:7)*abs(right(:7) - mean)))
      doubt = abs(integral - coarse)
      if (variation > 0.0_wp .and. 200.0_wp*doubt < variation) doubt = variation*(200.0_wp*doubt/variation)**1.5_wp
   end subroutine kronrod_rule

end module camroller_quadrature
