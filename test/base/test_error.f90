!> Tests of errors as values.
module test_error
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_error, only : error_t, raise, add_context, kind_usage, kind_deck, kind_domain, kind_convergence, &
      kind_file, kind_internal
   implicit none
   private

   public :: collect_error

contains

   !> All tests of this suite.
   subroutine collect_error(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a raised error keeps its kind and message", raise_keeps_both), &
         new_unittest("raising again replaces the first error", raise_replaces), &
         new_unittest("context goes in front, outermost first", context_goes_in_front), &
         new_unittest("context on no error leaves no error", context_on_nothing), &
         new_unittest("each kind is an exit code of its own, none is success", kinds_differ) &
         ]
   end subroutine collect_error

   subroutine raise_keeps_both(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call raise(raised, kind_deck, "no group &case")
      call check(error, allocated(raised), "nothing was raised")
      if (allocated(error)) return
      call check(error, raised%kind, kind_deck)
      if (allocated(error)) return
      call check(error, raised%message, "no group &case")
   end subroutine raise_keeps_both

   subroutine raise_replaces(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call raise(raised, kind_deck, "first")
      call raise(raised, kind_file, "second")
      call check(error, raised%kind, kind_file)
      if (allocated(error)) return
      call check(error, raised%message, "second")
   end subroutine raise_replaces

   subroutine context_goes_in_front(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call raise(raised, kind_convergence, "no root")
      call add_context(raised, "at 214.5 deg")
      call add_context(raised, "case 12")
      call check(error, raised%message, "case 12: at 214.5 deg: no root")
      if (allocated(error)) return
      call check(error, raised%kind, kind_convergence)
   end subroutine context_goes_in_front

   subroutine context_on_nothing(error)
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: raised

      call add_context(raised, "case 12")
      call check(error, .not. allocated(raised), "context alone made an error")
   end subroutine context_on_nothing

   !> Shells read 0 as success, 1 is left to the run-time library, 126 and up belong to the shell.
   subroutine kinds_differ(error)
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: kinds(*) = [kind_usage, kind_deck, kind_domain, kind_convergence, kind_file, kind_internal]
      integer :: i

      call check(error, all(kinds > 1 .and. kinds < 126), "a kind is no exit code that is free for use")
      if (allocated(error)) return
      do i = 1, size(kinds)
         call check(error, count(kinds == kinds(i)), 1, "two kinds share one exit code")
         if (allocated(error)) return
      end do
   end subroutine kinds_differ

end module test_error
