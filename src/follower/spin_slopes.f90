!> The roller's angular acceleration and its exact derivatives with respect to sliding speed and cam angle, from one solution of
!> the contact.
!>
!> In: model, geometry, moments, sliding speed. Out: contact, acceleration, both derivatives. The load depends on sliding speed
!> and cam angle through the equilibrium of the finger; its derivatives follow from those that Newton's method uses there.
module camroller_spin_slopes
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t, moment_slope, acceleration_slope, speed_slope_of_moments
   use camroller_gas, only : gas_force, gas_force_slope
   use camroller_contact, only : contact_basis_t, solve_at_speeds
   use camroller_dual, only : dual_t
   use camroller_joint_forces, only : finger_moment, finger_moment_slope, has_pivot_friction, set_pivot_forces
   use camroller_pivot_friction, only : pivot_forces_t, pivot_moment, hold_forces
   use camroller_contact_forces, only : contact_t, motion_t, slopes_t, bearing_by_reversal, set_speeds, follow_contact, &
      & has_oil_drag, oil_drag_slope
   use camroller_roller, only : spin_acceleration
   implicit none
   private

   public :: spin_slopes_t, evaluate_spin_slopes

   !> Contact, and angular acceleration of the roller with its derivatives
   type :: spin_slopes_t
      type(contact_t) :: contact
      !> Angular acceleration of the roller [rad/s^2]
      real(wp) :: acceleration
      !> Its derivatives over the sliding speed [rad/s/m] and, at constant sliding speed, over the cam angle [1/s^2]
      real(wp) :: speed_slope, angle_slope
      !> Change of what a contact nearby starts from: tangential force [N], torque of the bearing [N m], film ratio [-], over the
      !> sliding speed [m/s] and, at constant sliding speed, over the cam angle [rad], shape (3, 2); zero without contact
      real(wp) :: start_slopes(3, 2)
   end type spin_slopes_t

   !> Changes of forces and torque of a contact at constant load, and with the load
   type :: changes_t
      !> With ln(load), sliding speed and cam angle
      type(slopes_t) :: by_load, by_speed, by_angle
   end type changes_t

   !> Changes of the moment about the pivot that the contact makes
   type :: moment_changes_t
      !> With ln(load) [N m], sliding speed [N s] and cam angle [N m/rad]
      real(wp) :: by_load, by_speed, by_angle
   end type moment_changes_t

contains

   !> Contact and angular acceleration with its derivatives.
   pure subroutine evaluate_spin_slopes(model, angle, position, moments, sliding_speed, slopes, status, accuracy, mobilised, &
      & start, cam_gain)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Contact and acceleration with its derivatives
      type(spin_slopes_t), intent(out) :: slopes
      !> 0 fine, positive: no balance found
      integer, intent(out) :: status
      !> Relative error of load and forces that is good enough; absent: round-off [-]
      real(wp), intent(in), optional :: accuracy
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> Change of the cam's speed with the cam angle; absent: none [rad/s/rad]
      real(wp), intent(in), optional :: cam_gain

      type(contact_basis_t) :: basis
      type(changes_t) :: changes
      ! Derivative of the moments' sum over the cam angle [N m/rad]
      real(wp) :: slope
      ! Change of the load, its logarithm, over the sliding speed [s/m] and over the cam angle [1/rad]
      real(wp) :: load_by_speed, load_by_angle
      ! Change of the cam's speed [rad/s/rad]
      real(wp) :: gain

      gain = 0.0_wp
      if (present(cam_gain)) gain = cam_gain
      associate (contact => slopes%contact, speed_slope => slopes%speed_slope, angle_slope => slopes%angle_slope)
         speed_slope = 0.0_wp
         angle_slope = 0.0_wp
         slopes%acceleration = 0.0_wp
         slopes%start_slopes = 0.0_wp
         call set_speeds(model, position, sliding_speed, contact)
         call solve_at_speeds(model, position, moments, contact, basis, status, accuracy, mobilised, start)
         if (status /= 0) return
         slopes%acceleration = acceleration_of(model, contact%traction, contact%rolling_resistance, contact%bearing_torque)
         if (.not. contact%is_touching) then
            if (has_oil_drag(model)) call follow_drag(model, position, contact, basis, gain, speed_slope, angle_slope)
            return
         end if

         changes%by_load = follow_contact(model, basis%setting, contact, basis%parts, motion_t(load=1.0_wp))
         changes%by_speed = follow_contact(model, basis%setting, contact, basis%parts, speed_motion(model, contact))
         changes%by_angle = follow_contact(model, basis%setting, contact, basis%parts, angle_motion(model, position, contact, &
            & gain))
         changes%by_angle%bearing_torque = changes%by_angle%bearing_torque + by_reversal(model, contact, basis, gain)
         slope = slope_of_moments(model, angle, position, gain)
         if (model%is_consistent) then
            call follow_balance(model, position, moments, contact, slope, gain, changes, load_by_speed, load_by_angle)
         else
            load_by_speed = 0.0_wp
            load_by_angle = slope/finger_moment(model, position, moments)
            if (model%has_exact_arm) then
               load_by_angle = load_by_angle - position%normal_arm_slope/position%normal_arm
            else
               load_by_angle = load_by_angle - position%parallel_arm_slope/position%parallel_arm
            end if
            if (model%takes_maximum_load .and. contact%load <= model%base_circle_load) load_by_angle = 0.0_wp
         end if
         speed_slope = slope_along(model, changes%by_speed, changes%by_load, load_by_speed)
         angle_slope = slope_along(model, changes%by_angle, changes%by_load, load_by_angle)
         slopes%start_slopes(:, 1) = start_along(contact, changes%by_speed, changes%by_load, load_by_speed)
         slopes%start_slopes(:, 2) = start_along(contact, changes%by_angle, changes%by_load, load_by_angle)
      end associate
   end subroutine evaluate_spin_slopes

   !> Derivatives of the acceleration of a roller without contact, which the drag of its bearing alone makes.
   pure subroutine follow_drag(model, position, contact, basis, gain, speed_slope, angle_slope)
      !> The model, with drag
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> What its solution leaves behind
      type(contact_basis_t), intent(in) :: basis
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Derivatives over the sliding speed [rad/s/m] and, at constant sliding speed, over the cam angle [1/s^2]
      real(wp), intent(out) :: speed_slope, angle_slope

      type(motion_t) :: by_speed, by_angle
      ! Slope of the torque over the spin [N m s/rad]
      real(wp) :: slope

      slope = oil_drag_slope(model, contact%relative_spin)
      by_speed = speed_motion(model, contact)
      by_angle = angle_motion(model, position, contact, gain)
      speed_slope = acceleration_of(model, 0.0_wp, 0.0_wp, slope*by_speed%relative_spin)
      angle_slope = acceleration_of(model, 0.0_wp, 0.0_wp, slope*by_angle%relative_spin &
         & + by_reversal(model, contact, basis, gain))
   end subroutine follow_drag

   !> Change of the bearing's torque with that of the spin over which it reverses, which goes with the cam's speed.
   pure function by_reversal(model, contact, basis, gain) result(slope)
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> What its solution leaves behind
      type(contact_basis_t), intent(in) :: basis
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Derivative over the cam angle [N m/rad]
      real(wp) :: slope

      slope = 0.0_wp
      if (abs(gain) > 0.0_wp) slope = gain/model%speed*bearing_by_reversal(model, contact, basis%parts)
   end function by_reversal

   !> What a change of the sliding speed moves at constant load.
   pure function speed_motion(model, contact) result(motion)
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Motion for a change of one metre per second
      type(motion_t) :: motion

      motion%sliding_speed = 1.0_wp
      motion%relative_spin = -1.0_wp/model%roller_radius
      if (abs(contact%entrainment_speed) > 0.0_wp) motion%entrainment = -0.5_wp/contact%entrainment_speed
   end function speed_motion

   !> Derivative of the sum of the moments over the cam angle. A cam that gains speed adds that of the masses.
   pure function slope_of_moments(model, angle, position, gain) result(slope)
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Derivative [N m/rad]
      real(wp) :: slope

      ! Gas force [N], its derivative over the angle [N/rad]
      real(wp) :: force, gas_slope

      force = 0.0_wp
      gas_slope = 0.0_wp
      if (allocated(model%gas)) then
         force = gas_force(model%gas, angle)
         gas_slope = gas_force_slope(model%gas, angle)
      end if
      slope = moment_slope(model%train, position, model%speed, force, gas_slope)
      if (abs(model%speed_slope) > 0.0_wp) then
         slope = slope + acceleration_slope(model%train, position, model%speed*model%speed_slope)
      end if
      if (abs(gain) > 0.0_wp) slope = slope &
         & + gain*speed_slope_of_moments(model%train, position, model%speed, model%speed_slope)
   end function slope_of_moments

   !> What a change of the cam angle moves at constant load and sliding speed.
   pure function angle_motion(model, position, contact, gain) result(motion)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Motion for a change of one radian
      type(motion_t) :: motion

      motion%radius = position%radius_slope/position%equivalent_radius
      motion%roughness = contact%surfaces%roughness_slope
      motion%covered = contact%surfaces%covered_slope
      if (abs(contact%entrainment_speed) > 0.0_wp) then
         motion%entrainment = model%speed*position%surface_travel_slope/contact%entrainment_speed
      end if
      motion%relative_spin = model%speed*(merge(position%rolling_travel_slope, position%surface_travel_slope, &
         & model%has_exact_spin)/model%roller_radius - model%linkage%sense*position%finger_curvature)
      if (.not. abs(gain) > 0.0_wp) return
      if (abs(contact%entrainment_speed) > 0.0_wp) then
         motion%entrainment = motion%entrainment + gain*position%surface_travel/contact%entrainment_speed
      end if
      motion%relative_spin = motion%relative_spin + gain*(merge(position%rolling_travel, position%surface_travel, &
         & model%has_exact_spin)/model%roller_radius - model%linkage%sense*position%finger_slope)
   end function angle_motion

   !> How the load follows through `W h_W + sense (T' h_t + T_B) = moment + M_pivot`.
   pure subroutine follow_balance(model, position, moments, contact, moment_slope, gain, changes, load_by_speed, load_by_angle)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Derivative of their sum over the cam angle [N m/rad]
      real(wp), intent(in) :: moment_slope
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Changes of forces and torque
      type(changes_t), intent(in) :: changes
      !> Change of the load, its logarithm, over the sliding speed [s/m] and over the cam angle [1/rad]
      real(wp), intent(out) :: load_by_speed, load_by_angle

      type(moment_changes_t) :: moment

      moment%by_load = contact%load*position%normal_arm + model%linkage%sense*(changes%by_load%tangential_force &
         & *position%tangent_arm + changes%by_load%bearing_torque)
      moment%by_speed = model%linkage%sense*(changes%by_speed%tangential_force*position%tangent_arm &
         & + changes%by_speed%bearing_torque)
      moment%by_angle = model%linkage%sense*(changes%by_angle%tangential_force*position%tangent_arm &
         & + contact%tangential_force*position%tangent_arm_slope + changes%by_angle%bearing_torque)
      if (has_pivot_friction(model)) call follow_pivot(model, position, moments, contact, moment_slope, gain, changes, moment)
      load_by_speed = -moment%by_speed/moment%by_load
      load_by_angle = (finger_moment_slope(model, position, moments, moment_slope, gain) - contact%load*position%normal_arm_slope &
         & - moment%by_angle)/moment%by_load
   end subroutine follow_balance

   !> Take the friction of the pivot from the changes of the moment that the contact makes.
   pure subroutine follow_pivot(model, position, moments, contact, moment_slope, gain, changes, moment)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Derivative of their sum over the cam angle [N m/rad]
      real(wp), intent(in) :: moment_slope
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Changes of forces and torque
      type(changes_t), intent(in) :: changes
      !> Changes of the moment that the contact makes; out: less the friction of the pivot
      type(moment_changes_t), intent(inout) :: moment

      type(pivot_forces_t) :: forces
      ! Friction of the pivot [N m]
      type(dual_t) :: friction

      call set_pivot_forces(model, position, moments, moment_slope, forces, gain)
      friction = pivot_moment(model%joints%pivot, forces, dual_t(contact%load, 0.0_wp), &
         & dual_t(contact%tangential_force, changes%by_angle%tangential_force))
      moment%by_angle = moment%by_angle - friction%slope
      call hold_forces(forces)
      friction = pivot_moment(model%joints%pivot, forces, dual_t(contact%load, 0.0_wp), &
         & dual_t(contact%tangential_force, changes%by_speed%tangential_force))
      moment%by_speed = moment%by_speed - friction%slope
      friction = pivot_moment(model%joints%pivot, forces, dual_t(contact%load, contact%load), &
         & dual_t(contact%tangential_force, changes%by_load%tangential_force))
      moment%by_load = moment%by_load - friction%slope
   end subroutine follow_pivot

   !> Change of the angular acceleration along a motion with the load that goes with it.
   pure function slope_along(model, slopes, by_load, load) result(slope)
      type(model_t), intent(in) :: model
      !> Changes at constant load, changes with ln(load)
      type(slopes_t), intent(in) :: slopes, by_load
      !> Change of the load, its logarithm [-]
      real(wp), intent(in) :: load
      !> Change of the acceleration [rad/s^2]
      real(wp) :: slope

      slope = acceleration_of(model, slopes%traction + by_load%traction*load, &
         & slopes%rolling_resistance + by_load%rolling_resistance*load, slopes%bearing_torque + by_load%bearing_torque*load)
   end function slope_along

   !> Change along a motion, with the load that goes with it, of what a contact nearby starts from.
   pure function start_along(contact, slopes, by_load, load) result(slope)
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Changes at constant load, changes with ln(load)
      type(slopes_t), intent(in) :: slopes, by_load
      !> Change of the load, its logarithm [-]
      real(wp), intent(in) :: load
      !> Changes of tangential force [N], torque of the bearing [N m], film ratio [-]
      real(wp) :: slope(3)

      slope = [slopes%tangential_force + by_load%tangential_force*load, slopes%bearing_torque + by_load%bearing_torque*load, &
         & contact%film_ratio*(slopes%film_ratio + by_load%film_ratio*load)]
   end function start_along

   !> Angular acceleration that forces make, or its change by theirs.
   pure function acceleration_of(model, traction, rolling_resistance, bearing_torque) result(acceleration)
      type(model_t), intent(in) :: model
      !> Traction, rolling resistance [N]
      real(wp), intent(in) :: traction, rolling_resistance
      !> Torque of the roller's bearing [N m]
      real(wp), intent(in) :: bearing_torque
      !> Angular acceleration [rad/s^2]
      real(wp) :: acceleration

      acceleration = spin_acceleration(traction, merge(rolling_resistance, 0.0_wp, model%has_rolling_in_balance), &
         & model%roller_radius, bearing_torque, model%roller_inertia)
   end function acceleration_of

end module camroller_spin_slopes
