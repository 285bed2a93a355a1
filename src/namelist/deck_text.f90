!> The shape of a deck: groups, keys and the text of each value, with their places. Nothing here knows what a key means.
!>
!> In: the text of a deck. Out: `deck_text_t` and the mistakes in its shape. The notation is that of Fortran
!> namelists: `&group key = value ... /`, `!` begins a comment, text stands in quotes. A value may span lines; a key and its
!> `=` stand on one line. Indexed keys and components are refused, and so is text outside of groups, which a namelist read
!> would skip. The time it takes grows as the length of the text, whatever the text is.
module camroller_deck_text
   use camroller_number_text, only : integer_text
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_text_lines, only : text_lines_t, split_lines
   implicit none
   private

   public :: deck_text_t, assignment_t, read_shape, to_lower

   !> Where a group begins
   type :: group_place_t
      !> Name in lower case
      character(len=:), allocatable :: name
      !> Place of the `&`
      integer :: line = 0, column = 0
      !> Place of the `/`; 0 where there is none
      integer :: last_line = 0, last_column = 0
   end type group_place_t

   !> One `key = value`
   type :: assignment_t
      !> Position of its group in `deck_text_t`
      integer :: group = 0
      !> Name as given
      character(len=:), allocatable :: key
      !> Place of the key
      integer :: line = 0, column = 0
      !> Text of the value: comments and needless blanks removed
      character(len=:), allocatable :: value
      !> Place of the value; of the key where the value is empty
      integer :: value_line = 0, value_column = 0, value_width = 0
      !> Is there a mistake in its shape already?
      logical :: is_broken = .false.
   end type assignment_t

   !> A deck without its comments
   type :: deck_text_t
      !> All lines as given
      type(text_lines_t) :: lines
      !> Groups in order; a repeated group is there once
      type(group_place_t), allocatable :: groups(:)
      !> Keys with their values, in order
      type(assignment_t), allocatable :: assignments(:)
   end type deck_text_t

   !> State of the reading
   type :: reader_t
      !> Position of the open group; 0 outside of groups
      integer :: group = 0
      !> Position of the open assignment; 0 where there is none
      integer :: assignment = 0
      !> Is what the open group holds left out, as it is there for the second time?
      logical :: is_repeated = .false.
      !> Group that is open, for the message about a missing end
      type(group_place_t) :: open
      !> Line that is being read
      integer :: line = 0
      !> Number of assignments so far; the list has room for more
      integer :: assignments = 0
      !> Value of the open assignment, which has so many characters, and room for more
      character(len=:), allocatable :: value
      integer :: length = 0
   end type reader_t

   !> Groups of a deck; there are not so many, and each new name is held against those before
   integer, parameter :: most_groups = 100
   !> Length of the indices of an indexed key
   integer, parameter :: longest_indices = 80

   character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
   character(len=*), parameter :: word_characters = letters//"0123456789_%"
   character(len=*), parameter :: blanks = " "//char(9)

contains

   !> Find groups, keys and values in the text of a deck.
   subroutine read_shape(text, deck, mistakes)
      !> Text of the deck
      character(len=*), intent(in) :: text
      !> Its groups, keys and values
      type(deck_text_t), intent(out) :: deck
      !> Mistakes so far; those of the shape are added
      type(mistakes_t), intent(inout) :: mistakes

      type(reader_t) :: reader

      call split_lines(text, deck%lines)
      allocate (deck%groups(0), deck%assignments(64))
      allocate (character(len=64) :: reader%value)
      do while (reader%line < deck%lines%count .and. size(deck%groups) <= most_groups)
         reader%line = reader%line + 1
         call read_line(text(deck%lines%first(reader%line):deck%lines%last(reader%line)), reader, deck, mistakes)
      end do
      if (is_open(reader)) call complain_no_end(reader, mistakes)
      call close_group(reader, deck)
      deck%assignments = deck%assignments(:reader%assignments)
   end subroutine read_shape

   !> Is a group open?
   pure function is_open(reader) result(verdict)
      !> State of the reading
      type(reader_t), intent(in) :: reader
      !> Is one open?
      logical :: verdict

      verdict = allocated(reader%open%name)
   end function is_open

   !> Go through one line.
   subroutine read_line(line, reader, deck, mistakes)
      character(len=*), intent(in) :: line
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Groups, keys and values so far
      type(deck_text_t), intent(inout) :: deck
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: position, last

      position = 1
      call end_word(reader)
      do while (position <= len(line) .and. size(deck%groups) <= most_groups)
         last = position
         if (line(position:position) == "!") return
         if (index(blanks, line(position:position)) > 0) then
            call end_word(reader)
         else if (line(position:position) == "&") then
            call open_group(line, position, last, reader, deck, mistakes)
         else if (.not. is_open(reader)) then
            call add_mistake(mistakes, "text outside of a group; a group begins with '&name', a comment with '!', and "// &
               & "include = 'file' stands on a line of its own", reader%line, position, len_trim(line) - position + 1)
            return
         else if (line(position:position) == "/") then
            if (reader%group > 0) deck%groups(reader%group)%last_line = reader%line
            if (reader%group > 0) deck%groups(reader%group)%last_column = position
            call close_group(reader, deck)
         else if (index("'""", line(position:position)) > 0) then
            call read_quoted(line, position, last, reader, deck, mistakes)
         else if (index(letters, line(position:position)) > 0) then
            call read_word(line, position, last, reader, deck, mistakes)
         else
            call read_other(line, position, last, reader, deck, mistakes)
         end if
         position = last + 1
      end do
   end subroutine read_line

   !> A group that another group or the end of the deck cuts off.
   subroutine complain_no_end(reader, mistakes)
      !> State of the reading
      type(reader_t), intent(in) :: reader
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (reader%open%name == "") return
      call add_mistake(mistakes, "&"//shown(reader%open%name)//" has no '/' at its end", reader%open%line, &
         & reader%open%column, len(reader%open%name) + 1)
   end subroutine complain_no_end

   !> Begin a group.
   subroutine open_group(line, position, last, reader, deck, mistakes)
      character(len=*), intent(in) :: line
      !> Place of the `&`
      integer, intent(in) :: position
      !> Last column of the name
      integer, intent(out) :: last
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Groups so far
      type(deck_text_t), intent(inout) :: deck
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(group_place_t) :: place
      integer :: i

      last = word_end(line, position + 1)
      place%name = to_lower(line(position + 1:last))
      place%line = reader%line
      place%column = position
      if (place%name == "end" .and. is_open(reader)) then
         call add_mistake(mistakes, "a group ends with '/'", reader%line, position, last - position + 1)
         call close_group(reader, deck)
         return
      end if
      if (is_open(reader)) call complain_no_end(reader, mistakes)
      call close_group(reader, deck)
      reader%open = place
      if (place%name == "") then
         call add_mistake(mistakes, "'&' without the name of a group after it", place%line, position, 1)
         reader%is_repeated = .true.
         return
      end if
      do i = 1, size(deck%groups)
         if (deck%groups(i)%name /= place%name) cycle
         call add_mistake(mistakes, "group &"//shown(place%name)//" is there twice", place%line, position, last - position + 1)
         reader%is_repeated = .true.
         return
      end do
      deck%groups = [deck%groups, place]
      reader%group = size(deck%groups)
      if (reader%group > most_groups) call add_mistake(mistakes, "more than "//integer_text(most_groups)// &
         & " groups; what follows was not read", place%line, position, last - position + 1)
   end subroutine open_group

   !> End a group.
   pure subroutine close_group(reader, deck)
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Keys and values so far
      type(deck_text_t), intent(inout) :: deck

      call end_assignment(reader, deck)
      reader%group = 0
      reader%is_repeated = .false.
      if (allocated(reader%open%name)) deallocate (reader%open%name)
   end subroutine close_group

   !> Hand over the value of the open key, if there is one.
   pure subroutine end_assignment(reader, deck)
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Keys and values so far
      type(deck_text_t), intent(inout) :: deck

      if (reader%assignment > 0) deck%assignments(reader%assignment)%value = reader%value(:reader%length)
      reader%assignment = 0
      reader%length = 0
   end subroutine end_assignment

   !> Quoted text, on one line.
   subroutine read_quoted(line, position, last, reader, deck, mistakes)
      character(len=*), intent(in) :: line
      !> Place of the opening quote
      integer, intent(in) :: position
      !> Place of the closing quote
      integer, intent(out) :: last
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Values so far
      type(deck_text_t), intent(inout) :: deck
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      last = index(line(position + 1:), line(position:position)) + position
      if (last == position) then
         last = len(line)
         call add_mistake(mistakes, "quoted text without a closing quote on its line", reader%line, position, &
            & len_trim(line) - position + 1)
         if (reader%assignment > 0) deck%assignments(reader%assignment)%is_broken = .true.
         return
      end if
      call append(reader, deck, line(position:last), position, mistakes)
   end subroutine read_quoted

   !> A word: a new key where `=` follows, else part of a value.
   subroutine read_word(line, position, last, reader, deck, mistakes)
      character(len=*), intent(in) :: line
      !> Where the word begins
      integer, intent(in) :: position
      !> Where it ends
      integer, intent(out) :: last
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Keys and values so far
      type(deck_text_t), intent(inout) :: deck
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: next, closing
      character(len=:), allocatable :: word

      last = word_end(line, position)
      word = line(position:last)
      next = next_column(line, last + 1)
      closing = 0
      if (character_at(line, next) == "(") closing = index(line(next:min(len(line), next + longest_indices)), ")") + next - 1
      if (closing > next) then
         if (character_at(line, next_column(line, closing + 1)) == "=") then
            call add_mistake(mistakes, "indexed keys are not taken; give the whole list: "//shown(word)//" = ...", &
               & reader%line, position, closing - position + 1)
            last = next_column(line, closing + 1)
            call begin_assignment(reader, deck, word, position, last)
            deck%assignments(reader%assignment)%is_broken = .true.
            return
         end if
      end if
      if (character_at(line, next) /= "=") then
         call append(reader, deck, word, position, mistakes)
         return
      end if
      if (index(word, "%") > 0) then
         call add_mistake(mistakes, "keys with '%' are not taken", reader%line, position, len(word))
         word = ""
      end if
      last = next
      call begin_assignment(reader, deck, word, position, next)
   end subroutine read_word

   !> A character that begins neither key nor quoted text.
   subroutine read_other(line, position, last, reader, deck, mistakes)
      character(len=*), intent(in) :: line
      !> Place of the character
      integer, intent(in) :: position
      !> Last place that belongs to it
      integer, intent(out) :: last
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Values so far
      type(deck_text_t), intent(inout) :: deck
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: length

      last = position
      if (line(position:position) == "=") then
         call add_mistake(mistakes, "'=' without the name of a key before it", reader%line, position, 1)
         return
      end if
      length = scan(line(position:), blanks//",'""=!&/") - 1
      if (length < 0) length = len(line) - position + 1
      last = position + max(length, 1) - 1
      call append(reader, deck, line(position:last), position, mistakes)
   end subroutine read_other

   !> Open a key.
   subroutine begin_assignment(reader, deck, key, column, equals)
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Keys and values so far
      type(deck_text_t), intent(inout) :: deck
      !> Name of the key; blank: its value is skipped
      character(len=*), intent(in) :: key
      !> Place of the key and of its `=`
      integer, intent(in) :: column, equals

      type(assignment_t) :: new
      type(assignment_t), allocatable :: longer(:)

      call end_assignment(reader, deck)
      new%group = reader%group
      new%key = key
      new%line = reader%line
      new%column = column
      new%value = ""
      new%value_line = reader%line
      new%value_column = column
      new%value_width = max(1, equals - column + 1)
      if (reader%is_repeated) new%key = ""
      if (reader%assignments == size(deck%assignments)) then
         allocate (longer(2*reader%assignments))
         longer(:reader%assignments) = deck%assignments
         call move_alloc(longer, deck%assignments)
      end if
      reader%assignments = reader%assignments + 1
      reader%assignment = reader%assignments
      deck%assignments(reader%assignment) = new
   end subroutine begin_assignment

   !> Add to the value of the open key.
   subroutine append(reader, deck, piece, column, mistakes)
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> Values so far
      type(deck_text_t), intent(inout) :: deck
      !> What to add
      character(len=*), intent(in) :: piece
      !> Where it stands
      integer, intent(in) :: column
      !> Mistakes so far; a value without a key is one
      type(mistakes_t), intent(inout) :: mistakes

      if (reader%assignment == 0) then
         call add_mistake(mistakes, "'"//shown(piece)//"' belongs to no key; expected 'key = value' or '/'", reader%line, &
            & column, len(piece))
         return
      end if
      associate (open => deck%assignments(reader%assignment))
         if (reader%length == 0) then
            open%value_line = reader%line
            open%value_column = column
         end if
         if (open%value_line == reader%line) open%value_width = column + len(piece) - open%value_column
      end associate
      call lengthen(reader, piece)
   end subroutine append

   !> Add characters to the open value.
   pure subroutine lengthen(reader, piece)
      !> State of the reading
      type(reader_t), intent(inout) :: reader
      !> The characters
      character(len=*), intent(in) :: piece

      if (reader%length + len(piece) > len(reader%value)) reader%value = reader%value//repeat(" ", reader%length + 2*len(piece))
      reader%value(reader%length + 1:reader%length + len(piece)) = piece
      reader%length = reader%length + len(piece)
   end subroutine lengthen

   !> Separate the words of a value by one blank.
   pure subroutine end_word(reader)
      !> State of the reading
      type(reader_t), intent(inout) :: reader

      if (reader%length == 0) return
      if (reader%value(reader%length:reader%length) /= " ") call lengthen(reader, " ")
   end subroutine end_word

   !> Last column of a word that begins at a column; the column before it where there is none.
   pure function word_end(line, first) result(last)
      character(len=*), intent(in) :: line
      !> Where the word begins
      integer, intent(in) :: first
      !> Where it ends
      integer :: last

      last = verify(line(first:), word_characters)
      last = merge(len(line), first + last - 2, last == 0)
   end function word_end

   !> First column from a place on that is not blank; the one after the last where there is none.
   pure function next_column(line, first) result(column)
      character(len=*), intent(in) :: line
      !> Where to begin
      integer, intent(in) :: first
      !> The column
      integer :: column

      column = verify(line(first:), blanks)
      column = merge(len(line) + 1, first + column - 1, column == 0)
   end function next_column

   !> Character at a column; a blank after the end.
   pure function character_at(line, column) result(found)
      character(len=*), intent(in) :: line
      integer, intent(in) :: column
      !> What stands there
      character(len=1) :: found

      found = " "
      if (column <= len(line)) found = line(column:column)
   end function character_at

   !> A text with small letters.
   pure function to_lower(text) result(lower)
      !> The text
      character(len=*), intent(in) :: text
      !> The same in lower case
      character(len=len(text)) :: lower

      integer :: i, position

      lower = text
      do i = 1, len(text)
         if (text(i:i) < "A" .or. text(i:i) > "Z") cycle
         position = index(letters(27:), text(i:i))
         if (position > 0) lower(i:i) = letters(position:position)
      end do
   end function to_lower

end module camroller_deck_text
