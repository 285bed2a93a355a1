!> Energy equation of a solved contact: surfaces, film, balance, inlet, coupling with the film, and the cycle.
module test_ehl_heat
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_case, only : case_t
   use camroller_conjunction, only : band_mean, body_t, hot_oil_t
   use camroller_ehl_energy, only : ehl_energy_t, find_heat, heat_made_t, new_energy, solve_energy
   use camroller_ehl_films, only : ehl_films_t, get_films, limit_cells
   use camroller_ehl_grid, only : ehl_grid_t, integral, new_uniform_grid
   use camroller_ehl_heat, only : start_heat
   use camroller_ehl_newton, only : ehl_state_t
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem
   use camroller_ehl_profiles, only : make_profiles
   use camroller_ehl_record, only : column, ehl_record_t
   use camroller_ehl_reynolds, only : evaluate_oil, new_ehl_fields
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film, solve_on_grids
   use camroller_ehl_table, only : ehl_t
   use camroller_ehl_walls, only : surface_response
   use camroller_error, only : error_t
   use camroller_heat, only : inlet_factor, inlet_murch_wilson
   use camroller_lubricant, only : law_barus, law_cameron
   use camroller_model, only : model_t, new_model
   use camroller_number_text, only : number_text
   use camroller_result, only : result_t
   use camroller_state, only : state_t, evaluate_state
   use camroller_traction, only : cap_smooth
   use closeness, only : check_close, has_failed
   use lobe_cases, only : run
   use reference_cases, only : add_heat, point_speeds, point_viscosities, set_point, thesis_case
   use labelled_table, only : read_table
   implicit none
   private

   public :: collect_ehl_heat, solve

   !> Steel: conductivity [W/(m K)], heat capacity over volume [J/(m^3 K)]
   real(wp), parameter :: steel = 46.0_wp, steel_capacity = 7850.0_wp*460.0_wp

contains

   subroutine collect_ehl_heat(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("surfaces under an even heat flux have the rise of Jaeger's band, either way they move", test_band), &
         new_unittest("a film that conducts all of its heat has the closed form's rise", test_conduction), &
         new_unittest("a film that conducts none of its heat carries all of it off", test_adiabatic), &
         new_unittest("heat made is heat carried off and conducted, with limited shear and asperities", test_balance), &
         new_unittest("a stress limited at each point: heat is the power of the traction, all of it leaves, and without heat "// &
            & "the largest traction is Lambda times the load", test_local_limit), &
         new_unittest("an oil whose viscosity and density ignore temperature has the isothermal film to the last bit", test_cold), &
         new_unittest("heat of the inlet reduces the film of pure rolling as Murch and Wilson have it", test_inlet), &
         new_unittest("rises are those of a film whose temperature is resolved across it", test_resolved), &
         new_unittest("film and rise converge with the nodes", test_grids), &
         new_unittest("contacts along a cycle are warm, and their films thinner than without heat", test_profiles), &
         new_unittest("thick films whose first heat is far too much are found, each from nothing", test_thick), &
         new_unittest("a numerical film as a law takes the factor of the inlet", test_law) &
         ]
   end subroutine collect_ehl_heat

   !> A contact of cam and roller at 60 degC, as warm as its heat makes it.
   pure function hot_contact(speed, slide) result(contact)
      !> Mean speed of the surfaces [m/s], sliding speed over it [-]
      real(wp), intent(in) :: speed, slide
      type(ehl_contact_t) :: contact

      contact%modulus = 2.0e11_wp
      contact%radius = 0.0125_wp
      contact%line_load = 7.3e4_wp
      contact%entrainment_speed = speed
      contact%sliding_speed = slide*speed
      contact%oil%pressure_law = law_cameron
      contact%oil%viscosity = 0.0305_wp
      contact%oil%pressure_viscosity = 2.2e-8_wp
      allocate (contact%heat)
      contact%heat%hot = hot_oil_t(0.045_wp, 0.008_wp, 0.005_wp)
      contact%heat%bodies = body_t(steel, steel/steel_capacity)
      contact%heat%speeds = speed*[1.0_wp + 0.5_wp*slide, 1.0_wp - 0.5_wp*slide]
      contact%heat%conductivity = 0.14_wp
      contact%heat%capacity = 1.74e6_wp
      contact%heat%expansion = 6.5e-4_wp
      contact%heat%temperature = 333.15_wp
      contact%heat%limiting_coefficient = 0.08_wp
   end function hot_contact

   !> Solve a contact on 129 nodes, or as many as given.
   subroutine solve(contact, problem, grid, state, films, error, nodes)
      type(ehl_contact_t), intent(in) :: contact
      type(ehl_problem_t), intent(out) :: problem
      type(ehl_grid_t), intent(out) :: grid
      type(ehl_state_t), intent(out) :: state
      type(ehl_films_t), intent(out) :: films
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: nodes
      type(ehl_options_t) :: options
      type(ehl_films_t) :: coarse
      integer :: status
      logical :: converged

      if (present(nodes)) options%nodes = nodes
      call new_ehl_problem(problem, contact, status)
      call solve_on_grids(problem, options, grid, state, films, coarse, converged)
      call check(error, status == 0 .and. converged, "no solution")
   end subroutine solve

   subroutine test_band(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: nodes = 257
      real(wp), parameter :: half_width = 1.0e-4_wp, numbers(5) = [1.0e-2_wp, 0.3_wp, 3.0_wp, 30.0_wp, 3.0e4_wp]
      type(ehl_grid_t) :: grid
      type(body_t) :: body
      ! Rises per flux [m^2 K/W], mean over q b/k and its slope [-], speed [m/s]
      real(wp), allocatable :: response(:, :)
      real(wp) :: rise(nodes), mean, slope, speed
      integer :: i

      body = body_t(steel, steel/steel_capacity)
      call new_uniform_grid(grid, nodes, 1.0_wp, 1.0_wp)
      do i = 1, size(numbers)
         speed = numbers(i)*body%diffusivity/half_width
         response = surface_response(grid, body, speed, half_width)
         rise = sum(response, dim=2)
         call band_mean(numbers(i), mean, slope)
         ! What the trapezoidal rule makes of the steep rise at the edge where the flux begins
         call check_close(error, 0.5_wp*integral(grid, rise), mean*half_width/steel, 5.0e-4_wp, "mean over the band")
         if (allocated(error)) return
         rise = rise(nodes:1:-1) - sum(surface_response(grid, body, -speed, half_width), dim=2)
         call check(error, maxval(abs(rise)) < 1.0e-12_wp*mean*half_width/steel, "a surface that moves the other way differs")
         if (allocated(error)) return
      end do
      ! Fast: half space under constant flux since the edge, less what leads ahead of the edge; next order 1/(8 V b/kappa)
      call check_close(error, sum(response(nodes, :)), 2.0_wp*sqrt(2.0_wp*half_width/(pi*steel*steel_capacity*speed)) &
         & *(1.0_wp - 1.0_wp/sqrt(2.0_wp*pi*numbers(5))), 1.0e-5_wp, "largest rise")
   end subroutine test_band

   subroutine test_conduction(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films
      ! Stress of the film in the middle of the contact [Pa], its film [m], viscosity there [Pa s]
      real(wp) :: stress, film, viscosity
      integer :: middle

      contact = hot_contact(0.5_wp, 0.1_wp)
      contact%heat%capacity = 1.0e-3_wp
      contact%heat%bodies%conductivity = 1.0e9_wp
      contact%heat%expansion = 0.0_wp
      contact%heat%limiting_coefficient = 1.0e6_wp
      call solve(contact, problem, grid, state, films, error, 513)
      if (allocated(error)) return
      middle = minloc(abs(grid%x), dim=1)
      film = state%fields%film(middle)*problem%film_scale
      viscosity = contact%oil%viscosity*exp(state%fields%log_viscosity(middle))
      stress = viscosity*contact%sliding_speed/film
      ! The heat about a node is that of two cells
      call check_close(error, state%fields%rise(middle), stress**2*film**2/(12.0_wp*viscosity*contact%heat%conductivity), &
         & 1.0e-3_wp, "rise of a film between cold surfaces")
      if (allocated(error)) return
      call check(error, state%fields%rise(middle) > 1.0e-3_wp, "nothing is warm")
   end subroutine test_conduction

   subroutine test_adiabatic(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films
      type(heat_made_t) :: made
      real(wp) :: carried ! Heat that leaves with the oil [W/m]

      contact = hot_contact(2.0_wp, 0.02_wp)
      contact%heat%conductivity = 1.0e-9_wp
      contact%heat%capacity = 1.0e8_wp
      call solve(contact, problem, grid, state, films, error)
      if (allocated(error)) return
      call find_heat(problem, grid, state, made)
      carried = contact%heat%capacity*contact%entrainment_speed*films%flow*state%fields%rise(grid%size)
      call check_close(error, carried, sum(made%sliding + made%driven + made%compression), 1.0e-6_wp, "heat that the oil carries")
      if (allocated(error)) return
      call check(error, state%fields%rise(grid%size) > 1.0_wp, "nothing is warm")
   end subroutine test_adiabatic

   subroutine test_balance(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films
      type(heat_made_t) :: made
      ! Heat that leaves with the oil and through the surfaces [W/m]; heat of sliding by the friction that the films give [W/m]
      real(wp) :: carried, conducted, sliding, limit
      integer :: i

      do i = 1, 3
         contact = hot_contact(6.0_wp, 0.3_wp)
         if (i == 2) contact%heat%limit_fall = 3.0e-3_wp
         if (i == 3) contact = hot_contact(1.0_wp, -0.3_wp)
         call solve(contact, problem, grid, state, films, error)
         if (allocated(error)) return
         call find_heat(problem, grid, state, made)
         carried = contact%heat%capacity*contact%entrainment_speed*films%flow*state%fields%rise(grid%size)
         conducted = problem%length_scale*integral(grid, state%fields%flux(:, 1))
         call check_close(error, carried + conducted, sum(made%sliding + made%driven + made%compression), 1.0e-6_wp, &
            & "heat that leaves the film")
         if (allocated(error)) return
         limit = contact%heat%limiting_coefficient*films%limit_part*contact%line_load
         sliding = abs(contact%sliding_speed)*limit*tanh(films%shear_slope*abs(contact%sliding_speed)/limit)
         call check_close(error, sum(made%sliding), sliding, 1.0e-6_wp, "heat of sliding and power of the traction")
         if (allocated(error)) return
      end do
   end subroutine test_balance

   subroutine test_local_limit(error)
      type(error_type), allocatable, intent(out) :: error
      ! tau_L0 [Pa], Lambda [-]
      real(wp), parameter :: stress = 2.0e6_wp, coefficient = 0.04_wp
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films
      type(heat_made_t) :: made
      ! Heat that leaves [W/m]; shear of the film [N/m] and its slope [Pa s/m]
      real(wp) :: left, shear, slope
      integer :: i

      do i = 1, 2
         contact = hot_contact(6.0_wp, 0.3_wp)
         contact%heat%limiting_coefficient = coefficient
         contact%heat%limiting_stress = stress
         contact%heat%has_local_limit = .true.
         if (i == 2) contact%heat%limit_fall = 3.0e-3_wp
         call solve(contact, problem, grid, state, films, error)
         if (allocated(error)) return
         problem%keeps_cells = .true.
         call get_films(problem, grid, state, films)
         call find_heat(problem, grid, state, made)
         left = contact%heat%capacity*contact%entrainment_speed*films%flow*state%fields%rise(grid%size) &
            & + problem%length_scale*integral(grid, state%fields%flux(:, 1))
         call check_close(error, left, sum(made%sliding + made%driven + made%compression), 1.0e-6_wp, "heat that leaves the film")
         if (allocated(error)) return
         call limit_cells(films%cells, contact%heat%cap, coefficient, stress, abs(contact%sliding_speed), shear, slope)
         call check_close(error, sum(made%sliding), abs(contact%sliding_speed)*shear, 1.0e-12_wp, &
            & "heat of sliding and power of the traction")
         if (allocated(error)) return
         call check(error, shear < 0.99_wp*films%shear_slope*abs(contact%sliding_speed), "no limit is reached")
         if (allocated(error)) return
      end do
      deallocate (contact%heat)
      call solve(contact, problem, grid, state, films, error)
      if (allocated(error)) return
      problem%keeps_cells = .true.
      call get_films(problem, grid, state, films)
      ! So fast that all of the film is at its limit; the sum of cells is the integral by trapezoids, to the cell in which the film
      ! ends
      call limit_cells(films%cells, cap_smooth, coefficient, 0.0_wp, 1.0e9_wp, shear, slope)
      call check_close(error, shear, coefficient*contact%line_load, 1.0e-4_wp, "largest traction")
   end subroutine test_local_limit

   subroutine test_cold(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: warm, cold
      real(wp) :: largest_rise ! [K]

      contact = hot_contact(6.0_wp, 0.3_wp)
      contact%heat%hot = hot_oil_t()
      contact%heat%expansion = 0.0_wp
      call solve(contact, problem, grid, state, warm, error)
      if (allocated(error)) return
      largest_rise = maxval(state%fields%rise)
      deallocate (contact%heat)
      call solve(contact, problem, grid, state, cold, error)
      if (allocated(error)) return
      call check(error, all(transfer([warm%central, warm%minimum, warm%rolling, warm%shear_slope], [0]) &
         & == transfer([cold%central, cold%minimum, cold%rolling, cold%shear_slope], [0])), "bits differ")
      if (allocated(error)) return
      call check(error, largest_rise > 10.0_wp, "nothing is warm")
   end subroutine test_cold

   subroutine test_inlet(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_contact_t) :: contact
      type(ehl_films_t) :: hot, cold
      type(error_t), allocatable :: failure
      real(wp), parameter :: speeds(3) = [2.0_wp, 4.0_wp, 8.0_wp]
      ! ln of the factor and slopes, not used
      real(wp) :: factor, by_speed, by_sliding, by_pressure, loading
      integer :: i

      do i = 1, size(speeds)
         contact = hot_contact(speeds(i), 0.0_wp)
         contact%heat%hot = hot_oil_t(0.045_wp, 0.0_wp, 0.0_wp)
         loading = contact%heat%hot%coefficient*contact%oil%viscosity/contact%heat%conductivity
         call solve_contact_film(contact, ehl_options_t(), hot, failure)
         if (.not. allocated(failure)) then
            deallocate (contact%heat)
            call solve_contact_film(contact, ehl_options_t(), cold, failure)
         end if
         if (has_failed(failure, error)) return
         call inlet_factor(inlet_murch_wilson, loading, speeds(i), 0.0_wp, 0.0_wp, factor, by_speed, by_sliding, by_pressure)
         ! Theirs is a power of L fitted to a rigid inlet between cold surfaces: 25 % more here where L is 0.6, 25 % less at 0.04
         call check_close(error, log(hot%central/cold%central), factor, 0.3_wp, "reduction of the film")
         if (allocated(error)) return
      end do
   end subroutine test_inlet

   !> Film of even thickness under a half ellipse of pressure, by `test/reference/film_heat_reference.py`.
   subroutine test_resolved(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: nodes = 121
      type(ehl_problem_t) :: problem
      type(ehl_energy_t) :: energy
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      real(wp), allocatable :: rows(:, :)
      ! Rise of film and surfaces over their largest [-]; largest heat [W/m^2]
      real(wp) :: off(3), largest(3)
      integer :: i, k
      logical :: converged

      call read_table("film_heat_reference.csv", 7, rows, error)
      if (allocated(error)) return
      call new_uniform_grid(grid, nodes, 1.5_wp, 1.5_wp)
      do k = 1, size(rows, 2), 7
         call even_film(rows(1, k), rows(2, k), grid, problem, state)
         call new_energy(energy, problem, grid)
         call solve_energy(problem, grid, energy, state, 1.0e-9_wp, converged)
         call check(error, converged, "no temperature")
         if (allocated(error)) return
         largest = [maxval(rows(4, k:k + 6)), maxval(rows(5, k:k + 6)), maxval(rows(6, k:k + 6))]
         off = 0.0_wp
         do i = k, k + 6
            associate (here => minloc(abs(grid%x - rows(3, i)), dim=1), fields => state%fields)
               off = max(off, abs([fields%rise(here), fields%surface_rise(here, :)] - rows(4:6, i))/largest)
            end associate
         end do
         ! Where the film is 30 K warmer than its surfaces, its hot middle shears more easily than oil of the mean temperature, so
         ! that a sixth less heat reaches the surfaces; where it is 1 K warmer, nothing of that is left
         call check(error, off(1) < 5.0e-2_wp, "rises of the film differ by "//number_text(off(1), 3))
         if (allocated(error)) return
         call check(error, maxval(off(2:)) < merge(0.2_wp, 2.0e-2_wp, largest(1) > 2.0_wp), &
            & "rises of the surfaces differ by "//number_text(maxval(off(2:)), 3))
         if (allocated(error)) return
      end do
      call check(error, size(rows, 2), 21)
   end subroutine test_resolved

   !> The film of that reference, without heat so far.
   subroutine even_film(speed, sliding_speed, grid, problem, state)
      real(wp), intent(in) :: speed, sliding_speed
      type(ehl_grid_t), intent(in) :: grid
      type(ehl_problem_t), intent(out) :: problem
      type(ehl_state_t), intent(out) :: state
      type(ehl_contact_t) :: contact

      contact = hot_contact(speed, sliding_speed/speed)
      problem%heat = contact%heat
      problem%heat%hot = hot_oil_t(0.045_wp, 0.0_wp, 0.0_wp)
      problem%heat%limiting_coefficient = 1.0e6_wp
      problem%oil%pressure_law = law_barus
      problem%oil%viscosity = 0.03_wp
      problem%oil%pressure_viscosity = 1.5e-8_wp
      problem%is_compressible = .false.
      problem%length_scale = 1.0e-4_wp
      problem%film_scale = 1.0e-6_wp
      problem%pressure_scale = 0.6e9_wp
      problem%speed = 1.0_wp
      problem%expected_film = 1.0_wp
      problem%entrainment_speed = speed
      problem%sliding_speed = sliding_speed
      call new_ehl_fields(state%fields, grid%size)
      call start_heat(grid, state%fields)
      state%total = sqrt(max(1.0_wp - grid%x**2, 0.0_wp))
      state%level = 0.0_wp
      state%fields%film = 1.0_wp
      state%fields%flow = 1.0_wp
      allocate (state%is_full(grid%size), source=.true.)
      call evaluate_oil(problem, grid, state%total, state%fields)
   end subroutine even_film

   subroutine test_grids(error)
      type(error_type), allocatable, intent(out) :: error
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_films_t) :: films(3)
      integer :: i

      do i = 1, 3
         call solve(hot_contact(6.0_wp, 0.3_wp), problem, grid, state, films(i), error, 2**(5 + i) + 1)
         if (allocated(error)) return
      end do
      call check_close(error, films(1)%central, films(3)%central, 1.0e-3_wp, "central film on 65 nodes")
      if (allocated(error)) return
      call check_close(error, films(2)%central, films(3)%central, 3.0e-4_wp, "central film on 129 nodes")
      if (allocated(error)) return
      call check_close(error, films(2)%shear_slope, films(3)%shear_slope, 1.0e-2_wp, "shear on 129 nodes")
   end subroutine test_grids

   !> Every twentieth angle of a run at 900 rev/min in cold oil.
   subroutine test_profiles(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(result_t) :: result
      type(ehl_record_t) :: cold, warm
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: gaps

      case = thesis_case()
      call set_point(case, point_speeds(3), point_viscosities(1))
      call run(case, result, error)
      if (allocated(error)) return
      result%angle = result%angle(::20)
      result%series_values = result%series_values(::20, :)
      call make_profiles(cold, case, result, gaps, failure)
      if (.not. allocated(failure)) then
         call add_heat(case)
         call make_profiles(warm, case, result, gaps, failure)
      end if
      if (has_failed(failure, error)) return
      call check(error, .not. allocated(cold%film_rise), "a temperature without heat")
      if (allocated(error)) return
      associate (part => column(warm, "film_central")/column(cold, "film_central"))
         call check(error, all(part < 1.0_wp) .and. all(part > 0.85_wp) .and. minval(part) < 0.97_wp, "films")
      end associate
      if (allocated(error)) return
      call check(error, all(maxval(warm%film_rise, dim=1) > 0.0_wp) .and. maxval(warm%film_rise) > 3.0_wp &
         & .and. maxval(warm%film_rise) < 100.0_wp, "rises")
   end subroutine test_profiles

   !> At 3000 rev/min with oil of 25 degC the heat of the cold film takes the viscosity down to a sixth, on nodes that reach 3000
   !> half widths upstream for the sake of the lightest load.
   subroutine test_thick(error)
      type(error_type), allocatable, intent(out) :: error
      ! Cam angles [deg]
      real(wp), parameter :: angles(3) = [131.0_wp, 136.0_wp, 138.5_wp]
      type(case_t) :: case
      type(result_t) :: result, one
      type(ehl_record_t) :: warm
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: gaps
      integer :: i, k

      case = thesis_case()
      call set_point(case, 100.0_wp*pi, point_viscosities(1))
      call add_heat(case)
      call run(case, result, error)
      if (allocated(error)) return
      do i = 1, size(angles)
         k = minloc(abs(result%angle - angles(i)), dim=1)
         one = result
         one%angle = result%angle(k:k)
         one%series_values = result%series_values(k:k, :)
         call make_profiles(warm, case, one, gaps, failure)
         if (has_failed(failure, error)) return
         call check(error, maxval(warm%film_rise) > 10.0_wp .and. maxval(warm%film_rise) < 40.0_wp, "rise")
         if (allocated(error)) return
      end do
   end subroutine test_thick

   subroutine test_law(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(state_t) :: states(2)
      type(error_t), allocatable :: failure
      integer :: i, status

      case = thesis_case()
      call set_point(case, point_speeds(3), point_viscosities(1))
      case%ehl = ehl_t(accuracy=0.1_wp)
      do i = 1, 2
         if (i == 2) call add_heat(case)
         call new_model(model, case, 1, failure)
         if (has_failed(failure, error)) return
         call evaluate_state(model, pi, 0.0_wp, states(i), status)
         call check(error, status, 0)
         if (allocated(error)) return
      end do
      call check(error, states(2)%contact%inlet_factor < 0.99_wp, "no heat in the inlet")
      if (allocated(error)) return
      ! The load follows the friction, which follows the film
      call check_close(error, states(2)%contact%film_central, states(1)%contact%film_central*states(2)%contact%inlet_factor, &
         & 1.0e-4_wp, "film")
   end subroutine test_law

end module test_ehl_heat
