!> Tables of cases in HDF5 files.
!>
!> In: a path. Out: columns of texts. The columns are datasets with one axis, named `group.key`, at the root, where nothing else may
!> stand, or in a group `/sweep`, so that a result file is a table of its own cases, with what was measured in them. Their attribute
!> `units`, where they have one, is the column's unit.
module camroller_hdf5_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file
   use camroller_number_text, only : number_text
   use camroller_quotes, only : in_quotes
   use camroller_text_list, only : new_text_list, put_text_at
   use camroller_case_columns, only : column_t, column_reader_t, measured_prefix, nothing_measured
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_read, only : member_length, open_file, has_member, list_members, read_extents, is_text_dataset, &
      & read_numbers, read_text, read_text_attribute
   implicit none
   private

   public :: hdf5_columns_t

   !> Digits that give every number back
   integer, parameter :: all_digits = 17

   !> Reader of tables in HDF5 files
   type, extends(column_reader_t) :: hdf5_columns_t
      !> First bytes of a file that it takes
      character(len=4) :: mark = char(137)//"HDF"
   contains
      procedure :: takes => is_hdf5
      procedure :: read_columns => read_datasets
   end type hdf5_columns_t

contains

   !> Does a file begin as HDF5 files do?
   function is_hdf5(self, path) result(verdict)
      !> The reader
      class(hdf5_columns_t), intent(in) :: self
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
      verdict = status == 0 .and. mark == self%mark
   end function is_hdf5

   !> Columns of an HDF5 file.
   subroutine read_datasets(self, path, columns, error)
      !> The reader
      class(hdf5_columns_t), intent(in) :: self
      !> Path of the file
      character(len=*), intent(in) :: path
      type(column_t), allocatable, intent(out) :: columns(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: file
      type(column_t) :: column
      character(len=member_length), allocatable :: names(:)
      character(len=:), allocatable :: group
      integer :: i

      allocate (columns(0))
      if (.not. self%takes(path)) return
      call open_file(file, path, error)
      if (allocated(error)) return
      group = "/"
      if (has_member(file, "/sweep")) group = "/sweep/"
      call list_members(file, group, names, error)
      do i = 1, size(names)
         if (allocated(error)) exit
         if (index(names(i), ".") == 0) then
            if (group == "/") call raise(error, kind_file, "'/"//trim(names(i))//"' of '"//path//"' is no column of a table of "// &
               & "cases: these are datasets at the root, named group.key")
            cycle
         end if
         column%key = trim(names(i))
         call read_cells(file, group//trim(names(i)), column, error)
         if (.not. allocated(error)) columns = [columns, column]
      end do
      if (group /= "/" .and. .not. allocated(error)) call add_measured(file, columns, error)
      call discard_file(file)
   end subroutine read_datasets

   !> Columns of what was measured, of a result file.
   subroutine add_measured(file, columns, error)
      !> The open file
      type(hdf5_object_t), intent(in) :: file
      !> Columns so far; out: with these
      type(column_t), allocatable, intent(inout) :: columns(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: group = "/measured"
      type(column_t) :: column
      character(len=member_length), allocatable :: names(:)
      integer :: i

      if (.not. has_member(file, group)) return
      call list_members(file, group, names, error)
      do i = 1, size(names)
         if (allocated(error)) return
         column%key = measured_prefix//trim(names(i))
         call read_cells(file, group//"/"//trim(names(i)), column, error)
         if (.not. allocated(error)) columns = [columns, column]
      end do
   end subroutine add_measured

   !> Unit and values of a dataset, these as texts.
   subroutine read_cells(file, name, column, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Gets unit and values
      type(column_t), intent(inout) :: column
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      !> Values of the dataset [unit of the key]
      real(wp), allocatable :: numbers(:)
      integer, allocatable :: extents(:)
      integer :: i, n, width, pass

      call read_extents(file, name, 1, extents, error)
      column%unit = ""
      if (.not. allocated(error)) then
         if (has_member(file, name, "units")) call read_text_attribute(file, name, "units", column%unit, error)
      end if
      if (allocated(error)) return
      n = extents(1)
      if (allocated(column%lines)) deallocate (column%lines)
      allocate (column%lines(n), source=0)
      if (is_text_dataset(file, name)) then
         width = 1
         do pass = 1, 2
            if (pass == 2) call new_text_list(column%cells, n, width)
            do i = 1, n
               call read_text(file, name, [i - 1], text, error)
               if (allocated(error)) return
               width = max(width, len(in_quotes(text)))
               if (pass == 2) call put_text_at(column%cells, i, in_quotes(text))
            end do
         end do
      else
         call new_text_list(column%cells, n, all_digits + 8)
         call read_numbers(file, name, [0], [n], numbers, error)
         if (allocated(error)) return
         do i = 1, n
            if (ieee_is_nan(numbers(i)) .and. index(column%key, measured_prefix) == 1) then
               call put_text_at(column%cells, i, nothing_measured)
            else
               call put_text_at(column%cells, i, number_text(numbers(i), all_digits))
            end if
         end do
      end if
   end subroutine read_cells

end module camroller_hdf5_columns
