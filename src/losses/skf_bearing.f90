!> Friction of a roller's needle bearing by SKF's model: rolling resistance of its contacts, with heat and want of oil at their
!> inlets, and sliding under a film that is torn at low speed.
!>
!> In: dimensions, constants of the bearing's kind, kinematic viscosity, load, spin of the roller relative to the finger. Out:
!> torque on the roller, with its derivatives over load and spin.
!>
!> Source: SKF, Rolling bearings, catalogue 10000 EN (2013), "The SKF model for calculating the frictional moment"; Morales-Espejel,
!> Evolution 2 (2006). In its units, torque in N mm, d_m in mm, F in N, n in rev/min, nu in mm^2/s:
!>
!> `M = P_ish P_rs R_1 d_m^2.41 F^0.31 (nu n)^0.6 + [P_bl mu_bl + (1 - P_bl) mu_EHL] S_2 d_m F` with
!> `P_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 nu^0.64]` (heat at the inlet),
!> `P_rs = exp{-K_rs nu n (d + D) sqrt[K_Z/(2(D - d))]}` (oil that does not come back in time),
!> `P_bl = exp[-2.6e-8 (nu n)^1.4 d_m]` (the part of the sliding that has no film).
!>
!> The form is that of cylindrical roller bearings without axial load, without seals and without the drag of an oil bath. Bore d and
!> outside diameter D are those of needles without rings: pin and bore of the roller. The sign is spread over a small spin.
module camroller_skf_bearing
   use camroller_kinds, only : wp, per_minute
   use camroller_error, only : error_t, raise, kind_deck
   implicit none
   private

   public :: skf_bearing_t, skf_part_t, skf_state_t, new_skf_part, set_skf_oil, solve_skf

   !> Constants of the kind of bearing, as a deck has them, for SKF's units
   type :: skf_bearing_t
      !> Factors of rolling and sliding torque, R_1 and S_2 [-]
      real(wp) :: rolling = 0.0_wp, sliding = 0.0_wp
      !> Constants of geometry and of the oil's return, K_Z and K_rs [-]
      real(wp) :: geometry = 0.0_wp, replenishment = 3.0e-8_wp
      !> Coefficient of sliding under a whole film, mu_EHL [-]
      real(wp) :: film_coefficient = 0.02_wp
   end type skf_bearing_t

   !> The same ready for evaluation, in SKF's units
   type :: skf_part_t
      private
      !> Mean diameter, d_m [mm]
      real(wp) :: diameter = 0.0_wp
      !> Torque of rolling over `F^0.31 (nu n)^0.6`, that of sliding over coefficient and load [N mm, mm]
      real(wp) :: rolling = 0.0_wp, sliding = 0.0_wp
      !> Exponent of P_rs over `nu n` [1/(mm^2/s rev/min)]
      real(wp) :: starvation = 0.0_wp
      !> Coefficients without a film and under a whole one [-]
      real(wp) :: boundary_coefficient = 0.0_wp, film_coefficient = 0.0_wp
      !> Kinematic viscosity [mm^2/s]; 1/P_ish - 1 over the 1.28th power of the speed [(rev/min)^-1.28]
      real(wp) :: viscosity = 0.0_wp, heat = 0.0_wp
   end type skf_part_t

   !> A bearing at one instant
   type :: skf_state_t
      !> Torque on the roller against its spin [N m]
      real(wp) :: torque = 0.0_wp
      !> Its derivatives over the logarithm of the load [N m], over the spin [N m s/rad], and over the logarithm of the spin over
      !> which it reverses [N m]
      real(wp) :: by_load = 0.0_wp, by_spin = 0.0_wp, by_reversal = 0.0_wp
   end type skf_state_t

   !> Powers of diameter, load and viscosity times speed in the rolling torque [-]
   real(wp), parameter :: diameter_power = 2.41_wp, load_power = 0.31_wp, speed_power = 0.6_wp
   !> Factor and powers of P_ish [-]
   real(wp), parameter :: heat_factor = 1.84e-9_wp, heat_speed_power = 1.28_wp, heat_viscosity_power = 0.64_wp
   !> Factor and power of P_bl [-]
   real(wp), parameter :: film_factor = 2.6e-8_wp, film_power = 1.4_wp
   !> mm in a m, mm^2/s in a m^2/s, N m in a N mm [-]
   real(wp), parameter :: millimetres = 1.0e3_wp, square_millimetres = 1.0e6_wp, newton_millimetre = 1.0e-3_wp

contains

   !> Make the bearing ready.
   subroutine new_skf_part(part, given, inner_radius, needle_radius, coefficient, error)
      !> Ready for evaluation
      type(skf_part_t), intent(out) :: part
      !> As a deck has it
      type(skf_bearing_t), intent(in) :: given
      !> Inner radius of the roller, radius of a needle [m]
      real(wp), intent(in) :: inner_radius, needle_radius
      !> Coefficient of sliding without a film, mu_bl [-]
      real(wp), intent(in) :: coefficient
      !> Deck error: no room for a pin, or constants that are not above zero
      type(error_t), allocatable, intent(out) :: error

      if (.not. (needle_radius > 0.0_wp .and. inner_radius > 2.0_wp*needle_radius)) then
         call raise(error, kind_deck, "needle_bearing: needles must have a radius above zero and leave a pin between them")
      else if (.not. (min(given%rolling, given%sliding, given%geometry) > 0.0_wp .and. &
         & min(given%replenishment, given%film_coefficient, coefficient) >= 0.0_wp)) then
         call raise(error, kind_deck, "needle_bearing: kind 'needles_skf' needs factors of rolling, sliding and "// &
            & "geometry above zero")
      end if
      if (allocated(error)) return
      part%diameter = 2.0_wp*(inner_radius - needle_radius)*millimetres
      part%rolling = given%rolling*part%diameter**diameter_power
      part%sliding = given%sliding*part%diameter
      part%starvation = given%replenishment*2.0_wp*part%diameter*sqrt(given%geometry/(8.0_wp*needle_radius*millimetres))
      part%boundary_coefficient = coefficient
      part%film_coefficient = given%film_coefficient
   end subroutine new_skf_part

   !> Give the bearing the oil.
   pure subroutine set_skf_oil(part, kinematic_viscosity)
      !> The bearing
      type(skf_part_t), intent(inout) :: part
      !> Kinematic viscosity of the oil [m^2/s]
      real(wp), intent(in) :: kinematic_viscosity

      part%viscosity = kinematic_viscosity*square_millimetres
      part%heat = heat_factor*part%diameter**heat_speed_power*part%viscosity**heat_viscosity_power
   end subroutine set_skf_oil

   !> State of a bearing under a load.
   pure subroutine solve_skf(part, load, spin, reversal_spin, state)
      !> The bearing
      type(skf_part_t), intent(in) :: part
      !> Load [N]
      real(wp), intent(in) :: load
      !> Spin of the roller relative to the pin; spin over which the torque reverses, above zero [rad/s]
      real(wp), intent(in) :: spin, reversal_spin
      !> The state
      type(skf_state_t), intent(out) :: state

      ! Magnitude of the spin [rev/min]; viscosity times that [mm^2/s rev/min]
      real(wp) :: speed, product
      ! Heat at the inlet, 1/P_ish - 1; exponents of P_rs and P_bl; P_bl; tanh(spin/reversal spin) [-]
      real(wp) :: heat, starving, covering, bare, sign_part
      ! Torques of rolling and sliding; derivative of both over the logarithm of the spin [N m]; part of the sign over the spin
      ! [s/rad]
      real(wp) :: rolling, sliding, by_speed, sign_over_spin

      state = skf_state_t()
      if (.not. load > 0.0_wp) return
      speed = abs(spin)*per_minute
      product = part%viscosity*speed
      heat = part%heat*speed**heat_speed_power
      starving = part%starvation*product
      rolling = newton_millimetre*part%rolling*load**load_power*product**speed_power*exp(-starving)/(1.0_wp + heat)
      covering = film_factor*part%diameter*product**film_power
      bare = exp(-covering)
      sliding = newton_millimetre*part%sliding*load
      by_speed = rolling*(speed_power - heat_speed_power*heat/(1.0_wp + heat) - starving) &
         & - sliding*(part%boundary_coefficient - part%film_coefficient)*film_power*covering*bare
      sliding = sliding*(part%film_coefficient + bare*(part%boundary_coefficient - part%film_coefficient))

      sign_part = tanh(spin/reversal_spin)
      sign_over_spin = 1.0_wp/reversal_spin
      if (abs(spin) > epsilon(spin)*reversal_spin) sign_over_spin = sign_part/spin
      state%torque = sign_part*(rolling + sliding)
      state%by_load = sign_part*(load_power*rolling + sliding)
      state%by_spin = (rolling + sliding)*(1.0_wp - sign_part)*(1.0_wp + sign_part)/reversal_spin + by_speed*sign_over_spin
      state%by_reversal = -spin/reversal_spin*(rolling + sliding)*(1.0_wp - sign_part)*(1.0_wp + sign_part)
   end subroutine solve_skf

end module camroller_skf_bearing
