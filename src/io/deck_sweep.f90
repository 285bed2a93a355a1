!> A grid of cases: which keys vary, over which values, and what case stands at which place of the grid.
!>
!> Layer: io. In: the group &sweep of a deck. Out: `sweep_t`; place in the grid -> overrides. The last key varies
!> fastest. A
!> deck without &sweep is a grid of one case.
module camroller_deck_sweep
   use camroller_kinds, only : wp
   use camroller_units, only : unit_name_length
   use camroller_number_text, only : number_text, integer_text
   use camroller_mistakes, only : mistakes_t
   use camroller_deck_schema, only : schema_t, type_number, type_integer, type_numbers, type_integers, type_words
   use camroller_deck_keys, only : sweep_key_count
   use camroller_deck_values, only : split_words, longest_text
   use camroller_settings, only : settings_t, take, is_known, is_wrong, get_word, has_group
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_matching, only : override_t, apply_override, find_override
   implicit none
   private

   public :: sweep_t, sweep_axis_t, read_sweep, sweep_size, sweep_position, sweep_overrides, sweep_numbers, sweep_words, &
      & case_in_words

   !> Most cases of a grid
   integer, parameter :: most_cases = 1000000

   !> One key that varies
   type :: sweep_axis_t
      !> As `group.key`
      character(len=:), allocatable :: key
      !> Unit of its values; `1` for none
      character(len=unit_name_length) :: unit = "1"
      !> Are the values numbers?
      logical :: is_numeric = .false.
      !> Its values as text
      character(len=longest_text), allocatable :: values(:)
   end type sweep_axis_t

   !> The grid
   type :: sweep_t
      !> Keys that vary
      type(sweep_axis_t), allocatable :: axes(:)
   end type sweep_t

contains

   !> Read the group &sweep.
   subroutine read_sweep(schema, settings, sweep, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The grid
      type(sweep_t), intent(out) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(sweep_axis_t) :: axis
      character(len=1) :: digit
      integer :: i, before

      allocate (sweep%axes(0))
      if (.not. has_group(settings, "sweep")) return
      do i = 1, sweep_key_count
         write (digit, '(i1)') i
         if (.not. is_known(settings, "sweep", "key_"//digit)) then
            call refuse_values_without_key(settings, digit, mistakes)
            cycle
         end if
         before = mistakes%count
         call read_axis(schema, settings, digit, axis, mistakes)
         if (mistakes%count > before .or. .not. allocated(axis%values)) cycle
         if (has_axis(sweep, axis%key)) then
            call complain(mistakes, settings, "sweep", "key_"//digit, "'"//axis%key//"' is swept twice")
            cycle
         end if
         sweep%axes = [sweep%axes, axis]
      end do
      if (size(sweep%axes) == 0 .and. mistakes%count == 0) then
         call complain_about_group(mistakes, settings, "sweep", "&sweep needs 'key_1' with 'values_1'")
      else if (sweep_size(sweep) == 0) then
         call complain_about_group(mistakes, settings, "sweep", "the grid has more than "//integer_text(most_cases)// &
            & " cases")
      end if
   end subroutine read_sweep

   !> Values of a key that is not named.
   subroutine refuse_values_without_key(settings, digit, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=7), parameter :: keys(*) = [character(len=7) :: "values_", "from_", "to_", "count_"]
      integer :: i

      if (is_wrong(settings, "sweep", "key_"//digit)) return
      do i = 1, size(keys)
         if (.not. is_known(settings, "sweep", trim(keys(i))//digit)) cycle
         call complain(mistakes, settings, "sweep", trim(keys(i))//digit, "there is no 'key_"//digit//"' for it")
         return
      end do
   end subroutine refuse_values_without_key

   !> Does a key vary already?
   pure function has_axis(sweep, key) result(verdict)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> As `group.key`
      character(len=*), intent(in) :: key
      !> Does it?
      logical :: verdict

      integer :: i

      verdict = .false.
      do i = 1, size(sweep%axes)
         verdict = verdict .or. sweep%axes(i)%key == key
      end do
   end function has_axis

   !> One key and its values.
   subroutine read_axis(schema, settings, digit, axis, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> The key and its values
      type(sweep_axis_t), intent(out) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: reason
      integer :: group, key

      call find_override(schema, get_word(settings, "sweep", "key_"//digit)//"=0", settings, group, key, reason)
      if (.not. allocated(reason)) then
         if (schema%groups(group)%name == "sweep" .or. schema%groups(group)%name == "output") then
            reason = "keys of &"//trim(schema%groups(group)%name)//" cannot be swept"
         else if (any(schema%keys(key)%type == [type_numbers, type_integers, type_words])) then
            reason = "'"//trim(schema%keys(key)%name)//"' is a list and cannot be swept"
         end if
      end if
      if (allocated(reason)) then
         call complain(mistakes, settings, "sweep", "key_"//digit, reason)
         return
      end if
      axis%key = trim(schema%groups(group)%name)//"."//trim(schema%keys(key)%name)
      axis%is_numeric = any(schema%keys(key)%type == [type_number, type_integer])
      axis%unit = schema%keys(key)%unit%symbol
      call read_axis_values(settings, digit, axis, mistakes)
      if (.not. allocated(axis%values)) return
      call try_values(schema, settings, digit, axis, mistakes)
   end subroutine read_axis

   !> Values of a key: a list, or so many between two ends.
   subroutine read_axis_values(settings, digit, axis, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> The key; gets its values
      type(sweep_axis_t), intent(inout) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=longest_text), allocatable :: words(:)
      !> First and last value [unit of the key]
      real(wp) :: first, last
      logical :: has_list, has_range
      integer :: n, i

      has_list = is_known(settings, "sweep", "values_"//digit)
      has_range = is_known(settings, "sweep", "from_"//digit) .and. is_known(settings, "sweep", "to_"//digit) .and. &
         & is_known(settings, "sweep", "count_"//digit)
      if (has_list .eqv. has_range) then
         if (any([is_wrong(settings, "sweep", "values_"//digit), is_wrong(settings, "sweep", "from_"//digit), &
            & is_wrong(settings, "sweep", "to_"//digit), is_wrong(settings, "sweep", "count_"//digit)])) return
         call complain(mistakes, settings, "sweep", "key_"//digit, "'key_"//digit//"' needs either 'values_"//digit// &
            & "' or 'from_"//digit//"', 'to_"//digit//"' and 'count_"//digit//"'")
         return
      end if
      if (has_list) then
         allocate (words(len(get_word(settings, "sweep", "values_"//digit))/2 + 1))
         call split_words(get_word(settings, "sweep", "values_"//digit), words, n)
      else
         call take(settings, "sweep", "from_"//digit, first)
         call take(settings, "sweep", "to_"//digit, last)
         call take(settings, "sweep", "count_"//digit, n)
         allocate (words(n))
         do i = 1, n
            words(i) = number_text(first + (last - first)*real(i - 1, wp)/real(n - 1, wp), 15)
         end do
      end if
      axis%values = words(:n)
   end subroutine read_axis_values

   !> Is each value one that the key takes, and there once?
   subroutine try_values(schema, settings, digit, axis, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> The key and its values
      type(sweep_axis_t), intent(in) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(settings_t) :: trial
      type(mistakes_t) :: found
      character(len=:), allocatable :: key
      integer :: i

      key = "values_"//digit
      if (.not. is_known(settings, "sweep", key)) key = "from_"//digit
      trial = settings
      do i = 1, size(axis%values)
         call apply_override(schema, override_t(axis%key//"="//trim(axis%values(i))), trial, found)
         if (found%count > 0) then
            call complain(mistakes, settings, "sweep", key, "value "//integer_text(i)//" of "//axis%key//": "// &
               & found%list(1)%message)
            return
         end if
         if (any(axis%values(:i - 1) == axis%values(i))) then
            call complain(mistakes, settings, "sweep", key, "value "//trim(axis%values(i))//" of "//axis%key// &
               & " is there twice")
            return
         end if
      end do
   end subroutine try_values

   !> Number of cases; 0 where there are too many.
   pure function sweep_size(sweep) result(cases)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of cases
      integer :: cases

      integer :: i

      cases = 1
      do i = 1, size(sweep%axes)
         if (cases > most_cases/size(sweep%axes(i)%values)) then
            cases = 0
            return
         end if
         cases = cases*size(sweep%axes(i)%values)
      end do
   end function sweep_size

   !> Place of a case along each key.
   pure function sweep_position(sweep, case_number) result(position)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> Place among the values of each key, from 1
      integer :: position(size(sweep%axes))

      integer :: rest, i

      rest = case_number - 1
      do i = size(sweep%axes), 1, -1
         position(i) = modulo(rest, size(sweep%axes(i)%values)) + 1
         rest = rest/size(sweep%axes(i)%values)
      end do
   end function sweep_position

   !> What is different in a case.
   subroutine sweep_overrides(sweep, case_number, overrides)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> One override for each key that varies
      type(override_t), allocatable, intent(out) :: overrides(:)

      integer :: position(size(sweep%axes))
      integer :: i

      position = sweep_position(sweep, case_number)
      allocate (overrides(size(sweep%axes)))
      do i = 1, size(sweep%axes)
         overrides(i)%text = sweep%axes(i)%key//"="//trim(sweep%axes(i)%values(position(i)))
      end do
   end subroutine sweep_overrides

   !> A case in words: its number as in result files, from 0, and what is different in it.
   function case_in_words(sweep, case_number) result(words)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of the case, from 1
      integer, intent(in) :: case_number
      !> The words
      character(len=:), allocatable :: words

      type(override_t), allocatable :: overrides(:)
      integer :: i

      words = "case "//integer_text(case_number - 1)
      call sweep_overrides(sweep, case_number, overrides)
      do i = 1, size(overrides)
         words = words//merge(" (", ", ", i == 1)//overrides(i)%text
      end do
      if (size(overrides) > 0) words = words//")"
   end function case_in_words

   !> Values of one key that varies, for every case.
   subroutine sweep_numbers(sweep, axis, numbers)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Its value in each case [unit of the key]
      real(wp), allocatable, intent(out) :: numbers(:)

      integer :: position(size(sweep%axes))
      integer :: i

      allocate (numbers(sweep_size(sweep)))
      do i = 1, size(numbers)
         position = sweep_position(sweep, i)
         read (sweep%axes(axis)%values(position(axis)), *) numbers(i)
      end do
   end subroutine sweep_numbers

   !> Names of one key that varies, for every case, without quotes.
   subroutine sweep_words(sweep, axis, words)
      !> The grid
      type(sweep_t), intent(in) :: sweep
      !> Number of the key
      integer, intent(in) :: axis
      !> Its value in each case
      character(len=longest_text), allocatable, intent(out) :: words(:)

      integer :: position(size(sweep%axes))
      integer :: i, last

      allocate (words(sweep_size(sweep)))
      do i = 1, size(words)
         position = sweep_position(sweep, i)
         words(i) = sweep%axes(axis)%values(position(axis))
         last = len_trim(words(i))
         if (scan(words(i), "'""") == 1) words(i) = words(i) (2:last - 1)
      end do
   end subroutine sweep_words

end module camroller_deck_sweep
