!> Steady films that Newton's method does not find from a start, and viscosities beyond what a number holds.
module test_ehl_settling
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_lubricant, only : oil_t, relative_viscosity, log_relative_viscosity, law_barus, law_roelands
   use camroller_ehl_grid, only : ehl_grid_t, deformation
   use camroller_ehl_problem, only : ehl_problem_t, new_ehl_problem
   use camroller_ehl_reynolds, only : mean_fluidity, new_ehl_fields
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_settling, only : settle
   use camroller_ehl_solution, only : ehl_options_t, make_grid, solve_cold, solve_on_grids
   use camroller_ehl_films, only : ehl_films_t
   use closeness, only : check_close
   use ehl_contacts, only : contact_of_groups
   implicit none
   private

   public :: collect_ehl_settling

contains

   subroutine collect_ehl_settling(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a film integrated to steady state from a distant start is that of Newton's method", test_same), &
         new_unittest("contacts with pressure spikes for which Newton's method oscillates are solved on every grid", test_spikes), &
         new_unittest("the logarithm of the viscosity has its exact slope, also beyond the largest representable viscosity", &
            & test_logarithm), &
         new_unittest("slopes of the mean fluidity agree with difference quotients for any ratio of viscosities", test_fluidity) &
         ]
   end subroutine collect_ehl_settling

   subroutine test_same(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: found, settled
      ! Deformation [-]
      real(wp) :: gap(129)
      integer :: status
      logical :: converged

      call new_ehl_problem(problem, contact_of_groups(3.0e-5_wp, 1.0e-11_wp, 4500.0_wp), status)
      call make_grid(problem, ehl_options_t(), 129, grid)
      call solve_cold(problem, grid, 1.0e-9_wp, found, converged)
      call check(error, converged, "no film")
      if (allocated(error)) return
      ! Half of the pressure of a dry contact, and a gap that is far too large
      call new_ehl_fields(settled%fields, 129)
      settled%total = 0.5_wp*sqrt(max((1.0_wp - grid%x)*(1.0_wp + grid%x), 0.0_wp))
      gap = deformation(grid, settled%total)
      settled%level = 2.0_wp - gap(minloc(abs(grid%x), dim=1))
      call settle(problem, grid, settled, 1.0e-9_wp, converged)
      call check(error, converged, "does not settle")
      if (allocated(error)) return
      ! Both leave 1e-9 of the peak of the dry contact
      call check(error, maxval(abs(settled%total - found%total)) < 1.0e-7_wp, "another pressure")
      if (.not. allocated(error)) call check(error, maxval(abs(settled%fields%film/found%fields%film - 1.0_wp)) < 1.0e-7_wp, &
         & "another film")
   end subroutine test_same

   subroutine test_spikes(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_problem_t) :: problem
      type(ehl_options_t) :: options
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films, coarse
      ! Soft bodies at 360 MPa with a Roelands' index of 2.7: viscosities up to exp(900)
      real(wp), parameter :: speeds(4) = [3.1622776601683795e-12_wp, 1.0e-10_wp, 3.1622776601683795e-10_wp, 1.0e-9_wp]
      integer, parameter :: sizes(3) = [65, 129, 257]
      integer :: i, k, status
      logical :: converged
      character(len=64) :: text

      do i = 1, size(speeds)
         call new_ehl_problem(problem, contact_of_groups(3.1622776601683794e-4_wp, speeds(i), 4500.0_wp, 5.0e10_wp), status)
         do k = 1, size(sizes)
            options%nodes = sizes(k)
            call solve_on_grids(problem, options, grid, state, films, coarse, converged)
            write (text, "(a, es10.2, a, i4)") "U ", speeds(i), ", nodes ", sizes(k)
            call check(error, converged, "no film: "//trim(text))
            if (allocated(error)) return
            call check(error, films%load_lack < 1.0e-12_wp .and. films%flow_lack < 1.0e-6_wp, "load or flow: "//trim(text))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_spikes

   subroutine test_logarithm(error)
      type(error_type), allocatable, intent(out) :: error
      type(oil_t) :: oil
      ! ln of the viscosity ratio and its slope [-], [1/Pa]; the same by the ratio; values on either side, distance of both [Pa]
      real(wp) :: value, slope, ratio(1), log_slope(1), sides(2), unused
      real(wp), parameter :: distance = 1.0e3_wp
      integer :: law

      oil%pressure_viscosity = 2.2e-8_wp
      oil%roelands_exponent = 6.2_wp
      oil%roelands_index = 0.7_wp
      do law = law_barus, law_roelands
         oil%pressure_law = law
         call log_relative_viscosity(oil, 4.0e8_wp, value, slope)
         call relative_viscosity(oil, [4.0e8_wp], ratio, log_slope)
         call check_close(error, value, log(ratio(1)), 100.0_wp*epsilon(1.0_wp), "logarithm")
         if (.not. allocated(error)) call check_close(error, slope*4.0e8_wp, log_slope(1), 100.0_wp*epsilon(1.0_wp), "slope")
         if (allocated(error)) return
         ! A hundred times as high: a viscosity that no number holds by Barus' law
         call log_relative_viscosity(oil, 4.0e10_wp, value, slope)
         call log_relative_viscosity(oil, 4.0e10_wp - distance, sides(1), unused)
         call log_relative_viscosity(oil, 4.0e10_wp + distance, sides(2), unused)
         ! A quotient of roundings of the value over the difference of the values
         call check_close(error, (sides(2) - sides(1))/(2.0_wp*distance), slope, &
            & 10.0_wp*epsilon(1.0_wp)*value/(slope*distance), "slope at high pressure")
         if (allocated(error)) return
      end do
   end subroutine test_logarithm

   subroutine test_fluidity(error)
      type(error_type), allocatable, intent(out) :: error
      ! Mean and slopes; means on either side; their slopes, not used [-]
      real(wp) :: mean, slopes(2), sides(2), unused(2)
      real(wp), parameter :: first = 3.0_wp, distance = 1.0e-4_wp
      real(wp), parameter :: differences(8) = [0.0_wp, 1.0e-3_wp, 0.049_wp, 0.051_wp, 1.0_wp, 10.0_wp, 700.0_wp, 5000.0_wp]
      integer :: i, k
      ! Values at both ends, and what is added to them [-]
      real(wp) :: ends(2), step(2)

      do i = 1, size(differences)
         do k = 1, 4
            ends = [first, first + differences(i)]
            if (k > 2) ends = ends(2:1:-1)
            step = merge([distance, 0.0_wp], [0.0_wp, distance], modulo(k, 2) == 1)
            call mean_fluidity(ends(1), ends(2), mean, slopes)
            call mean_fluidity(ends(1) - step(1), ends(2) - step(2), sides(1), unused)
            call mean_fluidity(ends(1) + step(1), ends(2) + step(2), sides(2), unused)
            ! The quotient leaves a sixth of the square of its distance; the mean, a quotient itself, has 20 roundings at 0.05
            call check(error, abs((sides(2) - sides(1))/(2.0_wp*distance) - slopes(2 - modulo(k, 2))) &
               & <= (distance**2 + 40.0_wp*epsilon(1.0_wp)/distance)*mean, "slope of the mean")
            if (allocated(error)) return
            if (differences(i) > 0.0_wp) call check_close(error, mean, exp(-first)*(1.0_wp - exp(-differences(i)))/differences(i), &
               & 1.0e-12_wp, "mean")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_fluidity

end module test_ehl_settling
