!> Start of the HDF5 library, and conversion of its error stack to a short message.
!>
!> In: nothing. Out: `start_hdf5`, `raise_hdf5`; printing that is kept for a host. The library keeps its errors on a stack of its
!> own; the entry that quotes the operating system is the most informative, so it is searched first. Walking the stack has no
!> Fortran wrapper, hence the C interface.
module camroller_hdf5_status
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_loc, c_f_pointer, c_funloc, c_funptr, &
      & c_ptr, c_associated
   use hdf5, only : h5open_f, h5eset_auto_f, h5iis_valid_f, h5t_native_double
   use camroller_error, only : error_t, raise, kind_file
   use camroller_system_file, only : text_at_address
   implicit none
   private

   public :: start_hdf5, quiet_hdf5, raise_hdf5, printing_t, keep_printing, restore_printing

   !> Letters kept of an entry of the error stack
   integer, parameter :: reason_length = 400
   !> The calling thread's error stack
   integer(c_int64_t), parameter :: default_stack = 0_c_int64_t
   !> From the place where the error arose to the interface
   integer(c_int), parameter :: upward = 0_c_int
   !> Words with which the library introduces what the operating system said
   character(len=*), parameter :: system_marker = "error message = '"

   !> One entry of the error stack, as the C library lays it out
   type, bind(C) :: stack_entry_t
      integer(c_int64_t) :: class_id
      integer(c_int64_t) :: major
      integer(c_int64_t) :: minor
      integer(c_int) :: line
      type(c_ptr) :: function_name
      type(c_ptr) :: file_name
      type(c_ptr) :: description
   end type stack_entry_t

   !> What the walk brings back
   type, bind(C) :: reason_t
      !> Letters in use
      integer(c_int) :: length
      !> 1 where the text is the operating system's
      integer(c_int) :: from_system
      character(kind=c_char) :: text(reason_length)
   end type reason_t

   !> How the library prints errors of the calling thread
   type :: printing_t
      private
      type(c_funptr) :: routine
      type(c_ptr) :: data
      !> Is it known?
      logical :: is_known = .false.
   end type printing_t

   interface
      function c_get_printing(stack, routine, data) bind(C, name="H5Eget_auto2") result(status)
         import :: c_int, c_int64_t, c_funptr, c_ptr
         integer(c_int64_t), value :: stack
         type(c_funptr), intent(out) :: routine
         type(c_ptr), intent(out) :: data
         integer(c_int) :: status
      end function c_get_printing

      function c_set_printing(stack, routine, data) bind(C, name="H5Eset_auto2") result(status)
         import :: c_int, c_int64_t, c_funptr, c_ptr
         integer(c_int64_t), value :: stack
         type(c_funptr), value :: routine
         type(c_ptr), value :: data
         integer(c_int) :: status
      end function c_set_printing

      function c_walk(stack, direction, visitor, reason) bind(C, name="H5Ewalk2") result(status)
         import :: c_int, c_int64_t, c_funptr, c_ptr
         integer(c_int64_t), value :: stack
         integer(c_int), value :: direction
         type(c_funptr), value :: visitor
         type(c_ptr), value :: reason
         integer(c_int) :: status
      end function c_walk
   end interface

contains

   !> Start the library where it is not started yet, and switch its own printing of errors off.
   subroutine start_hdf5(error)
      !> File error where the library cannot be started
      type(error_t), allocatable, intent(out) :: error

      logical :: started
      integer :: status

      call h5iis_valid_f(h5t_native_double, started, status)
      if (status /= 0 .or. .not. started) then
         call h5open_f(status)
         if (status /= 0) then
            call raise(error, kind_file, "the HDF5 library cannot be started")
            return
         end if
      end if
      call quiet_hdf5()
   end subroutine start_hdf5

   !> Switch the library's own printing of errors off, which it does for each thread apart.
   subroutine quiet_hdf5()
      integer :: ignored

      call h5eset_auto_f(0, ignored)
   end subroutine quiet_hdf5

   !> Note how the library prints errors, for a host that uses it as well.
   subroutine keep_printing(kept)
      !> How
      type(printing_t), intent(out) :: kept

      kept%is_known = c_get_printing(default_stack, kept%routine, kept%data) >= 0
   end subroutine keep_printing

   !> Let the library print errors as it did.
   subroutine restore_printing(kept)
      !> How
      type(printing_t), intent(in) :: kept

      integer(c_int) :: ignored

      if (kept%is_known) ignored = c_set_printing(default_stack, kept%routine, kept%data)
   end subroutine restore_printing

   !> Make an error out of what was tried and of what the library has to say; to be called right after the failing call.
   subroutine raise_hdf5(error, what)
      !> The error to allocate
      type(error_t), allocatable, intent(out) :: error
      !> What was tried, e.g. `cannot create 'results/thesis.h5'`
      character(len=*), intent(in) :: what

      type(reason_t), target :: reason
      character(len=:), allocatable :: text
      integer(c_int) :: status
      integer :: i

      reason%length = 0
      reason%from_system = 0
      status = c_walk(default_stack, upward, c_funloc(visit_entry), c_loc(reason))
      text = what
      if (status >= 0 .and. reason%length > 0) then
         text = text//": "//repeat(" ", int(reason%length))
         do i = 1, int(reason%length)
            text(len(text) - int(reason%length) + i:len(text) - int(reason%length) + i) = reason%text(i)
         end do
      end if
      call raise(error, kind_file, text)
   end subroutine raise_hdf5

   !> Keep the first entry of the stack, or a later one that quotes the operating system.
   function visit_entry(position, entry, sink) bind(C) result(status)
      !> Position in the stack, from 0
      integer(c_int), value :: position
      type(stack_entry_t), intent(in) :: entry
      !> Address of a `reason_t`
      type(c_ptr), value :: sink
      !> 0: go on
      integer(c_int) :: status

      type(reason_t), pointer :: reason
      character(len=:), allocatable :: words
      integer :: first, i

      status = 0
      if (.not. c_associated(entry%description)) return
      call c_f_pointer(sink, reason)
      if (reason%from_system == 1) return
      call text_at_address(entry%description, words)
      first = index(words, system_marker)
      if (first > 0) then
         reason%from_system = 1
         words = words(first + len(system_marker):)
         words = words(:index(words//"'", "'") - 1)
      else if (position > 0) then
         return
      end if
      reason%length = int(min(len(words), reason_length), c_int)
      do i = 1, reason%length
         reason%text(i) = words(i:i)
      end do
   end function visit_entry

end module camroller_hdf5_status
