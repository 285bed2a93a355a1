!> Error of a cycle, estimated from the equation that its own curve leaves unsatisfied.
!>
!> Layer: solver. In: at the points of the rule for means, the slope of the curve less the rate of the roller equation there (its
!> defect) and the decay rate. Out: the largest error of the sliding speed over the cycle.
!>
!> The error obeys `d error/d angle = defect - decay_rate*error` in first order. Its terms are evaluated for the means anyway, so
!> the estimate costs no evaluation, and it holds for any method, interpolation included. Source: Enright, SIAM J. Numer. Anal. 26
!> (1989) 588, on defects as a measure of error.
module camroller_error_estimate
   use camroller_kinds, only : wp
   implicit none
   private

   public :: estimate_t, add_defect, end_interval, estimated_error

   !> Most points of a rule in an interval
   integer, parameter :: most_points = 3
   !> Parts into which an interval is cut
   integer, parameter :: parts = 4
   !> The estimate is of first order; true errors were met at up to twice as much [-]
   real(wp), parameter :: margin = 6.0_wp

   !> The estimate on its way round the cycle
   type :: estimate_t
      !> Points of the present interval so far
      integer :: points = 0
      !> Defect [m/s/rad] and decay rate [1/rad] at each of them
      real(wp) :: defects(most_points) = 0.0_wp, rates(most_points) = 0.0_wp
      !> Error at the end of the last interval, largest so far [m/s]
      real(wp) :: error = 0.0_wp, largest = 0.0_wp
      !> Part of an error at the start of the cycle that is left [-]
      real(wp) :: contraction = 1.0_wp
   end type estimate_t

contains

   !> Add a point of the present interval.
   pure subroutine add_defect(estimate, defect, decay_rate)
      !> The estimate
      type(estimate_t), intent(inout) :: estimate
      !> Slope of the curve less rate of the equation [m/s/rad]
      real(wp), intent(in) :: defect
      !> Decay rate of a disturbance [1/rad]
      real(wp), intent(in) :: decay_rate

      estimate%points = estimate%points + 1
      estimate%defects(estimate%points) = defect
      estimate%rates(estimate%points) = max(decay_rate, 0.0_wp)
   end subroutine add_defect

   !> Carry the error over an interval.
   !>
   !> Defect and decay rate are taken as the parabolas, or lines, through their points. Each part keeps the integral of the defect
   !> where the decay is slow and the quotient of defect and decay rate where it is fast.
   pure subroutine end_interval(estimate, nodes, length)
      !> The estimate; its points are used up
      type(estimate_t), intent(inout) :: estimate
      !> Places of the points in the interval, in order [-]
      real(wp), intent(in) :: nodes(:)
      !> Length of the interval [rad]
      real(wp), intent(in) :: length

      ! Defect at start, middle and end of a part [m/s/rad]; decay over it, what it leaves, its mean weight [-]
      real(wp) :: defects(3), decay, left, weight
      integer :: part, i

      estimate%points = 0
      do part = 1, parts
         do i = 0, 2
            defects(i + 1) = value_at(nodes, estimate%defects(:size(nodes)), (part - 1 + 0.5_wp*i)/parts)
         end do
         decay = max(0.0_wp, value_at(nodes, estimate%rates(:size(nodes)), (part - 0.5_wp)/parts))*length/parts
         left = exp(-decay)
         weight = 1.0_wp
         if (decay > epsilon(1.0_wp)) weight = (1.0_wp - left)/decay
         estimate%error = left*estimate%error + length/parts*(weight*defects(2) &
            & + left*(defects(1) - 2.0_wp*defects(2) + defects(3))/6.0_wp)
         estimate%contraction = estimate%contraction*left
         estimate%largest = max(estimate%largest, abs(estimate%error))
      end do
   end subroutine end_interval

   !> Largest error over the cycle, with what the cycle passes on to itself, and a margin.
   pure function estimated_error(estimate) result(error)
      !> The estimate at the end of the cycle
      type(estimate_t), intent(in) :: estimate
      !> The error [m/s]
      real(wp) :: error

      error = margin*(estimate%largest &
         & + abs(estimate%error)*estimate%contraction/max(1.0_wp - estimate%contraction, epsilon(1.0_wp)))
   end function estimated_error

   !> Value of the polynomial through two or three points.
   pure function value_at(nodes, values, place) result(value)
      !> Places of the points [-]
      real(wp), intent(in) :: nodes(:)
      !> Values there [any]
      real(wp), intent(in) :: values(:)
      !> Place looked for [-]
      real(wp), intent(in) :: place
      !> Value there [any]
      real(wp) :: value

      ! One point's polynomial [-]
      real(wp) :: factor
      integer :: i, j

      value = 0.0_wp
      do i = 1, size(nodes)
         factor = 1.0_wp
         do j = 1, size(nodes)
            if (j /= i) factor = factor*(place - nodes(j))/(nodes(i) - nodes(j))
         end do
         value = value + factor*values(i)
      end do
   end function value_at

end module camroller_error_estimate
