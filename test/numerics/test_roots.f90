!> Bracketed root: accuracy, cost, refusals.
module test_roots
   use, intrinsic :: ieee_arithmetic, only : ieee_divide_by_zero, ieee_get_flag, ieee_set_flag, ieee_value, ieee_quiet_nan
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_found, root_wanted, root_not_bracketed
   implicit none
   private

   public :: collect_roots

contains

   subroutine collect_roots(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a simple root is found to round-off in few steps", test_simple), &
         new_unittest("a triple root and a jump are found by halving", test_hard), &
         new_unittest("no trial leaves the bracket", test_inside), &
         new_unittest("a root at an end is found at once", test_end), &
         new_unittest("ends of one sign are refused", test_one_sign), &
         new_unittest("a value that is no number ends the search", test_nan), &
         new_unittest("a jump at one point, a bracket without width, is found without a division by zero", test_point) &
         ]
   end subroutine collect_roots

   subroutine test_simple(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket

      call start_bracket(bracket, 0.0_wp, 2.0_wp, -1.0_wp, cos(2.0_wp) - 2.0_wp, 0.0_wp)
      call check(error, bracket%status == root_not_bracketed, "two negative values accepted")
      if (allocated(error)) return
      call start_bracket(bracket, 0.0_wp, 2.0_wp, 1.0_wp, cos(2.0_wp) - 2.0_wp, 0.0_wp)
      do while (bracket%status == root_wanted)
         call narrow_bracket(bracket, cos(bracket%trial) - bracket%trial)
      end do
      ! fixed point of the cosine (Dottie number), known to many digits
      call check(error, abs(bracket%trial - 0.739085133215160641655_wp) < 4.0_wp*epsilon(1.0_wp))
      if (allocated(error)) return
      call check(error, bracket%status == root_found .and. bracket%steps <= 12, "too many steps")
   end subroutine test_simple

   subroutine test_hard(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket

      call start_bracket(bracket, -3.0_wp, 4.0_wp, -64.0_wp, 27.0_wp, 1.0e-12_wp)
      do while (bracket%status == root_wanted)
         call narrow_bracket(bracket, (bracket%trial - 1.0_wp)**3)
      end do
      call check(error, bracket%status == root_found .and. abs(bracket%trial - 1.0_wp) < 1.0e-12_wp, "triple root")
      if (allocated(error)) return
      call start_bracket(bracket, 0.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 0.0_wp)
      do while (bracket%status == root_wanted)
         call narrow_bracket(bracket, sign(1.0_wp, bracket%trial - 0.3_wp))
      end do
      call check(error, bracket%status == root_found .and. abs(bracket%trial - 0.3_wp) < 4.0_wp*epsilon(1.0_wp), "jump")
      if (allocated(error)) return
      call check(error, bracket%steps <= 60, "more steps than halving to round-off needs")
   end subroutine test_hard

   subroutine test_inside(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket
      real(wp) :: low, high

      low = 1.0e-8_wp
      high = 1.0e3_wp
      call start_bracket(bracket, low, high, log(low), log(high), 0.0_wp)
      do while (bracket%status == root_wanted)
         call check(error, bracket%trial > low .and. bracket%trial < high, "a trial outside the bracket")
         if (allocated(error)) return
         if (bracket%trial < 1.0_wp) low = bracket%trial
         if (bracket%trial > 1.0_wp) high = bracket%trial
         call narrow_bracket(bracket, log(bracket%trial))
      end do
      call check(error, abs(bracket%trial - 1.0_wp) < 4.0_wp*epsilon(1.0_wp))
   end subroutine test_inside

   subroutine test_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket

      call start_bracket(bracket, 1.0_wp, 2.0_wp, 0.0_wp, 5.0_wp, 0.0_wp)
      call check(error, bracket%status == root_found .and. abs(bracket%trial - 1.0_wp) <= 0.0_wp, "lower end")
      if (allocated(error)) return
      call start_bracket(bracket, 1.0_wp, 2.0_wp, 5.0_wp, 0.0_wp, 0.0_wp)
      call check(error, bracket%status == root_found .and. abs(bracket%trial - 2.0_wp) <= 0.0_wp, "upper end")
   end subroutine test_end

   subroutine test_one_sign(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket

      call start_bracket(bracket, 1.0_wp, 2.0_wp, 3.0_wp, 5.0_wp, 0.0_wp)
      call check(error, bracket%status == root_not_bracketed)
   end subroutine test_one_sign

   subroutine test_nan(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket

      call start_bracket(bracket, 0.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 0.0_wp)
      call narrow_bracket(bracket, ieee_value(1.0_wp, ieee_quiet_nan))
      call check(error, bracket%status == root_not_bracketed)
   end subroutine test_nan

   subroutine test_point(error)
      type(error_type), allocatable, intent(out) :: error
      type(bracket_t) :: bracket
      logical :: divides

      call ieee_set_flag(ieee_divide_by_zero, .false.)
      call start_bracket(bracket, 1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 0.0_wp)
      do while (bracket%status == root_wanted)
         call narrow_bracket(bracket, 0.5_wp)
      end do
      call ieee_get_flag(ieee_divide_by_zero, divides)
      call check(error, bracket%status == root_found .and. .not. abs(bracket%trial - 1.0_wp) > 0.0_wp, "root")
      if (allocated(error)) return
      call check(error, .not. divides, "division by zero")
   end subroutine test_point

end module test_roots
