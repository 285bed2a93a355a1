!> What is said about a deck before its cases are computed.
!>
!> In: a deck. Out: remarks on the error unit.
module camroller_deck_notes
   use camroller_deck, only : deck_t
   use camroller_deck_remarks, only : list_deck_remarks
   use camroller_mistakes, only : line_t
   use camroller_streams, only : tell
   implicit none
   private

   public :: tell_deck_remarks

contains

   !> Show remarks on the numbers of a deck.
   subroutine tell_deck_remarks(deck)
      !> The deck
      type(deck_t), intent(in) :: deck

      type(line_t), allocatable :: remarks(:)
      integer :: i

      call list_deck_remarks(deck, remarks)
      do i = 1, size(remarks)
         call tell("remark: "//remarks(i)%text//new_line("a"))
      end do
   end subroutine tell_deck_remarks

end module camroller_deck_notes
