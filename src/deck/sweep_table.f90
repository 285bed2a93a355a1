!> Tables of cases: one column for each key that varies, one row for each case, from a text or a file that a reader takes.
!>
!> In: a path. Out: columns of texts under the names of their keys. In text, the first line that is no comment
!> holds the names, as `group.key`; columns are parted by commas, semicolons, blanks or tabulators, names and values may stand in
!> quotes, a word that begins with `#` or `!` begins a comment.
module camroller_sweep_table
   use camroller_error, only : error_t
   use camroller_mistakes, only : mistakes_t, add_mistake
   use camroller_text_lines, only : text_lines_t, split_lines, line_at
   use camroller_number_text, only : counted, integer_text, is_number
   use camroller_deck_values, only : split_words, longest_text
   use camroller_table_file, only : on_commas
   use camroller_text_encoding, only : check_encoding
   use camroller_text_file, only : read_text_file
   use camroller_text_list, only : new_text_list, put_text_at
   use camroller_case_columns, only : column_t, column_reader_t
   implicit none
   private

   public :: read_columns

   !> Most columns of a table
   integer, parameter :: most_columns = 64

contains

   !> Read a table of cases.
   subroutine read_columns(path, columns, mistakes, error, reader)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its columns, of one length; none where there is a mistake
      type(column_t), allocatable, intent(out) :: columns(:)
      !> Mistakes so far; those of the table are added
      type(mistakes_t), intent(inout) :: mistakes
      !> File error where the file cannot be read
      type(error_t), allocatable, intent(out) :: error
      !> Reader of files of another kind
      class(column_reader_t), intent(in), optional :: reader

      character(len=:), allocatable :: text
      integer :: i, before
      logical :: is_text

      before = mistakes%count
      is_text = .true.
      if (present(reader)) is_text = .not. reader%takes(path)
      if (.not. is_text) then
         call reader%read_columns(path, columns, error)
      else
         call read_text_file(path, text, error)
         if (.not. allocated(error)) call read_rows(path, text, columns, mistakes)
      end if
      if (allocated(error)) return
      if (mistakes%count == before) then
         if (size(columns) == 0) then
            call add_mistake(mistakes, "the table names no key", 0, 0, 0, path)
         else if (columns(1)%cells%count == 0) then
            call add_mistake(mistakes, "the table has no cases", 0, 0, 0, path)
         else if (any([(columns(i)%cells%count /= columns(1)%cells%count, i=1, size(columns))])) then
            call add_mistake(mistakes, "the columns differ in length", 0, 0, 0, path)
         end if
      end if
      if (mistakes%count > before) columns = columns(:0)
   end subroutine read_columns

   !> Columns of a text.
   subroutine read_rows(path, text, columns, mistakes)
      !> Path of the file, for messages
      character(len=*), intent(in) :: path
      !> The text
      character(len=*), intent(in) :: text
      !> Its columns
      type(column_t), allocatable, intent(out) :: columns(:)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(text_lines_t) :: lines
      character(len=longest_text) :: words(most_columns + 1)
      character(len=:), allocatable :: advice
      integer, allocatable :: widths(:)
      integer :: i, j, n, rows, pass, before

      call split_lines(text, lines)
      call check_encoding(lines, mistakes, path)
      allocate (columns(0))
      do pass = 1, 2
         rows = -1
         do i = 1, lines%count
            call split_words(text(lines%first(i):lines%last(i)), words, n)
            n = before_comment(words(:n))
            if (n == 0) cycle
            rows = rows + 1
            if (n > most_columns) then
               rows = rows - 1
               if (pass == 1) call add_mistake(mistakes, "a table of cases has at most "//integer_text(most_columns)// &
                  & " columns", i, 0, 0, path, line_at(lines, i))
               if (rows < 0) return
            else if (pass == 1 .and. rows == 0) then
               before = mistakes%count
               call check_heading(words(:n), path, i, line_at(lines, i), mistakes)
               if (mistakes%count > before) return
               deallocate (columns)
               allocate (columns(n), widths(n))
               widths = 1
               do j = 1, n
                  columns(j)%key = trim(words(j))
                  call cut_quotes(columns(j)%key)
               end do
            else if (n /= size(columns)) then
               rows = rows - 1
               advice = ""
               if (n > size(columns) .and. index(line_at(lines, i), ",") > 0) advice = on_commas
               if (pass == 1) call add_mistake(mistakes, "this row has "//counted(n, "column")//", the heading has "// &
                  & integer_text(size(columns))//advice, i, 0, 0, path, line_at(lines, i))
            else if (pass == 1) then
               widths = max(widths, len_trim(words(:n)))
            else if (rows > 0) then
               do j = 1, n
                  call put_text_at(columns(j)%cells, rows, words(j))
                  columns(j)%lines(rows) = i
               end do
            end if
         end do
         if (pass == 2) exit
         do j = 1, size(columns)
            call new_text_list(columns(j)%cells, max(rows, 0), widths(j))
            allocate (columns(j)%lines(max(rows, 0)), source=0)
         end do
      end do
   end subroutine read_rows

   !> Refuse a first line that holds no names.
   subroutine check_heading(words, path, line, text, mistakes)
      !> Words of the line
      character(len=*), intent(in) :: words(:)
      !> Path of the file, for messages
      character(len=*), intent(in) :: path
      !> Number of the line, and the line
      integer, intent(in) :: line
      character(len=*), intent(in) :: text
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i

      if (any([(is_number(trim(words(i))), i=1, size(words))])) then
         call add_mistake(mistakes, "the first line of a table of cases holds the names of its columns, as "// &
            & "operating_point.speed_rpm, and no numbers", line, 0, 0, path, text)
      else if (any([(index(words(i), "[") == 1, i=1, size(words))])) then
         call add_mistake(mistakes, "a name with a blank, as 'measured.torque [N m]', stands in quotes", line, 0, 0, path, text)
      end if
   end subroutine check_heading

   !> Number of words before the comment of a line.
   pure function before_comment(words) result(number)
      !> Words of the line
      character(len=*), intent(in) :: words(:)
      !> The number
      integer :: number

      do number = 0, size(words) - 1
         if (scan(words(number + 1), "#!") == 1) return
      end do
   end function before_comment

   !> Take quotes around a word away.
   pure subroutine cut_quotes(word)
      !> The word
      character(len=:), allocatable, intent(inout) :: word

      if (scan(word, "'""") == 1 .and. len(word) > 1) word = word(2:len(word) - 1)
   end subroutine cut_quotes

end module camroller_sweep_table
