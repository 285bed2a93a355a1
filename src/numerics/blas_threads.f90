!> One thread for the linear algebra.
!>
!> OpenBLAS would take as many threads as there are cores, and round otherwise with each number of them: results
!> have to be the same on every machine, and a sweep has its own threads. Where another library does the algebra, nothing is
!> changed. The routine is looked up while the program runs, so that no library has to have it; where OpenBLAS is linked statically
!> it may not be found, and the environment variable OPENBLAS_NUM_THREADS is left. The setting holds for the whole process, so the
!> library does not make it by itself: a program decides.
module camroller_blas_threads
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_procpointer, c_funptr, c_int, c_loc, c_null_char, c_null_ptr, &
      & c_ptr
   implicit none
   private

   public :: use_one_blas_thread

   abstract interface
      subroutine c_set_threads(threads) bind(C)
         import :: c_int
         implicit none
         integer(c_int), value :: threads
      end subroutine c_set_threads
   end interface

   interface
      function c_find_symbol(handle, name) bind(C, name="dlsym") result(address)
         import :: c_funptr, c_ptr
         implicit none
         type(c_ptr), value :: handle, name
         type(c_funptr) :: address
      end function c_find_symbol
   end interface

contains

   !> Let OpenBLAS use one thread, where it is OpenBLAS: for all of the process, before the first case is run.
   subroutine use_one_blas_thread()
      character(len=25, kind=c_char), target :: name
      procedure(c_set_threads), pointer :: set_threads
      type(c_funptr) :: address

      ! No handle stands for all libraries of the program
      name = "openblas_set_num_threads"//c_null_char
      address = c_find_symbol(c_null_ptr, c_loc(name))
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, set_threads)
      call set_threads(1_c_int)
   end subroutine use_one_blas_thread

end module camroller_blas_threads
