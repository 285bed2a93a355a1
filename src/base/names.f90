!> Choices by name: find a name in a list of known names, or report the known ones.
!>
!> Each module with a family of laws keeps the list of its names beside the laws; decks and library users choose by name, inner
!> loops by the index found here.
module camroller_names
   use camroller_error, only : error_t, raise, kind_deck
   implicit none
   private

   public :: name_length, are_same, index_of_name, find_name, write_names

   !> Length of every name of a choice
   integer, parameter :: name_length = 32

contains

   !> Are two names the same? As by `==`, which takes blanks behind the shorter one letter by letter.
   pure function are_same(one, other) result(verdict)
      !> The names
      character(len=*), intent(in) :: one, other
      !> Are they?
      logical :: verdict

      integer :: length

      length = len_trim(one)
      verdict = length == len_trim(other)
      if (verdict) verdict = one(:length) == other(:length)
   end function are_same

   !> Position of a name in a list, 0 where it is not in it.
   pure function index_of_name(name, known) result(position)
      !> The name looked for
      character(len=*), intent(in) :: name
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> Position in `known`, 0 where unknown
      integer :: position

      do position = 1, size(known)
         if (name == known(position)) return
      end do
      position = 0
   end function index_of_name

   !> Position of a name in a list; an error that lists the known names where it is not in it.
   subroutine find_name(what, name, known, position, error)
      !> What is chosen, for the message, e.g. `film law`
      character(len=*), intent(in) :: what
      !> The name looked for
      character(len=*), intent(in) :: name
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> Position in `known`, 0 where unknown
      integer, intent(out) :: position
      !> Deck error where the name is unknown
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: names

      position = index_of_name(name, known)
      if (position > 0) return
      call write_names(known, names)
      call raise(error, kind_deck, "unknown "//what//" '"//trim(name)//"'; known are "//names)
   end subroutine find_name

   !> The names of a list, quoted and separated by commas.
   pure subroutine write_names(known, text)
      !> The known names
      character(len=*), intent(in) :: known(:)
      !> One line of text
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ""
      do i = 1, size(known)
         if (i > 1) text = text//", "
         text = text//"'"//trim(known(i))//"'"
      end do
   end subroutine write_names

end module camroller_names
