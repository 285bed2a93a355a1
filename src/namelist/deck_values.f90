!> Values of a deck's keys: read from text as the schema says, checked one by one, held in SI.
!>
!> In: the text of a value and its key. Out: a value, or what is wrong with it in words. The value syntax is that
!> of Fortran: a text that keeps to it goes through a namelist read of its own. One that does not is never read: gfortran's library
!> hands what it had of a failed read to the next one, of whatever thread.
module camroller_deck_values
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp
   use camroller_names, only : index_of_name
   use camroller_quotes, only : is_quoted, occurrences
   use camroller_units, only : to_si
   use camroller_number_text, only : integer_text, is_beyond_range
   use camroller_value_syntax, only : count_numbers, is_yes_or_no
   use camroller_mistakes, only : shown
   use camroller_near_names, only : nearest_name
   use camroller_deck_bounds, only : is_bounded, say_bounds
   use camroller_unit_guess, only : say_meant
   use camroller_deck_schema, only : key_t, is_within, key_length, say_allowed, type_number, type_integer, &
      & type_logical, type_name, type_text, type_numbers, type_integers, type_words
   implicit none
   private

   public :: value_t, read_value, next_word, has_empty_place, longest_text

   !> Longest list, which keeps `1000000000*1` from taking the memory, and longest text
   integer, parameter :: longest_list = 100000, longest_text = 512
   !> Longest value of a key but a list of &sweep: a list of numbers with all their digits is shorter
   integer, parameter :: longest_value = 64*longest_list

   !> What keys for numbers take, in words
   character(len=*), parameter :: number_words(*) = [character(len=23) :: "one number", "one whole number", "a list of numbers", &
      & "a list of whole numbers"]

   !> Value of one key, without the text that gave it
   type :: bare_value_t
      !> Name of the key
      character(len=key_length) :: name = ""
      !> Numbers [SI unit]
      real(wp), allocatable :: numbers(:)
      !> Integers
      integer, allocatable :: integers(:)
      !> Name or text, without quotes
      character(len=:), allocatable :: word
      !> Yes or no
      logical :: flag = .false.
      !> Was it given in the deck or beside it?
      logical :: is_given = .false.
      !> Is there a value that can be used?
      logical :: is_known = .false.
      !> Was a value given that is wrong?
      logical :: is_wrong = .false.
      !> Place of the value in the deck; 0 where it is not from there
      integer :: line = 0, column = 0, width = 0
      !> The words that gave it where it was not the deck
      character(len=:), allocatable :: source
   end type bare_value_t

   !> Value of one key
   type, extends(bare_value_t) :: value_t
      !> As given, or the default, in the unit of the key; the settings of a single case do without it
      character(len=:), allocatable :: text
   end type value_t

contains

   !> Read a value as its key says, and check it.
   subroutine read_value(key, text, value, reason)
      !> The key
      type(key_t), intent(in) :: key
      !> Text of the value
      character(len=*), intent(in) :: text
      !> The value; its place is left alone
      type(value_t), intent(inout) :: value
      !> What is wrong with it; not allocated where nothing is
      character(len=:), allocatable, intent(out) :: reason

      value%text = trim(adjustl(text))
      if (index(value%text, ",", back=.true.) == max(1, len(value%text))) value%text = trim(value%text(:len(value%text) - 1))
      value%is_known = .false.
      if (len(value%text) == 0) then
         reason = "'"//trim(key%name)//"' has no value"
      else if (len(value%text) > longest_value .and. key%type /= type_words) then
         reason = "'"//trim(key%name)//"' has a value of "//integer_text(len(value%text))//" characters; the longest has "// &
            & integer_text(longest_value)
         value%text = shown(value%text)
      else
         select case (key%type)
         case (type_number, type_numbers)
            call read_numbers(key, value, reason)
         case (type_integer, type_integers)
            call read_integers(key, value, reason)
         case (type_logical)
            call read_logical(key, value, reason)
         case (type_words)
            value%word = value%text
         case (type_name, type_text)
            call read_text(key, value, reason)
         end select
      end if
      value%is_wrong = allocated(reason)
      value%is_known = .not. value%is_wrong
   end subroutine read_value

   !> One number or a list of numbers.
   subroutine read_numbers(key, value, reason)
      type(key_t), intent(in) :: key
      type(value_t), intent(inout) :: value
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      !> Numbers as read [unit of the key]
      real(wp), allocatable :: list(:)
      !> What marks an empty place [unit of the key]
      real(wp), parameter :: empty = -huge(1.0_wp)
      integer :: status, n, wrong, places
      character(len=:), allocatable :: buffer, allowed, question
      namelist /value_group/ list

      if (is_beyond_range(value%text)) then
         reason = "'"//trim(key%name)//"' must be finite; '"//shown(value%text)//"' is too large to be held"
         return
      end if
      call count_places(key, value%text, .false., places, reason)
      if (allocated(reason)) return
      allocate (list(places), source=empty)
      buffer = "&value_group list="//value%text//" /"
      read (buffer, nml=value_group, iostat=status)
      if (status /= 0) then
         reason = "'"//trim(key%name)//"' takes "//number_or_list(key)//", not "//shown(value%text)
         return
      end if
      if (.not. all(ieee_is_finite(list))) then
         reason = "'"//trim(key%name)//"' must be finite, not "//shown(value%text)
         return
      end if
      n = count(list > empty)
      call check_count(key, n, all(list(:n) > empty), value%text, reason)
      if (allocated(reason)) return
      wrong = findloc(is_within(list(:n), key%range), .false., dim=1)
      if (wrong > 0) then
         call say_allowed(key, allowed)
      else
         wrong = findloc(is_bounded(list(:n), key%unit), .false., dim=1)
         if (wrong > 0) call say_bounds(key%unit, is_within(0.0_wp, key%range), key%range%smallest < 0.0_wp, allowed)
      end if
      if (wrong > 0) then
         call say_meant(key, list(wrong), question)
         reason = "'"//trim(key%name)//"' must be "//allowed//", not "//shown(value%text)//question
         return
      end if
      value%numbers = to_si(key%unit, list(:n))
   end subroutine read_numbers

   !> One integer or a list of integers.
   subroutine read_integers(key, value, reason)
      type(key_t), intent(in) :: key
      type(value_t), intent(inout) :: value
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      integer, parameter :: empty = -huge(1)
      integer, allocatable :: list(:)
      integer :: status, n, places
      character(len=:), allocatable :: buffer, allowed
      namelist /value_group/ list

      call count_places(key, value%text, .true., places, reason)
      if (allocated(reason)) return
      allocate (list(places), source=empty)
      buffer = "&value_group list="//value%text//" /"
      read (buffer, nml=value_group, iostat=status)
      if (status /= 0) then
         reason = "'"//trim(key%name)//"' takes "//number_or_list(key)//", not "//shown(value%text)
         return
      end if
      n = count(list > empty)
      call check_count(key, n, all(list(:n) > empty), value%text, reason)
      if (allocated(reason)) return
      if (.not. all(is_within(real(list(:n), wp), key%range))) then
         call say_allowed(key, allowed)
         reason = "'"//trim(key%name)//"' must be "//allowed//", not "//shown(value%text)
         return
      end if
      value%integers = list(:n)
   end subroutine read_integers

   !> Yes or no.
   subroutine read_logical(key, value, reason)
      type(key_t), intent(in) :: key
      type(value_t), intent(inout) :: value
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      logical :: item
      integer :: status
      character(len=:), allocatable :: buffer
      namelist /value_group/ item

      item = .false.
      buffer = "&value_group item="//value%text//" /"
      status = merge(0, 1, is_yes_or_no(value%text))
      if (status == 0) read (buffer, nml=value_group, iostat=status)
      if (status /= 0) reason = "'"//trim(key%name)//"' takes .true. or .false., not "//shown(value%text)
      value%flag = item
   end subroutine read_logical

   !> A name or a text.
   subroutine read_text(key, value, reason)
      type(key_t), intent(in) :: key
      type(value_t), intent(inout) :: value
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      character(len=longest_text) :: item
      character(len=:), allocatable :: buffer, allowed
      integer :: status
      namelist /value_group/ item

      item = ""
      status = 1
      if (len(value%text) > longest_text) then
         reason = "'"//trim(key%name)//"' is longer than "//integer_text(longest_text - 2)//" characters"
         return
      end if
      if (is_quoted(value%text)) then
         buffer = "&value_group item="//value%text//" /"
         read (buffer, nml=value_group, iostat=status)
      end if
      if (status /= 0) then
         reason = "'"//trim(key%name)//"' takes one text in quotes, not "//shown(value%text)
         if (allocated(key%choices)) then
            call say_allowed(key, allowed)
            reason = reason//"; it is "//allowed
         end if
      else if (allocated(key%choices)) then
         call check_choice(key, trim(item), reason)
      else if (item == "") then
         reason = "'"//trim(key%name)//"' is an empty text"
      end if
      value%word = trim(item)
   end subroutine read_text

   !> Is a name one of those that a key takes?
   subroutine check_choice(key, name, reason)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: name
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      character(len=:), allocatable :: nearest, allowed

      if (index_of_name(name, key%choices) > 0) return
      call say_allowed(key, allowed)
      reason = "'"//trim(key%name)//"' must be "//allowed//", not "//shown("'"//name//"'")
      nearest = nearest_name(name, key%choices)
      if (nearest /= "") reason = reason//"; did you mean '"//nearest//"'?"
   end subroutine check_choice

   !> Room for a list of numbers.
   subroutine count_places(key, text, is_whole, places, reason)
      type(key_t), intent(in) :: key
      !> Text of the value
      character(len=*), intent(in) :: text
      !> Are whole numbers wanted?
      logical, intent(in) :: is_whole
      !> Places of the list, at least one
      integer, intent(out) :: places
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      places = count_numbers(text, longest_list, is_whole)
      if (places < 0) reason = "'"//trim(key%name)//"' takes "//number_or_list(key)//", not "//shown(text)
      if (places > longest_list) reason = "'"//trim(key%name)//"' has more than "//integer_text(longest_list)//" values: "// &
         & shown(text)
      places = max(1, places)
   end subroutine count_places

   !> As many values as the key takes, and no empty place between them?
   subroutine check_count(key, n, is_dense, text, reason)
      type(key_t), intent(in) :: key
      !> Number of values
      integer, intent(in) :: n
      !> Do they fill the first n places?
      logical, intent(in) :: is_dense
      !> Text of the value
      character(len=*), intent(in) :: text
      !> What is wrong
      character(len=:), allocatable, intent(out) :: reason

      if (n == 0 .or. .not. is_dense) then
         reason = "'"//trim(key%name)//"' has an empty place between commas: "//shown(text)
      else if (n > 1 .and. (key%type == type_number .or. key%type == type_integer)) then
         reason = "'"//trim(key%name)//"' takes "//number_or_list(key)//", not "//integer_text(n)//": "//shown(text)
      end if
   end subroutine check_count

   !> Position of what a key takes in `number_words`.
   pure function number_kind(key) result(position)
      type(key_t), intent(in) :: key
      !> The position
      integer :: position

      position = max(1, findloc([type_integer, type_numbers, type_integers], key%type, dim=1) + 1)
   end function number_kind

   !> What a key takes, in words.
   pure function number_or_list(key) result(words)
      type(key_t), intent(in) :: key
      !> The words
      character(len=len_trim(number_words(number_kind(key)))) :: words

      words = number_words(number_kind(key))
   end function number_or_list

   !> Next word of a list; quoted text stays in one piece, with its quotes, and with those inside, which are doubled.
   pure subroutine next_word(text, position, first, last, mark)
      !> The list
      character(len=*), intent(in) :: text
      !> Where to begin; behind the word on return
      integer, intent(inout) :: position
      !> First and last character of the word; the first is 0 where there is none left
      integer, intent(out) :: first, last
      !> What parts words beside blanks and tabulators; a comma where this is left out
      character(len=1), intent(in), optional :: mark

      character(len=3) :: separators

      separators = " ,"//char(9)
      if (present(mark)) separators(2:2) = mark
      first = 0
      last = 0
      do while (position <= len(text))
         if (index(separators, text(position:position)) == 0) exit
         position = position + 1
      end do
      if (position > len(text)) return
      first = position
      last = first
      if (index("'""", text(first:first)) == 0) then
         last = scan(text(first:), separators)
         last = merge(len(text), first + last - 2, last == 0)
      else if (index(text(first + 1:), text(first:first)) == 0) then
         last = len(text)
      else
         do
            last = last + index(text(last + 1:), text(first:first))
            if (last == len(text)) exit
            if (text(last + 1:last + 1) /= text(first:first)) exit
            if (index(text(last + 2:), text(first:first)) == 0) then
               last = len(text)
               exit
            end if
            last = last + 1
         end do
      end if
      position = last + 1
   end subroutine next_word

   !> Has a list a comma without a word before it, or one behind its last word? Quoted text stays in one piece.
   pure function has_empty_place(text) result(verdict)
      !> The list
      character(len=*), intent(in) :: text
      !> Has it?
      logical :: verdict

      integer :: position, before, first, last

      position = 1
      verdict = .false.
      do
         before = position
         call next_word(text, position, first, last)
         if (first == 0) exit
         ! One comma stands between two words, none before the first
         verdict = verdict .or. occurrences(text(before:first - 1), ",") > merge(0, 1, before == 1)
      end do
      verdict = verdict .or. occurrences(text(before:), ",") > 0
   end function has_empty_place

end module camroller_deck_values
