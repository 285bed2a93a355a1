!> Quasi-static balance of the roller: the sliding speed at which its spin follows the kinematics without delay.
!>
!> In: model, cam angle. Out: sliding speed at which `dV_s/dtheta` vanishes, decay rate of disturbances there. Used as a starting
!> value and as a scale; exact in the limit of a decay that is fast compared with the change of the kinematics.
module camroller_balance
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_contact_forces, only : contact_t
   use camroller_state, only : evaluate_loading, evaluate_spin
   use camroller_spin, only : film_decay_rate, rolling_speed_at, slip_rate
   use camroller_stick, only : has_stick, rates_at_rest, breakaway
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   implicit none
   private

   public :: find_balance, follow_balance, least_slip

   !> Steps from a guess nearby before the search restarts: each gains a digit or more
   integer, parameter :: max_steps = 12
   !> Sliding speed that counts as none, and as a scale where there is less, over the speed of pure rolling [-]
   real(wp), parameter :: least_slip = 1.0e-5_wp

contains

   !> Sliding speed of the quasi-static balance at an angle.
   subroutine find_balance(model, angle, tolerance, position, sliding_speed, decay_rate, is_found)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Accuracy of the sliding speed over the speed of pure rolling [-]
      real(wp), intent(in) :: tolerance
      !> Geometry there
      type(position_t), intent(out) :: position
      !> Sliding speed [m/s]; zero where there is none
      real(wp), intent(out) :: sliding_speed
      !> Decay rate of a disturbance there [1/rad]
      real(wp), intent(out) :: decay_rate
      !> Is there a balance with a sliding speed below that of a roller at rest?
      logical, intent(out) :: is_found

      type(moments_t) :: moments
      type(contact_t) :: contact
      type(bracket_t) :: bracket
      ! Gas force [N]; largest sliding speed tried [m/s]; dV_s/dtheta where one is tried and at both ends of the bracket [m/s/rad]
      real(wp) :: force, limit, rate, rate_low, rate_high
      integer :: status

      sliding_speed = 0.0_wp
      decay_rate = 0.0_wp
      is_found = .false.
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) return
      limit = abs(rolling_speed_at(model, position))
      call find_rest(model, angle, limit, decay_rate, is_found, status)
      if (is_found .or. status /= 0) return
      call sliding_rate(model, position, moments, -limit, tolerance, contact, rate_low)
      call sliding_rate(model, position, moments, limit, tolerance, contact, rate_high)
      call start_bracket(bracket, -limit, limit, rate_low, rate_high, tolerance*limit)
      do while (bracket%status == root_wanted)
         call sliding_rate(model, position, moments, bracket%trial, tolerance, contact, rate)
         call narrow_bracket(bracket, rate)
      end do
      is_found = bracket%status == root_found .and. contact%is_touching
      if (.not. is_found) return
      sliding_speed = bracket%trial
      decay_rate = film_decay_rate(model, contact)
   end subroutine find_balance

   !> Is the balance a roller at rest on the cam, held there by friction?
   subroutine find_rest(model, angle, rolling, decay_rate, is_found, status)
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Speed of pure rolling, positive [m/s]
      real(wp), intent(in) :: rolling
      !> Decay rate that stands for friction, which stops the slip that counts as none at all [1/rad]
      real(wp), intent(out) :: decay_rate
      !> Is it? Never so where friction is regularised
      logical, intent(out) :: is_found
      !> 0 fine, else as from the contact
      integer, intent(out) :: status

      ! Rates at rest with friction at either limit [m/s/rad]
      real(wp) :: rates(2)

      is_found = .false.
      decay_rate = 0.0_wp
      status = 0
      if (.not. has_stick(model)) return
      call rates_at_rest(model, angle, rates, status)
      is_found = status == 0 .and. rates(1) < rates(2) .and. breakaway(rates, 0.0_wp) == 0
      if (is_found) decay_rate = min(-rates(1), rates(2))/(least_slip*rolling)
   end subroutine find_rest

   !> Sliding speed of the quasi-static balance from a guess nearby; by the search over all speeds where that does not settle.
   subroutine follow_balance(model, angle, tolerance, position, sliding_speed, decay_rate, evaluations, is_found)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Accuracy of the sliding speed [m/s]
      real(wp), intent(in) :: tolerance
      !> Geometry there
      type(position_t), intent(out) :: position
      !> Sliding speed, in: to start from [m/s]
      real(wp), intent(inout) :: sliding_speed
      !> Decay rate of a disturbance there [1/rad]
      real(wp), intent(out) :: decay_rate
      !> Evaluations of the contact, counted on
      integer, intent(inout) :: evaluations
      !> Is there a balance?
      logical, intent(out) :: is_found

      ! Evaluations of a search over all speeds, about
      integer, parameter :: search = 16
      type(moments_t) :: moments
      ! Gas force [N]; speed of pure rolling, or what stands for it at rest [m/s]
      real(wp) :: force, rolling
      integer :: status

      is_found = .false.
      decay_rate = 0.0_wp
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) return
      rolling = max(abs(rolling_speed_at(model, position)), tolerance)
      call find_rest(model, angle, rolling, decay_rate, is_found, status)
      if (is_found) sliding_speed = 0.0_wp
      if (is_found .or. status /= 0) return
      call improve_balance(model, position, moments, tolerance, sliding_speed, decay_rate, evaluations, is_found)
      if (is_found) return
      call find_balance(model, angle, tolerance/rolling, position, sliding_speed, decay_rate, is_found)
      evaluations = evaluations + search
   end subroutine follow_balance

   !> Sliding speed of the quasi-static balance from one nearby, by Newton's method with the slope at constant film and load.
   subroutine improve_balance(model, position, moments, tolerance, sliding_speed, decay_rate, evaluations, is_found)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Accuracy of the sliding speed [m/s]
      real(wp), intent(in) :: tolerance
      !> Sliding speed, in: to start from [m/s]
      real(wp), intent(inout) :: sliding_speed
      !> Decay rate of a disturbance there [1/rad]
      real(wp), intent(out) :: decay_rate
      !> Evaluations of the contact, counted on
      integer, intent(inout) :: evaluations
      !> Did it settle, at a sliding speed below that of a roller at rest?
      logical, intent(out) :: is_found

      ! Part of the tolerance to which the contact is solved [-]
      real(wp), parameter :: part = 1.0e-2_wp
      type(contact_t) :: contact, last
      ! dV_s/dtheta [m/s/rad]; step [m/s]; speed of pure rolling [m/s]
      real(wp) :: rate, step, rolling
      integer :: i

      is_found = .false.
      decay_rate = 0.0_wp
      rolling = abs(rolling_speed_at(model, position))
      contact%is_touching = .false.
      do i = 1, max_steps
         last = contact
         call sliding_rate(model, position, moments, sliding_speed, part*tolerance/max(tolerance, rolling), contact, rate, last)
         evaluations = evaluations + 1
         decay_rate = film_decay_rate(model, contact)
         if (.not. decay_rate > 0.0_wp) exit
         step = rate/decay_rate
         if (.not. abs(sliding_speed + step) < rolling) exit
         sliding_speed = sliding_speed + step
         is_found = abs(step) <= tolerance .and. contact%is_touching
         if (is_found) return
      end do
   end subroutine improve_balance

   !> dV_s/dtheta at a sliding speed.
   subroutine sliding_rate(model, position, moments, sliding_speed, accuracy, contact, rate, start)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Relative error of load and forces that is good enough [-]
      real(wp), intent(in) :: accuracy
      !> State of the contact
      type(contact_t), intent(out) :: contact
      !> dV_s/dtheta [m/s/rad]
      real(wp), intent(out) :: rate
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start

      ! Angular acceleration [rad/s^2]
      real(wp) :: acceleration
      integer :: status

      call evaluate_spin(model, position, moments, sliding_speed, contact, acceleration, status, accuracy, start=start)
      rate = slip_rate(model, position, acceleration)
   end subroutine sliding_rate

end module camroller_balance
