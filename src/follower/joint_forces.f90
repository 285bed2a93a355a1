!> Forces and moments of the sliding joints at one cam angle: valve tip, stem in seal and guide, pivot.
!>
!> In: model, geometry, moments, and for the pivot the contact's forces. Out: forces, moments on the finger, each with its
!> derivative over the cam angle.
!>
!> Frame: x from the pivot to the cam centre. The valve's axis points towards the cam, `u = (cos chi, -sin chi)`; across it, away
!> from the pivot, `e = (sin chi, cos chi)`.
module camroller_joint_forces
   use camroller_kinds, only : wp
   use camroller_dual, only : dual_t, operator(-), operator(*), operator(+)
   use camroller_guide, only : find_guide_drag
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_stem_friction, only : stem_motion_t, stem_t, find_stem_forces
   use camroller_sliding_friction, only : place_on_curve
   use camroller_pivot_friction, only : pivot_forces_t, pivot_reaction, pivot_moment
   implicit none
   private

   public :: joint_basis_t, joint_values_t, no_joints, finger_moment, finger_moment_slope, contact_moment, find_contact_moment, &
      & has_pivot_friction, set_pivot_forces, evaluate_joints, curve_count, places_on_curves

   !> Forces of the joints and the torques that they cost, each zero where the case has no such joint; not set without any joint
   type :: joint_values_t
      !> Force of the finger on the valve's tip along the axis, and friction across it [N]
      real(wp) :: tip_force, tip_friction
      !> Speed of the pad over the tip, away from the pivot positive [m/s]
      real(wp) :: tip_speed
      !> Friction of seal and of the guide's ends on the stem, with the sign of the valve's speed [N]
      real(wp) :: seal_friction, side_friction
      !> Forces of the guide's upper and lower end on the stem, sizes [N]
      real(wp) :: upper_force, lower_force
      !> Force of the ball on the finger, size [N]
      real(wp) :: pivot_force
      !> Torques for the losses of tip, seal, guide's ends and pivot [N m]
      real(wp) :: torque_tip, torque_seal, torque_side, torque_pivot
   end type joint_values_t

   !> What the joints have at a cam angle, whatever load and traction of the contact are
   type :: joint_basis_t
      !> Forces at the valve's end
      type(stem_t) :: stem
      !> What the ball's force is made of, where the pivot has friction
      type(pivot_forces_t) :: forces
   end type joint_basis_t

   !> Surfaces whose friction may follow Stribeck's curve: lower and upper end of the guide, valve tip, pivot
   integer, parameter :: curve_count = 4

   !> Joints without contact of cam and roller
   type(joint_values_t), parameter :: no_joints = joint_values_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)

contains

   !> Moment about the pivot that the contact balances: that of spring, seat, masses and gas; where the bookkeeping is closed also
   !> of the drag of the guide and of friction at tip and stem. The pivot's own depends on the contact's load.
   pure function finger_moment(model, position, moments) result(moment)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Moment [N m]
      real(wp) :: moment

      type(stem_t) :: stem

      if (model%is_consistent .and. allocated(model%joints)) call set_stem(model, position, moments, 0.0_wp, stem)
      moment = moment_with(model, position, moments, stem)
   end function finger_moment

   !> The same with the forces at the valve's end, where the case has joints.
   pure function moment_with(model, position, moments, stem) result(moment)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Forces at the valve's end
      type(stem_t), intent(in) :: stem
      !> Moment [N m]
      real(wp) :: moment

      ! Drag of the guide over the valve's speed, its slope [N s/m]
      real(wp) :: drag, drag_slope
      ! Moment of the joints [N m]
      type(dual_t) :: friction

      moment = moments%total
      if (.not. model%is_consistent) return
      if (allocated(model%guide)) then
         call find_guide_drag(model%guide, model%speed*position%lift_slope, drag, drag_slope)
         moment = moment + drag*model%speed*position%lift_slope*position%valve_arm
      end if
      if (.not. allocated(model%joints)) return
      friction = stem_moment(position, stem)
      moment = moment + friction%value
   end function moment_with

   !> Its derivative over the cam angle.
   pure function finger_moment_slope(model, position, moments, moment_slope, gain) result(slope)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Derivative of the sum of the moments [N m/rad]
      real(wp), intent(in) :: moment_slope
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Derivative [N m/rad]
      real(wp) :: slope

      type(stem_t) :: stem
      ! Drag of the guide over the valve's speed, its slope [N s/m]
      real(wp) :: drag, drag_slope
      ! Moment of the joints [N m]
      type(dual_t) :: friction

      slope = moment_slope
      if (.not. model%is_consistent) return
      if (allocated(model%guide)) then
         call find_guide_drag(model%guide, model%speed*position%lift_slope, drag, drag_slope)
         slope = slope + drag*model%speed &
            & *(position%lift_curvature*position%valve_arm + position%lift_slope*position%valve_arm_slope) &
            & + gain*drag*position%lift_slope*position%valve_arm &
            & + (drag_slope - drag)*(model%speed*position%lift_curvature + gain*position%lift_slope)*position%valve_arm
      end if
      if (.not. allocated(model%joints)) return
      call set_stem(model, position, moments, axial_slope(model, position, moments, moment_slope, gain), stem, gain)
      friction = stem_moment(position, stem)
      slope = slope + friction%slope
   end function finger_moment_slope

   !> Moment that keeps cam and roller in contact: what the contact balances as its load vanishes.
   pure function contact_moment(model, position, moments) result(moment)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Moment [N m]
      real(wp) :: moment

      type(pivot_forces_t) :: forces
      ! Friction of the pivot [N m]
      type(dual_t) :: friction

      call find_contact_moment(model, position, moments, moment, forces, friction)
   end function contact_moment

   !> The same with what the pivot's friction is made of, where it has any.
   pure subroutine find_contact_moment(model, position, moments, moment, forces, unloaded, basis)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Moment that keeps cam and roller in contact [N m]
      real(wp), intent(out) :: moment
      !> What the ball's force is made of
      type(pivot_forces_t), intent(out) :: forces
      !> Friction of the pivot without a contact load [N m]
      type(dual_t), intent(out) :: unloaded
      !> What `evaluate_joints` would find again at this angle, allocated where the moment takes it
      type(joint_basis_t), allocatable, intent(out), optional :: basis

      type(stem_t) :: stem

      if (.not. ((model%is_consistent .and. allocated(model%joints)) .or. has_pivot_friction(model))) then
         moment = finger_moment(model, position, moments)
         return
      end if
      call set_stem(model, position, moments, 0.0_wp, stem)
      moment = moment_with(model, position, moments, stem)
      if (has_pivot_friction(model)) then
         call place_forces(model, position, stem, forces)
         unloaded = pivot_moment(model%joints%pivot, forces, dual_t(0.0_wp, 0.0_wp), dual_t(0.0_wp, 0.0_wp))
         moment = moment + unloaded%value
      end if
      if (present(basis)) basis = joint_basis_t(stem, forces)
   end subroutine find_contact_moment

   !> Does the finger's pivot have friction?
   pure function has_pivot_friction(model) result(has)
      !> The model
      type(model_t), intent(in) :: model
      !> Does it?
      logical :: has

      has = allocated(model%joints)
      if (has) has = allocated(model%joints%pivot)
   end function has_pivot_friction

   !> What the ball's force is made of.
   pure subroutine set_pivot_forces(model, position, moments, moment_slope, forces, gain)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Derivative of their sum over the cam angle, where slopes are wanted [N m/rad]
      real(wp), intent(in) :: moment_slope
      !> What it is made of
      type(pivot_forces_t), intent(out) :: forces
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain

      type(stem_t) :: stem

      call set_stem(model, position, moments, axial_slope(model, position, moments, moment_slope, gain), stem, gain)
      call place_forces(model, position, stem, forces, gain)
   end subroutine set_pivot_forces

   !> Forces and torques of a state whose contact is solved.
   pure subroutine evaluate_joints(model, position, moments, load, tangential_force, values, basis)
      !> The model, which has joints
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Contact load, W, and net tangential force on the roller, T' [N]
      real(wp), intent(in) :: load, tangential_force
      !> Forces and torques
      type(joint_values_t), intent(out) :: values
      !> What the solution of the contact has found at this angle
      type(joint_basis_t), intent(in), optional :: basis

      type(joint_basis_t) :: own
      ! Force of the ball [N]; friction of the pivot [N m]
      type(dual_t) :: reaction(2), friction

      if (present(basis)) then
         own = basis
      else
         call set_stem(model, position, moments, 0.0_wp, own%stem)
         if (has_pivot_friction(model)) call place_forces(model, position, own%stem, own%forces)
      end if
      associate (stem => own%stem)
         values%tip_force = stem%tip_force%value
         values%tip_friction = stem%tip_friction%value
         values%tip_speed = stem%tip_speed%value
         values%seal_friction = stem%seal_friction%value
         values%side_friction = stem%side_friction%value
         values%upper_force = stem%upper_force
         values%lower_force = stem%lower_force
      end associate
      values%torque_tip = values%tip_friction*values%tip_speed/model%speed
      values%torque_seal = values%seal_friction*position%lift_slope
      values%torque_side = values%side_friction*position%lift_slope
      values%pivot_force = 0.0_wp
      values%torque_pivot = 0.0_wp
      if (.not. has_pivot_friction(model)) return
      reaction = pivot_reaction(own%forces, dual_t(load, 0.0_wp), dual_t(tangential_force, 0.0_wp))
      values%pivot_force = norm2(reaction%value)
      friction = pivot_moment(model%joints%pivot, own%forces, dual_t(load, 0.0_wp), dual_t(tangential_force, 0.0_wp))
      values%torque_pivot = friction%value*position%finger_slope
   end subroutine evaluate_joints

   !> Where each surface is on Stribeck's curve (`place_on_curve`), the pivot under the load that needs no traction.
   pure function places_on_curves(model, position, moments) result(places)
      !> The model, which has joints
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Two logarithms for each; below zero where there is no curve [-]
      real(wp) :: places(2, curve_count)

      type(stem_t) :: stem
      type(pivot_forces_t) :: forces
      ! Force of the ball [N]
      type(dual_t) :: reaction(2)

      places = -1.0_wp
      call set_stem(model, position, moments, 0.0_wp, stem)
      associate (joints => model%joints, valve_speed => model%speed*position%lift_slope)
         if (allocated(joints%side)) then
            places(:, 1) = place_on_curve(joints%side%law, stem%lower_force, valve_speed)
            places(:, 2) = place_on_curve(joints%side%law, stem%upper_force, valve_speed)
         end if
         if (allocated(joints%tip)) places(:, 3) = place_on_curve(joints%tip%law, stem%tip_force%value, stem%tip_speed%value)
         if (.not. allocated(joints%pivot)) return
         call place_forces(model, position, stem, forces)
         reaction = pivot_reaction(forces, dual_t(moment_with(model, position, moments, stem)/position%normal_arm, 0.0_wp), &
            & dual_t(0.0_wp, 0.0_wp))
         places(:, 4) = place_on_curve(joints%pivot%law, norm2(reaction%value), joints%pivot%ball_radius*model%speed &
            & *position%finger_slope)
      end associate
   end function places_on_curves

   !> Forces at the valve's end of the finger.
   pure subroutine set_stem(model, position, moments, axial_slope, stem, gain)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Derivative over the cam angle of what spring, seat, valve and gas need at the tip [N/rad]
      real(wp), intent(in) :: axial_slope
      !> The forces
      type(stem_t), intent(out) :: stem
      !> Change of the cam's speed with the cam angle; absent: none [rad/s/rad]
      real(wp), intent(in), optional :: gain

      type(stem_motion_t) :: motion
      type(dual_t) :: speed ! of the cam [rad/s]
      ! Drag of the guide over the valve's speed, its slope [N s/m]
      real(wp) :: drag, drag_slope

      speed = cam_speed(model, gain)
      motion%lift = dual_t(position%lift, position%lift_slope)
      motion%valve_speed = speed*dual_t(position%lift_slope, position%lift_curvature)
      motion%finger_speed = speed*dual_t(position%finger_slope, position%finger_curvature)
      motion%centre_height = model%linkage%b*model%linkage%base_cosine - motion%lift
      motion%arm = dual_t(position%valve_arm, position%valve_arm_slope)
      motion%axial_force = dual_t(axial_force(position, moments), axial_slope)
      if (allocated(model%guide)) then
         call find_guide_drag(model%guide, motion%valve_speed%value, drag, drag_slope)
         motion%axial_force = motion%axial_force + dual_t(drag*motion%valve_speed%value, drag_slope*motion%valve_speed%slope)
      end if
      call find_stem_forces(model%joints%tip, model%joints%seal, model%joints%side, motion, stem)
   end subroutine set_stem

   !> Speed of the cam with its change over the cam angle.
   pure function cam_speed(model, gain) result(speed)
      type(model_t), intent(in) :: model
      !> The change; absent: none [rad/s/rad]
      real(wp), intent(in), optional :: gain
      !> The speed [rad/s]
      type(dual_t) :: speed

      speed%value = model%speed
      if (present(gain)) speed%slope = gain
   end function cam_speed

   !> Force that spring, seat, valve and gas need at the tip.
   pure function axial_force(position, moments) result(force)
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Force [N]
      real(wp) :: force

      force = (moments%spring - moments%seat + moments%valve + moments%gas)/position%valve_arm
   end function axial_force

   !> Its derivative over the cam angle, from that of the sum of the moments less the finger's.
   pure function axial_slope(model, position, moments, moment_slope, gain) result(slope)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Derivative of their sum over the cam angle [N m/rad]
      real(wp), intent(in) :: moment_slope
      !> Change of the cam's speed with the cam angle [rad/s/rad]
      real(wp), intent(in) :: gain
      !> Derivative [N/rad]
      real(wp) :: slope

      ! Change of the finger's angular acceleration [1/s^2]
      real(wp) :: acceleration

      acceleration = model%speed*(model%speed*position%finger_jerk + model%speed_slope*position%finger_curvature) &
         & + gain*(2.0_wp*model%speed*position%finger_curvature + model%speed_slope*position%finger_slope)
      slope = (moment_slope - model%train%finger_inertia*acceleration &
         & - axial_force(position, moments)*position%valve_arm_slope)/position%valve_arm
   end function axial_slope

   !> Moment of friction at tip and stem, positive where it presses the roller on the cam.
   pure function stem_moment(position, stem) result(moment)
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Forces at the valve's end
      type(stem_t), intent(in) :: stem
      !> Moment [N m]
      type(dual_t) :: moment

      moment = (stem%seal_friction + stem%side_friction)*dual_t(position%valve_arm, position%valve_arm_slope) &
         & + stem%tip_friction*stem%height
   end function stem_moment

   !> Forces on the finger but for load and traction, and the directions of these.
   pure subroutine place_forces(model, position, stem, forces, gain)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Forces at the valve's end
      type(stem_t), intent(in) :: stem
      !> What the ball's force is made of
      type(pivot_forces_t), intent(out) :: forces
      !> Change of the cam's speed with the cam angle; absent: none [rad/s/rad]
      real(wp), intent(in), optional :: gain

      ! Directions along and across the roller arm [-]; speed of the cam [rad/s]; angular acceleration of the finger [rad/s^2]
      type(dual_t) :: along(2), across(2), speed, acceleration
      ! Sine and cosine of the roller arm's angle [-]; length of the arm [m]
      real(wp) :: sine, cosine, length

      cosine = cos(position%arm_angle)
      sine = sin(position%arm_angle)
      along = [dual_t(cosine, -sine*position%finger_slope), dual_t(sine, cosine*position%finger_slope)]
      across = [-along(2), along(1)]
      length = model%linkage%a
      forces%normal = across*dual_t(position%normal_arm/length, position%normal_arm_slope/length) &
         & - along*dual_t(position%tangent_arm/length, position%tangent_arm_slope/length)
      forces%tangent = model%linkage%sense*(across*dual_t(position%tangent_arm/length, position%tangent_arm_slope/length) &
         & + along*dual_t(position%normal_arm/length, position%normal_arm_slope/length))
      speed = cam_speed(model, gain)
      forces%finger_speed = speed*dual_t(position%finger_slope, position%finger_curvature)
      acceleration = speed*(speed*dual_t(position%finger_curvature, position%finger_jerk) &
         & + model%speed_slope*dual_t(position%finger_slope, position%finger_curvature))
      associate (chi_cosine => model%linkage%axis_cosine, chi_sine => model%linkage%axis_sine)
         forces%rest = [chi_sine*stem%tip_friction - chi_cosine*stem%tip_force, &
            & chi_cosine*stem%tip_friction + chi_sine*stem%tip_force]
      end associate
      forces%rest = forces%rest + model%pivot%mass*model%pivot%centre*(acceleration*across &
         & - forces%finger_speed*forces%finger_speed*along)
   end subroutine place_forces

end module camroller_joint_forces
