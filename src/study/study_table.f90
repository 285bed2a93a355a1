!> Table with the same text and number columns in every row: the result of a study, for files and for the screen.
!>
!> In: the meaning of each column, rows one by one, values by the names of their columns. Out: `study_table_t`.
module camroller_study_table
   use camroller_kinds, only : wp, not_a_number
   use camroller_result, only : find_quantity, quantity_t
   implicit none
   private

   public :: study_table_t, word_length, add_words, add_numbers, new_row, set_number, set_word, column_of, words_of

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

   !> Append a column of words to a table without rows.
   subroutine add_words(table, name, description, source)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> Name, meaning, part of the program
      character(len=*), intent(in) :: name, description, source

      call add_column(table%word_columns, name, "", description, source)
   end subroutine add_words

   !> Append a column of numbers to a table without rows.
   subroutine add_numbers(table, name, unit, description, source)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> Name, unit, meaning, part of the program or of the model
      character(len=*), intent(in) :: name, unit, description, source

      call add_column(table%number_columns, name, unit, description, source)
   end subroutine add_numbers

   !> Append a column.
   subroutine add_column(columns, name, unit, description, source)
      !> The columns; not allocated where there is none
      type(quantity_t), allocatable, intent(inout) :: columns(:)
      !> Name, unit, meaning, part of the program
      character(len=*), intent(in) :: name, unit, description, source

      type(quantity_t) :: new

      ! Component by component: a constructor with components of deferred length leaves memory behind in gfortran 12
      new%name = trim(name)
      new%unit = unit
      new%description = description
      new%source = source
      if (.not. allocated(columns)) allocate (columns(0))
      columns = [columns, new]
   end subroutine add_column

   !> Append a row without words and numbers.
   subroutine new_row(table)
      !> The table
      type(study_table_t), intent(inout) :: table

      character(len=word_length), allocatable :: more_words(:, :)
      ! Larger copy [unit of the column]
      real(wp), allocatable :: more_numbers(:, :)
      integer :: n

      n = table%rows
      if (.not. allocated(table%words)) allocate (table%words(first_room, size(table%word_columns)), &
         & table%numbers(first_room, size(table%number_columns)))
      if (n == size(table%words, 1)) then
         allocate (more_words(2*n, size(table%words, 2)), more_numbers(2*n, size(table%numbers, 2)))
         more_words(:n, :) = table%words
         more_numbers(:n, :) = table%numbers
         call move_alloc(more_words, table%words)
         call move_alloc(more_numbers, table%numbers)
      end if
      table%rows = n + 1
      table%words(table%rows, :) = ""
      table%numbers(table%rows, :) = not_a_number()
   end subroutine new_row

   !> Give the last row a number.
   subroutine set_number(table, name, value)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> The number [unit of the column]
      real(wp), intent(in) :: value

      table%numbers(table%rows, find_quantity(table%number_columns, name)) = value
   end subroutine set_number

   !> Give the last row a word.
   subroutine set_word(table, name, word)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> The word
      character(len=*), intent(in) :: word

      table%words(table%rows, find_quantity(table%word_columns, name)) = word
   end subroutine set_word

   !> Numbers of a column by its name.
   pure function column_of(table, name) result(values)
      !> The table
      type(study_table_t), intent(in) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Its numbers, one for each row [unit of the column]
      real(wp) :: values(table%rows)

      if (table%rows == 0) return
      values = table%numbers(:table%rows, find_quantity(table%number_columns, name))
   end function column_of

   !> Words of a column by its name.
   pure function words_of(table, name) result(words)
      !> The table
      type(study_table_t), intent(in) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Its words, one for each row
      character(len=word_length) :: words(table%rows)

      if (table%rows == 0) return
      words = table%words(:table%rows, find_quantity(table%word_columns, name))
   end function words_of

end module camroller_study_table
