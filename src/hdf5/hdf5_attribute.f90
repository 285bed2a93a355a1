!> HDF5 attributes and dimension scales that the program writes.
!>
!> In: open objects. Out: attributes with one value; dimensions after the HDF5 Dimension Scale Specification,
!> which is what netCDF-4 files use.
module camroller_hdf5_attribute
   use, intrinsic :: iso_c_binding, only : c_loc, c_null_char, c_ptr
   use hdf5, only : hid_t, h5aclose_f, h5acreate_f, h5awrite_f, h5t_ieee_f64le, h5t_native_double, h5t_native_integer, &
      & h5t_std_i32le
   use h5ds, only : h5dsattach_scale_f, h5dsset_scale_f
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_hdf5_object, only : hdf5_object_t, raise_object
   implicit none
   private

   public :: put_attribute, describe, make_scale, attach_scale

   !> Attribute of a file, group or dataset
   interface put_attribute
      module procedure put_text
      module procedure put_real
      module procedure put_integer
   end interface put_attribute

contains

   !> Give an object an attribute that is a text.
   subroutine put_text(object, name, text, error)
      !> File, group or dataset
      type(hdf5_object_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The text; blanks at its end are dropped
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable, target :: letters
      type(c_ptr), target :: address(1)

      letters = trim(text)//c_null_char
      address(1) = c_loc(letters)
      call put_scalar(object, name, object%lists%texts, object%lists%texts, c_loc(address), error)
   end subroutine put_text

   !> Give an object an attribute that is a real.
   subroutine put_real(object, name, number, error)
      !> File, group or dataset
      type(hdf5_object_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The number [unit as the name says]
      real(wp), intent(in), target :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call put_scalar(object, name, h5t_ieee_f64le, h5t_native_double, c_loc(number), error)
   end subroutine put_real

   !> Give an object an attribute that is an integer.
   subroutine put_integer(object, name, number, error)
      !> File, group or dataset
      type(hdf5_object_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      integer, intent(in), target :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call put_scalar(object, name, h5t_std_i32le, h5t_native_integer, c_loc(number), error)
   end subroutine put_integer

   !> Attributes that say what a dataset is.
   subroutine describe(dataset, unit, meaning, source, error, scope)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> Unit of its values; meaning in a few words; part of the model that it comes from
      character(len=*), intent(in) :: unit, meaning, source
      !> File error
      type(error_t), allocatable, intent(out) :: error
      !> What it belongs to: a lobe, the camshaft or the case
      character(len=*), intent(in), optional :: scope

      call put_text(dataset, "units", unit, error)
      if (.not. allocated(error)) call put_text(dataset, "long_name", meaning, error)
      if (.not. allocated(error)) call put_text(dataset, "source", source, error)
      if (.not. allocated(error) .and. present(scope)) call put_text(dataset, "scope", scope, error)
   end subroutine describe

   !> Make a dataset with one axis a dimension, named as the dataset.
   subroutine make_scale(dataset, error)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      call h5dsset_scale_f(dataset%id, status, dataset%name(index(dataset%name, "/", back=.true.) + 1:))
      if (status /= 0) call raise_object(error, dataset)
   end subroutine make_scale

   !> Say which dimension an axis of a dataset runs along.
   subroutine attach_scale(dataset, scale, axis, axes, error)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> The dimension
      type(hdf5_object_t), intent(in) :: scale
      !> The axis, from 1, the first one contiguous
      integer, intent(in) :: axis
      !> Number of axes of the dataset
      integer, intent(in) :: axes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: status

      ! This wrapper counts axes from 1, but in the order of C
      call h5dsattach_scale_f(dataset%id, scale%id, axes - axis + 1, status)
      if (status /= 0) call raise_object(error, dataset)
   end subroutine attach_scale

   !> Create and write an attribute with one value.
   subroutine put_scalar(object, name, file_type, memory_type, address, error)
      !> File, group or dataset
      type(hdf5_object_t), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Type in the file
      integer(hid_t), intent(in) :: file_type
      !> Type in memory
      integer(hid_t), intent(in) :: memory_type
      !> Where the value is
      type(c_ptr), intent(in) :: address
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(hid_t) :: attribute
      integer :: status, ignored

      attribute = -1_hid_t
      call h5acreate_f(object%id, name, file_type, object%lists%one_value, attribute, status)
      if (status == 0) call h5awrite_f(attribute, memory_type, address, status)
      if (status /= 0) call raise_object(error, object)
      if (attribute >= 0_hid_t) call h5aclose_f(attribute, ignored)
   end subroutine put_scalar

end module camroller_hdf5_attribute
