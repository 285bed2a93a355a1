!> Friction of the finger's socket on the ball of its pivot.
!>
!> In: forces on the finger. Out: force of the ball on the finger as the vector that balances them, and the moment of its friction,
!> with their derivatives in one direction. Source: momentum balance of the finger, `doc/theory.md`.
module camroller_pivot_friction
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_dual, only : dual_t, constant_part, operator(-), operator(*), operator(+), sqrt
   use camroller_sliding_friction, only : sliding_t, sliding_law_t, new_sliding_law, friction_limit, direction_of
   implicit none
   private

   public :: finger_pivot_t, pivot_part_t, pivot_forces_t, new_pivot_part, hold_forces, pivot_reaction, pivot_moment, &
      & largest_slope

   !> Socket on ball
   type :: finger_pivot_t
      !> Radius of the ball [m]
      real(wp) :: ball_radius = 0.0_wp
      type(sliding_t) :: sliding
   end type finger_pivot_t

   !> The same ready for evaluation
   type :: pivot_part_t
      !> Radius of the ball [m]
      real(wp) :: ball_radius = 0.0_wp
      type(sliding_law_t) :: law
   end type pivot_part_t

   !> What the ball's force is made of at one cam angle
   type :: pivot_forces_t
      !> Mass times acceleration of the finger's centre less the force of the valve on the pad [N]
      type(dual_t) :: rest(2)
      !> Directions of load and net tangential force on the roller [-]
      type(dual_t) :: normal(2), tangent(2)
      !> Angular speed of the finger, opening positive [rad/s]
      type(dual_t) :: finger_speed
   end type pivot_forces_t

   !> Largest change of the ball's force that its friction may make by the finger's acceleration, over the force: nearer to one the
   !> finger jams [-]
   real(wp), parameter :: largest_slope = 0.9_wp

contains

   !> Make the pivot ready.
   subroutine new_pivot_part(part, pivot, error)
      !> Ready for evaluation
      type(pivot_part_t), intent(out) :: part
      !> As a deck has it
      type(finger_pivot_t), intent(in) :: pivot
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      part%ball_radius = pivot%ball_radius
      call new_sliding_law(part%law, pivot%sliding, "finger_pivot", error)
   end subroutine new_pivot_part

   !> Hold the angle: what follows then changes with load and traction alone.
   pure subroutine hold_forces(forces)
      !> What the ball's force is made of; out: without slopes
      type(pivot_forces_t), intent(inout) :: forces

      forces%rest = constant_part(forces%rest)
      forces%normal = constant_part(forces%normal)
      forces%tangent = constant_part(forces%tangent)
      forces%finger_speed = constant_part(forces%finger_speed)
   end subroutine hold_forces

   !> Force of the ball on the finger, `R_C = m_F a_G - (W n + T' t) - F_valve`, x from pivot to cam centre.
   pure function pivot_reaction(forces, load, tangential_force) result(reaction)
      !> What it is made of
      type(pivot_forces_t), intent(in) :: forces
      !> Contact load, W, and net tangential force on the roller, T' [N]
      type(dual_t), intent(in) :: load, tangential_force
      !> The force [N]
      type(dual_t) :: reaction(2)

      reaction = forces%rest - load*forces%normal - tangential_force*forces%tangent
   end function pivot_reaction

   !> Moment of the friction about the pivot, against the finger's turning: positive where the finger opens the valve.
   pure function pivot_moment(part, forces, load, tangential_force) result(moment)
      !> The pivot
      type(pivot_part_t), intent(in) :: part
      !> What the ball's force is made of
      type(pivot_forces_t), intent(in) :: forces
      !> Contact load, W, and net tangential force on the roller, T' [N]
      type(dual_t), intent(in) :: load, tangential_force
      !> Moment [N m]
      type(dual_t) :: moment

      ! Force of the ball [N], its size [N]; speed of the socket over the ball [m/s]
      type(dual_t) :: reaction(2), force, speed

      reaction = pivot_reaction(forces, load, tangential_force)
      force = sqrt(reaction(1)*reaction(1) + reaction(2)*reaction(2))
      speed = part%ball_radius*forces%finger_speed
      moment = part%ball_radius*(direction_of(speed, part%law%reversal_speed)*friction_limit(part%law, force, speed))
   end function pivot_moment

end module camroller_pivot_friction
