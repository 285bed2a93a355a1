!> The sliding joints of a case, made ready: valve tip, stem seal, stem in its guide, pivot.
!>
!> In: case, linkage, lift. Out: `joints_t`, allocated where the case has any.
module camroller_joint_setup
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_case, only : case_t, energy_names
   use camroller_kinematics, only : linkage_t
   use camroller_lift, only : lift_law_t, evaluate_lift
   use camroller_joints, only : joints_t, has_sharp
   use camroller_stem_friction, only : new_tip_part, new_seal_part, new_side_part
   use camroller_pivot_friction, only : new_pivot_part
   implicit none
   private

   public :: set_joints, find_arms

contains

   !> Joints of a case.
   subroutine set_joints(joints, case, linkage, lift_law, error)
      !> The joints; not allocated where the case has none
      type(joints_t), allocatable, intent(out) :: joints
      !> The case
      type(case_t), intent(in) :: case
      !> Its linkage
      type(linkage_t), intent(in) :: linkage
      !> Lift of the lobe
      type(lift_law_t), intent(in) :: lift_law
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (.not. (allocated(case%valve_tip) .or. allocated(case%stem_seal) .or. allocated(case%guide_side_load) .or. &
         & allocated(case%finger_pivot))) return
      if (case%energy /= energy_names(1)) then
         call raise(error, kind_deck, "friction at valve tip, stem and pivot needs energy = 'consistent'")
      else if (allocated(case%finger_pivot) .and. .not. case%masses%finger > 0.0_wp) then
         call raise(error, kind_deck, "finger_pivot: the force of the pivot needs the finger's mass, masses.finger_kg")
      end if
      if (allocated(error)) return
      allocate (joints)
      if (allocated(case%valve_tip)) then
         allocate (joints%tip)
         call new_tip_part(joints%tip, case%valve_tip, error)
         if (allocated(error)) return
      end if
      if (allocated(case%stem_seal)) then
         allocate (joints%seal)
         call new_seal_part(joints%seal, case%stem_seal, error)
         if (allocated(error)) return
      end if
      if (allocated(case%guide_side_load)) then
         allocate (joints%side)
         call new_side_part(joints%side, case%guide_side_load, joints%tip, &
            & maxval(abs(find_arms(linkage, lift_law) - case%guide_side_load%stem_axis)), error)
         if (allocated(error)) return
      end if
      if (allocated(case%finger_pivot)) then
         allocate (joints%pivot)
         call new_pivot_part(joints%pivot, case%finger_pivot, error)
         if (allocated(error)) return
      end if
      if (allocated(case%dynamics) .and. has_sharp(joints)) call raise(error, kind_deck, "friction at valve "// &
         & "tip, stem and pivot of a flexible train, &dynamics, needs reversal speeds above zero")
   end subroutine set_joints

   !> Smallest and largest distance of the pad's contact with the tip from the pivot, across the stem's axis, from the closed valve
   !> to full lift.
   pure function find_arms(linkage, lift_law) result(arms)
      !> The linkage
      type(linkage_t), intent(in) :: linkage
      !> Lift of the lobe
      type(lift_law_t), intent(in) :: lift_law
      !> Distances [m]
      real(wp) :: arms(2)

      ! Lift and its derivatives [m/rad^n]; cosines of gamma + chi with the valve closed and at full lift [-]
      real(wp) :: lift(0:3), cosines(2)

      call evaluate_lift(lift_law, 0.0_wp, lift)
      cosines = linkage%base_cosine - [0.0_wp, lift(0)]/linkage%b
      arms = linkage%b*sqrt(max(0.0_wp, (1.0_wp - cosines)*(1.0_wp + cosines)))
      arms = [minval(arms), maxval(arms)]
      if (cosines(1)*cosines(2) < 0.0_wp) arms(2) = linkage%b
   end function find_arms

end module camroller_joint_setup
