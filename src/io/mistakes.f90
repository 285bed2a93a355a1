!> Mistakes in a deck and in its tables: collected, put in order of place, and shown all at once.
!>
!> Layer: io. In: places and sentences. Out: one error whose message shows, for each mistake, file and line, the line
!> itself
!> and a caret below the words that are wrong.
module camroller_mistakes
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_number_text, only : integer_text
   implicit none
   private

   public :: line_t, mistakes_t, add_mistake, raise_mistakes, nearest_name, split_lines

   !> One line of text
   type :: line_t
      !> Its characters, without the end of line
      character(len=:), allocatable :: text
   end type line_t

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

   !> All mistakes found so far
   type :: mistakes_t
      !> How many
      integer :: count = 0
      !> The mistakes, in the order found
      type(mistake_t), allocatable :: list(:)
   end type mistakes_t

contains

   !> Take note of a mistake.
   pure subroutine add_mistake(mistakes, message, line, column, width, file, source)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> What is wrong, and what would be right
      character(len=*), intent(in) :: message
      !> Line, column and number of columns; 0 where there is no place
      integer, intent(in) :: line, column, width
      !> File, where it is not the deck
      character(len=*), intent(in), optional :: file
      !> The line, where it is not one of the deck
      character(len=*), intent(in), optional :: source

      type(mistake_t), allocatable :: longer(:)

      if (.not. allocated(mistakes%list)) allocate (mistakes%list(8))
      if (mistakes%count == size(mistakes%list)) then
         allocate (longer(2*mistakes%count))
         longer(:mistakes%count) = mistakes%list
         call move_alloc(longer, mistakes%list)
      end if
      mistakes%count = mistakes%count + 1
      associate (new => mistakes%list(mistakes%count))
         new%message = message
         new%line = line
         new%column = column
         new%width = width
         new%file = ""
         if (present(file)) new%file = file
         if (present(source)) new%source = source
      end associate
   end subroutine add_mistake

   !> One error from all mistakes; none where there are none.
   subroutine raise_mistakes(mistakes, deck_name, lines, error)
      !> All mistakes
      type(mistakes_t), intent(in) :: mistakes
      !> Name of the deck
      character(len=*), intent(in) :: deck_name
      !> Lines of the deck
      type(line_t), intent(in) :: lines(:)
      !> Deck error with a paragraph for each mistake; not allocated where there is none
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: message
      integer, allocatable :: order(:)
      integer :: i

      if (mistakes%count == 0) return
      allocate (order(mistakes%count))
      call put_in_order(mistakes%list(:mistakes%count), order)
      message = ""
      do i = 1, mistakes%count
         if (i > 1) message = message//new_line("a")
         message = message//described(mistakes%list(order(i)), deck_name, lines)
      end do
      if (mistakes%count > 1) then
         message = integer_text(mistakes%count)//" mistakes in "//deck_name//new_line("a")//message
      end if
      call raise(error, kind_deck, message)
   end subroutine raise_mistakes

   !> Order of the mistakes by line and column; those without a place last, equals as found.
   pure subroutine put_in_order(list, order)
      !> The mistakes
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
      !> Is the first one's place before the second one's?
      logical :: verdict

      integer :: rank_first, rank_second

      rank_first = merge(1, 0, first%line == 0) + merge(2, 0, first%file /= "")
      rank_second = merge(1, 0, second%line == 0) + merge(2, 0, second%file /= "")
      verdict = rank_first < rank_second
      if (rank_first /= rank_second) return
      verdict = first%line < second%line .or. (first%line == second%line .and. first%column < second%column)
   end function is_before

   !> Place, sentence, line and caret of a mistake.
   function described(mistake, deck_name, lines) result(text)
      !> The mistake
      type(mistake_t), intent(in) :: mistake
      !> Name of the deck
      character(len=*), intent(in) :: deck_name
      !> Lines of the deck
      type(line_t), intent(in) :: lines(:)
      !> A few lines of text
      character(len=:), allocatable :: text

      character(len=:), allocatable :: source, number

      text = deck_name
      if (mistake%file /= "") text = mistake%file
      number = ""
      if (mistake%line > 0) then
         number = integer_text(mistake%line)
         text = text//":"//number
         if (mistake%column > 0) text = text//":"//integer_text(mistake%column)
      end if
      text = text//": "//mistake%message
      if (allocated(mistake%source)) then
         source = mistake%source
      else if (mistake%line > 0 .and. mistake%line <= size(lines)) then
         source = lines(mistake%line)%text
      else
         return
      end if
      text = text//new_line("a")//repeat(" ", max(0, 5 - len(number)))//number//" | "//without_tabs(source)
      if (mistake%column == 0) return
      text = text//new_line("a")//repeat(" ", max(5, len(number)))//" | "//caret(source, mistake%column, mistake%width)
   end function described

   !> Blanks and carets below some columns of a line; bytes that continue a character take no place.
   pure function caret(source, column, width) result(text)
      !> The line
      character(len=*), intent(in) :: source
      !> First column and number of columns
      integer, intent(in) :: column, width
      !> The line below it
      character(len=:), allocatable :: text

      !> Smallest and largest byte that continues a character in UTF-8
      integer, parameter :: first_byte = 128, last_byte = 191
      integer :: i

      text = ""
      do i = 1, column + max(1, width) - 1
         if (i <= len(source)) then
            if (iachar(source(i:i)) >= first_byte .and. iachar(source(i:i)) <= last_byte) cycle
         end if
         text = text//merge("^", " ", i >= column)
      end do
   end function caret

   !> A line with a blank for each tabulator or other control character.
   pure function without_tabs(source) result(text)
      !> The line
      character(len=*), intent(in) :: source
      !> The same, fit to stand above a caret
      character(len=len(source)) :: text

      integer :: i

      text = source
      do i = 1, len(source)
         if (iachar(source(i:i)) < iachar(" ")) text(i:i) = " "
      end do
   end function without_tabs

   !> The known name that a word was probably meant to be; blank where none is near.
   pure function nearest_name(word, known) result(nearest)
      !> The word
      character(len=*), intent(in) :: word
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> The nearest of them, or nothing
      character(len=:), allocatable :: nearest

      integer :: i, distance, smallest, shared, most_shared

      nearest = ""
      smallest = max(2, len_trim(word)/3)
      most_shared = -1
      do i = 1, size(known)
         distance = edit_distance(trim(word), trim(known(i)))
         if (index(known(i), trim(word)//"_") == 1) distance = 1
         shared = shared_letters(word, known(i))
         if (distance >= len_trim(known(i)) .or. distance > smallest) cycle
         if (distance == smallest .and. shared <= most_shared) cycle
         smallest = distance
         most_shared = shared
         nearest = trim(known(i))
      end do
   end function nearest_name

   !> Number of letters that two words begin with together.
   pure function shared_letters(one, other) result(number)
      !> The two words
      character(len=*), intent(in) :: one, other
      !> How many
      integer :: number

      do number = 0, min(len_trim(one), len_trim(other)) - 1
         if (one(number + 1:number + 1) /= other(number + 1:number + 1)) return
      end do
   end function shared_letters

   !> Number of letters to insert, delete, replace or swap to make one word the other.
   !>
   !> Source: Damerau (1964), Levenshtein (1966), in the restricted form (no edits between swapped letters).
   pure function edit_distance(one, other) result(distance)
      !> The two words
      character(len=*), intent(in) :: one, other
      !> Number of edits
      integer :: distance

      integer :: table(0:len(one), 0:len(other))
      integer :: i, j

      table(:, 0) = [(i, i=0, len(one))]
      table(0, :) = [(j, j=0, len(other))]
      do j = 1, len(other)
         do i = 1, len(one)
            table(i, j) = min(table(i - 1, j) + 1, table(i, j - 1) + 1, &
               & table(i - 1, j - 1) + merge(0, 1, one(i:i) == other(j:j)))
            if (i < 2 .or. j < 2) cycle
            if (one(i:i) == other(j - 1:j - 1) .and. one(i - 1:i - 1) == other(j:j)) then
               table(i, j) = min(table(i, j), table(max(i - 2, 0), max(j - 2, 0)) + 1)
            end if
         end do
      end do
      distance = table(len(one), len(other))
   end function edit_distance

   !> Cut a text into its lines; carriage returns before the ends of lines are dropped.
   pure subroutine split_lines(text, lines)
      !> The text
      character(len=*), intent(in) :: text
      !> Its lines
      type(line_t), allocatable, intent(out) :: lines(:)

      integer :: i, n, first, last

      n = 0
      do i = 1, len(text)
         if (text(i:i) == new_line("a")) n = n + 1
      end do
      if (len(text) > 0) then
         if (text(len(text):) /= new_line("a")) n = n + 1
      end if
      allocate (lines(n))
      first = 1
      do i = 1, n
         last = index(text(first:), new_line("a"))
         last = merge(len(text), first + last - 2, last == 0)
         lines(i)%text = text(first:last)
         if (last >= first) then
            if (text(last:last) == char(13)) lines(i)%text = text(first:last - 1)
         end if
         first = last + 2
      end do
   end subroutine split_lines

end module camroller_mistakes
