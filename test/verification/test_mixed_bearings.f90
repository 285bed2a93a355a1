!> Mixed friction of journal bearings, the pull of a belt, and series of single bearings.
module test_mixed_bearings
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_bearing_asperity, only : asperity_forces, bearing_asperity_t, bearing_state_t, carry_load, new_touch, &
      & tabulated_forces, bearing_touch_t
   use camroller_bearing_loads, only : belt_pull_t
   use camroller_case, only : case_t
   use camroller_error, only : error_t, kind_deck
   use camroller_greenwood_tripp, only : integral_5_2
   use camroller_journal, only : film_at, film_friction, film_t, journal_at_speed, journal_law_names, journal_t
   use camroller_quadrature, only : gauss_legendre
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use closeness, only : expect_error
   use labelled_table, only : label_length, read_table
   use reference_cases, only : point_speeds, point_viscosities, set_point, thesis_case
   use unit_systems, only : angular_speed, force, length, pressure, scaled, torque, unit_systems_tried, viscosity
   use lobe_cases, only : run, three_bearings
   use result_checks, only : scalar_of, series_of
   implicit none
   private

   public :: collect_mixed_bearings

   !> The bearing of the reference [m], [m], [m], [Pa s], [rad/s]
   real(wp), parameter :: diameter = 26.0e-3_wp, width = 18.0e-3_wp, clearance = 0.05e-3_wp, oil = 0.01_wp, speed = 30.0_wp
   !> Its surfaces
   type(bearing_asperity_t), parameter :: surfaces = bearing_asperity_t(0.5e-6_wp, 110.0e9_wp, 0.1_wp)

contains

   subroutine collect_mixed_bearings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("eccentricity, loads and torques of an independent solution", test_reference), &
         new_unittest("forces of asperities are their pressures integrated round the bearing", test_forces), &
         new_unittest("film and asperities together carry the load, by every law, at any load", test_balance), &
         new_unittest("the same at loads where steps of Newton's method go to and fro", test_to_and_fro), &
         new_unittest("without contact a bearing is that of its law, bit by bit", test_apart), &
         new_unittest("a bearing without oil to speak of slides on its asperities", test_dry), &
         new_unittest("bearings in other units", test_units), &
         new_unittest("series of single bearings add up to those of all", test_series), &
         new_unittest("series of single bearings change no bit of anything else", test_bits), &
         new_unittest("mixed friction and pull change the bearings and nothing else; energy closes", test_effects), &
         new_unittest("impossible surfaces are refused with a message", test_refusals) &
         ]
   end subroutine collect_mixed_bearings

   !> Bearing by a law
   function bearing_of(law) result(journal)
      integer, intent(in) :: law
      type(journal_t) :: journal

      journal = journal_at_speed(law, diameter, width, clearance, oil, speed)
   end function bearing_of

   subroutine test_reference(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: laws(:)
      real(wp), allocatable :: rows(:, :)
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(bearing_state_t) :: state
      integer :: i, status

      call read_table("bearing_reference.csv", 6, rows, error, laws)
      if (allocated(error)) return
      call new_touch(touch, surfaces, clearance, failure)
      do i = 1, size(laws)
         ! the direction of the load does not matter
         call carry_load(bearing_of(findloc(journal_law_names == laws(i), .true., 1)), &
            & rows(1, i)*[cos(real(i, wp)), sin(real(i, wp))], state, status, touch)
         call check(error, status, 0)
         if (allocated(error)) return
         ! digits of the table; the film, one less e, loses two of the reference's own; bisection in Python to 1e-13 in ln(1 - e),
         ! where loads are up to thirty times as sensitive
         call check(error, abs(state%eccentricity - rows(2, i)) < 1.0e-12_wp &
            & .and. abs(state%film/rows(3, i) - 1.0_wp) < 1.0e-10_wp &
            & .and. abs(state%asperity_load - rows(4, i)) < 1.0e-9_wp*rows(4, i) &
            & .and. abs(state%torque/rows(5, i) - 1.0_wp) < 1.0e-10_wp &
            & .and. abs(state%boundary_torque - rows(6, i)) < 1.0e-9_wp*rows(6, i), trim(laws(i)))
         if (allocated(error)) return
      end do
   end subroutine test_reference

   subroutine test_forces(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(journal_t) :: journal
      ! e/sqrt(1 - e^2) of next to no film [-]
      real(wp), parameter :: squeezed = 1.0e100_wp
      integer, parameter :: points = 100
      ! Angles from the thinnest place, weights of a rule, pressures there over that at F_5/2 = 1
      real(wp) :: angles(points), weights(points), pressures(points)
      real(wp) :: found(2), expected(2), largest(2), slopes(2), gap, last, unused
      integer :: i, k

      journal = bearing_of(1)
      call new_touch(touch, surfaces, clearance, failure)
      do i = 0, 40
         gap = 0.08_wp*10.0_wp**(-0.1_wp*i)*0.999_wp
         call asperity_forces(journal, touch, (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap)), found(1), found(2))
         last = acos((1.0_wp - 0.08_wp)/(1.0_wp - gap))
         call gauss_legendre(angles, weights)
         angles = 0.5_wp*last*(1.0_wp + angles)
         do k = 1, points
            call integral_5_2(clearance/surfaces%roughness*(1.0_wp - (1.0_wp - gap)*cos(angles(k))), pressures(k), unused)
         end do
         expected = touch%pressure*0.5_wp*diameter*width*last*[sum(weights*pressures*cos(angles)), sum(weights*pressures)]
         ! the film over roughness at its end, near 8, loses a factor 8*8 of the digits in its exponential, the reference as much
         call check(error, all(abs(found/expected - 1.0_wp) < 1.0e-11_wp), "the rule is not exact enough")
         if (allocated(error)) return
         ! polynomials of degree 13 in pieces of one film ratio are 4e-13 off; beyond a ratio of 7 the end of the contact counts
         call asperity_forces(journal, touch, squeezed, largest(1), largest(2))
         call tabulated_forces(journal, touch, (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap)), found(1), found(2), slopes(1), slopes(2))
         call check(error, all(abs(found - expected) < merge(1.0e-11_wp*expected, 1.0e-12_wp*largest, gap < 0.07_wp)), &
            & "the tables are not exact enough")
         if (allocated(error)) return
      end do
   end subroutine test_forces

   subroutine test_balance(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(journal_t) :: journal
      type(bearing_state_t) :: state, before
      type(film_t) :: film
      real(wp) :: load, carried, t, angle, along, normal
      integer :: law, i, status

      call new_touch(touch, surfaces, clearance, failure)
      do law = 1, size(journal_law_names)
         journal = bearing_of(law)
         before = bearing_state_t()
         do i = -20, 80
            load = 100.0_wp*10.0_wp**(0.1_wp*i)
            call carry_load(journal, [0.6_wp, -0.8_wp]*load, state, status, touch)
            call check(error, status, 0)
            if (allocated(error)) return
            ! next to one the eccentricity has no more digits than one
            call check(error, (state%eccentricity >= before%eccentricity - epsilon(1.0_wp) .and. state%film < before%film) &
               & .or. i == -20, "the film does not become thinner with the load")
            if (allocated(error)) return
            call check(error, state%torque > before%torque .and. state%boundary_torque >= before%boundary_torque .and. &
               & state%asperity_load >= before%asperity_load, "torque or load of asperities fall with the load")
            if (allocated(error)) return
            before = state
            if (.not. state%asperity_load > 0.0_wp) cycle
            ! from the smallest film, which keeps the digits of 1 - e
            associate (gap => state%film/clearance)
               t = (1.0_wp - gap)/sqrt(gap*(2.0_wp - gap))
            end associate
            film = film_at(journal, t)
            carried = journal%unit_load*film%number
            call asperity_forces(journal, touch, t, along, normal)
            angle = min(film%angle, 0.5_wp*pi)
            ! t to a few units of round-off; the heaviest loads rise with its fourth power
            call check(error, abs(hypot(carried*cos(angle) + along, carried*sin(angle))/load - 1.0_wp) < 1.0e-12_wp, "the load")
            if (allocated(error)) return
            call check(error, abs((film_friction(journal, carried, t) + 0.1_wp*normal)*0.5_wp*diameter/state%torque - 1.0_wp) &
               & < 1.0e-12_wp .and. normal >= along, "the torque")
            if (allocated(error)) return
         end do
         call check(error, state%boundary_torque > 0.0_wp, "asperities never touch")
         if (allocated(error)) return
      end do
   end subroutine test_balance

   !> A bearing of a random deck, at loads between which Newton's method alone alternates between no contact and fifteen times the
   !> load.
   subroutine test_to_and_fro(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: loads = 200
      ! Smallest and largest load [N]
      real(wp), parameter :: low = 7.2_wp, high = 7.4_wp
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(journal_t) :: journal
      type(bearing_state_t) :: state, before
      integer :: i, status

      call new_touch(touch, bearing_asperity_t(0.34751738519851484e-6_wp, 142.8344144020230e9_wp, 0.1_wp, &
         & roughness_over_tip_radius=0.02193250945_wp), 18.978793479e-6_wp, failure)
      journal = journal_at_speed(findloc(journal_law_names == "finite", .true., 1), 2.0_wp*5.9085797870e-3_wp, &
         & 5.953526457e-3_wp, 18.978793479e-6_wp, 3.28217292624e-3_wp, 3.50584826_wp)
      do i = 0, loads
         before = state
         call carry_load(journal, [low + (high - low)*i/loads, 0.0_wp], state, status, touch)
         call check(error, status, 0)
         if (allocated(error)) return
         if (i == 0) cycle
         ! Torque and load are smooth: their relative changes are alike
         call check(error, abs(state%torque/before%torque - 1.0_wp) < 10.0_wp*(high/low - 1.0_wp)/loads .and. &
            & state%asperity_load > before%asperity_load, "a jump over the load")
         if (allocated(error)) return
      end do
   end subroutine test_to_and_fro

   subroutine test_apart(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(bearing_state_t) :: state, plain
      integer :: law, i, status

      call new_touch(touch, surfaces, clearance, failure)
      do law = 1, size(journal_law_names)
         do i = 0, 20
            call carry_load(bearing_of(law), [real(i, wp), 0.0_wp], plain, status)
            call carry_load(bearing_of(law), [real(i, wp), 0.0_wp], state, status, touch)
            call check(error, plain%film > 8.0_wp*surfaces%roughness .and. abs(state%torque - plain%torque) <= 0.0_wp .and. &
               & abs(state%eccentricity - plain%eccentricity) <= 0.0_wp .and. abs(state%film - plain%film) <= 0.0_wp .and. &
               & abs(state%boundary_torque) <= 0.0_wp .and. abs(state%asperity_load) <= 0.0_wp, journal_law_names(law))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_apart

   !> With a film that carries nothing, asperities carry all: their normal forces add up to a little more than the load, since
   !> they spread over an angle whose cosine is at least `1 - 8 sigma/c (1 - e)/e`, 0.92
   subroutine test_dry(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(bearing_state_t) :: state
      integer :: law, status

      call new_touch(touch, surfaces, clearance, failure)
      do law = 1, size(journal_law_names)
         call carry_load(journal_at_speed(law, diameter, width, clearance, 1.0e-14_wp, speed), [0.0_wp, 300.0_wp], state, status, &
            & touch)
         associate (least => surfaces%boundary_coefficient*300.0_wp*0.5_wp*diameter)
            ! with this little oil the film carries 1e-9 of the load
            call check(error, abs(state%asperity_load/300.0_wp - 1.0_wp) < 1.0e-6_wp .and. state%torque > least .and. &
               & state%torque < least/0.92_wp, journal_law_names(law))
         end associate
         if (allocated(error)) return
      end do
   end subroutine test_dry

   subroutine test_units(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(bearing_state_t) :: state, other
      type(bearing_asperity_t) :: rescaled
      integer :: law, i, k, status

      do k = 1, size(unit_systems_tried)
         associate (u => unit_systems_tried(k))
            do law = 1, size(journal_law_names)
               do i = 1, 3
                  call new_touch(touch, surfaces, clearance, failure)
                  call carry_load(bearing_of(law), [0.0_wp, 10.0_wp**(i + 1)], state, status, touch)
                  rescaled = surfaces
                  rescaled%roughness = scaled(u, surfaces%roughness, length)
                  rescaled%modulus = scaled(u, surfaces%modulus, pressure)
                  call new_touch(touch, rescaled, scaled(u, clearance, length), failure)
                  call carry_load(journal_at_speed(law, scaled(u, diameter, length), scaled(u, width, length), &
                     & scaled(u, clearance, length), scaled(u, oil, viscosity), scaled(u, speed, angular_speed)), &
                     & scaled(u, [0.0_wp, 10.0_wp**(i + 1)], force), other, status, touch)
                  ! the root to round-off, where loads change up to thirty times as much as the film
                  call check(error, abs(scaled(u, state%torque, torque)/other%torque - 1.0_wp) < 1.0e-12_wp .and. &
                     & abs(scaled(u, state%film, length)/other%film - 1.0_wp) < 1.0e-12_wp .and. &
                     & abs(scaled(u, state%asperity_load, force) - other%asperity_load) <= 1.0e-11_wp*other%asperity_load, &
                     & journal_law_names(law))
                  if (allocated(error)) return
               end do
            end do
         end associate
      end do
   end subroutine test_units

   !> A case of hot oil with two cams on three bearings, mixed friction and a belt
   function hot_case() result(case)
      type(case_t) :: case

      case = thesis_case()
      call set_point(case, point_speeds(1), point_viscosities(3))
      allocate (case%bearing_asperity, case%belt_pull)
      case%cam_bearings = three_bearings()
      case%bearing_asperity = surfaces
      case%belt_pull = belt_pull_t(400.0_wp, -1.2_wp, -0.03_wp)
   end function hot_case

   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result, unloaded
      real(wp), allocatable :: all(:), x(:), y(:), without(:)
      real(wp) :: mean
      character(len=10) :: name
      integer :: i

      case = hot_case()
      call run(case, result, error)
      if (.not. allocated(error)) then
         deallocate (case%belt_pull)
         call run(case, unloaded, error)
      end if
      if (allocated(error)) return
      allocate (all(size(result%angle)), x(size(result%angle)), y(size(result%angle)))
      all = 0.0_wp
      x = 0.0_wp
      y = 0.0_wp
      mean = 0.0_wp
      do i = 1, 3
         write (name, "(a, i0, a)") "bearing_", i, "_"
         all = all + series_of(result, trim(name)//"torque")
         x = x + series_of(result, trim(name)//"load_x") - series_of(unloaded, trim(name)//"load_x")
         y = y + series_of(result, trim(name)//"load_y") - series_of(unloaded, trim(name)//"load_y")
         mean = mean + scalar_of(result, "mean_"//trim(name)//"torque")
         call check(error, maxval(abs(hypot(series_of(result, trim(name)//"load_x"), series_of(result, trim(name)//"load_y")) &
            & - series_of(result, trim(name)//"load"))) < 1.0e-10_wp, "load")
         if (allocated(error)) return
         call check(error, maxval(abs(series_of(result, trim(name)//"film_min")/surfaces%roughness &
            & - series_of(result, trim(name)//"film_ratio"))) < 1.0e-12_wp, "film ratio")
         if (allocated(error)) return
         call check(error, result%series(find_quantity(result%series, trim(name)//"load"))%scope == "bearing "//name(9:9), "scope")
         if (allocated(error)) return
         ! extremes stand at no output angle but near one
         without = series_of(result, trim(name)//"film_min")
         call check(error, scalar_of(result, "min_"//trim(name)//"film_min") <= minval(without) .and. &
            & scalar_of(result, "max_"//trim(name)//"film_min") >= maxval(without) .and. &
            & scalar_of(result, "min_"//trim(name)//"film_min") > 0.98_wp*minval(without), "extremes")
         if (allocated(error)) return
      end do
      call check(error, maxval(abs(all - series_of(result, "torque_bearings"))) < 1.0e-14_wp, "torques do not add up")
      if (allocated(error)) return
      ! each is a mean to the tolerance of the cycle over panels of its own
      call check(error, abs(mean/scalar_of(result, "mean_torque_bearings") - 1.0_wp) < 1.0e-6_wp, "means do not add up")
      if (allocated(error)) return
      ! the belt presses on the shaft as a whole, and lifts it from the second bearing
      call check(error, maxval(abs(x - 400.0_wp*cos(1.2_wp))) < 1.0e-10_wp .and. maxval(abs(y + 400.0_wp*sin(1.2_wp))) &
         & < 1.0e-10_wp, "the belt's force")
      if (allocated(error)) return
      x = series_of(result, "bearing_2_load_x") - series_of(unloaded, "bearing_2_load_x")
      call check(error, maxval(abs(x + 200.0_wp*cos(1.2_wp))) < 1.0e-10_wp, "the belt's lever")
      if (allocated(error)) return
      call check(error, scalar_of(result, "max_bearing_1_torque_boundary") > 0.0_wp, "asperities never touch")
   end subroutine test_series

   subroutine test_bits(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      integer :: i, k, compared

      do k = 1, 2
         case = hot_case()
         if (k == 2) deallocate (case%bearing_asperity, case%belt_pull)
         call run(case, with, error)
         case%cam_bearings%by_bearing = .false.
         if (.not. allocated(error)) call run(case, without, error)
         if (allocated(error)) return
         compared = 0
         do i = 1, size(without%summary)
            ! with more means and extremes their worst errors are others
            if (index(without%summary(i)%name, "estimated_error_of_") == 1) cycle
            associate (one => scalar_of(with, without%summary(i)%name), other => without%summary_values(i))
               call check(error, one >= other .and. one <= other, without%summary(i)%name)
            end associate
            if (allocated(error)) return
            compared = compared + 1
         end do
         call check(error, compared > 60 .and. size(with%summary) > size(without%summary) + 3*3*5, "hardly anything is compared")
         if (allocated(error)) return
      end do
   end subroutine test_bits

   subroutine test_effects(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      integer :: i, k

      case = hot_case()
      call run(case, with, error)
      if (allocated(error)) return
      ! round-off of the powers that are summed up, as without these effects
      call check(error, scalar_of(with, "relative_energy_residual") < 1.0e-11_wp, "energy")
      if (allocated(error)) return
      do k = 1, 2
         case = hot_case()
         if (k == 1) deallocate (case%bearing_asperity)
         if (k == 2) deallocate (case%belt_pull)
         call run(case, without, error)
         if (allocated(error)) return
         call check(error, scalar_of(without, "mean_torque_bearings") < 0.999_wp*scalar_of(with, "mean_torque_bearings"), &
            & "the bearings do not change")
         if (allocated(error)) return
         do i = 1, size(without%series)
            if (without%series(i)%scope(:7) == "bearing" .or. any(without%series(i)%name == [character(len=16) :: &
               & "torque_bearings", "torque_friction", "torque_drive", "energy_residual"])) cycle
            call check(error, maxval(abs(series_of(with, without%series(i)%name) - without%series_values(:, i))) <= 0.0_wp, &
               & without%series(i)%name//" has changed")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_effects

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(bearing_touch_t) :: touch
      type(case_t) :: case
      type(result_t) :: result

      call new_touch(touch, surfaces, 7.9_wp*surfaces%roughness, failure)
      call expect_error(error, failure, kind_deck, "eight times the roughness")
      if (allocated(error)) return
      call new_touch(touch, bearing_asperity_t(0.0_wp, 110.0e9_wp, 0.1_wp), clearance, failure)
      call expect_error(error, failure, kind_deck, "above zero")
      if (allocated(error)) return
      case = hot_case()
      case%bearing_asperity%boundary_coefficient = -0.1_wp
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_deck, "no negative friction coefficient")
   end subroutine test_refusals

end module test_mixed_bearings
