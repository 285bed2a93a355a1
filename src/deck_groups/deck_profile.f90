!> Decks: the roller along its axis.
!>
!> In: schema, settings. Out: group and keys, the component of a case, and the rules that tie its keys to others.
module camroller_deck_profile
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain_about_group, demand
   use camroller_deck_schema, only : schema_t, add_group, add_integer, add_logical, add_name, add_number, group_effect, &
      & not_negative, positive, range_t
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_roller_profile, only : roller_profile_t, coupling_names, fewest_slices, most_slices, profile_crowned, &
      & profile_logarithmic, profile_names
   use camroller_settings, only : settings_t, get_word, has_group, take
   implicit none
   private

   public :: add_profile_keys, fill_profile, check_profile

   character(len=*), parameter :: group = "roller_profile"
   !> Largest tilt: about one degree, far above what a roller and its finger allow [mrad]
   real(wp), parameter :: largest_tilt = 20.0_wp

contains

   !> Group and keys.
   subroutine add_profile_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(roller_profile_t) :: standard

      call add_group(schema, "roller_profile", group_effect, &
         & "shape and tilt of the roller along its axis, and the load along it that follows")
      call add_name(schema, "profile", profile_names, standard%profile, "shape along the axis: a cylinder, an arc, a logarithm")
      call add_number(schema, "crown_radius_mm", positive, "radius of a crowned roller along its axis", is_optional=.true., &
         & example="3000")
      call add_number(schema, "design_load_N", positive, "load at which a logarithmic roller has the same load all along it", &
         & is_optional=.true., example="800")
      call add_number(schema, "end_drop_um", not_negative, "drop of a logarithmic roller at its very ends, which acts up to "// &
         & "some times 2 design_load/(pi E' contact_width); 0: as the logarithm has it, without limit", default=standard%end_drop)
      call add_number(schema, "tilt_mrad", range_t(-largest_tilt, largest_tilt), "angle between roller and cam in the plane of "// &
         & "length and normal; positive presses the end at positive places", default=standard%tilt)
      call add_name(schema, "coupling", coupling_names, standard%coupling, &
         & "do slices press each other's place down, as on an elastic half space, or has each a line contact of its own?")
      call add_integer(schema, "slices", range_t(real(fewest_slices, wp), real(most_slices, wp)), "slices along the roller", &
         & default=standard%slices)
      call add_logical(schema, "slice_series", standard%slice_series, "are there series of the load of each slice?")
   end subroutine add_profile_keys

   !> Fill the component of a case.
   subroutine fill_profile(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, group)) return
      allocate (case%roller_profile)
      associate (profile => case%roller_profile)
         call take(settings, "roller_profile", "profile", profile%profile)
         call take(settings, "roller_profile", "crown_radius_mm", profile%crown_radius)
         call take(settings, "roller_profile", "design_load_N", profile%design_load)
         call take(settings, "roller_profile", "end_drop_um", profile%end_drop)
         call take(settings, "roller_profile", "tilt_mrad", profile%tilt)
         call take(settings, "roller_profile", "coupling", profile%coupling)
         call take(settings, "roller_profile", "slices", profile%slices)
         call take(settings, "roller_profile", "slice_series", profile%slice_series)
      end associate
   end subroutine fill_profile

   !> Rules: a shape has its number, and the film is that of a formula.
   subroutine check_profile(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (.not. has_group(settings, group)) return
      if (has_group(settings, "ehl")) call complain_about_group(mistakes, settings, group, &
         & "&roller_profile is not part of a numerical film, &ehl, whose roller is a cylinder; leave out one of both")
      select case (get_word(settings, group, "profile"))
      case (profile_names(profile_crowned))
         call demand(settings, group, "crown_radius_mm", "roller_profile profile = 'crowned'", mistakes)
      case (profile_names(profile_logarithmic))
         call demand(settings, group, "design_load_N", "roller_profile profile = 'logarithmic'", mistakes)
      end select
   end subroutine check_profile

end module camroller_deck_profile
