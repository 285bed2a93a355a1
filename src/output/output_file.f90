!> The result file as a whole: created under a temporary name, given its own name when it is complete.
!>
!> In: path, number of cases, options. Out: `output_t` with the frame of the file (format, groups, axis of
!> cases) written; the finished file under its name, or no trace of it. Its format is described in `camroller_output`.
module camroller_output_file
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_internal, kind_usage
   use camroller_names, only : find_name
   use camroller_output_options, only : compression_names, output_options_t
   use camroller_result, only : quantity_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : close_file, create_file, create_group, create_integers, discard_file, &
      & flush_file, hand_over_file, reserve_file, write_integers
   use camroller_hdf5_attribute, only : make_scale, put_attribute
   use camroller_new_file, only : begin_new_file, drop_new_file, end_new_file, new_file_t, take_permissions
   use camroller_output_kind, only : result_kind
   use camroller_raw_file, only : append_text, close_raw, create_raw, raw_file_t, settle_raw
   use camroller_seal, only : seal_file
   use camroller_system_file, only : remove_file
   implicit none
   private

   public :: output_t, result_format, format_version, not_computed, not_written
   public :: number_size, text_size, object_size, start_file, finish_file, abandon_output, check_open

   !> Attribute by which a result file is known
   character(len=*), parameter :: result_format = trim(result_kind%mark)
   !> Space that a group or a dataset takes besides its values, generously [byte]
   real(wp), parameter :: object_size = 4096.0_wp
   !> Space that a number takes [byte]
   real(wp), parameter :: number_size = 8.0_wp
   !> Space that a text takes besides its letters, generously [byte]
   real(wp), parameter :: text_size = 64.0_wp
   !> What a new file must be able to take [byte]
   integer, parameter :: tried_bytes = 524288
   !> Goes up when readers have to change
   integer, parameter :: format_version = 1
   !> Order of the axes, for readers in any language
   character(len=*), parameter :: axes_remark = "(case, cam_angle) as C and Python count them, the last axis "// &
      & "contiguous in memory; Fortran sees (cam_angle, case)"
   !> Status of a case that has not come yet, and of one that was not computed, which a partial file has
   integer, parameter :: not_written = -2, not_computed = -1

   !> A result file being written
   type :: output_t
      type(output_options_t) :: options
      !> Path of the finished file
      character(len=:), allocatable :: path
      !> Its place, and its path until then
      type(new_file_t) :: place
      type(hdf5_object_t) :: file, case_axis, angle_axis, deck, run, series_group, summary_group, sweep, warnings, messages, &
         & effects, reasons
      !> Status of each case: 0, the kind of its error, or `not_written`
      integer, allocatable :: status(:)
      !> Series and scalars of the file, as many as the layouts so far bring
      type(quantity_t), allocatable :: series(:), summary(:)
      type(hdf5_object_t), allocatable :: series_data(:), summary_data(:)
      !> Gathered rows, shape (angle, row, series) [unit of the series]
      real(wp), allocatable :: rows(:, :, :)
      !> Gathered scalars, shape (row, scalar) [unit of the scalar]
      real(wp), allocatable :: scalars(:, :)
      !> Most rows gathered
      integer :: block = 0
      !> Position of the first gathered case, from 1
      integer :: first = 1
      !> Rows gathered
      integer :: gathered = 0
      !> Do only few cases have series?
      logical :: is_sparse = .false.
   end type output_t

contains

   !> Create the unfinished file with its frame; the folder is tried now, not after the computation.
   subroutine start_file(writer, path, cases, options, error)
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

      integer :: choice

      writer%path = trim(path)
      writer%options = options
      call find_name("compression", options%compression, compression_names, choice, error)
      if (allocated(error)) return
      if (cases < 1) then
         call raise(error, kind_usage, "a result file needs one case at least")
         return
      end if
      allocate (writer%status(cases), source=not_written)
      call create_temporary(writer, error)
      if (allocated(error)) return
      call write_frame(writer, error)
      if (allocated(error)) call abandon_output(writer)
   end subroutine start_file

   !> Mark the file complete, or partial where cases were not computed, close it, seal it and give it its name.
   subroutine finish_file(writer, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer(int64) :: bytes
      integer :: missing

      missing = count(writer%status == not_computed)
      call flush_file(writer%file, error)
      if (.not. allocated(error)) call reserve_file(writer%file, 0.0_wp, error)
      if (missing > 0 .and. .not. allocated(error)) call put_attribute(writer%file, "missing_cases", missing, error)
      if (.not. allocated(error)) call put_attribute(writer%file, "complete", merge(0, 1, missing > 0), error)
      if (.not. allocated(error)) call flush_file(writer%file, error)
      if (.not. allocated(error)) call close_file(writer%file, error)
      if (.not. allocated(error)) call seal_file(writer%place%temporary, writer%path, bytes, error)
      if (.not. allocated(error)) call end_new_file(writer%place, bytes, error)
   end subroutine finish_file

   !> An error where the writer has no open file.
   subroutine check_open(writer, error)
      !> The writer
      type(output_t), intent(in) :: writer
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(writer%place%temporary)) call raise(error, kind_internal, "no result file is open")
   end subroutine check_open

   !> Give up: the unfinished file is removed. Does no harm where nothing is open.
   subroutine abandon_output(writer)
      !> The writer
      type(output_t), intent(inout) :: writer

      call discard_file(writer%file)
      call drop_new_file(writer%place)
   end subroutine abandon_output

   !> Create the unfinished file beside the finished one's place.
   subroutine create_temporary(writer, error)
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call begin_new_file(writer%place, writer%path, result_kind, error)
      if (.not. allocated(error)) call try_path(writer, error)
      if (.not. allocated(error)) call create_file(writer%file, writer%place%temporary, writer%path, error)
      if (allocated(error)) then
         call abandon_output(writer)
      else
         call take_permissions(writer%place)
      end if
   end subroutine create_temporary

   !> Write and remove a small file: the library does not survive a device that is full from the start.
   subroutine try_path(writer, error)
      type(output_t), intent(in) :: writer
      !> File error in the system's words
      type(error_t), allocatable, intent(out) :: error

      type(raw_file_t) :: file

      call create_raw(file, writer%place%temporary, writer%path, error)
      if (allocated(error)) return
      call append_text(file, repeat(" ", tried_bytes), error)
      if (allocated(error)) then
         call close_raw(file)
      else
         call settle_raw(file, error)
      end if
      call remove_file(writer%place%temporary)
   end subroutine try_path

   !> Write what every result file has: format, groups, the axis of cases.
   subroutine write_frame(writer, error)
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      call reserve_file(writer%file, 4.0_wp*size(writer%status) + 7*object_size, error)
      if (.not. allocated(error)) call put_attribute(writer%file, "format", result_format, error)
      if (.not. allocated(error)) call put_attribute(writer%file, "format_version", format_version, error)
      if (.not. allocated(error)) call put_attribute(writer%file, "axes", axes_remark, error)
      if (.not. allocated(error)) then
         call create_integers(writer%file, "case", shape(writer%status), writer%case_axis, error)
      end if
      if (.not. allocated(error)) call put_attribute(writer%case_axis, "units", "1", error)
      if (.not. allocated(error)) call put_attribute(writer%case_axis, "long_name", "case of the sweep", error)
      if (.not. allocated(error)) call make_scale(writer%case_axis, error)
      if (.not. allocated(error)) call write_integers(writer%case_axis, [(i, i=0, size(writer%status) - 1)], error)
      if (.not. allocated(error)) call create_group(writer%file, "series", writer%series_group, error)
      if (.not. allocated(error)) call create_group(writer%file, "summary", writer%summary_group, error)
      if (.not. allocated(error)) call create_group(writer%file, "sweep", writer%sweep, error)
      if (.not. allocated(error)) call create_group(writer%file, "deck", writer%deck, error)
      if (.not. allocated(error)) call create_group(writer%file, "run", writer%run, error)
      if (.not. allocated(error)) call hand_over_file(writer%file, error)
   end subroutine write_frame

end module camroller_output_file
