!> Cases that a result file says it has, compared with those of its deck.
!>
!> In: a result file, the sweep of its deck, a run of cases. Out: which of their numbers and swept values differ.
module camroller_input_comparison
   use camroller_kinds, only : wp
   use camroller_deck_sweep, only : get_sweep_value, sweep_t
   use camroller_differences, only : compare, difference_t
   use camroller_error, only : error_t
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : read_numbers, read_text
   use camroller_quotes, only : without_quotes
   implicit none
   private

   public :: compare_inputs

contains

   !> Compare numbers of the cases and values that vary.
   subroutine compare_inputs(list, file, sweep, first, differs, error)
      !> What differs so far
      type(difference_t), allocatable, intent(inout) :: list(:)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> What varies in its deck
      type(sweep_t), intent(in) :: sweep
      !> First case, from 1
      integer, intent(in) :: first
      !> Cases that differ
      logical, intent(inout) :: differs(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, value, word
      real(wp), allocatable :: stored(:) ! [unit of the value]
      real(wp) :: number ! [unit of the value]
      integer :: i, k

      call read_numbers(file, "/case", [first - 1], shape(differs), stored, error)
      if (allocated(error)) return
      do i = 1, size(differs)
         call compare(list, "case", first + i - 2, stored(i), real(first + i - 2, wp), differs(i))
      end do
      do k = 1, size(sweep%axes)
         name = "sweep/"//sweep%axes(k)%key
         if (sweep%axes(k)%is_numeric) call read_numbers(file, "/"//name, [first - 1], shape(differs), stored, error)
         do i = 1, size(differs)
            if (allocated(error)) return
            call get_sweep_value(sweep, k, first + i - 1, value)
            if (sweep%axes(k)%is_numeric) then
               read (value, *) number
               call compare(list, name, first + i - 2, stored(i), number, differs(i))
            else
               call read_text(file, "/"//name, [first + i - 2], word, error)
               call compare(list, name, first + i - 2, word, without_quotes(value), differs(i))
            end if
         end do
      end do
   end subroutine compare_inputs

end module camroller_input_comparison
