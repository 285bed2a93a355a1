!> Is a text in UTF-8? Result files hold the text of their deck, and readers of HDF5 and XML take nothing else.
!>
!> In: a text. Out: a mistake at the first line that is in another encoding.
module camroller_text_encoding
   use camroller_mistakes, only : add_mistake, continues, mistakes_t
   use camroller_number_text, only : integer_text
   use camroller_text_lines, only : line_at, text_lines_t
   implicit none
   private

   public :: check_encoding, first_foreign

   !> U+00A0 in UTF-8
   character(len=*), parameter :: no_break_space = char(194)//char(160)

contains

   !> Complain about the first line that is no UTF-8.
   pure subroutine check_encoding(lines, mistakes, path)
      !> The text
      type(text_lines_t), intent(in) :: lines
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> Its file, where that is not the deck
      character(len=*), intent(in), optional :: path

      integer :: i, place
      character(len=:), allocatable :: reason

      do i = 1, lines%count
         associate (line => lines%text(lines%first(i):lines%last(i)))
            place = first_foreign(line)
            reason = "byte "//integer_text(place)//" of this line is no UTF-8, but perhaps Latin-1; save the text in UTF-8"
            if (place == 0) then
               place = index(line, no_break_space)
               ! Text in quotes and comments may have it
               if (scan(line(:place), "'""!#") > 0) place = 0
               reason = "byte "//integer_text(place)//" of this line is a no-break space, which looks like a blank and is none"
            end if
         end associate
         if (place == 0) cycle
         if (present(path)) then
            call add_mistake(mistakes, reason, i, 0, 0, path, line_at(lines, i))
         else
            call add_mistake(mistakes, reason, i, place, 1)
         end if
         return
      end do
   end subroutine check_encoding

   !> Place of the first byte that begins no character of UTF-8 (RFC 3629), 0 where there is none.
   pure function first_foreign(text) result(place)
      !> The text
      character(len=*), intent(in) :: text
      !> The place
      integer :: place

      integer :: length, i

      place = 1
      do while (place <= len(text))
         select case (iachar(text(place:place)))
         case (:127)
            length = 1
         case (194:223)
            length = 2
         case (224:239)
            length = 3
         case (240:244)
            length = 4
         case default
            return
         end select
         if (place + length - 1 > len(text)) return
         if (length > 1) then
            if (.not. all([(continues(text(i:i)), i=place + 1, place + length - 1)])) return
            if (is_out_of_range(iachar(text(place:place)), iachar(text(place + 1:place + 1)))) return
         end if
         place = place + length
      end do
      place = 0
   end function first_foreign

   !> Are two bytes the start of a character that is written too long, of half a pair of UTF-16, or beyond the last one?
   pure function is_out_of_range(first, second) result(verdict)
      !> The bytes
      integer, intent(in) :: first, second
      !> Are they?
      logical :: verdict

      verdict = (first == 224 .and. second < 160) .or. (first == 237 .and. second > 159) .or. (first == 240 .and. second < 144) &
         & .or. (first == 244 .and. second > 143)
   end function is_out_of_range

end module camroller_text_encoding
