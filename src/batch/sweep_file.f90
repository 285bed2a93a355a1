!> The one result file of a sweep.
!>
!> In: a study, its cases from part files or from the loop that computes them. Out: the file, and what happened to the cases; part
!> files are removed where all cases are in it. One process at a time makes the file of part files, so that none sees the parts
!> while another removes them: parts go only when the complete file has its name. A partial file takes the place of a partial one of
!> the same study alone.
module camroller_sweep_file
   use camroller_error, only : error_t, raise, kind_file, kind_unfinished
   use camroller_assemble, only : assemble
   use camroller_case_runs, only : missing_runs, run_total, runs_t
   use camroller_case_writer, only : abandon_cases, case_writer_t, close_cases, open_cases, tally_t, write_missing
   use camroller_deck, only : deck_t
   use camroller_deck_keys, only : take_output_options
   use camroller_deck_sweep, only : case_in_words
   use camroller_deck_sweep_keys, only : series_choice, series_chosen, series_none
   use camroller_earlier_result, only : complete_there, earlier_t, failures_in_words, look_at_earlier, other_there
   use camroller_text_lines, only : line_t
   use camroller_monitor, only : heed_stop, monitor_t
   use camroller_number_text, only : agreeing, counted, integer_text
   use camroller_output, only : output_options_t
   use camroller_part_file, only : find_parts, part_beginning, scan_part
   use camroller_part_scan, only : index_t, study_facts_t
   use camroller_result_claim, only : claim_result, claim_t, give_up_claim, remove_unfinished
   use camroller_system_file, only : pause_briefly, remove_file
   implicit none
   private

   public :: study_t, sweep_options_t, sweep_report_t, sweep_unfinished, sweep_made, sweep_was_complete, sweep_shard_done
   public :: make_result, open_result, conclude, refuse_other, scan_all, tell_damages

   !> How a sweep may end: without its file; the file was made; it was there with all cases; all cases of a shard are computed
   integer, parameter :: sweep_unfinished = 0, sweep_made = 1, sweep_was_complete = 2, sweep_shard_done = 3

   !> How a sweep is run
   type :: sweep_options_t
      !> Straight into the result file, in one thread, without part files? A stop then loses what was done
      logical :: is_direct = .false.
      !> Threads; 0 for one on each core
      integer :: threads = 0
      !> This shard, from 1, and the number of shards
      integer :: shard = 1, shards = 1
      !> Continue with part files, or with a result that is there?
      logical :: is_resumed = .false.
      !> Make the file also where cases are missing?
      logical :: is_partial = .false.
   end type sweep_options_t

   !> What came of a sweep
   type :: sweep_report_t
      !> One of `sweep_unfinished` and those beside it
      integer :: ending = sweep_unfinished
      !> Cases of the shard, where a shard was computed
      integer :: cases_of_shard = 0
      !> The cases of a file that was made
      type(tally_t) :: tally
   end type sweep_report_t

   !> What is computed, and where to
   type :: study_t
      !> Path of the result file
      character(len=:), allocatable :: path
      !> What part files must agree on
      type(study_facts_t) :: facts
      !> First and last case of this shard, from 1
      integer :: first = 1, last = 0
      !> Cases still to be computed
      type(runs_t) :: runs
   end type study_t

contains

   !> Index of all part files.
   subroutine scan_all(paths, facts, index, error)
      !> Their paths
      type(line_t), intent(in) :: paths(:)
      !> The sweep they must belong to
      type(study_facts_t), intent(in) :: facts
      !> The index
      type(index_t), intent(inout) :: index
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (.not. allocated(index%entries)) allocate (index%entries(64), index%damages(0))
      do i = 1, size(paths)
         call scan_part(paths(i)%text, facts, index, error)
         if (allocated(error)) return
      end do
   end subroutine scan_all

   !> Say what of the part files is damaged.
   subroutine tell_damages(index, monitor)
      !> What they hold
      type(index_t), intent(in) :: index
      !> Who hears it
      class(monitor_t), intent(inout) :: monitor

      integer :: i

      do i = 1, size(index%damages)
         call monitor%say("remark: "//index%damages(i)%text//"; its cases have to be computed again", .true.)
      end do
   end subroutine tell_damages

   !> Start the result file.
   subroutine open_result(writer, study, deck, is_direct, error)
      !> Gets the file
      type(case_writer_t), intent(inout) :: writer
      !> What is computed
      type(study_t), intent(in) :: study
      !> Its deck
      type(deck_t), intent(in) :: deck
      !> Do the cases go straight to the file? Then all have the series that the deck wants
      logical, intent(in) :: is_direct
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(output_options_t) :: options
      integer :: series

      call take_output_options(deck%settings, options)
      series = series_choice(deck%settings)
      if (.not. is_direct) options%series = series /= series_none
      call open_cases(writer, study%path, deck, study%facts, options, series == series_chosen .and. .not. is_direct, .true., &
         & error)
   end subroutine open_result

   !> The error that a study ends with where cases failed.
   subroutine conclude(tally, error)
      !> What happened to the cases
      type(tally_t), intent(in) :: tally
      !> The first failure
      type(error_t), allocatable, intent(out) :: error

      if (tally%failed == 0) return
      error = tally%failure
      error%message = failures_in_words(tally%failed, tally%cases, error%message)
   end subroutine conclude

   !> Make the result file where the parts have every case, or where a partial one is asked for.
   subroutine make_result(study, deck, options, is_merge, monitor, report, error)
      !> What is computed
      type(study_t), intent(in) :: study
      !> Its deck
      type(deck_t), intent(in) :: deck
      !> How
      type(sweep_options_t), intent(in) :: options
      !> By a command of its own, or at the end of a sweep, which has said what it found?
      logical, intent(in) :: is_merge
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(claim_t) :: claim
      logical :: is_mine, is_waiting

      is_waiting = .false.
      do
         call claim_result(claim, study%path, is_mine, error)
         if (.not. is_mine) call heed_stop(monitor, error)
         if (allocated(error)) return
         if (is_mine) exit
         if (.not. is_waiting) call monitor%say("waiting for another process that makes '"//study%path//"'", .false.)
         is_waiting = .true.
         call pause_briefly()
      end do
      call join_parts(study, deck, options, is_merge, monitor, report, error)
      call give_up_claim(claim)
   end subroutine make_result

   !> Make the result file, alone.
   subroutine join_parts(study, deck, options, is_merge, monitor, report, error)
      !> What is computed
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      !> How
      type(sweep_options_t), intent(in) :: options
      !> By a command of its own, or at the end of a sweep, which has said what it found?
      logical, intent(in) :: is_merge
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(runs_t) :: missing
      type(earlier_t) :: earlier
      character(len=:), allocatable :: advice

      advice = "continue with --resume"
      if (is_merge) advice = "compute them with 'camroller sweep --resume', or merge the others with --partial"
      call find_parts(study%path, part_beginning(study%path), paths)
      call look_at_earlier(earlier, study%path, study%facts)
      if (size(paths) == 0 .and. earlier%state == complete_there) then
         report%ending = sweep_was_complete
         if (allocated(earlier%failure)) error = earlier%failure
         return
      else if (size(paths) == 0) then
         call raise(error, kind_file, "there is no '"//part_beginning(study%path)//"*'")
         return
      end if
      call scan_all(paths, study%facts, index, error)
      if (allocated(error)) return
      if (is_merge) call tell_damages(index, monitor)
      call missing_runs(index, 1, study%facts%cases, missing)
      if (run_total(missing) > 0 .and. .not. options%is_partial) then
         call raise(error, kind_unfinished, integer_text(run_total(missing))//" of "//counted(study%facts%cases, "case")// &
            & agreeing(run_total(missing), " is missing, ", " are missing, the first is ")// &
            & case_in_words(deck%sweep, missing%first(1))//"; "//advice)
      else
         call check_earlier(study, earlier, options%is_resumed, run_total(missing) > 0, error)
         if (allocated(error)) return
         if (is_merge .and. earlier%state == other_there) call monitor%say("remark: '"//study%path// &
            & "' is replaced; it was not a result of this sweep: "//earlier%reason, .false.)
         call write_result(study, deck, options%is_resumed, index, paths, monitor, report, error)
      end if
   end subroutine join_parts

   !> May a result take the place of what has its name?
   subroutine check_earlier(study, earlier, is_resumed, is_partial, error)
      !> What is computed
      type(study_t), intent(in) :: study
      !> What is there
      type(earlier_t), intent(in) :: earlier
      !> Does the user want what is there to be continued? Is the result without some cases?
      logical, intent(in) :: is_resumed, is_partial
      !> File error where it may not
      type(error_t), allocatable, intent(out) :: error

      if (is_partial .and. earlier%state == complete_there) then
         call raise(error, kind_file, "'"//study%path//"' exists with all cases, and a partial file would replace it; move "// &
            & "it away first")
      else if (is_partial) then
         call refuse_other(study%path, earlier, "a partial file does not replace it; move it away first", error)
      else if (is_resumed) then
         call refuse_other(study%path, earlier, "it came while the cases were computed, and --resume does not replace it; move "// &
            & "it away and start again with --resume, which finds the cases", error)
      end if
   end subroutine check_earlier

   !> An error where a file that is no result of a study has the name of one.
   subroutine refuse_other(path, earlier, advice, error)
      !> The name
      character(len=*), intent(in) :: path
      !> What is there
      type(earlier_t), intent(in) :: earlier
      !> What may be done
      character(len=*), intent(in) :: advice
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (earlier%state /= other_there) return
      call raise(error, kind_file, "'"//path//"' exists and is not a result of this sweep: "//earlier%reason//new_line("a")//advice)
   end subroutine refuse_other

   !> Write the result file; the parts are removed where it is complete. What came meanwhile under its name is looked at again
   !> before it gets that name, since a result that is computed without parts waits for no other.
   subroutine write_result(study, deck, is_resumed, index, paths, monitor, report, error)
      !> What is computed
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      !> Does the user want what is there to be continued?
      logical, intent(in) :: is_resumed
      !> What the part files hold
      type(index_t), intent(inout) :: index
      !> The part files
      type(line_t), intent(in) :: paths(:)
      !> Who may stop it
      class(monitor_t), intent(inout) :: monitor
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(case_writer_t) :: writer
      type(earlier_t) :: earlier
      integer :: i

      call remove_unfinished(study%path)
      call open_result(writer, study, deck, .false., error)
      if (.not. allocated(error)) call assemble(index, paths, writer, monitor, error)
      if (.not. allocated(error)) call write_missing(writer, study%facts%cases, error)
      if (.not. allocated(error)) then
         call look_at_earlier(earlier, study%path, study%facts)
         call check_earlier(study, earlier, is_resumed, writer%tally%missing > 0, error)
      end if
      if (.not. allocated(error)) call close_cases(writer, error)
      if (allocated(error)) then
         call abandon_cases(writer)
         return
      end if
      if (writer%tally%missing == 0) then
         do i = 1, size(paths)
            call remove_file(paths(i)%text)
         end do
      end if
      report%ending = sweep_made
      report%tally = writer%tally
      call conclude(report%tally, error)
   end subroutine write_result

end module camroller_sweep_file
