!> Property lists of HDF5: how files, groups and datasets are made and written; the type of texts, the shape of one value.
!>
!> In: nothing. Out: what all datasets and attributes of a file share, made once since the library takes long for each.
module camroller_hdf5_lists
   use hdf5, only : hid_t, hsize_t, size_t, h5pclose_f, h5pcreate_f, h5pset_attr_creation_order_f, h5pset_buffer_f, &
      & h5pset_chunk_cache_f, h5pset_fill_value_f, h5pset_link_creation_order_f, h5pset_obj_track_times_f, h5sclose_f, &
      & h5screate_f, h5tclose_f, h5tcopy_f, h5tset_cset_f, h5p_crt_order_indexed_f, h5p_crt_order_tracked_f, &
      & h5p_dataset_access_f, h5p_dataset_create_f, h5p_dataset_xfer_f, h5s_scalar_f, h5t_cset_utf8_f, h5t_native_double, &
      & h5t_string
   use camroller_kinds, only : not_a_number
   implicit none
   private

   public :: lists_t, open_lists, close_lists, object_list, open_text_type

   !> What the datasets and attributes of a file share, negative where it is not open
   type :: lists_t
      !> To create datasets of reals, which read as not-a-number before they are written, and of other values
      integer(hid_t) :: numbers = -1_hid_t, others = -1_hid_t
      !> To open those in chunks, and to write
      integer(hid_t) :: access = -1_hid_t, transfer = -1_hid_t
      !> Type of texts, and dataspace of one value
      integer(hid_t) :: texts = -1_hid_t, one_value = -1_hid_t
   end type lists_t

   !> Buffer for texts on their way to a file [byte]; the library's own is a megabyte, cleared for each text
   integer(hsize_t), parameter :: conversion_size = 512_hsize_t

contains

   !> Make the lists.
   subroutine open_lists(lists, status)
      !> The lists, to be closed
      type(lists_t), intent(out) :: lists
      !> 0 where all went well
      integer, intent(out) :: status

      call object_list(h5p_dataset_create_f, .false., lists%others, status)
      if (status == 0) call object_list(h5p_dataset_create_f, .false., lists%numbers, status)
      if (status == 0) call h5pset_fill_value_f(lists%numbers, h5t_native_double, not_a_number(), status)
      if (status == 0) call h5pcreate_f(h5p_dataset_access_f, lists%access, status)
      ! Without a cache a chunk takes its space when it is written, not at some later time
      if (status == 0) call h5pset_chunk_cache_f(lists%access, 1_size_t, 0_size_t, 1.0, status)
      if (status == 0) call h5pcreate_f(h5p_dataset_xfer_f, lists%transfer, status)
      if (status == 0) call h5pset_buffer_f(lists%transfer, conversion_size, status)
      if (status == 0) call open_text_type(lists%texts, status)
      if (status == 0) call h5screate_f(h5s_scalar_f, lists%one_value, status)
   end subroutine open_lists

   !> Close those that are open.
   subroutine close_lists(lists)
      !> The lists
      type(lists_t), intent(inout) :: lists

      integer :: ignored

      if (lists%others >= 0_hid_t) call h5pclose_f(lists%others, ignored)
      if (lists%numbers >= 0_hid_t) call h5pclose_f(lists%numbers, ignored)
      if (lists%access >= 0_hid_t) call h5pclose_f(lists%access, ignored)
      if (lists%transfer >= 0_hid_t) call h5pclose_f(lists%transfer, ignored)
      if (lists%texts >= 0_hid_t) call h5tclose_f(lists%texts, ignored)
      if (lists%one_value >= 0_hid_t) call h5sclose_f(lists%one_value, ignored)
      lists = lists_t()
   end subroutine close_lists

   !> Type of texts of any length in UTF-8.
   subroutine open_text_type(text_type, status)
      !> The type, to be closed
      integer(hid_t), intent(out) :: text_type
      !> 0 where all went well
      integer, intent(out) :: status

      call h5tcopy_f(h5t_string, text_type, status)
      if (status == 0) call h5tset_cset_f(text_type, h5t_cset_utf8_f, status)
   end subroutine open_text_type

   !> Creation properties without time stamps, with members (where the object has some) in order of creation.
   subroutine object_list(class, has_members, list, status)
      !> Class of the property list
      integer(hid_t), intent(in) :: class
      !> Whether the object holds others
      logical, intent(in) :: has_members
      !> The property list
      integer(hid_t), intent(out) :: list
      !> 0 where all went well
      integer, intent(out) :: status

      integer :: order

      order = ior(h5p_crt_order_tracked_f, h5p_crt_order_indexed_f)
      call h5pcreate_f(class, list, status)
      if (status == 0) call h5pset_obj_track_times_f(list, .false., status)
      if (status == 0) call h5pset_attr_creation_order_f(list, order, status)
      if (status == 0 .and. has_members) call h5pset_link_creation_order_f(list, order, status)
   end subroutine object_list

end module camroller_hdf5_lists
