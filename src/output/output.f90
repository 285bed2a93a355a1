!> Result file: cases written one by one into a file that appears under its name only when it is complete.
!>
!> In: results, the deck, facts of the run. Out: one HDF5 file.
!>
!> Format, axes as C and Python see them:
!> `/case` (case) and `/series/cam_angle` (cam_angle) are dimensions;
!> `/series/<name>` (case, cam_angle) and `/summary/<name>` (case) carry `units`, `long_name` and `source`;
!> `/summary/status` (case) is 0 or the kind of the error, whose message is in `/run/messages` (case), or -1 for a case that was
!> not computed;
!> `/deck/text` is the deck as given, `/deck/overrides` the values given beside it, `/deck/remarks` the remarks on both and on
!> tables, `/deck/values/<group.key>` what came of all of them, `/deck/table_<group>` (column, row) the tables that it names,
!> `/deck/table_<group>_<number>` those that its cases name beside them, counted by the attribute `tables_<group>` of `/deck`;
!> `/sweep/<group.key>` (case) are the keys that vary;
!> `/effects/<name>` (case) and `/effects/reasons` (case) tell which effects took part, where the deck leaves that to the program;
!> `/run` has attributes, `/run/study_values`, by which one study is told from another, and `/run/warnings` (case) where there are
!> warnings.
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
   use camroller_output_file, only : abandon_output, check_open, finish_file, not_computed, not_written, output_t, &
      & result_format, start_file
   use camroller_output_cases, only : check_position, create_layout => add_layout, gather_row, write_remark, write_rows, &
      & write_series_row, write_status
   use camroller_output_facts, only : write_deck, write_deck_lines, write_deck_table, write_measured, write_run, write_sweep, &
      & write_table_count, write_worst_remarks
   implicit none
   private

   public :: output_t, output_options_t, result_format, not_computed
   public :: open_output, add_layout, write_outcome, close_output, abandon_output
   public :: write_deck, write_deck_table, write_table_count, write_deck_lines, write_sweep, write_measured, write_run, &
      & write_worst_remarks

contains

   !> Start a result file; the folder is tried now, not after the computation.
   subroutine open_output(writer, path, cases, options, error, is_sparse)
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
      !> Do only few cases have series? Without it all of them do
      logical, intent(in), optional :: is_sparse

      call start_file(writer, path, cases, options, error)
      if (present(is_sparse)) writer%is_sparse = is_sparse
   end subroutine open_output

   !> Say what series and scalars the cases to come have; those that are new get their place in the file.
   subroutine add_layout(writer, layout, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Series, scalars, cam angles
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call check_open(writer, error)
      if (.not. allocated(error)) call create_layout(writer, layout, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine add_layout

   !> Write a case of any outcome.
   subroutine write_outcome(writer, position, status, text, reasons, summary, series, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> 0, or the kind of its error
      integer, intent(in) :: status
      !> Message of the error, or remarks; why effects take part or not, where that was decided; may be empty
      character(len=*), intent(in) :: text, reasons
      !> Scalars in the order of the layouts so far [unit of the scalar]
      real(wp), intent(in) :: summary(:)
      !> Series in the order of the layouts so far, shape (angle, series) [unit of the series]; empty where there are none
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
      if (.not. allocated(error) .and. reasons /= "") call write_remark(writer, writer%effects, writer%reasons, "reasons", &
         & position, reasons, error)
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
