!> Remarks on a deck: numbers that no engine has, and what may have been meant.
!>
!> In: a deck. Out: sentences. Nothing is refused for them: a deck may be about something unusual. Of a deck with mistakes only
!> single numbers are looked at, since one in another unit may be the reason of a mistake elsewhere.
module camroller_deck_remarks
   use camroller_kinds, only : wp
   use camroller_units, only : unit_t, find_unit, from_si, to_si
   use camroller_number_text, only : number_text, is_number
   use camroller_mistakes, only : line_t
   use camroller_text_list, only : text_at
   use camroller_deck_schema, only : key_t, type_number, type_numbers
   use camroller_deck_meant, only : ask_kinematic, is_usual, say_meant
   use camroller_deck_sweep, only : sweep_axis_t
   use camroller_settings, only : get_word, take, find_value
   use camroller_deck_tables, only : get_lift_table
   use camroller_lift, only : lift_t
   use camroller_lift_noise, only : find_lift_noise, lift_noise_t
   use camroller_table_file, only : table_t
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, make_case, override_t
   use camroller_error, only : error_t
   use camroller_high_shear, only : compare_hths
   implicit none
   private

   public :: list_deck_remarks, list_number_remarks

   !> Digits of numbers in sentences
   integer, parameter :: digits = 6
   !> Above this temperature no engine oil is thicker than that [K], [Pa s]
   real(wp), parameter :: warm = 293.15_wp, thickest_warm = 2.0_wp
   !> HTHS over the viscosity without shear by the law [-]. Smallest: SAE J300 (2021) allows 3.7 mPa s for grade 60, whose 26 mm^2/s
   !> at 100 degC are about 8 mPa s at 150 degC. Largest: one, and room for the law beyond 100 degC
   real(wp), parameter :: usual_thinning(2) = [0.45_wp, 1.1_wp]
   !> Usual lengths of an event [deg of cam angle], and usual lifts [m]
   real(wp), parameter :: usual_event(2) = [60.0_wp, 220.0_wp], usual_lift(2) = [1.0e-3_wp, 25.0e-3_wp]
   !> Powers of ten between a table's unit and another one; nearer ones first
   integer, parameter :: slips(*) = [3, -3, 6, -6, 9, -9]

contains

   !> Remarks on the values of a deck without mistakes, those of its sweep included.
   subroutine list_deck_remarks(deck, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Sentences
      type(line_t), allocatable, intent(out) :: remarks(:)

      call list_number_remarks(deck, remarks)
      call remark_viscosity(deck, remarks)
      call remark_hths(deck, remarks)
      call remark_lift(deck, "lift", deck%tables%lift, remarks)
      call remark_lift(deck, "second_lift", deck%tables%second_lift, remarks)
   end subroutine list_deck_remarks

   !> Remarks on the single numbers of a deck, as far as it could be read.
   subroutine list_number_remarks(deck, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Sentences
      type(line_t), allocatable, intent(out) :: remarks(:)

      integer :: i, k, axis

      allocate (remarks(0))
      if (.not. allocated(deck%settings%values) .or. .not. allocated(deck%sweep%axes)) return
      do i = 1, deck%schema%key_count
         associate (key => deck%schema%keys(i), value => deck%settings%values(i))
            if (.not. key%has_usual .or. .not. value%is_given .or. .not. value%is_known) cycle
            if (.not. deck%settings%groups(key%group)%is_present) cycle
            axis = axis_of(deck, i)
            if (axis > 0) then
               call remark_axis(key, name_of(deck, i), deck%sweep%axes(axis), remarks)
            else if (key%type == type_number .or. key%type == type_numbers) then
               do k = 1, size(value%numbers)
                  call remark_number(key, name_of(deck, i), from_si(key%unit, value%numbers(k)), remarks)
               end do
            end if
         end associate
      end do
   end subroutine list_number_remarks

   !> Name of a key with its group.
   pure function name_of(deck, position) result(name)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Position of the key
      integer, intent(in) :: position
      !> As `group.key`
      character(len=1 + len_trim(deck%schema%groups(deck%schema%keys(position)%group)%name) &
         & + len_trim(deck%schema%keys(position)%name)) :: name

      name = trim(deck%schema%groups(deck%schema%keys(position)%group)%name)//"."//trim(deck%schema%keys(position)%name)
   end function name_of

   !> Position of a key among those that vary, 0 where it does not.
   pure function axis_of(deck, position) result(axis)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Position of the key
      integer, intent(in) :: position
      !> The position
      integer :: axis

      do axis = size(deck%sweep%axes), 1, -1
         if (deck%sweep%axes(axis)%key == name_of(deck, position)) return
      end do
   end function axis_of

   !> Values of a key that varies.
   subroutine remark_axis(key, name, axis, remarks)
      !> The key
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
         call remark_number(key, name, axis%first, remarks)
         if (size(remarks) == before) call remark_number(key, name, axis%last, remarks)
         return
      end if
      do i = 1, axis%values%count
         word = text_at(axis%values, i)
         if (.not. is_number(word)) cycle
         read (word, *, iostat=status) number
         if (status == 0) call remark_number(key, name, number, remarks)
         if (size(remarks) > before) return
      end do
   end subroutine remark_axis

   !> One number.
   subroutine remark_number(key, name, number, remarks)
      !> The key
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
      call add_remark(remarks, name//" = "//number_text(number, digits)//" is unusual: engines have "// &
         & number_text(key%usual%smallest)//" to "//number_text(key%usual%largest, digits)//unit//words)
   end subroutine remark_number

   !> Viscosities that no oil has at their temperature.
   subroutine remark_viscosity(deck, remarks)
      !> The deck
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
         if (axis_of(deck, find_value(deck%settings, group, "viscosity_Pa_s")) > 0) return
         if (axis_of(deck, find_value(deck%settings, "operating_point", "oil_temperature_degC")) > 0) return
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
         call add_remark(remarks, "lubricant: "//number_text(viscosities(i), digits)//" Pa s at "// &
            & number_text(from_si(celsius, temperatures(i)), digits)//" degC is unusual: no engine oil is thicker than "// &
            & number_text(thickest_warm)//" Pa s above 20 degC"//words)
      end do
   end subroutine remark_viscosity

   !> Viscosity at high shear that does not go with the viscosity of the same oil without shear.
   subroutine remark_hths(deck, remarks)
      !> The deck
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
      call add_remark(remarks, "lubricant.hths_viscosity_mPa_s = "//number_text(1.0e3_wp*case%lubricant%hths_viscosity, digits)// &
         & " is "//number_text(ratio, 3)//" of the "//number_text(1.0e3_wp*viscosity, 3)//" mPa s that the oil has at 150 degC "// &
         & "without shear, by its law of viscosity; "//words//": are they of the same oil?")
   end subroutine remark_hths

   !> A lift table in another unit, or over another angle.
   subroutine remark_lift(deck, group, table, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Group of the lift
      character(len=*), intent(in) :: group
      !> Its table
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      type(unit_t) :: unit
      logical :: is_there
      ! Largest lift [m]; length of the event [deg]
      real(wp) :: largest, length
      character(len=:), allocatable :: words
      integer :: i

      if (.not. allocated(table%x) .or. get_word(deck%settings, group, "law") /= "table") return
      if (size(table%x) == 0) return
      call find_unit(get_word(deck%settings, group, "table_unit"), unit, is_there)
      largest = to_si(unit, maxval(table%y))
      if (largest < usual_lift(1) .or. largest > usual_lift(2)) then
         words = ""
         do i = 1, size(slips)
            if (largest*10.0_wp**slips(i) < usual_lift(1) .or. largest*10.0_wp**slips(i) > usual_lift(2)) cycle
            words = "; is 'table_unit' right?"
         end do
         call add_remark(remarks, table%path//": a largest lift of "//number_text(1.0e3_wp*largest, digits)// &
            & " mm is unusual: engines have 1 to 25 mm"//words)
      end if
      call remark_noise(deck, group, table, remarks)
      length = table%x(min(size(table%x), findloc(table%y > 0.0_wp, .true., dim=1, back=.true.) + 1)) &
         & - table%x(max(1, findloc(table%y > 0.0_wp, .true., dim=1) - 1))
      if (length >= usual_event(1) .and. length <= usual_event(2)) return
      words = ""
      if (0.5_wp*length >= usual_event(1) .and. 0.5_wp*length <= usual_event(2)) words = &
         & "; is the angle that of the crankshaft? A table takes the cam's, half of it"
      call add_remark(remarks, table%path//": an event of "//number_text(length, digits)// &
         & " degrees of cam angle is unusual: engines have 60 to 220"//words)
   end subroutine remark_lift

   !> A lift table whose noise makes up the acceleration.
   subroutine remark_noise(deck, group, table, remarks)
      !> The deck
      type(deck_t), intent(in) :: deck
      !> Group of the lift
      character(len=*), intent(in) :: group
      !> Its table
      type(table_t), intent(in) :: table
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Growth of the acceleration that is worth a word [-]
      real(wp), parameter :: large = 1.1_wp
      type(lift_t) :: lift
      type(lift_noise_t) :: noise

      lift%law = "table"
      call take(deck%settings, group, "smoothing_um", lift%smoothing)
      call get_lift_table(deck%settings, group, table, lift%table_angle, lift%table_lift)
      call find_lift_noise(lift, noise)
      if (.not. noise%is_known .or. lift%smoothing >= noise%noise) return
      if (all(abs(noise%given) <= large*abs(noise%smoothed))) return
      call add_remark(remarks, table%path//": the lift has noise of about "//number_text(1.0e6_wp*noise%noise, 2)// &
         & " um, which makes its second derivative "//number_text(1.0e3_wp*noise%given(1), 3)//" to "// &
         & number_text(1.0e3_wp*noise%given(2), 3)//" mm/rad^2; with smoothing_um = "//number_text(1.0e6_wp*noise%noise, 2)// &
         & " in &"//group//" it is "//number_text(1.0e3_wp*noise%smoothed(1), 3)//" to "// &
         & number_text(1.0e3_wp*noise%smoothed(2), 3)//". Loads and the speed at which contact is lost follow it")
   end subroutine remark_noise

   !> Lengthen the list. A constructor within a list would leak its text with gfortran.
   subroutine add_remark(remarks, text)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)
      !> One more
      character(len=*), intent(in) :: text

      type(line_t), allocatable :: longer(:)

      allocate (longer(size(remarks) + 1))
      longer(:size(remarks)) = remarks
      longer(size(longer))%text = text
      call move_alloc(longer, remarks)
   end subroutine add_remark

end module camroller_deck_remarks
