!> Errors of means and extremes caused by the error of the sliding speed.
!>
!> In: points of a cycle with their states and the error of the sliding speed there, as `error_estimate` finds it.
!> Out: for everything that is sampled, the error of its integral over the cycle; the error of a smallest or largest value.
!>
!> At each point the state is evaluated again with the sliding speed less its error, so that whatever follows the slip, however
!> steeply, has its share: a film, a force that saturates, asperities that begin to touch. Within an interval of the solution the
!> differences add up with their signs, since a method's defect has a mean next to nothing there: where the roller's inertia counts
!> for little the force is off by the defect itself. Between intervals nothing is known of signs, and magnitudes add up.
module camroller_slip_errors
   use camroller_kinds, only : wp, degree, two_pi
   use camroller_catalogue, only : follower_values
   use camroller_cycle, only : cycle_t
   use camroller_error_estimate, only : contact_accuracy_for, estimate_t, error_at_start, margin
   use camroller_follower_samples, only : follower_samples_t, sampled_values
   use camroller_joint_forces, only : joint_basis_t
   use camroller_model, only : model_t
   use camroller_panels, only : gauss_points, panel_places, panel_points
   use camroller_shaft, only : solved_t
   use camroller_state, only : state_t, evaluate_spin, evaluate_state, add_torques
   use camroller_stick_slip, only : direction_at
   use camroller_trajectory, only : curve_slope, interpolate_state
   implicit none
   private

   public :: slip_points_t, slip_errors_t, relief_t, start_points, keep_point, set_errors, find_slip_errors, error_of_extreme, &
      & error_at, state_without

   !> Fraction of what cancels within an interval that is counted all the same: the estimate at a point is of first order [-]
   real(wp), parameter :: distrust = 0.02_wp

   !> Points of a cycle
   type :: slip_points_t
      !> Number of points so far
      integer :: count = 0
      !> Interval of the trajectory that holds each
      integer, allocatable :: interval(:)
      !> Cam angle [rad], length that a point represents [rad]
      real(wp), allocatable :: angle(:), weight(:)
      type(state_t), allocatable :: states(:)
      !> What was sampled, shape (quantity, point) [unit of each]
      real(wp), allocatable :: values(:, :)
      !> Error of the trajectory [m/s]; fraction of an error at its start that is left [-]
      real(wp), allocatable :: errors(:), shares(:)
      !> Number of all points of panels so far
      integer :: fine_count = 0
      !> In the same way their cam angles [rad], errors [m/s] and fractions [-]
      real(wp), allocatable :: fine_angle(:), fine_errors(:), fine_shares(:)
   end type slip_points_t

   !> What the series of a follower would be at one angle without the error of the sliding speed: many have their extremes there
   type :: relief_t
      !> Is it known with the error taken away, and with as much of the other sign?
      logical :: is_known(2) = .false.
      !> The series, shape (series, sign) [unit of the series]
      real(wp), allocatable :: values(:, :)
   end type relief_t

   !> Errors of all that is sampled, and where they come from
   type :: slip_errors_t
      !> Errors of the integrals over the cycle [unit of each times rad]
      real(wp), allocatable :: integrals(:)
      !> Smallest and largest values at the points without the error of the sliding speed [unit of each]
      real(wp), allocatable :: lowest(:), highest(:)
      !> Cam angles of all points of panels from full lift, in order [rad], and error of the trajectory there [m/s]
      real(wp), allocatable :: angle(:), error(:)
   end type slip_errors_t

contains

   !> Begin without points.
   pure subroutine start_points(points, quantities, intervals)
      !> The points
      type(slip_points_t), intent(out) :: points
      !> Number of quantities that are sampled, of intervals
      integer, intent(in) :: quantities, intervals

      associate (room => size(gauss_points)*intervals, fine_room => panel_points*intervals)
         allocate (points%interval(room), points%angle(room), points%weight(room), points%states(room), &
            & points%values(quantities, room), points%errors(room), points%shares(room))
         allocate (points%fine_angle(fine_room), points%fine_errors(fine_room), points%fine_shares(fine_room))
      end associate
   end subroutine start_points

   !> Keep the point that was sampled last.
   pure subroutine keep_point(points, samples, interval, angle, weight, values)
      !> The points
      type(slip_points_t), intent(inout) :: points
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Interval of the trajectory that holds the point
      integer, intent(in) :: interval
      !> Cam angle from full lift, length that the point represents [rad]
      real(wp), intent(in) :: angle, weight
      !> What was sampled there [unit of each]
      real(wp), intent(in) :: values(:)

      points%count = points%count + 1
      points%interval(points%count) = interval
      points%angle(points%count) = angle
      points%weight(points%count) = weight
      points%states(points%count) = samples%state
      points%values(:, points%count) = values
   end subroutine keep_point

   !> Take the errors at the last points, those of the panel that has just ended, and at all points of its rules.
   pure subroutine set_errors(points, number, estimate, left, right)
      !> The points
      type(slip_points_t), intent(inout) :: points
      !> Number of them in the panel
      integer, intent(in) :: number
      !> The estimate at the end of the interval
      type(estimate_t), intent(in) :: estimate
      !> Ends of the panel [rad]
      real(wp), intent(in) :: left, right

      associate (first => points%fine_count + 1, last => points%fine_count + panel_points)
         points%fine_angle(first:last) = left + panel_places*(right - left)
         points%fine_errors(first:last) = estimate%point_errors(:last - first + 1)
         points%fine_shares(first:last) = estimate%point_shares(:last - first + 1)
      end associate
      points%fine_count = points%fine_count + panel_points
      associate (first => points%count - number + 1, last => points%count)
         points%errors(first:last) = estimate%errors(:number)
         points%shares(first:last) = estimate%shares(:number)
      end associate
   end subroutine set_errors

   !> Errors of all that is sampled.
   pure subroutine find_slip_errors(points, samples, estimate, errors)
      !> The points
      type(slip_points_t), intent(in) :: points
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> The estimate at the end of the cycle
      type(estimate_t), intent(in) :: estimate
      !> The errors
      type(slip_errors_t), intent(out) :: errors

      ! Differences that the error makes [unit of each]; their integral over an interval and that of their magnitudes [unit of each
      ! times rad]
      real(wp), dimension(size(points%values, 1)) :: differences, signed, sizes
      ! Error at the start of the periodic cycle, at a point [m/s]
      real(wp) :: first, error
      integer :: i
      ! Is the point the first, or the last, of its interval?
      logical :: is_first, is_last

      associate (path => samples%cycle%trajectory)
         first = error_at_start(estimate, path%state(1, path%count) - path%state(1, 1))
      end associate
      allocate (errors%integrals(size(signed)), source=0.0_wp)
      allocate (errors%lowest(size(signed)), source=huge(1.0_wp))
      allocate (errors%highest(size(signed)), source=-huge(1.0_wp))
      errors%angle = points%fine_angle(:points%fine_count)
      errors%error = points%fine_errors(:points%fine_count) + first*points%fine_shares(:points%fine_count)
      is_last = .true.
      do i = 1, points%count
         is_first = is_last
         is_last = i == points%count
         if (.not. is_last) is_last = points%interval(i + 1) /= points%interval(i)
         if (is_first) then
            signed = 0.0_wp
            sizes = 0.0_wp
         end if
         error = points%errors(i) + first*points%shares(i)
         call evaluate_difference(points, samples, i, error, differences)
         call add_differences(size(differences), points%weight(i), points%values(:, i), differences, signed, sizes, &
            & errors%lowest, errors%highest)
         if (is_last) errors%integrals(:) = errors%integrals + margin*max(abs(signed), distrust*sizes)
      end do
   end subroutine find_slip_errors

   !> Add the differences at a point to integrals and extremes: in one pass, for there are many points.
   pure subroutine add_differences(count, weight, values, differences, signed, sizes, lowest, highest)
      !> Number of quantities
      integer, intent(in) :: count
      !> Length that the point represents [rad]
      real(wp), intent(in) :: weight
      !> What was sampled there, and what of it the error makes [unit of each]
      real(wp), intent(in) :: values(count), differences(count)
      !> Integrals of the differences and of their magnitudes [unit of each times rad]
      real(wp), intent(inout) :: signed(count), sizes(count)
      !> Smallest and largest values without the error [unit of each]
      real(wp), intent(inout) :: lowest(count), highest(count)

      integer :: i

      do i = 1, count
         signed(i) = signed(i) + weight*differences(i)
         sizes(i) = sizes(i) + weight*abs(differences(i))
         lowest(i) = min(lowest(i), values(i) - differences(i))
         highest(i) = max(highest(i), values(i) - differences(i))
      end do
   end subroutine add_differences

   !> Error of a smallest or largest value: by how much the error of the sliding speed changes it where it is, or by how much a
   !> point would exceed it without that error.
   subroutine error_of_extreme(errors, solved, lobe, state, values, relief, angle, series, sense, value, is_exact, is_of_part, &
      & error)
      !> The errors
      type(slip_errors_t), intent(in) :: errors
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> State of the follower where the extreme is
      type(state_t), intent(in) :: state
      !> Series of the follower there [unit of the series]
      real(wp), intent(in) :: values(:)
      !> The same without the error, as far as it was asked for
      type(relief_t), intent(inout) :: relief
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> The series
      integer, intent(in) :: series
      !> 1 for the smallest value, -1 for the largest
      integer, intent(in) :: sense
      !> The value [unit of the series]
      real(wp), intent(in) :: value
      !> Is it the value of a row that is exact, as that of a surface at rest?
      logical, intent(in) :: is_exact
      !> Is it that of a part of the turn, which other points may exceed?
      logical, intent(in) :: is_of_part
      !> Its error [unit of the series]
      real(wp), intent(out) :: error

      ! Part of a value that is rounding of another evaluation [-]; distance beyond which the curve is not straight [rad]
      real(wp), parameter :: rounding = 1.0e-9_wp, farthest = 1.0_wp*degree
      ! Angle within the cycle [rad]; error of the trajectory [m/s]; change of the value without it [unit of the series]
      real(wp) :: inside, slip_error, change

      error = 0.0_wp
      if (sense > 0 .and. .not. is_of_part) error = max(0.0_wp, value - errors%lowest(series))
      if (sense < 0 .and. .not. is_of_part) error = max(0.0_wp, errors%highest(series) - value)
      inside = solved%cycles(lobe)%start + modulo(angle - solved%cycles(lobe)%start, two_pi)
      if (abs(values(series) - value) <= rounding*abs(value) .and. .not. is_exact) then
         slip_error = error_at(errors, inside)
         call provide(1)
         change = change_without(1)
         ! Where either sign of the error makes the value less of an extreme, it belongs to a sliding speed that the cycle passes
         ! through, a little earlier or later
         if (change > 0.0_wp) then
            call provide(2)
            if (change_without(2) >= 0.0_wp) change = change_of_place()
         end if
         error = max(error, abs(change))
      end if
      error = margin*error

   contains

      !> Change of the value by the error of the sliding speed that is taken away, positive where it is less of an extreme then.
      pure function change_without(sign) result(difference)
         !> 1 for the error, 2 for as much of the other sign
         integer, intent(in) :: sign
         !> The change [unit of the series]
         real(wp) :: difference

         difference = sense*(relief%values(series, sign) - values(series))
      end function change_without

      !> See to it that what would be without the error is known.
      subroutine provide(sign)
         !> 1 for the error, 2 for as much of the other sign
         integer, intent(in) :: sign

         type(state_t) :: right
         integer :: status

         if (relief%is_known(sign)) return
         if (.not. allocated(relief%values)) allocate (relief%values(size(values), 2))
         call state_without(solved%models(lobe), solved%cycles(lobe), inside, state, merge(slip_error, -slip_error, sign == 1), &
            & right, status)
         if (status == 0) call follower_values(solved%case, solved%models(lobe), right, relief%values(:, sign))
         if (status /= 0) relief%values(:, sign) = 0.0_wp
         relief%is_known(sign) = .true.
      end subroutine provide

      !> Change of the value with its sliding speed at the angle at which the cycle passes through that without the error.
      pure function change_of_place() result(difference)
         !> The change [unit of the series]
         real(wp) :: difference

         type(state_t) :: right
         ! Slope of the curve [m/s/rad]; sliding speed [m/s]; series at the other angle [unit of the series]
         real(wp) :: slope(1), sliding_speed(1), there(size(values))
         integer :: hint, status

         difference = 0.0_wp
         associate (cycle => solved%cycles(lobe))
            if (cycle%has_surface_speed .or. cycle%is_linear .or. allocated(cycle%phases)) return
            hint = 1
            call interpolate_state(cycle%trajectory, inside, hint, sliding_speed)
            call curve_slope(cycle%trajectory, inside, hint, slope)
            if (.not. abs(slip_error) < farthest*abs(slope(1))) return
            call evaluate_state(solved%models(lobe), inside + slip_error/slope(1), state%contact%sliding_speed, right, status, &
               & start=state%contact, accuracy=contact_accuracy_for(cycle%tolerance))
         end associate
         if (status /= 0) return
         call follower_values(solved%case, solved%models(lobe), right, there)
         difference = there(series) - values(series)
      end function change_of_place

   end subroutine error_of_extreme

   !> Error of the trajectory at a cam angle: the largest of its panel, of both panels where the angle is between two.
   !>
   !> Where a disturbance decays within less than a step the error swings about zero once or twice within each step, and where the
   !> sliding speed itself changes little it has its extremes at crests of the error, which may be between all points.
   pure function error_at(errors, angle) result(error)
      !> The errors
      type(slip_errors_t), intent(in) :: errors
      !> Cam angle from full lift, within the cycle [rad]
      real(wp), intent(in) :: angle
      !> The error [m/s]
      real(wp) :: error

      integer :: left, right, middle, first, last

      left = 1
      right = size(errors%angle)
      do while (right - left > 1)
         middle = (left + right)/2
         if (errors%angle(middle) <= angle) then
            left = middle
         else
            right = middle
         end if
      end do
      first = left - modulo(left - 1, panel_points)
      last = right - modulo(right - 1, panel_points) + panel_points - 1
      error = errors%error(first - 1 + maxloc(abs(errors%error(first:last)), 1))
   end function error_at

   !> What is sampled at a point less what would be without the error of the sliding speed.
   pure subroutine evaluate_difference(points, samples, place, error, differences)
      type(slip_points_t), intent(in) :: points
      type(follower_samples_t), intent(in) :: samples
      !> Which of the points
      integer, intent(in) :: place
      !> Error of the trajectory there [m/s]
      real(wp), intent(in) :: error
      !> The differences [unit of each]
      real(wp), intent(out), contiguous :: differences(:)

      type(state_t) :: right
      integer :: status

      call state_without(samples%model, samples%cycle, points%angle(place), points%states(place), error, right, status)
      if (status == 0) then
         call sampled_values(samples, right, differences)
         differences = points%values(:, place) - differences
      else
         ! So far off that there is no state: the error is unknown there
         differences = points%values(:, place)
      end if
   end subroutine evaluate_difference

   !> State with the sliding speed less its error.
   pure subroutine state_without(model, cycle, angle, state, error, right, status)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> Cam angle from full lift, within the cycle [rad]
      real(wp), intent(in) :: angle
      !> State with the error
      type(state_t), intent(in) :: state
      !> Error of the trajectory [m/s]
      real(wp), intent(in) :: error
      !> State without it
      type(state_t), intent(out) :: right
      !> 0 fine, positive: no balance found
      integer, intent(out) :: status

      type(joint_basis_t), allocatable :: joints
      ! Sliding speed without the error [m/s]
      real(wp) :: sliding_speed
      integer :: direction

      right = state
      status = 0
      if (.not. state%contact%is_touching) return
      if (abs(error) <= 4.0_wp*spacing(state%contact%sliding_speed)) return
      sliding_speed = state%contact%sliding_speed - merge(-error, error, cycle%has_surface_speed)
      if (allocated(cycle%phases)) then
         ! What the roller does at rest, the forces alone decide; where it slides, it does not turn back
         direction = direction_at(cycle%phases, angle)
         if (direction == 0) return
         sliding_speed = direction*max(direction*sliding_speed, 0.0_wp)
         call evaluate_spin(model, state%position, state%moments, sliding_speed, right%contact, right%spin_acceleration, status, &
            & contact_accuracy_for(cycle%tolerance), real(direction, wp), state%contact, joints)
      else
         call evaluate_spin(model, state%position, state%moments, sliding_speed, right%contact, right%spin_acceleration, status, &
            & contact_accuracy_for(cycle%tolerance), start=state%contact, joints=joints)
      end if
      if (status == 0) call add_torques(model, right, joints)
   end subroutine state_without

end module camroller_slip_errors
