!> Decks described: the complete deck with every key explained, the same as a page, and the values that a deck comes to.
!>
!> In: the schema, or a deck. Out: text, or lists of strings.
module camroller_deck_document
   use camroller_deck_bounds, only : write_bounds
   use camroller_deck_schema, only : schema_t, key_t, find_group, group_names, say_allowed, say_usual, group_required, &
      & group_standard, group_effect, type_number, type_integer, type_logical, type_name, type_text, type_numbers, &
      & type_integers, key_length
   use camroller_deck_keys, only : new_schema
   use camroller_key_uses, only : is_idle, say_use
   use camroller_deck, only : deck_t
   use camroller_error, only : error_t, raise, kind_usage
   use camroller_near_names, only : nearest_name
   use camroller_names, only : write_names
   use camroller_text_lines, only : line_t
   use camroller_units, only : unit_name_length
   implicit none
   private

   public :: echo_t, get_echo, write_defaults, write_page, write_resolved, given_numbers

   !> Width of a `key = value` before the comment on it
   integer, parameter :: comment_column = 46
   !> Groups whose numbers say nothing about the valve train
   character(len=*), parameter :: no_physics(*) = [character(len=7) :: "output", "sweep", "effects"]
   !> Length of a line of comment
   integer, parameter :: comment_width = 118

   !> Values that follow from a deck, as text: one place in each list for one key
   type :: echo_t
      !> As `group.key`
      character(len=2*key_length), allocatable :: keys(:)
      !> Value in the unit of the key
      type(line_t), allocatable :: values(:)
      !> Unit; `1` for none
      character(len=unit_name_length), allocatable :: units(:)
      !> `given` or `default`
      character(len=8), allocatable :: origins(:)
      !> Is it a whole number? May it change anything in a case of the deck?
      logical, allocatable :: is_whole(:), is_used(:)
   end type echo_t

contains

   !> Every value of the groups that a deck has or takes by default.
   subroutine get_echo(deck, echo, of_runs)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Its values
      type(echo_t), intent(out) :: echo
      !> Is it used by runs, or by any command?
      logical, intent(in) :: of_runs

      integer :: i, n

      n = count(is_shown(deck, [(i, i=1, deck%schema%key_count)]))
      allocate (echo%keys(n), echo%values(n), echo%units(n), echo%origins(n), echo%is_whole(n), echo%is_used(n))
      n = 0
      do i = 1, deck%schema%key_count
         if (.not. is_shown(deck, i)) cycle
         n = n + 1
         associate (key => deck%schema%keys(i), value => deck%settings%values(i))
            echo%keys(n) = trim(deck%schema%groups(key%group)%name)//"."//key%name
            echo%values(n)%text = value%text
            echo%units(n) = key%unit%symbol
            echo%origins(n) = merge("given  ", "default", value%is_given)
            echo%is_whole(n) = key%type == type_integer
            echo%is_used(n) = .not. is_idle(deck%settings, deck%sweep, trim(echo%keys(n)), of_runs)
         end associate
      end do
   end subroutine get_echo

   !> Keys that a deck gives with one number each, outside its sweep and output: what a host may want to vary.
   subroutine given_numbers(deck, positions)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Their positions in the schema
      integer, allocatable, intent(out) :: positions(:)

      logical, allocatable :: is_wanted(:)
      integer :: i

      allocate (is_wanted(deck%schema%key_count))
      do i = 1, size(is_wanted)
         associate (key => deck%schema%keys(i), value => deck%settings%values(i))
            is_wanted(i) = value%is_known .and. value%is_given .and. any(key%type == [type_number, type_integer]) .and. &
               & .not. any(deck%schema%groups(key%group)%name == no_physics)
         end associate
      end do
      positions = pack([(i, i=1, size(is_wanted))], is_wanted)
   end subroutine given_numbers

   !> Has a key a value in a group that is in use?
   elemental function is_shown(deck, position) result(verdict)
      type(deck_t), intent(in) :: deck
      !> Position of the key
      integer, intent(in) :: position
      !> Has it?
      logical :: verdict

      integer :: group

      group = deck%schema%keys(position)%group
      verdict = deck%settings%values(position)%is_known .and. &
         & (deck%settings%groups(group)%is_present .or. deck%schema%groups(group)%kind /= group_effect)
   end function is_shown

   !> The deck with every value that it comes to, as a deck; defaults are marked.
   subroutine write_resolved(deck, text, is_short)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> A deck with the same cases
      character(len=:), allocatable, intent(out) :: text
      !> Only what the deck or the words beside it give? Some keys may not be given where others are, not even their defaults
      logical, intent(in), optional :: is_short

      integer :: i, j
      logical :: has_defaults

      text = ""
      has_defaults = .true.
      if (present(is_short)) has_defaults = .not. is_short
      do i = 1, deck%schema%group_count
         associate (group => deck%schema%groups(i))
            if (group%kind == group_effect .and. .not. deck%settings%groups(i)%is_present) cycle
            text = text//"&"//trim(group%name)//new_line("a")
            do j = group%first, group%last
               if (.not. is_shown(deck, j) .or. .not. (has_defaults .or. deck%settings%values(j)%is_given)) cycle
               call add_line("   "//trim(deck%schema%keys(j)%name)//" = "//deck%settings%values(j)%text, &
                  & trim(merge("       ", "default", deck%settings%values(j)%is_given)), text)
            end do
            text = text//"/"//new_line("a")
         end associate
      end do
   end subroutine write_resolved

   !> The complete deck with every key explained: ready to be run, with the effects as comments.
   subroutine write_defaults(group, text, error)
      !> The only group wanted; blank for all
      character(len=*), intent(in) :: group
      !> A deck
      character(len=:), allocatable, intent(out) :: text
      !> Usage error where there is no such group
      type(error_t), allocatable, intent(out) :: error

      type(schema_t) :: schema
      integer :: i, wanted

      call new_schema(schema)
      call find_wanted(schema, group, wanted, error)
      if (allocated(error)) return
      text = ""
      if (wanted > 0) then
         call write_group(schema, wanted, "", text)
         return
      end if
      text = "! Every key of a deck. Values are the defaults, or an example where there is none."//new_line("a")// &
         & "! A key that is a comment may be given; a group that is a comment switches an effect on."// &
         & new_line("a")//"! Numbers are in SI units unless the last word of the key is a unit."//new_line("a")
      do i = 1, schema%group_count
         text = text//new_line("a")
         call write_group(schema, i, trim(merge("!", " ", schema%groups(i)%kind == group_effect)), text)
      end do
   end subroutine write_defaults

   !> Position of the group that somebody wants to see.
   subroutine find_wanted(schema, group, wanted, error)
      type(schema_t), intent(in) :: schema
      !> Name of the group; blank for all
      character(len=*), intent(in) :: group
      !> Its position; 0 for all
      integer, intent(out) :: wanted
      !> Usage error where there is no such group
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: nearest

      wanted = 0
      if (group == "") return
      wanted = find_group(schema, group)
      if (wanted > 0) return
      nearest = nearest_name(group, group_names(schema))
      if (nearest /= "") then
         call raise(error, kind_usage, "no group '"//group//"'; did you mean '"//nearest//"'?")
      else
         call write_names(group_names(schema), nearest)
         call raise(error, kind_usage, "no group '"//group//"'; known are "//nearest)
      end if
   end subroutine find_wanted

   !> One group of the complete deck.
   subroutine write_group(schema, position, mark, text)
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: position
      !> What every line begins with
      character(len=*), intent(in) :: mark
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: line, value, comment
      integer :: i

      associate (group => schema%groups(position))
         text = text//"! "//group%meaning//" ("//trim(kind_in_words(group%kind))//")"//new_line("a")
         text = text//mark//"&"//trim(group%name)//new_line("a")
         do i = group%first, group%last
            line = mark//"   "
            if (.not. (allocated(schema%keys(i)%default) .or. allocated(schema%keys(i)%example)) .and. mark == "") line = "!  "
            call show_value(schema%keys(i), value)
            call describe_key(schema, schema%keys(i), comment)
            call add_line(line//trim(schema%keys(i)%name)//" = "//value, comment, text)
         end do
         text = text//mark//"/"//new_line("a")
      end associate
   end subroutine write_group

   !> What a kind of group means.
   pure function kind_in_words(kind) result(words)
      !> Kind of the group
      integer, intent(in) :: kind
      !> The words
      character(len=40) :: words

      select case (kind)
      case (group_required)
         words = "must be given"
      case (group_standard)
         words = "may be left out"
      case default
         words = "computed only where the group is given"
      end select
   end function kind_in_words

   !> Default, example, or a sign for the kind of value.
   pure subroutine show_value(key, value)
      type(key_t), intent(in) :: key
      !> What to show
      character(len=:), allocatable, intent(out) :: value

      if (allocated(key%default)) then
         value = key%default
      else if (allocated(key%example)) then
         value = key%example
         if (key%type == type_text) value = "'"//value//"'"
      else if (key%type == type_text) then
         value = "''"
      else
         value = ""
      end if
   end subroutine show_value

   !> Meaning of a key, its limits, and whether it must be given.
   pure subroutine describe_key(schema, key, words)
      type(schema_t), intent(in) :: schema
      type(key_t), intent(in) :: key
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: allowed

      call say_meaning(schema, key, words)
      call say_allowed(key, allowed)
      if (allowed /= "") words = words//"; "//allowed
      call say_usual(key, allowed)
      if (allowed /= "") words = words//"; "//allowed
      if (key%is_required) words = words//"; must be given"
   end subroutine describe_key

   !> Meaning of a key, and when it is used.
   pure subroutine say_meaning(schema, key, words)
      type(schema_t), intent(in) :: schema
      type(key_t), intent(in) :: key
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: use

      call say_use(trim(schema%groups(key%group)%name)//"."//trim(key%name), use)
      words = key%meaning
      if (use /= "") words = words//"; used "//use
   end subroutine say_meaning

   !> Add a line with a comment beside it, in several lines where it is long.
   pure subroutine add_line(line, comment, text)
      character(len=*), intent(in) :: line
      !> The comment, without its mark
      character(len=*), intent(in) :: comment
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      integer :: first, last, room, start

      text = text//line
      start = max(comment_column, len(line) + 2)
      room = max(comment_width - start - 2, 40)
      first = 1
      do while (first <= len(comment))
         last = len(comment)
         if (last - first + 1 > room) last = first + index(comment(first:first + room), " ", back=.true.) - 2
         if (first == 1) then
            text = text//repeat(" ", start - len(line) - 1)
         else
            text = text//new_line("a")//repeat(" ", start - 1)
         end if
         text = text//"! "//comment(first:last)
         first = last + 2
      end do
      text = text//new_line("a")
   end subroutine add_line

   !> The same as a page with a table for each group.
   subroutine write_page(group, text, error)
      !> The only group wanted; blank for all
      character(len=*), intent(in) :: group
      !> Page in Markdown
      character(len=:), allocatable, intent(out) :: text
      !> Usage error where there is no such group
      type(error_t), allocatable, intent(out) :: error

      type(schema_t) :: schema
      integer :: i, wanted

      call new_schema(schema)
      call find_wanted(schema, group, wanted, error)
      if (allocated(error)) return
      text = "# The deck"//new_line("a")//new_line("a")
      text = text//"A deck is a file of Fortran namelist groups, `&group key = value ... /`; `!` begins a comment. "// &
         & "A line `include = 'file'` outside of groups stands for the lines of that file, named from the folder of the file "// &
         & "with the line. Its own keys replace those of the file, one by one, wherever the line stands; with "// &
         & "`include = 'file', without = 'sweep', 'lift'` these groups of the file are left out. A key that two files give of "// &
         & "which none includes the other is a mistake, unless the file that includes both gives it. "// &
         & "Numbers are in SI units unless the last word of the key is a unit. The group of an effect switches the effect "// &
         & "on. This page is the output of `camroller defaults --markdown`; "// &
         & "`camroller defaults` prints the same as a deck."//new_line("a")//new_line("a")// &
         & "![Cam, roller, finger and valve to scale, with the lengths and angles of &mechanism](figures/follower.svg)"// &
         & new_line("a")
      do i = 1, schema%group_count
         if (wanted > 0 .and. wanted /= i) cycle
         call write_table(schema, i, text)
      end do
      if (wanted == 0) call write_bounds(text)
   end subroutine write_page

   !> One group as a table.
   subroutine write_table(schema, position, text)
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: position
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: value, default, meaning
      integer :: i

      associate (group => schema%groups(position))
         text = text//new_line("a")//"## &"//trim(group%name)//new_line("a")//new_line("a")//capital(group%meaning)// &
            & " ("//trim(kind_in_words(group%kind))//")."//new_line("a")//new_line("a")// &
            & "| key | unit | takes | default | meaning |"//new_line("a")//"|---|---|---|---|---|"//new_line("a")
         do i = group%first, group%last
            associate (key => schema%keys(i))
               call say_kind(key, value)
               call say_default(key, default)
               call say_meaning(schema, key, meaning)
               text = text//"| `"//trim(key%name)//"` | "//trim(unit_in_words(key))//" | "//value//" | "// &
                  & default//" | "//meaning//" |"//new_line("a")
            end associate
         end do
      end associate
   end subroutine write_table

   !> Unit of a key; a dash where it has none.
   pure function unit_in_words(key) result(words)
      type(key_t), intent(in) :: key
      !> The unit
      character(len=unit_name_length) :: words

      words = key%unit%symbol
      if (words == "1") words = "-"
   end function unit_in_words

   !> A sentence with a capital at its beginning.
   pure function capital(words) result(sentence)
      character(len=*), intent(in) :: words
      !> The sentence
      character(len=len(words)) :: sentence

      sentence = words
      if (words(1:1) >= "a" .and. words(1:1) <= "z") sentence(1:1) = achar(iachar(words(1:1)) - 32)
   end function capital

   !> Kind of value and its limits.
   pure subroutine say_kind(key, words)
      type(key_t), intent(in) :: key
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: allowed

      select case (key%type)
      case (type_number)
         words = "number"
      case (type_integer)
         words = "whole number"
      case (type_logical)
         words = ".true. or .false."
      case (type_name)
         call say_allowed(key, words)
         return
      case (type_text)
         words = "text"
      case (type_numbers)
         words = "list of numbers"
      case (type_integers)
         words = "list of whole numbers"
      case default
         words = "list of values"
      end select
      call say_allowed(key, allowed)
      if (allowed /= "") words = words//", "//allowed
      call say_usual(key, allowed)
      if (allowed /= "") words = words//", "//allowed
   end subroutine say_kind

   !> Default of a key.
   pure subroutine say_default(key, words)
      type(key_t), intent(in) :: key
      character(len=:), allocatable, intent(out) :: words

      if (allocated(key%default)) then
         words = "`"//key%default//"`"
      else if (key%is_required) then
         words = "must be given"
      else
         words = "none"
      end if
   end subroutine say_default

end module camroller_deck_document
