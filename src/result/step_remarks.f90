!> Remarks on a host's step: what it should know of its numbers, in the words in which a case forbids the same.
!>
!> In: extremes of a follower's step with its findings, temperatures of the oil. Out: remarks, one line of each kind.
module camroller_step_remarks
   use camroller_cam_angle, only : append_cam_angle, cam_angle_text
   use camroller_case, only : case_t
   use camroller_cycle_remarks, only : no_rigid_contact
   use camroller_cycle_shares, only : thinnest_ratio_allowed
   use camroller_film, only : groups_t, group_count, group_values, law_table, published_range
   use camroller_film_range, only : group_names, outside_words
   use camroller_film_remarks, only : judge_pressure
   use camroller_follower_samples, only : extremes_t
   use camroller_heat_remarks, only : judge_oil
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_number_text, only : append_number, number_text
   use camroller_oil_checks, only : rises_t
   use camroller_remarks, only : remark_t, add_remark, lost_contact, outside_range, rubbing_contact
   implicit none
   private

   public :: judge_follower_step, judge_step_oil, append_lost, append_outside, append_groups

contains

   !> Remarks on the numbers of a follower's step.
   subroutine judge_follower_step(model, extremes, remarks)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Extremes within the step, with its findings
      type(extremes_t), intent(in) :: extremes
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: text

      associate (findings => extremes%findings)
         if (findings%is_lost) then
            text = ""
            call append_lost(text, findings%lost_angle)
            if (.not. allocated(model%flexible)) text = text//no_rigid_contact
            call add_remark(remarks, lost_contact, text)
         end if
         if (findings%is_outside) then
            text = ""
            call append_outside(text, model%film_law, findings%outside_angle)
            call append_groups(text, model%film_law, findings%outside_groups)
            call add_remark(remarks, outside_range, text)
         end if
         if (findings%film_ratio < thinnest_ratio_allowed) then
            text = "the film between cam and roller is down to "//number_text(findings%film_ratio, 2)//" of the roughness at "// &
               & cam_angle_text(findings%film_ratio_angle, 1)//"; below "//number_text(thinnest_ratio_allowed, 2)//" laws for "// &
               & "smooth surfaces leave the film load that asperities would carry, and friction may be far too small"
            call add_remark(remarks, rubbing_contact, text, 1.0_wp/max(findings%film_ratio, tiny(1.0_wp)))
         end if
      end associate
      call judge_pressure(model, extremes%hertz_pressure, remarks)
   end subroutine judge_follower_step

   !> Remarks on the temperature of the oil at both ends of a step.
   subroutine judge_step_oil(case, temperatures, remarks)
      !> The case
      type(case_t), intent(in) :: case
      !> Temperatures [K]
      real(wp), intent(in) :: temperatures(2)
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      type(remark_t), allocatable :: of_start(:), of_end(:)
      integer :: i

      allocate (of_start(0), of_end(0))
      call judge_oil(case, temperatures(1), rises_t(), of_start)
      call judge_oil(case, temperatures(2), rises_t(), of_end)
      remarks = [remarks, of_end]
      do i = 1, size(of_start)
         if (.not. any(of_end%kind == of_start(i)%kind)) remarks = [remarks, of_start(i)]
      end do
   end subroutine judge_step_oil

   !> Append where contact is lost.
   pure subroutine append_lost(text, angle)
      !> The text
      character(len=:), allocatable, intent(inout) :: text
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      text = text//"contact is lost at "
      call append_cam_angle(text, angle, 3)
   end subroutine append_lost

   !> Append where a film law is outside its published range.
   pure subroutine append_outside(text, law, angle)
      !> The text
      character(len=:), allocatable, intent(inout) :: text
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle

      text = text//trim(outside_words(law))//" at "
      call append_cam_angle(text, angle, 3)
   end subroutine append_outside

   !> Append which groups of a film are outside of the range that its law was published for.
   subroutine append_groups(text, law, groups)
      !> The text
      character(len=:), allocatable, intent(inout) :: text
      !> Position of the law in `film_law_names`
      integer, intent(in) :: law
      !> The groups
      type(groups_t), intent(in) :: groups

      ! Published bounds of the groups, the groups [-]
      real(wp) :: bounds(2, group_count), values(group_count)
      integer :: i

      if (law == law_table) return
      bounds = published_range(law)
      values = group_values(groups)
      do i = 1, group_count
         if (values(i) >= bounds(1, i) .and. values(i) <= bounds(2, i)) cycle
         text = text//"; "//trim(group_names(i))//" is "
         call append_number(text, values(i), 3)
         text = text//", published for "
         call append_number(text, bounds(1, i), 3)
         text = text//" to "
         call append_number(text, bounds(2, i), 3)
      end do
   end subroutine append_groups

end module camroller_step_remarks
