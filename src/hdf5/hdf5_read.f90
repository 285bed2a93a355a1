!> Thin layer over HDF5 for reading back what we wrote.
!>
!> In: a path, names inside the file. Out: numbers, texts, names of members; errors as values that tell a
!> missing file, a file of another format and a damaged file apart. Shapes are Fortran's, as in `camroller_hdf5_file`.
!> A file may come from anywhere: type, axes and extents of an object are compared with what is asked for, and its size with what a
!> file of that size can hold, before anything is read or room for it is made.
module camroller_hdf5_read
   use, intrinsic :: iso_c_binding, only : c_associated, c_loc, c_null_ptr, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use hdf5, only : hid_t, hsize_t, size_t, h5aclose_f, h5aexists_by_name_f, h5aget_space_f, h5aget_type_f, &
      & h5aopen_by_name_f, h5aread_f, h5dclose_f, h5dget_space_f, h5dget_storage_size_f, h5dread_f, h5dvlen_reclaim_f, &
      & h5fis_hdf5_f, h5fopen_f, h5gclose_f, h5gget_info_f, h5gopen_f, h5lexists_f, h5lget_name_by_idx_f, h5sclose_f, &
      & h5sselect_hyperslab_f, h5tclose_f, h5f_acc_rdonly_f, h5p_default_f, h5s_select_set_f, h5t_native_double, &
      & h5t_native_integer, h5_index_crt_order_f, h5_index_name_f, h5_iter_inc_f
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file
   use camroller_file_facts, only : facts_of_path, file_facts_t, kind_in_words
   use camroller_hdf5_status, only : quiet_hdf5, raise_hdf5, start_hdf5
   use camroller_hdf5_lists, only : open_text_type
   use camroller_hdf5_object, only : hdf5_object_t, open_space
   use camroller_hdf5_shape, only : check_kind, check_rank, find_shape, of_numbers, of_texts, open_dataset, raise_read, shape_t
   use camroller_library_watch, only : begin_call, end_call
   use camroller_number_text, only : integer_text
   use camroller_seal, only : check_seal
   use camroller_system_file, only : text_at_address
   implicit none
   private

   public :: member_length, open_file, has_member, list_members, read_extents, check_extents, is_text_dataset
   public :: read_numbers, read_text, read_text_attribute, read_integer_attribute

   !> Longest name of a member that can be listed
   integer, parameter :: member_length = 128
   !> Letters of a longer name that a message shows
   integer, parameter :: shown_letters = 32
   !> Most bytes that deflate makes of one, and most that a link in a group takes at least
   integer, parameter :: largest_ratio = 1032, smallest_link = 8
contains

   !> Open a file for reading.
   subroutine open_file(file, path, error)
      !> The open file
      type(hdf5_object_t), intent(out) :: file
      !> Its path
      character(len=*), intent(in) :: path
      !> File error: missing, not HDF5, damaged
      type(error_t), allocatable, intent(out) :: error

      type(file_facts_t) :: facts
      logical :: is_hdf5
      integer :: status

      file%name = "/"
      file%file = path
      facts = facts_of_path(path)
      if (.not. facts%is_there) then
         call raise(error, kind_file, "cannot read '"//path//"': no such file")
         return
      else if (.not. facts%is_regular) then
         call raise(error, kind_file, "cannot read '"//path//"': it is "//kind_in_words(facts))
         return
      end if
      file%bytes = facts%bytes
      call start_hdf5(error)
      if (allocated(error)) return
      call begin_call(path)
      call h5fis_hdf5_f(path, is_hdf5, status)
      call end_call()
      if (status /= 0 .or. .not. is_hdf5) then
         call raise(error, kind_file, "cannot read '"//path//"': it is not an HDF5 file")
         return
      end if
      call check_seal(path, error)
      if (allocated(error)) return
      call begin_call(path)
      call h5fopen_f(path, h5f_acc_rdonly_f, file%id, status)
      call end_call()
      if (status /= 0) then
         call raise_hdf5(error, "cannot read '"//path//"', it seems damaged")
         file%id = -1_hid_t
      end if
   end subroutine open_file

   !> Whether a name inside the file leads to an object.
   function has_member(file, name, attribute) result(answer)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name from the root, e.g. `/series/traction`
      character(len=*), intent(in) :: name
      !> Name of an attribute that it is to have
      character(len=*), intent(in), optional :: attribute
      !> True where every part of the name exists
      logical :: answer

      integer :: status

      call quiet_hdf5()
      call begin_call(file%file)
      if (present(attribute)) then
         call h5aexists_by_name_f(file%id, name, attribute, answer, status)
      else
         call h5lexists_f(file%id, name, answer, status)
      end if
      call end_call()
      if (status /= 0) answer = .false.
   end function has_member

   !> Names in a group in the order in which they were created; by the alphabet where the file does not keep that order.
   subroutine list_members(file, group, names, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the group from the root
      character(len=*), intent(in) :: group
      !> Names of its members
      character(len=member_length), allocatable, intent(out) :: names(:)
      !> File error, also where a name is too long
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: id
      character(len=shown_letters) :: beginning
      ! Letters of a name
      integer(size_t) :: letters
      integer :: status, ignored, storage, count, highest, order, i

      count = 0
      call quiet_hdf5()
      call begin_call(file%file)
      call h5gopen_f(file%id, group, id, status)
      if (status == 0) then
         call h5gget_info_f(id, storage, count, highest, status)
         call h5gclose_f(id, ignored)
      end if
      call end_call()
      if (count < 0 .or. count > file%bytes/smallest_link) then
         call raise(error, kind_file, "'"//group//"' of '"//file%file//"' cannot have so many members: the file is too small")
         return
      end if
      allocate (names(count))
      order = h5_index_crt_order_f
      do i = 1, count
         if (status /= 0) exit
         names(i) = ""
         call begin_call(file%file)
         call h5lget_name_by_idx_f(file%id, group, order, h5_iter_inc_f, int(i - 1, hsize_t), names(i), status, letters)
         if (status /= 0 .and. i == 1) then
            order = h5_index_name_f
            call h5lget_name_by_idx_f(file%id, group, order, h5_iter_inc_f, int(i - 1, hsize_t), names(i), status, letters)
         end if
         call end_call()
         if (status == 0 .and. letters > member_length) then
            beginning = names(i) (:shown_letters)
            call raise(error, kind_file, "cannot list '"//group//"' of '"//file%file//"': the name that begins with '"// &
               & beginning//"' has "//integer_text(int(letters))//" letters, more than "//integer_text(member_length))
            return
         end if
      end do
      if (status /= 0) call raise_hdf5(error, "cannot list '"//group//"' of '"//file%file//"'")
   end subroutine list_members

   !> Extents of a dataset all of whose values are there.
   subroutine read_extents(file, name, rank, extents, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Number of axes that it has to have
      integer, intent(in) :: rank
      !> Their extents
      integer, allocatable, intent(out) :: extents(:)
      !> File error, also where it has other axes or fewer values than it says
      type(error_t), allocatable, intent(out) :: error

      type(shape_t) :: shape
      integer(hid_t) :: dataset
      integer(hsize_t) :: stored
      integer :: status, ignored

      call open_dataset(file, name, dataset, shape, error)
      if (.not. allocated(error)) call check_rank(file, name, shape, rank, error)
      if (allocated(error)) return
      call h5dget_storage_size_f(dataset, stored, status)
      call h5dclose_f(dataset, ignored)
      if (status /= 0 .or. any(shape%extents > huge(1)) .or. real(shape%count, wp)*real(shape%bytes, wp) > &
         & real(stored, wp)*largest_ratio .or. stored > file%bytes) then
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' is damaged: it has fewer values than its size says")
         return
      end if
      extents = int(shape%extents)
   end subroutine read_extents

   !> An error where a dataset has other extents than those of the datasets beside it.
   subroutine check_extents(file, name, extents, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Extents that it has to have
      integer, intent(in) :: extents(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(shape_t) :: shape
      integer(hid_t) :: dataset
      integer :: ignored

      call open_dataset(file, name, dataset, shape, error)
      if (allocated(error)) return
      call h5dclose_f(dataset, ignored)
      call check_rank(file, name, shape, size(extents), error)
      if (allocated(error)) return
      if (any(shape%extents /= extents)) call raise(error, kind_file, "'"//name//"' of '"//file%file// &
         & "' does not have as many values as those beside it")
   end subroutine check_extents

   !> Whether a dataset holds texts.
   function is_text_dataset(file, name) result(answer)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> False for numbers, and where there is no such dataset
      logical :: answer

      type(shape_t) :: shape
      type(error_t), allocatable :: error
      integer(hid_t) :: dataset
      integer :: ignored

      call open_dataset(file, name, dataset, shape, error)
      answer = .not. allocated(error)
      if (.not. answer) return
      answer = shape%kind == of_texts
      call h5dclose_f(dataset, ignored)
   end function is_text_dataset

   !> Read a block of numbers; integers are converted.
   subroutine read_numbers(file, name, first, extents, numbers, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Position of the block on each axis, from 0; none for a scalar
      integer, intent(in) :: first(:)
      !> Extents of the block
      integer, intent(in) :: extents(:)
      !> The numbers, first axis fastest [unit of the dataset]
      real(wp), allocatable, target, intent(out) :: numbers(:)
      !> File error, also where the dataset holds no numbers, has other axes or no such block
      type(error_t), allocatable, intent(out) :: error

      ! Most values that the block can have [-]
      real(wp) :: most
      integer :: status

      ! a file that is being written has no size yet
      most = real(huge(1), wp)
      if (file%bytes > 0) most = real(file%bytes, wp)*largest_ratio
      if (product(real(extents, wp)) > most) then
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' cannot have so many values: the file is too small")
         return
      end if
      allocate (numbers(product(int(extents, int64))), stat=status)
      if (status /= 0) then
         call raise(error, kind_file, "there is no memory for '"//name//"' of '"//file%file//"'")
      else if (all(extents > 0)) then
         call read_block(file, name, of_numbers, h5t_native_double, first, extents, c_loc(numbers), error)
      end if
   end subroutine read_numbers

   !> Read one text.
   subroutine read_text(file, name, position, text, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Position on each axis, from 0; none for a single text
      integer, intent(in) :: position(:)
      !> The text
      character(len=:), allocatable, intent(out) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(c_ptr), target :: address(1)
      integer(hid_t) :: text_type
      integer :: status, ignored

      text = ""
      address(1) = c_null_ptr
      call open_text_type(text_type, status)
      if (status /= 0) then
         call raise_read(error, file, name)
         return
      end if
      call read_block(file, name, of_texts, text_type, position, spread(1, 1, size(position)), c_loc(address), error)
      if (.not. allocated(error)) call take_text(address, text_type, text)
      call h5tclose_f(text_type, ignored)
   end subroutine read_text

   !> Read an attribute that is a text.
   subroutine read_text_attribute(file, object, name, text, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object from the root
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The text
      character(len=:), allocatable, intent(out) :: text
      !> File error, also where there is no such attribute
      type(error_t), allocatable, intent(out) :: error

      type(c_ptr), target :: address(1)
      integer(hid_t) :: text_type
      integer :: status, ignored

      text = ""
      address(1) = c_null_ptr
      call open_text_type(text_type, status)
      if (status /= 0) then
         call raise_read(error, file, object)
         return
      end if
      call read_attribute(file, object, name, of_texts, text_type, c_loc(address), error)
      if (.not. allocated(error)) call take_text(address, text_type, text)
      call h5tclose_f(text_type, ignored)
   end subroutine read_text_attribute

   !> Read an attribute that is an integer.
   subroutine read_integer_attribute(file, object, name, number, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object from the root
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The number
      integer, intent(out) :: number
      !> File error, also where there is no such attribute
      type(error_t), allocatable, intent(out) :: error

      integer, target :: value

      value = 0
      call read_attribute(file, object, name, of_numbers, h5t_native_integer, c_loc(value), error)
      number = value
   end subroutine read_integer_attribute

   !> Read a block of a dataset.
   subroutine read_block(file, name, kind, memory_type, first, extents, address, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> Kind of its values
      integer, intent(in) :: kind
      !> Type of the values in memory
      integer(hid_t), intent(in) :: memory_type
      !> Position of the block on each axis, from 0; none for a scalar
      integer, intent(in) :: first(:)
      !> Extents of the block
      integer, intent(in) :: extents(:)
      !> Where the values go
      type(c_ptr), intent(in) :: address
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(c_ptr) :: target_address
      type(shape_t) :: shape
      integer(hid_t) :: dataset, file_space, memory_space
      integer :: status, ignored

      target_address = address
      call open_dataset(file, name, dataset, shape, error)
      if (allocated(error)) return
      call check_rank(file, name, shape, size(first), error)
      if (.not. allocated(error)) call check_kind(file, name, shape, kind, error)
      if (.not. allocated(error)) then
         if (any(first < 0 .or. first + int(extents, hsize_t) > shape%extents)) call raise(error, kind_file, "'"//name// &
            & "' of '"//file%file//"' has fewer values than the rest of the file")
      end if
      if (.not. allocated(error)) then
         call open_space(extents, memory_space, ignored)
         call h5dget_space_f(dataset, file_space, status)
         if (status == 0 .and. size(first) > 0) then
            call h5sselect_hyperslab_f(file_space, h5s_select_set_f, int(first, hsize_t), int(extents, hsize_t), status)
         end if
         call begin_call(file%file)
         if (status == 0) call h5dread_f(dataset, memory_type, target_address, status, memory_space, file_space)
         call end_call()
         if (status /= 0) call raise_read(error, file, name)
         call h5sclose_f(memory_space, ignored)
         call h5sclose_f(file_space, ignored)
      end if
      call h5dclose_f(dataset, ignored)
   end subroutine read_block

   !> Read an attribute with one value.
   subroutine read_attribute(file, object, name, kind, memory_type, address, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object from the root
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Kind of its value
      integer, intent(in) :: kind
      !> Type of the value in memory
      integer(hid_t), intent(in) :: memory_type
      !> Where the value goes
      type(c_ptr), intent(in) :: address
      !> File error, also where there is no such attribute
      type(error_t), allocatable, intent(out) :: error

      if (.not. has_member(file, object, name)) then
         call raise(error, kind_file, "'"//object//"' of '"//file%file//"' has no attribute '"//name//"'")
         return
      end if
      call begin_call(file%file)
      call read_value(file, object, name, kind, memory_type, address, error)
      call end_call()
   end subroutine read_attribute

   !> Read the value of an attribute that is there.
   subroutine read_value(file, object, name, kind, memory_type, address, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object from the root, and of the attribute
      character(len=*), intent(in) :: object, name
      !> Kind of its value
      integer, intent(in) :: kind
      !> Type of the value in memory
      integer(hid_t), intent(in) :: memory_type
      !> Where the value goes
      type(c_ptr), intent(in) :: address
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(c_ptr) :: target_address
      type(shape_t) :: shape
      integer(hid_t) :: attribute, space, value_type
      integer :: status, ignored
      ! What messages call the attribute
      character(len=:), allocatable :: shown

      shown = object//":"//name
      target_address = address
      space = -1_hid_t
      value_type = -1_hid_t
      call h5aopen_by_name_f(file%id, object, name, attribute, status)
      if (status /= 0) then
         call raise_read(error, file, shown)
         return
      end if
      call h5aget_space_f(attribute, space, status)
      if (status == 0) call h5aget_type_f(attribute, value_type, status)
      if (status == 0) call find_shape(space, value_type, shape, status)
      if (status == 0) then
         call check_kind(file, shown, shape, kind, error)
         if (.not. allocated(error) .and. shape%count /= 1) call raise(error, kind_file, "'"//shown//"' of '"//file%file// &
            & "' is not one value")
         if (.not. allocated(error)) call h5aread_f(attribute, memory_type, target_address, status)
      end if
      if (status /= 0) call raise_read(error, file, shown)
      if (value_type >= 0_hid_t) call h5tclose_f(value_type, ignored)
      if (space >= 0_hid_t) call h5sclose_f(space, ignored)
      call h5aclose_f(attribute, ignored)
   end subroutine read_value

   !> Copy a text that the library allocated, and give its memory back.
   subroutine take_text(address, text_type, text)
      !> Where the library put the address of the text
      type(c_ptr), target, intent(inout) :: address(1)
      !> Type of the text
      integer(hid_t), intent(in) :: text_type
      !> The copy
      character(len=:), allocatable, intent(out) :: text

      type(c_ptr) :: buffer
      integer(hid_t) :: space
      integer :: ignored

      text = ""
      if (.not. c_associated(address(1))) return
      call text_at_address(address(1), text)
      call open_space([1], space, ignored)
      buffer = c_loc(address)
      call h5dvlen_reclaim_f(text_type, space, h5p_default_f, buffer, ignored)
      call h5sclose_f(space, ignored)
   end subroutine take_text

end module camroller_hdf5_read
