!> A quick look round the cycle: what the roller does by its algebraic balance, and how that answers to a change of the model.
!>
!> Layer: solver. In: a model, and one that lacks an effect. Out: changes of torque, film and sliding speed round the cycle.
!>
!> The sliding speed follows the balance with the delay of its decay: between the angles looked at, `dy/dtheta = -lambda (y - q)`
!> is solved with q linear. A change of the model disturbs it by `dv/dtheta = b - lambda v`, with b the difference of the rates at
!> the same sliding speed; a second look at the disturbed state gives the changes to second order.
module camroller_effect_survey
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_balance, only : follow_balance
   use camroller_spin, only : rolling_speed_at, decay_rate_of
   use camroller_stick, only : has_stick
   use camroller_traction, only : cap_sharp
   implicit none
   private

   public :: survey_t, response_t, make_survey, respond, respond_roughly, respond_at_once

   !> Angles looked at, and how many to the next one in a rough look
   integer, parameter :: points = 48, stride = 4
   !> Distance between them [rad]
   real(wp), parameter :: spacing_angle = two_pi/points
   !> Accuracy of a balance over the speed of pure rolling on the base circle [-]
   real(wp), parameter :: balance_accuracy = 1.0e-4_wp
   !> Slowest decay that is told from none [1/rad]
   real(wp), parameter :: slowest_decay = 1.0e-6_wp
   !> Decay between two angles below which a delay may be more than what is seen of it at the angles [-]
   real(wp), parameter :: slowest_resolved = 3.0_wp
   !> Smallest load over the largest one, below which contact may be lost between the angles [-]
   real(wp), parameter :: smallest_load = 1.0e-2_wp
   !> Part of a disturbance that its correction may be [-]
   real(wp), parameter :: largest_correction = 0.5_wp
   !> Exponent of the speed in film laws, about [-]
   real(wp), parameter :: film_exponent = 0.7_wp
   !> Films up to this part above the smallest one may become the smallest [-]
   real(wp), parameter :: near_smallest = 1.5_wp
   !> Laps after which the delayed balance is periodic for all purposes
   integer, parameter :: laps = 3

   !> One lobe's cycle, looked at
   type :: survey_t
      !> Why nothing can be said; not allocated where something can
      character(len=:), allocatable :: trouble
      !> Cam angles from full lift [rad]
      real(wp) :: angles(points)
      !> Sliding speed of the balance, and delayed [m/s]
      real(wp) :: balance(points), sliding(points)
      !> Largest sliding speed of the balance [m/s]
      real(wp) :: scale
      !> Decay rate [1/rad]
      real(wp) :: decay(points)
      !> State at the delayed sliding speed
      type(state_t) :: states(points)
      !> Evaluations of the contact
      integer :: evaluations
   end type survey_t

   !> What a change of the model changes
   type :: response_t
      !> Can it be said?
      logical :: is_known
      !> Mean size of the change of the torque for losses [N m]
      real(wp) :: torque
      !> Change of the smallest film, over it [-]
      real(wp) :: film
      !> Mean size of the change of the sliding speed [m/s]
      real(wp) :: sliding
      !> Evaluations of the contact
      integer :: evaluations
   end type response_t

contains

   !> Look round the cycle.
   subroutine make_survey(model, survey)
      !> The model
      type(model_t), intent(in) :: model
      !> What is seen
      type(survey_t), intent(out) :: survey

      type(position_t) :: position
      ! Accuracy of a balance [m/s]
      real(wp) :: tolerance
      ! Sliding speed of a balance [m/s]
      real(wp) :: sliding_speed
      integer :: i, status
      logical :: is_found

      survey%evaluations = 0
      if (has_stick(model)) then
         survey%trouble = "the roller sticks and slides"
         return
      end if
      survey%angles = [(-pi + (i - 0.5_wp)*spacing_angle, i=1, points)]
      sliding_speed = 0.0_wp
      tolerance = balance_accuracy*model%speed*model%roller_radius
      do i = 1, points
         call follow_balance(model, survey%angles(i), tolerance, position, sliding_speed, survey%decay(i), survey%evaluations, &
            & is_found)
         if (.not. is_found) then
            survey%trouble = "traction cannot keep the roller in balance, or contact is lost"
            return
         end if
         survey%balance(i) = sliding_speed
      end do
      survey%scale = maxval(abs(survey%balance))
      survey%sliding = survey%balance
      call delay(survey%decay, survey%balance, survey%sliding)
      do i = 1, points
         call evaluate_state(model, survey%angles(i), survey%sliding(i), survey%states(i), status)
         if (status /= 0) survey%trouble = "load and friction have no common solution"
         if (status /= 0) return
         survey%decay(i) = decay_rate_of(model, survey%states(i)%contact)
      end do
      survey%evaluations = survey%evaluations + points
      associate (loads => survey%states%contact%load)
         if (minval(loads) < smallest_load*maxval(loads)) survey%trouble = "contact is lost or nearly so"
      end associate
   end subroutine make_survey

   !> Let a quantity follow its balance with its decay, round the cycle until periodic.
   pure subroutine delay(decay, balance, values)
      !> Decay rates [1/rad]
      real(wp), intent(in) :: decay(points)
      !> The balance [any]
      real(wp), intent(in) :: balance(points)
      !> The quantity [any]
      real(wp), intent(inout) :: values(points)

      ! Decay over an interval, what it leaves, its mean weight [-]
      real(wp) :: exponent, left, weight
      integer :: lap, i, next

      do lap = 1, laps
         do i = 1, points
            next = modulo(i, points) + 1
            exponent = max(0.5_wp*(decay(i) + decay(next)), slowest_decay)*spacing_angle
            left = exp(-min(exponent, 700.0_wp))
            weight = (1.0_wp - left)/exponent
            values(next) = balance(next) + left*(values(i) - balance(i)) - weight*(balance(next) - balance(i))
         end do
      end do
   end subroutine delay

   !> How the cycle answers to another model.
   subroutine respond(survey, model, other, response)
      !> The cycle of a model
      type(survey_t), intent(in) :: survey
      !> That model
      type(model_t), intent(in) :: model
      !> Another model, of the same geometry
      type(model_t), intent(in) :: other
      !> What changes
      type(response_t), intent(out) :: response

      type(state_t) :: first(points), second(points)
      ! Decay rates that count [1/rad], disturbing rate [m/s/rad], disturbance and its correction [m/s]
      real(wp) :: decay(points), rates(points), change(points), correction(points)
      logical :: is_fine

      response%is_known = .false.
      response%torque = 0.0_wp
      response%film = 0.0_wp
      response%sliding = 0.0_wp
      response%evaluations = points
      call look(survey, other, survey%sliding, first, decay, is_fine)
      if (.not. is_fine) return
      rates = rate_change(model, first, survey%states)
      decay = min(decay, survey%decay)
      change = 0.0_wp
      call delay(decay, rates/max(decay, slowest_decay), change)
      second = first
      correction = 0.0_wp
      if (maxval(abs(change)) > 0.0_wp) then
         rates = decay*change
         call look(survey, other, survey%sliding + change, second, decay, is_fine)
         response%evaluations = response%evaluations + points
         if (.not. is_fine) return
         rates = rates + rate_change(model, second, first)
         call delay(decay, rates/max(decay, slowest_decay), correction)
         if (sum(abs(correction)) > largest_correction*sum(abs(change))) return
      end if
      call sum_up(survey, model, second, change, correction, response)
   end subroutine respond

   !> How the cycle answers to another model, seen at few angles before the sliding speed has changed: no bound, but enough to
   !> tell that an effect matters.
   subroutine respond_roughly(survey, model, other, response)
      !> The cycle of a model
      type(survey_t), intent(in) :: survey
      !> That model
      type(model_t), intent(in) :: model
      !> Another model, of the same geometry
      type(model_t), intent(in) :: other
      !> What changes
      type(response_t), intent(out) :: response

      type(state_t) :: state
      ! Disturbing rate [m/s/rad]
      real(wp) :: rate
      integer :: i, status

      response%is_known = .true.
      response%torque = 0.0_wp
      response%film = 0.0_wp
      response%sliding = 0.0_wp
      response%evaluations = points/stride
      do i = stride/2, points, stride
         call evaluate_state(other, survey%angles(i), survey%sliding(i), state, status)
         if (status /= 0) response%is_known = .false.
         if (status /= 0) return
         associate (base => survey%states(i))
            rate = model%roller_radius/model%speed*(state%spin_acceleration - base%spin_acceleration)
            response%torque = response%torque + abs(state%torque_friction - base%torque_friction)*stride/points
            response%film = max(response%film, abs(state%contact%film_min/base%contact%film_min - 1.0_wp))
            response%sliding = response%sliding + abs(rate)/max(survey%decay(i), slowest_decay)*stride/points
         end associate
      end do
   end subroutine respond_roughly

   !> How the cycle answers to a roller that follows its balance without delay.
   subroutine respond_at_once(survey, model, tolerance, response)
      !> The cycle of a model
      type(survey_t), intent(in) :: survey
      !> That model
      type(model_t), intent(in) :: model
      !> Error of the balance over the largest sliding speed [-]
      real(wp), intent(in) :: tolerance
      !> What changes
      type(response_t), intent(out) :: response

      type(state_t) :: states(points)
      ! Decay rates [1/rad], change of the sliding speed and its error [m/s]
      real(wp) :: decay(points), change(points), error(points)
      logical :: is_fine

      response%is_known = .false.
      response%evaluations = points
      response%torque = 0.0_wp
      response%film = 0.0_wp
      response%sliding = 0.0_wp
      ! At a sharp limit of the traction there is no decay, if only between the angles
      if (model%cap == cap_sharp .or. minval(survey%decay)*spacing_angle < slowest_resolved) return
      call look(survey, model, survey%balance, states, decay, is_fine)
      if (.not. is_fine) return
      change = survey%balance - survey%sliding
      error = tolerance*survey%scale
      call sum_up(survey, model, states, change, error, response)
   end subroutine respond_at_once

   !> States of a model round the cycle.
   subroutine look(survey, model, sliding, states, decay, is_fine)
      !> Where to look
      type(survey_t), intent(in) :: survey
      !> The model
      type(model_t), intent(in) :: model
      !> Sliding speeds [m/s]
      real(wp), intent(in) :: sliding(points)
      !> The states
      type(state_t), intent(out) :: states(points)
      !> Decay rates [1/rad]
      real(wp), intent(out) :: decay(points)
      !> Is there a state everywhere, in contact?
      logical, intent(out) :: is_fine

      integer :: i, status

      is_fine = .true.
      do i = 1, points
         call evaluate_state(model, survey%angles(i), sliding(i), states(i), status)
         is_fine = status == 0
         if (is_fine) is_fine = states(i)%contact%is_touching
         if (.not. is_fine) return
         decay(i) = decay_rate_of(model, states(i)%contact)
      end do
   end subroutine look

   !> Difference of the rates of the sliding speed between states.
   pure function rate_change(model, states, others) result(rates)
      !> The model, for its speed and radius
      type(model_t), intent(in) :: model
      !> States, and those that they are compared with
      type(state_t), intent(in) :: states(points), others(points)
      !> Differences of dV_s/dtheta [m/s/rad]
      real(wp) :: rates(points)

      rates = -model%roller_radius/model%speed*(states%spin_acceleration - others%spin_acceleration)
   end function rate_change

   !> Changes of the quantities that matter, sizes added up.
   pure subroutine sum_up(survey, model, second, change, correction, response)
      !> The cycle as it is
      type(survey_t), intent(in) :: survey
      !> Its model
      type(model_t), intent(in) :: model
      !> States after the change
      type(state_t), intent(in) :: second(points)
      !> Change of the sliding speed, and what is left of it to be corrected [m/s]
      real(wp), intent(in) :: change(points), correction(points)
      !> What changes
      type(response_t), intent(inout) :: response

      ! Changes of torque [N m] and film [m]; films [m]; change of the torque with the sliding speed [N s]
      real(wp) :: torques(points), films(points), film(points), torque_slope(points)

      associate (contact => second%contact)
         torque_slope = (abs(contact%traction) + contact%traction_slope*abs(contact%sliding_speed))/model%speed
         if (.not. model%is_consistent) torque_slope = contact%traction_slope*abs(survey%states%position%cam_arm)
         films = film_exponent*0.5_wp*contact%film_min/max(abs(contact%entrainment_speed), tiny(1.0_wp))
      end associate
      film = survey%states%contact%film_min
      films = abs(second%contact%film_min - film) + min(films*abs(correction), second%contact%film_min)
      torques = abs(second%torque_friction - survey%states%torque_friction) + torque_slope*abs(correction)
      response%torque = sum(torques)/points
      response%sliding = sum(abs(change) + abs(correction))/points
      response%film = maxval(films, mask=film - films <= near_smallest*minval(film))/minval(film)
      response%is_known = .true.
   end subroutine sum_up

end module camroller_effect_survey
