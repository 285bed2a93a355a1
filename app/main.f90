!> The program: do what the command line says, end with an exit code by kind of error.
program main
   use camroller_commands, only : run_command_line
   use camroller_stop_signal, only : end_process
   use camroller_team, only : team_t
   implicit none

   type(team_t) :: alone
   integer :: code

   call run_command_line(alone, code)
   call end_process(code)
end program main
