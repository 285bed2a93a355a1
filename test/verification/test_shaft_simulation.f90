!> All followers of a case driven together: against the run of the case, one follower alone, other numbers of threads and of steps.
module test_shaft_simulation
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_value
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller, only : wp, two_pi, error_t, case_t, result_t, simulation_t, outcome_t, inputs_t, &
      & shaft_simulation_t, shaft_outcome_t, kind_usage, run_case, get_series, get_summary, &
      & start_simulation, advance, start_shaft, advance_shaft, halt_shaft, save_shaft, restore_shaft, cam_number, cam_place, &
      & shaft_angle, shaft_values
   use camroller_catalogue, only : list_series, camshaft_columns
   use camroller_model_mark, only : mixed
   use camroller_result, only : quantity_t, find_quantity
   use camroller_step_inputs, only : part_number
   use camroller_torque_list, only : of_bearings
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case
   use camroller_kinds, only : degree
   use closeness, only : check_close, expect_error, has_failed
   implicit none
   private

   public :: collect_shaft_simulation

contains

   subroutine collect_shaft_simulation(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("repeated turns of an engine's camshafts tend to the means of its run", test_periodic), &
         new_unittest("each bearing's load, film and torque at a step's end are those of the run", test_bearings), &
         new_unittest("a shaft with one cam gives the bits of its follower", test_one_cam), &
         new_unittest("torques of bearings and followers are of second order in the host's step", test_order), &
         new_unittest("the estimated error of a step bounds its error", test_estimate), &
         new_unittest("equal turns in equal steps settle, however their angles are rounded", test_equal_turns), &
         new_unittest("the bearings' torque over a long step is that over its degrees one by one", test_long_step), &
         new_unittest("the number of threads changes no bit", test_threads), &
         new_unittest("a saved and restored shaft continues with the same bits", test_saved), &
         new_unittest("a step that fails for one cam leaves all followers unchanged", test_failure), &
         new_unittest("backward turns and standstill are refused with a message that says what to do", &
            & test_refusals), &
         new_unittest("numbers of a shaft have the names of the series of a run", test_names) &
         ]
   end subroutine collect_shaft_simulation

   !> Inputs of an engine whose speed and oil go round with the cam.
   pure function inputs_at(the_case, angle, ripple) result(inputs)
      type(case_t), intent(in) :: the_case
      !> Cam angle [rad]; size of the ripple of the speed [-]
      real(wp), intent(in) :: angle, ripple
      type(inputs_t) :: inputs

      inputs%speed = the_case%operating_point%speed*(1.0_wp + ripple*sin(4.0_wp*angle))
      inputs%oil_temperature = the_case%operating_point%oil_temperature*(1.0_wp + 0.1_wp*ripple*cos(angle))
   end function inputs_at

   !> Turn a shaft on in equal steps; means of the last turn to drive, for friction, of the bearings.
   subroutine turn(shaft, the_case, steps, turns, ripple, means, failure, outcome)
      type(shaft_simulation_t), intent(inout) :: shaft
      type(case_t), intent(in) :: the_case
      !> Steps of a turn, and turns
      integer, intent(in) :: steps, turns
      !> Size of the ripple of the speed [-]
      real(wp), intent(in) :: ripple
      !> Means [N m]
      real(wp), intent(out) :: means(3)
      type(error_t), allocatable, intent(out) :: failure
      type(shaft_outcome_t), intent(out) :: outcome
      ! Cam angle at the start [rad]
      real(wp) :: from
      integer :: i

      means = 0.0_wp
      from = shaft_angle(shaft)
      do i = 1, turns*steps
         call advance_shaft(shaft, from + two_pi*i/steps, inputs_at(the_case, from + two_pi*(i - 1)/steps, ripple), &
            & inputs_at(the_case, from + two_pi*i/steps, ripple), outcome, failure)
         if (allocated(failure)) return
         if (i > (turns - 1)*steps) means = means + [outcome%mean_torque_drive, outcome%mean_torque_friction, &
            & outcome%mean_torques(of_bearings)]/steps
      end do
   end subroutine turn

   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Means of the turn and of the run [N m]
      real(wp) :: means(3), expected(3)

      call get_deck_case("decks/four_cylinder.nml", the_case, failure)
      if (.not. allocated(failure)) call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_drive", expected(1), failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_friction", expected(2), failure)
      if (.not. allocated(failure)) call get_summary(result, "mean_torque_bearings", expected(3), failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.7_wp, failure)
      if (.not. allocated(failure)) call turn(shaft, the_case, 45, 2, 0.0_wp, means, failure, outcome)
      if (has_failed(failure, error)) return
      call check(error, cam_number(shaft) == 16, "there are not sixteen cams")
      if (allocated(error)) return
      ! both are within the accuracy of the case
      call check(error, all(abs(means - expected) < 2.0_wp*the_case%numerics%accuracy*expected), &
         & "means of a turn are not those of the run")
   end subroutine test_periodic

   !> Every series of the camshaft and its single bearings, over the second turn.
   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: steps = 40
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(inputs_t) :: inputs
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Numbers of the camshaft at the ends of steps, shape (series, step); a series of the run [unit of the series]
      real(wp), allocatable :: driven(:, :), values(:), run_values(:)
      ! Range of the numbers of a series [unit of the series]
      real(wp) :: range
      integer :: columns(2), column, i, touching

      ! hot oil, in which asperities touch
      call get_deck_case("decks/mixed_bearings.nml", the_case, failure, "operating_point.oil_temperature_degC=95")
      if (.not. allocated(failure)) call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      inputs = inputs_at(the_case, 0.0_wp, 0.0_wp)
      columns = camshaft_columns(the_case)
      allocate (driven(columns(1):columns(2), steps), run_values(steps))
      do i = 1, 2*steps
         call advance_shaft(shaft, two_pi*i/steps, inputs, inputs, outcome, failure)
         if (has_failed(failure, error)) return
         call shaft_values(shaft, 0, outcome, values)
         if (i > steps) driven(:, i - steps) = values
      end do
      touching = 0
      do column = columns(1), columns(2)
         associate (name => result%series(column)%name)
            call get_series(result, name, values, failure)
            if (has_failed(failure, error)) return
            do i = 1, steps
               run_values(i) = values(1 + modulo(i*size(values)/steps, size(values)))
            end do
            range = maxval(abs(run_values))
            touching = touching + merge(1, 0, index(name, "asperity_load") > 0 .and. range > 0.0_wp)
            if (name == "energy_residual") cycle
            call check(error, all(abs(driven(column, :) - run_values) < 2.0_wp*the_case%numerics%accuracy*range), name)
            if (allocated(error)) return
         end associate
      end do
      call check(error, touching == 2, "asperities do not touch in both bearings")
   end subroutine test_bearings

   subroutine test_one_cam(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(simulation_t) :: follower
      type(shaft_outcome_t) :: of_shaft
      type(outcome_t) :: of_follower
      type(error_t), allocatable :: failure
      integer :: i

      the_case = thesis_case()
      call start_shaft(shaft, the_case, 0.2_wp, failure)
      if (.not. allocated(failure)) call start_simulation(follower, the_case, 0.2_wp, failure)
      do i = 1, 20
         if (.not. allocated(failure)) call advance_shaft(shaft, 0.2_wp + 0.3_wp*i, inputs_at(the_case, 0.3_wp*i, 0.05_wp), &
            & inputs_at(the_case, 0.3_wp*(i + 1), 0.05_wp), of_shaft, failure)
         if (.not. allocated(failure)) call advance(follower, 0.2_wp + 0.3_wp*i, inputs_at(the_case, 0.3_wp*i, 0.05_wp), &
            & inputs_at(the_case, 0.3_wp*(i + 1), 0.05_wp), of_follower, failure)
         if (has_failed(failure, error)) return
         call check(error, all(same([of_shaft%mean_torque_drive, of_shaft%torque_friction, of_shaft%estimated_error], &
            & [of_follower%mean_torque_drive, of_follower%torque_friction, of_follower%estimated_error])), "bits differ")
         if (allocated(error)) return
         associate (range => of_shaft%extreme_torque, alone => of_follower%extremes%torque_drive)
            call check(error, range(1) < range(2) .and. range(1) <= of_shaft%torque_drive .and. of_shaft%torque_drive <= range(2), &
               & "extremes leave the end out")
            if (.not. allocated(error)) call check(error, range(1) <= alone(1) .and. alone(2) <= range(2), "extremes leave out "// &
               & "what the follower knows of the step")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_one_cam

   !> Are numbers the same?
   elemental logical function same(one, other)
      real(wp), intent(in) :: one, other

      same = .not. (one < other .or. one > other)
   end function same

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: steps(*) = [9, 36, 720]
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Means of a turn for each length of the step [N m]
      real(wp) :: means(3, size(steps))
      integer :: i

      call get_deck_case("decks/three_cam_head.nml", the_case, failure, "numerics.accuracy=1e-7")
      do i = 1, size(steps)
         if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure, threads=2)
         if (.not. allocated(failure)) call turn(shaft, the_case, steps(i), 1, 0.05_wp, means(:, i), failure, outcome)
         if (has_failed(failure, error)) return
      end do
      ! from 40 degrees to 10 an error of second order falls to a sixteenth, as far as higher ones are small, and as the rule of
      ! Simpson for forces a degree apart, which leaves 2e-6 of the bearings' torque, lets it
      call check(error, all(abs(means(:, 2) - means(:, 3)) < abs(means(:, 1) - means(:, 3))/10.0_wp + 3.0e-6_wp*means(:, 3)), &
         & "torques are not of second order in the step")
   end subroutine test_order

   subroutine test_estimate(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, exact_case
      type(shaft_simulation_t) :: shaft, exact
      type(shaft_outcome_t) :: outcome, exact_outcome
      type(error_t), allocatable :: failure
      ! Sum of the errors met and of those estimated [N m]
      real(wp) :: met, estimated
      integer :: i

      call get_deck_case("decks/three_cam_head.nml", the_case, failure, "numerics.accuracy=1e-3")
      if (.not. allocated(failure)) call get_deck_case("decks/three_cam_head.nml", exact_case, failure, "numerics.accuracy=1e-8")
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call start_shaft(exact, exact_case, 0.0_wp, failure)
      met = 0.0_wp
      estimated = 0.0_wp
      do i = 1, 40
         if (.not. allocated(failure)) call advance_shaft(shaft, 0.15_wp*i, inputs_at(the_case, 0.15_wp*(i - 1), 0.05_wp), &
            & inputs_at(the_case, 0.15_wp*i, 0.05_wp), outcome, failure)
         if (.not. allocated(failure)) call advance_shaft(exact, 0.15_wp*i, inputs_at(the_case, 0.15_wp*(i - 1), 0.05_wp), &
            & inputs_at(the_case, 0.15_wp*i, 0.05_wp), exact_outcome, failure)
         if (has_failed(failure, error)) return
         met = met + abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive)
         estimated = estimated + outcome%estimated_error
      end do
      call check(error, met <= estimated, "errors are larger than estimated")
      if (allocated(error)) return
      ! an estimate that says nothing would be of the size of the torque
      call check(error, estimated < 1.0e-2_wp*40*exact_outcome%mean_torque_friction, "the estimate is of no use")
   end subroutine test_estimate

   !> A step is the difference of two rounded angles: with one node more or fewer from step to step the bearings' torque wanders.
   subroutine test_equal_turns(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(inputs_t) :: inputs
      type(shaft_outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Mean torque of the bearings over each turn [N m]
      real(wp) :: means(4)
      ! Steps of a turn
      integer, parameter :: steps = 90
      integer :: i, turns

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      inputs = inputs_at(the_case, 0.0_wp, 0.0_wp)
      means = 0.0_wp
      do turns = 0, size(means) - 1
         do i = 1, steps
            if (.not. allocated(failure)) call advance_shaft(shaft, (turns*steps + i)*4.0_wp*degree, inputs, inputs, outcome, &
               & failure)
            if (has_failed(failure, error)) return
            means(turns + 1) = means(turns + 1) + outcome%mean_torques(of_bearings)/steps
         end do
      end do
      call check_close(error, means(3), means(4), 1.0e-9_wp, "mean torque of the bearings")
      if (allocated(error)) return
      call check(error, all(part_number([1.0_wp - 1.0e-7_wp, 1.0_wp, 1.0_wp + 1.0e-7_wp, 1.01_wp, 0.0_wp]*2.0_wp*degree, &
         & 2.0_wp*degree) == [1, 1, 1, 2, 1]), "parts of a step depend on its rounding")
   end subroutine test_equal_turns

   !> A long step takes the forces on the cams at points of its own; steps of a degree take them from the states that they have.
   subroutine test_long_step(error)
      type(error_type), allocatable, intent(out) :: error
      ! Length of the step [degree]
      integer, parameter :: length = 50
      type(case_t) :: the_case
      type(shaft_simulation_t) :: long, short
      type(shaft_outcome_t) :: outcome, part
      type(inputs_t) :: inputs
      type(error_t), allocatable :: failure
      ! Mean torque of the bearings over the degrees [N m], cam angle [rad]
      real(wp) :: mean, from
      integer :: i, k

      call get_deck_case("decks/thesis.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(long, the_case, 0.0_wp, failure)
      inputs = inputs_at(the_case, 0.0_wp, 0.0_wp)
      do k = 1, 7
         from = shaft_angle(long)
         short = long
         if (.not. allocated(failure)) call advance_shaft(long, from + length*degree, inputs, inputs, outcome, failure)
         mean = 0.0_wp
         do i = 1, length
            if (.not. allocated(failure)) call advance_shaft(short, from + i*degree, inputs, inputs, part, failure)
            if (.not. allocated(failure)) mean = mean + part%mean_torques(of_bearings)/length
         end do
         if (has_failed(failure, error)) return
         ! Rules of a degree leave 7e-6 at most, at the ends of the event; forces one point late are off by 2e-3
         call check_close(error, outcome%mean_torques(of_bearings), mean, 1.0e-4_wp, "mean torque of the bearings")
         if (allocated(error)) return
      end do
   end subroutine test_long_step

   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Means and what the last step gave, for each number of threads [N m]
      real(wp) :: means(3), numbers(4, 3)
      ! The last one is more than any system has: no more are started than there are followers
      integer, parameter :: threads(3) = [1, 3, 1000000000]
      integer :: i

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      do i = 1, 3
         if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure, threads=threads(i))
         if (.not. allocated(failure)) call turn(shaft, the_case, 30, 1, 0.05_wp, means, failure, outcome)
         if (has_failed(failure, error)) return
         numbers(:, i) = [means, outcome%estimated_error]
      end do
      call check(error, all(same(numbers, spread(numbers(:, 1), 2, 3))), "bits depend on the number of threads")
      if (allocated(error)) return
      call start_shaft(shaft, the_case, 0.0_wp, failure, threads=0)
      call expect_error(error, failure, kind_usage, "start_shaft: the number of threads")
   end subroutine test_threads

   subroutine test_saved(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, other_case
      type(shaft_simulation_t) :: shaft, copy, restored
      type(shaft_outcome_t) :: outcome
      integer(int8), allocatable :: block(:)
      integer(int64), allocatable :: words(:), fewer(:)
      type(error_t), allocatable :: failure
      ! Means of the turn after [N m]
      real(wp) :: means(3, 3)

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.3_wp, failure)
      if (.not. allocated(failure)) call turn(shaft, the_case, 20, 1, 0.05_wp, means(:, 1), failure, outcome)
      if (.not. allocated(failure)) call save_shaft(shaft, block, failure)
      if (.not. allocated(failure)) call restore_shaft(restored, the_case, block, failure)
      if (has_failed(failure, error)) return
      copy = shaft
      call turn(shaft, the_case, 20, 1, 0.05_wp, means(:, 1), failure, outcome)
      if (.not. allocated(failure)) call turn(copy, the_case, 20, 1, 0.05_wp, means(:, 2), failure, outcome)
      if (.not. allocated(failure)) call turn(restored, the_case, 20, 1, 0.05_wp, means(:, 3), failure, outcome)
      if (has_failed(failure, error)) return
      call check(error, all(same(means(:, 1), means(:, 2))) .and. all(same(means(:, 1), means(:, 3))), "bits differ")
      if (allocated(error)) return
      ! the followers are the same; the bearings tell
      other_case = the_case
      other_case%cam_bearings%radial_clearance = 1.1_wp*other_case%cam_bearings%radial_clearance
      call restore_shaft(restored, other_case, block, failure)
      call expect_error(error, failure, kind_usage, "belongs to another case")
      if (allocated(error)) return
      call restore_shaft(restored, thesis_case(), block, failure)
      call expect_error(error, failure, kind_usage, "belongs to another case")
      if (allocated(error)) return
      ! a block without its last cam, whose checksum is right
      allocate (words(size(block)/8))
      words = transfer(block, words)
      fewer = [words(:3), 2_int64, words(5:5 + (size(words) - 6)/3*2), 0_int64]
      fewer(size(fewer)) = mixed(fewer(:size(fewer) - 1))
      call restore_shaft(restored, the_case, transfer(fewer, block), failure)
      call expect_error(error, failure, kind_usage, "another number of cams")
      if (allocated(error)) return
      call restore_shaft(restored, the_case, block, failure, threads=0)
      call expect_error(error, failure, kind_usage, "restore_shaft: the number of threads")
      if (allocated(error)) return
      block(60) = not(block(60))
      call restore_shaft(restored, the_case, block, failure)
      call check(error, index(failure%message, "damaged") > 0, "a damaged block was taken")
   end subroutine test_saved

   subroutine test_failure(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft, untouched
      type(shaft_outcome_t) :: outcome, expected
      type(inputs_t) :: inputs, hot
      type(error_t), allocatable :: failure
      ! Pressures of the cams [Pa]; means of the turn after [N m]
      real(wp) :: pressures(3, 2), means(3, 2)

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      untouched = shaft
      inputs = inputs_at(the_case, 0.0_wp, 0.0_wp)
      pressures = 1.0e5_wp
      pressures(3, 2) = ieee_value(1.0_wp, ieee_positive_inf)
      hot = inputs
      hot%oil_temperature = inputs%oil_temperature + 20.0_wp
      ! So short a step that the integration takes it in one: the next one starts where its last one did
      call advance_shaft(shaft, 0.01_wp, hot, hot, outcome, failure, pressures)
      call check(error, allocated(failure), "an infinite pressure was taken")
      if (allocated(error)) return
      call check(error, shaft_angle(shaft) <= 0.0_wp, "the shaft has moved")
      if (allocated(error)) return
      call advance_shaft(shaft, 0.01_wp, inputs, inputs, outcome, failure)
      if (.not. allocated(failure)) call advance_shaft(untouched, 0.01_wp, inputs, inputs, expected, failure)
      if (has_failed(failure, error)) return
      call check(error, all(same([outcome%torques, outcome%mean_torques, outcome%estimated_error], [expected%torques, &
         & expected%mean_torques, expected%estimated_error])), "a failed step has changed the next one")
      if (allocated(error)) return
      call turn(shaft, the_case, 20, 1, 0.05_wp, means(:, 1), failure, outcome)
      if (.not. allocated(failure)) call turn(untouched, the_case, 20, 1, 0.05_wp, means(:, 2), failure, outcome)
      if (has_failed(failure, error)) return
      call check(error, all(same(means(:, 1), means(:, 2))), "a failed step left something behind")
   end subroutine test_failure

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft, unstarted
      type(shaft_outcome_t) :: outcome
      type(inputs_t) :: inputs, still
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      inputs = inputs_at(the_case, 0.0_wp, 0.0_wp)
      still = inputs
      still%speed = 0.0_wp
      call start_shaft(shaft, the_case, 1.0_wp, failure)
      if (has_failed(failure, error)) return
      call advance_shaft(unstarted, 1.1_wp, inputs, inputs, outcome, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "start_shaft")
      call advance_shaft(shaft, 0.9_wp, inputs, inputs, outcome, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "backward")
      call advance_shaft(shaft, 1.0_wp, inputs, inputs, outcome, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "grow")
      call advance_shaft(shaft, 1.1_wp, inputs, still, outcome, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "halt")
      still%speed = -10.0_wp
      call advance_shaft(shaft, 1.1_wp, still, still, outcome, failure)
      if (.not. allocated(error)) call expect_error(error, failure, kind_usage, "positive")
      if (allocated(error)) return
      ! the way out of a standstill
      call halt_shaft(shaft)
      call advance_shaft(shaft, 1.1_wp, inputs, inputs, outcome, failure)
      if (has_failed(failure, error)) return
      call check(error, outcome%followers(1)%extremes%sliding_speed(2) > 0.5_wp*outcome%followers(1)%state%contact%rolling_speed, &
         & "the roller was not at rest")
   end subroutine test_refusals

   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(shaft_simulation_t) :: shaft
      type(shaft_outcome_t) :: outcome
      type(quantity_t), allocatable :: series(:)
      type(error_t), allocatable :: failure
      ! Phase of a cam [rad]; numbers of the camshafts and of a follower [unit of the series]; means of the turn [N m]
      real(wp) :: phase, means(3)
      real(wp), allocatable :: of_camshaft(:), of_cam(:)
      integer :: columns(2), lobe, camshaft

      call get_deck_case("decks/three_cam_head.nml", the_case, failure)
      if (.not. allocated(failure)) call start_shaft(shaft, the_case, 0.0_wp, failure)
      if (.not. allocated(failure)) call turn(shaft, the_case, 20, 1, 0.0_wp, means, failure, outcome)
      if (has_failed(failure, error)) return
      call list_series(the_case, series)
      columns = camshaft_columns(the_case)
      call shaft_values(shaft, 0, outcome, of_camshaft)
      call shaft_values(shaft, 2, outcome, of_cam)
      series = series(columns(1):columns(2))
      call check(error, abs(of_camshaft(find_quantity(series, "torque_drive")) - outcome%torque_drive) &
         & <= 100*epsilon(1.0_wp)*sum(abs(outcome%torques(:5))), "the drive torque has another value by its name")
      if (allocated(error)) return
      call check(error, same(of_camshaft(find_quantity(series, "torque_bearings")), outcome%torques(of_bearings)), &
         & "the bearings have another torque by their name")
      if (allocated(error)) return
      call list_series(the_case, series)
      call check(error, same(of_cam(find_quantity(series, "contact_load")), outcome%followers(2)%state%contact%load), &
         & "the second cam has another load by its name")
      if (allocated(error)) return
      call cam_place(shaft, 2, lobe, camshaft, phase)
      call check(error, same(phase, the_case%cam_bearings%cam_phases(2)) .and. lobe == 2 .and. camshaft == 1, &
         & "the second cam stands elsewhere")
   end subroutine test_names

end module test_shaft_simulation
