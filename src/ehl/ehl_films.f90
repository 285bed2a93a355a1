!> Results of a solution of a line contact: films, friction, errors of the conserved quantities.
!>
!> In: problem, grid, solution. Out: `ehl_films_t`, in SI units.
module camroller_ehl_films
   use camroller_kinds, only : wp, pi
   use camroller_ehl_grid, only : ehl_grid_t, integral
   use camroller_ehl_problem, only : ehl_problem_t, real_area_part
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_reynolds, only : mean_fluidity
   use camroller_local_limit, only : least_limit
   use camroller_roots, only : bracket_t, narrow_bracket, root_found, root_wanted, start_bracket
   use camroller_traction, only : limit_shear
   implicit none
   private

   public :: ehl_films_t, cell_limit, cell_parts, cell_shear, common_multiplier, limit_cells, get_films, compare_grids, chance_error

   !> Film and friction of a solution
   type :: ehl_films_t
      !> Film at the middle of the dry contact, smallest film [m]
      real(wp) :: central = 0.0_wp, minimum = 0.0_wp
      !> Estimated relative error of both, and what they differ by on a grid with half the nodes; zero: no other grid [-]
      real(wp) :: error = 0.0_wp, difference = 0.0_wp
      !> Place of the highest pressure, where the film ends [m]
      real(wp) :: peak_place = 0.0_wp, end_place = 0.0_wp
      !> Highest pressure [Pa]
      real(wp) :: peak = 0.0_wp
      !> Second moment of the pressure over that of the dry contact [-]
      real(wp) :: second_moment = 0.0_wp
      !> Part of the load that asperities carry [-]
      real(wp) :: asperity_share = 0.0_wp
      !> Area on which asperities touch, over length [m]
      real(wp) :: real_area = 0.0_wp
      !> Rolling resistance of a surface over length, `int h/2 dp/dx dx` [N/m]
      real(wp) :: rolling = 0.0_wp
      !> Shear of a full film over length and sliding speed, `int eta/h dx` where no asperities touch [Pa s/m]
      real(wp) :: shear_slope = 0.0_wp
      !> Parts of the film, where the problem keeps them, shape (3, part): shear over length and sliding speed [Pa s/m]; area over
      !> length, without asperities [m], and pressure on it [N/m], both times the limiting stress over that of the oil around
      real(wp), allocatable :: cells(:, :)
      !> Mean of the limiting traction coefficient over that of the oil around: by the temperature, weighed with the pressure [-]
      real(wp) :: limit_part = 1.0_wp
      !> Rise of the surfaces' temperature where asperities touch: mean of both, weighed with the pressure of the asperities [K]
      real(wp) :: asperity_rise = 0.0_wp
      !> Mass flow over density and speed, equal everywhere in the full film [m]
      real(wp) :: flow = 0.0_wp
      !> What load and flow lack, relative [-]
      real(wp) :: load_lack = 0.0_wp, flow_lack = 0.0_wp
      !> Nodes of the grid, where it was compared with another one
      integer :: nodes = 0
      !> Iterations and factorisations
      integer :: iterations = 0, factorisations = 0
   end type ehl_films_t

   !> Error of a film times the square of the number of nodes, below which half of the contacts of the range of solutions
   !> are: 3.2 to 3.4 at 65 to 513 nodes [-]
   real(wp), parameter :: usual_error = 4.0_wp
   !> The same below which nearly all are whose grids agree by chance, so that no less should be stated of many contacts: of 40 320
   !> contacts 142 on 65 nodes and three on 129 are off by more than this and than what is stated, instead of 493 and 134 [-]
   real(wp), parameter :: chance_error = 16.0_wp
   !> Logarithm of viscosity over film at which it is held: far above any shear that a limiting traction lets through, below
   !> overflow [-]
   real(wp), parameter :: largest_exponent = 600.0_wp
   !> Second difference of that logarithm from which on it is a jump that the nodes do not resolve, as behind a spike, and not
   !> the bend of a curve [-]
   real(wp), parameter :: largest_bend = 4.0_wp
   !> Parts of a cell whose shear is limited one by one
   integer, parameter, public :: part_count = 8

contains

   !> State the error of a film by what it differs by on a grid with half the nodes.
   !>
   !> The error is of second order, with a factor that depends on where between two nodes the film ends and is smallest. So two
   !> grids may agree by chance, and a third of what they differ by is not enough: all of it is stated, which holds unless the
   !> factor of the coarser grid is less than half that of the finer; but no less than a quarter of what is stated of
   !> the coarser grid, nor than what half of all contacts are off.
   pure subroutine compare_grids(coarse, nodes, films)
      !> Films of the grid with half the nodes, with their error where there is a coarser one still; none: without central film
      type(ehl_films_t), intent(in) :: coarse
      !> Nodes of the finer grid
      integer, intent(in) :: nodes
      !> Films of the finer grid; their error is set, to one where there is nothing to compare with
      type(ehl_films_t), intent(inout) :: films

      films%nodes = nodes
      films%difference = 1.0_wp
      if (coarse%central > 0.0_wp .and. coarse%minimum > 0.0_wp) films%difference = &
         & max(abs(films%central/coarse%central - 1.0_wp), abs(films%minimum/coarse%minimum - 1.0_wp))
      films%error = max(films%difference, usual_error/real(nodes, wp)**2)
      if (coarse%error < 1.0_wp) films%error = max(films%error, 0.25_wp*coarse%error)
   end subroutine compare_grids

   !> Film and friction of a solution on one grid.
   pure subroutine get_films(problem, grid, state, films)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> Film and friction
      type(ehl_films_t), intent(out) :: films

      ! Position [half widths] and value at the vertex of a parabola
      real(wp) :: place, value
      ! Flow into the contact [-]
      real(wp) :: flow
      integer :: i, last

      associate (fields => state%fields, x => grid%x, n => grid%size)
         i = min(max(minloc(abs(x), dim=1), 2), n - 1)
         films%central = problem%film_scale*parabola_value(x(i - 1:i + 1), fields%film(i - 1:i + 1), 0.0_wp)
         i = min(max(minloc(fields%film, dim=1), 2), n - 1)
         ! By the logarithm, so that a dip narrower than the nodes has a film above zero still
         call vertex(x(i - 1:i + 1), log(fields%film(i - 1:i + 1)), place, value)
         films%minimum = problem%film_scale*exp(value)
         i = min(max(maxloc(state%total, dim=1), 2), n - 1)
         films%peak = problem%pressure_scale*state%total(i)
         films%peak_place = problem%length_scale*x(i)
         do last = n - 1, 2, -1
            if (fields%pressure(last) > 0.0_wp .and. state%is_full(last)) exit
         end do
         films%end_place = problem%length_scale*x(last)
         films%second_moment = integral(grid, state%total*x**2)*8.0_wp/pi
         films%asperity_share = integral(grid, fields%asperity)/problem%load
         films%load_lack = abs(integral(grid, state%total)/problem%load - 1.0_wp)
         flow = fields%flow(last - 1)
         films%flow = problem%film_scale*flow
         films%flow_lack = maxval(abs(fields%flow(:last - 1)/flow - 1.0_wp))
         if (allocated(fields%rise)) then
            films%limit_part = integral(grid, state%total*exp(-problem%heat%limit_fall*fields%rise))/integral(grid, state%total)
            if (films%asperity_share > 0.0_wp) films%asperity_rise = integral(grid, fields%asperity &
               & *0.5_wp*sum(fields%surface_rise, 2))/(films%asperity_share*problem%load)
         end if
      end associate
      call get_friction(problem, grid, state, films)
      films%iterations = state%iterations
      films%factorisations = state%factorisations
   end subroutine get_films

   !> Shear of the film on a surface, from rolling and from sliding.
   !>
   !> Before the first node the gap is nearly that of the parabola and the pressure gradient `12 eta0 u/h^2`, which adds
   !> `12 eta0 u R/x` to the rolling resistance.
   pure subroutine get_friction(problem, grid, state, films)
      type(ehl_problem_t), intent(in) :: problem
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> Film and friction
      type(ehl_films_t), intent(inout) :: films

      ! Integrals of viscosity over film between the nodes, derivatives that are not used [-]
      real(wp) :: shear(grid%size - 1), slopes(2, grid%size - 1)
      ! Part of the surface on which asperities touch [-]
      real(wp) :: touching(grid%size)
      ! Parts of the cells, as `cell_parts` has them [Pa s/m], [m], [N/m]
      real(wp), allocatable :: parts(:, :, :)

      associate (fields => state%fields, n => grid%size)
         films%rolling = 0.5_wp*rolling_integral(grid, state) + problem%speed/abs(grid%x(1))
         films%rolling = films%rolling*problem%pressure_scale*problem%film_scale
         touching = real_area_part(problem, fields%film)
         films%real_area = problem%length_scale*integral(grid, touching)
         call cell_shear(grid, state, shear, slopes)
         shear = shear*(1.0_wp - 0.5_wp*(touching(:n - 1) + touching(2:)))
         films%shear_slope = sum(shear)
      end associate
      films%shear_slope = films%shear_slope*problem%oil%viscosity*problem%length_scale/problem%film_scale
      if (.not. problem%keeps_cells) return
      allocate (parts(3, part_count, size(shear)))
      call cell_parts(problem, grid, state, touching, shear*problem%oil%viscosity*problem%length_scale/problem%film_scale, parts)
      films%cells = reshape(parts, [3, size(shear)*part_count])
   end subroutine get_friction

   !> Parts of the cells, each of which has a limit of its own: shear, area on which the film is full and no asperities touch, and
   !> pressure on it, all over length; the last two weighed with the fall of a limiting stress by the temperature.
   !>
   !> Within a cell the logarithm of viscosity over film and the pressure are straight lines. In cold oil the first changes by
   !> decades from a node to the next: limited as a whole a cell would have the limit of its mean pressure, and all of it.
   pure subroutine cell_parts(problem, grid, state, touching, shear, parts)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> Part of the surface on which asperities touch [-]; shear of each cell, whose parts get what is theirs of it [any]
      real(wp), intent(in) :: touching(:), shear(:)
      !> Shear [as given], area over length [m], pressure times that [N/m], shape (3, part, cell)
      real(wp), intent(out) :: parts(:, :, :)

      ! Part of a node's cell with a full film [-]; logarithm of film over viscosity at the ends of the parts [-]
      real(wp) :: filled(grid%size), ends(0:part_count)
      ! Area of a part over length [m]; its middle, as a part of the cell [-]; slopes that are not used [-]
      real(wp) :: area, middle, slopes(2)
      integer :: i, k

      filled = filled_part(grid, state)
      associate (fields => state%fields)
         do i = 1, grid%size - 1
            ends = fluidity_at(state, i) + (fluidity_at(state, i + 1) - fluidity_at(state, i)) &
               & *[(real(k, wp)/part_count, k=0, part_count)]
            area = problem%length_scale*grid%step(i)*0.5_wp*(filled(i) + filled(i + 1)) &
               & *(1.0_wp - 0.5_wp*(touching(i) + touching(i + 1)))/part_count
            if (allocated(fields%rise)) area = area*exp(-0.5_wp*problem%heat%limit_fall*(fields%rise(i) + fields%rise(i + 1)))
            do k = 1, part_count
               middle = (k - 0.5_wp)/part_count
               call mean_fluidity(ends(k - 1), ends(k), parts(1, k, i), slopes)
               parts(2, k, i) = area
               parts(3, k, i) = area*problem%pressure_scale*(fields%pressure(i) + (fields%pressure(i + 1) - fields%pressure(i)) &
                  & *middle)
            end do
            parts(1, :, i) = shear(i)*(parts(1, :, i)/sum(parts(1, :, i)))
         end do
      end associate
   end subroutine cell_parts

   !> Logarithm of film over viscosity at a node.
   elemental function fluidity_at(state, node) result(fluidity)
      !> The solution
      type(ehl_state_t), intent(in) :: state
      integer, intent(in) :: node
      !> The logarithm [-]
      real(wp) :: fluidity

      fluidity = max(log(state%fields%film(node)) - state%fields%log_viscosity(node), -largest_exponent)
   end function fluidity_at

   !> Shear of a film whose stress is limited in each part, over length, and its slope over the sliding speed.
   pure subroutine limit_cells(cells, cap, coefficient, stress, sliding_speed, shear, slope)
      !> The parts, as `ehl_films_t` has them [Pa s/m], [m], [N/m]
      real(wp), intent(in) :: cells(:, :)
      !> Position in `cap_names`
      integer, intent(in) :: cap
      !> Rise of the limiting stress with the pressure [-], what it is without [Pa]; sliding speed [m/s]
      real(wp), intent(in) :: coefficient, stress, sliding_speed
      !> Shear [N/m], slope [Pa s/m]
      real(wp), intent(out) :: shear, slope

      ! Shear of a part [N/m], its derivatives over the free one and over the limit [-]
      real(wp) :: one, by_free, by_limit
      integer :: i

      shear = 0.0_wp
      slope = 0.0_wp
      do i = 1, size(cells, 2)
         if (.not. cells(2, i) > 0.0_wp) cycle
         one = cells(1, i)*sliding_speed
         call limit_shear(cap, cell_limit(cells(2, i), cells(3, i), coefficient, stress), one, by_free, by_limit)
         shear = shear + one
         slope = slope + by_free*cells(1, i)
      end do
   end subroutine limit_cells

   !> What the limits of all parts are to be multiplied by for their shear to add up to a force: one or more, where the force is
   !> that of all shear under the sum of the limits.
   pure function common_multiplier(cap, free, limits, force) result(multiplier)
      !> Position in `cap_names`
      integer, intent(in) :: cap
      !> Shear of the parts without limits, and positive limits [N/m]; the force, above zero and no more than the sum of the former
      !> [N/m]
      real(wp), intent(in) :: free(:, :), limits(:, :), force
      !> The multiplier [-]
      real(wp) :: multiplier

      ! Beyond the largest ratio of shear to limit by this, no limit is felt to 3e-11; multiplier at least, as sums over cells and
      ! over nodes are not the same; error of its logarithm [-]
      real(wp), parameter :: ample = 1.0e5_wp, least = 0.5_wp, tolerance = 1.0e-12_wp
      ! Ends of the bracket of the logarithm [-], what the forces there exceed that wanted by [N/m]
      real(wp) :: ends(2), excess(2)
      type(bracket_t) :: bracket

      ends = log([least, max(1.0_wp, maxval(free/limits))*ample])
      excess = [excess_at(ends(1)), excess_at(ends(2))]
      multiplier = exp(ends(merge(1, 2, excess(1) >= 0.0_wp)))
      call start_bracket(bracket, ends(1), ends(2), excess(1), excess(2), tolerance)
      do while (bracket%status == root_wanted)
         call narrow_bracket(bracket, excess_at(bracket%trial))
      end do
      if (bracket%status == root_found) multiplier = exp(bracket%trial)

   contains

      !> What the force exceeds that wanted by.
      pure function excess_at(logarithm) result(value)
         !> Logarithm of the multiplier [-]
         real(wp), intent(in) :: logarithm
         !> The excess [N/m]
         real(wp) :: value

         ! Shear of the parts [N/m], its slopes that are not used [-]
         real(wp), dimension(size(free, 1), size(free, 2)) :: shear, by_free, by_limit

         shear = free
         call limit_shear(cap, limits*exp(logarithm), shear, by_free, by_limit)
         value = sum(shear) - force
      end function excess_at

   end function common_multiplier

   !> Limit of the shear of a part of the film over length.
   elemental function cell_limit(area, pressed, coefficient, stress) result(limit)
      !> Area over length [m], pressure on it [N/m], both with the fall by temperature; rise of the limiting stress with the
      !> pressure [-], what it is without [Pa]
      real(wp), intent(in) :: area, pressed, coefficient, stress
      !> The limit [N/m]
      real(wp) :: limit

      limit = max(stress*area + coefficient*pressed, least_limit*area)
   end function cell_limit

   !> Integral of the film over the film's pressure.
   !>
   !> Where oil is drawn in, the film between two nodes is a quadratic, and the pressure's slope grows exponentially; beyond, both
   !> are straight lines, which a spike between two nodes does not disturb.
   pure function rolling_integral(grid, state) result(rolling)
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> The integral [-]
      real(wp) :: rolling

      ! Mean slopes of the pressure between nodes; slopes at both nodes of a cell [1/half widths]
      real(wp) :: slope(grid%size - 1), ends(2)
      ! Film in the middle between two nodes [-]
      real(wp) :: middle
      integer :: i

      associate (film => state%fields%film, pressure => state%fields%pressure, n => grid%size)
         slope = (pressure(2:) - pressure(:n - 1))/grid%step
         rolling = 0.0_wp
         do i = 2, n - 2
            rolling = rolling + 0.5_wp*(film(i) + film(i + 1))*(pressure(i + 1) - pressure(i))
            if (grid%x(i) >= 0.0_wp) cycle
            middle = dot_product(grid%face(:, i), film(i - 1:i + 1))
            ends(1) = slope_between(slope(i - 1:i), grid%step(i - 1:i))
            ends(2) = slope_between(slope(i:i + 1), grid%step(i:i + 1))
            if (minval(ends*slope(i)) <= 0.0_wp) cycle
            rolling = rolling + ((film(i + 1) - film(i))*(mean_place(log(ends(2)/ends(1))) - 0.5_wp) &
               & + (2.0_wp*middle - film(i) - film(i + 1))/3.0_wp)*(pressure(i + 1) - pressure(i))
         end do
         rolling = rolling + 0.5_wp*(film(1) + film(2))*(pressure(2) - pressure(1))
      end associate
   end function rolling_integral

   !> Slope at a node from the mean slopes on either side: on a logarithmic scale where both have the same sign.
   pure function slope_between(slopes, steps) result(slope)
      !> Mean slopes [any], steps [half widths]
      real(wp), intent(in) :: slopes(2), steps(2)
      !> The slope [any]
      real(wp) :: slope

      ! Part of the second [-]
      real(wp) :: part

      part = steps(1)/sum(steps)
      if (product(slopes) > 0.0_wp) then
         slope = slopes(1)*(slopes(2)/slopes(1))**part
      else
         slope = slopes(1) + part*(slopes(2) - slopes(1))
      end if
   end function slope_between

   !> Mean of s from 0 to 1 weighed with exp(L s).
   pure function mean_place(growth) result(place)
      !> L [-]
      real(wp), intent(in) :: growth
      !> The mean [-]
      real(wp) :: place

      if (abs(growth) < 0.1_wp) then
         place = 0.5_wp + growth/12.0_wp*(1.0_wp - growth**2/60.0_wp)
      else
         place = 1.0_wp/(1.0_wp - exp(-min(max(growth, -50.0_wp), 50.0_wp))) - 1.0_wp/growth
      end if
   end function mean_place

   !> Integral of viscosity over film from each node to the next, as far as the film is full. Behind the end of the film there is
   !> none.
   !>
   !> Exact where its logarithm is linear between both nodes, times what the logarithm's bend adds: the cubic through four nodes is
   !> above the straight line by a sixteenth of both second differences in the middle, by a 24th in the mean. Without it the top
   !> of a spike of two or three nodes is cut off. That is so where the flow makes the pressure at a node, in films thicker than
   !> b^2/R. In thinner ones the bodies do, and they feel a pressure that is straight between the nodes: straight lines it is, then.
   pure subroutine cell_shear(grid, state, shear, slopes)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> The integrals [-]
      real(wp), intent(out) :: shear(grid%size - 1)
      !> Their derivatives over ln(film/viscosity) at both nodes, but for what its bend adds [-]
      real(wp), intent(out) :: slopes(2, grid%size - 1)

      ! Logarithm of film over viscosity; part of a node's cell with a full film; length of a cell with what the bend adds [-]
      real(wp) :: fluidity(grid%size), filled(grid%size), length
      ! Second differences of the logarithm, as far as the nodes resolve them [-]
      real(wp) :: bend(grid%size)
      integer :: i

      fluidity = fluidity_at(state, [(i, i=1, grid%size)])
      filled = filled_part(grid, state)
      bend = 0.0_wp
      bend(2:grid%size - 1) = fluidity(3:) - 2.0_wp*fluidity(2:grid%size - 1) + fluidity(:grid%size - 2)
      bend = bend/(1.0_wp + (bend/largest_bend)**4)/(1.0_wp + 1.0_wp/state%fields%film**2)
      shear = 0.0_wp
      slopes = 0.0_wp
      do i = 1, grid%size - 1
         if (filled(i) + filled(i + 1) <= 0.0_wp) cycle
         call mean_fluidity(fluidity(i), fluidity(i + 1), shear(i), slopes(:, i))
         length = exp((bend(i) + bend(i + 1))/24.0_wp)
         shear(i) = shear(i)*length*grid%step(i)*0.5_wp*(filled(i) + filled(i + 1))
         slopes(:, i) = slopes(:, i)*length*grid%step(i)*0.5_wp*(filled(i) + filled(i + 1))
      end do
   end subroutine cell_shear

   !> Part of each node's cell in which the film is full.
   !>
   !> At a full node all of it. At the end of the film the flow is that of the place where it ends, and the gap between two nodes
   !> is nearly straight, so that the end lies as far inside the cell of the first ruptured node as the pressure of its neighbour
   !> drives of what more the cell could carry off. The part is one as the node becomes full and zero as its neighbour ruptures, so
   !> that nothing jumps as the end passes a node.
   pure function filled_part(grid, state) result(filled)
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> The parts [-]
      real(wp) :: filled(grid%size)

      ! Flow that the neighbours' pressure drives into a cell [-]
      real(wp) :: driven
      integer :: i

      filled = 0.0_wp
      filled(1) = merge(1.0_wp, 0.0_wp, state%is_full(2))
      do i = 2, grid%size - 1
         if (state%is_full(i)) then
            filled(i) = 1.0_wp
         else
            driven = max(state%fields%driven(i - 1), 0.0_wp) + max(-state%fields%driven(i), 0.0_wp)
            if (driven > 0.0_wp) filled(i) = driven/(driven + max(state%fields%excess(i), 0.0_wp))
         end if
      end do
   end function filled_part

   !> Value of the parabola through three points.
   pure function parabola_value(x, y, place) result(value)
      !> The points [any], their values [any], and the requested point [any]
      real(wp), intent(in) :: x(3), y(3), place
      !> Value there [any]
      real(wp) :: value

      value = y(1)*(place - x(2))*(place - x(3))/((x(1) - x(2))*(x(1) - x(3))) &
         & + y(2)*(place - x(1))*(place - x(3))/((x(2) - x(1))*(x(2) - x(3))) &
         & + y(3)*(place - x(1))*(place - x(2))/((x(3) - x(1))*(x(3) - x(2)))
   end function parabola_value

   !> Vertex of the parabola through three points of which the middle one is the lowest.
   pure subroutine vertex(x, y, place, value)
      !> The points and their values [any]
      real(wp), intent(in) :: x(3), y(3)
      !> The vertex [any]
      real(wp), intent(out) :: place, value

      ! First and second divided differences [any]
      real(wp) :: slopes(2), bend

      slopes = (y(2:3) - y(1:2))/(x(2:3) - x(1:2))
      bend = (slopes(2) - slopes(1))/(x(3) - x(1))
      place = x(2)
      if (bend > 0.0_wp) place = 0.5_wp*(x(1) + x(2) - slopes(1)/bend)
      value = parabola_value(x, y, place)
   end subroutine vertex

end module camroller_ehl_films
