!> How the cost of the numerical film grows with the number of nodes, and how much of it LAPACK takes.
!>
!> Usage: OPENBLAS_NUM_THREADS=1 ehl_cost DECKS       lines of a table on the output; DECKS is the folder of the decks
!> Steady contacts and whole coupled cycles. Medians of repeated runs, least of few for cycles.
program ehl_cost
   implicit none

   call main()

contains

   !> Measure everything on five grids, and the powers with which it grows.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit
      use camroller_kinds, only : wp
      use bench_circumstances, only : print_circumstances

      integer, parameter :: sizes(5) = [65, 129, 257, 513, 1025], tasks = 3
      character(len=12), parameter :: names(tasks) = [character(len=12) :: "steady", "cycle_300_60", "cycle_300_25"]
      ! Seconds, and LAPACK's part of them: factors, solutions, products [-]
      real(wp) :: seconds(size(sizes), tasks), parts(3, size(sizes), tasks)
      ! Steps of a cycle or iterations of a solution; factorisations
      integer :: counts(2, size(sizes), tasks), i, task
      character(len=32) :: threads

      call get_environment_variable("OPENBLAS_NUM_THREADS", threads)
      call print_circumstances("Cost of the numerical film over the number of nodes")
      write (output_unit, "(3a)") "# LAPACK:   OpenBLAS, OPENBLAS_NUM_THREADS=", trim(threads)
      write (output_unit, "(a)") "# steady: a contact from nothing on nested grids, geometric mean of LC1 and LC2", &
         & "# cycle: the coupled cycle of decks/thesis.nml at rev/min and degC", &
         & "# factors, solve, products: part of the time in dgetrf, dgetrs, dgemv; count: iterations, or steps of a cycle"
      write (output_unit, "(a12, a8, a14, 3a13, a8, a12)") "# task", "nodes", "time [ms]", "factors [%]", "solve [%]", &
         & "products [%]", "count", "factorised"
      do task = 1, tasks
         do i = 1, size(sizes)
            if (task == 1) then
               call measure_steady(sizes(i), seconds(i, task), parts(:, i, task), counts(:, i, task))
            else
               call measure_cycle(sizes(i), merge(2, 1, task == 2), seconds(i, task), parts(:, i, task), counts(:, i, task))
            end if
            write (output_unit, "(a12, i8, f14.3, 3f13.1, i8, i12)") names(task), sizes(i), 1.0e3_wp*seconds(i, task), &
               & 100.0_wp*parts(:, i, task), counts(:, i, task)
            flush (output_unit)
         end do
      end do
      write (output_unit, "(a)") "# power of the number of nodes with which the time grows, between neighbours; first to last"
      do task = 1, tasks
         associate (log_time => log(seconds(:, task)), log_size => log(real(sizes, wp)), n => size(sizes))
            write (output_unit, "(2a, 5f8.2)") "# power ", names(task), (log_time(2:n) - log_time(:n - 1))/(log_size(2:n) &
               & - log_size(:n - 1)), (log_time(n) - log_time(1))/(log_size(n) - log_size(1))
         end associate
      end do
   end subroutine main

   !> Both steady contacts from nothing.
   subroutine measure_steady(nodes, seconds, parts, counts)
      use camroller_kinds, only : wp
      use camroller_error, only : error_t
      use camroller_ehl_problem, only : ehl_contact_t
      use camroller_ehl_solution, only : ehl_options_t, solve_contact_film
      use camroller_ehl_films, only : ehl_films_t
      use camroller_sorting, only : median
      use bench_clock, only : seconds_used
      use bench_contacts, only : contact_of_kind
      use bench_lapack_clock, only : lapack_t, start_lapack_clock, read_lapack_clock
      !> Nodes
      integer, intent(in) :: nodes
      !> Time [s], LAPACK's part [-]
      real(wp), intent(out) :: seconds, parts(3)
      !> Iterations, factorisations of the last solution of both contacts
      integer, intent(out) :: counts(2)

      integer, parameter :: repeats = 21
      type(ehl_contact_t) :: contact
      type(ehl_options_t) :: options
      type(ehl_films_t) :: films
      type(error_t), allocatable :: error
      type(lapack_t) :: lapack
      real(wp) :: times(repeats), start, all_time
      integer :: kind, i

      options%nodes = nodes
      seconds = 1.0_wp
      parts = 0.0_wp
      counts = 0
      do kind = 1, 2
         contact = contact_of_kind(kind)
         call start_lapack_clock()
         do i = 1, repeats
            start = seconds_used()
            call solve_contact_film(contact, options, films, error)
            if (allocated(error)) error stop 1
            times(i) = seconds_used() - start
         end do
         lapack = read_lapack_clock()
         all_time = sum(times)
         seconds = seconds*sqrt(median(times))
         parts = parts + 0.5_wp*[lapack%factors, lapack%solutions, lapack%products]/all_time
         counts = counts + [films%iterations, films%factorisations]
      end do
   end subroutine measure_steady

   !> A coupled cycle; three times where it is quick.
   subroutine measure_cycle(nodes, number, seconds, parts, counts)
      use camroller_kinds, only : wp
      use camroller_error, only : error_t
      use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
      use bench_clock, only : seconds_used
      use bench_lapack_clock, only : lapack_t, start_lapack_clock, read_lapack_clock
      use camroller_deck, only : deck_t, read_deck, make_sweep_case
      use camroller_deck_matching, only : override_t
      use camroller_case, only : case_t
      use camroller_model, only : model_t
      use camroller_ehl_profiles, only : plain_model
      !> Nodes; case of the deck
      integer, intent(in) :: nodes, number
      !> Least time [s], LAPACK's part of it [-]
      real(wp), intent(out) :: seconds, parts(3)
      !> Steps, factorisations
      integer, intent(out) :: counts(2)

      type(ehl_cycle_t) :: turn
      type(ehl_cycle_options_t) :: options
      type(deck_t) :: deck
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: error
      type(lapack_t) :: lapack
      real(wp) :: start, time
      integer :: i
      character(len=512) :: folder

      call get_command_argument(1, folder)
      call read_deck(deck, trim(folder)//"/thesis.nml", [override_t::], error)
      if (.not. allocated(error)) call make_sweep_case(deck, number, case, error)
      if (.not. allocated(error)) call plain_model(model, case, .false., error)
      if (allocated(error)) error stop 1
      options%nodes = nodes
      seconds = huge(1.0_wp)
      do i = 1, merge(3, 1, nodes < 500)
         call start_lapack_clock()
         start = seconds_used()
         call integrate_ehl_cycle(turn, model, options, error)
         time = seconds_used() - start
         lapack = read_lapack_clock()
         if (allocated(error)) error stop 1
         if (time >= seconds) cycle
         seconds = time
         parts = [lapack%factors, lapack%solutions, lapack%products]/time
         counts = [size(turn%angle), lapack%factors_made]
      end do
   end subroutine measure_cycle

end program ehl_cost
