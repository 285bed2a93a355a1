!> Newton's method for a line contact: pressure at all nodes and the level of the gap at once.
!>
!> Layer: ehl. In: problem, grid, a start. Out: solution, or a status. A node is full or dry: where the film would pull, its
!> pressure is zero instead, and more oil may leave than enters (complementarity). Which nodes are dry is decided anew in each
!> iteration. The derivative is analytic and complete; its factors are kept while they still serve, and serve the next problem
!> nearby as well.
module camroller_ehl_newton
   use camroller_kinds, only : wp
   use camroller_lapack, only : dgetrf, dgetrs
   use camroller_ehl_grid, only : ehl_grid_t, deformation, integral
   use camroller_ehl_problem, only : ehl_problem_t
   use camroller_ehl_reynolds, only : ehl_fields_t, storage_t, evaluate_film, evaluate_flow
   implicit none
   private

   public :: ehl_state_t, solve_newton

   !> Solution, and what helps to find the next one
   type :: ehl_state_t
      !> Pressure of film and asperities at the nodes [-]
      real(wp), allocatable :: total(:)
      !> Level of the gap, H0 [-]
      real(wp) :: level
      !> Film, flow and the rest there
      type(ehl_fields_t) :: fields
      !> Is the film full at a node?
      logical, allocatable :: is_full(:)
      !> Factors of the derivative, scaled by rows [-]; their rows' scales [-]; pivots
      real(wp), allocatable :: factors(:, :), scale(:)
      integer, allocatable :: pivots(:)
      !> Unknown pressures in the factors; zero: there are none
      integer :: unknowns = 0
      !> Work done: iterations, factorisations
      integer :: iterations = 0, factorisations = 0
   end type ehl_state_t

   !> Part of itself that the film may lose in one step; change of a pressure in one step, over the peak of the dry contact, without
   !> which a spike between nodes runs to and fro: viscosity is its exponential [-]
   real(wp), parameter :: largest_loss = 0.7_wp, largest_change = 1.0_wp
   !> Iterations in which the end of the film may move by more than one node
   integer, parameter :: leaps = 3
   !> Change below which the factors are kept, and the contraction that they must then bring [-]
   real(wp), parameter :: small_change = 0.03_wp, contraction = 0.2_wp

contains

   !> Solve from a start: `state` holds total pressure and level.
   pure subroutine solve_newton(problem, grid, state, tolerance, max_iterations, converged, storage)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> In: start; out: solution
      type(ehl_state_t), intent(inout) :: state
      !> Estimated change that is left, of the pressure over p_H and of the film over itself [-]
      real(wp), intent(in) :: tolerance
      !> Iterations to give up after
      integer, intent(in) :: max_iterations
      !> Was the tolerance reached?
      logical, intent(out) :: converged
      !> What was stored before; absent: nothing changes with time
      type(storage_t), intent(in), optional :: storage

      ! Change of pressure [-] and of the level [-]; part of it that is made [-]
      real(wp) :: change(grid%size), level_change, part
      ! Size of the change, that before, what is left [-]
      real(wp) :: size_of_change, before, left
      logical :: has_same_nodes, is_new
      integer :: iteration

      converged = .false.
      before = huge(1.0_wp)
      if (state%unknowns > 0) before = 0.99_wp*small_change
      do iteration = 1, max_iterations
         state%iterations = state%iterations + 1
         call lift_pressure(problem, grid, state)
         call evaluate_film(problem, grid, state%total, state%level, state%fields)
         call evaluate_flow(problem, grid, state%fields, storage)
         call choose_full_nodes(problem, grid, state, iteration <= leaps, has_same_nodes, storage)
         is_new = .not. (has_same_nodes .and. state%unknowns > 0 .and. before < small_change)
         if (is_new) call factorise(grid, state, storage)
         if (state%unknowns == 0) return
         call find_change(problem, grid, state, change, level_change)
         call choose_part(grid, state, change, level_change, part, size_of_change)
         if (.not. size_of_change < huge(1.0_wp)) then
            state%unknowns = 0
            return
         end if
         state%total = state%total + part*change
         state%level = state%level + part*level_change
         left = size_of_change**2
         if (.not. is_new) left = size_of_change*max(size_of_change/before, 1.0e-3_wp)
         if (.not. is_new .and. iteration > 1 .and. size_of_change > contraction*before) state%unknowns = 0
         converged = part >= 1.0_wp .and. left <= tolerance .and. size_of_change < small_change
         before = size_of_change
         if (converged) exit
      end do
      if (.not. converged) return
      call evaluate_film(problem, grid, state%total, state%level, state%fields)
      call evaluate_flow(problem, grid, state%fields, storage)
   end subroutine solve_newton

   !> Film pressure that a step left below zero is set to zero, load and smallest film being kept.
   pure subroutine lift_pressure(problem, grid, state)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Total pressure and level
      type(ehl_state_t), intent(inout) :: state

      ! Smallest film before and after [-]
      real(wp) :: before, after

      if (all(state%total >= 0.0_wp)) return
      before = minval(state%level + 0.5_wp*grid%x**2 + deformation(grid, state%total))
      state%total = max(state%total, 0.0_wp)
      state%total = state%total*(problem%load/integral(grid, state%total))
      after = minval(state%level + 0.5_wp*grid%x**2 + deformation(grid, state%total))
      if (after < before) state%level = state%level + before - after
   end subroutine lift_pressure

   !> Nodes with a full film: where the flow is in balance rather than the pressure zero.
   !>
   !> A pressure weighs as much as the excess that it makes at its own node: what it drives to both neighbours, and in a short
   !> step what its own deformation stores. Without the latter the rest that an iteration leaves, over the length of the step,
   !> would count for more than the pressure, and nodes under full pressure would be taken for ruptured.
   pure subroutine choose_full_nodes(problem, grid, state, may_leap, has_same_nodes, storage)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> State; its full nodes are chosen
      type(ehl_state_t), intent(inout) :: state
      !> May the film of a steady contact grow by several nodes?
      logical, intent(in) :: may_leap
      !> Are they those of the factors?
      logical, intent(out) :: has_same_nodes
      !> What was stored before; absent: nothing changes with time. Present: the film may rupture in the inlet, too, and flows are
      !> not equal at all places
      type(storage_t), intent(in), optional :: storage

      ! Conductance to both neighbours, without thickening, and storage by a node's own pressure [-]
      real(wp) :: conductance
      logical :: is_full(grid%size), is_transient
      integer :: i, last

      is_transient = present(storage)
      is_full = .false.
      last = 2
      do i = 2, grid%size - 1
         conductance = max(state%fields%film(i), 1.0e-9_wp)**3/problem%speed*(1.0_wp/grid%step(i - 1) + 1.0_wp/grid%step(i))
         if (is_transient) conductance = conductance + grid%weight(i)*max(grid%kernel(i, i), 0.0_wp)/storage%duration
         is_full(i) = (grid%x(i) <= 0.0_wp .and. .not. is_transient) &
            & .or. state%fields%pressure(i)*conductance >= state%fields%excess(i)
         if (is_full(i)) last = i
      end do
      if (may_leap .and. .not. is_transient) then
         do i = last + 1, grid%size - 1
            if (state%fields%flow(i) >= state%fields%flow(last)) exit
            is_full(i - 1) = .true.
         end do
      end if
      has_same_nodes = .false.
      if (allocated(state%is_full)) has_same_nodes = all(is_full .eqv. state%is_full)
      state%is_full = is_full
   end subroutine choose_full_nodes

   !> Derivative of all equations over all unknowns, and its factors.
   pure subroutine factorise(grid, state, storage)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> State with its derivatives; its factors
      type(ehl_state_t), intent(inout) :: state
      !> What was stored before; absent: nothing changes with time
      type(storage_t), intent(in), optional :: storage

      ! Derivatives of an equation over the film's pressure and over the film at the nodes i - 2 to i + 1 [-]
      real(wp) :: by_pressure(4, grid%size), by_film(4, grid%size)
      integer :: i, j, n, info

      n = last_unknown(grid, state) - 1
      state%unknowns = 0
      if (allocated(state%factors)) then
         if (size(state%factors, 1) /= n + 1) deallocate (state%factors, state%scale, state%pivots)
      end if
      if (.not. allocated(state%factors)) allocate (state%factors(n + 1, n + 1), state%scale(n + 1), state%pivots(n + 1))
      call equation_slopes(grid, state, by_pressure, by_film, storage)
      do j = 2, n + 1
         state%factors(1, j - 1) = sum(by_film(2:4, 2)*grid%kernel(1:3, j))
         do i = 3, n + 1
            state%factors(i - 1, j - 1) = by_film(1, i)*grid%kernel(i - 2, j) + by_film(2, i)*grid%kernel(i - 1, j) &
               & + by_film(3, i)*grid%kernel(i, j) + by_film(4, i)*grid%kernel(i + 1, j)
         end do
         do i = max(2, j - 1), min(n + 1, j + 2)
            state%factors(i - 1, j - 1) = state%factors(i - 1, j - 1) + by_pressure(j - i + 3, i)
         end do
      end do
      state%factors(:n, n + 1) = sum(by_film(:, 2:n + 1), dim=1)
      state%factors(n + 1, :n) = grid%weight(2:n + 1)
      state%factors(n + 1, n + 1) = 0.0_wp
      state%scale = 0.0_wp
      do j = 1, n + 1
         state%scale = max(state%scale, abs(state%factors(:, j)))
      end do
      if (.not. all(state%scale > 0.0_wp .and. state%scale < huge(1.0_wp))) return
      state%scale = 1.0_wp/state%scale
      do j = 1, n + 1
         state%factors(:, j) = state%factors(:, j)*state%scale
      end do
      call dgetrf(n + 1, n + 1, state%factors, n + 1, state%pivots, info)
      state%factorisations = state%factorisations + 1
      if (info == 0) state%unknowns = n
   end subroutine factorise

   !> Last node whose pressure is unknown: behind it there is neither film nor asperity pressure, nor was there.
   pure function last_unknown(grid, state) result(last)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The state
      type(ehl_state_t), intent(in) :: state
      !> Number of the node
      integer :: last

      do last = grid%size - 1, 3, -1
         if (state%is_full(last) .or. state%total(last) > 0.0_wp .or. state%fields%asperity(last) > 0.0_wp) exit
      end do
   end function last_unknown

   !> Derivatives of the equation of each inner node over film pressure and film, the former then over the total pressure.
   pure subroutine equation_slopes(grid, state, by_pressure, by_film, storage)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The state
      type(ehl_state_t), intent(in) :: state
      !> Derivatives over total pressure, then film, at the nodes i - 2 to i + 1 [-]
      real(wp), intent(out) :: by_pressure(4, grid%size), by_film(4, grid%size)
      !> What was stored before; absent: nothing changes with time
      type(storage_t), intent(in), optional :: storage

      ! Cell over the length of time [-]
      real(wp) :: rate
      integer :: i, k, j

      by_pressure = 0.0_wp
      by_film = 0.0_wp
      do i = 2, grid%size - 1
         if (state%is_full(i)) then
            by_pressure(2:4, i) = state%fields%by_pressure(:, i)
            by_film(2:4, i) = state%fields%by_film(:, i)
            by_pressure(1:3, i) = by_pressure(1:3, i) - state%fields%by_pressure(:, i - 1)
            by_film(1:3, i) = by_film(1:3, i) - state%fields%by_film(:, i - 1)
            if (present(storage)) then
               rate = grid%weight(i)/storage%duration
               by_pressure(3, i) = by_pressure(3, i) + rate*state%fields%density_slope(i)*state%fields%gap(i)
               by_film(3, i) = by_film(3, i) + rate*state%fields%density(i)*state%fields%gap_slope(i)
            end if
         else
            by_pressure(3, i) = 1.0_wp
         end if
         do k = 1, 4
            j = i - 3 + k
            if (j < 1) cycle
            by_film(k, i) = by_film(k, i) - by_pressure(k, i)*state%fields%asperity_slope(j)
         end do
      end do
   end subroutine equation_slopes

   !> Newton's change of pressure and level.
   pure subroutine find_change(problem, grid, state, change, level_change)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The state with its factors
      type(ehl_state_t), intent(in) :: state
      !> Change of the total pressure at the nodes, of the level [-]
      real(wp), intent(out) :: change(grid%size), level_change

      ! Right-hand side, then change [-]
      real(wp) :: side(state%unknowns + 1)
      integer :: n, info

      n = state%unknowns
      side(:n) = -merge(state%fields%excess(2:n + 1), state%fields%pressure(2:n + 1), state%is_full(2:n + 1))
      side(n + 1) = problem%load - integral(grid, state%total)
      side = side*state%scale
      call dgetrs("N", n + 1, 1, state%factors, n + 1, state%pivots, side, n + 1, info)
      change = 0.0_wp
      change(2:n + 1) = side(:n)
      level_change = side(n + 1)
   end subroutine find_change

   !> Part of a change that leaves the film positive and the pressure of its size, and the size of the whole change.
   pure subroutine choose_part(grid, state, change, level_change, part, size_of_change)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The state
      type(ehl_state_t), intent(in) :: state
      !> Change of the total pressure at the nodes, of the level [-]
      real(wp), intent(in) :: change(:), level_change
      !> Part of it that is made [-]
      real(wp), intent(out) :: part
      !> Largest change of the pressure over p_H, of the film over itself [-]
      real(wp), intent(out) :: size_of_change

      ! Change of the film over itself [-]
      real(wp) :: relative(grid%size)

      size_of_change = huge(1.0_wp)
      part = 1.0_wp
      if (.not. all(abs(change) < 1.0e100_wp) .or. .not. abs(level_change) < 1.0e100_wp) return
      relative = (deformation(grid, change) + level_change)/max(state%fields%film, 1.0e-12_wp)
      part = min(1.0_wp, largest_loss/max(-minval(relative), largest_loss), &
         & largest_change/max(maxval(abs(change)), largest_change))
      size_of_change = max(maxval(abs(change)), maxval(abs(relative)))
   end subroutine choose_part

end module camroller_ehl_newton
