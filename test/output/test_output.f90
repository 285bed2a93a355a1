!> Tests of result files: what comes back, and what stays where writing goes wrong.
module test_output
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence, kind_file, kind_internal, kind_usage
   use camroller_remarks, only : add_remark, missing_profiles
   use camroller_result, only : result_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_read, only : has_member, is_text_dataset, open_file, read_integer_attribute, read_numbers
   use camroller_layout, only : layout_of, layout_t
   use camroller_output, only : abandon_output, add_layout, close_output, open_output, output_options_t, output_t, write_deck, &
      & write_outcome, write_run, write_sweep
   use camroller_system_file, only : remove_file
   use camroller_text_lines, only : line_t
   use sample_result, only : check_number, check_text, expect_error, is_old_file, new_sample, same_content, sample_value, &
      & scratch_path, write_case, write_failure, write_old_file
   implicit none
   private

   public :: collect_output

contains

   !> All tests of this suite.
   subroutine collect_output(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("series, summary, deck, sweep and run come back as written", everything_comes_back), &
         new_unittest("a failed case has its kind and message, and no numbers", failed_case_is_recorded), &
         new_unittest("a run in which every case fails still gives a file", all_cases_may_fail), &
         new_unittest("blocks, chunks and compression do not change a number", blocks_change_nothing), &
         new_unittest("cases may come in any order", order_does_not_matter), &
         new_unittest("the summary can be written alone", summary_can_stand_alone), &
         new_unittest("the same run gives the same bytes", bytes_are_reproducible), &
         new_unittest("a folder in the place of the file is told", folder_is_told), &
         new_unittest("a folder that does not exist is told", missing_folder_is_told), &
         new_unittest("a folder that takes no files is told", unwritable_folder_is_told), &
         new_unittest("an unknown compression and a file without cases are refused", bad_options_are_refused), &
         new_unittest("an earlier file stays until the new one is complete", earlier_file_stays), &
         new_unittest("a missing case leaves no file, and the earlier one as it was", missing_case_leaves_nothing), &
         new_unittest("a case that is written twice leaves no file", second_case_leaves_nothing), &
         new_unittest("quantities that only later cases have are no number in the others", later_quantities), &
         new_unittest("nothing can be written after giving up", nothing_after_giving_up) &
         ]
   end subroutine collect_output

   subroutine everything_comes_back(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path
      integer :: number

      path = scratch_path("all.h5")
      call open_output(writer, path, 3, options, raised)
      call write_deck(writer, "&case"//new_line("a")//"/", [character(len=12) :: "case.title", "masses.a_kg", "film.law"], &
         & [line_t("'it''s'"), line_t("0.25"), line_t("'moes'")], spread(.false., 1, 3), [character(len=2) :: "", "kg", ""], &
         & [character(len=7) :: "given", "default", "given"], spread(.true., 1, 3), raised)
      call write_sweep(writer, "operating_point.speed_rpm", "rev/min", [300.0_wp, 600.0_wp, 900.0_wp], raised)
      call write_sweep(writer, "film.law", "", [character(len=7) :: "moes", "martin", "another"], raised)
      call write_run(writer, [character(len=8) :: "program", "version"], [character(len=9) :: "camroller", "1"], "", raised)
      call write_samples(writer, 3, 8, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return

      call open_file(file, path, raised)
      call check_samples(error, file, 3, 8)
      call read_integer_attribute(file, "/", "complete", number, raised)
      if (.not. allocated(error)) call check(error, number, 1)
      if (.not. allocated(error)) call check_text(error, file, "/deck/text", "", "&case"//new_line("a")//"/")
      if (.not. allocated(error)) call check_text(error, file, "/deck/values/film.law", "", "moes")
      if (.not. allocated(error)) call check_text(error, file, "/deck/values/case.title", "", "it's")
      if (.not. allocated(error)) call check_text(error, file, "/deck/values/masses.a_kg", "given", "default")
      if (.not. allocated(error)) call check_text(error, file, "/deck/values/masses.a_kg", "units", "kg")
      if (.not. allocated(error)) call check_number(error, file, "/deck/values/masses.a_kg", [integer ::], 0.25_wp)
      if (.not. allocated(error)) call check_number(error, file, "/sweep/operating_point.speed_rpm", [2], 900.0_wp)
      if (.not. allocated(error)) call check_text(error, file, "/sweep/operating_point.speed_rpm", "units", "rev/min")
      if (.not. allocated(error)) call check(error, is_text_dataset(file, "/sweep/film.law"), "names are no texts")
      if (.not. allocated(error)) call check_text(error, file, "/run", "program", "camroller")
      if (.not. allocated(error)) call check_text(error, file, "/series/load", "long_name", "a load")
      if (.not. allocated(error)) call check_text(error, file, "/series/load", "source", "sample")
      if (.not. allocated(error)) call check(error, .not. has_member(file, "/run/warnings"), "warnings without reason")
      call discard_file(file)
      call remove_file(path)
   end subroutine everything_comes_back

   subroutine failed_case_is_recorded(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised, failure
      type(result_t) :: result
      type(hdf5_object_t) :: file
      real(wp), allocatable :: numbers(:)
      character(len=:), allocatable :: path

      path = scratch_path("failed.h5")
      call raise(failure, kind_convergence, "no period")
      call open_output(writer, path, 3, options, raised)
      call write_failure(writer, 1, failure, raised)
      call new_sample(result, 2, 4)
      call add_remark(result%remarks, missing_profiles, "take care")
      call write_case(writer, 2, result, raised)
      call write_failure(writer, 3, failure, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return

      call open_file(file, path, raised)
      call read_numbers(file, "/summary/status", [0], [3], numbers, raised)
      call check(error, all(nint(numbers) == [kind_convergence, 0, kind_convergence]), "another status")
      if (.not. allocated(error)) call check_text(error, file, "/run/messages", "", "no period", [2])
      if (.not. allocated(error)) call check_text(error, file, "/run/messages", "", "", [1])
      if (.not. allocated(error)) call check_text(error, file, "/run/warnings", "", "take care", [1])
      call read_numbers(file, "/series/load", [0, 2], [4, 1], numbers, raised)
      if (.not. allocated(error)) call check(error, all(ieee_is_nan(numbers)), "series of a failed case")
      call read_numbers(file, "/summary/mean_load", [0], [1], numbers, raised)
      if (.not. allocated(error)) call check(error, all(ieee_is_nan(numbers)), "a scalar of a failed case")
      if (.not. allocated(error)) call check_number(error, file, "/series/load", [3, 1], sample_value(2, 4, 1))
      call discard_file(file)
      call remove_file(path)
   end subroutine failed_case_is_recorded

   subroutine all_cases_may_fail(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised, failure
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("fail.h5")
      call raise(failure, kind_convergence, "no period")
      call open_output(writer, path, 1, options, raised)
      call write_failure(writer, 1, failure, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return
      call open_file(file, path, raised)
      call check_number(error, file, "/summary/status", [0], real(kind_convergence, wp))
      call discard_file(file)
      call remove_file(path)
   end subroutine all_cases_may_fail

   subroutine blocks_change_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      ! more than a block of cases, series larger than a contiguous block, more cases than a chunk of scalars
      call check_cases(error, 2500, 7, "auto")
      if (.not. allocated(error)) call check_cases(error, 2500, 7, "on")
      if (.not. allocated(error)) call check_cases(error, 3, 40000, "on")
      if (.not. allocated(error)) call check_cases(error, 9000, 1, "off")
   end subroutine blocks_change_nothing

   !> Write cases and read them back.
   subroutine check_cases(error, cases, angles, compression)
      type(error_type), allocatable, intent(out) :: error
      !> Number of cases
      integer, intent(in) :: cases
      !> Number of cam angles
      integer, intent(in) :: angles
      !> When series are compressed
      character(len=*), intent(in) :: compression

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("cases.h5")
      options%compression = compression
      call open_output(writer, path, cases, options, raised)
      call write_samples(writer, cases, angles, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return
      call open_file(file, path, raised)
      call check_samples(error, file, cases, angles)
      call discard_file(file)
      call remove_file(path)
   end subroutine check_cases

   subroutine order_does_not_matter(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: cases = 1500, angles = 6
      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(result_t) :: result
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path
      integer :: i, position

      path = scratch_path("order.h5")
      options%compression = "on"
      call open_output(writer, path, cases, options, raised)
      do i = 0, cases - 1
         ! 7 and the number of cases have no common divisor, so that each case comes once
         position = 1 + modulo(7*i, cases)
         call new_sample(result, position, angles)
         call write_case(writer, position, result, raised)
         if (allocated(raised)) exit
      end do
      if (.not. allocated(raised)) call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return
      call open_file(file, path, raised)
      call check_samples(error, file, cases, angles)
      call discard_file(file)
      call remove_file(path)
   end subroutine order_does_not_matter

   subroutine summary_can_stand_alone(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("alone.h5")
      options%series = .false.
      call open_output(writer, path, 2, options, raised)
      call write_samples(writer, 2, 5, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return
      call open_file(file, path, raised)
      call check(error, .not. has_member(file, "/series/load"), "a series nobody wanted")
      if (.not. allocated(error)) call check_number(error, file, "/summary/max_lift", [1], sample_value(2, 0, 2))
      call discard_file(file)
      call remove_file(path)
   end subroutine summary_can_stand_alone

   subroutine bytes_are_reproducible(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: one, other

      one = scratch_path("one.h5")
      other = scratch_path("other.h5")
      call open_output(writer, one, 5, options, raised)
      call write_samples(writer, 5, 2500, raised)
      call close_output(writer, raised)
      call open_output(writer, other, 5, options, raised)
      call write_samples(writer, 5, 2500, raised)
      call close_output(writer, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (.not. allocated(error)) call same_content(error, one, other)
      call remove_file(one)
      call remove_file(other)
   end subroutine bytes_are_reproducible

   subroutine folder_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, "build", "cannot write 'build': it is a folder")
   end subroutine folder_is_told

   subroutine missing_folder_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_refusal(error, "no/such/a.h5", "cannot write 'no/such/a.h5': there is no folder 'no/such/'")
      ! below a file
      if (.not. allocated(error)) call expect_refusal(error, "fpm.toml/a.h5", "there is no folder 'fpm.toml/'")
   end subroutine missing_folder_is_told

   subroutine unwritable_folder_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      ! refused to everybody, root included
      call expect_refusal(error, "/proc/a.h5", "cannot write '/proc/a.h5': ")
   end subroutine unwritable_folder_is_told

   !> Check that no result file can be opened at a path.
   subroutine expect_refusal(error, path, words)
      type(error_type), allocatable, intent(out) :: error
      !> The path
      character(len=*), intent(in) :: path
      !> Words of the message
      character(len=*), intent(in) :: words

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised

      call open_output(writer, path, 1, options, raised)
      call expect_error(error, raised, kind_file, words)
   end subroutine expect_refusal

   subroutine bad_options_are_refused(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised

      call open_output(writer, scratch_path("none.h5"), 0, options, raised)
      call expect_error(error, raised, kind_usage, "needs one case")
      if (allocated(error)) return
      call open_output(writer, "", 1, options, raised)
      call expect_error(error, raised, kind_usage, "needs a name")
      if (allocated(error)) return
      options%compression = "zip"
      call open_output(writer, scratch_path("none.h5"), 1, options, raised)
      call check(error, allocated(raised), "an unknown compression was taken")
      if (allocated(error)) return
      call check(error, index(raised%message, "known are 'auto', 'on', 'off'") > 0, raised%message)
   end subroutine bad_options_are_refused

   subroutine earlier_file_stays(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: path
      logical :: exists

      path = scratch_path("earlier.h5")
      call open_output(writer, path, 3, options, raised)
      call write_samples(writer, 2, 4, raised)
      inquire (file=path, exist=exists)
      call check(error, .not. exists, "an incomplete file under its name")
      if (allocated(error)) return
      call write_old_file(path)
      call abandon_output(writer)
      call abandon_output(writer)
      call is_old_file(error, path)
   end subroutine earlier_file_stays

   subroutine missing_case_leaves_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: path

      path = scratch_path("missing.h5")
      call write_old_file(path)
      call open_output(writer, path, 3, options, raised)
      call write_samples(writer, 2, 4, raised)
      call close_output(writer, raised)
      call expect_error(error, raised, kind_internal, "cases are missing")
      if (.not. allocated(error)) call is_old_file(error, path)
   end subroutine missing_case_leaves_nothing

   subroutine second_case_leaves_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(result_t) :: result
      character(len=:), allocatable :: path

      path = scratch_path("twice.h5")
      call write_old_file(path)
      call open_output(writer, path, 3, options, raised)
      call write_samples(writer, 2, 4, raised)
      call new_sample(result, 2, 4)
      call write_case(writer, 2, result, raised)
      call expect_error(error, raised, kind_internal, "written twice")
      if (.not. allocated(error)) call is_old_file(error, path)
   end subroutine second_case_leaves_nothing

   subroutine later_quantities(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: cases = 4, angles = 3
      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised
      type(result_t) :: result
      type(layout_t) :: layout
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path
      real(wp), allocatable :: numbers(:)
      integer :: i, k

      path = scratch_path("later.h5")
      options%compression = "on"
      call open_output(writer, path, cases, options, raised)
      do i = 1, cases
         call new_sample(result, i, angles)
         call layout_of(result, layout)
         if (i == 3) then
            layout%series(2)%name = "slip"
            layout%summary(1)%name = "max_slip"
         end if
         if (i == 1 .or. i == 3) call add_layout(writer, layout, raised)
         if (i < 3) then
            call write_outcome(writer, i, 0, "", "", result%summary_values, result%series_values, raised)
         else
            ! load, lift and slip; mean_load, max_lift and max_slip
            call write_outcome(writer, i, 0, "", "", [result%summary_values, 1.0_wp*i], &
               & reshape([result%series_values, [(10.0_wp*i + k, k=1, angles)]], [angles, 3]), raised)
         end if
         call check(error, .not. allocated(raised), "cannot write")
         if (allocated(error)) return
      end do
      call close_output(writer, raised)
      call open_file(file, path, raised)
      call check(error, .not. allocated(raised), "cannot read")
      if (allocated(error)) return
      call check_samples(error, file, cases, angles)
      call read_numbers(file, "/series/slip", [0, 0], [angles, cases], numbers, raised)
      if (.not. allocated(error)) call check(error, all(ieee_is_nan(numbers(:6))) .and. abs(numbers(8) - 32.0_wp) <= 0.0_wp, "slip")
      call read_numbers(file, "/summary/max_slip", [0], [cases], numbers, raised)
      if (.not. allocated(error)) call check(error, all(ieee_is_nan(numbers(:2))) .and. all(abs(numbers(3:) - [3, 4]) <= 0.0_wp))
      call discard_file(file)
      call remove_file(path)
   end subroutine later_quantities

   subroutine nothing_after_giving_up(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(error_t), allocatable :: raised

      call open_output(writer, scratch_path("given-up.h5"), 1, options, raised)
      call abandon_output(writer)
      call write_samples(writer, 1, 4, raised)
      call expect_error(error, raised, kind_internal, "no result file is open")
      if (allocated(error)) return
      call close_output(writer, raised)
      call expect_error(error, raised, kind_internal, "no result file is open")
   end subroutine nothing_after_giving_up

   !> Write the first cases of a run.
   subroutine write_samples(writer, cases, angles, raised)
      !> An open writer
      type(output_t), intent(inout) :: writer
      !> Number of cases
      integer, intent(in) :: cases
      !> Number of cam angles
      integer, intent(in) :: angles
      !> Error
      type(error_t), allocatable, intent(out) :: raised

      type(result_t) :: result
      integer :: i

      do i = 1, cases
         call new_sample(result, i, angles)
         call write_case(writer, i, result, raised)
         if (allocated(raised)) return
      end do
   end subroutine write_samples

   !> Check all series and scalars of a run.
   subroutine check_samples(error, file, cases, angles)
      type(error_type), allocatable, intent(out) :: error
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> Number of cam angles
      integer, intent(in) :: angles

      type(error_t), allocatable :: raised
      type(result_t) :: result
      real(wp), allocatable :: load(:), lift(:), mean(:), angle(:)
      integer :: i

      call read_numbers(file, "/series/load", [0, 0], [angles, cases], load, raised)
      call read_numbers(file, "/series/lift", [0, 0], [angles, cases], lift, raised)
      call read_numbers(file, "/series/cam_angle", [0], [angles], angle, raised)
      call read_numbers(file, "/summary/max_lift", [0], [cases], mean, raised)
      do i = 1, cases
         call new_sample(result, i, angles)
         call check(error, maxval(abs(load((i - 1)*angles + 1:i*angles) - result%series_values(:, 1))), 0.0_wp, thr=0.0_wp)
         if (allocated(error)) return
         call check(error, maxval(abs(lift((i - 1)*angles + 1:i*angles) - result%series_values(:, 2))), 0.0_wp, thr=0.0_wp)
         if (allocated(error)) return
         call check(error, abs(mean(i) - result%summary_values(2)), 0.0_wp, thr=0.0_wp)
         if (allocated(error)) return
      end do
      call check(error, maxval(abs(angle - result%angle)), 0.0_wp, thr=0.0_wp)
   end subroutine check_samples

end module test_output
