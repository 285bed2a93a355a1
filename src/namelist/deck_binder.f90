!> The keys of a deck and the components of a case, bound to each other by one line a key.
!>
!> In: a schema that is being made, or settings. Out: each key in the schema, with the value that its variable has as the default;
!> or each variable with the value of its key; or what is wrong with the values of a case that was made by hand. One procedure of a
!> group serves all three, and a key is written once:
!>
!>     call keys%group("heat", group_effect, "heat that thins the film at its inlet and the oil within the contact")
!>     if (.not. keys%are_wanted(allocated(case%heat))) return
!>     if (.not. allocated(case%heat)) allocate (case%heat)
!>     call keys%number("oil_conductivity_W_m_K", positive, "thermal conductivity of the oil", case%heat%oil_conductivity)
!>
!> A key but a list has its variable's value as default, unless it has an example or may be left out. A key without a variable is
!> taken by other means.
module camroller_deck_binder
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_deck_schema, only : schema_t, range_t, add_group, add_key, group_effect, is_within, say_allowed, type_number, &
      & type_integer, type_logical, type_name, type_text, type_numbers, type_integers
   use camroller_kinds, only : wp
   use camroller_names, only : are_same
   use camroller_number_text, only : append_number, integer_text, number_text
   use camroller_settings, only : settings_t, find_value, group_position
   use camroller_units, only : from_si, unit_of_key
   implicit none
   private

   public :: keys_t, declared_in, judged_in, taken_from

   !> Digits of a default that is converted to the unit of its key
   integer, parameter :: default_digits = 12
   !> Part of itself by which a number may be beyond an end of its range, since its unit was converted [-]
   real(wp), parameter :: round_off = 1.0e-12_wp

   !> Keys that are declared in a schema, or taken from settings
   type :: keys_t
      private
      !> What they are declared in; null where they are taken
      type(schema_t), pointer :: schema => null()
      !> What they are taken from; null where they are declared
      type(settings_t), pointer :: settings => null()
      !> Position of their group in the settings; position of the value behind that of the key taken last
      integer :: section = 0, next = 0
      !> Is the group wanted?
      logical :: is_wanted = .true.
      !> Are the values of variables judged by the ranges of their keys?
      logical :: is_judging = .false.
      !> What is wrong with them, a line each
      character(len=:), allocatable :: faults
   contains
      procedure :: group
      procedure :: are_wanted
      procedure :: number
      procedure :: whole_number
      procedure :: yes_or_no
      procedure :: choice
      procedure :: text
      procedure :: numbers
      procedure :: whole_numbers
      procedure :: found_faults
      procedure, private :: find
      procedure, private :: judge
   end type keys_t

contains

   !> Keys to be declared in a schema.
   function declared_in(schema) result(keys)
      !> The schema; it stays where it is as long as the keys are used
      type(schema_t), intent(inout), target :: schema
      !> The keys
      type(keys_t) :: keys

      keys%schema => schema
   end function declared_in

   !> Keys whose variables are judged by their ranges.
   function judged_in(schema) result(keys)
      !> A schema without keys, in which they are declared; it stays where it is as long as the keys are used
      type(schema_t), intent(inout), target :: schema
      !> The keys
      type(keys_t) :: keys

      keys%schema => schema
      keys%is_judging = .true.
      keys%faults = ""
   end function judged_in

   !> What is wrong with the variables of judged keys.
   pure subroutine found_faults(keys, faults)
      class(keys_t), intent(in) :: keys
      !> A line each; empty where nothing is
      character(len=:), allocatable, intent(out) :: faults

      faults = keys%faults
   end subroutine found_faults

   !> Judge the variable of the key that was declared last. Zero stands for a number that is not given, of a key that may be left
   !> out.
   subroutine judge(keys, numbers)
      class(keys_t), intent(inout) :: keys
      !> Its numbers [SI unit]
      real(wp), intent(in) :: numbers(:)

      character(len=:), allocatable :: allowed
      real(wp) :: number ! [unit of the key]
      integer :: i

      if (.not. keys%is_judging) return
      associate (schema => keys%schema, key => keys%schema%keys(keys%schema%key_count))
         do i = 1, size(numbers)
            if (.not. (key%is_required .or. allocated(key%default)) .and. abs(numbers(i)) <= 0.0_wp) cycle
            number = numbers(i)
            if (ieee_is_finite(number)) then
               number = from_si(key%unit, number)
               if (is_within(number, key%range) .or. is_end(number, key%range)) cycle
            end if
            call say_allowed(key, allowed)
            if (allowed == "") allowed = "a number"
            if (keys%faults /= "") keys%faults = keys%faults//new_line("a")
            keys%faults = keys%faults//trim(schema%groups(key%group)%name)//"."//trim(key%name)//" = "//number_text(number, 6)// &
               & ", and must be "//allowed
            return
         end do
      end associate
   end subroutine judge

   !> Is a number an end of a range that belongs to it, but for rounding?
   pure function is_end(number, range) result(verdict)
      !> The number [unit of the key]
      real(wp), intent(in) :: number
      type(range_t), intent(in) :: range
      !> Is it?
      logical :: verdict

      verdict = (range%with_smallest .and. abs(number - range%smallest) <= round_off*abs(range%smallest)) .or. &
         & (range%with_largest .and. abs(number - range%largest) <= round_off*abs(range%largest))
   end function is_end

   !> Keys to be taken from settings.
   function taken_from(settings) result(keys)
      !> The settings; they stay where they are as long as the keys are used
      type(settings_t), intent(in), target :: settings
      !> The keys
      type(keys_t) :: keys

      keys%settings => settings
   end function taken_from

   !> Begin a group; the keys that follow belong to it. Groups and keys are taken in the order in which they were declared, so that
   !> each is nearly always the one behind the last.
   subroutine group(keys, name, kind, meaning)
      class(keys_t), intent(inout) :: keys
      !> Name of the group
      character(len=*), intent(in) :: name
      !> Required, standard or effect
      integer, intent(in) :: kind
      !> What it holds
      character(len=*), intent(in) :: meaning

      logical :: is_next

      if (associated(keys%schema)) then
         call add_group(keys%schema, name, kind, meaning)
         return
      end if
      associate (groups => keys%settings%groups)
         keys%section = keys%section + 1
         is_next = keys%section <= size(groups)
         if (is_next) is_next = are_same(groups(keys%section)%name, name)
         if (.not. is_next) keys%section = group_position(keys%settings, name)
         keys%next = groups(keys%section)%first
         keys%is_wanted = kind /= group_effect .or. groups(keys%section)%is_present
      end associate
   end subroutine group

   !> Are the keys of the present group wanted: declared, or taken where their effect is in the deck, or judged where it is in the
   !> case?
   pure function are_wanted(keys, is_in_case) result(verdict)
      class(keys_t), intent(in) :: keys
      !> Is the effect in the case?
      logical, intent(in) :: is_in_case
      !> Are they?
      logical :: verdict

      verdict = merge(is_in_case, keys%is_wanted, keys%is_judging)
   end function are_wanted

   !> Value of a key of the present group.
   pure subroutine find(keys, name, position)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Position of its value in the settings
      integer, intent(out) :: position

      logical :: is_next

      associate (settings => keys%settings, section => keys%settings%groups(keys%section))
         position = keys%next
         is_next = position <= section%last
         if (is_next) is_next = are_same(settings%values(position)%name, name)
         if (.not. is_next) position = find_value(settings, trim(section%name), name)
      end associate
      keys%next = position + 1
   end subroutine find

   !> A number.
   subroutine number(keys, name, range, meaning, variable, example, is_optional, usual)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Range of its value
      type(range_t), intent(in) :: range
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the value [SI unit]
      real(wp), intent(inout) :: variable
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example
      !> May it be left out without a default?
      logical, intent(in), optional :: is_optional
      !> Ends of its usual range [unit of the key]
      real(wp), intent(in), optional :: usual(2)

      character(len=:), allocatable :: default
      integer :: position

      if (.not. associated(keys%schema)) then
         call keys%find(name, position)
         if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%numbers(1)
         return
      end if
      if (.not. (present(example) .or. present(is_optional))) then
         default = ""
         call append_number(default, from_si(unit_of_key(name), variable), default_digits)
      end if
      call add_key(keys%schema, name, type_number, meaning, range, default=default, example=example, is_optional=is_optional, &
         & usual=usual)
      call keys%judge([variable])
   end subroutine number

   !> A whole number.
   subroutine whole_number(keys, name, range, meaning, variable, example)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Range of its value
      type(range_t), intent(in) :: range
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the value
      integer, intent(inout) :: variable
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example

      integer :: position

      if (.not. associated(keys%schema)) then
         call keys%find(name, position)
         if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%integers(1)
         return
      end if
      if (present(example)) then
         call add_key(keys%schema, name, type_integer, meaning, range, example=example)
      else
         call add_key(keys%schema, name, type_integer, meaning, range, default=integer_text(variable))
      end if
      call keys%judge([real(variable, wp)])
   end subroutine whole_number

   !> A choice of yes and no.
   subroutine yes_or_no(keys, name, meaning, variable)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the value
      logical, intent(inout) :: variable

      integer :: position

      if (associated(keys%schema)) then
         call add_key(keys%schema, name, type_logical, meaning, default=trim(merge(".true. ", ".false.", variable)))
         return
      end if
      call keys%find(name, position)
      if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%flag
   end subroutine yes_or_no

   !> A choice by name.
   subroutine choice(keys, name, choices, meaning, variable)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Allowed names; the first is the default of a key without a variable
      character(len=*), intent(in) :: choices(:)
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the value
      character(len=*), intent(inout), optional :: variable

      integer :: position

      if (.not. associated(keys%schema)) then
         call keys%find(name, position)
         if (.not. present(variable)) return
         if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%word
      else if (present(variable)) then
         call add_key(keys%schema, name, type_name, meaning, choices=choices, default=trim(variable))
      else
         call add_key(keys%schema, name, type_name, meaning, choices=choices, default=trim(choices(1)))
      end if
   end subroutine choice

   !> A text.
   subroutine text(keys, name, meaning, variable, example, is_optional)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the value
      character(len=:), allocatable, intent(inout), optional :: variable
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example
      !> May it be left out without a default?
      logical, intent(in), optional :: is_optional

      integer :: position

      if (.not. associated(keys%schema)) then
         call keys%find(name, position)
         if (.not. present(variable)) return
         if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%word
      else
         call add_key(keys%schema, name, type_text, meaning, default=variable, example=example, is_optional=is_optional)
      end if
   end subroutine text

   !> A list of numbers.
   subroutine numbers(keys, name, range, meaning, variable, example, is_optional, usual)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Range of each value
      type(range_t), intent(in) :: range
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the values [SI unit]
      real(wp), allocatable, intent(inout) :: variable(:)
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example
      !> May it be left out?
      logical, intent(in), optional :: is_optional
      !> Ends of the usual range of each [unit of the key]
      real(wp), intent(in), optional :: usual(2)

      integer :: position

      if (associated(keys%schema)) then
         call add_key(keys%schema, name, type_numbers, meaning, range, example=example, is_optional=is_optional, usual=usual)
         if (allocated(variable)) call keys%judge(variable)
         return
      end if
      call keys%find(name, position)
      if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%numbers
   end subroutine numbers

   !> A list of whole numbers.
   subroutine whole_numbers(keys, name, range, meaning, variable, example, is_optional)
      class(keys_t), intent(inout) :: keys
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Range of each value
      type(range_t), intent(in) :: range
      !> What it means
      character(len=*), intent(in) :: meaning
      !> What gets the values
      integer, allocatable, intent(inout), optional :: variable(:)
      !> Value for a deck that shows every key
      character(len=*), intent(in), optional :: example
      !> May it be left out?
      logical, intent(in), optional :: is_optional

      integer :: position

      if (associated(keys%schema)) then
         call add_key(keys%schema, name, type_integers, meaning, range, example=example, is_optional=is_optional)
         if (.not. present(variable)) return
         if (allocated(variable)) call keys%judge(real(variable, wp))
         return
      end if
      call keys%find(name, position)
      if (.not. present(variable)) return
      if (keys%settings%values(position)%is_known) variable = keys%settings%values(position)%integers
   end subroutine whole_numbers

end module camroller_deck_binder
