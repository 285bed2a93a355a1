!> Cases of a result file: datasets made as cases bring quantities, rows gathered in memory and written in blocks.
!>
!> In: results. Out: `/series`, `/summary`, `/run/warnings`, `/run/messages`. Small datasets are one
!> contiguous block; larger ones are cut into chunks of as many cases as are gathered, so that each chunk is written
!> once.
module camroller_output_cases
   use camroller_kinds, only : wp, not_a_number
   use camroller_error, only : error_t, raise, kind_internal
   use camroller_effect_report, only : choice_source
   use camroller_layout, only : join_quantities, layout_t
   use camroller_result, only : quantity_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_file, only : close_object, create_group, create_integers, create_numbers, create_texts, reserve_file, &
      & write_integers, write_numbers, write_text
   use camroller_hdf5_attribute, only : attach_scale, describe, make_scale, put_attribute
   use camroller_output_file, only : check_open, not_written, number_size, object_size, output_t, text_size
   implicit none
   private

   public :: check_position, add_layout, gather_row, write_series_row, write_rows, write_remark, &
      & write_status, choice_source, group_of_source

   !> Datasets up to this size are one contiguous block, larger ones are cut into chunks [byte]
   real(wp), parameter :: contiguous_size = 65536.0_wp
   !> Series that together are larger than this are compressed under `auto` [byte]
   real(wp), parameter :: compressed_size = 67108864.0_wp
   !> Rows gathered in memory take about this much [byte]
   real(wp), parameter :: buffer_size = 4194304.0_wp
   !> Most cases in a block
   integer, parameter :: largest_block = 2048
   !> Cases from which on a block is worth being compressed
   integer, parameter :: compressed_block = 1024
   !> Cases in a chunk of a scalar
   integer, parameter :: scalar_chunk = 8192
   !> Deflate level: it saves near half of computed series; higher ones cost several times as much for a few per cent more
   integer, parameter :: deflate_level = 1

contains

   !> An error where no case can be written at a position.
   subroutine check_position(writer, position, error)
      !> The writer
      type(output_t), intent(in) :: writer
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> Internal error
      type(error_t), allocatable, intent(out) :: error

      call check_open(writer, error)
      if (allocated(error)) return
      if (position < 1 .or. position > size(writer%status)) then
         call raise(error, kind_internal, "the result file has no place for a case at this position")
      else if (writer%status(position) /= not_written) then
         call raise(error, kind_internal, "a case was written twice")
      end if
   end subroutine check_position

   !> Take a case into memory: its numbers, or not-a-number where it has none. Before the first layout it has its status alone.
   subroutine gather_row(writer, position, status, summary, series, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> 0, or the kind of its error
      integer, intent(in) :: status
      !> Scalars [unit of the scalar]
      real(wp), intent(in) :: summary(:)
      !> Series, shape (angle, series) [unit of the series]; empty where there are none
      real(wp), intent(in) :: series(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      writer%status(position) = status
      if (.not. allocated(writer%summary)) return
      if (position /= writer%first + writer%gathered) then
         call write_rows(writer, error)
         if (allocated(error)) return
         writer%first = position
      end if
      writer%gathered = writer%gathered + 1
      if (size(writer%rows) > 0 .and. size(series) > 0) then
         writer%rows(:, writer%gathered, :) = series
      else if (size(writer%rows) > 0) then
         writer%rows(:, writer%gathered, :) = not_a_number()
      end if
      if (status == 0) then
         writer%scalars(writer%gathered, :) = summary
      else
         writer%scalars(writer%gathered, :) = not_a_number()
      end if
      if (writer%gathered == writer%block .or. modulo(position, writer%block) == 0) call write_rows(writer, error)
   end subroutine gather_row

   !> Write the series of one of few cases that have some.
   subroutine write_series_row(writer, position, series, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> Series, shape (angle, series) [unit of the series]
      real(wp), intent(in) :: series(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      call reserve_file(writer%file, number_size*size(series) + object_size*size(writer%series), error)
      do i = 1, size(writer%series)
         if (allocated(error)) return
         call write_numbers(writer%series_data(i), position - 1, series(:, i:i), error)
      end do
   end subroutine write_series_row

   !> Write the gathered rows.
   subroutine write_rows(writer, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (writer%gathered == 0) return
      call reserve_file(writer%file, number_size*(size(writer%rows) + size(writer%scalars)), error)
      if (allocated(error)) return
      do i = 1, size(writer%series)
         if (size(writer%rows) == 0) exit
         call write_numbers(writer%series_data(i), writer%first - 1, writer%rows(:, 1:writer%gathered, i), error)
         if (allocated(error)) return
      end do
      do i = 1, size(writer%summary)
         call write_numbers(writer%summary_data(i), writer%first - 1, writer%scalars(1:writer%gathered, i), error)
         if (allocated(error)) return
      end do
      writer%first = writer%first + writer%gathered
      writer%gathered = 0
   end subroutine write_rows

   !> Write a text about a case into a dataset that appears with its first text.
   subroutine write_remark(writer, group, remarks, name, position, text, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Group that the dataset is in
      type(hdf5_object_t), intent(in) :: group
      !> The dataset, open or not yet
      type(hdf5_object_t), intent(inout) :: remarks
      !> Its name
      character(len=*), intent(in) :: name
      !> Position of the case, from 1
      integer, intent(in) :: position
      !> The text
      character(len=*), intent(in) :: text
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call reserve_file(writer%file, text_size*(1 + size(writer%status)) + len(text), error)
      if (allocated(error)) return
      if (remarks%id < 0) then
         call create_texts(group, name, shape(writer%status), remarks, error)
         if (.not. allocated(error)) call put_attribute(remarks, "long_name", name//" of each case, or nothing", error)
         if (.not. allocated(error)) call attach_scale(remarks, writer%case_axis, 1, 1, error)
         if (allocated(error)) return
      end if
      call write_text(remarks, [position - 1], text, error)
   end subroutine write_remark

   !> Write the status of all cases.
   subroutine write_status(writer, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset

      call reserve_file(writer%file, object_size + number_size*size(writer%status), error)
      if (.not. allocated(error)) then
         call create_integers(writer%summary_group, "status", shape(writer%status), dataset, error)
      end if
      if (.not. allocated(error)) call describe(dataset, "1", &
         & "0 where the case has a result, -1 where it was not computed, else the kind of its error", "output", error)
      if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 1, 1, error)
      if (.not. allocated(error)) call write_integers(dataset, writer%status, error)
      call close_object(dataset)
   end subroutine write_status

   !> Create the datasets of the quantities that the file does not have yet; cases written before read as not-a-number there.
   subroutine add_layout(writer, layout, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Quantities of cases to come
      type(layout_t), intent(in) :: layout
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: numbers, space ! [-], [byte]
      integer :: before(2), angles
      logical :: is_first

      is_first = .not. allocated(writer%summary)
      before = 0
      if (is_first) then
         allocate (writer%series_data(0), writer%summary_data(0))
      else
         before = [size(writer%series), size(writer%summary)]
         call write_rows(writer, error)
         if (allocated(error)) return
      end if
      call join_quantities(writer%summary, layout%summary)
      call join_quantities(writer%series, layout%series)
      angles = size(layout%angle)
      if (.not. writer%options%series) then
         writer%series = [quantity_t ::]
         angles = 0
      end if
      numbers = real(angles, wp)*size(writer%series) + size(writer%summary)
      if (writer%is_sparse) numbers = size(writer%summary)
      if (is_first) then
         writer%block = int(min(buffer_size/(number_size*max(numbers, 1.0_wp)), real(largest_block, wp)))
         writer%block = min(max(writer%block, 1), size(writer%status))
      end if
      call make_room(writer, angles)
      space = object_size*(size(writer%series) + size(writer%summary) + 1) + number_size*angles
      if (compression_level(writer, angles) > 0) numbers = size(writer%summary)
      space = space + number_size*numbers*(size(writer%status) + writer%block)
      if (size(writer%status) > scalar_chunk) space = space + number_size*size(writer%summary)*scalar_chunk
      call reserve_file(writer%file, space, error)
      if (angles > 0 .and. is_first .and. .not. allocated(error)) call create_angle(writer, layout%angle, error)
      if (angles > 0 .and. .not. allocated(error)) call create_series(writer, angles, before(1) + 1, error)
      if (.not. allocated(error)) call create_summary(writer, before(2) + 1, error)
   end subroutine add_layout

   !> Room for rows of all quantities, and for their datasets.
   subroutine make_room(writer, angles)
      !> The writer, with no row gathered
      type(output_t), intent(inout) :: writer
      !> Number of cam angles
      integer, intent(in) :: angles

      type(hdf5_object_t), allocatable :: longer(:)
      integer :: n

      if (allocated(writer%rows)) deallocate (writer%rows, writer%scalars)
      allocate (writer%rows(angles, merge(0, writer%block, writer%is_sparse), size(writer%series)), &
         & writer%scalars(writer%block, size(writer%summary)))
      n = size(writer%series_data)
      allocate (longer(size(writer%series)))
      longer(:n) = writer%series_data
      call move_alloc(longer, writer%series_data)
      n = size(writer%summary_data)
      allocate (longer(size(writer%summary)))
      longer(:n) = writer%summary_data
      call move_alloc(longer, writer%summary_data)
   end subroutine make_room

   !> Create the axis of cam angles.
   subroutine create_angle(writer, angle, error)
      type(output_t), intent(inout) :: writer
      !> Cam angles [deg]
      real(wp), intent(in) :: angle(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp), allocatable :: copy(:) ! [deg]

      allocate (copy, source=angle)
      associate (axis => writer%angle_axis)
         call create_numbers(writer%series_group, "cam_angle", shape(angle), [integer ::], 0, axis, error)
         if (.not. allocated(error)) call describe(axis, "degree", "cam angle, nose at 180", "numerics", error)
         if (.not. allocated(error)) call make_scale(axis, error)
         if (.not. allocated(error)) call write_numbers(axis, 0, copy, error)
      end associate
   end subroutine create_angle

   !> Create the datasets of series.
   subroutine create_series(writer, angles, first, error)
      type(output_t), intent(inout) :: writer
      !> Number of cam angles
      integer, intent(in) :: angles
      !> The first series that has none
      integer, intent(in) :: first
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: chunk(2), axes_in_chunk, cases, level, i

      cases = size(writer%status)
      chunk = [angles, writer%block]
      if (writer%is_sparse) chunk(2) = 1
      level = compression_level(writer, angles)
      axes_in_chunk = merge(2, 0, level > 0 .or. writer%is_sparse .or. is_large(real(cases, wp), angles, contiguous_size))
      do i = first, size(writer%series)
         associate (series => writer%series(i), dataset => writer%series_data(i))
            call create_numbers(writer%series_group, series%name, [angles, cases], chunk(:axes_in_chunk), level, &
               & dataset, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%angle_axis, 1, 2, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 2, 2, error)
            if (.not. allocated(error)) call describe(dataset, series%unit, series%description, &
               & series%source, error, series%scope)
         end associate
         if (allocated(error)) return
      end do
   end subroutine create_series

   !> Create the datasets of scalars.
   subroutine create_summary(writer, first, error)
      type(output_t), intent(inout) :: writer
      !> The first scalar that has none
      integer, intent(in) :: first
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group
      integer :: chunk(1), axes_in_chunk, level, i

      chunk = scalar_chunk
      axes_in_chunk = merge(1, 0, size(writer%status) > scalar_chunk)
      level = 0
      if (are_scalars_compressed(writer)) then
         chunk = writer%block
         level = deflate_level
      end if
      do i = first, size(writer%summary)
         associate (scalar => writer%summary(i), dataset => writer%summary_data(i))
            call choose_group(writer, scalar%source, group, error)
            if (.not. allocated(error)) call create_numbers(group, scalar%name, shape(writer%status), &
               & chunk(:axes_in_chunk), level, dataset, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 1, 1, error)
            if (.not. allocated(error)) call describe(dataset, scalar%unit, scalar%description, &
               & scalar%source, error, scalar%scope)
         end associate
         if (allocated(error)) return
      end do
   end subroutine create_summary

   !> Are scalars compressed? Only where each chunk is written once.
   pure function are_scalars_compressed(writer) result(answer)
      type(output_t), intent(in) :: writer
      !> Are they?
      logical :: answer

      answer = writer%options%compression /= "off" .and. size(writer%status) > scalar_chunk .and. &
         & writer%block >= compressed_block
   end function are_scalars_compressed

   !> Group for scalars of a source: what tells about the choice of effects has one of its own.
   subroutine choose_group(writer, source, group, error)
      type(output_t), intent(inout) :: writer
      !> Part of the model that a scalar comes from
      character(len=*), intent(in) :: source
      type(hdf5_object_t), intent(out) :: group
      !> File error
      type(error_t), allocatable, intent(out) :: error

      group = writer%summary_group
      if (group_of_source(source) /= choice_source) return
      if (writer%effects%id < 0) call create_group(writer%file, choice_source, writer%effects, error)
      group = writer%effects
   end subroutine choose_group

   !> Name of the group of a result file that holds scalars of a source.
   pure function group_of_source(source) result(group)
      !> Part of the model that a scalar comes from
      character(len=*), intent(in) :: source
      !> The name
      character(len=:), allocatable :: group

      group = "summary"
      if (source == choice_source) group = choice_source
   end function group_of_source

   !> Deflate level of the series.
   pure function compression_level(writer, angles) result(level)
      type(output_t), intent(in) :: writer
      !> Number of cam angles
      integer, intent(in) :: angles
      !> The level, 0 for none
      integer :: level

      logical :: wanted

      select case (writer%options%compression)
      case ("on")
         wanted = .true.
      case ("off")
         wanted = .false.
      case default
         wanted = is_large(real(size(writer%status), wp)*size(writer%series), angles, compressed_size)
      end select
      level = merge(deflate_level, 0, wanted)
   end function compression_level

   !> Whether rows of numbers take more than some bytes; products of large integers are kept out of integers.
   pure function is_large(rows, length, limit) result(answer)
      !> Number of rows [-]
      real(wp), intent(in) :: rows
      !> Numbers in a row
      integer, intent(in) :: length
      !> The limit [byte]
      real(wp), intent(in) :: limit
      !> True above the limit
      logical :: answer

      answer = rows*real(length, wp)*number_size > limit
   end function is_large

end module camroller_output_cases
