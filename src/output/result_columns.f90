!> Columns of a result file: scalars and series by name, with their units.
!>
!> In: a result file. Out: a table of numbers or words by column.
module camroller_result_columns
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file, kind_usage
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : check_extents, has_member, is_text_dataset, list_members, member_length, open_file, &
      & read_extents, read_integer_attribute, read_numbers, read_text, read_text_attribute
   use camroller_output_file, only : format_version, result_format
   use camroller_text_lines, only : line_t
   implicit none
   private

   public :: table_t, open_result, check_has_cases, holds_contacts_alone, read_column, make_columns, head_column

   !> A table to be written: numbers or words, by column
   type :: table_t
      !> Names and units of the columns
      type(line_t), allocatable :: names(:), units(:)
      !> Numbers, shape (row, column) [unit of the column]
      real(wp), allocatable :: numbers(:, :)
      !> Words, shape (row, column), where a column is none of numbers
      type(line_t), allocatable :: words(:, :)
      !> Which columns hold words
      logical, allocatable :: has_words(:)
   end type table_t

contains

   !> Open a file that is one of our results with scalars of cases, and was written to its end: complete, or partial by intention.
   subroutine open_result(file, path, cases, error)
      !> The open file
      type(hdf5_object_t), intent(out) :: file
      !> Its path
      character(len=*), intent(in) :: path
      !> Number of cases, in one element
      integer, allocatable, intent(out) :: cases(:)
      !> File error; usage error where it is of a command whose files have no scalars of cases
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
      if (.not. allocated(error)) call check_has_cases(file, .false., error)
      if (.not. allocated(error)) call read_extents(file, "/case", 1, cases, error)
   end subroutine open_result

   !> An error that says what a file holds where that is something else than scalars and series of cases.
   subroutine check_has_cases(file, is_with_contacts, error)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> May it hold solved contacts as well?
      logical, intent(in) :: is_with_contacts
      !> Usage error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: command

      if (holds_contacts_alone(file)) then
         if (.not. is_with_contacts) call raise(error, kind_usage, "'"//file%file//"' is a file of 'camroller ehl', with "// &
            & "solved contacts in /ehl and no series and scalars that could be exported; 'camroller rerun' computes it again, "// &
            & "'python post/ehl.py' draws it")
         return
      end if
      if (has_member(file, "/summary")) then
         if (has_member(file, "/summary/status")) return
      end if
      if (has_member(file, "/study")) then
         command = "study"
         if (has_member(file, "/study/audit")) command = "audit"
         call raise(error, kind_usage, "'"//file%file//"' is a file of 'camroller "//command//"', with a table in /study and "// &
            & "no cases that could be exported or computed again; 'python post/plot_"//command//".py' draws it")
      end if
   end subroutine check_has_cases

   !> Does a file hold solved contacts alone? Where they stand beside results, the summary has more than the status of each case.
   function holds_contacts_alone(file) result(verdict)
      !> A result file
      type(hdf5_object_t), intent(in) :: file
      !> Does it?
      logical :: verdict

      character(len=member_length), allocatable :: names(:)
      type(error_t), allocatable :: error

      verdict = has_member(file, "/ehl")
      if (.not. verdict) return
      call list_members(file, "/summary", names, error)
      if (.not. allocated(error)) verdict = all(names == "status")
   end function holds_contacts_alone

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

end module camroller_result_columns
