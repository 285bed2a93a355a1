!> Quintic B-splines on given points: basis functions, also with all their derivatives, and conversion to Taylor coefficients.
!>
!> In: points, coefficients. Out: what a fit needs to set up its equations. Function number j is one of
!> the six, j = m ... m + 5, that do not vanish between points m and m + 1. Source: de Boor (1978), A Practical Guide to
!> Splines.
module camroller_quintic_basis
   use camroller_kinds, only : wp
   implicit none
   private

   public :: spline_degree, make_knots, basis_values, basis_derivatives, taylor_coefficients

   !> Degree of the pieces
   integer, parameter :: spline_degree = 5

contains

   !> Knots round the points: the ends repeated (clamped), or the points repeated from the other end (periodic).
   pure subroutine make_knots(points, is_periodic, knots)
      !> Increasing points [x]
      real(wp), intent(in) :: points(:)
      !> Whether the last point is the first one again
      logical, intent(in) :: is_periodic
      !> Knots, index 1 to size(points) being the points, five more on each side [x]
      real(wp), allocatable, intent(out) :: knots(:)

      integer :: i, n, turns, first
      !> Length of a period [x]
      real(wp) :: period

      n = size(points)
      period = points(n) - points(1)
      allocate (knots(1 - spline_degree:n + spline_degree))
      do i = lbound(knots, 1), ubound(knots, 1)
         if (is_periodic) then
            first = modulo(i - 1, n - 1)
            turns = (i - 1 - first)/(n - 1)
            knots(i) = points(first + 1) + real(turns, wp)*period
         else
            knots(i) = points(min(max(i, 1), n))
         end if
      end do
      knots(n) = points(n)
   end subroutine make_knots

   !> Values of the six functions that do not vanish in an interval.
   pure function basis_values(knots, x) result(values)
      !> Ten knots; the interval lies between the fifth and the sixth [x]
      real(wp), intent(in) :: knots(-4:5)
      !> Point in the interval, ends included [x]
      real(wp), intent(in) :: x
      !> Value of each function [-]
      real(wp) :: values(spline_degree + 1)

      !> Functions of each lower degree, too [-]
      real(wp) :: lower(spline_degree + 1, 0:spline_degree)

      call basis_of_all_degrees(knots, x, lower)
      values = lower(:, spline_degree)
   end function basis_values

   !> Values and derivatives of the six functions that do not vanish in an interval.
   pure subroutine basis_derivatives(knots, x, derivatives)
      !> Ten knots; the interval lies between the fifth and the sixth [x]
      real(wp), intent(in) :: knots(-4:5)
      !> Point in the interval, ends included [x]
      real(wp), intent(in) :: x
      !> Derivative of order k of function a [1/x^k]
      real(wp), intent(out) :: derivatives(0:spline_degree, spline_degree + 1)

      !> Functions of each lower degree [-]
      real(wp) :: lower(spline_degree + 1, 0:spline_degree)
      !> Coefficients of a derivative in the functions of its own degree [1/x^k]
      real(wp) :: c(spline_degree + 1)
      integer :: a, b, d, k

      call basis_of_all_degrees(knots, x, lower)
      do a = 1, spline_degree + 1
         c = 0.0_wp
         c(a) = 1.0_wp
         do k = 0, spline_degree
            d = spline_degree - k
            derivatives(k, a) = dot_product(c(:d + 1), lower(:d + 1, d))
            do b = 1, d
               c(b) = real(d, wp)*(c(b + 1) - c(b))/(knots(b) - knots(b - d))
            end do
         end do
      end do
   end subroutine basis_derivatives

   !> Functions of degree 0 to 5 that do not vanish in an interval, by the recurrence of Cox and de Boor.
   pure subroutine basis_of_all_degrees(knots, x, basis)
      !> Ten knots; the interval lies between the fifth and the sixth [x]
      real(wp), intent(in) :: knots(-4:5)
      !> Point in the interval [x]
      real(wp), intent(in) :: x
      !> Function b of degree d, b = 1 ... d + 1 [-]
      real(wp), intent(out) :: basis(spline_degree + 1, 0:spline_degree)

      !> A function of the degree below over its support [1/x]
      real(wp) :: share
      integer :: b, d

      basis = 0.0_wp
      basis(1, 0) = 1.0_wp
      do d = 1, spline_degree
         do b = 1, d
            share = basis(b, d - 1)/(knots(b) - knots(b - d))
            basis(b, d) = basis(b, d) + (knots(b) - x)*share
            basis(b + 1, d) = (x - knots(b - d))*share
         end do
      end do
   end subroutine basis_of_all_degrees

   !> Taylor coefficients of each piece about its left end: the coefficients of each derivative in the functions of its own degree
   !> follow from those of the one before.
   pure subroutine taylor_coefficients(knots, coefficients, pieces)
      !> Knots as of `make_knots` [x]
      real(wp), intent(in) :: knots(1 - spline_degree:)
      !> Coefficient of each function [y]
      real(wp), intent(in) :: coefficients(:)
      !> Coefficient of power k in piece m [y/x^k]
      real(wp), allocatable, intent(out) :: pieces(:, :)

      !> Functions of each degree [-]
      real(wp) :: lower(spline_degree + 1, 0:spline_degree)
      !> Coefficients of the derivative of order k over k! [y/x^k]
      real(wp) :: c(spline_degree + 1)
      integer :: b, d, k, m

      allocate (pieces(0:spline_degree, size(coefficients) - spline_degree))
      do m = 1, size(pieces, 2)
         call basis_of_all_degrees(knots(m - 4:m + 5), knots(m), lower)
         c = coefficients(m:m + spline_degree)
         do k = 0, spline_degree
            d = spline_degree - k
            pieces(k, m) = dot_product(c(:d + 1), lower(:d + 1, d))
            do b = 1, d
               c(b) = real(d, wp)/real(k + 1, wp)*(c(b + 1) - c(b))/(knots(m + b) - knots(m + b - d))
            end do
         end do
      end do
   end subroutine taylor_coefficients

end module camroller_quintic_basis
