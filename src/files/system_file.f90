!> System calls: process number, a pause, and those for replacing files: free space, rename, sync, remove, resolve links, date,
!> words for errors.
!>
!> In: paths. Out: what the C library does, with logical results instead of numbers.
module camroller_system_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_pointer, c_int, c_int64_t, c_intptr_t, c_null_char, &
      & c_null_ptr, c_ptr, c_size_t
   use camroller_c_library, only : c_chmod, c_errno, c_fallocate, c_fsync, c_ftruncate, c_getpid, c_gmtime, &
      & c_realpath, c_rename, c_signal, c_strerror, c_strftime, c_strlen, c_time, c_unlink, c_usleep
   implicit none
   private

   public :: process_number, pause_briefly, rename_file, remove_file, resolve_path, set_permissions
   public :: reserve_space, set_file_size, sync_descriptor, utc_date
   public :: ignore_size_signal, restore_size_signal, error_number, system_words, text_at_address

   !> Longest path that the system resolves, with the null character that ends it
   integer, parameter :: longest_path = 4096
   !> Signal that a file outgrew its limit; what `signal` takes for ignoring and gives for an error
   integer(c_int), parameter :: signal_file_size = 25_c_int
   integer(c_intptr_t), parameter :: ignore_signal = 1_c_intptr_t
   integer(c_intptr_t), parameter :: signal_error = -1_c_intptr_t
   !> Error numbers that say that the file system does not reserve space: ENODEV, EINVAL, ESPIPE, ENOSYS, EOPNOTSUPP
   integer(c_int), parameter :: cannot_tell(*) = [19_c_int, 22_c_int, 29_c_int, 38_c_int, 95_c_int]

contains

   !> Number of this process.
   function process_number() result(number)
      !> The number
      integer :: number

      number = int(c_getpid())
   end function process_number

   !> Wait for a tenth of a second; a signal ends the pause.
   subroutine pause_briefly()
      integer(c_int) :: ignored

      ignored = c_usleep(100000_c_int)
   end subroutine pause_briefly

   !> Give a file another name; a file of that name is replaced in one step.
   subroutine rename_file(old, new, done)
      !> Present path
      character(len=*), intent(in) :: old
      !> New path, on the same file system
      character(len=*), intent(in) :: new
      !> False where the system refused
      logical, intent(out) :: done

      done = c_rename(old//c_null_char, new//c_null_char) == 0
   end subroutine rename_file

   !> Say who may read, write and execute a file; nothing happens where the system refuses.
   subroutine set_permissions(path, permissions)
      !> Its path
      character(len=*), intent(in) :: path
      !> As the system numbers them
      integer, intent(in) :: permissions

      integer(c_int) :: status

      status = c_chmod(path//c_null_char, int(permissions, c_int))
   end subroutine set_permissions

   !> Path of a file without links.
   function resolve_path(path) result(resolved)
      !> Path of a file that is there
      character(len=*), intent(in) :: path
      !> The path from the root; the given one where the system has none
      ! style: text because files are written by one thread at a time
      character(len=:), allocatable :: resolved

      character(kind=c_char) :: letters(longest_path)
      integer :: i

      resolved = path
      if (.not. c_associated(c_realpath(path//c_null_char, letters))) return
      resolved = ""
      do i = 1, longest_path
         if (letters(i) == c_null_char) exit
         resolved = resolved//letters(i)
      end do
   end function resolve_path

   !> Flush the content of an open file to disk.
   subroutine sync_descriptor(descriptor, done)
      !> Descriptor of the file
      integer(c_int), intent(in) :: descriptor
      !> False where the system refused
      logical, intent(out) :: done

      done = c_fsync(descriptor) == 0
   end subroutine sync_descriptor

   !> Set disk space aside for a file, which grows to that size.
   subroutine reserve_space(descriptor, first, length, reason)
      !> Descriptor of the file
      integer(c_int), intent(in) :: descriptor
      !> Where the space starts [byte]
      integer(c_int64_t), intent(in) :: first
      !> How much there is to be [byte]
      integer(c_int64_t), intent(in) :: length
      !> Why there is no space, in the system's words; empty where all went well or the file system cannot tell
      character(len=:), allocatable, intent(out) :: reason

      integer(c_intptr_t) :: former
      integer(c_int) :: status

      reason = ""
      call ignore_size_signal(former)
      status = c_fallocate(descriptor, first, length)
      call restore_size_signal(former)
      if (status /= 0 .and. all(status /= cannot_tell)) call system_words(status, reason)
   end subroutine reserve_space

   !> Let a file that outgrows the limit on the size of files be an error like others, not the end of the program.
   subroutine ignore_size_signal(former)
      !> What was done about it so far
      integer(c_intptr_t), intent(out) :: former

      former = c_signal(signal_file_size, ignore_signal)
   end subroutine ignore_size_signal

   !> Let the signal do what it did before.
   subroutine restore_size_signal(former)
      !> What was done about it before
      integer(c_intptr_t), intent(in) :: former

      integer(c_intptr_t) :: ignored

      if (former /= signal_error) ignored = c_signal(signal_file_size, former)
   end subroutine restore_size_signal

   !> Cut a file to a size, or let it grow to it.
   subroutine set_file_size(descriptor, length, done)
      !> Descriptor of the file
      integer(c_int), intent(in) :: descriptor
      !> The size [byte]
      integer(c_int64_t), intent(in) :: length
      !> False where the system refused
      logical, intent(out) :: done

      done = c_ftruncate(descriptor, length) == 0
   end subroutine set_file_size

   !> The system's number for what went wrong last in this thread.
   function error_number() result(number)
      !> The number
      integer(c_int) :: number

      integer(c_int), pointer :: place

      call c_f_pointer(c_errno(), place)
      number = place
   end function error_number

   !> The system's message for an error number.
   subroutine system_words(number, words)
      !> The number
      integer(c_int), intent(in) :: number
      !> The words
      character(len=:), allocatable, intent(out) :: words

      call text_at_address(c_strerror(number), words)
   end subroutine system_words

   !> A text of the C library as one of Fortran.
   subroutine text_at_address(address, text)
      !> Where it starts
      type(c_ptr), intent(in) :: address
      !> The text, as long as it is there
      character(len=:), allocatable, intent(out) :: text

      character(kind=c_char), pointer :: letters(:)
      integer :: i

      call c_f_pointer(address, letters, [c_strlen(address)])
      text = repeat(" ", size(letters))
      do i = 1, size(letters)
         text(i:i) = letters(i)
      end do
   end subroutine text_at_address

   !> Remove a file; nothing happens where there is none.
   subroutine remove_file(path)
      !> The path
      character(len=*), intent(in) :: path

      integer(c_int) :: status

      status = c_unlink(path//c_null_char)
   end subroutine remove_file

   !> Now, as `2030-01-31T23:59:59Z`.
   function utc_date() result(text)
      !> Date and time of day in universal time, blank where the system has none
      character(len=20) :: text

      character(kind=c_char) :: letters(21)
      type(c_ptr) :: moment
      integer :: i

      text = ""
      moment = c_gmtime(c_time(c_null_ptr))
      if (.not. c_associated(moment)) return
      if (c_strftime(letters, 21_c_size_t, "%Y-%m-%dT%H:%M:%SZ"//c_null_char, moment) /= 20) return
      do i = 1, 20
         text(i:i) = letters(i)
      end do
   end function utc_date

end module camroller_system_file
