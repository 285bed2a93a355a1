!> One step of a follower with a flexible train driven from outside.
!>
!> In: a follower, the cam angle and the inputs at both ends of a step. Out: torques, extremes, state. What is remembered is the
!> state of the train, with the roller's spin in the place of its sliding speed, so that a cam whose speed jumps meets a train that
!> moves as before.
!>
!> Losses, gas and oil gallery are integrated over each accepted step by the rule of `short_piece`; the torque against spring,
!> masses and oil is the change of the stored energy.
module camroller_flexible_step
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t, add_context, raise, kind_convergence
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_lash_adjuster, only : set_supply
   use camroller_state, only : state_t, cam_force
   use camroller_torque_list, only : torque_count, is_torque, of_geometric, of_roller_inertia
   use camroller_follower_samples, only : extremes_t, widen
   use camroller_trajectory, only : interpolate_state, release_room
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, state_size, at_sliding, &
      & largest_state
   use camroller_flexible_energy, only : energy_slopes
   use camroller_flexible_cycle, only : rest_of_train
   use camroller_flexible_follower, only : evaluate_follower
   use camroller_flexible_drive, only : drive_t, drive_train, take_spin, bring_to_rest
   use camroller_run, only : take_way_out
   use camroller_step_judge, only : judge_state
   use camroller_short_piece, only : places, lobatto_places, lobatto_weights, lobatto_error
   use camroller_follower_step, only : follower_t, outcome_t, piece_number, set_model, set_ramp, fill_outcome, end_piece, &
      & check_finite, joined, most_tries
   use camroller_step_inputs, only : inputs_t, inputs_between
   implicit none
   private

   public :: step_train, place_train, halt_train

   !> Errors of the state over those allowed in a step of the integration [-]: vibrations keep errors for some dozens of steps. With
   !> both decks of a flexible train at 300 to 3200 rev/min, accuracies of 1e-2 and 1e-4, steps of 1 and 4 degrees, mean torques of
   !> single steps err by 4.3 times of what one such error makes, by 8.5 where contacts open. Where friction of joints reverses at
   !> full lift, in cold oil, the valve's speed errs by more for some degrees: of 180 steps of `flexible_friction.nml` six are above
   !> the estimate, by up to 4.3 times (300 rev/min, 25 degC, accuracy 1e-2)
   real(wp), parameter :: accumulated = 10.0_wp

   !> A point of a piece
   type :: sample_t
      type(state_t) :: state
      !> Torques that are integrated [N m], last the energy residual [W]
      real(wp) :: torques(torque_count)
      !> Energy that is stored without the roller's spin, and that of the spin [J]
      real(wp) :: stored, spin
   end type sample_t

contains

   !> Put a follower at a cam angle: at rest on the base circle, opposite full lift, and driven from there at the speed of its case.
   subroutine place_train(follower, cam_angle, error)
      !> The follower, set to the operating point of its case
      type(follower_t), intent(inout), target :: follower
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! State [state]
      real(wp), allocatable :: rest(:)

      associate (point => follower%point)
         call rest_of_train(follower%model, rest, error)
         if (allocated(error)) return
         point%train(:size(rest)) = rest
         point%angle = rest_angle(cam_angle)
         call keep_spin(follower, error)
         if (cam_angle > point%angle .and. .not. allocated(error)) call integrate_piece(follower, cam_angle, error)
      end associate
      ! Of no use any more, and copied with the follower
      call release_room(follower%drive%path)
   end subroutine place_train

   !> Angle of the last whole turn, at which a train starts at rest: the angle itself where it is one but for rounding, be it below
   !> or above.
   elemental function rest_angle(cam_angle) result(angle)
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> The angle, not above the cam angle [rad]
      real(wp) :: angle

      ! Distance over the rounding of the angle, and of the lobe's own, which is half a turn less: whole turns that a host
      ! multiplies, converts from degrees or takes differences of are off by two or three of it [-]
      real(wp), parameter :: roundings = 8.0_wp
      real(wp) :: margin ! [rad]

      margin = roundings*epsilon(1.0_wp)*(abs(cam_angle) + pi)
      angle = cam_angle
      if (abs(cam_angle - two_pi*anint(cam_angle/two_pi)) > margin) angle = cam_angle - modulo(cam_angle, two_pi)
   end function rest_angle

   !> Bring a train to rest.
   pure subroutine halt_train(follower)
      !> The follower
      type(follower_t), intent(inout) :: follower

      associate (n => state_size(follower%model))
         call bring_to_rest(follower%model, follower%point%train(:n))
      end associate
   end subroutine halt_train

   !> Advance a follower in pieces of half a turn at most.
   subroutine step_train(follower, cam_angle, start, finish, outcome, error, nodes)
      !> The follower; of no use where there is an error
      type(follower_t), intent(inout), target :: follower
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
      ! First angle of the step and of a piece, end of a piece [rad]
      real(wp) :: first, left, right
      integer :: i, pieces, each

      first = follower%point%angle
      pieces = piece_number(cam_angle - first)
      each = 0
      if (present(nodes)) each = ubound(nodes, 2)/pieces
      there = start
      do i = 1, pieces
         left = follower%point%angle
         here = there
         call end_piece(i, pieces, [first, cam_angle], start, finish, right, there)
         call set_inputs(follower, right, here, there, error)
         if (.not. allocated(error)) call integrate_piece(follower, right, error)
         if (.not. allocated(error)) call add_means(follower%model, follower%drive, 1.0_wp/pieces, outcome, error)
         if (each > 0 .and. .not. allocated(error)) call sample_nodes(follower%model, follower%drive, [left, right] - pi, &
            & nodes(:, (i - 1)*each:i*each - 1), error)
         ! On the way the model has followed the inputs
         if (abs(follower%model%ramp%temperature_slope) > 0.0_wp) follower%is_to_be_set = .true.
         follower%model%ramp%is_moving = .false.
         if (allocated(error)) return
      end do
      call set_model(follower, finish%speed, finish%oil_temperature, .false., error)
      if (allocated(error)) return
      if (allocated(follower%model%flexible%adjuster)) call set_supply(follower%model%flexible%adjuster, &
         & supply_of(follower%model, finish))
      call fill_outcome(follower%model, outcome)
      call add_state_error(follower, cam_angle - first, follower%drive%resolution, outcome)
      if (present(nodes)) nodes(:, ubound(nodes, 2)) = [outcome%cam_force, outcome%torque_drive]
      call release_room(follower%drive%path)
      call check_finite(outcome, follower%point%roller_spin, error)
   end subroutine step_train

   !> Let the model follow the inputs over a piece.
   subroutine set_inputs(follower, to, start, finish, error)
      type(follower_t), intent(inout) :: follower
      !> Cam angle at the end of the piece [rad]
      real(wp), intent(in) :: to
      !> Inputs at both ends of it
      type(inputs_t), intent(in) :: start, finish
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(inputs_t) :: middle
      ! Cam angles from full lift [rad]; supply pressure at both ends [Pa]
      real(wp) :: ends(2), supply(2)

      middle = inputs_between(start, finish, 0.5_wp)
      call set_model(follower, middle%speed, middle%oil_temperature, .true., error)
      if (allocated(error)) return
      ends = [follower%point%angle, to] - pi
      associate (model => follower%model)
         call set_ramp(model, ends, start, finish)
         if (.not. allocated(model%flexible%adjuster)) return
         supply = [supply_of(model, start), supply_of(model, finish)]
         model%ramp%supply = 0.5_wp*(supply(1) + supply(2))
         model%ramp%supply_slope = (supply(2) - supply(1))/(ends(2) - ends(1))
         model%ramp%is_moving = model%ramp%is_moving .or. abs(model%ramp%supply_slope) > 0.0_wp
         call set_supply(model%flexible%adjuster, model%ramp%supply)
      end associate
   end subroutine set_inputs

   !> Supply pressure of a lash adjuster: that of the host or of the case.
   pure function supply_of(model, inputs) result(pressure)
      !> The model, with an adjuster
      type(model_t), intent(in) :: model
      !> What the host gives
      type(inputs_t), intent(in) :: inputs
      !> Gauge pressure [Pa]
      real(wp) :: pressure

      pressure = model%flexible%adjuster%given%supply_pressure
      if (inputs%has_supply) pressure = inputs%supply_pressure
   end function supply_of

   !> Integrate a piece; where that fails, once more with the method and the tolerances that `run_case` falls back on.
   subroutine integrate_piece(follower, to, error)
      !> The follower, whose train is moved
      type(follower_t), intent(inout), target :: follower
      !> Cam angle at the end [rad]
      real(wp), intent(in) :: to
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(numerics_t) :: numerics
      ! State [state]
      real(wp) :: state(largest_state)
      ! Step of the integration [rad], smallest tolerance that may work [-]
      real(wp) :: step, least
      integer :: try, status
      logical :: has_way_out

      numerics = follower%numerics
      least = 0.0_wp
      has_way_out = .false.
      associate (point => follower%point, model => follower%model, first => follower%point%angle - pi, &
         & n => state_size(follower%model))
         if (.not. allocated(follower%drive%turn%stops)) allocate (follower%drive%turn%stops(2))
         follower%drive%turn%stops(:) = [first, to - pi]
         do try = 1, most_tries
            state = point%train
            step = point%train_step
            call follow_ramp(model, first)
            call take_spin(model, first, point%roller_spin, state(:n), status)
            if (status /= 0) then
               call refuse(first, error)
               return
            end if
            call drive_train(follower%drive, model, numerics, point%scale, state(:n), step, error)
            if (.not. allocated(error)) exit
            if (has_way_out .or. error%kind /= kind_convergence .or. try == most_tries) then
               call add_context(error, "integrating the flexible train")
               return
            end if
            call take_way_out(follower%given, numerics, least, has_way_out)
         end do
         point%train = state
         point%train_step = step
         point%angle = to
         call follow_ramp(model, to - pi)
         call keep_spin(follower, error)
      end associate
   end subroutine integrate_piece

   !> Keep the spin that the roller has.
   subroutine keep_spin(follower, error)
      !> The follower, whose model is set to the inputs
      type(follower_t), intent(inout) :: follower
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(flexible_state_t) :: now
      integer :: status

      associate (point => follower%point, n => state_size(follower%model))
         call evaluate_train(follower%model, point%angle - pi, point%train(:n), follower%drive%resolution, now, status)
         if (status /= 0) call refuse(point%angle - pi, error)
         point%roller_spin = now%contact%roller_spin
      end associate
   end subroutine keep_spin

   !> Refuse a state that a train cannot be in.
   subroutine refuse(angle, error)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      call raise(error, kind_convergence, "the flexible train has no state at "//cam_angle_text(angle, 3))
   end subroutine refuse

   !> Means and extremes of a piece.
   subroutine add_means(model, piece, part, outcome, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      type(drive_t), intent(in) :: piece
      !> Part of the step that the piece is [-]
      real(wp), intent(in) :: part
      !> What the step gives; out: with means and extremes of the piece, and the state at its end
      type(outcome_t), intent(inout) :: outcome
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(sample_t) :: sample, first
      type(extremes_t) :: met
      ! Values at the places of an interval, integrals and errors of them [N m, W]; length of the interval and of all [rad]
      real(wp) :: values(torque_count, places), integrals(torque_count), errors(torque_count), length, span
      integer :: interval, i
      ! Is a point that whose state a step returns?
      logical :: is_end

      integrals = 0.0_wp
      errors = 0.0_wp
      associate (path => piece%path)
         span = path%time(path%count) - path%time(1)
         call take_sample(model, piece, path%time(1), 1, piece%resolution%forces, met, first, error)
         values(:, places) = first%torques
         do interval = 1, path%count - 1
            length = path%time(interval + 1) - path%time(interval)
            values(:, 1) = values(:, places)
            do i = 2, places
               is_end = i == places .and. interval == path%count - 1
               if (.not. allocated(error)) call take_sample(model, piece, path%time(interval) + lobatto_places(i)*length, &
                  & interval, merge(0.0_wp, piece%resolution%forces, is_end), met, sample, error)
               values(:, i) = sample%torques
            end do
            if (allocated(error)) return
            do i = 1, torque_count
               integrals(i) = integrals(i) + length*sum(lobatto_weights*values(i, :))
               errors(i) = errors(i) + length*lobatto_error(values(i, :))
            end do
         end do
      end associate
      integrals(of_geometric) = integrals(of_geometric) + sample%stored - first%stored
      integrals(of_roller_inertia) = sample%spin - first%spin
      outcome%mean_torques = outcome%mean_torques + part/span*integrals
      outcome%estimated_error = outcome%estimated_error + part/span*sum(errors, mask=is_torque)
      outcome%extremes = joined(outcome%extremes, met)
      outcome%state = sample%state
   end subroutine add_means

   !> A point of a piece.
   subroutine take_sample(model, piece, angle, interval, forces, met, sample, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      type(drive_t), intent(in) :: piece
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Interval of the path that holds it
      integer, intent(in) :: interval
      !> Relative error of the contact's forces that is good enough [-]
      real(wp), intent(in) :: forces
      !> Extremes that the point is taken into
      type(extremes_t), intent(inout) :: met
      !> The point
      type(sample_t), intent(out) :: sample
      !> Convergence error; domain error of `judge_state`
      type(error_t), allocatable, intent(out) :: error

      ! State [state]; power on gas less that of the gallery [W]
      real(wp) :: train(largest_state), work
      integer :: hint, status, n

      hint = interval
      n = state_size(model)
      call follow_ramp(model, angle)
      call interpolate_state(piece%path, angle, hint, train(:n))
      call evaluate_follower(model, angle, train(:n), resolution_t(forces, piece%resolution%sliding_speed), sample%state, status, &
         & work)
      if (status /= 0) then
         call refuse(angle, error)
         return
      end if
      sample%torques = sample%state%torques
      sample%torques(of_geometric) = work/model%speed
      sample%torques(of_roller_inertia) = 0.0_wp
      sample%spin = 0.5_wp*model%roller_inertia*sample%state%contact%roller_spin**2
      sample%stored = sample%state%flexible%stored_energy - sample%spin
      call widen(met, model, sample%state, angle)
      call judge_state(model, sample%state, angle, error)
   end subroutine take_sample

   !> Force on the cam and torque at equally spaced angles of a piece, without its end.
   subroutine sample_nodes(model, piece, ends, nodes, error)
      !> The model, which follows the inputs
      type(model_t), intent(inout) :: model
      type(drive_t), intent(in) :: piece
      !> Its first and last angle from full lift [rad]
      real(wp), intent(in) :: ends(2)
      !> Force [N] and torque [N m]
      real(wp), intent(out) :: nodes(:, :)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(sample_t) :: sample
      type(extremes_t) :: met
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i

      do i = 1, size(nodes, 2)
         angle = max(ends(1) + (ends(2) - ends(1))*(i - 1)/size(nodes, 2), piece%path%time(1))
         call take_sample(model, piece, angle, 1, 0.0_wp, met, sample, error)
         if (allocated(error)) return
         nodes(:2, i) = cam_force(model, sample%state)
         nodes(3, i) = sample%state%torque_drive
      end do
   end subroutine sample_nodes

   !> Add to the error of the mean torque what the errors of the state make of it: times the slopes of the stored energy at both
   !> ends, and of the losses over the sliding speed.
   subroutine add_state_error(follower, span, resolution, outcome)
      !> The follower, at the end of the step
      type(follower_t), intent(in) :: follower
      !> Cam angle of the step [rad]
      real(wp), intent(in) :: span
      !> What was not told apart
      type(resolution_t), intent(in) :: resolution
      !> Outcome with the state there
      type(outcome_t), intent(inout) :: outcome

      type(flexible_state_t) :: now
      type(state_t) :: beside
      ! State and its errors [state], slopes of the stored energy [J over the unit of the component]
      real(wp), dimension(largest_state) :: state, errors, slopes
      integer :: status

      associate (point => follower%point, model => follower%model, n => state_size(follower%model))
         errors(:n) = accumulated*follower%drive%turn%options%tolerance
         state = point%train
         call evaluate_train(model, point%angle - pi, state(:n), resolution, now, status)
         if (status == 0) then
            slopes(:n) = energy_slopes(model, state(:n), now)
            outcome%estimated_error = outcome%estimated_error + 2.0_wp*norm2(slopes(:n)*errors(:n))/span
         end if
         state(at_sliding) = state(at_sliding) + errors(at_sliding)
         call evaluate_follower(model, point%angle - pi, state(:n), resolution, beside, status)
         if (status == 0) outcome%estimated_error = outcome%estimated_error + abs(beside%torque_friction &
            & - outcome%state%torque_friction)
      end associate
   end subroutine add_state_error

end module camroller_flexible_step
