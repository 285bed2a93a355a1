!> Drag of the oil in the roller's bearing.
module test_needle_drag
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree, per_minute
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_needle_drag, only : needle_drag_t, drag_part_t, new_drag_part, set_drag_oil, set_drag_speed, &
      & drag_torque, drag_torque_slope, drag_torque_by_reversal
   use camroller_state, only : state_t, evaluate_state
   use camroller_kinematics, only : rotation_names
   use camroller_torque_list, only : of_needle, of_needle_drag, of_residual
   use closeness, only : check_close, check_scaled, roundings
   use reference_cases, only : thesis_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_needle_drag

contains

   subroutine collect_needle_drag(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("both branches of Palmgren's formula, which meet at 2023.9", test_branches), &
         new_unittest("slope of the drag over the spin", test_slope), &
         new_unittest("drag on the base circle at 300 rev/min and 25 degC without slip is 2.9 N mm", test_magnitude), &
         new_unittest("drag leaves the part of the torque that depends on the load unchanged", test_parts), &
         new_unittest("without contact energy closes and nothing drives the cam, in both senses of rotation", test_flight) &
         ]
   end subroutine collect_needle_drag

   !> Drag of the reference train's needles in an oil.
   subroutine make_part(part, viscosity)
      type(drag_part_t), intent(out) :: part
      !> Kinematic viscosity [mm^2/s]
      real(wp), intent(in) :: viscosity
      type(error_t), allocatable :: failure

      call new_drag_part(part, needle_drag_t(10.22e-3_wp, 12.0_wp, 1.0e-3_wp), failure)
      call set_drag_oil(part, 1.0e-6_wp*viscosity)
      call set_drag_speed(part, 10.0_wp)
   end subroutine make_part

   subroutine test_branches(error)
      type(error_type), allocatable, intent(out) :: error
      type(drag_part_t) :: part
      ! Viscosity [mm^2/s], speeds [rev/min], torques [N mm], expected [N mm]
      real(wp), parameter :: viscosity = 20.0_wp, speeds(3) = [10.0_wp, 80.0_wp, 3000.0_wp]
      real(wp) :: torque, expected
      integer :: i

      call make_part(part, viscosity)
      do i = 1, size(speeds)
         expected = 12.0_wp*160.0e-7_wp*10.22_wp**3
         if (viscosity*speeds(i) > 2023.9_wp) expected = 12.0e-7_wp*(viscosity*speeds(i))**(2.0_wp/3.0_wp)*10.22_wp**3
         torque = 1.0e3_wp*drag_torque(part, -speeds(i)/per_minute)
         call check_close(error, torque, -expected, roundings, "torque")
         if (allocated(error)) return
      end do
      call check_close(error, part%limit*per_minute*viscosity, 2023.9_wp, 3.0e-5_wp, "where the branches meet")
      if (allocated(error)) return
      ! (2000)^(2/3) is 158.74, 0.8 % below 160
      call check_close(error, 160.0_wp/2000.0_wp**(2.0_wp/3.0_wp) - 1.0_wp, 0.008_wp, 0.02_wp, "step of the printed limit")
   end subroutine test_branches

   subroutine test_slope(error)
      type(error_type), allocatable, intent(out) :: error
      type(drag_part_t) :: part, low, high
      ! Spins on both branches and in the reversal [rad/s]; step of the differences, relative [-]
      real(wp), parameter :: spins(5) = [-500.0_wp, -0.012_wp, 0.004_wp, 5.0_wp, 80.0_wp], h = 6.0e-6_wp
      real(wp) :: step, slope
      integer :: i

      call make_part(part, 20.0_wp)
      do i = 1, size(spins)
         step = h*abs(spins(i))
         slope = (drag_torque(part, spins(i) + step) - drag_torque(part, spins(i) - step))/(2.0_wp*step)
         ! rounding of the torque over the step beside the truncation
         call check_scaled(error, drag_torque_slope(part, spins(i)), slope, &
            & abs(slope) + part%least*epsilon(1.0_wp)/step/1.0e-8_wp, 1.0e-8_wp, "slope")
         if (allocated(error)) return
         low = part
         low%reversal_spin = part%reversal_spin*(1.0_wp - h)
         high = part
         high%reversal_spin = part%reversal_spin*(1.0_wp + h)
         slope = (drag_torque(high, spins(i)) - drag_torque(low, spins(i)))/(2.0_wp*h)
         call check_scaled(error, drag_torque_by_reversal(part, spins(i)), slope, &
            & abs(slope) + part%least*epsilon(1.0_wp)/h/1.0e-8_wp, 1.0e-8_wp, "slope over the spin of reversal")
         if (allocated(error)) return
      end do
   end subroutine test_slope

   subroutine test_magnitude(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: status

      case = thesis_case()
      call set_point(case, point_speeds(1), point_viscosities(1))
      allocate (case%needle_drag)
      case%needle_drag%pitch_diameter = 10.22e-3_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_state(model, 150.0_wp*degree, 0.0_wp, state, status)
      call check_scaled(error, 1.0e3_wp*state%contact%bearing_drag, 2.9_wp, 1.0_wp, 0.1_wp, "drag in N mm")
      if (allocated(error)) return
      call check_scaled(error, 1.0e3_wp*(state%contact%bearing_torque - state%contact%bearing_drag), 0.49_wp, 1.0_wp, 0.005_wp, &
         & "load's part in N mm")
   end subroutine test_magnitude

   subroutine test_parts(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, status

      case = thesis_case()
      allocate (case%needle_drag)
      case%needle_drag%pitch_diameter = 10.22e-3_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = -60, 60, 5
         call evaluate_state(model, i*degree, 0.01_wp, state, status)
         associate (contact => state%contact)
            call check_close(error, state%torques(of_needle)*model%speed, model%bearing%friction_coefficient*contact%load &
               & *model%bearing%radius*contact%relative_spin, roundings*10.0_wp, "load's part")
            if (allocated(error)) return
            call check_close(error, state%torques(of_needle_drag)*model%speed, drag_torque(model%drag, contact%relative_spin) &
               & *contact%relative_spin, roundings, "drag")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_parts

   subroutine test_flight(error)
      type(error_type), allocatable, intent(out) :: error
      ! Twice the speed at which the thesis's train loses contact [rad/s]
      real(wp), parameter :: speed = 600.0_wp
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      integer :: i, k, status, flying

      case = thesis_case()
      call set_point(case, speed, point_viscosities(1))
      allocate (case%needle_drag)
      case%needle_drag%pitch_diameter = 10.22e-3_wp
      do k = 1, size(rotation_names)
         case%mechanism%rotation = rotation_names(k)
         call make_model(case, model, error)
         if (allocated(error)) return
         flying = 0
         do i = -60, 60, 5
            call evaluate_state(model, i*degree, 0.01_wp, state, status)
            if (state%contact%is_touching) cycle
            flying = flying + 1
            call check_scaled(error, state%torque_drive, 0.0_wp, state%torque_friction, roundings*10.0_wp, "drive torque")
            if (allocated(error)) return
            call check_scaled(error, state%torques(of_residual), 0.0_wp, state%torque_friction*model%speed, roundings*10.0_wp, &
               & "energy residual")
            if (allocated(error)) return
         end do
         call check(error, flying > 5, "contact is not lost")
         if (allocated(error)) return
      end do
   end subroutine test_flight

end module test_needle_drag
