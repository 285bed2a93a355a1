!> Newton's method for a line contact: pressure at all nodes and the level of the gap, solved simultaneously.
!>
!> In: problem, grid, initial values. Out: solution, or a status. A node is either full or dry: where the pressure of a full film
!> would be negative, it is zero instead, and the film is partly filled (complementarity). The set of dry nodes is determined
!> anew in each iteration. The Jacobian is analytic and complete. Its factors are reused as long as the iteration converges with
!> them, also for the next problem nearby; the row of a node that has become full or dry since they were computed is always the
!> current one.
module camroller_ehl_newton
   use camroller_kinds, only : wp
   use camroller_ehl_factors, only : ehl_rows_t, ehl_factors_t, factorise, replace_rows, solve_changes
   use camroller_ehl_grid, only : ehl_grid_t, deformation, integral
   use camroller_ehl_problem, only : ehl_problem_t
   use camroller_ehl_reynolds, only : ehl_fields_t, storage_t, evaluate_oil, evaluate_flow
   implicit none
   private

   public :: ehl_state_t, solve_newton, forget, contraction

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
      !> Factors of the derivative. Their rate holds for problems with the same storage; a step is to set it to `contraction`
      type(ehl_factors_t) :: factors
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

      ! Change of pressure and of film [-], of the level [-]; part of it that is made [-]
      real(wp) :: change(grid%size), film_change(grid%size), level_change, part
      ! Size of the change, that before, part of the change that is left [-]
      real(wp) :: size_of_change, before, rate
      type(ehl_rows_t) :: rows
      logical :: is_kept, is_near, has_same_nodes
      integer :: iteration, last

      converged = .false.
      is_near = .false.
      if (.not. present(storage)) state%factors%rate = contraction
      before = huge(1.0_wp)
      if (state%factors%unknowns > 0) before = 0.99_wp*small_change
      state%fields%film = film_at(grid, state)
      do iteration = 1, max_iterations + 1
         if (.not. is_near) call lift_pressure(problem, grid, state)
         call evaluate_oil(problem, grid, state%total, state%fields)
         call evaluate_flow(problem, grid, state%fields, storage)
         ! With the pressure of the time before, what is stored now says nothing of which nodes are full
         has_same_nodes = iteration == 1 .and. present(storage) .and. allocated(state%is_full)
         if (.not. has_same_nodes) call choose_full_nodes(problem, grid, state, iteration <= leaps, has_same_nodes, storage)
         converged = is_near .and. (has_same_nodes .or. before <= tolerance)
         if (converged .or. iteration > max_iterations) exit
         state%iterations = state%iterations + 1
         last = last_unknown(grid, state)
         call get_rows(grid, state, rows, storage)
         is_kept = before < small_change
         if (is_kept) call replace_rows(state%factors, grid, state%is_full, last, is_kept)
         if (.not. is_kept) then
            call factorise(state%factors, grid, rows, state%is_full, last)
            state%factorisations = state%factorisations + 1
         end if
         if (state%factors%unknowns == 0) return
         call find_change(problem, grid, state, rows, change, level_change, film_change)
         call choose_part(state, change, level_change, film_change, part, size_of_change)
         if (.not. size_of_change < huge(1.0_wp)) then
            state%factors%unknowns = 0
            return
         end if
         state%total = state%total + part*change
         state%level = state%level + part*level_change
         state%fields%film = state%fields%film + part*film_change
         rate = size_of_change
         if (is_kept) then
            ! Nodes that change say nothing of the factors
            if (iteration > 1 .and. has_same_nodes) state%factors%rate = size_of_change/before
            rate = max(state%factors%rate, 1.0e-3_wp)
            if (rate > contraction) state%factors%unknowns = 0
         else
            state%factors%rate = contraction
         end if
         is_near = part >= 1.0_wp .and. size_of_change*rate <= tolerance .and. size_of_change < small_change
         before = size_of_change
      end do
   end subroutine solve_newton

   !> Forget factors and full nodes: what comes next has nothing to do with them.
   pure subroutine forget(state)
      !> The state
      type(ehl_state_t), intent(inout) :: state

      state%factors%unknowns = 0
      if (allocated(state%is_full)) deallocate (state%is_full)
   end subroutine forget

   !> Film pressure that a step left below zero is set to zero, load and smallest film being kept.
   pure subroutine lift_pressure(problem, grid, state)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Total pressure, level and film
      type(ehl_state_t), intent(inout) :: state

      ! Smallest film before and after [-]
      real(wp) :: before, after

      if (all(state%total >= 0.0_wp)) return
      before = minval(state%fields%film)
      state%total = max(state%total, 0.0_wp)
      state%total = state%total*(problem%load/integral(grid, state%total))
      state%fields%film = film_at(grid, state)
      after = minval(state%fields%film)
      if (after >= before) return
      state%level = state%level + before - after
      state%fields%film = state%fields%film + before - after
   end subroutine lift_pressure

   !> Film at the pressure and the level of a state.
   pure function film_at(grid, state) result(film)
      type(ehl_grid_t), intent(in) :: grid
      type(ehl_state_t), intent(in) :: state
      !> Film over its scale [-]
      real(wp) :: film(grid%size)

      film = state%level + 0.5_wp*grid%x**2 + deformation(grid, state%total)
   end function film_at

   !> Nodes with a full film: where the flow is in balance rather than the pressure zero.
   !>
   !> A pressure weighs as much as the excess that it makes at its own node: what it drives to both neighbours, and in a short
   !> step what its own deformation stores. Without the latter the rest that an iteration leaves, over the length of the step,
   !> would count for more than the pressure, and nodes under full pressure would be taken for ruptured.
   pure subroutine choose_full_nodes(problem, grid, state, may_leap, has_same_nodes, storage)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> State; its full nodes are chosen
      type(ehl_state_t), intent(inout) :: state
      !> May the film of a steady contact grow by several nodes?
      logical, intent(in) :: may_leap
      !> Are they those of the iteration before?
      logical, intent(out) :: has_same_nodes
      !> What was stored before; absent: nothing changes with time. Present: the film may rupture in the inlet, too, and flows are
      !> not equal at all nodes
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

   !> Last node whose pressure is unknown: behind it there is neither film nor asperity pressure, nor was there.
   pure function last_unknown(grid, state) result(last)
      type(ehl_grid_t), intent(in) :: grid
      type(ehl_state_t), intent(in) :: state
      !> Number of the node
      integer :: last

      do last = grid%size - 1, 3, -1
         if (state%is_full(last) .or. state%total(last) > 0.0_wp .or. state%fields%asperity(last) > 0.0_wp) exit
      end do
   end function last_unknown

   !> Derivatives of the equation of each inner node over film pressure and film, the former then over the total pressure.
   pure subroutine get_rows(grid, state, rows, storage)
      type(ehl_grid_t), intent(in) :: grid
      type(ehl_state_t), intent(in) :: state
      !> Derivatives
      type(ehl_rows_t), intent(inout) :: rows
      !> What was stored before; absent: nothing changes with time
      type(storage_t), intent(in), optional :: storage

      ! Cell over the length of time [-]
      real(wp) :: rate
      integer :: i, k, j

      if (.not. allocated(rows%by_film)) allocate (rows%by_pressure(grid%size, 4), rows%by_film(grid%size, 4))
      rows%by_pressure = 0.0_wp
      rows%by_film = 0.0_wp
      associate (by_pressure => rows%by_pressure, by_film => rows%by_film, fields => state%fields)
         do i = 2, grid%size - 1
            if (state%is_full(i)) then
               by_pressure(i, 2:4) = fields%by_pressure(:, i)
               by_film(i, 2:4) = fields%by_film(:, i)
               by_pressure(i, 1:3) = by_pressure(i, 1:3) - fields%by_pressure(:, i - 1)
               by_film(i, 1:3) = by_film(i, 1:3) - fields%by_film(:, i - 1)
               if (present(storage)) then
                  rate = grid%weight(i)/storage%duration
                  by_pressure(i, 3) = by_pressure(i, 3) + rate*fields%density_slope(i)*fields%gap(i)
                  by_film(i, 3) = by_film(i, 3) + rate*fields%density(i)*fields%gap_slope(i)
               end if
            else
               by_pressure(i, 3) = 1.0_wp
            end if
            do k = 1, 4
               j = i - 3 + k
               if (j < 1) cycle
               by_film(i, k) = by_film(i, k) - by_pressure(i, k)*fields%asperity_slope(j)
            end do
         end do
      end associate
   end subroutine get_rows

   !> Newton's change of pressure, level and film.
   pure subroutine find_change(problem, grid, state, rows, change, level_change, film_change)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> The state with its factors
      type(ehl_state_t), intent(in) :: state
      !> Derivatives
      type(ehl_rows_t), intent(in) :: rows
      !> Change of the total pressure at the nodes, of the level, of the film [-]
      real(wp), intent(out) :: change(grid%size), level_change, film_change(grid%size)

      ! Right-hand side [-]
      real(wp) :: side(state%factors%unknowns + 1)
      integer :: n

      n = state%factors%unknowns
      side(:n) = -merge(state%fields%excess(2:n + 1), state%fields%pressure(2:n + 1), state%is_full(2:n + 1))
      side(n + 1) = problem%load - integral(grid, state%total)
      call solve_changes(state%factors, grid, rows, state%is_full, side, change, level_change, film_change)
   end subroutine find_change

   !> Part of a change that leaves the film positive and the pressure of its size, and the size of the whole change.
   pure subroutine choose_part(state, change, level_change, film_change, part, size_of_change)
      type(ehl_state_t), intent(in) :: state
      !> Change of the total pressure at the nodes, of the level, of the film [-]
      real(wp), intent(in) :: change(:), level_change, film_change(:)
      !> Part of it that is made [-]
      real(wp), intent(out) :: part
      !> Largest change of the pressure over p_H, of the film over itself [-]
      real(wp), intent(out) :: size_of_change

      ! Change of the film over itself [-]
      real(wp) :: relative(size(change))

      size_of_change = huge(1.0_wp)
      part = 1.0_wp
      if (.not. all(abs(change) < 1.0e100_wp) .or. .not. abs(level_change) < 1.0e100_wp) return
      relative = film_change/max(state%fields%film, 1.0e-12_wp)
      part = min(1.0_wp, largest_loss/max(-minval(relative), largest_loss), &
         & largest_change/max(maxval(abs(change)), largest_change))
      size_of_change = max(maxval(abs(change)), maxval(abs(relative)))
   end subroutine choose_part

end module camroller_ehl_newton
