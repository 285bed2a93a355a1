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
   use camroller_flexible_measures, only : largest_lift
   use camroller_flexible_sample, only : is_closed
   use camroller_follower_samples, only : extremes_t
   use camroller_gas, only : usual_pressure, vacuum
   use camroller_heat_remarks, only : judge_oil
   use camroller_kinds, only : wp
   use camroller_lash_adjuster, only : usual_supply
   use camroller_model, only : model_t
   use camroller_number_text, only : append_number, number_text
   use camroller_oil_checks, only : rises_t
   use camroller_remarks, only : remark_t, add_remark, lost_contact, outside_range, rubbing_contact, &
      & unusual_gas, unusual_supply
   use camroller_train_findings, only : train_findings_t, worst_t
   use camroller_train_words, only : tell_lower_stop, tell_open_valve, tell_relief, tell_sinking, tell_suction, tell_tension, &
      & tell_upper_stop
   implicit none
   private

   public :: judge_follower_step, judge_step_oil, judge_step_supply, judge_step_gas, append_lost, append_outside, append_groups

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
      if (allocated(model%flexible)) call judge_train_step(model, extremes%findings%train, remarks)
   end subroutine judge_follower_step

   !> Remarks on a flexible train in a step.
   subroutine judge_train_step(model, findings, remarks)
      !> Model of the lobe, with a flexible train
      type(model_t), intent(in) :: model
      !> What a host should know of its step
      type(train_findings_t), intent(in) :: findings
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      call tell_tension(model, findings%tension%value, place_of(findings%tension), remarks)
      if (does_not_close(model, findings)) call tell_open_valve(-findings%closing%value, place_of(findings%closing), remarks)
      if (allocated(model%flexible%adjuster)) then
         call tell_upper_stop(model, findings%rise%value, place_of(findings%rise), remarks)
         call tell_lower_stop(model, -findings%fall%value, place_of(findings%fall), remarks)
         call tell_sinking(model, -findings%fall%value, place_of(findings%fall), remarks)
         call tell_suction(-findings%suction%value, place_of(findings%suction), remarks)
      end if
      call tell_relief(findings%relief%value, remarks, place_of(findings%relief))
   end subroutine judge_train_step

   !> Is the valve open opposite full lift, and its cam leaves it closed?
   function does_not_close(model, findings) result(verdict)
      !> Model of the lobe, with a flexible train
      type(model_t), intent(in) :: model
      !> What a host should know of its step
      type(train_findings_t), intent(in) :: findings
      !> Is it?
      logical :: verdict

      ! In most steps there is no such angle, or the valve is closed
      verdict = findings%closing%value < 0.0_wp .and. findings%closing%value > -huge(1.0_wp)
      if (verdict) verdict = is_closed(model, findings%cam_lift%angle, findings%cam_lift%value, largest_lift(model))
   end function does_not_close

   !> Where the worst was met, in words.
   pure function place_of(worst) result(text)
      type(worst_t), intent(in) :: worst
      !> Its cam angle
      character(len=len(cam_angle_text(worst%angle, 1))) :: text

      text = cam_angle_text(worst%angle, 1)
   end function place_of

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

   !> Remark on a supply pressure of a lash adjuster that engines do not have; 0 is that of one that has stood.
   subroutine judge_step_supply(pressures, remarks)
      !> Gauge pressures at both ends of a step [Pa]
      real(wp), intent(in) :: pressures(2)
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      integer :: odd

      odd = findloc(pressures > 0.0_wp .and. (pressures < usual_supply(1) .or. pressures > usual_supply(2)), .true., dim=1)
      if (odd > 0) call add_remark(remarks, unusual_supply, "a supply pressure of "//number_text(pressures(odd), 6)// &
         & " Pa is unusual: engines have "//number_text(usual_supply(1), 6)//" to "//number_text(usual_supply(2), 6)// &
         & " Pa above ambient")
   end subroutine judge_step_supply

   !> Remark on a gas pressure that engines do not have; next to none is part of every cycle.
   subroutine judge_step_gas(pressures, remarks)
      !> Gauge pressures at both ends of a step [Pa]
      real(wp), intent(in) :: pressures(2)
      !> Remarks so far
      type(remark_t), allocatable, intent(inout) :: remarks(:)

      integer :: odd

      odd = findloc(pressures < vacuum .or. pressures > usual_pressure(2), .true., dim=1)
      if (odd > 0) call add_remark(remarks, unusual_gas, "a gas pressure of "//number_text(pressures(odd), 6)// &
         & " Pa is unusual: engines have "//number_text(vacuum, 6)//" to "//number_text(usual_pressure(2), 6)//" Pa above ambient")
   end subroutine judge_step_gas

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
