!> Receiver of computed cases.
!>
!> In: records of runs of cases, with the layouts they refer to. Out: `sink_t`, which is extended by what is done with them. A sink
!> that wants one case after the other, with names and numbers, extends `take`; one that keeps records as they are extends `keep`.
module camroller_case_sink
   use camroller_case_record, only : case_outcome_t, take_case, take_header
   use camroller_error, only : error_t, raise, kind_internal
   use camroller_layout, only : find_layout, layout_list_t, layout_t
   use camroller_record, only : record_t
   use camroller_result, only : result_t
   implicit none
   private

   public :: sink_t, name_layout

   !> Something that takes cases; by itself it forgets them
   type :: sink_t
      !> Layouts so far: laws that are swept by name may add or drop a quantity
      type(layout_list_t) :: layouts
   contains
      procedure :: announce => ignore_layout
      procedure :: keep => take_each
      procedure :: take => ignore_case
   end type sink_t

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

   !> Take a layout that comes for the first time.
   subroutine ignore_layout(self, layout, error)
      class(sink_t), intent(inout) :: self
      !> The layout; it is in the sink's list
      type(layout_t), intent(in) :: layout
      !> What went wrong: it ends the loop
      type(error_t), allocatable, intent(out) :: error

      ! used by sinks that extend this one
      associate (unused => self, unused_layout => layout)
      end associate
   end subroutine ignore_layout

   !> Take a run of cases: one after the other.
   subroutine take_each(self, record, error)
      class(sink_t), intent(inout) :: self
      !> The cases
      type(record_t), intent(inout) :: record
      !> What went wrong: it ends the loop
      type(error_t), allocatable, intent(out) :: error

      ! Of cases without a result
      type(layout_t) :: blank
      integer :: first, count, number

      call take_header(record, first, count, number)
      if (number > 0) then
         call take_run(self, record, first, count, self%layouts%items(number), error)
      else
         allocate (blank%summary(0), blank%series(0), blank%angle(0))
         call take_run(self, record, first, count, blank, error)
      end if
   end subroutine take_each

   !> Take the cases of a run.
   subroutine take_run(self, record, first, count, layout, error)
      class(sink_t), intent(inout) :: self
      !> The cases
      type(record_t), intent(inout) :: record
      !> Number of the first of them, and how many there are
      integer, intent(in) :: first, count
      !> Their layout
      type(layout_t), intent(in) :: layout
      !> What went wrong: it ends the loop
      type(error_t), allocatable, intent(out) :: error

      type(case_outcome_t) :: outcome
      integer :: i

      do i = first, first + count - 1
         call take_case(record, layout, outcome)
         call self%take(i, outcome, layout, error)
         if (allocated(error)) return
      end do
      if (record%is_short) call raise(error, kind_internal, "a record of cases is shorter than its stated length")
   end subroutine take_run

   !> Take a case.
   subroutine ignore_case(self, number, outcome, layout, error)
      class(sink_t), intent(inout) :: self
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> What came of it
      type(case_outcome_t), intent(in) :: outcome
      !> Names and units of its numbers
      type(layout_t), intent(in) :: layout
      !> What went wrong: it ends the loop
      type(error_t), allocatable, intent(out) :: error

      ! used by sinks that extend this one
      associate (unused => self, unused_number => number, unused_outcome => outcome, unused_layout => layout)
      end associate
   end subroutine ignore_case

end module camroller_case_sink
