!> Cases that were made of components: their numbers are held against the ranges of the deck's keys.
module test_hand_made
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_core, only : wp, case_t, check_case, error_t, kind_deck
   use closeness, only : expect_error, has_failed
   use deck_cases, only : get_deck_case
   implicit none
   private

   public :: collect_hand_made

contains

   subroutine collect_hand_made(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the case of a deck has no number outside of the range of its key", test_decks), &
         new_unittest("a number that a deck refuses is refused in a case made by hand, by the name of its key", test_refused), &
         new_unittest("all numbers outside of their ranges are named, and nothing of effects that are not there", test_all) &
         ]
   end subroutine collect_hand_made

   !> Of every group at least one deck has it; random decks are checked in `random_wide`.
   subroutine test_decks(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(*) = [character(len=20) :: "thesis", "sliding_joints", "plain_pin", "mixed_bearings", &
         & "heated_contact", "tribofilm", "logarithmic_roller", "four_cylinder", "lash_adjuster", "three_cam_head", &
         & "journal_orbits", "numerical_film"]
      type(case_t) :: the_case
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, size(decks)
         call get_deck_case("decks/"//trim(decks(i))//".nml", the_case, failure)
         if (.not. allocated(failure)) call check_case(the_case, failure)
         if (has_failed(failure, error)) return
      end do
   end subroutine test_decks

   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: words(*) = [character(len=80) :: &
         & "valve_guide.radial_clearance_um = -20, and must be above 0", &
         & "needle_bearing.friction_coefficient = -0.003, and must be 0 or more", &
         & "spring.seat_stiffness_N_m = NaN, and must be above 0", &
         & "roller.wall_thickness_mm = -3, and must be above 0", &
         & "spring.base_circle_load_N = -5, and must be 0 or more", &
         & "masses.valve_kg = -0.04, and must be 0 or more", &
         & "numerics.accuracy = 0, and must be from 1e-10 to 0.1", &
         & "operating_point.oil_temperature_degC = -273.15, and must be above -273.15", &
         & "cam_bearings.cam_lobes = 3, and must be from 1 to 2", &
         & "cam_bearings.bearing_positions_mm = Infinity, and must be a number"]
      type(case_t) :: given, the_case
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case("decks/thesis.nml", given, failure)
      if (has_failed(failure, error)) return
      do i = 1, size(words)
         the_case = given
         select case (i)
         case (1)
            the_case%valve_guide%radial_clearance = -2.0e-5_wp
         case (2)
            the_case%needle_bearing%friction_coefficient = -0.003_wp
         case (3)
            the_case%spring%seat_stiffness = ieee_value(1.0_wp, ieee_quiet_nan)
         case (4)
            the_case%roller%wall_thickness = -3.0e-3_wp
         case (5)
            the_case%spring%base_circle_load = -5.0_wp
         case (6)
            the_case%masses%valve = -0.04_wp
         case (7)
            the_case%numerics%accuracy = 0.0_wp
         case (8)
            the_case%operating_point%oil_temperature = 0.0_wp
         case (9)
            the_case%cam_bearings%cam_lobes(1) = 3
         case (10)
            the_case%cam_bearings%bearing_positions(1) = ieee_value(1.0_wp, ieee_positive_inf)
         end select
         call check_case(the_case, failure)
         call expect_error(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
      end do
   end subroutine test_refused

   subroutine test_all(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(error_t), allocatable :: failure

      call get_deck_case("decks/thesis.nml", the_case, failure)
      if (has_failed(failure, error)) return
      the_case%masses%valve = -0.04_wp
      the_case%spring%stiffness = 0.0_wp
      call check_case(the_case, failure)
      if (.not. allocated(failure)) then
         call test_failed(error, "no error")
         return
      end if
      call check(error, failure%message, "masses.valve_kg = -0.04, and must be 0 or more"//new_line("a")// &
         & "spring.stiffness_N_m = 0, and must be above 0")
   end subroutine test_all

end module test_hand_made
