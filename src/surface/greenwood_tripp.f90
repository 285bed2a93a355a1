!> Greenwood-Tripp integrals: moments of the Gaussian summit heights above a gap.
!>
!>     F_n(H) = (2 pi)^(-1/2) int_H^inf (s - H)^n exp(-s^2/2) ds,    dF_n/dH = -n F_(n - 1)
!>
!> In: ratio of gap to roughness, 0 <= H. Out: F_2 for the real area, F_5/2 for the load, and their
!> derivatives.
!> Source: Greenwood and Tripp (1970), Proc. Instn Mech. Engrs 185, 625-633.
!> Each is exp(-H^2/2) times a ratio of polynomials, fitted with high precision by `tools/greenwood_tripp_fit.py`;
!> relative error below 2e-13 in exact arithmetic over 0 <= H <= 8. Beyond 8 the integrals are below 1e-16 of their
!> values at 0, and zero is returned.
module camroller_greenwood_tripp
   use camroller_kinds, only : wp
   implicit none
   private

   public :: integral_2, integral_5_2, largest_film_ratio

   !> Gap over roughness beyond which no summit is taken to touch [-]
   real(wp), parameter :: largest_film_ratio = 8.0_wp

   !> Numerator of F_1 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f1_top(0:7) = [ &
      3.9894228040142685332e-1_wp, 3.2544199231820303853e-1_wp, 1.4187902917971470583e-1_wp, &
      3.8185032095705551812e-2_wp, &
      6.5940983982810610195e-3_wp, 6.8707556289298115126e-4_wp, 3.4050582607693650672e-5_wp, &
      -1.7352269965997523379e-11_wp]
   !> Denominator of F_1 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f1_bottom(0:8) = [ &
      1.0_wp, 2.0690762370101237979_wp, 1.9488404852134457489_wp, 1.0958058435540556512_wp, &
      4.0434534390969737407e-1_wp, 1.0091497533830759882e-1_wp, 1.6782835304150892542e-2_wp, &
      1.7223458435277043302e-3_wp, &
      8.534907793923004471e-5_wp]
   !> Numerator of F_3/2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f32_top(0:7) = [ &
      4.3001999366233126428e-1_wp, 1.9940972712739649031e-1_wp, 6.2743863991233892053e-2_wp, &
      1.0330815432472201383e-2_wp, &
      1.0500490083304284047e-3_wp, 3.6758599780288680021e-5_wp, 1.5523888290270989758e-7_wp, &
      -9.0084092528406299589e-11_wp]
   !> Denominator of F_3/2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f32_bottom(0:8) = [ &
      1.0_wp, 1.8976883823120576012_wp, 1.6171305414508784891_wp, 8.0730480716004866687e-1_wp, &
      2.5730574571178451192e-1_wp, 5.3111032010982289202e-2_wp, 6.7588714127869238212e-3_wp, &
      4.4575780264621274133e-4_wp, &
      6.5816172758837240867e-6_wp]
   !> Numerator of F_2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f2_top(0:7) = [ &
      4.9999999999992122453e-1_wp, 2.6921037138770337446e-1_wp, 8.667902244920827222e-2_wp, &
      1.6410385320917251222e-2_wp, &
      1.872772965031264654e-3_wp, 1.0062301594384250414e-4_wp, 5.7641826344768269997e-9_wp, &
      -8.2291898646408471267e-11_wp]
   !> Denominator of F_2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f2_bottom(0:8) = [ &
      1.0_wp, 2.1341898643564152109_wp, 2.0790323307201470548_wp, 1.2130376448472758855_wp, &
      4.6637462579937837063e-1_wp, 1.2192644151146613588e-1_wp, 2.1396467660329085167e-2_wp, &
      2.3422643544123663661e-3_wp, &
      1.2635027824783979668e-4_wp]
   !> Numerator of F_5/2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f52_top(0:7) = [ &
      6.1663421899694004679e-1_wp, 2.1591701116594007852e-1_wp, 6.0518485555504322665e-2_wp, &
      8.042392977388604791e-3_wp, &
      7.0838723232010927598e-4_wp, 1.3178356845799558252e-5_wp, -1.020379743024788206e-7_wp, &
      7.8084423750809777053e-10_wp]
   !> Denominator of F_5/2 exp(H^2/2), powers of H increasing [-]
   real(wp), parameter :: f52_bottom(0:8) = [ &
      1.0_wp, 2.0935701515778799737_wp, 1.9981070177644092672_wp, 1.1403884783098008755_wp, &
      4.2802255680106856628e-1_wp, 1.0895173292564794971e-1_wp, 1.8546706743332331305e-2_wp, &
      1.9583142957880163481e-3_wp, &
      1.0070073580456709554e-4_wp]

contains

   !> F_2 and its derivative -2 F_1.
   elemental subroutine integral_2(film_ratio, value, slope)
      !> Gap over roughness, H >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> F_2 [-]
      real(wp), intent(out) :: value
      !> Its derivative with respect to H [-]
      real(wp), intent(out) :: slope

      call evaluate(2.0_wp, film_ratio, f2_top, f2_bottom, f1_top, f1_bottom, value, slope)
   end subroutine integral_2

   !> F_5/2 and its derivative -5/2 F_3/2.
   elemental subroutine integral_5_2(film_ratio, value, slope)
      !> Gap over roughness, H >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> F_5/2 [-]
      real(wp), intent(out) :: value
      !> Its derivative with respect to H [-]
      real(wp), intent(out) :: slope

      call evaluate(2.5_wp, film_ratio, f52_top, f52_bottom, f32_top, f32_bottom, value, slope)
   end subroutine integral_5_2

   !> F_n and its derivative -n F_(n - 1).
   pure subroutine evaluate(order, film_ratio, top, bottom, lower_top, lower_bottom, value, slope)
      !> n, and gap over roughness, H >= 0 [-]
      real(wp), intent(in) :: order, film_ratio
      !> Coefficients of F_n and of F_(n - 1) [-]
      real(wp), intent(in) :: top(0:7), bottom(0:8), lower_top(0:7), lower_bottom(0:8)
      !> F_n and its derivative with respect to H [-]
      real(wp), intent(out) :: value, slope

      !> exp(-H^2/2) [-]
      real(wp) :: decay

      value = 0.0_wp
      slope = 0.0_wp
      if (film_ratio > largest_film_ratio) return
      decay = exp(-0.5_wp*film_ratio**2)
      value = decay*numerator(top, film_ratio)/denominator(bottom, film_ratio)
      slope = -order*decay*numerator(lower_top, film_ratio)/denominator(lower_bottom, film_ratio)
   end subroutine evaluate

   !> Polynomial of degree 7.
   pure function numerator(c, x) result(p)
      !> Coefficients [-]
      real(wp), intent(in) :: c(0:7)
      !> Point [-]
      real(wp), intent(in) :: x
      !> Value [-]
      real(wp) :: p

      p = c(0) + x*(c(1) + x*(c(2) + x*(c(3) + x*(c(4) + x*(c(5) + x*(c(6) + x*c(7)))))))
   end function numerator

   !> Polynomial of degree 8.
   pure function denominator(c, x) result(p)
      !> Coefficients [-]
      real(wp), intent(in) :: c(0:8)
      !> Point [-]
      real(wp), intent(in) :: x
      !> Value [-]
      real(wp) :: p

      p = c(0) + x*(c(1) + x*(c(2) + x*(c(3) + x*(c(4) + x*(c(5) + x*(c(6) + x*(c(7) + x*c(8))))))))
   end function denominator

end module camroller_greenwood_tripp
