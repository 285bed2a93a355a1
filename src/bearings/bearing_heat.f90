!> Heat balance of a journal bearing: how warm its oil is.
!>
!> In: dimensions, mean friction and mean eccentricity of a turn, what is given about heat. Out: flow of oil through the bearing,
!> rise of its mean temperature above that of the oil supplied.
!>
!> Oil enters at the temperature of the supply, and what leaves at the sides carries friction's heat with it. The viscosity that
!> counts is that at the mean of both temperatures (ISO 7902-1):
!>
!>     Q  = omega r c L (1 - 0.223 (L/D)^2) e      side flow; the bracket is 1 for the short bearing, whose closed form it is
!>     dT = 1/2 share P/(rho c_p Q)                with the mean power of friction P and the mean of e over the turn
!>
!> The fit of the bracket is for widths to one diameter, as it is used; beyond 1.2 a wider bearing would let less oil out.
!>
!> The bearing and its oil are too slow to follow a turn. Left out: oil that is pressed through by the pressure of the supply.
!>
!> What the metal takes is `1 - share`, whatever its temperature. How large that part is follows from what the oil carries away, the
!> film passes into the metal and the metal passes on, all three per kelvin. The film conducts much better than the rest, so that
!> the oil is as warm as the metal, and the metal decides: one as cold as the oil supplied takes all that the film conducts, and
!> any takes what it gives off to still air.
module camroller_bearing_heat
   use camroller_kinds, only : two_pi, wp
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_journal, only : cam_bearings_t, is_short, journal_law_names, journal_t, law_short
   implicit none
   private

   public :: bearing_heat_t, check_bearing_heat, oil_flow, temperature_rise, direct_advice, flow_covers_width, flow_advice
   public :: heat_by_oil, heat_by_film, heat_by_housing

   !> What a case says about heat of its camshaft bearings
   type :: bearing_heat_t
      !> Heat capacity of the oil [J/(kg K)]
      real(wp) :: heat_capacity = 2000.0_wp
      !> Part of the friction's heat that the oil carries away; the rest goes into the metal. One: the metal passes nothing on [-]
      real(wp) :: oil_share = 1.0_wp
   end type bearing_heat_t

   !> What to say where the viscosity does not depend on the temperature
   character(len=*), parameter :: direct_advice = "the heat balance of camshaft bearings needs a viscosity that depends on the "// &
      & "temperature: another temperature_law than 'direct' in &lubricant"

   !> Width over diameter to which the side flow is known, but for short bearings [-]
   real(wp), parameter :: widest = 1.0_wp
   !> Heat that the metal of a bearing passes on at the least, over the journal's surface in it: 20 W/(m^2 K) into air that hardly
   !> moves, from a housing of some 15 B D (usual values for bearings that their housing cools, as in ISO 7902-1: recalled, not
   !> compared with it) [W/(m^2 K)]
   real(wp), parameter :: least_transfer = 100.0_wp
   !> What to say where it is not
   character(len=*), parameter :: flow_advice = "the heat balance of camshaft bearings knows the oil that leaves at the sides "// &
      & "of bearings up to 1 diameter wide; leave &bearing_heat out for wider ones"

contains

   !> Refuse numbers that cannot be.
   subroutine check_bearing_heat(heat, bearings, error)
      !> What is given
      type(bearing_heat_t), intent(in) :: heat
      !> The bearings
      type(cam_bearings_t), intent(in) :: bearings
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      if (.not. (heat%heat_capacity > 0.0_wp .and. heat%oil_share >= 0.0_wp .and. heat%oil_share <= 1.0_wp)) then
         call raise(error, kind_deck, "the heat balance of camshaft bearings needs a heat capacity above zero, and a share of "// &
            & "the oil from 0 to 1")
      else if (.not. flow_covers_width(bearings%law, bearings%width, bearings%diameter)) then
         call raise(error, kind_deck, flow_advice)
      end if
   end subroutine check_bearing_heat

   !> Is the oil known that leaves a bearing of this width at its sides?
   pure function flow_covers_width(law, width, diameter) result(answer)
      !> One of `journal_law_names`
      character(len=*), intent(in) :: law
      !> Width and diameter [m]
      real(wp), intent(in) :: width, diameter
      !> Is it?
      logical :: answer

      answer = width <= widest*diameter .or. law == journal_law_names(law_short)
   end function flow_covers_width

   !> Oil that leaves a bearing at its sides. Source: ISO 7902-1; Ocvirk (1952) for the short bearing.
   pure function oil_flow(journal, speed, eccentricity) result(flow)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Speed of the shaft [rad/s], eccentricity over clearance [-]
      real(wp), intent(in) :: speed, eccentricity
      !> The flow [m^3/s]
      real(wp) :: flow

      ! Fit of finite width [-]
      real(wp), parameter :: width_part = 0.223_wp

      flow = 2.0_wp*abs(speed)*journal%radius**3*journal%clearance_ratio*journal%width_ratio*eccentricity
      if (.not. is_short(journal)) flow = flow*(1.0_wp - width_part*journal%width_ratio**2)
   end function oil_flow

   !> Rise of the oil's mean temperature; huge where no oil leaves.
   pure function temperature_rise(heat, density, power, flow) result(rise)
      !> What is given
      type(bearing_heat_t), intent(in) :: heat
      !> Density of the oil [kg/m^3], mean power of friction [W], mean flow [m^3/s]
      real(wp), intent(in) :: density, power, flow
      !> The rise [K]
      real(wp) :: rise

      real(wp) :: carried ! [W/K]

      rise = 0.0_wp
      if (.not. heat%oil_share*power > 0.0_wp) return
      carried = heat_by_oil(heat, density, flow)
      rise = huge(1.0_wp)
      if (carried > heat%oil_share*power/1.0e6_wp) rise = heat%oil_share*power/carried
   end function temperature_rise

   !> Heat that the oil carries away for each kelvin by which its mean temperature is above that of the supply: it leaves twice as
   !> warm as that.
   pure function heat_by_oil(heat, density, flow) result(carried)
      !> What is given
      type(bearing_heat_t), intent(in) :: heat
      !> Density of the oil [kg/m^3], mean flow [m^3/s]
      real(wp), intent(in) :: density, flow
      !> Power for each kelvin [W/K]
      real(wp) :: carried

      carried = 2.0_wp*density*heat%heat_capacity*flow
   end function heat_by_oil

   !> Heat that the film conducts for each kelvin by which it is warmer than the metal, `k 2 pi r B/c`: into one surface from the
   !> other across the whole clearance, the least.
   pure function heat_by_film(journal, conductivity) result(conducted)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Thermal conductivity of the oil, k [W/(m K)]
      real(wp), intent(in) :: conductivity
      !> Power for each kelvin [W/K]
      real(wp) :: conducted

      conducted = conductivity*surface_of(journal)/(journal%clearance_ratio*journal%radius)
   end function heat_by_film

   !> Heat that the metal passes on at the least for each kelvin by which it is warmer than what is around.
   pure function heat_by_housing(journal) result(passed)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Power for each kelvin [W/K]
      real(wp) :: passed

      passed = least_transfer*surface_of(journal)
   end function heat_by_housing

   !> Surface of the journal in its bearing, `2 pi r B`.
   pure function surface_of(journal) result(surface)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> The surface [m^2]
      real(wp) :: surface

      surface = 2.0_wp*two_pi*journal%radius**2*journal%width_ratio
   end function surface_of

end module camroller_bearing_heat
