!> Contacts solved over the cycle in a result file.
!>
!> Layer: io. In: an open result file, cycles. Out: `/ehl` with pressure and film over case, angle and node, and what belongs to
!> them over case and angle. Angles are equally spaced as in other result files; between the steps of a cycle values are taken as
!> linear.
module camroller_ehl_file
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_hdf5_attribute, only : attach_scale, make_scale, put_attribute
   use camroller_hdf5_file, only : close_object, create_group, create_numbers, reserve_file, write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_output_file, only : check_open, abandon_output, number_size, object_size, output_t
   use camroller_ehl_cycle, only : ehl_cycle_t
   implicit none
   private

   public :: write_ehl

   !> Values over case and angle: name, unit, meaning
   character(len=*), parameter :: names(*) = [character(len=24) :: "half_width", "load", "sliding_speed", "film_min", &
      & "film_central", "asperity_share", "traction", "rolling_resistance", "peak_pressure"]
   character(len=*), parameter :: units(*) = [character(len=6) :: "m", "N", "m s-1", "m", "m", "1", "N", "N", "Pa"]
   character(len=*), parameter :: meanings(*) = [character(len=72) :: "length that the nodes are given in", "contact load", &
      & "sliding speed of the roller", "smallest film", "film in the middle of the dry contact", &
      & "part of the load that asperities carry", "traction", "rolling resistance of each surface", "largest pressure"]
   !> Angles of a cycle
   integer, parameter :: angle_count = 720

contains

   !> Write the cycles of all cases; where a case has none, numbers are NaN.
   subroutine write_ehl(writer, cycles, error)
      !> The writer
      type(output_t), intent(inout) :: writer
      !> Cycles with their profiles
      type(ehl_cycle_t), intent(in) :: cycles(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: group, angles
      integer :: i, nodes

      nodes = 0
      do i = 1, size(cycles)
         if (allocated(cycles(i)%nodes)) nodes = max(nodes, size(cycles(i)%nodes))
      end do
      call check_open(writer, error)
      if (allocated(error)) return
      call reserve_file(writer%file, object_size*(6 + size(names)) + number_size*size(cycles)*angle_count &
         & *(2*nodes + size(names) + 1.0_wp), error)
      if (.not. allocated(error)) call create_group(writer%file, "ehl", group, error)
      if (.not. allocated(error)) call create_numbers(group, "angle", [angle_count], [integer ::], 0, angles, error)
      if (.not. allocated(error)) call describe(angles, "deg", "cam angle, full lift at 180", error)
      if (.not. allocated(error)) call make_scale(angles, error)
      if (.not. allocated(error)) call write_numbers(angles, 0, [(i*360.0_wp/angle_count, i=0, angle_count - 1)], error)
      if (.not. allocated(error)) call write_series(group, cycles, angles, error)
      if (.not. allocated(error)) call write_places(group, cycles, nodes, error)
      if (.not. allocated(error)) call write_profiles(group, "pressure", "Pa", "pressure of film and asperities", cycles, &
         & nodes, error)
      if (.not. allocated(error)) call write_profiles(group, "film", "m", "film", cycles, nodes, error)
      call close_object(angles)
      call close_object(group)
      if (allocated(error)) call abandon_output(writer)
   end subroutine write_ehl

   !> What a dataset is.
   subroutine describe(dataset, unit, meaning, error)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> Unit and meaning
      character(len=*), intent(in) :: unit, meaning
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call put_attribute(dataset, "units", trim(unit), error)
      if (.not. allocated(error)) call put_attribute(dataset, "long_name", trim(meaning), error)
      if (.not. allocated(error)) call put_attribute(dataset, "source", "ehl", error)
   end subroutine describe

   !> Values over case and angle.
   subroutine write_series(group, cycles, angles, error)
      !> Group of the file
      type(hdf5_object_t), intent(in) :: group
      !> The cycles
      type(ehl_cycle_t), intent(in) :: cycles(:)
      !> The angles
      type(hdf5_object_t), intent(in) :: angles
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      ! Values at the accepted angles, then at those of the file [unit of the quantity]
      real(wp), allocatable :: values(:, :), rows(:, :)
      integer :: i, k

      do k = 1, size(names)
         allocate (rows(angle_count, size(cycles)))
         rows = not_a_number()
         do i = 1, size(cycles)
            if (.not. allocated(cycles(i)%angle)) cycle
            allocate (values(1, size(cycles(i)%angle)))
            values(1, :) = quantity(cycles(i), k)
            rows(:, i) = reshape(resample(cycles(i)%angle, values), [angle_count])
            deallocate (values)
         end do
         call create_numbers(group, trim(names(k)), shape(rows), [integer ::], 0, dataset, error)
         if (.not. allocated(error)) call describe(dataset, units(k), meanings(k), error)
         if (.not. allocated(error)) call attach_scale(dataset, angles, 1, 2, error)
         if (.not. allocated(error)) call write_numbers(dataset, 0, rows, error)
         call close_object(dataset)
         deallocate (rows)
         if (allocated(error)) return
      end do
   end subroutine write_series

   !> One quantity at the accepted angles of a cycle.
   pure function quantity(cycle, number) result(values)
      !> The cycle
      type(ehl_cycle_t), intent(in) :: cycle
      !> Position in `names`
      integer, intent(in) :: number
      !> Its values [unit of the quantity]
      real(wp) :: values(size(cycle%angle))

      select case (number)
      case (1)
         values = cycle%moments%length_scale
      case (2)
         values = cycle%moments%load
      case (3)
         values = cycle%moments%sliding_speed
      case (4)
         values = cycle%moments%films%minimum
      case (5)
         values = cycle%moments%films%central
      case (6)
         values = cycle%moments%films%asperity_share
      case (7)
         values = cycle%moments%traction
      case (8)
         values = cycle%moments%rolling_resistance
      case default
         values = cycle%moments%films%peak
      end select
   end function quantity

   !> Places of the nodes.
   subroutine write_places(group, cycles, nodes, error)
      !> Group of the file
      type(hdf5_object_t), intent(in) :: group
      !> The cycles
      type(ehl_cycle_t), intent(in) :: cycles(:)
      !> Most nodes of a case
      integer, intent(in) :: nodes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      ! Places [half widths]
      real(wp), allocatable :: rows(:, :)
      integer :: i

      allocate (rows(nodes, size(cycles)))
      rows = not_a_number()
      do i = 1, size(cycles)
         if (allocated(cycles(i)%nodes)) rows(:size(cycles(i)%nodes), i) = cycles(i)%nodes
      end do
      call create_numbers(group, "x", shape(rows), [integer ::], 0, dataset, error)
      if (.not. allocated(error)) call describe(dataset, "1", "place of the nodes over half_width, inlet first", error)
      if (.not. allocated(error)) call write_numbers(dataset, 0, rows, error)
      call close_object(dataset)
   end subroutine write_places

   !> Pressure or film over case, angle and node.
   subroutine write_profiles(group, name, unit, meaning, cycles, nodes, error)
      !> Group of the file
      type(hdf5_object_t), intent(in) :: group
      !> Name, `pressure` or `film`; its unit and meaning
      character(len=*), intent(in) :: name, unit, meaning
      !> The cycles
      type(ehl_cycle_t), intent(in) :: cycles(:)
      !> Most nodes of a case
      integer, intent(in) :: nodes
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(hdf5_object_t) :: dataset
      ! Profiles at the angles of the file [unit of the dataset]
      real(wp), allocatable :: plane(:, :)
      integer :: i

      call create_numbers(group, name, [nodes, angle_count, size(cycles)], [integer ::], 0, dataset, error)
      if (.not. allocated(error)) call describe(dataset, unit, meaning//" over case, angle, node", error)
      allocate (plane(nodes, angle_count))
      do i = 1, size(cycles)
         if (allocated(error)) exit
         plane = not_a_number()
         if (allocated(cycles(i)%pressure)) then
            if (name == "film") then
               plane(:size(cycles(i)%nodes), :) = resample(cycles(i)%angle, cycles(i)%film)
            else
               plane(:size(cycles(i)%nodes), :) = resample(cycles(i)%angle, cycles(i)%pressure)
            end if
         end if
         call write_numbers(dataset, i - 1, plane, 3, error)
      end do
      call close_object(dataset)
   end subroutine write_profiles

   !> Values at the angles of the file.
   pure function resample(angles, values) result(rows)
      !> Accepted angles from full lift, increasing [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [unit of the quantity]
      real(wp), intent(in) :: values(:, :)
      !> Values at the angles of the file [unit of the quantity]
      real(wp) :: rows(size(values, 1), angle_count)

      ! Angle [rad], part of the way to the next accepted one [-]
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

   !> What stands where there is nothing.
   pure function not_a_number() result(value)
      use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
      !> NaN [any]
      real(wp) :: value

      value = ieee_value(value, ieee_quiet_nan)
   end function not_a_number

end module camroller_ehl_file
