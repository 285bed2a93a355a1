!> Standard output and standard error of the program.
!>
!> In: texts. Out: the same on the stream, with an error where standard output could not be written. All text of the program is
!> written here and none by Fortran's units, whose buffers may be lost without an error where the disk is full. A closed pipe
!> (`camroller help | head -1`) is not an error.
module camroller_streams
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t, c_null_char
   use camroller_c_library, only : c_close, c_open, c_signal
   use camroller_error, only : error_t, raise, kind_file
   use camroller_raw_file, only : write_letters
   implicit none
   private

   public :: print_text, print_lines, tell, hold_streams, close_output_stream

   !> Descriptors; signal of a closed pipe; what `signal` takes for ignoring it; how files are opened that are read only
   integer(c_int), parameter :: output_descriptor = 1_c_int, error_descriptor = 2_c_int, signal_pipe = 13_c_int
   integer(c_intptr_t), parameter :: ignore_signal = 1_c_intptr_t
   integer(c_int), parameter :: read_only = 0_c_int

contains

   !> Write to the output unit.
   subroutine print_text(text, error)
      !> The text, with the ends of its lines
      character(len=*), intent(in) :: text
      !> File error where the output did not take it
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason
      logical :: is_unread

      call write_letters(output_descriptor, text, reason, is_unread)
      if (reason /= "" .and. .not. is_unread) call raise(error, kind_file, "cannot write to standard output: "//reason)
   end subroutine print_text

   !> Write a line, or lines without the end of the last one, to the output unit.
   subroutine print_lines(text, error)
      !> The text
      character(len=*), intent(in) :: text
      !> File error where the output did not take it
      type(error_t), allocatable, intent(out) :: error

      call print_text(text//new_line("a"), error)
   end subroutine print_lines

   !> Write to the error unit; a failure there cannot be reported.
   subroutine tell(text)
      !> The text, with the ends of its lines
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: reason
      logical :: is_unread

      call write_letters(error_descriptor, text, reason, is_unread)
   end subroutine tell

   !> For a program, before anything else: a closed pipe does not end it, and where one of the three streams is closed no
   !> file gets its number, which then would be written to.
   subroutine hold_streams()
      integer(c_intptr_t) :: former
      integer(c_int) :: descriptor, ignored

      former = c_signal(signal_pipe, ignore_signal)
      do
         descriptor = c_open("/"//c_null_char, read_only)
         if (descriptor < 0 .or. descriptor > error_descriptor) exit
      end do
      if (descriptor > error_descriptor) ignored = c_close(descriptor)
   end subroutine hold_streams

   !> Close the output unit: some devices tell only then that they have not taken all of it.
   subroutine close_output_stream(error)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (c_close(output_descriptor) /= 0) call raise(error, kind_file, "cannot write to standard output: the write failed")
   end subroutine close_output_stream

end module camroller_streams
