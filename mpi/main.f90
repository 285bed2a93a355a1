!> The program for many nodes: the same commands, a sweep shared by all processes.
program main
   use camroller_commands, only : run_command_line
   use camroller_error, only : error_t
   use camroller_stop_signal, only : end_process
   use camroller_streams, only : tell
   use camroller_team_mpi, only : end_team, start_team, team_mpi_t
   implicit none

   type(team_mpi_t) :: team
   type(error_t), allocatable :: error
   integer :: code

   call start_team(team, error)
   if (allocated(error)) then
      if (team%rank == 0) call tell("camroller: "//error%message//new_line("a"))
      call end_process(error%kind)
   end if
   call run_command_line(team, code)
   call team%largest(code)
   call end_team(team)
   call end_process(code)
end program main
