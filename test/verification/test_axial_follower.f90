!> A follower whose load is not the same along its roller.
module test_axial_follower
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_kinds, only : wp, degree
   use camroller_kinematics, only : rotation_names
   use camroller_model, only : model_t
   use camroller_remarks, only : cut_off_contact, oiled_slices, unloaded_end
   use camroller_result, only : result_t, find_quantity, get_summary
   use camroller_roller_profile, only : roller_profile_t
   use camroller_run, only : run_case
   use camroller_simulation, only : advance, outcome_t, simulation_t, start_simulation
   use camroller_state, only : state_t, evaluate_state
   use case_twins, only : leave_constants_out, rescale_case
   use closeness, only : has_failed
   use energy_checks, only : check_energy
   use reference_cases, only : thesis_case, skewed_case, make_model, set_point, add_gas_force, add_heat, point_speeds, &
      & point_viscosities
   use roller_profiles, only : profiles
   use unit_systems, only : unit_systems_tried, scaled, compare, speed, length, force
   implicit none
   private

   public :: collect_axial_follower

contains

   subroutine collect_axial_follower(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a cylinder without tilt and coupling changes no bit", test_flat), &
         new_unittest("energy closes at 720 angles with a profile, for both senses of rotation, with heat", test_energy), &
         new_unittest("results are the same in other units", test_units), &
         new_unittest("means of load and pressure at ends that carry for a short time only do not depend on the tolerance", &
            & test_short_loads), &
         new_unittest("the mean place of the largest pressure, which jumps, does not depend on the method", test_jumps), &
         new_unittest("largest pressure and smallest film that a host gets are those along the roller, as in a run", test_host), &
         new_unittest("remarks tell of an end that cuts the contact off, and of one without load", test_remarks) &
         ]
   end subroutine collect_axial_follower

   subroutine test_flat(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      type(error_t), allocatable :: failure
      integer :: i, k

      case = thesis_case()
      call run_case(case, without, failure)
      allocate (case%roller_profile)
      case%roller_profile%coupling = "none"
      if (.not. allocated(failure)) call run_case(case, with, failure)
      if (has_failed(failure, error)) return
      do i = 1, size(without%series)
         k = find_quantity(with%series, without%series(i)%name)
         call check(error, k > 0, "a series is gone")
         if (allocated(error)) return
         call check(error, all(abs(with%series_values(:, k) - without%series_values(:, i)) <= 0.0_wp), &
            & "a bit of "//without%series(i)%name//" is another")
         if (allocated(error)) return
      end do
      k = find_quantity(with%series, "effective_contact_length")
      call check(error, all(abs(with%series_values(:, k) - case%mechanism%contact_width) <= 0.0_wp), "length")
   end subroutine test_flat

   subroutine test_host(error)
      type(error_type), allocatable, intent(out) :: error
      ! Extremes of a run are looked for, those of a host are the ones of the points that it evaluates [-]
      real(wp), parameter :: close = 1.0e-3_wp
      type(case_t) :: case
      type(result_t) :: result
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(error_t), allocatable :: failure
      ! Along the roller and of the contact as a whole [Pa]; along the roller [m]
      real(wp) :: pressure, hertz_pressure, film
      ! Of a turn [Pa], [m]
      real(wp) :: met_pressure, met_film
      integer :: i

      case = thesis_case()
      case%roller_profile = profiles(1)
      call set_point(case, point_speeds(3), point_viscosities(1))
      call run_case(case, result, failure)
      if (.not. allocated(failure)) call get_summary(result, "max_axial_pressure_max", pressure, failure)
      if (.not. allocated(failure)) call get_summary(result, "max_hertz_pressure", hertz_pressure, failure)
      if (.not. allocated(failure)) call get_summary(result, "min_film_thickness_axial_min", film, failure)
      if (.not. allocated(failure)) call start_simulation(simulation, case, 0.0_wp, failure)
      met_pressure = 0.0_wp
      met_film = huge(1.0_wp)
      do i = 1, 720
         if (allocated(failure)) exit
         call advance(simulation, i*degree, case%operating_point%speed, case%operating_point%oil_temperature, outcome, failure)
         if (i <= 360) cycle
         met_pressure = max(met_pressure, outcome%extremes%hertz_pressure)
         met_film = min(met_film, outcome%extremes%film_min)
      end do
      if (has_failed(failure, error)) return
      call check(error, pressure > 1.02_wp*hertz_pressure, "the pressure is the same all along the roller")
      if (allocated(error)) return
      call check(error, met_pressure, pressure, thr=close, rel=.true., message="pressure")
      if (allocated(error)) return
      call check(error, met_film, film, thr=close, rel=.true., message="film")
   end subroutine test_host

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(state_t), allocatable :: states(:)
      integer :: sense

      do sense = 1, 2
         case = skewed_case(rotation_names(sense))
         call add_gas_force(case)
         call add_heat(case)
         case%roller_profile = profiles(sense)
         call set_point(case, point_speeds(3), point_viscosities(1))
         call check_energy(case, states, error)
         if (allocated(error)) return
         call check(error, minval(states%contact%length) < 0.9_wp*case%mechanism%contact_width, "the profile does nothing here")
         if (allocated(error)) return
      end do
   end subroutine test_energy

   subroutine test_units(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(model_t) :: model, twin
      type(state_t) :: state, twin_state
      integer :: i, k, number, status

      do number = 1, 4
         case = thesis_case()
         call leave_constants_out(case)
         case%roller_profile = profiles(number)
         call set_point(case, point_speeds(3), point_viscosities(1))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = 1, size(unit_systems_tried)
            other = case
            call rescale_case(other, unit_systems_tried(i))
            call make_model(other, twin, error)
            if (allocated(error)) return
            do k = -60, 60, 20
               call evaluate_state(model, k*degree, 2.0e-3_wp*model%speed, state, status)
               call evaluate_state(twin, k*degree, scaled(unit_systems_tried(i), 2.0e-3_wp*model%speed, speed), twin_state, status)
               call compare(error, "length", unit_systems_tried(i), length, [state%contact%length], [twin_state%contact%length])
               if (allocated(error)) return
               call compare(error, "load", unit_systems_tried(i), force, [state%contact%load], [twin_state%contact%load])
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_units

   !> Crowns whose ends carry load for none to a tenth of the turn.
   subroutine test_short_loads(error)
      type(error_type), allocatable, intent(out) :: error
      ! Radii of the crown [m]
      real(wp), parameter :: first = 7.78_wp, step = 0.02_wp
      integer, parameter :: radii = 12
      ! Error of a mean over the tolerance: 0.2 at most for 22 such radii; without panels that end where the ends touch more than
      ! one half for 11 of them, and up to 4 [-]
      real(wp), parameter :: allowed = 0.5_wp, tolerance = 1.0e-6_wp, close = 1.0e-9_wp
      character(len=*), parameter :: names(3) = [character(len=27) :: "mean_edge_pressure", "mean_line_load_positive_end", &
         & "mean_line_load_negative_end"]
      type(case_t) :: case
      type(result_t) :: loose, tight
      type(error_t), allocatable :: failure
      ! A mean at both tolerances [unit of the mean]
      real(wp) :: one, other
      integer :: i, k, loaded

      loaded = 0
      do i = 1, radii
         case = thesis_case()
         call set_point(case, point_speeds(2), point_viscosities(1))
         case%roller_profile = roller_profile_t(profile="crowned", crown_radius=first + i*step)
         case%numerics%method = "rodas5p"
         case%numerics%tolerance = tolerance
         call run_case(case, loose, failure)
         case%numerics%tolerance = close
         if (.not. allocated(failure)) call run_case(case, tight, failure)
         if (has_failed(failure, error)) return
         do k = 1, size(names)
            call get_summary(loose, trim(names(k)), one, failure)
            call get_summary(tight, trim(names(k)), other, failure)
            call check(error, abs(one - other) <= allowed*tolerance*other, names(k))
            if (allocated(error)) return
         end do
         if (other > 0.0_wp) loaded = loaded + 1
      end do
      call check(error, loaded > 1 .and. loaded <= radii, "no end carries load")
   end subroutine test_short_loads

   subroutine test_jumps(error)
      type(error_type), allocatable, intent(out) :: error
      ! Loads at which the load per length is the same on all of the roller: above and below that the largest pressure is at an end
      ! and in the middle [N]
      real(wp), parameter :: first = 80.0_wp, step = 40.0_wp
      integer, parameter :: loads = 6
      ! Difference of the mean places, over the length of the contact [-]: measured 1.3e-6 at most; without panels that end at jumps
      ! 3.6e-6 to 1e-5 for half of them
      real(wp), parameter :: allowed = 2.5e-6_wp
      character(len=8), parameter :: methods(2) = ["hermite ", "radau5  "]
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Means, smallest and largest place [m]
      real(wp) :: means(2), range(2)
      character(len=60) :: words
      integer :: i, k, jumping

      jumping = 0
      do i = 1, loads
         do k = 1, 2
            case = thesis_case()
            call set_point(case, point_speeds(2), point_viscosities(1))
            case%roller_profile = roller_profile_t(profile="logarithmic", design_load=first + i*step, end_drop=6.0e-6_wp)
            case%numerics%method = methods(k)
            case%numerics%tolerance = 1.0e-6_wp
            call run_case(case, result, failure)
            if (has_failed(failure, error)) return
            call get_summary(result, "mean_axial_pressure_place", means(k), failure)
            call get_summary(result, "min_axial_pressure_place", range(1), failure)
            call get_summary(result, "max_axial_pressure_place", range(2), failure)
         end do
         write (words, "(a, f6.0, es10.2)") "design load, difference", first + i*step, abs(means(1) - means(2)) &
            & /case%mechanism%contact_width
         call check(error, abs(means(1) - means(2)) <= allowed*case%mechanism%contact_width, words)
         if (allocated(error)) return
         if (range(2) - range(1) > 0.1_wp*case%mechanism%contact_width) jumping = jumping + 1
      end do
      call check(error, jumping >= loads/2, "the place does not jump")
   end subroutine test_jumps

   subroutine test_remarks(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%roller_profile = roller_profile_t(tilt=1.0e-3_wp)
      call run_case(case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, any(result%remarks%kind == cut_off_contact) .and. any(result%remarks%kind == unloaded_end), "askew")
      if (allocated(error)) return
      case%roller_profile = profiles(1)
      call run_case(case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, .not. any(result%remarks%kind == cut_off_contact .or. result%remarks%kind == unloaded_end), "crowned")
      if (allocated(error)) return
      ! The film of the base circle at 25 degC is as thick as a tilt of 0.1 mrad is deep; a roller that stands straight has none
      call set_point(case, point_speeds(1), point_viscosities(1))
      case%roller_profile = roller_profile_t(tilt=1.0e-4_wp)
      call run_case(case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, any(result%remarks%kind == oiled_slices), "oil beside the dry contact")
      if (allocated(error)) return
      case%roller_profile = roller_profile_t()
      call run_case(case, result, failure)
      if (has_failed(failure, error)) return
      call check(error, .not. any(result%remarks%kind == oiled_slices), "a cylinder that stands straight")
   end subroutine test_remarks

end module test_axial_follower
