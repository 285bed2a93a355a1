!> Cam angles at which the right-hand side of the roller equation has a kink or a jump, and the angles without contact.
!>
!> In: model. Out: stop angles for the integration, intervals without contact. All of them depend on the cam angle only, so they
!> are known before a cycle is integrated, and no step passes over one.
module camroller_events
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_lift_pieces, only : find_edges, scan_t, start_scan, has_next, leave_rest, next_angle
   use camroller_sorting, only : sort
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_joints, only : has_curves, has_sharp, has_tip_curve, jumps_with_tip
   use camroller_lift, only : is_at_rest
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_joint_forces, only : contact_moment, curve_count, places_on_curves
   use camroller_state, only : evaluate_loading
   use camroller_minimum, only : minimum_t, start_minimum, narrow_minimum
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   implicit none
   private

   public :: find_stops, find_stops_between, cycle_stops, contact_losses

   !> Accuracy of an angle [rad]: a few roundings of a turn
   real(wp), parameter :: angle_tolerance = 4.0e-15_wp

contains

   !> Stops within one turn, from -pi to pi: kinks of the lift, the valve leaving its seat, loss and return of contact, the change
   !> between the adjuster's load and the spring's with the larger of both, friction that jumps, and friction that is nothing but a
   !> spike where a joint sets off.
   subroutine find_stops(model, stops)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angles from full lift, increasing [rad]
      real(wp), allocatable, intent(out) :: stops(:)

      ! Ends of the pieces of the lift, angles of changes [rad]
      real(wp), allocatable :: edges(:), changes(:)

      call find_edges(model, -pi, pi, edges)
      call find_changes(model, edges, changes)
      if (allocated(model%joints)) then
         if (has_curves(model%joints)) call add_spikes(model, edges, changes)
      end if
      stops = model%lift_stops
      if (allocated(changes)) stops = [stops, changes]
      call sort(stops)
   end subroutine find_stops

   !> The same between any two angles, with both of them: start, stops, end.
   subroutine find_stops_between(model, start, finish, stops)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> Cam angles, increasing; allocated again only where their number is another, in a host's next step mostly not [rad]
      real(wp), allocatable, intent(inout) :: stops(:)

      ! Angles of changes [rad]
      real(wp), allocatable :: changes(:)

      call find_edges(model, start, finish, stops)
      call find_changes(model, stops, changes)
      if (.not. allocated(changes)) return
      stops = [stops(2:size(stops) - 1), pack(changes, changes > start)]
      call sort(stops)
      stops = [start, stops, finish]
   end subroutine find_stops_between

   !> Angles at which something changes: one of the switches its sign, or friction its direction.
   subroutine find_changes(model, edges, angles)
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Angles, in no order [rad]; not allocated where nothing changes
      real(wp), allocatable, intent(out) :: angles(:)

      call add_switches(model, edges, angles)
      if (allocated(model%joints)) then
         if (has_sharp(model%joints)) call add_jumps(model, edges, angles)
      end if
   end subroutine find_changes

   !> Add the angles at which one of the switches changes its sign, found by a scan, and near the lowest of three values by a
   !> search.
   subroutine add_switches(model, edges, angles)
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Angles, increasing but for the accuracy of a scan step [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      ! Switches at three angles of the scan in a row [m, N m]
      real(wp) :: earlier(2), before(2), after(2)
      ! These angles [rad]
      real(wp) :: places(3)
      type(scan_t) :: scan
      ! Which angle it is, and the first one whose switches are kept
      integer :: i, kind, first
      ! Does the valve rest at the ends of the interval, where nothing changes unless a force acts on the closed valve?
      logical :: rested, rests, rests_alike

      call start_scan(scan, edges)
      places = edges(1)
      before = switches(model, places(3))
      earlier = before
      first = 1
      rests_alike = .not. allocated(model%gas) .or. model%train%seat_lift > 0.0_wp
      rests = is_at_rest(model%lift_law, places(3))
      i = 1
      do while (has_next(scan, edges))
         i = i + 1
         places(:2) = places(2:)
         call next_angle(scan, edges, places(3))
         rested = rests
         rests = is_at_rest(model%lift_law, places(3))
         if (rested .and. rests .and. rests_alike) then
            first = i
            call leave_rest(scan)
            cycle
         end if
         after = switches(model, places(3))
         do kind = 1, size(before)
            if ((before(kind) > 0.0_wp) .neqv. (after(kind) > 0.0_wp)) then
               call append(angles, [switch_angle(model, kind, places(2), places(3), before(kind), after(kind), switches)])
            else if (i - 2 >= first .and. abs(before(kind)) < min(abs(earlier(kind)), abs(after(kind)))) then
               call add_short_change(model, kind, places, [earlier(kind), before(kind), after(kind)], angles)
            end if
         end do
         earlier = before
         before = after
      end do
   end subroutine add_switches

   !> Append angles to a list that is not allocated as long as it is empty.
   pure subroutine append(list, angles)
      !> The list [rad]
      real(wp), allocatable, intent(inout) :: list(:)
      !> What to append [rad]
      real(wp), intent(in) :: angles(:)

      if (allocated(list)) then
         list = [list, angles]
      else
         list = angles
      end if
   end subroutine append

   !> Add the angles at which a switch changes its sign and changes it back between three angles of the scan, if there are any:
   !> where the one in the middle is the nearest to zero, and so close that the next values rise by more than itself, its extreme is
   !> looked for.
   subroutine add_short_change(model, kind, places, values, angles)
      type(model_t), intent(in) :: model
      !> Which of the switches
      integer, intent(in) :: kind
      !> Three angles of the scan [rad]
      real(wp), intent(in) :: places(3)
      !> Values of the switch there, the one in the middle the nearest to zero [unit of the switch]
      real(wp), intent(in) :: values(3)
      !> Angles so far [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      type(minimum_t) :: search
      ! Distances from zero; switches at the extreme [unit of the switch]
      real(wp) :: heights(3), found(2)

      heights = abs(values)
      if (any((values > 0.0_wp) .neqv. (values(2) > 0.0_wp))) return
      if (2.0_wp*heights(2) >= maxval(heights)) return
      call start_minimum(search, places, heights, tolerance=0.0_wp)
      do while (search%is_wanted)
         found = switches(model, search%trial)
         if ((found(kind) > 0.0_wp) .neqv. (values(2) > 0.0_wp)) then
            call append(angles, [switch_angle(model, kind, places(1), search%trial, values(1), found(kind), switches), &
               & switch_angle(model, kind, search%trial, places(3), found(kind), values(3), switches)])
            return
         end if
         call narrow_minimum(search, abs(found(kind)))
      end do
   end subroutine add_short_change

   !> Add the angles at which friction of a sliding joint jumps: where the valve turns round, sets off or comes to rest, and where
   !> the pad's contact with the tip passes the pivot's height. There is a stop on each side, so that no step has the jump inside
   !> and none begins or ends on it.
   subroutine add_jumps(model, edges, angles)
      !> The model, with such joints
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Angles so far; out: with those of jumps, in pairs [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      ! Half the distance of the stops of a pair [rad]: beyond the accuracy of the angle, and a part of 1e-12 of a step
      real(wp), parameter :: side = 1.0e-13_wp
      real(wp), allocatable :: turnings(:), jumps(:)
      integer :: i

      call find_turnings(model, edges, jumps_with_tip(model%joints), side, turnings)
      jumps = [(turnings(i) - side, turnings(i) + side, i=1, size(turnings))]
      call append(angles, pack(jumps, jumps > edges(1) .and. jumps < edges(size(edges))))
   end subroutine add_jumps

   !> Angles at which the valve turns round, sets off or comes to rest, and at which the pad's contact with the tip passes the
   !> pivot's height.
   subroutine find_turnings(model, edges, with_tip, distance, turnings)
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Does the pivot's height matter?
      logical, intent(in) :: with_tip
      !> Twice the distance below which two angles are one [rad]
      real(wp), intent(in) :: distance
      !> The angles, increasing but within a step of the scan [rad]
      real(wp), allocatable, intent(out) :: turnings(:)

      ! Slope of the lift [m/rad], height of the contact of pad and tip [m]: at the ends of a scan interval
      real(wp) :: before(2), after(2)
      ! Ends of the interval; angle of a turning [rad]
      real(wp) :: left, right, angle
      type(scan_t) :: scan
      integer :: kind, kinds

      kinds = merge(2, 1, with_tip)
      call start_scan(scan, edges)
      right = edges(1)
      before = turning_values(model, right)
      allocate (turnings(0))
      do while (has_next(scan, edges))
         left = right
         call next_angle(scan, edges, right)
         after = turning_values(model, right)
         do kind = 1, kinds
            if (is_same_sign(before(kind), after(kind))) cycle
            angle = switch_angle(model, kind, left, right, before(kind), after(kind), turning_values)
            ! A turning at a point of the scan ends one interval and begins the next, and two may fall together: one for all
            if (any(abs(turnings - angle) < 0.5_wp*distance)) cycle
            turnings = [turnings, angle]
         end do
         before = after
      end do
   end subroutine find_turnings

   !> Add the angles between which Stribeck's curve leaves nothing of the friction but a spike behind and before each turning: that
   !> of its top, and that beyond which it is below rounding. Points of an integration might all miss it.
   subroutine add_spikes(model, edges, angles)
      !> The model, with such joints
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Angles so far; out: with those of spikes [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      ! Twice the distance below which turnings are one [rad]
      real(wp), parameter :: distance = 1.0e-9_wp
      real(wp), allocatable :: turnings(:)
      ! Half the way to the turnings on both sides [rad]
      real(wp) :: reach(2)
      integer :: i

      if (.not. has_faded(model, edges)) return
      call find_turnings(model, edges, has_tip_curve(model%joints), distance, turnings)
      call sort(turnings)
      turnings = [edges(1), turnings, edges(size(edges))]
      do i = 2, size(turnings) - 1
         reach = 0.5_wp*(turnings(i:i + 1) - turnings(i - 1:i))
         call add_spike(model, turnings(i), -reach(1), angles)
         call add_spike(model, turnings(i), reach(2), angles)
      end do
   end subroutine add_spikes

   !> Does friction fade by Stribeck's curve anywhere within the pieces of the lift?
   pure function has_faded(model, edges) result(verdict)
      !> The model, with such joints
      type(model_t), intent(in) :: model
      !> Ends of the pieces of the lift [rad]
      real(wp), intent(in) :: edges(:)
      !> Does it?
      logical :: verdict

      ! Places in a piece that are looked at [-]
      real(wp), parameter :: parts(3) = [0.2_wp, 0.5_wp, 0.8_wp]
      ! Places on the curves [-]
      real(wp) :: places(2, curve_count)
      integer :: i, k

      verdict = .false.
      do i = 1, size(edges) - 1
         do k = 1, size(parts)
            places = places_at(model, edges(i) + parts(k)*(edges(i + 1) - edges(i)))
            verdict = any(places(2, :) > 0.0_wp)
            if (verdict) return
         end do
      end do
   end function has_faded

   !> Add the angles of the spikes on one side of a turning, where friction has faded half the way to the next.
   subroutine add_spike(model, turning, reach, angles)
      !> The model, with joints
      type(model_t), intent(in) :: model
      !> Angle of the turning, half the way to the next, negative on the side before it [rad]
      real(wp), intent(in) :: turning, reach
      !> Angles so far; out: with those of spikes [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      ! Logarithm of the nearest distance over the half way; error allowed of one, and difference below which two are one [-]
      real(wp), parameter :: nearest = -23.0_wp, precision = 0.05_wp, same = 0.7_wp
      type(bracket_t) :: bracket
      ! Places on the curves at both ends, between [-]
      real(wp), dimension(2, curve_count) :: near, far, between
      ! Logarithms of distances over the half way [-]
      real(wp), allocatable :: found(:)
      integer :: kind, joint

      far = places_at(model, turning + reach)
      if (.not. any(far(2, :) > 0.0_wp)) return
      near = places_at(model, turning + reach*exp(nearest))
      allocate (found(0))
      do joint = 1, curve_count
         if (.not. far(2, joint) > 0.0_wp) cycle
         do kind = 1, 2
            if (near(kind, joint) > 0.0_wp .or. .not. far(kind, joint) > 0.0_wp) cycle
            call start_bracket(bracket, nearest, 0.0_wp, near(kind, joint), far(kind, joint), precision)
            do while (bracket%status == root_wanted)
               between = places_at(model, turning + reach*exp(bracket%trial))
               call narrow_bracket(bracket, between(kind, joint))
            end do
            if (all(abs(found - bracket%trial) > same)) found = [found, bracket%trial]
         end do
      end do
      if (size(found) > 0) call append(angles, turning + reach*exp(found))
   end subroutine add_spike

   !> Where the joints are on Stribeck's curve at an angle.
   pure function places_at(model, angle) result(places)
      !> The model, with joints
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Two logarithms for each surface; below zero without a curve [-]
      real(wp) :: places(2, curve_count)

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status)
      places = -1.0_wp
      if (status == 0) places = places_on_curves(model, position, moments)
   end function places_at

   !> Have two numbers the same sign, or are they both zero?
   pure function is_same_sign(one, other)
      !> The numbers [any]
      real(wp), intent(in) :: one, other
      !> Have they?
      logical :: is_same_sign

      is_same_sign = (one > 0.0_wp .eqv. other > 0.0_wp) .and. (one < 0.0_wp .eqv. other < 0.0_wp)
   end function is_same_sign

   !> Quantities with whose sign friction changes its direction: slope of the lift and height of the tip's contact over the pivot.
   pure function turning_values(model, angle) result(values)
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Slope of the lift [m/rad]; height, one where it does not matter [m]
      real(wp) :: values(2)

      type(position_t) :: position
      integer :: status

      call evaluate_geometry(model, angle, position, status)
      values = 1.0_wp
      if (status /= 0) return
      values(1) = position%lift_slope
      if (allocated(model%joints%tip)) values(2) = model%linkage%b*model%linkage%base_cosine - position%lift &
         & - model%joints%tip%pad_radius
   end function turning_values

   !> Quantities whose sign matters: lift above that where the valve leaves its seat, and the moment that keeps contact, or, with
   !> the larger of both loads, the moment beyond that of the base circle load.
   pure function switches(model, angle) result(values)
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Lift above the seat [m], moment [N m]
      real(wp) :: values(2)

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status, moments_only=.not. allocated(model%joints))
      values = 1.0_wp
      if (status /= 0) return
      values(1) = position%lift - model%train%seat_lift
      values(2) = contact_moment(model, position, moments)
      if (model%takes_maximum_load) then
         values(2) = values(2) - model%base_circle_load*merge(position%normal_arm, position%parallel_arm, model%has_exact_arm)
      end if
   end function switches

   !> Angle at which one of the switches changes its sign.
   function switch_angle(model, kind, left, right, value_left, value_right, values_at) result(angle)
      type(model_t), intent(in) :: model
      !> Which of the switches
      integer, intent(in) :: kind
      !> Ends of the interval [rad]
      real(wp), intent(in) :: left, right
      !> Values there [unit of the switch]
      real(wp), intent(in) :: value_left, value_right
      !> Switches at an angle
      procedure(switches) :: values_at
      !> Angle of the change [rad]
      real(wp) :: angle

      type(bracket_t) :: bracket
      ! Both switches [unit of each]
      real(wp) :: values(2)

      call start_bracket(bracket, left, right, value_left, value_right, angle_tolerance)
      do while (bracket%status == root_wanted)
         values = values_at(model, bracket%trial)
         call narrow_bracket(bracket, values(kind))
      end do
      angle = bracket%trial
   end function switch_angle

   !> Stops of the cycle that starts at an angle: start, all stops ahead of it, end; increasing.
   pure function cycle_stops(stops, start) result(ahead)
      !> Stops within one turn, increasing [rad]
      real(wp), intent(in) :: stops(:)
      !> Start of the cycle [rad]
      real(wp), intent(in) :: start
      !> Stops of the cycle [rad]
      real(wp), allocatable :: ahead(:)

      ! Stops moved into the turn that starts at `start` [rad]
      real(wp) :: moved(size(stops))

      moved = start + modulo(stops - start, two_pi)
      call sort(moved)
      ahead = [start, pack(moved, moved > start .and. moved < start + two_pi), start + two_pi]
   end function cycle_stops

   !> Intervals of a cycle in which the roller has no contact.
   function contact_losses(model, stops) result(intervals)
      !> The model
      type(model_t), intent(in) :: model
      !> Stops of the cycle, with start and end [rad]
      real(wp), intent(in) :: stops(:)
      !> First and last cam angle of each, shape (2, interval) [rad]
      real(wp), allocatable :: intervals(:, :)

      ! The intervals, one after the other [rad]; switches [m, N m]
      real(wp), allocatable :: ends(:)
      real(wp) :: values(2)
      integer :: i
      ! Was there no contact before a stop?
      logical :: was_lost

      allocate (ends(0))
      was_lost = .false.
      do i = 1, size(stops) - 1
         if (.not. stops(i + 1) > stops(i)) cycle
         values = switches(model, 0.5_wp*(stops(i) + stops(i + 1)))
         if (values(2) > 0.0_wp .or. model%takes_maximum_load) then
            was_lost = .false.
         else if (was_lost) then
            ends(size(ends)) = stops(i + 1)
         else
            ends = [ends, stops(i), stops(i + 1)]
            was_lost = .true.
         end if
      end do
      intervals = reshape(ends, [2, size(ends)/2])
   end function contact_losses

end module camroller_events
