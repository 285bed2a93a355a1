!> Equations of motion of a flexible train: its rest, its geometry, its energy, its Jacobian.
module test_flexible_train
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_ramp, only : follow_ramp
   use camroller_kinematics, only : position_t, rotation_names
   use camroller_flexible_setup, only : rest_t, find_rest
   use camroller_flexible_geometry, only : touch_t, find_touch
   use camroller_flexible_train, only : flexible_state_t, resolution_t, state_size, evaluate_train, at_sliding
   use camroller_torque_list, only : of_damping
   use camroller_flexible_energy, only : powers_t, evaluate_powers, stored_energy, energy_slopes
   use camroller_flexible_problem, only : flexible_problem_t, state_scales
   use camroller_ode_problem, only : linear_t, counters_t, factors_t, new_linear, new_factors
   use camroller_samples, only : sample_independent
   use camroller_traction, only : shear_law_names, rolling_law_names
   use reference_cases, only : thesis_case, skewed_case, add_gas_force, add_heat, add_profile, make_model, set_point, &
      & point_speeds, point_viscosities
   use flexible_cases, only : add_dynamics, add_joints, choose_roller_bearing, coat_cam, random_state
   use closeness, only : check_close, check_scaled, has_failed
   implicit none
   private

   public :: collect_flexible_train

contains

   subroutine collect_flexible_train(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a train at rest on the base circle is in equilibrium", test_rest), &
         new_unittest("at rest only the roller accelerates, by friction", test_rest_is_rest), &
         new_unittest("at positions of the rigid train the geometry is that of the rigid train", test_rigid_way), &
         new_unittest("approach and speed are right at positions off the rigid train's path", test_motion), &
         new_unittest("energy closes at random states, for both senses of rotation and every part of the train", test_energy), &
         new_unittest("the rate of the stored energy agrees with a difference quotient", test_stored_rate), &
         new_unittest("slopes of the stored energy over the state agree with difference quotients", test_energy_slopes), &
         new_unittest("the Jacobian agrees with difference quotients of the rates", test_jacobian), &
         new_unittest("the reduced equations of a step have the solution of all of them", test_equations) &
         ]
   end subroutine collect_flexible_train

   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(rest_t) :: rest
      type(error_t), allocatable :: failure

      case = thesis_case()
      call add_dynamics(case, 5, .true.)
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_rest(model%flexible, model%linkage, model%train, 64.0_wp, rest, failure)
      if (has_failed(failure, error)) return
      ! The expected lift is found with the arms of the rigid train, the finger here is 1e-4 rad away from it
      call check_close(error, rest%lift, -3.44813551e-6_wp, 5.0e-7_wp, "lift")
      if (allocated(error)) return
      call check_close(error, rest%pivot, -0.193165e-6_wp, 3.0e-4_wp, "pivot")
      if (allocated(error)) return
      call check_close(error, rest%finger, 1.04768106_wp, 5.0e-9_wp, "finger")
      if (allocated(error)) return
      call check_close(error, rest%axial_force, 26.3802_wp, 2.0e-6_wp, "adjuster")
      if (allocated(error)) return
      call check_close(error, model%flexible%adjuster%spring_force, 10.6722_wp, 5.0e-6_wp, "plunger's spring")
   end subroutine test_rest

   !> State of the train at rest.
   subroutine rest_state(model, load, state, error)
      type(model_t), intent(in) :: model
      !> Base circle load [N]
      real(wp), intent(in) :: load
      !> The state [state]
      real(wp), allocatable, intent(out) :: state(:)
      type(error_type), allocatable, intent(out) :: error
      type(rest_t) :: rest
      type(error_t), allocatable :: failure

      call find_rest(model%flexible, model%linkage, model%train, load, rest, failure)
      if (has_failed(failure, error)) return
      allocate (state(state_size(model)))
      state = 0.0_wp
      state(1) = rest%finger
      state(3) = rest%lift
      if (.not. allocated(model%flexible%adjuster)) return
      state(6) = rest%pivot
      state(8) = model%flexible%adjuster%given%supply_pressure
   end subroutine rest_state

   subroutine test_rest_is_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(flexible_state_t) :: now
      real(wp), allocatable :: state(:)
      integer :: i, status

      do i = 1, 2
         case = thesis_case()
         ! No friction: it would move the finger
         deallocate (case%asperity, case%needle_bearing, case%valve_guide)
         case%traction%rolling_law = "none"
         call add_dynamics(case, 3, i == 2)
         call make_model(case, model, error)
         if (allocated(error)) return
         call rest_state(model, 64.0_wp, state, error)
         if (allocated(error)) return
         call evaluate_train(model, -pi, state, resolution_t(), now, status)
         call check(error, status, 0)
         if (allocated(error)) return
         ! The adjuster's spring is reckoned in its middle place, a fifth of a micrometre away: 1.5e-4 N
         call check_close(error, now%contact%load, 64.0_wp, 1.0e-11_wp, "load")
         if (allocated(error)) return
         call check_scaled(error, now%valve_acceleration*model%flexible%effective_mass, 0.0_wp, 210.0_wp, 1.0e-11_wp, "valve")
         if (allocated(error)) return
         call check_scaled(error, now%finger_acceleration*model%train%finger_inertia, 0.0_wp, 64.0_wp*0.0208_wp, &
            & merge(2.0e-4_wp, 1.0e-11_wp, i == 2), "finger")
         if (allocated(error)) return
      end do
   end subroutine test_rest_is_rest

   subroutine test_rigid_way(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(touch_t) :: touch
      type(position_t) :: position
      ! Cam angle [rad]
      real(wp) :: angle
      integer :: i, k, status

      do k = 1, 2
         case = skewed_case(rotation_names(k))
         call add_dynamics(case, 0, .false.)
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -180, 179, 5
            angle = (i + 0.3_wp)*degree
            call evaluate_geometry(model, angle, position, status)
            call find_touch(model, angle, position%arm_angle - model%linkage%arm_offset - model%linkage%valve_axis_angle, &
               & model%speed*position%finger_slope, 0.0_wp, 0.0_wp, touch, status)
            call check(error, status, 0)
            if (allocated(error)) return
            call check_scaled(error, touch%approach, 0.0_wp, model%linkage%a, 1.0e-14_wp, "approach")
            if (allocated(error)) return
            call check_scaled(error, touch%approach_rate, 0.0_wp, touch%travel_speed, 1.0e-12_wp, "its rate")
            if (allocated(error)) return
            call check_close(error, touch%travel_speed, model%speed*(position%rolling_travel + model%roller_radius), 1.0e-13_wp, &
               & "speed over the cam")
            if (allocated(error)) return
            call check_scaled(error, touch%normal_arm, position%normal_arm*position%finger_slope, position%normal_arm, &
               & 1.0e-12_wp, "arm of the normal")
            if (allocated(error)) return
            call check_scaled(error, touch%tangent_arm, position%cam_arm, model%linkage%d, 1.0e-13_wp, "arm of the tangent")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_rigid_way

   !> Positions along a motion of finger and pivot, by differences.
   subroutine test_motion(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(touch_t) :: touch, low, high
      ! Step and time [s], angle [rad]
      real(wp), parameter :: h = 2.0e-7_wp
      integer :: i, k, status

      do k = 1, 2
         case = skewed_case(rotation_names(k))
         case%mechanism%adjuster_tilt = 7.0_wp*degree
         call add_dynamics(case, 0, .false.)
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -170, 170, 20
            call at_time(0.0_wp, touch)
            call at_time(-h, low)
            call at_time(h, high)
            call check_scaled(error, touch%approach_rate, (high%approach - low%approach)/(2.0_wp*h), touch%travel_speed, &
               & 1.0e-8_wp, "rate of approach")
            if (allocated(error)) return
            ! The nearest point moves over the cam by S/(1 - kappa delta)
            call check_close(error, touch%travel_speed/touch%uniqueness, (high%angle - low%angle)/(2.0_wp*h) &
               & *(touch%position%rolling_travel + model%roller_radius), 1.0e-6_wp, "speed over the cam")
            if (allocated(error)) return
         end do
      end do

   contains

      !> Geometry at a time; the finger's angle and the pivot's place move evenly.
      subroutine at_time(time, place)
         real(wp), intent(in) :: time
         type(touch_t), intent(out) :: place
         type(position_t) :: position

         call evaluate_geometry(model, i*degree, position, status)
         call find_touch(model, i*degree + model%speed*time, position%arm_angle - model%linkage%arm_offset &
            & - model%linkage%valve_axis_angle + 1.0e-3_wp + 11.0_wp*time, 11.0_wp, 3.0e-4_wp + 0.4_wp*time, 0.4_wp, place, status)
      end subroutine at_time

   end subroutine test_motion

   !> A train with every part that a number asks for.
   subroutine make_train(number, model, error)
      integer, intent(in) :: number
      type(model_t), intent(out) :: model
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      if (btest(number, 0)) then
         case = skewed_case(rotation_names(1 + modulo(number/8, 2)))
         case%mechanism%adjuster_tilt = -5.0_wp*degree
      else
         case = thesis_case()
         case%mechanism%rotation = rotation_names(1 + modulo(number/8, 2))
         call set_point(case, point_speeds(3), point_viscosities(1 + modulo(number/2, 3)))
      end if
      if (btest(number, 2)) call add_gas_force(case)
      case%traction%eyring_stress = 5.0e6_wp
      case%traction%shear_law = shear_law_names(1 + modulo(number/16, 2))
      case%traction%rolling_law = rolling_law_names(1 + modulo(number/3, size(rolling_law_names)))
      if (modulo(number, 5) == 2) call add_heat(case)
      if (modulo(number, 3) == 1) call add_profile(case)
      call add_dynamics(case, merge(5, 0, modulo(number, 3) > 0), btest(number, 1))
      call choose_roller_bearing(case, modulo(number/4, 4))
      call add_joints(case, modulo(number, 5))
      call make_model(case, model, error)
   end subroutine make_train

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(flexible_state_t) :: now
      type(powers_t) :: powers
      real(wp), allocatable :: state(:)
      ! Angle [rad]
      real(wp) :: angle
      ! States in contact and out of it
      integer :: met(2)
      integer :: number, i, status

      met = 0
      do number = 0, 31
         call make_train(number, model, error)
         if (allocated(error)) return
         if (allocated(state)) deallocate (state)
         allocate (state(state_size(model)))
         do i = 1, 60
            call random_state(model, i, angle, state)
            call evaluate_train(model, angle, state, resolution_t(), now, status)
            call check(error, status, 0)
            if (allocated(error)) return
            call evaluate_powers(model, state, now, powers)
            met = met + merge([1, 0], [0, 1], now%contact%is_touching)
            ! Powers are some 1e4 times those below where oil is pressed at the stops
            call check_scaled(error, powers%residual, 0.0_wp, abs(powers%drive) + abs(powers%stored) &
               & + abs(powers%losses(of_damping)) + abs(powers%spin) &
               & + abs(now%cam%elastic*now%cam%rate) + abs(now%pad%elastic*now%pad%rate) &
               & + abs(now%pressure*model%roller_radius**2*now%pivot_rate), 2.0e-12_wp, "energy residual")
            if (allocated(error)) return
            call check(error, min(minval(powers%dampers), minval(powers%losses)) >= -1.0e-13_wp, "a loss gives power back")
            if (allocated(error)) return
         end do
      end do
      call check(error, minval(met) > 300, "few states in contact or out of it")
   end subroutine test_energy

   !> Let the inputs of a host change.
   subroutine move_inputs(model)
      type(model_t), intent(inout) :: model

      associate (ramp => model%ramp)
         ramp%is_moving = .true.
         ramp%speed = model%speed
         ramp%temperature = 360.0_wp
         ramp%temperature_slope = 3.0_wp
         model%speed_slope = 0.2_wp*model%speed
         if (allocated(model%flexible%adjuster)) then
            ramp%supply = model%flexible%adjuster%given%supply_pressure
            ramp%supply_slope = 0.05e6_wp
         end if
      end associate
   end subroutine move_inputs

   !> The stored energy a little way along the motion, for every other pair of trains at a speed that rises.
   subroutine test_stored_rate(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the difference [rad]
      real(wp), parameter :: h = 1.0e-6_wp
      type(model_t), target :: model
      type(flexible_problem_t) :: problem
      type(flexible_state_t) :: now
      type(powers_t) :: powers
      real(wp), allocatable :: state(:), rate(:)
      ! Angle [rad], energies [J]
      real(wp) :: angle, energies(-1:1)
      integer :: number, i, k, status

      do number = 0, 15
         call make_train(number, model, error)
         if (allocated(error)) return
         problem%model => model
         if (allocated(state)) deallocate (state, rate)
         allocate (state(state_size(model)), rate(state_size(model)))
         if (modulo(number, 4) > 1) call move_inputs(model)
         do i = 2, 49, 5
            call random_state(model, i, angle, state)
            call problem%get_rate(angle, state, rate, status)
            do k = -1, 1, 2
               call follow_ramp(model, angle + k*h)
               call evaluate_train(model, angle + k*h, state + k*h*rate, resolution_t(), now, status)
               energies(k) = stored_energy(model, state + k*h*rate, now)
            end do
            call follow_ramp(model, angle)
            call evaluate_train(model, angle, state, resolution_t(), now, status)
            call evaluate_powers(model, state, now, powers)
            ! Accelerations change by themselves in a time of 1e-5 s or a turn of 1e-3
            call check_scaled(error, (energies(1) - energies(-1))/(2.0_wp*h)*model%speed, powers%stored + powers%spin, &
               & abs(powers%stored) + abs(powers%spin) + 1.0_wp, 1.0e-5_wp, "rate of the stored energy")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_stored_rate

   !> The stored energy a little way along each component.
   subroutine test_energy_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the difference over the size of the component [-]
      real(wp), parameter :: h = 1.0e-5_wp
      type(model_t) :: model
      type(flexible_state_t) :: now
      real(wp), allocatable :: state(:), moved(:), scales(:), slopes(:)
      ! Angle [rad], energies [J], the largest slope [J over a scale]
      real(wp) :: angle, energies(-1:1), size_of_slopes
      integer :: number, i, k, component, status

      do number = 0, 15
         call make_train(number, model, error)
         if (allocated(error)) return
         scales = state_scales(model)
         do i = 2, 49, 5
            if (allocated(state)) deallocate (state)
            allocate (state(state_size(model)))
            call random_state(model, i, angle, state)
            call evaluate_train(model, angle, state, resolution_t(), now, status)
            slopes = energy_slopes(model, state, now)
            size_of_slopes = maxval(abs(slopes)*scales)
            do component = 1, size(state)
               do k = -1, 1, 2
                  moved = state
                  moved(component) = state(component) + k*h*scales(component)
                  call evaluate_train(model, angle, moved, resolution_t(), now, status)
                  energies(k) = stored_energy(model, moved, now)
               end do
               ! Differences hold the round-off of an energy of a joule, 1e-16/1e-5, beside slopes of 1e-3 J
               call check_scaled(error, (energies(1) - energies(-1))/(2.0_wp*h), slopes(component)*scales(component), &
                  & size_of_slopes, 1.0e-5_wp, "slope of the energy")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_energy_slopes

   subroutine test_equations(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t), target :: model
      type(flexible_problem_t) :: problem
      type(linear_t) :: linear
      type(factors_t) :: factors
      type(counters_t) :: counters
      ! State, solution [state]; right-hand side, what is left of it, largest terms of it [state/rad]
      real(wp), allocatable :: state(:), solution(:), right_side(:), left(:), terms(:)
      ! Angle [rad], shift [1/rad]
      real(wp) :: angle, shift
      integer :: number, i, j, power, status

      do number = 0, 31
         call make_train(number, model, error)
         if (allocated(error)) return
         problem%model => model
         call new_linear(linear, state_size(model))
         call new_factors(factors, state_size(model))
         if (allocated(state)) deallocate (state)
         allocate (state(state_size(model)))
         do i = 1, 30, 7
            call random_state(model, i, angle, state)
            call problem%linearise(angle, state, angle + 1.0_wp, linear, counters, status)
            call check(error, status, 0)
            if (allocated(error)) return
            right_side = state_scales(model)*[(2.0_wp*sample_independent(i, j, 11) - 1.0_wp, j=1, size(state))]
            do power = 0, 6, 2
               shift = 10.0_wp**power
               call problem%factorise(linear, shift, factors, status)
               call check(error, status, 0)
               if (allocated(error)) return
               solution = right_side
               call problem%solve(linear, factors, solution)
               left = shift*solution - matmul(linear%jacobian, solution) - right_side
               terms = shift*abs(solution) + matmul(abs(linear%jacobian), abs(solution)) + abs(right_side)
               ! Rounding: 2e-10 in the plunger's equation, beside whose speed the pressure's numbers are a million times as large
               call check(error, all(abs(left) <= 1.0e-9_wp*terms), "equations of a step")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_equations

   !> Let the roller turn so slowly against the finger that the torque of its bearing reverses.
   subroutine turn_bearing_round(model, angle, state)
      type(model_t), intent(inout) :: model
      real(wp), intent(in) :: angle ! [rad]
      real(wp), intent(inout) :: state(:)
      type(flexible_state_t) :: now
      integer :: status

      ! To the speed that it has there
      call follow_ramp(model, angle)
      call evaluate_train(model, angle, state, resolution_t(), now, status)
      state(at_sliding) = state(at_sliding) + (now%contact%relative_spin - 0.5_wp*model%bearing%reversal_spin)*model%roller_radius
   end subroutine turn_bearing_round

   subroutine test_jacobian(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t), target :: model
      type(flexible_problem_t) :: problem
      type(linear_t) :: linear
      type(counters_t) :: counters
      real(wp), allocatable :: state(:), low(:), high(:), scales(:), moved(:)
      ! Angle [rad], part of a scale that differences step [-]
      real(wp) :: angle, h
      integer :: number, i, column, status

      do number = 0, 31
         call make_train(number, model, error)
         if (allocated(error)) return
         ! So large that what the cam's speed does to its reversal stands out among the slopes
         if (allocated(model%drag)) model%drag%least = 1.0e4_wp*model%drag%least
         if (modulo(number, 3) == 0) call coat_cam(model)
         problem%model => model
         ! Every other train does not tell sliding speeds apart that differ by less than 1 cm/s
         problem%resolution%sliding_speed = merge(0.0_wp, 1.0e-2_wp, modulo(number, 2) == 0)
         if (modulo(number, 4) > 1) call move_inputs(model)
         call new_linear(linear, state_size(model))
         if (allocated(state)) deallocate (state, low, high)
         allocate (state(state_size(model)), low(state_size(model)), high(state_size(model)))
         scales = state_scales(model)
         do i = 2, 52, 5
            call random_state(model, i, angle, state)
            if (modulo(i, 3) == 0) call turn_bearing_round(model, angle, state)
            call problem%linearise(angle, state, angle + 1.0_wp, linear, counters, status)
            call check(error, status, 0)
            if (allocated(error)) return
            do column = 0, size(state)
               moved = state
               h = 1.0e-5_wp
               if (column == at_sliding) h = 1.0e-5_wp*max(abs(state(column)), 1.0e-4_wp)/scales(column)
               if (column > 0) moved(column) = state(column) + h*scales(column)
               call problem%get_rate(angle + merge(1.0e-7_wp, 0.0_wp, column == 0), moved, high, status)
               if (column > 0) moved(column) = state(column) - h*scales(column)
               call problem%get_rate(angle - merge(1.0e-7_wp, 0.0_wp, column == 0), moved, low, status)
               if (column == 0) then
                  call compare((high - low)/2.0e-7_wp, linear%time_slope, abs(linear%rate)*10.0_wp)
               else
                  call compare((high - low)/(2.0_wp*h*scales(column)), linear%jacobian(:, column), &
                     & matmul(abs(linear%jacobian), scales)/scales(column)*1.0e-3_wp)
               end if
               if (allocated(error)) return
            end do
         end do
      end do

   contains

      !> Compare a column; a difference errs by its third derivative and by round-off.
      subroutine compare(difference, slope, scale)
         !> Both, and the size of what the row holds [any]
         real(wp), intent(in) :: difference(:), slope(:), scale(:)
         integer :: row

         do row = 1, size(slope)
            call check_scaled(error, difference(row), slope(row), abs(slope(row)) + scale(row), 1.0e-4_wp, "derivative "// &
               & achar(48 + row/10)//achar(48 + modulo(row, 10))//" over "//achar(48 + column/10)// &
               & achar(48 + modulo(column, 10)))
            if (allocated(error)) return
         end do
      end subroutine compare

   end subroutine test_jacobian

end module test_flexible_train
