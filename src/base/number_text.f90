!> Conversion of numbers to text, and check of a text for a number: the only module that writes numbers into texts.
!>
!> In: numbers or words. Out: texts or logicals. Each text is as long as its number needs. Writing into a buffer of fixed length
!> could end the program where the number is longer.
module camroller_number_text
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   implicit none
   private

   public :: number_text, fixed_text, scientific_text, millimetres_text, integer_text, hexadecimal_text, right_text
   public :: counted, agreeing
   public :: append_number, write_number, number_length
   public :: is_number, is_beyond_range

   !> A number with as few digits as give it back, or rounded to a number of significant digits
   interface number_text
      module procedure :: shortest_text, rounded_text
   end interface number_text

   !> An integer as text
   interface integer_text
      module procedure :: short_integer_text, long_integer_text
   end interface integer_text

   !> Powers of ten between which a number is written without an exponent
   integer, parameter :: smallest_plain = -4, largest_plain = 7
   !> Digits that tell any two numbers apart
   integer, parameter :: all_digits = 17
   !> Length that holds every number in the forms below, and as formats want it
   integer, parameter :: number_length = 40
   character(len=*), parameter :: number_width = "40"
   !> Counts of digits as formats want them
   character(len=*), parameter :: counts(0:all_digits) = [character(len=2) :: "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", &
      & "10", "11", "12", "13", "14", "15", "16", "17"]
   !> From here on no digits after the point are written, but an exponent [any unit]
   real(wp), parameter :: largest_fixed = 1.0e15_wp

contains

   !> Length of the shortest text.
   pure function shortest_length(value) result(length)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Characters
      integer :: length

      character(len=number_length) :: buffer

      call write_plain(value, 1, all_digits, buffer, length)
   end function shortest_length

   !> Length of a text of so many significant digits.
   pure function rounded_length(value, digits) result(length)
      !> The number [any unit]
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      !> Characters
      integer :: length

      character(len=number_length) :: buffer

      call write_plain(value, digits, digits, buffer, length)
   end function rounded_length

   !> Length of a number in one of the forms of `write_number`.
   pure function edited_length(value, form, decimals) result(length)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> `f` or `es`
      character(len=*), intent(in) :: form
      !> Digits after the point
      integer, intent(in) :: decimals
      !> Characters
      integer :: length

      character(len=number_length) :: buffer

      call write_number(value, form, decimals, buffer)
      length = len_trim(adjustl(buffer))
   end function edited_length

   !> Length of an integer as text.
   pure function integer_length(value) result(length)
      !> The integer
      integer(int64), intent(in) :: value
      !> Characters
      integer :: length

      integer(int64) :: rest

      length = merge(2, 1, value < 0)
      rest = value/10
      do while (rest /= 0)
         length = length + 1
         rest = rest/10
      end do
   end function integer_length

   !> A number with as few digits as give it back.
   pure function shortest_text(value) result(text)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> The number as text
      character(len=shortest_length(value)) :: text

      character(len=number_length) :: buffer
      integer :: length

      call write_plain(value, 1, all_digits, buffer, length)
      text = buffer
   end function shortest_text

   !> A number rounded to so many significant digits.
   pure function rounded_text(value, digits) result(text)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Digits, from 1 to 17
      integer, intent(in) :: digits
      !> The number as text
      character(len=rounded_length(value, digits)) :: text

      character(len=number_length) :: buffer
      integer :: length

      call write_plain(value, digits, digits, buffer, length)
      text = buffer
   end function rounded_text

   !> Append a number to a text, rounded or with as few digits as give it back. It is written once, where a function writes it again
   !> to know how long it is.
   pure subroutine append_number(text, value, digits)
      !> The text
      character(len=:), allocatable, intent(inout) :: text
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Significant digits that it is rounded to, from 1 to 17
      integer, intent(in), optional :: digits

      character(len=number_length) :: buffer
      integer :: length

      if (present(digits)) call write_plain(value, digits, digits, buffer, length)
      if (.not. present(digits)) call write_plain(value, 1, all_digits, buffer, length)
      text = text//buffer(:length)
   end subroutine append_number

   !> A length as decks have it, for messages.
   pure function millimetres_text(length) result(text)
      !> The length [m]
      real(wp), intent(in) :: length
      !> Five digits of it in mm
      character(len=rounded_length(1.0e3_wp*length, 5)) :: text

      text = rounded_text(1.0e3_wp*length, 5)
   end function millimetres_text

   !> A number with so many digits after the point; with an exponent where it is too large for that.
   pure function fixed_text(value, decimals) result(text)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Digits after the point, from 0 to 16
      integer, intent(in) :: decimals
      !> The number as text
      character(len=edited_length(value, "f", decimals)) :: text

      character(len=number_length) :: buffer

      call write_number(value, "f", decimals, buffer)
      text = adjustl(buffer)
   end function fixed_text

   !> A number with one digit before the point, so many after it, and an exponent, as in 1.20E-04.
   pure function scientific_text(value, decimals) result(text)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Digits after the point, from 0 to 16
      integer, intent(in) :: decimals
      !> The number as text
      character(len=edited_length(value, "es", decimals)) :: text

      character(len=number_length) :: buffer

      call write_number(value, "es", decimals, buffer)
      text = adjustl(buffer)
   end function scientific_text

   !> Write any number in one of two forms.
   pure subroutine write_number(value, form, decimals, text)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> `f` without exponent, but not for large numbers; `es` with one, or `e3` with one of three digits
      character(len=*), intent(in) :: form
      !> Digits after the point
      integer, intent(in) :: decimals
      !> The number, blanks before it
      character(len=number_length), intent(out) :: text

      character(len=2) :: used
      integer :: places

      places = max(0, min(decimals, all_digits - 1))
      if (.not. ieee_is_finite(value)) then
         text = "NaN"
         if (.not. ieee_is_nan(value)) text = merge("-Infinity", "Infinity ", value < 0.0_wp)
         return
      end if
      used = form
      if (form == "f" .and. abs(value) >= largest_fixed) used = "es"
      ! style: write because this is the place where numbers become text
      if (used /= "e3") write (text, "("//used//number_width//"."//counts(places)//")") value
      if (used == "f" .or. used == "es" .and. index(text, "E") > 0) return
      ! style: write because this is the place where numbers become text
      write (text, "(es"//number_width//"."//counts(places)//"e3)") value
   end subroutine write_number

   !> A number as people write it, with the fewest digits of a range that give it back.
   pure subroutine write_plain(value, fewest, most, text, length)
      !> The number [any unit]
      real(wp), intent(in) :: value
      !> Range of digits
      integer, intent(in) :: fewest, most
      !> The number
      character(len=number_length), intent(out) :: text
      !> Its characters
      integer, intent(out) :: length

      !> The number read back [any unit]
      real(wp) :: again
      character(len=number_length) :: buffer
      integer :: first, n

      if (.not. ieee_is_finite(value)) then
         call write_number(value, "es", 1, text)
      else
         ! Rounded to 15 digits, a number that has no more is itself with zeros behind it; below `tiny` bits are too few for that
         first = fewest
         if (abs(value) >= tiny(value)) first = max(fewest, min(most, precision(value)))
         do n = first, most
            call write_number(value, "es", n - 1, buffer)
            if (n == most) exit
            ! Rounded up, a number near the largest is beyond it
            if (abs(value) > 0.5_wp*huge(value) .and. is_beyond_range(trim(adjustl(buffer)))) cycle
            read (buffer, "(f"//number_width//".0)") again
            if (.not. abs(again - value) > 0.0_wp) exit
         end do
         call write_without_needless(adjustl(buffer), text)
      end if
      length = len_trim(text)
   end subroutine write_plain

   !> Rewrite `-d.ddddE+xx` without needless digits.
   pure subroutine write_without_needless(scientific, text)
      !> Number in scientific form
      character(len=*), intent(in) :: scientific
      !> The same, as people write it
      character(len=*), intent(out) :: text

      character(len=number_length) :: digits
      character(len=:), allocatable :: sign
      integer :: mark, exponent, i, n

      mark = index(scientific, "E")
      exponent = 0
      do i = mark + 2, len_trim(scientific)
         exponent = 10*exponent + iachar(scientific(i:i)) - iachar("0")
      end do
      if (scientific(mark + 1:mark + 1) == "-") exponent = -exponent
      sign = ""
      if (scientific(1:1) == "-") sign = "-"
      n = 0
      do i = 1, mark - 1
         if (scientific(i:i) < "0" .or. scientific(i:i) > "9") cycle
         n = n + 1
         digits(n:n) = scientific(i:i)
      end do
      do while (n > 1)
         if (digits(n:n) /= "0") exit
         n = n - 1
      end do
      if (digits(:n) == "0") then
         text = "0"
      else if (exponent >= n - 1 .and. exponent < largest_plain) then
         text = sign//digits(:n)//repeat("0", exponent - n + 1)
      else if (exponent >= 0 .and. exponent < largest_plain) then
         text = sign//digits(:exponent + 1)//"."//digits(exponent + 2:n)
      else if (exponent < 0 .and. exponent >= smallest_plain) then
         text = sign//"0."//repeat("0", -exponent - 1)//digits(:n)
      else
         text = sign//digits(1:1)
         if (n > 1) text = trim(text)//"."//digits(2:n)
         text = trim(text)//"e"//integer_text(exponent)
      end if
   end subroutine write_without_needless

   !> An integer as text.
   pure function short_integer_text(value) result(text)
      !> The integer
      integer, intent(in) :: value
      !> Its digits
      character(len=integer_length(int(value, int64))) :: text

      text = long_integer_text(int(value, int64))
   end function short_integer_text

   !> A long integer as text.
   pure function long_integer_text(value) result(text)
      !> The integer
      integer(int64), intent(in) :: value
      !> Its digits
      character(len=integer_length(value)) :: text

      ! What is left of the number, not positive so that the smallest one has its place, too
      integer(int64) :: rest
      integer :: place

      if (value < 0) then
         rest = value
         text(1:1) = "-"
      else
         rest = -value
      end if
      do place = len(text), merge(2, 1, value < 0), -1
         text(place:place) = achar(iachar("0") - int(modulo(rest, -10_int64)))
         rest = rest/10
      end do
   end function long_integer_text

   !> The 64 bits of an integer as 16 hexadecimal digits.
   pure function hexadecimal_text(value) result(text)
      !> The integer
      integer(int64), intent(in) :: value
      !> Its digits
      character(len=16) :: text

      ! style: write because this is the place where numbers become text
      write (text, "(z16.16)") value
   end function hexadecimal_text

   !> How many there are of something: `1 case`, `24 cases`.
   pure function counted(number, noun) result(words)
      !> How many
      integer, intent(in) :: number
      !> One of them, a word whose plural ends with an s
      character(len=*), intent(in) :: noun
      !> Number and noun
      character(len=integer_length(int(number, int64)) + len(noun) + merge(1, 2, number == 1)) :: words

      words = integer_text(number)//" "//agreeing(number, noun, noun//"s")
   end function counted

   !> The words that go with a number.
   pure function agreeing(number, one, many) result(words)
      !> The number
      integer, intent(in) :: number
      !> Words for one, and for none or several
      character(len=*), intent(in) :: one, many
      !> One of both
      character(len=merge(len(one), len(many), number == 1)) :: words

      if (number == 1) then
         words = one
      else
         words = many
      end if
   end function agreeing

   !> A word at the right end of a column; one that is too long makes its line longer and is shown whole.
   pure function right_text(word, width) result(text)
      !> The word
      character(len=*), intent(in) :: word
      !> Characters of the column
      integer, intent(in) :: width
      !> The word, blanks before it
      character(len=max(width, len(word))) :: text

      text = repeat(" ", len(text) - len(word))//word
   end function right_text

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
      character(len=*), intent(in) :: word
      !> Place in it
      integer, intent(inout) :: position

      if (position > len(word)) return
      if (index("+-", word(position:position)) > 0) position = position + 1
   end subroutine skip_sign

   !> Step over digits and count them.
   pure subroutine skip_digits(word, position, digits)
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
