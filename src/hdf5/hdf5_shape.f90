!> Type, axes and extents of a dataset or an attribute, determined before it is read.
!>
!> In: an open file, names inside it. Out: type of the values, axes, extents; an error where they are not the expected ones.
module camroller_hdf5_shape
   use hdf5, only : hid_t, hsize_t, size_t, h5dclose_f, h5dget_space_f, h5dget_type_f, h5dopen_f, h5sclose_f, &
      & h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5sget_simple_extent_npoints_f, h5tclose_f, h5tget_class_f, &
      & h5tget_size_f, h5tis_variable_str_f, h5t_float_f, h5t_integer_f, h5t_string_f
   use camroller_error, only : error_t, raise, kind_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_status, only : quiet_hdf5, raise_hdf5
   use camroller_library_watch, only : begin_call, end_call
   use camroller_number_text, only : integer_text
   implicit none
   private

   public :: shape_t, of_numbers, of_texts, open_dataset, find_shape, check_rank, check_kind, raise_read

   !> Kinds of values that we read
   integer, parameter :: of_numbers = 1, of_texts = 2, of_others = 3
   !> Largest number that is read [byte]
   integer(size_t), parameter :: largest_number = 8_size_t

   !> What a dataset or an attribute holds
   type :: shape_t
      !> Kind of its values
      integer :: kind = of_others
      !> Does it hold texts of a length that all have? They are not read
      logical :: has_fixed_texts = .false.
      !> Size of one of them in the file [byte]
      integer(size_t) :: bytes = 0
      !> Number of values
      integer(hsize_t) :: count = 0
      !> Extents of its axes, none for a single value
      integer(hsize_t), allocatable :: extents(:)
   end type shape_t

contains

   !> Open a dataset and find out what it holds.
   subroutine open_dataset(file, name, dataset, shape, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> The dataset, to be closed where there is no error
      integer(hid_t), intent(out) :: dataset
      !> What it holds
      type(shape_t), intent(out) :: shape
      !> File error, also where there is no such dataset
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: space, value_type
      integer :: status, ignored

      call quiet_hdf5()
      call begin_call(file%file)
      call h5dopen_f(file%id, name, dataset, status)
      if (status /= 0) then
         call end_call()
         call raise_read(error, file, name)
         return
      end if
      space = -1_hid_t
      value_type = -1_hid_t
      call h5dget_space_f(dataset, space, status)
      if (status == 0) call h5dget_type_f(dataset, value_type, status)
      if (status == 0) call find_shape(space, value_type, shape, status)
      call end_call()
      if (status /= 0) then
         call raise_read(error, file, name)
         call h5dclose_f(dataset, ignored)
      end if
      if (value_type >= 0_hid_t) call h5tclose_f(value_type, ignored)
      if (space >= 0_hid_t) call h5sclose_f(space, ignored)
   end subroutine open_dataset

   !> What a dataset or an attribute holds.
   subroutine find_shape(space, value_type, shape, status)
      !> Its dataspace and its type
      integer(hid_t), intent(in) :: space, value_type
      !> What it holds
      type(shape_t), intent(out) :: shape
      !> 0 where all went well
      integer, intent(out) :: status

      integer(hsize_t), allocatable :: largest(:)
      integer :: rank, class
      logical :: is_variable

      call h5tget_class_f(value_type, class, status)
      if (status == 0) call h5tget_size_f(value_type, shape%bytes, status)
      if (status /= 0) return
      if (class == h5t_string_f) then
         call h5tis_variable_str_f(value_type, is_variable, status)
         if (status /= 0) return
         if (is_variable) shape%kind = of_texts
         shape%has_fixed_texts = .not. is_variable
      else if ((class == h5t_float_f .or. class == h5t_integer_f) .and. shape%bytes <= largest_number) then
         shape%kind = of_numbers
      end if
      call h5sget_simple_extent_npoints_f(space, shape%count, status)
      if (status == 0) call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status /= 0) return
      allocate (shape%extents(rank), largest(rank), source=0_hsize_t)
      if (rank == 0) return
      call h5sget_simple_extent_dims_f(space, shape%extents, largest, status)
      status = merge(0, -1, status == rank)
   end subroutine find_shape

   !> An error where a dataset has other axes than it has to have.
   subroutine check_rank(file, name, shape, rank, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset from the root
      character(len=*), intent(in) :: name
      !> What it holds
      type(shape_t), intent(in) :: shape
      !> Number of axes that it has to have
      integer, intent(in) :: rank
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (size(shape%extents) /= rank) then
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' has "//integer_text(size(shape%extents))// &
            & " axes where a result has "//integer_text(rank))
      else if (rank == 0 .and. shape%count /= 1) then
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' has no value")
      end if
   end subroutine check_rank

   !> An error where a dataset or an attribute holds other values than it has to hold.
   subroutine check_kind(file, name, shape, kind, error)
      !> An open file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the dataset or the attribute
      character(len=*), intent(in) :: name
      !> What it holds
      type(shape_t), intent(in) :: shape
      !> Kind of values that it has to hold
      integer, intent(in) :: kind
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (shape%kind == kind) return
      if (shape%has_fixed_texts) then
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' holds texts of fixed length; those that are read have "// &
            & "a variable one, as of h5py.string_dtype()")
      else
         call raise(error, kind_file, "'"//name//"' of '"//file%file//"' holds no "// &
            & trim(merge("numbers", "texts  ", kind == of_numbers)))
      end if
   end subroutine check_kind

   !> Error of reading an object.
   subroutine raise_read(error, file, name)
      !> The error to allocate
      type(error_t), allocatable, intent(out) :: error
      !> The file
      type(hdf5_object_t), intent(in) :: file
      !> Name of the object from the root
      character(len=*), intent(in) :: name

      call raise_hdf5(error, "cannot read '"//name//"' of '"//file%file//"'")
   end subroutine raise_read

end module camroller_hdf5_shape
