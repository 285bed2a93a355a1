!> Changes of the description that must not change the result.
module test_invariance
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_cycle, only : cycle_t, state_at
   use camroller_kinematics, only : rotation_names
   use camroller_lift, only : lift_law_t, new_lift_law, evaluate_lift
   use camroller_torque_list, only : torque_count, of_geometric
   use closeness, only : check_scaled, has_failed
   use reference_cases, only : thesis_case, skewed_case, make_model, make_cycle, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_invariance

   !> Angles at which cycles are compared [rad]
   real(wp), parameter :: angles(12) = [-175, -90, -66, -60, -41, -20, 0, 9, 27, 52, 67, 120]*degree
   !> Values of a cycle at an angle: sliding speed, load, film, torques
   integer, parameter :: value_count = 3 + torque_count

contains

   subroutine collect_invariance(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("shifting a lift table by a turn or more changes nothing", test_table_turns), &
         new_unittest("shifting a lift table shifts the result", test_table_shift), &
         new_unittest("refining a lift table converges to the law it was made from", test_table_refinement), &
         new_unittest("additional rows at zero lift change nothing", test_rest_rows), &
         new_unittest("effects of zero strength change nothing", test_zero_effects), &
         new_unittest("mirroring lift and sense of rotation reverses the moments of friction and changes nothing else", &
            & test_mirror), &
         new_unittest("two models used side by side give the same bits as each alone", test_side_by_side), &
         new_unittest("a model gives the same bits when used again", test_repeat) &
         ]
   end subroutine collect_invariance

   !> A cycle at the angles of the comparison.
   subroutine sample(case, values, error, shift)
      type(case_t), intent(in) :: case
      real(wp), intent(out) :: values(value_count, size(angles))
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: shift
      type(model_t) :: model
      type(cycle_t) :: cycle

      call make_model(case, model, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      if (present(shift)) then
         call sample_cycle(model, cycle, shift, values, error)
      else
         call sample_cycle(model, cycle, 0.0_wp, values, error)
      end if
   end subroutine sample

   subroutine sample_cycle(model, cycle, shift, values, error)
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      real(wp), intent(in) :: shift
      real(wp), intent(out) :: values(value_count, size(angles))
      type(error_type), allocatable, intent(out) :: error
      type(state_t) :: state
      type(error_t), allocatable :: failure
      integer :: i, hint

      hint = 1
      do i = 1, size(angles)
         call state_at(cycle, model, angles(i) + shift, hint, state, failure)
         if (has_failed(failure, error)) return
         values(:, i) = [state%contact%sliding_speed, state%contact%load, state%contact%film_min, state%torques]
         ! the energy residual is round-off: not a result
         values(value_count, i) = 0.0_wp
      end do
   end subroutine sample_cycle

   !> Two samples, each quantity judged by its largest value.
   subroutine compare(values, expected, tolerance, error)
      real(wp), intent(in) :: values(value_count, size(angles)), expected(value_count, size(angles)), tolerance
      type(error_type), allocatable, intent(out) :: error
      character(len=40) :: what
      integer :: i, k

      do i = 1, size(angles)
         do k = 1, value_count
            write (what, "(a, i0, a, f0.1, a)") "value ", k, " at ", angles(i)/degree, " deg"
            call check_scaled(error, values(k, i), expected(k, i), maxval(abs(expected(k, :))), tolerance, trim(what))
            if (allocated(error)) return
         end do
      end do
   end subroutine compare

   !> Keep what the integration leaves far below what is compared.
   subroutine sharpen(case)
      type(case_t), intent(inout) :: case

      case%numerics%method = "rodas5p"
      ! the torque of the roller's inertia, a small difference of forces, magnifies differences of the slip a hundredfold
      case%numerics%tolerance = 1.0e-9_wp
   end subroutine sharpen

   subroutine test_table_turns(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(value_count, size(angles)), expected(value_count, size(angles))
      type(case_t) :: case
      integer :: turn

      case = skewed_case(rotation_names(1))
      call sharpen(case)
      call sample(case, expected, error)
      if (allocated(error)) return
      do turn = -1, 2
         case = skewed_case(rotation_names(1))
         call sharpen(case)
         case%lift%table_angle = case%lift%table_angle + turn*two_pi
         call sample(case, values, error)
         if (allocated(error)) return
         ! angles lose some roundings, which a second derivative of the table over a quarter of a degree magnifies, and the steps
         ! of the integration change with them
         call compare(values, expected, 1.0e-6_wp, error)
         if (allocated(error)) return
      end do
   end subroutine test_table_turns

   subroutine test_table_shift(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(value_count, size(angles)), expected(value_count, size(angles))
      type(case_t) :: case
      ! Shift, across the end of the turn [rad]
      real(wp), parameter :: shift = 150.0_wp*degree

      case = skewed_case(rotation_names(1))
      call sharpen(case)
      call sample(case, expected, error)
      if (allocated(error)) return
      case%lift%table_angle = case%lift%table_angle + shift
      call sample(case, values, error, shift)
      if (allocated(error)) return
      call compare(values, expected, 1.0e-6_wp, error)
   end subroutine test_table_shift

   subroutine test_table_refinement(error)
      type(error_type), allocatable, intent(out) :: error
      ! Distance of the rows [deg]
      integer, parameter :: steps(3) = [10, 5, 2]
      type(case_t) :: case, exact
      type(model_t) :: model, exact_model
      type(state_t) :: state, exact_state
      type(lift_law_t) :: law
      type(error_t), allocatable :: failure
      ! Largest difference of the load over its largest value [-], lift [m/rad^n], largest load [N]
      real(wp) :: difference(3), lift(0:3), largest
      integer :: i, k, status

      exact = thesis_case()
      call make_model(exact, exact_model, error)
      if (allocated(error)) return
      call new_lift_law(law, exact%lift, failure)
      do i = 1, 3
         case = thesis_case()
         case%lift%law = "table"
         case%lift%table_angle = [(real(k, wp)*degree, k=-70, 70, steps(i))]
         case%lift%table_lift = case%lift%table_angle
         do k = 1, size(case%lift%table_angle)
            call evaluate_lift(law, case%lift%table_angle(k), lift)
            case%lift%table_lift(k) = lift(0)
         end do
         call make_model(case, model, error)
         if (allocated(error)) return
         difference(i) = 0.0_wp
         largest = 0.0_wp
         do k = -75, 75
            call evaluate_state(model, k*degree, 1.0e-3_wp, state, status)
            call evaluate_state(exact_model, k*degree, 1.0e-3_wp, exact_state, status)
            difference(i) = max(difference(i), abs(state%contact%load - exact_state%contact%load))
            largest = max(largest, exact_state%contact%load)
         end do
         difference(i) = difference(i)/largest
      end do
      ! a quintic spline has a second derivative with an error of the fourth power of the step; 10, 5, 2 deg: 16 and 39 times less
      call check(error, difference(2) < difference(1)/8.0_wp .and. difference(3) < difference(2)/20.0_wp, "no convergence")
      if (allocated(error)) return
      call check_scaled(error, difference(3), 0.0_wp, 1.0_wp, 1.0e-4_wp, "load by a table every two degrees")
   end subroutine test_table_refinement

   subroutine test_rest_rows(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(value_count, size(angles)), expected(value_count, size(angles))
      type(case_t) :: case

      case = skewed_case(rotation_names(1))
      call sample(case, expected, error)
      if (allocated(error)) return
      case%lift%table_angle = [-70.0_wp*degree, -60.0_wp*degree, case%lift%table_angle, 64.0_wp*degree, 90.0_wp*degree]
      case%lift%table_lift = [0.0_wp, 0.0_wp, case%lift%table_lift, 0.0_wp, 0.0_wp]
      call sample(case, values, error)
      if (allocated(error)) return
      call check(error, all(abs(values - expected) <= 0.0_wp))
   end subroutine test_rest_rows

   subroutine test_zero_effects(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(value_count, size(angles)), expected(value_count, size(angles))
      type(case_t) :: case
      integer :: i

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(1))
      deallocate (case%asperity, case%needle_bearing, case%valve_guide)
      call sample_states(case, expected, error)
      if (allocated(error)) return

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(1))
      case%asperity%boundary_coefficient = 0.0_wp
      case%asperity%film_shear_strength = 0.0_wp
      ! asperities that carry nothing to speak of; a product of zero would be a smooth surface
      case%asperity%roughness_product = 1.0e-12_wp
      case%needle_bearing%friction_coefficient = 0.0_wp
      ! a stem with a very wide guide: drag 1e-12 of that of the thesis
      case%valve_guide%radial_clearance = 2.0e7_wp
      allocate (case%gas_force)
      case%gas_force%angle = [(two_pi*i/8, i=0, 8)]
      case%gas_force%pressure = 0.0_wp*case%gas_force%angle
      case%gas_force%valve_area = 1.0e-3_wp
      call sample_states(case, values, error)
      if (allocated(error)) return
      ! torques that are zero in the one and 1e-12 of something in the other are judged by the contact's
      values(6:7, :) = values(6:7, :) + values(4:5, :)
      expected(6:7, :) = expected(6:7, :) + expected(4:5, :)
      ! the effects that are there to 1e-12 of their strength change the rest by no more than a hundred times as much
      call compare(values, expected, 1.0e-10_wp, error)
   end subroutine test_zero_effects

   !> States at the angles of the comparison for a sliding speed that changes with the angle.
   subroutine sample_states(case, values, error)
      type(case_t), intent(in) :: case
      real(wp), intent(out) :: values(value_count, size(angles))
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, status

      call make_model(case, model, error)
      if (allocated(error)) return
      do i = 1, size(angles)
         call evaluate_state(model, angles(i), 1.0e-3_wp*i, state, status)
         call check(error, status, 0)
         if (allocated(error)) return
         values(:, i) = [state%contact%sliding_speed, state%contact%load, state%contact%film_min, state%torques]
         values(value_count, i) = 0.0_wp
      end do
   end subroutine sample_states

   subroutine test_mirror(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, mirrored
      type(state_t) :: state, image
      integer :: i, status

      case = skewed_case(rotation_names(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      case%lift%table_angle = -case%lift%table_angle(size(case%lift%table_angle):1:-1)
      case%lift%table_lift = case%lift%table_lift(size(case%lift%table_lift):1:-1)
      case%mechanism%rotation = rotation_names(2)
      call make_model(case, mirrored, error)
      if (allocated(error)) return
      do i = -60, 60, 7
         call evaluate_state(model, i*degree, 1.0e-3_wp, state, status)
         call evaluate_state(mirrored, -i*degree, 1.0e-3_wp, image, status)
         ! the mirror image runs through the same positions in the opposite order
         call check_scaled(error, image%position%equivalent_radius, state%position%equivalent_radius, 1.0e-2_wp, 1.0e-10_wp, "R")
         if (allocated(error)) return
         call check_scaled(error, image%contact%cam_surface_speed, state%contact%cam_surface_speed, 1.0_wp, 1.0e-10_wp, "V_c")
         if (allocated(error)) return
         call check_scaled(error, image%contact%rolling_speed, state%contact%rolling_speed, 1.0_wp, 1.0e-10_wp, "V_roll")
         if (allocated(error)) return
         call check_scaled(error, image%position%rolling_travel_slope, -state%position%rolling_travel_slope, 1.0e-2_wp, 1.0e-8_wp, &
            "slope of V_roll")
         if (allocated(error)) return
         call check_scaled(error, image%torques(of_geometric), -state%torques(of_geometric), 1.0_wp, 1.0e-9_wp, "geometric torque")
         if (allocated(error)) return
      end do
   end subroutine test_mirror

   subroutine test_side_by_side(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: alone(value_count, size(angles), 2), together(value_count, size(angles), 2)
      type(case_t) :: cases(2)
      type(model_t), target :: models(2)
      type(cycle_t) :: cycles(2)
      integer :: i

      cases(1) = thesis_case()
      cases(1)%numerics%tolerance = 1.0e-4_wp
      cases(2) = skewed_case(rotation_names(2))
      do i = 1, 2
         call sample(cases(i), alone(:, :, i), error)
         if (allocated(error)) return
      end do
      do i = 2, 1, -1
         call make_model(cases(i), models(i), error)
         if (allocated(error)) return
      end do
      do i = 1, 2
         call make_cycle(cases(i), models(i), cycles(i), error)
         if (allocated(error)) return
      end do
      do i = 2, 1, -1
         call sample_cycle(models(i), cycles(i), 0.0_wp, together(:, :, i), error)
         if (allocated(error)) return
      end do
      call check(error, all(abs(together - alone) <= 0.0_wp))
   end subroutine test_side_by_side

   subroutine test_repeat(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: first(value_count, size(angles)), second(value_count, size(angles))
      type(case_t) :: case
      type(model_t), target :: model
      type(cycle_t) :: cycle

      case = skewed_case(rotation_names(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      call sample_cycle(model, cycle, 0.0_wp, first, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      call sample_cycle(model, cycle, 0.0_wp, second, error)
      if (allocated(error)) return
      call check(error, all(abs(second - first) <= 0.0_wp))
   end subroutine test_repeat

end module test_invariance
