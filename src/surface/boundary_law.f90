!> Friction coefficient of touching asperities as a law of sliding speed and temperature.
!>
!> In: constants of the law, speed, temperature. Out: the coefficient with its derivatives. It grows with the logarithm of the speed
!> where thermal activation under stress shears a boundary layer: Briscoe and Evans (1982), Proc. R. Soc. London A 380, 389-407;
!> Campen, Green, Lamb, Atkinson and Spikes (2012), Tribol. Lett. 48, 237-248. A table takes what was measured instead.
module camroller_boundary_law
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   implicit none
   private

   public :: boundary_law_t, boundary_curve_t, boundary_law_names, boundary_logarithmic, boundary_table
   public :: new_boundary_curve, evaluate_boundary_curve, follows_temperature, given_coefficients

   !> Laws: logarithm of the speed and straight line of the temperature, or a table over both
   character(len=*), parameter :: boundary_law_names(*) = [character(len=name_length) :: "logarithmic", "table"]
   !> Their positions in the list
   integer, parameter :: boundary_logarithmic = 1, boundary_table = 2

   !> A law of the coefficient
   type :: boundary_law_t
      !> One of `boundary_law_names`
      character(len=name_length) :: law = "logarithmic"
      !> Sliding speed [m/s] and temperature [K] at which the surfaces have the coefficient of the asperities
      real(wp) :: reference_speed = 0.0_wp, reference_temperature = 0.0_wp
      !> Change of the coefficient where the speed is ten times as high [-], and with the temperature [1/K]
      real(wp) :: change_per_decade = 0.0_wp, temperature_slope = 0.0_wp
      !> Sliding speed below which the logarithm levels off [m/s]
      real(wp) :: lowest_speed = 0.0_wp
      !> Bounds of the coefficient [-]
      real(wp) :: smallest = 0.0_wp, largest = 0.3_wp
      !> Points of a table, increasing [m/s], [K], and its coefficients, those of all speeds at the first temperature first [-]
      real(wp), allocatable :: speed_points(:), temperature_points(:), coefficient_points(:)
   end type boundary_law_t

   !> The law, ready for evaluation
   type :: boundary_curve_t
      !> Position in `boundary_law_names`
      integer :: law
      !> Bounds of the coefficient; what it is at the references [-]
      real(wp) :: smallest, largest, reference
      !> References [m/s], [K]; change per natural logarithm of the speed [-] and with the temperature [1/K]; lowest speed [m/s]
      real(wp) :: reference_speed, reference_temperature, by_logarithm, by_temperature, lowest_speed
      !> Logarithms of the speeds of a table [-] and its temperatures [K]
      real(wp), allocatable :: logarithms(:), temperatures(:)
      !> Its coefficients, shape (speed, temperature) [-]
      real(wp), allocatable :: coefficients(:, :)
   end type boundary_curve_t

   !> Values of a table that take part at a place: weights and their derivatives
   type :: weights_t
      !> Values that take part
      integer :: first = 1, last = 1
      !> Weights of values `first` to `last` [-] and their derivatives [1/x]
      real(wp) :: values(4) = 0.0_wp, slopes(4) = 0.0_wp
   end type weights_t

contains

   !> Coefficients that a law is given by: the points of a table within its bounds, else the one at the references.
   pure function given_coefficients(law, reference) result(coefficients)
      !> The law
      type(boundary_law_t), intent(in) :: law
      !> Coefficient at the reference speed and temperature; without meaning for a table [-]
      real(wp), intent(in) :: reference
      !> The coefficients [-]
      real(wp), allocatable :: coefficients(:)

      coefficients = [reference]
      if (law%law == boundary_law_names(boundary_table)) coefficients = min(max(law%coefficient_points, law%smallest), law%largest)
   end function given_coefficients

   !> Prepare a law; refuses one that means nothing.
   subroutine new_boundary_curve(curve, law, reference, error)
      !> Ready for evaluation
      type(boundary_curve_t), intent(out) :: curve
      !> The law
      type(boundary_law_t), intent(in) :: law
      !> Coefficient at the reference speed and temperature; without meaning for a table [-]
      real(wp), intent(in) :: reference
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      call find_name("boundary law", law%law, boundary_law_names, curve%law, error)
      if (allocated(error)) return
      curve%smallest = law%smallest
      curve%largest = law%largest
      curve%reference = reference
      curve%reference_speed = law%reference_speed
      curve%reference_temperature = law%reference_temperature
      curve%by_logarithm = law%change_per_decade/log(10.0_wp)
      curve%by_temperature = law%temperature_slope
      curve%lowest_speed = law%lowest_speed
      if (.not. (law%smallest >= 0.0_wp .and. law%largest >= law%smallest)) then
         call raise(error, kind_deck, "boundary law: the smallest coefficient is not negative and not above the largest")
      else if (curve%law == boundary_table) then
         call set_table(curve, law, error)
      else if (.not. min(law%reference_speed, law%reference_temperature, law%lowest_speed) > 0.0_wp) then
         call raise(error, kind_deck, "boundary law: reference speed, reference temperature and lowest speed must be positive")
      end if
   end subroutine new_boundary_curve

   !> Take the table of a law.
   subroutine set_table(curve, law, error)
      type(boundary_curve_t), intent(inout) :: curve
      type(boundary_law_t), intent(in) :: law
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: speeds, temperatures

      if (.not. (allocated(law%speed_points) .and. allocated(law%temperature_points) .and. allocated(law%coefficient_points))) then
         call raise(error, kind_deck, "boundary law: a table has speeds, temperatures and coefficients")
         return
      end if
      speeds = size(law%speed_points)
      temperatures = size(law%temperature_points)
      if (size(law%coefficient_points) /= speeds*temperatures .or. size(law%coefficient_points) == 0) then
         call raise(error, kind_deck, "boundary law: the table has one coefficient for each speed at each temperature")
      else if (.not. (all(law%speed_points > 0.0_wp) .and. all(law%temperature_points > 0.0_wp) .and. &
         & all(law%speed_points(2:) > law%speed_points(:speeds - 1)) .and. &
         & all(law%temperature_points(2:) > law%temperature_points(:temperatures - 1)))) then
         call raise(error, kind_deck, "boundary law: speeds and temperatures of the table are positive and increase")
      else if (.not. all(law%coefficient_points >= 0.0_wp)) then
         call raise(error, kind_deck, "boundary law: the coefficients of the table are not negative")
      end if
      if (allocated(error)) return
      curve%logarithms = log(law%speed_points)
      curve%temperatures = law%temperature_points
      curve%coefficients = reshape(law%coefficient_points, [speeds, temperatures])
   end subroutine set_table

   !> The coefficient.
   !>
   !> Logarithmic: `mu = mu_0 + c lg sqrt((V^2 + v_0^2)/(v_r^2 + v_0^2)) + b (T - T_r)` between its bounds. A table: cubic pieces
   !> through its points over the logarithm of the speed and over the temperature, with the slopes of parabolas through three
   !> points; the curve levels off at the first and the last point and stays there beyond them.
   pure subroutine evaluate_boundary_curve(curve, sliding_speed, temperature, coefficient, by_speed, by_temperature)
      !> The law
      type(boundary_curve_t), intent(in) :: curve
      !> Sliding speed of either sign [m/s], temperature [K]
      real(wp), intent(in) :: sliding_speed, temperature
      !> Coefficient [-]
      real(wp), intent(out) :: coefficient
      !> Its derivatives over the sliding speed with its sign [s/m] and over the temperature [1/K]
      real(wp), intent(out) :: by_speed, by_temperature

      ! Square of the speed that counts [m^2/s^2]
      real(wp) :: square

      if (curve%law == boundary_table) then
         call look_up(curve, sliding_speed, temperature, coefficient, by_speed, by_temperature)
      else
         square = sliding_speed**2 + curve%lowest_speed**2
         coefficient = curve%reference + 0.5_wp*curve%by_logarithm &
            & *log(square/(curve%reference_speed**2 + curve%lowest_speed**2)) &
            & + curve%by_temperature*(temperature - curve%reference_temperature)
         by_speed = curve%by_logarithm*sliding_speed/square
         by_temperature = curve%by_temperature
      end if
      if (coefficient >= curve%smallest .and. coefficient <= curve%largest) return
      coefficient = min(max(coefficient, curve%smallest), curve%largest)
      by_speed = 0.0_wp
      by_temperature = 0.0_wp
   end subroutine evaluate_boundary_curve

   !> Does the coefficient change with the temperature?
   pure function follows_temperature(curve) result(verdict)
      !> The law
      type(boundary_curve_t), intent(in) :: curve
      !> Does it?
      logical :: verdict

      if (curve%law == boundary_table) then
         verdict = size(curve%temperatures) > 1
      else
         verdict = abs(curve%by_temperature) > 0.0_wp
      end if
   end function follows_temperature

   !> Coefficient of a table with its derivatives, before its bounds.
   pure subroutine look_up(curve, sliding_speed, temperature, coefficient, by_speed, by_temperature)
      !> The law
      type(boundary_curve_t), intent(in) :: curve
      !> Sliding speed [m/s], temperature [K]
      real(wp), intent(in) :: sliding_speed, temperature
      !> Coefficient [-]
      real(wp), intent(out) :: coefficient
      !> Its derivatives over speed [s/m] and temperature [1/K]
      real(wp), intent(out) :: by_speed, by_temperature

      type(weights_t) :: along, across
      ! Coefficient at a temperature of the table [-] and its derivative over the logarithm of the speed [-]
      real(wp) :: value, slope
      integer :: j

      call set_weights(curve%logarithms, log(max(abs(sliding_speed), tiny(1.0_wp))), along)
      call set_weights(curve%temperatures, temperature, across)
      coefficient = 0.0_wp
      by_speed = 0.0_wp
      by_temperature = 0.0_wp
      do j = across%first, across%last
         associate (values => curve%coefficients(along%first:along%last, j), k => j - across%first + 1)
            value = dot_product(along%values(:size(values)), values)
            slope = dot_product(along%slopes(:size(values)), values)
            coefficient = coefficient + across%values(k)*value
            by_speed = by_speed + across%values(k)*slope
            by_temperature = by_temperature + across%slopes(k)*value
         end associate
      end do
      if (abs(by_speed) > 0.0_wp) by_speed = by_speed/sliding_speed
   end subroutine look_up

   !> Weights of the values of a table at a place: cubic pieces with a continuous derivative, level at both ends.
   pure subroutine set_weights(points, x, weights)
      !> Points, increasing [x]
      real(wp), intent(in) :: points(:)
      !> The place [x]
      real(wp), intent(in) :: x
      !> What takes part
      type(weights_t), intent(out) :: weights

      ! Part of the piece that lies before the place [-], length of the piece [x]
      real(wp) :: t, length
      integer :: i, n

      n = size(points)
      if (n == 1 .or. .not. (x > points(1) .and. x < points(n))) then
         weights%first = merge(n, 1, x >= points(n))
         weights%last = weights%first
         weights%values(1) = 1.0_wp
         return
      end if
      i = 1
      do while (x >= points(i + 1))
         i = i + 1
      end do
      weights%first = max(i - 1, 1)
      weights%last = min(i + 2, n)
      length = points(i + 1) - points(i)
      t = (x - points(i))/length
      call add_value(weights, i, (1.0_wp + 2.0_wp*t)*(1.0_wp - t)**2, -6.0_wp*t*(1.0_wp - t)/length)
      call add_value(weights, i + 1, t**2*(3.0_wp - 2.0_wp*t), 6.0_wp*t*(1.0_wp - t)/length)
      call add_slope(weights, points, i, length*t*(1.0_wp - t)**2, (1.0_wp - t)*(1.0_wp - 3.0_wp*t))
      call add_slope(weights, points, i + 1, length*t**2*(t - 1.0_wp), t*(3.0_wp*t - 2.0_wp))
   end subroutine set_weights

   !> Give a value weight.
   pure subroutine add_value(weights, point, value, slope)
      type(weights_t), intent(inout) :: weights
      !> Number of the value
      integer, intent(in) :: point
      !> Weight [-] and its derivative [1/x]
      real(wp), intent(in) :: value, slope

      associate (k => point - weights%first + 1)
         weights%values(k) = weights%values(k) + value
         weights%slopes(k) = weights%slopes(k) + slope
      end associate
   end subroutine add_value

   !> Give the slope at a point weight: that of the parabola through it and its neighbours; none at an end.
   pure subroutine add_slope(weights, points, point, value, slope)
      type(weights_t), intent(inout) :: weights
      !> Points, increasing [x]
      real(wp), intent(in) :: points(:)
      !> Number of the point
      integer, intent(in) :: point
      !> Weight of the slope [x] and its derivative [-]
      real(wp), intent(in) :: value, slope

      ! Lengths of the pieces before and behind [x]; weights of the values there in the slope [1/x]
      real(wp) :: before, behind, left, right

      if (point == 1 .or. point == size(points)) return
      before = points(point) - points(point - 1)
      behind = points(point + 1) - points(point)
      left = behind/(before*(before + behind))
      right = before/(behind*(before + behind))
      call add_value(weights, point - 1, -left*value, -left*slope)
      call add_value(weights, point, (left - right)*value, (left - right)*slope)
      call add_value(weights, point + 1, right*value, right*slope)
   end subroutine add_slope

end module camroller_boundary_law
