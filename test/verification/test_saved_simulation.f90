!> A follower between two steps as a block of bytes: the one made of it continues with the same bits; other blocks are refused.
module test_saved_simulation
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_value
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, case_t, error_t, inputs_t, kind_usage, outcome_t, shaft_outcome_t, shaft_simulation_t, &
      & simulation_t, advance, advance_shaft, restore_simulation, save_shaft, save_simulation, start_shaft, start_simulation
   use deck_cases, only : get_deck_case
   use closeness, only : expect_error, has_failed
   use reference_cases, only : add_gas_force
   implicit none
   private

   public :: collect_saved_simulation

contains

   subroutine collect_saved_simulation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a follower made of a block continues with the same bits, at another speed and with other oil", test_bits), &
         new_unittest("with films solved beforehand at an earlier speed, too", test_films), &
         new_unittest("a step that fails while films are solved again leaves those before it", test_failed_films), &
         new_unittest("a step that one cam of a shaft fails leaves the films of the others as well", test_failed_cam), &
         new_unittest("a block is refused by a case that differs in what cold oil keeps apart alone", test_cold_cases), &
         new_unittest("with a flexible train, too", test_trains), &
         new_unittest("a block of a case with other oil or gas pressure that no state shows is refused", test_other_cases), &
         new_unittest("a block that is damaged, short, of another case or of a shaft is refused", test_refusals) &
         ]
   end subroutine collect_saved_simulation

   subroutine test_bits(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_bits("decks/thesis.nml", [20.0_wp, 26.0_wp, 35.0_wp], [300.0_wp, 310.0_wp, 330.0_wp], error)
      if (allocated(error)) return
      call compare_bits("decks/hard/stick_slip_true.nml", [20.0_wp, 26.0_wp, 35.0_wp], [300.0_wp, 310.0_wp, 330.0_wp], error)
   end subroutine test_bits

   subroutine test_trains(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_bits("decks/dynamics.nml", [200.0_wp, 260.0_wp, 350.0_wp], [360.0_wp, 361.0_wp, 363.0_wp], error)
      if (allocated(error)) return
      call compare_bits("decks/lash_adjuster.nml", [50.0_wp, 60.0_wp, 65.0_wp], [360.0_wp, 361.0_wp, 363.0_wp], error)
      if (allocated(error)) return
      call compare_bits("decks/flexible_friction.nml", [50.0_wp, 60.0_wp, 65.0_wp], [360.0_wp, 361.0_wp, 363.0_wp], error)
   end subroutine test_trains

   !> The films of the start serve at the speed of the block, which solving them there would change.
   subroutine test_films(error)
      type(error_type), allocatable, intent(out) :: error

      call compare_bits("decks/numerical_film.nml", [25.0_wp, 20.0_wp, 18.0_wp], spread(333.0_wp, 1, 3), error)
      ! The speed leaves the range of the films at the end of the step, after which it stays
      if (.not. allocated(error)) call compare_bits("decks/numerical_film.nml", [25.0_wp, 31.25_wp, 31.25_wp], &
         & spread(333.0_wp, 1, 3), error)
   end subroutine test_films

   !> The speed of the step that fails is beyond the range of numerical solutions.
   subroutine test_failed_films(error)
      type(error_type), allocatable, intent(out) :: error
      type(inputs_t), parameter :: steady = inputs_t(speed=25.0_wp, oil_temperature=333.0_wp), &
         & failing = inputs_t(speed=1.0e10_wp, oil_temperature=333.0_wp)
      type(case_t) :: case
      type(simulation_t) :: follower, other
      type(outcome_t) :: outcome, expected
      type(error_t), allocatable :: failure

      call get_deck_case("decks/numerical_film.nml", case, failure)
      case%operating_point%speed = steady%speed
      case%operating_point%oil_temperature = steady%oil_temperature
      if (.not. allocated(failure)) call start_simulation(follower, case, 2.4_wp, failure)
      if (has_failed(failure, error)) return
      other = follower
      call advance(follower, 2.8_wp, failing, failing, outcome, failure)
      call check(error, allocated(failure), "no error")
      if (allocated(error)) return
      call advance(other, 2.8_wp, steady, steady, expected, failure)
      if (.not. allocated(failure)) call advance(follower, 2.8_wp, steady, steady, outcome, failure)
      if (has_failed(failure, error)) return
      call check(error, all(bits_of(outcome) == bits_of(expected)), "bits differ")
   end subroutine test_failed_films

   !> The first cam has made the step, with warmer oil and its films, before the second one refuses its pressure.
   subroutine test_failed_cam(error)
      type(error_type), allocatable, intent(out) :: error
      type(inputs_t), parameter :: steady = inputs_t(speed=25.0_wp, oil_temperature=333.0_wp), &
         & warm = inputs_t(speed=25.0_wp, oil_temperature=340.0_wp)
      ! Pressures of both cams at both ends [Pa]
      real(wp) :: pressures(2, 2)
      type(case_t) :: case
      type(shaft_simulation_t) :: shaft, other
      type(shaft_outcome_t) :: outcome, expected
      type(error_t), allocatable :: failure
      integer :: cam

      call get_deck_case("decks/numerical_film.nml", case, failure)
      case%operating_point%speed = steady%speed
      case%operating_point%oil_temperature = steady%oil_temperature
      case%cam_bearings%cam_positions = [0.02_wp, 0.04_wp]
      case%cam_bearings%cam_phases = [0.0_wp, 0.5_wp*pi]
      case%cam_bearings%cam_lobes = [1, 1]
      case%cam_bearings%follower_angles = [0.0_wp, 0.0_wp]
      call add_gas_force(case)
      if (.not. allocated(failure)) call start_shaft(shaft, case, 2.4_wp, failure)
      if (has_failed(failure, error)) return
      other = shaft
      pressures(1, :) = 0.0_wp
      pressures(2, :) = ieee_value(1.0_wp, ieee_positive_inf)
      call advance_shaft(shaft, 2.8_wp, warm, warm, outcome, failure, pressures)
      call expect_error(error, failure, kind_usage, "cam 2")
      if (allocated(error)) return
      deallocate (failure)
      call advance_shaft(other, 2.8_wp, steady, steady, expected, failure)
      if (.not. allocated(failure)) call advance_shaft(shaft, 2.8_wp, steady, steady, outcome, failure)
      if (has_failed(failure, error)) return
      do cam = 1, 2
         call check(error, all(bits_of(outcome%followers(cam)) == bits_of(expected%followers(cam))), "bits differ")
         if (allocated(error)) return
      end do
   end subroutine test_failed_cam

   !> Save a follower in the middle of a turn; drive it and the one made of the block on.
   subroutine compare_bits(path, speeds, temperatures, error)
      !> Path of the deck
      character(len=*), intent(in) :: path
      !> Cam speeds [rad/s] and temperatures of the oil [K] at the start, at the block and at the end
      real(wp), intent(in) :: speeds(3), temperatures(3)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: steps = 3
      type(case_t) :: case
      type(simulation_t) :: saved, restored
      type(outcome_t) :: of_saved, of_restored
      type(inputs_t) :: ends(2)
      integer(int8), allocatable :: block(:)
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case(path, case, failure)
      case%operating_point%speed = speeds(1)
      case%operating_point%oil_temperature = temperatures(1)
      if (.not. allocated(failure)) call start_simulation(saved, case, 2.4_wp, failure)
      ends = [(inputs_t(speed=speeds(i), oil_temperature=temperatures(i)), i=1, 2)]
      if (.not. allocated(failure)) call advance(saved, 2.8_wp, ends(1), ends(2), of_saved, failure)
      if (.not. allocated(failure)) call save_simulation(saved, block, failure)
      if (.not. allocated(failure)) call restore_simulation(restored, case, block, failure)
      ends = [(inputs_t(speed=speeds(i), oil_temperature=temperatures(i)), i=2, 3)]
      do i = 1, steps
         if (.not. allocated(failure)) call advance(saved, 2.8_wp + 0.3_wp*i, ends(1), ends(2), of_saved, failure)
         if (.not. allocated(failure)) call advance(restored, 2.8_wp + 0.3_wp*i, ends(1), ends(2), of_restored, failure)
         if (has_failed(failure, error)) return
         call check(error, all(bits_of(of_saved) == bits_of(of_restored)), "bits differ: "//path)
         if (allocated(error)) return
         ends(1) = ends(2)
      end do
   end subroutine compare_bits

   !> Bits of what a step gives.
   pure function bits_of(outcome) result(bits)
      type(outcome_t), intent(in) :: outcome
      integer(int64) :: bits(7)

      associate (contact => outcome%state%contact, extremes => outcome%extremes)
         bits = transfer([outcome%mean_torque_drive, outcome%mean_torque_friction, outcome%estimated_error, contact%roller_spin, &
            & contact%film_min, extremes%film_min, extremes%sliding_speed(2)], bits)
      end associate
   end function bits_of

   !> Viscosity at temperatures other than that of the case; a pressure that differs in its last digit.
   subroutine test_other_cases(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(simulation_t) :: simulation
      integer(int8), allocatable :: block(:)
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case("decks/three_cam_head.nml", case, failure)
      if (has_failed(failure, error)) return
      case%lubricant%temperature_law = "vogel"
      case%lubricant%temperature_points = [313.15_wp, 343.15_wp, 373.15_wp]
      case%lubricant%viscosity_points = [0.08_wp, 0.025_wp, 0.011_wp]
      case%operating_point%oil_temperature = 313.15_wp
      call start_simulation(simulation, case, pi, failure)
      if (.not. allocated(failure)) call save_simulation(simulation, block, failure)
      if (.not. allocated(failure)) call restore_simulation(simulation, case, block, failure)
      if (has_failed(failure, error)) return
      do i = 1, 2
         other = case
         if (i == 1) then
            ! the first point, at the temperature of the case, stays
            other%lubricant%viscosity_points = [0.08_wp, 0.024_wp, 0.010_wp]
         else
            other%gas_force%pressure(5) = nearest(other%gas_force%pressure(5), 1.0_wp)
         end if
         call restore_simulation(simulation, other, block, failure)
         call check(error, allocated(failure), merge("another oil was taken      ", "another pressure was taken ", i == 1))
         if (allocated(error)) return
         call check(error, index(failure%message, "another case") > 0, failure%message)
         if (allocated(error)) return
      end do
   end subroutine test_other_cases

   !> Roughness, and friction of a plain pin, where thick films leave no contact at the point of the case
   subroutine test_cold_cases(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(simulation_t) :: simulation
      integer(int8), allocatable :: block(:)
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 2
         if (i == 1) call get_deck_case("decks/thesis.nml", case, failure)
         if (i == 2) call get_deck_case("decks/plain_pin.nml", case, failure)
         case%operating_point%oil_temperature = 253.15_wp
         case%operating_point%speed = 94.0_wp
         if (.not. allocated(failure)) call start_simulation(simulation, case, pi, failure)
         if (.not. allocated(failure)) call save_simulation(simulation, block, failure)
         if (.not. allocated(failure)) call restore_simulation(simulation, case, block, failure)
         if (has_failed(failure, error)) return
         other = case
         if (i == 1) other%surface%cam_roughness = 2.0_wp*case%surface%cam_roughness
         if (i == 2) other%needle_bearing%friction_coefficient = 2.0_wp*case%needle_bearing%friction_coefficient
         call restore_simulation(simulation, other, block, failure)
         call check(error, allocated(failure), merge("another roughness was taken", "another pin was taken      ", i == 1))
         if (allocated(error)) return
         call check(error, index(failure%message, "another case") > 0, failure%message)
         if (allocated(error)) return
      end do
   end subroutine test_cold_cases

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(simulation_t) :: simulation, unstarted
      type(shaft_simulation_t) :: shaft
      integer(int8), allocatable :: block(:), of_shaft(:), damaged(:)
      type(error_t), allocatable :: failure
      integer :: place

      call get_deck_case("decks/thesis.nml", case, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, case, pi, failure)
      if (.not. allocated(failure)) call save_simulation(simulation, block, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, case, pi, failure)
      if (.not. allocated(failure)) call save_shaft(shaft, of_shaft, failure)
      if (has_failed(failure, error)) return
      ! one bit of any byte behind what says that it is a block and of which format
      do place = 17, size(block)
         damaged = block
         damaged(place) = ieor(damaged(place), 1_int8)
         call restore_simulation(simulation, case, damaged, failure)
         if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "damaged")
         if (allocated(error)) return
      end do
      call restore_simulation(simulation, case, block(:size(block) - 1), failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "size")
      call restore_simulation(simulation, case, of_shaft, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "block")
      damaged = block
      damaged(1) = not(damaged(1))
      call restore_simulation(simulation, case, damaged, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "not one that was saved")
      damaged = block
      damaged(9) = not(damaged(9))
      call restore_simulation(simulation, case, damaged, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "format")
      other = case
      other%mechanism%contact_width = 1.001_wp*case%mechanism%contact_width
      call restore_simulation(simulation, other, block, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "another case")
      other = case
      other%numerics%method = "euler"
      call restore_simulation(simulation, other, block, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "restore_simulation: the method")
      call save_simulation(unstarted, block, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "start_simulation")
   end subroutine test_refusals

end module test_saved_simulation
