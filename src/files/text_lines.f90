!> Start and end of each line of a text, found in one pass.
!>
!> In: a text. Out: `text_lines_t`, which keeps the text in one piece, so that a text of millions of lines needs little more
!> memory than its own size.
module camroller_text_lines
   use camroller_quotes, only : occurrences
   implicit none
   private

   public :: line_t, text_lines_t, add_line, split_lines, line_at

   !> One line of text
   type :: line_t
      !> Its characters, without the end of line
      character(len=:), allocatable :: text
   end type line_t

   !> A text and its lines; carriage returns before the ends of lines belong to none, and end lines where nothing else does
   type :: text_lines_t
      !> The text
      character(len=:), allocatable :: text
      !> Number of lines
      integer :: count = 0
      !> First and last character of each line; the last is before the first in an empty one
      integer, allocatable :: first(:), last(:)
   end type text_lines_t

contains

   !> Find the lines of a text.
   pure subroutine split_lines(text, lines)
      !> The text
      character(len=*), intent(in) :: text
      !> Its lines
      type(text_lines_t), intent(out) :: lines

      character(len=1) :: ending
      integer :: i, n, first

      lines%text = text
      ending = new_line("a")
      if (index(text, ending) == 0 .and. index(text, char(13)) > 0) ending = char(13)
      n = occurrences(text, ending)
      if (len(text) > 0) then
         if (text(len(text):) /= ending) n = n + 1
      end if
      lines%count = n
      allocate (lines%first(n), lines%last(n))
      first = 1
      n = 0
      do i = 1, len(text)
         if (text(i:i) /= ending .and. i < len(text)) cycle
         n = n + 1
         lines%first(n) = first
         lines%last(n) = merge(i - 1, i, text(i:i) == ending)
         first = i + 1
         if (lines%last(n) < lines%first(n)) cycle
         if (text(lines%last(n):lines%last(n)) == char(13)) lines%last(n) = lines%last(n) - 1
      end do
   end subroutine split_lines

   !> One line.
   pure function line_at(lines, number) result(line)
      !> The lines
      type(text_lines_t), intent(in) :: lines
      !> Number of the line, from 1
      integer, intent(in) :: number
      !> Its characters, without the end of line
      character(len=max(0, lines%last(number) - lines%first(number) + 1)) :: line

      line = lines%text(lines%first(number):lines%last(number))
   end function line_at

   !> Lengthen a list of lines. A constructor within a list would leak its text with gfortran.
   subroutine add_line(lines, text)
      !> Lines so far
      type(line_t), allocatable, intent(inout) :: lines(:)
      !> One more
      character(len=*), intent(in) :: text

      type(line_t) :: new

      new%text = text
      lines = [lines, new]
   end subroutine add_line

end module camroller_text_lines
