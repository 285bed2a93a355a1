!> The syntax of values in a namelist: is a text one that a read takes?
!>
!> In: a text. Out: a verdict, for a list the number of its places. What passes is read without an error; what does not is never
!> handed to a read.
module camroller_value_syntax
   use camroller_deck_text, only : to_lower
   use camroller_number_text, only : is_number
   use camroller_quotes, only : occurrences
   implicit none
   private

   public :: count_numbers, is_yes, is_yes_or_no

   !> What parts the values of a list
   character(len=*), parameter :: separators = " ,"//char(9)//char(10)//char(13)
   character(len=*), parameter :: digits = "0123456789"
   !> Words for yes and no
   character(len=*), parameter :: yes_or_no(*) = [character(len=7) :: ".true.", ".false.", "true", "false", ".t.", ".f.", "t", "f"]
   !> Words that a read takes for a number that is none
   character(len=*), parameter :: no_numbers(*) = [character(len=8) :: "nan", "inf", "infinity"]

contains

   !> Number of places of a list of numbers, `3*1.5` for three of them, those without a value included.
   pure function count_numbers(text, most, is_whole) result(places)
      !> The text
      character(len=*), intent(in) :: text
      !> Most places that there may be
      integer, intent(in) :: most
      !> Are whole numbers wanted?
      logical, intent(in) :: is_whole
      !> The places, `most + 1` for more; -1 where the text is no such list
      integer :: places

      integer :: first, last, star, repeats
      logical :: verdict

      places = 0
      verdict = .true.
      last = 0
      do while (verdict)
         first = verify(text(last + 1:), separators) + last
         if (first == last) exit
         places = places + max(0, occurrences(text(last + 1:first - 1), ",") - merge(1, 0, last > 0))
         last = scan(text(first:), separators)
         last = merge(len(text), first + last - 2, last == 0)
         star = index(text(first:last), "*")
         repeats = 1
         if (star > 0) call read_repeats(text(first:first + star - 2), most, repeats, verdict)
         places = min(places + repeats, most + 1)
         if (verdict .and. first + star <= last) verdict = is_value(text(first + star:last), is_whole)
      end do
      places = min(places + occurrences(text(last + 1:), ","), most + 1)
      if (.not. verdict) places = -1
   end function count_numbers

   !> How often a value is repeated.
   pure subroutine read_repeats(word, most, repeats, is_right)
      !> What stands before the star
      character(len=*), intent(in) :: word
      !> Most repeats that matter
      integer, intent(in) :: most
      !> The repeats, `most + 1` for more
      integer, intent(out) :: repeats
      !> Is the word a number above zero?
      logical, intent(out) :: is_right

      integer :: i

      repeats = 0
      is_right = len(word) > 0 .and. verify(word, digits) == 0
      if (.not. is_right) return
      do i = 1, len(word)
         repeats = min(10*repeats + index(digits, word(i:i)) - 1, most + 1)
      end do
      is_right = repeats > 0
   end subroutine read_repeats

   !> Is a word a number of its kind?
   pure function is_value(word, is_whole) result(verdict)
      character(len=*), intent(in) :: word
      !> Is a whole number wanted?
      logical, intent(in) :: is_whole
      !> Is it?
      logical :: verdict

      integer :: start

      start = 1
      if (scan(word, "+-") == 1) start = 2
      if (is_whole) then
         verdict = start <= len(word) .and. verify(word(start:), digits) == 0
      else
         verdict = is_number(word) .or. any(to_lower(word(start:)) == no_numbers)
      end if
   end function is_value

   !> Does a logical value say yes?
   pure function is_yes(text) result(verdict)
      !> The value, without blanks around it
      character(len=*), intent(in) :: text
      !> Does it?
      logical :: verdict

      verdict = scan(text(:min(2, len(text))), "tT") > 0
   end function is_yes

   !> Is a text a logical value?
   pure function is_yes_or_no(text) result(verdict)
      !> The text, without blanks around it
      character(len=*), intent(in) :: text
      !> Is it?
      logical :: verdict

      verdict = any(to_lower(text) == yes_or_no)
   end function is_yes_or_no

end module camroller_value_syntax
