!> Real kind, mathematical and physical constants, used everywhere.
!>
!> In: nothing. Out: the working precision `wp`, `pi`, `gas_constant`; no number, infinity.
module camroller_kinds
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : real64
   implicit none
   private

   public :: wp, pi, two_pi, degree, per_minute, celsius_zero, gas_constant, not_a_number, infinite_if_huge

   !> Working precision of every real in the library
   integer, parameter :: wp = real64
   !> Circle constant [-]
   real(wp), parameter :: pi = acos(-1.0_wp)
   !> One turn [rad]
   real(wp), parameter :: two_pi = 2.0_wp*pi
   !> One degree of arc [rad]
   real(wp), parameter :: degree = pi/180.0_wp
   !> One radian a second in revolutions a minute [rev/min over rad/s]
   real(wp), parameter :: per_minute = 60.0_wp/two_pi
   !> Zero of the Celsius scale [K]
   real(wp), parameter :: celsius_zero = 273.15_wp
   !> Gas constant, exact since 2019 [J/(mol K)]
   real(wp), parameter :: gas_constant = 8.31446261815324_wp

contains

   !> What stands where there is no number.
   pure function not_a_number() result(number)
      !> It [any]
      real(wp) :: number

      number = ieee_value(1.0_wp, ieee_quiet_nan)
   end function not_a_number

   !> A smallest value or bound that nothing has lowered is infinite.
   elemental function infinite_if_huge(number) result(number_or_infinity)
      !> It, `huge` where nothing has [any]
      real(wp), intent(in) :: number
      !> The same, or infinity [any]
      real(wp) :: number_or_infinity

      number_or_infinity = number
      if (number >= huge(1.0_wp)) number_or_infinity = ieee_value(1.0_wp, ieee_positive_inf)
   end function infinite_if_huge

end module camroller_kinds
