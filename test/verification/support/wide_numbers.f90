!> Usual ranges of the numbers of a deck, and the ends of what the schema allows.
module wide_numbers
   use camroller_kinds, only : wp
   use camroller_deck_schema, only : range_t
   use random_decks, only : random_t, draw
   use wide_words, only : number_words
   implicit none
   private

   public :: usual_t, find_range, end_of_range, lower_end, upper_end

   !> What a number usually is
   type :: usual_t
      !> Group and key
      character(len=60) :: name = ""
      !> Range [unit of the key]
      real(wp) :: lowest = 1.0_wp, highest = 2.0_wp
      !> Is each ratio as likely as another, or each difference?
      logical :: is_wide = .false.
      !> Must it be a whole part of a turn?
      logical :: divides_turn = .false.
   end type usual_t

   !> All numbers; wide enough for roller followers from model engines to ships, from cranking to flight
   type(usual_t), parameter :: usual(*) = [ &
      & usual_t("operating_point.speed_rpm", 1.0_wp, 5000.0_wp, .true.), &
      & usual_t("operating_point.oil_temperature_degC", -20.0_wp, 140.0_wp), &
      & usual_t("mechanism.pivot_to_roller_mm", 18.0_wp, 26.0_wp), &
      & usual_t("mechanism.pivot_to_pad_mm", 30.0_wp, 45.0_wp), &
      & usual_t("mechanism.pivot_to_cam_mm", 28.0_wp, 38.0_wp), &
      & usual_t("mechanism.roller_arm_angle_deg", -8.0_wp, 8.0_wp), &
      & usual_t("mechanism.valve_axis_angle_deg", 25.0_wp, 45.0_wp), &
      & usual_t("mechanism.adjuster_tilt_deg", -30.0_wp, 30.0_wp), &
      & usual_t("mechanism.base_radius_mm", 14.0_wp, 20.0_wp), &
      & usual_t("mechanism.contact_width_mm", 3.0_wp, 30.0_wp, .true.), &
      & usual_t("mechanism.grinding_wheel_radius_mm", 20.0_wp, 200.0_wp, .true.), &
      & usual_t("roller.radius_mm", 6.0_wp, 11.0_wp), &
      & usual_t("roller.mass_kg", 1.0e-3_wp, 0.05_wp, .true.), &
      & usual_t("roller.wall_thickness_mm", 1.0_wp, 3.0_wp), &
      & usual_t("lift.max_lift_mm", 1.0_wp, 10.0_wp), &
      & usual_t("lift.opening_half_angle_deg", 45.0_wp, 110.0_wp), &
      & usual_t("lift.closing_half_angle_deg", 45.0_wp, 110.0_wp), &
      & usual_t("lift.table_nose_angle_deg", -180.0_wp, 360.0_wp), &
      & usual_t("lift.smoothing_um", 0.01_wp, 3.0_wp, .true.), &
      & usual_t("masses.valve_kg", 0.01_wp, 0.15_wp, .true.), &
      & usual_t("masses.finger_kg", 0.01_wp, 0.15_wp, .true.), &
      & usual_t("masses.finger_inertia_kg_m2", 5.0e-6_wp, 3.0e-4_wp, .true.), &
      & usual_t("masses.finger_centre_mm", 1.0_wp, 20.0_wp, .true.), &
      & usual_t("spring.stiffness_N_m", 1.0e4_wp, 1.0e5_wp, .true.), &
      & usual_t("spring.precompression_mm", 5.0_wp, 15.0_wp), &
      & usual_t("spring.base_circle_load_N", 0.1_wp, 60.0_wp, .true.), &
      & usual_t("spring.seat_stiffness_N_m", 1.0e6_wp, 1.0e9_wp, .true.), &
      & usual_t("gas_force.table_nose_angle_deg", -180.0_wp, 360.0_wp), &
      & usual_t("gas_force.valve_diameter_mm", 15.0_wp, 45.0_wp), &
      & usual_t("gas_force.second_valve_diameter_mm", 15.0_wp, 45.0_wp), &
      & usual_t("materials.cam_modulus_GPa", 70.0_wp, 400.0_wp), &
      & usual_t("materials.roller_modulus_GPa", 70.0_wp, 400.0_wp), &
      & usual_t("materials.cam_poisson_ratio", 0.2_wp, 0.35_wp), &
      & usual_t("materials.roller_poisson_ratio", 0.2_wp, 0.35_wp), &
      & usual_t("materials.hardness_GPa", 0.5_wp, 10.0_wp, .true.), &
      & usual_t("surface.cam_roughness_um", 1.0e-3_wp, 2.0_wp, .true.), &
      & usual_t("surface.roller_roughness_um", 1.0e-3_wp, 2.0_wp, .true.), &
      & usual_t("lubricant.viscosity_Pa_s", 1.0e-3_wp, 10.0_wp, .true.), &
      & usual_t("lubricant.viscosity_at_40_degC_mm2_s", 15.0_wp, 300.0_wp, .true.), &
      & usual_t("lubricant.viscosity_at_100_degC_mm2_s", 3.0_wp, 14.0_wp, .true.), &
      & usual_t("lubricant.viscosity_index", 50.0_wp, 250.0_wp), &
      & usual_t("lubricant.hths_viscosity_mPa_s", 1.5_wp, 6.0_wp), &
      & usual_t("lubricant.density_kg_m3", 800.0_wp, 950.0_wp), &
      & usual_t("lubricant.thermal_expansion_per_K", 1.0e-5_wp, 1.0e-3_wp), &
      & usual_t("lubricant.pressure_viscosity_coefficient_per_GPa", 8.0_wp, 30.0_wp), &
      & usual_t("lubricant.roelands_index", 0.3_wp, 0.9_wp), &
      & usual_t("ehl.accuracy", 0.03_wp, 0.2_wp, .true.), &
      & usual_t("traction.eyring_stress_MPa", 1.0_wp, 20.0_wp, .true.), &
      & usual_t("traction.limiting_coefficient", 0.02_wp, 0.12_wp), &
      & usual_t("traction.limiting_stress_MPa", 0.0_wp, 10.0_wp), &
      & usual_t("roller_profile.crown_radius_mm", 300.0_wp, 3.0e4_wp, .true.), &
      & usual_t("roller_profile.design_load_N", 10.0_wp, 5000.0_wp, .true.), &
      & usual_t("roller_profile.end_drop_um", 0.0_wp, 20.0_wp), &
      & usual_t("roller_profile.tilt_mrad", -1.0_wp, 1.0_wp), &
      & usual_t("roller_profile.slices", 11.0_wp, 61.0_wp), &
      & usual_t("heat.oil_conductivity_W_m_K", 0.1_wp, 0.25_wp, .true.), &
      & usual_t("heat.oil_heat_capacity_J_kg_K", 1600.0_wp, 2500.0_wp), &
      & usual_t("heat.viscosity_fall_per_K", 0.02_wp, 0.1_wp, .true.), &
      & usual_t("heat.limit_fall_per_K", 0.0_wp, 0.01_wp), &
      & usual_t("heat.cam_conductivity_W_m_K", 2.0_wp, 100.0_wp, .true.), &
      & usual_t("heat.cam_density_kg_m3", 3000.0_wp, 8000.0_wp), &
      & usual_t("heat.cam_heat_capacity_J_kg_K", 400.0_wp, 800.0_wp), &
      & usual_t("heat.roller_conductivity_W_m_K", 2.0_wp, 100.0_wp, .true.), &
      & usual_t("heat.roller_density_kg_m3", 3000.0_wp, 8000.0_wp), &
      & usual_t("heat.roller_heat_capacity_J_kg_K", 400.0_wp, 800.0_wp), &
      & usual_t("asperity.roughness_product", 0.025_wp, 0.1_wp), &
      & usual_t("asperity.roughness_over_tip_radius", 1.0e-4_wp, 0.05_wp, .true.), &
      & usual_t("asperity.boundary_coefficient", 0.0_wp, 0.3_wp), &
      & usual_t("asperity.film_shear_strength_MPa", 0.0_wp, 20.0_wp), &
      & usual_t("asperity.mobilising_speed_m_s", 1.0e-6_wp, 1.0e-2_wp, .true.), &
      & usual_t("friction_modifier.coefficient", 0.0_wp, 0.15_wp), &
      & usual_t("friction_modifier.coverage", 0.01_wp, 0.99_wp), &
      & usual_t("friction_modifier.reference_temperature_degC", -20.0_wp, 140.0_wp), &
      & usual_t("friction_modifier.adsorption_heat_kJ_mol", 0.0_wp, 150.0_wp), &
      & usual_t("friction_modifier.concentration_ratio", 0.01_wp, 100.0_wp, .true.), &
      & usual_t("boundary_law.reference_speed_m_s", 1.0e-3_wp, 1.0_wp, .true.), &
      & usual_t("boundary_law.reference_temperature_degC", 20.0_wp, 140.0_wp), &
      & usual_t("boundary_law.change_per_decade", -0.02_wp, 0.02_wp), &
      & usual_t("boundary_law.change_per_K", -5.0e-4_wp, 5.0e-4_wp), &
      & usual_t("boundary_law.lowest_speed_m_s", 1.0e-4_wp, 1.0e-2_wp, .true.), &
      & usual_t("boundary_law.smallest_coefficient", 0.0_wp, 0.05_wp), &
      & usual_t("boundary_law.largest_coefficient", 0.1_wp, 0.3_wp), &
      & usual_t("wear.cam_rate_mm3_N_m", 1.0e-12_wp, 1.0e-7_wp, .true.), &
      & usual_t("wear.roller_rate_mm3_N_m", 1.0e-12_wp, 1.0e-7_wp, .true.), &
      & usual_t("tribofilm.growth_rate_nm_s", 1.0e5_wp, 1.0e9_wp, .true.), &
      & usual_t("tribofilm.activation_energy_kJ_mol", 40.0_wp, 100.0_wp), &
      & usual_t("tribofilm.activation_volume_nm3", 0.0_wp, 0.3_wp), &
      & usual_t("tribofilm.removal_rate_per_s", 1.0e-3_wp, 1.0_wp, .true.), &
      & usual_t("tribofilm.largest_thickness_nm", 10.0_wp, 300.0_wp), &
      & usual_t("tribofilm.roughness_ratio", 0.0_wp, 1.0_wp), &
      & usual_t("tribofilm.coefficient", 0.05_wp, 0.2_wp), &
      & usual_t("running_in.duration_h", 0.1_wp, 100.0_wp, .true.), &
      & usual_t("running_in.accuracy", 1.0e-3_wp, 1.0e-1_wp, .true.), &
      & usual_t("running_in.places", 24.0_wp, 720.0_wp), &
      & usual_t("needle_bearing.friction_coefficient", 1.0e-4_wp, 0.1_wp, .true.), &
      & usual_t("needle_bearing.needle_radius_mm", 0.5_wp, 1.45_wp), &
      & usual_t("needle_bearing.reversal_ratio", 1.0e-4_wp, 0.5_wp, .true.), &
      & usual_t("needle_bearing.skf_rolling_factor", 5.0e-7_wp, 5.0e-6_wp, .true.), &
      & usual_t("needle_bearing.skf_sliding_factor", 5.0e-4_wp, 5.0e-3_wp, .true.), &
      & usual_t("needle_bearing.skf_geometry_factor", 4.0_wp, 8.0_wp), &
      & usual_t("needle_bearing.skf_replenishment_factor", 1.0e-8_wp, 6.0e-8_wp, .true.), &
      & usual_t("needle_bearing.skf_film_coefficient", 0.005_wp, 0.05_wp, .true.), &
      & usual_t("needle_bearing.pin_width_mm", 4.0_wp, 9.0_wp), &
      & usual_t("needle_bearing.pin_radial_clearance_um", 10.0_wp, 60.0_wp, .true.), &
      & usual_t("needle_bearing.pin_roughness_um", 0.02_wp, 1.0_wp, .true.), &
      & usual_t("needle_bearing.pin_modulus_GPa", 50.0_wp, 250.0_wp), &
      & usual_t("needle_bearing.pin_roughness_product", 0.02_wp, 0.1_wp), &
      & usual_t("needle_bearing.pin_roughness_over_tip_radius", 1.0e-4_wp, 0.05_wp, .true.), &
      & usual_t("cam_bearings.diameter_mm", 18.0_wp, 35.0_wp), &
      & usual_t("cam_bearings.width_mm", 8.0_wp, 30.0_wp), &
      & usual_t("cam_bearings.radial_clearance_um", 10.0_wp, 100.0_wp, .true.), &
      & usual_t("bearing_asperity.roughness_um", 0.02_wp, 1.2_wp, .true.), &
      & usual_t("bearing_asperity.modulus_GPa", 50.0_wp, 250.0_wp), &
      & usual_t("bearing_asperity.boundary_coefficient", 0.0_wp, 0.3_wp), &
      & usual_t("bearing_asperity.roughness_product", 0.02_wp, 0.1_wp), &
      & usual_t("bearing_asperity.roughness_over_tip_radius", 1.0e-4_wp, 0.05_wp, .true.), &
      & usual_t("bearing_heat.heat_capacity_J_kg_K", 1700.0_wp, 2300.0_wp), &
      & usual_t("bearing_heat.oil_share", 0.2_wp, 1.0_wp), &
      & usual_t("belt_pull.force_N", 0.0_wp, 2000.0_wp), &
      & usual_t("belt_pull.angle_deg", -180.0_wp, 180.0_wp), &
      & usual_t("belt_pull.position_mm", -60.0_wp, 60.0_wp), &
      & usual_t("engine.cylinders", 2.0_wp, 6.0_wp), &
      & usual_t("engine.strokes", 2.0_wp, 4.0_wp), &
      & usual_t("engine.camshafts", 1.0_wp, 2.0_wp), &
      & usual_t("engine.displacement_cm3", 50.0_wp, 2.0e4_wp, .true.), &
      & usual_t("valve_guide.length_mm", 20.0_wp, 50.0_wp), &
      & usual_t("valve_guide.stem_diameter_mm", 4.0_wp, 8.0_wp), &
      & usual_t("valve_guide.radial_clearance_um", 10.0_wp, 50.0_wp, .true.), &
      & usual_t("valve_tip.pad_radius_mm", 4.0_wp, 30.0_wp), &
      & usual_t("stem_seal.lip_force_N", 0.0_wp, 20.0_wp), &
      & usual_t("stem_seal.viscous_drag_N_s_m", 0.0_wp, 20.0_wp), &
      & usual_t("guide_side_load.guide_length_mm", 20.0_wp, 50.0_wp), &
      & usual_t("guide_side_load.tip_height_mm", 10.0_wp, 40.0_wp), &
      & usual_t("guide_side_load.stem_axis_mm", 30.0_wp, 45.0_wp), &
      & usual_t("finger_pivot.ball_radius_mm", 3.0_wp, 8.0_wp), &
      & usual_t("joint.friction_coefficient", 0.0_wp, 0.2_wp), &
      & usual_t("joint.decay_speed_m_s", 1.0e-3_wp, 1.0_wp, .true.), &
      & usual_t("joint.viscous_part_s_m", 0.0_wp, 0.1_wp), &
      & usual_t("joint.reference_viscosity_Pa_s", 1.0e-3_wp, 1.0_wp, .true.), &
      & usual_t("joint.reference_load_N", 10.0_wp, 1000.0_wp, .true.), &
      & usual_t("joint.reversal_speed_m_s", 1.0e-4_wp, 0.1_wp, .true.), &
      & usual_t("needle_drag.pitch_diameter_mm", 6.0_wp, 14.0_wp), &
      & usual_t("needle_drag.viscous_factor", 1.0_wp, 20.0_wp), &
      & usual_t("needle_drag.reversal_ratio", 1.0e-3_wp, 0.5_wp, .true.), &
      & usual_t("dynamics.finger_stiffness_N_m", 3.0e6_wp, 1.0e8_wp, .true.), &
      & usual_t("dynamics.contact_damping_s_m", 0.0_wp, 2.0_wp), &
      & usual_t("dynamics.pad_stiffness_N_m", 3.0e6_wp, 1.0e8_wp, .true.), &
      & usual_t("dynamics.pad_damping_s_m", 0.0_wp, 2.0_wp), &
      & usual_t("dynamics.seat_stiffness_N_m", 3.0e6_wp, 1.0e8_wp, .true.), &
      & usual_t("dynamics.seat_damping_s_m", 0.0_wp, 3.0_wp), &
      & usual_t("dynamics.seat_restitution", 0.05_wp, 0.95_wp), &
      & usual_t("dynamics.seat_restitution_speed_m_s", 0.05_wp, 1.0_wp, .true.), &
      & usual_t("dynamics.lash_mm", 0.0_wp, 0.3_wp), &
      & usual_t("spring_surge.mass_kg", 5.0e-3_wp, 0.3_wp, .true.), &
      & usual_t("spring_surge.modes", 2.0_wp, 4.0_wp), &
      & usual_t("spring_surge.damping_ratio", 3.0e-3_wp, 0.1_wp, .true.), &
      & usual_t("lash_adjuster.diameter_mm", 7.0_wp, 12.0_wp), &
      & usual_t("lash_adjuster.volume_cm3", 0.3_wp, 2.0_wp, .true.), &
      & usual_t("lash_adjuster.gap_um", 3.0_wp, 12.0_wp), &
      & usual_t("lash_adjuster.eccentricity", 0.1_wp, 0.9_wp), &
      & usual_t("lash_adjuster.leak_length_mm", 3.0_wp, 12.0_wp), &
      & usual_t("lash_adjuster.plunger_mass_kg", 3.0e-3_wp, 0.03_wp, .true.), &
      & usual_t("lash_adjuster.plunger_spring_N", 3.0_wp, 60.0_wp, .true.), &
      & usual_t("lash_adjuster.plunger_stiffness_N_m", 100.0_wp, 3000.0_wp, .true.), &
      & usual_t("lash_adjuster.check_area_mm2", 0.5_wp, 10.0_wp, .true.), &
      & usual_t("lash_adjuster.discharge_coefficient", 0.4_wp, 0.9_wp), &
      & usual_t("lash_adjuster.crack_pressure_kPa", 0.0_wp, 30.0_wp), &
      & usual_t("lash_adjuster.full_pressure_kPa", 5.0_wp, 100.0_wp, .true.), &
      & usual_t("lash_adjuster.transition_pressure_kPa", 0.1_wp, 10.0_wp, .true.), &
      & usual_t("lash_adjuster.supply_pressure_MPa", 0.02_wp, 0.6_wp, .true.), &
      & usual_t("lash_adjuster.air_content", 1.0e-3_wp, 0.1_wp, .true.), &
      & usual_t("lash_adjuster.oil_modulus_GPa", 0.8_wp, 2.0_wp), &
      & usual_t("lash_adjuster.density_kg_m3", 750.0_wp, 900.0_wp), &
      & usual_t("lash_adjuster.lowest_mm", -2.5_wp, -0.5_wp), &
      & usual_t("lash_adjuster.highest_mm", 0.5_wp, 3.0_wp), &
      & usual_t("lash_adjuster.stop_stiffness_N_m", 1.0e7_wp, 1.0e9_wp, .true.), &
      & usual_t("lash_adjuster.stop_damping_s_m", 0.0_wp, 3.0_wp), &
      & usual_t("effects.negligible", 1.0e-5_wp, 0.1_wp, .true.), &
      & usual_t("numerics.accuracy", 1.0e-6_wp, 1.0e-2_wp, .true.), &
      & usual_t("numerics.tolerance", 1.0e-8_wp, 1.0e-3_wp, .true.), &
      & usual_t("numerics.step_deg", 0.01_wp, 2.0_wp, .true.), &
      & usual_t("numerics.periodicity", 1.0e-8_wp, 1.0e-3_wp, .true.), &
      & usual_t("numerics.max_cycles", 2.0_wp, 60.0_wp), &
      & usual_t("output.angle_step_deg", 0.2_wp, 5.0_wp, .true., .true.)]

contains

   !> Usual range of a number; the second lift is like the first, and the joints' friction is alike.
   pure subroutine find_range(name, range, is_known)
      !> Group and key
      character(len=*), intent(in) :: name
      !> The range
      type(usual_t), intent(out) :: range
      !> Is there one?
      logical, intent(out) :: is_known
      integer :: i

      character(len=*), parameter :: joints(*) = [character(len=16) :: &
         & "valve_tip.", "stem_seal.", "guide_side_load.", "finger_pivot."]
      ! The name as it stands in the list, and as one of a joint or of what is second to something else
      character(len=len(usual%name)) :: given, alike

      given = name
      alike = name
      if (index(name, "second_") == 1) alike = name(8:)
      do i = 1, size(joints)
         if (index(name, trim(joints(i))) == 1) alike = "joint."//name(len_trim(joints(i)) + 1:)
      end do
      do i = 1, size(usual)
         is_known = usual(i)%name == given .or. usual(i)%name == alike
         if (is_known) range = usual(i)
         if (is_known) return
      end do
   end subroutine find_range

   !> A number at an end of what the schema allows, or far beyond the usual where there is no end.
   subroutine end_of_range(random, range, usual_range, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What the schema allows
      type(range_t), intent(in) :: range
      !> The usual range
      type(usual_t), intent(in) :: usual_range
      !> The number
      character(len=:), allocatable, intent(out) :: words
      ! Part of the open ends that are approached as closely as a number can [-]
      real(wp), parameter :: extreme_share = 0.2_wp
      ! [-]
      real(wp) :: side, far

      call draw(random, side)
      call draw(random, far)
      if (side < 0.5_wp) then
         words = number_words(lower_end(range, usual_range, far < extreme_share))
      else
         words = number_words(upper_end(range, usual_range, far < extreme_share))
      end if
   end subroutine end_of_range

   !> The lower end.
   pure function lower_end(range, usual_range, is_extreme) result(value)
      !> What the schema allows
      type(range_t), intent(in) :: range
      !> The usual range
      type(usual_t), intent(in) :: usual_range
      !> As close as a number can be, or a little less so?
      logical, intent(in) :: is_extreme
      ! [unit of the key]
      real(wp) :: value
      ! Parts of the distance from the end to the usual [-]
      real(wp), parameter :: close = 1.0e-4_wp, closest = 1.0e-200_wp

      if (range%smallest < -0.5_wp*huge(1.0_wp)) then
         value = -merge(1.0e200_wp, 1.0e4_wp, is_extreme)*(abs(usual_range%highest) + 1.0_wp)
      else if (range%with_smallest) then
         value = range%smallest
      else
         value = range%smallest + merge(closest, close, is_extreme)*(usual_range%highest - range%smallest)
         if (.not. value > range%smallest) value = range%smallest + 4.0_wp*spacing(range%smallest)
      end if
   end function lower_end

   !> The upper end.
   pure function upper_end(range, usual_range, is_extreme) result(value)
      !> What the schema allows
      type(range_t), intent(in) :: range
      !> The usual range
      type(usual_t), intent(in) :: usual_range
      !> As close as a number can be, or a little less so?
      logical, intent(in) :: is_extreme
      ! [unit of the key]
      real(wp) :: value
      ! Distance from an open end, over the end [-]
      real(wp), parameter :: close = 1.0e-4_wp, closest = 4.0_wp*epsilon(1.0_wp)

      if (range%largest > 0.5_wp*huge(1.0_wp)) then
         value = merge(1.0e200_wp, 1.0e4_wp, is_extreme)*(abs(usual_range%highest) + 1.0_wp)
      else if (range%with_largest) then
         value = range%largest
      else
         value = range%largest - merge(closest, close, is_extreme)*abs(range%largest)
      end if
   end function upper_end

end module wide_numbers
