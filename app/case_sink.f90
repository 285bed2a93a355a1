!> Receiver of computed cases: records of runs of cases, with the layouts they refer to.
!>
!> In: records, one at a time. Out: `sink_t`, which is extended by what is done with them.
module camroller_case_sink
   use camroller_error, only : error_t
   use camroller_layout, only : find_layout, layout_list_t, layout_t
   use camroller_record, only : record_t
   use camroller_result, only : result_t
   implicit none
   private

   public :: sink_t, name_layout

   !> Something that takes cases
   type, abstract :: sink_t
      !> Layouts so far: laws that are swept by name may add or drop a quantity
      type(layout_list_t) :: layouts
   contains
      procedure(announce_interface), deferred :: announce
      procedure(keep_interface), deferred :: keep
   end type sink_t

   abstract interface
      !> Take a layout that comes for the first time.
      subroutine announce_interface(self, layout, error)
         import :: error_t, layout_t, sink_t
         implicit none
         !> The sink
         class(sink_t), intent(inout) :: self
         !> The layout; it is the last of the sink's list
         type(layout_t), intent(in) :: layout
         !> File error
         type(error_t), allocatable, intent(out) :: error
      end subroutine announce_interface

      !> Take a run of cases.
      subroutine keep_interface(self, record, error)
         import :: error_t, record_t, sink_t
         implicit none
         !> The sink
         class(sink_t), intent(inout) :: self
         !> The cases
         type(record_t), intent(inout) :: record
         !> File error
         type(error_t), allocatable, intent(out) :: error
      end subroutine keep_interface
   end interface

contains

   !> Number of the layout of a result; one that is new is announced.
   subroutine name_layout(sink, result, number, error)
      !> The sink
      class(sink_t), intent(inout) :: sink
      !> The result
      type(result_t), intent(in) :: result
      !> Number of its layout
      integer, intent(out) :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_new

      call find_layout(sink%layouts, result, number, is_new)
      if (is_new) call sink%announce(sink%layouts%items(number), error)
   end subroutine name_layout

end module camroller_case_sink
