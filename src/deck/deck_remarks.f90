!> Remarks on a deck: numbers that no engine has, and what may have been meant.
!>
!> In: a deck. Out: sentences. Nothing is refused for them: a deck may be about something unusual. Of a deck with mistakes only
!> single numbers are looked at, since one in another unit may be the reason of a mistake elsewhere.
module camroller_deck_remarks
   use camroller_kinds, only : wp
   use camroller_units, only : unit_t, find_unit, from_si, to_si
   use camroller_number_text, only : number_text, is_number
   use camroller_mistakes, only : shown
   use camroller_text_lines, only : add_line, line_t
   use camroller_text_list, only : text_at
   use camroller_deck_engine, only : strokes_of
   use camroller_deck_text, only : to_lower
   use camroller_deck_schema, only : key_length, key_t, range_t, type_number, type_numbers
   use camroller_deck_values, only : read_value, value_t
   use camroller_unit_guess, only : ask_kinematic, is_usual, say_meant
   use camroller_deck_train_remarks, only : remark_end_drop, remark_pivot, remark_stem_axis
   use camroller_deck_sense, only : list_odd_pairs
   use camroller_deck_files, only : list_case_tables
   use camroller_deck_sweep, only : axis_of, first_case, sweep_axis_t, sweep_overrides
   use camroller_key_uses, only : is_idle, say_idle
   use camroller_engine, only : speed_names
   use camroller_settings, only : settings_t, get_word, has_group, take, find_value
   use camroller_deck_table_remarks, only : remark_lift, remark_measured, remark_pressure, remark_rows
   use camroller_deck_tables, only : deck_tables_t, find_table, table_groups
   use camroller_table_file, only : table_t
   use camroller_case, only : case_t, select_names, select_needed
   use camroller_deck, only : add_override, deck_t, make_case, make_settings, override_t
   use camroller_error, only : error_t
   use camroller_oil_checks, only : compare_hths, find_far_points, find_far_table, rises_t
   implicit none
   private

   public :: list_deck_remarks, list_number_remarks

   !> Digits of numbers in sentences, and as many as give every number back
   integer, parameter :: digits = 6, all_digits = 17
   !> Above this temperature no engine oil is thicker than that [K], [Pa s]
   real(wp), parameter :: warm = 293.15_wp, thickest_warm = 2.0_wp
   !> HTHS over the viscosity without shear by the law [-]. Smallest: SAE J300 (2021) allows 3.7 mPa s for grade 60, whose 26 mm^2/s
   !> at 100 degC are about 8 mPa s at 150 degC. Largest: one, and room for the law beyond 100 degC
   real(wp), parameter :: usual_thinning(2) = [0.45_wp, 1.1_wp]

contains

   !> Remarks on the values of a deck without mistakes, those of its sweep included.
   subroutine list_deck_remarks(deck, remarks, of_hosts)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Sentences
      type(line_t), allocatable, intent(out) :: remarks(:)
      !> Are followers to be driven step by step, too? Not without it
      logical, intent(in), optional :: of_hosts

      ! Keys that vary, and those that have a remark of their own
      character(len=2*key_length), allocatable :: left_out(:)
      integer :: axes, i

      call list_number_remarks(deck, remarks)
      axes = size(deck%sweep%axes)
      allocate (left_out(axes + size(remarks)))
      do i = 1, axes
         left_out(i) = deck%sweep%axes(i)%key
      end do
      do i = 1, size(remarks)
         left_out(axes + i) = remarks(i)%text(:index(remarks(i)%text//" ", " ") - 1)
      end do
      call list_odd_pairs(deck%settings, left_out(:axes), left_out, remarks)
      call remark_stem_axis(deck, left_out, remarks)
      call remark_pivot(deck, left_out(:axes), remarks)
      call remark_end_drop(deck, left_out, remarks)
      call remark_viscosity(deck, remarks)
      call remark_hths(deck, remarks)
      call remark_temperature(deck, remarks)
      do i = 1, size(table_groups)
         call remark_tables(deck, trim(table_groups(i)), .false., remarks)
      end do
      call remark_measured(deck%sweep, remarks)
      call remark_unused(deck, remarks)
      if (.not. present(of_hosts)) return
      if (of_hosts .and. get_word(deck%settings, "effects", "select") == select_names(select_needed)) call add_line(remarks, &
         & "effects.select = '"//trim(select_names(select_needed))//"' is of runs: followers driven step by step, in FMUs too, "// &
         & "have all effects of the deck")
   end subroutine list_deck_remarks

   !> The table of a group: that of the deck, or those that its cases name, each as the first case has it that names it.
   subroutine remark_tables(deck, group, is_of_rows, remarks)
      type(deck_t), intent(in) :: deck
      character(len=*), intent(in) :: group
      !> On single rows, or on the table as a whole?
      logical, intent(in) :: is_of_rows
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(line_t), allocatable :: names(:)
      type(override_t), allocatable :: overrides(:)
      type(settings_t) :: settings
      type(deck_tables_t) :: tables
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: own
      integer :: i, number, axis, law

      axis = axis_of(deck%sweep, group//".table")
      law = axis_of(deck%sweep, group//".law")
      call list_case_tables(deck, group, names)
      if (axis == 0) then
         call remark_table(deck%settings, deck%tables, group, is_of_rows, remarks)
      else
         own = get_word(deck%settings, group, "table")
         if (.not. any([(names(i)%text == own, i=1, size(names))])) call add_line(names, own)
      end if
      do i = 1, size(names)
         if (axis > 0) then
            number = first_case(deck%sweep, axis, names(i)%text)
         else
            number = first_case(deck%sweep, law, "table")
         end if
         if (number == 0) cycle
         call sweep_overrides(deck%sweep, number, overrides)
         if (law > 0) call add_override(overrides, group//".law='table'")
         call make_settings(deck, overrides, settings, tables, failure)
         if (.not. allocated(failure)) call remark_table(settings, tables, group, is_of_rows, remarks)
      end do
   end subroutine remark_tables

   !> The table of a group as a case has it.
   subroutine remark_table(settings, tables, group, is_of_rows, remarks)
      type(settings_t), intent(in) :: settings
      !> Their tables
      type(deck_tables_t), intent(in) :: tables
      character(len=*), intent(in) :: group
      !> On single rows, or on the table as a whole?
      logical, intent(in) :: is_of_rows
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(table_t) :: table

      call find_table(tables, group, table)
      if (group == "gas_force") then
         if (.not. is_of_rows) call remark_pressure(settings, tables, remarks)
      else if (is_of_rows) then
         call remark_rows(settings, group, table, remarks)
      else
         call remark_lift(settings, group, table, remarks)
      end if
   end subroutine remark_table

   !> Values given beside the deck that no case of the sweep has, since it varies their keys.
   subroutine remark_unused(deck, remarks)
      type(deck_t), intent(in) :: deck
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      integer :: i, k

      do i = 1, size(deck%overrides)
         do k = 1, size(deck%sweep%axes)
            associate (key => deck%sweep%axes(k)%key, text => deck%overrides(i)%text)
               if (to_lower(trim(adjustl(text(:index(text, "=") - 1)))) /= to_lower(key)) cycle
               call add_line(remarks, "'"//shown(text)//"' is not used by the sweep, which varies "//key)
            end associate
         end do
      end do
   end subroutine remark_unused

   !> Remarks on the single numbers of a deck and on single rows of its tables of lift, as far as they could be read.
   subroutine list_number_remarks(deck, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Sentences
      type(line_t), allocatable, intent(out) :: remarks(:)

      type(key_t) :: key
      integer :: i, k, axis

      allocate (remarks(0))
      if (.not. allocated(deck%settings%values) .or. .not. allocated(deck%sweep%axes)) return
      do i = 1, deck%schema%key_count
         key = deck%schema%keys(i)
         if (name_of(deck, i) == "operating_point.speed_rpm") call take_crank_speed(deck, key%usual)
         associate (value => deck%settings%values(i))
            if (.not. value%is_given .or. .not. value%is_known) cycle
            if (.not. deck%settings%groups(key%group)%is_present) cycle
            if (is_idle(deck%settings, deck%sweep, name_of(deck, i), of_runs=.true.)) then
               call remark_idle(deck%settings, key, name_of(deck, i), value, remarks)
               cycle
            end if
            if (.not. key%has_usual) cycle
            axis = axis_of(deck%sweep, name_of(deck, i))
            if (axis > 0) then
               call remark_axis(key, name_of(deck, i), deck%sweep%axes(axis), remarks)
            else if (key%type == type_number .or. key%type == type_numbers) then
               do k = 1, size(value%numbers)
                  call remark_number(key, name_of(deck, i), from_si(key%unit, value%numbers(k)), remarks)
               end do
            end if
         end associate
      end do
      do i = 1, size(table_groups)
         call remark_tables(deck, trim(table_groups(i)), .true., remarks)
      end do
   end subroutine list_number_remarks

   !> Usual speeds where an engine's deck gives that of the crankshaft.
   subroutine take_crank_speed(deck, usual)
      type(deck_t), intent(in) :: deck
      !> Usual range; in: of the camshaft's speed
      type(range_t), intent(inout) :: usual

      if (.not. has_group(deck%settings, "engine")) return
      if (get_word(deck%settings, "engine", "given_speed") /= speed_names(1)) return
      usual%smallest = 0.5_wp*strokes_of(deck%settings)*usual%smallest
      usual%largest = 0.5_wp*strokes_of(deck%settings)*usual%largest
   end subroutine take_crank_speed

   !> Name of a key with its group.
   pure function name_of(deck, position) result(name)
      type(deck_t), intent(in) :: deck
      !> Position of the key
      integer, intent(in) :: position
      !> As `group.key`
      character(len=1 + len_trim(deck%schema%groups(deck%schema%keys(position)%group)%name) &
         & + len_trim(deck%schema%keys(position)%name)) :: name

      name = trim(deck%schema%groups(deck%schema%keys(position)%group)%name)//"."//trim(deck%schema%keys(position)%name)
   end function name_of

   !> A key that no case uses. A deck may give the default of such a key: nobody expects that to change anything.
   subroutine remark_idle(settings, key, name, value, remarks)
      type(settings_t), intent(in) :: settings
      type(key_t), intent(in) :: key
      !> As `group.key`
      character(len=*), intent(in) :: name
      type(value_t), intent(in) :: value
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: words

      if (has_default(key, value)) return
      call say_idle(settings, name, words)
      call add_line(remarks, name//" = "//shown(value%text)//" "//words)
   end subroutine remark_idle

   !> Is a value the default of its key?
   function has_default(key, value) result(verdict)
      type(key_t), intent(in) :: key
      type(value_t), intent(in) :: value
      !> Is it?
      logical :: verdict

      type(value_t) :: default
      character(len=:), allocatable :: reason

      verdict = .false.
      if (.not. allocated(key%default)) return
      call read_value(key, key%default, default, reason)
      if (key%type == type_number) then
         verdict = abs(value%numbers(1) - default%numbers(1)) <= 0.0_wp
      else
         verdict = value%text == default%text
      end if
   end function has_default

   !> Does a key take a value? One that it refuses has a mistake, and needs no remark.
   function is_taken(key, text) result(verdict)
      type(key_t), intent(in) :: key
      !> The value
      character(len=*), intent(in) :: text
      !> Does it?
      logical :: verdict

      type(value_t) :: value
      character(len=:), allocatable :: reason

      call read_value(key, text, value, reason)
      verdict = .not. allocated(reason)
   end function is_taken

   !> Values of a key that varies.
   subroutine remark_axis(key, name, axis, remarks)
      type(key_t), intent(in) :: key
      !> As `group.key`
      character(len=*), intent(in) :: name
      !> Its values
      type(sweep_axis_t), intent(in) :: axis
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! A value [unit of the key]
      real(wp) :: number
      character(len=:), allocatable :: word
      integer :: i, before, status

      before = size(remarks)
      if (axis%values%count == 0) then
         if (is_taken(key, number_text(axis%first, all_digits))) call remark_number(key, name, axis%first, remarks)
         if (size(remarks) > before) return
         if (is_taken(key, number_text(axis%last, all_digits))) call remark_number(key, name, axis%last, remarks)
         return
      end if
      do i = 1, axis%values%count
         word = text_at(axis%values, i)
         if (.not. (is_number(word) .and. is_taken(key, word))) cycle
         read (word, *, iostat=status) number
         if (status == 0) call remark_number(key, name, number, remarks)
         if (size(remarks) > before) return
      end do
   end subroutine remark_axis

   !> One number.
   subroutine remark_number(key, name, number, remarks)
      type(key_t), intent(in) :: key
      !> As `group.key`
      character(len=*), intent(in) :: name
      !> The number [unit of the key]
      real(wp), intent(in) :: number
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=:), allocatable :: words, unit

      if (is_usual(number, key%usual)) return
      unit = ""
      if (key%unit%symbol /= "1") unit = " "//trim(key%unit%symbol)
      call say_meant(key, number, words)
      call add_line(remarks, name//" = "//number_text(number, digits)//" is unusual: engines have "// &
         & number_text(key%usual%smallest)//" to "//number_text(key%usual%largest, digits)//unit//words)
   end subroutine remark_number

   !> Viscosities that no oil has at their temperature.
   subroutine remark_viscosity(deck, remarks)
      type(deck_t), intent(in) :: deck
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: group = "lubricant"
      type(unit_t) :: celsius
      logical :: is_there
      ! Temperatures [K] and viscosities [Pa s]
      real(wp), allocatable :: temperatures(:), viscosities(:)
      character(len=:), allocatable :: words
      integer :: i

      allocate (temperatures(1), viscosities(1))
      temperatures = 0.0_wp
      viscosities = 0.0_wp
      call find_unit("degC", celsius, is_there)
      select case (get_word(deck%settings, group, "temperature_law"))
      case ("direct")
         call take(deck%settings, "operating_point", "oil_temperature_degC", temperatures(1))
         call take(deck%settings, group, "viscosity_Pa_s", viscosities(1))
         if (axis_of(deck%sweep, group//".viscosity_Pa_s") > 0) return
         if (axis_of(deck%sweep, "operating_point.oil_temperature_degC") > 0) return
      case ("data_sheet")
         return
      case default
         call take(deck%settings, group, "temperature_points_degC", temperatures)
         call take(deck%settings, group, "viscosity_points_Pa_s", viscosities)
      end select
      do i = 1, min(size(temperatures), size(viscosities))
         ! Above the usual range it has its remark already
         if (temperatures(i) < warm .or. viscosities(i) <= thickest_warm .or. viscosities(i) > 20.0_wp) cycle
         call ask_kinematic(viscosities(i), words)
         call add_line(remarks, "lubricant: "//number_text(viscosities(i), digits)//" Pa s at "// &
            & number_text(from_si(celsius, temperatures(i)), digits)//" degC is unusual: no engine oil is thicker than "// &
            & number_text(thickest_warm)//" Pa s above 20 degC"//words)
      end do
   end subroutine remark_viscosity

   !> Temperatures of the oil, those of a sweep included, far from all at which something is known of it.
   subroutine remark_temperature(deck, remarks)
      type(deck_t), intent(in) :: deck
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(override_t) :: none(0)
      type(case_t) :: case
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: word
      integer :: axis, i, status, position
      ! A temperature [degC]
      real(wp) :: temperature
      ! How far the temperature farthest away is [K], and the remark on it
      real(wp) :: distance
      character(len=:), allocatable :: farthest

      call make_case(deck, none, case, failure)
      if (allocated(failure)) return
      farthest = ""
      distance = 0.0_wp
      position = find_value(deck%settings, "operating_point", "oil_temperature_degC")
      axis = axis_of(deck%sweep, "operating_point.oil_temperature_degC")
      if (axis == 0) then
         call look_at(case%operating_point%oil_temperature)
      else if (deck%sweep%axes(axis)%values%count == 0) then
         call look_at(to_si(deck%schema%keys(position)%unit, deck%sweep%axes(axis)%first))
         call look_at(to_si(deck%schema%keys(position)%unit, deck%sweep%axes(axis)%last))
      else
         do i = 1, deck%sweep%axes(axis)%values%count
            word = text_at(deck%sweep%axes(axis)%values, i)
            read (word, *, iostat=status) temperature
            if (status == 0) call look_at(to_si(deck%schema%keys(position)%unit, temperature))
         end do
      end if
      if (distance > 0.0_wp) call add_line(remarks, farthest)

   contains

      !> Keep the remark on a temperature where it is the farthest so far.
      subroutine look_at(temperature)
         !> Temperature of the oil [K]
         real(wp), intent(in) :: temperature

         character(len=:), allocatable :: words
         real(wp) :: far ! [K]

         call find_far_points(case, temperature, rises_t(), far, words)
         if (far > distance) farthest = words
         distance = max(distance, far)
         call find_far_table(case, temperature, 0.0_wp, far, words)
         if (far > distance) farthest = words
         distance = max(distance, far)
      end subroutine look_at

   end subroutine remark_temperature

   !> Viscosity at high shear that does not go with the viscosity of the same oil without shear.
   subroutine remark_hths(deck, remarks)
      type(deck_t), intent(in) :: deck
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(override_t) :: none(0)
      type(case_t) :: case
      type(error_t), allocatable :: failure
      ! Viscosity without shear [Pa s]; HTHS over it [-]
      real(wp) :: viscosity, ratio
      character(len=:), allocatable :: words
      integer :: i

      do i = 1, size(deck%sweep%axes)
         if (index(deck%sweep%axes(i)%key, "lubricant.") == 1) return
      end do
      call make_case(deck, none, case, failure)
      if (allocated(failure)) return
      call compare_hths(case%lubricant, viscosity, ratio)
      ! A number out of its usual range has its remark already
      associate (key => deck%schema%keys(find_value(deck%settings, "lubricant", "hths_viscosity_mPa_s")))
         if (.not. is_usual(from_si(key%unit, case%lubricant%hths_viscosity), key%usual)) return
      end associate
      if (viscosity <= 0.0_wp .or. (ratio >= usual_thinning(1) .and. ratio <= usual_thinning(2))) return
      words = "no oil gets thicker by shear"
      if (ratio < 1.0_wp) words = "engine oils keep more than "//number_text(usual_thinning(1))//" of it"
      call add_line(remarks, "lubricant.hths_viscosity_mPa_s = "//number_text(1.0e3_wp*case%lubricant%hths_viscosity, digits)// &
         & " is "//number_text(ratio, 3)//" of the "//number_text(1.0e3_wp*viscosity, 3)//" mPa s that the oil has at 150 degC "// &
         & "without shear, by its law of viscosity; "//words//": are they of the same oil?")
   end subroutine remark_hths

end module camroller_deck_remarks
