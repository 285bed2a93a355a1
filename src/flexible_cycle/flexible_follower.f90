!> The state of a follower with a flexible train, as every follower's state is given.
!>
!> In: model, cam angle, state of the train. Out: `state_t`: contact, torques, energy residual, what a flexible train has beside.
module camroller_flexible_follower
   use camroller_kinds, only : two_pi, wp
   use camroller_cam_angle, only : cam_angle_text
   use camroller_error, only : error_t, kind_convergence, raise
   use camroller_trajectory, only : interpolate_state, trajectory_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t, evaluate_moments, add_acceleration
   use camroller_state, only : state_t, add_along, add_sums
   use camroller_flexible_geometry, only : cross, dot, find_touch, touch_t
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, at_finger, at_finger_rate, &
      & at_lift, at_plunger, at_plunger_rate, at_speed, first_mode, state_size
   use camroller_flexible_energy, only : powers_t, evaluate_powers, stored_energy
   use camroller_joint_forces, only : joint_values_t
   use camroller_torque_list, only : of_geometric, of_guide_side, of_pivot, of_residual, of_roller_inertia, of_seal, of_tip
   use camroller_flexible_sample, only : pivot_force
   implicit none
   private

   public :: contact_changes, evaluate_follower, follower_on_path, follower_over_place

contains

   !> Everything at one angle.
   pure subroutine evaluate_follower(model, angle, train, resolution, state, status, work)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> State of the train [state]
      real(wp), intent(in) :: train(:)
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> State of the follower
      type(state_t), intent(out) :: state
      !> 0 fine, else the train cannot be in this state
      integer, intent(out) :: status
      !> Power on the gas less that of the oil gallery [W]
      real(wp), intent(out), optional :: work

      type(flexible_state_t) :: now
      type(powers_t) :: powers

      call evaluate_train(model, angle, train, resolution, now, status)
      if (status /= 0) return
      call evaluate_powers(model, train, now, powers)
      state%contact = now%contact
      state%gas_force = now%gas_force
      state%spin_acceleration = now%spin_acceleration
      state%moments = moments_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      call place_finger(model, train, now, state%position)
      call add_along(model, state)
      state%boundary_friction = abs(now%contact%boundary_mobilised)
      state%contact_friction = abs(now%contact%shear) + state%boundary_friction + abs(now%contact%rolling_resistance)
      state%torques = powers%losses/model%speed
      state%torques(of_geometric) = (powers%stored + powers%gas - powers%gallery)/model%speed
      state%torques(of_roller_inertia) = powers%spin/model%speed
      state%torques(of_residual) = powers%residual
      if (present(work)) work = powers%gas - powers%gallery
      call add_sums(state)
      state%flexible%damping_powers = powers%dampers
      if (allocated(model%joints)) call take_joints(model, now, state)
      call take_values(model, angle, train, now, state, status)
   end subroutine evaluate_follower

   !> Forces of the sliding joints.
   pure subroutine take_joints(model, now, state)
      !> The model, with joints
      type(model_t), intent(in) :: model
      !> Everything at the state of the train
      type(flexible_state_t), intent(in) :: now
      !> In: torques; out: with the joints
      type(state_t), intent(inout) :: state

      associate (stem => now%joint_friction%stem, torques => state%torques)
         state%joints = joint_values_t(tip_force=stem%tip_force%value, tip_friction=stem%tip_friction%value, &
            & tip_speed=stem%tip_speed%value, seal_friction=stem%seal_friction%value, side_friction=stem%side_friction%value, &
            & upper_force=stem%upper_force, lower_force=stem%lower_force, pivot_force=0.0_wp, torque_tip=torques(of_tip), &
            & torque_seal=torques(of_seal), torque_side=torques(of_guide_side), torque_pivot=torques(of_pivot))
      end associate
      if (allocated(model%joints%pivot)) state%joints%pivot_force = abs(now%joint_friction%ball%force)
   end subroutine take_joints

   !> Everything at one angle of a turn that was integrated.
   subroutine follower_on_path(model, path, resolution, angle, hint, state, error)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Interval of the turn where the search starts
      integer, intent(inout) :: hint
      !> State of the follower
      type(state_t), intent(out) :: state
      !> Convergence error where the train cannot be in that state
      type(error_t), allocatable, intent(out) :: error

      ! State of the train [state]; cam angle within the turn [rad]
      real(wp) :: train(state_size(model)), inside
      integer :: status

      inside = angle_inside(path, angle)
      call interpolate_state(path, inside, hint, train)
      call evaluate_follower(model, inside, train, resolution, state, status)
      if (status /= 0) call raise(error, kind_convergence, "the flexible train has no state at "//cam_angle_text(angle, 3))
   end subroutine follower_on_path

   !> State on a turn when the roller is over a place of the cam: the train bends, so that it is there a little earlier or later
   !> than at that cam angle. Where the roller goes back and forth over the place, it is one of these times.
   subroutine follower_over_place(model, path, resolution, place, hint, state, error)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Cam angle from full lift at which a rigid train touches the place [rad]
      real(wp), intent(in) :: place
      !> Interval of the turn where the search starts
      integer, intent(inout) :: hint
      !> State of the follower
      type(state_t), intent(out) :: state
      !> Convergence error where the train cannot be in that state
      type(error_t), allocatable, intent(out) :: error

      ! A finger that swings by 10 micrometres at 1 kHz changes the turn from cam angle to place, some 1e-3 rad, by 0.03 rad/rad at
      ! 900 rev/min: so much of the error each step leaves
      integer, parameter :: steps = 4
      type(touch_t) :: touch
      ! Cam angle [rad]
      real(wp) :: angle
      integer :: i, status

      angle = angle_inside(path, place)
      do i = 1, steps
         call touch_on_path(model, path, angle, hint, touch, status)
         if (status == 0) angle = angle_inside(path, place - (touch%angle - angle))
      end do
      call follower_on_path(model, path, resolution, angle, hint, state, error)
   end subroutine follower_over_place

   !> Where cam and roller touch, or would touch next, on a turn.
   subroutine touch_on_path(model, path, angle, hint, touch, status)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> Cam angle from full lift, of this turn [rad]
      real(wp), intent(in) :: angle
      !> Interval of the turn where the search starts
      integer, intent(inout) :: hint
      !> The geometry
      type(touch_t), intent(out) :: touch
      !> 0 fine, else there is no nearest point
      integer, intent(out) :: status

      ! State of the train [state]; place and rate of the pivot [m], [m/s]
      real(wp) :: train(state_size(model)), pivot(2)

      call interpolate_state(path, angle, hint, train)
      pivot = [model%flexible%pivot_place, 0.0_wp]
      if (allocated(model%flexible%adjuster)) pivot = train([at_plunger, at_plunger_rate])
      call find_touch(model, angle, train(at_finger), train(at_finger_rate), pivot(1), pivot(2), touch, status)
   end subroutine touch_on_path

   !> Cam angle within a turn.
   pure function angle_inside(path, angle) result(inside)
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> The same in this turn [rad]
      real(wp) :: inside

      inside = min(path%time(1) + modulo(angle - path%time(1), two_pi), path%time(path%count))
   end function angle_inside

   !> Cam angles of a turn at which cam and roller part or meet: steps end there, so that the middle of each tells.
   function contact_changes(model, path) result(angles)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> The cam angles from full lift, rising [rad]
      real(wp), allocatable :: angles(:)

      type(touch_t) :: touch
      integer :: step, hint, status
      logical :: touches, has_touched

      allocate (angles(0))
      do step = 1, path%count - 1
         hint = step
         call touch_on_path(model, path, 0.5_wp*(path%time(step) + path%time(step + 1)), hint, touch, status)
         touches = status == 0 .and. touch%approach > 0.0_wp
         if (step == 1) has_touched = touches
         if (touches .neqv. has_touched) angles = [angles, path%time(step)]
         has_touched = touches
      end do
   end function contact_changes

   !> Geometry of the follower where it is: the cam's at the place of contact, lift and arms as they are.
   pure subroutine place_finger(model, train, now, position)
      type(model_t), intent(in) :: model
      !> State of the train [state]
      real(wp), intent(in) :: train(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The geometry
      type(position_t), intent(out) :: position

      position = now%touch%position
      position%lift = train(at_lift)
      position%lift_slope = train(at_speed)/model%speed
      position%finger_slope = train(at_finger_rate)/model%speed
      position%arm_angle = train(at_finger) + model%linkage%arm_offset + model%linkage%valve_axis_angle
      position%normal_arm = cross(now%touch%arm, now%touch%normal)
      position%tangent_arm = -dot(now%touch%arm, now%touch%normal)
   end subroutine place_finger

   !> What a flexible train has beside a rigid one.
   pure subroutine take_values(model, angle, train, now, state, status)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> State of the train [state]
      real(wp), intent(in) :: train(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> State of the follower
      type(state_t), intent(inout) :: state
      !> 0, or as the rigid train has it
      integer, intent(out) :: status

      type(position_t) :: rigid
      type(moments_t) :: moments
      integer :: first, n

      call evaluate_geometry(model, angle, rigid, status)
      if (status /= 0) return
      call evaluate_moments(model%train, rigid, model%speed, now%gas_force, moments)
      if (abs(model%speed_slope) > 0.0_wp) call add_acceleration(model%train, rigid, model%speed*model%speed_slope, moments)
      associate (values => state%flexible)
         values%lift_error = train(at_lift) - rigid%lift
         values%gap = max(0.0_wp, -now%cam%approach)
         values%valve_acceleration = now%valve_acceleration
         values%contact_turn = now%touch%angle - angle
         values%load_error = now%contact%load - moments%total/rigid%normal_arm
         values%pad_force = now%pad%force
         values%seat_force = now%seat%force
         values%joint_force = pivot_force(model, train, now)
         ! The spring's mass beside that of its modes moves with the valve
         values%spring_force = now%pad%force + now%seat%force - now%gas_force - now%guide_drag*train(at_speed) &
            & - now%stem_friction &
            & - (model%train%valve_mass - model%flexible%modes%mass/3.0_wp)*now%valve_acceleration
         values%plunger_travel = now%pivot
         values%chamber_pressure = now%pressure
         values%leak_flow = now%flows%leak
         values%check_flow = now%flows%check
         values%stored_energy = stored_energy(model, train, now)
         values%modes = 0.0_wp
         first = first_mode(model)
         do n = 1, model%flexible%modes%count
            values%modes(n) = train(first + 2*(n - 1))
         end do
      end associate
   end subroutine take_values

end module camroller_flexible_follower
