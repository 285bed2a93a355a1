!> One walk round a cycle: states at the points from which means, errors, extremes and the curve for the camshaft are made.
!>
!> In: what is sampled of a cycle. Out: `walk_t`. An interval between accepted points, or two of them, are a panel of
!> `panels`; a solution that is only linear between its points gets the trapezoidal rule.
module camroller_cycle_walk
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_cycle, only : cycle_t
   use camroller_defects, only : defect_at, find_defect
   use camroller_error_estimate, only : add_defect, end_interval, estimate_t
   use camroller_cycle_shares, only : add_shares, shares_t
   use camroller_follower_samples, only : entrainment_of, entrainment_t, follower_samples_t
   use camroller_lobe_curve, only : add_piece, close_curve, keep_state, lobe_curve_t, start_curve
   use camroller_panels, only : add_panel, add_trapezoid, gauss_points, gauss_weights, panel_places, panel_points, panel_weights, &
      & panels_t, start_panels
   use camroller_slip_errors, only : keep_point, set_errors, slip_points_t, start_points
   use camroller_stored_work, only : follow_contact, stored_work_t
   use camroller_torque_list, only : torque_count
   use camroller_spin, only : decay_rate_of
   use camroller_trajectory, only : curve_slope, trajectory_t
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

      integer :: first, last

      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         call start_panels(walk%panels, samples%series + torque_count, 2*size(times))
         call start_points(walk%slips, samples%series + torque_count, size(times))
         allocate (walk%speeds(panel_points*size(times)))
         if (.not. samples%cycle%is_linear) call start_curve(walk%curve, times(1), size(times) - 1, &
            & allocated(samples%case%cam_bearings))
         first = 1
         do while (first < size(times))
            last = first + merge(1, 0, are_joined(samples, first))
            if (times(last + 1) > times(first)) call sample_intervals(samples, first, last, walk, error)
            if (allocated(error)) return
            first = last + 1
         end do
      end associate
      if (.not. samples%cycle%is_linear) call close_curve(walk%curve, samples%cycle%tolerance)
   end subroutine walk_round

   !> May one panel cover an interval and the next? Where both have about the same length.
   !>
   !> The error of the sliding speed is then sampled once in each, near its middle. That is enough where the method's curve has the
   !> rates of the equation at its ends, as far as an error of a step goes: the defect is zero there and largest between. At a place
   !> between a quarter and three quarters a hump `x^2 (1 - x)^2` has its mean at least, and the polynomial through the seven points
   !> and both ends has the integral of two such humps to a twentieth. The defect of the quasi-static balance is its slope, which is
   !> smooth where its curve is: no end of an interval is distinguished.
   pure function are_joined(samples, first) result(verdict)
      !> The samples, up to the end of the interval before
      type(follower_samples_t), intent(in) :: samples
      !> First of both intervals
      integer, intent(in) :: first
      !> True where it may
      logical :: verdict

      ! Largest difference of a length from the mean of both, over that [-]: points of the rule are then where they have to be
      real(wp), parameter :: balance = 0.25_wp
      ! Length of the shorter interval [rad]; defects at the ends of an interval [m/s/rad]; decay rate before it [1/rad]
      real(wp) :: shorter, ends(2), decay_rate
      integer :: i

      verdict = .false.
      associate (path => samples%cycle%trajectory, contact => samples%state%contact)
         if (samples%cycle%is_linear .or. allocated(samples%cycle%phases) .or. .not. contact%is_touching) return
         if (first + 2 > path%count) return
         associate (lengths => path%time(first + 1:first + 2) - path%time(first:first + 1))
            shorter = minval(lengths)
            if (maxval(lengths) - shorter > balance*sum(lengths)) return
         end associate
         verdict = samples%cycle%is_quasi_static
         if (verdict) return
         decay_rate = decay_rate_of(samples%model, contact)
         do i = first, first + 1
            call end_defects(path, i, i, ends)
            if (maxval(abs(ends)) > max(1.0_wp/shorter, decay_rate)*samples%cycle%step_error) return
         end do
      end associate
      verdict = .true.
   end function are_joined

   !> Sample an interval or two as one panel.
   subroutine sample_intervals(samples, first, last, walk, error)
      type(follower_samples_t), intent(inout) :: samples
      !> First and last interval
      integer, intent(in) :: first, last
      !> What the walk brings
      type(walk_t), intent(inout) :: walk
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Values at the points [unit of each]; ends of the panel, part of the turn that it takes, angle [rad]
      real(wp) :: values(samples%series + torque_count, panel_points), left, right, share, angle
      ! Places in the panel, weights there [-]
      real(wp) :: places(panel_points), weights(panel_points)
      integer :: point, points, interval, rated

      associate (path => samples%cycle%trajectory)
         left = path%time(first)
         right = path%time(last + 1)
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
      interval = first
      do point = 1, points
         angle = left + places(point)*(right - left)
         do while (interval < last .and. angle > samples%cycle%trajectory%time(interval + 1))
            interval = interval + 1
         end do
         call samples%sample(angle, values(:, point), error)
         if (.not. allocated(error)) call follow_contact(walk%work, samples, angle, left, error)
         if (allocated(error)) return
         walk%count = walk%count + 1
         walk%speeds(walk%count) = entrainment_of(samples, angle)
         call add_shares(walk%shares, samples%model, samples%state, angle, &
            & samples%state%position%lift > samples%model%train%seat_lift, weights(point)*share)
         if (.not. samples%cycle%is_linear) call keep_state(walk%curve, samples%model, samples%state, point)
         call judge_point(samples, angle, interval, places(point), point, last > first, values(:, point), walk)
      end do
      rated = walk%estimate%rated
      call close_intervals(samples%cycle, first, last, walk)
      call set_errors(walk%slips, rated, walk%estimate, left, right)
      if (samples%cycle%is_linear) then
         call add_trapezoid(walk%panels, left, right, values(:, :2))
      else
         call add_panel(walk%panels, left, right, values)
         call add_piece(walk%curve, right)
      end if
   end subroutine sample_intervals

   !> Take a point for the estimate of the error: its defect, and its decay rate at the points of the rule of three, or near the
   !> middle of each interval where the panel has two.
   subroutine judge_point(samples, angle, interval, place, point, is_joined, values, walk)
      type(follower_samples_t), intent(in) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The interval that holds it
      integer, intent(in) :: interval
      !> Place in the panel [-]
      real(wp), intent(in) :: place
      !> Number of the point
      integer, intent(in) :: point
      !> Has the panel two intervals?
      logical, intent(in) :: is_joined
      !> What was sampled there [unit of each]
      real(wp), intent(in) :: values(:)
      !> What the walk brings
      type(walk_t), intent(inout) :: walk

      ! Points of a panel of two intervals that are near the middle of one
      integer, parameter :: middles(2) = [3, 5]
      ! Defect [m/s/rad], decay rate [1/rad]; weight of the point [-]
      real(wp) :: defect, decay_rate, weight
      logical :: is_rated

      is_rated = any(gauss_points == point)
      if (is_joined) is_rated = any(middles == point)
      if (.not. (samples%cycle%is_linear .or. is_rated)) then
         call add_defect(walk%estimate, place, defect_at(samples%model, samples%cycle, angle, interval, samples%state))
         return
      end if
      call find_defect(samples%model, samples%cycle, angle, interval, samples%state, walk%estimate%error, defect, decay_rate)
      call add_defect(walk%estimate, place, defect, decay_rate)
      weight = 1.0_wp
      if (samples%cycle%is_linear) then
         weight = 0.5_wp
      else if (.not. is_joined) then
         weight = gauss_weights(walk%estimate%rated)
      end if
      associate (times => samples%cycle%trajectory%time)
         call keep_point(walk%slips, samples, interval, angle, weight*(times(interval + 1) - times(interval)), values)
      end associate
   end subroutine judge_point

   !> Carry the estimate of the error over a panel, with the defects at its ends where the rates of the equation are kept there.
   pure subroutine close_intervals(cycle, first, last, walk)
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> First and last interval of the panel
      integer, intent(in) :: first, last
      type(walk_t), intent(inout) :: walk

      ! Defects at both ends [m/s/rad], largest error so far [m/s]
      real(wp) :: ends(2), largest

      largest = walk%estimate%largest
      associate (trajectory => cycle%trajectory, length => cycle%trajectory%time(last + 1) - cycle%trajectory%time(first))
         if (cycle%is_linear .or. allocated(cycle%phases)) then
            call end_interval(walk%estimate, length)
         else
            call end_defects(trajectory, first, last, ends)
            call end_interval(walk%estimate, length, ends)
         end if
         if (walk%estimate%largest > largest) walk%error_angle = trajectory%time(last + 1)
      end associate
   end subroutine close_intervals

   !> Defects at the start of an interval and at the end of another: slopes of the curve less the rates of the equation there.
   pure subroutine end_defects(path, first, last, ends)
      type(trajectory_t), intent(in) :: path
      !> The intervals
      integer, intent(in) :: first, last
      !> The defects [m/s/rad]
      real(wp), intent(out) :: ends(2)

      real(wp) :: slope(1) ! [m/s/rad]

      call curve_slope(path, path%time(first), first, slope)
      ends(1) = slope(1) - path%rate(1, first)
      call curve_slope(path, path%time(last + 1), last, slope)
      ends(2) = slope(1) - path%rate(1, last + 1)
   end subroutine end_defects

end module camroller_cycle_walk
