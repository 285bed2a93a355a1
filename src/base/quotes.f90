!> Texts in quotes, as namelists have them: the same quote at both ends, doubled inside; letters of a text replaced.
!>
!> In: a text. Out: the text with quotes or without, or with other words for a letter.
module camroller_quotes
   implicit none
   private

   public :: is_quoted, in_quotes, without_quotes, occurrences, replaced, xml_length, xml_text

   !> Quotes that a text may stand in
   character(len=*), parameter :: quotes = "'"""

contains

   !> Is a text one text in quotes, quotes inside doubled?
   pure function is_quoted(text) result(verdict)
      !> The text, without blanks around it
      character(len=*), intent(in) :: text
      !> Is it?
      logical :: verdict

      integer :: place

      verdict = .false.
      if (len(text) < 2) return
      if (scan(text(1:1), quotes) == 0) return
      place = 2
      do while (place <= len(text))
         if (text(place:place) == text(1:1)) then
            if (place == len(text)) then
               verdict = .true.
               return
            end if
            if (text(place + 1:place + 1) /= text(1:1)) return
            place = place + 1
         end if
         place = place + 1
      end do
   end function is_quoted

   !> How often a letter stands in a text.
   pure function occurrences(text, letter) result(number)
      !> The text
      character(len=*), intent(in) :: text
      !> The letter
      character(len=1), intent(in) :: letter
      !> How often
      integer :: number

      integer :: i

      number = 0
      do i = 1, len(text)
         if (text(i:i) == letter) number = number + 1
      end do
   end function occurrences

   !> A text with words in the place of a letter.
   pure function replaced(text, letter, words) result(new)
      !> The text
      character(len=*), intent(in) :: text
      !> The letter
      character(len=1), intent(in) :: letter
      !> What stands in its place
      character(len=*), intent(in) :: words
      !> The text with them
      character(len=len(text) + occurrences(text, letter)*(len(words) - 1)) :: new

      integer :: i, last

      last = 0
      do i = 1, len(text)
         if (text(i:i) == letter) then
            new(last + 1:last + len(words)) = words
            last = last + len(words)
         else
            last = last + 1
            new(last:last) = text(i:i)
         end if
      end do
   end function replaced

   !> Length of a text as it stands in XML.
   pure function xml_length(text) result(length)
      !> The text
      character(len=*), intent(in) :: text
      !> The length
      integer :: length

      length = len(text) + 4*occurrences(text, "&") + 3*(occurrences(text, "<") + occurrences(text, ">"))
   end function xml_length

   !> A text as it stands in XML.
   pure function xml_text(text) result(escaped)
      !> The text
      character(len=*), intent(in) :: text
      !> With what has a meaning in XML replaced, but for quotes
      character(len=xml_length(text)) :: escaped

      escaped = replaced(replaced(replaced(text, "&", "&amp;"), "<", "&lt;"), ">", "&gt;")
   end function xml_text

   !> Length of what a text in quotes says.
   pure function plain_length(text) result(length)
      !> The text, without blanks around it
      character(len=*), intent(in) :: text
      !> The length
      integer :: length

      length = len(text)
      if (is_quoted(text)) length = length - 2 - (occurrences(text, text(1:1)) - 2)/2
   end function plain_length

   !> A text in single quotes, those inside doubled.
   pure function in_quotes(text) result(quoted)
      !> The text
      character(len=*), intent(in) :: text
      !> The same in quotes
      character(len=len(text) + 2 + occurrences(text, "'")) :: quoted

      quoted = "'"//replaced(text, "'", "''")//"'"
   end function in_quotes

   !> What a text in quotes says; a text that is none, as it is.
   pure function without_quotes(text) result(plain)
      !> The text, without blanks around it
      character(len=*), intent(in) :: text
      !> The same without quotes
      character(len=plain_length(text)) :: plain

      integer :: i, place

      plain = text
      if (.not. is_quoted(text)) return
      plain = ""
      place = 0
      i = 2
      do while (i < len(text))
         place = place + 1
         plain(place:place) = text(i:i)
         i = i + merge(2, 1, text(i:i) == text(1:1))
      end do
   end function without_quotes

end module camroller_quotes
