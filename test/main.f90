!> Test runner: `check [SUITE [TEST]]`.
!>
!> One line per test on the error unit, one closing line `N passed, N failed` on the output unit, exit code 1 where a
!> test failed, where no test ran or where the names are unknown. A skipped test counts neither way and is named.
!>
!> A new suite is one `use` line and one entry in `suites`.
program main
   use, intrinsic :: iso_fortran_env, only : error_unit, int64, output_unit
   use testdrive, only : testsuite_type, new_testsuite, unittest_type, error_type, get_argument, select_suite, &
      select_test
   use camroller_blas_threads, only : use_one_blas_thread
   use test_error, only : collect_error
   use test_names, only : collect_names
   use test_version, only : collect_version
   use test_blas_threads, only : collect_blas_threads
   use test_roots, only : collect_roots
   use test_dual, only : collect_dual
   use test_needle_drag, only : collect_needle_drag
   use test_pin_film, only : collect_pin_film
   use test_skf_bearing, only : collect_skf_bearing
   use test_joints, only : collect_joints
   use test_joint_spikes, only : collect_joint_spikes
   use test_ehl_heat, only : collect_ehl_heat
   use test_ehl_boundary, only : collect_ehl_boundary
   use test_heat_remarks, only : collect_heat_remarks
   use test_heat, only : collect_heat
   use test_axial, only : collect_axial
   use test_axial_follower, only : collect_axial_follower
   use test_axial_lengths, only : collect_axial_lengths
   use test_axial_window, only : collect_axial_window
   use test_boundary_law, only : collect_boundary_law
   use test_friction_modifier, only : collect_friction_modifier
   use test_running_in, only : collect_running_in
   use test_flexible_running_in, only : collect_flexible_running_in
   use test_tribofilm, only : collect_tribofilm
   use test_heat_laws, only : collect_heat_laws
   use test_spline, only : collect_spline
   use test_lift_segments, only : collect_lift_segments
   use test_lift, only : collect_lift
   use test_lift_table, only : collect_lift_table
   use test_quadrature, only : collect_quadrature
   use test_panels, only : collect_panels
   use test_minimum, only : collect_minimum
   use test_asperity, only : collect_asperity
   use test_zhao_maietta_chang, only : collect_zhao_maietta_chang
   use test_deck, only : collect_deck
   use test_part_file, only : collect_part_file
   use test_sweep, only : collect_sweep
   use test_samples, only : collect_samples
   use test_deck_sweep, only : collect_deck_sweep
   use test_hdf5_file, only : collect_hdf5_file
   use test_output, only : collect_output
   use test_export, only : collect_export
   use test_new_file, only : collect_new_file
   use test_deck_binder, only : collect_deck_binder
   use test_deck_document, only : collect_deck_document
   use test_deck_tables, only : collect_deck_tables
   use test_deck_threads, only : collect_deck_threads
   use test_number_text, only : collect_number_text
   use test_units, only : collect_units
   use test_journal, only : collect_journal
   use test_bearing_heat, only : collect_bearing_heat
   use test_shaft_drag, only : collect_shaft_drag
   use test_journal_motion, only : collect_journal_motion
   use test_journal_orbit, only : collect_journal_orbit
   use test_mixed_bearings, only : collect_mixed_bearings
   use test_camshaft, only : collect_camshaft
   use test_gas_of_lobes, only : collect_gas_of_lobes
   use test_kinematics_reference, only : collect_kinematics_reference
   use test_cycle_reference, only : collect_cycle_reference
   use test_unit_rescaling_contact, only : collect_unit_rescaling_contact
   use test_unit_rescaling_train, only : collect_unit_rescaling_train
   use test_derivatives, only : collect_derivatives
   use test_ode, only : collect_ode
   use test_ode_rosenbrock, only : collect_ode_rosenbrock
   use test_energy, only : collect_energy
   use test_stick_slip, only : collect_stick_slip
   use test_contact, only : collect_contact
   use test_events, only : collect_events
   use test_margins, only : collect_margins
   use test_result, only : collect_result
   use test_result_remarks, only : collect_result_remarks
   use test_extremes, only : collect_extremes
   use test_remarks, only : collect_remarks
   use test_follower_samples, only : collect_follower_samples
   use test_train, only : collect_train
   use test_traction, only : collect_traction
   use test_load_share, only : collect_load_share
   use test_fold, only : collect_fold
   use test_film, only : collect_film
   use test_ehl, only : collect_ehl
   use test_ehl_rough, only : collect_ehl_rough
   use test_ehl_limits, only : collect_ehl_limits
   use test_ehl_map, only : collect_ehl_map
   use test_ehl_law, only : collect_ehl_law
   use test_ehl_settling, only : collect_ehl_settling
   use test_ehl_bearings, only : collect_ehl_bearings
   use test_ehl_cycle, only : collect_ehl_cycle
   use test_ehl_energy, only : collect_ehl_energy
   use test_ehl_factors, only : collect_ehl_factors
   use test_ehl_record, only : collect_ehl_record
   use test_ehl_reynolds, only : collect_ehl_reynolds
   use test_lubricant, only : collect_lubricant
   use test_film_range, only : collect_film_range
   use test_hertz, only : collect_hertz
   use test_local_limit, only : collect_local_limit
   use test_invariance, only : collect_invariance
   use test_magnitudes, only : collect_magnitudes
   use test_film_literature, only : collect_film_literature
   use test_train_outlook, only : collect_train_outlook
   use test_hard_dynamics, only : collect_hard_dynamics
   use test_limit_speeds, only : collect_limit_speeds
   use test_study, only : collect_study
   use test_error_estimate, only : collect_error_estimate
   use test_lobe_curve, only : collect_lobe_curve
   use test_means, only : collect_means
   use test_extreme_errors, only : collect_extreme_errors
   use test_roller_problem, only : collect_roller_problem
   use test_spin_slopes, only : collect_spin_slopes
   use test_simulation, only : collect_simulation
   use test_saved_simulation, only : collect_saved_simulation
   use test_simulation_faults, only : collect_simulation_faults
   use test_step_estimates, only : collect_step_estimates
   use test_step_remarks, only : collect_step_remarks
   use test_train_step_remarks, only : collect_train_step_remarks
   use test_shaft_simulation, only : collect_shaft_simulation
   use test_hand_made, only : collect_hand_made
   use test_shaft_faults, only : collect_shaft_faults
   use test_simulation_inputs, only : collect_simulation_inputs
   use test_quasi_static, only : collect_quasi_static
   use test_ode_barrier, only : collect_ode_barrier
   use test_ode_bridge, only : collect_ode_bridge
   use test_ode_special, only : collect_ode_special
   use test_hard_ehl, only : collect_hard_ehl
   use test_hard_cases, only : collect_hard_cases
   use test_ode_switching, only : collect_ode_switching
   use test_flexible_cycle, only : collect_flexible_cycle
   use test_flexible_periods, only : collect_flexible_periods
   use test_flexible_host, only : collect_flexible_host
   use test_flexible_simulation, only : collect_flexible_simulation
   use test_flexible_invariance, only : collect_flexible_invariance
   use test_flexible_joints, only : collect_flexible_joints
   use test_flexible_parts, only : collect_flexible_parts
   use test_flexible_train, only : collect_flexible_train
   use test_flexible_twins, only : collect_flexible_twins
   use test_random_cases, only : collect_random_cases
   use test_random_ehl, only : collect_random_ehl
   use test_random_flexible, only : collect_random_flexible
   use test_random_hosts, only : collect_random_hosts
   use test_random_wide, only : collect_random_wide
   use test_effects, only : collect_effects
   use test_needed, only : collect_needed
   use test_needed_flexible, only : collect_needed_flexible
   use test_kept_models, only : collect_kept_models
   implicit none

   call run_command_line()

contains

   !> Run what the command line asks for and end the program.
   subroutine run_command_line()
      type(testsuite_type), allocatable :: suites(:)
      character(len=:), allocatable :: suite_name, test_name
      integer :: passed, failed, skipped, i

      ! as the program does: threads of OpenBLAS wait busily for each other where other tests use the cores
      call use_one_blas_thread()
      suites = all_suites()
      call get_argument(1, suite_name)
      call get_argument(2, test_name)
      passed = 0
      failed = 0
      skipped = 0
      if (allocated(suite_name)) then
         i = select_suite(suites, suite_name)
         if (i == 0) call refuse(suite_name, suites)
         call run_suite(suites(i), test_name, passed, failed, skipped)
      else
         do i = 1, size(suites)
            call run_suite(suites(i), test_name, passed, failed, skipped)
         end do
      end if
      if (skipped > 0) write (output_unit, '(i0, a)') skipped, " skipped"
      write (output_unit, '(i0, a, i0, a)') passed, " passed, ", failed, " failed"
      if (failed > 0 .or. passed + skipped == 0) stop 1, quiet = .true.
   end subroutine run_command_line

   !> Every suite there is.
   ! style: procedure because it is one list
   function all_suites() result(suites)
      !> The suites
      type(testsuite_type), allocatable :: suites(:)

      suites = [ &
         new_testsuite("error", collect_error), &
         new_testsuite("hard_cases", collect_hard_cases), &
         new_testsuite("ode_switching", collect_ode_switching), &
         new_testsuite("flexible_cycle", collect_flexible_cycle), &
         new_testsuite("flexible_periods", collect_flexible_periods), &
         new_testsuite("flexible_simulation", collect_flexible_simulation), &
         new_testsuite("flexible_host", collect_flexible_host), &
         new_testsuite("flexible_parts", collect_flexible_parts), &
         new_testsuite("flexible_invariance", collect_flexible_invariance), &
         new_testsuite("flexible_joints", collect_flexible_joints), &
         new_testsuite("flexible_train", collect_flexible_train), &
         new_testsuite("flexible_twins", collect_flexible_twins), &
         new_testsuite("random_cases", collect_random_cases), &
         new_testsuite("random_ehl", collect_random_ehl), &
         new_testsuite("random_flexible", collect_random_flexible), &
         new_testsuite("random_wide", collect_random_wide), &
         new_testsuite("random_hosts", collect_random_hosts), &
         new_testsuite("effects", collect_effects), &
         new_testsuite("ehl", collect_ehl), &
         new_testsuite("ehl_rough", collect_ehl_rough), &
         new_testsuite("ehl_limits", collect_ehl_limits), &
         new_testsuite("ehl_map", collect_ehl_map), &
         new_testsuite("ehl_law", collect_ehl_law), &
         new_testsuite("ehl_settling", collect_ehl_settling), &
         new_testsuite("needed", collect_needed), &
         new_testsuite("needed_flexible", collect_needed_flexible), &
         new_testsuite("kept_models", collect_kept_models), &
         new_testsuite("ehl_cycle", collect_ehl_cycle), &
         new_testsuite("ehl_bearings", collect_ehl_bearings), &
         new_testsuite("ehl_energy", collect_ehl_energy), &
         new_testsuite("ehl_factors", collect_ehl_factors), &
         new_testsuite("ehl_record", collect_ehl_record), &
         new_testsuite("ehl_reynolds", collect_ehl_reynolds), &
         new_testsuite("hard_ehl", collect_hard_ehl), &
         new_testsuite("ode", collect_ode), &
         new_testsuite("ode_rosenbrock", collect_ode_rosenbrock), &
         new_testsuite("ode_barrier", collect_ode_barrier), &
         new_testsuite("ode_bridge", collect_ode_bridge), &
         new_testsuite("ode_special", collect_ode_special), &
         new_testsuite("names", collect_names), &
         new_testsuite("version", collect_version), &
         new_testsuite("blas_threads", collect_blas_threads), &
         new_testsuite("roots", collect_roots), &
         new_testsuite("dual", collect_dual), &
         new_testsuite("needle_drag", collect_needle_drag), &
         new_testsuite("pin_film", collect_pin_film), &
         new_testsuite("skf_bearing", collect_skf_bearing), &
         new_testsuite("joints", collect_joints), &
         new_testsuite("joint_spikes", collect_joint_spikes), &
         new_testsuite("ehl_heat", collect_ehl_heat), &
         new_testsuite("ehl_boundary", collect_ehl_boundary), &
         new_testsuite("heat_remarks", collect_heat_remarks), &
         new_testsuite("heat", collect_heat), &
         new_testsuite("axial", collect_axial), &
         new_testsuite("axial_follower", collect_axial_follower), &
         new_testsuite("axial_lengths", collect_axial_lengths), &
         new_testsuite("axial_window", collect_axial_window), &
         new_testsuite("friction_modifier", collect_friction_modifier), &
         new_testsuite("running_in", collect_running_in), &
         new_testsuite("flexible_running_in", collect_flexible_running_in), &
         new_testsuite("tribofilm", collect_tribofilm), &
         new_testsuite("boundary_law", collect_boundary_law), &
         new_testsuite("heat_laws", collect_heat_laws), &
         new_testsuite("spline", collect_spline), &
         new_testsuite("lift", collect_lift), &
         new_testsuite("lift_table", collect_lift_table), &
         new_testsuite("lift_segments", collect_lift_segments), &
         new_testsuite("quadrature", collect_quadrature), &
         new_testsuite("asperity", collect_asperity), &
         new_testsuite("zhao_maietta_chang", collect_zhao_maietta_chang), &
         new_testsuite("deck", collect_deck), &
         new_testsuite("deck_sweep", collect_deck_sweep), &
         new_testsuite("samples", collect_samples), &
         new_testsuite("part_file", collect_part_file), &
         new_testsuite("sweep", collect_sweep), &
         new_testsuite("hdf5_file", collect_hdf5_file), &
         new_testsuite("output", collect_output), &
         new_testsuite("export", collect_export), &
         new_testsuite("new_file", collect_new_file), &
         new_testsuite("deck_binder", collect_deck_binder), &
         new_testsuite("deck_document", collect_deck_document), &
         new_testsuite("deck_tables", collect_deck_tables), &
         new_testsuite("deck_threads", collect_deck_threads), &
         new_testsuite("number_text", collect_number_text), &
         new_testsuite("units", collect_units), &
         new_testsuite("journal", collect_journal), &
         new_testsuite("bearing_heat", collect_bearing_heat), &
         new_testsuite("shaft_drag", collect_shaft_drag), &
         new_testsuite("journal_motion", collect_journal_motion), &
         new_testsuite("journal_orbit", collect_journal_orbit), &
         new_testsuite("mixed_bearings", collect_mixed_bearings), &
         new_testsuite("camshaft", collect_camshaft), &
         new_testsuite("gas_of_lobes", collect_gas_of_lobes), &
         new_testsuite("kinematics_reference", collect_kinematics_reference), &
         new_testsuite("cycle_reference", collect_cycle_reference), &
         new_testsuite("unit_rescaling_contact", collect_unit_rescaling_contact), &
         new_testsuite("unit_rescaling_train", collect_unit_rescaling_train), &
         new_testsuite("derivatives", collect_derivatives), &
         new_testsuite("spin_slopes", collect_spin_slopes), &
         new_testsuite("energy", collect_energy), &
         new_testsuite("stick_slip", collect_stick_slip), &
         new_testsuite("contact", collect_contact), &
         new_testsuite("events", collect_events), &
         new_testsuite("margins", collect_margins), &
         new_testsuite("result", collect_result), &
         new_testsuite("result_remarks", collect_result_remarks), &
         new_testsuite("extremes", collect_extremes), &
         new_testsuite("remarks", collect_remarks), &
         new_testsuite("follower_samples", collect_follower_samples), &
         new_testsuite("train", collect_train), &
         new_testsuite("traction", collect_traction), &
         new_testsuite("local_limit", collect_local_limit), &
         new_testsuite("load_share", collect_load_share), &
         new_testsuite("fold", collect_fold), &
         new_testsuite("film", collect_film), &
         new_testsuite("lubricant", collect_lubricant), &
      new_testsuite("film_range", collect_film_range), &
         new_testsuite("hertz", collect_hertz), &
         new_testsuite("invariance", collect_invariance), &
         new_testsuite("magnitudes", collect_magnitudes), &
         new_testsuite("film_literature", collect_film_literature), &
         new_testsuite("study", collect_study), &
         new_testsuite("limit_speeds", collect_limit_speeds), &
         new_testsuite("hard_dynamics", collect_hard_dynamics), &
         new_testsuite("train_outlook", collect_train_outlook), &
         new_testsuite("error_estimate", collect_error_estimate), &
         new_testsuite("lobe_curve", collect_lobe_curve), &
         new_testsuite("means", collect_means), &
         new_testsuite("extreme_errors", collect_extreme_errors), &
         new_testsuite("panels", collect_panels), &
         new_testsuite("minimum", collect_minimum), &
         new_testsuite("roller_problem", collect_roller_problem), &
         new_testsuite("shaft_simulation", collect_shaft_simulation), &
         new_testsuite("step_estimates", collect_step_estimates), &
         new_testsuite("step_remarks", collect_step_remarks), &
         new_testsuite("train_step_remarks", collect_train_step_remarks), &
         new_testsuite("hand_made", collect_hand_made), &
         new_testsuite("shaft_faults", collect_shaft_faults), &
         new_testsuite("simulation", collect_simulation), &
         new_testsuite("saved_simulation", collect_saved_simulation), &
         new_testsuite("simulation_faults", collect_simulation_faults), &
         new_testsuite("simulation_inputs", collect_simulation_inputs), &
         new_testsuite("quasi_static", collect_quasi_static) &
         ]
   end function all_suites

   !> Run one suite, or one test of it, and add to the counts.
   subroutine run_suite(suite, test_name, passed, failed, skipped)
      !> The suite
      type(testsuite_type), intent(in) :: suite
      !> The only test wanted; all where not allocated
      character(len=:), allocatable, intent(in) :: test_name
      !> Counts of tests
      integer, intent(inout) :: passed, failed, skipped

      ! What is worth a line [s]
      integer, parameter :: long = 10
      type(unittest_type), allocatable :: tests(:)
      integer(int64) :: start, end, rate
      integer :: i, first, last

      call system_clock(start, rate)
      call suite%collect(tests)
      first = 1
      last = size(tests)
      if (allocated(test_name)) then
         first = select_test(tests, test_name)
         last = first
         if (first == 0) then
            write (error_unit, '(a)') "no test '"//test_name//"' in suite '"//suite%name//"'; known are"
            write (error_unit, '(3x, a)') (tests(i)%name, i=1, size(tests))
            stop 1, quiet = .true.
         end if
      end if
      write (error_unit, '(a)') suite%name
      do i = first, last
         call run_test(tests(i), passed, failed, skipped)
      end do
      call system_clock(end)
      if (end - start > long*rate) write (error_unit, '(3x, i0, a)') (end - start)/rate, " s"
   end subroutine run_suite

   !> Run one test, say how it went and add to the counts.
   subroutine run_test(test, passed, failed, skipped)
      !> The test
      type(unittest_type), intent(in) :: test
      !> Counts of tests
      integer, intent(inout) :: passed, failed, skipped

      !> Status of a test that asked to be skipped, as test-drive sets it
      integer, parameter :: skip_status = 77
      type(error_type), allocatable :: error

      call test%test(error)
      if (.not. allocated(error)) then
         if (test%should_fail) then
            failed = failed + 1
            write (error_unit, '(3x, a)') "FAILED   "//test%name//": passed, but should fail"
         else
            passed = passed + 1
            write (error_unit, '(3x, a)') "passed   "//test%name
         end if
         return
      end if
      if (error%stat == skip_status) then
         skipped = skipped + 1
         write (error_unit, '(3x, a)') "skipped  "//test%name//": "//error%message
      else if (test%should_fail) then
         passed = passed + 1
         write (error_unit, '(3x, a)') "passed   "//test%name//" (fails, as it should)"
      else
         failed = failed + 1
         write (error_unit, '(3x, a)') "FAILED   "//test%name//": "//error%message
      end if
      error%stat = 0
   end subroutine run_test

   !> Say that a suite is unknown, list the known ones and end the program.
   subroutine refuse(name, suites)
      !> The unknown name
      character(len=*), intent(in) :: name
      !> The known suites
      type(testsuite_type), intent(in) :: suites(:)

      integer :: i

      write (error_unit, '(a)') "no suite '"//name//"'; known are"
      write (error_unit, '(3x, a)') (suites(i)%name, i=1, size(suites))
      stop 1, quiet = .true.
   end subroutine refuse

end program main
