!> The periodic state of a flexible train: cycles from rest until one closes, or a few together do, or none will.
!>
!> In: model, tolerance. Out: `flexible_cycle_t` with the last cycle, from full lift of one turn less half a turn on. Plain cycles
!> approach the periodic state by the slowest decay of spring and adjuster, or drift towards it; Anderson's acceleration
!> extrapolates from the last few, but for turns that alternate: there a period of two may be near. An adjuster that leaks down is
!> moved on by many turns at once; one that climbs is not put back. Source: Walker and Ni, SIAM J. Numer. Anal. 49 (2011) 1715.
module camroller_flexible_cycle
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_ode_problem, only : counters_t
   use camroller_trajectory, only : trajectory_t
   use camroller_flexible_setup, only : rest_t, find_rest, seat_sink
   use camroller_flexible_train, only : resolution_t, state_size, at_finger, at_lift, at_plunger, at_pressure, at_sliding
   use camroller_flexible_problem, only : largest_sliding_scale
   use camroller_flexible_moves, only : is_possible, jump_leak, leak_t, may_stand, put_on_stop
   use camroller_flexible_turn, only : turn_t, set_sliding_tolerance, integrate_turn
   use camroller_lapack, only : dgesv, dgetrf
   implicit none
   private

   public :: flexible_cycle_t, history_t, find_periodic, find_period, extrapolate, is_alternating, rest_of_train

   !> Most cycles that make a period together
   integer, parameter, public :: longest_period = 8
   !> Cycles that acceleration mixes
   integer, parameter :: depth = 5
   !> Contraction above which acceleration pays, and number of turns that it needs: with fewer, trains whose check valve opens late
   !> in a turn take up to twice as many turns [-]
   real(wp), parameter :: slow = 0.1_wp
   integer, parameter :: least_kept = 3
   !> Part of a disturbance that comes back with the other sign above which turns alternate [-]
   real(wp), parameter :: alternating = 0.9_wp
   !> Turns before the last one that tell whether turns alternate
   integer, parameter :: compared_turns = 3
   !> Smallest size of the sliding speed to which its error is relative [m/s]
   real(wp), parameter, public :: least_sliding_scale = 1.0e-4_wp

   !> Turns from which the periodic state is extrapolated
   type :: history_t
      !> Their starts in units of the scales, shape (component, turn), the newest first [-]
      real(wp), allocatable :: starts(:, :)
      !> Their ends less their starts, in the same way [-]
      real(wp), allocatable :: residuals(:, :)
      !> How many there are
      integer :: kept = 0
   end type history_t

   !> The periodic state, or what was found in its stead
   type :: flexible_cycle_t
      !> The last cycle
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      !> Cycles integrated
      integer :: cycles = 0
      !> Cycles that make a period; 0 where there is none
      integer :: period = 0
      !> Largest part of a disturbance that a cycle was seen to leave; a period, where it is of several cycles [-]
      real(wp) :: multiplier = 0.0_wp
      !> Difference of a period's end from its start, in the units of the scales [-]
      real(wp) :: closure = 0.0_wp
      !> Tolerance of a step, in the same units [-]
      real(wp) :: tolerance = 0.0_wp
      !> What the last cycle did not tell apart, forces to round-off
      type(resolution_t) :: resolution
      !> The last cycles, up to this one
      type(history_t) :: history
   end type flexible_cycle_t

contains

   !> Rest of a train on the base circle: where the first cycle starts.
   subroutine rest_of_train(model, state, error)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), allocatable, intent(out) :: state(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(rest_t) :: rest

      allocate (state(state_size(model)))
      state = 0.0_wp
      if (model%flexible%lash > 0.0_wp) then
         state(at_finger) = model%linkage%base_angle
         state(at_lift) = -seat_sink(model%flexible, model%train)
         return
      end if
      call find_rest(model%flexible, model%linkage, model%train, model%base_circle_load, rest, error)
      if (allocated(error)) return
      state(at_finger) = rest%finger
      state(at_lift) = rest%lift
      if (.not. allocated(model%flexible%adjuster)) return
      state(at_plunger) = rest%pivot
      state(at_pressure) = model%flexible%adjuster%given%supply_pressure
   end subroutine rest_of_train

   !> Integrate turns until they repeat themselves, or as many as are allowed, or as many as take the steps allowed.
   subroutine find_periodic(cycle, turn, state, closure, max_cycles, error)
      !> The cycle
      type(flexible_cycle_t), intent(inout) :: cycle
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> In: where the first turn starts; out: where the last one ends [state]
      real(wp), intent(inout) :: state(:)
      !> Distance from the periodic state that is near enough, in units of the scales [-]
      real(wp), intent(in) :: closure
      !> Turns at most
      integer, intent(in) :: max_cycles
      !> Convergence error where a turn cannot be integrated
      type(error_t), allocatable, intent(out) :: error

      ! Ends of the last turns in units of the scales, the newest last; distance of end and start, the same of the turn before [-]
      real(wp) :: ends(size(state), 0:2*longest_period), distance, last_distance
      ! Start of a turn, its end less its start, where the periodic state should be, in units of the scales [-]
      real(wp), dimension(size(state)) :: start, residual, aim
      type(leak_t) :: leak
      integer :: turns, plain
      logical :: is_scaled, alternates, has_moved

      plain = 1
      last_distance = huge(1.0_wp)
      cycle%history%kept = 0
      ends(:, 2*longest_period) = state/turn%scales
      do turns = 1, max_cycles
         start = state
         cycle%resolution%sliding_speed = turn%problem%resolution%sliding_speed
         call integrate_turn(turn, state, cycle%trajectory, cycle%counters, error)
         cycle%cycles = cycle%cycles + 1
         if (allocated(error)) return
         call scale_sliding(turn, cycle%trajectory, is_scaled)
         residual = (state - start)/turn%scales
         start = start/turn%scales
         distance = maxval(abs(residual))
         if (is_scaled) cycle%history%kept = 0
         call remember(cycle%history, start, residual)
         alternates = is_alternating(cycle%history, closure)
         if (distance > last_distance) cycle%history%kept = 1
         if (turns > 1 .and. distance < last_distance) cycle%multiplier = merge(max(cycle%multiplier, distance/last_distance), &
            & distance/last_distance, cycle%history%kept > 1)
         call extrapolate(cycle%history, start, residual, aim)
         cycle%closure = distance
         if (max(distance, maxval(abs(aim - start))) <= closure .and. .not. (is_scaled .or. alternates)) then
            cycle%period = 1
            return
         end if
         ends(:, :) = reshape([ends(:, 1:), state/turn%scales], shape(ends))
         plain = plain + 1
         if (distance >= 10.0_wp*closure) call find_period(ends, min(longest_period, (plain - 1)/2), closure, cycle)
         if (cycle%period > 0) return
         ! What follows the search begins where a turn ended
         if (cycle%counters%accepted + cycle%counters%rejected > turn%most_search .or. turns == max_cycles) exit
         call move_on(leak, cycle%history, turn, residual, aim, distance > slow*last_distance .and. .not. alternates, &
            & state, has_moved)
         if (has_moved) plain = 0
         last_distance = distance
      end do
      cycle%resolution%sliding_speed = turn%problem%resolution%sliding_speed
   end subroutine find_periodic

   !> Move a train on from the end of a turn: where its adjuster leaks down, or to where the last turns say that the periodic state
   !> is.
   subroutine move_on(leak, history, turn, residual, aim, is_slow, state, has_moved)
      !> The turns before; out: with this one
      type(leak_t), intent(inout) :: leak
      !> The turns that extrapolation is made from
      type(history_t), intent(inout) :: history
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> End less start of this turn, in units of the scales [-]
      real(wp), intent(in) :: residual(:)
      !> What is extrapolated; changed where that is beyond a stop [-]
      real(wp), intent(inout) :: aim(:)
      !> Is it worth a move?
      logical, intent(in) :: is_slow
      !> In: end of the turn; out: start of the next [state]
      real(wp), intent(inout) :: state(:)
      !> Is it another one?
      logical, intent(out) :: has_moved

      call jump_leak(leak, turn, residual, state, has_moved)
      if (has_moved) then
         history%kept = 0
      else if (is_slow .and. history%kept >= least_kept) then
         call put_on_stop(turn, aim)
         has_moved = may_stand(turn, leak, state, aim) .and. is_possible(turn, aim)
         if (has_moved) then
            state = aim*turn%scales
         else
            history%kept = 1
         end if
      end if
   end subroutine move_on

   !> Do the last turns make a period of several? The difference from one period to the next, over that between the two before, is
   !> the part of a disturbance that a period leaves: what seems to repeat itself may approach a period slowly, or leave one. Where
   !> the one before was far from repeating itself it may be chance: the next will tell.
   pure subroutine find_period(ends, longest, closure, cycle)
      !> Ends of the last turns in units of the scales, shape (component, turn), the newest last [-]
      real(wp), intent(in) :: ends(:, :)
      !> Longest period that these turns can show twice
      integer, intent(in) :: longest
      !> Distance from the periodic state that is near enough, in units of the scales [-]
      real(wp), intent(in) :: closure
      !> Gets the period, where there is one, the difference of its end from its start, and what it leaves of a disturbance
      type(flexible_cycle_t), intent(inout) :: cycle

      ! Difference between two periods, over that which is near enough, above which the next is near by chance [-]
      real(wp), parameter :: chance = 2.0_wp
      ! Difference of a period's end from its start, the same of the period before [-]
      real(wp) :: distance, last_distance
      integer :: k

      associate (n => size(ends, 2))
         do k = 2, longest
            distance = maxval(abs(ends(:, n) - ends(:, n - k)))
            last_distance = max(maxval(abs(ends(:, n - k) - ends(:, n - 2*k))), tiny(1.0_wp))
            if (distance > closure*(1.0_wp - distance/last_distance) .or. last_distance > chance*closure) cycle
            cycle%closure = distance
            cycle%multiplier = distance/last_distance
            cycle%period = k
            return
         end do
      end associate
   end subroutine find_period

   !> Make errors of the sliding speed relative to its largest value, where that is small: friction follows it.
   pure subroutine scale_sliding(turn, trajectory, is_scaled)
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> A turn
      type(trajectory_t), intent(in) :: trajectory
      !> Has the scale changed?
      logical, intent(out) :: is_scaled

      ! Change that is worth a change of the scale [-]
      real(wp), parameter :: worth = 2.0_wp
      ! The scale as it should be and as it is [m/s]
      real(wp) :: scale, present

      present = turn%scales(at_sliding)
      scale = maxval(abs(trajectory%state(at_sliding, :trajectory%count)))
      scale = max(least_sliding_scale, min(scale, largest_sliding_scale))
      is_scaled = max(scale, present) > worth*min(scale, present)
      if (.not. is_scaled) return
      call set_sliding_tolerance(turn, turn%options%tolerance(at_sliding)*scale/present)
      turn%scales(at_sliding) = scale
   end subroutine scale_sliding

   !> Take a turn into the history.
   pure subroutine remember(history, start, residual)
      !> The last turns
      type(history_t), intent(inout) :: history
      !> Start of the turn, its end less its start, in units of the scales [-]
      real(wp), intent(in) :: start(:), residual(:)

      if (.not. allocated(history%starts)) allocate (history%starts(size(start), depth + 1), &
         & history%residuals(size(start), depth + 1), source=0.0_wp)
      history%starts(:, 2:) = history%starts(:, :depth)
      history%residuals(:, 2:) = history%residuals(:, :depth)
      history%starts(:, 1) = start
      history%residuals(:, 1) = residual
      history%kept = min(history%kept + 1, depth + 1)
   end subroutine remember

   !> Do disturbances come back with the other sign and nearly as large? The single cycle is then about to lose its stability to a
   !> period of two, or has lost it: extrapolation would find it all the same.
   !>
   !> How ends follow starts within the directions of the last turns is a small matrix `G`; where `G + share` has a negative
   !> determinant, one of its factors is below minus that share. Extrapolation takes what alternates out of the newest turn, so
   !> that one difference alone does not show it. Where `G` makes every difference smaller than that share none of its factors is
   !> below, whatever the sign of a determinant that rounding decides.
   pure function is_alternating(history, noise) result(verdict)
      !> The last turns
      type(history_t), intent(in) :: history
      !> Difference in a direction of its own from which on a turn is compared as well, in units of the scales [-]
      real(wp), intent(in) :: noise
      !> Do they?
      logical :: verdict

      ! Changes of the start from turn to turn, and of the end, in units of the scales [-]
      real(wp), dimension(size(history%starts, 1), compared_turns) :: starts, ends
      ! What of a change is not in the direction of the others and its end, unit vectors that span these and their ends [-]
      real(wp), dimension(size(starts, 1)) :: own, own_end
      real(wp), dimension(size(starts, 1), compared_turns) :: directions, images
      ! Part of the change in a direction [-]
      real(wp) :: part
      integer :: i, n

      verdict = .false.
      do i = 1, min(history%kept - 1, compared_turns)
         starts(:, i) = history%starts(:, i) - history%starts(:, i + 1)
         ends(:, i) = starts(:, i) + history%residuals(:, i) - history%residuals(:, i + 1)
      end do
      do n = 1, min(history%kept - 1, compared_turns)
         own = starts(:, n)
         own_end = ends(:, n)
         do i = 1, n - 1
            part = dot_product(own, directions(:, i))
            own = own - part*directions(:, i)
            own_end = own_end - part*images(:, i)
         end do
         if (n > 1 .and. maxval(abs(own)) < noise) exit
         directions(:, n) = own/max(norm2(own), tiny(1.0_wp))
         images(:, n) = own_end/max(norm2(own), tiny(1.0_wp))
         if (norm2(images(:, :n)) < alternating) cycle
         ! By the ends, in which what fades fast has done so
         associate (x => starts(:, :n), y => ends(:, :n))
            verdict = verdict .or. sign_of_determinant(matmul(transpose(y), y + alternating*x)) &
               & *sign_of_determinant(matmul(transpose(y), x)) < 0
         end associate
      end do
   end function is_alternating

   !> Sign of the determinant of a matrix.
   pure function sign_of_determinant(matrix) result(sign)
      !> The matrix [any]
      real(wp), intent(in) :: matrix(:, :)
      !> 1, -1, or 0 where it is singular
      integer :: sign

      ! Its triangular factors [any]
      real(wp) :: factors(size(matrix, 1), size(matrix, 2))
      integer :: pivots(size(matrix, 1)), info, i

      factors = matrix
      sign = 1
      call dgetrf(size(matrix, 1), size(matrix, 1), factors, size(matrix, 1), pivots, info)
      if (info /= 0) sign = 0
      do i = 1, size(matrix, 1)
         if (factors(i, i) < 0.0_wp .neqv. pivots(i) /= i) sign = -sign
      end do
   end function sign_of_determinant

   !> Where a turn and those before it say that the periodic state is, by Anderson's rule: a step of Newton's method as far as the
   !> last turns tell how their ends follow their starts, and the end of the turn in all other directions.
   subroutine extrapolate(history, start, residual, aim)
      !> The last turns
      type(history_t), intent(in) :: history
      !> Start of the turn, its end less its start, in units of the scales [-]
      real(wp), intent(in) :: start(:), residual(:)
      !> The periodic state, in the same units [-]
      real(wp), intent(out) :: aim(:)

      ! Normal equations [-], weights of the differences [-], differences of residuals [-]
      real(wp) :: normal(depth, depth), weights(depth, 1), differences(size(start), depth)
      integer :: pivots(depth), info, i

      aim = start + residual
      associate (n => history%kept - 1, starts => history%starts)
         if (n < 1) return
         do i = 1, n
            differences(:, i) = history%residuals(:, i) - history%residuals(:, i + 1)
         end do
         normal = 0.0_wp
         normal(:n, :n) = matmul(transpose(differences(:, :n)), differences(:, :n))
         do i = 1, n
            normal(i, i) = normal(i, i)*(1.0_wp + 1.0e-10_wp) + tiny(1.0_wp)
         end do
         weights(:n, 1) = matmul(transpose(differences(:, :n)), residual)
         call dgesv(n, 1, normal, depth, pivots, weights, depth, info)
         if (info /= 0) return
         do i = 1, n
            aim = aim - weights(i, 1)*(starts(:, i) - starts(:, i + 1) + differences(:, i))
         end do
      end associate
   end subroutine extrapolate

end module camroller_flexible_cycle
