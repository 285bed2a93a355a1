!> A flexible train from one cam angle to another, and what a host program does to it between.
!>
!> In: model, state at the first angle, stops. Out: path and state at the last angle; the sliding speed that a spin of the roller
!> makes, and back; the train where an engine stands.
module camroller_flexible_drive
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t
   use camroller_ode_problem, only : counters_t
   use camroller_ode_switching, only : integrate_switching
   use camroller_trajectory, only : trajectory_t
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, first_mode, at_finger_rate, at_speed, &
      & at_sliding, at_plunger_rate
   use camroller_flexible_cycle, only : least_sliding_scale
   use camroller_flexible_turn, only : turn_t, prepare, set_sliding_tolerance
   use camroller_flexible_problem, only : largest_sliding_scale
   use camroller_flexible_solution, only : train_method, tolerance_ratio
   implicit none
   private

   public :: drive_t, drive_train, take_spin, bring_to_rest

   !> A train that is driven piece by piece: the last piece, and room that the next one uses
   type :: drive_t
      !> What integrates; its stops are first and last angle
      type(turn_t) :: turn
      !> Accepted points
      type(trajectory_t) :: path
      !> What was not told apart
      type(resolution_t) :: resolution
   end type drive_t

contains

   !> Integrate between the stops of a drive, which are there.
   subroutine drive_train(drive, model, numerics, sliding_scale, state, step, error)
      !> In: stops; out: the piece
      type(drive_t), intent(inout) :: drive
      !> The model, with a flexible train, which follows the inputs of a host
      type(model_t), intent(in), target :: model
      !> Method and tolerance
      type(numerics_t), intent(in) :: numerics
      !> Size of the sliding speed [m/s]
      real(wp), intent(in) :: sliding_scale
      !> State, from first to last angle [state]
      real(wp), intent(inout) :: state(:)
      !> Step to begin with, zero where none is known; out: to go on with [rad]
      real(wp), intent(inout) :: step
      !> Deck error for an unknown method, convergence error
      type(error_t), allocatable, intent(out) :: error

      type(counters_t) :: counters

      associate (turn => drive%turn)
         call prepare(turn, model, train_method(numerics), tolerance_ratio*numerics%tolerance, error)
         if (allocated(error)) return
         call set_sliding_tolerance(turn, tolerance_ratio*numerics%tolerance*max(least_sliding_scale, min(sliding_scale, &
            & largest_sliding_scale)))
         if (step > 0.0_wp) turn%options%step = step
         drive%resolution = turn%problem%resolution
         call integrate_switching(turn%problem, turn%method, turn%options, turn%stops, state, drive%path, counters, error, step)
      end associate
   end subroutine drive_train

   !> Give a state the sliding speed that belongs to a spin of the roller.
   pure subroutine take_spin(model, angle, spin, state, status)
      !> The model at the inputs of the angle
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> State; out: with its sliding speed [state]
      real(wp), intent(inout) :: state(:)
      !> 0 fine, else the train cannot be in this state
      integer, intent(out) :: status

      type(flexible_state_t) :: now

      call evaluate_train(model, angle, state, resolution_t(), now, status)
      if (status == 0) state(at_sliding) = now%contact%rolling_speed - model%roller_radius*spin
   end subroutine take_spin

   !> End all motion: speeds and waves in the spring. Places stay, and the pressure.
   pure subroutine bring_to_rest(model, state)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(inout) :: state(:)

      state([at_finger_rate, at_speed]) = 0.0_wp
      if (allocated(model%flexible%adjuster)) state(at_plunger_rate) = 0.0_wp
      state(first_mode(model):) = 0.0_wp
   end subroutine bring_to_rest

end module camroller_flexible_drive
