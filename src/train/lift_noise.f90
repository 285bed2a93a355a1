!> Noise of a lift table, and what it does to the acceleration; a single row that does not go with its neighbours; ends at which
!> the lift has a slope.
!>
!> In: a table of lift over cam angle. Out: an estimate of the noise, and the acceleration with and without smoothing by somewhat
!> more; the row that is off, and by how much; the acceleration at the ends. A row that is off by e has fourth differences of
!> e (1, -4, 6, -4, 1) about it.
module camroller_lift_noise
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_lift, only : evaluate_lift, given_table, lift_law_t, lift_t, new_lift_law
   use camroller_lift_table, only : estimate_noise, find_event, has_even_rows, median_deviate
   use camroller_sorting, only : median
   implicit none
   private

   public :: lift_noise_t, find_lift_noise, find_outlier, find_sharp_ends

   !> What is known of the noise of a table
   type :: lift_noise_t
      !> Is it known? Not for tables of few rows or of uneven steps
      logical :: is_known = .false.
      !> Its root mean square, and the smoothing that takes it out [m]
      real(wp) :: noise = 0.0_wp, smoothing = 0.0_wp
      !> Smallest and largest second derivative of the table as the case has it, and with that smoothing [m/rad^2]
      real(wp) :: given(2) = 0.0_wp, smoothed(2) = 0.0_wp
   end type lift_noise_t

   !> Smoothing over the noise [-]. A curve that must come nearer to the rows than their noise follows it: with rows every 0.1
   !> degrees loads are 20 to 40 % too large at 0.85 of the noise, up to 10 % and more at 0.95, and right to a percent at 1.2 and
   !> 1.4. The estimate of the noise is off by 5 to 15 %.
   real(wp), parameter :: over_noise = 1.2_wp
   !> Step in which the acceleration is looked at [rad]
   real(wp), parameter :: step = 0.25_wp*degree

   !> Fourth differences about a row that is off by one; the sum of their squares [-]
   real(wp), parameter :: pattern(-2:2) = [1.0_wp, -4.0_wp, 6.0_wp, -4.0_wp, 1.0_wp], pattern_squares = 70.0_wp
   !> A row is off where it is so by that many standard deviations of the noise of all; where the pattern leaves less than that part
   !> of the differences about it, and less than half of what a bend of the lift would leave; and where it makes that part of the
   !> largest acceleration [-]
   real(wp), parameter :: deviations = 6.0_wp, most_left = 0.35_wp, of_bend = 0.5_wp, part_of_acceleration = 0.05_wp

contains

   !> Find the row of a table that is off most, if one is. A bend of the lift, where a ramp begins or ends, is none: its fourth
   !> differences are (1, -2, 1) about a row or two neighbours.
   pure subroutine find_outlier(angles, lifts, row, offset)
      !> Cam angles, increasing [any]
      real(wp), intent(in) :: angles(:)
      !> Lifts [any]
      real(wp), intent(in) :: lifts(:)
      !> The row; 0 where none is off, or where rows are few or at uneven steps
      integer, intent(out) :: row
      !> How far it is off [as lifts]
      real(wp), intent(out) :: offset

      ! Second and fourth differences, those of the fourth about a row; a row's distance from its neighbours [as lifts]
      real(wp), allocatable :: second(:), fourth(:)
      real(wp) :: about(-2:2), off
      ! Size of the noise, largest second difference of any row but those about the one looked at [as lifts]
      real(wp) :: noise, largest
      integer :: i, n

      row = 0
      offset = 0.0_wp
      n = size(lifts)
      if (.not. has_even_rows(angles)) return
      allocate (second(2:n - 1), fourth(3:n - 2))
      second = lifts(3:) - 2.0_wp*lifts(2:n - 1) + lifts(:n - 2)
      fourth = second(4:) - 2.0_wp*second(3:n - 2) + second(:n - 3)
      noise = median(pack(abs(fourth), abs(fourth) > 0.0_wp))/(median_deviate*sqrt(pattern_squares))
      do i = 5, n - 4
         about = fourth(i - 2:i + 2)
         off = sum(pattern*about)/pattern_squares
         if (abs(off) <= max(deviations*noise, abs(offset))) cycle
         if (norm2(about - off*pattern) > min(most_left*norm2(about), of_bend*left_by_bend(about))) cycle
         largest = max(maxval(abs(second(:i - 2))), maxval(abs(second(i + 2:))))
         if (2.0_wp*abs(off) < part_of_acceleration*largest) cycle
         row = i
         offset = off
      end do
   end subroutine find_outlier

   !> Find the ends of an event at which the lift begins or ends with a slope, as a valve's lift does whose lash was taken off. The
   !> curve through the rows starts at rest and gets that slope within a row or two: its acceleration there grows as the rows get
   !> closer, and is no cam's. An end is taken for such a one where its acceleration is the largest, as ramps bend less than flanks,
   !> and where the slope that two rows bring changes by far less from row to row behind them.
   subroutine find_sharp_ends(lift, is_sharp, acceleration, slope)
      !> Lift of the valve, by a table
      type(lift_t), intent(in) :: lift
      !> Is the first or the last end so?
      logical, intent(out) :: is_sharp(2)
      !> Largest second derivative within two rows of the ends, and farther than five from both, in size [m/rad^2]
      real(wp), intent(out) :: acceleration(3)
      !> Slope of the table two rows from the ends [m/rad]
      real(wp), intent(out) :: slope(2)

      ! Event above which the lift may fill the turn, and has no ends [deg]
      real(wp), parameter :: longest = 350.0_wp
      ! Slope over its change from row to row, from which on it is no flank that a few rows show [-]
      real(wp), parameter :: over_change = 1.5_wp
      ! Rows next to an end whose steps count as its own; rows as far as which such an end reaches; places looked at in a step
      integer, parameter :: own = 2, reach = 5, places = 8
      type(lift_law_t) :: law
      type(error_t), allocatable :: error
      ! Lift and its derivatives [m, m/rad, ...]
      real(wp) :: values(0:3)
      ! Cam angles of the rows [rad], slopes of the first four steps from an end [m/rad]
      real(wp), allocatable :: angle(:)
      real(wp) :: slopes(4)
      integer :: i, k, low, high

      is_sharp = .false.
      acceleration = 0.0_wp
      slope = 0.0_wp
      call new_lift_law(law, lift, error)
      if (allocated(error)) return
      call find_event(lift%table_angle, lift%table_lift, lift%smoothing, low, high)
      angle = lift%table_angle
      if (high - low < 4*reach .or. angle(high) - angle(low) > longest*degree) return
      do i = low, high - 1
         do k = 0, places - 1
            call evaluate_lift(law, angle(i) + real(k, wp)/places*(angle(i + 1) - angle(i)), values)
            if (i - low < own) acceleration(1) = max(acceleration(1), abs(values(2)))
            if (high - i <= own) acceleration(2) = max(acceleration(2), abs(values(2)))
            if (min(i - low, high - i - 1) >= reach) acceleration(3) = max(acceleration(3), abs(values(2)))
         end do
      end do
      associate (row => [low + own, high - own])
         slope = (lift%table_lift(row + 1) - lift%table_lift(row - 1))/(angle(row + 1) - angle(row - 1))
      end associate
      associate (lifts => lift%table_lift)
         slopes = (lifts(low + 1:low + 4) - lifts(low:low + 3))/(angle(low + 1:low + 4) - angle(low:low + 3))
         is_sharp(1) = abs(slopes(2)) > over_change*maxval(abs(slopes(3:4) - slopes(2:3)))
         slopes = (lifts(high - 3:high) - lifts(high - 4:high - 1))/(angle(high - 3:high) - angle(high - 4:high - 1))
         is_sharp(2) = abs(slopes(3)) > over_change*maxval(abs(slopes(1:2) - slopes(2:3)))
      end associate
      is_sharp = is_sharp .and. acceleration(:2) > acceleration(3)
   end subroutine find_sharp_ends

   !> What a bend at two neighbouring rows leaves of fourth differences.
   pure function left_by_bend(about) result(left)
      !> Differences about a row [any]
      real(wp), intent(in) :: about(-2:2)
      !> The size of what is left [any]
      real(wp) :: left

      real(wp), parameter :: bend(*) = [1.0_wp, -2.0_wp, 1.0_wp] ! [-]
      ! Products with a bend at the row and at one beside it, what both explain of the square of the differences [any]
      real(wp) :: here, beside, explained
      integer :: i

      here = sum(bend*about(-1:1))
      explained = 0.0_wp
      do i = -1, 1, 2
         beside = sum(bend*about(i - 1:i + 1))
         ! Inverse of ((6, -4), (-4, 6)), the products of the bends
         explained = max(explained, (6.0_wp*here**2 + 8.0_wp*here*beside + 6.0_wp*beside**2)/20.0_wp)
      end do
      left = sqrt(max(0.0_wp, sum(about**2) - explained))
   end function left_by_bend

   !> Find the noise of a lift's table: of the values that were given, whatever they are of, over the event. Noise on the base
   !> circle may be cut at zero.
   subroutine find_lift_noise(lift, noise)
      !> The lift
      type(lift_t), intent(in) :: lift
      !> What is known of its noise
      type(lift_noise_t), intent(out) :: noise

      type(lift_law_t) :: law
      type(lift_t) :: given
      type(error_t), allocatable :: error
      logical :: is_known
      integer :: low, high

      if (.not. allocated(lift%table_lift)) return
      given = given_table(lift)
      call find_event(given%table_angle, given%table_lift, given%smoothing, low, high)
      call estimate_noise(given%table_angle(low:high), given%table_lift(low:high), noise%noise, is_known)
      if (.not. is_known) return
      noise%smoothing = over_noise*noise%noise
      call new_lift_law(law, given, error)
      if (allocated(error)) return
      call find_range(law, given, noise%given)
      given%smoothing = noise%smoothing
      call new_lift_law(law, given, error)
      if (allocated(error)) return
      call find_range(law, given, noise%smoothed)
      noise%is_known = .true.
   end subroutine find_lift_noise

   !> Smallest and largest second derivative of a lift over its table.
   subroutine find_range(law, lift, range)
      type(lift_law_t), intent(in) :: law
      !> The lift that it was made of
      type(lift_t), intent(in) :: lift
      !> The derivatives [m/rad^2]
      real(wp), intent(out) :: range(2)

      ! Lift and its derivatives [m, m/rad, ...]
      real(wp) :: values(0:3)
      integer :: i, n

      range = 0.0_wp
      n = size(lift%table_angle)
      do i = 0, ceiling((lift%table_angle(n) - lift%table_angle(1))/step)
         call evaluate_lift(law, lift%table_angle(1) + i*step, values)
         range = [min(range(1), values(2)), max(range(2), values(2))]
      end do
   end subroutine find_range

end module camroller_lift_noise
