!> One walk round a cycle: states at the points from which means, errors, extremes and the curve for the camshaft are made.
!>
!> In: what is sampled of a cycle. Out: `walk_t`. Each interval between accepted points is a panel of `panels`; a solution that is
!> only linear between its points gets the trapezoidal rule.
module camroller_cycle_walk
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_cycle, only : cycle_t
   use camroller_defects, only : defect_at, find_defect
   use camroller_error_estimate, only : add_defect, end_interval, estimate_t
   use camroller_follower_samples, only : add_shares, entrainment_of, entrainment_t, follower_samples_t, shares_t
   use camroller_lobe_curve, only : add_piece, close_curve, keep_state, lobe_curve_t, start_curve
   use camroller_panels, only : add_panel, add_trapezoid, gauss_points, gauss_weights, panel_places, panel_points, panel_weights, &
      & panels_t, start_panels
   use camroller_slip_errors, only : keep_point, set_errors, slip_points_t, start_points
   use camroller_stored_work, only : follow_contact, stored_work_t
   use camroller_torque_list, only : torque_count
   use camroller_trajectory, only : curve_slope
   implicit none
   private

   public :: walk_t, walk_round

   !> What a walk brings home
   type :: walk_t
      type(panels_t) :: panels
      !> Error of the sliding speed, and the points with it
      type(estimate_t) :: estimate
      type(slip_points_t) :: slips
      !> Work of what is stored
      type(stored_work_t) :: work
      !> Number of points, and their entrainment in order
      integer :: count = 0
      type(entrainment_t), allocatable :: speeds(:)
      !> Shares of the cycle without contact and outside the film law's range
      type(shares_t) :: shares
      !> What the camshaft takes from the follower
      type(lobe_curve_t) :: curve
      !> Cam angle from full lift at the end of the interval where the error is largest [rad]
      real(wp) :: error_angle = 0.0_wp
   end type walk_t

   !> Places of the trapezoidal rule on [0, 1] [-]
   real(wp), parameter, public :: trapezoid(2) = [0.0_wp, 1.0_wp]

contains

   !> Walk round a cycle.
   subroutine walk_round(samples, walk, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> What it brings
      type(walk_t), intent(out) :: walk
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: interval

      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         call start_panels(walk%panels, samples%series + torque_count, 2*size(times))
         call start_points(walk%slips, samples%series + torque_count, size(times) - 1, &
            & merge(size(trapezoid), size(gauss_points), samples%cycle%is_linear))
         allocate (walk%speeds(panel_points*size(times)))
         if (.not. samples%cycle%is_linear) call start_curve(walk%curve, times(1), size(times) - 1)
         do interval = 1, size(times) - 1
            if (times(interval + 1) > times(interval)) call sample_interval(samples, interval, walk, error)
            if (allocated(error)) return
         end do
      end associate
      if (.not. samples%cycle%is_linear) call close_curve(walk%curve, samples%cycle%tolerance)
   end subroutine walk_round

   !> Sample an interval.
   subroutine sample_interval(samples, interval, walk, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> The interval
      integer, intent(in) :: interval
      !> What the walk brings
      type(walk_t), intent(inout) :: walk
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Values at the points [unit of each]; ends of the interval, part of the turn that it takes, angle [rad]
      real(wp) :: values(samples%series + torque_count, panel_points), left, right, share, angle
      ! Places in the interval, weights there [-]
      real(wp) :: places(panel_points), weights(panel_points)
      integer :: point, points

      associate (path => samples%cycle%trajectory)
         left = path%time(interval)
         right = path%time(interval + 1)
         share = (right - left)/(path%time(path%count) - path%time(1))
      end associate
      points = panel_points
      places = panel_places
      weights = panel_weights
      if (samples%cycle%is_linear) then
         points = size(trapezoid)
         places(:points) = trapezoid
         weights(:points) = 0.5_wp
      end if
      do point = 1, points
         angle = left + places(point)*(right - left)
         call samples%sample(angle, values(:, point), error)
         if (.not. allocated(error)) call follow_contact(walk%work, samples, angle, left, error)
         if (allocated(error)) return
         walk%count = walk%count + 1
         walk%speeds(walk%count) = entrainment_of(samples, angle)
         call add_shares(walk%shares, samples%model, samples%state, angle, &
            & samples%state%position%lift > samples%model%train%seat_lift, weights(point)*share)
         if (.not. samples%cycle%is_linear) call keep_state(walk%curve, samples%model, samples%state, point)
         call judge_point(samples, angle, interval, places(point), point, values(:, point), walk)
      end do
      call close_interval(samples%cycle, interval, walk)
      call set_errors(walk%slips, walk%estimate)
      if (samples%cycle%is_linear) then
         call add_trapezoid(walk%panels, left, right, values(:, :2))
      else
         call add_panel(walk%panels, left, right, values)
         call add_piece(walk%curve, right)
      end if
   end subroutine sample_interval

   !> Take a point for the estimate of the error; its decay rate at the points of the rule of three.
   subroutine judge_point(samples, angle, interval, place, point, values, walk)
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The interval that holds it
      integer, intent(in) :: interval
      !> Place in the interval [-]
      real(wp), intent(in) :: place
      !> Number of the point
      integer, intent(in) :: point
      !> What was sampled there [unit of each]
      real(wp), intent(in) :: values(:)
      !> What the walk brings
      type(walk_t), intent(inout) :: walk

      ! Defect [m/s/rad], decay rate [1/rad]; length of the interval [rad], weight of the point [-]
      real(wp) :: defect, decay_rate, length, weight

      if (.not. (samples%cycle%is_linear .or. any(gauss_points == point))) then
         call add_defect(walk%estimate, place, defect_at(samples%model, samples%cycle, angle, interval, samples%state))
         return
      end if
      call find_defect(samples%model, samples%cycle, angle, interval, samples%state, walk%estimate%error, defect, decay_rate)
      call add_defect(walk%estimate, place, defect, decay_rate)
      length = samples%cycle%trajectory%time(interval + 1) - samples%cycle%trajectory%time(interval)
      weight = 0.5_wp
      if (.not. samples%cycle%is_linear) weight = gauss_weights(walk%estimate%rated)
      call keep_point(walk%slips, samples, angle, weight*length, values)
   end subroutine judge_point

   !> Carry the estimate of the error over an interval, with the defects at its ends where the rates of the equation are kept there.
   pure subroutine close_interval(cycle, interval, walk)
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Interval of its trajectory
      integer, intent(in) :: interval
      !> The walk
      type(walk_t), intent(inout) :: walk

      ! Slope at an end [m/s/rad], defects at both [m/s/rad], largest error so far [m/s]
      real(wp) :: slope(1), ends(2), largest
      integer :: i

      largest = walk%estimate%largest
      associate (trajectory => cycle%trajectory, &
         & length => cycle%trajectory%time(interval + 1) - cycle%trajectory%time(interval))
         if (cycle%is_linear .or. allocated(cycle%phases)) then
            call end_interval(walk%estimate, length)
         else
            do i = 0, 1
               call curve_slope(trajectory, trajectory%time(interval + i), interval, slope)
               ends(i + 1) = slope(1) - trajectory%rate(1, interval + i)
            end do
            call end_interval(walk%estimate, length, ends)
         end if
         if (walk%estimate%largest > largest) walk%error_angle = trajectory%time(interval + 1)
      end associate
   end subroutine close_interval

end module camroller_cycle_walk
