!> What a flexible train must keep: energy without dampers, accelerations where time runs backwards, results as tolerances shrink.
module test_flexible_invariance
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_flexible_cycle, only : flexible_cycle_t, find_periodic, rest_of_train
   use camroller_flexible_turn, only : integrate_turn, start_turns, turn_t
   use camroller_flexible_energy, only : stored_energy
   use camroller_flexible_measure_list, only : drive_torque, largest_load, measure_count, seating_speed, surge_force
   use camroller_flexible_measures, only : measure_turn
   use camroller_flexible_train, only : at_finger_rate, at_speed, evaluate_train, first_mode, &
      & flexible_state_t, resolution_t
   use camroller_kinematics, only : rotation_names
   use camroller_model, only : model_t
   use camroller_ode_problem, only : counters_t
   use camroller_trajectory, only : trajectory_t
   use closeness, only : check_scaled, has_failed
   use flexible_cases, only : add_dynamics, random_state, take_friction
   use reference_cases, only : make_model, set_point, skewed_case, thesis_case
   implicit none
   private

   public :: collect_flexible_invariance

contains

   subroutine collect_flexible_invariance(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("free vibration with opening contacts keeps its energy without dampers and loses it with them", &
            & test_conservation), &
         new_unittest("without dampers and friction, reversed time gives the same accelerations", test_reversal), &
         new_unittest("errors of a turn are within ten tolerances and fall with the tolerance", test_convergence), &
         new_unittest("steps end where the roller passes a kink of the lift, before or behind a rigid one", test_kinks) &
         ]
   end subroutine collect_flexible_invariance

   !> The lift has kinks at both ends of the event, and at the nose where its halves differ: a train that bends meets them at other
   !> cam angles than a rigid one, a step's length away from them or not.
   subroutine test_kinks(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(flexible_state_t) :: now
      type(error_t), allocatable :: failure
      real(wp), allocatable :: state(:)
      ! Cam angles that a rigid train has at the points, less the first and those less the kink [rad]
      real(wp), allocatable :: angles(:), ways(:)
      integer :: i, status, nearest

      the_case = thesis_case()
      the_case%lift%law = "polynomial_345"
      the_case%lift%closing_half_angle = 0.8_wp*the_case%lift%opening_half_angle
      call set_point(the_case, 100.0_wp, 0.01_wp)
      call add_dynamics(the_case, 1, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", 1.0e-4_wp, failure)
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (.not. allocated(failure)) call integrate_turn(turn, state, trajectory, counters, failure)
      if (has_failed(failure, error)) return
      allocate (angles(trajectory%count))
      do i = 1, trajectory%count
         call evaluate_train(model, trajectory%time(i), trajectory%state(:, i), resolution_t(), now, status)
         angles(i) = now%touch%angle
      end do
      call check(error, size(model%lift_stops), 3, "kinks of the lift")
      if (allocated(error)) return
      do i = 1, size(model%lift_stops)
         ways = abs(angles - model%lift_stops(i))
         nearest = minloc(ways, 1)
         call check(error, ways(nearest) < 1.0e-3_wp*maxval(ways(nearest - 1:nearest + 1)), "no step ends at a kink")
         if (allocated(error)) return
         call check(error, abs(trajectory%time(nearest) - model%lift_stops(i)) > 1.0e-6_wp, "the train does not bend")
         if (allocated(error)) return
      end do
   end subroutine test_kinks

   !> Ten milliseconds on the base circle after the valve was struck: change of the energy over that of the vibration.
   subroutine pluck(has_dampers, tolerance, change, has_opened, error)
      logical, intent(in) :: has_dampers
      !> Tolerance [-]
      real(wp), intent(in) :: tolerance
      !> Change [-]
      real(wp), intent(out) :: change
      !> Has cam and roller, and pad, parted?
      logical, intent(out) :: has_opened
      type(error_type), allocatable, intent(out) :: error

      ! Speed of the cam [rad/s], time [s], speed of the valve [m/s]
      real(wp), parameter :: speed = 100.0_wp, time = 1.0e-2_wp, struck = 0.5_wp
      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(flexible_state_t) :: now
      type(error_t), allocatable :: failure
      ! State [state], energies at rest, struck and afterwards [J]
      real(wp), allocatable :: state(:)
      real(wp) :: energies(0:2)
      integer :: i, status

      change = huge(1.0_wp)
      has_opened = .false.
      the_case = thesis_case()
      call set_point(the_case, speed, 0.01_wp)
      call add_dynamics(the_case, 5, .false.)
      call take_friction(the_case, has_dampers)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", tolerance, failure)
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (has_failed(failure, error)) return
      turn%stops = [-pi, -pi + speed*time]
      energies(0) = energy_of(-pi, state)
      state(at_speed) = struck
      energies(1) = energy_of(-pi, state)
      call integrate_turn(turn, state, trajectory, counters, failure)
      if (has_failed(failure, error)) return
      energies(2) = energy_of(-pi + speed*time, state)
      change = abs(energies(2) - energies(1))/(energies(1) - energies(0))
      do i = 1, trajectory%count
         call evaluate_train(model, trajectory%time(i), trajectory%state(:, i), resolution_t(), now, status)
         has_opened = has_opened .or. (now%cam%elastic <= 0.0_wp .and. now%pad%elastic <= 0.0_wp)
      end do

   contains

      !> Energy that is stored [J].
      function energy_of(angle, state) result(energy)
         real(wp), intent(in) :: angle, state(:)
         real(wp) :: energy

         call evaluate_train(model, angle, state, resolution_t(), now, status)
         energy = stored_energy(model, state, now)
      end function energy_of

   end subroutine pluck

   subroutine test_conservation(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: change ! [-]
      logical :: has_opened
      integer :: i

      ! The error allowed in a step is a tolerance of 0.1 m/s, of 0.5 m/s that were struck: 0.4 tolerances of the energy; 1200 to
      ! 4400 steps whose errors are independent add up to 14 to 26 of them. Sixty runs, speeds that differ by 1e-6 and tolerances
      ! of 1e-4 to 1e-8, have a standard deviation of 19 tolerances: three of these
      do i = 4, 8, 2
         call pluck(.false., 10.0_wp**(-i), change, has_opened, error)
         if (allocated(error)) return
         call check(error, has_opened, "cam and pad were to open")
         if (allocated(error)) return
         call check_scaled(error, change, 0.0_wp, 10.0_wp**(-i), 60.0_wp, "energy")
         if (allocated(error)) return
      end do
      call pluck(.true., 1.0e-4_wp, change, has_opened, error)
      if (allocated(error)) return
      call check(error, change > 0.5_wp, "dampers were to take most of the energy")
   end subroutine test_conservation

   subroutine test_reversal(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t) :: model, mirrored
      type(flexible_state_t) :: now, image
      ! State and its image [state], cam angle [rad]
      real(wp) :: state(9), reversed(9), angle
      integer :: i, status, tried

      the_case = skewed_case(rotation_names(1))
      call add_dynamics(the_case, 2, .false.)
      call take_friction(the_case, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      the_case%lift%table_angle = -the_case%lift%table_angle(size(the_case%lift%table_angle):1:-1)
      the_case%lift%table_lift = the_case%lift%table_lift(size(the_case%lift%table_lift):1:-1)
      the_case%mechanism%rotation = rotation_names(2)
      call make_model(the_case, mirrored, error)
      if (allocated(error)) return
      tried = 0
      do i = 1, 200
         call random_state(model, i, angle, state)
         reversed = state
         reversed(at_finger_rate) = -state(at_finger_rate)
         reversed(at_speed) = -state(at_speed)
         reversed(first_mode(model) + 1::2) = -state(first_mode(model) + 1::2)
         call evaluate_train(model, angle, state, resolution_t(), now, status)
         if (status /= 0) cycle
         call evaluate_train(mirrored, -angle, reversed, resolution_t(), image, status)
         call check(error, status, 0)
         if (allocated(error)) return
         if (now%contact%load > 0.0_wp) tried = tried + 1
         call check_scaled(error, image%contact%load, now%contact%load, 1.0e3_wp, 1.0e-9_wp, "load")
         if (allocated(error)) return
         ! the spline of the mirrored table is that of the table but for round-off in its second derivative
         call check_scaled(error, image%valve_acceleration, now%valve_acceleration, 1.0e4_wp, 1.0e-8_wp, "valve")
         if (allocated(error)) return
         call check_scaled(error, image%finger_acceleration, now%finger_acceleration, 1.0e6_wp, 1.0e-8_wp, "finger")
         if (allocated(error)) return
      end do
      call check(error, tried > 50, "too few states in contact")
   end subroutine test_reversal

   !> Largest load, torque, surge and seating of the periodic turn.
   subroutine measure(tolerance, values, error)
      !> Tolerance [-]
      real(wp), intent(in) :: tolerance
      !> The measures, each over its size [-]
      real(wp), intent(out) :: values(4)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      type(flexible_cycle_t) :: cycle
      type(error_t), allocatable :: failure
      real(wp), allocatable :: state(:), measures(:) ! [state], [unit of the measure]

      values = 0.0_wp
      the_case = thesis_case()
      call set_point(the_case, 1500.0_wp*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, 5, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", tolerance, failure)
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (.not. allocated(failure)) call find_periodic(cycle, turn, state, 0.1_wp*tolerance, 60, failure)
      allocate (measures(measure_count(1)))
      if (.not. allocated(failure)) call measure_turn(model, cycle%trajectory, cycle%resolution, measures, failure)
      if (has_failed(failure, error)) return
      values = [measures(largest_load)/700.0_wp, measures(drive_torque)/0.02_wp, measures(surge_force)/10.0_wp, &
         & measures(seating_speed)/0.1_wp]
   end subroutine measure

   subroutine test_convergence(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: reference(4), values(4), largest(3) ! [-]
      integer :: i

      call measure(1.0e-7_wp, reference, error)
      if (allocated(error)) return
      do i = 1, 3
         call measure(10.0_wp**(-2 - i), values, error)
         if (allocated(error)) return
         largest(i) = maxval(abs(values - reference))
      end do
      ! A step's error per component becomes as large an error of these within a factor of ten; it falls with the tolerance
      do i = 1, 3
         call check_scaled(error, largest(i), 0.0_wp, 10.0_wp**(-2 - i), 10.0_wp, "largest error")
         if (allocated(error)) return
      end do
      call check(error, largest(3) < 0.1_wp*largest(1), "errors were to fall tenfold with two decades of the tolerance")
   end subroutine test_convergence

end module test_flexible_invariance
