!> A closed-form problem for the spin of the roller: kinematics of the thesis, no load share, no feedback of friction on load.
!>
!> Stated in full in `test/reference/roller_problem_reference.py`. State: spin of the roller [rad/s] and energy lost [J].
module bench_roller_problem
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_ode_problem, only : problem_t, linear_t, counters_t, words_length
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_quadrature, only : gauss_legendre
   implicit none
   private

   public :: roller_problem_t, new_roller_problem, roller_stops, pure_rolling_spin, sliding_speed_at

   !> Points of the rule over the pressure profile
   integer, parameter :: points = 16
   !> Contact length [m], composite roughness [m], pressure-viscosity coefficient [1/Pa]
   real(wp), parameter :: width = 0.0137_wp, roughness = 0.14e-6_wp*sqrt(2.0_wp), alpha = 2.2e-8_wp
   !> Spring: stiffness [N/m], precompression [m]; valve's mass [kg]; finger's inertia [kg m^2]; load of the adjuster [N]
   real(wp), parameter :: stiffness = 25000.0_wp, precompression = 0.0084_wp, valve_mass = 0.0432_wp, &
      & finger_inertia = 0.0418_wp*0.0355_wp**2, base_load = 64.0_wp
   !> Lift over which the load is blended [m]; half angle of the event [rad]; largest lift [m]
   real(wp), parameter :: blend_lift = 1.0e-4_wp, half_angle = 70.0_wp*degree, max_lift = 0.0095_wp
   !> Roller: outer and inner radius [m], inertia [kg m^2]; friction radius of the needles [m]
   real(wp), parameter :: roller_radius = 0.0085_wp, inner_radius = roller_radius - 0.0024_wp, &
      & inertia = 0.5_wp*0.0088_wp*(roller_radius**2 + inner_radius**2), needle_radius = inner_radius - 0.00099_wp
   !> Cap of the traction, boundary and needle friction [-]; speed that mobilises boundary friction [m/s]
   real(wp), parameter :: cap = 0.08_wp, boundary = 0.2_wp, needle = 0.0015_wp, mobilising_speed = 0.01_wp
   !> Smallest entrainment speed [m/s]
   real(wp), parameter :: least_entrainment = 1.0e-6_wp

   !> The problem
   type, extends(problem_t) :: roller_problem_t
      !> Kinematics are taken from here
      type(model_t), pointer :: model => null()
      !> Viscosity [Pa s], cam speed [rad/s]
      real(wp) :: viscosity = 0.0_wp, speed = 0.0_wp
      !> Rule over the profile: cosine of the angle, weight times cosine [-]
      real(wp) :: cosines(points) = 0.0_wp, weights(points) = 0.0_wp
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: linearise
      procedure :: name_time
   end type roller_problem_t

   !> Forces and torques on the roller, and all that their changes are made of
   type :: forces_t
      type(position_t) :: position
      !> Load, asperity load, traction, rolling resistance [N]; torque of the needles [N m]
      real(wp) :: load, asperity_load, traction, rolling, torque
      !> Sliding speed, entrainment speed with its sign [m/s]; slope of the film's shear before its cap [N s/m]
      real(wp) :: sliding_speed, entrainment, shear_slope
      !> Film over roughness; shares of the cap and of boundary friction; d ln(mean viscosity)/d ln(pressure) [-]
      real(wp) :: film_ratio, film_share, boundary_share, viscosity_slope
   end type forces_t

contains

   !> Make the problem from a model with the thesis's kinematics.
   subroutine new_roller_problem(problem, model, viscosity, speed)
      !> The problem
      type(roller_problem_t), intent(out) :: problem
      !> The model
      type(model_t), intent(in), target :: model
      !> Viscosity [Pa s]
      real(wp), intent(in) :: viscosity
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed

      ! Nodes and weights on [-1, 1] [-]
      real(wp) :: nodes(points), weights(points)

      call gauss_legendre(nodes, weights)
      problem%model => model
      problem%viscosity = viscosity
      problem%speed = speed
      problem%cosines = cos(0.5_wp*pi*nodes)
      problem%weights = 0.5_wp*pi*weights*problem%cosines
      problem%integrals = 1
      problem%small_state = [1.0e-3_wp*speed, 1.0e-3_wp]
   end subroutine new_roller_problem

   !> Rates of spin and loss over the cam angle.
   subroutine get_rate(self, time, state, rate, status)
      !> The problem
      class(roller_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Spin [rad/s], loss [J]
      real(wp), intent(in) :: state(:)
      !> Their rates [1/s], [J/rad]
      real(wp), intent(out) :: rate(:)
      !> 0 fine, negative: out of reach
      integer, intent(out) :: status

      type(forces_t) :: forces

      rate = 0.0_wp
      call evaluate_forces(self, time, state(1), forces, status)
      if (status == 0) rate = rates_of(self, forces, state(1))
   end subroutine get_rate

   !> Rates with their exact derivatives.
   subroutine linearise(self, time, state, horizon, linear, counters, status)
      !> The problem
      class(roller_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Spin [rad/s], loss [J]
      real(wp), intent(in) :: state(:)
      !> Cam angle up to which the right-hand side is smooth [rad]; not needed
      real(wp), intent(in) :: horizon
      !> Rates with their derivatives; has its room
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, negative: out of reach
      integer, intent(out) :: status

      type(forces_t) :: forces

      counters%evaluations = counters%evaluations + 1
      counters%jacobians = counters%jacobians + 1
      call evaluate_forces(self, time, state(1), forces, status)
      if (status /= 0) return
      linear%rate = rates_of(self, forces, state(1))
      linear%jacobian = 0.0_wp
      linear%jacobian(:, 1) = changes_of(self, forces, state(1), 1.0_wp, 0.0_wp)
      linear%time_slope = changes_of(self, forces, state(1), 0.0_wp, 1.0_wp) + 0.0_wp*horizon
   end subroutine linearise

   !> Decay rate of the spin at constant film.
   subroutine get_decay_rate(self, time, state, decay_rate)
      !> The problem
      class(roller_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> Spin [rad/s], loss [J]
      real(wp), intent(in) :: state(:)
      !> Decay rate [1/rad]
      real(wp), intent(out) :: decay_rate

      type(forces_t) :: forces
      integer :: status

      decay_rate = 0.0_wp
      call evaluate_forces(self, time, state(1), forces, status)
      if (status /= 0) return
      decay_rate = roller_radius**2/(inertia*self%speed)*(forces%shear_slope*(1.0_wp - forces%film_share**2) &
         & + boundary*forces%asperity_load*(1.0_wp - forces%boundary_share**2)/mobilising_speed)
   end subroutine get_decay_rate

   !> Rates that forces make.
   pure function rates_of(problem, forces, spin) result(rate)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Forces
      type(forces_t), intent(in) :: forces
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> Rates of spin and loss [1/s], [J/rad]
      real(wp) :: rate(2)

      rate(1) = ((forces%traction - forces%rolling)*roller_radius - forces%torque)/(inertia*problem%speed)
      rate(2) = (forces%traction*forces%sliding_speed + forces%torque*spin)/problem%speed
   end function rates_of

   !> Changes of the rates with spin and cam angle.
   pure function changes_of(problem, forces, spin, by_spin, by_angle) result(change)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Forces
      type(forces_t), intent(in) :: forces
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> Changes of spin [rad/s] and cam angle [rad]
      real(wp), intent(in) :: by_spin, by_angle
      !> Changes of the rates [1/s], [J/rad]
      real(wp) :: change(2)

      ! Changes of radius, load, speed group and films, logarithms [-]; of sliding speed and entrainment [m/s]
      real(wp) :: radius, load, speed_group, film_min, film_central, sliding, entrainment
      ! Changes of half width, asperity load and shear slope, logarithms [-]; of traction, rolling [N], torque [N m], the cap's
      ! argument [-]
      real(wp) :: half, asperity, shear, traction, rolling, torque, argument

      radius = by_angle*forces%position%radius_slope/forces%position%equivalent_radius
      load = by_angle*load_slope(forces%position, problem%speed)/forces%load
      sliding = problem%speed*forces%position%rolling_travel_slope*by_angle - roller_radius*by_spin
      entrainment = problem%speed*forces%position%surface_travel_slope*by_angle - 0.5_wp*sliding
      if (abs(forces%entrainment) <= least_entrainment) entrainment = 0.0_wp
      speed_group = entrainment/forces%entrainment - radius
      film_min = radius + 0.70_wp*speed_group - 0.13_wp*(load - radius)
      film_central = radius + 0.69_wp*speed_group - 0.10_wp*(load - radius)
      half = 0.5_wp*(load + radius)
      asperity = half
      if (forces%film_ratio < 4.0_wp) asperity = half - 6.804_wp*forces%film_ratio/(4.0_wp - forces%film_ratio)*film_min
      if (forces%asperity_load >= forces%load) asperity = load
      shear = half - film_central + forces%viscosity_slope*0.5_wp*(load - radius)

      argument = forces%shear_slope/(cap*forces%load)*(sliding + forces%sliding_speed*(shear - load))
      traction = cap*forces%load*(load*forces%film_share + (1.0_wp - forces%film_share**2)*argument) &
         & + boundary*forces%asperity_load*(asperity*forces%boundary_share &
         & + (1.0_wp - forces%boundary_share**2)*sliding/mobilising_speed)
      rolling = forces%rolling*(0.658_wp*speed_group + 0.0126_wp*(load - radius) + radius)
      torque = forces%torque*load + needle*forces%load*needle_radius*(1.0_wp - tanh(spin)**2)*by_spin
      change(1) = ((traction - rolling)*roller_radius - torque)/(inertia*problem%speed)
      change(2) = (traction*forces%sliding_speed + forces%traction*sliding + torque*spin + forces%torque*by_spin)/problem%speed
   end function changes_of

   !> A cam angle in words.
   function name_time(self, time) result(text)
      !> The problem
      class(roller_problem_t), intent(in) :: self
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: time
      !> It in words
      character(len=words_length) :: text

      character(len=40) :: buffer

      write (buffer, "(f0.3, a, es9.2, a)") time/degree, " deg at ", self%viscosity, " Pa s"
      text = trim(buffer)
   end function name_time

   !> Forces and torques on the roller.
   pure subroutine evaluate_forces(problem, angle, spin, forces, status)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> Forces
      type(forces_t), intent(out) :: forces
      !> 0 fine, negative: out of reach
      integer, intent(out) :: status

      ! Radius [m], E' [Pa], entrainment speed, its size [m/s]
      real(wp) :: radius, modulus, entrainment
      ! Groups of the film laws [-]; films [m]; half width [m]; peak pressure times alpha/16 [-]
      real(wp) :: speed_group, load_group, film_min, film_central, half, peak
      ! Viscosity over the profile, to the power 15 of its base [-]
      real(wp) :: powers(points), mean

      call evaluate_geometry(problem%model, angle, forces%position, status)
      if (status /= 0) return
      modulus = problem%model%modulus
      radius = forces%position%equivalent_radius
      forces%load = load_at(forces%position, problem%speed)
      forces%sliding_speed = problem%speed*forces%position%rolling_travel - roller_radius*spin
      forces%entrainment = problem%speed*forces%position%surface_travel - 0.5_wp*forces%sliding_speed
      if (abs(forces%entrainment) < least_entrainment) forces%entrainment = least_entrainment
      entrainment = abs(forces%entrainment)

      speed_group = problem%viscosity*entrainment/(modulus*radius)
      load_group = forces%load/(modulus*radius*width)
      film_min = 2.65_wp*radius*speed_group**0.70_wp*(alpha*modulus)**0.54_wp*load_group**(-0.13_wp)
      film_central = 3.06_wp*radius*speed_group**0.69_wp*(alpha*modulus)**0.56_wp*load_group**(-0.10_wp)
      forces%film_ratio = film_min/roughness
      half = half_width(forces%load, radius, width, modulus)
      peak = alpha/16.0_wp*peak_pressure(forces%load, radius, width, modulus)
      forces%asperity_load = 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*0.04_wp**2*sqrt(0.01_wp)*modulus*2.0_wp*half*width &
         & *4.4086e-5_wp*max(4.0_wp - forces%film_ratio, 0.0_wp)**6.804_wp
      forces%asperity_load = min(forces%asperity_load, forces%load)

      powers = (1.0_wp + peak*problem%cosines)**15
      mean = sum(problem%weights*powers*(1.0_wp + peak*problem%cosines))
      forces%viscosity_slope = 16.0_wp*peak*sum(problem%weights*powers*problem%cosines)/mean
      forces%shear_slope = problem%viscosity*width/film_central*half*mean
      forces%film_share = tanh(forces%shear_slope*forces%sliding_speed/(cap*forces%load))
      forces%boundary_share = tanh(forces%sliding_speed/mobilising_speed)
      forces%traction = cap*forces%load*forces%film_share + boundary*forces%asperity_load*forces%boundary_share
      forces%rolling = 4.318_wp*(alpha*modulus*speed_group)**0.658_wp*load_group**0.0126_wp*width*radius/alpha
      forces%torque = needle*forces%load*needle_radius*tanh(spin)
   end subroutine evaluate_forces

   !> Contact load, blended from the adjuster's into that of the event.
   pure function load_at(position, speed) result(load)
      !> Geometry
      type(position_t), intent(in) :: position
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Load [N]
      real(wp) :: load

      ! Load of the event [N], share of it [-]
      real(wp) :: event, share

      event = ((stiffness*(position%lift + precompression) + valve_mass*speed**2*position%lift_curvature)*position%valve_arm &
         & + finger_inertia*speed**2*position%finger_curvature)/position%normal_arm
      share = min(position%lift/blend_lift, 1.0_wp)
      load = max(base_load + share**2*(3.0_wp - 2.0_wp*share)*(event - base_load), 0.0_wp)
   end function load_at

   !> Its derivative over the cam angle.
   pure function load_slope(position, speed) result(slope)
      !> Geometry
      type(position_t), intent(in) :: position
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Derivative [N/rad]
      real(wp) :: slope

      ! Force at the valve [N], load of the event [N] and their derivatives [N/rad]; share of the event's load and its
      ! derivative [-]
      real(wp) :: force, force_slope, event, event_slope, share, share_slope

      force = stiffness*(position%lift + precompression) + valve_mass*speed**2*position%lift_curvature
      force_slope = stiffness*position%lift_slope + valve_mass*speed**2*position%lift_jerk
      event = (force*position%valve_arm + finger_inertia*speed**2*position%finger_curvature)/position%normal_arm
      event_slope = (force_slope*position%valve_arm + force*position%valve_arm_slope &
         & + finger_inertia*speed**2*position%finger_jerk - event*position%normal_arm_slope)/position%normal_arm
      share = min(position%lift/blend_lift, 1.0_wp)
      share_slope = 0.0_wp
      if (share < 1.0_wp) share_slope = 6.0_wp*share*(1.0_wp - share)*position%lift_slope/blend_lift
      slope = share_slope*(event - base_load) + share**2*(3.0_wp - 2.0_wp*share)*event_slope
   end function load_slope

   !> Stops of two turns from -180 deg: edges of the event and of the blending.
   pure function roller_stops() result(stops)
      !> Cam angles [rad]
      real(wp) :: stops(10)

      ! Angle where the blending ends [rad]
      real(wp) :: blend

      blend = half_angle*sqrt(1.0_wp - (blend_lift/max_lift)**0.25_wp)
      stops = [-pi, -half_angle, -blend, blend, half_angle, &
         & two_pi - half_angle, two_pi - blend, two_pi + blend, two_pi + half_angle, 3.0_wp*pi]
   end function roller_stops

   !> Spin in pure rolling.
   function pure_rolling_spin(problem, angle) result(spin)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Spin [rad/s]
      real(wp) :: spin

      spin = sliding_speed_at(problem, angle, 0.0_wp)/roller_radius
   end function pure_rolling_spin

   !> Sliding speed for a spin.
   function sliding_speed_at(problem, angle, spin) result(sliding_speed)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Spin [rad/s]
      real(wp), intent(in) :: spin
      !> Sliding speed [m/s]
      real(wp) :: sliding_speed

      type(position_t) :: position
      integer :: status

      call evaluate_geometry(problem%model, angle, position, status)
      sliding_speed = problem%speed*position%rolling_travel - roller_radius*spin
   end function sliding_speed_at

end module bench_roller_problem
