!> Result file: cases written one by one into a file that appears under its name only when it is complete.
!>
!> In: results, the deck, facts of the run. Out: one HDF5 file.
!>
!> Format, axes as C and Python see them:
!> `/case` (case) and `/series/cam_angle` (cam_angle) are dimensions;
!> `/series/<name>` (case, cam_angle) and `/summary/<name>` (case) carry `units`, `long_name` and `source`;
!> `/summary/status` (case) is 0 or the kind of the error, whose message is in `/run/messages` (case), or -1 for a case that was
!> not computed;
!> `/deck/text` is the deck as given, `/deck/overrides` the values given beside it, `/deck/values/<group.key>` what came of
!> all of them, `/deck/table_<group>` (column, row) the tables that it names; `/sweep/<group.key>` (case) are the keys that vary;
!> `/effects/<name>` (case) and `/effects/reasons` (case) tell which effects took part, where the deck leaves that to the program;
!> `/run` has attributes, and `/run/warnings` (case) where there are warnings.
!> The root has `format`, `format_version`, `axes` and `complete`, which is set last: 1, or 0 in a partial file, which has
!> `missing_cases` too.
!>
!> Cases are gathered in memory and written in blocks, so that the memory needed does not depend on their number.
!> Whatever fails, the unfinished file is removed, and an earlier file of the same name stays as it was. Behind what HDF5 reads
!> stands a seal, `camroller_seal`, by which a damaged file is known.
module camroller_output
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_internal
   use camroller_layout, only : layout_t
   use camroller_output_options, only : output_options_t
   use camroller_effect_words, only : choice_in_words
   use camroller_remarks, only : remark_lines
   use camroller_result, only : result_t
   use camroller_output_file, only : abandon_output, check_open, finish_file, format_version, &
      & not_computed, not_written, output_t, result_format, start_file
   use camroller_output_cases, only : check_position, check_result, create_layout, gather, gather_row, &
      & write_remark, write_rows, write_series_row, write_status
   use camroller_output_facts, only : write_deck, write_deck_table, write_overrides, write_run, write_sweep
   implicit none
   private

   public :: output_t, output_options_t, result_format, format_version, not_computed
   public :: open_output, write_case, write_failure, set_layout, write_outcome, close_output, abandon_output
   public :: write_deck, write_deck_table, write_overrides, write_sweep, write_run

contains

   !> Start a result file; the folder is tried now, not after the computation.
   subroutine open_output(writer, path, cases, options, error)
      !> The writer
      type(output_t), intent(out) :: writer
      !> Path of the finished file
      character(len=*), intent(in) :: path
      !> Number of cases
      integer, intent(in) :: cases
      !> What is written, and how
      type(output_options_t), intent(in) :: options
      !> File error where nothing can be written there; usage error
      type(error_t), allocatable, intent(out) :: error

      call start_file(writer, path, cases, options, error)
   end subroutine open_output

   !> Write the result of a case; the first one decides which series and scalars the file has.
   subroutine write_case(writer, position, result, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> Its result
      type(result_t), intent(in) :: result
      !> File error; internal error where the result does not fit the others
      type(error_t), allocatable, intent(out) :: error

      call check_position(writer, position, error)
      if (.not. allocated(error) .and. .not. allocated(writer%summary)) call create_layout(writer, result, error)
      if (.not. allocated(error)) call check_result(writer, result, error)
      if (.not. allocated(error)) call gather(writer, position, result, error)
      if (.not. allocated(error) .and. allocated(result%remarks)) then
         if (size(result%remarks) > 0) call write_remark(writer, writer%run, writer%warnings, "warnings", position, &
            & remark_lines(result%remarks), error)
      end if
      if (.not. allocated(error) .and. allocated(result%choice)) call write_remark(writer, writer%effects, writer%reasons, &
         & "reasons", position, choice_in_words(result%choice), error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_case

   !> Record that a case failed; its numbers read as not-a-number.
   subroutine write_failure(writer, position, failure, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> What went wrong with it
      type(error_t), intent(in) :: failure
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_position(writer, position, error)
      if (.not. allocated(error)) then
         call write_remark(writer, writer%run, writer%messages, "messages", position, failure%message, error)
      end if
      if (allocated(error)) then
         call abandon_output(writer)
      else
         writer%status(position) = failure%kind
      end if
   end subroutine write_failure

   !> Say what series and scalars the file has, before the first case.
   subroutine set_layout(writer, layout, is_sparse, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Series, scalars, cam angles
      type(layout_t), intent(in) :: layout
      !> Do only few cases have series?
      logical, intent(in) :: is_sparse
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(result_t) :: example

      example%summary = layout%summary
      example%series = layout%series
      example%angle = layout%angle
      writer%is_sparse = is_sparse
      call check_open(writer, error)
      if (.not. allocated(error)) call create_layout(writer, example, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine set_layout

   !> Write a case of any outcome into a file whose layout is set.
   subroutine write_outcome(writer, position, status, text, summary, series, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> 0, or the kind of its error
      integer, intent(in) :: status
      !> Message of the error, or remarks; may be empty
      character(len=*), intent(in) :: text
      !> Scalars in the order of the layout [unit of the scalar]
      real(wp), intent(in) :: summary(:)
      !> Series in the order of the layout, shape (angle, series) [unit of the series]; empty where there are none
      real(wp), intent(in) :: series(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_position(writer, position, error)
      if (.not. allocated(error) .and. text /= "") then
         if (status == 0) then
            call write_remark(writer, writer%run, writer%warnings, "warnings", position, text, error)
         else
            call write_remark(writer, writer%run, writer%messages, "messages", position, text, error)
         end if
      end if
      if (.not. allocated(error) .and. writer%is_sparse .and. size(series) > 0) then
         call write_series_row(writer, position, series, error)
      end if
      if (.not. allocated(error)) call gather_row(writer, position, status, summary, series, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_outcome

   !> Finish the file: the rest is written, `complete` set, the file closed and given its name.
   subroutine close_output(writer, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> File error; internal error where cases are missing
      type(error_t), allocatable, intent(out) :: error

      call check_open(writer, error)
      if (allocated(error)) return
      if (any(writer%status == not_written)) then
         call raise(error, kind_internal, "cannot finish '"//writer%path//"': cases are missing")
      else
         call write_rows(writer, error)
      end if
      if (.not. allocated(error)) call write_status(writer, error)
      if (.not. allocated(error)) call finish_file(writer, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine close_output

end module camroller_output
