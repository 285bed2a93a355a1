!> Interfaces to the C library of POSIX systems, as its manual has them: what files, folders, signals, errors and the time need.
!>
!> In and out: what the C functions take and give. Paths and modes end with a null character.
module camroller_c_library
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_intptr_t, c_long, c_ptr, c_size_t
   implicit none
   private

   public :: glob_t, c_chmod, c_close, c_errno, c_fallocate, c_fclose, c_fileno, c_flock, c_fopen, c_fread, &
      & c_fseek, c_fsync, c_ftell, c_ftruncate, c_getpid, c_glob, c_globfree, c_gmtime, c_lseek, c_open, &
      & c_pread, c_realpath, c_rename, c_signal, c_strerror, c_strftime, c_strlen, c_time, c_unlink, c_usleep, c_write

   !> Result of `glob`, as C libraries lay it out, with room for what follows
   type, bind(C) :: glob_t
      integer(c_size_t) :: count
      type(c_ptr) :: paths
      integer(c_size_t) :: rest(32)
   end type glob_t

   interface
      function c_chmod(path, mode) bind(C, name="chmod") result(status)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
         integer(c_int) :: status
      end function c_chmod

      function c_close(descriptor) bind(C, name="close") result(status)
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int) :: status
      end function c_close

      function c_errno() bind(C, name="__errno_location") result(address)
         import :: c_ptr
         type(c_ptr) :: address
      end function c_errno

      function c_fallocate(descriptor, first, length) bind(C, name="posix_fallocate") result(status)
         import :: c_int, c_int64_t
         integer(c_int), value :: descriptor
         integer(c_int64_t), value :: first, length
         integer(c_int) :: status
      end function c_fallocate

      function c_fclose(stream) bind(C, name="fclose") result(status)
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int) :: status
      end function c_fclose

      function c_fileno(stream) bind(C, name="fileno") result(descriptor)
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int) :: descriptor
      end function c_fileno

      function c_flock(descriptor, operation) bind(C, name="flock") result(status)
         import :: c_int
         integer(c_int), value :: descriptor, operation
         integer(c_int) :: status
      end function c_flock

      function c_fopen(path, mode) bind(C, name="fopen") result(stream)
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*), mode(*)
         type(c_ptr) :: stream
      end function c_fopen

      function c_fread(buffer, size, count, stream) bind(C, name="fread") result(found)
         import :: c_ptr, c_size_t
         type(c_ptr), value :: buffer, stream
         integer(c_size_t), value :: size, count
         integer(c_size_t) :: found
      end function c_fread

      function c_fseek(stream, offset, whence) bind(C, name="fseek") result(status)
         import :: c_int, c_long, c_ptr
         type(c_ptr), value :: stream
         integer(c_long), value :: offset
         integer(c_int), value :: whence
         integer(c_int) :: status
      end function c_fseek

      function c_fsync(descriptor) bind(C, name="fsync") result(status)
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int) :: status
      end function c_fsync

      function c_ftell(stream) bind(C, name="ftell") result(position)
         import :: c_long, c_ptr
         type(c_ptr), value :: stream
         integer(c_long) :: position
      end function c_ftell

      function c_ftruncate(descriptor, length) bind(C, name="ftruncate") result(status)
         import :: c_int, c_int64_t
         integer(c_int), value :: descriptor
         integer(c_int64_t), value :: length
         integer(c_int) :: status
      end function c_ftruncate

      function c_getpid() bind(C, name="getpid") result(number)
         import :: c_int
         integer(c_int) :: number
      end function c_getpid

      function c_glob(pattern, flags, on_error, found) bind(C, name="glob") result(status)
         import :: c_char, c_int, c_ptr, glob_t
         character(kind=c_char), intent(in) :: pattern(*)
         integer(c_int), value :: flags
         type(c_ptr), value :: on_error
         type(glob_t), intent(inout) :: found
         integer(c_int) :: status
      end function c_glob

      subroutine c_globfree(found) bind(C, name="globfree")
         import :: glob_t
         type(glob_t), intent(inout) :: found
      end subroutine c_globfree

      function c_gmtime(seconds) bind(C, name="gmtime") result(moment)
         import :: c_long, c_ptr
         integer(c_long), intent(in) :: seconds
         type(c_ptr) :: moment
      end function c_gmtime

      function c_lseek(descriptor, offset, whence) bind(C, name="lseek") result(position)
         import :: c_int, c_int64_t
         integer(c_int), value :: descriptor, whence
         integer(c_int64_t), value :: offset
         integer(c_int64_t) :: position
      end function c_lseek

      function c_open(path, flags) bind(C, name="open") result(descriptor)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: flags
         integer(c_int) :: descriptor
      end function c_open

      function c_pread(descriptor, bytes, count, offset) bind(C, name="pread") result(found)
         import :: c_int, c_int64_t, c_ptr, c_size_t
         integer(c_int), value :: descriptor
         type(c_ptr), value :: bytes
         integer(c_size_t), value :: count
         integer(c_int64_t), value :: offset
         integer(c_int64_t) :: found
      end function c_pread

      function c_realpath(path, resolved) bind(C, name="realpath") result(address)
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: resolved(*)
         type(c_ptr) :: address
      end function c_realpath

      function c_rename(old, new) bind(C, name="rename") result(status)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: old(*), new(*)
         integer(c_int) :: status
      end function c_rename

      function c_signal(number, handler) bind(C, name="signal") result(former)
         import :: c_int, c_intptr_t
         integer(c_int), value :: number
         integer(c_intptr_t), value :: handler
         integer(c_intptr_t) :: former
      end function c_signal

      function c_strerror(number) bind(C, name="strerror") result(text)
         import :: c_int, c_ptr
         integer(c_int), value :: number
         type(c_ptr) :: text
      end function c_strerror

      function c_strftime(text, length, form, moment) bind(C, name="strftime") result(written)
         import :: c_char, c_ptr, c_size_t
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: length
         character(kind=c_char), intent(in) :: form(*)
         type(c_ptr), value :: moment
         integer(c_size_t) :: written
      end function c_strftime

      function c_strlen(text) bind(C, name="strlen") result(length)
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t) :: length
      end function c_strlen

      function c_time(store) bind(C, name="time") result(seconds)
         import :: c_long, c_ptr
         type(c_ptr), value :: store
         integer(c_long) :: seconds
      end function c_time

      function c_unlink(path) bind(C, name="unlink") result(status)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: status
      end function c_unlink

      function c_usleep(microseconds) bind(C, name="usleep") result(status)
         import :: c_int
         integer(c_int), value :: microseconds
         integer(c_int) :: status
      end function c_usleep

      function c_write(descriptor, bytes, count) bind(C, name="write") result(written)
         import :: c_int, c_int64_t, c_ptr, c_size_t
         integer(c_int), value :: descriptor
         type(c_ptr), value :: bytes
         integer(c_size_t), value :: count
         integer(c_int64_t) :: written
      end function c_write
   end interface

end module camroller_c_library
