!> The commands: each does one thing and prints on the output unit; errors go to the error unit.
!>
!> In: the command line. Out: files, text, an exit code.
module camroller_commands
   use camroller_error, only : error_t, raise, add_context, kind_file, kind_usage
   use camroller_blas_threads, only : check_blas_memory, use_one_blas_thread
   use camroller_case, only : case_t
   use camroller_cli, only : config_t, get_arguments, read_arguments
   use camroller_command_table, only : command_t, find_command, help_for, help_for_all, list_commands
   use camroller_fmu_command, only : fmu_of_deck
   use camroller_freed_memory, only : keep_freed_memory
   use camroller_hdf5_columns, only : hdf5_columns_t
   use camroller_help_pages, only : bash_completion, manual_page
   use camroller_console, only : add_number_remarks, tell_deck_remarks
   use camroller_cycle_remarks, only : judge_laws
   use camroller_deck, only : deck_t, read_deck, make_case, make_sweep_case, add_places, drop_sweep, override_t
   use camroller_case_facts, only : describe_case
   use camroller_deck_document, only : write_defaults, write_page, write_resolved
   use camroller_deck_files, only : list_deck_files
   use camroller_deck_schema, only : group_effect
   use camroller_deck_sweep, only : axis_size, case_in_words, sweep_size
   use camroller_effect_choice, only : wants_choice, choose_effects
   use camroller_effect_list, only : choice_t
   use camroller_effect_words, only : choice_in_words
   use camroller_ehl_command, only : ehl_deck
   use camroller_export, only : export_csv, export_series, export_summary
   use camroller_measure_command, only : limit_deck, study_deck
   use camroller_text_lines, only : line_t
   use camroller_model, only : model_t
   use camroller_new_file, only : check_place, save_text
   use camroller_number_text, only : counted, integer_text
   use camroller_output_kind, only : cam_kind, drawing_kind, output_kind_t, table_kind
   use camroller_quotes, only : replaced
   use camroller_remarks, only : remark_t
   use camroller_rerun_command, only : rerun_file
   use camroller_run, only : build_models
   use camroller_selftest, only : run_selftest
   use camroller_cam_table, only : write_cam_table
   use camroller_lift_drawing, only : draw_lift
   use camroller_sketch, only : draw_mechanism
   use camroller_run_command, only : merge_deck, run_deck, sweep_deck
   use camroller_stop_signal, only : end_on_signals
   use camroller_streams, only : close_output_stream, hold_streams, print_lines, print_text, tell
   use camroller_text_file, only : read_text_file
   use camroller_sweep_cost, only : case_to_try, cost_in_words
   use camroller_team, only : team_t
   use camroller_version, only : version_text, build_commit, compiler_facts
   implicit none
   private

   public :: run_command_line

   !> Cases that `check` builds; of more it takes as many, evenly spread
   integer, parameter :: most_checked = 10000
   !> Cases whose effects it shows
   integer, parameter :: most_shown = 100

contains

   !> Do what the command line says.
   subroutine run_command_line(team, code)
      !> Processes that share the work of a sweep; the first one alone speaks
      class(team_t), intent(inout) :: team
      !> Exit code: 0, or the kind of the error
      integer, intent(out) :: code

      type(line_t), allocatable :: arguments(:)
      type(config_t) :: config
      type(error_t), allocatable :: error

      call hold_streams()
      call end_on_signals()
      call use_one_blas_thread()
      call keep_freed_memory()
      allocate (arguments(0))
      call get_arguments(arguments)
      call read_arguments(arguments, config, error)
      if (.not. allocated(error)) call run_command(config, team, error)
      if (.not. allocated(error)) call close_output_stream(error)
      code = 0
      if (.not. allocated(error)) return
      code = error%kind
      if (team%rank > 0 .and. code /= kind_file) return
      call tell("camroller: "//error%message//new_line("a"))
   end subroutine run_command_line

   !> Do one command.
   subroutine run_command(config, team, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Processes that share the work of a sweep
      class(team_t), intent(inout) :: team
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      if (team%rank > 0 .and. config%command /= "sweep") return
      if (config%is_help) then
         call show_help(config, config%command, error)
         return
      end if
      select case (config%command)
      case ("check")
         call check_deck(config, error)
      case ("defaults")
         call show_defaults(config, error)
      case ("version")
         call show_version(error)
      case ("help")
         call show_help(config, config%subject, error)
      case ("run")
         call run_deck(config, error)
      case ("sweep")
         call sweep_deck(config, team, error)
      case ("rerun")
         call rerun_file(config, error)
      case ("merge")
         call merge_deck(config, error)
      case ("study", "audit")
         call study_deck(config, error)
      case ("limit")
         call limit_deck(config, error)
      case ("ehl")
         call ehl_deck(config, error)
      case ("export")
         call export_table(config, error)
      case ("fmu")
         call fmu_of_deck(config, error)
      case ("selftest")
         call run_selftest(error)
      end select
   end subroutine run_command

   !> A table from a result file.
   subroutine export_table(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(line_t) :: inputs(1)
      character(len=:), allocatable :: path

      path = config%output
      if (path == "") path = "-"
      inputs(1)%text = config%subject
      if (path /= "-") call check_place(path, table_kind, inputs, error)
      if (allocated(error)) return
      call export_csv(config%subject, merge(export_summary, export_series, config%is_summary), config%case_number, path, error, &
         & config%columns, config%form)
   end subroutine export_table

   !> Help, or help for a command, or all of it in a form that other programs read.
   subroutine show_help(config, name, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Name of the command; blank for the program
      character(len=*), intent(in) :: name
      !> Usage error where there is no such command
      type(error_t), allocatable, intent(out) :: error

      type(command_t), allocatable :: commands(:)
      character(len=:), allocatable :: text
      integer :: found

      call list_commands(commands)
      found = find_command(commands, name)
      if (config%is_manual) then
         call manual_page(commands, text)
      else if (config%is_completion) then
         call bash_completion(commands, text)
      else if (found > 0) then
         call help_for(commands(found), text)
      else if (name == "") then
         call help_for_all(commands, text)
      else
         call raise(error, kind_usage, "unknown command '"//name//"'; see 'camroller help'")
         return
      end if
      call print_lines(text, error)
   end subroutine show_help

   !> Version and build.
   subroutine show_version(error)
      !> File error of the output unit
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: n = new_line("a")
      character(len=:), allocatable :: compiler, options

      call compiler_facts(compiler, options)
      call print_lines("camroller "//version_text//n//"commit "//build_commit//n//compiler//n//options, error)
   end subroutine show_version

   !> A complete deck.
   subroutine show_defaults(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Usage error where there is no such group
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: text

      if (config%is_markdown) then
         call write_page(config%subject, text, error)
      else
         call write_defaults(config%subject, text, error)
      end if
      if (.not. allocated(error)) call print_text(text, error)
   end subroutine show_defaults

   !> Check a deck and print what it comes to.
   subroutine check_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> File or deck error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns

      type(deck_t) :: deck
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(remark_t), allocatable :: remarks(:)
      character(len=:), allocatable :: text
      integer :: i, checked, number

      call read_deck(deck, config%subject, config%overrides, error, columns)
      call add_number_remarks(deck, error, .false.)
      if (.not. allocated(error)) call check_blas_memory(1, error)
      if (allocated(error)) return
      if (config%has_no_sweep) call drop_sweep(deck)
      checked = min(sweep_size(deck%sweep), most_checked)
      do i = 1, checked
         number = case_to_try(i, checked, sweep_size(deck%sweep))
         call make_sweep_case(deck, number, case, error)
         if (allocated(error)) return
         call build_models(case, models, error)
         if (size(deck%sweep%axes) > 0) call add_context(error, case_in_words(deck%sweep, number))
         call add_places(deck, error)
         call add_number_remarks(deck, error, .true.)
         if (allocated(error)) return
         if (.not. allocated(remarks)) call judge_laws(models(1), remarks)
      end do
      text = "! "//config%subject//" is valid: "//cases_in_words(deck)
      if (checked < sweep_size(deck%sweep)) text = text//", of which "//integer_text(checked)//" were checked"
      call print_lines(text, error)
      call tell_deck_remarks(deck)
      if (allocated(remarks)) call tell("remark: "//remarks(1)%text//new_line("a"))
      text = ""
      if (size(deck%sweep%axes) > 0) call cost_in_words(deck, text)
      text = text//"! effects in the case: "//effects_in_words(deck, .true.)//new_line("a")// &
         & "! effects not in the case: "//effects_in_words(deck, .false.)
      if (.not. allocated(error)) call print_lines(text, error)
      if (.not. allocated(error)) call show_case(config, deck, error)
      if (allocated(error)) return
      call write_resolved(deck, text)
      if (.not. allocated(error)) call print_text(text, error)
      if (.not. allocated(error)) call check_effects(deck, error)
   end subroutine check_deck

   !> Print what the deck's own case comes to; draw its mechanism and its lift, write its cam where that is asked for.
   subroutine show_case(config, deck, error)
      !> What to do
      type(config_t), intent(in) :: config
      type(deck_t), intent(in) :: deck
      !> File or deck error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(line_t), allocatable :: inputs(:)
      type(override_t) :: none(0)
      character(len=:), allocatable :: text

      call make_case(deck, none, case, error)
      if (.not. allocated(error)) call describe_case(case, text, error)
      if (allocated(error)) return
      if (size(deck%sweep%axes) > 0) text = "the deck without its &sweep:"//new_line("a")//text
      call print_lines("! "//replaced(text(:len(text) - 1), new_line("a"), new_line("a")//"! "), error)
      call list_deck_files(deck, inputs)
      if (.not. allocated(error) .and. config%drawing /= "") then
         call draw_mechanism(case, text, error)
         if (.not. allocated(error)) call save_beside(inputs, config%drawing, drawing_kind, text, error)
      end if
      if (.not. allocated(error) .and. config%lift_drawing /= "") then
         call draw_lift(case, text, error)
         if (.not. allocated(error)) call save_beside(inputs, config%lift_drawing, drawing_kind, text, error)
      end if
      if (.not. allocated(error) .and. config%cam_table /= "") then
         call write_cam_table(case, text, error)
         if (.not. allocated(error)) call save_beside(inputs, config%cam_table, cam_kind, text, error)
      end if
   end subroutine show_case

   !> Write a file that replaces none of those that were read.
   subroutine save_beside(inputs, path, kind, text, error)
      !> Files that were read
      type(line_t), intent(in) :: inputs(:)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What it is
      type(output_kind_t), intent(in) :: kind
      !> What it holds
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_place(path, kind, inputs, error)
      if (.not. allocated(error) .and. kind%name == cam_kind%name) call keep_contour(path, text, error)
      if (.not. allocated(error)) call save_text(path, kind, text, error)
   end subroutine save_beside

   !> An error where a table of a cam would replace another one: a deck may have it as its lift, after changes by hand.
   subroutine keep_contour(path, text, error)
      !> Path of the table, where a table of a cam may be
      character(len=*), intent(in) :: path
      !> What it is to hold
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(error_t), allocatable :: without_file
      character(len=:), allocatable :: earlier

      call read_text_file(path, earlier, without_file)
      if (allocated(without_file)) return
      if (earlier == "" .or. earlier == text) return
      call raise(error, kind_file, "'"//path//"' exists and holds another cam, which may have been changed by hand; give "// &
         & "another name, or remove it first")
   end subroutine keep_contour

   !> Print which effects the cases need, where the deck leaves that to the program.
   subroutine check_effects(deck, error)
      type(deck_t), intent(in) :: deck
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: n = new_line("a")
      character(len=:), allocatable :: text
      type(case_t) :: case, chosen
      type(choice_t) :: choice
      type(model_t), allocatable :: models(:)
      integer :: i, shown, number

      shown = min(sweep_size(deck%sweep), most_shown)
      do i = 1, shown
         number = case_to_try(i, shown, sweep_size(deck%sweep))
         call make_sweep_case(deck, number, case, error)
         if (.not. allocated(error)) call build_models(case, models, error)
         if (allocated(error)) return
         if (.not. wants_choice(case)) cycle
         call choose_effects(case, models, chosen, choice, error)
         if (allocated(error)) return
         text = "! effects that matter for "//trim(case%effects%quantity)//", and changes expected without them"//n
         if (size(deck%sweep%axes) > 0) text = text//"! "//case_in_words(deck%sweep, number)//n
         call print_lines(text//"!    "//replaced(choice_in_words(choice), n, n//"!    "), error)
         if (allocated(error)) return
      end do
   end subroutine check_effects

   !> Number of cases, and the grid they make up.
   function cases_in_words(deck) result(words)
      type(deck_t), intent(in) :: deck
      !> The words
      character(len=:), allocatable :: words

      integer :: i

      words = counted(1, "case")
      if (size(deck%sweep%axes) == 0) return
      words = counted(sweep_size(deck%sweep), "case")
      if (deck%sweep%kind /= "grid") words = words//" ("//trim(deck%sweep%kind)//")"
      words = words//" over"
      do i = 1, size(deck%sweep%axes)
         if (i > 1) words = words//" and"
         if (deck%sweep%kind == "grid") words = words//" "//integer_text(axis_size(deck%sweep%axes(i)))//" of"
         words = words//" "//deck%sweep%axes(i)%key
      end do
   end function cases_in_words

   !> Effects that are in a deck, or those that are not.
   function effects_in_words(deck, are_present) result(words)
      type(deck_t), intent(in) :: deck
      !> Those that are there?
      logical, intent(in) :: are_present
      !> The words
      character(len=:), allocatable :: words

      integer :: i

      words = ""
      do i = 1, deck%schema%group_count
         if (deck%schema%groups(i)%kind /= group_effect .or. deck%schema%groups(i)%name == "sweep") cycle
         if (deck%settings%groups(i)%is_present .neqv. are_present) cycle
         if (words /= "") words = words//", "
         words = words//trim(deck%schema%groups(i)%name)
      end do
      if (words == "") words = "none"
   end function effects_in_words

end module camroller_commands
