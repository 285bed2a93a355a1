!> Decks: what comes on top of the camshaft bearings, mixed friction, the pull of the belt or chain, heat, seals.
!>
!> In: schema, settings. Out: groups and keys, the components of a case, and the rules that tie their keys to others.
module camroller_deck_cam_bearings
   use camroller_bearing_asperity, only : bearing_asperity_t, clearance_advice, clearance_is_enough
   use camroller_bearing_heat, only : bearing_heat_t, direct_advice, flow_advice, flow_covers_width
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : schema_t, add_group, add_number, add_numbers, anything, from_to, group_effect, &
      & not_negative, positive, above_absolute_zero
   use camroller_journal, only : law_covers_width
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, take
   use camroller_shaft_drag, only : is_rising, shaft_drag_t
   implicit none
   private

   public :: add_bearing_part_keys, fill_bearing_parts, check_bearing_parts

   character(len=*), parameter :: bearings = "cam_bearings", mixed = "bearing_asperity", pull = "belt_pull", &
      & warm = "bearing_heat", drag = "shaft_drag"

contains

   !> Groups and keys.
   subroutine add_bearing_part_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(bearing_asperity_t) :: standard
      type(bearing_heat_t) :: usual_heat

      call add_group(schema, "bearing_asperity", group_effect, &
         & "asperities that share the load of the camshaft bearings where their film is thin")
      call add_number(schema, "roughness_um", positive, "root mean square roughness of journal and bearing together", &
         & example="0.4")
      call add_number(schema, "modulus_GPa", positive, &
         & "E' of journal and bearing, 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]", example="110")
      call add_number(schema, "boundary_coefficient", not_negative, "friction coefficient of touching asperities", &
         & example="0.1")
      call add_number(schema, "roughness_product", positive, "asperity density times tip radius times roughness", &
         & default=standard%roughness_product)
      call add_number(schema, "roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
         & default=standard%roughness_over_tip_radius)
      call add_group(schema, "belt_pull", group_effect, "constant force of the belt or chain that drives each camshaft")
      call add_number(schema, "force_N", not_negative, "the force", example="400")
      call add_number(schema, "angle_deg", from_to(-360.0_wp, 360.0_wp), "its direction, from the line from the first "// &
         & "follower's pivot to the cam's centre, positive the way a finger turns as it opens its valve", example="-90")
      call add_number(schema, "position_mm", anything, "place of its wheel along the shaft, which may overhang the bearings", &
         & example="-30")
      call add_group(schema, "bearing_heat", group_effect, &
         & "heat balance of each camshaft bearing: viscosity at the mean temperature of its oil")
      call add_number(schema, "heat_capacity_J_kg_K", positive, "heat capacity of the oil", default=usual_heat%heat_capacity)
      call add_number(schema, "oil_share", from_to(0.0_wp, 1.0_wp), &
         & "part of the friction's heat that the oil carries away; the rest goes into the metal: most of it at low speed, "// &
         & "where a remark gives bounds", default=usual_heat%oil_share)
      call add_group(schema, "shaft_drag", group_effect, &
         & "torque of the seals and of the belt or chain on each camshaft, as a table over speed and temperature; needs "// &
         & "&cam_bearings")
      call add_numbers(schema, "speed_points_rpm", not_negative, "speeds of the camshaft, increasing; with one alone the "// &
         & "torque does not depend on it", example="0, 1000, 3000")
      call add_numbers(schema, "temperature_points_degC", above_absolute_zero, "temperatures of the oil, increasing; with one "// &
         & "alone the torque does not depend on it", example="20, 90")
      call add_numbers(schema, "torque_points_Nm", not_negative, "torques: those of all speeds at the first temperature, then "// &
         & "at the next; linear between them, a case outside the table is refused", &
         & example="0.25, 0.20, 0.22, 0.15, 0.12, 0.14")
   end subroutine add_bearing_part_keys

   !> Fill the components of a case.
   subroutine fill_bearing_parts(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (has_group(settings, mixed)) then
         allocate (case%bearing_asperity)
         call take(settings, mixed, "roughness_um", case%bearing_asperity%roughness)
         call take(settings, mixed, "modulus_GPa", case%bearing_asperity%modulus)
         call take(settings, mixed, "boundary_coefficient", case%bearing_asperity%boundary_coefficient)
         call take(settings, mixed, "roughness_product", case%bearing_asperity%roughness_product)
         call take(settings, mixed, "roughness_over_tip_radius", case%bearing_asperity%roughness_over_tip_radius)
      end if
      if (has_group(settings, pull)) then
         allocate (case%belt_pull)
         call take(settings, pull, "force_N", case%belt_pull%force)
         call take(settings, pull, "angle_deg", case%belt_pull%angle)
         call take(settings, pull, "position_mm", case%belt_pull%position)
      end if
      if (has_group(settings, warm)) then
         allocate (case%bearing_heat)
         call take(settings, warm, "heat_capacity_J_kg_K", case%bearing_heat%heat_capacity)
         call take(settings, warm, "oil_share", case%bearing_heat%oil_share)
      end if
      if (has_group(settings, drag)) then
         allocate (case%shaft_drag)
         call take(settings, drag, "speed_points_rpm", case%shaft_drag%speed_points)
         call take(settings, drag, "temperature_points_degC", case%shaft_drag%temperature_points)
         call take(settings, drag, "torque_points_Nm", case%shaft_drag%torque_points)
      end if
   end subroutine fill_bearing_parts

   !> Rules: all need bearings, mixed friction surfaces that are apart where the journal is in the middle, heat an oil that thins
   !> with it.
   subroutine check_bearing_parts(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      ! Roughness, radial clearance [m]
      real(wp) :: roughness, clearance

      if (.not. has_group(settings, bearings)) then
         if (has_group(settings, mixed)) call complain_about_group(mistakes, settings, mixed, &
            & "&"//mixed//" needs the group &"//bearings)
         if (has_group(settings, pull)) call complain_about_group(mistakes, settings, pull, &
            & "&"//pull//" needs the group &"//bearings)
         if (has_group(settings, warm)) call complain_about_group(mistakes, settings, warm, &
            & "&"//warm//" needs the group &"//bearings)
         if (has_group(settings, drag)) call complain_about_group(mistakes, settings, drag, &
            & "&"//drag//" needs the group &"//bearings)
         return
      end if
      call check_drag(settings, mistakes)
      if (has_group(settings, warm)) then
         if (get_word(settings, "lubricant", "temperature_law") == "direct") call complain_about_group(mistakes, settings, warm, &
            & direct_advice)
         call check_flow(settings, mistakes)
      end if
      if (.not. has_group(settings, mixed)) return
      if (.not. (is_known(settings, mixed, "roughness_um") .and. is_known(settings, bearings, "radial_clearance_um"))) return
      call take(settings, mixed, "roughness_um", roughness)
      call take(settings, bearings, "radial_clearance_um", clearance)
      if (.not. clearance_is_enough(roughness, clearance)) call complain(mistakes, settings, mixed, "roughness_um", &
         & clearance_advice)
   end subroutine check_bearing_parts

   !> Rule: heat leaves with oil, whose flow is known for some widths.
   subroutine check_flow(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      ! Dimensions of a bearing [m]
      real(wp) :: width, diameter

      if (.not. (is_known(settings, bearings, "width_mm") .and. is_known(settings, bearings, "diameter_mm"))) return
      call take(settings, bearings, "width_mm", width)
      call take(settings, bearings, "diameter_mm", diameter)
      if (flow_covers_width(get_word(settings, bearings, "law"), width, diameter)) return
      ! One complaint about a width is enough
      if (law_covers_width(get_word(settings, bearings, "law"), width, diameter)) call complain(mistakes, settings, bearings, &
         & "width_mm", flow_advice)
   end subroutine check_flow

   !> Rules: the table of seals and drive rises in speed and temperature, and has a torque for each pair.
   subroutine check_drag(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(shaft_drag_t) :: table

      if (.not. (is_known(settings, drag, "speed_points_rpm") .and. is_known(settings, drag, "temperature_points_degC") .and. &
         & is_known(settings, drag, "torque_points_Nm"))) return
      call take(settings, drag, "speed_points_rpm", table%speed_points)
      call take(settings, drag, "temperature_points_degC", table%temperature_points)
      call take(settings, drag, "torque_points_Nm", table%torque_points)
      if (.not. is_rising(table%speed_points)) call complain(mistakes, settings, drag, "speed_points_rpm", &
         & "the numbers of 'speed_points_rpm' must increase")
      if (.not. is_rising(table%temperature_points)) call complain(mistakes, settings, drag, "temperature_points_degC", &
         & "the numbers of 'temperature_points_degC' must increase")
      if (size(table%torque_points) /= size(table%speed_points)*size(table%temperature_points)) call complain(mistakes, &
         & settings, drag, "torque_points_Nm", "'torque_points_Nm' has one number for each speed at each temperature")
   end subroutine check_drag

end module camroller_deck_cam_bearings
