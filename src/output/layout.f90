!> Layout of the numbers of a case: names, units and meanings of its scalars and series, and the cam angles.
!>
!> In: results. Out: layouts that cases with the same quantities share, packed for part files, joined for the file
!> of all cases.
module camroller_layout
   use camroller_kinds, only : wp
   use camroller_result, only : quantity_t, result_t, find_quantity
   use camroller_record, only : record_t, put_integer, put_numbers, put_text, take_integer, take_numbers, take_text
   implicit none
   private

   public :: layout_t, layout_list_t, layout_of, put_layout, take_layout, join_quantities, places_of
   public :: find_layout, set_layout_at

   !> Quantities of a case
   type :: layout_t
      !> Scalars, series, and what is listed over hours of running or turns
      type(quantity_t), allocatable :: summary(:), series(:), history(:)
      !> Cam angles [deg]
      real(wp), allocatable :: angle(:)
   end type layout_t

   !> Layouts by their numbers, from 1
   type :: layout_list_t
      !> The layouts, with room behind them; without quantities where a number has none
      type(layout_t), allocatable :: items(:)
      !> Largest number in use
      integer :: count = 0
   end type layout_list_t

contains

   !> Layout of a result.
   subroutine layout_of(result, layout)
      !> The result
      type(result_t), intent(in) :: result
      !> Its layout
      type(layout_t), intent(out) :: layout

      layout%summary = result%summary
      layout%series = result%series
      layout%angle = result%angle
      allocate (layout%history(0))
      if (allocated(result%history)) layout%history = result%history
   end subroutine layout_of

   !> Has a result the quantities of a layout?
   pure function fits_layout(layout, result) result(verdict)
      type(layout_t), intent(in) :: layout
      type(result_t), intent(in) :: result
      !> Has it?
      logical :: verdict

      integer :: i, rows

      rows = 0
      if (allocated(result%history)) rows = size(result%history)
      verdict = size(layout%history) == rows
      if (.not. verdict) return
      verdict = size(layout%summary) == size(result%summary) .and. size(layout%series) == size(result%series) .and. &
         & size(layout%angle) == size(result%angle)
      if (.not. verdict) return
      do i = 1, size(layout%summary)
         verdict = verdict .and. layout%summary(i)%name == result%summary(i)%name
      end do
      do i = 1, size(layout%series)
         verdict = verdict .and. layout%series(i)%name == result%series(i)%name
      end do
   end function fits_layout

   !> Number of the layout of a result; one that is new is added to the list.
   subroutine find_layout(list, result, number, is_new)
      !> The list
      type(layout_list_t), intent(inout) :: list
      !> The result
      type(result_t), intent(in) :: result
      !> Number of its layout
      integer, intent(out) :: number
      !> Has it come for the first time?
      logical, intent(out) :: is_new

      type(layout_t) :: layout

      is_new = .false.
      do number = list%count, 1, -1
         if (fits_layout(list%items(number), result)) return
      end do
      is_new = .true.
      number = list%count + 1
      call layout_of(result, layout)
      call set_layout_at(list, number, layout)
   end subroutine find_layout

   !> Put a layout under a number of a list, which grows as far as it has to.
   subroutine set_layout_at(list, number, layout)
      !> The list
      type(layout_list_t), intent(inout) :: list
      !> The number, from 1
      integer, intent(in) :: number
      !> The layout
      type(layout_t), intent(in) :: layout

      type(layout_t), allocatable :: longer(:)

      if (.not. allocated(list%items)) allocate (list%items(4))
      if (number > size(list%items)) then
         allocate (longer(max(number, 2*size(list%items))))
         longer(:list%count) = list%items(:list%count)
         call move_alloc(longer, list%items)
      end if
      list%items(number) = layout
      list%count = max(list%count, number)
   end subroutine set_layout_at

   !> Pack a layout.
   subroutine put_layout(record, layout)
      !> The record
      type(record_t), intent(inout) :: record
      !> The layout
      type(layout_t), intent(in) :: layout

      call put_quantities(record, layout%summary)
      call put_quantities(record, layout%series)
      call put_quantities(record, layout%history)
      call put_integer(record, size(layout%angle))
      call put_numbers(record, layout%angle)
   end subroutine put_layout

   !> Pack quantities.
   subroutine put_quantities(record, quantities)
      type(record_t), intent(inout) :: record
      type(quantity_t), intent(in) :: quantities(:)

      integer :: i

      call put_integer(record, size(quantities))
      do i = 1, size(quantities)
         call put_text(record, quantities(i)%name)
         call put_text(record, trim(quantities(i)%unit))
         call put_text(record, quantities(i)%description)
         call put_text(record, trim(quantities(i)%source))
         call put_text(record, trim(quantities(i)%scope))
      end do
   end subroutine put_quantities

   !> Unpack a layout.
   subroutine take_layout(record, layout)
      !> The record
      type(record_t), intent(inout) :: record
      !> The layout
      type(layout_t), intent(out) :: layout

      integer :: angles

      call take_quantities(record, layout%summary)
      call take_quantities(record, layout%series)
      call take_quantities(record, layout%history)
      call take_integer(record, angles)
      allocate (layout%angle(angles))
      call take_numbers(record, layout%angle)
   end subroutine take_layout

   !> Unpack quantities.
   subroutine take_quantities(record, quantities)
      type(record_t), intent(inout) :: record
      type(quantity_t), allocatable, intent(out) :: quantities(:)

      character(len=:), allocatable :: text
      integer :: i, count

      call take_integer(record, count)
      allocate (quantities(count))
      do i = 1, count
         call take_text(record, quantities(i)%name)
         call take_text(record, text)
         quantities(i)%unit = text
         call take_text(record, quantities(i)%description)
         call take_text(record, text)
         quantities(i)%source = text
         call take_text(record, text)
         quantities(i)%scope = text
      end do
   end subroutine take_quantities

   !> Add quantities that are not there yet.
   subroutine join_quantities(joint, others)
      !> Quantities to add to; none where not allocated
      type(quantity_t), allocatable, intent(inout) :: joint(:)
      !> Other ones
      type(quantity_t), intent(in) :: others(:)

      type(quantity_t), allocatable :: longer(:)
      integer :: i, n

      if (.not. allocated(joint)) allocate (joint(0))
      allocate (longer(size(joint) + size(others)))
      n = size(joint)
      longer(:n) = joint
      do i = 1, size(others)
         if (find_quantity(joint, others(i)%name) > 0) cycle
         n = n + 1
         longer(n) = others(i)
      end do
      joint = longer(:n)
   end subroutine join_quantities

   !> Where quantities stand among others.
   pure function places_of(quantities, joint) result(places)
      !> The quantities
      type(quantity_t), intent(in) :: quantities(:)
      !> Those among which they are looked for
      type(quantity_t), intent(in) :: joint(:)
      !> Their positions, 0 where one is missing
      integer :: places(size(quantities))

      integer :: i, next

      ! mostly they follow each other as they do there
      next = 1
      do i = 1, size(quantities)
         places(i) = 0
         if (next <= size(joint)) then
            if (joint(next)%name == quantities(i)%name) places(i) = next
         end if
         if (places(i) == 0) places(i) = find_quantity(joint, quantities(i)%name)
         next = places(i) + 1
      end do
   end function places_of

end module camroller_layout
