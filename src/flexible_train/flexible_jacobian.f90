!> Exact derivatives of a flexible train's accelerations.
!>
!> In: everything at a state. Out: derivatives of its rates over the state and over the cam angle. Geometry and contact depend on
!> six variables alone, finger's angle and rate, pivot's place and speed, sliding speed and cam angle; a list of six holds how a
!> quantity follows them. A turn of the contact normal in space is `psi`: `dn = psi e`, `de = -psi n`, e along the roller's way.
module camroller_flexible_jacobian
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_gas, only : gas_force_slope
   use camroller_roller, only : spin_acceleration
   use camroller_lash_adjuster, only : bulk_modulus, chamber_volume
   use camroller_contact_forces, only : motion_t, slopes_t, follow_contact, bearing_by_reversal, has_oil_drag, &
      & oil_drag_slope
   use camroller_flexible_geometry, only : dot, cross, imaginary
   use camroller_flexible_inertia, only : invert_inertia
   use camroller_flexible_joints, only : columns, variables, by_finger, by_finger_rate, by_pivot, by_pivot_rate, by_sliding, &
      & by_angle, by_lift, by_speed, by_pressure, follow_stem, follow_ball, pad_slopes, &
      & stem_slopes_t
   use camroller_joint_forces, only : has_pivot_friction
   use camroller_flexible_train, only : flexible_state_t, first_mode, at_finger, at_finger_rate, at_lift, at_speed, at_sliding, &
      & at_plunger, at_plunger_rate, at_pressure, largest_state
   implicit none
   private

   public :: slopes_of

   !> How the geometry follows the six variables
   type :: turns_t
      !> Turn of the normal in space, change of the angle phi [rad/unit of the variable]
      real(wp) :: normal(variables), nearest(variables)
      !> Approach, its rate, speed over the cam [m, m/s over the unit of the variable]
      real(wp) :: approach(variables), approach_rate(variables), travel_speed(variables)
      !> Change of the roller's centre and its velocity [m, m/s over the unit of the variable]
      complex(wp) :: centre(variables), velocity(variables)
   end type turns_t

   !> How forces and moments follow the six variables
   type :: follow_t
      !> Load and tangential force; moment and force along the adjuster's axis that both make [N, N m over the unit of the variable]
      real(wp) :: load(variables) = 0.0_wp, tangential(variables) = 0.0_wp, moment(variables) = 0.0_wp, axial(variables) = 0.0_wp
      !> Angular acceleration of the roller, torque of its bearing [rad/s^2, N m over the unit of the variable]
      real(wp) :: spin(variables) = 0.0_wp, bearing(variables) = 0.0_wp
   end type follow_t

contains

   !> Derivatives of the rates of the state with the cam angle.
   pure subroutine slopes_of(model, angle, state, now, jacobian, angle_slope)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> Derivatives of the rates (row) over the state (column) [1/rad], and over the cam angle [state/rad^2]
      real(wp), intent(out) :: jacobian(:, :), angle_slope(:)

      type(turns_t) :: turns
      type(follow_t) :: follow
      type(stem_slopes_t) :: stem
      ! Accelerations of finger and pivot over the six variables, lift and speed of the valve, and pressure [any]; rate of the
      ! sliding speed over the six, and over the three [any]; over the forces at the pad [any]
      real(wp) :: finger(columns), pivot(columns), sliding(variables), beyond(by_lift:by_pressure), by_pad(3)
      ! Pad's force over gamma, its rate, y, its rate, lift, speed [any]; accelerations of finger and pivot over moment and force
      ! [1/kg m^2], [1/kg m], [1/kg]
      real(wp) :: pad(6), inverse(2, 2)
      integer :: column

      call turn_geometry(model, state, now, turns)
      call follow_forces(model, now, turns, follow)
      call invert_inertia(model, now%centre_slope, inverse)
      pad = pad_slopes(model, state, now)
      jacobian = 0.0_wp
      angle_slope = 0.0_wp

      finger = 0.0_wp
      pivot = 0.0_wp
      call finger_slopes(model, state, now, follow, inverse, finger(:variables), pivot(:variables))
      ! What the pad's force and the plunger's do to the accelerations: of finger, of pivot, of the sliding speed
      by_pad(:2) = matmul(inverse, [-model%linkage%b*now%pad_sine, model%flexible%tilt_cosine])
      finger(:4) = finger(:4) + by_pad(1)*pad(:4)
      pivot(:4) = pivot(:4) + by_pad(2)*pad(:4)
      by_pad(3) = sliding_force(model, now, by_pad(1), by_pad(2))
      finger(by_lift:by_speed) = by_pad(1)*pad(5:6)
      pivot(by_lift:by_speed) = by_pad(2)*pad(5:6)
      beyond(by_lift:by_speed) = by_pad(3)*pad(5:6)
      if (allocated(model%flexible%adjuster)) then
         finger(by_pressure) = inverse(1, 2)*model%flexible%adjuster%area
         pivot(by_pressure) = inverse(2, 2)*model%flexible%adjuster%area
         beyond(by_pressure) = sliding_force(model, now, finger(by_pressure), pivot(by_pressure))
      end if
      if (allocated(model%joints)) then
         call follow_stem(model, state, now, pad, inverse, stem, finger, pivot)
         if (has_pivot_friction(model)) call follow_ball(model, state, now, cam_forces(now, turns, follow), pad, stem, inverse, &
            & finger, pivot)
         do column = by_lift, by_pressure
            beyond(column) = sliding_force(model, now, finger(column), pivot(column))
         end do
      end if
      sliding = sliding_slopes(model, state, now, turns, follow, finger(:variables), pivot(:variables))

      call put(model, at_finger_rate, finger(:variables), finger(by_lift:), jacobian, angle_slope)
      call put(model, at_sliding, sliding, beyond, jacobian, angle_slope)
      jacobian(at_finger, at_finger_rate) = 1.0_wp
      if (allocated(model%flexible%adjuster)) then
         call put(model, at_plunger_rate, pivot(:variables), pivot(by_lift:), jacobian, angle_slope)
         call put_adjuster(model, now, jacobian)
      end if
      call put_valve(model, angle, now, pad - stem%valve, jacobian, angle_slope)
      jacobian = jacobian/model%speed
      angle_slope = angle_slope/model%speed
   end subroutine slopes_of

   !> How geometry follows.
   pure subroutine turn_geometry(model, state, now, turns)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> How it follows
      type(turns_t), intent(out) :: turns

      ! Change of the roller's centre seen from the cam [m], of its velocity seen from the cam [m/s]
      complex(wp) :: way(variables), relative(variables), axis
      integer :: i

      associate (touch => now%touch, eps => model%linkage%sense)
         axis = model%flexible%axis
         turns%centre = (0.0_wp, 0.0_wp)
         turns%velocity = (0.0_wp, 0.0_wp)
         turns%centre(by_finger) = imaginary*touch%arm
         turns%centre(by_pivot) = axis
         turns%velocity(by_finger) = -state(at_finger_rate)*touch%arm
         turns%velocity(by_finger_rate) = imaginary*touch%arm
         turns%velocity(by_pivot_rate) = axis
         way = turns%centre
         way(by_angle) = imaginary*eps*touch%centre
         relative = turns%velocity + imaginary*eps*model%speed*turns%centre
         relative(by_angle) = imaginary*eps*model%speed_slope*touch%centre
         do i = 1, variables
            turns%nearest(i) = dot(touch%forward, way(i))/((touch%position%rolling_travel + model%linkage%roller_radius) &
               & *touch%uniqueness)
            turns%normal(i) = touch%position%pitch_curvature*dot(touch%forward, way(i))/touch%uniqueness
            if (i == by_angle) turns%normal(i) = turns%normal(i) - 1.0_wp
            turns%approach(i) = -dot(touch%normal, way(i))
            turns%approach_rate(i) = -turns%normal(i)*touch%travel_speed - dot(touch%normal, relative(i))
            turns%travel_speed(i) = turns%normal(i)*touch%approach_rate + dot(touch%forward, relative(i))
         end do
      end associate
   end subroutine turn_geometry

   !> How load, friction and what they do to finger and roller follow.
   pure subroutine follow_forces(model, now, turns, follow)
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> How geometry follows
      type(turns_t), intent(in) :: turns
      !> How forces follow
      type(follow_t), intent(out) :: follow

      ! Traction and rolling resistance over the six variables [N]
      real(wp) :: traction(variables), rolling(variables)
      complex(wp) :: axis
      integer :: i

      if (.not. now%contact%is_touching) then
         if (has_oil_drag(model)) call follow_drag(model, now, turns, follow)
         return
      end if
      associate (touch => now%touch, contact => now%contact)
         follow%load = now%cam%by_approach*turns%approach + now%cam%by_rate*turns%approach_rate
         call follow_friction(model, now, turns, follow, traction, rolling)
         axis = model%flexible%axis
         do i = 1, variables
            follow%moment(i) = follow%load(i)*cross(touch%arm, touch%normal) - follow%tangential(i)*cross(touch%arm, &
               & touch%forward) + turns%normal(i)*(contact%load*cross(touch%arm, touch%forward) &
               & + contact%tangential_force*cross(touch%arm, touch%normal)) + model%linkage%sense*follow%bearing(i)
            follow%axial(i) = follow%load(i)*dot(axis, touch%normal) - follow%tangential(i)*dot(axis, touch%forward) &
               & + turns%normal(i)*(contact%load*dot(axis, touch%forward) + contact%tangential_force*dot(axis, touch%normal))
            follow%spin(i) = spin_acceleration(traction(i), rolling(i), model%roller_radius, follow%bearing(i), &
               & model%roller_inertia)
         end do
         follow%moment(by_finger) = follow%moment(by_finger) - contact%load*dot(touch%arm, touch%normal) &
            & + contact%tangential_force*dot(touch%arm, touch%forward)
      end associate
   end subroutine follow_forces

   !> How the force of the cam on the roller follows.
   pure function cam_forces(now, turns, follow) result(slopes)
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> How geometry and forces follow
      type(turns_t), intent(in) :: turns
      type(follow_t), intent(in) :: follow
      !> Change of the force [N over the unit of the variable]
      complex(wp) :: slopes(variables)

      associate (touch => now%touch, contact => now%contact)
         slopes = (follow%load + contact%tangential_force*turns%normal)*touch%normal &
            & + (contact%load*turns%normal - follow%tangential)*touch%forward
      end associate
   end function cam_forces

   !> How the oil in the roller's bearing follows, which holds the roller without contact too.
   pure subroutine follow_drag(model, now, turns, follow)
      !> The model, with such oil
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> How geometry follows
      type(turns_t), intent(in) :: turns
      !> How forces follow
      type(follow_t), intent(inout) :: follow

      follow%bearing = oil_drag_slope(model, now%contact%relative_spin)*spin_changes(model, turns)
      call add_reversal(model, now, follow)
      follow%moment = model%linkage%sense*follow%bearing
      follow%spin = spin_acceleration(0.0_wp, 0.0_wp, model%roller_radius, follow%bearing, model%roller_inertia)
   end subroutine follow_drag

   !> The spin over which the bearing's torque reverses goes with the cam's speed.
   pure subroutine add_reversal(model, now, follow)
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> How forces follow; out: the bearing's torque with it
      type(follow_t), intent(inout) :: follow

      if (.not. abs(model%speed_slope) > 0.0_wp) return
      follow%bearing(by_angle) = follow%bearing(by_angle) + model%speed_slope/model%speed &
         & *bearing_by_reversal(model, now%contact, now%parts)
   end subroutine add_reversal

   !> How the roller's spin relative to the finger follows.
   pure function spin_changes(model, turns) result(spin)
      type(model_t), intent(in) :: model
      !> How geometry follows
      type(turns_t), intent(in) :: turns
      !> Changes [rad/s over the unit of the variable]
      real(wp) :: spin(variables)

      spin = turns%travel_speed
      spin(by_sliding) = spin(by_sliding) - 1.0_wp
      spin = spin/model%roller_radius
      spin(by_finger_rate) = spin(by_finger_rate) - model%linkage%sense
      spin(by_angle) = spin(by_angle) - model%speed_slope
   end function spin_changes

   !> How friction follows: the contact's own slopes along load, entrainment, radius, sliding speed, spin and, where surfaces change
   !> as they run, place on the cam.
   pure subroutine follow_friction(model, now, turns, follow, traction, rolling)
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> How geometry follows
      type(turns_t), intent(in) :: turns
      !> In: load; out: with tangential force and bearing torque
      type(follow_t), intent(inout) :: follow
      !> Traction and rolling resistance [N over the unit of the variable]
      real(wp), intent(out) :: traction(variables), rolling(variables)

      ! Logarithmic changes of radius and entrainment; changes of sliding speed and relative spin [over the unit of the variable]
      real(wp) :: radius(variables), entrainment(variables), speed(variables), spin(variables)
      ! Their slopes: traction, rolling resistance, bearing torque
      type(slopes_t) :: slopes(6)
      integer :: i, count

      associate (touch => now%touch, contact => now%contact, r => model%roller_radius)
         radius = touch%position%radius_slope*turns%nearest/touch%position%equivalent_radius
         speed = 0.0_wp
         speed(by_sliding) = 1.0_wp
         entrainment = 0.0_wp
         if (abs(contact%entrainment_speed) > 0.0_wp) then
            entrainment = (turns%travel_speed*touch%position%equivalent_radius/r + contact%cam_surface_speed*radius &
               & - 0.5_wp*speed)/contact%entrainment_speed
         end if
         spin = spin_changes(model, turns)
         slopes(1) = follow_contact(model, now%setting, contact, now%parts, motion_t(load=1.0_wp))
         slopes(2) = follow_contact(model, now%setting, contact, now%parts, motion_t(entrainment=1.0_wp))
         slopes(3) = follow_contact(model, now%setting, contact, now%parts, motion_t(radius=1.0_wp))
         slopes(4) = follow_contact(model, now%setting, contact, now%parts, motion_t(sliding_speed=1.0_wp))
         slopes(5) = follow_contact(model, now%setting, contact, now%parts, motion_t(relative_spin=1.0_wp))
         count = merge(6, 5, allocated(model%surface))
         if (allocated(model%surface)) then
            slopes(6) = follow_contact(model, now%setting, contact, now%parts, &
               & motion_t(roughness=contact%surfaces%roughness_slope, covered=contact%surfaces%covered_slope))
         end if
         do i = 1, variables
            associate (motion => [follow%load(i)/contact%load, entrainment(i), radius(i), speed(i), spin(i), turns%nearest(i)])
               traction(i) = sum(slopes(:count)%traction*motion(:count))
               rolling(i) = sum(slopes(:count)%rolling_resistance*motion(:count))
               follow%bearing(i) = sum(slopes(:count)%bearing_torque*motion(:count))
            end associate
            follow%tangential(i) = traction(i) + rolling(i)*now%parts%rolling_part &
               & + contact%rolling_resistance*(now%parts%rolling_part + 1.0_wp)*radius(i)
         end do
      end associate
      call add_reversal(model, now, follow)
   end subroutine follow_friction

   !> Accelerations of finger and pivot over the six variables, the pad's force as it is.
   pure subroutine finger_slopes(model, state, now, follow, inverse, finger, pivot)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> How forces follow
      type(follow_t), intent(in) :: follow
      !> Accelerations over moment and force [1/kg m^2], [1/kg m], [1/kg]
      real(wp), intent(in) :: inverse(2, 2)
      !> Slopes of the accelerations [rad/s^2], [m/s^2] over the unit of the variable
      real(wp), intent(out) :: finger(variables), pivot(variables)

      ! Moment and force along the axis over the six variables [N m], [N]
      real(wp) :: moment(variables), axial(variables)

      associate (flexible => model%flexible, rate => state(at_finger_rate))
         moment = follow%moment
         moment(by_finger) = moment(by_finger) - now%pad%force*model%linkage%b*now%pad_cosine &
            & - flexible%finger_mass*now%centre_curvature*now%pivot_acceleration
         axial = follow%axial
         if (allocated(flexible%adjuster)) then
            axial(by_finger) = axial(by_finger) + flexible%finger_mass*(now%centre_slope*rate**2 &
               & - now%centre_curvature*now%finger_acceleration)
            axial(by_finger_rate) = axial(by_finger_rate) - 2.0_wp*flexible%finger_mass*now%centre_curvature*rate
            axial(by_pivot) = axial(by_pivot) - flexible%adjuster%given%spring_stiffness - now%stops(1)%by_approach &
               & - now%stops(2)%by_approach
            axial(by_pivot_rate) = axial(by_pivot_rate) - flexible%adjuster%drag - now%stops(1)%by_rate - now%stops(2)%by_rate
         end if
         finger = inverse(1, 1)*moment + inverse(1, 2)*axial
         pivot = inverse(2, 1)*moment + inverse(2, 2)*axial
      end associate
   end subroutine finger_slopes

   !> Rate of the sliding speed over the six variables, with the accelerations' own slopes.
   pure function sliding_slopes(model, state, now, turns, follow, finger, pivot) result(slopes)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> How geometry and forces follow
      type(turns_t), intent(in) :: turns
      type(follow_t), intent(in) :: follow
      !> Slopes of the accelerations [rad/s^2], [m/s^2] over the unit of the variable
      real(wp), intent(in) :: finger(variables), pivot(variables)
      !> Slopes [m/s^2 over the unit of the variable]
      real(wp) :: slopes(variables)

      ! Acceleration of the roller's centre seen from the cam [m/s^2], its change by one of the variables
      complex(wp) :: acceleration, change, axis
      ! Curvature of the path over uniqueness [1/m], its derivatives over phi [1/m/rad] and the approach [1/m^2]
      real(wp) :: bend, by_nearest, by_approach
      integer :: i

      associate (touch => now%touch, eps => model%linkage%sense, speed => model%speed, rate => state(at_finger_rate))
         axis = model%flexible%axis
         acceleration = now%pivot_acceleration*axis + (imaginary*now%finger_acceleration - rate**2)*touch%arm &
            & + 2.0_wp*imaginary*eps*speed*touch%velocity - speed**2*touch%centre
         bend = touch%position%pitch_curvature/touch%uniqueness
         by_nearest = -touch%position%radius_slope/(model%roller_radius*touch%uniqueness)**2
         by_approach = bend**2
         do i = 1, variables
            change = pivot(i)*axis + imaginary*finger(i)*touch%arm + 2.0_wp*imaginary*eps*speed*turns%velocity(i) &
               & - speed**2*turns%centre(i)
            if (i == by_finger) change = change + (imaginary*now%finger_acceleration - rate**2)*imaginary*touch%arm
            if (i == by_finger_rate) change = change - 2.0_wp*rate*touch%arm
            if (i == by_angle) change = change + 2.0_wp*model%speed_slope*(imaginary*eps*touch%velocity - speed*touch%centre)
            slopes(i) = dot(touch%forward, change) - turns%normal(i)*dot(touch%normal, acceleration) &
               & + bend*(turns%travel_speed(i)*touch%approach_rate + touch%travel_speed*turns%approach_rate(i)) &
               & + (by_nearest*turns%nearest(i) + by_approach*turns%approach(i))*touch%travel_speed*touch%approach_rate &
               & - model%roller_radius*follow%spin(i) + speed*model%speed_slope*(turns%normal(i)*dot(touch%forward, touch%centre) &
               & + dot(touch%normal, turns%centre(i)))
         end do
         slopes(by_angle) = slopes(by_angle) + model%speed_slope**2*touch%tangent_arm
      end associate
   end function sliding_slopes

   !> Rate of the sliding speed by accelerations of finger and pivot.
   pure function sliding_force(model, now, finger, pivot) result(rate)
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> The accelerations [rad/s^2], [m/s^2]
      real(wp), intent(in) :: finger, pivot
      !> The rate [m/s^2]
      real(wp) :: rate

      rate = dot(now%touch%forward, pivot*model%flexible%axis + imaginary*finger*now%touch%arm)
   end function sliding_force

   !> Put slopes over the six variables, and over lift and speed of the valve and pressure, into their places.
   pure subroutine put(model, row, slopes, beyond, jacobian, angle_slope)
      type(model_t), intent(in) :: model
      !> Row of the matrix
      integer, intent(in) :: row
      !> Slopes over the six variables, and over lift and speed of the valve and pressure [any]
      real(wp), intent(in) :: slopes(variables), beyond(3)
      !> The matrix and the slope over the cam angle [any]
      real(wp), intent(inout) :: jacobian(:, :), angle_slope(:)

      jacobian(row, at_finger) = slopes(by_finger)
      jacobian(row, at_finger_rate) = slopes(by_finger_rate)
      jacobian(row, at_sliding) = slopes(by_sliding)
      jacobian(row, [at_lift, at_speed]) = beyond(:2)
      angle_slope(row) = slopes(by_angle)
      if (.not. allocated(model%flexible%adjuster)) return
      jacobian(row, at_plunger) = slopes(by_pivot)
      jacobian(row, at_plunger_rate) = slopes(by_pivot_rate)
      jacobian(row, at_pressure) = beyond(3)
   end subroutine put

   !> The plunger's way and the chamber's own equation.
   pure subroutine put_adjuster(model, now, jacobian)
      !> The model, with an adjuster
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> The matrix [any]
      real(wp), intent(inout) :: jacobian(:, :)

      ! Bulk modulus [Pa], its slope [-], volume of the chamber [m^3]
      real(wp) :: modulus, slope, volume

      associate (adjuster => model%flexible%adjuster)
         jacobian(at_plunger, at_plunger_rate) = 1.0_wp
         call bulk_modulus(adjuster%given, now%pressure, modulus, slope)
         volume = chamber_volume(adjuster, now%pivot)
         jacobian(at_pressure, at_plunger) = -now%pressure_rate*adjuster%area/volume
         jacobian(at_pressure, at_plunger_rate) = -modulus/volume*adjuster%area
         jacobian(at_pressure, at_pressure) = now%pressure_rate*slope/modulus + modulus/volume*(now%flows%check_slope &
            & - now%flows%leak_slope)
      end associate
   end subroutine put_adjuster

   !> The valve's and the spring's equations.
   pure subroutine put_valve(model, angle, now, pad, jacobian, angle_slope)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The pad's force over gamma, its rate, y, its rate, lift and speed of the valve, less the friction of the stem [N over the
      !> unit of the variable]
      real(wp), intent(in) :: pad(6)
      !> The matrix and the slope over the cam angle [any]
      real(wp), intent(inout) :: jacobian(:, :), angle_slope(:)

      ! Force on the valve over each component of the state [N over its unit]
      real(wp) :: force(largest_state)
      integer :: n, place, last

      last = size(angle_slope)
      force(:last) = 0.0_wp
      force([at_finger, at_finger_rate]) = pad([by_finger, by_finger_rate])
      if (allocated(model%flexible%adjuster)) force([at_plunger, at_plunger_rate]) = pad([by_pivot, by_pivot_rate])
      force(at_lift) = pad(5) - now%seat%by_approach - model%train%stiffness
      force(at_speed) = pad(6) - now%seat%by_rate - now%guide_slope
      associate (modes => model%flexible%modes)
         place = first_mode(model)
         do n = 1, modes%count
            force(place) = modes%mass*modes%share(n)*modes%frequency(n)**2
            force(place + 1) = 2.0_wp*modes%mass*modes%share(n)*modes%damping_ratio*modes%frequency(n)
            place = place + 2
         end do
         force(:last) = force(:last)/model%flexible%effective_mass
         jacobian(at_lift, at_speed) = 1.0_wp
         jacobian(at_speed, :) = force(:last)
         if (allocated(model%gas)) angle_slope(at_speed) = -gas_force_slope(model%gas, angle)/model%flexible%effective_mass
         place = first_mode(model)
         do n = 1, modes%count
            jacobian(place, place + 1) = 1.0_wp
            jacobian(place + 1, :) = -2.0_wp*modes%share(n)*force(:last)
            jacobian(place + 1, place) = jacobian(place + 1, place) - modes%frequency(n)**2
            jacobian(place + 1, place + 1) = jacobian(place + 1, place + 1) - 2.0_wp*modes%damping_ratio*modes%frequency(n)
            angle_slope(place + 1) = -2.0_wp*modes%share(n)*angle_slope(at_speed)
            place = place + 2
         end do
      end associate
   end subroutine put_valve

end module camroller_flexible_jacobian
