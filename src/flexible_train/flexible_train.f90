!> Forces and accelerations of a flexible train.
!>
!> In: model, cam angle, state. Out: everything at that state, and its rate of change with the cam angle. The
!> load is explicit: it follows from the approach of cam and roller, and film, load share, traction and rolling resistance from it.
!>
!> Order of the state: finger's angle and rate, valve's lift and speed, sliding speed; with an adjuster its travel, speed and
!> pressure; then amplitude and rate of each spring mode.
module camroller_flexible_train
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : linkage_t
   use camroller_gas, only : gas_force
   use camroller_guide, only : find_guide_drag
   use camroller_roller, only : spin_acceleration
   use camroller_contact_compliance, only : series_load, damping_factor, one_sided_force
   use camroller_spring_modes, only : most_modes, valve_pull
   use camroller_lash_adjuster, only : flows_t, ambient_pressure, evaluate_flows, adjuster_force, bulk_modulus, &
      & chamber_volume
   use camroller_contact_forces, only : contact_t, setting_t, parts_t, start_heat, prepare_contact, evaluate_contact, &
      & release_contact, set_bearing_drag, set_surfaces
   use camroller_flexible_geometry, only : touch_t, find_touch, dot, cross, imaginary
   use camroller_joint_forces, only : has_pivot_friction
   use camroller_stem_friction, only : stem_t, stem_motion_t, rub_stem
   use camroller_flexible_inertia, only : solve_finger
   use camroller_flexible_pivot, only : ball_t, hold_ball
   implicit none
   private

   public :: flexible_state_t, resolution_t, state_size, first_mode, evaluate_train, rates_of, pad_approach, &
      & pad_direction, stem_motion, valve_axis
   public :: at_finger, at_finger_rate, at_lift, at_speed, at_sliding, at_plunger, at_plunger_rate, at_pressure, largest_state

   !> Places in the state
   integer, parameter :: at_finger = 1, at_finger_rate = 2, at_lift = 3, at_speed = 4, at_sliding = 5, at_plunger = 6, &
      & at_plunger_rate = 7, at_pressure = 8
   !> Number of components at most
   integer, parameter :: largest_state = at_pressure + 2*most_modes

   !> What an evaluation need not tell apart; zero: round-off
   type :: resolution_t
      !> Relative error of the contact's forces [-]
      real(wp) :: forces = 0.0_wp
      !> Difference of sliding speeds: friction that changes within less is stretched to it [m/s]
      real(wp) :: sliding_speed = 0.0_wp
   end type resolution_t

   !> A one-sided spring
   type :: push_t
      !> Force and its elastic part [N]
      real(wp) :: force = 0.0_wp, elastic = 0.0_wp
      !> Approach [m] and its rate [m/s]
      real(wp) :: approach = 0.0_wp, rate = 0.0_wp
      !> Derivatives of the force over approach [N/m] and rate [N s/m]
      real(wp) :: by_approach = 0.0_wp, by_rate = 0.0_wp
   end type push_t

   !> Friction of the sliding joints: at valve tip and stem, of the finger on its pivot
   type :: joint_friction_t
      type(stem_t) :: stem
      type(ball_t) :: ball
   end type joint_friction_t

   !> Everything at one state
   type :: flexible_state_t
      type(touch_t) :: touch
      type(contact_t) :: contact
      !> What slopes of the contact's forces are made of, where it carries load
      type(setting_t) :: setting
      type(parts_t) :: parts
      !> Cam and roller, pad, seat; lower and upper stop of the plunger
      type(push_t) :: cam, pad, seat, stops(2)
      !> Cosine and sine of gamma + chi [-]
      real(wp) :: pad_cosine, pad_sine
      !> Cylinder pressure times valve area [N]
      real(wp) :: gas_force = 0.0_wp
      !> Friction of pad and tip [N], its moment against the finger's opening [N m]; friction of seal and guide on the stem [N]
      real(wp) :: tip_friction = 0.0_wp, tip_moment = 0.0_wp, stem_friction = 0.0_wp
      !> Friction of the joints, where the case has any
      type(joint_friction_t), allocatable :: joint_friction
      !> Pull of the spring's modes beside its static force [N]
      real(wp) :: mode_pull = 0.0_wp
      !> Drag of the valve's guide: over its speed, and its slope [N s/m]
      real(wp) :: guide_drag = 0.0_wp, guide_slope = 0.0_wp
      !> Finger's centre of mass along the adjuster's axis: first and second derivative over gamma [m]
      real(wp) :: centre_slope, centre_curvature
      !> Accelerations of finger [rad/s^2], valve and pivot [m/s^2]
      real(wp) :: finger_acceleration, valve_acceleration, pivot_acceleration = 0.0_wp
      !> Angular acceleration of the roller [rad/s^2]; rate of the sliding speed [m/s^2]
      real(wp) :: spin_acceleration, sliding_rate
      !> Travel, speed of the pivot [m], [m/s], pressure [Pa] and its rate [Pa/s]
      real(wp) :: pivot, pivot_rate, pressure = 0.0_wp, pressure_rate = 0.0_wp
      !> Force of oil, spring and drag on the plunger [N]
      real(wp) :: hydraulic_force = 0.0_wp
      type(flows_t) :: flows
   end type flexible_state_t

   !> Loads below this count as none [N]
   real(wp), parameter :: least_load = 1.0e-9_wp

contains

   !> Number of components of the state.
   pure function state_size(model) result(components)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The number
      integer :: components

      components = first_mode(model) - 1 + 2*model%flexible%modes%count
   end function state_size

   !> Place of the first mode in the state.
   pure function first_mode(model) result(place)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The place
      integer :: place

      place = merge(at_pressure, at_sliding, allocated(model%flexible%adjuster)) + 1
   end function first_mode

   !> Forces and accelerations at a state.
   pure subroutine evaluate_train(model, angle, state, resolution, now, status)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> What need not be told apart
      type(resolution_t), intent(in) :: resolution
      !> Everything there
      type(flexible_state_t), intent(out) :: now
      !> 0 fine, positive: an impossible state, as a finger that has turned so far that its pad would close the valve; negative:
      !> the rigid train is impossible
      integer, intent(out) :: status

      now%pivot = model%flexible%pivot_place
      now%pivot_rate = 0.0_wp
      if (allocated(model%flexible%adjuster)) then
         now%pivot = state(at_plunger)
         now%pivot_rate = state(at_plunger_rate)
         call set_adjuster(model, state, now, status)
         if (status /= 0) return
      end if
      call find_touch(model, angle, state(at_finger), state(at_finger_rate), now%pivot, now%pivot_rate, now%touch, status)
      if (status /= 0) return
      call set_contact(model, state, resolution, now)
      call set_valve_forces(model, angle, state, now)
      if (.not. now%pad_sine > 0.0_wp) status = 1
      call accelerate(model, state, now)
   end subroutine evaluate_train

   !> Chamber, leak and check valve; stops of the plunger.
   pure subroutine set_adjuster(model, state, now, status)
      !> The model, with an adjuster
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Flows, force, pressure and its rate, stops
      type(flexible_state_t), intent(inout) :: now
      !> 0 fine, positive where there is no such pressure or volume
      integer, intent(out) :: status

      ! Bulk modulus [Pa], its slope [-], volume [m^3]; smallest pressure and volume that are evaluated [Pa], [-]: air of 1e-4
      ! of the oil's volume takes as much room as that at 2.5e-6 of the ambient pressure
      real(wp) :: modulus, slope, volume
      real(wp), parameter :: least_pressure = -(1.0_wp - 1.0e-9_wp)*ambient_pressure, least_part = 1.0e-3_wp

      associate (adjuster => model%flexible%adjuster)
         now%pressure = state(at_pressure)
         volume = chamber_volume(adjuster, now%pivot)
         status = 1
         if (.not. now%pressure > least_pressure .or. .not. volume > least_part*adjuster%given%volume) return
         status = 0
         call evaluate_flows(adjuster, now%pressure, now%flows)
         call bulk_modulus(adjuster%given, now%pressure, modulus, slope)
         now%pressure_rate = modulus/volume*(now%flows%check - now%flows%leak - adjuster%area*now%pivot_rate)
         now%hydraulic_force = adjuster_force(adjuster, now%pivot, now%pivot_rate, now%pressure)
         call push(now%stops(1), adjuster%given%stop_stiffness, adjuster%given%stop_damping, &
            & adjuster%given%lowest - now%pivot, -now%pivot_rate)
         call push(now%stops(2), adjuster%given%stop_stiffness, adjuster%given%stop_damping, &
            & now%pivot - adjuster%given%highest, now%pivot_rate)
      end associate
   end subroutine set_adjuster

   !> A one-sided spring.
   pure subroutine push(spring, stiffness, damping, approach, rate)
      type(push_t), intent(out) :: spring
      !> Stiffness [N/m], damping [s/m]
      real(wp), intent(in) :: stiffness, damping
      !> Approach [m], its rate [m/s]
      real(wp), intent(in) :: approach, rate

      spring%approach = approach
      spring%rate = rate
      call one_sided_force(stiffness, damping, approach, rate, spring%force, spring%elastic, spring%by_approach, spring%by_rate)
   end subroutine push

   !> Load, film and friction of cam and roller.
   pure subroutine set_contact(model, state, resolution, now)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> What need not be told apart
      type(resolution_t), intent(in) :: resolution
      !> In: geometry; out: with the contact
      type(flexible_state_t), intent(inout) :: now

      ! Stiffness of the elastic load [N/m], load over it [-], relative change of the film ratio [-]
      real(wp) :: stiffness, factor, change

      associate (touch => now%touch, cam => now%cam, contact => now%contact, flexible => model%flexible)
         cam%approach = touch%approach
         cam%rate = touch%approach_rate
         call series_load(flexible%compliance, flexible%finger_stiffness, touch%approach, cam%elastic, stiffness)
         factor = damping_factor(flexible%contact_damping, touch%approach_rate)
         cam%force = cam%elastic*factor
         cam%by_approach = stiffness*factor
         cam%by_rate = 0.0_wp
         if (factor > 0.0_wp) cam%by_rate = cam%elastic*flexible%contact_damping
         call set_surface_speeds(model, state, touch, contact)
         if (allocated(model%heat)) call start_heat(model, contact)
         if (.not. cam%force > least_load) then
            call release_contact(contact)
            return
         end if
         contact%load = cam%force
         contact%film_ratio = 0.0_wp
         call prepare_contact(model, touch%position, contact, resolution%forces, now%setting, &
            & resolution=resolution%sliding_speed)
         call evaluate_contact(model, touch%position, now%setting, cam%force, contact, now%parts, change)
      end associate
   end subroutine set_contact

   !> Speeds of the surfaces: `V_c = S (1 - r_R kappa)`, `V_roll = S - omega r_R`.
   pure subroutine set_surface_speeds(model, state, touch, contact)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Geometry
      type(touch_t), intent(in) :: touch
      !> The contact: its speeds
      type(contact_t), intent(inout) :: contact

      contact%sliding_speed = state(at_sliding)
      contact%cam_surface_speed = touch%travel_speed*touch%position%equivalent_radius/model%roller_radius
      contact%rolling_speed = touch%travel_speed - model%speed*model%roller_radius
      contact%roller_surface_speed = contact%cam_surface_speed - contact%sliding_speed
      contact%entrainment_speed = contact%cam_surface_speed - 0.5_wp*contact%sliding_speed
      contact%roller_spin = (contact%rolling_speed - contact%sliding_speed)/model%roller_radius
      contact%relative_spin = contact%roller_spin - model%linkage%sense*state(at_finger_rate)
      call set_bearing_drag(model, contact)
      contact%length = model%contact_width
      call set_surfaces(model, touch%position, contact)
   end subroutine set_surface_speeds

   !> Pad, seat, gas, guide and spring.
   pure subroutine set_valve_forces(model, angle, state, now)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> In: pivot; out: with the forces at the valve
      type(flexible_state_t), intent(inout) :: now

      ! Approach of the pad [m], its rate [m/s]; direction of the pad's arm [-]
      real(wp) :: approach, rate
      complex(wp) :: pad
      integer :: first

      associate (linkage => model%linkage, flexible => model%flexible)
         pad = pad_direction(linkage, now%touch%arm)
         now%pad_cosine = real(pad, wp)
         now%pad_sine = aimag(pad)
         approach = pad_approach(model, state, now%pivot, now%pad_cosine)
         rate = linkage%b*now%pad_sine*state(at_finger_rate) - now%pivot_rate*flexible%tilt_cosine - state(at_speed)
         call push(now%pad, flexible%pad_stiffness, flexible%pad_damping, approach, rate)
         call push(now%seat, flexible%seat_stiffness, flexible%seat_damping, -state(at_lift), -state(at_speed))
         if (allocated(model%gas)) now%gas_force = gas_force(model%gas, angle)
         if (allocated(model%guide)) call find_guide_drag(model%guide, state(at_speed), now%guide_drag, now%guide_slope)
         first = first_mode(model)
         now%mode_pull = valve_pull(flexible%modes, state(first::2), state(first + 1::2))
      end associate
      if (.not. allocated(model%joints)) return
      allocate (now%joint_friction)
      associate (stem => now%joint_friction%stem, joints => model%joints)
         call rub_stem(joints%tip, joints%seal, joints%side, stem_motion(model, state, now), stem)
         now%tip_friction = stem%tip_friction%value
         now%tip_moment = stem%tip_friction%value*stem%height%value
         now%stem_friction = stem%seal_friction%value + stem%side_friction%value
      end associate
   end subroutine set_valve_forces

   !> Motion of pad and stem as their friction has it, with the pad's force.
   pure function stem_motion(model, state, now) result(motion)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Pivot and pad
      type(flexible_state_t), intent(in) :: now
      !> The motion, without slopes
      type(stem_motion_t) :: motion

      motion%lift%value = state(at_lift)
      motion%valve_speed%value = state(at_speed)
      motion%finger_speed%value = state(at_finger_rate)
      motion%centre_height%value = model%linkage%b*now%pad_cosine
      motion%arm%value = model%linkage%b*now%pad_sine + now%pivot*model%flexible%tilt_sine
      motion%pivot_speed%value = now%pivot_rate*model%flexible%tilt_sine
      motion%axial_force%value = now%pad%force
   end function stem_motion

   !> Direction of the arm from the pivot to the pad, seen from the valve's axis: exp(i (gamma + chi)).
   pure function pad_direction(linkage, arm) result(direction)
      !> Constants of the mechanism
      type(linkage_t), intent(in) :: linkage
      !> Arm from the pivot to the roller's centre [m]
      complex(wp), intent(in) :: arm
      !> The direction [-]
      complex(wp) :: direction

      direction = arm*cmplx(linkage%offset_cosine/linkage%a, -linkage%offset_sine/linkage%a, wp)
   end function pad_direction

   !> Approach of the pad; negative where there is a gap.
   pure function pad_approach(model, state, pivot, pad_cosine) result(approach)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Place of the pivot [m]
      real(wp), intent(in) :: pivot
      !> Cosine of gamma + chi [-]
      real(wp), intent(in) :: pad_cosine
      !> Approach [m]
      real(wp) :: approach

      approach = model%linkage%b*(model%linkage%base_cosine - pad_cosine) - pivot*model%flexible%tilt_cosine - state(at_lift) &
         & - model%flexible%lash
   end function pad_approach

   !> Accelerations of valve, finger and pivot, roller.
   pure subroutine accelerate(model, state, now)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> In: forces; out: with accelerations
      type(flexible_state_t), intent(inout) :: now

      ! Force of the cam on the roller [N], acceleration of the roller's centre [m/s^2]; finger's centre of mass seen from the
      ! adjuster's axis [m]
      complex(wp) :: force, acceleration, centre
      ! Moment on the finger [N m], force on it along the adjuster's axis [N], inertia by it [kg m]
      real(wp) :: moment, axial, coupling

      associate (flexible => model%flexible, touch => now%touch, contact => now%contact, eps => model%linkage%sense, &
         & rate => state(at_finger_rate))
         now%valve_acceleration = (now%pad%force + now%seat%force - now%gas_force - model%train%stiffness*(state(at_lift) &
            & + model%train%precompression) - now%guide_drag*state(at_speed) + now%mode_pull &
            & - now%stem_friction)/flexible%effective_mass

         force = contact%load*touch%normal - contact%tangential_force*touch%forward
         moment = cross(touch%arm, force) + eps*contact%bearing_torque - now%pad%force*model%linkage%b*now%pad_sine &
            & - now%tip_moment
         centre = touch%arm*conjg(flexible%axis)*(flexible%finger_centre/model%linkage%a)
         now%centre_slope = -aimag(centre)
         now%centre_curvature = -real(centre, wp)
         if (allocated(flexible%adjuster)) then
            coupling = flexible%finger_mass*now%centre_slope
            axial = dot(flexible%axis, force) + flexible%tilt_cosine*now%pad%force + now%hydraulic_force &
               & + now%stops(1)%force - now%stops(2)%force - flexible%finger_mass*now%centre_curvature*rate**2 &
               & - flexible%tilt_sine*now%tip_friction
            call solve_finger(model, coupling, axial, moment, now%pivot_acceleration, now%finger_acceleration)
         else
            now%finger_acceleration = moment/model%train%finger_inertia
         end if
         if (has_pivot_friction(model)) call rub_ball(model, state, force, now)

         now%spin_acceleration = spin_acceleration(contact%traction, contact%rolling_resistance, model%roller_radius, &
            & contact%bearing_torque, model%roller_inertia)
         acceleration = now%pivot_acceleration*flexible%axis &
            & + (imaginary*now%finger_acceleration - rate**2)*touch%arm
         now%sliding_rate = dot(touch%forward, acceleration + 2.0_wp*imaginary*eps*model%speed*touch%velocity &
            & - model%speed**2*touch%centre) + touch%position%pitch_curvature*touch%travel_speed*touch%approach_rate &
            & /touch%uniqueness - model%roller_radius*now%spin_acceleration
         ! A cam that speeds up takes S - omega r_R with it, which is omega h_F and a part that has no omega
         if (abs(model%speed_slope) > 0.0_wp) now%sliding_rate = now%sliding_rate + model%speed*model%speed_slope*touch%tangent_arm
      end associate
   end subroutine accelerate

   !> Friction of the finger on its pivot, from accelerations without it; out: with it.
   pure subroutine rub_ball(model, state, cam_force, now)
      !> The model, whose pivot has friction
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Force of the cam on the roller [N]
      complex(wp), intent(in) :: cam_force
      !> In: accelerations without that friction; out: with it
      type(flexible_state_t), intent(inout) :: now

      ! Accelerations of pivot and finger by a moment on the finger [1/kg m], [1/kg m^2]
      real(wp) :: pivot, finger
      ! Finger's centre of mass from the pivot [m]; force of the valve on the pad [N]
      complex(wp) :: centre, pad_force

      associate (flexible => model%flexible, arm => now%touch%arm, ball => now%joint_friction%ball, rate => state(at_finger_rate))
         pivot = 0.0_wp
         finger = 1.0_wp/model%train%finger_inertia
         if (allocated(flexible%adjuster)) call solve_finger(model, flexible%finger_mass*now%centre_slope, 0.0_wp, 1.0_wp, &
            & pivot, finger)
         centre = arm*(flexible%finger_centre/model%linkage%a)
         pad_force = (now%pad%force - imaginary*now%tip_friction)*valve_axis(model%linkage)
         ball%free = flexible%finger_mass*(now%pivot_acceleration*flexible%axis + (imaginary*now%finger_acceleration &
            & - rate**2)*centre) - cam_force - pad_force
         ball%by_moment = flexible%finger_mass*(pivot*flexible%axis + imaginary*finger*centre)
         call hold_ball(model%joints%pivot, rate, ball)
         now%pivot_acceleration = now%pivot_acceleration - pivot*ball%moment
         now%finger_acceleration = now%finger_acceleration - finger*ball%moment
      end associate
   end subroutine rub_ball

   !> Direction of the valve's axis towards the cam, exp(-i chi).
   pure function valve_axis(linkage) result(axis)
      !> Constants of the mechanism
      type(linkage_t), intent(in) :: linkage
      !> The direction [-]
      complex(wp) :: axis

      axis = cmplx(linkage%axis_cosine, -linkage%axis_sine, wp)
   end function valve_axis

   !> Rate of change of the state with the cam angle.
   pure subroutine rates_of(model, state, now, rate)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The rate [state/rad]
      real(wp), intent(out) :: rate(:)

      integer :: n, place

      rate(at_finger) = state(at_finger_rate)
      rate(at_finger_rate) = now%finger_acceleration
      rate(at_lift) = state(at_speed)
      rate(at_speed) = now%valve_acceleration
      rate(at_sliding) = now%sliding_rate
      if (allocated(model%flexible%adjuster)) then
         rate(at_plunger) = now%pivot_rate
         rate(at_plunger_rate) = now%pivot_acceleration
         rate(at_pressure) = now%pressure_rate
      end if
      place = first_mode(model)
      associate (modes => model%flexible%modes)
         do n = 1, modes%count
            rate(place) = state(place + 1)
            rate(place + 1) = -modes%frequency(n)*(modes%frequency(n)*state(place) + 2.0_wp*modes%damping_ratio*state(place + 1)) &
               & - 2.0_wp*modes%share(n)*now%valve_acceleration
            place = place + 2
         end do
      end associate
      rate = rate/model%speed
   end subroutine rates_of

end module camroller_flexible_train
