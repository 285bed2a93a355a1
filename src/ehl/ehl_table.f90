!> Film thickness of an oil between two bodies as a function of speed and load, from numerical solutions.
!>
!> In: oil, modulus, ranges of the groups U and W*. Out: `film_table_t`. With oil and modulus given, the film relative to the
!> radius depends on U and W* alone, so some hundred solutions, each compared on two grids, serve every contact of a cycle. The
!> number of points is doubled over speed or load, whichever changes the table more, until solutions at new points agree with the
!> table through the others.
module camroller_ehl_table
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_convergence
   use camroller_lubricant, only : oil_t
   use camroller_film_table, only : film_table_t, most_terms, speed_points, load_points, new_film_table, halving_changes
   use camroller_ehl_problem, only : ehl_contact_t
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
   use camroller_ehl_films, only : ehl_films_t, chance_error
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: ehl_t, build_film_table

   !> Options of the numerical film
   type :: ehl_t
      !> Largest error of the film: of the grid, and of the table between its points [-]
      real(wp) :: accuracy = 1.0e-2_wp
      !> Does the density of the oil grow with the pressure?
      logical :: compressible = .true.
      !> Does sliding thin the oil that flows through profiles and contacts solved over the cycle, where the shear law is Eyring's?
      logical :: shear_thinning = .true.
      !> Does roughness hinder their flow?
      logical :: flow_factors = .false.
      !> Are pressure and film across the contact wanted of a run?
      logical :: profiles = .false.
   end type ehl_t

   !> What the points of a table have in common, and what became of them
   type :: task_t
      !> The oil
      type(oil_t) :: oil
      !> E' [Pa]
      real(wp) :: modulus
      !> Does the density of the oil grow with the pressure?
      logical :: is_compressible
      !> Lower and upper end of ln U, then of ln W* [-]
      real(wp) :: ends(2, 2)
      !> Allowed error of the grid, and the largest estimate [-]
      real(wp) :: grid_accuracy, grid_error = 0.0_wp
      !> Is there a contact that even the finest grid does not solve that well?
      logical :: is_limited = .false.
      !> Logarithms of minimum and central film over the radius at the points of speed and load [-]
      real(wp), allocatable :: films(:, :, :)
   end type task_t

   !> Polynomials over speed and over load: to begin with, and at most
   integer, parameter :: fewest_terms(2) = [3, 9], most_terms_each(2) = [33, most_terms]
   !> Most nodes across a contact; as many are taken as its accuracy requires
   integer, parameter :: most_nodes = 1025
   !> Part of what is stated of a grid that counts at the worst of many points: 0.1 to 0.63 of it were true there, on 65 and on
   !> 129 nodes, of 2880 contacts each for the oils and ranges of fourteen cases [-]
   real(wp), parameter :: grid_share = 2.0_wp/3.0_wp
   !> Part of the accuracy that the grid may take; what is left of it where noise of the solutions hides the polynomials, and at
   !> least [-]
   real(wp), parameter :: grid_part = 0.5_wp, finer_grid = 0.5_wp, least_grid_part = 0.02_wp
   !> What a doubling of the points leaves of their changes, at least as far as it is relied on [-]
   real(wp), parameter :: usual_rest = 0.5_wp
   !> Changes over the stated error of the grid up to which they may be noise [-]
   real(wp), parameter :: noise_limit = 1.5_wp
   !> What Newton's method may leave over, over the accuracy of the grid [-]
   real(wp), parameter :: leftover = 1.0e-5_wp
   !> Radius of the contacts that are solved [m]; films over the radius do not depend on it
   real(wp), parameter :: radius = 0.01_wp

contains

   !> Table of the film over ranges of U and W*.
   !>
   !> The number of points is doubled over speed or load, whichever changes more: by what films at the new points differ by from the
   !> polynomials through the others. What is left is taken as half of the last change, or more where the last doubling
   !> left more. The error stated is that over speed and over load together, and that of the grid. Where a doubling hardly
   !> helps and the changes are no larger than the error of the grid, the grid is made finer.
   subroutine build_film_table(table, setup, oil, modulus, speeds, loads, error)
      !> The table
      type(film_table_t), intent(out) :: table
      !> Accuracy and density
      type(ehl_t), intent(in) :: setup
      !> The oil
      type(oil_t), intent(in) :: oil
      !> E' [Pa]
      real(wp), intent(in) :: modulus
      !> Smallest and largest U, then W* [-]
      real(wp), intent(in) :: speeds(2), loads(2)
      !> Domain error beyond the range of solutions; convergence error where the accuracy is not reached
      type(error_t), allocatable, intent(out) :: error

      type(task_t) :: task
      ! Changes over speed and load, now and before the last doubling; part of them that is left; stated error [-]
      real(wp) :: changes(2), before(2), rest(2), stated
      integer :: terms(2), along
      logical :: is_noise

      task%oil = oil
      task%modulus = modulus
      task%is_compressible = setup%compressible
      task%ends(:, 1) = log(speeds)
      task%ends(:, 2) = log(loads)
      task%grid_accuracy = grid_part/grid_share*setup%accuracy
      terms = fewest_terms
      rest = usual_rest
      along = 0
      do
         call solve_points(task, terms, error)
         if (allocated(error)) return
         changes = halving_changes(task%films)
         if (along > 0) rest(along) = min(max(changes(along)/before(along), usual_rest), 1.0_wp)
         stated = sum(rest*changes) + grid_share*task%grid_error
         ! Whatever their number, points are no better than their grids
         if (stated <= setup%accuracy .or. grid_share*task%grid_error >= setup%accuracy) exit
         is_noise = .false.
         if (along > 0) is_noise = rest(along) > usual_rest .and. changes(along) < noise_limit*task%grid_error
         if (is_noise) then
            task%grid_accuracy = finer_grid*task%grid_accuracy
            if (task%is_limited .or. task%grid_accuracy < least_grid_part*setup%accuracy) exit
            deallocate (task%films)
         else
            along = maxloc(rest*changes, dim=1, mask=terms < most_terms_each)
            if (along == 0) exit
            before = changes
            terms(along) = 2*terms(along) - 1
         end if
      end do
      call new_film_table(table, task%ends, task%films)
      table%error = stated
      if (stated <= setup%accuracy) return
      call raise(error, kind_convergence, "ehl: error of the film "//number_text(stated, 2)//" instead of "// &
         & number_text(setup%accuracy, 2)//"; choose a larger ehl.accuracy")
   end subroutine build_film_table

   !> Films at all points, of which those of fewer points may be known.
   subroutine solve_points(task, terms, error)
      !> The task with its films, if any; all of them are there afterwards
      type(task_t), intent(inout) :: task
      !> Number of points over speed and load
      integer, intent(in) :: terms(2)
      !> Domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Films that are known [-]
      real(wp), allocatable :: known(:, :, :)
      ! Logarithms of speeds, and of loads at one speed [-]
      real(wp) :: log_speeds(terms(1)), log_loads(terms(2))
      ! Logarithms of both films at one point [-]
      real(wp) :: both(2)
      integer :: steps(2), i, k

      steps = 0
      if (allocated(task%films)) then
         call move_alloc(task%films, known)
         steps = (terms - 1)/([size(known, 1), size(known, 2)] - 1)
      else
         task%grid_error = 0.0_wp
         task%is_limited = .false.
      end if
      allocate (task%films(terms(1), terms(2), 2))
      log_speeds = speed_points(task%ends(:, 1), terms(1))
      do i = 1, terms(1)
         log_loads = load_points(task%ends(:, 2), log_speeds(i), terms(2))
         do k = 1, terms(2)
            if (allocated(known)) then
               if (all(mod([i, k] - 1, steps) == 0)) then
                  task%films(i, k, :) = known((i - 1)/steps(1) + 1, (k - 1)/steps(2) + 1, :)
                  cycle
               end if
            end if
            call solve_at(task, [log_speeds(i), log_loads(k)], both, error)
            if (allocated(error)) return
            task%films(i, k, :) = both
         end do
      end do
   end subroutine solve_points

   !> Films at one speed and load.
   subroutine solve_at(task, point, films, error)
      !> The task; the largest error of its grids is kept
      type(task_t), intent(inout) :: task
      !> Logarithms of U and W* [-]
      real(wp), intent(in) :: point(2)
      !> Logarithms of minimum and central film over the radius [-]
      real(wp), intent(out) :: films(2)
      !> Domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_contact_t) :: contact
      type(ehl_options_t) :: options
      type(ehl_films_t) :: solution

      films = 0.0_wp
      contact%radius = radius
      contact%modulus = task%modulus
      contact%line_load = exp(point(2))*task%modulus*radius
      contact%entrainment_speed = exp(point(1))*task%modulus*radius/task%oil%viscosity
      contact%oil = task%oil
      contact%is_compressible = task%is_compressible
      options%nodes = most_nodes
      options%accuracy = task%grid_accuracy
      options%tolerance = max(options%tolerance, leftover*task%grid_accuracy)
      call solve_contact_film(contact, options, solution, error)
      if (allocated(error)) then
         call add_context(error, "at U "//number_text(exp(point(1)), 3)//", W* "//number_text(exp(point(2)), 3))
         return
      end if
      films = log([solution%minimum, solution%central]/radius)
      task%grid_error = max(task%grid_error, solution%error, chance_error/real(solution%nodes, wp)**2)
      task%is_limited = task%is_limited .or. solution%error > task%grid_accuracy
   end subroutine solve_at

end module camroller_ehl_table
