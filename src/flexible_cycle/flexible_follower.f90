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
   use camroller_flexible_measures, only : pivot_force
   implicit none
   private

   public :: contact_changes, evaluate_follower, follower_on_path

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

      ! State of the train [state]
      real(wp) :: train(state_size(model))
      integer :: status

      associate (inside => path%time(1) + modulo(angle - path%time(1), two_pi))
         call interpolate_state(path, min(max(inside, path%time(1)), path%time(path%count)), hint, train)
         call evaluate_follower(model, inside, train, resolution, state, status)
      end associate
      if (status /= 0) call raise(error, kind_convergence, "the flexible train has no state at "//cam_angle_text(angle, 3))
   end subroutine follower_on_path

   !> Cam angles of a turn at which cam and roller part or meet: steps end there, so that the middle of each tells.
   function contact_changes(model, path) result(angles)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> The cam angles from full lift, rising [rad]
      real(wp), allocatable :: angles(:)

      type(touch_t) :: touch
      ! Cam angle [rad], state of the train [state]
      real(wp) :: angle, train(state_size(model))
      ! Place and rate of the pivot [m], [m/s]
      real(wp) :: pivot(2)
      integer :: step, hint, status
      logical :: touches, has_touched

      allocate (angles(0))
      pivot = [model%flexible%pivot_place, 0.0_wp]
      do step = 1, path%count - 1
         hint = step
         angle = 0.5_wp*(path%time(step) + path%time(step + 1))
         call interpolate_state(path, angle, hint, train)
         if (allocated(model%flexible%adjuster)) pivot = train([at_plunger, at_plunger_rate])
         call find_touch(model, angle, train(at_finger), train(at_finger_rate), pivot(1), pivot(2), touch, status)
         touches = status == 0 .and. touch%approach > 0.0_wp
         if (step == 1) has_touched = touches
         if (touches .neqv. has_touched) angles = [angles, path%time(step)]
         has_touched = touches
      end do
   end function contact_changes

   !> Geometry of the follower where it is: the cam's at the place of contact, lift and arms as they are.
   pure subroutine place_finger(model, train, now, position)
      !> The model
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
      !> The model
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
