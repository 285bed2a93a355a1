!> Derivatives of the roller equation over sliding speed and cam angle, against central differences of its right-hand side.
module test_spin_slopes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_cam_surface, only : place_angle, set_cam
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_kinematics, only : rotation_names
   use camroller_film, only : film_law_names
   use camroller_asperity, only : asperity_law_names, law_zhao_maietta_chang
   use camroller_lubricant, only : pressure_law_names
   use camroller_traction, only : rolling_law_names
   use camroller_pin_film, only : pin_law_names
   use camroller_contact_state, only : release_contact
   use camroller_spin, only : nearby_t, spin_problem_t
   use camroller_state, only : evaluate_state, state_t
   use closeness, only : check_scaled
   use camroller_ode_problem, only : linear_t, counters_t, new_linear
   use reference_cases, only : thesis_case, source_case, skewed_case, make_model, set_point, add_boundary_law, add_gas_force, &
      & add_joints, add_heat, add_pin_film, add_profile, add_skf_needles, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_spin_slopes

   !> Sliding speeds over the radius of the cam times its speed [-]
   real(wp), parameter :: slips(6) = [-0.3_wp, -1.0e-2_wp, 1.0e-5_wp, 1.0e-3_wp, 3.0e-2_wp, 0.5_wp]
   !> Step of the differences, relative [-]: half the cube root of round-off; truncation with heat and profile at once: 1.4e-6
   real(wp), parameter :: h = 3.0e-6_wp
   !> Difference allowed: truncation by third derivatives up to 1e4 times the first, h^2 1e4, and round-off epsilon/h [-]
   real(wp), parameter :: tolerance = 4.0e-7_wp
   !> Radius that speeds are measured by [m]
   real(wp), parameter :: radius = 0.02_wp

contains

   subroutine collect_spin_slopes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("slopes with energy 'consistent': every film law, both senses of rotation", test_film_laws), &
         new_unittest("slopes with energy 'consistent': every viscosity and shear law", test_shear_laws), &
         new_unittest("slopes with energy 'source'", test_source), &
         new_unittest("slopes with gas force, with yielding asperities, and without asperities, bearing and guide", test_effects), &
         new_unittest("slopes with friction at valve tip, seal, guide and pivot, and needle drag", test_with_joints), &
         new_unittest("slopes with heat of inlet and contact, with a tilted crown and with both, for every film law", &
            & test_heat_and_profile), &
         new_unittest("slopes with a limit of the stress at each point, for every viscosity and shear law, with and without heat", &
            & test_local_limit), &
         new_unittest("slopes with the strip from rigid to elastic contacts, every viscosity and shear law, with and without "// &
            & "heat", test_wide_shear), &
         new_unittest("slopes with a law of the boundary coefficient, with and without heat", test_with_boundary_law), &
         new_unittest("slopes with a tribofilm whose thickness changes over the cam", test_with_tribofilm), &
         new_unittest("slopes with an oil film on the roller's pin, for both of its laws", test_with_pin_film), &
         new_unittest("slopes with needles by SKF's model", test_with_skf_needles), &
         new_unittest("slopes with a given fraction of the boundary friction, as in sliding and sticking", test_given_share), &
         new_unittest("slopes of a rolling resistance that the load holds, and no load is lost by it", test_held_rolling), &
         new_unittest("slopes without contact are those of the kinematics", test_no_contact), &
         new_unittest("a contact that was never solved is none to start from", test_no_start) &
         ]
   end subroutine collect_spin_slopes

   !> Compare at a steady speed, and at one that changes by a tenth over a radian.
   subroutine compare(error, model, words, share, apart)
      type(error_type), allocatable, intent(out) :: error
      type(model_t), intent(in) :: model
      character(len=*), intent(in) :: words
      !> Mobilised part of the boundary friction, where given [-]
      real(wp), intent(in), optional :: share
      !> Degrees between two angles, where they are more than those about the event
      integer, intent(in), optional :: apart
      type(model_t), target :: moving

      moving = model
      call compare_all(error, moving, words, share, apart)
      if (allocated(error)) return
      moving%ramp%is_moving = .true.
      moving%ramp%speed = model%speed
      moving%speed_slope = 0.1_wp*model%speed
      call compare_all(error, moving, words//", speed that changes", share, apart)
   end subroutine compare

   !> Compare at angles of dwell, ramp and event and all slips.
   subroutine compare_all(error, model, words, share, apart)
      type(error_type), allocatable, intent(out) :: error
      type(model_t), intent(in), target :: model
      character(len=*), intent(in) :: words
      !> Mobilised part of the boundary friction, where given [-]
      real(wp), intent(in), optional :: share
      !> Degrees between two angles
      integer, intent(in), optional :: apart
      type(spin_problem_t) :: problem
      type(linear_t) :: linear
      type(counters_t) :: counters
      ! Angle [rad], sliding speed and its step [m/s], rates [m/s/rad]
      real(wp) :: angle, state(1), step, low(1), high(1)
      ! Derivatives by differences [1/rad], [m/s/rad^2]; size of the latter [m/s/rad^2]
      real(wp) :: slope, time_slope, scale
      integer :: i, k, status, step_degrees

      step_degrees = 7
      if (present(apart)) step_degrees = apart
      problem%model => model
      if (present(share)) problem%mobilised = share
      call new_linear(linear, 1)
      do i = -9, 9
         angle = (step_degrees*i + 1.1_wp)*degree
         do k = 1, size(slips)
            state = slips(k)*radius*model%speed
            call problem%linearise(angle, state, angle + 1.0_wp, linear, counters, status)
            call check(error, status, 0)
            if (allocated(error)) return
            ! traction saturates over sliding speeds of a thousandth of the largest
            step = h*max(abs(state(1)), 1.0e-4_wp*radius*model%speed)
            call problem%get_rate(angle, state - step, low, status)
            call problem%get_rate(angle, state + step, high, status)
            slope = (high(1) - low(1))/(2.0_wp*step)
            scale = maxval(abs([low, high]))
            call check(error, abs(slope - linear%jacobian(1, 1)) < tolerance*abs(slope) + 1.0e-14_wp*scale/step + 1.0e-9_wp, &
               & "over the sliding speed, "//words)
            if (allocated(error)) return
            call problem%get_rate(angle - h, state, low, status)
            call problem%get_rate(angle + h, state, high, status)
            time_slope = (high(1) - low(1))/(2.0_wp*h)
            call check_scaled(error, linear%time_slope(1), time_slope, abs(time_slope) + scale, 10.0_wp*tolerance, &
               & "slope over the cam angle, "//words)
            if (allocated(error)) return
         end do
      end do
   end subroutine compare_all

   subroutine test_film_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law, sense

      do law = 1, size(film_law_names)
         do sense = 1, 2
            case = skewed_case(rotation_names(sense))
            case%film%law = film_law_names(law)
            call set_point(case, point_speeds(sense), point_viscosities(1 + mod(law, 3)))
            call make_model(case, model, error)
            if (allocated(error)) return
            call compare(error, model, trim(film_law_names(law))//", "//rotation_names(sense))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_film_laws

   subroutine test_shear_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law, shear

      do law = 1, size(pressure_law_names)
         do shear = 1, 2
            case = thesis_case()
            case%lubricant%pressure_law = pressure_law_names(law)
            case%traction%shear_law = merge("newtonian", "eyring   ", shear == 1)
            case%traction%eyring_stress = 5.0e6_wp
            case%asperity%film_shear_strength = 2.0e6_wp
            case%traction%rolling_law = merge("goksem_hargreaves", "biboulet_houpert ", law == 2)
            call set_point(case, point_speeds(law), point_viscosities(1 + shear))
            call make_model(case, model, error)
            if (allocated(error)) return
            call compare(error, model, trim(pressure_law_names(law))//", "//case%traction%shear_law)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_shear_laws

   subroutine test_with_joints(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law

      do law = 1, 2
         case = skewed_case(rotation_names(law))
         call add_joints(case, merge("constant", "stribeck", law == 1))
         call add_gas_force(case)
         allocate (case%needle_drag)
         case%needle_drag%pitch_diameter = 10.22e-3_wp
         call set_point(case, point_speeds(1 + law), point_viscosities(law))
         call make_model(case, model, error)
         if (allocated(error)) return
         model%speed_slope = 0.1_wp*model%speed
         call compare(error, model, "friction "//merge("constant", "stribeck", law == 1))
         if (allocated(error)) return
      end do
   end subroutine test_with_joints

   subroutine test_heat_and_profile(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      character(len=*), parameter :: names(3) = [character(len=16) :: "heat", "profile", "heat and profile"]
      integer :: law, effects

      do effects = 1, 3
         do law = 1, size(film_law_names)
            case = skewed_case(rotation_names(1 + mod(law, 2)))
            case%film%law = film_law_names(law)
            case%lubricant%pressure_law = pressure_law_names(1 + mod(law, 3))
            case%traction%shear_law = merge("newtonian", "eyring   ", law < 4)
            case%traction%eyring_stress = 5.0e6_wp
            if (effects == 2) case%traction%rolling_law = rolling_law_names(1 + mod(law, size(rolling_law_names)))
            case%asperity%film_shear_strength = 2.0e6_wp
            if (effects /= 2) call add_heat(case)
            if (effects == 1 .and. law == 2) case%heat%inlet_law = "murch_wilson"
            if (effects /= 1) call add_profile(case)
            call set_point(case, point_speeds(1 + mod(law, 3)), point_viscosities(1 + mod(law + 1, 3)))
            call make_model(case, model, error)
            if (allocated(error)) return
            call compare(error, model, trim(names(effects))//", "//trim(film_law_names(law)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_heat_and_profile

   subroutine test_local_limit(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law

      do law = 1, 6
         case = skewed_case(rotation_names(1 + mod(law, 2)))
         case%lubricant%pressure_law = pressure_law_names(1 + mod(law, 3))
         case%traction%shear_law = merge("newtonian", "eyring   ", law < 4)
         case%traction%eyring_stress = 5.0e6_wp
         case%traction%limit = "local"
         case%traction%limiting_coefficient = 0.04_wp
         case%traction%limiting_stress = 1.0e6_wp
         case%asperity%film_shear_strength = 2.0e6_wp
         if (mod(law, 2) == 0) call add_heat(case)
         call set_point(case, point_speeds(1 + mod(law, 3)), point_viscosities(1 + mod(law + 1, 3)))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "limit at each point, "//trim(case%lubricant%pressure_law)//", "//case%traction%shear_law)
         if (allocated(error)) return
      end do
   end subroutine test_local_limit

   subroutine test_wide_shear(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law

      do law = 1, 12
         case = skewed_case(rotation_names(1 + mod(law, 2)))
         case%lubricant%pressure_law = pressure_law_names(1 + mod(law, 3))
         case%film%law = film_law_names(1 + mod(law, 3))
         case%traction%sheared_zone = "rigid_to_elastic"
         case%traction%shear_law = merge("newtonian", "eyring   ", mod(law, 4) < 2)
         case%traction%eyring_stress = 5.0e6_wp
         case%asperity%film_shear_strength = 2.0e6_wp
         if (law > 9) case%traction%limit = "local"
         if (mod(law, 2) == 0) call add_heat(case)
         if (mod(law, 5) == 0) call add_profile(case)
         call set_point(case, point_speeds(1 + mod(law, 3)), point_viscosities(1 + mod(law + 1, 3)))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "strip from rigid to elastic contacts, "//trim(case%lubricant%pressure_law)//", "// &
            & case%traction%shear_law)
         if (allocated(error)) return
      end do
   end subroutine test_wide_shear

   subroutine test_with_boundary_law(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: k

      do k = 1, 4
         case = skewed_case(rotation_names(1 + mod(k, 2)))
         call add_boundary_law(case, merge("logarithmic", "table      ", k < 3))
         case%asperity%film_shear_strength = 2.0e6_wp
         if (mod(k, 2) == 0) call add_heat(case)
         call set_point(case, point_speeds(1 + mod(k, 3)), 0.3_wp*point_viscosities(3))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "boundary law '"//trim(case%boundary_law%law)//"'")
         if (allocated(error)) return
      end do
   end subroutine test_with_boundary_law

   subroutine test_with_tribofilm(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law, i

      do law = 1, size(film_law_names)
         case = skewed_case(rotation_names(1 + mod(law, 2)))
         case%film%law = film_law_names(law)
         case%asperity%film_shear_strength = 2.0e6_wp
         if (mod(law, 2) == 0) call add_heat(case)
         if (mod(law, 3) == 0) call add_boundary_law(case, "logarithmic")
         call set_point(case, point_speeds(1 + mod(law, 3)), 0.3_wp*point_viscosities(3))
         call make_model(case, model, error)
         if (allocated(error)) return
         allocate (model%surface)
         ! places coarse enough for differences of the step
         model%surface%roller_film = 4.0e-8_wp
         model%surface%roughness_ratio = 2.0_wp
         model%surface%largest_thickness = 1.2e-7_wp
         call set_cam(model%surface, [(5.0e-8_wp*(1.0_wp + sin(2.0_wp*place_angle(i, 24))), i=1, 24)], [(0.0_wp, i=1, 24)])
         model%boundary%film_coefficient = 0.07_wp
         call compare(error, model, "tribofilm, "//trim(film_law_names(law)))
         if (allocated(error)) return
      end do
   end subroutine test_with_tribofilm

   subroutine test_with_pin_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: law, point

      do law = 1, size(pin_law_names)
         do point = 1, 3
            case = skewed_case(rotation_names(law))
            call add_pin_film(case, pin_law_names(law))
            call set_point(case, point_speeds(point), point_viscosities(1 + mod(point, 3)))
            call make_model(case, model, error)
            if (allocated(error)) return
            call compare(error, model, "pin film, "//trim(pin_law_names(law)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_with_pin_film

   subroutine test_with_skf_needles(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: point

      do point = 1, 3
         case = skewed_case(rotation_names(1 + mod(point, 2)))
         call add_skf_needles(case)
         call set_point(case, point_speeds(point), point_viscosities(1 + mod(point, 3)))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "needles by SKF's model")
         if (allocated(error)) return
      end do
   end subroutine test_with_skf_needles

   subroutine test_source(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: i

      do i = 1, 3
         case = source_case()
         if (i == 2) case%spring%load_arm = "exact"
         if (i == 3) case%spring%seating = "maximum"
         call set_point(case, point_speeds(i), point_viscosities(i))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "source")
         if (allocated(error)) return
      end do
   end subroutine test_source

   subroutine test_effects(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      integer :: i

      case = thesis_case()
      call add_gas_force(case)
      call make_model(case, model, error)
      if (allocated(error)) return
      call compare(error, model, "gas force")
      if (allocated(error)) return
      case%asperity%law = asperity_law_names(law_zhao_maietta_chang)
      case%materials%hardness = 8.0e9_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call compare(error, model, "asperities that yield")
      if (allocated(error)) return
      case%asperity%law = "masjedi_khonsari"
      case%film%law = "masjedi_khonsari_rough"
      do i = 1, 4
         if (i == 4) call add_heat(case)
         call set_point(case, point_speeds(merge(1, i, i > 3)), point_viscosities(merge(1, i, i > 3)))
         call make_model(case, model, error)
         if (allocated(error)) return
         call compare(error, model, "asperities by regression"//merge(", heat", "      ", i > 3))
         if (allocated(error)) return
      end do
      deallocate (case%heat)
      case%film%law = "dowson_higginson"
      deallocate (case%asperity, case%needle_bearing, case%valve_guide)
      call make_model(case, model, error)
      if (allocated(error)) return
      call compare(error, model, "no effects")
   end subroutine test_effects

   subroutine test_given_share(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model

      case = thesis_case()
      case%asperity%mobilisation = "stick_slip"
      call make_model(case, model, error)
      if (allocated(error)) return
      call compare(error, model, "given share", share=-1.0_wp)
   end subroutine test_given_share

   !> With loads on the base circle from a hundredth of the usual to next to none, cold oil, a cam whose friction lifts the finger.
   subroutine test_held_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      ! Loads over the usual one [-]
      real(wp), parameter :: parts(*) = [1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp]
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, law, status

      do i = 1, size(parts)
         do law = 1, 2
            case = thesis_case()
            call set_point(case, point_speeds(1), point_viscosities(1))
            case%mechanism%rotation = "towards_pivot"
            case%spring%base_circle_load = parts(i)*case%spring%base_circle_load
            case%traction%rolling_law = rolling_law_names(law)
            call make_model(case, model, error)
            if (allocated(error)) return
            call compare(error, model, case%traction%rolling_law, apart=18)
            if (allocated(error)) return
            call evaluate_state(model, 150.0_wp*degree, 0.3_wp, state, status)
            associate (resistance => abs(state%contact%rolling_resistance), load => state%contact%load)
               call check(error, resistance > 0.05_wp*load .and. resistance <= load, "no resistance that the load holds")
            end associate
            if (allocated(error)) return
         end do
      end do
   end subroutine test_held_rolling

   subroutine test_no_contact(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t), target :: model
      type(spin_problem_t) :: problem
      type(linear_t) :: linear
      type(counters_t) :: counters
      integer :: status

      ! at ten times the speed the valve's inertia lifts the roller off over the nose
      case = thesis_case()
      call set_point(case, 10.0_wp*point_speeds(3), point_viscosities(2))
      call make_model(case, model, error)
      if (allocated(error)) return
      problem%model => model
      call new_linear(linear, 1)
      call problem%linearise(0.01_wp, [1.0_wp], 1.0_wp, linear, counters, status)
      call check(error, status == 0 .and. .not. abs(linear%jacobian(1, 1)) > 0.0_wp .and. .not. abs(linear%span) > 0.0_wp)
   end subroutine test_no_contact

   !> What is not set may say that it touches.
   subroutine test_no_start(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t), target :: model
      type(nearby_t), target :: nearby
      type(spin_problem_t) :: problem
      ! Sliding speed [m/s], rates [m/s/rad]
      real(wp) :: state(1), alone(1), beside(1)
      integer :: status

      call make_model(skewed_case(rotation_names(1)), model, error)
      if (allocated(error)) return
      problem%model => model
      problem%accuracy = 1.0e-4_wp
      state = 1.0e-3_wp*model%speed
      call problem%get_rate(20.0_wp*degree, state, alone, status)
      nearby%last%bearing_drag = 0.0_wp
      call release_contact(nearby%last)
      nearby%last%is_touching = .true.
      nearby%last%tangential_force = 300.0_wp
      nearby%last%film_ratio = 0.01_wp
      problem%nearby => nearby
      call problem%get_rate(20.0_wp*degree, state, beside, status)
      call check(error, beside(1), alone(1), thr=0.0_wp)
   end subroutine test_no_start

end module test_spin_slopes
