!> A follower driven from outside: what is refused, and what a refusal or a failure leaves.
module test_simulation_faults
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_positive_inf
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller, only : wp, pi, degree, error_t, case_t, numerics_t, result_t, simulation_t, outcome_t, run_case, &
      & start_simulation, advance, kind_usage, kind_deck, kind_domain, kind_convergence, deck_t, inputs_t, make_case, &
      & override_t, quantity_t, &
      & find_quantity, restore_simulation, run_sweep, save_simulation, simulation_angle, simulation_series, simulation_values, &
      & sweep_options_t, sweep_report_t
   use closeness, only : expect_error, has_failed
   use deck_cases, only : get_deck_case
   use reference_cases, only : thesis_case
   use test_simulation, only : tight_case
   implicit none
   private

   public :: collect_simulation_faults

contains

   subroutine collect_simulation_faults(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the second lobe shape can be driven, and one that the case lacks is refused", test_lobe), &
         new_unittest("backward steps and impossible angles or operating points are refused", test_refusal), &
         new_unittest("after a failed step the follower continues with the same bits as without it", test_failed_step), &
         new_unittest("after a failed step the values by name and the saved bytes are those before it", test_values_stay), &
         new_unittest("steps are errors where the case forbids lost contact or a film law outside its range", test_policies), &
         new_unittest("values, decks and sweeps of nothing are errors", test_nothing), &
         new_unittest("a step in which the usual method gets nowhere is taken by another, as in a run", test_fallback), &
         new_unittest("the torque of the shortest possible step is that at its angle", test_smallest_step), &
         new_unittest("numerics of a case built without a deck are checked in runs and simulations", test_numerics) &
         ]
   end subroutine collect_simulation_faults

   subroutine test_lobe(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: both, second
      type(simulation_t) :: simulation, alone
      type(outcome_t) :: outcome, expected
      type(error_t), allocatable :: failure
      integer :: i

      second = tight_case()
      second%lift%max_lift = 0.8_wp*second%lift%max_lift
      both = tight_case()
      both%second_lift = second%lift
      call start_simulation(simulation, both, 2.0_wp, failure, lobe=2)
      if (.not. allocated(failure)) call start_simulation(alone, second, 2.0_wp, failure)
      do i = 1, 6
         if (.not. allocated(failure)) call advance(simulation, 2.0_wp + 0.3_wp*i, 31.0_wp, 330.0_wp, outcome, failure)
         if (.not. allocated(failure)) call advance(alone, 2.0_wp + 0.3_wp*i, 31.0_wp, 330.0_wp, expected, failure)
         if (has_failed(failure, error)) return
         call check(error, is_same(outcome, expected), "not the follower of the second lift")
         if (allocated(error)) return
      end do
      do i = 0, 3, 3
         call start_simulation(simulation, both, 2.0_wp, failure, lobe=i)
         call expect(error, failure, kind_usage, "lobe")
         if (allocated(error)) return
      end do
      call start_simulation(simulation, second, 2.0_wp, failure, lobe=2)
      call expect(error, failure, kind_usage, "second_lift")
   end subroutine test_lobe

   !> An error of a kind whose message has a word.
   subroutine expect(error, failure, kind, word)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable, intent(in) :: failure
      integer, intent(in) :: kind
      character(len=*), intent(in) :: word

      call expect_error(error, failure, kind, word)
   end subroutine expect

   !> Are all numbers of two steps the same, bit by bit?
   pure function is_same(one, other) result(same)
      type(outcome_t), intent(in) :: one, other
      logical :: same

      same = all(transfer(numbers(one), [0_int64]) == transfer(numbers(other), [0_int64])) .and. &
         & (one%state%contact%is_touching .eqv. other%state%contact%is_touching)
   end function is_same

   !> All numbers of a step [any]
   pure function numbers(outcome) result(values)
      type(outcome_t), intent(in) :: outcome
      real(wp), allocatable :: values(:)

      values = [outcome%mean_torque_drive, outcome%torque_drive, outcome%mean_torque_friction, outcome%torque_friction]
      associate (state => outcome%state, contact => outcome%state%contact)
         values = [values, state%position%lift, state%position%lift_slope, state%position%equivalent_radius, &
            & state%moments%total, state%gas_force, state%spin_acceleration, state%boundary_friction, state%contact_friction, &
            & state%torques, state%torque_friction, state%torque_drive]
         values = [values, contact%cam_surface_speed, contact%roller_surface_speed, contact%rolling_speed, &
            & contact%sliding_speed, contact%entrainment_speed, contact%roller_spin, contact%relative_spin, contact%load, &
            & contact%half_width, contact%apparent_area, contact%film_min, contact%film_central, contact%film_ratio, &
            & contact%asperity_load, contact%real_area, contact%shear, contact%boundary_capacity, &
            & contact%boundary_mobilised, contact%rolling_resistance, contact%traction, contact%traction_slope, &
            & contact%tangential_force, contact%bearing_torque]
      end associate
   end function numbers

   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Not a number, infinity, a turn
      real(wp) :: nan, infinity, turn
      integer :: i

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      infinity = ieee_value(1.0_wp, ieee_positive_inf)
      turn = 2.0_wp*pi
      ! a start that cannot be
      do i = 1, 3
         call start_simulation(simulation, tight_case(), merge(nan, merge(infinity, -1.0e7_wp*turn, i == 2), i == 1), failure)
         call expect(error, failure, kind_usage, "cam angle")
         if (allocated(error)) return
      end do
      call start_simulation(simulation, tight_case(), 1.0_wp, failure)
      call try(1.0_wp, 31.0_wp, 330.0_wp, "grow")
      if (.not. allocated(error)) call try(0.9_wp, 31.0_wp, 330.0_wp, "grow")
      if (.not. allocated(error)) call try(nan, 31.0_wp, 330.0_wp, "cam angle")
      if (.not. allocated(error)) call try(infinity, 31.0_wp, 330.0_wp, "cam angle")
      if (.not. allocated(error)) call try(1.0_wp + 1.0e-13_wp*degree, 31.0_wp, 330.0_wp, "at least")
      if (.not. allocated(error)) call try(1.0_wp + 101.0_wp*turn, 31.0_wp, 330.0_wp, "turns")
      if (.not. allocated(error)) call try(1.0e7_wp*turn, 31.0_wp, 330.0_wp, "turns")
      if (.not. allocated(error)) call try(1.5_wp, -31.0_wp, 330.0_wp, "speed")
      if (.not. allocated(error)) call try(1.5_wp, 0.0_wp, 330.0_wp, "speed")
      if (.not. allocated(error)) call try(1.5_wp, nan, 330.0_wp, "speed")
      if (.not. allocated(error)) call try(1.5_wp, infinity, 330.0_wp, "speed")
      if (.not. allocated(error)) call try(1.5_wp, 31.0_wp, nan, "temperature")
      if (.not. allocated(error)) call try(1.5_wp, 31.0_wp, infinity, "temperature")
      if (.not. allocated(error)) call try(1.5_wp, 31.0_wp, 0.0_wp, "temperature")
      ! degrees Celsius
      if (.not. allocated(error)) call try(1.5_wp, 31.0_wp, 180.0_wp, "kelvin")
      if (allocated(error)) return
      call advance(simulation, 1.1_wp, 31.0_wp, 330.0_wp, outcome, failure)
      call check(error, .not. allocated(failure), "the follower is of no use after a refusal")

   contains

      subroutine try(angle, speed, temperature, word)
         ! Cam angle [rad], speed [rad/s], temperature [K]
         real(wp), intent(in) :: angle, speed, temperature
         character(len=*), intent(in) :: word

         call advance(simulation, angle, speed, temperature, outcome, failure)
         call check(error, allocated(failure), "accepted, no error about "//word)
         if (allocated(error)) return
         call check(error, index(failure%message, word) > 0, failure%message)
         if (allocated(error)) return
         call check(error, failure%kind == kind_usage .or. failure%kind == kind_deck, failure%message)
      end subroutine try

   end subroutine test_refusal

   !> Every kind of failure: refused angle, refused speed, refused temperature, and an integration that gets through the
   !> base circle, the first of the two pieces that the step is cut into, and not through the event.
   subroutine test_failed_step(error)
      type(error_type), allocatable, intent(out) :: error
      ! End [rad], speed [rad/s] and temperature [K] of the steps that fail
      real(wp), parameter :: failing(3, 4) = reshape([ &
         & 4.0_wp, 31.0_wp, 330.0_wp, &
         & 4.8_wp, -31.0_wp, 330.0_wp, &
         & 4.8_wp, 40.0_wp, 100.0_wp, &
         & 9.2_wp, 1.0e10_wp, 330.0_wp], [3, 4])
      ! What each is refused with
      integer, parameter :: kinds(4) = [kind_usage, kind_usage, kind_usage, kind_convergence]
      character(len=*), parameter :: words(4) = [character(len=9) :: "angle", "speed", "kelvin", "step size"]
      type(case_t) :: the_case
      type(simulation_t) :: simulation, other
      type(outcome_t) :: outcome, expected
      type(error_t), allocatable :: failure
      integer :: i, step

      the_case = cold_case()
      the_case%numerics%method = "dormand_prince"
      ! the smaller, the longer it takes until a step has failed
      the_case%numerics%tolerance = 1.0e-5_wp
      do i = 1, size(failing, 2)
         call start_simulation(simulation, the_case, 1.0_wp, failure)
         if (.not. allocated(failure)) call start_simulation(other, the_case, 1.0_wp, failure)
         if (.not. allocated(failure)) call advance(simulation, 4.5_wp, 31.0_wp, 330.0_wp, outcome, failure)
         if (.not. allocated(failure)) call advance(other, 4.5_wp, 31.0_wp, 330.0_wp, expected, failure)
         if (allocated(failure)) exit
         call advance(simulation, failing(1, i), failing(2, i), failing(3, i), outcome, failure)
         call expect_error(error, failure, kinds(i), trim(words(i)))
         if (allocated(error)) return
         deallocate (failure)
         do step = 1, 3
            if (.not. allocated(failure)) call advance(simulation, 4.5_wp + 0.2_wp*step, 31.0_wp, 330.0_wp, outcome, failure)
            if (.not. allocated(failure)) call advance(other, 4.5_wp + 0.2_wp*step, 31.0_wp, 330.0_wp, expected, failure)
            if (allocated(failure)) exit
            call check(error, is_same(outcome, expected), "a failed step leaves something moved")
            if (allocated(error)) return
         end do
      end do
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine test_failed_step

   !> A case whose oil has no viscosity where it is very cold.
   function cold_case() result(the_case)
      type(case_t) :: the_case

      the_case = tight_case()
      the_case%lubricant%temperature_law = "vogel"
      the_case%lubricant%temperature_points = [313.15_wp, 343.15_wp, 373.15_wp]
      the_case%lubricant%viscosity_points = [0.08_wp, 0.025_wp, 0.011_wp]
   end function cold_case

   !> The model has followed speed and oil of the step that fails, and is put back.
   subroutine test_values_stay(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(simulation_t) :: simulation, restored
      type(outcome_t) :: outcome, failed
      type(inputs_t) :: ends(2)
      type(error_t), allocatable :: failure
      integer(int8), allocatable :: block(:), again(:)
      ! Numbers of the follower before and after [unit of the series]
      real(wp), allocatable :: before(:), after(:)
      type(quantity_t), allocatable :: series(:)

      the_case = cold_case()
      ends = [inputs_t(31.0_wp, 330.0_wp), inputs_t(35.0_wp, 340.0_wp)]
      call start_simulation(simulation, the_case, 1.0_wp, failure)
      if (.not. allocated(failure)) call advance(simulation, 2.8_wp, ends(1), ends(2), outcome, failure)
      if (.not. allocated(failure)) call save_simulation(simulation, block, failure)
      if (.not. allocated(failure)) call simulation_values(simulation, the_case, outcome, before, failure)
      if (has_failed(failure, error)) return
      call advance(simulation, 3.0_wp, inputs_t(70.0_wp, 330.0_wp), inputs_t(80.0_wp, 50.0_wp), failed, failure)
      call expect_error(error, failure, kind_usage, "kelvin")
      if (allocated(error)) return
      call save_simulation(simulation, again, failure)
      call simulation_values(simulation, the_case, outcome, after, failure)
      call check(error, all(block == again), "the saved bytes differ after a failed step")
      if (allocated(error)) return
      call check(error, all(transfer(before, [0_int64]) == transfer(after, [0_int64])), "values differ after a failed step")
      if (allocated(error)) return
      call simulation_series(the_case, series)
      associate (velocity => before(find_quantity(series, "valve_velocity")))
         call check(error, size(series) == size(before) .and. abs(velocity) > 0.0_wp, "values have no names")
      end associate
      if (allocated(error)) return
      call check(error, abs(simulation_angle(simulation) - 2.8_wp) <= 0.0_wp, "the follower has moved")
      if (allocated(error)) return
      call restore_simulation(restored, the_case, block, failure)
      call save_simulation(restored, again, failure)
      call check(error, all(block == again), "a block that is restored is saved with other bytes")
   end subroutine test_values_stay

   !> Contact is lost near 158 degrees, and by the flexible train near 160; the film law is left at 243 degrees, as runs say. Steps
   !> before have the bits of those of a case that only warns, and the step that fails moves nothing.
   subroutine test_policies(error)
      type(error_type), allocatable, intent(out) :: error

      call try("decks/thesis.nml", "contact_policy", 6000.0_wp, [140.0_wp, 155.0_wp, 159.0_wp])
      if (.not. allocated(error)) call try("decks/thesis.nml", "range_policy", 300.0_wp, [150.0_wp, 240.0_wp, 245.0_wp])
      if (.not. allocated(error)) call try("decks/dynamics.nml", "contact_policy", 5500.0_wp, [60.0_wp, 120.0_wp, 360.0_wp])

   contains

      subroutine try(path, policy, speed, angles)
         character(len=*), intent(in) :: path, policy
         ! Speed [rev/min]; where it starts, until when nothing is forbidden, by when it is [deg]
         real(wp), intent(in) :: speed, angles(3)
         type(case_t) :: cases(2)
         type(simulation_t) :: followers(2), before
         type(outcome_t) :: outcomes(2)
         type(error_t), allocatable :: failure
         ! Cam angle [deg]
         real(wp) :: angle
         integer :: i

         do i = 1, 2
            call get_deck_case(path, cases(i), failure)
            if (allocated(failure)) exit
            cases(i)%operating_point%speed = speed*pi/30.0_wp
            if (i == 1 .and. policy == "contact_policy") cases(i)%contact_policy = "stop"
            if (i == 1 .and. policy == "range_policy") cases(i)%film%range_policy = "stop"
            call start_simulation(followers(i), cases(i), angles(1)*degree, failure)
            if (allocated(failure)) exit
         end do
         angle = angles(1)
         do while (angle < angles(3) .and. .not. allocated(failure))
            angle = angle + 1.0_wp
            before = followers(1)
            do i = 2, 1, -1
               if (.not. allocated(failure)) call advance(followers(i), angle*degree, cases(i)%operating_point%speed, &
                  & cases(i)%operating_point%oil_temperature, outcomes(i), failure)
            end do
            if (allocated(failure)) exit
            call check(error, is_same(outcomes(1), outcomes(2)), "the policy changes bits: "//policy)
            if (allocated(error)) return
         end do
         call expect(error, failure, kind_domain, policy)
         if (allocated(error)) return
         call check(error, angle > angles(2), "forbidden too early: "//failure%message)
         if (allocated(error)) return
         call check(error, same_bytes(before, followers(1)), "a step that is forbidden has moved the follower")
      end subroutine try

   end subroutine test_policies

   !> Do two followers have the same block?
   logical function same_bytes(one, other)
      type(simulation_t), intent(in) :: one, other
      integer(int8), allocatable :: blocks(:, :), block(:)
      type(error_t), allocatable :: failure

      call save_simulation(one, block, failure)
      allocate (blocks(size(block), 2))
      blocks(:, 1) = block
      call save_simulation(other, block, failure)
      blocks(:, 2) = block
      same_bytes = all(blocks(:, 1) == blocks(:, 2))
   end function same_bytes

   subroutine test_nothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(override_t) :: none(0)
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome, failed
      type(sweep_options_t) :: options
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure
      ! Numbers of a follower [unit of the series]
      real(wp), allocatable :: values(:)

      call make_case(deck, none, the_case, failure)
      call expect(error, failure, kind_usage, "read_deck")
      if (allocated(error)) return
      call run_sweep(deck, "nothing.h5", options, report, failure)
      call expect(error, failure, kind_usage, "read_deck")
      if (allocated(error)) return
      call simulation_values(simulation, the_case, outcome, values, failure)
      call expect(error, failure, kind_usage, "start_simulation")
      if (allocated(error)) return
      the_case = cold_case()
      call start_simulation(simulation, the_case, 1.0_wp, failure)
      call simulation_values(simulation, the_case, outcome, values, failure)
      call expect(error, failure, kind_usage, "that of a step")
      if (.not. allocated(error)) call check(error, size(values) == 0, "an outcome of no step has values")
      if (allocated(error)) return
      call advance(simulation, 1.1_wp, inputs_t(70.0_wp, 330.0_wp), inputs_t(80.0_wp, 50.0_wp), failed, failure)
      call check(error, allocated(failure), "a step that should fail does not")
      if (allocated(error)) return
      call simulation_values(simulation, the_case, failed, values, failure)
      call expect(error, failure, kind_usage, "that of a step")
   end subroutine test_nothing

   !> At this tolerance rounding keeps the usual method from some of these steps.
   subroutine test_fallback(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: tolerances(2) = [character(len=24) :: "numerics.tolerance=1e-8", "numerics.tolerance=1e-12"]
      integer, parameter :: steps = 36
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Mean friction torque of a turn at each tolerance [N m]
      real(wp) :: means(2)
      integer :: i, k

      means = 0.0_wp
      do k = 1, 2
         call get_deck_case("decks/hard/narrow_contact.nml", the_case, failure, trim(tolerances(k)))
         if (.not. allocated(failure)) call start_simulation(simulation, the_case, 0.0_wp, failure)
         do i = 1, steps
            if (.not. allocated(failure)) call advance(simulation, 2.0_wp*pi*i/steps, the_case%operating_point%speed, &
               & the_case%operating_point%oil_temperature, outcome, failure)
            if (has_failed(failure, error)) return
            means(k) = means(k) + outcome%mean_torque_friction/steps
         end do
      end do
      ! some hundred steps of the larger tolerance
      call check(error, abs(means(1) - means(2)) < 1.0e-6_wp*means(2), "mean friction depends on who takes the steps")
   end subroutine test_fallback

   !> From near zero and from many turns away, with a method of each family.
   subroutine test_smallest_step(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: methods(*) = [character(len=16) :: "automatic", "rodas5p", "radau5", "dormand_prince"]
      ! Cam angles to start from [rad]
      real(wp), parameter :: starts(*) = [0.0_wp, 3.0_wp, 6000.0_wp]
      type(case_t) :: the_case
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Step [rad]
      real(wp) :: step
      integer :: i, j

      the_case = thesis_case()
      the_case%numerics = numerics_t()
      do i = 1, size(methods)
         do j = 1, size(starts)
            the_case%numerics%method = methods(i)
            call start_simulation(simulation, the_case, starts(j), failure)
            if (allocated(failure)) exit
            ! the message says how long a step must be: a million spacings of the angle and half a turn
            step = 1.0e6_wp*spacing(starts(j) + pi)
            call advance(simulation, starts(j) + 0.9_wp*step, 31.0_wp, 330.0_wp, outcome, failure)
            call expect(error, failure, kind_usage, "at least")
            if (allocated(error)) return
            call advance(simulation, starts(j) + 1.1_wp*step, 31.0_wp, 330.0_wp, outcome, failure)
            if (allocated(failure)) exit
            ! stored energy is some joules, known to 1e-16 of that, and a torque of 0.01 N m does 1e-11 J in a step of 1e-9 rad
            call check(error, abs(outcome%mean_torque_friction - outcome%torque_friction) < 1.0e-3_wp*outcome%torque_friction, &
               & "mean friction of a step without length")
            if (allocated(error)) return
            call check(error, abs(outcome%mean_torque_drive - outcome%torque_drive) < 1.0e-3_wp*abs(outcome%torque_drive), &
               & "mean torque of a step without length")
            if (allocated(error)) return
         end do
      end do
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine test_smallest_step

   subroutine test_numerics(error)
      type(error_type), allocatable, intent(out) :: error
      ! What is wrong with each, and the word that its message must have
      character(len=*), parameter :: words(*) = [character(len=12) :: "method", "accuracy", "accuracy", "accuracy", "tolerance", &
         & "tolerance", "step", "step", "periodicity", "max_cycles", "output_step", "output_step", "output_step"]
      type(case_t) :: the_case
      type(result_t) :: result
      type(simulation_t) :: simulation
      type(error_t), allocatable :: failure
      ! Not a number
      real(wp) :: nan
      integer :: i

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      do i = 1, size(words)
         the_case = thesis_case()
         the_case%numerics = numerics_t()
         associate (numerics => the_case%numerics)
            select case (i)
            case (1)
               numerics%method = "no_such"
            case (2:4)
               numerics%accuracy = merge(nan, merge(-1.0e-4_wp, 0.0_wp, i == 2), i == 4)
            case (5, 6)
               numerics%tolerance = merge(-1.0e-4_wp, nan, i == 5)
            case (7, 8)
               numerics%step = merge(0.0_wp, 4.0_wp, i == 7)
            case (9)
               numerics%periodicity = 0.0_wp
            case (10)
               numerics%max_cycles = 0
            case (11:13)
               numerics%output_step = merge(nan, merge(-degree, 7.0_wp*degree, i == 11), i == 13)
            end select
         end associate
         call run_case(the_case, result, failure)
         call expect(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
         call start_simulation(simulation, the_case, 0.0_wp, failure)
         call expect(error, failure, kind_deck, trim(words(i)))
         if (allocated(error)) return
      end do
      ! a run tells how wrong these are, a step would not
      do i = 1, 2
         the_case%numerics = numerics_t(method=merge("quasi_static", "euler       ", i == 1))
         call start_simulation(simulation, the_case, 0.0_wp, failure)
         call expect(error, failure, kind_usage, trim(the_case%numerics%method))
         if (allocated(error)) return
      end do
   end subroutine test_numerics

end module test_simulation_faults
