!> Index of the part files of a sweep: which runs of cases stand where, which layouts they have, what is damaged.
!>
!> In: part files, as `camroller_part_file` writes them. Out: an index of their records. A record is a mark with its
!> kind, its length, a checksum and its words. The first one says what sweep the file belongs to; the others hold layouts and runs
!> of consecutive cases. Where there is no whole record, reading goes on at the next one, and the index says what is left out.
module camroller_part_scan
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file
   use camroller_number_text, only : number_text
   use camroller_layout, only : layout_list_t, layout_t, set_layout_at, take_layout
   use camroller_text_lines, only : add_line, line_t
   use camroller_raw_file, only : raw_file_t, read_words, word_size
   use camroller_record, only : record_t, checksum, clear_record, take_integer, take_text
   implicit none
   private

   public :: study_facts_t, entry_t, index_t, kind_head, kind_layout, kind_cases, mark, head_words, longest_record
   public :: scan_file, difference

   !> Kinds of records
   integer, parameter :: kind_head = 1, kind_layout = 2, kind_cases = 3
   !> What a record begins with, besides its kind: letters that say what it is, in the order of this machine's bytes
   integer(int64), parameter :: mark = int(z'4361725061727400', int64)
   !> Words before the words of a record: mark, length, checksum
   integer, parameter :: head_words = 3
   !> Longest record that is written and believed [words]
   integer(int64), parameter :: longest_record = 268435456_int64
   !> Words in which marks are looked for at a time
   integer(int64), parameter :: searched_words = 8192_int64
   !> What messages call a kilobyte [byte]
   real(wp), parameter :: kilobyte = 1.0e3_wp

   !> What a part file must agree on with the sweep
   type :: study_facts_t
      !> Number of cases
      integer :: cases = 0
      !> Every value that matters, one per line, and the build
      character(len=:), allocatable :: deck, build
   end type study_facts_t

   !> A run of consecutive cases in a part file
   type :: entry_t
      !> Where its words start [byte], and how many there are
      integer(int64) :: offset = 0, words = 0
      !> First case, from 1, and number of cases
      integer :: first = 0, count = 0
      !> Its layout among those of the index, 0 where no case of it has a result
      integer :: layout = 0
      !> Its part file among those of the index
      integer :: part = 0
   end type entry_t

   !> What is in part files
   type :: index_t
      !> Runs of cases, and how many there are
      type(entry_t), allocatable :: entries(:)
      integer :: count = 0
      !> Layouts of all files
      type(layout_list_t) :: layouts
      !> Files
      integer :: parts = 0
      !> What of them is damaged, one line each
      type(line_t), allocatable :: damages(:)
   end type index_t

contains

   !> Read every whole record.
   subroutine scan_file(file, facts, index, good, error)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> The sweep it must belong to
      type(study_facts_t), intent(in) :: facts
      !> The index to add to
      type(index_t), intent(inout) :: index
      !> Where the last whole record ends [byte]
      integer(int64), intent(out) :: good
      !> File error where the file belongs to another sweep, or to none
      type(error_t), allocatable, intent(out) :: error

      type(record_t) :: record
      integer(int64) :: place, next, lost
      integer :: kind, before
      logical :: is_whole

      if (.not. allocated(index%entries)) allocate (index%entries(64), index%damages(0))
      index%parts = index%parts + 1
      before = index%layouts%count
      good = 0
      place = 0
      lost = 0
      do
         call read_next(file, place, record, kind, is_whole)
         if (is_whole) then
            if (place == 0 .or. kind == kind_head) then
               call check_head(file%path, record, kind, facts, error)
               if (allocated(error)) return
            else if (kind == kind_layout) then
               call add_layout(index, record, before)
            else
               call add_entry(index, file%path, record, place + head_words*word_size, before, facts%cases)
            end if
            place = place + (head_words + record%length)*word_size
            good = place
         else
            call find_record(file, place, next)
            if (place == 0) call check_beginning(file, next, error)
            if (allocated(error)) return
            lost = lost + next - place
            if (next >= file%bytes) exit
            place = next
         end if
      end do
      if (lost > 0 .and. good > 0) call add_damage(index, "'"//file%path//"' is damaged: "// &
         & number_text(real(lost, wp)/kilobyte, 3)//" of its "//number_text(real(file%bytes, wp)/kilobyte, 3)// &
         & " kB hold no whole record")
   end subroutine scan_file

   !> Where the next whole record begins.
   subroutine find_record(file, place, next)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Where there is none [byte]
      integer(int64), intent(in) :: place
      !> Where the next one begins, or the end of the file [byte]
      integer(int64), intent(out) :: next

      integer(int64) :: words(searched_words), first
      type(record_t) :: record
      integer(int64) :: i, count
      integer :: kind
      logical :: is_whole

      first = place + word_size
      do while (first + head_words*word_size <= file%bytes)
         count = min(searched_words, (file%bytes - first)/word_size)
         call read_words(file, first, words(:count), is_whole)
         if (.not. is_whole) exit
         do i = 1, count
            if (words(i) <= mark .or. words(i) > mark + kind_cases) cycle
            next = first + (i - 1)*word_size
            call read_next(file, next, record, kind, is_whole)
            if (is_whole) return
         end do
         first = first + count*word_size
      end do
      next = file%bytes
   end subroutine find_record

   !> A file that does not begin with a whole record: one whose first record was torn, which holds nothing, or an error.
   subroutine check_beginning(file, next, error)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Where the first whole record begins, or the end of the file [byte]
      integer(int64), intent(in) :: next
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: word(1)
      logical :: is_there

      if (next < file%bytes) then
         call raise(error, kind_file, "'"//file%path//"' is damaged at its beginning, which says what sweep it belongs to; "// &
            & "remove it to have its cases computed again")
         return
      end if
      if (file%bytes == 0) return
      call read_words(file, 0_int64, word, is_there)
      if (is_there .and. word(1) == mark + kind_head) return
      call raise(error, kind_file, "'"//file%path//"' is not a part file of a sweep; give it another name")
   end subroutine check_beginning

   !> Take note of damage, once where several records of a file have the same.
   subroutine add_damage(index, words)
      type(index_t), intent(inout) :: index
      !> What is damaged
      character(len=*), intent(in) :: words

      integer :: i

      do i = 1, size(index%damages)
         if (index%damages(i)%text == words) return
      end do
      call add_line(index%damages, words)
   end subroutine add_damage

   !> Read the record at a place.
   subroutine read_next(file, offset, record, kind, is_whole)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Where it starts [byte]
      integer(int64), intent(in) :: offset
      type(record_t), intent(inout) :: record
      integer, intent(out) :: kind
      !> Is there a whole record?
      logical, intent(out) :: is_whole

      integer(int64) :: head(head_words)

      kind = 0
      call clear_record(record)
      call read_words(file, offset, head, is_whole)
      if (.not. is_whole) return
      is_whole = head(1) > mark .and. head(1) <= mark + kind_cases .and. head(2) >= 0 .and. head(2) <= longest_record
      if (is_whole) is_whole = offset + (head_words + head(2))*word_size <= file%bytes
      if (.not. is_whole) return
      kind = int(head(1) - mark)
      if (size(record%words) < head(2)) then
         deallocate (record%words)
         allocate (record%words(head(2)))
      end if
      call read_words(file, offset + head_words*word_size, record%words(:head(2)), is_whole)
      if (is_whole) is_whole = checksum(record%words(:head(2)), head(1) + head(2)) == head(3)
      record%length = int(head(2))
   end subroutine read_next

   !> Does a file belong to a sweep?
   subroutine check_head(path, record, kind, facts, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> First record of the file
      type(record_t), intent(inout) :: record
      integer, intent(in) :: kind
      !> The sweep
      type(study_facts_t), intent(in) :: facts
      !> File error where it belongs to another one
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: deck, build
      integer :: cases

      if (kind /= kind_head) then
         call raise(error, kind_file, "'"//path//"' is no part of a sweep")
         return
      end if
      call take_integer(record, cases)
      call take_text(record, deck)
      call take_text(record, build)
      if (deck /= facts%deck .or. cases /= facts%cases) then
         call raise(error, kind_file, "the deck has changed since '"//path//"' was begun: "//difference(deck, facts%deck)// &
            & "; put the deck back, or remove the part files to start again")
      else if (build /= facts%build) then
         call raise(error, kind_file, "'"//path//"' was begun by another build of camroller: "// &
            & difference(build, facts%build)//"; continue with that one, or remove the part files to start again")
      end if
   end subroutine check_head

   !> First lines in which two texts differ, in words: a line has another text, is new or is gone.
   pure function difference(old, new) result(words)
      !> Two texts of lines, each of which stands once
      character(len=*), intent(in) :: old, new
      !> What differs
      character(len=:), allocatable :: words

      character(len=:), allocatable :: before, after
      integer :: i, first

      first = 1
      do i = 1, min(len(old), len(new))
         if (old(i:i) /= new(i:i)) exit
         if (old(i:i) == new_line("a")) first = i + 1
      end do
      before = line_at(old, first)
      after = line_at(new, first)
      if (before == "" .or. holds_line(new, before)) then
         words = shown(after)//" is new"
      else if (after == "" .or. holds_line(old, after)) then
         words = shown(before)//" is gone"
      else
         words = shown(before)//" is now "//shown(after)
      end if
   end function difference

   !> Does a text hold a line?
   pure function holds_line(text, line) result(verdict)
      character(len=*), intent(in) :: text, line
      !> Does it?
      logical :: verdict

      verdict = index(new_line("a")//text//new_line("a"), new_line("a")//line//new_line("a")) > 0
   end function holds_line

   !> A line as messages show it: in quotes, unless it has some itself.
   pure function shown(line) result(words)
      character(len=*), intent(in) :: line
      !> The line
      character(len=:), allocatable :: words

      words = line
      if (index(line, "'") == 0) words = "'"//line//"'"
   end function shown

   !> The line that begins at a place.
   pure function line_at(text, first) result(line)
      character(len=*), intent(in) :: text
      !> Where the line begins
      integer, intent(in) :: first
      !> The line
      character(len=:), allocatable :: line

      integer :: length

      line = ""
      if (first > len(text)) return
      length = index(text(first:), new_line("a")) - 1
      if (length < 0) length = len(text) - first + 1
      line = text(first:first + length - 1)
   end function line_at

   !> Take a layout into an index.
   subroutine add_layout(index, record, layouts_before)
      type(index_t), intent(inout) :: index
      type(record_t), intent(inout) :: record
      !> Layouts of the files before
      integer, intent(in) :: layouts_before

      type(layout_t) :: layout
      integer :: number

      call take_integer(record, number)
      call take_layout(record, layout)
      call set_layout_at(index%layouts, layouts_before + number, layout)
   end subroutine add_layout

   !> Take a run of cases into an index.
   subroutine add_entry(index, path, record, offset, layouts_before, cases)
      type(index_t), intent(inout) :: index
      !> Path of the file
      character(len=*), intent(in) :: path
      type(record_t), intent(inout) :: record
      !> Where its words start [byte]
      integer(int64), intent(in) :: offset
      !> Layouts of the files before
      integer, intent(in) :: layouts_before
      !> Cases of the sweep
      integer, intent(in) :: cases

      type(entry_t), allocatable :: longer(:)
      type(entry_t) :: entry
      logical :: is_readable

      call take_integer(record, entry%first)
      call take_integer(record, entry%count)
      call take_integer(record, entry%layout)
      is_readable = entry%first >= 1 .and. entry%count >= 1 .and. entry%count <= cases - entry%first + 1 .and. entry%layout >= 0
      if (is_readable .and. entry%layout > 0) then
         entry%layout = entry%layout + layouts_before
         is_readable = has_layout(index%layouts, entry%layout)
         ! a number that is in use must not be given again
         if (.not. is_readable) call set_layout_at(index%layouts, entry%layout, layout_t())
      end if
      if (.not. is_readable) then
         call add_damage(index, "'"//path//"' is damaged: what it says of the quantities of some of its cases is lost")
         return
      end if
      entry%offset = offset
      entry%words = record%length
      entry%part = index%parts
      if (index%count == size(index%entries)) then
         allocate (longer(2*size(index%entries)))
         longer(:index%count) = index%entries
         call move_alloc(longer, index%entries)
      end if
      index%count = index%count + 1
      index%entries(index%count) = entry
   end subroutine add_entry

   !> Is there a layout under a number?
   pure function has_layout(list, number) result(verdict)
      type(layout_list_t), intent(in) :: list
      !> The number, from 1
      integer, intent(in) :: number
      !> Is there?
      logical :: verdict

      verdict = number <= list%count
      if (verdict) verdict = allocated(list%items(number)%summary)
   end function has_layout

end module camroller_part_scan
