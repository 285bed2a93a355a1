!> A line that tells how far a long run is, on a terminal only.
!>
!> Layer: app. In: cases done. Out: one line on the error unit, rewritten; nothing in a log or in the first second.
module camroller_progress
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : error_unit, int64
   use camroller_number_text, only : integer_text
   implicit none
   private

   public :: progress_t, start_progress, show_progress, end_progress, seconds_since

   !> Width of the line
   integer, parameter :: width = 40
   !> Number of the error unit for the operating system
   integer(c_int), parameter :: error_descriptor = 2

   !> State of the line
   type :: progress_t
      !> Is there somebody to read it?
      logical :: is_wanted = .false.
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
   subroutine start_progress(progress, is_quiet)
      !> The line
      type(progress_t), intent(out) :: progress
      !> Is no line wanted?
      logical, intent(in) :: is_quiet

      progress%is_wanted = c_isatty(error_descriptor) /= 0
      if (is_quiet) progress%is_wanted = .false.
      call system_clock(progress%start)
      progress%last = progress%start
   end subroutine start_progress

   !> Say how far the run is, at most a few times a second.
   subroutine show_progress(progress, done, total)
      !> The line
      type(progress_t), intent(inout) :: progress
      !> Cases done, and all cases
      integer, intent(in) :: done, total

      integer(int64) :: now, rate
      character(len=width) :: line

      if (.not. progress%is_wanted) return
      call system_clock(now, rate)
      if (now - progress%start < rate .or. now - progress%last < rate/5) return
      progress%last = now
      progress%is_shown = .true.
      line = integer_text(done)//" of "//integer_text(total)//" cases"
      write (error_unit, '(2a)', advance="no") achar(13), line
      flush (error_unit)
   end subroutine show_progress

   !> Take the line away.
   subroutine end_progress(progress)
      !> The line
      type(progress_t), intent(inout) :: progress

      if (.not. progress%is_shown) return
      write (error_unit, '(3a)', advance="no") achar(13), repeat(" ", width), achar(13)
      flush (error_unit)
      progress%is_shown = .false.
   end subroutine end_progress

   !> Time since the start, in words.
   function seconds_since(progress) result(words)
      !> The line
      type(progress_t), intent(in) :: progress
      !> Seconds with two digits after the point
      character(len=:), allocatable :: words

      integer(int64) :: now, rate
      character(len=16) :: buffer

      call system_clock(now, rate)
      write (buffer, '(f0.2)') real(now - progress%start)/real(rate)
      words = trim(buffer)//" s"
      if (words(1:1) == ".") words = "0"//words
   end function seconds_since

end module camroller_progress
