!> A follower driven from outside, angle by angle, against the periodic cycle of the same case.
module test_simulation
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, two_pi, degree, error_t, case_t, numerics_t, result_t, simulation_t, outcome_t, run_case, &
      & start_simulation, advance, get_series, get_summary, halt, inputs_t
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case, add_gas_force
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_simulation, tight_case

contains

   subroutine collect_simulation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("repeated turns at constant speed tend to the periodic cycle", test_periodic), &
         new_unittest("in steps of a degree, which have rules of their own, the same, with gas force", test_short_steps), &
         new_unittest("on nearly solid oil a turn of steps has the mean torque of the cycle", test_solid_oil), &
         new_unittest("results do not depend on the number of the host's steps", test_steps), &
         new_unittest("speed and temperature may change during a turn", test_changes), &
         new_unittest("after a change of speed and temperature the state tends to the new periodic cycle", test_new_point), &
         new_unittest("two followers side by side give the bits of each alone", test_two), &
         new_unittest("the estimated error of a step does not grow as steps get shorter", test_short_estimate), &
         new_unittest("a sticking roller has the mean friction of its cycle, with default numerics", test_sticking), &
         new_unittest("a roller at rest that its bearing nearly holds is started alike by two methods", test_start) &
         ]
   end subroutine collect_simulation

   !> Case with a tolerance far below those of the tests
   function tight_case() result(the_case)
      type(case_t) :: the_case

      the_case = thesis_case()
      the_case%numerics%method = "rodas5p"
      the_case%numerics%tolerance = 1.0e-8_wp
   end function tight_case

   !> Drive a follower over a turn in equal steps; mean torques of the turn.
   subroutine drive(simulation, the_case, from, steps, torques, outcome, failure)
      type(simulation_t), intent(inout) :: simulation
      type(case_t), intent(in) :: the_case
      !> Cam angle at the start [rad]
      real(wp), intent(in) :: from
      !> Steps of the turn
      integer, intent(in) :: steps
      !> Mean torque to drive and for friction [N m]
      real(wp), intent(out) :: torques(2)
      type(outcome_t), intent(out) :: outcome
      type(error_t), allocatable, intent(out) :: failure
      integer :: i

      torques = 0.0_wp
      do i = 1, steps
         call advance(simulation, from + 2.0_wp*pi*i/steps, the_case%operating_point%speed, &
            & the_case%operating_point%oil_temperature, outcome, failure)
         if (allocated(failure)) return
         torques = torques + [outcome%mean_torque_drive, outcome%mean_torque_friction]/steps
      end do
   end subroutine drive

   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(error_t), allocatable :: failure

      the_case = tight_case()
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      call compare_with_cycle(simulation, the_case, error)
   end subroutine test_periodic

   subroutine test_short_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(error_t), allocatable :: failure

      the_case = tight_case()
      the_case%numerics%method = "hermite"
      call add_gas_force(the_case)
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      call compare_with_cycle(simulation, the_case, error, 360)
   end subroutine test_short_steps

   !> Far below the error of an integration, and below the spin's last digit, the sliding speed decides about traction.
   subroutine test_solid_oil(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(*) = [character(len=15) :: "solid_oil", "solid_oil_stick"]
      real(wp), parameter :: accuracy = 1.0e-4_wp
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(result_t) :: result
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Mean friction torque of the cycle, mean torques of a turn [N m]
      real(wp) :: mean, torques(2)
      integer :: i, turn

      do i = 1, size(decks)
         call get_deck_case("test/data/"//trim(decks(i))//"/deck.nml", the_case, failure)
         the_case%numerics = numerics_t(accuracy=accuracy)
         if (.not. allocated(failure)) call run_case(the_case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "mean_torque_friction", mean, failure)
         if (.not. allocated(failure)) call start_simulation(simulation, the_case, 0.0_wp, failure)
         do turn = 1, 2
            if (.not. allocated(failure)) call drive(simulation, the_case, 2.0_wp*pi*(turn - 1), 360, torques, outcome, failure)
         end do
         if (has_failed(failure, error)) return
         call check(error, torques(2), mean, thr=accuracy*mean, message=trim(decks(i)))
         if (allocated(error)) return
      end do
   end subroutine test_solid_oil

   !> Two turns from an angle of zero at the operating point of a case, against the periodic cycle of the case.
   subroutine compare_with_cycle(simulation, the_case, error, steps)
      type(simulation_t), intent(inout) :: simulation
      type(case_t), intent(in) :: the_case
      type(error_type), allocatable, intent(out) :: error
      !> Steps of a turn, 18 without it
      integer, intent(in), optional :: steps
      type(result_t) :: result
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Sliding speeds of the cycle [m/s], friction torques of the cycle, mean torques of the cycle and of a turn [N m]
      real(wp), allocatable :: sliding(:), friction(:)
      real(wp) :: mean(2), torques(2)
      integer :: turn, number

      number = 18
      if (present(steps)) number = steps
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_series(result, "sliding_speed", sliding, failure)
      if (.not. allocated(failure)) call get_series(result, "torque_friction", friction, failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_drive", mean(1), failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_friction", mean(2), failure)
      do turn = 1, 2
         if (.not. allocated(failure)) call drive(simulation, the_case, 2.0_wp*pi*(turn - 1), number, torques, outcome, failure)
      end do
      if (has_failed(failure, error)) return
      ! both integrations hold a tolerance of 1e-8 per step; some hundred steps, and decay between them
      call check(error, abs(outcome%state%contact%sliding_speed - sliding(1)) < 1.0e-6_wp*maxval(abs(sliding)), &
         "sliding speed at the end of a turn")
      if (allocated(error)) return
      call check(error, abs(outcome%torque_friction - friction(1)) < 1.0e-6_wp*maxval(friction), "friction at the end of a turn")
      if (allocated(error)) return
      call check(error, all(abs(torques - mean) < 1.0e-6_wp*mean), "mean torques of a turn")
   end subroutine compare_with_cycle

   !> Started cold and slow, driven warm and faster: nothing is left of the start but the roller's spin, which is forgotten.
   subroutine test_new_point(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(error_t), allocatable :: failure
      ! Speed [rad/s] and temperature [K] of the two points
      real(wp), parameter :: speeds(2) = [30.0_wp, 70.0_wp], temperatures(2) = [315.0_wp, 360.0_wp]
      integer :: i

      the_case = tight_case()
      the_case%lubricant%temperature_law = "vogel"
      the_case%lubricant%temperature_points = [313.15_wp, 343.15_wp, 373.15_wp]
      the_case%lubricant%viscosity_points = [0.08_wp, 0.025_wp, 0.011_wp]
      do i = 1, 2
         the_case%operating_point%speed = speeds(1)
         the_case%operating_point%oil_temperature = temperatures(1)
         call start_simulation(simulation, the_case, 0.0_wp, failure)
         if (has_failed(failure, error)) return
         ! the temperature alone, then both
         the_case%operating_point%oil_temperature = temperatures(2)
         if (i == 2) the_case%operating_point%speed = speeds(2)
         call compare_with_cycle(simulation, the_case, error)
         if (allocated(error)) return
      end do
   end subroutine test_new_point

   subroutine test_steps(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      integer, parameter :: steps(3) = [1, 7, 90]
      ! Mean torques of the turn [N m]
      real(wp) :: torques(2, 3)
      integer :: i

      the_case = tight_case()
      do i = 1, 3
         call start_simulation(simulation, the_case, 1.0_wp, failure)
         if (.not. allocated(failure)) call drive(simulation, the_case, 1.0_wp, steps(i), torques(:, i), outcome, failure)
         if (has_failed(failure, error)) return
      end do
      call check(error, all(maxval(torques, dim=2) - minval(torques, dim=2) < 1.0e-6_wp*torques(:, 1)))
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
      if (has_failed(failure, error)) return
      spin = outcome%state%contact%roller_spin
      ! over a vanishing step the roller keeps its spin, whatever the speed becomes
      call advance(simulation, 0.1_wp + 1.0e-9_wp, 60.0_wp, 330.0_wp, outcome, failure)
      call check(error, abs(outcome%state%contact%roller_spin/spin - 1.0_wp) < 1.0e-3_wp, "spin jumps with the speed")
      if (allocated(error)) return
      do i = 1, 20
         call advance(simulation, 0.1_wp + 0.4_wp*i, 30.0_wp + 2.0_wp*i, 330.0_wp + 2.0_wp*i, outcome, failure)
         if (has_failed(failure, error)) return
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

   !> Both friction and torque at the end of a step depend on whether the roller is taken as at rest.
   subroutine test_sticking(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Boundary friction and load of the cycle [N]; its difference over the load [-]
      real(wp), allocatable :: mobilised(:), load(:)
      real(wp) :: difference
      integer :: i, at_rest

      the_case = thesis_case()
      the_case%asperity%mobilisation = "stick_slip"
      the_case%numerics = numerics_t(output_step=5.0_wp*degree)
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_series(result, "friction_boundary_mobilised", mobilised, failure)
      if (.not. allocated(failure)) call get_series(result, "contact_load", load, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, the_case, 0.0_wp, failure)
      at_rest = 0
      do i = 1, 144
         if (.not. allocated(failure)) call advance(simulation, 5.0_wp*i*degree, the_case%operating_point%speed, &
            & the_case%operating_point%oil_temperature, outcome, failure)
         if (has_failed(failure, error)) return
         if (i <= 72) cycle
         if (.not. abs(outcome%state%contact%sliding_speed) > 0.0_wp) at_rest = at_rest + 1
         ! at rest the angle alone decides, and while sliding the friction is all there is; 100 default accuracies
         difference = (outcome%state%contact%boundary_mobilised - mobilised(modulo(i, 72) + 1))/load(modulo(i, 72) + 1)
         call check(error, abs(difference) < 1.0e-2_wp, "boundary friction at the end of a step")
         if (allocated(error)) return
      end do
      call check(error, at_rest > 36, "the roller should stick for half of the turn or more")
   end subroutine test_sticking

   !> Steps of a thousandth of a degree and of a hundredth of that from the same places: hardly anything decays in them, and the
   !> errors of the spin at both ends are nearly the same one. Two that have nothing in common would make 100 times the estimate of
   !> the shorter step; what earlier steps have left counts up to three times in it.
   subroutine test_short_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: places = 24
      real(wp), parameter :: steps(2) = [1.0e-3_wp, 1.0e-5_wp]*degree
      type(simulation_t) :: simulation, trial
      type(outcome_t) :: outcome, outcomes(2)
      type(case_t) :: the_case
      type(error_t), allocatable :: failure
      real(wp) :: angle ! [rad]
      character(len=80) :: words
      integer :: i, k

      the_case = thesis_case()
      the_case%numerics = numerics_t(accuracy=1.0e-4_wp)
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      associate (point => the_case%operating_point)
         do i = 1, places
            angle = i*two_pi/places
            if (.not. allocated(failure)) call advance(simulation, angle, point%speed, point%oil_temperature, outcome, failure)
            do k = 1, size(steps)
               trial = simulation
               if (.not. allocated(failure)) call advance(trial, angle + steps(k), point%speed, point%oil_temperature, &
                  & outcomes(k), failure)
            end do
            if (has_failed(failure, error)) return
            write (words, "(a, f6.1, 2es11.2)") "angle, estimates: ", angle/degree, outcomes%estimated_error
            call check(error, outcomes(2)%estimated_error < 4.0_wp*outcomes(1)%estimated_error, words)
            if (allocated(error)) return
         end do
      end associate
   end subroutine test_short_estimate

   !> Steps from rest at angles all round, with speed and temperature that change within: the bearing's torque, which reverses
   !> within a hundredth of the cam's speed, changes with that speed. A method that needs no derivative over the angle agrees
   !> with the usual one.
   subroutine test_start(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: methods(2) = [character(len=16) :: "hermite", "radau5"]
      type(case_t) :: case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcomes(2)
      type(error_t), allocatable :: failure
      integer :: i, k

      do i = 0, 23
         do k = 1, 2
            call get_deck_case("decks/plain_pin.nml", case, failure, "numerics.method="//trim(methods(k)))
            if (.not. allocated(failure)) call start_simulation(simulation, case, i*15.0_wp*degree, failure)
            call halt(simulation)
            if (.not. allocated(failure)) call advance(simulation, (i*15.0_wp + 1.0_wp)*degree, inputs_t(speed=0.3_wp, &
               & oil_temperature=333.0_wp), inputs_t(speed=3.0_wp, oil_temperature=333.05_wp), outcomes(k), failure)
            if (has_failed(failure, error)) return
         end do
         call check(error, abs(outcomes(1)%mean_torque_drive - outcomes(2)%mean_torque_drive) <= sum(outcomes%estimated_error), &
            & "mean torque of the drive")
         if (allocated(error)) return
      end do
   end subroutine test_start

end module test_simulation
