!> The end of the program, at once.
!>
!> In: an exit code. Libraries are not asked to end: OpenBLAS waits for its threads, and where there is little memory a
!> thread of it never comes to its first line. So everything that is to be kept has to be written and closed before.
module camroller_end_process
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: end_process

   interface
      subroutine c_exit(code) bind(C, name="_exit")
         import :: c_int
         integer(c_int), value :: code
      end subroutine c_exit
   end interface

contains

   !> End the program.
   subroutine end_process(code)
      !> Exit code
      integer, intent(in) :: code

      call c_exit(int(code, c_int))
   end subroutine end_process

end module camroller_end_process
