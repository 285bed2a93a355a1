!> A closed-form problem for the spin of the roller: kinematics of the thesis, no load share, no feedback of friction on load.
!>
!> Stated in full in `test/reference/roller_problem_reference.py`. State: spin of the roller [rad/s] and energy lost [J].
module bench_roller_problem
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_ode_problem, only : problem_t, words_length
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
      procedure :: name_time
   end type roller_problem_t

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

      ! Sliding speed [m/s], traction [N], its slope [N s/m], rolling resistance [N], torque of the needles [N m]
      real(wp) :: sliding_speed, traction, slope, rolling, torque

      rate = 0.0_wp
      call forces(self, time, state(1), sliding_speed, traction, slope, rolling, torque, status)
      if (status /= 0) return
      rate(1) = ((traction - rolling)*roller_radius - torque)/(inertia*self%speed)
      rate(2) = (traction*sliding_speed + torque*state(1))/self%speed
   end subroutine get_rate

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

      ! Sliding speed [m/s], traction [N], its slope [N s/m], rolling resistance [N], torque of the needles [N m]
      real(wp) :: sliding_speed, traction, slope, rolling, torque
      integer :: status

      call forces(self, time, state(1), sliding_speed, traction, slope, rolling, torque, status)
      decay_rate = roller_radius**2*slope/(inertia*self%speed)
   end subroutine get_decay_rate

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
   pure subroutine forces(problem, angle, spin, sliding_speed, traction, slope, rolling, torque, status)
      !> The problem
      type(roller_problem_t), intent(in) :: problem
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> Sliding speed [m/s]
      real(wp), intent(out) :: sliding_speed
      !> Traction [N], its slope at constant film [N s/m]
      real(wp), intent(out) :: traction, slope
      !> Rolling resistance [N], torque of the needles [N m]
      real(wp), intent(out) :: rolling, torque
      !> 0 fine, negative: out of reach
      integer, intent(out) :: status

      type(position_t) :: position
      ! Load, asperity load, capped traction [N]; entrainment speed [m/s]; radius [m], E' [Pa]
      real(wp) :: load, asperity_load, limit, entrainment, radius, modulus
      ! Groups of the film laws [-]; films [m]; half width [m]; peak pressure times alpha/16 [-]; mobilised shares [-]
      real(wp) :: speed_group, load_group, film_min, film_central, half, peak, film_share, boundary_share

      sliding_speed = 0.0_wp
      traction = 0.0_wp
      slope = 0.0_wp
      rolling = 0.0_wp
      torque = 0.0_wp
      call evaluate_geometry(problem%model, angle, position, status)
      if (status /= 0) return
      modulus = problem%model%modulus
      radius = position%equivalent_radius
      load = load_at(position, problem%speed)
      sliding_speed = problem%speed*position%rolling_travel - roller_radius*spin
      entrainment = max(abs(problem%speed*position%surface_travel - 0.5_wp*sliding_speed), least_entrainment)

      speed_group = problem%viscosity*entrainment/(modulus*radius)
      load_group = load/(modulus*radius*width)
      film_min = 2.65_wp*radius*speed_group**0.70_wp*(alpha*modulus)**0.54_wp*load_group**(-0.13_wp)
      film_central = 3.06_wp*radius*speed_group**0.69_wp*(alpha*modulus)**0.56_wp*load_group**(-0.10_wp)
      half = half_width(load, radius, width, modulus)
      peak = alpha/16.0_wp*peak_pressure(load, radius, width, modulus)
      asperity_load = 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*0.04_wp**2*sqrt(0.01_wp)*modulus*2.0_wp*half*width &
         & *4.4086e-5_wp*max(4.0_wp - film_min/roughness, 0.0_wp)**6.804_wp
      asperity_load = min(asperity_load, load)

      limit = cap*load
      slope = problem%viscosity*width/film_central*half*sum(problem%weights*(1.0_wp + peak*problem%cosines)**16)
      film_share = tanh(slope*sliding_speed/limit)
      boundary_share = tanh(sliding_speed/mobilising_speed)
      traction = limit*film_share + boundary*asperity_load*boundary_share
      slope = slope*(1.0_wp - film_share**2) + boundary*asperity_load*(1.0_wp - boundary_share**2)/mobilising_speed
      rolling = 4.318_wp*(alpha*modulus*speed_group)**0.658_wp*load_group**0.0126_wp*width*radius/alpha
      torque = needle*load*needle_radius*tanh(spin)
   end subroutine forces

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
