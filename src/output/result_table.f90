!> The results of a file as a table for the screen: one line for each case, the numbers that are asked for first.
!>
!> In: a result file. Out: lines of text. Slip, pressure and film of a case with several lobe shapes are those of the worst one.
module camroller_result_table
   use camroller_kinds, only : wp
   use camroller_catalogue, only : lobe_prefix
   use camroller_error, only : error_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : has_member, list_members, member_length, read_numbers
   use camroller_names, only : name_length
   use camroller_number_text, only : integer_text, number_text, right_text
   use camroller_result, only : severest, worse_of
   use camroller_result_columns, only : make_columns, open_result, read_column, table_t
   use camroller_torque_list, only : is_loss, torque_count, torque_list, torque_series
   implicit none
   private

   public :: write_result_table

   !> One column of the table
   type :: column_t
      !> Scalar of the summary: what of a series, its name
      character(len=5) :: statistic
      character(len=name_length) :: series
      !> Heading and unit
      character(len=14) :: heading
      character(len=5) :: unit
      !> What its value is multiplied with [unit/SI unit]
      real(wp) :: factor
   end type column_t

   !> Cases that are shown
   integer, parameter :: most_rows = 40
   !> Digits of a result
   integer, parameter :: digits = 3

contains

   !> Lines of a table with the results of a file.
   subroutine write_result_table(path, text, error)
      !> Path of the result file
      character(len=*), intent(in) :: path
      !> The lines
      character(len=:), allocatable, intent(out) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: file
      type(table_t) :: table
      character(len=member_length), allocatable :: swept(:)
      type(column_t), allocatable :: columns(:)
      character(len=:), allocatable :: worst
      ! Number of cases
      integer, allocatable :: cases(:)
      ! Status of the cases [-]
      real(wp), allocatable :: status(:)
      integer :: i, k

      text = ""
      worst = ""
      call open_result(file, path, cases, error)
      if (.not. allocated(error)) call list_members(file, "/sweep", swept, error)
      if (.not. allocated(error)) call read_numbers(file, "/summary/status", [0], cases, status, error)
      if (.not. allocated(error)) then
         columns = shown_columns(file)
         call make_columns(table, cases(1), size(swept) + size(columns))
         do i = 1, size(table%names)
            if (i <= size(swept)) then
               call read_column(file, "/sweep/"//trim(swept(i)), table, i, error)
            else
               call read_worst(file, columns(i - size(swept)), table, i, worst, error)
            end if
            if (allocated(error)) exit
         end do
      end if
      call discard_file(file)
      if (allocated(error)) return
      do k = 1, size(swept)
         table%names(k)%text = table%names(k)%text(index(table%names(k)%text, ".") + 1:)
         if (index(table%names(k)%text, trim(table%units(k)%text)) > 0 .or. table%units(k)%text == "1") table%units(k)%text = ""
      end do
      call put_lines(table, size(swept), columns, status, text)
      if (worst /= "") text = text//new_line("a")//"  "//worst//": the worst of all lobe shapes; "// &
         & "'camroller export --summary' has those of each"
   end subroutine write_result_table

   !> Read a scalar, of several lobe shapes the worst.
   subroutine read_worst(file, column, table, position, worst, error)
      type(hdf5_object_t), intent(in) :: file
      !> The scalar
      type(column_t), intent(in) :: column
      type(table_t), intent(inout) :: table
      !> Its column
      integer, intent(in) :: position
      !> Headings of such columns of several lobe shapes; out: with this one where it is one
      character(len=:), allocatable, intent(inout) :: worst
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Values of another lobe shape [unit of the scalar]
      real(wp), allocatable :: others(:)
      integer :: lobe

      call read_column(file, path_of(column, 1), table, position, error)
      if (allocated(error)) return
      lobe = 2
      do while (has_member(file, path_of(column, lobe)))
         call read_numbers(file, path_of(column, lobe), [0], [size(table%numbers, 1)], others, error)
         if (allocated(error)) return
         table%numbers(:, position) = worse_of(column%statistic, table%numbers(:, position), others)
         if (lobe == 2 .and. worst /= "") worst = worst//", "
         if (lobe == 2) worst = worst//trim(column%heading)
         lobe = lobe + 1
      end do
   end subroutine read_worst

   !> Path of a scalar in a result file.
   function path_of(column, lobe) result(path)
      !> The scalar
      type(column_t), intent(in) :: column
      !> Lobe shape, from 1; what is of the camshaft counts as the first's
      integer, intent(in) :: lobe
      !> The path
      character(len=:), allocatable :: path

      path = "/summary/"//trim(column%statistic)//trim(lobe_prefix(lobe))//trim(column%series)
   end function path_of

   !> Columns of the table: of those that are asked for first, the ones that the file has.
   function shown_columns(file) result(columns)
      type(hdf5_object_t), intent(in) :: file
      !> The columns
      type(column_t), allocatable :: columns(:)

      integer :: i

      columns = [(column_t("mean_", torque_series(i), torque_list(i)%heading, "N mm", 1.0e3_wp), i=1, torque_count)]
      columns = [pack(columns, is_loss), column_t("mean_", "torque_friction", "all friction", "N mm", 1.0e3_wp), &
         & column_t("fmep_", "friction", "fmep", "kPa", 1.0e-3_wp), pack(columns, .not. is_loss), &
         & column_t("mean_", "slip_ratio", "mean slip", "%", 1.0e2_wp), &
         & column_t("max_", "hertz_pressure", "peak pressure", "GPa", 1.0e-9_wp), &
         & column_t("min_", "film_thickness_min", "smallest film", "um", 1.0e6_wp), &
         & column_t("min_", "film_ratio", "film ratio", "1", 1.0_wp)]
      columns%series = severest(columns%series, has_member(file, "/summary/max_axial_pressure_max"))
      columns = pack(columns, columns%heading /= "")
      columns = pack(columns, [(has_member(file, path_of(columns(i), 1)), i=1, size(columns))])
   end function shown_columns

   !> The lines: heading, units, one for each case that is shown, and how many are not.
   subroutine put_lines(table, keys, columns, status, text)
      !> Numbers and words of the cases
      type(table_t), intent(inout) :: table
      !> Number of columns with keys that vary
      integer, intent(in) :: keys
      !> The others
      type(column_t), intent(in) :: columns(:)
      !> Status of the cases: above zero for one that failed [-]
      real(wp), intent(in) :: status(:)
      !> The lines
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: n = new_line("a")
      character(len=:), allocatable :: heading, unit, line
      integer :: widths(size(table%names)), column, row, rows

      rows = min(size(status), most_rows)
      heading = ""
      unit = ""
      do column = 1, size(table%names)
         if (column > keys) then
            table%names(column)%text = trim(columns(column - keys)%heading)
            table%units(column)%text = trim(columns(column - keys)%unit)
            if (table%units(column)%text == "1") table%units(column)%text = ""
         end if
         widths(column) = max(len(table%names(column)%text), len(table%units(column)%text))
         do row = 1, rows
            widths(column) = max(widths(column), len(cell(row, column)))
         end do
         heading = heading//right_text(table%names(column)%text, widths(column) + 2)
         unit = unit//right_text(table%units(column)%text, widths(column) + 2)
      end do
      text = heading//n//unit
      do row = 1, rows
         line = ""
         do column = 1, size(table%names)
            line = line//right_text(cell(row, column), widths(column) + 2)
         end do
         text = text//n//line
      end do
      if (rows < size(status)) text = text//n//"  ... and "//integer_text(size(status) - rows)// &
         & " more; 'camroller export --summary' has all"

   contains

      !> What stands in a row and a column.
      function cell(row, column) result(words)
         !> Row and column
         integer, intent(in) :: row, column
         !> The words
         character(len=:), allocatable :: words

         if (column > keys .and. status(row) > 0.0_wp) then
            words = "failed"
         else if (column > keys .and. status(row) < 0.0_wp) then
            words = "missing"
         else if (table%has_words(column)) then
            words = table%words(row, column)%text
         else if (column > keys .and. index(columns(max(1, column - keys))%series, "film_") == 1 .and. &
            & .not. table%numbers(row, column) > 0.0_wp) then
            ! Cam and roller part, and there is no film to speak of
            words = "-"
         else if (column > keys) then
            words = number_text(table%numbers(row, column)*columns(column - keys)%factor, digits)
         else
            words = number_text(table%numbers(row, column), 6)
         end if
      end function cell

   end subroutine put_lines

end module camroller_result_table
