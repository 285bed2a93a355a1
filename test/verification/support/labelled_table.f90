!> Tables of numbers, which may have a word in front of each row: comment lines, one line of names, rows between commas.
module labelled_table
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp
   implicit none
   private

   public :: read_table, label_length

   !> Longest word in front of a row
   integer, parameter :: label_length = 32

contains

   !> Read a table below test/data.
   subroutine read_table(name, columns, rows, error, labels)
      !> Name of the file in test/data
      character(len=*), intent(in) :: name
      !> Number of columns of numbers
      integer, intent(in) :: columns
      !> Numbers, row by row in the second index [as in the file]
      real(wp), allocatable, intent(out) :: rows(:, :)
      !> The file is missing or holds something else
      type(error_type), allocatable, intent(out) :: error
      !> Words in front of the rows, where there are any
      character(len=label_length), allocatable, intent(out), optional :: labels(:)

      character(len=1000) :: line
      character(len=label_length) :: label
      real(wp) :: row(columns)
      integer :: unit, status
      logical :: have_names

      allocate (rows(columns, 0))
      if (present(labels)) allocate (labels(0))
      open (newunit=unit, file="test/data/"//name, status="old", action="read", iostat=status)
      if (status /= 0) then
         call test_failed(error, "cannot open test/data/"//name)
         return
      end if
      have_names = .false.
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (line == "" .or. line(1:1) == "#") cycle
         if (have_names) then
            if (present(labels)) then
               read (line, *, iostat=status) label, row
            else
               read (line, *, iostat=status) row
            end if
            if (status /= 0) exit
            if (present(labels)) labels = [character(len=label_length) :: labels, label]
            rows = reshape([rows, row], [columns, size(rows, 2) + 1])
         end if
         have_names = .true.
      end do
      close (unit)
      if (.not. is_iostat_end(status) .or. size(rows, 2) == 0) call test_failed(error, "cannot read test/data/"//name)
   end subroutine read_table

end module labelled_table
