!> The phi functions of exponential integrators.
!>
!> In: an argument. Out: `phi_1(z) = (exp(z) - 1)/z`, `phi_(k+1)(z) = (phi_k(z) - 1/k!)/z`. Source: Hochbruck and Ostermann, Acta
!> Numerica 19 (2010) 209, section 2.1.
module camroller_phi
   use camroller_kinds, only : wp
   implicit none
   private

   public :: phi_functions

   !> Functions that can be asked for
   integer, parameter :: most_functions = 7
   !> Reciprocals of the factorials of 0 to 7 [-]
   real(wp), parameter :: parts(0:most_functions) = 1.0_wp/[1.0_wp, 1.0_wp, 2.0_wp, 6.0_wp, 24.0_wp, 120.0_wp, 720.0_wp, &
      & 5040.0_wp]
   !> Below this argument the power series needs no more than its terms to be exact [-]
   real(wp), parameter :: near = 1.0_wp
   integer, parameter :: terms = 16
   integer :: counter
   !> Reciprocals of the numbers that the terms are divided by [-]
   real(wp), parameter :: reciprocals(terms + most_functions) = [(1.0_wp/counter, counter=1, terms + most_functions)]
   !> Argument below which the exponential function is round-off beside one [-]
   real(wp), parameter :: vanishing = -40.0_wp

contains

   !> The first functions at an argument: by their recurrence, near zero, where it would cancel, by the series of the last one and
   !> the recurrence backwards.
   pure function phi_functions(n, z) result(phi)
      !> How many, at most `most_functions`
      integer, intent(in) :: n
      !> Argument [-]
      real(wp), intent(in) :: z
      !> phi_1 to phi_n [-]
      real(wp) :: phi(n)

      ! Reciprocal of the argument [-]
      real(wp) :: inverse
      integer :: k

      if (abs(z) < near) then
         ! sum of n! z^k/(k + n)!, from the smallest term on
         phi(n) = 1.0_wp
         do k = terms, 1, -1
            phi(n) = 1.0_wp + z*reciprocals(k + n)*phi(n)
         end do
         phi(n) = phi(n)*parts(n)
         do k = n - 1, 1, -1
            phi(k) = parts(k) + z*phi(k + 1)
         end do
      else
         inverse = 1.0_wp/z
         phi(1) = -inverse
         if (z > vanishing) phi(1) = (exp(z) - 1.0_wp)*inverse
         do k = 1, n - 1
            phi(k + 1) = (phi(k) - parts(k))*inverse
         end do
      end if
   end function phi_functions

end module camroller_phi
