!> A flexible train driven from outside: at the ends of its range, where a step fails, in a whole camshaft.
module test_flexible_host
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, pi, two_pi, degree, error_t, case_t, simulation_t, outcome_t, inputs_t, result_t, &
      & shaft_simulation_t, shaft_outcome_t, kind_convergence, kind_usage, run_case, get_summary, start_simulation, advance, halt, &
      & start_shaft, advance_shaft
   use camroller_accuracy, only : resolve_numerics
   use camroller_cycle_start, only : choose_start
   use camroller_flexible_step, only : place_train, step_train
   use camroller_follower_step, only : follower_t
   use camroller_run, only : build_model
   use camroller_torque_list, only : of_bearings
   use closeness, only : check_close, expect_error, has_failed
   use deck_cases, only : get_deck_case
   use driven_trains, only : train, steady, inputs_at, engine_case
   use flexible_cases, only : add_dynamics
   use reference_cases, only : thesis_case
   implicit none
   private

   public :: collect_flexible_host

contains

   subroutine collect_flexible_host(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a run-up from 600 to 4000 rev/min in a second loses contact and goes on", test_run_up), &
         new_unittest("at 1 rev/min the train follows its cam, and after a halt it starts from rest", test_slow), &
         new_unittest("a step that fails leaves the train as it was; impossible inputs are refused", test_failure), &
         new_unittest("a train starts at rest at every whole turn, however it is rounded", test_whole_turns), &
         new_unittest("a follower keeps no more memory after a long start or step than after a short one", test_memory), &
         new_unittest("a shaft with one cam gives the bits of its follower", test_shaft), &
         new_unittest("a head of three cams on their bearings becomes periodic with the torques of a run", test_head), &
         new_unittest("the estimated error of a step bounds that of the bearings of trains that vibrate", test_bearing_error) &
         ]
   end subroutine collect_flexible_host

   subroutine test_run_up(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure
      !> Time [s], cam angle [rad] from the base circle on: the speed rises by 3400 rev/min in a second
      real(wp) :: time, angle, gap
      integer :: i
      real(wp), parameter :: first = 600.0_wp*pi/30.0_wp, rise = 3400.0_wp*pi/30.0_wp

      call start_simulation(simulation, train(600.0_wp, 5, .true., 1.0e-2_wp), 0.0_wp, failure)
      i = 0
      angle = 0.0_wp
      gap = 0.0_wp
      ends%oil_temperature = 368.15_wp
      ends%speed = first
      do
         i = i + 1
         angle = 4.0_wp*degree*i
         ends(1) = ends(2)
         ! omega^2 = omega_0^2 + 2 alpha angle
         ends(2)%speed = sqrt(first**2 + 2.0_wp*rise*angle)
         time = (ends(2)%speed - first)/rise
         if (time > 1.0_wp) exit
         if (.not. allocated(failure)) call advance(simulation, angle, ends(1), ends(2), outcome, failure)
         if (has_failed(failure, error)) return
         gap = max(gap, outcome%state%flexible%gap)
      end do
      ! 2300 rev/min on average
      call check_close(error, angle, 2300.0_wp/60.0_wp*two_pi, 1.0e-3_wp, "turns of the run-up")
      if (allocated(error)) return
      call check(error, gap > 1.0e-5_wp, "contact is never lost")
   end subroutine test_run_up

   subroutine test_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      type(case_t) :: the_case
      !> Speed of the valve [m/s]
      real(wp) :: speed

      the_case = train(1.0_wp, 1, .false., 1.0e-3_wp)
      inputs = steady(the_case)
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 0.3_wp, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      ! the closed valve in its seat, from the balance of the forces without friction; that of the turning roller is 1e-4 of them
      call check_close(error, outcome%state%position%lift, -3.44813551e-6_wp, 1.0e-4_wp, "closed valve")
      if (allocated(error)) return
      call advance(simulation, 3.0_wp, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      ! an independent program has 39.667 um at 300 rev/min, where inertia is half a percent of the load
      call check_close(error, outcome%state%flexible%lift_error, -39.667e-6_wp, 1.0e-2_wp, "lift that is lost")
      if (allocated(error)) return
      associate (load => outcome%state%contact%load)
         call check_close(error, load - outcome%state%flexible%load_error, load, 5.0e-3_wp, "load at rest but for friction")
      end associate
      if (allocated(error)) return

      ! On the flank the valve moves; after a halt it does not, and the cam of an engine that is cranked hardly moves it
      inputs%speed = 1000.0_wp*pi/30.0_wp
      call start_simulation(simulation, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 2.7_wp, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      speed = outcome%state%position%lift_slope*inputs%speed
      call halt(simulation)
      inputs%speed = 1.0_wp*pi/30.0_wp
      call advance(simulation, 2.7_wp + 1.0e-7_wp, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      call check(error, speed > 0.3_wp .and. abs(outcome%state%position%lift_slope*inputs%speed) < 1.0e-2_wp*speed, &
         & "the valve moves on")
      if (allocated(error)) return
      inputs%speed = 0.0_wp
      call advance(simulation, 2.8_wp, inputs, inputs, outcome, failure)
      call check_usage(failure, "speed", error)
   end subroutine test_slow

   subroutine test_failure(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation, copy, rigid
      type(outcome_t) :: outcome, of_copy
      type(inputs_t) :: inputs(2), broken(2)
      type(error_t), allocatable :: failure

      inputs = [inputs_at(0.0_wp), inputs_at(0.3_wp)]
      call start_simulation(simulation, engine_case(1.0e-4_wp), 3.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 3.1_wp, inputs(1), inputs(2), outcome, failure)
      if (has_failed(failure, error)) return
      copy = simulation
      broken = inputs
      ! no spring holds a valve against this
      broken(2)%gas_pressure = 1.0e16_wp
      call advance(simulation, 3.3_wp, broken(1), broken(2), outcome, failure)
      call check(error, allocated(failure), "an impossible step succeeds")
      if (allocated(error)) return
      call check(error, failure%kind, kind_convergence)
      if (allocated(error)) return
      broken = inputs
      broken(2)%has_supply = .false.
      call advance(simulation, 3.3_wp, broken(1), broken(2), outcome, failure)
      call check_usage(failure, "both ends", error)
      if (allocated(error)) return
      broken = inputs
      broken(1)%supply_pressure = -1.0_wp
      call advance(simulation, 3.3_wp, broken(1), broken(2), outcome, failure)
      call check_usage(failure, "0 or more", error)
      if (allocated(error)) return
      deallocate (failure)
      call advance(simulation, 3.3_wp, inputs(1), inputs(2), outcome, failure)
      if (.not. allocated(failure)) call advance(copy, 3.3_wp, inputs(1), inputs(2), of_copy, failure)
      if (.not. allocated(failure)) call start_simulation(rigid, thesis_case(), 3.0_wp, failure)
      if (has_failed(failure, error)) return
      call check(error, all(transfer([outcome%mean_torque_drive, outcome%estimated_error, outcome%state%contact%roller_spin, &
         & outcome%state%flexible%modes(1), outcome%state%flexible%chamber_pressure], [0_int64]) &
         & == transfer([of_copy%mean_torque_drive, of_copy%estimated_error, of_copy%state%contact%roller_spin, &
         & of_copy%state%flexible%modes(1), of_copy%state%flexible%chamber_pressure], [0_int64])), "bits differ after a failure")
      if (allocated(error)) return
      inputs%has_pressure = .false.
      inputs%gas_pressure = 0.0_wp
      call advance(rigid, 3.3_wp, inputs(1), inputs(2), outcome, failure)
      call check_usage(failure, "lash_adjuster", error)
      if (allocated(error)) return
      inputs%has_supply = .false.
      call advance(rigid, 3.3_wp, inputs(1), inputs(2), outcome, failure)
      call check_usage(failure, "set has_supply at both ends", error)
   end subroutine test_failure

   !> Check that a call is refused with a word in its message.
   subroutine check_usage(failure, word, error)
      type(error_t), allocatable, intent(in) :: failure
      character(len=*), intent(in) :: word
      type(error_type), allocatable, intent(out) :: error

      call expect_error(error, failure, kind_usage, word)
   end subroutine check_usage

   !> Whole turns as a host may come to them: multiplied, from degrees, from seconds at 17 turns a second. With this speed the first
   !> turn of a train that has turned once already takes another torque by a tenth.
   subroutine test_whole_turns(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: follower
      type(outcome_t) :: outcome
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      ! Cam angles of a whole turn [rad]; mean torque of the turn after it, and after none [N m]
      real(wp) :: angles(3), torque, first
      integer :: i, k

      call get_deck_case("decks/lash_adjuster.nml", the_case, failure, "operating_point.speed_rpm=2200")
      if (has_failed(failure, error)) return
      inputs = steady(the_case)
      first = 0.0_wp
      do k = 0, 23
         angles = [k*two_pi, 360.0_wp*k*degree, (k/17.0_wp)*(17.0_wp*two_pi)]
         do i = 1, size(angles)
            call start_simulation(follower, the_case, angles(i), failure)
            if (.not. allocated(failure)) call advance(follower, angles(i) + 0.5_wp*two_pi, inputs, inputs, outcome, failure)
            if (has_failed(failure, error)) return
            torque = outcome%mean_torque_drive
            if (k == 0) first = torque
            ! Angles are rounded otherwise in each turn, and the integration is as accurate as the case asks for
            call check_close(error, torque, first, 1.0e-3_wp, "torque of the first half turn")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_whole_turns

   !> What is copied with a follower beside its model is what its integration works with. A turn has thousands of points, of 1.2 kB
   !> each, which are of no use once their means are taken.
   subroutine test_memory(error)
      type(error_type), allocatable, intent(out) :: error
      ! Sixty-four points and some [B]
      integer, parameter :: most = 100000
      type(case_t) :: the_case
      type(follower_t), target :: follower
      type(outcome_t) :: outcome
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      ! Not needed: an angle [rad], sliding speeds [m/s]
      real(wp) :: angle, sliding_speed, least
      integer :: evaluations

      call get_deck_case("decks/lash_adjuster.nml", the_case, failure, "operating_point.speed_rpm=2200")
      if (.not. allocated(failure)) call build_model(the_case, 1, follower%model, failure)
      if (has_failed(failure, error)) return
      follower%given = the_case%numerics
      follower%numerics = resolve_numerics(the_case%numerics)
      follower%point%oil_temperature = the_case%operating_point%oil_temperature
      evaluations = 0
      call choose_start(follower%model, angle, sliding_speed, follower%point%scale, least, evaluations)
      call place_train(follower, 6.0_wp, failure)
      if (has_failed(failure, error)) return
      call check(error, room_of(follower) < most, "memory after a start")
      if (allocated(error)) return
      inputs = steady(the_case)
      call step_train(follower, 6.0_wp + two_pi, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      call check(error, room_of(follower) < most, "memory after a step of a turn")
   end subroutine test_memory

   !> Memory of the path that a follower keeps.
   function room_of(follower) result(bytes)
      type(follower_t), intent(in) :: follower
      !> The memory [B]
      integer :: bytes

      bytes = 0
      associate (path => follower%drive%path)
         if (allocated(path%time)) bytes = storage_size(path%time)/8*(size(path%time) + size(path%state) + size(path%rate) &
            & + size(path%bends))
      end associate
   end function room_of

   subroutine test_shaft(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: follower
      type(shaft_simulation_t) :: shaft
      type(outcome_t) :: outcome
      type(shaft_outcome_t) :: of_shaft
      type(error_t), allocatable :: failure
      integer :: i

      call start_simulation(follower, engine_case(1.0e-4_wp), 2.0_wp, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, engine_case(1.0e-4_wp), 2.0_wp, failure)
      do i = 1, 4
         if (.not. allocated(failure)) call advance(follower, 2.0_wp + 0.3_wp*i, inputs_at(0.3_wp*(i - 1)), inputs_at(0.3_wp*i), &
            & outcome, failure)
         if (.not. allocated(failure)) call advance_shaft(shaft, 2.0_wp + 0.3_wp*i, inputs_at(0.3_wp*(i - 1)), &
            & inputs_at(0.3_wp*i), of_shaft, failure)
         if (has_failed(failure, error)) return
         call check(error, all(transfer([outcome%mean_torque_drive, outcome%torque_friction, outcome%estimated_error], [0_int64]) &
            & == transfer([of_shaft%mean_torque_drive, of_shaft%torque_friction, of_shaft%estimated_error], [0_int64])), "bits")
         if (allocated(error)) return
         ! forces at angles a degree apart find the range within what the torque changes between them
         call check(error, of_shaft%extreme_torque(1) >= outcome%extremes%torque_drive(1) - 0.1_wp .and. &
            & of_shaft%extreme_torque(2) <= outcome%extremes%torque_drive(2) + 0.1_wp, "range of the torque")
         if (allocated(error)) return
      end do
   end subroutine test_shaft

   subroutine test_head(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(result_t) :: result
      type(error_t), allocatable :: failure
      !> Means of a turn: drive, friction, bearings [N m]; those of the run
      real(wp) :: means(3), values(3)
      character(len=*), parameter :: names(3) = [character(len=24) :: "mean_torque_drive", "mean_torque_friction", &
         & "mean_torque_bearings"]
      integer, parameter :: steps = 90, turns = 3
      integer :: i

      call get_deck_case("decks/three_cam_head.nml", the_case, failure, "numerics.accuracy=1e-3")
      if (has_failed(failure, error)) return
      the_case%operating_point%speed = 400.0_wp*pi/30.0_wp
      the_case%masses%finger = 0.0418_wp
      call add_dynamics(the_case, 0, .false.)
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure, threads=2)
      means = 0.0_wp
      do i = 1, turns*steps
         if (.not. allocated(failure)) call advance_shaft(shaft, two_pi*i/steps, steady(the_case), &
            & steady(the_case), outcome, failure)
         if (has_failed(failure, error)) return
         if (i > (turns - 1)*steps) means = means + [outcome%mean_torque_drive, outcome%mean_torque_friction, &
            & outcome%mean_torques(of_bearings)]/steps
      end do
      do i = 1, size(names)
         call get_summary(result, trim(names(i)), values(i), failure)
         if (has_failed(failure, error)) return
         call check_close(error, means(i), values(i), the_case%numerics%accuracy, trim(names(i)))
         if (allocated(error)) return
      end do
   end subroutine test_head

   !> Vibrating loads on the bearings: what the rules for their means differ by changes its sign within a step.
   subroutine test_bearing_error(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft, fine
      type(shaft_outcome_t) :: outcome, part
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      !> Length of a step [rad], cam angle at its start [rad], its mean torque in small steps [N m]
      real(wp) :: length, from, mean
      !> Largest error over its estimate [-]
      real(wp) :: worst
      integer, parameter :: steps = 40, parts = 40
      integer :: i, k

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (has_failed(failure, error)) return
      the_case%operating_point%speed = 1000.0_wp*pi/30.0_wp
      the_case%masses%finger = 0.0418_wp
      call add_dynamics(the_case, 0, .false.)
      inputs = steady(the_case)
      length = 5.0_wp*degree
      worst = 0.0_wp
      call start_shaft(shaft, the_case, 0.0_wp, failure, threads=2)
      do i = 1, steps
         from = (i - 1)*length
         if (.not. allocated(failure)) fine = shaft
         if (.not. allocated(failure)) call advance_shaft(shaft, from + length, inputs, inputs, outcome, failure)
         mean = 0.0_wp
         do k = 1, parts
            if (.not. allocated(failure)) call advance_shaft(fine, from + length*k/parts, inputs, inputs, part, failure)
            if (has_failed(failure, error)) return
            mean = mean + part%mean_torque_drive/parts
         end do
         worst = max(worst, abs(outcome%mean_torque_drive - mean)/outcome%estimated_error)
      end do
      call check(error, worst <= 1.0_wp, "an error is larger than estimated")
   end subroutine test_bearing_error

end module test_flexible_host
