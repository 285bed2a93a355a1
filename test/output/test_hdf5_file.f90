!> Tests of the HDF5 layer: what is written comes back, what cannot be read is told.
module test_hdf5_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : close_file, create_file, create_group, create_integers, create_numbers, create_texts, &
      & discard_file, write_integers, write_numbers, write_text
   use camroller_hdf5_attribute, only : put_attribute
   use camroller_hdf5_read, only : has_member, is_text_dataset, list_members, member_length, open_file, read_extents, &
      & read_integer_attribute, read_numbers, read_text, read_text_attribute
   use camroller_system_file, only : remove_file
   use sample_result, only : expect_error, scratch_path, write_old_file
   implicit none
   private

   public :: collect_hdf5_file

contains

   !> All tests of this suite.
   subroutine collect_hdf5_file(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("numbers come back to the last bit, unwritten ones as not-a-number", numbers_come_back), &
         new_unittest("a block of more values than 32 bits count is refused, not taken for none", large_block_is_told), &
         new_unittest("compressed numbers come back to the last bit", compressed_numbers_come_back), &
         new_unittest("texts of any length come back, unwritten ones as empty", texts_come_back), &
         new_unittest("attributes come back", attributes_come_back), &
         new_unittest("members are listed in the order of their creation", members_keep_their_order), &
         new_unittest("a member whose name is too long is told, not cut", long_name_is_told), &
         new_unittest("a file that exists is not overwritten", existing_file_is_kept), &
         new_unittest("a missing file is told", missing_file_is_told), &
         new_unittest("a file of another format is told", other_format_is_told), &
         new_unittest("a file that was cut is told", cut_file_is_told), &
         new_unittest("what is not in the file is told by name", missing_objects_are_told) &
         ]
   end subroutine collect_hdf5_file

   subroutine numbers_come_back(error)
      type(error_type), allocatable, intent(out) :: error

      call check_numbers(error, "numbers", [integer ::], 0)
   end subroutine numbers_come_back

   !> In a file that is being written, whose size tells nothing: 65536 rows of 65536 are no values in 32 bits.
   subroutine large_block_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, dataset
      real(wp), allocatable :: numbers(:)
      character(len=:), allocatable :: path

      path = scratch_path("large_block")
      call create_file(file, path, path, raised)
      call create_numbers(file, "rows", [3, 4], [integer ::], 0, dataset, raised)
      call read_numbers(file, "/rows", [0, 0], [65536, 65536], numbers, raised)
      call discard_file(file)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "'/rows'")
   end subroutine large_block_is_told

   subroutine compressed_numbers_come_back(error)
      type(error_type), allocatable, intent(out) :: error

      call check_numbers(error, "compressed", [3, 2], 1)
   end subroutine compressed_numbers_come_back

   !> Write rows, a run, a single number and integers; read them back.
   subroutine check_numbers(error, name, chunk, compression)
      type(error_type), allocatable, intent(out) :: error
      !> Name of the scratch file
      character(len=*), intent(in) :: name
      !> Chunk of the rows
      integer, intent(in) :: chunk(:)
      !> Deflate level of the rows
      integer, intent(in) :: compression

      real(wp), parameter :: rows(3, 2) = reshape([0.1_wp, 1.0_wp/3.0_wp, -0.0_wp, tiny(1.0_wp), huge(1.0_wp), 5.0_wp], [3, 2])
      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, dataset
      real(wp), allocatable :: again(:)
      integer, allocatable :: extents(:)
      character(len=:), allocatable :: path

      path = scratch_path(name)
      call create_file(file, path, path, raised)
      call create_numbers(file, "rows", [3, 4], chunk, compression, dataset, raised)
      call write_numbers(dataset, 1, rows, raised)
      call create_numbers(file, "run", [3], [integer ::], 0, dataset, raised)
      call write_numbers(dataset, 0, rows(:, 2), raised)
      call create_numbers(file, "one", [integer ::], [integer ::], 0, dataset, raised)
      call write_numbers(dataset, rows(1, 1), raised)
      call create_integers(file, "integers", [2], dataset, raised)
      call write_integers(dataset, [huge(1), -3], raised)
      call close_file(file, raised)
      call check(error, .not. allocated(raised), "cannot write")
      if (allocated(error)) return

      call open_file(file, path, raised)
      call read_extents(file, "/rows", 2, extents, raised)
      call check(error, all(extents == [3, 4]), "other extents")
      call read_numbers(file, "/rows", [0, 1], [3, 2], again, raised)
      if (.not. allocated(error)) call check(error, same_bits(again, reshape(rows, [6])), "other rows")
      call read_numbers(file, "/rows", [0, 3], [3, 1], again, raised)
      if (.not. allocated(error)) call check(error, all(ieee_is_nan(again)), "numbers that were not written")
      call read_numbers(file, "/run", [0], [3], again, raised)
      if (.not. allocated(error)) call check(error, same_bits(again, rows(:, 2)), "another run")
      call read_numbers(file, "/one", [integer ::], [integer ::], again, raised)
      if (.not. allocated(error)) call check(error, same_bits(again, rows(1:1, 1)), "another number")
      call read_numbers(file, "/integers", [0], [2], again, raised)
      if (.not. allocated(error)) call check(error, all(nint(again) == [huge(1), -3]), "other integers")
      call discard_file(file)
      call remove_file(path)
      if (.not. allocated(error)) call check(error, .not. allocated(raised), "cannot read")
   end subroutine check_numbers

   !> Whether numbers agree to the last bit.
   pure function same_bits(some, others) result(answer)
      !> Numbers
      real(wp), intent(in) :: some(:)
      !> Other numbers
      real(wp), intent(in) :: others(:)
      !> True where all bits agree
      logical :: answer

      answer = size(some) == size(others)
      if (answer) answer = all(transfer(some, [0]) == transfer(others, [0]))
   end function same_bits

   subroutine texts_come_back(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: long = repeat("0123456789"//new_line("a"), 5000)
      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, dataset
      character(len=:), allocatable :: path, one, many, none

      path = scratch_path("texts")
      call create_file(file, path, path, raised)
      call create_texts(file, "one", [integer ::], dataset, raised)
      call write_text(dataset, [integer ::], long, raised)
      call create_texts(file, "many", [3], dataset, raised)
      call write_text(dataset, [1], "blanks at the end go   ", raised)
      call close_file(file, raised)
      call open_file(file, path, raised)
      call check(error, is_text_dataset(file, "/one"), "not taken for a text")
      call read_text(file, "/one", [integer ::], one, raised)
      call read_text(file, "/many", [1], many, raised)
      call read_text(file, "/many", [2], none, raised)
      call discard_file(file)
      call remove_file(path)
      if (.not. allocated(error)) call check(error, one == long, "another long text")
      if (.not. allocated(error)) call check(error, len(one), len(long))
      if (.not. allocated(error)) call check(error, many, "blanks at the end go")
      if (.not. allocated(error)) call check(error, none, "")
   end subroutine texts_come_back

   subroutine attributes_come_back(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, group
      character(len=:), allocatable :: path, text
      integer :: number

      path = scratch_path("attributes")
      call create_file(file, path, path, raised)
      call create_group(file, "group", group, raised)
      call put_attribute(group, "text", "N m", raised)
      call put_attribute(group, "empty", "", raised)
      call put_attribute(group, "real", 0.1_wp, raised)
      call put_attribute(file, "number", -7, raised)
      call close_file(file, raised)
      call open_file(file, path, raised)
      call read_text_attribute(file, "/group", "text", text, raised)
      call check(error, text, "N m")
      call read_text_attribute(file, "/group", "empty", text, raised)
      if (.not. allocated(error)) call check(error, text, "")
      call read_integer_attribute(file, "/", "number", number, raised)
      if (.not. allocated(error)) call check(error, number, -7)
      call discard_file(file)
      call remove_file(path)
      if (.not. allocated(error)) call check(error, .not. allocated(raised), "cannot read")
   end subroutine attributes_come_back

   subroutine members_keep_their_order(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, group, inner
      character(len=member_length), allocatable :: names(:)
      character(len=:), allocatable :: path

      path = scratch_path("members")
      call create_file(file, path, path, raised)
      call create_group(file, "group", group, raised)
      call create_group(group, "zebra", inner, raised)
      call create_group(group, "ant", inner, raised)
      call create_group(group, "mouse", inner, raised)
      call close_file(file, raised)
      call open_file(file, path, raised)
      call list_members(file, "/group", names, raised)
      call check(error, has_member(file, "/group/ant"), "a member is not found")
      if (.not. allocated(error)) call check(error, .not. has_member(file, "/group/bee"), "a member too many")
      if (.not. allocated(error)) call check(error, .not. has_member(file, "/other/bee"), "a group too many")
      call discard_file(file)
      call remove_file(path)
      if (.not. allocated(error)) call check(error, size(names), 3)
      if (allocated(error)) return
      call check(error, all(names == [character(len=member_length) :: "zebra", "ant", "mouse"]), "another order")
   end subroutine members_keep_their_order

   subroutine long_name_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, inner
      character(len=member_length), allocatable :: names(:)
      character(len=:), allocatable :: path
      integer :: more

      do more = 0, 1
         path = scratch_path("long_name")
         call create_file(file, path, path, raised)
         call create_group(file, repeat("x", member_length + more), inner, raised)
         call close_file(file, raised)
         call open_file(file, path, raised)
         call list_members(file, "/", names, raised)
         call discard_file(file)
         call remove_file(path)
         if (more == 1) exit
         call check(error, .not. allocated(raised), "the longest name that can be listed")
         if (allocated(error)) return
         call check(error, names(1) == repeat("x", member_length), "it is another")
         if (allocated(error)) return
      end do
      call expect_error(error, raised, kind_file, "has 129 letters, more than 128")
   end subroutine long_name_is_told

   subroutine existing_file_is_kept(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("existing")
      call write_old_file(path)
      call create_file(file, path, "the file", raised)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "cannot create 'the file': ")
   end subroutine existing_file_is_kept

   subroutine missing_file_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file

      call open_file(file, "no/such.h5", raised)
      call expect_error(error, raised, kind_file, "cannot read 'no/such.h5': no such file")
   end subroutine missing_file_is_told

   subroutine other_format_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path

      path = scratch_path("other")
      call write_old_file(path)
      call open_file(file, path, raised)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "it is not an HDF5 file")
   end subroutine other_format_is_told

   subroutine cut_file_is_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file, dataset
      character(len=:), allocatable :: path, bytes
      integer :: unit, length

      path = scratch_path("cut")
      call create_file(file, path, path, raised)
      call create_numbers(file, "run", [1000], [integer ::], 0, dataset, raised)
      call write_numbers(dataset, 0, spread(1.0_wp, 1, 1000), raised)
      call close_file(file, raised)
      open (newunit=unit, file=path, access="stream", form="unformatted", action="read")
      inquire (unit=unit, size=length)
      bytes = repeat(" ", length/2)
      read (unit) bytes
      close (unit)
      open (newunit=unit, file=path, access="stream", form="unformatted", action="write", status="replace")
      write (unit) bytes
      close (unit)
      call open_file(file, path, raised)
      call discard_file(file)
      call remove_file(path)
      call expect_error(error, raised, kind_file, "it seems damaged")
   end subroutine cut_file_is_told

   subroutine missing_objects_are_told(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised
      type(hdf5_object_t) :: file
      character(len=:), allocatable :: path, text
      real(wp), allocatable :: numbers(:)

      path = scratch_path("objects")
      call create_file(file, path, "the file", raised)
      call read_numbers(file, "/none", [0], [1], numbers, raised)
      call expect_error(error, raised, kind_file, "cannot read '/none' of 'the file'")
      call read_text_attribute(file, "/", "none", text, raised)
      if (.not. allocated(error)) call expect_error(error, raised, kind_file, "has no attribute 'none'")
      call discard_file(file)
      call remove_file(path)
   end subroutine missing_objects_are_told

end module test_hdf5_file
