!> Remarks of a case, and of many cases by kind.
module test_remarks
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_remarks, only : add_remark, lost_contact, missing_profiles, note_remarks, outside_range, remark_lines, &
      & remark_t, remarks_t
   implicit none
   private

   public :: collect_remarks

   character(len=*), parameter :: line = new_line("a")

contains

   subroutine collect_remarks(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("remarks of a case are lines", test_lines), &
         new_unittest("of remarks of one size, up to rounding, the excess says which is the worst", test_excess), &
         new_unittest("remarks are grouped by kind whatever their words, with the worst of each", test_groups), &
         new_unittest("remarks on lobe shapes are groups of their own, and a case with two remarks counts once", test_lobes) &
         ]
   end subroutine collect_remarks

   subroutine test_lines(error)
      type(error_type), allocatable, intent(out) :: error
      type(remark_t), allocatable :: remarks(:)

      call add_remark(remarks, missing_profiles, "no profiles")
      call check(error, remark_lines(remarks), "no profiles")
      if (allocated(error)) return
      call add_remark(remarks, lost_contact, "contact is lost for 2 %", 2.0_wp)
      call check(error, remark_lines(remarks), "no profiles"//line//"contact is lost for 2 %")
      if (allocated(error)) return
      call check(error, remark_lines(remarks(:0)), "")
   end subroutine test_lines

   !> Numbers in the words mislead on purpose: neither they nor the words before them say what kind a remark is, or how bad.
   subroutine test_groups(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks
      type(remark_t), allocatable :: cases(:, :), none(:)

      allocate (cases(2, 3), none(0))
      cases(:, 1) = [remark(lost_contact, 2.5_wp, "from 9000 on"), remark(outside_range, 60.0_wp, "from 1 on")]
      cases(:, 2) = [remark(outside_range, 7.0_wp, "from 2 on"), remark(lost_contact, 9.0_wp, "up to 8000")]
      cases(:, 3) = [remark(missing_profiles, 0.0_wp, "77"), remark(lost_contact, 11.5_wp, "from 3 on")]
      call note_remarks(remarks, 1, cases(:, 1))
      call note_remarks(remarks, 2, none)
      call note_remarks(remarks, 3, cases(:, 2))
      call note_remarks(remarks, 4, cases(:, 3))
      call check(error, size(remarks%groups), 3)
      if (allocated(error)) return
      call check(error, all(remarks%groups%cases == [3, 2, 1]) .and. all(remarks%groups%case_number == [4, 1, 4]), &
         & "numbers of cases")
      if (allocated(error)) return
      call check(error, remarks%groups(1)%worst%text, "from 3 on")
      if (allocated(error)) return
      call check(error, remarks%groups(2)%worst%text, "from 1 on")
      if (allocated(error)) return
      call check(error, remarks%groups(3)%worst%text, "77")
   end subroutine test_groups

   subroutine test_excess(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks
      type(remark_t) :: of_case(4)
      integer :: i

      of_case(1) = remark(outside_range, 100.0_wp*(1.0_wp + epsilon(1.0_wp)), "near")
      of_case(2) = remark(outside_range, 100.0_wp, "far")
      of_case(3) = remark(outside_range, 100.0_wp*(1.0_wp + 2.0_wp*epsilon(1.0_wp)), "near as well")
      of_case(4) = remark(outside_range, 99.0_wp, "farthest for a shorter time")
      of_case%excess = [0.1_wp, 2.0_wp, 0.2_wp, 3.0_wp]
      do i = 1, size(of_case)
         call note_remarks(remarks, i, of_case(i:i))
      end do
      call check(error, remarks%groups(1)%worst%text, "far")
      if (allocated(error)) return
      call check(error, remarks%groups(1)%case_number, 2)
   end subroutine test_excess

   subroutine test_lobes(error)
      type(error_type), allocatable, intent(out) :: error
      type(remarks_t) :: remarks
      type(remark_t) :: of_case(3)

      of_case = [remark(lost_contact, 9.0_wp, "a"), remark(lost_contact, 10.0_wp, "b"), remark(lost_contact, 11.0_wp, "c")]
      of_case%lobe = [1, 2, 2]
      call note_remarks(remarks, 1, of_case)
      call note_remarks(remarks, 2, of_case(2:2))
      call check(error, size(remarks%groups), 2)
      if (allocated(error)) return
      call check(error, all(remarks%groups%cases == [1, 2]), "numbers of cases")
      if (allocated(error)) return
      call check(error, remarks%groups(2)%worst%text, "c")
   end subroutine test_lobes

   !> A remark.
   function remark(kind, size, text)
      integer, intent(in) :: kind
      real(wp), intent(in) :: size
      character(len=*), intent(in) :: text
      type(remark_t) :: remark

      remark%kind = kind
      remark%size = size
      remark%text = text
   end function remark

end module test_remarks
