!> Nodes across a line contact, and the elastic deformation that a pressure at the nodes causes.
!>
!> In: reach of the domain, width of the zones at the edges of the contact. Out: nodes, kernel, weights. Lengths are
!> in half widths b, film in b^2/R, pressure in the peak pressure of the dry contact: then the gap of two parabolas is X^2/2 and
!> the deformation `-(1/pi) int ln|X - X'| P(X') dX'`.
!>
!> Nodes lie at equal steps of `asinh((X + 1)/d) + asinh((X - 1)/d) + 2 asinh(X)`: logarithmic on either side of both edges of the
!> contact, so that a zone of width d there has as many nodes as the whole middle, and nested when their number is halved. Where a
!> spike of the pressure is about the middle, the last term is `4 asinh(X/0.3)`. The
!> pressure is piecewise linear, its deformation exact: second divided differences of `X^2/2 (ln|X| - 3/2)`.
module camroller_ehl_grid
   use camroller_kinds, only : wp, pi
   use camroller_lapack, only : dgemv
   implicit none
   private

   public :: ehl_grid_t, new_ehl_grid, new_uniform_grid, deformation, integral

   !> Nodes and what follows from them alone
   type :: ehl_grid_t
      !> Number of nodes
      integer :: size = 0
      !> Nodes [half widths]
      real(wp), allocatable :: x(:)
      !> Distances between neighbours [half widths]
      real(wp), allocatable :: step(:)
      !> Weights of the integral over the nodes [half widths]
      real(wp), allocatable :: weight(:)
      !> Deformation at a node per pressure at another; zero for the pressure of the end nodes, which is zero [-]
      real(wp), allocatable :: kernel(:, :)
      !> Value between nodes i and i + 1 from those at i - 1, i, i + 1: interpolation with one node more upstream [-]
      real(wp), allocatable :: face(:, :)
   end type ehl_grid_t

   !> Weight of the middle of the contact in the density of nodes [-], and its width [half widths]: usually, and with a spike there
   real(wp), parameter :: middle_weights(2) = [2.0_wp, 4.0_wp], middle_widths(2) = [1.0_wp, 0.3_wp]
   !> Iterations of Newton's method for a node, more than it takes
   integer, parameter :: max_iterations = 60

contains

   !> Grid that is dense at both edges of the contact.
   pure subroutine new_ehl_grid(grid, nodes, inlet, outlet, edge, has_middle_spike)
      !> The grid
      type(ehl_grid_t), intent(out) :: grid
      !> Number of nodes
      integer, intent(in) :: nodes
      !> Distance of the first node before and of the last node behind the middle of the contact [half widths]
      real(wp), intent(in) :: inlet, outlet
      !> Width of the zones at the edges of the contact [half widths]
      real(wp), intent(in) :: edge
      !> Is there a spike of the pressure about the middle? Absent: no
      logical, intent(in), optional :: has_middle_spike

      ! Ends of the range of the stretched coordinate, and the coordinate of a node [-]
      real(wp) :: first, last, target_value
      ! Stretched coordinate and its slope at a point; change of the point [half widths]
      real(wp) :: value, slope, change
      ! Bracket of the point [half widths]
      real(wp) :: low, high
      integer :: i, iteration, middle

      middle = 1
      if (present(has_middle_spike)) middle = merge(2, 1, has_middle_spike)
      allocate (grid%x(nodes))
      call stretch(-inlet, edge, middle, first, slope)
      call stretch(outlet, edge, middle, last, slope)
      grid%x(1) = -inlet
      grid%x(nodes) = outlet
      do i = 2, nodes - 1
         target_value = first + (last - first)*real(i - 1, wp)/real(nodes - 1, wp)
         low = grid%x(i - 1)
         high = outlet
         grid%x(i) = low
         do iteration = 1, max_iterations
            call stretch(grid%x(i), edge, middle, value, slope)
            if (value < target_value) low = grid%x(i)
            if (value > target_value) high = grid%x(i)
            change = (target_value - value)/slope
            grid%x(i) = grid%x(i) + change
            if (abs(change) <= 1.0e-13_wp*edge) exit
            if (grid%x(i) <= low .or. grid%x(i) >= high) grid%x(i) = 0.5_wp*(low + high)
         end do
      end do
      call complete_grid(grid)
   end subroutine new_ehl_grid

   !> Grid of equal steps, as published solutions mostly have it.
   pure subroutine new_uniform_grid(grid, nodes, inlet, outlet)
      !> The grid
      type(ehl_grid_t), intent(out) :: grid
      !> Number of nodes
      integer, intent(in) :: nodes
      !> Distance of the first node before and of the last node behind the middle of the contact [half widths]
      real(wp), intent(in) :: inlet, outlet

      integer :: i

      grid%x = [(-inlet + (inlet + outlet)*real(i, wp)/real(nodes - 1, wp), i=0, nodes - 1)]
      call complete_grid(grid)
   end subroutine new_uniform_grid

   !> Gap that a pressure adds by elastic deformation, up to a constant.
   pure function deformation(grid, pressure) result(gap)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Pressure at the nodes, zero at both ends [-]
      real(wp), intent(in) :: pressure(:)
      !> Deformation at the nodes [-]
      real(wp) :: gap(size(pressure))

      integer :: last

      do last = grid%size, 2, -1
         if (abs(pressure(last)) > 0.0_wp) exit
      end do
      gap = 0.0_wp
      call dgemv("N", grid%size, last, 1.0_wp, grid%kernel, grid%size, pressure, 1, 0.0_wp, gap, 1)
   end function deformation

   !> Integral over the nodes by the trapezoidal rule, exact for a piecewise linear function.
   pure function integral(grid, values) result(sum_of_values)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> Values at the nodes [any]
      real(wp), intent(in) :: values(:)
      !> The integral [any]
      real(wp) :: sum_of_values

      sum_of_values = dot_product(grid%weight, values)
   end function integral

   !> Stretched coordinate of a point, and its slope.
   pure subroutine stretch(x, edge, middle, value, slope)
      !> Point, and width of the zones at the edges [half widths]
      real(wp), intent(in) :: x, edge
      !> Place of the middle's weight and width in their lists
      integer, intent(in) :: middle
      !> Stretched coordinate [-] and its slope [1/half widths]
      real(wp), intent(out) :: value, slope

      value = asinh((x + 1.0_wp)/edge) + asinh((x - 1.0_wp)/edge) + middle_weights(middle)*asinh(x/middle_widths(middle))
      slope = 1.0_wp/hypot(x + 1.0_wp, edge) + 1.0_wp/hypot(x - 1.0_wp, edge) &
         & + middle_weights(middle)/hypot(x, middle_widths(middle))
   end subroutine stretch

   !> Everything that follows from the nodes.
   pure subroutine complete_grid(grid)
      !> The grid; its nodes are set
      type(ehl_grid_t), intent(inout) :: grid

      integer :: i, n

      n = size(grid%x)
      grid%size = n
      grid%step = grid%x(2:) - grid%x(:n - 1)
      allocate (grid%weight(n), source=0.0_wp)
      grid%weight(:n - 1) = 0.5_wp*grid%step
      grid%weight(2:) = grid%weight(2:) + 0.5_wp*grid%step
      allocate (grid%face(3, n - 1), source=0.0_wp)
      grid%face(2:, 1) = 0.5_wp
      do i = 2, n - 1
         grid%face(:, i) = midpoint_weights(grid%x(i - 1:i + 1))
      end do
      call set_kernel(grid)
   end subroutine complete_grid

   !> Weights of the quadratic through three points at the middle between the last two.
   pure function midpoint_weights(x) result(weights)
      !> The points, increasing [half widths]
      real(wp), intent(in) :: x(3)
      !> The weights [-]
      real(wp) :: weights(3)

      ! Middle [half widths]
      real(wp) :: middle

      middle = 0.5_wp*(x(2) + x(3))
      weights(1) = (middle - x(2))*(middle - x(3))/((x(1) - x(2))*(x(1) - x(3)))
      weights(2) = (middle - x(1))*(middle - x(3))/((x(2) - x(1))*(x(2) - x(3)))
      weights(3) = (middle - x(1))*(middle - x(2))/((x(3) - x(1))*(x(3) - x(2)))
   end function midpoint_weights

   !> Deformation at each node per pressure at each other.
   pure subroutine set_kernel(grid)
      !> The grid; its nodes and steps are set
      type(ehl_grid_t), intent(inout) :: grid

      ! Second integral of the logarithm between all pairs of nodes [half widths^2]
      real(wp), allocatable :: second(:, :)
      ! Distance of two nodes [half widths]
      real(wp) :: distance
      integer :: i, j, n

      n = grid%size
      allocate (second(n, n), grid%kernel(n, n))
      do j = 1, n
         second(j, j) = 0.0_wp
         do i = j + 1, n
            distance = grid%x(i) - grid%x(j)
            second(i, j) = 0.5_wp*distance**2*(log(distance) - 1.5_wp)
         end do
      end do
      do j = 2, n
         second(:j - 1, j) = second(j, :j - 1)
      end do
      grid%kernel(:, 1) = 0.0_wp
      grid%kernel(:, n) = 0.0_wp
      do j = 2, n - 1
         grid%kernel(:, j) = -((second(:, j + 1) - second(:, j))/grid%step(j) &
            & - (second(:, j) - second(:, j - 1))/grid%step(j - 1))/pi
      end do
   end subroutine set_kernel

end module camroller_ehl_grid
