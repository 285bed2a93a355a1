!> Solution of a line contact from default initial values, on two grids, with film and friction.
!>
!> In: contact, number of nodes. Out: films, friction, and the difference of the two grids; or a status. Initial values are the
!> pressure of a dry elastic contact or of a rigid one, according to the expected film; where Newton's method does not converge
!> from them, the film is integrated in time until it is steady (`ehl_settling`). There are no parameters to choose.
module camroller_ehl_solution
   use camroller_kinds, only : wp, pi
   use camroller_error, only : error_t, raise, kind_domain, kind_convergence
   use camroller_ehl_grid, only : ehl_grid_t, new_ehl_grid, new_uniform_grid, deformation, integral
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem, asperity_reach, range_text, in_range
   use camroller_ehl_reynolds, only : new_ehl_fields
   use camroller_ehl_newton, only : ehl_state_t, solve_newton, forget
   use camroller_ehl_heat, only : start_heat, warm_film
   use camroller_ehl_settling, only : settle
   use camroller_ehl_films, only : ehl_films_t, get_films, compare_grids, chance_error
   use camroller_number_text, only : fixed_text
   implicit none
   private

   public :: ehl_options_t, solve_contact_film, solve_cold, solve_on_grid, solve_on_grids, make_grid

   !> What may be chosen; nothing here decides whether a solution is found
   type :: ehl_options_t
      !> Number of nodes of the finer grid, odd
      integer :: nodes = 129
      !> Largest relative difference of a film on both grids for which a result is given [-]
      real(wp) :: largest_difference = 0.1_wp
      !> What Newton's method may leave over [-]
      real(wp) :: tolerance = 1.0e-9_wp
      !> Stated error of a film, and that of films whose grids agree by chance, at which no finer grid is taken [-]; zero: the
      !> finest one is taken
      real(wp) :: accuracy = 0.0_wp
      !> Ends of the domain, inlet and outlet [half widths]; zero: as the film calls for
      real(wp) :: reach(2) = 0.0_wp
      !> Equal steps instead of steps that follow the pressure?
      logical :: is_uniform = .false.
   end type ehl_options_t

   !> Film over b^2/R below which the dry contact's pressure is the better start [-]
   real(wp), parameter :: elastic_film = 0.3_wp
   !> Inlet that starves the contact by less than 0.1 %: least [half widths], and over the length in which a parabola's gap doubles
   !> [-]
   real(wp), parameter :: least_inlet = 16.0_wp, inlet_part = 24.0_wp
   !> Iterations from nothing, and from a coarser grid, before another way is tried
   integer, parameter :: cold_iterations = 20, refining_iterations = 15
   !> Nodes of the coarsest grid
   integer, parameter :: smallest_grid = 33
   !> Nodes from which on the stated error says enough to stop at
   integer, parameter :: judged_grid = 65
   !> Cotangent-like constant of the rigid contact: angle at which its film ends, by Reynolds' condition [rad]
   real(wp), parameter :: rigid_end = 0.443_wp

contains

   !> Film and friction of a contact from nothing, on two grids.
   !>
   !> All grids are nested, and the error stated is what they differ by.
   subroutine solve_contact_film(contact, options, films, error)
      !> The contact
      type(ehl_contact_t), intent(in) :: contact
      !> Number of nodes and the like
      type(ehl_options_t), intent(in) :: options
      !> Film and friction
      type(ehl_films_t), intent(out) :: films
      !> Domain error beyond the range; convergence error where none was found or both grids differ by too much
      type(error_t), allocatable, intent(out) :: error

      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: coarse
      integer :: status
      logical :: converged

      call new_ehl_problem(problem, contact, status)
      if (status /= in_range) then
         call raise(error, kind_domain, "ehl: "//trim(range_text(status)))
         return
      end if
      call solve_on_grids(problem, options, grid, state, films, coarse, converged)
      if (.not. converged) then
         call raise(error, kind_convergence, "ehl: no solution found")
         return
      end if
      if (films%difference <= options%largest_difference) return
      call raise(error, kind_convergence, "ehl: film on two grids differs by "//fixed_text(100.0_wp*films%difference, 1)// &
         & " %; more nodes are needed")
   end subroutine solve_contact_film

   !> Solution from nothing on a coarse grid and from it on finer ones, up to the number of nodes of the options.
   pure subroutine solve_on_grids(problem, options, grid, state, films, coarse, converged)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Number of nodes and the like
      type(ehl_options_t), intent(in) :: options
      !> The finest grid
      type(ehl_grid_t), intent(out) :: grid
      !> The solution on it
      type(ehl_state_t), intent(out) :: state
      !> Film and friction of the finest grid and of that with half its nodes
      type(ehl_films_t), intent(out) :: films, coarse
      !> Was it found?
      logical, intent(out) :: converged

      type(ehl_state_t) :: previous
      integer :: nodes, iterations, factorisations

      nodes = (options%nodes + 1)/2
      do while (nodes > smallest_grid .and. mod(nodes, 2) == 1)
         nodes = (nodes + 1)/2
      end do
      iterations = 0
      factorisations = 0
      call solve_on_grid(problem, options, nodes, grid, state, films, converged)
      do while (nodes < options%nodes)
         iterations = iterations + state%iterations
         factorisations = factorisations + state%factorisations
         coarse = films
         nodes = 2*nodes - 1
         if (converged) then
            previous = state
            call make_grid(problem, options, nodes, grid)
            call refine(problem, grid, previous, options%tolerance, state, converged)
            if (converged) call warm_film(problem, grid, state, options%tolerance, converged)
            if (converged) call get_films(problem, grid, state, films)
         end if
         if (.not. converged) call solve_on_grid(problem, options, nodes, grid, state, films, converged)
         if (converged) call compare_grids(coarse, nodes, films)
         if (converged .and. nodes >= judged_grid .and. max(films%error, chance_error/real(nodes, wp)**2) <= options%accuracy) exit
      end do
      films%iterations = iterations + state%iterations
      films%factorisations = factorisations + state%factorisations
   end subroutine solve_on_grids

   !> Solution from that on the grid with half the nodes.
   pure subroutine refine(problem, grid, coarse, tolerance, state, converged)
      type(ehl_problem_t), intent(in) :: problem
      !> The finer grid
      type(ehl_grid_t), intent(in) :: grid
      !> Solution on the grid with half the nodes
      type(ehl_state_t), intent(in) :: coarse
      !> What Newton's method may leave over [-]
      real(wp), intent(in) :: tolerance
      !> The solution
      type(ehl_state_t), intent(out) :: state
      !> Was it found?
      logical, intent(out) :: converged

      call new_ehl_fields(state%fields, grid%size)
      call interpolate(problem, grid, coarse, .true., state)
      call solve_newton(problem, grid, state, tolerance, refining_iterations, converged)
      if (converged) return
      call interpolate(problem, grid, coarse, .false., state)
      call settle(problem, grid, state, tolerance, converged)
   end subroutine refine

   !> Pressure and level from the grid with half the nodes.
   pure subroutine interpolate(problem, grid, coarse, is_cubic, state)
      type(ehl_problem_t), intent(in) :: problem
      !> The finer grid
      type(ehl_grid_t), intent(in) :: grid
      !> Solution on the grid with half the nodes
      type(ehl_state_t), intent(in) :: coarse
      !> By cubics? By straight lines otherwise
      logical, intent(in) :: is_cubic
      !> Total pressure and level
      type(ehl_state_t), intent(inout) :: state

      ! Deformation [-]
      real(wp) :: gap(grid%size)
      integer :: i, n, middle

      n = size(coarse%total)
      if (.not. allocated(state%total)) allocate (state%total(grid%size))
      call refine_column(coarse%total, state%total)
      if (is_cubic) then
         do i = 2, n - 2
            state%total(2*i) = (9.0_wp*(coarse%total(i) + coarse%total(i + 1)) - coarse%total(i - 1) - coarse%total(i + 2))/16.0_wp
         end do
      end if
      state%total = max(state%total, 0.0_wp)
      state%total = state%total*(problem%load/integral(grid, state%total))
      gap = deformation(grid, state%total) + 0.5_wp*grid%x**2
      middle = minloc(abs(grid%x(1::2)), dim=1)
      state%level = coarse%fields%film(middle) - gap(2*middle - 1)
      if (allocated(problem%heat)) then
         call start_heat(grid, state%fields)
         call refine_column(coarse%fields%rise, state%fields%rise)
         call refine_column(coarse%fields%flux(:, 1), state%fields%flux(:, 1))
      end if
      call forget(state)
   end subroutine interpolate

   !> Values between nodes on straight lines.
   pure subroutine refine_column(coarse, fine)
      !> Values at the nodes of the grid with half the nodes [any]
      real(wp), intent(in) :: coarse(:)
      !> Values at the nodes [any]
      real(wp), intent(out) :: fine(:)

      integer :: n

      n = size(coarse)
      fine(1::2) = coarse
      fine(2::2) = 0.5_wp*(coarse(:n - 1) + coarse(2:))
   end subroutine refine_column

   !> Solution from nothing on one grid, and its films.
   pure subroutine solve_on_grid(problem, options, nodes, grid, state, films, converged)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Reach, tolerance and the like
      type(ehl_options_t), intent(in) :: options
      !> Number of nodes
      integer, intent(in) :: nodes
      !> The grid
      type(ehl_grid_t), intent(out) :: grid
      !> The solution
      type(ehl_state_t), intent(out) :: state
      !> Film and friction
      type(ehl_films_t), intent(out) :: films
      !> Was it found?
      logical, intent(out) :: converged

      call make_grid(problem, options, nodes, grid)
      call solve_cold(problem, grid, options%tolerance, state, converged)
      if (converged) call warm_film(problem, grid, state, options%tolerance, converged)
      if (converged) call get_films(problem, grid, state, films)
   end subroutine solve_on_grid

   !> Grid that suits a problem.
   pure subroutine make_grid(problem, options, nodes, grid)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> Reach, or zero
      type(ehl_options_t), intent(in) :: options
      !> Number of nodes
      integer, intent(in) :: nodes
      !> The grid
      type(ehl_grid_t), intent(out) :: grid

      ! Ends of the domain, width of the zones at the edges of the contact, length over which a parabola's gap doubles [half widths]
      real(wp) :: reach(2), edge, parabola

      parabola = sqrt(problem%expected_film)
      reach = max([max(least_inlet, inlet_part*parabola), 1.0_wp + max(0.5_wp, 1.5_wp*parabola)], asperity_reach(problem))
      where (options%reach > 0.0_wp) reach = options%reach
      edge = 0.5_wp*problem%expected_film**(2.0_wp/3.0_wp)
      if (problem%expected_film > 1.0_wp) edge = parabola
      if (options%is_uniform) then
         call new_uniform_grid(grid, nodes, reach(1), reach(2))
      else
         call new_ehl_grid(grid, nodes, reach(1), reach(2), edge)
      end if
   end subroutine make_grid

   !> Solution from nothing.
   pure subroutine solve_cold(problem, grid, tolerance, state, converged)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> What Newton's method may leave over [-]
      real(wp), intent(in) :: tolerance
      !> The solution
      type(ehl_state_t), intent(out) :: state
      !> Was it found?
      logical, intent(out) :: converged

      integer :: attempt
      logical :: is_rigid

      call new_ehl_fields(state%fields, grid%size)
      do attempt = 1, 3
         is_rigid = (problem%expected_film >= elastic_film) .eqv. attempt < 3
         call start_state(problem, grid, is_rigid, state)
         if (attempt == 1) call solve_newton(problem, grid, state, tolerance, cold_iterations, converged)
         if (attempt > 1) call settle(problem, grid, state, tolerance, converged)
         if (converged) return
      end do
   end subroutine solve_cold

   !> Pressure of a dry or of a rigid contact, and the level of the gap that goes with the expected film.
   pure subroutine start_state(problem, grid, is_rigid, state)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Is the pressure that of a rigid contact?
      logical, intent(in) :: is_rigid
      !> Total pressure and level
      type(ehl_state_t), intent(inout) :: state

      ! Angle whose tangent is the position relative to the length of the parabola [rad]
      real(wp) :: angle(grid%size)
      ! Deformation [-]
      real(wp) :: gap(grid%size)

      if (is_rigid) then
         angle = atan(grid%x/sqrt(2.0_wp*problem%expected_film))
         state%total = 0.5_wp*(angle + 0.5_wp*pi) + 0.25_wp*sin(2.0_wp*angle) - (0.375_wp*(angle + 0.5_wp*pi) &
            & + 0.25_wp*sin(2.0_wp*angle) + sin(4.0_wp*angle)/32.0_wp)/cos(rigid_end)**2
         where (angle > rigid_end) state%total = 0.0_wp
         state%total = max(state%total, 0.0_wp)
      else
         state%total = sqrt(max((1.0_wp - grid%x)*(1.0_wp + grid%x), 0.0_wp))
      end if
      state%total(1) = 0.0_wp
      state%total(grid%size) = 0.0_wp
      if (is_rigid) state%total = state%total*(problem%load/integral(grid, state%total))
      gap = deformation(grid, state%total)
      state%level = problem%expected_film - gap(minloc(abs(grid%x), dim=1))
      call forget(state)
   end subroutine start_state

end module camroller_ehl_solution
