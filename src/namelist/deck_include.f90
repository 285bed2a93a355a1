!> What decks share: a line `include = 'file'` between groups stands for the lines of a file.
!>
!> In: the text of a deck. Out: the text with the included lines in their places, and where each line is from, so that a mistake is
!> told with the line of the file that it stands in. Paths start at the folder of the file that names them.
module camroller_deck_include
   use camroller_deck_text, only : to_lower
   use camroller_error, only : error_t
   use camroller_file_facts, only : facts_of_path, is_same_file
   use camroller_mistakes, only : mistakes_t, add_mistake
   use camroller_number_text, only : integer_text
   use camroller_text_file, only : folder_of, join_path, read_text_file
   use camroller_text_lines, only : line_t, line_at, split_lines, text_lines_t
   implicit none
   private

   public :: origins_t, expand_includes, place_mistakes, say_origin

   !> Files that a deck may include, all together, and one within the other
   integer, parameter :: most_files = 100, deepest = 10
   character(len=*), parameter :: blanks = " "//char(9), word = "include"

   !> Lines that follow each other in one file
   type :: span_t
      !> Line of the whole text with which it begins
      integer :: first = 1
      !> File: 0 for the deck
      integer :: file = 0
      !> Line of the file with which it begins
      integer :: line = 1
   end type span_t

   !> Where the lines of a text are from
   type :: origins_t
      !> Included files
      type(line_t), allocatable :: files(:)
      !> Spans in order; none where nothing is included
      type(span_t), allocatable :: spans(:)
   end type origins_t

contains

   !> Put included files in the places of the lines that name them.
   subroutine expand_includes(text, folder, whole, origins, mistakes)
      !> Text of the deck
      character(len=*), intent(in) :: text
      !> Folder of the deck, with `/` at its end; blank for the present one
      character(len=*), intent(in) :: folder
      !> Text with all included lines
      character(len=:), allocatable, intent(out) :: whole
      !> Where its lines are from
      type(origins_t), intent(out) :: origins
      !> Mistakes so far: files that cannot be read
      type(mistakes_t), intent(inout) :: mistakes

      integer :: lines, before

      before = mistakes%count
      allocate (origins%files(0), origins%spans(0))
      if (index(to_lower(text), word) == 0) then
         whole = text
         return
      end if
      whole = ""
      lines = 0
      call add_file(text, folder, [integer ::], whole, lines, origins, mistakes)
      if (size(origins%files) == 0 .and. mistakes%count == before) origins%spans = origins%spans(:0)
   end subroutine expand_includes

   !> Add the lines of one file, and of those that it includes.
   recursive subroutine add_file(text, folder, chain, whole, lines, origins, mistakes)
      !> Text of the file
      character(len=*), intent(in) :: text
      !> Its folder
      character(len=*), intent(in) :: folder
      !> Numbers of the files by which the deck includes it, its own last; none for the deck
      integer, intent(in) :: chain(:)
      !> Text so far
      character(len=:), allocatable, intent(inout) :: whole
      !> Lines of it
      integer, intent(inout) :: lines
      !> Where they are from
      type(origins_t), intent(inout) :: origins
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(text_lines_t) :: parts
      type(error_t), allocatable :: error
      character(len=:), allocatable :: path, included, reason
      logical :: is_open
      integer :: i, first, column, width, file

      file = 0
      if (size(chain) > 0) file = chain(size(chain))
      call split_lines(text, parts)
      call add_span(origins, lines + 1, file, 1)
      is_open = .false.
      first = 1
      do i = 1, parts%count
         call find_include(text(parts%first(i):parts%last(i)), is_open, path, column, width)
         if (width == 0) cycle
         call add_lines(i)
         reason = ""
         if (len(path) == 0) then
            reason = "expected include = 'file', one file in a line"
         else
            call say_circle(origins, chain, join_path(folder, path), reason)
         end if
         if (reason == "" .and. (size(chain) == deepest .or. size(origins%files) == most_files)) then
            reason = "more than "//integer_text(merge(deepest, most_files, size(chain) == deepest))//" included files"
         else if (reason == "") then
            call read_text_file(join_path(folder, path), included, error)
            if (allocated(error)) reason = error%message
         end if
         if (reason /= "") then
            call add_mistake(mistakes, reason, lines, column, width)
            cycle
         end if
         call add_name(origins, join_path(folder, path))
         call add_file(included, folder_of(join_path(folder, path)), [chain, size(origins%files)], whole, lines, &
            & origins, mistakes)
         call add_span(origins, lines + 1, file, i + 1)
      end do
      call add_lines(parts%count)

   contains

      !> Add the lines that are not there yet, up to one of them, which includes a file and becomes a comment; or to the last.
      subroutine add_lines(last)
         !> Number of the line
         integer, intent(in) :: last

         character(len=:), allocatable :: more

         if (last < first) return
         more = text(parts%first(first):parts%last(last))
         if (width > 0) more = text(parts%first(first):parts%first(last) - 1)//"! "//text(parts%first(last):parts%last(last))
         whole = whole//more//new_line("a")
         lines = lines + last - first + 1
         first = last + 1
      end subroutine add_lines

   end subroutine add_file

   !> Say that a file would include itself, directly or by others.
   subroutine say_circle(origins, chain, path, words)
      !> Included files
      type(origins_t), intent(in) :: origins
      !> Numbers of the files that are being included, each by the one before it
      integer, intent(in) :: chain(:)
      !> A file that the last of them includes
      character(len=*), intent(in) :: path
      !> The words; empty where it is none of them
      character(len=:), allocatable, intent(out) :: words

      integer :: i, first

      first = 0
      words = ""
      do i = 1, size(chain)
         if (first > 0) then
            words = words//" includes '"//origins%files(chain(i))%text//"', which"
         else if (is_same_file(facts_of_path(path), facts_of_path(origins%files(chain(i))%text))) then
            first = i
            words = "'"//origins%files(chain(i))%text//"'"
         end if
      end do
      if (first > 0 .and. first == size(chain)) then
         words = words//" includes itself"
      else if (first > 0) then
         words = words//" includes '"//path//"'"
      end if
   end subroutine say_circle

   !> Find a line that includes a file, and whether a group is open behind a line.
   pure subroutine find_include(line, is_open, path, column, width)
      !> The line
      character(len=*), intent(in) :: line
      !> Is a group open?
      logical, intent(inout) :: is_open
      !> Path as it is given; blank where it is not given as it should be
      character(len=:), allocatable, intent(out) :: path
      !> Place of the word and the columns to the end of the line; none where nothing is included
      integer, intent(out) :: column, width

      integer :: i, next, closing
      character(len=1) :: quote

      path = ""
      width = 0
      column = max(1, verify(line, blanks))
      if (.not. is_open .and. len(line) >= column + len(word) - 1) then
         next = column + len(word) - 1 + verify(line(column + len(word):)//"=", blanks)
         if (to_lower(line(column:column + len(word) - 1)) == word .and. next <= len(line)) then
            if (line(next:next) == "=") then
               width = len_trim(line) - column + 1
               next = next + verify(line(next + 1:)//"x", blanks)
               if (next >= len(line)) return
               if (scan(line(next:next), "'""") == 0) return
               closing = index(line(next + 1:), line(next:next))
               ! Behind the file nothing but a comment
               if (scan(line(next + closing + 1:)//"!", "!") /= verify(line(next + closing + 1:)//"!", blanks)) closing = 0
               if (closing > 1) path = line(next + 1:next + closing - 1)
               return
            end if
         end if
      end if
      quote = " "
      do i = 1, len(line)
         if (quote /= " ") then
            if (line(i:i) == quote) quote = " "
         else
            select case (line(i:i))
            case ("'", '"')
               quote = line(i:i)
            case ("!")
               return
            case ("&")
               is_open = .true.
            case ("/")
               is_open = .false.
            end select
         end if
      end do
   end subroutine find_include

   !> Add a span; one without lines gives way to the next.
   subroutine add_span(origins, first, file, line)
      !> Spans so far
      type(origins_t), intent(inout) :: origins
      !> Line of the whole text, file, line of the file
      integer, intent(in) :: first, file, line

      integer :: last

      last = size(origins%spans)
      if (last > 0) then
         if (origins%spans(last)%first == first) last = last - 1
      end if
      origins%spans = [origins%spans(:last), span_t(first, file, line)]
   end subroutine add_span

   !> Add the name of a file. A constructor within a list would leak its text with gfortran.
   subroutine add_name(origins, path)
      !> Files so far
      type(origins_t), intent(inout) :: origins
      !> One more
      character(len=*), intent(in) :: path

      type(line_t), allocatable :: longer(:)

      allocate (longer(size(origins%files) + 1))
      longer(:size(origins%files)) = origins%files
      longer(size(longer))%text = path
      call move_alloc(longer, origins%files)
   end subroutine add_name

   !> Give mistakes of the whole text their places in the files that its lines are from.
   subroutine place_mistakes(origins, lines, mistakes)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> Lines of the whole text
      type(text_lines_t), intent(in) :: lines
      !> The mistakes
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i, span

      if (size(origins%spans) == 0) return
      do i = 1, mistakes%kept
         associate (mistake => mistakes%list(i))
            if (mistake%file /= "" .or. mistake%line == 0 .or. mistake%line > lines%count) cycle
            span = span_of(origins, mistake%line)
            mistake%source = line_at(lines, mistake%line)
            ! Lines that include are comments in the whole text
            if (index(mistake%source, "! ") == 1 .and. index(to_lower(mistake%source), word) > 0) then
               mistake%source = mistake%source(3:)
            end if
            mistake%line = mistake%line - origins%spans(span)%first + origins%spans(span)%line
            if (origins%spans(span)%file > 0) mistake%file = origins%files(origins%spans(span)%file)%text
         end associate
      end do
   end subroutine place_mistakes

   !> Span of a line of the whole text.
   pure function span_of(origins, line) result(span)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> The line
      integer, intent(in) :: line
      !> The span
      integer :: span

      span = max(1, count(origins%spans%first <= line))
   end function span_of

   !> Place of a line of the whole text.
   pure subroutine say_origin(origins, name, line, words)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> Name of the deck
      character(len=*), intent(in) :: name
      !> The line
      integer, intent(in) :: line
      !> As `file:line`
      character(len=:), allocatable, intent(out) :: words

      integer :: span

      words = name//":"//integer_text(line)
      if (size(origins%spans) == 0) return
      span = span_of(origins, line)
      words = name
      if (origins%spans(span)%file > 0) words = origins%files(origins%spans(span)%file)%text
      words = words//":"//integer_text(line - origins%spans(span)%first + origins%spans(span)%line)
   end subroutine say_origin

end module camroller_deck_include
