!> What keys are used for: the one table of keys that have no effect but under a choice made by another key, or in one command.
!>
!> In: settings, and a sweep whose keys vary. Out: whether a key is idle, and when it is used, in words. Where one of several rows
!> of a key holds, the key is used. A choice that has no effect itself makes no use of another key.
module camroller_key_uses
   use camroller_asperity, only : asperity_law_names, law_greenwood_tripp, law_zhao_maietta_chang
   use camroller_boundary_law, only : boundary_law_names, boundary_logarithmic, boundary_table
   use camroller_case, only : select_names, select_needed
   use camroller_deck_schema, only : key_length
   use camroller_deck_sweep, only : axis_of, sweep_t
   use camroller_deck_values, only : value_t
   use camroller_kinds, only : wp
   use camroller_lift, only : lift_law_names, law_power, law_polydyne, law_345, law_4567, law_cycloidal, law_segments, law_table
   use camroller_lubricant, only : temperature_law_names, law_direct, law_vogel, law_walther, law_data_sheet
   use camroller_needle, only : roller_bearing_names, kind_journal, kind_needles, kind_skf
   use camroller_roller_profile, only : profile_names, profile_crowned, profile_logarithmic
   use camroller_samples, only : sample_names
   use camroller_settings, only : find_value, has_group, settings_t
   use camroller_traction, only : limit_names, limit_local, shear_law_names, law_eyring
   implicit none
   private

   public :: is_idle, say_idle, say_use

   !> Length of the names of choices, and of a list of their values
   integer, parameter :: choice_length = 96
   !> Signs in the place of values: any value, or a group that is there; no value, or a group that is not there; a number above
   !> zero; a command that is no run
   character(len=*), parameter :: given = "(given)", not_given = "(not given)", above_zero = "(above zero)", &
      & by_command = "(command)"
   !> Values of what is true or false
   character(len=*), parameter :: yes = ".true.", no = ".false."

   !> One use of a key
   type :: key_use_t
      !> As `group.key`
      character(len=2*key_length) :: key
      !> What decides: a key of the same group, `group.key` of another, `&group`, or a command
      character(len=choice_length) :: choice
      !> Its values, blanks between them, or a sign
      character(len=choice_length) :: values = given
      !> Group that has to be there as well, without its `&`; blank: none
      character(len=key_length) :: group = ""
   end type key_use_t

   !> Laws of lift with exponents, and with angles
   character(len=*), parameter :: exponent_laws = trim(lift_law_names(law_power))//" "//trim(lift_law_names(law_polydyne)), &
      & angle_laws = exponent_laws//" "//trim(lift_law_names(law_345))//" "//trim(lift_law_names(law_4567))//" "// &
      & trim(lift_law_names(law_cycloidal)), segment_law = trim(lift_law_names(law_segments)), table_law = lift_law_names(law_table)
   !> Laws of the oil's viscosity over the temperature: direct, by its data sheet, through points, that need its density
   character(len=*), parameter :: direct_law = temperature_law_names(law_direct), &
      & sheet_law = temperature_law_names(law_data_sheet), walther_law = trim(temperature_law_names(law_walther)), &
      & point_laws = trim(temperature_law_names(law_vogel))//" "//walther_law, density_laws = walther_law//" "//sheet_law
   !> Laws of asperities with summits; of boundary friction over the logarithm of the speed, and by a table
   character(len=*), parameter :: summit_laws = trim(asperity_law_names(law_greenwood_tripp))//" "// &
      & asperity_law_names(law_zhao_maietta_chang), logarithm_law = boundary_law_names(boundary_logarithmic), &
      & points_law = boundary_law_names(boundary_table)
   !> Bearings of the roller: with needles, by SKF's model, with a film on the pin
   character(len=*), parameter :: skf_kind = roller_bearing_names(kind_skf), pin_kind = roller_bearing_names(kind_journal), &
      & needle_kinds = trim(roller_bearing_names(kind_needles))//" "//skf_kind
   !> Samples of a sweep
   character(len=*), parameter :: samples = trim(sample_names(1))//" "//trim(sample_names(2))//" "//trim(sample_names(3))

   !> The second lift is like the first, and `#` is the number of a key of &sweep
   type(key_use_t), parameter :: uses(*) = [ &
      key_use_t("lift.max_lift_mm", "law", angle_laws//" "//segment_law), &
      key_use_t("lift.opening_half_angle_deg", "law", angle_laws), &
      key_use_t("lift.closing_half_angle_deg", "law", angle_laws), &
      key_use_t("lift.exponents", "law", exponent_laws), &
      key_use_t("lift.segment_angles_deg", "law", segment_law), &
      key_use_t("lift.segment_accelerations", "law", segment_law), &
      key_use_t("lift.table", "law", table_law), &
      key_use_t("lift.table_kind", "law", table_law), &
      key_use_t("lift.table_unit", "law", table_law), &
      key_use_t("lift.table_nose_angle_deg", "law", table_law), &
      key_use_t("lift.smoothing_um", "law", table_law), &
      key_use_t("mechanism.adjuster_tilt_deg", "masses.finger_kg", given), &
      key_use_t("masses.finger_centre_mm", "masses.finger_kg", given), &
      key_use_t("spring.seat_stiffness_N_m", "seating", "continuous"), &
      key_use_t("lubricant.viscosity_Pa_s", "temperature_law", direct_law), &
      key_use_t("lubricant.temperature_points_degC", "temperature_law", point_laws), &
      key_use_t("lubricant.viscosity_points_Pa_s", "temperature_law", point_laws), &
      key_use_t("lubricant.viscosity_at_40_degC_mm2_s", "temperature_law", sheet_law), &
      key_use_t("lubricant.viscosity_at_100_degC_mm2_s", "temperature_law", sheet_law), &
      key_use_t("lubricant.viscosity_index", "temperature_law", sheet_law), &
      key_use_t("lubricant.sae_grade", "temperature_law", sheet_law), &
      key_use_t("lubricant.density_kg_m3", "temperature_law", density_laws), &
      key_use_t("lubricant.density_kg_m3", "&needle_drag"), &
      key_use_t("lubricant.density_kg_m3", "needle_bearing.kind", skf_kind), &
      key_use_t("lubricant.density_kg_m3", "bearing_heat.oil_share", above_zero, "bearing_heat"), &
      key_use_t("lubricant.thermal_expansion_per_K", "temperature_law", density_laws), &
      key_use_t("lubricant.thermal_expansion_per_K", "&needle_drag"), &
      key_use_t("lubricant.thermal_expansion_per_K", "needle_bearing.kind", skf_kind), &
      key_use_t("lubricant.thermal_expansion_per_K", "bearing_heat.oil_share", above_zero, "bearing_heat"), &
      key_use_t("lubricant.density_kg_m3", "ehl.profiles", yes, "heat"), &
      key_use_t("lubricant.thermal_expansion_per_K", "ehl.profiles", yes, "heat"), &
      key_use_t("lubricant.roelands_index", "pressure_viscosity_coefficient_per_GPa", not_given), &
      key_use_t("film.law", "&ehl", not_given), &
      key_use_t("film.law", "ehl.profiles", yes), &
      key_use_t("film.law", "effects.select", select_names(select_needed)), &
      key_use_t("film.law", "camroller ehl", by_command), &
      key_use_t("ehl.shear_thinning", "profiles", yes), &
      key_use_t("ehl.shear_thinning", "camroller ehl", by_command), &
      key_use_t("ehl.flow_factors", "profiles", yes), &
      key_use_t("ehl.flow_factors", "camroller ehl", by_command), &
      key_use_t("traction.eyring_stress_MPa", "shear_law", shear_law_names(law_eyring)), &
      key_use_t("traction.limiting_stress_MPa", "limit", limit_names(limit_local)), &
      key_use_t("roller_profile.crown_radius_mm", "profile", profile_names(profile_crowned)), &
      key_use_t("roller_profile.design_load_N", "profile", profile_names(profile_logarithmic)), &
      key_use_t("roller_profile.end_drop_um", "profile", profile_names(profile_logarithmic)), &
      key_use_t("heat.oil_heat_capacity_J_kg_K", "ehl.profiles", yes), &
      key_use_t("heat.limit_fall_per_K", "contact", "mean"), &
      key_use_t("heat.cam_conductivity_W_m_K", "contact", "mean"), &
      key_use_t("heat.cam_density_kg_m3", "contact", "mean"), &
      key_use_t("heat.cam_heat_capacity_J_kg_K", "contact", "mean"), &
      key_use_t("heat.roller_conductivity_W_m_K", "contact", "mean"), &
      key_use_t("heat.roller_density_kg_m3", "contact", "mean"), &
      key_use_t("heat.roller_heat_capacity_J_kg_K", "contact", "mean"), &
      key_use_t("heat.limit_fall_per_K", "ehl.profiles", yes), &
      key_use_t("heat.cam_conductivity_W_m_K", "ehl.profiles", yes), &
      key_use_t("heat.cam_density_kg_m3", "ehl.profiles", yes), &
      key_use_t("heat.cam_heat_capacity_J_kg_K", "ehl.profiles", yes), &
      key_use_t("heat.roller_conductivity_W_m_K", "ehl.profiles", yes), &
      key_use_t("heat.roller_density_kg_m3", "ehl.profiles", yes), &
      key_use_t("heat.roller_heat_capacity_J_kg_K", "ehl.profiles", yes), &
      key_use_t("asperity.roughness_product", "law", summit_laws), &
      key_use_t("asperity.roughness_over_tip_radius", "law", summit_laws), &
      key_use_t("asperity.boundary_coefficient", "&boundary_law", not_given), &
      key_use_t("asperity.boundary_coefficient", "boundary_law.law", logarithm_law), &
      key_use_t("asperity.mobilising_speed_m_s", "mobilisation", "regularised"), &
      key_use_t("boundary_law.reference_speed_m_s", "law", logarithm_law), &
      key_use_t("boundary_law.reference_temperature_degC", "law", logarithm_law), &
      key_use_t("boundary_law.change_per_decade", "law", logarithm_law), &
      key_use_t("boundary_law.change_per_K", "law", logarithm_law), &
      key_use_t("boundary_law.lowest_speed_m_s", "law", logarithm_law), &
      key_use_t("boundary_law.speed_points_m_s", "law", points_law), &
      key_use_t("boundary_law.temperature_points_degC", "law", points_law), &
      key_use_t("boundary_law.coefficient_points", "law", points_law), &
      key_use_t("needle_bearing.needle_radius_mm", "kind", needle_kinds), &
      key_use_t("needle_bearing.skf_rolling_factor", "kind", skf_kind), &
      key_use_t("needle_bearing.skf_sliding_factor", "kind", skf_kind), &
      key_use_t("needle_bearing.skf_geometry_factor", "kind", skf_kind), &
      key_use_t("needle_bearing.skf_replenishment_factor", "kind", skf_kind), &
      key_use_t("needle_bearing.skf_film_coefficient", "kind", skf_kind), &
      key_use_t("needle_bearing.pin_law", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_width_mm", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_radial_clearance_um", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_roughness_um", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_modulus_GPa", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_roughness_product", "kind", pin_kind), &
      key_use_t("needle_bearing.pin_roughness_over_tip_radius", "kind", pin_kind), &
      key_use_t("valve_tip.decay_speed_m_s", "law", "stribeck"), &
      key_use_t("valve_tip.viscous_part_s_m", "law", "stribeck"), &
      key_use_t("valve_tip.reference_viscosity_Pa_s", "law", "stribeck"), &
      key_use_t("valve_tip.reference_load_N", "law", "stribeck"), &
      key_use_t("guide_side_load.decay_speed_m_s", "law", "stribeck"), &
      key_use_t("guide_side_load.viscous_part_s_m", "law", "stribeck"), &
      key_use_t("guide_side_load.reference_viscosity_Pa_s", "law", "stribeck"), &
      key_use_t("guide_side_load.reference_load_N", "law", "stribeck"), &
      key_use_t("finger_pivot.decay_speed_m_s", "law", "stribeck"), &
      key_use_t("finger_pivot.viscous_part_s_m", "law", "stribeck"), &
      key_use_t("finger_pivot.reference_viscosity_Pa_s", "law", "stribeck"), &
      key_use_t("finger_pivot.reference_load_N", "law", "stribeck"), &
      key_use_t("stem_seal.drag_follows", "viscous_drag_N_s_m", above_zero), &
      key_use_t("stem_seal.reference_viscosity_Pa_s", "drag_follows", "viscosity"), &
      key_use_t("bearing_heat.heat_capacity_J_kg_K", "oil_share", above_zero), &
      key_use_t("gas_force.second_valve_diameter_mm", "&second_lift"), &
      key_use_t("cam_bearings.cam_cylinders", "&engine"), &
      key_use_t("dynamics.seat_damping_s_m", "seat_restitution", not_given), &
      key_use_t("dynamics.seat_restitution_speed_m_s", "seat_restitution", given), &
      key_use_t("effects.negligible", "select", select_names(select_needed)), &
      key_use_t("effects.negligible", "camroller audit", by_command), &
      key_use_t("effects.quantity", "select", select_names(select_needed)), &
      key_use_t("effects.quantity", "camroller audit", by_command), &
      key_use_t("numerics.step_deg", "method", "euler"), &
      key_use_t("numerics.periodicity", "tolerance", given), &
      key_use_t("sweep.seed", "kind", samples), &
      key_use_t("sweep.count_#", "kind", "grid zip"), &
      key_use_t("sweep.scale_#", "from_#", given), &
      key_use_t("sweep.series_cases", "series", "chosen")]

contains

   !> Is there no case in which a key has an effect? Where its choice varies too, it may have one.
   pure recursive function is_idle(settings, sweep, key, of_runs) result(verdict)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Keys that vary
      type(sweep_t), intent(in) :: sweep
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> Of runs, or of any command?
      logical, intent(in) :: of_runs
      !> Is there none?
      logical :: verdict

      character(len=2*key_length) :: name
      integer :: i

      verdict = .false.
      name = table_name(key)
      do i = 1, size(uses)
         if (uses(i)%key /= name) cycle
         if (uses(i)%values == by_command) then
            verdict = of_runs
         else
            verdict = .not. holds(settings, sweep, uses(i), choice_of(key, uses(i)))
         end if
         if (.not. verdict) return
      end do
   end function is_idle

   !> When a key is used, as `with law = 'power' or 'polydyne'`; blank where that is always.
   pure subroutine say_use(key, words)
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The words
      character(len=:), allocatable, intent(out) :: words

      character(len=2*key_length) :: name
      integer :: i

      words = ""
      name = table_name(key)
      do i = 1, size(uses)
         if (uses(i)%key /= name) cycle
         if (words /= "") words = words//", or "
         if (uses(i)%values == given) then
            words = words//"with "//numbered(uses(i)%choice, key)
         else if (uses(i)%values == not_given) then
            words = words//"without "//trim(uses(i)%choice)
         else if (uses(i)%values == above_zero) then
            words = words//"with "//trim(uses(i)%choice)//" > 0"
         else if (uses(i)%values == by_command) then
            words = words//"by '"//trim(uses(i)%choice)//"'"
         else
            words = words//"with "//trim(uses(i)%choice)//" = "
            call add_alternatives(trim(uses(i)%values), words)
         end if
         if (uses(i)%group /= "") words = words//" and &"//trim(uses(i)%group)
      end do
   end subroutine say_use

   !> That a key has no effect, and why: `has no effect: it is used with law = 'power' or 'polydyne'; law is 'cycloidal'`. One that
   !> a command uses that is no run has none in a run.
   pure subroutine say_idle(settings, key, words)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The words
      character(len=:), allocatable, intent(out) :: words

      character(len=2*key_length) :: name
      integer :: i

      call say_use(key, words)
      words = ": it is used "//words
      name = table_name(key)
      if (any(uses%key == name .and. uses%values == by_command)) words = " in a run"//words
      words = "has no effect"//words
      do i = 1, size(uses)
         if (uses(i)%key /= name .or. any(uses(i)%values == &
            & [character(len=choice_length) :: given, not_given, above_zero])) cycle
         associate (value => settings%values(value_of(settings, choice_of(key, uses(i)))))
            if (.not. value%is_known) return
            words = words//"; "//trim(uses(i)%choice)
            if (is_among(uses(i)%values, value)) then
               words = words//" has no effect itself"
            else
               words = words//" is "
               call add_alternatives(trim(word_of(value)), words)
            end if
         end associate
         return
      end do
   end subroutine say_idle

   !> Is a use of a key open to the cases of a deck?
   pure recursive function holds(settings, sweep, use, choice) result(verdict)
      type(settings_t), intent(in) :: settings
      !> Keys that vary
      type(sweep_t), intent(in) :: sweep
      type(key_use_t), intent(in) :: use
      !> What decides: `group.key` or `&group`
      character(len=*), intent(in) :: choice
      !> Is it?
      logical :: verdict

      verdict = use%group == ""
      if (.not. verdict) verdict = has_group(settings, trim(use%group))
      if (.not. verdict) return
      if (choice(1:1) == "&") then
         verdict = has_group(settings, trim(choice(2:))) .eqv. use%values == given
         return
      end if
      verdict = .true.
      if (axis_of(sweep, choice) > 0) return
      associate (value => settings%values(value_of(settings, choice)))
         if (value%is_wrong) return
         select case (use%values)
         case (given)
            verdict = value%is_known
         case (not_given)
            verdict = .not. value%is_known
         case (above_zero)
            if (value%is_known) verdict = value%numbers(1) > 0.0_wp
         case default
            if (value%is_known) verdict = is_among(use%values, value)
            if (verdict) verdict = .not. is_idle(settings, sweep, choice, of_runs=.false.)
         end select
      end associate
   end function holds

   !> Is a value one of those of a use?
   pure function is_among(values, value) result(verdict)
      !> Values of the use, blanks between them
      character(len=*), intent(in) :: values
      !> A name or true or false
      type(value_t), intent(in) :: value
      !> Is it?
      logical :: verdict

      verdict = index(" "//values//" ", " "//trim(word_of(value))//" ") > 0
   end function is_among

   !> A value as it stands in the table.
   pure function word_of(value) result(word)
      !> The value, a name or true or false
      type(value_t), intent(in) :: value
      !> The word
      character(len=choice_length) :: word

      if (allocated(value%word)) then
         word = value%word
      else if (value%flag) then
         word = yes
      else
         word = no
      end if
   end function word_of

   !> Position of the value of `group.key`.
   pure function value_of(settings, key) result(position)
      type(settings_t), intent(in) :: settings
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The position
      integer :: position

      position = find_value(settings, key(:index(key, ".") - 1), trim(key(index(key, ".") + 1:)))
   end function value_of

   !> What decides about a use of a key: `group.key`, or `&group`.
   pure function choice_of(key, use) result(choice)
      !> As `group.key`
      character(len=*), intent(in) :: key
      type(key_use_t), intent(in) :: use
      !> The choice
      character(len=2*key_length) :: choice

      choice = numbered(use%choice, key)
      if (scan(choice, ".&") == 0) choice = key(:index(key, "."))//choice
   end function choice_of

   !> Name of a choice, with the number of its key.
   pure function numbered(choice, key) result(name)
      !> As in the table
      character(len=*), intent(in) :: choice
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The name
      character(len=len_trim(choice)) :: name

      name = choice
      if (index(name, "#") > 0) name(index(name, "#"):) = key(len_trim(key):)
   end function numbered

   !> Name of a key in the table.
   pure function table_name(key) result(name)
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> The name
      character(len=2*key_length) :: name

      name = key
      if (index(key, "second_lift.") == 1) name = key(len("second_") + 1:)
      if (index(key, "sweep.") == 1 .and. scan(key(len_trim(key):), "123456789") == 1) name(len_trim(key):) = "#"
   end function table_name

   !> Add words of a list as `'power' or 'polydyne'`, what is true or false without marks.
   pure subroutine add_alternatives(list, words)
      !> Words with single blanks between them
      character(len=*), intent(in) :: list
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: words

      integer :: first, last

      first = 1
      do while (first <= len(list))
         last = first + index(list(first:)//" ", " ") - 2
         if (first > 1 .and. last == len(list)) then
            words = words//" or "
         else if (first > 1) then
            words = words//", "
         end if
         if (any(list(first:last) == [character(len=len(no)) :: yes, no])) then
            words = words//list(first:last)
         else
            words = words//"'"//list(first:last)//"'"
         end if
         first = last + 2
      end do
   end subroutine add_alternatives

end module camroller_key_uses
