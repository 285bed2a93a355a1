!> Starts of turns that are not the end of one: where may a train be moved on to?
!>
!> In: the last turns. Out: another state, and whether it may be one. An adjuster that leaks down is moved on by many turns at once;
!> one that climbs is never put back.
module camroller_flexible_moves
   use camroller_kinds, only : wp
   use camroller_flexible_train, only : at_plunger
   use camroller_flexible_turn, only : turn_t
   implicit none
   private

   public :: leak_t, jump_leak, put_on_stop, may_stand, is_possible

   !> Turns in which a plunger has to fall before it is moved on
   integer, parameter :: leaking_turns = 8
   !> Turns from which on it is seen to climb
   integer, parameter :: climbing_turns = 3
   !> Mean change of its place in a turn over their root mean square, from which on it moves one way: trains without a period seldom
   !> have as much by chance [-]
   real(wp), parameter :: steady = 0.7_wp
   !> Turns by which it is moved on, the next time by twice as many; where that is too many the check valve fills the adjuster
   !> within a turn [-]
   real(wp), parameter :: jumped_turns = 32.0_wp

   !> The last turns of an adjuster that may be leaking down or climbing
   type :: leak_t
      !> How many there are
      integer :: turns = 0
      !> By how many of them the plunger would be moved on [-]
      real(wp) :: jump = jumped_turns
      !> Their ends less their starts in units of the scales, shape (component, turn), the newest first [-]
      real(wp), allocatable :: changes(:, :)
   end type leak_t

contains

   !> Move a train on by many turns where its adjuster leaks down by nearly as much each turn; vibration is left out by the mean.
   subroutine jump_leak(leak, turn, residual, state, has_jumped)
      !> The turns before; out: with this one, or none where it has jumped
      type(leak_t), intent(inout) :: leak
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> End less start of this turn, in units of the scales [-]
      real(wp), intent(in) :: residual(:)
      !> In: end of the turn; out: start of the next [state]
      real(wp), intent(inout) :: state(:)
      !> Is it another one?
      logical, intent(out) :: has_jumped

      ! The state after the leak, mean change of a turn, in units of the scales [-]
      real(wp), dimension(size(state)) :: aim, change

      has_jumped = .false.
      if (.not. allocated(turn%problem%model%flexible%adjuster)) return
      if (.not. allocated(leak%changes)) allocate (leak%changes(size(state), leaking_turns), source=0.0_wp)
      leak%changes(:, 2:) = leak%changes(:, :leaking_turns - 1)
      leak%changes(:, 1) = residual
      leak%turns = leak%turns + 1
      if (leak%turns < leaking_turns) return
      change = sum(leak%changes, 2)/leaking_turns
      if (change(at_plunger) > -steady*norm2(leak%changes(at_plunger, :))/sqrt(real(leaking_turns, wp))) return
      aim = state/turn%scales + leak%jump*change
      call put_on_stop(turn, aim)
      leak%turns = 0
      if (.not. is_possible(turn, aim)) return
      state = aim*turn%scales
      leak%jump = 2.0_wp*leak%jump
      has_jumped = .true.
   end subroutine jump_leak

   !> Does the plunger rise turn after turn?
   pure function climbs(leak) result(verdict)
      !> The last turns; none where there is no adjuster
      type(leak_t), intent(in) :: leak
      !> Does it?
      logical :: verdict

      verdict = .false.
      associate (n => min(leak%turns, leaking_turns))
         if (n < climbing_turns) return
         verdict = sum(leak%changes(at_plunger, :n))/n > steady*norm2(leak%changes(at_plunger, :n))/sqrt(real(n, wp))
      end associate
   end function climbs

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

   !> May a plunger stand where extrapolation puts it? Where it climbs it pumps up, and would have to climb again from below; and it
   !> may come half as near to its upper stop at most, of which turns below it tell nothing: beyond, it would press the stop with
   !> oil that no turn has brought in, and which takes thousands of turns to leak out.
   pure function may_stand(turn, leak, ending, aim) result(verdict)
      !> What integrates
      type(turn_t), intent(in) :: turn
      !> The last turns
      type(leak_t), intent(in) :: leak
      !> End of the turn [state]; what is extrapolated, in units of the scales [-]
      real(wp), intent(in) :: ending(:), aim(:)
      !> May it?
      logical :: verdict

      real(wp) :: place ! Of the plunger [m]

      verdict = .true.
      if (.not. climbs(leak)) return
      place = turn%scales(at_plunger)*aim(at_plunger)
      associate (highest => turn%problem%model%flexible%adjuster%given%highest, present => ending(at_plunger))
         verdict = place >= present .and. place <= 0.5_wp*(present + highest)
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
