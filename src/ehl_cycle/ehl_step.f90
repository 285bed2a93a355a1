!> One step of a contact with a transient film: squeeze, load, load share, friction and the roller's spin, solved together.
!>
!> In: model, angle, the previous states. Out: the contact at the angle. The film's equations contain the rate at which oil is
!> stored in the contact, on nodes that move with the half width; film and roller use the same time integration, backward
!> differences of first or second order. No quantity is taken from the previous step: film, load and sliding speed are iterated
!> until they agree.
module camroller_ehl_step
   use camroller_asperity, only : boundary_friction_t, find_boundary_friction
   use camroller_kinds, only : wp, pi
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_state, only : evaluate_loading
   use camroller_spin, only : rolling_speed_at, rolling_speed_slope
   use camroller_stick, only : has_stick
   use camroller_roller, only : spin_acceleration
   use camroller_traction, only : law_eyring, rolling_none, limit_shear, mobilised_share, sliding_direction
   use camroller_contact_heat, only : has_hot_contact, set_heat
   use camroller_ehl_balance, only : balanced_load, bearing_moment
   use camroller_ehl_grid, only : ehl_grid_t
   use camroller_ehl_problem, only : ehl_contact_t, ehl_problem_t, new_ehl_problem, in_range
   use camroller_ehl_reynolds, only : storage_t
   use camroller_ehl_newton, only : ehl_state_t, solve_newton, contraction
   use camroller_ehl_films, only : ehl_films_t, get_films, limit_cells
   use camroller_ehl_heat, only : warm_film
   use camroller_ehl_solution, only : solve_cold
   implicit none
   private

   public :: moment_t, ehl_march_t, make_step, contact_at, find_film, spin_excess, rate_weights, thickening, &
      & has_turned, max_rounds, lost_part

   !> What a step leaves behind
   type :: moment_t
      !> Cam angle from full lift [rad]
      real(wp) :: angle = 0.0_wp
      !> Sliding speed [m/s], load [N]
      real(wp) :: sliding_speed = 0.0_wp, load = 0.0_wp
      !> Half width that scales the nodes [m], scales of pressure [Pa] and film [m]
      real(wp) :: length_scale = 0.0_wp, pressure_scale = 0.0_wp, film_scale = 0.0_wp
      !> Is there a film, i.e. contact?
      logical :: has_film = .false.
      !> Entrainment speed of the film, negative where the roller runs backwards so fast that the inlet is on the other side [m/s]
      real(wp) :: entrainment = 0.0_wp
      !> Oil in the cells over length and ambient density [m^2]
      real(wp), allocatable :: mass(:)
      !> Film, friction, load share
      type(ehl_films_t) :: films
      !> Traction and the part of it that is shear of the film, what asperities can bear, rolling resistance [N]
      real(wp) :: traction = 0.0_wp, shear = 0.0_wp, boundary_capacity = 0.0_wp, rolling_resistance = 0.0_wp
      !> Rate at which a change of the sliding speed decays, per radian of the cam [-]
      real(wp) :: damping = 0.0_wp
      !> Number of iterations over film and forces
      integer :: rounds = 0
      !> Is the contact one that solutions are given for? As `new_ehl_problem` has it
      integer :: status = in_range
   end type moment_t

   !> What stays over the cycle
   type :: ehl_march_t
      !> Nodes
      type(ehl_grid_t) :: grid
      !> Largest load of the cycle without friction [N]; largest speed of pure rolling [m/s]
      real(wp) :: largest_load = 0.0_wp, largest_rolling = 0.0_wp
      !> Does the film remember? If not, each angle is a steady contact
      logical :: is_transient = .true.
      !> Is the contact as warm as its heat makes it, where the model has heat?
      logical :: is_warm = .false.
      !> What may be left of film and forces [-], and of the sliding speed [m/s]
      real(wp) :: tolerance = 1.0e-6_wp, slip_tolerance = 1.0_wp
   end type ehl_march_t

   !> Parts of the largest load: below the first the nodes no longer shrink with the load, below the second contact counts as lost
   !> [-]
   real(wp), parameter :: scaling_part = 0.02_wp, lost_part = 1.0e-3_wp
   !> Entrainment over the cam's surface speed below which the film is that of this speed [-]
   real(wp), parameter :: least_entrainment = 1.0e-3_wp
   !> Rounds of film and forces, of which the first are not damped, iterations of Newton's method in each, and for the sliding speed
   integer, parameter :: free_rounds = 4, max_rounds = 40, newton_iterations = 25, speed_iterations = 100

contains

   !> Load below which the nodes no longer follow the load.
   pure function least_load_of(march) result(load)
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> The load [N]
      real(wp) :: load

      load = scaling_part*march%largest_load
   end function least_load_of

   !> Film at a load over that at the load which scales the nodes: it is in proportion to 1/load where the contact is rigid.
   pure function thickening(march, load) result(factor)
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> Load; below that at which contact counts as lost the film is that there [N]
      real(wp), intent(in) :: load
      !> The factor [-]
      real(wp) :: factor

      factor = max(1.0_wp, least_load_of(march)/max(load, lost_part*march%largest_load))
   end function thickening

   !> A step from the last moment, and the one before it where there is one, to an angle.
   subroutine make_step(model, march, before, angle, state, now, converged)
      !> The model
      type(model_t), intent(in) :: model
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> Last moment and the one before it; one alone for a step of first order
      type(moment_t), intent(in) :: before(:)
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Pressure nearby, then that at the angle
      type(ehl_state_t), intent(inout) :: state
      !> The contact at the angle
      type(moment_t), intent(out) :: now
      !> Was a solution found?
      logical, intent(out) :: converged

      type(position_t) :: position
      type(moments_t) :: moments
      ! Weights of the moments in the rate [1/s]
      real(wp) :: rates(0:2)
      ! Gas force [N]; sliding speed and load of the round before [m/s], [N]
      real(wp) :: force, speed, load
      integer :: status, round

      converged = .false.
      call evaluate_loading(model, angle, position, force, moments, status)
      if (status /= 0) return
      rates = rate_weights(model%speed, angle, before)
      now%angle = angle
      now%sliding_speed = before(1)%sliding_speed
      state%factors%rate = contraction
      now%load = balanced_load(model, position, moments, before(1)%traction, before(1)%rolling_resistance, 0.0_wp)
      do round = 1, max_rounds
         now%rounds = round
         speed = now%sliding_speed
         load = now%load
         call find_film(model, march, position, before, rates, state, now, converged)
         if (.not. converged) return
         call find_sliding_speed(model, position, before, rates, now)
         ! Where film and slip drive each other round in circles, meet in the middle
         if (round > free_rounds) now%sliding_speed = 0.5_wp*(now%sliding_speed + speed)
         now%load = balanced_load(model, position, moments, now%traction, now%rolling_resistance, now%sliding_speed)
         converged = abs(now%sliding_speed - speed) <= min(march%slip_tolerance, march%tolerance*march%largest_rolling) &
            & .and. abs(now%load - load) <= march%tolerance*march%largest_load
         if (converged) exit
         ! So may load and traction: with the shear of a pressure spike, either changes the other by more than its own change
         if (round > free_rounds) now%load = 0.5_wp*(now%load + load)
      end do
   end subroutine make_step

   !> Weights of now and before in a rate: backward differences.
   pure function rate_weights(speed, angle, before) result(weights)
      !> Cam speed [rad/s], angle [rad]
      real(wp), intent(in) :: speed, angle
      !> Moments before
      type(moment_t), intent(in) :: before(:)
      !> Weights of now, the last moment, the one before it [1/s]
      real(wp) :: weights(0:2)

      ! Length of the step and of that before [rad]; their ratio [-]
      real(wp) :: step, last_step, ratio

      step = angle - before(1)%angle
      weights = [1.0_wp, -1.0_wp, 0.0_wp]
      if (size(before) > 1) then
         last_step = before(1)%angle - before(2)%angle
         ratio = step/last_step
         weights = [(1.0_wp + 2.0_wp*ratio)/(1.0_wp + ratio), -1.0_wp - ratio, ratio**2/(1.0_wp + ratio)]
      end if
      weights = weights*speed/step
   end function rate_weights

   !> The contact as it is given.
   pure function contact_at(model, march, position, now) result(contact)
      !> The model
      type(model_t), intent(in) :: model
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> Geometry
      type(position_t), intent(in) :: position
      !> Its load, its sliding speed, its surfaces' temperature as far as it is known
      type(moment_t), intent(in) :: now
      !> The contact, under a load that scales the nodes
      type(ehl_contact_t) :: contact

      ! Speed of the cam's surface over the contact point [m/s]
      real(wp) :: surface_speed

      surface_speed = model%speed*position%surface_travel
      contact%line_load = max(now%load, least_load_of(march))/model%contact_width
      contact%radius = position%equivalent_radius
      contact%modulus = model%modulus
      contact%entrainment_speed = abs(entrainment_at(model, position, now%sliding_speed))
      contact%sliding_speed = now%sliding_speed
      contact%oil = model%oil
      if (model%shear_law == law_eyring) contact%eyring_stress = model%eyring_stress
      if (allocated(model%ehl)) then
         contact%is_compressible = model%ehl%compressible
         contact%has_flow_factors = model%ehl%flow_factors
         contact%thins_flow = model%ehl%shear_thinning
      end if
      if (allocated(model%boundary) .or. contact%has_flow_factors) contact%roughness = model%roughness
      if (allocated(model%boundary)) contact%asperity = model%boundary%constants
      if (march%is_warm .and. has_hot_contact(model)) then
         allocate (contact%heat)
         call set_heat(model, surface_speed, now%sliding_speed, now%films%asperity_rise, contact%heat)
      end if
   end function contact_at

   !> Entrainment speed that the film has: it keeps a least size where the roller's surface runs against the cam's.
   pure function entrainment_at(model, position, sliding_speed) result(entrainment)
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed
      !> Entrainment speed, in the cam's direction [m/s]
      real(wp) :: entrainment

      ! Speed of the cam's surface over the contact point [m/s]
      real(wp) :: surface_speed

      surface_speed = model%speed*position%surface_travel
      entrainment = surface_speed - 0.5_wp*sliding_speed
      entrainment = sign(max(abs(entrainment), least_entrainment*abs(surface_speed)), entrainment)
   end function entrainment_at

   !> Has the inlet of a film changed sides?
   pure function has_turned(now, before) result(turned)
      !> The contact, and a moment before
      type(moment_t), intent(in) :: now, before
      !> The answer; no where there was no film
      logical :: turned

      turned = now%has_film .and. before%has_film .and. now%entrainment*before%entrainment < 0.0_wp
   end function has_turned

   !> Film at a load and a sliding speed.
   subroutine find_film(model, march, position, before, rates, state, now, converged)
      !> The model
      type(model_t), intent(in) :: model
      !> What stays over the cycle
      type(ehl_march_t), intent(in) :: march
      !> Geometry
      type(position_t), intent(in) :: position
      !> Moments before
      type(moment_t), intent(in) :: before(:)
      !> Weights in the rates [1/s]
      real(wp), intent(in) :: rates(0:2)
      !> Pressure nearby, then the solution
      type(ehl_state_t), intent(inout) :: state
      !> The contact; film and friction are set
      type(moment_t), intent(inout) :: now
      !> Was a solution found?
      logical, intent(out) :: converged

      type(ehl_contact_t) :: contact
      type(ehl_problem_t) :: problem
      type(storage_t) :: storage
      ! Half width before, weighted as in the rate [m]
      real(wp) :: length
      integer :: status, k

      contact = contact_at(model, march, position, now)
      call new_ehl_problem(problem, contact, status)
      now%status = status
      converged = status == in_range
      if (.not. converged) return
      problem%keeps_cells = model%has_local_limit
      now%entrainment = entrainment_at(model, position, now%sliding_speed)
      now%length_scale = problem%length_scale
      now%pressure_scale = problem%pressure_scale
      now%film_scale = problem%film_scale
      now%has_film = now%load > lost_part*march%largest_load
      ! Nodes begin at the inlet: oil that was stored with the inlet on the other side has no place on them
      converged = .not. (march%is_transient .and. has_turned(now, before(1)))
      if (.not. converged) return
      if (.not. now%has_film) then
         now%films = ehl_films_t()
         return
      end if
      problem%load = 0.5_wp*pi*now%load/max(now%load, least_load_of(march))
      problem%expected_film = problem%expected_film*thickening(march, now%load)
      if (march%is_transient .and. all(before%has_film)) then
         storage%duration = contact%entrainment_speed/(rates(0)*problem%length_scale)
         allocate (storage%mass(march%grid%size), source=0.0_wp)
         length = 0.0_wp
         do k = 1, size(before)
            storage%mass = storage%mass - rates(k)/rates(0)*before(k)%mass
            length = length - rates(k)/rates(0)*before(k)%length_scale
         end do
         storage%mass = storage%mass/(problem%film_scale*problem%length_scale)
         storage%growth = 1.0_wp - length/problem%length_scale
         call solve_newton(problem, march%grid, state, march%tolerance, newton_iterations, converged, storage)
      else
         converged = .false.
         if (before(1)%has_film) call solve_newton(problem, march%grid, state, march%tolerance, newton_iterations, converged)
         if (converged) call warm_film(problem, march%grid, state, march%tolerance, converged)
         if (.not. converged) then
            call solve_cold(problem, march%grid, march%tolerance, state, converged)
            if (converged) call warm_film(problem, march%grid, state, march%tolerance, converged)
         end if
      end if
      if (.not. converged) return
      call get_films(problem, march%grid, state, now%films)
      now%mass = march%grid%weight*state%fields%density*state%fields%gap*problem%film_scale*problem%length_scale
   end subroutine find_film

   !> Sliding speed at which the roller's spin follows from film and load: rest where friction can hold the roller, else Newton's
   !> method inside a bracket.
   pure subroutine find_sliding_speed(model, position, before, rates, now)
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      type(moment_t), intent(in) :: before(:)
      !> Weights in the rates [1/s]
      real(wp), intent(in) :: rates(0:2)
      !> The contact; sliding speed and forces are set
      type(moment_t), intent(inout) :: now

      ! Bracket, its end away from rest, trial [m/s]; excess of the rate [m/s^2], its slope [1/s]; what the moments before add to
      ! the rate [m/s^2]
      real(wp) :: low, high, reach, speed, excess, slope, past
      integer :: iteration

      past = dot_product(rates(1:size(before)), before%sliding_speed)
      high = 10.0_wp*abs(rolling_speed_at(model, position))
      low = -high
      speed = now%sliding_speed
      ! With the law of rest in question the excess jumps there, so that rest is one end of the bracket unless it is the answer
      if (has_stick(model)) speed = 0.0_wp
      do iteration = 1, speed_iterations
         call spin_excess(model, position, now, speed, rates(0)*speed + past, excess, slope)
         slope = slope + rates(0)
         if (excess > 0.0_wp) high = min(high, speed)
         if (excess < 0.0_wp) low = max(low, speed)
         reach = high
         if (has_stick(model)) reach = max(high, -low)
         if (abs(excess) <= 1.0e-12_wp*abs(slope*reach) .or. high - low <= 1.0e-13_wp*reach) exit
         speed = speed - excess/slope
         if (speed <= low .or. speed >= high) speed = 0.5_wp*(low + high)
      end do
      now%sliding_speed = speed
      now%damping = (slope - rates(0))/model%speed
   end subroutine find_sliding_speed

   !> Rate of the sliding speed over what the roller's equation says, and its slope. Where friction may be anything up to a limit
   !> at rest, it is what comes next to no excess there.
   pure subroutine spin_excess(model, position, now, speed, rate, excess, slope)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry
      type(position_t), intent(in) :: position
      !> The contact; traction and rolling resistance are set
      type(moment_t), intent(inout) :: now
      !> Sliding speed [m/s]
      real(wp), intent(in) :: speed
      !> Its rate [m/s^2]
      real(wp), intent(in) :: rate
      !> Excess of the rate [m/s^2]
      real(wp), intent(out) :: excess
      !> Derivative over the sliding speed, without the rate's own [1/s]
      real(wp), intent(out) :: slope

      ! Slopes of the limited over the free shear and over the limit [-]; slopes of traction and rolling resistance [N s/m]; torque
      ! of the bearing [N m]
      real(wp) :: by_shear, by_limit, traction_slope, rolling_slope, torque
      ! Mobilised part of boundary friction [-]; excess over traction [1/kg]; friction that leaves no excess [N]
      real(wp) :: part, by_traction, holding
      type(boundary_friction_t) :: friction

      now%traction = 0.0_wp
      now%shear = 0.0_wp
      now%boundary_capacity = 0.0_wp
      now%rolling_resistance = 0.0_wp
      traction_slope = 0.0_wp
      rolling_slope = 0.0_wp
      torque = bearing_moment(model, position, now%load, speed)
      if (now%has_film) then
         if (model%rolling_law /= rolling_none) then
            ! Along its tangent through the film's own speed, as if in proportion, so that it changes its sign with the entrainment
            rolling_slope = -0.5_wp*now%films%rolling*model%contact_width/abs(now%entrainment)
            now%rolling_resistance = rolling_slope*(speed - 2.0_wp*model%speed*position%surface_travel)
         end if
         traction_slope = now%films%shear_slope*model%contact_width
         now%traction = traction_slope*speed
         if (model%has_local_limit) then
            call limit_cells(now%films%cells, model%cap, model%limiting_coefficient, model%limiting_stress, speed, now%traction, &
               & traction_slope)
            now%traction = now%traction*model%contact_width
            traction_slope = traction_slope*model%contact_width
         else
            call limit_shear(model%cap, model%limiting_coefficient*now%films%limit_part*now%load, now%traction, by_shear, by_limit)
            traction_slope = traction_slope*by_shear
         end if
         now%shear = now%traction
         if (allocated(model%boundary)) then
            call find_boundary_friction(model%boundary, speed, now%films%asperity_rise, 0.0_wp, friction)
            now%boundary_capacity = model%boundary%film_shear_strength*now%films%real_area*model%contact_width &
               & + friction%coefficient*now%films%asperity_share*now%load
            if (has_stick(model)) then
               part = sliding_direction(speed)
            else
               part = mobilised_share(speed, model%boundary%mobilising_speed)
               traction_slope = traction_slope + now%boundary_capacity*(1.0_wp - part)*(1.0_wp + part) &
                  & /model%boundary%mobilising_speed
            end if
            traction_slope = traction_slope + friction%by_speed*now%films%asperity_share*now%load*part
            now%traction = now%traction + now%boundary_capacity*part
         end if
      end if
      excess = rate - model%speed*rolling_speed_slope(model, position) + model%roller_radius*spin_acceleration(now%traction, &
         & merge(now%rolling_resistance, 0.0_wp, model%has_rolling_in_balance), model%roller_radius, torque, model%roller_inertia)
      by_traction = model%roller_radius**2/model%roller_inertia
      slope = by_traction*(traction_slope - merge(rolling_slope, 0.0_wp, model%has_rolling_in_balance))
      if (abs(speed) > 0.0_wp .or. .not. has_stick(model)) return
      holding = -excess/by_traction
      now%traction = now%traction + sign(min(abs(holding), now%boundary_capacity), holding)
      excess = sign(by_traction*max(0.0_wp, abs(holding) - now%boundary_capacity), excess)
   end subroutine spin_excess

end module camroller_ehl_step
