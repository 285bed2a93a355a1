!> Friction of the finger's socket on its pivot in a train that bends.
!>
!> In: force of the ball on the finger without that friction, what a moment on the finger changes of it, rate of the finger. Out:
!> force of the ball, moment of the friction, its derivatives. The friction follows from the force, and by the finger's
!> acceleration the force from the friction: `M = r f(|R_0 - M q|, v)`, one equation for the moment.
module camroller_flexible_pivot
   use camroller_kinds, only : wp
   use camroller_dual, only : dual_t, operator(*)
   use camroller_pivot_friction, only : pivot_part_t
   use camroller_sliding_friction, only : direction_of, friction_limit
   implicit none
   private

   public :: ball_t, hold_ball

   !> Ball under the finger
   type :: ball_t
      !> Force of the ball on the finger without its friction [N]; change of it by a moment on the finger, q [1/m]
      complex(wp) :: free = (0.0_wp, 0.0_wp), by_moment = (0.0_wp, 0.0_wp)
      !> Force of the ball on the finger [N]
      complex(wp) :: force = (0.0_wp, 0.0_wp)
      !> Moment of the friction against the finger's turning, positive where the finger opens the valve [N m]
      real(wp) :: moment = 0.0_wp
      !> Its derivatives over the size of the force [m] and over the finger's rate [N m s/rad]
      real(wp) :: by_force = 0.0_wp, by_rate = 0.0_wp
   end type ball_t

   !> Steps of Newton's method: each doubles the figures from about two
   integer, parameter :: most_steps = 20
   !> Relative change of the moment whose square is rounding [-]
   real(wp), parameter :: last_change = 1.0e-8_wp

contains

   !> Moment of the friction: Newton's method from the force without it.
   pure subroutine hold_ball(pivot, rate, ball)
      !> The pivot
      type(pivot_part_t), intent(in) :: pivot
      !> Rate of the finger, opening positive [rad/s]
      real(wp), intent(in) :: rate
      !> In: force without the friction; out: with it
      type(ball_t), intent(inout) :: ball

      type(dual_t) :: friction ! moment by the force that is there [N m]
      ! Size of the force [N], its slope over the moment [1/m]; change of the moment [N m]
      real(wp) :: size, slope, change
      integer :: i

      ball%moment = 0.0_wp
      do i = 1, most_steps
         call see_force(ball, size, slope)
         friction = friction_at(pivot, dual_t(size, slope), dual_t(rate, 0.0_wp))
         change = (friction%value - ball%moment)/(1.0_wp - friction%slope)
         ball%moment = ball%moment + change
         if (abs(change) <= last_change*abs(ball%moment)) exit
      end do
      call see_force(ball, size, slope)
      friction = friction_at(pivot, dual_t(size, 1.0_wp), dual_t(rate, 0.0_wp))
      ball%by_force = friction%slope
      friction = friction_at(pivot, dual_t(size, 0.0_wp), dual_t(rate, 1.0_wp))
      ball%by_rate = friction%slope
   end subroutine hold_ball

   !> Force of the ball under the moment so far.
   pure subroutine see_force(ball, size, slope)
      !> The ball; out: with its force
      type(ball_t), intent(inout) :: ball
      !> Size of the force [N], its slope over the moment [1/m]
      real(wp), intent(out) :: size, slope

      ball%force = ball%free - ball%moment*ball%by_moment
      size = abs(ball%force)
      slope = 0.0_wp
      if (size > 0.0_wp) slope = -real(conjg(ball%force)*ball%by_moment, wp)/size
   end subroutine see_force

   !> Moment of the friction for a force of the ball and a rate of the finger.
   pure function friction_at(pivot, force, rate) result(moment)
      type(pivot_part_t), intent(in) :: pivot
      !> Size of the force [N], rate [rad/s]
      type(dual_t), intent(in) :: force, rate
      !> Moment [N m]
      type(dual_t) :: moment

      type(dual_t) :: speed ! of the socket over the ball [m/s]

      speed = pivot%ball_radius*rate
      moment = pivot%ball_radius*(direction_of(speed, pivot%law%reversal_speed)*friction_limit(pivot%law, force, speed))
   end function friction_at

end module camroller_flexible_pivot
