!> Cam angles at which the right-hand side of the roller equation has a kink or a jump, and the angles without contact.
!>
!> In: model. Out: stop angles for the integration, intervals without contact. All of them depend on the cam angle only, so they
!> are known before a cycle is integrated, and no step passes over one.
module camroller_events
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_joints, only : jumps_with_tip, jumps_with_valve
   use camroller_lift, only : is_at_rest
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_number_text, only : in_mm => millimetres_text
   use camroller_joint_forces, only : contact_moment
   use camroller_state, only : evaluate_loading
   use camroller_extremum, only : extremum_t, start_extremum, narrow_extremum
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   implicit none
   private

   public :: find_stops, find_stops_between, lift_stops_between, cycle_stops, contact_losses, check_geometry

   !> Longest step of a scan [rad]
   real(wp), parameter :: longest_step = 0.25_wp*degree
   !> Least number of steps of a scan of a turn, shared out evenly between the pieces of the lift: an event may be shorter than a
   !> step
   integer, parameter :: least_steps = 256
   !> Part of the bend that a path may have from which on the scan is refined [-]
   real(wp), parameter :: nearly_too_much = 0.5_wp
   !> Accuracy of an angle [rad]: a few roundings of a turn
   real(wp), parameter :: angle_tolerance = 4.0e-15_wp

contains

   !> Stops within one turn, from -pi to pi: kinks of the lift, the valve leaving its seat, loss and return of contact, the change
   !> between the adjuster's load and the spring's with the larger of both, friction that jumps.
   subroutine find_stops(model, stops)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angles from full lift, increasing [rad]
      real(wp), allocatable, intent(out) :: stops(:)

      stops = [model%lift_stops, switch_angles(model, -pi, pi), jump_angles(model, -pi, pi)]
      call sort(stops)
   end subroutine find_stops

   !> The same between any two angles, with both of them: start, stops, end.
   subroutine find_stops_between(model, start, finish, stops)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> Cam angles, increasing [rad]
      real(wp), allocatable, intent(out) :: stops(:)

      stops = [lift_stops_between(model, start, finish), switch_angles(model, start, finish), jump_angles(model, start, finish)]
      call sort(stops)
      stops = [start, pack(stops, stops > start), finish]
   end subroutine find_stops_between

   !> Kinks of the lift from one angle up to another, which is left out.
   pure function lift_stops_between(model, start, finish) result(stops)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> The kinks, increasing [rad]
      real(wp), allocatable :: stops(:)

      ! Kinks of the lift in the turn that begins at `start`, and in those after it [rad]
      real(wp) :: kinks(size(model%lift_stops))

      allocate (stops(0))
      kinks = start + modulo(model%lift_stops - start, two_pi)
      call sort(kinks)
      do while (any(kinks < finish))
         stops = [stops, pack(kinks, kinks < finish)]
         kinks = kinks + two_pi
      end do
   end function lift_stops_between

   !> Angles of a scan: the ends, every kink of the lift, and even steps between them, so that no event is too short to be seen.
   pure function scan_angles(model, start, finish) result(angles)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle [rad]
      real(wp), intent(in) :: start, finish
      !> Angles, increasing, with both ends [rad]
      real(wp), allocatable :: angles(:)

      ! Ends of the pieces [rad]
      real(wp), allocatable :: edges(:)
      integer, allocatable :: steps(:)
      integer :: piece, last, i, least

      edges = lift_stops_between(model, start, finish)
      edges = [start, pack(edges, edges > start), finish]
      least = ceiling(least_steps*min(1.0_wp, (finish - start)/two_pi))
      steps = max(ceiling((edges(2:) - edges(:size(edges) - 1))/longest_step), 1 + least/size(edges))
      allocate (angles(1 + sum(steps)))
      angles(1) = start
      last = 1
      do piece = 1, size(steps)
         do i = 1, steps(piece) - 1
            angles(last + i) = edges(piece) + (edges(piece + 1) - edges(piece))*i/steps(piece)
         end do
         last = last + steps(piece)
         angles(last) = edges(piece + 1)
      end do
   end function scan_angles

   !> Angles between two others at which one of the switches changes its sign, found by a scan, and near the lowest of three values
   !> by a search.
   function switch_angles(model, start, finish) result(angles)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle [rad]
      real(wp), intent(in) :: start, finish
      !> Angles, increasing but for the accuracy of a scan step [rad]
      real(wp), allocatable :: angles(:)

      ! Switches at three angles of the scan in a row [m, N m]
      real(wp) :: earlier(2), before(2), after(2)
      ! Angles of the scan [rad]
      real(wp), allocatable :: scan(:)
      ! First angle of the scan whose switches are kept
      integer :: i, kind, first
      ! Does the valve rest at the ends of the interval, where nothing changes unless a force acts on the closed valve?
      logical :: rested, rests, rests_alike

      allocate (angles(0))
      scan = scan_angles(model, start, finish)
      before = switches(model, start)
      first = 1
      rests_alike = .not. allocated(model%gas) .or. model%train%seat_lift > 0.0_wp
      rests = is_at_rest(model%lift_law, start)
      do i = 2, size(scan)
         rested = rests
         rests = is_at_rest(model%lift_law, scan(i))
         if (rested .and. rests .and. rests_alike) then
            first = i
            cycle
         end if
         after = switches(model, scan(i))
         do kind = 1, size(before)
            if ((before(kind) > 0.0_wp) .neqv. (after(kind) > 0.0_wp)) then
               angles = [angles, switch_angle(model, kind, scan(i - 1), scan(i), before(kind), after(kind), switches)]
            else if (i - 2 >= first) then
               call add_short_change(model, kind, scan(i - 2:i), [earlier(kind), before(kind), after(kind)], angles)
            end if
         end do
         earlier = before
         before = after
      end do
   end function switch_angles

   !> Add the angles at which a switch changes its sign and changes it back between three angles of the scan, if there are any:
   !> where the one in the middle is so close to zero that the next values rise by more than itself, its extreme is looked for.
   subroutine add_short_change(model, kind, places, values, angles)
      !> The model
      type(model_t), intent(in) :: model
      !> Which of the switches
      integer, intent(in) :: kind
      !> Three angles of the scan [rad]
      real(wp), intent(in) :: places(3)
      !> Values of the switch there [unit of the switch]
      real(wp), intent(in) :: values(3)
      !> Angles so far [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      type(extremum_t) :: search
      ! Distances from zero; switches at the extreme [unit of the switch]
      real(wp) :: heights(3), found(2)

      heights = abs(values)
      if (any((values > 0.0_wp) .neqv. (values(2) > 0.0_wp))) return
      if (heights(2) >= min(heights(1), heights(3)) .or. 2.0_wp*heights(2) >= maxval(heights)) return
      call start_extremum(search, places, heights, tolerance=0.0_wp)
      do while (search%is_wanted)
         found = switches(model, search%trial)
         if ((found(kind) > 0.0_wp) .neqv. (values(2) > 0.0_wp)) then
            angles = [angles, switch_angle(model, kind, places(1), search%trial, values(1), found(kind), switches), &
               & switch_angle(model, kind, search%trial, places(3), found(kind), values(3), switches)]
            return
         end if
         call narrow_extremum(search, abs(found(kind)))
      end do
   end subroutine add_short_change

   !> Angles between two others at which friction of a sliding joint jumps: where the valve turns round, sets off or comes to rest,
   !> and where the pad's contact with the tip passes the pivot's height. There is a stop on each side, so that no step has the
   !> jump inside and none begins or ends on it.
   function jump_angles(model, start, finish) result(angles)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle [rad]
      real(wp), intent(in) :: start, finish
      !> Angles, in pairs [rad]
      real(wp), allocatable :: angles(:)

      ! Half the distance of the stops of a pair [rad]: beyond the accuracy of the angle, and a part of 1e-12 of a step
      real(wp), parameter :: side = 1.0e-13_wp
      ! Slope of the lift [m/rad], height of the contact of pad and tip [m]: at the ends of a scan interval
      real(wp) :: before(2), after(2)
      ! Angles of the scan; angle of a jump [rad]
      real(wp), allocatable :: scan(:)
      real(wp) :: angle
      integer :: i, kind

      allocate (angles(0))
      if (.not. allocated(model%joints)) return
      if (.not. jumps_with_valve(model%joints)) return
      scan = scan_angles(model, start, finish)
      before = turning_values(model, start)
      do i = 2, size(scan)
         after = turning_values(model, scan(i))
         do kind = 1, size(before)
            if (is_same_sign(before(kind), after(kind))) cycle
            angle = switch_angle(model, kind, scan(i - 1), scan(i), before(kind), after(kind), turning_values)
            ! A jump at a point of the scan ends one interval and begins the next, and two may fall together: one pair for all
            if (any(abs(angles + side - angle) < 0.5_wp*side)) cycle
            angles = [angles, angle - side, angle + side]
         end do
         before = after
      end do
      angles = pack(angles, angles > start .and. angles < finish)
   end function jump_angles

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
      !> The model
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
      if (jumps_with_tip(model%joints)) values(2) = model%linkage%b*model%linkage%base_cosine - position%lift &
         & - model%joints%tip%pad_radius
   end function turning_values

   !> Quantities whose sign matters: lift above that where the valve leaves its seat, and the moment that keeps contact, or, with
   !> the larger of both loads, the moment beyond that of the base circle load.
   pure function switches(model, angle) result(values)
      !> The model
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

      call evaluate_loading(model, angle, position, force, moments, status)
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
      !> The model
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

   !> Refuse a cam that cannot be: lift out of reach, undercut, a hollow flank that the grinding wheel does not fit. Where the
   !> path of the roller's centre is bent most and nearly as much as it may be, that place is looked for between the steps.
   subroutine check_geometry(model, grinding_wheel_radius, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      ! Angles of the scan [rad]
      real(wp), allocatable :: scan(:)
      ! How much the path is bent at three neighbouring angles, over what it may be [-]
      real(wp) :: bends(3)
      integer :: i

      scan = scan_angles(model, -pi, pi)
      bends = 0.0_wp
      do i = 1, size(scan)
         bends(:2) = bends(2:)
         call check_position(model, grinding_wheel_radius, scan(i), bends(3), error)
         if (allocated(error)) return
         if (i < 3 .or. bends(2) < max(nearly_too_much, bends(1), bends(3))) cycle
         call check_summit(model, grinding_wheel_radius, scan(i - 2:i), bends, error)
         if (allocated(error)) return
      end do
   end subroutine check_geometry

   !> Refuse a cam whose roller path bends too sharply at its sharpest point between two angles.
   subroutine check_summit(model, grinding_wheel_radius, angles, bends, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Three angles of the scan [rad]
      real(wp), intent(in) :: angles(3)
      !> How much the path is bent there, over what it may be, the middle one largest [-]
      real(wp), intent(in) :: bends(3)
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      type(extremum_t) :: search
      real(wp) :: bend ! [-]

      call start_extremum(search, angles, -bends, epsilon(1.0_wp))
      do while (search%is_wanted)
         call check_position(model, grinding_wheel_radius, search%trial, bend, error)
         if (allocated(error)) return
         call narrow_extremum(search, -bend)
      end do
   end subroutine check_summit

   !> Refuse a cam that cannot be at one angle.
   subroutine check_position(model, grinding_wheel_radius, angle, bend, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Curvature of the path of the roller's centre over that at which it undercuts, or the wheel does not fit [-]
      real(wp), intent(out) :: bend
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force
      integer :: status

      bend = 0.0_wp
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) then
         call raise(error, kind_domain, "the finger cannot reach the lift of "//in_mm(position%lift)//" mm at "// &
            & cam_angle_text(angle, 2)//"; mechanism.pivot_to_pad_mm = "//in_mm(model%linkage%b)//" is too short for it")
         return
      end if
      ! Hollow where the curvature is negative: |R_c| = -1/kappa + r_R
      bend = position%pitch_curvature*model%roller_radius
      if (grinding_wheel_radius > 0.0_wp) bend = max(bend, -position%pitch_curvature*(grinding_wheel_radius - model%roller_radius))
      if (position%normal_arm <= 0.0_wp) then
         call raise(error, kind_domain, "the roller passes the line from pivot to cam centre at "//cam_angle_text(angle, 2)// &
            & ", at a lift of "//in_mm(position%lift)//" mm, with mechanism.pivot_to_roller_mm = "//in_mm(model%linkage%a)// &
            & " and mechanism.pivot_to_cam_mm = "//in_mm(model%linkage%d))
      else if (position%equivalent_radius <= 0.0_wp) then
         call raise(error, kind_domain, "cam undercut: the path of the roller's centre has a radius of curvature of "// &
            & in_mm(1.0_wp/position%pitch_curvature)//" mm at "//cam_angle_text(angle, 2)//", smaller than roller.radius_mm = "// &
            & in_mm(model%roller_radius)//"; a larger mechanism.base_radius_mm, a smaller roller or a longer or lower lift "// &
            & "avoids it")
      else if (bend > 1.0_wp) then
         call raise(error, kind_domain, "hollow flank: the cam's radius of curvature is "// &
            & in_mm(model%roller_radius - 1.0_wp/position%pitch_curvature)//" mm at "//cam_angle_text(angle, 2)// &
            & ", less than the grinding wheel's, mechanism.grinding_wheel_radius_mm = "//in_mm(grinding_wheel_radius))
      end if
   end subroutine check_position

   !> Sort a short list by insertion.
   pure subroutine sort(values)
      !> Numbers, in and out [any]
      real(wp), intent(inout) :: values(:)

      ! The one being placed [any]
      real(wp) :: value
      integer :: i, j

      do i = 2, size(values)
         value = values(i)
         j = i - 1
         do while (j >= 1)
            if (values(j) <= value) exit
            values(j + 1) = values(j)
            j = j - 1
         end do
         values(j + 1) = value
      end do
   end subroutine sort

end module camroller_events
