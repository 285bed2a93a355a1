!> A survey of the cycle: the roller by its quasi-static balance, and its response to a change of the model.
!>
!> In: a model, and one that lacks an effect. Out: changes of torque, film and sliding speed round the cycle.
!>
!> The sliding speed follows the balance with the delay of its decay: between its angles, `dy/dtheta = -lambda (y - q)`
!> is solved with q linear. A change of the model disturbs it by `dv/dtheta = b - lambda v`, with b the difference of the rates at
!> the same sliding speed; a second evaluation at the disturbed state gives the changes to second order.
!>
!> The uncertainty of the survey is estimated without further evaluations: from the sliding speed with the mean decay of the roller
!> equation between balance and delayed sliding speed, with half of the angles, and with the slower decay of two angles; and from
!> the difference of means over all angles and over half of them.
module camroller_effect_survey
   use camroller_contact_traction, only : largest_shear
   use camroller_kinds, only : wp
   use camroller_effect_grid, only : grid_t, points, slowest_decay, make_grid, delay, mean_over, sampling_error
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_balance, only : follow_balance
   use camroller_spin, only : decay_rate_of, slip_rate, surface_rate
   use camroller_stick, only : has_stick
   implicit none
   private

   public :: survey_t, response_t, make_survey, respond

   !> Accuracy of a balance relative to the speed of pure rolling on the base circle [-]
   real(wp), parameter :: balance_accuracy = 1.0e-4_wp
   !> Smallest load relative to the largest one, below which contact may be lost between the angles [-]
   real(wp), parameter :: smallest_load = 1.0e-2_wp
   !> Largest correction relative to the disturbance [-]
   real(wp), parameter :: largest_correction = 0.5_wp
   !> Exponent of the speed in film laws, about [-]
   real(wp), parameter :: film_exponent = 0.7_wp
   !> Largest exponent of the load in film laws: rigid surfaces, constant viscosity [-]
   real(wp), parameter :: load_exponent = 1.0_wp
   !> Films up to this part above the smallest one may become the smallest [-]
   real(wp), parameter :: near_smallest = 1.5_wp
   !> Error of the sliding speed relative to the speed, as means of magnitudes, above which no estimate is made [-]
   real(wp), parameter :: largest_error = 0.5_wp

   !> Survey of the cycle of one lobe
   type :: survey_t
      !> Why nothing can be said; not allocated where something can
      character(len=:), allocatable :: trouble
      !> Angles of the survey
      type(grid_t) :: grid
      !> Sliding speed of the balance, and delayed; error that the latter may have [m/s]
      real(wp) :: balance(points), sliding(points), error(points)
      !> Decay rate [1/rad]
      real(wp) :: decay(points)
      !> State at the delayed sliding speed
      type(state_t) :: states(points)
      !> Mean torque for losses, and its uncertainty [N m]
      real(wp) :: torque, torque_error
      !> Mean sliding speed, and its uncertainty [m/s]
      real(wp) :: slip, slip_error
      !> Evaluations of the contact
      integer :: evaluations
   end type survey_t

   !> What a change of the model changes
   type :: response_t
      !> Can it be said?
      logical :: is_known
      !> Mean magnitude of the change of the torque for losses [N m]
      real(wp) :: torque
      !> Change of the smallest film, over it [-]
      real(wp) :: film
      !> Mean magnitude of the change of the sliding speed [m/s]
      real(wp) :: sliding
      !> Mean magnitude of the change of the load over the mean load [-]
      real(wp) :: load
      !> The cycle after the change, but for its sliding speeds
      type(survey_t), allocatable :: changed
      !> Evaluations of the contact
      integer :: evaluations
   end type response_t

contains

   !> Survey the cycle.
   subroutine make_survey(model, survey)
      !> The model
      type(model_t), intent(in) :: model
      !> What is seen
      type(survey_t), intent(out) :: survey

      type(position_t) :: position
      ! Accuracy of a balance [m/s]
      real(wp) :: tolerance
      ! Sliding speed of a balance [m/s]; decay rates there [1/rad]
      real(wp) :: sliding_speed, balance_decay(points)
      integer :: i, status
      logical :: is_found

      survey%evaluations = 0
      if (has_stick(model)) then
         survey%trouble = "the roller sticks and slides"
         return
      end if
      call make_grid(model, survey%grid)
      sliding_speed = 0.0_wp
      tolerance = balance_accuracy*model%speed*model%roller_radius
      do i = 1, points
         call follow_balance(model, survey%grid%angles(i), tolerance, position, sliding_speed, survey%decay(i), &
            & survey%evaluations, is_found)
         if (.not. is_found) then
            survey%trouble = "traction cannot keep the roller in balance, or contact is lost"
            return
         end if
         survey%balance(i) = sliding_speed
      end do
      survey%sliding = survey%balance
      call delay(survey%grid, survey%decay, survey%balance, survey%sliding)
      balance_decay = survey%decay
      do i = 1, points
         call evaluate_state(model, survey%grid%angles(i), survey%sliding(i), survey%states(i), status)
         if (status /= 0) survey%trouble = "no load satisfies the equilibrium of the contact"
         if (status /= 0) return
         survey%decay(i) = decay_rate_of(model, survey%states(i)%contact)
      end do
      survey%evaluations = survey%evaluations + points
      if (is_nearly_lost(survey%states)) survey%trouble = "contact is lost or nearly so"
      if (allocated(survey%trouble)) return
      call estimate_uncertainty(model, balance_decay, survey)
   end subroutine make_survey

   !> Uncertainty of a survey.
   subroutine estimate_uncertainty(model, balance_decay, survey)
      type(model_t), intent(in) :: model
      !> Decay rates at the balance, with which the sliding speed was delayed [1/rad]
      real(wp), intent(in) :: balance_decay(points)
      !> The survey; its errors are set
      type(survey_t), intent(inout) :: survey

      ! Decay rates from the balance to the sliding speed [1/rad]; balances that go with them, sliding speed that follows from both,
      ! from half the angles, and with slower decays [m/s]; torques for losses [N m]
      real(wp) :: decay(points), balance(points), again(points), coarse(points), slow(points), torques(points)
      integer :: i

      do i = 1, points
         call refine_decay(model, survey, i, balance_decay(i), decay(i), balance(i))
      end do
      again = survey%sliding
      call delay(survey%grid, decay, balance, again)
      coarse = survey%balance
      call delay(survey%grid, balance_decay, survey%balance, coarse, surveys=2)
      slow = survey%balance
      call delay(survey%grid, balance_decay, survey%balance, slow, is_slow=.true.)
      survey%error = max(abs(again - survey%sliding), abs(coarse - survey%sliding), abs(slow - survey%sliding))
      if (mean_over(survey%grid, survey%error) > largest_error*mean_over(survey%grid, abs(survey%sliding))) then
         survey%trouble = "the survey of the cycle does not resolve the slip"
      end if
      torques = survey%states%torque_friction
      survey%torque = mean_over(survey%grid, torques)
      survey%torque_error = sampling_error(survey%grid, torques) &
         & + mean_over(survey%grid, torque_slopes(model, survey%states)*survey%error)
      survey%slip = mean_over(survey%grid, survey%sliding)
      survey%slip_error = sampling_error(survey%grid, survey%sliding) + mean_over(survey%grid, survey%error)
   end subroutine estimate_uncertainty

   !> Decay and balance with which the roller equation has the rate that it has at the delayed sliding speed.
   subroutine refine_decay(model, survey, point, balance_decay, decay, balance)
      type(model_t), intent(in) :: model
      type(survey_t), intent(in) :: survey
      !> Which of its angles
      integer, intent(in) :: point
      !> Decay rate at the balance [1/rad]
      real(wp), intent(in) :: balance_decay
      !> Decay rate between balance and delayed sliding speed [1/rad]
      real(wp), intent(out) :: decay
      !> Balance, found anew where that of the survey does not agree with the rate [m/s]
      real(wp), intent(out) :: balance

      ! What a decay between two sliding speeds may be outside those at both [-]
      real(wp), parameter :: leeway = 2.0_wp
      ! dV_s/dtheta [m/s/rad]; distance from the balance [m/s]
      real(wp) :: rate, distance

      associate (state => survey%states(point), local => survey%decay(point))
         rate = slip_rate(model, state%position, state%spin_acceleration)
         distance = survey%sliding(point) - survey%balance(point)
         balance = survey%balance(point)
         if (-rate*distance > 0.0_wp .and. abs(distance) > epsilon(1.0_wp)*abs(survey%sliding(point))) then
            decay = -rate/distance
            if (decay >= min(local, balance_decay)/leeway .and. decay <= max(local, balance_decay)*leeway) return
         end if
         decay = max(local, slowest_decay)
         balance = survey%sliding(point) + rate/decay
      end associate
   end subroutine refine_decay

   !> Is contact lost somewhere, or nearly so?
   pure function is_nearly_lost(states) result(verdict)
      !> States round the cycle
      type(state_t), intent(in) :: states(points)
      !> Is it?
      logical :: verdict

      verdict = minval(states%contact%load) < smallest_load*maxval(states%contact%load)
   end function is_nearly_lost

   !> How the cycle answers to another model.
   subroutine respond(survey, model, other, response, moments)
      !> The cycle of a model
      type(survey_t), intent(in) :: survey
      !> That model
      type(model_t), intent(in) :: model
      !> Another model, of the same geometry
      type(model_t), intent(in) :: other
      !> What changes
      type(response_t), intent(out) :: response
      !> Further moments about the pivot that press the roller on the cam in the other model; absent: none [N m]
      real(wp), intent(in), optional :: moments(points)

      type(state_t) :: first(points), second(points)
      ! Decay rates that count [1/rad], disturbing rate [m/s/rad], disturbance and its correction [m/s]
      real(wp) :: decay(points), rates(points), change(points), correction(points)
      logical :: is_fine

      response%is_known = .false.
      response%torque = 0.0_wp
      response%film = 0.0_wp
      response%sliding = 0.0_wp
      response%load = 0.0_wp
      response%evaluations = points
      call look(survey, other, survey%sliding, moments, first, decay, is_fine)
      if (.not. is_fine) return
      rates = rate_change(model, first, survey%states)
      decay = min(decay, survey%decay)
      change = 0.0_wp
      call delay(survey%grid, decay, rates/max(decay, slowest_decay), change)
      second = first
      correction = 0.0_wp
      if (maxval(abs(change)) > 0.0_wp) then
         rates = decay*change
         call look(survey, other, survey%sliding + change, moments, second, decay, is_fine)
         response%evaluations = response%evaluations + points
         if (.not. is_fine) return
         rates = rates + rate_change(model, second, first)
         call delay(survey%grid, decay, rates/max(decay, slowest_decay), correction)
         if (mean_over(survey%grid, abs(correction)) > largest_correction*mean_over(survey%grid, abs(change))) return
      end if
      call sum_up(survey, model, second, change, correction, response)
   end subroutine respond

   !> States of a model round the cycle.
   subroutine look(survey, model, sliding, moments, states, decay, is_fine)
      !> The angles
      type(survey_t), intent(in) :: survey
      type(model_t), intent(in) :: model
      !> Sliding speeds [m/s]
      real(wp), intent(in) :: sliding(points)
      !> Further moments about the pivot [N m]
      real(wp), intent(in), optional :: moments(points)
      type(state_t), intent(out) :: states(points)
      !> Decay rates [1/rad]
      real(wp), intent(out) :: decay(points)
      !> Is there a state everywhere, in contact?
      logical, intent(out) :: is_fine

      integer :: i, status

      is_fine = .true.
      do i = 1, points
         if (present(moments)) then
            call evaluate_state(model, survey%grid%angles(i), sliding(i), states(i), status, further_moment=moments(i))
         else
            call evaluate_state(model, survey%grid%angles(i), sliding(i), states(i), status)
         end if
         is_fine = status == 0
         if (is_fine) is_fine = states(i)%contact%is_touching
         if (.not. is_fine) return
         decay(i) = decay_rate_of(model, states(i)%contact)
      end do
      is_fine = .not. is_nearly_lost(states)
   end subroutine look

   !> Difference of the rates of the sliding speed between states.
   pure function rate_change(model, states, others) result(rates)
      !> The model, for its speed and radius
      type(model_t), intent(in) :: model
      !> States, and those that they are compared with
      type(state_t), intent(in) :: states(points), others(points)
      !> Differences of dV_s/dtheta [m/s/rad]
      real(wp) :: rates(points)

      rates = -surface_rate(model, states%spin_acceleration - others%spin_acceleration)
   end function rate_change

   !> Changes of the quantities that matter, magnitudes added up.
   pure subroutine sum_up(survey, model, second, change, correction, response)
      !> The cycle as it is
      type(survey_t), intent(in) :: survey
      type(model_t), intent(in) :: model
      !> States after the change
      type(state_t), intent(in) :: second(points)
      !> Change of the sliding speed, and what is left of it to be corrected [m/s]
      real(wp), intent(in) :: change(points), correction(points)
      !> What changes
      type(response_t), intent(inout) :: response

      ! Changes of torque [N m], film [m] and sliding speed [m/s]; films [m], loads [N]; largest film that may become the smallest
      ! [m]
      real(wp) :: torques(points), films(points), slips(points), film(points), load(points), reach

      film = survey%states%contact%film_min
      films = abs(second%contact%film_min - film) + second%contact%film_min*min(film_slopes(model, second, abs(correction)), 1.0_wp)
      torques = abs(second%torque_friction - survey%states%torque_friction) + torque_slopes(model, second)*abs(correction)
      slips = abs(change) + abs(correction)
      response%torque = mean_over(survey%grid, torques) + sampling_error(survey%grid, torques)
      response%sliding = mean_over(survey%grid, slips) + sampling_error(survey%grid, slips)
      reach = near_smallest*max(minval(film(1::2)), minval(film(2::2)))
      response%film = maxval(films, mask=film - films <= reach)/minval(film)
      load = survey%states%contact%load
      response%load = mean_over(survey%grid, abs(second%contact%load - load))/mean_over(survey%grid, load)
      response%changed = survey
      response%changed%states = second
      response%is_known = .true.
   end subroutine sum_up

   !> Change of the torque with the sliding speed.
   pure function torque_slopes(model, states) result(slopes)
      type(model_t), intent(in) :: model
      !> States round the cycle
      type(state_t), intent(in) :: states(points)
      !> The slopes, positive [N s]
      real(wp) :: slopes(points)

      associate (contact => states%contact)
         slopes = (abs(contact%traction) + contact%traction_slope*abs(contact%sliding_speed))/model%speed
         if (.not. model%is_consistent) slopes = contact%traction_slope*abs(states%position%cam_arm)
      end associate
   end function torque_slopes

   !> Relative change of the film with the sliding speed: with the entrainment, and with the load, which traction changes.
   pure function film_slopes(model, states, distance) result(changes)
      type(model_t), intent(in) :: model
      !> States round the cycle
      type(state_t), intent(in) :: states(points)
      !> Change of the sliding speed, positive [m/s]
      real(wp), intent(in) :: distance(points)
      !> Relative changes of the film, positive [-]
      real(wp) :: changes(points)

      ! Change of the traction: not more than from one limit to the other [N]
      real(wp) :: traction(points)

      associate (contact => states%contact, position => states%position)
         changes = film_exponent*0.5_wp*distance/max(abs(contact%entrainment_speed), tiny(1.0_wp))
         if (.not. model%is_consistent) return
         traction = min(contact%traction_slope*distance, &
            & 2.0_wp*(largest_shear(model, contact) + contact%boundary_capacity))
         changes = changes + load_exponent*traction*abs(position%tangent_arm)/(position%normal_arm*contact%load)
      end associate
   end function film_slopes

end module camroller_effect_survey
