!> A follower driven from outside, from one cam angle to the next, speed and oil temperature changing on the way.
!>
!> Layer: solver. In: a case, then angles, speeds and temperatures as a host program finds them. Out: torques of the follower,
!> mean over the step and at its end. Everything that is remembered between the steps is in `simulation_t`: cam angle and spin of
!> the roller. Camshaft bearings need all followers at once and are left to the host.
module camroller_simulation
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_usage, kind_convergence
   use camroller_case, only : case_t, numerics_t
   use camroller_model, only : model_t, set_operating_point, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_catalogue, only : torque_count
   use camroller_balance, only : find_balance
   use camroller_events, only : find_stops_between
   use camroller_spin, only : rolling_speed_at
   use camroller_stick, only : has_stick, share_at_rest, rest_speed
   use camroller_cycle, only : cycle_t, integrate_between
   use camroller_cycle_start, only : choose_start
   use camroller_means, only : integrate_torques
   use camroller_run, only : build_models
   implicit none
   private

   public :: simulation_t, outcome_t, start_simulation, advance

   !> A follower between two steps
   type :: simulation_t
      private
      type(model_t) :: model
      type(numerics_t) :: numerics
      !> Cam angle, 180 at full lift, growing without limit [rad]
      real(wp) :: angle = 0.0_wp
      !> Spin of the roller [rad/s]
      real(wp) :: roller_spin = 0.0_wp
      !> Scale of the sliding speed, to which the tolerance is relative [m/s]
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

   !> Accuracy of the algebraic balance over the speed of pure rolling [-]: far below any slip of interest
   real(wp), parameter :: balance_tolerance = 1.0e-12_wp
   !> Longest piece that is integrated in one go [rad]
   real(wp), parameter :: longest_piece = pi

contains

   !> Put a follower at a cam angle with the roller in its algebraic balance there, or rolling where there is none.
   subroutine start_simulation(simulation, case, cam_angle, error)
      !> The follower
      type(simulation_t), intent(out) :: simulation
      !> A case; its operating point is that of the start
      type(case_t), intent(in) :: case
      !> Cam angle, pi at full lift [rad]
      real(wp), intent(in) :: cam_angle
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(model_t), allocatable :: models(:)
      type(position_t) :: position
      ! Sliding speed, least scale of it [m/s]; decay rate [1/rad]; an angle that is not needed [rad]
      real(wp) :: sliding_speed, least_scale, decay_rate, unused
      integer :: evaluations
      logical :: is_found

      call build_models(case, models, error)
      if (allocated(error)) return
      simulation%model = models(1)
      simulation%numerics = case%numerics
      simulation%angle = cam_angle
      evaluations = 0
      call choose_start(simulation%model, unused, sliding_speed, simulation%scale, least_scale, evaluations)
      call find_balance(simulation%model, cam_angle - pi, balance_tolerance, position, sliding_speed, decay_rate, is_found)
      simulation%roller_spin = (rolling_speed_at(simulation%model, position) - sliding_speed)/simulation%model%roller_radius
   end subroutine start_simulation

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
      !> Torques and state
      type(outcome_t), intent(out) :: outcome
      !> Usage, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Angle reached so far, end of the next piece [rad]; share of the piece in the step [-]
      real(wp) :: reached, next, share
      ! Mean torques of a piece and of the step [N m]; spin of the roller [rad/s]
      real(wp) :: torques(torque_count), mean(torque_count), roller_spin
      integer :: status

      if (.not. cam_angle > simulation%angle) then
         call raise(error, kind_usage, "advance: the cam angle must grow")
         return
      end if
      call set_operating_point(simulation%model, speed, oil_temperature, error)
      if (allocated(error)) return
      mean = 0.0_wp
      roller_spin = simulation%roller_spin
      reached = simulation%angle
      do while (reached < cam_angle)
         next = min(cam_angle, reached + longest_piece)
         call advance_piece(simulation, reached, next, roller_spin, torques, error)
         if (allocated(error)) return
         share = (next - reached)/(cam_angle - simulation%angle)
         mean = mean + share*torques
         reached = next
      end do
      simulation%roller_spin = roller_spin
      simulation%angle = cam_angle
      call state_with_spin(simulation, outcome%state, status)
      if (status /= 0) then
         call raise(error, kind_convergence, "advance: load and friction of the contact have no common solution")
         return
      end if
      outcome%mean_torque_friction = sum(mean(2:4))
      outcome%mean_torque_drive = sum(mean(1:5))
      outcome%torque_friction = outcome%state%torque_friction
      outcome%torque_drive = outcome%state%torque_drive
   end subroutine advance

   !> One piece of a step, shorter than a turn.
   subroutine advance_piece(simulation, from, to, roller_spin, torques, error)
      !> The follower, with the operating point set
      type(simulation_t), intent(in) :: simulation
      !> Cam angle at the start [rad]
      real(wp), intent(in) :: from
      !> Cam angle at the end [rad]
      real(wp), intent(in) :: to
      !> Spin of the roller, from start to end [rad/s]
      real(wp), intent(inout) :: roller_spin
      !> Mean torques of the follower over the piece [N m]
      real(wp), intent(out) :: torques(torque_count)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(cycle_t) :: piece
      ! Angles at which the right-hand side has kinks [rad]
      real(wp), allocatable :: stops(:)

      torques = 0.0_wp
      call find_stops_between(simulation%model, from - pi, to - pi, stops)
      call integrate_between(piece, simulation%model, simulation%numerics, stops, simulation%scale, roller_spin, error)
      if (allocated(error)) return
      call integrate_torques(simulation%model, piece, torques, error)
   end subroutine advance_piece

   !> State of the follower at its cam angle with its roller's spin.
   subroutine state_with_spin(simulation, state, status)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> State
      type(state_t), intent(out) :: state
      !> 0 fine
      integer, intent(out) :: status

      type(position_t) :: position
      ! Sliding speed [m/s]; mobilised part of the boundary friction, not allocated where the sliding speed decides [-]
      real(wp) :: sliding_speed
      real(wp), allocatable :: share

      call evaluate_geometry(simulation%model, simulation%angle - pi, position, status)
      if (status /= 0) return
      sliding_speed = rolling_speed_at(simulation%model, position) - simulation%roller_spin*simulation%model%roller_radius
      if (has_stick(simulation%model) .and. abs(sliding_speed) <= rest_speed(simulation%numerics%tolerance*simulation%scale)) then
         allocate (share)
         sliding_speed = 0.0_wp
         call share_at_rest(simulation%model, simulation%angle - pi, share, status)
         if (status /= 0) return
      end if
      call evaluate_state(simulation%model, simulation%angle - pi, sliding_speed, state, status, share)
   end subroutine state_with_spin

end module camroller_simulation
