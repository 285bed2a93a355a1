!> Result file to CSV: the series of one case, or the summary of all cases.
!>
!> In: a result file. Out: a line of names, a line of units, one line for each cam angle or case, numbers with the
!> 17 significant digits that keep them exactly. Like a result file, the table appears under its name when it is complete.
module camroller_export
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file, kind_usage
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_read, only : check_extents, has_member, is_text_dataset, list_members, member_length, open_file, &
      & read_extents, read_integer_attribute, read_numbers, read_text, read_text_attribute
   use camroller_new_file, only : begin_new_file, drop_new_file, end_new_file, new_file_t
   use camroller_number_text, only : integer_text, write_number, number_length
   use camroller_output_file, only : format_version, result_format
   use camroller_raw_file, only : append_text, close_raw, create_raw, raw_file_t
   use camroller_streams, only : print_text
   implicit none
   private

   public :: export_csv, export_series, export_summary

   !> What `export_csv` can write
   integer, parameter :: export_series = 1, export_summary = 2
   !> Digits after the first one: 17 tell any two numbers apart
   integer, parameter :: decimals = 16
   !> Letters that are handed over at a time
   integer, parameter :: block_length = 65536

   !> A word of the table
   type :: word_t
      !> Its letters
      character(len=:), allocatable :: text
   end type word_t

   !> A table to be written: numbers or words, by column
   type :: table_t
      !> Names and units of the columns
      type(word_t), allocatable :: names(:), units(:)
      !> Numbers, shape (row, column) [unit of the column]
      real(wp), allocatable :: numbers(:, :)
      !> Words, shape (row, column), where a column is none of numbers
      type(word_t), allocatable :: words(:, :)
      !> Which columns hold words
      logical, allocatable :: has_words(:)
   end type table_t

contains

   !> Write a table from a result file.
   subroutine export_csv(path_in, what, case, path_out, error)
      !> Path of the result file
      character(len=*), intent(in) :: path_in
      !> `export_series` or `export_summary`
      integer, intent(in) :: what
      !> Number of the case as in `/case`, from 0; for series
      integer, intent(in) :: case
      !> Path of the table, `-` for the output unit
      character(len=*), intent(in) :: path_out
      !> File error; usage error where there is no such case
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: file
      type(table_t) :: table
      integer, allocatable :: cases(:)

      call open_result(file, path_in, cases, error)
      if (.not. allocated(error)) then
         if (what == export_series) then
            call read_series(file, cases(1), case, table, error)
         else
            call read_summary(file, cases(1), table, error)
         end if
      end if
      call discard_file(file)
      if (allocated(error)) return
      if (path_out == "-") then
         call write_rows(table, error)
      else
         call write_file(trim(path_out), table, error)
      end if
   end subroutine export_csv

   !> Open a file that is one of our results, and was written to its end: complete, or partial by intention.
   subroutine open_result(file, path, cases, error)
      !> The open file
      type(hdf5_object_t), intent(out) :: file
      !> Its path
      character(len=*), intent(in) :: path
      !> Number of cases, in one element
      integer, allocatable, intent(out) :: cases(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: form
      integer :: complete, missing, version

      call open_file(file, path, error)
      if (allocated(error)) return
      call read_text_attribute(file, "/", "format", form, error)
      if (.not. allocated(error)) then
         if (form /= result_format) call raise(error, kind_file, form)
      end if
      if (allocated(error)) then
         call raise(error, kind_file, "cannot read '"//path//"': it is not a result file of camroller")
         return
      end if
      call read_integer_attribute(file, "/", "complete", complete, error)
      if (allocated(error)) complete = 0
      call read_integer_attribute(file, "/", "missing_cases", missing, error)
      if (allocated(error)) missing = 0
      if (complete /= 1 .and. missing == 0) then
         call raise(error, kind_file, "cannot read '"//path//"': it is not complete")
         return
      end if
      call read_integer_attribute(file, "/", "format_version", version, error)
      if (.not. allocated(error) .and. version > format_version) then
         call raise(error, kind_file, "cannot read '"//path//"': it was written by a newer camroller")
      end if
      if (.not. allocated(error)) call read_extents(file, "/case", 1, cases, error)
   end subroutine open_result

   !> Series of one case.
   subroutine read_series(file, cases, case, table, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> Number of the case, from 0
      integer, intent(in) :: case
      !> One row for each cam angle
      type(table_t), intent(out) :: table
      !> Usage error where the case has no series; file error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: names(:)
      integer, allocatable :: angles(:)
      real(wp), allocatable :: column(:) ! [unit of the series]
      integer :: i

      call check_case(file, cases, case, error)
      if (.not. allocated(error)) call list_members(file, "/series", names, error)
      if (.not. allocated(error)) call read_extents(file, "/series/cam_angle", 1, angles, error)
      if (allocated(error)) return
      call make_columns(table, angles(1), size(names))
      do i = 1, size(names)
         if (names(i) == "cam_angle") then
            call read_numbers(file, "/series/"//trim(names(i)), [0], angles, column, error)
         else
            call check_extents(file, "/series/"//trim(names(i)), [angles(1), cases], error)
            if (.not. allocated(error)) call read_numbers(file, "/series/"//trim(names(i)), [0, case], [angles(1), 1], column, &
               & error)
         end if
         if (allocated(error)) return
         table%numbers(:, i) = column
         call head_column(file, "/series/"//trim(names(i)), table, i, error)
         if (allocated(error)) return
      end do
   end subroutine read_series

   !> Scalars of all cases, behind the number of the case and the swept keys.
   subroutine read_summary(file, cases, table, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> One row for each case
      type(table_t), intent(out) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: swept(:), scalars(:)
      integer :: i

      call list_members(file, "/sweep", swept, error)
      if (.not. allocated(error)) call list_members(file, "/summary", scalars, error)
      if (allocated(error)) return
      call make_columns(table, cases, 1 + size(swept) + size(scalars))
      call read_column(file, "/case", table, 1, error)
      do i = 1, size(swept)
         if (.not. allocated(error)) call read_column(file, "/sweep/"//trim(swept(i)), table, 1 + i, error)
      end do
      do i = 1, size(scalars)
         if (.not. allocated(error)) call read_column(file, "/summary/"//trim(scalars(i)), table, 1 + size(swept) + i, error)
      end do
   end subroutine read_summary

   !> Read a dataset with one value for each case into a column.
   subroutine read_column(file, name, table, position, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> The table
      type(table_t), intent(inout) :: table
      !> The column
      integer, intent(in) :: position
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: column(:) ! [unit of the dataset]
      integer :: row

      call check_extents(file, name, [size(table%numbers, 1)], error)
      if (allocated(error)) return
      table%has_words(position) = is_text_dataset(file, name)
      if (table%has_words(position)) then
         do row = 1, size(table%words, 1)
            call read_text(file, name, [row - 1], table%words(row, position)%text, error)
            if (allocated(error)) return
         end do
      else
         call read_numbers(file, name, [0], [size(table%numbers, 1)], column, error)
         if (allocated(error)) return
         table%numbers(:, position) = column
      end if
      call head_column(file, name, table, position, error)
   end subroutine read_column

   !> An error where a case does not exist or has failed.
   subroutine check_case(file, cases, case, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> Number of the case, from 0
      integer, intent(in) :: case
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: message
      real(wp), allocatable :: status(:) ! [-]

      if (case < 0 .or. case >= cases) then
         call raise(error, kind_usage, "there is no case "//integer_text(case)//": the file has the cases 0 to "// &
            & integer_text(cases - 1))
         return
      end if
      call read_numbers(file, "/summary/status", [case], [1], status, error)
      if (allocated(error)) return
      if (status(1) > 0.0_wp) then
         call read_text(file, "/run/messages", [case], message, error)
         if (.not. allocated(error)) then
            call raise(error, kind_usage, "case "//integer_text(case)//" has no series, it failed: "//message)
         end if
      else if (.not. has_member(file, "/series/cam_angle")) then
         call raise(error, kind_usage, "'"//file%file//"' holds no series, the summary alone")
      end if
   end subroutine check_case

   !> Room for a table.
   subroutine make_columns(table, rows, columns)
      !> The table
      type(table_t), intent(out) :: table
      !> Number of rows
      integer, intent(in) :: rows
      !> Number of columns
      integer, intent(in) :: columns

      allocate (table%names(columns), table%units(columns), table%words(rows, columns))
      allocate (table%numbers(rows, columns), source=0.0_wp)
      allocate (table%has_words(columns), source=.false.)
   end subroutine make_columns

   !> Name and unit of a column.
   subroutine head_column(file, name, table, position, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> The table
      type(table_t), intent(inout) :: table
      !> The column
      integer, intent(in) :: position
      !> File error
      type(error_t), allocatable, intent(out) :: error

      table%names(position)%text = name(index(name, "/", back=.true.) + 1:)
      call read_text_attribute(file, name, "units", table%units(position)%text, error)
   end subroutine head_column

   !> Write a table to a file that appears under its name when it is complete.
   subroutine write_file(path, table, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The table
      type(table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(raw_file_t) :: file

      call begin_new_file(place, path, error)
      if (.not. allocated(error)) call create_raw(file, place%temporary, path, error)
      if (.not. allocated(error)) call write_rows(table, error, file)
      call close_raw(file)
      if (allocated(error)) then
         call drop_new_file(place)
      else
         call end_new_file(place, file%bytes, error)
      end if
   end subroutine write_file

   !> Write all rows, many at a time.
   subroutine write_rows(table, error, file)
      !> The table
      type(table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error
      !> The open file; without it the output unit
      type(raw_file_t), intent(inout), optional :: file

      character(len=:), allocatable :: line
      character(len=block_length) :: block
      integer :: row, length

      length = 0
      do row = -1, size(table%numbers, 1)
         call row_text(table, row, line)
         line = line//new_line("a")
         if (length + len(line) > block_length) call write_piece(block(:length))
         if (allocated(error)) return
         if (len(line) > block_length) then
            call write_piece(line)
         else
            block(length + 1:length + len(line)) = line
            length = length + len(line)
         end if
         if (allocated(error)) return
      end do
      call write_piece(block(:length))

   contains

      !> Write a piece of text; what was gathered is gone.
      subroutine write_piece(text)
         !> The text
         character(len=*), intent(in) :: text

         length = 0
         if (present(file)) then
            call append_text(file, text, error)
         else
            call print_text(text, error)
         end if
      end subroutine write_piece

   end subroutine write_rows

   !> One line of a table.
   pure subroutine row_text(table, row, line)
      !> The table
      type(table_t), intent(in) :: table
      !> The row, from 1; 0 for the units, -1 for the names
      integer, intent(in) :: row
      !> The line
      character(len=:), allocatable, intent(out) :: line

      character(len=number_length) :: number
      integer :: i

      line = ""
      do i = 1, size(table%names)
         if (i > 1) line = line//","
         if (row == -1) then
            line = line//quoted(table%names(i)%text)
         else if (row == 0) then
            line = line//quoted(table%units(i)%text)
         else if (table%has_words(i)) then
            line = line//quoted(table%words(row, i)%text)
         else
            call write_number(table%numbers(row, i), "e3", decimals, number)
            line = line//trim(adjustl(number))
         end if
      end do
   end subroutine row_text

   !> A word as CSV wants it: in quotes where it holds a comma, a quote or a line end.
   pure function quoted(word) result(text)
      !> The word
      character(len=*), intent(in) :: word
      !> The word as it stands in the table
      character(len=:), allocatable :: text

      integer :: i

      if (scan(word, ","""//new_line("a")) == 0) then
         text = word
         return
      end if
      text = """"
      do i = 1, len(word)
         if (word(i:i) == """") text = text//""""
         text = text//word(i:i)
      end do
      text = text//""""
   end function quoted

end module camroller_export
