!> Dry elastic line contact.
!>
!> In: load, equivalent radius, length of the contact, equivalent modulus. Out: half width, peak pressure. Source: Hertz (1881);
!> Islam (2019) eqs. (23)-(26), with the full contact length L in all of them.
module camroller_hertz
   use camroller_kinds, only : wp, pi
   implicit none
   private

   public :: half_width, peak_pressure

contains

   !> Half width of the contact, `b = sqrt(8 W R/(pi L E'))`.
   elemental function half_width(load, radius, length, modulus) result(width)
      !> Normal load, W [N]
      real(wp), intent(in) :: load
      !> Equivalent radius, R [m]
      real(wp), intent(in) :: radius
      !> Full length of the line contact, L [m]
      real(wp), intent(in) :: length
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Half width, b [m]
      real(wp) :: width

      width = sqrt(8.0_wp*load*radius/(pi*length*modulus))
   end function half_width

   !> Largest pressure of the contact, `p_max = 2 W/(pi b L) = sqrt(W E'/(2 pi R L))`; zero at zero load.
   elemental function peak_pressure(load, radius, length, modulus) result(pressure)
      !> Normal load, W [N]
      real(wp), intent(in) :: load
      !> Equivalent radius, R [m]
      real(wp), intent(in) :: radius
      !> Full length of the line contact, L [m]
      real(wp), intent(in) :: length
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Peak pressure [Pa]
      real(wp) :: pressure

      pressure = sqrt(load*modulus/(2.0_wp*pi*radius*length))
   end function peak_pressure

end module camroller_hertz
