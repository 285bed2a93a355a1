!> A file of the command `ehl` computed again and compared bit by bit.
!>
!> In: the file, its deck. Out: which quantities differ, in how many cases and lobe shapes.
module camroller_ehl_rerun
   use camroller_case, only : case_t
   use camroller_comparison_sink, only : comparison_sink_t, compare_missing, compare_record
   use camroller_deck, only : deck_t, make_sweep_case
   use camroller_deck_sweep, only : sweep_size
   use camroller_ehl_command, only : angle_count, solve_case
   use camroller_ehl_file, only : sample_record
   use camroller_ehl_page, only : ehl_line_t
   use camroller_ehl_record, only : ehl_record_t
   use camroller_error, only : error_t
   use camroller_hdf5_read, only : has_member
   use camroller_remarks, only : remark_t
   use camroller_console, only : console_t
   implicit none
   private

   public :: rerun_contacts

contains

   !> Solve the contacts of a file again, and compare them.
   subroutine rerun_contacts(sink, deck, progress, error)
      !> The file and what differs
      type(comparison_sink_t), intent(inout) :: sink
      !> Its deck
      type(deck_t), intent(in) :: deck
      !> How far it is
      type(console_t), intent(inout) :: progress
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i
      logical :: has_second, differs

      has_second = has_member(sink%file, "/ehl/second_lift")
      do i = 1, sweep_size(deck%sweep)
         differs = .false.
         call compare_lobe(sink, deck, i, .false., differs, error)
         if (allocated(error)) return
         if (has_second) call compare_lobe(sink, deck, i, .true., differs, error)
         if (allocated(error)) return
         sink%cases = sink%cases + 1
         if (differs) sink%differing = sink%differing + 1
         call progress%show(i, sweep_size(deck%sweep))
      end do
   end subroutine rerun_contacts

   !> Compare one case and lobe shape; one that cannot be solved has no numbers in the file.
   subroutine compare_lobe(sink, deck, number, is_second, differs, error)
      !> The file and what differs
      type(comparison_sink_t), intent(inout) :: sink
      type(deck_t), intent(in) :: deck
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> The second lobe shape?
      logical, intent(in) :: is_second
      !> Does the case differ?
      logical, intent(inout) :: differs
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(ehl_record_t) :: record, sampled
      type(ehl_line_t) :: line
      type(remark_t), allocatable :: remarks(:)
      type(error_t), allocatable :: failure, without_steady
      character(len=:), allocatable :: group

      allocate (remarks(0))
      group = "ehl"
      if (is_second) group = "ehl/second_lift"
      call make_sweep_case(deck, number, case, failure)
      if (.not. allocated(failure)) call solve_case(case, is_second, remarks, record, line, failure, &
         & without_steady)
      if (allocated(failure)) then
         call compare_missing(sink, group, number - 1, differs, error)
      else
         call sample_record(record, angle_count, sampled)
         call compare_record(sink, group, number - 1, sampled, differs, error)
      end if
   end subroutine compare_lobe

end module camroller_ehl_rerun
