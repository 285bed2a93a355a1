!> Columns of a table of cases, and what reads them from files of one kind.
!>
!> In: a path. Out: one column of texts for each key. Tables in text are read by `sweep_table`; a reader of another kind of file
!> is handed down by the caller, so that nothing here depends on the library behind it.
module camroller_case_columns
   use camroller_error, only : error_t
   use camroller_text_list, only : text_list_t
   implicit none
   private

   public :: column_t, column_reader_t

   !> Beginning of the names of columns of measured values, and what stands where nothing was measured
   character(len=*), parameter, public :: measured_prefix = "measured.", nothing_measured = "-"

   !> One column
   type :: column_t
      !> Name of the key, as `group.key`
      character(len=:), allocatable :: key
      !> Unit that the file gives beside the name; empty where it gives none
      character(len=:), allocatable :: unit
      !> Its value in each case
      type(text_list_t) :: cells
      !> Line of each case in the file, 0 where it has no lines
      integer, allocatable :: lines(:)
   end type column_t

   !> Reader of tables in files of one kind
   type, abstract :: column_reader_t
   contains
      !> Is a file of that kind?
      procedure(takes_file), deferred :: takes
      !> Read its columns
      procedure(read_file), deferred :: read_columns
   end type column_reader_t

   abstract interface
      !> Is a file of the kind that a reader reads?
      function takes_file(self, path) result(verdict)
         import :: column_reader_t
         class(column_reader_t), intent(in) :: self
         !> Path of the file
         character(len=*), intent(in) :: path
         !> Is it?
         logical :: verdict
      end function takes_file

      !> Read the columns of a file.
      subroutine read_file(self, path, columns, error)
         import :: column_reader_t, column_t, error_t
         class(column_reader_t), intent(in) :: self
         !> Path of the file
         character(len=*), intent(in) :: path
         type(column_t), allocatable, intent(out) :: columns(:)
         !> File error
         type(error_t), allocatable, intent(out) :: error
      end subroutine read_file
   end interface

end module camroller_case_columns
