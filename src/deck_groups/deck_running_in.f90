!> Decks: wear of cam and roller, the film that grows on them, hours of running.
!>
!> In: schema, settings. Out: groups and keys, the components of a case, and the rules that tie them to each other.
module camroller_deck_running_in
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain_about_group
   use camroller_deck_schema, only : schema_t, add_group, add_integer, add_number, group_effect, not_negative, positive, range_t
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, has_group, take
   use camroller_tribofilm, only : running_in_t
   implicit none
   private

   public :: add_running_in_keys, fill_running_in, check_running_in

   !> Places on the cam: enough to see its flanks, and not so many that a cycle is cheaper than they are [-]
   real(wp), parameter :: fewest_places = 24.0_wp, most_places = 3600.0_wp
   !> Accuracy of the hours: cycles have errors of their own, and steps beyond the largest see nothing of what happens [-]
   real(wp), parameter :: finest = 1.0e-5_wp, coarsest = 0.1_wp

contains

   !> Groups and keys.
   subroutine add_running_in_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(running_in_t) :: standard

      call add_group(schema, "wear", group_effect, "wear of cam and roller by Archard, and stress below their surfaces")
      call add_number(schema, "cam_rate_mm3_N_m", not_negative, "specific wear rate of the cam: volume over the load of its "// &
         & "asperities and the sliding distance", example="1e-9")
      call add_number(schema, "roller_rate_mm3_N_m", not_negative, "the same of the roller", example="1e-9")
      call add_group(schema, "tribofilm", group_effect, &
         & "film that additives of the oil grow on cam and roller over the hours of &running_in")
      call add_number(schema, "growth_rate_nm_s", not_negative, "growth in contact if there were no barrier to the reaction", &
         & example="1e7")
      call add_number(schema, "activation_energy_kJ_mol", not_negative, "barrier of the reaction", example="80")
      call add_number(schema, "activation_volume_nm3", not_negative, "volume by which shear stress lowers the barrier", &
         & example="0.1")
      call add_number(schema, "removal_rate_per_s", not_negative, "rate at which contact removes the film, relative to its "// &
         & "thickness", example="0.01")
      call add_number(schema, "largest_thickness_nm", positive, "thickness at which growth ends and the surface is all covered", &
         & example="120")
      call add_number(schema, "roughness_ratio", not_negative, "roughness of the film over its thickness", example="0.3")
      call add_number(schema, "coefficient", not_negative, "friction coefficient of touching asperities that it covers", &
         & example="0.11")
      call add_group(schema, "running_in", group_effect, &
         & "hours of running before the cycle of the result, in which films grow and surfaces wear")
      call add_number(schema, "duration_h", positive, "how long", example="10")
      call add_number(schema, "accuracy", range_t(finest, coarsest), "error allowed for thicknesses and depths, relative to "// &
         & "the largest", default=standard%accuracy)
      call add_integer(schema, "places", range_t(fewest_places, most_places), "places on the cam, evenly spaced", &
         & default=standard%places)
   end subroutine add_running_in_keys

   !> Fill the components of a case.
   subroutine fill_running_in(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (has_group(settings, "wear")) then
         allocate (case%wear)
         call take(settings, "wear", "cam_rate_mm3_N_m", case%wear%cam_rate)
         call take(settings, "wear", "roller_rate_mm3_N_m", case%wear%roller_rate)
      end if
      if (has_group(settings, "tribofilm")) then
         allocate (case%tribofilm)
         associate (film => case%tribofilm)
            call take(settings, "tribofilm", "growth_rate_nm_s", film%growth_rate)
            call take(settings, "tribofilm", "activation_energy_kJ_mol", film%activation_energy)
            call take(settings, "tribofilm", "activation_volume_nm3", film%activation_volume)
            call take(settings, "tribofilm", "removal_rate_per_s", film%removal_rate)
            call take(settings, "tribofilm", "largest_thickness_nm", film%largest_thickness)
            call take(settings, "tribofilm", "roughness_ratio", film%roughness_ratio)
            call take(settings, "tribofilm", "coefficient", film%coefficient)
         end associate
      end if
      if (.not. has_group(settings, "running_in")) return
      allocate (case%running_in)
      call take(settings, "running_in", "duration_h", case%running_in%duration)
      call take(settings, "running_in", "accuracy", case%running_in%accuracy)
      call take(settings, "running_in", "places", case%running_in%places)
   end subroutine fill_running_in

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
