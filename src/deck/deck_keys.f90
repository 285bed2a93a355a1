!> Everything that a deck may hold, and what of a case it gives.
!>
!> In: defaults and names from the types of the sub-models, settings. Out: the schema; a case, but for what is no plain key. A key
!> whose value is not in SI has its unit as its last word. Defaults are those of the types, so that a library user and a deck get
!> the same.
module camroller_deck_keys
   use camroller_error, only : error_t, kind_deck, raise
   use camroller_kinds, only : wp, pi, degree
   use camroller_units, only : length_unit_names, pressure_unit_names
   use camroller_accuracy, only : largest_accuracy, largest_periodicity, largest_step
   use camroller_case, only : case_t, numerics_t, contact_policy_names, energy_names, method_choices, select_names, &
      & quantity_names
   use camroller_lift, only : lift_t, lift_law_names, largest_exponent
   use camroller_lift_forms, only : table_kind_names
   use camroller_dynamics, only : load_arm_names, seating_names
   use camroller_lubricant, only : lubricant_t, temperature_law_names, pressure_law_names
   use camroller_oil_data, only : sae_grade_names
   use camroller_film, only : film_law_names, range_policy_names
   use camroller_traction, only : traction_t, shear_law_names, zone_names, limit_names, cap_names, rolling_law_names
   use camroller_deck_asperity, only : bind_asperity, bind_modifier
   use camroller_deck_boundary_law, only : bind_boundary_law
   use camroller_deck_running_in, only : bind_running_in
   use camroller_deck_cam_bearings, only : bind_cam_bearings
   use camroller_deck_engine, only : bind_engine
   use camroller_deck_sweep_keys, only : add_sweep_keys
   use camroller_deck_dynamics, only : bind_dynamics
   use camroller_deck_heat, only : bind_heat
   use camroller_deck_profile, only : bind_profile
   use camroller_deck_roller_bearing, only : bind_roller_bearing
   use camroller_deck_mechanism, only : bind_mechanism, bind_roller
   use camroller_deck_joints, only : bind_joints
   use camroller_output_options, only : output_options_t, compression_names
   use camroller_deck_binder, only : declared_in, judged_in, keys_t, taken_from
   use camroller_settings, only : settings_t
   use camroller_deck_schema, only : schema_t, group_effect, group_required, group_standard, anything, positive, not_negative, &
      & proper_fraction, up_to, from_to, one_or_more, range_t, above_absolute_zero
   implicit none
   private

   public :: new_schema, bind_case, check_case, take_output_options

contains

   !> The schema of all decks.
   subroutine new_schema(schema)
      !> Groups and keys
      type(schema_t), intent(out), target :: schema

      type(keys_t) :: keys
      type(case_t) :: standard

      keys = declared_in(schema)
      call bind_case(keys, standard)
      call add_sweep_keys(schema)
      schema%groups = schema%groups(:schema%group_count)
      schema%keys = schema%keys(:schema%key_count)
   end subroutine new_schema

   !> Check a case that was made of components: each number against the range that a deck's key has for it. What ties keys to each
   !> other is checked by runs and simulations.
   subroutine check_case(case, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Deck error with a line for each number that is outside of its range
      type(error_t), allocatable, intent(out) :: error

      type(schema_t), target :: schema
      type(keys_t) :: keys
      type(case_t) :: copy
      character(len=:), allocatable :: faults

      copy = case
      keys = judged_in(schema)
      call bind_case(keys, copy)
      call keys%found_faults(faults)
      if (faults /= "") call raise(error, kind_deck, faults)
   end subroutine check_case

   !> All groups but &sweep, in the order of a deck: declared with the defaults of a case, taken for it, or judged.
   subroutine bind_case(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case, with its defaults
      type(case_t), intent(inout) :: case

      type(output_options_t) :: options

      call bind_run(keys, case)
      call bind_mechanism(keys, case%mechanism)
      call bind_roller(keys, case%mechanism, case%roller)
      call keys%group("lift", group_required, "valve lift as a function of the cam angle")
      call bind_lift(keys, case%lift)
      call keys%group("second_lift", group_effect, "lift of the camshaft's second lobe shape, for cams with lobe 2")
      if (keys%are_wanted(allocated(case%second_lift))) then
         if (.not. allocated(case%second_lift)) allocate (case%second_lift)
         call bind_lift(keys, case%second_lift)
      end if
      call bind_loads(keys, case)
      call bind_gas(keys, case)
      call bind_materials(keys, case)
      call bind_lubricant(keys, case%lubricant)
      call bind_film(keys, case)
      call bind_traction(keys, case%traction)
      call bind_profile(keys, case)
      call bind_heat(keys, case)
      call bind_asperity(keys, case)
      call bind_modifier(keys, case)
      call bind_boundary_law(keys, case)
      call bind_running_in(keys, case)
      call bind_roller_bearing(keys, case)
      call bind_cam_bearings(keys, case)
      call bind_engine(keys, case)
      call bind_joints(keys, case)
      call bind_dynamics(keys, case)
      call bind_numerics(keys, case)
      call bind_output(keys, case%numerics, options)
   end subroutine bind_case

   !> What the run is.
   subroutine bind_run(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("case", group_standard, "title and bookkeeping of the case")
      case%title = "untitled"
      call keys%text("title", "one line that describes the case; legend of its plots", case%title)
      call keys%choice("energy", energy_names, "closed balance of forces and losses, or the bookkeeping of Islam (2019)", &
         & case%energy)
      call keys%choice("contact_policy", contact_policy_names, &
         & "what to do where cam and roller lose contact: a warning, or an error", case%contact_policy)
      call keys%group("operating_point", group_required, "speed and temperature")
      call keys%number("speed_rpm", positive, "speed of the camshaft, or with &engine of the crankshaft", &
         & case%operating_point%speed, example="600", usual=[50.0_wp, 6000.0_wp])
      call keys%number("oil_temperature_degC", above_absolute_zero, "temperature of the oil at the inlet of every contact", &
         & case%operating_point%oil_temperature, example="60", usual=[-40.0_wp, 180.0_wp])
   end subroutine bind_run

   !> Keys of a lift, of the first and of the second lobe shape.
   subroutine bind_lift(keys, lift)
      type(keys_t), intent(inout) :: keys
      type(lift_t), intent(inout) :: lift

      ! Place of the nose in a table [rad]
      real(wp) :: nose

      call keys%choice("law", lift_law_names, "family of curves, the acceleration in segments, or a table", lift%law)
      call keys%number("max_lift_mm", positive, "largest lift", lift%max_lift, example="9.5", is_optional=.true., &
         & usual=[1.0_wp, 25.0_wp])
      call keys%number("opening_half_angle_deg", up_to(180.0_wp), "cam angle from the start of lift to full lift", &
         & lift%opening_half_angle, example="70", is_optional=.true., usual=[35.0_wp, 110.0_wp])
      call keys%number("closing_half_angle_deg", up_to(180.0_wp), &
         & "cam angle from full lift to the end of lift; as opening_half_angle_deg where not given", lift%closing_half_angle, &
         & is_optional=.true., usual=[35.0_wp, 110.0_wp])
      call keys%whole_numbers("exponents", from_to(1.0_wp, real(largest_exponent, wp)), "'power': n of (1 - x^2)^n, 3 or more; "// &
         & "'polydyne': four exponents of x, increasing, the first one 3 or more; with more than 200 the lift would bend "// &
         & "within less than a 200th of the half angle, to which no cam is ground", lift%exponents, example="4", &
         & is_optional=.true.)
      call keys%numbers("segment_angles_deg", from_to(0.0_wp, 360.0_wp), &
         & "cam angles from the start of lift, five or more, 0 first", lift%segment_angles, is_optional=.true.)
      call keys%numbers("segment_accelerations", anything, "shape of the acceleration at these angles, straight between them, "// &
         & "positive, negative, positive; its size follows from the maximum lift, that of the positive parts from the valve's "// &
         & "rest at the end", lift%segment_accelerations, is_optional=.true.)
      ! A table is read by other means, with the keys that say what it holds
      nose = pi
      call keys%text("table", "file with two columns, cam angle in degrees and lift; or with a heading that names them "// &
         & "cam_angle and valve_lift, or polar_angle and cam_radius, as the table of 'check --cam' does; its path starts at "// &
         & "the deck's folder", is_optional=.true.)
      call keys%choice("table_kind", table_kind_names, "what the table holds: lift of the valve, or how far the roller's "// &
         & "centre moves away from the cam's, or the cam's radius over its polar angle, which increases in the order in which "// &
         & "points pass the roller")
      call keys%choice("table_unit", length_unit_names, "unit of the lift in the table")
      call keys%number("table_nose_angle_deg", from_to(-360.0_wp, 360.0_wp), &
         & "cam angle in the table at which the cam's nose is at the roller", nose)
      call keys%number("smoothing_um", not_negative, "root mean square distance allowed between a smoothed curve and the "// &
         & "table; 0 goes through every point", lift%smoothing, usual=[0.0_wp, 20.0_wp])
   end subroutine bind_lift

   !> Masses and spring.
   subroutine bind_loads(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("masses", group_required, "moving masses")
      call keys%number("valve_kg", not_negative, "everything that moves with the valve: valve, retainer, a third of the spring", &
         & case%masses%valve, example="0.0432", usual=[0.01_wp, 1.0_wp])
      call keys%number("finger_kg", not_negative, "mass of the finger with its roller; for the force in the pivot's joint, and "// &
         & "placed at the pad for the inertia where that is not given", case%masses%finger, example="0.0418", is_optional=.true., &
         & usual=[0.005_wp, 1.0_wp])
      call keys%number("finger_inertia_kg_m2", positive, "moment of inertia of the finger about its pivot; where not given "// &
         & "that of its mass at the pad", case%masses%finger_inertia, is_optional=.true., usual=[1.0e-6_wp, 5.0e-3_wp])
      call keys%number("finger_centre_mm", positive, "distance from the pivot to the finger's centre of mass, on the roller "// &
         & "arm; where not given 20, an assumption, or the radius of gyration if that is less; acts on the force in the pivot", &
         & case%masses%finger_centre, is_optional=.true., usual=[1.0_wp, 60.0_wp])
      call keys%group("spring", group_required, "valve spring, seat and lash adjuster")
      associate (spring => case%spring)
         call keys%number("stiffness_N_m", positive, "stiffness of the valve spring", spring%stiffness, example="25000", &
            & usual=[2000.0_wp, 2.0e5_wp])
         call keys%number("precompression_mm", not_negative, "compression of the spring with the valve closed", &
            & spring%precompression, example="8.4", usual=[1.0_wp, 40.0_wp])
         call keys%number("base_circle_load_N", not_negative, &
            & "contact load on the base circle, from the lash adjuster; needed unless lash_adjuster.plunger_spring_N makes it", &
            & spring%base_circle_load, example="64", is_optional=.true., usual=[0.0_wp, 400.0_wp])
         call keys%choice("seating", seating_names, "transition of the load from base circle to event: by the stiffness of "// &
            & "train and seat, or the larger of both loads", spring%seating)
         call keys%number("seat_stiffness_N_m", positive, "stiffness of train and seat seen at the valve; 'continuous'", &
            & spring%seat_stiffness, usual=[1.0e5_wp, 1.0e9_wp])
         call keys%choice("load_arm", load_arm_names, "arm of the contact's normal about the pivot: exact, or with the normal "// &
            & "parallel to the valve's axis", spring%load_arm)
      end associate
   end subroutine bind_loads

   !> Cylinder pressure.
   subroutine bind_gas(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      ! Place of the nose in the table [rad]; diameters of the heads of valves [m]
      real(wp) :: nose, diameter, second_diameter

      call keys%group("gas_force", group_effect, "cylinder pressure on the valve")
      if (.not. keys%are_wanted(allocated(case%gas_force))) return
      if (.not. allocated(case%gas_force)) allocate (case%gas_force)
      ! The table is read by other means, with the keys that say what it holds
      nose = pi
      diameter = sqrt(4.0_wp/pi*max(case%gas_force%valve_area, 0.0_wp))
      second_diameter = 0.0_wp
      if (allocated(case%gas_force%second_valve_area)) second_diameter = sqrt(4.0_wp/pi* &
         & max(case%gas_force%second_valve_area, 0.0_wp))
      call keys%text("table", "file with two columns, cam angle in degrees and gauge pressure that presses the valve shut, "// &
         & "over one turn of the camshaft; its path starts at the deck's folder", example="tables/cylinder_pressure.txt")
      call keys%choice("pressure_unit", pressure_unit_names, "unit of the pressure in the table")
      call keys%number("table_nose_angle_deg", from_to(-360.0_wp, 360.0_wp), "cam angle in the table at which the cam's nose "// &
         & "is at the roller; with &engine that of the first lobe shape: valves of the second one feel the same pressure at "// &
         & "the same crank angle, by full_lift_deg", nose)
      call keys%number("valve_diameter_mm", positive, "diameter of the valve's head", diameter, example="30", &
         & usual=[10.0_wp, 80.0_wp])
      call keys%number("second_valve_diameter_mm", positive, &
         & "the same of a valve that the second lobe shape lifts; as valve_diameter_mm where not given", second_diameter, &
         & is_optional=.true., usual=[10.0_wp, 80.0_wp])
      case%gas_force%valve_area = 0.25_wp*pi*diameter**2
      if (second_diameter > 0.0_wp) case%gas_force%second_valve_area = 0.25_wp*pi*second_diameter**2
   end subroutine bind_gas

   !> Bodies in contact.
   subroutine bind_materials(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("materials", group_required, "elasticity of cam and roller")
      call keys%number("cam_modulus_GPa", positive, "Young's modulus of the cam", case%materials%cam_modulus, example="170", &
         & usual=[60.0_wp, 450.0_wp])
      call keys%number("roller_modulus_GPa", positive, "Young's modulus of the roller", case%materials%roller_modulus, &
         & example="204", usual=[60.0_wp, 450.0_wp])
      call keys%number("cam_poisson_ratio", range_t(0.0_wp, 0.5_wp), "Poisson's ratio of the cam", &
         & case%materials%cam_poisson_ratio, example="0.28", usual=[0.15_wp, 0.4_wp])
      call keys%number("roller_poisson_ratio", range_t(0.0_wp, 0.5_wp), "Poisson's ratio of the roller", &
         & case%materials%roller_poisson_ratio, example="0.29", usual=[0.15_wp, 0.4_wp])
      call keys%number("hardness_GPa", positive, "hardness of the softer body; for film 'masjedi_khonsari_rough', asperities "// &
         & "'zhao_maietta_chang', a remark on yield", case%materials%hardness, is_optional=.true., usual=[0.5_wp, 25.0_wp])
      call keys%group("surface", group_required, "roughness of cam and roller")
      call keys%number("cam_roughness_um", not_negative, "root mean square roughness of the cam", case%surface%cam_roughness, &
         & example="0.1", usual=[0.0_wp, 3.0_wp])
      call keys%number("roller_roughness_um", not_negative, "root mean square roughness of the roller", &
         & case%surface%roller_roughness, example="0.1", usual=[0.0_wp, 3.0_wp])
   end subroutine bind_materials

   !> Oil.
   subroutine bind_lubricant(keys, oil)
      type(keys_t), intent(inout) :: keys
      type(lubricant_t), intent(inout) :: oil

      call keys%group("lubricant", group_required, "oil")
      call keys%choice("temperature_law", temperature_law_names, "viscosity as a function of temperature: given directly, by a "// &
         & "law through given points, or as on the oil's data sheet", oil%temperature_law)
      call keys%number("viscosity_Pa_s", positive, "dynamic viscosity at the oil temperature", oil%viscosity, example="0.0305", &
         & is_optional=.true., usual=[1.0e-3_wp, 20.0_wp])
      call keys%numbers("temperature_points_degC", above_absolute_zero, &
         & "temperatures of the given points, increasing; 'vogel' three, 'walther' two", oil%temperature_points, &
         & is_optional=.true., usual=[-40.0_wp, 200.0_wp])
      call keys%numbers("viscosity_points_Pa_s", positive, "dynamic viscosities of the given points, falling", &
         & oil%viscosity_points, is_optional=.true., usual=[5.0e-4_wp, 20.0_wp])
      call keys%number("viscosity_at_40_degC_mm2_s", positive, "kinematic viscosity at 40 degC", oil%viscosity_at_40, &
         & is_optional=.true., usual=[10.0_wp, 500.0_wp])
      call keys%number("viscosity_at_100_degC_mm2_s", positive, "kinematic viscosity at 100 degC", oil%viscosity_at_100, &
         & is_optional=.true., usual=[2.0_wp, 40.0_wp])
      call keys%number("viscosity_index", up_to(400.0_wp), "viscosity index, in the place of the viscosity at 40 degC", &
         & oil%viscosity_index, is_optional=.true., usual=[50.0_wp, 250.0_wp])
      call keys%choice("sae_grade", sae_grade_names, "in the place of viscosities: at 100 degC the middle of the grade's range "// &
         & "in SAE J300, and a viscosity index that is usual for it", oil%sae_grade)
      call keys%number("hths_viscosity_mPa_s", positive, "dynamic viscosity at 150 degC and 1e6 1/s (HTHS), compared with the "// &
         & "law of viscosity; no result follows from it", oil%hths_viscosity, is_optional=.true., usual=[1.3_wp, 8.0_wp])
      call keys%number("density_kg_m3", positive, "density at 15 degC", oil%density, usual=[750.0_wp, 1050.0_wp])
      call keys%number("thermal_expansion_per_K", not_negative, "thermal expansion of the density", oil%thermal_expansion, &
         & usual=[4.0e-4_wp, 1.0e-3_wp])
      call keys%choice("pressure_law", pressure_law_names, "viscosity as a function of pressure", oil%pressure_law)
      call keys%number("pressure_viscosity_coefficient_per_GPa", positive, "pressure-viscosity coefficient at ambient "// &
         & "pressure; where not given from roelands_index, or without that, with 'walther' and 'data_sheet', estimated by So "// &
         & "and Klaus (1980)", oil%pressure_viscosity, example="22", is_optional=.true., usual=[4.0_wp, 45.0_wp])
      call keys%numbers("pressure_viscosity_temperatures_degC", above_absolute_zero, &
         & "temperatures of the pressure-viscosity coefficients given as points, increasing, two or more", &
         & oil%pressure_viscosity_temperatures, is_optional=.true., usual=[-40.0_wp, 200.0_wp])
      call keys%numbers("pressure_viscosity_points_per_GPa", positive, "pressure-viscosity coefficients at these temperatures, "// &
         & "not rising, in the place of one coefficient; between and beyond them the logarithm is a straight line", &
         & oil%pressure_viscosity_points, is_optional=.true., usual=[4.0_wp, 45.0_wp])
      call keys%number("roelands_index", positive, "Roelands' index Z; from the pressure-viscosity coefficient where not given", &
         & oil%roelands_index, is_optional=.true., usual=[0.2_wp, 1.2_wp])
   end subroutine bind_lubricant

   !> Film: by a law, or numerical.
   subroutine bind_film(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("film", group_standard, "film thickness")
      call keys%choice("law", film_law_names, "film-thickness law", case%film%law)
      call keys%choice("range_policy", range_policy_names, "what to do where a law is used outside its published range", &
         & case%film%range_policy)
      call keys%group("ehl", group_effect, "film by numerical solution of the contact, in place of the film law")
      if (keys%are_wanted(allocated(case%ehl))) then
         if (.not. allocated(case%ehl)) allocate (case%ehl)
         call keys%number("accuracy", proper_fraction, "largest relative error of the film; with 'camroller ehl' the largest "// &
            & "difference of films and mean slip between the last two grids", case%ehl%accuracy)
         call keys%yes_or_no("compressible", "does the density of the oil grow with the pressure?", case%ehl%compressible)
         call keys%yes_or_no("profiles", "are pressure, film and friction across the contact written too, in /ehl? By 'sweep' "// &
            & "for the cases of sweep.series", case%ehl%profiles)
         call keys%yes_or_no("shear_thinning", "whether sliding thins the oil that pressure drives, where the shear law is "// &
            & "'eyring'; shear follows that law either way", case%ehl%shear_thinning)
         call keys%yes_or_no("flow_factors", "whether roughness hinders the flow, by Patir and Cheng", case%ehl%flow_factors)
      end if
   end subroutine bind_film

   !> Friction of the film.
   subroutine bind_traction(keys, traction)
      type(keys_t), intent(inout) :: keys
      !> Its laws
      type(traction_t), intent(inout) :: traction

      call keys%group("traction", group_standard, "friction of the film")
      call keys%choice("shear_law", shear_law_names, "shear of the film", traction%shear_law)
      call keys%number("eyring_stress_MPa", positive, "Eyring stress of the oil", traction%eyring_stress, is_optional=.true., &
         & usual=[0.5_wp, 30.0_wp])
      call keys%choice("sheared_zone", zone_names, "strip of the film that is sheared: that of the dry contact, or one for "// &
         & "nearly rigid contacts as well", traction%sheared_zone)
      call keys%choice("limit", limit_names, "what is limited: the traction of all of the film, limiting_coefficient times the "// &
         & "load, or the stress at each point", traction%limit)
      call keys%number("limiting_coefficient", positive, "limiting traction coefficient of the film; limit 'local': rise of "// &
         & "the limiting stress with the pressure", traction%limiting_coefficient, usual=[0.01_wp, 0.2_wp])
      call keys%number("limiting_stress_MPa", not_negative, "limiting stress without pressure, 0 where not given", &
         & traction%limiting_stress, is_optional=.true., usual=[0.0_wp, 20.0_wp])
      call keys%choice("cap", cap_names, "how the limiting traction is approached", traction%cap)
      call keys%choice("rolling_law", rolling_law_names, "rolling resistance", traction%rolling_law)
      call keys%yes_or_no("in_roller_balance", "does rolling resistance act on the roller's spin?", traction%in_roller_balance)
   end subroutine bind_traction

   !> Choice of effects, integration.
   subroutine bind_numerics(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("effects", group_standard, "which effects of the deck are computed")
      call keys%choice("select", select_names, "all effects of the deck, or only those that a survey of the cycle estimates to "// &
         & "be needed", case%effects%select)
      call keys%number("negligible", range_t(0.0_wp, 0.1_wp), &
         & "largest relative change of the quantity by all effects left out together", case%effects%negligible)
      call keys%choice("quantity", quantity_names, "quantity that decides: mean torque for all losses, smallest film, or slip "// &
         & "per revolution", case%effects%quantity)
      call keys%group("numerics", group_standard, "how the roller's spin is integrated")
      call keys%number("accuracy", range_t(1.0e-10_wp, largest_accuracy), "largest error of the sliding speed relative to its "// &
         & "largest value (at least 1e-5 of the largest speed in pure rolling), of each mean relative to its mean magnitude, "// &
         & "of smallest and largest values relative to their range", case%numerics%accuracy)
      call keys%choice("method", method_choices, "integration method; 'automatic' takes the one with the least work", &
         & case%numerics%method)
      call keys%number("tolerance", range_t(1.0e-13_wp, largest_accuracy), &
         & "in place of accuracy: error of a step relative to the largest sliding speed; the result's error is not controlled", &
         & case%numerics%tolerance, is_optional=.true.)
      call keys%number("step_deg", up_to(largest_step/degree), "cam angle of a step", case%numerics%step)
      call keys%number("periodicity", up_to(largest_periodicity), "largest difference of the sliding speed between start and "// &
         & "end of the reported cycle, relative to its largest value; a tenth of 'tolerance' suffices, with 'accuracy' it is "// &
         & "0.01 of that", case%numerics%periodicity)
      call keys%whole_number("max_cycles", one_or_more, "largest number of cycles integrated until the cycle is periodic; a "// &
         & "case that is not periodic then fails; with &dynamics at least 40, after which it does not fail", &
         & case%numerics%max_cycles)
   end subroutine bind_numerics

   !> Result file.
   subroutine bind_output(keys, numerics, options)
      type(keys_t), intent(inout) :: keys
      !> Gets the step of the output
      type(numerics_t), intent(inout) :: numerics
      !> What goes into the file
      type(output_options_t), intent(inout) :: options

      call keys%group("output", group_standard, "contents of the result file")
      call keys%number("angle_step_deg", up_to(largest_step/degree), &
         & "cam angle between output points; 360 is a whole multiple of it", numerics%output_step)
      call keys%yes_or_no("series", "are the series over the cam angle written, or the summary alone? 'camroller sweep' goes "// &
         & "by sweep.series", options%series)
      call keys%choice("compression", compression_names, "whether series are compressed; 'auto' compresses large files", &
         & options%compression)
   end subroutine bind_output

   !> What goes into the result file.
   subroutine take_output_options(settings, options)
      !> The settings
      type(settings_t), intent(in), target :: settings
      !> The options
      type(output_options_t), intent(out) :: options

      type(keys_t) :: keys
      type(numerics_t) :: numerics

      keys = taken_from(settings)
      call bind_output(keys, numerics, options)
   end subroutine take_output_options

end module camroller_deck_keys
