!> What Stribeck's curve leaves of the friction of sliding joints over a cycle, and what the drag of a stem seal takes.
!>
!> In: model, states with the part of the cycle that each stands for. Out: `joint_shares_t`, from which `joint_remarks` makes
!> words.
module camroller_joint_shares
   use camroller_dual, only : dual_t
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_sliding_friction, only : direction_of, friction_limit, sliding_law_t
   use camroller_state, only : state_t
   implicit none
   private

   public :: joint_shares_t, note_joints, curve_groups, least_part, part_left

   !> Joints whose friction may follow the curve, by their groups
   character(len=*), parameter :: curve_groups(*) = [character(len=15) :: "valve_tip", "guide_side_load", "finger_pivot"]

   !> A joint over a cycle
   type :: curve_shares_t
      !> Means over the cycle of speed times friction, times the friction without the curve's fall [W]
      real(wp) :: power = 0.0_wp, full_power = 0.0_wp
      !> Fraction of the cycle in which less than `least_part` of the friction is left [-]
      real(wp) :: spent_share = 0.0_wp
   end type curve_shares_t

   !> All joints over a cycle
   type :: joint_shares_t
      !> Those whose friction may follow the curve, in the order of `curve_groups`
      type(curve_shares_t) :: curves(size(curve_groups))
      !> Mean over the cycle of the power that the seal's viscous drag takes [W]
      real(wp) :: drag_power = 0.0_wp
   end type joint_shares_t

   !> Part of its friction at standstill below which a joint has none to speak of: of the usual coefficient of 0.1 that is 0.005,
   !> less than any lubricated pad has, so that the friction of the film is more than all that is counted [-]
   real(wp), parameter :: least_part = 0.05_wp

contains

   !> Note what is left of the friction of joints without a viscous part, and the drag of the seal.
   pure subroutine note_joints(shares, model, state, weight)
      !> The joints
      type(joint_shares_t), intent(inout) :: shares
      !> Model of the lobe, which has joints
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      associate (joints => model%joints, curves => shares%curves, values => state%joints, &
         & valve_speed => model%speed*state%position%lift_slope)
         if (allocated(joints%tip)) call note_curve(curves(1), joints%tip%law, values%tip_force, values%tip_speed, weight)
         if (allocated(joints%side)) then
            call note_curve(curves(2), joints%side%law, values%upper_force, valve_speed, 0.5_wp*weight)
            call note_curve(curves(2), joints%side%law, values%lower_force, valve_speed, 0.5_wp*weight)
         end if
         if (allocated(joints%pivot)) call note_curve(curves(3), joints%pivot%law, values%pivot_force, &
            & joints%pivot%ball_radius*model%speed*state%position%finger_slope, weight)
         if (allocated(joints%seal)) shares%drag_power = shares%drag_power + weight*joints%seal%drag*valve_speed**2
      end associate
   end subroutine note_joints

   !> Note what is left at one surface.
   pure subroutine note_curve(curve, law, force, speed, weight)
      !> The joint
      type(curve_shares_t), intent(inout) :: curve
      type(sliding_law_t), intent(in) :: law
      !> Force between the surfaces [N], sliding speed, of either sign [m/s]
      real(wp), intent(in) :: force, speed
      !> Fraction of the cycle [-]
      real(wp), intent(in) :: weight

      type(dual_t) :: friction, direction ! [N], [-]

      if (.not. law%has_curve .or. law%viscous_part > 0.0_wp .or. .not. force*law%coefficient > 0.0_wp) return
      friction = friction_limit(law, dual_t(force, 0.0_wp), dual_t(speed, 0.0_wp))
      direction = direction_of(dual_t(speed, 0.0_wp), law%reversal_speed)
      curve%power = curve%power + weight*speed*direction%value*friction%value
      curve%full_power = curve%full_power + weight*abs(speed)*law%coefficient*force
      if (friction%value < least_part*law%coefficient*force) curve%spent_share = curve%spent_share + weight
   end subroutine note_curve

   !> Part of its friction at standstill that a joint has while it slides, by work.
   elemental function part_left(curve) result(part)
      !> The joint
      type(curve_shares_t), intent(in) :: curve
      !> The part; one where there is no such friction [-]
      real(wp) :: part

      part = 1.0_wp
      if (curve%full_power > 0.0_wp) part = curve%power/curve%full_power
   end function part_left

end module camroller_joint_shares
