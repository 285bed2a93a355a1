!> The table of an audit as text.
!>
!> In: the table. Out: lines, one for each run of each case.
module camroller_audit_page
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_number_text, only : fixed_text, scientific_text, integer_text, right_text
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

      text = "Changes relative to the run with all effects (for a single one: with none), and estimates before the run"//n// &
         & "case run      effect              mean torque          smallest film        slip per turn        time   share  "// &
         & "needed"//n// &
         & "                                  change   expected    change   expected    change   expected    [ms]   [%]"
      do row = 1, table%rows
         line = ""
         associate (v => table%numbers(row, :))
            line = right_text(integer_text(nint(v(1))), 4)//" "//table%words(row, 2) (:8)//" "//table%words(row, 1) (:18)
            if (nint(v(2)) /= 0) then
               line(36:) = table%words(row, 4)
            else
               line(33:) = pair(v(6), v(9))//pair(v(7), v(10))//pair(v(8), v(11))
               line(97:) = right_text(fixed_text(1.0e3_wp*v(14), 2), 8)
               if (table%words(row, 2) /= "listed") line(105:) = right_text(fixed_text(100.0_wp*v(15), 0), 7)
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
      if (.not. ieee_is_nan(change)) text(:10) = right_text(scientific_text(change, 2), 10)
      if (.not. ieee_is_nan(estimate)) then
         if (estimate < unknown) text(11:) = right_text(scientific_text(estimate, 1), 10)
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
      text = integer_text(held)//" of "//integer_text(known)//" changes are within their estimates"
   end function sizes

end module camroller_audit_page
