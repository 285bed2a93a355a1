!> Tests of numbers as text.
module test_number_text
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_positive_inf
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_number_text, only : agreeing, counted, number_text, fixed_text, scientific_text, integer_text, right_text, &
      & is_number, is_beyond_range
   implicit none
   private

   public :: collect_number_text

contains

   !> All tests of this suite.
   subroutine collect_number_text(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a number is written with as few digits as give it back", short_numbers), &
         new_unittest("a number of so many digits is written with them", digits_kept), &
         new_unittest("any number comes back as it was", numbers_come_back), &
         new_unittest("a number is rounded where that is asked for", rounded_numbers), &
         new_unittest("digits after the point follow at least one digit before it", fixed_numbers), &
         new_unittest("every number has a text in every form", extreme_numbers), &
         new_unittest("a column is as wide as asked for, or as its word", columns), &
         new_unittest("one of anything has no plural", counted_nouns), &
         new_unittest("words are told from numbers", words_and_numbers), &
         new_unittest("numbers too large to be held are found without reading them", too_large) &
         ]
   end subroutine collect_number_text

   subroutine short_numbers(error)
      type(error_type), allocatable, intent(out) :: error

      !> The numbers [-]
      real(wp), parameter :: numbers(*) = [0.0_wp, 1.0_wp, -3.5_wp, 600.0_wp, 0.14_wp, 1.0e7_wp, 2.2e-8_wp, 1234567.0_wp, &
         & 0.00065_wp, -1.0e-5_wp, 12345678.9_wp]
      character(len=*), parameter :: texts(*) = [character(len=12) :: "0", "1", "-3.5", "600", "0.14", "1e7", "2.2e-8", &
         & "1234567", "0.00065", "-1e-5", "1.23456789e7"]
      integer :: i

      do i = 1, size(numbers)
         call check(error, number_text(numbers(i)), trim(texts(i)))
         if (allocated(error)) return
      end do
      ! Fewer bits than other numbers have
      call check(error, number_text(nearest(0.0_wp, 1.0_wp)), "5e-324")
      if (allocated(error)) return
      call check(error, integer_text(-42), "-42")
   end subroutine short_numbers

   !> What is written with so many digits has no more when it is written again.
   subroutine digits_kept(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: all_digits = "73910564281357964"
      character(len=:), allocatable :: digits, text
      !> The number [-]
      real(wp) :: number
      integer :: count, exponent

      do count = 1, len(all_digits)
         digits = all_digits(:count - 1)//"7"
         do exponent = -300, 300, 13
            text = digits(1:1)//"."//digits(2:)//"e"//integer_text(exponent)
            read (text, *) number
            text = number_text(number)
            if (count <= precision(number)) then
               call check(error, mantissa_digits(text) == count, &
                  & digits//"e"//integer_text(exponent)//" is written as "//text)
            else
               call check(error, mantissa_digits(text) <= count, digits//"e"//integer_text(exponent)//" is written as "//text)
            end if
            if (allocated(error)) return
         end do
      end do
   end subroutine digits_kept

   !> Digits of a number other than zero, without zeros before and behind them.
   pure function mantissa_digits(text) result(count)
      !> The number
      character(len=*), intent(in) :: text
      !> How many
      integer :: count

      character(len=len(text)) :: digits
      integer :: i, end_of_mantissa

      end_of_mantissa = index(text, "e") - 1
      if (end_of_mantissa < 0) end_of_mantissa = len(text)
      digits = ""
      do i = 1, end_of_mantissa
         if (index("0123456789", text(i:i)) > 0) digits = trim(digits)//text(i:i)
      end do
      count = verify(digits, "0 ", back=.true.) - verify(digits, "0 ") + 1
   end function mantissa_digits

   subroutine counted_nouns(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: numbers(*) = [0, 1, 2, 11, huge(1)]
      character(len=*), parameter :: texts(*) = [character(len=16) :: "0 cases", "1 case", "2 cases", "11 cases", &
         & "2147483647 cases"]
      integer :: i

      do i = 1, size(numbers)
         call check(error, "'"//counted(numbers(i), "case")//"'", "'"//trim(texts(i))//"'")
         if (allocated(error)) return
      end do
      call check(error, agreeing(1, "is", "were")//agreeing(3, "is", "were"), "iswere")
   end subroutine counted_nouns

   subroutine numbers_come_back(error)
      type(error_type), allocatable, intent(out) :: error

      !> Numbers with all their digits, and one as read back [-]
      real(wp) :: number, again
      character(len=:), allocatable :: text
      integer :: i

      do i = -300, 300, 7
         number = pi*10.0_wp**i
         text = number_text(number)
         read (text, *) again
         call check(error, again, number, thr=0.0_wp, message=text)
         if (allocated(error)) return
      end do
   end subroutine numbers_come_back

   subroutine rounded_numbers(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, number_text(pi, 3), "3.14")
      if (allocated(error)) return
      call check(error, number_text(1.0_wp/3.0_wp, 12), "0.333333333333")
      if (allocated(error)) return
      call check(error, number_text(0.99999_wp, 2), "1")
   end subroutine rounded_numbers

   subroutine fixed_numbers(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, fixed_text(0.2_wp, 1), "0.2")
      if (allocated(error)) return
      call check(error, fixed_text(-0.25_wp, 3), "-0.250")
      if (allocated(error)) return
      call check(error, fixed_text(1.0e12_wp, 1), "1000000000000.0")
      if (allocated(error)) return
      call check(error, fixed_text(2.5e20_wp, 1), "2.5E+20")
      if (allocated(error)) return
      call check(error, scientific_text(1.25e-4_wp, 2), "1.25E-04")
      if (allocated(error)) return
      call check(error, scientific_text(-1.25e-104_wp, 1), "-1.2E-104")
   end subroutine fixed_numbers

   !> With run-time checks an overflow on the way would end the program.
   subroutine extreme_numbers(error)
      type(error_type), allocatable, intent(out) :: error

      !> Numbers at the ends of their range [-]
      real(wp) :: numbers(8), again
      integer :: i, digits

      numbers = [huge(1.0_wp), -huge(1.0_wp), tiny(1.0_wp), -tiny(1.0_wp)*epsilon(1.0_wp), 1.0e308_wp, 9.99e307_wp, 1.0e12_wp, &
         & 0.0_wp]
      do i = 1, size(numbers)
         call check(error, is_number(number_text(numbers(i))), number_text(numbers(i)))
         if (allocated(error)) return
         again = number_read(number_text(numbers(i)))
         call check(error, again, numbers(i), thr=0.0_wp, message=number_text(numbers(i)))
         if (allocated(error)) return
         do digits = 1, 17
            call check(error, is_number(number_text(numbers(i), digits)) .and. is_number(fixed_text(numbers(i), digits - 1)) &
               & .and. is_number(scientific_text(numbers(i), digits - 1)), number_text(numbers(i)))
            if (allocated(error)) return
         end do
      end do
      call check(error, number_text(ieee_value(1.0_wp, ieee_quiet_nan))//fixed_text(ieee_value(1.0_wp, ieee_positive_inf), 3)// &
         & number_text(-ieee_value(1.0_wp, ieee_positive_inf), 3), "NaNInfinity-Infinity")
      if (allocated(error)) return
      call check(error, integer_text(-huge(1) - 1)//integer_text(huge(1_int64))//integer_text(0), &
         & "-214748364892233720368547758070")
   end subroutine extreme_numbers

   !> A number as it is read.
   function number_read(text) result(number)
      !> The text
      character(len=*), intent(in) :: text
      !> The number [-]
      real(wp) :: number

      read (text, *) number
   end function number_read

   subroutine columns(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, right_text("12", 5)//right_text("123456", 5)//right_text("", 2), "   12123456  ")
   end subroutine columns

   subroutine words_and_numbers(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: numbers(*) = [character(len=8) :: "1", "-1.5", "+.5", "5.", "1e3", "1.5d-03", "1E+10"]
      character(len=*), parameter :: words(*) = [character(len=8) :: "", "nan", "inf", "-", ".", "e5", "1e", "1.2.3", "1,5", &
         & "0x10", "1e+", "12 3"]
      integer :: i

      do i = 1, size(numbers)
         call check(error, is_number(trim(numbers(i))), numbers(i))
         if (allocated(error)) return
      end do
      do i = 1, size(words)
         call check(error, .not. is_number(trim(words(i))), words(i))
         if (allocated(error)) return
      end do
   end subroutine words_and_numbers

   subroutine too_large(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: large(*) = [character(len=16) :: "1e400", "-1d308", "1000e306", "1, 2*1e999", &
         & "0.001e311", "1e99999999999"]
      character(len=*), parameter :: held(*) = [character(len=16) :: "1e307", "1e-400", "0e999", "0.001e310", "fast", "1 2 3"]
      integer :: i

      do i = 1, size(large)
         call check(error, is_beyond_range(trim(large(i))), large(i))
         if (allocated(error)) return
      end do
      do i = 1, size(held)
         call check(error, .not. is_beyond_range(trim(held(i))), held(i))
         if (allocated(error)) return
      end do
   end subroutine too_large

end module test_number_text
