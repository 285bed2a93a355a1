!> A follower driven from outside, angle by angle, against the periodic cycle of the same case.
module test_simulation
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, pi, error_t, case_t, result_t, simulation_t, outcome_t, run_case, start_simulation, advance, &
      & get_series, get_summary, kind_usage
   use reference_cases, only : thesis_case
   implicit none
   private

   public :: collect_simulation

contains

   subroutine collect_simulation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("turns at constant speed tend to the periodic cycle", test_periodic), &
         new_unittest("the number of steps of the host does not matter", test_steps), &
         new_unittest("speed and temperature may change on the way", test_changes), &
         new_unittest("two followers side by side do not touch each other", test_two), &
         new_unittest("a step back is refused and changes nothing", test_refusal) &
         ]
   end subroutine collect_simulation

   !> Case with a tolerance far below those of the tests
   function tight_case() result(the_case)
      type(case_t) :: the_case

      the_case = thesis_case()
      the_case%numerics%method = "rodas5p"
      the_case%numerics%tolerance = 1.0e-8_wp
   end function tight_case

   !> Drive a follower over a turn in equal steps; mean torque of the turn.
   subroutine drive(simulation, the_case, from, steps, torque, outcome, failure)
      type(simulation_t), intent(inout) :: simulation
      type(case_t), intent(in) :: the_case
      !> Cam angle at the start [rad]
      real(wp), intent(in) :: from
      !> Steps of the turn
      integer, intent(in) :: steps
      !> Mean drive torque [N m]
      real(wp), intent(out) :: torque
      type(outcome_t), intent(out) :: outcome
      type(error_t), allocatable, intent(out) :: failure
      integer :: i

      torque = 0.0_wp
      do i = 1, steps
         call advance(simulation, from + 2.0_wp*pi*i/steps, the_case%operating_point%speed, &
            & the_case%operating_point%oil_temperature, outcome, failure)
         if (allocated(failure)) return
         torque = torque + outcome%mean_torque_drive/steps
      end do
   end subroutine drive

   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Sliding speeds of the cycle [m/s]; mean torque of cycle and of a turn [N m]
      real(wp), allocatable :: sliding(:)
      real(wp) :: mean, torque
      integer :: turn

      the_case = tight_case()
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_series(result, "sliding_speed", sliding, failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_drive", mean, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, the_case, 0.0_wp, failure)
      do turn = 1, 2
         if (.not. allocated(failure)) call drive(simulation, the_case, 2.0_wp*pi*(turn - 1), 18, torque, outcome, failure)
      end do
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      ! both integrations hold a tolerance of 1e-8 per step; some hundred steps, and decay between them
      call check(error, abs(outcome%state%contact%sliding_speed - sliding(1)) < 1.0e-6_wp*maxval(abs(sliding)), &
         "sliding speed at the end of a turn")
      if (allocated(error)) return
      call check(error, abs(torque - mean) < 1.0e-6_wp*mean, "mean torque of a turn")
   end subroutine test_periodic

   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      integer, parameter :: steps(3) = [1, 7, 90]
      ! Mean torques of the turn [N m]
      real(wp) :: torques(3)
      integer :: i

      the_case = tight_case()
      do i = 1, 3
         call start_simulation(simulation, the_case, 1.0_wp, failure)
         if (.not. allocated(failure)) call drive(simulation, the_case, 1.0_wp, steps(i), torques(i), outcome, failure)
         if (allocated(failure)) then
            call test_failed(error, failure%message)
            return
         end if
      end do
      call check(error, maxval(torques) - minval(torques) < 1.0e-6_wp*torques(1))
   end subroutine test_steps

   subroutine test_changes(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Spin before a jump of the speed [rad/s]
      real(wp) :: spin
      integer :: i

      the_case = tight_case()
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 0.1_wp, 30.0_wp, 330.0_wp, outcome, failure)
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      spin = outcome%state%contact%roller_spin
      ! over a vanishing step the roller keeps its spin, whatever the speed becomes
      call advance(simulation, 0.1_wp + 1.0e-9_wp, 60.0_wp, 330.0_wp, outcome, failure)
      call check(error, abs(outcome%state%contact%roller_spin/spin - 1.0_wp) < 1.0e-3_wp, "spin jumps with the speed")
      if (allocated(error)) return
      do i = 1, 20
         call advance(simulation, 0.1_wp + 0.4_wp*i, 30.0_wp + 2.0_wp*i, 330.0_wp + 2.0_wp*i, outcome, failure)
         if (allocated(failure)) then
            call test_failed(error, failure%message)
            return
         end if
         call check(error, outcome%mean_torque_friction > 0.0_wp, "friction must cost torque")
         if (allocated(error)) return
      end do
   end subroutine test_changes

   subroutine test_two(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, other_case
      type(simulation_t) :: alone, first, second
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Torque alone and beside another follower [N m]
      real(wp) :: torque_alone, torque_beside
      integer :: i

      the_case = tight_case()
      other_case = the_case
      other_case%operating_point%speed = 2.0_wp*the_case%operating_point%speed
      call start_simulation(alone, the_case, 0.0_wp, failure)
      call start_simulation(first, the_case, 0.0_wp, failure)
      call start_simulation(second, other_case, 0.0_wp, failure)
      do i = 1, 12
         call advance(alone, 0.5_wp*i, 31.0_wp, 330.0_wp, outcome, failure)
         torque_alone = outcome%torque_drive
         call advance(second, 0.7_wp*i, 77.0_wp, 370.0_wp, outcome, failure)
         call advance(first, 0.5_wp*i, 31.0_wp, 330.0_wp, outcome, failure)
         torque_beside = outcome%torque_drive
         call check(error, .not. abs(torque_alone - torque_beside) > 0.0_wp, "not the same to the last bit")
         if (allocated(error)) return
      end do
   end subroutine test_two

   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure

      call start_simulation(simulation, tight_case(), 1.0_wp, failure)
      call advance(simulation, 1.0_wp, 31.0_wp, 330.0_wp, outcome, failure)
      call check(error, allocated(failure), "a step of no length is accepted")
      if (allocated(error)) return
      call check(error, failure%kind, kind_usage)
      if (allocated(error)) return
      call advance(simulation, 1.5_wp, -31.0_wp, 330.0_wp, outcome, failure)
      call check(error, allocated(failure), "a negative speed is accepted")
      if (allocated(error)) return
      call advance(simulation, 1.1_wp, 31.0_wp, 330.0_wp, outcome, failure)
      call check(error, .not. allocated(failure), "the follower is of no use after a refusal")
   end subroutine test_refusal

end module test_simulation
