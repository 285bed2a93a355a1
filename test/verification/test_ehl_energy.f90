!> Heat of sliding of a film whose traction is limited as a whole.
module test_ehl_energy
   use testdrive, only : new_unittest, unittest_type, error_type, check
   use camroller_kinds, only : wp
   use camroller_conjunction, only : body_t, hot_oil_t
   use camroller_ehl_energy, only : find_heat, heat_made_t
   use camroller_ehl_films, only : common_multiplier, ehl_films_t
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t
   use camroller_ehl_reynolds, only : evaluate_oil
   use camroller_lubricant, only : law_cameron
   use camroller_traction, only : cap_sharp, cap_smooth
   use closeness, only : check_close, check_scaled
   use test_ehl_heat, only : solve
   implicit none
   private

   public :: collect_ehl_energy

contains

   subroutine collect_ehl_energy(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a limited traction heats no place by more than about its pressure bears, on any grid", test_places), &
         new_unittest("derivatives of a limited traction's heat are difference quotients", test_slopes), &
         new_unittest("one multiplier of all limits makes the parts' shear a force, where there is one", test_multiplier)]
   end subroutine collect_ehl_energy

   !> Roller that its needles hold in oil of 95 degC: the free shear is fifteen times the limit, most of it in the pressure's spike.
   pure function held_contact() result(contact)
      type(ehl_contact_t) :: contact

      contact%modulus = 2.018e11_wp
      contact%radius = 5.743e-3_wp
      contact%line_load = 4.629e4_wp
      contact%entrainment_speed = 2.509_wp
      contact%sliding_speed = 4.444_wp
      contact%oil%pressure_law = law_cameron
      contact%oil%viscosity = 0.01_wp
      contact%oil%pressure_viscosity = 2.2e-8_wp
      allocate (contact%heat)
      contact%heat%hot = hot_oil_t(0.0271_wp, 0.00428_wp, 0.0_wp)
      contact%heat%bodies = body_t(46.0_wp, 1.27e-5_wp)
      contact%heat%speeds = [4.731_wp, 0.287_wp]
      contact%heat%conductivity = 0.14_wp
      contact%heat%capacity = 1.65e6_wp
      contact%heat%expansion = 6.5e-4_wp
      contact%heat%temperature = 368.15_wp
      contact%heat%limiting_coefficient = 0.08_wp
   end function held_contact

   subroutine test_places(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films
      type(heat_made_t) :: made
      ! Shear stress of a cell over what the limiting coefficient makes of its pressure [-]; limit of the traction over length
      ! [N/m]; largest rise [K]
      real(wp), allocatable :: part(:)
      real(wp) :: limit, rise(2)
      integer :: i

      contact = held_contact()
      do i = 1, 2
         call solve(contact, problem, grid, state, films, error, nodes=merge(129, 257, i == 1))
         if (allocated(error)) return
         call find_heat(problem, grid, state, made)
         associate (p => problem%pressure_scale*state%fields%pressure, n => grid%size)
            part = made%sliding/(contact%sliding_speed*contact%heat%limiting_coefficient*problem%length_scale*grid%step &
               & *max(0.5_wp*(p(:n - 1) + p(2:)), 1.0e3_wp))
         end associate
         call check(error, maxval(part) < 1.2_wp, "a stress beyond its limit")
         if (allocated(error)) return
         limit = contact%heat%limiting_coefficient*contact%line_load
         call check_close(error, sum(made%sliding), contact%sliding_speed*limit &
            & *tanh(films%shear_slope*contact%sliding_speed/limit), 1.0e-10_wp, "heat of the limited traction")
         if (allocated(error)) return
         rise(i) = maxval(state%fields%rise)
      end do
      ! The spike goes on to grow with the nodes, as it does where the stress of each place is limited
      call check_close(error, rise(1), rise(2), 0.05_wp, "largest rise")
   end subroutine test_places

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state, changed
      type(ehl_films_t) :: films
      type(heat_made_t) :: made, sides(2)
      ! Change of the rise at a node [K]; derivative of all heat over it, by differences and as it is given [W/(m K)]
      real(wp), parameter :: change = 1.0e-3_wp
      real(wp), allocatable :: differences(:), slopes(:)
      integer :: i, j, k

      do i = 1, 2
         contact = held_contact()
         contact%heat%limit_fall = 3.0e-3_wp
         ! Less slip, so that the limit is felt and not reached
         if (i == 2) contact%sliding_speed = 0.1_wp
         call solve(contact, problem, grid, state, films, error)
         if (allocated(error)) return
         call find_heat(problem, grid, state, made)
         allocate (differences(grid%size), slopes(grid%size), source=0.0_wp)
         do j = 2, grid%size - 1
            changed = state
            do k = 1, 2
               changed%fields%rise(j) = state%fields%rise(j) + merge(change, -change, k == 1)
               call evaluate_oil(problem, grid, changed%total, changed%fields)
               call find_heat(problem, grid, changed, sides(k))
            end do
            differences(j) = sum(sides(1)%sliding - sides(2)%sliding + sides(1)%compression - sides(2)%compression)/(2.0_wp*change)
            slopes(j) = sum(made%part)*made%by_limit(j) + made%slopes(2, j - 1) + made%slopes(1, j)
         end do
         ! Heat of compression follows the density as well, and the shear of a cell its neighbours a little
         call check_scaled(error, maxval(abs(slopes - differences)), 0.0_wp, maxval(abs(differences)), 0.1_wp, "slopes")
         if (allocated(error)) return
         deallocate (differences, slopes)
      end do
   end subroutine test_slopes

   subroutine test_multiplier(error)
      type(error_type), allocatable, intent(out) :: error
      ! Shear of the parts and their limits [N/m]
      real(wp), parameter :: free(1, 3) = reshape([1.0_wp, 2.0_wp, 30.0_wp], [1, 3]), &
         & limits(1, 3) = reshape([2.0_wp, 1.0_wp, 1.0_wp], [1, 3])
      real(wp) :: multiplier

      ! Sharp: the first part free, the others at 1.5 times their limits
      call check_close(error, common_multiplier(cap_sharp, free, limits, 4.0_wp), 1.5_wp, 1.0e-11_wp, "sharp limits")
      if (allocated(error)) return
      multiplier = common_multiplier(cap_smooth, free, limits, 3.9_wp)
      call check_close(error, sum(multiplier*limits*tanh(free/(multiplier*limits))), 3.9_wp, 1.0e-11_wp, "smooth limits")
      if (allocated(error)) return
      ! All of the shear: no limit is felt
      multiplier = common_multiplier(cap_smooth, free, limits, 33.0_wp)
      call check_close(error, sum(multiplier*limits*tanh(free/(multiplier*limits))), 33.0_wp, 1.0e-10_wp, "free shear")
   end subroutine test_multiplier

end module test_ehl_energy
