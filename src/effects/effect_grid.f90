!> Angles of a survey of the cycle, means over them, and how a quantity follows its balance from one to the next.
!>
!> In: a model. Out: angles between the kinks of the lift, evenly spread in the event; where the valve rests and
!> nothing but the sliding speed changes, further and further apart, so that a decay after the event is seen whether it takes a
!> degree or a turn. Each piece between two kinks has an even number, so that every second angle makes a survey of its own.
!>
!> A quantity follows its balance with `dy/dtheta = -lambda (y - q)`. Inside a piece q is linear between two angles; up to a kink
!> and after it, q and lambda are those of the angle on the same side.
module camroller_effect_grid
   use camroller_kinds, only : wp, two_pi
   use camroller_lift, only : is_at_rest
   use camroller_model, only : model_t
   implicit none
   private

   public :: grid_t, points, slowest_decay, make_grid, delay, mean_over, sampling_error

   !> Angles of the survey
   integer, parameter :: points = 48
   !> Pieces of a cycle at most; with more kinks none is respected
   integer, parameter :: most_pieces = 6
   !> Angles in a stretch where the valve rests over those of an event of the same length [-]
   real(wp), parameter :: rest_density = 0.2_wp
   !> Distance between two angles there over the one before [-]
   real(wp), parameter :: rest_growth = 1.7_wp
   !> Slowest decay that is told from none [1/rad]
   real(wp), parameter :: slowest_decay = 1.0e-6_wp
   !> Laps after which the delayed balance is periodic for all purposes
   integer, parameter :: laps = 3

   !> The angles
   type :: grid_t
      !> Cam angles from full lift, increasing [rad]
      real(wp) :: angles(points)
      !> Fractions of the cycle that they represent [-]
      real(wp) :: weights(points)
      !> Distances from the kink before and to the one after [rad]
      real(wp) :: before(points), after(points)
      !> Number of the piece
      integer :: piece(points)
   end type grid_t

contains

   !> Choose the angles.
   pure subroutine make_grid(model, grid)
      !> The model
      type(model_t), intent(in) :: model
      !> The angles
      type(grid_t), intent(out) :: grid

      ! Kinks, with the first one again after a turn [rad]; what counts for the number of angles [rad]
      real(wp), allocatable :: edges(:), shares(:)
      integer, allocatable :: pairs(:)
      logical, allocatable :: rests(:)
      integer :: piece, last, largest

      edges = [-0.5_wp*two_pi]
      if (size(model%lift_stops) > 0 .and. size(model%lift_stops) <= most_pieces) edges = model%lift_stops
      edges = [edges, edges(1) + two_pi]
      shares = edges(2:) - edges(:size(edges) - 1)
      allocate (rests(size(shares)), source=.false.)
      do piece = 1, size(shares)
         if (allocated(model%gas)) cycle
         rests(piece) = is_at_rest(model%lift_law, 0.5_wp*(edges(piece) + edges(piece + 1)))
      end do
      where (rests) shares = rest_density*shares
      pairs = max(1, nint(0.5_wp*points*shares/sum(shares)))
      largest = maxloc(shares, 1)
      pairs(largest) = pairs(largest) + points/2 - sum(pairs)
      last = 0
      do piece = 1, size(pairs)
         call fill_piece(edges(piece), edges(piece + 1), merge(rest_growth, 1.0_wp, rests(piece)), piece, last, &
            & last + 2*pairs(piece), grid)
         last = last + 2*pairs(piece)
      end do
   end subroutine make_grid

   !> Angles of one piece, in the middle of the intervals that they represent.
   pure subroutine fill_piece(start, finish, growth, piece, first, last, grid)
      !> Its ends [rad]
      real(wp), intent(in) :: start, finish
      !> Length of an interval relative to that of the one before [-]
      real(wp), intent(in) :: growth
      !> Its number
      integer, intent(in) :: piece
      !> Number of angles before it, and with it
      integer, intent(in) :: first, last
      !> Gets the angles
      type(grid_t), intent(inout) :: grid

      ! Length of a stretch, and where it begins [rad]
      real(wp) :: length, reached
      integer :: i

      length = 1.0_wp
      reached = 0.0_wp
      do i = first + 1, last
         reached = reached + length
         length = growth*length
      end do
      length = (finish - start)/reached
      reached = 0.0_wp
      do i = first + 1, last
         grid%before(i) = reached + 0.5_wp*length
         grid%after(i) = finish - start - grid%before(i)
         grid%angles(i) = start + grid%before(i)
         grid%weights(i) = length/two_pi
         grid%piece(i) = piece
         reached = reached + length
         length = growth*length
      end do
   end subroutine fill_piece

   !> Let a quantity follow its balance with its decay, round the cycle until periodic.
   pure subroutine delay(grid, decay, balance, values, surveys, is_slow)
      !> The angles
      type(grid_t), intent(in) :: grid
      !> Decay rates [1/rad]
      real(wp), intent(in) :: decay(points)
      !> The balance [any]
      real(wp), intent(in) :: balance(points)
      !> The quantity; in: a start [any]
      real(wp), intent(inout) :: values(points)
      !> Surveys that share the angles, each of which does without those of the others; 1 without it
      integer, intent(in), optional :: surveys
      !> Is the decay between two angles the slower one of both, rather than their mean? Not without it
      logical, intent(in), optional :: is_slow

      ! Decay rate between two angles [1/rad]; decay, what it leaves, its mean weight [-]
      real(wp) :: rate, exponent, left, weight
      integer :: step, first, lap, i, next
      logical :: takes_slower

      step = 1
      if (present(surveys)) step = surveys
      takes_slower = .false.
      if (present(is_slow)) takes_slower = is_slow
      do first = 1, step
         do lap = 1, laps
            do i = first, points, step
               next = modulo(i + step - 1, points) + 1
               if (grid%piece(next) /= grid%piece(i)) then
                  left = exp(-min(decay(i)*grid%after(i) + decay(next)*grid%before(next), 700.0_wp))
                  weight = exp(-min(decay(next)*grid%before(next), 700.0_wp))
               else
                  rate = 0.5_wp*(decay(i) + decay(next))
                  if (takes_slower) rate = min(decay(i), decay(next))
                  exponent = max(rate, slowest_decay)*modulo(grid%angles(next) - grid%angles(i), two_pi)
                  left = exp(-min(exponent, 700.0_wp))
                  weight = (1.0_wp - left)/exponent
               end if
               values(next) = balance(next) + left*(values(i) - balance(i)) - weight*(balance(next) - balance(i))
            end do
         end do
      end do
   end subroutine delay

   !> Mean over the cycle.
   pure function mean_over(grid, values) result(mean)
      !> The angles
      type(grid_t), intent(in) :: grid
      !> Values at the angles [any]
      real(wp), intent(in) :: values(:)
      !> Their mean [any]
      real(wp) :: mean

      mean = sum(grid%weights*values)
   end function mean_over

   !> Difference of a mean over all angles from that over half of them, where each stands for its neighbour, too.
   pure function sampling_error(grid, values) result(error)
      !> The angles
      type(grid_t), intent(in) :: grid
      !> Values at the angles [any]
      real(wp), intent(in) :: values(:)
      !> The difference, the larger one of both halves [any]
      real(wp) :: error

      ! Differences between neighbours [any]
      real(wp) :: steps(points/2)

      steps = values(2::2) - values(1::2)
      error = max(abs(sum(grid%weights(1::2)*steps)), abs(sum(grid%weights(2::2)*steps)))
   end function sampling_error

end module camroller_effect_grid
