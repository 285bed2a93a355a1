!> Decks: the sliding joints of the train, at the valve's tip, in seal and guide, and at the pivot; oil in the roller's bearing.
!>
!> In: schema, settings. Out: their groups and keys, the components of a case, and the rules that tie their keys together.
module camroller_deck_joints
   use camroller_case, only : case_t, energy_names, energy_source
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : schema_t, add_group, add_name, add_number, group_effect, not_negative, positive, &
      & proper_fraction
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_needle_drag, only : needle_drag_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong, take
   use camroller_sliding_friction, only : sliding_t, sliding_law_names
   use camroller_stem_friction, only : stem_seal_t, seal_drag_names
   implicit none
   private

   public :: add_joint_keys, fill_joints, check_joints

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

   !> Groups and keys.
   subroutine add_joint_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(stem_seal_t) :: seal
      type(needle_drag_t) :: drag

      call add_group(schema, "valve_tip", group_effect, "friction of the finger's pad on the valve's tip")
      call add_number(schema, "pad_radius_mm", positive, "radius of the pad, which is an arc about the end of the pad arm", &
         & example="8")
      call add_sliding_keys(schema)
      call add_group(schema, "stem_seal", group_effect, "seal on the valve's stem")
      call add_number(schema, "lip_force_N", not_negative, "friction of the lip", example="8")
      call add_number(schema, "viscous_drag_N_s_m", not_negative, "drag per speed of the valve", default=seal%viscous_drag)
      call add_name(schema, "drag_follows", seal_drag_names, seal%drag_follows, &
         & "whether the drag changes with the oil's viscosity or is constant")
      call add_number(schema, "reference_viscosity_Pa_s", positive, "viscosity that the drag is given for", is_optional=.true.)
      call add_number(schema, "reversal_speed_m_s", not_negative, &
         & "speed of the valve over which the lip's friction reverses; 0, in a rigid train: it jumps", default=seal%reversal_speed)
      call add_group(schema, "guide_side_load", group_effect, "friction of the stem pressed against the ends of its guide")
      call add_number(schema, "guide_length_mm", positive, "length of the guide", example="36")
      call add_number(schema, "tip_height_mm", not_negative, "height of the valve's tip above the guide with the valve closed", &
         & example="25")
      call add_number(schema, "stem_axis_mm", positive, "distance of the stem's axis from the pivot, across the axis", &
         & example="34")
      call add_sliding_keys(schema)
      call add_group(schema, "finger_pivot", group_effect, "friction of the finger on the ball of its pivot")
      call add_number(schema, "ball_radius_mm", positive, "radius of the ball", example="5")
      call add_sliding_keys(schema)
      call add_group(schema, "needle_drag", group_effect, "drag of the oil in the roller's needle bearing, by Palmgren's formula")
      call add_number(schema, "pitch_diameter_mm", positive, "diameter of the circle through the middles of the needles", &
         & example="10.22")
      call add_number(schema, "viscous_factor", not_negative, "factor of bearing type and lubrication, f_0", default=drag%factor)
      call add_number(schema, "reversal_ratio", proper_fraction, &
         & "fraction of the cam's speed within which the torque changes its sign smoothly", default=drag%reversal_ratio)
   end subroutine add_joint_keys

   !> Keys of a coefficient of friction.
   subroutine add_sliding_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(sliding_t) :: standard

      call add_name(schema, "law", sliding_law_names, standard%law, &
         & "coefficient of friction: constant, or by Stribeck's curve over viscosity times speed over force")
      call add_number(schema, "friction_coefficient", not_negative, "coefficient; of law 'stribeck' that at standstill", &
         & example="0.1")
      call add_number(schema, "decay_speed_m_s", positive, "sliding speed at which that has fallen to 1/e, at reference "// &
         & "viscosity and load", is_optional=.true.)
      call add_number(schema, "viscous_part_s_m", not_negative, "viscous part of the coefficient per sliding speed, at "// &
         & "reference viscosity and load; 0 leaves the friction of the film out", default=standard%viscous_part)
      call add_number(schema, "reference_viscosity_Pa_s", positive, "reference viscosity", is_optional=.true.)
      call add_number(schema, "reference_load_N", positive, "reference force", is_optional=.true.)
      call add_number(schema, "reversal_speed_m_s", not_negative, &
         & "sliding speed over which friction reverses; 0, in a rigid train: it jumps", default=standard%reversal_speed)
   end subroutine add_sliding_keys

   !> Fill the components of a case.
   subroutine fill_joints(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (has_group(settings, "valve_tip")) then
         allocate (case%valve_tip)
         call take(settings, "valve_tip", "pad_radius_mm", case%valve_tip%pad_radius)
         call fill_sliding(settings, "valve_tip", case%valve_tip%sliding)
      end if
      if (has_group(settings, "stem_seal")) then
         allocate (case%stem_seal)
         call take(settings, "stem_seal", "lip_force_N", case%stem_seal%lip_force)
         call take(settings, "stem_seal", "viscous_drag_N_s_m", case%stem_seal%viscous_drag)
         call take(settings, "stem_seal", "drag_follows", case%stem_seal%drag_follows)
         call take(settings, "stem_seal", "reference_viscosity_Pa_s", case%stem_seal%reference_viscosity)
         call take(settings, "stem_seal", "reversal_speed_m_s", case%stem_seal%reversal_speed)
      end if
      if (has_group(settings, "guide_side_load")) then
         allocate (case%guide_side_load)
         call take(settings, "guide_side_load", "guide_length_mm", case%guide_side_load%guide_length)
         call take(settings, "guide_side_load", "tip_height_mm", case%guide_side_load%tip_height)
         call take(settings, "guide_side_load", "stem_axis_mm", case%guide_side_load%stem_axis)
         call fill_sliding(settings, "guide_side_load", case%guide_side_load%sliding)
      end if
      if (has_group(settings, "finger_pivot")) then
         allocate (case%finger_pivot)
         call take(settings, "finger_pivot", "ball_radius_mm", case%finger_pivot%ball_radius)
         call fill_sliding(settings, "finger_pivot", case%finger_pivot%sliding)
      end if
      if (has_group(settings, "needle_drag")) then
         allocate (case%needle_drag)
         call take(settings, "needle_drag", "pitch_diameter_mm", case%needle_drag%pitch_diameter)
         call take(settings, "needle_drag", "viscous_factor", case%needle_drag%factor)
         call take(settings, "needle_drag", "reversal_ratio", case%needle_drag%reversal_ratio)
      end if
   end subroutine fill_joints

   !> Fill a coefficient of friction.
   subroutine fill_sliding(settings, group, sliding)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Group of the joint
      character(len=*), intent(in) :: group
      !> The coefficient
      type(sliding_t), intent(inout) :: sliding

      call take(settings, group, "law", sliding%law)
      call take(settings, group, "friction_coefficient", sliding%friction_coefficient)
      call take(settings, group, "decay_speed_m_s", sliding%decay_speed)
      call take(settings, group, "viscous_part_s_m", sliding%viscous_part)
      call take(settings, group, "reference_viscosity_Pa_s", sliding%reference_viscosity)
      call take(settings, group, "reference_load_N", sliding%reference_load)
      call take(settings, group, "reversal_speed_m_s", sliding%reversal_speed)
   end subroutine fill_sliding

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
      !> The settings
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
      !> The settings
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
