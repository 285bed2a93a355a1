!> The command `study --film`: what the accuracy of a numerical film costs, over every case of a deck.
!>
!> Layer: app. In: the command line. Out: tables on the output unit and in a file. A case that cannot be solved is a row with
!> a message.
module camroller_film_study
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_case, only : case_t
   use camroller_cli, only : config_t
   use camroller_deck, only : deck_t, make_sweep_case
   use camroller_deck_sweep, only : sweep_size
   use camroller_number_text, only : counted, fixed_text, scientific_text, integer_text, right_text
   use camroller_output, only : output_t, abandon_output
   use camroller_progress, only : progress_t, show_progress, end_progress, seconds_since
   use camroller_streams, only : print_lines
   use camroller_study_contact, only : new_contact_table, study_contacts
   use camroller_study_file, only : write_study, close_study
   use camroller_study_film, only : new_film_table_table, study_film_table, new_cycle_table, study_cycle
   use camroller_study_table, only : study_table_t, column_of
   implicit none
   private

   public :: study_films

   !> Tables, and what they hold
   character(len=*), parameter :: table_names(*) = [character(len=10) :: "contacts", "film_table", "film_cycle"]
   character(len=*), parameter :: table_titles(*) = [character(len=56) :: "steady films over nodes", &
      & "tables of films over their accuracy", "contacts solved over the cycle, and runs"]
   !> Their positions
   integer, parameter :: contacts = 1, film_tables = 2, cycles = 3
   character(len=*), parameter :: n = new_line("a")
   !> Longest line
   integer, parameter :: width = 128

contains

   !> Study the films of a deck.
   subroutine study_films(deck, config, path, writer, progress, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What to do
      type(config_t), intent(in) :: config
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The file, with its facts
      type(output_t), intent(inout) :: writer
      !> How far the study is
      type(progress_t), intent(inout) :: progress
      !> What went wrong
      type(error_t), allocatable, intent(out) :: error

      type(study_table_t) :: tables(size(table_names))
      type(case_t) :: case
      integer :: i, k

      call new_contact_table(tables(contacts))
      call new_film_table_table(tables(film_tables))
      call new_cycle_table(tables(cycles))
      do i = 1, sweep_size(deck%sweep)
         call make_sweep_case(deck, i, case, error)
         if (allocated(error)) exit
         call study_contacts(tables(contacts), i, case, config%repeats)
         call study_film_table(tables(film_tables), i, case, config%repeats, config%is_quick)
         call study_cycle(tables(cycles), i, case, config%repeats, config%is_quick)
         call show_progress(progress, i, sweep_size(deck%sweep))
      end do
      call end_progress(progress)
      if (.not. allocated(error)) then
         do k = 1, size(tables)
            if (any(.not. ieee_is_nan(column_of(tables(k), "error_film_min")))) exit
         end do
         if (k > size(tables)) call raise(error, kind_convergence, "no film: "//trim(tables(contacts)%words(1, 2)))
      end if
      if (allocated(error)) then
         call abandon_output(writer)
         return
      end if
      call write_study(writer, table_names, table_titles, tables, error)
      if (.not. allocated(error)) call close_study(writer, error)
      if (allocated(error) .or. config%is_quiet) return
      call print_lines(contact_page(tables(contacts))//n//table_page(tables(film_tables))//n//cycle_page(tables(cycles))//n// &
         & path//": "//counted(sweep_size(deck%sweep), "case")//" in "//seconds_since(progress), error)
   end subroutine study_films

   !> Steady films: one line for each contact and number of nodes.
   function contact_page(table) result(text)
      !> The table
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      text = "Steady films against 1025 nodes, all cases: largest errors, geometric mean of times"//n// &
         & "contact          nodes   error of    of central  from nothing  from nearby  failed"//n// &
         & "                         film min.   film        [ms]          [ms]"//page(table, 1, "nodes", "", &
         & [character(len=24) :: "error_film_min", "error_film_central", "cold_time", "warm_time"])
   end function contact_page

   !> Tables of films: one line for each accuracy, and one for the film law.
   function table_page(table) result(text)
      !> The table
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      text = "Films as a law against a table of accuracy 1e-3, all cases: largest errors, geometric mean of time"//n// &
         & "film             accuracy   error of    of central  of mean     of mean    time of run  failed"//n// &
         & "                            film min.   film        slip        losses     [ms]"//page(table, 1, "accuracy", "", &
         & [character(len=24) :: "error_film_min", "error_film_central", "error_slip", "error_friction", "time"])
   end function table_page

   !> Contacts solved over the cycle: one line for each number of nodes and error of a step, and for each run.
   function cycle_page(table) result(text)
      !> The table
      type(study_table_t), intent(in) :: table
      !> The page
      character(len=:), allocatable :: text

      text = "Contacts solved over the cycle against 257 nodes and errors of a step of 3e-4, all cases: largest errors,"//n// &
         & "geometric mean of steps and time"//n// &
         & "model            nodes  step       error of    of mean    of mean     of mean     steps       time    failed"//n// &
         & "                        error      film min.   film min.  slip        losses                  [ms]"// &
         & page(table, 1, "nodes", "step_error", [character(len=24) :: "error_film_min", "error_mean_film", "error_slip", &
         & "error_friction", "steps", "time"])
   end function cycle_page

   !> Lines of a table: all rows with the same word and the same choices become one.
   function page(table, word, choice, other, names) result(text)
      !> The table
      type(study_table_t), intent(in) :: table
      !> Column with the word
      integer, intent(in) :: word
      !> Columns with the choices; the second may be blank
      character(len=*), intent(in) :: choice, other
      !> Columns that are shown: errors, then steps and times
      character(len=*), intent(in) :: names(:)
      !> The lines
      character(len=:), allocatable :: text

      character(len=width) :: line
      logical :: is_done(table%rows), is_same(table%rows), fine(table%rows)
      ! Numbers of a column, choices [unit of the column]
      real(wp), allocatable :: values(:), first(:), second(:)
      integer :: row, i, place

      text = ""
      is_done = .false.
      first = column_of(table, choice)
      second = first
      if (other /= "") second = column_of(table, other)
      fine = .not. ieee_is_nan(column_of(table, names(1)))
      do row = 1, table%rows
         if (is_done(row)) cycle
         if (table%words(row, word) == "") then
            text = text//n//trim(table%words(row, word + 1))
            cycle
         end if
         is_same = table%words(:table%rows, word) == table%words(row, word) .and. equal(first, first(row)) &
            & .and. equal(second, second(row))
         is_done = is_done .or. is_same
         line = table%words(row, word) (:16)
         place = 17
         if (.not. ieee_is_nan(first(row))) line(place:) = short(first(row))
         if (other /= "") place = place + 7
         if (other /= "" .and. .not. ieee_is_nan(second(row))) line(place:) = short(second(row))
         place = place + 7
         do i = 1, size(names)
            values = pack(column_of(table, names(i)), is_same .and. fine)
            if (size(values) > 0 .and. .not. any(ieee_is_nan(values))) line(place:) = shown(names(i), values)
            place = place + 12
         end do
         if (count(is_same .and. fine) < count(is_same)) then
            line(place:) = right_text(integer_text(count(is_same) - count(is_same .and. fine)), 6)
         end if
         text = text//n//trim(line)
      end do
      text = text//n
   end function page

   !> What is shown of a column: the largest error, the geometric mean of steps or of times in milliseconds.
   pure function shown(name, values) result(text)
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Its numbers [unit of the column]
      real(wp), intent(in) :: values(:)
      !> The text
      character(len=12) :: text

      if (index(name, "error") == 1) then
         text = right_text(scientific_text(maxval(values), 1), 12)
      else if (name == "steps") then
         text = right_text(fixed_text(exp(sum(log(values))/size(values)), 0), 12)
      else
         text = right_text(fixed_text(1.0e3_wp*exp(sum(log(values))/size(values)), 2), 12)
      end if
   end function shown

   !> A choice in few letters.
   pure function short(value) result(text)
      !> The choice [-]
      real(wp), intent(in) :: value
      !> The text
      character(len=7) :: text

      if (value >= 1.0_wp) then
         text = right_text(integer_text(nint(value)), 6)
      else
         text = right_text(scientific_text(value, 0), 7)
      end if
   end function short

   !> Numbers equal to one, none counting as a number of its own.
   pure function equal(values, value) result(answer)
      !> The numbers [any]
      real(wp), intent(in) :: values(:)
      !> The one [any]
      real(wp), intent(in) :: value
      !> The answer for each
      logical :: answer(size(values))

      if (ieee_is_nan(value)) then
         answer = ieee_is_nan(values)
      else
         answer = .not. ieee_is_nan(values)
         where (answer) answer = .not. abs(values - value) > 0.0_wp
      end if
   end function equal

end module camroller_film_study
