!> What a solution of a line contact says: films, friction, and how well it keeps what must be kept.
!>
!> Layer: ehl. In: problem, grid, solution. Out: `ehl_films_t`, with dimension.
module camroller_ehl_films
   use camroller_kinds, only : wp, pi
   use camroller_ehl_grid, only : ehl_grid_t, integral
   use camroller_ehl_problem, only : ehl_problem_t, real_area_part
   use camroller_ehl_newton, only : ehl_state_t
   implicit none
   private

   public :: ehl_films_t, get_films, extrapolate

   !> Film and friction of a solution
   type :: ehl_films_t
      !> Film at the middle of the dry contact, smallest film [m]
      real(wp) :: central = 0.0_wp, minimum = 0.0_wp
      !> Estimated relative error of both on the finer grid; of the extrapolated films, taken as half of it [-]
      real(wp) :: error = 0.0_wp, extrapolation_error = 0.0_wp
      !> Place of the smallest film, of the highest pressure, where the film ends [m]
      real(wp) :: minimum_place = 0.0_wp, peak_place = 0.0_wp, end_place = 0.0_wp
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
      !> Shear of a full film over length and sliding speed, `int eta/h dx` where no asperities touch [Pa s/m]; over the Hertz zone
      !> alone
      real(wp) :: shear_slope = 0.0_wp, shear_slope_inside = 0.0_wp
      !> Mass flow over density and speed, equal at all places of the full film [m]
      real(wp) :: flow = 0.0_wp
      !> What load and flow lack, relative [-]
      real(wp) :: load_lack = 0.0_wp, flow_lack = 0.0_wp
      !> Iterations and factorisations
      integer :: iterations = 0, factorisations = 0
   end type ehl_films_t

contains

   !> Films of two nested grids to the limit of no step, and the error of the finer one.
   pure subroutine extrapolate(coarse, films)
      !> Films of the grid with half the nodes
      type(ehl_films_t), intent(in) :: coarse
      !> In: films of the finer grid; out: extrapolated
      type(ehl_films_t), intent(inout) :: films

      films%error = max(abs(films%central/coarse%central - 1.0_wp), abs(films%minimum/coarse%minimum - 1.0_wp))/3.0_wp
      films%extrapolation_error = 0.5_wp*films%error
      films%central = films%central + (films%central - coarse%central)/3.0_wp
      films%minimum = films%minimum + (films%minimum - coarse%minimum)/3.0_wp
      films%rolling = films%rolling + (films%rolling - coarse%rolling)/3.0_wp
   end subroutine extrapolate

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

      ! Place [half widths] and value at the vertex of a parabola; place at the middle [half widths]
      real(wp) :: place, value
      ! Flow into the contact [-]
      real(wp) :: flow
      integer :: i, last

      associate (fields => state%fields, x => grid%x, n => grid%size)
         i = min(max(minloc(abs(x), dim=1), 2), n - 1)
         films%central = problem%film_scale*parabola_value(x(i - 1:i + 1), fields%film(i - 1:i + 1), 0.0_wp)
         i = min(max(minloc(fields%film, dim=1), 2), n - 1)
         call vertex(x(i - 1:i + 1), fields%film(i - 1:i + 1), place, value)
         films%minimum = problem%film_scale*value
         films%minimum_place = problem%length_scale*place
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
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The solution
      type(ehl_state_t), intent(in) :: state
      !> Film and friction
      type(ehl_films_t), intent(inout) :: films

      ! Viscosity over film where the film is full, else what a ruptured film of constant flow still has [-]
      real(wp) :: rate(grid%size)
      ! Part of the surface on which asperities touch [-]
      real(wp) :: touching(grid%size)

      associate (fields => state%fields, n => grid%size)
         films%rolling = 0.25_wp*sum((fields%film(2:) + fields%film(:n - 1))*(fields%pressure(2:) - fields%pressure(:n - 1))) &
            & + problem%speed/abs(grid%x(1))
         films%rolling = films%rolling*problem%pressure_scale*problem%film_scale
         rate = 0.0_wp
         touching = real_area_part(problem, fields%film)
         films%real_area = problem%length_scale*integral(grid, touching)
         where (state%is_full) rate = (1.0_wp - touching)*exp(fields%log_viscosity)/fields%film
         films%shear_slope = integral(grid, rate)
         films%shear_slope_inside = integral(grid, merge(rate, 0.0_wp, abs(grid%x) <= 1.0_wp))
      end associate
      films%shear_slope = films%shear_slope*problem%oil%viscosity*problem%length_scale/problem%film_scale
      films%shear_slope_inside = films%shear_slope_inside*problem%oil%viscosity*problem%length_scale/problem%film_scale
   end subroutine get_friction

   !> Value of the parabola through three points.
   pure function parabola_value(x, y, place) result(value)
      !> The points [any], their values [any], and the place asked for [any]
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
