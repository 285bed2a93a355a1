!> Numbers that a reader can check by hand: the thesis's geometry on the base circle, and the size of the whole.
module test_magnitudes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_hertz, only : peak_pressure
   use camroller_state, only : state_t, evaluate_state
   use camroller_cycle, only : cycle_t, state_at
   use closeness, only : check_scaled
   use reference_cases, only : thesis_case, make_model, make_cycle, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_magnitudes

contains

   subroutine collect_magnitudes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("base circle of the thesis's geometry", test_base_circle), &
         new_unittest("modulus, inertia and friction radius are those of the thesis", test_parts), &
         new_unittest("with a closed valve the cam carries the adjuster's load and the seat the rest", test_closed_valve), &
         new_unittest("peak pressure at the nose is that of the thesis", test_peak_pressure), &
         new_unittest("the loss of a cycle is within the range measured on engines", test_loss) &
         ]
   end subroutine collect_magnitudes

   subroutine test_base_circle(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(position_t) :: position
      integer :: status

      call make_model(thesis_case(), model, error)
      if (allocated(error)) return
      call evaluate_geometry(model, pi, position, status)
      ! half a unit of the last digit given
      call check_scaled(error, model%linkage%base_angle/degree, 60.03_wp, 0.01_wp, 0.5_wp, "gamma on the base circle")
      if (allocated(error)) return
      call check_scaled(error, position%rolling_travel + model%roller_radius, 26.5e-3_wp, 0.1e-3_wp, 0.5_wp, "M")
      if (allocated(error)) return
      call check_scaled(error, position%equivalent_radius, 5.774e-3_wp, 1.0e-6_wp, 0.5_wp, "equivalent radius")
      if (allocated(error)) return
      call check_scaled(error, position%surface_travel*model%speed, 0.565_wp, 1.0e-3_wp, 0.5_wp, "cam surface speed")
   end subroutine test_base_circle

   subroutine test_parts(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model

      call make_model(thesis_case(), model, error)
      if (allocated(error)) return
      call check_scaled(error, model%modulus, 201.8e9_wp, 0.1e9_wp, 0.5_wp, "equivalent modulus")
      if (allocated(error)) return
      call check_scaled(error, model%roller_inertia, 4.82e-7_wp, 0.01e-7_wp, 0.5_wp, "inertia of the roller")
      if (allocated(error)) return
      call check_scaled(error, model%bearing%radius, 5.11e-3_wp, 0.01e-3_wp, 0.5_wp, "friction radius")
   end subroutine test_parts

   subroutine test_closed_valve(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Force of the adjuster at the valve [N]
      real(wp) :: tip_force
      integer :: status

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_state(model, pi, 0.0_wp, state, status)
      ! tangential force and bearing, which oppose each other here, move the load by their moments, and nothing else does
      call check_scaled(error, abs(state%contact%load - case%spring%base_circle_load)*state%position%normal_arm, &
         & abs(abs(state%contact%tangential_force*state%position%tangent_arm) - abs(state%contact%bearing_torque)), &
         & state%moments%total, 1.0e-13_wp, "moment of friction")
      if (allocated(error)) return
      call check_scaled(error, state%moments%total, case%spring%base_circle_load*state%position%normal_arm, state%moments%total, &
         1.0e-14_wp, "moment about the pivot")
      if (allocated(error)) return
      tip_force = case%spring%base_circle_load*state%position%normal_arm/state%position%valve_arm
      call check_scaled(error, tip_force, 37.5_wp, 0.1_wp, 0.5_wp, "force of the adjuster at the valve")
      if (allocated(error)) return
      call check_scaled(error, model%train%closed_seat_force, 25000.0_wp*8.4e-3_wp - tip_force, 210.0_wp, 1.0e-14_wp, "seat force")
   end subroutine test_closed_valve

   subroutine test_peak_pressure(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Lifts between which that of Islam (2019) is known to be [m]; the peak pressure there, printed as 0.64 GPa [Pa]
      real(wp), parameter :: lifts(2) = [9.0e-3_wp, 10.0e-3_wp], printed = 0.64e9_wp, half_unit = 0.005e9_wp
      real(wp) :: pressures(2)
      character(len=40) :: buffer
      integer :: i, k, status

      pressures = 0.0_wp
      do k = 1, 2
         case = thesis_case()
         case%lift%max_lift = lifts(k)
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -70, 70
            call evaluate_state(model, i*degree, 0.0_wp, state, status)
            pressures(k) = max(pressures(k), peak_pressure(state%contact%load, state%position%equivalent_radius, &
               & model%contact_width, model%modulus))
         end do
      end do
      write (buffer, "(2es12.4)") pressures
      call check(error, minval(pressures) <= printed + half_unit .and. maxval(pressures) >= printed - half_unit, &
         & "peak pressures"//trim(buffer))
   end subroutine test_peak_pressure

   subroutine test_loss(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Loss over a cycle [J]
      real(wp) :: loss
      character(len=12) :: buffer
      integer :: i, hint

      case = thesis_case()
      call set_point(case, point_speeds(3), point_viscosities(1))
      case%numerics%tolerance = 1.0e-4_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      loss = 0.0_wp
      hint = 1
      do i = 0, 359
         call state_at(cycle, model, i*degree, hint, state, failure)
         loss = loss + state%torque_friction*degree
      end do
      ! Bair and others (1986) measure 0.32 to 0.70 J for a roller cam lobe with its part of the bearings, which this case lacks
      write (buffer, "(es12.4)") loss
      call check(error, loss > 0.32_wp .and. loss < 0.7_wp, "loss"//buffer)
   end subroutine test_loss

end module test_magnitudes
