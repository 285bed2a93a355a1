!> A deck: read, checked, and turned into cases.
!>
!> In: a file or a text, and overrides `group.key=value`. Out: `deck_t`, from which a case is made for the deck as it stands, for
!> other overrides, or for each place of its sweep. All mistakes are reported at once.
module camroller_deck
   use camroller_error, only : error_t, raise, add_context, kind_usage
   use camroller_case, only : case_t
   use camroller_kinds, only : wp
   use camroller_number_text, only : append_number, integer_text
   use camroller_pivot, only : assumed_centre, assumed_inertia
   use camroller_case_columns, only : column_reader_t
   use camroller_mistakes, only : add_mistake, mistakes_t, raise_mistakes, override_place
   use camroller_text_file, only : read_standard_input, read_text_file, folder_of, utf8_mark
   use camroller_deck_include, only : expand_includes
   use camroller_deck_origins, only : origins_t, say_origin, place_mistakes
   use camroller_deck_text, only : deck_text_t, read_shape
   use camroller_text_encoding, only : check_encoding, first_foreign
   use camroller_deck_schema, only : schema_t
   use camroller_deck_keys, only : new_schema
   use camroller_settings, only : copy_settings, find_value, group_position, settings_t, take
   use camroller_deck_matching, only : override_t, add_override, new_settings, match_deck, apply_override, demand_required, &
      & fill_dependent_defaults
   use camroller_deck_relations, only : check_relations
   use camroller_deck_tables, only : deck_tables_t, obtain_tables
   use camroller_deck_case, only : fill_case
   use camroller_deck_sweep_read, only : read_sweep
   use camroller_deck_sweep, only : axis_of, sweep_t, sweep_size, sweep_overrides, case_in_words
   implicit none
   private

   public :: deck_t, override_t, add_override, read_deck, parse_deck, read_again, make_settings, make_case, make_sweep_case
   public :: add_places, drop_sweep, is_read

   !> A deck without mistakes
   type :: deck_t
      !> Name for messages, usually the path
      character(len=:), allocatable :: name
      !> Folder that the paths in it start at, with `/` at its end; blank for the present one
      character(len=:), allocatable :: folder
      !> The deck as given, with the lines of the files that it includes, but for what it replaces there or leaves out
      character(len=:), allocatable :: text
      !> Where its lines are from
      type(origins_t) :: origins
      !> What a deck may hold
      type(schema_t) :: schema
      !> Its lines, groups and keys
      type(deck_text_t) :: shape
      !> Its values, those given beside it included
      type(settings_t) :: settings
      !> Tables that it names
      type(deck_tables_t) :: tables
      !> Its cases
      type(sweep_t) :: sweep
      !> Values given beside it
      type(override_t), allocatable :: overrides(:)
   end type deck_t

contains

   !> Read a deck from a file, or from the standard input where the path is `-`.
   subroutine read_deck(deck, path, overrides, error, reader)
      !> The deck
      type(deck_t), intent(out) :: deck
      !> Path of the file; blanks at its end are none of it
      character(len=*), intent(in) :: path
      !> Values given beside the deck
      type(override_t), intent(in) :: overrides(:)
      !> File error where it cannot be read, deck error with all mistakes in it
      type(error_t), allocatable, intent(out) :: error
      !> Reader of tables of cases that are no text
      class(column_reader_t), intent(in), optional :: reader

      character(len=:), allocatable :: text

      if (path == "-") then
         call read_standard_input(text, error)
      else
         call read_text_file(trim(path), text, error)
      end if
      if (allocated(error)) return
      if (path == "-") then
         call parse_deck(deck, text, "standard input", "", overrides, error, reader=reader)
      else
         call parse_deck(deck, text, trim(path), folder_of(path), overrides, error, reader=reader)
      end if
   end subroutine read_deck

   !> Read a deck from a text.
   subroutine parse_deck(deck, text, name, folder, overrides, error, tables, reader)
      !> The deck
      type(deck_t), intent(out) :: deck
      !> Its text, in UTF-8, with or without that mark at its start
      character(len=*), intent(in) :: text
      !> Name for messages
      character(len=*), intent(in) :: name
      !> Folder that the paths in it start at, with `/` at its end; blank for the present one
      character(len=*), intent(in) :: folder
      !> Values given beside the deck
      type(override_t), intent(in) :: overrides(:)
      !> Deck error with all mistakes
      type(error_t), allocatable, intent(out) :: error
      !> Tables that are at hand; others are read from their files
      type(deck_tables_t), intent(in), optional :: tables
      !> Reader of tables of cases that are no text
      class(column_reader_t), intent(in), optional :: reader

      type(mistakes_t) :: mistakes, consequences
      integer :: first

      first = 1
      if (index(text, utf8_mark) == 1) first = 1 + len(utf8_mark)
      if (present(tables)) deck%tables = tables
      allocate (deck%overrides, source=overrides)
      deck%name = name
      deck%folder = folder
      call expand_includes(text(first:), folder, deck%text, deck%origins, mistakes)
      call new_schema(deck%schema)
      if (mistakes%count > 0) then
         ! What is missing then, or there twice, follows from it
         call read_shape(deck%text, deck%shape, consequences)
         call place_mistakes(deck%origins, mistakes)
         call raise_mistakes(mistakes, name, deck%shape%lines, error)
         return
      end if
      call read_text(deck, error, reader)
   end subroutine parse_deck

   !> Read a deck again with other values given beside it; its lines keep their places in the files that they are from.
   subroutine read_again(deck, given, overrides, error)
      !> The deck
      type(deck_t), intent(out) :: deck
      !> The deck as it was read
      type(deck_t), intent(in) :: given
      !> All values given beside the deck
      type(override_t), intent(in) :: overrides(:)
      !> Deck error with all mistakes
      type(error_t), allocatable, intent(out) :: error

      deck%name = given%name
      deck%folder = given%folder
      deck%text = given%text
      deck%origins = given%origins
      deck%schema = given%schema
      deck%tables = given%tables
      allocate (deck%overrides, source=overrides)
      call read_text(deck, error)
   end subroutine read_again

   !> Settings, tables and sweep of a deck from its text and the values given beside it.
   subroutine read_text(deck, error, reader)
      type(deck_t), intent(inout) :: deck
      !> Deck error with all mistakes
      type(error_t), allocatable, intent(out) :: error
      !> Reader of tables of cases that are no text
      class(column_reader_t), intent(in), optional :: reader

      type(mistakes_t) :: mistakes
      integer :: i

      call new_settings(deck%schema, deck%settings)
      call read_shape(deck%text, deck%shape, mistakes)
      call check_encoding(deck%shape%lines, mistakes)
      call match_deck(deck%schema, deck%shape, deck%settings, mistakes)
      do i = 1, size(deck%overrides)
         associate (override => deck%overrides(i))
            call apply_override(deck%schema, override, deck%settings, mistakes)
            if (first_foreign(override%text) > 0) call add_mistake(mistakes, "the value is no UTF-8", 0, 1, len(override%text), &
               & override_place, override%text)
         end associate
      end do
      call demand_required(deck%schema, deck%settings, mistakes)
      call complete(deck%settings, deck%folder, deck%tables, mistakes)
      call read_sweep(deck%schema, deck%settings, deck%folder, deck%sweep, mistakes, reader)
      call place_mistakes(deck%origins, mistakes)
      call raise_mistakes(mistakes, deck%name, deck%shape%lines, error)
   end subroutine read_text

   !> Values that follow from others, rules, tables.
   subroutine complete(settings, folder, tables, mistakes)
      type(settings_t), intent(inout) :: settings
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      !> Tables at hand
      type(deck_tables_t), intent(inout) :: tables
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      call fill_dependent_defaults(settings)
      call fill_finger(settings)
      call check_relations(settings, mistakes)
      call obtain_tables(settings, folder, tables, mistakes)
   end subroutine complete

   !> Inertia and centre of mass of the finger where the deck has none: what the model takes then.
   subroutine fill_finger(settings)
      type(settings_t), intent(inout) :: settings

      ! Mass [kg], distance from the pivot to the pad [m], inertia [kg m^2]
      real(wp) :: mass, pad, inertia

      mass = 0.0_wp
      pad = 0.0_wp
      inertia = 0.0_wp
      call take(settings, "masses", "finger_kg", mass)
      call take(settings, "mechanism", "pivot_to_pad_mm", pad)
      call assume("finger_inertia_kg_m2", assumed_inertia(mass, pad), 1.0_wp)
      call take(settings, "masses", "finger_inertia_kg_m2", inertia)
      call assume("finger_centre_mm", assumed_centre(mass, inertia), 1.0e3_wp)

   contains

      !> Give a key that the deck does not give its number, or none where that is zero.
      subroutine assume(key, number, factor)
         !> Name of the key
         character(len=*), intent(in) :: key
         !> The number [SI unit]
         real(wp), intent(in) :: number
         !> What makes it one in the unit of the key [unit of the key over SI unit]
         real(wp), intent(in) :: factor

         associate (value => settings%values(find_value(settings, "masses", key)))
            if (value%is_given) return
            value%is_known = number > 0.0_wp
            value%numbers = [number]
            if (.not. allocated(value%text)) return
            value%text = ""
            call append_number(value%text, factor*number)
         end associate
      end subroutine assume

   end subroutine fill_finger

   !> Case of a deck, with other values for some keys.
   subroutine make_case(deck, overrides, case, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Values other than the deck's
      type(override_t), intent(in) :: overrides(:)
      !> The case
      type(case_t), intent(out) :: case
      !> Deck error where the values do not fit the deck or each other; usage error where the deck was not read
      type(error_t), allocatable, intent(out) :: error

      type(settings_t) :: settings
      type(deck_tables_t) :: tables

      if (.not. is_read(deck)) then
         call raise(error, kind_usage, "make_case: the deck has not been read; call read_deck or parse_deck first")
         return
      end if
      if (size(overrides) == 0) then
         call fill_case(deck%settings, deck%tables, case)
         return
      end if
      call make_settings(deck, overrides, settings, tables, error)
      if (.not. allocated(error)) call fill_case(settings, tables, case)
   end subroutine make_case

   !> Settings and tables of a deck, with other values for some keys.
   subroutine make_settings(deck, overrides, settings, tables, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Values other than the deck's
      type(override_t), intent(in) :: overrides(:)
      !> The settings, without texts of values as given
      type(settings_t), intent(out) :: settings
      !> The tables that they name
      type(deck_tables_t), intent(out) :: tables
      !> Deck error where the values do not fit the deck or each other
      type(error_t), allocatable, intent(out) :: error

      type(mistakes_t) :: mistakes
      integer :: i

      call copy_settings(deck%settings, settings)
      tables = deck%tables
      do i = 1, size(overrides)
         call apply_override(deck%schema, overrides(i), settings, mistakes)
      end do
      call complete(settings, deck%folder, tables, mistakes)
      call place_mistakes(deck%origins, mistakes)
      call raise_mistakes(mistakes, deck%name, deck%shape%lines, error)
   end subroutine make_settings

   !> Has a deck been read?
   pure function is_read(deck) result(verdict)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Has it?
      logical :: verdict

      verdict = allocated(deck%text)
   end function is_read

   !> Case at a place of the deck's sweep.
   subroutine make_sweep_case(deck, case_number, case, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Number of the case, from 1 to `sweep_size(deck%sweep)`
      integer, intent(in) :: case_number
      !> The case
      type(case_t), intent(out) :: case
      !> Deck error where its values do not fit each other, usage error where there is no such case
      type(error_t), allocatable, intent(out) :: error

      type(override_t), allocatable :: overrides(:)

      if (case_number < 1 .or. case_number > sweep_size(deck%sweep)) then
         call raise(error, kind_usage, "the sweep has no case "//integer_text(case_number))
         return
      end if
      call sweep_overrides(deck%sweep, case_number, overrides)
      call make_case(deck, overrides, case, error)
      if (allocated(error) .and. size(overrides) > 0) call add_context(error, case_in_words(deck%sweep, case_number))
   end subroutine make_sweep_case

   !> Take a deck as it stands, without its sweep, which is taken out of its text too, so that a result of it can be repeated.
   !> Blanks in its place keep all other lines in theirs.
   subroutine drop_sweep(deck)
      !> The deck
      type(deck_t), intent(inout) :: deck

      integer :: i, k, first, next

      associate (shape => deck%shape)
         do i = 1, size(shape%groups)
            if (shape%groups(i)%name /= "sweep") cycle
            first = shape%lines%first(shape%groups(i)%line) + shape%groups(i)%column - 1
            next = len(deck%text) + 1
            if (i < size(shape%groups)) next = shape%lines%first(shape%groups(i + 1)%line) + shape%groups(i + 1)%column - 1
            do k = first, next - 1
               if (deck%text(k:k) /= new_line("a")) deck%text(k:k) = " "
            end do
            exit
         end do
      end associate
      deck%sweep%axes = deck%sweep%axes(:0)
      deck%sweep%measured = deck%sweep%measured(:0)
      deck%sweep%kind = "grid"
      deck%settings%groups(group_position(deck%settings, "sweep"))%is_present = .false.
   end subroutine drop_sweep

   !> Add to an error the places of the keys that it names, as `group.key`: where the deck gives them.
   subroutine add_places(deck, error)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> An error on its way up; left alone where not allocated
      type(error_t), allocatable, intent(inout) :: error

      character(len=:), allocatable :: name, places, origin
      integer :: i

      if (.not. allocated(error)) return
      places = ""
      do i = 1, deck%schema%key_count
         associate (key => deck%schema%keys(i), value => deck%settings%values(i))
            name = trim(deck%schema%groups(key%group)%name)//"."//trim(key%name)
            if (.not. names_key(error%message, name) .or. axis_of(deck%sweep, name) > 0) cycle
            if (allocated(value%source)) then
               places = places//new_line("a")//override_place//": "//value%source
            else if (value%line > 0) then
               call say_origin(deck%origins, deck%name, value%line, origin)
               places = places//new_line("a")//origin//": "//name//" = "//value%text
            end if
         end associate
      end do
      error%message = error%message//places
   end subroutine add_places

   !> Does a sentence name a key, and not one whose name only begins alike?
   pure function names_key(sentence, name) result(verdict)
      character(len=*), intent(in) :: sentence
      !> As `group.key`
      character(len=*), intent(in) :: name
      !> Does it?
      logical :: verdict

      integer :: place, behind

      place = index(sentence, name)
      verdict = place > 0
      behind = place + len(name)
      if (verdict .and. behind <= len(sentence)) verdict = scan(sentence(behind:behind), "_=") == 0
   end function names_key

end module camroller_deck
