!> Binary files through the operating system: append, read at any offset, truncate, lock, flush to disk.
!>
!> In: paths, texts, 64-bit words. Out: words, errors with the system's message. The program buffers nothing: what was appended
!> survives the end of the process, however it ends, and what was flushed to disk survives a power failure. Every file that this
!> program writes passes `settle_raw` before it counts as written.
module camroller_raw_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_f_pointer, c_int, c_intptr_t, c_loc, c_null_char, c_null_ptr, &
      & c_ptr, c_size_t, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_c_library, only : c_fclose, c_fileno, c_flock, c_fopen, c_glob, c_globfree, c_lseek, c_pread, c_write, &
      & glob_t
   use camroller_error, only : error_t, raise, kind_file
   use camroller_file_facts, only : facts_of_descriptor, file_facts_t
   use camroller_text_lines, only : line_t
   use camroller_system_file, only : error_number, ignore_size_signal, restore_size_signal, set_file_size, sync_descriptor, &
      & system_words, text_at_address
   implicit none
   private

   public :: raw_file_t, open_raw, create_raw, append_words, append_text, read_words, cut_raw, sync_raw, settle_raw, close_raw
   public :: find_files, is_locked, lock_raw, write_letters

   !> Bytes of a word
   integer(int64), parameter, public :: word_size = 8_int64
   !> What `lseek` takes for the end of a file; `flock` for an exclusive lock without waiting, and for giving it back
   integer(c_int), parameter :: from_end = 2_c_int, lock_at_once = 6_c_int, unlock = 8_c_int
   !> Error numbers: another process has the lock (EWOULDBLOCK); a signal came before anything was done; a closed pipe
   integer(c_int), parameter :: would_block = 11_c_int, interrupted = 4_c_int, broken_pipe = 32_c_int

   !> An open file
   type :: raw_file_t
      !> Its path
      character(len=:), allocatable :: path
      !> Its stream in the C library; null where it is not open
      type(c_ptr) :: stream = c_null_ptr
      !> Its descriptor
      integer(c_int) :: descriptor = -1
      !> Bytes that are in it
      integer(int64) :: bytes = 0
   end type raw_file_t

contains

   !> Open a file: to read, or to append to, with a lock that no other process has unless it is shared.
   subroutine open_raw(file, path, is_writable, error, is_shared)
      !> The file
      type(raw_file_t), intent(out) :: file
      !> Its path; created where it is to be written and is not there
      character(len=*), intent(in) :: path
      !> Is it to be appended to?
      logical, intent(in) :: is_writable
      !> File error
      type(error_t), allocatable, intent(out) :: error
      !> May other processes have it open to be appended to? Not where this is left out
      logical, intent(in), optional :: is_shared

      logical :: is_alone

      file%path = path
      is_alone = is_writable
      if (present(is_shared)) is_alone = is_alone .and. .not. is_shared
      if (is_writable) then
         file%stream = c_fopen(path//c_null_char, "a+b"//c_null_char)
      else
         file%stream = c_fopen(path//c_null_char, "rb"//c_null_char)
      end if
      if (.not. c_associated(file%stream)) then
         call raise(error, kind_file, "cannot open '"//path//"': "//last_words())
         return
      end if
      file%descriptor = c_fileno(file%stream)
      if (is_alone) then
         if (c_flock(file%descriptor, lock_at_once) /= 0) then
            if (error_number() == would_block) then
               call raise(error, kind_file, "another process is writing '"//path//"'")
            else
               call raise(error, kind_file, "cannot lock '"//path//"': "//last_words())
            end if
            call close_raw(file)
            return
         end if
      end if
      file%bytes = c_lseek(file%descriptor, 0_c_int64_t, from_end)
   end subroutine open_raw

   !> Have the lock of a file alone.
   subroutine lock_raw(file, is_mine, error)
      !> An open file; its content is read again
      type(raw_file_t), intent(inout) :: file
      !> Is it had? Where not, there is an error, or another process has it
      logical, intent(out) :: is_mine
      !> File error where there are no locks
      type(error_t), allocatable, intent(out) :: error

      is_mine = c_flock(file%descriptor, lock_at_once) == 0
      if (is_mine) then
         file%bytes = c_lseek(file%descriptor, 0_c_int64_t, from_end)
      else if (error_number() /= would_block) then
         call raise(error, kind_file, "cannot lock '"//file%path//"': "//last_words())
      end if
   end subroutine lock_raw

   !> Has another process a lock on a file?
   function is_locked(file) result(verdict)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Has it?
      logical :: verdict

      integer(c_int) :: ignored

      verdict = c_flock(file%descriptor, lock_at_once) /= 0
      if (verdict) verdict = error_number() == would_block
      if (.not. verdict) ignored = c_flock(file%descriptor, unlock)
   end function is_locked

   !> Create a file to append to; one of that name must not be there.
   subroutine create_raw(file, path, shown, error)
      !> The file
      type(raw_file_t), intent(out) :: file
      !> Its path, and what messages call it
      character(len=*), intent(in) :: path, shown
      !> File error
      type(error_t), allocatable, intent(out) :: error

      file%path = shown
      file%stream = c_fopen(path//c_null_char, "wbx"//c_null_char)
      if (c_associated(file%stream)) then
         file%descriptor = c_fileno(file%stream)
      else
         call raise(error, kind_file, "cannot write '"//shown//"': "//last_words())
      end if
   end subroutine create_raw

   !> Append a text; where that fails, the file has to be given up.
   subroutine append_text(file, text, error)
      !> A file that is open for appending
      type(raw_file_t), intent(inout) :: file
      !> What to append
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason
      logical :: is_unread

      call write_letters(file%descriptor, text, reason, is_unread)
      if (reason == "") then
         file%bytes = file%bytes + len(text)
      else
         call raise(error, kind_file, "cannot write '"//file%path//"': "//reason)
      end if
   end subroutine append_text

   !> Hand a text to the system, all of it, however many pieces it takes it in.
   subroutine write_letters(descriptor, text, reason, is_unread)
      !> Where it goes
      integer(c_int), intent(in) :: descriptor
      !> The text
      character(len=*), intent(in), target :: text
      !> Why it was not taken, in the system's words; empty where it was
      character(len=:), allocatable, intent(out) :: reason
      !> Is that because the reader has closed the pipe?
      logical, intent(out) :: is_unread

      integer(c_intptr_t) :: former
      integer(int64) :: done, written

      reason = ""
      is_unread = .false.
      call ignore_size_signal(former)
      done = 0
      do while (done < len(text, int64))
         written = c_write(descriptor, c_loc(text(done + 1:done + 1)), int(len(text, int64) - done, c_size_t))
         if (written > 0) then
            done = done + written
         else if (written == 0) then
            reason = "only a part of it was written"
         else if (error_number() /= interrupted) then
            reason = last_words()
            is_unread = error_number() == broken_pipe
         end if
         if (reason /= "") exit
      end do
      call restore_size_signal(former)
   end subroutine write_letters

   !> Append words in one piece; where that fails the file is as it was before.
   subroutine append_words(file, words, error)
      !> A file that is open for appending
      type(raw_file_t), intent(inout) :: file
      !> What to append
      integer(int64), intent(in), target, contiguous :: words(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason
      integer(int64) :: done, written
      logical :: ignored

      done = 0
      do while (done < word_size*size(words))
         written = c_write(file%descriptor, c_loc(words(1 + done/word_size)), &
            & int(word_size*size(words) - done, c_size_t))
         if (written > 0 .and. modulo(written, word_size) == 0) then
            done = done + written
            cycle
         end if
         reason = "only a part of it was written"
         if (written < 0) reason = last_words()
         call set_file_size(file%descriptor, file%bytes, ignored)
         call raise(error, kind_file, "cannot write '"//file%path//"': "//reason)
         return
      end do
      file%bytes = file%bytes + done
   end subroutine append_words

   !> Read words at an offset.
   subroutine read_words(file, offset, words, is_complete)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> Where they start [byte]
      integer(int64), intent(in) :: offset
      !> What is there
      integer(int64), intent(out), target, contiguous :: words(:)
      !> Did the file hold that many?
      logical, intent(out) :: is_complete

      integer(int64) :: done, found

      done = 0
      words = 0
      is_complete = .true.
      do while (done < word_size*size(words))
         found = c_pread(file%descriptor, c_loc(words(1 + done/word_size)), &
            & int(word_size*size(words) - done, c_size_t), offset + done)
         is_complete = found > 0 .and. modulo(found, word_size) == 0
         if (.not. is_complete) return
         done = done + found
      end do
   end subroutine read_words

   !> Cut a file.
   subroutine cut_raw(file, bytes, error)
      !> A file that is open for appending
      type(raw_file_t), intent(inout) :: file
      !> What is to be left of it [byte]
      integer(int64), intent(in) :: bytes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      logical :: done

      call set_file_size(file%descriptor, bytes, done)
      if (done) then
         file%bytes = bytes
      else
         call raise(error, kind_file, "cannot truncate '"//file%path//"': "//last_words())
      end if
   end subroutine cut_raw

   !> Flush all that was appended to disk, and check that all of it is there.
   subroutine sync_raw(file, error)
      !> An open file
      type(raw_file_t), intent(in) :: file
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(file_facts_t) :: facts
      logical :: done

      call sync_descriptor(file%descriptor, done)
      if (.not. done) then
         call raise(error, kind_file, "cannot write '"//file%path//"': "//last_words())
         return
      end if
      facts = facts_of_descriptor(file%descriptor)
      if (facts%bytes /= file%bytes) call raise(error, kind_file, "cannot write '"//file%path// &
         & "': not all of it reached the disk")
   end subroutine sync_raw

   !> Close a file that is complete: it counts as written where all of it is on disk and closing it succeeds.
   subroutine settle_raw(file, error)
      !> An open file; closed in any case
      type(raw_file_t), intent(inout) :: file
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(c_int) :: status

      call sync_raw(file, error)
      if (allocated(error)) then
         call close_raw(file)
         return
      end if
      status = c_fclose(file%stream)
      if (status /= 0) call raise(error, kind_file, "cannot write '"//file%path//"': "//last_words())
      file%stream = c_null_ptr
      file%descriptor = -1
   end subroutine settle_raw

   !> Close a file, open or not; its lock ends.
   subroutine close_raw(file)
      !> The file
      type(raw_file_t), intent(inout) :: file

      integer(c_int) :: ignored

      if (c_associated(file%stream)) ignored = c_fclose(file%stream)
      file%stream = c_null_ptr
      file%descriptor = -1
   end subroutine close_raw

   !> Files whose path begins with a text, sorted.
   subroutine find_files(beginning, paths)
      !> Beginning of the paths
      character(len=*), intent(in) :: beginning
      !> The paths
      type(line_t), allocatable, intent(out) :: paths(:)

      type(glob_t) :: found
      type(c_ptr), pointer :: addresses(:)
      character(len=:), allocatable :: pattern
      integer :: i

      pattern = ""
      do i = 1, len(beginning)
         if (index("*?[]\", beginning(i:i)) > 0) pattern = pattern//"\"
         pattern = pattern//beginning(i:i)
      end do
      found%count = 0
      if (c_glob(pattern//"*"//c_null_char, 0_c_int, c_null_ptr, found) /= 0) found%count = 0
      allocate (paths(found%count))
      if (size(paths) == 0) return
      call c_f_pointer(found%paths, addresses, [found%count])
      do i = 1, size(paths)
         call text_at_address(addresses(i), paths(i)%text)
      end do
      call c_globfree(found)
   end subroutine find_files

   !> The system's message for the last error.
   function last_words() result(words)
      !> The words
      ! style: text because files are written by one thread at a time
      character(len=:), allocatable :: words

      call system_words(error_number(), words)
   end function last_words

end module camroller_raw_file
