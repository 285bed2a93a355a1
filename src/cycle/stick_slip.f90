!> The roller's spin with set-valued boundary friction: phases of sliding forwards, sliding backwards and sticking.
!>
!> In: spin problem, method, stops, sliding speed at the start. Out: trajectory, and the phases it consists of.
!>
!> Within a phase of sliding the sign of the friction is fixed, so the equation is as smooth as without friction. It is
!> integrated with this sign, and the solution is cut off at the first angle at which the sliding speed passes through zero.
!> There, the roller sticks if friction can hold it; otherwise it slides in the direction of the acceleration. A roller that
!> sticks does so until the required friction exceeds the available one, which is found by a scan between the stops and a root
!> search; then it slides in the direction of the acceleration. A phase of sliding thus starts with an acceleration of its own
!> sign, and phases cannot alternate at one cam angle. Source of the law: Filippov, Differential Equations with Discontinuous
!> Righthand Sides (1988).
module camroller_stick_slip
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_spin, only : spin_problem_t
   use camroller_stick, only : rates_at_rest, breakaway, rest_speed, touching_capacity
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_cubic, append_until, interpolate_state, &
      & least_segment, stop_margin
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   implicit none
   private

   public :: phase_t, integrate_phases, direction_at

   !> A phase, up to the start of the next
   type :: phase_t
      !> Cam angle from full lift where it starts [rad]
      real(wp) :: start
      !> Direction of sliding: 1 where V_s is positive, -1 where it is negative, 0 where the roller sticks
      integer :: direction
   end type phase_t

   !> Where an integration has got to
   type :: walk_t
      !> Cam angle, the end, a few roundings of it [rad]
      real(wp) :: angle, finish, margin
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed
      !> Angle that is integrated at once, next first step [rad]
      real(wp) :: stretch, step
      !> Sliding speed that counts as none [m/s]; rate that does not break the roller away [m/s/rad]
      real(wp) :: rest_speed, rest_rate
   end type walk_t

   !> Angle integrated after a phase has ended; doubled where none ends [rad]
   real(wp), parameter :: short_stretch = 20.0_wp*degree
   !> Longest and shortest step of the scan for the end of sticking [rad]
   real(wp), parameter :: longest_scan = 1.0_wp*degree, shortest_scan = 1.0e-3_wp*degree
   !> Distance of a rate in the middle of such a step from a straight line, over its size [-]: what happens between them is seen
   real(wp), parameter :: largest_bend = 1.0e-3_wp
   !> Places at which the curve between two points is evaluated
   integer, parameter :: places = 4
   !> Phases allowed in one integration: more than one a degree
   integer, parameter :: max_phases = 500

contains

   !> Integrate from the first to the last of the stops.
   subroutine integrate_phases(problem, method, options, stops, state, trajectory, phases, counters, error)
      !> The problem; the mobilised part of its friction is set here
      type(spin_problem_t), intent(inout) :: problem
      !> The method, with an error estimate
      class(method_t), intent(inout) :: method
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> Start, cam angles at which the right-hand side has kinks, end; increasing [rad]
      real(wp), intent(in) :: stops(:)
      !> Sliding speed, from start to end [m/s]
      real(wp), intent(inout) :: state(1)
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> The phases
      type(phase_t), allocatable, intent(out) :: phases(:)
      !> Work done, added to what they hold
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(walk_t) :: walk
      integer :: direction

      walk = start_walk(options, stops, state(1))
      call start_trajectory(trajectory, size(state))
      allocate (phases(0))
      do while (walk%finish - walk%angle > least_segment*walk%margin)
         call choose_direction(problem, walk, direction, counters, error)
         if (allocated(error)) return
         call enter_phase(phases, walk%angle, direction)
         if (direction == 0) then
            call stick(problem, stops, walk, direction, trajectory, counters, error)
            if (allocated(error)) return
            if (direction == 0) exit
            call enter_phase(phases, walk%angle, direction)
         end if
         call slide(problem, method, options, stops, direction, walk, trajectory, counters, error)
         if (allocated(error)) return
         if (size(phases) > max_phases) then
            call raise(error, kind_convergence, "the roller changes between sticking and sliding too often up to "// &
               & trim(problem%name_time(walk%angle)))
            return
         end if
      end do
      state = walk%sliding_speed
   end subroutine integrate_phases

   !> Begin at the first of the stops.
   pure function start_walk(options, stops, sliding_speed) result(walk)
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> Stops [rad]
      real(wp), intent(in) :: stops(:)
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> The beginning
      type(walk_t) :: walk

      walk%angle = stops(1)
      walk%finish = stops(size(stops))
      walk%margin = stop_margin(stops)
      walk%sliding_speed = sliding_speed
      walk%stretch = walk%finish - walk%angle
      walk%step = options%step
      walk%rest_speed = rest_speed(options%tolerance(1))
      ! The error of a step in a radian
      walk%rest_rate = options%tolerance(1)
   end function start_walk

   !> Direction of the next phase.
   subroutine choose_direction(problem, walk, direction, counters, error)
      type(spin_problem_t), intent(in) :: problem
      !> Where the integration has got to; a sliding speed that counts as none becomes zero, unless the roller goes on that way
      type(walk_t), intent(inout) :: walk
      !> 1, -1, or 0 where the roller sticks
      integer, intent(out) :: direction
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Rates at rest [m/s/rad]
      real(wp) :: rates(2)

      if (abs(walk%sliding_speed) > walk%rest_speed) then
         direction = nint(sign(1.0_wp, walk%sliding_speed))
         return
      end if
      direction = 0
      call counted_rates(problem, walk%angle + walk%margin, rates, counters, error)
      if (.not. allocated(error)) direction = breakaway(rates, walk%rest_rate)
      ! A slide that goes on keeps its speed: on nearly solid oil traction depends on how slow it is
      if (direction*walk%sliding_speed <= 0.0_wp) walk%sliding_speed = 0.0_wp
   end subroutine choose_direction

   !> Note a phase, unless it goes on.
   subroutine enter_phase(phases, angle, direction)
      !> Phases so far
      type(phase_t), allocatable, intent(inout) :: phases(:)
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> Direction of sliding
      integer, intent(in) :: direction

      if (size(phases) > 0) then
         if (phases(size(phases))%direction == direction) return
      end if
      phases = [phases, phase_t(angle, direction)]
   end subroutine enter_phase

   !> Slide in one direction, up to where the sliding speed passes through zero or for a stretch.
   subroutine slide(problem, method, options, stops, direction, walk, trajectory, counters, error)
      type(spin_problem_t), intent(inout) :: problem
      class(method_t), intent(inout) :: method
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> Stops [rad]
      real(wp), intent(in) :: stops(:)
      !> Direction, 1 or -1
      integer, intent(in) :: direction
      !> Where the integration has got to
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(trajectory_t) :: piece
      type(options_t) :: piece_options
      ! End of the stretch [rad], sliding speed there [m/s]
      real(wp) :: reach, state(1)
      logical :: has_turned

      reach = walk%finish
      if (walk%angle + walk%stretch < reach - least_segment*walk%margin) reach = walk%angle + walk%stretch
      state = walk%sliding_speed
      piece_options = options
      piece_options%step = walk%step
      problem%mobilised = real(direction, wp)
      call integrate(problem, method, piece_options, [walk%angle, pack(stops, stops > walk%angle .and. stops < reach), reach], &
         & state, piece, counters, error)
      call find_turn(problem%model, direction, piece, has_turned, walk, counters)
      if (has_turned) then
         if (allocated(error)) deallocate (error)
         call append_until(trajectory, piece, walk%angle)
         walk%stretch = short_stretch
         walk%step = options%step
      else if (.not. allocated(error)) then
         call append_until(trajectory, piece, reach)
         walk%angle = reach
         walk%sliding_speed = state(1)
         walk%stretch = 2.0_wp*walk%stretch
         associate (times => piece%time(:piece%count))
            walk%step = max(walk%step, times(size(times)) - times(size(times) - 1))
         end associate
      end if
   end subroutine slide

   !> First angle at which a curve of fixed friction leaves its direction of sliding.
   !>
   !> Without touching asperities there is no friction whose sign could be wrong, and the curve holds beyond; it is then left
   !> before asperities touch. A step from rest that leaves its direction at once is a slide too short to be seen: rest at its end.
   subroutine find_turn(model, direction, piece, has_turned, walk, counters)
      type(model_t), intent(in) :: model
      !> Direction of sliding, 1 or -1
      integer, intent(in) :: direction
      !> The curve
      type(trajectory_t), intent(in) :: piece
      !> Is there one?
      logical, intent(out) :: has_turned
      !> Where the integration has got to; out: there
      type(walk_t), intent(inout) :: walk
      !> Work done
      type(counters_t), intent(inout) :: counters

      ! Angle and the one before [rad], sliding speeds there [m/s]
      real(wp) :: angle, angle_before, speed(1), speed_before
      integer :: point, place, first_place, hint

      has_turned = .false.
      if (piece%count < 2) return
      angle_before = piece%time(1)
      speed_before = piece%state(1, 1)
      do point = 2, piece%count
         first_place = 1
         if (point == 2 .and. .not. abs(speed_before) > 0.0_wp) first_place = places
         do place = first_place, places
            hint = point - 1
            angle = piece%time(hint) + (piece%time(point) - piece%time(hint))*place/places
            call interpolate_state(piece, angle, hint, speed)
            if (direction*speed(1) < 0.0_wp) then
               counters%evaluations = counters%evaluations + 1
               has_turned = touching_capacity(model, angle, speed(1)) > 0.0_wp
            end if
            if (has_turned) then
               walk%angle = angle_before
               walk%sliding_speed = speed_before
               if (first_place == places) walk%angle = angle
               if (direction*speed_before > 0.0_wp) walk%angle = zero_between(piece, angle_before, angle, speed_before, speed(1))
               if (direction*speed_before >= 0.0_wp) walk%sliding_speed = 0.0_wp
               return
            end if
            angle_before = angle
            speed_before = speed(1)
         end do
      end do
   end subroutine find_turn

   !> Angle at which the sliding speed of a curve passes through zero.
   function zero_between(piece, left, right, speed_left, speed_right) result(angle)
      !> The curve
      type(trajectory_t), intent(in) :: piece
      !> Angles before and after [rad]
      real(wp), intent(in) :: left, right
      !> Sliding speeds there [m/s]
      real(wp), intent(in) :: speed_left, speed_right
      !> The angle [rad]
      real(wp) :: angle

      type(bracket_t) :: bracket
      ! Sliding speed [m/s]
      real(wp) :: speed(1)
      integer :: hint

      hint = 1
      call start_bracket(bracket, left, right, speed_left, speed_right, 0.0_wp)
      do while (bracket%status == root_wanted)
         call interpolate_state(piece, bracket%trial, hint, speed)
         call narrow_bracket(bracket, speed(1))
      end do
      angle = bracket%trial
   end function zero_between

   !> Stick up to where friction no longer holds the roller, or to the end.
   subroutine stick(problem, stops, walk, direction, trajectory, counters, error)
      type(spin_problem_t), intent(in) :: problem
      !> Stops [rad]
      real(wp), intent(in) :: stops(:)
      !> Where the integration has got to
      type(walk_t), intent(inout) :: walk
      !> Direction in which the roller breaks away, 0 where it sticks to the end
      integer, intent(out) :: direction
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Start, middle and end of a step [rad]; rates at rest there [m/s/rad]
      real(wp) :: angles(3), rates(2, 3)
      ! End of the segment, next step [rad]
      real(wp) :: segment_end, step
      integer :: last

      walk%stretch = short_stretch
      step = longest_scan
      direction = 0
      do while (walk%finish - walk%angle > least_segment*walk%margin)
         segment_end = minval(stops, mask=stops > walk%angle + least_segment*walk%margin)
         angles(3) = walk%angle + walk%margin
         call counted_rates(problem, angles(3), rates(:, 3), counters, error)
         if (.not. allocated(error)) direction = breakaway(rates(:, 3), walk%rest_rate)
         do while (direction == 0 .and. angles(3) < segment_end - walk%margin .and. .not. allocated(error))
            call append_cubic(trajectory, angles(3), [0.0_wp], [0.0_wp])
            angles(1) = angles(3)
            rates(:, 1) = rates(:, 3)
            call scan_step(problem, segment_end - walk%margin, walk%rest_rate, angles, rates, step, counters, error)
            if (allocated(error)) exit
            do last = 2, 3
               direction = breakaway(rates(:, last), walk%rest_rate)
               if (direction /= 0) exit
            end do
            if (direction /= 0) angles(3) = breakaway_between(problem, direction, walk%rest_rate, angles(last - 1:last), &
               & rates(:, last - 1:last), counters)
         end do
         if (allocated(error)) return
         call append_cubic(trajectory, angles(3), [0.0_wp], [0.0_wp])
         walk%angle = merge(segment_end, angles(3), direction == 0)
         if (direction /= 0) return
      end do
   end subroutine stick

   !> One step of the scan, short enough for the rates to be all but straight lines.
   subroutine scan_step(problem, finish, least_rate, angles, rates, step, counters, error)
      type(spin_problem_t), intent(in) :: problem
      !> Angle that is not to be passed [rad]
      real(wp), intent(in) :: finish
      !> Rate that counts as none [m/s/rad]
      real(wp), intent(in) :: least_rate
      !> Start of the step, given, middle and end [rad]
      real(wp), intent(inout) :: angles(3)
      !> Rates at rest there [m/s/rad]
      real(wp), intent(inout) :: rates(2, 3)
      !> Step to try; out: step to try next [rad]
      real(wp), intent(inout) :: step
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Distance of the middle from the straight line over the size of the rates [-]
      real(wp) :: bend
      integer :: i

      do
         angles(3) = min(angles(1) + step, finish)
         if (finish - angles(3) < 0.5_wp*step) angles(3) = finish
         angles(2) = 0.5_wp*(angles(1) + angles(3))
         do i = 2, 3
            call counted_rates(problem, angles(i), rates(:, i), counters, error)
            if (allocated(error)) return
         end do
         bend = maxval(abs(rates(:, 2) - 0.5_wp*(rates(:, 1) + rates(:, 3))))/(maxval(abs(rates)) + least_rate)
         if (bend <= largest_bend .or. step <= shortest_scan) exit
         step = 0.5_wp*step
      end do
      if (bend <= 0.25_wp*largest_bend) step = min(2.0_wp*step, longest_scan)
   end subroutine scan_step

   !> Angle at which friction no longer holds the roller.
   function breakaway_between(problem, direction, threshold, ends, rates_at_ends, counters) result(angle)
      type(spin_problem_t), intent(in) :: problem
      !> Direction in which it breaks away
      integer, intent(in) :: direction
      !> Rate up to which friction holds [m/s/rad]
      real(wp), intent(in) :: threshold
      !> Angles before and after [rad]
      real(wp), intent(in) :: ends(2)
      !> Rates at rest there [m/s/rad]
      real(wp), intent(in) :: rates_at_ends(2, 2)
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> The angle [rad]
      real(wp) :: angle

      type(bracket_t) :: bracket
      ! Rates at rest [m/s/rad]
      real(wp) :: rates(2)
      integer :: which, status

      which = merge(1, 2, direction > 0)
      call start_bracket(bracket, ends(1), ends(2), direction*rates_at_ends(which, 1) - threshold, &
         & direction*rates_at_ends(which, 2) - threshold, 0.0_wp)
      do while (bracket%status == root_wanted)
         call follow_ramp(problem%model, bracket%trial)
         call rates_at_rest(problem%model, bracket%trial, rates, status)
         counters%evaluations = counters%evaluations + size(rates)
         call narrow_bracket(bracket, direction*rates(which) - threshold)
      end do
      angle = bracket%trial
   end function breakaway_between

   !> Rates at rest, counted as evaluations.
   subroutine counted_rates(problem, angle, rates, counters, error)
      type(spin_problem_t), intent(in) :: problem
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Rates at rest [m/s/rad]
      real(wp), intent(out) :: rates(2)
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      call follow_ramp(problem%model, angle)
      call rates_at_rest(problem%model, angle, rates, status)
      counters%evaluations = counters%evaluations + size(rates)
      if (status /= 0) call raise(error, kind_convergence, "the right-hand side cannot be evaluated at "// &
         & trim(problem%name_time(angle)))
   end subroutine counted_rates

   !> Direction of sliding at a cam angle.
   pure function direction_at(phases, angle) result(direction)
      !> The phases, in order
      type(phase_t), intent(in) :: phases(:)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> 1, -1, or 0 where the roller sticks
      integer :: direction

      direction = phases(max(1, count(phases%start <= angle)))%direction
   end function direction_at

end module camroller_stick_slip
