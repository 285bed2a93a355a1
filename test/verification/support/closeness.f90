!> Comparison of numbers in tests, with words and both numbers in the message.
module closeness
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   implicit none
   private

   public :: check_close, check_scaled, expect_success, has_failed, expect_error, roundings

   !> A hundred roundings: tolerance of values that two orders of the same operations give [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)

contains

   !> A value within a part of the expected one.
   subroutine check_close(error, value, expected, tolerance, what)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> Both values [any unit]
      real(wp), intent(in) :: value, expected
      !> Difference allowed, relative to `expected` [-]
      real(wp), intent(in) :: tolerance
      !> What is compared
      character(len=*), intent(in) :: what

      call check_scaled(error, value, expected, abs(expected), tolerance, what)
   end subroutine check_close

   !> A value within a part of a scale.
   subroutine check_scaled(error, value, expected, scale, tolerance, what)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> Both values, and the size that their difference is judged by [any unit]
      real(wp), intent(in) :: value, expected, scale
      !> Difference allowed, relative to `scale` [-]
      real(wp), intent(in) :: tolerance
      !> What is compared
      character(len=*), intent(in) :: what

      character(len=120) :: numbers

      if (abs(value - expected) <= tolerance*scale) return
      write (numbers, "(2(a, es24.16), a, es9.2)") " is ", value, " instead of ", expected, ", off by ", &
         abs(value - expected)/max(scale, tiny(1.0_wp))
      call test_failed(error, what//trim(numbers))
   end subroutine check_scaled

   !> No error from the library.
   subroutine expect_success(error, failure)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> What the library says
      type(error_t), allocatable, intent(in) :: failure

      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine expect_success

   !> Has a call failed, or the test before it? Then the test has, with the message of the call.
   logical function has_failed(failure, error)
      !> What the library says
      type(error_t), allocatable, intent(in) :: failure
      !> Failure of the test
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(failure)) call test_failed(error, failure%message)
      has_failed = allocated(error)
   end function has_failed

   !> An error of a kind, with words in its message.
   subroutine expect_error(error, failure, kind, words)
      !> Failure of the test
      type(error_type), allocatable, intent(out) :: error
      !> What the library says
      type(error_t), allocatable, intent(in) :: failure
      !> Kind of error expected
      integer, intent(in) :: kind
      !> Words that the message must hold
      character(len=*), intent(in) :: words

      if (.not. allocated(failure)) then
         call test_failed(error, "no error, but expected '"//words//"'")
      else if (failure%kind /= kind) then
         call test_failed(error, "wrong kind of error: "//failure%message)
      else if (index(failure%message, words) == 0) then
         call test_failed(error, "'"//words//"' is not in '"//failure%message//"'")
      end if
   end subroutine expect_error

end module closeness
