!> Progress of a long run: one line that is rewritten on a terminal, plain lines from time to time in a log.
!>
!> In: cases done. Out: a line on the error unit with rate and time left; nothing in the first second, and nothing in
!> a log where no interval is given.
module camroller_progress
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_number_text, only : counted, number_text, fixed_text, integer_text
   use camroller_streams, only : tell
   implicit none
   private

   public :: progress_t, start_progress, show_progress, end_progress, seconds_since, time_in_words

   !> Width of the line
   integer, parameter :: width = 72
   !> Number of the error unit for the operating system
   integer(c_int), parameter :: error_descriptor = 2

   !> State of the line
   type :: progress_t
      !> Is there somebody to read it?
      logical :: is_wanted = .false.
      !> Is it a terminal?
      logical :: is_terminal = .false.
      !> Time between lines in a log [s]
      real(wp) :: interval = 0.0_wp
      !> Is there a line on the terminal?
      logical :: is_shown = .false.
      !> Clock at the start, and at the last change of the line
      integer(int64) :: start = 0, last = 0
   end type progress_t

   interface
      !> Is a descriptor a terminal?
      function c_isatty(descriptor) bind(C, name="isatty") result(verdict)
         import :: c_int
         implicit none
         integer(c_int), value :: descriptor
         integer(c_int) :: verdict
      end function c_isatty
   end interface

contains

   !> Begin.
   subroutine start_progress(progress, is_quiet, interval)
      !> The line
      type(progress_t), intent(out) :: progress
      !> Is no line wanted?
      logical, intent(in) :: is_quiet
      !> Time between lines in a log [s]; without it there are none
      real(wp), intent(in), optional :: interval

      progress%is_terminal = c_isatty(error_descriptor) /= 0
      progress%is_wanted = progress%is_terminal .or. present(interval)
      if (is_quiet) progress%is_wanted = .false.
      if (present(interval)) progress%interval = interval
      call system_clock(progress%start)
      progress%last = progress%start
   end subroutine start_progress

   !> Say how far the run is: a few times a second on a terminal.
   subroutine show_progress(progress, done, total)
      !> The line
      type(progress_t), intent(inout) :: progress
      !> Cases done, and all cases
      integer, intent(in) :: done, total

      integer(int64) :: now, rate
      character(len=width) :: line

      if (.not. progress%is_wanted) return
      call system_clock(now, rate)
      if (progress%is_terminal) then
         if (now - progress%start < rate .or. now - progress%last < rate/5) return
         line = state_in_words(done, total, real(now - progress%start, wp)/real(rate, wp))
         call tell(achar(13)//line)
         progress%is_shown = .true.
      else
         if (real(now - progress%last, wp) < progress%interval*real(rate, wp) .or. done >= total) return
         call tell(state_in_words(done, total, real(now - progress%start, wp)/real(rate, wp))//new_line("a"))
      end if
      progress%last = now
   end subroutine show_progress

   !> Cases done, cases in a second, time left.
   pure function state_in_words(done, total, time) result(words)
      !> Cases done, and all cases
      integer, intent(in) :: done, total
      !> Time since the start [s]
      real(wp), intent(in) :: time
      !> The words
      character(len=:), allocatable :: words

      words = integer_text(done)//" of "//counted(total, "case")
      if (done == 0) return
      words = words//", "//number_text(real(done, wp)/time, 3)//"/s, "//time_in_words(time*real(total - done, wp)/ &
         & real(done, wp))//" left"
   end function state_in_words

   !> A time in the unit that suits it.
   pure function time_in_words(time) result(words)
      !> The time [s]
      real(wp), intent(in) :: time
      !> The words
      character(len=:), allocatable :: words

      if (time < 100.0_wp) then
         words = integer_text(nint(time))//" s"
      else if (time < 6000.0_wp) then
         words = integer_text(nint(time/60.0_wp))//" min"
      else
         words = number_text(time/3600.0_wp, 3)//" h"
      end if
   end function time_in_words

   !> Take the line away.
   subroutine end_progress(progress)
      !> The line
      type(progress_t), intent(inout) :: progress

      if (.not. progress%is_shown) return
      call tell(achar(13)//repeat(" ", width)//achar(13))
      progress%is_shown = .false.
   end subroutine end_progress

   !> Time since the start, in words.
   function seconds_since(progress) result(words)
      !> The line
      type(progress_t), intent(in) :: progress
      !> Seconds with two digits after the point
      character(len=:), allocatable :: words

      integer(int64) :: now, rate

      call system_clock(now, rate)
      words = fixed_text(real(now - progress%start, wp)/real(rate, wp), 2)//" s"
   end function seconds_since

end module camroller_progress
