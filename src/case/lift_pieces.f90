!> Pieces of the lift between its kinks, and the angles of a scan over them.
!>
!> In: model, two cam angles. Out: ends of the pieces, numbers of steps, angles one after the other; nothing is allocated for them.
module camroller_lift_pieces
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_model, only : model_t
   implicit none
   private

   public :: lift_stops_between, most_edges, find_edges, scan_steps, next_angle, sort

   !> Longest step of a scan [rad]
   real(wp), parameter :: longest_step = 0.25_wp*degree
   !> Least number of steps of a scan of a turn, shared out evenly between the pieces of the lift: an event may be shorter than a
   !> step
   integer, parameter :: least_steps = 256

contains

   !> Kinks of the lift from one angle up to another, which is left out.
   pure function lift_stops_between(model, start, finish) result(stops)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> The kinks, increasing [rad]
      real(wp), allocatable :: stops(:)

      ! Ends of the pieces [rad]
      real(wp) :: edges(most_edges(model, start, finish))
      integer :: count

      call find_edges(model, start, finish, edges, count)
      stops = edges(2:count - 1)
      if (any(.not. abs(modulo(model%lift_stops - start, two_pi)) > 0.0_wp)) stops = [start, stops]
   end function lift_stops_between

   !> Room for the ends of pieces of the lift.
   pure function most_edges(model, start, finish) result(room)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> Number of ends at most
      integer :: room

      room = 2 + size(model%lift_stops)*(1 + ceiling((finish - start)/two_pi))
   end function most_edges

   !> Ends of the pieces of the lift between two angles: these, and the kinks between them.
   pure subroutine find_edges(model, start, finish, edges, count)
      !> The model
      type(model_t), intent(in) :: model
      !> First and last angle, of any turn [rad]
      real(wp), intent(in) :: start, finish
      !> The ends, increasing [rad]
      real(wp), intent(out) :: edges(:)
      !> Their number
      integer, intent(out) :: count

      ! Kinks of the lift in the turn that begins at `start`, and in those after it [rad]
      real(wp) :: kinks(size(model%lift_stops))
      integer :: i

      edges(1) = start
      count = 1
      kinks = start + modulo(model%lift_stops - start, two_pi)
      call sort(kinks)
      do while (any(kinks < finish))
         do i = 1, size(kinks)
            if (.not. (kinks(i) > start .and. kinks(i) < finish)) cycle
            count = count + 1
            edges(count) = kinks(i)
         end do
         kinks = kinks + two_pi
      end do
      count = count + 1
      edges(count) = finish
   end subroutine find_edges

   !> Even steps of a scan in each piece of the lift, so many that no event is too short to be seen.
   pure function scan_steps(edges) result(steps)
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: edges(:)
      !> Number of steps of each
      integer :: steps(size(edges) - 1)

      integer :: least

      least = ceiling(least_steps*min(1.0_wp, (edges(size(edges)) - edges(1))/two_pi))
      steps = max(ceiling((edges(2:) - edges(:size(edges) - 1))/longest_step), 1 + least/size(edges))
   end function scan_steps

   !> Angle of a scan, the ends and every kink of the lift among them; rising numbers cost nothing.
   pure subroutine next_angle(edges, steps, place, angle)
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: edges(:)
      !> Number of steps of each
      integer, intent(in) :: steps(:)
      !> Piece and step in it of the angle before; out: of this one
      integer, intent(inout) :: place(2)
      !> The angle [rad]
      real(wp), intent(out) :: angle

      place(2) = place(2) + 1
      if (place(2) > steps(place(1))) place = [place(1) + 1, 1]
      associate (piece => place(1))
         angle = edges(piece + 1)
         if (place(2) < steps(piece)) angle = edges(piece) + (edges(piece + 1) - edges(piece))*place(2)/steps(piece)
      end associate
   end subroutine next_angle

   !> Sort a short list by insertion.
   pure subroutine sort(values)
      !> Numbers, in and out [any]
      real(wp), intent(inout) :: values(:)

      ! The one being placed [any]
      real(wp) :: value
      integer :: i, j

      do i = 2, size(values)
         value = values(i)
         j = i - 1
         do while (j >= 1)
            if (values(j) <= value) exit
            values(j + 1) = values(j)
            j = j - 1
         end do
         values(j + 1) = value
      end do
   end subroutine sort

end module camroller_lift_pieces
