!> Quasi-static limit of the roller's spin: at every angle the roller is in its quasi-static balance.
!>
!> In: model, stops. Out: a trajectory that is linear between its points, placed so that the error of the interpolation is within
!> a tolerance. The cheapest model of the spin: accurate where the spin decays fast compared with the change of the kinematics
!> (hot oil, the event), inaccurate where it does not (cold oil on the base circle). It needs no initial value and is periodic by
!> construction.
module camroller_quasi_static
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_balance, only : follow_balance
   use camroller_ode, only : counters_t
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_cubic, least_segment, stop_margin
   implicit none
   private

   public :: quasi_static_cycle

   !> Longest interval between points [rad]
   real(wp), parameter :: longest_interval = 2.0_wp*degree
   !> Halvings of an interval before it is taken as it is
   integer, parameter :: max_depth = 14
   !> Accuracy of a balance over the error allowed between points [-]
   real(wp), parameter :: balance_part = 0.1_wp

contains

   !> Sliding speed of the quasi-static balance over a cycle.
   subroutine quasi_static_cycle(model, stops, tolerance, trajectory, counters, error)
      !> The model
      type(model_t), intent(in) :: model
      !> First angle, stops between, last angle [rad]
      real(wp), intent(in) :: stops(:)
      !> Error allowed between points [m/s]
      real(wp), intent(in) :: tolerance
      !> The balance
      type(trajectory_t), intent(inout) :: trajectory
      !> Points kept count as steps, balances as evaluations
      type(counters_t), intent(inout) :: counters
      !> Convergence error that names the angle where there is no balance
      type(error_t), allocatable, intent(out) :: error

      ! A few roundings; ends of an interval, length of one [rad]
      real(wp) :: margin, left, right, length
      ! Balance at the ends [m/s]
      real(wp) :: left_value, right_value
      integer :: segment, interval, intervals

      margin = stop_margin(stops)
      trajectory%is_linear = .true.
      call start_trajectory(trajectory, 1)
      do segment = 1, size(stops) - 1
         left = stops(segment) + margin
         length = stops(segment + 1) - margin - left
         if (length <= least_segment*margin) cycle
         intervals = ceiling(length/longest_interval)
         length = length/intervals
         call balance_at(model, left, tolerance, 0.0_wp, left_value, counters, error)
         if (allocated(error)) return
         call append_cubic(trajectory, left, [left_value], [0.0_wp])
         do interval = 1, intervals
            right = left + length
            call balance_at(model, right, tolerance, left_value, right_value, counters, error)
            if (allocated(error)) return
            call refine(model, [left, right], [left_value, right_value], tolerance, 0, trajectory, counters, error)
            if (allocated(error)) return
            left = right
            left_value = right_value
         end do
      end do
   end subroutine quasi_static_cycle

   !> Append the points of an interval, its left end left out: the right end, and more where the balance bends.
   recursive subroutine refine(model, ends, values, tolerance, depth, trajectory, counters, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Ends of the interval [rad]
      real(wp), intent(in) :: ends(2)
      !> Balance there [m/s]
      real(wp), intent(in) :: values(2)
      !> Error allowed between points [m/s]
      real(wp), intent(in) :: tolerance
      !> Halvings so far
      integer, intent(in) :: depth
      !> The balance so far
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Middle [rad] and balance there [m/s]
      real(wp) :: middle, value

      middle = 0.5_wp*sum(ends)
      call balance_at(model, middle, tolerance, 0.5_wp*sum(values), value, counters, error)
      if (allocated(error)) return
      if (abs(value - 0.5_wp*sum(values)) <= tolerance .or. depth >= max_depth) then
         call append_cubic(trajectory, middle, [value], [0.0_wp])
         call append_cubic(trajectory, ends(2), values(2:), [0.0_wp])
         counters%accepted = counters%accepted + 2
         return
      end if
      call refine(model, [ends(1), middle], [values(1), value], tolerance, depth + 1, trajectory, counters, error)
      if (allocated(error)) return
      call refine(model, [middle, ends(2)], [value, values(2)], tolerance, depth + 1, trajectory, counters, error)
   end subroutine refine

   !> Balance at an angle; an error where there is none.
   subroutine balance_at(model, angle, tolerance, guess, sliding_speed, counters, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Error allowed between points [m/s]
      real(wp), intent(in) :: tolerance
      !> Sliding speed nearby [m/s]
      real(wp), intent(in) :: guess
      !> Sliding speed [m/s]
      real(wp), intent(out) :: sliding_speed
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Decay rate [1/rad]
      real(wp) :: decay_rate
      logical :: is_found

      sliding_speed = guess
      call follow_balance(model, angle, balance_part*tolerance, position, sliding_speed, decay_rate, counters%evaluations, &
         & is_found)
      if (is_found) return
      call raise(error, kind_convergence, "quasi-static limit: the roller has no quasi-static balance at "// &
         & cam_angle_text(angle, 3)//": no contact there, or traction cannot follow the kinematics; choose another method")
   end subroutine balance_at

end module camroller_quasi_static
