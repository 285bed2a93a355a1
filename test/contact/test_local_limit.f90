!> Shear whose stress is limited at each point of the contact.
module test_local_limit
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, pi
   use camroller_conjunction, only : film_shear_t, hot_oil_t, hot_shear, sheared_film_t
   use camroller_lubricant, only : law_barus, law_cameron, law_roelands, oil_t
   use camroller_local_limit, only : limited_shear_t, locally_limited_shear, stress_limit_t
   use camroller_traction, only : cap_sharp, cap_smooth, law_eyring, law_newtonian
   implicit none
   private

   public :: collect_local_limit

   !> Contact area [m^2], film [m], pressure in its middle [Pa], viscosity at ambient pressure [Pa s], Eyring stress [Pa]
   real(wp), parameter :: area = 1.4e-6_wp, thickness = 2.0e-7_wp, peak = 6.0e8_wp, viscosity = 0.02_wp, eyring_stress = 5.0e6_wp
   !> A quadrature of smooth functions and its closed form agree to this [-]
   real(wp), parameter :: round_off = 1.0e-13_wp

contains

   !> Collect the tests.
   subroutine collect_local_limit(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a film that is all at its limit: area times tau_L0 + Lambda times the mean pressure", test_all_limited), &
         new_unittest("a sharp limit that only the edges reach: closed form", test_edges), &
         new_unittest("a smooth limit that pressure does not change: tau_L0 tanh(tau/tau_L0)", test_constant_limit), &
         new_unittest("a limit that nothing reaches leaves the shear as it is, cold and warm", test_unlimited), &
         new_unittest("slopes over sliding speed, pressure and temperature are those of differences", test_slopes), &
         new_unittest("a film without pressure and limit has next to no shear", test_no_pressure) &
         ]
   end subroutine collect_local_limit

   subroutine test_all_limited(error)
      type(error_type), allocatable, intent(out) :: error
      ! tau_L0 [Pa], Lambda, fall of the limit [1/K], rise [K]
      real(wp), parameter :: stress = 2.0e6_wp, coefficient = 0.05_wp, fall = 3.0e-3_wp, rise = 20.0_wp
      type(limited_shear_t) :: shear
      ! [N]
      real(wp) :: expected
      integer :: sign_of, cap

      expected = area*(stress + coefficient*0.25_wp*pi*peak)*exp(-fall*rise)
      do cap = cap_smooth, cap_sharp
         do sign_of = -1, 1, 2
            call locally_limited_shear(film_at(law_newtonian, 1.0e3_wp*sign_of, peak), oil_of(law_barus), &
               & hot_oil_t(1.0e-2_wp, 0.0_wp, 0.0_wp), rise, stress_limit_t(cap, stress, coefficient, fall, 0.0_wp), shear)
            call check(error, shear%force, sign_of*expected, rel=.true., thr=round_off)
            if (allocated(error)) return
            call check(error, shear%by_rise, -sign_of*expected*fall, rel=.true., thr=round_off)
            if (allocated(error)) return
            call check(error, shear%by_peak, sign_of*area*coefficient*0.25_wp*pi*peak*exp(-fall*rise), rel=.true., thr=round_off)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_all_limited

   !> An oil that pressure does not thicken, with a limit `Lambda p` alone: where `Lambda p_0 sqrt(1 - x^2) < tau`, beyond
   !> `x_c = sqrt(1 - c^2)` with `c = tau/(Lambda p_0)`, the stress is at its limit, and the mean is
   !> `tau x_c + Lambda p_0 (acos(x_c) - x_c c)/2`.
   subroutine test_edges(error)
      type(error_type), allocatable, intent(out) :: error
      ! Lambda [-]
      real(wp), parameter :: coefficient = 0.05_wp
      ! A kink between two of 24 points costs up to about a tenth of the square of their distance, pi/48, seen 3e-4 [-]
      real(wp), parameter :: allowed = 0.1_wp*(pi/48.0_wp)**2
      type(limited_shear_t) :: shear
      type(oil_t) :: oil
      ! c, x_c [-]; tau [Pa]
      real(wp) :: c, place, stress
      integer :: i

      oil = oil_of(law_barus)
      oil%pressure_viscosity = 0.0_wp
      do i = 1, 9
         c = 0.1_wp*i
         place = sqrt(1.0_wp - c**2)
         stress = c*coefficient*peak
         call locally_limited_shear(film_at(law_newtonian, stress*thickness/viscosity, peak), oil, hot_oil_t(), 0.0_wp, &
            & stress_limit_t(cap_sharp, 0.0_wp, coefficient, 0.0_wp, 0.0_wp), shear)
         call check(error, shear%force/area, stress*place + 0.5_wp*coefficient*peak*(acos(place) - place*c), rel=.true., &
            & thr=allowed)
         if (allocated(error)) return
      end do
   end subroutine test_edges

   subroutine test_constant_limit(error)
      type(error_type), allocatable, intent(out) :: error
      ! tau_L0 [Pa]
      real(wp), parameter :: stress = 8.0e6_wp
      type(limited_shear_t) :: shear
      type(oil_t) :: oil
      ! Stress over its limit [-]
      real(wp) :: part
      integer :: i

      oil = oil_of(law_barus)
      oil%pressure_viscosity = 0.0_wp
      do i = -6, 6
         part = 0.5_wp*i
         call locally_limited_shear(film_at(law_newtonian, part*stress*thickness/viscosity, peak), oil, hot_oil_t(), 0.0_wp, &
            & stress_limit_t(cap_smooth, stress, 0.0_wp, 0.0_wp, 0.0_wp), shear)
         call check(error, abs(shear%force - area*stress*tanh(part)) <= round_off*area*stress)
         if (allocated(error)) return
         call check(error, shear%by_rate, area*viscosity/thickness/cosh(part)**2, rel=.true., thr=10.0_wp*round_off)
         if (allocated(error)) return
      end do
   end subroutine test_constant_limit

   subroutine test_unlimited(error)
      type(error_type), allocatable, intent(out) :: error
      type(limited_shear_t) :: limited
      type(film_shear_t) :: free
      ! [K]
      real(wp) :: rise
      integer :: pressure_law, law, i

      do pressure_law = law_barus, law_roelands
         do law = law_newtonian, law_eyring
            do i = 0, 1
               rise = 15.0_wp*i
               call locally_limited_shear(film_at(law, 0.3_wp, peak), oil_of(pressure_law), warm_hot(), rise, &
                  & stress_limit_t(cap_sharp, 1.0e30_wp, 1.0e-3_wp, 1.0e-3_wp, 0.0_wp), limited)
               call hot_shear(film_at(law, 0.3_wp, peak), oil_of(pressure_law), warm_hot(), rise, free)
               call check(error, limited%force, free%force, rel=.true., thr=round_off)
               if (allocated(error)) return
               call check(error, limited%by_rate, free%by_speed, rel=.true., thr=round_off)
               if (allocated(error)) return
               call check(error, limited%by_peak, free%by_peak, rel=.true., thr=round_off)
               if (allocated(error)) return
               call check(error, limited%by_rise, free%by_rise, rel=.true., thr=round_off)
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_unlimited

   subroutine test_slopes(error)
      type(error_type), allocatable, intent(out) :: error
      ! Relative step, and what the square of it and round-off over it leave [-]
      real(wp), parameter :: h = 1.0e-5_wp, allowed = 1.0e-8_wp
      type(limited_shear_t) :: shear, low, high
      type(stress_limit_t) :: limit
      type(oil_t) :: oil
      ! [m/s], [K]
      real(wp) :: speed, rise
      integer :: pressure_law, law, i

      speed = 0.05_wp
      rise = 12.0_wp
      do pressure_law = law_barus, law_roelands
         oil = oil_of(pressure_law)
         do law = law_newtonian, law_eyring
            do i = 0, 1
               limit = stress_limit_t(cap_smooth, 1.0e6_wp, 0.05_wp, 2.0e-3_wp, 1.0e-3_wp*i)
               call locally_limited_shear(film_at(law, speed, peak), oil, warm_hot(), rise, limit, shear)
               call locally_limited_shear(film_at(law, speed*(1.0_wp - h), peak), oil, warm_hot(), rise, limit, low)
               call locally_limited_shear(film_at(law, speed*(1.0_wp + h), peak), oil, warm_hot(), rise, limit, high)
               call agree((shear%by_rate + shear%by_slip)*speed, "speed")
               if (allocated(error)) return
               call locally_limited_shear(film_at(law, speed, peak*exp(-h)), oil, warm_hot(), rise, limit, low)
               call locally_limited_shear(film_at(law, speed, peak*exp(h)), oil, warm_hot(), rise, limit, high)
               call agree(shear%by_peak, "pressure")
               if (allocated(error)) return
               call locally_limited_shear(film_at(law, speed, peak), oil, warm_hot(), rise*(1.0_wp - h), limit, low)
               call locally_limited_shear(film_at(law, speed, peak), oil, warm_hot(), rise*(1.0_wp + h), limit, high)
               call agree(shear%by_rise*rise, "temperature")
               if (allocated(error)) return
            end do
         end do
      end do

   contains

      !> Is a slope that of the difference?
      subroutine agree(slope, name)
         ! [N]
         real(wp), intent(in) :: slope
         character(len=*), intent(in) :: name

         call check(error, abs((high%force - low%force)/(2.0_wp*h) - slope) < allowed*abs(shear%force), name)
      end subroutine agree
   end subroutine test_slopes

   subroutine test_no_pressure(error)
      type(error_type), allocatable, intent(out) :: error
      ! A limit of one pascal [N]
      real(wp), parameter :: most = area
      type(limited_shear_t) :: shear

      call locally_limited_shear(film_at(law_newtonian, 1.0_wp, 0.0_wp), oil_of(law_cameron), hot_oil_t(), 0.0_wp, &
         & stress_limit_t(cap_smooth, 0.0_wp, 0.05_wp, 0.0_wp, 1.0e-6_wp), shear)
      call check(error, shear%force > 0.0_wp .and. shear%force <= most*(1.0_wp + round_off))
   end subroutine test_no_pressure

   !> A film that is sheared.
   pure function film_at(law, sliding_speed, pressure) result(film)
      integer, intent(in) :: law
      ! [m/s], [Pa]
      real(wp), intent(in) :: sliding_speed, pressure
      type(sheared_film_t) :: film

      film = sheared_film_t(law, sliding_speed, pressure, area, thickness, eyring_stress)
   end function film_at

   !> An oil that any law of pressure takes.
   pure function oil_of(law) result(oil)
      integer, intent(in) :: law
      type(oil_t) :: oil

      oil = oil_t(viscosity=viscosity, pressure_viscosity=1.8e-8_wp, pressure_law=law, roelands_index=0.6_wp, &
         & roelands_exponent=log(viscosity) + 9.67_wp)
   end function oil_of

   !> How it follows the temperature.
   pure function warm_hot() result(hot)
      type(hot_oil_t) :: hot

      hot = hot_oil_t(0.03_wp, 2.0e-3_wp, 1.0e-3_wp)
   end function warm_hot

end module test_local_limit
