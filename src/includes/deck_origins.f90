!> Where the lines of a deck are from: files that include each other, and the file and line of each line of the whole.
!>
!> In: files and their lines. Out: a text that grows by lines with their places, and mistakes told with the file and line that they
!> stand in.
module camroller_deck_origins
   use camroller_mistakes, only : mistakes_t
   use camroller_number_text, only : integer_text
   use camroller_text_lines, only : line_at, text_lines_t
   implicit none
   private

   public :: origins_t, source_file_t, growing_text_t, add_text_line, grown_text, is_above, place_mistakes, say_origin

   !> The deck, or a file that it includes, directly or by others
   type :: source_file_t
      !> Path; blank for the deck
      character(len=:), allocatable :: path
      !> Its lines
      type(text_lines_t) :: lines
      !> Position of the file that includes it, with the line; 0 for the deck
      integer :: parent = 0, parent_line = 0
      !> Groups of it that the including file leaves out, in lower case, with a blank before and after each
      character(len=:), allocatable :: without
   end type source_file_t

   !> Where the lines of a text are from
   type :: origins_t
      !> The deck, then the files that it includes, in order; none where it includes nothing
      type(source_file_t), allocatable :: files(:)
      !> Position of the file and line there, for each line of the text
      integer, allocatable :: places(:, :)
   end type origins_t

   !> Text that grows by lines; the lists have room for more
   type :: growing_text_t
      !> The text and the characters of it in use
      character(len=:), allocatable :: text
      integer :: length = 0
      !> Position of the file and line there, for each line, and the number of lines
      integer, allocatable :: places(:, :)
      integer :: lines = 0
   end type growing_text_t

contains

   !> Add a line to a text.
   pure subroutine add_text_line(growing, line, place)
      !> The text
      type(growing_text_t), intent(inout) :: growing
      !> One more line
      character(len=*), intent(in) :: line
      !> Position of its file and line there
      integer, intent(in) :: place(2)

      integer, allocatable :: more(:, :)
      integer :: needed

      if (.not. allocated(growing%text)) allocate (character(len=4096) :: growing%text)
      if (.not. allocated(growing%places)) allocate (growing%places(2, 128))
      needed = growing%length + len(line) + 1
      if (needed > len(growing%text)) growing%text = growing%text//repeat(" ", needed)
      growing%text(growing%length + 1:needed) = line//new_line("a")
      growing%length = needed
      if (growing%lines == size(growing%places, 2)) then
         allocate (more(2, 2*growing%lines))
         more(:, :growing%lines) = growing%places
         call move_alloc(more, growing%places)
      end if
      growing%lines = growing%lines + 1
      growing%places(:, growing%lines) = place
   end subroutine add_text_line

   !> Hand over a text and the places of its lines.
   pure subroutine grown_text(growing, text, places)
      !> The text
      type(growing_text_t), intent(in) :: growing
      !> The same, and nothing behind it
      character(len=:), allocatable, intent(out) :: text
      !> Position of the file and line there, for each line
      integer, allocatable, intent(out) :: places(:, :)

      text = ""
      allocate (places(2, growing%lines))
      if (growing%lines == 0) return
      text = growing%text(:growing%length)
      places(:, :) = growing%places(:, :growing%lines)
   end subroutine grown_text

   !> Does a file include another one, directly or by others?
   pure function is_above(files, upper, lower) result(verdict)
      !> All files
      type(source_file_t), intent(in) :: files(:)
      !> Positions of both
      integer, intent(in) :: upper, lower
      !> Does it?
      logical :: verdict

      integer :: file

      file = files(lower)%parent
      do while (file > upper)
         file = files(file)%parent
      end do
      verdict = file == upper
   end function is_above

   !> Give mistakes of the whole text their places in the files that its lines are from.
   subroutine place_mistakes(origins, mistakes)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> The mistakes
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i, place(2)

      do i = 1, mistakes%kept
         associate (mistake => mistakes%list(i))
            if (mistake%file /= "" .or. mistake%line == 0 .or. mistake%line > size(origins%places, 2)) cycle
            place = origins%places(:, mistake%line)
            mistake%source = line_at(origins%files(place(1))%lines, place(2))
            mistake%file = origins%files(place(1))%path
            mistake%line = place(2)
         end associate
      end do
   end subroutine place_mistakes

   !> Place of a line of the whole text.
   pure subroutine say_origin(origins, name, line, words)
      !> Where lines are from
      type(origins_t), intent(in) :: origins
      !> Name of the deck
      character(len=*), intent(in) :: name
      !> The line
      integer, intent(in) :: line
      !> As `file:line`
      character(len=:), allocatable, intent(out) :: words

      integer :: place(2)

      words = name//":"//integer_text(line)
      if (line > size(origins%places, 2)) return
      place = origins%places(:, line)
      words = name
      if (place(1) > 1) words = origins%files(place(1))%path
      words = words//":"//integer_text(place(2))
   end subroutine say_origin

end module camroller_deck_origins
