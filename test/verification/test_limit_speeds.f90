!> Limit speeds of a train.
module test_limit_speeds
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_limit_speeds, only : limits_t, start_limits, try_speed, joint_limit, adjuster_limit, contact_limit, seating_limit
   use camroller_result, only : get_summary, result_t
   use camroller_run, only : run_case
   use reference_cases, only : thesis_case, set_point
   use flexible_cases, only : add_dynamics
   use closeness, only : check_close, has_failed
   implicit none
   private

   public :: collect_limit_speeds

   !> Rad/s in a rev/min [-]
   real(wp), parameter :: minute = pi/30.0_wp

contains

   subroutine collect_limit_speeds(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("limit speeds of a rigid train are those of its margins, and contact is lost above them", test_rigid), &
         new_unittest("the speed at which a joint unloads is found to 1 rev/min", test_joint), &
         new_unittest("a speed that cannot be computed ends the scan with a message that names it", test_failure), &
         new_unittest("a limit is not regained where a motion without a period is beyond it within a step", test_scatter) &
         ]
   end subroutine collect_limit_speeds

   !> Numbers of an independent evaluation: 2357, 2471 and 2937 rev/min.
   subroutine test_rigid(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(limits_t) :: search
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Limit [rad/s], margin there [N]
      real(wp) :: speed, margin
      character(len=12), parameter :: names(*) = [character(len=12) :: "margin_pivot", "", "margin_event"]
      integer :: limit, side

      the_case = thesis_case()
      the_case%masses%finger = 0.0418_wp
      call start_limits(search, the_case, 0.5_wp, 6000.0_wp*minute, 100.0_wp*minute, failure)
      if (has_failed(failure, error)) return
      call check(error, .not. search%is_open, "a rigid train needs no scan")
      if (allocated(error)) return
      call check(error, all(abs(search%rigid(:contact_limit)/minute - [2471, 2357, 2937]) < 1.0_wp), "limits")
      if (allocated(error)) return
      call check(error, search%rigid(seating_limit) < 0.0_wp, "seating of a rigid train")
      if (allocated(error)) return
      ! A run just below and just above
      do limit = joint_limit, contact_limit, 2
         do side = -1, 1, 2
            speed = search%rigid(limit)*(1.0_wp + 1.0e-3_wp*side)
            call set_point(the_case, speed, 0.01_wp)
            call run_case(the_case, result, failure)
            if (.not. allocated(failure)) call get_summary(result, trim(names(limit)), margin, failure)
            if (has_failed(failure, error)) return
            call check(error, side*margin < 0.0_wp, "margin beside the limit "//trim(names(limit)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_rigid

   subroutine test_joint(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(limits_t) :: search
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Smallest force in the joint just below and just above [N]
      real(wp) :: forces(2)
      integer :: i

      the_case = thesis_case()
      call set_point(the_case, 100.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      the_case%numerics%tolerance = 1.0e-3_wp
      call start_limits(search, the_case, 0.5_wp, 1500.0_wp*minute, 500.0_wp*minute, failure)
      if (has_failed(failure, error)) return
      do while (search%is_open)
         call try_speed(search)
         call check(error, search%done <= search%total, "more speeds than there are")
         if (allocated(error)) return
      end do
      call check(error, search%failure, "")
      if (allocated(error)) return
      call check(error, search%above(joint_limit) - search%below(joint_limit) <= minute, "width")
      if (allocated(error)) return
      ! Not reached, each to the end of the scan; and no adjuster
      call check(error, all(search%above([contact_limit, seating_limit, adjuster_limit]) > search%highest), "limits out of reach")
      if (allocated(error)) return
      call check_close(error, minval(search%below([contact_limit, seating_limit])), search%highest, 1.0e-12_wp, "end of the scan")
      if (allocated(error)) return
      do i = 1, 2
         call set_point(the_case, merge(search%below(joint_limit), search%above(joint_limit), i == 1), 0.01_wp)
         call run_case(the_case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "joint_force_min", forces(i), failure)
         if (has_failed(failure, error)) return
      end do
      call check(error, forces(1) >= 0.0_wp .and. forces(2) < 0.0_wp, "force in the joint beside the limit")
   end subroutine test_joint

   subroutine test_failure(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(limits_t) :: search
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call set_point(the_case, 100.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      the_case%numerics%method = "euler"
      call start_limits(search, the_case, 0.5_wp, 1500.0_wp*minute, 500.0_wp*minute, failure)
      if (has_failed(failure, error)) return
      call try_speed(search)
      call check(error, .not. search%is_open .and. search%done == 1, "the scan goes on")
      if (allocated(error)) return
      call check(error, index(search%failure, "at 500 rev/min: ") == 1 .and. index(search%failure, "controls no error") > 0, &
         & "words: "//search%failure)
   end subroutine test_failure

   !> At 4500 rev/min the train does not repeat itself, and its valve meets the seat at several metres a second.
   subroutine test_scatter(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(limits_t) :: search
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call set_point(the_case, 100.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      the_case%numerics%tolerance = 1.0e-3_wp
      call start_limits(search, the_case, 0.5_wp, 4500.0_wp*minute, 200.0_wp*minute, failure)
      if (has_failed(failure, error)) return
      ! As if it had been tried up to 4400 rev/min, with contact regained far below and seating half a step below
      search%below = 4400.0_wp*minute
      search%above([contact_limit, seating_limit]) = 3900.0_wp*minute
      search%below([contact_limit, seating_limit]) = 3900.0_wp*minute
      search%period([contact_limit, seating_limit]) = 0
      search%regained(contact_limit) = 4000.0_wp*minute
      search%regained(seating_limit) = 4400.0_wp*minute
      call try_speed(search)
      call check(error, search%failure, "")
      if (allocated(error)) return
      call check(error, search%regained(seating_limit) > search%highest, "regained within a step of speeds beyond the limit")
      if (allocated(error)) return
      call check_close(error, search%regained(contact_limit), 4000.0_wp*minute, 1.0e-12_wp, "regained for more than a step")
   end subroutine test_scatter

end module test_limit_speeds
