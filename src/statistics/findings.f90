!> What a host should know of a step of a follower beside its numbers: contact that is lost, a film law outside its published range,
!> a film that is next to nothing beside the roughness, a flexible train that fails.
!>
!> In: model, states at the points that the means of a step are made of. Out: `findings_t`, from which `step_remarks` makes words.
module camroller_findings
   use camroller_contact_forces, only : film_groups, law_part
   use camroller_film, only : groups_t, is_in_range, takes_whole_load
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_train_findings, only : train_findings_t, note_train, join_trains
   implicit none
   private

   public :: findings_t, note_findings, join_findings, range_groups

   !> Findings at the points evaluated; angles are from full lift
   type :: findings_t
      !> Is contact lost? Is the film law outside its published range?
      logical :: is_lost = .false., is_outside = .false.
      !> Cam angles at which these are met first [rad]
      real(wp) :: lost_angle = 0.0_wp, outside_angle = 0.0_wp
      !> Groups outside of the range
      type(groups_t) :: outside_groups
      !> Smallest film over the roughness by a law for smooth surfaces; huge without one [-]; its cam angle [rad]
      real(wp) :: film_ratio = huge(1.0_wp), film_ratio_angle = 0.0_wp
      !> Of a flexible train
      type(train_findings_t) :: train
   end type findings_t

contains

   !> Add a state to the findings.
   pure subroutine note_findings(findings, model, state, angle)
      !> The findings
      type(findings_t), intent(inout) :: findings
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      type(groups_t) :: groups

      if (allocated(model%flexible)) call note_train(findings%train, model, state, angle)
      if (.not. state%contact%is_touching) then
         if (findings%is_lost) return
         findings%is_lost = is_lost(model, state)
         findings%lost_angle = angle
         return
      end if
      if (state%contact%film_ratio < findings%film_ratio .and. .not. takes_whole_load(model%film_law)) then
         findings%film_ratio = state%contact%film_ratio
         findings%film_ratio_angle = angle
      end if
      if (findings%is_outside) return
      groups = range_groups(model, state)
      findings%is_outside = .not. is_in_range(model%film_law, groups, model%film_table)
      if (.not. findings%is_outside) return
      findings%outside_angle = angle
      findings%outside_groups = groups
   end subroutine note_findings

   !> Findings of one part of a step and of the next.
   pure function join_findings(one, next) result(both)
      !> Findings of each
      type(findings_t), intent(in) :: one, next
      !> Of both
      type(findings_t) :: both

      both = one
      both%train = join_trains(one%train, next%train)
      if (next%is_lost .and. .not. one%is_lost) then
         both%is_lost = .true.
         both%lost_angle = next%lost_angle
      end if
      if (next%is_outside .and. .not. one%is_outside) then
         both%is_outside = .true.
         both%outside_angle = next%outside_angle
         both%outside_groups = next%outside_groups
      end if
      if (next%film_ratio >= one%film_ratio) return
      both%film_ratio = next%film_ratio
      both%film_ratio_angle = next%film_ratio_angle
   end function join_findings

   !> Is contact lost in a state? With a lash there is none until the cam has taken it up: the rigid train's lift is that of a
   !> train without lash.
   pure function is_lost(model, state) result(verdict)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Is it?
      logical :: verdict

      verdict = .not. state%contact%is_touching
      if (.not. (verdict .and. allocated(model%flexible))) return
      associate (lash => model%flexible%lash)
         if (lash > 0.0_wp) verdict = state%position%lift - state%flexible%lift_error > lash
      end associate
   end function is_lost

   !> Groups by which the film law's range is judged.
   pure function range_groups(model, state) result(groups)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> The groups
      type(groups_t) :: groups

      groups = film_groups(model, state%position, state%contact)
      groups%load = groups%load*law_part(model, state%contact)
   end function range_groups

end module camroller_findings
