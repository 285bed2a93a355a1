!> Cases with two lobe shapes, bearings of a camshaft, and a case that must have a result.
module lobe_cases
   use testdrive, only : error_type
   use camroller_kinds, only : wp, pi, degree
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_journal, only : cam_bearings_t
   use camroller_lift, only : lift_t
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use closeness, only : expect_success
   use reference_cases, only : thesis_case
   implicit none
   private

   public :: fast, low_lift, run, thesis_lift, three_bearings, two_lobes

   !> Speed at which contact is lost around the nose [rad/s]: 3600 rev/min
   real(wp), parameter :: fast = 120.0_wp*pi

contains

   !> Two cams of two lobe shapes.
   function two_lobes(first, second, lobes) result(case)
      type(lift_t), intent(in) :: first, second
      integer, intent(in) :: lobes(2)
      type(case_t) :: case

      case = thesis_case()
      case%lift = first
      allocate (case%second_lift, source=second)
      allocate (case%cam_bearings)
      associate (bearings => case%cam_bearings)
         bearings%diameter = 23.0e-3_wp
         bearings%width = 20.0e-3_wp
         bearings%radial_clearance = 47.5e-6_wp
         bearings%bearing_positions = [0.0_wp, 100.0e-3_wp]
         bearings%cam_positions = [30.0e-3_wp, 70.0e-3_wp]
         bearings%cam_phases = [0.0_wp, 0.4_wp*pi]
         bearings%cam_lobes = lobes
         bearings%follower_angles = [0.0_wp, 0.0_wp]
      end associate
      case%numerics%output_step = 5.0_wp*degree
   end function two_lobes

   !> Two cams of one lobe shape on three bearings.
   function three_bearings() result(bearings)
      type(cam_bearings_t) :: bearings

      bearings%law = "finite"
      bearings%diameter = 23.0e-3_wp
      bearings%width = 20.0e-3_wp
      bearings%radial_clearance = 47.5e-6_wp
      bearings%bearing_positions = [0.0_wp, 0.06_wp, 0.12_wp]
      bearings%cam_positions = [0.03_wp, 0.08_wp]
      bearings%cam_phases = [0.0_wp, 1.0_wp]
      bearings%cam_lobes = [1, 1]
      bearings%follower_angles = [0.0_wp, 0.3_wp]
      bearings%by_bearing = .true.
   end function three_bearings

   !> A lift with less height and a shorter event than that of the thesis.
   function low_lift() result(lift)
      type(lift_t) :: lift
      type(case_t) :: case

      case = thesis_case()
      lift = case%lift
      lift%max_lift = 7.0e-3_wp
      lift%opening_half_angle = 64.0_wp*degree
      lift%closing_half_angle = 64.0_wp*degree
   end function low_lift

   function thesis_lift() result(lift)
      type(lift_t) :: lift
      type(case_t) :: case

      case = thesis_case()
      lift = case%lift
   end function thesis_lift

   subroutine run(case, result, error)
      type(case_t), intent(in) :: case
      type(result_t), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure

      call run_case(case, result, failure)
      call expect_success(error, failure)
   end subroutine run

end module lobe_cases
