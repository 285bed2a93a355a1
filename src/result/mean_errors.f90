!> Errors of means that come of the error of the sliding speed.
!>
!> In: points of a cycle with their states and the error of the sliding speed there, as `error_estimate` finds it.
!> Out: for everything that is sampled, the error of its integral over the cycle.
!>
!> At each point the state is evaluated again with the sliding speed less its error, so that whatever follows the slip, however
!> steeply, has its share: a film, a force that saturates, asperities that begin to touch. Within an interval of the solution the
!> differences add up with their signs, since a method's defect has a mean next to nothing there: where the roller's inertia counts
!> for little the force is off by the defect itself. Between intervals nothing is known of signs, and sizes add up.
module camroller_mean_errors
   use camroller_kinds, only : wp
   use camroller_contact_forces, only : contact_t
   use camroller_error_estimate, only : estimate_t, error_at_start, margin
   use camroller_follower_samples, only : follower_samples_t, sampled_values
   use camroller_state, only : state_t, evaluate_spin, add_torques
   use camroller_stick_slip, only : direction_at
   implicit none
   private

   public :: slip_points_t, start_points, keep_point, set_errors, find_mean_errors

   !> Part of what cancels within an interval that is not trusted to cancel [-]: the error of the estimate at a point, of first order
   real(wp), parameter :: distrust = 0.02_wp

   !> Points of a cycle, as many to an interval as its rule has
   type :: slip_points_t
      !> Number of points so far, number in each interval
      integer :: count = 0, stride = 0
      !> Cam angle [rad], length that a point stands for [rad]
      real(wp), allocatable :: angle(:), weight(:)
      !> States, and what was sampled there [unit of each]
      type(state_t), allocatable :: states(:)
      real(wp), allocatable :: values(:, :)
      !> Error of the trajectory [m/s]; part of an error at its start that is left [-]
      real(wp), allocatable :: errors(:), shares(:)
   end type slip_points_t

contains

   !> Begin without points.
   pure subroutine start_points(points, quantities, intervals, stride)
      !> The points
      type(slip_points_t), intent(out) :: points
      !> Number of quantities that are sampled, of intervals, of points in an interval
      integer, intent(in) :: quantities, intervals, stride

      points%stride = stride
      allocate (points%angle(intervals*stride), points%weight(intervals*stride), points%states(intervals*stride), &
         & points%values(quantities, intervals*stride), points%errors(intervals*stride), points%shares(intervals*stride))
   end subroutine start_points

   !> Keep the point that was sampled last.
   pure subroutine keep_point(points, samples, angle, weight, values)
      !> The points
      type(slip_points_t), intent(inout) :: points
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Cam angle from full lift, length that the point stands for [rad]
      real(wp), intent(in) :: angle, weight
      !> What was sampled there [unit of each]
      real(wp), intent(in) :: values(:)

      points%count = points%count + 1
      points%angle(points%count) = angle
      points%weight(points%count) = weight
      points%states(points%count) = samples%state
      points%values(:, points%count) = values
   end subroutine keep_point

   !> Take the errors at the points of the interval that has just ended.
   pure subroutine set_errors(points, estimate)
      !> The points
      type(slip_points_t), intent(inout) :: points
      !> The estimate at the end of the interval
      type(estimate_t), intent(in) :: estimate

      associate (first => points%count - points%stride + 1, last => points%count)
         points%errors(first:last) = estimate%errors(:points%stride)
         points%shares(first:last) = estimate%shares(:points%stride)
      end associate
   end subroutine set_errors

   !> Errors of the integrals of all that is sampled.
   pure subroutine find_mean_errors(points, samples, estimate, errors)
      !> The points
      type(slip_points_t), intent(in) :: points
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> The estimate at the end of the cycle
      type(estimate_t), intent(in) :: estimate
      !> The errors [unit of each times rad]
      real(wp), intent(out) :: errors(:)

      ! Differences that the error makes, sums over an interval with their signs and of sizes [unit of each times rad]
      real(wp) :: differences(size(errors)), signed(size(errors)), sizes(size(errors))
      ! Error at the start of the periodic cycle [m/s]
      real(wp) :: first
      integer :: i

      associate (path => samples%cycle%trajectory)
         first = error_at_start(estimate, path%state(1, path%count) - path%state(1, 1))
      end associate
      errors = 0.0_wp
      do i = 1, points%count
         if (modulo(i - 1, points%stride) == 0) then
            signed = 0.0_wp
            sizes = 0.0_wp
         end if
         call evaluate_difference(points, samples, i, points%errors(i) + first*points%shares(i), differences)
         signed = signed + points%weight(i)*differences
         sizes = sizes + points%weight(i)*abs(differences)
         if (modulo(i, points%stride) == 0) errors = errors + margin*max(abs(signed), distrust*sizes)
      end do
   end subroutine find_mean_errors

   !> What is sampled at a point less what would be without the error of the sliding speed.
   pure subroutine evaluate_difference(points, samples, place, error, differences)
      !> The points
      type(slip_points_t), intent(in) :: points
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Which of the points
      integer, intent(in) :: place
      !> Error of the trajectory there [m/s]
      real(wp), intent(in) :: error
      !> The differences [unit of each]
      real(wp), intent(out) :: differences(:)

      type(state_t) :: right
      ! Sliding speed without the error [m/s]; values with it [unit of each]
      real(wp) :: sliding_speed, values(size(differences))
      integer :: direction, status

      differences = 0.0_wp
      associate (state => points%states(place))
         if (.not. state%contact%is_touching) return
         if (abs(error) <= 4.0_wp*spacing(state%contact%sliding_speed)) return
         sliding_speed = state%contact%sliding_speed - merge(-error, error, samples%cycle%has_surface_speed)
         right%position = state%position
         right%moments = state%moments
         right%gas_force = state%gas_force
         if (allocated(samples%cycle%phases)) then
            ! What the roller does at rest, the forces alone decide; where it slides, it does not turn back
            direction = direction_at(samples%cycle%phases, points%angle(place))
            if (direction == 0) return
            sliding_speed = direction*max(direction*sliding_speed, 0.0_wp)
            call evaluate_spin(samples%model, right%position, right%moments, sliding_speed, right%contact, &
               & right%spin_acceleration, status, mobilised=real(direction, wp))
         else
            call evaluate_spin(samples%model, right%position, right%moments, sliding_speed, right%contact, &
               & right%spin_acceleration, status)
         end if
      end associate
      if (status == 0) then
         call add_torques(samples%model, right)
         call sampled_values(samples, right, values)
         differences = points%values(:, place) - values
      else
         ! So far off that there is no state: nothing is known there
         differences = points%values(:, place)
      end if
   end subroutine evaluate_difference

end module camroller_mean_errors
