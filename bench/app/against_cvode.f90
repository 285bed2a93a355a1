!> Error and time over tolerance: our methods and CVODE on the same right-hand side, in one run.
!>
!> Usage: against_cvode FOLDER_OF_DECKS SET [TASK...]       lines of a table on the output; SET is roller or trains
program against_cvode
   implicit none

   call main()

contains

   !> Measure all tasks, or those named.
   subroutine main()
      use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
      use camroller_error, only : error_t
      use camroller_ode_methods, only : method_facts
      use bench_circumstances, only : print_circumstances
      use bench_tasks, only : task_t, make_tasks, task_sets
      use bench_ladder, only : climb_ladder, print_header

      type(task_t), allocatable :: tasks(:)
      type(error_t), allocatable :: error
      character(len=256) :: folder, set
      integer :: i

      call get_command_argument(1, folder)
      call get_command_argument(2, set)
      call make_tasks(tasks, trim(folder), trim(set), error)
      if (allocated(error)) then
         write (error_unit, "(2a)") "against_cvode: ", error%message
         error stop 1
      end if
      call print_circumstances("One cycle and its sliding speed at 720 angles, of trains the load: error and time over tolerance")
      do i = 1, size(tasks)
         write (output_unit, "(3a, es9.2)") "# reference ", tasks(i)%name, ": two methods differ by", tasks(i)%doubt
      end do
      call print_header()
      do i = 1, size(tasks)
         if (.not. is_wanted(tasks(i)%name)) cycle
         if (set == task_sets(2)) then
            call climb_ladder(tasks(i), [character(len=32) :: "rodas5p", "radau5", "cvode", "cvode_slope", "cvode_restart", &
               & "cvode_slope_restart"])
         else
            call climb_ladder(tasks(i), [character(len=32) :: pack(method_facts%name, method_facts%companion_order > 0), &
               & "cvode", "cvode_slope", "cvode_restart", "cvode_slope_restart"])
         end if
         flush (output_unit)
      end do
   end subroutine main

   !> Is a task among the arguments, or are there none?
   function is_wanted(name) result(answer)
      !> Name of the task
      character(len=*), intent(in) :: name
      !> Answer
      logical :: answer

      character(len=256) :: argument
      integer :: i

      answer = command_argument_count() < 3
      do i = 3, command_argument_count()
         call get_command_argument(i, argument)
         answer = answer .or. index(name, trim(argument)) == 1
      end do
   end function is_wanted

end program against_cvode
