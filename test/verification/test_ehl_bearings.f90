!> Bearings of the roller whose torque is not in proportion to the load, with a contact that is solved numerically.
module test_ehl_bearings
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_case, only : case_t
   use camroller_ehl_balance, only : balanced_load
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_error, only : error_t
   use camroller_kinds, only : wp, degree
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_pin_film, only : pin_state_t, solve_pin, unloaded_torque
   use camroller_result, only : get_series, result_t
   use camroller_run, only : run_case
   use camroller_skf_bearing, only : skf_state_t, solve_skf
   use camroller_state, only : evaluate_state, state_t
   use closeness, only : check_close, has_failed
   use flexible_cases, only : choose_roller_bearing
   use reference_cases, only : add_joints, thesis_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_ehl_bearings

contains

   subroutine collect_ehl_bearings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("balanced loads are those of a contact by laws, with every bearing and with friction in joints", &
            & test_balance), &
         new_unittest("a pin on its oil film and needles by SKF's model brake the roller", test_bearings), &
         new_unittest("with films of solved contacts they have the torque of their load and spin", test_films) &
         ]
   end subroutine collect_ehl_bearings

   !> Traction and rolling resistance are given to one balance and come from the other, whose rounds are Newton's.
   subroutine test_balance(error)
      type(error_type), allocatable, intent(out) :: error
      ! On the base circle, where the finger is at rest, on both flanks and near the nose [degrees]
      real(wp), parameter :: angles(5) = [170.0_wp, -50.0_wp, -25.0_wp, 3.0_wp, 40.0_wp]
      ! [m/s]; both end at round-off, which the slopes of friction leave nearly as it is [-]
      real(wp), parameter :: sliding_speed = 0.03_wp, tolerance = 1000*epsilon(1.0_wp)
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: state
      real(wp) :: load ! [N]
      integer :: number, joints, place, status

      do number = 0, 3
         do joints = 0, 2
            case = thesis_case()
            call set_point(case, point_speeds(2), point_viscosities(2))
            call choose_roller_bearing(case, number)
            if (joints == 1) call add_joints(case, "constant")
            if (joints == 2) call add_joints(case, "stribeck")
            call make_model(case, model, error)
            if (allocated(error)) return
            do place = 1, size(angles)
               call evaluate_state(model, angles(place)*degree, sliding_speed, state, status)
               call check(error, status, 0)
               if (allocated(error)) return
               load = balanced_load(model, state%position, state%moments, state%contact%traction, &
                  & state%contact%rolling_resistance, sliding_speed)
               call check_close(error, load, state%contact%load, tolerance, "load")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_balance

   !> The first row, on the base circle, where the finger is at rest.
   subroutine test_films(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Series: load, spin of the roller, torque of the bearing, energy residual
      real(wp), allocatable :: load(:), spin(:), torque(:), residual(:)
      integer :: number

      do number = 2, 3
         case = thesis_case()
         call set_point(case, point_speeds(1), point_viscosities(2))
         call choose_roller_bearing(case, number)
         allocate (case%ehl)
         call make_model(case, model, error)
         if (allocated(error)) return
         call run_case(case, result, failure)
         if (.not. allocated(failure)) call get_series(result, "contact_load", load, failure)
         if (.not. allocated(failure)) call get_series(result, "roller_spin", spin, failure)
         if (.not. allocated(failure)) call get_series(result, "torque_needle", torque, failure)
         if (.not. allocated(failure)) call get_series(result, "energy_residual", residual, failure)
         if (has_failed(failure, error)) return
         call check_close(error, torque(1), law_torque(model, load(1), spin(1))*spin(1)/model%speed, 1.0e-9_wp, "torque")
         if (allocated(error)) return
         ! Stored powers are a thousand times larger
         call check(error, maxval(abs(residual)) < 1.0e-10_wp*maxval(torque)*model%speed, "energy")
         if (allocated(error)) return
      end do
   end subroutine test_films

   !> Torque of the bearing by its law.
   function law_torque(model, load, spin) result(torque)
      type(model_t), intent(in) :: model
      ! [N], [rad/s], [N m]
      real(wp), intent(in) :: load, spin
      real(wp) :: torque
      type(pin_state_t) :: pin
      type(skf_state_t) :: needles

      associate (part => model%bearing)
         if (allocated(part%skf)) then
            call solve_skf(part%skf, load, spin, part%reversal_spin, needles)
            torque = needles%torque
         else
            call solve_pin(part%film, load, spin, part%reversal_spin, pin)
            torque = pin%torque + unloaded_torque(part%film)*spin
         end if
      end associate
   end function law_torque

   !> On the base circle, where nothing changes, traction is what rolling and the bearing take.
   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_cycle_t) :: cycle
      type(ehl_cycle_options_t) :: options
      type(case_t) :: case
      type(model_t) :: model
      type(position_t) :: position
      type(error_t), allocatable :: failure
      ! Spin of the roller [rad/s]; torque of the bearing, and what is left of that of the contact [N m]
      real(wp) :: spin, torque, left
      integer :: number, place, status

      options%nodes = 65
      do number = 2, 3
         case = thesis_case()
         call set_point(case, point_speeds(1), point_viscosities(2))
         call choose_roller_bearing(case, number)
         call make_model(case, model, error)
         if (allocated(error)) return
         call integrate_ehl_cycle(cycle, model, options, failure)
         if (has_failed(failure, error)) return
         ! The end of the turn, opposite to the nose
         place = size(cycle%moments)
         associate (now => cycle%moments(place))
            call evaluate_geometry(model, now%angle, position, status)
            spin = (model%speed*position%rolling_travel - now%sliding_speed)/model%roller_radius
            torque = law_torque(model, now%load, spin)
            left = model%roller_radius*(abs(now%traction) - now%rolling_resistance)
            ! What the slip still changes by there is below a thousandth
            call check_close(error, left, abs(torque), 1.0e-3_wp, "torque of the bearing")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_bearings

end module test_ehl_bearings
