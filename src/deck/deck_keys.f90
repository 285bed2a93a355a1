!> The table of everything that a deck may hold.
!>
!> In: defaults and names from the types of the sub-models. Out: the schema. A key whose value is not in SI has its unit as its last
!> word. Defaults are those of the types, so that a library user and a deck get the same.
module camroller_deck_keys
   use camroller_kinds, only : wp, pi, degree
   use camroller_units, only : length_unit_names, pressure_unit_names
   use camroller_accuracy, only : largest_accuracy, largest_periodicity, largest_step
   use camroller_case, only : case_t, contact_policy_names, energy_names, method_choices, select_names, quantity_names
   use camroller_lift, only : lift_t, lift_law_names, largest_exponent
   use camroller_kinematics, only : rotation_names
   use camroller_lift_forms, only : table_kind_names
   use camroller_dynamics, only : load_arm_names, seating_names
   use camroller_lubricant, only : temperature_law_names, pressure_law_names
   use camroller_oil_data, only : sae_grade_names
   use camroller_ehl_table, only : ehl_t
   use camroller_film, only : film_law_names, range_policy_names
   use camroller_asperity, only : asperity_t, asperity_law_names, boundary_names, mobilisation_names
   use camroller_traction, only : shear_law_names, zone_names, limit_names, cap_names, rolling_law_names
   use camroller_journal, only : cam_bearings_t, journal_law_names, journal_motion_names
   use camroller_roller, only : spin_names
   use camroller_deck_asperity, only : add_modifier_keys
   use camroller_deck_boundary_law, only : add_boundary_law_keys
   use camroller_deck_running_in, only : add_running_in_keys
   use camroller_deck_cam_bearings, only : add_bearing_part_keys
   use camroller_deck_engine, only : add_engine_keys
   use camroller_deck_sweep_keys, only : add_sweep_keys
   use camroller_deck_dynamics, only : add_dynamics_keys
   use camroller_deck_heat, only : add_heat_keys
   use camroller_deck_profile, only : add_profile_keys
   use camroller_deck_roller_bearing, only : add_roller_bearing_keys
   use camroller_deck_joints, only : add_joint_keys
   use camroller_usual_values, only : add_usual_ranges
   use camroller_output_options, only : output_options_t, compression_names
   use camroller_deck_schema, only : schema_t, add_group, add_number, add_integer, add_logical, add_name, add_text, &
      & add_numbers, add_integers, group_required, group_standard, group_effect, anything, positive, &
      & not_negative, proper_fraction, up_to, from_to, one_or_more, range_t, above_absolute_zero
   implicit none
   private

   public :: new_schema

contains

   !> The schema of all decks.
   subroutine new_schema(schema)
      !> Groups and keys
      type(schema_t), intent(out) :: schema

      type(case_t) :: standard

      call add_case_keys(schema, standard)
      call add_mechanism_keys(schema, standard)
      call add_roller_keys(schema, standard)
      call add_group(schema, "lift", group_required, "valve lift as a function of the cam angle")
      call add_lift_keys(schema, standard%lift)
      call add_group(schema, "second_lift", group_effect, &
         & "lift of the camshaft's second lobe shape, for cams with lobe 2")
      call add_lift_keys(schema, standard%lift)
      call add_load_keys(schema, standard)
      call add_gas_keys(schema)
      call add_material_keys(schema)
      call add_lubricant_keys(schema, standard)
      call add_contact_keys(schema, standard)
      call add_profile_keys(schema)
      call add_heat_keys(schema)
      call add_asperity_keys(schema)
      call add_modifier_keys(schema)
      call add_boundary_law_keys(schema)
      call add_running_in_keys(schema)
      call add_roller_bearing_keys(schema)
      call add_cam_bearing_keys(schema)
      call add_bearing_part_keys(schema)
      call add_engine_keys(schema)
      call add_guide_keys(schema)
      call add_joint_keys(schema)
      call add_dynamics_keys(schema)
      call add_selection_keys(schema, standard)
      call add_numerics_keys(schema, standard)
      call add_output_keys(schema, standard)
      call add_sweep_keys(schema)
      schema%groups = schema%groups(:schema%group_count)
      schema%keys = schema%keys(:schema%key_count)
      call add_usual_ranges(schema)
   end subroutine new_schema

   !> What the run is.
   subroutine add_case_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "case", group_standard, "title and bookkeeping of the case")
      call add_text(schema, "title", "one line that describes the case; legend of its plots", default="untitled")
      call add_name(schema, "energy", energy_names, standard%energy, &
         & "closed balance of forces and losses, or the bookkeeping of Islam (2019)")
      call add_name(schema, "contact_policy", contact_policy_names, standard%contact_policy, &
         & "what to do where cam and roller lose contact: a warning, or an error")
      call add_group(schema, "operating_point", group_required, "speed and temperature")
      call add_number(schema, "speed_rpm", positive, "speed of the camshaft, or with &engine of the crankshaft", &
         & example="600")
      call add_number(schema, "oil_temperature_degC", above_absolute_zero, &
         & "temperature of the oil at the inlet of every contact", example="60")
   end subroutine add_case_keys

   !> Geometry.
   subroutine add_mechanism_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "mechanism", group_required, "dimensions of the end-pivoted finger follower and its cam")
      call add_number(schema, "pivot_to_roller_mm", positive, "distance from the pivot to the roller's centre", &
         & example="20.8")
      call add_number(schema, "pivot_to_pad_mm", positive, &
         & "distance from the pivot to the centre of curvature of the valve pad", example="35.5")
      call add_number(schema, "pivot_to_cam_mm", positive, "distance from the pivot to the cam's centre", &
         & example="31.5")
      call add_number(schema, "roller_arm_angle_deg", from_to(-180.0_wp, 180.0_wp), &
         & "angle from the pad arm to the roller arm", &
         & example="-3.5")
      call add_number(schema, "valve_axis_angle_deg", from_to(-180.0_wp, 180.0_wp), &
         & "angle between the valve's axis and the line from pivot to cam centre", example="37.5")
      call add_number(schema, "adjuster_tilt_deg", from_to(-90.0_wp, 90.0_wp), &
         & "angle from the valve's axis to the lash adjuster's, in the sense of valve_axis_angle_deg; for the force in the "// &
         & "pivot's joint", &
         & default=standard%mechanism%adjuster_tilt)
      call add_number(schema, "base_radius_mm", positive, "radius of the cam's base circle", example="18")
      call add_number(schema, "contact_width_mm", positive, "full length of the line contact", example="13.7")
      call add_number(schema, "grinding_wheel_radius_mm", positive, &
         & "radius of the wheel that must fit hollow flanks; not checked where not given", is_optional=.true.)
      call add_name(schema, "rotation", rotation_names, standard%mechanism%rotation, &
         & "sense in which the cam's surface moves at the contact")
   end subroutine add_mechanism_keys

   !> Roller.
   subroutine add_roller_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "roller", group_required, "roller, a spinning ring")
      call add_number(schema, "radius_mm", positive, "outer radius", example="8.5")
      call add_number(schema, "mass_kg", positive, "mass of the ring", example="0.0088")
      call add_number(schema, "wall_thickness_mm", positive, "thickness of the ring's wall", example="2.4")
      call add_name(schema, "spin", spin_names, standard%roller%spin, &
         & "definition of pure rolling: with the rotation of the contact normal, or as in Islam (2019)")
   end subroutine add_roller_keys

   !> Keys of a lift, for the first and the second lobe shape.
   subroutine add_lift_keys(schema, lift)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Lift with all its defaults
      type(lift_t), intent(in) :: lift

      call add_name(schema, "law", lift_law_names, lift%law, "family of curves, the acceleration in segments, or a table")
      call add_number(schema, "max_lift_mm", positive, "largest lift", example="9.5", &
         & is_optional=.true.)
      call add_number(schema, "opening_half_angle_deg", up_to(180.0_wp), &
         & "cam angle from the start of lift to full lift", example="70", is_optional=.true.)
      call add_number(schema, "closing_half_angle_deg", up_to(180.0_wp), &
         & "cam angle from full lift to the end of lift; as opening_half_angle_deg where not given", is_optional=.true.)
      call add_integers(schema, "exponents", from_to(1.0_wp, real(largest_exponent, wp)), &
         & "'power': n of (1 - x^2)^n, 3 or more; 'polydyne': four exponents of x, increasing, the first one 3 or more; with "// &
         & "more than 200 the lift would bend within less than a 200th of the half angle, to which no cam is ground", &
         & example="4", is_optional=.true.)
      call add_numbers(schema, "segment_angles_deg", from_to(0.0_wp, 360.0_wp), &
         & "cam angles from the start of lift, five or more, 0 first", is_optional=.true.)
      call add_numbers(schema, "segment_accelerations", anything, &
         & "shape of the acceleration at these angles, straight between them, positive, negative, positive; its "// &
         & "size follows from the maximum lift, that of the positive parts from the valve's rest at the end", is_optional=.true.)
      call add_text(schema, "table", "file with two columns, cam angle in degrees and lift; or with a heading that names them "// &
         & "cam_angle and valve_lift, or polar_angle and cam_radius, as the table of 'check --cam' does; "// &
         & "its path starts at the deck's folder", is_optional=.true.)
      call add_name(schema, "table_kind", table_kind_names, table_kind_names(1), "what the table holds: lift of the valve, or "// &
         & "how far the roller's centre moves away from the cam's, or the cam's radius over its polar angle, which increases "// &
         & "in the order in which points pass the roller")
      call add_name(schema, "table_unit", length_unit_names, length_unit_names(1), "unit of the lift in the table")
      call add_number(schema, "table_nose_angle_deg", from_to(-360.0_wp, 360.0_wp), &
         & "cam angle in the table at which the cam's nose is at the roller", default=pi)
      call add_number(schema, "smoothing_um", not_negative, &
         & "root mean square distance allowed between a smoothed curve and the table; 0 goes through every point", &
         & default=lift%smoothing)
   end subroutine add_lift_keys

   !> Masses and spring.
   subroutine add_load_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "masses", group_required, "moving masses")
      call add_number(schema, "valve_kg", not_negative, &
         & "everything that moves with the valve: valve, retainer, a third of the spring", example="0.0432")
      call add_number(schema, "finger_kg", not_negative, &
         & "mass of the finger with its roller; for the force in the pivot's joint, and placed at the pad for the inertia "// &
         & "where that is not given", example="0.0418", is_optional=.true.)
      call add_number(schema, "finger_inertia_kg_m2", positive, &
         & "moment of inertia of the finger about its pivot; where not given that of its mass at the pad", is_optional=.true.)
      call add_number(schema, "finger_centre_mm", positive, &
         & "distance from the pivot to the finger's centre of mass, on the roller arm; where not given 20, an "// &
         & "assumption, or the radius of gyration if that is less; acts on the force in the pivot", is_optional=.true.)
      call add_group(schema, "spring", group_required, "valve spring, seat and lash adjuster")
      call add_number(schema, "stiffness_N_m", positive, "stiffness of the valve spring", example="25000")
      call add_number(schema, "precompression_mm", not_negative, "compression of the spring with the valve closed", &
         & example="8.4")
      call add_number(schema, "base_circle_load_N", not_negative, &
         & "contact load on the base circle, from the lash adjuster; needed unless lash_adjuster.plunger_spring_N makes it", &
         & example="64", is_optional=.true.)
      call add_name(schema, "seating", seating_names, standard%spring%seating, &
         & "transition of the load from base circle to event: by the stiffness of train and seat, or the larger of both loads")
      call add_number(schema, "seat_stiffness_N_m", positive, &
         & "stiffness of train and seat seen at the valve; 'continuous'", &
         & default=standard%spring%seat_stiffness)
      call add_name(schema, "load_arm", load_arm_names, standard%spring%load_arm, &
         & "arm of the contact's normal about the pivot: exact, or with the normal parallel to the valve's axis")
   end subroutine add_load_keys

   !> Cylinder pressure.
   subroutine add_gas_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      call add_group(schema, "gas_force", group_effect, "cylinder pressure on the valve")
      call add_text(schema, "table", &
         & "file with two columns, cam angle in degrees and gauge pressure that presses the valve "// &
         & "shut, over one turn of the camshaft; its path starts at the deck's folder", &
         & example="tables/cylinder_pressure.txt")
      call add_name(schema, "pressure_unit", pressure_unit_names, pressure_unit_names(1), &
         & "unit of the pressure in the table")
      call add_number(schema, "table_nose_angle_deg", from_to(-360.0_wp, 360.0_wp), &
         & "cam angle in the table at which the cam's nose is at the roller; with &engine that of the first lobe shape: valves "// &
         & "of the second one feel the same pressure at the same crank angle, by full_lift_deg", default=pi)
      call add_number(schema, "valve_diameter_mm", positive, "diameter of the valve's head", example="30")
      call add_number(schema, "second_valve_diameter_mm", positive, &
         & "the same of a valve that the second lobe shape lifts; as valve_diameter_mm where not given", is_optional=.true.)
   end subroutine add_gas_keys

   !> Bodies in contact.
   subroutine add_material_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      call add_group(schema, "materials", group_required, "elasticity of cam and roller")
      call add_number(schema, "cam_modulus_GPa", positive, "Young's modulus of the cam", example="170")
      call add_number(schema, "roller_modulus_GPa", positive, "Young's modulus of the roller", example="204")
      call add_number(schema, "cam_poisson_ratio", range_t(0.0_wp, 0.5_wp), "Poisson's ratio of the cam", &
         & example="0.28")
      call add_number(schema, "roller_poisson_ratio", range_t(0.0_wp, 0.5_wp), "Poisson's ratio of the roller", &
         & example="0.29")
      call add_number(schema, "hardness_GPa", positive, &
         & "hardness of the softer body; for film 'masjedi_khonsari_rough', asperities 'zhao_maietta_chang', a remark on yield", &
         & is_optional=.true.)
      call add_group(schema, "surface", group_required, "roughness of cam and roller")
      call add_number(schema, "cam_roughness_um", not_negative, "root mean square roughness of the cam", example="0.1")
      call add_number(schema, "roller_roughness_um", not_negative, "root mean square roughness of the roller", &
         & example="0.1")
   end subroutine add_material_keys

   !> Oil.
   subroutine add_lubricant_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "lubricant", group_required, "oil")
      call add_name(schema, "temperature_law", temperature_law_names, standard%lubricant%temperature_law, &
         & "viscosity as a function of temperature: given directly, by a law through given points, or as on the oil's data sheet")
      call add_number(schema, "viscosity_Pa_s", positive, "dynamic viscosity at the oil temperature", &
         & example="0.0305", is_optional=.true.)
      call add_numbers(schema, "temperature_points_degC", above_absolute_zero, &
         & "temperatures of the given points, increasing; 'vogel' three, 'walther' two", is_optional=.true.)
      call add_numbers(schema, "viscosity_points_Pa_s", positive, "dynamic viscosities of the given points, falling", &
         & is_optional=.true.)
      call add_number(schema, "viscosity_at_40_degC_mm2_s", positive, "kinematic viscosity at 40 degC", &
         & is_optional=.true.)
      call add_number(schema, "viscosity_at_100_degC_mm2_s", positive, "kinematic viscosity at 100 degC", &
         & is_optional=.true.)
      call add_number(schema, "viscosity_index", up_to(400.0_wp), &
         & "viscosity index, in the place of the viscosity at 40 degC", is_optional=.true.)
      call add_name(schema, "sae_grade", sae_grade_names, standard%lubricant%sae_grade, &
         & "in the place of viscosities: at 100 degC the middle of the grade's range in SAE J300, and a viscosity index "// &
         & "that is usual for it")
      call add_number(schema, "hths_viscosity_mPa_s", positive, &
         & "dynamic viscosity at 150 degC and 1e6 1/s (HTHS), compared with the law of viscosity; no result follows from it", &
         & is_optional=.true.)
      call add_number(schema, "density_kg_m3", positive, "density at 15 degC", &
         & default=standard%lubricant%density)
      call add_number(schema, "thermal_expansion_per_K", not_negative, "thermal expansion of the density", &
         & default=standard%lubricant%thermal_expansion)
      call add_name(schema, "pressure_law", pressure_law_names, standard%lubricant%pressure_law, &
         & "viscosity as a function of pressure")
      call add_number(schema, "pressure_viscosity_coefficient_per_GPa", positive, &
         & "pressure-viscosity coefficient at ambient pressure; where not given from roelands_index, or without that, with "// &
         & "'walther' and 'data_sheet', estimated by So and Klaus (1980)", example="22", &
         & is_optional=.true.)
      call add_numbers(schema, "pressure_viscosity_temperatures_degC", above_absolute_zero, &
         & "temperatures of the pressure-viscosity coefficients given as points, increasing, two or more", is_optional=.true.)
      call add_numbers(schema, "pressure_viscosity_points_per_GPa", positive, &
         & "pressure-viscosity coefficients at these temperatures, not rising, in the place of one coefficient; between and "// &
         & "beyond them the logarithm is a straight line", is_optional=.true.)
      call add_number(schema, "roelands_index", positive, &
         & "Roelands' index Z; from the pressure-viscosity coefficient where not given", is_optional=.true.)
   end subroutine add_lubricant_keys

   !> Film and its friction.
   subroutine add_contact_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "film", group_standard, "film thickness")
      call add_name(schema, "law", film_law_names, standard%film%law, "film-thickness law")
      call add_name(schema, "range_policy", range_policy_names, standard%film%range_policy, &
         & "what to do where a law is used outside its published range")
      call add_ehl_keys(schema)
      call add_group(schema, "traction", group_standard, "friction of the film")
      call add_name(schema, "shear_law", shear_law_names, standard%traction%shear_law, "shear of the film")
      call add_number(schema, "eyring_stress_MPa", positive, "Eyring stress of the oil", is_optional=.true.)
      call add_name(schema, "sheared_zone", zone_names, standard%traction%sheared_zone, "strip of the film that is sheared: "// &
         & "that of the dry contact, or one for nearly rigid contacts as well")
      call add_name(schema, "limit", limit_names, standard%traction%limit, &
         & "what is limited: the traction of all of the film, limiting_coefficient times the load, or the stress at each point")
      call add_number(schema, "limiting_coefficient", positive, &
         & "limiting traction coefficient of the film; limit 'local': rise of the limiting stress with the pressure", &
         & default=standard%traction%limiting_coefficient)
      call add_number(schema, "limiting_stress_MPa", not_negative, &
         & "limiting stress without pressure, 0 where not given", is_optional=.true.)
      call add_name(schema, "cap", cap_names, standard%traction%cap, "how the limiting traction is approached")
      call add_name(schema, "rolling_law", rolling_law_names, standard%traction%rolling_law, "rolling resistance")
      call add_logical(schema, "in_roller_balance", standard%traction%in_roller_balance, &
         & "does rolling resistance act on the roller's spin?")
   end subroutine add_contact_keys

   !> Numerical film.
   subroutine add_ehl_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(ehl_t) :: standard

      call add_group(schema, "ehl", group_effect, "film by numerical solution of the contact, in place of the film law")
      call add_number(schema, "accuracy", proper_fraction, "largest relative error of the film; "// &
         & "with 'camroller ehl' the largest difference of films and mean slip between the last two grids", &
         & default=standard%accuracy)
      call add_logical(schema, "compressible", standard%compressible, &
         & "does the density of the oil grow with the pressure?")
      call add_logical(schema, "profiles", standard%profiles, &
         & "are pressure, film and friction across the contact written too, in /ehl? By 'sweep' for the cases of sweep.series")
      call add_logical(schema, "shear_thinning", standard%shear_thinning, &
         & "whether sliding thins the oil that pressure drives, where the shear law is 'eyring'; shear follows that law either way")
      call add_logical(schema, "flow_factors", standard%flow_factors, &
         & "whether roughness hinders the flow, by Patir and Cheng")
   end subroutine add_ehl_keys

   !> Asperities.
   subroutine add_asperity_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(asperity_t) :: standard

      call add_group(schema, "asperity", group_effect, "asperities that share the load, and boundary friction")
      call add_name(schema, "law", asperity_law_names, standard%law, &
         & "elastic asperities of both surfaces, asperities of one that yield, which need materials.hardness_GPa, or the "// &
         & "regression that goes with film law 'masjedi_khonsari_rough'")
      call add_number(schema, "roughness_product", positive, "asperity density times tip radius times roughness", &
         & default=standard%roughness_product)
      call add_number(schema, "roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
         & default=standard%roughness_over_tip_radius)
      call add_number(schema, "boundary_coefficient", not_negative, "friction coefficient of touching asperities", &
         & is_optional=.true., example="0.2")
      call add_number(schema, "film_shear_strength_MPa", not_negative, &
         & "shear strength of the surface film on the real contact area", default=standard%film_shear_strength)
      call add_name(schema, "boundary", boundary_names, standard%boundary, &
         & "boundary friction that counts as a loss: the part mobilised by slip, or all of it")
      call add_name(schema, "mobilisation", mobilisation_names, standard%mobilisation, &
         & "boundary friction as a function of slip: it grows with the sliding speed, or the roller sticks and slides")
      call add_number(schema, "mobilising_speed_m_s", positive, "sliding speed that mobilises regularised boundary friction", &
         & default=standard%mobilising_speed)
   end subroutine add_asperity_keys

   !> Camshaft bearings.
   subroutine add_cam_bearing_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(cam_bearings_t) :: standard

      call add_group(schema, "cam_bearings", group_effect, "camshaft, its bearings and its cams")
      call add_name(schema, "law", journal_law_names, standard%law, &
         & "journal bearing law, by width over diameter: 'finite' from 0.1 to 1, as most camshafts have it; 'short_ocvirk' up "// &
         & "to 0.5; 'long_full_sommerfeld' from 2 on")
      call add_name(schema, "journal_motion", journal_motion_names, standard%journal_motion, &
         & "is a journal at each instant where a steady load would hold it, or on its orbit over the turn?")
      call add_number(schema, "diameter_mm", positive, "diameter of the journals", example="23")
      call add_number(schema, "width_mm", positive, "width of a bearing", example="20")
      call add_number(schema, "radial_clearance_um", positive, "radial clearance", example="47.5")
      call add_numbers(schema, "bearing_positions_mm", anything, "places of the bearings along the shaft, increasing", &
         & example="0, 60")
      call add_numbers(schema, "cam_positions_mm", anything, &
         & "places of the cams, between the first and the last bearing", &
         & example="30")
      call add_numbers(schema, "cam_phases_deg", from_to(-360.0_wp, 360.0_wp), &
         & "angle by which each cam's event follows the first cam's, so that the first is 0; 0 for every cam where not given", &
         & is_optional=.true.)
      call add_integers(schema, "cam_lobes", from_to(1.0_wp, 2.0_wp), &
         & "lobe shape of each cam: 1 is &lift, 2 is &second_lift; 1 for every cam where not given", is_optional=.true.)
      call add_integers(schema, "cam_cylinders", one_or_more, "cylinder of each cam", is_optional=.true.)
      call add_numbers(schema, "follower_angles_deg", from_to(-360.0_wp, 360.0_wp), &
         & "angle of each cam's follower about the shaft, from the first one's, which is 0; positive the way a finger turns as "// &
         & "it opens its valve; 0 for every cam where not given", &
         & is_optional=.true.)
      call add_logical(schema, "bearing_series", standard%by_bearing, &
         & "are there series of each bearing: load, eccentricity, smallest film, friction?")
   end subroutine add_cam_bearing_keys

   !> Valve guide.
   subroutine add_guide_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      call add_group(schema, "valve_guide", group_effect, "valve stem in its guide")
      call add_number(schema, "length_mm", positive, "length of the guide", example="36")
      call add_number(schema, "stem_diameter_mm", positive, "diameter of the valve stem", example="5")
      call add_number(schema, "radial_clearance_um", positive, "radial clearance", example="20")
   end subroutine add_guide_keys

   !> Choice of effects.
   subroutine add_selection_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "effects", group_standard, "which effects of the deck are computed")
      call add_name(schema, "select", select_names, standard%effects%select, &
         & "all effects of the deck, or only those that a survey of the cycle estimates to be needed")
      call add_number(schema, "negligible", range_t(0.0_wp, 0.1_wp), &
         & "largest relative change of the quantity by all effects left out together", default=standard%effects%negligible)
      call add_name(schema, "quantity", quantity_names, standard%effects%quantity, &
         & "quantity that decides: mean torque for all losses, smallest film, or slip per revolution")
   end subroutine add_selection_keys

   !> Integration.
   subroutine add_numerics_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      call add_group(schema, "numerics", group_standard, "how the roller's spin is integrated")
      call add_number(schema, "accuracy", range_t(1.0e-10_wp, largest_accuracy), &
         & "largest error of the sliding speed relative to its largest value (at least 1e-5 of the largest speed in pure "// &
         & "rolling), of each mean relative to its mean magnitude, of smallest and largest values relative to their range", &
         & default=standard%numerics%accuracy)
      call add_name(schema, "method", method_choices, standard%numerics%method, "integration method; 'automatic' takes "// &
         & "the one with the least work")
      call add_number(schema, "tolerance", range_t(1.0e-13_wp, largest_accuracy), &
         & "in place of accuracy: error of a step relative to the largest sliding speed; the result's error is not controlled", &
         & is_optional=.true.)
      call add_number(schema, "step_deg", up_to(largest_step/degree), "cam angle of a step", &
         & default=standard%numerics%step)
      call add_number(schema, "periodicity", up_to(largest_periodicity), &
         & "largest difference of the sliding speed between start and "// &
         & "end of the reported cycle, relative to its largest value; a tenth of 'tolerance' suffices, with 'accuracy' it is "// &
         & "0.01 of that", &
         & default=standard%numerics%periodicity)
      call add_integer(schema, "max_cycles", one_or_more, &
         & "largest number of cycles integrated until the cycle is periodic; a case that is not periodic then fails; "// &
         & "with &dynamics at least 40, after which it does not fail", &
         & default=standard%numerics%max_cycles)
   end subroutine add_numerics_keys

   !> Result file.
   subroutine add_output_keys(schema, standard)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Case with all its defaults
      type(case_t), intent(in) :: standard

      type(output_options_t) :: options

      call add_group(schema, "output", group_standard, "contents of the result file")
      call add_number(schema, "angle_step_deg", up_to(largest_step/degree), &
         & "cam angle between output points; 360 is a whole multiple of it", default=standard%numerics%output_step)
      call add_logical(schema, "series", options%series, "are the series over the cam angle written, or the summary alone? "// &
         & "'camroller sweep' goes by sweep.series")
      call add_name(schema, "compression", compression_names, options%compression, &
         & "whether series are compressed; 'auto' compresses large files")
   end subroutine add_output_keys

end module camroller_deck_keys
