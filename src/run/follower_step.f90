!> One step of a follower driven from outside: pieces, the model set to their inputs, the state at the end.
!>
!> In: a follower, the cam angle and the inputs at both ends of a step. Out: torques, extremes, state. `simulation` checks what
!> comes in and puts the follower back where a step fails.
!>
!> Speed, oil and gas pressure are linear in the cam angle within a step, and their change is part of the equations: what is off
!> is what the host's inputs differ from straight lines, of second order in the step.
module camroller_follower_step
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t, set_operating_point, set_speed, evaluate_geometry
   use camroller_ramp, only : follow_ramp, keep_films
   use camroller_flexible_train, only : largest_state
   use camroller_gas, only : give_pressure
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state, cam_force
   use camroller_torque_list, only : torque_count, is_loss, is_torque
   use camroller_events, only : find_stops_between
   use camroller_follower_samples, only : extremes_t
   use camroller_spin, only : nearby_t, rolling_speed_at
   use camroller_stick, only : share_at_rest
   use camroller_stick_slip, only : direction_at
   use camroller_cycle, only : cycle_t, state_at
   use camroller_flexible_drive, only : drive_t
   use camroller_spin_piece, only : spin_piece_t, integrate_between
   use camroller_means, only : integrate_torques
   use camroller_run, only : take_way_out
   use camroller_short_piece, only : integrate_short
   implicit none
   private

   public :: follower_t, point_t, inputs_t, outcome_t, step_follower, piece_number, inputs_between
   public :: set_model, set_ramp, fill_outcome, joined, most_tries

   !> What a host program gives at an end of a step
   type :: inputs_t
      !> Cam speed, above zero [rad/s]
      real(wp) :: speed = 0.0_wp
      !> Temperature of the oil [K]
      real(wp) :: oil_temperature = 0.0_wp
      !> Does the host give the gas pressure? At both ends of a step or at none; without it that of the case counts
      logical :: has_pressure = .false.
      !> Gauge pressure that presses the valve shut [Pa]
      real(wp) :: gas_pressure = 0.0_wp
      !> Does the host give the supply pressure of the lash adjuster? As for the gas pressure
      logical :: has_supply = .false.
      !> Gauge pressure of the oil at the adjuster [Pa]
      real(wp) :: supply_pressure = 0.0_wp
   end type inputs_t

   !> What is remembered between steps
   type :: point_t
      !> Cam angle, pi at full lift, growing with the turns [rad]
      real(wp) :: angle = 0.0_wp
      !> Spin of the roller [rad/s]
      real(wp) :: roller_spin = 0.0_wp
      !> Scale of the sliding speed, to which the tolerance is relative; zero before the start [m/s]
      real(wp) :: scale = 0.0_wp
      !> Temperature of the oil that the model is set to, and that of the films solved beforehand [K]
      real(wp) :: oil_temperature = 0.0_wp, film_temperature = 0.0_wp
      !> Cam speed of the films solved beforehand [rad/s]
      real(wp) :: film_speed = 0.0_wp
      !> Contact from which the next one is looked for: tangential force [N], torque of the bearing [N m] and film ratio [-], which
      !> is zero for none
      real(wp) :: contact(3) = 0.0_wp
      !> Step that the integration of a flexible train begins with; zero before its first [rad]
      real(wp) :: train_step = 0.0_wp
      !> State of a flexible train, the rest zero [state]; the roller's spin stands for its sliding speed
      real(wp) :: train(largest_state) = 0.0_wp
   end type point_t

   !> A follower between two steps
   type :: follower_t
      type(model_t) :: model
      !> As given, and with method and tolerance
      type(numerics_t) :: given, numerics
      type(point_t) :: point
      !> Lobe shape
      integer :: lobe = 1
      !> Mark of the model at the start
      integer(int64) :: mark = 0_int64
      !> The last piece of the last step; no step depends on it, but the next one uses its room
      type(spin_piece_t) :: piece
      !> The same of a flexible train
      type(drive_t) :: drive
   end type follower_t

   !> What one step gives
   type :: outcome_t
      !> Torque that drives this follower: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_drive = 0.0_wp, torque_drive = 0.0_wp
      !> The part of it for losses: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_friction = 0.0_wp, torque_friction = 0.0_wp
      !> By source, the rows of `torque_list`: mean over the step and at its end [N m]; last the energy residual [W]
      real(wp) :: mean_torques(torque_count) = 0.0_wp, torques(torque_count) = 0.0_wp
      !> Force of the follower on the cam, x from the finger's pivot to the cam centre, at the end of the step [N]
      real(wp) :: cam_force(2) = 0.0_wp
      !> Smallest and largest values within the step, at the points that the means are made of and at its end
      type(extremes_t) :: extremes
      !> Estimate of the error of the mean torque that drives [N m]: what the accuracy of the case leaves, not what the inputs
      !> of the host differ from straight lines
      real(wp) :: estimated_error = 0.0_wp
      !> State of the follower at the end of the step
      type(state_t) :: state
   end type outcome_t

   !> Longest piece that is integrated in one go [rad]
   real(wp), parameter :: longest_piece = pi
   !> Tries of a piece with other methods and tolerances
   integer, parameter :: most_tries = 3
   !> Speeds over that of films solved beforehand between which those films serve [-]: the table reaches further on both sides
   real(wp), parameter :: film_range(2) = [0.5_wp, 1.1_wp]

contains

   !> Advance in pieces shorter than a turn.
   subroutine step_follower(follower, cam_angle, start, finish, outcome, error, nodes)
      !> The follower; of no use where there is an error
      type(follower_t), intent(inout) :: follower
      !> Cam angle at the end of the step [rad]
      real(wp), intent(in) :: cam_angle
      !> Inputs at the start and at the end of the step
      type(inputs_t), intent(in) :: start, finish
      !> Torques and state
      type(outcome_t), intent(inout) :: outcome
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Force on the cam [N] and torque that drives it [N m] at equally spaced angles of the step, the same number in each piece,
      !> shape (3, angles)
      real(wp), intent(out), optional :: nodes(:, 0:)

      type(inputs_t) :: here, there
      ! First angle, end of a piece [rad]
      real(wp) :: first, next
      integer :: piece, pieces, places
      ! Has the state at the end been evaluated?
      logical :: has_state
      ! Direction of sliding at the end, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable :: direction

      first = follower%point%angle
      pieces = piece_number(cam_angle - first)
      places = 0
      if (present(nodes)) places = ubound(nodes, 2)/pieces
      there = start
      do piece = 1, pieces
         here = there
         next = cam_angle
         there = finish
         if (piece < pieces) then
            next = first + (cam_angle - first)*piece/pieces
            there = inputs_between(start, finish, real(piece, wp)/pieces)
         end if
         if (places > 0) then
            call advance_piece(follower, next, here, there, 1.0_wp/pieces, outcome, has_state, direction, error, &
               & nodes(:, (piece - 1)*places:piece*places - 1))
         else
            call advance_piece(follower, next, here, there, 1.0_wp/pieces, outcome, has_state, direction, error)
         end if
         if (allocated(error)) return
      end do
      call set_model(follower, finish%speed, finish%oil_temperature, .false., error)
      if (.not. (allocated(error) .or. has_state)) call state_with_spin(follower, direction, outcome%state, error)
      if (allocated(error)) return
      call fill_outcome(follower%model, outcome)
      associate (contact => outcome%state%contact)
         follower%point%contact = 0.0_wp
         if (contact%is_touching) follower%point%contact = [contact%tangential_force, contact%bearing_torque, contact%film_ratio]
      end associate
      call add_slip_error(follower, cam_angle - first, outcome)
      if (present(nodes)) then
         nodes(:2, ubound(nodes, 2)) = outcome%cam_force
         nodes(3, ubound(nodes, 2)) = outcome%torque_drive
      end if
      if (.not. all(ieee_is_finite([outcome%mean_torque_drive, outcome%torque_drive, follower%point%roller_spin]))) then
         call raise(error, kind_convergence, "advance: torques or spin are not finite")
      end if
   end subroutine step_follower

   !> Number of pieces that a step is integrated in.
   elemental function piece_number(span) result(pieces)
      !> Cam angle of the step [rad]
      real(wp), intent(in) :: span
      !> The number
      integer :: pieces

      pieces = ceiling(span/longest_piece)
   end function piece_number

   !> Add to the error of the mean torque what the error of the sliding speed makes of it: its tolerance, times the slope of the
   !> torque at the end of the step, and as a difference of the roller's energy between start and end. In the slope load and film
   !> stay as they are, and what slip adds to one loss and takes from another does not cancel. Where the roller rests on friction,
   !> nothing slides.
   pure subroutine add_slip_error(follower, span, outcome)
      !> The follower, at the end of the step
      type(follower_t), intent(in) :: follower
      !> Cam angle of the step [rad]
      real(wp), intent(in) :: span
      !> Outcome with the state there
      type(outcome_t), intent(inout) :: outcome

      ! Error of the sliding speed [m/s]; change of the power lost in the contact and in the bearing with it [W s/m]
      real(wp) :: slip_error, slope

      slip_error = follower%numerics%tolerance*follower%point%scale
      associate (model => follower%model, contact => outcome%state%contact)
         if (abs(contact%sliding_speed) <= 0.0_wp) return
         if (model%is_consistent) outcome%estimated_error = outcome%estimated_error + 2.0_wp*model%roller_inertia &
            & *abs(follower%point%roller_spin)*slip_error/(model%roller_radius*span)
         slope = abs(contact%traction + contact%sliding_speed*contact%traction_slope) + abs(contact%rolling_resistance) &
            & + abs(contact%bearing_torque)/model%roller_radius
         if (.not. model%is_consistent) slope = abs(contact%traction_slope*outcome%state%position%cam_arm)*model%speed &
            & + abs(contact%bearing_torque)/model%roller_radius
         outcome%estimated_error = outcome%estimated_error + slope*slip_error/model%speed
      end associate
   end subroutine add_slip_error

   !> What follows from mean torques and the state at the end.
   pure subroutine fill_outcome(model, outcome)
      !> The model, set to the inputs at the end
      type(model_t), intent(in) :: model
      !> Outcome with mean torques and state
      type(outcome_t), intent(inout) :: outcome

      outcome%torques = outcome%state%torques
      outcome%mean_torque_friction = sum(outcome%mean_torques, mask=is_loss)
      outcome%mean_torque_drive = sum(outcome%mean_torques, mask=is_torque)
      outcome%torque_friction = outcome%state%torque_friction
      outcome%torque_drive = outcome%state%torque_drive
      outcome%cam_force = cam_force(model, outcome%state)
   end subroutine fill_outcome

   !> Inputs at a part of a step.
   pure function inputs_between(start, finish, part) result(inputs)
      !> Inputs at its ends
      type(inputs_t), intent(in) :: start, finish
      !> Part of the step, from 0 to 1 [-]
      real(wp), intent(in) :: part
      !> Inputs there
      type(inputs_t) :: inputs

      inputs = start
      inputs%speed = start%speed + (finish%speed - start%speed)*part
      inputs%oil_temperature = start%oil_temperature + (finish%oil_temperature - start%oil_temperature)*part
      inputs%gas_pressure = start%gas_pressure + (finish%gas_pressure - start%gas_pressure)*part
      inputs%supply_pressure = start%supply_pressure + (finish%supply_pressure - start%supply_pressure)*part
   end function inputs_between

   !> Extremes over two pieces.
   pure function joined(one, other) result(both)
      !> Extremes of each
      type(extremes_t), intent(in) :: one, other
      !> Over both
      type(extremes_t) :: both

      both%contact_load = [min(one%contact_load(1), other%contact_load(1)), max(one%contact_load(2), other%contact_load(2))]
      both%torque_drive = [min(one%torque_drive(1), other%torque_drive(1)), max(one%torque_drive(2), other%torque_drive(2))]
      both%sliding_speed = [min(one%sliding_speed(1), other%sliding_speed(1)), max(one%sliding_speed(2), other%sliding_speed(2))]
      both%hertz_pressure = max(one%hertz_pressure, other%hertz_pressure)
      both%film_min = min(one%film_min, other%film_min)
   end function joined

   !> Set speed and oil temperature where they are not what they are already. Films solved beforehand are solved again where the
   !> oil is another, or the speed is out of their range.
   subroutine set_model(follower, speed, oil_temperature, may_solve, error)
      !> The follower
      type(follower_t), intent(inout) :: follower
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil [K]
      real(wp), intent(in) :: oil_temperature
      !> May films be solved?
      logical, intent(in) :: may_solve
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      logical :: has_films

      associate (point => follower%point)
         if (same_bits(oil_temperature, point%oil_temperature) .and. .not. (may_solve .and. allocated(follower%model%ehl))) then
            call set_speed(follower%model, speed)
            return
         end if
         if (same_bits(speed, follower%model%speed) .and. same_bits(oil_temperature, point%oil_temperature) &
            & .and. same_bits(oil_temperature, point%film_temperature)) return
         has_films = allocated(follower%model%ehl) .and. (.not. may_solve .or. (same_bits(oil_temperature, &
            & point%film_temperature) .and. abs(speed - sum(film_range)*0.5_wp*point%film_speed) &
            & <= 0.5_wp*(film_range(2) - film_range(1))*point%film_speed))
         if (has_films) then
            call keep_films(follower%model, speed, oil_temperature, error)
         else
            call set_operating_point(follower%model, speed, oil_temperature, error)
         end if
         point%oil_temperature = oil_temperature
         if (has_films .or. .not. allocated(follower%model%ehl)) return
         point%film_temperature = oil_temperature
         point%film_speed = speed
      end associate
   end subroutine set_model

   !> Are two numbers the same, bit by bit?
   elemental function same_bits(one, other) result(same)
      !> Both [any]
      real(wp), intent(in) :: one, other
      !> Are they?
      logical :: same

      same = transfer(one, 0_int64) == transfer(other, 0_int64)
   end function same_bits

   !> One piece of a step, shorter than a turn.
   subroutine advance_piece(follower, to, start, finish, part, outcome, has_state, direction, error, nodes)
      !> The follower
      type(follower_t), intent(inout) :: follower
      !> Cam angle at the end [rad]
      real(wp), intent(in) :: to
      !> Inputs at the start and at the end of the piece
      type(inputs_t), intent(in) :: start, finish
      !> Part of the step that the piece is [-]
      real(wp), intent(in) :: part
      !> What the step gives; out: with means and extremes of the piece, and its state at the end where that has been evaluated
      type(outcome_t), intent(inout) :: outcome
      !> Has it?
      logical, intent(out) :: has_state
      !> Direction of sliding at the end, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable, intent(out) :: direction
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Force on the cam [N] and torque that drives it [N m] at equally spaced angles from the start on, without the end
      real(wp), intent(out), optional :: nodes(:, :)

      type(inputs_t) :: middle
      type(extremes_t) :: met
      type(nearby_t) :: nearby
      ! States at the ends and in the middle of a short piece
      type(state_t) :: states(3)
      ! Mean torques [N m], last the energy residual [W]; error of the mean torque that drives, by its integration [N m]
      real(wp) :: torques(torque_count), torque_error
      integer :: i

      middle = inputs_between(start, finish, 0.5_wp)
      call set_model(follower, middle%speed, middle%oil_temperature, .true., error)
      if (allocated(error)) return
      associate (point => follower%point, model => follower%model, path => follower%piece%path)
         call set_ramp(model, [point%angle, to] - pi, start, finish)
         if (allocated(model%gas)) then
            model%gas%is_given = .false.
            if (start%has_pressure) call give_pressure(model%gas, [point%angle, to] - pi, [start%gas_pressure, finish%gas_pressure])
         end if
         call find_stops_between(model, point%angle - pi, to - pi, follower%piece%stops)
         call integrate_piece(follower, nearby, error)
         has_state = .false.
         if (size(follower%piece%stops) == 2 .and. .not. allocated(error)) call integrate_short(model, path, nearby, states, &
            & torques, torque_error, met, has_state, error)
         if (.not. (allocated(error) .or. has_state)) call integrate_torques(model, path, torques, error, met, torque_error)
         if (present(nodes) .and. .not. allocated(error)) then
            if (has_state .and. size(nodes, 2) == 2) then
               do i = 1, 2
                  nodes(:2, i) = cam_force(model, states(i))
                  nodes(3, i) = states(i)%torque_drive
               end do
            else
               call sample_nodes(model, path, [point%angle, to] - pi, nodes, error)
            end if
         end if
         ! On the way the model has followed the inputs
         if (model%ramp%is_moving .and. abs(model%ramp%temperature_slope) > 0.0_wp) point%oil_temperature = -1.0_wp
         model%ramp%is_moving = .false.
         if (allocated(error)) return
         outcome%mean_torques = outcome%mean_torques + part*torques
         outcome%estimated_error = outcome%estimated_error + part*torque_error
         outcome%extremes = joined(outcome%extremes, met)
         if (has_state) outcome%state = states(3)
         point%angle = to
         if (allocated(path%phases)) direction = direction_at(path%phases, to - pi)
      end associate
   end subroutine advance_piece

   !> Force on the cam and torque at equally spaced angles of a piece, without its end.
   subroutine sample_nodes(model, piece, ends, nodes, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      !> The piece
      type(cycle_t), intent(in) :: piece
      !> Its first and last angle from full lift [rad]
      real(wp), intent(in) :: ends(2)
      !> Force [N] and torque [N m]
      real(wp), intent(out) :: nodes(:, :)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i, hint

      hint = 1
      do i = 1, size(nodes, 2)
         angle = ends(1) + (ends(2) - ends(1))*(i - 1)/size(nodes, 2)
         call follow_ramp(model, angle)
         call state_at(piece, model, angle, hint, state, error)
         if (allocated(error)) return
         nodes(:2, i) = cam_force(model, state)
         nodes(3, i) = state%torque_drive
      end do
   end subroutine sample_nodes

   !> Let speed and oil change between two angles.
   pure subroutine set_ramp(model, angles, start, finish)
      !> The model, set to the middle
      type(model_t), intent(inout) :: model
      !> Cam angles from full lift [rad]
      real(wp), intent(in) :: angles(2)
      !> Inputs there
      type(inputs_t), intent(in) :: start, finish

      associate (ramp => model%ramp, span => angles(2) - angles(1))
         ramp%is_moving = .not. all(same_bits([start%speed, start%oil_temperature], [finish%speed, finish%oil_temperature]))
         ramp%angle = 0.5_wp*(angles(1) + angles(2))
         ramp%speed = model%speed
         model%speed_slope = (finish%speed - start%speed)/span
         ramp%temperature = 0.5_wp*(start%oil_temperature + finish%oil_temperature)
         ramp%temperature_slope = (finish%oil_temperature - start%oil_temperature)/span
      end associate
   end subroutine set_ramp

   !> Integrate a piece; where that fails, once more with the method and the tolerances that `run_case` falls back on.
   subroutine integrate_piece(follower, nearby, error)
      !> The follower, with the stops of its piece; its roller's spin is moved
      type(follower_t), intent(inout) :: follower
      !> First and last contact that the integration has solved
      type(nearby_t), intent(out) :: nearby
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(numerics_t) :: numerics
      ! Spin at the start [rad/s]; smallest tolerance that may work [-]
      real(wp) :: spin, least
      integer :: try
      logical :: has_way_out

      numerics = follower%numerics
      least = 0.0_wp
      has_way_out = .false.
      do try = 1, most_tries
         spin = follower%point%roller_spin
         nearby%has_first = .false.
         associate (start => nearby%last, kept => follower%point%contact)
            start%is_touching = kept(3) > 0.0_wp
            start%tangential_force = kept(1)
            start%bearing_torque = kept(2)
            start%film_ratio = kept(3)
         end associate
         call integrate_between(follower%piece, follower%model, numerics, follower%point%scale, spin, error, nearby)
         if (.not. allocated(error)) exit
         if (has_way_out .or. error%kind /= kind_convergence .or. try == most_tries) return
         call take_way_out(follower%given, numerics, least, has_way_out)
      end do
      follower%point%roller_spin = spin
   end subroutine integrate_piece

   !> State of the follower at its cam angle with its roller's spin.
   subroutine state_with_spin(follower, direction, state, error)
      !> The follower
      type(follower_t), intent(in) :: follower
      !> Direction of sliding, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable, intent(in) :: direction
      !> State
      type(state_t), intent(out) :: state
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Sliding speed [m/s]; mobilised part of the boundary friction, not allocated where the sliding speed decides [-]
      real(wp) :: sliding_speed
      real(wp), allocatable :: share
      integer :: status

      call evaluate_geometry(follower%model, follower%point%angle - pi, position, status)
      sliding_speed = rolling_speed_at(follower%model, position) - follower%point%roller_spin*follower%model%roller_radius
      if (status == 0 .and. allocated(direction)) then
         share = real(direction, wp)
         if (direction == 0) then
            sliding_speed = 0.0_wp
            call share_at_rest(follower%model, follower%point%angle - pi, share, status)
         end if
      end if
      if (status == 0) call evaluate_state(follower%model, follower%point%angle - pi, sliding_speed, state, status, share)
      if (status /= 0) call raise(error, kind_convergence, &
         & "advance: no load satisfies the equilibrium of the contact at the end of the step")
   end subroutine state_with_spin

end module camroller_follower_step
