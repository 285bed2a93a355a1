!> A cycle by one of our own methods: integrate with stops, then take the state at the output angles.
module bench_own
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_ode, only : method_t, options_t, integrate
   use camroller_ode_problem, only : problem_t, counters_t
   use camroller_ode_switching, only : switching_problem_t, integrate_switching
   use camroller_ode_methods, only : new_method
   use camroller_trajectory, only : trajectory_t, interpolate_state
   implicit none
   private

   public :: own_t, new_own, run_own, largest_step

   !> A method with its work space
   type :: own_t
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      !> Work of the last run
      type(counters_t) :: counters
   end type own_t

   !> Largest and first step [rad]
   real(wp), parameter :: largest_step = 10.0_wp*degree, first_step = 0.01_wp*degree

contains

   !> Make a solver from a method's name.
   subroutine new_own(solver, name, components, integrals, error)
      !> Solver
      type(own_t), intent(out) :: solver
      !> Name of the method
      character(len=*), intent(in) :: name
      !> Number of components of the state
      integer, intent(in) :: components
      !> How many of them are integrals
      integer, intent(in) :: integrals
      !> Deck error for an unknown name
      type(error_t), allocatable, intent(out) :: error

      call new_method(solver%method, name, components, error, integrals)
   end subroutine new_own

   !> Integrate and interpolate.
   subroutine run_own(solver, problem, stops, first_state, tolerance, angles, states, error)
      !> Solver
      type(own_t), intent(inout) :: solver
      !> Right-hand side
      class(problem_t), intent(in) :: problem
      !> Start, stops, end [rad]
      real(wp), intent(in) :: stops(:)
      !> State at the start [state]
      real(wp), intent(in) :: first_state(:)
      !> Error allowed per step and component [state]
      real(wp), intent(in) :: tolerance(:)
      !> Output angles, increasing [rad]
      real(wp), intent(in) :: angles(:)
      !> State at the output angles, shape (component, angle) [state]
      real(wp), intent(out) :: states(:, :)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(options_t) :: options
      ! State at the end [state]
      real(wp) :: state(size(first_state))
      integer :: i, hint

      options%tolerance = tolerance
      options%step = first_step
      options%max_step = largest_step
      solver%counters = counters_t()
      state = first_state
      select type (problem)
      class is (switching_problem_t)
         call integrate_switching(problem, solver%method, options, stops, state, solver%trajectory, solver%counters, error)
      class default
         call integrate(problem, solver%method, options, stops, state, solver%trajectory, solver%counters, error)
      end select
      if (allocated(error)) return
      hint = 1
      do i = 1, size(angles)
         call interpolate_state(solver%trajectory, angles(i), hint, states(:, i))
      end do
   end subroutine run_own

end module bench_own
