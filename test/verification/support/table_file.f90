!> Tables of numbers for tests: comment lines, one line of names, rows of numbers between commas.
module table_file
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp
   implicit none
   private

   public :: read_table

contains

   !> Read a table below test/data.
   subroutine read_table(name, columns, rows, error)
      !> Name of the file in test/data
      character(len=*), intent(in) :: name
      !> Number of columns
      integer, intent(in) :: columns
      !> Numbers, row by row in the second index [as in the file]
      real(wp), allocatable, intent(out) :: rows(:, :)
      !> The file is missing or holds something else
      type(error_type), allocatable, intent(out) :: error

      character(len=1000) :: line
      real(wp) :: row(columns)
      integer :: unit, status
      logical :: have_names

      allocate (rows(columns, 0))
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
            read (line, *, iostat=status) row
            if (status /= 0) exit
            rows = reshape([rows, row], [columns, size(rows, 2) + 1])
         end if
         have_names = .true.
      end do
      close (unit)
      if (.not. is_iostat_end(status) .or. size(rows, 2) == 0) call test_failed(error, "cannot read test/data/"//name)
   end subroutine read_table

end module table_file
