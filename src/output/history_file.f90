!> What is listed over hours of running, in the result file.
!>
!> In: rows of one case after the other. Out: `/running_in` in the file, from the first case that has some on: over case and the
!> part of the running time; not-a-number where a case has none.
module camroller_history_file
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_hdf5_attribute, only : attach_scale, make_scale, put_attribute
   use camroller_hdf5_file, only : close_object, create_group, create_numbers, reserve_file, write_numbers
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_output_file, only : abandon_output, number_size, object_size, output_t
   use camroller_result, only : find_quantity, quantity_t
   implicit none
   private

   public :: history_file_t, put_history, close_history

   !> Name of the group
   character(len=*), parameter :: history_group = "running_in"

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

      integer :: i, cases

      cases = size(writer%status)
      self%is_open = .true.
      self%quantities = quantities
      allocate (self%columns(size(quantities)))
      call reserve_file(writer%file, object_size*(2 + size(quantities)) + number_size*real(rows, wp)*(1 + cases*size(quantities)), &
         & error)
      if (.not. allocated(error)) call create_group(writer%file, history_group, self%group, error)
      if (.not. allocated(error)) call create_numbers(self%group, "running_time_part", [rows], [integer ::], 0, self%axis, error)
      if (.not. allocated(error)) call describe(self%axis, "1", "part of the running time", "running_in", "case", error)
      if (.not. allocated(error)) call make_scale(self%axis, error)
      if (.not. allocated(error)) call write_numbers(self%axis, 0, [(real(i, wp)/max(rows - 1, 1), i=0, rows - 1)], error)
      do i = 1, size(quantities)
         if (allocated(error)) return
         associate (quantity => quantities(i), dataset => self%columns(i))
            call create_numbers(self%group, quantity%name, [rows, cases], [integer ::], 0, dataset, error)
            if (.not. allocated(error)) call describe(dataset, quantity%unit, quantity%description, quantity%source, &
               & trim(quantity%scope), error)
            if (.not. allocated(error)) call attach_scale(dataset, self%axis, 1, 2, error)
            if (.not. allocated(error)) call attach_scale(dataset, writer%case_axis, 2, 2, error)
         end associate
      end do
   end subroutine open_history

   !> Attributes that say what a dataset is.
   subroutine describe(dataset, unit, meaning, source, scope, error)
      !> The dataset
      type(hdf5_object_t), intent(in) :: dataset
      !> Unit of its values, meaning in a few words, part of the model, what it belongs to
      character(len=*), intent(in) :: unit, meaning, source, scope
      !> File error
      type(error_t), allocatable, intent(out) :: error

      call put_attribute(dataset, "units", unit, error)
      if (.not. allocated(error)) call put_attribute(dataset, "long_name", meaning, error)
      if (.not. allocated(error)) call put_attribute(dataset, "source", source, error)
      if (.not. allocated(error)) call put_attribute(dataset, "scope", scope, error)
   end subroutine describe

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
