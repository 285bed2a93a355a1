!> Remarks of results: loss of contact, the lobe concerned, and the policy that refuses such cases.
module test_result_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree, two_pi
   use camroller_error, only : error_t, kind_domain
   use camroller_case, only : case_t
   use camroller_lift, only : lift_t
   use camroller_remarks, only : film_without_limit, remark_lines, rolling_out_of_range
   use camroller_result, only : result_t, get_summary
   use camroller_run, only : run_case
   use closeness, only : expect_error
   use lobe_cases, only : fast, low_lift, run, thesis_lift, two_lobes
   use reference_cases, only : thesis_case, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_result_remarks

contains

   subroutine collect_result_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("loss of contact gives a remark with fraction of the turn, speed and angles", test_remark), &
         new_unittest("the remark on loss of contact names the lobe", test_lobe_remark), &
         new_unittest("contact_policy 'stop' refuses loss of contact and no other remark", test_policy), &
         new_unittest("rolling resistance by a law for elastic contacts gives a remark where the contact is rigid", test_rolling) &
         ]
   end subroutine collect_result_remarks

   subroutine test_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Part of the cycle [-]
      real(wp) :: share

      case = thesis_case()
      case%film%law = "moes"
      call set_point(case, fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "contact is lost for ") == 1, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, &
         & index(remark_lines(result%remarks), " % of the cycle at 3600 rev/min, at cam angles 165.4 to 194.7 deg") > 0, &
         remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "above 2937 rev/min") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      ! both angles are rounded to a tenth
      call get_summary(result, "lost_contact_share", share, failure)
      call check(error, share, (194.7_wp - 165.4_wp)/360.0_wp, thr=0.1_wp/360.0_wp)
      if (allocated(error)) return
      call set_point(case, 0.7_wp*fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "contact is lost"), 0)
   end subroutine test_remark

   subroutine test_lobe_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(lift_t) :: sharp

      sharp = thesis_lift()
      sharp%opening_half_angle = 50.0_wp*degree
      sharp%closing_half_angle = 50.0_wp*degree
      case = two_lobes(low_lift(), sharp, [1, 2])
      case%film%law = "moes"
      call set_point(case, 0.7_wp*fast, point_viscosities(3))
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "lobe 2: contact is lost for ") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "lobe 1: contact is lost for "), 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, any(result%remarks%kind == film_without_limit .and. result%remarks%lobe == 2) .and. &
         & index(remark_lines(result%remarks), "lobe 2: mean and largest value of film") > 0, remark_lines(result%remarks))
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "largest asperity_friction_share may be those of next to no") > 0 &
         & .eqv. allocated(case%asperity), remark_lines(result%remarks))
      if (allocated(error)) return
      deallocate (case%asperity)
      call run(case, result, error)
      if (allocated(error)) return
      call check(error, index(remark_lines(result%remarks), "asperity_friction_share"), 0, remark_lines(result%remarks))
   end subroutine test_lobe_remark

   subroutine test_policy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%contact_policy = "stop"
      call run(case, result, error)
      if (allocated(error)) return
      call set_point(case, fast, point_viscosities(3))
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_domain, "contact is lost for ")
      if (allocated(error)) return
      call expect_error(error, failure, kind_domain, "contact_policy = 'stop'")
   end subroutine test_policy

   !> On a base circle with next to no load the rolling resistance of a rigid contact goes with the root of the load. The load rises
   !> within four degrees at both ends of the event, which are 2 % of the turn.
   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      ! Part of the cycle on the base circle [%]
      real(wp) :: on_base_circle
      integer :: i

      do i = 1, 3
         case = thesis_case()
         call set_point(case, point_speeds(1), point_viscosities(1))
         if (i < 3) case%traction%rolling_law = "goksem_hargreaves"
         if (i > 1) case%spring%base_circle_load = 1.0e-2_wp*case%spring%base_circle_load
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, any(result%remarks%kind == rolling_out_of_range) .eqv. i == 2, remark_lines(result%remarks))
         if (allocated(error)) return
         if (i /= 2) cycle
         on_base_circle = 100.0_wp - 100.0_wp*(case%lift%opening_half_angle + case%lift%closing_half_angle)/two_pi
         associate (share => pack(result%remarks%size, result%remarks%kind == rolling_out_of_range))
            call check(error, share(1), on_base_circle, thr=3.0_wp)
         end associate
         if (allocated(error)) return
      end do
   end subroutine test_rolling

end module test_result_remarks
