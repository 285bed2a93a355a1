!> The program: do what the command line says, end with an exit code by kind of error.
program main
   use camroller_commands, only : run_command_line
   implicit none

   integer :: code

   call run_command_line(code)
   if (code /= 0) stop code, quiet = .true.
end program main
