!> A follower driven from outside, from one cam angle to the next, while speed, oil temperature and gas pressure change.
!>
!> In: a case, then angles with inputs at both ends of each step, linear in the cam angle between. Out: torques of the follower by
!> source, mean over the step and at its end, extremes within it, the state at its end. What is remembered between steps is cam
!> angle, spin of the roller and oil temperature; a step that fails leaves all of it as it was, to the last bit. Camshaft bearings
!> need all followers at once: `shaft_simulation`.
module camroller_simulation
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_number_text, only : number_text, integer_text
   use camroller_accuracy, only : resolve_numerics, has_error_control
   use camroller_case, only : case_t
   use camroller_model, only : set_operating_point
   use camroller_catalogue, only : follower_count, follower_values, list_series
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t
   use camroller_balance, only : find_balance
   use camroller_flexible_step, only : step_train, place_train, halt_train
   use camroller_follower_step, only : follower_t, point_t, outcome_t, step_follower, place_t, place_of, put_back
   use camroller_step_inputs, only : inputs_t, check_inputs
   use camroller_spin, only : rolling_speed_at
   use camroller_cycle_start, only : choose_start
   use camroller_model_mark, only : mark_model
   use camroller_remarks, only : remark_t
   use camroller_result, only : quantity_t
   use camroller_run, only : build_model
   use camroller_step_remarks, only : judge_follower_step, judge_step_gas, judge_step_oil, judge_step_supply
   implicit none
   private

   public :: simulation_t, outcome_t, inputs_t, start_simulation, advance, halt
   public :: prepare_simulation, place_simulation, check_angle, check_step, has_films, simulation_place, put_simulation_back
   public :: get_point, set_point, get_lobe, get_mark, get_values, is_started
   public :: simulation_angle, simulation_series, simulation_values, list_step_remarks, judge_outcome, &
      & judge_common_inputs

   !> A follower between two steps
   type :: simulation_t
      private
      type(follower_t) :: follower
   end type simulation_t

   !> Advance a follower, at steady inputs or with inputs that change
   interface advance
      module procedure :: advance_steady, advance_inputs
   end interface advance

   !> Accuracy of the quasi-static balance relative to the speed of pure rolling [-]: far below any slip of interest
   real(wp), parameter :: balance_tolerance = 1.0e-12_wp
   !> Shortest step relative to the distance of neighbouring angles [-]: what is stored in spring and masses changes so much over it
   !> that the difference is known to the default accuracy
   real(wp), parameter :: least_spacings = 1.0e6_wp
   !> Turns at most in a step, where a periodic cycle is long reached, and from zero, where angles are still known to 1e-9
   integer, parameter :: most_turns_of_step = 100, most_turns = 1000000

contains

   !> Put a follower at a cam angle with the roller in its quasi-static balance there, or rolling where there is none.
   subroutine start_simulation(simulation, case, cam_angle, error, lobe)
      !> The follower; not to be advanced where there is an error
      type(simulation_t), intent(out) :: simulation
      !> A case; its operating point is that of the start
      type(case_t), intent(in) :: case
      !> Cam angle, pi at full lift [rad]
      real(wp), intent(in) :: cam_angle
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error
      !> Lobe shape that drives it: 1, the case's lift, which is also what is taken without it, or 2, the second lift
      integer, intent(in), optional :: lobe

      type(simulation_t) :: started
      integer :: used_lobe

      used_lobe = 1
      if (present(lobe)) used_lobe = lobe
      call check_angle("start_simulation", cam_angle, error)
      if (.not. allocated(error)) call prepare_simulation("start_simulation", started, case, used_lobe, error)
      if (allocated(error)) return
      call place_simulation(started, cam_angle, error)
      if (.not. allocated(error)) simulation = started
   end subroutine start_simulation

   !> Make the model of a follower, and what its steps are measured by.
   subroutine prepare_simulation(caller, started, case, used_lobe, error)
      !> Who asks
      character(len=*), intent(in) :: caller
      !> The follower; to be placed at a cam angle
      type(simulation_t), intent(out) :: started
      !> A case
      type(case_t), intent(in) :: case
      !> Lobe shape
      integer, intent(in) :: used_lobe
      !> Usage, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Sliding speed, least scale of it [m/s]; an angle that is not needed [rad]
      real(wp) :: sliding_speed, least_scale, unused
      integer :: evaluations

      call check_start(caller, case, used_lobe, error)
      if (allocated(error)) return
      call build_model(case, used_lobe, started%follower%model, error)
      if (allocated(error)) return
      if (.not. has_error_control(case%numerics%method)) then
         call raise(error, kind_usage, caller//": the method '"//trim(case%numerics%method)//"' has no error "// &
            & "control; choose 'automatic' or another method with error control")
         return
      end if
      started%follower%given = case%numerics
      started%follower%numerics = resolve_numerics(case%numerics)
      started%follower%point%film_temperature = case%operating_point%oil_temperature
      started%follower%point%film_speed = case%operating_point%speed
      started%follower%point%oil_temperature = case%operating_point%oil_temperature
      evaluations = 0
      call choose_start(started%follower%model, unused, sliding_speed, started%follower%point%scale, least_scale, evaluations)
      call mark_model(started%follower%model, case, started%follower%mark)
   end subroutine prepare_simulation

   !> Put a follower that is prepared at a cam angle, with the roller in its quasi-static balance there; a flexible train as
   !> `place_train` does.
   subroutine place_simulation(simulation, cam_angle, error)
      !> The follower
      type(simulation_t), intent(inout) :: simulation
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> Convergence error of a flexible train
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      ! Sliding speed [m/s]; decay rate [1/rad]
      real(wp) :: sliding_speed, decay_rate
      logical :: is_found

      if (allocated(simulation%follower%model%flexible)) then
         call place_train(simulation%follower, cam_angle, error)
         return
      end if
      associate (model => simulation%follower%model, point => simulation%follower%point)
         call find_balance(model, cam_angle - pi, balance_tolerance, position, sliding_speed, decay_rate, is_found)
         point%angle = cam_angle
         point%roller_spin = (rolling_speed_at(model, position) - sliding_speed)/model%roller_radius
         point%sliding_speed = sliding_speed
      end associate
   end subroutine place_simulation

   !> Refuse a case and a lobe that cannot be advanced.
   subroutine check_start(caller, case, lobe, error)
      !> Who asks
      character(len=*), intent(in) :: caller
      type(case_t), intent(in) :: case
      !> Lobe shape
      integer, intent(in) :: lobe
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (lobe < 1 .or. lobe > 2) then
         call raise(error, kind_usage, caller//": the lobe must be 1, for the case's lift, or 2, for its second_lift, "// &
            & "not "//integer_text(lobe))
      else if (lobe == 2 .and. .not. allocated(case%second_lift)) then
         call raise(error, kind_usage, caller//": lobe 2 needs a case with second_lift; give the case "// &
            & "one, or take lobe 1")
      else if (allocated(case%running_in)) then
         call raise(error, kind_usage, caller//": hours of running are computed from whole cycles, not from steps; "// &
            & "leave &running_in out, with &tribofilm where that is given, and the surfaces are those of the case")
      end if
   end subroutine check_start

   !> Refuse a cam angle to start at.
   subroutine check_angle(caller, cam_angle, error)
      !> Who asks
      character(len=*), intent(in) :: caller
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      if (.not. ieee_is_finite(cam_angle)) then
         call raise(error, kind_usage, caller//": the cam angle must be a finite number")
      else if (abs(cam_angle) > most_turns*two_pi) then
         call raise(error, kind_usage, caller//": the cam angle must be within "//integer_text(most_turns)// &
            & " turns of zero; leave whole turns out")
      end if
   end subroutine check_angle

   !> Advance to a cam angle at a speed and an oil temperature; the roller's spin carries over.
   subroutine advance_steady(simulation, cam_angle, speed, oil_temperature, outcome, error)
      !> The follower; left as it was where there is an error
      type(simulation_t), intent(inout) :: simulation
      !> Cam angle at the end of the step, beyond the present one [rad]
      real(wp), intent(in) :: cam_angle
      !> Cam speed during the step [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil during the step [K]
      real(wp), intent(in) :: oil_temperature
      !> Torques and state; of no meaning where there is an error
      type(outcome_t), intent(out) :: outcome
      !> Usage, deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(inputs_t) :: inputs

      inputs = inputs_t(speed=speed, oil_temperature=oil_temperature)
      call advance_inputs(simulation, cam_angle, inputs, inputs, outcome, error)
   end subroutine advance_steady

   !> Advance to a cam angle with inputs at both ends of the step, linear in the cam angle between; the roller's spin carries over.
   subroutine advance_inputs(simulation, cam_angle, start, finish, outcome, error, nodes)
      !> The follower; left as it was where there is an error
      type(simulation_t), intent(inout) :: simulation
      !> Cam angle at the end of the step, beyond the present one [rad]
      real(wp), intent(in) :: cam_angle
      !> Inputs at the start and at the end of the step
      type(inputs_t), intent(in) :: start, finish
      !> Torques and state; of no meaning where there is an error
      type(outcome_t), intent(out) :: outcome
      !> Usage, deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Force on the cam [N] and torque that drives it [N m] at equally spaced angles of the step, shape (3, angles)
      real(wp), intent(out), optional :: nodes(:, 0:)

      type(simulation_t), allocatable :: kept
      type(place_t) :: before

      if (is_started(simulation)) then
         call check_step(simulation%follower%point%angle, cam_angle, error)
      else
         call raise(error, kind_usage, "advance: the follower has not been started; call start_simulation first")
      end if
      if (.not. allocated(error)) call check_inputs(simulation%follower%model, simulation%follower%point%oil_temperature, &
         & start, finish, error)
      if (allocated(error)) return
      before = place_of(simulation%follower)
      ! Films solved beforehand may be replaced on the way
      if (has_films(simulation)) allocate (kept, source=simulation)
      if (allocated(simulation%follower%model%flexible)) then
         call step_train(simulation%follower, cam_angle, start, finish, outcome, error, nodes)
      else
         call step_follower(simulation%follower, cam_angle, start, finish, outcome, error, nodes)
      end if
      outcome%inputs = [start, finish]
      outcome%is_of_step = .not. allocated(error)
      if (outcome%is_of_step) return
      if (allocated(kept)) then
         simulation = kept
      else
         call put_back(simulation%follower, before)
      end if
   end subroutine advance_inputs

   !> Does a follower have films solved beforehand, which steps may replace?
   pure function has_films(simulation) result(verdict)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> Does it?
      logical :: verdict

      verdict = allocated(simulation%follower%model%ehl)
   end function has_films

   !> Where a follower is, its model included.
   pure function simulation_place(simulation) result(place)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The place
      type(place_t) :: place

      place = place_of(simulation%follower)
   end function simulation_place

   !> Put a follower without films solved beforehand back where it was.
   subroutine put_simulation_back(simulation, place)
      !> The follower
      type(simulation_t), intent(inout) :: simulation
      !> Where it was
      type(place_t), intent(in) :: place

      call put_back(simulation%follower, place)
   end subroutine put_simulation_back

   !> Bring the roller to rest, as in an engine that has stopped: the next step starts without spin. In a flexible train all other
   !> motion ends too.
   pure subroutine halt(simulation)
      !> The follower
      type(simulation_t), intent(inout) :: simulation

      simulation%follower%point%roller_spin = 0.0_wp
      if (allocated(simulation%follower%model%flexible)) call halt_train(simulation%follower)
   end subroutine halt

   !> Has a follower been started?
   pure function is_started(simulation) result(verdict)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> Has it?
      logical :: verdict

      verdict = simulation%follower%point%scale > 0.0_wp
   end function is_started

   !> What a follower remembers.
   pure function get_point(simulation) result(point)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> Angle, spin, scale, temperatures
      type(point_t) :: point

      point = simulation%follower%point
   end function get_point

   !> Cam angle of a follower.
   pure function simulation_angle(simulation) result(angle)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The angle, 0 before the start [rad]
      real(wp) :: angle

      angle = simulation%follower%point%angle
   end function simulation_angle

   !> Names, units and meanings of the values of a follower.
   subroutine simulation_series(case, series)
      !> The case that the follower is started with
      type(case_t), intent(in) :: case
      !> The series in the order of `simulation_values`
      type(quantity_t), allocatable, intent(out) :: series(:)

      call list_series(case, series)
      series = series(:follower_count(case))
   end subroutine simulation_series

   !> Values of the series of a follower at the end of its last step.
   subroutine simulation_values(simulation, case, outcome, values, error)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The case that it was started with
      type(case_t), intent(in) :: case
      !> What its last step gave
      type(outcome_t), intent(in) :: outcome
      !> Values in the order of `simulation_series`; none where there is an error [unit of the series]
      real(wp), allocatable, intent(out) :: values(:)
      !> Usage error where the follower has not been started, or the outcome is not that of a step
      type(error_t), allocatable, intent(out) :: error

      allocate (values(merge(follower_count(case), 0, is_started(simulation) .and. outcome%is_of_step)))
      if (size(values) > 0) then
         call get_values(simulation, case, outcome%state, values)
      else
         call raise(error, kind_usage, "simulation_values: the outcome is not that of a step; call start_simulation, then advance")
      end if
   end subroutine simulation_values

   !> Remarks on the last step of a follower: what its numbers do not tell, as that contact was lost or a law left its range.
   subroutine list_step_remarks(simulation, case, outcome, remarks)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The case that it was started with
      type(case_t), intent(in) :: case
      !> What its last step gave; without a step there are no remarks
      type(outcome_t), intent(in) :: outcome
      !> The remarks, one of each kind at most but for a plunger at both of its stops
      type(remark_t), allocatable, intent(out) :: remarks(:)

      allocate (remarks(0))
      if (.not. outcome%is_of_step) return
      call judge_outcome(simulation, outcome, remarks)
      call judge_common_inputs(case, outcome, remarks)
   end subroutine list_step_remarks

   !> Remarks on the numbers of a follower's step.
   subroutine judge_outcome(simulation, outcome, remarks)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> What its last step gave
      type(outcome_t), intent(in) :: outcome
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      real(wp) :: pressures(2) ! at both ends [Pa]

      call judge_follower_step(simulation%follower%model, outcome%extremes, remarks)
      if (.not. outcome%inputs(1)%has_pressure) return
      pressures = outcome%inputs%gas_pressure
      call judge_step_gas(pressures, remarks)
   end subroutine judge_outcome

   !> Remarks on the inputs that all followers of a step have.
   subroutine judge_common_inputs(case, outcome, remarks)
      !> The case
      type(case_t), intent(in) :: case
      !> What the step of a follower gave
      type(outcome_t), intent(in) :: outcome
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      ! Temperature [K] and pressure [Pa] at both ends
      real(wp) :: temperatures(2), pressures(2)

      temperatures = outcome%inputs%oil_temperature
      call judge_step_oil(case, temperatures, remarks)
      if (.not. outcome%inputs(1)%has_supply) return
      pressures = outcome%inputs%supply_pressure
      call judge_step_supply(pressures, remarks)
   end subroutine judge_common_inputs

   !> Values of the series of one follower at the end of its last step.
   subroutine get_values(simulation, case, state, values)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The case that it was started with
      type(case_t), intent(in) :: case
      !> State at the end of the step
      type(state_t), intent(in) :: state
      !> Values, in the order of the series of a result [unit of the series]
      real(wp), intent(out) :: values(:)

      call follower_values(case, simulation%follower%model, state, values)
   end subroutine get_values

   !> Lobe shape that drives a follower.
   pure function get_lobe(simulation) result(lobe)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> 1 or 2
      integer :: lobe

      lobe = simulation%follower%model%lobe
   end function get_lobe

   !> Mark of the model of a follower, as it was at the start.
   pure function get_mark(simulation) result(mark)
      !> The follower
      type(simulation_t), intent(in) :: simulation
      !> The mark
      integer(int64) :: mark

      mark = simulation%follower%mark
   end function get_mark

   !> Put a follower that has been started where another one of the same case was.
   subroutine set_point(simulation, point, error)
      !> The follower
      type(simulation_t), intent(inout) :: simulation
      !> What the other one remembered
      type(point_t), intent(in) :: point
      !> Deck, domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      simulation%follower%model%speed_slope = 0.0_wp
      call set_operating_point(simulation%follower%model, point%film_speed, point%film_temperature, error)
      simulation%follower%point = point
      simulation%follower%is_to_be_set = .true.
   end subroutine set_point

   !> Shortest step at a cam angle.
   elemental function least_step(cam_angle) result(step)
      !> Cam angle [rad]
      real(wp), intent(in) :: cam_angle
      !> The step [rad]: the lobe's own angles are half a turn less
      real(wp) :: step

      step = least_spacings*spacing(abs(cam_angle) + pi)
   end function least_step

   !> Refuse a step that cannot be resolved or ended.
   subroutine check_step(present_angle, cam_angle, error)
      !> Cam angles at the start and at the end of the step [rad]
      real(wp), intent(in) :: present_angle, cam_angle
      !> Usage error that says what is allowed
      type(error_t), allocatable, intent(out) :: error

      ! Shortest step [rad]: the lobe's own angles are half a turn less
      real(wp) :: shortest

      if (.not. ieee_is_finite(cam_angle)) then
         call raise(error, kind_usage, "advance: the cam angle must be a finite number")
      else if (.not. cam_angle > present_angle) then
         call raise(error, kind_usage, "advance: the cam angle must grow beyond the present "// &
            & number_text(present_angle/degree, 10)//" deg; a cam does not turn backward")
      else if (cam_angle > most_turns*two_pi) then
         call raise(error, kind_usage, "advance: the cam angle is more than "//integer_text(most_turns)// &
            & " turns from zero; start a new follower with whole turns left out")
      else if (cam_angle - present_angle > most_turns_of_step*two_pi) then
         call raise(error, kind_usage, "advance: a step may have "//integer_text(most_turns_of_step)// &
            & " turns at most; the cycle is periodic long before")
      end if
      if (allocated(error)) return
      shortest = least_step(max(abs(cam_angle), abs(present_angle)))
      if (cam_angle - present_angle >= shortest) return
      call raise(error, kind_usage, "advance: at this cam angle a step must have at least "//number_text(shortest/degree, 2)// &
         & " deg, "//number_text(least_spacings, 2)//" times the distance of neighbouring numbers there")
   end subroutine check_step

end module camroller_simulation
