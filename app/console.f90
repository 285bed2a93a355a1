!> What follows a long run on the screen: remarks, and its progress: one line that is rewritten on a terminal, plain lines from time
!> to time in a log.
!>
!> In: cases done, remarks. Out: a line on the error unit with rate and time left; nothing in the first second, and nothing in
!> a log where no interval is given; whether a signal asked the program to stop.
module camroller_console
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_deck, only : deck_t
   use camroller_error, only : error_t
   use camroller_deck_remarks, only : list_deck_remarks, list_number_remarks
   use camroller_text_lines, only : line_t
   use camroller_kinds, only : wp
   use camroller_number_text, only : counted, number_text, fixed_text, integer_text
   use camroller_monitor, only : monitor_t
   use camroller_stop_signal, only : is_stop_wanted
   use camroller_streams, only : tell
   implicit none
   private

   public :: console_t, start_console, seconds_since, time_in_words, tell_deck_remarks, add_number_remarks

   !> Width of the line
   integer, parameter :: width = 72
   !> Number of the error unit for the operating system
   integer(c_int), parameter :: error_descriptor = 2

   !> Somebody at a screen
   type, extends(monitor_t) :: console_t
      !> Nothing but errors and losses?
      logical :: is_quiet = .false.
      !> Do signals ask for an end, with what is done kept, instead of ending the program?
      logical :: heeds_signals = .false.
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
   contains
      procedure :: wants_stop
      procedure :: show
      procedure :: say
      procedure :: end_cases
   end type console_t

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
   subroutine start_console(console, is_quiet, interval)
      !> The console
      type(console_t), intent(out) :: console
      !> Is no line wanted?
      logical, intent(in) :: is_quiet
      !> Time between lines in a log [s]; without it there are none
      real(wp), intent(in), optional :: interval

      console%is_terminal = c_isatty(error_descriptor) /= 0
      console%is_wanted = console%is_terminal .or. present(interval)
      console%is_quiet = is_quiet
      if (is_quiet) console%is_wanted = .false.
      if (present(interval)) console%interval = interval
      call system_clock(console%start)
      console%last = console%start
   end subroutine start_console

   !> Has a signal asked for an end?
   function wants_stop(self) result(verdict)
      class(console_t), intent(inout) :: self
      !> Has it?
      logical :: verdict

      verdict = .false.
      if (self%heeds_signals) verdict = is_stop_wanted()
   end function wants_stop

   !> Say something about the computation.
   subroutine say(self, text, is_loss)
      class(console_t), intent(inout) :: self
      !> Lines without the end of the last one
      character(len=*), intent(in) :: text
      !> Is something lost? Then it is said to those who want quiet too
      logical, intent(in) :: is_loss

      if (is_loss .or. .not. self%is_quiet) call tell(text//new_line("a"))
   end subroutine say

   !> Say how far the run is: a few times a second on a terminal.
   subroutine show(self, done, total)
      class(console_t), intent(inout) :: self
      !> Cases done, and all cases
      integer, intent(in) :: done, total

      integer(int64) :: now, rate
      character(len=width) :: line

      if (.not. self%is_wanted) return
      call system_clock(now, rate)
      if (self%is_terminal) then
         if (now - self%start < rate .or. now - self%last < rate/5) return
         line = state_in_words(done, total, real(now - self%start, wp)/real(rate, wp))
         call tell(achar(13)//line)
         self%is_shown = .true.
      else
         if (real(now - self%last, wp) < self%interval*real(rate, wp) .or. done >= total) return
         call tell(state_in_words(done, total, real(now - self%start, wp)/real(rate, wp))//new_line("a"))
      end if
      self%last = now
   end subroutine show

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
   subroutine end_cases(self)
      class(console_t), intent(inout) :: self

      if (self%is_shown) call tell(achar(13)//repeat(" ", width)//achar(13))
      self%is_shown = .false.
   end subroutine end_cases

   !> Time since the start, in words.
   function seconds_since(console) result(words)
      !> The console
      type(console_t), intent(in) :: console
      !> Seconds with two digits after the point
      character(len=:), allocatable :: words

      integer(int64) :: now, rate

      call system_clock(now, rate)
      words = fixed_text(real(now - console%start, wp)/real(rate, wp), 2)//" s"
   end function seconds_since

   !> Add to an error what may be its reason: numbers of the deck that no engine has, or all remarks on a deck without mistakes.
   subroutine add_number_remarks(deck, error, is_whole)
      !> The deck, as far as it could be read
      type(deck_t), intent(in) :: deck
      !> An error on its way up; left alone where not allocated
      type(error_t), allocatable, intent(inout) :: error
      !> Is the deck without mistakes?
      logical, intent(in) :: is_whole

      type(line_t), allocatable :: remarks(:)
      integer :: i

      if (.not. allocated(error)) return
      if (is_whole) then
         call list_deck_remarks(deck, remarks)
      else
         call list_number_remarks(deck, remarks)
      end if
      do i = 1, size(remarks)
         error%message = error%message//new_line("a")//"remark: "//remarks(i)%text
      end do
   end subroutine add_number_remarks

   !> Show remarks on the numbers of a deck.
   subroutine tell_deck_remarks(deck, of_hosts)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Are followers to be driven step by step? Not without it
      logical, intent(in), optional :: of_hosts

      type(line_t), allocatable :: remarks(:)
      integer :: i

      call list_deck_remarks(deck, remarks, of_hosts)
      do i = 1, size(remarks)
         call tell("remark: "//remarks(i)%text//new_line("a"))
      end do
   end subroutine tell_deck_remarks

end module camroller_console
