!> Kernels of a flexible train against closed forms.
module test_flexible_parts
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_case, only : case_t
   use camroller_error, only : error_t, kind_deck
   use camroller_flexible_setup, only : find_rest, rest_t
   use camroller_flexible_train, only : evaluate_train, flexible_state_t, resolution_t, state_size
   use camroller_kinds, only : pi, two_pi, wp
   use camroller_model, only : model_t, new_model
   use camroller_traction, only : rolling_resistance, same_lengths
   use camroller_contact_compliance, only : line_compliance, series_load, series_energy, one_sided_force, restitution, &
      & damping_of_restitution
   use camroller_spring_modes, only : spring_surge_t, spring_modes_t, new_spring_modes, effective_mass, &
      & wave_compression
   use camroller_lash_adjuster, only : lash_adjuster_t, adjuster_t, flows_t, leak_end_names, new_adjuster, set_adjuster_oil, &
      & bulk_modulus, relative_volume, pressure_work, evaluate_flows, adjuster_force
   use camroller_quadrature, only : gauss_legendre
   use closeness, only : check_close, check_scaled, expect_error, expect_success, has_failed
   use flexible_cases, only : add_dynamics
   use reference_cases, only : make_model, point_speeds, set_point, thesis_case
   implicit none
   private

   public :: collect_flexible_parts

contains

   subroutine collect_flexible_parts(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("approach of a line contact with a spring in series, and its inverse", test_series), &
         new_unittest("energy of that contact is the integral of its load over the approach", test_series_energy), &
         new_unittest("restitution of a damping proportional to the force agrees with the closed form", test_restitution), &
         new_unittest("a body leaves a damped contact at the speed of the closed form", test_impact), &
         new_unittest("modes of a spring, alone and with a mass at its end", test_modes), &
         new_unittest("what waves add to the compression of coils is the largest slope of their shape", test_waves), &
         new_unittest("bulk modulus of oil that contains air", test_bulk_modulus), &
         new_unittest("derivatives of an adjuster's flows and compression work agree with difference quotients", test_flows), &
         new_unittest("rolling resistance of a train under load is that of its law, and stays below a load of nothing", &
            & test_rolling), &
         new_unittest("leak-down time of an adjuster agrees with the reference", test_leak_down), &
         new_unittest("a seat into which the valve sinks by a part of the second lift alone is refused", test_soft_seat) &
         ]
   end subroutine collect_flexible_parts

   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      ! Compliance [m/N^0.9], load and approach by Palmgren [N], [m], their slopes [N/m]
      real(wp) :: compliance, load, approach, slope, low, high, h
      integer :: i

      ! E' of cast iron on steel, 13.7 mm: 1.91 um at 700 N
      compliance = line_compliance(201.8e9_wp, 13.7e-3_wp)
      call check_close(error, compliance, 5.2465e-9_wp, 2.0e-4_wp, "compliance")
      if (allocated(error)) return
      call check_close(error, compliance*700.0_wp**0.9_wp, 1.91e-6_wp, 5.0e-3_wp, "approach at 700 N")
      if (allocated(error)) return
      do i = -12, 6
         approach = compliance*(10.0_wp**i)**0.9_wp + 10.0_wp**i/5.0e7_wp
         call series_load(compliance, 5.0e7_wp, approach, load, slope)
         call check_close(error, load, 10.0_wp**i, 1.0e-13_wp, "load of its approach")
         if (allocated(error)) return
         h = 1.0e-5_wp*approach
         call series_load(compliance, 5.0e7_wp, approach - h, low, load)
         call series_load(compliance, 5.0e7_wp, approach + h, high, load)
         call check_close(error, slope, (high - low)/(2.0_wp*h), 1.0e-9_wp, "stiffness")
         if (allocated(error)) return
      end do
      call series_load(compliance, 5.0e7_wp, 0.0_wp, load, slope)
      call check(error, abs(load) + abs(slope) <= 0.0_wp, "a gap carries load")
   end subroutine test_series

   subroutine test_series_energy(error)
      type(error_type), allocatable, intent(out) :: error
      ! Places and weights of a rule on [-1, 1] [-], load [N], stiffness [N/m], energy [J]
      real(wp) :: nodes(40), weights(40), load, slope, energy
      integer :: i

      call gauss_legendre(nodes, weights)
      energy = 0.0_wp
      do i = 1, 40
         call series_load(5.2e-9_wp, 5.0e7_wp, 1.0e-5_wp*(1.0_wp + nodes(i)), load, slope)
         energy = energy + weights(i)*load*1.0e-5_wp
      end do
      call series_load(5.2e-9_wp, 5.0e7_wp, 2.0e-5_wp, load, slope)
      call check_close(error, series_energy(5.2e-9_wp, 5.0e7_wp, load), energy, 1.0e-7_wp, "energy")
   end subroutine test_series_energy

   subroutine test_restitution(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: numbers(4) = [0.1_wp, 0.3_wp, 1.0_wp, 3.0_wp]
      ! Source: root of D (1 + e) = ln((1 + D)/(1 - D e)), found with 30 digits [-]
      real(wp), parameter :: ratios(4) = [0.937475580_wp, 0.832869792_wp, 0.593624260_wp, 0.306896798_wp]
      integer :: i

      do i = 1, 4
         call check_scaled(error, restitution(numbers(i)), ratios(i), 1.0_wp, 6.0e-10_wp, "restitution")
         if (allocated(error)) return
         call check_close(error, damping_of_restitution(ratios(i), 0.25_wp)*0.25_wp, numbers(i), 1.0e-8_wp, "damping")
         if (allocated(error)) return
      end do
      call check_scaled(error, restitution(1.0e-8_wp), 1.0_wp, 1.0_wp, 1.0e-8_wp, "hardly any damping")
   end subroutine test_restitution

   !> Classical Runge-Kutta steps through an impact without other forces.
   subroutine test_impact(error)
      type(error_type), allocatable, intent(out) :: error
      ! Damping number [-], speed before and step over the natural time [-]; state and increments [-]
      real(wp), parameter :: number = 0.3_wp, h = 1.0e-4_wp
      real(wp) :: state(2), k(2, 4)
      integer :: i

      state = [0.0_wp, 1.0_wp]
      do i = 1, 100000
         k(:, 1) = rates(state)
         k(:, 2) = rates(state + 0.5_wp*h*k(:, 1))
         k(:, 3) = rates(state + 0.5_wp*h*k(:, 2))
         k(:, 4) = rates(state + h*k(:, 3))
         state = state + h/6.0_wp*(k(:, 1) + 2.0_wp*(k(:, 2) + k(:, 3)) + k(:, 4))
         if (state(1) <= 0.0_wp) exit
      end do
      ! Past the end of contact the speed stays; the step that ends there errs by its square
      call check_scaled(error, -state(2), restitution(number), 1.0_wp, 2.0e-8_wp, "speed after the impact")

   contains

      function rates(state) result(rate)
         !> Approach and its rate [-]
         real(wp), intent(in) :: state(2)
         !> Their rates [-]
         real(wp) :: rate(2)
         ! Force, elastic part, slopes [-]
         real(wp) :: force, elastic, slopes(2)

         call one_sided_force(1.0_wp, number, state(1), state(2), force, elastic, slopes(1), slopes(2))
         rate = [state(2), -force]
      end function rates

   end subroutine test_impact

   subroutine test_modes(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: counts(4) = [1, 2, 5, 12]
      ! Frequency with a mass at the end, from beta tan(beta) = m_s/M [Hz]; how much too high N modes make it [-], its digits [-]
      real(wp), parameter :: exact = 120.088180_wp
      real(wp), parameter :: high(4) = [5.7e-4_wp, 1.35e-4_wp, 1.34e-5_wp, 1.15e-6_wp]
      real(wp), parameter :: digits(4) = [5.0e-6_wp, 5.0e-7_wp, 5.0e-8_wp, 1.0e-8_wp]
      type(spring_modes_t) :: modes
      integer :: i

      call new_spring_modes(modes, spring_surge_t(mass=0.036_wp, modes=3), 25.0e3_wp)
      call check_close(error, modes%frequency(1)/two_pi, 416.666666667_wp, 1.0e-11_wp, "first mode")
      if (allocated(error)) return
      call check_close(error, modes%frequency(2)/two_pi, 833.333333333_wp, 1.0e-11_wp, "second mode")
      if (allocated(error)) return
      call check_close(error, modes%frequency(3)/two_pi, 1250.0_wp, 1.0e-12_wp, "third mode")
      if (allocated(error)) return
      call check(error, effective_mass(modes, 0.0432_wp) > 0.0312_wp, "effective mass below the valve's")
      if (allocated(error)) return
      do i = 1, 4
         call check_scaled(error, frequency_with_mass(counts(i), 0.0312_wp, 50.0_wp, 300.0_wp)/exact - 1.0_wp, high(i), 1.0_wp, &
            & digits(i), "frequency with a mass at the end")
         if (allocated(error)) return
      end do
      ! What twelve modes leave of the first, 1.15e-6, times the square of the ratio of both
      call check_close(error, frequency_with_mass(12, 0.0312_wp, 430.0_wp, 800.0_wp), 459.3211_wp, 2.0e-5_wp, "second frequency")
      if (allocated(error)) return
      call check_close(error, sqrt(25.0e3_wp/0.0432_wp)/two_pi, 121.0733_wp, 1.0e-6_wp, "a third of the mass at the end")
   end subroutine test_modes

   !> `a pi cos(pi xi) + 2 b pi cos(2 pi xi)` is largest at an end, or in between at `cos(pi xi) = -a/(8 b)` where b is negative.
   !> The places are a sixteenth apart: so near to the crest that `(pi/16)^2/2` times the curvature is left.
   subroutine test_waves(error)
      type(error_type), allocatable, intent(out) :: error
      type(spring_modes_t) :: modes
      real(wp), parameter :: one(2) = [-3.0e-4_wp, 0.0_wp], both(2) = [1.0e-4_wp, 2.0e-4_wp], inside(2) = [1.0e-4_wp, -1.0e-4_wp]

      call new_spring_modes(modes, spring_surge_t(mass=0.036_wp, modes=2), 25.0e3_wp)
      call check_ends(one, [-3.0e-4_wp, 3.0e-4_wp], 1.0e-14_wp, "one mode")
      ! at cos(pi xi) = -1/16: (-1/16 - 4 + 8/256) pi
      call check_ends(both, [-4.03125e-4_wp, 5.0e-4_wp], 0.02_wp, "two modes")
      ! at cos(pi xi) = 1/8, and at the other end
      call check_ends(inside, [-3.0e-4_wp, 2.0625e-4_wp], 0.02_wp, "between the ends")
      call check_ends([0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], 1.0e-14_wp, "no waves")
   contains
      subroutine check_ends(amplitudes, expected, tolerance, what)
         ! q_n [m]; ends over pi [m]; allowed over the size [-]
         real(wp), intent(in) :: amplitudes(2), expected(2), tolerance
         character(len=*), intent(in) :: what
         real(wp) :: ends(2) ! [m]

         if (allocated(error)) return
         ends = wave_compression(modes, amplitudes)
         call check(error, all(abs(ends - pi*expected) <= tolerance*pi*abs(expected)), what)
      end subroutine check_ends
   end subroutine test_waves

   !> A frequency of spring and mass: root of the dynamic stiffness of the modal form.
   function frequency_with_mass(count, mass, above, below) result(frequency)
      integer, intent(in) :: count
      !> Mass at the end [kg], bracket [Hz]
      real(wp), intent(in) :: mass, above, below
      !> Frequency [Hz]
      real(wp) :: frequency
      type(spring_modes_t) :: modes
      ! Bracket and middle [rad/s], dynamic stiffness [N/m]
      real(wp) :: low, high, middle, stiffness
      integer :: i

      call new_spring_modes(modes, spring_surge_t(mass=0.036_wp, modes=count, damping_ratio=0.0_wp), 25.0e3_wp)
      low = two_pi*above
      high = two_pi*below
      do i = 1, 80
         middle = 0.5_wp*(low + high)
         associate (w => modes%frequency, share => modes%share)
            ! q_n = 2 share w^2 x/(w_n^2 - w^2)
            stiffness = 25.0e3_wp - middle**2*effective_mass(modes, mass + 0.012_wp) &
               & - 0.036_wp*sum(share*w**2*2.0_wp*share*middle**2/(w**2 - middle**2))
         end associate
         if (stiffness > 0.0_wp) low = middle
         if (stiffness <= 0.0_wp) high = middle
      end do
      frequency = low/two_pi
   end function frequency_with_mass

   subroutine test_bulk_modulus(error)
      type(error_type), allocatable, intent(out) :: error
      ! Pressures [Pa], air contents [-], moduli [Pa]: the derivative of v(p) by hand
      real(wp), parameter :: pressures(5) = [0.0_wp, 0.2e6_wp, 1.0e6_wp, 4.0e6_wp, 10.0e6_wp]
      real(wp), parameter :: contents(3) = [0.01_wp, 0.001_wp, 0.05_wp]
      real(wp), parameter :: moduli(5, 3) = reshape([ &
         & 1.3863e7_wp, 8.5948e7_wp, 5.2779e8_wp, 1.1932e9_wp, 1.3502e9_wp, &
         & 1.2728e8_wp, 5.5525e8_wp, 1.2027e9_wp, 1.3764e9_wp, 1.3949e9_wp, &
         & 2.7947e6_wp, 1.7687e7_wp, 1.4667e8_wp, 7.3678e8_wp, 1.1746e9_wp], [5, 3])
      type(lash_adjuster_t) :: given
      ! Modulus [Pa], its slope [-], the same nearby, change of pressure [Pa]
      real(wp) :: modulus, slope, low, high, other, h
      integer :: i, k

      do k = 1, 3
         given%air_content = contents(k)
         do i = 1, 5
            call bulk_modulus(given, pressures(i), modulus, slope)
            call check_close(error, modulus, moduli(i, k), 5.0e-5_wp, "bulk modulus")
            if (allocated(error)) return
            h = 10.0_wp
            call bulk_modulus(given, pressures(i) - h, low, other)
            call bulk_modulus(given, pressures(i) + h, high, other)
            call check_close(error, slope, (high - low)/(2.0_wp*h), 1.0e-5_wp, "slope of the bulk modulus")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_bulk_modulus

   subroutine test_flows(error)
      type(error_type), allocatable, intent(out) :: error
      type(lash_adjuster_t) :: given
      type(adjuster_t) :: adjuster
      type(flows_t) :: flows, low, high
      ! Pressure and change of it [Pa]
      real(wp) :: pressure, h
      integer :: i

      call new_adjuster(adjuster, given)
      call set_adjuster_oil(adjuster, 0.01_wp)
      h = 0.1_wp
      do i = -90, 220, 7
         pressure = 1.0e3_wp*i + 13.0_wp
         call evaluate_flows(adjuster, pressure, flows)
         call evaluate_flows(adjuster, pressure - h, low)
         call evaluate_flows(adjuster, pressure + h, high)
         call check_scaled(error, flows%check_slope, (high%check - low%check)/(2.0_wp*h), abs(flows%check_slope) + 1.0e-12_wp, &
            & 1.0e-6_wp, "slope of the check valve's flow")
         if (allocated(error)) return
         ! The work has round-off of 1e-7 Pa
         call check_scaled(error, (pressure_work(given, pressure + 10.0_wp) - pressure_work(given, pressure - 10.0_wp))/20.0_wp, &
            & relative_volume(given, pressure), 1.0_wp, 1.0e-6_wp, "slope of the work")
         if (allocated(error)) return
      end do
      call evaluate_flows(adjuster, given%supply_pressure, flows)
      call check(error, abs(flows%check) + abs(flows%leak) <= 0.0_wp, "flow without a pressure difference")
      if (allocated(error)) return
      call check_close(error, adjuster%conductance, 4.090615e-15_wp, 1.0e-6_wp, "conductance of the gap")
   end subroutine test_flows

   !> Resistance over that of its law, for cold oil, whose resistance is large: what is left out is an eighth of the eighth power of
   !> its ratio to the load.
   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(rest_t) :: rest
      type(flexible_state_t) :: now
      type(error_t), allocatable :: failure
      real(wp), allocatable :: state(:)
      ! Viscosity [Pa s]; resistance of the law [N], its slope [-]
      real(wp), parameter :: cold = 3.0_wp
      real(wp) :: expected, slope
      ! Turn of the finger by which the approach moves [rad], the approach [m]
      real(wp), parameter :: turned = 1.0e-8_wp
      real(wp) :: approach
      integer :: i, status

      case = thesis_case()
      deallocate (case%asperity)
      call set_point(case, point_speeds(3), cold)
      call add_dynamics(case, 3, .false.)
      call make_model(case, model, error)
      if (allocated(error)) return
      call find_rest(model%flexible, model%linkage, model%train, 64.0_wp, rest, failure)
      if (has_failed(failure, error)) return
      allocate (state(state_size(model)), source=0.0_wp)
      state(3) = rest%lift
      do i = 0, 1
         ! At rest, and with the finger so far off that next to nothing is left of the approach of cam and roller
         state(1) = rest%finger
         if (i == 1) then
            approach = now%touch%approach
            state(1) = rest%finger + turned
            call evaluate_train(model, -pi, state, resolution_t(), now, status)
            state(1) = rest%finger - (1.0_wp - 1.0e-4_wp)*turned*approach/(now%touch%approach - approach)
         end if
         call evaluate_train(model, -pi, state, resolution_t(), now, status)
         call check(error, status, 0)
         if (allocated(error)) return
         call rolling_resistance(model%rolling_law, now%setting%line%groups%speed, now%setting%line%groups%load, model%modulus, &
            & now%touch%position%equivalent_radius, same_lengths(model%contact_width), model%oil%pressure_viscosity, expected, &
            & slope)
         associate (found => abs(now%contact%rolling_resistance), load => now%contact%load)
            if (i == 0) then
               call check(error, expected > 0.02_wp*load, "hardly any resistance")
               if (.not. allocated(error)) call check_close(error, found, expected, &
                  & (expected/load)**8 + 10.0_wp*epsilon(1.0_wp), "resistance")
            else
               call check(error, expected > load .and. load > 0.0_wp, "too much load, or none")
               if (.not. allocated(error)) call check(error, found < load, "resistance over the load")
            end if
         end associate
         if (allocated(error)) return
      end do
   end subroutine test_rolling

   !> Time in which a constant force presses the plunger down against the leak, with the leak's end at no pressure.
   function leak_down_time(adjuster, force, travel) result(time)
      type(adjuster_t), intent(in) :: adjuster
      real(wp), intent(in) :: force, travel
      real(wp) :: time
      type(flows_t) :: flows
      real(wp) :: places(10), weights(10)
      integer :: i

      call gauss_legendre(places, weights)
      time = 0.0_wp
      do i = 1, size(places)
         call evaluate_flows(adjuster, (force - adjuster_force(adjuster, -0.5_wp*travel*(1.0_wp + places(i)), 0.0_wp, 0.0_wp)) &
            & /adjuster%area, flows)
         time = time + 0.5_wp*travel*weights(i)*adjuster%area/flows%leak
      end do
   end function leak_down_time

   subroutine test_leak_down(error)
      type(error_type), allocatable, intent(out) :: error
      type(lash_adjuster_t) :: given
      type(adjuster_t) :: adjuster

      given%leak_end = leak_end_names(2)
      given%spring_force = 10.6722_wp
      call new_adjuster(adjuster, given)
      call set_adjuster_oil(adjuster, 0.01_wp)
      call check_close(error, adjuster%conductance, 4.090615e-15_wp, 2.0e-7_wp, "conductance of the gap")
      if (allocated(error)) return
      call check_close(error, leak_down_time(adjuster, 222.6_wp, 1.59e-3_wp), 11.34768_wp, 1.0e-6_wp, "with the plunger's spring")
      if (allocated(error)) return
      given%spring_force = 0.0_wp
      given%spring_stiffness = 0.0_wp
      call new_adjuster(adjuster, given)
      call set_adjuster_oil(adjuster, 0.01_wp)
      call check_close(error, leak_down_time(adjuster, 222.6_wp, 1.59e-3_wp), 10.7712_wp, 1.0e-5_wp, "without it")
   end subroutine test_leak_down

   subroutine test_soft_seat(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      integer :: lobe

      case = thesis_case()
      call add_dynamics(case, 0, .false.)
      case%second_lift = case%lift
      case%second_lift%max_lift = 10.0_wp*case%spring%stiffness*case%spring%precompression/case%dynamics%seat_stiffness
      do lobe = 1, 2
         call new_model(model, case, lobe, failure)
         if (lobe == 1) call expect_success(error, failure)
         if (allocated(error)) return
      end do
      call expect_error(error, failure, kind_deck, "the seat is too soft for the spring")
   end subroutine test_soft_seat

end module test_flexible_parts
