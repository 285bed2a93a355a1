!> Margins against loss of contact and opening of the pivot's joint: against closed numbers, fine scans at many speeds, statics.
module test_margins
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, kind_deck
   use camroller_case, only : case_t
   use camroller_dynamics, only : moments_t
   use camroller_events, only : find_stops, cycle_stops
   use camroller_kinematics, only : position_t, rotation_names
   use camroller_margins, only : margins_t, find_margins
   use camroller_model, only : model_t, new_model
   use camroller_pivot, only : pivot_force
   use camroller_result, only : get_summary, result_t
   use camroller_run, only : run_case
   use camroller_state, only : evaluate_loading
   use camroller_torque, only : normal_direction
   use closeness, only : check_close, check_scaled, expect_error, has_failed
   use reference_cases, only : thesis_case, source_case, skewed_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_margins

   !> Rad/s in a rev/min [-]
   real(wp), parameter :: per_minute = pi/30.0_wp
   !> Steps of a fine scan over a turn
   integer, parameter :: fine_steps = 36000

contains

   subroutine collect_margins(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the smallest load of the event is the margin where it is at the event's end", test_event_end), &
         new_unittest("speeds of contact loss, pump-up and joint opening agree with the independent reference", test_numbers), &
         new_unittest("margins are the smallest forces of a fine scan", test_scan), &
         new_unittest("at the limit speed of a margin the smallest force of a fine scan is zero", test_speeds), &
         new_unittest("the adjuster's force balances the finger at rest", test_adjuster_force), &
         new_unittest("the pivot's force agrees with the momentum balance of the finger", test_momentum), &
         new_unittest("without negative inertia forces contact is never lost", test_no_loss_speed), &
         new_unittest("with seating 'maximum' the margin of the base circle is the base circle load", test_maximum), &
         new_unittest("a centre of mass beyond the radius of gyration is refused", test_centre), &
         new_unittest("without the finger's mass no margin of the pivot is given", test_no_mass) &
         ]
   end subroutine collect_margins

   !> Margins of a case.
   subroutine margins_of(case, model, margins, error)
      type(case_t), intent(in) :: case
      type(model_t), intent(out) :: model
      type(margins_t), intent(out) :: margins
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: stops(:)

      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, stops)
      call find_margins(model, cycle_stops(stops, -pi), margins)
   end subroutine margins_of

   !> Smallest contact load and pivot force with the valve off its seat, and smallest load elsewhere, by a plain scan.
   subroutine scan_forces(model, event, pivot, base_circle)
      type(model_t), intent(in) :: model
      real(wp), intent(out) :: event, pivot, base_circle
      type(position_t) :: position
      real(wp) :: load, joint
      integer :: i

      event = huge(1.0_wp)
      pivot = huge(1.0_wp)
      base_circle = huge(1.0_wp)
      do i = 0, fine_steps - 1
         call forces_at(model, two_pi*i/fine_steps - pi, position, load, joint)
         if (position%lift <= model%train%seat_lift) then
            base_circle = min(base_circle, load)
         else
            event = min(event, load)
            pivot = min(pivot, joint)
         end if
      end do
   end subroutine scan_forces

   !> Load of the contact and force in the pivot's joint at a cam angle [N].
   subroutine forces_at(model, angle, position, load, joint)
      type(model_t), intent(in) :: model
      ! [rad]
      real(wp), intent(in) :: angle
      type(position_t), intent(out) :: position
      real(wp), intent(out) :: load, joint
      type(moments_t) :: moments
      real(wp) :: gas, normal(2), tangent(2)
      integer :: status

      call evaluate_loading(model, angle, position, gas, moments, status)
      load = moments%total/position%normal_arm
      call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, &
         model%linkage%sense, normal, tangent)
      joint = pivot_force(model%pivot, load, normal, (moments%spring - moments%seat + moments%valve) &
         /position%valve_arm, position%arm_angle, position%finger_slope, position%finger_curvature, model%speed)
   end subroutine forces_at

   !> Cases of several geometries: Islam's, and a skewed one that turns either way.
   function sample(i) result(case)
      integer, intent(in) :: i
      type(case_t) :: case

      case = thesis_case()
      if (i > 1) case = skewed_case(rotation_names(i - 1))
      if (i > 1) case%masses%finger = 0.05_wp
      if (i > 1) case%mechanism%adjuster_tilt = 7.0_wp*degree
   end function sample

   subroutine test_numbers(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins

      ! test/reference/pivot.py has these numbers from positions of the bodies, by differences; printed to six digits. Finger of
      ! 41.8 g, taken at the pad for its inertia, centre of mass 20 mm out on the roller arm, adjuster parallel to the valve
      case = thesis_case()
      case%masses%finger_centre = 20.0e-3_wp
      call margins_of(case, model, margins, error)
      if (allocated(error)) return
      call check_close(error, margins%event%speed/per_minute, 2937.17_wp, 2.0e-6_wp, "speed at which the roller lifts off")
      if (allocated(error)) return
      call check_close(error, margins%pivot%speed/per_minute, 2470.90_wp, 2.0e-6_wp, "speed at which the joint opens")
      if (allocated(error)) return
      call check_close(error, margins%pump_up_speed/per_minute, 2357.51_wp, 2.0e-6_wp, "speed at which the adjuster pumps up")
      if (allocated(error)) return
      call check_close(error, margins%adjuster_force, 26.3802_wp, 2.0e-6_wp, "force of the adjuster")
      if (allocated(error)) return
      case%masses%finger_centre = 0.0_wp
      call margins_of(case, model, margins, error)
      if (allocated(error)) return
      call check_close(error, margins%pivot%speed/per_minute, 2470.90_wp, 2.0e-6_wp, "20 mm where nothing is given")
   end subroutine test_numbers

   subroutine test_scan(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins
      type(position_t) :: position
      ! Forces, and those at the angles of the margins [N]
      real(wp) :: event, pivot, base_circle, load, joint
      integer :: i, k

      do i = 1, 3
         do k = 1, 6
            case = sample(i)
            call set_point(case, 700.0_wp*k*per_minute, point_viscosities(2))
            call margins_of(case, model, margins, error)
            if (allocated(error)) return
            call scan_forces(model, event, pivot, base_circle)
            ! a hundredth of a degree beside the lowest point: within it forces of 500 N change by less than 0.1 N at the edge of
            ! the event, where they have a slope, and by far less in a valley
            call check(error, margins%event%force <= event .and. margins%event%force > event - 0.1_wp, "event")
            if (allocated(error)) return
            call check(error, margins%pivot%force <= pivot .and. margins%pivot%force > pivot - 0.1_wp, "pivot")
            if (allocated(error)) return
            call check_close(error, margins%base_circle%force, base_circle, 1.0e-12_wp, "base circle")
            if (allocated(error)) return
            ! forces of 500 N at most, each of some sums and products
            call forces_at(model, margins%event%angle, position, load, joint)
            call check_scaled(error, margins%event%force, load, 500.0_wp, 1.0e-12_wp, "event, at its angle")
            if (allocated(error)) return
            call forces_at(model, margins%pivot%angle, position, load, joint)
            call check_scaled(error, margins%pivot%force, joint, 500.0_wp, 1.0e-12_wp, "pivot, at its angle")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_scan

   subroutine test_speeds(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins
      real(wp) :: event, pivot, base_circle, speeds(3), forces(3), change
      integer :: i, k, side

      do i = 1, 3
         case = sample(i)
         call margins_of(case, model, margins, error)
         if (allocated(error)) return
         speeds = [margins%event%speed, margins%pivot%speed, margins%pump_up_speed]
         if (.not. all(speeds < 1000.0_wp)) call test_failed(error, "a speed is missing")
         if (allocated(error)) return
         do k = 1, 3
            ! forces go with the square of the speed: a part of 1e-4 more or less than the speed is 0.02 % of the inertia forces of
            ! about 500 N, 0.1 N, where a scan of 0.01 deg in a valley misses less than 1e-4 N
            do side = -1, 1, 2
               change = 1.0_wp + side*1.0e-4_wp
               call set_point(case, speeds(k)*change, point_viscosities(2))
               call make_model(case, model, error)
               if (allocated(error)) return
               call scan_forces(model, event, pivot, base_circle)
               forces = [event, pivot, pivot - margins%adjuster_force]
               call check(error, side*forces(k) < -0.01_wp, "a force has not changed its sign")
               if (allocated(error)) return
               call check(error, side*forces(k) > -1.0_wp, "a force is not near zero")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_speeds

   subroutine test_adjuster_force(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(margins_t) :: margins
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: gas, normal(2), tangent(2), tip, adjuster(2), moment
      integer :: i, status

      do i = 1, 3
         call margins_of(sample(i), model, margins, error)
         if (allocated(error)) return
         ! moments about the valve's pad instead of the pivot: contact, adjuster and the guide across the adjuster's axis, whose
         ! force follows from the sum of forces
         call evaluate_loading(model, -pi, position, gas, moments, status)
         call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, &
            model%linkage%sense, normal, tangent)
         tip = model%base_circle_load*position%normal_arm/position%valve_arm
         associate (chi => model%linkage%valve_axis_angle, axis => model%pivot%axis_angle, w => model%base_circle_load, &
            gamma => position%arm_angle - model%linkage%arm_offset - model%linkage%valve_axis_angle)
            ! what the pivot takes along the adjuster's axis and across it
            adjuster = -(w*normal + tip*[cos(chi), -sin(chi)])
            call check_close(error, margins%adjuster_force, dot_product(adjuster, [cos(axis), -sin(axis)]), 1.0e-12_wp, &
               "force along the adjuster's axis")
            if (allocated(error)) return
            moment = cross(-model%linkage%b*[cos(gamma), sin(gamma)], adjuster) + w*cross(model%linkage%a &
               *[cos(position%arm_angle), sin(position%arm_angle)] - model%linkage%b*[cos(gamma), sin(gamma)], normal)
            call check_scaled(error, moment, 0.0_wp, w*model%linkage%b, 1.0e-12_wp, "moment about the pad")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_adjuster_force

   !> Cross product in the plane.
   pure function cross(a, b) result(product)
      real(wp), intent(in) :: a(2), b(2)
      real(wp) :: product

      product = a(1)*b(2) - a(2)*b(1)
   end function cross

   subroutine test_momentum(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(margins_t) :: margins
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: places(-1:1), gas, momentum, force, angle
      real(wp), parameter :: step = 1.0e-4_wp
      integer :: i, k, status

      do i = 1, 3
         call margins_of(sample(i), model, margins, error)
         if (allocated(error)) return
         angle = 0.2_wp*i
         do k = -1, 1
            call evaluate_loading(model, angle + k*step, position, gas, moments, status)
            places(k) = model%pivot%centre*cos(position%arm_angle + model%pivot%axis_angle)
         end do
         call evaluate_loading(model, angle, position, gas, moments, status)
         momentum = model%pivot%mass*model%speed**2*(places(1) - 2.0_wp*places(0) + places(-1))/step**2
         force = pivot_force(model%pivot, 0.0_wp, [0.0_wp, 0.0_wp], 0.0_wp, position%arm_angle, position%finger_slope, &
            position%finger_curvature, model%speed)
         ! a second difference leaves step^2/12 times a fourth derivative, and roundings of 1e-17 m over step^2
         call check_scaled(error, force, momentum, model%pivot%mass*model%speed**2*model%pivot%centre, 1.0e-6_wp, "momentum")
         if (allocated(error)) return
      end do
   end subroutine test_momentum

   subroutine test_no_loss_speed(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins

      case = thesis_case()
      case%masses%valve = 0.0_wp
      case%masses%finger = 0.0_wp
      call margins_of(case, model, margins, error)
      if (allocated(error)) return
      call check(error, min(margins%event%speed, margins%base_circle%speed) > huge(1.0_wp), "a speed is given")
      if (allocated(error)) return
      call check_close(error, margins%base_circle%force, case%spring%base_circle_load, 1.0e-12_wp, "smallest load")
   end subroutine test_no_loss_speed

   subroutine test_maximum(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins

      case = source_case()
      case%spring%load_arm = "exact"
      case%spring%seating = "maximum"
      call margins_of(case, model, margins, error)
      if (allocated(error)) return
      call check_close(error, margins%base_circle%force, case%spring%base_circle_load, 1.0e-15_wp, "base circle")
      if (allocated(error)) return
      call check(error, margins%base_circle%speed > huge(1.0_wp), "the base circle loses contact")
      if (allocated(error)) return
      call check(error, margins%event%force > case%spring%base_circle_load, "the event has the base circle's load")
   end subroutine test_maximum

   subroutine test_centre(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure

      ! 41.8 g with the inertia of 10 mm
      case = thesis_case()
      case%masses%finger_inertia = case%masses%finger*1.0e-4_wp
      case%masses%finger_centre = 11.0e-3_wp
      call new_model(model, case, 1, failure)
      call expect_error(error, failure, kind_deck, "11")
      if (allocated(error)) return
      case%masses%finger_centre = 0.0_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call check_close(error, model%pivot%centre, 10.0e-3_wp, 1.0e-14_wp, "the radius of gyration where 20 mm are too far")
   end subroutine test_centre

   subroutine test_no_mass(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(margins_t) :: margins

      case = thesis_case()
      case%masses%finger_inertia = 5.0e-5_wp
      case%masses%finger = 0.0_wp
      call margins_of(case, model, margins, error)
      if (allocated(error)) return
      if (allocated(margins%pivot)) call test_failed(error, "a margin without a mass")
   end subroutine test_no_mass

   !> A cycloidal lift begins with the third power of the angle; the load is least where it begins, and that is the margin without
   !> friction. The first row that has any lift above rounding has 1e-4 more.
   subroutine test_event_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(result_t) :: result
      type(error_t), allocatable :: failure
      real(wp) :: smallest, margin ! [N]

      the_case = thesis_case()
      the_case%energy = "source"
      the_case%lift%law = "cycloidal"
      the_case%spring%seating = "maximum"
      the_case%spring%base_circle_load = 1.0_wp
      call set_point(the_case, point_speeds(3), point_viscosities(1))
      call run_case(the_case, result, failure)
      if (.not. allocated(failure)) call get_summary(result, "min_event_contact_load", smallest, failure)
      if (.not. allocated(failure)) call get_summary(result, "margin_event", margin, failure)
      if (has_failed(failure, error)) return
      ! Beside the end the load has risen by the rounding of a distance of 1e-9
      call check(error, smallest, margin, thr=1.0e-8_wp*margin)
   end subroutine test_event_end

end module test_margins
