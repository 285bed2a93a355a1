!> Tables of two columns: read from a file, checked for order and gaps.
!>
!> Layer: io. In: a path. Out: the numbers as they stand in the file, or mistakes with file and line. Columns are parted
!> by
!> blanks, tabulators, commas or semicolons; `#` or `!` begins a comment; empty lines are skipped.
module camroller_table_file
   use camroller_kinds, only : wp
   use camroller_text_file, only : read_text_file
   use camroller_error, only : error_t
   use camroller_mistakes, only : line_t, mistakes_t, add_mistake, split_lines
   use camroller_number_text, only : is_number, is_beyond_range, number_text, integer_text
   implicit none
   private

   public :: table_t, read_table, check_spacing

   !> One table
   type :: table_t
      !> File it is from
      character(len=:), allocatable :: path
      !> First column [unit of the file]
      real(wp), allocatable :: x(:)
      !> Second column [unit of the file]
      real(wp), allocatable :: y(:)
      !> Line of each row
      integer, allocatable :: line(:)
   end type table_t

   !> What parts columns
   character(len=*), parameter :: separators = " ,;"//char(9)
   !> Mistakes after which the rest of a table is left alone
   integer, parameter :: most_mistakes = 5
   !> An interval so many times the median is a gap [-]
   real(wp), parameter :: gap_ratio = 10.0_wp

contains

   !> Read a table.
   subroutine read_table(path, table, mistakes, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The table; without rows where there are mistakes
      type(table_t), intent(out) :: table
      !> Mistakes so far; those of the table are added
      type(mistakes_t), intent(inout) :: mistakes
      !> File error where the file cannot be read
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      type(line_t), allocatable :: lines(:)
      !> Numbers of one row [unit of the file]
      real(wp) :: row(2)
      integer :: i, n, before
      logical :: has_row

      table%path = path
      allocate (table%x(0), table%y(0), table%line(0))
      call read_text_file(path, text, error)
      if (allocated(error)) return
      call split_lines(text, lines)
      deallocate (table%x, table%y, table%line)
      allocate (table%x(size(lines)), table%y(size(lines)), table%line(size(lines)))
      n = 0
      before = mistakes%count
      do i = 1, size(lines)
         call read_row(path, lines(i)%text, i, row, has_row, mistakes)
         if (mistakes%count - before >= most_mistakes) exit
         if (.not. has_row) cycle
         n = n + 1
         table%x(n) = row(1)
         table%y(n) = row(2)
         table%line(n) = i
         if (n == 1) cycle
         if (table%x(n) > table%x(n - 1)) cycle
         call add_mistake(mistakes, "the first column must increase; "//number_text(row(1))//" follows "// &
            & number_text(table%x(n - 1)), i, 0, 0, path, lines(i)%text)
      end do
      if (mistakes%count > before) n = 0
      table%x = table%x(:n)
      table%y = table%y(:n)
      table%line = table%line(:n)
   end subroutine read_table

   !> Read the two numbers of a line.
   subroutine read_row(path, line, number, row, has_row, mistakes)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The line
      character(len=*), intent(in) :: line
      !> Its number
      integer, intent(in) :: number
      !> Its numbers [unit of the file]
      real(wp), intent(out) :: row(2)
      !> Does the line hold a row?
      logical, intent(out) :: has_row
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: first, last, length, columns, status

      row = 0.0_wp
      has_row = .false.
      length = scan(line, "#!") - 1
      if (length < 0) length = len_trim(line)
      columns = 0
      last = 0
      do
         first = verify(line(last + 1:length), separators) + last
         if (first == last) exit
         last = scan(line(first:length), separators)
         last = merge(length, first + last - 2, last == 0)
         columns = columns + 1
         if (columns > 2) cycle
         status = 1
         if (is_number(line(first:last)) .and. .not. is_beyond_range(line(first:last))) then
            read (line(first:last), *, iostat=status) row(columns)
         end if
         if (status == 0) cycle
         call add_mistake(mistakes, "'"//line(first:last)//"' is no finite number", number, first, last - first + 1, &
            & path, line)
         return
      end do
      has_row = columns == 2
      if (columns == 0 .or. columns == 2) return
      call add_mistake(mistakes, "a row has two columns, not "//integer_text(columns), number, 0, 0, path, line)
   end subroutine read_row

   !> No gaps in the first column?
   subroutine check_spacing(table, mistakes)
      !> The table
      type(table_t), intent(in) :: table
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Distances between the rows, and the one in the middle of them by size [unit of the file]
      real(wp) :: intervals(size(table%x) - 1), median
      integer :: n, widest

      n = size(table%x)
      intervals = table%x(2:) - table%x(:n - 1)
      widest = maxloc(intervals, dim=1)
      median = middle_value(intervals)
      if (intervals(widest) <= gap_ratio*median) return
      call add_mistake(mistakes, "the table has a gap from "//number_text(table%x(widest), 10)//" to "// &
         & number_text(table%x(widest + 1), 10)//", more than ten times the usual distance of "//number_text(median, &
         & 3), &
         & table%line(widest + 1), 0, 0, table%path)
   end subroutine check_spacing

   !> Value in the middle of a list by size, by halving the range it is in.
   pure function middle_value(list) result(middle)
      !> The list, all positive [any unit]
      real(wp), intent(in) :: list(:)
      !> Its median, to a thousandth [the same unit]
      real(wp) :: middle

      !> Ends of the range that the median is in [the same unit]
      real(wp) :: lower, upper

      lower = 0.0_wp
      upper = maxval(list)
      do while (upper - lower > 1.0e-3_wp*upper)
         middle = 0.5_wp*(lower + upper)
         if (2*count(list <= middle) > size(list)) then
            upper = middle
         else
            lower = middle
         end if
      end do
      middle = upper
   end function middle_value

end module camroller_table_file
