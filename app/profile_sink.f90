!> Profiles that a deck asks for, beside the results of its cases.
!>
!> Layer: app. In: cases with their results. Out: `/ehl` in the result file. A case whose profiles cannot be solved keeps its
!> result, with a remark.
module camroller_profile_sink
   use camroller_case, only : case_t
   use camroller_ehl_file, only : ehl_file_t, open_ehl, write_ehl, close_ehl
   use camroller_ehl_profiles, only : make_profiles, profile_nodes
   use camroller_ehl_record, only : ehl_record_t
   use camroller_error, only : error_t
   use camroller_output, only : output_t, abandon_output
   use camroller_result, only : result_t
   implicit none
   private

   public :: profile_sink_t, find_profiles, put_profiles, close_profiles

   !> Where profiles go
   type :: profile_sink_t
      !> Are the datasets there?
      logical :: is_open = .false.
      type(ehl_file_t) :: file
      !> Those of the present case; allocated where it asks for them and they were found
      type(ehl_record_t), allocatable :: record
   end type profile_sink_t

contains

   !> Profiles of a case, where it asks for them; a remark on the result where there are none.
   subroutine find_profiles(sink, case, result)
      !> Where they go
      type(profile_sink_t), intent(inout) :: sink
      !> The case
      type(case_t), intent(in) :: case
      !> Its result
      type(result_t), intent(inout) :: result

      type(error_t), allocatable :: error

      if (allocated(sink%record)) deallocate (sink%record)
      if (.not. allocated(case%ehl)) return
      if (.not. case%ehl%profiles) return
      allocate (sink%record)
      call make_profiles(sink%record, case, result, error)
      if (.not. allocated(error)) return
      deallocate (sink%record)
      if (len(result%warnings) > 0) result%warnings = result%warnings//new_line("a")
      result%warnings = result%warnings//"no profiles: "//error%message
   end subroutine find_profiles

   !> Write the profiles of a case, if there are any.
   subroutine put_profiles(sink, writer, position, result, error)
      !> Where they go
      type(profile_sink_t), intent(inout) :: sink
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> Its result
      type(result_t), intent(in) :: result
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(sink%record)) return
      if (.not. sink%is_open) then
         call open_ehl(sink%file, writer, 1, size(result%angle), profile_nodes, error)
         sink%is_open = .true.
         if (allocated(error)) return
      end if
      call write_ehl(sink%file, position, 1, sink%record, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine put_profiles

   !> Close the datasets.
   subroutine close_profiles(sink)
      !> Where they went
      type(profile_sink_t), intent(inout) :: sink

      if (sink%is_open) call close_ehl(sink%file)
      sink%is_open = .false.
   end subroutine close_profiles

end module camroller_profile_sink
