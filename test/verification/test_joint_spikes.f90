!> Friction of sliding joints of which cold oil leaves nothing but spikes where the valve sets off, turns round and comes to rest.
module test_joint_spikes
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_result, only : result_t, get_summary
   use camroller_run, only : build_models, run_case
   use camroller_sliding_friction, only : sliding_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_stem_friction, only : guide_side_load_t
   use camroller_torque_list, only : of_guide_side
   use reference_cases, only : thesis_case, set_point, point_viscosities
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_joint_spikes

contains

   subroutine collect_joint_spikes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("spikes of friction where the valve sets off have their mean and extremes by every method", test_spikes) &
         ]
   end subroutine collect_joint_spikes

   !> Ends of the guide by Stribeck's law: half of the valve's way is done at a thousand times the speed of the largest friction.
   subroutine test_spikes(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: methods(3) = [character(len=8) :: "hermite", "rodas5p", "radau5"]
      real(wp), parameter :: accuracy = 1.0e-4_wp
      type(case_t) :: the_case
      type(model_t), allocatable :: models(:)
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Mean torque [N m], smallest and largest friction [N]: along the angle alone, by a method
      real(wp) :: right(3), found(3)
      character(len=120) :: words
      integer :: i

      the_case = thesis_case()
      call set_point(the_case, 35.0_wp, point_viscosities(1))
      the_case%guide_side_load = guide_side_load_t(36.0e-3_wp, 25.0e-3_wp, 34.0e-3_wp, sliding_t("stribeck", 0.1_wp, 4.0e-3_wp, &
         & 0.0_wp, 6.0e-3_wp, 120.0_wp, 2.0e-3_wp))
      the_case%numerics%accuracy = accuracy
      call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call add_up(models(1), right, error)
      if (allocated(error)) return
      do i = 1, size(methods)
         the_case%numerics%method = methods(i)
         if (.not. allocated(failure)) call run_case(the_case, result, failure)
         if (.not. allocated(failure)) call get_summary(result, "mean_torque_guide_side", found(1), failure)
         if (.not. allocated(failure)) call get_summary(result, "min_friction_guide_side", found(2), failure)
         if (.not. allocated(failure)) call get_summary(result, "max_friction_guide_side", found(3), failure)
         if (has_failed(failure, error)) return
         write (words, "(2a, 6es15.7)") trim(methods(i)), ":", found, right
         call check(error, all(abs(found - right) <= accuracy*abs(right)), words)
         if (allocated(error)) return
      end do
   end subroutine test_spikes

   !> Mean and extremes, which do not depend on the roller, along the logarithm of the distance from the places where the valve
   !> sets off, turns round and comes to rest.
   subroutine add_up(model, values, error)
      type(model_t), intent(in) :: model
      !> Mean torque [N m], smallest and largest friction [N]
      real(wp), intent(out) :: values(3)
      type(error_type), allocatable, intent(out) :: error
      ! Ends of the event and full lift, half of their distance [rad]; points, and step of the logarithm [-]. The trapezoidal rule
      ! is far better than its step here, since all vanishes with its derivatives at the near end and nearly so at the far one
      real(wp), parameter :: turnings(3) = [-70.0_wp, 0.0_wp, 70.0_wp]*degree, half = 35.0_wp*degree
      integer, parameter :: points = 6000
      real(wp), parameter :: step = 30.0_wp/points
      type(state_t) :: state
      ! Distance [rad]
      real(wp) :: distance
      integer :: i, k, side, status

      values = 0.0_wp
      do k = 1, size(turnings)
         do side = -1, 1, 2
            do i = 0, points - 1
               distance = half*exp(-i*step)
               call evaluate_state(model, turnings(k) + side*distance, 0.0_wp, state, status)
               call check(error, status)
               if (allocated(error)) return
               values(1) = values(1) + state%torques(of_guide_side)*distance*step/two_pi*merge(0.5_wp, 1.0_wp, i == 0)
               values(2) = min(values(2), state%joints%side_friction)
               values(3) = max(values(3), state%joints%side_friction)
            end do
         end do
      end do
   end subroutine add_up

end module test_joint_spikes
