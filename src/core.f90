!> What is public of the core, under one name: no code. The core is everything up to decks, runs and followers, without HDF5 files.
!>
!> A program that links libcamroller without libcamroller_io needs this module alone; `camroller` has the same and sweeps beside.
module camroller_core ! style: private because it gives on all that it uses
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_blas_threads, only : use_one_blas_thread
   use camroller_error, only : error_t, kind_usage, kind_deck, kind_domain, kind_convergence, kind_file, kind_internal, &
      & kind_memory, kind_unfinished
   use camroller_version, only : version_text, version_number
   use camroller_case, only : case_t, operating_point_t, numerics_t, selection_t
   use camroller_engine, only : engine_t
   use camroller_lift, only : lift_t
   use camroller_kinematics, only : mechanism_t
   use camroller_dynamics, only : masses_t, spring_t, gas_force_t
   use camroller_materials, only : materials_t, surface_t
   use camroller_lubricant, only : lubricant_t
   use camroller_film, only : film_t
   use camroller_ehl_table, only : ehl_t
   use camroller_asperity, only : asperity_t, friction_modifier_t
   use camroller_boundary_law, only : boundary_law_t
   use camroller_tribofilm, only : running_in_t, tribofilm_t
   use camroller_wear, only : wear_t
   use camroller_traction, only : traction_t
   use camroller_heat, only : heat_t
   use camroller_roller_profile, only : roller_profile_t
   use camroller_needle, only : needle_bearing_t
   use camroller_guide, only : valve_guide_t
   use camroller_needle_drag, only : needle_drag_t
   use camroller_sliding_friction, only : sliding_t
   use camroller_stem_friction, only : valve_tip_t, stem_seal_t, guide_side_load_t
   use camroller_pivot_friction, only : finger_pivot_t
   use camroller_roller, only : roller_t
   use camroller_journal, only : cam_bearings_t
   use camroller_bearing_asperity, only : bearing_asperity_t
   use camroller_bearing_heat, only : bearing_heat_t
   use camroller_bearing_loads, only : belt_pull_t
   use camroller_shaft_drag, only : shaft_drag_t
   use camroller_flexible_parts, only : dynamics_t
   use camroller_spring_modes, only : spring_surge_t
   use camroller_lash_adjuster, only : lash_adjuster_t
   use camroller_deck, only : deck_t, override_t, read_deck, parse_deck, make_case
   use camroller_deck_keys, only : check_case
   use camroller_deck_remarks, only : list_deck_remarks
   use camroller_text_lines, only : line_t
   use camroller_run, only : run_case
   use camroller_remarks, only : remark_t, remark_names
   use camroller_result, only : result_t, quantity_t, find_quantity, get_series, get_summary
   use camroller_saved_simulation, only : save_simulation, restore_simulation, save_shaft, restore_shaft
   use camroller_shaft_simulation, only : shaft_simulation_t, shaft_outcome_t, start_shaft, advance_shaft, halt_shaft, &
      & cam_number, cam_place, shaft_angle, shaft_series, shaft_values, list_shaft_remarks
   use camroller_torque_list, only : torque_list, of_geometric, of_contact, of_needle, of_guide, of_roller_inertia, &
      & of_damping, of_bearings, of_tip, of_seal, of_guide_side, of_pivot, of_needle_drag, of_shaft_drag, &
      & of_gas_damping, of_residual
   use camroller_simulation, only : simulation_t, outcome_t, inputs_t, start_simulation, advance, halt, &
      & simulation_angle, simulation_series, simulation_values, list_step_remarks
   implicit none
   public

end module camroller_core
