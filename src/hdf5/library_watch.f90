!> Watchdog for reading: the file being read, and a limit on the processor time of a library call.
!>
!> In: the path of a file. Out: whether one is being read, the message for a signal handler. HDF5 checks a file while it reads
!> it, but not completely: in a damaged file without a seal it may follow a cyclic list or an invalid address. A program can turn
!> that into an error (`watch_library`); a host of the library is not affected. Only the processor time of the calling thread
!> counts, so that neither a slow disk nor a stopped process is taken for an endless loop. A disk that never answers is not
!> detected. A signal handler has no arguments, hence the saved variables.
module camroller_library_watch
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_long, c_null_ptr, c_ptr, c_size_t
   implicit none
   private

   public :: watch_library, begin_call, end_call, is_in_call, tell_call

   !> Most time that a call may compute [s]: hundreds of times what the largest piece that is read at once takes
   integer(c_long), parameter :: longest_call = 4_c_long
   !> Clock of the time that this thread has computed; descriptor of the error unit; letters of a path
   integer(c_int), parameter :: thread_clock = 3_c_int, error_descriptor = 2_c_int
   integer, parameter :: path_length = 4096
   !> What is done with the state
   integer, parameter :: arm = 1, enter = 2, leave = 3, ask = 4, speak = 5

   !> Times of a timer, as the C library lays them out: how often, and when first
   type, bind(C) :: alarm_t
      integer(c_long) :: interval(2) = 0_c_long
      integer(c_long) :: first(2) = 0_c_long
   end type alarm_t

   interface
      function c_timer_create(clock, event, timer) bind(C, name="timer_create") result(status)
         import :: c_int, c_ptr
         integer(c_int), value :: clock
         type(c_ptr), value :: event
         type(c_ptr), intent(out) :: timer
         integer(c_int) :: status
      end function c_timer_create

      function c_timer_settime(timer, flags, alarm, former) bind(C, name="timer_settime") result(status)
         import :: alarm_t, c_int, c_ptr
         type(c_ptr), value :: timer
         integer(c_int), value :: flags
         type(alarm_t), intent(in) :: alarm
         type(c_ptr), value :: former
         integer(c_int) :: status
      end function c_timer_settime

      function c_timer_delete(timer) bind(C, name="timer_delete") result(status)
         import :: c_int, c_ptr
         type(c_ptr), value :: timer
         integer(c_int) :: status
      end function c_timer_delete

      function c_write(descriptor, letters, count) bind(C, name="write") result(written)
         import :: c_char, c_int, c_long, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: letters(*)
         integer(c_size_t), value :: count
         integer(c_long) :: written
      end function c_write
   end interface

contains

   !> For a program that handles the signals of time and of broken memory: watch calls from now on.
   subroutine watch_library()
      logical :: ignored

      ignored = change_state(arm, "")
   end subroutine watch_library

   !> A call begins, or the next one of several.
   subroutine begin_call(path)
      !> File that it reads
      character(len=*), intent(in) :: path

      logical :: ignored

      ignored = change_state(enter, path)
   end subroutine begin_call

   !> The call is over.
   subroutine end_call()
      logical :: ignored

      ignored = change_state(leave, "")
   end subroutine end_call

   !> Is a library reading a file at this moment? May be asked by a signal handler.
   function is_in_call() result(answer)
      !> Is it?
      logical :: answer

      answer = change_state(ask, "")
   end function is_in_call

   !> Say on the error unit that a library did not come back; may be called by a signal handler.
   subroutine tell_call()
      logical :: ignored

      ignored = change_state(speak, "")
   end subroutine tell_call

   !> Change the state, or ask for it.
   function change_state(task, path) result(answer)
      !> What to do
      integer, intent(in) :: task
      !> File that is read
      character(len=*), intent(in) :: path
      !> Is a library reading?
      logical :: answer

      character(len=*), parameter :: before = "camroller: cannot read '", after = "': it is damaged, the HDF5 library does not "// &
         & "finish reading it"//new_line("a")
      character(kind=c_char), save :: letters(path_length)
      type(c_ptr), save :: timer = c_null_ptr
      logical, save, volatile :: is_armed = .false., is_reading = .false.
      integer, save, volatile :: length = 0
      integer(c_long) :: ignored
      integer(c_int) :: status
      integer :: i

      select case (task)
      case (arm)
         is_armed = .true.
      case (enter, leave)
         if (is_reading) status = c_timer_delete(timer)
         is_reading = .false.
         if (is_armed .and. task == enter) then
            length = min(len(path), path_length)
            do i = 1, length
               letters(i) = path(i:i)
            end do
            is_reading = c_timer_create(thread_clock, c_null_ptr, timer) == 0
            if (is_reading) status = c_timer_settime(timer, 0_c_int, alarm_t(first=[longest_call, 0_c_long]), c_null_ptr)
         end if
      case (speak)
         ignored = c_write(error_descriptor, before, len(before, c_size_t))
         ignored = c_write(error_descriptor, letters, int(length, c_size_t))
         ignored = c_write(error_descriptor, after, len(after, c_size_t))
      end select
      answer = is_reading
   end function change_state

end module camroller_library_watch
