!> Bearings of the roller whose torque is not in proportion to the load, with a contact that is solved numerically.
module test_ehl_bearings
   use testdrive, only : unittest_type, new_unittest, error_type
   use camroller_case, only : case_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_error, only : error_t
   use camroller_kinds, only : wp
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_pin_film, only : pin_state_t, solve_pin, unloaded_torque
   use camroller_skf_bearing, only : skf_state_t, solve_skf
   use closeness, only : check_close, expect_success
   use flexible_cases, only : choose_roller_bearing
   use reference_cases, only : thesis_case, make_model, set_point, point_speeds, point_viscosities
   implicit none
   private

   public :: collect_ehl_bearings

contains

   subroutine collect_ehl_bearings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a pin on its oil film and needles by SKF's model brake the roller", test_bearings) &
         ]
   end subroutine collect_ehl_bearings

   !> On the base circle, where nothing changes, traction is what rolling and the bearing take.
   subroutine test_bearings(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_cycle_t) :: cycle
      type(ehl_cycle_options_t) :: options
      type(case_t) :: case
      type(model_t) :: model
      type(position_t) :: position
      type(pin_state_t) :: pin
      type(skf_state_t) :: needles
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
         call expect_success(error, failure)
         if (allocated(error)) return
         ! The end of the turn, opposite to the nose
         place = size(cycle%moments)
         associate (now => cycle%moments(place), part => model%bearing)
            call evaluate_geometry(model, now%angle, position, status)
            spin = (model%speed*position%rolling_travel - now%sliding_speed)/model%roller_radius
            if (number == 2) then
               call solve_skf(part%skf, now%load, spin, part%reversal_spin, needles)
               torque = needles%torque
            else
               call solve_pin(part%film, now%load, spin, part%reversal_spin, pin)
               torque = pin%torque + unloaded_torque(part%film)*spin
            end if
            left = model%roller_radius*(abs(now%traction) - now%rolling_resistance)
            ! What the slip still changes by there is below a thousandth
            call check_close(error, left, abs(torque), 1.0e-3_wp, "torque of the bearing")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_bearings

end module test_ehl_bearings
