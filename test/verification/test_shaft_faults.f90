!> All followers of a case driven together: outcomes of other shafts, and what is refused without harm.
module test_shaft_faults
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use camroller, only : wp, error_t, case_t, shaft_simulation_t, shaft_outcome_t, kind_deck, kind_usage, start_shaft, &
      & advance_shaft, cam_place, result_t, run_case, shaft_values
   use deck_cases, only : get_deck_case
   use closeness, only : expect_error, has_failed
   use driven_trains, only : steady
   implicit none
   private

   public :: collect_shaft_faults

contains

   subroutine collect_shaft_faults(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("an outcome serves one shaft after another, with more bearings, with fewer and with none", test_reused), &
         new_unittest("a cam that is not there, and an outcome of no step, are errors", test_values_refused), &
         new_unittest("lists of a shaft made by hand that are missing or do not fit are errors, in runs and steps", &
            & test_lists_refused), &
         new_unittest("more modes of a spring than there are places are an error", test_modes_refused) &
         ]
   end subroutine collect_shaft_faults

   !> Two bearings, then four, none and two again, against outcomes of their own.
   subroutine test_reused(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(4) = [character(len=14) :: "mixed_bearings", "three_cam_head", "thesis", &
         & "mixed_bearings"]
      integer, parameter :: bearings(4) = [2, 4, 0, 2]
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft, again
      type(shaft_outcome_t) :: reused
      type(error_t), allocatable :: failure
      ! Numbers of the camshafts [unit of the series]
      real(wp), allocatable :: values(:), expected(:)
      integer :: i

      do i = 1, size(decks)
         call get_deck_case("decks/"//trim(decks(i))//".nml", the_case, failure)
         if (has_failed(failure, error)) return
         if (bearings(i) == 0) deallocate (the_case%cam_bearings)
         call start_shaft(shaft, the_case, 0.0_wp, failure)
         if (has_failed(failure, error)) return
         again = shaft
         call advance_shaft(shaft, 0.1_wp, steady(the_case), steady(the_case), reused, &
            & failure)
         if (has_failed(failure, error)) return
         call shaft_values(shaft, 0, reused, values)
         call step_afresh(again, the_case, expected, failure)
         if (has_failed(failure, error)) return
         call check(error, allocated(reused%bearings) .eqv. bearings(i) > 0, "bearings where there are none, or the reverse")
         if (allocated(error)) return
         if (allocated(reused%bearings)) call check(error, size(reused%bearings, 1), bearings(i))
         if (allocated(error)) return
         call check(error, size(values) == size(expected), "other series")
         if (.not. allocated(error)) call check(error, &
            & all(abs(values - expected) <= 0.0_wp), "the outcome used before has other values")
         if (allocated(error)) return
      end do
   end subroutine test_reused

   !> The first step of a shaft, into an outcome of its own.
   subroutine step_afresh(shaft, the_case, values, failure)
      type(shaft_simulation_t), intent(inout) :: shaft
      type(case_t), intent(in) :: the_case
      !> Numbers of the camshafts [unit of the series]
      real(wp), allocatable, intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: failure
      type(shaft_outcome_t) :: fresh

      call advance_shaft(shaft, 0.1_wp, steady(the_case), steady(the_case), fresh, failure)
      if (.not. allocated(failure)) call shaft_values(shaft, 0, fresh, values, failure)
   end subroutine step_afresh

   subroutine test_values_refused(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft, unstarted
      type(shaft_outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Numbers [unit of the series]; phase of a cam [rad]
      real(wp), allocatable :: values(:)
      real(wp) :: phase
      integer :: lobe, camshaft, cam

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      do cam = 0, 1
         call shaft_values(shaft, cam, outcome, values, failure)
         if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "advance_shaft")
         call shaft_values(shaft, cam, outcome, values)
         if (.not. allocated(error)) call check(error, size(values), 0)
         call shaft_values(unstarted, cam, outcome, values, failure)
         if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "start_shaft")
      end do
      do cam = -1, 4, 5
         call shaft_values(shaft, cam, outcome, values, failure)
         if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "there is no cam")
      end do
      do cam = 0, 4, 4
         call cam_place(shaft, cam, lobe, camshaft, phase, failure)
         if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "there is no cam")
         call cam_place(shaft, cam, lobe, camshaft, phase)
         if (.not. allocated(error)) call check(error, lobe, 0)
      end do
      call cam_place(unstarted, 1, lobe, camshaft, phase, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "start_shaft")
   end subroutine test_values_refused

   subroutine test_lists_refused(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: faults = 14
      type(case_t) :: given, the_case
      type(shaft_simulation_t) :: shaft
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case("decks/mixed_bearings.nml", given, failure)
      if (has_failed(failure, error)) return
      do i = 1, faults
         the_case = given
         call spoil(the_case, i)
         call run_case(the_case, result, failure)
         call expect_error(error, failure, kind_deck, "cam_bearings: ")
         if (allocated(error)) return
         call start_shaft(shaft, the_case, 0.0_wp, failure)
         call expect_error(error, failure, kind_deck, "cam_bearings: ")
         if (allocated(error)) return
      end do

   contains

      !> A case with one fault.
      subroutine spoil(the_case, fault)
         type(case_t), intent(inout) :: the_case
         !> Number of the fault
         integer, intent(in) :: fault

         associate (shaft => the_case%cam_bearings)
            select case (fault)
            case (1)
               deallocate (shaft%bearing_positions)
            case (2)
               deallocate (shaft%cam_positions)
            case (3)
               deallocate (shaft%cam_phases)
            case (4)
               deallocate (shaft%cam_lobes)
            case (5)
               deallocate (shaft%follower_angles)
            case (6)
               shaft%cam_positions = [0.02_wp, 0.04_wp]
            case (7)
               shaft%cam_lobes = [2]
            case (8)
               shaft%bearing_positions(1) = ieee_value(1.0_wp, ieee_quiet_nan)
            case (9)
               shaft%cam_shafts = [3]
            case (10)
               shaft%bearing_positions = [real(wp) ::]
            case (11)
               shaft%follower_angles(1) = ieee_value(1.0_wp, ieee_quiet_nan)
            case (12)
               shaft%bearing_positions = [0.0_wp]
            case (13)
               shaft%bearing_positions = [0.06_wp, 0.0_wp]
            case (14)
               shaft%cam_positions(1) = 1.0_wp
            end select
         end associate
      end subroutine spoil
   end subroutine test_lists_refused

   subroutine test_modes_refused(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: modes(*) = [0, 21, 99]
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      call get_deck_case("decks/lash_adjuster.nml", the_case, failure)
      if (has_failed(failure, error)) return
      do i = 1, size(modes)
         the_case%spring_surge%modes = modes(i)
         call run_case(the_case, result, failure)
         call expect_error(error, failure, kind_deck, "modes must be from 1 to 20")
         if (allocated(error)) return
      end do
   end subroutine test_modes_refused

end module test_shaft_faults
