!> Friction modifier: its coverage, and the friction of asperities with it.
module test_friction_modifier
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_asperity, only : coverage, friction_modifier_t
   use camroller_case, only : case_t
   use camroller_error, only : error_t, kind_deck
   use camroller_kinds, only : wp
   use camroller_model, only : model_t, new_model, set_operating_point
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use reference_cases, only : make_model, thesis_case
   use closeness, only : expect_error, has_failed
   implicit none
   private

   public :: collect_friction_modifier

   !> Gas constant, CODATA 2018, exact [J/(mol K)]
   real(wp), parameter :: gas_constant = 8.31446261815324_wp
   !> Half of the surfaces covered at 60 degC, 40 kJ/mol
   type(friction_modifier_t), parameter :: usual = friction_modifier_t(0.06_wp, 0.5_wp, 333.15_wp, 40.0e3_wp, 1.0_wp)

contains

   subroutine collect_friction_modifier(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("coverage is Langmuir's isotherm with an equilibrium by Arrhenius", test_isotherm), &
         new_unittest("coverage lies between none and all at any temperature and concentration", test_limits), &
         new_unittest("a case with a modifier is that with the coefficient that follows, bit by bit", test_coefficient), &
         new_unittest("the coefficient follows the oil temperature of a host", test_host), &
         new_unittest("impossible modifiers are refused with a message", test_refusals) &
         ]
   end subroutine collect_friction_modifier

   !> `theta = K c/(1 + K c)`, `K = K_0 exp(-dH/(R T))`, from constants of our own
   subroutine test_isotherm(error)
      type(error_type), allocatable, intent(out) :: error
      type(friction_modifier_t) :: modifier
      ! K_0 [m^3/mol], dH [J/mol], concentration [mol/m^3]
      real(wp), parameter :: factor = 3.0e-7_wp, enthalpy = -45.0e3_wp, concentration = 2.0_wp
      real(wp) :: product
      integer :: i

      modifier = usual
      modifier%adsorption_heat = -enthalpy
      modifier%reference_temperature = 300.0_wp
      product = factor*concentration*exp(-enthalpy/(gas_constant*300.0_wp))
      modifier%reference_coverage = product/(1.0_wp + product)
      do i = 0, 40
         modifier%concentration_ratio = 0.5_wp + 0.1_wp*i
         associate (temperature => 250.0_wp + 5.0_wp*i)
            product = factor*concentration*modifier%concentration_ratio*exp(-enthalpy/(gas_constant*temperature))
            ! the gas constant has ten digits; its exponent is up to 22
            call check(error, abs(coverage(modifier, temperature)/(product/(1.0_wp + product)) - 1.0_wp) < 1.0e-9_wp)
         end associate
         if (allocated(error)) return
      end do
   end subroutine test_isotherm

   subroutine test_limits(error)
      type(error_type), allocatable, intent(out) :: error
      type(friction_modifier_t) :: modifier
      real(wp) :: before, now
      integer :: i

      call check(error, abs(coverage(usual, usual%reference_temperature) - 0.5_wp) < epsilon(1.0_wp), "reference")
      if (allocated(error)) return
      before = 1.0_wp
      do i = -3, 6
         now = coverage(usual, 333.15_wp*10.0_wp**i)
         call check(error, now >= 0.0_wp .and. now <= 1.0_wp .and. now <= before, "temperature")
         if (allocated(error)) return
         before = now
      end do
      modifier = usual
      before = 0.0_wp
      do i = -300, 300, 50
         modifier%concentration_ratio = 10.0_wp**i
         now = coverage(modifier, 333.15_wp)
         call check(error, now >= before .and. now <= 1.0_wp, "concentration")
         if (allocated(error)) return
         before = now
      end do
      call check(error, abs(now - 1.0_wp) <= 0.0_wp, "all of it")
   end subroutine test_limits

   subroutine test_coefficient(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, plain
      type(model_t) :: model
      type(result_t) :: with, without
      type(error_t), allocatable :: failure
      integer :: k

      do k = 1, 3
         plain = thesis_case()
         case = plain
         case%operating_point%oil_temperature = 343.15_wp
         plain%operating_point%oil_temperature = 343.15_wp
         case%friction_modifier = usual
         ! one that does nothing, in the third round
         if (k == 3) case%friction_modifier%coefficient = plain%asperity%boundary_coefficient
         if (k == 2) case%asperity%mobilising_speed = 1.0e-2_wp
         plain%asperity%mobilising_speed = case%asperity%mobilising_speed
         call make_model(case, model, error)
         if (allocated(error)) return
         if (k < 3) call check(error, model%boundary%coefficient < 0.18_wp .and. model%boundary%coefficient > 0.06_wp, &
            & "coefficient")
         if (allocated(error)) return
         if (k < 3) plain%asperity%boundary_coefficient = model%boundary%coefficient
         call run_case(case, with, failure)
         if (.not. allocated(failure)) call run_case(plain, without, failure)
         if (has_failed(failure, error)) return
         call check(error, all(abs(with%series_values - without%series_values) <= 0.0_wp) .and. &
            & find_quantity(with%series, "torque_contact") > 0, "a bit is another")
         if (allocated(error)) return
      end do
   end subroutine test_coefficient

   subroutine test_host(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model, again
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%operating_point%oil_temperature = 300.0_wp
      case%friction_modifier = usual
      call make_model(case, model, error)
      if (allocated(error)) return
      call set_operating_point(model, model%speed, 380.0_wp, failure)
      case%operating_point%oil_temperature = 380.0_wp
      if (.not. allocated(failure)) call new_model(again, case, 1, failure)
      if (has_failed(failure, error)) return
      call check(error, abs(model%boundary%coefficient - again%boundary%coefficient) <= 0.0_wp .and. &
         & model%boundary%coefficient > 0.15_wp, "coefficient of another temperature")
   end subroutine test_host

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, 6
         case = thesis_case()
         case%operating_point%oil_temperature = 343.15_wp
         case%friction_modifier = usual
         if (i == 1) case%friction_modifier%reference_coverage = 1.0_wp
         if (i == 2) case%friction_modifier%reference_coverage = 0.0_wp
         if (i == 3) case%friction_modifier%coefficient = -0.1_wp
         if (i == 4) case%friction_modifier%adsorption_heat = -1.0_wp
         if (i == 5) case%friction_modifier%concentration_ratio = 0.0_wp
         if (i == 6) case%friction_modifier%reference_temperature = 0.0_wp
         call new_model(model, case, 1, failure)
         call expect_error(error, failure, kind_deck, "friction modifier: ")
         if (allocated(error)) return
      end do
   end subroutine test_refusals

end module test_friction_modifier
