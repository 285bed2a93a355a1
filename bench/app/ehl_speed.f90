!> What the numerical film of a line contact costs, and how well, over the number of nodes.
!>
!> Usage: OPENBLAS_NUM_THREADS=1 ehl_speed       lines of a table on the output
program ehl_speed
   implicit none

   call main()

contains

   !> Measure both contacts of the tests on five grids.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit
      use camroller_kinds, only : wp
      use camroller_error, only : error_t
      use camroller_ehl_problem, only : ehl_contact_t
      use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
      use camroller_ehl_films, only : ehl_films_t
      use bench_circumstances, only : print_circumstances
      use camroller_sorting, only : median
      use bench_clock, only : seconds_used
      use bench_contacts, only : contact_of_kind

      integer, parameter :: repeats = 15, sizes(5) = [65, 129, 257, 513, 1025]
      type(ehl_contact_t) :: contact
      type(ehl_options_t) :: options
      type(ehl_films_t) :: films, best
      type(error_t), allocatable :: error
      ! Times of one solution [s]
      real(wp) :: times(repeats), start
      ! Difference of the films from those of 2049 nodes [-]
      real(wp) :: off
      integer :: i, k, kind
      character(len=32) :: threads

      call get_environment_variable("OPENBLAS_NUM_THREADS", threads)
      call print_circumstances("Steady numerical film of a line contact, both of two nested grids; medians of repeated solutions")
      write (output_unit, "(3a)") "# LAPACK:   OpenBLAS, OPENBLAS_NUM_THREADS=", trim(threads), &
         & " (times are of the whole process, so more threads than one would show as more time)"
      write (output_unit, "(a)") "# error: film against 2049 nodes; stated: what the solver says of it"
      write (output_unit, "(a8, a8, 5a12)") "# case", "nodes", "error [%]", "stated [%]", "time [ms]", "iterations", &
         & "factorised"
      do kind = 1, 2
         contact = contact_of_kind(kind)
         options%nodes = 2049
         call solve_contact_film(contact, options, best, error)
         if (allocated(error)) error stop 1
         do k = 1, size(sizes)
            options%nodes = sizes(k)
            do i = 1, repeats
               start = seconds_used()
               call solve_contact_film(contact, options, films, error)
               times(i) = seconds_used() - start
               if (allocated(error)) error stop 1
            end do
            off = max(abs(films%central/best%central - 1.0_wp), abs(films%minimum/best%minimum - 1.0_wp))
            write (output_unit, "(a8, i8, 2f12.4, f12.3, 2i12)") merge("LC1     ", "LC2     ", kind == 1), sizes(k), 100.0_wp*off, &
               & 100.0_wp*films%error, 1.0e3_wp*median(times), films%iterations, films%factorisations
         end do
      end do
   end subroutine main

end program ehl_speed
