!> Thin layer over HDF5 for writing: files, groups, datasets of numbers and texts.
!>
!> In: plain arrays. Out: objects in a file, errors as values with the file's name and the system's words.
!> Shapes and positions are Fortran's: the first axis is contiguous; C and Python see the axes reversed. Nothing in a
!> file depends on the time of writing: the library's time stamps are off. Closing a file closes all that was opened in
!> it.
module camroller_hdf5_file
   use, intrinsic :: iso_c_binding, only : c_associated, c_f_pointer, c_int, c_int64_t, c_loc, c_null_char, c_ptr
   use hdf5, only : hid_t, hsize_t, h5dcreate_f, h5dget_space_f, h5dwrite_f, h5fclose_f, h5fcreate_f, h5fflush_f, &
      & h5fget_filesize_f, h5gcreate_f, h5oclose_f, h5pclose_f, h5pcopy_f, h5pcreate_f, h5pset_chunk_f, h5pset_deflate_f, &
      & h5pset_fclose_degree_f, h5pset_shuffle_f, h5sclose_f, h5sselect_hyperslab_f, h5f_acc_excl_f, &
      & h5f_close_strong_f, h5f_scope_global_f, h5p_file_access_f, h5p_file_create_f, h5p_default_f, h5p_group_create_f, &
      & h5s_all_f, h5s_select_set_f, h5t_ieee_f64le, h5t_native_double, h5t_native_integer, h5t_std_i32le
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file
   use camroller_hdf5_lists, only : close_lists, object_list, open_lists
   use camroller_hdf5_status, only : raise_hdf5, start_hdf5
   use camroller_hdf5_object, only : hdf5_object_t, member_name, open_space, raise_object
   use camroller_system_file, only : reserve_space, set_file_size, sync_descriptor
   implicit none
   private

   public :: create_file, reserve_file, hand_over_file, flush_file, close_file, discard_file
   public :: create_group, close_object
   public :: create_numbers, create_integers, create_texts
   public :: write_numbers, write_integers, write_text

   !> Write numbers: one, a run of a one-axis dataset, rows of a two-axis dataset, a plane of a three-axis dataset
   interface write_numbers
      module procedure write_number
      module procedure write_run_of_numbers
      module procedure write_rows_of_numbers
      module procedure write_plane_of_numbers
   end interface write_numbers

   !> Write integers
   interface write_integers
      module procedure write_integer
      module procedure write_run_of_integers
   end interface write_integers

   !> Space kept ready for the library's own records [byte]
   integer(c_int64_t), parameter :: spare_space = 524288_c_int64_t

   interface
      function c_get_handle(file, access, address) bind(C, name="H5Fget_vfd_handle") result(status)
         import :: c_int, c_int64_t, c_ptr
         integer(c_int64_t), value :: file, access
         type(c_ptr), intent(out) :: address
         integer(c_int) :: status
      end function c_get_handle
   end interface

contains

   !> Create a file; one of that name must not exist.
   subroutine create_file(file, path, shown, error)
      !> The open file
      type(hdf5_object_t), intent(out) :: file
      !> Where to create it
      character(len=*), intent(in) :: path
      !> What messages call it
      character(len=*), intent(in) :: shown
      !> File error where it cannot be created
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: creation, access
      integer :: status, ignored

      file%name = "/"
      file%file = shown
      call start_hdf5(error)
      if (allocated(error)) return
      call object_list(h5p_file_create_f, .true., creation, status)
      call h5pcreate_f(h5p_file_access_f, access, ignored)
      if (status == 0) call h5pset_fclose_degree_f(access, h5f_close_strong_f, status)
      if (status == 0) call open_lists(file%lists, status)
      if (status == 0) call h5fcreate_f(path, h5f_acc_excl_f, file%id, status, creation, access)
      if (status /= 0) then
         call raise_hdf5(error, "cannot create '"//shown//"'")
         call close_lists(file%lists)
         file%id = -1_hid_t
      end if
      call h5pclose_f(creation, ignored)
      call h5pclose_f(access, ignored)
   end subroutine create_file

   !> Make sure that there is disk space for what comes next. The library does not survive a failed write: it goes astray when it
   !> closes the file or when the program ends. So space is set aside before it is used.
   subroutine reserve_file(file, bytes, error)
      !> An open file
      type(hdf5_object_t), intent(inout) :: file
      !> Size of what comes next [byte]
      real(wp), intent(in) :: bytes
      !> File error where there is no space
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason
      integer(hsize_t) :: extent
      integer(c_int64_t) :: wanted
      integer(c_int) :: descriptor
      integer :: status

      call h5fget_filesize_f(file%id, extent, status)
      call get_descriptor(file, descriptor)
      if (status /= 0 .or. descriptor < 0) return
      wanted = int(extent, c_int64_t) + int(bytes, c_int64_t) + spare_space
      if (wanted <= file%reserved) return
      call reserve_space(descriptor, file%reserved, wanted - file%reserved, reason)
      if (reason == "") then
         file%reserved = wanted
      else
         call raise(error, kind_file, "cannot write '"//file%file//"': "//reason)
      end if
   end subroutine reserve_file

   !> Hand everything written so far over to the system, so that a file of a process that is killed says what it is.
   subroutine hand_over_file(file, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> File error where that fails
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      call h5fflush_f(file%id, h5f_scope_global_f, status)
      if (status /= 0) call raise_hdf5(error, "cannot write '"//file%file//"'")
   end subroutine hand_over_file

   !> Flush everything written so far to disk; space set aside and not used is given back.
   subroutine flush_file(file, error)
      !> An open file
      type(hdf5_object_t), intent(inout) :: file
      !> File error where that fails
      type(error_t), allocatable, intent(out) :: error

      integer(hsize_t) :: extent
      integer(c_int) :: descriptor
      integer :: status
      logical :: done

      call h5fflush_f(file%id, h5f_scope_global_f, status)
      if (status == 0) call h5fget_filesize_f(file%id, extent, status)
      if (status /= 0) then
         call raise_hdf5(error, "cannot write '"//file%file//"'")
         return
      end if
      call get_descriptor(file, descriptor)
      if (descriptor < 0) return
      file%reserved = int(extent, c_int64_t)
      call set_file_size(descriptor, file%reserved, done)
      if (done) call sync_descriptor(descriptor, done)
      if (.not. done) call raise(error, kind_file, "cannot write '"//file%file//"': the write did not reach the disk")
   end subroutine flush_file

   !> Close a file and all that is open in it.
   subroutine close_file(file, error)
      !> An open file
      type(hdf5_object_t), intent(inout) :: file
      !> File error where the last parts cannot be written
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      call h5fclose_f(file%id, status)
      if (status /= 0) call raise_hdf5(error, "cannot write '"//file%file//"'")
      call close_lists(file%lists)
      file%id = -1_hid_t
   end subroutine close_file

   !> Close a file whose content no longer matters.
   subroutine discard_file(file)
      !> A file, open or not
      type(hdf5_object_t), intent(inout) :: file

      integer :: ignored

      if (file%id < 0_hid_t) return
      call h5fclose_f(file%id, ignored)
      call close_lists(file%lists)
      file%id = -1_hid_t
   end subroutine discard_file

   !> The operating system's descriptor of an open file, negative where it has none.
   subroutine get_descriptor(file, descriptor)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      integer(c_int), intent(out) :: descriptor

      type(c_ptr) :: address
      integer(c_int), pointer :: found
      integer :: status

      descriptor = -1
      status = c_get_handle(int(file%id, c_int64_t), int(h5p_default_f, c_int64_t), address)
      if (status /= 0 .or. .not. c_associated(address)) return
      call c_f_pointer(address, found)
      descriptor = found
   end subroutine get_descriptor

   !> Create a group; its members keep the order of their creation.
   subroutine create_group(parent, name, group, error)
      !> File or group to create it in
      type(hdf5_object_t), intent(in) :: parent
      !> Its name
      character(len=*), intent(in) :: name
      !> The open group
      type(hdf5_object_t), intent(out) :: group
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: creation
      integer :: status, ignored

      group%name = member_name(parent, name)
      group%file = parent%file
      group%lists = parent%lists
      call object_list(h5p_group_create_f, .true., creation, status)
      if (status == 0) call h5gcreate_f(parent%id, name, group%id, status, gcpl_id=creation)
      if (status /= 0) call raise_object(error, group)
      call h5pclose_f(creation, ignored)
   end subroutine create_group

   !> Close a group or dataset.
   subroutine close_object(object)
      !> The object, open or not
      type(hdf5_object_t), intent(inout) :: object

      integer :: ignored

      if (object%id >= 0_hid_t) call h5oclose_f(object%id, ignored)
      object%id = -1_hid_t
   end subroutine close_object

   !> Create a dataset of 64-bit reals; what is never written reads as not-a-number.
   subroutine create_numbers(parent, name, extents, chunk, compression, dataset, error)
      !> File or group to create it in
      type(hdf5_object_t), intent(in) :: parent
      !> Its name
      character(len=*), intent(in) :: name
      !> Extents of its axes, none for a single number
      integer, intent(in) :: extents(:)
      !> Extents of a chunk, none for one contiguous block
      integer, intent(in) :: chunk(:)
      !> Deflate level 1 to 9 behind a byte shuffle, 0 for none; needs chunks
      integer, intent(in) :: compression
      !> The open dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call create_dataset(parent, name, h5t_ieee_f64le, extents, chunk, compression, dataset, error)
   end subroutine create_numbers

   !> Create a dataset of 32-bit integers.
   subroutine create_integers(parent, name, extents, dataset, error)
      !> File or group to create it in
      type(hdf5_object_t), intent(in) :: parent
      !> Its name
      character(len=*), intent(in) :: name
      !> Extents of its axes, none for a single number
      integer, intent(in) :: extents(:)
      !> The open dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call create_dataset(parent, name, h5t_std_i32le, extents, [integer ::], 0, dataset, error)
   end subroutine create_integers

   !> Create a dataset of texts of any length; what is never written reads as empty.
   subroutine create_texts(parent, name, extents, dataset, error)
      !> File or group to create it in
      type(hdf5_object_t), intent(in) :: parent
      !> Its name
      character(len=*), intent(in) :: name
      !> Extents of its axes, none for a single text
      integer, intent(in) :: extents(:)
      !> The open dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call create_dataset(parent, name, parent%lists%texts, extents, [integer ::], 0, dataset, error)
   end subroutine create_texts

   !> Write a single number.
   subroutine write_number(dataset, number, error)
      !> A dataset without axes
      type(hdf5_object_t), intent(in) :: dataset
      !> The number [unit of the dataset]
      real(wp), intent(in), target :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call write_block(dataset, h5t_native_double, [integer ::], [integer ::], c_loc(number), error)
   end subroutine write_number

   !> Write a run of numbers.
   subroutine write_run_of_numbers(dataset, first, numbers, error)
      !> A dataset with one axis
      type(hdf5_object_t), intent(in) :: dataset
      !> Position of the first number, from 0
      integer, intent(in) :: first
      !> The numbers [unit of the dataset]
      real(wp), intent(in), target, contiguous :: numbers(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (size(numbers) == 0) return
      call write_block(dataset, h5t_native_double, [first], shape(numbers), c_loc(numbers), error)
   end subroutine write_run_of_numbers

   !> Write whole rows of a dataset with two axes.
   subroutine write_rows_of_numbers(dataset, first, rows, error)
      !> A dataset whose first axis is as long as a row
      type(hdf5_object_t), intent(in) :: dataset
      !> Position of the first row on the second axis, from 0
      integer, intent(in) :: first
      !> The rows, one in each column of the array [unit of the dataset]
      real(wp), intent(in), target, contiguous :: rows(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (size(rows) == 0) return
      call write_block(dataset, h5t_native_double, [0, first], shape(rows), c_loc(rows), error)
   end subroutine write_rows_of_numbers

   !> Write a whole plane of a dataset with three axes.
   subroutine write_plane_of_numbers(dataset, first, plane, axes, error)
      !> A dataset whose first two axes are as long as those of the plane
      type(hdf5_object_t), intent(in) :: dataset
      !> Position of the plane on the third axis, from 0
      integer, intent(in) :: first
      !> The plane [unit of the dataset]
      real(wp), intent(in), target, contiguous :: plane(:, :)
      !> Number of axes, three
      integer, intent(in) :: axes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: extents(axes), corner(axes)

      if (size(plane) == 0) return
      extents = 1
      extents(:2) = shape(plane)
      corner = 0
      corner(axes) = first
      call write_block(dataset, h5t_native_double, corner, extents, c_loc(plane), error)
   end subroutine write_plane_of_numbers

   !> Write a single integer.
   subroutine write_integer(dataset, number, error)
      !> A dataset without axes
      type(hdf5_object_t), intent(in) :: dataset
      integer, intent(in), target :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call write_block(dataset, h5t_native_integer, [integer ::], [integer ::], c_loc(number), error)
   end subroutine write_integer

   !> Write the integers of a dataset.
   subroutine write_run_of_integers(dataset, numbers, error)
      !> A dataset with one axis
      type(hdf5_object_t), intent(in) :: dataset
      integer, intent(in), target, contiguous :: numbers(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (size(numbers) == 0) return
      call write_block(dataset, h5t_native_integer, [0], shape(numbers), c_loc(numbers), error)
   end subroutine write_run_of_integers

   !> Write one text.
   subroutine write_text(dataset, position, text, error)
      !> A dataset of texts
      type(hdf5_object_t), intent(in) :: dataset
      !> Position on each axis, from 0; none for a single text
      integer, intent(in) :: position(:)
      !> The text; blanks at its end are dropped
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable, target :: letters
      type(c_ptr), target :: address(1)

      letters = trim(text)//c_null_char
      address(1) = c_loc(letters)
      call write_block(dataset, dataset%lists%texts, position, spread(1, 1, size(position)), c_loc(address), error)
   end subroutine write_text

   !> Create a dataset of any type.
   subroutine create_dataset(parent, name, value_type, extents, chunk, compression, dataset, error)
      !> File or group to create it in
      type(hdf5_object_t), intent(in) :: parent
      character(len=*), intent(in) :: name
      !> Type of its values
      integer(hid_t), intent(in) :: value_type
      !> Extents of its axes, none for a scalar
      integer, intent(in) :: extents(:)
      !> Extents of a chunk, none for one contiguous block
      integer, intent(in) :: chunk(:)
      !> Deflate level, 0 for none
      integer, intent(in) :: compression
      !> The open dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: shared, creation, access, space
      integer :: status, ignored

      dataset%name = member_name(parent, name)
      dataset%file = parent%file
      dataset%lists = parent%lists
      dataset%extents = extents
      shared = merge(parent%lists%numbers, parent%lists%others, value_type == h5t_ieee_f64le)
      creation = shared
      ! The library copies any list but its own for each dataset
      access = merge(parent%lists%access, h5p_default_f, size(chunk) > 0)
      status = 0
      if (size(chunk) > 0) call h5pcopy_f(shared, creation, status)
      if (status == 0 .and. size(chunk) > 0) call h5pset_chunk_f(creation, size(chunk), int(chunk, hsize_t), status)
      if (status == 0 .and. compression > 0) call h5pset_shuffle_f(creation, status)
      if (status == 0 .and. compression > 0) call h5pset_deflate_f(creation, compression, status)
      call open_space(extents, space, ignored)
      if (status == 0) call h5dcreate_f(parent%id, name, value_type, space, dataset%id, status, creation, dapl_id=access)
      if (status /= 0) call raise_object(error, dataset)
      call h5sclose_f(space, ignored)
      if (size(chunk) > 0) call h5pclose_f(creation, ignored)
   end subroutine create_dataset

   !> Write a block of a dataset.
   subroutine write_block(dataset, memory_type, first, extents, address, error)
      type(hdf5_object_t), intent(in) :: dataset
      !> Type of the values in memory
      integer(hid_t), intent(in) :: memory_type
      !> Position of the block on each axis, from 0; none for a scalar
      integer, intent(in) :: first(:)
      !> Extents of the block
      integer, intent(in) :: extents(:)
      !> Where the values are
      type(c_ptr), intent(in) :: address
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: file_space, memory_space
      integer :: status, ignored

      if (all(extents == dataset%extents)) then
         call h5dwrite_f(dataset%id, memory_type, address, status, h5s_all_f, h5s_all_f, dataset%lists%transfer)
      else
         call h5dget_space_f(dataset%id, file_space, status)
         call open_space(extents, memory_space, ignored)
         if (status == 0) call h5sselect_hyperslab_f(file_space, h5s_select_set_f, int(first, hsize_t), &
            & int(extents, hsize_t), status)
         if (status == 0) call h5dwrite_f(dataset%id, memory_type, address, status, memory_space, file_space, &
            & dataset%lists%transfer)
         call h5sclose_f(memory_space, ignored)
         call h5sclose_f(file_space, ignored)
      end if
      if (status /= 0) call raise_object(error, dataset)
   end subroutine write_block

end module camroller_hdf5_file
