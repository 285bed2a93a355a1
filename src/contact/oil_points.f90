!> Oil as points give it: viscosity by Vogel's law, pressure-viscosity coefficient over the temperature.
!>
!> In: temperatures and what was measured there. Out: the same at any temperature. Source: Vogel (1921).
module camroller_oil_points
   use camroller_kinds, only : wp, celsius_zero
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_number_text, only : fixed_text
   implicit none
   private

   public :: vogel_viscosity, coefficient_at

contains

   !> Vogel's law `ln eta = a + b/(T - c)` through three points.
   !>
   !> Source: Vogel, Physikalische Zeitschrift 22 (1921) 645.
   subroutine vogel_viscosity(temperatures, viscosities, temperature, viscosity, error)
      !> Three temperatures, increasing [K]
      real(wp), intent(in) :: temperatures(3)
      !> Viscosities there [Pa s]
      real(wp), intent(in) :: viscosities(3)
      !> Requested temperature [K]
      real(wp), intent(in) :: temperature
      !> Viscosity there [Pa s]
      real(wp), intent(out) :: viscosity
      !> Domain error where the points fit no such law, or the temperature lies at or below its pole
      type(error_t), allocatable, intent(out) :: error

      ! Logarithms of the viscosities; ratio of their divided differences [-]
      real(wp) :: logs(3), ratio
      ! Constants of the law: c [K], b [K], a [-]
      real(wp) :: pole, slope, level

      viscosity = 0.0_wp
      logs = log(viscosities)
      ! (ln eta1 - ln eta2)/(ln eta2 - ln eta3) = (T2 - T1)/(T3 - T2) (T3 - c)/(T1 - c)
      ratio = (logs(1) - logs(2))/(logs(2) - logs(3))*(temperatures(3) - temperatures(2)) &
         & /(temperatures(2) - temperatures(1))
      if (.not. (logs(1) > logs(2) .and. logs(2) > logs(3) .and. ratio > 1.0_wp)) then
         call raise(error, kind_domain, "lubricant: the three viscosity points fit no Vogel law (viscosity must fall, "// &
            "less and less steeply on a logarithmic scale, as temperature rises)")
         return
      end if
      pole = (ratio*temperatures(1) - temperatures(3))/(ratio - 1.0_wp)
      slope = (logs(1) - logs(2))*(temperatures(1) - pole)*(temperatures(2) - pole)/(temperatures(2) - temperatures(1))
      level = logs(1) - slope/(temperatures(1) - pole)
      if (temperature <= pole + 1.0_wp) then
         call raise(error, kind_domain, "lubricant: the oil temperature is at or below the pole of the Vogel law at "// &
            & fixed_text(pole - celsius_zero, 1)//" degC")
         return
      end if
      viscosity = exp(level + slope/(temperature - pole))
   end subroutine vogel_viscosity

   !> Pressure-viscosity coefficient between points, its logarithm along straight lines over the temperature; beyond them along the
   !> first and the last line.
   subroutine coefficient_at(temperatures, coefficients, temperature, coefficient, error)
      !> Temperatures of the points [K]
      real(wp), intent(in) :: temperatures(:)
      !> Coefficients there [1/Pa]
      real(wp), intent(in) :: coefficients(:)
      !> Requested temperature [K]
      real(wp), intent(in) :: temperature
      !> Coefficient there [1/Pa]
      real(wp), intent(out) :: coefficient
      !> Deck error where temperatures do not increase or a coefficient rises or is not positive
      type(error_t), allocatable, intent(out) :: error

      ! Fraction of the way between two points [-]
      real(wp) :: part
      integer :: i, count

      coefficient = 0.0_wp
      count = size(temperatures)
      if (count < 2 .or. size(coefficients) /= count) then
         call raise(error, kind_deck, "lubricant: the pressure-viscosity coefficient over the temperature takes two points or more")
      else if (any(temperatures(2:) <= temperatures(:count - 1))) then
         call raise(error, kind_deck, "lubricant: temperatures of the pressure-viscosity coefficient must increase")
      else if (.not. coefficients(count) > 0.0_wp .or. any(coefficients(2:) > coefficients(:count - 1))) then
         call raise(error, kind_deck, "lubricant: pressure-viscosity coefficients must be positive and must not rise with the "// &
            & "temperature")
      end if
      if (allocated(error)) return
      i = 1
      do while (i < count - 1 .and. temperature > temperatures(i + 1))
         i = i + 1
      end do
      part = (temperature - temperatures(i))/(temperatures(i + 1) - temperatures(i))
      coefficient = coefficients(i)*(coefficients(i + 1)/coefficients(i))**part
   end subroutine coefficient_at

end module camroller_oil_points
