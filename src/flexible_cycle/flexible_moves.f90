!> Starts of turns that are not the end of one: where may a train be moved on to, and how does a search come back from there?
!>
!> In: the last turns. Out: another state, and whether it may be one. An adjuster that leaks down is moved on by many turns at once;
!> one that climbs is never put back.
module camroller_flexible_moves
   use camroller_kinds, only : wp
   use camroller_flexible_train, only : at_plunger
   use camroller_flexible_turn, only : turn_t
   implicit none
   private

   public :: moves_t, note_change, climbs, jump_leak, go_back, put_on_stop, may_stand, is_possible

   !> Turns that a move needs: with fewer, trains whose check valve opens late in a turn take up to twice as many turns
   integer, parameter, public :: least_kept = 3
   !> Turns in which a plunger has to fall before it is moved on; as many are followed one by one after a move that failed
   integer, parameter :: leaking_turns = 8
   !> Mean change of its place in a turn over their root mean square, from which on it moves one way: trains without a period seldom
   !> have as much by chance [-]
   real(wp), parameter :: steady = 0.7_wp
   !> Turns by which it is moved on, the next time by twice as many; where that is too many the check valve fills the adjuster
   !> within a turn [-]
   real(wp), parameter :: jumped_turns = 32.0_wp

   !> The last turns, by which a train is moved on to a state that is not the end of one
   type :: moves_t
      !> How many there are
      integer :: turns = 0
      !> By how many of them a plunger that leaks down would be moved on [-]
      real(wp) :: jump = jumped_turns
      !> Their ends less their starts in units of the scales, shape (component, turn), the newest first [-]
      real(wp), allocatable :: changes(:, :)
      !> End of the last turn before the last move, as far as there is one [state]
      real(wp), allocatable :: before(:)
      !> Turns that have to be followed before the next move
      integer :: waiting = 0
   end type moves_t

contains

   !> Take what a turn has changed into the last turns, where there is an adjuster.
   pure subroutine note_change(moves, turn, residual)
      !> The last turns
      type(moves_t), intent(inout) :: moves
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> End less start of the turn, in units of the scales [-]
      real(wp), intent(in) :: residual(:)

      if (.not. allocated(turn%problem%model%flexible%adjuster)) return
      if (.not. allocated(moves%changes)) allocate (moves%changes(size(residual), leaking_turns), source=0.0_wp)
      moves%changes(:, 2:) = moves%changes(:, :leaking_turns - 1)
      moves%changes(:, 1) = residual
      moves%turns = moves%turns + 1
   end subroutine note_change

   !> Does the plunger rise turn after turn?
   pure function climbs(moves) result(verdict)
      !> The last turns
      type(moves_t), intent(in) :: moves
      !> Does it?
      logical :: verdict

      verdict = .false.
      associate (n => min(moves%turns, leaking_turns))
         if (n < least_kept) return
         verdict = sum(moves%changes(at_plunger, :n))/n > steady*norm2(moves%changes(at_plunger, :n))/sqrt(real(n, wp))
      end associate
   end function climbs

   !> Move a train on by many turns where its adjuster leaks down by nearly as much each turn; vibration is left out by the mean.
   subroutine jump_leak(moves, turn, state, has_jumped)
      !> The last turns; out: none of them where it has jumped
      type(moves_t), intent(inout) :: moves
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> In: end of the turn; out: start of the next [state]
      real(wp), intent(inout) :: state(:)
      !> Is it another one?
      logical, intent(out) :: has_jumped

      ! The state after the leak, mean change of a turn, in units of the scales [-]
      real(wp), dimension(size(state)) :: aim, change

      has_jumped = .false.
      if (moves%turns < leaking_turns) return
      change = sum(moves%changes, 2)/leaking_turns
      if (change(at_plunger) > -steady*norm2(moves%changes(at_plunger, :))/sqrt(real(leaking_turns, wp))) return
      aim = state/turn%scales + moves%jump*change
      call put_on_stop(turn, aim)
      moves%turns = 0
      if (.not. is_possible(turn, aim)) return
      state = aim*turn%scales
      moves%jump = 2.0_wp*moves%jump
      has_jumped = .true.
   end subroutine jump_leak

   !> Go back to where the last move was made, and follow the turns from there.
   pure subroutine go_back(moves, state)
      !> The moves
      type(moves_t), intent(inout) :: moves
      !> Start of the next turn [state]
      real(wp), intent(out) :: state(:)

      state = moves%before
      deallocate (moves%before)
      moves%turns = 0
      moves%jump = jumped_turns
      moves%waiting = leaking_turns
   end subroutine go_back

   !> Put a plunger that a mixture of states has far below its lower stop on it: the stop would throw it back with more than all
   !> forces of a train.
   pure subroutine put_on_stop(turn, aim)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> The state at the start of a turn, in units of the scales [-]
      real(wp), intent(inout) :: aim(:)

      ! Way beyond the stop that is far, over the plunger's travel [-]
      real(wp), parameter :: far = 0.05_wp

      if (.not. allocated(turn%problem%model%flexible%adjuster)) return
      associate (given => turn%problem%model%flexible%adjuster%given, place => aim(at_plunger), scale => turn%scales(at_plunger))
         if (scale*place < given%lowest - far*(given%highest - given%lowest)) place = given%lowest/scale
      end associate
   end subroutine put_on_stop

   !> May a plunger stand where extrapolation puts it? Not farther beyond its upper stop than a turn has left it: it would press the
   !> stop with oil that no turn has brought in, and which takes thousands of turns to leak out. Where it climbs it pumps up, and
   !> would have to climb again from below; and it may come half as near to the stop at most, of which turns below it tell nothing.
   pure function may_stand(turn, ending, aim, is_climbing) result(verdict)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> End of the turn [state]; what is extrapolated, in units of the scales [-]
      real(wp), intent(in) :: ending(:), aim(:)
      !> Does the plunger climb?
      logical, intent(in) :: is_climbing
      !> May it?
      logical :: verdict

      real(wp) :: place ! Of the plunger [m]

      verdict = .true.
      if (.not. allocated(turn%problem%model%flexible%adjuster)) return
      place = turn%scales(at_plunger)*aim(at_plunger)
      associate (highest => turn%problem%model%flexible%adjuster%given%highest, present => ending(at_plunger))
         if (is_climbing) then
            verdict = place >= present .and. place <= 0.5_wp*(present + highest)
         else
            verdict = place <= max(highest, present)
         end if
      end associate
   end function may_stand

   !> Can a train be in a state? A mixture of states need not be one.
   function is_possible(turn, aim) result(verdict)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> The state at the start of a turn, in units of the scales [-]
      real(wp), intent(in) :: aim(:)
      !> Can it?
      logical :: verdict

      ! Rate there [state/rad]
      real(wp) :: rate(size(aim))
      integer :: status

      call turn%problem%get_rate(turn%stops(1), aim*turn%scales, rate, status)
      verdict = status == 0
   end function is_possible

end module camroller_flexible_moves
