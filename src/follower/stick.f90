!> A roller that rolls without sliding: the friction that holds it, and when it begins to slide.
!>
!> In: model, cam angle. Out: rates of the sliding speed at rest with boundary friction at either limit, and the fraction of it
!> that keeps the roller at rest. The friction law is set-valued: `F_b sgn(V_s)` while the roller slides, any value between
!> `-F_b` and `F_b` at `V_s = 0`. The rate decreases with the fraction, so that at most one value holds the roller.
module camroller_stick
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_contact_forces, only : contact_t
   use camroller_state, only : evaluate_loading, evaluate_spin
   use camroller_spin, only : slip_rate
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   implicit none
   private

   public :: has_stick, rates_at_rest, breakaway, share_at_rest, rest_speed, touching_capacity

   !> Rate that counts as none, over the difference between both limits [-]: a few roundings of the forces behind it
   real(wp), parameter :: no_rate = 1.0e-14_wp

   !> Sliding speed that counts as none over the error allowed for it: round-off of a difference between large speeds [-]
   real(wp), parameter :: rest_part = 1.0e-3_wp

contains

   !> Is boundary friction set-valued?
   pure function has_stick(model)
      !> The model
      type(model_t), intent(in) :: model
      !> Is it?
      logical :: has_stick

      has_stick = .false.
      if (allocated(model%boundary)) has_stick = model%boundary%is_set_valued
   end function has_stick

   !> Sliding speed that counts as none.
   elemental function rest_speed(tolerance)
      !> Error allowed for a sliding speed [m/s]
      real(wp), intent(in) :: tolerance
      !> The speed [m/s]
      real(wp) :: rest_speed

      rest_speed = rest_part*tolerance
   end function rest_speed

   !> Rates of the sliding speed at rest with all of the boundary friction against either direction of sliding.
   pure subroutine rates_at_rest(model, angle, rates, status)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> dV_s/dtheta with the friction of forward and of backward sliding; the first is the smaller one [m/s/rad]
      real(wp), intent(out) :: rates(2)
      !> 0 fine, negative: the finger cannot reach this lift, positive: no balance found
      integer, intent(out) :: status

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]
      real(wp) :: force

      rates = 0.0_wp
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status == 0) call rate_at_rest(model, position, moments, 1.0_wp, rates(1), status)
      if (status == 0) call rate_at_rest(model, position, moments, -1.0_wp, rates(2), status)
   end subroutine rates_at_rest

   !> Direction in which a roller at rest starts to slide; 0 where friction holds it.
   pure function breakaway(rates, threshold) result(direction)
      !> Rates at rest [m/s/rad]
      real(wp), intent(in) :: rates(2)
      !> Rate up to which friction holds [m/s/rad]
      real(wp), intent(in) :: threshold
      !> 1, -1 or 0
      integer :: direction

      direction = 0
      if (rates(1) > threshold) direction = 1
      if (rates(2) < -threshold) direction = -1
   end function breakaway

   !> Part of the boundary friction that keeps a roller at rest; all of it where that is not enough.
   pure subroutine share_at_rest(model, angle, share, status)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Mobilised part, -1 to 1 [-]
      real(wp), intent(out) :: share
      !> 0 fine, negative: the finger cannot reach this lift, positive: no balance found
      integer, intent(out) :: status

      type(position_t) :: position
      type(moments_t) :: moments
      type(bracket_t) :: bracket
      ! Gas force [N]; rates with all of it, and with a part of it [m/s/rad]
      real(wp) :: force, rates(2), rate

      share = 0.0_wp
      call rates_at_rest(model, angle, rates, status)
      if (status /= 0) return
      if (rates(1) >= rates(2)) return
      share = real(breakaway(rates, 0.0_wp), wp)
      if (abs(share) > 0.0_wp) return
      call evaluate_loading(model, angle, position, force, moments, status)
      call start_bracket(bracket, 1.0_wp, -1.0_wp, rates(1), rates(2), 0.0_wp)
      do while (bracket%status == root_wanted)
         call rate_at_rest(model, position, moments, bracket%trial, rate, status)
         if (status /= 0) return
         if (abs(rate) <= no_rate*(rates(2) - rates(1))) rate = 0.0_wp
         call narrow_bracket(bracket, rate)
      end do
      share = bracket%trial
   end subroutine share_at_rest

   !> Rate of the sliding speed at rest with a part of the boundary friction.
   pure subroutine rate_at_rest(model, position, moments, share, rate, status)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Mobilised part [-]
      real(wp), intent(in) :: share
      !> dV_s/dtheta [m/s/rad]
      real(wp), intent(out) :: rate
      !> 0 fine, positive: no balance found
      integer, intent(out) :: status

      type(contact_t) :: contact
      ! Angular acceleration of the roller [rad/s^2]
      real(wp) :: acceleration

      call evaluate_spin(model, position, moments, 0.0_wp, contact, acceleration, status, mobilised=share)
      rate = slip_rate(model, position, acceleration)
   end subroutine rate_at_rest

   !> Boundary friction that touching asperities can bear at a sliding speed; huge where the contact has no balance.
   pure function touching_capacity(model, angle, sliding_speed) result(capacity)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> F_b [N]
      real(wp) :: capacity

      type(position_t) :: position
      type(moments_t) :: moments
      type(contact_t) :: contact
      ! Gas force [N]; angular acceleration of the roller [rad/s^2]
      real(wp) :: force, acceleration
      integer :: status

      capacity = huge(1.0_wp)
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) return
      call evaluate_spin(model, position, moments, sliding_speed, contact, acceleration, status)
      if (status == 0) capacity = contact%boundary_capacity
   end function touching_capacity

end module camroller_stick
