!> Coefficients of a quintic spline: the equations of interpolation and of smoothing, for clamped ends and for a period.
!>
!> A part of `spline.f90`. In: points and values. Out: coefficients of B-splines. Both problems are
!> banded systems, solved by LAPACK. Sources: de Boor (1978), A Practical Guide to Splines, chapters XIII and XIV;
!> Eilers and Marx (1996), Statistical Science 11(2), 89-121, for least squares with a penalty.
module camroller_spline_fit
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_domain, kind_internal
   use camroller_lapack, only : dgbsv, dpbsv
   use camroller_quintic_basis, only : spline_degree, make_knots, basis_values, basis_derivatives
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   implicit none
   private

   public :: fit_t, prepare_clamped_fit, prepare_periodic_fit, solve_fit

   !> Unknown coefficients of a fit and where they stand in its equations
   type :: fit_t
      !> Knots as of `make_knots` [x]
      real(wp), allocatable :: knots(:)
      !> Values at the points, without a repeated last one where periodic [y]
      real(wp), allocatable :: values(:)
      !> Coefficients; those that the ends fix are set from the start [y]
      real(wp), allocatable :: coefficients(:)
      !> Unknown behind each coefficient, 0 where the ends fix it
      integer, allocatable :: unknown(:)
      !> Point and unknown of each equation of the interpolation
      integer, allocatable :: equation_point(:), equation_unknown(:)
      !> Widest distance of two unknowns in an equation of the interpolation from its diagonal
      integer :: half_band
      !> Widest distance of two unknowns in one piece
      integer :: penalty_band
   end type fit_t

   !> Normal equations of a fit with a penalty: of the distances, and of the penalty for a weight of one
   type :: normal_t
      !> Functions at the point of each equation, shape (6, equation) [-]
      real(wp), allocatable :: functions(:, :)
      !> Upper triangles in LAPACK's band storage [-], right-hand sides [y]
      real(wp), allocatable :: squares(:, :), penalty(:, :), squares_rhs(:, :), penalty_rhs(:, :)
   end type normal_t

contains

   !> Equations of a spline with given value, slope and curvature at both ends.
   pure subroutine prepare_clamped_fit(fit, points, values, first_end, last_end)
      !> The fit
      type(fit_t), intent(out) :: fit
      !> Increasing points [x]
      real(wp), intent(in) :: points(:)
      !> Values there [y]
      real(wp), intent(in) :: values(:)
      !> Slope and curvature at the first point [y/x, y/x^2]
      real(wp), intent(in) :: first_end(2)
      !> Slope and curvature at the last point [y/x, y/x^2]
      real(wp), intent(in) :: last_end(2)

      integer :: i, n

      n = size(points)
      call make_knots(points, .false., fit%knots)
      fit%values = values
      allocate (fit%coefficients(n + 4), source=0.0_wp)
      call fix_ends(fit, [values(1), first_end], [values(n), last_end])
      fit%unknown = [0, 0, 0, (i, i=1, n - 2), 0, 0, 0]
      fit%equation_point = [(i, i=2, n - 1)]
      fit%equation_unknown = [(i, i=1, n - 2)]
      fit%half_band = 2
      fit%penalty_band = spline_degree
   end subroutine prepare_clamped_fit

   !> Equations of a spline that repeats itself.
   pure subroutine prepare_periodic_fit(fit, points, values)
      !> The fit
      type(fit_t), intent(out) :: fit
      !> Increasing points, the last one a period after the first [x]
      real(wp), intent(in) :: points(:)
      !> Values there, the last one equal to the first [y]
      real(wp), intent(in) :: values(:)

      integer :: i, n

      n = size(points) - 1
      call make_knots(points, .true., fit%knots)
      fit%values = values(:n)
      allocate (fit%coefficients(n + spline_degree), source=0.0_wp)
      fit%unknown = [(folded(i, n), i=1, n + spline_degree)]
      fit%equation_point = [(i, i=1, n)]
      fit%equation_unknown = [(folded(i + 2, n), i=1, n)]
      fit%half_band = min(4, n - 1)
      fit%penalty_band = min(2*spline_degree, n - 1)
   end subroutine prepare_periodic_fit

   !> Find the coefficients: through all values, or at a given distance from them.
   subroutine solve_fit(fit, smoothing, error)
      !> The fit, prepared
      type(fit_t), intent(inout) :: fit
      !> Root mean square distance to the table [y]; zero interpolates
      real(wp), intent(in) :: smoothing
      !> No solution
      type(error_t), allocatable, intent(out) :: error

      integer :: info

      if (size(fit%equation_point) == 0) return
      if (smoothing > 0.0_wp) then
         call smooth(fit, smoothing, error)
      else
         call interpolate(fit, info)
         if (info /= 0) call raise(error, kind_internal, "the equations of a spline have no solution")
      end if
   end subroutine solve_fit

   !> Place of a cyclic unknown such that neighbours round the circle stay neighbours: 1, n, 2, n - 1, 3, ...
   !>
   !> A cyclic band of half width k becomes an ordinary band of half width 2 k.
   pure function folded(i, n) result(place)
      !> Number on the circle, any integer
      integer, intent(in) :: i
      !> Unknowns on the circle
      integer, intent(in) :: n
      !> Place, 1 to n
      integer :: place

      integer :: j

      j = modulo(i - 1, n) + 1
      if (2*j <= n + 1) then
         place = 2*j - 1
      else
         place = 2*(n + 1 - j)
      end if
   end function folded

   !> Set the three coefficients at each clamped end from value, slope and curvature there.
   pure subroutine fix_ends(fit, first_end, last_end)
      !> The fit; knots are set
      type(fit_t), intent(inout) :: fit
      !> Value, slope and curvature at the first point [y/x^k]
      real(wp), intent(in) :: first_end(0:2)
      !> Value, slope and curvature at the last point [y/x^k]
      real(wp), intent(in) :: last_end(0:2)

      !> Values and derivatives of the functions [1/x^k]
      real(wp) :: basis(0:spline_degree, spline_degree + 1)
      integer :: j, k, n

      n = size(fit%coefficients)
      call basis_derivatives(fit%knots(-3:6), fit%knots(1), basis)
      do k = 0, 2
         fit%coefficients(k + 1) = (first_end(k) - dot_product(basis(k, :k), fit%coefficients(:k)))/basis(k, k + 1)
      end do
      call basis_derivatives(fit%knots(n - 9:n), fit%knots(n - 4), basis)
      do k = 0, 2
         fit%coefficients(n - k) = last_end(k)
         do j = 0, k - 1
            fit%coefficients(n - k) = fit%coefficients(n - k) - basis(k, 6 - j)*fit%coefficients(n - j)
         end do
         fit%coefficients(n - k) = fit%coefficients(n - k)/basis(k, 6 - k)
      end do
   end subroutine fix_ends

   !> Coefficients of the spline through all values.
   pure subroutine interpolate(fit, info)
      type(fit_t), intent(inout) :: fit
      !> 0, or that of LAPACK
      integer, intent(out) :: info

      !> Matrix in LAPACK's band storage [-], right-hand side [y]
      real(wp) :: band(3*fit%half_band + 1, size(fit%equation_point)), rhs(size(fit%equation_point), 1)
      !> Functions [-]
      real(wp) :: functions(spline_degree + 1)
      integer :: pivots(size(fit%equation_point)), a, e, column, i, row

      band = 0.0_wp
      do e = 1, size(fit%equation_point)
         i = fit%equation_point(e)
         row = fit%equation_unknown(e)
         rhs(row, 1) = fit%values(i)
         functions = basis_values(fit%knots(i - 4:i + 5), fit%knots(i))
         do a = 1, spline_degree
            column = fit%unknown(i + a - 1)
            if (column == 0) then
               rhs(row, 1) = rhs(row, 1) - functions(a)*fit%coefficients(i + a - 1)
            else
               associate (entry => band(2*fit%half_band + 1 + row - column, column))
                  entry = entry + functions(a)
               end associate
            end if
         end do
      end do
      call dgbsv(size(band, 2), fit%half_band, fit%half_band, 1, band, size(band, 1), pivots, rhs, size(rhs, 1), info)
      if (info == 0) where (fit%unknown > 0) fit%coefficients = rhs(max(fit%unknown, 1), 1)
   end subroutine interpolate

   !> Coefficients of the spline whose root mean square distance to the table equals the given one.
   !>
   !> Among all splines at that distance it is the one with the smallest integral of the squared third derivative. Its
   !> weight against the distances is the root of a rising function, searched in its logarithm.
   subroutine smooth(fit, smoothing, error)
      type(fit_t), intent(inout) :: fit
      !> Root mean square distance to the table [y]
      real(wp), intent(in) :: smoothing
      !> Smoothing as large as the table itself
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      type(normal_t) :: normal
      !> Weight of the penalty in a unit of the spacing, decades [-]
      real(wp) :: weight, weight_below
      !> Distance at these weights, less the wanted one [y]
      real(wp) :: excess, excess_below
      integer :: info
      !> Weights searched, width of the first bracket, tolerance of the weight [decades]
      real(wp), parameter :: smallest = -10.0_wp, largest = 14.0_wp, width = 2.0_wp, tolerance = 1.0e-10_wp

      call set_normal(fit, normal)
      weight = smallest
      call smooth_with_weight(fit, normal, weight, smoothing, excess, info)
      excess_below = -smoothing
      weight_below = weight - width
      do while (excess < 0.0_wp .and. info == 0 .and. weight < largest)
         excess_below = excess
         weight_below = weight
         weight = weight + width
         call smooth_with_weight(fit, normal, weight, smoothing, excess, info)
      end do
      if (excess < 0.0_wp .or. info /= 0) then
         call raise(error, kind_domain, "smoothing is as large as the table's own variation")
         return
      end if
      call start_bracket(bracket, weight_below, weight, excess_below, excess, tolerance)
      do while (bracket%status == root_wanted)
         call smooth_with_weight(fit, normal, bracket%trial, smoothing, excess, info)
         if (info /= 0) exit
         call narrow_bracket(bracket, excess)
      end do
      if (bracket%status == root_found) call smooth_with_weight(fit, normal, bracket%trial, smoothing, excess, info)
      if (bracket%status /= root_found .or. info /= 0) then
         call raise(error, kind_internal, "no weight gives the smoothing of a spline")
      end if
   end subroutine smooth

   !> Least squares with a penalty on the third derivative: what does not depend on the weight.
   pure subroutine set_normal(fit, normal)
      type(fit_t), intent(in) :: fit
      !> Its equations
      type(normal_t), intent(out) :: normal

      !> Functions and their derivatives [1/x^k], width of a piece, mean spacing [x]
      real(wp) :: basis(0:spline_degree, spline_degree + 1), width, spacing
      integer :: e, i, n, n_pieces, q
      !> Gauss-Legendre rule of three points on (0, 1), exact for the square of a parabola: nodes [-]
      real(wp), parameter :: places(3) = 0.5_wp + [-1.0_wp, 0.0_wp, 1.0_wp]*sqrt(0.15_wp)
      !> Its weights [-]
      real(wp), parameter :: weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

      n = size(fit%equation_point)
      allocate (normal%functions(spline_degree + 1, n))
      allocate (normal%squares(fit%penalty_band + 1, n), normal%penalty(fit%penalty_band + 1, n), normal%squares_rhs(n, 1), &
         & normal%penalty_rhs(n, 1), source=0.0_wp)
      do e = 1, n
         i = fit%equation_point(e)
         normal%functions(:, e) = basis_values(fit%knots(i - 4:i + 5), fit%knots(i))
         call add_square(fit, i, normal%functions(:, e), fit%values(i), 1.0_wp, normal%squares, normal%squares_rhs)
      end do
      n_pieces = size(fit%coefficients) - spline_degree
      spacing = (fit%knots(n_pieces + 1) - fit%knots(1))/real(n_pieces, wp)
      do i = 1, n_pieces
         width = fit%knots(i + 1) - fit%knots(i)
         do q = 1, size(places)
            call basis_derivatives(fit%knots(i - 4:i + 5), fit%knots(i) + places(q)*width, basis)
            call add_square(fit, i, basis(3, :), 0.0_wp, weights(q)*width*spacing**5, normal%penalty, normal%penalty_rhs)
         end do
      end do
   end subroutine set_normal

   !> Coefficients for one weight.
   pure subroutine smooth_with_weight(fit, normal, weight, smoothing, excess, info)
      type(fit_t), intent(inout) :: fit
      !> Its equations
      type(normal_t), intent(in) :: normal
      !> Common logarithm of the weight of the penalty in a unit of the spacing [-]
      real(wp), intent(in) :: weight
      !> Root mean square distance wanted [y]
      real(wp), intent(in) :: smoothing
      !> Distance less the wanted one [y]
      real(wp), intent(out) :: excess
      !> 0, or that of LAPACK
      integer, intent(out) :: info

      !> Upper triangle in LAPACK's band storage [-], right-hand side [y]
      real(wp) :: band(fit%penalty_band + 1, size(fit%equation_point)), rhs(size(fit%equation_point), 1)

      band = normal%squares + 10.0_wp**weight*normal%penalty
      rhs = normal%squares_rhs + 10.0_wp**weight*normal%penalty_rhs
      call dpbsv("U", size(band, 2), fit%penalty_band, 1, band, size(band, 1), rhs, size(rhs, 1), info)
      excess = 0.0_wp
      if (info /= 0) return
      where (fit%unknown > 0) fit%coefficients = rhs(max(fit%unknown, 1), 1)
      excess = distance_to_table(fit, normal%functions) - smoothing
   end subroutine smooth_with_weight

   !> Add `weight (sum of v c - target)^2` to the normal equations.
   pure subroutine add_square(fit, piece, v, target, weight, band, rhs)
      type(fit_t), intent(in) :: fit
      !> Piece whose six functions are meant
      integer, intent(in) :: piece
      !> Factor of each coefficient [1/x^k]
      real(wp), intent(in) :: v(:)
      !> Value that the sum should have [y/x^k]
      real(wp), intent(in) :: target
      !> Weight of the square [x^2k]
      real(wp), intent(in) :: weight
      !> Upper triangle in LAPACK's band storage [-]
      real(wp), intent(inout) :: band(:, :)
      !> Right-hand side [y]
      real(wp), intent(inout) :: rhs(:, :)

      integer :: a, b, column, row
      !> Target less what the fixed coefficients give [y/x^k]
      real(wp) :: rest

      rest = target
      do a = 1, size(v)
         if (fit%unknown(piece + a - 1) == 0) rest = rest - v(a)*fit%coefficients(piece + a - 1)
      end do
      do b = 1, size(v)
         column = fit%unknown(piece + b - 1)
         if (column == 0) cycle
         rhs(column, 1) = rhs(column, 1) + weight*v(b)*rest
         do a = 1, size(v)
            row = fit%unknown(piece + a - 1)
            if (row == 0 .or. row > column) cycle
            associate (entry => band(size(band, 1) + row - column, column))
               entry = entry + weight*v(a)*v(b)
            end associate
         end do
      end do
   end subroutine add_square

   !> Root mean square distance of a fit from its table.
   pure function distance_to_table(fit, functions) result(distance)
      type(fit_t), intent(in) :: fit
      !> Functions at the point of each equation [-]
      real(wp), intent(in) :: functions(:, :)
      !> The distance [y]
      real(wp) :: distance

      integer :: e, i

      distance = 0.0_wp
      do e = 1, size(fit%equation_point)
         i = fit%equation_point(e)
         distance = distance + (fit%values(i) - dot_product(functions(:, e), fit%coefficients(i:i + spline_degree)))**2
      end do
      distance = sqrt(distance/real(size(fit%values), wp))
   end function distance_to_table

end module camroller_spline_fit
