!> Where the time of a cycle goes: one evaluation, preparation, integration as decks ask for it, output.
!>
!> Usage: cycle_speed FOLDER_OF_DECKS       lines of a table on the output
program cycle_speed
   implicit none

   call main()

contains

   !> Measure all operating points.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
      use camroller_error, only : error_t
      use camroller_spin, only : spin_problem_t
      use bench_circumstances, only : print_circumstances
      use bench_tasks, only : task_t, task_sets, make_tasks
      use bench_parts, only : part_names, part_units, measure_parts
      use camroller_kinds, only : wp

      type(task_t), allocatable :: tasks(:)
      type(error_t), allocatable :: error
      ! Time of each part [ns] or [us]
      real(wp) :: times(size(part_names))
      character(len=256) :: folder
      integer :: i, evaluations(2)

      call get_command_argument(1, folder)
      call make_tasks(tasks, trim(folder), task_sets(1), error)
      if (allocated(error)) then
         write (error_unit, "(2a)") "cycle_speed: ", error%message
         error stop 1
      end if
      call print_circumstances("Parts of a cycle, medians of repeated runs")
      write (output_unit, "(a)") "# rate: right-hand side to round-off; "// &
         & "loading: geometry and moments in it; contact: the rest of it"
      write (output_unit, "(a)") "# rate_4: right-hand side as a tolerance of 1e-4 wants it; "// &
         & "slopes_4: the same with its derivatives"
      write (output_unit, "(a)") "# stops: finding them; cycle: integrate_cycle with default numerics, "// &
         & "from no knowledge to periodic; states: everything at 720 angles"
      write (output_unit, "(a)") "# steps_4: hermite at a tolerance of 1e-4 from the periodic start, "// &
         & "sliding speed at 720 angles; floor_4: its evaluations times slopes_4"
      write (output_unit, "(a, t25, 12a15)") "# task", (trim(part_names(i))//" ["//part_units(i)//"]", i=1, size(part_names)), &
         & "floor_4 [us]", "evaluations", "evaluations_4"
      do i = 1, size(tasks)
         select type (problem => tasks(i)%problem)
         type is (spin_problem_t)
            call measure_parts(tasks(i), times, evaluations, error)
            if (allocated(error)) then
               write (error_unit, "(2a)") "cycle_speed: ", error%message
               error stop 1
            end if
            write (output_unit, "(a24, 10f15.1, 2i15)") tasks(i)%name, times, &
               & 1.0e-3_wp*evaluations(2)*times(5), evaluations
         end select
      end do
   end subroutine main

end program cycle_speed
