!> Temperature along the film of a line contact at a given pressure and film: energy equation of the film, with both surfaces.
!>
!> In: problem with heat, grid, pressure and film. Out: mean rise of the film's temperature across it at each node, rise of both
!> surfaces. Across the film the temperature is a parabola through both surfaces' with the mean rise t, so that the heat flux into
!> them is
!>
!>     q_1 = (k/h) (6 t - 4 t_1 - 2 t_2),   q_2 = (k/h) (6 t - 2 t_1 - 4 t_2)
!>
!> and the heat balance of the film between the middles of two neighbouring cells
!>
!>     rho c u h dt/dx + q_1 + q_2 = tau V_s + (h^3/(12 eta)) (dp/dx)^2 + epsilon T (m/rho) dp/dx
!>
!> that is, what flows off with the oil and into the surfaces is the heat of sliding, of the flow that pressure drives, and of
!> compression. Heat of sliding is the limited force times the sliding speed, and each place has its part of it: a traction that is
!> limited as a whole leaves each place a limit in proportion to the pressure there. The unknown of Newton's method is
!> `q_1 + q_2`; the rise follows from it, and `q_1 - q_2` by a system of its own. Sources: Salehizadeh and Saka, J. Tribology 113
!> (1991) 481, the parabola across the film in a line contact; surfaces: `camroller_ehl_walls`.
module camroller_ehl_energy
   use camroller_kinds, only : wp
   use camroller_conjunction, only : film_part
   use camroller_ehl_films, only : cell_limit, cell_parts, cell_shear, common_multiplier, part_count
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_problem, only : ehl_problem_t, real_area_part
   use camroller_ehl_reynolds, only : evaluate_oil
   use camroller_ehl_walls, only : surface_response
   use camroller_lapack, only : dgemv, dgetrf, dgetrs
   use camroller_traction, only : limit_shear
   implicit none
   private

   public :: ehl_energy_t, heat_made_t, new_energy, solve_energy, find_heat, lowest_rise

   !> What stays while pressure, film and temperature are brought to agree
   type :: ehl_energy_t
      !> Rise of one surface and of the other per flux: sum and difference of both [m^2 K/W]
      real(wp), allocatable :: both(:, :), difference(:, :)
      !> Factors of the derivatives of the heat balance over the flux, as they were when last made; pivots
      real(wp), allocatable :: factors(:, :) ! [W/m per W/m^2]
      integer, allocatable :: pivots(:)
      logical :: has_factors = .false.
   end type ehl_energy_t

   !> Heat made between the nodes
   type :: heat_made_t
      !> Heat over length: sliding, flow driven by pressure, compression [W/m]
      real(wp), allocatable :: sliding(:), driven(:), compression(:)
      !> Derivative of all of it over the rise at both nodes [W/(m K)]
      real(wp), allocatable :: slopes(:, :)
      !> The part of the derivative that a limit of the traction as a whole makes: a cell's part of it [-], derivative of the whole
      !> over the rise at the nodes [W/(m K)]
      real(wp), allocatable :: part(:), by_limit(:)
   end type heat_made_t

   !> Contraction that kept factors must bring [-]; iterations to give up after
   real(wp), parameter :: contraction = 0.2_wp
   integer, parameter :: most_iterations = 100
   !> Part of the way down to absolute zero, or to the pole of the viscosity's law, that a rise may go below zero [-]
   real(wp), parameter :: largest_fall = 0.5_wp

contains

   !> Prepare for a problem: how both surfaces answer to heat.
   pure subroutine new_energy(energy, problem, grid)
      !> What stays
      type(ehl_energy_t), intent(out) :: energy
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid

      ! Rise of the second surface per flux [m^2 K/W]
      real(wp), allocatable :: second(:, :)

      associate (heat => problem%heat)
         energy%both = surface_response(grid, heat%bodies(1), heat%speeds(1), problem%length_scale)
         second = surface_response(grid, heat%bodies(2), heat%speeds(2), problem%length_scale)
      end associate
      energy%difference = energy%both - second
      energy%both = energy%both + second
      allocate (energy%factors(grid%size, grid%size), energy%pivots(grid%size))
   end subroutine new_energy

   !> Rise of film and surfaces at the pressure and the film of a state.
   pure subroutine solve_energy(problem, grid, energy, state, tolerance, converged)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> What stays; its factors may be made anew
      type(ehl_energy_t), intent(inout) :: energy
      !> In: pressure, film, and a start of the flux; out: rises, flux, viscosity there
      type(ehl_state_t), intent(inout) :: state
      !> Change of ln(viscosity) that may be left [-]
      real(wp), intent(in) :: tolerance
      !> Was it reached?
      logical, intent(out) :: converged

      type(heat_made_t) :: made
      ! Thickness over conductivity of the film [m^2 K/W]; flow of heat capacity between the nodes [W/(m K)]; heat of boundary
      ! friction [W/m^2]
      real(wp) :: resistance(grid%size), capacity(grid%size - 1), boundary(grid%size)
      ! Coefficients of the rise at the nodes i - 2 to i + 2 in the heat balance of node i, without and with that of heat [W/(m K)]
      real(wp) :: carried(-2:2, grid%size), rows(-2:2, grid%size)
      ! What a heat balance lacks [W/m]; rises before [K]; change of ln(viscosity), that before [-]
      real(wp) :: lack(grid%size), old(grid%size), change, before
      ! Factors of the system for the difference of the fluxes; pivots
      real(wp) :: factors(grid%size, grid%size) ! [m^2 K/W]
      integer :: pivots(grid%size), iteration, info

      converged = .false.
      associate (fields => state%fields, n => grid%size)
         resistance = max(fields%gap, 0.0_wp)*problem%film_scale/problem%heat%conductivity
         capacity = carried_capacity(problem, grid, state)
         boundary = boundary_heat(problem, grid, state)
         carried = carried_heat(grid, capacity)
         call factorise_difference(energy, resistance, factors, pivots, info)
         if (info /= 0) return
         before = huge(1.0_wp)
         do iteration = 1, most_iterations
            old = fields%rise
            call find_rises(problem, energy, resistance, boundary, factors, pivots, fields%flux, fields%rise, fields%surface_rise)
            call evaluate_oil(problem, grid, state%total, fields)
            change = maxval(abs(fields%by_rise*(fields%rise - old)))
            if (iteration > 1 .and. change <= tolerance) exit
            call find_heat(problem, grid, state, made)
            lack = heat_lack(problem, grid, carried, made, fields%rise, fields%flux(:, 1))
            if (iteration > 1 .and. change > contraction*before) energy%has_factors = .false.
            before = change
            if (.not. energy%has_factors) then
               rows = carried
               call subtract_heat(made, rows)
               call factorise_balance(problem, grid, energy, rows, made, resistance, info)
               energy%has_factors = info == 0
               if (info /= 0) return
            end if
            call dgetrs("N", n, 1, energy%factors, n, energy%pivots, lack, n, info)
            if (.not. all(abs(lack) < huge(1.0_wp))) return
            fields%flux(:, 1) = fields%flux(:, 1) - lack
         end do
         converged = iteration <= most_iterations
      end associate
   end subroutine solve_energy

   !> Flow of heat capacity from node to node: that of the full film, which goes on behind its end.
   pure function carried_capacity(problem, grid, state) result(capacity)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Flow and full nodes
      type(ehl_state_t), intent(in) :: state
      !> The flow over length [W/(m K)]
      real(wp) :: capacity(grid%size - 1)

      integer :: i

      capacity = state%fields%flow
      do i = 2, grid%size - 1
         if (.not. state%is_full(i)) capacity(i) = capacity(i - 1)
      end do
      capacity = capacity*problem%heat%capacity*problem%entrainment_speed*problem%film_scale
   end function carried_capacity

   !> Heat of boundary friction over area: that of touching asperities, which enters both surfaces in equal parts.
   pure function boundary_heat(problem, grid, state) result(heat)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Film and pressure of the asperities
      type(ehl_state_t), intent(in) :: state
      !> The heat [W/m^2]
      real(wp) :: heat(grid%size)

      heat = abs(problem%sliding_speed)*(problem%heat%boundary_coefficient*problem%pressure_scale*state%fields%asperity &
         & + problem%heat%boundary_stress*real_area_part(problem, state%fields%film))
   end function boundary_heat

   !> Coefficients of the rise in what the oil carries off from a node: upstream differences of second order.
   !>
   !> Where the flow changes from cell to cell, as while the film changes, oil leaves the rest behind at the temperature there.
   pure function carried_heat(grid, capacity) result(rows)
      type(ehl_grid_t), intent(in) :: grid
      !> Flow of heat capacity between the nodes [W/(m K)]
      real(wp), intent(in) :: capacity(:)
      !> Coefficients of the rise at the nodes i - 2 to i + 2 in the balance of node i [W/(m K)]
      real(wp) :: rows(-2:2, grid%size)

      ! Weights of the nodes i - 1 to i + 2 at the middle of the cell between i and i + 1 [-]
      real(wp) :: weights(-1:2)
      integer :: i, n

      n = grid%size
      rows = 0.0_wp
      do i = 1, n - 1
         weights = 0.0_wp
         if (capacity(i) >= 0.0_wp) then
            weights(0) = 1.0_wp
            if (i > 1) weights(-1:0) = weights(-1:0) + [-0.5_wp, 0.5_wp]*grid%step(i)/grid%step(i - 1)
         else
            weights(1) = 1.0_wp
            if (i < n - 1) weights(1:2) = weights(1:2) + [0.5_wp, -0.5_wp]*grid%step(i)/grid%step(i + 1)
         end if
         rows(-1:2, i) = rows(-1:2, i) + capacity(i)*weights
         rows(0, i) = rows(0, i) - capacity(i)
         rows(-2:1, i + 1) = rows(-2:1, i + 1) - capacity(i)*weights
         rows(0, i + 1) = rows(0, i + 1) + capacity(i)
      end do
   end function carried_heat

   !> Factors for the difference of the fluxes into both surfaces: `(h/k + R_1 + R_2) (q_1 - q_2) = -(R_1 - R_2) (q_1 + q_2)`.
   pure subroutine factorise_difference(energy, resistance, factors, pivots, info)
      !> How both surfaces answer to heat
      type(ehl_energy_t), intent(in) :: energy
      !> Thickness over conductivity of the film [m^2 K/W]
      real(wp), intent(in) :: resistance(:)
      !> The factors, pivots; zero where there are some
      real(wp), intent(out) :: factors(:, :) ! [m^2 K/W]
      integer, intent(out) :: pivots(:), info

      integer :: i, n

      n = size(resistance)
      factors = energy%both
      do i = 1, n
         factors(i, i) = factors(i, i) + resistance(i)
      end do
      call dgetrf(n, n, factors, n, pivots, info)
   end subroutine factorise_difference

   !> Rises from the sum of the fluxes into both surfaces.
   pure subroutine find_rises(problem, energy, resistance, boundary, factors, pivots, flux, rise, surfaces)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> How both surfaces answer to heat
      type(ehl_energy_t), intent(in) :: energy
      !> Thickness over conductivity of the film [m^2 K/W]; heat of boundary friction [W/m^2]
      real(wp), intent(in) :: resistance(:), boundary(:)
      !> For the difference of the fluxes
      real(wp), intent(in) :: factors(:, :) ! [m^2 K/W]
      integer, intent(in) :: pivots(:)
      !> Sum and difference of the fluxes; the latter is set [W/m^2]
      real(wp), intent(inout) :: flux(:, :)
      !> Mean rise across the film, and of both surfaces [K]
      real(wp), intent(out) :: rise(:), surfaces(:, :)

      ! Heat into both surfaces [W/m^2]; sum and difference of their rises [K]
      real(wp) :: into(size(rise)), both(size(rise)), apart(size(rise))
      integer :: n, info

      n = size(rise)
      into = flux(:, 1) + boundary
      call dgemv("N", n, n, -1.0_wp, energy%difference, n, into, 1, 0.0_wp, flux(:, 2), 1)
      call dgetrs("N", n, 1, factors, n, pivots, flux(:, 2), n, info)
      call dgemv("N", n, n, 0.5_wp, energy%both, n, into, 1, 0.0_wp, both, 1)
      call dgemv("N", n, n, 0.5_wp, energy%difference, n, flux(:, 2), 1, 1.0_wp, both, 1)
      call dgemv("N", n, n, 0.5_wp, energy%difference, n, into, 1, 0.0_wp, apart, 1)
      call dgemv("N", n, n, 0.5_wp, energy%both, n, flux(:, 2), 1, 1.0_wp, apart, 1)
      surfaces(:, 1) = 0.5_wp*(both + apart)
      surfaces(:, 2) = 0.5_wp*(both - apart)
      rise = max(film_part*resistance*flux(:, 1) + 0.5_wp*both, lowest_rise(problem))
   end subroutine find_rises

   !> Lowest rise on the way to a solution: no lower than laws of the viscosity can be asked for.
   pure function lowest_rise(problem) result(rise)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> It, below zero [K]
      real(wp) :: rise

      rise = -largest_fall/max(problem%heat%hot%bend, 1.0_wp/problem%heat%temperature)
   end function lowest_rise

   !> Heat made between the nodes at the viscosity there.
   pure subroutine find_heat(problem, grid, state, made)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure, film, viscosity
      type(ehl_state_t), intent(in) :: state
      !> The heat
      type(heat_made_t), intent(out) :: made

      ! Shear between the nodes and its derivatives, part of the surface on which asperities touch [-]
      real(wp) :: shear(grid%size - 1), slopes(2, grid%size - 1), touching(grid%size)
      ! Force over the dimensionless shear [N/m]; heat over length of a dimensionless flow and pressure [W/m]; work of the pressure
      ! on the flow in a cell, over its volume, and its derivative over the temperature [W/m], [W/(m K)]
      real(wp) :: unit, scale, work(grid%size - 1)
      integer :: n

      n = grid%size
      allocate (made%slopes(2, n - 1), made%by_limit(n), source=0.0_wp)
      allocate (made%sliding(n - 1), made%part(n - 1), source=0.0_wp)
      associate (fields => state%fields, heat => problem%heat, speed => abs(problem%sliding_speed))
         scale = problem%entrainment_speed*problem%film_scale*problem%pressure_scale
         work = scale*(fields%pressure(2:) - fields%pressure(:n - 1))/(0.5_wp*(fields%density(2:) + fields%density(:n - 1)))
         made%driven = -fields%driven*work
         work = merge(heat%expansion, 0.0_wp, problem%is_compressible)*fields%flow*work
         made%compression = work*(heat%temperature + 0.5_wp*(fields%rise(:n - 1) + fields%rise(2:)))
         made%slopes(1, :) = 0.5_wp*work
         made%slopes(2, :) = 0.5_wp*work
         if (speed <= 0.0_wp) return
         touching = real_area_part(problem, fields%film)
         call cell_shear(grid, state, shear, slopes)
         shear = shear*(1.0_wp - 0.5_wp*(touching(:n - 1) + touching(2:)))
         slopes = slopes*spread(1.0_wp - 0.5_wp*(touching(:n - 1) + touching(2:)), 1, 2)
         slopes(1, :) = -slopes(1, :)*fields%by_rise(:n - 1)
         slopes(2, :) = -slopes(2, :)*fields%by_rise(2:)
         unit = speed*problem%oil%viscosity*problem%length_scale/problem%film_scale
         if (sum(shear) > 0.0_wp) call limit_heat(problem, grid, state, touching, unit*shear, unit*slopes, made)
      end associate
   end subroutine find_heat

   !> Heat of sliding where traction is limited: each part of the film has its own limit. Where the traction as a whole is limited,
   !> these limits are multiplied by what makes the parts' shear add up to it.
   pure subroutine limit_heat(problem, grid, state, touching, free, slopes, made)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure, film, viscosity
      type(ehl_state_t), intent(in) :: state
      !> Part of the surface on which asperities touch [-]; shear of the cells over length [N/m] and its derivatives over the
      !> temperatures on both sides [N/(m K)], without the limit
      real(wp), intent(in) :: touching(:), free(:), slopes(:, :)
      !> Gets the heat of sliding and its derivatives
      type(heat_made_t), intent(inout) :: made

      ! Parts of the cells: free shear over length [N/m], area over length [m], pressure on it [N/m]; their limits [N/m]
      real(wp) :: parts(3, part_count, size(free)), limits(part_count, size(free))
      ! Of the parts of a cell: limited shear over length [N/m], its derivatives over the free one and over the limit [-]
      real(wp), dimension(part_count) :: shear, by_free, by_limit
      ! What the fall of the limits makes of a cell's shear at either side [N/(m K)]; derivatives of a cell's shear [N/(m K)]
      real(wp) :: fall, own(2)
      ! Force of all shear over length [N/m] and its derivatives over the rise at the nodes, less those of the cells [N/(m K)]
      real(wp) :: force, by_rise(grid%size)
      integer :: i

      call cell_parts(problem, grid, state, touching, free, parts)
      by_rise = 0.0_wp
      associate (heat => problem%heat, speed => abs(problem%sliding_speed))
         limits = max(cell_limit(parts(2, :, :), parts(3, :, :), heat%limiting_coefficient, heat%limiting_stress), tiny(1.0_wp))
         if (.not. heat%has_local_limit) then
            call limit_whole(problem, grid, state, free, slopes, force, by_rise)
            limits = limits*common_multiplier(heat%cap, parts(1, :, :), limits, force)
         end if
         do i = 1, size(free)
            if (.not. free(i) > 0.0_wp) cycle
            shear = parts(1, :, i)
            call limit_shear(heat%cap, limits(:, i), shear, by_free, by_limit)
            made%sliding(i) = speed*sum(shear)
            made%part(i) = max(sum(by_limit*limits(:, i)), 0.0_wp)
            fall = -0.5_wp*made%part(i)*heat%limit_fall
            ! Each part of the cell takes the same part of a change of its free shear
            own = sum(by_free*parts(1, :, i))/free(i)*slopes(:, i) + fall
            made%slopes(:, i) = made%slopes(:, i) + speed*own
            by_rise(i:i + 1) = by_rise(i:i + 1) - own
         end do
         if (heat%has_local_limit) return
         ! What the whole changes by more than the cells do, their limits take in proportion to what they answer to the multiplier
         made%part = made%part/max(sum(made%part), tiny(1.0_wp))
         made%by_limit = speed*by_rise
      end associate
   end subroutine limit_heat

   !> Force of a film whose traction is limited as a whole.
   pure subroutine limit_whole(problem, grid, state, free, slopes, force, by_rise)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure and temperature
      type(ehl_state_t), intent(in) :: state
      !> Shear of the cells over length [N/m] and its derivatives over the temperatures on both sides [N/(m K)], without the limit
      real(wp), intent(in) :: free(:), slopes(:, :)
      !> The force over length [N/m], its derivatives over the rise at the nodes [N/(m K)]
      real(wp), intent(out) :: force, by_rise(:)

      ! Pressure at a node with the share of its cell and the fall of the limit [N/m]
      real(wp) :: pressed(grid%size)
      ! Derivatives of the force over that without a limit and over the limit [-]
      real(wp) :: by_force, by_limit

      associate (heat => problem%heat, n => grid%size)
         pressed = problem%length_scale*problem%pressure_scale*grid%weight*state%total*exp(-heat%limit_fall*state%fields%rise)
         force = sum(free)
         call limit_shear(heat%cap, heat%limiting_coefficient*sum(pressed), force, by_force, by_limit)
         by_rise = -by_limit*heat%limiting_coefficient*heat%limit_fall*pressed
         by_rise(:n - 1) = by_rise(:n - 1) + by_force*slopes(1, :)
         by_rise(2:) = by_rise(2:) + by_force*slopes(2, :)
      end associate
   end subroutine limit_whole

   !> Part of a cell's heat that goes to the node before it; the rest goes to the one behind. The first node is as warm as the oil
   !> around.
   pure function share_before(i) result(part)
      !> Number of the cell
      integer, intent(in) :: i
      !> The part [-]
      real(wp) :: part

      part = merge(0.0_wp, 0.5_wp, i == 1)
   end function share_before

   !> What the heat balances lack: what leaves less what is made; the first node has none but its temperature.
   pure function heat_lack(problem, grid, carried, made, rise, flux) result(lack)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Coefficients of the rise in what the oil carries off [W/(m K)]
      real(wp), intent(in) :: carried(-2:, :)
      !> Heat made between the nodes
      type(heat_made_t), intent(in) :: made
      !> Mean rise across the film [K], heat flux into both surfaces [W/m^2]
      real(wp), intent(in) :: rise(:), flux(:)
      !> What is lacking [W/m], the first node's rise [K]
      real(wp) :: lack(grid%size)

      ! Heat made in a cell [W/m]
      real(wp) :: heat
      integer :: i, k, n

      n = grid%size
      lack = problem%length_scale*grid%weight*flux
      do i = 2, n
         do k = max(-2, 1 - i), min(2, n - i)
            lack(i) = lack(i) + carried(k, i)*rise(i + k)
         end do
      end do
      do i = 1, n - 1
         heat = made%sliding(i) + made%driven(i) + made%compression(i)
         lack(i) = lack(i) - share_before(i)*heat
         lack(i + 1) = lack(i + 1) - (1.0_wp - share_before(i))*heat
      end do
      lack(1) = rise(1)
   end function heat_lack

   !> Take the derivatives of the heat made from those of the balance.
   pure subroutine subtract_heat(made, rows)
      !> Heat made between the nodes
      type(heat_made_t), intent(in) :: made
      !> Coefficients of the rise at the nodes i - 2 to i + 2 in the balance of node i [W/(m K)]
      real(wp), intent(inout) :: rows(-2:, :)

      integer :: i

      do i = 1, size(made%sliding)
         rows(0:1, i) = rows(0:1, i) - share_before(i)*made%slopes(:, i)
         rows(-1:0, i + 1) = rows(-1:0, i + 1) - (1.0_wp - share_before(i))*made%slopes(:, i)
      end do
   end subroutine subtract_heat

   !> Factors of the derivatives of the heat balances over the sum of the fluxes, their difference being held.
   pure subroutine factorise_balance(problem, grid, energy, rows, made, resistance, info)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> Gets the factors
      type(ehl_energy_t), intent(inout) :: energy
      !> Coefficients of the rise at the nodes i - 2 to i + 2 in the balance of node i [W/(m K)]
      real(wp), intent(in) :: rows(-2:, :)
      !> Heat made between the nodes
      type(heat_made_t), intent(in) :: made
      !> Thickness over conductivity of the film [m^2 K/W]
      real(wp), intent(in) :: resistance(:)
      !> Zero where there are factors
      integer, intent(out) :: info

      ! Derivative of the rise at the nodes over one flux [m^2 K/W]; what the limit makes of it [W/m per W/m^2]
      real(wp) :: by_flux(-1:grid%size + 2), whole
      integer :: i, j, n

      n = grid%size
      by_flux = 0.0_wp
      do j = 1, n
         by_flux(1:n) = 0.25_wp*energy%both(:, j)
         by_flux(j) = by_flux(j) + film_part*resistance(j)
         whole = dot_product(made%by_limit, by_flux(1:n))
         energy%factors(1, j) = by_flux(1)
         do i = 2, n
            energy%factors(i, j) = dot_product(rows(:, i), by_flux(i - 2:i + 2))
         end do
         energy%factors(j, j) = energy%factors(j, j) + merge(0.0_wp, problem%length_scale*grid%weight(j), j == 1)
         do i = 1, n - 1
            if (i > 1) energy%factors(i, j) = energy%factors(i, j) - share_before(i)*made%part(i)*whole
            energy%factors(i + 1, j) = energy%factors(i + 1, j) - (1.0_wp - share_before(i))*made%part(i)*whole
         end do
      end do
      call dgetrf(n, n, energy%factors, n, energy%pivots, info)
   end subroutine factorise_balance

end module camroller_ehl_energy
