!> The contact at one angle: balance, consistency of its parts, loss of contact; the roller's balance.
module test_contact
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, degree
   use camroller_number_text, only : integer_text
   use camroller_case, only : case_t
   use camroller_guide, only : find_guide_drag
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t, rotation_names
   use camroller_state, only : state_t, evaluate_state, cam_force
   use camroller_film, only : film_law_names
   use camroller_balance, only : find_balance
   use camroller_spin, only : rolling_speed_slope
   use camroller_torque_list, only : of_contact
   use closeness, only : check_close, check_scaled
   use reference_cases, only : thesis_case, source_case, skewed_case, make_model, set_point, add_gas_force, add_heat, &
      add_pin_film, add_profile, add_skf_needles, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_contact

   !> Sliding speeds over the speed of pure rolling [-]
   real(wp), parameter :: slips(7) = [-1.0_wp, -1.0e-2_wp, 0.0_wp, 1.0e-5_wp, 1.0e-2_wp, 0.5_wp, 2.5_wp]
   !> Accuracy of the roller's balance over the speed of pure rolling [-]
   real(wp), parameter :: slip_tolerance = 1.0e-14_wp

contains

   subroutine collect_contact(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("moments of load and friction on the finger balance for every law, angle and slip", test_balance_of_finger), &
         new_unittest("with energy 'source' the load is that without friction on the parallel arm", test_source_load), &
         new_unittest("with seating 'maximum' the load is never below the base circle load", test_maximum), &
         new_unittest("surface speeds, spin and entrainment speed are consistent", test_speeds), &
         new_unittest("boundary friction is mobilised or full, as the case asks", test_boundary), &
         new_unittest("guide drag and gas force change the load by their moments about the pivot", test_valve_forces), &
         new_unittest("where contact is lost all contact forces are zero", test_no_contact), &
         new_unittest("at an entrainment speed of zero the state is finite", test_standstill), &
         new_unittest("at the quasi-static balance the spin acceleration is that of the kinematics", test_balance_of_roller), &
         new_unittest("the decay rate agrees with a difference quotient of the roller equation", test_decay_rate), &
         new_unittest("cam angles one turn apart give the same state", test_turns), &
         new_unittest("all of a contact has the accuracy asked for, and the finger is in balance", test_accuracy) &
         ]
   end subroutine collect_contact

   !> Moment too much about the pivot, over the largest.
   function imbalance(model, state) result(excess)
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      real(wp) :: excess

      ! Speed of the valve [m/s]; drag over it, its slope [N s/m]
      real(wp) :: valve_speed, drag, drag_slope

      excess = state%moments%total
      if (allocated(model%guide)) then
         valve_speed = model%speed*state%position%lift_slope
         call find_guide_drag(model%guide, valve_speed, drag, drag_slope)
         excess = excess + drag*valve_speed*state%position%valve_arm
      end if
      excess = state%contact%load*state%position%normal_arm - excess + model%linkage%sense &
         *(state%contact%tangential_force*state%position%tangent_arm + state%contact%bearing_torque)
   end function imbalance

   !> Contacts that start from others at sliding speeds more or less beside them, of which some end with the first evaluation and a
   !> step that is as long as it may be.
   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      ! Accuracy; error of the last step, whose curvature is five, and that of a share which is not quite found, over it [-]
      real(wp), parameter :: accuracy = 1.0e-6_wp, several = 10.0_wp
      ! Sliding speeds over that of the cam [m]; that of the other contact over it [-]
      real(wp), parameter :: speeds(2) = [2.0e-4_wp, 2.0e-2_wp], others(5) = [1.0003_wp, 1.001_wp, 1.003_wp, 1.01_wp, 1.1_wp]
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: exact, beside, state
      ! Largest magnitude of each quantity, and of its errors [unit of each]
      real(wp), allocatable :: sizes(:), errors(:)
      integer :: kind, i, speed, other, status

      do kind = 1, 5
         case = skewed_case(rotation_names(1))
         if (kind == 2) call add_heat(case)
         if (kind == 3) call add_profile(case)
         if (kind == 4) call add_pin_film(case, "finite")
         if (kind == 5) call add_skf_needles(case)
         call make_model(case, model, error)
         if (allocated(error)) return
         sizes = [(0.0_wp, i=1, 16)]
         errors = sizes
         do i = -12, 12
            do speed = 1, size(speeds)
               call evaluate_state(model, (5*i + 1)*degree, speeds(speed)*model%speed, exact, status)
               sizes = max(sizes, abs(quantities(exact)))
               do other = 1, size(others)
                  call evaluate_state(model, (5*i + 1)*degree, others(other)*speeds(speed)*model%speed, beside, status)
                  call evaluate_state(model, (5*i + 1)*degree, speeds(speed)*model%speed, state, status, start=beside%contact, &
                     accuracy=accuracy)
                  call check_scaled(error, imbalance(model, state), 0.0_wp, state%moments%spring, 4.0e-14_wp, "balance")
                  if (allocated(error)) return
                  errors = max(errors, abs(quantities(state) - quantities(exact)))
               end do
            end do
         end do
         do i = 1, size(errors)
            call check_scaled(error, errors(i), 0.0_wp, max(sizes(i), tiny(1.0_wp)), several*accuracy, &
               "quantity "//integer_text(i)//" of case "//integer_text(kind))
            if (allocated(error)) return
         end do
      end do

   contains

      !> What a contact consists of.
      pure function quantities(of) result(values)
         type(state_t), intent(in) :: of
         ! [unit of each]
         real(wp) :: values(16)

         associate (contact => of%contact)
            values = [contact%load, contact%half_width, contact%apparent_area, contact%length, contact%film_min, &
               contact%film_central, contact%asperity_load, contact%real_area, contact%shear, contact%boundary_capacity, &
               contact%rolling_resistance, contact%tangential_force, contact%bearing_torque, contact%film_rise, &
               contact%flash_rise, contact%inlet_factor]
         end associate
      end function quantities

   end subroutine test_accuracy

   subroutine test_balance_of_finger(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: law, sense, i, k, status

      do law = 1, size(film_law_names)
         do sense = 1, 2
            case = skewed_case(rotation_names(sense))
            case%film%law = film_law_names(law)
            case%traction%cap = merge("smooth", "sharp ", law /= 2)
            call set_point(case, point_speeds(sense), point_viscosities(1 + mod(law, 3)))
            call make_model(case, model, error)
            if (allocated(error)) return
            do i = -12, 12
               do k = 1, size(slips)
                  call evaluate_state(model, (5*i + 1)*degree, slips(k)*0.02_wp*model%speed, state, status)
                  call check(error, status, 0)
                  if (allocated(error)) return
                  call check_scaled(error, imbalance(model, state), 0.0_wp, state%moments%spring, 4.0e-14_wp, "balance")
                  if (allocated(error)) return
               end do
            end do
         end do
      end do
   end subroutine test_balance_of_finger

   subroutine test_source_load(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, status

      call make_model(source_case(), model, error)
      if (allocated(error)) return
      do i = -18, 18
         call evaluate_state(model, 5*i*degree, 0.01_wp, state, status)
         call check_close(error, state%contact%load, state%moments%total/state%position%parallel_arm, 1.0e-14_wp, "load")
         if (allocated(error)) return
         call check_scaled(error, state%torques(of_contact), state%contact_friction*state%position%cam_arm, 0.01_wp, 1.0e-14_wp, &
            "torque")
         if (allocated(error)) return
         call check_close(error, state%contact%rolling_speed, state%contact%cam_surface_speed, 1.0e-14_wp, "pure rolling")
         if (allocated(error)) return
      end do
   end subroutine test_source_load

   subroutine test_maximum(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Load of the spring alone [N]
      real(wp) :: event
      integer :: i, status

      case = source_case()
      case%spring%stiffness = 2500.0_wp
      case%spring%seating = "maximum"
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = -18, 18
         call evaluate_state(model, 5*i*degree, 0.01_wp, state, status)
         event = (2500.0_wp*(state%position%lift + 8.4e-3_wp)*state%position%valve_arm + state%moments%valve &
            + state%moments%finger)/state%position%parallel_arm
         call check_close(error, state%contact%load, max(64.0_wp, event), 1.0e-13_wp, "load")
         if (allocated(error)) return
      end do
   end subroutine test_maximum

   subroutine test_speeds(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, k, sense, status

      do sense = 1, 2
         case = skewed_case(rotation_names(sense))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -11, 12
            do k = 1, size(slips)
               call evaluate_state(model, 5*i*degree, slips(k)*0.02_wp*model%speed, state, status)
               associate (c => state%contact)
                  call check_scaled(error, c%cam_surface_speed - c%roller_surface_speed, c%sliding_speed, 1.0_wp, 1.0e-15_wp, "V_s")
                  if (allocated(error)) return
                  call check_scaled(error, 0.5_wp*(c%cam_surface_speed + c%roller_surface_speed), c%entrainment_speed, 1.0_wp, &
                     1.0e-15_wp, "V_e")
                  if (allocated(error)) return
                  call check_scaled(error, c%rolling_speed - model%roller_radius*c%roller_spin, c%sliding_speed, 1.0_wp, &
                     1.0e-15_wp, "spin")
                  if (allocated(error)) return
                  ! pure rolling by the arms: omega (h_F - sense gamma' h_t)
                  call check_close(error, c%rolling_speed, model%speed*(state%position%cam_arm - model%linkage%sense &
                     *state%position%finger_slope*state%position%tangent_arm), 1.0e-13_wp, "V_roll")
                  if (allocated(error)) return
                  call check_scaled(error, c%relative_spin, c%roller_spin - model%linkage%sense*state%position%finger_slope &
                     *model%speed, model%speed, 1.0e-14_wp, "relative spin")
                  if (allocated(error)) return
               end associate
            end do
         end do
      end do
   end subroutine test_speeds

   subroutine test_boundary(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: mobilised, full
      integer :: status

      case = source_case()
      case%asperity%film_shear_strength = 2.0e6_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_state(model, 0.0_wp, 2.0e-4_wp, full, status)
      case%asperity%boundary = "mobilised"
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_state(model, 0.0_wp, 2.0e-4_wp, mobilised, status)
      call check_close(error, full%contact%boundary_capacity, 2.0e6_wp*full%contact%real_area &
         + 0.2_wp*full%contact%asperity_load, 1.0e-14_wp, "capacity")
      if (allocated(error)) return
      call check_close(error, full%boundary_friction, full%contact%boundary_capacity, 1.0e-15_wp, "full")
      if (allocated(error)) return
      call check_close(error, mobilised%boundary_friction, full%contact%boundary_capacity*tanh(0.2_wp), 1.0e-14_wp, "mobilised")
      if (allocated(error)) return
      call check_close(error, mobilised%contact%traction, full%contact%traction, 1.0e-14_wp, "traction")
      if (allocated(error)) return
      call check_close(error, full%contact_friction - full%boundary_friction, mobilised%contact_friction &
         - mobilised%boundary_friction, 1.0e-12_wp, "the rest of the friction")
   end subroutine test_boundary

   subroutine test_valve_forces(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: plain, loaded
      type(state_t) :: without, with
      ! Force of gas and guide at the valve [N]
      real(wp) :: force
      integer :: i, status

      case = thesis_case()
      case%traction%rolling_law = "none"
      deallocate (case%valve_guide, case%needle_bearing, case%asperity)
      call make_model(case, plain, error)
      if (allocated(error)) return
      call add_gas_force(case)
      allocate (case%valve_guide)
      case%valve_guide%length = 36.0e-3_wp
      case%valve_guide%stem_diameter = 5.0e-3_wp
      case%valve_guide%radial_clearance = 0.02e-3_wp
      call make_model(case, loaded, error)
      if (allocated(error)) return
      do i = -60, 60, 10
         ! no slip, no traction: what is left is the load of the valve's forces
         call evaluate_state(plain, i*degree, 0.0_wp, without, status)
         call evaluate_state(loaded, i*degree, 0.0_wp, with, status)
         force = with%gas_force + 0.01_wp*pi*5.0e-3_wp*36.0e-3_wp/0.02e-3_wp*loaded%speed*with%position%lift_slope
         call check_close(error, (with%contact%load - without%contact%load)*with%position%normal_arm, &
            force*with%position%valve_arm, 1.0e-10_wp, "moment of guide and gas")
         if (allocated(error)) return
      end do
   end subroutine test_valve_forces

   subroutine test_no_contact(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, k, status, free

      free = 0
      do k = 1, 2
         case = thesis_case()
         if (k == 2) case = source_case()
         call set_point(case, 6.0_wp*point_speeds(3), point_viscosities(2))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -70, 70
            call evaluate_state(model, i*degree, 0.5_wp, state, status)
            call check(error, status, 0)
            if (allocated(error)) return
            if (state%contact%is_touching) cycle
            free = free + 1
            call check(error, max(abs(state%contact%load), abs(state%contact%traction), abs(state%contact%bearing_torque), &
               abs(state%contact%rolling_resistance), abs(state%torque_drive), abs(state%spin_acceleration), &
               maxval(abs(cam_force(model, state))), abs(state%contact%traction_slope)) <= 0.0_wp, "a force is left")
            if (allocated(error)) return
         end do
      end do
      call check(error, free > 20, "contact is not lost")
   end subroutine test_no_contact

   subroutine test_standstill(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state, near
      integer :: i, status

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = -60, 60, 20
         call evaluate_state(model, i*degree, 0.0_wp, state, status)
         ! V_e = V_c - V_s/2 vanishes: the roller's surface runs backwards as fast as the cam's
         call evaluate_state(model, i*degree, 2.0_wp*state%contact%cam_surface_speed, state, status)
         call check(error, status, 0)
         if (allocated(error)) return
         call check(error, state%contact%load > 0.0_wp .and. state%contact%load < huge(1.0_wp) .and. &
            abs(state%contact%traction) < 0.3_wp*state%contact%load .and. abs(state%contact%rolling_resistance) < 1.0e-3_wp, &
            "limit")
         if (allocated(error)) return
         call evaluate_state(model, i*degree, 2.0_wp*state%contact%cam_surface_speed*(1.0_wp + 1.0e-13_wp), near, status)
         call check_close(error, near%contact%traction, state%contact%traction, 1.0e-6_wp, "traction near standstill")
         if (allocated(error)) return
      end do
   end subroutine test_standstill

   subroutine test_balance_of_roller(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      type(position_t) :: position
      real(wp) :: sliding_speed, decay_rate
      logical :: is_found
      integer :: i, k, status

      do k = 1, 3
         case = thesis_case()
         call set_point(case, point_speeds(k), point_viscosities(k))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -70, 70, 10
            call find_balance(model, i*degree, slip_tolerance, position, sliding_speed, decay_rate, is_found)
            if (.not. is_found) call test_failed(error, "no balance")
            if (allocated(error)) return
            call evaluate_state(model, i*degree, sliding_speed, state, status)
            ! the root is known to 1e-14 of the rolling speed, which the decay rate turns into a rate
            call check_scaled(error, state%spin_acceleration*model%roller_radius/model%speed, &
               rolling_speed_slope(model, position), decay_rate*state%contact%rolling_speed, 1.0e-13_wp, "spin")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_balance_of_roller

   subroutine test_decay_rate(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: slower, faster
      type(position_t) :: position
      real(wp) :: sliding_speed, decay_rate, step
      logical :: is_found
      integer :: i, status

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(2))
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = -60, 60, 10
         call find_balance(model, i*degree, slip_tolerance, position, sliding_speed, decay_rate, is_found)
         step = 1.0e-4_wp*sliding_speed
         call evaluate_state(model, i*degree, sliding_speed - step, slower, status)
         call evaluate_state(model, i*degree, sliding_speed + step, faster, status)
         ! the film follows slip, which the rate leaves out: slip is up to 2.5 % of the rolling speed at these angles
         call check_close(error, (faster%spin_acceleration - slower%spin_acceleration)*model%roller_radius &
            /(2.0_wp*step*model%speed), decay_rate, 0.03_wp, "decay rate")
         if (allocated(error)) return
      end do
   end subroutine test_decay_rate

   subroutine test_turns(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state, again
      integer :: i, status

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = -180, 175, 5
         call evaluate_state(model, i*degree, 1.0e-3_wp, state, status)
         call evaluate_state(model, (i + 360)*degree, 1.0e-3_wp, again, status)
         ! a turn later the angle has lost a rounding or two
         call check_close(error, again%contact%traction, state%contact%traction, 1.0e-11_wp, "traction")
         if (allocated(error)) return
      end do
   end subroutine test_turns

end module test_contact
