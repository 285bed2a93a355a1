!> Events and refusals that depend on the whole model: stops, undercut, contradictions.
module test_events
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_case, only : case_t
   use camroller_model, only : model_t, new_model
   use camroller_kinematics, only : position_t, rotation_names
   use camroller_dynamics, only : load_arm_names, moments_t
   use camroller_state, only : state_t, evaluate_state, evaluate_loading
   use camroller_cam_check, only : check_geometry
   use camroller_events, only : find_stops, find_stops_between, cycle_stops, contact_losses
   use closeness, only : check_scaled, expect_error, has_failed
   use reference_cases, only : thesis_case, source_case, skewed_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_events

contains

   subroutine collect_events(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("ends of the event and lift-off of the valve from its seat are stops", test_stops), &
         new_unittest("loss and return of contact are stops", test_loss_stops), &
         new_unittest("a loss or return of contact shorter than a step of the scan is detected", test_short_losses), &
         new_unittest("the change from the adjuster's to the spring's load is a stop with seating 'maximum'", test_load_stops), &
         new_unittest("stops of a cycle that starts at any angle are in order", test_cycle_stops), &
         new_unittest("stops between two angles several turns apart", test_stops_between), &
         new_unittest("an undercut cam is refused, and the message states the angle", test_undercut), &
         new_unittest("a hollow narrower than a quarter of a degree is detected", test_narrow_hollow), &
         new_unittest("a hollow flank is refused for a large grinding wheel and accepted for a small one", test_wheel), &
         new_unittest("a lift that the finger cannot reach is refused, and the message states the angle", test_reach), &
         new_unittest("energy 'consistent' refuses all options that contradict it, in one message", test_contradictions), &
         new_unittest("an adjuster force that would open the valve is refused, and the message states both forces", &
            & test_adjuster), &
         new_unittest("an unknown name is refused with a list of the known ones", test_names), &
         new_unittest("impossible numbers are refused", test_numbers) &
         ]
   end subroutine collect_events

   subroutine test_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      real(wp), allocatable :: stops(:)
      ! Angle at which the valve has left its seat [rad]: 9.5 mm (1 - x^2)^4 is the seat lift
      real(wp) :: seat_angle, expected(4)
      integer :: i

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, stops)
      call check(error, size(stops), 4)
      if (allocated(error)) return
      seat_angle = 70.0_wp*degree*sqrt(1.0_wp - (model%train%seat_lift/9.5e-3_wp)**0.25_wp)
      expected = [-70.0_wp*degree, -seat_angle, seat_angle, 70.0_wp*degree]
      do i = 1, 4
         ! the lift at the seat is flat: 35 um with a slope of 1e-3 m/rad, and both angles carry roundings
         call check_scaled(error, stops(i), expected(i), 1.0_wp, 1.0e-13_wp, "a stop")
         if (allocated(error)) return
      end do
   end subroutine test_stops

   subroutine test_loss_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: before, after
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp), allocatable :: stops(:)
      real(wp) :: force
      integer :: i, status, losses

      case = thesis_case()
      deallocate (case%valve_guide)
      call set_point(case, 6.0_wp*point_speeds(3), point_viscosities(2))
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, stops)
      losses = 0
      do i = 1, size(stops)
         call evaluate_state(model, stops(i) - 1.0e-9_wp, 0.0_wp, before, status)
         call evaluate_state(model, stops(i) + 1.0e-9_wp, 0.0_wp, after, status)
         if (before%contact%is_touching .eqv. after%contact%is_touching) cycle
         losses = losses + 1
         call evaluate_loading(model, stops(i), position, force, moments, status)
         call check_scaled(error, moments%total, 0.0_wp, moments%spring, 1.0e-13_wp, "moment where contact changes")
         if (allocated(error)) return
      end do
      call check(error, losses >= 2 .and. mod(losses, 2) == 0, "contact is not lost and found again")
   end subroutine test_loss_stops

   !> The square of the speed at which contact is lost, over the cam angle: the moment falls linearly with that square. Near the
   !> smallest of these squares contact is lost for an angle that grows with the root of the excess; near a largest it returns.
   subroutine test_short_losses(error)
      type(error_type), allocatable, intent(out) :: error
      ! Angles of a degree; excess of the squared speed: losses of about 0.6, 0.2, 0.06 and 0.02 degrees [-]
      integer, parameter :: places = 200
      real(wp), parameter :: excesses(*) = [1.0e-4_wp, 1.0e-5_wp, 1.0e-6_wp, 1.0e-7_wp]
      type(case_t) :: case
      type(model_t) :: model, slow, fast
      real(wp), allocatable :: intervals(:, :), stops(:)
      ! Squared speeds of loss [rad^2/s^2], angle of the smallest [rad]
      real(wp) :: squares(-70*places:70*places), angle
      integer :: i, place

      case = thesis_case()
      deallocate (case%valve_guide)
      call set_point(case, 1.0_wp, point_viscosities(2))
      call make_model(case, slow, error)
      if (allocated(error)) return
      call set_point(case, 100.0_wp, point_viscosities(2))
      call make_model(case, fast, error)
      if (allocated(error)) return
      do i = lbound(squares, 1), ubound(squares, 1)
         squares(i) = loss_square(slow, fast, i*degree/places)
      end do
      place = minloc(squares, 1) + lbound(squares, 1) - 1
      angle = place*degree/places
      do i = 1, size(excesses)
         call set_point(case, sqrt(squares(place)*(1.0_wp + excesses(i))), point_viscosities(2))
         call make_model(case, model, error)
         if (allocated(error)) return
         call find_stops(model, stops)
         intervals = contact_losses(model, cycle_stops(stops, -pi))
         call check(error, any(intervals(1, :) < angle .and. angle < intervals(2, :)), "a short loss of contact is not seen")
         if (allocated(error)) return
         call check(error, all(abs(intervals(2, :) - intervals(1, :)) < 1.5_wp*degree), "the loss is not short")
         if (allocated(error)) return
      end do
   end subroutine test_short_losses

   !> Squared speed at which the roller loses contact at a cam angle [rad^2/s^2]; a very large one where it does at none.
   function loss_square(slow, fast, angle) result(square)
      type(model_t), intent(in) :: slow, fast
      real(wp), intent(in) :: angle
      real(wp) :: square
      type(position_t) :: position
      type(moments_t) :: at_slow, at_fast
      real(wp) :: force
      integer :: status

      call evaluate_loading(slow, angle, position, force, at_slow, status)
      call evaluate_loading(fast, angle, position, force, at_fast, status)
      square = huge(1.0_wp)
      if (at_slow%total <= at_fast%total) return
      square = slow%speed**2 + at_slow%total*(fast%speed**2 - slow%speed**2)/(at_slow%total - at_fast%total)
   end function loss_square

   !> The larger of both loads has a kink where they are equal: every change between them that a scan meets has its stop.
   subroutine test_load_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      real(wp), allocatable :: stops(:)
      ! Angle [rad]
      real(wp) :: angle
      integer, parameter :: angles = 720
      integer :: i, arm, status, changes
      logical :: is_least, was_least

      do arm = 1, size(load_arm_names)
         case = source_case()
         case%spring%load_arm = load_arm_names(arm)
         case%spring%seating = "maximum"
         ! Too weak to keep contact round the nose
         case%spring%stiffness = 2500.0_wp
         call set_point(case, point_speeds(3), point_viscosities(2))
         call make_model(case, model, error)
         if (allocated(error)) return
         call find_stops(model, stops)
         changes = 0
         was_least = .false.
         do i = 0, angles
            angle = -pi + (i + 0.5_wp)*two_pi/angles
            call evaluate_state(model, angle, 0.0_wp, state, status)
            is_least = state%contact%load <= model%base_circle_load
            if (i > 0 .and. (is_least .neqv. was_least)) then
               changes = changes + 1
               call check_stop(angle)
               if (allocated(error)) return
            end if
            was_least = is_least
         end do
         call check(error, changes >= 2, "the load does not change between adjuster and spring")
         if (allocated(error)) return
      end do

   contains

      !> Among the stops of the last step there is one at which both loads are equal.
      subroutine check_stop(last)
         real(wp), intent(in) :: last
         ! Stops in the step [rad]; loads on both sides of each over that of the base circle [-]
         real(wp), allocatable :: near(:), loads(:, :)
         integer :: k, side

         near = pack(stops, stops > last - two_pi/angles .and. stops < last)
         allocate (loads(2, size(near)))
         do k = 1, size(near)
            do side = 1, 2
               call evaluate_state(model, near(k) + (2*side - 3)*1.0e-9_wp, 0.0_wp, state, status)
               loads(side, k) = state%contact%load/model%base_circle_load
            end do
         end do
         ! The load grows by a few hundred of itself in a radian
         call check(error, any(minval(loads, 1) <= 1.0_wp .and. maxval(loads, 1) > 1.0_wp .and. &
            & maxval(loads, 1) < 1.0_wp + 1.0e-6_wp), "no stop where both loads are equal")
      end subroutine check_stop

   end subroutine test_load_stops

   subroutine test_cycle_stops(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: stops(4) = [-1.2_wp, -0.9_wp, 0.9_wp, 1.2_wp]
      real(wp) :: start
      real(wp), allocatable :: ahead(:)
      integer :: i, k

      do i = -9, 9
         start = 0.7_wp*i
         ahead = cycle_stops(stops, start)
         call check(error, size(ahead), 6)
         if (allocated(error)) return
         call check(error, abs(ahead(1) - start) <= 0.0_wp .and. abs(ahead(6) - start - two_pi) < 1.0e-14_wp .and. &
            all(ahead(2:) > ahead(:5)), "order")
         if (allocated(error)) return
         do k = 2, 5
            call check(error, minval(abs(modulo(ahead(k) - stops + pi, two_pi) - pi)) < 1.0e-14_wp, "a stop has moved")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_cycle_stops

   subroutine test_stops_between(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      real(wp), allocatable :: once(:), stops(:)
      integer :: turn

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, once)
      call find_stops_between(model, -pi, 5.0_wp*pi, stops)
      call check(error, size(stops), 3*size(once) + 2)
      if (allocated(error)) return
      do turn = 0, 2
         call check(error, all(abs(stops(2 + turn*size(once):1 + (turn + 1)*size(once)) - once - turn*two_pi) < 1.0e-12_wp), &
            "stops of a turn")
         if (allocated(error)) return
      end do
   end subroutine test_stops_between

   subroutine test_undercut(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure

      case = thesis_case()
      call make_model(case, model, error)
      if (allocated(error)) return
      call check_geometry(model, 0.0_wp, failure)
      if (has_failed(failure, error)) return
      ! a shorter event of the same lift has too sharp a nose: undercut round 180 deg
      case%lift%opening_half_angle = 36.0_wp*degree
      case%lift%closing_half_angle = 36.0_wp*degree
      call make_model(case, model, error)
      if (allocated(error)) return
      call check_geometry(model, 0.0_wp, failure)
      call expect_error(error, failure, kind_domain, "undercut")
      if (allocated(error)) return
      call check(error, index(failure%message, " at cam angle 1") > 0 .and. index(failure%message, " deg") > 0, failure%message)
   end subroutine test_undercut

   !> Laws that bend most within a small part of their event; the radius of the hollow is taken from 200 000 angles.
   subroutine test_narrow_hollow(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(error_t), allocatable :: failure
      type(model_t) :: model
      type(position_t) :: position
      type(moments_t) :: moments
      ! Smallest pitch curvature [1/m]; largest wheel [m]; gas force [N]
      real(wp) :: hollow, largest, force
      integer :: law, i, status
      integer, parameter :: angles = 200000
      ! The hollow is a third of a degree wide, and two of the angles are 0.002 degrees apart: half of that squared [-]
      real(wp), parameter :: allowed = 1.0e-4_wp
      integer, parameter :: exponents(4, 3) = reshape([60, 100, 150, 200, 100, 140, 180, 200, 40, 80, 120, 160], [4, 3])

      do law = 1, size(exponents, 2)
         case = thesis_case()
         case%lift%law = "polydyne"
         case%lift%exponents = exponents(:, law)
         case%lift%max_lift = 3.0e-3_wp
         call make_model(case, model, error)
         if (allocated(error)) return
         hollow = 0.0_wp
         do i = 0, angles - 1
            call evaluate_loading(model, -pi + i*two_pi/angles, position, force, moments, status)
            hollow = min(hollow, position%pitch_curvature)
         end do
         if (hollow >= 0.0_wp) call test_failed(error, "this geometry has no hollow flank")
         if (allocated(error)) return
         largest = -1.0_wp/hollow + case%mechanism%roller_radius
         call check_geometry(model, (1.0_wp - allowed)*largest, failure)
         if (has_failed(failure, error)) return
         call check_geometry(model, (1.0_wp + allowed)*largest, failure)
         call expect_error(error, failure, kind_domain, "grinding wheel")
         if (allocated(error)) return
      end do
   end subroutine test_narrow_hollow

   subroutine test_wheel(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(position_t) :: position
      type(moments_t) :: moments
      type(error_t), allocatable :: failure
      ! Smallest pitch curvature [1/m]; largest wheel [m]; gas force [N]
      real(wp) :: hollow, largest, force
      integer :: i, status

      case = skewed_case(rotation_names(1))
      call make_model(case, model, error)
      if (allocated(error)) return
      hollow = 0.0_wp
      do i = 0, 1439
         call evaluate_loading(model, -pi + i*two_pi/1440, position, force, moments, status)
         hollow = min(hollow, position%pitch_curvature)
      end do
      if (hollow >= 0.0_wp) call test_failed(error, "this geometry has no hollow flank")
      if (allocated(error)) return
      ! radius of the flank: that of the pitch curve and the roller's
      largest = -1.0_wp/hollow + case%mechanism%roller_radius
      call check_geometry(model, 0.999_wp*largest, failure)
      if (has_failed(failure, error)) return
      call check_geometry(model, 1.001_wp*largest, failure)
      call expect_error(error, failure, kind_domain, "grinding wheel")
   end subroutine test_wheel

   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure

      case = thesis_case()
      case%lift%max_lift = 45.0e-3_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call check_geometry(model, 0.0_wp, failure)
      call expect_error(error, failure, kind_domain, "at cam angle")
   end subroutine test_reach

   !> A case is refused with a kind and words.
   subroutine refused(case, kind, words, error)
      type(case_t), intent(in) :: case
      integer, intent(in) :: kind
      character(len=*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(error_t), allocatable :: failure

      call new_model(model, case, 1, failure)
      call expect_error(error, failure, kind, words)
   end subroutine refused

   subroutine test_contradictions(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      character(len=28), parameter :: words(5) = [character(len=28) :: "load_arm 'exact'", "spin 'exact'", &
         "in_roller_balance = .true.", "seating 'continuous'", "boundary 'mobilised'"]
      integer :: i

      case = source_case()
      case%traction%in_roller_balance = .false.
      case%spring%seating = "maximum"
      case%energy = "consistent"
      do i = 1, size(words)
         call refused(case, kind_deck, trim(words(i)), error)
         if (allocated(error)) return
      end do
   end subroutine test_contradictions

   subroutine test_adjuster(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model

      case = thesis_case()
      case%spring%stiffness = 2500.0_wp
      call refused(case, kind_deck, "37.507 N, the closed spring holds 21 N", error)
      if (allocated(error)) return
      case = source_case()
      case%spring%stiffness = 2500.0_wp
      case%spring%seating = "maximum"
      call make_model(case, model, error)
   end subroutine test_adjuster

   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      case = thesis_case()
      case%film%law = "dowson"
      call refused(case, kind_deck, "masjedi_khonsari_rough", error)
      if (allocated(error)) return
      case = thesis_case()
      case%traction%cap = "hard"
      call refused(case, kind_deck, "sharp", error)
      if (allocated(error)) return
      case = thesis_case()
      case%traction%shear_law = "ering"
      call refused(case, kind_deck, "eyring", error)
      if (allocated(error)) return
      case = thesis_case()
      case%asperity%boundary = "none"
      call refused(case, kind_deck, "mobilised", error)
      if (allocated(error)) return
      case = thesis_case()
      case%needle_bearing%kind = "balls"
      call refused(case, kind_deck, "plain_pin", error)
      if (allocated(error)) return
      case = thesis_case()
      case%energy = "thesis"
      call refused(case, kind_deck, "source", error)
   end subroutine test_names

   subroutine test_numbers(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      case = thesis_case()
      case%operating_point%speed = 0.0_wp
      call refused(case, kind_deck, "speed must be positive", error)
      if (allocated(error)) return
      case = thesis_case()
      case%surface%cam_roughness = 0.0_wp
      case%surface%roller_roughness = 0.0_wp
      call refused(case, kind_deck, "roughness must be positive", error)
      if (allocated(error)) return
      case = thesis_case()
      case%roller%wall_thickness = 9.0e-3_wp
      call refused(case, kind_deck, "wall thinner than the radius", error)
      if (allocated(error)) return
      case = thesis_case()
      case%traction%shear_law = "eyring"
      call refused(case, kind_deck, "positive eyring stress", error)
      if (allocated(error)) return
      case = thesis_case()
      case%film%law = "masjedi_khonsari_rough"
      case%materials%hardness = 0.0_wp
      call refused(case, kind_deck, "needs the hardness", error)
      if (allocated(error)) return
      case = thesis_case()
      case%traction%limiting_coefficient = 0.0_wp
      call refused(case, kind_deck, "limiting coefficient must be positive", error)
   end subroutine test_numbers

end module test_events
