!> The end of the program, and signals that ask for it or say that a library broke down.
!>
!> A signal ends the program, and unfinished files are removed before; or it is noted, so that the program can ask for it where
!> stopping does no harm.
!>
!> In: nothing. Out: whether somebody wants the program to end. A handler can be given nothing to write to, hence
!> the saved variables. Holding the signals back and asking what is pending would need none, but other
!> libraries start threads of their own, to which the system then hands them.
module camroller_stop_signal
   use, intrinsic :: iso_c_binding, only : c_funloc, c_funptr, c_int, c_intptr_t
   use camroller_error, only : kind_file
   use camroller_library_watch, only : is_in_call, tell_call, watch_library
   use camroller_unfinished, only : remove_remembered
   implicit none
   private

   public :: end_process, end_on_signals, heed_stop_signals, is_stop_wanted, release_stop_signals

   !> Interrupt from the terminal, first user signal, end
   integer(c_int), parameter :: stop_signals(*) = [2_c_int, 10_c_int, 15_c_int]
   !> Those that end the program, the end of its terminal and the first user signal
   integer(c_int), parameter :: end_signals(*) = [1_c_int, 2_c_int, 10_c_int, 15_c_int]
   !> Those of a library that breaks down or does not come back: abort, wrong address (two of them), time
   integer(c_int), parameter :: break_signals(*) = [6_c_int, 7_c_int, 11_c_int, 14_c_int]
   !> What `signal` takes for what a signal does by itself, and gives for one that is ignored
   integer(c_intptr_t), parameter :: by_itself = 0_c_intptr_t, ignored_signal = 1_c_intptr_t

   interface
      subroutine c_exit(code) bind(C, name="_exit")
         import :: c_int
         integer(c_int), value :: code
      end subroutine c_exit
      function c_signal(number, handler) bind(C, name="signal") result(former)
         import :: c_funptr, c_int, c_intptr_t
         integer(c_int), value :: number
         type(c_funptr), value :: handler
         integer(c_intptr_t) :: former
      end function c_signal

      function c_signal_default(number, handler) bind(C, name="signal") result(former)
         import :: c_int, c_intptr_t
         integer(c_int), value :: number
         integer(c_intptr_t), value :: handler
         integer(c_intptr_t) :: former
      end function c_signal_default

      function c_pthread_self() bind(C, name="pthread_self") result(thread)
         import :: c_intptr_t
         integer(c_intptr_t) :: thread
      end function c_pthread_self

      function c_pthread_kill(thread, number) bind(C, name="pthread_kill") result(status)
         import :: c_int, c_intptr_t
         integer(c_intptr_t), value :: thread
         integer(c_int), value :: number
         integer(c_int) :: status
      end function c_pthread_kill

      function c_raise(number) bind(C, name="raise") result(status)
         import :: c_int
         integer(c_int), value :: number
         integer(c_int) :: status
      end function c_raise
   end interface

contains

   !> End the program, at once.
   !>
   !> Libraries are not asked to end: OpenBLAS waits for its threads, and where there is little memory a thread of it never comes to
   !> its first line. So everything that is to be kept has to be written and closed before.
   subroutine end_process(code)
      !> Exit code
      integer, intent(in) :: code

      call c_exit(int(code, c_int))
   end subroutine end_process

   !> Let signals end the program, files that are not finished removed; what was to be ignored still is.
   subroutine end_on_signals()
      integer(c_intptr_t) :: former
      integer :: i

      former = writing_thread(c_pthread_self())
      do i = 1, size(end_signals)
         former = c_signal(end_signals(i), c_funloc(end_by_signal))
         if (former == ignored_signal) former = c_signal_default(end_signals(i), ignored_signal)
      end do
      do i = 1, size(break_signals)
         former = handler_before(i, c_signal(break_signals(i), c_funloc(end_by_break)))
      end do
      call watch_library()
   end subroutine end_on_signals

   !> The thread that writes files.
   function writing_thread(thread) result(kept)
      !> The thread, to be kept; left out to ask
      integer(c_intptr_t), intent(in), optional :: thread
      !> The one that is kept
      integer(c_intptr_t) :: kept

      integer(c_intptr_t), save :: writer = 0_c_intptr_t

      if (present(thread)) writer = thread
      kept = writer
   end function writing_thread

   !> What was done about a signal of a library that breaks down.
   function handler_before(place, handler) result(kept)
      !> Place of the signal in the list
      integer, intent(in) :: place
      !> What was done about it, to be kept; left out to ask
      integer(c_intptr_t), intent(in), optional :: handler
      !> What is kept
      integer(c_intptr_t) :: kept

      integer(c_intptr_t), save :: handlers(size(break_signals)) = by_itself

      if (present(handler)) handlers(place) = handler
      kept = handlers(place)
   end function handler_before

   !> End the program where a library breaks down, as the handler of signals: with words where it was reading a file, otherwise as
   !> it would end without this handler, which is with a list of the calls that led there.
   subroutine end_by_break(number) bind(C)
      !> Number of the signal
      integer(c_int), value :: number

      integer(c_intptr_t) :: ignored_handler
      integer(c_int) :: ignored

      call remove_remembered()
      if (is_in_call()) then
         call tell_call()
         call end_process(kind_file)
      end if
      ignored_handler = c_signal_default(number, handler_before(findloc(break_signals, number, dim=1)))
      ignored = c_raise(number)
   end subroutine end_by_break

   !> End the program by a signal, as its handler. The system may interrupt a thread of a library by it: it is passed on, since
   !> the thread that writes could otherwise create a file between the removal and the end.
   subroutine end_by_signal(number) bind(C)
      !> Number of the signal
      integer(c_int), value :: number

      integer(c_intptr_t) :: former
      integer(c_int) :: ignored

      if (c_pthread_self() /= writing_thread()) then
         ignored = c_pthread_kill(writing_thread(), number)
         return
      end if
      call remove_remembered()
      former = c_signal_default(number, by_itself)
      ignored = c_raise(number)
   end subroutine end_by_signal

   !> Take note of the signals from now on.
   subroutine heed_stop_signals()
      integer(c_intptr_t) :: ignored
      integer :: i

      do i = 1, size(stop_signals)
         ignored = c_signal(stop_signals(i), c_funloc(note_signal))
      end do
   end subroutine heed_stop_signals

   !> Let the signals end the program again.
   subroutine release_stop_signals()
      integer(c_intptr_t) :: ignored
      integer :: i

      do i = 1, size(stop_signals)
         ignored = c_signal_default(stop_signals(i), by_itself)
      end do
      call end_on_signals()
   end subroutine release_stop_signals

   !> Has one of the signals come?
   function is_stop_wanted() result(verdict)
      !> Has it?
      logical :: verdict

      verdict = note_signal(0_c_int) /= 0
   end function is_stop_wanted

   !> Take note of a signal, as its handler, or ask for the last one.
   function note_signal(number) bind(C) result(noted)
      !> Number of the signal; 0 to ask
      integer(c_int), value :: number
      !> The last signal; 0 for none
      integer(c_int) :: noted

      integer(c_int), save, volatile :: last = 0_c_int

      if (number /= 0) last = number
      noted = last
   end function note_signal

end module camroller_stop_signal
