!> What a deck may hold: types for groups and keys, and how to find and describe them.
!>
!> In: declarations, by `camroller_deck_binder` and `camroller_deck_sweep_keys`. Out: `schema_t`, the one source for reading,
!> checking, documenting and echoing decks.
module camroller_deck_schema
   use camroller_kinds, only : wp, celsius_zero
   use camroller_names, only : name_length, write_names
   use camroller_units, only : unit_t, unit_of_key
   use camroller_deck_text, only : to_lower
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: schema_t, key_t, range_t
   public :: add_group, add_key, find_group, say_allowed, say_usual, group_names, is_within, key_names
   public :: group_required, group_standard, group_effect
   public :: type_number, type_integer, type_logical, type_name, type_text, type_numbers, type_integers, type_words
   public :: anything, positive, not_negative, proper_fraction, up_to, from_to, one_or_more, above_absolute_zero
   public :: key_length

   !> Length of the names of groups and keys
   integer, parameter :: key_length = 48

   !> Group that must be there; group that may be left out with all its defaults; group that switches an effect on
   integer, parameter :: group_required = 1, group_standard = 2, group_effect = 3

   !> Kinds of values
   integer, parameter :: type_number = 1, type_integer = 2, type_logical = 3, type_name = 4, type_text = 5, &
      & type_numbers = 6, type_integers = 7, type_words = 8

   !> Range of a number, in the unit of its key
   type :: range_t
      !> Smallest value [unit of the key]
      real(wp) :: smallest = -huge(1.0_wp)
      !> Largest value [unit of the key]
      real(wp) :: largest = huge(1.0_wp)
      !> Are the ends themselves allowed?
      logical :: with_smallest = .true., with_largest = .true.
   end type range_t

   type(range_t), parameter :: anything = range_t()
   type(range_t), parameter :: positive = range_t(smallest=0.0_wp, with_smallest=.false.)
   type(range_t), parameter :: not_negative = range_t(smallest=0.0_wp)
   type(range_t), parameter :: one_or_more = range_t(smallest=1.0_wp)
   !> Of temperatures in degC
   type(range_t), parameter :: above_absolute_zero = range_t(smallest=-celsius_zero, with_smallest=.false.)
   type(range_t), parameter :: proper_fraction = range_t(0.0_wp, 1.0_wp, .false., .false.)

   !> One key
   type :: key_t
      !> Position of its group
      integer :: group = 0
      !> Name, e.g. `base_radius_mm`
      character(len=key_length) :: name = ""
      !> The same in lower case
      character(len=key_length) :: lower_name = ""
      !> One of the kinds of values
      integer :: type = 0
      !> Must it be given?
      logical :: is_required = .false.
      !> Value where it is not given, as text; not allocated where there is none
      character(len=:), allocatable :: default
      !> Value for a deck that shows every key; not allocated where the default says enough
      character(len=:), allocatable :: example
      !> Range of a number
      type(range_t) :: range
      !> Range that an engine's value lies in, where there is one: engines from motorcycles to trucks, from cranking to their limit
      type(range_t) :: usual
      logical :: has_usual = .false.
      !> Allowed names
      character(len=name_length), allocatable :: choices(:)
      !> Unit of a number
      type(unit_t) :: unit
      !> What it means
      character(len=:), allocatable :: meaning
   end type key_t

   !> One group
   type :: group_t
      !> Name, e.g. `mechanism`
      character(len=key_length) :: name = ""
      !> Required, standard or effect
      integer :: kind = group_required
      !> First and last key
      integer :: first = 1, last = 0
      !> What it holds
      character(len=:), allocatable :: meaning
   end type group_t

   !> All groups and keys
   type :: schema_t
      !> Groups in the order of a deck
      type(group_t), allocatable :: groups(:)
      !> Keys, group by group
      type(key_t), allocatable :: keys(:)
      !> Number of groups and of keys that are in use
      integer :: group_count = 0, key_count = 0
   end type schema_t

   !> Groups and keys for which a new schema has room; it grows
   integer, parameter :: first_room = 64

contains

   !> A range from above zero up to an end.
   pure function up_to(largest) result(range)
      !> Largest value [unit of the key]
      real(wp), intent(in) :: largest
      !> The range
      type(range_t) :: range

      range = range_t(0.0_wp, largest, .false., .true.)
   end function up_to

   !> A range with both ends.
   pure function from_to(smallest, largest) result(range)
      !> Smallest and largest value [unit of the key]
      real(wp), intent(in) :: smallest, largest
      !> The range
      type(range_t) :: range

      range = range_t(smallest, largest)
   end function from_to

   !> Begin a group; the keys that follow belong to it.
   subroutine add_group(schema, name, kind, meaning)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Name of the group
      character(len=*), intent(in) :: name
      !> Required, standard or effect
      integer, intent(in) :: kind
      !> What it holds
      character(len=*), intent(in) :: meaning

      type(group_t), allocatable :: groups(:)

      if (.not. allocated(schema%groups)) allocate (schema%groups(first_room))
      if (schema%group_count == size(schema%groups)) then
         allocate (groups(2*schema%group_count))
         groups(:schema%group_count) = schema%groups
         call move_alloc(groups, schema%groups)
      end if
      schema%group_count = schema%group_count + 1
      associate (group => schema%groups(schema%group_count))
         group%name = name
         group%kind = kind
         group%meaning = meaning
         group%first = schema%key_count + 1
         group%last = schema%key_count
      end associate
   end subroutine add_group

   !> Add a key to the last group. One with neither a default nor `is_optional` must be given.
   subroutine add_key(schema, name, type, meaning, range, choices, default, example, is_optional, usual)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Kind of value
      integer, intent(in) :: type
      !> What it means
      character(len=*), intent(in) :: meaning
      !> Range of a number, or of each in a list
      type(range_t), intent(in), optional :: range
      !> Allowed names
      character(len=*), intent(in), optional :: choices(:)
      !> Value where it is not given, as a deck has it, but a name or a text without its quotes
      character(len=*), intent(in), optional :: default
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example
      !> May it be left out without a default?
      logical, intent(in), optional :: is_optional
      !> Ends of the range in which a remark does not ask whether the number is meant [unit of the key]
      real(wp), intent(in), optional :: usual(2)

      type(key_t), allocatable :: keys(:)

      if (.not. allocated(schema%keys)) allocate (schema%keys(first_room))
      if (schema%key_count == size(schema%keys)) then
         allocate (keys(2*schema%key_count))
         keys(:schema%key_count) = schema%keys
         call move_alloc(keys, schema%keys)
      end if
      schema%key_count = schema%key_count + 1
      schema%groups(schema%group_count)%last = schema%key_count
      associate (key => schema%keys(schema%key_count))
         key%group = schema%group_count
         key%name = name
         key%lower_name = to_lower(name)
         key%type = type
         key%meaning = meaning
         key%unit = unit_of_key(name)
         key%is_required = .not. (present(default) .or. present(is_optional))
         if (present(default)) key%default = default
         if (present(default) .and. any(type == [type_name, type_text])) key%default = "'"//default//"'"
         if (present(example)) key%example = example
         if (present(range)) key%range = range
         key%has_usual = present(usual)
         if (present(usual)) key%usual = range_t(usual(1), usual(2))
         if (present(choices)) then
            allocate (key%choices(size(choices)))
            key%choices(:) = choices
         end if
      end associate
   end subroutine add_key

   !> Is a number in a range?
   elemental function is_within(number, range) result(verdict)
      !> The number [unit of the key]
      real(wp), intent(in) :: number
      type(range_t), intent(in) :: range
      !> Is it?
      logical :: verdict

      verdict = (number > range%smallest .or. (range%with_smallest .and. .not. number < range%smallest)) .and. &
         & (number < range%largest .or. (range%with_largest .and. .not. number > range%largest))
   end function is_within

   !> Position of a group, 0 where it is unknown.
   pure function find_group(schema, name) result(position)
      !> Schema to look in
      type(schema_t), intent(in) :: schema
      !> Name of the group
      character(len=*), intent(in) :: name
      !> Its position
      integer :: position

      do position = 1, schema%group_count
         if (schema%groups(position)%name == name) return
      end do
      position = 0
   end function find_group

   !> Names of all groups.
   pure function group_names(schema) result(names)
      !> Schema to look in
      type(schema_t), intent(in) :: schema
      !> The names
      character(len=key_length) :: names(schema%group_count)

      names = schema%groups(:schema%group_count)%name
   end function group_names

   !> Names of the keys of a group.
   pure function key_names(schema, group) result(names)
      !> Schema to look in
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: group
      !> The names
      character(len=key_length) :: names(schema%groups(group)%last - schema%groups(group)%first + 1)

      names = schema%keys(schema%groups(group)%first:schema%groups(group)%last)%name
   end function key_names

   !> What a key's value usually is, in words; blank where that is not known.
   pure subroutine say_usual(key, words)
      !> The key
      type(key_t), intent(in) :: key
      !> The range
      character(len=:), allocatable, intent(out) :: words

      words = ""
      if (key%has_usual) words = "usually "//number_text(key%usual%smallest)//" to "//number_text(key%usual%largest)
   end subroutine say_usual

   !> What a key's value may be, in words; blank where there is no limit.
   pure subroutine say_allowed(key, words)
      !> The key
      type(key_t), intent(in) :: key
      !> Range or names
      character(len=:), allocatable, intent(out) :: words

      logical :: has_smallest, has_largest

      words = ""
      if (allocated(key%choices)) then
         call write_names(key%choices, words)
         words = "one of "//words
      end if
      has_smallest = key%range%smallest > -huge(1.0_wp)
      has_largest = key%range%largest < huge(1.0_wp)
      if (has_smallest .and. has_largest .and. key%range%with_smallest .and. key%range%with_largest) then
         words = "from "//number_text(key%range%smallest)//" to "//number_text(key%range%largest)
         return
      end if
      if (has_smallest) then
         words = "above "//number_text(key%range%smallest)
         if (key%range%with_smallest) words = number_text(key%range%smallest)//" or more"
      end if
      if (has_smallest .and. has_largest) words = words//" and "
      if (has_largest) then
         if (key%range%with_largest) then
            words = words//"not above "//number_text(key%range%largest)
         else
            words = words//"below "//number_text(key%range%largest)
         end if
      end if
   end subroutine say_allowed

end module camroller_deck_schema
