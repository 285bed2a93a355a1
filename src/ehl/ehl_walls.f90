!> Rise of both surfaces of a line contact by the heat that enters them along it.
!>
!> In: grid, bodies, speeds. Out: rise at each node per heat flux into the surface about each other. Each body is a half space that
!> moves past the contact; the flux is even from the middle between two nodes to the next, and the rise of such a band is exact at
!> any speed. Source: Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 10.7: a line of heat q over length on a half
!> space that moves at V makes a rise of `q/(pi k) e^(V x/(2 kappa)) K_0(V |x|/(2 kappa))` at the distance x behind it.
module camroller_ehl_walls
   use camroller_kinds, only : wp, pi
   use camroller_conjunction, only : body_t, least_log, line_integral
   use camroller_ehl_grid, only : ehl_grid_t
   implicit none
   private

   public :: surface_response

contains

   !> Rise of a surface at each node (row) per heat flux about each other (column).
   pure function surface_response(grid, body, speed, half_width) result(response)
      !> The grid
      type(ehl_grid_t), intent(in) :: grid
      !> The body
      type(body_t), intent(in) :: body
      !> Speed of its surface over the contact, positive downstream [m/s]
      real(wp), intent(in) :: speed
      !> Half width, which scales the grid [m]
      real(wp), intent(in) :: half_width
      !> Rise per flux [m^2 K/W]
      real(wp) :: response(grid%size, grid%size)

      ! V b/(2 kappa) [-]: a body at rest, which has no steady temperature, counts as one that moves a little
      real(wp) :: number
      ! Ends of the bands [half widths]; integrals up to both ends of one [-]
      real(wp) :: ends(0:grid%size), before, after
      integer :: i, j, n

      n = grid%size
      number = sign(max(abs(speed)*half_width/body%diffusivity, exp(least_log)), speed)*0.5_wp
      ends(0) = grid%x(1)
      ends(1:n - 1) = 0.5_wp*(grid%x(:n - 1) + grid%x(2:))
      ends(n) = grid%x(n)
      do i = 1, n
         before = line_integral(number*(grid%x(i) - ends(0)))
         do j = 1, n
            after = line_integral(number*(grid%x(i) - ends(j)))
            response(i, j) = before - after
            before = after
         end do
      end do
      response = response*half_width/(pi*body%conductivity*number)
   end function surface_response

end module camroller_ehl_walls
