!> Tests of tables made from result files.
module test_export
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence, kind_file, kind_usage
   use camroller_result, only : result_t
   use camroller_export, only : export_csv, export_series, export_summary
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : close_file, create_file
   use camroller_hdf5_attribute, only : put_attribute
   use camroller_output, only : close_output, open_output, output_options_t, output_t, result_format, &
      & write_sweep
   use camroller_system_file, only : remove_file
   use sample_result, only : expect_error, is_old_file, new_sample, sample_value, scratch_path, write_case, write_failure, &
      & write_old_file
   implicit none
   private

   public :: collect_export

contains

   !> All tests of this suite.
   subroutine collect_export(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("series of a case have names, units and exact numbers", series_are_exact), &
         new_unittest("the summary starts with the case and the swept keys", summary_names_its_cases), &
         new_unittest("a case that does not exist is told", missing_case_is_told), &
         new_unittest("a case that failed is told with its message", failed_case_is_told), &
         new_unittest("a file that is not complete is told", incomplete_file_is_told), &
         new_unittest("a file of another program is told", other_file_is_told), &
         new_unittest("where the table cannot be written, the earlier one stays", earlier_table_stays) &
         ]
   end subroutine collect_export

   subroutine series_are_exact(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      character(len=200) :: lines(6)
      character(len=:), allocatable :: path
      real(wp) :: numbers(3) ! [as in the sample]

      path = scratch_path("series.csv")
      call write_samples(raised)
      call export_csv(sample_path(), export_series, 1, path, raised)
      call check(error, .not. allocated(raised), "no table")
      if (allocated(error)) return
      call read_lines(path, lines)
      call check(error, trim(lines(1)), "cam_angle,load,lift")
      if (.not. allocated(error)) call check(error, trim(lines(2)), "degree,N,N")
      if (.not. allocated(error)) call check(error, trim(lines(3)), &
         & "0.0000000000000000E+000,6.5538000976562500E+004,1.3107400097656250E+005")
      if (.not. allocated(error)) call check(error, trim(lines(6)), "?", "a line too many")
      if (allocated(error)) return
      read (lines(5), *) numbers
      call check(error, maxval(abs(numbers - [240.0_wp, sample_value(2, 3, 1), sample_value(2, 3, 2)])), 0.0_wp, thr=0.0_wp)
   end subroutine series_are_exact

   subroutine summary_names_its_cases(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      character(len=200) :: lines(5)
      character(len=:), allocatable :: path

      path = scratch_path("summary.csv")
      call write_samples(raised)
      call export_csv(sample_path(), export_summary, 0, path, raised)
      call check(error, .not. allocated(raised), "no table")
      if (allocated(error)) return
      call read_lines(path, lines)
      call check(error, trim(lines(1)), "case,film.law,mean_load,max_lift,status")
      if (.not. allocated(error)) call check(error, trim(lines(2)), "1,,N,N,1")
      if (.not. allocated(error)) call check(error, trim(lines(4)), "1.0000000000000000E+000,""a,""""b"""""","// &
         & "6.5538000000000000E+004,1.3107400000000000E+005,0.0000000000000000E+000")
      if (.not. allocated(error)) call check(error, index(lines(5), "NaN,NaN") > 0, lines(5))
   end subroutine summary_names_its_cases

   subroutine missing_case_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call write_samples(raised)
      call export_csv(sample_path(), export_series, 3, scratch_path("none.csv"), raised)
      call expect_error(error, raised, kind_usage, "there is no case 3: the file has the cases 0 to 2")
      if (allocated(error)) return
      call write_samples(raised)
      call export_csv(sample_path(), export_series, -1, scratch_path("none.csv"), raised)
      call remove_file(sample_path())
      call expect_error(error, raised, kind_usage, "there is no case -1")
   end subroutine missing_case_is_told

   subroutine failed_case_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call write_samples(raised)
      call export_csv(sample_path(), export_series, 2, scratch_path("none.csv"), raised)
      call remove_file(sample_path())
      call expect_error(error, raised, kind_usage, "no series of a case that failed: no period")
   end subroutine failed_case_is_told

   subroutine incomplete_file_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("incomplete.h5")
      call create_file(file, path, path, raised)
      call put_attribute(file, "format", result_format, raised)
      call close_file(file, raised)
      call export_csv(path, export_summary, 0, scratch_path("none.csv"), raised)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "it is not complete")
   end subroutine incomplete_file_is_told

   subroutine other_file_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("other.h5")
      call create_file(file, path, path, raised)
      call close_file(file, raised)
      call export_csv(path, export_summary, 0, scratch_path("none.csv"), raised)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "it is not a result file of camroller")
      if (allocated(error)) return
      call export_csv("fpm.toml", export_summary, 0, scratch_path("none.csv"), raised)
      call expect_error(error, raised, kind_file, "it is not an HDF5 file")
   end subroutine other_file_is_told

   subroutine earlier_table_stays(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      character(len=:), allocatable :: path

      path = scratch_path("earlier.csv")
      call write_old_file(path)
      call export_csv("no/such.h5", export_summary, 0, path, raised)
      call expect_error(error, raised, kind_file, "no such file")
      if (.not. allocated(error)) call is_old_file(error, path)
      if (allocated(error)) return
      call write_samples(raised)
      call export_csv(sample_path(), export_summary, 0, "build", raised)
      call expect_error(error, raised, kind_file, "cannot write 'build': it is a folder")
      if (allocated(error)) return
      call write_samples(raised)
      call export_csv(sample_path(), export_summary, 0, "no/such/table.csv", raised)
      call remove_file(sample_path())
      call expect_error(error, raised, kind_file, "cannot write 'no/such/table.csv': ")
   end subroutine earlier_table_stays

   !> Path of the file with samples.
   function sample_path() result(path)
      !> Its path
      character(len=:), allocatable :: path

      path = scratch_path("export.h5")
   end function sample_path

   !> Write two cases that went well and one that failed.
   subroutine write_samples(raised)
      !> Error
      type(error_t), allocatable, intent(out) :: raised

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: failure
      type(result_t) :: result
      integer :: i

      call raise(failure, kind_convergence, "no period")
      call open_output(writer, sample_path(), 3, options, raised)
      call write_sweep(writer, "film.law", "", [character(len=6) :: "moes", "a,""b""", "martin"], raised)
      do i = 1, 2
         call new_sample(result, i, 3)
         call write_case(writer, i, result, raised)
      end do
      call write_failure(writer, 3, failure, raised)
      call close_output(writer, raised)
   end subroutine write_samples

   !> Lines of a table, `?` where it has fewer; the table and its source are removed.
   subroutine read_lines(path, lines)
      !> Path of the table
      character(len=*), intent(in) :: path
      !> Its lines
      character(len=*), intent(out) :: lines(:)

      integer :: unit, status, i

      open (newunit=unit, file=path, status="old", action="read")
      do i = 1, size(lines)
         lines(i) = "?"
         read (unit, "(a)", iostat=status) lines(i)
         if (status /= 0) lines(i) = "?"
      end do
      close (unit)
      call remove_file(path)
      call remove_file(sample_path())
   end subroutine read_lines

end module test_export
