!> Boundary friction as true stick-slip: the limit of the regularised law, at rest where friction can hold, closed in energy.
module test_stick_slip
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_cycle, only : cycle_t, state_at, integrate_cycle
   use camroller_stick, only : rates_at_rest
   use camroller_means, only : integrate_torques
   use camroller_simulation, only : simulation_t, outcome_t, start_simulation, advance
   use camroller_spin, only : rolling_speed_slope
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_cubic, append_curve, append_until, interpolate_state
   use camroller_torque_list, only : torque_count, is_loss, of_residual
   use closeness, only : check_scaled, expect_error, has_failed
   use reference_cases, only : thesis_case, set_point, make_model, make_cycle, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_stick_slip

   !> Angles at which cycles are looked at
   integer, parameter :: angle_count = 720
   !> Mobilising speeds: 1e-3 to 1e-6 m/s
   integer, parameter :: first_power = 3, last_power = 6
   !> Residual of the energy allowed, relative to the mean power lost [-]: as for regularised friction
   real(wp), parameter :: residual_tolerance = 1.0e-10_wp

   !> What is compared of a cycle
   type :: sample_t
      !> Sliding speed [m/s], mobilised boundary friction and all there is [N], dV_s/dtheta [m/s/rad]
      real(wp) :: sliding_speed(angle_count), mobilised(angle_count), capacity(angle_count), rate(angle_count)
      !> Largest energy residual over the mean power lost [-], mean torque of the losses [N m]
      real(wp) :: residual, torque
   end type sample_t

contains

   subroutine collect_stick_slip(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("regularised friction tends to stick-slip where the roller sticks all the time", test_limit_sticking), &
         new_unittest("regularised friction tends to stick-slip where the roller sticks and slides", test_limit_both), &
         new_unittest("energy closes at every angle, sticking or sliding", test_energy), &
         new_unittest("a sticking roller needs no more than the friction limit, a sliding one has all of it", test_law), &
         new_unittest("sticking and sliding alternate, and change where friction reaches its limit or slip ends", test_phases), &
         new_unittest("a second cycle repeats the first", test_periodic), &
         new_unittest("asperities that do not touch change nothing", test_no_asperities), &
         new_unittest("a cold roller slides all the time, as with a very small mobilising speed", test_cold), &
         new_unittest("results do not depend on the mobilising speed", test_no_speed), &
         new_unittest("a follower driven angle by angle sticks and slides as in its cycle", test_driven), &
         new_unittest("a trajectory that is cut off keeps its curve up to the cut", test_cut), &
         new_unittest("stick-slip with fixed steps or the quasi-static method is refused", test_refused) &
         ]
   end subroutine collect_stick_slip

   !> Thesis point at 300 rev/min and 95 degC, integrated tightly enough to see the smallest mobilising speed.
   function sticking_case() result(case)
      type(case_t) :: case

      case = thesis_case()
      case%numerics%method = "rodas5p"
      case%numerics%tolerance = 1.0e-7_wp
      case%asperity%mobilisation = "stick_slip"
   end function sticking_case

   !> Boundary coefficient 0.3 at 900 rev/min and 60 degC: the roller slides on the base circle and sticks during the event.
   function changing_case() result(case)
      type(case_t) :: case

      case = sticking_case()
      case%asperity%boundary_coefficient = 0.3_wp
      call set_point(case, point_speeds(3), point_viscosities(2))
   end function changing_case

   !> A heavy roller without rolling resistance: it slides forwards, sticks, and slides backwards where it is slowed down.
   function reversing_case() result(case)
      type(case_t) :: case

      case = sticking_case()
      case%asperity%boundary_coefficient = 0.01_wp
      case%roller%mass = 0.03_wp
      case%traction%rolling_law = "none"
      call set_point(case, point_speeds(2), point_viscosities(3))
   end function reversing_case

   !> Integrate a case and sample it.
   subroutine take_sample(case, sample, error)
      type(case_t), intent(in) :: case
      type(sample_t), intent(out) :: sample
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(cycle_t) :: cycle

      call make_model(case, model, error)
      if (.not. allocated(error)) call make_cycle(case, model, cycle, error)
      if (.not. allocated(error)) call sample_cycle(model, cycle, sample, error)
   end subroutine take_sample

   !> Sample a cycle.
   subroutine sample_cycle(model, cycle, sample, error)
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      type(sample_t), intent(out) :: sample
      type(error_type), allocatable, intent(out) :: error
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Mean torques [N m]
      real(wp) :: torques(torque_count)
      integer :: i, hint

      hint = 1
      sample%residual = 0.0_wp
      do i = 1, angle_count
         call state_at(cycle, model, (i - 1)*two_pi/angle_count, hint, state, failure)
         if (has_failed(failure, error)) return
         sample%sliding_speed(i) = state%contact%sliding_speed
         sample%mobilised(i) = state%contact%boundary_mobilised
         sample%capacity(i) = state%contact%boundary_capacity
         sample%rate(i) = rolling_speed_slope(model, state%position) &
            - model%roller_radius*state%spin_acceleration/model%speed
         sample%residual = max(sample%residual, abs(state%torques(of_residual)))
      end do
      call integrate_torques(model, cycle, torques, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      sample%torque = sum(torques, mask=is_loss)
      sample%residual = sample%residual/(sample%torque*model%speed)
   end subroutine sample_cycle

   !> Differences between regularised friction and stick-slip for falling mobilising speeds.
   subroutine take_differences(case, speeds, torques, error)
      type(case_t), intent(in) :: case
      !> Largest difference of the sliding speed [m/s], difference of the mean torque [N m]
      real(wp), intent(out) :: speeds(first_power:last_power), torques(first_power:last_power)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: regularised
      type(sample_t) :: limit, sample
      integer :: power

      call take_sample(case, limit, error)
      if (allocated(error)) return
      regularised = case
      regularised%asperity%mobilisation = "regularised"
      do power = first_power, last_power
         regularised%asperity%mobilising_speed = 10.0_wp**(-power)
         call take_sample(regularised, sample, error)
         if (allocated(error)) return
         speeds(power) = maxval(abs(sample%sliding_speed - limit%sliding_speed))
         torques(power) = abs(sample%torque - limit%torque)
      end do
   end subroutine take_differences

   !> Orders of convergence between neighbouring mobilising speeds, a factor of ten apart, are at least these.
   subroutine check_orders(differences, least_orders, what, error)
      real(wp), intent(in) :: differences(first_power:last_power)
      real(wp), intent(in) :: least_orders(first_power + 1:last_power)
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(out) :: error
      ! Order measured [-]
      real(wp) :: order
      character(len=80) :: buffer
      integer :: power

      do power = first_power + 1, last_power
         order = log10(differences(power - 1)/differences(power))
         if (order >= least_orders(power)) cycle
         write (buffer, "(a, i0, a, f0.3, a, f0.3)") ", 1e-", power, " m/s: order ", order, ", wanted ", least_orders(power)
         call test_failed(error, what//trim(buffer))
         return
      end do
   end subroutine check_orders

   !> At rest `V_s = v_b atanh(m)` with the same m for every v_b, so the order is one; a hundredth of it is left to the integration.
   subroutine test_limit_sticking(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      ! Differences of sliding speed [m/s] and torque [N m]
      real(wp) :: speeds(first_power:last_power), torques(first_power:last_power)

      case = sticking_case()
      ! The smallest difference of the torques is 2.5e-10 N m, 1e-8 of them; a hundredth of it has to be right
      case%numerics%tolerance = 1.0e-9_wp
      call take_differences(case, speeds, torques, error)
      if (.not. allocated(error)) call check_orders(speeds, [0.95_wp, 0.99_wp, 0.99_wp], "sliding speed", error)
      if (.not. allocated(error)) call check_orders(torques, [0.95_wp, 0.99_wp, 0.99_wp], "mean torque", error)
      ! m is 0.8 at most, atanh(m) about 1.2
      if (.not. allocated(error)) call check(error, speeds(last_power) < 2.0e-6_wp)
   end subroutine test_limit_sticking

   !> Where the roller breaks away, |m| comes near one and the regularised slip grows like `v_b ln(1/v_b)`: an order of
   !> 1 - 1/ln(V/v_b), which is 0.6 to 0.9 for V = 0.01 m/s.
   subroutine test_limit_both(error)
      type(error_type), allocatable, intent(out) :: error
      ! Differences of sliding speed [m/s] and torque [N m]
      real(wp) :: speeds(first_power:last_power), torques(first_power:last_power)

      call take_differences(changing_case(), speeds, torques, error)
      if (.not. allocated(error)) call check_orders(speeds, [0.6_wp, 0.75_wp, 0.85_wp], "sliding speed", error)
      if (.not. allocated(error)) call check_orders(torques, [0.8_wp, 0.9_wp, 0.9_wp], "mean torque", error)
      if (.not. allocated(error)) call check(error, speeds(last_power) < 1.0e-5_wp)
   end subroutine test_limit_both

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(sample_t) :: sample

      call take_sample(sticking_case(), sample, error)
      if (.not. allocated(error)) call check_scaled(error, sample%residual, 0.0_wp, 1.0_wp, residual_tolerance, "sticking")
      if (.not. allocated(error)) call take_sample(changing_case(), sample, error)
      if (.not. allocated(error)) call check_scaled(error, sample%residual, 0.0_wp, 1.0_wp, residual_tolerance, "both")
   end subroutine test_energy

   !> At rest the friction found leaves no rate; else it is all of it, with the sign of the sliding speed.
   subroutine test_law(error)
      type(error_type), allocatable, intent(out) :: error

      call check_law(changing_case(), error)
      if (.not. allocated(error)) call check_law(reversing_case(), error)
   end subroutine test_law

   !> The set-valued law at every angle of a case that sticks and slides.
   subroutine check_law(case, error)
      type(case_t), intent(in) :: case
      type(error_type), allocatable, intent(out) :: error
      type(sample_t) :: sample
      integer :: i, resting

      call take_sample(case, sample, error)
      if (allocated(error)) return
      resting = 0
      do i = 1, angle_count
         if (abs(sample%sliding_speed(i)) > 0.0_wp) then
            call check(error, sample%mobilised(i), sign(sample%capacity(i), sample%sliding_speed(i)), &
               thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
         else
            resting = resting + 1
            call check(error, abs(sample%mobilised(i)) <= sample%capacity(i))
            ! A difference of rates of about 1 m/s/rad, sought to round-off; where sticking ends it may be what a step errs by
            if (.not. allocated(error)) call check_scaled(error, sample%rate(i), 0.0_wp, 1.0_wp, case%numerics%tolerance, &
               "rate at rest")
         end if
         if (allocated(error)) return
      end do
      if (resting == 0 .or. resting == angle_count) call test_failed(error, "the case does not both stick and slide")
   end subroutine check_law

   subroutine test_phases(error)
      type(error_type), allocatable, intent(out) :: error

      call check_phases(changing_case(), [0, 1], error)
      if (.not. allocated(error)) call check_phases(reversing_case(), [-1, 0, 1], error)
   end subroutine test_phases

   !> Sticking begins where friction can hold and ends where it is used up; directions differ from phase to phase.
   subroutine check_phases(case, directions, error)
      type(case_t), intent(in) :: case
      !> Directions of sliding that occur
      integer, intent(in) :: directions(:)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(cycle_t) :: cycle
      ! Rates at rest [m/s/rad]
      real(wp) :: rates(2)
      integer :: i, status

      call make_model(case, model, error)
      if (.not. allocated(error)) call make_cycle(case, model, cycle, error)
      if (allocated(error)) return
      do i = 1, size(directions)
         call check(error, any(cycle%phases%direction == directions(i)), "no phase of a direction")
         if (allocated(error)) return
      end do
      do i = 2, size(cycle%phases)
         call check(error, cycle%phases(i)%direction /= cycle%phases(i - 1)%direction, "directions")
         if (allocated(error)) return
         call rates_at_rest(model, cycle%phases(i)%start, rates, status)
         select case (cycle%phases(i)%direction)
         case (0)
            call check(error, rates(1) <= 0.0_wp .and. rates(2) >= 0.0_wp, "friction can hold where sticking begins")
         case (1)
            call check_scaled(error, rates(1), 0.0_wp, maxval(abs(rates)), 1.0e-6_wp, "rate where forward sliding begins")
         case (-1)
            call check_scaled(error, rates(2), 0.0_wp, maxval(abs(rates)), 1.0e-6_wp, "rate where backward sliding begins")
         end select
         if (allocated(error)) return
      end do
   end subroutine check_phases

   !> The cycle closes, and one that starts elsewhere is the same.
   subroutine test_periodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(sample_t) :: before, after
      type(state_t) :: state
      type(error_t), allocatable :: failure
      integer :: hint

      case = changing_case()
      call make_model(case, model, error)
      if (.not. allocated(error)) call make_cycle(case, model, cycle, error)
      if (.not. allocated(error)) call check(error, cycle%closure <= case%numerics%periodicity, "closure")
      if (.not. allocated(error)) call sample_cycle(model, cycle, before, error)
      if (allocated(error)) return
      hint = 1
      call state_at(cycle, model, cycle%start + two_pi*(1.0_wp - epsilon(1.0_wp)), hint, state, failure)
      call check_scaled(error, state%contact%sliding_speed, cycle%trajectory%state(1, 1), maxval(abs(before%sliding_speed)), &
         case%numerics%periodicity, "end and start")
      if (allocated(error)) return
      ! Another method takes other steps; both are within some of their tolerances of the truth
      case%numerics%method = "radau5"
      call take_sample(case, after, error)
      if (.not. allocated(error)) call check_scaled(error, maxval(abs(after%sliding_speed - before%sliding_speed)), 0.0_wp, &
         maxval(abs(before%sliding_speed)), 100.0_wp*case%numerics%tolerance, "two methods")
   end subroutine test_periodic

   !> Without touching asperities, sticking and sliding and regularised friction take the same steps.
   subroutine test_no_asperities(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(sample_t) :: regularised, limit

      case = sticking_case()
      case%surface%cam_roughness = 1.0e-9_wp
      case%surface%roller_roughness = 1.0e-9_wp
      call take_sample(case, limit, error)
      if (allocated(error)) return
      call check(error, maxval(limit%capacity) <= 0.0_wp, "asperities touch")
      if (allocated(error)) return
      case%asperity%mobilisation = "regularised"
      call take_sample(case, regularised, error)
      if (allocated(error)) return
      call check_scaled(error, maxval(abs(limit%sliding_speed - regularised%sliding_speed)), 0.0_wp, &
         maxval(abs(regularised%sliding_speed)), 100.0_wp*epsilon(1.0_wp), "sliding speed")
      if (.not. allocated(error)) call check(error, limit%torque, regularised%torque, thr=100.0_wp*epsilon(1.0_wp), rel=.true.)
   end subroutine test_no_asperities

   !> 900 rev/min at 25 degC: the slip is a hundred times 1e-6 m/s and more, so that regularised friction is all mobilised.
   subroutine test_cold(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(sample_t) :: regularised, limit

      case = sticking_case()
      call set_point(case, point_speeds(3), point_viscosities(1))
      call take_sample(case, limit, error)
      if (allocated(error)) return
      call check(error, minval(limit%sliding_speed) > 1.0e-4_wp, "the roller does not slide all the time")
      if (.not. allocated(error)) call check(error, limit%residual <= residual_tolerance, "energy")
      if (allocated(error)) return
      case%asperity%mobilisation = "regularised"
      case%asperity%mobilising_speed = 1.0e-6_wp
      call take_sample(case, regularised, error)
      if (allocated(error)) return
      call check_scaled(error, maxval(abs(limit%sliding_speed - regularised%sliding_speed)), 0.0_wp, &
         maxval(abs(regularised%sliding_speed)), 10.0_wp*case%numerics%tolerance, "sliding speed")
   end subroutine test_cold

   subroutine test_no_speed(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(sample_t) :: sample, other

      case = changing_case()
      call take_sample(case, sample, error)
      case%asperity%mobilising_speed = 0.5_wp
      if (.not. allocated(error)) call take_sample(case, other, error)
      if (.not. allocated(error)) call check_scaled(error, maxval(abs(sample%sliding_speed - other%sliding_speed)), 0.0_wp, &
         maxval(abs(sample%sliding_speed)), 100.0_wp*epsilon(1.0_wp), "sliding speed")
   end subroutine test_no_speed

   !> After half a turn with sticking in it, the start is forgotten.
   subroutine test_driven(error)
      type(error_type), allocatable, intent(out) :: error
      ! Cam angle of a step [rad]
      real(wp), parameter :: step = 5.0_wp*degree
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: periodic
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(state_t) :: state
      type(error_t), allocatable :: failure
      integer :: i, hint

      case = changing_case()
      call make_model(case, model, error)
      if (.not. allocated(error)) call make_cycle(case, model, periodic, error)
      if (.not. allocated(error)) call start_simulation(simulation, case, 90.0_wp*degree, failure)
      hint = 1
      steps: do i = 1, 108
         if (has_failed(failure, error)) return
         call advance(simulation, 90.0_wp*degree + i*step, model%speed, case%operating_point%oil_temperature, outcome, failure)
         if (allocated(failure)) cycle steps
         if (i <= 36) cycle steps
         call state_at(periodic, model, i*step - 90.0_wp*degree, hint, state, failure)
         if (allocated(failure)) cycle steps
         ! Both are within some of their tolerances of the truth; the rest friction follows from the angle alone
         call check_scaled(error, outcome%state%contact%sliding_speed, state%contact%sliding_speed, 1.0_wp, &
            100.0_wp*case%numerics%tolerance, "sliding speed")
         if (.not. allocated(error)) call check_scaled(error, outcome%state%contact%boundary_mobilised, &
            state%contact%boundary_mobilised, state%contact%load, 100.0_wp*case%numerics%tolerance, "mobilised friction")
      end do steps
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine test_driven

   subroutine test_cut(error)
      type(error_type), allocatable, intent(out) :: error
      type(trajectory_t) :: whole, part
      ! State on the whole curve and on the part [-]
      real(wp) :: expected(1), found(1)
      integer :: i, hint

      call start_trajectory(whole, 1)
      call append_cubic(whole, 1.0_wp, [0.5_wp], [2.0_wp])
      call append_cubic(whole, 1.5_wp, [0.7_wp], [-1.0_wp])
      call append_curve(whole, 3.0_wp, [-0.4_wp], [1.0_wp], reshape([0.3_wp, -0.8_wp, 1.1_wp], [1, 3]))
      call start_trajectory(part, 1)
      call append_until(part, whole, 2.6_wp)
      call check(error, part%count, 3)
      hint = 1
      do i = 0, 16
         if (allocated(error)) return
         call interpolate_state(whole, 1.0_wp + 0.1_wp*i, hint, expected)
         call interpolate_state(part, 1.0_wp + 0.1_wp*i, hint, found)
         call check_scaled(error, found(1), expected(1), 1.0_wp, 100.0_wp*epsilon(1.0_wp), "state")
      end do
   end subroutine test_cut

   subroutine test_refused(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: methods(*) = [character(len=12) :: "euler", "quasi_static"]
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      type(error_t), allocatable :: failure
      integer :: i

      case = sticking_case()
      call make_model(case, model, error)
      do i = 1, size(methods)
         if (allocated(error)) return
         case%numerics%method = methods(i)
         call integrate_cycle(cycle, model, case%numerics, failure)
         call expect_error(error, failure, kind_deck, "stick_slip")
      end do
   end subroutine test_refused

end module test_stick_slip
