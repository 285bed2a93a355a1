!> Cam angles at which the right-hand side of the roller equation has a kink or a jump, and the margin against loss of contact.
!>
!> Layer: solver. In: model. Out: stop angles for the integration, contact losses, spring margin. All of them depend on the cam
!> angle alone, so they are known before a cycle is integrated and none can be stepped over.
module camroller_events
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_positive_inf
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_model, only : model_t
   use camroller_lift, only : is_at_rest
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_number_text, only : fixed_text
   use camroller_state, only : evaluate_loading
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   implicit none
   private

   public :: margin_t, find_stops, find_stops_between, cycle_stops, check_geometry, find_margin

   !> Margin against loss of contact, frictionless
   type :: margin_t
      !> Smallest contact load over the event [N]; negative: the load that keeps contact is missing
      real(wp) :: smallest_load
      !> Cam angle from full lift where it occurs [rad]
      real(wp) :: angle
      !> Cam speed at which contact is first lost, infinite if never [rad/s]
      real(wp) :: contact_loss_speed
   end type margin_t

   !> Longest step of a scan [rad]
   real(wp), parameter :: longest_step = 0.25_wp*degree
   !> Least number of steps of a scan, shared out evenly between the pieces of the lift: an event may be shorter than a step
   integer, parameter :: least_steps = 256
   !> Difference between two steps, over both together, up to which they count as equal [-]
   real(wp), parameter :: even_spacing = 1.0e-6_wp
   !> Accuracy of an angle [rad]: a few roundings of a turn
   real(wp), parameter :: angle_tolerance = 4.0e-15_wp

contains

   !> Stops within one turn, from -pi to pi: kinks of the lift, the valve leaving its seat, loss and return of contact.
   subroutine find_stops(model, stops)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angles from full lift, increasing [rad]
      real(wp), allocatable, intent(out) :: stops(:)

      stops = [model%lift_stops, switch_angles(model, -pi, pi)]
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

      stops = [lift_stops_between(model, start, finish), switch_angles(model, start, finish)]
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
      integer :: piece, last, i

      edges = lift_stops_between(model, start, finish)
      edges = [start, pack(edges, edges > start), finish]
      steps = max(ceiling((edges(2:) - edges(:size(edges) - 1))/longest_step), 1 + least_steps/size(edges))
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

   !> Angles between two others at which one of the switches changes its sign, found by a scan.
   function switch_angles(model, start, finish) result(angles)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle [rad]
      real(wp), intent(in) :: start, finish
      !> Angles, increasing but for the accuracy of a scan step [rad]
      real(wp), allocatable :: angles(:)

      ! Values at the ends of a scan interval: lift above the seat [m] and moment that keeps contact [N m]
      real(wp) :: before(2), after(2)
      ! Angles of the scan [rad]
      real(wp), allocatable :: scan(:)
      integer :: i, kind
      ! Does the valve rest at the ends of the interval, where nothing changes unless a force acts on the closed valve?
      logical :: rested, rests, rests_alike

      allocate (angles(0))
      scan = scan_angles(model, start, finish)
      before = switches(model, start)
      rests_alike = .not. allocated(model%gas) .or. model%train%seat_lift > 0.0_wp
      rests = is_at_rest(model%lift_law, start)
      do i = 2, size(scan)
         rested = rests
         rests = is_at_rest(model%lift_law, scan(i))
         if (rested .and. rests .and. rests_alike) cycle
         after = switches(model, scan(i))
         do kind = 1, size(before)
            if ((before(kind) > 0.0_wp) .eqv. (after(kind) > 0.0_wp)) cycle
            angles = [angles, switch_angle(model, kind, scan(i - 1), scan(i), before(kind), after(kind))]
         end do
         before = after
      end do
   end function switch_angles

   !> Quantities whose sign matters: lift above that where the valve leaves its seat, and the moment that keeps contact.
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
      values(2) = moments%total
      if (model%is_consistent .and. allocated(model%guide_drag)) then
         values(2) = values(2) + model%guide_drag*model%speed*position%lift_slope*position%valve_arm
      end if
   end function switches

   !> Angle at which one of the switches changes its sign.
   function switch_angle(model, kind, left, right, value_left, value_right) result(angle)
      !> The model
      type(model_t), intent(in) :: model
      !> Which of the switches
      integer, intent(in) :: kind
      !> Ends of the interval [rad]
      real(wp), intent(in) :: left, right
      !> Values there [m] or [N m]
      real(wp), intent(in) :: value_left, value_right
      !> Angle of the change [rad]
      real(wp) :: angle

      type(bracket_t) :: bracket
      ! Both switches [m, N m]
      real(wp) :: values(2)

      call start_bracket(bracket, left, right, value_left, value_right, angle_tolerance)
      do while (bracket%status == root_wanted)
         values = switches(model, bracket%trial)
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

   !> Refuse a cam that cannot be: lift out of reach, undercut, a hollow flank that the grinding wheel does not fit.
   subroutine check_geometry(model, grinding_wheel_radius, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Radius of the grinding wheel, zero where not given [m]
      real(wp), intent(in) :: grinding_wheel_radius
      !> Domain error that names the cam angle
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      type(moments_t) :: moments
      ! Angles of the scan, angle [rad]; gas force [N]
      real(wp), allocatable :: scan(:)
      real(wp) :: angle, force
      integer :: i, status

      scan = scan_angles(model, -pi, pi)
      do i = 1, size(scan)
         angle = scan(i)
         call evaluate_loading(model, angle, position, force, moments, status)
         if (status /= 0) then
            call raise(error, kind_domain, "mechanism: the finger cannot reach the lift"//trim(at_angle(angle)))
         else if (position%normal_arm <= 0.0_wp) then
            call raise(error, kind_domain, "mechanism: the roller passes the line from pivot to cam centre"//trim(at_angle(angle)))
         else if (position%equivalent_radius <= 0.0_wp) then
            call raise(error, kind_domain, "cam undercut: the pitch curve's radius of curvature is smaller than the roller"// &
               & trim(at_angle(angle)))
         else if (grinding_wheel_radius > 0.0_wp) then
            ! Hollow where the pitch curvature is negative: |R_c| = -1/kappa + r_R
            if (-position%pitch_curvature*(grinding_wheel_radius - model%roller_radius) > 1.0_wp) then
               call raise(error, kind_domain, "hollow flank: the grinding wheel is larger than the cam's radius of curvature"// &
                  & trim(at_angle(angle)))
            end if
         end if
         if (allocated(error)) return
      end do
   end subroutine check_geometry

   !> Words that name a cam angle as files do: the nose at 180 deg.
   function at_angle(angle) result(text)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Text
      character(len=32) :: text

      text = " at cam angle "//fixed_text(180.0_wp + angle/degree, 2)//" deg"
   end function at_angle

   !> Smallest load of the event and the speed at which contact would first be lost, without friction.
   !>
   !> The moment is `M_static + omega^2 M_inertia`; contact is first lost at the smallest `sqrt(-M_static/M_inertia)` over the
   !> angles with a negative inertia moment, found on the scan and refined by a parabola through three points.
   subroutine find_margin(model, margin)
      !> The model
      type(model_t), intent(in) :: model
      !> Margin
      type(margin_t), intent(out) :: margin

      ! Angles of the scan, with one on either side [rad]
      real(wp), allocatable :: scan(:)
      ! Loads [N] and squares of the loss speed [rad^2/s^2] at three neighbouring points
      real(wp) :: loads(3), squares(3)
      ! Smallest square so far [rad^2/s^2]
      real(wp) :: smallest_square
      integer :: i

      margin%smallest_load = huge(1.0_wp)
      margin%angle = 0.0_wp
      smallest_square = huge(1.0_wp)
      scan = scan_angles(model, -pi, pi)
      scan = [scan(size(scan) - 1) - two_pi, scan]
      call frictionless(model, scan(1), loads(2), squares(2))
      call frictionless(model, scan(2), loads(3), squares(3))
      do i = 3, size(scan)
         loads(:2) = loads(2:)
         squares(:2) = squares(2:)
         call frictionless(model, scan(i), loads(3), squares(3))
         if (loads(2) < margin%smallest_load) then
            margin%smallest_load = min(loads(2), valley(scan(i - 2:i), loads))
            margin%angle = scan(i - 1)
         end if
         if (squares(2) < smallest_square) smallest_square = min(squares(2), valley(scan(i - 2:i), squares))
      end do
      margin%contact_loss_speed = ieee_value(1.0_wp, ieee_positive_inf)
      if (smallest_square < huge(1.0_wp)) margin%contact_loss_speed = sqrt(max(smallest_square, 0.0_wp))
   end subroutine find_margin

   !> Load without friction, and the square of the speed at which it would vanish.
   subroutine frictionless(model, angle, load, square)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Load [N]
      real(wp), intent(out) :: load
      !> Square of the speed, huge where the inertia presses [rad^2/s^2]
      real(wp), intent(out) :: square

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]; moment of the masses [N m]
      real(wp) :: force, inertia
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status)
      load = moments%total/merge(position%normal_arm, position%parallel_arm, model%has_exact_arm)
      inertia = moments%valve + moments%finger
      square = huge(1.0_wp)
      if (inertia < -epsilon(1.0_wp)*abs(moments%spring)) square = -(moments%total - inertia)/inertia*model%speed**2
   end subroutine frictionless

   !> Lowest value of the parabola through three equally spaced points with the middle one lowest; else the middle one.
   pure function valley(angles, values) result(lowest)
      !> Three angles [rad]
      real(wp), intent(in) :: angles(3)
      !> Three values [any]
      real(wp), intent(in) :: values(3)
      !> Lowest value [any]
      real(wp) :: lowest

      ! Second difference [any]
      real(wp) :: bend

      lowest = values(2)
      if (maxval(values) >= 0.5_wp*huge(1.0_wp)) return
      if (values(2) > min(values(1), values(3))) return
      if (abs(angles(1) - 2.0_wp*angles(2) + angles(3)) > even_spacing*(angles(3) - angles(1))) return
      bend = values(1) - 2.0_wp*values(2) + values(3)
      if (bend > 0.0_wp) lowest = values(2) - (values(3) - values(1))**2/(8.0_wp*bend)
   end function valley

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
