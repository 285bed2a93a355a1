!> The camshaft: all followers together, and the bearings that carry them.
!>
!> In: case, models and cycles of the lobe shapes. Out: torques of the followers and bearings of each camshaft at a cam angle, with
!> the orbits of the journals where a case asks for them.
!> Each cam sees the cycle of its lobe shape at its own phase, by the shape's curve where that is good enough; without camshaft
!> bearings in the case there is one cam.
module camroller_shaft
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_case, only : camshaft_number, case_t
   use camroller_case_torques, only : torque_rows
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t, load_stops, state_at
   use camroller_lift, only : is_at_rest
   use camroller_lobe_curve, only : lobe_curve_t, contact_near, curve_at, curve_values, cam_values
   use camroller_effect_list, only : effect_bearing_heat, effect_bearings, effect_orbit, has_effect
   use camroller_events, only : cycle_stops
   use camroller_journal_orbit, only : orbit_t, place_at
   use camroller_refined_curve, only : follow_steps, refine_curve
   use camroller_torque_list, only : torque_count, of_bearings, of_shaft_drag
   use camroller_journal, only : cam_bearings_t, journal_t, new_journal, journal_solved
   use camroller_journal_motion, only : moving_state
   use camroller_bearing_asperity, only : bearing_touch_t, bearing_state_t, new_touch, carry_load
   use camroller_bearing_heat, only : oil_flow
   use camroller_bearing_loads, only : add_forces, bearing_shares, pull_loads
   use camroller_shaft_drag, only : shaft_drag_t, check_shaft_drag, find_shaft_drag
   implicit none
   private

   public :: shaft_t, solved_t, new_shaft, set_journal, set_drag, refine_curves, shaft_torques, in_common_frame, bearing_torques
   public :: bearing_number, cam_at, has_orbits, needs_turn, shaft_stops, valves_rest

   !> Cams of a shaft
   type :: shaft_t
      !> Lobe shape of each cam
      integer, allocatable :: lobes(:)
      !> Camshaft of each cam, and the number of camshafts
      integer, allocatable :: shafts(:)
      integer :: count = 1
      !> Angle by which each cam's event follows the first one's [rad]
      real(wp), allocatable :: phases(:)
      !> Cosine and sine of the angle at which each follower stands, shape (2, cam) [-]
      real(wp), allocatable :: directions(:, :)
      !> Interval of the cycle where each cam's search starts
      integer, allocatable :: hints(:)
      !> Bearings; allocated where the case has them, with friction
      type(cam_bearings_t), allocatable :: bearings
      type(journal_t), allocatable :: journal
      !> Part of each cam's force that each bearing of its camshaft carries, shape (bearing, cam) [-]; loads by the pull of belt or
      !> chain, zero without it, shape (2, bearing) [N]
      real(wp), allocatable :: shares(:, :), pull(:, :)
      !> The first of both bearings between which each cam is
      integer, allocatable :: left(:)
      !> Their surfaces; allocated where the case has them
      type(bearing_touch_t), allocatable :: touch
      !> Torque of seals and drive over speed and temperature, allocated where the case has it
      type(shaft_drag_t), allocatable :: drag_table
      !> That torque on each camshaft, zero without it [N m]
      real(wp) :: drag = 0.0_wp
      !> Cam speed [rad/s]
      real(wp) :: speed = 0.0_wp
      !> What follows from a whole turn, shape (bearing, camshaft), allocated once it is found: bearings with their own oil,
      !> orbits of the journals
      type(journal_t), allocatable :: warm(:, :)
      type(orbit_t), allocatable :: orbits(:, :)
      !> Rise of the temperature of that oil, where it is found [K]
      real(wp), allocatable :: rises(:, :)
      !> For each cam the first one with its lobe shape and phase: the followers of both do the same
      integer, allocatable :: twins(:)
      !> Which torques of `torque_list` the case has
      logical :: has_torque(torque_count) = .false.
      !> Room for what each cam takes, shape (value, cam) [N m, N], for the force on each in the frame of the first follower, shape
      !> (2, cam), and for the load of each bearing, shape (2, bearing) [N]
      real(wp), allocatable :: values(:, :), forces(:, :), loads(:, :)
   end type shaft_t

   !> A case that is solved: model and cycle of each lobe shape, and the camshafts that carry them
   type :: solved_t
      type(case_t), pointer :: case => null()
      type(model_t), pointer :: models(:) => null()
      type(cycle_t), pointer :: cycles(:) => null()
      !> What the camshaft takes from each follower, as a curve
      type(lobe_curve_t), pointer :: curves(:) => null()
      type(shaft_t) :: shaft
   end type solved_t

contains

   !> Cams and bearings of a case.
   subroutine new_shaft(shaft, case, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(out) :: shaft
      !> The case
      type(case_t), intent(in) :: case
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      integer :: cams

      if (.not. allocated(case%cam_bearings)) then
         shaft%lobes = [1]
         shaft%shafts = [1]
         shaft%phases = [0.0_wp]
         shaft%hints = [1]
         allocate (shaft%directions(2, 1))
         shaft%directions(:, 1) = [1.0_wp, 0.0_wp]
         call find_twins(shaft)
         shaft%has_torque = torque_rows(case)
         return
      end if
      cams = size(case%cam_bearings%cam_positions)
      shaft%phases = case%cam_bearings%cam_phases
      shaft%lobes = case%cam_bearings%cam_lobes
      shaft%count = camshaft_number(case)
      allocate (shaft%shafts(cams))
      shaft%shafts = 1
      if (allocated(case%cam_bearings%cam_shafts)) shaft%shafts = case%cam_bearings%cam_shafts
      allocate (shaft%directions(2, cams), shaft%hints(cams))
      shaft%directions(1, :) = cos(case%cam_bearings%follower_angles)
      shaft%directions(2, :) = sin(case%cam_bearings%follower_angles)
      shaft%hints = 1
      call find_twins(shaft)
      shaft%has_torque = torque_rows(case)
      if (.not. has_effect(case, effect_bearings)) return
      shaft%bearings = case%cam_bearings
      call share_loads(shaft, case)
      allocate (shaft%journal)
      call set_journal(shaft, viscosity, speed, error)
      if (allocated(error)) return
      if (allocated(case%shaft_drag)) then
         call check_shaft_drag(case%shaft_drag, error)
         if (allocated(error)) return
         shaft%drag_table = case%shaft_drag
         call set_drag(shaft, speed, case%operating_point%oil_temperature, error)
         if (allocated(error)) return
      end if
      if (.not. allocated(case%bearing_asperity)) return
      allocate (shaft%touch)
      call new_touch(shaft%touch, case%bearing_asperity, case%cam_bearings%radial_clearance, error)
   end subroutine new_shaft

   !> What each bearing carries of the force on each cam, and of the pull of belt or chain.
   pure subroutine share_loads(shaft, case)
      type(shaft_t), intent(inout) :: shaft
      type(case_t), intent(in) :: case

      integer :: cam

      associate (places => case%cam_bearings%bearing_positions, cams => case%cam_bearings%cam_positions)
         allocate (shaft%shares(size(places), size(cams)), shaft%pull(2, size(places)), shaft%loads(2, size(places)), &
            & shaft%left(size(cams)))
         do cam = 1, size(cams)
            shaft%shares(:, cam) = bearing_shares(places, cams(cam))
            shaft%left(cam) = min(findloc(shaft%shares(:, cam) > 0.0_wp, .true., 1), size(places) - 1)
         end do
         shaft%pull = 0.0_wp
         if (allocated(case%belt_pull)) shaft%pull = pull_loads(places, case%belt_pull)
      end associate
   end subroutine share_loads

   !> Find the cams that do the same, and make room.
   pure subroutine find_twins(shaft)
      !> The shaft with its cams
      type(shaft_t), intent(inout) :: shaft

      integer :: cam, other

      associate (cams => size(shaft%lobes))
         allocate (shaft%twins(cams), shaft%values(curve_values, cams), shaft%forces(2, cams))
         do cam = 1, cams
            do other = 1, cam
               if (shaft%lobes(other) == shaft%lobes(cam) .and. .not. abs(shaft%phases(other) - shaft%phases(cam)) > 0.0_wp) exit
            end do
            shaft%twins(cam) = other
         end do
      end associate
   end subroutine find_twins

   !> Set the bearings, where there are any, to another viscosity and speed.
   subroutine set_journal(shaft, viscosity, speed, error)
      !> The shaft
      type(shaft_t), intent(inout) :: shaft
      !> Viscosity of the oil at ambient pressure [Pa s], cam speed [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Deck or domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      shaft%speed = speed
      if (allocated(shaft%journal)) call new_journal(shaft%journal, shaft%bearings, viscosity, speed, error)
   end subroutine set_journal

   !> Set the torque of seals and drive, where there is one, to another speed and temperature.
   subroutine set_drag(shaft, speed, temperature, error)
      !> The shaft
      type(shaft_t), intent(inout) :: shaft
      !> Cam speed [rad/s], temperature of the oil [K]
      real(wp), intent(in) :: speed, temperature
      !> Domain error outside its table
      type(error_t), allocatable, intent(out) :: error

      if (allocated(shaft%drag_table)) call find_shaft_drag(shaft%drag_table, speed, temperature, shaft%drag, error)
   end subroutine set_drag

   !> Do the journals of a case move on orbits?
   pure function has_orbits(case) result(has)
      !> The case
      type(case_t), intent(in) :: case
      !> Do they?
      logical :: has

      has = has_effect(case, effect_orbit)
   end function has_orbits

   !> Do the bearings of a case follow from a whole turn, and not from the load of an instant?
   pure function needs_turn(case)
      !> The case
      type(case_t), intent(in) :: case
      !> Do they?
      logical :: needs_turn

      needs_turn = has_orbits(case) .or. has_effect(case, effect_bearing_heat)
   end function needs_turn

   !> Start, stops and end of a turn of the first cam, with the stops of the load on cams.
   function shaft_stops(solved, is_wanted) result(stops)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Which cams
      logical, intent(in) :: is_wanted(:)
      !> The stops [rad]
      real(wp), allocatable :: stops(:)

      integer :: cam

      allocate (stops(0))
      do cam = 1, size(solved%shaft%lobes)
         associate (lobe => solved%shaft%lobes(cam))
            if (is_wanted(cam)) stops = [stops, load_stops(solved%cycles(lobe), solved%models(lobe)) + solved%shaft%phases(cam)]
         end associate
      end do
      stops = cycle_stops(stops, solved%cycles(solved%shaft%lobes(1))%start)
   end function shaft_stops

   !> Do the valves of all cams rest, so that nothing but friction changes the loads of bearings, and these alone their torque?
   pure function valves_rest(solved, angle)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Do they?
      logical :: valves_rest

      integer :: cam

      valves_rest = .not. (needs_turn(solved%case) .or. allocated(solved%case%gas_force) .or. allocated(solved%case%dynamics))
      do cam = 1, size(solved%shaft%lobes)
         if (valves_rest) valves_rest = is_at_rest(solved%models(solved%shaft%lobes(cam))%lift_law, angle &
            & - solved%shaft%phases(cam))
      end do
   end function valves_rest

   !> Make the curves better of shapes that several cams have, so that it pays, and where bearings ask for them over the
   !> whole turn: a flexible train has a curve only then.
   subroutine refine_curves(solved, error)
      !> The solved case
      type(solved_t), intent(inout) :: solved
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      do lobe = 1, size(solved%models)
         if (count(solved%shaft%lobes == lobe) < 2 .and. .not. needs_turn(solved%case)) cycle
         if (needs_turn(solved%case) .and. allocated(solved%cycles(lobe)%flexible)) call follow_steps(solved%models(lobe), &
            & solved%cycles(lobe), solved%curves(lobe), error)
         if (allocated(error)) return
         call refine_curve(solved%models(lobe), solved%cycles(lobe), solved%curves(lobe), error)
         if (allocated(error)) return
      end do
   end subroutine refine_curves

   !> Torques at a cam angle.
   subroutine shaft_torques(solved, angle, torques, error, cams, bearings)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Torques of all followers and bearings of each camshaft, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(out), contiguous :: torques(:, :)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error
      !> What each cam takes from its follower there, shape (value, cam); those of twins are not used [N m, N]; without it the
      !> curves say so
      real(wp), intent(in), contiguous, optional :: cams(:, :)
      !> States of the bearings, shape (bearing, camshaft), where it is allocated
      type(bearing_state_t), allocatable, intent(inout), optional :: bearings(:, :)

      real(wp) :: values(curve_values) ! torques and force of a cam [N m, N]
      integer :: cam
      logical :: with_states ! Are the states of the bearings wanted?

      associate (shaft => solved%shaft)
         if (present(cams)) then
            call add_cams(shaft, cams, torques)
         else
            do cam = 1, size(shaft%lobes)
               if (shaft%twins(cam) < cam) cycle
               call cam_at(solved, cam, angle, values, error)
               if (allocated(error)) return
               shaft%values(:, cam) = values
            end do
            call add_cams(shaft, shaft%values, torques)
         end if
         with_states = .false.
         if (present(bearings)) with_states = allocated(bearings)
         if (with_states) then
            call bearing_torques(shaft, shaft%forces, torques(of_bearings, :), error, bearings, angle)
         else
            call bearing_torques(shaft, shaft%forces, torques(of_bearings, :), error, angle=angle)
         end if
         torques(of_shaft_drag, :) = shaft%drag
      end associate
   end subroutine shaft_torques

   !> Torques of the followers of each camshaft together, and the force on each cam in the frame of the first follower.
   pure subroutine add_cams(shaft, cams, torques)
      !> The shaft; out: with the forces
      type(shaft_t), intent(inout) :: shaft
      !> What each cam takes from its follower, shape (value, cam); those of twins are not used [N m, N]
      real(wp), intent(in), contiguous :: cams(:, :)
      !> The torques [N m], last the energy residual [W], shape (torque, camshaft)
      real(wp), intent(out), contiguous :: torques(:, :)

      integer :: cam

      torques = 0.0_wp
      do cam = 1, size(shaft%lobes)
         associate (twin => shaft%twins(cam))
            call add_torques(cams(:torque_count, twin), torques(:, shaft%shafts(cam)))
            shaft%forces(:, cam) = in_common_frame(shaft, cam, cams(torque_count + 1:, twin))
         end associate
      end do
   end subroutine add_cams

   !> Add torques, whose number is known to the compiler.
   pure subroutine add_torques(torques, sums)
      !> What to add, and the sums [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)
      real(wp), intent(inout) :: sums(torque_count)

      sums = sums + torques
   end subroutine add_torques

   !> Torques and force of one cam at an angle of the first one: from the curve of the lobe shape where that is good enough.
   subroutine cam_at(solved, cam, angle, values, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> The cam
      integer, intent(in) :: cam
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Torques [N m], last the energy residual [W], and force in the frame of the cam's own follower, zero without bearings [N]
      real(wp), intent(out) :: values(curve_values)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Torques and force of a state that is solved [N m, N]
      real(wp) :: solved_values(curve_values)
      ! Does the curve know the torques, the force?
      logical :: is_known(2)

      associate (shaft => solved%shaft)
         associate (lobe => shaft%lobes(cam), place => angle - shaft%phases(cam))
            call curve_at(solved%curves(lobe), place, values, is_known)
            if (all(is_known)) return
            call state_at(solved%cycles(lobe), solved%models(lobe), place, shaft%hints(cam), state, error, &
               & contact_near(solved%curves(lobe), place))
            if (allocated(error)) return
            solved_values = cam_values(solved%models(lobe), state)
            if (.not. is_known(1)) values(:torque_count) = solved_values(:torque_count)
            if (.not. is_known(2)) values(torque_count + 1:) = solved_values(torque_count + 1:)
         end associate
      end associate
   end subroutine cam_at

   !> Force on a cam in the frame of the first follower.
   pure function in_common_frame(shaft, cam, force) result(turned)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The cam
      integer, intent(in) :: cam
      !> Force in the frame of its own follower [N]
      real(wp), intent(in) :: force(2)
      !> The same force [N]
      real(wp) :: turned(2)

      associate (c => shaft%directions(1, cam), s => shaft%directions(2, cam))
         turned = [c*force(1) - s*force(2), s*force(1) + c*force(2)]
      end associate
   end function in_common_frame

   !> Torque of all bearings of each camshaft; zero where the case has none.
   subroutine bearing_torques(shaft, forces, torques, error, bearings, angle)
      !> The shaft; its room is used
      type(shaft_t), intent(inout) :: shaft
      !> Force on each cam in the frame of the first follower, shape (2, cam) [N]
      real(wp), intent(in), contiguous :: forces(:, :)
      !> The torques [N m]
      real(wp), intent(out) :: torques(:)
      !> Domain error where a bearing law has no solution
      type(error_t), allocatable, intent(out) :: error
      !> States of the bearings, shape (bearing, camshaft)
      type(bearing_state_t), intent(out), optional :: bearings(:, :)
      !> Cam angle of the first cam from full lift; without it bearings follow from the loads of the instant [rad]
      real(wp), intent(in), optional :: angle

      type(bearing_state_t) :: state
      integer :: k, bearing, status

      torques = 0.0_wp
      if (.not. allocated(shaft%journal)) return
      associate (loads => shaft%loads)
         do k = 1, shaft%count
            loads = shaft%pull
            call add_forces(size(forces, 2), size(loads, 2), shaft%shafts, k, shaft%left, shaft%shares, forces, loads)
            ! A neighbour that carries the same, as under a cam midway between two, has the same state
            do bearing = 1, size(loads, 2)
               if (present(angle) .and. (allocated(shaft%warm) .or. allocated(shaft%orbits))) then
                  call state_of_turn(shaft, bearing, k, angle, loads(:, bearing), state, status)
               else if (bearing == 1) then
                  call carry_load(shaft%journal, loads(:, 1), state, status, shaft%touch)
               else if (abs(loads(1, bearing) - loads(1, bearing - 1)) + abs(loads(2, bearing) - loads(2, bearing - 1)) &
                  & > 0.0_wp) then
                  call carry_load(shaft%journal, loads(:, bearing), state, status, shaft%touch)
               end if
               if (status /= journal_solved) then
                  call raise(error, kind_domain, "camshaft bearings: the bearing law has no solution for this load")
                  return
               end if
               torques(k) = torques(k) + state%torque
               if (present(bearings)) bearings(bearing, k) = state
            end do
         end do
      end associate
   end subroutine bearing_torques

   !> State of a bearing by what follows from the whole turn: its own oil, the orbit of its journal.
   pure subroutine state_of_turn(shaft, bearing, k, angle, load, state, status)
      type(shaft_t), intent(in) :: shaft
      !> Bearing and camshaft
      integer, intent(in) :: bearing, k
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Force of the shaft on the bearing [N]
      real(wp), intent(in) :: load(2)
      type(bearing_state_t), intent(out) :: state
      !> `journal_solved` or `journal_without_film`
      integer, intent(out) :: status

      type(journal_t) :: journal
      ! Place of the journal [clearance]
      real(wp) :: place(2)
      integer :: hint

      journal = shaft%journal
      if (allocated(shaft%warm)) journal = shaft%warm(bearing, k)
      status = journal_solved
      hint = 1
      if (allocated(shaft%orbits)) then
         call place_at(shaft%orbits(bearing, k), angle, hint, place)
         call moving_state(journal, place, load, state, shaft%touch)
      else
         call carry_load(journal, load, state, status, shaft%touch)
      end if
      if (.not. allocated(shaft%warm)) return
      state%temperature_rise = shaft%rises(bearing, k)
      state%oil_flow = oil_flow(journal, shaft%speed, state%eccentricity)
   end subroutine state_of_turn

   !> Number of bearings of a camshaft; none where the case has no such bearings.
   pure function bearing_number(shaft) result(number)
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The number
      integer :: number

      number = 0
      if (allocated(shaft%journal)) number = size(shaft%bearings%bearing_positions)
   end function bearing_number

end module camroller_shaft
