!> A flexible train as an initial value problem over the cam angle.
!>
!> In: model, cam angle, state. Out: rate and exact Jacobian, as `ode` asks for them; the places where contacts are lost or return,
!> and where the roller passes a kink of the lift.
module camroller_flexible_problem
   use camroller_cam_angle, only : cam_angle_text
   use camroller_contact_traction, only : largest_traction_rate
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : linear_t, counters_t, factors_t, words_length
   use camroller_ode_switching, only : switching_problem_t
   use camroller_lift_pieces, only : kinks_passed
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, rates_of, state_size, first_mode, &
      & pad_approach, pad_direction, at_finger, at_finger_rate, at_lift, at_plunger, at_plunger_rate, at_sliding
   use camroller_flexible_geometry, only : touch_t, find_touch
   use camroller_flexible_jacobian, only : slopes_of
   use camroller_flexible_equations, only : factorise_train, solve_train
   implicit none
   private

   public :: flexible_problem_t, state_scales, set_scales

   !> Size of the sliding speed to which its error is relative, at most [m/s]
   real(wp), parameter, public :: largest_sliding_scale = 0.1_wp
   !> Width of the range of sliding speeds within which the traction of a film as good as solid goes from 0.85 of one limit to as
   !> much of the other, over the difference that is not told apart [-]
   real(wp), parameter :: range_width = 2.5_wp

   !> A flexible train over the cam angle
   type, extends(switching_problem_t) :: flexible_problem_t
      !> The model; `follow_ramp` sets its inputs to those at the angle where a host moves them, else nothing changes it
      type(model_t), pointer :: model => null()
      !> What need not be told apart
      type(resolution_t) :: resolution
      !> Error of the traction that is allowed for one of the sliding speed, over the largest traction [-]
      real(wp) :: friction_error = 1.0_wp
   contains
      procedure :: get_rate
      procedure :: linearise
      procedure :: factorise
      procedure :: solve
      procedure :: name_time
      procedure :: get_switches
   end type flexible_problem_t

contains

   !> Sizes of the components to which the tolerance is relative.
   pure function state_scales(model) result(scales)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The sizes [state]
      real(wp) :: scales(state_size(model))

      call set_scales(model, scales)
   end function state_scales

   !> Set them.
   pure subroutine set_scales(model, scales)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> The sizes [state]
      real(wp), intent(out) :: scales(:)

      ! Way [m], speed [m/s], pressure [Pa]; amplitude [m] and rate [m/s] of a mode
      real(wp), parameter :: way = 1.0e-5_wp, speed = 0.1_wp, pressure = 1.0e6_wp, amplitude = 1.0e-4_wp, rate = 0.3_wp
      integer :: first

      first = first_mode(model)
      scales(:5) = [way/model%linkage%a, speed/model%linkage%a, way, speed, largest_sliding_scale]
      if (allocated(model%flexible%adjuster)) scales(6:8) = [way, speed, pressure]
      scales(first::2) = amplitude
      scales(first + 1::2) = rate
   end subroutine set_scales

   !> Rate of change of the state with the cam angle.
   subroutine get_rate(self, time, state, rate, status)
      class(flexible_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Its derivative with respect to the cam angle [state/rad]
      real(wp), intent(out) :: rate(:)
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(flexible_state_t) :: now

      call follow_ramp(self%model, time)
      call evaluate_train(self%model, time, state, self%resolution, now, status)
      if (status == 0) then
         call rates_of(self%model, state, now, rate)
      else
         rate = 0.0_wp
      end if
   end subroutine get_rate

   !> Rate and Jacobian from one evaluation.
   subroutine linearise(self, time, state, horizon, linear, counters, status)
      class(flexible_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Cam angle up to which the right-hand side is smooth [rad]
      real(wp), intent(in) :: horizon
      !> Rate [state/rad] with its derivatives [1/rad, state/rad^2]; has its room
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(flexible_state_t) :: now
      type(resolution_t) :: resolution
      logical :: has_moving_oil

      associate (model => self%model, ramp => self%model%ramp, later_angles => horizon)
         counters%evaluations = counters%evaluations + 1
         counters%jacobians = counters%jacobians + 1
         call follow_ramp(model, time)
         has_moving_oil = ramp%is_moving .and. (abs(ramp%temperature_slope) > 0.0_wp .or. abs(ramp%supply_slope) > 0.0_wp)
         resolution = self%resolution
         ! What the oil adds to the derivative is a difference of two evaluations
         if (has_moving_oil) resolution%forces = 0.0_wp
         call evaluate_train(model, time, state, resolution, now, status)
         if (status /= 0) return
         call rates_of(model, state, now, linear%rate)
         linear%saturating = at_sliding
         linear%resolution = self%friction_error
         linear%width = range_width*self%resolution%sliding_speed
         linear%span = huge(1.0_wp)
         if (now%contact%is_touching) linear%span = largest_traction_rate(model, now%contact)
         call slopes_of(model, time, state, now, linear%jacobian, linear%time_slope)
         if (abs(model%speed_slope) > 0.0_wp) linear%time_slope = linear%time_slope - (model%speed_slope/model%speed)*linear%rate
      end associate
      if (has_moving_oil) call add_oil(self, time, state, linear, counters, status)
   end subroutine linearise

   !> Add what oil temperature and supply pressure that change do to the derivative over the cam angle: a difference at one state.
   subroutine add_oil(self, time, state, linear, counters, status)
      !> The problem, with its model at the inputs of the angle
      class(flexible_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate with its derivatives; out: with the oil's
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Angle over which the oil changes for the difference [rad]: its part in the rate is smooth, and evaluations hold round-off
      real(wp), parameter :: increment = 1.0e-4_wp
      type(flexible_state_t) :: now
      ! Rate with the oil further on [state/rad]
      real(wp) :: rate(size(state))

      counters%evaluations = counters%evaluations + 1
      call follow_ramp(self%model, time, time + increment)
      call evaluate_train(self%model, time, state, resolution_t(sliding_speed=self%resolution%sliding_speed), now, status)
      if (status == 0) then
         call rates_of(self%model, state, now, rate)
         linear%time_slope = linear%time_slope + (rate - linear%rate)/increment
      end if
      call follow_ramp(self%model, time)
   end subroutine add_oil

   !> Factors of the matrix of a step, by the structure of the train.
   subroutine factorise(self, linear, shift, factors, status)
      class(flexible_problem_t), intent(in) :: self
      !> Rate and derivatives
      type(linear_t), intent(in) :: linear
      !> The shift [1/rad]
      real(wp), intent(in) :: shift
      !> Factors; have their room
      type(factors_t), intent(inout) :: factors
      !> 0 fine, positive where the matrix is singular
      integer, intent(out) :: status

      associate (flexible => self%model%flexible)
         call factorise_train(flexible%modes, allocated(flexible%adjuster), linear%jacobian, shift, factors, status)
      end associate
   end subroutine factorise

   !> Solve with these factors.
   subroutine solve(self, linear, factors, right_side)
      class(flexible_problem_t), intent(in) :: self
      !> Rate and derivatives of which the factors are
      type(linear_t), intent(in) :: linear
      type(factors_t), intent(in) :: factors
      !> In: right-hand side [state/rad]; out: solution [state]
      real(wp), intent(inout) :: right_side(:)

      associate (flexible => self%model%flexible)
         call solve_train(flexible%modes, allocated(flexible%adjuster), linear%jacobian, factors, right_side)
      end associate
   end subroutine solve

   !> Approach of cam and roller, of the pad, of the seat: contact is lost or returns where one passes through zero. Kinks of the
   !> lift that the roller has passed: it meets them where the cam is nearest, some micrometres before or behind a rigid one.
   subroutine get_switches(self, time, state, switches, status)
      class(flexible_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> The three approaches [m]; kinks of the lift passed [-]
      real(wp), intent(out) :: switches(:)
      !> 0, or as from the state
      integer, intent(out) :: status

      type(touch_t) :: touch
      ! Place and speed of the pivot [m], [m/s]
      real(wp) :: pivot, pivot_rate

      associate (model => self%model)
         pivot = model%flexible%pivot_place
         pivot_rate = 0.0_wp
         if (allocated(model%flexible%adjuster)) then
            pivot = state(at_plunger)
            pivot_rate = state(at_plunger_rate)
         end if
         call find_touch(model, time, state(at_finger), state(at_finger_rate), pivot, pivot_rate, touch, status)
         switches = [touch%approach, pad_approach(model, state, pivot, real(pad_direction(model%linkage, touch%arm), wp)), &
            & -state(at_lift), kinks_passed(model, touch%angle)]
      end associate
   end subroutine get_switches

   !> A cam angle in the words of messages, as files count it.
   function name_time(self, time) result(text)
      class(flexible_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> It in words
      character(len=words_length) :: text

      text = cam_angle_text(time, 3)
      associate (for_all_problems => self)
      end associate
   end function name_time

end module camroller_flexible_problem
