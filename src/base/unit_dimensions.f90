!> Units as products of powers of the base units of the SI.
!>
!> In: a unit as written beside numbers, e.g. `N s/m`, `m s-1`, `1/GPa`, `degC`. Out: its exponents and what makes SI of its values.
!> A unit is a product of the symbols below, each with a prefix or without, with a power or without; a stroke divides by the
!> symbol after it, or by all within brackets. Source: BIPM (2019), The International System of Units, tables 2, 4, 7 and 8.
module camroller_unit_dimensions
   use camroller_kinds, only : wp, degree, per_minute, celsius_zero
   implicit none
   private

   public :: dimension_t, find_dimension, base_names

   !> Base units
   character(len=*), parameter :: base_names(*) = [character(len=3) :: "kg", "m", "s", "K", "mol", "rad"]

   !> A unit: SI value = factor*value + offset. Only a unit of one symbol has an offset: in products it is one of differences
   type :: dimension_t
      !> Exponents of the base units
      integer :: exponents(size(base_names)) = 0
      !> SI units in one of this unit, SI value of its zero [SI unit]
      real(wp) :: factor = 1.0_wp, offset = 0.0_wp
   end type dimension_t

   !> A symbol of a unit and what it stands for
   type :: symbol_t
      character(len=6) :: name
      type(dimension_t) :: dimension
   end type symbol_t

   !> Symbols, with exponents in the order of `base_names`
   type(symbol_t), parameter :: symbols(*) = [ &
      symbol_t("1", dimension_t([0, 0, 0, 0, 0, 0])), &
      symbol_t("kg", dimension_t([1, 0, 0, 0, 0, 0])), &
      symbol_t("m", dimension_t([0, 1, 0, 0, 0, 0])), &
      symbol_t("s", dimension_t([0, 0, 1, 0, 0, 0])), &
      symbol_t("K", dimension_t([0, 0, 0, 1, 0, 0])), &
      symbol_t("mol", dimension_t([0, 0, 0, 0, 1, 0])), &
      symbol_t("rad", dimension_t([0, 0, 0, 0, 0, 1])), &
      symbol_t("N", dimension_t([1, 1, -2, 0, 0, 0])), &
      symbol_t("Pa", dimension_t([1, -1, -2, 0, 0, 0])), &
      symbol_t("J", dimension_t([1, 2, -2, 0, 0, 0])), &
      symbol_t("W", dimension_t([1, 2, -3, 0, 0, 0])), &
      symbol_t("bar", dimension_t([1, -1, -2, 0, 0, 0], 1.0e5_wp)), &
      symbol_t("h", dimension_t([0, 0, 1, 0, 0, 0], 3600.0_wp)), &
      symbol_t("degree", dimension_t([0, 0, 0, 0, 0, 1], degree)), &
      symbol_t("rpm", dimension_t([0, 0, -1, 0, 0, 1], 1.0_wp/per_minute)), &
      symbol_t("degC", dimension_t([0, 0, 0, 1, 0, 0], 1.0_wp, celsius_zero))]
   !> Prefixes, and the powers of ten that they are
   character(len=*), parameter :: prefixes = "numckMG"
   integer, parameter :: powers(*) = [-9, -6, -3, -2, 3, 6, 9]

contains

   !> What a unit is in base units.
   pure subroutine find_dimension(unit, dimension, is_known)
      !> The unit, `1` for none
      character(len=*), intent(in) :: unit
      !> What it is; without exponents and with the factor one where unknown
      type(dimension_t), intent(out) :: dimension
      !> Is it a product of known symbols?
      logical, intent(out) :: is_known

      type(dimension_t) :: found
      integer :: first, last, sense, symbols_read
      logical :: in_brackets

      is_known = len_trim(unit) > 0
      symbols_read = 0
      sense = 1
      in_brackets = .false.
      first = 1
      do while (first <= len_trim(unit) .and. is_known)
         select case (unit(first:first))
         case (" ")
            last = first
         case ("/")
            sense = -1
            last = first
         case ("(", ")")
            in_brackets = unit(first:first) == "("
            last = first
         case default
            last = scan(unit(first:)//" ", " /()") + first - 2
            call find_symbol(unit(first:last), found, is_known)
            dimension%exponents = dimension%exponents + sense*found%exponents
            ! a quotient, so that the thousandth of a unit is the number nearest to it
            if (sense > 0) dimension%factor = dimension%factor*found%factor
            if (sense < 0) dimension%factor = dimension%factor/found%factor
            symbols_read = symbols_read + 1
            if (symbols_read == 1 .and. sense > 0) dimension%offset = found%offset
            if (symbols_read > 1) dimension%offset = 0.0_wp
            if (.not. in_brackets) sense = 1
         end select
         first = last + 1
      end do
      if (.not. is_known) dimension = dimension_t()
   end subroutine find_dimension

   !> What a symbol with its prefix and its power is, such as `mm3` or `s-1`.
   pure subroutine find_symbol(word, dimension, is_known)
      !> The symbol
      character(len=*), intent(in) :: word
      !> What it is
      type(dimension_t), intent(out) :: dimension
      !> Is it known?
      logical, intent(out) :: is_known

      integer :: letters, power, prefix, status, i

      is_known = .true.
      power = 1
      letters = scan(word, "-123456789") - 1
      if (letters < 1) letters = len(word)
      if (letters < len(word)) then
         read (word(letters + 1:), *, iostat=status) power
         is_known = status == 0
      end if
      do i = 1, size(symbols)
         if (symbols(i)%name /= word(:letters)) cycle
         dimension = symbols(i)%dimension
         call raise(dimension, power)
         return
      end do
      prefix = index(prefixes, word(1:1))
      is_known = is_known .and. prefix > 0
      if (.not. is_known) return
      do i = 1, size(symbols)
         if (symbols(i)%name /= word(2:letters)) cycle
         dimension = symbols(i)%dimension
         dimension%factor = dimension%factor*10.0_wp**powers(prefix)
         call raise(dimension, power)
         return
      end do
      is_known = .false.
   end subroutine find_symbol

   !> A power of a unit.
   pure subroutine raise(dimension, power)
      !> The unit, changed
      type(dimension_t), intent(inout) :: dimension
      integer, intent(in) :: power

      dimension%exponents = power*dimension%exponents
      dimension%factor = dimension%factor**power
      if (power /= 1) dimension%offset = 0.0_wp
   end subroutine raise

end module camroller_unit_dimensions
