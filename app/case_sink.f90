!> Where computed cases go: records of runs of cases, with the layouts they refer to.
!>
!> Layer: app. In: records, one at a time. Out: `sink_t`, which is extended by what is done with them.
module camroller_case_sink
   use camroller_error, only : error_t
   use camroller_layout, only : layout_t, fits_layout, layout_of
   use camroller_record, only : record_t
   use camroller_result, only : result_t
   implicit none
   private

   public :: sink_t, find_layout, most_layouts

   !> Most layouts of one sweep: laws that are swept by name may add or drop a quantity
   integer, parameter :: most_layouts = 64

   !> Something that takes cases
   type, abstract :: sink_t
      !> Layouts so far, and how many there are
      type(layout_t) :: layouts(most_layouts)
      integer :: layout_count = 0
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
   subroutine find_layout(sink, result, number, error)
      !> The sink
      class(sink_t), intent(inout) :: sink
      !> The result
      type(result_t), intent(in) :: result
      !> Number of its layout
      integer, intent(out) :: number
      !> File error
      type(error_t), allocatable, intent(out) :: error

      do number = sink%layout_count, 1, -1
         if (fits_layout(sink%layouts(number), result)) return
      end do
      number = sink%layout_count + 1
      call layout_of(result, sink%layouts(number))
      sink%layout_count = number
      call sink%announce(sink%layouts(number), error)
   end subroutine find_layout

end module camroller_case_sink
