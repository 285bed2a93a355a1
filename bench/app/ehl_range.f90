!> The whole range of steady contacts solved from nothing on one number of nodes: which fail, and how far half the nodes are off.
!>
!> Usage: OPENBLAS_NUM_THREADS=1 ehl_range NODES [FIRST STRIDE]     every STRIDE-th contact from FIRST on; all by default
!> W* 1e-6 to 1e-3, U 1e-13 to 1e-9, two a decade, G 1000 to 7500, three viscosity laws, within 1.5 GPa and alpha p_H 35.
program ehl_range
   implicit none

   call main()

contains

   !> Solve all and print what is remarkable.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit
      use camroller_kinds, only : wp
      use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem
      use camroller_ehl_grid, only : ehl_grid_t
      use camroller_ehl_newton, only : ehl_state_t
      use camroller_ehl_solution, only : ehl_options_t, solve_on_grids
      use camroller_ehl_films, only : ehl_films_t
      use bench_circumstances, only : print_circumstances
      use bench_clock, only : seconds_used
      use bench_contacts, only : contact_of_groups, range_size

      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(ehl_grid_t) :: grid
      type(ehl_state_t) :: state
      type(ehl_options_t) :: options
      type(ehl_films_t) :: films, coarse
      ! Groups W*, U, G [-]; times [s]; films of both grids over each other [-]
      real(wp) :: groups(3), start, time, all_time, longest, off, largest
      integer :: number, law, status, solved, failed, differing
      integer :: choice(3)
      logical :: converged

      call get_choice(choice)
      options%nodes = choice(1)
      call print_circumstances("Steady contacts of the whole range from nothing")
      write (output_unit, "(a, i0, a, i0, a, i0)") "# nodes ", options%nodes, ", contacts ", choice(2), &
         & " + k ", choice(3)
      write (output_unit, "(a)") "# listed: not solved, central or smallest film off from half the nodes by over 2 %, or ten "// &
         & "times dearer than the mean so far", "# W*, U, G, law; off [%]; time [s]; iterations, factorisations"
      solved = 0
      failed = 0
      differing = 0
      all_time = 0.0_wp
      longest = 0.0_wp
      largest = 0.0_wp
      do number = choice(2), range_size, choice(3)
         call contact_of_groups(number, contact, groups, law)
         call new_ehl_problem(problem, contact, status)
         if (status /= 0) cycle
         start = seconds_used()
         call solve_on_grids(problem, options, grid, state, films, coarse, converged)
         time = seconds_used() - start
         off = huge(1.0_wp)
         if (converged) off = max(abs(films%central/coarse%central - 1.0_wp), abs(films%minimum/coarse%minimum - 1.0_wp))
         solved = solved + merge(1, 0, converged)
         failed = failed + merge(0, 1, converged)
         if (converged) then
            largest = max(largest, off)
            if (off > 0.02_wp) differing = differing + 1
         end if
         if (off > 0.02_wp .or. time*(solved + failed) > 10.0_wp*(all_time + time)) write (output_unit, &
            & "(3es10.2, i3, f9.3, f9.3, 2i6, a)") groups, law, 100.0_wp*min(off, 10.0_wp), time, films%iterations, &
            & films%factorisations, merge("            ", "  not solved", converged)
         flush (output_unit)
         all_time = all_time + time
         longest = max(longest, time)
      end do
      write (output_unit, "(i0, a, i0, a, i0, a, f0.2, a)") solved, " solved, ", failed, " not, ", differing, &
         & " off by over 2 %, largest ", 100.0_wp*largest, " %"
      write (output_unit, "(a, f0.1, a, f0.4, a, f0.3, a)") "time ", all_time, " s, mean ", all_time/max(solved + failed, 1), &
         & " s, longest ", longest, " s"
   end subroutine main

   !> Nodes, first contact, stride from the command line.
   subroutine get_choice(choice)
      !> The three
      integer, intent(out) :: choice(3)

      character(len=16) :: word
      integer :: i, status

      choice = [513, 1, 1]
      do i = 1, command_argument_count()
         call get_command_argument(i, word)
         read (word, *, iostat=status) choice(i)
         if (status /= 0) error stop 2
      end do
   end subroutine get_choice

end program ehl_range
