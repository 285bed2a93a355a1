!> What decks share: a line `include = 'file'` between groups stands for the lines of a file.
!>
!> In: the text of a deck. Out: the text with the included lines in their places, without keys and groups that an including file
!> replaces or leaves out (`deck_merge.f90`), and where each line is from, so that a mistake is told with the line of the file that
!> it stands in. Paths start at the folder of the file that names them.
module camroller_deck_include
   use camroller_deck_merge, only : merge_files
   use camroller_deck_origins, only : origins_t, source_file_t, growing_text_t, add_text_line, grown_text
   use camroller_deck_text, only : to_lower
   use camroller_error, only : error_t
   use camroller_file_facts, only : facts_of_path, is_same_file
   use camroller_mistakes, only : mistakes_t, add_mistake
   use camroller_number_text, only : integer_text
   use camroller_text_file, only : folder_of, join_path, read_text_file
   use camroller_text_lines, only : line_at, split_lines
   implicit none
   private

   public :: expand_includes

   !> Files that a deck may include, all together, and one within the other
   integer, parameter :: most_files = 100, deepest = 10
   character(len=*), parameter :: blanks = " "//char(9), word = "include", word_without = "without"

   !> A line that includes a file
   type :: request_t
      !> Place of the word and the columns to the end of the line; none where nothing is included
      integer :: column = 0, width = 0
      !> Path as it is given; blank where the line is not as it should be
      character(len=:), allocatable :: path
      !> Groups to leave out, in lower case, with a blank before and after each
      character(len=:), allocatable :: without
   end type request_t

contains

   !> Put included files in the places of the lines that name them.
   subroutine expand_includes(text, folder, whole, origins, mistakes)
      !> Text of the deck
      character(len=*), intent(in) :: text
      !> Folder of the deck, with `/` at its end; blank for the present one
      character(len=*), intent(in) :: folder
      !> A deck by itself: text with all included lines that count
      character(len=:), allocatable, intent(out) :: whole
      !> Where its lines are from
      type(origins_t), intent(out) :: origins
      !> Mistakes so far: files that cannot be read, keys that two files give of which none includes the other
      type(mistakes_t), intent(inout) :: mistakes

      type(source_file_t) :: deck
      type(growing_text_t) :: growing
      integer :: before

      before = mistakes%count
      whole = text
      allocate (origins%files(0), origins%places(2, 0))
      if (index(to_lower(text), word) == 0) return
      deck%path = ""
      deck%without = " "
      call split_lines(text, deck%lines)
      origins%files = [origins%files, deck]
      call add_file(1, folder, 0, growing, origins%files, mistakes)
      if (size(origins%files) == 1 .and. mistakes%count == before) then
         origins%files = origins%files(:0)
         return
      end if
      call grown_text(growing, whole, origins%places)
      if (mistakes%count == before) call merge_files(whole, origins, mistakes)
   end subroutine expand_includes

   !> Add the lines of one file, and of those that it includes. Lines that include become comments.
   recursive subroutine add_file(file, folder, depth, whole, files, mistakes)
      !> Position of the file
      integer, intent(in) :: file
      character(len=*), intent(in) :: folder
      !> How many files lie between it and the deck, itself counted
      integer, intent(in) :: depth
      !> Text so far
      type(growing_text_t), intent(inout) :: whole
      !> Files so far
      type(source_file_t), allocatable, intent(inout) :: files(:)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(source_file_t) :: next
      type(request_t) :: request
      type(error_t), allocatable :: error
      character(len=:), allocatable :: included, reason, line
      logical :: is_open
      integer :: i

      is_open = .false.
      do i = 1, files(file)%lines%count
         line = line_at(files(file)%lines, i)
         call find_include(line, is_open, request)
         if (request%width == 0) then
            call add_text_line(whole, line, [file, i])
            cycle
         end if
         call add_text_line(whole, "! "//line, [file, i])
         next%path = join_path(folder, request%path)
         next%parent = file
         next%parent_line = whole%lines
         next%without = request%without
         reason = ""
         if (len(request%path) == 0) then
            reason = "expected include = 'file', one file in a line, or include = 'file', without = 'group', ..."
         else
            call say_repeated(files, file, next%path, reason)
         end if
         if (reason == "" .and. (depth == deepest .or. size(files) > most_files)) then
            reason = "more than "//integer_text(merge(deepest, most_files, depth == deepest))//" included files"
         else if (reason == "") then
            call read_text_file(next%path, included, error)
            if (allocated(error)) reason = error%message
         end if
         if (reason /= "") then
            call add_mistake(mistakes, reason, whole%lines, request%column, request%width)
            cycle
         end if
         call split_lines(included, next%lines)
         files = [files, next]
         call add_file(size(files), folder_of(next%path), depth + 1, whole, files, mistakes)
      end do
   end subroutine add_file

   !> Say that a file would include itself, directly or by others, or that it is included already.
   subroutine say_repeated(files, file, path, words)
      !> Files so far
      type(source_file_t), intent(in) :: files(:)
      !> Position of the one that includes
      integer, intent(in) :: file
      !> What it includes
      character(len=*), intent(in) :: path
      !> The words; empty where it is none of them
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: rest
      integer :: i

      words = ""
      rest = " includes '"//path//"'"
      i = file
      do while (i > 1)
         if (is_same_file(facts_of_path(path), facts_of_path(files(i)%path))) then
            if (i == file) rest = " includes itself"
            words = "'"//files(i)%path//"'"//rest
            return
         end if
         rest = " includes '"//files(i)%path//"', which"//rest
         i = files(i)%parent
      end do
      do i = 2, size(files)
         if (.not. is_same_file(facts_of_path(path), facts_of_path(files(i)%path))) cycle
         words = "'"//path//"' is included already"
         if (files(i)%parent > 1) words = words//" by '"//files(files(i)%parent)%path//"'"
         words = words//"; a deck takes a file in once"
         return
      end do
   end subroutine say_repeated

   !> Find a line that includes a file, and whether a group is open behind a line.
   pure subroutine find_include(line, is_open, request)
      character(len=*), intent(in) :: line
      !> Is a group open?
      logical, intent(inout) :: is_open
      !> What the line includes, if it does
      type(request_t), intent(out) :: request

      integer :: first
      character(len=:), allocatable :: path
      logical :: is_right

      request%path = ""
      request%without = " "
      request%column = max(1, verify(line, blanks))
      first = request%column
      if (.not. is_open) then
         call take_word(line, word, first, is_right)
         if (is_right) then
            request%width = len_trim(line) - request%column + 1
            call take_quoted(line, first, path)
            if (path /= "") call take_without(line, first, request%without, is_right)
            if (path /= "" .and. is_right) request%path = path
            return
         end if
      end if
      call follow_groups(line, is_open)
   end subroutine find_include

   !> Take a word and the `=` behind it.
   pure subroutine take_word(line, wanted, first, is_there)
      character(len=*), intent(in) :: line
      !> The word, in lower case
      character(len=*), intent(in) :: wanted
      !> Where to begin; behind the `=` if the word is there
      integer, intent(inout) :: first
      !> Is it?
      logical, intent(out) :: is_there

      integer :: next

      is_there = .false.
      if (len(line) < first + len(wanted)) return
      if (to_lower(line(first:first + len(wanted) - 1)) /= wanted) return
      next = first + len(wanted) - 1 + verify(line(first + len(wanted):)//"=", blanks)
      if (next > len(line)) return
      is_there = line(next:next) == "="
      if (is_there) first = next + 1
   end subroutine take_word

   !> Take a text in quotes, blanks around it and a comma behind it.
   pure subroutine take_quoted(line, first, text)
      character(len=*), intent(in) :: line
      !> Where to begin; then where the next word begins
      integer, intent(inout) :: first
      !> The text; empty where there is none
      character(len=:), allocatable, intent(out) :: text

      integer :: opening, closing

      text = ""
      opening = first - 1 + verify(line(first:)//"x", blanks)
      if (opening >= len(line)) return
      if (scan(line(opening:opening), "'""") == 0) return
      closing = opening + index(line(opening + 1:), line(opening:opening))
      if (closing == opening) return
      text = line(opening + 1:closing - 1)
      first = closing + verify(line(closing + 1:)//"x", blanks)
      if (first > len(line)) return
      if (line(first:first) == ",") first = first + verify(line(first + 1:)//"x", blanks)
   end subroutine take_quoted

   !> Take the groups that are left out, up to the end of the line or a comment.
   pure subroutine take_without(line, first, without, is_right)
      character(len=*), intent(in) :: line
      !> Where to begin
      integer, intent(inout) :: first
      !> The groups in lower case, with a blank before and after each
      character(len=:), allocatable, intent(inout) :: without
      !> Is it as it should be?
      logical, intent(out) :: is_right

      character(len=:), allocatable :: name

      is_right = ends(first)
      if (is_right) return
      call take_word(line, word_without, first, is_right)
      do while (is_right)
         call take_quoted(line, first, name)
         is_right = name /= "" .and. scan(name, blanks) == 0
         if (is_right) without = without//to_lower(name)//" "
         if (ends(first)) return
      end do

   contains

      !> Is there nothing more in the line than a comment?
      pure function ends(place) result(verdict)
         !> Where to look
         integer, intent(in) :: place
         !> Is there?
         logical :: verdict

         verdict = place > len(line)
         if (.not. verdict) verdict = line(place:place) == "!"
      end function ends

   end subroutine take_without

   !> Follow groups over a line.
   pure subroutine follow_groups(line, is_open)
      character(len=*), intent(in) :: line
      !> Is a group open? Then: behind the line
      logical, intent(inout) :: is_open

      integer :: i
      character(len=1) :: quote

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
   end subroutine follow_groups

end module camroller_deck_include
