!> The table of an audit as text.
!>
!> In: the table. Out: lines, one for each run of each case.
module camroller_audit_page
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_audit, only : judged, run_listed
   use camroller_number_text, only : fixed_text, scientific_text, integer_text, right_text
   use camroller_study_table, only : study_table_t, word_length, column_of, words_of
   implicit none
   private

   public :: write_audit_page

   character(len=*), parameter :: n = new_line("a")
   !> Longest line
   integer, parameter :: width = 132
   !> Part of a change that the accuracy of both runs may leave [-]
   real(wp), parameter :: accuracy_left = 3.0e-4_wp

contains

   !> One line for each run.
   subroutine write_audit_page(table, text)
      !> Table of an audit
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable, intent(out) :: text

      character(len=width) :: line
      character(len=word_length), dimension(table%rows) :: effects, runs, messages
      ! Case, status [-], time [s], its share [-], choice [-]; changes and estimates, shape (row, quantity) [-]
      real(wp), dimension(table%rows) :: cases, status, time, time_share, is_left_out
      real(wp), dimension(table%rows, size(judged)) :: changes, estimates
      integer :: row, i

      effects = words_of(table, "effect")
      runs = words_of(table, "run")
      messages = words_of(table, "message")
      cases = column_of(table, "case")
      status = column_of(table, "status")
      time = column_of(table, "time")
      time_share = column_of(table, "time_share")
      is_left_out = column_of(table, "is_left_out")
      do i = 1, size(judged)
         changes(:, i) = column_of(table, "change_"//trim(judged(i)))
         estimates(:, i) = column_of(table, "estimate_"//trim(judged(i)))
      end do
      text = "Changes relative to the run with all effects (for a single one: with none), and estimates before the run"//n// &
         & "case run      effect              mean torque          smallest film        slip per turn        time   share  "// &
         & "needed"//n// &
         & "                                  change   expected    change   expected    change   expected    [ms]   [%]"
      do row = 1, table%rows
         line = right_text(integer_text(nint(cases(row))), 4)//" "//runs(row) (:8)//" "//effects(row) (:18)
         if (nint(status(row)) /= 0) then
            line(36:) = messages(row)
         else
            do i = 1, size(judged)
               line(12 + 21*i:) = pair(changes(row, i), estimates(row, i))
            end do
            line(97:) = right_text(fixed_text(1.0e3_wp*time(row), 2), 8)
            if (runs(row) /= run_listed) line(105:) = right_text(fixed_text(100.0_wp*time_share(row), 0), 7)
            if (.not. ieee_is_nan(is_left_out(row))) line(114:) = merge("left out", "kept    ", is_left_out(row) > 0.0_wp)
         end if
         text = text//n//trim(line)
      end do
      text = text//n//n
      call add_verdict(changes, estimates, text)
   end subroutine write_audit_page

   !> A change and what was expected.
   pure function pair(change, estimate) result(text)
      !> Both [-]
      real(wp), intent(in) :: change, estimate
      !> Both in words
      character(len=21) :: text

      text = ""
      if (.not. ieee_is_nan(change)) text(:10) = right_text(scientific_text(change, 2), 10)
      if (.not. ieee_is_nan(estimate)) then
         text(11:) = "     large"
         if (ieee_is_finite(estimate)) text(11:) = right_text(scientific_text(estimate, 1), 10)
      end if
   end function pair

   !> How often the estimates held.
   subroutine add_verdict(changes, estimates, text)
      !> Changes and estimates, not a number where there is none [-]
      real(wp), intent(in) :: changes(:, :), estimates(:, :)
      !> Gets a line
      character(len=:), allocatable, intent(inout) :: text

      integer :: i, k, held, known

      held = 0
      known = 0
      do k = 1, size(changes, 2)
         do i = 1, size(changes, 1)
            if (ieee_is_nan(changes(i, k)) .or. ieee_is_nan(estimates(i, k))) cycle
            known = known + 1
            if (abs(changes(i, k)) <= estimates(i, k) + accuracy_left) held = held + 1
         end do
      end do
      text = text//integer_text(held)//" of "//integer_text(known)//" changes are within their estimates"
   end subroutine add_verdict

end module camroller_audit_page
