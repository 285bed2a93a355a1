!> Cases that go to a part file.
!>
!> In: records. Out: the same in a part file, flushed to disk from time to time.
module camroller_part_sink
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case_record, only : end_cases, take_header
   use camroller_case_sink, only : sink_t
   use camroller_layout, only : layout_t
   use camroller_part_file, only : append_layout, append_record, part_t, sync_part
   use camroller_part_scan, only : kind_cases
   use camroller_record, only : record_t
   implicit none
   private

   public :: part_sink_t

   !> The sink
   type, extends(sink_t) :: part_sink_t
      type(part_t) :: part
      !> Interval at which what is written is flushed to disk [s]
      real(wp) :: interval = 30.0_wp
      !> Clock when it did last
      integer(int64) :: last = 0
      !> Layouts that the file had when it was opened
      integer :: layouts_before = -1
   contains
      procedure :: announce
      procedure :: keep
   end type part_sink_t

contains

   !> Write a layout.
   subroutine announce(self, layout, error)
      class(part_sink_t), intent(inout) :: self
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (self%layouts_before < 0) self%layouts_before = self%part%layouts
      call append_layout(self%part, layout, error)
   end subroutine announce

   !> Write a run of cases; its layout is counted from the first one of the file.
   subroutine keep(self, record, error)
      class(part_sink_t), intent(inout) :: self
      !> The cases
      type(record_t), intent(inout) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: now, rate
      integer :: first, count, layout

      call take_header(record, first, count, layout)
      if (layout > 0) call end_cases(record, count, layout + max(0, self%layouts_before))
      call append_record(self%part, kind_cases, record, error)
      if (allocated(error)) return
      call system_clock(now, rate)
      if (self%last == 0) self%last = now
      if (real(now - self%last, wp) < self%interval*real(rate, wp)) return
      self%last = now
      call sync_part(self%part, error)
   end subroutine keep

end module camroller_part_sink
