!> The table of a study for the screen: one line for each way and setting, over all cases.
!>
!> In: the table of a study. Out: text.
module camroller_study_page
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_number_text, only : counted, fixed_text, integer_text, number_text, right_text, scientific_text
   use camroller_study, only : dial_reference
   use camroller_study_table, only : study_table_t, word_length, column_of, words_of
   implicit none
   private

   public :: write_study_page

   character(len=*), parameter :: n = new_line("a")
   !> Columns of errors, and of work, in the order of the page
   character(len=*), parameter :: errors(*) = [character(len=20) :: "error_sliding_speed", "error_mean_friction", &
      & "error_smallest_film", "estimated_error"]
   character(len=*), parameter :: work(*) = [character(len=12) :: "evaluations", "steps"]

contains

   !> The page.
   subroutine write_study_page(table, text)
      !> Table of a study
      type(study_table_t), intent(in) :: table
      !> Lines with a heading
      character(len=:), allocatable, intent(out) :: text

      character(len=word_length), dimension(table%rows) :: ways, dials

      character(len=:), allocatable :: line
      logical :: is_same(table%rows), is_done(table%rows)
      ! Settings [unit of the dial]
      real(wp), allocatable :: settings(:)
      integer :: row

      text = "Largest errors over all cases; means of evaluations and steps, geometric mean of the time of a whole run"//n// &
         & "way                dial              setting   sliding      mean  smallest  estimated  evalua-   steps      time"// &
         & "  failed"//n// &
         & "                                                  speed  friction      film      error    tions              [ms]"
      settings = column_of(table, "setting")
      ways = words_of(table, "way")
      dials = words_of(table, "dial")
      is_done = .false.
      do row = 1, table%rows
         if (is_done(row)) cycle
         is_same = ways == ways(row) .and. dials == dials(row) .and. equal(settings, settings(row))
         is_done = is_done .or. is_same
         call write_line(table, row, is_same, line)
         text = text//n//line
      end do
      call add_notes(table, text)
      text = text//n
   end subroutine write_study_page

   !> Add lines on references that are not by the usual methods, one for all cases alike.
   subroutine add_notes(table, text)
      !> Table of a study
      type(study_table_t), intent(in) :: table
      !> The page; out: with the lines
      character(len=:), allocatable, intent(inout) :: text

      character(len=word_length) :: messages(table%rows)
      logical :: is_noted(table%rows)
      integer :: row, cases

      messages = words_of(table, "message")
      is_noted = words_of(table, "dial") == dial_reference .and. column_of(table, "status") <= 0.0_wp .and. messages /= ""
      do row = 1, table%rows
         if (.not. is_noted(row)) cycle
         cases = count(is_noted .and. messages == messages(row))
         text = text//n//trim(messages(row))//": "//counted(cases, "case")
         is_noted = is_noted .and. messages /= messages(row)
      end do
   end subroutine add_notes

   !> One line: all rows of one way with one setting.
   subroutine write_line(table, row, is_same, text)
      !> Table of a study
      type(study_table_t), intent(in) :: table
      !> The first of the rows
      integer, intent(in) :: row
      !> Which rows they are
      logical, intent(in) :: is_same(:)
      !> The line
      character(len=:), allocatable, intent(out) :: text

      character(len=word_length), dimension(table%rows) :: ways, dials, messages
      logical :: fine(size(is_same))
      ! Numbers of a column that are known [unit of the column]
      real(wp), allocatable :: values(:)
      integer :: i, failed

      ways = words_of(table, "way")
      dials = words_of(table, "dial")
      messages = words_of(table, "message")
      text = ways(row) (:18)//" "//dials(row) (:18)
      values = column_of(table, "setting")
      text = text//right_text(setting_text(values(row)), 8)
      fine = is_same .and. column_of(table, "status") <= 0.0_wp
      do i = 1, size(errors)
         values = known(column_of(table, trim(errors(i))), fine)
         if (size(values) > 0) text = text//right_text(scientific_text(maxval(values), 1), merge(11, 10, i == size(errors)))
         if (size(values) == 0) text = text//repeat(" ", merge(11, 10, i == size(errors)))
      end do
      do i = 1, size(work)
         values = known(column_of(table, trim(work(i))), fine)
         if (size(values) > 0) text = text//right_text(fixed_text(sum(values)/size(values), 0), 9)
         if (size(values) == 0) text = text//repeat(" ", 9)
      end do
      values = known(column_of(table, "time"), fine)
      if (size(values) > 0) then
         text = text//right_text(fixed_text(1.0e3_wp*exp(sum(log(max(values, tiny(1.0_wp))))/size(values)), 3), 11)
      end if
      failed = count(is_same) - count(fine)
      if (failed > 0) text = text//right_text(integer_text(failed), 132 - len(text) - 4)
      if (failed > 0 .and. dials(row) == dial_reference) then
         text = text(:46)//trim(messages(findloc(is_same .and. .not. fine, .true., 1)))
      end if
      text = trim(text)
   end subroutine write_line

   !> A setting in few digits; nothing where there is none.
   pure function setting_text(setting) result(text)
      !> The setting [unit of the dial]
      real(wp), intent(in) :: setting
      !> Its text
      character(len=8) :: text

      ! Settings below are written with an exponent [unit of the dial]
      real(wp), parameter :: small = 0.05_wp

      text = ""
      if (ieee_is_nan(setting)) return
      text = number_text(setting, 3)
      if (setting < small) text = scientific_text(setting, 0)
   end function setting_text

   !> Numbers of some rows that are numbers.
   pure function known(values, rows) result(list)
      !> Column [any]
      real(wp), intent(in) :: values(:)
      logical, intent(in) :: rows(:)
      !> Numbers [any]
      real(wp), allocatable :: list(:)

      list = pack(values, rows .and. .not. ieee_is_nan(values))
   end function known

   !> Which numbers are the same as one, or missing like it?
   elemental function equal(value, other) result(answer)
      !> Number and the other one [any]
      real(wp), intent(in) :: value, other
      !> Are they?
      logical :: answer

      answer = ieee_is_nan(value) .and. ieee_is_nan(other)
      if (.not. (ieee_is_nan(value) .or. ieee_is_nan(other))) answer = .not. abs(value - other) > 0.0_wp
   end function equal

end module camroller_study_page
