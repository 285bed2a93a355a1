!> The cycle with a solved film at its ends: loads far below the largest, a roller that runs backwards.
module test_ehl_limits
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_convergence
   use camroller_case, only : case_t
   use camroller_dynamics, only : moments_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_kinematics, only : position_t
   use camroller_model, only : model_t
   use camroller_state, only : evaluate_loading
   use closeness, only : expect_error, has_failed
   use reference_cases, only : thesis_case, make_model, set_point
   implicit none
   private

   public :: collect_ehl_limits

contains

   subroutine collect_ehl_limits(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a film under next to no load is that of rigid bodies", test_light_load), &
         new_unittest("rolling resistance brakes a roller that runs backwards, and never drives it", test_backward), &
         new_unittest("a film with squeeze whose inlet changes sides ends in words", test_turned_inlet) &
      ]
   end subroutine collect_ehl_limits

   !> Martin's film, h = 4.895 eta u R/w: elasticity and viscosity under pressure make the solved one 0.3 % thicker here (by another
   !> program, on 601 nodes), and nodes that end where a fiftieth of the largest load has its inlet make it 4 % thinner.
   subroutine test_light_load(error)
      type(error_type), allocatable, intent(out) :: error
      ! Accuracy of 129 nodes and of steps, twice [-]
      real(wp), parameter :: allowed = 0.01_wp
      type(case_t) :: case
      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(position_t) :: position
      type(moments_t) :: moments
      type(error_t), allocatable :: failure
      ! Gas force [N], Martin's film [m]
      real(wp) :: force, film
      integer :: status

      case = thesis_case()
      call set_point(case, 10.0_wp*pi, 0.01_wp)
      case%spring%base_circle_load = 1.5_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(), failure)
      if (has_failed(failure, error)) return
      call evaluate_loading(model, cycle%angle(1), position, force, moments, status)
      associate (now => cycle%moments(1))
         film = 4.895_wp*model%oil%viscosity*now%entrainment*position%equivalent_radius*model%contact_width/now%load
         call check(error, now%load < 0.002_wp*maxval(cycle%moments%load), "the load is not next to none")
         if (allocated(error)) return
         call check(error, abs(now%films%central/film - 1.003_wp) < allowed, "film")
      end associate
   end subroutine test_light_load

   !> Power that the contact takes, traction times sliding speed and resistance times the sum of both surfaces' speeds, at each
   !> angle of a cycle of steady films with a limit of the shear too low to turn the roller: it runs backwards nearly as fast as the
   !> cam's surface runs, where hardly any oil is drawn in.
   subroutine test_backward(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(error_t), allocatable :: failure

      call slippery_model(model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(is_transient=.false.), failure)
      if (has_failed(failure, error)) return
      associate (moments => cycle%moments)
         call check(error, any(abs(moments%entrainment) < 0.01_wp*moments%sliding_speed), "oil is drawn in all the way")
         if (allocated(error)) return
         call check(error, all(moments%traction*moments%sliding_speed + 2.0_wp*moments%rolling_resistance*moments%entrainment &
            & > 0.0_wp), "the contact gives power")
      end associate
   end subroutine test_backward

   subroutine test_turned_inlet(error)
      type(error_type), allocatable, intent(out) :: error
      type(model_t) :: model
      type(ehl_cycle_t) :: cycle
      type(error_t), allocatable :: failure

      call slippery_model(model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(cycle, model, ehl_cycle_options_t(), failure)
      call expect_error(error, failure, kind_convergence, "drawn in from the other side")
   end subroutine test_turned_inlet

   !> The train at 900 rev/min in cold oil whose shear is limited to 0.3 % of the pressure.
   subroutine slippery_model(model, error)
      !> The model
      type(model_t), intent(out) :: model
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case

      case = thesis_case()
      call set_point(case, 30.0_wp*pi, 5.0_wp)
      case%traction%limiting_coefficient = 0.003_wp
      call make_model(case, model, error)
   end subroutine slippery_model

end module test_ehl_limits
