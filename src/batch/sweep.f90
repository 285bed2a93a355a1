!> A sweep: every case of a deck into one result file.
!>
!> In: a deck, the path of the file. Out: the file; what happened to the cases. Directly, in one thread, the cases go straight into
!> the file. Otherwise they go to part files first, one for each process, which survive any end; the file is made of them when all
!> cases are there. The first of several processes finds out what is to be done, and makes the file.
module camroller_sweep
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck, kind_file, kind_unfinished, kind_usage
   use camroller_case_loop, only : compute_cases, ended_all, ended_by_time, loop_t, set_threads
   use camroller_case_runs, only : missing_runs, run_total, runs_in_words, runs_t
   use camroller_case_writer, only : abandon_cases, case_writer_t, close_cases
   use camroller_deck, only : add_places, deck_t, is_read
   use camroller_deck_files, only : list_deck_files
   use camroller_deck_sweep_keys, only : series_all, series_choice, series_none
   use camroller_earlier_result, only : complete_there, earlier_t, look_at_earlier, other_there, partial_there
   use camroller_hdf5_status, only : keep_printing, printing_t, restore_printing
   use camroller_text_lines, only : line_t
   use camroller_monitor, only : monitor_t
   use camroller_new_file, only : check_place
   use camroller_number_text, only : counted, integer_text
   use camroller_output_kind, only : result_kind
   use camroller_part_file, only : close_part, find_parts, is_being_written, open_part, part_beginning, part_name, &
      & sync_part
   use camroller_part_scan, only : index_t, study_facts_t
   use camroller_part_sink, only : part_sink_t
   use camroller_result_claim, only : remove_left_lock
   use camroller_run_facts, only : study_facts
   use camroller_settings, only : take
   use camroller_sweep_file, only : conclude, make_result, open_result, refuse_other, scan_all, study_t, &
      & sweep_made, sweep_options_t, sweep_report_t, sweep_shard_done, sweep_was_complete, tell_damages
   use camroller_team, only : agreed_code, team_t
   use camroller_version, only : build_commit, names_sources
   implicit none
   private

   public :: run_sweep, merge_sweep

contains

   !> Compute every case of a deck and write one file.
   subroutine run_sweep(deck, path, options, report, error, monitor, team)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Path of the result file; blanks at its end are none of it
      character(len=*), intent(in) :: path
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What came of it, on the first process
      type(sweep_report_t), intent(out) :: report
      !> What went wrong: of any kind; the first failure where cases failed, and the file is there all the same
      type(error_t), allocatable, intent(out) :: error
      !> Who follows it; without it nobody
      class(monitor_t), intent(inout), target, optional :: monitor
      !> Processes that share it, unless the cases go straight to the file; without it this one alone
      class(team_t), intent(inout), target, optional :: team

      type(monitor_t), target :: nobody
      type(team_t), target :: alone
      class(monitor_t), pointer :: follower
      class(team_t), pointer :: processes
      type(study_t) :: study
      type(printing_t) :: printing

      follower => nobody
      if (present(monitor)) follower => monitor
      processes => alone
      if (present(team) .and. .not. options%is_direct) processes => team
      call keep_printing(printing)
      call begin_study(deck, path, options, study, error)
      if (agreed_code(processes, error) == 0) then
         if (options%is_direct) then
            call write_directly(deck, study, follower, processes, report, error)
         else
            call run_in_parts(deck, options, study, follower, processes, report, error)
         end if
      end if
      call restore_printing(printing)
   end subroutine run_sweep

   !> Make the one file of a sweep of its part files.
   subroutine merge_sweep(deck, path, options, report, error, monitor)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Path of the result file
      character(len=*), intent(in) :: path
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What came of it
      type(sweep_report_t), intent(out) :: report
      !> What went wrong: of any kind; the first failure where cases failed, and the file is there all the same
      type(error_t), allocatable, intent(out) :: error
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor

      type(study_t) :: study

      call begin_study(deck, path, options, study, error)
      if (allocated(error)) return
      call tell_unknown_build(monitor)
      call make_result(study, deck, options, .true., monitor, report, error)
   end subroutine merge_sweep

   !> What is computed, and where to.
   subroutine begin_study(deck, path, options, study, error)
      type(deck_t), intent(in) :: deck
      !> Path of the result file, which must not be one that the deck is read from
      character(len=*), intent(in) :: path
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What is computed
      type(study_t), intent(out) :: study
      !> Deck or usage error, the latter also for a deck that was not read
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: inputs(:)
      logical :: with_profiles

      if (.not. is_read(deck)) then
         call raise(error, kind_usage, "run_sweep: the deck has not been read; call read_deck or parse_deck first")
         return
      end if
      study%path = trim(path)
      call study_facts(deck, study%facts)
      call list_deck_files(deck, inputs)
      call check_place(study%path, result_kind, inputs, error)
      if (allocated(error)) return
      study%first = int((options%shard - 1)*int(study%facts%cases, int64)/options%shards) + 1
      study%last = int(options%shard*int(study%facts%cases, int64)/options%shards)
      ! Whether or not this one has a case, so that all tasks of a job end alike
      if (options%shards > study%facts%cases) then
         call raise(error, kind_usage, integer_text(options%shards)//" shards are more than the "// &
            & counted(study%facts%cases, "case"))
         return
      end if
      study%runs%first = [study%first]
      study%runs%count = [study%last - study%first + 1]
      with_profiles = .false.
      call take(deck%settings, "ehl", "profiles", with_profiles)
      if (options%is_direct .or. .not. with_profiles .or. series_choice(deck%settings) /= series_none) return
      call raise(error, kind_deck, "'ehl.profiles' has no cases: a sweep keeps profiles of the cases whose series it keeps, "// &
         & "1.6 MB each at 720 cam angles; choose them by 'sweep.series', or leave 'ehl.profiles' out")
   end subroutine begin_study

   !> Compute the cases one after the other, straight into the result file. Where none has a result, there is no file.
   subroutine write_directly(deck, study, monitor, team, report, error)
      type(deck_t), intent(in) :: deck
      !> What is computed
      type(study_t), intent(in) :: study
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> This process alone
      class(team_t), intent(inout), target :: team
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(case_writer_t), target :: writer
      type(loop_t), target :: loop

      call set_threads(loop, 1, error)
      if (.not. allocated(error)) call open_result(writer, study, deck, .true., error)
      if (allocated(error)) return
      loop%series = series_all
      loop%profiles = series_all
      call compute_cases(loop, deck, study%runs, writer, team, monitor, error)
      call monitor%end_cases()
      if (.not. allocated(error) .and. loop%ended /= ended_all) then
         call raise(error, kind_unfinished, "stopped after "//integer_text(loop%done)//" of "//counted(loop%total, "case"))
      end if
      report%tally = writer%tally
      if (.not. allocated(error)) then
         if (report%tally%failed < report%tally%cases) then
            call close_cases(writer, error)
            if (allocated(error)) return
            report%ending = sweep_made
            call conclude(report%tally, error)
         else
            error = report%tally%failure
            call abandon_cases(writer)
         end if
         call add_places(deck, error)
      else
         call abandon_cases(writer)
      end if
   end subroutine write_directly

   !> Compute the cases that no part file has, and make the result file where then all are there.
   subroutine run_in_parts(deck, options, study, monitor, team, report, error)
      type(deck_t), intent(in) :: deck
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What is computed
      type(study_t), intent(inout) :: study
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Processes that share it
      class(team_t), intent(inout), target :: team
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(loop_t), target :: loop
      type(error_t), allocatable :: earlier_failure
      integer, allocatable :: numbers(:)
      integer :: code

      allocate (numbers(0))
      if (team%rank == 0) then
         call find_work(options, study, monitor, report, earlier_failure, error)
         if (options%is_resumed .and. run_total(study%runs) <= study%last - study%first) call tell_unknown_build(monitor)
         numbers = [study%runs%first, study%runs%count]
      end if
      call team%share(numbers)
      study%runs%first = numbers(:size(numbers)/2)
      study%runs%count = numbers(size(numbers)/2 + 1:)
      if (agreed_code(team, error) /= 0) return
      call compute(deck, options, study, monitor, team, loop, error)
      code = agreed_code(team, error)
      if (team%rank == 0) call monitor%end_cases()
      if (code /= 0 .or. team%rank /= 0) return
      if (report%ending == sweep_was_complete) then
         if (allocated(earlier_failure)) call move_alloc(earlier_failure, error)
      else
         call finish(deck, options, study, loop%ended, monitor, report, error)
      end if
   end subroutine run_in_parts

   !> Cases that no part file has.
   subroutine find_work(options, study, monitor, report, failure, error)
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What is computed
      type(study_t), intent(inout) :: study
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor
      !> Gets whether the result file is there with all cases
      type(sweep_report_t), intent(inout) :: report
      !> The error that its cases ended with, where some failed
      type(error_t), allocatable, intent(out) :: failure
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(earlier_t) :: earlier
      character(len=:), allocatable :: own
      integer :: i

      own = part_name(study%path, options%shard, options%shards)
      study%runs%first = [integer ::]
      study%runs%count = [integer ::]
      call find_parts(study%path, own, paths)
      if (size(paths) > 0 .and. .not. options%is_resumed) then
         do i = 1, size(paths)
            if (.not. is_being_written(paths(i)%text)) cycle
            call raise(error, kind_file, "another process is writing '"//paths(i)%text//"': a sweep of '"//study%path// &
               & "' is running; wait for its end, or name another file by -o")
            return
         end do
         call raise(error, kind_file, "'"//paths(1)%text//"' exists from an unfinished sweep; continue it with "// &
            & "--resume, or remove "//own//"*")
         return
      end if
      call find_parts(study%path, part_beginning(study%path), paths)
      call look_at_earlier(earlier, study%path, study%facts)
      if (options%is_resumed) call refuse_other(study%path, earlier, "--resume does not replace it; move it away, name another "// &
         & "file by -o, or leave --resume out", error)
      if (allocated(error)) return
      if (options%is_resumed .and. earlier%state == complete_there .and. size(paths) == 0) then
         call remove_left_lock(study%path)
         report%ending = sweep_was_complete
         call move_alloc(earlier%failure, failure)
         return
      end if
      if (earlier%state == other_there) then
         call monitor%say("remark: '"//study%path//"' exists and is not a result of this sweep: "//earlier%reason// &
            & new_line("a")//"it is replaced when all cases are done", .false.)
      else if (earlier%state == partial_there .and. size(paths) == 0 .and. options%is_resumed) then
         call monitor%say("remark: '"//study%path//"' has "//integer_text(earlier%computed)//" of "// &
            & counted(study%facts%cases, "case")//", and their part files are gone: all cases are computed", .false.)
      end if
      call scan_all(paths, study%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, study%first, study%last, study%runs)
      if (size(index%damages) == 0) return
      call tell_damages(index, monitor)
      if (run_total(study%runs) > 0) call monitor%say("remark: to be computed: "//runs_in_words(study%runs), .true.)
   end subroutine find_work

   !> Say where another build may have computed cases that are there, and cannot be told from this one.
   subroutine tell_unknown_build(monitor)
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor

      if (names_sources(build_commit)) return
      call monitor%say("remark: the commit of this build is '"//build_commit//"': whether the same sources computed the cases "// &
         & "that are there is not known", .false.)
   end subroutine tell_unknown_build

   !> Compute what is to be computed, into the part file of this process.
   subroutine compute(deck, options, study, monitor, team, loop, error)
      type(deck_t), intent(in) :: deck
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What is computed
      type(study_t), intent(in) :: study
      !> Who follows it
      class(monitor_t), intent(inout), target :: monitor
      !> Processes that share it
      class(team_t), intent(inout), target :: team
      !> How the loop ended
      type(loop_t), intent(out), target :: loop
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(part_sink_t), target :: sink
      type(error_t), allocatable :: last
      integer(int64) :: rate
      real(wp) :: limit ! [s]

      loop%series = series_choice(deck%settings)
      loop%profiles = loop%series
      allocate (loop%series_cases(0))
      call take(deck%settings, "sweep", "series_cases", loop%series_cases)
      limit = 0.0_wp
      call take(deck%settings, "sweep", "wall_time_limit_s", limit)
      if (limit > 0.0_wp) then
         call system_clock(loop%deadline, rate)
         loop%deadline = loop%deadline + int(limit*real(rate, wp), int64)
      end if
      call take(deck%settings, "sweep", "checkpoint_s", sink%interval)
      call team%reset()
      if (run_total(study%runs) == 0) return
      call set_threads(loop, options%threads, error)
      if (allocated(error)) return
      call open_part(sink%part, part_name(study%path, options%shard, options%shards, team%rank), study%facts, error)
      if (allocated(error)) return
      call compute_cases(loop, deck, study%runs, sink, team, monitor, error)
      call sync_part(sink%part, last)
      call close_part(sink%part)
      if (.not. allocated(error) .and. allocated(last)) call move_alloc(last, error)
   end subroutine compute

   !> Make the result file where everything is done; say what is not.
   subroutine finish(deck, options, study, ended, monitor, report, error)
      type(deck_t), intent(in) :: deck
      !> How
      type(sweep_options_t), intent(in) :: options
      !> What is computed
      type(study_t), intent(in) :: study
      !> What ended the loop
      integer, intent(in) :: ended
      !> What is told about progress
      class(monitor_t), intent(inout) :: monitor
      !> What came of it
      type(sweep_report_t), intent(inout) :: report
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(runs_t) :: missing
      type(study_facts_t) :: facts
      character(len=:), allocatable :: reason

      call study_facts(deck, facts)
      if (facts%deck /= study%facts%deck) then
         call raise(error, kind_file, "a table that the cases name has changed while they were computed, and it is not known "// &
            & "which case had which; remove "//part_beginning(study%path)//"* to start again")
         return
      end if
      if (ended /= ended_all .or. options%shards > 1) then
         call find_parts(study%path, part_beginning(study%path), paths)
         call scan_all(paths, study%facts, index, error)
         if (allocated(error)) return
         call missing_runs(index, study%first, study%last, missing)
         if (run_total(missing) > 0) then
            reason = "was stopped"
            if (ended == ended_by_time) reason = "reached its time limit"
            call raise(error, kind_unfinished, "the sweep "//reason//" with "//integer_text(run_total(missing))//" of "// &
               & counted(study%last - study%first + 1, "case")//" to do; continue with --resume")
            return
         end if
      end if
      if (options%shards > 1) then
         report%ending = sweep_shard_done
         report%cases_of_shard = study%last - study%first + 1
      else
         call make_result(study, deck, options, .false., monitor, report, error)
      end if
   end subroutine finish

end module camroller_sweep
