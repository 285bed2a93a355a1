!> What every result file says of its run: the deck, values given beside it, tables, what varies, the build.
!>
!> Layer: app. In: a deck. Out: groups of a result file, from which the run can be repeated; a text that two runs of one sweep
!> have to agree on.
module camroller_run_facts
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_deck, only : deck_t
   use camroller_deck_document, only : echo_t, get_echo
   use camroller_deck_sweep, only : sweep_numbers, sweep_size, sweep_words
   use camroller_number_text, only : hexadecimal => hexadecimal_text, integer_text
   use camroller_output, only : output_t, write_deck, write_deck_table, write_overrides, write_run, write_sweep
   use camroller_part_file, only : study_facts_t
   use camroller_record, only : checksum, text_words
   use camroller_system_file, only : utc_date
   use camroller_table_file, only : table_t
   use camroller_version, only : version_text, build_commit, compiler_facts
   implicit none
   private

   public :: write_facts, study_facts, study_digest, shorten_options

   !> Keys that say how a sweep is run and nothing about its cases
   character(len=*), parameter :: keys_of_running(*) = [character(len=23) :: "sweep.wall_time_limit_s", "sweep.checkpoint_s"]

contains

   !> Deck, sweep and build into the result file.
   subroutine write_facts(writer, deck, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> The deck
      type(deck_t), intent(in) :: deck
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: words(:)
      !> Values of a key that varies [unit of the key]
      real(wp), allocatable :: numbers(:)
      type(echo_t) :: echo
      integer :: i

      call get_echo(deck, echo)
      call write_deck(writer, deck%text, echo%keys, echo%values, echo%units, echo%origins, error)
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
      if (.not. allocated(error)) call write_build(writer, deck, error)
   end subroutine write_facts

   !> What stands beside the deck: overrides and tables.
   subroutine write_beside(writer, deck, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> The deck
      type(deck_t), intent(in) :: deck
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: texts(:)
      integer :: i, length

      length = 1
      do i = 1, size(deck%overrides)
         length = max(length, len(deck%overrides(i)%text))
      end do
      allocate (character(len=length) :: texts(size(deck%overrides)))
      do i = 1, size(deck%overrides)
         texts(i) = deck%overrides(i)%text
      end do
      if (size(texts) > 0) call write_overrides(writer, texts, error)
      if (.not. allocated(error)) call write_table(writer, "lift", deck%tables%lift, error)
      if (.not. allocated(error)) call write_table(writer, "second_lift", deck%tables%second_lift, error)
      if (.not. allocated(error)) call write_table(writer, "gas_force", deck%tables%pressure, error)
   end subroutine write_beside

   !> A table of the deck, where there is one.
   subroutine write_table(writer, group, table, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> Group that names it
      character(len=*), intent(in) :: group
      !> The table
      type(table_t), intent(in) :: table
      !> File error
      type(error_t), allocatable, intent(out) :: error

      if (.not. allocated(table%path)) return
      call write_deck_table(writer, group, table%path, table%x, table%y, error)
   end subroutine write_table

   !> Program, build, date and command into the result file.
   subroutine write_build(writer, deck, error)
      !> The result file
      type(output_t), intent(inout) :: writer
      !> The deck
      type(deck_t), intent(in) :: deck
      !> File error
      type(error_t), allocatable, intent(out) :: error

      character(len=*), parameter :: names(*) = [character(len=8) :: "program", "version", "commit", "compiler", "options", &
         & "date", "command", "study"]
      character(len=:), allocatable :: compiler, options, command, values(:)
      type(study_facts_t) :: facts
      integer :: length

      call study_facts(deck, facts)
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
      call write_run(writer, names, values, error)
   end subroutine write_build

   !> What part files must agree on with a sweep: every value, a checksum of every table, the build.
   subroutine study_facts(deck, facts)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> What to agree on
      type(study_facts_t), intent(out) :: facts

      character(len=:), allocatable :: compiler, options
      type(echo_t) :: echo
      integer :: i

      facts%cases = sweep_size(deck%sweep)
      call get_echo(deck, echo)
      facts%deck = ""
      do i = 1, size(echo%keys)
         if (any(echo%keys(i) == keys_of_running)) cycle
         facts%deck = facts%deck//trim(echo%keys(i))//" = "//trim(echo%values(i))//new_line("a")
      end do
      call add_table(deck%tables%lift, facts%deck)
      call add_table(deck%tables%second_lift, facts%deck)
      call add_table(deck%tables%pressure, facts%deck)
      do i = 1, size(deck%sweep%axes)
         if (deck%sweep%axes(i)%values%count == 0) cycle
         facts%deck = facts%deck//"values of "//deck%sweep%axes(i)%key//" "// &
            & integer_text(deck%sweep%axes(i)%values%count)//" with checksum "// &
            & hexadecimal(checksum(text_words(deck%sweep%axes(i)%values%fields), 0_int64))//new_line("a")
      end do
      call compiler_facts(compiler, options)
      call shorten_options(options)
      facts%build = "version "//version_text//new_line("a")//"commit "//build_commit//new_line("a")//compiler// &
         & new_line("a")//options
   end subroutine study_facts

   !> Compiler options that may change a number: each once, without folders.
   subroutine shorten_options(options)
      !> The options
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

   !> Checksum of a table as a line of text.
   subroutine add_table(table, text)
      !> The table
      type(table_t), intent(in) :: table
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      if (.not. allocated(table%path)) return
      text = text//"table "//table%path//" with checksum "//hexadecimal(checksum([transfer(table%x, [0_int64]), &
         & transfer(table%y, [0_int64])], 0_int64))//new_line("a")
   end subroutine add_table

end module camroller_run_facts
