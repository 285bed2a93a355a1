!> One thread for the linear algebra library, and memory for it.
!>
!> OpenBLAS starts one thread for each core, and its rounding depends on the number of threads. `use_one_blas_thread` sets one
!> thread, so that results are the same on every machine and a sweep, which has threads of its own, does not start more threads
!> than there are cores. With another BLAS library nothing is changed. The routine is looked up at run time, so the program links
!> with any BLAS; where OpenBLAS is linked statically the routine may not be found, and the environment variable
!> OPENBLAS_NUM_THREADS has to be used instead. The setting applies to the whole process, so the library never makes it: the main
!> program does, and the package of Python and FMUs, which bring an OpenBLAS. Where a process has one of the same name already, the
!> loader takes that for theirs, and its setting changes.
!>
!> OpenBLAS maps one buffer for each thread that calls it at the same time, and, when it is loaded, one for each of its own threads.
!> If it cannot map one, it tries again without end; a program therefore makes sure of the buffers before the first case.
module camroller_blas_threads
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_procpointer, c_funptr, c_int, c_loc, c_null_char, c_null_ptr, &
      & c_ptr
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use camroller_error, only : error_t, raise, kind_memory
   use camroller_number_text, only : counted, integer_text
   implicit none
   private

   public :: use_one_blas_thread, check_blas_memory

   !> Bytes of a megabyte in messages
   integer, parameter :: megabyte = 1048576
   !> Address space of a buffer, as OpenBLAS is built for processors of 64 bits [MB]
   integer, parameter :: buffer_size = 128
   !> Address space that a thread takes beside it, for its stack and its case [MB]
   integer, parameter :: own_need = 8
   !> Time after which OpenBLAS's own threads have their buffers or cannot get them [us]
   integer(c_int), parameter :: settling_time = 100000_c_int

   abstract interface
      subroutine c_set_threads(threads) bind(C)
         import :: c_int
         implicit none
         integer(c_int), value :: threads
      end subroutine c_set_threads

      function c_get_cores() bind(C) result(cores)
         import :: c_int
         implicit none
         integer(c_int) :: cores
      end function c_get_cores
   end interface

   interface
      function c_find_symbol(handle, name) bind(C, name="dlsym") result(address)
         import :: c_funptr, c_ptr
         implicit none
         type(c_ptr), value :: handle, name
         type(c_funptr) :: address
      end function c_find_symbol

      function c_wait(microseconds) bind(C, name="usleep") result(status)
         import :: c_int
         implicit none
         integer(c_int), value :: microseconds
         integer(c_int) :: status
      end function c_wait
   end interface

contains

   !> Let OpenBLAS use one thread, where it is OpenBLAS: for all of the process, before the first case is run.
   subroutine use_one_blas_thread(is_found)
      !> Is it?
      logical, intent(out), optional :: is_found

      procedure(c_set_threads), pointer :: set_threads
      type(c_funptr) :: address

      address = find_routine("openblas_set_num_threads")
      if (present(is_found)) is_found = c_associated(address)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, set_threads)
      call set_threads(1_c_int)
   end subroutine use_one_blas_thread

   !> Is there memory for the linear algebra, where it is OpenBLAS? To be asked before the first case is run.
   !>
   !> Threads of OpenBLAS may not have their buffers yet: there has to be room for these as well, unless they had time to take them.
   subroutine check_blas_memory(threads, error)
      !> Threads of the program that run cases
      integer, intent(in) :: threads
      !> Too little memory
      type(error_t), allocatable, intent(out) :: error

      procedure(c_get_cores), pointer :: get_cores
      type(c_funptr) :: address
      integer(c_int) :: ignored

      address = find_routine("openblas_get_num_procs")
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, get_cores)
      if (can_map(threads + get_cores() - 1)) return
      ignored = c_wait(settling_time)
      if (can_map(threads)) return
      call raise(error, kind_memory, "too little memory: the library of linear algebra takes "// &
         & integer_text(buffer_size)//" MB of address space for each thread that runs cases, and there is not enough for "// &
         & counted(threads, "thread")//"; allow more (ulimit -v) or take fewer threads (--threads)")
   end subroutine check_blas_memory

   !> Can buffers be mapped beside what there is? One by one: a system that lends more memory than there is refuses a single request
   !> for all of it.
   recursive function can_map(buffers) result(answer)
      !> How many
      integer, intent(in) :: buffers
      !> Can they?
      logical :: answer

      ! Volatile, or the compiler may leave out what is never used
      integer(int8), allocatable, volatile :: room(:)
      integer :: status

      allocate (room(int(buffer_size + own_need, int64)*megabyte), stat=status)
      answer = status == 0
      if (answer .and. buffers > 1) answer = can_map(buffers - 1)
   end function can_map

   !> Address of a routine of the program or its libraries; not associated where there is none.
   function find_routine(routine) result(address)
      !> Its name
      character(len=*), intent(in) :: routine
      !> Its address
      type(c_funptr) :: address

      character(len=len(routine) + 1, kind=c_char), target :: name

      ! No handle stands for all libraries of the program
      name = routine//c_null_char
      address = c_find_symbol(c_null_ptr, c_loc(name))
   end function find_routine

end module camroller_blas_threads
