!> How the pad's force follows the state of a flexible train, and how friction at tip, stem and pivot changes its accelerations.
!>
!> In: everything at a state. Out: slopes of the pad's force; what friction adds to the slopes of the accelerations of finger and
!> pivot, and of the force on the valve. The pad's force, and with it the friction at the valve's end, follows six variables: the
!> finger's angle and rate, place and speed of the pivot, lift and speed of the valve.
module camroller_flexible_joints
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_stem_friction, only : stem_motion_t, stem_t, rub_stem
   use camroller_flexible_geometry, only : dot, imaginary
   use camroller_flexible_train, only : flexible_state_t, stem_motion, valve_axis, at_finger_rate
   implicit none
   private

   public :: columns, variables, by_finger, by_finger_rate, by_pivot, by_pivot_rate, by_sliding, by_angle, by_lift, by_speed, &
      & by_pressure, stem_slopes_t, pad_slopes, follow_stem, follow_ball

   !> The six variables of geometry and contact; then those that the accelerations follow beside them
   integer, parameter :: variables = 6, columns = 9, by_finger = 1, by_finger_rate = 2, by_pivot = 3, by_pivot_rate = 4, &
      & by_sliding = 5, by_angle = 6, by_lift = 7, by_speed = 8, by_pressure = 9
   !> The six variables of the valve's end among these
   integer, parameter :: of_pad(6) = [by_finger, by_finger_rate, by_pivot, by_pivot_rate, by_lift, by_speed]

   !> Friction at the valve's end over its six variables
   type :: stem_slopes_t
      !> Friction of the tip, that of seal and guide on the valve [N over the unit of the variable]
      real(wp) :: tip(6) = 0.0_wp, valve(6) = 0.0_wp
   end type stem_slopes_t

contains

   !> The pad's force over gamma, its rate, y, its rate, lift and speed of the valve.
   pure function pad_slopes(model, state, now) result(slopes)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The slopes [N over the unit of the variable]
      real(wp) :: slopes(6)

      associate (pad => now%pad, b => model%linkage%b, tilt => model%flexible%tilt_cosine)
         slopes(by_finger) = pad%by_approach*b*now%pad_sine + pad%by_rate*b*now%pad_cosine*state(at_finger_rate)
         slopes(by_finger_rate) = pad%by_rate*b*now%pad_sine
         slopes(by_pivot) = -pad%by_approach*tilt
         slopes(by_pivot_rate) = -pad%by_rate*tilt
         slopes(5) = -pad%by_approach
         slopes(6) = -pad%by_rate
      end associate
   end function pad_slopes

   !> Add what the friction at the valve's end does.
   pure subroutine follow_stem(model, state, now, pad, inverse, slopes, finger, pivot)
      !> The model, with joints
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The pad's force over the six variables [N over the unit of the variable]
      real(wp), intent(in) :: pad(6)
      !> Accelerations of finger and pivot over moment and force [1/kg m^2], [1/kg m], [1/kg]
      real(wp), intent(in) :: inverse(2, 2)
      !> Friction over the six variables
      type(stem_slopes_t), intent(out) :: slopes
      !> Slopes of the accelerations [rad/s^2], [m/s^2] over the unit of the variable
      real(wp), intent(inout) :: finger(columns), pivot(columns)

      type(stem_t) :: stem
      ! Moment on the finger [N m], force on it along the adjuster's axis [N], over the unit of the variable
      real(wp) :: moment, axial
      integer :: i

      do i = 1, size(of_pad)
         call rub_stem(model%joints%tip, model%joints%seal, model%joints%side, motion_along(model, state, now, pad, i), stem)
         slopes%tip(i) = stem%tip_friction%slope
         slopes%valve(i) = stem%seal_friction%slope + stem%side_friction%slope
         moment = -stem%tip_friction%slope*stem%height%value - stem%tip_friction%value*stem%height%slope
         axial = -model%flexible%tilt_sine*stem%tip_friction%slope
         associate (column => of_pad(i))
            finger(column) = finger(column) + inverse(1, 1)*moment + inverse(1, 2)*axial
            pivot(column) = pivot(column) + inverse(2, 1)*moment + inverse(2, 2)*axial
         end associate
      end do
   end subroutine follow_stem

   !> Motion of pad and stem along one of their six variables.
   pure function motion_along(model, state, now, pad, variable) result(motion)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The pad's force over the six variables [N over the unit of the variable]
      real(wp), intent(in) :: pad(6)
      !> Which variable
      integer, intent(in) :: variable
      !> The motion with its slopes
      type(stem_motion_t) :: motion

      motion = stem_motion(model, state, now)
      motion%axial_force%slope = pad(variable)
      select case (of_pad(variable))
      case (by_finger)
         motion%centre_height%slope = -model%linkage%b*now%pad_sine
         motion%arm%slope = model%linkage%b*now%pad_cosine
      case (by_finger_rate)
         motion%finger_speed%slope = 1.0_wp
      case (by_pivot)
         motion%arm%slope = model%flexible%tilt_sine
      case (by_pivot_rate)
         motion%pivot_speed%slope = model%flexible%tilt_sine
      case (by_lift)
         motion%lift%slope = 1.0_wp
      case default
         motion%valve_speed%slope = 1.0_wp
      end select
   end function motion_along

   !> Add what the friction on the pivot's ball does, whose force follows the accelerations.
   pure subroutine follow_ball(model, state, now, cam_force, pad, stem, inverse, finger, pivot)
      !> The model, whose pivot has friction
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> Force of the cam on the roller over the first six variables [N over the unit of the variable]
      complex(wp), intent(in) :: cam_force(variables)
      !> The pad's force over the six variables of the valve's end [N over the unit of the variable], and its friction
      real(wp), intent(in) :: pad(6)
      type(stem_slopes_t), intent(in) :: stem
      !> Accelerations of finger and pivot over moment and force [1/kg m^2], [1/kg m], [1/kg]
      real(wp), intent(in) :: inverse(2, 2)
      !> In: slopes of the accelerations at this moment of the friction; out: with its own [rad/s^2], [m/s^2] over the unit of the
      !> variable
      real(wp), intent(inout) :: finger(columns), pivot(columns)

      ! Change of the force at constant accelerations [N]; finger's centre of mass from the pivot [m]; direction of the force [-]
      complex(wp) :: force(columns), centre, direction
      ! Change of the moment of the friction [N m over the unit of the variable]
      real(wp) :: moment(columns)

      associate (flexible => model%flexible, ball => now%joint_friction%ball, rate => state(at_finger_rate))
         if (.not. abs(ball%force) > 0.0_wp) return
         direction = ball%force/abs(ball%force)
         centre = now%touch%arm*(flexible%finger_centre/model%linkage%a)
         force = (0.0_wp, 0.0_wp)
         force(:variables) = -cam_force
         force(of_pad) = force(of_pad) - (pad - imaginary*stem%tip)*valve_axis(model%linkage)
         force(by_finger) = force(by_finger) + flexible%finger_mass*(imaginary*now%finger_acceleration - rate**2)*imaginary*centre
         force(by_finger_rate) = force(by_finger_rate) - 2.0_wp*flexible%finger_mass*rate*centre
         force = force + flexible%finger_mass*(pivot*flexible%axis + imaginary*finger*centre)
         moment = ball%by_force*real(conjg(direction)*force, wp)
         moment(by_finger_rate) = moment(by_finger_rate) + ball%by_rate
         moment = moment/(1.0_wp + ball%by_force*dot(direction, ball%by_moment))
         finger = finger - inverse(1, 1)*moment
         pivot = pivot - inverse(2, 1)*moment
      end associate
   end subroutine follow_ball

end module camroller_flexible_joints
