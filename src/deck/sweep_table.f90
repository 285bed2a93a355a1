!> Tables of cases: one column for each key that varies, one row for each case, from a text or an HDF5 file.
!>
!> In: a path. Out: columns of texts under the names of their keys. In text, the first line that is no comment
!> holds the names, as `group.key`; columns are parted by commas, blanks or tabulators, `#` or `!` begins a comment, names may
!> stand in quotes. In HDF5, the columns are datasets with one axis, named `group.key`, at the root or in a group `/sweep`, so
!> that a result file is a table of its own cases.
module camroller_sweep_table
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_names, only : name_length
   use camroller_mistakes, only : mistakes_t, add_mistake
   use camroller_text_lines, only : text_lines_t, split_lines, line_at
   use camroller_number_text, only : number_text, integer_text
   use camroller_deck_values, only : split_words, longest_text
   use camroller_text_file, only : read_text_file
   use camroller_text_list, only : text_list_t, new_text_list, put_text_at
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_read, only : member_length, open_file, has_member, list_members, read_extents, is_text_dataset, &
      & read_numbers, read_text
   implicit none
   private

   public :: column_t, read_columns

   !> Most columns of a table
   integer, parameter :: most_columns = 64
   !> Digits that give every number back
   integer, parameter :: all_digits = 17
   !> Longest name in a column of names
   integer, parameter :: longest_name = name_length + 2
   !> First bytes of an HDF5 file
   character(len=*), parameter :: hdf5_mark = char(137)//"HDF"

   !> One column
   type :: column_t
      !> Name of the key, as `group.key`
      character(len=:), allocatable :: key
      !> Its value in each case
      type(text_list_t) :: cells
      !> Line of each case in the file, 0 where it has no lines
      integer, allocatable :: lines(:)
   end type column_t

contains

   !> Read a table of cases.
   subroutine read_columns(path, columns, mistakes, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its columns, of one length; none where there is a mistake
      type(column_t), allocatable, intent(out) :: columns(:)
      !> Mistakes so far; those of the table are added
      type(mistakes_t), intent(inout) :: mistakes
      !> File error where the file cannot be read
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      integer :: i, before

      before = mistakes%count
      if (is_hdf5(path)) then
         call read_datasets(path, columns, error)
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

   !> Does a file begin as HDF5 files do?
   function is_hdf5(path) result(verdict)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Does it?
      logical :: verdict

      character(len=4) :: mark
      integer :: unit, status

      verdict = .false.
      open (newunit=unit, file=path, access="stream", form="unformatted", action="read", status="old", iostat=status)
      if (status /= 0) return
      read (unit, iostat=status) mark
      close (unit)
      verdict = status == 0 .and. mark == hdf5_mark
   end function is_hdf5

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
      integer, allocatable :: widths(:)
      integer :: i, j, n, rows, pass

      call split_lines(text, lines)
      allocate (columns(0))
      do pass = 1, 2
         rows = -1
         do i = 1, lines%count
            call split_words(without_comment(text(lines%first(i):lines%last(i))), words, n)
            if (n == 0) cycle
            rows = rows + 1
            if (n > most_columns) then
               rows = rows - 1
               if (pass == 1) call add_mistake(mistakes, "a table of cases has at most "//integer_text(most_columns)// &
                  & " columns", i, 0, 0, path, line_at(lines, i))
               if (rows < 0) return
            else if (pass == 1 .and. rows == 0) then
               deallocate (columns)
               allocate (columns(n), widths(n))
               widths = 1
               do j = 1, n
                  columns(j)%key = without_quotes(words(j))
               end do
            else if (n /= size(columns)) then
               rows = rows - 1
               if (pass == 1) call add_mistake(mistakes, "a row has "//integer_text(size(columns))//" columns, not "// &
                  & integer_text(n), i, 0, 0, path, line_at(lines, i))
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

   !> A line up to its comment.
   pure function without_comment(line) result(text)
      !> The line
      character(len=*), intent(in) :: line
      !> What stands before the comment
      character(len=:), allocatable :: text

      integer :: length

      length = scan(line, "#!") - 1
      if (length < 0) length = len(line)
      text = line(:length)
   end function without_comment

   !> A word without quotes around it.
   pure function without_quotes(word) result(text)
      !> The word
      character(len=*), intent(in) :: word
      !> The same without quotes
      character(len=:), allocatable :: text

      text = trim(word)
      if (scan(text, "'""") == 1 .and. len(text) > 1) text = text(2:len(text) - 1)
   end function without_quotes

   !> Columns of an HDF5 file.
   subroutine read_datasets(path, columns, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its columns
      type(column_t), allocatable, intent(out) :: columns(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: file
      type(column_t) :: column
      character(len=member_length), allocatable :: names(:)
      character(len=:), allocatable :: group
      integer :: i

      allocate (columns(0))
      call open_file(file, path, error)
      if (allocated(error)) return
      group = "/"
      if (has_member(file, "/sweep")) group = "/sweep/"
      call list_members(file, group, names, error)
      do i = 1, size(names)
         if (allocated(error)) exit
         if (index(names(i), ".") == 0) cycle
         column%key = trim(names(i))
         call read_cells(file, group//trim(names(i)), column, error)
         if (.not. allocated(error)) columns = [columns, column]
      end do
      call discard_file(file)
   end subroutine read_datasets

   !> Values of a dataset as texts.
   subroutine read_cells(file, name, column, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Gets the values
      type(column_t), intent(inout) :: column
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      !> Values of the dataset [unit of the key]
      real(wp), allocatable :: numbers(:)
      integer, allocatable :: extents(:)
      integer :: i, n

      call read_extents(file, name, 1, extents, error)
      if (allocated(error)) return
      n = extents(1)
      if (allocated(column%lines)) deallocate (column%lines)
      allocate (column%lines(n), source=0)
      if (is_text_dataset(file, name)) then
         call new_text_list(column%cells, n, longest_name)
         do i = 1, n
            call read_text(file, name, [i - 1], text, error)
            if (allocated(error)) return
            call put_text_at(column%cells, i, "'"//text//"'")
         end do
      else
         call new_text_list(column%cells, n, all_digits + 8)
         call read_numbers(file, name, [0], [n], numbers, error)
         if (allocated(error)) return
         do i = 1, n
            call put_text_at(column%cells, i, number_text(numbers(i), all_digits))
         end do
      end if
   end subroutine read_cells

end module camroller_sweep_table
