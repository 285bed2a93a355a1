!> Options of the result file that a deck sets.
!>
!> In: nothing. Out: type and names, in a module that does not depend on HDF5, so that a deck can be read without it.
module camroller_output_options
   use camroller_names, only : name_length
   implicit none
   private

   public :: output_options_t, compression_names

   !> When series are compressed: where they are large, always, never
   character(len=*), parameter :: compression_names(*) = [character(len=name_length) :: "auto", "on", "off"]

   !> What goes into the file, and how
   type :: output_options_t
      !> Whether the series are written, or the summary alone
      logical :: series = .true.
      !> One of `compression_names`
      character(len=name_length) :: compression = "auto"
   end type output_options_t

end module camroller_output_options
