!> The cases of part files in their order, whoever computed them.
!>
!> In: an index of part files, an open sink, somebody who may stop it. Out: every case in the sink once, in order, from one record
!> in memory at a time.
module camroller_assemble
   use camroller_error, only : error_t
   use camroller_case_record, only : end_cases, take_header
   use camroller_case_runs, only : sort_entries
   use camroller_case_sink, only : sink_t
   use camroller_text_lines, only : line_t
   use camroller_monitor, only : heed_stop, monitor_t
   use camroller_part_file, only : read_record
   use camroller_part_scan, only : index_t
   use camroller_raw_file, only : close_raw, open_raw, raw_file_t
   use camroller_record, only : record_t
   implicit none
   private

   public :: assemble

contains

   !> Hand over all cases of part files.
   subroutine assemble(index, paths, sink, monitor, error)
      !> What the files hold; gets sorted
      type(index_t), intent(inout) :: index
      !> Their paths
      type(line_t), intent(in) :: paths(:)
      !> Where the cases go; all layouts come first
      class(sink_t), intent(inout) :: sink
      !> Who may stop it between two records
      class(monitor_t), intent(inout) :: monitor
      !> File error; that it was stopped
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t), allocatable :: files(:)
      type(record_t) :: record
      integer :: i, next, first, count, unused

      call sort_entries(index%entries(:index%count))
      allocate (files(size(paths)))
      do i = 1, size(paths)
         if (.not. allocated(error)) call open_raw(files(i), paths(i)%text, .false., error)
      end do
      if (.not. allocated(error)) call announce_layouts(index, sink, error)
      next = 1
      do i = 1, index%count
         call heed_stop(monitor, error)
         if (allocated(error)) exit
         associate (entry => index%entries(i))
            if (entry%first + entry%count <= next) cycle
            next = entry%first + entry%count
            call read_record(files(entry%part), entry, record, error)
            if (allocated(error)) exit
            call take_header(record, first, count, unused)
            call end_cases(record, count, entry%layout)
            call sink%keep(record, error)
         end associate
      end do
      do i = 1, size(files)
         call close_raw(files(i))
      end do
   end subroutine assemble

   !> Announce every layout that cases have, in the order of the cases.
   subroutine announce_layouts(index, sink, error)
      !> What the files hold, sorted
      type(index_t), intent(in) :: index
      !> Where the cases go
      class(sink_t), intent(inout) :: sink
      !> File error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_known(index%layouts%count)
      integer :: i

      sink%layouts = index%layouts
      is_known = .false.
      do i = 1, index%count
         associate (layout => index%entries(i)%layout)
            if (layout == 0) cycle
            if (is_known(layout)) cycle
            is_known(layout) = .true.
            call sink%announce(index%layouts%items(layout), error)
         end associate
         if (allocated(error)) return
      end do
   end subroutine announce_layouts

end module camroller_assemble
