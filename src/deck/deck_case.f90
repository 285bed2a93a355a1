!> From settings to a case.
!>
!> In: settings that hold together, and the tables they name. Out: `case_t` in SI. A component whose key has no value keeps the
!> default of its type.
module camroller_deck_case
   use camroller_kinds, only : pi, wp
   use camroller_case, only : case_t
   use camroller_lift, only : lift_t
   use camroller_roller, only : roller_t
   use camroller_table_file, only : table_t
   use camroller_settings, only : settings_t, take, get_word, has_group, is_known
   use camroller_deck_asperity, only : fill_modifier
   use camroller_deck_boundary_law, only : fill_boundary_law
   use camroller_deck_running_in, only : fill_running_in
   use camroller_deck_cam_bearings, only : fill_bearing_parts
   use camroller_deck_engine, only : fill_engine
   use camroller_deck_dynamics, only : fill_dynamics
   use camroller_deck_heat, only : fill_heat
   use camroller_deck_profile, only : fill_profile
   use camroller_deck_roller_bearing, only : fill_roller_bearing
   use camroller_deck_joints, only : fill_joints
   use camroller_deck_mechanism, only : take_mechanism
   use camroller_deck_tables, only : deck_tables_t, get_lift_table, get_pressure_table
   implicit none
   private

   public :: fill_case

contains

   !> Fill a case.
   subroutine fill_case(settings, tables, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Tables that they name
      type(deck_tables_t), intent(in) :: tables
      !> The case
      type(case_t), intent(out) :: case

      case%title = get_word(settings, "case", "title")
      call take(settings, "case", "energy", case%energy)
      call take(settings, "case", "contact_policy", case%contact_policy)
      call take(settings, "operating_point", "speed_rpm", case%operating_point%speed)
      call take(settings, "operating_point", "oil_temperature_degC", case%operating_point%oil_temperature)
      call take_mechanism(settings, case%mechanism)
      call fill_roller(settings, case%roller)
      call fill_lift(settings, "lift", tables%lift, case%lift)
      if (has_group(settings, "second_lift")) then
         allocate (case%second_lift)
         call fill_lift(settings, "second_lift", tables%second_lift, case%second_lift)
      end if
      call fill_loads(settings, tables, case)
      call fill_materials(settings, case)
      call fill_lubricant(settings, case)
      call fill_contact(settings, case)
      call fill_profile(settings, case)
      call fill_heat(settings, case)
      call fill_asperity(settings, case)
      call fill_modifier(settings, case)
      call fill_boundary_law(settings, case)
      call fill_running_in(settings, case)
      call fill_bearings(settings, case)
      call fill_bearing_parts(settings, case)
      call fill_engine(settings, case)
      call fill_joints(settings, case)
      call fill_dynamics(settings, case)
      call fill_numerics(settings, case)
   end subroutine fill_case

   !> Roller, but for its radius, which belongs to the mechanism.
   subroutine fill_roller(settings, roller)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The roller
      type(roller_t), intent(inout) :: roller

      call take(settings, "roller", "mass_kg", roller%mass)
      call take(settings, "roller", "wall_thickness_mm", roller%wall_thickness)
      call take(settings, "roller", "spin", roller%spin)
   end subroutine fill_roller

   !> One lift.
   subroutine fill_lift(settings, group, table, lift)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Name of the lift's group
      character(len=*), intent(in) :: group
      !> Its table
      type(table_t), intent(in) :: table
      !> The lift
      type(lift_t), intent(inout) :: lift

      call take(settings, group, "law", lift%law)
      call take(settings, group, "max_lift_mm", lift%max_lift)
      call take(settings, group, "opening_half_angle_deg", lift%opening_half_angle)
      call take(settings, group, "closing_half_angle_deg", lift%closing_half_angle)
      call take(settings, group, "exponents", lift%exponents)
      call take(settings, group, "segment_angles_deg", lift%segment_angles)
      call take(settings, group, "segment_accelerations", lift%segment_accelerations)
      if (lift%law == "table") call get_lift_table(settings, group, table, lift)
   end subroutine fill_lift

   !> Masses, spring and cylinder pressure.
   subroutine fill_loads(settings, tables, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Tables that they name
      type(deck_tables_t), intent(in) :: tables
      !> The case
      type(case_t), intent(inout) :: case

      ! Diameter of a valve's head [m]
      real(wp) :: diameter

      call take(settings, "masses", "valve_kg", case%masses%valve)
      call take(settings, "masses", "finger_kg", case%masses%finger)
      call take(settings, "masses", "finger_inertia_kg_m2", case%masses%finger_inertia)
      call take(settings, "masses", "finger_centre_mm", case%masses%finger_centre)
      associate (spring => case%spring)
         call take(settings, "spring", "stiffness_N_m", spring%stiffness)
         call take(settings, "spring", "precompression_mm", spring%precompression)
         call take(settings, "spring", "base_circle_load_N", spring%base_circle_load)
         call take(settings, "spring", "seating", spring%seating)
         call take(settings, "spring", "seat_stiffness_N_m", spring%seat_stiffness)
         call take(settings, "spring", "load_arm", spring%load_arm)
      end associate
      if (.not. has_group(settings, "gas_force")) return
      allocate (case%gas_force)
      associate (gas => case%gas_force)
         call get_pressure_table(settings, tables%pressure, gas%angle, gas%pressure)
         diameter = 0.0_wp
         call take(settings, "gas_force", "valve_diameter_mm", diameter)
         gas%valve_area = 0.25_wp*pi*diameter**2
         if (.not. is_known(settings, "gas_force", "second_valve_diameter_mm")) return
         call take(settings, "gas_force", "second_valve_diameter_mm", diameter)
         gas%second_valve_area = 0.25_wp*pi*diameter**2
      end associate
   end subroutine fill_loads

   !> Bodies in contact.
   subroutine fill_materials(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      call take(settings, "materials", "cam_modulus_GPa", case%materials%cam_modulus)
      call take(settings, "materials", "roller_modulus_GPa", case%materials%roller_modulus)
      call take(settings, "materials", "cam_poisson_ratio", case%materials%cam_poisson_ratio)
      call take(settings, "materials", "roller_poisson_ratio", case%materials%roller_poisson_ratio)
      call take(settings, "materials", "hardness_GPa", case%materials%hardness)
      call take(settings, "surface", "cam_roughness_um", case%surface%cam_roughness)
      call take(settings, "surface", "roller_roughness_um", case%surface%roller_roughness)
   end subroutine fill_materials

   !> Oil.
   subroutine fill_lubricant(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      associate (oil => case%lubricant)
         call take(settings, "lubricant", "temperature_law", oil%temperature_law)
         call take(settings, "lubricant", "viscosity_Pa_s", oil%viscosity)
         call take(settings, "lubricant", "temperature_points_degC", oil%temperature_points)
         call take(settings, "lubricant", "viscosity_points_Pa_s", oil%viscosity_points)
         call take(settings, "lubricant", "viscosity_at_40_degC_mm2_s", oil%viscosity_at_40)
         call take(settings, "lubricant", "viscosity_at_100_degC_mm2_s", oil%viscosity_at_100)
         call take(settings, "lubricant", "viscosity_index", oil%viscosity_index)
         call take(settings, "lubricant", "sae_grade", oil%sae_grade)
         call take(settings, "lubricant", "hths_viscosity_mPa_s", oil%hths_viscosity)
         call take(settings, "lubricant", "density_kg_m3", oil%density)
         call take(settings, "lubricant", "thermal_expansion_per_K", oil%thermal_expansion)
         call take(settings, "lubricant", "pressure_law", oil%pressure_law)
         call take(settings, "lubricant", "pressure_viscosity_coefficient_per_GPa", oil%pressure_viscosity)
         call take(settings, "lubricant", "pressure_viscosity_temperatures_degC", oil%pressure_viscosity_temperatures)
         call take(settings, "lubricant", "pressure_viscosity_points_per_GPa", oil%pressure_viscosity_points)
         call take(settings, "lubricant", "roelands_index", oil%roelands_index)
      end associate
   end subroutine fill_lubricant

   !> Film and its friction.
   subroutine fill_contact(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      call take(settings, "film", "law", case%film%law)
      call take(settings, "film", "range_policy", case%film%range_policy)
      if (has_group(settings, "ehl")) then
         allocate (case%ehl)
         call take(settings, "ehl", "accuracy", case%ehl%accuracy)
         call take(settings, "ehl", "compressible", case%ehl%compressible)
         call take(settings, "ehl", "profiles", case%ehl%profiles)
         call take(settings, "ehl", "shear_thinning", case%ehl%shear_thinning)
         call take(settings, "ehl", "flow_factors", case%ehl%flow_factors)
      end if
      call take(settings, "traction", "shear_law", case%traction%shear_law)
      call take(settings, "traction", "eyring_stress_MPa", case%traction%eyring_stress)
      call take(settings, "traction", "sheared_zone", case%traction%sheared_zone)
      call take(settings, "traction", "limit", case%traction%limit)
      call take(settings, "traction", "limiting_coefficient", case%traction%limiting_coefficient)
      call take(settings, "traction", "limiting_stress_MPa", case%traction%limiting_stress)
      call take(settings, "traction", "cap", case%traction%cap)
      call take(settings, "traction", "rolling_law", case%traction%rolling_law)
      call take(settings, "traction", "in_roller_balance", case%traction%in_roller_balance)
   end subroutine fill_contact

   !> Asperities.
   subroutine fill_asperity(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, "asperity")) return
      allocate (case%asperity)
      associate (asperity => case%asperity)
         call take(settings, "asperity", "law", asperity%law)
         call take(settings, "asperity", "roughness_product", asperity%roughness_product)
         call take(settings, "asperity", "roughness_over_tip_radius", asperity%roughness_over_tip_radius)
         call take(settings, "asperity", "boundary_coefficient", asperity%boundary_coefficient)
         call take(settings, "asperity", "film_shear_strength_MPa", asperity%film_shear_strength)
         call take(settings, "asperity", "boundary", asperity%boundary)
         call take(settings, "asperity", "mobilisation", asperity%mobilisation)
         call take(settings, "asperity", "mobilising_speed_m_s", asperity%mobilising_speed)
      end associate
   end subroutine fill_asperity

   !> Roller bearing, camshaft bearings and valve guide.
   subroutine fill_bearings(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      call fill_roller_bearing(settings, case)
      if (has_group(settings, "cam_bearings")) then
         allocate (case%cam_bearings)
         associate (bearings => case%cam_bearings)
            call take(settings, "cam_bearings", "law", bearings%law)
            call take(settings, "cam_bearings", "diameter_mm", bearings%diameter)
            call take(settings, "cam_bearings", "width_mm", bearings%width)
            call take(settings, "cam_bearings", "radial_clearance_um", bearings%radial_clearance)
            call take(settings, "cam_bearings", "bearing_positions_mm", bearings%bearing_positions)
            call take(settings, "cam_bearings", "cam_positions_mm", bearings%cam_positions)
            call take(settings, "cam_bearings", "cam_phases_deg", bearings%cam_phases)
            call take(settings, "cam_bearings", "cam_lobes", bearings%cam_lobes)
            call take(settings, "cam_bearings", "follower_angles_deg", bearings%follower_angles)
            call take(settings, "cam_bearings", "journal_motion", bearings%journal_motion)
            call take(settings, "cam_bearings", "bearing_series", bearings%by_bearing)
         end associate
      end if
      if (has_group(settings, "valve_guide")) then
         allocate (case%valve_guide)
         call take(settings, "valve_guide", "length_mm", case%valve_guide%length)
         call take(settings, "valve_guide", "stem_diameter_mm", case%valve_guide%stem_diameter)
         call take(settings, "valve_guide", "radial_clearance_um", case%valve_guide%radial_clearance)
      end if
   end subroutine fill_bearings

   !> Choice of effects, integration and report.
   subroutine fill_numerics(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      call take(settings, "effects", "select", case%effects%select)
      call take(settings, "effects", "negligible", case%effects%negligible)
      call take(settings, "effects", "quantity", case%effects%quantity)
      call take(settings, "numerics", "accuracy", case%numerics%accuracy)
      call take(settings, "numerics", "method", case%numerics%method)
      call take(settings, "numerics", "tolerance", case%numerics%tolerance)
      call take(settings, "numerics", "step_deg", case%numerics%step)
      call take(settings, "numerics", "periodicity", case%numerics%periodicity)
      call take(settings, "numerics", "max_cycles", case%numerics%max_cycles)
      call take(settings, "output", "angle_step_deg", case%numerics%output_step)
   end subroutine fill_numerics

end module camroller_deck_case
