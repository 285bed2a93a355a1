!> Tables of two columns: read from a file, checked for order and gaps.
!>
!> In: a path. Out: the numbers as they stand in the file, or mistakes with file and line. Columns are parted by
!> blanks, tabulators, commas or semicolons; `#` or `!` begins a comment; empty lines are skipped, and so is a heading: a first
!> line whose first two words are no numbers.
module camroller_table_file
   use camroller_kinds, only : wp
   use camroller_text_file, only : read_text_file
   use camroller_error, only : error_t
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_text_lines, only : text_lines_t, split_lines
   use camroller_deck_text, only : to_lower
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
      type(text_lines_t) :: lines
      !> Numbers of one row [unit of the file]
      real(wp) :: row(2)
      integer :: i, n, before
      logical :: has_row, is_first

      table%path = path
      allocate (table%x(0), table%y(0), table%line(0))
      call read_text_file(path, text, error)
      if (allocated(error)) return
      call split_lines(text, lines)
      deallocate (table%x, table%y, table%line)
      allocate (table%x(lines%count), table%y(lines%count), table%line(lines%count))
      n = 0
      before = mistakes%count
      is_first = .true.
      do i = 1, lines%count
         associate (line => text(lines%first(i):lines%last(i)))
            call read_row(path, line, i, is_first, row, has_row, mistakes)
            if (.not. has_row) cycle
            n = n + 1
            table%x(n) = row(1)
            table%y(n) = row(2)
            table%line(n) = i
            if (n == 1) cycle
            if (table%x(n) > table%x(n - 1)) cycle
            call add_mistake(mistakes, "the first column must increase; "//number_text(row(1))//" follows "// &
               & number_text(table%x(n - 1)), i, 0, 0, path, line)
         end associate
      end do
      if (mistakes%count > before) n = 0
      table%x = table%x(:n)
      table%y = table%y(:n)
      table%line = table%line(:n)
   end subroutine read_table

   !> Read the two numbers of a line.
   subroutine read_row(path, line, number, is_first, row, has_row, mistakes)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The line
      character(len=*), intent(in) :: line
      !> Its number
      integer, intent(in) :: number
      !> Has no line held anything so far?
      logical, intent(inout) :: is_first
      !> Its numbers [unit of the file]
      real(wp), intent(out) :: row(2)
      !> Does the line hold a row?
      logical, intent(out) :: has_row
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: words
      integer :: first, last, length, columns, status

      row = 0.0_wp
      has_row = .false.
      length = scan(line, "#!") - 1
      if (length < 0) length = len_trim(line)
      if (verify(line(:length), separators) == 0) return
      if (is_first) then
         is_first = .false.
         if (is_heading(line(:length))) return
      end if
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
         call add_mistake(mistakes, "'"//shown(line(first:last))//"' is no finite number", number, first, last - first + 1, &
            & path, line)
         return
      end do
      has_row = columns == 2
      if (columns == 0 .or. columns == 2) return
      words = ""
      if (index(line(:length), ",") > 0) words = "; a comma parts columns, decimals have a point"
      call add_mistake(mistakes, "a row has two columns, not "//integer_text(columns)//words, number, 0, 0, path, line)
   end subroutine read_row

   !> Is a line a heading: are its first words no numbers, not even wrong ones?
   pure function is_heading(line) result(verdict)
      !> The line, without its comment
      character(len=*), intent(in) :: line
      !> Is it?
      logical :: verdict

      character(len=*), parameter :: wrong_numbers(*) = [character(len=8) :: "nan", "inf", "infinity"]
      integer :: word, first, last

      verdict = .false.
      last = 0
      do word = 1, 2
         first = verify(line(last + 1:), separators) + last
         if (first == last) exit
         last = scan(line(first:), separators)
         last = merge(len(line), first + last - 2, last == 0)
         if (is_number(line(first:last))) return
         if (any(to_lower(line(verify(line(first:last), "+-") + first - 1:last)) == wrong_numbers)) return
      end do
      verdict = .true.
   end function is_heading

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
         & number_text(table%x(widest + 1), 10)//", more than ten times the usual distance of "//number_text(median, 3), &
         & table%line(widest + 1), 0, 0, table%path, number_text(table%x(widest + 1))//"  "//number_text(table%y(widest + 1)))
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
