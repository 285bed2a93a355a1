!> Tests of part files: what is put in comes out, a torn end is cut off, another sweep is refused.
module test_part_file
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_file
   use camroller_case_record, only : begin_cases, end_cases, case_outcome_t, put_failure, put_result, take_case, take_header
   use camroller_case_runs, only : missing_runs, piece_of, run_total, runs_in_words, runs_t
   use camroller_layout, only : find_layout, layout_list_t, layout_t
   use camroller_part_file, only : append_layout, append_record, close_part, open_part, part_t, read_record, scan_part
   use camroller_part_scan, only : entry_t, index_t, kind_cases, study_facts_t
   use camroller_raw_file, only : append_words, close_raw, open_raw, raw_file_t
   use camroller_record, only : checksum, clear_record, put_integer, put_numbers, put_text, record_t, take_integer, &
      & take_numbers, take_text
   use camroller_system_file, only : remove_file
   use camroller_remarks, only : add_remark, missed_means, missing_profiles
   use camroller_result, only : quantity_t, result_t
   use sample_result, only : new_sample
   implicit none
   private

   public :: collect_part_file

   character(len=*), parameter :: path = "build/test_part_file.part"

contains

   !> All tests of this suite.
   subroutine collect_part_file(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a record gives back every bit", record_keeps_bits), &
         new_unittest("a case without profiles says whether they were asked for", case_without_profiles), &
         new_unittest("remarks of a case come back with kind, lobe shape and number", case_with_remarks), &
         new_unittest("a checksum sees a bit that changed", checksum_sees_bits), &
         new_unittest("what was appended is there again", part_is_read), &
         new_unittest("a torn record is cut off and can be written again", torn_end), &
         new_unittest("a part of another sweep is refused", other_sweep), &
         new_unittest("one file has one writer", one_writer), &
         new_unittest("a damaged record costs its cases and no others", damaged_record), &
         new_unittest("cases whose layout is damaged are left out, and its number is not given again", damaged_layout), &
         new_unittest("more layouts than anybody thought of", many_layouts), &
         new_unittest("a record that would not be believed is not written", record_too_long), &
         new_unittest("missing cases are found between and behind records", missing_cases) &
         ]
   end subroutine collect_part_file

   subroutine record_keeps_bits(error)
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: numbers(*) = [0.1_wp, -huge(1.0_wp), tiny(1.0_wp)*epsilon(1.0_wp), 0.0_wp]
      type(record_t) :: record
      character(len=:), allocatable :: text
      real(wp) :: again(size(numbers))
      integer :: number

      call clear_record(record)
      call put_text(record, "ninechars")
      call put_integer(record, -7)
      call put_numbers(record, numbers)
      call put_text(record, "")
      call take_text(record, text)
      call check(error, text, "ninechars")
      if (allocated(error)) return
      call take_integer(record, number)
      call take_numbers(record, again)
      call check(error, number == -7 .and. all(transfer(again, [0_int64]) == transfer(numbers, [0_int64])))
      if (allocated(error)) return
      call take_text(record, text)
      call check(error, text == "" .and. .not. record%is_short)
      if (allocated(error)) return
      call take_integer(record, number)
      call check(error, record%is_short)
   end subroutine record_keeps_bits

   subroutine case_without_profiles(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: angles = 4
      type(record_t) :: record
      type(result_t) :: result
      type(layout_t) :: layout
      type(case_outcome_t) :: outcome
      integer :: i, first, count, place

      call new_sample(result, 1, angles)
      layout%angle = result%angle
      layout%series = result%series
      layout%summary = result%summary
      allocate (layout%history(0))
      call begin_cases(record, 1)
      do i = 1, 2
         result%lacks_profiles = i == 1
         call put_result(record, result, "", .true.)
      end do
      call end_cases(record, 2, 1)
      call take_header(record, first, count, place)
      do i = 1, 2
         call take_case(record, layout, outcome)
         call check(error, (outcome%lacks_profiles .eqv. i == 1) .and. .not. allocated(outcome%profiles), "profiles")
         if (allocated(error)) return
         call check(error, size(outcome%series, 2) == size(result%series) .and. .not. record%is_short, "what comes behind")
         if (allocated(error)) return
      end do
   end subroutine case_without_profiles

   subroutine case_with_remarks(error)
      type(error_type), allocatable, intent(out) :: error

      type(record_t) :: record
      type(result_t) :: result
      type(layout_t) :: layout
      type(case_outcome_t) :: outcome
      integer :: first, count, place

      call new_sample(result, 1, 4)
      allocate (layout%angle(0), layout%series(0), layout%history(0))
      layout%summary = result%summary
      call add_remark(result%remarks, missed_means, "the means", 0.1_wp, 0.7_wp)
      call add_remark(result%remarks, missing_profiles, "no profiles")
      result%remarks(1)%lobe = 2
      call begin_cases(record, 1)
      call put_result(record, result, "", .false.)
      call end_cases(record, 1, 1)
      call take_header(record, first, count, place)
      call take_case(record, layout, outcome)
      call check(error, outcome%text, "the means"//new_line("a")//"no profiles")
      if (allocated(error)) return
      call check(error, all(outcome%remarks%kind == [missed_means, missing_profiles]) .and. all(outcome%remarks%lobe == [2, 0]), &
         & "kinds and lobe shapes")
      if (allocated(error)) return
      call check(error, all(abs(outcome%remarks%size - [0.1_wp, 0.0_wp]) <= 0.0_wp) &
         & .and. all(abs(outcome%remarks%excess - [0.7_wp, 0.0_wp]) <= 0.0_wp), "numbers")
      if (allocated(error)) return
      call check(error, all(transfer(outcome%summary, [0_int64]) == transfer(result%summary_values, [0_int64])) .and. &
         & .not. record%is_short, "what comes behind")
   end subroutine case_with_remarks

   subroutine checksum_sees_bits(error)
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: words(20), changed(20)
      integer :: i

      words = [(i*1234567_int64, i=1, 20)]
      do i = 0, 63
         changed = words
         changed(7) = ieor(words(7), shiftl(1_int64, i))
         call check(error, checksum(changed, 0_int64) /= checksum(words, 0_int64))
         if (allocated(error)) return
      end do
   end subroutine checksum_sees_bits

   !> A part file with cases 1 to 3, all failed.
   subroutine write_part(part, error)
      !> The part file, open
      type(part_t), intent(out) :: part
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(record_t) :: record

      call open_part(part, path, facts("a"), error)
      if (allocated(error)) return
      call cases_from(1, record)
      call append_record(part, kind_cases, record, error)
   end subroutine write_part

   !> A record of three failed cases.
   subroutine cases_from(first, record)
      !> First case, from 1
      integer, intent(in) :: first
      !> The record
      type(record_t), intent(inout) :: record

      type(error_t) :: failure
      integer :: i

      failure%kind = 4
      failure%message = "no closed triangle"
      call begin_cases(record, first)
      do i = 1, 3
         call put_failure(record, failure)
      end do
      call end_cases(record, 3, 0)
   end subroutine cases_from

   !> Facts of a sweep of ten cases.
   function facts(deck)
      !> What stands for the deck
      character(len=*), intent(in) :: deck
      !> The facts
      type(study_facts_t) :: facts

      facts%cases = 10
      facts%deck = deck
      facts%build = "b"
   end function facts

   subroutine part_is_read(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(index_t) :: index
      type(raw_file_t) :: file
      type(record_t) :: record
      type(layout_t) :: layout
      type(case_outcome_t) :: outcome
      type(error_t), allocatable :: raised
      integer :: first, count, number

      call remove_file(path)
      call write_part(part, raised)
      call close_part(part)
      if (.not. allocated(raised)) call scan_part(path, facts("a"), index, raised)
      if (.not. allocated(raised)) call open_raw(file, path, .false., raised)
      if (.not. allocated(raised)) call read_record(file, index%entries(1), record, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call close_raw(file)
      call take_header(record, first, count, number)
      allocate (layout%summary(0), layout%series(0), layout%history(0), layout%angle(0))
      call take_case(record, layout, outcome)
      call check(error, index%count == 1 .and. first == 1 .and. count == 3 .and. outcome%status == 4)
      if (allocated(error)) return
      call check(error, outcome%text, "no closed triangle")
      call remove_file(path)
   end subroutine part_is_read

   subroutine torn_end(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(index_t) :: index
      type(raw_file_t) :: file
      type(record_t) :: record
      type(error_t), allocatable :: raised
      integer(int64) :: whole

      call remove_file(path)
      call write_part(part, raised)
      whole = part%file%bytes
      call close_part(part)
      if (.not. allocated(raised)) call open_raw(file, path, .true., raised)
      ! the beginning of a record that would be 100 words long
      if (.not. allocated(raised)) call append_words(file, [7017280452245743363_int64, 100_int64, 5_int64, 6_int64], raised)
      call close_raw(file)
      if (.not. allocated(raised)) call open_part(part, path, facts("a"), raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, part%file%bytes == whole)
      call cases_from(4, record)
      call append_record(part, kind_cases, record, raised)
      call close_part(part)
      call scan_part(path, facts("a"), index, raised)
      if (allocated(error)) return
      call check(error, index%count, 2)
      call remove_file(path)
   end subroutine torn_end

   subroutine other_sweep(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(error_t), allocatable :: raised

      call remove_file(path)
      call write_part(part, raised)
      call close_part(part)
      call open_part(part, path, facts("other"), raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, raised%kind == kind_file .and. index(raised%message, "the deck has changed") > 0, raised%message)
      call remove_file(path)
   end subroutine other_sweep

   subroutine one_writer(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part, other
      type(error_t), allocatable :: raised

      call remove_file(path)
      call write_part(part, raised)
      call open_part(other, path, facts("a"), raised)
      call check(error, allocated(raised))
      call close_part(part)
      call remove_file(path)
   end subroutine one_writer

   !> Turn over a bit of a file.
   subroutine flip_bit(byte)
      !> Its byte, from 0
      integer(int64), intent(in) :: byte

      character :: letter
      integer :: unit

      open (newunit=unit, file=path, access="stream", form="unformatted", action="readwrite", status="old")
      read (unit, pos=byte + 1) letter
      write (unit, pos=byte + 1) achar(ieor(iachar(letter), 4))
      close (unit)
   end subroutine flip_bit

   subroutine damaged_record(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(index_t) :: index
      type(record_t) :: record
      type(error_t), allocatable :: raised
      type(runs_t) :: runs
      integer(int64) :: begin, length, byte

      do byte = 1, 8
         call remove_file(path)
         if (allocated(index%entries)) deallocate (index%entries, index%damages)
         index%count = 0
         call write_part(part, raised)
         begin = part%file%bytes
         call cases_from(4, record)
         call append_record(part, kind_cases, record, raised)
         length = part%file%bytes - begin
         call cases_from(7, record)
         call append_record(part, kind_cases, record, raised)
         call close_part(part)
         call flip_bit(begin + (byte*(length - 1))/8)
         call scan_part(path, facts("a"), index, raised)
         if (allocated(raised)) call test_failed(error, raised%message)
         if (allocated(error)) return
         call check(error, index%count == 2 .and. size(index%damages) == 1)
         if (allocated(error)) return
         call missing_runs(index, 1, 9, runs)
         call check(error, runs_in_words(runs), "3 cases, 3 to 5")
         if (allocated(error)) return
      end do
      call open_part(part, path, facts("a"), raised)
      call check(error, part%file%bytes == begin + 2*length, "what follows is not cut off")
      call close_part(part)
      call remove_file(path)
   end subroutine damaged_record

   !> A layout of one scalar.
   function layout_of_one(name) result(layout)
      !> Its name
      character(len=*), intent(in) :: name
      !> The layout
      type(layout_t) :: layout

      layout%summary = [quantity_t(name, "1", "a number", "test")]
      allocate (layout%series(0), layout%history(0), layout%angle(0))
   end function layout_of_one

   subroutine damaged_layout(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(index_t) :: index
      type(record_t) :: record
      type(error_t), allocatable :: raised
      integer(int64) :: place
      integer :: i

      call remove_file(path)
      call open_part(part, path, facts("a"), raised)
      ! all layouts come before the first case, as from threads that begin at the same time
      do i = 1, 3
         if (i == 2) place = part%file%bytes
         call append_layout(part, layout_of_one(achar(iachar("a") + i - 1)), raised)
      end do
      do i = 1, 3
         call cases_from(3*i - 2, record)
         call end_cases(record, 3, i)
         call append_record(part, kind_cases, record, raised)
      end do
      call close_part(part)
      call flip_bit(place + 40)
      call scan_part(path, facts("a"), index, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, index%count == 2 .and. size(index%damages) == 2)
      if (allocated(error)) return
      call check(error, all(index%entries(:2)%first == [1, 7]), "the cases of the damaged layout are left out")
      if (allocated(error)) return
      do i = 1, 2
         associate (entry => index%entries(i))
            call check(error, index%layouts%items(entry%layout)%summary(1)%name, merge("a", "c", entry%first == 1))
            if (allocated(error)) return
         end associate
      end do
      call open_part(part, path, facts("a"), raised)
      call check(error, part%layouts, 3)
      call close_part(part)
      call remove_file(path)
   end subroutine damaged_layout

   subroutine many_layouts(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most = 300
      type(layout_list_t) :: list
      type(result_t) :: result
      integer :: i, turn, number
      logical :: is_new

      call new_sample(result, 1, 1)
      do turn = 1, 2
         do i = 1, most
            result%summary(1)%name = repeat("x", i)
            call find_layout(list, result, number, is_new)
            call check(error, number == i .and. (is_new .eqv. turn == 1))
            if (allocated(error)) return
         end do
      end do
      call check(error, list%count, most)
   end subroutine many_layouts

   subroutine record_too_long(error)
      type(error_type), allocatable, intent(out) :: error

      type(part_t) :: part
      type(record_t) :: record
      type(error_t), allocatable :: raised

      call remove_file(path)
      call write_part(part, raised)
      call cases_from(4, record)
      ! as long as if its words were there
      record%length = 268435457_int64
      call append_record(part, kind_cases, record, raised)
      call close_part(part)
      call remove_file(path)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, index(raised%message, "a case takes 2147 MB") > 0 .and. index(raised%message, "angle_step_deg") > 0, &
         & raised%message)
   end subroutine record_too_long

   subroutine missing_cases(error)
      type(error_type), allocatable, intent(out) :: error

      type(index_t) :: index
      type(runs_t) :: runs
      integer :: first, count

      index%entries = [entry_t(first=7, count=2), entry_t(first=2, count=3), entry_t(first=3, count=1)]
      index%count = 3
      call missing_runs(index, 1, 10, runs)
      call check(error, all(runs%first == [1, 5, 9]) .and. all(runs%count == [1, 2, 2]))
      if (allocated(error)) return
      call check(error, run_total(runs), 5)
      if (allocated(error)) return
      call piece_of(runs, 3, 9, first, count)
      call check(error, first == 6 .and. count == 1)
      if (allocated(error)) return
      call piece_of(runs, 6, 1, first, count)
      call check(error, count, 0)
   end subroutine missing_cases

end module test_part_file
