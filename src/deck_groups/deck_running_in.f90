!> Decks: wear of cam and roller, the film that grows on them, hours of running.
!>
!> In: keys, settings. Out: the groups, the components of a case, and the rules that tie them to each other.
module camroller_deck_running_in
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain_about_group
   use camroller_deck_schema, only : group_effect, positive, not_negative, range_t
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, has_group
   implicit none
   private

   public :: bind_running_in, check_running_in

   !> Places on the cam: enough to see its flanks, and not so many that a cycle is cheaper than they are [-]
   real(wp), parameter :: fewest_places = 24.0_wp, most_places = 3600.0_wp
   !> Accuracy of the hours: cycles have errors of their own, and steps beyond the largest see nothing of what happens [-]
   real(wp), parameter :: finest = 1.0e-5_wp, coarsest = 0.1_wp

contains

   !> Groups and keys, and the components of a case.
   subroutine bind_running_in(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group("wear", group_effect, "wear of cam and roller by Archard, and stress below their surfaces")
      if (keys%are_wanted(allocated(case%wear))) then
         if (.not. allocated(case%wear)) allocate (case%wear)
         call keys%number("cam_rate_mm3_N_m", not_negative, "specific wear rate of the cam: volume over the load of its "// &
            & "asperities and the sliding distance", case%wear%cam_rate, example="1e-9", usual=[0.0_wp, 1.0e-3_wp])
         call keys%number("roller_rate_mm3_N_m", not_negative, "the same of the roller", case%wear%roller_rate, example="1e-9", &
            & usual=[0.0_wp, 1.0e-3_wp])
      end if
      call keys%group("tribofilm", group_effect, "film that additives of the oil grow on cam and roller over the hours of "// &
         & "&running_in")
      if (keys%are_wanted(allocated(case%tribofilm))) then
         if (.not. allocated(case%tribofilm)) allocate (case%tribofilm)
         associate (film => case%tribofilm)
            call keys%number("growth_rate_nm_s", not_negative, "growth in contact if there were no barrier to the reaction", &
               & film%growth_rate, example="1e7", usual=[0.0_wp, 1.0e15_wp])
            call keys%number("activation_energy_kJ_mol", not_negative, "barrier of the reaction", film%activation_energy, &
               & example="80", usual=[0.0_wp, 250.0_wp])
            call keys%number("activation_volume_nm3", not_negative, "volume by which shear stress lowers the barrier", &
               & film%activation_volume, example="0.1", usual=[0.0_wp, 1.0_wp])
            call keys%number("removal_rate_per_s", not_negative, &
               & "rate at which contact removes the film, relative to its thickness", film%removal_rate, example="0.01", &
               & usual=[0.0_wp, 1.0e3_wp])
            call keys%number("largest_thickness_nm", positive, "thickness at which growth ends and the surface is all covered", &
               & film%largest_thickness, example="120", usual=[1.0_wp, 1.0e3_wp])
            call keys%number("roughness_ratio", not_negative, "roughness of the film over its thickness", film%roughness_ratio, &
               & example="0.3", usual=[0.0_wp, 3.0_wp])
            call keys%number("coefficient", not_negative, "friction coefficient of touching asperities that it covers", &
               & film%coefficient, example="0.11", usual=[0.01_wp, 0.5_wp])
         end associate
      end if
      call keys%group("running_in", group_effect, "hours of running before the cycle of the result, in which films grow and "// &
         & "surfaces wear")
      if (keys%are_wanted(allocated(case%running_in))) then
         if (.not. allocated(case%running_in)) allocate (case%running_in)
         call keys%number("duration_h", positive, "how long", case%running_in%duration, example="10", usual=[1.0e-3_wp, 1.0e4_wp])
         call keys%number("accuracy", range_t(finest, coarsest), &
            & "error allowed for thicknesses and depths, relative to the largest", case%running_in%accuracy)
         call keys%whole_number("places", range_t(fewest_places, most_places), "places on the cam, evenly spaced", &
            & case%running_in%places)
      end if
   end subroutine bind_running_in

   !> Rules: asperities wear, films grow over hours, hours need what changes.
   subroutine check_running_in(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (has_group(settings, "wear") .and. .not. has_group(settings, "asperity")) call complain_about_group(mistakes, &
         & settings, "wear", "&wear needs the group &asperity: asperities wear")
      if (has_group(settings, "tribofilm")) then
         if (.not. has_group(settings, "asperity")) call complain_about_group(mistakes, settings, "tribofilm", &
            & "&tribofilm needs the group &asperity, whose friction it changes")
         if (.not. has_group(settings, "running_in")) call complain_about_group(mistakes, settings, "tribofilm", &
            & "&tribofilm needs the group &running_in: the hours in which it grows")
      end if
      if (.not. has_group(settings, "running_in")) return
      if (.not. (has_group(settings, "wear") .or. has_group(settings, "tribofilm"))) call complain_about_group(mistakes, &
         & settings, "running_in", "&running_in needs &tribofilm or &wear: nothing else changes over hours")
   end subroutine check_running_in

end module camroller_deck_running_in
