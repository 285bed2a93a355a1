!> Film of an oil between two bodies over speed and load, from numerical solutions.
!>
!> Layer: ehl. In: oil, modulus, ranges of the groups U and W*. Out: `film_table_t`. With oil and modulus given, the film over
!> the radius depends on U and W* alone, so some hundred solutions, each compared on two grids, serve every contact of a
!> cycle. Their number grows until solutions between the points agree with the table.
module camroller_ehl_table
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_convergence
   use camroller_lubricant, only : oil_t
   use camroller_film_table, only : film_table_t, most_terms, table_points, new_film_table, film_series_t, &
      & table_series, series_films
   use camroller_ehl_problem, only : ehl_contact_t
   use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
   use camroller_ehl_films, only : ehl_films_t
   implicit none
   private

   public :: ehl_t, build_film_table

   !> Numerical film as a case asks for it
   type :: ehl_t
      !> Largest error of the film: of the grid, and of the table between its points [-]
      real(wp) :: accuracy = 1.0e-2_wp
      !> Does the density of the oil grow with the pressure?
      logical :: compressible = .true.
      !> Does sliding thin the oil of profiles and of contacts solved over the cycle, where the shear law is Eyring's?
      logical :: shear_thinning = .true.
      !> Does roughness hinder their flow?
      logical :: flow_factors = .false.
      !> Are pressure and film across the contact wanted of a run?
      logical :: profiles = .false.
   end type ehl_t

   !> Polynomials over speed and load to begin with
   integer, parameter :: fewest_terms = 5
   !> Nodes across a contact: as many as its accuracy takes
   integer, parameter :: fewest_nodes = 65, most_nodes = 1025
   !> Radius of the contacts that are solved [m]; films over the radius do not depend on it
   real(wp), parameter :: radius = 0.01_wp

contains

   !> Table of the film over ranges of U and W*.
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

      ! Ends of the table; logarithms of both films at the points [-]
      real(wp) :: ends(2, 2)
      real(wp), allocatable :: films(:, :, :)
      real(wp) :: both(2)
      ! Logarithms of speed and load at the points [-]
      real(wp), allocatable :: points(:, :)
      ! Largest error of the grid [-]
      real(wp) :: grid_error
      integer :: terms, i, k
      character(len=32) :: texts(2)

      ends(:, 1) = log(speeds)
      ends(:, 2) = log(loads)
      terms = fewest_terms
      do
         allocate (films(terms, terms, 2), points(terms, 2))
         points(:, 1) = table_points(ends(:, 1), terms)
         points(:, 2) = table_points(ends(:, 2), terms)
         grid_error = 0.0_wp
         do k = 1, terms
            do i = 1, terms
               call solve_at(setup, oil, modulus, [points(i, 1), points(k, 2)], both, grid_error, error)
               if (allocated(error)) return
               films(i, k, :) = both
            end do
         end do
         call new_film_table(table, ends, films)
         call check_table(table, setup, oil, modulus, grid_error, error)
         if (allocated(error)) return
         if (table%error <= setup%accuracy .or. terms >= most_terms) exit
         terms = min(2*terms - 1, most_terms)
         deallocate (films, points)
      end do
      if (max(table%error, grid_error) <= setup%accuracy) return
      write (texts, "(es8.1)") max(table%error, grid_error), setup%accuracy
      call raise(error, kind_convergence, "ehl: error of the film"//trim(texts(1))//" instead of"//trim(texts(2))// &
         & "; ask for less accuracy")
   end subroutine build_film_table

   !> Compare a table with solutions between its points, on the diagonals and at the corners.
   subroutine check_table(table, setup, oil, modulus, grid_error, error)
      !> The table; its error is set
      type(film_table_t), intent(inout) :: table
      !> Accuracy and density
      type(ehl_t), intent(in) :: setup
      !> The oil
      type(oil_t), intent(in) :: oil
      !> E' [Pa]
      real(wp), intent(in) :: modulus
      !> Largest error of the grid so far [-]
      real(wp), intent(inout) :: grid_error
      !> Domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(film_series_t) :: series
      ! Places from 0 to 1 in both directions [-]
      real(wp), parameter :: places(2, 8) = reshape([0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, &
         & 0.31_wp, 0.27_wp, 0.73_wp, 0.29_wp, 0.33_wp, 0.77_wp, 0.71_wp, 0.69_wp], [2, 8])
      ! Logarithms: of speed and load, of films by solution and by table; slopes that are not used [-]
      real(wp) :: point(2), films(2), expected(2), slopes(2, 2)
      integer :: i

      table%error = 0.0_wp
      do i = 1, size(places, 2)
         point = table%ends(1, :) + places(:, i)*(table%ends(2, :) - table%ends(1, :))
         call solve_at(setup, oil, modulus, point, expected, grid_error, error)
         if (allocated(error)) return
         call table_series(table, point(1), series)
         call series_films(series, point(2), films, slopes(:, 1), slopes(:, 2))
         table%error = max(table%error, maxval(abs(films - expected)))
      end do
   end subroutine check_table

   !> Films at one speed and load.
   subroutine solve_at(setup, oil, modulus, point, films, grid_error, error)
      !> Accuracy and density
      type(ehl_t), intent(in) :: setup
      !> The oil
      type(oil_t), intent(in) :: oil
      !> E' [Pa]
      real(wp), intent(in) :: modulus
      !> Logarithms of U and W* [-]
      real(wp), intent(in) :: point(2)
      !> Logarithms of minimum and central film over the radius [-]
      real(wp), intent(out) :: films(2)
      !> Largest error of the grid so far [-]
      real(wp), intent(inout) :: grid_error
      !> Domain or convergence error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_contact_t) :: contact
      type(ehl_options_t) :: options
      type(ehl_films_t) :: solution
      character(len=64) :: text

      films = 0.0_wp
      contact%radius = radius
      contact%modulus = modulus
      contact%line_load = exp(point(2))*modulus*radius
      contact%entrainment_speed = exp(point(1))*modulus*radius/oil%viscosity
      contact%oil = oil
      contact%is_compressible = setup%compressible
      options%nodes = fewest_nodes
      do
         call solve_contact_film(contact, options, solution, error)
         if (.not. allocated(error) .and. solution%error <= setup%accuracy) exit
         if (options%nodes >= most_nodes) exit
         if (allocated(error)) then
            if (error%kind /= kind_convergence) exit
         end if
         options%nodes = 2*options%nodes - 1
      end do
      if (allocated(error)) then
         write (text, "(a, es9.2, a, es9.2)") "at U", exp(point(1)), ", W*", exp(point(2))
         call add_context(error, trim(text))
         return
      end if
      films = log([solution%minimum, solution%central]/radius)
      grid_error = max(grid_error, solution%error)
   end subroutine solve_at

end module camroller_ehl_table
