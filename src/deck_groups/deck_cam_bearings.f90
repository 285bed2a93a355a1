!> Decks: the camshaft bearings, and what comes on top of them: mixed friction, the pull of the belt or chain, heat, seals.
!>
!> In: keys, settings. Out: their groups, the components of a case, and the rules that tie their keys to others.
module camroller_deck_cam_bearings
   use camroller_bearing_asperity, only : clearance_advice, clearance_is_enough
   use camroller_bearing_heat, only : direct_advice, flow_advice, flow_covers_width
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : check_points, complain, complain_about_group
   use camroller_deck_schema, only : group_effect, anything, positive, not_negative, from_to, one_or_more, above_absolute_zero
   use camroller_journal, only : journal_law_names, journal_motion_names, law_covers_width
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, take
   implicit none
   private

   public :: bind_cam_bearings, check_bearing_parts

   character(len=*), parameter :: bearings = "cam_bearings", mixed = "bearing_asperity", pull = "belt_pull", &
      & warm = "bearing_heat", drag = "shaft_drag"

contains

   !> Camshaft bearings; what comes on top of them.
   subroutine bind_cam_bearings(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call bind_shaft(keys, case)
      call bind_parts(keys, case)
   end subroutine bind_cam_bearings

   !> Camshaft, its bearings and its cams.
   subroutine bind_shaft(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group(bearings, group_effect, "camshaft, its bearings and its cams")
      if (.not. keys%are_wanted(allocated(case%cam_bearings))) return
      if (.not. allocated(case%cam_bearings)) allocate (case%cam_bearings)
      associate (shaft => case%cam_bearings)
         call keys%choice("law", journal_law_names, "journal bearing law, by width over diameter: 'finite' from 0.1 to 1, as "// &
            & "most camshafts have it; 'short_ocvirk' up to 0.5; 'long_full_sommerfeld' from 2 on", shaft%law)
         call keys%choice("journal_motion", journal_motion_names, &
            & "is a journal at each instant where a steady load would hold it, or on its orbit over the turn?", &
            & shaft%journal_motion)
         call keys%number("diameter_mm", positive, "diameter of the journals", shaft%diameter, example="23", &
            & usual=[12.0_wp, 120.0_wp])
         call keys%number("width_mm", positive, "width of a bearing", shaft%width, example="20", usual=[4.0_wp, 80.0_wp])
         call keys%number("radial_clearance_um", positive, "radial clearance", shaft%radial_clearance, example="47.5", &
            & usual=[5.0_wp, 150.0_wp])
         call keys%numbers("bearing_positions_mm", anything, "places of the bearings along the shaft, increasing", &
            & shaft%bearing_positions, example="0, 60", usual=[-3000.0_wp, 3000.0_wp])
         call keys%numbers("cam_positions_mm", anything, "places of the cams, between the first and the last bearing", &
            & shaft%cam_positions, example="30", usual=[-3000.0_wp, 3000.0_wp])
         call keys%numbers("cam_phases_deg", from_to(-360.0_wp, 360.0_wp), &
            & "angle by which each cam's event follows the first cam's, so that the first is 0; 0 for every cam where not given", &
            & shaft%cam_phases, is_optional=.true.)
         call keys%whole_numbers("cam_lobes", from_to(1.0_wp, 2.0_wp), &
            & "lobe shape of each cam: 1 is &lift, 2 is &second_lift; 1 for every cam where not given", shaft%cam_lobes, &
            & is_optional=.true.)
         call keys%whole_numbers("cam_cylinders", one_or_more, "cylinder of each cam", is_optional=.true.)
         call keys%numbers("follower_angles_deg", from_to(-360.0_wp, 360.0_wp), "angle of each cam's follower about the shaft, "// &
            & "from the first one's, which is 0; positive the way a finger turns as it opens its valve; 0 for every cam where "// &
            & "not given", shaft%follower_angles, is_optional=.true.)
         call keys%yes_or_no("bearing_series", "are there series of each bearing: load, eccentricity, smallest film, friction?", &
            & shaft%by_bearing)
      end associate
   end subroutine bind_shaft

   !> Mixed friction, pull of belt or chain, heat, seals.
   subroutine bind_parts(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group(mixed, group_effect, "asperities that share the load of the camshaft bearings where their "// &
         & "film is thin")
      if (keys%are_wanted(allocated(case%bearing_asperity))) then
         if (.not. allocated(case%bearing_asperity)) allocate (case%bearing_asperity)
         call keys%number("roughness_um", positive, "root mean square roughness of journal and bearing together", &
            & case%bearing_asperity%roughness, example="0.4", usual=[0.05_wp, 5.0_wp])
         call keys%number("modulus_GPa", positive, "E' of journal and bearing, 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]", &
            & case%bearing_asperity%modulus, example="110", usual=[20.0_wp, 300.0_wp])
         call keys%number("boundary_coefficient", not_negative, "friction coefficient of touching asperities", &
            & case%bearing_asperity%boundary_coefficient, example="0.1", usual=[0.0_wp, 0.5_wp])
         call keys%number("roughness_product", positive, "asperity density times tip radius times roughness", &
            & case%bearing_asperity%roughness_product, usual=[0.01_wp, 0.15_wp])
         call keys%number("roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
            & case%bearing_asperity%roughness_over_tip_radius, usual=[1.0e-5_wp, 0.1_wp])
      end if
      call keys%group(pull, group_effect, "constant force of the belt or chain that drives each camshaft")
      if (keys%are_wanted(allocated(case%belt_pull))) then
         if (.not. allocated(case%belt_pull)) allocate (case%belt_pull)
         call keys%number("force_N", not_negative, "the force", case%belt_pull%force, example="400", usual=[0.0_wp, 5000.0_wp])
         call keys%number("angle_deg", from_to(-360.0_wp, 360.0_wp), "its direction, from the line from the first follower's "// &
            & "pivot to the cam's centre, positive the way a finger turns as it opens its valve", case%belt_pull%angle, &
            & example="-90")
         call keys%number("position_mm", anything, "place of its wheel along the shaft, which may overhang the bearings", &
            & case%belt_pull%position, example="-30", usual=[-3000.0_wp, 3000.0_wp])
      end if
      call keys%group(warm, group_effect, "heat balance of each camshaft bearing: viscosity at the mean temperature "// &
         & "of its oil")
      if (keys%are_wanted(allocated(case%bearing_heat))) then
         if (.not. allocated(case%bearing_heat)) allocate (case%bearing_heat)
         call keys%number("heat_capacity_J_kg_K", positive, "heat capacity of the oil", case%bearing_heat%heat_capacity, &
            & usual=[1500.0_wp, 2700.0_wp])
         call keys%number("oil_share", from_to(0.0_wp, 1.0_wp), "part of the friction's heat that the oil carries away; the "// &
            & "rest goes into the metal: most of it at low speed, where a remark gives bounds", case%bearing_heat%oil_share)
      end if
      call keys%group(drag, group_effect, "torque of the seals and of the belt or chain on each camshaft, as a table "// &
         & "over speed and temperature; needs &cam_bearings")
      if (keys%are_wanted(allocated(case%shaft_drag))) then
         if (.not. allocated(case%shaft_drag)) allocate (case%shaft_drag)
         call keys%numbers("speed_points_rpm", not_negative, &
            & "speeds of the camshaft, increasing; with one alone the torque does not depend on it", case%shaft_drag%speed_points, &
            & example="0, 1000, 3000", usual=[0.0_wp, 10000.0_wp])
         call keys%numbers("temperature_points_degC", above_absolute_zero, &
            & "temperatures of the oil, increasing; with one alone the torque does not depend on it", &
            & case%shaft_drag%temperature_points, example="20, 90", usual=[-40.0_wp, 180.0_wp])
         call keys%numbers("torque_points_Nm", not_negative, "torques: those of all speeds at the first temperature, then at "// &
            & "the next; linear between them, a case outside the table is refused", case%shaft_drag%torque_points, &
            & example="0.25, 0.20, 0.22, 0.15, 0.12, 0.14", usual=[0.0_wp, 20.0_wp])
      end if
   end subroutine bind_parts

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
      call check_points(settings, drag, [character(len=23) :: "speed_points_rpm", "temperature_points_degC", "torque_points_Nm"], &
         & mistakes)
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

end module camroller_deck_cam_bearings
