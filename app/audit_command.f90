!> The command `audit`: what each effect of a deck is worth and costs.
!>
!> Layer: app. In: the command line. Out: a table on the output unit and in a file. A case that cannot be run is told and does not
!> end the others; the program still ends with its kind of error.
module camroller_audit_command
   use camroller_error, only : error_t, add_context
   use camroller_audit, only : new_audit_table, audit_case
   use camroller_audit_page, only : audit_page
   use camroller_case, only : case_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck, make_sweep_case
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_number_text, only : counted
   use camroller_output, only : output_t, output_options_t, open_output, abandon_output
   use camroller_progress, only : progress_t, start_progress, show_progress, end_progress, seconds_since
   use camroller_run_command, only : check_cases, find_place
   use camroller_run_facts, only : write_facts
   use camroller_streams, only : print_lines
   use camroller_study_file, only : write_study, close_study
   use camroller_study_table, only : study_table_t
   implicit none
   private

   public :: audit_deck

contains

   !> Audit every case of a deck.
   subroutine audit_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first case that failed where there are several
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(output_t) :: writer
      type(progress_t) :: progress
      type(study_table_t) :: table
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: path

      call read_deck(deck, config%subject, config%overrides, error)
      if (.not. allocated(error)) call check_cases(deck, error)
      if (allocated(error)) return
      call find_place(config, deck, "_audit.h5", path, error)
      if (allocated(error)) return
      call start_progress(progress, config%is_quiet)
      call open_output(writer, path, sweep_size(deck%sweep), output_options_t(), error)
      if (.not. allocated(error)) call write_facts(writer, deck, error)
      if (allocated(error)) return
      call audit_cases(deck, config%repeats, progress, table, failure)
      call end_progress(progress)
      if (table%rows == 0) then
         call abandon_output(writer)
         call move_alloc(failure, error)
         return
      end if
      call write_study(writer, ["audit"], ["what each effect is worth and costs"], [table], error)
      if (.not. allocated(error)) call close_study(writer, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) then
         call print_lines(audit_page(table)//new_line("a")//path//": "//counted(sweep_size(deck%sweep), "case")//" in "// &
            & seconds_since(progress), error)
      end if
      if (allocated(failure) .and. .not. allocated(error)) call move_alloc(failure, error)
   end subroutine audit_deck

   !> Audit every case.
   subroutine audit_cases(deck, repeats, progress, table, failure)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Runs of which the quickest counts
      integer, intent(in) :: repeats
      !> How far the audit is
      type(progress_t), intent(inout) :: progress
      !> The table
      type(study_table_t), intent(out) :: table
      !> What went wrong with the first case that failed
      type(error_t), allocatable, intent(out) :: failure

      type(case_t) :: case
      type(error_t), allocatable :: error
      integer :: i

      call new_audit_table(table)
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, error)
         if (.not. allocated(error)) call audit_case(table, i, case, repeats, .true., error)
         if (allocated(error)) then
            if (sweep_size(deck%sweep) > 1) call add_context(error, case_in_words(deck%sweep, i))
            if (.not. allocated(failure)) call move_alloc(error, failure)
         end if
         call show_progress(progress, i, sweep_size(deck%sweep))
      end do
   end subroutine audit_cases

end module camroller_audit_command
