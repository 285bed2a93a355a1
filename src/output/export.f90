!> Result file to a table: the series of one case, or the summary of all cases, as CSV or as JSON.
!>
!> In: a result file. Out: a line of names, a line of units, one line for each cam angle or case, numbers with the
!> 17 significant digits that keep them exactly; or a single heading of names with units; or a JSON object of columns. Like a result
!> file, the table appears under its name when it is complete.
module camroller_export
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_case_columns, only : measured_prefix
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_read, only : check_extents, has_member, list_members, member_length, read_extents, read_numbers, read_text
   use camroller_near_names, only : nearest_name
   use camroller_new_file, only : begin_new_file, drop_new_file, end_new_file, new_file_t
   use camroller_number_text, only : integer_text, write_number, number_length
   use camroller_output_file, only : not_computed
   use camroller_output_kind, only : table_kind
   use camroller_quotes, only : replaced
   use camroller_raw_file, only : append_text, close_raw, create_raw, raw_file_t
   use camroller_result_columns, only : head_column, make_columns, open_result, read_column, table_t
   use camroller_streams, only : print_text
   implicit none
   private

   public :: export_csv, export_series, export_summary, export_formats

   !> What `export_csv` can write
   integer, parameter :: export_series = 1, export_summary = 2
   !> Forms of a table: CSV with a line of names and one of units, CSV with one line of names with units, JSON
   character(len=*), parameter :: export_formats(*) = [character(len=5) :: "csv", "plain", "json"]
   !> Group of measured values; its columns are called as in the table of cases that they come from
   character(len=*), parameter :: measured_group = "/measured"
   !> Digits after the first one: 17 tell any two numbers apart
   integer, parameter :: decimals = 16
   !> Letters that are handed over at a time
   integer, parameter :: block_length = 65536

contains

   !> Write a table from a result file.
   subroutine export_csv(path_in, what, case, path_out, error, columns, form)
      !> Path of the result file
      character(len=*), intent(in) :: path_in
      !> `export_series` or `export_summary`
      integer, intent(in) :: what
      !> Number of the case as in `/case`, from 0; for series
      integer, intent(in) :: case
      !> Path of the table, `-` for the output unit
      character(len=*), intent(in) :: path_out
      !> File error; usage error where there is no such case or column
      type(error_t), allocatable, intent(out) :: error
      !> Names of the columns wanted, parted by commas; all where it is blank
      character(len=*), intent(in), optional :: columns
      !> One of `export_formats`
      character(len=*), intent(in), optional :: form

      type(hdf5_object_t) :: file
      type(table_t) :: table
      character(len=:), allocatable :: chosen
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
      if (.not. allocated(error) .and. present(columns)) call choose_columns(table, columns, what, error)
      if (allocated(error)) return
      chosen = export_formats(1)
      if (present(form)) chosen = form
      if (path_out == "-") then
         call write_rows(table, chosen, error)
      else
         call write_file(trim(path_out), table, chosen, error)
      end if
   end subroutine export_csv

   !> Keep what is asked for, and what tells rows apart: the cam angle, or the case with the keys that vary.
   subroutine choose_columns(table, wanted, what, error)
      type(table_t), intent(inout) :: table
      !> Names, parted by commas; blank for all
      character(len=*), intent(in) :: wanted
      !> `export_series` or `export_summary`
      integer, intent(in) :: what
      !> Usage error where there is no such column
      type(error_t), allocatable, intent(out) :: error

      integer, allocatable :: places(:)
      character(len=member_length), allocatable :: names(:)
      character(len=:), allocatable :: nearest, word
      integer :: i, first, length, place

      if (wanted == "") return
      allocate (places(0), names(size(table%names)))
      do i = 1, size(names)
         names(i) = table%names(i)%text
         if (what == export_series .and. names(i) == "cam_angle") places = [places, i]
         ! Beside the number of the case keys that are swept
         if (what /= export_summary) cycle
         if (i == 1 .or. (index(names(i), ".") > 0 .and. index(names(i), measured_prefix) /= 1)) places = [places, i]
      end do
      first = 1
      do while (first <= len_trim(wanted))
         length = index(wanted(first:)//",", ",") - 1
         word = trim(adjustl(wanted(first:first + length - 1)))
         first = first + length + 1
         if (word == "") cycle
         place = findloc(names == word, .true., dim=1)
         if (place == 0) then
            nearest = nearest_name(word, names)
            if (nearest /= "") nearest = "; did you mean '"//nearest//"'?"
            call raise(error, kind_usage, "there is no column '"//word//"'"//nearest)
            return
         end if
         if (.not. any(places == place)) places = [places, place]
      end do
      table%names = table%names(places)
      table%units = table%units(places)
      table%numbers = table%numbers(:, places)
      table%words = table%words(:, places)
      table%has_words = table%has_words(places)
   end subroutine choose_columns

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
      if (all(ieee_is_nan(table%numbers) .or. spread(names == "cam_angle", 1, angles(1)))) then
         call raise(error, kind_usage, "the series of case "//integer_text(case)//" were not kept: a sweep keeps those that "// &
            & "'sweep.series' and 'sweep.series_cases' say")
      end if
   end subroutine read_series

   !> Scalars of all cases, behind the number of the case, the swept keys and what was measured.
   subroutine read_summary(file, cases, table, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> One row for each case
      type(table_t), intent(out) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: paths(:)
      integer :: i
      logical :: has_measured

      paths = [character(len=member_length) :: "/case"]
      has_measured = has_member(file, measured_group)
      call add_paths(file, "/sweep", paths, error)
      if (.not. allocated(error) .and. has_measured) call add_paths(file, measured_group, paths, error)
      if (.not. allocated(error)) call add_paths(file, "/summary", paths, error)
      if (allocated(error)) return
      call make_columns(table, cases, size(paths))
      do i = 1, size(paths)
         call read_column(file, trim(paths(i)), table, i, error)
         if (allocated(error)) return
         if (index(paths(i), measured_group//"/") == 1) table%names(i)%text = measured_prefix//table%names(i)%text
      end do
   end subroutine read_summary

   !> Add the members of a group to paths.
   subroutine add_paths(file, group, paths, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the group from the root
      character(len=*), intent(in) :: group
      !> Paths so far
      character(len=member_length), allocatable, intent(inout) :: paths(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: names(:)
      integer :: i, count

      call list_members(file, group, names, error)
      if (allocated(error)) return
      count = size(paths)
      paths = [paths, names]
      do i = 1, size(names)
         paths(count + i) = group//"/"//names(i)
      end do
   end subroutine add_paths

   !> An error where a case does not exist, was not computed or has failed.
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
            ! The message names its case
            call raise(error, kind_usage, "no series of a case that failed: "//message)
         end if
      else if (nint(status(1)) == not_computed) then
         call raise(error, kind_usage, "case "//integer_text(case)//" has no series, it was not computed: the file is partial")
      else if (.not. has_member(file, "/series/cam_angle")) then
         call raise(error, kind_usage, "'"//file%file//"' holds no series, the summary alone")
      end if
   end subroutine check_case

   !> Write a table to a file that appears under its name when it is complete.
   subroutine write_file(path, table, form, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      type(table_t), intent(in) :: table
      !> One of `export_formats`
      character(len=*), intent(in) :: form
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(raw_file_t) :: file

      call begin_new_file(place, path, table_kind, error)
      if (.not. allocated(error)) call create_raw(file, place%temporary, path, error)
      if (.not. allocated(error)) call write_rows(table, form, error, file)
      call close_raw(file)
      if (allocated(error)) then
         call drop_new_file(place)
      else
         call end_new_file(place, file%bytes, error)
      end if
   end subroutine write_file

   !> Write all rows, or in JSON all columns, many at a time.
   subroutine write_rows(table, form, error, file)
      type(table_t), intent(in) :: table
      !> One of `export_formats`
      character(len=*), intent(in) :: form
      !> File error
      type(error_t), allocatable, intent(out) :: error
      !> The open file; without it the output unit
      type(raw_file_t), intent(inout), optional :: file

      character(len=:), allocatable :: line
      character(len=block_length) :: block
      integer :: row, length, last

      length = 0
      last = size(table%numbers, 1)
      if (form == "json") last = size(table%names) - 1
      do row = -1, last
         if (form == "json") then
            call column_text(table, row + 1, line)
         else if (row == -1 .and. form == "plain") then
            cycle
         else
            call row_text(table, row, form, line)
         end if
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
   pure subroutine row_text(table, row, form, line)
      type(table_t), intent(in) :: table
      !> The row, from 1; 0 for the units, or names with units, -1 for the names
      integer, intent(in) :: row
      !> One of `export_formats`
      character(len=*), intent(in) :: form
      character(len=:), allocatable, intent(out) :: line

      character(len=number_length) :: number
      integer :: i

      line = ""
      do i = 1, size(table%names)
         if (i > 1) line = line//","
         if (row == -1) then
            line = line//quoted(table%names(i)%text)
         else if (row == 0 .and. form == "plain") then
            line = line//quoted(table%names(i)%text//" ["//table%units(i)%text//"]")
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

   !> One column of a table in JSON; the first line opens the object, the last column closes it. JSON has no infinite numbers: they
   !> are texts that languages read as such, and what is no number is null.
   subroutine column_text(table, column, line)
      type(table_t), intent(in) :: table
      !> The column, from 1; 0 for the beginning
      integer, intent(in) :: column
      character(len=:), allocatable, intent(out) :: line

      character(len=number_length) :: number
      integer :: row

      line = '{"columns": ['
      if (column == 0) return
      line = '{"name": '//json_text(table%names(column)%text)//', "unit": '//json_text(table%units(column)%text)//', "values": ['
      do row = 1, size(table%numbers, 1)
         if (row > 1) line = line//", "
         if (table%has_words(column)) then
            line = line//json_text(table%words(row, column)%text)
         else if (ieee_is_finite(table%numbers(row, column))) then
            call write_number(table%numbers(row, column), "e3", decimals, number)
            line = line//trim(adjustl(number))
         else if (ieee_is_nan(table%numbers(row, column))) then
            line = line//"null"
         else
            line = line//trim(merge('"-Infinity"', '"Infinity" ', table%numbers(row, column) < 0.0_wp))
         end if
      end do
      line = line//"]}"
      if (column < size(table%names)) line = line//","
      if (column == size(table%names)) line = line//"]}"
   end subroutine column_text

   !> A text in JSON.
   pure function json_text(word) result(text)
      !> The text
      character(len=*), intent(in) :: word
      !> In quotes, with quotes, backslashes and control characters escaped
      character(len=:), allocatable :: text

      integer :: i

      text = """"
      do i = 1, len(word)
         select case (word(i:i))
         case ("""", "\")
            text = text//"\"//word(i:i)
         case (achar(0):achar(31))
            text = text//" "
         case default
            text = text//word(i:i)
         end select
      end do
      text = text//""""
   end function json_text

   !> A word as CSV wants it: in quotes where it holds a comma, a quote or a line end.
   pure function quoted(word) result(text)
      character(len=*), intent(in) :: word
      !> The word as it stands in the table
      character(len=:), allocatable :: text

      text = word
      if (scan(word, ","""//new_line("a")) > 0) text = """"//replaced(word, """", """""")//""""
   end function quoted

end module camroller_export
