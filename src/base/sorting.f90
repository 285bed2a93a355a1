!> Numbers in rising order.
!>
!> In: numbers. Out: the same sorted, the order in which they rise, or their median.
module camroller_sorting
   use camroller_kinds, only : wp
   implicit none
   private

   public :: find_order, sort, median

contains

   !> Order in which numbers rise, equal ones as they stand: runs that rise as they are, each with the next, are merged until one is
   !> left.
   pure subroutine find_order(values, order)
      !> Numbers [any]
      real(wp), intent(in) :: values(:)
      !> Places of the numbers in that order
      integer, intent(out) :: order(size(values))

      ! Places merged; first place of each run, and what follows the last
      integer :: merged(size(values)), starts(size(values) + 1)
      integer :: runs, run, left, right, last, i

      order = [(i, i=1, size(values))]
      runs = min(1, size(values))
      starts(1) = 1
      do i = 2, size(values)
         if (values(i) >= values(i - 1)) cycle
         runs = runs + 1
         starts(runs) = i
      end do
      starts(runs + 1) = size(values) + 1
      do while (runs > 1)
         do run = 1, runs - 1, 2
            left = starts(run)
            right = starts(run + 1)
            do i = starts(run), starts(run + 2) - 1
               if (right == starts(run + 2)) then
                  merged(i) = order(left)
                  left = left + 1
               else if (left == starts(run + 1)) then
                  merged(i) = order(right)
                  right = right + 1
               else if (values(order(left)) <= values(order(right))) then
                  merged(i) = order(left)
                  left = left + 1
               else
                  merged(i) = order(right)
                  right = right + 1
               end if
            end do
         end do
         last = merge(starts(runs) - 1, size(values), modulo(runs, 2) == 1)
         order(:last) = merged(:last)
         do run = 1, (runs + 1)/2
            starts(run) = starts(2*run - 1)
         end do
         runs = (runs + 1)/2
         starts(runs + 1) = size(values) + 1
      end do
   end subroutine find_order

   !> Sort a short list by insertion.
   pure subroutine sort(values)
      !> Numbers, in and out [any]
      real(wp), intent(inout) :: values(:)

      integer :: order(size(values))

      call find_order(values, order)
      values = values(order)
   end subroutine sort

   !> Median, the mean of the two in the middle where their number is even; zero without any.
   pure function median(values) result(middle)
      !> Numbers [any]
      real(wp), intent(in) :: values(:)
      !> Their median [any]
      real(wp) :: middle

      integer :: order(size(values))

      middle = 0.0_wp
      if (size(values) == 0) return
      call find_order(values, order)
      associate (n => size(values))
         middle = 0.5_wp*(values(order((n + 1)/2)) + values(order(n/2 + 1)))
      end associate
   end function median

end module camroller_sorting
