!> Files that this process has begun and not completed, so that a signal handler can remove them.
!>
!> In: paths. Out: the files removed. A signal handler has no arguments and must not allocate memory: hence the saved variables
!> and their fixed size. A path that is too long, or exceeds the number of entries, is not recorded: its temporary file stays if
!> the process is ended by a signal.
module camroller_unfinished
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use camroller_c_library, only : c_unlink
   implicit none
   private

   public :: remember_unfinished, forget_unfinished, remove_remembered

   !> Places, and letters of a path with the null character that ends it
   integer, parameter :: places = 8, path_length = 4096
   !> Operations on the entries
   integer, parameter :: add = 1, drop = 2, clear = 3

contains

   !> Remember a file that is being written.
   subroutine remember_unfinished(path)
      !> Its path
      character(len=*), intent(in) :: path

      call change_places(add, path)
   end subroutine remember_unfinished

   !> Forget a file: it is finished, or gone.
   subroutine forget_unfinished(path)
      !> Its path
      character(len=*), intent(in) :: path

      call change_places(drop, path)
   end subroutine forget_unfinished

   !> Remove the recorded files; may be called by a signal handler.
   subroutine remove_remembered()
      call change_places(clear, "")
   end subroutine remove_remembered

   !> Change the entries, one by one; an entry is in use while its length is not 0.
   subroutine change_places(task, path)
      !> What to do
      integer, intent(in) :: task
      !> Path to remember or to forget
      character(len=*), intent(in) :: path

      character(kind=c_char), save, volatile :: letters(path_length, places)
      integer, save, volatile :: lengths(places) = 0
      character(kind=c_char) :: copy(path_length)
      integer(c_int) :: ignored
      integer :: i, k

      do i = 1, places
         if (task == clear) then
            if (lengths(i) == 0) cycle
            copy = letters(:, i)
            ignored = c_unlink(copy)
            lengths(i) = 0
         else if (task == add) then
            if (lengths(i) > 0 .or. len(path) >= path_length) cycle
            do k = 1, len(path)
               letters(k, i) = path(k:k)
            end do
            letters(len(path) + 1, i) = c_null_char
            lengths(i) = len(path)
            return
         else if (lengths(i) == len(path)) then
            do k = 1, len(path)
               if (letters(k, i) /= path(k:k)) exit
            end do
            if (k > len(path)) lengths(i) = 0
         end if
      end do
   end subroutine change_places

end module camroller_unfinished
