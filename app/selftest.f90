!> The command `selftest`: key numbers of a small deck against values built in, in a few seconds and without any file.
!>
!> In: nothing. Out: a line for each number, machine and build; an error where a number differs.
module camroller_selftest
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_difference
   use camroller_case, only : case_t
   use camroller_case_loop, only : number_of_cores
   use camroller_deck, only : add_override, deck_t, make_case, override_t, parse_deck
   use camroller_number_text, only : integer_text, number_text
   use camroller_result, only : get_summary, result_t
   use camroller_run, only : run_case
   use camroller_streams, only : print_lines
   use camroller_version, only : build_commit, compiler_facts, version_text
   implicit none
   private

   public :: run_selftest

   !> One number: speed of the camshaft and oil temperature as in a deck, name, value
   type :: number_t
      character(len=8) :: speed, temperature
      character(len=24) :: name
      !> Value [SI unit]
      real(wp) :: value
   end type number_t

   !> Values of the debug and the release build, which agree to all digits shown
   type(number_t), parameter :: numbers(*) = [ &
      number_t("300", "25", "mean_torque_friction", 7.6285804e-02_wp), &
      number_t("300", "25", "mean_slip_ratio", 2.9284258e-01_wp), &
      number_t("300", "25", "max_hertz_pressure", 6.5040029e+08_wp), &
      number_t("900", "95", "mean_torque_friction", 2.9625383e-02_wp), &
      number_t("900", "95", "min_film_thickness_min", 1.0254528e-07_wp), &
      number_t("900", "95", "contact_loss_speed", 3.0757922e+02_wp)]

   !> Relative difference allowed: results keep an accuracy of 1e-4, and another processor may choose other steps [-]
   real(wp), parameter :: allowed = 3.0e-4_wp
   character(len=*), parameter :: n = new_line("a")

contains

   !> Compute the numbers, compare and say what machine and build it was.
   subroutine run_selftest(error)
      !> Difference where a number is another one; the case's error where it has no result
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(result_t) :: result
      type(override_t), allocatable :: overrides(:)
      ! Value of a number [SI unit]
      real(wp) :: value
      character(len=:), allocatable :: text, compiler, options
      integer :: i, wrong

      allocate (overrides(0))
      call parse_deck(deck, deck_text(), "selftest", "", overrides, error)
      if (allocated(error)) return
      call compiler_facts(compiler, options)
      text = "camroller "//version_text//", commit "//build_commit//n//compiler//n//integer_text(number_of_cores())//" cores"
      wrong = 0
      do i = 1, size(numbers)
         call run_point(deck, numbers(i)%speed, numbers(i)%temperature, result, error)
         if (.not. allocated(error)) call get_summary(result, trim(numbers(i)%name), value, error)
         if (allocated(error)) return
         text = text//n//trim(numbers(i)%speed)//" rev/min, "//trim(numbers(i)%temperature)//" degC: "//trim(numbers(i)%name)// &
            & " = "//number_text(value, 7)//", built in "//number_text(numbers(i)%value, 7)
         if (abs(value - numbers(i)%value) <= allowed*abs(numbers(i)%value)) cycle
         text = text//"  DIFFERS"
         wrong = wrong + 1
      end do
      if (wrong == 0) text = text//n//"all "//integer_text(size(numbers))//" numbers agree"
      call print_lines(text, error)
      if (wrong > 0) call raise(error, kind_difference, integer_text(wrong)//" of "//integer_text(size(numbers))// &
         & " numbers differ by more than "//number_text(allowed)//" of themselves: this build does not compute what it should")
   end subroutine run_selftest

   !> One operating point.
   subroutine run_point(deck, speed, temperature, result, error)
      type(deck_t), intent(in) :: deck
      !> Speed and temperature as in a deck
      character(len=*), intent(in) :: speed, temperature
      type(result_t), intent(out) :: result
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(override_t), allocatable :: overrides(:)

      allocate (overrides(0))
      call add_override(overrides, "operating_point.speed_rpm="//trim(speed))
      call add_override(overrides, "operating_point.oil_temperature_degC="//trim(temperature))
      call make_case(deck, overrides, case, error)
      if (.not. allocated(error)) call run_case(case, result, error)
   end subroutine run_point

   !> The deck.
   pure function deck_text() result(text)
      !> Its text
      character(len=:), allocatable :: text

      text = "&operating_point speed_rpm = 300 oil_temperature_degC = 25 /"//n// &
         & "&mechanism pivot_to_roller_mm = 20.8 pivot_to_pad_mm = 35.5 pivot_to_cam_mm = 31.5 roller_arm_angle_deg = -3.5"//n// &
         & "   valve_axis_angle_deg = 37.5 base_radius_mm = 18 contact_width_mm = 13.7 /"//n// &
         & "&roller radius_mm = 8.5 mass_kg = 0.0088 wall_thickness_mm = 2.4 /"//n// &
         & "&lift max_lift_mm = 9.5 opening_half_angle_deg = 70 exponents = 4 /"//n// &
         & "&masses valve_kg = 0.0432 finger_kg = 0.0418 /"//n// &
         & "&spring stiffness_N_m = 25000 precompression_mm = 8.4 base_circle_load_N = 64 /"//n// &
         & "&materials cam_modulus_GPa = 170 roller_modulus_GPa = 204 cam_poisson_ratio = 0.28 roller_poisson_ratio = 0.29 /"//n// &
         & "&surface cam_roughness_um = 0.14 roller_roughness_um = 0.14 /"//n// &
         & "&lubricant temperature_law = 'vogel' temperature_points_degC = 25, 60, 95 viscosity_points_Pa_s = 0.15, 0.0305, "// &
         & "0.01"//n//"   pressure_viscosity_coefficient_per_GPa = 22 /"//n//"&asperity boundary_coefficient = 0.2 /"//n// &
         & "&needle_bearing friction_coefficient = 0.0015 needle_radius_mm = 0.99 /"//n// &
         & "&cam_bearings law = 'long_full_sommerfeld' diameter_mm = 23 width_mm = 20 radial_clearance_um = 47.5"//n// &
         & "   bearing_positions_mm = 0, 60 cam_positions_mm = 30 /"//n// &
         & "&valve_guide length_mm = 36 stem_diameter_mm = 5 radial_clearance_um = 20 /"//n
   end function deck_text

end module camroller_selftest
