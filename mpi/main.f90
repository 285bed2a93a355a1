!> The program for many nodes: the same commands, a sweep shared by all processes.
program main
   use camroller_commands, only : run_command_line
   use camroller_stop_signal, only : end_process
   use camroller_team_mpi, only : end_team, start_team, team_mpi_t
   implicit none

   type(team_mpi_t) :: team
   integer :: code

   call start_team(team)
   call run_command_line(team, code)
   call team%largest(code)
   call end_team(team)
   call end_process(code)
end program main
