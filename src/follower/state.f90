!> The complete state of one follower at one cam angle: geometry, loads, contact, spin, torques.
!>
!> In: model, cam angle, sliding speed. Out: `state_t`, in one visible sequence; no side effects.
module camroller_state
   use camroller_kinds, only : wp
   use camroller_axial_table, only : axial_state, axial_state_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t, evaluate_moments, add_acceleration, kinetic_energy, stored_power
   use camroller_gas, only : gas_force
   use camroller_contact, only : solve_contact
   use camroller_guide, only : find_guide_drag
   use camroller_joint_forces, only : joint_basis_t, joint_values_t, no_joints, evaluate_joints
   use camroller_contact_forces, only : contact_t
   use camroller_roller, only : spin_acceleration
   use camroller_flexible_parts, only : damper_count
   use camroller_spring_modes, only : most_modes
   use camroller_torque, only : cam_torque, contact_power, normal_direction
   use camroller_torque_list, only : torque_count, sum_of_losses, sum_of_torques, of_geometric, of_contact, of_needle, of_guide, &
      & of_roller_inertia, of_residual, of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag
   implicit none
   private

   public :: state_t, flexible_values_t, evaluate_state, complete_state, evaluate_spin, evaluate_loading, add_torques, &
      & add_along, add_sums, cam_force, flight_torque

   !> What a flexible train has beside a rigid one
   type :: flexible_values_t
      !> Lift less that of the rigid train, gap between cam and roller [m]
      real(wp) :: lift_error, gap
      !> Acceleration of the valve [m/s^2]
      real(wp) :: valve_acceleration
      !> Angle by which the place of contact is ahead of the cam's turn [rad]
      real(wp) :: contact_turn
      !> Load less that of the rigid train without friction [N]
      real(wp) :: load_error
      !> Forces of pad, seat, joint of finger and pivot, spring at the valve [N]
      real(wp) :: pad_force, seat_force, joint_force, spring_force
      !> Travel of the plunger [m], pressure in its chamber [Pa], leak and flow of the check valve [m^3/s]
      real(wp) :: plunger_travel, chamber_pressure, leak_flow, check_flow
      !> Energy that is stored [J]
      real(wp) :: stored_energy
      !> Power lost in each damper [W]
      real(wp) :: damping_powers(damper_count)
      !> Amplitudes of the spring's modes [m]
      real(wp) :: modes(most_modes)
   end type flexible_values_t

   !> State of one follower; torques are on the camshaft, from this follower alone
   type :: state_t
      type(position_t) :: position
      type(moments_t) :: moments
      type(contact_t) :: contact
      !> Cylinder pressure times valve area [N]
      real(wp) :: gas_force
      !> Angular acceleration of the roller [rad/s^2]
      real(wp) :: spin_acceleration
      !> Boundary friction that is counted, all or mobilised [N]
      real(wp) :: boundary_friction
      !> Friction of the contact, `(1 - A_r/A_a)|F_h| + F_b + F_r` [N]
      real(wp) :: contact_friction
      !> Torques of this follower by source, the rows of `torque_list` [N m], last the energy residual: the power that the cam needs
      !> by its own equilibrium, less losses, less what is stored [W]; zero where the bookkeeping is not consistent
      real(wp) :: torques(torque_count)
      !> Sum of the losses as torque [N m]
      real(wp) :: torque_friction
      !> Sum of everything [N m]
      real(wp) :: torque_drive
      !> Sliding joints, where the case has any
      type(joint_values_t) :: joints
      !> Load along the roller, where the case has its profile and the contact touches; else not set
      type(axial_state_t) :: along
      !> What a flexible train has beside
      type(flexible_values_t) :: flexible
   end type state_t

contains

   !> Geometry and moments: what depends on the cam angle alone.
   pure subroutine evaluate_loading(model, angle, position, force, moments, status, moments_only)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Geometry there
      type(position_t), intent(out) :: position
      !> Cylinder pressure times valve area [N]
      real(wp), intent(out) :: force
      !> Moments about the pivot
      type(moments_t), intent(out) :: moments
      !> 0 fine, negative: the finger cannot reach this lift
      integer, intent(out) :: status
      !> May all of the geometry be left out that moments do not take, see `evaluate_position`? Friction of joints asks for more
      logical, intent(in), optional :: moments_only

      force = 0.0_wp
      call evaluate_geometry(model, angle, position, status, moments_only=moments_only)
      if (status /= 0) return
      if (allocated(model%gas)) force = gas_force(model%gas, angle)
      call evaluate_moments(model%train, position, model%speed, force, moments)
      if (abs(model%speed_slope) > 0.0_wp) call add_acceleration(model%train, position, model%speed*model%speed_slope, moments)
   end subroutine evaluate_loading

   !> Contact and angular acceleration of the roller: what the integration of its spin needs.
   pure subroutine evaluate_spin(model, position, moments, sliding_speed, contact, acceleration, status, accuracy, &
      & mobilised, start, joints)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> State of the contact
      type(contact_t), intent(out) :: contact
      !> Angular acceleration of the roller [rad/s^2]
      real(wp), intent(out) :: acceleration
      !> 0 fine, positive: no balance found
      integer, intent(out) :: status
      !> Relative error of load and forces that is good enough; absent: round-off [-]
      real(wp), intent(in), optional :: accuracy
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> What the joints have at this angle, where the balance takes it
      type(joint_basis_t), allocatable, intent(out), optional :: joints

      call solve_contact(model, position, moments, sliding_speed, contact, status, accuracy, mobilised, start, joints)
      acceleration = acceleration_in(model, contact)
   end subroutine evaluate_spin

   !> Everything at one angle.
   pure subroutine evaluate_state(model, angle, sliding_speed, state, status, mobilised, start, accuracy, further_moment)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> State
      type(state_t), intent(out) :: state
      !> 0 fine, negative: the finger cannot reach this lift, positive: no balance found
      integer, intent(out) :: status
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> Relative error of load and forces that is good enough; absent: round-off [-]
      real(wp), intent(in), optional :: accuracy
      !> Further moment about the pivot by which the valve's tip presses the roller on the cam; absent: none [N m]
      real(wp), intent(in), optional :: further_moment

      type(joint_basis_t), allocatable :: joints

      call evaluate_loading(model, angle, state%position, state%gas_force, state%moments, status)
      if (status /= 0) return
      if (present(further_moment)) then
         state%moments%spring = state%moments%spring + further_moment
         state%moments%total = state%moments%total + further_moment
      end if
      call evaluate_spin(model, state%position, state%moments, sliding_speed, state%contact, state%spin_acceleration, status, &
         & accuracy, mobilised, start, joints)
      if (status /= 0) return
      call add_torques(model, state, joints)
   end subroutine evaluate_state

   !> Everything at an angle at which the contact is solved.
   pure subroutine complete_state(model, angle, contact, state, status)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The contact there
      type(contact_t), intent(in) :: contact
      !> State
      type(state_t), intent(out) :: state
      !> 0 fine, negative: the finger cannot reach this lift
      integer, intent(out) :: status

      call evaluate_loading(model, angle, state%position, state%gas_force, state%moments, status)
      if (status /= 0) return
      state%contact = contact
      state%spin_acceleration = acceleration_in(model, contact)
      call add_torques(model, state)
   end subroutine complete_state

   !> Load along the roller of a state whose contact is solved.
   pure subroutine add_along(model, state)
      !> The model
      type(model_t), intent(in) :: model
      !> State with its contact solved
      type(state_t), intent(inout) :: state

      if (allocated(model%axial) .and. state%contact%is_touching) state%along = axial_state(model%axial, state%contact%load, &
         & state%position%equivalent_radius)
   end subroutine add_along

   !> Angular acceleration of the roller in a contact.
   pure function acceleration_in(model, contact) result(acceleration)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      !> The acceleration [rad/s^2]
      real(wp) :: acceleration

      acceleration = spin_acceleration(contact%traction, merge(contact%rolling_resistance, 0.0_wp, &
         & model%has_rolling_in_balance), model%roller_radius, contact%bearing_torque, model%roller_inertia)
   end function acceleration_in

   !> Torques of a state whose contact is solved, with the friction that is reported, the load along the roller and the energy
   !> residual.
   pure subroutine add_torques(model, state, joints)
      !> The model
      type(model_t), intent(in) :: model
      !> State with its contact solved
      type(state_t), intent(inout) :: state
      !> What the joints have at this angle, where it is known
      type(joint_basis_t), intent(in), optional :: joints

      call add_friction(model, state)
      call add_along(model, state)
      state%torques = 0.0_wp
      call add_losses(model, state, joints)
      state%torques(of_geometric) = merge(state%moments%total*state%position%finger_slope, flight_torque(model, state), &
         & state%contact%is_touching)
      if (model%is_consistent) state%torques(of_roller_inertia) = model%roller_inertia*state%contact%roller_spin &
         & *state%spin_acceleration/model%speed
      call add_sums(state)
      if (model%is_consistent) call add_residual(model, state)
   end subroutine add_torques

   !> Torque that the drag of the roller's bearing hands on to a finger without contact, over the cam angle: with it nothing drives
   !> the cam while nothing touches it. Zero with contact, where it is in the balance of the load.
   pure function flight_torque(model, state) result(torque)
      !> The model
      type(model_t), intent(in) :: model
      !> State with its contact solved
      type(state_t), intent(in) :: state
      !> The torque [N m]
      real(wp) :: torque

      torque = 0.0_wp
      if (state%contact%is_touching .or. .not. model%is_consistent) return
      torque = model%linkage%sense*state%contact%bearing_drag*state%position%finger_slope
   end function flight_torque

   !> Torque of the drag that is a loss of its own: that of a pin with a film belongs to its bearing.
   pure function needle_drag(model, contact) result(torque)
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> The torque [N m]
      real(wp) :: torque

      torque = 0.0_wp
      if (allocated(model%drag)) torque = contact%bearing_drag
   end function needle_drag

   !> Losses of a follower as torques: one line for each loss of `torque_list`. The bookkeeping of the source puts the friction of
   !> the contact on the arm of the tangent, and lets the bearing slide by the whole spin of the roller.
   pure subroutine add_losses(model, state, joints)
      type(model_t), intent(in) :: model
      !> State with its contact solved, and torques of zero
      type(state_t), intent(inout) :: state
      !> What the joints have at this angle, where it is known
      type(joint_basis_t), intent(in), optional :: joints

      ! Drag of the guide over the valve's speed, its slope [N s/m]
      real(wp) :: drag, drag_slope

      associate (torques => state%torques, contact => state%contact)
         if (model%is_consistent) then
            torques(of_contact) = contact_power(contact%traction, contact%sliding_speed, contact%rolling_resistance, &
               & contact%cam_surface_speed, contact%roller_surface_speed)/model%speed
         else
            torques(of_contact) = state%contact_friction*state%position%cam_arm
         end if
         if (allocated(model%bearing)) torques(of_needle) = (contact%bearing_torque - needle_drag(model, contact)) &
            & *merge(contact%relative_spin, contact%roller_spin, model%is_consistent)/model%speed
         if (allocated(model%drag)) torques(of_needle_drag) = contact%bearing_drag*merge(contact%relative_spin, &
            & contact%roller_spin, model%is_consistent)/model%speed
         if (allocated(model%guide) .and. contact%is_touching) then
            call find_guide_drag(model%guide, model%speed*state%position%lift_slope, drag, drag_slope)
            torques(of_guide) = drag*model%speed*state%position%lift_slope**2
         end if
         if (allocated(model%joints)) then
            state%joints = no_joints
            if (contact%is_touching) call evaluate_joints(model, state%position, state%moments, contact%load, &
               & contact%tangential_force, state%joints, joints)
            torques([of_tip, of_seal, of_guide_side, of_pivot]) = [state%joints%torque_tip, state%joints%torque_seal, &
               & state%joints%torque_side, state%joints%torque_pivot]
         end if
      end associate
   end subroutine add_losses

   !> Force of the follower on the cam, x from pivot to cam centre: the load of the camshaft bearings.
   pure function cam_force(model, state) result(force)
      !> The model
      type(model_t), intent(in) :: model
      !> State with its contact solved
      type(state_t), intent(in) :: state
      !> The force [N]
      real(wp) :: force(2)

      ! Unit vectors of load and traction on the roller [-]
      real(wp) :: normal(2), tangent(2)

      call normal_direction(state%position%normal_arm, state%position%tangent_arm, model%linkage%a, state%position%arm_angle, &
         & model%linkage%sense, normal, tangent)
      force = -(state%contact%load*normal + state%contact%tangential_force*tangent)
   end function cam_force

   !> Friction of the contact as it is reported. Source: Islam (2019) eq. (40).
   pure subroutine add_friction(model, state)
      type(model_t), intent(in) :: model
      !> State with its contact solved
      type(state_t), intent(inout) :: state

      state%boundary_friction = abs(state%contact%boundary_mobilised)
      if (allocated(model%boundary)) then
         if (model%boundary%is_full) state%boundary_friction = state%contact%boundary_capacity
      end if
      state%contact_friction = abs(state%contact%shear) + state%boundary_friction + abs(state%contact%rolling_resistance)
   end subroutine add_friction

   !> Energy residual: torque of the cam's equilibrium, which is independent of how losses are added up, less losses and storage.
   pure subroutine add_residual(model, state)
      type(model_t), intent(in) :: model
      !> State with its torques
      type(state_t), intent(inout) :: state

      ! Torque by the cam's equilibrium [N m]; power stored [W]
      real(wp) :: equilibrium, stored

      equilibrium = cam_torque(state%contact%load, state%position%normal_arm, state%position%finger_slope, &
         & state%contact%tangential_force, state%position%cam_arm, state%contact%rolling_resistance, &
         & state%position%equivalent_radius)
      stored = model%roller_inertia*state%contact%roller_spin*state%spin_acceleration
      stored = stored + flight_torque(model, state)*model%speed
      if (state%contact%is_touching) then
         stored = stored + stored_power(model%train, state%position, model%speed, state%gas_force)
         if (abs(model%speed_slope) > 0.0_wp) then
            stored = stored + 2.0_wp*model%speed_slope*kinetic_energy(model%train, state%position, model%speed)
         end if
      end if
      state%torques(of_residual) = equilibrium*model%speed - state%torque_friction*model%speed - stored
   end subroutine add_residual

   !> Sums of the torques: all losses, and everything.
   pure subroutine add_sums(state)
      !> State with its torques by source
      type(state_t), intent(inout) :: state

      state%torque_friction = sum_of_losses(state%torques)
      state%torque_drive = sum_of_torques(state%torques)
   end subroutine add_sums

end module camroller_state
