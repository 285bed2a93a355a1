!> The command `sweep`: many cases in threads, in processes, in shards; restartable; one file at the end.
!>
!> Layer: app. In: the command line, a team of processes. Out: part files while it runs, the result file at the end, an exit
!> code. Each process appends to a part file of its own; the first one finds out what is still to be done, and makes the
!> result file when nothing is.
module camroller_sweep_command
   use, intrinsic :: iso_c_binding, only : c_intptr_t
   use, intrinsic :: iso_fortran_env, only : error_unit, int64, output_unit
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_deck, kind_file, kind_unfinished, kind_usage
   use camroller_assemble, only : assemble, tally_t
   use camroller_case_loop, only : compute_cases, ended_by_time, loop_t, number_of_cores
   use camroller_case_runs, only : missing_runs, run_total, runs_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck
   use camroller_deck_sweep, only : case_in_words, sweep_size
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : open_file, read_text_attribute
   use camroller_mistakes, only : line_t
   use camroller_number_text, only : integer_text
   use camroller_output, only : abandon_output, close_output, open_output, output_options_t, output_t
   use camroller_part_file, only : index_t, open_part, part_beginning, scan_part, study_facts_t, sync_part, close_part
   use camroller_part_sink, only : part_sink_t
   use camroller_progress, only : end_progress, progress_t, seconds_since, start_progress
   use camroller_raw_file, only : find_files
   use camroller_run_command, only : options_of, output_path, tell_remarks, tell_unused_values
   use camroller_run_facts, only : study_digest, study_facts, write_facts
   use camroller_settings, only : get_word, is_known, take
   use camroller_stop_signal, only : heed_stop_signals, release_stop_signals
   use camroller_system_file, only : ignore_size_signal, remove_file
   use camroller_team, only : team_t
   implicit none
   private

   public :: sweep_deck, merge_deck

   !> A sweep being run
   type :: sweep_run_t
      type(deck_t) :: deck
      type(study_facts_t) :: facts
      !> Path of the result file
      character(len=:), allocatable :: path
      !> First and last case of this shard, from 1
      integer :: first = 1, last = 0
      !> Cases still to be computed
      type(runs_t) :: runs
      !> Is the result file there, with everything in it?
      logical :: is_complete = .false.
   end type sweep_run_t

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
         if (.not. config%is_quiet) write (output_unit, '(a)') run%path//" is there with all cases"
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

      call begin(config, run, error)
      if (agreed_code(team, error) /= 0) return
      if (team%rank == 0 .and. .not. config%is_quiet) call tell_unused_values(run%deck)
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

   !> The deck and the path of its result.
   subroutine begin(config, run, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> Deck or usage error
      type(error_t), allocatable, intent(out) :: error

      call read_deck(run%deck, config%subject, config%overrides, error)
      if (allocated(error)) return
      call study_facts(run%deck, run%facts)
      run%path = output_path(config, ".h5")
      if (run%path == config%subject) then
         call raise(error, kind_usage, "the result would replace the deck '"//run%path//"'")
      else if (wants_profiles(run%deck) .and. series_choice(run%deck) == "none") then
         call raise(error, kind_deck, "'ehl.profiles' has no cases: a sweep keeps profiles of the cases whose series it keeps, "// &
            & "1.6 MB each at 720 cam angles; choose them by 'sweep.series', or leave 'ehl.profiles' out")
      end if
   end subroutine begin

   !> Does a deck ask for profiles across the contact?
   function wants_profiles(deck) result(answer)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Does it?
      logical :: answer

      answer = .false.
      call take(deck%settings, "ehl", "profiles", answer)
   end function wants_profiles

   !> Series of which cases are kept.
   function series_choice(deck) result(choice)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> One of the names of the key
      character(len=:), allocatable :: choice

      choice = get_word(deck%settings, "sweep", "series")
      if (choice == "") choice = "none"
   end function series_choice

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
      character(len=:), allocatable :: own

      own = ""
      if (config%shards > 1) own = shard_name(config)
      call find_files(part_beginning(run%path)//own, paths)
      if (size(paths) > 0 .and. .not. config%is_resumed) then
         call raise(error, kind_file, "'"//paths(1)%text//"' is there from a sweep that was stopped; go on with it by "// &
            & "--resume, or remove "//part_beginning(run%path)//own//"*")
         return
      end if
      call find_files(part_beginning(run%path), paths)
      if (size(paths) == 0 .and. config%is_resumed) run%is_complete = is_complete_file(run)
      if (run%is_complete) return
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, run%first, run%last, run%runs)
   end subroutine find_work

   !> Is there a result file of this very sweep?
   function is_complete_file(run) result(verdict)
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> Is there?
      logical :: verdict

      type(hdf5_object_t) :: file
      type(error_t), allocatable :: error
      character(len=:), allocatable :: digest

      verdict = .false.
      call open_file(file, run%path, error)
      if (allocated(error)) return
      call read_text_attribute(file, "/run", "study", digest, error)
      if (.not. allocated(error)) verdict = digest == study_digest(run%facts)
      call discard_file(file)
   end function is_complete_file

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

      if (.not. allocated(index%entries)) allocate (index%entries(64), index%layouts(4))
      do i = 1, size(paths)
         call scan_part(paths(i)%text, facts, index, error)
         if (allocated(error)) return
      end do
   end subroutine scan_all

   !> Name of the part file of a shard, behind the beginning of all.
   pure function shard_name(config) result(name)
      !> What to do
      type(config_t), intent(in) :: config
      !> The name
      character(len=:), allocatable :: name

      name = "shard-"//integer_text(config%shard)//"-of-"//integer_text(config%shards)//"-"
   end function shard_name

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
      character(len=:), allocatable :: own
      real(wp) :: limit ! [s]

      loop%threads = config%threads
      if (loop%threads == 0) loop%threads = number_of_cores()
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
      own = part_beginning(run%path)
      if (config%shards > 1) own = own//shard_name(config)
      own = own//"rank-"//integer_text(team%rank)
      if (run_total(run%runs) == 0) return
      call open_part(sink%part, own, run%facts, error)
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
      character(len=:), allocatable :: reason

      call find_files(part_beginning(run%path), paths)
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, run%first, run%last, missing)
      if (run_total(missing) > 0) then
         reason = "was stopped"
         if (loop%ended == ended_by_time) reason = "reached its time limit"
         call raise(error, kind_unfinished, "the sweep "//reason//" with "//integer_text(run_total(missing))//" of "// &
            & integer_text(run%last - run%first + 1)//" cases to do; go on with it by --resume")
      else if (config%shards > 1) then
         if (.not. config%is_quiet) write (output_unit, '(a)') run%path//": shard "//integer_text(config%shard)//" of "// &
            & integer_text(config%shards)//" is done, "//integer_text(run%last - run%first + 1)//" cases in "// &
            & seconds_since(loop%progress)
      else
         call write_result(config, run, index, paths, loop%progress, error)
      end if
   end subroutine finish

   !> Make the one file of a sweep from its parts.
   subroutine merge_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(sweep_run_t) :: run
      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(loop_t) :: loop

      call begin(config, run, error)
      if (allocated(error)) return
      call start_progress(loop%progress, .true.)
      call find_files(part_beginning(run%path), paths)
      if (size(paths) == 0) then
         call raise(error, kind_file, "there is no '"//part_beginning(run%path)//"*'")
         return
      end if
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      call missing_runs(index, 1, run%facts%cases, run%runs)
      if (run_total(run%runs) > 0 .and. .not. config%is_partial) then
         call raise(error, kind_unfinished, integer_text(run_total(run%runs))//" of "//integer_text(run%facts%cases)// &
            & " cases are missing, the first is "//case_in_words(run%deck%sweep, run%runs%first(1))// &
            & "; compute them by 'camroller sweep --resume', or merge what is there by --partial")
         return
      end if
      call write_result(config, run, index, paths, loop%progress, error)
   end subroutine merge_deck

   !> Write the result file; the parts are removed where it is complete.
   subroutine write_result(config, run, index, paths, progress, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> What the part files hold
      type(index_t), intent(inout) :: index
      !> The part files
      type(line_t), intent(in) :: paths(:)
      !> Start of the command
      type(progress_t), intent(in) :: progress
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(output_t) :: writer
      type(output_options_t) :: options
      type(tally_t) :: tally
      character(len=:), allocatable :: series

      options = options_of(run%deck)
      series = series_choice(run%deck)
      options%series = series == "all" .or. series == "chosen"
      call remove_files(run%path//".unfinished-")
      call open_output(writer, run%path, run%facts%cases, options, error)
      if (.not. allocated(error)) call write_facts(writer, run%deck, error)
      if (.not. allocated(error)) call assemble(index, paths, run%facts%cases, series == "chosen", writer, tally, &
         & error)
      if (.not. allocated(error)) call close_output(writer, error)
      if (allocated(error)) then
         call abandon_output(writer)
         return
      end if
      if (tally%missing == 0) call remove_files(part_beginning(run%path))
      if (.not. config%is_quiet) call report(run, tally, seconds_since(progress))
      if (tally%failed == 0) return
      call move_alloc(tally%failure, error)
      error%message = integer_text(tally%failed)//" of "//integer_text(tally%cases)//" cases have no result; the first is "// &
         & error%message
   end subroutine write_result

   !> Remove files, such as an unfinished result of a process that was killed.
   subroutine remove_files(beginning)
      !> Beginning of their paths
      character(len=*), intent(in) :: beginning

      type(line_t), allocatable :: paths(:)
      integer :: i

      call find_files(beginning, paths)
      do i = 1, size(paths)
         call remove_file(paths(i)%text)
      end do
   end subroutine remove_files

   !> Say what was done.
   subroutine report(run, tally, time)
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> What happened
      type(tally_t), intent(in) :: tally
      !> Time taken, in words
      character(len=*), intent(in) :: time

      character(len=:), allocatable :: words

      words = run%path//": "//integer_text(tally%cases - tally%missing)//" cases in "//time
      if (tally%missing > 0) words = words//", "//integer_text(tally%missing)//" missing"
      write (output_unit, '(a)') words
      call tell_remarks(tally%remarks, run%deck)
   end subroutine report

end module camroller_sweep_command
