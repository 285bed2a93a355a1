!> Error of means over turns of which none repeats another: as many others would have other means.
!>
!> In: means of single turns. Out: error of the mean of all, by the scatter of means over parts of the turns. Turns hang together,
!> so that the scatter from one to the next says little: what swings back within a part takes no part in it, and what lasts longer
!> does in full. Source: Conway, Management Science 10 (1963) 47.
module camroller_turn_scatter
   use camroller_kinds, only : wp
   implicit none
   private

   public :: scatter_error

   !> Parts of the turns: of 40, each has as many as the longest period that is looked for
   integer, parameter :: parts = 5
   !> Distance that 95 of 100 means keep from what they estimate, over the standard deviation that the parts tell of: Student's
   !> distribution for as many parts less one [-]
   real(wp), parameter :: student = 2.776445_wp

contains

   !> Error of the mean of all turns.
   pure function scatter_error(means) result(error)
      !> Means of each turn, shape (quantity, turn); as many turns as parts at least [unit of each]
      real(wp), intent(in) :: means(:, :)
      !> The error [unit of each]
      real(wp) :: error(size(means, 1))

      ! Means of the parts [unit of each]
      real(wp) :: of_parts(size(means, 1), parts)
      integer :: part, first, last

      last = 0
      do part = 1, parts
         first = last + 1
         last = part*size(means, 2)/parts
         of_parts(:, part) = sum(means(:, first:last), 2)/(last - first + 1)
      end do
      error = sum(of_parts, 2)/parts
      error = student*sqrt(sum((of_parts - spread(error, 2, parts))**2, 2)/(parts*(parts - 1)))
   end function scatter_error

end module camroller_turn_scatter
