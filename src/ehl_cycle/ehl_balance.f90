!> Balance of the finger over a contact whose film is solved.
!>
!> In: moments about the pivot, friction of the contact. Out: the load, with the torque of the roller's bearing and the friction of
!> the pivot, which depend on it.
module camroller_ehl_balance
   use camroller_kinds, only : wp
   use camroller_contact_forces, only : find_bearing_torque, has_curved_bearing
   use camroller_dual, only : dual_t
   use camroller_dynamics, only : moments_t
   use camroller_joint_forces, only : finger_moment, has_pivot_friction, set_pivot_forces
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t
   use camroller_pivot_friction, only : pivot_forces_t, pivot_moment
   use camroller_spin, only : rolling_speed_at
   implicit none
   private

   public :: balanced_load, bearing_moment

contains

   !> Torque of the roller's bearing.
   pure function bearing_moment(model, position, load, sliding_speed) result(torque)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> Load [N], sliding speed [m/s]
      real(wp), intent(in) :: load, sliding_speed
      !> Torque [N m]
      real(wp) :: torque

      real(wp) :: by_load ! [m]

      call find_bearing_torque(model, load, spin_at(model, position, sliding_speed), torque, by_load)
   end function bearing_moment

   !> Spin of the roller over the finger.
   pure function spin_at(model, position, sliding_speed) result(spin)
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> The spin [rad/s]
      real(wp) :: spin

      spin = (rolling_speed_at(model, position) - sliding_speed)/model%roller_radius &
         & - model%linkage%sense*position%finger_slope*model%speed
   end function spin_at

   !> Load at which the finger is in balance with the friction given.
   pure function balanced_load(model, position, moments, traction, rolling, sliding_speed) result(load)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Traction and rolling resistance [N]
      real(wp), intent(in) :: traction, rolling
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Load; zero where the moments would lift the roller off [N]
      real(wp) :: load

      ! Rounds, at most
      integer, parameter :: most_rounds = 50
      ! Relative change of the load that ends them [-]
      real(wp), parameter :: tolerance = 4.0_wp*epsilon(1.0_wp)
      ! Moment that the contact balances, torque of the roller's bearing [N m]; arm, slope of that torque over the load [m]
      real(wp) :: moment, torque, arm, by_load
      ! Net tangential force on the roller, load of the round before [N]
      real(wp) :: tangential, before
      integer :: round

      arm = merge(position%normal_arm, position%parallel_arm, model%has_exact_arm)
      moment = finger_moment(model, position, moments)
      if (model%is_consistent) then
         tangential = traction + rolling*(2.0_wp*position%equivalent_radius/model%roller_radius - 1.0_wp)
         moment = moment - model%linkage%sense*tangential*position%tangent_arm
      end if
      load = max(moment/arm, 0.0_wp)
      torque = 0.0_wp
      by_load = 0.0_wp
      do round = 1, most_rounds
         before = load
         ! Along the tangent of the torque, which is the torque where it is in proportion
         if (model%is_consistent) call find_bearing_torque(model, load, spin_at(model, position, sliding_speed), torque, by_load)
         torque = torque - by_load*load
         load = (moment - model%linkage%sense*torque)/(arm + model%linkage%sense*by_load)
         if (has_pivot_friction(model)) call add_pivot_friction(model, position, moments, tangential, moment &
            & - model%linkage%sense*torque, arm + model%linkage%sense*by_load, load)
         load = max(load, 0.0_wp)
         if (.not. has_curved_bearing(model) .or. abs(load - before) <= tolerance*load) exit
      end do
      if (model%takes_maximum_load) load = max(load, model%base_circle_load)
   end function balanced_load

   !> The same with the friction of the pivot, which depends on the load: a contraction, whose factor is the friction circle of the
   !> ball over the arm of the load.
   pure subroutine add_pivot_friction(model, position, moments, tangential, moment, arm, load)
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> Moments about the pivot
      type(moments_t), intent(in) :: moments
      !> Net tangential force on the roller [N]
      real(wp), intent(in) :: tangential
      !> Moment that the load balances without the pivot's [N m], arm of the load [m]
      real(wp), intent(in) :: moment, arm
      !> In: load without the friction of the pivot, out: with it [N]
      real(wp), intent(inout) :: load

      ! Rounds, at most
      integer, parameter :: most_rounds = 50
      ! Relative change of the load that ends them [-]
      real(wp), parameter :: tolerance = 4.0_wp*epsilon(1.0_wp)
      type(pivot_forces_t) :: forces
      ! Friction of the pivot [N m]
      type(dual_t) :: friction
      ! Load of the round before [N]
      real(wp) :: before
      integer :: round

      call set_pivot_forces(model, position, moments, 0.0_wp, forces, 0.0_wp)
      do round = 1, most_rounds
         before = load
         friction = pivot_moment(model%joints%pivot, forces, dual_t(load, 0.0_wp), dual_t(tangential, 0.0_wp))
         load = (moment + friction%value)/arm
         if (abs(load - before) <= tolerance*abs(load)) exit
      end do
   end subroutine add_pivot_friction

end module camroller_ehl_balance
