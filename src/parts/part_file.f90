!> Part files: what one process has computed of a sweep, appended record by record while it runs.
!>
!> In: records of finished cases. Out: a file that is complete up to its last whole record whatever ends the process;
!> `camroller_part_scan` says what is in it. A record that was torn when the process ended fails its checksum and is cut off
!> before anything is appended. Each file has one writer, by a lock. A file is taken for a part by the mark at its beginning; by
!> its name only where that is the very name of a part, and then it must be one.
module camroller_part_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   use camroller_number_text, only : integer_text
   use camroller_layout, only : layout_t, put_layout
   use camroller_text_lines, only : line_t
   use camroller_part_scan, only : entry_t, head_words, index_t, kind_head, kind_layout, longest_record, mark, &
      & scan_file, study_facts_t
   use camroller_raw_file, only : raw_file_t, open_raw, append_words, read_words, cut_raw, find_files, is_locked, sync_raw, &
      & close_raw, word_size
   use camroller_record, only : record_t, checksum, clear_record, put_integer, put_text
   implicit none
   private

   public :: part_t, open_part, append_layout, append_record, sync_part, close_part, scan_part, read_record
   public :: part_beginning, part_name, find_parts, is_being_written

   !> Bytes that messages call a megabyte
   integer(int64), parameter :: megabyte = 1000000_int64

   !> A part file being written
   type :: part_t
      type(raw_file_t) :: file
      !> Largest number of a layout in it
      integer :: layouts = 0
   end type part_t

contains

   !> What the paths of the part files of a result begin with.
   pure function part_beginning(path) result(beginning)
      !> Path of the result
      character(len=*), intent(in) :: path
      !> Beginning of the paths
      character(len=:), allocatable :: beginning

      beginning = path//".part-"
   end function part_beginning

   !> Path of the part file of a process.
   pure function part_name(path, shard, shards, rank) result(name)
      !> Path of the result
      character(len=*), intent(in) :: path
      !> The shard, from 1, and the number of shards
      integer, intent(in) :: shard, shards
      !> The process, from 0; without it, what the paths of all processes of the shard begin with
      integer, intent(in), optional :: rank
      !> Path of the part file
      character(len=:), allocatable :: name

      name = part_beginning(path)
      if (shards > 1) name = name//"shard-"//integer_text(shard)//"-of-"//integer_text(shards)//"-"
      if (present(rank)) name = name//"rank-"//integer_text(rank)
   end function part_name

   !> Part files of a result, sorted.
   subroutine find_parts(path, beginning, paths)
      !> Path of the result
      character(len=*), intent(in) :: path
      !> What their paths begin with
      character(len=*), intent(in) :: beginning
      !> Their paths
      type(line_t), allocatable, intent(out) :: paths(:)

      type(line_t), allocatable :: found(:)
      logical, allocatable :: are_parts(:)
      integer :: i

      call find_files(beginning, found)
      allocate (are_parts(size(found)))
      do i = 1, size(found)
         are_parts(i) = is_part(found(i)%text, found(i)%text(len(part_beginning(path)) + 1:))
      end do
      paths = pack(found, are_parts)
   end subroutine find_parts

   !> Is a file a part, by its first word or by its whole name?
   function is_part(path, name) result(verdict)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its name behind what all parts begin with
      character(len=*), intent(in) :: name
      !> Is it?
      logical :: verdict

      type(raw_file_t) :: file
      type(error_t), allocatable :: error
      character(len=:), allocatable :: letters
      integer(int64) :: word(1)
      integer :: i

      letters = ""
      do i = 1, len(name)
         if (index("0123456789", name(i:i)) == 0) letters = letters//name(i:i)
      end do
      verdict = letters == "rank-" .or. letters == "shard--of--rank-"
      if (verdict) return
      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      call read_words(file, 0_int64, word, verdict)
      verdict = verdict .and. word(1) == mark + kind_head
      call close_raw(file)
   end function is_part

   !> Does another process write a part file?
   function is_being_written(path) result(verdict)
      !> Its path
      character(len=*), intent(in) :: path
      !> Does it?
      logical :: verdict

      type(raw_file_t) :: file
      type(error_t), allocatable :: error

      verdict = .false.
      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      verdict = is_locked(file)
      call close_raw(file)
   end function is_being_written

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
      part%layouts = index%layouts%count
      if (allocated(error)) call close_raw(part%file)
   end subroutine open_part

   !> Append a layout, under the number that follows the largest one.
   subroutine append_layout(part, layout, error)
      !> The part file
      type(part_t), intent(inout) :: part
      !> The layout
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(record_t) :: record

      call clear_record(record)
      call put_integer(record, part%layouts + 1)
      call put_layout(record, layout)
      call append_record(part, kind_layout, record, error)
      if (.not. allocated(error)) part%layouts = part%layouts + 1
   end subroutine append_layout

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
      integer(int64) :: most_bytes

      most_bytes = longest_record*int(word_size, int64)
      if (record%length > longest_record) then
         call raise(error, kind_file, "cannot write '"//part%file%path//"': a case takes "// &
            & integer_text(int(record%length*word_size/megabyte))//" MB, and "//integer_text(int(most_bytes/megabyte))// &
            & " MB are allowed; take a larger 'output.angle_step_deg'")
         return
      end if
      allocate (words(head_words + record%length))
      words(1) = mark + kind
      words(2) = record%length
      words(head_words + 1:) = record%words(:record%length)
      words(3) = checksum(words(head_words + 1:), words(1) + words(2))
      call append_words(part%file, words, error)
   end subroutine append_record

   !> Flush what was appended to disk.
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
