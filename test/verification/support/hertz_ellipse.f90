!> Hertz' ellipse of a crowned roller.
module hertz_ellipse
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: find_ellipse

contains

   !> Half length and axes' ratio (Johnson 1985, eq. 4.26).
   pure subroutine find_ellipse(crown, load, radius, modulus, half_length, ratio)
      !> Radius of the crown [m], load [N], equivalent radius [m], equivalent modulus [Pa]
      real(wp), intent(in) :: crown, load, radius, modulus
      !> Half length [m], half width over it [-]
      real(wp), intent(out) :: half_length, ratio
      ! Bounds of the ratio, complete integrals [-]
      real(wp) :: low, high, integrals(2)
      integer :: i

      low = 1.0e-4_wp
      high = 1.0_wp
      do i = 1, 200
         ratio = sqrt(low*high)
         integrals = elliptic(1.0_wp - ratio**2)
         if (ratio**2*(integrals(1) - integrals(2))/(integrals(2) - ratio**2*integrals(1)) > radius/crown) then
            high = ratio
         else
            low = ratio
         end if
      end do
      half_length = (6.0_wp*load*crown*(integrals(1) - integrals(2))/(pi*modulus*(1.0_wp - ratio**2)))**(1.0_wp/3.0_wp)
   end subroutine find_ellipse

   !> Complete elliptic integrals of first and second kind by the arithmetic-geometric mean.
   pure function elliptic(m) result(integrals)
      !> Parameter, the square of the modulus [-]
      real(wp), intent(in) :: m
      !> K and E [-]
      real(wp) :: integrals(2)
      real(wp) :: a, b, c, rest, power
      integer :: i

      a = 1.0_wp
      b = sqrt(1.0_wp - m)
      rest = 0.5_wp*m
      power = 1.0_wp
      do i = 1, 12
         c = 0.5_wp*(a - b)
         rest = rest + power*c**2
         power = 2.0_wp*power
         c = 0.5_wp*(a + b)
         b = sqrt(a*b)
         a = c
      end do
      integrals = [0.5_wp*pi/a, 0.5_wp*pi/a*(1.0_wp - rest)]
   end function elliptic

end module hertz_ellipse
