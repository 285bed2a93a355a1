!> Values of a deck in the one spelling that all spellings of a value have in common.
!>
!> In: the text of a value as a deck may have it. Out: its words with a comma between, numbers with as few digits as give them back,
!> `3*1.5` written out. Values that differ stay different.
module camroller_canonical_value
   use camroller_kinds, only : wp
   use camroller_deck_values, only : next_word
   use camroller_number_text, only : append_number, is_number
   use camroller_quotes, only : in_quotes, is_quoted, without_quotes
   use camroller_value_syntax, only : is_yes, is_yes_or_no
   implicit none
   private

   public :: spell_value

contains

   !> Spell a value.
   pure subroutine spell_value(text, spelling)
      !> Text of the value, which its key takes
      character(len=*), intent(in) :: text
      !> The one spelling
      character(len=:), allocatable, intent(out) :: spelling

      character(len=:), allocatable :: word, buffer
      integer :: position, first, last, star, repeats, length, i

      ! Room that doubles: a list may have millions of words
      allocate (character(len=len(text) + 1) :: buffer)
      length = 0
      position = 1
      do
         call next_word(text, position, first, last)
         if (first == 0) exit
         star = index(text(first:last), "*")
         repeats = 1
         if (is_quoted(text(first:last)) .or. star < 2) star = 0
         if (star > 0) call read_repeats(text(first:first + star - 2), repeats, star)
         call spell_word(text(first + star:last), word)
         do i = 1, repeats
            do while (length + len(word) + 2 > len(buffer))
               buffer = buffer//repeat(" ", len(buffer))
            end do
            if (length > 0) then
               buffer(length + 1:length + 2) = ", "
               length = length + 2
            end if
            buffer(length + 1:length + len(word)) = word
            length = length + len(word)
         end do
      end do
      spelling = buffer(:length)
   end subroutine spell_value

   !> How often a word is repeated.
   pure subroutine read_repeats(digits, repeats, star)
      !> What stands before the star
      character(len=*), intent(in) :: digits
      integer, intent(inout) :: repeats
      !> Place of the star; 0 where it is none of repeats
      integer, intent(inout) :: star

      integer :: status

      status = 1
      if (verify(digits, "0123456789") == 0) read (digits, *, iostat=status) repeats
      if (status == 0) return
      repeats = 1
      star = 0
   end subroutine read_repeats

   !> Spell one word.
   pure subroutine spell_word(word, spelling)
      character(len=*), intent(in) :: word
      character(len=:), allocatable, intent(out) :: spelling

      real(wp) :: number ! [unit of the key]
      integer :: status

      spelling = word
      if (is_quoted(word)) then
         spelling = in_quotes(without_quotes(word))
      else if (is_number(word)) then
         read (word, *, iostat=status) number
         if (status == 0) then
            spelling = ""
            call append_number(spelling, number)
         end if
      else if (is_yes_or_no(word)) then
         spelling = merge(".true. ", ".false.", is_yes(word))
         spelling = trim(spelling)
      end if
   end subroutine spell_word

end module camroller_canonical_value
