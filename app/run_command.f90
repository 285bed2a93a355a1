!> The command `run`: every case of a deck into one result file.
!>
!> In: the command line. Out: a result file, a line about it. A case that fails is recorded and does not end the
!> others; the program still ends with its kind of error. Where no case has a result, there is no file.
module camroller_run_command
   use camroller_error, only : error_t, add_context
   use camroller_blas_threads, only : check_blas_memory
   use camroller_case, only : case_t
   use camroller_ehl_profiles, only : find_profiles
   use camroller_ehl_record, only : ehl_record_t
   use camroller_effect_report, only : complete_result
   use camroller_result, only : result_t
   use camroller_run, only : run_next_case
   use camroller_kept_models, only : kept_models_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, read_deck, make_sweep_case, add_places, drop_sweep
   use camroller_deck_files, only : list_deck_files
   use camroller_deck_notes, only : tell_deck_remarks
   use camroller_deck_sweep, only : sweep_size, case_in_words
   use camroller_earlier_result, only : failures_in_words
   use camroller_mistakes, only : line_t
   use camroller_new_file, only : check_place
   use camroller_number_text, only : counted, integer_text
   use camroller_output, only : output_t, output_options_t, open_output, write_case, write_failure, close_output, &
      & abandon_output
   use camroller_profile_file, only : profile_file_t, put_profiles, close_profiles
   use camroller_progress, only : progress_t, start_progress, show_progress, end_progress, seconds_since
   use camroller_remarks, only : remarks_t, note_remarks
   use camroller_result_table, only : write_result_table
   use camroller_run_facts, only : write_facts
   use camroller_settings, only : take
   use camroller_streams, only : print_lines, tell
   implicit none
   private

   public :: run_deck, check_cases, options_of, find_place, tell_remarks, tell_unused_values

   !> What happened to the cases
   type :: tally_t
      !> Cases without a result
      integer :: failed = 0
      !> The first failure
      type(error_t), allocatable :: failure
      !> Remarks by kind
      type(remarks_t) :: remarks
   end type tally_t

contains

   !> Run a deck.
   subroutine run_deck(config, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> What went wrong; the first failure where there are several
      type(error_t), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(output_t) :: writer
      type(progress_t) :: progress
      type(tally_t) :: tally
      character(len=:), allocatable :: path
      integer :: cases

      call read_deck(deck, config%subject, config%overrides, error)
      if (allocated(error)) return
      if (config%has_no_sweep) call drop_sweep(deck)
      if (.not. config%is_quiet) call tell_unused_values(deck)
      if (.not. config%is_quiet) call tell_deck_remarks(deck)
      call check_cases(deck, error)
      if (allocated(error)) return
      call find_place(config, deck, ".h5", path, error)
      if (allocated(error)) return
      cases = sweep_size(deck%sweep)
      call start_progress(progress, config%is_quiet)
      call open_output(writer, path, cases, options_of(deck), error)
      if (.not. allocated(error)) call write_facts(writer, deck, error)
      if (.not. allocated(error)) call run_cases(deck, writer, progress, tally, error)
      call end_progress(progress)
      if (allocated(error)) return
      if (tally%failed == cases) then
         call abandon_output(writer)
         call move_alloc(tally%failure, error)
         call add_places(deck, error)
         return
      end if
      call close_output(writer, error)
      if (allocated(error)) return
      if (.not. config%is_quiet) call report(deck, path, seconds_since(progress), tally, error)
      if (allocated(error) .or. tally%failed == 0) return
      call move_alloc(tally%failure, error)
      error%message = failures_in_words(tally%failed, cases, error%message)
      call add_places(deck, error)
   end subroutine run_deck

   !> Say which values given beside the deck are not used, since the sweep varies their keys.
   subroutine tell_unused_values(deck)
      !> The deck
      type(deck_t), intent(in) :: deck

      integer :: i, j

      do i = 1, size(deck%overrides)
         do j = 1, size(deck%sweep%axes)
            associate (key => deck%sweep%axes(j)%key, text => deck%overrides(i)%text)
               if (trim(adjustl(text(:index(text, "=") - 1))) /= key) cycle
               call tell("remark: '"//text//"' is not used, since &sweep varies "//key//new_line("a"))
            end associate
         end do
      end do
   end subroutine tell_unused_values

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

   !> Run and write every case.
   subroutine run_cases(deck, writer, progress, tally, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> The result file
      type(output_t), intent(inout) :: writer
      !> How far the run is
      type(progress_t), intent(inout) :: progress
      !> What happened
      type(tally_t), intent(inout) :: tally
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(kept_models_t) :: kept
      type(case_t) :: case
      type(result_t) :: result
      type(profile_file_t) :: profile_file
      type(ehl_record_t), allocatable :: profiles
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, failure)
         if (.not. allocated(failure)) then
            call run_next_case(kept, case, result, failure, writer%options%series .or. allocated(case%ehl))
            if (.not. allocated(failure)) call find_profiles(profiles, case, result)
            if (sweep_size(deck%sweep) > 1 .and. .not. allocated(failure)) call complete_result(case, result)
            if (size(deck%sweep%axes) > 0) call add_context(failure, case_in_words(deck%sweep, i))
         end if
         if (allocated(failure)) then
            call write_failure(writer, i, failure, error)
            tally%failed = tally%failed + 1
            if (tally%failed == 1) tally%failure = failure
         else
            call write_case(writer, i, result, error)
            if (.not. allocated(error)) call put_profiles(profile_file, writer, i, profiles, error)
            call note_remarks(tally%remarks, i, result%remarks)
         end if
         if (allocated(error)) exit
         call show_progress(progress, i, sweep_size(deck%sweep))
      end do
      call close_profiles(profile_file)
   end subroutine run_cases

   !> Choices of the group &output.
   function options_of(deck) result(options)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What is written, and how
      type(output_options_t) :: options

      call take(deck%settings, "output", "series", options%series)
      call take(deck%settings, "output", "compression", options%compression)
   end function options_of

   !> File to write, which must not be one that the deck is read from.
   subroutine find_place(config, deck, ending, path, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Ending in place of the deck's, where no file is asked for
      character(len=*), intent(in) :: ending
      !> Path of the file
      character(len=:), allocatable, intent(out) :: path
      !> Usage or file error
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: inputs(:)

      path = output_path(config, ending)
      call list_deck_files(deck, inputs)
      call check_place(path, inputs, error)
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

   !> Say what was done.
   subroutine report(deck, path, time, tally, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Path of the result file
      character(len=*), intent(in) :: path
      !> Time taken, in words
      character(len=*), intent(in) :: time
      !> What happened
      type(tally_t), intent(in) :: tally
      !> File error of the output unit
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: table

      call write_result_table(path, table, error)
      if (.not. allocated(error)) call print_lines(table, error)
      if (.not. allocated(error)) call print_lines(path//": "//counted(sweep_size(deck%sweep), "case")//" in "//time, error)
      call tell_remarks(tally%remarks, deck)
   end subroutine report

   !> Show remarks: all of a case that is alone; of several cases the worst of each kind, with the number of cases.
   subroutine tell_remarks(remarks, deck)
      !> The remarks
      type(remarks_t), intent(in) :: remarks
      !> The deck
      type(deck_t), intent(in) :: deck

      character(len=:), allocatable :: words
      integer :: i

      if (.not. allocated(remarks%groups)) return
      do i = 1, size(remarks%groups)
         associate (group => remarks%groups(i), cases => sweep_size(deck%sweep))
            words = "remark"
            if (cases > 1) words = "remark on "//integer_text(group%cases)//" of "//integer_text(cases)//" cases, the worst is "// &
               & case_in_words(deck%sweep, group%case_number)
            call tell(words//": "//group%worst%text//new_line("a"))
         end associate
      end do
      if (size(remarks%groups) > 0) call tell("all remarks are in /run/warnings of the result file"//new_line("a"))
   end subroutine tell_remarks

end module camroller_run_command
