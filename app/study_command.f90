!> The command `study`: what accuracy costs, over every case of a deck.
!>
!> Layer: app. In: the command line. Out: tables on the output unit and in a file. A case without a reference is recorded and does
!> not end the others; the program still ends with its kind of error.
module camroller_study_command
   use camroller_error, only : error_t, add_context
   use camroller_case, only : case_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck, make_sweep_case
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_film_study, only : study_films
   use camroller_number_text, only : counted
   use camroller_output, only : output_t, output_options_t, open_output, abandon_output
   use camroller_progress, only : progress_t, start_progress, show_progress, end_progress, seconds_since
   use camroller_run_command, only : check_cases, find_place
   use camroller_run_facts, only : write_facts
   use camroller_streams, only : print_lines
   use camroller_study, only : reference_t, make_reference, new_method_table, new_reference_table, study_methods, &
      & add_reference
   use camroller_study_accuracy, only : new_accuracy_table, study_accuracy
   use camroller_study_file, only : write_study, close_study
   use camroller_study_models, only : new_model_table, study_models
   use camroller_study_page, only : reference_page, method_page, accuracy_page, model_page
   use camroller_study_table, only : study_table_t
   implicit none
   private

   public :: study_deck

   !> Tables, and what they hold
   character(len=*), parameter :: table_names(*) = [character(len=10) :: "references", "methods", "accuracy", "models"]
   character(len=*), parameter :: table_titles(*) = [character(len=56) :: "what counts as right, case by case", &
      & "errors, work and time of every method", "accuracy asked for, kept and paid for", "what simpler models change and save"]
   !> Their positions
   integer, parameter :: references = 1, methods = 2, accuracies = 3, models = 4

contains

   !> Study a deck.
   subroutine study_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first case without a reference where there are several
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(output_t) :: writer
      type(progress_t) :: progress
      type(study_table_t) :: tables(size(table_names))
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: path

      call read_deck(deck, config%subject, config%overrides, error)
      if (.not. allocated(error)) call check_cases(deck, error)
      if (allocated(error)) return
      if (config%is_film) then
         call find_place(config, deck, "_film_study.h5", path, error)
      else
         call find_place(config, deck, "_study.h5", path, error)
      end if
      if (allocated(error)) return
      call start_progress(progress, config%is_quiet)
      call open_output(writer, path, sweep_size(deck%sweep), output_options_t(), error)
      if (.not. allocated(error)) call write_facts(writer, deck, error)
      if (allocated(error)) return
      if (config%is_film) then
         call study_films(deck, config, path, writer, progress, error)
         return
      end if
      call study_cases(deck, config, progress, tables, failure)
      call end_progress(progress)
      if (count(tables(references)%numbers(:tables(references)%rows, 2) <= 0.0) == 0) then
         call abandon_output(writer)
         call move_alloc(failure, error)
         return
      end if
      call write_study(writer, table_names, table_titles, tables, error)
      if (.not. allocated(error)) call close_study(writer, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) call report(path, tables, seconds_since(progress), error)
      if (allocated(failure) .and. .not. allocated(error)) call move_alloc(failure, error)
   end subroutine study_deck

   !> Study every case.
   subroutine study_cases(deck, config, progress, tables, failure)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What to do
      type(config_t), intent(in) :: config
      !> How far the study is
      type(progress_t), intent(inout) :: progress
      !> The tables
      type(study_table_t), intent(out) :: tables(:)
      !> What went wrong with the first case that has no reference
      type(error_t), allocatable, intent(out) :: failure

      type(case_t) :: case
      type(reference_t) :: reference
      type(error_t), allocatable :: error
      integer :: i

      call new_reference_table(tables(references))
      call new_method_table(tables(methods))
      call new_accuracy_table(tables(accuracies))
      call new_model_table(tables(models))
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, error)
         if (.not. allocated(error)) call make_reference(case, reference, error)
         call add_reference(tables(references), i, case, reference, error)
         if (allocated(error)) then
            if (size(deck%sweep%axes) > 0) call add_context(error, case_in_words(deck%sweep, i))
            if (.not. allocated(failure)) call move_alloc(error, failure)
         else
            call study_methods(tables(methods), i, case, reference, config%repeats, config%is_quick)
            call study_accuracy(tables(accuracies), i, case, reference, config%repeats)
            call study_models(tables(models), i, case, config%repeats)
         end if
         call show_progress(progress, i, sweep_size(deck%sweep))
      end do
   end subroutine study_cases

   !> Print the tables.
   subroutine report(path, tables, time, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The tables
      type(study_table_t), intent(in) :: tables(:)
      !> Time taken, in words
      character(len=*), intent(in) :: time
      !> File error of the output unit
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: n = new_line("a")

      call print_lines(reference_page(tables(references))//n//method_page(tables(methods))//n// &
         & accuracy_page(tables(accuracies))//n//model_page(tables(models))//n// &
         & path//": "//counted(tables(references)%rows, "case")//" in "//time, error)
   end subroutine report

end module camroller_study_command
