!> Part files: what one process has computed of a sweep, appended record by record while it runs.
!>
!> Layer: io. In: records of finished cases. Out: a file that is complete up to its last whole record whatever ends the process,
!> and an index of which cases stand where. A record is a mark with its kind, its length, a checksum and its words. The first
!> one says what sweep the file belongs to; the others hold layouts and runs of consecutive cases. A record that was torn when
!> the process ended fails its checksum and is cut off before anything is appended. Each file has one writer, by a lock.
module camroller_part_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   use camroller_number_text, only : integer_text
   use camroller_layout, only : layout_t, take_layout
   use camroller_raw_file, only : raw_file_t, open_raw, append_words, read_words, cut_raw, sync_raw, close_raw, word_size
   use camroller_record, only : record_t, checksum, clear_record, put_integer, put_text, take_integer, take_text
   implicit none
   private

   public :: part_t, study_facts_t, entry_t, index_t, kind_cases, kind_layout
   public :: open_part, append_record, sync_part, close_part, scan_part, read_record, part_beginning

   !> Kinds of records
   integer, parameter :: kind_head = 1, kind_layout = 2, kind_cases = 3
   !> What a record begins with, besides its kind: letters that say what it is, in the order of this machine's bytes
   integer(int64), parameter :: mark = int(z'4361725061727400', int64)
   !> Words before the words of a record: mark, length, checksum
   integer, parameter :: head_words = 3
   !> Longest record that is believed [words]
   integer(int64), parameter :: longest_record = 268435456_int64

   !> What a part file must agree on with the sweep
   type :: study_facts_t
      !> Number of cases
      integer :: cases = 0
      !> Every value that matters, one per line, and the build
      character(len=:), allocatable :: deck, build
   end type study_facts_t

   !> A part file being written
   type :: part_t
      type(raw_file_t) :: file
      !> Layouts in it
      integer :: layouts = 0
   end type part_t

   !> A run of consecutive cases in a part file
   type :: entry_t
      !> Where its words start [byte], and how many there are
      integer(int64) :: offset = 0
      integer :: words = 0
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
      !> Layouts of all files, and how many there are
      type(layout_t), allocatable :: layouts(:)
      integer :: layout_count = 0
      !> Files
      integer :: parts = 0
   end type index_t

contains

   !> What the paths of the part files of a result begin with.
   pure function part_beginning(path) result(beginning)
      !> Path of the result
      character(len=*), intent(in) :: path
      !> Beginning of the paths
      character(len=:), allocatable :: beginning

      beginning = path//".part-"
   end function part_beginning

   !> Open a part file to append to: a new one, or one that is there up to its last whole record.
   subroutine open_part(part, path, facts, error)
      !> The part file
      type(part_t), intent(out) :: part
      !> Its path
      character(len=*), intent(in) :: path
      !> The sweep it belongs to
      type(study_facts_t), intent(in) :: facts
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(record_t) :: record
      integer(int64) :: good

      call open_raw(part%file, path, .true., error)
      if (allocated(error)) return
      good = 0
      if (part%file%bytes > 0) call scan_file(part%file, facts, index, good, error)
      if (.not. allocated(error) .and. good < part%file%bytes) call cut_raw(part%file, good, error)
      if (.not. allocated(error) .and. good == 0) then
         call clear_record(record)
         call put_integer(record, facts%cases)
         call put_text(record, facts%deck)
         call put_text(record, facts%build)
         call append_record(part, kind_head, record, error)
      end if
      part%layouts = index%layout_count
      if (allocated(error)) call close_raw(part%file)
   end subroutine open_part

   !> Append a record.
   subroutine append_record(part, kind, record, error)
      !> The part file
      type(part_t), intent(inout) :: part
      !> Kind of the record
      integer, intent(in) :: kind
      !> The record
      type(record_t), intent(in) :: record
      !> File error; the file is then as it was before
      type(error_t), allocatable, intent(out) :: error

      integer(int64), allocatable :: words(:)

      allocate (words(head_words + record%length))
      words(1) = mark + kind
      words(2) = record%length
      words(head_words + 1:) = record%words(:record%length)
      words(3) = checksum(words(head_words + 1:), words(1) + words(2))
      call append_words(part%file, words, error)
      if (kind == kind_layout .and. .not. allocated(error)) part%layouts = part%layouts + 1
   end subroutine append_record

   !> Have the device keep what was appended.
   subroutine sync_part(part, error)
      !> The part file
      type(part_t), intent(in) :: part
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call sync_raw(part%file, error)
   end subroutine sync_part

   !> Close a part file.
   subroutine close_part(part)
      !> The part file
      type(part_t), intent(inout) :: part

      call close_raw(part%file)
   end subroutine close_part

   !> Add what a part file holds to an index.
   subroutine scan_part(path, facts, index, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The sweep it must belong to
      type(study_facts_t), intent(in) :: facts
      !> The index
      type(index_t), intent(inout) :: index
      !> File error; also where the file belongs to another sweep
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: file
      integer(int64) :: good

      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      call scan_file(file, facts, index, good, error)
      call close_raw(file)
   end subroutine scan_part

   !> Read records up to the last whole one.
   subroutine scan_file(file, facts, index, good, error)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> The sweep it must belong to
      type(study_facts_t), intent(in) :: facts
      !> The index to add to
      type(index_t), intent(inout) :: index
      !> Where the last whole record ends [byte]
      integer(int64), intent(out) :: good
      !> File error where the file belongs to another sweep
      type(error_t), allocatable, intent(out) :: error

      type(record_t) :: record
      integer :: kind, before
      logical :: is_whole

      if (.not. allocated(index%entries)) allocate (index%entries(64), index%layouts(4))
      index%parts = index%parts + 1
      before = index%layout_count
      good = 0
      do
         call read_next(file, good, record, kind, is_whole)
         if (.not. is_whole) exit
         if (good == 0 .or. kind == kind_head) then
            call check_head(file%path, record, kind, facts, error)
            if (allocated(error)) return
         else if (kind == kind_layout) then
            call add_layout(index, record)
         else
            call add_entry(index, record, good + head_words*word_size, before)
         end if
         good = good + (head_words + record%length)*word_size
      end do
   end subroutine scan_file

   !> Read the record at a place.
   subroutine read_next(file, offset, record, kind, is_whole)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Where it starts [byte]
      integer(int64), intent(in) :: offset
      !> The record
      type(record_t), intent(inout) :: record
      !> Its kind
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
      !> Its kind
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
            & "; put the deck back, or remove the part files to start anew")
      else if (build /= facts%build) then
         call raise(error, kind_file, "'"//path//"' was begun by another build of camroller: "// &
            & difference(build, facts%build)//"; continue with that one, or remove the part files to start anew")
      end if
   end subroutine check_head

   !> First lines in which two texts differ.
   pure function difference(old, new) result(words)
      !> Two texts
      character(len=*), intent(in) :: old, new
      !> Both lines
      character(len=:), allocatable :: words

      integer :: i, first

      first = 1
      do i = 1, min(len(old), len(new))
         if (old(i:i) /= new(i:i)) exit
         if (old(i:i) == new_line("a")) first = i + 1
      end do
      words = "'"//line_at(old, first)//"' is now '"//line_at(new, first)//"'"
   end function difference

   !> The line that begins at a place.
   pure function line_at(text, first) result(line)
      !> The text
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
   subroutine add_layout(index, record)
      !> The index
      type(index_t), intent(inout) :: index
      !> The record
      type(record_t), intent(inout) :: record

      type(layout_t), allocatable :: longer(:)

      if (index%layout_count == size(index%layouts)) then
         allocate (longer(2*size(index%layouts)))
         longer(:index%layout_count) = index%layouts
         call move_alloc(longer, index%layouts)
      end if
      index%layout_count = index%layout_count + 1
      call take_layout(record, index%layouts(index%layout_count))
   end subroutine add_layout

   !> Take a run of cases into an index.
   subroutine add_entry(index, record, offset, layouts_before)
      !> The index
      type(index_t), intent(inout) :: index
      !> The record
      type(record_t), intent(inout) :: record
      !> Where its words start [byte]
      integer(int64), intent(in) :: offset
      !> Layouts of the files before
      integer, intent(in) :: layouts_before

      type(entry_t), allocatable :: longer(:)
      type(entry_t) :: entry

      call take_integer(record, entry%first)
      call take_integer(record, entry%count)
      call take_integer(record, entry%layout)
      if (entry%layout > 0) entry%layout = entry%layout + layouts_before
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

   !> Read a record that an index names.
   subroutine read_record(file, entry, record, error)
      !> The part file, open
      type(raw_file_t), intent(in) :: file
      !> Where the record is
      type(entry_t), intent(in) :: entry
      !> The record
      type(record_t), intent(inout) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_complete

      call clear_record(record)
      if (size(record%words) < entry%words) then
         deallocate (record%words)
         allocate (record%words(entry%words))
      end if
      call read_words(file, entry%offset, record%words(:entry%words), is_complete)
      record%length = entry%words
      if (.not. is_complete) call raise(error, kind_file, "cannot read case "//integer_text(entry%first - 1)//" from '"// &
         & file%path//"'")
   end subroutine read_record

end module camroller_part_file
