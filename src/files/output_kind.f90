!> Kinds of files that the program writes, and what an earlier one is known by: what it holds, not its name.
!>
!> In: a path, a kind. Out: whether the file there is an earlier output of that kind, which alone a new one replaces. The marks of
!> the kinds stand here.
module camroller_output_kind
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_error, only : error_t
   use camroller_raw_file, only : close_raw, open_raw, raw_file_t, read_words, word_size
   implicit none
   private

   public :: output_kind_t, is_earlier_output
   public :: result_kind, table_kind, drawing_kind, cam_kind, fmu_kind

   !> A kind of files
   type :: output_kind_t
      !> What a file of it is called
      character(len=16) :: name = ""
      !> How it may begin; blank where there are fewer
      character(len=40) :: beginnings(3) = ""
      !> What stands in it near its beginning
      character(len=40) :: mark = ""
   end type output_kind_t

   !> Result of any command, in HDF5
   type(output_kind_t), parameter :: result_kind = output_kind_t("result", [character(len=40) :: char(137)//"HDF", "", ""], &
      & "camroller result")
   !> What `export` writes in its forms: cam angle or case come first, and their first value is zero with all its digits
   type(output_kind_t), parameter :: table_kind = output_kind_t("exported table", [character(len=40) :: "cam_angle", "case", &
      & '{"columns": ['], "0.0000000000000000E+000")
   !> Drawing of a mechanism or of its lift
   type(output_kind_t), parameter :: drawing_kind = output_kind_t("drawing", [character(len=40) :: "<svg xmlns=", "", ""], &
      & "<!-- camroller -->")
   !> Table of the cams of a case
   type(output_kind_t), parameter :: cam_kind = output_kind_t("table of a cam", [character(len=40) :: "lobe,cam_angle [deg],", &
      & "", ""], "polar_angle [deg],cam_radius [mm]")
   !> FMU: an archive whose first file is the description
   type(output_kind_t), parameter :: fmu_kind = output_kind_t("FMU", [character(len=40) :: "PK"//char(3)//char(4), "", ""], &
      & 'generationTool="camroller ')

   !> Words of a file that are looked at: attributes of a result are within them, and the headings and first numbers of a table
   integer, parameter :: examined_words = 8192

contains

   !> Is a file an earlier output of a kind? One that is empty counts as such: nothing is lost with it.
   subroutine is_earlier_output(path, kind, verdict, error)
      !> Path of a regular file
      character(len=*), intent(in) :: path
      !> The kind
      type(output_kind_t), intent(in) :: kind
      !> Is it?
      logical, intent(out) :: verdict
      !> File error where it cannot be read
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: file
      integer(int64), allocatable :: words(:)
      character(len=:), allocatable :: letters
      logical :: is_read
      integer :: i

      verdict = .false.
      call open_raw(file, path, .false., error)
      if (allocated(error)) return
      verdict = file%bytes == 0
      allocate (words(min(int(examined_words, int64), (file%bytes + word_size - 1)/word_size)))
      ! Of the last word of a short file the bytes that are there come, and that it is not whole does not matter
      call read_words(file, 0_int64, words, is_read)
      call close_raw(file)
      allocate (character(len=word_size*size(words)) :: letters)
      letters = transfer(words, letters)
      if (index(letters, trim(kind%mark)) == 0) return
      do i = 1, size(kind%beginnings)
         if (kind%beginnings(i) /= "" .and. index(letters, trim(kind%beginnings(i))) == 1) verdict = .true.
      end do
   end subroutine is_earlier_output

end module camroller_output_kind
