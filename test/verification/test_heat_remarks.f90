!> Remarks on heat that a case leaves out, against the case with it.
module test_heat_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : two_pi, wp
   use camroller_bearing_heat, only : bearing_heat_t, oil_flow, temperature_rise
   use camroller_case, only : case_t, operating_point_t
   use camroller_error, only : error_t
   use camroller_heat, only : heat_t
   use camroller_journal, only : journal_at_speed
   use camroller_lubricant, only : density_at
   use camroller_number_text, only : number_text
   use camroller_remarks, only : cool_bearings, cool_inlet, cool_pin
   use camroller_result, only : result_t
   use closeness, only : expect_success
   use deck_cases, only : get_deck_case
   use lobe_cases, only : run
   use result_checks, only : scalar_of
   implicit none
   private

   public :: collect_heat_remarks

   !> Operating points: cold, cool and hot oil [K], slow and fast [rad/s]
   type(operating_point_t), parameter :: points(*) = [operating_point_t(3000.0_wp*two_pi/60.0_wp, 273.15_wp), &
      & operating_point_t(3000.0_wp*two_pi/60.0_wp, 298.15_wp), operating_point_t(300.0_wp*two_pi/60.0_wp, 273.15_wp), &
      & operating_point_t(300.0_wp*two_pi/60.0_wp, 363.15_wp)]
   !> Are bearings worth a remark there, and inlets?
   logical, parameter :: warms_bearings(*) = [.true., .true., .true., .false.], warms_inlets(*) = [.true., .true., .false., .false.]

contains

   subroutine collect_heat_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("friction of bearings that a remark expects with heat is that with heat", test_bearings), &
         new_unittest("friction of a pin that a remark expects is that in oil so much warmer, which carries its heat off", &
         & test_pins), &
         new_unittest("the film that a remark expects with heat in the inlet is that with heat", test_inlets) &
         ]
   end subroutine collect_heat_remarks

   !> Within a quarter: all of the oil is warmer in the second case, so that the roller slips less and its pin turns faster.
   subroutine test_pins(error)
      type(error_type), allocatable, intent(out) :: error
      ! Temperatures of the oil [K], speeds [rad/s]
      type(operating_point_t), parameter :: cold_and_fast = operating_point_t(2500.0_wp*two_pi/60.0_wp, 298.15_wp), &
         & warm_and_slow = operating_point_t(900.0_wp*two_pi/60.0_wp, 333.15_wp)
      type(case_t) :: case
      type(result_t) :: cool, warm
      ! Diameter of the deck's pin [m]
      real(wp), parameter :: diameter = 12.2e-3_wp
      ! Rise of the remark, that which follows in oil so much warmer [K]; friction over that of cold oil [-]
      real(wp) :: rise, follows, part
      integer :: k

      call solve(warm_and_slow, case, cool, error, "decks/plain_pin.nml")
      if (.not. allocated(error)) call check(error, findloc(cool%remarks%kind, cool_pin, 1), 0, "a remark on a warm pin")
      if (.not. allocated(error)) call solve(cold_and_fast, case, cool, error, "decks/plain_pin.nml")
      if (allocated(error)) return
      k = findloc(cool%remarks%kind, cool_pin, 1)
      call check(error, k > 0, "no remark")
      if (allocated(error)) return
      associate (text => cool%remarks(k)%text)
         read (text(index(text, "by about ") + 9:index(text, " K, and") - 1), *) rise
      end associate
      case%operating_point%oil_temperature = cold_and_fast%oil_temperature + rise
      call run(case, warm, error)
      if (allocated(error)) return
      part = scalar_of(warm, "mean_torque_needle")/scalar_of(cool, "mean_torque_needle")
      call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.25_wp, "friction "//number_text(part, 3)//" of that when cold")
      if (allocated(error)) return
      associate (pin => case%needle_bearing%film, spin => scalar_of(warm, "mean_roller_spin"))
         follows = temperature_rise(bearing_heat_t(), density_at(case%lubricant, cold_and_fast%oil_temperature), &
            & scalar_of(warm, "mean_torque_needle")*case%operating_point%speed, &
            & oil_flow(journal_at_speed(3, diameter, pin%width, pin%radial_clearance, 1.0_wp, 1.0_wp), spin, &
            & scalar_of(warm, "mean_pin_eccentricity")))
      end associate
      call check(error, abs(follows/rise - 1.0_wp) < 0.25_wp, "rise of "//number_text(follows, 3)//" K")
   end subroutine test_pins

   !> One bearing stands for all, and one eccentricity for a turn: within 15 %, where friction falls to between 6 and 32 %.
   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: cool, warm
      real(wp) :: part ! [-]
      integer :: i, k

      do i = 1, size(points)
         call solve(points(i), case, cool, error)
         if (allocated(error)) return
         case%bearing_heat = bearing_heat_t()
         call run(case, warm, error)
         if (allocated(error)) return
         part = scalar_of(warm, "mean_torque_bearings")/scalar_of(cool, "mean_torque_bearings")
         k = findloc(cool%remarks%kind, cool_bearings, 1)
         call check(error, (k > 0) .eqv. warms_bearings(i), "remark with "//number_text(part, 3))
         if (allocated(error)) return
         call check(error, findloc(warm%remarks%kind, cool_bearings, 1) == 0, "a remark on heat that is there")
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.15_wp .and. index(cool%remarks(k)%text, &
            & "be about "//number_text(1.0_wp/cool%remarks(k)%size, 2)//" of what it is") > 0, number_text(part, 3)//" for "// &
            & cool%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_bearings

   !> The smallest factor of the turn is that of the largest speed of entrainment, but for the fall of the viscosity, which is that
   !> over 5 K for one of 15 and 30 K.
   subroutine test_inlets(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: cool, warm
      real(wp) :: part ! [-]
      integer :: i, k

      do i = 1, size(points)
         call solve(points(i), case, cool, error)
         if (allocated(error)) return
         case%heat = heat_t(inlet_law="murch_wilson", contact="none")
         call run(case, warm, error)
         if (allocated(error)) return
         part = scalar_of(warm, "min_inlet_heat_factor")
         k = findloc(cool%remarks%kind, cool_inlet, 1)
         call check(error, (k > 0) .eqv. warms_inlets(i), "remark with "//number_text(part, 3))
         if (allocated(error)) return
         call check(error, findloc(warm%remarks%kind, cool_inlet, 1) == 0, "a remark on heat that is there")
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.05_wp, number_text(part, 3)//" for "//cool%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_inlets

   !> The case of the thesis at a point, without heat.
   subroutine solve(point, case, result, error, deck)
      type(operating_point_t), intent(in) :: point
      type(case_t), intent(out) :: case
      type(result_t), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: deck

      type(error_t), allocatable :: failure

      if (present(deck)) then
         call get_deck_case(deck, case, failure)
      else
         call get_deck_case("decks/thesis.nml", case, failure)
      end if
      call expect_success(error, failure)
      if (allocated(error)) return
      case%operating_point = point
      call run(case, result, error)
   end subroutine solve

end module test_heat_remarks
