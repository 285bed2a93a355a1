!> The table of an audit as text.
!>
!> Layer: app. In: the table. Out: lines, one for each run of each case.
module camroller_audit_page
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_study_table, only : study_table_t, column_of
   implicit none
   private

   public :: audit_page

   character(len=*), parameter :: n = new_line("a")
   !> Longest line
   integer, parameter :: width = 132
   !> Estimates from here on mean that nothing can be said [-]
   real(wp), parameter :: unknown = 1.0e10_wp
   !> Part of a change that the accuracy of both runs may leave [-]
   real(wp), parameter :: accuracy_left = 3.0e-4_wp

contains

   !> One line for each run.
   function audit_page(table) result(text)
      !> Table of an audit
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      character(len=width) :: line
      integer :: row

      text = "Changes against the run with all effects, of a single one against none, and what was expected before the run"//n// &
         & "case run      effect              mean torque          smallest film        slip per turn        time   share  "// &
         & "needed"//n// &
         & "                                  change   expected    change   expected    change   expected    [ms]   [%]"
      do row = 1, table%rows
         line = ""
         associate (v => table%numbers(row, :))
            write (line, '(i4, 1x, a8, 1x, a18)') nint(v(1)), table%words(row, 2), table%words(row, 1)
            if (nint(v(2)) /= 0) then
               line(36:) = table%words(row, 4)
            else
               line(33:) = pair(v(6), v(9))//pair(v(7), v(10))//pair(v(8), v(11))
               write (line(97:), '(f8.2)') 1.0e3_wp*v(14)
               if (table%words(row, 2) /= "listed") write (line(105:), '(f7.0)') 100.0_wp*v(15)
               if (.not. ieee_is_nan(v(12))) line(114:) = merge("left out", "kept    ", v(12) > 0.0_wp)
            end if
         end associate
         text = text//n//trim(line)
      end do
      text = text//n//n//sizes(table)
   end function audit_page

   !> A change and what was expected.
   pure function pair(change, estimate) result(text)
      !> Both [-]
      real(wp), intent(in) :: change, estimate
      !> Both in words
      character(len=21) :: text

      text = ""
      if (.not. ieee_is_nan(change)) write (text(:10), '(es10.2)') change
      if (.not. ieee_is_nan(estimate)) then
         if (estimate < unknown) write (text(11:), '(es10.1)') estimate
         if (estimate >= unknown) text(11:) = "     large"
      end if
   end function pair

   !> How often the estimates held.
   function sizes(table) result(text)
      !> Table of an audit
      type(study_table_t), intent(in) :: table
      !> A line
      character(len=:), allocatable :: text

      character(len=*), parameter :: names(*) = [character(len=12) :: "mean_torque", "minimum_film", "slip"]
      ! [-]
      real(wp), allocatable :: changes(:), estimates(:)
      logical, allocatable :: is_known(:)
      character(len=60) :: buffer
      integer :: i, held, known

      held = 0
      known = 0
      do i = 1, size(names)
         changes = column_of(table, "change_"//trim(names(i)))
         estimates = column_of(table, "estimate_"//trim(names(i)))
         is_known = .not. (ieee_is_nan(changes) .or. ieee_is_nan(estimates))
         where (.not. is_known) changes = 0.0_wp
         where (.not. is_known) estimates = 0.0_wp
         held = held + count(is_known .and. abs(changes) <= estimates + accuracy_left)
         known = known + count(is_known)
      end do
      write (buffer, '(i0, a, i0, a)') held, " of ", known, " changes are within what was expected"
      text = trim(buffer)
   end function sizes

end module camroller_audit_page
