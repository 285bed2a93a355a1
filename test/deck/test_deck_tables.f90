!> Tests of tables that a deck names.
module test_deck_tables
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use deck_samples, only : changed_deck
   implicit none
   private

   public :: collect_deck_tables

   !> File that the tests write
   character(len=*), parameter :: path = "camroller_test_table.txt"
   character(len=*), parameter :: n = new_line("a")
   !> A lift of eleven rows around the nose at 180 degrees
   character(len=*), parameter :: first_rows = "# angle lift"//n//"130 0"//n//"140 1"//n//"150 2.5"//n//"160 4"//n//"170 5"//n
   character(len=*), parameter :: last_rows = "180 5.5 ! nose"//n//n//"190, 5"//n//"200; 4"//n//"210"//char(9)//"2.5"//n// &
      & "220 1"//n//"230 0.0"//n
   !> Values go through one multiplication and one division [-]
   real(wp), parameter :: round_off = 10.0_wp*epsilon(1.0_wp)

contains

   !> All tests of this suite.
   subroutine collect_deck_tables(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a lift table arrives in SI, from full lift", lift_in_si), &
         new_unittest("rows of zero lift outside of the event are left out", dwell_is_left_out), &
         new_unittest("noise on the base circle is taken with smoothing, rounding below zero always", noise_is_taken), &
         new_unittest("an event across the end of the table is told as such", event_across_the_end), &
         new_unittest("a pressure table is turned to begin half a turn before full lift", pressure_is_turned), &
         new_unittest("a pressure table covers one turn and ends as it begins", pressure_mistakes), &
         new_unittest("mistakes in a table are told with file and line", table_mistakes), &
         new_unittest("a table that cannot be read is told at the key that names it", no_table), &
         new_unittest("an override can name another table", other_table) &
         ]
   end subroutine collect_deck_tables

   subroutine lift_in_si(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case

      call lift_case(error, first_rows//last_rows, "table_unit = 'mm'", case)
      if (allocated(error)) return
      call check(error, size(case%lift%table_angle), 11)
      if (allocated(error)) return
      call check(error, case%lift%table_angle(1), -50.0_wp*degree, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%lift%table_angle(6), 0.0_wp, thr=round_off)
      if (allocated(error)) return
      call check(error, case%lift%table_lift(6), 5.5e-3_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call lift_case(error, first_rows//last_rows, "table_unit = 'um' table_nose_angle_deg = 185", case)
      if (allocated(error)) return
      call check(error, case%lift%table_lift(6), 5.5e-6_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%lift%table_angle(11), 45.0_wp*degree, rel=.true., thr=round_off)
   end subroutine lift_in_si

   subroutine dwell_is_left_out(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case

      call lift_case(error, "110 0"//n//"120 0"//n//first_rows//last_rows//"240 0", "", case)
      if (allocated(error)) return
      call check(error, size(case%lift%table_angle), 11)
   end subroutine dwell_is_left_out

   subroutine noise_is_taken(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: noisy = "110 0.004"//n//"120 -0.008"//n//first_rows//last_rows//"240 0.005"
      type(case_t) :: case

      call lift_case(error, noisy, "smoothing_um = 3", case)
      if (allocated(error)) return
      call expect(error, "120 0.004"//n//first_rows//last_rows, ":1: the lift must start at zero; where rows on the base "// &
         & "circle hold noise, set them to 0, or give 'smoothing_um' of &lift")
      if (allocated(error)) return
      call lift_case(error, "120 -5e-15"//n//first_rows//last_rows//"240 -5e-15", "", case)
      if (allocated(error)) return
      call check(error, all(case%lift%table_lift >= 0.0_wp), "lift below zero")
   end subroutine noise_is_taken

   subroutine event_across_the_end(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: rows
      character(len=16) :: row
      integer :: i

      rows = ""
      do i = 0, 360, 10
         write (row, '(i0, 1x, f6.3)') i, 5.0_wp*max(0.0_wp, cos(2.0_wp*i*degree))*merge(0.0_wp, 1.0_wp, abs(i - 180) < 60)
         rows = rows//trim(row)//n
      end do
      call expect(error, rows, ":1: the event runs across the end of the table: move the rows from 180 degrees on before the "// &
         & "others, at 360 degrees less, but for the last one, which is the first one again")
   end subroutine event_across_the_end

   subroutine pressure_is_turned(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case
      character(len=:), allocatable :: rows
      character(len=16) :: row
      integer :: i

      rows = ""
      do i = 0, 360, 30
         write (row, '(i0, 1x, i0)') i, modulo(i, 360)
         rows = rows//trim(row)//n
      end do
      call write_table(rows)
      call make(error, changed_deck("", "&gas_force table = '"//path//"' valve_diameter_mm = 20 table_nose_angle_deg = 90 /"), &
         & case)
      call remove_table()
      if (allocated(error)) return
      call check(error, size(case%gas_force%angle), 13)
      if (allocated(error)) return
      call check(error, all(case%gas_force%angle(2:) > case%gas_force%angle(:12)))
      if (allocated(error)) return
      call check(error, case%gas_force%angle(13), pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%gas_force%pressure(13), case%gas_force%pressure(1), thr=0.0_wp, message="one turn later")
      if (allocated(error)) return
      call check(error, case%gas_force%angle(1), -pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%gas_force%pressure(1), 270.0e5_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%gas_force%valve_area, pi*1.0e-4_wp, rel=.true., thr=round_off)
   end subroutine pressure_is_turned

   subroutine pressure_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: rows
      character(len=16) :: row
      integer :: i

      rows = ""
      do i = 0, 330, 30
         write (row, '(i0, 1x, i0)') i, i
         rows = rows//trim(row)//n
      end do
      call expect_pressure(error, rows//"360 10"//n, path//":13: the pressure must end as it begins, with 0")
      call expect_pressure(error, rows//"360 0"//n//"390 30"//n, path//":14: the table must cover one turn of the camshaft, "// &
         & "360 degrees, not 390; is the angle that of the crankshaft?")
      call expect_pressure(error, rows(:index(rows, "270") - 1), path//":9: the table must cover one turn")
      call expect_pressure(error, rows_in_radians(), path//":13: the table must cover one turn of the camshaft, 360 degrees, "// &
         & "not 6.28319; are the angles in radians? A table takes degrees")
      call expect_pressure(error, rows, "")
   end subroutine pressure_mistakes

   !> A turn of the cylinder pressure, with its angles in radians.
   function rows_in_radians() result(rows)
      character(len=24*13) :: rows

      integer :: i

      do i = 0, 12
         write (rows(24*i + 1:24*i + 24), '(f9.5, 1x, i13, a)') 30*i*degree, modulo(i, 12), n
      end do
   end function rows_in_radians

   !> A pressure table has one mistake, and its message begins with some words; none where these are blank.
   subroutine expect_pressure(error, rows, message)
      !> Outcome of the test; nothing is tried where it is known already
      type(error_type), allocatable, intent(inout) :: error
      !> The table
      character(len=*), intent(in) :: rows
      !> How the message begins
      character(len=*), intent(in) :: message

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      if (allocated(error)) return
      call write_table(rows)
      call read_text(changed_deck("", "&gas_force table = '"//path//"' valve_diameter_mm = 20 /"), deck, raised)
      call remove_table()
      if (allocated(raised) .neqv. message /= "") then
         call test_failed(error, "accepted or refused, against: "//message)
      else if (allocated(raised)) then
         if (index(raised%message, message) /= 1) call test_failed(error, raised%message)
      end if
   end subroutine expect_pressure

   subroutine table_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, first_rows//"165 5"//n//last_rows, ":7: the first column must increase; 165 follows 170")
      call expect(error, first_rows//"fast 5"//n//last_rows, ":7:1: 'fast' is no finite number")
      call expect(error, first_rows//"175 1e999"//n//last_rows, ":7:5: '1e999' is no finite number")
      call expect(error, first_rows//"175 nan"//n//last_rows, ":7:5: 'nan' is no finite number")
      call expect(error, first_rows//"175"//n//last_rows, ":7: a row has two columns, not 1")
      call expect(error, first_rows//"175 3 4"//n//last_rows, ":7: a row has two columns, not 3"//n)
      call expect(error, first_rows//"175 3,4"//n//last_rows, ":7: a row has two columns, not 3; a comma parts columns, "// &
         & "decimals have a point")
      call expect(error, "120 1"//n//first_rows//last_rows, ":1: the lift must start at zero")
      call expect(error, first_rows//last_rows//"240 1"//n, ":14: the lift must end at zero")
      call expect(error, first_rows//last_rows//"240 -1"//n//"250 0", ":14: negative lift")
      call expect(error, "-100 0"//n//first_rows//last_rows, ":3: the table has a gap from -100 to 130")
      call expect(error, "110 0"//n//"120 0"//n//first_rows//"210 2.5"//n//"220 1"//n//"230 0"//n, ":9: the lift has a gap "// &
         & "from 170 to 210, much wider than the distances beside it")
      call expect(error, "160 0"//n, ": the table has 1 of at least 8 rows")
      call expect(error, "", ": the table has 0 of at least 8 rows")
   end subroutine table_mistakes

   subroutine no_table(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      call read_text(changed_deck("exponents = 4", "law = 'table' table = 'no_such_file.txt'"), deck, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, index(raised%message, "sample.nml:5:75: there is no file 'no_such_file.txt'"), 1, raised%message)
   end subroutine no_table

   subroutine other_table(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call write_table(first_rows//last_rows)
      call read_text(changed_deck("exponents = 4", "law = 'table' table = '"//path//"'"), deck, raised)
      call write_table(first_rows//"170.5 5.0"//n//last_rows)
      if (.not. allocated(raised)) call make_case(deck, [override_t("lift.table=./"//path)], case, raised)
      call remove_table()
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, size(case%lift%table_angle), 12)
   end subroutine other_table

   !> A lift table has one mistake, and its message begins with some words.
   subroutine expect(error, rows, message)
      !> Outcome of the test; nothing is tried where it is known already
      type(error_type), allocatable, intent(inout) :: error
      !> The table
      character(len=*), intent(in) :: rows
      !> How the message begins, without the name of the table
      character(len=*), intent(in) :: message

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      if (allocated(error)) return
      call write_table(rows)
      call read_text(changed_deck("max_lift_mm = 9.5 opening_half_angle_deg = 70 exponents = 4", &
         & "law = 'table' table_unit = 'mm' table = '"//path//"'"), deck, raised)
      call remove_table()
      if (.not. allocated(raised)) then
         call test_failed(error, "accepted, not: "//message)
      else if (index(raised%message, path//message) /= 1 .and. index(raised%message, message) /= 1) then
         call test_failed(error, "expected '"//message//"', got '"//raised%message//"'")
      end if
   end subroutine expect

   !> Case with a lift table.
   subroutine lift_case(error, rows, keys, case)
      !> Outcome of the test
      type(error_type), allocatable, intent(out) :: error
      !> The table
      character(len=*), intent(in) :: rows
      !> More keys of the lift
      character(len=*), intent(in) :: keys
      !> The case
      type(case_t), intent(out) :: case

      call write_table(rows)
      call make(error, changed_deck("max_lift_mm = 9.5 opening_half_angle_deg = 70 exponents = 4", &
         & "law = 'table' table = '"//path//"' "//keys), case)
      call remove_table()
   end subroutine lift_case

   !> Case of a text.
   subroutine make(error, text, case)
      !> Outcome of the test
      type(error_type), allocatable, intent(out) :: error
      !> The deck
      character(len=*), intent(in) :: text
      !> The case
      type(case_t), intent(out) :: case

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(override_t) :: none(0)

      call read_text(text, deck, raised)
      if (.not. allocated(raised)) call make_case(deck, none, case, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
   end subroutine make

   !> Read a text as a deck in the present folder.
   subroutine read_text(text, deck, raised)
      !> The text
      character(len=*), intent(in) :: text
      !> The deck
      type(deck_t), intent(out) :: deck
      !> What the reader says
      type(error_t), allocatable, intent(out) :: raised

      type(override_t) :: none(0)

      call parse_deck(deck, text, "sample.nml", "", none, raised)
   end subroutine read_text

   !> Write the table.
   subroutine write_table(rows)
      !> Its rows
      character(len=*), intent(in) :: rows

      integer :: unit

      open (newunit=unit, file=path, status="replace", action="write", access="stream", form="unformatted")
      write (unit) rows
      close (unit)
   end subroutine write_table

   !> Remove the table.
   subroutine remove_table()
      integer :: unit

      open (newunit=unit, file=path, status="old")
      close (unit, status="delete")
   end subroutine remove_table

end module test_deck_tables
