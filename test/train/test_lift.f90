!> Lift laws: closed forms, continuity, derivatives, tables, refusals.
module test_lift
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_lift, only : lift_t, lift_law_t, lift_law_names, new_lift_law, evaluate_lift, is_at_rest, stop_angles
   implicit none
   private

   public :: collect_lift

   !> Lift and half angles of the analytic laws [m], [rad]
   real(wp), parameter :: height = 9.5e-3_wp, opening = 70.0_wp*degree, closing = 65.0_wp*degree
   !> Laws with half angles: all but the last two
   integer, parameter :: n_analytic = 5

contains

   subroutine collect_lift(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("each law peaks at full lift and is zero in the dwell", test_peak_and_dwell), &
         new_unittest("lift, slope and curvature are zero at the ends of the event", test_edges), &
         new_unittest("curvature is continuous at the nose", test_nose), &
         new_unittest("derivatives agree with central differences", test_derivatives), &
         new_unittest("values at half the half angle are the closed forms", test_closed_forms), &
         new_unittest("polydyne with exponents 4 6 8 10 is a power law", test_polydyne), &
         new_unittest("angles are taken modulo a turn", test_turns), &
         new_unittest("stops are where the third derivative jumps", test_stops), &
         new_unittest("a fine table gives the law it was made from", test_table), &
         new_unittest("rows at rest change nothing", test_rest), &
         new_unittest("noise about zero at rest is no lift", test_noisy_rest), &
         new_unittest("a table of a full turn repeats itself", test_periodic_table), &
         new_unittest("a table that does not lie about zero is wrapped", test_shifted_table), &
         new_unittest("impossible laws are refused in words", test_refusals), &
         new_unittest("impossible tables are refused in words", test_table_refusals) &
         ]
   end subroutine collect_lift

   !> An analytic law, with unequal halves where it can have them
   subroutine make_law(i, law, last)
      !> Place in the list of names
      integer, intent(in) :: i
      !> The law
      type(lift_law_t), intent(out) :: law
      !> End of the event [rad]
      real(wp), intent(out) :: last
      type(error_t), allocatable :: failure
      type(lift_t) :: lift

      last = closing
      if (lift_law_names(i) == "power" .or. lift_law_names(i) == "polydyne") last = opening
      lift%law = lift_law_names(i)
      lift%max_lift = height
      lift%opening_half_angle = opening
      lift%closing_half_angle = last
      if (lift%law == "power") lift%exponents = [3]
      if (lift%law == "polydyne") lift%exponents = [6, 8, 10, 12]
      call new_lift_law(law, lift, failure)
      if (allocated(failure)) error stop "a valid lift law is refused"
   end subroutine make_law

   subroutine test_peak_and_dwell(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: f(0:3), last
      integer :: i, k

      do i = 1, n_analytic
         call make_law(i, law, last)
         call evaluate_lift(law, 0.0_wp, f)
         call check(error, abs(f(0) - height) < 100.0_wp*epsilon(1.0_wp)*height .and. abs(f(1)) < epsilon(1.0_wp), &
            "peak of "//lift_law_names(i))
         if (allocated(error)) return
         do k = 1, 20
            call evaluate_lift(law, last + real(k, wp)/20.0_wp*(two_pi - opening - last), f)
            if (k == 20) call evaluate_lift(law, -opening - 1.0e-12_wp, f)
            call check(error, all(abs(f) <= 0.0_wp), "dwell of "//lift_law_names(i))
            if (allocated(error)) return
         end do
         call check(error, is_at_rest(law, last) .and. is_at_rest(law, last + 1.0_wp - two_pi) .and. is_at_rest(law, pi) .and. &
            & .not. any([is_at_rest(law, -opening), is_at_rest(law, 0.0_wp), is_at_rest(law, two_pi + 0.99_wp*last)]), &
            & "rest of "//lift_law_names(i))
         if (allocated(error)) return
      end do
   end subroutine test_peak_and_dwell

   subroutine test_edges(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: f(0:3), g(0:3), last
      integer :: i
      ! Taylor: the curvature at h from the end is at most h times the third derivative
      real(wp), parameter :: h = 1.0e-7_wp

      do i = 1, n_analytic
         call make_law(i, law, last)
         call evaluate_lift(law, -opening + h, f)
         call evaluate_lift(law, last - h, g)
         call check(error, abs(f(2)) < 1.01_wp*h*abs(f(3)) + 1.0e-12_wp &
            .and. abs(g(2)) < 1.01_wp*h*abs(g(3)) + 1.0e-12_wp &
            .and. abs(f(1)) < 1.0e-12_wp .and. abs(g(1)) < 1.0e-12_wp &
            .and. abs(f(0)) < 1.0e-15_wp .and. abs(g(0)) < 1.0e-15_wp, lift_law_names(i))
         if (allocated(error)) return
      end do
   end subroutine test_edges

   subroutine test_nose(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: f(0:3), g(0:3), last
      integer :: i
      real(wp), parameter :: h = 1.0e-9_wp

      do i = 1, n_analytic
         call make_law(i, law, last)
         call evaluate_lift(law, -h, f)
         call evaluate_lift(law, h, g)
         call check(error, abs(g(2) - f(2)) < 3.0_wp*h*max(abs(f(3)), abs(g(3)), 1.0e-6_wp), lift_law_names(i))
         if (allocated(error)) return
      end do
   end subroutine test_nose

   subroutine test_derivatives(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: low(0:3), mid(0:3), high(0:3), last, x
      ! truncation of the central difference is h^2/6 times a derivative two orders higher: at most 1e-10/6 * 500
      ! height, its round-off epsilon/h; both below sqrt(epsilon) times the scale of each derivative
      real(wp), parameter :: h = 1.0e-5_wp
      integer :: i, k

      do i = 1, n_analytic
         call make_law(i, law, last)
         do k = 1, 40
            x = -opening + 0.01_wp + real(k, wp)*0.057_wp
            call evaluate_lift(law, x - h, low)
            call evaluate_lift(law, x, mid)
            call evaluate_lift(law, x + h, high)
            call check(error, all(abs((high(0:2) - low(0:2))/(2.0_wp*h) - mid(1:3)) < &
               height*sqrt(epsilon(h))*[10.0_wp, 30.0_wp, 100.0_wp]), lift_law_names(i))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_derivatives

   subroutine test_closed_forms(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: f(0:3), last, expected(0:3)
      integer :: i

      do i = 1, n_analytic
         call make_law(i, law, last)
         call evaluate_lift(law, -0.5_wp*opening, f)
         f = f/height*[1.0_wp, opening, opening**2, opening**3]
         select case (lift_law_names(i))
         case ("power")
            expected = [27.0_wp/64.0_wp, 27.0_wp/16.0_wp, 9.0_wp/8.0_wp, -21.0_wp]
         case ("polynomial_345")
            expected = [0.5_wp, 1.875_wp, 0.0_wp, -30.0_wp]
         case ("polynomial_4567")
            expected = [0.5_wp, 2.1875_wp, 0.0_wp, -52.5_wp]
         case ("cycloidal")
            expected = [0.5_wp, 2.0_wp, 0.0_wp, -4.0_wp*pi**2]
         case default
            cycle
         end select
         call check(error, all(abs(f - expected) < 100.0_wp*epsilon(1.0_wp)*max(1.0_wp, abs(expected))), &
            lift_law_names(i))
         if (allocated(error)) return
      end do
   end subroutine test_closed_forms

   subroutine test_polydyne(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: polydyne, power
      real(wp) :: f(0:3), g(0:3)
      integer :: k

      call new_lift_law(polydyne, lift_t("polydyne", height, opening, opening, [4, 6, 8, 10]), failure)
      call new_lift_law(power, lift_t("power", height, opening, opening, [5]), failure)
      do k = -70, 69
         call evaluate_lift(polydyne, real(k, wp)*degree, f)
         call evaluate_lift(power, real(k, wp)*degree, g)
         ! coefficients 1 -5 10 -10 5 -1, times up to 10*9*8 in the third derivative
         call check(error, all(abs(f - g) < epsilon(1.0_wp)*height*[32.0_wp, 200.0_wp, 2000.0_wp, 20000.0_wp]))
         if (allocated(error)) return
      end do
   end subroutine test_polydyne

   subroutine test_turns(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp) :: f(0:3), g(0:3), last, x
      integer :: i, k, turn

      do i = 1, n_analytic
         call make_law(i, law, last)
         do turn = -3, 3
            do k = -17, 17
               x = 0.1_wp*real(k, wp)
               call evaluate_lift(law, x, f)
               call evaluate_lift(law, x + real(turn, wp)*two_pi, g)
               ! the angle itself is rounded to 4e-15
               call check(error, all(abs(f - g) < height*1.0e-14_wp*[10.0_wp, 30.0_wp, 100.0_wp, 400.0_wp]), &
                  lift_law_names(i))
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_turns

   subroutine test_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(lift_law_t) :: law
      real(wp), allocatable :: stops(:)
      real(wp) :: low(0:3), high(0:3), last, x
      real(wp), parameter :: h = 1.0e-7_wp
      integer :: i, k

      do i = 1, n_analytic
         call make_law(i, law, last)
         stops = stop_angles(law)
         call check(error, abs(stops(1) + opening) <= 0.0_wp .and. abs(stops(size(stops)) - last) <= 0.0_wp, &
            "ends of "//lift_law_names(i))
         if (allocated(error)) return
         do k = -3141, 3141
            x = 1.0e-3_wp*real(k, wp)
            call evaluate_lift(law, x - h, low)
            call evaluate_lift(law, x + h, high)
            ! a continuous third derivative changes by 2 h times the fourth, below 3000 height
            if (abs(high(3) - low(3)) < 1.0e-2_wp*height) cycle
            call check(error, any(abs(stops - x) < 2.0_wp*h), "no stop at a jump of "//lift_law_names(i))
            if (allocated(error)) return
         end do
      end do
      call make_law(3, law, last)
      call check(error, size(stop_angles(law)) == 3, "nose of the 3-4-5 polynomial")
   end subroutine test_stops

   !> Lift of a power law at table angles
   subroutine tabulate(angle, lift)
      !> Angles [rad]
      real(wp), intent(in) :: angle(:)
      !> Lift [m]
      real(wp), intent(out) :: lift(:)
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      real(wp) :: f(0:3)
      integer :: i

      call new_lift_law(law, lift_t("power", height, opening, opening, [6]), failure)
      do i = 1, size(angle)
         call evaluate_lift(law, angle(i), f)
         lift(i) = f(0)
      end do
   end subroutine tabulate

   subroutine test_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law, power
      type(lift_t) :: lift
      real(wp) :: f(0:3), g(0:3)
      integer :: i

      lift%law = "table"
      allocate (lift%table_lift(141))
      lift%table_angle = [(real(i, wp)*degree, i=-70, 70)]
      call tabulate(lift%table_angle, lift%table_lift)
      call new_lift_law(law, lift, failure)
      call check(error, allocated(failure), .false., "refused")
      if (allocated(error)) return
      call new_lift_law(power, lift_t("power", height, opening, opening, [6]), failure)
      do i = -1000, 1000
         call evaluate_lift(law, 1.0e-3_wp*pi*real(i, wp), f)
         call evaluate_lift(power, 1.0e-3_wp*pi*real(i, wp), g)
         ! h = 1 deg is 1/70 of the half angle; errors h^(6 - k) times the sixth derivative, near 6!*2^6
         call check(error, all(abs(f - g) < 5.0e4_wp*height/opening**6* &
            [degree**6, degree**5, degree**4, degree**3]), "table far from its law")
         if (allocated(error)) return
      end do
      call check(error, all(abs(stop_angles(law) - opening*[-1, 1]) < 1.0e-15_wp), "stops")
   end subroutine test_table

   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: short, long
      type(lift_t) :: lift
      real(wp) :: f(0:3), g(0:3)
      integer :: i

      lift%law = "table"
      lift%table_angle = [(real(i, wp)*degree, i=-180, 180)]
      allocate (lift%table_lift(361))
      call tabulate(lift%table_angle, lift%table_lift)
      lift%table_lift([111, 251]) = 0.0_wp
      lift%smoothing = 2.0e-6_wp
      call new_lift_law(long, lift, failure)
      call check(error, allocated(failure), .false., "refused")
      if (allocated(error)) return
      lift%table_angle = lift%table_angle(111:251)
      lift%table_lift = lift%table_lift(111:251)
      call new_lift_law(short, lift, failure)
      do i = -180, 179
         call evaluate_lift(short, real(i, wp)*degree + 0.001_wp, f)
         call evaluate_lift(long, real(i, wp)*degree + 0.001_wp, g)
         call check(error, all(abs(f - g) <= 0.0_wp))
         if (allocated(error)) return
      end do
   end subroutine test_rest

   !> Of either sign, and cut at zero.
   subroutine test_noisy_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      type(lift_t) :: lift
      integer :: i

      lift%law = "table"
      lift%smoothing = 2.0e-6_wp
      lift%table_angle = [(real(i, wp)*degree, i=-180, 179)]
      allocate (lift%table_lift(360))
      call tabulate(lift%table_angle, lift%table_lift)
      lift%table_lift = lift%table_lift + lift%smoothing*sqrt(2.0_wp)*sin([(real(i, wp)**2, i=1, 360)])
      do i = 1, 2
         call new_lift_law(law, lift, failure)
         call check(error, allocated(failure), .false., "refused")
         if (allocated(error)) return
         call check(error, maxval(abs(abs(stop_angles(law)) - opening)), 0.0_wp, thr=15.0_wp*degree, message="event")
         if (allocated(error)) return
         lift%table_lift = max(0.0_wp, lift%table_lift)
      end do
   end subroutine test_noisy_rest

   subroutine test_periodic_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      type(lift_t) :: lift
      real(wp) :: f(0:3), x
      integer :: i

      lift%law = "table"
      lift%table_angle = [(real(i, wp)*degree, i=-180, 180, 2)]
      lift%table_lift = 0.5_wp*height*(1.0_wp + cos(lift%table_angle))
      call new_lift_law(law, lift, failure)
      call check(error, allocated(failure), .false., "refused")
      if (allocated(error)) return
      call check(error, size(stop_angles(law)) == 0, "a periodic table has no stops")
      if (allocated(error)) return
      do i = -500, 500
         x = 0.01_wp*real(i, wp)
         call evaluate_lift(law, x, f)
         ! h^(6 - k) times a sixth derivative of one, with a factor below 0.1
         call check(error, all(abs(f - 0.5_wp*height*[1.0_wp + cos(x), -sin(x), -cos(x), sin(x)]) < &
            height*0.1_wp*(2.0_wp*degree)**[6, 5, 4, 3]))
         if (allocated(error)) return
      end do
   end subroutine test_periodic_table

   subroutine test_shifted_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law, shifted
      type(lift_t) :: lift
      real(wp) :: f(0:3), g(0:3)
      integer :: i

      lift%law = "table"
      allocate (lift%table_lift(141))
      lift%table_angle = [(real(i, wp)*degree, i=-70, 70)]
      call tabulate(lift%table_angle, lift%table_lift)
      call new_lift_law(law, lift, failure)
      lift%table_angle = lift%table_angle + two_pi
      call new_lift_law(shifted, lift, failure)
      do i = -180, 179
         call evaluate_lift(law, real(i, wp)*degree + 0.001_wp, f)
         call evaluate_lift(shifted, real(i, wp)*degree + 0.001_wp, g)
         call check(error, all(abs(f - g) < height*1.0e-11_wp*[1.0_wp, 10.0_wp, 100.0_wp, 1000.0_wp]))
         if (allocated(error)) return
      end do
      call check(error, all(abs(stop_angles(law) - stop_angles(shifted)) < 1.0e-14_wp), "stops")
   end subroutine test_shifted_table

   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law

      call new_lift_law(law, lift_t("spline", height, opening, opening), failure)
      call expect(error, failure, "unknown lift law 'spline'; known are 'power', 'polydyne'")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("cycloidal", 0.0_wp, opening, opening), failure)
      call expect(error, failure, "needs a maximum lift above zero")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("cycloidal", height, opening, 3.2_wp), failure)
      call expect(error, failure, "half angle above 0 and up to 180 deg")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("power", height, opening, closing, [4]), failure)
      call expect(error, failure, "must be equal, or the acceleration would jump at full lift")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("power", height, opening, opening), failure)
      call expect(error, failure, "'power' needs one exponent")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("power", height, opening, opening, [2]), failure)
      call expect(error, failure, "must be at least 3")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("polydyne", height, opening, opening, [4, 6, 8]), failure)
      call expect(error, failure, "'polydyne' needs four exponents")
      if (allocated(error)) return
      call new_lift_law(law, lift_t("polydyne", height, opening, opening, [2, 6, 8, 10]), failure)
      call expect(error, failure, "must be above 2 and increase")
   end subroutine test_refusals

   subroutine test_table_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law
      type(lift_t) :: lift, good
      integer :: i

      lift%law = "table"
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "needs a table")
      if (allocated(error)) return
      good = lift
      good%table_angle = [(0.1_wp*real(i, wp), i=-10, 10)]
      good%table_lift = height*(1.0_wp - good%table_angle**2)**4
      good%table_lift([1, 21]) = 0.0_wp

      lift = good
      lift%table_angle = good%table_angle(:20)
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "as many lifts as angles")
      if (allocated(error)) return
      lift%table_angle = [0.0_wp]
      lift%table_lift = [0.0_wp]
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "too few rows")
      if (allocated(error)) return
      lift = good
      lift%table_angle(5) = lift%table_angle(7)
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "lift table: points of a table must increase: row 6 does not follow row 5")
      if (allocated(error)) return
      lift = good
      lift%table_lift(1) = 1.0e-5_wp
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "does not start at zero lift")
      if (allocated(error)) return
      lift = good
      lift%table_lift(21) = 1.0e-5_wp
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "does not end at zero lift")
      if (allocated(error)) return
      lift = good
      lift%table_lift(4) = -1.0e-5_wp
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "negative lift")
      if (allocated(error)) return
      lift = good
      lift%table_angle = [good%table_angle(:9), good%table_angle(14:)]
      lift%table_lift = [good%table_lift(:9), good%table_lift(14:)]
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "gap from -11.459 to 17.189 deg")
      if (allocated(error)) return
      lift = good
      lift%table_angle = 4.0_wp*good%table_angle
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "more than one turn")
      if (allocated(error)) return
      lift = good
      lift%smoothing = height
      call new_lift_law(law, lift, failure)
      call expect(error, failure, "smoothing is as large as")
   end subroutine test_table_refusals

   !> Demand a deck error with given words
   subroutine expect(error, failure, words)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable, intent(in) :: failure
      character(len=*), intent(in) :: words

      call check(error, allocated(failure), "accepted: "//words)
      if (allocated(error)) return
      call check(error, failure%kind == kind_deck .and. index(failure%message, words) > 0, &
         "message is "//failure%message)
   end subroutine expect

end module test_lift
