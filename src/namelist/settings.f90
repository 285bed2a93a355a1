!> The settings of a case: the values of all keys, found by group and key.
!>
!> In: values as read from a deck. Out: single values, given to the components of a case.
module camroller_settings
   use camroller_kinds, only : wp
   use camroller_names, only : are_same
   use camroller_deck_schema, only : key_length
   use camroller_deck_values, only : value_t
   implicit none
   private

   public :: settings_t, copy_settings, find_value, take, is_known, is_wrong, get_word, has_group, group_position

   !> One group
   type :: section_t
      !> Name of the group
      character(len=key_length) :: name = ""
      !> First and last value
      integer :: first = 1, last = 0
      !> Is the group in the deck?
      logical :: is_present = .false.
      !> Is it there under a name that is nearly its own?
      logical :: is_misspelt = .false.
      !> Place of the group in the deck
      integer :: line = 0, column = 0
   end type section_t

   !> All values
   type :: settings_t
      !> Groups in the order of the schema
      type(section_t), allocatable :: groups(:)
      !> Values in the order of the schema
      type(value_t), allocatable :: values(:)
   end type settings_t

   !> Give a variable the value of a key; leave it alone where there is none
   interface take
      module procedure take_number
      module procedure take_integer
      module procedure take_logical
      module procedure take_word
      module procedure take_numbers
      module procedure take_integers
   end interface take

contains

   !> Settings for a case: without the texts of values as given, which only pages and files about a deck show; their copies
   !> would take 0.2 million instructions a case.
   pure subroutine copy_settings(from, to)
      !> The settings of a deck
      type(settings_t), intent(in) :: from
      !> The same without texts
      type(settings_t), intent(out) :: to

      integer :: i

      to%groups = from%groups
      allocate (to%values(size(from%values)))
      do i = 1, size(from%values)
         to%values(i)%bare_value_t = from%values(i)%bare_value_t
      end do
   end subroutine copy_settings

   !> Position of a group.
   pure function group_position(settings, group) result(position)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Name of the group
      character(len=*), intent(in) :: group
      !> Its position, 0 where unknown
      integer :: position

      do position = 1, size(settings%groups)
         associate (name => settings%groups(position)%name)
            ! Most names differ in the first letter: no comparison of texts then, since every case asks some 400 times
            if (name(1:1) /= group(1:1)) cycle
            if (are_same(name, group)) return
         end associate
      end do
      position = 0
   end function group_position

   !> Is a group in the deck?
   pure function has_group(settings, group) result(verdict)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Name of the group
      character(len=*), intent(in) :: group
      !> Is it?
      logical :: verdict

      verdict = settings%groups(group_position(settings, group))%is_present
   end function has_group

   !> Position of the value of a key.
   pure function find_value(settings, group, key) result(position)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> Position, 0 where unknown
      integer :: position

      integer :: section

      section = group_position(settings, group)
      do position = settings%groups(section)%first, settings%groups(section)%last
         associate (name => settings%values(position)%name)
            if (name(1:1) /= key(1:1)) cycle
            if (are_same(name, key)) return
         end associate
      end do
      position = 0
   end function find_value

   !> Is there a usable value?
   pure function is_known(settings, group, key) result(verdict)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> Is there one?
      logical :: verdict

      verdict = settings%values(find_value(settings, group, key))%is_known
   end function is_known

   !> Was a value given that is wrong? It has its own message and needs no second one.
   pure function is_wrong(settings, group, key) result(verdict)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> Was it?
      logical :: verdict

      verdict = settings%values(find_value(settings, group, key))%is_wrong
   end function is_wrong

   !> Length of the name or text of a key; 0 where there is none.
   pure function word_length(settings, group, key) result(length)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> The length
      integer :: length

      integer :: position

      length = 0
      position = find_value(settings, group, key)
      if (settings%values(position)%is_known) length = len(settings%values(position)%word)
   end function word_length

   !> Name or text of a key; blank where there is none.
   pure function get_word(settings, group, key) result(word)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> Name or text
      character(len=word_length(settings, group, key)) :: word

      if (len(word) > 0) word = settings%values(find_value(settings, group, key))%word
   end function get_word

   !> Give a number the value of a key.
   subroutine take_number(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value [SI unit]
      real(wp), intent(inout) :: variable

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%numbers(1)
      end associate
   end subroutine take_number

   !> Give an integer the value of a key.
   subroutine take_integer(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value
      integer, intent(inout) :: variable

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%integers(1)
      end associate
   end subroutine take_integer

   !> Give a logical the value of a key.
   subroutine take_logical(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value
      logical, intent(inout) :: variable

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%flag
      end associate
   end subroutine take_logical

   !> Give a name the value of a key.
   subroutine take_word(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value
      character(len=*), intent(inout) :: variable

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%word
      end associate
   end subroutine take_word

   !> Give a list of numbers the value of a key.
   subroutine take_numbers(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value [SI unit]
      real(wp), allocatable, intent(inout) :: variable(:)

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%numbers
      end associate
   end subroutine take_numbers

   !> Give a list of integers the value of a key.
   subroutine take_integers(settings, group, key, variable)
      type(settings_t), intent(in) :: settings
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> What gets the value
      integer, allocatable, intent(inout) :: variable(:)

      associate (value => settings%values(find_value(settings, group, key)))
         if (value%is_known) variable = value%integers
      end associate
   end subroutine take_integers

end module camroller_settings
