!> Tests that decks can be read by many threads at once: each thread gets what one thread alone gets.
module test_deck_threads
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use deck_samples, only : changed_deck, parse_sample
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, make_sweep_case
   use camroller_deck_document, only : write_resolved
   use camroller_deck_sweep, only : case_in_words, sweep_size
   implicit none
   private

   public :: collect_deck_threads

   integer, parameter :: threads = 64, repeats = 25
   character(len=*), parameter :: n = new_line("a")

   !> A text that may not be there
   type :: text_t
      character(len=:), allocatable :: text
   end type text_t

contains

   subroutine collect_deck_threads(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("decks read by 64 threads at once are read as by one", read_side_by_side)]
   end subroutine collect_deck_threads

   !> Decks of every kind: right ones, with a sweep, and with mistakes of many sorts, which leave most to be undone.
   subroutine read_side_by_side(error)
      type(error_type), allocatable, intent(out) :: error

      type(text_t) :: decks(6), alone(size(decks)), found
      integer :: i, deck, differences

      call write_decks(decks)
      do deck = 1, size(decks)
         call read_one(decks(deck)%text, alone(deck)%text)
      end do
      differences = 0
      !$omp parallel do num_threads(threads) private(deck, found) reduction(+:differences) schedule(static, 1)
      do i = 1, threads*repeats
         deck = 1 + modulo(i + i/threads, size(decks))
         call read_one(decks(deck)%text, found%text)
         if (found%text /= alone(deck)%text .or. len(found%text) /= len(alone(deck)%text)) differences = differences + 1
      end do
      !$omp end parallel do
      call check(error, differences, 0, "decks read beside others come out differently")
      if (allocated(error)) return
      call check(error, index(alone(6)%text, "did you mean") > 0, "the deck with mistakes has none")
   end subroutine read_side_by_side

   !> The decks.
   subroutine write_decks(decks)
      !> Their texts
      type(text_t), intent(out) :: decks(6)

      decks(1)%text = changed_deck("", "&asperity density_per_mm2 = 5000 summit_radius_um = 4 summit_deviation_um = 0.1 /")
      decks(2)%text = changed_deck("", "&sweep kind = 'latin_hypercube' cases = 5 key_1 = 'lubricant.viscosity_Pa_s' "// &
         & "from_1 = 0.01 to_1 = 0.1 key_2 = 'film.law' values_2 = 'moes', 'pan_hamrock' /")
      decks(3)%text = changed_deck("speed_rpm = 600", "speed_rpm = 6oo")
      decks(4)%text = changed_deck("exponents = 4", "exponents = 4, 3*6., 1e, 5")
      decks(5)%text = changed_deck("&spring", "&sprung")
      decks(6)%text = changed_deck("mass_kg = 0.0088", "mas_kg = .true.")//"&film law = 'moess' /"//n//"&case title = 3 /"//n
   end subroutine write_decks

   !> Everything that a deck comes to in words: its mistakes, or its values and its cases.
   subroutine read_one(text, words)
      !> The deck
      character(len=*), intent(in) :: text
      !> The words
      character(len=:), allocatable, intent(out) :: words

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(case_t) :: case
      integer :: i

      call parse_sample(text, deck, raised)
      if (allocated(raised)) then
         words = raised%message
         return
      end if
      call write_resolved(deck, words)
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, raised)
         words = words//case_in_words(deck%sweep, i)
         if (allocated(raised)) words = words//raised%message
      end do
   end subroutine read_one

end module test_deck_threads
