!> Everything public, under one name: no code.
!>
!> A program that links the library needs this module alone: a deck or the components of a case, `run_case`, and the series and
!> scalars of the result by name; or `start_simulation` and `advance` to drive a follower from outside, angle by angle; or
!> `run_sweep` for all cases of a deck into one file, `sweep_cases` to have them handed over to an extension of `sink_t`. Where
!> cases have a numerical film, it calls `use_one_blas_thread` first, or its last digits depend on how many threads OpenBLAS takes.
module camroller
   use camroller_core, only : wp, pi, two_pi, degree, version_text, version_number, error_t, kind_usage, kind_deck, &
      & kind_domain, kind_convergence, kind_file, kind_internal, case_t, operating_point_t, numerics_t, lift_t, mechanism_t, &
      & masses_t, spring_t, gas_force_t, materials_t, surface_t, lubricant_t, film_t, ehl_t, asperity_t, traction_t, heat_t, &
      & needle_bearing_t, valve_guide_t, roller_t, cam_bearings_t, deck_t, override_t, read_deck, parse_deck, make_case, &
      & list_deck_remarks, line_t, &
      & run_case, result_t, quantity_t, find_quantity, get_series, get_summary, use_one_blas_thread, simulation_t, outcome_t, &
      & inputs_t, start_simulation, advance, halt, save_simulation, restore_simulation, shaft_simulation_t, shaft_outcome_t, &
      & start_shaft, advance_shaft, halt_shaft, save_shaft, restore_shaft, cam_number, cam_place, shaft_angle, shaft_values, &
      & shaft_series, simulation_angle, simulation_series, simulation_values, &
      & torque_list, of_geometric, of_contact, of_needle, of_guide, of_roller_inertia, of_damping, of_bearings, of_residual, &
      & needle_drag_t, sliding_t, valve_tip_t, stem_seal_t, guide_side_load_t, finger_pivot_t, bearing_asperity_t, &
      & belt_pull_t, bearing_heat_t, shaft_drag_t, friction_modifier_t, roller_profile_t, boundary_law_t, wear_t, &
      & tribofilm_t, running_in_t
   use camroller_case_loop, only : sweep_cases
   use camroller_case_record, only : case_outcome_t
   use camroller_case_sink, only : sink_t
   use camroller_layout, only : layout_t
   use camroller_monitor, only : monitor_t
   use camroller_sweep, only : run_sweep
   use camroller_sweep_file, only : sweep_options_t, sweep_report_t
   implicit none
   private

   public :: wp, pi, two_pi, degree, version_text, version_number
   public :: error_t, kind_usage, kind_deck, kind_domain, kind_convergence, kind_file, kind_internal
   public :: case_t, operating_point_t, numerics_t, lift_t, mechanism_t, masses_t, spring_t, gas_force_t, materials_t, surface_t, &
      & lubricant_t, film_t, ehl_t, asperity_t, traction_t, heat_t, needle_bearing_t, valve_guide_t, roller_t, cam_bearings_t
   public :: needle_drag_t, sliding_t, valve_tip_t, stem_seal_t, guide_side_load_t, finger_pivot_t
   public :: bearing_asperity_t, belt_pull_t, bearing_heat_t, shaft_drag_t, friction_modifier_t, roller_profile_t, boundary_law_t
   public :: wear_t, tribofilm_t, running_in_t
   public :: deck_t, override_t, read_deck, parse_deck, make_case, list_deck_remarks, line_t
   public :: run_case, result_t, quantity_t, find_quantity, get_series, get_summary, use_one_blas_thread
   public :: run_sweep, sweep_options_t, sweep_report_t, sweep_cases, sink_t, case_outcome_t, layout_t, monitor_t
   public :: simulation_t, outcome_t, inputs_t, start_simulation, advance, halt, save_simulation, restore_simulation
   public :: shaft_simulation_t, shaft_outcome_t, start_shaft, advance_shaft, halt_shaft, save_shaft, restore_shaft
   public :: cam_number, cam_place, shaft_angle, shaft_series, shaft_values, simulation_angle, simulation_series, simulation_values
   public :: torque_list, of_geometric, of_contact, of_needle, of_guide, of_roller_inertia, of_damping, of_bearings, of_residual

end module camroller
