!> The program: do what the command line says, end with an exit code by kind of error.
program main
   use camroller_commands, only : run_command_line
   use camroller_team, only : team_t
   implicit none

   type(team_t) :: alone
   integer :: code

   call run_command_line(alone, code)
   if (code /= 0) stop code, quiet = .true.
end program main
