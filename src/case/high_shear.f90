!> Viscosity of the oil at high temperature and high shear rate (HTHS), as on its data sheet, beside the law of viscosity.
!>
!> In: what is given about the oil. Out: how much of its viscosity is left under shear. One number for one temperature and shear
!> rate makes no law of shear thinning, which takes the rate at which it begins and the viscosity that it ends at, both over
!> temperature (Marx, Fernandez, Barcelo and Spikes 2018, Tribology Letters 66, 92): no result follows from it.
module camroller_high_shear
   use camroller_error, only : error_t
   use camroller_kinds, only : wp
   use camroller_lubricant, only : get_oil, law_barus, law_direct, lubricant_t, oil_t, pressure_law_names, temperature_law_names
   implicit none
   private

   public :: compare_hths

   !> Temperature of HTHS [K]; its shear rate is 1e6 1/s: ASTM D4683
   real(wp), parameter :: hths_temperature = 423.15_wp

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

end module camroller_high_shear
