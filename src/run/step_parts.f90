!> Equal parts that a step of a host is divided into.
!>
!> In: cam angle of the step, longest part. Out: their number, the same for steps that differ by rounding alone.
module camroller_step_parts
   use camroller_kinds, only : wp
   implicit none
   private

   public :: part_number

   !> Part by which one may be longer than the longest [-]: a step is the difference of two angles within 1e6 turns, rounded to 1e-9
   !> rad, so that a degree is off by 1e-7 of itself at most. Equal steps have equal parts, wherever they are
   real(wp), parameter :: slack = 1.0e-6_wp

contains

   !> Fewest equal parts that are not longer than the longest, but for rounding.
   elemental function part_number(span, longest) result(parts)
      !> Cam angle of the step, and of its longest part [rad]
      real(wp), intent(in) :: span, longest
      !> The number, 1 at least
      integer :: parts

      parts = max(1, ceiling(span/longest*(1.0_wp - slack)))
   end function part_number

end module camroller_step_parts
