!> Checks of what is given about the oil: its viscosity at high temperature and high shear rate (HTHS), as on its data sheet, beside
!> the law of viscosity; its temperature, beside those at which something is known of it.
!>
!> In: what is given about the oil. Out: how much of its viscosity is left under shear; how far its temperature is from all points,
!> and from where its pressure-viscosity coefficient can be estimated.
!> One number for one temperature and shear rate makes no law of shear thinning, which takes the rate at which it begins and the
!> viscosity that it ends at, both over temperature (Marx, Fernandez, Barcelo and Spikes 2018, Tribology Letters 66, 92): no result
!> follows from it.
module camroller_oil_checks
   use camroller_boundary_law, only : boundary_law_names, boundary_table
   use camroller_case, only : case_t
   use camroller_error, only : error_t
   use camroller_kinds, only : wp, celsius_zero
   use camroller_lubricant, only : get_oil, law_barus, law_direct, lubricant_t, oil_t, pressure_law_names, sheet_temperatures, &
      & temperature_law_names
   use camroller_number_text, only : number_text
   implicit none
   private

   public :: compare_hths, find_far_points, judge_estimate

   !> Temperature of HTHS [K]; its shear rate is 1e6 1/s: ASTM D4683
   real(wp), parameter :: hths_temperature = 423.15_wp

   !> Way beyond points up to which a law through them is taken for good: three points 35 K apart, as data sheets have them, pass
   !> four times their own errors on at 20 K beyond the last [K]
   real(wp), parameter :: far_from_points = 20.0_wp
   !> The same for a data sheet, with two points 60 K apart and Walther's straight line, which passes less than three times their
   !> errors on at 50 K beyond them [K]
   real(wp), parameter :: far_from_sheet = 50.0_wp

contains

   !> HTHS of the data sheet relative to what the law of viscosity gives at its temperature, without shear.
   subroutine compare_hths(lubricant, viscosity, ratio)
      !> What is given about the oil
      type(lubricant_t), intent(in) :: lubricant
      !> Viscosity by the law at 150 degC; zero where HTHS is not given or the law has none there [Pa s]
      real(wp), intent(out) :: viscosity
      !> HTHS over it; zero where it is [-]
      real(wp), intent(out) :: ratio

      type(lubricant_t) :: plain
      type(oil_t) :: oil
      type(error_t), allocatable :: failure

      viscosity = 0.0_wp
      ratio = 0.0_wp
      if (.not. lubricant%hths_viscosity > 0.0_wp .or. lubricant%temperature_law == temperature_law_names(law_direct)) return
      ! Pressure plays no part here, and its laws may have no constants at this temperature
      plain = lubricant
      plain%pressure_law = pressure_law_names(law_barus)
      plain%pressure_viscosity = 1.0e-8_wp
      plain%roelands_index = 0.0_wp
      if (allocated(plain%pressure_viscosity_points)) deallocate (plain%pressure_viscosity_points)
      call get_oil(plain, hths_temperature, oil, failure)
      if (allocated(failure)) return
      viscosity = oil%viscosity
      ratio = lubricant%hths_viscosity/viscosity
   end subroutine compare_hths

   !> How far the temperature of a case's oil is beyond what its laws are given at, and which of them is the farthest off.
   subroutine find_far_points(case, bearing_rise, distance, words)
      !> The case
      type(case_t), intent(in) :: case
      !> Largest rise of the oil's temperature in a camshaft bearing; zero where there is none or it is not known [K]
      real(wp), intent(in) :: bearing_rise
      !> Way beyond the points, 0 where none is far [K]
      real(wp), intent(out) :: distance
      !> The same in words; blank where none is far
      character(len=:), allocatable, intent(out) :: words

      type(oil_t) :: oil
      type(error_t), allocatable :: failure
      character(len=:), allocatable :: viscosity
      character(len=*), parameter :: hot_bearing = "the viscosity there is that of a law that passes through its points"

      distance = 0.0_wp
      words = ""
      associate (lubricant => case%lubricant)
         viscosity = ""
         call get_oil(lubricant, case%operating_point%oil_temperature, oil, failure)
         if (.not. allocated(failure)) viscosity = ", "//number_text(1.0e3_wp*oil%viscosity, 3)//" mPa s,"
         viscosity = "the viscosity"//viscosity//" is that of a law that passes through its points"
         if (lubricant%temperature_law == "data_sheet") then
            call look_at(sheet_temperatures, far_from_sheet, 0.0_wp, viscosity)
            call look_at(sheet_temperatures, far_from_sheet, bearing_rise, hot_bearing)
         else if (lubricant%temperature_law /= temperature_law_names(law_direct) .and. allocated(lubricant%temperature_points)) then
            call look_at(lubricant%temperature_points, far_from_points, 0.0_wp, viscosity)
            call look_at(lubricant%temperature_points, far_from_points, bearing_rise, hot_bearing)
         end if
         if (allocated(lubricant%pressure_viscosity_temperatures)) call look_at(lubricant%pressure_viscosity_temperatures, &
            & far_from_points, 0.0_wp, "the pressure-viscosity coefficient is that of a straight line through its points")
      end associate
      if (.not. allocated(case%boundary_law)) return
      if (case%boundary_law%law == boundary_law_names(boundary_table) .and. allocated(case%boundary_law%temperature_points)) then
         call look_at(case%boundary_law%temperature_points, far_from_points, 0.0_wp, "the coefficient of "// &
            & "touching asperities is that of the nearest temperature in the table of &boundary_law")
      end if

   contains

      !> Compare the oil's temperature with those of points.
      subroutine look_at(points, far, rise, meaning)
         !> Temperatures of the points, increasing; way beyond them that is far; rise of the oil in a bearing, zero for that around
         !> it [K]
         real(wp), intent(in) :: points(:), far, rise
         !> What is taken from them
         character(len=*), intent(in) :: meaning

         ! Temperature of the oil, way beyond the points [K]
         real(wp) :: temperature, beyond

         if (size(points) == 0) return
         temperature = case%operating_point%oil_temperature + rise
         beyond = max(points(1) - temperature, temperature - points(size(points)))
         if (beyond <= max(far, distance)) return
         distance = beyond
         words = "the oil temperature"
         if (rise > 0.0_wp) words = words//" in a camshaft bearing"
         words = words//", "//number_text(temperature - celsius_zero, 5)//" degC, is "//number_text(beyond, 4)// &
            & " K "//trim(merge("below", "above", temperature < points(1)))//" all points that are given, "// &
            & number_text(points(1) - celsius_zero, 5)//" to "//number_text(points(size(points)) - celsius_zero, 5)//" degC: "// &
            & meaning//", and may be far off"
      end subroutine look_at

   end subroutine find_far_points

   !> Say that a pressure-viscosity coefficient is estimated where the formula has no sense left: that of an oil falls as its
   !> temperature rises, and the formula's has a largest value somewhere in the cold, below which it falls as the oil gets colder.
   subroutine judge_estimate(case, distance, words)
      !> The case
      type(case_t), intent(in) :: case
      !> How far the oil is colder than where the estimate is largest, 0 where it is not colder [K]
      real(wp), intent(out) :: distance
      !> The same in words; blank where it is not
      character(len=:), allocatable, intent(out) :: words

      ! Temperatures that are compared are so far apart, and at most so many [K]
      real(wp), parameter :: step = 1.0_wp
      integer, parameter :: most = 100
      real(wp) :: last ! coefficient one step before [1/Pa]
      type(oil_t) :: oil, warmer
      type(error_t), allocatable :: failure
      integer :: i

      distance = 0.0_wp
      words = ""
      associate (temperature => case%operating_point%oil_temperature)
         call get_oil(case%lubricant, temperature, oil, failure)
         if (allocated(failure)) return
         if (.not. oil%is_estimated) return
         warmer = oil
         do i = 1, most
            last = warmer%pressure_viscosity
            call get_oil(case%lubricant, temperature + i*step, warmer, failure)
            if (allocated(failure)) exit
            if (.not. warmer%pressure_viscosity > last) exit
            distance = i*step
         end do
         if (distance <= 0.0_wp) return
         words = "the pressure-viscosity coefficient, "//number_text(1.0e9_wp*oil%pressure_viscosity, 3)//" 1/GPa at "// &
            & number_text(temperature - celsius_zero, 5)//" degC, is estimated by the formula of So and Klaus, which makes it "// &
            & "fall with the cold below "//number_text(temperature + distance - celsius_zero, 3)//" degC, where that of oils "// &
            & "rises; give lubricant.pressure_viscosity_points_per_GPa"
      end associate
   end subroutine judge_estimate

end module camroller_oil_checks
