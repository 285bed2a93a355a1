!> The case of a deck in a file.
module deck_cases
   use camroller_case, only : case_t
   use camroller_deck, only : add_override, deck_t, make_case, make_sweep_case, override_t, read_deck
   use camroller_error, only : error_t
   implicit none
   private

   public :: get_deck_case

contains

   !> Read a deck and make its case.
   subroutine get_deck_case(path, case, failure, words, number)
      !> Path of the deck from the top folder
      character(len=*), intent(in) :: path
      !> The case
      type(case_t), intent(out) :: case
      !> Deck or file error
      type(error_t), allocatable, intent(out) :: failure
      !> `group.key=value`, given on top of the deck
      character(len=*), intent(in), optional :: words
      !> Number of the case in the deck's sweep, from 1; the operating point of the deck without it
      integer, intent(in), optional :: number

      type(deck_t) :: deck
      type(override_t), allocatable :: overrides(:)
      type(override_t) :: none(0)

      allocate (overrides(0))
      if (present(words)) call add_override(overrides, words)
      call read_deck(deck, path, overrides, failure)
      if (allocated(failure)) return
      if (present(number)) then
         call make_sweep_case(deck, number, case, failure)
      else
         call make_case(deck, none, case, failure)
      end if
   end subroutine get_deck_case

end module deck_cases
