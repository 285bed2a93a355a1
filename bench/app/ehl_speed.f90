!> What the numerical film of a line contact costs, and how well: from nothing and from a solution nearby, over the number of nodes.
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
      use camroller_ehl_solution, only : ehl_options_t, ehl_track_t, solve_contact_film, follow_contact
      use camroller_ehl_films, only : ehl_films_t
      use bench_circumstances, only : print_circumstances
      use bench_clock, only : seconds_used, median
      use bench_contacts, only : contact_of_kind

      integer, parameter :: repeats = 15, sizes(5) = [65, 129, 257, 513, 1025]
      type(ehl_contact_t) :: contact
      type(ehl_options_t) :: options
      type(ehl_track_t) :: track
      type(ehl_films_t) :: films, best
      type(error_t), allocatable :: error
      ! Times of one solution [s]
      real(wp) :: cold(repeats), warm(repeats), start
      ! Difference of the films from those of 2049 nodes [-]
      real(wp) :: off
      integer :: i, k, kind, status, iterations, factorisations
      logical :: converged
      character(len=32) :: threads

      call get_environment_variable("OPENBLAS_NUM_THREADS", threads)
      call print_circumstances("Steady numerical film of a line contact, both of two nested grids; medians of repeated solutions")
      write (output_unit, "(3a)") "# LAPACK:   OpenBLAS, OPENBLAS_NUM_THREADS=", trim(threads), &
         & " (times are of the whole process, so more threads than one would show as more time)"
      write (output_unit, "(a)") "# error: film against 2049 nodes; stated: what the solver says of it"
      write (output_unit, "(a)") "# cold: from nothing; warm: load and speed changed by 1 %; counts: iterations and factorisations"
      write (output_unit, "(a8, a8, 4a12, 4a8)") "# case", "nodes", "error [%]", "stated [%]", "cold [ms]", "warm [ms]", "cold_i", &
         & "cold_f", "warm_i", "warm_f"
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
               cold(i) = seconds_used() - start
               if (allocated(error)) error stop 1
            end do
            iterations = films%iterations
            factorisations = films%factorisations
            off = max(abs(films%central/best%central - 1.0_wp), abs(films%minimum/best%minimum - 1.0_wp))
            track%is_started = .false.
            do i = 0, repeats
               if (i > 0) call move(contact, 1 - 2*mod(i, 2))
               start = seconds_used()
               call follow_contact(contact, options, track, films, status, converged)
               if (i > 0) warm(i) = seconds_used() - start
               if (.not. converged) error stop 1
            end do
            contact = contact_of_kind(kind)
            write (output_unit, "(a8, i8, 2f12.4, 2f12.3, 4i8)") merge("LC1     ", "LC2     ", kind == 1), sizes(k), 100.0_wp*off, &
               & 100.0_wp*films%error, 1.0e3_wp*median(cold), 1.0e3_wp*median(warm), iterations, factorisations, films%iterations, &
               & films%factorisations
         end do
      end do
   end subroutine main

   !> Change load and speed by 1 % to and fro.
   subroutine move(contact, direction)
      use camroller_kinds, only : wp
      use camroller_ehl_problem, only : ehl_contact_t
      !> The contact
      type(ehl_contact_t), intent(inout) :: contact
      !> 1 or -1
      integer, intent(in) :: direction

      contact%line_load = contact%line_load*1.01_wp**direction
      contact%entrainment_speed = contact%entrainment_speed*1.01_wp**direction
   end subroutine move

end program ehl_speed
