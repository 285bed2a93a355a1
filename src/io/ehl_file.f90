!> Solved contacts over the cycle in a result file.
!>
!> Layer: io. In: an open result file, one record after the other. Out: `/ehl` with pressure and film over case, angle and node, and
!> what belongs to them over case and angle; `/ehl/second_lift` with the same for the second lobe shape. Angles are equally spaced;
!> between the steps of a cycle values are taken as linear. Where a case has no record, numbers are NaN.
module camroller_ehl_file
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_hdf5_attribute, only : attach_scale, make_scale, put_attribute
   use camroller_hdf5_file, only : close_object, create_group, create_integers, create_numbers, reserve_file, write_integers, &
      & write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_output_file, only : check_open, abandon_output, number_size, object_size, output_t
   use camroller_ehl_record, only : ehl_record_t, list_ehl_quantities
   use camroller_result, only : quantity_t
   implicit none
   private

   public :: ehl_file_t, open_ehl, write_ehl, close_ehl

   !> Datasets of one lobe shape
   type :: lobe_t
      type(hdf5_object_t) :: group, angles, nodes, places, pressure, film
      type(hdf5_object_t), allocatable :: series(:)
   end type lobe_t

   !> Datasets of solved contacts in an open file
   type :: ehl_file_t
      !> Cam angles of a cycle, nodes of a contact
      integer :: angle_count = 0, node_count = 0
      type(quantity_t), allocatable :: quantities(:)
      type(lobe_t), allocatable :: lobes(:)
   end type ehl_file_t

contains

   !> Create the datasets.
   subroutine open_ehl(file, writer, lobe_count, angle_count, node_count, error)
      !> The datasets
      type(ehl_file_t), intent(out) :: file
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Lobe shapes, cam angles of a cycle, nodes of a contact
      integer, intent(in) :: lobe_count, angle_count, node_count
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: lobe

      file%angle_count = angle_count
      file%node_count = node_count
      call list_ehl_quantities(file%quantities)
      allocate (file%lobes(lobe_count))
      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, lobe_count*(object_size*(7 + size(file%quantities)) + number_size*size(writer%status) &
         & *((2*node_count + size(file%quantities))*(angle_count + 1.0_wp))), error)
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

   !> Create the datasets of a lobe shape.
   subroutine create_lobe(file, lobe, writer, error)
      !> The datasets: sizes and quantities
      type(ehl_file_t), intent(in) :: file
      !> Those of the lobe shape; its group is open
      type(lobe_t), intent(inout) :: lobe
      !> The writer
      type(output_t), intent(in) :: writer
      !> File error
      type(error_t), allocatable, intent(out) :: error

      integer :: i, cases

      cases = size(writer%status)
      call create_numbers(lobe%group, "angle", [file%angle_count], [integer ::], 0, lobe%angles, error)
      if (.not. allocated(error)) call describe(lobe%angles, "degree", "cam angle, full lift at 180", error)
      if (.not. allocated(error)) call make_scale(lobe%angles, error)
      if (.not. allocated(error)) call write_numbers(lobe%angles, 0, [(i*360.0_wp/file%angle_count, i=0, file%angle_count - 1)], &
         & error)
      if (.not. allocated(error)) call create_integers(lobe%group, "node", [file%node_count], lobe%nodes, error)
      if (.not. allocated(error)) call describe(lobe%nodes, "1", "node across the contact", error)
      if (.not. allocated(error)) call make_scale(lobe%nodes, error)
      if (.not. allocated(error)) call write_integers(lobe%nodes, 0, [(i, i=0, file%node_count - 1)], error)
      allocate (lobe%series(size(file%quantities)))
      do i = 1, size(file%quantities)
         if (allocated(error)) return
         associate (quantity => file%quantities(i), dataset => lobe%series(i))
            call create_numbers(lobe%group, quantity%name, [file%angle_count, cases], [integer ::], 0, dataset, error)
            if (.not. allocated(error)) call describe(dataset, quantity%unit, quantity%description, error)
            if (.not. allocated(error)) call attach_scale(dataset, lobe%angles, 1, 2, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 2, 2, error)
         end associate
      end do
      if (.not. allocated(error)) call create_numbers(lobe%group, "x", [file%node_count, cases], [integer ::], 0, lobe%places, &
         & error)
      if (.not. allocated(error)) call describe(lobe%places, "1", "place of the nodes over half_width, inlet first", error)
      if (.not. allocated(error)) call attach_scale(lobe%places, lobe%nodes, 1, 2, error)
      if (.not. allocated(error)) call attach_scale(lobe%places, writer%case_axis, 2, 2, error)
      if (.not. allocated(error)) call create_profile(lobe, writer, "pressure", "Pa", "pressure of film and asperities", &
         & [file%node_count, file%angle_count, cases], lobe%pressure, error)
      if (.not. allocated(error)) call create_profile(lobe, writer, "film", "m", "film", &
         & [file%node_count, file%angle_count, cases], lobe%film, error)
   end subroutine create_lobe

   !> Create a dataset over case, angle and node.
   subroutine create_profile(lobe, writer, name, unit, meaning, extents, dataset, error)
      !> Datasets of the lobe shape: the dimensions
      type(lobe_t), intent(in) :: lobe
      !> The writer
      type(output_t), intent(in) :: writer
      !> Name, unit, meaning
      character(len=*), intent(in) :: name, unit, meaning
      !> Nodes, angles, cases
      integer, intent(in) :: extents(3)
      !> The dataset
      type(hdf5_object_t), intent(out) :: dataset
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call create_numbers(lobe%group, name, extents, [integer ::], 0, dataset, error)
      if (.not. allocated(error)) call describe(dataset, unit, meaning//" over case, angle, node", error)
      if (.not. allocated(error)) call attach_scale(dataset, lobe%nodes, 1, 3, error)
      if (.not. allocated(error)) call attach_scale(dataset, lobe%angles, 2, 3, error)
      if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 3, 3, error)
   end subroutine create_profile

   !> What a dataset is.
   subroutine describe(dataset, unit, meaning, error)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> Unit and meaning
      character(len=*), intent(in) :: unit, meaning
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call put_attribute(dataset, "units", unit, error)
      if (.not. allocated(error)) call put_attribute(dataset, "long_name", meaning, error)
      if (.not. allocated(error)) call put_attribute(dataset, "source", "ehl", error)
   end subroutine describe

   !> Write the record of a case and a lobe shape.
   subroutine write_ehl(file, position, lobe_number, record, error)
      !> The datasets
      type(ehl_file_t), intent(in) :: file
      !> Number of the case, from 1; the file counts from 0
      integer, intent(in) :: position
      !> Number of the lobe shape
      integer, intent(in) :: lobe_number
      !> The record, with profiles
      type(ehl_record_t), intent(in) :: record
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Values, profiles, places at the angles of the file, one row each [unit of the dataset]
      real(wp), allocatable :: rows(:, :), plane(:, :), row(:, :)
      integer :: i

      associate (lobe => file%lobes(lobe_number))
         rows = transpose(resample(file%angle_count, record%angle, transpose(record%values)))
         do i = 1, size(lobe%series)
            row = rows(:, i:i)
            call write_numbers(lobe%series(i), position - 1, row, error)
            if (allocated(error)) return
         end do
         row = reshape(record%nodes, [size(record%nodes), 1])
         call write_numbers(lobe%places, position - 1, row, error)
         if (allocated(error)) return
         plane = resample(file%angle_count, record%angle, record%pressure)
         call write_numbers(lobe%pressure, position - 1, plane, 3, error)
         if (allocated(error)) return
         plane = resample(file%angle_count, record%angle, record%film)
         call write_numbers(lobe%film, position - 1, plane, 3, error)
      end associate
   end subroutine write_ehl

   !> Close the datasets.
   subroutine close_ehl(file)
      !> The datasets
      type(ehl_file_t), intent(inout) :: file

      integer :: lobe, i

      if (.not. allocated(file%lobes)) return
      do lobe = size(file%lobes), 1, -1
         associate (this => file%lobes(lobe))
            if (allocated(this%series)) then
               do i = 1, size(this%series)
                  call close_object(this%series(i))
               end do
            end if
            call close_object(this%film)
            call close_object(this%pressure)
            call close_object(this%places)
            call close_object(this%nodes)
            call close_object(this%angles)
            call close_object(this%group)
         end associate
      end do
      deallocate (file%lobes)
   end subroutine close_ehl

   !> Values at the angles of the file.
   pure function resample(angle_count, angles, values) result(rows)
      !> Number of angles of the file
      integer, intent(in) :: angle_count
      !> Angles of the values from full lift, increasing [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [unit of the quantity]
      real(wp), intent(in) :: values(:, :)
      !> Values at the angles of the file [unit of the quantity]
      real(wp) :: rows(size(values, 1), angle_count)

      ! Angle [rad], part of the way to the next one that is there [-]
      real(wp) :: angle, part
      integer :: i, k

      k = 1
      do i = 1, angle_count
         angle = angles(1) + (i - 1)*two_pi/angle_count
         do while (k < size(angles) - 1 .and. angles(min(k + 1, size(angles))) < angle)
            k = k + 1
         end do
         part = (angle - angles(k))/(angles(k + 1) - angles(k))
         rows(:, i) = values(:, k) + part*(values(:, k + 1) - values(:, k))
      end do
   end function resample

end module camroller_ehl_file
