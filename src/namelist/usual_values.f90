!> Usual values of a deck's numbers: the one table of what an engine has, beside what a deck may hold.
!>
!> In: the schema. Out: the same with usual ranges. A number outside of its usual range is no mistake; a remark asks whether it is
!> meant, as `defaults` shows the range. Ranges hold engines from motorcycles to trucks, from cranking to their limit.
module camroller_usual_values
   use camroller_kinds, only : wp
   use camroller_deck_schema, only : find_group, find_key, schema_t, range_t
   implicit none
   private

   public :: add_usual_ranges

   !> Usual range of one number
   type :: usual_t
      !> As `group.key`
      character(len=48) :: name
      !> Ends of the range [unit of the key]
      real(wp) :: smallest, largest
   end type usual_t

   type(usual_t), parameter :: usual(*) = [ &
      usual_t("operating_point.speed_rpm", 50.0_wp, 6000.0_wp), &
      usual_t("operating_point.oil_temperature_degC", -40.0_wp, 180.0_wp), &
      usual_t("mechanism.pivot_to_roller_mm", 8.0_wp, 60.0_wp), &
      usual_t("mechanism.pivot_to_pad_mm", 15.0_wp, 120.0_wp), &
      usual_t("mechanism.pivot_to_cam_mm", 15.0_wp, 100.0_wp), &
      ! The cam stands over the finger, between its pivot and the valve
      usual_t("mechanism.valve_axis_angle_deg", 5.0_wp, 70.0_wp), &
      usual_t("mechanism.base_radius_mm", 6.0_wp, 60.0_wp), &
      usual_t("mechanism.contact_width_mm", 2.0_wp, 60.0_wp), &
      usual_t("mechanism.grinding_wheel_radius_mm", 10.0_wp, 500.0_wp), &
      usual_t("roller.radius_mm", 3.0_wp, 30.0_wp), &
      usual_t("roller.mass_kg", 1.0e-3_wp, 0.3_wp), &
      usual_t("roller.wall_thickness_mm", 0.8_wp, 15.0_wp), &
      usual_t("lift.max_lift_mm", 1.0_wp, 25.0_wp), &
      usual_t("lift.opening_half_angle_deg", 35.0_wp, 110.0_wp), &
      usual_t("lift.closing_half_angle_deg", 35.0_wp, 110.0_wp), &
      usual_t("lift.smoothing_um", 0.0_wp, 20.0_wp), &
      usual_t("masses.valve_kg", 0.01_wp, 1.0_wp), &
      usual_t("masses.finger_kg", 0.005_wp, 1.0_wp), &
      usual_t("masses.finger_inertia_kg_m2", 1.0e-6_wp, 5.0e-3_wp), &
      usual_t("masses.finger_centre_mm", 1.0_wp, 60.0_wp), &
      usual_t("spring.stiffness_N_m", 2000.0_wp, 2.0e5_wp), &
      usual_t("spring.precompression_mm", 1.0_wp, 40.0_wp), &
      usual_t("spring.base_circle_load_N", 0.0_wp, 400.0_wp), &
      usual_t("spring.seat_stiffness_N_m", 1.0e5_wp, 1.0e9_wp), &
      usual_t("gas_force.valve_diameter_mm", 10.0_wp, 80.0_wp), &
      usual_t("gas_force.second_valve_diameter_mm", 10.0_wp, 80.0_wp), &
      usual_t("materials.cam_modulus_GPa", 60.0_wp, 450.0_wp), &
      usual_t("materials.roller_modulus_GPa", 60.0_wp, 450.0_wp), &
      usual_t("materials.cam_poisson_ratio", 0.15_wp, 0.4_wp), &
      usual_t("materials.roller_poisson_ratio", 0.15_wp, 0.4_wp), &
      usual_t("materials.hardness_GPa", 0.5_wp, 25.0_wp), &
      usual_t("surface.cam_roughness_um", 0.0_wp, 3.0_wp), &
      usual_t("surface.roller_roughness_um", 0.0_wp, 3.0_wp), &
      usual_t("lubricant.viscosity_Pa_s", 1.0e-3_wp, 20.0_wp), &
      usual_t("lubricant.viscosity_points_Pa_s", 5.0e-4_wp, 20.0_wp), &
      usual_t("lubricant.temperature_points_degC", -40.0_wp, 200.0_wp), &
      usual_t("lubricant.viscosity_at_40_degC_mm2_s", 10.0_wp, 500.0_wp), &
      usual_t("lubricant.viscosity_at_100_degC_mm2_s", 2.0_wp, 40.0_wp), &
      usual_t("lubricant.viscosity_index", 50.0_wp, 250.0_wp), &
      usual_t("lubricant.hths_viscosity_mPa_s", 1.3_wp, 8.0_wp), &
      usual_t("lubricant.density_kg_m3", 750.0_wp, 1050.0_wp), &
      usual_t("lubricant.thermal_expansion_per_K", 4.0e-4_wp, 1.0e-3_wp), &
      usual_t("lubricant.pressure_viscosity_coefficient_per_GPa", 4.0_wp, 45.0_wp), &
      usual_t("lubricant.pressure_viscosity_points_per_GPa", 4.0_wp, 45.0_wp), &
      usual_t("lubricant.pressure_viscosity_temperatures_degC", -40.0_wp, 200.0_wp), &
      usual_t("lubricant.roelands_index", 0.2_wp, 1.2_wp), &
      usual_t("traction.eyring_stress_MPa", 0.5_wp, 30.0_wp), &
      usual_t("traction.limiting_coefficient", 0.01_wp, 0.2_wp), &
      usual_t("traction.limiting_stress_MPa", 0.0_wp, 20.0_wp), &
      usual_t("roller_profile.crown_radius_mm", 100.0_wp, 1.0e5_wp), &
      usual_t("roller_profile.design_load_N", 10.0_wp, 1.0e4_wp), &
      usual_t("roller_profile.end_drop_um", 0.0_wp, 20.0_wp), &
      usual_t("roller_profile.tilt_mrad", -5.0_wp, 5.0_wp), &
      usual_t("heat.oil_conductivity_W_m_K", 0.05_wp, 0.5_wp), &
      usual_t("heat.oil_heat_capacity_J_kg_K", 1500.0_wp, 2700.0_wp), &
      usual_t("heat.viscosity_fall_per_K", 0.01_wp, 0.12_wp), &
      usual_t("heat.limit_fall_per_K", 0.0_wp, 0.02_wp), &
      usual_t("heat.cam_conductivity_W_m_K", 1.0_wp, 200.0_wp), &
      usual_t("heat.cam_density_kg_m3", 2000.0_wp, 9000.0_wp), &
      usual_t("heat.cam_heat_capacity_J_kg_K", 300.0_wp, 1000.0_wp), &
      usual_t("heat.roller_conductivity_W_m_K", 1.0_wp, 200.0_wp), &
      usual_t("heat.roller_density_kg_m3", 2000.0_wp, 9000.0_wp), &
      usual_t("heat.roller_heat_capacity_J_kg_K", 300.0_wp, 1000.0_wp), &
      usual_t("asperity.roughness_product", 0.01_wp, 0.15_wp), &
      usual_t("asperity.roughness_over_tip_radius", 1.0e-5_wp, 0.1_wp), &
      usual_t("asperity.boundary_coefficient", 0.0_wp, 0.5_wp), &
      usual_t("asperity.film_shear_strength_MPa", 0.0_wp, 100.0_wp), &
      usual_t("asperity.mobilising_speed_m_s", 1.0e-6_wp, 0.05_wp), &
      usual_t("friction_modifier.coefficient", 0.02_wp, 0.2_wp), &
      usual_t("friction_modifier.coverage", 0.01_wp, 0.999_wp), &
      usual_t("friction_modifier.reference_temperature_degC", -40.0_wp, 200.0_wp), &
      usual_t("friction_modifier.adsorption_heat_kJ_mol", 5.0_wp, 150.0_wp), &
      usual_t("friction_modifier.concentration_ratio", 0.001_wp, 1000.0_wp), &
      usual_t("boundary_law.reference_speed_m_s", 1.0e-4_wp, 20.0_wp), &
      usual_t("boundary_law.reference_temperature_degC", -40.0_wp, 250.0_wp), &
      usual_t("boundary_law.change_per_decade", -0.05_wp, 0.05_wp), &
      usual_t("boundary_law.change_per_K", -2.0e-3_wp, 2.0e-3_wp), &
      usual_t("boundary_law.lowest_speed_m_s", 1.0e-6_wp, 0.1_wp), &
      usual_t("boundary_law.smallest_coefficient", 0.0_wp, 0.2_wp), &
      usual_t("boundary_law.largest_coefficient", 0.05_wp, 1.0_wp), &
      usual_t("boundary_law.speed_points_m_s", 1.0e-5_wp, 20.0_wp), &
      usual_t("boundary_law.temperature_points_degC", -40.0_wp, 250.0_wp), &
      usual_t("boundary_law.coefficient_points", 0.01_wp, 0.5_wp), &
      usual_t("wear.cam_rate_mm3_N_m", 0.0_wp, 1.0e-3_wp), &
      usual_t("wear.roller_rate_mm3_N_m", 0.0_wp, 1.0e-3_wp), &
      usual_t("tribofilm.growth_rate_nm_s", 0.0_wp, 1.0e15_wp), &
      usual_t("tribofilm.activation_energy_kJ_mol", 0.0_wp, 250.0_wp), &
      usual_t("tribofilm.activation_volume_nm3", 0.0_wp, 1.0_wp), &
      usual_t("tribofilm.removal_rate_per_s", 0.0_wp, 1.0e3_wp), &
      usual_t("tribofilm.largest_thickness_nm", 1.0_wp, 1.0e3_wp), &
      usual_t("tribofilm.roughness_ratio", 0.0_wp, 3.0_wp), &
      usual_t("tribofilm.coefficient", 0.01_wp, 0.5_wp), &
      usual_t("running_in.duration_h", 1.0e-3_wp, 1.0e4_wp), &
      usual_t("needle_bearing.friction_coefficient", 0.0_wp, 0.3_wp), &
      usual_t("needle_bearing.needle_radius_mm", 0.3_wp, 5.0_wp), &
      usual_t("needle_bearing.skf_rolling_factor", 2.0e-7_wp, 1.0e-5_wp), &
      usual_t("needle_bearing.skf_sliding_factor", 1.0e-4_wp, 0.01_wp), &
      usual_t("needle_bearing.skf_geometry_factor", 3.0_wp, 12.0_wp), &
      usual_t("needle_bearing.skf_replenishment_factor", 1.0e-8_wp, 1.0e-7_wp), &
      usual_t("needle_bearing.skf_film_coefficient", 0.001_wp, 0.1_wp), &
      usual_t("needle_bearing.pin_width_mm", 2.0_wp, 25.0_wp), &
      usual_t("needle_bearing.pin_radial_clearance_um", 5.0_wp, 100.0_wp), &
      usual_t("needle_bearing.pin_roughness_um", 0.02_wp, 3.0_wp), &
      usual_t("needle_bearing.pin_modulus_GPa", 20.0_wp, 300.0_wp), &
      usual_t("needle_bearing.pin_roughness_product", 0.01_wp, 0.15_wp), &
      usual_t("needle_bearing.pin_roughness_over_tip_radius", 1.0e-5_wp, 0.1_wp), &
      usual_t("cam_bearings.diameter_mm", 12.0_wp, 120.0_wp), &
      usual_t("cam_bearings.width_mm", 4.0_wp, 80.0_wp), &
      usual_t("cam_bearings.radial_clearance_um", 5.0_wp, 150.0_wp), &
      usual_t("cam_bearings.bearing_positions_mm", -3000.0_wp, 3000.0_wp), &
      usual_t("cam_bearings.cam_positions_mm", -3000.0_wp, 3000.0_wp), &
      usual_t("bearing_asperity.roughness_um", 0.05_wp, 5.0_wp), &
      usual_t("bearing_asperity.modulus_GPa", 20.0_wp, 300.0_wp), &
      usual_t("bearing_asperity.boundary_coefficient", 0.0_wp, 0.5_wp), &
      usual_t("bearing_asperity.roughness_product", 0.01_wp, 0.15_wp), &
      usual_t("bearing_asperity.roughness_over_tip_radius", 1.0e-5_wp, 0.1_wp), &
      usual_t("bearing_heat.heat_capacity_J_kg_K", 1500.0_wp, 2700.0_wp), &
      usual_t("belt_pull.force_N", 0.0_wp, 5000.0_wp), &
      usual_t("belt_pull.position_mm", -3000.0_wp, 3000.0_wp), &
      usual_t("shaft_drag.speed_points_rpm", 0.0_wp, 10000.0_wp), &
      usual_t("shaft_drag.temperature_points_degC", -40.0_wp, 180.0_wp), &
      usual_t("shaft_drag.torque_points_Nm", 0.0_wp, 20.0_wp), &
      usual_t("valve_guide.length_mm", 10.0_wp, 150.0_wp), &
      usual_t("valve_guide.stem_diameter_mm", 3.0_wp, 20.0_wp), &
      usual_t("valve_guide.radial_clearance_um", 3.0_wp, 100.0_wp), &
      usual_t("valve_tip.pad_radius_mm", 3.0_wp, 60.0_wp), &
      usual_t("valve_tip.friction_coefficient", 0.0_wp, 0.3_wp), &
      usual_t("stem_seal.lip_force_N", 0.0_wp, 40.0_wp), &
      usual_t("stem_seal.viscous_drag_N_s_m", 0.0_wp, 100.0_wp), &
      usual_t("guide_side_load.guide_length_mm", 10.0_wp, 150.0_wp), &
      usual_t("guide_side_load.tip_height_mm", 5.0_wp, 100.0_wp), &
      usual_t("guide_side_load.stem_axis_mm", 15.0_wp, 120.0_wp), &
      usual_t("guide_side_load.friction_coefficient", 0.0_wp, 0.3_wp), &
      usual_t("finger_pivot.ball_radius_mm", 2.0_wp, 15.0_wp), &
      usual_t("finger_pivot.friction_coefficient", 0.0_wp, 0.3_wp), &
      ! What friction of joints is measured with: oils from hot to cold, forces from closed valves to racing springs
      usual_t("valve_tip.decay_speed_m_s", 1.0e-3_wp, 10.0_wp), &
      usual_t("valve_tip.reference_viscosity_Pa_s", 1.0e-3_wp, 2.0_wp), &
      usual_t("valve_tip.reference_load_N", 1.0_wp, 5000.0_wp), &
      usual_t("guide_side_load.decay_speed_m_s", 1.0e-3_wp, 10.0_wp), &
      usual_t("guide_side_load.reference_viscosity_Pa_s", 1.0e-3_wp, 2.0_wp), &
      usual_t("guide_side_load.reference_load_N", 1.0_wp, 5000.0_wp), &
      usual_t("finger_pivot.decay_speed_m_s", 1.0e-3_wp, 10.0_wp), &
      usual_t("finger_pivot.reference_viscosity_Pa_s", 1.0e-3_wp, 2.0_wp), &
      usual_t("finger_pivot.reference_load_N", 1.0_wp, 5000.0_wp), &
      usual_t("stem_seal.reference_viscosity_Pa_s", 1.0e-3_wp, 2.0_wp), &
      usual_t("needle_drag.pitch_diameter_mm", 4.0_wp, 50.0_wp), &
      usual_t("needle_drag.viscous_factor", 1.0_wp, 30.0_wp), &
      ! From a moped's cylinder to a truck's engine of six
      usual_t("engine.displacement_cm3", 40.0_wp, 2.0e4_wp), &
      ! A steel finger, its pad and a seat yield by some micrometres under some hundred newtons; stamped fingers and thin valve
      ! heads are the softest, by an order, forged ones of trucks the stiffest
      usual_t("dynamics.finger_stiffness_N_m", 1.0e6_wp, 1.0e9_wp), &
      usual_t("dynamics.pad_stiffness_N_m", 1.0e6_wp, 1.0e9_wp), &
      usual_t("dynamics.seat_stiffness_N_m", 1.0e6_wp, 1.0e9_wp), &
      ! Steel gives back all but a tenth to three quarters of the speed of an impact at some tenths of a metre per second
      usual_t("dynamics.contact_damping_s_m", 0.0_wp, 10.0_wp), &
      usual_t("dynamics.pad_damping_s_m", 0.0_wp, 10.0_wp), &
      usual_t("dynamics.seat_damping_s_m", 0.0_wp, 20.0_wp), &
      usual_t("dynamics.seat_restitution", 0.05_wp, 0.95_wp), &
      usual_t("dynamics.seat_restitution_speed_m_s", 0.02_wp, 3.0_wp), &
      ! Cold clearances are 0.1 to 0.4 mm, of large exhaust valves up to 0.8 mm
      usual_t("dynamics.lash_mm", 0.0_wp, 1.0_wp), &
      ! Wire of 2.5 to 6 mm
      usual_t("spring_surge.mass_kg", 5.0e-3_wp, 0.5_wp), &
      usual_t("spring_surge.damping_ratio", 1.0e-3_wp, 0.1_wp), &
      ! Adjusters of cars have plungers of 8 to 12 mm, those of trucks up to 25 mm, with a selective fit of 2 to 10 um
      usual_t("lash_adjuster.diameter_mm", 4.0_wp, 30.0_wp), &
      usual_t("lash_adjuster.volume_cm3", 0.02_wp, 5.0_wp), &
      usual_t("lash_adjuster.gap_um", 1.0_wp, 25.0_wp), &
      usual_t("lash_adjuster.leak_length_mm", 2.0_wp, 40.0_wp), &
      usual_t("lash_adjuster.plunger_mass_kg", 1.0e-3_wp, 0.2_wp), &
      usual_t("lash_adjuster.plunger_spring_N", 2.0_wp, 150.0_wp), &
      usual_t("lash_adjuster.plunger_stiffness_N_m", 0.0_wp, 2.0e4_wp), &
      ! A ball of 2 to 6 mm that lifts by some tenths of a millimetre
      usual_t("lash_adjuster.check_area_mm2", 0.3_wp, 40.0_wp), &
      usual_t("lash_adjuster.discharge_coefficient", 0.3_wp, 1.0_wp), &
      usual_t("lash_adjuster.crack_pressure_kPa", 0.0_wp, 100.0_wp), &
      usual_t("lash_adjuster.full_pressure_kPa", 0.5_wp, 300.0_wp), &
      usual_t("lash_adjuster.transition_pressure_kPa", 0.005_wp, 20.0_wp), &
      ! Pressure of an oil gallery from idling to the relief valve
      usual_t("lash_adjuster.supply_pressure_MPa", 0.02_wp, 1.0_wp), &
      usual_t("lash_adjuster.air_content", 1.0e-3_wp, 0.2_wp), &
      ! Mineral oil, cold to hot
      usual_t("lash_adjuster.oil_modulus_GPa", 0.8_wp, 2.5_wp), &
      usual_t("lash_adjuster.density_kg_m3", 700.0_wp, 1050.0_wp), &
      usual_t("lash_adjuster.lowest_mm", -10.0_wp, -0.1_wp), &
      usual_t("lash_adjuster.highest_mm", 0.1_wp, 10.0_wp), &
      usual_t("lash_adjuster.stop_stiffness_N_m", 1.0e6_wp, 1.0e9_wp), &
      usual_t("lash_adjuster.stop_damping_s_m", 0.0_wp, 20.0_wp)]

contains

   !> Give keys their usual ranges; the second lift is like the first.
   pure subroutine add_usual_ranges(schema)
      !> Groups and keys
      type(schema_t), intent(inout) :: schema

      type(usual_t) :: range
      integer :: i, point

      do i = 1, size(usual)
         range = usual(i)
         point = index(range%name, ".")
         call add_range(schema, range%name(:point - 1), range%name(point + 1:), range)
         if (range%name(:point) == "lift.") call add_range(schema, "second_lift", range%name(point + 1:), range)
      end do
   end subroutine add_usual_ranges

   !> Give one key its usual range.
   pure subroutine add_range(schema, group, key, range)
      !> Groups and keys
      type(schema_t), intent(inout) :: schema
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> The range
      type(usual_t), intent(in) :: range

      integer :: position

      position = find_key(schema, find_group(schema, group), key)
      schema%keys(position)%usual = range_t(range%smallest, range%largest)
      schema%keys(position)%has_usual = .true.
   end subroutine add_range

end module camroller_usual_values
