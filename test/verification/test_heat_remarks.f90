!> Remarks on heat: that a case leaves out, against the case with it; that takes oil and surfaces beyond what is given of them.
module test_heat_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : pi, two_pi, wp
   use camroller_boundary_law, only : boundary_law_t
   use camroller_bearing_heat, only : bearing_heat_t, heat_by_housing, heat_by_oil, oil_flow
   use camroller_case, only : case_t, operating_point_t
   use camroller_ehl_record, only : ehl_record_t
   use camroller_error, only : error_t
   use camroller_heat, only : compare_hot_oil, heat_part_t, heat_t, new_heat_part, set_heat_oil
   use camroller_journal, only : journal_at_speed
   use camroller_lubricant, only : density_at, get_oil, lubricant_t, oil_t
   use camroller_number_text, only : number_text
   use camroller_oil_checks, only : describe_hot_film, hot_film_t, note_hot_film
   use camroller_profile_remarks, only : judge_hot_profiles
   use camroller_remarks, only : add_remark, cool_bearings, cool_inlet, cool_pin, far_temperature, hot_film, insulated_metal, &
      & remark_lines, remark_t, rubbing_pin
   use camroller_result, only : result_t
   use closeness, only : has_failed
   use deck_cases, only : get_deck_case
   use lobe_cases, only : run
   use reference_cases, only : point_speeds, point_viscosities, set_point, thesis_case
   use result_checks, only : scalar_of
   implicit none
   private

   public :: collect_heat_remarks

   !> Operating points: cold, cool and hot oil [K], slow and fast [rad/s]; last cranking in the cold, and a start so fast that metal
   !> as cold as the oil leaves its bearings warm
   type(operating_point_t), parameter :: points(*) = [operating_point_t(3000.0_wp*two_pi/60.0_wp, 273.15_wp), &
      & operating_point_t(3000.0_wp*two_pi/60.0_wp, 298.15_wp), operating_point_t(300.0_wp*two_pi/60.0_wp, 273.15_wp), &
      & operating_point_t(300.0_wp*two_pi/60.0_wp, 363.15_wp), operating_point_t(20.0_wp*two_pi/60.0_wp, 233.15_wp), &
      & operating_point_t(1000.0_wp*two_pi/60.0_wp, 253.15_wp)]
   !> Are bearings worth a remark there, and inlets?
   logical, parameter :: warms_bearings(*) = [.true., .true., .false., .false., .false., .true.], &
      & warms_inlets(*) = [.true., .true., .false., .false., .false., .true.]

contains

   subroutine collect_heat_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("friction of bearings that a remark expects with heat is that with heat", test_bearings), &
         new_unittest("friction of a pin that a remark expects is that in oil so much warmer, which carries its heat off", &
         & test_pins), &
         new_unittest("remarks on a pin that rubs and is warm do not contradict each other", test_rubbing_pin), &
         new_unittest("bearings whose metal would pass no heat on give a remark, with a share that gives none", test_metal), &
         new_unittest("what metal leaves to the oil is told alike of cold and of warm bearings", test_bounds), &
         new_unittest("the film that a remark expects with heat in the inlet is that with heat", test_inlets), &
         new_unittest("where one viscosity is given, a film 30 K warmer than the oil gives a remark", test_direct_oil), &
         new_unittest("of an error that falls again with the temperature the largest is named", test_return), &
         new_unittest("oil and surfaces of the contact far from the points of their laws give a remark", test_far_contact), &
         new_unittest("profiles have remarks of their own on a place that is hotter than the mean", test_profiles) &
         ]
   end subroutine collect_heat_remarks

   !> Within a quarter: all of the oil is warmer in the second case, so that the roller slips less and its pin turns faster.
   subroutine test_pins(error)
      type(error_type), allocatable, intent(out) :: error
      ! Temperatures of the oil [K], speeds [rad/s]
      type(operating_point_t), parameter :: cold_and_fast = operating_point_t(2500.0_wp*two_pi/60.0_wp, 298.15_wp), &
         & warm_and_slow = operating_point_t(900.0_wp*two_pi/60.0_wp, 333.15_wp)
      type(case_t) :: case
      type(result_t) :: cool, warm
      ! Diameter of the deck's pin [m]
      real(wp), parameter :: diameter = 12.2e-3_wp
      ! Rise of the remark, that which follows in oil so much warmer [K]; friction over that of cold oil [-]
      real(wp) :: rise, follows, part
      integer :: k

      call solve(warm_and_slow, case, cool, error, "decks/plain_pin.nml")
      if (.not. allocated(error)) call check(error, findloc(cool%remarks%kind, cool_pin, 1), 0, "a remark on a warm pin")
      if (.not. allocated(error)) call solve(cold_and_fast, case, cool, error, "decks/plain_pin.nml")
      if (allocated(error)) return
      k = findloc(cool%remarks%kind, cool_pin, 1)
      call check(error, k > 0, "no remark")
      if (allocated(error)) return
      associate (text => cool%remarks(k)%text)
         read (text(index(text, "by about ") + 9:index(text, " K, and") - 1), *) rise
      end associate
      case%operating_point%oil_temperature = cold_and_fast%oil_temperature + rise
      call run(case, warm, error)
      if (allocated(error)) return
      part = scalar_of(warm, "mean_torque_needle")/scalar_of(cool, "mean_torque_needle")
      call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.25_wp, "friction "//number_text(part, 3)//" of that when cold")
      if (allocated(error)) return
      associate (pin => case%needle_bearing%film, spin => scalar_of(warm, "mean_roller_spin"))
         associate (journal => journal_at_speed(3, diameter, pin%width, pin%radial_clearance, 1.0_wp, 1.0_wp))
            follows = scalar_of(warm, "mean_torque_needle")*case%operating_point%speed/(heat_by_housing(journal) &
               & + heat_by_oil(bearing_heat_t(), density_at(case%lubricant, cold_and_fast%oil_temperature), &
               & oil_flow(journal, spin, scalar_of(warm, "mean_pin_eccentricity"))))
         end associate
      end associate
      call check(error, abs(follows/rise - 1.0_wp) < 0.25_wp, "rise of "//number_text(follows, 3)//" K")
   end subroutine test_pins

   !> A pin that turns slowly is as cold as its metal. A rough one under a large load is warm, and rubs where its film is the
   !> thinnest: its friction is not said to be too small and too large.
   subroutine test_rubbing_pin(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i, k

      do i = 1, 2
         call get_deck_case("decks/plain_pin.nml", case, failure)
         if (has_failed(failure, error)) return
         case%operating_point = operating_point_t(merge(1.0_wp, 300.0_wp, i == 1)*two_pi/60.0_wp, 298.15_wp)
         if (i == 2) case%needle_bearing%film%roughness = 2.0e-6_wp
         if (i == 2) case%spring%stiffness = 1.0e5_wp
         call run(case, result, error)
         if (allocated(error)) return
         k = findloc(result%remarks%kind, cool_pin, 1)
         call check(error, any(result%remarks%kind == rubbing_pin) .and. (k > 0 .eqv. i == 2), remark_lines(result%remarks))
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, index(result%remarks(k)%text, "too large") == 0 .and. index(result%remarks(k)%text, &
            & "the thinnest films of the pin are still thinner") > 0, result%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_rubbing_pin

   !> Cranking in the cold: all heat in the oil leaves it warm by 13 K on 0.2 W. The remark's smaller share leaves it cold, and none
   !> is told of the usual speeds of the deck with heat.
   subroutine test_metal(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      ! Torque of the bearings with all heat in the oil, and with the smaller share [N m]
      real(wp) :: torques(2)
      integer :: i, k

      call solve(points(5), case, result, error)
      if (allocated(error)) return
      case%cam_bearings%law = "finite"
      case%bearing_heat = bearing_heat_t()
      do i = 1, 2
         call run(case, result, error)
         if (allocated(error)) return
         torques(i) = scalar_of(result, "mean_torque_bearings")
         k = findloc(result%remarks%kind, insulated_metal, 1)
         call check(error, k > 0 .eqv. i == 1, remark_lines(result%remarks))
         if (allocated(error)) return
         if (k == 0) exit
         associate (text => result%remarks(k)%text)
            read (text(index(text, "the supply ", back=.true.) + 11:index(text, "; an oil_share") - 1), *) &
               & case%bearing_heat%oil_share
         end associate
      end do
      call check(error, torques(1) < 0.2_wp*torques(2), "friction "//number_text(torques(1)/torques(2), 3)//" of the other")
      if (allocated(error)) return
      call solve(points(1), case, result, error, "decks/warm_bearings.nml")
      if (allocated(error)) return
      call check(error, .not. any(result%remarks%kind == insulated_metal), remark_lines(result%remarks))
   end subroutine test_metal

   !> The share of cold metal is the same whether it is told of a bearing without heat or of one that is far too warm, to what one
   !> eccentricity for a turn leaves: the oil carries a quarter more or less. With the flow of the warm bearing it was ten times
   !> as large.
   subroutine test_bounds(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      real(wp) :: shares(2) ! [-]
      integer :: k

      call solve(points(6), case, result, error)
      if (allocated(error)) return
      k = findloc(result%remarks%kind, cool_bearings, 1)
      call check(error, k > 0, "no remark on cold bearings")
      if (allocated(error)) return
      associate (text => result%remarks(k)%text)
         read (text(index(text, "oil_share = ") + 12:index(text, " computes it for metal") - 1), *) shares(1)
      end associate
      case%bearing_heat = bearing_heat_t()
      call run(case, result, error)
      if (allocated(error)) return
      k = findloc(result%remarks%kind, insulated_metal, 1)
      call check(error, k > 0, "no remark on warm bearings")
      if (allocated(error)) return
      associate (text => result%remarks(k)%text)
         read (text(index(text, "the supply ", back=.true.) + 11:index(text, "; an oil_share") - 1), *) shares(2)
      end associate
      call check(error, abs(shares(2)/shares(1) - 1.0_wp) < 0.25_wp, number_text(shares(2), 2)//" for "//number_text(shares(1), 2))
   end subroutine test_bounds

   !> One bearing stands for all, and one eccentricity for a turn: within 15 %, where friction falls to between 6 and 32 %.
   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: cool, warm
      real(wp) :: part ! [-]
      integer :: i, k

      do i = 1, size(points)
         call solve(points(i), case, cool, error)
         if (allocated(error)) return
         k = findloc(cool%remarks%kind, cool_bearings, 1)
         call check(error, (k > 0) .eqv. warms_bearings(i), remark_lines(cool%remarks))
         if (allocated(error)) return
         case%bearing_heat = bearing_heat_t()
         if (k > 0) then
            associate (text => cool%remarks(k)%text)
               read (text(index(text, "oil_share = ") + 12:index(text, " computes it") - 1), *) case%bearing_heat%oil_share
            end associate
         end if
         call run(case, warm, error)
         if (allocated(error)) return
         part = scalar_of(warm, "mean_torque_bearings")/scalar_of(cool, "mean_torque_bearings")
         call check(error, findloc(warm%remarks%kind, cool_bearings, 1) == 0, "a remark on heat that is there")
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.15_wp .and. index(cool%remarks(k)%text, &
            & "be about "//number_text(1.0_wp/cool%remarks(k)%size, 2)//" of what it is") > 0, number_text(part, 3)//" for "// &
            & cool%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_bearings

   !> The smallest factor of the turn is that of the largest speed of entrainment, but for the fall of the viscosity, which is that
   !> over 5 K for one of 15 and 30 K.
   subroutine test_inlets(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: cool, warm
      real(wp) :: part ! [-]
      integer :: i, k

      do i = 1, size(points)
         call solve(points(i), case, cool, error)
         if (allocated(error)) return
         case%heat = heat_t(inlet_law="murch_wilson", contact="none")
         call run(case, warm, error)
         if (allocated(error)) return
         part = scalar_of(warm, "min_inlet_heat_factor")
         k = findloc(cool%remarks%kind, cool_inlet, 1)
         call check(error, (k > 0) .eqv. warms_inlets(i), "remark with "//number_text(part, 3))
         if (allocated(error)) return
         call check(error, findloc(warm%remarks%kind, cool_inlet, 1) == 0, "a remark on heat that is there")
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, abs(part*cool%remarks(k)%size - 1.0_wp) < 0.05_wp, number_text(part, 3)//" for "//cool%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_inlets

   !> Rollers that their bearings brake, on oil that is given by one viscosity: films 28 and 33 K warm, the latter's also without
   !> heat in the contact.
   subroutine test_direct_oil(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      real(wp), parameter :: conductivities(3) = [46.0_wp, 30.0_wp, 30.0_wp] ! of cam and roller [W/(m K)]
      integer :: i, k

      do i = 1, size(conductivities)
         case = thesis_case()
         call set_point(case, point_speeds(3), point_viscosities(1))
         allocate (case%heat)
         case%heat%viscosity_fall = 0.04_wp
         case%heat%conductivity = conductivities(i)
         if (i == 3) case%heat%contact = "none"
         case%needle_bearing%friction_coefficient = 0.1_wp
         call run(case, result, error)
         if (allocated(error)) return
         k = findloc(result%remarks%kind, hot_film, 1)
         call check(error, (k > 0) .eqv. i == 2, remark_lines(result%remarks))
         if (allocated(error)) return
         if (k == 0) cycle
         call check(error, index(result%remarks(k)%text, "its viscosity falls exponentially, by heat.viscosity_fall_per_K") > 0 &
            & .and. index(result%remarks(k)%text, "; it will do up to 30 K, and the film is hotter for ") > 0 &
            & .and. index(result%remarks(k)%text, "what the lubricant has") == 0, result%remarks(k)%text)
         if (allocated(error)) return
      end do
   end subroutine test_direct_oil

   !> Given at 25, 60 and 95 degC, the coefficient of oil at 50 degC bends 10 K above it; the line through 0 and 30 K is off the
   !> most there.
   subroutine test_return(error)
      type(error_type), allocatable, intent(out) :: error
      type(lubricant_t) :: lubricant
      type(heat_part_t) :: part
      type(oil_t) :: oil
      type(hot_film_t) :: hot
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: words
      ! Errors at 10 and at 29 K [-]
      real(wp) :: middle(2), last(2)
      real(wp), parameter :: temperature = 323.15_wp ! [K]
      logical :: has_law

      lubricant%viscosity = 0.05_wp
      lubricant%pressure_viscosity_temperatures = [298.15_wp, 333.15_wp, 368.15_wp]
      lubricant%pressure_viscosity_points = [24.0e-9_wp, 20.0e-9_wp, 18.0e-9_wp]
      call get_oil(lubricant, temperature, oil, failure)
      call new_heat_part(part, heat_t(viscosity_fall=0.05_wp), failure)
      call set_heat_oil(part, lubricant, temperature, oil, failure)
      if (has_failed(failure, error)) return
      call note_hot_film(hot, part, lubricant, oil, 29.0_wp, 0.0_wp, 0.0_wp, 0.25_wp)
      call compare_hot_oil(part, lubricant, oil, 10.0_wp, middle, has_law)
      call compare_hot_oil(part, lubricant, oil, 29.0_wp, last, has_law)
      call check(error, middle(2) > 0.01_wp .and. abs(last(2)) < 0.002_wp, "errors that do not return")
      if (allocated(error)) return
      call describe_hot_film(hot, part, lubricant, oil, "the film", words)
      call check(error, words, "the film is up to 29 K warmer than the oil, at cam angle 180.0 deg; up to there its "// &
         & "pressure-viscosity coefficient is as much as "//number_text(100.0_wp*middle(2), 2)//" % above what the lubricant "// &
         & "has; the oil of a hot film is within 1 % up to "//number_text(hot%good_rise, 2)//" K, and the film is hotter for "// &
         & "25 % of the cycle")
   end subroutine test_return

   !> A roller that its bearing holds, on oil at the last of its points: the film is 70 K warmer. Surfaces that conduct badly are
   !> beyond a table of their coefficient; those of a roller that rolls are not.
   subroutine test_far_contact(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      character(len=*), parameter :: film = "the oil temperature between cam and roller, ", &
         & surface = "the temperature of cam and roller where they touch, "
      logical :: is_told(2)
      integer :: i

      do i = 1, 3
         call get_deck_case("decks/heated_contact.nml", case, failure)
         if (has_failed(failure, error)) return
         case%operating_point = operating_point_t(speed=2500.0_wp*two_pi/60.0_wp, oil_temperature=368.15_wp)
         if (i < 3) case%needle_bearing%friction_coefficient = 0.3_wp
         if (i > 1) then
            allocate (case%boundary_law)
            case%boundary_law = boundary_law_t(law="table", largest=1.0_wp)
            case%boundary_law%speed_points = [1.0e-3_wp, 1.0_wp]
            case%boundary_law%temperature_points = [353.15_wp, 373.15_wp]
            case%boundary_law%coefficient_points = [0.1_wp, 0.1_wp, 0.12_wp, 0.12_wp]
            if (i == 2) case%heat%conductivity = 3.0_wp
         end if
         call run(case, result, error)
         if (allocated(error)) return
         is_told = [index(remark_lines(result%remarks), film) > 0, index(remark_lines(result%remarks), surface) > 0]
         call check(error, all(is_told .eqv. [i < 3, i == 2]), remark_lines(result%remarks))
         if (allocated(error)) return
      end do
   end subroutine test_far_contact

   !> Profiles of two angles, at one of which a place between nodes of a mean film is hot.
   subroutine test_profiles(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(ehl_record_t) :: record
      type(remark_t), allocatable :: remarks(:)
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: lines
      integer :: i

      call get_deck_case("decks/heated_contact.nml", case, failure)
      if (has_failed(failure, error)) return
      case%operating_point%oil_temperature = 298.15_wp
      case%lubricant%temperature_law = "walther"
      case%lubricant%temperature_points = case%lubricant%temperature_points([1, 3])
      case%lubricant%viscosity_points = case%lubricant%viscosity_points([1, 3])
      record%angle = [0.0_wp, pi]
      do i = 1, 4
         remarks = [remark_t ::]
         if (i == 4) call add_remark(remarks, far_temperature, "farther", 60.0_wp)
         if (i > 1) record%film_rise = reshape([5.0_wp, 10.0_wp, 0.0_wp, merge(15.0_wp, 120.0_wp, i == 2)], [2, 2])
         call judge_hot_profiles(record, case, remarks)
         call check(error, size(remarks), merge(0, 2, i < 3), remark_lines(remarks))
         if (allocated(error)) return
         if (i < 3) cycle
         lines = remark_lines(remarks)
         call check(error, index(lines, "the film of the profiles is up to 120 K warmer than the oil, at cam angle 0.0 deg; ") > 0 &
               & .and. index(lines, ", and the film is hotter for 50 % of the cycle") > 0 .and. (index(lines, "in the profiles "// &
               & "the oil temperature between cam and roller, 145 degC, is 50 K above all points that are given, 25 to 95 degC: ") &
               & > 0 .eqv. i == 3), lines)
         if (allocated(error)) return
      end do
   end subroutine test_profiles

   !> The case of the thesis at a point, without heat.
   subroutine solve(point, case, result, error, deck)
      type(operating_point_t), intent(in) :: point
      type(case_t), intent(out) :: case
      type(result_t), intent(out) :: result
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: deck

      type(error_t), allocatable :: failure

      if (present(deck)) then
         call get_deck_case(deck, case, failure)
      else
         call get_deck_case("decks/thesis.nml", case, failure)
      end if
      if (has_failed(failure, error)) return
      case%operating_point = point
      call run(case, result, error)
   end subroutine solve

end module test_heat_remarks
