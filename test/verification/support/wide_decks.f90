!> Decks drawn at random over everything that the schema of decks holds: every group, key and named choice, tables, ends of ranges.
!>
!> The generator walks through the schema itself, so a new choice of a key is drawn as soon as it is there; a new key with a number
!> has its usual range in `wide_numbers`. Rules that tie keys together are kept, so that a deck is hardly ever refused for a
!> contradiction; its geometry may be impossible.
module wide_decks
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp
   use camroller_deck_schema, only : schema_t, key_t, group_required, type_integer, type_integers, type_logical, &
      & type_name, type_number, type_numbers, type_text
   use camroller_deck_tables, only : deck_tables_t
   use camroller_table_file, only : table_t
   use random_decks, only : random_t, draw, start_random
   use wide_draft, only : draft_t, style_t, decided_number, draft_cams, draft_engine, draft_oil_and_train, has_source, is_allowed, &
      & keep_rules, may_have, needs_table
   use wide_lists, only : list_of_integers, list_of_numbers
   use wide_numbers, only : end_of_range, find_range, usual_t
   use wide_tables, only : draw_lift_table, draw_pressure_table
   use wide_words, only : deck_number, deck_word, number_words
   implicit none
   private

   public :: wide_deck_t, style_t, draw_wide_deck, save_wide_deck, left_out_groups, is_left_out

   !> A deck with the tables that it names
   type :: wide_deck_t
      !> Its text
      character(len=:), allocatable :: text
      !> Its tables
      type(deck_tables_t) :: tables
      !> Keys whose range is not known to the generator; blank where there are none
      character(len=:), allocatable :: unknown
   end type wide_deck_t

   !> Part of the decks that have a group which may be left out, and that give a key which may be left out [-]
   real(wp), parameter :: group_share = 0.75_wp, key_share = 0.5_wp
   !> Groups that are rarer than that, and their part of the decks [-]
   character(len=*), parameter :: rare_groups(*) = [character(len=12) :: "gas_force", "effects"]
   real(wp), parameter :: rare_shares(*) = [0.4_wp, 0.3_wp]
   !> Part of the decks with a choice that changes much, or that ends most cases [-]
   real(wp), parameter :: source_share = 0.3_wp, stop_share = 0.05_wp, needed_share = 0.2_wp
   !> Width of a bearing that the law of finite width takes for every diameter drawn [mm]
   real(wp), parameter :: widest_finite = 17.0_wp
   !> Groups that are not drawn, and why
   character(len=*), parameter :: left_out_groups(2, 1) = reshape([character(len=100) :: &
      & "sweep", "many cases of one deck, each of which is a deck that may be drawn; suites sweep, deck_sweep"], [2, 1])
   character(len=*), parameter :: nl = new_line("a")

contains

   !> Draw a deck.
   subroutine draw_wide_deck(seed, schema, style, deck)
      !> Any number
      integer, intent(in) :: seed
      !> Groups and keys
      type(schema_t), intent(in) :: schema
      !> How hard and slow it may be
      type(style_t), intent(in) :: style
      !> The deck
      type(wide_deck_t), intent(out) :: deck
      type(draft_t) :: draft
      type(random_t) :: random
      ! [-]
      real(wp) :: number
      integer :: group, key

      deck%text = ""
      deck%unknown = ""
      call start_stream(random, seed, "cams")
      call draft_cams(random, draft)
      call start_stream(random, seed, "engine")
      call draft_engine(random, draft)
      call start_stream(random, seed, "oil and train")
      call draft_oil_and_train(random, style, draft)
      do group = 1, schema%group_count
         call start_stream(random, seed, "&"//trim(schema%groups(group)%name))
         if (.not. (has_group(random, draft, style, schema, group) .or. (schema%groups(group)%name == "boundary_law" .and. &
            & needs_table(deck%text)))) cycle
         if (.not. may_have(draft, deck%text, trim(schema%groups(group)%name))) cycle
         deck%text = deck%text//"&"//trim(schema%groups(group)%name)//nl
         call draw(random, number)
         draft%is_first = number < 0.5_wp
         do key = schema%groups(group)%first, schema%groups(group)%last
            call start_stream(random, seed, trim(schema%groups(group)%name)//"."//trim(schema%keys(key)%name))
            call draw_key(random, draft, trim(schema%groups(group)%name), schema%keys(key), style, deck)
         end do
         deck%text = deck%text//"/"//nl
      end do
      call start_stream(random, seed, "tables")
      if (deck_word(deck%text, "lift", "law") == "table") call draw_lift_table(random, "lift", deck%text, deck%tables%lift)
      if (deck_word(deck%text, "second_lift", "law") == "table") call draw_lift_table(random, "second_lift", deck%text, &
         & deck%tables%second_lift)
      if (deck_word(deck%text, "gas_force", "table") /= "") call draw_pressure_table(random, deck%text, deck%tables%pressure)
   end subroutine draw_wide_deck

   !> Start the draws of one key, group or table: a new key of the schema leaves what a seed gives for all others as it is.
   subroutine start_stream(random, seed, name)
      !> The generator
      type(random_t), intent(out) :: random
      !> Seed of the deck
      integer, intent(in) :: seed
      !> What is drawn
      character(len=*), intent(in) :: name
      ! Knuth's multiplier and a prime below 2**31
      integer(int64), parameter :: factor = 2654435761_int64, modulus = 2147483647_int64
      ! [-]
      real(wp) :: number
      integer(int64) :: mixed
      integer :: i

      mixed = modulo(int(seed, int64)*factor, modulus)
      do i = 1, len(name)
         mixed = modulo(131_int64*mixed + ichar(name(i:i)), modulus)
      end do
      call start_random(random, int(mixed))
      ! The first numbers of seeds that are alike are alike
      do i = 1, 4
         call draw(random, number)
      end do
   end subroutine start_stream

   !> Is a group not drawn?
   pure function is_left_out(group)
      !> Its name
      character(len=*), intent(in) :: group
      logical :: is_left_out

      is_left_out = any(group == left_out_groups(1, :))
   end function is_left_out

   !> Is a group in the deck?
   function has_group(random, draft, style, schema, group)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> How hard and slow the deck may be
      type(style_t), intent(in) :: style
      !> Groups and keys
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: group
      logical :: has_group
      ! [-]
      real(wp) :: number, share
      integer :: i

      share = group_share
      do i = 1, size(rare_groups)
         if (schema%groups(group)%name == rare_groups(i)) share = rare_shares(i)
      end do
      if (schema%groups(group)%name == "ehl") share = style%ehl_share
      call draw(random, number)
      has_group = number < share
      if (schema%groups(group)%kind == group_required) has_group = .true.
      if (schema%groups(group)%name == "cam_bearings") has_group = draft%has_cams
      if (schema%groups(group)%name == "second_lift") has_group = draft%has_second
      if (schema%groups(group)%name == "engine") has_group = draft%has_engine
      if (schema%groups(group)%name == "dynamics") has_group = draft%has_dynamics
      if (schema%groups(group)%name == "spring_surge") has_group = draft%has_surge
      if (schema%groups(group)%name == "lash_adjuster") has_group = draft%has_adjuster
      if (schema%groups(group)%name == "tribofilm" .or. schema%groups(group)%name == "running_in") has_group = draft%has_hours
      if (is_left_out(schema%groups(group)%name)) has_group = .false.
   end function has_group

   !> Draw one key, or leave it out.
   subroutine draw_key(random, draft, group, key, style, deck)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The key
      type(key_t), intent(in) :: key
      !> How hard and slow the deck may be
      type(style_t), intent(in) :: style
      !> The deck so far
      type(wide_deck_t), intent(inout) :: deck
      character(len=:), allocatable :: words
      logical :: is_given
      ! [-]
      real(wp) :: number

      call draw(random, number)
      is_given = key%is_required .or. key%type == type_name .or. number < key_share
      call keep_rules(draft, deck%text, group, trim(key%name), is_given)
      if (.not. is_given) return
      words = ""
      select case (key%type)
      case (type_name)
         call draw_choice(random, style, draft, deck%text, group, key, words)
      case (type_number, type_integer)
         words = decided_number(draft, group//"."//trim(key%name))
         if (words == "") call draw_free_number(random, style, group, key, deck, words)
      case (type_logical)
         call draw(random, number)
         words = trim(merge(".true. ", ".false.", number < 0.5_wp .or. (key%name == "in_roller_balance" .and. &
            & .not. has_source(deck%text))))
      case (type_text)
         words = "'"//group//".txt'"
      case (type_numbers)
         call list_of_numbers(random, draft, deck%text, group//"."//trim(key%name), style%ends_share > 0.0_wp, words)
      case (type_integers)
         call list_of_integers(random, draft, deck%text, group//"."//trim(key%name), style%ends_share > 0.0_wp, words)
      end select
      if (words == "") deck%unknown = deck%unknown//" "//group//"."//trim(key%name)
      deck%text = deck%text//"   "//trim(key%name)//" = "//words//nl
   end subroutine draw_key

   !> Draw a number from its usual range, or at an end of what is allowed.
   subroutine draw_free_number(random, style, group, key, deck, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> How hard and slow the deck may be
      type(style_t), intent(in) :: style
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The key
      type(key_t), intent(in) :: key
      !> The deck so far
      type(wide_deck_t), intent(inout) :: deck
      !> The number
      character(len=:), allocatable, intent(out) :: words
      type(usual_t) :: usual
      logical :: is_known
      ! [-]; mass of the valve, which holds a third of the spring's [kg]
      real(wp) :: number, valve

      call find_range(group//"."//trim(key%name), usual, is_known)
      if (.not. is_known) deck%unknown = deck%unknown//" "//group//"."//trim(key%name)
      if (key%name == "width_mm" .and. deck_word(deck%text, group, "law") == "finite") usual%highest = widest_finite
      ! A pin fills the ring of the roller, and is as wide as its diameter at most; the ring may have been drawn of any size
      if (key%name == "pin_width_mm" .and. deck_word(deck%text, group, "pin_law") == "finite") usual%highest = max(usual%lowest, &
         & min(usual%highest, 2.0_wp*(deck_number(deck%text, "roller", "radius_mm") &
         & - deck_number(deck%text, "roller", "wall_thickness_mm"))))
      if (group == "spring_surge" .and. key%name == "mass_kg") then
         valve = deck_number(deck%text, "masses", "valve_kg")
         if (valve > 0.0_wp) usual%lowest = 0.3_wp*valve
         if (valve > 0.0_wp) usual%highest = 2.5_wp*valve
      end if
      call draw(random, number)
      if (number < style%ends_share) then
         call end_of_range(random, key%range, usual, words)
      else
         call draw_number(random, usual, words)
      end if
      if (key%type == type_integer) call make_whole(words)
   end subroutine draw_free_number

   !> Draw one of several names.
   subroutine draw_choice(random, style, draft, text, group, key, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> How hard and slow the deck may be
      type(style_t), intent(in) :: style
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The key
      type(key_t), intent(in) :: key
      !> The name, in quotes
      character(len=:), allocatable, intent(out) :: words
      ! [-]
      real(wp) :: number, share
      integer :: i

      share = 1.0_wp
      select case (group//"."//trim(key%name))
      case ("case.energy")
         share = source_share
      case ("film.range_policy", "case.contact_policy")
         share = stop_share
      case ("numerics.method")
         share = style%method_share
      case ("effects.select")
         share = needed_share
      end select
      call draw(random, number)
      words = key%default
      if (number >= share .and. share < 1.0_wp) return
      call draw(random, number)
      associate (first => merge(1, 2, share >= 1.0_wp))
         words = "'"//trim(key%choices(min(size(key%choices), first + int(number*(size(key%choices) - first + 1)))))//"'"
      end associate
      if (.not. is_allowed(draft, text, key, words)) words = key%default
      ! A default may stand for "not given"
      do i = 1, size(key%choices)
         if (is_allowed(draft, text, key, words)) exit
         words = "'"//trim(key%choices(i))//"'"
      end do
   end subroutine draw_choice

   !> Draw a number from its usual range.
   subroutine draw_number(random, usual, words)
      !> The generator
      type(random_t), intent(inout) :: random
      !> The usual range
      type(usual_t), intent(in) :: usual
      !> The number
      character(len=:), allocatable, intent(out) :: words
      ! [-], [unit of the key]
      real(wp) :: number, value

      call draw(random, number)
      value = usual%lowest + number*(usual%highest - usual%lowest)
      if (usual%is_wide) value = usual%lowest*(usual%highest/usual%lowest)**number
      ! A turn is a whole number of output steps
      if (usual%divides_turn) value = 360.0_wp/nint(360.0_wp/value)
      words = number_words(value)
   end subroutine draw_number

   !> A whole number in the place of any.
   subroutine make_whole(words)
      !> The number
      character(len=:), allocatable, intent(inout) :: words
      ! [unit of the key]
      real(wp) :: value
      character(len=12) :: buffer

      read (words, *) value
      write (buffer, "(i0)") nint(min(value, 1.0e9_wp))
      words = trim(buffer)
   end subroutine make_whole

   !> Write a deck and its tables to a folder of its own in that of the environment variable WIDE_FOLDER, if there is one.
   subroutine save_wide_deck(deck, name, remark)
      !> The deck
      type(wide_deck_t), intent(in) :: deck
      !> Name of its folder
      character(len=*), intent(in) :: name
      !> What is wrong with it: a comment
      character(len=*), intent(in) :: remark
      character(len=200) :: folder
      integer :: unit, status, i

      call get_environment_variable("WIDE_FOLDER", folder, status=status)
      if (status /= 0) return
      folder = trim(folder)//"/"//name
      call execute_command_line("mkdir -p "//trim(folder))
      open (newunit=unit, file=trim(folder)//"/deck.nml", action="write", status="replace")
      write (unit, "(a)", advance="no") "! "
      do i = 1, len(remark)
         write (unit, "(a)", advance="no") remark(i:i)
         if (remark(i:i) == new_line("a")) write (unit, "(a)", advance="no") "! "
      end do
      write (unit, "(a)") "", deck%text
      close (unit)
      call save_table(trim(folder), deck%tables%lift)
      call save_table(trim(folder), deck%tables%second_lift)
      call save_table(trim(folder), deck%tables%pressure)
   end subroutine save_wide_deck

   !> Write a table under the name that the deck has for it.
   subroutine save_table(folder, table)
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      !> The table
      type(table_t), intent(in) :: table
      integer :: unit, i

      if (.not. allocated(table%path)) return
      open (newunit=unit, file=folder//"/"//table%path, action="write", status="replace")
      write (unit, "(2es26.16e3)") (table%x(i), table%y(i), i=1, size(table%x))
      close (unit)
   end subroutine save_table

end module wide_decks
