!> The roller's spin as an initial value problem over the cam angle.
!>
!> In: model, cam angle, state. Out: rate and decay rate, in the form that `ode` requires. The state is the sliding speed V_s,
!> `dV_s/dtheta = omega dV_roll' - r_R (domega_R/dt)/omega`: friction depends on slip, which is a small difference of large
!> speeds. The source integrates the roller's surface speed `r_R omega_R` instead; so does an integration with a fixed step here.
module camroller_spin
   use camroller_asperity, only : largest_coefficient
   use camroller_cam_angle, only : cam_angle_text
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, linear_t, counters_t, time_increment, words_length
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_ramp, only : follow_ramp
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_contact_forces, only : contact_t, bearing_slope, has_oil_drag, oil_drag_slope
   use camroller_state, only : evaluate_loading, evaluate_spin
   use camroller_spin_slopes, only : spin_slopes_t, evaluate_spin_slopes
   implicit none
   private

   public :: spin_problem_t, nearby_t, rolling_speed_slope, rolling_speed_at, slip_rate, surface_rate, &
      & film_decay_rate, decay_rate_of, full_decay_rate

   !> Contacts that an integration has solved: the first of it and the last, from which the next one is looked for
   type :: nearby_t
      type(contact_t) :: first, last
      !> Is there a first one yet?
      logical :: has_first = .false.
      !> Where the last one is: cam angle from full lift [rad], sliding speed [m/s]
      real(wp) :: angle = 0.0_wp, sliding_speed = 0.0_wp
      !> How it changes, see `start_slopes` of `spin_slopes_t`; zero before there is a first one [N s/m], [N s], [s/m]; [N/rad],
      !> [N m/rad], [1/rad]
      real(wp) :: slopes(3, 2) = 0.0_wp
   end type nearby_t

   !> The roller's spin over the cam angle
   type, extends(problem_t) :: spin_problem_t
      !> The model; `follow_ramp` sets its inputs to those at the angle where a host moves them, else nothing changes it
      type(model_t), pointer :: model => null()
      !> Is the state the roller's surface speed instead of the sliding speed?
      logical :: has_surface_speed = .false.
      !> Relative error of load and forces that is good enough; zero: round-off [-]
      real(wp) :: accuracy = 0.0_wp
      !> Mobilised part of the boundary friction; not allocated: as the sliding speed has it [-]
      real(wp), allocatable :: mobilised
      !> Contacts solved before; not associated: each is looked for from nothing
      type(nearby_t), pointer :: nearby => null()
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: linearise
      procedure :: get_clearance
      procedure :: name_time
   end type spin_problem_t

   !> Largest and smallest error of the traction over its limit, and the same over the accuracy of the contact [-]. Where what the
   !> roller needs exceeds the limit by less than that, friction that has given way still seems to hold
   real(wp), parameter :: coarsest_resolution = 1.0e-4_wp, finest_resolution = 1.0e-10_wp, accuracy_ratio = 1.0e3_wp

   !> Relative error of load and forces of solutions whose difference is taken [-]: where only the inputs change, by a millionth or
   !> so, the first step from one solution to the other is the last
   real(wp), parameter :: difference_accuracy = 1.0e-12_wp

contains

   !> Rate of change of the state with the cam angle.
   subroutine get_rate(self, time, state, rate, status)
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
      type(contact_t) :: contact, start
      ! Gas force [N]; sliding speed [m/s]; angular acceleration of the roller [rad/s^2]
      real(wp) :: force, sliding_speed, acceleration

      rate = 0.0_wp
      call follow_ramp(self%model, time)
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      sliding_speed = sliding_speed_of(self, position, state(1))
      call start_from(self%nearby, time, sliding_speed, start)
      call evaluate_spin(self%model, position, moments, sliding_speed, contact, acceleration, status, self%accuracy, &
         & self%mobilised, start)
      if (status /= 0) return
      if (self%has_surface_speed) then
         rate(1) = surface_rate(self%model, acceleration)
      else
         rate(1) = slip_rate(self%model, position, acceleration)
      end if
   end subroutine get_rate

   !> Decay rate of a disturbance of the spin per radian, with film and load following the slip.
   subroutine get_decay_rate(self, time, state, decay_rate)
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state(:)
      !> Decay rate [1/rad]
      real(wp), intent(out) :: decay_rate

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force
      integer :: status

      decay_rate = 0.0_wp
      call follow_ramp(self%model, time)
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      decay_rate = full_decay_rate(self%model, time, position, moments, sliding_speed_of(self, position, state(1)), &
         & self%accuracy, self%mobilised)
   end subroutine get_decay_rate

   !> Decay rate of a disturbance of the spin with everything that follows the slip.
   function full_decay_rate(model, angle, position, moments, sliding_speed, accuracy, mobilised) result(decay_rate)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Relative error of load and forces that is good enough [-]
      real(wp), intent(in) :: accuracy
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> Decay rate; zero where the contact has no solution [1/rad]
      real(wp) :: decay_rate

      type(spin_slopes_t) :: slopes
      integer :: status

      decay_rate = 0.0_wp
      call evaluate_spin_slopes(model, angle, position, moments, sliding_speed, slopes, status, accuracy, mobilised)
      if (status == 0) decay_rate = model%roller_radius*slopes%speed_slope/model%speed
   end function full_decay_rate

   !> Rate of the sliding speed over the cam angle: the equation of the roller, `dV_roll/dtheta - r_R (domega_R/dt)/omega`.
   pure function slip_rate(model, position, acceleration) result(rate)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Angular acceleration of the roller [rad/s^2]
      real(wp), intent(in) :: acceleration
      !> The rate [m/s/rad]
      real(wp) :: rate

      rate = rolling_speed_slope(model, position) - surface_rate(model, acceleration)
   end function slip_rate

   !> Rate of the speed of the roller's surface over the cam angle.
   elemental function surface_rate(model, acceleration) result(rate)
      !> The model
      type(model_t), intent(in) :: model
      !> Angular acceleration of the roller [rad/s^2]
      real(wp), intent(in) :: acceleration
      !> The rate [m/s/rad]
      real(wp) :: rate

      rate = model%roller_radius*acceleration/model%speed
   end function surface_rate

   !> Decay rate of a disturbance of the spin by the traction, with film and load as they are: `r_R^2 (dF_t/dV_s)/(I_R omega)`.
   pure function film_decay_rate(model, contact) result(decay_rate)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Decay rate [1/rad]
      real(wp) :: decay_rate

      decay_rate = model%roller_radius**2*contact%traction_slope/(model%roller_inertia*model%speed)
   end function film_decay_rate

   !> Decay rate of a disturbance of the spin with film and load as they are, `(r_R^2 dF_t/dV_s + dT_B/domega_R)/(I_R omega)`: of
   !> the traction, and of a bearing that holds the roller.
   pure function decay_rate_of(model, contact) result(decay_rate)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Decay rate [1/rad]
      real(wp) :: decay_rate

      decay_rate = film_decay_rate(model, contact)
      if (allocated(model%bearing)) then
         decay_rate = decay_rate + bearing_slope(model, contact%load, contact%relative_spin)/(model%roller_inertia*model%speed)
      end if
      if (has_oil_drag(model)) decay_rate = decay_rate + oil_drag_slope(model, contact%relative_spin) &
         & /(model%roller_inertia*model%speed)
   end function decay_rate_of

   !> Rate with its derivatives over sliding speed and cam angle, all from one solution of the contact.
   subroutine linearise(self, time, state, horizon, linear, counters, status)
      !> The problem, whose state is the sliding speed: no method that takes the surface speed needs derivatives
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed [m/s]
      real(wp), intent(in) :: state(:)
      !> Cam angle up to which the right-hand side is smooth [rad]
      real(wp), intent(in) :: horizon
      !> Rate [m/s/rad] with its derivatives [1/rad, m/s/rad^2]; has its room
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      type(position_t) :: position
      type(moments_t) :: moments
      type(spin_slopes_t) :: slopes
      ! Gas force [N]
      real(wp) :: force
      ! Surface of the roller per turn of the cam [m/rad over rad/s]; relative error of load and forces that is good enough [-];
      ! change of the cam's speed with the cam angle [rad/s/rad]
      real(wp) :: factor, accuracy, gain
      type(contact_t) :: start
      logical :: has_difference

      counters%evaluations = counters%evaluations + 1
      counters%jacobians = counters%jacobians + 1
      has_difference = self%model%ramp%is_moving .and. abs(self%model%ramp%temperature_slope) > 0.0_wp
      accuracy = self%accuracy
      if (has_difference) accuracy = min(accuracy, difference_accuracy)
      gain = 0.0_wp
      if (self%model%ramp%is_moving) gain = self%model%speed_slope
      call start_from(self%nearby, time, state(1), start)
      call follow_ramp(self%model, time)
      call evaluate_loading(self%model, time, position, force, moments, status)
      if (status /= 0) return
      call evaluate_spin_slopes(self%model, time, position, moments, state(1), slopes, status, accuracy, self%mobilised, &
         & start, gain)
      if (status /= 0) return
      if (associated(self%nearby)) call remember(self%nearby, time, state(1), slopes)
      factor = self%model%roller_radius/self%model%speed
      linear%rate(1) = rolling_speed_slope(self%model, position) - factor*slopes%acceleration
      linear%jacobian(1, 1) = -factor*slopes%speed_slope
      linear%time_slope(1) = rolling_speed_curvature(self%model, position, time, horizon) - factor*slopes%angle_slope
      if (abs(gain) > 0.0_wp) linear%time_slope(1) = linear%time_slope(1) + gain*(merge(position%rolling_travel_slope, &
         & position%surface_travel_slope, self%model%has_exact_spin) + factor*slopes%acceleration/self%model%speed)
      linear%span = largest_traction(self%model, position, moments)*self%model%roller_radius*factor/self%model%roller_inertia
      linear%resolution = max(min(coarsest_resolution, accuracy_ratio*self%accuracy), finest_resolution)
      if (self%model%has_local_limit) linear%span = linear%span + self%model%limiting_stress*slopes%contact%sheared_area &
         & *self%model%roller_radius*factor/self%model%roller_inertia
      linear%clearance = huge(1.0_wp)
      if (slopes%contact%is_touching) linear%clearance = 2.0_wp*slopes%contact%entrainment_speed
      if (has_difference) call add_temperature(self, time, state(1), position, slopes%contact, linear, counters, status)
   end subroutine linearise

   !> Keep a contact that has been solved.
   pure subroutine remember(nearby, angle, sliding_speed, slopes)
      !> The contacts
      type(nearby_t), intent(inout) :: nearby
      !> Cam angle from full lift [rad], sliding speed [m/s]
      real(wp), intent(in) :: angle, sliding_speed
      !> The one that comes last, with its changes
      type(spin_slopes_t), intent(in) :: slopes

      if (.not. nearby%has_first) nearby%first = slopes%contact
      nearby%has_first = .true.
      nearby%last = slopes%contact
      nearby%angle = angle
      nearby%sliding_speed = sliding_speed
      nearby%slopes = slopes%start_slopes
   end subroutine remember

   !> Contact to start from: the last one, moved along its slopes; without contact where there is none.
   pure subroutine start_from(nearby, angle, sliding_speed, start)
      !> The contacts, where an integration keeps them
      type(nearby_t), pointer, intent(in) :: nearby
      !> Cam angle from full lift [rad], sliding speed [m/s]
      real(wp), intent(in) :: angle, sliding_speed
      !> What to start from
      type(contact_t), intent(out) :: start

      real(wp) :: change(3) ! of tangential force [N], torque of the bearing [N m], film ratio [-]

      start%is_touching = .false.
      if (.not. associated(nearby)) return
      if (.not. nearby%has_first) return
      start = nearby%last
      if (.not. start%is_touching) return
      change = nearby%slopes(:, 1)*(sliding_speed - nearby%sliding_speed) + nearby%slopes(:, 2)*(angle - nearby%angle)
      start%tangential_force = start%tangential_force + change(1)
      start%bearing_torque = start%bearing_torque + change(2)
      start%film_ratio = start%film_ratio + change(3)
   end subroutine start_from

   !> Add what a changing temperature of the oil does to the derivative over the cam angle: a difference at one position and speed.
   subroutine add_temperature(self, time, sliding_speed, position, nearby, linear, counters, status)
      !> The problem, with its model at the inputs of the angle
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Contact there, to start from
      type(contact_t), intent(in) :: nearby
      !> Rate with its derivatives; out: with the temperature's
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! Angle over which it changes for the difference [rad]: its part in the rate is smooth, and solutions hold round-off
      real(wp), parameter :: increment = 1.0e-5_wp
      type(moments_t) :: moments
      type(position_t) :: same
      type(contact_t) :: contact
      ! Gas force [N]; angular acceleration of the roller [rad/s^2]; rate [m/s/rad]
      real(wp) :: force, acceleration, rate

      counters%evaluations = counters%evaluations + 1
      call follow_ramp(self%model, time, time + increment)
      call evaluate_loading(self%model, time, same, force, moments, status)
      if (status == 0) call evaluate_spin(self%model, position, moments, sliding_speed, contact, acceleration, status, &
         & difference_accuracy, self%mobilised, nearby)
      rate = slip_rate(self%model, position, acceleration)
      if (status == 0) linear%time_slope(1) = linear%time_slope(1) + (rate - linear%rate(1))/increment
      call follow_ramp(self%model, time)
   end subroutine add_temperature

   !> From the sliding speed to that without entrainment, where the film collapses and friction may hold the roller.
   subroutine get_clearance(self, time, state, clearance)
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Sliding speed or surface speed [m/s]
      real(wp), intent(in) :: state(:)
      !> `V_s` without entrainment less `V_s`; huge where the state is the surface speed [m/s]
      real(wp), intent(out) :: clearance

      type(position_t) :: position
      integer :: status

      clearance = huge(1.0_wp)
      if (self%has_surface_speed) return
      call follow_ramp(self%model, time)
      call evaluate_geometry(self%model, time, position, status)
      if (status == 0) clearance = 2.0_wp*self%model%speed*position%surface_travel - state(1)
   end subroutine get_clearance

   !> Largest traction that the contact can make up, friction in the load left out [N]; zero without contact.
   pure function largest_traction(model, position, moments) result(traction)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Traction [N]
      real(wp) :: traction

      traction = model%limiting_coefficient
      if (allocated(model%boundary)) traction = max(traction, largest_coefficient(model%boundary))
      traction = traction*max(moments%total/position%normal_arm, 0.0_wp)
   end function largest_traction

   !> A cam angle in the words of messages, as files count it.
   function name_time(self, time) result(text)
      class(spin_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> It in words
      character(len=words_length) :: text

      text = cam_angle_text(time, 3)
      if (self%has_surface_speed) text = trim(text)//" (fixed step)"
   end function name_time

   !> Sliding speed that belongs to a state.
   pure function sliding_speed_of(problem, position, state) result(sliding_speed)
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
      if (abs(model%speed_slope) > 0.0_wp) then
         slope = slope + model%speed_slope*merge(position%rolling_travel, position%surface_travel, model%has_exact_spin)
      end if
   end function rolling_speed_slope

   !> Second derivative of the speed in pure rolling; by a difference of geometry where it would take the lift's fourth derivative.
   pure function rolling_speed_curvature(model, position, angle, horizon) result(curvature)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam angle, and that up to which the lift is smooth [rad]
      real(wp), intent(in) :: angle, horizon
      !> d2V_roll/d(cam angle)2 [m/s/rad^2]
      real(wp) :: curvature

      type(position_t) :: ahead
      ! Step [rad]
      real(wp) :: step
      integer :: status

      if (model%has_exact_spin) then
         curvature = model%speed*position%rolling_travel_curvature
      else
         step = time_increment(angle, horizon)
         call evaluate_geometry(model, angle + step, ahead, status)
         curvature = 0.0_wp
         if (status == 0) curvature = model%speed*(ahead%surface_travel_slope - position%surface_travel_slope)/step
      end if
      if (abs(model%speed_slope) > 0.0_wp) then
         curvature = curvature + model%speed_slope*merge(position%rolling_travel_slope, position%surface_travel_slope, &
            & model%has_exact_spin)
      end if
   end function rolling_speed_curvature

end module camroller_spin
