!> Pressure, film and temperature of a line contact, brought to agree.
!>
!> In: problem with heat, grid, a solution at some temperature. Out: the solution at the temperature that its own heat keeps. The
!> energy equation at a pressure and a film, and Newton's method for both at a temperature, take turns until the viscosity changes
!> by no more than the tolerance. Where Newton's method does not find the film at a turn's temperature, as at the first of a thick
!> film, whose viscosity falls to a sixth, the film is integrated in time until it is steady (`ehl_settling`). The next turn's
!> temperature is the mixture of the last ones whose changes cancel best (Anderson, J. ACM 12 (1965) 547): without it, turns run
!> in circles in fast contacts whose inlet is hot.
module camroller_ehl_heat
   use camroller_kinds, only : wp
   use camroller_ehl_energy, only : ehl_energy_t, lowest_rise, new_energy, solve_energy
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_newton, only : ehl_state_t, solve_newton
   use camroller_ehl_problem, only : ehl_problem_t
   use camroller_ehl_reynolds, only : ehl_fields_t
   use camroller_ehl_settling, only : put_back, settle
   use camroller_lapack, only : dgesv
   implicit none
   private

   public :: start_heat, warm_film

   !> Turns to give up after; iterations of Newton's method in each
   integer, parameter :: most_turns = 60, newton_iterations = 30
   !> Turns that are mixed with the last one, at most
   integer, parameter :: depth = 4
   !> What Newton's method may leave over at most, over p_H: far before a contact, where the gap is wide, the flow that a wrong
   !> pressure drives would make heat that never comes to rest [-]
   real(wp), parameter :: pressure_tolerance = 1.0e-9_wp
   !> Part of a diagonal that keeps a mixture determined where changes are alike: round-off of their products [-]
   real(wp), parameter :: least_diagonal = 1.0e-14_wp

   !> Turns so far
   type :: turns_t
      !> Number of differences that are kept; below zero: no turn yet
      integer :: count = -1
      !> Differences from turn to turn: of the rise that a turn gives [K], of the change that it makes of ln(viscosity) [-]; over
      !> node, then turn
      real(wp), allocatable :: rises(:, :), changes(:, :)
      !> The same of the last turn itself
      real(wp), allocatable :: rise(:), change(:) ! [K], [-]
   end type turns_t

contains

   !> Bring a solution to the temperature that its heat keeps; one without heat stays as it is.
   pure subroutine warm_film(problem, grid, state, tolerance, converged)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> In: solution at the temperature of its fields, or at that around; out: at its own temperature
      type(ehl_state_t), intent(inout) :: state
      !> Estimated change that is left, of the pressure over p_H, of film and viscosity over themselves [-]
      real(wp), intent(in) :: tolerance
      !> Was it reached?
      logical, intent(out) :: converged

      type(ehl_energy_t) :: energy
      type(turns_t) :: turns
      ! Rises of the turn before [K]; pressure and level at its temperature [-]
      real(wp) :: old(grid%size), total(grid%size), level
      integer :: turn

      converged = .true.
      if (.not. allocated(problem%heat)) return
      associate (fields => state%fields)
         if (.not. allocated(fields%rise)) call start_heat(grid, fields)
         call new_energy(energy, problem, grid)
         allocate (turns%rises(grid%size, depth), turns%changes(grid%size, depth), turns%rise(grid%size), turns%change(grid%size))
         do turn = 1, most_turns
            old = fields%rise
            call solve_energy(problem, grid, energy, state, 0.1_wp*tolerance, converged)
            if (.not. converged) return
            converged = maxval(abs(fields%by_rise*(fields%rise - old))) <= tolerance
            if (converged) return
            call mix_turns(turns, fields%by_rise*(fields%rise - old), fields%rise)
            ! A mixture of rises may lie beyond all of them; beyond the pole of the viscosity's law iterations ran away to 2e13 K
            fields%rise = max(fields%rise, lowest_rise(problem))
            total = state%total
            level = state%level
            call solve_newton(problem, grid, state, min(tolerance, pressure_tolerance), newton_iterations, converged)
            if (.not. converged) then
               call put_back(total, level, state)
               call settle(problem, grid, state, min(tolerance, pressure_tolerance), converged)
            end if
            if (.not. converged) return
         end do
         converged = .false.
      end associate
   end subroutine warm_film

   !> Room for the temperature, which is that around to begin with.
   pure subroutine start_heat(grid, fields)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Gets the room
      type(ehl_fields_t), intent(inout) :: fields

      allocate (fields%rise(grid%size), fields%by_rise(grid%size), fields%flux(grid%size, 2), fields%surface_rise(grid%size, 2), &
         & source=0.0_wp)
   end subroutine start_heat

   !> Mix the rise that a turn gives with those before so that what is left of the changes is least.
   pure subroutine mix_turns(turns, change, rise)
      !> Turns so far; this one is added
      type(turns_t), intent(inout) :: turns
      !> Change of ln(viscosity) by this turn [-]
      real(wp), intent(in) :: change(:)
      !> In: the rise that it gives; out: the mixture [K]
      real(wp), intent(inout) :: rise(:)

      ! Products of changes, parts of the turns before [-]
      real(wp) :: products(depth, depth), parts(depth), given(size(rise))
      integer :: pivots(depth), i, k, info

      given = rise
      k = min(turns%count + 1, depth)
      if (k > 0) then
         turns%rises(:, 2:k) = turns%rises(:, :k - 1)
         turns%changes(:, 2:k) = turns%changes(:, :k - 1)
         turns%rises(:, 1) = given - turns%rise
         turns%changes(:, 1) = change - turns%change
         do i = 1, k
            products(:k, i) = matmul(turns%changes(:, i), turns%changes(:, :k))
            parts(i) = dot_product(turns%changes(:, i), change)
         end do
         do i = 1, k
            products(i, i) = products(i, i)*(1.0_wp + least_diagonal)
         end do
         call dgesv(k, 1, products, depth, pivots, parts, depth, info)
         if (info == 0) rise = given - matmul(turns%rises(:, :k), parts(:k))
      end if
      turns%count = k
      turns%rise = given
      turns%change = change
   end subroutine mix_turns

end module camroller_ehl_heat
