!> A whole text file as one string.
!>
!> Layer: io. In: a path. Out: the text, or an error that says why there is none.
module camroller_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file
   implicit none
   private

   public :: read_text_file, join_path, folder_of

   !> Larger files are no decks and no tables [bytes]
   integer(int64), parameter :: largest_size = 64_int64*1024_int64*1024_int64

contains

   !> Read a file into a string.
   subroutine read_text_file(path, text, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> All that is in it
      character(len=:), allocatable, intent(out) :: text
      !> File error where it cannot be read
      type(error_t), allocatable, intent(out) :: error

      character(len=256) :: message
      integer :: unit, status
      integer(int64) :: bytes
      logical :: is_there

      inquire (file=path, exist=is_there)
      if (.not. is_there) then
         call raise(error, kind_file, "there is no file '"//path//"'")
         return
      end if
      open (newunit=unit, file=path, access="stream", form="unformatted", action="read", status="old", iostat=status, &
         & iomsg=message)
      if (status /= 0) then
         call raise(error, kind_file, "cannot read '"//path//"': "//trim(message))
         return
      end if
      inquire (unit=unit, size=bytes)
      if (bytes > largest_size .or. bytes < 0) then
         close (unit)
         call raise(error, kind_file, "'"//path//"' is no text file of a sensible size")
         return
      end if
      allocate (character(len=bytes) :: text)
      if (bytes > 0) read (unit, iostat=status, iomsg=message) text
      close (unit)
      if (status /= 0) then
         call raise(error, kind_file, "cannot read '"//path//"': "//trim(message))
      else if (index(text, achar(0)) > 0) then
         call raise(error, kind_file, "'"//path//"' is no text file")
      end if
   end subroutine read_text_file

   !> Path of a file named in another file: relative to that file's folder unless it begins at the root.
   pure function join_path(folder, name) result(path)
      !> Folder, with `/` at its end or blank
      character(len=*), intent(in) :: folder
      !> Name of the file
      character(len=*), intent(in) :: name
      !> Path of the file
      character(len=:), allocatable :: path

      path = folder//name
      if (name(1:1) == "/") path = name
   end function join_path

   !> Folder of a file, with `/` at its end; blank for the present one.
   pure function folder_of(path) result(folder)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its folder
      character(len=:), allocatable :: folder

      folder = path(:index(path, "/", back=.true.))
   end function folder_of

end module camroller_text_file
