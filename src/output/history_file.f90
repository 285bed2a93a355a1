!> What is listed over another axis than the cam angle, in the result file: hours of running, or turns of a flexible train.
!>
!> In: rows of one case after the other. Out: a group in the file for each list, from the first case that has it on: over case and
!> the part of the running time, or the number of the turn; not-a-number where a case has none, or fewer rows than others.
module camroller_history_file
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_flexible_report, only : most_turns
   use camroller_hdf5_attribute, only : attach_scale, describe, make_scale
   use camroller_hdf5_file, only : create_group, create_numbers, reserve_file, write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_names, only : name_length
   use camroller_output_file, only : abandon_output, number_size, object_size, output_t
   use camroller_result, only : find_quantity, quantity_t
   implicit none
   private

   public :: history_file_t, history_group, rows_in_list, put_history, close_history

   !> A list: the part of the model that it comes from, its group, its axis
   type :: list_t
      character(len=name_length) :: source, group, axis
      character(len=48) :: meaning
   end type list_t

   !> The lists
   type(list_t), parameter :: lists(*) = [list_t("running_in", "running_in", "running_time_part", "part of the running time"), &
      & list_t("dynamics", "turns", "turn", "turn, from the first that the summary covers")]
   integer, parameter :: over_turns = 2

   !> Where the rows of one list go
   type :: list_file_t
      !> Are the datasets there?
      logical :: is_open = .false.
      type(hdf5_object_t) :: group, axis
      type(hdf5_object_t), allocatable :: columns(:)
      !> What they hold
      type(quantity_t), allocatable :: quantities(:)
   end type list_file_t

   !> Where rows go
   type :: history_file_t
      type(list_file_t) :: lists(size(lists))
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
      !> What the columns mean, of all lists
      type(quantity_t), intent(in) :: quantities(:)
      !> Values, shape (row, quantity), not-a-number after the last row of a list [unit of the quantity]; not allocated where there
      !> are none
      real(wp), allocatable, intent(in) :: values(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(quantity_t), allocatable :: own(:)
      ! Its values [unit of the quantity]
      real(wp), allocatable :: rows(:, :)
      integer, allocatable :: columns(:)
      integer :: kind

      if (.not. allocated(values)) return
      do kind = 1, size(lists)
         columns = columns_of(quantities, lists(kind)%source)
         if (size(columns) == 0) cycle
         own = quantities(columns)
         rows = values(:, columns)
         call put_list(self%lists(kind), writer, kind, position, own, rows, error)
         if (allocated(error)) exit
      end do
      if (allocated(error)) call abandon_output(writer)
   end subroutine put_history

   !> Write the rows of a list of a case.
   subroutine put_list(self, writer, kind, position, quantities, values, error)
      !> Where they go
      type(list_file_t), intent(inout) :: self
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Which list, number of the case from 1
      integer, intent(in) :: kind, position
      !> What the columns mean
      type(quantity_t), intent(in) :: quantities(:)
      !> Values, shape (row, quantity) [unit of the quantity]
      real(wp), intent(in) :: values(:, :)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! One column [unit of the quantity]
      real(wp), allocatable :: column(:, :)
      integer :: i, place, rows

      rows = rows_of(values)
      if (.not. self%is_open) call open_list(self, writer, kind, quantities, rows, error)
      do i = 1, size(self%columns)
         if (allocated(error)) exit
         place = find_quantity(quantities, self%quantities(i)%name)
         if (place == 0) cycle
         column = values(:rows, place:place)
         call write_numbers(self%columns(i), position - 1, column, error)
      end do
   end subroutine put_list

   !> Number of rows of a list.
   pure function rows_of(values) result(rows)
      !> All its columns, not-a-number after the last row [any]
      real(wp), intent(in) :: values(:, :)
      !> The number
      integer :: rows

      rows = findloc(.not. all(ieee_is_nan(values), 2), .true., 1, back=.true.)
   end function rows_of

   !> Number of rows of the list that a quantity is in.
   pure function rows_in_list(quantities, values, place) result(rows)
      !> What the columns mean, of all lists
      type(quantity_t), intent(in) :: quantities(:)
      !> Values, shape (row, quantity) [unit of the quantity]
      real(wp), intent(in) :: values(:, :)
      !> Place of the quantity
      integer, intent(in) :: place
      !> The number
      integer :: rows

      ! Values of the list [unit of the quantity]
      real(wp), allocatable :: own(:, :)

      own = values(:, columns_of(quantities, quantities(place)%source))
      rows = rows_of(own)
   end function rows_in_list

   !> Which quantities come from a part of the model.
   pure function columns_of(quantities, source) result(columns)
      type(quantity_t), intent(in) :: quantities(:)
      !> The part
      character(len=*), intent(in) :: source
      !> Their places
      integer, allocatable :: columns(:)

      integer :: i

      columns = pack([(i, i=1, size(quantities))], [(quantities(i)%source == source, i=1, size(quantities))])
   end function columns_of

   !> Group of the file that a quantity is in.
   pure function history_group(quantity) result(group)
      !> The quantity of a list
      type(quantity_t), intent(in) :: quantity
      !> Its name
      character(len=name_length) :: group

      integer :: kind

      group = ""
      do kind = 1, size(lists)
         if (lists(kind)%source == quantity%source) group = lists(kind)%group
      end do
   end function history_group

   !> Create the datasets.
   subroutine open_list(self, writer, kind, quantities, rows, error)
      !> Where rows go
      type(list_file_t), intent(inout) :: self
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Which list
      integer, intent(in) :: kind
      !> What the columns mean
      type(quantity_t), intent(in) :: quantities(:)
      !> Number of rows
      integer, intent(in) :: rows
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(list_t) :: list
      ! Places on the axis [unit of the axis]
      real(wp), allocatable :: places(:)
      integer :: i, cases

      cases = size(writer%status)
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
   end subroutine open_list

   !> Close the datasets.
   subroutine close_history(self)
      !> Where rows went
      type(history_file_t), intent(inout) :: self

      self%lists%is_open = .false.
   end subroutine close_history

end module camroller_history_file
