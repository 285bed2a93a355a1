!> Torque of seals and drive of the camshaft.
module test_shaft_drag
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed, check
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_case, only : case_t
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_step_inputs, only : inputs_t
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use camroller_shaft_drag, only : check_shaft_drag, find_shaft_drag, shaft_drag_t
   use camroller_shaft_simulation, only : advance_shaft, shaft_outcome_t, shaft_simulation_t, start_shaft
   use camroller_torque_list, only : of_shaft_drag
   use closeness, only : expect_error, has_failed
   use deck_cases, only : get_deck_case
   use result_checks, only : scalar_of
   implicit none
   private

   public :: collect_shaft_drag

   !> A few sums and products of numbers of order one [-]
   real(wp), parameter :: round_off = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_shaft_drag(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the torque is that of the table at its points, and linear between them", test_table), &
         new_unittest("outside the table there is no torque, with words", test_outside), &
         new_unittest("tables that are none are refused", test_refusals), &
         new_unittest("each camshaft takes the torque, and nothing else changes by a bit", test_run), &
         new_unittest("a host's camshaft takes the mean torque of a step in which speed and temperature change", test_host) &
         ]
   end subroutine collect_shaft_drag

   !> Torques that no straight line goes through
   function table() result(drag)
      type(shaft_drag_t) :: drag

      drag%speed_points = [0.0_wp, 50.0_wp, 300.0_wp]
      drag%temperature_points = [280.0_wp, 380.0_wp]
      drag%torque_points = [0.30_wp, 0.20_wp, 0.25_wp, 0.16_wp, 0.10_wp, 0.12_wp]
   end function table

   subroutine expect(error, drag, speed, temperature, expected)
      type(error_type), allocatable, intent(out) :: error
      type(shaft_drag_t), intent(in) :: drag
      ! [rad/s], [K], [N m]
      real(wp), intent(in) :: speed, temperature, expected
      type(error_t), allocatable :: failure
      real(wp) :: torque

      call find_shaft_drag(drag, speed, temperature, torque, failure)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
      else
         call check(error, abs(torque - expected) < round_off)
      end if
   end subroutine expect

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(shaft_drag_t) :: drag, alone
      integer :: i, j

      drag = table()
      do j = 1, 2
         do i = 1, 3
            call expect(error, drag, drag%speed_points(i), drag%temperature_points(j), drag%torque_points(3*(j - 1) + i))
            if (allocated(error)) return
         end do
      end do
      ! A fifth of the way from 50 to 300 rad/s, three quarters from 280 to 380 K; the sense of rotation does not matter
      call expect(error, drag, -100.0_wp, 355.0_wp, 0.25_wp*0.21_wp + 0.75_wp*0.104_wp)
      if (allocated(error)) return
      ! An end of the table that units or inputs of a host have rounded
      call expect(error, drag, nearest(300.0_wp, 1.0_wp), nearest(280.0_wp, -1.0_wp), 0.25_wp)
      if (allocated(error)) return
      alone%speed_points = [10.0_wp]
      alone%temperature_points = [300.0_wp]
      alone%torque_points = [0.2_wp]
      call expect(error, alone, 1000.0_wp, 250.0_wp, 0.2_wp)
   end subroutine test_table

   subroutine test_outside(error)
      type(error_type), allocatable, intent(out) :: error
      ! Speeds and temperatures, one of them outside [rad/s, K]
      real(wp), parameter :: places(2, 4) = reshape([301.0_wp, 300.0_wp, 100.0_wp, 279.9_wp, 100.0_wp, 380.1_wp, &
         & -301.0_wp, 300.0_wp], [2, 4])
      type(error_t), allocatable :: failure
      real(wp) :: torque
      integer :: i

      do i = 1, size(places, 2)
         call find_shaft_drag(table(), places(1, i), places(2, i), torque, failure)
         if (.not. allocated(failure)) call test_failed(error, "a place outside the table is taken")
         if (allocated(error)) return
         call check(error, failure%kind == kind_domain .and. index(failure%message, "&shaft_drag") > 0, failure%message)
         if (allocated(error)) return
      end do
   end subroutine test_outside

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(shaft_drag_t) :: drags(6)
      type(error_t), allocatable :: failure
      integer :: i

      drags = table()
      call check_shaft_drag(drags(1), failure)
      if (has_failed(failure, error)) return
      deallocate (drags(1)%torque_points)
      drags(2)%speed_points(2) = 0.0_wp
      drags(3)%temperature_points(2) = 280.0_wp
      drags(4)%torque_points(3) = -0.1_wp
      drags(5)%torque_points = [0.1_wp]
      drags(6)%speed_points = [real(wp) ::]
      drags(6)%torque_points = [real(wp) ::]
      do i = 1, size(drags)
         call check_shaft_drag(drags(i), failure)
         if (.not. allocated(failure)) call test_failed(error, "a table that is none is taken")
         if (allocated(error)) return
         call check(error, failure%kind == kind_deck)
         if (allocated(error)) return
      end do
   end subroutine test_refusals

   subroutine test_run(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: without, with
      type(error_t), allocatable :: failure
      ! Torque on each of two camshafts [N m]
      real(wp) :: torque
      integer :: i, k, compared

      call get_deck_case("decks/four_cylinder.nml", case, failure)
      if (.not. allocated(failure)) call run_case(case, without, failure)
      case%shaft_drag = table()
      if (.not. allocated(failure)) call run_case(case, with, failure)
      if (.not. allocated(failure)) call find_shaft_drag(table(), case%operating_point%speed, &
         & case%operating_point%oil_temperature, torque, failure)
      if (has_failed(failure, error)) return
      compared = 0
      do i = 1, size(without%series)
         associate (name => without%series(i)%name)
            k = find_quantity(with%series, name)
            if (index(name, "torque_friction") + index(name, "torque_drive") > 0) then
               call check(error, all(abs(with%series_values(:, k) - without%series_values(:, i) &
                  & - merge(1, 2, index(name, "camshaft_") == 1)*torque) < round_off*maxval(abs(with%series_values(:, k)))), name)
            else
               call check(error, all(abs(with%series_values(:, k) - without%series_values(:, i)) <= 0.0_wp), name)
               compared = compared + 1
            end if
            if (allocated(error)) return
         end associate
      end do
      call check(error, compared > 30, "hardly anything is compared")
      if (.not. allocated(error)) call expect_scalar("mean_torque_shaft_drag", 2.0_wp*torque)
      if (.not. allocated(error)) call expect_scalar("mean_camshaft_2_torque_friction", &
         & scalar_of(without, "mean_camshaft_2_torque_friction") + torque)
      if (.not. allocated(error)) call expect_scalar("power_shaft_drag", 2.0_wp*torque*case%operating_point%speed)
      if (.not. allocated(error)) call expect_scalar("work_shaft_drag", 2.0_wp*torque*two_pi)
      if (.not. allocated(error)) call expect_scalar("fmep_shaft_drag", 4.0_wp*pi*torque/case%engine%displacement)
      if (.not. allocated(error)) call expect_scalar("mean_torque_friction", scalar_of(without, "mean_torque_friction") &
         & + 2.0_wp*torque)
      if (.not. allocated(error)) call expect_scalar("min_energy_residual", scalar_of(without, "min_energy_residual"))

   contains

      !> A scalar of the result with seals and drive
      subroutine expect_scalar(name, expected)
         character(len=*), intent(in) :: name
         ! [unit of the scalar]
         real(wp), intent(in) :: expected

         call check(error, abs(scalar_of(with, name) - expected) <= round_off*abs(expected), name)
      end subroutine expect_scalar

   end subroutine test_run

   subroutine test_host(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(shaft_simulation_t) :: with, without
      type(shaft_outcome_t) :: outcome, plain
      type(inputs_t) :: start, finish
      type(error_t), allocatable :: failure
      ! Torques at start and end, and half way [N m]
      real(wp) :: torques(3)

      call get_deck_case("decks/mixed_bearings.nml", case, failure)
      if (.not. allocated(failure)) call start_shaft(without, case, 0.0_wp, failure)
      case%shaft_drag = table()
      if (.not. allocated(failure)) call start_shaft(with, case, 0.0_wp, failure)
      start%speed = 60.0_wp
      start%oil_temperature = 300.0_wp
      finish%speed = 110.0_wp
      finish%oil_temperature = 320.0_wp
      if (.not. allocated(failure)) call advance_shaft(without, 0.3_wp, start, finish, plain, failure)
      if (.not. allocated(failure)) call advance_shaft(with, 0.3_wp, start, finish, outcome, failure)
      if (.not. allocated(failure)) call find_shaft_drag(case%shaft_drag, 60.0_wp, 300.0_wp, torques(1), failure)
      if (.not. allocated(failure)) call find_shaft_drag(case%shaft_drag, 85.0_wp, 310.0_wp, torques(2), failure)
      if (.not. allocated(failure)) call find_shaft_drag(case%shaft_drag, 110.0_wp, 320.0_wp, torques(3), failure)
      if (has_failed(failure, error)) return
      ! A product of two straight lines over the angle, of which Simpson's rule is exact
      call check(error, abs(outcome%mean_torques(of_shaft_drag) - (torques(1) + 4.0_wp*torques(2) + torques(3))/6.0_wp) < round_off)
      if (allocated(error)) return
      call check(error, abs(outcome%torques(of_shaft_drag) - torques(3)) < round_off .and. &
         & abs(outcome%by_camshaft(of_shaft_drag, 1) - torques(3)) < round_off, "at the end")
      if (allocated(error)) return
      call check(error, abs(outcome%mean_torque_drive - plain%mean_torque_drive - outcome%mean_torques(of_shaft_drag)) &
         & < round_off*abs(plain%mean_torque_drive) .and. outcome%extreme_torque(2) > plain%extreme_torque(2) + 0.1_wp, "drive")
      if (allocated(error)) return
      ! Faster than the table goes
      finish%speed = 400.0_wp
      call advance_shaft(with, 0.4_wp, start, finish, outcome, failure)
      call expect_error(error, failure, kind_domain, "is not known at")
   end subroutine test_host

end module test_shaft_drag
