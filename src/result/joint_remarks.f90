!> Remarks on sliding joints whose laws are used far from where they hold: Stribeck's curve without a film, the drag of a seal in
!> cold oil.
!>
!> In: joints, means over a cycle. Out: remarks, one per line.
module camroller_joint_remarks
   use camroller_joint_shares, only : curve_groups, least_part, part_left
   use camroller_joints, only : joints_t
   use camroller_kinds, only : wp
   use camroller_means, only : statistics_t
   use camroller_number_text, only : number_text
   use camroller_remarks, only : add_remark, remark_t, spent_friction, thick_seal_oil
   use camroller_torque_list, only : is_loss
   implicit none
   private

   public :: judge_joints

   !> Viscosity over that for which a seal's drag is given, from which on it is far from what it is given for: a lip runs on a film
   !> that grows with about the root of viscosity times speed, and its drag with no more than that, a third of what is taken [-]
   real(wp), parameter :: far_viscosity = 10.0_wp
   !> Part of the follower's friction from which on that of the seal's drag is worth a word [-]
   real(wp), parameter :: notable_part = 0.1_wp

contains

   !> Remarks on the joints of a lobe.
   subroutine judge_joints(joints, viscosity, speed, statistics, remarks)
      !> The joints
      type(joints_t), intent(in) :: joints
      !> Viscosity of the oil [Pa s], speed of the cam [rad/s]
      real(wp), intent(in) :: viscosity, speed
      !> Means over the cycle of the lobe
      type(statistics_t), intent(in) :: statistics
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      real(wp) :: coefficients(size(curve_groups)) ! at standstill [-]
      integer :: i

      coefficients = 0.0_wp
      if (allocated(joints%tip)) coefficients(1) = joints%tip%law%coefficient
      if (allocated(joints%side)) coefficients(2) = joints%side%law%coefficient
      if (allocated(joints%pivot)) coefficients(3) = joints%pivot%law%coefficient
      do i = 1, size(curve_groups)
         associate (curve => statistics%joints%curves(i))
            ! Stribeck's curve without a viscous part has left nothing of a joint's friction
            if (part_left(curve) < least_part) call add_remark(remarks, spent_friction, "friction of &"// &
               & trim(curve_groups(i))//" has fallen to next to nothing: for "//number_text(100.0_wp*curve%spent_share, 3)// &
               & " % of the cycle less than "//number_text(least_part, 1)//" of it is left, and its coefficient is "// &
               & number_text(part_left(curve)*coefficients(i), 2)//" on average over the sliding, where films between "// &
               & "sliding surfaces have 0.005 to 0.06; "//trim(curve_groups(i))//".viscous_part_s_m gives that of the "// &
               & "film, which is left out", 100.0_wp*curve%spent_share)
         end associate
      end do
      if (allocated(joints%seal)) call judge_seal(joints, viscosity, statistics%joints%drag_power, &
         & speed*sum(statistics%torques, mask=is_loss), remarks)
   end subroutine judge_joints

   !> Say that a notable part of the friction is the drag of a seal in oil far more viscous than the one that it is given for.
   subroutine judge_seal(joints, viscosity, power, losses, remarks)
      !> The joints, with a seal
      type(joints_t), intent(in) :: joints
      !> Viscosity of the oil [Pa s]
      real(wp), intent(in) :: viscosity
      !> Mean power of the drag, of all friction of the follower [W]
      real(wp), intent(in) :: power, losses
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      associate (seal => joints%seal)
         if (viscosity < far_viscosity*seal%reference_viscosity .or. .not. (seal%reference_viscosity > 0.0_wp .and. &
            & power > notable_part*losses)) return
         associate (ratio => viscosity/seal%reference_viscosity)
            call add_remark(remarks, thick_seal_oil, "the viscous drag of the stem seal takes "// &
               & number_text(100.0_wp*power/losses, 2)//" % of the follower's friction: it goes with the viscosity, "// &
               & number_text(ratio, 3)//" times stem_seal.reference_viscosity_Pa_s here, without limit, and is "// &
               & number_text(seal%drag, 3)//" N s/m; the drag of a lip on its film grows with about the root of the "// &
               & "viscosity, to "//number_text(seal%drag/sqrt(ratio), 2)//" N s/m here; give that, or one measured in oil as "// &
               & "cold, with stem_seal.drag_follows = 'constant'", ratio)
         end associate
      end associate
   end subroutine judge_seal

end module camroller_joint_remarks
