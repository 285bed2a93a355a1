!> Pieces of the lift between its kinks, and the angles of a scan over them.
!>
!> In: model, two cam angles. Out: ends of the pieces, angles one after the other.
module camroller_lift_pieces
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_model, only : model_t
   use camroller_sorting, only : sort
   implicit none
   private

   public :: find_edges, kinks_passed, scan_t, start_scan, has_next, next_angle, leave_rest

   !> Place in a scan of the pieces of the lift
   type :: scan_t
      !> Piece, and step in it, of the angle reached
      integer :: piece = 1, step = 0
      !> Steps of the piece; least number of steps of any piece
      integer :: steps = 0, least = 0
   end type scan_t

   !> Longest step of a scan [rad]
   real(wp), parameter :: longest_step = 0.25_wp*degree
   !> Least number of steps of a scan of a turn, shared out evenly between the pieces of the lift: an event may be shorter than a
   !> step
   integer, parameter :: least_steps = 256

contains

   !> Ends of the pieces of the lift between two angles: these, and the kinks between them.
   pure subroutine find_edges(model, start, finish, edges)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> The ends, increasing; allocated again only where their number is another [rad]
      real(wp), allocatable, intent(inout) :: edges(:)

      integer :: count, found

      count = 0
      call take_kinks(model, start, finish, count)
      if (allocated(edges)) then
         if (size(edges) /= 2 + count) deallocate (edges)
      end if
      if (.not. allocated(edges)) allocate (edges(2 + count))
      edges(1) = start
      edges(2 + count) = finish
      if (count == 0) return
      found = 0
      call take_kinks(model, start, finish, found, edges(2:1 + count))
      call sort(edges(2:1 + count))
   end subroutine find_edges

   !> Kinks of the lift strictly between two angles.
   pure subroutine take_kinks(model, start, finish, count, kinks)
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> In: zero; out: their number
      integer, intent(inout) :: count
      !> The kinks, in no order [rad]
      real(wp), intent(inout), optional :: kinks(:)

      ! A kink, turn after turn [rad]
      real(wp) :: kink
      integer :: i

      do i = 1, size(model%lift_stops)
         kink = start + modulo(model%lift_stops(i) - start, two_pi)
         do while (kink < finish)
            if (kink > start) then
               count = count + 1
               if (present(kinks)) kinks(count) = kink
            end if
            kink = kink + two_pi
         end do
      end do
   end subroutine take_kinks

   !> Kinks of the lift that a cam angle has passed, with the part of the way to the next one: a whole number at each.
   pure function kinks_passed(model, angle) result(passed)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift, of any turn [rad]
      real(wp), intent(in) :: angle
      !> How many from any one on; 0.5 where the lift has none [-]
      real(wp) :: passed

      ! Whole turns from the first kink on [-]; the angle within a turn from there, next kink [rad]
      real(wp) :: turns, inside, next
      integer :: i

      passed = 0.5_wp
      associate (stops => model%lift_stops, n => size(model%lift_stops))
         if (n == 0) return
         turns = real(floor((angle - stops(1))/two_pi), wp)
         inside = angle - two_pi*turns
         i = max(1, count(stops <= inside))
         next = stops(1) + two_pi
         if (i < n) next = stops(i + 1)
         passed = n*turns + (i - 1) + (inside - stops(i))/(next - stops(i))
      end associate
   end function kinks_passed

   !> Begin a scan: even steps in each piece of the lift, so many that no event is too short to be seen.
   pure subroutine start_scan(scan, edges)
      !> The scan
      type(scan_t), intent(out) :: scan
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: edges(:)

      scan%least = 1 + ceiling(least_steps*min(1.0_wp, (edges(size(edges)) - edges(1))/two_pi))/size(edges)
      scan%steps = steps_of(scan, edges(1:2))
   end subroutine start_scan

   !> Number of steps of a piece.
   pure function steps_of(scan, ends) result(steps)
      type(scan_t), intent(in) :: scan
      !> Its ends [rad]
      real(wp), intent(in) :: ends(2)
      !> The number
      integer :: steps

      steps = max(ceiling((ends(2) - ends(1))/longest_step), scan%least)
   end function steps_of

   !> Does a scan go on?
   pure function has_next(scan, edges) result(verdict)
      !> The scan
      type(scan_t), intent(in) :: scan
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: edges(:)
      !> Does it?
      logical :: verdict

      verdict = scan%piece < size(edges) - 1 .or. scan%step < scan%steps
   end function has_next

   !> Next angle of a scan, after its start, the ends and every kink of the lift among them.
   pure subroutine next_angle(scan, edges, angle)
      !> The scan, which goes on
      type(scan_t), intent(inout) :: scan
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: edges(:)
      !> The angle [rad]
      real(wp), intent(out) :: angle

      scan%step = scan%step + 1
      if (scan%step > scan%steps) then
         scan%piece = scan%piece + 1
         scan%step = 1
         scan%steps = steps_of(scan, edges(scan%piece:scan%piece + 1))
      end if
      associate (piece => scan%piece)
         angle = edges(piece + 1)
         if (scan%step < scan%steps) angle = edges(piece) + (edges(piece + 1) - edges(piece))*scan%step/scan%steps
      end associate
   end subroutine next_angle

   !> Leave out what remains of a rest of the valve, whose ends are kinks: all angles of the piece but its last two.
   pure subroutine leave_rest(scan)
      !> The scan, which has reached two angles of the rest
      type(scan_t), intent(inout) :: scan

      if (scan%step < scan%steps) scan%step = max(scan%step, scan%steps - 2)
   end subroutine leave_rest

end module camroller_lift_pieces
