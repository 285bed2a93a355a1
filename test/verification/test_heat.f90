!> Heat in inlet and contact of a follower.
module test_heat
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_conjunction, only : flash_resistance, film_resistance, warm_oil
   use camroller_contact, only : contact_basis_t, solve_at_speeds
   use camroller_contact_forces, only : contact_t, set_speeds
   use camroller_contact_traction, only : set_traction
   use camroller_heat, only : heat_t, inlet_factor
   use camroller_kinematics, only : rotation_names
   use camroller_lubricant, only : get_oil, oil_t, pressure_law_names
   use camroller_model, only : model_t, new_model
   use camroller_remarks, only : hot_film, hot_inlet, remark_lines
   use camroller_result, only : result_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_traction, only : cap_names
   use case_twins, only : leave_constants_out, rescale_case
   use closeness, only : check_close, check_scaled, expect_error, has_failed
   use lobe_cases, only : run
   use energy_checks, only : check_energy
   use reference_cases, only : thesis_case, skewed_case, make_model, set_point, add_gas_force, add_heat, point_speeds, &
      & point_viscosities
   use unit_systems, only : unit_systems_tried, scaled, compare, speed, number, temperature, force
   implicit none
   private

   public :: collect_heat

contains

   subroutine collect_heat(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("friction and film temperature are consistent at any slip", test_root), &
         new_unittest("the temperature that a film is tried at first, however low or high, has no part in its own", test_start), &
         new_unittest("energy closes at 720 angles with heat, for both senses of rotation, with gas force", test_energy), &
         new_unittest("bodies of infinite conductivity and an oil whose viscosity ignores temperature change no bit", test_cold), &
         new_unittest("results are the same in other units", test_units), &
         new_unittest("a remark names the angles where the inlet factor is beyond its range", test_remark), &
         new_unittest("a remark names rise and error of a film that is hotter than its oil is good for", test_hot_film), &
         new_unittest("a film sheared at its mean temperature is as far from the closed form as is said", test_closed_form), &
         new_unittest("an estimated pressure-viscosity coefficient that rises in the cold is held in a hot film", test_cold_oil), &
         new_unittest("incomplete or contradictory cases with heat are refused", test_refusals) &
         ]
   end subroutine collect_heat

   subroutine test_root(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Sliding speeds over the cam's speed [m]
      real(wp), parameter :: slides(6) = [0.0_wp, 1.0e-9_wp, -1.0e-5_wp, 1.0e-3_wp, -1.0e-2_wp, 3.0e-2_wp]
      ! Rises per flux [m^2 K/W], heat of shear and of boundary friction [W/m^2]
      real(wp) :: flash, layer, unused, pair(2), sheared, rubbed
      integer :: i, k, law, status

      do law = 1, 6
         case = thesis_case()
         call add_heat(case)
         case%traction%shear_law = merge("newtonian", "eyring   ", law <= 3)
         case%traction%eyring_stress = 5.0e6_wp
         case%lubricant%pressure_law = pressure_law_names(1 + mod(law, 3))
         call set_point(case, point_speeds(1 + mod(law, 3)), point_viscosities(1 + mod(law, 3)))
         case%traction%cap = cap_names(merge(1, 2, law < 4))
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = -65, 65, 10
            do k = 1, size(slides)
               call evaluate_state(model, i*degree, slides(k)*model%speed, state, status)
               call check(error, status, 0)
               if (allocated(error)) return
               associate (contact => state%contact)
                  call flash_resistance(model%heat%band, model%heat%bodies, contact%half_width, &
                     & [contact%cam_surface_speed, contact%roller_surface_speed], flash, unused, pair)
                  layer = film_resistance(contact%film_central, model%heat%oil_conductivity)
                  sheared = contact%shear*contact%sliding_speed/contact%apparent_area
                  rubbed = contact%boundary_mobilised*contact%sliding_speed/contact%apparent_area
                  call check_scaled(error, contact%flash_rise, flash*(sheared + rubbed), contact%flash_rise, 1.0e-11_wp, "surfaces")
                  if (allocated(error)) return
                  ! what is left after the last step is its square; the load's last step moves the shear alone
                  call check_scaled(error, contact%film_rise, contact%flash_rise + layer*sheared &
                     & /(1.0_wp - contact%real_area/contact%apparent_area), contact%film_rise, 1.0e-10_wp, "film")
                  if (allocated(error)) return
                  call check(error, contact%film_rise >= 0.0_wp .and. contact%film_rise < 1.0e3_wp)
                  if (allocated(error)) return
               end associate
            end do
         end do
      end do
   end subroutine test_root

   subroutine test_start(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      type(contact_t) :: contact
      type(contact_basis_t) :: basis
      ! Temperature and shear from nothing [K], [N]; the hottest film [K]
      real(wp) :: rise, shear, hottest
      integer :: i, decade, status

      case = thesis_case()
      call add_heat(case)
      ! Boundary friction warms the film, so that it would never be tried cold
      deallocate (case%asperity)
      call set_point(case, point_speeds(3), point_viscosities(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      hottest = 0.0_wp
      do i = -65, 65, 10
         call evaluate_state(model, i*degree, 3.0e-2_wp*model%speed, state, status)
         associate (position => state%position)
            call set_speeds(model, position, state%contact%sliding_speed, contact)
            call solve_at_speeds(model, position, state%moments, contact, basis, status)
         end associate
         call check(error, status, 0)
         if (allocated(error)) return
         contact%film_rise = 0.0_wp
         call set_traction(model, basis%setting, contact, basis%parts)
         rise = contact%film_rise
         shear = contact%shear
         hottest = max(hottest, rise)
         do decade = -16, 3
            contact%film_rise = 10.0_wp**decade
            call set_traction(model, basis%setting, contact, basis%parts)
            ! what is left after the last step is its square
            call check_close(error, contact%film_rise, rise, 1.0e-10_wp, "temperature")
            if (allocated(error)) return
            call check_close(error, contact%shear, shear, 1.0e-10_wp, "shear")
            if (allocated(error)) return
         end do
      end do
      call check(error, hottest > 1.0_wp, "heat does nothing here")
   end subroutine test_start

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(state_t), allocatable :: states(:)
      integer :: sense

      do sense = 1, 2
         case = skewed_case(rotation_names(sense))
         call add_gas_force(case)
         call add_heat(case)
         call set_point(case, point_speeds(3), point_viscosities(1))
         call check_energy(case, states, error)
         if (allocated(error)) return
         call check(error, maxval(states%contact%film_rise) > 0.1_wp .and. minval(states%contact%inlet_factor) < 0.99_wp, &
            & "heat does nothing here")
         if (allocated(error)) return
      end do
   end subroutine test_energy

   subroutine test_cold(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, cold
      type(state_t) :: state, other
      integer :: i, status

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call add_heat(case)
      case%heat%inlet_law = "none"
      case%heat%contact = "none"
      call make_model(case, cold, error)
      if (allocated(error)) return
      do i = -60, 60, 5
         call evaluate_state(model, i*degree, 0.01_wp, state, status)
         call evaluate_state(cold, i*degree, 0.01_wp, other, status)
         call check(error, .not. (abs(other%contact%load - state%contact%load) > 0.0_wp &
            & .or. abs(other%contact%traction - state%contact%traction) > 0.0_wp &
            & .or. abs(other%contact%film_min - state%contact%film_min) > 0.0_wp), "heat without laws changes bits")
         if (allocated(error)) return
      end do
      ! an oil that hardly thins between bodies that carry all heat away: nothing changes but rounding
      case%heat = heat_t("murch_wilson", "mean", 1.0e12_wp, 1.0e-14_wp, 0.0_wp, 1.0e12_wp)
      call make_model(case, cold, error)
      if (allocated(error)) return
      call evaluate_state(model, 0.2_wp, 0.01_wp, state, status)
      call evaluate_state(cold, 0.2_wp, 0.01_wp, other, status)
      call check_close(error, other%contact%traction, state%contact%traction, 1.0e-11_wp, "traction of a film that stays cold")
   end subroutine test_cold

   subroutine test_units(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, other
      type(model_t) :: model, twin
      type(state_t) :: state, twin_state
      integer :: i, k, status

      case = thesis_case()
      call add_heat(case)
      call leave_constants_out(case)
      case%traction%shear_law = "eyring"
      case%traction%eyring_stress = 5.0e6_wp
      call set_point(case, point_speeds(3), point_viscosities(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      do i = 1, size(unit_systems_tried)
         other = case
         call rescale_case(other, unit_systems_tried(i))
         call make_model(other, twin, error)
         if (allocated(error)) return
         do k = -60, 60, 10
            call evaluate_state(model, k*degree, 2.0e-3_wp*model%speed, state, status)
            call evaluate_state(twin, k*degree, scaled(unit_systems_tried(i), 2.0e-3_wp*model%speed, speed), twin_state, status)
            call compare(error, "factor", unit_systems_tried(i), number, [state%contact%inlet_factor], &
               & [twin_state%contact%inlet_factor])
            if (allocated(error)) return
            call compare(error, "rise", unit_systems_tried(i), temperature, [state%contact%film_rise], &
               & [twin_state%contact%film_rise])
            if (allocated(error)) return
            call compare(error, "traction", unit_systems_tried(i), force, [state%contact%traction], [twin_state%contact%traction])
            if (allocated(error)) return
         end do
      end do
   end subroutine test_units

   subroutine test_remark(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      integer :: i

      do i = 1, 2
         case = thesis_case()
         call add_heat(case)
         call set_point(case, point_speeds(3), point_viscosities(1))
         ! the film becomes so thin that the equation is stiff
         case%numerics%method = "rodas5p"
         ! an oil that conducts so little has 1e5 times the L, with which the pressure's part grows
         if (i == 2) case%heat%oil_conductivity = 1.0e-5_wp*case%heat%oil_conductivity
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, any(result%remarks%kind == hot_inlet) .eqv. i == 2, remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_remark

   !> Bodies that conduct badly keep the heat of a roller on cold oil that its bearing brakes.
   subroutine test_hot_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      integer :: i

      do i = 1, 3
         case = thesis_case()
         call set_point(case, point_speeds(3), point_viscosities(1))
         case%operating_point%oil_temperature = 273.15_wp
         case%lubricant%temperature_law = merge("walther", "vogel  ", i < 3)
         case%lubricant%temperature_points = [298.15_wp, 333.15_wp, 368.15_wp]
         case%lubricant%viscosity_points = [0.15_wp, 0.0305_wp, 0.01_wp]
         if (i < 3) case%lubricant%temperature_points = [298.15_wp, 368.15_wp]
         if (i < 3) case%lubricant%viscosity_points = [0.15_wp, 0.01_wp]
         allocate (case%heat)
         case%heat%conductivity = 5.0_wp
         if (i > 1) case%needle_bearing%friction_coefficient = 0.1_wp
         call run(case, result, error)
         if (allocated(error)) return
         call check(error, any(result%remarks%kind == hot_film) .eqv. i == 2, remark_lines(result%remarks))
         if (allocated(error)) return
         if (i == 2) call check(error, index(remark_lines(result%remarks), " K warmer than the oil, at cam angle ") > 0 .and. &
            & index(remark_lines(result%remarks), " % below what the lubricant has; the oil of a hot film is within 1 %") > 0, &
            & remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_hot_film

   !> Film between cold surfaces, whose viscosity falls exponentially (Nahme 1940): shear over that of a cold film is
   !> `asinh(x)/(x sqrt(1 + x^2))` with `8 x^2 = beta eta V^2/k`; that at the mean temperature is `exp(-theta)` with
   !> `12 theta exp(theta) = 8 x^2`. The table is that of theory section 10.1.
   subroutine test_closed_form(error)
      type(error_type), allocatable, intent(out) :: error
      ! Mean rise of the film times the fall of ln(viscosity), shear by the mean temperature over that of the closed form [-]
      real(wp), parameter :: rises(6) = [0.25_wp, 0.5_wp, 1.0_wp, 1.35_wp, 2.2_wp, 3.0_wp], ratios(6) = [1.016_wp, 1.052_wp, &
         & 1.15_wp, 1.23_wp, 1.40_wp, 1.53_wp]
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      type(contact_t) :: contact
      type(contact_basis_t) :: basis
      real(wp) :: cold, x ! shear of the cold film [N], group of the closed form [-]
      integer :: i, status

      case = thesis_case()
      call add_heat(case)
      deallocate (case%asperity)
      case%heat%inlet_law = "none"
      case%heat%conductivity = 1.0e12_wp
      case%heat%limit_fall = 0.0_wp
      case%traction%limiting_coefficient = 1.0e6_wp
      call set_point(case, point_speeds(3), point_viscosities(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_state(model, 20.0_wp*degree, 3.0e-2_wp*model%speed, state, status)
      call set_speeds(model, state%position, state%contact%sliding_speed, contact)
      call solve_at_speeds(model, state%position, state%moments, contact, basis, status)
      call check(error, status, 0)
      if (allocated(error)) return
      model%heat%oil_conductivity = 1.0e12_wp
      call set_traction(model, basis%setting, contact, basis%parts)
      cold = contact%shear
      do i = 1, size(rises)
         model%heat%oil_conductivity = case%heat%viscosity_fall*contact%film_central*abs(cold*contact%sliding_speed) &
            & /(12.0_wp*contact%sheared_area*rises(i)*exp(rises(i)))
         call set_traction(model, basis%setting, contact, basis%parts)
         call check_close(error, case%heat%viscosity_fall*contact%film_rise, rises(i), 1.0e-6_wp, "mean rise")
         if (allocated(error)) return
         x = sqrt(1.5_wp*rises(i)*exp(rises(i)))
         call check_close(error, contact%shear/cold, ratios(i)*asinh(x)/(x*hypot(1.0_wp, x)), 4.0e-3_wp, "shear")
         if (allocated(error)) return
      end do
   end subroutine test_closed_form

   !> A 5W-30 at -30 and at 40 degC: where the coefficient grew with the temperature, so did shear, and a film would have several
   !> temperatures.
   subroutine test_cold_oil(error)
      type(error_type), allocatable, intent(out) :: error
      ! [K]
      real(wp), parameter :: temperatures(2) = [243.15_wp, 313.15_wp], rise = 30.0_wp
      type(case_t) :: case
      type(model_t) :: model
      type(oil_t) :: oil, warm
      type(error_t), allocatable :: failure
      real(wp) :: change, slope ! [-], [1/K]
      integer :: i

      case = thesis_case()
      case%lubricant%temperature_law = "data_sheet"
      case%lubricant%viscosity_at_40 = 64.0e-6_wp
      case%lubricant%viscosity_at_100 = 11.0e-6_wp
      case%lubricant%pressure_viscosity = 0.0_wp
      allocate (case%heat)
      do i = 1, size(temperatures)
         case%operating_point%oil_temperature = temperatures(i)
         call new_model(model, case, 1, failure)
         if (.not. allocated(failure)) call get_oil(case%lubricant, temperatures(i) + rise, oil, failure)
         if (has_failed(failure, error)) return
         call warm_oil(model%heat%hot, model%oil, rise, warm, change, slope)
         if (i == 1) then
            call check(error, oil%pressure_viscosity > 1.1_wp*model%oil%pressure_viscosity, "an estimate that does not rise")
            if (allocated(error)) return
            call check(error, warm%pressure_viscosity <= model%oil%pressure_viscosity, "it rises in a hot film")
         else
            call check_close(error, warm%pressure_viscosity, oil%pressure_viscosity, 1.0e-12_wp, "coefficient of a warm film")
         end if
         if (allocated(error)) return
      end do
   end subroutine test_cold_oil

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure

      case = thesis_case()
      allocate (case%heat)
      call new_model(model, case, 1, failure)
      call expect_error(error, failure, kind_deck, "viscosity_fall_per_K")
      if (allocated(error)) return
      case%heat%viscosity_fall = 0.05_wp
      case%heat%inlet_law = "warm"
      call new_model(model, case, 1, failure)
      call expect_error(error, failure, kind_deck, "law of heat in the inlet")
      if (allocated(error)) return
      case%heat%inlet_law = "gupta"
      case%heat%conductivity(2) = 0.0_wp
      call new_model(model, case, 1, failure)
      call expect_error(error, failure, kind_deck, "must be positive")
   end subroutine test_refusals

end module test_heat
