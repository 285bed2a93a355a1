!> Tables of two columns: read from a file, checked for order and gaps.
!>
!> In: a path. Out: the numbers as they stand in the file, or mistakes with file and line. Columns are parted by
!> blanks, tabulators, commas or semicolons; `#` or `!` begins a comment; empty lines are skipped, and so is a heading: a first
!> line whose first two words are no numbers. A table may have more columns where its heading names the two that are wanted.
module camroller_table_file
   use camroller_kinds, only : wp
   use camroller_sorting, only : median
   use camroller_text_file, only : read_text_file
   use camroller_error, only : error_t
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_text_lines, only : text_lines_t, split_lines
   use camroller_deck_text, only : to_lower
   use camroller_number_text, only : is_number, is_beyond_range, number_text, integer_text
   implicit none
   private

   public :: table_t, columns_t, read_table, read_heading, write_heading, check_spacing

   !> Length of the name of a column, and of its unit
   integer, parameter :: column_name_length = 16

   !> What is wanted of a table with a heading
   type :: columns_t
      !> Names of the two columns
      character(len=column_name_length) :: names(2) = ""
      !> Rows that are wanted of a table with a column of this name: those with this number in it
      character(len=column_name_length) :: key = ""
      integer :: number = 0
   end type columns_t

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
      !> The columns that its heading named; not allocated where it has two without names
      type(columns_t), allocatable :: columns
      !> Names and units of the two columns in the heading; blank where it has none
      character(len=column_name_length) :: names(2) = "", units(2) = ""
   end type table_t

   !> What to say of a line with commas whose columns are too many
   character(len=*), parameter, public :: on_commas = "; a comma parts columns, decimals have a point"
   !> What parts columns
   character(len=*), parameter :: separators = " ,;"//char(9)
   !> Units that a name in a heading may end with, as those of keys do; one letter may be an index
   character(len=*), parameter :: last_words(*) = [character(len=3) :: "deg", "rad", "mm", "um", "bar", "Pa", "kPa", "MPa"]
   !> An interval so many times the median is a gap [-]
   real(wp), parameter :: gap_ratio = 10.0_wp

contains

   !> Read a table.
   subroutine read_table(path, table, mistakes, error, columns)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The table; without rows where there are mistakes
      type(table_t), intent(out) :: table
      !> Mistakes so far; those of the table are added
      type(mistakes_t), intent(inout) :: mistakes
      !> File error where the file cannot be read
      type(error_t), allocatable, intent(out) :: error
      !> Columns wanted where a heading names them; the first two where it does not
      type(columns_t), intent(in), optional :: columns

      character(len=:), allocatable :: text
      type(text_lines_t) :: lines
      !> Numbers of one row [unit of the file]
      real(wp) :: row(2)
      !> Places of the columns, of that with the key, and number of all; 0 without names
      integer :: places(4)
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
      places = 0
      do i = 1, lines%count
         associate (line => text(lines%first(i):lines%last(i)))
            if (is_first .and. has_words(line)) then
               is_first = .false.
               if (is_heading(line(:content_length(line)))) then
                  call read_heading(line, table, columns, places)
                  cycle
               end if
            end if
            call read_row(path, line, i, places, table%columns, row, has_row, mistakes)
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

   !> Letters of a line before its comment.
   pure function content_length(line) result(length)
      character(len=*), intent(in) :: line
      !> Their number
      integer :: length

      length = scan(line, "#!") - 1
      if (length < 0) length = len_trim(line)
   end function content_length

   !> Does a line hold more than a comment?
   pure function has_words(line) result(verdict)
      character(len=*), intent(in) :: line
      !> Does it?
      logical :: verdict

      verdict = verify(line(:content_length(line)), separators) > 0
   end function has_words

   !> Read a heading: the names of the columns, and their units.
   subroutine read_heading(line, table, columns, places)
      !> The heading
      character(len=*), intent(in) :: line
      !> Gets names and units of the columns that are read: of those that are wanted where it has both, of two where it has no more
      type(table_t), intent(inout) :: table
      !> What is wanted
      type(columns_t), intent(in), optional :: columns
      !> Places of the two columns, of that with the key, and number of all; 0 where the names are not there
      integer, intent(out), optional :: places(4)

      character(len=column_name_length) :: name, unit, units(2)
      integer :: first, count, found(4), i

      found = 0
      count = 0
      first = 1
      do
         call next_cell(line(:content_length(line)), first, name, unit)
         if (name == "") exit
         count = count + 1
         if (count <= 2) table%names(count) = name
         if (count <= 2) table%units(count) = unit
         if (.not. present(columns)) cycle
         if (name == columns%key) found(3) = count
         i = findloc(columns%names, name, dim=1)
         if (i == 0) cycle
         found(i) = count
         units(i) = unit
      end do
      if (any(found(:2) == 0)) then
         found = 0
         if (count > 2) table%names = ""
         if (count > 2) table%units = ""
      else
         found(4) = count
         table%names = columns%names
         table%units = units
         table%columns = columns
      end if
      if (present(places)) places = found
   end subroutine read_heading

   !> Next cell of a heading, as `name [unit]`, `name (unit)` or `name_unit`, in small letters. Words are parted by `_`; behind a
   !> name that has one, words are left out.
   pure subroutine next_cell(line, first, name, unit)
      !> The heading, without its comment
      character(len=*), intent(in) :: line
      !> Where to begin; behind the cell on return
      integer, intent(inout) :: first
      !> Name, blank where there is no cell left; unit, blank where it has none
      character(len=*), intent(out) :: name, unit

      character(len=:), allocatable :: cell
      integer :: last, opening, i, k

      name = ""
      unit = ""
      do while (name == "" .and. first <= len(line))
         if (scan(line, separators(2:)) > 0) then
            last = scan(line(first:), separators(2:))
         else
            first = first + verify(line(first:)//".", " ") - 1
            last = scan(line(first:), " ")
            ! A unit behind a blank belongs to the name before it
            if (last > 0) then
               opening = verify(line(first + last:), " ")
               if (opening > 0) then
                  opening = first + last + opening - 1
                  if (scan(line(opening:opening), "[(") > 0) last = scan(line(first:), "])") + 1
               end if
            end if
            if (last == 1 .or. last > len(line(first:))) last = 0
         end if
         last = merge(len(line), first + last - 2, last == 0)
         cell = trim(adjustl(line(first:last)))
         first = last + 2
         opening = scan(cell//"[", "[(")
         name = to_lower(cell(:opening - 1))
         i = index(trim(name), " ")
         if (i > 0 .and. index(name(:max(i, 1)), "_") > 0) name(i:) = ""
         do i = 1, len_trim(name)
            if (name(i:i) == " ") name(i:i) = "_"
         end do
         if (opening < len(cell)) unit = adjustl(cell(opening + 1:scan(cell//"]", "])") - 1))
         if (unit /= "") cycle
         ! Of the whole cell, of which a long name holds a part
         i = index(cell, "_", back=.true.)
         do k = 1, size(last_words)
            if (i < 2 .or. to_lower(cell(i + 1:)) /= to_lower(trim(last_words(k)))) cycle
            unit = last_words(k)
            name = to_lower(cell(:i - 1))
         end do
      end do
   end subroutine next_cell

   !> The names and units that a heading has, as a heading; blank where there are none.
   pure subroutine write_heading(table, heading)
      !> The table
      type(table_t), intent(in) :: table
      !> The heading
      character(len=:), allocatable, intent(out) :: heading

      heading = ""
      if (table%names(1) == "") return
      heading = trim(table%names(1))//" ["//trim(table%units(1))//"],"//trim(table%names(2))//" ["//trim(table%units(2))//"]"
   end subroutine write_heading

   !> Read the two numbers of a line.
   subroutine read_row(path, line, number, places, named, row, has_row, mistakes)
      !> Path of the file
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: line
      integer, intent(in) :: number
      !> Places of the two columns, of that with the key, and number of all; 0 where they have no names
      integer, intent(in) :: places(4)
      !> What is wanted where they have names
      type(columns_t), allocatable, intent(in) :: named
      !> Its numbers [unit of the file]
      real(wp), intent(out) :: row(2)
      !> Does the line hold a row that is wanted?
      logical, intent(out) :: has_row
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: words
      ! Number in the column with the key [-], in one of the columns [unit of the file]
      real(wp) :: key, value
      integer :: first, last, length, columns, status, place

      row = 0.0_wp
      has_row = .false.
      length = content_length(line)
      key = 0.0_wp
      if (allocated(named)) key = named%number
      columns = 0
      last = 0
      do
         first = verify(line(last + 1:length), separators) + last
         if (first == last) exit
         last = scan(line(first:length), separators)
         last = merge(length, first + last - 2, last == 0)
         columns = columns + 1
         place = columns
         if (places(4) > 0) place = findloc(places(:3), columns, dim=1)
         if (place == 0 .or. place > merge(3, 2, places(4) > 0)) cycle
         status = 1
         if (is_number(line(first:last)) .and. .not. is_beyond_range(line(first:last))) then
            read (line(first:last), *, iostat=status) value
         end if
         if (status /= 0) then
            call add_mistake(mistakes, "'"//shown(line(first:last))//"' is no finite number", number, first, last - first + 1, &
               & path, line)
            return
         end if
         if (place == 3) key = value
         if (place < 3) row(place) = value
      end do
      if (columns == 0) return
      if (columns == merge(places(4), 2, places(4) > 0)) then
         has_row = .true.
         if (allocated(named)) has_row = nint(key) == named%number
         return
      end if
      words = ""
      if (index(line(:length), ",") > 0) words = on_commas
      if (places(4) > 0) then
         call add_mistake(mistakes, "a row has as many columns as its heading, "//integer_text(places(4))//", not "// &
            & integer_text(columns)//words, number, 0, 0, path, line)
      else
         call add_mistake(mistakes, "a row has two columns, not "//integer_text(columns)//words, number, 0, 0, path, line)
      end if
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
      real(wp) :: intervals(size(table%x) - 1), usual
      integer :: n, widest

      n = size(table%x)
      intervals = table%x(2:) - table%x(:n - 1)
      widest = maxloc(intervals, dim=1)
      usual = median(intervals)
      if (intervals(widest) <= gap_ratio*usual) return
      call add_mistake(mistakes, "the table has a gap from "//number_text(table%x(widest), 10)//" to "// &
         & number_text(table%x(widest + 1), 10)//", more than ten times the usual distance of "//number_text(usual, 3), &
         & table%line(widest + 1), 0, 0, table%path, number_text(table%x(widest + 1))//"  "//number_text(table%y(widest + 1)))
   end subroutine check_spacing

end module camroller_table_file
