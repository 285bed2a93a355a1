!> Film thickness of a numerical solution as a function of speed and load: polynomials fitted to solutions at given points.
!>
!> In: logarithms of the films at the points that `speed_points` and `load_points` give. Out: logarithms of both films and their
!> slopes at any speed and load. Inside the table the fit is by Chebyshev polynomials in ln U and in a stretched ln W*; outside
!> it continues as a power law with the same value and slope at the border, so film and slopes are continuous everywhere. The
!> module does not depend on how the films were computed.
!>
!> Over the load, ln W* is stretched about the line where the pressure spike passes the middle of the contact, since the central
!> film has a maximum there that no published formula has. With z the distance from that line, the coordinate is `a z +
!> asinh(z/d)`, scaled to run from -1 to 1 over the table at each speed. The points are the extrema of the Chebyshev polynomial
!> of highest degree; those of twice the degree include them, so a table can be refined without solving any point again.
module camroller_film_table
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: film_table_t, film_series_t, most_terms, speed_points, load_points, new_film_table, halving_changes, table_series, &
      & series_films, is_in_table

   !> Most polynomials in each direction
   integer, parameter :: most_terms = 65
   !> The line of the hump, `W* = factor U**exponent` [-]: between the steepest rise of the central film over the load and the bend
   !> after it, in numerical solutions with U from 1e-12 to 1e-8 and G from 3000 to 6000; a few per cent more or less do no harm
   real(wp), parameter :: hump_factor = 0.46_wp, hump_exponent = 0.435_wp
   !> Width of the hump in ln W*, and how densely points lie far from it over how they lie a width away [-]
   real(wp), parameter :: hump_width = 0.12_wp, far_density = 0.25_wp

   !> Films over speed and load
   type :: film_table_t
      !> Number of polynomials over speed and over load
      integer :: terms(2) = 0
      !> Lower and upper end of ln U, then of ln W* [-]
      real(wp) :: ends(2, 2)
      !> Coefficients of ln(h/R): over speed, over load, minimum then central film [-]
      real(wp), allocatable :: coefficients(:, :, :)
      !> Largest difference from what it represents, relative, as whoever made it states it [-]
      real(wp) :: error = 0.0_wp
   end type film_table_t

   !> Films over the load at one speed
   type :: film_series_t
      !> Number of polynomials
      integer :: terms = 0
      !> Lower and upper end of ln W*; ln W* of the hump; distance of ln U from the table [-]
      real(wp) :: ends(2), hump, beyond
      !> Stretched ln W* at both ends, and its derivative with respect to ln U [-]
      real(wp) :: spans(2), drifts(2)
      !> Coefficients of the logarithms of minimum and central film, then of their slopes over ln U at the same coordinate [-]
      real(wp) :: coefficients(most_terms, 4)
   end type film_series_t

contains

   !> Speeds at which the table needs the films.
   pure function speed_points(ends, terms) result(points)
      !> Both ends of ln U [-]
      real(wp), intent(in) :: ends(2)
      !> Number of points, two or more
      integer, intent(in) :: terms
      !> ln U at the points, upwards [-]
      real(wp) :: points(terms)

      points = 0.5_wp*(ends(1) + ends(2)) + 0.5_wp*(ends(2) - ends(1))*places(terms)
      points([1, terms]) = ends
   end function speed_points

   !> Loads at which the table needs the films, at one speed.
   pure function load_points(ends, log_speed, terms) result(points)
      !> Both ends of ln W* [-]
      real(wp), intent(in) :: ends(2)
      !> ln U [-]
      real(wp), intent(in) :: log_speed
      !> Number of points, two or more
      integer, intent(in) :: terms
      !> ln W* at the points, upwards [-]
      real(wp) :: points(terms)

      ! ln W* of the hump [-]
      real(wp) :: hump
      ! Stretched ln W*: at both ends, at the points [-]
      real(wp) :: spans(2), stretched(terms)

      hump = hump_line(log_speed)
      spans = stretch(ends - hump)
      stretched = 0.5_wp*(spans(1) + spans(2)) + 0.5_wp*(spans(2) - spans(1))*places(terms)
      points = hump + unstretch(stretched)
      points([1, terms]) = ends
   end function load_points

   !> Places of the points from -1 to 1, upwards.
   pure function places(terms) result(x)
      !> Number of points, two or more
      integer, intent(in) :: terms
      !> The coordinates [-]
      real(wp) :: x(terms)

      integer :: i

      x = [(-cos(pi*real(i - 1, wp)/(terms - 1)), i=1, terms)]
   end function places

   !> ln W* where the central film has its hump at a speed.
   elemental function hump_line(log_speed) result(log_load)
      !> ln U [-]
      real(wp), intent(in) :: log_speed
      !> ln W* [-]
      real(wp) :: log_load

      log_load = log(hump_factor) + hump_exponent*log_speed
   end function hump_line

   !> Distance from the hump, stretched near it.
   elemental function stretch(distance) result(stretched)
      !> Distance in ln W* [-]
      real(wp), intent(in) :: distance
      !> The same stretched [-]
      real(wp) :: stretched

      stretched = far_density*distance + asinh(distance/hump_width)
   end function stretch

   !> Distance from the hump from the stretched one: Newton's method for `y + a d sinh(y) = s`, which from y = s on comes nearer
   !> from one side without end.
   elemental function unstretch(stretched) result(distance)
      !> Stretched distance [-]
      real(wp), intent(in) :: stretched
      !> Distance in ln W* [-]
      real(wp) :: distance

      ! Inverse hyperbolic sine of the distance over the width, and its next change [-]
      real(wp) :: y, change
      integer :: i

      y = stretched
      do i = 1, 60
         change = (y + far_density*hump_width*sinh(y) - stretched)/(1.0_wp + far_density*hump_width*cosh(y))
         y = y - change
         if (abs(change) <= 4.0_wp*epsilon(1.0_wp)*abs(y)) exit
      end do
      distance = hump_width*sinh(y)
   end function unstretch

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

   !> What films at every second point of one direction differ by from the polynomials through the others: over speed, over load.
   pure function halving_changes(films) result(changes)
      !> ln(h/R) at the points of speed and load, minimum then central film [-]
      real(wp), intent(in) :: films(:, :, :)
      !> Largest difference over speed, and over load [-]
      real(wp) :: changes(2)

      integer :: k

      changes = 0.0_wp
      do k = 1, 2
         associate (values => films(:, :, k), n => size(films, 1), m => size(films, 2))
            changes(1) = max(changes(1), maxval(abs(values(2::2, :) - matmul(middles(n), values(1::2, :)))))
            changes(2) = max(changes(2), maxval(abs(values(:, 2::2) - matmul(values(:, 1::2), transpose(middles(m))))))
         end associate
      end do
   end function halving_changes

   !> Matrix from values at every second point to those that their polynomials have at the others.
   pure function middles(terms) result(matrix)
      !> Number of all points, odd
      integer, intent(in) :: terms
      !> The matrix [-]
      real(wp) :: matrix(terms/2, terms/2 + 1)

      ! Polynomials at the other points [-]
      real(wp) :: values(terms/2, terms/2 + 1)
      integer :: i, k

      do k = 0, terms/2
         values(:, k + 1) = [(merge(-1.0_wp, 1.0_wp, mod(k, 2) == 1)*cos(pi*k*real(2*i - 1, wp)/(terms - 1)), i=1, terms/2)]
      end do
      matrix = matmul(values, transform(terms/2 + 1))
   end function middles

   !> Matrix from values at the points to coefficients.
   pure function transform(terms) result(matrix)
      !> Number of points, two or more
      integer, intent(in) :: terms
      !> The matrix [-]
      real(wp) :: matrix(terms, terms)

      integer :: i, k

      do i = 1, terms
         do k = 0, terms - 1
            matrix(k + 1, i) = merge(-2.0_wp, 2.0_wp, mod(k, 2) == 1)/(terms - 1)*cos(pi*k*real(i - 1, wp)/(terms - 1))
         end do
      end do
      matrix([1, terms], :) = 0.5_wp*matrix([1, terms], :)
      matrix(:, [1, terms]) = 0.5_wp*matrix(:, [1, terms])
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

      ! ln U inside the table; its coordinate from -1 to 1, half its length [-]
      real(wp) :: inside, x, half
      ! Polynomials over the speed and their derivatives with respect to ln U; bends that are not used [-]
      real(wp) :: values(most_terms), slopes(most_terms), bends(most_terms)
      integer :: k, n, m

      n = table%terms(1)
      m = table%terms(2)
      half = 0.5_wp*(table%ends(2, 1) - table%ends(1, 1))
      inside = min(max(log_speed, table%ends(1, 1)), table%ends(2, 1))
      x = (inside - table%ends(1, 1))/half - 1.0_wp
      call polynomials(x, values(:n), slopes(:n), bends(:n))
      slopes(:n) = slopes(:n)/half
      series%terms = m
      series%ends = table%ends(:, 2)
      series%beyond = log_speed - inside
      series%hump = hump_line(inside)
      series%spans = stretch(series%ends - series%hump)
      series%drifts = -hump_exponent*stretch_slope(series%ends - series%hump)
      do k = 1, 2
         series%coefficients(:m, k + 2) = matmul(slopes(:n), table%coefficients(:, :, k))
         series%coefficients(:m, k) = matmul(values(:n), table%coefficients(:, :, k))
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

      ! ln W* inside the table; distance from the table [-]
      real(wp) :: inside, beyond
      ! Place from -1 to 1; its derivatives with respect to ln W*, to ln U and to both [-]
      real(wp) :: x, by_load, by_speed, by_both
      ! Polynomials over the load, first and second derivatives with respect to the coordinate [-]
      real(wp) :: values(most_terms), slopes(most_terms), bends(most_terms)
      ! Derivatives of the logarithm of a film with respect to the coordinate, and to ln U and ln W* [-]
      real(wp) :: slope, cross
      integer :: k, m

      m = series%terms
      inside = min(max(log_load, series%ends(1)), series%ends(2))
      beyond = log_load - inside
      call place_of(series, inside, x, by_load, by_speed, by_both)
      call polynomials(x, values(:m), slopes(:m), bends(:m))
      do k = 1, 2
         associate (c => series%coefficients(:m, k), over_speed => series%coefficients(:m, k + 2))
            slope = dot_product(slopes(:m), c)
            films(k) = dot_product(values(:m), c)
            load_slopes(k) = slope*by_load
            speed_slopes(k) = dot_product(values(:m), over_speed) + slope*by_speed
            if (abs(beyond) + abs(series%beyond) <= 0.0_wp) cycle
            cross = dot_product(slopes(:m), over_speed)*by_load + dot_product(bends(:m), c)*by_load*by_speed + slope*by_both
         end associate
         films(k) = films(k) + beyond*load_slopes(k) + series%beyond*(speed_slopes(k) + beyond*cross)
         load_slopes(k) = load_slopes(k) + series%beyond*cross
         speed_slopes(k) = speed_slopes(k) + beyond*cross
      end do
   end subroutine series_films

   !> Place over the load, and its derivatives.
   pure subroutine place_of(series, log_load, x, by_load, by_speed, by_both)
      !> Films over the load
      type(film_series_t), intent(in) :: series
      !> ln W* inside the table [-]
      real(wp), intent(in) :: log_load
      !> The coordinate from -1 to 1; its derivatives with respect to ln W*, to ln U and to both [-]
      real(wp), intent(out) :: x, by_load, by_speed, by_both

      ! Stretched length of the table, its derivative with respect to ln U; slope of the stretching [-]
      real(wp) :: length, growth, slope

      length = series%spans(2) - series%spans(1)
      growth = series%drifts(2) - series%drifts(1)
      slope = stretch_slope(log_load - series%hump)
      x = (2.0_wp*stretch(log_load - series%hump) - sum(series%spans))/length
      by_load = 2.0_wp*slope/length
      by_speed = -(2.0_wp*hump_exponent*slope + sum(series%drifts) + x*growth)/length
      by_both = -(2.0_wp*hump_exponent*stretch_bend(log_load - series%hump) + by_load*growth)/length
   end subroutine place_of

   !> Derivative of the stretched distance from the hump.
   elemental function stretch_slope(distance) result(slope)
      !> Distance in ln W* [-]
      real(wp), intent(in) :: distance
      !> The derivative [-]
      real(wp) :: slope

      slope = far_density + 1.0_wp/sqrt(hump_width**2 + distance**2)
   end function stretch_slope

   !> Its second derivative.
   elemental function stretch_bend(distance) result(bend)
      !> Distance in ln W* [-]
      real(wp), intent(in) :: distance
      !> The derivative [-]
      real(wp) :: bend

      bend = -distance/sqrt(hump_width**2 + distance**2)**3
   end function stretch_bend

   !> Chebyshev polynomials and their derivatives.
   pure subroutine polynomials(x, values, slopes, bends)
      !> Place from -1 to 1 [-]
      real(wp), intent(in) :: x
      !> The polynomials, their first and second derivatives with respect to the coordinate [-]
      real(wp), intent(out) :: values(:), slopes(:), bends(:)

      integer :: k

      values(1:2) = [1.0_wp, x]
      slopes(1:2) = [0.0_wp, 1.0_wp]
      bends(1:2) = 0.0_wp
      do k = 3, size(values)
         values(k) = 2.0_wp*x*values(k - 1) - values(k - 2)
         slopes(k) = 2.0_wp*(values(k - 1) + x*slopes(k - 1)) - slopes(k - 2)
         bends(k) = 2.0_wp*(2.0_wp*slopes(k - 1) + x*bends(k - 1)) - bends(k - 2)
      end do
   end subroutine polynomials

end module camroller_film_table
