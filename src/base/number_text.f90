!> Numbers as text: the shortest text for a number, and whether a text is a number at all.
!>
!> Layer: io. In: numbers or words. Out: words or verdicts.
module camroller_number_text
   use camroller_kinds, only : wp
   implicit none
   private

   public :: number_text, integer_text, is_number, is_beyond_range

   !> Powers of ten between which a number is written without an exponent
   integer, parameter :: smallest_plain = -4, largest_plain = 7
   !> Digits that tell any two numbers apart
   integer, parameter :: all_digits = 17

contains

   !> A number with as few digits as give it back, or rounded to a number of digits.
   pure function number_text(value, digits) result(text)
      !> A finite number [any unit]
      real(wp), intent(in) :: value
      !> Digits to round to; without it as many as are needed
      integer, intent(in), optional :: digits
      !> The number as text
      character(len=:), allocatable :: text

      !> The number read back [any unit]
      real(wp) :: again
      character(len=32) :: buffer, edit
      integer :: n, first, last

      last = all_digits
      if (present(digits)) last = digits
      first = 1
      if (present(digits)) first = digits
      do n = first, last
         write (edit, '(a, i0, a, i0, a)') "(es", n + 9, ".", n - 1, "e3)"
         write (buffer, edit) value
         read (buffer, *) again
         if (.not. abs(again - value) > 0.0_wp) exit
      end do
      text = plain_text(trim(adjustl(buffer)))
   end function number_text

   !> Rewrite `-d.ddddE+xxx` without needless digits.
   pure function plain_text(scientific) result(text)
      !> Number in scientific form
      character(len=*), intent(in) :: scientific
      !> The same, as people write it
      character(len=:), allocatable :: text

      character(len=:), allocatable :: digits, sign
      character(len=8) :: exponent_text
      integer :: mark, exponent, i

      mark = index(scientific, "E")
      read (scientific(mark + 1:), *) exponent
      digits = ""
      sign = ""
      do i = 1, mark - 1
         if (scientific(i:i) == "-") sign = "-"
         if (index("0123456789", scientific(i:i)) > 0) digits = digits//scientific(i:i)
      end do
      do while (len(digits) > 1)
         if (digits(len(digits):) /= "0") exit
         digits = digits(:len(digits) - 1)
      end do
      if (digits == "0") then
         text = "0"
      else if (exponent >= len(digits) - 1 .and. exponent < largest_plain) then
         text = sign//digits//repeat("0", exponent - len(digits) + 1)
      else if (exponent >= 0 .and. exponent < largest_plain) then
         text = sign//digits(:exponent + 1)//"."//digits(exponent + 2:)
      else if (exponent < 0 .and. exponent >= smallest_plain) then
         text = sign//"0."//repeat("0", -exponent - 1)//digits
      else
         write (exponent_text, '(i0)') exponent
         text = sign//digits(1:1)
         if (len(digits) > 1) text = text//"."//digits(2:)
         text = text//"e"//trim(exponent_text)
      end if
   end function plain_text

   !> An integer as text.
   pure function integer_text(value) result(text)
      !> The integer
      integer, intent(in) :: value
      !> Its digits
      character(len=:), allocatable :: text

      character(len=16) :: buffer

      write (buffer, '(i0)') value
      text = trim(buffer)
   end function integer_text

   !> Is a word a number as Fortran reads it? Words for infinity and not-a-number are none.
   pure function is_number(word) result(verdict)
      !> The word, without blanks
      character(len=*), intent(in) :: word
      !> Is it a number?
      logical :: verdict

      integer :: position, digits

      position = 1
      verdict = .false.
      call skip_sign(word, position)
      call skip_digits(word, position, digits)
      if (position <= len(word)) then
         if (word(position:position) == ".") then
            position = position + 1
            call skip_fraction(word, position, digits)
         end if
      end if
      if (digits == 0) return
      if (position > len(word)) then
         verdict = .true.
         return
      end if
      if (index("eEdD", word(position:position)) == 0) return
      position = position + 1
      call skip_sign(word, position)
      call skip_digits(word, position, digits)
      verdict = digits > 0 .and. position > len(word)
   end function is_number

   !> Step over a sign.
   pure subroutine skip_sign(word, position)
      !> The word
      character(len=*), intent(in) :: word
      !> Place in it
      integer, intent(inout) :: position

      if (position > len(word)) return
      if (index("+-", word(position:position)) > 0) position = position + 1
   end subroutine skip_sign

   !> Step over digits and count them.
   pure subroutine skip_digits(word, position, digits)
      !> The word
      character(len=*), intent(in) :: word
      !> Place in it
      integer, intent(inout) :: position
      !> Number of digits
      integer, intent(out) :: digits

      digits = 0
      do while (position <= len(word))
         if (index("0123456789", word(position:position)) == 0) exit
         digits = digits + 1
         position = position + 1
      end do
   end subroutine skip_digits

   !> Step over the digits after a point and add them to a count.
   pure subroutine skip_fraction(word, position, digits)
      !> The word
      character(len=*), intent(in) :: word
      !> Place in it
      integer, intent(inout) :: position
      !> Number of digits
      integer, intent(inout) :: digits

      integer :: more

      call skip_digits(word, position, more)
      digits = digits + more
   end subroutine skip_fraction

   !> Does a list hold a number too large to be held? Asked before reading it, since reading it may stop the program.
   pure function is_beyond_range(list) result(verdict)
      !> Numbers with blanks, commas or repeat counts between them
      character(len=*), intent(in) :: list
      !> Is one of them 1e308 or larger?
      logical :: verdict

      integer :: first, last

      verdict = .false.
      first = 1
      do while (first <= len(list))
         last = scan(list(first:), " ,*;"//char(9))
         last = merge(len(list), first + last - 2, last == 0)
         if (last >= first) verdict = verdict .or. decimal_exponent(list(first:last)) >= range(1.0_wp) + 1
         first = last + 2
      end do
   end function is_beyond_range

   !> Power of ten of a number's first digit that is not zero; very small where there is none.
   pure function decimal_exponent(word) result(exponent)
      !> The number
      character(len=*), intent(in) :: word
      !> Its power of ten
      integer :: exponent

      !> Larger than any exponent that matters
      integer, parameter :: cap = 100000
      integer :: i, mark, point, written

      exponent = -cap
      if (.not. is_number(word)) return
      mark = scan(word, "eEdD")
      if (mark == 0) mark = len(word) + 1
      point = index(word(:mark - 1), ".")
      if (point == 0) point = mark
      i = scan(word(:mark - 1), "123456789")
      if (i == 0) return
      exponent = merge(point - i - 1, point - i, i < point)
      written = 0
      do i = mark + 1, len(word)
         if (index("+-", word(i:i)) > 0) cycle
         written = min(cap, 10*written + index("0123456789", word(i:i)) - 1)
      end do
      if (index(word(mark:), "-") > 0) written = -written
      exponent = exponent + written
   end function decimal_exponent

end module camroller_number_text
