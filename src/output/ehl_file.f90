!> Solved contacts over the cycle in a result file.
!>
!> In: an open result file, one record after the other. Out: `/ehl` with pressure, film and, of profiles with heat, rise of the
!> film's temperature over case, angle and node, and what belongs to them over case and angle; `/ehl/second_lift` with the same for
!> the second lobe shape. Angles are equally spaced; between the steps of a cycle values are taken as linear. Where a case has no
!> record, numbers are NaN, and so they are at angles whose contact is not solved; where only few are expected to have one, the
!> others take no space.
module camroller_ehl_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_hdf5_attribute, only : attach_scale, describe, make_scale
   use camroller_hdf5_file, only : create_group, create_integers, create_numbers, reserve_file, write_integers, &
      & write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_output_file, only : check_open, abandon_output, number_size, object_size, output_t
   use camroller_ehl_record, only : ehl_record_t, list_ehl_quantities
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: ehl_file_t, open_ehl, write_ehl, close_ehl, sample_record

   !> Datasets of one lobe shape
   type :: lobe_t
      type(hdf5_object_t) :: group, angles, nodes, places, pressure, film, film_rise
      type(hdf5_object_t), allocatable :: series(:)
   end type lobe_t

   !> Datasets of solved contacts in an open file
   type :: ehl_file_t
      !> Cam angles of a cycle, nodes of a contact
      integer :: angle_count = 0, node_count = 0
      !> Do profiles have heat?
      logical :: has_heat = .false.
      type(quantity_t), allocatable :: quantities(:)
      type(lobe_t), allocatable :: lobes(:)
   end type ehl_file_t

contains

   !> Create the datasets.
   subroutine open_ehl(file, writer, lobe_count, angle_count, node_count, quantity_count, has_heat, error)
      !> The datasets
      type(ehl_file_t), intent(out) :: file
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Lobe shapes, cam angles of a cycle, nodes of a contact
      integer, intent(in) :: lobe_count, angle_count, node_count
      !> Quantities over the cam angle
      integer, intent(in) :: quantity_count
      !> Do profiles have heat?
      logical, intent(in) :: has_heat
      !> File error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: space ! [byte]
      integer :: lobe

      file%angle_count = angle_count
      file%node_count = node_count
      file%has_heat = has_heat
      call list_ehl_quantities(quantity_count, file%quantities)
      allocate (file%lobes(lobe_count))
      call check_open(writer, error)
      if (allocated(error)) return
      space = size_of_case(file)*size(writer%status)
      if (writer%is_sparse) space = 0.0_wp
      call reserve_file(writer%file, lobe_count*(object_size*(merge(8, 7, has_heat) + size(file%quantities)) + space), error)
      do lobe = 1, lobe_count
         if (allocated(error)) exit
         if (lobe == 1) then
            call create_group(writer%file, "ehl", file%lobes(lobe)%group, error)
         else
            call create_group(file%lobes(1)%group, "second_lift", file%lobes(lobe)%group, error)
         end if
         if (.not. allocated(error)) call create_lobe(file, file%lobes(lobe), writer, error)
      end do
      if (allocated(error)) call abandon_output(writer)
   end subroutine open_ehl

   !> Space of one case and lobe shape.
   pure function size_of_case(file) result(space)
      !> The datasets: sizes and quantities
      type(ehl_file_t), intent(in) :: file
      !> The space [byte]
      real(wp) :: space

      space = number_size*(merge(3, 2, file%has_heat)*file%node_count + size(file%quantities))*(file%angle_count + 1.0_wp)
   end function size_of_case

   !> Create the datasets of a lobe shape.
   subroutine create_lobe(file, lobe, writer, error)
      !> The datasets: sizes and quantities
      type(ehl_file_t), intent(in) :: file
      !> Those of the lobe shape; its group is open
      type(lobe_t), intent(inout) :: lobe
      type(output_t), intent(in) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Extents of rows over angles and over nodes
      integer :: over_angles(2), over_nodes(2)
      integer :: i, cases

      cases = size(writer%status)
      over_angles = [file%angle_count, cases]
      over_nodes = [file%node_count, cases]
      call create_numbers(lobe%group, "angle", [file%angle_count], [integer ::], 0, lobe%angles, error)
      if (.not. allocated(error)) call describe(lobe%angles, "degree", "cam angle, full lift at 180", "ehl", error)
      if (.not. allocated(error)) call make_scale(lobe%angles, error)
      if (.not. allocated(error)) call write_numbers(lobe%angles, 0, [(i*360.0_wp/file%angle_count, i=0, file%angle_count - 1)], &
         & error)
      if (.not. allocated(error)) call create_integers(lobe%group, "node", [file%node_count], lobe%nodes, error)
      if (.not. allocated(error)) call describe(lobe%nodes, "1", "node across the contact", "ehl", error)
      if (.not. allocated(error)) call make_scale(lobe%nodes, error)
      if (.not. allocated(error)) call write_integers(lobe%nodes, [(i, i=0, file%node_count - 1)], error)
      allocate (lobe%series(size(file%quantities)))
      do i = 1, size(file%quantities)
         if (allocated(error)) return
         associate (quantity => file%quantities(i), dataset => lobe%series(i))
            call create_numbers(lobe%group, quantity%name, over_angles, chunk_of(writer, over_angles), 0, dataset, error)
            if (.not. allocated(error)) call describe(dataset, quantity%unit, quantity%description, "ehl", error)
            if (.not. allocated(error)) call attach_scale(dataset, lobe%angles, 1, 2, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 2, 2, error)
         end associate
      end do
      if (.not. allocated(error)) call create_numbers(lobe%group, "x", over_nodes, chunk_of(writer, over_nodes), 0, &
         & lobe%places, error)
      if (.not. allocated(error)) call describe(lobe%places, "1", "nodes relative to half_width, inlet first", "ehl", error)
      if (.not. allocated(error)) call attach_scale(lobe%places, lobe%nodes, 1, 2, error)
      if (.not. allocated(error)) call attach_scale(lobe%places, writer%case_axis, 2, 2, error)
      if (.not. allocated(error)) call create_profile(lobe, writer, "pressure", "Pa", "pressure of film and asperities", &
         & [file%node_count, file%angle_count, cases], lobe%pressure, error)
      if (.not. allocated(error)) call create_profile(lobe, writer, "film", "m", "film", &
         & [file%node_count, file%angle_count, cases], lobe%film, error)
      if (file%has_heat .and. .not. allocated(error)) call create_profile(lobe, writer, "film_rise", "K", &
         & "mean temperature of the film above that of the oil", [file%node_count, file%angle_count, cases], lobe%film_rise, error)
   end subroutine create_lobe

   !> Extents of a chunk: one case where few have a record, else none, which is one contiguous block.
   pure function chunk_of(writer, extents) result(chunk)
      type(output_t), intent(in) :: writer
      !> Extents of the dataset, cases last
      integer, intent(in) :: extents(:)
      !> Extents of the chunk
      integer, allocatable :: chunk(:)

      allocate (chunk(0))
      if (writer%is_sparse) chunk = [extents(:size(extents) - 1), 1]
   end function chunk_of

   !> Create a dataset over case, angle and node.
   subroutine create_profile(lobe, writer, name, unit, meaning, extents, dataset, error)
      !> Datasets of the lobe shape: the dimensions
      type(lobe_t), intent(in) :: lobe
      type(output_t), intent(in) :: writer
      !> Name, unit, meaning
      character(len=*), intent(in) :: name, unit, meaning
      !> Nodes, angles, cases
      integer, intent(in) :: extents(3)
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call create_numbers(lobe%group, name, extents, chunk_of(writer, extents), 0, dataset, error)
      if (.not. allocated(error)) call describe(dataset, unit, meaning//" over case, angle, node", "ehl", error)
      if (.not. allocated(error)) call attach_scale(dataset, lobe%nodes, 1, 3, error)
      if (.not. allocated(error)) call attach_scale(dataset, lobe%angles, 2, 3, error)
      if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 3, 3, error)
   end subroutine create_profile

   !> Write the record of a case and a lobe shape.
   subroutine write_ehl(file, writer, position, lobe_number, record, error)
      !> The datasets
      type(ehl_file_t), intent(in) :: file
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Number of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> Number of the lobe shape
      integer, intent(in) :: lobe_number
      !> The record, with profiles
      type(ehl_record_t), intent(in) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_record_t) :: sampled
      ! One row [unit of the dataset]
      real(wp), allocatable :: row(:, :)
      integer :: i

      if (writer%is_sparse) call reserve_file(writer%file, size_of_case(file) + object_size*(merge(4, 3, file%has_heat) &
         & + size(file%quantities)), error)
      if (allocated(error)) return
      call sample_record(record, file%angle_count, sampled)
      associate (lobe => file%lobes(lobe_number))
         do i = 1, size(lobe%series)
            row = sampled%values(:, i:i)
            call write_numbers(lobe%series(i), position - 1, row, error)
            if (allocated(error)) return
         end do
         row = reshape(sampled%nodes, [size(sampled%nodes), 1])
         call write_numbers(lobe%places, position - 1, row, error)
         if (allocated(error)) return
         call write_numbers(lobe%pressure, position - 1, sampled%pressure, 3, error)
         if (allocated(error)) return
         call write_numbers(lobe%film, position - 1, sampled%film, 3, error)
         if (allocated(error) .or. .not. file%has_heat) return
         call write_numbers(lobe%film_rise, position - 1, sampled%film_rise, 3, error)
      end associate
   end subroutine write_ehl

   !> A record at the angles of a file.
   pure subroutine sample_record(record, angle_count, sampled)
      !> The record, with profiles
      type(ehl_record_t), intent(in) :: record
      !> Number of angles of the file
      integer, intent(in) :: angle_count
      !> The same at the angles of the file
      type(ehl_record_t), intent(out) :: sampled

      integer :: i

      sampled%angle = [(record%angle(1) + (i - 1)*two_pi/angle_count, i=1, angle_count)]
      sampled%nodes = record%nodes
      sampled%values = transpose(resample(sampled%angle, record%angle, transpose(record%values)))
      sampled%pressure = resample(sampled%angle, record%angle, record%pressure)
      sampled%film = resample(sampled%angle, record%angle, record%film)
      if (allocated(record%film_rise)) sampled%film_rise = resample(sampled%angle, record%angle, record%film_rise)
   end subroutine sample_record

   !> Close the datasets.
   subroutine close_ehl(file)
      !> The solved contacts
      type(ehl_file_t), intent(inout) :: file

      if (allocated(file%lobes)) deallocate (file%lobes)
   end subroutine close_ehl

   !> Values at other angles; next to an angle without a number those of the nearer one.
   pure function resample(wanted, angles, values) result(rows)
      !> The other angles, from the first one on, increasing [rad]
      real(wp), intent(in) :: wanted(:)
      !> Angles of the values from full lift, increasing [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [unit of the quantity]
      real(wp), intent(in) :: values(:, :)
      !> Values at the wanted angles [unit of the quantity]
      real(wp) :: rows(size(values, 1), size(wanted))

      ! Part of the way to the next angle that is there [-]
      real(wp) :: part
      integer :: i, k

      k = 1
      do i = 1, size(wanted)
         do while (k < size(angles) - 1 .and. angles(min(k + 1, size(angles))) < wanted(i))
            k = k + 1
         end do
         part = (wanted(i) - angles(k))/(angles(k + 1) - angles(k))
         rows(:, i) = values(:, k) + part*(values(:, k + 1) - values(:, k))
         if (any(ieee_is_nan(rows(:, i)))) rows(:, i) = values(:, k + nint(part))
      end do
   end function resample

end module camroller_ehl_file
