!> Decimal digits of a number where their rounding is beyond doubt: a small part of the work of a formatted write.
!>
!> In: number, form, digits after the point. Out: the text that a formatted write makes, or that the rounding is in doubt. The
!> number is scaled by a power of ten that is held exactly: one rounding is all that is wrong with the integer of its digits.
module camroller_quick_digits
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   implicit none
   private

   public :: write_quickly

   !> Largest power of ten that is held exactly
   integer, parameter :: largest_power = 22
   !> Digits of a number at most
   integer, parameter :: most_digits = 9
   !> First integer with more [-]
   real(wp), parameter :: too_large = 10.0_wp**most_digits
   !> Distance from a half within which the rounding is in doubt: far more than a rounding of the largest integer [-]
   real(wp), parameter :: doubt = 1.0e-5_wp

contains

   !> Write a number with so many digits after the point.
   pure subroutine write_quickly(value, has_exponent, places, text, is_written)
      !> The number, finite [any unit]
      real(wp), intent(in) :: value
      !> One digit before the point, and an exponent of two digits? Else no exponent
      logical, intent(in) :: has_exponent
      !> Digits after the point
      integer, intent(in) :: places
      !> The number at the right end, blanks before it
      character(len=*), intent(out) :: text
      !> Is it written? Not where the rounding is in doubt or there are many digits
      logical, intent(out) :: is_written

      ! The number times a power of ten [any unit]; its digits
      real(wp) :: scaled
      integer(int64) :: digits
      integer :: exponent, place

      is_written = .false.
      text = ""
      if (places >= most_digits .or. .not. abs(value) > 0.0_wp .or. abs(value) >= huge(1.0_wp)) return
      exponent = 0
      if (has_exponent) exponent = floor(log10(abs(value)))
      if (abs(places - exponent) > largest_power .or. abs(exponent) > 99) return
      scaled = abs(value)*10.0_wp**max(places - exponent, 0)/10.0_wp**max(exponent - places, 0)
      if (scaled >= too_large .or. abs(scaled - aint(scaled) - 0.5_wp) < doubt) return
      digits = nint(scaled, int64)
      ! Not where the logarithm, or the rounding, has led to another number of digits
      if (has_exponent .and. (digits < 10_int64**places .or. digits >= 10_int64**(places + 1))) return
      place = len(text)
      if (has_exponent) then
         call put_digit(text, place, int(mod(abs(exponent), 10), int64))
         call put_digit(text, place, int(abs(exponent)/10, int64))
         call put(text, place, merge("E-", "E+", exponent < 0))
      end if
      call put_digits(text, place, digits, places)
      if (value < 0.0_wp) call put(text, place, "-")
      is_written = .true.
   end subroutine write_quickly

   !> Put the digits of an integer before what is written, with a point among them and one digit before it at least.
   pure subroutine put_digits(text, place, digits, places)
      !> The text
      character(len=*), intent(inout) :: text
      !> Place of the last blank
      integer, intent(inout) :: place
      !> The integer, not negative
      integer(int64), intent(in) :: digits
      !> Digits after the point
      integer, intent(in) :: places

      ! What is left of it
      integer(int64) :: rest
      integer :: i

      rest = digits
      do i = 1, places
         call put_digit(text, place, mod(rest, 10_int64))
         rest = rest/10_int64
      end do
      call put(text, place, ".")
      do
         call put_digit(text, place, mod(rest, 10_int64))
         rest = rest/10_int64
         if (rest == 0) exit
      end do
   end subroutine put_digits

   !> Put a digit before what is written.
   pure subroutine put_digit(text, place, digit)
      !> The text
      character(len=*), intent(inout) :: text
      !> Place of the last blank
      integer, intent(inout) :: place
      !> The digit
      integer(int64), intent(in) :: digit

      text(place:place) = achar(iachar("0") + int(digit))
      place = place - 1
   end subroutine put_digit

   !> Put a word before what is written.
   pure subroutine put(text, place, word)
      !> The text
      character(len=*), intent(inout) :: text
      !> Place of the last blank
      integer, intent(inout) :: place
      !> The word
      character(len=*), intent(in) :: word

      text(place - len(word) + 1:place) = word
      place = place - len(word)
   end subroutine put

end module camroller_quick_digits
