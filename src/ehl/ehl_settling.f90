!> Pseudo-transient continuation: a line contact integrated in time until it is steady.
!>
!> In: problem, grid, initial values from which Newton's method does not find the steady film. Out: the steady film. The
!> equations are those of a transient film, with a time step that grows as long as Newton's method converges. On the way from the
!> initial values to the solution the Jacobian of the steady equations may be singular, so that Newton's method fails; the
!> storage term of a short time step keeps it regular, and errors of the initial values leave the contact with the oil.
module camroller_ehl_settling
   use camroller_kinds, only : wp
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_problem, only : ehl_problem_t
   use camroller_ehl_reynolds, only : storage_t, evaluate_film
   use camroller_ehl_newton, only : ehl_state_t, solve_newton, forget, contraction
   implicit none
   private

   public :: put_back, settle

   !> First step and shortest, and that from which on the steady film is tried, over the time in which the surfaces' mean speed
   !> travels one half width [-]
   real(wp), parameter :: first_step = 0.0125_wp, shortest_step = 1.0e-6_wp, long_step = 4.0_wp
   !> Growth of a step that was solved, and part of one that was not [-]
   real(wp), parameter :: growth = 4.0_wp, reduction = 0.25_wp
   !> Change of film or pressure in a step below which the steady film is tried; what is left over in a step [-]
   real(wp), parameter :: small_change = 1.0e-2_wp, step_tolerance = 1.0e-4_wp
   !> Steps to give up after, and iterations of Newton's method in one
   integer, parameter :: most_steps = 60, iterations = 9

contains

   !> Steady film from a start: `state` holds total pressure and level.
   pure subroutine settle(problem, grid, state, tolerance, converged)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> In: start; out: solution
      type(ehl_state_t), intent(inout) :: state
      !> What Newton's method may leave over [-]
      real(wp), intent(in) :: tolerance
      !> Was the steady film found?
      logical, intent(out) :: converged

      type(storage_t) :: storage
      ! Film, pressure and level before a step; largest change in it [-]
      real(wp) :: film(grid%size), total(grid%size), level, change
      integer :: step

      storage%duration = first_step
      do step = 1, most_steps
         total = state%total
         level = state%level
         call evaluate_film(problem, grid, total, level, state%fields)
         film = state%fields%film
         storage%mass = grid%weight*state%fields%density*state%fields%gap
         state%factors%rate = contraction
         call solve_newton(problem, grid, state, step_tolerance, iterations, converged, storage)
         if (.not. converged) then
            call put_back(total, level, state)
            storage%duration = reduction*storage%duration
            if (storage%duration < shortest_step) return
            cycle
         end if
         change = max(maxval(abs(state%fields%film - film)/film), maxval(abs(state%total - total)))
         if (change < small_change .or. storage%duration > long_step) then
            total = state%total
            level = state%level
            call solve_newton(problem, grid, state, tolerance, iterations, converged)
            if (converged) return
            call put_back(total, level, state)
         end if
         storage%duration = growth*storage%duration
      end do
      converged = .false.
   end subroutine settle

   !> Go back to the pressure before a step, and forget the factors.
   pure subroutine put_back(total, level, state)
      !> Total pressure and level before [-]
      real(wp), intent(in) :: total(:), level
      !> The state
      type(ehl_state_t), intent(inout) :: state

      state%total = total
      state%level = level
      call forget(state)
   end subroutine put_back

end module camroller_ehl_settling
