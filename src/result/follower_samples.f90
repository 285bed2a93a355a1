!> What is sampled of a cycle: series and torques of a follower.
!>
!> In: case, model, cycle, then angles. Out: values to be integrated, and the extremes found on the way. The torque against
!> spring, seat and inertia and the one that spins the roller up are left out of what is integrated: their integrals are differences
!> of stored energy, which `stored_work` takes.
module camroller_follower_samples
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_state, only : state_t, flight_torque
   use camroller_cycle, only : cycle_t, state_at
   use camroller_catalogue, only : follower_values
   use camroller_torque_list, only : torque_count, of_geometric, of_roller_inertia
   use camroller_contact_forces, only : contact_t, film_groups
   use camroller_film, only : groups_t, is_in_range, takes_whole_load
   use camroller_film_range, only : film_range_t, note_film
   use camroller_heat, only : hot_oil_range, is_inlet_in_range
   use camroller_axial_table, only : effective_lengths, slice_width
   use camroller_hertz, only : peak_pressure
   use camroller_part_series, only : largest_pressure
   use camroller_extremes, only : samples_t, add_sample, start_rows => start_samples
   use camroller_panels, only : sampled_t
   use camroller_traction, only : dry_shear_ratio, film_pressure, rolling_biboulet_houpert, rolling_goksem_hargreaves, &
      & rolling_resistance, line_lengths_t, same_lengths
   implicit none
   private

   public :: shares_t, add_shares, thinnest_film, liquid_stress, shear_ratio_allowed, follower_samples_t, start_samples, &
      & sampled_values, entrainment_t, entrainment_of, extremes_t, widen, trail_t, contact_ahead, extend_trail

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
      !> Rise of the film's temperature that its oil is good for; negative: not asked for yet [K]
      real(wp) :: good_rise = -1.0_wp
      !> Fraction of the cycle with a larger one [-]; the largest [K], and its cam angle from full lift [rad]
      real(wp) :: hot_share = 0.0_wp, hot_rise = 0.0_wp, hot_angle = 0.0_wp
      !> Largest pressure at an end of the roller where there is none larger [Pa], over that of the same load all along it [-], and
      !> its cam angle from full lift [rad]
      real(wp) :: edge_pressure = 0.0_wp, edge_factor = 0.0_wp, edge_angle = 0.0_wp
      !> Fraction of the cycle in which one end of the roller alone carries load [-]
      real(wp) :: one_end_share = 0.0_wp
      !> Fraction of the cycle with more than `rolling_excess_allowed` of the rolling resistance of a law for all contacts [-]; the
      !> largest part of it [-], and its cam angle from full lift [rad]
      real(wp) :: rolling_share = 0.0_wp, rolling_excess = 0.0_wp, rolling_angle = 0.0_wp
      !> Fraction of the cycle with a film below `thinnest_film` of the roughness [-]; the smallest part of it [-], and its cam
      !> angle from full lift [rad]
      real(wp) :: thin_share = 0.0_wp, thinnest_ratio = huge(1.0_wp), thinnest_angle = 0.0_wp
      !> Fraction of the cycle in which the roller slips where the strip of the dry contact gives a shear off by more than
      !> `shear_ratio_allowed` [-]; mean over the cycle of the logarithm there of that shear over the one from rigid to elastic
      !> contacts [-]
      real(wp) :: rigid_share = 0.0_wp, rigid_excess = 0.0_wp
      !> Fraction of the cycle in which the limit of the traction counts below `liquid_stress` [-]; the smallest such limit [Pa]
      real(wp) :: liquid_share = 0.0_wp, least_limit = huge(1.0_wp)
      !> Fraction of the cycle in which the roller turns backwards in its finger [-]
      real(wp) :: backward_share = 0.0_wp
   end type shares_t

   !> One point of a cycle, for the search of standstills, of pure rolling, and of ends of the roller that begin to carry load
   type :: entrainment_t
      !> Cam angle from full lift [rad]
      real(wp) :: angle = 0.0_wp
      !> Mean surface speed, sliding speed [m/s]
      real(wp) :: entrainment_speed = 0.0_wp, sliding_speed = 0.0_wp
      logical :: is_touching = .false.
      !> How many ends of the roller carry load, where the case has its profile
      integer :: loaded_ends = 0
      !> Where the pressure along it is largest, from the middle in widths of a slice [-]
      real(wp) :: peak_slice = 0.0_wp
   end type entrainment_t

   !> Smallest and largest values of a follower at the points evaluated
   type :: extremes_t
      !> Normal load [N], torque that drives this follower [N m]
      real(wp) :: contact_load(2) = [huge(1.0_wp), -huge(1.0_wp)], torque_drive(2) = [huge(1.0_wp), -huge(1.0_wp)]
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed(2) = [huge(1.0_wp), -huge(1.0_wp)]
      !> Largest pressure of the dry contact [Pa]
      real(wp) :: hertz_pressure = 0.0_wp
      !> Smallest film where there is contact; huge where there is none [m]
      real(wp) :: film_min = huge(1.0_wp)
   end type extremes_t

   !> Contacts that were solved last, one behind the other, from which the next one is looked for
   type :: trail_t
      !> How many of them there are, none without contact
      integer :: count = 0
      !> Their cam angles, rising [rad]; tangential force [N], torque of the bearing [N m] and film ratio [-], shape (3, point)
      real(wp) :: angles(3), values(3, 3)
   end type trail_t

   !> A follower on its cycle
   type, extends(sampled_t) :: follower_samples_t
      !> The case; without it, torques are sampled and no series
      type(case_t), pointer :: case => null()
      type(model_t), pointer :: model => null()
      type(cycle_t), pointer :: cycle => null()
      !> Interval of the trajectory where the search starts
      integer :: hint = 1
      !> Number of series, and the first of them that is a torque
      integer :: series = 0, first_torque = 1
      !> State at the point that was sampled last
      type(state_t) :: state
      !> Contacts up to there
      type(trail_t) :: trail
      !> Series of the follower at the points evaluated
      type(samples_t) :: rows
      !> Largest magnitude of the sliding speed evaluated [m/s]
      real(wp) :: largest_sliding = 0.0_wp
      !> Extremes at the points evaluated, without a case
      type(extremes_t) :: extremes
   contains
      procedure :: sample
   end type follower_samples_t

   !> Rolling resistance over that by a law for all contacts, from which on a word is due: in elastic contacts the laws are closer
   !> to each other (test_traction) [-]
   real(wp), parameter :: rolling_excess_allowed = 2.0_wp
   !> Film over roughness of a contact from which down a word is due: laws for smooth surfaces and Greenwood and Tripp's asperities
   !> then share the load as if these still stood on a film. Hot oil at low speed, where roughness is a few times the film, is mixed
   !> friction as the source has it; a tenth is beyond that [-]
   real(wp), parameter :: thinnest_film = 0.1_wp
   !> Slip from which on the shear of the film has a say in it: where asperities hold the roller it slips by less [-]; error of the
   !> shear, as a factor, from which on a word is due, and pressure times its coefficient of viscosity up to which it is: the strip
   !> from rigid to elastic contacts is off by 1/1.3 to 1.2 itself at light pressures, and by any factor at larger ones [-]
   real(wp), parameter :: notable_slip = 0.01_wp, shear_ratio_allowed = 1.3_wp, light_pressure = 7.0_wp
   !> Stress below which oil shears as a liquid whatever its limit is said to be: a fifth of what the limiting stress of oils is
   !> without pressure, some MPa (Johnson and Tevaarwerk 1977; Bair and Winer 1979) [Pa]; part of its limit at which `tanh` takes a
   !> tenth of the shear [-]
   real(wp), parameter :: liquid_stress = 1.0e6_wp, limited_part = 0.52_wp

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

      logical :: is_inside

      associate (groups => film_groups(model, state%position, state%contact))
         is_inside = .true.
         if (state%contact%is_touching) then
            is_inside = is_in_range(model%film_law, groups, model%film_table)
         else
            shares%lost_share = shares%lost_share + weight
         end if
         if (.not. is_inside .and. shares%film_range%share <= 0.0_wp) shares%first_outside = angle
         if (allocated(model%heat) .and. state%contact%is_touching) then
            if (.not. is_inlet_in_range(model%heat%inlet_law, model%heat%loading, state%contact%entrainment_speed, &
               & peak_pressure(state%contact%load, state%position%equivalent_radius, state%contact%length, model%modulus) &
               & /model%modulus)) shares%inlet_share = shares%inlet_share + weight
            if (state%contact%film_rise > 0.0_wp) call note_hot_film(shares, model, state%contact%film_rise, angle, weight)
         end if
         if (state%contact%is_touching) then
            if (allocated(model%axial)) call note_ends(shares, model, state, angle, weight)
            if (model%rolling_law == rolling_goksem_hargreaves) call note_rolling(shares, model, state, groups, angle, weight)
            if (.not. takes_whole_load(model%film_law)) call note_thin(shares, state%contact%film_ratio, angle, weight)
            call note_shear(shares, model, state, groups, weight)
         end if
         call note_film(shares%film_range, groups, is_inside, in_event, state%torque_friction, weight)
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

      if (film_ratio >= thinnest_film) return
      shares%thin_share = shares%thin_share + weight
      if (film_ratio >= shares%thinnest_ratio) return
      shares%thinnest_ratio = film_ratio
      shares%thinnest_angle = angle
   end subroutine note_thin

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

   !> Note where a film is warmer than the oil of a hot film is good for.
   subroutine note_hot_film(shares, model, rise, angle, weight)
      !> The fractions
      class(shares_t), intent(inout) :: shares
      !> Model of the lobe, with heat
      type(model_t), intent(in) :: model
      !> Rise of the film's temperature [K], cam angle from full lift [rad]
      real(wp), intent(in) :: rise, angle
      !> Fraction of the cycle that the state represents [-]
      real(wp), intent(in) :: weight

      if (shares%good_rise < 0.0_wp) shares%good_rise = hot_oil_range(model%heat, model%lubricant, model%oil)
      if (rise <= shares%good_rise) return
      shares%hot_share = shares%hot_share + weight
      if (rise <= shares%hot_rise) return
      shares%hot_rise = rise
      shares%hot_angle = angle
   end subroutine note_hot_film

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

   !> Begin with a cycle; with the case, its series are sampled too.
   subroutine start_samples(samples, model, cycle, case, series, first_torque)
      !> The samples
      type(follower_samples_t), intent(out) :: samples
      !> Model of the lobe
      type(model_t), intent(in), target :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in), target :: cycle
      !> The case
      type(case_t), intent(in), target, optional :: case
      !> Number of series of the case, and the first of them that is a torque
      integer, intent(in), optional :: series, first_torque

      samples%state%contact%is_touching = .false.
      samples%model => model
      samples%cycle => cycle
      if (present(case)) then
         samples%case => case
         samples%series = series
         samples%first_torque = first_torque
         call start_rows(samples%rows, samples%first_torque - 1)
      end if
   end subroutine start_samples

   !> Series and torques at a cam angle, with zero for torques among the series and for what follows from stored energy.
   subroutine sample(self, x, values, error)
      !> The samples
      class(follower_samples_t), intent(inout) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: x
      !> Values of the series [unit of the series], then the torques [N m], last the energy residual [W]
      real(wp), intent(out) :: values(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(contact_t) :: nearby

      call follow_ramp(self%model, x)
      nearby = contact_ahead(self%trail, x, self%state%contact)
      call state_at(self%cycle, self%model, x, self%hint, self%state, error, nearby)
      if (allocated(error)) return
      call extend_trail(self%trail, x, self%state%contact)
      self%largest_sliding = max(self%largest_sliding, abs(self%state%contact%sliding_speed))
      call sampled_values(self, self%state, values)
      if (associated(self%case)) then
         call add_sample(self%rows, x, values(:self%first_torque - 1), .false.)
      else
         call widen(self%extremes, self%model, self%state)
      end if
   end subroutine sample

   !> Contact to start from at an angle: the last one, with what is not known before it is solved on the parabola through three.
   pure function contact_ahead(trail, angle, last) result(nearby)
      !> Contacts that were solved last
      type(trail_t), intent(in) :: trail
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The last of them
      type(contact_t), intent(in) :: last
      !> What to start from
      type(contact_t) :: nearby

      ! Values at the angle [unit of each]; distances of the angle from those of the trail [rad]
      real(wp) :: values(3), ahead(3)

      nearby = last
      if (trail%count < 2) return
      associate (x => trail%angles, y => trail%values, n => trail%count)
         ahead(:n) = angle - x(:n)
         ! No further than the trail is long
         if (.not. (ahead(n) > 0.0_wp .and. ahead(n) <= x(n) - x(1))) return
         values = y(:, n) + (y(:, n) - y(:, n - 1))*(ahead(n)/(x(n) - x(n - 1)))
         if (n == 3) values = values + ahead(3)*ahead(2)/(x(3) - x(1)) &
            & *((y(:, 3) - y(:, 2))/(x(3) - x(2)) - (y(:, 2) - y(:, 1))/(x(2) - x(1)))
      end associate
      nearby%tangential_force = values(1)
      nearby%bearing_torque = values(2)
      nearby%film_ratio = values(3)
   end function contact_ahead

   !> Take a contact into the trail; one behind the last, or none, begins anew.
   pure subroutine extend_trail(trail, angle, contact)
      !> The trail
      type(trail_t), intent(inout) :: trail
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The contact there
      type(contact_t), intent(in) :: contact

      if (trail%count > 0) then
         if (angle <= trail%angles(trail%count)) trail%count = 0
      end if
      if (.not. contact%is_touching) trail%count = 0
      if (.not. contact%is_touching) return
      if (trail%count == 3) then
         trail%angles(:2) = trail%angles(2:)
         trail%values(:, :2) = trail%values(:, 2:)
         trail%count = 2
      end if
      trail%count = trail%count + 1
      trail%angles(trail%count) = angle
      trail%values(:, trail%count) = [contact%tangential_force, contact%bearing_torque, contact%film_ratio]
   end subroutine extend_trail

   !> Values of a state of the follower, in the order of `sample`.
   pure subroutine sampled_values(samples, state, values)
      !> The samples
      class(follower_samples_t), intent(in) :: samples
      !> The state
      type(state_t), intent(in) :: state
      !> Values of the series [unit of the series], then the torques [N m], last the energy residual [W]
      real(wp), intent(out) :: values(:)

      ! Torques of the follower [N m]
      real(wp) :: torques(torque_count)

      torques = state%torques
      if (associated(samples%case)) then
         call follower_values(samples%case, samples%model, state, values(:samples%first_torque - 1))
         values(samples%first_torque:samples%series) = 0.0_wp
      end if
      torques(of_geometric) = merge(state%moments%gas*state%position%finger_slope, flight_torque(samples%model, state), &
         & state%contact%is_touching)
      torques(of_roller_inertia) = 0.0_wp
      values(samples%series + 1:) = torques
   end subroutine sampled_values

   !> Let extremes take in a state.
   pure subroutine widen(extremes, model, state)
      !> The extremes
      type(extremes_t), intent(inout) :: extremes
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state

      call widen_range(extremes%contact_load, state%contact%load)
      call widen_range(extremes%torque_drive, state%torque_drive)
      call widen_range(extremes%sliding_speed, state%contact%sliding_speed)
      if (.not. state%contact%is_touching) return
      extremes%hertz_pressure = max(extremes%hertz_pressure, peak_pressure(state%contact%load, state%position%equivalent_radius, &
         & state%contact%length, model%modulus))
      extremes%film_min = min(extremes%film_min, state%contact%film_min)
   end subroutine widen

   !> Let a range take in a value.
   pure subroutine widen_range(range, value)
      !> Smallest and largest [any]
      real(wp), intent(inout) :: range(2)
      !> The value [any]
      real(wp), intent(in) :: value

      range = [min(range(1), value), max(range(2), value)]
   end subroutine widen_range

   !> The point that was sampled last, as these searches need it.
   pure function entrainment_of(samples, angle) result(speed)
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Its cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> What it is like
      type(entrainment_t) :: speed

      speed%angle = angle
      speed%entrainment_speed = samples%state%contact%entrainment_speed
      speed%sliding_speed = samples%state%contact%sliding_speed
      speed%is_touching = samples%state%contact%is_touching
      if (.not. (allocated(samples%model%axial) .and. speed%is_touching)) return
      speed%loaded_ends = count(samples%state%along%ends > 0.0_wp)
      speed%peak_slice = samples%state%along%place/slice_width(samples%model%axial)
   end function entrainment_of

end module camroller_follower_samples
