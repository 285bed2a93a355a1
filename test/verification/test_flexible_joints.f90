!> Friction at valve tip, stem and pivot of a flexible train: the rigid train's as the stiffness grows, the pivot's equation.
module test_flexible_joints
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_flexible_pivot, only : ball_t, hold_ball
   use camroller_flexible_turn, only : find_fastest
   use camroller_model, only : model_t, new_model
   use camroller_pivot_friction, only : finger_pivot_t, new_pivot_part, pivot_part_t
   use camroller_result, only : get_summary, result_t
   use camroller_run, only : run_case
   use camroller_sliding_friction, only : sliding_law_names, sliding_t
   use closeness, only : check_scaled, expect_error, has_failed
   use flexible_cases, only : add_dynamics, add_joints, stiff_case
   use reference_cases, only : thesis_case
   implicit none
   private

   public :: collect_flexible_joints

contains

   subroutine collect_flexible_joints(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("losses of a very stiff train's joints are those of a rigid train", test_rigid_losses), &
         new_unittest("moment and force of the pivot's ball agree, and slopes with difference quotients", test_ball), &
         new_unittest("friction that falls by Stribeck's curve beside a turning of the valve has its peaks among the extremes", &
            & test_spikes), &
         new_unittest("a finger that jams on its ball is refused", test_jam), &
         new_unittest("what takes the steps of a train is told, and joints that reverse at once", test_fastest) &
         ]
   end subroutine collect_flexible_joints

   !> Stiffness times 4 brings the difference of each joint's loss to a quarter: from -4 to -8e-3 to -2 to -4e-4 in two steps, where
   !> both runs may err by the accuracy asked for.
   subroutine test_rigid_losses(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=10) :: "tip", "seal", "guide_side", "pivot"]
      real(wp), parameter :: tolerance = 1.0e-4_wp
      type(case_t) :: flexible, rigid
      ! Mean torque of the losses [N m], their differences over the rigid train's [-], stiffness over the usual [-]
      real(wp) :: torques(size(names), 2), differences(size(names), 3), factor
      integer :: choice, i, k

      do choice = 3, 4
         do i = 1, 3
            factor = 4.0_wp**(i - 1)
            flexible = stiff_case(factor, 0)
            call add_joints(flexible, choice)
            flexible%numerics%tolerance = tolerance/factor
            rigid = flexible
            deallocate (rigid%dynamics)
            ! Its valve leaves the seat within 0.4 um: the other's within 8.4 um over the factor
            rigid%spring%seat_stiffness = 1.0e9_wp
            rigid%numerics%tolerance = tolerance
            call find_losses(flexible, torques(:, 1), error)
            if (.not. allocated(error)) call find_losses(rigid, torques(:, 2), error)
            if (allocated(error)) return
            differences(:, i) = torques(:, 1)/torques(:, 2) - 1.0_wp
         end do
         do k = 1, size(names)
            if (choice == 3 .and. k < size(names)) cycle
            call check_scaled(error, differences(k, 2), 0.25_wp*differences(k, 1), 1.0_wp, 2.0_wp*tolerance, &
               & trim(names(k))//" at four times the stiffness")
            if (allocated(error)) return
            call check_scaled(error, differences(k, 3), 0.25_wp*differences(k, 2), 1.0_wp, 2.0_wp*tolerance, &
               & trim(names(k))//" at sixteen times the stiffness")
            if (allocated(error)) return
         end do
      end do

   contains

      !> Mean torques of the joints' losses; one where the case has no such joint.
      subroutine find_losses(the_case, losses, error)
         type(case_t), intent(in) :: the_case
         real(wp), intent(out) :: losses(:) ! [N m]
         type(error_type), allocatable, intent(out) :: error
         type(result_t) :: result
         type(error_t), allocatable :: failure
         integer :: joint

         call run_case(the_case, result, failure)
         losses = 1.0_wp
         do joint = 1, size(names)
            if (choice == 3 .and. joint < size(names)) cycle
            if (.not. allocated(failure)) call get_summary(result, "mean_torque_"//trim(names(joint)), losses(joint), failure)
         end do
         if (allocated(failure)) call test_failed(error, failure%message)
      end subroutine find_losses

   end subroutine test_rigid_losses

   !> A ball whose force changes much by its friction.
   subroutine test_ball(error)
      type(error_type), allocatable, intent(out) :: error
      ! Step of the differences, relative [-]; difference allowed: rounding over h, and at rest h, where Stribeck's law bends [-]
      real(wp), parameter :: h = 1.0e-5_wp, allowed = 1.0e-7_wp
      ! Rates of the finger, opening and closing, in the reversal too [rad/s]
      real(wp), parameter :: rates(*) = [-20.0_wp, -0.1_wp, 0.0_wp, 0.05_wp, 30.0_wp]
      type(pivot_part_t) :: pivot
      type(ball_t) :: ball, low, high, again
      type(error_t), allocatable :: failure
      integer :: law, i

      do law = 1, size(sliding_law_names)
         call new_pivot_part(pivot, finger_pivot_t(8.0e-3_wp, sliding_t(sliding_law_names(law), 0.3_wp, 0.2_wp, 0.01_wp, 0.02_wp, &
            & 300.0_wp, 1.0e-3_wp)), failure)
         pivot%law%duty = pivot%law%reference*0.015_wp
         do i = 1, size(rates)
            ball = ball_t(free=(300.0_wp, -120.0_wp), by_moment=(-90.0_wp, 200.0_wp))
            call hold_ball(pivot, rates(i), ball)
            ! The force that is there makes the friction that is there
            again = ball_t(free=ball%force)
            call hold_ball(pivot, rates(i), again)
            call check_scaled(error, again%moment, ball%moment, pivot%law%coefficient*pivot%ball_radius*abs(ball%force), &
               & 1.0e-14_wp, "moment of the force")
            if (allocated(error)) return
            call check(error, ball%moment*rates(i) >= 0.0_wp .and. (abs(ball%moment) > 0.0_wp .neqv. i == 3), "against the rate")
            if (allocated(error)) return
            low = ball_t(free=ball%force*(1.0_wp - h))
            call hold_ball(pivot, rates(i), low)
            high = ball_t(free=ball%force*(1.0_wp + h))
            call hold_ball(pivot, rates(i), high)
            call check_scaled(error, ball%by_force, (high%moment - low%moment)/(2.0_wp*h*abs(ball%force)), &
               & abs(ball%by_force) + 1.0e-3_wp*pivot%ball_radius, allowed, "over the force")
            if (allocated(error)) return
            low = ball_t(free=ball%force)
            call hold_ball(pivot, rates(i) - h*0.1_wp, low)
            high = ball_t(free=ball%force)
            call hold_ball(pivot, rates(i) + h*0.1_wp, high)
            call check_scaled(error, ball%by_rate, (high%moment - low%moment)/(0.2_wp*h), abs(ball%by_rate) + 1.0e-3_wp, allowed, &
               & "over the rate")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_ball

   !> At full lift the valve turns, and within a hundred thousandth of a degree its guide's friction passes from one peak to the
   !> other.
   subroutine test_spikes(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Largest friction of the guide and force of each of its ends [N]
      real(wp) :: friction(2), forces(2)

      the_case = stiff_case(1.0_wp, 0)
      call add_joints(the_case, 2)
      ! Else the side force of the tip's friction turns round there as well
      deallocate (the_case%valve_tip)
      ! The force of the tip makes the moment about the stem, then, which is largest at full lift
      the_case%guide_side_load%stem_axis = 0.025_wp
      associate (sliding => the_case%guide_side_load%sliding)
         sliding = sliding_t("stribeck", sliding%friction_coefficient, 1.0e-6_wp, 0.0_wp, 0.01_wp, 200.0_wp, 1.0e-8_wp)
      end associate
      call run_case(the_case, result, failure)
      call get_summary(result, "max_friction_guide_side", friction(1), failure)
      if (.not. allocated(failure)) call get_summary(result, "min_friction_guide_side", friction(2), failure)
      if (.not. allocated(failure)) call get_summary(result, "max_guide_upper_force", forces(1), failure)
      if (.not. allocated(failure)) call get_summary(result, "max_guide_lower_force", forces(2), failure)
      if (has_failed(failure, error)) return
      ! Both forces are largest there. The reversal leaves 0.99 of the peak, the curve 0.97
      call check(error, minval(abs(friction)) > 0.8_wp*the_case%guide_side_load%sliding%friction_coefficient*sum(forces), &
         & "peaks are not seen")
   end subroutine test_spikes

   subroutine test_jam(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 2
         the_case = thesis_case()
         call add_dynamics(the_case, 0, i == 2)
         call add_joints(the_case, 3)
         the_case%finger_pivot%sliding%friction_coefficient = 0.9_wp
         the_case%finger_pivot%ball_radius = 0.08_wp
         call new_model(model, the_case, 1, failure)
         call expect_error(error, failure, kind_deck, "jams on its ball")
         if (allocated(error)) return
      end do
   end subroutine test_jam

   subroutine test_fastest(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: keys(0:4) = [character(len=40) :: "dynamics.seat_stiffness_N_m", &
         & "valve_tip.reversal_speed_m_s", "stem_seal.reversal_speed_m_s", "guide_side_load.reversal_speed_m_s", &
         & "finger_pivot.reversal_speed_m_s"]
      type(case_t) :: the_case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text
      integer :: i

      do i = 0, 4
         the_case = thesis_case()
         call add_dynamics(the_case, 0, .false.)
         the_case%dynamics%seat_stiffness = 1.0e3_wp*the_case%dynamics%seat_stiffness
         if (i > 0) call add_joints(the_case, 4)
         if (i == 1) the_case%valve_tip%sliding%reversal_speed = 1.0e-9_wp
         if (i == 2) the_case%stem_seal%reversal_speed = 1.0e-9_wp
         if (i == 3) the_case%guide_side_load%sliding%reversal_speed = 1.0e-9_wp
         if (i == 4) the_case%finger_pivot%sliding%reversal_speed = 1.0e-9_wp
         call new_model(model, the_case, 1, failure)
         if (has_failed(failure, error)) return
         call find_fastest(model, text)
         call check(error, index(text, trim(keys(i))) > 0, text)
         if (allocated(error)) return
      end do
   end subroutine test_fastest

end module test_flexible_joints
