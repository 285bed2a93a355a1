!> Law of the boundary coefficient: logarithm and straight line, tables, what asperities make of it.
module test_boundary_law
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_asperity, only : boundary_friction_t, find_boundary_friction, friction_modifier_t
   use camroller_boundary_law, only : boundary_curve_t, boundary_law_t, evaluate_boundary_curve, new_boundary_curve
   use camroller_case, only : case_t
   use camroller_conjunction, only : flash_resistance
   use camroller_effect_list, only : effect_boundary_law, leave_out
   use camroller_error, only : error_t, kind_deck
   use camroller_kinds, only : wp
   use camroller_model, only : model_t, new_model, set_operating_point
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use camroller_state, only : evaluate_state, state_t
   use reference_cases, only : add_heat, make_model, set_point, thesis_case
   use closeness, only : expect_error, has_failed
   implicit none
   private

   public :: collect_boundary_law

contains

   subroutine collect_boundary_law(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the logarithm and the straight line, by hand", test_logarithm), &
         new_unittest("a table has its values at its points, parabolas between, and is level beyond", test_table), &
         new_unittest("slopes of both laws against central differences", test_slopes), &
         new_unittest("a law that changes nothing changes no bit", test_nothing), &
         new_unittest("covered parts count in proportion: bare, tribofilm, friction modifier", test_mixture), &
         new_unittest("the coefficient follows the oil temperature of a host", test_host), &
         new_unittest("with heat, the coefficient is that of the surfaces' own temperature", test_heat), &
         new_unittest("without its law a case has the coefficient at the references, or the mean of the table", test_left_out), &
         new_unittest("impossible laws are refused with a message", test_refusals) &
         ]
   end subroutine collect_boundary_law

   !> 0.12 at 0.1 m/s and 373.15 K, 0.01 a decade, -2e-4 per kelvin
   pure function usual() result(law)
      type(boundary_law_t) :: law

      law%reference_speed = 0.1_wp
      law%reference_temperature = 373.15_wp
      law%change_per_decade = 0.01_wp
      law%temperature_slope = -2.0e-4_wp
      law%lowest_speed = 1.0e-4_wp
   end function usual

   !> A table of four speeds and three temperatures
   pure function tabulated() result(law)
      type(boundary_law_t) :: law

      law%law = "table"
      law%speed_points = [1.0e-3_wp, 1.0e-2_wp, 0.2_wp, 1.0_wp]
      law%temperature_points = [300.0_wp, 360.0_wp, 400.0_wp]
      law%coefficient_points = [0.10_wp, 0.11_wp, 0.13_wp, 0.12_wp, 0.09_wp, 0.10_wp, 0.11_wp, 0.12_wp, 0.12_wp, 0.12_wp, &
         & 0.14_wp, 0.15_wp]
   end function tabulated

   subroutine test_left_out(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      case = thesis_case()
      case%asperity%boundary_coefficient = 0.17_wp
      case%boundary_law = usual()
      call leave_out(case, effect_boundary_law)
      call check(error, .not. allocated(case%boundary_law) .and. abs(case%asperity%boundary_coefficient - 0.17_wp) <= 0.0_wp)
      if (allocated(error)) return
      case%boundary_law = tabulated()
      ! of twelve points with a mean of 0.1175 that at 0.15 is cut by 0.006
      case%boundary_law%largest = 0.144_wp
      call leave_out(case, effect_boundary_law)
      call check(error, .not. allocated(case%boundary_law) .and. abs(case%asperity%boundary_coefficient - 0.117_wp) < 1.0e-15_wp)
   end subroutine test_left_out

   subroutine test_logarithm(error)
      type(error_type), allocatable, intent(out) :: error
      type(boundary_law_t) :: law
      type(boundary_curve_t) :: curve
      type(error_t), allocatable :: failure
      ! Coefficient, slopes [-], [s/m], [1/K]
      real(wp) :: value, by_speed, by_temperature
      integer :: i

      law = usual()
      call new_boundary_curve(curve, law, 0.12_wp, failure)
      do i = -2, 2
         ! at 10^i times the reference speed, where the lowest speed is a millionth of its square or less
         call evaluate_boundary_curve(curve, -0.1_wp*10.0_wp**i, 373.15_wp + 10.0_wp*i, value, by_speed, by_temperature)
         call check(error, abs(value - (0.12_wp + 0.01_wp*i - 2.0e-3_wp*i)) < 3.0e-7_wp .or. i == -2, "value")
         if (allocated(error)) return
         call check(error, abs(by_temperature + 2.0e-4_wp) <= 0.0_wp, "slope over the temperature")
         if (allocated(error)) return
      end do
      ! at rest: half of the logarithm of (v_0/v_r)^2, here -3 decades less 5e-7 of 1/(2 ln 10)
      call evaluate_boundary_curve(curve, 0.0_wp, 373.15_wp, value, by_speed, by_temperature)
      call check(error, abs(value - 0.09_wp) < 1.0e-8_wp .and. abs(by_speed) <= 0.0_wp, "at rest")
      if (allocated(error)) return
      call evaluate_boundary_curve(curve, 0.1_wp, 2000.0_wp, value, by_speed, by_temperature)
      call check(error, abs(value) <= 0.0_wp .and. max(abs(by_speed), abs(by_temperature)) <= 0.0_wp, "lower bound")
      if (allocated(error)) return
      law%largest = 0.121_wp
      call new_boundary_curve(curve, law, 0.12_wp, failure)
      call evaluate_boundary_curve(curve, 1.0_wp, 373.15_wp, value, by_speed, by_temperature)
      call check(error, abs(value - 0.121_wp) <= 0.0_wp .and. max(abs(by_speed), abs(by_temperature)) <= 0.0_wp, "upper bound")
   end subroutine test_logarithm

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(boundary_law_t) :: law
      type(boundary_curve_t) :: curve
      type(error_t), allocatable :: failure
      ! Coefficient, slopes [-], [s/m], [1/K]
      real(wp) :: value, by_speed, by_temperature
      integer :: i, j

      law = tabulated()
      call new_boundary_curve(curve, law, 0.5_wp, failure)
      do j = 1, 3
         do i = 1, 4
            call evaluate_boundary_curve(curve, (-1)**i*law%speed_points(i), law%temperature_points(j), value, by_speed, &
               & by_temperature)
            call check(error, abs(value - law%coefficient_points(4*j - 4 + i)) < 10.0_wp*epsilon(1.0_wp), "point")
            if (allocated(error)) return
         end do
      end do
      call evaluate_boundary_curve(curve, 0.0_wp, 100.0_wp, value, by_speed, by_temperature)
      call check(error, abs(value - 0.10_wp) <= 0.0_wp .and. abs(by_speed) + abs(by_temperature) <= 0.0_wp, "cold, at rest")
      if (allocated(error)) return
      call evaluate_boundary_curve(curve, -30.0_wp, 700.0_wp, value, by_speed, by_temperature)
      call check(error, abs(value - 0.15_wp) <= 0.0_wp .and. abs(by_speed) + abs(by_temperature) <= 0.0_wp, "hot, fast")
      if (allocated(error)) return
      ! inner pieces have a parabola's slopes at both ends, so that a parabola of the temperature is itself
      law%temperature_points = [300.0_wp, 330.0_wp, 350.0_wp, 410.0_wp]
      law%speed_points = [1.0_wp]
      law%coefficient_points = 0.1_wp + 1.0e-5_wp*(law%temperature_points - 340.0_wp)**2
      call new_boundary_curve(curve, law, 0.5_wp, failure)
      call evaluate_boundary_curve(curve, 3.0_wp, 344.0_wp, value, by_speed, by_temperature)
      call check(error, abs(value - 0.1_wp - 1.6e-4_wp) < 10.0_wp*epsilon(1.0_wp) .and. abs(by_temperature - 8.0e-5_wp) &
         & < 1.0e-15_wp, "parabola")
   end subroutine test_table

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(boundary_curve_t) :: curve
      type(error_t), allocatable :: failure
      ! Coefficient, slopes, at both sides [-], [s/m], [1/K]; speed [m/s]
      real(wp) :: value, by_speed, by_temperature, ahead, behind, unused(2), speed
      real(wp), parameter :: h = 6.0e-6_wp
      integer :: i, k

      do k = 1, 2
         if (k == 1) call new_boundary_curve(curve, usual(), 0.12_wp, failure)
         if (k == 2) call new_boundary_curve(curve, tabulated(), 0.12_wp, failure)
         do i = 1, 60
            speed = (-1)**i*10.0_wp**(-4.05_wp + 0.08_wp*i)
            associate (temperature => 290.0_wp + 2.13_wp*i)
               call evaluate_boundary_curve(curve, speed, temperature, value, by_speed, by_temperature)
               call evaluate_boundary_curve(curve, speed*(1.0_wp + h), temperature, ahead, unused(1), unused(2))
               call evaluate_boundary_curve(curve, speed*(1.0_wp - h), temperature, behind, unused(1), unused(2))
               ! truncation h^2 times third derivatives, round-off over h
               call check(error, abs((ahead - behind)/(2.0_wp*h) - by_speed*speed) < 1.0e-10_wp, "speed")
               if (allocated(error)) return
               call evaluate_boundary_curve(curve, speed, temperature*(1.0_wp + h), ahead, unused(1), unused(2))
               call evaluate_boundary_curve(curve, speed, temperature*(1.0_wp - h), behind, unused(1), unused(2))
               call check(error, abs((ahead - behind)/(2.0_wp*h) - by_temperature*temperature) < 1.0e-8_wp, "temperature")
               if (allocated(error)) return
            end associate
         end do
      end do
   end subroutine test_slopes

   !> A law without slopes, by another path of the program; with and without heat
   subroutine test_nothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, plain
      type(result_t) :: with, without
      type(error_t), allocatable :: failure
      integer :: k, i

      do k = 1, 2
         plain = thesis_case()
         if (k == 2) call add_heat(plain)
         case = plain
         case%boundary_law = usual()
         case%boundary_law%change_per_decade = 0.0_wp
         case%boundary_law%temperature_slope = 0.0_wp
         ! the bound takes part in a scale of the integration
         case%boundary_law%largest = case%asperity%boundary_coefficient
         call run_case(case, with, failure)
         if (.not. allocated(failure)) call run_case(plain, without, failure)
         if (has_failed(failure, error)) return
         do i = 1, size(without%series)
            call check(error, find_quantity(with%series, without%series(i)%name) > 0, "series "//without%series(i)%name)
            if (allocated(error)) return
            call check(error, all(abs(with%series_values(:, find_quantity(with%series, without%series(i)%name)) &
               & - without%series_values(:, i)) <= 0.0_wp), "another bit in "//without%series(i)%name)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_nothing

   subroutine test_mixture(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(boundary_friction_t) :: friction
      ! Coefficient and slopes of bare surfaces [-], [s/m], [1/K]
      real(wp) :: bare, by_speed, by_temperature
      real(wp), parameter :: speed = 0.03_wp, rise = 25.0_wp, covered = 0.3_wp

      case = thesis_case()
      case%operating_point%oil_temperature = 343.15_wp
      case%boundary_law = usual()
      case%friction_modifier = friction_modifier_t(0.06_wp, 0.5_wp, 343.15_wp, 40.0e3_wp, 1.0_wp)
      call make_model(case, model, error)
      if (allocated(error)) return
      call evaluate_boundary_curve(model%boundary%curve, speed, 343.15_wp + rise, bare, by_speed, by_temperature)
      model%boundary%film_coefficient = 0.11_wp
      call find_boundary_friction(model%boundary, speed, rise, covered, friction)
      ! half of everything is covered by the modifier, at the temperature of the oil
      call check(error, abs(friction%coefficient - 0.5_wp*(0.7_wp*bare + 0.3_wp*0.11_wp) - 0.5_wp*0.06_wp) < 10.0_wp &
         & *epsilon(1.0_wp), "coefficient")
      if (allocated(error)) return
      call check(error, abs(friction%by_speed - 0.35_wp*by_speed) < 1.0e-15_wp .and. abs(friction%by_temperature - 0.35_wp &
         & *by_temperature) < 1.0e-15_wp .and. abs(friction%by_covered - 0.5_wp*(0.11_wp - bare)) < 1.0e-15_wp, "slopes")
   end subroutine test_mixture

   subroutine test_host(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, again
      type(boundary_friction_t) :: one, other
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%operating_point%oil_temperature = 300.0_wp
      case%boundary_law = usual()
      call make_model(case, model, error)
      if (allocated(error)) return
      call set_operating_point(model, model%speed, 380.0_wp, failure)
      case%operating_point%oil_temperature = 380.0_wp
      if (.not. allocated(failure)) call new_model(again, case, 1, failure)
      if (has_failed(failure, error)) return
      call find_boundary_friction(model%boundary, 0.1_wp, 0.0_wp, 0.0_wp, one)
      call find_boundary_friction(again%boundary, 0.1_wp, 0.0_wp, 0.0_wp, other)
      call check(error, abs(one%coefficient - other%coefficient) <= 0.0_wp .and. abs(one%coefficient &
         & - (case%asperity%boundary_coefficient - 2.0e-4_wp*(380.0_wp - 373.15_wp))) < 1.0e-15_wp)
   end subroutine test_host

   !> The temperature is that which the heat of all friction makes, by the formula of moving heat sources
   subroutine test_heat(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Coefficient, its slopes [-], [s/m], [1/K]; resistance [m^2 K/W], slopes of it; rise [K]
      real(wp) :: value, unused(2), flash, by_width, by_speed(2), rise
      integer :: status, k

      do k = 1, 2
         case = thesis_case()
         case%boundary_law = usual()
         case%boundary_law%temperature_slope = merge(-1.0e-3_wp, 1.0e-3_wp, k == 1)
         call add_heat(case)
         case%surface%cam_roughness = 10.0_wp*case%surface%cam_roughness
         call set_point(case, 300.0_wp, 0.004_wp)
         call make_model(case, model, error)
         if (allocated(error)) return
         call evaluate_state(model, 0.3_wp, 3.0_wp, state, status)
         call check(error, status, 0)
         if (allocated(error)) return
         associate (contact => state%contact)
            call flash_resistance(model%heat%band, model%heat%bodies, contact%half_width, [contact%cam_surface_speed, &
               & contact%roller_surface_speed], flash, by_width, by_speed)
            rise = flash*abs(contact%sliding_speed)*(abs(contact%shear) + abs(contact%boundary_mobilised))/contact%apparent_area
            call check(error, contact%flash_rise > 1.0_wp .and. abs(contact%flash_rise - rise) < 1.0e-9_wp*rise, "rise")
            if (allocated(error)) return
            call evaluate_boundary_curve(model%boundary%curve, 3.0_wp, case%operating_point%oil_temperature + rise, value, &
               & unused(1), unused(2))
            call check(error, abs(contact%boundary_coefficient - value) < 1.0e-10_wp .and. contact%asperity_load > 1.0_wp, &
               & "coefficient")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_heat

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 10
         case = thesis_case()
         case%boundary_law = usual()
         if (i > 5) case%boundary_law = tabulated()
         if (i == 1) case%boundary_law%lowest_speed = 0.0_wp
         if (i == 2) case%boundary_law%reference_speed = -1.0_wp
         if (i == 3) case%boundary_law%smallest = -0.1_wp
         if (i == 4) case%boundary_law%largest = -0.1_wp
         if (i == 5) case%boundary_law%law = "cubic"
         if (i == 6) case%boundary_law%speed_points(2) = 1.0_wp
         if (i == 7) case%boundary_law%temperature_points = [300.0_wp, 290.0_wp, 400.0_wp]
         if (i == 8) case%boundary_law%coefficient_points(3) = -0.1_wp
         if (i == 9) case%boundary_law%speed_points = [1.0_wp, 2.0_wp]
         if (i == 10) deallocate (case%boundary_law%temperature_points)
         call new_model(model, case, 1, failure)
         call expect_error(error, failure, kind_deck, "boundary law")
         if (allocated(error)) return
      end do
   end subroutine test_refusals

end module test_boundary_law
