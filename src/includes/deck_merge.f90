!> Groups that stand in several files of a deck made one: a file's own keys replace those of the files that it includes.
!>
!> In: the text of a deck with the lines of all its files, and where each is from. Out: a deck by itself, in which each group stands
!> once, where the file does that includes the others that have it. Keys there begin with those of the included files.
!> A key given by two files of which none includes the other is a mistake, unless a file that includes both gives it too.
module camroller_deck_merge
   use camroller_deck_origins, only : origins_t, source_file_t, growing_text_t, add_text_line, grown_text, is_above
   use camroller_deck_text, only : deck_text_t, read_shape, to_lower
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_text_lines, only : line_at, split_lines, text_lines_t
   implicit none
   private

   public :: merge_files

   !> A group in a file
   type :: part_t
      !> Position of the file, and of the group in it
      integer :: file = 0, group = 0
      !> Position of the part that takes it up; its own where it stays in its place
      integer :: home = 0
      !> Does a file that includes its file leave it out?
      logical :: is_out = .false.
   end type part_t

   !> What is done with the lines of a text
   type :: plan_t
      !> Lines as they are, and as they come to be: blanks stand for what is replaced or stands elsewhere
      type(text_lines_t) :: given, kept
      !> Groups and keys of each file; lines are those of the text
      type(deck_text_t), allocatable :: shapes(:)
      !> All groups
      type(part_t), allocatable :: parts(:)
   end type plan_t

contains

   !> Make groups that stand in several files one.
   subroutine merge_files(text, origins, mistakes)
      !> Text with all lines of all files; then a deck by itself
      character(len=:), allocatable, intent(inout) :: text
      !> Where its lines are from
      type(origins_t), intent(inout) :: origins
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(plan_t) :: plan
      type(mistakes_t) :: shape_mistakes
      integer :: before, i

      before = mistakes%count
      call split_lines(text, plan%given)
      call read_files(origins, plan, shape_mistakes)
      call leave_out(origins, plan, mistakes)
      call find_homes(plan)
      if (mistakes%count > before .or. all(plan%parts%home == [(i, i=1, size(plan%parts))] .and. .not. plan%parts%is_out)) return
      if (shape_mistakes%count > 0) then
         mistakes = shape_mistakes
         return
      end if
      plan%kept = plan%given
      call replace_keys(origins%files, plan)
      call complain_of_equals(origins%files, plan, mistakes)
      if (mistakes%count == before) call put_together(plan, text, origins)
   end subroutine merge_files

   !> Find the groups and keys of each file.
   subroutine read_files(origins, plan, mistakes)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> The plan; it gets the shapes and the groups
      type(plan_t), intent(inout) :: plan
      !> Mistakes in the shape of the files
      type(mistakes_t), intent(out) :: mistakes

      type(growing_text_t) :: growing
      type(mistakes_t) :: found
      character(len=:), allocatable :: text
      integer, allocatable :: lines(:, :)
      integer :: file, i

      allocate (plan%shapes(size(origins%files)), plan%parts(0))
      do file = 1, size(origins%files)
         growing = growing_text_t()
         do i = 1, plan%given%count
            if (origins%places(1, i) == file) call add_text_line(growing, line_at(plan%given, i), [i, 0])
         end do
         call grown_text(growing, text, lines)
         associate (shape => plan%shapes(file))
            call read_shape(text, shape, found)
            do i = 1, found%kept
               call add_mistake(mistakes, found%list(i)%message, lines(1, found%list(i)%line), found%list(i)%column, &
                  & found%list(i)%width)
            end do
            found = mistakes_t()
            do i = 1, size(shape%groups)
               shape%groups(i)%line = lines(1, shape%groups(i)%line)
               if (shape%groups(i)%last_line > 0) shape%groups(i)%last_line = lines(1, shape%groups(i)%last_line)
               plan%parts = [plan%parts, part_t(file, i, size(plan%parts) + 1)]
            end do
            do i = 1, size(shape%assignments)
               shape%assignments(i)%line = lines(1, shape%assignments(i)%line)
            end do
         end associate
      end do
   end subroutine read_files

   !> Leave groups out that the lines with `include` name.
   subroutine leave_out(origins, plan, mistakes)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      type(plan_t), intent(inout) :: plan
      !> Mistakes so far: a group that is not there
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: rest, name, line, words
      logical :: is_there
      integer :: file, i

      do file = 2, size(origins%files)
         rest = trim(adjustl(origins%files(file)%without))
         do while (rest /= "")
            name = rest(:index(rest//" ", " ") - 1)
            rest = trim(adjustl(rest(len(name) + 1:)))
            is_there = .false.
            do i = 1, size(plan%parts)
               associate (part => plan%parts(i))
                  if (plan%shapes(part%file)%groups(part%group)%name /= name) cycle
                  if (part%file /= file .and. .not. is_above(origins%files, file, part%file)) cycle
                  part%is_out = .true.
                  is_there = .true.
               end associate
            end do
            if (is_there) cycle
            line = line_at(origins%files(origins%files(file)%parent)%lines, origins%places(2, origins%files(file)%parent_line))
            call name_groups(origins%files, plan, file, words)
            call add_mistake(mistakes, "'"//origins%files(file)%path//"' has no group &"//shown(name)//"; it has "//words, &
               & origins%files(file)%parent_line, index(to_lower(line), name, back=.true.), len(name))
         end do
      end do
   end subroutine leave_out

   !> Name the groups of a file and of those that it includes.
   pure subroutine name_groups(files, plan, file, words)
      !> All files
      type(source_file_t), intent(in) :: files(:)
      type(plan_t), intent(in) :: plan
      !> Position of the file
      integer, intent(in) :: file
      !> The names
      character(len=:), allocatable, intent(out) :: words

      integer :: i

      words = ""
      do i = 1, size(plan%parts)
         if (plan%parts(i)%file /= file .and. .not. is_above(files, file, plan%parts(i)%file)) cycle
         if (words /= "") words = words//", "
         words = words//"&"//plan%shapes(plan%parts(i)%file)%groups(plan%parts(i)%group)%name
      end do
      if (words == "") words = "none"
   end subroutine name_groups

   !> Find where each group comes to stand: where the first file has it; a file stands before those that it includes.
   pure subroutine find_homes(plan)
      type(plan_t), intent(inout) :: plan

      integer :: i, k

      do i = 2, size(plan%parts)
         if (plan%parts(i)%is_out) cycle
         do k = 1, i - 1
            if (plan%parts(k)%is_out) cycle
            if (plan%shapes(plan%parts(k)%file)%groups(plan%parts(k)%group)%name /= &
               & plan%shapes(plan%parts(i)%file)%groups(plan%parts(i)%group)%name) cycle
            plan%parts(i)%home = k
            exit
         end do
      end do
   end subroutine find_homes

   !> Blank the keys of included files that a file gives which includes them. They have no name after that.
   pure subroutine replace_keys(files, plan)
      !> All files
      type(source_file_t), intent(in) :: files(:)
      type(plan_t), intent(inout) :: plan

      integer :: upper, lower, i

      do lower = 2, size(plan%parts)
         if (plan%parts(lower)%is_out) cycle
         do upper = 1, lower - 1
            if (plan%parts(upper)%is_out .or. plan%parts(upper)%home /= plan%parts(lower)%home) cycle
            if (.not. is_above(files, plan%parts(upper)%file, plan%parts(lower)%file)) cycle
            associate (shape => plan%shapes(plan%parts(lower)%file))
               do i = 1, size(shape%assignments)
                  if (shape%assignments(i)%group /= plan%parts(lower)%group .or. shape%assignments(i)%key == "") cycle
                  if (.not. has_key(plan, upper, shape%assignments(i)%key)) cycle
                  call blank_key(shape, i, plan%kept)
                  shape%assignments(i)%key = ""
               end do
            end associate
         end do
      end do
   end subroutine replace_keys

   !> Has a group a key?
   pure function has_key(plan, part, key) result(verdict)
      type(plan_t), intent(in) :: plan
      !> Position of the group
      integer, intent(in) :: part
      character(len=*), intent(in) :: key
      !> Has it?
      logical :: verdict

      character(len=len(key)) :: lower_key
      integer :: i

      verdict = .false.
      lower_key = to_lower(key)
      associate (shape => plan%shapes(plan%parts(part)%file))
         do i = 1, size(shape%assignments)
            if (shape%assignments(i)%group /= plan%parts(part)%group .or. len(shape%assignments(i)%key) /= len(key)) cycle
            verdict = to_lower(shape%assignments(i)%key) == lower_key
            if (verdict) return
         end do
      end associate
   end function has_key

   !> Tell of keys that two files give of which none includes the other.
   subroutine complain_of_equals(files, plan, mistakes)
      !> All files
      type(source_file_t), intent(in) :: files(:)
      type(plan_t), intent(in) :: plan
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: first, second, i

      do second = 2, size(plan%parts)
         if (plan%parts(second)%is_out) cycle
         do first = 1, second - 1
            if (plan%parts(first)%is_out .or. plan%parts(first)%home /= plan%parts(second)%home) cycle
            if (is_above(files, plan%parts(first)%file, plan%parts(second)%file)) cycle
            associate (shape => plan%shapes(plan%parts(second)%file))
               do i = 1, size(shape%assignments)
                  if (shape%assignments(i)%group /= plan%parts(second)%group .or. shape%assignments(i)%key == "") cycle
                  if (.not. has_key(plan, first, shape%assignments(i)%key)) cycle
                  call add_mistake(mistakes, "key '"//shown(shape%assignments(i)%key)//"' of &"// &
                     & shown(shape%groups(plan%parts(second)%group)%name)//" is in '"//files(plan%parts(first)%file)%path// &
                     & "' too, and neither file includes the other; give it in the file that includes both, or include one of "// &
                     & "them without the group", shape%assignments(i)%line, shape%assignments(i)%column, &
                     & len(shape%assignments(i)%key))
               end do
            end associate
         end do
      end do
   end subroutine complain_of_equals

   !> Blank a key with its value, and comments behind them.
   pure subroutine blank_key(shape, position, kept)
      !> Groups and keys of its file
      type(deck_text_t), intent(in) :: shape
      !> Position of the key
      integer, intent(in) :: position
      type(text_lines_t), intent(inout) :: kept

      character(len=:), allocatable :: line
      integer :: i, first, last, last_line, behind

      associate (key => shape%assignments(position), group => shape%groups(shape%assignments(position)%group))
         last_line = group%last_line
         behind = group%last_column
         if (position < size(shape%assignments)) then
            if (shape%assignments(position + 1)%group == key%group) then
               last_line = shape%assignments(position + 1)%line
               behind = shape%assignments(position + 1)%column
            end if
         end if
         do i = key%line, last_line
            line = line_at(kept, i)
            first = merge(key%column, 1, i == key%line)
            last = merge(behind - 1, len(line), i == last_line)
            ! A comment that has its lines for itself is no part of the key
            if (scan(adjustl(line(first:last)), "!") == 1) cycle
            call blank_columns(kept, i, first, last)
         end do
      end associate
   end subroutine blank_key

   !> Blank some columns of a line.
   pure subroutine blank_columns(lines, number, first, last)
      type(text_lines_t), intent(inout) :: lines
      !> Number of the line
      integer, intent(in) :: number
      !> First and last column
      integer, intent(in) :: first, last

      if (last < first) return
      lines%text(lines%first(number) + first - 1:lines%first(number) + last - 1) = " "
   end subroutine blank_columns

   !> Take what a group holds out of its place.
   pure subroutine take_out(group, kept, body)
      !> Lines and columns of its beginning and its end, and the columns of its beginning
      integer, intent(in) :: group(5)
      !> Lines; blanks come to stand for the group
      type(text_lines_t), intent(inout) :: kept
      !> What it holds is added here, with the number of its line in the place of that of a file
      type(growing_text_t), intent(inout) :: body

      character(len=:), allocatable :: line
      integer :: i, first, last

      do i = group(1), group(3)
         line = line_at(kept, i)
         first = merge(group(2), 1, i == group(1))
         last = merge(group(4), len(line), i == group(3))
         call blank_columns(kept, i, first, last)
         if (i == group(3)) line = line(:group(4) - 1)
         if (i == group(1)) line(:group(2) + group(5) - 1) = " "
         if (line /= "") call add_text_line(body, line, [i, 0])
      end do
   end subroutine take_out

   !> Write the text with each group in one place.
   subroutine put_together(plan, text, origins)
      type(plan_t), intent(inout) :: plan
      character(len=:), allocatable, intent(inout) :: text
      !> Where its lines are from
      type(origins_t), intent(inout) :: origins

      type(growing_text_t) :: whole
      type(growing_text_t), allocatable :: bodies(:)
      character(len=:), allocatable :: line
      integer :: i, k, column

      allocate (bodies(size(plan%parts)))
      do i = 1, size(plan%parts)
         associate (group => plan%shapes(plan%parts(i)%file)%groups(plan%parts(i)%group), part => plan%parts(i))
            if (part%home == i .and. .not. part%is_out) cycle
            call take_out([group%line, group%column, group%last_line, group%last_column, len(group%name) + 1], plan%kept, &
               & bodies(part%home))
            if (part%is_out) bodies(i)%lines = 0
         end associate
      end do
      do i = 1, plan%given%count
         line = line_at(plan%kept, i)
         if (line == "" .and. line_at(plan%given, i) /= "") cycle
         do k = 1, size(bodies)
            if (bodies(k)%lines == 0) cycle
            associate (group => plan%shapes(plan%parts(k)%file)%groups(plan%parts(k)%group))
               if (group%line /= i) cycle
               column = group%column + len(group%name)
               call add_text_line(whole, line(:column), origins%places(:, i))
               call add_body(bodies(k))
               line(:column) = " "
            end associate
         end do
         if (line /= "" .or. line_at(plan%given, i) == "") call add_text_line(whole, line, origins%places(:, i))
      end do
      call grown_text(whole, text, origins%places)

   contains

      !> Add what a group holds elsewhere.
      subroutine add_body(body)
         !> Its lines
         type(growing_text_t), intent(in) :: body

         character(len=:), allocatable :: words
         integer, allocatable :: numbers(:, :)
         type(text_lines_t) :: lines
         integer :: j

         call grown_text(body, words, numbers)
         call split_lines(words, lines)
         do j = 1, lines%count
            call add_text_line(whole, line_at(lines, j), origins%places(:, numbers(1, j)))
         end do
      end subroutine add_body

   end subroutine put_together

end module camroller_deck_merge
