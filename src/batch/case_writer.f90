!> Cases that go to a result file.
!>
!> In: records of cases, in their order, from the loop that computes them or from part files. Out: the file, every case written
!> once, its quantities at their places among those of all cases; how many failed, and their remarks. Quantities stand in the order
!> in which the cases bring them, so that the file depends on the cases alone.
module camroller_case_writer
   use camroller_kinds, only : wp, not_a_number
   use camroller_error, only : error_t, raise
   use camroller_case_record, only : case_outcome_t
   use camroller_case_sink, only : sink_t
   use camroller_deck, only : deck_t
   use camroller_history_file, only : close_history, history_file_t, put_history
   use camroller_layout, only : join_quantities, layout_t, places_of
   use camroller_output, only : abandon_output, add_layout, close_output, not_computed, open_output, output_options_t, output_t, &
      & write_outcome, write_worst_remarks
   use camroller_part_scan, only : study_facts_t
   use camroller_profile_file, only : close_profiles, profile_file_t, put_profiles
   use camroller_remarks, only : note_remarks, remarks_t
   use camroller_run_facts, only : write_facts
   implicit none
   private

   public :: case_writer_t, tally_t, open_cases, write_missing, close_cases, abandon_cases

   !> What happened to the cases
   type :: tally_t
      !> Cases in all, without a result, not computed
      integer :: cases = 0, failed = 0, missing = 0
      !> First failure
      type(error_t), allocatable :: failure
      !> Remarks by kind
      type(remarks_t) :: remarks
   end type tally_t

   !> The sink
   type, extends(sink_t) :: case_writer_t
      type(output_t) :: file
      !> Profiles across the contact in it
      type(profile_file_t) :: profiles
      !> What is listed over hours of running or turns
      type(history_file_t) :: history
      !> Quantities so far
      type(layout_t) :: joint
      type(tally_t) :: tally
      !> Next case that is wanted, from 1
      integer :: next = 1
   contains
      procedure :: announce
      procedure :: take
   end type case_writer_t

contains

   !> Start a result file with all that is known before the first case.
   subroutine open_cases(writer, path, deck, facts, options, is_sparse, of_runs, error)
      !> The sink
      type(case_writer_t), intent(inout) :: writer
      !> Path of the finished file
      character(len=*), intent(in) :: path
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What it was when its first case was computed
      type(study_facts_t), intent(in) :: facts
      !> What is written, and how
      type(output_options_t), intent(in) :: options
      !> Do only few cases have series?
      logical, intent(in) :: is_sparse
      !> Are they runs?
      logical, intent(in) :: of_runs
      !> File error
      type(error_t), allocatable, intent(out) :: error

      writer%tally%cases = facts%cases
      allocate (writer%joint%summary(0), writer%joint%series(0), writer%joint%angle(0))
      call open_output(writer%file, path, facts%cases, options, error, is_sparse)
      if (.not. allocated(error)) call write_facts(writer%file, deck, of_runs, error, facts)
      if (allocated(error)) call abandon_output(writer%file)
   end subroutine open_cases

   !> Take a layout: quantities that no case had before get their place.
   subroutine announce(self, layout, error)
      !> The sink
      class(case_writer_t), intent(inout) :: self
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (size(self%joint%angle) == 0) self%joint%angle = layout%angle
      call join_quantities(self%joint%summary, layout%summary)
      call join_quantities(self%joint%series, layout%series)
      call add_layout(self%file, layout, error)
   end subroutine announce

   !> Write a case, unless it has been written; cases between it and the last one are missing.
   subroutine take(self, number, outcome, layout, error)
      !> The sink
      class(case_writer_t), intent(inout) :: self
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> What came of it
      type(case_outcome_t), intent(in) :: outcome
      !> Names and units of its numbers
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (number < self%next) return
      call write_missing(self, number - 1, error)
      if (allocated(error)) return
      self%next = number + 1
      if (outcome%status /= 0) then
         self%tally%failed = self%tally%failed + 1
         if (self%tally%failed == 1) call raise(self%tally%failure, outcome%status, outcome%text)
      else
         call note_remarks(self%tally%remarks, number, outcome%remarks)
      end if
      call write_one(self, number, outcome, layout, error)
   end subroutine take

   !> Write cases that were not computed.
   subroutine write_missing(self, last, error)
      !> The sink
      type(case_writer_t), intent(inout) :: self
      !> The last of them, from 1; none where it was written
      integer, intent(in) :: last
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(case_outcome_t) :: outcome
      integer :: i

      outcome%status = not_computed
      outcome%text = ""
      outcome%reasons = ""
      do i = self%next, last
         self%tally%missing = self%tally%missing + 1
         self%next = i + 1
         call write_one(self, i, outcome, self%joint, error)
         if (allocated(error)) return
      end do
   end subroutine write_missing

   !> Write one case, its quantities at their places among those of all cases.
   subroutine write_one(self, number, outcome, layout, error)
      !> The sink
      type(case_writer_t), intent(inout) :: self
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> What came of it
      type(case_outcome_t), intent(in) :: outcome
      !> Names and units of its numbers
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Scalars and series of all layouts [units as in the layouts]
      real(wp), allocatable :: summary(:), series(:, :)

      allocate (summary(size(self%joint%summary)), source=not_a_number())
      if (outcome%status == 0) summary(places_of(layout%summary, self%joint%summary)) = outcome%summary
      if (allocated(outcome%series)) then
         allocate (series(size(self%joint%angle), size(self%joint%series)), source=not_a_number())
         series(:, places_of(layout%series, self%joint%series)) = outcome%series
      else
         allocate (series(0, 0))
      end if
      call write_outcome(self%file, number, outcome%status, outcome%text, outcome%reasons, summary, series, error)
      if (.not. allocated(error)) call put_profiles(self%profiles, self%file, number, outcome%profiles, error)
      if (.not. allocated(error)) call put_history(self%history, self%file, number, layout%history, outcome%history, error)
   end subroutine write_one

   !> Finish the file.
   subroutine close_cases(writer, error)
      !> The sink
      type(case_writer_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call close_history(writer%history)
      call close_profiles(writer%profiles)
      call write_worst_remarks(writer%file, writer%tally%remarks, error)
      if (.not. allocated(error)) call close_output(writer%file, error)
   end subroutine close_cases

   !> Give up: the unfinished file is removed.
   subroutine abandon_cases(writer)
      !> The sink
      type(case_writer_t), intent(inout) :: writer

      call close_history(writer%history)
      call close_profiles(writer%profiles)
      call abandon_output(writer%file)
   end subroutine abandon_cases

end module camroller_case_writer
