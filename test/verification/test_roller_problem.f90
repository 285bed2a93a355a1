!> A closed-form problem for the roller's spin, integrated twice round, against reference losses.
!>
!> test/reference/roller_problem_reference.py states the problem and solves it with Radau and LSODA; its load is blended and its
!> asperities are a power law, so that any program can set it up. The right-hand side here is put together from our kernels where
!> they are the same.
module test_roller_problem
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_lubricant, only : oil_t, mean_relative_viscosity, law_cameron
   use camroller_film, only : groups_t, film_shape_t, film_shape, law_dowson_higginson
   use camroller_traction, only : newtonian_shear, limit_shear, mobilised_share, rolling_resistance, cap_smooth, &
      rolling_goksem_hargreaves, same_lengths
   use camroller_needle, only : bearing_torque
   use camroller_roller, only : spin_acceleration
   use camroller_ode, only : problem_t, options_t, counters_t, integrate
   use camroller_ode_problem, only : words_length
   use camroller_ode_explicit, only : explicit_method_t, new_explicit_method
   use camroller_trajectory, only : trajectory_t
   use labelled_table, only : label_length, read_table
   use closeness, only : check_close
   use reference_cases, only : thesis_case, make_model
   implicit none
   private

   public :: collect_roller_problem

   !> The problem; state: roller spin [rad/s] and loss [J]
   type, extends(problem_t) :: roller_problem_t
      !> Mechanism, spring, masses and materials of the thesis
      type(model_t) :: model
      !> The oil
      type(oil_t) :: oil
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: name_time
   end type roller_problem_t

   !> Forces on the roller at one angle
   type :: forces_t
      !> Sliding speed [m/s], traction, rolling resistance [N], torque of the bearing [N m]
      real(wp) :: sliding_speed, traction, rolling, bearing
      !> Slope of the traction with the sliding speed at constant film [N s/m]
      real(wp) :: slope
   end type forces_t

   !> Lift over which the load is blended [m]
   real(wp), parameter :: blending_lift = 1.0e-4_wp

contains

   subroutine collect_roller_problem(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("dormand_prince reproduces the losses of the reference roller problem", test_dormand_prince) &
         ]
   end subroutine collect_roller_problem

   !> All cases of the table.
   subroutine test_dormand_prince(error)
      type(error_type), allocatable, intent(out) :: error
      ! The two references agree to 1e-9 [-]
      real(wp), parameter :: tolerance = 1.0e-9_wp
      character(len=label_length), allocatable :: names(:)
      real(wp), allocatable :: rows(:, :)
      real(wp) :: loss
      integer :: i

      call read_table("roller_problem_reference.csv", 4, rows, error, names)
      if (allocated(error)) return
      if (size(names) /= 3) call test_failed(error, "three cases are expected")
      do i = 1, size(names)
         if (allocated(error)) return
         call find_loss(rows(1, i), rows(2, i)*pi/30.0_wp, loss, error)
         if (allocated(error)) return
         call check_close(error, loss, rows(3, i), tolerance, "loss of case "//trim(names(i)))
      end do
   end subroutine test_dormand_prince

   !> Loss over two cycles.
   subroutine find_loss(viscosity, speed, loss, error)
      real(wp), intent(in) :: viscosity, speed
      real(wp), intent(out) :: loss
      type(error_type), allocatable, intent(out) :: error
      type(roller_problem_t) :: problem
      type(explicit_method_t) :: method
      type(options_t) :: options
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(position_t) :: position
      type(error_t), allocatable :: failure
      ! Stops [rad], state [rad/s, J]
      real(wp) :: stops(11), state(2)
      integer :: status

      call make_problem(problem, viscosity, speed, error)
      if (allocated(error)) return
      call evaluate_geometry(problem%model, -pi, position, status)
      state = [speed*position%rolling_travel/problem%model%roller_radius, 0.0_wp]
      call find_stops_of_problem(problem, stops)
      options%tolerance = [1.0e-9_wp*state(1), 1.0e-9_wp*0.1_wp]
      options%step = 1.0e-5_wp
      options%max_step = pi/90.0_wp
      call new_explicit_method(method, "dormand_prince", 2)
      call integrate(problem, method, options, stops, state, trajectory, counters, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      loss = state(2)
   end subroutine find_loss

   !> Mechanism of the thesis at a viscosity and a speed.
   subroutine make_problem(problem, viscosity, speed, error)
      type(roller_problem_t), intent(out) :: problem
      real(wp), intent(in) :: viscosity, speed
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case

      case = thesis_case()
      call make_model(case, problem%model, error)
      problem%model%speed = speed
      problem%oil%viscosity = viscosity
      problem%oil%pressure_viscosity = case%lubricant%pressure_viscosity
      problem%oil%pressure_law = law_cameron
   end subroutine make_problem

   !> Edges of the event and ends of the blending, twice round.
   subroutine find_stops_of_problem(problem, stops)
      type(roller_problem_t), intent(in) :: problem
      real(wp), intent(out) :: stops(11)
      ! Edge of the event, angle where the blending ends [rad]: 9.5 mm (1 - x^2)^4 = 0.1 mm
      real(wp) :: edge, blend

      edge = maxval(problem%model%lift_stops)
      blend = edge*sqrt(1.0_wp - (blending_lift/9.5e-3_wp)**0.25_wp)
      stops(:5) = [-pi, -edge, -blend, blend, edge]
      stops(6:10) = stops(:5) + two_pi
      stops(11) = 3.0_wp*pi
   end subroutine find_stops_of_problem

   !> Forces on the roller at a spin.
   subroutine evaluate_forces(problem, time, spin, forces)
      type(roller_problem_t), intent(in) :: problem
      real(wp), intent(in) :: time, spin
      type(forces_t), intent(out) :: forces
      type(position_t) :: position
      type(groups_t) :: groups
      type(film_shape_t) :: shape
      ! Load, its event part [N]; blending [-]; half width, films [m]; asperity load [N]; share of boundary friction [-]
      real(wp) :: load, event, blend, width, central, film_ratio, asperity_load, mobilised
      ! Area [m^2]; mean viscosity over that at ambient pressure, derivatives [-]
      real(wp) :: area, thickening, slopes(2)
      integer :: status

      associate (model => problem%model)
         call evaluate_geometry(model, time, position, status)
         event = ((model%train%stiffness*(position%lift + model%train%precompression) &
            + model%train%valve_mass*model%speed**2*position%lift_curvature)*position%valve_arm &
            + model%train%finger_inertia*model%speed**2*position%finger_curvature)/position%normal_arm
         blend = min(position%lift/blending_lift, 1.0_wp)
         load = max(64.0_wp + blend**2*(3.0_wp - 2.0_wp*blend)*(event - 64.0_wp), 0.0_wp)
         forces%sliding_speed = model%speed*position%rolling_travel - model%roller_radius*spin

         groups%speed = problem%oil%viscosity*max(abs(model%speed*position%surface_travel - 0.5_wp*forces%sliding_speed), &
            1.0e-6_wp)/(model%modulus*position%equivalent_radius)
         groups%material = problem%oil%pressure_viscosity*model%modulus
         groups%load = load/(model%modulus*position%equivalent_radius*model%contact_width)
         groups%roughness = 0.0_wp
         groups%hardness = 0.0_wp
         call film_shape(law_dowson_higginson, groups, shape)
         central = shape%central*position%equivalent_radius
         film_ratio = shape%minimum*position%equivalent_radius/model%roughness
         width = half_width(load, position%equivalent_radius, model%contact_width, model%modulus)
         area = 2.0_wp*width*model%contact_width
         asperity_load = 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*0.04_wp**2*0.1_wp*model%modulus*area*4.4086e-5_wp &
            *max(4.0_wp - film_ratio, 0.0_wp)**6.804_wp
         asperity_load = min(asperity_load, load)

         call mean_relative_viscosity(problem%oil, peak_pressure(load, position%equivalent_radius, model%contact_width, &
            model%modulus), thickening, slopes(1))
         forces%slope = newtonian_shear(1.0_wp, problem%oil%viscosity*thickening, area, central)
         forces%traction = forces%slope*forces%sliding_speed
         call limit_shear(cap_smooth, 0.08_wp*load, forces%traction, slopes(1), slopes(2))
         forces%slope = forces%slope*slopes(1)
         mobilised = mobilised_share(forces%sliding_speed, 0.01_wp)
         forces%traction = forces%traction + 0.2_wp*asperity_load*mobilised
         forces%slope = forces%slope + 0.2_wp*asperity_load*(1.0_wp - mobilised**2)/0.01_wp
         call rolling_resistance(rolling_goksem_hargreaves, groups%speed, groups%load, model%modulus, &
            position%equivalent_radius, same_lengths(model%contact_width), problem%oil%pressure_viscosity, forces%rolling, &
            slopes(1))
         forces%bearing = bearing_torque(0.0015_wp, load, model%bearing%radius, spin, 1.0_wp)
      end associate
   end subroutine evaluate_forces

   subroutine get_rate(self, time, state, rate, status)
      class(roller_problem_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status
      type(forces_t) :: forces

      status = 0
      call evaluate_forces(self, time, state(1), forces)
      rate(1) = spin_acceleration(forces%traction, forces%rolling, self%model%roller_radius, forces%bearing, &
         self%model%roller_inertia)
      rate(2) = forces%traction*forces%sliding_speed + forces%bearing*state(1)
      rate = rate/self%model%speed
   end subroutine get_rate

   subroutine get_decay_rate(self, time, state, decay_rate)
      class(roller_problem_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate
      type(forces_t) :: forces

      call evaluate_forces(self, time, state(1), forces)
      decay_rate = self%model%roller_radius**2*forces%slope/(self%model%roller_inertia*self%model%speed)
   end subroutine get_decay_rate

   function name_time(self, time) result(text)
      class(roller_problem_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text
      character(len=40) :: buffer

      write (buffer, "(a, f0.3, a, f0.1)") "angle ", time, " at ", self%model%speed
      text = trim(buffer)
   end function name_time

end module test_roller_problem
