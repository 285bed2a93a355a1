!> Discrete Reynolds equation: film, flow between nodes, and all their derivatives.
!>
!> In: problem, grid, total pressure at the nodes, level of the gap. Out: film, flow, and the coefficients of their derivatives.
!> The total pressure P is the sum of film and asperity pressure; the asperity pressure follows from the film, so that `H = H0 +
!> X^2/2 + K P` and the film's pressure is `P - P_a(H)`. Flow between two nodes:
!>
!>     (mean(1/H^2) - mean(1/eta) (P_(i+1) - P_i)/(lambda step))/mean(1/(rho H^3))
!>
!> which is Reynolds' equation integrated from node to node with a constant flow. With flow factors of rough surfaces, the terms
!> are `H_T/(phi H^3)` and `1/(rho phi H^3)`: H_T is the mean gap, phi the pressure flow factor. The mean of 1/eta is exact where
!> ln(eta) is linear between the nodes; the other two are by Simpson's rule, with midpoint values from the quadratic through
!> three nodes. Nodes that move carry the oil of their cell with them. In the full film, inflow and outflow of the cell of a node
!> balance; where the film has ruptured, the pressure is zero.
module camroller_ehl_reynolds
   use camroller_kinds, only : wp
   use camroller_ehl_grid, only : ehl_grid_t, deformation
   use camroller_ehl_problem, only : ehl_problem_t, log_viscosity, log_hot_viscosity, relative_density, asperity_pressure, &
      & pressure_flow_factor, mean_gap
   implicit none
   private

   public :: ehl_fields_t, new_ehl_fields, evaluate_film, evaluate_oil, evaluate_flow, mean_fluidity, storage_t

   !> Everything at the nodes and between them at a given pressure
   type :: ehl_fields_t
      !> Film over b^2/R; pressure of the film and of the asperities over p_H [-]
      real(wp), allocatable :: film(:), pressure(:), asperity(:)
      !> Derivative of the asperities' pressure with respect to the film [-]
      real(wp), allocatable :: asperity_slope(:)
      !> Room for the oil over b^2/R, the film or the mean gap of rough surfaces, and its derivative with respect to the film [-]
      real(wp), allocatable :: gap(:), gap_slope(:)
      !> Density ratio; logarithms of the viscosity ratios of shear and of the flow that pressure drives [-]
      real(wp), allocatable :: density(:), log_viscosity(:), log_flow_viscosity(:)
      !> Slopes of density and ln(viscosity of the flow) with the film's pressure, and of the latter with the film [-]
      real(wp), allocatable :: density_slope(:), viscosity_slope(:), thinning_slope(:)
      !> Mass flow between neighbours, and the part of it that the drop of pressure drives [-]
      real(wp), allocatable :: flow(:), driven(:)
      !> Derivatives of the flow between i and i + 1 with respect to pressure of the film, then film, at i - 1, i, i + 1 [-]
      real(wp), allocatable :: by_pressure(:, :), by_film(:, :)
      !> Excess of what leaves a cell over what enters it, of inner nodes [-]
      real(wp), allocatable :: excess(:)
      !> Mean rise of the film's temperature across it [K], derivative of ln(viscosity of shear) over it [1/K]; not allocated: no
      !> heat
      real(wp), allocatable :: rise(:), by_rise(:)
      !> Heat flux of the film into both surfaces: sum, then difference [W/m^2]; rise of both surfaces [K]; over node, then surface
      real(wp), allocatable :: flux(:, :), surface_rise(:, :)
   end type ehl_fields_t

   !> What the film stored at the time before: for contacts that change
   type :: storage_t
      !> Mass of the oil in the cells at the time before, over that of one film scale and half width now [-]
      real(wp), allocatable :: mass(:)
      !> Length of time over that in which the surfaces' mean speed travels one half width [-]
      real(wp) :: duration = 0.0_wp
      !> Change of the half width over the time step, over the half width now [-]
      real(wp) :: growth = 0.0_wp
   end type storage_t

   !> Film over its scale below which a film between nodes does not count as thinner: trial states may overlap [-]
   real(wp), parameter :: smallest_film = 1.0e-12_wp

contains

   !> Room for everything.
   pure subroutine new_ehl_fields(fields, nodes)
      !> The fields
      type(ehl_fields_t), intent(out) :: fields
      !> Number of nodes
      integer, intent(in) :: nodes

      allocate (fields%film(nodes), fields%pressure(nodes), fields%asperity(nodes), fields%asperity_slope(nodes), &
         & fields%density(nodes), fields%log_viscosity(nodes), fields%log_flow_viscosity(nodes), fields%density_slope(nodes), &
         & fields%viscosity_slope(nodes), fields%thinning_slope(nodes), fields%flow(nodes - 1), fields%driven(nodes - 1), &
         & fields%by_pressure(3, nodes - 1), fields%by_film(3, nodes - 1), fields%excess(nodes), fields%gap(nodes), &
         & fields%gap_slope(nodes), source=0.0_wp)
   end subroutine new_ehl_fields

   !> Film, share of the asperities, and the state of the oil.
   pure subroutine evaluate_film(problem, grid, total, level, fields)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure of film and asperities at the nodes [-]
      real(wp), intent(in) :: total(:)
      !> Level of the gap, H0 [-]
      real(wp), intent(in) :: level
      !> Film and state of the oil
      type(ehl_fields_t), intent(inout) :: fields

      fields%film = level + 0.5_wp*grid%x**2 + deformation(grid, total)
      call evaluate_oil(problem, grid, total, fields)
   end subroutine evaluate_film

   !> Share of the asperities and the state of the oil where the film is known.
   pure subroutine evaluate_oil(problem, grid, total, fields)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure of film and asperities at the nodes [-]
      real(wp), intent(in) :: total(:)
      !> In: film; out: state of the oil
      type(ehl_fields_t), intent(inout) :: fields

      ! Derivatives of ln(viscosity) of shear and of the flow over that without thinning [-]
      real(wp) :: part, flow_part
      logical :: is_hot
      integer :: i

      is_hot = allocated(fields%rise)
      do i = 1, grid%size
         call asperity_pressure(problem, fields%film(i), fields%asperity(i), fields%asperity_slope(i))
         fields%pressure(i) = total(i) - fields%asperity(i)
         call mean_gap(problem, fields%film(i), fields%gap(i), fields%gap_slope(i))
         call relative_density(problem, fields%pressure(i), fields%density(i), fields%density_slope(i))
         if (is_hot) then
            if (problem%is_compressible) call expand(problem, fields%rise(i), fields%density(i), fields%density_slope(i))
            call log_hot_viscosity(problem, fields%pressure(i), fields%rise(i), fields%log_viscosity(i), &
               & fields%viscosity_slope(i), fields%by_rise(i))
         else
            call log_viscosity(problem, fields%pressure(i), fields%log_viscosity(i), fields%viscosity_slope(i))
         end if
         call thin_by_sliding(problem, fields%film(i), fields%log_viscosity(i), fields%log_flow_viscosity(i), part, flow_part)
         fields%viscosity_slope(i) = fields%viscosity_slope(i)*flow_part
         fields%thinning_slope(i) = (1.0_wp - flow_part)/max(fields%film(i), smallest_film)
         if (is_hot) fields%by_rise(i) = fields%by_rise(i)*part
      end do
   end subroutine evaluate_oil

   !> Density of oil that is warmer than around.
   pure subroutine expand(problem, rise, density, slope)
      !> The problem, with heat
      type(ehl_problem_t), intent(in) :: problem
      !> Rise of the temperature [K]
      real(wp), intent(in) :: rise
      !> Density ratio and its derivative over the pressure: at the temperature around, then at the rise [-]
      real(wp), intent(inout) :: density, slope

      ! Density over that at the temperature around, least value [-]
      real(wp) :: part
      real(wp), parameter :: least_part = 0.5_wp

      part = max(1.0_wp - problem%heat%expansion*rise, least_part)
      density = density*part
      slope = slope*part
   end subroutine expand

   !> Logarithms of the viscosity ratios that act on shear and on the flow: thinned by sliding as Eyring's law has it.
   !>
   !> Shear has the stress over the rate (secant), `eta_s = tau_E/(V_s/h) asinh(eta V_s/(h tau_E))`. In a line contact pressure
   !> drives the oil along the sliding, so that its flow has the slope of the stress over the rate (tangent), `eta_t = eta/sqrt(1 +
   !> (eta V_s/(h tau_E))^2)`: Conry, Wang and Cusano, J. Tribology 109 (1987) 648, where the stress that the drop of pressure makes
   !> across the film is small beside tau_E. A problem may leave the flow as it is.
   pure subroutine thin_by_sliding(problem, film, shear_value, flow_value, shear_part, flow_part)
      type(ehl_problem_t), intent(in) :: problem
      !> Film over its scale [-]
      real(wp), intent(in) :: film
      !> ln(viscosity ratio): in without, out with thinning of shear [-]
      real(wp), intent(inout) :: shear_value
      !> The same with thinning of the flow [-]
      real(wp), intent(out) :: flow_value
      !> Derivatives of both over that without thinning [-]
      real(wp), intent(out) :: shear_part, flow_part

      ! ln of the stress over tau_E without thinning; the stress itself; its thinned value [-]
      real(wp) :: log_stress, stress, thinned

      shear_part = 1.0_wp
      flow_part = 1.0_wp
      flow_value = shear_value
      if (problem%shear <= 0.0_wp .or. film <= 0.0_wp) return
      log_stress = shear_value + log(problem%shear/film)
      if (log_stress < -8.0_wp) return
      if (log_stress > 300.0_wp) then
         thinned = log_stress + log(2.0_wp)
         shear_part = 1.0_wp/thinned
         if (problem%thins_flow) then
            flow_part = 0.0_wp
            flow_value = shear_value - log_stress
         end if
      else
         stress = exp(log_stress)
         thinned = asinh(stress)
         shear_part = stress/hypot(1.0_wp, stress)/thinned
         if (problem%thins_flow) then
            flow_part = 1.0_wp/hypot(1.0_wp, stress)**2
            flow_value = shear_value - log(hypot(1.0_wp, stress))
         end if
      end if
      shear_value = log(thinned*film/problem%shear)
   end subroutine thin_by_sliding

   !> Flow between the nodes, its derivatives, and what is out of balance.
   pure subroutine evaluate_flow(problem, grid, fields, storage)
      !> The problem
      type(ehl_problem_t), intent(in) :: problem
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> In: film and state of the oil; out: flow
      type(ehl_fields_t), intent(inout) :: fields
      !> What was stored before; absent: nothing changes with time
      type(storage_t), intent(in), optional :: storage

      ! Mean of 1/viscosity and its derivatives over ln(viscosity) at both nodes [-]
      real(wp) :: fluidity, fluidity_slopes(2)
      ! Means over the cell of the resistance 1/(rho H^3) and of rho H times it; their derivatives over density and film [-]
      real(wp) :: resistance, drag, resistance_slopes(3, 2), drag_slopes(3, 2)
      ! Flow that the drop of pressure drives times the resistance, its derivatives over pressure and film at both nodes [-]
      real(wp) :: driven, by_pressure(2), by_film(2)
      ! Drop of pressure; speed at which the middle between the nodes moves, over the mean speed of the surfaces [-]
      real(wp) :: drop, moved
      integer :: i, j, k, near(3)

      do i = 1, grid%size - 1
         moved = 0.0_wp
         if (present(storage)) moved = 0.5_wp*(grid%x(i) + grid%x(i + 1))*storage%growth/storage%duration
         call mean_fluidity(fields%log_flow_viscosity(i), fields%log_flow_viscosity(i + 1), fluidity, fluidity_slopes)
         call mean_resistance(problem, grid%face(:, i), fields, i, resistance, drag, resistance_slopes, drag_slopes)
         drop = fields%pressure(i + 1) - fields%pressure(i)
         driven = fluidity*drop/(problem%speed*grid%step(i))
         by_pressure = (drop*fluidity_slopes*fields%viscosity_slope(i:i + 1) + fluidity*[-1.0_wp, 1.0_wp]) &
            & /(problem%speed*grid%step(i))
         by_film = drop*fluidity_slopes*fields%thinning_slope(i:i + 1)/(problem%speed*grid%step(i))
         fields%driven(i) = -driven/resistance
         fields%flow(i) = drag/resistance + fields%driven(i)
         do k = 1, 3
            j = max(i - 2 + k, 1)
            fields%by_pressure(k, i) = ((drag_slopes(k, 1) - fields%flow(i)*resistance_slopes(k, 1))/resistance &
               & - moved*grid%face(k, i)*fields%gap(j))*fields%density_slope(j)
            fields%by_film(k, i) = (drag_slopes(k, 2) - fields%flow(i)*resistance_slopes(k, 2))/resistance &
               & - moved*grid%face(k, i)*fields%density(j)*fields%gap_slope(j)
         end do
         fields%by_pressure(2:, i) = fields%by_pressure(2:, i) - by_pressure/resistance
         fields%by_film(2:, i) = fields%by_film(2:, i) - by_film/resistance
         near = [max(i - 1, 1), i, i + 1]
         fields%flow(i) = fields%flow(i) - moved*dot_product(grid%face(:, i), fields%density(near)*fields%gap(near))
      end do
      fields%excess(2:grid%size - 1) = fields%flow(2:) - fields%flow(:grid%size - 2)
      if (.not. present(storage)) return
      fields%excess = fields%excess + (grid%weight*fields%density*fields%gap - storage%mass)/storage%duration
   end subroutine evaluate_flow

   !> Means of `1/(rho H^3)` and `1/H^2` between two nodes by Simpson's rule, the middle by the quadratic through three nodes.
   pure subroutine mean_resistance(problem, face, fields, i, resistance, drag, resistance_slopes, drag_slopes)
      type(ehl_problem_t), intent(in) :: problem
      !> Weights of the nodes i - 1, i, i + 1 in the middle between the last two [-]
      real(wp), intent(in) :: face(3)
      !> Film and density at the nodes
      type(ehl_fields_t), intent(in) :: fields
      !> Number of the first of both nodes
      integer, intent(in) :: i
      !> The means, both over the part of the flow that roughness lets through [-]
      real(wp), intent(out) :: resistance, drag
      !> Their derivatives over density, then film, at the nodes i - 1, i, i + 1 [-]
      real(wp), intent(out) :: resistance_slopes(3, 2), drag_slopes(3, 2)

      ! Weights of the three nodes at a point of the rule, and of the point [-]
      real(wp) :: weights(3), part
      ! Film, density, flow factor and its slope, mean gap and its slope there; resistance and its derivative over the film [-]
      real(wp) :: film, density, factor, factor_slope, gap, gap_slope, value, slope
      integer :: k, before

      before = max(i - 1, 1)
      resistance = 0.0_wp
      drag = 0.0_wp
      resistance_slopes = 0.0_wp
      drag_slopes = 0.0_wp
      do k = 1, 3
         select case (k)
         case (1)
            weights = [0.0_wp, 1.0_wp, 0.0_wp]
         case (2)
            weights = face
         case default
            weights = [0.0_wp, 0.0_wp, 1.0_wp]
         end select
         part = merge(4.0_wp, 1.0_wp, k == 2)/6.0_wp
         film = weights(1)*fields%film(before) + weights(2)*fields%film(i) + weights(3)*fields%film(i + 1)
         density = weights(1)*fields%density(before) + weights(2)*fields%density(i) + weights(3)*fields%density(i + 1)
         film = max(film, smallest_film)
         call pressure_flow_factor(problem, film, factor, factor_slope)
         value = part/(density*film**3*factor)
         slope = -value*(3.0_wp/film + factor_slope/factor)
         resistance = resistance + value
         call mean_gap(problem, film, gap, gap_slope)
         drag = drag + density*gap*value
         resistance_slopes(:, 1) = resistance_slopes(:, 1) - weights*value/density
         resistance_slopes(:, 2) = resistance_slopes(:, 2) + weights*slope
         drag_slopes(:, 2) = drag_slopes(:, 2) + weights*density*(gap_slope*value + gap*slope)
      end do
   end subroutine mean_resistance

   !> Mean of exp(-g) where g is linear between two values, and its derivatives with respect to both.
   pure subroutine mean_fluidity(first, second, mean, slopes)
      !> The two values [-]
      real(wp), intent(in) :: first, second
      !> The mean, and its derivatives [-]
      real(wp), intent(out) :: mean, slopes(2)

      ! Difference of both; mean over exp(-smaller), its derivative over the difference, exp(-smaller) [-]
      real(wp) :: difference, part, part_slope, largest

      difference = abs(second - first)
      largest = exp(-min(first, second))
      if (difference < 5.0e-2_wp) then
         part = mean_series(difference)
         part_slope = mean_series_slope(difference)
      else
         part = (1.0_wp - exp(-difference))/difference
         part_slope = (exp(-difference) - part)/difference
      end if
      mean = largest*part
      slopes = largest*part_slope
      if (first <= second) slopes(1) = -mean - slopes(2)
      if (first > second) slopes(2) = -mean - slopes(1)
   end subroutine mean_fluidity

   !> `(1 - exp(-d))/d` for small d.
   pure function mean_series(d) result(mean)
      !> d [-]
      real(wp), intent(in) :: d
      !> The mean [-]
      real(wp) :: mean

      mean = 1.0_wp - d/2.0_wp*(1.0_wp - d/3.0_wp*(1.0_wp - d/4.0_wp*(1.0_wp - d/5.0_wp*(1.0_wp - d/6.0_wp*(1.0_wp - d/7.0_wp)))))
   end function mean_series

   !> Derivative of `(1 - exp(-d))/d` for small d.
   pure function mean_series_slope(d) result(slope)
      !> d [-]
      real(wp), intent(in) :: d
      !> The derivative [-]
      real(wp) :: slope

      slope = -0.5_wp + d*(1.0_wp/3.0_wp - d*(1.0_wp/8.0_wp - d*(1.0_wp/30.0_wp - d*(1.0_wp/144.0_wp - d*(1.0_wp/840.0_wp &
         & - d/5760.0_wp)))))
   end function mean_series_slope

end module camroller_ehl_reynolds
