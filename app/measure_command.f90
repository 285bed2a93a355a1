!> The commands `study` and `audit`: every case of a deck measured, into one table on the screen and in a file; and `limit`: speeds
!> up to which a train follows its cam.
!>
!> In: the command line. Out: the table. A case that cannot be measured is recorded and does not end the others; the
!> program still ends with its kind of error.
module camroller_measure_command
   use camroller_error, only : error_t, add_context
   use camroller_audit, only : new_audit_table, audit_case
   use camroller_audit_page, only : write_audit_page
   use camroller_case, only : case_t, select_names, select_needed
   use camroller_case_writer, only : tally_t
   use camroller_cli, only : config_t
   use camroller_command_table, only : command_t, find_command, find_option, list_commands
   use camroller_hdf5_columns, only : hdf5_columns_t
   use camroller_deck, only : deck_t, drop_sweep, make_case, make_sweep_case, override_t, read_deck
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_kinds, only : per_minute
   use camroller_laws_page, only : add_laws_table
   use camroller_limit_speeds, only : limits_t, start_limits, try_speed
   use camroller_limits_page, only : write_limits_page
   use camroller_number_text, only : counted
   use camroller_output, only : output_t, output_options_t, open_output, abandon_output
   use camroller_output_kind, only : result_kind
   use camroller_console, only : console_t, seconds_since, start_console, tell_deck_remarks
   use camroller_run_command, only : check_cases, find_place
   use camroller_run_facts, only : write_facts
   use camroller_settings, only : get_word
   use camroller_streams, only : print_lines, tell
   use camroller_study, only : new_study_table, study_case, study_film
   use camroller_study_file, only : write_study, close_study
   use camroller_study_page, only : write_study_page
   use camroller_study_table, only : study_table_t, column_of
   use camroller_sweep_file, only : conclude
   implicit none
   private

   public :: study_deck, limit_deck

   !> What can be measured, and what its table holds
   integer, parameter :: of_accuracy = 1, of_film = 2, of_effects = 3
   character(len=*), parameter :: endings(*) = [character(len=14) :: "_study.h5", "_film_study.h5", "_audit.h5"]
   character(len=*), parameter :: names(*) = [character(len=5) :: "study", "study", "audit"]
   character(len=*), parameter :: titles(*) = [character(len=48) :: "errors, work and time of every method", &
      & "errors, work and time of numerical films", "influence and cost of each effect"]

contains

   !> What accuracy costs, of the integration or of the numerical film, or influence and cost of each effect.
   subroutine study_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first case without a reference where there are several
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_t) :: deck

      if (config%is_laws) then
         call read_deck(deck, config%subject, config%overrides, error, columns)
         if (allocated(error)) return
         call tell_deck_remarks(deck)
         call tell_choice(deck)
         call show_laws(deck, error)
      else if (config%command == "audit") then
         call measure_deck(config, of_effects, error)
      else
         call measure_deck(config, merge(of_film, of_accuracy, config%is_film), error)
      end if
   end subroutine study_deck

   !> Tell that a study takes all effects of a deck.
   subroutine tell_choice(deck)
      type(deck_t), intent(in) :: deck

      if (get_word(deck%settings, "effects", "select") == select_names(select_needed)) call tell("remark: effects.select = '"// &
         & trim(select_names(select_needed))//"' has no effect here: all that is compared has all effects of the deck"// &
         & new_line("a"))
   end subroutine tell_choice

   !> Print what each film law makes of the cases.
   subroutine show_laws(deck, error)
      type(deck_t), intent(in) :: deck
      !> Deck error of a case, file error of the output unit; the first failure where there are several
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: case
      type(tally_t) :: tally
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: text
      integer :: i

      call print_lines(counted(sweep_size(deck%sweep), "case")//" with each film law; > marks that of the deck", error)
      do i = 1, sweep_size(deck%sweep)
         if (.not. allocated(error)) call make_sweep_case(deck, i, case, error)
         if (allocated(error)) return
         text = ""
         if (size(deck%sweep%axes) > 0) text = new_line("a")//case_in_words(deck%sweep, i)
         call add_laws_table(case, text, failure)
         call count_case(tally, deck, i, failure)
         call print_lines(text, error)
      end do
      if (.not. allocated(error)) call conclude(tally, error)
   end subroutine show_laws

   !> Speeds up to which the train of a deck follows its cam.
   subroutine limit_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns
      type(deck_t) :: deck
      type(case_t) :: case
      type(override_t) :: none(0)
      type(console_t) :: progress
      type(limits_t) :: search
      character(len=:), allocatable :: text

      call read_deck(deck, config%subject, config%overrides, error, columns)
      if (allocated(error)) return
      call drop_sweep(deck)
      call make_case(deck, none, case, error)
      if (.not. allocated(error)) call start_limits(search, case, config%seating_speed, config%highest_speed/per_minute, &
         & min(config%speed_step, config%highest_speed)/per_minute, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) call tell_deck_remarks(deck)
      if (.not. (config%is_quiet .or. search%is_flexible)) call tell_unused_options(config)
      call start_console(progress, config%is_quiet)
      do while (search%is_open)
         call try_speed(search)
         call progress%show(search%done, search%total)
      end do
      call progress%end_cases()
      call write_limits_page(search, text)
      call print_lines(text, error)
   end subroutine limit_deck

   !> Say which options are of no use for a rigid train.
   subroutine tell_unused_options(config)
      !> What to do
      type(config_t), intent(in) :: config

      type(command_t), allocatable :: commands(:)
      character(len=*), parameter :: options(*) = [character(len=9) :: "--to", "--step", "--seating"]
      integer :: i

      call list_commands(commands)
      do i = 1, size(options)
         if (config%given(find_option(commands(find_command(commands, config%command)), trim(options(i)))) == 0) cycle
         call tell("remark: "//trim(options(i))//" is not used: the limits of a train without &dynamics follow from its forces"// &
            & new_line("a"))
      end do
   end subroutine tell_unused_options

   !> Measure every case of a deck.
   subroutine measure_deck(config, what, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What is measured
      integer, intent(in) :: what
      !> What went wrong; the first failure where there are several
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_columns_t) :: columns

      type(deck_t) :: deck
      type(output_t) :: writer
      type(console_t) :: progress
      type(study_table_t) :: table
      type(tally_t) :: tally
      character(len=:), allocatable :: path, page

      call read_deck(deck, config%subject, config%overrides, error, columns)
      if (.not. allocated(error)) call check_cases(deck, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) call tell_deck_remarks(deck)
      call find_place(config, deck, result_kind, trim(endings(what)), path, error)
      if (allocated(error)) return
      if (what /= of_effects .and. .not. config%is_quiet) call tell_choice(deck)
      call start_console(progress, config%is_quiet)
      call open_output(writer, path, sweep_size(deck%sweep), output_options_t(), error)
      if (.not. allocated(error)) call write_facts(writer, deck, what /= of_effects, error)
      if (allocated(error)) return
      call measure_cases(deck, config, what, progress, table, tally)
      call progress%end_cases()
      if (.not. any(column_of(table, "status") <= 0.0)) then
         call abandon_output(writer)
         error = tally%failure
         return
      end if
      call write_study(writer, trim(names(what)), trim(titles(what)), table, error)
      if (.not. allocated(error)) call close_study(writer, error)
      if (allocated(error)) return
      if (what == of_effects) then
         call write_audit_page(table, page)
      else
         call write_study_page(table, page)
      end if
      if (.not. config%is_quiet) call print_lines(page//new_line("a")//path//": "//counted(sweep_size(deck%sweep), "case")// &
         & " in "//seconds_since(progress), error)
      if (.not. allocated(error)) call conclude(tally, error)
   end subroutine measure_deck

   !> Measure every case.
   subroutine measure_cases(deck, config, what, progress, table, tally)
      type(deck_t), intent(in) :: deck
      !> What to do
      type(config_t), intent(in) :: config
      !> What is measured
      integer, intent(in) :: what
      !> How far the command is
      type(console_t), intent(inout) :: progress
      type(study_table_t), intent(out) :: table
      !> What happened to the cases
      type(tally_t), intent(out) :: tally

      type(case_t) :: case
      type(error_t), allocatable :: error
      integer :: i

      if (what == of_effects) call new_audit_table(table)
      if (what /= of_effects) call new_study_table(table)
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, error)
         if (.not. allocated(error)) then
            select case (what)
            case (of_accuracy)
               call study_case(table, i, case, config%repeats, config%is_quick, error)
            case (of_film)
               call study_film(table, i, case, config%repeats, config%is_quick, error)
            case default
               call audit_case(table, i, case, config%repeats, .true., error)
            end select
         end if
         call count_case(tally, deck, i, error)
         call progress%show(i, sweep_size(deck%sweep))
      end do
   end subroutine measure_cases

   !> Take note of what happened to a case.
   subroutine count_case(tally, deck, number, failure)
      !> What happened to the cases so far
      type(tally_t), intent(inout) :: tally
      type(deck_t), intent(in) :: deck
      !> Number of the case, from 1
      integer, intent(in) :: number
      !> Why it has no result, if it has none
      type(error_t), allocatable, intent(inout) :: failure

      tally%cases = tally%cases + 1
      if (.not. allocated(failure)) return
      tally%failed = tally%failed + 1
      if (size(deck%sweep%axes) > 0) call add_context(failure, case_in_words(deck%sweep, number))
      if (tally%failed == 1) call move_alloc(failure, tally%failure)
   end subroutine count_case

end module camroller_measure_command
