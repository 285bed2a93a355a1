!> Tabulated function with three derivatives: a quintic spline that interpolates a table, or a smoothing spline near it.
!>
!> In: points and values. Out: a function with four continuous derivatives, defined between the first and the last point.
!> Evaluation uses Taylor coefficients of each piece. Source: de Boor (1978), A Practical Guide to Splines.
module camroller_spline
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_number_text, only : integer_text
   use camroller_quintic_basis, only : taylor_coefficients
   use camroller_spline_fit, only : fit_t, prepare_clamped_fit, prepare_periodic_fit, solve_fit
   implicit none
   private

   public :: spline_t, new_clamped_spline, new_periodic_spline, evaluate_spline, sharp_points

   !> Fewest points of a periodic table: each function must differ from its own copy a period later
   integer, parameter :: min_periodic_points = 7
   !> Departure of points from equal spacing that direct indexing bears, as a part of the spacing [-]
   real(wp), parameter :: spacing_tolerance = 1.0e-6_wp

   !> The function, ready for evaluation
   type :: spline_t
      private
      !> Ends of the pieces [x]
      real(wp), allocatable :: points(:)
      !> Coefficient of power k of the distance from the left end, in piece m [y/x^k]
      real(wp), allocatable :: pieces(:, :)
      !> Pieces per length where the points are equally spaced, else 0 [1/x]
      real(wp) :: pieces_per_length = 0.0_wp
   end type spline_t

contains

   !> Spline with given slope and curvature at both ends.
   !>
   !> Errors (domain): fewer than two points, points not increasing, numbers not finite, smoothing as large as the
   !> table's own variation.
   subroutine new_clamped_spline(spline, points, values, first_end, last_end, smoothing, error)
      !> The function
      type(spline_t), intent(out) :: spline
      !> Increasing points [x]
      real(wp), intent(in) :: points(:)
      !> Values there [y]
      real(wp), intent(in) :: values(:)
      !> Slope and curvature at the first point [y/x, y/x^2]
      real(wp), intent(in) :: first_end(2)
      !> Slope and curvature at the last point [y/x, y/x^2]
      real(wp), intent(in) :: last_end(2)
      !> Root mean square distance to the table [y]; zero interpolates
      real(wp), intent(in) :: smoothing
      !> What is wrong with the table
      type(error_t), allocatable, intent(out) :: error

      type(fit_t) :: fit

      call check_table(points, values, 2, error)
      if (allocated(error)) return
      call prepare_clamped_fit(fit, points, values, first_end, last_end)
      call fit_spline(spline, points, fit, smoothing, error)
   end subroutine new_clamped_spline

   !> Spline that repeats itself: the last point is the first one of the next period, with the same value.
   !>
   !> Errors (domain): as for clamped ends; fewer than seven points; first and last value different.
   subroutine new_periodic_spline(spline, points, values, smoothing, error)
      !> The function, known over one period
      type(spline_t), intent(out) :: spline
      !> Increasing points [x]
      real(wp), intent(in) :: points(:)
      !> Values there [y]
      real(wp), intent(in) :: values(:)
      !> Root mean square distance to the table [y]; zero interpolates
      real(wp), intent(in) :: smoothing
      !> What is wrong with the table
      type(error_t), allocatable, intent(out) :: error

      type(fit_t) :: fit
      integer :: n

      call check_table(points, values, min_periodic_points, error)
      if (allocated(error)) return
      n = size(points)
      if (abs(values(n) - values(1)) > 100.0_wp*epsilon(1.0_wp)*maxval(abs(values))) then
         call raise(error, kind_domain, "first and last value of a periodic table differ")
         return
      end if
      call prepare_periodic_fit(fit, points, values)
      call fit_spline(spline, points, fit, smoothing, error)
   end subroutine new_periodic_spline

   !> Value and three derivatives; zero outside the table, which says nothing there.
   pure subroutine evaluate_spline(spline, x, values)
      !> The function
      type(spline_t), intent(in) :: spline
      !> Point [x]
      real(wp), intent(in) :: x
      !> Value and derivatives [y, y/x, y/x^2, y/x^3]
      real(wp), intent(out) :: values(0:3)

      integer :: n, piece
      !> Distance from the left end of the piece [x]
      real(wp) :: t

      values = 0.0_wp
      n = size(spline%points)
      if (.not. (x >= spline%points(1) .and. x <= spline%points(n))) return
      if (spline%pieces_per_length > 0.0_wp) then
         piece = min(1 + int((x - spline%points(1))*spline%pieces_per_length), n - 1)
      else
         piece = piece_by_bisection(spline%points, x)
      end if
      t = x - spline%points(piece)
      associate (c => spline%pieces(:, piece))
         values(0) = c(1) + t*(c(2) + t*(c(3) + t*(c(4) + t*(c(5) + t*c(6)))))
         values(1) = c(2) + t*(2.0_wp*c(3) + t*(3.0_wp*c(4) + t*(4.0_wp*c(5) + t*5.0_wp*c(6))))
         values(2) = 2.0_wp*c(3) + t*(6.0_wp*c(4) + t*(12.0_wp*c(5) + t*20.0_wp*c(6)))
         values(3) = 6.0_wp*c(4) + t*(24.0_wp*c(5) + t*60.0_wp*c(6))
      end associate
   end subroutine evaluate_spline

   !> Points of a periodic table where its curve bends sharply: where the pieces on both sides, each carried on, differ by more than
   !> an amount at the end of the shorter one. What follows the curve with steps longer than the table's need not see what is there.
   pure function sharp_points(spline, amount) result(points)
      !> The function, periodic
      type(spline_t), intent(in) :: spline
      !> Difference from which on a point counts [y]
      real(wp), intent(in) :: amount
      !> The points, increasing; the last of the table counts as the first [x]
      real(wp), allocatable :: points(:)

      ! Length of a piece [x], coefficient of its highest power [y/x^5], both of the piece before it
      real(wp), dimension(size(spline%pieces, 2)) :: length, coefficient, length_before, coefficient_before

      length = spline%points(2:) - spline%points(:size(length))
      coefficient = spline%pieces(5, :)
      length_before = cshift(length, -1)
      coefficient_before = cshift(coefficient, -1)
      points = pack(spline%points(:size(length)), abs(coefficient - coefficient_before)*min(length, length_before)**5 &
         & > amount)
   end function sharp_points

   !> Number of the piece that holds a point of the table.
   pure function piece_by_bisection(points, x) result(piece)
      !> Ends of the pieces [x]
      real(wp), intent(in) :: points(:)
      !> Point between the first and the last of them [x]
      real(wp), intent(in) :: x
      !> The piece
      integer :: piece

      integer :: upper, middle

      piece = 1
      upper = size(points)
      do while (upper - piece > 1)
         middle = (piece + upper)/2
         if (x < points(middle)) then
            upper = middle
         else
            piece = middle
         end if
      end do
   end function piece_by_bisection

   !> Solve a fit and store its pieces for evaluation.
   subroutine fit_spline(spline, points, fit, smoothing, error)
      !> The function
      type(spline_t), intent(inout) :: spline
      !> Increasing points [x]
      real(wp), intent(in) :: points(:)
      !> The fit, prepared
      type(fit_t), intent(inout) :: fit
      !> Root mean square distance to the table [y]
      real(wp), intent(in) :: smoothing
      !> No solution
      type(error_t), allocatable, intent(out) :: error

      integer :: i, n
      !> Spacing where it is equal [x]
      real(wp) :: spacing

      call solve_fit(fit, smoothing, error)
      if (allocated(error)) return
      n = size(points)
      spline%points = points
      call taylor_coefficients(fit%knots, fit%coefficients, spline%pieces)
      spacing = (points(n) - points(1))/real(n - 1, wp)
      if (all(abs([(points(i) - points(1) - real(i - 1, wp)*spacing, i=1, n)]) < spacing_tolerance*spacing)) then
         spline%pieces_per_length = 1.0_wp/spacing
      end if
   end subroutine fit_spline

   !> Refuse a table that no function can follow.
   subroutine check_table(points, values, min_points, error)
      !> Points [x]
      real(wp), intent(in) :: points(:)
      !> Values [y]
      real(wp), intent(in) :: values(:)
      !> Fewest points allowed
      integer, intent(in) :: min_points
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (size(points) /= size(values)) then
         call raise(error, kind_domain, "a table needs as many values as points")
         return
      end if
      if (size(points) < min_points) then
         call raise(error, kind_domain, "too few points in a table: "//integer_text(size(points))//", needed are at least "// &
            & integer_text(min_points))
         return
      end if
      do i = 1, size(points)
         if (.not. (ieee_is_finite(points(i)) .and. ieee_is_finite(values(i)))) then
            call raise(error, kind_domain, "row "//integer_text(i)//" of the table is not a finite number")
            return
         end if
         if (i == 1) cycle
         if (points(i) <= points(max(i - 1, 1))) then
            call raise(error, kind_domain, "points of a table must increase: row "//integer_text(i)//" does not follow row "// &
               & integer_text(i - 1))
            return
         end if
      end do
   end subroutine check_table

end module camroller_spline
