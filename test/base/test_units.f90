!> Tests of units: what the last words of a key mean, and the way to SI and back.
module test_units
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_units, only : unit_t, unit_of_key, find_unit, to_si, from_si, length_unit_names, pressure_unit_names
   use camroller_unit_dimensions, only : dimension_t, find_dimension
   use camroller_deck_schema, only : schema_t
   use camroller_deck_keys, only : new_schema
   implicit none
   private

   public :: collect_units

   !> One multiplication, one division and one addition [-]
   real(wp), parameter :: round_off = 4.0_wp*epsilon(1.0_wp)

   !> Names of units and what one of them is in SI, at zero and beyond it [SI unit]; source: Bureau International des Poids et
   !> Mesures, The International System of Units, 9th edition (2019), tables 2 to 8
   character(len=*), parameter :: names(*) = [character(len=8) :: "m", "mm", "um", "cm3", "mm2_s", "deg", "mrad", "rpm", &
      & "degC", "s", "m_s", "s_m", "mm2", "kg", "kg_m2", "kg_m3", "N", "N_m", "Nm", "Pa", "kPa", "bar", "MPa", "GPa", "Pa_s", &
      & "per_GPa", "per_K", "N_s_m", "W_m_K", "J_kg_K", "kJ_mol", "mPa_s", "nm", "nm_s", "nm3", "per_s", "mm3_N_m", "h"]
   real(wp), parameter :: ones(*) = [1.0_wp, 1.0e-3_wp, 1.0e-6_wp, 1.0e-6_wp, 1.0e-6_wp, pi/180.0_wp, 1.0e-3_wp, &
      & pi/30.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0e-6_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, &
      & 1.0e3_wp, 1.0e5_wp, 1.0e6_wp, 1.0e9_wp, 1.0_wp, 1.0e-9_wp, &
      & 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0e3_wp, 1.0e-3_wp, 1.0e-9_wp, 1.0e-9_wp, 1.0e-27_wp, 1.0_wp, &
      & 1.0e-9_wp, 3600.0_wp]

contains

   !> All tests of this suite.
   subroutine collect_units(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("the longest unit at the end of a key counts", longest_unit_counts), &
         new_unittest("a key without a unit is taken as it is", no_unit), &
         new_unittest("values become SI", values_become_si), &
         new_unittest("millimetres become the number that metres are written as", exact_lengths), &
         new_unittest("there and back is no change", there_and_back), &
         new_unittest("units of tables are known", units_of_tables), &
         new_unittest("each unit has the factor of the SI brochure", factors), &
         new_unittest("each key of a deck has one of these units", units_of_keys), &
         new_unittest("each unit is a product of base units", products), &
         new_unittest("what is no unit is no product", no_product) &
         ]
   end subroutine collect_units

   subroutine longest_unit_counts(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: keys(*) = [character(len=24) :: "base_radius_mm", "stiffness_N_m", "viscosity_Pa_s", &
         & "inertia_kg_m2", "oil_temperature_degC", "arm_angle_deg", "coefficient_per_GPa", "speed_m_s", "length_m"]
      character(len=*), parameter :: symbols(*) = [character(len=8) :: "mm", "N/m", "Pa s", "kg m2", "degC", "degree", &
         & "1/GPa", "m/s", "m"]
      type(unit_t) :: unit
      integer :: i

      do i = 1, size(keys)
         unit = unit_of_key(keys(i))
         call check(error, trim(unit%symbol), trim(symbols(i)))
         if (allocated(error)) return
      end do
   end subroutine longest_unit_counts

   subroutine no_unit(error)
      type(error_type), allocatable, intent(out) :: error

      type(unit_t) :: unit

      unit = unit_of_key("cam_poisson_ratio")
      call check(error, trim(unit%symbol), "1")
      if (allocated(error)) return
      unit = unit_of_key("mm")
      call check(error, trim(unit%symbol), "1", "a unit alone is the name of a key")
      if (allocated(error)) return
      call check(error, to_si(unit, 0.3_wp), 0.3_wp, thr=0.0_wp)
   end subroutine no_unit

   subroutine values_become_si(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, to_si(unit_of_key("x_rpm"), 600.0_wp), 20.0_wp*pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, to_si(unit_of_key("x_degC"), 26.85_wp), 300.0_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, to_si(unit_of_key("x_deg"), 180.0_wp), pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, to_si(unit_of_key("x_per_GPa"), 22.0_wp), 2.2e-8_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, to_si(unit_of_key("x_bar"), 1.5_wp), 1.5e5_wp, rel=.true., thr=round_off)
   end subroutine values_become_si

   subroutine exact_lengths(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, to_si(unit_of_key("x_mm"), 20.8_wp), 0.0208_wp, thr=0.0_wp)
      if (allocated(error)) return
      call check(error, to_si(unit_of_key("x_um"), 0.14_wp), 0.14e-6_wp, thr=0.0_wp)
   end subroutine exact_lengths

   subroutine there_and_back(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: keys(*) = [character(len=8) :: "x_mm", "x_rpm", "x_degC", "x_GPa", "x_deg", "x"]
      integer :: i

      do i = 1, size(keys)
         ! the offset of a temperature costs digits: 273 of 7
         call check(error, from_si(unit_of_key(keys(i)), to_si(unit_of_key(keys(i)), 7.3_wp)), 7.3_wp, rel=.true., &
            & thr=100.0_wp*epsilon(1.0_wp))
         if (allocated(error)) return
      end do
   end subroutine there_and_back

   subroutine units_of_tables(error)
      type(error_type), allocatable, intent(out) :: error

      type(unit_t) :: unit
      logical :: is_known
      integer :: i

      do i = 1, size(length_unit_names)
         call find_unit(length_unit_names(i), unit, is_known)
         call check(error, is_known, length_unit_names(i))
         if (allocated(error)) return
      end do
      do i = 1, size(pressure_unit_names)
         call find_unit(pressure_unit_names(i), unit, is_known)
         call check(error, is_known, pressure_unit_names(i))
         if (allocated(error)) return
      end do
      call find_unit("furlong", unit, is_known)
      call check(error, .not. is_known)
   end subroutine units_of_tables

   subroutine factors(error)
      type(error_type), allocatable, intent(out) :: error

      type(unit_t) :: unit
      ! Value in SI of zero and of two [SI unit]
      real(wp) :: zero, two
      logical :: is_known
      integer :: i

      do i = 1, size(names)
         call find_unit(names(i), unit, is_known)
         call check(error, is_known, "unknown unit "//names(i))
         if (allocated(error)) return
         zero = 0.0_wp
         if (names(i) == "degC") zero = 273.15_wp
         two = zero + 2.0_wp*ones(i)
         call check(error, to_si(unit, 0.0_wp), zero, thr=0.0_wp, message="zero in "//names(i))
         if (allocated(error)) return
         call check(error, to_si(unit, 2.0_wp), two, rel=.true., thr=round_off, message="two in "//names(i))
         if (allocated(error)) return
         call check(error, from_si(unit, two), 2.0_wp, rel=.true., thr=100.0_wp*round_off, message="back to "//names(i))
         if (allocated(error)) return
      end do
   end subroutine factors

   !> The table above is complete: every unit of a table or of a key is in it.
   subroutine units_of_keys(error)
      type(error_type), allocatable, intent(out) :: error

      type(schema_t) :: schema
      integer :: i

      do i = 1, size(length_unit_names)
         call check(error, any(names == length_unit_names(i)), length_unit_names(i))
         if (allocated(error)) return
      end do
      do i = 1, size(pressure_unit_names)
         call check(error, any(names == pressure_unit_names(i)), pressure_unit_names(i))
         if (allocated(error)) return
      end do
      call new_schema(schema)
      do i = 1, schema%key_count
         associate (suffix => schema%keys(i)%unit%suffix)
            call check(error, suffix == "" .or. any(names == suffix), "no factor for unit "//suffix)
         end associate
         if (allocated(error)) return
      end do
   end subroutine units_of_keys

   !> Factors of all units are those of the table; exponents of kg, m, s, K, mol and rad are those of the SI brochure.
   subroutine products(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: units(*) = [character(len=9) :: "N s/m", "m s-1", "W/(m K)", "mm3/(N m)", "1/GPa", "kg m2", &
         & "degC", "rpm", "kJ/mol", "K s-1", "1"]
      ! units in which a degree is one of a difference
      character(len=*), parameter :: of_differences(*) = [character(len=6) :: "W/degC", "degC s", "1/degC", "degC-1"]
      integer, parameter :: exponents(6, size(units)) = reshape([ &
         1, 0, -1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 1, 1, -3, -1, 0, 0, -1, 1, 2, 0, 0, 0, -1, 1, 2, 0, 0, 0, 1, 2, 0, 0, 0, 0, &
         0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1, 1, 2, -2, 0, -1, 0, 0, 0, -1, 1, 0, 0, 0, 0, 0, 0, 0, 0], [6, size(units)])
      type(unit_t) :: unit
      type(dimension_t) :: found
      logical :: is_known
      integer :: i

      do i = 1, size(names)
         call find_unit(names(i), unit, is_known)
         call find_dimension(trim(unit%symbol), found, is_known)
         call check(error, is_known, "no product: "//unit%symbol)
         if (allocated(error)) return
         call check(error, found%factor, ones(i), rel=.true., thr=round_off, message=unit%symbol)
         if (allocated(error)) return
         call check(error, found%offset, to_si(unit, 0.0_wp), thr=0.0_wp, message="zero of "//unit%symbol)
         if (allocated(error)) return
      end do
      do i = 1, size(units)
         call find_dimension(trim(units(i)), found, is_known)
         call check(error, is_known .and. all(found%exponents == exponents(:, i)), "exponents of "//units(i))
         if (allocated(error)) return
      end do
      do i = 1, size(of_differences)
         call find_dimension(trim(of_differences(i)), found, is_known)
         call check(error, is_known .and. .not. abs(found%offset) > 0.0_wp, "zero of "//of_differences(i))
         if (allocated(error)) return
      end do
   end subroutine products

   subroutine no_product(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: words(*) = [character(len=8) :: "", "furlong", "N xs", "zm", "m-"]
      type(dimension_t) :: found
      logical :: is_known
      integer :: i

      do i = 1, size(words)
         call find_dimension(trim(words(i)), found, is_known)
         call check(error, .not. is_known .and. all(found%exponents == 0), "no unit: "//words(i))
         if (allocated(error)) return
      end do
   end subroutine no_product

end module test_units
