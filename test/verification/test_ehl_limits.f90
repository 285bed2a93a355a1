!> The cycle with a solved film at its ends: loads far below the largest, a roller that runs backwards.
module test_ehl_limits
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, kind_convergence
   use camroller_case, only : case_t
   use camroller_dynamics, only : moments_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_films, only : ehl_films_t, limit_cells
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem
   use camroller_ehl_solution, only : ehl_options_t, solve_on_grids
   use camroller_kinematics, only : position_t
   use camroller_local_limit, only : least_limit
   use camroller_lubricant, only : law_cameron
   use camroller_model, only : model_t
   use camroller_state, only : evaluate_loading
   use camroller_traction, only : cap_smooth, limit_local, limit_names
   use closeness, only : expect_error, has_failed
   use ehl_contacts, only : contact_of_groups
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
         new_unittest("a film with squeeze whose inlet changes sides ends in words", test_turned_inlet), &
         new_unittest("over the cycle no shear is above limits at each place, and limits that nothing reaches change none", &
            & test_limits_of_cycle), &
         new_unittest("a stress with a limit at each place is limited between the nodes of a spike too", test_limit_of_places) &
      ]
   end subroutine collect_ehl_limits

   !> Martin's film of rigid bodies and an oil of constant viscosity, h = 4.895 eta u R/w, is a lower bound that is nearly reached.
   !> Nodes that end where a fiftieth of the largest load has its inlet make the film 4 % thinner.
   subroutine test_light_load(error)
      type(error_type), allocatable, intent(out) :: error
      ! What 129 and 257 nodes differ by here [-]
      real(wp), parameter :: allowed = 0.003_wp
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
         call check(error, now%films%central > (1.0_wp - allowed)*film, "film below that of rigid bodies")
         if (allocated(error)) return
         ! Elasticity and viscosity under pressure add as little as the error
         call check(error, now%films%central < (1.0_wp + 3.0_wp*allowed)*film, "film")
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

   !> Cycles of steady films with limits at each place: a thousandth of the pressure, which add up to that part of the load, and
   !> such as no stress comes near, against those with a limit of the whole shear.
   subroutine test_limits_of_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      ! Rise of the limiting stress with the pressure [-]; least limits of all places, part of those of the pressure [-]
      real(wp), parameter :: low = 1.0e-3_wp, high = 1.0e3_wp, allowed = 1.0e-6_wp
      type(ehl_cycle_options_t), parameter :: options = ehl_cycle_options_t(nodes=65, is_transient=.false.)
      type(case_t) :: case
      type(model_t) :: model
      type(ehl_cycle_t) :: limited, free, whole
      type(error_t), allocatable :: failure

      case = thesis_case()
      call set_point(case, 30.0_wp*pi, 0.05_wp)
      case%traction%limit = limit_names(limit_local)
      case%traction%limiting_coefficient = low
      call make_model(case, model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(limited, model, options, failure)
      if (has_failed(failure, error)) return
      associate (part => abs(limited%moments%shear)/(low*limited%moments%load))
         call check(error, maxval(part) <= 1.0_wp + allowed .and. maxval(part) > 0.9_wp, "shear over its limits")
      end associate
      if (allocated(error)) return
      case%traction%limiting_coefficient = high
      case%traction%limiting_stress = 1.0e12_wp
      call make_model(case, model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(free, model, options, failure)
      if (has_failed(failure, error)) return
      case%traction%limit = limit_names(1)
      call make_model(case, model, error)
      if (allocated(error)) return
      call integrate_ehl_cycle(whole, model, options, failure)
      if (has_failed(failure, error)) return
      call check(error, size(free%moments), size(whole%moments), "steps")
      if (allocated(error)) return
      call check(error, all(abs(free%moments%shear - whole%moments%shear) <= allowed*maxval(abs(whole%moments%shear))), &
         & "limits that are not reached change the shear")
   end subroutine test_limits_of_cycle

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

   !> Where viscosity over film falls by decades from a node to the next: against a sum over a thousand places of each cell. Limited
   !> cell by cell the traction is 12 % larger.
   subroutine test_limit_of_places(error)
      type(error_type), allocatable, intent(out) :: error
      ! Rise of the limiting stress with the pressure [-]; sliding speed over that of entrainment [-]; eight parts of a cell, each
      ! limited as a whole, leave 0.8 % in the worst of nine contacts [-]
      real(wp), parameter :: coefficient = 0.08_wp, slide = 0.009_wp, allowed = 0.01_wp
      integer, parameter :: places = 1000
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films, coarse
      ! Shear, its sum over places [N/m], slope that is not used [Pa s/m]; place in a cell [-]
      real(wp) :: shear, expected, slope, place
      logical :: converged
      integer :: i, k, status

      contact = contact_of_groups(4.0e-5_wp, 1.0e-10_wp, 4500.0_wp, law=law_cameron)
      call new_ehl_problem(problem, contact, status)
      problem%keeps_cells = .true.
      call solve_on_grids(problem, ehl_options_t(), grid, state, films, coarse, converged)
      call check(error, status == 0 .and. converged, "no solution")
      if (allocated(error)) return
      call limit_cells(films%cells, cap_smooth, coefficient, 0.0_wp, slide*contact%entrainment_speed, shear, slope)
      expected = 0.0_wp
      do i = 1, grid%size - 1
         if (.not. (state%is_full(i) .and. state%is_full(i + 1))) cycle
         do k = 1, places
            place = (k - 0.5_wp)/places
            expected = expected + grid%step(i)/places*limited(i, place)
         end do
      end do
      expected = expected*problem%length_scale
      call check(error, abs(shear/expected - 1.0_wp) < allowed, "shear")

   contains

      !> Limited stress between two nodes [Pa].
      real(wp) function limited(node, place)
         !> The first of them
         integer, intent(in) :: node
         !> Place between them [-]
         real(wp), intent(in) :: place
         ! Stress without a limit, its limit [Pa]
         real(wp) :: free, limit

         associate (fields => state%fields)
            free = exp((1.0_wp - place)*(fields%log_viscosity(node) - log(fields%film(node))) &
               & + place*(fields%log_viscosity(node + 1) - log(fields%film(node + 1))))
            free = free*contact%oil%viscosity*slide*contact%entrainment_speed/problem%film_scale
            limit = coefficient*problem%pressure_scale*((1.0_wp - place)*fields%pressure(node) + place*fields%pressure(node + 1))
         end associate
         limit = max(limit, least_limit)
         limited = limit*tanh(free/limit)
      end function limited
   end subroutine test_limit_of_places

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
