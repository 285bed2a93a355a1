!> What is listed over another axis than the cam angle, in the result file: hours of running, or turns of a flexible train.
!>
!> In: rows of one case after the other. Out: a group in the file, from the first case that has some on: over case and the part of
!> the running time, or the number of the turn; not-a-number where a case has none, or fewer rows than others.
module camroller_history_file
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_flexible_report, only : most_turns
   use camroller_hdf5_attribute, only : attach_scale, describe, make_scale
   use camroller_hdf5_file, only : close_object, create_group, create_numbers, reserve_file, write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_names, only : name_length
   use camroller_output_file, only : abandon_output, number_size, object_size, output_t
   use camroller_result, only : find_quantity, quantity_t
   implicit none
   private

   public :: history_file_t, history_group, put_history, close_history

   !> A list: the part of the model that it comes from, its group, its axis
   type :: list_t
      character(len=name_length) :: source, group, axis
      character(len=48) :: meaning
   end type list_t

   !> The lists; a case has one of them at most, since running-in needs a rigid train
   type(list_t), parameter :: lists(*) = [list_t("running_in", "running_in", "running_time_part", "part of the running time"), &
      & list_t("dynamics", "turns", "turn", "turn, from the first that the summary covers")]
   integer, parameter :: over_turns = 2

   !> Where rows go
   type :: history_file_t
      !> Are the datasets there?
      logical :: is_open = .false.
      type(hdf5_object_t) :: group, axis
      type(hdf5_object_t), allocatable :: columns(:)
      !> What they hold
      type(quantity_t), allocatable :: quantities(:)
   end type history_file_t

contains

   !> Write the rows of a case, if there are any.
   subroutine put_history(self, writer, position, quantities, values, error)
      !> Where they go
      type(history_file_t), intent(inout) :: self
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> What the columns mean
      type(quantity_t), intent(in) :: quantities(:)
      !> Values, shape (row, quantity) [unit of the quantity]; not allocated where there are none
      real(wp), allocatable, intent(in) :: values(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! One row [unit of the quantity]
      real(wp), allocatable :: row(:, :)
      integer :: i, place

      if (.not. allocated(values)) return
      if (.not. self%is_open) call open_history(self, writer, quantities, size(values, 1), error)
      do i = 1, size(self%columns)
         if (allocated(error)) exit
         place = find_quantity(quantities, self%quantities(i)%name)
         if (place == 0) cycle
         row = values(:, place:place)
         call write_numbers(self%columns(i), position - 1, row, error)
      end do
      if (allocated(error)) call abandon_output(writer)
   end subroutine put_history

   !> Which list quantities are of.
   pure function list_of(quantities) result(kind)
      !> Quantities of a list
      type(quantity_t), intent(in) :: quantities(:)
      !> Place among the lists
      integer :: kind

      do kind = 1, size(lists) - 1
         if (lists(kind)%source == quantities(1)%source) return
      end do
   end function list_of

   !> Group of the file that a list is in.
   pure function history_group(quantities) result(group)
      !> Quantities of the list
      type(quantity_t), intent(in) :: quantities(:)
      !> Its name
      character(len=name_length) :: group

      group = lists(list_of(quantities))%group
   end function history_group

   !> Create the datasets.
   subroutine open_history(self, writer, quantities, rows, error)
      !> Where rows go
      type(history_file_t), intent(inout) :: self
      !> The result file
      type(output_t), intent(inout) :: writer
      !> What the columns mean
      type(quantity_t), intent(in) :: quantities(:)
      !> Number of rows
      integer, intent(in) :: rows
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(list_t) :: list
      ! Places on the axis [unit of the axis]
      real(wp), allocatable :: places(:)
      integer :: i, cases, kind

      cases = size(writer%status)
      kind = list_of(quantities)
      if (kind == over_turns) then
         places = [(real(i, wp), i=1, most_turns)]
      else
         places = [(real(i, wp)/max(rows - 1, 1), i=0, rows - 1)]
      end if
      self%is_open = .true.
      self%quantities = quantities
      allocate (self%columns(size(quantities)))
      call reserve_file(writer%file, object_size*(2 + size(quantities)) + number_size*real(size(places), wp) &
         & *(1 + cases*size(quantities)), error)
      list = lists(kind)
      if (.not. allocated(error)) call create_group(writer%file, trim(list%group), self%group, error)
      if (.not. allocated(error)) call create_numbers(self%group, trim(list%axis), shape(places), [integer ::], 0, self%axis, &
         & error)
      if (.not. allocated(error)) call describe(self%axis, "1", list%meaning, list%source, error, "case")
      if (.not. allocated(error)) call make_scale(self%axis, error)
      if (.not. allocated(error)) call write_numbers(self%axis, 0, places, error)
      do i = 1, size(quantities)
         if (allocated(error)) return
         associate (quantity => quantities(i), dataset => self%columns(i))
            call create_numbers(self%group, quantity%name, [size(places), cases], [integer ::], 0, dataset, error)
            if (.not. allocated(error)) call describe(dataset, quantity%unit, quantity%description, quantity%source, &
               & error, quantity%scope)
            if (.not. allocated(error)) call attach_scale(dataset, self%axis, 1, 2, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 2, 2, error)
         end associate
      end do
   end subroutine open_history

   !> Close the datasets.
   subroutine close_history(self)
      !> Where rows went
      type(history_file_t), intent(inout) :: self

      integer :: i

      if (.not. self%is_open) return
      do i = size(self%columns), 1, -1
         call close_object(self%columns(i))
      end do
      call close_object(self%axis)
      call close_object(self%group)
      self%is_open = .false.
   end subroutine close_history

end module camroller_history_file
