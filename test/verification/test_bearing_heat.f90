!> Heat balance of camshaft bearings.
module test_bearing_heat
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : two_pi, wp
   use camroller_bearing_asperity, only : bearing_asperity_t
   use camroller_bearing_heat, only : bearing_heat_t, oil_flow, temperature_rise
   use camroller_bearing_loads, only : belt_pull_t
   use camroller_case, only : case_t, operating_point_t
   use camroller_error, only : error_t, kind_deck, kind_domain, kind_usage
   use camroller_journal, only : journal_at_speed, journal_t
   use camroller_lubricant, only : get_oil, oil_t
   use camroller_number_text, only : number_text
   use camroller_remarks, only : far_temperature
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use camroller_shaft_simulation, only : shaft_simulation_t, start_shaft
   use closeness, only : expect_error, has_failed
   use deck_cases, only : get_deck_case
   use reference_cases, only : add_joints, point_speeds, set_point, thesis_case
   use lobe_cases, only : run, three_bearings
   use result_checks, only : scalar_of
   implicit none
   private

   public :: collect_bearing_heat

   !> Temperature of the supply [K]
   real(wp), parameter :: supply = 298.15_wp
   !> Speed [rad/s]
   real(wp), parameter :: speed = point_speeds(3)
   !> Error of the balance from means of the result to the accuracy of the case, 1e-5, and less of the bearings' own [-]
   real(wp), parameter :: usual = 3.0e-5_wp

contains

   subroutine collect_bearing_heat(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("side flow is what enters a short bearing at its widest film less what passes the narrowest", test_flow), &
         new_unittest("rise of temperature by hand", test_rise), &
         new_unittest("each bearing has the temperature at which its oil carries its friction away", test_balance), &
         new_unittest("a bearing with heat is one without in oil of its temperature", test_twin), &
         new_unittest("heat that goes into the metal alone changes nothing; heat changes the bearings alone", test_bits), &
         new_unittest("heat with mixed friction and orbits", test_together), &
         new_unittest("bearings whose asperities rub the more the warmer they are have their balance", test_rubbing), &
         new_unittest("oil that warms stays at the lowest balance, below those at which asperities rub", test_lowest), &
         new_unittest("the balance is as good as the accuracy asks for", test_accuracy), &
         new_unittest("oil of any bearing hotter than the points of its viscosity is told, with series or without", test_far_oil), &
         new_unittest("impossible heat is refused with a message", test_refusals) &
         ]
   end subroutine collect_bearing_heat

   !> In the short bearing the flow along the film is that of the moving surface, `omega r h/2` for each width, there
   subroutine test_flow(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      ! Flow into the half of the film that carries the load and out of it [m^3/s]
      real(wp) :: into, out
      real(wp), parameter :: e = 0.6_wp, diameter = 0.03_wp, width = 0.01_wp, clearance = 4.0e-5_wp

      journal = journal_at_speed(2, diameter, width, clearance, 0.01_wp, speed)
      into = 0.5_wp*speed*0.5_wp*diameter*width*clearance*(1.0_wp + e)
      out = 0.5_wp*speed*0.5_wp*diameter*width*clearance*(1.0_wp - e)
      call check(error, abs(oil_flow(journal, speed, e)/(into - out) - 1.0_wp) < 100.0_wp*epsilon(1.0_wp), "short")
      if (allocated(error)) return
      ! ISO 7902-1 in its own form: D^3 psi omega/4 (B/D - 0.223 (B/D)^3) e
      journal = journal_at_speed(3, diameter, width, clearance, 0.01_wp, speed)
      into = diameter**3*clearance/(0.5_wp*diameter)*speed/4.0_wp*(width/diameter - 0.223_wp*(width/diameter)**3)*e
      call check(error, abs(oil_flow(journal, -speed, e)/into - 1.0_wp) < 100.0_wp*epsilon(1.0_wp), "finite")
   end subroutine test_flow

   subroutine test_rise(error)
      type(error_type), allocatable, intent(out) :: error

      ! 5 W into 0.2 cm^3/s of 900 kg/m^3 and 2000 J/(kg K): leaves 13.9 K warmer, half of that in the mean
      call check(error, abs(temperature_rise(bearing_heat_t(2000.0_wp, 1.0_wp), 900.0_wp, 5.0_wp, 0.2e-6_wp) - 125.0_wp/18.0_wp) &
         & < 1.0e-13_wp)
      if (allocated(error)) return
      call check(error, abs(temperature_rise(bearing_heat_t(2000.0_wp, 0.0_wp), 900.0_wp, 5.0_wp, 0.2e-6_wp)) <= 0.0_wp, "no share")
      if (allocated(error)) return
      call check(error, temperature_rise(bearing_heat_t(2000.0_wp, 1.0_wp), 900.0_wp, 5.0_wp, 0.0_wp) > 1.0e300_wp, "no flow")
   end subroutine test_rise

   !> Two cams on three bearings, cold oil
   function cold_case() result(case)
      type(case_t) :: case

      case = thesis_case()
      case%operating_point%speed = speed
      case%operating_point%oil_temperature = supply
      case%lubricant%temperature_law = "vogel"
      case%lubricant%temperature_points = [298.15_wp, 333.15_wp, 368.15_wp]
      case%lubricant%viscosity_points = [0.15_wp, 0.0305_wp, 0.01_wp]
      allocate (case%bearing_heat)
      case%cam_bearings = three_bearings()
   end function cold_case

   !> From the means of the result: `rho c_p Q 2 dT = share M omega`
   subroutine check_balance(case, result, tolerance, least, error)
      type(case_t), intent(in) :: case
      type(result_t), intent(in) :: result
      ! Heat that the oil takes over that of friction, less one [-]
      real(wp), intent(in) :: tolerance
      ! Smallest rise that a bearing must have [K]
      real(wp), intent(in) :: least
      type(error_type), allocatable, intent(out) :: error
      character(len=10) :: name
      real(wp) :: density, taken, given, off
      integer :: i

      density = case%lubricant%density*(1.0_wp - case%lubricant%thermal_expansion &
         & *(case%operating_point%oil_temperature - 288.15_wp))
      do i = 1, size(case%cam_bearings%bearing_positions)
         write (name, "(a, i0, a)") "bearing_", i, "_"
         taken = density*case%bearing_heat%heat_capacity*scalar_of(result, "mean_"//trim(name)//"oil_flow")*2.0_wp &
            & *scalar_of(result, "mean_"//trim(name)//"temperature_rise")
         given = scalar_of(result, "mean_"//trim(name)//"torque")*case%operating_point%speed
         off = taken/(case%bearing_heat%oil_share*given) - 1.0_wp
         call check(error, abs(off) < tolerance, name//"is off by "//number_text(off))
         if (allocated(error)) return
         call check(error, scalar_of(result, "mean_"//trim(name)//"temperature_rise") > least, name//" stays cold")
         if (allocated(error)) return
      end do
   end subroutine check_balance

   subroutine test_balance(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      integer :: law

      do law = 1, 3
         case = cold_case()
         if (law == 1) case%cam_bearings%law = "long_full_sommerfeld"
         if (law == 2) case%cam_bearings%law = "short_ocvirk"
         if (law == 3) case%bearing_heat%oil_share = 0.6_wp
         call run(case, result, error)
         if (.not. allocated(error)) call check_balance(case, result, usual, 1.0_wp, error)
         if (allocated(error)) return
      end do
   end subroutine test_balance

   !> With the viscosity of a bearing's temperature in all bearings that one is as it was
   subroutine test_twin(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, twin
      type(result_t) :: result, other
      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      character(len=10) :: name
      real(wp), allocatable :: torque(:), expected(:)
      integer :: i

      case = cold_case()
      call run(case, result, error)
      if (allocated(error)) return
      do i = 1, 3
         write (name, "(a, i0, a)") "bearing_", i, "_"
         call get_oil(case%lubricant, supply + scalar_of(result, "mean_"//trim(name)//"temperature_rise"), oil, failure)
         twin = case
         deallocate (twin%bearing_heat)
         ! the clearance that makes eta/c^2 the same makes the bearing the same, and eta/c what its friction is relative to
         twin%cam_bearings%radial_clearance = case%cam_bearings%radial_clearance*sqrt(0.15_wp/oil%viscosity)
         call run(twin, other, error)
         if (allocated(error)) return
         torque = result%series_values(:, find_quantity(result%series, trim(name)//"torque"))
         expected = other%series_values(:, find_quantity(other%series, trim(name)//"torque"))*sqrt(oil%viscosity/0.15_wp)
         ! viscosity of the supply to rounding of Vogel's law through its points
         call check(error, maxval(abs(torque/expected - 1.0_wp)) < 1.0e-9_wp, name)
         if (allocated(error)) return
      end do
   end subroutine test_twin

   subroutine test_bits(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without, none
      integer :: i, column

      case = cold_case()
      call run(case, with, error)
      case%bearing_heat%oil_share = 0.0_wp
      if (.not. allocated(error)) call run(case, none, error)
      deallocate (case%bearing_heat)
      if (.not. allocated(error)) call run(case, without, error)
      if (allocated(error)) return
      do i = 1, size(without%series)
         if (without%series(i)%scope(:7) == "bearing" .or. index(without%series(i)%name, "torque") == 1 .or. &
            & without%series(i)%name == "energy_residual") then
            ! curves of the lobe shapes are finer where bearings ask for whole turns
            column = find_quantity(none%series, without%series(i)%name)
            call check(error, maxval(abs(none%series_values(:, column) - without%series_values(:, i))) &
               & <= 1.0e-12_wp*maxval(abs(without%series_values(:, i))) .or. without%series(i)%name == "energy_residual", &
               & without%series(i)%name//" has changed without heat")
         else
            column = find_quantity(with%series, without%series(i)%name)
            call check(error, maxval(abs(with%series_values(:, column) - without%series_values(:, i))) <= 0.0_wp, &
               & without%series(i)%name//" has changed")
         end if
         if (allocated(error)) return
      end do
      ! oil that is some kelvins warmer is thinner by some per cent for each
      call check(error, scalar_of(with, "mean_torque_bearings") < 0.9_wp*scalar_of(without, "mean_torque_bearings"), &
         & "heat does nothing")
      if (allocated(error)) return
      call check(error, scalar_of(with, "relative_energy_residual") < 1.0e-11_wp, "energy")
   end subroutine test_bits

   subroutine test_together(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result

      case = cold_case()
      case%cam_bearings%journal_motion = "orbit"
      case%bearing_asperity = bearing_asperity_t(0.5e-6_wp, 110.0e9_wp, 0.1_wp)
      case%belt_pull = belt_pull_t(400.0_wp, -1.2_wp, -0.03_wp)
      call run(case, result, error)
      if (.not. allocated(error)) call check_balance(case, result, usual, 1.0_wp, error)
   end subroutine test_together

   !> Hot oil in slow bearings: friction rises with the temperature, so that the rise that follows from the supply's temperature is
   !> too small
   subroutine test_rubbing(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      case = cold_case()
      case%operating_point%oil_temperature = 368.15_wp
      case%operating_point%speed = point_speeds(1)
      case%bearing_asperity = bearing_asperity_t(0.5e-6_wp, 110.0e9_wp, 0.1_wp)
      case%belt_pull = belt_pull_t(400.0_wp, -1.2_wp, -0.03_wp)
      do i = 1, 2
         if (i == 2) case%cam_bearings%journal_motion = "orbit"
         call run(case, result, error)
         if (.not. allocated(error)) call check_balance(case, result, usual, 0.1_wp, error)
         if (allocated(error)) return
         call check(error, scalar_of(result, "mean_bearing_1_temperature_rise") > 2.0_wp, "the bearing at the belt stays cold")
         if (allocated(error)) return
      end do
      ! Oil that carries next to nothing away, of bearings that rub: no balance below 200 K
      case%bearing_heat%heat_capacity = 1.0_wp
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_domain, "rub the more the warmer")
   end subroutine test_rubbing

   !> Cold oil under a pulled belt: at the lowest balance nothing rubs, so that the coefficient of asperities hardly matters
   subroutine test_lowest(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Rise in the bearing beside the belt with less and more boundary friction [K]
      real(wp) :: rises(2)
      integer :: bearings, i

      do bearings = 1, 2
         call get_deck_case("decks/mixed_bearings.nml", case, failure)
         if (has_failed(failure, error)) return
         case%bearing_heat = bearing_heat_t(heat_capacity=2000.0_wp, oil_share=1.0_wp)
         if (bearings == 1) then
            case%operating_point = operating_point_t(speed=87.0_wp*two_pi/60.0_wp, oil_temperature=246.25_wp)
            case%cam_bearings%law = "short_ocvirk"
            call set_bearings(15.7e-3_wp, 9.216e-3_wp, 14.79e-6_wp, 0.7892e-6_wp, 2103.0_wp)
         else
            case%operating_point = operating_point_t(speed=600.0_wp*two_pi/60.0_wp, oil_temperature=258.15_wp)
            call set_bearings(25.0e-3_wp, 7.0e-3_wp, 16.0e-6_wp, 0.6e-6_wp, 1500.0_wp)
         end if
         do i = 1, 2
            case%bearing_asperity%boundary_coefficient = merge(0.05_wp, 0.15_wp, i == 1)
            call run(case, result, error)
            if (.not. allocated(error)) call check_balance(case, result, usual, 0.1_wp, error)
            if (allocated(error)) return
            rises(i) = scalar_of(result, "mean_bearing_1_temperature_rise")
         end do
         ! Of the first the other balances are at 91 and 146 K with a coefficient of 0.08, of the second at 126 K with 0.14
         call check(error, rises(1) > 10.0_wp .and. rises(1) < 40.0_wp .and. abs(rises(2)/rises(1) - 1.0_wp) < 1.0e-3_wp, &
            & "rises of "//number_text(rises(1))//" and "//number_text(rises(2))//" K")
         if (allocated(error)) return
      end do

   contains

      !> Bearings and pull of the belt.
      subroutine set_bearings(diameter, width, clearance, roughness, force)
         !> Diameter, width, radial clearance and roughness [m]; force [N]
         real(wp), intent(in) :: diameter, width, clearance, roughness, force

         case%cam_bearings%diameter = diameter
         case%cam_bearings%width = width
         case%cam_bearings%radial_clearance = clearance
         case%bearing_asperity%roughness = roughness
         case%belt_pull%force = force
      end subroutine set_bearings

   end subroutine test_lowest

   !> Joints whose friction reverses over a few degrees, bearings whose asperities touch: what is steep lies between the stops
   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result

      case = cold_case()
      case%operating_point%oil_temperature = 368.15_wp
      case%operating_point%speed = point_speeds(1)
      case%bearing_asperity = bearing_asperity_t(0.5e-6_wp, 110.0e9_wp, 0.1_wp)
      call add_joints(case, "stribeck")
      case%numerics%tolerance = 1.0e-10_wp
      call run(case, result, error)
      ! The result's means of torque and flow may be off by 15 tolerances each; the bearings' own, and the rise, add a few
      if (.not. allocated(error)) call check_balance(case, result, 4.0e-9_wp, 0.01_wp, error)
   end subroutine test_accuracy

   !> Without series of single bearings, with them, on two camshafts.
   subroutine test_far_oil(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text
      integer :: i, k

      do i = 1, 3
         if (i < 3) then
            call get_deck_case("decks/warm_bearings.nml", case, failure)
            case%operating_point = operating_point_t(speed=2400.0_wp*two_pi/60.0_wp, oil_temperature=385.15_wp)
            case%cam_bearings%by_bearing = i == 2
         else
            call get_deck_case("decks/four_cylinder.nml", case, failure)
            case%operating_point = operating_point_t(speed=3000.0_wp*two_pi/60.0_wp, oil_temperature=419.15_wp)
            case%bearing_heat = bearing_heat_t(heat_capacity=2000.0_wp, oil_share=1.0_wp)
            case%bearing_asperity = bearing_asperity_t(0.3e-6_wp, 110.0e9_wp, 0.1_wp)
         end if
         case%cam_bearings%radial_clearance = 12.0e-6_wp
         if (.not. allocated(failure)) call run_case(case, result, failure)
         if (has_failed(failure, error)) return
         k = findloc(result%remarks%kind, far_temperature, 1)
         text = "none"
         if (k > 0) text = result%remarks(k)%text
         call check(error, index(text, "the oil temperature in a camshaft bearing, ") > 0, number_text(real(i, wp))//": "//text)
         if (allocated(error)) return
      end do
   end subroutine test_far_oil

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(case_t) :: case
      type(result_t) :: result
      type(shaft_simulation_t) :: shaft
      integer :: law, i

      case = cold_case()
      call start_shaft(shaft, case, 0.0_wp, failure)
      call check(error, allocated(failure), "a host gets cold bearings")
      if (allocated(error)) return
      call check(error, failure%kind == kind_usage)
      if (allocated(error)) return
      case%bearing_heat%oil_share = 1.5_wp
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_deck, "from 0 to 1")
      if (allocated(error)) return
      case = cold_case()
      call set_point(case, speed, 0.15_wp)
      case%lubricant%temperature_law = "direct"
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_deck, "direct")
      if (allocated(error)) return
      ! a fourth bearing, beyond one that no cam loads from the other side
      case = cold_case()
      case%cam_bearings%bearing_positions = [0.0_wp, 0.06_wp, 0.12_wp, 0.18_wp]
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_domain, "200 K")
      if (allocated(error)) return
      ! ISO 7902-1 takes its fit of the side flow to widths of one diameter; Ocvirk's flow is exact for the short bearing
      do law = 1, 2
         case = cold_case()
         case%cam_bearings%law = trim(merge("long_full_sommerfeld", "short_ocvirk        ", law == 1))
         do i = 0, 1
            case%cam_bearings%width = (1.0_wp + i*1.0e-3_wp)*case%cam_bearings%diameter
            call run_case(case, result, failure)
            call check(error, allocated(failure) .eqv. (law == 1 .and. i == 1), "width and law of a bearing with heat")
            if (allocated(error)) return
            if (.not. allocated(failure)) cycle
            call check(error, failure%kind == kind_deck .and. index(failure%message, "up to 1 diameter wide") > 0, failure%message)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_refusals

end module test_bearing_heat
