!> Real kind, mathematical constants and the gas constant, used everywhere.
!>
!> In: nothing. Out: the working precision `wp`, `pi`, `gas_constant`.
module camroller_kinds
   use, intrinsic :: iso_fortran_env, only : real64
   implicit none
   private

   public :: wp, pi, two_pi, degree, gas_constant

   !> Working precision of every real in the library
   integer, parameter :: wp = real64
   !> Circle constant [-]
   real(wp), parameter :: pi = acos(-1.0_wp)
   !> One turn [rad]
   real(wp), parameter :: two_pi = 2.0_wp*pi
   !> One degree of arc [rad]
   real(wp), parameter :: degree = pi/180.0_wp
   !> Gas constant, exact since 2019 [J/(mol K)]
   real(wp), parameter :: gas_constant = 8.31446261815324_wp

end module camroller_kinds
