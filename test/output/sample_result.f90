!> Small results with numbers that tell their place, and what tests of files need around them.
module sample_result
   use testdrive, only : error_type, check, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_layout, only : layout_of, layout_t
   use camroller_output, only : add_layout, output_t, write_outcome
   use camroller_output_kind, only : result_kind
   use camroller_remarks, only : remark_lines
   use camroller_result, only : quantity_t, result_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : read_numbers, read_text, read_text_attribute
   use camroller_system_file, only : process_number, remove_file
   implicit none
   private

   public :: new_sample, sample_value, scratch_path, write_old_file, is_old_file, same_content, expect_error
   public :: check_text, check_number, write_case, write_failure, old_content

   !> What stands in a file that must not be touched; a new result may replace it
   character(len=*), parameter :: old_content = trim(result_kind%beginnings(1))//" "//trim(result_kind%mark)

contains

   !> Write a result into a file.
   subroutine write_case(writer, position, result, error)
      !> The file
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> Its result, with the quantities of the results before
      type(result_t), intent(in) :: result
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(layout_t) :: layout

      call layout_of(result, layout)
      if (.not. allocated(writer%summary)) call add_layout(writer, layout, error)
      if (.not. allocated(error)) call write_outcome(writer, position, 0, remark_lines(result%remarks), "", result%summary_values, &
         & result%series_values, error)
   end subroutine write_case

   !> Write a case without a result into a file.
   subroutine write_failure(writer, position, failure, error)
      !> The file
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> What went wrong with it
      type(error_t), intent(in) :: failure
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: none(0, 0) ! [-]

      call write_outcome(writer, position, failure%kind, failure%message, "", [real(wp) ::], none, error)
   end subroutine write_failure

   !> A result with two series, two scalars.
   subroutine new_sample(result, position, angles)
      !> The result
      type(result_t), intent(out) :: result
      !> Position of its case, from 1
      integer, intent(in) :: position
      !> Number of cam angles
      integer, intent(in) :: angles

      integer :: i, j

      result%angle = [(360.0_wp*real(i - 1, wp)/real(angles, wp), i=1, angles)]
      allocate (result%series(2), result%summary(2), result%series_values(angles, 2))
      call describe(result%series(1), "load")
      call describe(result%series(2), "lift")
      call describe(result%summary(1), "mean_load")
      call describe(result%summary(2), "max_lift")
      do j = 1, 2
         do i = 1, angles
            result%series_values(i, j) = sample_value(position, i, j)
         end do
      end do
      result%summary_values = [sample_value(position, 0, 1), sample_value(position, 0, 2)]
      allocate (result%remarks(0))
   end subroutine new_sample

   !> Fill the words of a quantity.
   subroutine describe(quantity, word)
      !> The quantity
      type(quantity_t), intent(out) :: quantity
      !> Its name
      character(len=*), intent(in) :: word

      quantity%name = word
      quantity%unit = "N"
      quantity%description = "a "//word
      quantity%source = "sample"
   end subroutine describe

   !> A number that tells its place; exact in binary.
   pure function sample_value(position, row, column) result(value)
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> Row of the series, 0 for a scalar
      integer, intent(in) :: row
      !> Series or scalar
      integer, intent(in) :: column
      !> The number [-]
      real(wp) :: value

      value = real(position, wp) + real(row, wp)/1024.0_wp + 65536.0_wp*real(column, wp)
   end function sample_value

   !> Path of a file for this run of the tests alone.
   function scratch_path(name) result(path)
      !> What the file is for
      character(len=*), intent(in) :: name
      !> Its path
      character(len=:), allocatable :: path

      character(len=20) :: number

      write (number, "(i0)") process_number()
      path = "build/scratch-"//trim(number)//"-"//name
   end function scratch_path

   !> Put a file in the way that must stay as it is.
   subroutine write_old_file(path)
      !> Its path
      character(len=*), intent(in) :: path

      integer :: unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(a)") old_content
      close (unit)
   end subroutine write_old_file

   !> Check that the old file is as it was and alone; it is removed.
   subroutine is_old_file(error, path)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> Its path
      character(len=*), intent(in) :: path

      character(len=40) :: line, number
      integer :: unit, status
      logical :: left

      open (newunit=unit, file=path, status="old", action="read", iostat=status)
      call check(error, status, 0, "the old file is gone")
      if (allocated(error)) return
      read (unit, "(a)", iostat=status) line
      close (unit)
      call remove_file(path)
      call check(error, status, 0, "the old file is empty")
      if (allocated(error)) return
      call check(error, trim(line), old_content)
      if (allocated(error)) return
      write (number, "(i0)") process_number()
      inquire (file=path//".unfinished-"//trim(number)//"-0", exist=left)
      call check(error, .not. left, "an unfinished file is left")
   end subroutine is_old_file

   !> Check that two files hold the same bytes.
   subroutine same_content(error, one, other)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> Path of a file
      character(len=*), intent(in) :: one
      !> Path of another
      character(len=*), intent(in) :: other

      character(len=:), allocatable :: bytes, others

      call read_bytes(one, bytes)
      call read_bytes(other, others)
      call check(error, len(bytes) > 0 .and. len(bytes) == len(others), "the sizes differ")
      if (allocated(error)) return
      call check(error, bytes == others, "the bytes differ")
   end subroutine same_content

   !> All bytes of a file.
   subroutine read_bytes(path, bytes)
      !> Its path
      character(len=*), intent(in) :: path
      !> Its bytes
      character(len=:), allocatable, intent(out) :: bytes

      integer :: unit, length

      open (newunit=unit, file=path, status="old", action="read", access="stream", form="unformatted")
      inquire (unit=unit, size=length)
      bytes = repeat(" ", length)
      read (unit) bytes
      close (unit)
   end subroutine read_bytes

   !> Check that an error was raised, of the kind and with the words.
   subroutine expect_error(error, raised, kind, words)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> The error, or none
      type(error_t), allocatable, intent(in) :: raised
      !> Its kind
      integer, intent(in) :: kind
      !> Words that its message must hold
      character(len=*), intent(in) :: words

      if (.not. allocated(raised)) then
         call test_failed(error, "no error where one was due: "//words)
         return
      end if
      call check(error, index(raised%message, words) > 0, "other words: "//raised%message)
      if (allocated(error)) return
      call check(error, raised%kind, kind)
   end subroutine expect_error

   !> Check a text, or an attribute that is a text.
   subroutine check_text(error, file, name, attribute, expected, position)
      type(error_type), allocatable, intent(out) :: error
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object
      character(len=*), intent(in) :: name
      !> Name of the attribute, blank for the dataset itself
      character(len=*), intent(in) :: attribute
      !> What it should be
      character(len=*), intent(in) :: expected
      !> Position in the dataset
      integer, intent(in), optional :: position(:)

      type(error_t), allocatable :: raised
      character(len=:), allocatable :: text

      if (attribute /= "") then
         call read_text_attribute(file, name, attribute, text, raised)
      else if (present(position)) then
         call read_text(file, name, position, text, raised)
      else
         call read_text(file, name, [integer ::], text, raised)
      end if
      call check(error, .not. allocated(raised), "cannot read "//name)
      if (.not. allocated(error)) call check(error, text, expected)
   end subroutine check_text

   !> Check one number of a dataset.
   subroutine check_number(error, file, name, position, expected)
      type(error_type), allocatable, intent(out) :: error
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> Position in it
      integer, intent(in) :: position(:)
      !> What it should be [-]
      real(wp), intent(in) :: expected

      type(error_t), allocatable :: raised
      real(wp), allocatable :: numbers(:)

      call read_numbers(file, name, position, spread(1, 1, size(position)), numbers, raised)
      call check(error, .not. allocated(raised), "cannot read "//name)
      if (.not. allocated(error)) call check(error, abs(numbers(1) - expected), 0.0_wp, thr=0.0_wp)
   end subroutine check_number

end module sample_result
