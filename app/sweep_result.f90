!> The one result file of a sweep, made of its part files.
!>
!> In: a study, the part files of it that are there. Out: the result file, an exit code; the parts are removed where
!> all cases are in it. One process at a time does this, so that none sees the parts while another removes them: parts go only
!> when the complete file has its name, and a partial file never takes the place of a complete one of the same study.
module camroller_sweep_result
   use camroller_error, only : error_t, raise, kind_file, kind_unfinished
   use camroller_assemble, only : assemble, tally_t
   use camroller_case_runs, only : missing_runs, run_total, runs_t
   use camroller_cli, only : config_t
   use camroller_deck_sweep, only : case_in_words
   use camroller_earlier_result, only : complete_there, earlier_t, failures_in_words, look_at_earlier, other_there
   use camroller_mistakes, only : line_t
   use camroller_number_text, only : agreeing, counted, integer_text
   use camroller_output, only : abandon_output, close_output, open_output, output_options_t, output_t
   use camroller_part_file, only : find_parts, part_beginning
   use camroller_part_scan, only : index_t
   use camroller_progress, only : progress_t, seconds_since
   use camroller_result_claim, only : claim_result, claim_t, give_up_claim, remove_unfinished
   use camroller_run_command, only : options_of, tell_remarks
   use camroller_run_facts, only : write_facts
   use camroller_streams, only : print_lines, tell
   use camroller_sweep_study, only : scan_all, series_choice, sweep_run_t, tell_damages
   use camroller_system_file, only : remove_file
   implicit none
   private

   public :: make_result, tell_complete

contains

   !> Make the result file where the parts have every case, or where a partial one is asked for.
   subroutine make_result(config, run, advice, progress, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> What to do where cases are missing
      character(len=*), intent(in) :: advice
      !> Start of the command
      type(progress_t), intent(in) :: progress
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(claim_t) :: claim
      logical :: is_mine

      call claim_result(claim, run%path, .false., is_mine, error)
      if (.not. (is_mine .or. allocated(error))) then
         if (.not. config%is_quiet) call tell("waiting for another process that makes '"//run%path//"'"//new_line("a"))
         call claim_result(claim, run%path, .true., is_mine, error)
      end if
      if (allocated(error)) return
      call join_parts(config, run, advice, progress, error)
      call give_up_claim(claim)
   end subroutine make_result

   !> Make the result file, alone.
   subroutine join_parts(config, run, advice, progress, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> The sweep
      type(sweep_run_t), intent(inout) :: run
      !> What to do where cases are missing
      character(len=*), intent(in) :: advice
      !> Start of the command
      type(progress_t), intent(in) :: progress
      !> File error, or the first failure
      type(error_t), allocatable, intent(out) :: error

      type(index_t) :: index
      type(line_t), allocatable :: paths(:)
      type(runs_t) :: missing
      type(earlier_t) :: earlier

      call find_parts(run%path, part_beginning(run%path), paths)
      call look_at_earlier(earlier, run%path, run%facts)
      if (size(paths) == 0 .and. earlier%state == complete_there) then
         call tell_complete(config, run%path, earlier%failure, error)
         return
      else if (size(paths) == 0) then
         call raise(error, kind_file, "there is no '"//part_beginning(run%path)//"*'")
         return
      end if
      call scan_all(paths, run%facts, index, error)
      if (allocated(error)) return
      if (config%command == "merge") call tell_damages(index)
      call missing_runs(index, 1, run%facts%cases, missing)
      if (run_total(missing) > 0 .and. .not. config%is_partial) then
         call raise(error, kind_unfinished, integer_text(run_total(missing))//" of "//counted(run%facts%cases, "case")// &
            & agreeing(run_total(missing), " is missing, ", " are missing, the first is ")// &
            & case_in_words(run%deck%sweep, missing%first(1))//"; "//advice)
      else if (run_total(missing) > 0 .and. earlier%state == complete_there) then
         call raise(error, kind_file, "'"//run%path//"' is there with all cases, and a partial file would replace it; move it "// &
            & "away first")
      else
         if (config%command == "merge" .and. earlier%state == other_there .and. .not. config%is_quiet) then
            call tell("remark: '"//run%path//"' is replaced, which is no result of this sweep: "//earlier%reason//new_line("a"))
         end if
         call write_result(config, run, index, paths, progress, error)
      end if
   end subroutine join_parts

   !> Say that there is nothing to do, and end as the study ended.
   subroutine tell_complete(config, path, failure, error)
      !> What to do
      type(config_t), intent(in) :: config
      !> Path of the result
      character(len=*), intent(in) :: path
      !> The error that its study ended with, where cases failed
      type(error_t), allocatable, intent(in) :: failure
      !> The same
      type(error_t), allocatable, intent(out) :: error

      if (.not. config%is_quiet) call print_lines(path//" is there with all cases", error)
      if (allocated(failure)) error = failure
   end subroutine tell_complete

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
      integer :: i

      options = options_of(run%deck)
      series = series_choice(run%deck)
      options%series = series == "all" .or. series == "chosen"
      call remove_unfinished(run%path)
      call open_output(writer, run%path, run%facts%cases, options, error)
      if (.not. allocated(error)) call write_facts(writer, run%deck, error, run%facts)
      if (.not. allocated(error)) call assemble(index, paths, run%facts%cases, series == "chosen", writer, tally, &
         & error)
      if (.not. allocated(error)) call close_output(writer, error)
      if (allocated(error)) then
         call abandon_output(writer)
         return
      end if
      if (tally%missing == 0) then
         do i = 1, size(paths)
            call remove_file(paths(i)%text)
         end do
      end if
      if (.not. config%is_quiet) call report(run, tally, seconds_since(progress), error)
      if (allocated(error) .or. tally%failed == 0) return
      call move_alloc(tally%failure, error)
      error%message = failures_in_words(tally%failed, tally%cases, error%message)
   end subroutine write_result

   !> Say what was done.
   subroutine report(run, tally, time, error)
      !> The sweep
      type(sweep_run_t), intent(in) :: run
      !> What happened
      type(tally_t), intent(in) :: tally
      !> Time taken, in words
      character(len=*), intent(in) :: time
      !> File error of the output unit
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: words

      words = run%path//": "//counted(tally%cases - tally%missing, "case")//" in "//time
      if (tally%missing > 0) words = words//", "//integer_text(tally%missing)//" missing"
      call print_lines(words, error)
      call tell_remarks(tally%remarks, run%deck)
   end subroutine report

end module camroller_sweep_result
