!> Words of a random deck: numbers to write, values to read back.
module wide_words
   use camroller_kinds, only : wp
   implicit none
   private

   public :: deck_group, deck_number, deck_word, number_words

   character(len=*), parameter :: nl = new_line("a")

contains

   !> Value of a key as its deck has it, without quotes; blank where it is not there.
   pure function deck_word(text, group, key) result(word)
      !> The deck
      character(len=*), intent(in) :: text
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> The value
      character(len=:), allocatable :: word
      character(len=:), allocatable :: lines
      integer :: first, last

      word = ""
      lines = deck_group(text, group)
      first = index(lines, "   "//key//" = ")
      if (first == 0) return
      first = first + len(key) + 6
      last = first + index(lines(first:), nl) - 2
      if (lines(first:first) == "'") then
         word = lines(first + 1:last - 1)
      else
         word = lines(first:last)
      end if
   end function deck_word

   !> Lines of a group of a deck, from its name to its end, in which its keys are found sooner; empty where it is not there.
   pure function deck_group(text, group) result(lines)
      !> The deck
      character(len=*), intent(in) :: text
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The lines
      character(len=:), allocatable :: lines
      integer :: first, last

      lines = ""
      first = group_place(text, group)
      if (first == 0) return
      last = index(text(first:), nl//"/"//nl)
      lines = text(first:merge(len(text), first + last, last == 0))
   end function deck_group

   !> Where a group of a deck begins, 0 where it is not there. From the end, since most that is asked while a deck is drawn is of
   !> its last group; by its first character, in a fifth of the time of `index`, where most of the time of a draw would go.
   pure function group_place(text, group) result(place)
      !> The deck
      character(len=*), intent(in) :: text
      !> Name of the group
      character(len=*), intent(in) :: group
      !> Place of its first character
      integer :: place

      do place = len(text) - len(group) - 1, 1, -1
         if (text(place:place) /= "&") cycle
         if (text(place + 1:place + len(group)) == group .and. text(place + len(group) + 1:place + len(group) + 1) == nl) return
      end do
      place = 0
   end function group_place

   !> A number of a deck; zero where it is not there.
   pure function deck_number(text, group, key) result(value)
      !> The deck
      character(len=*), intent(in) :: text
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> The value [unit of the key]
      real(wp) :: value
      character(len=:), allocatable :: word

      value = 0.0_wp
      word = deck_word(text, group, key)
      if (word /= "") read (word, *) value
   end function deck_number

   !> A number as text, with more digits than are drawn.
   pure function number_words(value) result(words)
      ! [any]
      real(wp), intent(in) :: value
      character(len=:), allocatable :: words
      character(len=24) :: buffer

      write (buffer, "(es23.15e3)") value
      words = trim(adjustl(buffer))
   end function number_words

end module wide_words
