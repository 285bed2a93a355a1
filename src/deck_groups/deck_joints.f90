!> Decks: the sliding joints of the train, at the valve's tip, in seal and guide, and at the pivot; oil in the roller's bearing.
!>
!> In: keys, settings. Out: their groups, the components of a case, and the rules that tie their keys together.
module camroller_deck_joints
   use camroller_case, only : case_t, energy_names, energy_source
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : group_effect, positive, not_negative, proper_fraction
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong, take
   use camroller_sliding_friction, only : sliding_t, sliding_law_names
   use camroller_stem_friction, only : seal_drag_names
   implicit none
   private

   public :: bind_joints, check_joints

   !> Groups of joints; the first three have a coefficient of friction
   character(len=*), parameter :: groups(*) = [character(len=15) :: "valve_tip", "guide_side_load", "finger_pivot", "stem_seal", &
      & "needle_drag"]
   integer, parameter :: with_coefficient = 3
   !> Number of joints, which need a closed balance
   integer, parameter :: with_balance = 4
   !> Keys of law `stribeck` that have to be given
   character(len=*), parameter :: stribeck_keys(*) = [character(len=24) :: "decay_speed_m_s", "reference_viscosity_Pa_s", &
      & "reference_load_N"]

contains

   !> Groups and keys, and the components of a case.
   subroutine bind_joints(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group("valve_guide", group_effect, "valve stem in its guide")
      if (keys%are_wanted(allocated(case%valve_guide))) then
         if (.not. allocated(case%valve_guide)) allocate (case%valve_guide)
         call keys%number("length_mm", positive, "length of the guide", case%valve_guide%length, example="36", &
            & usual=[10.0_wp, 150.0_wp])
         call keys%number("stem_diameter_mm", positive, "diameter of the valve stem", case%valve_guide%stem_diameter, example="5", &
            & usual=[3.0_wp, 20.0_wp])
         call keys%number("radial_clearance_um", positive, "radial clearance", case%valve_guide%radial_clearance, example="20", &
            & usual=[3.0_wp, 100.0_wp])
      end if
      call keys%group("valve_tip", group_effect, "friction of the finger's pad on the valve's tip")
      if (keys%are_wanted(allocated(case%valve_tip))) then
         if (.not. allocated(case%valve_tip)) allocate (case%valve_tip)
         call keys%number("pad_radius_mm", positive, "radius of the pad, which is an arc about the end of the pad arm", &
            & case%valve_tip%pad_radius, example="8", usual=[3.0_wp, 60.0_wp])
         call bind_sliding(keys, case%valve_tip%sliding)
      end if
      call bind_stem(keys, case)
      call keys%group("finger_pivot", group_effect, "friction of the finger on the ball of its pivot")
      if (keys%are_wanted(allocated(case%finger_pivot))) then
         if (.not. allocated(case%finger_pivot)) allocate (case%finger_pivot)
         call keys%number("ball_radius_mm", positive, "radius of the ball", case%finger_pivot%ball_radius, example="5", &
            & usual=[2.0_wp, 15.0_wp])
         call bind_sliding(keys, case%finger_pivot%sliding)
      end if
      call keys%group("needle_drag", group_effect, "drag of the oil in the roller's needle bearing, by Palmgren's formula")
      if (keys%are_wanted(allocated(case%needle_drag))) then
         if (.not. allocated(case%needle_drag)) allocate (case%needle_drag)
         call keys%number("pitch_diameter_mm", positive, "diameter of the circle through the middles of the needles", &
            & case%needle_drag%pitch_diameter, example="10.22", usual=[4.0_wp, 50.0_wp])
         call keys%number("viscous_factor", not_negative, "factor of bearing type and lubrication, f_0", case%needle_drag%factor, &
            & usual=[1.0_wp, 30.0_wp])
         call keys%number("reversal_ratio", proper_fraction, &
            & "fraction of the cam's speed within which the torque changes its sign smoothly", case%needle_drag%reversal_ratio)
      end if
   end subroutine bind_joints

   !> Friction of the valve's stem at its seal and at the ends of its guide.
   subroutine bind_stem(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("stem_seal", group_effect, "seal on the valve's stem")
      if (keys%are_wanted(allocated(case%stem_seal))) then
         if (.not. allocated(case%stem_seal)) allocate (case%stem_seal)
         call keys%number("lip_force_N", not_negative, "friction of the lip", case%stem_seal%lip_force, example="8", &
            & usual=[0.0_wp, 40.0_wp])
         call keys%number("viscous_drag_N_s_m", not_negative, "drag per speed of the valve", case%stem_seal%viscous_drag, &
            & usual=[0.0_wp, 100.0_wp])
         call keys%choice("drag_follows", seal_drag_names, "whether the drag changes with the oil's viscosity or is constant", &
            & case%stem_seal%drag_follows)
         call keys%number("reference_viscosity_Pa_s", positive, "viscosity that the drag is given for", &
            & case%stem_seal%reference_viscosity, is_optional=.true., usual=[1.0e-3_wp, 2.0_wp])
         call keys%number("reversal_speed_m_s", not_negative, &
            & "speed of the valve over which the lip's friction reverses; 0, in a rigid train: it jumps", &
            & case%stem_seal%reversal_speed)
      end if
      call keys%group("guide_side_load", group_effect, "friction of the stem pressed against the ends of its guide")
      if (keys%are_wanted(allocated(case%guide_side_load))) then
         if (.not. allocated(case%guide_side_load)) allocate (case%guide_side_load)
         call keys%number("guide_length_mm", positive, "length of the guide", case%guide_side_load%guide_length, example="36", &
            & usual=[10.0_wp, 150.0_wp])
         call keys%number("tip_height_mm", not_negative, "height of the valve's tip above the guide with the valve closed", &
            & case%guide_side_load%tip_height, example="25", usual=[5.0_wp, 100.0_wp])
         call keys%number("stem_axis_mm", positive, "distance of the stem's axis from the pivot, across the axis", &
            & case%guide_side_load%stem_axis, example="34", usual=[15.0_wp, 120.0_wp])
         call bind_sliding(keys, case%guide_side_load%sliding)
      end if
   end subroutine bind_stem

   !> Keys of a coefficient of friction, and the coefficient.
   subroutine bind_sliding(keys, sliding)
      type(keys_t), intent(inout) :: keys
      !> The coefficient
      type(sliding_t), intent(inout) :: sliding

      call keys%choice("law", sliding_law_names, "coefficient of friction: constant, or by Stribeck's curve over viscosity "// &
         & "times speed over force", sliding%law)
      call keys%number("friction_coefficient", not_negative, "coefficient; of law 'stribeck' that at standstill", &
         & sliding%friction_coefficient, example="0.1", usual=[0.0_wp, 0.3_wp])
      ! What friction of joints is measured with: oils from hot to cold, forces from closed valves to racing springs
      call keys%number("decay_speed_m_s", positive, "sliding speed at which that has fallen to 1/e, at reference viscosity and "// &
         & "load", sliding%decay_speed, is_optional=.true., usual=[1.0e-3_wp, 10.0_wp])
      call keys%number("viscous_part_s_m", not_negative, "viscous part of the coefficient per sliding speed, at reference "// &
         & "viscosity and load; 0 leaves the friction of the film out", sliding%viscous_part)
      call keys%number("reference_viscosity_Pa_s", positive, "reference viscosity", sliding%reference_viscosity, &
         & is_optional=.true., usual=[1.0e-3_wp, 2.0_wp])
      call keys%number("reference_load_N", positive, "reference force", sliding%reference_load, is_optional=.true., &
         & usual=[1.0_wp, 5000.0_wp])
      call keys%number("reversal_speed_m_s", not_negative, "sliding speed over which friction reverses; 0, in a rigid train: "// &
         & "it jumps", sliding%reversal_speed)
   end subroutine bind_sliding

   !> Rules: what a law needs, and what a joint needs of the case.
   subroutine check_joints(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      ! Mass of the finger [kg], drag of the seal [N s/m]
      real(wp) :: finger, drag
      integer :: i

      do i = 1, size(groups)
         if (.not. has_group(settings, trim(groups(i)))) cycle
         if (i <= with_balance .and. get_word(settings, "case", "energy") == energy_names(energy_source)) call &
            & complain_about_group(mistakes, settings, trim(groups(i)), "&"//trim(groups(i))//" needs case energy = 'consistent'")
         if (i <= with_balance .and. has_group(settings, "dynamics")) call reversal_is_spread(settings, trim(groups(i)), mistakes)
         if (i <= with_coefficient) call curve_is_given(settings, trim(groups(i)), mistakes)
      end do
      if (has_group(settings, "finger_pivot") .and. has_group(settings, "masses")) then
         finger = 0.0_wp
         call take(settings, "masses", "finger_kg", finger)
         if (finger <= 0.0_wp .and. .not. is_wrong(settings, "masses", "finger_kg")) call complain_about_group(mistakes, &
            & settings, "masses", "&finger_pivot needs masses 'finger_kg' above 0")
      end if
      if (.not. has_group(settings, "stem_seal")) return
      drag = 0.0_wp
      call take(settings, "stem_seal", "viscous_drag_N_s_m", drag)
      if (.not. drag > 0.0_wp .or. get_word(settings, "stem_seal", "drag_follows") /= "viscosity") return
      if (is_known(settings, "stem_seal", "reference_viscosity_Pa_s")) return
      if (is_wrong(settings, "stem_seal", "reference_viscosity_Pa_s")) return
      call complain(mistakes, settings, "stem_seal", "viscous_drag_N_s_m", "'viscous_drag_N_s_m' needs "// &
         & "'reference_viscosity_Pa_s', or drag_follows = 'constant'")
   end subroutine check_joints

   !> Law `stribeck` has its keys.
   subroutine curve_is_given(settings, group, mistakes)
      type(settings_t), intent(in) :: settings
      !> Group of the joint
      character(len=*), intent(in) :: group
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i

      if (get_word(settings, group, "law") /= "stribeck") return
      do i = 1, size(stribeck_keys)
         if (is_known(settings, group, trim(stribeck_keys(i))) .or. is_wrong(settings, group, trim(stribeck_keys(i)))) cycle
         call complain(mistakes, settings, group, "law", "law 'stribeck' needs '"//trim(stribeck_keys(i))//"'")
      end do
   end subroutine curve_is_given

   !> A flexible train has friction whose reversal is spread over a speed: where it jumped, finger and valve would stick.
   subroutine reversal_is_spread(settings, group, mistakes)
      type(settings_t), intent(in) :: settings
      !> Group of the joint
      character(len=*), intent(in) :: group
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(sliding_t) :: standard
      ! Speed over which friction reverses [m/s]
      real(wp) :: speed

      speed = standard%reversal_speed
      call take(settings, group, "reversal_speed_m_s", speed)
      if (speed > 0.0_wp .or. is_wrong(settings, group, "reversal_speed_m_s")) return
      call complain(mistakes, settings, group, "reversal_speed_m_s", "'reversal_speed_m_s' must be above 0 "// &
         & "in a flexible train, &dynamics: friction that jumps is not part of it")
   end subroutine reversal_is_spread

end module camroller_deck_joints
