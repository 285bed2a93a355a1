!> Kernels of the valve train and of the bearings in other units: the result must be the same quantity.
module test_unit_rescaling_train
   use testdrive, only : unittest_type, new_unittest, error_type
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_kinematics, only : mechanism_t, linkage_t, position_t, rotation_names, new_linkage, &
      & evaluate_position
   use camroller_dynamics, only : train_t, moments_t, gas_force_t, seat_force, unseated_share, evaluate_moments, &
      & stored_energy, stored_power
   use camroller_gas, only : gas_law_t, new_gas_law, gas_force
   use camroller_needle, only : needle_bearing_t, friction_radius, bearing_torque
   use camroller_guide, only : guide_drag_coefficient
   use camroller_roller, only : ring_inertia, spin_acceleration
   use camroller_torque, only : cam_torque, contact_power, normal_direction
   use camroller_journal, only : journal_law_names, journal_at_speed
   use camroller_bearing_asperity, only : bearing_state_t, carry_load
   use camroller_bearing_loads, only : bearing_shares
   use camroller_lift, only : lift_t, lift_law_t, lift_law_names, new_lift_law, evaluate_lift
   use camroller_spline, only : spline_t, new_clamped_spline, evaluate_spline
   use unit_systems, only : units_t, systems => unit_systems_tried, scaled, compare, number, angular_speed, length, &
      & area, speed, mass, inertia, force, torque, power, stiffness, pressure, viscosity, per_length, drag, &
      & angular_acceleration, energy
   implicit none
   private

   public :: collect_unit_rescaling_train

   !> A contact at the nose [N], [m], [m], [Pa s], [m/s]
   real(wp), parameter :: load = 741.0_wp, radius = 4.116e-3_wp, width = 13.7e-3_wp, eta = 0.0305_wp, sliding = 3.1e-3_wp

contains

   subroutine collect_unit_rescaling_train(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("lift laws scale with the units", test_lift_laws), &
         new_unittest("interpolating and smoothing splines scale with the units", test_splines), &
         new_unittest("kinematics scale with the units", test_kinematics), &
         new_unittest("moments, energy and power of the train scale with the units", test_dynamics), &
         new_unittest("the gas force scales with the units", test_gas), &
         new_unittest("roller, roller bearing and valve guide scale with the units", test_small_kernels), &
         new_unittest("torque and power of the contact scale with the units", test_torque), &
         new_unittest("journal bearings scale with the units, for every law", test_journals), &
         new_unittest("forces on the camshaft bearings scale with the units", test_camshaft) &
         ]
   end subroutine collect_unit_rescaling_train

   !> A lift, in any units
   function sample_lift(law, units) result(lift)
      !> Name of the law
      character(len=*), intent(in) :: law
      !> The system
      type(units_t), intent(in) :: units
      type(lift_t) :: lift
      integer :: k

      lift%law = law
      lift%max_lift = scaled(units, 9.5e-3_wp, length)
      lift%opening_half_angle = 70.0_wp*degree
      lift%closing_half_angle = 70.0_wp*degree
      if (law == "power") lift%exponents = [4]
      if (law == "polydyne") lift%exponents = [6, 8, 10, 12]
      if (law == "segments") then
         lift%segment_angles = [0.0_wp, 0.1_wp, 0.4_wp, 0.7_wp, 1.2_wp, 1.7_wp, 2.1_wp]
         lift%segment_accelerations = [0.0_wp, 1.0_wp, 1.2_wp, -0.7_wp, -0.5_wp, 0.8_wp, 0.0_wp]
      end if
      if (law == "table") then
         lift%table_angle = [(0.05_wp*real(k, wp), k=-20, 20)]
         lift%table_lift = scaled(units, 9.5e-3_wp*(1.0_wp - lift%table_angle**2)**4, length)
         lift%table_lift([1, 41]) = 0.0_wp
      end if
   end function sample_lift

   subroutine test_lift_laws(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lift_law_t) :: law, law_in_units
      real(wp) :: f(0:3), g(0:3)
      integer :: i, k, which

      do i = 1, size(systems)
         do which = 1, size(lift_law_names)
            call new_lift_law(law, sample_lift(lift_law_names(which), units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp)), failure)
            call new_lift_law(law_in_units, sample_lift(lift_law_names(which), systems(i)), failure)
            do k = -6, 6
               call evaluate_lift(law, 0.2_wp*real(k, wp), f)
               call evaluate_lift(law_in_units, 0.2_wp*real(k, wp), g)
               call compare(error, lift_law_names(which), systems(i), length, f, g)
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_lift_laws

   subroutine test_splines(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(spline_t) :: spline, spline_in_units
      real(wp) :: x(41), y(41), f(0:3), g(0:3), smoothing
      integer :: i, k, kind_of_fit
      type(units_t) :: u

      x = [(0.05_wp*real(k, wp), k=-20, 20)]
      y = (1.0_wp - x**2)**4 + 1.0e-3_wp*[(sin(real(k*k, wp)), k=1, 41)]
      do i = 1, size(systems)
         u = systems(i)
         do kind_of_fit = 0, 1
            smoothing = 5.0e-4_wp*kind_of_fit
            call new_clamped_spline(spline, x, y, [1.0_wp, 2.0_wp], [3.0_wp, 4.0_wp], smoothing, failure)
            ! points are lengths, values are forces
            call new_clamped_spline(spline_in_units, scaled(u, x, length), scaled(u, y, force), &
               & [scaled(u, 1.0_wp, force), scaled(u, 2.0_wp, force)]/scaled(u, 1.0_wp, length)**[1, 2], &
               & [scaled(u, 3.0_wp, force), scaled(u, 4.0_wp, force)]/scaled(u, 1.0_wp, length)**[1, 2], &
               & scaled(u, smoothing, force), failure)
            do k = -9, 9
               call evaluate_spline(spline, 0.11_wp*real(k, wp), f)
               call evaluate_spline(spline_in_units, scaled(u, 0.11_wp*real(k, wp), length), g)
               call compare(error, "spline", u, force, f, g*scaled(u, 1.0_wp, length)**[0, 1, 2, 3])
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_splines

   !> Geometry at a lift, in any units
   subroutine sample_position(rotation, units, position)
      !> Sense of rotation
      character(len=*), intent(in) :: rotation
      !> The system
      type(units_t), intent(in) :: units
      type(position_t), intent(out) :: position
      type(error_t), allocatable :: failure
      type(linkage_t) :: linkage
      integer :: status

      call new_linkage(linkage, mechanism_t(scaled(units, 20.8e-3_wp, length), scaled(units, 35.5e-3_wp, length), &
         & scaled(units, 31.5e-3_wp, length), -3.5_wp*degree, 37.5_wp*degree, scaled(units, 18.0e-3_wp, length), &
         & scaled(units, 8.5e-3_wp, length), scaled(units, width, length), rotation=rotation), failure)
      call evaluate_position(linkage, scaled(units, [4.0e-3_wp, -9.0e-3_wp, 2.0e-3_wp, 0.05_wp], length), &
         position, status)
      if (allocated(failure) .or. status /= 0) error stop "a valid mechanism is refused"
   end subroutine sample_position

   subroutine test_kinematics(error)
      type(error_type), allocatable, intent(out) :: error
      type(position_t) :: p, q
      type(units_t) :: u
      integer :: i, sense

      do i = 1, size(systems)
         u = systems(i)
         do sense = 1, 2
            call sample_position(rotation_names(sense), units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), p)
            call sample_position(rotation_names(sense), u, q)
            call compare(error, "angles", u, number, [p%arm_angle, p%finger_slope, p%finger_curvature], &
               & [q%arm_angle, q%finger_slope, q%finger_curvature])
            if (allocated(error)) return
            call compare(error, "lift and arms", u, length, lengths_of(p), lengths_of(q))
            if (allocated(error)) return
            call compare(error, "curvature of the pitch curve", u, per_length, [p%pitch_curvature], [q%pitch_curvature])
            if (allocated(error)) return
         end do
      end do
   end subroutine test_kinematics

   !> All that is a length, or a length per angle
   pure function lengths_of(p) result(lengths)
      type(position_t), intent(in) :: p
      !> The lengths [m]
      real(wp), allocatable :: lengths(:)

      lengths = [p%lift, p%lift_slope, p%lift_curvature, p%valve_arm, p%normal_arm, p%parallel_arm, p%tangent_arm, &
         p%cam_arm, &
         & p%equivalent_radius, p%surface_travel, p%surface_travel_slope, p%rolling_travel, p%rolling_travel_slope]
   end function lengths_of

   subroutine test_dynamics(error)
      type(error_type), allocatable, intent(out) :: error
      type(train_t) :: train, train_in_units
      type(position_t) :: p, q
      type(moments_t) :: m, n
      type(units_t) :: u
      ! Cam speed [rad/s], gas force [N], lift that leaves the seat half unloaded [m]
      real(wp), parameter :: omega = 63.0_wp, gas = 150.0_wp, small_lift = 1.1e-5_wp
      integer :: i

      train = train_t(0.0432_wp, 3.3e-5_wp, 25.0e3_wp, 8.4e-3_wp, 172.0_wp, 3.44e-5_wp)
      do i = 1, size(systems)
         u = systems(i)
         train_in_units = train_t(scaled(u, train%valve_mass, mass), scaled(u, train%finger_inertia, inertia), &
            & scaled(u, train%stiffness, stiffness), scaled(u, train%precompression, length), &
            & scaled(u, train%closed_seat_force, force), scaled(u, train%seat_lift, length))
         call sample_position("away_from_pivot", units_t(1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp), p)
         call sample_position("away_from_pivot", u, q)
         p%lift = small_lift
         q%lift = scaled(u, small_lift, length)
         call compare(error, "seat force", u, force, [seat_force(train, p%lift)], [seat_force(train_in_units, q%lift)])
         if (allocated(error)) return
         call compare(error, "unseated share", u, number, [unseated_share(train, p%lift)], &
            [unseated_share(train_in_units, q%lift)])
         if (allocated(error)) return
         call evaluate_moments(train, p, omega, gas, m)
         call evaluate_moments(train_in_units, q, scaled(u, omega, angular_speed), scaled(u, gas, force), n)
         call compare(error, "moments", u, torque, [m%spring, m%seat, m%valve, m%finger, m%gas, m%total], &
            & [n%spring, n%seat, n%valve, n%finger, n%gas, n%total])
         if (allocated(error)) return
         call compare(error, "stored energy", u, energy, [stored_energy(train, p, omega)], &
            & [stored_energy(train_in_units, q, scaled(u, omega, angular_speed))])
         if (allocated(error)) return
         call compare(error, "stored power", u, power, [stored_power(train, p, omega, gas)], &
            & [stored_power(train_in_units, q, scaled(u, omega, angular_speed), scaled(u, gas, force))])
         if (allocated(error)) return
      end do
   end subroutine test_dynamics

   subroutine test_gas(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(gas_law_t) :: law, law_in_units
      type(gas_force_t) :: gas, gas_in_units
      integer :: i, k

      gas%angle = [(10.0_wp*degree*real(k, wp), k=-18, 18)]
      gas%pressure = 2.0e5_wp*exp(cos(gas%angle))
      gas%valve_area = 8.0e-4_wp
      call new_gas_law(law, gas, failure)
      do i = 1, size(systems)
         gas_in_units = gas_force_t(gas%angle, scaled(systems(i), gas%pressure, pressure), scaled(systems(i), &
            8.0e-4_wp, area))
         call new_gas_law(law_in_units, gas_in_units, failure)
         do k = -5, 5
            call compare(error, "gas force", systems(i), force, [gas_force(law, real(k, wp))], &
               [gas_force(law_in_units, real(k, wp))])
            if (allocated(error)) return
         end do
      end do
   end subroutine test_gas

   subroutine test_small_kernels(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t) :: u
      integer :: i

      do i = 1, size(systems)
         u = systems(i)
         call compare(error, "friction radius", u, length, &
            & [friction_radius(needle_bearing_t("needles", 0.0015_wp, 0.9e-3_wp), 6.0e-3_wp)], &
            & [friction_radius(needle_bearing_t("needles", 0.0015_wp, scaled(u, 0.9e-3_wp, length)), scaled(u, &
            6.0e-3_wp, length))])
         if (allocated(error)) return
         call compare(error, "bearing torque", u, torque, [bearing_torque(0.0015_wp, load, 5.1e-3_wp, 1.3_wp, &
            0.9_wp)], &
            & [bearing_torque(0.0015_wp, scaled(u, load, force), scaled(u, 5.1e-3_wp, length), scaled(u, 1.3_wp, &
            angular_speed), &
            & scaled(u, 0.9_wp, angular_speed))])
         if (allocated(error)) return
         call compare(error, "guide drag", u, drag, [guide_drag_coefficient(eta, 0.05_wp, 6.0e-3_wp, 2.0e-5_wp)], &
            & [guide_drag_coefficient(scaled(u, eta, viscosity), scaled(u, 0.05_wp, length), scaled(u, 6.0e-3_wp, &
            length), &
            & scaled(u, 2.0e-5_wp, length))])
         if (allocated(error)) return
         call compare(error, "ring inertia", u, inertia, [ring_inertia(8.9e-3_wp, 8.5e-3_wp, 6.0e-3_wp)], &
            & [ring_inertia(scaled(u, 8.9e-3_wp, mass), scaled(u, 8.5e-3_wp, length), scaled(u, 6.0e-3_wp, length))])
         if (allocated(error)) return
         call compare(error, "spin acceleration", u, angular_acceleration, &
            & [spin_acceleration(5.0_wp, 0.7_wp, 8.5e-3_wp, 1.0e-3_wp, 4.8e-7_wp)], &
            & [spin_acceleration(scaled(u, 5.0_wp, force), scaled(u, 0.7_wp, force), scaled(u, 8.5e-3_wp, length), &
            & scaled(u, 1.0e-3_wp, torque), scaled(u, 4.8e-7_wp, inertia))])
         if (allocated(error)) return
      end do
   end subroutine test_small_kernels

   subroutine test_torque(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t) :: u
      real(wp) :: normal(2), tangent(2), normal_in_units(2), tangent_in_units(2)
      integer :: i

      do i = 1, size(systems)
         u = systems(i)
         call compare(error, "cam torque", u, torque, [cam_torque(load, 0.02_wp, 0.3_wp, 12.0_wp, 0.018_wp, &
            0.7_wp, radius)], &
            & [cam_torque(scaled(u, load, force), scaled(u, 0.02_wp, length), 0.3_wp, scaled(u, 12.0_wp, force), &
            & scaled(u, 0.018_wp, length), scaled(u, 0.7_wp, force), scaled(u, radius, length))])
         if (allocated(error)) return
         call compare(error, "contact power", u, power, [contact_power(12.0_wp, sliding, 0.7_wp, 0.5_wp, 0.49_wp)], &
            & [contact_power(scaled(u, 12.0_wp, force), scaled(u, sliding, speed), scaled(u, 0.7_wp, force), &
            & scaled(u, 0.5_wp, speed), scaled(u, 0.49_wp, speed))])
         if (allocated(error)) return
         call normal_direction(0.018_wp, 0.0104_wp, 0.0208_wp, 1.1_wp, -1.0_wp, normal, tangent)
         call normal_direction(scaled(u, 0.018_wp, length), scaled(u, 0.0104_wp, length), scaled(u, 0.0208_wp, &
            length), 1.1_wp, &
            & -1.0_wp, normal_in_units, tangent_in_units)
         call compare(error, "directions", u, number, [normal, tangent], [normal_in_units, tangent_in_units])
         if (allocated(error)) return
      end do
   end subroutine test_torque

   subroutine test_journals(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t) :: u
      type(bearing_state_t) :: state, state_in_units
      integer :: i, law, status

      do i = 1, size(systems)
         u = systems(i)
         do law = 1, size(journal_law_names)
            call carry_load(journal_at_speed(law, 0.026_wp, 0.018_wp, 5.0e-5_wp, eta, 63.0_wp), [load, 0.0_wp], state, status)
            call carry_load(journal_at_speed(law, scaled(u, 0.026_wp, length), scaled(u, 0.018_wp, length), &
               & scaled(u, 5.0e-5_wp, length), scaled(u, eta, viscosity), scaled(u, 63.0_wp, angular_speed)), &
               & [scaled(u, load, force), 0.0_wp], state_in_units, status)
            call compare(error, journal_law_names(law), u, torque, [state%torque], [state_in_units%torque])
            if (allocated(error)) return
            call compare(error, "eccentricity", u, number, [state%eccentricity], [state_in_units%eccentricity])
            if (allocated(error)) return
         end do
      end do
   end subroutine test_journals

   subroutine test_camshaft(error)
      type(error_type), allocatable, intent(out) :: error
      type(units_t) :: u
      real(wp), parameter :: bearings(3) = [0.0_wp, 0.09_wp, 0.2_wp], cams(2) = [0.04_wp, 0.15_wp]
      real(wp) :: places(2)
      integer :: cam, i

      do i = 1, size(systems)
         u = systems(i)
         places = scaled(u, cams, length)
         do cam = 1, size(cams)
            call compare(error, "bearing loads", u, number, bearing_shares(bearings, cams(cam)), &
               & bearing_shares(scaled(u, bearings, length), places(cam)))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_camshaft

end module test_unit_rescaling_train
