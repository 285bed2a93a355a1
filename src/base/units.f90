!> Units of keys and tables, and their factors to SI.
!>
!> In: a key such as `base_radius_mm` or the name of a unit. Out: the conversion from that unit to SI and back. A key whose last
!> words are not a known unit is in SI, or has no unit.
module camroller_units
   use camroller_kinds, only : wp, pi, two_pi, celsius_zero
   implicit none
   private

   public :: unit_t, unit_of_key, find_unit, to_si, from_si
   public :: length_unit_names, pressure_unit_names, unit_name_length

   !> Length of the name of a unit
   integer, parameter :: unit_name_length = 12

   !> One unit: SI value = value*numerator/denominator + offset
   type :: unit_t
      !> Last words of a key in this unit
      character(len=unit_name_length) :: suffix = ""
      !> As written beside numbers; `1` for none
      character(len=unit_name_length) :: symbol = "1"
      !> Numerator of the factor to SI [SI unit/unit]
      real(wp) :: numerator = 1.0_wp
      !> Denominator of the factor to SI [-]
      real(wp) :: denominator = 1.0_wp
      !> SI value of zero [SI unit]
      real(wp) :: offset = 0.0_wp
   end type unit_t

   !> Units of length for tables
   character(len=*), parameter :: length_unit_names(*) = [character(len=unit_name_length) :: "mm", "m", "um"]
   !> Units of pressure for tables
   character(len=*), parameter :: pressure_unit_names(*) = [character(len=unit_name_length) :: "bar", "Pa", "kPa", &
      & "MPa"]

   !> Known units. Factors below one are divisors, so that 18 mm and 0.018 m are the same number
   type(unit_t), parameter :: known_units(*) = [ &
      unit_t("m", "m", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("mm", "mm", 1.0_wp, 1.0e3_wp, 0.0_wp), &
      unit_t("um", "um", 1.0_wp, 1.0e6_wp, 0.0_wp), &
      unit_t("deg", "degree", pi, 180.0_wp, 0.0_wp), &
      unit_t("mrad", "mrad", 1.0_wp, 1.0e3_wp, 0.0_wp), &
      unit_t("rpm", "rpm", two_pi, 60.0_wp, 0.0_wp), &
      unit_t("degC", "degC", 1.0_wp, 1.0_wp, celsius_zero), &
      unit_t("s", "s", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("m_s", "m/s", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("s_m", "s/m", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("nm", "nm", 1.0_wp, 1.0e9_wp, 0.0_wp), &
      unit_t("nm_s", "nm/s", 1.0_wp, 1.0e9_wp, 0.0_wp), &
      unit_t("nm3", "nm3", 1.0_wp, 1.0e27_wp, 0.0_wp), &
      unit_t("per_s", "1/s", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("mm3_N_m", "mm3/(N m)", 1.0_wp, 1.0e9_wp, 0.0_wp), &
      unit_t("h", "h", 3600.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("mm2", "mm2", 1.0_wp, 1.0e6_wp, 0.0_wp), &
      unit_t("cm3", "cm3", 1.0_wp, 1.0e6_wp, 0.0_wp), &
      unit_t("kg", "kg", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("kg_m2", "kg m2", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("kg_m3", "kg/m3", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("N", "N", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("N_m", "N/m", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("Nm", "N m", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("N_s_m", "N s/m", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("Pa", "Pa", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("kPa", "kPa", 1.0e3_wp, 1.0_wp, 0.0_wp), &
      unit_t("bar", "bar", 1.0e5_wp, 1.0_wp, 0.0_wp), &
      unit_t("MPa", "MPa", 1.0e6_wp, 1.0_wp, 0.0_wp), &
      unit_t("GPa", "GPa", 1.0e9_wp, 1.0_wp, 0.0_wp), &
      unit_t("Pa_s", "Pa s", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("mPa_s", "mPa s", 1.0_wp, 1.0e3_wp, 0.0_wp), &
      unit_t("mm2_s", "mm2/s", 1.0_wp, 1.0e6_wp, 0.0_wp), &
      unit_t("per_GPa", "1/GPa", 1.0_wp, 1.0e9_wp, 0.0_wp), &
      unit_t("per_K", "1/K", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("W_m_K", "W/(m K)", 1.0_wp, 1.0_wp, 0.0_wp), &
      unit_t("kJ_mol", "kJ/mol", 1.0e3_wp, 1.0_wp, 0.0_wp), &
      unit_t("J_kg_K", "J/(kg K)", 1.0_wp, 1.0_wp, 0.0_wp)]

   !> Lengths of the suffixes
   integer, parameter :: suffix_lengths(*) = len_trim(known_units%suffix)

contains

   !> Unit that the last words of a key name; the longest that fits.
   pure function unit_of_key(key) result(unit)
      !> Name of a key, e.g. `base_radius_mm`
      character(len=*), intent(in) :: key
      !> Its unit; no unit (or SI) where the last words are none
      type(unit_t) :: unit

      integer :: i, longest, length, last, start

      longest = 0
      last = len_trim(key)
      do i = 1, size(known_units)
         length = suffix_lengths(i)
         start = last - length
         if (length <= longest .or. start < 2) cycle
         if (key(start:start) /= "_") cycle
         if (key(start + 1:last) /= known_units(i)%suffix(:length)) cycle
         longest = length
         unit = known_units(i)
      end do
   end function unit_of_key

   !> Unit by name.
   pure subroutine find_unit(name, unit, is_known)
      !> Name as in a deck, e.g. `mm`
      character(len=*), intent(in) :: name
      !> The unit; no unit where unknown
      type(unit_t), intent(out) :: unit
      !> Is there such a unit?
      logical, intent(out) :: is_known

      integer :: i

      is_known = .false.
      do i = 1, size(known_units)
         if (known_units(i)%suffix /= name) cycle
         unit = known_units(i)
         is_known = .true.
         return
      end do
   end subroutine find_unit

   !> A value in SI.
   elemental function to_si(unit, value) result(si)
      !> Unit of the value
      type(unit_t), intent(in) :: unit
      !> The value [unit]
      real(wp), intent(in) :: value
      !> The same in SI [SI unit]
      real(wp) :: si

      si = value*unit%numerator/unit%denominator + unit%offset
   end function to_si

   !> A value in a unit.
   elemental function from_si(unit, si) result(value)
      !> Unit wanted
      type(unit_t), intent(in) :: unit
      !> A value in SI [SI unit]
      real(wp), intent(in) :: si
      !> The same in the unit wanted [unit]
      real(wp) :: value

      value = (si - unit%offset)*unit%denominator/unit%numerator
   end function from_si

end module camroller_units
