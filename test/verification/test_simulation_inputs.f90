!> A follower driven with inputs that change within a step: order in the host's step, gas pressure, energy, a stop, an estimate.
module test_simulation_inputs
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, pi, two_pi, degree, error_t, case_t, simulation_t, outcome_t, inputs_t, start_simulation, advance, halt
   use camroller_error, only : kind_usage
   use closeness, only : check_close, expect_error, has_failed
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case, add_gas_force
   implicit none
   private

   public :: collect_simulation_inputs

   !> A deck, driven by a host
   type :: drive_t
      character(len=44) :: path
      !> Accuracy [-]
      real(wp) :: accuracy
      !> Steps of a turn, turns
      integer :: steps, turns
      !> Cam speed [rev/min] and oil temperature [degC]
      real(wp) :: speed, temperature
      !> Part of the speed that goes up and down, four times a turn [-]
      real(wp) :: ripple
   end type drive_t

   !> What a turn comes to
   type :: turn_t
      !> Mean torques to drive and for friction [N m], sliding speed at the end [m/s]
      real(wp) :: values(3) = 0.0_wp
      !> Energy that the drive gives, and that is lost, over the turn [J]
      real(wp) :: driven = 0.0_wp, lost = 0.0_wp
   end type turn_t

contains

   subroutine collect_simulation_inputs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("with a speed ripple torques and slip converge with second order in the host's step", test_order), &
         new_unittest("contact is lost or found within a step whose speed changes as in its parts", test_loss_on_ramp), &
         new_unittest("a step longer than half a turn gives what its halves give, with inputs linear within", test_long_step), &
         new_unittest("a turn that ends at its initial speed gives drive work equal to losses for any speed ripple", test_energy), &
         new_unittest("the estimated error of a step is above its true error", test_estimate), &
         new_unittest("so it is where a step of the integration, friction or a lift table is hard to judge", test_hard_estimates), &
         new_unittest("gas pressure from the host gives the results of the same table in the case", test_pressure), &
         new_unittest("the roller is at rest between a stop and a new start of the engine", test_halt), &
         new_unittest("impossible inputs are refused and leave the follower unchanged", test_refusals) &
         ]
   end subroutine collect_simulation_inputs

   !> Case with a tolerance far below what steps of the host make.
   function tight_case() result(the_case)
      type(case_t) :: the_case

      the_case = thesis_case()
      the_case%operating_point%speed = 60.0_wp
      the_case%operating_point%oil_temperature = 350.0_wp
      the_case%lubricant%temperature_law = "vogel"
      the_case%lubricant%temperature_points = [313.15_wp, 343.15_wp, 373.15_wp]
      the_case%lubricant%viscosity_points = [0.08_wp, 0.025_wp, 0.011_wp]
      the_case%numerics%tolerance = 1.0e-9_wp
      call add_gas_force(the_case)
   end function tight_case

   !> Inputs of an engine whose speed, oil and gas pressure go round with the cam.
   pure function inputs_at(angle, has_pressure) result(inputs)
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      logical, intent(in) :: has_pressure
      type(inputs_t) :: inputs

      inputs%speed = 60.0_wp*(1.0_wp + 0.05_wp*sin(4.0_wp*angle))
      inputs%oil_temperature = 350.0_wp + 4.0_wp*cos(angle)
      inputs%has_pressure = has_pressure
      if (has_pressure) inputs%gas_pressure = 2.0e5_wp*(1.0_wp + sin(2.0_wp*angle))
   end function inputs_at

   !> Two turns in equal steps from the base circle on; what the second comes to.
   subroutine drive(steps, has_gas, turn, failure)
      integer, intent(in) :: steps
      !> Is there gas force, with the pressure from the host?
      logical, intent(in) :: has_gas
      type(turn_t), intent(out) :: turn
      type(error_t), allocatable, intent(out) :: failure
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(case_t) :: the_case
      ! Cam angles at start and end of a step [rad]
      real(wp) :: ends(2)
      integer :: i

      the_case = tight_case()
      if (.not. has_gas) deallocate (the_case%gas_force)
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      do i = 1, 2*steps
         if (allocated(failure)) return
         ends = two_pi*[i - 1, i]/steps
         call advance(simulation, ends(2), inputs_at(ends(1), has_gas), inputs_at(ends(2), has_gas), outcome, failure)
         if (i <= steps) cycle
         turn%values(:2) = turn%values(:2) + [outcome%mean_torque_drive, outcome%mean_torque_friction]/steps
      end do
      turn%values(3) = outcome%state%contact%sliding_speed
      turn%driven = turn%values(1)*two_pi
      turn%lost = turn%values(2)*two_pi
   end subroutine drive

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      ! Steps of four degrees, one, a quarter, and an eighth for what they tend to
      integer, parameter :: steps(*) = [90, 360, 1440, 2880]
      type(turn_t) :: turns(size(steps))
      type(error_t), allocatable :: failure
      ! Errors of three lengths of the step
      real(wp) :: errors(3, 3)
      integer :: i

      do i = 1, size(steps)
         call drive(steps(i), .true., turns(i), failure)
         if (has_failed(failure, error)) return
      end do
      do i = 1, 3
         errors(:, i) = abs(turns(i)%values - turns(4)%values)
      end do
      ! a quarter of the step divides an error of second order by 16, as far as higher ones and the tolerance are small
      do i = 1, 2
         call check(error, all(errors(:2, i + 1) < errors(:2, i)/10.0_wp), "torques are not of second order in the step")
         if (allocated(error)) return
         call check(error, errors(3, i + 1) < errors(3, i)/10.0_wp, "slip is not of second order in the step")
         if (allocated(error)) return
      end do
      ! a straight line over one degree of a ripple with a period of 90 degrees is off by (4 degree)^2/8 of its size
      call check(error, all(errors(:, 2) < 6.0e-4_wp*abs(turns(4)%values)), "errors at one degree are large")
   end subroutine test_order

   !> A step of more than half a turn is integrated in halves, each of which a host could have asked for: the same steps of the
   !> integration, whose contacts start from those before and are solved to a thousandth of the case's tolerance or better. Those of
   !> means are solved to a hundredth. Extremes are those at the angles of the means: rounding decides whether a panel whose error
   !> is just what is allowed is halved, and then they are those at other angles. 9e-8 of a load and 3e-6 of a film were seen.
   !> A half that is forgotten changes the largest load by 0.4 of it.
   subroutine test_long_step(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: tolerance = 1.0e-12_wp, of_contacts = 1.0e-9_wp, of_angles = 1.0e-4_wp
      ! Cam angles of the start, the middle and the end [rad]: the nose is in the first half, then in the second
      real(wp), parameter :: angles(3, 2) = reshape([2.0_wp, 4.0_wp, 6.0_wp, 0.25_wp, 2.25_wp, 4.25_wp], [3, 2])
      type(simulation_t) :: whole, halved
      type(outcome_t) :: once, halves(2)
      type(inputs_t) :: ends(3)
      type(error_t), allocatable :: failure
      integer :: i, k

      do i = 1, size(angles, dim=2)
         ends(1) = inputs_at(angles(1, i), .true.)
         ends(3) = inputs_at(angles(3, i), .true.)
         ends(2) = inputs_t(speed=0.5_wp*(ends(1)%speed + ends(3)%speed), oil_temperature=0.5_wp*(ends(1)%oil_temperature &
            & + ends(3)%oil_temperature), has_pressure=.true., gas_pressure=0.5_wp*(ends(1)%gas_pressure + ends(3)%gas_pressure))
         call start_simulation(whole, tight_case(), angles(1, i), failure)
         if (.not. allocated(failure)) call advance(whole, angles(3, i), ends(1), ends(3), once, failure)
         if (.not. allocated(failure)) call start_simulation(halved, tight_case(), angles(1, i), failure)
         do k = 1, 2
            if (.not. allocated(failure)) call advance(halved, angles(k + 1, i), ends(k), ends(k + 1), halves(k), failure)
         end do
         if (has_failed(failure, error)) return
         call check_close(error, once%state%contact%roller_spin, halves(2)%state%contact%roller_spin, tolerance, "spin at the end")
         if (allocated(error)) return
         call check_close(error, once%mean_torque_friction, 0.5_wp*sum(halves%mean_torque_friction), of_contacts, "mean friction")
         if (allocated(error)) return
         associate (extremes => once%extremes, first => halves(1)%extremes, second => halves(2)%extremes)
            call check_close(error, extremes%contact_load(1), min(first%contact_load(1), second%contact_load(1)), of_angles, &
               & "smallest load")
            if (allocated(error)) return
            call check_close(error, extremes%contact_load(2), max(first%contact_load(2), second%contact_load(2)), of_angles, &
               & "largest load")
            if (allocated(error)) return
            call check_close(error, extremes%film_min, min(first%film_min, second%film_min), of_angles, "smallest film")
            if (allocated(error)) return
            call check(error, (first%contact_load(2) > second%contact_load(2)) .eqv. i == 1, &
               & "the nose is in the other half")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_long_step

   !> Contact is lost where the speed at that angle has it; stops are found with the mean speed of a step, a hundredth of a
   !> degree and more away.
   subroutine test_loss_on_ramp(error)
      type(error_type), allocatable, intent(out) :: error
      ! Steps, of a degree; parts of each in the other drive
      integer, parameter :: steps = 60, parts = 8
      ! Cam angles where the first begins and the last ends [rad]: the roller loses contact and finds it again between them
      real(wp), parameter :: first = 190.0_wp*degree, last = 250.0_wp*degree, length = (last - first)/steps
      type(simulation_t) :: whole, cut
      type(outcome_t) :: outcome, part
      type(case_t) :: the_case
      type(error_t), allocatable :: failure
      ! Cam angle where a step begins [rad]; mean torque that drives by its parts [N m]
      real(wp) :: angle, driven
      character(len=80) :: words
      integer :: i, k, lost

      call get_deck_case("test/data/free_loss/deck.nml", the_case, failure)
      if (.not. allocated(failure)) deallocate (the_case%needle_drag)
      if (.not. allocated(failure)) call start_simulation(whole, the_case, first, failure)
      lost = 0
      do i = 1, steps
         angle = first + (i - 1)*length
         cut = whole
         driven = 0.0_wp
         do k = 1, parts
            if (.not. allocated(failure)) call advance(cut, angle + k*length/parts, falling(angle + (k - 1)*length/parts), &
               & falling(angle + k*length/parts), part, failure)
            driven = driven + part%mean_torque_drive/parts
         end do
         if (.not. allocated(failure)) call advance(whole, angle + length, falling(angle), falling(angle + length), outcome, &
            & failure)
         if (has_failed(failure, error)) return
         ! Changes at stops alone are off by 33 times the estimate where contact returns, those at the speed of another angle by 11
         ! times where it is lost; now by 0.05 times
         write (words, "(a, i0, 2es11.2)") "step, difference, estimate: ", i, driven - outcome%mean_torque_drive, &
            & outcome%estimated_error
         call check(error, abs(driven - outcome%mean_torque_drive) <= outcome%estimated_error, words)
         if (allocated(error)) return
         if (.not. outcome%state%contact%is_touching) lost = lost + 1
      end do
      call check(error, lost > 0 .and. lost < steps .and. outcome%state%contact%is_touching, "contact is not lost, or not found")

   contains

      !> Inputs with a speed that falls by a fifth over the steps.
      function falling(place) result(inputs)
         !> Cam angle [rad]
         real(wp), intent(in) :: place
         type(inputs_t) :: inputs

         inputs = inputs_t(speed=the_case%operating_point%speed*(1.1_wp - 0.2_wp*(place - first)/(last - first)), &
            & oil_temperature=the_case%operating_point%oil_temperature)
      end function falling

   end subroutine test_loss_on_ramp

   !> Over a turn that ends with the speed it began with, spring and masses give back what they got.
   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(turn_t) :: turn
      type(error_t), allocatable :: failure

      call drive(360, .false., turn, failure)
      if (has_failed(failure, error)) return
      ! energies at the ends of 360 steps to round-off of the largest; the roller's spin is that of a turn before to the tolerance
      call check(error, abs(turn%driven - turn%lost) < 1.0e-9_wp*turn%lost, "energy is made or lost over a turn")
   end subroutine test_energy

   !> Steps of half a degree over a turn, with usual accuracies and with one far below: errors of the torque that drives are those
   !> of the roller's energy for the most part, over so short a step.
   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: steps = 720
      real(wp), parameter :: accuracies(2) = [1.0e-3_wp, 1.0e-4_wp]
      type(simulation_t) :: rough, exact
      type(outcome_t) :: outcome, exact_outcome
      type(case_t) :: the_case
      type(error_t), allocatable :: failure
      ! Cam angles at start and end of a step [rad]
      real(wp) :: ends(2)
      integer :: i, k

      do k = 1, size(accuracies)
         the_case = tight_case()
         call start_simulation(exact, the_case, 0.0_wp, failure)
         the_case%numerics%tolerance = 0.0_wp
         the_case%numerics%accuracy = accuracies(k)
         if (.not. allocated(failure)) call start_simulation(rough, the_case, 0.0_wp, failure)
         do i = 1, steps
            ends = two_pi*[i - 1, i]/steps
            if (.not. allocated(failure)) call advance(exact, ends(2), inputs_at(ends(1), .true.), inputs_at(ends(2), .true.), &
               & exact_outcome, failure)
            if (.not. allocated(failure)) call advance(rough, ends(2), inputs_at(ends(1), .true.), inputs_at(ends(2), .true.), &
               & outcome, failure)
            if (has_failed(failure, error)) return
            call check(error, abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive) <= outcome%estimated_error, &
               & "an error is larger than estimated")
            if (allocated(error)) return
            ! an estimate that says nothing would be of the size of the torque
            call check(error, outcome%estimated_error < 10.0_wp*accuracies(k)*exact_outcome%mean_torque_friction, &
               & "the estimate is of no use")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_estimate

   !> Drives whose errors were above their estimates, by the factors named, where the estimate was the tolerance of the sliding
   !> speed times the slope of the torque at a step's end. Now they are 0.9 of it at most.
   subroutine test_hard_estimates(error)
      type(error_type), allocatable, intent(out) :: error
      type(drive_t), parameter :: drives(*) = [ &
         ! error estimates of a method that vanish over a step: 12, 7.4, 11, 17, 4.6 and 2.3
         drive_t("decks/sliding_joints.nml", 1.0e-4_wp, 360, 1, 900.0_wp, 95.0_wp, 0.03_wp), &
         drive_t("decks/plain_pin.nml", 1.0e-4_wp, 720, 1, 300.0_wp, 25.0_wp, 0.0_wp), &
         drive_t("decks/hard/steep_ramp.nml", 1.0e-4_wp, 720, 1, 600.0_wp, 60.0_wp, 0.0_wp), &
         drive_t("decks/hard/nearly_undercut_nose.nml", 1.0e-4_wp, 720, 1, 900.0_wp, 95.0_wp, 0.0_wp), &
         drive_t("decks/thesis.nml", 1.0e-3_wp, 720, 1, 300.0_wp, 40.0_wp, 0.03_wp), &
         drive_t("decks/thesis_source.nml", 1.0e-4_wp, 360, 2, 2500.0_wp, 100.0_wp, 0.0_wp), &
         ! film and asperities that change with the slip: 1.8
         drive_t("decks/thesis_source.nml", 1.0e-3_wp, 720, 1, 2500.0_wp, 100.0_wp, 0.0_wp), &
         ! errors that decay over many steps: 2.1
         drive_t("decks/hard/outside_film_law.nml", 1.0e-4_wp, 720, 1, 900.0_wp, 95.0_wp, 0.03_wp), &
         ! traction so steep that the last digits of the spin count: 2e5
         drive_t("decks/hard/pressure_4000_MPa_barus.nml", 1.0e-4_wp, 360, 1, 300.0_wp, 25.0_wp, 0.0_wp), &
         ! slip that ends in rest: 900
         drive_t("decks/hard/stick_slip_true.nml", 1.0e-3_wp, 360, 1, 900.0_wp, 60.0_wp, 0.03_wp), &
         ! knots of a lift table between the angles of the means: 25, with 2.4 times the accuracy in the friction
         drive_t("decks/hard/fine_table.nml", 1.0e-3_wp, 720, 1, 600.0_wp, 60.0_wp, 0.03_wp), &
         ! a roller off its cam, taken for one that slides on it from end to end of a step: 4000
         drive_t("decks/hard/contact_loss_3200_rpm.nml", 1.0e-4_wp, 360, 1, 3200.0_wp, 95.0_wp, 0.0_wp)]
      integer :: i

      do i = 1, size(drives)
         call compare_drives(drives(i), error)
         if (allocated(error)) return
      end do
   end subroutine test_hard_estimates

   !> Drive a deck with its accuracy and with one far below.
   subroutine compare_drives(drive, error)
      type(drive_t), intent(in) :: drive
      type(error_type), allocatable, intent(out) :: error
      ! Accuracy of what counts as exact, over that of the drive [-]: its errors are small against those that are looked for
      real(wp), parameter :: far_below = 1.0e-3_wp
      type(simulation_t) :: rough, exact
      type(outcome_t) :: outcome, exact_outcome
      type(case_t) :: the_case
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure
      real(wp) :: angles(2) ! at start and end of a step [rad]
      integer :: i

      call get_deck_case(trim(drive%path), the_case, failure)
      the_case%operating_point%speed = drive%speed*two_pi/60.0_wp
      the_case%operating_point%oil_temperature = drive%temperature + 273.15_wp
      the_case%numerics%accuracy = drive%accuracy
      if (.not. allocated(failure)) call start_simulation(rough, the_case, 0.0_wp, failure)
      the_case%numerics%accuracy = far_below*drive%accuracy
      if (.not. allocated(failure)) call start_simulation(exact, the_case, 0.0_wp, failure)
      do i = 1, drive%turns*drive%steps
         angles = two_pi*[i - 1, i]/drive%steps
         ends%speed = the_case%operating_point%speed*(1.0_wp + drive%ripple*sin(4.0_wp*angles))
         ends%oil_temperature = the_case%operating_point%oil_temperature
         if (.not. allocated(failure)) call advance(exact, angles(2), ends(1), ends(2), exact_outcome, failure)
         if (.not. allocated(failure)) call advance(rough, angles(2), ends(1), ends(2), outcome, failure)
         if (allocated(failure)) then
            call test_failed(error, trim(drive%path)//": "//failure%message)
            return
         end if
         call check(error, abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive) <= outcome%estimated_error, &
            & trim(drive%path)//": an error is larger than estimated")
         if (allocated(error)) return
         call check(error, abs(outcome%mean_torque_friction - exact_outcome%mean_torque_friction) &
            & <= drive%accuracy*exact_outcome%mean_torque_friction, trim(drive%path)//": friction is off")
         if (allocated(error)) return
      end do
   end subroutine compare_drives

   subroutine test_pressure(error)
      type(error_type), allocatable, intent(out) :: error
      ! Steps of a turn
      integer, parameter :: steps = 1440
      type(case_t) :: the_case
      type(simulation_t) :: by_table, by_host
      type(outcome_t) :: from_table, from_host
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure
      ! Mean torques of a turn [N m]; largest drive torque [N m]
      real(wp) :: torques(2), largest
      integer :: i, k

      the_case = tight_case()
      ! the table is that of `inputs_at`, dense enough for its spline to be exact to 1e-9
      the_case%gas_force%angle = [(two_pi*i/360.0_wp - pi, i=0, 360)]
      the_case%gas_force%pressure = 2.0e5_wp*(1.0_wp + sin(2.0_wp*(the_case%gas_force%angle + pi)))
      the_case%gas_force%pressure(361) = the_case%gas_force%pressure(1)
      call start_simulation(by_table, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call start_simulation(by_host, the_case, 0.0_wp, failure)
      torques = 0.0_wp
      largest = 0.0_wp
      do i = 1, steps
         ends = [(inputs_at(two_pi*(i + k - 2)/steps, .false.), k=1, 2)]
         if (.not. allocated(failure)) call advance(by_table, two_pi*i/steps, ends(1), ends(2), from_table, failure)
         ends = [(inputs_at(two_pi*(i + k - 2)/steps, .true.), k=1, 2)]
         if (.not. allocated(failure)) call advance(by_host, two_pi*i/steps, ends(1), ends(2), from_host, failure)
         if (has_failed(failure, error)) return
         torques = torques + [from_table%mean_torque_drive, from_host%mean_torque_drive]/steps
         largest = max(largest, abs(from_table%torque_drive))
         ! pressures agree at the ends of steps, and between to (pi/720)^2/2 of their amplitude
         call check(error, abs(from_table%torque_drive - from_host%torque_drive) < 1.0e-5_wp*largest, "torque at the end of a step")
         if (allocated(error)) return
      end do
      call check(error, abs(torques(1) - torques(2)) < 1.0e-5_wp*largest, "mean torque of a turn")
   end subroutine test_pressure

   subroutine test_halt(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation, started
      type(outcome_t) :: outcome, after
      type(inputs_t) :: slow, fast
      type(error_t), allocatable :: failure
      integer :: i

      slow = inputs_t(speed=0.5_wp, oil_temperature=350.0_wp)
      fast = inputs_t(speed=60.0_wp, oil_temperature=350.0_wp)
      call start_simulation(simulation, tight_case(), 0.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 1.0_wp, fast, slow, outcome, failure)
      call halt(simulation)
      ! over the shortest step the roller hardly gets any spin
      if (.not. allocated(failure)) call advance(simulation, 1.0_wp + 1.0e-9_wp, slow, slow, outcome, failure)
      if (has_failed(failure, error)) return
      call check(error, abs(outcome%state%contact%roller_spin) < 1.0e-2_wp*abs(outcome%state%contact%rolling_speed) &
         & /0.0085_wp, "the roller is not at rest")
      if (allocated(error)) return
      call start_simulation(started, tight_case(), 1.0_wp + 1.0e-9_wp, failure)
      do i = 1, 8
         if (.not. allocated(failure)) call advance(simulation, 1.0_wp + i, fast, fast, outcome, failure)
         if (.not. allocated(failure)) call advance(started, 1.0_wp + i, fast, fast, after, failure)
      end do
      if (has_failed(failure, error)) return
      ! more than a turn later nothing is left of the stop but the tolerance
      call check(error, abs(outcome%torque_friction - after%torque_friction) < 1.0e-6_wp*after%torque_friction, &
         & "the stop is not forgotten after a turn")
   end subroutine test_halt

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(inputs_t) :: right, wrong
      type(error_t), allocatable :: failure, at_once

      right = inputs_t(speed=60.0_wp, oil_temperature=350.0_wp)
      call start_simulation(simulation, tight_case(), 0.0_wp, failure)
      wrong = inputs_t(speed=0.0_wp, oil_temperature=350.0_wp)
      call try(wrong, "halt")
      wrong = inputs_t(speed=60.0_wp, oil_temperature=-1.0_wp)
      if (.not. allocated(error)) call try(wrong, "temperature")
      wrong = inputs_t(speed=60.0_wp, oil_temperature=350.0_wp, has_pressure=.true.)
      if (.not. allocated(error)) call try(wrong, "both ends")
      wrong = inputs_t(60.0_wp, 350.0_wp, gas_pressure=1.0e5_wp)
      if (.not. allocated(error)) call try(wrong, "set has_pressure at both ends")
      if (allocated(error)) return
      ! kelvin by one end, degrees Celsius by the other: below the pole of Vogel's law, found before a step goes there
      call advance(simulation, 0.1_wp, right, inputs_t(60.0_wp, 60.0_wp), outcome, failure)
      call advance(simulation, 0.1_wp, inputs_t(60.0_wp, 60.0_wp), inputs_t(60.0_wp, 60.0_wp), outcome, at_once)
      call check(error, allocated(failure) .and. allocated(at_once), "oil without a viscosity is accepted")
      if (.not. allocated(error)) call check(error, failure%message, at_once%message)
      if (allocated(error)) return
      call start_simulation(simulation, thesis_case(), 0.0_wp, failure)
      wrong%has_pressure = .true.
      call advance(simulation, 0.1_wp, wrong, wrong, outcome, failure)
      call check(error, allocated(failure), "a pressure without the valve's area is accepted")
      if (allocated(error)) return
      call check(error, index(failure%message, "&gas_force") > 0, failure%message)

   contains

      subroutine try(inputs, word)
         type(inputs_t), intent(in) :: inputs
         character(len=*), intent(in) :: word

         call advance(simulation, 0.1_wp, right, inputs, outcome, failure)
         call expect_error(error, failure, kind_usage, word)
         if (allocated(error)) return
         call advance(simulation, 0.1_wp, inputs, right, outcome, failure)
         call check(error, allocated(failure), "accepted at the start, no error about "//word)
      end subroutine try

   end subroutine test_refusals

end module test_simulation_inputs
