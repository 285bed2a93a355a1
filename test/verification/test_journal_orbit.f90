!> Orbits of journals over the turn, cases with orbits.
module test_journal_orbit
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_bearing_asperity, only : bearing_asperity_t, bearing_state_t, carry_load, new_touch, bearing_touch_t
   use camroller_case, only : case_t
   use camroller_error, only : error_t, kind_deck, kind_usage
   use camroller_journal, only : journal_at_speed, journal_law_names, journal_t
   use camroller_journal_motion, only : moving_state
   use camroller_journal_orbit, only : bearing_load_t, find_orbit, orbit_t, place_at
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use camroller_shaft_simulation, only : shaft_simulation_t, start_shaft
   use labelled_table, only : label_length, read_table
   use lobe_cases, only : three_bearings
   use reference_cases, only : point_speeds, point_viscosities, set_point, thesis_case
   use result_checks, only : series_of
   use test_journal_motion, only : across, bearing_of
   use closeness, only : expect_error, has_failed
   implicit none
   private

   public :: collect_journal_orbit

   !> Places of laws in `journal_law_names`
   integer, parameter :: short = 2, finite = 3
   !> A bearing [m], [m], [m], [Pa s], [rad/s]
   real(wp), parameter :: diameter = 26.0e-3_wp, width = 10.4e-3_wp, clearance = 0.05e-3_wp, oil = 0.01_wp, speed = 30.0_wp

   !> The load of the reference
   type, extends(bearing_load_t) :: swinging_t
      !> Of the cam, of the pull [N]
      real(wp) :: cam = 0.0_wp, pull = 0.0_wp
   contains
      procedure :: get_load => swinging_load
   end type swinging_t

contains

   subroutine collect_journal_orbit(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("at rest finite bearings are near those of Raimondi and Boyd", test_finite), &
         new_unittest("orbits of an independent solution", test_reference), &
         new_unittest("under a steady load the orbit is the point of the quasi-steady bearing", test_steady), &
         new_unittest("mixed friction holds a moving journal like one at rest", test_mixed), &
         new_unittest("a journal that whirls almost freely closes its orbit in a few turns", test_light), &
         new_unittest("errors of an orbit follow the accuracy", test_accuracy), &
         new_unittest("orbits change the bearings and nothing else; work of the load is lost in the film", test_case), &
         new_unittest("laws without orbits and hosts are refused with a message", test_refusals) &
         ]
   end subroutine collect_journal_orbit

   !> Load over the angle
   subroutine swinging_load(self, angle, load, status)
      class(swinging_t), intent(in) :: self
      real(wp), intent(in) :: angle
      real(wp), intent(out) :: load(2)
      integer, intent(out) :: status

      status = 0
      associate (press => self%cam*exp(-3.0_wp*(1.0_wp - cos(angle))), swing => 0.4_wp*sin(angle))
         load = press*[cos(swing), sin(swing)] + self%pull*[0.3_wp, -1.0_wp]
      end associate
   end subroutine swinging_load

   subroutine test_finite(error)
      type(error_type), allocatable, intent(out) :: error
      type(swinging_t) :: load
      type(orbit_t) :: orbit
      type(error_t), allocatable :: failure
      real(wp), allocatable :: rows(:, :)
      real(wp) :: place(2)
      type(journal_t) :: journal
      integer :: i, hint

      call read_table("raimondi_boyd.csv", 5, rows, error)
      if (allocated(error)) return
      hint = 1
      do i = 1, size(rows, 2)
         journal = journal_at_speed(finite, diameter, rows(1, i)*diameter, clearance, oil, speed)
         ! the load of their Sommerfeld number, 1/(pi q), in the direction (0.3, -1)
         load%pull = journal%unit_load/(pi*rows(3, i))/norm2([0.3_wp, 1.0_wp])
         call find_orbit(journal, 1.0_wp, load, [-pi, pi], 1.0e-6_wp, orbit, failure)
         if (has_failed(failure, error)) return
         call place_at(orbit, 0.0_wp, hint, place)
         ! the fit's 11 % in the load change the eccentricity by half of that and less, the attitude by its 2 degrees and what goes
         ! with the eccentricity
         call check(error, abs(norm2(place) - rows(2, i)) < 0.03_wp, "eccentricity")
         if (allocated(error)) return
         call check(error, abs(acos(dot_product(place, [0.3_wp, -1.0_wp])/norm2(place)/norm2([0.3_wp, 1.0_wp]))/degree &
            & - rows(4, i)) < 4.0_wp, "attitude")
         if (allocated(error)) return
      end do
   end subroutine test_finite

   subroutine test_reference(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      type(journal_t) :: journal
      type(swinging_t) :: load
      type(orbit_t) :: orbit
      type(bearing_state_t) :: state
      type(error_t), allocatable :: failure
      real(wp) :: place(2), force(2)
      integer :: i, hint, status

      call read_table("journal_orbit_reference.csv", 7, rows, error, names)
      if (allocated(error)) return
      journal = bearing_of(short)
      hint = 1
      do i = 1, size(names)
         load = swinging_t(rows(1, i)*journal%unit_load, rows(2, i)*journal%unit_load)
         if (i > 1) then
            if (names(i) /= names(i - 1)) orbit = orbit_t()
         end if
         if (orbit%turns == 0) call find_orbit(journal, rows(3, i), load, [-pi, pi], 1.0e-8_wp, orbit, failure)
         if (has_failed(failure, error)) return
         call place_at(orbit, rows(4, i)*degree, hint, place)
         call load%get_load(rows(4, i)*degree, force, status)
         call moving_state(journal, place, force, state)
         ! three times what the two solvers of the reference differ by, see the table's head
         call check(error, norm2(place - rows(5:6, i)) < 3.0e-7_wp, trim(names(i))//": place")
         if (allocated(error)) return
         call check(error, abs(state%torque*clearance/(oil*speed*journal%radius**3*width)/rows(7, i) - 1.0_wp) < 3.0e-7_wp, &
            & trim(names(i))//": torque")
         if (allocated(error)) return
      end do
      call check(error, size(names) >= 3*24, "hardly anything is compared")
   end subroutine test_reference

   subroutine test_steady(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(swinging_t) :: load
      type(orbit_t) :: orbit
      type(bearing_state_t) :: state, still
      type(error_t), allocatable :: failure
      real(wp) :: place(2), force(2)
      integer :: i, hint, status

      journal = bearing_of(short)
      hint = 1
      do i = -2, 4
         load%pull = 10.0_wp**i*journal%unit_load
         call find_orbit(journal, -1.0_wp, load, [-pi, 0.5_wp, pi], 1.0e-8_wp, orbit, failure)
         if (has_failed(failure, error)) return
         call place_at(orbit, 0.0_wp, hint, place)
         call load%get_load(0.0_wp, force, status)
         call moving_state(journal, place, force, state)
         call carry_load(journal, force, still, status)
         ! the accuracy, over the smallest film
         call check(error, abs(state%film/still%film - 1.0_wp) < 1.0e-6_wp .and. &
            & abs(state%eccentricity - still%eccentricity) < 1.0e-7_wp, "place")
         if (allocated(error)) return
         call check(error, abs(state%torque - still%torque) < 1.0e-6_wp*still%torque, "torque")
         if (allocated(error)) return
         ! the shaft drags the journal the way it turns
         call check(error, dot_product(across(force), place) < 0.0_wp, "side")
         if (allocated(error)) return
      end do
   end subroutine test_steady

   subroutine test_mixed(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(bearing_touch_t) :: touch
      type(swinging_t) :: load
      type(orbit_t) :: orbit
      type(bearing_state_t) :: state, still
      type(error_t), allocatable :: failure
      real(wp) :: place(2), force(2)
      integer :: i, hint, status

      call new_touch(touch, bearing_asperity_t(0.5e-6_wp, 110.0e9_wp, 0.1_wp), clearance, failure)
      ! So little oil that asperities carry most of the largest load
      journal = journal_at_speed(short, diameter, width, clearance, 1.0e-5_wp, speed)
      hint = 1
      do i = 0, 3
         load%pull = 10.0_wp**i
         call find_orbit(journal, 1.0_wp, load, [-pi, pi], 1.0e-8_wp, orbit, failure, touch)
         if (has_failed(failure, error)) return
         call place_at(orbit, 1.0_wp, hint, place)
         call load%get_load(1.0_wp, force, status)
         call moving_state(journal, place, force, state, touch)
         call carry_load(journal, force, still, status, touch)
         call check(error, abs(state%film/still%film - 1.0_wp) < 1.0e-6_wp .and. abs(state%asperity_load - still%asperity_load) &
            & <= 1.0e-4_wp*still%asperity_load .and. abs(state%boundary_torque - still%boundary_torque) &
            & <= 1.0e-4_wp*still%boundary_torque, "asperities")
         if (allocated(error)) return
      end do
      call check(error, still%asperity_load > 0.5_wp*norm2(force), "asperities never touch")
   end subroutine test_mixed

   subroutine test_light(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(orbit_t) :: orbit
      type(swinging_t) :: load
      type(error_t), allocatable :: failure
      integer :: i

      journal = bearing_of(short)
      do i = 0, 4
         load = swinging_t(10.0_wp**(-i)*journal%unit_load, 1.0e-2_wp*10.0_wp**(-i)*journal%unit_load)
         call find_orbit(journal, 1.0_wp, load, [-pi, pi], 1.0e-6_wp, orbit, failure)
         if (has_failed(failure, error)) return
         ! plain turns take hundreds: what is left of a disturbance after a turn is near 1
         call check(error, orbit%turns <= 15, "turns")
         if (allocated(error)) return
      end do
   end subroutine test_light

   subroutine test_accuracy(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(orbit_t) :: orbit, exact
      type(swinging_t) :: load
      type(error_t), allocatable :: failure
      real(wp) :: place(2), expected(2)
      integer :: i, k, law, hints(2)

      hints = 1
      do law = short, finite
         journal = bearing_of(law)
         load = swinging_t(20.0_wp*journal%unit_load, 0.2_wp*journal%unit_load)
         call find_orbit(journal, 1.0_wp, load, [-pi, pi], 1.0e-10_wp, exact, failure)
         do k = 3, 7
            if (.not. allocated(failure)) call find_orbit(journal, 1.0_wp, load, [-pi, pi], 10.0_wp**(-k), orbit, failure)
            if (has_failed(failure, error)) return
            do i = 1, 360
               call place_at(orbit, i*degree, hints(1), place)
               call place_at(exact, i*degree, hints(2), expected)
               ! errors of steps add up, and the orbit forgets them again
               call check(error, norm2(place - expected) < 10.0_wp*10.0_wp**(-k)*(1.0_wp - norm2(expected)), "place")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_accuracy

   !> A case with two cams on three bearings
   function two_cams() result(case)
      type(case_t) :: case

      case = thesis_case()
      call set_point(case, point_speeds(2), point_viscosities(2))
      case%cam_bearings = three_bearings()
      case%cam_bearings%journal_motion = "orbit"
   end function two_cams

   subroutine test_case(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: with, without
      type(error_t), allocatable :: failure
      real(wp), allocatable :: x(:), y(:), all(:)
      character(len=10) :: name
      integer :: i

      case = two_cams()
      call run_case(case, with, failure)
      case%cam_bearings%journal_motion = "quasi_steady"
      if (.not. allocated(failure)) call run_case(case, without, failure)
      if (has_failed(failure, error)) return
      do i = 1, size(without%series)
         if (without%series(i)%scope(:7) == "bearing" .or. index(without%series(i)%name, "torque") == 1 .or. &
            & without%series(i)%name == "energy_residual") cycle
         call check(error, maxval(abs(series_of(with, without%series(i)%name) - without%series_values(:, i))) <= 0.0_wp, &
            & without%series(i)%name//" has changed")
         if (allocated(error)) return
      end do
      allocate (all(size(with%angle)))
      all = 0.0_wp
      do i = 1, 3
         write (name, "(a, i0, a)") "bearing_", i, "_"
         x = series_of(with, trim(name)//"eccentricity_x")
         y = series_of(with, trim(name)//"eccentricity_y")
         all = all + series_of(with, trim(name)//"torque")
         call check(error, maxval(abs(hypot(x, y) - series_of(with, trim(name)//"eccentricity"))) < 1.0e-14_wp, "eccentricity")
         if (allocated(error)) return
         ! the film gives way in its own time: it is thicker than at rest where the load is largest
         call check(error, minval(series_of(with, trim(name)//"film_min")) &
            & > 1.05_wp*minval(series_of(without, trim(name)//"film_min")), "the orbit is that of a journal at rest")
         if (allocated(error)) return
      end do
      call check(error, maxval(abs(all - series_of(with, "torque_bearings"))) < 1.0e-14_wp, "torques do not add up")
      if (allocated(error)) return
      ! the bearings' torque is no smaller than shear of a film all round with the journal in the middle
      call check(error, minval(all) > 3.0_wp*0.99_wp*two_pi*point_viscosities(2)*point_speeds(2)*11.5e-3_wp**3*20.0e-3_wp &
         & /47.5e-6_wp, "less than Petroff's torque")
   end subroutine test_case

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(case_t) :: case
      type(result_t) :: result
      type(shaft_simulation_t) :: shaft

      case = two_cams()
      call start_shaft(shaft, case, 0.0_wp, failure)
      call expect_error(error, failure, kind_usage, "quasi_steady")
      if (allocated(error)) return
      case%cam_bearings%law = journal_law_names(1)
      call run_case(case, result, failure)
      call expect_error(error, failure, kind_deck, "short_ocvirk")
      if (allocated(error)) return
      case = two_cams()
      case%cam_bearings%journal_motion = "hop"
      call run_case(case, result, failure)
      call check(error, allocated(failure), "an unknown motion is accepted")
   end subroutine test_refusals

end module test_journal_orbit
