!> Flow between the nodes of a line contact: its derivatives, and what is stored while the nodes move.
module test_ehl_reynolds
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_ehl_grid, only : ehl_grid_t, new_ehl_grid
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem
   use camroller_ehl_reynolds, only : ehl_fields_t, evaluate_film, evaluate_flow, evaluate_oil, new_ehl_fields, storage_t
   use camroller_lubricant, only : law_barus, law_roelands
   use closeness, only : check_scaled
   use ehl_contacts, only : contact_of_groups
   implicit none
   private

   public :: collect_ehl_reynolds

contains

   subroutine collect_ehl_reynolds(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("derivatives of the flow agree with difference quotients", test_slopes), &
         new_unittest("flow and shear of a thinned film follow from Eyring's law across it", test_eyring), &
         new_unittest("a uniform film stays uniform while the nodes move apart", test_uniform) &
         ]
   end subroutine collect_ehl_reynolds

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_fields_t) :: fields(-1:1)
      real(wp), parameter :: increment = 1.0e-6_wp
      real(wp) :: total(33), quotient, slope
      integer :: law, i, k, side, status

      call new_ehl_grid(grid, 33, 4.0_wp, 2.0_wp, 0.1_wp)
      total = 0.9_wp*sqrt(max((1.0_wp - grid%x)*(1.0_wp + grid%x), 0.0_wp)) + 1.0e-3_wp
      do law = law_barus, law_roelands
         contact = contact_of_groups(3.0e-5_wp, 1.0e-11_wp, 4500.0_wp, law=law)
         contact%roughness = 0.1e-6_wp
         contact%asperity%load_factor = 3.0e8_wp
         contact%has_flow_factors = .true.
         contact%eyring_stress = 5.0e6_wp
         contact%sliding_speed = 0.1_wp
         call new_ehl_problem(problem, contact, status)
         call check(error, status, 0)
         if (allocated(error)) return
         do side = -1, 1
            call new_ehl_fields(fields(side), 33)
         end do
         call evaluate_film(problem, grid, total, 0.4_wp, fields(0))
         call evaluate_flow(problem, grid, fields(0))
         do k = 2, 32
            ! Everything over the level of the gap, which moves film and, through the asperities, pressure
            do side = -1, 1, 2
               call evaluate_film(problem, grid, total, 0.4_wp + side*increment, fields(side))
               call evaluate_flow(problem, grid, fields(side))
            end do
            quotient = (fields(1)%flow(k) - fields(-1)%flow(k))/(2.0_wp*increment)
            slope = sum(fields(0)%by_film(:, k)) - sum(fields(0)%by_pressure(:, k)*fields(0)%asperity_slope(k - 1:k + 1))
            call check_scaled(error, slope, quotient, sum(abs(fields(0)%by_film(:, k))), 1.0e-6_wp, "slope over the level")
            if (allocated(error)) return
         end do
         do i = 2, 31
            ! Over the pressure at one node, without what it does to the film
            do side = -1, 1, 2
               fields(side) = fields(0)
               total(i) = total(i) + side*increment
               call evaluate_film(problem, grid, total, 0.4_wp, fields(side))
               total(i) = total(i) - side*increment
               call evaluate_flow(problem, grid, fields(side))
            end do
            do k = max(i - 1, 2), i + 1
               quotient = (fields(1)%flow(k) - fields(-1)%flow(k))/(2.0_wp*increment)
               slope = fields(0)%by_pressure(i - k + 2, k) + sum((fields(0)%by_film(:, k) - fields(0)%by_pressure(:, k) &
                  & *fields(0)%asperity_slope(k - 1:k + 1))*grid%kernel(k - 1:k + 1, i))
               call check_scaled(error, slope, quotient, sum(abs(fields(0)%by_pressure(:, k))), 1.0e-6_wp, &
                  & "slope over a pressure")
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_slopes

   !> Pressure drives oil through a film of one thickness that is sheared along the flow: Eyring's law integrated across the film.
   subroutine test_eyring(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_fields_t) :: plain, thinned, thick
      integer, parameter :: nodes = 33, pieces = 2000, middle = 16
      ! Film over its scale, change of the stress across the film over the Eyring stress [-]
      real(wp), parameter :: gap = 0.4_wp, change = 1.0e-3_wp
      ! Pressure [-]; sliding over the film times viscosity over the Eyring stress, mean stress over it, place in the film [-]
      real(wp) :: total(nodes), stress, mean, place, flow
      integer :: i, k, status

      call new_ehl_grid(grid, nodes, 4.0_wp, 2.0_wp, 0.1_wp)
      ! So small a drop of pressure that viscosity and density are those at ambient pressure
      total = [(1.0e-9_wp*i, i=1, nodes)]
      contact = contact_of_groups(3.0e-5_wp, 1.0e-11_wp, 4500.0_wp, law=law_barus)
      call new_ehl_problem(problem, contact, status)
      call flow_at(problem, plain)
      contact%eyring_stress = 5.0e6_wp
      do k = -1, 2
         stress = 10.0_wp**k
         contact%sliding_speed = stress*contact%eyring_stress*gap*problem%film_scale/contact%oil%viscosity
         call new_ehl_problem(problem, contact, status)
         call flow_at(problem, thinned)
         mean = asinh(stress*0.5_wp*change/sinh(0.5_wp*change))
         flow = 0.0_wp
         do i = 1, pieces
            place = (i - 0.5_wp)/pieces - 0.5_wp
            flow = flow + 12.0_wp/change*place*sinh(mean + change*place)/pieces
         end do
         ! The midpoint rule leaves 1/pieces^2, the change of stress its own square
         call check_scaled(error, thinned%driven(middle)/plain%driven(middle), flow, flow, 1.0e-6_wp, "flow")
         if (allocated(error)) return
         call check_scaled(error, exp(thinned%log_viscosity(middle) - plain%log_viscosity(middle)), mean/stress, 1.0_wp, &
            & 1.0e-6_wp, "shear")
         if (allocated(error)) return
         contact%thins_flow = .false.
         call new_ehl_problem(problem, contact, status)
         contact%thins_flow = .true.
         call flow_at(problem, thick)
         call check_scaled(error, thick%driven(middle), plain%driven(middle), abs(plain%driven(middle)), &
            & epsilon(1.0_wp), "flow that is not to thin")
         if (allocated(error)) return
         call check_scaled(error, thick%log_viscosity(middle), thinned%log_viscosity(middle), 1.0_wp, epsilon(1.0_wp), &
            & "shear beside it")
         if (allocated(error)) return
      end do

   contains

      !> Flow of the uniform film
      subroutine flow_at(problem, fields)
         type(ehl_problem_t), intent(in) :: problem
         type(ehl_fields_t), intent(out) :: fields

         call new_ehl_fields(fields, nodes)
         fields%film = gap
         call evaluate_oil(problem, grid, total, fields)
         call evaluate_flow(problem, grid, fields)
      end subroutine flow_at
   end subroutine test_eyring

   !> Nodes move with the half width. Oil that is the same everywhere then flows between them and is stored in them in equal parts.
   subroutine test_uniform(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_fields_t) :: fields
      type(storage_t) :: storage
      integer, parameter :: nodes = 33
      real(wp), parameter :: gap = 0.4_wp
      real(wp) :: total(nodes)
      integer :: i, status

      call new_ehl_grid(grid, nodes, 4.0_wp, 2.0_wp, 0.1_wp)
      call new_ehl_problem(problem, contact_of_groups(3.0e-5_wp, 1.0e-11_wp, 4500.0_wp, law=law_barus), status)
      call new_ehl_fields(fields, nodes)
      total = 0.0_wp
      call evaluate_film(problem, grid, total, gap, fields)
      fields%film = gap
      fields%gap = gap
      do i = -1, 1, 2
         storage%growth = 0.01_wp*i
         storage%duration = 0.05_wp
         storage%mass = grid%weight*fields%density*gap*(1.0_wp - storage%growth)
         call evaluate_flow(problem, grid, fields, storage)
         ! masses and flows of order one over the duration
         call check(error, maxval(abs(fields%excess(2:nodes - 1))) <= 100.0_wp*epsilon(1.0_wp)/storage%duration, &
            & "oil comes or goes")
         if (allocated(error)) return
      end do
   end subroutine test_uniform

end module test_ehl_reynolds
