!> Profiles across the contact, beside the results of their cases.
!>
!> In: profiles of one case after the other. Out: `/ehl` in the result file, from the first case that has some on.
module camroller_profile_file
   use camroller_ehl_file, only : ehl_file_t, open_ehl, write_ehl, close_ehl
   use camroller_ehl_record, only : ehl_record_t
   use camroller_error, only : error_t
   use camroller_output_file, only : output_t, abandon_output
   implicit none
   private

   public :: profile_file_t, put_profiles, close_profiles

   !> Where profiles go
   type :: profile_file_t
      !> Are the datasets there?
      logical :: is_open = .false.
      type(ehl_file_t) :: file
   end type profile_file_t

contains

   !> Write the profiles of a case, if there are any.
   subroutine put_profiles(self, writer, position, profiles, error)
      !> Where they go
      type(profile_file_t), intent(inout) :: self
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> The profiles; not allocated where there are none
      type(ehl_record_t), allocatable, intent(in) :: profiles
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(profiles)) return
      if (.not. self%is_open) then
         call open_ehl(self%file, writer, 1, size(profiles%angle), size(profiles%nodes), &
            & size(profiles%values, 2), allocated(profiles%film_rise), error)
         self%is_open = .true.
         if (allocated(error)) return
      end if
      call write_ehl(self%file, writer, position, 1, profiles, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine put_profiles

   !> Close the datasets.
   subroutine close_profiles(self)
      !> Where they went
      type(profile_file_t), intent(inout) :: self

      if (self%is_open) call close_ehl(self%file)
      self%is_open = .false.
   end subroutine close_profiles

end module camroller_profile_file
