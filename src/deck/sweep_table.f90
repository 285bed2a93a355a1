!> Tables of cases: one column for each key that varies, one row for each case, from a text or a file that a reader takes.
!>
!> In: a path. Out: columns of texts under the names of their keys; measured values in the sweep. In text, the first line that is no
!> comment holds the names, as `group.key`. Columns are parted by semicolons where that line has one, by commas where it has one of
!> them, by blanks or tabulators else. Names and values may stand in quotes, a word that begins with `#` or `!` begins a comment.
module camroller_sweep_table
   use camroller_error, only : error_t
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_text_lines, only : text_lines_t, split_lines, line_at
   use camroller_number_text, only : counted, integer_text, is_beyond_range, is_number
   use camroller_deck_sweep, only : sweep_axis_t, sweep_t
   use camroller_deck_values, only : next_word, longest_text
   use camroller_table_file, only : on_commas
   use camroller_quotes, only : without_quotes
   use camroller_text_encoding, only : check_encoding
   use camroller_text_file, only : read_text_file
   use camroller_text_list, only : new_text_list, put_text_at, text_at
   use camroller_case_columns, only : column_t, column_reader_t, measured_prefix, nothing_measured
   implicit none
   private

   public :: read_columns, add_measured

   !> Most columns of a table
   integer, parameter :: most_columns = 64
   !> Letters of the longest name of a column of measured values
   integer, parameter :: longest_measured = 64
   !> What such a name may consist of
   character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"

   !> Words of a line
   type :: row_t
      !> How many there are, and the words
      integer :: count = 0
      character(len=longest_text) :: words(most_columns + 1) = ""
      !> Commas or semicolons before each word, and behind the last
      integer :: marks(most_columns + 2) = 0
   end type row_t

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
      character(len=*), intent(in) :: text
      type(column_t), allocatable, intent(out) :: columns(:)
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(text_lines_t) :: lines
      type(row_t) :: heading, row
      character(len=:), allocatable :: reason
      character(len=1) :: mark
      integer, allocatable :: widths(:)
      integer :: i, j, rows, pass

      call split_lines(text, lines)
      call check_encoding(lines, mistakes, path)
      do pass = 1, 2
         rows = -1
         do i = 1, lines%count
            if (rows < 0) call find_mark(text(lines%first(i):lines%last(i)), mark)
            call split_row(text(lines%first(i):lines%last(i)), mark, row)
            if (row%count == 0) cycle
            rows = rows + 1
            if (rows == 0) heading = row
            call judge_row(heading, row, rows == 0, mark, reason)
            if (reason /= "") then
               if (pass == 1) call add_mistake(mistakes, reason, i, 0, 0, path, line_at(lines, i))
               if (rows == 0) exit
               rows = rows - 1
            else if (pass == 1 .and. rows == 0) then
               allocate (columns(row%count), widths(row%count))
               widths = 1
               do j = 1, row%count
                  columns(j)%key = without_quotes(trim(row%words(j)))
                  columns(j)%unit = ""
               end do
            else if (pass == 1) then
               widths = max(widths, len_trim(row%words(:row%count)))
            else if (rows > 0) then
               do j = 1, row%count
                  call put_text_at(columns(j)%cells, rows, row%words(j))
                  columns(j)%lines(rows) = i
               end do
            end if
         end do
         if (.not. allocated(columns)) allocate (columns(0))
         if (pass == 2) exit
         do j = 1, size(columns)
            call new_text_list(columns(j)%cells, max(rows, 0), widths(j))
            allocate (columns(j)%lines(max(rows, 0)), source=0)
         end do
      end do
   end subroutine read_rows

   !> What parts the columns of a table, beside blanks and tabulators around it.
   pure subroutine find_mark(line, mark)
      !> The heading, or a line before it
      character(len=*), intent(in) :: line
      !> A semicolon, a comma, or a blank where there is neither
      character(len=1), intent(out) :: mark

      character(len=1), parameter :: marks(*) = [";", ","]
      type(row_t) :: row
      integer :: i

      do i = 1, size(marks)
         mark = marks(i)
         call split_row(line, mark, row)
         if (any(row%marks > 0)) return
      end do
      mark = " "
   end subroutine find_mark

   !> Cut a line into its words, without its comment.
   pure subroutine split_row(line, mark, row)
      character(len=*), intent(in) :: line
      !> What parts its words beside blanks and tabulators
      character(len=1), intent(in) :: mark
      !> Its words; where there are too many, one more than are read
      type(row_t), intent(out) :: row

      integer :: position, before, first, last, i

      position = 1
      do
         before = position
         call next_word(line, position, first, last, mark)
         last = max(first - 1, merge(len(line), 0, first == 0))
         if (mark /= " ") row%marks(row%count + 1) = count([(line(i:i) == mark, i=before, last)])
         if (first == 0 .or. row%count == size(row%words)) return
         if (scan(line(first:first), "#!") == 1) return
         row%count = row%count + 1
         row%words(row%count) = line(first:position - 1)
      end do
   end subroutine split_row

   !> What is wrong with a line of a table.
   pure subroutine judge_row(heading, row, is_heading, mark, reason)
      !> The heading, and the line
      type(row_t), intent(in) :: heading, row
      !> Are they the same?
      logical, intent(in) :: is_heading
      !> What parts columns
      character(len=1), intent(in) :: mark
      !> What is wrong; empty where nothing is
      character(len=:), allocatable, intent(out) :: reason

      integer :: i

      reason = ""
      if (row%count > most_columns) then
         reason = "a table of cases has at most "//integer_text(most_columns)//" columns"
      else if (is_heading) then
         call judge_names(row%words(:row%count), reason)
      else
         do i = 1, row%count
            if (.not. has_decimal_comma(trim(row%words(i)))) cycle
            reason = "'"//shown(trim(row%words(i)))//"' has a comma, which parts no columns in the heading; "// &
               & "decimals have a point"
         end do
      end if
      if (reason == "" .and. mark /= " ") call judge_marks(heading, row, is_heading, mark, reason)
      if (reason /= "" .or. row%count == heading%count) return
      reason = "this row has "//counted(row%count, "column")//", the heading has "//integer_text(heading%count)
      if (row%count > heading%count .and. mark == ",") reason = reason//on_commas
   end subroutine judge_row

   !> Is there one mark between two words? Behind the last word there may be as many as in the heading.
   pure subroutine judge_marks(heading, row, is_heading, mark, reason)
      !> The heading, and the line
      type(row_t), intent(in) :: heading, row
      !> Are they the same?
      logical, intent(in) :: is_heading
      !> What parts columns
      character(len=1), intent(in) :: mark
      !> What is wrong; empty where nothing is
      character(len=:), allocatable, intent(out) :: reason

      integer :: i, most

      reason = ""
      do i = 1, row%count + 1
         most = merge(0, 1, i == 1)
         if (i > row%count) most = heading%marks(heading%count + 1)
         if (row%marks(i) > most) then
            reason = "column "//integer_text(i)//" is empty"
            if (is_heading .or. i > heading%count) return
            reason = reason//": "//without_quotes(trim(heading%words(i)))//" needs a value"
            if (index(without_quotes(trim(heading%words(i))), measured_prefix) == 1) then
               reason = reason//"; '"//nothing_measured//"' stands where nothing was measured"
            end if
            return
         else if (i > 1 .and. i <= row%count .and. row%marks(i) == 0) then
            reason = "'"//mark//"' parts columns, as in the heading; there is none before '"//shown(trim(row%words(i)))// &
               & "', and a text with a blank stands in quotes"
            return
         end if
      end do
   end subroutine judge_marks

   !> What is wrong with a first line that holds no names.
   pure subroutine judge_names(words, reason)
      !> Words of the line
      character(len=*), intent(in) :: words(:)
      !> What is wrong; empty where nothing is
      character(len=:), allocatable, intent(out) :: reason

      integer :: i

      reason = ""
      if (any([(is_number(trim(words(i))), i=1, size(words))])) then
         reason = "the first line of a table of cases holds the names of its columns, as operating_point.speed_rpm, and no numbers"
      else if (any([(index(words(i), "[") == 1, i=1, size(words))])) then
         reason = "a name with a blank, as 'measured.torque [N m]', stands in quotes"
      end if
   end subroutine judge_names

   !> Is a word a number but for a comma in the place of its point?
   pure function has_decimal_comma(word) result(verdict)
      character(len=*), intent(in) :: word
      !> Is it?
      logical :: verdict

      integer :: i

      i = index(word, ",")
      verdict = i > 0
      if (verdict) verdict = is_number(word(:i - 1)//"."//word(i + 1:))
   end function has_decimal_comma

   !> A column of measured values, headed as `measured.run` or, in quotes, `measured.torque [N m]`.
   subroutine add_measured(path, column, sweep, mistakes)
      !> Path of the table
      character(len=*), intent(in) :: path
      !> The column
      type(column_t), intent(in) :: column
      !> The sweep
      type(sweep_t), intent(inout) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: cell, words
      type(sweep_axis_t) :: measured
      integer :: i, opening

      measured%is_numeric = .true.
      opening = index(column%key//" [", " [")
      measured%key = column%key(len(measured_prefix) + 1:opening - 1)
      measured%has_unit = column%unit /= "" .or. opening < len(column%key)
      measured%values = column%cells
      if (measured%key == "" .or. verify(measured%key, letters) > 0) then
         call add_mistake(mistakes, "'"//column%key//"': the name behind '"//measured_prefix// &
            & "' consists of letters, digits and underscores", 0, 0, 0, path)
      else if (any([(sweep%measured(i)%key == measured%key, i=1, size(sweep%measured))])) then
         call add_mistake(mistakes, "'"//column%key//"' is there twice", 0, 0, 0, path)
      else if (len(measured%key) > longest_measured) then
         call add_mistake(mistakes, "'"//column%key//"': the name behind '"//measured_prefix//"' has "// &
            & integer_text(len(measured%key))//" letters; the longest has "//integer_text(longest_measured), 0, 0, 0, path)
      else if (opening < len(column%key)) then
         call read_unit(column%key(opening + 1:), measured%unit, words)
         if (words /= "") call add_mistake(mistakes, "'"//column%key//"': "//words, 0, 0, 0, path)
      end if
      if (column%unit /= "" .and. opening > len(column%key)) then
         call read_unit("["//column%unit//"]", measured%unit, words)
         if (words /= "") call add_mistake(mistakes, "'"//column%key//"': "//words, 0, 0, 0, path)
      else if (column%unit /= "" .and. column%unit /= measured%unit) then
         call add_mistake(mistakes, "'"//column%key//"' has the unit '"//column%unit//"' as well", 0, 0, 0, path)
      end if
      do i = 1, column%cells%count
         cell = text_at(column%cells, i)
         if (cell == nothing_measured) cycle
         if (is_number(cell) .and. .not. is_beyond_range(cell)) cycle
         call add_mistake(mistakes, "value "//integer_text(i)//" of "//column%key//" is no number; '"//nothing_measured// &
            & "' stands where nothing was measured", column%lines(i), 0, 0, path)
      end do
      sweep%measured = [sweep%measured, measured]
   end subroutine add_measured

   !> Unit of a column of measured values.
   pure subroutine read_unit(text, unit, reason)
      !> What stands behind the name
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: unit
      !> What is wrong; empty where nothing is
      character(len=:), allocatable, intent(out) :: reason

      integer :: width

      reason = ""
      width = len(text) - 2
      if (width < 1 .or. scan(text, "[") /= 1 .or. scan(text, "]") /= len(text)) then
         reason = "behind the name stands nothing but the unit in brackets, as in 'measured.torque [N m]'"
      else if (width > len(unit)) then
         reason = "the unit has "//integer_text(width)//" letters; the longest has "//integer_text(len(unit))
      else
         unit = text(2:len(text) - 1)
      end if
   end subroutine read_unit

end module camroller_sweep_table
