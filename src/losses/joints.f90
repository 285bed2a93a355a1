!> Sliding joints of the train: pad on valve tip, stem in seal and guide, finger on its pivot.
!>
!> In: what a case has of them. Out: all of them ready for evaluation, each allocated where the case has it.
module camroller_joints
   use camroller_kinds, only : wp
   use camroller_stem_friction, only : tip_part_t, seal_part_t, side_part_t, set_stem_oil
   use camroller_pivot_friction, only : pivot_part_t
   use camroller_sliding_friction, only : set_duty
   implicit none
   private

   public :: joints_t, set_joint_oil, jumps_with_tip, has_sharp, has_curves, has_tip_curve

   !> Sliding joints
   type :: joints_t
      !> Pad on valve tip
      type(tip_part_t), allocatable :: tip
      !> Stem seal
      type(seal_part_t), allocatable :: seal
      !> Stem pressed against its guide
      type(side_part_t), allocatable :: side
      !> Finger on the ball of its pivot
      type(pivot_part_t), allocatable :: pivot
   end type joints_t

contains

   !> Give the joints the oil's viscosity.
   pure subroutine set_joint_oil(joints, viscosity)
      !> The joints
      type(joints_t), intent(inout) :: joints
      !> Viscosity of the oil at ambient pressure [Pa s]
      real(wp), intent(in) :: viscosity

      call set_stem_oil(joints%tip, joints%seal, joints%side, viscosity)
      if (allocated(joints%pivot)) call set_duty(joints%pivot%law, viscosity)
   end subroutine set_joint_oil

   !> Does the friction of any joint jump where its sliding turns round? Valve and finger turn round in the same place.
   pure function has_sharp(joints) result(jumps)
      !> The joints
      type(joints_t), intent(in) :: joints
      !> Does it?
      logical :: jumps

      jumps = jumps_with_tip(joints)
      if (allocated(joints%seal)) jumps = jumps .or. (joints%seal%lip_force > 0.0_wp .and. is_sharp(joints%seal%reversal_speed))
      if (allocated(joints%side)) jumps = jumps .or. is_sharp(joints%side%law%reversal_speed)
      if (allocated(joints%pivot)) jumps = jumps .or. is_sharp(joints%pivot%law%reversal_speed)
   end function has_sharp

   !> Does friction jump where the contact of pad and tip passes the height of the pivot?
   pure function jumps_with_tip(joints) result(jumps)
      !> The joints
      type(joints_t), intent(in) :: joints
      !> Does it?
      logical :: jumps

      jumps = .false.
      if (allocated(joints%tip)) jumps = is_sharp(joints%tip%law%reversal_speed)
   end function jumps_with_tip

   !> Does the friction of a joint follow Stribeck's curve?
   pure function has_curves(joints) result(has)
      !> The joints
      type(joints_t), intent(in) :: joints
      !> Does it?
      logical :: has

      has = has_tip_curve(joints)
      if (allocated(joints%side)) has = has .or. joints%side%law%has_curve
      if (allocated(joints%pivot)) has = has .or. joints%pivot%law%has_curve
   end function has_curves

   !> Does that of the valve's tip?
   pure function has_tip_curve(joints) result(has)
      !> The joints
      type(joints_t), intent(in) :: joints
      !> Does it?
      logical :: has

      has = .false.
      if (allocated(joints%tip)) has = joints%tip%law%has_curve
   end function has_tip_curve

   !> Does friction with this reversal speed jump?
   pure function is_sharp(reversal_speed)
      !> Speed over which it reverses [m/s]
      real(wp), intent(in) :: reversal_speed
      !> Does it?
      logical :: is_sharp

      is_sharp = reversal_speed <= 0.0_wp
   end function is_sharp

end module camroller_joints
