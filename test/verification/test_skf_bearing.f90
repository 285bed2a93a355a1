!> Needles by SKF's model: values that another program finds, limits, derivatives, energy, and what a case may say.
module test_skf_bearing
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_kinematics, only : rotation_names
   use camroller_model, only : model_t, new_model
   use camroller_skf_bearing, only : new_skf_part, set_skf_oil, skf_bearing_t, skf_part_t, skf_state_t, solve_skf
   use closeness, only : check_close, check_scaled, expect_error
   use energy_checks, only : check_bearing_energy
   use reference_cases, only : add_gas_force, add_skf_needles, skewed_case, thesis_case
   implicit none
   private

   public :: collect_skf_bearing

   !> Inner radius of the roller, radius of a needle [m]
   real(wp), parameter :: inner_radius = 6.1e-3_wp, needle_radius = 0.99e-3_wp
   !> Spin over which the torque reverses, far below the spins tried [rad/s]
   real(wp), parameter :: reversal_spin = 1.0e-7_wp

contains

   subroutine collect_skf_bearing(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("torque as another program finds it", test_values), &
         new_unittest("torque at low speed: sliding without a film", test_standstill), &
         new_unittest("derivatives of the torque over load and spin", test_slopes), &
         new_unittest("friction falls and rises with the speed", test_stribeck), &
         new_unittest("energy closes, with contact and without, in both senses of rotation", test_energy), &
         new_unittest("what such a bearing cannot have is refused", test_refusals) &
         ]
   end subroutine collect_skf_bearing

   !> Bearing of the reference train.
   subroutine make_part(part, viscosity)
      type(skf_part_t), intent(out) :: part
      !> Kinematic viscosity [m^2/s]
      real(wp), intent(in) :: viscosity
      type(error_t), allocatable :: failure

      call new_skf_part(part, skf_bearing_t(2.13e-6_wp, 0.0015_wp, 6.2_wp), inner_radius, needle_radius, 0.12_wp, failure)
      call set_skf_oil(part, viscosity)
   end subroutine make_part

   subroutine test_values(error)
      type(error_type), allocatable, intent(out) :: error
      ! Loads [N], spins [rad/s], kinematic viscosities [m^2/s]; torques of rolling and sliding by test/reference/skf_reference.py
      ! [N m]
      real(wp), parameter :: loads(4) = [300.0_wp, 1500.0_wp, 60.0_wp, 2000.0_wp], &
         spins(4) = [80.0_wp, 300.0_wp, 600.0_wp, 5.0_wp], viscosities(4) = [150.0e-6_wp, 10.0e-6_wp, 1000.0e-6_wp, 8.0e-6_wp], &
         rolling(4) = [3.432918968122160e-03_wp, 2.578903127622146e-03_wp, 8.715760526634479e-04_wp, 2.155738274707114e-04_wp], &
         sliding(4) = [1.104396540397050e-04_wp, 1.909080207030409e-03_wp, 1.839600000000000e-05_wp, 3.675845694283487e-03_wp]
      type(skf_part_t) :: part
      type(skf_state_t) :: state
      integer :: i

      do i = 1, size(loads)
         call make_part(part, viscosities(i))
         call solve_skf(part, loads(i), -spins(i), reversal_spin, state)
         ! Powers of large numbers in two programs: a hundred roundings
         call check_close(error, state%torque, -(rolling(i) + sliding(i)), 3.0e-14_wp, "torque")
         if (allocated(error)) return
         call check_close(error, state%by_load, -(0.31_wp*rolling(i) + sliding(i)), 3.0e-14_wp, "over the load")
         if (allocated(error)) return
      end do
   end subroutine test_values

   subroutine test_standstill(error)
      type(error_type), allocatable, intent(out) :: error
      type(skf_part_t) :: part
      type(skf_state_t) :: state

      call make_part(part, 10.0e-6_wp)
      call solve_skf(part, 0.0_wp, 50.0_wp, reversal_spin, state)
      call check(error, .not. max(abs(state%torque), abs(state%by_load), abs(state%by_spin)) > 0.0_wp, "no load")
      if (allocated(error)) return
      call solve_skf(part, 500.0_wp, 0.0_wp, 0.5_wp, state)
      call check(error, .not. abs(state%torque) > 0.0_wp, "no torque at standstill")
      if (allocated(error)) return
      ! mu_bl S_2 d_m F over the spin of reversal: rolling adds a part of the order of the spin to the power 0.6
      call check_close(error, state%by_spin, 0.12_wp*0.0015_wp*2.0_wp*(inner_radius - needle_radius)*500.0_wp/0.5_wp, &
         & 1.0e-14_wp, "slope at standstill")
      if (allocated(error)) return
      call solve_skf(part, 500.0_wp, 1.0e-4_wp, reversal_spin, state)
      call check_close(error, state%torque, 0.12_wp*0.0015_wp*2.0_wp*(inner_radius - needle_radius)*500.0_wp, 0.01_wp, &
         & "sliding without a film")
   end subroutine test_standstill

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      ! Relative step [-]; difference allowed: truncation h^2, by third derivatives up to 1e3 times the first, and rounding
      ! 1e-12/h [-]
      real(wp), parameter :: h = 1.0e-5_wp, tolerance = 3.0e-7_wp
      ! Loads [N], spins [rad/s], kinematic viscosities [m^2/s]
      real(wp), parameter :: loads(3) = [5.0_wp, 500.0_wp, 2500.0_wp], spins(4) = [0.3_wp, -4.0_wp, 50.0_wp, 600.0_wp], &
         & viscosities(3) = [5.0e-6_wp, 60.0e-6_wp, 1000.0e-6_wp]
      type(skf_part_t) :: part
      type(skf_state_t) :: state, low, high
      ! Spin over which the torque reverses, step [rad/s]
      real(wp) :: reversal, step
      integer :: oil, i, k

      reversal = 0.5_wp
      do oil = 1, size(viscosities)
         call make_part(part, viscosities(oil))
         do i = 1, size(loads)
            do k = 1, size(spins)
               call solve_skf(part, loads(i), spins(k), reversal, state)
               call solve_skf(part, loads(i)*(1.0_wp - h), spins(k), reversal, low)
               call solve_skf(part, loads(i)*(1.0_wp + h), spins(k), reversal, high)
               call check_scaled(error, state%by_load, (high%torque - low%torque)/(2.0_wp*h), abs(state%by_load), tolerance, &
                  & "over the load")
               if (allocated(error)) return
               step = h*max(abs(spins(k)), reversal)
               call solve_skf(part, loads(i), spins(k) - step, reversal, low)
               call solve_skf(part, loads(i), spins(k) + step, reversal, high)
               call check_scaled(error, state%by_spin, (high%torque - low%torque)/(2.0_wp*step), &
                  & abs(state%by_spin) + abs(state%torque)*h/step, tolerance, "over the spin")
               if (allocated(error)) return
               call solve_skf(part, loads(i), spins(k), reversal*(1.0_wp - h), low)
               call solve_skf(part, loads(i), spins(k), reversal*(1.0_wp + h), high)
               call check_scaled(error, state%by_reversal, (high%torque - low%torque)/(2.0_wp*h), &
                  & abs(state%by_reversal) + abs(state%torque)*1.0e-4_wp, tolerance, "over the spin of reversal")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_slopes

   subroutine test_stribeck(error)
      type(error_type), allocatable, intent(out) :: error
      type(skf_part_t) :: part
      type(skf_state_t) :: state
      ! Torques over load [m]: sliding without a film, least, rolling with a thick film, want of oil
      real(wp) :: torques(4)
      real(wp), parameter :: spins(4) = [0.2_wp, 300.0_wp, 2000.0_wp, 600000.0_wp]
      integer :: i

      call make_part(part, 40.0e-6_wp)
      ! A load so heavy that the sliding counts: the rolling grows with its power 0.31 alone
      do i = 1, size(spins)
         call solve_skf(part, 20000.0_wp, spins(i), reversal_spin, state)
         torques(i) = state%torque
      end do
      call check(error, torques(1) > 1.1_wp*torques(2) .and. torques(3) > 1.3_wp*torques(2) .and. torques(4) < torques(3), &
         & "boundary friction, a thin film, a thick film, want of oil")
   end subroutine test_stribeck

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: cases(3)
      integer :: k

      do k = 1, size(cases)
         cases(k) = skewed_case(rotation_names(1 + mod(k, 2)))
         call add_gas_force(cases(k))
         call add_skf_needles(cases(k))
      end do
      call check_bearing_energy(cases, 0.01_wp, error)
   end subroutine test_energy

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: rolling
      type(model_t) :: model
      type(error_t), allocatable :: failure
      character(len=*), parameter :: words(5) = [character(len=24) :: "leave a pin", "leave a pin", "above zero", "above zero", &
         & "not combined"]
      integer :: i

      do i = 1, size(words)
         rolling = thesis_case()
         call add_skf_needles(rolling)
         select case (i)
         case (1)
            rolling%needle_bearing%needle_radius = 0.0_wp
         case (2)
            rolling%needle_bearing%needle_radius = 0.6_wp*inner_radius
         case (3)
            rolling%needle_bearing%skf%rolling = 0.0_wp
         case (4)
            rolling%needle_bearing%skf%geometry = 0.0_wp
         case (5)
            allocate (rolling%needle_drag)
            rolling%needle_drag%pitch_diameter = 10.0e-3_wp
         end select
         call new_model(model, rolling, 1, failure)
         call expect_error(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
         deallocate (failure)
      end do
   end subroutine test_refusals

end module test_skf_bearing
