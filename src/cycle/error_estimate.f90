!> Error of a cycle, estimated from the defect of its solution.
!>
!> In: at the nodes of the quadrature for means, the slope of the solution minus the rate of the roller equation there (its
!> defect), and at those of its Gauss rule the decay rate. Out: the error of the sliding speed at the latter, and the largest in
!> the cycle.
!>
!> The error obeys `d error/d angle = defect - decay_rate*error` in first order. Its terms are evaluated for the means anyway, so
!> the estimate costs no further evaluation, and it holds for any method, interpolation included. Source: Enright, SIAM J. Numer.
!> Anal. 26 (1989) 588, on defects as a measure of error.
module camroller_error_estimate
   use camroller_kinds, only : wp
   use camroller_panels, only : gauss_points, panel_places, panel_points
   implicit none
   private

   public :: estimate_t, add_defect, end_interval, estimated_error, error_at_start, margin, contact_accuracy_for

   !> Most points of an interval with a decay rate
   integer, parameter :: most_rates = size(gauss_points)
   !> Places that cut an interval into parts [-]: shorter ones at its ends, where the defect of a stiff method is largest. The
   !> points of all rules are among them
   real(wp), parameter :: cuts(*) = [0.0_wp, panel_places, 1.0_wp]
   !> The estimate is of first order; true errors were met at up to 1.25 times as much [-]
   real(wp), parameter :: margin = 2.0_wp
   !> Exponent of the growth over a part of an interval beyond which more makes no difference [-]
   real(wp), parameter :: largest_growth = 30.0_wp
   !> Error, and growth over a cycle, beyond which more makes no difference [m/s] and [-]
   real(wp), parameter :: lost = 1.0e30_wp

   !> The estimate on its way round the cycle
   type :: estimate_t
      !> Points of the present interval so far, and those of them with a decay rate
      integer :: points = 0, rated = 0
      !> Place of each point in the interval [-], defect there [m/s/rad]
      real(wp) :: places(panel_points) = 0.0_wp, defects(panel_points) = 0.0_wp
      !> Places of the points with a decay rate [-], the rate [1/rad]; which of the cuts they are
      real(wp) :: rate_places(most_rates) = 0.0_wp, rates(most_rates) = 0.0_wp
      integer :: rate_cuts(most_rates) = 0
      !> Error at each of those once the interval has ended [m/s], part of an error at the start of the cycle that is left there [-]
      real(wp) :: errors(most_rates) = 0.0_wp, shares(most_rates) = 0.0_wp
      !> The same at all points of the rules, last at the end [m/s], [-]
      real(wp) :: point_errors(panel_points + 1) = 0.0_wp, point_shares(panel_points + 1) = 0.0_wp
      !> Error at the end of the last interval, largest so far [m/s]
      real(wp) :: error = 0.0_wp, largest = 0.0_wp
      !> Part of an error at the start of the cycle that is left [-]
      real(wp) :: contraction = 1.0_wp
      !> Shares of the defects at all cuts in those in the middle of the parts, once they are known [-]
      real(wp) :: middle_shares(size(cuts) - 1, size(cuts)) = 0.0_wp
      logical :: has_shares = .false.
   end type estimate_t

contains

   !> Add a point of the present interval.
   pure subroutine add_defect(estimate, place, defect, decay_rate)
      !> The estimate
      type(estimate_t), intent(inout) :: estimate
      !> Place in the interval, after those of the points before [-]
      real(wp), intent(in) :: place
      !> Slope of the curve less rate of the equation [m/s/rad]
      real(wp), intent(in) :: defect
      !> Decay rate of a disturbance, at two or three points of an interval [1/rad]
      real(wp), intent(in), optional :: decay_rate

      estimate%points = estimate%points + 1
      estimate%places(estimate%points) = place
      estimate%defects(estimate%points) = defect
      if (.not. present(decay_rate)) return
      estimate%rated = estimate%rated + 1
      estimate%rate_places(estimate%rated) = place
      estimate%rates(estimate%rated) = decay_rate
      estimate%rate_cuts(estimate%rated) = minloc(abs(cuts - place), 1)
   end subroutine add_defect

   !> Carry the error over an interval, or over two of the solution as one.
   !>
   !> The defect is taken as the polynomial through its points, the decay rate as changing by the same factor over the same length
   !> between them, since it may span decades, and as constant over a part.
   pure subroutine end_interval(estimate, length, ends)
      !> The estimate; its points are used up
      type(estimate_t), intent(inout) :: estimate
      !> Length of the interval [rad]
      real(wp), intent(in) :: length
      !> Defects at its start and at its end [m/s/rad], where the points are inside and these are known
      real(wp), intent(in), optional :: ends(2)

      ! Defects at the cuts and in the middle of the parts [m/s/rad]
      real(wp) :: at_cuts(size(cuts)), at_middles(size(cuts) - 1)
      ! Length of a part over that of the interval [-]; decay over it, what it leaves [-]; logarithms of the decay rates, one of
      ! them 1/rad [-]
      real(wp) :: part, decay, left, logs(most_rates)
      integer :: i

      call interpolate_defects(estimate, at_cuts, at_middles, ends)
      logs(:estimate%rated) = log(max(estimate%rates(:estimate%rated), tiny(1.0_wp)))
      associate (nodes => estimate%rate_places(:estimate%rated), rates => estimate%rates(:estimate%rated))
         call keep_error(estimate, 1)
         do i = 1, size(cuts) - 1
            part = cuts(i + 1) - cuts(i)
            decay = max(rate_at(nodes, rates, logs, cuts(i) + 0.5_wp*part)*length*part, -largest_growth)
            left = exp(-decay)
            estimate%error = left*estimate%error + length*part*decayed_integral([at_cuts(i), at_middles(i), at_cuts(i + 1)], decay)
            estimate%error = sign(min(abs(estimate%error), lost), estimate%error)
            estimate%contraction = min(estimate%contraction*left, lost)
            estimate%largest = max(estimate%largest, abs(estimate%error))
            call keep_error(estimate, i + 1)
            estimate%point_errors(i) = estimate%error
            estimate%point_shares(i) = estimate%contraction
         end do
      end associate
      estimate%points = 0
      estimate%rated = 0
   end subroutine end_interval

   !> Defects at the cuts of an interval and in the middle between them, by the polynomial through all that are known.
   pure subroutine interpolate_defects(estimate, at_cuts, at_middles, ends)
      !> The estimate with the points of the interval
      type(estimate_t), intent(inout) :: estimate
      !> The defects [m/s/rad]
      real(wp), intent(out) :: at_cuts(:), at_middles(:)
      !> Defects at the ends [m/s/rad], where they are known besides
      real(wp), intent(in), optional :: ends(2)

      ! Places [-] and defects [m/s/rad] that are known; weights of the polynomial through them [-]
      real(wp) :: places(panel_points + 2), values(panel_points + 2), weights(panel_points + 2)
      integer :: i, known

      if (present(ends) .and. estimate%points == panel_points) then
         if (.not. estimate%has_shares) call find_shares(estimate)
         at_cuts = [ends(1), estimate%defects, ends(2)]
         at_middles = matmul(estimate%middle_shares, at_cuts)
         return
      end if
      known = estimate%points
      places(:known) = estimate%places(:known)
      values(:known) = estimate%defects(:known)
      if (present(ends)) then
         places(known + 1:known + 2) = [0.0_wp, 1.0_wp]
         values(known + 1:known + 2) = ends
         known = known + 2
      end if
      weights(:known) = node_weights(places(:known))
      do i = 1, size(cuts)
         at_cuts(i) = value_at(places(:known), weights(:known), values(:known), cuts(i))
      end do
      do i = 1, size(cuts) - 1
         at_middles(i) = value_at(places(:known), weights(:known), values(:known), cuts(i) + 0.5_wp*(cuts(i + 1) - cuts(i)))
      end do
   end subroutine interpolate_defects

   !> Shares of the defects at all cuts in those in the middle of the parts, by the polynomial through them.
   pure subroutine find_shares(estimate)
      !> Gets the shares
      type(estimate_t), intent(inout) :: estimate

      ! Weights of the polynomial through the cuts, a defect of one at a cut alone [-]
      real(wp) :: weights(size(cuts)), unit(size(cuts))
      integer :: cut, i

      weights = node_weights(cuts)
      do cut = 1, size(cuts)
         unit = 0.0_wp
         unit(cut) = 1.0_wp
         do i = 1, size(cuts) - 1
            estimate%middle_shares(i, cut) = value_at(cuts, weights, unit, cuts(i) + 0.5_wp*(cuts(i + 1) - cuts(i)))
         end do
      end do
      estimate%has_shares = .true.
   end subroutine find_shares

   !> Keep error and contraction for the point of the interval that stands at a cut, if there is one.
   pure subroutine keep_error(estimate, cut)
      type(estimate_t), intent(inout) :: estimate
      integer, intent(in) :: cut

      integer :: i

      do i = 1, estimate%rated
         if (estimate%rate_cuts(i) /= cut) cycle
         estimate%errors(i) = estimate%error
         estimate%shares(i) = estimate%contraction
      end do
   end subroutine keep_error

   !> Integral of the parabola through three values over [0, 1], of which what is left decays up to its end.
   pure function decayed_integral(values, decay) result(integral)
      !> Values at the start, in the middle and at the end [any]
      real(wp), intent(in) :: values(3)
      !> Exponent of the decay over the part; negative: growth [-]
      real(wp), intent(in) :: decay
      !> The integral [unit of the values]
      real(wp) :: integral

      ! Decay below which differences of what follows would be rounding: the decayed parabola is then integrated by Simpson's rule,
      ! whose error is the fifth power of it [-]
      real(wp), parameter :: little = 0.01_wp
      ! Integrals of the decayed powers 0, 1 and 2 [-]; slope and curvature of the parabola [unit of the values]
      real(wp) :: powers(0:2), slope, curvature

      if (abs(decay) < little) then
         integral = (values(1)*exp(-decay) + 4.0_wp*values(2)*exp(-0.5_wp*decay) + values(3))/6.0_wp
         return
      end if
      powers(0) = (1.0_wp - exp(-decay))/decay
      powers(1) = (1.0_wp - powers(0))/decay
      powers(2) = (1.0_wp - 2.0_wp*powers(1))/decay
      slope = 4.0_wp*values(2) - 3.0_wp*values(1) - values(3)
      curvature = 2.0_wp*(values(1) + values(3)) - 4.0_wp*values(2)
      integral = values(1)*powers(0) + slope*powers(1) + curvature*powers(2)
   end function decayed_integral

   !> Largest error over the cycle, with what the cycle passes on to itself, and a margin.
   pure function estimated_error(estimate) result(error)
      !> The estimate at the end of the cycle
      type(estimate_t), intent(in) :: estimate
      !> The error [m/s]
      real(wp) :: error

      error = margin*(estimate%largest &
         & + abs(estimate%error)*estimate%contraction/max(1.0_wp - estimate%contraction, epsilon(1.0_wp)))
   end function estimated_error

   !> Error at the start of the periodic cycle: what its end passes on to it, and what start and end of the curve differ by.
   pure function error_at_start(estimate, closure) result(error)
      !> The estimate at the end of the cycle
      type(estimate_t), intent(in) :: estimate
      !> Sliding speed at the end less that at the start [m/s]
      real(wp), intent(in) :: closure
      !> The error [m/s]
      real(wp) :: error

      error = (estimate%error - closure)/max(1.0_wp - estimate%contraction, epsilon(1.0_wp))
   end function error_at_start

   !> Relative error to which the contacts of a cycle are solved once it is known: far less than the tolerance.
   elemental function contact_accuracy_for(tolerance) result(accuracy)
      !> Tolerance of the cycle [-]
      real(wp), intent(in) :: tolerance
      !> The error [-]
      real(wp) :: accuracy

      ! The error over the tolerance; largest [-]
      real(wp), parameter :: small_part = 1.0e-2_wp, largest = 1.0e-7_wp

      accuracy = min(small_part*tolerance, largest)
   end function contact_accuracy_for

   !> Decay rate between two or three points, constant beyond them.
   pure function rate_at(nodes, rates, logs, place) result(rate)
      !> Places of the points, in order [-]
      real(wp), intent(in) :: nodes(:)
      !> Decay rates there [1/rad], their logarithms [-]
      real(wp), intent(in) :: rates(:), logs(:)
      !> Place looked for [-]
      real(wp), intent(in) :: place
      !> Decay rate there [1/rad]
      real(wp) :: rate

      ! Place between two points [-]
      real(wp) :: part
      integer :: i

      i = 1
      do while (i < size(nodes) - 1 .and. place > nodes(i + 1))
         i = i + 1
      end do
      part = min(1.0_wp, max(0.0_wp, (place - nodes(i))/(nodes(i + 1) - nodes(i))))
      if (min(rates(i), rates(i + 1)) < 0.0_wp) then
         rate = merge(rates(i), rates(i + 1), part < 0.5_wp)
      else
         rate = exp(logs(i) + part*(logs(i + 1) - logs(i)))
      end if
   end function rate_at

   !> Weights of the polynomial through some points: one over the product of the distances of each from the others.
   pure function node_weights(nodes) result(weights)
      !> Places of the points [-]
      real(wp), intent(in) :: nodes(:)
      !> The weights [-]
      real(wp) :: weights(size(nodes))

      integer :: i

      do i = 1, size(nodes)
         weights(i) = 1.0_wp/(product(nodes(i) - nodes(:i - 1))*product(nodes(i) - nodes(i + 1:)))
      end do
   end function node_weights

   !> Value of the polynomial through some points, by the barycentric formula.
   pure function value_at(nodes, weights, values, place) result(value)
      !> Places of the points, and their weights [-]
      real(wp), intent(in) :: nodes(:), weights(:)
      !> Values there [any]
      real(wp), intent(in) :: values(:)
      !> Place looked for [-]
      real(wp), intent(in) :: place
      !> Value there [any]
      real(wp) :: value

      ! A weight over the distance from its point, and the sum of all [-]
      real(wp) :: share, shares
      integer :: i

      value = 0.0_wp
      shares = 0.0_wp
      do i = 1, size(nodes)
         if (abs(place - nodes(i)) <= epsilon(1.0_wp)) then
            value = values(i)
            return
         end if
         share = weights(i)/(place - nodes(i))
         value = value + share*values(i)
         shares = shares + share
      end do
      value = value/shares
   end function value_at

end module camroller_error_estimate
