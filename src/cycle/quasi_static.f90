!> Quasi-static limit of the roller's spin: at every angle the roller is in its quasi-static balance.
!>
!> In: the roller's spin, stops. Out: the curve of the balance. The simplest model of the spin: accurate where the spin decays fast
!> compared with the change of the kinematics (hot oil, the event), inaccurate where it does not (cold oil on the base circle). It
!> needs no initial value and is periodic by construction.
!>
!> One solution of the contact gives the rate of the sliding speed and its derivatives, and these the balance, by Newton's method,
!> and the slope of the balance, `-(drate/dtheta)/(drate/dV_s)`. Values and slopes at both ends and in the middle of a piece make a
!> polynomial of degree five. What it is worth is seen at two more points between them, from which the next two pieces are made:
!> they are taken where the polynomial has the balance there to the error allowed, and looked at in the same way where it has not.
!> Where the balance is smooth, the error of pieces half as long is a sixty-fourth of that.
module camroller_quasi_static
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_kinematics, only : position_t
   use camroller_balance, only : follow_balance
   use camroller_ode, only : counters_t
   use camroller_ode_problem, only : linear_t, new_linear
   use camroller_spin, only : nearby_t, spin_problem_t
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_curve, append_straight, curve_numbers, curve_state, &
      & least_segment, stop_margin
   implicit none
   private

   public :: quasi_static_cycle

   !> Longest piece that is looked at [rad]: its balances stand a quarter of it apart
   real(wp), parameter :: longest_piece = 10.0_wp*degree
   !> Halvings of a piece before it is taken as straight between its balances: what still bends within 1e-4 degrees is a jump
   integer, parameter :: max_depth = 17
   !> Last step of Newton's method over the error allowed, from which on the slope is that of the balance [-]
   real(wp), parameter :: balance_part = 0.1_wp
   !> Steps from a guess before the search restarts: each doubles the digits
   integer, parameter :: max_steps = 12

   !> Balance at an angle
   type :: balance_t
      !> Cam angle from full lift [rad], sliding speed [m/s], its slope along the balance [m/s/rad]
      real(wp) :: angle = 0.0_wp, value = 0.0_wp, slope = 0.0_wp
   end type balance_t

   !> What the balances of a segment share
   type :: search_t
      !> The roller's spin, with the contacts solved last
      type(spin_problem_t) :: problem
      !> Error allowed [m/s]; end of the segment [rad]
      real(wp) :: tolerance = 0.0_wp, horizon = 0.0_wp
   end type search_t

contains

   !> Sliding speed of the quasi-static balance over a cycle.
   subroutine quasi_static_cycle(problem, stops, tolerance, trajectory, counters, error)
      !> The roller's spin, over its sliding speed
      type(spin_problem_t), intent(in) :: problem
      !> First angle, stops between, last angle [rad]
      real(wp), intent(in) :: stops(:)
      !> Error allowed [m/s]
      real(wp), intent(in) :: tolerance
      !> The balance; its rates are those of the roller equation: none
      type(trajectory_t), intent(inout) :: trajectory
      !> Pieces kept count as steps, solutions of the contact as evaluations
      type(counters_t), intent(inout) :: counters
      !> Convergence error that names the angle where there is no balance
      type(error_t), allocatable, intent(out) :: error

      type(search_t) :: search
      type(nearby_t), target :: nearby
      ! Ends and middle of a piece
      type(balance_t) :: piece(3)
      ! A few roundings; start of the segment, length of a piece [rad]; sliding speed to start from [m/s]
      real(wp) :: margin, left, length, guess
      integer :: segment, i, pieces

      search%problem = problem
      search%problem%nearby => nearby
      search%tolerance = tolerance
      margin = stop_margin(stops)
      call start_trajectory(trajectory, 1)
      guess = 0.0_wp
      do segment = 1, size(stops) - 1
         left = stops(segment) + margin
         search%horizon = stops(segment + 1) - margin
         length = search%horizon - left
         if (length <= least_segment*margin) cycle
         pieces = ceiling(length/longest_piece)
         length = length/pieces
         call find_balance_at(search, left, guess, piece(3), counters, error)
         if (allocated(error)) return
         call append_straight(trajectory, left, [piece(3)%value], [0.0_wp])
         do i = 1, pieces
            piece(1) = piece(3)
            call find_balance_at(search, left + (i - 0.5_wp)*length, piece(1)%value, piece(2), counters, error)
            if (.not. allocated(error)) call find_balance_at(search, left + i*length, piece(2)%value, piece(3), counters, error)
            if (.not. allocated(error)) call append_piece(search, piece, 0, trajectory, counters, error)
            if (allocated(error)) return
         end do
         guess = piece(3)%value
      end do
   end subroutine quasi_static_cycle

   !> Append a piece, its left end left out: in two halves, or in more where the balance bends.
   recursive subroutine append_piece(search, piece, depth, trajectory, counters, error)
      !> What the balances share
      type(search_t), intent(in) :: search
      !> Left end, middle, right end
      type(balance_t), intent(in) :: piece(3)
      !> Halvings so far
      integer, intent(in) :: depth
      !> The balance so far
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! The piece with the balances between
      type(balance_t) :: fine(5)
      ! Curve through the piece [m/s]; sliding speed on it [m/s]
      real(wp) :: bends(1, curve_numbers), guess(1)
      logical :: is_good
      integer :: i

      fine([1, 3, 5]) = piece
      bends = bends_through(piece)
      is_good = .true.
      do i = 2, 4, 2
         guess = curve_state([piece(1)%value], [piece(3)%value], bends, 0.25_wp*(i - 1))
         call find_balance_at(search, 0.5_wp*(fine(i - 1)%angle + fine(i + 1)%angle), guess(1), fine(i), counters, error)
         if (allocated(error)) return
         is_good = is_good .and. abs(fine(i)%value - guess(1)) <= search%tolerance
      end do
      do i = 1, 3, 2
         if (is_good) then
            call append_curve(trajectory, fine(i + 2)%angle, [fine(i + 2)%value], [0.0_wp], bends_through(fine(i:i + 2)))
         else if (depth < max_depth) then
            call append_piece(search, fine(i:i + 2), depth + 1, trajectory, counters, error)
            if (allocated(error)) return
         else
            call append_straight(trajectory, fine(i + 1)%angle, [fine(i + 1)%value], [0.0_wp])
            call append_straight(trajectory, fine(i + 2)%angle, [fine(i + 2)%value], [0.0_wp])
         end if
      end do
      if (is_good) counters%accepted = counters%accepted + 2
   end subroutine append_piece

   !> Numbers of the curve of degree five through values and slopes at both ends and in the middle of a piece.
   pure function bends_through(piece) result(bends)
      !> Left end, middle, right end
      type(balance_t), intent(in) :: piece(3)
      !> As of `trajectory_t` [m/s]
      real(wp) :: bends(1, curve_numbers)

      ! Slopes over the length of the piece, its rise [m/s]
      real(wp) :: slopes(3), rise
      ! Of the cubic that the curve less its chord is, over p (1 - p): value at the left end; values at the right end and in the
      ! middle less that; slope in the middle [m/s]
      real(wp) :: first, last, middle, slope

      slopes = piece%slope*(piece(3)%angle - piece(1)%angle)
      rise = piece(3)%value - piece(1)%value
      first = slopes(1) - rise
      last = rise - slopes(3) - first
      middle = 4.0_wp*piece(2)%value - 2.0_wp*(piece(1)%value + piece(3)%value) - first
      slope = 4.0_wp*(slopes(2) - rise)
      bends = 0.0_wp
      bends(1, 1) = first
      bends(1, 4) = 4.0_wp*(last - slope)
      bends(1, 2) = 4.0_wp*middle - last + 0.5_wp*bends(1, 4)
      bends(1, 3) = last - bends(1, 2) - bends(1, 4)
   end function bends_through

   !> Balance at an angle from a guess; an error where there is none.
   subroutine find_balance_at(search, angle, guess, balance, counters, error)
      !> What the balances share
      type(search_t), intent(in) :: search
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Sliding speed nearby [m/s]
      real(wp), intent(in) :: guess
      type(balance_t), intent(out) :: balance
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Decay rate [1/rad]; last step of Newton's method [m/s]
      real(wp) :: decay_rate, step
      logical :: is_found
      integer :: i

      balance%angle = angle
      balance%value = guess
      do i = 1, max_steps
         call improve(search, balance, step, counters, is_found)
         if (.not. is_found) exit
         if (abs(step) <= balance_part*search%tolerance) return
      end do
      balance%value = guess
      call follow_balance(search%problem%model, angle, balance_part*search%tolerance, position, balance%value, decay_rate, &
         & counters%evaluations, is_found)
      ! Where the steps lead nowhere the balance turns sharply, and its slope is no matter
      if (is_found) call take_slope(search, balance, counters)
      if (.not. is_found) call raise(error, kind_convergence, "quasi-static limit: the roller has no quasi-static balance at "// &
         & cam_angle_text(angle, 3)//": no contact there, or traction cannot follow the kinematics; choose another method")
   end subroutine find_balance_at

   !> A step of Newton's method.
   subroutine improve(search, balance, step, counters, is_found)
      !> What the balances share
      type(search_t), intent(in) :: search
      !> Balance; out: nearer to it, with the slope where it was
      type(balance_t), intent(inout) :: balance
      !> The step [m/s]
      real(wp), intent(out) :: step
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Is there contact, and a sliding speed below that of a roller at rest after the step?
      logical, intent(out) :: is_found

      type(linear_t) :: linear
      integer :: status

      step = 0.0_wp
      call new_linear(linear, 1)
      call search%problem%linearise(balance%angle, [balance%value], search%horizon, linear, counters, status)
      associate (contact => search%problem%nearby%last, decay_rate => -linear%jacobian(1, 1))
         is_found = status == 0 .and. decay_rate > 0.0_wp
         if (is_found) is_found = contact%is_touching
         if (.not. is_found) return
         step = linear%rate(1)/decay_rate
         is_found = abs(balance%value + step) < abs(contact%rolling_speed)
         if (.not. is_found) return
         balance%value = balance%value + step
         balance%slope = linear%time_slope(1)/decay_rate
      end associate
   end subroutine improve

   !> Slope at a balance that was found by a search; none where the roller equation has none.
   subroutine take_slope(search, balance, counters)
      !> What the balances share
      type(search_t), intent(in) :: search
      !> Balance; out: with its slope
      type(balance_t), intent(inout) :: balance
      !> Work done
      type(counters_t), intent(inout) :: counters

      type(balance_t) :: trial
      real(wp) :: step ! [m/s]
      logical :: is_found

      trial = balance
      call improve(search, trial, step, counters, is_found)
      balance%slope = merge(trial%slope, 0.0_wp, is_found)
   end subroutine take_slope

end module camroller_quasi_static
