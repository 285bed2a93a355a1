!> Tests of files that appear when they are complete, of what the system knows of files, and of seals.
module test_new_file
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_error, only : error_t, kind_file, kind_usage
   use camroller_file_facts, only : facts_of_path, file_facts_t, is_same_file, kind_in_words
   use camroller_text_lines, only : line_t
   use camroller_new_file, only : begin_new_file, check_place, drop_new_file, end_new_file, new_file_t
   use camroller_output_kind, only : cam_kind, drawing_kind, fmu_kind, output_kind_t, result_kind, table_kind
   use camroller_raw_file, only : append_text, close_raw, create_raw, raw_file_t, settle_raw
   use camroller_seal, only : check_seal, seal_file
   use camroller_system_file, only : remove_file
   use camroller_unfinished, only : remove_remembered
   use sample_result, only : expect_error, old_content, scratch_path, write_old_file
   implicit none
   private

   public :: collect_new_file

contains

   !> All tests of this suite.
   subroutine collect_new_file(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a file is known by what it is, not by its name", files_are_known), &
         new_unittest("a complete file takes the place of the earlier one", complete_file_takes_place), &
         new_unittest("a file with fewer or more bytes than were written is given up", lost_bytes_are_noticed), &
         new_unittest("a file that is given up leaves the earlier one", dropped_file_leaves_nothing), &
         new_unittest("what a signal would remove is what is unfinished", signals_remove_the_unfinished), &
         new_unittest("no file takes the place of one that is read", inputs_stay), &
         new_unittest("a file takes the place of an earlier one of its kind alone", other_files_stay), &
         new_unittest("a seal goes with its bytes and with no others", seals_tell_damage) &
         ]
   end subroutine collect_new_file

   subroutine files_are_known(error)
      type(error_type), allocatable, intent(out) :: error

      type(file_facts_t) :: facts, other
      character(len=:), allocatable :: path

      path = scratch_path("known")
      call write_old_file(path)
      facts = facts_of_path(path)
      other = facts_of_path(path(:index(path, "/", back=.true.))//"./"//path(index(path, "/", back=.true.) + 1:))
      call check(error, facts%is_regular .and. facts%bytes > 0, "no regular file")
      if (.not. allocated(error)) call check(error, is_same_file(facts, other), "not the same by another name")
      other = facts_of_path("/")
      if (.not. allocated(error)) call check(error, kind_in_words(other), "a folder")
      if (.not. allocated(error)) call check(error, .not. is_same_file(facts, other), "the same as a folder")
      call remove_file(path)
      facts = facts_of_path(path)
      if (.not. allocated(error)) call check(error, .not. facts%is_there, "still there")
      if (.not. allocated(error)) call check(error, .not. is_same_file(facts, facts), "what is not there is the same as itself")
   end subroutine files_are_known

   subroutine complete_file_takes_place(error)
      type(error_type), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(error_t), allocatable :: raised
      type(file_facts_t) :: facts
      character(len=:), allocatable :: path, temporary

      path = scratch_path("new")
      call write_old_file(path)
      call begin_new_file(place, path, result_kind, raised)
      call check(error, .not. allocated(raised), "no place")
      if (allocated(error)) return
      temporary = place%temporary
      call write_letters_to(temporary, "1234567890")
      call check(error, is_earlier(path), "the earlier file went too early")
      call end_new_file(place, 10_int64, raised)
      if (.not. allocated(error)) call check(error, .not. allocated(raised), "not put in its place")
      facts = facts_of_path(path)
      if (.not. allocated(error)) call check(error, facts%bytes == 10_int64, "not the new file")
      facts = facts_of_path(temporary)
      if (.not. allocated(error)) call check(error, .not. facts%is_there, "the unfinished file is there")
      call remove_file(path)
   end subroutine complete_file_takes_place

   subroutine lost_bytes_are_noticed(error)
      type(error_type), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(raw_file_t) :: file
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: path
      integer :: i

      path = scratch_path("lost")
      call write_old_file(path)
      do i = 9, 11, 2
         call begin_new_file(place, path, result_kind, raised)
         call write_letters_to(place%temporary, "1234567890")
         call end_new_file(place, int(i, int64), raised)
         call expect_error(error, raised, kind_file, "not all of it reached the disk")
         if (allocated(error)) return
         call check(error, is_earlier(path) .and. .not. allocated(place%temporary), "the earlier file is gone")
         if (allocated(error)) return
      end do
      call create_raw(file, path//"-part", path, raised)
      call append_text(file, "1234567890", raised)
      file%bytes = 12
      call settle_raw(file, raised)
      call remove_file(path//"-part")
      call remove_file(path)
      call expect_error(error, raised, kind_file, "not all of it reached the disk")
   end subroutine lost_bytes_are_noticed

   subroutine dropped_file_leaves_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      type(new_file_t) :: place
      type(error_t), allocatable :: raised
      type(file_facts_t) :: facts
      character(len=:), allocatable :: path, temporary

      path = scratch_path("dropped")
      call write_old_file(path)
      call begin_new_file(place, path, result_kind, raised)
      temporary = place%temporary
      call write_letters_to(temporary, "12345")
      call drop_new_file(place)
      call drop_new_file(place)
      facts = facts_of_path(temporary)
      call check(error, is_earlier(path) .and. .not. facts%is_there, "something is left, or the earlier file is gone")
      call remove_file(path)
      if (allocated(error)) return
      call begin_new_file(place, path//"/none/x", result_kind, raised)
      call expect_error(error, raised, kind_file, "there is no folder")
      if (allocated(error)) return
      call begin_new_file(place, "", result_kind, raised)
      call expect_error(error, raised, kind_usage, "needs a name")
   end subroutine dropped_file_leaves_nothing

   subroutine signals_remove_the_unfinished(error)
      type(error_type), allocatable, intent(out) :: error

      type(new_file_t) :: first, second, third
      type(error_t), allocatable :: raised
      type(file_facts_t) :: facts(3)
      character(len=:), allocatable :: path

      path = scratch_path("signal")
      call begin_new_file(first, path//"1", result_kind, raised)
      call write_letters_to(first%temporary, "1")
      call begin_new_file(second, path//"2", result_kind, raised)
      call write_letters_to(second%temporary, "2")
      call end_new_file(second, 1_int64, raised)
      call begin_new_file(third, path//"3", result_kind, raised)
      call write_letters_to(third%temporary, "3")
      call remove_remembered()
      facts(1) = facts_of_path(first%temporary)
      facts(2) = facts_of_path(path//"2")
      facts(3) = facts_of_path(third%temporary)
      call remove_file(path//"2")
      call check(error, all(facts%is_there .eqv. [.false., .true., .false.]), "others are left than the finished one")
   end subroutine signals_remove_the_unfinished

   subroutine inputs_stay(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(line_t) :: inputs(3)
      character(len=:), allocatable :: path

      path = scratch_path("input")
      inputs(1)%text = path//"-not-there"
      inputs(2)%text = ""
      inputs(3)%text = path
      call write_old_file(path)
      call check_place(path//"-other", result_kind, inputs, raised)
      call check(error, .not. allocated(raised), "another name is refused")
      if (allocated(error)) return
      call check_place(path, result_kind, inputs, raised)
      call expect_error(error, raised, kind_usage, "which is read")
      call remove_file(path)
      if (allocated(error)) return
      call check_place("/", result_kind, inputs, raised)
      call expect_error(error, raised, kind_file, "it is a folder")
   end subroutine inputs_stay

   subroutine other_files_stay(error)
      type(error_type), allocatable, intent(out) :: error

      type(output_kind_t), parameter :: kinds(*) = [result_kind, table_kind, drawing_kind, cam_kind, fmu_kind]
      type(error_t), allocatable :: raised
      type(new_file_t) :: place
      type(line_t) :: none(0)
      character(len=:), allocatable :: path
      integer :: i, k

      path = scratch_path("kinds")
      do i = 1, size(kinds)
         ! The mark without the beginning, the beginning without the mark, both, and a file that is empty
         call write_letters_to(path, " "//trim(kinds(i)%mark))
         call begin_new_file(place, path, kinds(i), raised)
         call expect_error(error, raised, kind_file, "' exists and is no earlier "//trim(kinds(i)%name)//" of camroller")
         call remove_file(path)
         if (allocated(error)) return
         call write_letters_to(path, trim(kinds(i)%beginnings(1)))
         call check_place(path, kinds(i), none, raised)
         call expect_error(error, raised, kind_file, "give another name, or remove it first")
         call remove_file(path)
         if (allocated(error)) return
         call write_letters_to(path, trim(kinds(i)%beginnings(1))//" "//trim(kinds(i)%mark)//"...")
         do k = 1, size(kinds)
            call check_place(path, kinds(k), none, raised)
            call check(error, allocated(raised) .neqv. i == k, trim(kinds(i)%name)//" and "//trim(kinds(k)%name))
            if (allocated(error)) return
         end do
         call remove_file(path)
         call write_letters_to(path, "")
         call check_place(path, kinds(i), none, raised)
         call check(error, .not. allocated(raised), "an empty file is kept")
         call remove_file(path)
         if (allocated(error)) return
      end do
   end subroutine other_files_stay

   subroutine seals_tell_damage(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: letters = "What is written stays as it is, to the last letter; 61 of them."
      type(error_t), allocatable :: raised
      character(len=:), allocatable :: path
      character(len=200) :: content
      integer(int64) :: bytes
      integer :: length, i

      path = scratch_path("sealed")
      do length = 0, len(letters), 7
         call write_letters_to(path, letters(:length))
         call seal_file(path, path, bytes, raised)
         call check(error, .not. allocated(raised), "no seal")
         ! four words behind whole words
         if (.not. allocated(error)) call check(error, bytes == 8*((length + 7)/8) + 32, "a size that is not that of the file")
         if (.not. allocated(error)) call check_seal(path, raised)
         if (.not. allocated(error)) call check(error, .not. allocated(raised), "a whole file is taken for damaged")
         if (allocated(error)) return
         call read_letters_from(path, content, int(bytes))
         do i = 1, int(bytes)
            ! the mark of the seal itself: without it there is none
            if (i > bytes - 32 .and. i <= bytes - 24) cycle
            call remove_file(path)
            call write_letters_to(path, content(:i - 1)//achar(ieor(iachar(content(i:i)), 1))//content(i + 1:bytes))
            call check_seal(path, raised)
            call check(error, allocated(raised), "a changed bit is not noticed")
            if (allocated(error)) return
         end do
         call remove_file(path)
      end do
   end subroutine seals_tell_damage

   !> Is the file that was there before still there, of the length that it had?
   function is_earlier(path) result(verdict)
      !> Its path
      character(len=*), intent(in) :: path
      !> Is it?
      logical :: verdict

      type(file_facts_t) :: facts

      facts = facts_of_path(path)
      verdict = facts%bytes == len(old_content) + 1
   end function is_earlier

   !> Write a file.
   subroutine write_letters_to(path, text)
      !> Its path, and what is to be in it
      character(len=*), intent(in) :: path, text

      type(raw_file_t) :: file
      type(error_t), allocatable :: ignored

      call create_raw(file, path, path, ignored)
      call append_text(file, text, ignored)
      call close_raw(file)
   end subroutine write_letters_to

   !> Read a file.
   subroutine read_letters_from(path, text, length)
      !> Its path
      character(len=*), intent(in) :: path
      !> Gets what is in it
      character(len=*), intent(out) :: text
      !> How many letters are read
      integer, intent(in) :: length

      integer :: unit, status

      text = ""
      open (newunit=unit, file=path, access="stream", form="unformatted", action="read", status="old", iostat=status)
      if (status == 0) read (unit, iostat=status) text(:length)
      if (status == 0) close (unit)
   end subroutine read_letters_from

end module test_new_file
