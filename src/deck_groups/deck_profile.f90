!> Decks: the roller along its axis.
!>
!> In: keys, settings. Out: the group, the component of a case, and the rules that tie its keys to others.
module camroller_deck_profile
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain_about_group, demand
   use camroller_deck_schema, only : group_effect, positive, not_negative, range_t
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_roller_profile, only : coupling_names, fewest_slices, most_slices, profile_crowned, profile_logarithmic, &
      & profile_names
   use camroller_settings, only : settings_t, get_word, has_group
   implicit none
   private

   public :: bind_profile, check_profile

   character(len=*), parameter :: group = "roller_profile"
   !> Largest tilt: about one degree, far above what a roller and its finger allow [mrad]
   real(wp), parameter :: largest_tilt = 20.0_wp

contains

   !> Group and keys, and the component of a case.
   subroutine bind_profile(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group(group, group_effect, "shape and tilt of the roller along its axis, and the load along it that "// &
         & "follows")
      if (.not. keys%are_wanted(allocated(case%roller_profile))) return
      if (.not. allocated(case%roller_profile)) allocate (case%roller_profile)
      associate (profile => case%roller_profile)
         call keys%choice("profile", profile_names, "shape along the axis: a cylinder, an arc, a logarithm", profile%profile)
         call keys%number("crown_radius_mm", positive, "radius of a crowned roller along its axis", profile%crown_radius, &
            & example="3000", is_optional=.true., usual=[100.0_wp, 1.0e5_wp])
         call keys%number("design_load_N", positive, "load at which a logarithmic roller has the same load all along it", &
            & profile%design_load, example="800", is_optional=.true., usual=[10.0_wp, 1.0e4_wp])
         call keys%number("end_drop_um", not_negative, "drop of a logarithmic roller at its very ends, which acts up to some "// &
            & "times 2 design_load/(pi E' contact_width); 0: as the logarithm has it, without limit", profile%end_drop, &
            & usual=[0.0_wp, 20.0_wp])
         call keys%number("tilt_mrad", range_t(-largest_tilt, largest_tilt), &
            & "angle between roller and cam in the plane of length and normal; positive presses the end at positive places", &
            & profile%tilt, usual=[-5.0_wp, 5.0_wp])
         call keys%choice("coupling", coupling_names, "do slices press each other's place down, as on an elastic half space, "// &
            & "or has each a line contact of its own?", profile%coupling)
         call keys%whole_number("slices", range_t(real(fewest_slices, wp), real(most_slices, wp)), "slices along the roller", &
            & profile%slices)
         call keys%yes_or_no("slice_series", "are there series of the load of each slice?", profile%slice_series)
      end associate
   end subroutine bind_profile

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
