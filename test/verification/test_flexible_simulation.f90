!> A follower with a flexible train driven from outside.
module test_flexible_simulation
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, two_pi, degree, error_t, case_t, numerics_t, simulation_t, outcome_t, inputs_t, result_t, &
      & run_case, get_summary, start_simulation, advance
   use camroller_torque_list, only : of_damping, of_residual
   use camroller_number_text, only : integer_text, number_text
   use closeness, only : check_close, check_scaled, has_failed
   use deck_cases, only : get_deck_case
   use driven_trains, only : train, steady, inputs_at, engine_case
   use flexible_cases, only : add_joints, choose_roller_bearing
   implicit none
   private

   public :: collect_flexible_simulation

   !> What turns in steps of the same size come to
   type :: turn_t
      !> Mean torques to drive, for friction and in dampers [N m]
      real(wp) :: means(3) = 0.0_wp
      !> Smallest and largest load [N]
      real(wp) :: load(2) = [huge(1.0_wp), -huge(1.0_wp)]
      !> Sum of the estimated errors of the mean torque, over the number of steps [N m]
      real(wp) :: estimate = 0.0_wp
      !> Sliding speed [m/s] and lift of the valve [m] at the end
      real(wp) :: sliding_speed = 0.0_wp, lift = 0.0_wp
   end type turn_t

contains

   subroutine collect_flexible_simulation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("steady inputs lead to the periodic results of a run: means, smallest and largest load", test_periodic), &
         new_unittest("with an adjuster, friction of joints and a pin too, at the supply pressure of the host", test_supply), &
         new_unittest("with inputs that go round with the cam, results converge with second order in the host's step", &
            & test_order), &
         new_unittest("a step longer than half a turn gives what its halves give", test_long_step), &
         new_unittest("over a run-up, drive and gallery bring what is lost and stored, at every angle and as a whole", &
            & test_energy), &
         new_unittest("the estimated error of a step is above its true error, and below the torque", test_estimate), &
         new_unittest("so it is with friction of joints in cold oil, but for few steps", test_joint_estimate) &
         ]
   end subroutine collect_flexible_simulation

   !> One turn in equal steps with the same inputs.
   subroutine turn_steadily(simulation, steps, first, inputs, turn, failure)
      type(simulation_t), intent(inout) :: simulation
      integer, intent(in) :: steps
      !> Cam angle at the start [rad]
      real(wp), intent(in) :: first
      type(inputs_t), intent(in) :: inputs
      type(turn_t), intent(out) :: turn
      type(error_t), allocatable, intent(out) :: failure
      type(outcome_t) :: outcome
      integer :: i

      do i = 1, steps
         call advance(simulation, first + two_pi*i/steps, inputs, inputs, outcome, failure)
         if (allocated(failure)) return
         call add(turn, outcome, steps)
      end do
   end subroutine turn_steadily

   !> Add a step to a turn.
   subroutine add(turn, outcome, steps)
      type(turn_t), intent(inout) :: turn
      type(outcome_t), intent(in) :: outcome
      integer, intent(in) :: steps

      turn%means = turn%means + [outcome%mean_torque_drive, outcome%mean_torque_friction, outcome%mean_torques(of_damping)]/steps
      turn%load = [min(turn%load(1), outcome%extremes%contact_load(1)), max(turn%load(2), outcome%extremes%contact_load(2))]
      turn%estimate = turn%estimate + outcome%estimated_error/steps
      turn%sliding_speed = outcome%state%contact%sliding_speed
      turn%lift = outcome%state%position%lift
   end subroutine add

   !> Compare turns that have become periodic with a run.
   subroutine compare_with_run(the_case, driven, inputs, turns, error)
      !> The case that is run, the one that is driven
      type(case_t), intent(in) :: the_case, driven
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: turns
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=24) :: "mean_torque_drive", "mean_torque_friction", &
         & "mean_torque_damping"]
      type(simulation_t) :: simulation
      type(result_t) :: result
      type(turn_t) :: turn
      type(error_t), allocatable :: failure
      !> Numbers of the run [unit of each]
      real(wp) :: value
      integer :: i

      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, driven, 0.0_wp, failure)
      do i = 1, turns
         if (.not. allocated(failure)) call turn_steadily(simulation, 180, (i - 1)*two_pi, inputs, turn, failure)
      end do
      if (has_failed(failure, error)) return
      do i = 1, size(names)
         call get_summary(result, trim(names(i)), value, failure)
         if (has_failed(failure, error)) return
         ! as in `run`, whose periodic state is as near as ten tolerances
         call check_scaled(error, turn%means(i), value, turn%means(2), the_case%numerics%accuracy, trim(names(i)))
         if (allocated(error)) return
      end do
      call get_summary(result, "dynamic_load_max", value, failure)
      call check_close(error, turn%load(2), value, the_case%numerics%accuracy, "largest load")
   end subroutine compare_with_run

   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case

      the_case = train(900.0_wp, 2, .false., 1.0e-3_wp)
      call compare_with_run(the_case, the_case, steady(the_case), 6, error)
      if (allocated(error)) return
      the_case = train(2000.0_wp, 0, .false., 1.0e-3_wp)
      call compare_with_run(the_case, the_case, steady(the_case), 3, error)
   end subroutine test_periodic

   !> A pressure from the host is that of the case, and at another one the case is another.
   subroutine test_supply(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, other
      type(inputs_t) :: inputs

      the_case = train(600.0_wp, 0, .true., 1.0e-3_wp)
      the_case%lash_adjuster%spring_force = 10.0_wp
      call choose_roller_bearing(the_case, 3)
      call add_joints(the_case, 4)
      other = the_case
      other%lash_adjuster%supply_pressure = 0.12e6_wp
      inputs = steady(the_case)
      inputs%has_supply = .true.
      inputs%supply_pressure = the_case%lash_adjuster%supply_pressure
      call compare_with_run(the_case, other, inputs, 6, error)
   end subroutine test_supply

   !> One turn in equal steps with those inputs.
   subroutine turn_engine(steps, tolerance, turn, failure)
      integer, intent(in) :: steps
      !> Tolerance [-]
      real(wp), intent(in) :: tolerance
      type(turn_t), intent(out) :: turn
      type(error_t), allocatable, intent(out) :: failure
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      !> Part of the turn, which ends on the nose [rad]
      real(wp), parameter :: span = 1.5_wp*pi
      integer :: i

      call start_simulation(simulation, engine_case(tolerance), 0.0_wp, failure)
      do i = 1, steps
         if (allocated(failure)) return
         call advance(simulation, span*i/steps, inputs_at(span*(i - 1)/steps), inputs_at(span*i/steps), outcome, failure)
         call add(turn, outcome, steps)
      end do
   end subroutine turn_engine

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: steps(*) = [68, 270, 1080, 4320]
      type(turn_t) :: turns(size(steps))
      type(error_t), allocatable :: failure
      !> Errors of three lengths of the step, sizes of what they are errors of
      real(wp) :: errors(5, 3), sizes(5)
      integer :: i

      do i = 1, size(steps)
         call turn_engine(steps(i), 1.0e-7_wp, turns(i), failure)
         if (has_failed(failure, error)) return
      end do
      do i = 1, 3
         errors(:, i) = abs([turns(i)%means - turns(4)%means, turns(i)%sliding_speed - turns(4)%sliding_speed, &
            & turns(i)%lift - turns(4)%lift])
      end do
      ! from four degrees to one and on to a quarter an error of second order falls to a sixteenth, as far as higher ones are small
      call check(error, all(errors(:, 2:) < errors(:, :2)/10.0_wp), "results are not of second order in the step")
      if (allocated(error)) return
      ! a straight line over one degree of a ripple with a period of 90 degrees is off by (4 degree)^2/8 of its size
      sizes = abs([turns(4)%means, turns(4)%sliding_speed, turns(4)%lift])
      ! the drive's mean, with work that is stored, may be any part of that of the friction
      sizes(1) = maxval(sizes(:2))
      call check(error, all(errors(:, 2) < 6.0e-4_wp*sizes), "errors at one degree are large")
   end subroutine test_order

   subroutine test_long_step(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: whole, halved
      type(outcome_t) :: once, halves(2)
      type(inputs_t) :: ends(3)
      type(error_t), allocatable :: failure
      !> Cam angles of the start, the middle and the end [rad]
      real(wp), parameter :: angles(3) = [1.0_wp, 3.0_wp, 5.0_wp]
      real(wp), parameter :: tolerance = 8.0_wp*epsilon(1.0_wp)
      integer :: k

      ends(1) = inputs_at(angles(1))
      ends(3) = inputs_at(angles(3))
      ends(2) = ends(1)
      ends(2)%speed = 0.5_wp*(ends(1)%speed + ends(3)%speed)
      ends(2)%oil_temperature = 0.5_wp*(ends(1)%oil_temperature + ends(3)%oil_temperature)
      ends(2)%gas_pressure = 0.5_wp*(ends(1)%gas_pressure + ends(3)%gas_pressure)
      ends(2)%supply_pressure = 0.5_wp*(ends(1)%supply_pressure + ends(3)%supply_pressure)
      call start_simulation(whole, engine_case(1.0e-4_wp), angles(1), failure)
      halved = whole
      if (.not. allocated(failure)) call advance(whole, angles(3), ends(1), ends(3), once, failure)
      do k = 1, 2
         if (.not. allocated(failure)) call advance(halved, angles(k + 1), ends(k), ends(k + 1), halves(k), failure)
      end do
      if (has_failed(failure, error)) return
      ! The same steps of the integration: states have the same bits, and means differ by the rounding of a sum of two
      call check_close(error, once%state%contact%roller_spin, halves(2)%state%contact%roller_spin, tolerance, "spin at the end")
      if (allocated(error)) return
      call check_close(error, once%mean_torque_friction, 0.5_wp*sum(halves%mean_torque_friction), tolerance, "mean friction")
      if (allocated(error)) return
      ! it is a difference of stored energies, which are ten times as large
      call check_close(error, once%mean_torque_drive, 0.5_wp*sum(halves%mean_torque_drive), 10.0_wp*tolerance, "mean torque")
      if (allocated(error)) return
      call check_close(error, once%extremes%contact_load(2), max(halves(1)%extremes%contact_load(2), &
         & halves(2)%extremes%contact_load(2)), tolerance, "largest load")
   end subroutine test_long_step

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      type(inputs_t) :: ends(2)
      type(case_t) :: the_case
      !> Energies: drive, loss, stored at the start and at the end, trapezoids of the drive [J]; torque before [N m]; residual [W]
      real(wp) :: drive, lost, stored(2), trapezoids, before, residual, largest
      integer, parameter :: steps = 2*720
      integer :: i

      the_case = train(600.0_wp, 2, .false., 1.0e-3_wp)
      call choose_roller_bearing(the_case, 1)
      call add_joints(the_case, 2)
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      drive = 0.0_wp
      lost = 0.0_wp
      residual = 0.0_wp
      largest = 0.0_wp
      trapezoids = 0.0_wp
      do i = 0, steps
         ends%oil_temperature = 368.15_wp
         ends%speed = pi/30.0_wp*(600.0_wp + 1000.0_wp*[i, i + 1]/steps)
         before = outcome%torque_drive
         if (.not. allocated(failure)) call advance(simulation, 2.0_wp*two_pi*(i + 1)/steps, ends(1), ends(2), outcome, failure)
         if (has_failed(failure, error)) return
         residual = max(residual, abs(outcome%torques(of_residual)))
         largest = max(largest, abs(outcome%torque_drive)*ends(2)%speed)
         if (i == 0) stored(1) = outcome%state%flexible%stored_energy
         if (i == 0) cycle
         drive = drive + outcome%mean_torque_drive*2.0_wp*two_pi/steps
         lost = lost + outcome%mean_torque_friction*2.0_wp*two_pi/steps
         trapezoids = trapezoids + 0.5_wp*(before + outcome%torque_drive)*2.0_wp*two_pi/steps
      end do
      stored(2) = outcome%state%flexible%stored_energy
      ! the balance of a state adds up some dozens of powers that are as large as that of the drive
      call check(error, residual < 1.0e3_wp*epsilon(1.0_wp)*largest, "the balance of a state is open")
      if (allocated(error)) return
      ! stored energies of 1440 steps, each to some roundings
      call check_scaled(error, drive - lost, stored(2) - stored(1), stored(2), 1.0e4_wp*epsilon(1.0_wp), &
         & "the balance of the run-up")
      if (allocated(error)) return
      ! torques at the ends of steps follow from forces and accelerations alone; between them the trapezoidal rule errs by the
      ! square of the step of half a degree
      call check_close(error, trapezoids, drive, 1.0e-3_wp, "work of the torque at the ends of steps")
   end subroutine test_energy

   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: rough, exact
      type(outcome_t) :: outcome, exact_outcome
      type(case_t) :: the_case
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      !> Cam angle [rad]; true and estimated errors, their sums [N m]
      real(wp) :: angle, true, sums(3), worst
      integer :: i, k
      real(wp), parameter :: accuracies(2) = [1.0e-2_wp, 1.0e-4_wp]

      do k = 1, 2
         call get_deck_case("decks/dynamics.nml", the_case, failure, "operating_point.speed_rpm=900")
         if (has_failed(failure, error)) return
         the_case%numerics = numerics_t(accuracy=accuracies(k))
         call start_simulation(rough, the_case, 0.0_wp, failure)
         the_case%numerics%tolerance = 1.0e-8_wp
         if (.not. allocated(failure)) call start_simulation(exact, the_case, 0.0_wp, failure)
         inputs = steady(the_case)
         sums = 0.0_wp
         worst = 0.0_wp
         do i = 1, 360
            angle = i*degree
            if (.not. allocated(failure)) call advance(rough, angle, inputs, inputs, outcome, failure)
            if (.not. allocated(failure)) call advance(exact, angle, inputs, inputs, exact_outcome, failure)
            if (has_failed(failure, error)) return
            true = abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive)
            sums = sums + [true, outcome%estimated_error, abs(exact_outcome%mean_torque_drive)]
            worst = max(worst, true/outcome%estimated_error)
         end do
         call check(error, worst <= 1.0_wp, "the error of a step is larger than estimated")
         if (allocated(error)) return
         ! an estimate that says nothing would be of the size of the torque
         call check(error, sums(2) < 0.1_wp*accuracies(k)*sums(3), "the estimate is of no use")
         if (allocated(error)) return
      end do
   end subroutine test_estimate

   !> Joints with friction in cold oil, slowly: behind full lift, where their friction reverses, the valve's speed errs by more than
   !> ten errors of a step. Few steps are above their estimate, by up to 4.3 times; six and one were.
   subroutine test_joint_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: rough, exact
      type(outcome_t) :: outcome, exact_outcome
      type(case_t) :: the_case
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      real(wp), parameter :: accuracies(2) = [1.0e-2_wp, 1.0e-3_wp]
      real(wp) :: ratio, worst ! true over estimated error [-]
      integer :: i, k, above

      do k = 1, 2
         call get_deck_case("decks/flexible_friction.nml", the_case, failure, "operating_point.speed_rpm=300")
         if (has_failed(failure, error)) return
         the_case%operating_point%oil_temperature = 298.15_wp
         the_case%numerics = numerics_t(accuracy=accuracies(k))
         call start_simulation(rough, the_case, 0.0_wp, failure)
         the_case%numerics = numerics_t(accuracy=1.0e-6_wp)
         if (.not. allocated(failure)) call start_simulation(exact, the_case, 0.0_wp, failure)
         inputs = steady(the_case)
         worst = 0.0_wp
         above = 0
         do i = 1, 180
            if (.not. allocated(failure)) call advance(rough, 2*i*degree, inputs, inputs, outcome, failure)
            if (.not. allocated(failure)) call advance(exact, 2*i*degree, inputs, inputs, exact_outcome, failure)
            if (has_failed(failure, error)) return
            ratio = abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive)/outcome%estimated_error
            worst = max(worst, ratio)
            if (ratio > 1.0_wp) above = above + 1
         end do
         call check(error, worst <= 5.0_wp .and. above <= 8, integer_text(above)//" steps are above their estimate, by up to "// &
            & number_text(worst, 3))
         if (allocated(error)) return
      end do
   end subroutine test_joint_estimate

end module test_flexible_simulation
