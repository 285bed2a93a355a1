!> A file that appears under its name only when it is complete: checks of the target, a temporary name, and the rename at the
!> end.
!>
!> In: the path of a file to be written, files that are read. Out: a path to write to; the file under its name, or an error and
!> no temporary file. Only an earlier output of the same kind is ever replaced, and never a file that the program reads. If the
!> target is a symbolic link, the file that it refers to is replaced, and the link stays.
module camroller_new_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t, raise, kind_file, kind_usage
   use camroller_file_facts, only : facts_of_path, file_facts_t, is_same_file, kind_in_words
   use camroller_text_lines, only : line_t
   use camroller_number_text, only : integer_text
   use camroller_output_kind, only : is_earlier_output, output_kind_t
   use camroller_raw_file, only : append_text, close_raw, create_raw, open_raw, raw_file_t, settle_raw
   use camroller_system_file, only : process_number, remove_file, rename_file, resolve_path, set_permissions
   use camroller_text_file, only : folder_of
   use camroller_unfinished, only : forget_unfinished, remember_unfinished
   implicit none
   private

   public :: new_file_t, check_place, begin_new_file, take_permissions, end_new_file, drop_new_file, save_text, unfinished_beginning

   !> Names that are tried for an unfinished file
   integer, parameter :: most_attempts = 100
   !> What is added to the name of a file that is not finished, before the numbers of process and attempt
   character(len=*), parameter :: unfinished_mark = ".unfinished-"
   !> Letters that are left of its name: file systems take 255, and the numbers have 20 at most
   integer, parameter :: kept_letters = 255 - len(unfinished_mark) - 20

   !> A file being written
   type :: new_file_t
      !> Its path, as messages call it
      character(len=:), allocatable :: path
      !> Its place: the path, or where a link of that name leads
      character(len=:), allocatable :: place
      !> Path while it is not finished, in the folder of its place; not allocated where nothing is being written
      character(len=:), allocatable :: temporary
      !> Permissions of the file that it replaces; below zero where it replaces none
      integer :: permissions = -1
   end type new_file_t

contains

   !> An error where a file may not be written: it has no folder, or would replace one that is read, something that is no regular
   !> file, or a file that is no earlier output of its kind.
   subroutine check_place(path, kind, inputs, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What it will be
      type(output_kind_t), intent(in) :: kind
      !> Files that are read
      type(line_t), intent(in) :: inputs(:)
      !> Usage or file error
      type(error_t), allocatable, intent(out) :: error

      type(file_facts_t) :: facts
      logical :: is_earlier
      integer :: i

      facts = facts_of_path(path)
      if (.not. facts%is_there) then
         facts = facts_of_path(folder_of(path)//".")
         if (.not. facts%is_folder) call raise(error, kind_file, "cannot write '"//path//"': there is no folder '"// &
            & folder_of(path)//"'")
         return
      end if
      do i = 1, size(inputs)
         if (.not. is_same_file(facts, facts_of_path(inputs(i)%text))) cycle
         call raise(error, kind_usage, "'"//path//"' would replace '"//inputs(i)%text//"', which is read; give another name")
         return
      end do
      if (.not. facts%is_regular) then
         call raise(error, kind_file, "cannot write '"//path//"': it is "//kind_in_words(facts)//", and only regular files are "// &
            & "replaced")
         return
      end if
      call is_earlier_output(path, kind, is_earlier, error)
      if (is_earlier .or. allocated(error)) return
      call raise(error, kind_file, "'"//path//"' exists and is no earlier "//trim(kind%name)//" of camroller, which alone is "// &
         & "replaced; give another name, or remove it first")
   end subroutine check_place

   !> Find out where to write; the file is still to be created.
   subroutine begin_new_file(file, path, kind, error)
      !> The file
      type(new_file_t), intent(out) :: file
      !> Path of the finished file
      character(len=*), intent(in) :: path
      !> What it will be
      type(output_kind_t), intent(in) :: kind
      !> Usage error without a name; file error where no file can be there
      type(error_t), allocatable, intent(out) :: error

      type(file_facts_t) :: facts
      type(line_t) :: inputs(0)
      integer :: attempt

      file%path = path
      file%place = path
      if (path == "") then
         call raise(error, kind_usage, "a file to be written needs a name")
         return
      end if
      call check_place(path, kind, inputs, error)
      if (allocated(error)) return
      facts = facts_of_path(path)
      if (facts%is_there) file%permissions = facts%permissions
      if (facts%is_there) file%place = resolve_path(path)
      do attempt = 0, most_attempts - 1
         file%temporary = unfinished_beginning(file%place)//integer_text(process_number())//"-"//integer_text(attempt)
         facts = facts_of_path(file%temporary)
         if (.not. facts%is_there) exit
      end do
      call remember_unfinished(file%temporary)
   end subroutine begin_new_file

   !> What the path of a file begins with while it is not finished: its own, cut where the name would become too long.
   pure function unfinished_beginning(path) result(beginning)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The beginning, before the numbers of process and attempt
      character(len=min(len(path), index(path, "/", back=.true.) + kept_letters) + len(unfinished_mark)) :: beginning

      beginning = path(:len(beginning) - len(unfinished_mark))//unfinished_mark
   end function unfinished_beginning

   !> Let those read and write an unfinished file who may do so with the file that it replaces.
   subroutine take_permissions(file)
      !> A file that is there
      type(new_file_t), intent(in) :: file

      if (file%permissions >= 0) call set_permissions(file%temporary, file%permissions)
   end subroutine take_permissions

   !> Give a complete file its name; it has to be on disk with all that was written. Where that fails, it is removed.
   subroutine end_new_file(file, bytes, error)
      !> A file whose content is written, and that is closed
      type(new_file_t), intent(inout) :: file
      !> What was written [byte]
      integer(int64), intent(in) :: bytes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: content
      logical :: done

      call open_raw(content, file%temporary, .false., error)
      if (.not. allocated(error)) then
         content%path = file%path
         content%bytes = bytes
         call settle_raw(content, error)
      end if
      if (.not. allocated(error)) then
         call take_permissions(file)
         call rename_file(file%temporary, file%place, done)
         if (.not. done) call raise(error, kind_file, "cannot write '"//file%path//"': '"//file%temporary// &
            & "' could not be given that name")
      end if
      if (allocated(error)) then
         call drop_new_file(file)
      else
         call forget_unfinished(file%temporary)
         deallocate (file%temporary)
      end if
   end subroutine end_new_file

   !> Give up: what was written is removed. Does no harm where nothing is being written.
   subroutine drop_new_file(file)
      !> The file
      type(new_file_t), intent(inout) :: file

      if (.not. allocated(file%temporary)) return
      call remove_file(file%temporary)
      call forget_unfinished(file%temporary)
      deallocate (file%temporary)
   end subroutine drop_new_file

   !> Write a text to a file, which appears under its name when it is complete.
   subroutine save_text(path, kind, text, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What it is
      type(output_kind_t), intent(in) :: kind
      !> The text
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(raw_file_t) :: file

      call begin_new_file(place, path, kind, error)
      if (.not. allocated(error)) call create_raw(file, place%temporary, path, error)
      if (.not. allocated(error)) call append_text(file, text, error)
      call close_raw(file)
      if (allocated(error)) then
         call drop_new_file(place)
      else
         call end_new_file(place, file%bytes, error)
      end if
   end subroutine save_text

end module camroller_new_file
