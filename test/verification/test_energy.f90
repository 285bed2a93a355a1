!> Conservation of energy: at every angle, over every interval, over the cycle.
module test_energy
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t, rotation_names
   use camroller_dynamics, only : moments_t, stored_energy, unseated_share
   use camroller_state, only : state_t, evaluate_state, evaluate_loading
   use camroller_cycle, only : cycle_t, state_at
   use camroller_events, only : find_stops
   use camroller_film, only : film_law_names
   use camroller_quadrature, only : gauss_legendre
   use camroller_torque_list, only : of_geometric, of_roller_inertia, of_residual
   use closeness, only : check_scaled
   use energy_checks, only : check_energy
   use reference_cases, only : thesis_case, skewed_case, set_point, add_gas_force, make_model, make_cycle, point_speeds, &
      point_viscosities
   implicit none
   private

   public :: collect_energy

contains

   subroutine collect_energy(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("energy closes at 720 angles of the nine operating points", test_nine_points), &
         new_unittest("energy closes for another geometry, both senses of rotation, with gas force", test_skewed), &
         new_unittest("energy closes for every film law, an Eyring oil and a sharp cap", test_laws), &
         new_unittest("energy closes at any sliding speed, also with the roller turning backwards", test_any_slip), &
         new_unittest("work of the geometric torque between two angles is the change of stored energy", test_work), &
         new_unittest("the same with a lift table", test_work_table), &
         new_unittest("the geometric torque does no work over a cycle", test_closed_cycle), &
         new_unittest("over a cycle the drive's work is that of the losses plus the work on the gas", test_mean_power) &
         ]
   end subroutine collect_energy

   !> No residual over the cycle of a case that never loses contact.
   subroutine check_residual(case, error)
      type(case_t), intent(in) :: case
      type(error_type), allocatable, intent(out) :: error
      type(state_t), allocatable :: states(:)

      call check_energy(case, states, error)
      if (.not. allocated(error)) call check(error, all(states%contact%is_touching), "contact is lost")
   end subroutine check_residual

   subroutine test_nine_points(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      integer :: i, k

      case = thesis_case()
      case%numerics%tolerance = 1.0e-4_wp
      do i = 1, 3
         do k = 1, 3
            call set_point(case, point_speeds(i), point_viscosities(k))
            call check_residual(case, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_nine_points

   subroutine test_skewed(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      integer :: i

      do i = 1, 2
         case = skewed_case(rotation_names(i))
         call add_gas_force(case)
         call check_residual(case, error)
         if (allocated(error)) return
      end do
   end subroutine test_skewed

   subroutine test_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      integer :: i

      do i = 1, size(film_law_names)
         case = thesis_case()
         call set_point(case, point_speeds(2), point_viscosities(2))
         case%film%law = film_law_names(i)
         case%lubricant%pressure_law = merge("roelands", "barus   ", mod(i, 2) == 0)
         if (i > 2) case%traction%shear_law = "eyring"
         case%traction%eyring_stress = 5.0e6_wp
         if (i > 1) case%traction%cap = "sharp"
         if (mod(i, 3) == 0) case%traction%limit = "local"
         case%traction%limiting_stress = 1.0e6_wp
         if (i == 3) case%needle_bearing%kind = "plain_pin"
         if (i == 4) deallocate (case%valve_guide)
         if (i == 5) deallocate (case%asperity)
         if (i < 5) case%asperity%film_shear_strength = 2.0e6_wp
         call check_residual(case, error)
         if (allocated(error)) return
      end do
   end subroutine test_laws

   subroutine test_any_slip(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      ! Sliding speeds over the cam speed [m]
      real(wp), parameter :: slides(6) = [0.0_wp, 1.0e-6_wp, -1.0e-3_wp, 2.0e-2_wp, 6.0e-2_wp, -5.0e-2_wp]
      integer :: i, k, sense, status

      do sense = 1, 2
         case = skewed_case(rotation_names(sense))
         call add_gas_force(case)
         call make_model(case, model, error)
         if (allocated(error)) return
         do i = 1, 36
            do k = 1, size(slides)
               call evaluate_state(model, (10*i - 3)*degree, slides(k)*model%speed, state, status)
               if (status /= 0) call test_failed(error, "no state")
               if (allocated(error)) return
               ! the parts of the balance are powers of up to this size
               call check_scaled(error, state%torques(of_residual), 0.0_wp, model%speed*(abs(state%torques(of_geometric)) &
                  + abs(state%torque_friction) + abs(state%torques(of_roller_inertia))), 1.0e-13_wp, "energy residual")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_any_slip

   !> Geometric torque at a cam angle.
   function geometric_torque(model, angle) result(torque)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: angle
      real(wp) :: torque
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: force
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status)
      torque = moments%total*position%finger_slope
   end function geometric_torque

   !> Energy stored at an angle.
   function energy_at(model, angle) result(energy)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: angle
      real(wp) :: energy
      type(position_t) :: position
      type(moments_t) :: moments
      real(wp) :: force
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status)
      energy = stored_energy(model%train, position, model%speed)
   end function energy_at

   !> Work of the geometric torque between two angles, cut at the stops and at angles in between.
   function work_between(model, start, finish, cuts) result(work)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: start, finish, cuts(:)
      real(wp) :: work
      ! Places and weights of a rule [-]; ends of the pieces, half of a piece [rad]
      real(wp) :: places(100), weights(100), half
      real(wp), allocatable :: ends(:)
      integer :: i, k

      call gauss_legendre(places, weights)
      allocate (ends, source=[start, pack(cuts, cuts > start .and. cuts < finish), finish])
      work = 0.0_wp
      do i = 1, size(ends) - 1
         half = 0.5_wp*(ends(i + 1) - ends(i))
         do k = 1, size(places)
            work = work + half*weights(k)*geometric_torque(model, ends(i) + half*(1.0_wp + places(k)))
         end do
      end do
   end function work_between

   !> Work against energy between angles all over the event.
   subroutine check_work(case, cuts, error)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: cuts(:)
      type(error_type), allocatable, intent(out) :: error
      ! Angles between which work and energy are compared [rad]
      real(wp), parameter :: angles(9) = [-80, -50, -31, -12, 0, 7, 23, 44, 75]*degree
      type(model_t) :: model
      ! Stops [rad]
      real(wp), allocatable :: stops(:)
      ! Work, largest stored energy [J]
      real(wp) :: work, largest
      integer :: i, k

      call make_model(case, model, error)
      if (allocated(error)) return
      call find_stops(model, stops)
      if (size(cuts) > 0) stops = merged(stops, cuts)
      largest = maxval([(energy_at(model, angles(i)), i=1, size(angles))])
      do i = 1, size(angles) - 1
         do k = i + 1, size(angles)
            work = work_between(model, angles(i), angles(k), stops)
            call check_scaled(error, work, energy_at(model, angles(k)) - energy_at(model, angles(i)), largest, 1.0e-12_wp, "work")
            if (allocated(error)) return
         end do
      end do
   end subroutine check_work

   !> Two sorted lists as one.
   pure function merged(first, second) result(list)
      real(wp), intent(in) :: first(:), second(:)
      real(wp) :: list(size(first) + size(second))
      integer :: i, k

      list = [first, second]
      do i = 2, size(list)
         do k = i, 2, -1
            if (list(k - 1) <= list(k)) exit
            list([k - 1, k]) = list([k, k - 1])
         end do
      end do
   end function merged

   subroutine test_work(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      case = thesis_case()
      ! both flanks of the lift meet at the nose
      case%lift%law = "polynomial_4567"
      case%lift%closing_half_angle = 60.0_wp*degree
      call set_point(case, point_speeds(3), point_viscosities(2))
      call check_work(case, [0.0_wp], error)
      if (allocated(error)) return
      case%mechanism%rotation = rotation_names(2)
      call check_work(case, [0.0_wp], error)
   end subroutine test_work

   subroutine test_work_table(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      ! every row of the table is a knot of its spline
      case = skewed_case(rotation_names(1))
      case%lift%table_angle = case%lift%table_angle(::4)
      case%lift%table_lift = case%lift%table_lift(::4)
      call check_work(case, case%lift%table_angle, error)
   end subroutine test_work_table

   subroutine test_closed_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      ! Stops [rad]; work, largest stored energy [J]
      real(wp), allocatable :: stops(:)
      real(wp) :: work
      integer :: i

      do i = 1, 2
         case = thesis_case()
         case%lift%law = "cycloidal"
         case%lift%closing_half_angle = 62.0_wp*degree
         case%mechanism%rotation = rotation_names(i)
         call make_model(case, model, error)
         if (allocated(error)) return
         call find_stops(model, stops)
         work = work_between(model, -pi, pi, stops)
         call check_scaled(error, work, 0.0_wp, energy_at(model, 0.0_wp), 1.0e-13_wp, "work over a cycle")
         if (allocated(error)) return
      end do
   end subroutine test_closed_cycle

   subroutine test_mean_power(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(cycle_t) :: cycle
      ! Work over the cycle: drive, losses, on the gas [J]
      real(wp) :: works(3)
      integer :: i

      do i = 1, 2
         case = skewed_case(rotation_names(i))
         call add_gas_force(case)
         case%numerics%tolerance = 1.0e-8_wp
         call make_model(case, model, error)
         if (allocated(error)) return
         call make_cycle(case, model, cycle, error)
         if (allocated(error)) return
         works = cycle_works(model, cycle)
         if (works(3) < 1.0e-3_wp) call test_failed(error, "the gas does not matter in this case")
         if (allocated(error)) return
         ! the integration's tolerance holds at each of some thousand steps
         call check_scaled(error, works(1), works(2) + works(3), works(2), 1.0e-6_wp, "work over the cycle")
         if (allocated(error)) return
      end do
   end subroutine test_mean_power

   !> Work over the cycle by a Gauss rule between the points of the trajectory; the work on the gas from pressure and lift alone.
   function cycle_works(model, cycle) result(works)
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      real(wp) :: works(3)
      type(state_t) :: state
      type(error_t), allocatable :: failure
      ! Places and weights of the rule [-]; start and width of an interval, weight of a point [rad]
      real(wp) :: places(3), weights(3), start, width, weight
      integer :: interval, i, hint

      call gauss_legendre(places, weights)
      works = 0.0_wp
      hint = 1
      do interval = 1, cycle%trajectory%count - 1
         start = cycle%trajectory%time(interval)
         width = cycle%trajectory%time(interval + 1) - start
         do i = 1, size(places)
            call state_at(cycle, model, start + 0.5_wp*width*(1.0_wp + places(i)), hint, state, failure)
            weight = 0.5_wp*width*weights(i)
            works = works + weight*[state%torque_drive, state%torque_friction, &
               state%gas_force*unseated_share(model%train, state%position%lift)*state%position%lift_slope]
         end do
      end do
   end function cycle_works

end module test_energy
