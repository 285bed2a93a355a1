!> The command `rerun`: a result file, of `ehl` too, computed again from the deck that is stored in it, and compared bit by bit.
!>
!> In: the command line, a result file. Out: a line that says that nothing differs, or what does and which build made
!> the file. The deck, the values given beside it and its tables are taken from the file, so that nothing else is needed.
module camroller_rerun_command
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_difference, kind_file, kind_unfinished
   use camroller_case_loop, only : compute_cases, ended_all, loop_t, set_threads
   use camroller_case_runs, only : runs_t
   use camroller_cli, only : config_t
   use camroller_comparison_sink, only : comparison_sink_t
   use camroller_differences, only : another_text
   use camroller_hdf5_columns, only : hdf5_columns_t
   use camroller_deck, only : deck_t, override_t, add_override, parse_deck
   use camroller_deck_document, only : echo_t, get_echo
   use camroller_deck_sweep, only : sweep_size
   use camroller_deck_sweep_keys, only : series_all, series_choice, series_chosen
   use camroller_deck_files, only : list_case_tables
   use camroller_deck_tables, only : deck_tables_t, kept_table_t, table_groups
   use camroller_ehl_rerun, only : rerun_contacts
   use camroller_hdf5_file, only : discard_file
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : has_member, is_text_dataset, list_members, member_length, open_file, read_extents, &
      & read_integer_attribute, read_numbers, read_text, read_text_attribute
   use camroller_text_lines, only : line_t
   use camroller_number_text, only : agreeing, counted, integer_text, is_number, number_text
   use camroller_output, only : not_computed, result_format
   use camroller_console, only : console_t, seconds_since, start_console
   use camroller_quotes, only : in_quotes, without_quotes
   use camroller_result_columns, only : check_has_cases, holds_contacts_alone
   use camroller_run_facts, only : find_other_build
   use camroller_settings, only : take
   use camroller_sorting, only : find_order
   use camroller_streams, only : print_lines
   use camroller_stop_signal, only : heed_stop_signals, release_stop_signals
   use camroller_table_file, only : read_heading, table_t
   use camroller_team, only : team_t
   use camroller_version, only : build_commit, names_sources
   implicit none
   private

   public :: rerun_file

contains

   !> Compute a file again.
   subroutine rerun_file(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> File error, or what differs
      type(error_t), allocatable, intent(out) :: error

      type(comparison_sink_t), allocatable :: sink
      type(deck_t) :: deck
      type(loop_t) :: loop
      type(console_t) :: console
      type(team_t) :: alone
      type(runs_t) :: runs
      character(len=:), allocatable :: facts, defaults
      integer :: missing
      logical :: holds_contacts

      allocate (sink)
      call open_file(sink%file, config%subject, error)
      if (allocated(error)) return
      call read_stored_deck(sink%file, config%subject, deck, error)
      if (.not. allocated(error)) call find_other_build(sink%file, facts, error)
      if (.not. allocated(error)) call find_other_defaults(sink%file, deck, defaults)
      holds_contacts = holds_contacts_alone(sink%file)
      if (.not. (allocated(error) .or. holds_contacts)) call choose_series(sink%file, deck, loop, error)
      if (.not. (allocated(error) .or. holds_contacts)) call choose_cases(sink%file, sweep_size(deck%sweep), runs, error)
      if (.not. allocated(error)) call set_threads(loop, config%threads, error)
      if (.not. allocated(error)) then
         sink%sweep = deck%sweep
         call heed_stop_signals()
         call start_console(console, config%is_quiet, real(config%log_interval, wp))
         console%heeds_signals = .true.
         if (holds_contacts) then
            call rerun_contacts(sink, deck, console, error)
         else
            call compute_cases(loop, deck, runs, sink, alone, console, error)
         end if
         call console%end_cases()
         call release_stop_signals()
      end if
      call discard_file(sink%file)
      if (allocated(error)) return
      missing = sweep_size(deck%sweep) - loop%total
      if (holds_contacts) missing = 0
      call conclude(config, sink, loop, console, missing, defaults, facts, error)
   end subroutine rerun_file

   !> Cases to be computed: those that the file has, which are not all where it is partial.
   subroutine choose_cases(file, cases, runs, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Number of cases
      integer, intent(in) :: cases
      !> Runs of cases that were computed
      type(runs_t), intent(out) :: runs
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: status(:) ! [-]
      logical, allocatable :: is_there(:)
      integer :: i

      call read_numbers(file, "/summary/status", [0], [cases], status, error)
      if (allocated(error)) return
      is_there = nint(status) /= not_computed
      runs%first = pack([(i, i=1, cases)], is_there .and. .not. [.false., is_there(:cases - 1)])
      runs%count = pack([(i, i=1, cases)], is_there .and. .not. [is_there(2:), .false.]) - runs%first + 1
   end subroutine choose_cases

   !> The deck of a result file, with all that belongs to it.
   subroutine read_stored_deck(file, path, deck, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      character(len=*), intent(in) :: path
      type(deck_t), intent(out) :: deck
      !> File or deck error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_tables_t) :: tables
      type(override_t), allocatable :: overrides(:)
      character(len=:), allocatable :: text, format
      integer, allocatable :: extents(:)

      call read_text_attribute(file, "/", "format", format, error)
      if (.not. allocated(error)) then
         if (format /= result_format) call raise(error, kind_file, "'"//path//"' is no result file")
      end if
      if (.not. allocated(error)) call read_text(file, "/deck/text", [integer ::], text, error)
      if (.not. allocated(error)) call read_overrides(file, path, overrides, error)
      if (.not. allocated(error)) call check_has_cases(file, .true., error)
      if (.not. allocated(error)) call read_table(file, "lift", tables%lift, error)
      if (.not. allocated(error)) call read_table(file, "second_lift", tables%second_lift, error)
      if (.not. allocated(error)) call read_table(file, "gas_force", tables%pressure, error)
      if (.not. allocated(error)) call parse_deck(deck, text, path//":/deck/text", "", overrides, error, tables, columns)
      if (.not. allocated(error)) call read_case_tables(file, deck, error)
      if (.not. allocated(error)) call read_extents(file, "/case", 1, extents, error)
      if (allocated(error)) return
      if (extents(1) /= sweep_size(deck%sweep)) then
         call raise(error, kind_file, "'"//path//"' has "//counted(extents(1), "case")//", its deck "// &
            & integer_text(sweep_size(deck%sweep)))
      end if
   end subroutine read_stored_deck

   !> Values that were given beside the deck; the file itself is the table of cases of a sweep that had one.
   subroutine read_overrides(file, path, overrides, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      character(len=*), intent(in) :: path
      !> The values
      type(override_t), allocatable, intent(out) :: overrides(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      integer, allocatable :: extents(:)
      integer :: i

      allocate (overrides(0))
      if (has_member(file, "/deck/overrides")) then
         call read_extents(file, "/deck/overrides", 1, extents, error)
         if (allocated(error)) return
         do i = 1, extents(1)
            call read_text(file, "/deck/overrides", [i - 1], text, error)
            if (allocated(error)) return
            call add_override(overrides, text)
         end do
      end if
      if (has_member(file, "/deck/values/sweep.table")) call add_override(overrides, "sweep.table="//in_quotes(path))
   end subroutine read_overrides

   !> Tables that cases name beside those of the deck: from the file alone.
   subroutine read_case_tables(file, deck, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> The deck; gets the tables
      type(deck_t), intent(inout) :: deck
      !> File error where the file does not hold them
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: names(:)
      type(kept_table_t), allocatable :: kept(:)
      type(kept_table_t) :: new
      character(len=:), allocatable :: group
      integer :: i, k, stored

      allocate (kept(0))
      do i = 1, size(table_groups)
         group = trim(table_groups(i))
         call list_case_tables(deck, group, names)
         if (size(names) == 0) cycle
         call read_integer_attribute(file, "/deck", "tables_"//group, stored, error)
         if (allocated(error)) stored = 0
         if (stored /= size(names)) then
            call raise(error, kind_file, "'"//file%file//"' does not hold '"//names(1)%text//"', a table that cases name in '"// &
               & group//".table', and cannot be computed again")
            return
         end if
         new%group = group
         do k = 1, size(names)
            call read_table(file, group//"_"//integer_text(k), new%table, error)
            if (allocated(error)) return
            new%table%path = names(k)%text
            kept = [kept, new]
         end do
      end do
      call move_alloc(kept, deck%tables%kept)
   end subroutine read_case_tables

   !> A table of the deck, where the file has it.
   subroutine read_table(file, group, table, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Group of the deck that names the table, with the number of one that cases name
      character(len=*), intent(in) :: group
      !> The table; without rows where the file does not have it
      type(table_t), intent(out) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, heading
      type(error_t), allocatable :: ignored
      real(wp), allocatable :: numbers(:) ! [units of the table]
      integer, allocatable :: extents(:)
      integer :: rows, i

      name = "/deck/table_"//group
      allocate (table%x(0), table%y(0), table%line(0))
      if (.not. has_member(file, name)) return
      call read_extents(file, name, 2, extents, error)
      if (.not. allocated(error)) then
         if (extents(2) /= 2) call raise(error, kind_file, "'"//name//"' of '"//file%file//"' does not have two columns")
      end if
      if (.not. allocated(error)) call read_numbers(file, name, [0, 0], extents, numbers, error)
      ! the path as the deck names it is what is looked for, the deck having no folder
      if (.not. allocated(error) .and. has_member(file, "/deck/values/"//group//".table")) then
         call read_text(file, "/deck/values/"//group//".table", [integer ::], table%path, error)
      end if
      if (allocated(error)) return
      call read_text_attribute(file, name, "heading", heading, ignored)
      if (.not. allocated(ignored)) call read_heading(heading, table)
      rows = size(numbers)/2
      table%x = numbers(:rows)
      table%y = numbers(rows + 1:)
      table%line = [(i, i=1, rows)]
   end subroutine read_table

   !> Series and profiles of which cases are to be compared: those that the file has.
   subroutine choose_series(file, deck, loop, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      type(deck_t), intent(in) :: deck
      !> Gets the choice
      type(loop_t), intent(inout) :: loop
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=member_length), allocatable :: names(:)
      integer :: choice

      call list_members(file, "/series", names, error)
      if (allocated(error)) return
      allocate (loop%series_cases(0))
      choice = series_all
      if (series_choice(deck%settings) == series_chosen) choice = series_chosen
      call take(deck%settings, "sweep", "series_cases", loop%series_cases)
      if (size(names) > 0) loop%series = choice
      loop%profiles = choice
   end subroutine choose_series

   !> Say what came of it, the largest difference first.
   subroutine conclude(config, sink, loop, console, missing, defaults, facts, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What differs
      type(comparison_sink_t), intent(in) :: sink
      !> How the loop ended
      type(loop_t), intent(in) :: loop
      !> Start of the command
      type(console_t), intent(in) :: console
      !> Cases that the file does not have
      integer, intent(in) :: missing
      !> Lines of keys whose defaults are others now; what tells the builds apart
      character(len=*), intent(in) :: defaults, facts
      !> What differs
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      integer, allocatable :: order(:)
      integer :: i

      if (sink%differing == 0 .and. loop%ended == ended_all) then
         text = config%subject//": "//counted(sink%cases, "case")//agreeing(sink%cases, " is", " are")// &
            & " the same to the last bit, "
         if (missing > 0) text = text//integer_text(missing)//agreeing(missing, " is", " are")//" not in the file, "
         if (.not. config%is_quiet) call print_lines(text//"in "//seconds_since(console), error)
         return
      else if (sink%differing == 0) then
         call raise(error, kind_unfinished, "stopped after "//counted(sink%cases, "case")//agreeing(sink%cases, &
            & ", which is the same", ", which are the same"))
         return
      end if
      text = config%subject//": "//integer_text(sink%differing)//" of "//counted(sink%cases, "case")// &
         & agreeing(sink%differing, " differs", " differ")//defaults
      allocate (order(size(sink%differences)))
      call find_order(-sink%differences%largest, order)
      do i = 1, size(order)
         associate (difference => sink%differences(order(i)))
            text = text//new_line("a")//"  "//difference%name//": in "//counted(difference%cases, "case")//", "
            if (difference%largest <= another_text) then
               text = text//"another text, first in case "
            else if (difference%largest < huge(1.0_wp)) then
               text = text//"at most by "//number_text(difference%largest, 2)// &
                  & trim(merge(" of its largest value", " of its value        ", difference%is_row))//" ("// &
                  & number_text(difference%stored)//" in the file, "//number_text(difference%computed)//" now), in case "
            else
               text = text//"a number in only one of the files, in case "
            end if
            text = text//integer_text(difference%case_number)
         end associate
      end do
      if (sink%failing > 0) text = text//new_line("a")//"  "//counted(sink%failing, "case")//agreeing(sink%failing, " has", &
         & " have")//" no result now, first case "//integer_text(sink%first_failing)//": "//sink%message
      call raise(error, kind_difference, text//builds_in_words(facts, build_commit))
   end subroutine conclude

   !> Keys that the deck leaves to their defaults, where these made the file with other values than they have now: lines of words.
   subroutine find_other_defaults(file, deck, lines)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Its deck, as it is read now
      type(deck_t), intent(in) :: deck
      !> The lines, each behind a new line; empty where none differs
      character(len=:), allocatable, intent(out) :: lines

      type(echo_t) :: echo
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: stored, name
      real(wp), allocatable :: number(:) ! [unit of the key]
      real(wp) :: now ! [unit of the key]
      integer :: i

      lines = ""
      call get_echo(deck, echo, .false.)
      do i = 1, size(echo%keys)
         if (echo%origins(i) /= "default") cycle
         name = "/deck/values/"//trim(echo%keys(i))
         if (.not. has_member(file, name)) cycle
         if (is_text_dataset(file, name)) then
            call read_text(file, name, [integer ::], stored, failure)
            if (allocated(failure) .or. stored == without_quotes(echo%values(i)%text)) cycle
            if (stored /= ".true." .and. stored /= ".false.") stored = "'"//stored//"'"
         else
            call read_numbers(file, name, [integer ::], [integer ::], number, failure)
            if (allocated(failure)) cycle
            if (is_number(echo%values(i)%text)) then
               read (echo%values(i)%text, *) now
               if (abs(number(1) - now) <= 0.0_wp) cycle
            end if
            stored = number_text(number(1))
         end if
         lines = lines//new_line("a")//"  "//trim(echo%keys(i))//", which the deck does not give: the default was "//stored// &
            & " when the file was made, and is "//echo%values(i)%text//" now"
      end do
   end subroutine find_other_defaults

   !> What tells the build of a file from this one, each fact on a line of its own.
   pure function builds_in_words(facts, commit) result(words)
      !> Lines of facts that differ
      character(len=*), intent(in) :: facts
      !> Commit of this build
      character(len=*), intent(in) :: commit
      !> The words
      character(len=:), allocatable :: words

      if (facts /= "") then
         words = facts
      else if (names_sources(commit)) then
         words = new_line("a")//"  the same version, commit, compiler and options made the file"
      else
         words = new_line("a")//"  the same version, compiler and options made the file; whether the same sources did is not "// &
            & "known, since the commit of both is '"//commit//"'"
      end if
   end function builds_in_words

end module camroller_rerun_command
