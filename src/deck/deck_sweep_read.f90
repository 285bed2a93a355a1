!> The group &sweep read: keys that vary, their lists, ranges or table, checked value by value.
!>
!> In: settings. Out: `sweep_t`, or mistakes at the place of the key that is wrong.
module camroller_deck_sweep_read
   use camroller_kinds, only : wp
   use camroller_number_text, only : integer_text
   use camroller_mistakes, only : mistakes_t, add_mistake, shown
   use camroller_samples, only : sobol_axes
   use camroller_deck_schema, only : schema_t, type_number, type_integer, type_numbers, type_integers, type_words
   use camroller_deck_text, only : to_lower
   use camroller_deck_sweep_keys, only : check_series, sweep_key_count
   use camroller_deck_values, only : has_empty_place, next_word, longest_text
   use camroller_settings, only : settings_t, take, is_known, is_wrong, get_word, has_group
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_matching, only : override_t, apply_override, find_override
   use camroller_deck_sweep, only : axis_of, axis_size, get_sweep_value, is_sample, most_cases, &
      & repeated_value, sweep_axis_t, sweep_size, sweep_t
   use camroller_key_uses, only : is_idle, say_idle
   use camroller_text_list, only : new_text_list, put_text_at
   use camroller_case_columns, only : column_t, column_reader_t, measured_prefix
   use camroller_sweep_table, only : add_measured, read_columns
   use camroller_text_file, only : join_path
   use camroller_error, only : error_t
   implicit none
   private

   public :: read_sweep

contains

   !> Read the group &sweep.
   subroutine read_sweep(schema, settings, folder, sweep, mistakes, reader)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      !> The sweep
      type(sweep_t), intent(out) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> Reader of tables of cases that are no text
      class(column_reader_t), intent(in), optional :: reader

      allocate (sweep%axes(0), sweep%measured(0))
      if (.not. has_group(settings, "sweep")) return
      call take(settings, "sweep", "kind", sweep%kind)
      call take(settings, "sweep", "cases", sweep%points)
      call take(settings, "sweep", "seed", sweep%seed)
      if (sweep%kind == "table") then
         call read_table_axes(schema, settings, folder, sweep, mistakes, reader)
      else
         call read_axes(schema, settings, sweep, mistakes)
      end if
      if (mistakes%count == 0) call refuse_idle_axes(settings, sweep, mistakes)
      if (mistakes%count == 0) call check_shape(settings, sweep, mistakes)
      if (mistakes%count == 0) call check_series(settings, sweep, mistakes)
   end subroutine read_sweep

   !> Keys with lists and ranges.
   subroutine read_axes(schema, settings, sweep, mistakes)
      type(schema_t), intent(in) :: schema
      type(settings_t), intent(in) :: settings
      type(sweep_t), intent(inout) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(sweep_axis_t) :: axis
      character(len=1) :: digit
      integer :: i, before
      logical :: has_values

      if (is_known(settings, "sweep", "table")) then
         call complain(mistakes, settings, "sweep", "table", "'table' needs kind = 'table'")
      end if
      do i = 1, sweep_key_count
         digit = integer_text(i)
         if (.not. is_known(settings, "sweep", "key_"//digit)) then
            call refuse_values_without_key(settings, digit, mistakes)
            cycle
         end if
         before = mistakes%count
         call find_axis(schema, settings, get_word(settings, "sweep", "key_"//digit), "key_"//digit, axis, mistakes)
         if (mistakes%count > before) cycle
         call read_axis_values(settings, digit, sweep, axis, has_values, mistakes)
         if (mistakes%count > before .or. .not. has_values) cycle
         if (axis_of(sweep, axis%key) > 0) then
            call complain(mistakes, settings, "sweep", "key_"//digit, "'"//axis%key//"' is swept twice")
            cycle
         end if
         sweep%axes = [sweep%axes, axis]
         call try_values(schema, settings, sweep, trim(values_key(settings, digit)), mistakes)
      end do
   end subroutine read_axes

   !> The key of the deck that gives the values of a key.
   pure function values_key(settings, digit) result(key)
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> Name of the key in &sweep
      character(len=8) :: key

      key = "values_"//digit
      if (.not. is_known(settings, "sweep", trim(key))) key = "from_"//digit
   end function values_key

   !> A key that no case uses would make cases that are all the same.
   subroutine refuse_idle_axes(settings, sweep, mistakes)
      type(settings_t), intent(in) :: settings
      type(sweep_t), intent(in) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: words
      character(len=5) :: place
      integer :: i, k

      do i = 1, size(sweep%axes)
         associate (key => sweep%axes(i)%key)
            if (.not. is_idle(settings, sweep, key, of_runs=.false.)) cycle
            place = "table"
            do k = 1, sweep_key_count
               if (to_lower(get_word(settings, "sweep", "key_"//integer_text(k))) == to_lower(key)) place = "key_"//integer_text(k)
            end do
            call say_idle(settings, key, words)
            call complain(mistakes, settings, "sweep", place, "'"//key//"' "//words)
         end associate
      end do
   end subroutine refuse_idle_axes

   !> Do the keys make up a sweep?
   subroutine check_shape(settings, sweep, mistakes)
      type(settings_t), intent(in) :: settings
      type(sweep_t), intent(in) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i

      if (size(sweep%axes) == 0) then
         call complain_about_group(mistakes, settings, "sweep", "&sweep needs 'key_1' with 'values_1'")
         return
      end if
      if (is_sample(sweep)) then
         if (.not. is_known(settings, "sweep", "cases")) then
            call complain(mistakes, settings, "sweep", "kind", "kind = '"//trim(sweep%kind)//"' needs 'cases'")
         end if
         if (sweep%kind == "sobol" .and. size(sweep%axes) > sobol_axes) then
            call complain(mistakes, settings, "sweep", "kind", "the Sobol sequence is there for "// &
               & integer_text(sobol_axes)//" keys")
         end if
         return
      end if
      if (is_known(settings, "sweep", "cases")) then
         call complain(mistakes, settings, "sweep", "cases", "'cases' is for samples: kind 'latin_hypercube', 'sobol' or "// &
            & "'random'")
      end if
      if (sweep%kind == "zip") then
         do i = 2, size(sweep%axes)
            if (axis_size(sweep%axes(i)) == axis_size(sweep%axes(1))) cycle
            call complain(mistakes, settings, "sweep", "kind", "kind = 'zip' needs lists of one length; "// &
               & sweep%axes(i)%key//" has "//integer_text(axis_size(sweep%axes(i)))//" values, "//sweep%axes(1)%key// &
               & " has "//integer_text(axis_size(sweep%axes(1))))
         end do
      end if
      if (sweep_size(sweep) == 0) then
         call complain_about_group(mistakes, settings, "sweep", "the grid has more than "//integer_text(most_cases)// &
            & " cases")
      end if
   end subroutine check_shape

   !> Values of a key that is not named.
   subroutine refuse_values_without_key(settings, digit, mistakes)
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

   !> A key that is to vary.
   subroutine find_axis(schema, settings, name, place, axis, mistakes)
      type(schema_t), intent(in) :: schema
      type(settings_t), intent(in) :: settings
      !> As `group.key`
      character(len=*), intent(in) :: name
      !> Key of &sweep that names it
      character(len=*), intent(in) :: place
      !> The key, without values
      type(sweep_axis_t), intent(out) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: reason
      integer :: group, key

      call find_override(schema, name//"=0", settings, group, key, reason)
      if (index(name, ".") == 0) reason = "'"//shown(name)//"' is no name of a key: that is given as group.key, as "// &
         & "operating_point.speed_rpm"
      if (.not. allocated(reason)) then
         if (schema%groups(group)%name == "sweep" .or. schema%groups(group)%name == "output") then
            reason = "keys of &"//trim(schema%groups(group)%name)//" cannot be swept"
         else if (any(schema%keys(key)%type == [type_numbers, type_integers, type_words])) then
            reason = "'"//trim(schema%keys(key)%name)//"' is a list and cannot be swept"
         end if
      end if
      if (allocated(reason)) then
         call complain(mistakes, settings, "sweep", place, reason)
         return
      end if
      axis%key = trim(schema%groups(group)%name)//"."//trim(schema%keys(key)%name)
      axis%is_numeric = any(schema%keys(key)%type == [type_number, type_integer])
      axis%is_whole = schema%keys(key)%type == type_integer
      axis%unit = schema%keys(key)%unit%symbol
   end subroutine find_axis

   !> Values of a key: a list, or a range.
   subroutine read_axis_values(settings, digit, sweep, axis, has_values, mistakes)
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      type(sweep_t), intent(in) :: sweep
      !> The key; gets its values
      type(sweep_axis_t), intent(inout) :: axis
      !> Has it got some?
      logical, intent(out) :: has_values
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: ends
      logical :: has_list
      logical, allocatable :: has_key(:)

      has_list = is_known(settings, "sweep", "values_"//digit)
      has_key = [is_known(settings, "sweep", "from_"//digit), is_known(settings, "sweep", "to_"//digit)]
      ends = "'from_"//digit//"' and 'to_"//digit//"'"
      if (.not. is_sample(sweep)) then
         has_key = [has_key, is_known(settings, "sweep", "count_"//digit)]
         ends = "'from_"//digit//"', 'to_"//digit//"' and 'count_"//digit//"'"
      end if
      has_values = merge(.not. any(has_key), all(has_key), has_list)
      if (.not. has_values) then
         if (any([is_wrong(settings, "sweep", "values_"//digit), is_wrong(settings, "sweep", "from_"//digit), &
            & is_wrong(settings, "sweep", "to_"//digit), is_wrong(settings, "sweep", "count_"//digit)])) return
         call complain(mistakes, settings, "sweep", "key_"//digit, "'key_"//digit//"' needs either 'values_"//digit// &
            & "' or "//ends)
      else if (has_list) then
         call read_list(settings, digit, get_word(settings, "sweep", "values_"//digit), axis, mistakes)
      else
         call read_range(settings, digit, sweep, axis, mistakes)
      end if
   end subroutine read_axis_values

   !> A list of values.
   subroutine read_list(settings, digit, text, axis, mistakes)
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      !> The list
      character(len=*), intent(in) :: text
      !> The key; gets its values
      type(sweep_axis_t), intent(inout) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: position, first, last, n, width, pass

      if (has_empty_place(text)) then
         call complain(mistakes, settings, "sweep", "values_"//digit, "'values_"//digit//"' has an empty place between commas: "// &
            & shown(text))
         return
      end if
      width = 1
      do pass = 1, 2
         n = 0
         position = 1
         do
            call next_word(text, position, first, last)
            if (first == 0) exit
            n = n + 1
            width = max(width, last - first + 1)
            if (pass == 2) call put_text_at(axis%values, n, text(first:last))
         end do
         if (width > longest_text) then
            call complain(mistakes, settings, "sweep", "values_"//digit, "a value of "//integer_text(width)// &
               & " characters; the longest has "//integer_text(longest_text))
            return
         end if
         if (pass == 1) call new_text_list(axis%values, n, width)
      end do
   end subroutine read_list

   !> A range of numbers.
   subroutine read_range(settings, digit, sweep, axis, mistakes)
      type(settings_t), intent(in) :: settings
      !> Number of the key
      character(len=1), intent(in) :: digit
      type(sweep_t), intent(in) :: sweep
      !> The key; gets its range
      type(sweep_axis_t), intent(inout) :: axis
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      call take(settings, "sweep", "from_"//digit, axis%first)
      call take(settings, "sweep", "to_"//digit, axis%last)
      if (.not. is_sample(sweep)) call take(settings, "sweep", "count_"//digit, axis%count)
      axis%is_logarithmic = get_word(settings, "sweep", "scale_"//digit) == "logarithmic"
      if (.not. axis%is_numeric) then
         call complain(mistakes, settings, "sweep", "from_"//digit, "'"//axis%key//"' takes names, which have no range; "// &
            & "give 'values_"//digit//"'")
      else if (axis%is_logarithmic .and. .not. min(axis%first, axis%last) > 0.0_wp) then
         call complain(mistakes, settings, "sweep", "scale_"//digit, "a logarithmic range needs ends above zero")
      else if (axis%is_whole .and. axis%count > 1 .and. .not. axis%is_logarithmic) then
         if (modulo(axis%last - axis%first, real(axis%count - 1, wp)) > 0.0_wp) then
            call complain(mistakes, settings, "sweep", "count_"//digit, "'"//axis%key//"' takes whole numbers, and "// &
               & integer_text(axis%count)//" at equal distances are none")
         end if
      end if
   end subroutine read_range

   !> Is each value of the last key one that the key takes, and in a grid there once? Of a range the ends are tried.
   subroutine try_values(schema, settings, sweep, place, mistakes, path, lines)
      type(schema_t), intent(in) :: schema
      type(settings_t), intent(in) :: settings
      !> The sweep so far
      type(sweep_t), intent(in) :: sweep
      !> Key of &sweep that gives the values
      character(len=*), intent(in) :: place
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> Table that the values are from, where there is one
      character(len=*), intent(in), optional :: path
      !> Line of each value in it; 0 where the table has no lines
      integer, intent(in), optional :: lines(:)

      type(settings_t) :: trial
      type(sweep_t) :: alone
      type(mistakes_t) :: found
      type(override_t) :: override
      character(len=:), allocatable :: value
      integer :: i, n, step

      alone%kind = "zip"
      alone%axes = sweep%axes(size(sweep%axes):)
      if (alone%axes(1)%values%count == 0) alone%axes(1)%count = max(2, alone%axes(1)%count)
      n = axis_size(alone%axes(1))
      step = 1
      if (alone%axes(1)%values%count == 0) step = n - 1
      trial = settings
      do i = 1, n, step
         call get_sweep_value(alone, 1, i, value)
         override%text = alone%axes(1)%key//"="//value
         call apply_override(schema, override, trial, found)
         if (found%count == 0) cycle
         if (present(path)) then
            call add_mistake(mistakes, "value "//integer_text(i)//" of "//alone%axes(1)%key//": "//found%list(1)%message, &
               & lines(i), 0, 0, path)
         else
            call complain(mistakes, settings, "sweep", place, "value "//integer_text(i)//" of "//alone%axes(1)%key// &
               & ": "//found%list(1)%message)
         end if
         found = mistakes_t()
      end do
      if (sweep%kind /= "grid") return
      i = repeated_value(alone%axes(1))
      if (i == 0) return
      call get_sweep_value(alone, 1, i, value)
      call complain(mistakes, settings, "sweep", place, "value "//value//" of "//alone%axes(1)%key//" is there twice")
   end subroutine try_values

   !> Keys and values from a table of cases.
   subroutine read_table_axes(schema, settings, folder, sweep, mistakes, reader)
      type(schema_t), intent(in) :: schema
      type(settings_t), intent(in) :: settings
      !> Folder of the deck
      character(len=*), intent(in) :: folder
      type(sweep_t), intent(inout) :: sweep
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes
      !> Reader of tables of cases that are no text
      class(column_reader_t), intent(in), optional :: reader

      type(column_t), allocatable :: columns(:)
      type(sweep_axis_t) :: axis
      type(error_t), allocatable :: error
      character(len=:), allocatable :: path
      integer :: i, before

      if (.not. is_known(settings, "sweep", "table")) then
         if (is_wrong(settings, "sweep", "table")) return
         call complain(mistakes, settings, "sweep", "kind", "kind = 'table' needs 'table'")
         return
      end if
      do i = 1, sweep_key_count
         if (.not. is_known(settings, "sweep", "key_"//integer_text(i))) then
            call refuse_values_without_key(settings, integer_text(i), mistakes)
            cycle
         end if
         call complain(mistakes, settings, "sweep", "key_"//integer_text(i), "the table names the keys")
         return
      end do
      path = join_path(folder, get_word(settings, "sweep", "table"))
      call read_columns(path, columns, mistakes, error, reader)
      if (allocated(error)) then
         call complain(mistakes, settings, "sweep", "table", error%message)
         return
      end if
      do i = 1, size(columns)
         before = mistakes%count
         if (index(columns(i)%key, measured_prefix) == 1) then
            call add_measured(path, columns(i), sweep, mistakes)
            cycle
         end if
         call find_axis(schema, settings, columns(i)%key, "table", axis, mistakes)
         if (mistakes%count > before) cycle
         if (axis_of(sweep, axis%key) > 0) then
            call complain(mistakes, settings, "sweep", "table", "'"//axis%key//"' is in the table twice")
            cycle
         end if
         if (columns(i)%unit == "-") columns(i)%unit = "1"
         if (columns(i)%unit /= "" .and. columns(i)%unit /= axis%unit) then
            call add_mistake(mistakes, "'"//axis%key//"' is in '"//columns(i)%unit//"'; the key takes '"//trim(axis%unit)//"'", &
               & 0, 0, 0, path)
            cycle
         end if
         axis%values = columns(i)%cells
         sweep%axes = [sweep%axes, axis]
         call try_values(schema, settings, sweep, "table", mistakes, path, columns(i)%lines)
      end do
      if (mistakes%count == 0 .and. size(sweep%axes) == 0) call add_mistake(mistakes, "the table names no key", 0, 0, 0, path)
   end subroutine read_table_axes

end module camroller_deck_sweep_read
