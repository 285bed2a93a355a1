!> Bounds of the numbers of a deck: for each unit the sizes that some machine could have, with room to spare.
!>
!> In: the unit of a key. Out: the smallest and the largest magnitude of a number in it. A number outside of them is a slip of
!> the pen, and products of several such numbers leave the range of numbers: a modulus of 1e-310 GPa has no reciprocal.
module camroller_deck_bounds
   use camroller_kinds, only : wp, degree, per_minute
   use camroller_units, only : unit_t, find_unit
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: is_bounded, say_bounds, write_bounds

   !> Units that share their bounds, and the bounds
   type :: bounds_t
      !> Units, as the last words of keys; blank for none
      character(len=20) :: units
      !> What is measured
      character(len=32) :: quantity
      !> Smallest size that is not 0 [SI unit]
      real(wp) :: smallest
      !> Largest size [SI unit]
      real(wp) :: largest
   end type bounds_t

   type(bounds_t), parameter :: known_bounds(*) = [ &
      bounds_t("m mm um", "length", 1.0e-12_wp, 1.0e3_wp), &
      bounds_t("cm3", "volume", 1.0e-12_wp, 1.0e3_wp), &
      bounds_t("deg", "angle", 1.0e-9_wp*degree, 1.0e5_wp*degree), &
      bounds_t("rpm", "speed of rotation", 1.0e-6_wp/per_minute, 1.0e6_wp/per_minute), &
      bounds_t("degC", "temperature", 0.0_wp, 1.0e4_wp), &
      bounds_t("s", "time", 1.0e-6_wp, 1.0e9_wp), &
      bounds_t("m_s", "speed", 1.0e-12_wp, 1.0e4_wp), &
      bounds_t("kg", "mass", 1.0e-12_wp, 1.0e6_wp), &
      bounds_t("kg_m2", "moment of inertia", 1.0e-18_wp, 1.0e6_wp), &
      bounds_t("kg_m3", "density", 1.0e-3_wp, 1.0e6_wp), &
      bounds_t("N", "force", 1.0e-9_wp, 1.0e12_wp), &
      bounds_t("Nm", "torque", 1.0e-12_wp, 1.0e9_wp), &
      bounds_t("N_m", "stiffness", 1.0e-6_wp, 1.0e15_wp), &
      bounds_t("Pa kPa bar MPa GPa", "pressure, stress, modulus", 1.0e-3_wp, 1.0e15_wp), &
      bounds_t("Pa_s mPa_s", "viscosity", 1.0e-9_wp, 1.0e6_wp), &
      bounds_t("mm2_s", "kinematic viscosity", 1.0e-12_wp, 1.0e3_wp), &
      bounds_t("per_GPa", "pressure-viscosity coefficient", 1.0e-15_wp, 1.0e-5_wp), &
      bounds_t("per_K", "thermal expansion", 1.0e-12_wp, 1.0_wp), &
      bounds_t("", "number without a unit", 1.0e-30_wp, 1.0e30_wp)]

   !> Digits of a bound in another unit than SI
   integer, parameter :: digits = 3

contains

   !> Smallest magnitude of a number that is not 0, and largest one.
   pure function sizes_of(unit) result(sizes)
      type(unit_t), intent(in) :: unit
      !> The sizes [the unit]
      real(wp) :: sizes(2)

      integer :: i

      do i = 1, size(known_bounds) - 1
         if (unit%suffix == "" .neqv. known_bounds(i)%units == "") cycle
         if (index(" "//known_bounds(i)%units, " "//trim(unit%suffix)//" ") > 0) exit
      end do
      sizes = [known_bounds(i)%smallest, known_bounds(i)%largest]*unit%denominator/unit%numerator
   end function sizes_of

   !> Is a number 0, or its magnitude within the bounds of its unit? They are met but for round-off of the unit's factor.
   elemental function is_bounded(number, unit) result(verdict)
      !> The number [the unit]
      real(wp), intent(in) :: number
      !> Its unit
      type(unit_t), intent(in) :: unit
      !> Is it?
      logical :: verdict

      real(wp), parameter :: round_off = 1.0e-12_wp ! [-]

      associate (sizes => sizes_of(unit))
         verdict = .not. abs(number) > 0.0_wp .or. (abs(number) >= sizes(1)*(1.0_wp - round_off) .and. &
            & abs(number) <= sizes(2)*(1.0_wp + round_off))
      end associate
   end function is_bounded

   !> The bounds of a unit in words.
   pure subroutine say_bounds(unit, takes_zero, takes_negative, words)
      !> The unit
      type(unit_t), intent(in) :: unit
      !> May the number be 0, or negative?
      logical, intent(in) :: takes_zero, takes_negative
      !> The words
      character(len=:), allocatable, intent(out) :: words

      associate (sizes => sizes_of(unit))
         words = number_text(sizes(2), digits)//" or less"
         if (sizes(1) > 0.0_wp) words = "from "//number_text(sizes(1), digits)//" to "//number_text(sizes(2), digits)
         if (sizes(1) > 0.0_wp .and. takes_zero) words = "0, or "//words
      end associate
      if (takes_negative) words = words//" in size"
   end subroutine say_bounds

   !> The bounds of all quantities as a table of a page.
   subroutine write_bounds(text)
      !> Text to add to
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: n = new_line("a")
      type(bounds_t) :: bounds
      type(unit_t) :: unit
      real(wp) :: sizes(2) ! [the unit]
      logical :: is_known
      integer :: i

      text = text//n//"## Bounds of numbers"//n//n//"The magnitude of a number that is not 0 must lie within these "// &
         & "bounds, which are wider than any machine needs. Outside of them formulas could overflow."//n//n// &
         & "| quantity | in | smallest size | largest size |"//n//"|---|---|---|---|"//n
      do i = 1, size(known_bounds)
         bounds = known_bounds(i)
         call find_unit(bounds%units(:max(0, scan(bounds%units, " ") - 1)), unit, is_known)
         sizes = sizes_of(unit)
         text = text//"| "//trim(bounds%quantity)//" | "//trim(merge("-         ", unit%symbol(:10), unit%symbol == "1"))// &
            & " | "//number_text(sizes(1), digits)//" | "//number_text(sizes(2), digits)//" |"//n
      end do
   end subroutine write_bounds

end module camroller_deck_bounds
