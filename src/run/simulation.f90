!> A follower driven from outside, from one cam angle to the next, speed and oil temperature changing on the way.
!>
!> In: a case, then angles, speeds and temperatures as a host program finds them. Out: torques of the follower,
!> mean over the step and at its end. Everything that is remembered between the steps is in `simulation_t`: cam angle and spin of
!> the roller; a step that fails leaves it as it was, to the last bit. All effects of the case take part. Camshaft bearings need
!> all followers at once and are left to the host.
module camroller_simulation
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_usage, kind_convergence
   use camroller_number_text, only : number_text, integer_text
   use camroller_accuracy, only : resolve_numerics, has_error_control
   use camroller_case, only : case_t, numerics_t
   use camroller_model, only : model_t, set_operating_point, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_catalogue, only : torque_count
   use camroller_balance, only : find_balance
   use camroller_events, only : find_stops_between
   use camroller_spin, only : rolling_speed_at
   use camroller_stick, only : share_at_rest
   use camroller_stick_slip, only : direction_at
   use camroller_cycle, only : cycle_t, integrate_between
   use camroller_cycle_start, only : choose_start
   use camroller_means, only : integrate_torques
   use camroller_run, only : build_model
   implicit none
   private

   public :: simulation_t, outcome_t, start_simulation, advance

   !> A follower between two steps
   type :: simulation_t
      private
      type(model_t) :: model
      !> With method and tolerance
      type(numerics_t) :: numerics
      !> Temperature of the oil that the model is set to [K]
      real(wp) :: oil_temperature = 0.0_wp
      !> Cam angle, 180 at full lift, growing with the turns [rad]
      real(wp) :: angle = 0.0_wp
      !> Spin of the roller [rad/s]
      real(wp) :: roller_spin = 0.0_wp
      !> Scale of the sliding speed, to which the tolerance is relative; zero before the start [m/s]
      real(wp) :: scale = 0.0_wp
   end type simulation_t

   !> What one step gives
   type :: outcome_t
      !> Torque that drives this follower: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_drive, torque_drive
      !> The part of it for losses: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_friction, torque_friction
      !> State of the follower at the end of the step
      type(state_t) :: state
   end type outcome_t

   !> Accuracy of the quasi-static balance over the speed of pure rolling [-]: far below any slip of interest
   real(wp), parameter :: balance_tolerance = 1.0e-12_wp
   !> Longest piece that is integrated in one go [rad]
   real(wp), parameter :: longest_piece = pi
   !> Shortest step over the distance of neighbouring angles [-]: what is stored in spring and masses changes so much over it that
   !> the difference is known to the default accuracy
   real(wp), parameter :: least_spacings = 1.0e6_wp
   !> Turns at most in a step, where a periodic cycle is long reached, and from zero, where angles are still known to 1e-9
   integer, parameter :: most_turns_of_step = 100, most_turns = 1000000

contains

   !> Put a follower at a cam angle with the roller in its quasi-static balance there, or rolling where there is none.
   subroutine start_simulation(simulation, case, cam_angle, error, lobe)
      !> The follower; not to be advanced where there is an error
      type(simulation_t), intent(out) :: simulation
      !> A case; its operating point is that of the start
      type(case_t), intent(in) :: case
      !> Cam angle, pi at full lift [rad]
      real(wp), intent(in) :: cam_angle
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error
      !> Lobe shape that drives it: 1, the case's lift, which is also what is taken without it, or 2, the second lift
      integer, intent(in), optional :: lobe

      type(simulation_t) :: started
      type(position_t) :: position
      ! Sliding speed, least scale of it [m/s]; decay rate [1/rad]; an angle that is not needed [rad]
      real(wp) :: sliding_speed, least_scale, decay_rate, unused
      integer :: evaluations, used_lobe
      logical :: is_found

      used_lobe = 1
      if (present(lobe)) used_lobe = lobe
      call check_start(case, cam_angle, used_lobe, error)
      if (allocated(error)) return
      call build_model(case, used_lobe, started%model, error)
      if (allocated(error)) return
      if (.not. has_error_control(case%numerics)) then
         call raise(error, kind_usage, "start_simulation: the method '"//trim(case%numerics%method)//"' has no error "// &
            & "control; choose 'automatic' or another method with error control")
         return
      end if
      started%numerics = resolve_numerics(case%numerics)
      started%oil_temperature = case%operating_point%oil_temperature
      started%angle = cam_angle
      evaluations = 0
      call choose_start(started%model, unused, sliding_speed, started%scale, least_scale, evaluations)
      call find_balance(started%model, cam_angle - pi, balance_tolerance, position, sliding_speed, decay_rate, is_found)
      started%roller_spin = (rolling_speed_at(started%model, position) - sliding_speed)/started%model%roller_radius
      simulation = started
   end subroutine start_simulation

   !> Refuse a start that cannot be.
   subroutine check_start(case, cam_angle, lobe, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> Lobe shape
      integer, intent(in) :: lobe
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (lobe < 1 .or. lobe > 2) then
         call raise(error, kind_usage, "start_simulation: the lobe must be 1, for the case's lift, or 2, for its second_lift, "// &
            & "not "//integer_text(lobe))
      else if (lobe == 2 .and. .not. allocated(case%second_lift)) then
         call raise(error, kind_usage, "start_simulation: lobe 2 needs a case with second_lift; give the case "// &
            & "one, or take lobe 1")
      else if (.not. ieee_is_finite(cam_angle)) then
         call raise(error, kind_usage, "start_simulation: the cam angle must be a finite number")
      else if (abs(cam_angle) > most_turns*two_pi) then
         call raise(error, kind_usage, "start_simulation: the cam angle must be within "//integer_text(most_turns)// &
            & " turns of zero; leave whole turns out")
      end if
   end subroutine check_start

   !> Advance to a cam angle at a speed and an oil temperature; the roller's spin carries over.
   subroutine advance(simulation, cam_angle, speed, oil_temperature, outcome, error)
      !> The follower; left as it was where there is an error
      type(simulation_t), intent(inout) :: simulation
      !> Cam angle at the end of the step, beyond the present one [rad]
      real(wp), intent(in) :: cam_angle
      !> Cam speed during the step [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil during the step [K]
      real(wp), intent(in) :: oil_temperature
      !> Torques and state; of no meaning where there is an error
      type(outcome_t), intent(out) :: outcome
      !> Usage, deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(simulation_t) :: moved
      ! End of a piece [rad]
      real(wp) :: next
      ! Mean torques of a piece and of the step [N m], last the energy residual [W]
      real(wp) :: torques(torque_count), mean(torque_count)
      integer :: piece, pieces
      ! Direction of sliding at the end, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable :: direction

      call check_step(simulation, cam_angle, error)
      if (allocated(error)) return
      moved = simulation
      call set_point(moved, speed, oil_temperature, error)
      if (allocated(error)) return
      mean = 0.0_wp
      pieces = ceiling((cam_angle - simulation%angle)/longest_piece)
      do piece = 1, pieces
         next = cam_angle
         if (piece < pieces) next = simulation%angle + (cam_angle - simulation%angle)*piece/pieces
         call advance_piece(moved, next, torques, direction, error)
         if (allocated(error)) return
         mean = mean + torques/pieces
      end do
      call state_with_spin(moved, direction, outcome%state, error)
      if (allocated(error)) return
      outcome%mean_torque_friction = sum(mean(2:4))
      outcome%mean_torque_drive = sum(mean(1:5))
      outcome%torque_friction = outcome%state%torque_friction
      outcome%torque_drive = outcome%state%torque_drive
      if (.not. all(ieee_is_finite([outcome%mean_torque_drive, outcome%torque_drive, moved%roller_spin]))) then
         call raise(error, kind_convergence, "advance: torques or spin are not finite")
         return
      end if
      simulation = moved
   end subroutine advance

   !> Refuse a step that cannot be resolved or ended.
   subroutine check_step(simulation, cam_angle, error)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> Cam angle at the end of the step [rad]
      real(wp), intent(in) :: cam_angle
      !> Usage error that says what is allowed
      type(error_t), allocatable, intent(out) :: error

      ! Shortest step [rad]: the lobe's own angles are half a turn less
      real(wp) :: shortest

      if (.not. simulation%scale > 0.0_wp) then
         call raise(error, kind_usage, "advance: the follower has no start; call start_simulation first")
      else if (.not. ieee_is_finite(cam_angle)) then
         call raise(error, kind_usage, "advance: the cam angle must be a finite number")
      else if (.not. cam_angle > simulation%angle) then
         call raise(error, kind_usage, "advance: the cam angle must grow beyond the present "// &
            & number_text(simulation%angle/degree, 10)//" deg")
      else if (cam_angle > most_turns*two_pi) then
         call raise(error, kind_usage, "advance: the cam angle is more than "//integer_text(most_turns)// &
            & " turns from zero; start a new follower with whole turns left out")
      else if (cam_angle - simulation%angle > most_turns_of_step*two_pi) then
         call raise(error, kind_usage, "advance: a step may have "//integer_text(most_turns_of_step)// &
            & " turns at most; the cycle is periodic long before")
      end if
      if (allocated(error)) return
      shortest = least_spacings*spacing(max(abs(cam_angle), abs(simulation%angle)) + pi)
      if (cam_angle - simulation%angle >= shortest) return
      call raise(error, kind_usage, "advance: at this cam angle a step must have at least "//number_text(shortest/degree, 2)// &
         & " deg, "//number_text(least_spacings, 2)//" times the distance of neighbouring numbers there")
   end subroutine check_step

   !> Set speed and oil temperature where they are not what they are already.
   subroutine set_point(simulation, speed, oil_temperature, error)
      !> The follower
      type(simulation_t), intent(inout) :: simulation
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil [K]
      real(wp), intent(in) :: oil_temperature
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      if (all(transfer([speed, oil_temperature], [0_int64]) == &
         & transfer([simulation%model%speed, simulation%oil_temperature], [0_int64]))) return
      call set_operating_point(simulation%model, speed, oil_temperature, error)
      simulation%oil_temperature = oil_temperature
   end subroutine set_point

   !> One piece of a step, shorter than a turn.
   subroutine advance_piece(simulation, to, torques, direction, error)
      !> The follower, with the operating point set
      type(simulation_t), intent(inout) :: simulation
      !> Cam angle at the end [rad]
      real(wp), intent(in) :: to
      !> Mean torques of the follower over the piece [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Direction of sliding at the end, 0 at rest; not allocated where the sliding speed decides
      integer, allocatable, intent(out) :: direction
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: piece
      ! Angles at which the right-hand side has kinks [rad]
      real(wp), allocatable :: stops(:)

      torques = 0.0_wp
      call find_stops_between(simulation%model, simulation%angle - pi, to - pi, stops)
      call integrate_between(piece, simulation%model, simulation%numerics, stops, simulation%scale, simulation%roller_spin, error)
      if (allocated(error)) return
      call integrate_torques(simulation%model, piece, torques, error)
      simulation%angle = to
      if (allocated(piece%phases)) direction = direction_at(piece%phases, to - pi)
   end subroutine advance_piece

   !> State of the follower at its cam angle with its roller's spin.
   subroutine state_with_spin(simulation, direction, state, error)
      !> The follower
      type(simulation_t), intent(in) :: simulation
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

      call evaluate_geometry(simulation%model, simulation%angle - pi, position, status)
      sliding_speed = rolling_speed_at(simulation%model, position) - simulation%roller_spin*simulation%model%roller_radius
      if (status == 0 .and. allocated(direction)) then
         share = real(direction, wp)
         if (direction == 0) then
            sliding_speed = 0.0_wp
            call share_at_rest(simulation%model, simulation%angle - pi, share, status)
         end if
      end if
      if (status == 0) call evaluate_state(simulation%model, simulation%angle - pi, sliding_speed, state, status, share)
      if (status /= 0) call raise(error, kind_convergence, &
         & "advance: no load satisfies the equilibrium of the contact at the end of the step")
   end subroutine state_with_spin

end module camroller_simulation
