!> Fractions of a cycle in which something holds of a follower that a remark tells of: lost contact, laws outside their range,
!> films, shear and loads that are those of other contacts, joints without friction.
!>
!> In: model, states with the part of the cycle that each stands for. Out: `shares_t`, from which `cycle_remarks` makes words.
module camroller_cycle_shares
   use camroller_kinds, only : wp
   use camroller_asperity, only : spread_load
   use camroller_axial_table, only : effective_lengths, oiled_parts
   use camroller_contact_forces, only : film_groups, law_part
   use camroller_film, only : groups_t, is_in_range, takes_whole_load
   use camroller_film_range, only : film_range_t, note_film
   use camroller_heat, only : is_inlet_in_range
   use camroller_hertz, only : peak_pressure
   use camroller_joint_shares, only : joint_shares_t, note_joints
   use camroller_model, only : model_t
   use camroller_oil_checks, only : hot_film_t, note_hot_film
   use camroller_part_series, only : largest_pressure
   use camroller_state, only : state_t
   use camroller_traction, only : dry_shear_ratio, film_pressure, rolling_biboulet_houpert, rolling_goksem_hargreaves, &
      & rolling_resistance, line_lengths_t, same_lengths
   implicit none
   private

   public :: shares_t, add_shares, thinnest_ratio_allowed, liquid_stress, shear_ratio_allowed

   !> Fractions of a cycle without contact and outside the film law's range
   type :: shares_t
      !> Fraction of the cycle without contact [-]
      real(wp) :: lost_share = 0.0_wp
      !> Where the film law is outside its range
      type(film_range_t) :: film_range
      !> Cam angle from full lift where it is first left [rad]
      real(wp) :: first_outside = 0.0_wp
      !> Fraction of the cycle with heat in the inlet beyond what its factor was published for [-]
      real(wp) :: inlet_share = 0.0_wp
      !> How hot the film is, and for how long hotter than its oil is good for
      type(hot_film_t) :: hot_film
      !> Largest pressure at an end of the roller where there is none larger [Pa], over that of the same load all along it [-], and
      !> its cam angle from full lift [rad]
      real(wp) :: edge_pressure = 0.0_wp, edge_factor = 0.0_wp, edge_angle = 0.0_wp
      !> Fraction of the cycle in which one end of the roller alone carries load [-]
      real(wp) :: one_end_share = 0.0_wp
      !> Fraction of the cycle in which oil carries load beside the slices that the dry contact loads [-]; where it does on the
      !> largest part, over that of the dry contact: both parts of the roller [-], cam angle from full lift [rad]
      real(wp) :: oiled_share = 0.0_wp, oiled_parts(2) = 1.0_wp, oiled_angle = 0.0_wp
      !> Fraction of the cycle with more than `rolling_excess_allowed` of the rolling resistance of a law for all contacts [-]; the
      !> largest part of it [-], and its cam angle from full lift [rad]
      real(wp) :: rolling_share = 0.0_wp, rolling_excess = 0.0_wp, rolling_angle = 0.0_wp
      !> Fraction of the cycle with a film below `thinnest_ratio_allowed` of the roughness [-]; the smallest part of it [-], and its
      !> cam angle from full lift [rad]
      real(wp) :: thin_share = 0.0_wp, thinnest_ratio = huge(1.0_wp), thinnest_angle = 0.0_wp
      !> Fraction of the cycle in which asperities beside the strip of the dry contact, where none are counted, would add more than
      !> `part_gain_allowed` to the asperities' part of the load; means over the cycle of that gain there, and of the part without
      !> it [-]
      real(wp) :: outer_share = 0.0_wp, outer_gain = 0.0_wp, inner_part = 0.0_wp
      !> Fraction of the cycle since they were last looked at [-]
      real(wp) :: since_outer = 0.0_wp
      !> Fraction of the cycle in which the roller slips where the strip of the dry contact gives a shear off by more than
      !> `shear_ratio_allowed` [-]; mean over the cycle of the logarithm there of that shear over the one from rigid to elastic
      !> contacts [-]
      real(wp) :: rigid_share = 0.0_wp, rigid_excess = 0.0_wp
      !> Fraction of the cycle in which the limit of the traction counts below `liquid_stress` [-]; the smallest such limit [Pa]
      real(wp) :: liquid_share = 0.0_wp, least_limit = huge(1.0_wp)
      !> Fraction of the cycle in which the roller turns backwards in its finger [-]
      real(wp) :: backward_share = 0.0_wp
      !> What is left of the friction of sliding joints
      type(joint_shares_t) :: joints
   end type shares_t

   !> Rolling resistance over that by a law for all contacts, from which on a word is due: in elastic contacts the laws are closer
   !> to each other (test_traction) [-]
   real(wp), parameter :: rolling_excess_allowed = 2.0_wp
   !> Film over roughness of a contact from which down a word is due: laws for smooth surfaces and Greenwood and Tripp's asperities
   !> then share the load as if these still stood on a film. Hot oil at low speed, where roughness is a few times the film, is mixed
   !> friction as the source has it; a tenth is beyond that [-]
   real(wp), parameter :: thinnest_ratio_allowed = 0.1_wp
   !> Gain of the asperities' part of the load by those beside the dry contact from which on a word is due: film laws differ by as
   !> much in that part (0.255 by Dowson and Higginson, 0.205 by Moes in a contact of the source with 2.8 um of roughness) [-]; that
   !> part from which on it is looked for: beside the strip is up to ten times of what is in it [-]; fraction of a cycle in which it
   !> is looked for once, since a contact on the base circle is the same for half of it [-]
   real(wp), parameter :: part_gain_allowed = 0.05_wp, notable_asperities = 0.005_wp, outer_step = 0.02_wp
   !> Slip from which on the shear of the film has a say in it: where asperities hold the roller it slips by less [-]; error of the
   !> shear, as a factor, from which on a word is due, and pressure times its coefficient of viscosity up to which it is: the strip
   !> from rigid to elastic contacts is off by 1/1.3 to 1.2 itself at light pressures, and by any factor at larger ones [-]
   real(wp), parameter :: notable_slip = 0.01_wp, shear_ratio_allowed = 1.3_wp, light_pressure = 7.0_wp
   !> Stress below which oil shears as a liquid whatever its limit is said to be: a fifth of what the limiting stress of oils is
   !> without pressure, some MPa (Johnson and Tevaarwerk 1977; Bair and Winer 1979) [Pa]; part of its limit at which `tanh` takes a
   !> tenth of the shear [-]
   real(wp), parameter :: liquid_stress = 1.0e6_wp, limited_part = 0.52_wp
   !> Moes' number below which a contact is nearly rigid, so that its film decides about the load along the roller [-]; part of the
   !> roller with oil over that of the dry contact from which on a word is due [-]
   real(wp), parameter :: rigid_moes = 3.0_wp, notable_oil = 1.1_wp

contains

   !> Add a state to the fractions of a cycle.
   subroutine add_shares(shares, model, state, angle, in_event, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Is the valve off its seat?
      logical, intent(in) :: in_event
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      ! Groups of the film's law, with the load that it takes
      type(groups_t) :: of_film
      logical :: is_inside

      associate (groups => film_groups(model, state%position, state%contact))
         is_inside = .true.
         of_film = groups
         if (state%contact%is_touching) then
            of_film%load = groups%load*law_part(model, state%contact)
            is_inside = is_in_range(model%film_law, of_film, model%film_table)
         else
            shares%lost_share = shares%lost_share + weight
         end if
         if (.not. is_inside .and. shares%film_range%share <= 0.0_wp) shares%first_outside = angle
         if (allocated(model%heat) .and. state%contact%is_touching) then
            if (.not. is_inlet_in_range(model%heat%inlet_law, model%heat%loading, state%contact%entrainment_speed, &
               & peak_pressure(state%contact%load, state%position%equivalent_radius, state%contact%length, model%modulus) &
               & /model%modulus)) shares%inlet_share = shares%inlet_share + weight
            call note_hot_film(shares%hot_film, model%heat, model%lubricant, model%oil, state%contact%film_rise, &
               & merge(state%contact%flash_rise, 0.0_wp, state%contact%asperity_load > 0.0_wp), angle, weight)
         end if
         if (state%contact%is_touching) then
            if (allocated(model%axial)) then
               call note_ends(shares, model, state, angle, weight)
               call note_oil(shares, model, state, groups, angle, weight)
            end if
            if (model%rolling_law == rolling_goksem_hargreaves) call note_rolling(shares, model, state, groups, angle, weight)
            if (.not. takes_whole_load(model%film_law)) then
               call note_thin(shares, state%contact%film_ratio, angle, weight)
               call note_outer(shares, model, state, weight)
            end if
            call note_shear(shares, model, state, groups, weight)
         end if
         call note_film(shares%film_range, of_film, is_inside, in_event, state%torque_friction, weight)
         if (allocated(model%joints)) call note_joints(shares%joints, model, state, weight)
      end associate
   end subroutine add_shares

   !> Note where the film of a law for smooth surfaces is next to nothing beside the roughness.
   pure subroutine note_thin(shares, film_ratio, angle, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Film over roughness [-]
      real(wp), intent(in) :: film_ratio
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      if (film_ratio >= thinnest_ratio_allowed) return
      shares%thin_share = shares%thin_share + weight
      if (film_ratio >= shares%thinnest_ratio) return
      shares%thinnest_ratio = film_ratio
      shares%thinnest_angle = angle
   end subroutine note_thin

   !> Note where asperities would touch beside the strip of the dry contact. Their load with these is that at the central film,
   !> which most of the strip has (the smallest, at which a law's load is taken, is that of its end), beside the film's own load,
   !> which makes this film.
   pure subroutine note_outer(shares, model, state, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      ! Load of the asperities [N], gain of their part of the load, fraction of the cycle that the state stands for [-]
      real(wp) :: load, gain, fraction

      shares%since_outer = shares%since_outer + weight
      if (shares%since_outer < outer_step) return
      fraction = shares%since_outer
      shares%since_outer = 0.0_wp
      associate (contact => state%contact)
         if (contact%asperity_load < notable_asperities*contact%load) return
         load = model%boundary%constants%load_factor*contact%apparent_area*spread_load(model%boundary%constants, &
            & contact%film_central/contact%surfaces%roughness, contact%surfaces%roughness*state%position%equivalent_radius &
            & /contact%half_width**2)
         ! There is no gain then, and may be no load at all beside asperities that carry all of it
         if (load <= contact%asperity_load) return
         gain = load/(load + contact%load - contact%asperity_load) - contact%asperity_load/contact%load
         if (gain <= part_gain_allowed) return
         shares%outer_share = shares%outer_share + fraction
         shares%outer_gain = shares%outer_gain + fraction*gain
         shares%inner_part = shares%inner_part + fraction*contact%asperity_load/contact%load
      end associate
   end subroutine note_outer

   !> Note where a roller that slips is driven by laws for other films: the strip of the dry contact, a limit where oil is liquid.
   pure subroutine note_shear(shares, model, state, groups, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> Groups of its film
      type(groups_t), intent(in) :: groups
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      ! Shear by the dry contact's strip over that by the other one, part of its limit [-]; that limit, a mean stress; pressure [Pa]
      real(wp) :: ratio, part, limit, peak

      associate (contact => state%contact)
         if (abs(contact%sliding_speed) <= notable_slip*abs(contact%rolling_speed)) return
         peak = film_pressure(contact%load - contact%asperity_load, contact%apparent_area, contact%real_area)
         if (.not. model%has_wide_shear .and. model%oil%pressure_viscosity*peak < light_pressure) then
            ratio = dry_shear_ratio(model%oil, peak, groups%speed, groups%load, groups%load*(1.0_wp &
               & - contact%asperity_load/contact%load), contact%film_central/state%position%equivalent_radius)
            if (abs(log(ratio)) > log(shear_ratio_allowed)) then
               shares%rigid_share = shares%rigid_share + weight
               shares%rigid_excess = shares%rigid_excess + weight*log(ratio)
            end if
         end if
         shares%backward_share = shares%backward_share + merge(weight, 0.0_wp, contact%relative_spin*contact%rolling_speed &
            & < -notable_slip*contact%rolling_speed**2/model%roller_radius)
         if (model%has_local_limit) return
         limit = model%limiting_coefficient*contact%load/contact%sheared_area
         part = abs(contact%shear)/(model%limiting_coefficient*contact%load*(1.0_wp - contact%real_area/contact%apparent_area))
         if (limit >= liquid_stress .or. part < limited_part) return
         shares%liquid_share = shares%liquid_share + weight
         shares%least_limit = min(shares%least_limit, limit)
      end associate
   end subroutine note_shear

   !> Note where the law of Goksem and Hargreaves, a fit to elastic contacts that hardly knows the load, is used for a rigid one,
   !> whose rolling resistance vanishes with the load: it is compared with the law of Biboulet and Houpert, which has both.
   pure subroutine note_rolling(shares, model, state, groups, angle, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> Groups of its film
      type(groups_t), intent(in) :: groups
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      ! Lengths of the contact [m] and their slopes [-]
      type(line_lengths_t) :: lengths, by_load, by_radius
      ! Rolling resistance by the other law [N], its slope over the load, the one over the other [-]
      real(wp) :: force, log_slope, excess

      lengths = same_lengths(state%contact%length)
      if (allocated(model%axial)) call effective_lengths(model%axial, state%contact%load, state%position%equivalent_radius, &
         & lengths, by_load, by_radius)
      call rolling_resistance(rolling_biboulet_houpert, groups%speed, groups%load, model%modulus, &
         & state%position%equivalent_radius, lengths, model%oil%pressure_viscosity, force, log_slope)
      if (.not. abs(state%contact%rolling_resistance) > rolling_excess_allowed*force) return
      shares%rolling_share = shares%rolling_share + weight
      excess = abs(state%contact%rolling_resistance)/max(force, tiny(1.0_wp))
      if (excess <= shares%rolling_excess) return
      shares%rolling_excess = excess
      shares%rolling_angle = angle
   end subroutine note_rolling

   !> Note what the ends of the roller carry.
   pure subroutine note_ends(shares, model, state, angle, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> The model of the lobe, with the load along its roller
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      ! Rounding of loads [-]
      real(wp), parameter :: same = 1.0e-6_wp
      real(wp) :: pressure ! [Pa]

      associate (along => state%along)
         if (maxval(along%ends) >= along%peak .and. along%peak > 1.0_wp + same) then
            pressure = largest_pressure(model, state)
            if (pressure > shares%edge_pressure) then
               shares%edge_pressure = pressure
               shares%edge_factor = sqrt(along%peak)
               shares%edge_angle = angle
            end if
         end if
         if (maxval(along%ends) > 0.0_wp .and. minval(along%ends) <= 0.0_wp) shares%one_end_share = shares%one_end_share &
            & + weight
      end associate
   end subroutine note_ends

   !> Note where the film of a nearly rigid contact is thick beside the gap of the slices that the dry contact leaves free: oil
   !> carries load there, and is dragged, of which neither the load along the roller nor the lengths of the contact know.
   pure subroutine note_oil(shares, model, state, groups, angle, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> The model of the lobe, with the load along its roller
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> Groups of its film
      type(groups_t), intent(in) :: groups
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      real(wp) :: parts(2) ! [-]

      associate (contact => state%contact)
         ! Moes' number of a load all along the roller
         if (minval(state%along%ends) > 0.0_wp .or. groups%load*contact%length >= rigid_moes*sqrt(2.0_wp*groups%speed) &
            & *model%axial%length) return
         parts = oiled_parts(model%axial, contact%load, state%position%equivalent_radius, contact%film_central)
      end associate
      if (parts(2) < notable_oil*parts(1)) return
      shares%oiled_share = shares%oiled_share + weight
      if (parts(2)*shares%oiled_parts(1) <= shares%oiled_parts(2)*parts(1)) return
      shares%oiled_parts = parts
      shares%oiled_angle = angle
   end subroutine note_oil

end module camroller_cycle_shares
