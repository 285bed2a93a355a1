!> Texts written to files that appear under their names when they are complete.
!>
!> In: a path and a text. Out: the file.
module camroller_new_text
   use camroller_error, only : error_t
   use camroller_new_file, only : begin_new_file, drop_new_file, end_new_file, new_file_t
   use camroller_raw_file, only : append_text, close_raw, create_raw, raw_file_t
   implicit none
   private

   public :: save_text

contains

   !> Write a text to a file.
   subroutine save_text(path, text, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The text
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(raw_file_t) :: file

      call begin_new_file(place, path, error)
      if (.not. allocated(error)) call create_raw(file, place%temporary, path, error)
      if (.not. allocated(error)) call append_text(file, text, error)
      call close_raw(file)
      if (allocated(error)) then
         call drop_new_file(place)
      else
         call end_new_file(place, file%bytes, error)
      end if
   end subroutine save_text

end module camroller_new_text
