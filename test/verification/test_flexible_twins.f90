!> Flexible trains told in another way: in other units, as their mirror image that runs backwards, with room of an earlier piece.
module test_flexible_twins
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t, numerics_t
   use camroller_flexible_cycle, only : rest_of_train
   use camroller_flexible_drive, only : drive_t, drive_train
   use camroller_flexible_turn, only : integrate_turn, start_turns, turn_t
   use camroller_flexible_train, only : at_finger_rate, at_lift, at_speed, at_sliding, evaluate_train, first_mode, &
      & flexible_state_t, rates_of, resolution_t
   use camroller_kinematics, only : rotation_names
   use camroller_model, only : model_t
   use camroller_ode_problem, only : counters_t
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use camroller_trajectory, only : trajectory_t
   use case_twins, only : dimension_of_unit, leave_constants_out, rescale_case
   use closeness, only : check_scaled, has_failed
   use flexible_cases, only : add_dynamics, random_state, take_friction
   use reference_cases, only : make_model, set_point, skewed_case, thesis_case
   use result_checks, only : scalar_of
   use unit_systems, only : units_t, dimension_t, scaled, unit_systems_tried, length, number, pressure, speed, angular_speed
   implicit none
   private

   public :: collect_flexible_twins

   !> Systems of units that keep the unit of pressure: air and oil in an adjuster know that of the surroundings
   type(units_t), parameter :: same_pressure(*) = [ &
      & units_t(256.0_wp, 1.0_wp, 1.0_wp/16.0_wp, 1.0_wp), units_t(1.0_wp, 256.0_wp, 16.0_wp, 1.0_wp), &
      & units_t(1.0_wp/16.0_wp, 1.0_wp/16.0_wp, 1.0_wp, 1.0_wp)]

contains

   !> Collect the tests.
   subroutine collect_flexible_twins(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("rates of a flexible train in other units are the same rates", test_rates), &
         new_unittest("a periodic train in other units is the same train", test_periodic), &
         new_unittest("a turn, and its mirror image backwards, end where the turn began", test_return), &
         new_unittest("a piece in the room of the one before has the bits of one in room of its own", test_room) &
         ]
   end subroutine collect_flexible_twins

   !> By a method that begins a step with the one before where that ends in the same state.
   subroutine test_room(error)
      type(error_type), allocatable, intent(out) :: error
      ! Ends of two pieces [rad]
      real(wp), parameter :: ends(*) = [-1.5_wp, -1.45_wp, -1.4_wp]
      type(case_t) :: the_case
      type(model_t), target :: model
      type(drive_t) :: kept, fresh
      type(error_t), allocatable :: failure
      ! States at the end of each piece [state]; steps [rad]
      real(wp), allocatable :: one(:), other(:)
      real(wp) :: steps(2)
      type(numerics_t) :: numerics

      numerics = numerics_t(method="radau5", tolerance=1.0e-4_wp)
      the_case = thesis_case()
      call add_dynamics(the_case, 0, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call rest_of_train(model, one, failure)
      steps = 0.0_wp
      kept%turn%stops = ends(:2)
      if (.not. allocated(failure)) call drive_train(kept, model, numerics, 0.1_wp, one, steps(1), failure)
      other = one
      steps(2) = steps(1)
      kept%turn%stops = ends(2:)
      fresh%turn%stops = ends(2:)
      if (.not. allocated(failure)) call drive_train(kept, model, numerics, 0.1_wp, one, steps(1), failure)
      if (.not. allocated(failure)) call drive_train(fresh, model, numerics, 0.1_wp, other, steps(2), failure)
      if (has_failed(failure, error)) return
      call check(error, all(transfer(one, [0]) == transfer(other, [0])), "bits differ")
   end subroutine test_room

   subroutine test_rates(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(unit_systems_tried)
         call compare_rates(unit_systems_tried(i), .false., error)
         if (allocated(error)) return
      end do
      do i = 1, size(same_pressure)
         call compare_rates(same_pressure(i), .true., error)
         if (allocated(error)) return
      end do
   end subroutine test_rates

   !> Rates at random states in SI and in other units.
   subroutine compare_rates(units, has_adjuster, error)
      type(units_t), intent(in) :: units
      logical, intent(in) :: has_adjuster
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model, twin
      type(flexible_state_t) :: now, image
      type(dimension_t), allocatable :: dimensions(:)
      ! States and their rates over the cam angle [state]
      real(wp), allocatable :: state(:), rate(:), other(:), largest(:)
      real(wp) :: angle ! [rad]
      integer :: i, status, tried

      the_case = thesis_case()
      call add_dynamics(the_case, 2, has_adjuster)
      call leave_constants_out(the_case)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call rescale_case(the_case, units)
      call make_model(the_case, twin, error)
      if (allocated(error)) return
      dimensions = [number, angular_speed, length, speed, speed]
      if (has_adjuster) dimensions = [dimensions, length, speed, pressure]
      dimensions = [dimensions, length, speed, length, speed]
      allocate (state(size(dimensions)), rate(size(dimensions)), other(size(dimensions)), largest(size(dimensions)))
      largest = 0.0_wp
      tried = 0
      do i = 1, 60
         call random_state(model, i, angle, state)
         call evaluate_train(model, angle, state, resolution_t(), now, status)
         if (status /= 0) cycle
         call rates_of(model, state, now, rate)
         call evaluate_train(twin, angle, scaled(units, state, dimensions), resolution_t(), image, status)
         call check(error, status, 0)
         if (allocated(error)) return
         call rates_of(twin, scaled(units, state, dimensions), image, other)
         if (now%contact%load > 0.0_wp) tried = tried + 1
         largest = max(largest, abs(rate))
         ! Powers of 0.9 and 0.8 of units are rounded; the contact's stiffness makes 1e-9 m, of millimetres, out of it
         if (any(abs(other - scaled(units, rate, dimensions)) > 1.0e-9_wp*scaled(units, largest, dimensions))) then
            call test_failed(error, "a rate holds a constant with a dimension")
            return
         end if
      end do
      call check(error, tried > 15, "too few states in contact")
   end subroutine compare_rates

   !> What a tolerance is relative to is in SI; all else is the same, so results agree within the errors of both.
   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t), parameter :: units(*) = [units_t(4.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), units_t(1.0_wp, 4.0_wp, 0.5_wp, 1.0_wp)]
      character(len=*), parameter :: names(*) = [character(len=22) :: "dynamic_load_max", "lift_error_min", "seating_speed", &
         & "surge_force", "mean_torque_friction", "min_film_thickness_min", "max_sliding_speed"]
      character(len=*), parameter :: units_of(*) = [character(len=5) :: "N", "m", "m s-1", "N", "N m", "m", "m s-1"]
      ! Tolerance [-]; differences allowed over it, by the errors that tolerances leave of turns [-]. The joint's smallest force, a
      ! peak between the points that are looked at, is not among the names
      real(wp), parameter :: tolerance = 1.0e-6_wp, allowed = 30.0_wp
      type(case_t) :: the_case, twin
      type(result_t) :: one, other
      type(error_t), allocatable :: failure
      integer :: i, k

      the_case = thesis_case()
      call add_dynamics(the_case, 2, .false.)
      call set_point(the_case, 900.0_wp*pi/30.0_wp, 0.01_wp)
      call leave_constants_out(the_case)
      the_case%numerics = numerics_t(tolerance=tolerance)
      call run_case(the_case, one, failure)
      do i = 1, size(units)
         twin = the_case
         call rescale_case(twin, units(i))
         if (.not. allocated(failure)) call run_case(twin, other, failure)
         if (has_failed(failure, error)) return
         do k = 1, size(names)
            associate (expected => scaled(units(i), scalar_of(one, trim(names(k))), dimension_of_unit(trim(units_of(k)))))
               call check_scaled(error, scalar_of(other, trim(names(k))), expected, abs(expected), allowed*tolerance, &
                  & trim(names(k)))
            end associate
            if (allocated(error)) return
         end do
      end do
   end subroutine test_periodic

   !> Without dampers and friction motion can be turned back: in the mirror image of the cam the speeds change their signs, and the
   !> turn leads back to its start. The roller's spin, which friction alone changes, is left out.
   subroutine test_return(error)
      type(error_type), allocatable, intent(out) :: error
      ! Tolerance; way off allowed, over what a step's error is relative to: nothing damps the impacts on the seat, each of which
      ! multiplies an error: a turn and back leaves 3e-4 of the speed at 1e-8, and 1e-5 at 1e-10 [-]
      real(wp), parameter :: tolerance = 3.0e-11_wp, allowed = 1.0e-5_wp
      type(case_t) :: the_case
      type(model_t), target :: model, mirrored
      ! States at start and end [state]
      real(wp), allocatable :: start(:), state(:)
      type(error_t), allocatable :: failure

      the_case = skewed_case(rotation_names(1))
      call set_point(the_case, 900.0_wp*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      call take_friction(the_case, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      the_case%lift%table_angle = -the_case%lift%table_angle(size(the_case%lift%table_angle):1:-1)
      the_case%lift%table_lift = the_case%lift%table_lift(size(the_case%lift%table_lift):1:-1)
      the_case%mechanism%rotation = rotation_names(2)
      call make_model(the_case, mirrored, error)
      if (allocated(error)) return
      call rest_of_train(model, start, failure)
      state = start
      if (.not. allocated(failure)) call turn_once(model, failure)
      call reverse()
      if (.not. allocated(failure)) call turn_once(mirrored, failure)
      call reverse()
      if (has_failed(failure, error)) return
      call check_scaled(error, state(at_lift), start(at_lift), 1.0e-5_wp, allowed, "lift")
      if (allocated(error)) return
      call check_scaled(error, state(at_speed), start(at_speed), 0.1_wp, allowed, "speed of the valve")

   contains

      !> Integrate a turn from -pi.
      subroutine turn_once(train, trouble)
         type(model_t), target, intent(in) :: train
         type(error_t), allocatable, intent(out) :: trouble
         type(turn_t) :: turn
         type(trajectory_t) :: trajectory
         type(counters_t) :: counters

         call start_turns(turn, train, "rodas5p", tolerance, trouble)
         if (.not. allocated(trouble)) call integrate_turn(turn, state, trajectory, counters, trouble)
      end subroutine turn_once

      !> Let all speeds change their signs.
      subroutine reverse()
         state(at_finger_rate) = -state(at_finger_rate)
         state(at_speed) = -state(at_speed)
         state(at_sliding) = 0.0_wp
         state(first_mode(model) + 1::2) = -state(first_mode(model) + 1::2)
      end subroutine reverse

   end subroutine test_return

end module test_flexible_twins
