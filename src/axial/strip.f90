!> What a strip of a line contact moves the surfaces by, along the line in its middle.
!>
!> In: distances along the axis, half width of the strip. Out: the function F of their ratio t and its slope over ln t. The
!> semi-ellipse of pressure of half width b and unit load per length, from a place to the distance s along the axis, moves the
!> surfaces there by `2/(pi E') F(s/b)`:
!>
!>     F(t) = 4/pi int_0^1 sqrt(1 - x^2) asinh(t/x) dx
!>
!> Far away this is `ln(4 sqrt(e) t)`, the strip of a long contact, and close by `(4/pi) t ln(4/t)`: the pressure is spread over the
!> width, so that strips far shorter than they are wide have loads that are determined. In between polynomials of t^2 and 1/t^2, by
!> `tools/strip_function_fit.py`, with relative errors below 1e-12.
module camroller_strip
   use camroller_kinds, only : wp
   implicit none
   private

   public :: strip_function

   !> ln(4 sqrt(e)) [-]
   real(wp), parameter :: far_part = 2.0_wp*log(2.0_wp) + 0.5_wp
   !> `F - ln(4 sqrt(e) t)` for t above 1: coefficients of t^-2, t^-4, ... [-]
   real(wp), parameter :: far_powers(*) = [ &
      & 6.249999995309995e-02_wp, -1.171874722637073e-02_wp, 4.068952617058711e-03_wp, -1.868592936610545e-03_wp, &
      & 1.005581497866884e-03_wp, -5.906509227524665e-04_wp, 3.505091458842245e-04_wp, -1.886640723466388e-04_wp, &
      & 8.032031817716164e-05_wp, -2.269138165895018e-05_wp, 3.075098212719925e-06_wp]
   !> `F/t = p + q ln(1/t)` for t below 1: coefficients of t^0, t^2, ... of p and q [-]
   real(wp), parameter :: near_powers(*) = [ &
      & 1.765084801221234e+00_wp, 1.824581653068056e-01_wp, -8.987785676350360e-03_wp, 1.763007752269916e-03_wp, &
      & -5.371833828457109e-04_wp, 2.722833618960968e-04_wp, -4.964408764645549e-04_wp, -4.155948048175657e-04_wp, &
      & 6.805571008206233e-04_wp, 9.164320772242468e-05_wp]
   real(wp), parameter :: near_logs(*) = [ &
      & 1.273239544735159e+00_wp, 1.061032953739529e-01_wp, -1.193663011388846e-02_wp, 3.551731167391299e-03_wp, &
      & -1.530248139146453e-03_wp, 6.726060828148327e-04_wp, -3.211205043519326e-04_wp, 1.553646552595705e-03_wp, &
      & 7.756770206188315e-04_wp, 4.250573394273362e-05_wp]

   !> 1, 2, ..., which the derivative over t^2 or t^-2 brings before its power [-]
   real(wp), parameter :: order(10) = [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.0_wp, 8.0_wp, 9.0_wp, 10.0_wp]
   !> Coefficients of these derivatives [-]
   real(wp), parameter :: far_slopes(*) = order*far_powers(2:), near_slopes(*) = order(:9)*near_powers(2:), &
      & near_log_slopes(*) = order(:9)*near_logs(2:)

contains

   !> The function at distances that grow.
   pure subroutine strip_function(distances, logs, width, values, slopes)
      !> Distances along the axis, rising, above zero [any length]; their logarithms
      real(wp), intent(in), contiguous :: distances(:), logs(:)
      !> Half width, above zero [the same length]
      real(wp), intent(in) :: width
      !> F; its slope over ln t, where wanted [-]
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(out), optional, contiguous :: slopes(:)

      ! ln(width); t^2 or t^-2; polynomials and their slopes [-]
      real(wp) :: log_width
      real(wp), dimension(size(distances)) :: square, sums, rises
      integer :: near

      log_width = log(width)
      near = count(distances < width)
      square(:near) = (distances(:near)/width)**2
      square(near + 1:) = (width/distances(near + 1:))**2
      if (near > 0) then
         call sum_powers(near_powers, square(:near), values(:near))
         call sum_powers(near_logs, square(:near), sums(:near))
         values(:near) = distances(:near)/width*(values(:near) + (log_width - logs(:near))*sums(:near))
         if (present(slopes)) then
            call sum_powers(near_slopes, square(:near), slopes(:near))
            call sum_powers(near_log_slopes, square(:near), rises(:near))
            slopes(:near) = values(:near) + distances(:near)/width*(2.0_wp*square(:near)*(slopes(:near) &
               & + (log_width - logs(:near))*rises(:near)) - sums(:near))
         end if
      end if
      call sum_powers(far_powers, square(near + 1:), sums(near + 1:))
      values(near + 1:) = far_part + logs(near + 1:) - log_width + sums(near + 1:)*square(near + 1:)
      if (.not. present(slopes)) return
      call sum_powers(far_slopes, square(near + 1:), rises(near + 1:))
      slopes(near + 1:) = 1.0_wp - 2.0_wp*square(near + 1:)*(sums(near + 1:) + square(near + 1:)*rises(near + 1:))
   end subroutine strip_function

   !> Polynomials; in blocks of places, whose sums stay in registers.
   pure subroutine sum_powers(factors, x, sums)
      !> Coefficients of x^0, x^1, ... [-]
      real(wp), intent(in) :: factors(:)
      !> Where [-]
      real(wp), intent(in), contiguous :: x(:)
      !> Sums [-]
      real(wp), intent(out), contiguous :: sums(:)

      ! Places of a block
      integer, parameter :: many = 8
      real(wp) :: places(many), block_sums(many) ! [-]
      integer :: first, last, j

      places = 0.0_wp
      do first = 1, size(x), many
         last = min(first + many - 1, size(x))
         places(:last - first + 1) = x(first:last)
         block_sums = factors(size(factors))
         do j = size(factors) - 1, 1, -1
            block_sums = block_sums*places + factors(j)
         end do
         sums(first:last) = block_sums(:last - first + 1)
      end do
   end subroutine sum_powers

end module camroller_strip
