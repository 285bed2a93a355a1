!> Common parts of all HDF5 objects: handle, names, the error of a failed write.
!>
!> In: extents. Out: `hdf5_object_t` and helpers that the modules for files, attributes and reading share.
module camroller_hdf5_object
   use, intrinsic :: iso_c_binding, only : c_int64_t
   use hdf5, only : hid_t, hsize_t, h5screate_f, h5screate_simple_f, h5s_scalar_f
   use camroller_error, only : error_t
   use camroller_hdf5_lists, only : lists_t
   use camroller_hdf5_status, only : raise_hdf5
   implicit none
   private

   public :: hdf5_object_t, open_space, member_name, raise_object

   !> A file, a group or a dataset that is open
   type :: hdf5_object_t
      !> Handle of the library, negative where nothing is open
      integer(hid_t) :: id = -1_hid_t
      !> Name inside the file
      character(len=:), allocatable :: name
      !> File as messages call it
      character(len=:), allocatable :: file
      !> What the objects of the file share, where it is written
      type(lists_t) :: lists
      !> Extents of the axes of a dataset that is written
      integer, allocatable :: extents(:)
      !> Disk space set aside for a file [byte]
      integer(c_int64_t) :: reserved = 0_c_int64_t
      !> Size of a file that is read [byte]
      integer(c_int64_t) :: bytes = 0_c_int64_t
   end type hdf5_object_t

contains

   !> Dataspace of given extents, a scalar one where there are none.
   subroutine open_space(extents, space, status)
      !> Extents of the axes
      integer, intent(in) :: extents(:)
      !> The dataspace
      integer(hid_t), intent(out) :: space
      !> 0 where all went well
      integer, intent(out) :: status

      if (size(extents) == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(size(extents), int(extents, hsize_t), space, status)
      end if
   end subroutine open_space

   !> Name of a member inside the file.
   pure function member_name(parent, name) result(full)
      !> File or group
      type(hdf5_object_t), intent(in) :: parent
      !> Name of the member
      character(len=*), intent(in) :: name
      !> Name from the root
      character(len=:), allocatable :: full

      if (parent%name == "/") then
         full = "/"//name
      else
         full = parent%name//"/"//name
      end if
   end function member_name

   !> Error of writing an object.
   subroutine raise_object(error, object)
      !> The error to allocate
      type(error_t), allocatable, intent(out) :: error
      !> The object that could not be written
      type(hdf5_object_t), intent(in) :: object

      call raise_hdf5(error, "cannot write '"//object%name//"' of '"//object%file//"'")
   end subroutine raise_object

end module camroller_hdf5_object
