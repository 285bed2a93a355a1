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
   use camroller_model, only : model_t, set_operating_point, set_speed, evaluate_geometry
   use camroller_ramp, only : keep_films
   use camroller_gas, only : give_pressure
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state, cam_force
   use camroller_torque_list, only : torque_count, is_loss, is_torque
   use camroller_events, only : find_stops_between
   use camroller_findings, only : join_findings
   use camroller_follower_samples, only : extremes_t
   use camroller_spin, only : rolling_speed_at
   use camroller_spin_piece, only : sliding_speed_of
   use camroller_stick, only : share_at_rest
   use camroller_stick_slip, only : direction_at
   use camroller_follower_piece, only : follower_t, point_t, piece_means_t, cover_piece, fill_nodes, slip_tolerance, most_tries
   use camroller_step_error, only : slip_error_t, judge_point
   use camroller_step_inputs, only : inputs_t, inputs_between, part_number
   implicit none
   private

   public :: follower_t, point_t, outcome_t, step_follower, piece_number
   public :: set_model, set_ramp, fill_outcome, end_piece, check_finite, joined, most_tries, place_t, place_of, put_back

   !> Where a follower is between two steps: what it remembers, and what its model is set to
   type :: place_t
      type(point_t) :: point
      !> Cam speed [rad/s]
      real(wp) :: speed = 0.0_wp
   end type place_t

   !> What one step gives
   type :: outcome_t
      !> Torque that drives this follower: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_drive = 0.0_wp, torque_drive = 0.0_wp
      !> The part of it for losses: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_friction = 0.0_wp, torque_friction = 0.0_wp
      !> By source, the rows of `torque_list`: mean over the step and at its end [N m]; last the energy residual [W]
      real(wp) :: mean_torques(torque_count) = 0.0_wp, torques(torque_count) = 0.0_wp
      !> Force of the follower on the cam at the end of the step, x from the finger's pivot to the cam centre, y at a right angle to
      !> x, to the side to which the finger turns as it opens the valve [N]
      real(wp) :: cam_force(2) = 0.0_wp
      !> Smallest and largest values within the step, at the points that the means are made of and at its end
      type(extremes_t) :: extremes
      !> Estimate of the error of the mean torque that drives [N m]: what the accuracy of the case leaves, not what the inputs
      !> of the host differ from straight lines
      real(wp) :: estimated_error = 0.0_wp
      !> Inputs at both ends of the step
      type(inputs_t) :: inputs(2)
      !> State of the follower at the end of the step
      type(state_t) :: state
      !> Is there a step that gave it, and did not fail?
      logical :: is_of_step = .false.
   end type outcome_t

   !> Longest piece that is integrated in one go [rad]
   real(wp), parameter :: longest_piece = pi
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
      type(slip_error_t) :: errors
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
         call end_piece(piece, pieces, [first, cam_angle], start, finish, next, there)
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
      ! In short pieces the error of the sliding speed has been seen to
      if (.not. (has_state .or. rests_at(direction))) then
         errors = slip_tolerance(follower)
         call judge_point(errors, follower%model, cam_angle - first, outcome%state)
         outcome%estimated_error = outcome%estimated_error + errors%torque
      end if
      if (present(nodes)) nodes(:, ubound(nodes, 2)) = [outcome%cam_force, outcome%torque_drive]
      call check_finite(outcome, follower%point%roller_spin, error)
   end subroutine step_follower

   !> End of one of the equal pieces of a step, and the inputs there.
   pure subroutine end_piece(piece, pieces, ends, start, finish, angle, inputs)
      !> The piece, from 1, and their number
      integer, intent(in) :: piece, pieces
      !> Cam angles at both ends of the step [rad]
      real(wp), intent(in) :: ends(2)
      !> Inputs there
      type(inputs_t), intent(in) :: start, finish
      !> Cam angle at the end of the piece [rad]
      real(wp), intent(out) :: angle
      !> Inputs there
      type(inputs_t), intent(out) :: inputs

      angle = ends(2)
      inputs = finish
      if (piece == pieces) return
      angle = ends(1) + (ends(2) - ends(1))*piece/pieces
      inputs = inputs_between(start, finish, real(piece, wp)/pieces)
   end subroutine end_piece

   !> Refuse an outcome that is not finite.
   subroutine check_finite(outcome, roller_spin, error)
      !> The outcome
      type(outcome_t), intent(in) :: outcome
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: roller_spin
      !> Convergence error
      type(error_t), allocatable, intent(inout) :: error

      if (.not. all(ieee_is_finite([outcome%mean_torque_drive, outcome%torque_drive, roller_spin]))) then
         call raise(error, kind_convergence, "advance: torques or spin are not finite")
      end if
   end subroutine check_finite

   !> Where a follower is.
   pure function place_of(follower) result(place)
      !> The follower
      type(follower_t), intent(in) :: follower
      !> The place
      type(place_t) :: place

      place%point = follower%point
      place%speed = follower%model%speed
   end function place_of

   !> Put a follower back where it was, with its model at the inputs of then. Films solved beforehand stay what they are.
   subroutine put_back(follower, place)
      !> The follower
      type(follower_t), intent(inout) :: follower
      !> Where it was
      type(place_t), intent(in) :: place

      ! Oil that the model had had before has a law
      type(error_t), allocatable :: ignored

      follower%point = place%point
      call keep_films(follower%model, place%speed, place%point%oil_temperature, ignored)
      ! Whatever else has been changed on the way, the next step sets it anew
      follower%is_to_be_set = .true.
   end subroutine put_back

   !> Does the roller rest on friction?
   pure function rests_at(direction) result(verdict)
      !> Direction of sliding, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable, intent(in) :: direction
      !> Does it?
      logical :: verdict

      verdict = .false.
      if (allocated(direction)) verdict = direction == 0
   end function rests_at

   !> Number of pieces that a step is integrated in.
   elemental function piece_number(span) result(pieces)
      !> Cam angle of the step [rad]
      real(wp), intent(in) :: span
      !> The number
      integer :: pieces

      pieces = part_number(span, longest_piece)
   end function piece_number

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
      both%findings = join_findings(one%findings, other%findings)
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

      ! Has the model films solved beforehand that go with its oil, at a speed in their range? Does it keep those that it has?
      logical :: has_films, keeps_films

      associate (point => follower%point)
         has_films = .false.
         if (allocated(follower%model%ehl)) has_films = same_bits(oil_temperature, point%film_temperature) .and. &
            & abs(speed - sum(film_range)*0.5_wp*point%film_speed) <= 0.5_wp*(film_range(2) - film_range(1))*point%film_speed
         if (same_bits(oil_temperature, point%oil_temperature) .and. .not. follower%is_to_be_set) then
            if (.not. (may_solve .and. allocated(follower%model%ehl))) then
               call set_speed(follower%model, speed)
               return
            end if
            if (same_bits(speed, follower%model%speed) .and. has_films) return
         end if
         keeps_films = has_films .or. (allocated(follower%model%ehl) .and. .not. may_solve)
         if (keeps_films) then
            call keep_films(follower%model, speed, oil_temperature, error)
         else
            call set_operating_point(follower%model, speed, oil_temperature, error)
         end if
         point%oil_temperature = oil_temperature
         follower%is_to_be_set = .false.
         if (keeps_films .or. .not. allocated(follower%model%ehl)) return
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
      type(piece_means_t) :: means

      has_state = .false.
      middle = inputs_between(start, finish, 0.5_wp)
      call set_model(follower, middle%speed, middle%oil_temperature, .true., error)
      if (allocated(error)) return
      associate (point => follower%point, model => follower%model, path => follower%piece%path)
         call set_ramp(model, [point%angle, to] - pi, start, finish)
         call find_stops_between(model, point%angle - pi, to - pi, follower%piece%stops)
         call cover_piece(follower, means, error)
         if (present(nodes) .and. .not. allocated(error)) call fill_nodes(model, path, means, [point%angle, to] - pi, nodes, error)
         ! On the way the model has followed the inputs
         if (model%ramp%is_moving .and. abs(model%ramp%temperature_slope) > 0.0_wp) follower%is_to_be_set = .true.
         model%ramp%is_moving = .false.
         if (allocated(error)) return
         outcome%mean_torques = outcome%mean_torques + part*means%torques
         outcome%estimated_error = outcome%estimated_error + part*means%error
         outcome%extremes = joined(outcome%extremes, means%extremes)
         has_state = means%has_states
         if (has_state) outcome%state = means%states(3)
         point%angle = to
         if (allocated(path%phases)) direction = direction_at(path%phases, to - pi)
      end associate
   end subroutine advance_piece

   !> Let speed, oil and gas pressure change between two angles; the pressure is that of the case where the host gives none.
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
      if (.not. allocated(model%gas)) return
      model%gas%is_given = .false.
      if (start%has_pressure) call give_pressure(model%gas, angles, [start%gas_pressure, finish%gas_pressure])
   end subroutine set_ramp

   !> State of the follower at its cam angle with its roller's spin.
   subroutine state_with_spin(follower, direction, state, error)
      type(follower_t), intent(in) :: follower
      !> Direction of sliding, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable, intent(in) :: direction
      type(state_t), intent(out) :: state
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Sliding speed [m/s]; mobilised part of the boundary friction, not allocated where the sliding speed decides [-]
      real(wp) :: sliding_speed
      real(wp), allocatable :: share
      integer :: status

      call evaluate_geometry(follower%model, follower%point%angle - pi, position, status)
      sliding_speed = sliding_speed_of(follower%point%roller_spin*follower%model%roller_radius, follower%point%sliding_speed, &
         & rolling_speed_at(follower%model, position))
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
