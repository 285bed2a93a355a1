!> Shear of a film whose stress is limited at each point of the contact by what the oil bears under the pressure there.
!>
!> In: film, oil at its temperature, limit. Out: shear force after the limit, with its slopes. The limiting stress rises with the
!> pressure along a straight line: Johnson and Tevaarwerk (1977), Proc. Royal Society of London A 356, 215; Bair and Winer (1979),
!> J. Lubrication Technology 101, 251.
module camroller_local_limit
   use camroller_kinds, only : wp
   use camroller_conjunction, only : hot_oil_t, sheared_film_t, viscosity_by_rise, warm_oil
   use camroller_contact_rule, only : rule_heights, rule_weights
   use camroller_lubricant, only : oil_t, relative_viscosity, law_roelands
   use camroller_traction, only : blunt_shear, law_newtonian, limit_shear
   implicit none
   private

   public :: stress_limit_t, limited_shear_t, locally_limited_shear, least_limit

   !> Limit of the stress at a point
   type :: stress_limit_t
      !> Position in `cap_names`
      integer :: cap
      !> Limiting stress without pressure, tau_L0 [Pa]; its rise with the pressure [-]
      real(wp) :: stress, coefficient
      !> Fall of its logarithm per kelvin [1/K]
      real(wp) :: fall
      !> Difference of sliding speeds that need not be resolved; zero: all are [m/s]
      real(wp) :: resolution
   end type stress_limit_t

   !> Shear of a film after its limit
   type :: limited_shear_t
      !> Shear force [N]
      real(wp) :: force
      !> Its slopes: over the sliding speed through the rate of shear, and beside that by the slip that is not resolved [N s/m];
      !> over ln(peak) [N], with that of the limit; over the rise of the temperature [N/K]
      real(wp) :: by_rate, by_slip, by_peak, by_rise
   end type limited_shear_t

   !> Limit at least [Pa]: where asperities bear everything the film has no pressure, and any stress is beyond comparison with zero
   real(wp), parameter :: least_limit = 1.0_wp

contains

   !> Shear force of a film by either shear law, each point with its own limit: `int cap(tau(p), tau_L0 + Lambda p) dA`.
   !>
   !> Quadrature over the half ellipse of pressure as for the mean viscosity. Where all of the film is at its limit, the force is
   !> `A (tau_L0 + Lambda (pi/4) p_0)`.
   pure subroutine locally_limited_shear(film, oil, hot, rise, limit, shear)
      !> The film
      type(sheared_film_t), intent(in) :: film
      !> Oil at the temperature around
      type(oil_t), intent(in) :: oil
      !> How it follows the temperature
      type(hot_oil_t), intent(in) :: hot
      !> Mean rise of the film's temperature [K]
      real(wp), intent(in) :: rise
      !> The limit
      type(stress_limit_t), intent(in) :: limit
      !> Shear force and slopes
      type(limited_shear_t), intent(out) :: shear

      ! Pressures [Pa], viscosity ratios and their logarithmic slopes [-] at the points of the rule
      real(wp), dimension(size(rule_heights)) :: pressures, ratios, log_slopes
      ! Viscosity over film thickness at a point [Pa s/m]; stress and its limit [Pa]; slope of the stress over the speed [Pa s/m]
      real(wp) :: rate, stress, bound, slope
      ! Stress over Eyring's [-]; logarithm of a viscosity ratio where it is needed [-]; change of ln(viscosity) at ambient pressure
      ! [-], its slope, that at a point [1/K]
      real(wp) :: reduced, log_ratio, change, change_slope, by_rise
      ! Derivatives of the limited stress over the free one and over the limit [-], over the speed beside these [Pa s/m]
      real(wp) :: by_free, by_bound, by_slip
      ! The same of the limit alone, and of the slip that is not resolved [-]
      real(wp) :: by_blunt, blunt_by_bound, cap_by_bound
      ! Fall of the limit with the temperature [-]
      real(wp) :: share
      type(oil_t) :: warm
      integer :: i

      shear = limited_shear_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      call warm_oil(hot, oil, rise, warm, change, change_slope)
      share = exp(-limit%fall*rise)
      pressures = film%peak*rule_heights
      call relative_viscosity(warm, pressures, ratios, log_slopes)
      do i = 1, size(pressures)
         log_ratio = 0.0_wp
         if (warm%pressure_law == law_roelands) log_ratio = log(ratios(i))
         by_rise = viscosity_by_rise(hot, warm, change_slope, log_ratio, log_slopes(i))
         rate = warm%viscosity*ratios(i)/film%thickness
         stress = rate*film%sliding_speed
         slope = rate
         if (film%law /= law_newtonian) then
            reduced = stress/film%eyring_stress
            stress = film%eyring_stress*asinh(reduced)
            slope = rate/hypot(1.0_wp, reduced)
         end if
         bound = max(limit%stress + limit%coefficient*pressures(i), least_limit)*share
         by_blunt = 1.0_wp
         blunt_by_bound = 0.0_wp
         by_slip = 0.0_wp
         if (limit%resolution > 0.0_wp) call blunt_shear(film%sliding_speed, limit%resolution, bound, slope, stress, by_blunt, &
            & blunt_by_bound, by_slip)
         call limit_shear(limit%cap, bound, stress, by_free, cap_by_bound)
         by_bound = cap_by_bound + by_free*blunt_by_bound
         by_slip = by_free*by_slip
         slope = by_free*by_blunt*slope
         shear%force = shear%force + rule_weights(i)*stress
         shear%by_rate = shear%by_rate + rule_weights(i)*slope
         shear%by_slip = shear%by_slip + rule_weights(i)*by_slip
         shear%by_peak = shear%by_peak + rule_weights(i)*(slope*film%sliding_speed*log_slopes(i) &
            & + by_bound*limit%coefficient*pressures(i)*share)
         shear%by_rise = shear%by_rise + rule_weights(i)*(slope*film%sliding_speed*by_rise - by_bound*bound*limit%fall)
      end do
      shear%force = shear%force*film%area
      shear%by_rate = shear%by_rate*film%area
      shear%by_slip = shear%by_slip*film%area
      shear%by_peak = shear%by_peak*film%area
      shear%by_rise = shear%by_rise*film%area
   end subroutine locally_limited_shear

end module camroller_local_limit
