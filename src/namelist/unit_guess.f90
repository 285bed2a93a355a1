!> What may have been meant by a number that no engine has: the same number in another unit.
!>
!> In: a key with its usual range, a number. Out: a question. Remarks and refusals ask it.
module camroller_unit_guess
   use camroller_kinds, only : wp, degree, celsius_zero
   use camroller_number_text, only : number_text
   use camroller_deck_schema, only : key_t, range_t
   use camroller_units, only : unit_name_length
   implicit none
   private

   public :: is_usual, say_meant, ask_kinematic

   !> Digits of numbers in sentences
   integer, parameter :: digits = 6
   !> Powers of ten by which a number in another unit of common use has to be multiplied for the unit of a key; zero where there
   !> are no more. A unit that is not here is taken for no other one: nobody writes millinewtons or kilotonnes
   type :: slip_t
      !> The unit, by the last words of a key
      character(len=unit_name_length) :: suffix = ""
      !> Powers of ten, more common ones first
      integer :: powers(3) = 0
   end type slip_t
   type(slip_t), parameter :: slips(*) = [ &
      slip_t("m", [-3, -6, 0]), slip_t("mm", [3, -3, 0]), slip_t("um", [3, 6, -3]), slip_t("nm", [3, 6, 9]), &
      slip_t("mm2", [6, 0, 0]), slip_t("cm3", [3, 6, -3]), slip_t("mrad", [3, 0, 0]), &
      slip_t("m_s", [-3, 0, 0]), slip_t("nm_s", [3, 6, 9]), slip_t("s_m", [3, 0, 0]), &
      slip_t("kg", [-3, -6, 0]), slip_t("kg_m2", [-6, -9, 0]), slip_t("kg_m3", [3, 0, 0]), &
      slip_t("N", [3, 0, 0]), slip_t("N_m", [3, 6, 0]), slip_t("N_s_m", [3, 0, 0]), slip_t("Nm", [-3, 0, 0]), &
      slip_t("Pa", [3, 6, 9]), slip_t("kPa", [3, -3, 0]), slip_t("MPa", [3, -3, -6]), slip_t("GPa", [-3, -6, -9]), &
      slip_t("per_GPa", [3, 9, 0]), slip_t("Pa_s", [-3, 0, 0]), slip_t("mPa_s", [3, 0, 0]), slip_t("mm2_s", [6, 0, 0]), &
      slip_t("mm3_N_m", [3, 9, 0]), slip_t("W_m_K", [-3, 0, 0]), slip_t("J_kg_K", [3, 0, 0]), slip_t("kJ_mol", [-3, 0, 0])]
   !> Power of ten between a number without a unit and its percentage
   integer, parameter :: percent = -2
   !> Kinematic viscosities that a data sheet may give [mm^2/s]
   type(range_t), parameter :: sheet_range = range_t(2.0_wp, 500.0_wp)

contains

   !> Is a number within a usual range, but for round-off of the unit's factor?
   elemental function is_usual(number, range) result(verdict)
      !> The number [unit of the range]
      real(wp), intent(in) :: number
      !> The range
      type(range_t), intent(in) :: range
      !> Is it?
      logical :: verdict

      real(wp), parameter :: round_off = 1.0e-12_wp ! [-]

      verdict = number >= range%smallest - round_off*abs(range%smallest) .and. &
         & number <= range%largest + round_off*abs(range%largest)
   end function is_usual

   !> Ask whether the same number in another unit was meant.
   pure subroutine say_meant(key, number, words)
      !> The key
      type(key_t), intent(in) :: key
      !> The number [unit of the key]
      real(wp), intent(in) :: number
      !> `; did you mean ...?`; nothing where the number is usual or in no unit would be
      character(len=:), allocatable, intent(out) :: words

      ! Beyond it the number in another unit could overflow [unit of the key]
      real(wp), parameter :: largest = 1.0e-20_wp*huge(1.0_wp)
      ! Where zero is usual, any smaller number is usual, too, and tells nothing: one in a unit a thousand times smaller is asked
      ! for from where a number is nearer to a thousand times the largest usual one than to that one itself, in powers of ten [-]
      real(wp), parameter :: far = sqrt(1.0e3_wp)
      logical :: is_near
      integer :: place, i

      words = ""
      if (.not. key%has_usual .or. .not. abs(number) > 0.0_wp .or. abs(number) > largest) return
      if (is_usual(number, key%usual)) return
      if (index(key%name, "viscosity_") > 0 .and. key%unit%suffix == "Pa_s" .and. is_usual(number, sheet_range)) then
         call ask_kinematic(number, words)
         return
      end if
      if (key%unit%suffix == "degC") call ask_value(key, number - celsius_zero, number_text(number, digits)//" K", words)
      if (key%unit%suffix == "deg") call ask_value(key, number/degree, number_text(number, digits)//" rad", words)
      if (key%unit%suffix == "") then
         ! Nobody writes a part of one in thousandths. Where anything down to zero is usual, a hundredth of a part tells nothing
         if (abs(number) >= 1.0_wp .or. key%usual%smallest > 0.0_wp) call ask_value(key, number*10.0_wp**percent, &
            & number_text(number, digits)//" %", words)
         return
      end if
      place = findloc(slips%suffix, key%unit%suffix, dim=1)
      if (place == 0) return
      associate (usual => key%usual)
         is_near = is_usual(0.0_wp, usual) .and. abs(number) < far*max(abs(usual%smallest), abs(usual%largest))
      end associate
      do i = 1, count(slips(place)%powers /= 0)
         if (is_near .and. slips(place)%powers(i) < 0) cycle
         call ask_value(key, number*10.0_wp**slips(place)%powers(i), "", words)
      end do
   end subroutine say_meant

   !> Ask for a value where it is usual and nothing is asked yet.
   pure subroutine ask_value(key, value, other, words)
      type(key_t), intent(in) :: key
      !> The value [unit of the key]
      real(wp), intent(in) :: value
      !> The same in another unit; blank where that is plain
      character(len=*), intent(in) :: other
      !> The question
      character(len=:), allocatable, intent(inout) :: words

      if (words /= "" .or. .not. is_usual(value, key%usual)) return
      words = "; did you mean "//number_text(value, digits)
      if (key%unit%symbol /= "1") words = words//" "//trim(key%unit%symbol)
      if (other /= "") words = words//", which is "//other
      words = words//"?"
   end subroutine ask_value

   !> Ask whether a viscosity in mPa s or a kinematic one was meant: both have numbers of that size.
   pure subroutine ask_kinematic(number, words)
      !> The number [mPa s] or [mm^2/s]
      real(wp), intent(in) :: number
      !> The question
      character(len=:), allocatable, intent(out) :: words

      real(wp), parameter :: millesimal = 1.0e-3_wp ! [-]

      words = "; did you mean "//number_text(millesimal*number, digits)//" Pa s, which is "//number_text(number, digits)// &
         & " mPa s, or "//number_text(number, digits)//" mm^2/s? That is viscosity_at_40_degC_mm2_s or "// &
         & "viscosity_at_100_degC_mm2_s of temperature_law 'data_sheet'"
   end subroutine ask_kinematic

end module camroller_unit_guess
