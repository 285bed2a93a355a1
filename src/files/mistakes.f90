!> Mistakes in a deck and in its tables: collected, sorted by position, and reported together.
!>
!> In: positions and sentences. Out: one error whose message shows, for each mistake, file and line, the line itself and a caret
!> below the words that are wrong. The length of the message is bounded: the first mistakes are shown and the others counted; of
!> a long line, the part around the mistake is shown.
module camroller_mistakes
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_number_text, only : integer_text
   use camroller_text_lines, only : text_lines_t, line_at
   implicit none
   private

   public :: mistakes_t, add_mistake, is_shown_at, raise_mistakes, shown, override_place, continues

   !> Where a mistake is that stands in no file: in a value given beside the deck
   character(len=*), parameter :: override_place = "override"
   !> Mistakes that are shown
   integer, parameter :: most_shown = 20
   !> Letters of a message; more would be a mistake of this program
   integer, parameter :: longest_message = 3000
   !> Letters that are shown of a line, and of a word within a sentence
   integer, parameter :: longest_line = 160, longest_word = 60

   !> One mistake
   type :: mistake_t
      !> File it is in; blank for the deck
      character(len=:), allocatable :: file
      !> Line, 0 where there is none
      integer :: line = 0
      !> First column, 0 where there is none
      integer :: column = 0
      !> Number of columns
      integer :: width = 0
      !> The line where it is not one of the deck
      character(len=:), allocatable :: source
      !> What is wrong, and what would be right
      character(len=:), allocatable :: message
   end type mistake_t

   !> Number of mistakes in one file
   type :: tally_t
      !> The file; blank for the deck
      character(len=:), allocatable :: file
      !> How many
      integer :: count = 0
   end type tally_t

   !> All mistakes found so far
   type :: mistakes_t
      !> How many
      integer :: count = 0
      !> Those that are first by position, at most as many as are shown, in no order
      type(mistake_t), allocatable :: list(:)
      !> How many these are, and which of them is the last by position
      integer :: kept = 0, last = 0
      !> All of them by file
      type(tally_t), allocatable :: tallies(:)
   end type mistakes_t

contains

   !> Take note of a mistake.
   pure subroutine add_mistake(mistakes, message, line, column, width, file, source)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> What is wrong, and what would be right
      character(len=*), intent(in) :: message
      !> Line, column and number of columns; 0 where there is no position
      integer, intent(in) :: line, column, width
      !> File, where it is not the deck
      character(len=*), intent(in), optional :: file
      !> The line, where it is not one of the deck
      character(len=*), intent(in), optional :: source

      type(mistake_t) :: new
      integer :: place, i

      if (.not. allocated(mistakes%list)) allocate (mistakes%list(most_shown), mistakes%tallies(0))
      new%line = line
      new%column = column
      new%width = width
      new%file = ""
      if (present(file)) new%file = file
      mistakes%count = mistakes%count + 1
      call add_to_tally(mistakes, new%file)
      if (mistakes%kept < most_shown) then
         mistakes%kept = mistakes%kept + 1
         place = mistakes%kept
      else
         place = mistakes%last
         if (.not. is_before(new, mistakes%list(place))) return
      end if
      new%message = message(:min(len(message), longest_message))
      if (present(source)) new%source = source
      mistakes%list(place) = new
      mistakes%last = 1
      do i = 2, mistakes%kept
         if (.not. is_before(mistakes%list(i), mistakes%list(mistakes%last))) mistakes%last = i
      end do
   end subroutine add_mistake

   !> Would a mistake at a position of the deck be shown with those found so far? If not, its sentence need not be made.
   pure function is_shown_at(mistakes, line, column) result(verdict)
      !> Mistakes so far
      type(mistakes_t), intent(in) :: mistakes
      !> Place in the deck
      integer, intent(in) :: line, column
      !> Would it?
      logical :: verdict

      type(mistake_t) :: new

      verdict = .true.
      if (mistakes%kept < most_shown) return
      new%line = line
      new%column = column
      new%file = ""
      verdict = is_before(new, mistakes%list(mistakes%last))
   end function is_shown_at

   !> Count a mistake in a file.
   pure subroutine add_to_tally(mistakes, file)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> The file; blank for the deck
      character(len=*), intent(in) :: file

      type(tally_t) :: new
      integer :: i

      do i = 1, size(mistakes%tallies)
         if (mistakes%tallies(i)%file /= file) cycle
         mistakes%tallies(i)%count = mistakes%tallies(i)%count + 1
         return
      end do
      new%file = file
      new%count = 1
      mistakes%tallies = [mistakes%tallies, new]
   end subroutine add_to_tally

   !> One error from all mistakes; none where there are none.
   subroutine raise_mistakes(mistakes, deck_name, lines, error)
      !> All mistakes
      type(mistakes_t), intent(in) :: mistakes
      !> Name of the deck
      character(len=*), intent(in) :: deck_name
      !> Lines of the deck
      type(text_lines_t), intent(in) :: lines
      !> Deck error with a paragraph for each mistake that is shown; not allocated where there is none
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: message, words
      integer, allocatable :: order(:)
      integer :: i

      if (mistakes%count == 0) return
      allocate (order(mistakes%kept))
      call put_in_order(mistakes%list(:mistakes%kept), order)
      message = ""
      do i = 1, mistakes%kept
         if (i > 1) message = message//new_line("a")
         call describe(mistakes%list(order(i)), deck_name, lines, words)
         message = message//words
      end do
      if (mistakes%count > mistakes%kept) message = message//new_line("a")//"... and "// &
         & integer_text(mistakes%count - mistakes%kept)//" more"
      if (mistakes%count > 1) then
         call count_in_words(mistakes, deck_name, words)
         message = words//new_line("a")//message
      end if
      call raise(error, kind_deck, message)
   end subroutine raise_mistakes

   !> How many mistakes there are, and in which files: the deck first, values given beside it last.
   pure subroutine count_in_words(mistakes, deck_name, words)
      !> All mistakes
      type(mistakes_t), intent(in) :: mistakes
      !> Name of the deck
      character(len=*), intent(in) :: deck_name
      character(len=:), allocatable, intent(out) :: words

      integer :: pass, i

      words = ""
      do pass = 1, 3
         do i = 1, size(mistakes%tallies)
            associate (tally => mistakes%tallies(i))
               if (pass /= rank_of_file(tally%file)) cycle
               if (words /= "") words = words//", "
               words = words//integer_text(tally%count)
               if (index(words, "mistake") == 0) words = words//trim(merge(" mistake ", " mistakes", tally%count == 1))
               words = words//" in "
               if (pass == 1) words = words//deck_name
               if (pass == 2) words = words//tally%file
               if (pass == 3) words = words//"values given beside the deck (--set)"
            end associate
         end do
      end do
   end subroutine count_in_words

   !> Order of files: the deck, its tables, values given beside it.
   pure function rank_of_file(file) result(rank)
      !> The file; blank for the deck
      character(len=*), intent(in) :: file
      !> 1, 2 or 3
      integer :: rank

      rank = merge(1, 2, file == "")
      if (file == override_place) rank = 3
   end function rank_of_file

   !> Order of the mistakes by line and column; those without a position last, equals as found.
   pure subroutine put_in_order(list, order)
      type(mistake_t), intent(in) :: list(:)
      !> Positions in order
      integer, intent(out) :: order(:)

      integer :: i, j

      do i = 1, size(list)
         j = i - 1
         do while (j >= 1)
            if (.not. is_before(list(i), list(order(j)))) exit
            order(j + 1) = order(j)
            j = j - 1
         end do
         order(j + 1) = i
      end do
   end subroutine put_in_order

   !> Does a mistake stand before another one?
   pure function is_before(first, second) result(verdict)
      !> One mistake and another
      type(mistake_t), intent(in) :: first, second
      !> Is the first one's position before the second one's?
      logical :: verdict

      integer :: rank_first, rank_second

      rank_first = merge(1, 0, first%line == 0) + 2*rank_of_file(first%file)
      rank_second = merge(1, 0, second%line == 0) + 2*rank_of_file(second%file)
      verdict = rank_first < rank_second
      if (rank_first /= rank_second) return
      verdict = first%line < second%line .or. (first%line == second%line .and. first%column < second%column)
   end function is_before

   !> Place, sentence, line and caret of a mistake.
   pure subroutine describe(mistake, deck_name, lines, text)
      type(mistake_t), intent(in) :: mistake
      !> Name of the deck
      character(len=*), intent(in) :: deck_name
      !> Lines of the deck
      type(text_lines_t), intent(in) :: lines
      !> A few lines of text
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: source, number, before, after, marks
      integer :: first, last

      text = deck_name
      if (mistake%file /= "") text = mistake%file
      number = ""
      if (mistake%line > 0) then
         number = integer_text(mistake%line)
         text = text//":"//number
         if (mistake%column > 0) text = text//":"//integer_text(mistake%column)
      end if
      text = text//": "//printable(mistake%message)
      if (allocated(mistake%source)) then
         source = mistake%source
      else if (mistake%file == "" .and. mistake%line > 0 .and. mistake%line <= lines%count) then
         source = line_at(lines, mistake%line)
      else
         return
      end if
      first = max(1, min(mistake%column - longest_line/4, len(source) - longest_line + 1))
      if (len(source) <= longest_line) first = 1
      call step_to_character(source, first)
      last = min(len(source), first + longest_line - 1)
      if (last < len(source)) last = last_whole(source, last)
      before = trim(merge("...", "   ", first > 1))
      after = trim(merge("...", "   ", last < len(source)))
      source = before//printable(source(first:last))//after
      text = text//new_line("a")//repeat(" ", max(0, 5 - len(number)))//number//" | "//source
      if (mistake%column == 0) return
      call mark_columns(source, mistake%column - first + 1 + len(before), min(mistake%width, last - mistake%column + 1), marks)
      text = text//new_line("a")//repeat(" ", max(5, len(number)))//" | "//marks
   end subroutine describe

   !> Blanks and carets below some columns of a line; bytes that continue a character have no width.
   pure subroutine mark_columns(source, column, width, text)
      !> The line
      character(len=*), intent(in) :: source
      !> First column and number of columns
      integer, intent(in) :: column, width
      !> The line below it
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ""
      do i = 1, column + max(1, width) - 1
         if (i <= len(source)) then
            if (continues(source(i:i))) cycle
         end if
         text = text//merge("^", " ", i >= column)
      end do
   end subroutine mark_columns

   !> Does a byte continue a character in UTF-8?
   elemental function continues(byte) result(verdict)
      !> The byte
      character(len=1), intent(in) :: byte
      !> Does it?
      logical :: verdict

      verdict = iachar(byte) >= 128 .and. iachar(byte) <= 191
   end function continues

   !> Move on to a byte where a character begins.
   pure subroutine step_to_character(text, place)
      character(len=*), intent(in) :: text
      !> The position
      integer, intent(inout) :: place

      integer :: step

      do step = 1, 3
         if (place >= len(text) .or. place == 1) return
         if (.not. continues(text(place:place))) return
         place = place + 1
      end do
   end subroutine step_to_character

   !> Last position not after another one at which a character ends.
   pure function last_whole(text, place) result(last)
      !> The text, longer than the position
      character(len=*), intent(in) :: text
      !> The position
      integer, intent(in) :: place
      !> Where a character ends
      integer :: last

      do last = place, max(1, place - 3), -1
         if (.not. continues(text(last + 1:last + 1))) return
      end do
      last = place
   end function last_whole

   !> Length of what is shown of a word.
   pure function shown_length(word) result(length)
      character(len=*), intent(in) :: word
      !> The length
      integer :: length

      length = len(word)
      if (length > longest_word) length = last_whole(word, longest_word) + len("...")
   end function shown_length

   !> A word of the user's for a sentence, cut where it is long.
   pure function shown(word) result(text)
      !> The word
      character(len=*), intent(in) :: word
      !> The same, or its beginning
      character(len=shown_length(word)) :: text

      text = word
      if (len(word) > longest_word) text = word(:last_whole(word, longest_word))//"..."
   end function shown

   !> A text with a blank for each tabulator or other control character, and a question mark for each byte that is no UTF-8.
   pure function printable(text) result(clean)
      character(len=*), intent(in) :: text
      !> The same, of the same length
      character(len=len(text)) :: clean

      integer :: i, length

      clean = text
      i = 1
      do while (i <= len(text))
         length = 1
         select case (iachar(text(i:i)))
         case (:31, 127)
            clean(i:i) = " "
         case (194:223)
            length = 2
         case (224:239)
            length = 3
         case (240:244)
            length = 4
         case (128:193, 245:)
            clean(i:i) = "?"
         end select
         if (i + length - 1 > len(text)) then
            clean(i:) = repeat("?", len(text) - i + 1)
         else if (length > 1) then
            if (.not. all_continue(text(i + 1:i + length - 1))) then
               clean(i:i) = "?"
               length = 1
            end if
         end if
         i = i + length
      end do
   end function printable

   !> Do all bytes continue a character?
   pure function all_continue(bytes) result(verdict)
      character(len=*), intent(in) :: bytes
      !> Do they?
      logical :: verdict

      integer :: i

      verdict = .true.
      do i = 1, len(bytes)
         verdict = verdict .and. continues(bytes(i:i))
      end do
   end function all_continue

end module camroller_mistakes
