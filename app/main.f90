!> The program.
program main
   use, intrinsic :: iso_fortran_env, only : output_unit
   use camroller_version, only : version_text
   implicit none

   write (output_unit, '(a)') "camroller "//version_text
end program main
