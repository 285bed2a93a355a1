!> Records of 64-bit words: numbers, integers and texts written one after the other, and read in the same order.
!>
!> In: values. Out: words with a checksum by which an incomplete record is recognised. Numbers keep every bit.
module camroller_record
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   implicit none
   private

   public :: record_t, clear_record, put_integer, put_numbers, put_text, take_integer, take_numbers, take_text
   public :: set_integer, checksum, text_words

   !> Letters of a word
   integer, parameter :: letters_of_word = 8
   !> Last 32 bits; multipliers of the two halves of a checksum, odd and without a pattern
   integer(int64), parameter :: low_32 = 4294967295_int64, multipliers(2) = [16777619_int64, 22695477_int64]

   !> A record
   type :: record_t
      !> Its words, with room behind them
      integer(int64), allocatable :: words(:)
      !> Words in use
      integer(int64) :: length = 0
      !> Words taken out so far
      integer(int64) :: position = 0
      !> Was more taken than there is?
      logical :: is_short = .false.
   end type record_t

contains

   !> Empty a record; its room stays.
   pure subroutine clear_record(record)
      !> The record
      type(record_t), intent(inout) :: record

      if (.not. allocated(record%words)) allocate (record%words(1024))
      record%length = 0
      record%position = 0
      record%is_short = .false.
   end subroutine clear_record

   !> Make room for more words.
   pure subroutine make_room(record, more)
      type(record_t), intent(inout) :: record
      !> How many
      integer, intent(in) :: more

      integer(int64), allocatable :: longer(:)

      if (.not. allocated(record%words)) allocate (record%words(1024))
      if (record%length + more <= size(record%words, kind=int64)) return
      allocate (longer(max(2*size(record%words, kind=int64), record%length + more)))
      longer(:record%length) = record%words(:record%length)
      call move_alloc(longer, record%words)
   end subroutine make_room

   !> Put an integer in.
   pure subroutine put_integer(record, number)
      !> The record
      type(record_t), intent(inout) :: record
      !> The integer
      integer, intent(in) :: number

      call make_room(record, 1)
      record%length = record%length + 1
      record%words(record%length) = number
   end subroutine put_integer

   !> Change an integer that was put in.
   pure subroutine set_integer(record, place, number)
      !> The record
      type(record_t), intent(inout) :: record
      !> Its index among the words, from 1
      integer, intent(in) :: place
      !> The integer
      integer, intent(in) :: number

      record%words(place) = number
   end subroutine set_integer

   !> Put numbers in; how many is up to who takes them out.
   pure subroutine put_numbers(record, numbers)
      !> The record
      type(record_t), intent(inout) :: record
      !> The numbers [any unit]
      real(wp), intent(in) :: numbers(:)

      integer :: i

      call make_room(record, size(numbers))
      do i = 1, size(numbers)
         record%words(record%length + i) = transfer(numbers(i), 0_int64)
      end do
      record%length = record%length + size(numbers)
   end subroutine put_numbers

   !> Put a text in.
   pure subroutine put_text(record, text)
      !> The record
      type(record_t), intent(inout) :: record
      !> The text
      character(len=*), intent(in) :: text

      integer :: words

      call put_integer(record, len(text))
      words = (len(text) + letters_of_word - 1)/letters_of_word
      call make_room(record, words)
      record%words(record%length + 1:record%length + words) = text_words(text)
      record%length = record%length + words
   end subroutine put_text

   !> Letters of a text as words.
   pure function text_words(text) result(words)
      !> The text
      character(len=*), intent(in) :: text
      !> The words
      integer(int64) :: words((len(text) + letters_of_word - 1)/letters_of_word)

      character(len=letters_of_word) :: letters
      integer :: i

      do i = 1, size(words)
         letters = text(letters_of_word*(i - 1) + 1:min(len(text), letters_of_word*i))
         words(i) = transfer(letters, 0_int64)
      end do
   end function text_words

   !> Take the next integer.
   pure subroutine take_integer(record, number)
      !> The record
      type(record_t), intent(inout) :: record
      !> The integer; 0 where there is none
      integer, intent(out) :: number

      number = 0
      if (record%position + 1 > record%length) then
         record%is_short = .true.
         return
      end if
      record%position = record%position + 1
      number = int(record%words(record%position))
   end subroutine take_integer

   !> Take the next numbers.
   pure subroutine take_numbers(record, numbers)
      !> The record
      type(record_t), intent(inout) :: record
      !> The numbers; zero where there are none [any unit]
      real(wp), intent(out) :: numbers(:)

      integer :: i

      if (record%position + size(numbers) > record%length) then
         numbers = 0.0_wp
         record%is_short = .true.
         return
      end if
      do i = 1, size(numbers)
         numbers(i) = transfer(record%words(record%position + i), 0.0_wp)
      end do
      record%position = record%position + size(numbers)
   end subroutine take_numbers

   !> Take the next text.
   pure subroutine take_text(record, text)
      !> The record
      type(record_t), intent(inout) :: record
      !> The text
      character(len=:), allocatable, intent(out) :: text

      character(len=letters_of_word) :: letters
      integer :: length, words, i

      text = ""
      call take_integer(record, length)
      words = (length + letters_of_word - 1)/letters_of_word
      if (length < 0 .or. record%position + words > record%length) then
         record%is_short = .true.
         return
      end if
      text = repeat(" ", length)
      do i = 1, words
         letters = transfer(record%words(record%position + i), letters)
         text(letters_of_word*(i - 1) + 1:min(length, letters_of_word*i)) = letters
      end do
      record%position = record%position + words
   end subroutine take_text

   !> Checksum of words: two hashes of 32 bits by multiplication, in arithmetic that cannot overflow.
   pure function checksum(words, start) result(sum)
      !> The words
      integer(int64), intent(in) :: words(:)
      !> Checksum of what stands before them, 0 for nothing
      integer(int64), intent(in) :: start
      !> Checksum, never 0
      integer(int64) :: sum

      integer(int64) :: halves(2), low, high
      integer :: i

      halves = [iand(start, low_32), iand(shiftr(start, 32), low_32)]
      do i = 1, size(words)
         low = iand(words(i), low_32)
         high = shiftr(words(i), 32)
         halves(1) = iand(ieor(iand(ieor(halves(1), low)*multipliers(1), low_32), high)*multipliers(1), low_32)
         halves(2) = iand(ieor(iand(ieor(halves(2), high)*multipliers(2), low_32), low)*multipliers(2) + i, low_32)
         halves = ieor(halves, shiftr(halves, 15))
      end do
      sum = ior(halves(1), shiftl(halves(2), 32))
      if (sum == 0) sum = 1
   end function checksum

end module camroller_record
