!> Journal bearings: closed forms, published tables, limits, refusals.
module test_journal
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_journal, only : cam_bearings_t, journal_t, journal_law_names, new_journal, &
      journal_at_speed, find_tangent, film_friction, film_at, film_t, journal_solved, journal_without_film
   use camroller_bearing_asperity, only : bearing_state_t, carry_load
   use camroller_quadrature, only : gauss_legendre
   use labelled_table, only : read_table
   use closeness, only : expect_error
   implicit none
   private

   public :: collect_journal

   !> A camshaft bearing [m], [m], [m], [Pa s], [rad/s]
   real(wp), parameter :: diameter = 26.0e-3_wp, width = 18.0e-3_wp, clearance = 0.05e-3_wp, viscosity = 0.05_wp, &
      speed = 50.0_wp
   !> Places in the list of laws
   integer, parameter :: long = 1, short = 2, finite = 3

contains

   subroutine collect_journal(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("long bearing: closed forms of Sommerfeld number and friction", test_long), &
         new_unittest("short bearing: Ocvirk's table", test_short), &
         new_unittest("friction of a short bearing is the shear of its film on the journal", test_shear), &
         new_unittest("finite bearing: Raimondi and Boyd's table", test_finite), &
         new_unittest("finite bearing: Reynolds' equation at other widths, within the errors stated", test_between), &
         new_unittest("for narrow bearings the finite and the short law agree", test_narrow), &
         new_unittest("without load the friction is Petroff's", test_unloaded), &
         new_unittest("under light loads the eccentricity is proportional to the load", test_light), &
         new_unittest("under heavy loads the friction tends to its limit", test_heavy), &
         new_unittest("friction rises with the magnitude of the load", test_monotonic), &
         new_unittest("the torque is friction times radius", test_torque), &
         new_unittest("without viscosity there is no friction, and a status reports it", test_no_film), &
         new_unittest("impossible bearings are refused with a message", test_refusals) &
         ]
   end subroutine collect_journal

   !> Friction and eccentricity of the bearing above with another width, and at another speed
   subroutine solve(law, length, load, friction, e, other_speed)
      !> Place in the list of laws
      integer, intent(in) :: law
      !> Width [m]
      real(wp), intent(in) :: length
      !> Load [N]
      real(wp), intent(in) :: load
      !> Friction [N]
      real(wp), intent(out) :: friction
      !> Eccentricity over clearance [-]
      real(wp), intent(out) :: e
      !> Speed of the shaft [rad/s]
      real(wp), intent(in), optional :: other_speed
      type(journal_t) :: journal
      real(wp) :: t
      integer :: status

      journal = journal_at_speed(law, diameter, length, clearance, viscosity, speed)
      if (present(other_speed)) journal = journal_at_speed(law, diameter, length, clearance, viscosity, other_speed)
      call find_tangent(journal, load, t, status)
      friction = film_friction(journal, load, t)
      e = t/sqrt(1.0_wp + t**2)
      if (status /= journal_solved) e = -huge(e)
   end subroutine solve

   !> Load for a Sommerfeld number eta N D L/W (r/c)^2, N in rev/s
   pure function load_of(sommerfeld, length) result(load)
      !> Sommerfeld number [-]
      real(wp), intent(in) :: sommerfeld
      !> Width [m]
      real(wp), intent(in) :: length
      !> Load [N]
      real(wp) :: load

      load = viscosity*speed/(2.0_wp*pi)*length*diameter/sommerfeld*(0.5_wp*diameter/clearance)**2
   end function load_of

   !> Petroff's friction
   pure function petroff(length) result(friction)
      !> Width [m]
      real(wp), intent(in) :: length
      !> Friction [N]
      real(wp) :: friction

      friction = 2.0_wp*pi*viscosity*speed*(0.5_wp*diameter)**2*length/clearance
   end function petroff

   subroutine test_long(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: e, friction, found, expected, sommerfeld
      integer :: i

      do i = 1, 99
         e = 0.01_wp*real(i, wp)
         sommerfeld = (2.0_wp + e**2)*sqrt(1.0_wp - e**2)/(12.0_wp*pi**2*e)
         expected = 2.0_wp*(0.5_wp*diameter)**2*viscosity*speed/(2.0_wp*pi)*width/clearance &
            *4.0_wp*pi**2*(1.0_wp + 2.0_wp*e**2)/((2.0_wp + e**2)*sqrt(1.0_wp - e**2))
         call solve(long, width, load_of(sommerfeld, width), friction, found)
         call check(error, abs(found - e) < 1.0e-13_wp, "eccentricity")
         if (allocated(error)) return
         ! e near one loses a factor 1/(1 - e^2), 50, of its digits in the formula of the test
         call check(error, abs(friction/expected - 1.0_wp) < 1.0e-12_wp, "friction")
         if (allocated(error)) return
      end do
   end subroutine test_long

   subroutine test_short(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: rows(:, :)
      real(wp) :: friction, found, length, load, beside
      integer :: i

      call read_table("ocvirk.csv", 5, rows, error)
      if (allocated(error)) return
      length = 0.3_wp*diameter
      do i = 1, size(rows, 2)
         associate (e => rows(1, i), load_number => rows(2, i), ratio => rows(5, i))
            load = load_number*viscosity*speed*0.5_wp*diameter*length**3/clearance**2
            call solve(short, length, load, friction, found)
            ! half of the moment of the load beside the centre is not in the table's friction
            beside = load*clearance/diameter*e*sin(rows(4, i)*degree)
            ! digits of the table: five in the load number, six in the friction
            call check(error, abs(found - e) < 1.0e-5_wp .and. abs((friction - beside)/petroff(length)/ratio - 1.0_wp) < 2.0e-5_wp)
            if (allocated(error)) return
            call solve(short, length, load_of(rows(3, i)/0.3_wp**2, length), friction, found)
            ! four digits in the smallest Sommerfeld number
            call check(error, abs(found - e) < 1.0e-4_wp, "Sommerfeld number")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_short

   !> On the journal the shear is `eta U/h + h/2 dp/dx`, with the pressure of the short bearing in the half where the film becomes
   !> thinner, `p = 3 eta omega/c^2 (L^2/4 - z^2) e sin/(1 + e cos)^3`, of which the integral over the width is taken by hand
   subroutine test_shear(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: points = 200
      ! Angles from the widest film [rad] and their weights; film over clearance, its slope [-]
      real(wp), dimension(points) :: angles, weights, film, slope
      ! Pressure times width [N/m], its slope over the angle
      real(wp), dimension(points) :: pressure, change
      real(wp) :: e, scale, load(2), expected, friction, found
      integer :: i

      call gauss_legendre(angles, weights)
      angles = 0.5_wp*pi*(1.0_wp + angles)
      weights = 0.5_wp*pi*weights
      do i = 1, 9
         e = 0.1_wp*i
         film = 1.0_wp + e*cos(angles)
         slope = -e*sin(angles)
         scale = viscosity*speed*width**3/(2.0_wp*clearance**2)
         pressure = scale*e*sin(angles)/film**3
         change = scale*e*(cos(angles)/film**3 - 3.0_wp*sin(angles)*slope/film**4)
         load = 0.5_wp*diameter*[sum(weights*pressure*cos(angles)), sum(weights*pressure*sin(angles))]
         expected = 2.0_wp*viscosity*speed*(0.5_wp*diameter)**2*width/clearance*sum(weights/film) &
            + 0.5_wp*clearance*sum(weights*film*change)
         call solve(short, width, norm2(load), friction, found)
         ! Gauss' rule of 200 points is exact to rounding here
         call check(error, abs(found - e) < 1.0e-12_wp .and. abs(friction/expected - 1.0_wp) < 1.0e-12_wp)
         if (allocated(error)) return
      end do
      ! at 0.9 the pressure has its share in it
      call check(error, friction > 1.2_wp*petroff(width)/sqrt(1.0_wp - e**2), "no share of the pressure")
   end subroutine test_shear

   subroutine test_finite(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: rows(:, :)
      real(wp) :: friction, found, length, load
      integer :: i

      call read_table("raimondi_boyd.csv", 5, rows, error)
      if (allocated(error)) return
      do i = 1, size(rows, 2)
         length = rows(1, i)*diameter
         load = load_of(rows(3, i), length)
         call solve(finite, length, load, friction, found)
         ! what the fit reaches against the numerical solutions, see its description
         call check(error, abs(found - rows(2, i)) < 0.01_wp, "eccentricity")
         if (allocated(error)) return
         call check(error, abs(friction/load*0.5_wp*diameter/clearance/rows(5, i) - 1.0_wp) < 0.02_wp, &
            "friction variable")
         if (allocated(error)) return
      end do
   end subroutine test_finite

   subroutine test_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(journal_t) :: journal
      type(film_t) :: film
      real(wp), allocatable :: rows(:, :)
      real(wp) :: friction, found, length, expected
      integer :: i

      call read_table("finite_bearing.csv", 4, rows, error)
      if (allocated(error)) return
      do i = 1, size(rows, 2)
         associate (e => rows(2, i), number => rows(3, i), attitude => rows(4, i)*degree)
            length = rows(1, i)*diameter
            journal = journal_at_speed(finite, diameter, length, clearance, viscosity, speed)
            film = film_at(journal, e/sqrt(1.0_wp - e**2))
            ! theory.md, section 15: load of the fit -10.4 to 5.7 %; at a load film -4.9 to 4.1 %, friction -1.9 to 1.8 %
            call check(error, film%number/number > 0.89_wp .and. film%number/number < 1.06_wp, "load")
            if (allocated(error)) return
            call solve(finite, length, number*journal%unit_load, friction, found)
            call check(error, (1.0_wp - found)/(1.0_wp - e) > 0.95_wp .and. (1.0_wp - found)/(1.0_wp - e) < 1.045_wp, "film")
            if (allocated(error)) return
            ! Petroff's friction over the root and half the moment of the load
            expected = petroff(length)*(1.0_wp/sqrt(1.0_wp - e**2) + 0.5_wp*number*e*sin(attitude)/(2.0_wp*pi))
            call check(error, abs(friction/expected - 1.0_wp) < 0.02_wp, "friction")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_between

   subroutine test_narrow(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: friction, e(2), length, load
      integer :: i

      length = 0.1_wp*diameter
      do i = 1, 9
         load = load_of(1.0_wp/(0.1_wp*real(i, wp)), length)
         call solve(short, length, load, friction, e(1))
         call solve(finite, length, load, friction, e(2))
         ! two different ends of the film (half film, and Reynolds' condition in the fit): a few per cent
         call check(error, abs(e(2) - e(1)) < 0.03_wp)
         if (allocated(error)) return
      end do
   end subroutine test_narrow

   subroutine test_unloaded(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: friction, e
      integer :: law

      do law = 1, size(journal_law_names)
         call solve(law, width, 0.0_wp, friction, e)
         call check(error, abs(e) <= 0.0_wp .and. abs(friction/petroff(width) - 1.0_wp) < 100.0_wp*epsilon(1.0_wp), &
            journal_law_names(law))
         if (allocated(error)) return
         call solve(law, width, tiny(1.0_wp), friction, e)
         call check(error, abs(e) < 1.0e-300_wp &
            .and. abs(friction/petroff(width) - 1.0_wp) < 100.0_wp*epsilon(1.0_wp), &
            "smallest load, "//journal_law_names(law))
         if (allocated(error)) return
      end do
   end subroutine test_unloaded

   subroutine test_light(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: friction, small, large
      integer :: law

      do law = 1, size(journal_law_names)
         call solve(law, width, 1.0e-9_wp, friction, small)
         call solve(law, width, 2.0e-9_wp, friction, large)
         ! eccentricities near 1e-13: the next term is of relative size e
         call check(error, abs(large/small - 2.0_wp) < 1.0e-11_wp, journal_law_names(law))
         if (allocated(error)) return
      end do
   end subroutine test_light

   subroutine test_heavy(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: friction, e
      integer :: law

      do law = 1, size(journal_law_names)
         call solve(law, width, 1.0e20_wp, friction, e)
         call check(error, e <= 1.0_wp .and. e > 1.0_wp - 1.0e-4_wp, journal_law_names(law))
         if (allocated(error)) return
         if (law == long) call check(error, &
            abs(friction/(1.0e20_wp*clearance/(0.5_wp*diameter)) - 1.0_wp) < 1.0e-12_wp, &
            "friction of the fully displaced long bearing")
         if (allocated(error)) return
      end do
   end subroutine test_heavy

   subroutine test_monotonic(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: friction, before, e, e_before, mirrored, length, load
      integer :: i, k, law

      do law = 1, size(journal_law_names)
         do k = 1, 10
            length = 0.1_wp*real(k, wp)*diameter
            before = 0.0_wp
            e_before = -1.0_wp
            do i = 0, 60
               load = 10.0_wp**(0.1_wp*real(i, wp) - 1.0_wp)
               call solve(law, length, load, friction, e)
               call solve(law, length, -load, mirrored, e, -speed)
               call check(error, friction > before .and. e > e_before .and. abs(friction - mirrored) <= 0.0_wp, &
                  journal_law_names(law))
               if (allocated(error)) return
               before = friction
               e_before = e
            end do
         end do
      end do
   end subroutine test_monotonic

   subroutine test_torque(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(journal_t) :: journal
      type(bearing_state_t) :: state
      real(wp) :: friction, e
      integer :: law, status

      do law = 1, size(journal_law_names)
         call new_journal(journal, cam_bearings_t(journal_law_names(law), diameter, width, clearance), viscosity, &
            speed, failure)
         call carry_load(journal, [700.0_wp, 0.0_wp], state, status)
         call solve(law, width, 700.0_wp, friction, e)
         call check(error, abs(state%torque/(friction*0.5_wp*diameter) - 1.0_wp) <= epsilon(1.0_wp), journal_law_names(law))
         if (allocated(error)) return
      end do
   end subroutine test_torque

   subroutine test_no_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(bearing_state_t) :: state
      integer :: status

      call carry_load(journal_at_speed(long, diameter, width, clearance, viscosity, 0.0_wp), [100.0_wp, 0.0_wp], state, status)
      call check(error, status == journal_without_film .and. abs(state%torque) <= 0.0_wp)
   end subroutine test_no_film

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(journal_t) :: journal

      call new_journal(journal, cam_bearings_t("ball", diameter, width, clearance), viscosity, speed, failure)
      call expect_error(error, failure, kind_deck, "known are 'long_full_sommerfeld'")
      if (allocated(error)) return
      call new_journal(journal, cam_bearings_t("finite", diameter, 2.0_wp*diameter, clearance), viscosity, speed, &
         failure)
      call expect_error(error, failure, kind_deck, "covers widths from 0.1 to 1 diameter")
      if (allocated(error)) return
      call new_journal(journal, cam_bearings_t("finite", diameter, width, clearance), viscosity, 0.0_wp, failure)
      call expect_error(error, failure, kind_domain, "speed")
   end subroutine test_refusals

end module test_journal
