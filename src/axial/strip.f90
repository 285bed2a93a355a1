!> What a strip of a line contact moves the surfaces by, along the line in its middle.
!>
!> In: distances along the axis, half width of the strip. Out: the function F of their ratio t and its slope over ln t. The
!> semi-ellipse of pressure of half width b and unit load per length, from a place to the distance s along the axis, moves the
!> surfaces there by `2/(pi E') F(s/b)`:
!>
!>     F(t) = 4/pi int_0^1 sqrt(1 - x^2) asinh(t/x) dx
!>
!> Far away this is `ln(4 sqrt(e) t)`, the strip of a long contact, and close by `(4/pi) t ln(4/t)`: the pressure is spread over the
!> width, so that strips far shorter than they are wide have loads that are determined. In between polynomials of t^2 and 1/t^2.
module camroller_strip
   use camroller_kinds, only : wp
   implicit none
   private

   public :: strip_function

   !> ln(4 sqrt(e)) [-]
   real(wp), parameter :: far_part = 2.0_wp*log(2.0_wp) + 0.5_wp
   !> `F - ln(4 sqrt(e) t)` for t above 1: coefficients of t^-2, t^-4, ..., to 2e-12 [-]
   real(wp), parameter :: far_powers(*) = [6.249999999862e-02_wp, -1.171874966501e-02_wp, 4.068996807575e-03_wp, &
      & -1.868983078229e-03_wp, 1.007537958038e-03_wp, -5.966679369391e-04_wp, 3.622626668278e-04_wp, -2.032964622277e-04_wp, &
      & 9.156503121716e-05_wp, -2.755258699026e-05_wp, 3.979358290243e-06_wp]
   !> `F/t = p + q ln(1/t)` for t below 1: coefficients of t^0, t^2, ... of p and q, to 1e-11 [-]
   real(wp), parameter :: near_powers(*) = [1.765084801223e+00_wp, 1.824581648408e-01_wp, -8.987797057449e-03_wp, &
      & 1.761253115868e-03_wp, -5.597502532511e-04_wp, 2.266110136996e-04_wp, -1.001228301394e-04_wp, 4.037196952340e-05_wp, &
      & -1.181261197699e-05_wp, 1.733801220136e-06_wp]
   real(wp), parameter :: near_logs(*) = [1.273239544746e+00_wp, 1.061032933198e-01_wp, -1.193655105069e-02_wp, &
      & 3.551643590761e-03_wp, -1.504751235131e-03_wp, 7.532589302005e-04_wp, -3.868939668573e-04_wp, 1.719242329742e-04_wp, &
      & -5.333108880324e-05_wp, 8.103908458098e-06_wp]

contains

   !> The function at distances that grow.
   pure subroutine strip_function(distances, logs, width, values, slopes)
      !> Distances along the axis, rising, above zero [any length]; their logarithms
      real(wp), intent(in) :: distances(:), logs(:)
      !> Half width, above zero [the same length]
      real(wp), intent(in) :: width
      !> F; its slope over ln t, where wanted [-]
      real(wp), intent(out) :: values(:)
      real(wp), intent(out), optional :: slopes(:)

      ! ln(width); t^2 or t^-2; polynomials and their slopes [-]
      real(wp) :: log_width
      real(wp), dimension(size(distances)) :: square, sums, rises
      integer :: near

      log_width = log(width)
      near = count(distances < width)
      if (near > 0) then
         call sum_powers(near_powers, (distances(:near)/width)**2, sums(:near), rises(:near))
         values(:near) = sums(:near)
         if (present(slopes)) slopes(:near) = rises(:near)
         call sum_powers(near_logs, (distances(:near)/width)**2, sums(:near), rises(:near))
         values(:near) = distances(:near)/width*(values(:near) + (log_width - logs(:near))*sums(:near))
         if (present(slopes)) slopes(:near) = values(:near) + distances(:near)/width*(2.0_wp*(distances(:near)/width)**2 &
            & *(slopes(:near) + (log_width - logs(:near))*rises(:near)) - sums(:near))
      end if
      square(near + 1:) = (width/distances(near + 1:))**2
      call sum_powers(far_powers, square(near + 1:), sums(near + 1:), rises(near + 1:))
      values(near + 1:) = far_part + logs(near + 1:) - log_width + sums(near + 1:)*square(near + 1:)
      if (present(slopes)) slopes(near + 1:) = 1.0_wp - 2.0_wp*square(near + 1:)*(sums(near + 1:) + square(near + 1:) &
         & *rises(near + 1:))
   end subroutine strip_function

   !> Polynomials and their derivatives.
   pure subroutine sum_powers(factors, x, sums, slopes)
      !> Coefficients of x^0, x^1, ... [-]
      real(wp), intent(in) :: factors(:)
      !> Where [-]
      real(wp), intent(in), contiguous :: x(:)
      !> Sums, their derivatives over x [-]
      real(wp), intent(out), contiguous :: sums(:), slopes(:)

      integer :: i, j

      sums = factors(size(factors))
      slopes = 0.0_wp
      do j = size(factors) - 1, 1, -1
         do i = 1, size(x)
            slopes(i) = slopes(i)*x(i) + sums(i)
            sums(i) = sums(i)*x(i) + factors(j)
         end do
      end do
   end subroutine sum_powers

end module camroller_strip
