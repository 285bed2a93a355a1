!> Film over speed and load as polynomials: what a numerical solution says, made ready for evaluation.
!>
!> Layer: physics. In: logarithms of the films at the points that it asks for. Out: logarithms of both films and their slopes at any
!> speed and load. Chebyshev polynomials in ln U and ln W* inside a box, beyond it the power law that touches them, so that film and
!> slopes have no jump anywhere. Knows nothing of where the films come from.
module camroller_film_table
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: film_table_t, film_series_t, most_terms, table_points, new_film_table, table_series, series_films, is_in_table

   !> Most polynomials in each direction
   integer, parameter :: most_terms = 33

   !> Films over speed and load
   type :: film_table_t
      !> Number of polynomials over speed and over load
      integer :: terms(2) = 0
      !> Lower and upper end of ln U, then of ln W* [-]
      real(wp) :: ends(2, 2)
      !> Coefficients of ln(h/R): over speed, over load, minimum then central film [-]
      real(wp), allocatable :: coefficients(:, :, :)
      !> Largest difference from what it represents where that was checked, relative [-]
      real(wp) :: error = 0.0_wp
   end type film_table_t

   !> Films over the load at one speed
   type :: film_series_t
      !> Number of polynomials
      integer :: terms = 0
      !> Lower and upper end of ln W* [-]
      real(wp) :: ends(2)
      !> Coefficients of the logarithms of minimum and central film, then of their slopes over ln U [-]
      real(wp) :: coefficients(most_terms, 4)
   end type film_series_t

contains

   !> Points of one direction at which the films are asked for: logarithms of speed or load.
   pure function table_points(ends, terms) result(points)
      !> Both ends [-]
      real(wp), intent(in) :: ends(2)
      !> Number of points
      integer, intent(in) :: terms
      !> The points [-]
      real(wp) :: points(terms)

      integer :: i

      points = [(0.5_wp*(ends(1) + ends(2)) + 0.5_wp*(ends(2) - ends(1))*cos(pi*(real(i, wp) - 0.5_wp)/terms), i=1, terms)]
   end function table_points

   !> Table through films at the points.
   pure subroutine new_film_table(table, ends, films)
      !> The table
      type(film_table_t), intent(out) :: table
      !> Ends of ln U, then of ln W* [-]
      real(wp), intent(in) :: ends(2, 2)
      !> ln(h/R) at the points of speed and load, minimum then central film [-]
      real(wp), intent(in) :: films(:, :, :)

      integer :: k

      table%ends = ends
      table%terms = [size(films, 1), size(films, 2)]
      allocate (table%coefficients(size(films, 1), size(films, 2), 2))
      do k = 1, 2
         table%coefficients(:, :, k) = matmul(matmul(transform(size(films, 1)), films(:, :, k)), &
            & transpose(transform(size(films, 2))))
      end do
   end subroutine new_film_table

   !> Matrix from values at the points to coefficients.
   pure function transform(terms) result(matrix)
      !> Number of points
      integer, intent(in) :: terms
      !> The matrix [-]
      real(wp) :: matrix(terms, terms)

      integer :: i, k

      do i = 1, terms
         do k = 0, terms - 1
            matrix(k + 1, i) = merge(1.0_wp, 2.0_wp, k == 0)/terms*cos(pi*k*(real(i, wp) - 0.5_wp)/terms)
         end do
      end do
   end function transform

   !> Is a speed and a load inside the table?
   pure function is_in_table(table, speed, load) result(inside)
      !> The table
      type(film_table_t), intent(in) :: table
      !> U and W*, positive [-]
      real(wp), intent(in) :: speed, load
      !> True inside
      logical :: inside

      ! Logarithms [-]
      real(wp) :: point(2)

      point = log([speed, load])
      inside = all(point >= table%ends(1, :) .and. point <= table%ends(2, :))
   end function is_in_table

   !> Films over the load at one speed.
   pure subroutine table_series(table, log_speed, series)
      !> The table
      type(film_table_t), intent(in) :: table
      !> ln U [-]
      real(wp), intent(in) :: log_speed
      !> Films over the load
      type(film_series_t), intent(out) :: series

      ! Place inside the table from -1 to 1, half its length, distance from the table [-]
      real(wp) :: x, half, beyond
      ! Polynomials over the speed and their derivatives with respect to ln U [-]
      real(wp) :: values(most_terms), slopes(most_terms)
      integer :: k, n, m

      n = table%terms(1)
      m = table%terms(2)
      half = 0.5_wp*(table%ends(2, 1) - table%ends(1, 1))
      beyond = log_speed - min(max(log_speed, table%ends(1, 1)), table%ends(2, 1))
      x = (log_speed - beyond - table%ends(1, 1))/half - 1.0_wp
      call polynomials(x, values(:n), slopes(:n))
      slopes(:n) = slopes(:n)/half
      series%terms = m
      series%ends = table%ends(:, 2)
      do k = 1, 2
         series%coefficients(:m, k + 2) = matmul(slopes(:n), table%coefficients(:, :, k))
         series%coefficients(:m, k) = matmul(values(:n), table%coefficients(:, :, k)) + beyond*series%coefficients(:m, k + 2)
      end do
   end subroutine table_series

   !> Both films at a load, and their slopes.
   pure subroutine series_films(series, log_load, films, load_slopes, speed_slopes)
      !> Films over the load
      type(film_series_t), intent(in) :: series
      !> ln W* [-]
      real(wp), intent(in) :: log_load
      !> ln(h/R), minimum and central film [-]
      real(wp), intent(out) :: films(2)
      !> Their derivatives with respect to ln W* and ln U [-]
      real(wp), intent(out) :: load_slopes(2), speed_slopes(2)

      ! Place inside the table from -1 to 1, half its length, distance from the table [-]
      real(wp) :: x, half, beyond
      ! Polynomials over the load and their derivatives with respect to ln W* [-]
      real(wp) :: values(most_terms), slopes(most_terms)
      integer :: k, m

      m = series%terms
      half = 0.5_wp*(series%ends(2) - series%ends(1))
      beyond = log_load - min(max(log_load, series%ends(1)), series%ends(2))
      x = (log_load - beyond - series%ends(1))/half - 1.0_wp
      call polynomials(x, values(:m), slopes(:m))
      slopes(:m) = slopes(:m)/half
      values(:m) = values(:m) + beyond*slopes(:m)
      do k = 1, 2
         films(k) = dot_product(values(:m), series%coefficients(:m, k))
         load_slopes(k) = dot_product(slopes(:m), series%coefficients(:m, k))
         speed_slopes(k) = dot_product(values(:m), series%coefficients(:m, k + 2))
      end do
   end subroutine series_films

   !> Chebyshev polynomials and their derivatives.
   pure subroutine polynomials(x, values, slopes)
      !> Place from -1 to 1 [-]
      real(wp), intent(in) :: x
      !> The polynomials, and their derivatives with respect to the place [-]
      real(wp), intent(out) :: values(:), slopes(:)

      integer :: k

      values(1) = 1.0_wp
      slopes(1) = 0.0_wp
      if (size(values) == 1) return
      values(2) = x
      slopes(2) = 1.0_wp
      do k = 3, size(values)
         values(k) = 2.0_wp*x*values(k - 1) - values(k - 2)
         slopes(k) = 2.0_wp*(values(k - 1) + x*slopes(k - 1)) - slopes(k - 2)
      end do
   end subroutine polynomials

end module camroller_film_table
