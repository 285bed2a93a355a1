!> The roller's spin as an initial value problem over the cam angle.
!>
!> Layer: solver. In: model, cam angle, state. Out: rate and decay rate, as `ode` asks for them. The state is the sliding speed V_s,
!> `dV_s/dtheta = omega dV_roll' - r_R (domega_R/dt)/omega`: friction depends on slip, which is a small difference of large
!> speeds. The source integrates the roller's surface speed `r_R omega_R` instead; its fixed step does so here too.
module camroller_spin
   use camroller_kinds, only : wp, degree
   use camroller_ode_problem, only : problem_t, counters_t, time_increment
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_contact_forces, only : contact_t
   use camroller_state, only : evaluate_loading, evaluate_spin
   implicit none
   private

   public :: spin_problem_t, sliding_speed_of, rolling_speed_slope, rolling_speed_at, decay_rate_of

   !> The roller's spin over the cam angle
   type, extends(problem_t) :: spin_problem_t
      !> The model; read only
      type(model_t), pointer :: model => null()
      !> Is the state the roller's surface speed instead of the sliding speed?
      logical :: has_surface_speed = .false.
      !> Relative error of load and forces that is good enough; zero: round-off [-]
      real(wp) :: accuracy = 0.0_wp
      !> Mobilised part of the boundary friction; not allocated: as the sliding speed has it [-]
      real(wp), allocatable :: mobilised
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: get_jacobian
      procedure :: get_saturation
      procedure :: name_time
   end type spin_problem_t

   !> Increment of a difference quotient over the size of its variable [-]
   real(wp), parameter :: increment_ratio = sqrt(epsilon(1.0_wp))
   !> Largest and smallest error of the traction over its limit, and the same over the accuracy of the contact [-]
   real(wp), parameter :: coarsest_resolution = 1.0e-2_wp, finest_resolution = 1.0e-10_wp, accuracy_ratio = 1.0e5_wp
   !> Change of the traction over its limit, up to which the traction counts as a straight line of the sliding speed [-]
   real(wp), parameter :: largest_change = 1.0e-5_wp

contains

   !> Rate of change of the state with the cam angle.
   subroutine get_rate(self, time, state, rate, status)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state(:)
      !> Its derivative with respect to the cam angle [m/s/rad]
      real(wp), intent(out) :: rate(:)
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(position_t) :: position
      type(moments_t) :: moments
      type(contact_t) :: contact
      ! Gas force [N]; angular acceleration of the roller [rad/s^2]
      real(wp) :: force, acceleration

      rate = 0.0_wp
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      call evaluate_spin(self%model, position, moments, sliding_speed_of(self, position, state(1)), contact, acceleration, &
         & status, self%accuracy, self%mobilised)
      if (status /= 0) return
      rate(1) = self%model%roller_radius*acceleration/self%model%speed
      if (.not. self%has_surface_speed) rate(1) = rolling_speed_slope(self%model, position) - rate(1)
   end subroutine get_rate

   !> Decay rate of a disturbance of the spin, `r_R^2 (dF_t/dV_s)/(I_R omega)` per radian.
   subroutine get_decay_rate(self, time, state, decay_rate)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state(:)
      !> Decay rate [1/rad]
      real(wp), intent(out) :: decay_rate

      type(position_t) :: position
      type(moments_t) :: moments
      type(contact_t) :: contact
      ! Gas force [N]; angular acceleration of the roller [rad/s^2]
      real(wp) :: force, acceleration
      integer :: status

      decay_rate = 0.0_wp
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      call evaluate_spin(self%model, position, moments, sliding_speed_of(self, position, state(1)), contact, acceleration, &
         & status, mobilised=self%mobilised)
      decay_rate = decay_rate_of(self%model, contact)
   end subroutine get_decay_rate

   !> Decay rate of a disturbance of the spin with the contact as it is.
   pure function decay_rate_of(model, contact) result(decay_rate)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Decay rate [1/rad]
      real(wp) :: decay_rate

      decay_rate = model%roller_radius**2*contact%traction_slope/(model%roller_inertia*model%speed)
   end function decay_rate_of

   !> Rate that the traction can make up, without friction in the load; the same part of it counts as an error as of the contact,
   !> but not more than a hundredth.
   subroutine get_saturation(self, time, span, resolution)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Rate of the largest traction, zero without contact [m/s/rad]
      real(wp), intent(out) :: span
      !> Error of the rate that is allowed for an error of the sliding speed, over the rate [-]
      real(wp), intent(out) :: resolution

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N], coefficient of the largest traction [-]
      real(wp) :: force, coefficient
      integer :: status

      span = huge(1.0_wp)
      resolution = max(min(coarsest_resolution, accuracy_ratio*self%accuracy), finest_resolution)
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      coefficient = self%model%limiting_coefficient
      if (allocated(self%model%boundary)) coefficient = max(coefficient, self%model%boundary%coefficient)
      span = coefficient*max(moments%total/position%normal_arm, 0.0_wp)*self%model%roller_radius**2 &
         & /(self%model%roller_inertia*self%model%speed)
   end subroutine get_saturation

   !> Jacobian and slope with the cam angle by forward differences.
   !>
   !> Traction saturates within a sliding speed that may lie twenty decades below the largest one of the cycle, where an
   !> increment chosen for the latter would see no slope at all. An increment that changes the traction by more than a small
   !> part of its limit is therefore replaced by one that does not, from the analytic slope of the traction. All rates are found
   !> to round-off here, whatever accuracy is enough elsewhere, and the rate that is known is not used.
   subroutine get_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state(:)
      !> Its derivative with respect to the cam angle [m/s/rad]
      real(wp), intent(in) :: rate(:)
      !> Cam angle up to which the right-hand side is smooth [rad]
      real(wp), intent(in) :: horizon
      !> Derivative of the rate with respect to the state [1/rad]
      real(wp), intent(out) :: jacobian(:, :)
      !> Derivative of the rate with respect to the cam angle [m/s/rad^2]
      real(wp), intent(out) :: time_slope(:)
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(contact_t) :: contact
      ! State moved and size of the state [m/s], angle moved [rad], rates [m/s/rad]
      real(wp) :: moved_state, size_of_state, moved_time, moved_rate, base_rate

      counters%jacobians = counters%jacobians + 1
      size_of_state = 1.0_wp
      if (allocated(self%small_state)) size_of_state = self%small_state(1)
      moved_state = state(1) + increment_ratio*max(abs(state(1)), size_of_state)
      call rate_and_contact(self, time, state(1), base_rate, contact, counters, status)
      if (status /= 0) return
      call choose_increment(self%model, contact, state(1), moved_state)
      call rate_and_contact(self, time, moved_state, moved_rate, contact, counters, status)
      if (status /= 0) return
      jacobian = (moved_rate - base_rate)/(moved_state - state(1))
      moved_time = time + time_increment(time, horizon)
      call rate_and_contact(self, moved_time, state(1), moved_rate, contact, counters, status)
      if (status /= 0) return
      time_slope = (moved_rate - base_rate)/(moved_time - time) + 0.0_wp*rate
   end subroutine get_jacobian

   !> Move a state by so little that its traction stays a straight line.
   pure subroutine choose_increment(model, contact, state, moved_state)
      !> The model
      type(model_t), intent(in) :: model
      !> The contact at the state
      type(contact_t), intent(in) :: contact
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state
      !> In: state moved by too much; out: by less [m/s]
      real(wp), intent(inout) :: moved_state

      ! Increment [m/s], traction by which it moves [N]
      real(wp) :: increment, change

      increment = moved_state - state
      change = largest_change*(model%limiting_coefficient*contact%load + contact%boundary_capacity)
      if (contact%traction_slope*increment > change) increment = change/contact%traction_slope
      moved_state = state + max(increment, 4.0_wp*spacing(state))
   end subroutine choose_increment

   !> Rate with the contact that it comes from, to round-off.
   subroutine rate_and_contact(self, time, state, rate, contact, counters, status)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state
      !> Its derivative with respect to the cam angle [m/s/rad]
      real(wp), intent(out) :: rate
      !> State of the contact
      type(contact_t), intent(out) :: contact
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]; angular acceleration of the roller [rad/s^2]
      real(wp) :: force, acceleration

      rate = 0.0_wp
      counters%evaluations = counters%evaluations + 1
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      call evaluate_spin(self%model, position, moments, sliding_speed_of(self, position, state), contact, acceleration, status)
      if (status > 0) then
         call evaluate_spin(self%model, position, moments, sliding_speed_of(self, position, state), contact, acceleration, &
            & status, self%accuracy)
      end if
      if (status /= 0) return
      rate = self%model%roller_radius*acceleration/self%model%speed
      if (.not. self%has_surface_speed) rate = rolling_speed_slope(self%model, position) - rate
   end subroutine rate_and_contact

   !> A cam angle in the words of messages, as files count it.
   function name_time(self, time) result(text)
      !> The problem
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> It in words
      character(len=:), allocatable :: text

      character(len=16) :: buffer

      write (buffer, "(f0.3)") modulo(180.0_wp + time/degree, 360.0_wp)
      text = "cam angle "//trim(buffer)//" deg"
      if (self%has_surface_speed) text = text//" (fixed step)"
   end function name_time

   !> Sliding speed that belongs to a state.
   pure function sliding_speed_of(problem, position, state) result(sliding_speed)
      !> The problem
      class(spin_problem_t), intent(in) :: problem
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed

      sliding_speed = state
      if (problem%has_surface_speed) sliding_speed = rolling_speed_at(problem%model, position) - state
   end function sliding_speed_of

   !> Speed of the roller's surface in pure rolling, by the chosen notion of it.
   pure function rolling_speed_at(model, position) result(speed)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> V_roll [m/s]
      real(wp) :: speed

      speed = model%speed*merge(position%rolling_travel, position%surface_travel, model%has_exact_spin)
   end function rolling_speed_at

   !> Derivative of the speed in pure rolling with respect to the cam angle.
   pure function rolling_speed_slope(model, position) result(slope)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> dV_roll/d(cam angle) [m/s/rad]
      real(wp) :: slope

      slope = model%speed*merge(position%rolling_travel_slope, position%surface_travel_slope, model%has_exact_spin)
   end function rolling_speed_slope

end module camroller_spin
