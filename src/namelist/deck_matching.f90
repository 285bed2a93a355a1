!> A deck held against the schema: which groups and keys are known, given, missing, and what their values are.
!>
!> In: groups, keys and texts of a deck; overrides `group.key=value`. Out: settings, with a mistake for whatever does
!> not fit.
module camroller_deck_matching
   use camroller_kinds, only : wp
   use camroller_names, only : write_names
   use camroller_quotes, only : in_quotes
   use camroller_mistakes, only : mistakes_t, add_mistake, is_shown_at, override_place, shown
   use camroller_near_names, only : nearest_name
   use camroller_deck_text, only : deck_text_t, assignment_t, to_lower
   use camroller_deck_schema, only : schema_t, key_length, find_group, group_names, key_names, group_required, &
      & group_effect, type_name, type_text
   use camroller_deck_values, only : read_value
   use camroller_units, only : unit_t, unit_of_key
   use camroller_settings, only : settings_t, find_value, has_group, is_known, take
   use camroller_deck_complaint, only : complain_about_group
   implicit none
   private

   public :: override_t, add_override, new_settings, match_deck, apply_override, find_override, demand_required, &
      & fill_dependent_defaults

   !> A value given beside the deck
   type :: override_t
      !> As `group.key=value`
      character(len=:), allocatable :: text
   end type override_t

contains

   !> Lengthen a list of values given beside the deck. A constructor within a list would leak its text with gfortran.
   pure subroutine add_override(overrides, text)
      !> The list
      type(override_t), allocatable, intent(inout) :: overrides(:)
      !> As `group.key=value`
      character(len=*), intent(in) :: text

      type(override_t) :: new

      new%text = text
      overrides = [overrides, new]
   end subroutine add_override

   !> Settings with the defaults of all keys.
   subroutine new_settings(schema, settings)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(out) :: settings

      character(len=:), allocatable :: reason
      integer :: i

      allocate (settings%groups(schema%group_count), settings%values(schema%key_count))
      do i = 1, schema%group_count
         settings%groups(i)%name = schema%groups(i)%name
         settings%groups(i)%first = schema%groups(i)%first
         settings%groups(i)%last = schema%groups(i)%last
      end do
      do i = 1, schema%key_count
         settings%values(i)%name = schema%keys(i)%name
         settings%values(i)%text = ""
         if (.not. allocated(schema%keys(i)%default)) cycle
         call read_value(schema%keys(i), schema%keys(i)%default, settings%values(i), reason)
      end do
   end subroutine new_settings

   !> Take what the deck gives.
   subroutine match_deck(schema, deck, settings, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The deck
      type(deck_text_t), intent(in) :: deck
      !> The settings; they have their defaults
      type(settings_t), intent(inout) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: positions(size(deck%groups))
      integer :: i, meant
      character(len=:), allocatable :: words

      do i = 1, size(deck%groups)
         associate (group => deck%groups(i))
            positions(i) = find_group(schema, group%name)
            if (positions(i) == 0) then
               call advise(group%name, group_names(schema), "known are ", words)
               call add_mistake(mistakes, "unknown group &"//shown(group%name)//words, group%line, group%column, &
                  & len(group%name) + 1)
               ! A group that is there under a misspelt name is not asked for
               meant = find_group(schema, nearest_name(group%name, group_names(schema)))
               if (meant > 0) settings%groups(meant)%is_misspelt = .true.
            else
               settings%groups(positions(i))%is_present = .true.
               settings%groups(positions(i))%line = group%line
               settings%groups(positions(i))%column = group%column
            end if
         end associate
      end do
      do i = 1, size(deck%assignments)
         associate (assignment => deck%assignments(i))
            if (assignment%key == "" .or. assignment%group == 0) cycle
            if (positions(assignment%group) == 0) cycle
            call match_key(schema, assignment, positions(assignment%group), settings, mistakes)
         end associate
      end do
   end subroutine match_deck

   !> Take one key.
   subroutine match_key(schema, assignment, group, settings, mistakes)
      type(schema_t), intent(in) :: schema
      !> Key and value as they stand in the deck
      type(assignment_t), intent(in) :: assignment
      !> Position of the group
      integer, intent(in) :: group
      type(settings_t), intent(inout) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: reason
      integer :: key

      key = find_key_without_case(schema, group, assignment%key)
      if (key == 0 .and. .not. is_shown_at(mistakes, assignment%line, assignment%column)) then
         call add_mistake(mistakes, "", assignment%line, assignment%column, len(assignment%key))
         return
      else if (key == 0) then
         call explain_key(schema, group, assignment%key, reason)
         call add_mistake(mistakes, reason, assignment%line, assignment%column, len(assignment%key))
         key = find_key_without_case(schema, group, nearest_name(assignment%key, key_names(schema, group)))
         if (key > 0) settings%values(key)%is_wrong = .true.
         return
      end if
      associate (value => settings%values(key))
         if (value%is_given) then
            call add_mistake(mistakes, "key '"//trim(value%name)//"' is there twice in &"// &
               & trim(settings%groups(group)%name), assignment%line, assignment%column, len(assignment%key))
            return
         end if
         value%is_given = .true.
         if (assignment%is_broken) then
            value%is_known = .false.
            value%is_wrong = .true.
            return
         end if
         call read_value(schema%keys(key), assignment%value, value, reason)
         value%line = assignment%value_line
         value%column = assignment%value_column
         value%width = assignment%value_width
         if (allocated(reason)) call add_mistake(mistakes, reason, value%line, value%column, value%width)
      end associate
   end subroutine match_key

   !> Position of a key, whatever the case of its letters: that of units counts in the schema, but not in a deck.
   pure function find_key_without_case(schema, group, name) result(position)
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: group
      !> Name of the key
      character(len=*), intent(in) :: name
      !> Its position, 0 where unknown
      integer :: position

      character(len=key_length) :: lower_name

      position = 0
      if (len_trim(name) > key_length) return
      lower_name = to_lower(trim(name))
      do position = schema%groups(group)%first, schema%groups(group)%last
         if (schema%keys(position)%lower_name == lower_name) return
      end do
      position = 0
   end function find_key_without_case

   !> The nearest known name, or all of them.
   pure subroutine advise(name, known, introduction, words)
      !> The name that is unknown
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: known(:)
      !> Words before the list of all
      character(len=*), intent(in) :: introduction
      !> What to say
      character(len=:), allocatable, intent(out) :: words

      words = nearest_name(name, known)
      if (words /= "") then
         words = "; did you mean '"//words//"'?"
      else
         call write_names(known, words)
         words = "; "//introduction//words
      end if
   end subroutine advise

   !> What to say about a key that a group does not have.
   pure subroutine explain_key(schema, group, name, words)
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: group
      !> The key
      character(len=*), intent(in) :: name
      !> What to say
      character(len=:), allocatable, intent(out) :: words

      character(len=:), allocatable :: advice
      integer :: i

      words = "unknown key '"//shown(name)//"' in &"//trim(schema%groups(group)%name)
      do i = 1, schema%group_count
         if (find_key_without_case(schema, i, name) == 0) cycle
         words = words//"; it belongs to &"//trim(schema%groups(i)%name)
         return
      end do
      if (to_lower(name) == "include") then
         words = words//"; a line include = 'file' stands outside of groups"
         return
      end if
      call advise_key(schema, group, name, advice)
      words = words//advice
   end subroutine explain_key

   !> The key of a group that an unknown one was meant to be, with its unit where that is another: a value must not be taken
   !> over as it is. Where keys of the unknown one's unit begin with the same word, these.
   pure subroutine advise_key(schema, group, name, words)
      type(schema_t), intent(in) :: schema
      !> Position of the group
      integer, intent(in) :: group
      !> The unknown key
      character(len=*), intent(in) :: name
      !> What to say
      character(len=:), allocatable, intent(out) :: words

      ! Another name of a unit that data sheets have
      character(len=*), parameter :: centistokes = "_cSt"
      type(unit_t) :: given
      integer :: nearest, key, first

      given = unit_of_key(name)
      if (len_trim(name) > len(centistokes)) then
         if (index(trim(name), centistokes, back=.true.) == len_trim(name) - len(centistokes) + 1) given = unit_of_key("one_mm2_s")
      end if
      nearest = find_key_without_case(schema, group, nearest_name(name, key_names(schema, group)))
      words = ""
      if (given%suffix /= "" .and. .not. has_unit(nearest)) then
         first = index(name, "_")
         do key = schema%groups(group)%first, schema%groups(group)%last
            if (index(schema%keys(key)%name, name(:first)) /= 1 .or. .not. has_unit(key)) cycle
            if (words /= "") words = words//" or"
            words = words//" '"//trim(schema%keys(key)%name)//"'"
         end do
      end if
      if (words /= "") then
         words = "; did you mean"//words//"?"
         return
      end if
      call advise(name, key_names(schema, group), "it has ", words)
      if (nearest == 0) return
      associate (unit => schema%keys(nearest)%unit)
         if (unit%suffix /= "" .and. .not. has_unit(nearest)) words = words//" Its values are in "//trim(unit%symbol)
      end associate

   contains

      !> Does a key have the unit of the unknown one?
      pure function has_unit(key) result(verdict)
         !> Position of the key; 0 for none
         integer, intent(in) :: key
         !> Does it?
         logical :: verdict

         verdict = .false.
         if (key > 0) verdict = schema%keys(key)%unit%suffix == given%suffix
      end function has_unit

   end subroutine advise_key

   !> Take a value that is given beside the deck.
   subroutine apply_override(schema, override, settings, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The value, as `group.key=value`
      type(override_t), intent(in) :: override
      !> The settings
      type(settings_t), intent(inout) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: reason, text
      integer :: group, key, equals

      call find_override(schema, override%text, settings, group, key, reason)
      equals = index(override%text, "=")
      if (.not. allocated(reason)) then
         text = trim(adjustl(override%text(equals + 1:)))
         associate (value => settings%values(key))
            if (schema%keys(key)%type == type_name .or. schema%keys(key)%type == type_text) then
               if (scan(text, "'""") /= 1) text = in_quotes(text)
            else if (scan(text, "=/!&") > 0) then
               reason = "'"//shown(text)//"' is no value of '"//trim(value%name)//"'"
            end if
            if (.not. allocated(reason)) call read_value(schema%keys(key), text, value, reason)
            value%is_wrong = allocated(reason)
            value%is_given = .true.
            value%line = 0
            value%source = override%text
            settings%groups(group)%is_present = .true.
         end associate
      end if
      if (allocated(reason)) then
         call add_mistake(mistakes, reason, 0, 1, len(override%text), override_place, override%text)
      end if
   end subroutine apply_override

   !> Group and key of an override.
   subroutine find_override(schema, text, settings, group, key, reason)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The override
      character(len=*), intent(in) :: text
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Positions of group and key
      integer, intent(out) :: group, key
      !> What is wrong; not allocated where nothing is
      character(len=:), allocatable, intent(out) :: reason

      integer :: point, equals

      group = 0
      key = 0
      equals = index(text, "=")
      point = index(text(:max(equals - 1, 0)), ".")
      if (point < 2 .or. equals < point + 2) then
         reason = "expected group.key=value"
         return
      end if
      group = find_group(schema, to_lower(trim(adjustl(text(:point - 1)))))
      if (group == 0) then
         call advise(text(:point - 1), group_names(schema), "known are ", reason)
         reason = "unknown group '"//shown(text(:point - 1))//"'"//reason
         return
      end if
      key = find_key_without_case(schema, group, trim(adjustl(text(point + 1:equals - 1))))
      if (key == 0) then
         call explain_key(schema, group, trim(adjustl(text(point + 1:equals - 1))), reason)
      else if (schema%groups(group)%kind == group_effect .and. .not. settings%groups(group)%is_present) then
         reason = "&"//trim(schema%groups(group)%name)//" is not in the deck; add the group to switch its effect on"
      end if
   end subroutine find_override

   !> Groups and keys that must be there.
   subroutine demand_required(schema, settings, mistakes)
      !> The schema
      type(schema_t), intent(in) :: schema
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer :: i, j

      do i = 1, schema%group_count
         associate (group => schema%groups(i))
            if (.not. settings%groups(i)%is_present) then
               if (group%kind /= group_required .or. settings%groups(i)%is_misspelt) cycle
               call add_mistake(mistakes, "the group &"//trim(group%name)//" is missing ("//group%meaning//")", 0, 0, 0)
               cycle
            end if
            do j = group%first, group%last
               if (.not. schema%keys(j)%is_required) cycle
               if (settings%values(j)%is_given .or. settings%values(j)%is_wrong) cycle
               call complain_about_group(mistakes, settings, trim(group%name), "&"//trim(group%name)//" needs '"// &
                  & trim(schema%keys(j)%name)//"' ("//schema%keys(j)%meaning//")")
            end do
         end associate
      end do
   end subroutine demand_required

   !> Defaults that follow from other values.
   subroutine fill_dependent_defaults(settings)
      !> The settings
      type(settings_t), intent(inout) :: settings

      integer :: camshafts

      call copy_value(settings, "lift", "opening_half_angle_deg", "closing_half_angle_deg")
      call copy_value(settings, "second_lift", "opening_half_angle_deg", "closing_half_angle_deg")
      ! A tolerance that is given takes the place of the accuracy, which then has no value
      if (is_known(settings, "numerics", "tolerance") .and. &
         & .not. settings%values(find_value(settings, "numerics", "accuracy"))%is_given) then
         settings%values(find_value(settings, "numerics", "accuracy"))%is_known = .false.
      end if
      if (.not. has_group(settings, "cam_bearings")) return
      if (.not. is_known(settings, "cam_bearings", "cam_positions_mm")) return
      if (.not. has_group(settings, "engine")) call fill_list(settings, "cam_phases_deg", "0")
      call fill_list(settings, "follower_angles_deg", "0")
      ! Each of two camshafts has a lobe shape of its own
      camshafts = 1
      if (has_group(settings, "engine")) call take(settings, "engine", "camshafts", camshafts)
      if (camshafts == 1) call fill_list(settings, "cam_lobes", "1")
   end subroutine fill_dependent_defaults

   !> Where a key has no value, take that of another key.
   subroutine copy_value(settings, group, from, to)
      type(settings_t), intent(inout) :: settings
      !> Names of the group, of the key that has a value and of the one that needs it
      character(len=*), intent(in) :: group, from, to

      integer :: source, target

      source = find_value(settings, group, from)
      target = find_value(settings, group, to)
      if (settings%values(target)%is_given .or. .not. settings%values(source)%is_known) return
      settings%values(target)%numbers = settings%values(source)%numbers
      if (allocated(settings%values(source)%text)) settings%values(target)%text = settings%values(source)%text
      settings%values(target)%is_known = .true.
   end subroutine copy_value

   !> Where a list of the cams is not given, take the same number for every cam.
   subroutine fill_list(settings, key, digit)
      type(settings_t), intent(inout) :: settings
      !> Name of the list
      character(len=*), intent(in) :: key
      !> The number
      character(len=1), intent(in) :: digit

      integer :: cams, i

      cams = size(settings%values(find_value(settings, "cam_bearings", "cam_positions_mm"))%numbers)
      associate (value => settings%values(find_value(settings, "cam_bearings", key)))
         if (value%is_given) return
         value%text = digit//repeat(", "//digit, cams - 1)
         if (key == "cam_lobes") then
            value%integers = [(1, i=1, cams)]
         else
            value%numbers = [(0.0_wp, i=1, cams)]
         end if
         value%is_known = .true.
      end associate
   end subroutine fill_list

end module camroller_deck_matching
