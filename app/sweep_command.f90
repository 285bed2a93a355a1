!> The command `sweep`: many cases in threads, in processes, in shards; restartable; one file at the end.
!>
!> In: the command line, a team of processes. Out: part files while it runs, the result file at the end, an exit
!> code. Each process appends to a part file of its own; the first one finds out what is still to be done, and makes the
!> result file when nothing is.
module camroller_sweep_command
   use, intrinsic :: iso_c_binding, only : c_intptr_t
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_file, kind_unfinished, kind_usage
   use camroller_case_loop, only : compute_cases, ended_all, ended_by_time, loop_t, set_threads
   use camroller_case_runs, only : missing_runs, run_total, runs_in_words, runs_t
   use camroller_cli, only : config_t
   use camroller_earlier_result, only : complete_there, earlier_t, look_at_earlier, other_there, partial_there
   use camroller_mistakes, only : line_t
   use camroller_number_text, only : counted, integer_text
   use camroller_part_file, only : close_part, find_parts, open_part, part_beginning, part_name, sync_part
   use camroller_part_scan, only : index_t, study_facts_t
   use camroller_part_sink, only : part_sink_t
   use camroller_progress, only : end_progress, progress_t, seconds_since, start_progress
   use camroller_deck_notes, only : tell_deck_remarks
   use camroller_run_command, only : tell_unused_values
   use camroller_run_facts, only : study_facts
   use camroller_settings, only : take
   use camroller_streams, only : print_lines, tell
   use camroller_stop_signal, only : heed_stop_signals, release_stop_signals
   use camroller_sweep_result, only : make_result, tell_complete
   use camroller_sweep_study, only : begin_study, scan_all, series_choice, sweep_run_t, tell_damages
   use camroller_system_file, only : ignore_size_signal
   use camroller_team, only : team_t
   implicit none
   private

   public :: sweep_deck, merge_deck

contains

   !> Run a sweep.
   subroutine sweep_deck(config, team, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Processes that share it
      class(team_t), intent(inout) :: team
      !> What went wrong, on the first process
      type(error_t), allocatable, intent(out) :: error

      type(sweep_run_t) :: run
      type(loop_t) :: loop
      integer(c_intptr_t) :: former

      call ignore_size_signal(former)
      call heed_stop_signals()
      call prepare(config, team, run, error)
      if (agreed_code(team, error) /= 0) return
      call compute(config, team, run, loop, error)
      if (agreed_code(team, error) /= 0) return
      if (team%rank /= 0) return
      call release_stop_signals()
      if (run%is_complete) then
         call tell_complete(config, run%path, run%failure, error)
         return
      end if
      call finish(config, run, loop, error)
   end subroutine sweep_deck

   !> Exit code that all processes have in common: 0 where none has an error.
   function agreed_code(team, error) result(code)
      !> The processes
      class(team_t), intent(inout) :: team
      !> Error of this process
      type(error_t), allocatable, intent(in) :: error
      !> The largest of their codes
      integer :: code

      code = 0
      if (allocated(error)) code = error%kind
      call team%largest(code)
   end function agreed_code

   !> Read the deck, find out what is to be done.
   subroutine prepare(config, team, run, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Processes that share it
      class(team_t), intent(inout) :: team
      !> The sweep
      type(sweep_run_t), intent(out) :: run
      !> Deck, file or usage error
      type(error_t), allocatable, intent(out) :: error

      integer, allocatable :: numbers(:)

      call begin_study(config, run, error)
      if (agreed_code(team, error) /= 0) return
      if (team%rank == 0 .and. .not. config%is_quiet) call tell_unused_values(run%deck)
      if (team%rank == 0 .and. .not. config%is_quiet) call tell_deck_remarks(run%deck)
      run%first = int((config%shard - 1)*int(run%facts%cases, int64)/config%shards) + 1
      run%last = int(config%shard*int(run%facts%cases, int64)/config%shards)
      if (run%first > run%last) then
         call raise(error, kind_usage, integer_text(config%shards)//" shards are more than there are cases")
         return
      end if
      allocate (run%runs%first(0), run%runs%count(0))
      if (team%rank == 0) call find_work(config, run, error)
      numbers = [run%runs%first, run%runs%count]
      call team%share(numbers)
      run%runs%first = numbers(:size(numbers)/2)
      run%runs%count = numbers(size(numbers)/2 + 1:)
   end subroutine prepare

   !> Cases that no part file has.
   subroutine find_work(config, run, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(earlier_t) :: earlier
      character(len=:), allocatable :: own

      own = part_name(run%path, config%shard, config%shards)
      call find_parts(run%path, own, paths)
      if (size(paths) > 0 .and. .not. config%is_resumed) then
         call raise(error, kind_file, "'"//paths(1)%text//"' exists from a sweep that was stopped; continue it with "// &
            & "--resume, or remove "//own//"*")
         return
      end if
      call find_parts(run%path, part_beginning(run%path), paths)
      call look_at_earlier(earlier, run%path, run%facts)
      if (config%is_resumed .and. earlier%state == other_there) then
         call raise(error, kind_file, "'"//run%path//"' is there, and it is no result of this sweep: "//earlier%reason// &
            & new_line("a")//"--resume does not replace it; move it away, name another file by -o, or leave --resume out")
         return
      else if (config%is_resumed .and. earlier%state == complete_there .and. size(paths) == 0) then
         run%is_complete = .true.
         call move_alloc(earlier%failure, run%failure)
         return
      end if
      call tell_earlier(config, run, earlier, size(paths))
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, run%first, run%last, run%runs)
      if (size(index%damages) == 0) return
      call tell_damages(index)
      if (run_total(run%runs) > 0) call tell("remark: to be computed: "//runs_in_words(run%runs)//new_line("a"))
   end subroutine find_work

   !> Say what becomes of a file that is there.
   subroutine tell_earlier(config, run, earlier, parts)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> What is there
      type(earlier_t), intent(in) :: earlier
      !> Number of part files
      integer, intent(in) :: parts

      if (config%is_quiet) return
      if (earlier%state == other_there) then
         call tell("remark: '"//run%path//"' is there, and it is no result of this sweep: "//earlier%reason// &
            & new_line("a")//"it is replaced when all cases are done"//new_line("a"))
      else if (earlier%state == partial_there .and. parts == 0 .and. config%is_resumed) then
         call tell("remark: '"//run%path//"' has "//integer_text(earlier%computed)//" of "// &
            & counted(run%facts%cases, "case")//", and their part files are gone: all cases are computed"//new_line("a"))
      end if
   end subroutine tell_earlier

   !> Compute what is to be computed.
   subroutine compute(config, team, run, loop, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Processes that share it
      class(team_t), intent(inout) :: team
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> How the loop ended
      type(loop_t), intent(out) :: loop
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(part_sink_t) :: sink
      type(error_t), allocatable :: last
      real(wp) :: limit ! [s]

      loop%series = series_choice(run%deck)
      loop%profiles = loop%series
      allocate (loop%series_cases(0))
      call take(run%deck%settings, "sweep", "series_cases", loop%series_cases)
      call start_progress(loop%progress, config%is_quiet .or. team%rank /= 0, real(config%log_interval, wp))
      limit = 0.0_wp
      call take(run%deck%settings, "sweep", "wall_time_limit_s", limit)
      if (limit > 0.0_wp) loop%deadline = clock_in(limit)
      call take(run%deck%settings, "sweep", "checkpoint_s", sink%interval)
      call team%reset()
      if (run_total(run%runs) == 0) return
      call set_threads(loop, config%threads, error)
      if (allocated(error)) return
      call open_part(sink%part, part_name(run%path, config%shard, config%shards, team%rank), run%facts, error)
      if (allocated(error)) return
      call compute_cases(loop, run%deck, run%runs, team, sink, error)
      call end_progress(loop%progress)
      call sync_part(sink%part, last)
      call close_part(sink%part)
      if (.not. allocated(error) .and. allocated(last)) call move_alloc(last, error)
   end subroutine compute

   !> The clock some time from now.
   function clock_in(time) result(clock)
      !> The time [s]
      real(wp), intent(in) :: time
      !> The clock
      integer(int64) :: clock

      integer(int64) :: rate

      call system_clock(clock, rate)
      clock = clock + int(time*real(rate, wp), int64)
   end function clock_in

   !> Make the result file where everything is done; say what is not.
   subroutine finish(config, run, loop, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> How the loop ended
      type(loop_t), intent(in) :: loop
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(runs_t) :: missing
      type(study_facts_t) :: facts
      character(len=:), allocatable :: reason

      call study_facts(run%deck, facts)
      if (facts%deck /= run%facts%deck) then
         call raise(error, kind_file, "a table that the cases name has changed while they were computed, and it is not known "// &
            & "which case had which; remove "//part_beginning(run%path)//"* to start again")
         return
      end if
      if (loop%ended == ended_all .and. config%shards == 1) then
         call make_result(config, run, "continue with --resume", loop%progress, error)
         return
      end if
      reason = "was stopped"
      if (loop%ended == ended_by_time) reason = "reached its time limit"
      call find_parts(run%path, part_beginning(run%path), paths)
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, run%first, run%last, missing)
      if (run_total(missing) > 0) then
         call raise(error, kind_unfinished, "the sweep "//reason//" with "//integer_text(run_total(missing))//" of "// &
            & counted(run%last - run%first + 1, "case")//" to do; continue with --resume")
      else if (config%shards > 1) then
         if (.not. config%is_quiet) call print_lines(run%path//": shard "//integer_text(config%shard)//" of "// &
            & integer_text(config%shards)//" is done, "//counted(run%last - run%first + 1, "case")//" in "// &
            & seconds_since(loop%progress), error)
      else
         call make_result(config, run, "continue with --resume", loop%progress, error)
      end if
   end subroutine finish

   !> Make the one file of a sweep from its parts.
   subroutine merge_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(sweep_run_t) :: run
      type(progress_t) :: progress

      call begin_study(config, run, error)
      if (allocated(error)) return
      call start_progress(progress, .true.)
      call make_result(config, run, "compute them with 'camroller sweep --resume', or merge the others with --partial", progress, &
         & error)
   end subroutine merge_deck

end module camroller_sweep_command
