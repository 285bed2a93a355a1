!> The commands `run`, `sweep` and `merge`: every case of a deck into one result file.
!>
!> In: the command line, for a sweep a team of processes. Out: the file, a line about it, remarks. A case that fails is recorded and
!> does not end the others; the program still ends with its kind of error.
module camroller_run_command
   use, intrinsic :: iso_c_binding, only : c_intptr_t
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_blas_threads, only : check_blas_memory
   use camroller_case, only : case_t
   use camroller_case_writer, only : tally_t
   use camroller_cli, only : config_t
   use camroller_hdf5_columns, only : hdf5_columns_t
   use camroller_console, only : console_t, seconds_since, start_console, tell_deck_remarks, add_number_remarks
   use camroller_deck, only : deck_t, drop_sweep, read_deck, make_sweep_case
   use camroller_deck_files, only : list_deck_files
   use camroller_deck_remarks, only : list_deck_remarks
   use camroller_deck_sweep, only : case_in_words, sweep_size
   use camroller_deck_sweep_keys, only : series_choice_name
   use camroller_text_lines, only : line_t
   use camroller_new_file, only : check_place
   use camroller_number_text, only : counted, integer_text
   use camroller_output_kind, only : output_kind_t
   use camroller_result_table, only : write_result_table
   use camroller_settings, only : find_value
   use camroller_stop_signal, only : heed_stop_signals, release_stop_signals
   use camroller_streams, only : print_lines, tell
   use camroller_sweep, only : merge_sweep, run_sweep
   use camroller_sweep_file, only : sweep_made, sweep_options_t, sweep_report_t, sweep_shard_done, sweep_was_complete
   use camroller_system_file, only : ignore_size_signal
   use camroller_team, only : agreed_code, team_t
   implicit none
   private

   public :: run_deck, sweep_deck, merge_deck, check_cases, find_place, tell_remarks

contains

   !> Run a deck: one case after the other, straight into the file.
   subroutine run_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first failure where there are several
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_t) :: deck
      type(console_t) :: console
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure

      call check_blas_memory(1, error)
      if (.not. allocated(error)) call read_deck(deck, config%subject, config%overrides, error, columns)
      call add_number_remarks(deck, error, .false.)
      if (allocated(error)) return
      if (config%has_no_sweep) call drop_sweep(deck)
      if (.not. config%is_quiet) call tell_deck_remarks(deck)
      call check_cases(deck, error)
      if (allocated(error)) return
      call start_console(console, config%is_quiet)
      call run_sweep(deck, output_path(config, ".h5"), sweep_options_t(is_direct=.true., threads=1), report, failure, console)
      call conclude(config, deck, console, report, failure, error)
   end subroutine run_deck

   !> Run a sweep: in threads and processes, with part files that survive any end.
   subroutine sweep_deck(config, team, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Processes that share it
      class(team_t), intent(inout) :: team
      !> What went wrong, on the first process
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_t) :: deck
      type(console_t) :: console
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure
      integer(c_intptr_t) :: former

      call ignore_size_signal(former)
      call heed_stop_signals()
      call check_blas_memory(1, error)
      if (.not. allocated(error)) call read_deck(deck, config%subject, config%overrides, error, columns)
      call add_number_remarks(deck, error, .false.)
      if (agreed_code(team, error) /= 0) return
      if (team%rank == 0 .and. .not. config%is_quiet) call tell_sweep_remarks(deck)
      call start_console(console, config%is_quiet .or. team%rank /= 0, real(config%log_interval, wp))
      console%heeds_signals = .true.
      call run_sweep(deck, output_path(config, ".h5"), options_of(config), report, failure, console, team)
      ! the others wait for the first one, which may still be told to stop
      if (team%rank == 0) call release_stop_signals()
      call conclude(config, deck, console, report, failure, error)
   end subroutine sweep_deck

   !> Show remarks on the deck, and on what a sweep does not use of it.
   subroutine tell_sweep_remarks(deck)
      type(deck_t), intent(in) :: deck

      call tell_deck_remarks(deck)
      if (.not. deck%settings%values(find_value(deck%settings, "output", "series"))%is_given) return
      call tell("remark: output.series has no effect in a sweep, which writes the series that sweep.series says: '"// &
         & series_choice_name(deck%settings)//"'"//new_line("a"))
   end subroutine tell_sweep_remarks

   !> Make the one file of a sweep from its parts.
   subroutine merge_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_t) :: deck
      type(console_t) :: console
      type(sweep_report_t) :: report
      type(error_t), allocatable :: failure

      call read_deck(deck, config%subject, config%overrides, error, columns)
      if (allocated(error)) return
      call start_console(console, config%is_quiet)
      call merge_sweep(deck, output_path(config, ".h5"), options_of(config), report, failure, console)
      call conclude(config, deck, console, report, failure, error)
   end subroutine merge_deck

   !> What the command line says of a sweep.
   pure function options_of(config) result(options)
      !> What to do
      type(config_t), intent(in) :: config
      !> The same for the sweep
      type(sweep_options_t) :: options

      options%threads = config%threads
      options%shard = config%shard
      options%shards = config%shards
      options%is_resumed = config%is_resumed
      options%is_partial = config%is_partial
   end function options_of

   !> Do the values of every case go together?
   subroutine check_cases(deck, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Deck error; too little memory to run any
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      integer :: i

      call check_blas_memory(1, error)
      if (allocated(error)) return
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, error)
         if (allocated(error)) return
      end do
   end subroutine check_cases

   !> File to write, which may replace an earlier one of its kind, and none that the deck is read from.
   subroutine find_place(config, deck, kind, ending, path, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What the file will be
      type(output_kind_t), intent(in) :: kind
      !> Ending in place of the deck's, where no file is asked for
      character(len=*), intent(in) :: ending
      !> Path of the file
      character(len=:), allocatable, intent(out) :: path
      !> Usage or file error
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: inputs(:)

      path = output_path(config, ending)
      call list_deck_files(deck, inputs)
      call check_place(path, kind, inputs, error)
   end subroutine find_place

   !> File to write: as asked for, or the deck's name with another ending in the present folder.
   pure function output_path(config, ending) result(path)
      !> What to do
      type(config_t), intent(in) :: config
      !> Ending in place of the deck's
      character(len=*), intent(in) :: ending
      !> Path of the file
      character(len=:), allocatable :: path

      integer :: point

      path = config%output
      if (path /= "") return
      path = config%subject(index(config%subject, "/", back=.true.) + 1:)
      point = index(path, ".", back=.true.)
      if (point > 1) path = path(:point - 1)
      path = path//ending
   end function output_path

   !> Say what was done, and end with what went wrong.
   subroutine conclude(config, deck, console, report, failure, error)
      !> What to do
      type(config_t), intent(in) :: config
      type(deck_t), intent(in) :: deck
      !> Start of the command
      type(console_t), intent(in) :: console
      !> What came of it
      type(sweep_report_t), intent(in) :: report
      !> What went wrong
      type(error_t), allocatable, intent(inout) :: failure
      !> The same, or a file error of the output unit
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: words, table

      words = output_path(config, ".h5")
      select case (merge(-1, report%ending, config%is_quiet))
      case (sweep_made)
         words = words//": "//counted(report%tally%cases - report%tally%missing, "case")//" in "//seconds_since(console)
         if (report%tally%missing > 0) words = words//", "//integer_text(report%tally%missing)//" missing"
         if (config%command == "run") then
            call write_result_table(output_path(config, ".h5"), table, error)
            if (.not. allocated(error)) call print_lines(table, error)
         end if
         if (.not. allocated(error)) call print_lines(words, error)
         call tell_remarks(report%tally, deck, config%command /= "merge")
      case (sweep_was_complete)
         call print_lines(words//" is there with all cases", error)
      case (sweep_shard_done)
         call print_lines(words//": shard "//integer_text(config%shard)//" of "//integer_text(config%shards)//" is done, "// &
            & counted(report%cases_of_shard, "case")//" in "//seconds_since(console), error)
      end select
      if (.not. allocated(error) .and. allocated(failure)) call move_alloc(failure, error)
   end subroutine conclude

   !> Show remarks: of a case that is alone all but those that its deck has had before; of several cases the worst of each kind,
   !> with the number of cases.
   subroutine tell_remarks(tally, deck, has_told_deck)
      !> What happened to the cases
      type(tally_t), intent(in) :: tally
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Has the command shown the remarks on the deck?
      logical, intent(in) :: has_told_deck

      type(line_t), allocatable :: earlier(:)
      character(len=:), allocatable :: words, places
      integer :: i, k

      if (.not. allocated(tally%remarks%groups)) return
      call list_deck_remarks(deck, earlier)
      do i = 1, size(tally%remarks%groups)
         associate (group => tally%remarks%groups(i), cases => tally%cases - tally%missing)
            if (has_told_deck .and. tally%cases == 1 .and. any([(earlier(k)%text == group%worst%text, k=1, size(earlier))])) cycle
            words = "remark"
            if (tally%cases > 1) words = "remark on "//integer_text(group%cases)//" of "//counted(cases, "case")// &
               & ", the worst is "//case_in_words(deck%sweep, group%case_number)
            call tell(words//": "//group%worst%text//new_line("a"))
         end associate
      end do
      places = ""
      if (size(earlier) > 0) places = " and /deck/remarks"
      if (size(tally%remarks%groups) > 0) places = places//" and /run/warnings"
      if (places /= "") call tell("all remarks are in"//places(5:)//" of the result file"//new_line("a"))
   end subroutine tell_remarks

end module camroller_run_command
