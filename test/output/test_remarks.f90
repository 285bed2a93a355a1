!> Remarks of many cases, by kind.
module test_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_remarks, only : remarks_t, note_remarks
   implicit none
   private

   public :: collect_remarks

   character(len=*), parameter :: line = new_line("a")

contains

   subroutine collect_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("remarks are grouped by their words, with the worst of each", test_groups), &
         new_unittest("remarks on lobes are kinds of their own", test_lobes), &
         new_unittest("remarks without a number or with one beyond all numbers", test_odd_numbers) &
         ]
   end subroutine collect_remarks

   subroutine test_groups(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks

      call note_remarks(remarks, 1, "contact is lost for 2.5 % of it"//line//"the law is out for 60 %, e.g. at 10 deg")
      call note_remarks(remarks, 2, "")
      call note_remarks(remarks, 3, "contact is lost for 11.5 % of it")
      call note_remarks(remarks, 4, "the law is out for 7 %, e.g. at 300 deg"//line//"contact is lost for 9 % of it")
      call check(error, size(remarks%groups), 2)
      if (allocated(error)) return
      call check(error, remarks%groups(1)%cases, 3)
      if (allocated(error)) return
      call check(error, remarks%groups(1)%case_number, 3)
      if (allocated(error)) return
      call check(error, remarks%groups(1)%worst, "contact is lost for 11.5 % of it")
      if (allocated(error)) return
      call check(error, remarks%groups(2)%cases, 2)
      if (allocated(error)) return
      call check(error, remarks%groups(2)%worst, "the law is out for 60 %, e.g. at 10 deg")
   end subroutine test_groups

   subroutine test_lobes(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks

      call note_remarks(remarks, 1, "lobe 1: contact is lost for 9 %"//line//"lobe 2: contact is lost for 1e1 %")
      call note_remarks(remarks, 2, "lobe 2: contact is lost for 2 %")
      call check(error, size(remarks%groups), 2)
      if (allocated(error)) return
      call check(error, remarks%groups(2)%cases, 2)
      if (allocated(error)) return
      call check(error, remarks%groups(2)%case_number, 1)
   end subroutine test_lobes

   subroutine test_odd_numbers(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks

      call note_remarks(remarks, 1, "no profiles"//line//"out by 1e999"//line//"at 3.")
      call note_remarks(remarks, 2, "no profiles"//line//"out by 2"//line//"at 4.")
      call check(error, size(remarks%groups), 3)
      if (allocated(error)) return
      call check(error, remarks%groups(1)%cases, 2)
      if (allocated(error)) return
      call check(error, remarks%groups(3)%worst, "at 4.")
   end subroutine test_odd_numbers

end module test_remarks
