!> Angles of tables that a deck names: what to ask where they look like those of something else than a cam in degrees.
!>
!> In: a length over the angle. Out: a question.
module camroller_deck_table_angles
   use camroller_kinds, only : wp, degree
   implicit none
   private

   public :: ask_angles, ask_crank, usual_event

   !> Usual lengths of an event [deg of cam angle]
   real(wp), parameter :: usual_event(2) = [60.0_wp, 220.0_wp]
   !> What to ask of angles that are too many for a cam
   character(len=*), parameter :: ask_crank = "; is the angle that of the crankshaft? A table takes the cam's, half of it"

contains

   !> What to ask where a table, or its event, is longer than a turn, or as long in radians as it would be in degrees for a cam: an
   !> event or more, a turn at most.
   pure subroutine ask_angles(length, words)
      !> Its length [deg]
      real(wp), intent(in) :: length
      !> The question; empty where there is nothing to ask
      character(len=:), allocatable, intent(out) :: words

      ! A turn with rounding [rad]
      real(wp), parameter :: turn = 6.3_wp

      words = ""
      if (length > 360.0_wp) words = ask_crank
      if (length >= usual_event(1)*degree .and. length <= turn) words = "; are the angles in radians? A table takes degrees"
   end subroutine ask_angles

end module camroller_deck_table_angles
