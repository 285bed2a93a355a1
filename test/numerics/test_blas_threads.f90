!> Threads of the linear algebra: the call that programs make sets OpenBLAS to one.
module test_blas_threads
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_procpointer, c_funptr, c_int, c_loc, c_null_char, c_null_ptr, &
      & c_ptr
   use testdrive, only : unittest_type, new_unittest, error_type, check, skip_test
   use camroller, only : use_one_blas_thread
   implicit none
   private

   public :: collect_blas_threads

   abstract interface
      subroutine c_set_threads(threads) bind(C)
         import :: c_int
         implicit none
         integer(c_int), value :: threads
      end subroutine c_set_threads
      function c_get_threads() bind(C) result(threads)
         import :: c_int
         implicit none
         integer(c_int) :: threads
      end function c_get_threads
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

   subroutine collect_blas_threads(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("OpenBLAS has one thread after the call, however many before", test_one)]
   end subroutine collect_blas_threads

   !> Address of a routine of the program or its libraries.
   function find_routine(name) result(address)
      character(len=*), intent(in) :: name
      type(c_funptr) :: address
      character(len=60, kind=c_char), target :: buffer

      buffer = name//c_null_char
      address = c_find_symbol(c_null_ptr, c_loc(buffer))
   end function find_routine

   subroutine test_one(error)
      type(error_type), allocatable, intent(out) :: error
      procedure(c_set_threads), pointer :: set_threads
      procedure(c_get_threads), pointer :: get_threads
      type(c_funptr) :: setter, getter
      integer(c_int) :: before

      setter = find_routine("openblas_set_num_threads")
      getter = find_routine("openblas_get_num_threads")
      if (.not. (c_associated(setter) .and. c_associated(getter))) then
         call skip_test(error, "the linear algebra is not OpenBLAS")
         return
      end if
      call c_f_procpointer(setter, set_threads)
      call c_f_procpointer(getter, get_threads)
      before = get_threads()
      call set_threads(2_c_int)
      if (get_threads() /= 2) then
         call skip_test(error, "this OpenBLAS has no threads")
         return
      end if
      call use_one_blas_thread()
      call check(error, int(get_threads()), 1, "threads after the call")
      call set_threads(before)
   end subroutine test_one

end module test_blas_threads
