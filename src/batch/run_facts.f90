!> Facts of the run in every result file: the deck, values given beside it, tables, what varies, the build.
!>
!> In: a deck. Out: groups of a result file, from which the run can be repeated; a text that two runs of one sweep
!> have to agree on.
module camroller_run_facts
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_canonical_value, only : spell_value
   use camroller_case_columns, only : measured_prefix
   use camroller_deck, only : deck_t
   use camroller_deck_document, only : echo_t, get_echo
   use camroller_deck_files, only : list_case_tables
   use camroller_deck_remarks, only : list_deck_remarks
   use camroller_deck_tables, only : find_table, table_groups, wanted_columns
   use camroller_deck_sweep, only : measured_numbers, sweep_axis_t, sweep_numbers, sweep_size, sweep_t, sweep_words
   use camroller_hdf5_object, only : hdf5_object_t
   use camroller_hdf5_read, only : read_text_attribute
   use camroller_mistakes, only : mistakes_t
   use camroller_text_lines, only : add_line, line_t
   use camroller_number_text, only : hexadecimal => hexadecimal_text, integer_text, is_number
   use camroller_output, only : output_t, write_deck, write_deck_lines, write_deck_table, write_measured, &
      & write_run, write_sweep, write_table_count
   use camroller_part_scan, only : study_facts_t
   use camroller_quotes, only : without_quotes
   use camroller_record, only : checksum, text_words
   use camroller_settings, only : get_word
   use camroller_system_file, only : utc_date
   use camroller_table_file, only : read_table, table_t, write_heading
   use camroller_text_file, only : join_path
   use camroller_text_list, only : text_at
   use camroller_version, only : version_text, build_commit, compiler_facts
   implicit none
   private

   public :: write_facts, study_facts, study_digest, find_other_build

   !> Keys that say nothing about the cases: how a sweep is run, and where tables are, whose content counts
   character(len=*), parameter :: keys_beside_cases(*) = [character(len=23) :: "sweep.wall_time_limit_s", "sweep.checkpoint_s", &
      & "sweep.table", "lift.table", "second_lift.table", "gas_force.table"]

   !> Longest value that stands in the facts of a study as it is, in letters
   integer, parameter :: shown_value = 512

contains

   !> Deck, sweep and build into the result file.
   subroutine write_facts(writer, deck, of_runs, error, facts)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Is the file one of runs? A command that is none may use other keys
      logical, intent(in) :: of_runs
      !> File error
      type(error_t), allocatable, intent(out) :: error
      !> The study as it was when its first case was computed; without it, as it is now
      type(study_facts_t), intent(in), optional :: facts

      type(study_facts_t) :: present_facts
      character(len=:), allocatable :: words(:)
      !> Values of a key that varies [unit of the key]
      real(wp), allocatable :: numbers(:)
      type(echo_t) :: echo
      integer :: i

      call get_echo(deck, echo, of_runs)
      call write_deck(writer, deck%text, echo%keys, echo%values, echo%is_whole, echo%units, echo%origins, echo%is_used, error)
      if (.not. allocated(error)) call write_beside(writer, deck, error)
      do i = 1, size(deck%sweep%axes)
         if (allocated(error)) return
         associate (axis => deck%sweep%axes(i))
            if (axis%is_numeric) then
               call sweep_numbers(deck%sweep, i, numbers)
               call write_sweep(writer, axis%key, axis%unit, numbers, error)
            else
               call sweep_words(deck%sweep, i, words)
               call write_sweep(writer, axis%key, axis%unit, words, error)
            end if
         end associate
      end do
      if (allocated(error)) return
      if (size(deck%sweep%measured) > 0) call write_columns(writer, deck%sweep, error)
      if (allocated(error)) return
      if (present(facts)) then
         call write_build(writer, facts, error)
      else
         call study_facts(deck, present_facts)
         call write_build(writer, present_facts, error)
      end if
   end subroutine write_facts

   !> Measured values that a table of cases carried along.
   subroutine write_columns(writer, sweep, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      type(sweep_t), intent(in) :: sweep
      !> File error
      type(error_t), allocatable, intent(out) :: error

      ! Values of all columns and of one [units of the columns]
      real(wp), allocatable :: values(:, :), numbers(:)
      character(len=:), allocatable :: names(:)
      integer :: i, length

      length = maxval([(len(sweep%measured(i)%key), i=1, size(sweep%measured))])
      allocate (character(len=length) :: names(size(sweep%measured)))
      allocate (values(sweep_size(sweep), size(names)))
      do i = 1, size(names)
         names(i) = sweep%measured(i)%key
         call measured_numbers(sweep, i, numbers)
         values(:, i) = numbers
      end do
      call write_measured(writer, names, sweep%measured%unit, values, error)
   end subroutine write_columns

   !> What stands beside the deck: overrides, remarks and tables.
   subroutine write_beside(writer, deck, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      type(deck_t), intent(in) :: deck
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: overrides(:), remarks(:)
      integer :: i

      allocate (overrides(0))
      do i = 1, size(deck%overrides)
         call add_line(overrides, deck%overrides(i)%text)
      end do
      call list_deck_remarks(deck, remarks)
      call write_lines(writer, "overrides", overrides, error)
      if (.not. allocated(error)) call write_lines(writer, "remarks", remarks, error)
      do i = 1, size(table_groups)
         if (.not. allocated(error)) call write_tables(writer, deck, trim(table_groups(i)), error)
      end do
   end subroutine write_beside

   !> Lines of text, where there are any.
   subroutine write_lines(writer, name, lines, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> What they are called in the file
      character(len=*), intent(in) :: name
      type(line_t), intent(in) :: lines(:)
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: texts(:)
      integer :: i

      if (size(lines) == 0) return
      allocate (character(len=maxval([(len(lines(i)%text), i=1, size(lines))])) :: texts(size(lines)))
      do i = 1, size(lines)
         texts(i) = lines(i)%text
      end do
      call write_deck_lines(writer, name, texts, error)
   end subroutine write_lines

   !> The table of a group, where there is one, and those that cases name, under the names in the deck. One that cannot be read is
   !> left out: its cases have no result.
   subroutine write_tables(writer, deck, group, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      type(deck_t), intent(in) :: deck
      character(len=*), intent(in) :: group
      !> File error
      type(error_t), allocatable, intent(out) :: error

      type(line_t), allocatable :: names(:)
      type(table_t) :: table
      type(mistakes_t) :: mistakes
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: heading
      integer :: i

      call find_table(deck%tables, group, table)
      call write_heading(table, heading)
      if (allocated(table%path)) call write_deck_table(writer, group, table%path, heading, table%x, table%y, error)
      call list_case_tables(deck, group, names)
      if (size(names) > 0 .and. .not. allocated(error)) call write_table_count(writer, group, size(names), error)
      do i = 1, size(names)
         if (allocated(error)) return
         call read_table(join_path(deck%folder, names(i)%text), table, mistakes, failure, wanted_columns(deck%settings, group))
         if (allocated(failure) .or. size(table%x) == 0) cycle
         call write_heading(table, heading)
         call write_deck_table(writer, group//"_"//integer_text(i), names(i)%text, heading, table%x, table%y, error)
      end do
   end subroutine write_tables

   !> Program, build, date and command into the result file.
   subroutine write_build(writer, facts, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      type(study_facts_t), intent(in) :: facts
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: names(*) = [character(len=8) :: "program", "version", "commit", "compiler", "options", &
         & "date", "command", "study"]
      character(len=:), allocatable :: compiler, options, command, values(:)
      integer :: length

      call compiler_facts(compiler, options)
      call get_command(length=length)
      allocate (character(len=length) :: command)
      call get_command(command)
      allocate (character(len=max(len(compiler), len(options), length, len(build_commit), 20)) :: values(size(names)))
      values(1) = "camroller"
      values(2) = version_text
      values(3) = build_commit
      values(4) = compiler
      values(5) = options
      values(6) = utc_date()
      values(7) = command
      values(8) = study_digest(facts)
      call write_run(writer, names, values, facts%deck, error)
   end subroutine write_build

   !> What part files must agree on with a sweep: every value, a checksum of every table, the build. Where the deck and its tables
   !> are does not matter.
   subroutine study_facts(deck, facts)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What to agree on
      type(study_facts_t), intent(out) :: facts

      character(len=:), allocatable :: compiler, options, value
      type(echo_t) :: echo
      integer :: i

      facts%cases = sweep_size(deck%sweep)
      call get_echo(deck, echo, .true.)
      facts%deck = ""
      do i = 1, size(echo%keys)
         if (any(echo%keys(i) == keys_beside_cases)) cycle
         call spell_value(echo%values(i)%text, value)
         if (len(value) > shown_value) value = value(:shown_value)//" and so on, with checksum "// &
            & hexadecimal(checksum(text_words(value), 0_int64))
         facts%deck = facts%deck//trim(echo%keys(i))//" = "//value//new_line("a")
      end do
      do i = 1, size(table_groups)
         call add_tables(deck, trim(table_groups(i)), facts%deck)
      end do
      do i = 1, size(deck%sweep%axes)
         call add_values(deck%sweep%axes(i), "", facts%deck)
      end do
      do i = 1, size(deck%sweep%measured)
         call add_values(deck%sweep%measured(i), measured_prefix, facts%deck)
      end do
      call compiler_facts(compiler, options)
      call shorten_options(options)
      facts%build = "version "//version_text//new_line("a")//"commit "//build_commit//new_line("a")//compiler// &
         & new_line("a")//options
   end subroutine study_facts

   !> Number of values of a column and a checksum of them, where it has any: of numbers as such, however they are spelt.
   subroutine add_values(column, prefix, facts)
      type(sweep_axis_t), intent(in) :: column
      !> What its name begins with
      character(len=*), intent(in) :: prefix
      !> The facts so far
      character(len=:), allocatable, intent(inout) :: facts

      character(len=:), allocatable :: word
      real(wp) :: number ! [unit of the column]
      integer(int64) :: sum
      integer :: i, status

      if (column%values%count == 0) return
      sum = 0_int64
      do i = 1, column%values%count
         status = 1
         word = text_at(column%values, i)
         if (is_number(word)) read (word, *, iostat=status) number
         if (status == 0) then
            sum = checksum([transfer(number, 0_int64)], sum)
         else
            sum = checksum(text_words(without_quotes(word)), sum)
         end if
      end do
      facts = facts//"values of "//prefix//column%key//" "//integer_text(column%values%count)//" with checksum "// &
         & hexadecimal(sum)//new_line("a")
   end subroutine add_values

   !> Compiler options that may change a number: each once, without folders.
   subroutine shorten_options(options)
      character(len=:), allocatable, intent(inout) :: options

      character(len=*), parameter :: with_folder(*) = [character(len=2) :: "-I", "-J"]
      character(len=:), allocatable :: short, word
      integer :: first, length

      short = ""
      first = 1
      do while (first <= len(options))
         length = index(options(first:)//" ", " ") - 1
         word = options(first:first + length - 1)
         first = first + length + 1
         if (length == 0) cycle
         if (any(word == with_folder)) first = first + index(options(first:)//" ", " ")
         if (any(word(:min(2, length)) == with_folder) .or. index(word, "-fpre-include") == 1) cycle
         if (index(" "//short//" ", " "//word//" ") == 0) short = short//" "//word
      end do
      options = adjustl(short)
   end subroutine shorten_options

   !> A few letters that two studies have in common only where all their facts agree.
   function study_digest(facts) result(digest)
      !> What they have to agree on
      type(study_facts_t), intent(in) :: facts
      !> The letters
      character(len=16) :: digest

      digest = hexadecimal(checksum(text_words(facts%deck//facts%build), int(facts%cases, int64)))
   end function study_digest

   !> Checksums of the tables that a group names in the deck or in any of its cases, a line of text for each.
   subroutine add_tables(deck, group, text)
      type(deck_t), intent(in) :: deck
      character(len=*), intent(in) :: group
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: name
      integer :: i, k

      call add_table(deck, group, get_word(deck%settings, group, "table"), text)
      do i = 1, size(deck%sweep%axes)
         associate (axis => deck%sweep%axes(i))
            if (axis%key /= group//".table") cycle
            do k = 1, axis%values%count
               name = text_at(axis%values, k)
               if (k > 1) then
                  if (name == text_at(axis%values, k - 1)) cycle
               end if
               call add_table(deck, group, without_quotes(name), text)
            end do
         end associate
      end do
   end subroutine add_tables

   !> Checksum of a table as a line of text.
   subroutine add_table(deck, group, name, text)
      type(deck_t), intent(in) :: deck
      !> Group that names the table
      character(len=*), intent(in) :: group
      !> Its name in the deck; blank where there is none
      character(len=*), intent(in) :: name
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      type(table_t) :: table
      type(mistakes_t) :: mistakes
      type(error_t), allocatable :: error
      logical :: is_at_hand

      if (name == "") return
      call find_table(deck%tables, group, table)
      is_at_hand = allocated(table%path)
      if (is_at_hand) is_at_hand = table%path == join_path(deck%folder, name)
      if (.not. is_at_hand) call read_table(join_path(deck%folder, name), table, mistakes, error, &
         & wanted_columns(deck%settings, group))
      text = text//"table of &"//group//" with checksum "//hexadecimal(checksum([transfer(table%x, [0_int64]), &
         & transfer(table%y, [0_int64])], 0_int64))//new_line("a")
   end subroutine add_table

   !> Differences between the build of a file and this one, a line for each fact.
   subroutine find_other_build(file, facts, error)
      !> The file, open
      type(hdf5_object_t), intent(in) :: file
      !> Lines
      character(len=:), allocatable, intent(out) :: facts
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: compiler, options

      facts = ""
      call compiler_facts(compiler, options)
      call shorten_options(options)
      call compare_fact("version", version_text)
      if (.not. allocated(error)) call compare_fact("commit", build_commit)
      if (.not. allocated(error)) call compare_fact("compiler", compiler)
      if (.not. allocated(error)) call compare_fact("options", options)

   contains

      !> Add a line where a fact differs.
      subroutine compare_fact(name, present_value)
         !> Name of the fact, and what it is for this program
         character(len=*), intent(in) :: name, present_value

         character(len=:), allocatable :: stored

         call read_text_attribute(file, "/run", name, stored, error)
         if (allocated(error)) return
         if (name == "options") call shorten_options(stored)
         if (stored == present_value) return
         facts = facts//new_line("a")//"  "//name//": '"//stored//"' made the file, this is '"//present_value//"'"
      end subroutine compare_fact

   end subroutine find_other_build

end module camroller_run_facts
