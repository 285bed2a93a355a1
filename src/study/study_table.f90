!> Table with the same text and number columns in every row: the result of a study, for files and for the screen.
!>
!> In: the meaning of each column, rows one by one. Out: `study_table_t`.
module camroller_study_table
   use camroller_kinds, only : wp
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: study_table_t, word_length, new_table, add_row, column_of

   !> Longest word of a table; messages are cut to it
   integer, parameter :: word_length = 240
   !> Rows for which a new table has room
   integer, parameter :: first_room = 64

   !> The table
   type :: study_table_t
      !> Rows in use
      integer :: rows = 0
      !> Meaning of the columns with words and of those with numbers
      type(quantity_t), allocatable :: word_columns(:), number_columns(:)
      !> Words, shape (row, column)
      character(len=word_length), allocatable :: words(:, :)
      !> Numbers, shape (row, column); not a number where a row has none [unit of the column]
      real(wp), allocatable :: numbers(:, :)
   end type study_table_t

contains

   !> An empty table.
   subroutine new_table(table, word_columns, number_columns)
      !> The table
      type(study_table_t), intent(out) :: table
      !> Meaning of the columns with words and of those with numbers
      type(quantity_t), intent(in) :: word_columns(:), number_columns(:)

      table%word_columns = word_columns
      table%number_columns = number_columns
      allocate (table%words(first_room, size(word_columns)), table%numbers(first_room, size(number_columns)))
   end subroutine new_table

   !> Append a row.
   subroutine add_row(table, words, numbers)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> A word for each column with words
      character(len=*), intent(in) :: words(:)
      !> A number for each column with numbers [unit of the column]
      real(wp), intent(in) :: numbers(:)

      character(len=word_length), allocatable :: more_words(:, :)
      ! Larger copy [unit of the column]
      real(wp), allocatable :: more_numbers(:, :)
      integer :: n

      n = table%rows
      if (n == size(table%words, 1)) then
         allocate (more_words(2*n, size(table%words, 2)), more_numbers(2*n, size(table%numbers, 2)))
         more_words(:n, :) = table%words
         more_numbers(:n, :) = table%numbers
         call move_alloc(more_words, table%words)
         call move_alloc(more_numbers, table%numbers)
      end if
      table%rows = n + 1
      table%words(table%rows, :) = words
      table%numbers(table%rows, :) = numbers
   end subroutine add_row

   !> Numbers of a column by its name; empty where there is no such column.
   pure function column_of(table, name) result(values)
      !> The table
      type(study_table_t), intent(in) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Its numbers, one for each row [unit of the column]
      real(wp), allocatable :: values(:)

      integer :: i

      allocate (values(0))
      do i = 1, size(table%number_columns)
         if (table%number_columns(i)%name == name) values = table%numbers(:table%rows, i)
      end do
   end function column_of

end module camroller_study_table
