!> Derivatives that kernels give beside their values, against central differences of the values.
module test_derivatives
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_lift, only : lift_t, lift_law_t, new_lift_law, evaluate_lift
   use camroller_kinematics, only : mechanism_t, linkage_t, position_t, rotation_names, new_linkage, evaluate_position
   use camroller_dynamics, only : train_t, moments_t, evaluate_moments, moment_slope, stored_energy, stored_power
   use camroller_film, only : film_law_names, film_shape_t, film_line_t, groups_t, film_shape, new_film_line
   use camroller_lubricant, only : lubricant_t, oil_t, pressure_law_names, get_oil, relative_viscosity, &
      & mean_relative_viscosity
   use camroller_traction, only : cap_names, rolling_law_names, eyring_shear, limit_shear, rolling_resistance, &
      & resistance_length_slope, resistance_speed_slope, line_lengths_t
   use camroller_needle, only : bearing_torque, bearing_torque_slope
   use camroller_asperity, only : asperity_t, asperity_constants_t, new_asperity_constants
   use camroller_load_share, only : share_t, share_change_t, share_load, share_change
   implicit none
   private

   public :: collect_derivatives

   !> Step of the central differences, relative to the scale of the variable: the cube root of round-off [-]
   real(wp), parameter :: h = 6.0e-6_wp
   !> Difference allowed, relative to the scale of the derivative: truncation h^2 and round-off epsilon/h, times 100 [-]
   real(wp), parameter :: tolerance = 4.0e-9_wp

contains

   subroutine collect_derivatives(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("finger angle: slope and curvature", test_finger), &
         new_unittest("surface travel and rolling travel: slopes", test_travel), &
         new_unittest("arms, radius and rolling travel: slopes", test_arms), &
         new_unittest("moments about the pivot: slope", test_moments), &
         new_unittest("torque of the roller's bearing: slope over spin", test_bearing), &
         new_unittest("stored power agrees with the derivative of the stored energy", test_power), &
         new_unittest("film laws: slopes over load, speed and roughness", test_film), &
         new_unittest("Eyring shear: slope over sliding speed", test_eyring), &
         new_unittest("limited shear: slopes over shear and limit", test_limit), &
         new_unittest("viscosity at a point and its mean: slope over pressure", test_viscosity), &
         new_unittest("rolling resistance: slopes over load and speed", test_rolling), &
         new_unittest("load share: slopes over load with a growing area, over speed and over radius", test_share) &
         ]
   end subroutine collect_derivatives

   !> A mechanism and its lift
   subroutine make_mechanism(rotation, linkage, law)
      !> Sense of rotation
      character(len=*), intent(in) :: rotation
      type(linkage_t), intent(out) :: linkage
      type(lift_law_t), intent(out) :: law
      type(error_t), allocatable :: failure

      call new_linkage(linkage, mechanism_t(20.8e-3_wp, 35.5e-3_wp, 31.5e-3_wp, -3.5_wp*degree, 37.5_wp*degree, &
         18.0e-3_wp, &
         & 8.5e-3_wp, 13.7e-3_wp, rotation=rotation), failure)
      if (.not. allocated(failure)) call new_lift_law(law, lift_t("power", 9.5e-3_wp, 70.0_wp*degree, &
         70.0_wp*degree, [4]), failure)
      if (allocated(failure)) error stop "a valid mechanism is refused"
   end subroutine make_mechanism

   !> Positions before, at and after an angle
   subroutine three_positions(linkage, law, angle, low, mid, high)
      type(linkage_t), intent(in) :: linkage
      type(lift_law_t), intent(in) :: law
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      type(position_t), intent(out) :: low, mid, high
      ! Lift and its derivatives [m/rad^n]
      real(wp) :: lift(0:3)
      integer :: status

      call evaluate_lift(law, angle - h, lift)
      call evaluate_position(linkage, lift, low, status)
      call evaluate_lift(law, angle, lift)
      call evaluate_position(linkage, lift, mid, status)
      call evaluate_lift(law, angle + h, lift)
      call evaluate_position(linkage, lift, high, status)
   end subroutine three_positions

   subroutine test_finger(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(position_t) :: low, mid, high
      integer :: i

      call make_mechanism(rotation_names(1), linkage, law)
      do i = -13, 13
         call three_positions(linkage, law, 0.09_wp*real(i, wp) + 0.01_wp, low, mid, high)
         call check(error, abs((high%arm_angle - low%arm_angle)/(2.0_wp*h) - mid%finger_slope) < tolerance, "slope")
         if (allocated(error)) return
         call check(error, abs((high%finger_slope - low%finger_slope)/(2.0_wp*h) - mid%finger_curvature) < tolerance, &
            "curvature")
         if (allocated(error)) return
      end do
   end subroutine test_finger

   subroutine test_travel(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(position_t) :: low, mid, high
      ! Scale of the travels per angle: the radius of the path of the roller's centre [m]
      real(wp), parameter :: scale = 0.03_wp
      integer :: i, sense

      do sense = 1, size(rotation_names)
         call make_mechanism(rotation_names(sense), linkage, law)
         do i = -13, 13
            call three_positions(linkage, law, 0.09_wp*real(i, wp) + 0.01_wp, low, mid, high)
            call check(error, abs((high%rolling_travel - low%rolling_travel)/(2.0_wp*h) - mid%rolling_travel_slope) &
               < tolerance*scale, "rolling travel, "//rotation_names(sense))
            if (allocated(error)) return
            ! the surface travel holds the curvature, whose third derivative is 100 times its value
            call check(error, abs((high%surface_travel - low%surface_travel)/(2.0_wp*h) - mid%surface_travel_slope) &
               < 100.0_wp*tolerance*scale, "surface travel, "//rotation_names(sense))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_travel

   subroutine test_arms(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(position_t) :: low, mid, high
      ! Scale of the arms and of their slopes [m]; slopes by differences and as given [m/rad]
      real(wp), parameter :: scale = 0.03_wp
      real(wp) :: differences(6), slopes(6)
      integer :: i, sense

      do sense = 1, size(rotation_names)
         call make_mechanism(rotation_names(sense), linkage, law)
         do i = -13, 13
            call three_positions(linkage, law, 0.09_wp*real(i, wp) + 0.01_wp, low, mid, high)
            differences = [high%valve_arm - low%valve_arm, high%normal_arm - low%normal_arm, &
               & high%parallel_arm - low%parallel_arm, high%tangent_arm - low%tangent_arm, &
               & high%equivalent_radius - low%equivalent_radius, high%rolling_travel_slope - low%rolling_travel_slope]/(2.0_wp*h)
            slopes = [mid%valve_arm_slope, mid%normal_arm_slope, mid%parallel_arm_slope, mid%tangent_arm_slope, &
               & mid%radius_slope, mid%rolling_travel_curvature]
            ! radius and travel hold the lift's second derivative, whose third derivative is 100 times its value
            call check(error, all(abs(differences - slopes) < 100.0_wp*tolerance*scale), rotation_names(sense))
            if (allocated(error)) return
            call check(error, abs((high%finger_curvature - low%finger_curvature)/(2.0_wp*h) - mid%finger_jerk) &
               & < 100.0_wp*tolerance, "third derivative of the finger's angle")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_arms

   subroutine test_moments(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(train_t) :: train
      type(position_t) :: low, mid, high
      type(moments_t) :: less, more
      ! Cam speed [rad/s]; gas force [N] and its slope [N/rad]; scale: spring force on its arm [N m]
      real(wp), parameter :: omega = 63.0_wp, gas = 300.0_wp, gas_slope = -150.0_wp, scale = 400.0_wp*0.035_wp
      integer :: i

      ! a soft seat, so that some of the angles lie where it still carries
      train = train_t(0.0432_wp, 3.3e-5_wp, 25.0e3_wp, 8.4e-3_wp, 172.0_wp, 3.44e-3_wp)
      call make_mechanism(rotation_names(1), linkage, law)
      do i = -13, 13
         call three_positions(linkage, law, 0.09_wp*real(i, wp) + 0.01_wp, low, mid, high)
         call evaluate_moments(train, low, omega, gas - gas_slope*h, less)
         call evaluate_moments(train, high, omega, gas + gas_slope*h, more)
         call check(error, abs((more%total - less%total)/(2.0_wp*h) - moment_slope(train, mid, omega, gas, gas_slope)) &
            & < 100.0_wp*tolerance*scale)
         if (allocated(error)) return
      end do
   end subroutine test_moments

   subroutine test_bearing(error)
      type(error_type), allocatable, intent(out) :: error
      ! Spins [rad/s]; friction coefficient [-], load [N], radius [m], spin of reversal [rad/s]; torque [N m]
      real(wp), parameter :: spins(4) = [-3.0_wp, 0.0_wp, 0.4_wp, 20.0_wp]
      real(wp), parameter :: friction = 0.0015_wp, load = 500.0_wp, radius = 5.0e-3_wp, reversal = 0.6_wp
      real(wp), parameter :: torque = friction*load*radius

      call check(error, all(abs((bearing_torque(friction, load, radius, spins + h*reversal, reversal) &
         & - bearing_torque(friction, load, radius, spins - h*reversal, reversal))/(2.0_wp*h) &
         & - reversal*bearing_torque_slope(friction, load, radius, spins, reversal)) < tolerance*torque))
   end subroutine test_bearing

   subroutine test_power(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(lift_law_t) :: law
      type(train_t) :: train
      type(position_t) :: low, mid, high
      ! Cam speed [rad/s], scale of the power: spring force over the lift's slope [W]
      real(wp), parameter :: omega = 63.0_wp, scale = omega*400.0_wp*1.0e-2_wp
      integer :: i

      train = train_t(0.0432_wp, 3.3e-5_wp, 25.0e3_wp, 8.4e-3_wp, 172.0_wp, 3.44e-3_wp)
      call make_mechanism(rotation_names(1), linkage, law)
      do i = -13, 13
         call three_positions(linkage, law, 0.09_wp*real(i, wp) + 0.01_wp, low, mid, high)
         call check(error, abs(omega*(stored_energy(train, high, omega) - stored_energy(train, low, omega))/(2.0_wp*h) &
            - stored_power(train, mid, omega, 0.0_wp)) < tolerance*scale)
         if (allocated(error)) return
      end do
   end subroutine test_power

   !> Logarithms of minimum and central film at groups changed by a factor
   function film_logs(law, groups, load_factor, speed_factor, roughness_factor) result(logs)
      !> Place in the list of laws
      integer, intent(in) :: law
      type(groups_t), intent(in) :: groups
      !> Factors of load, speed and roughness [-]
      real(wp), intent(in) :: load_factor, speed_factor, roughness_factor
      !> Logarithms [-]
      real(wp) :: logs(2)
      type(groups_t) :: changed
      type(film_shape_t) :: shape

      changed = groups
      changed%load = groups%load*load_factor
      changed%speed = groups%speed*speed_factor
      changed%roughness = groups%roughness*roughness_factor
      call film_shape(law, changed, shape)
      logs = log([shape%minimum, shape%central])
   end function film_logs

   subroutine test_film(error)
      type(error_type), allocatable, intent(out) :: error
      type(groups_t) :: groups
      type(film_shape_t) :: shape
      real(wp) :: quotient(2)
      integer :: i, k, law

      groups%material = 4500.0_wp
      groups%roughness = 3.0e-5_wp
      groups%hardness = 0.03_wp
      do law = 1, size(film_law_names)
         do i = -7, -3
            do k = -14, -9
               ! from the rigid to the elastic side
               groups%load = 2.0_wp*10.0_wp**i
               groups%speed = 3.0_wp*10.0_wp**k
               call film_shape(law, groups, shape)
               quotient = film_logs(law, groups, exp(h), 1.0_wp, 1.0_wp) - film_logs(law, groups, exp(-h), 1.0_wp, 1.0_wp)
               quotient = quotient/(2.0_wp*h)
               call check(error, all(abs(quotient - [shape%minimum_load_slope, &
                  shape%central_load_slope]) < tolerance), &
                  "load, "//film_law_names(law))
               if (allocated(error)) return
               quotient = film_logs(law, groups, 1.0_wp, exp(h), 1.0_wp) - film_logs(law, groups, 1.0_wp, exp(-h), 1.0_wp)
               quotient = quotient/(2.0_wp*h)
               call check(error, all(abs(quotient - [shape%minimum_speed_slope, &
                  shape%central_speed_slope]) < tolerance), &
                  "speed, "//film_law_names(law))
               if (allocated(error)) return
               quotient = film_logs(law, groups, 1.0_wp, 1.0_wp, exp(h)) - film_logs(law, groups, 1.0_wp, 1.0_wp, exp(-h))
               quotient = quotient/(2.0_wp*h)
               call check(error, all(abs(quotient - [shape%minimum_roughness_slope, &
                  shape%central_roughness_slope]) < tolerance), &
                  "roughness, "//film_law_names(law))
               if (allocated(error)) return
            end do
         end do
      end do
   end subroutine test_film

   subroutine test_eyring(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      real(wp) :: sliding, low, mid, high, slope, peak_slope, unused, more
      integer :: i, law

      lubricant%viscosity = 0.0305_wp
      lubricant%pressure_viscosity = 2.2e-8_wp
      do law = 1, size(pressure_law_names)
         lubricant%pressure_law = pressure_law_names(law)
         call get_oil(lubricant, 333.15_wp, oil, failure)
         do i = -4, 1
            sliding = 3.0_wp*10.0_wp**i
            call eyring_shear(sliding*(1.0_wp - h), oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, low, unused, more)
            call eyring_shear(sliding, oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, mid, slope, peak_slope)
            call eyring_shear(sliding*(1.0_wp + h), oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, high, unused, more)
            call check(error, abs((high - low)/(2.0_wp*h) - slope*sliding) < tolerance*mid, pressure_law_names(law))
            if (allocated(error)) return
            call eyring_shear(sliding, oil, 5.0e8_wp*exp(-h), 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, low, unused, more)
            call eyring_shear(sliding, oil, 5.0e8_wp*exp(h), 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, high, unused, more)
            call check(error, abs((high - low)/(2.0_wp*h) - peak_slope) < 100.0_wp*tolerance*mid, &
               "pressure, "//pressure_law_names(law))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_eyring

   subroutine test_limit(error)
      type(error_type), allocatable, intent(out) :: error
      ! Limit [N]
      real(wp), parameter :: limit = 50.0_wp
      real(wp) :: force, low, mid, high, by_force, by_limit, unused, more
      integer :: cap, i

      do cap = 1, size(cap_names)
         do i = -10, 10
            force = 20.6_wp*real(i, wp) + 0.2_wp
            low = force - h*limit
            mid = force
            high = force + h*limit
            call limit_shear(cap, limit, low, unused, more)
            call limit_shear(cap, limit, mid, by_force, by_limit)
            call limit_shear(cap, limit, high, unused, more)
            call check(error, abs((high - low)/(2.0_wp*h*limit) - by_force) < 10.0_wp*tolerance, cap_names(cap))
            if (allocated(error)) return
            call check(error, abs(mid) <= limit, "limit exceeded, "//cap_names(cap))
            if (allocated(error)) return
            low = force
            high = force
            call limit_shear(cap, limit*(1.0_wp - h), low, unused, more)
            call limit_shear(cap, limit*(1.0_wp + h), high, unused, more)
            call check(error, abs((high - low)/(2.0_wp*h*limit) - by_limit) < 10.0_wp*tolerance, "limit, "//cap_names(cap))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_limit

   subroutine test_viscosity(error)
      type(error_type), allocatable, intent(out) :: error
      type(error_t), allocatable :: failure
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      real(wp) :: peak, low, mid, high, slope, unused, ratios(3), slopes(3)
      integer :: i, law

      lubricant%viscosity = 0.0305_wp
      lubricant%pressure_viscosity = 2.2e-8_wp
      do law = 1, size(pressure_law_names)
         lubricant%pressure_law = pressure_law_names(law)
         call get_oil(lubricant, 333.15_wp, oil, failure)
         do i = 1, 15
            peak = 1.0e8_wp*real(i, wp)
            call mean_relative_viscosity(oil, peak*exp(-h), low, unused)
            call mean_relative_viscosity(oil, peak, mid, slope)
            call mean_relative_viscosity(oil, peak*exp(h), high, unused)
            ! slopes reach 33, third derivatives their cube
            call check(error, abs(log(high/low)/(2.0_wp*h) - slope) < 100.0_wp*tolerance, &
               "mean, "//pressure_law_names(law))
            if (allocated(error)) return
            call relative_viscosity(oil, peak*[exp(-h), 1.0_wp, exp(h)], ratios, slopes)
            call check(error, abs(log(ratios(3)/ratios(1))/(2.0_wp*h) - slopes(2)) < 100.0_wp*tolerance, &
               "point, "//pressure_law_names(law))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_viscosity

   subroutine test_rolling(error)
      type(error_type), allocatable, intent(out) :: error
      ! lengths of a load that is not the same along the roller, a change of their logarithms
      type(line_lengths_t), parameter :: lengths = line_lengths_t(0.0137_wp, 0.0145_wp, 0.016_wp), &
         & change = line_lengths_t(1.0_wp, 0.5_wp, -0.7_wp)
      real(wp) :: load, low, mid, high, slope, unused
      integer :: i, law

      do law = 1, 2
         do i = 0, 20
            load = 1.0e-7_wp*2.0_wp**i
            call rolling_resistance(law, 1.0e-11_wp, load*exp(-h), 2.0e11_wp, 0.005_wp, lengths, 2.2e-8_wp, low, unused)
            call rolling_resistance(law, 1.0e-11_wp, load, 2.0e11_wp, 0.005_wp, lengths, 2.2e-8_wp, mid, slope)
            call rolling_resistance(law, 1.0e-11_wp, load*exp(h), 2.0e11_wp, 0.005_wp, lengths, 2.2e-8_wp, high, unused)
            call check(error, abs(log(high/low)/(2.0_wp*h) - slope) < 10.0_wp*tolerance, rolling_law_names(law))
            if (allocated(error)) return
            call rolling_resistance(law, 1.0e-11_wp*exp(-h), load, 2.0e11_wp, 0.005_wp, lengths, 2.2e-8_wp, low, unused)
            call rolling_resistance(law, 1.0e-11_wp*exp(h), load, 2.0e11_wp, 0.005_wp, lengths, 2.2e-8_wp, high, unused)
            call check(error, abs(log(high/low)/(2.0_wp*h) - resistance_speed_slope(law, slope)) < 10.0_wp*tolerance, &
               & "speed, "//rolling_law_names(law))
            if (allocated(error)) return
            call rolling_resistance(law, 1.0e-11_wp, load, 2.0e11_wp, 0.005_wp, moved(lengths, change, -h), 2.2e-8_wp, low, unused)
            call rolling_resistance(law, 1.0e-11_wp, load, 2.0e11_wp, 0.005_wp, moved(lengths, change, h), 2.2e-8_wp, high, unused)
            call check(error, abs(log(high/low)/(2.0_wp*h) - resistance_length_slope(law, slope, change)) < 10.0_wp*tolerance, &
               & "lengths, "//rolling_law_names(law))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_rolling

   !> Lengths whose logarithms have moved.
   pure function moved(lengths, change, part) result(others)
      type(line_lengths_t), intent(in) :: lengths, change
      real(wp), intent(in) :: part
      type(line_lengths_t) :: others

      others = line_lengths_t(lengths%mean*exp(part*change%mean), lengths%root*exp(part*change%root), &
         & lengths%loaded*exp(part*change%loaded))
   end function moved

   !> Load share with load over radius, speed and radius moved along their logarithms.
   subroutine moved_share(law, groups, q, u, r, share, line, load)
      !> Place in the list of laws
      integer, intent(in) :: law
      type(groups_t), intent(in) :: groups
      !> Moves of load over radius, speed group and radius [-]
      real(wp), intent(in) :: q, u, r
      type(share_t), intent(out) :: share
      type(film_line_t), intent(out) :: line
      !> Load over E' R L [-]
      real(wp), intent(out) :: load
      type(asperity_constants_t) :: constants
      type(groups_t) :: moved
      real(wp), parameter :: modulus = 2.0e11_wp

      call new_asperity_constants(constants, asperity_t(), modulus)
      moved = groups
      moved%speed = groups%speed*exp(u)
      moved%roughness = groups%roughness*exp(-r)
      load = groups%load*exp(q)
      call new_film_line(line, law, moved)
      ! A_a = 2 L sqrt(8 W R/(pi L E')), so A_a/(E' R L) = sqrt(32/pi W*)/E'
      call share_load(line, load, share, constants, sqrt(32.0_wp/acos(-1.0_wp)*load)/modulus)
   end subroutine moved_share

   subroutine test_share(error)
      type(error_type), allocatable, intent(out) :: error
      type(film_line_t) :: line
      type(groups_t) :: groups
      type(share_t) :: low, mid, high
      type(share_change_t) :: change
      ! Direction: load over radius, speed, radius; unit moves along it [-]; load over E' R L [-]
      real(wp) :: d(3), load, unused
      integer :: i, k, law, direction

      groups%material = 4500.0_wp
      groups%roughness = 4.0e-5_wp
      groups%hardness = 0.03_wp
      do law = 1, size(film_law_names)
         do k = 1, 6
            groups%speed = 1.0e-13_wp*6.0_wp**k
            do i = 0, 6
               groups%load = 3.0e-6_wp*3.0_wp**i
               do direction = 1, 3
                  d = 0.0_wp
                  d(direction) = h
                  call moved_share(law, groups, -d(1), -d(2), -d(3), low, line, unused)
                  call moved_share(law, groups, d(1), d(2), d(3), high, line, unused)
                  call moved_share(law, groups, 0.0_wp, 0.0_wp, 0.0_wp, mid, line, load)
                  if (mid%film_min > 7.99_wp*groups%roughness .and. mid%film_min < 8.01_wp*groups%roughness) cycle
                  d(direction) = 1.0_wp
                  change = share_change(line, load, mid, d(1), d(2), d(3))
                  call compare_shares(error, low, mid, high, change, load, direction, film_law_names(law))
                  if (allocated(error)) return
               end do
            end do
         end do
      end do
   end subroutine test_share

   !> Changes of a load share against differences.
   subroutine compare_shares(error, low, mid, high, change, load, direction, law)
      type(error_type), allocatable, intent(out) :: error
      type(share_t), intent(in) :: low, mid, high
      type(share_change_t), intent(in) :: change
      !> Load over E' R L [-]
      real(wp), intent(in) :: load
      integer, intent(in) :: direction
      character(len=*), intent(in) :: law
      character(len=*), parameter :: directions(3) = ["load  ", "speed ", "radius"]
      ! Film laws are steep where the film carries little [-]
      real(wp), parameter :: allowed = 10.0_wp*tolerance

      call check(error, abs(log(high%film_min/low%film_min)/(2.0_wp*h) - change%film_min) < allowed, &
         & directions(direction)//", minimum film, "//law)
      if (allocated(error)) return
      if (abs(mid%film_central - mid%film_min) > 0.001_wp*mid%film_min) then
         call check(error, abs(log(high%film_central/low%film_central)/(2.0_wp*h) - change%film_central) < allowed, &
            & directions(direction)//", central film, "//law)
         if (allocated(error)) return
      end if
      call check(error, abs((high%asperity_load - low%asperity_load)/(2.0_wp*h) - change%asperity_load) < allowed*load, &
         & directions(direction)//", asperity load, "//law)
      if (allocated(error)) return
      call check(error, abs((high%real_area_ratio - low%real_area_ratio)/(2.0_wp*h) - change%real_area_ratio) < allowed, &
         & directions(direction)//", real area, "//law)
      if (allocated(error)) return
      if (mid%film_load < 0.01_wp*load) return
      call check(error, abs(log(high%film_load/low%film_load)/(2.0_wp*h) - change%film_load) < 100.0_wp*allowed, &
         & directions(direction)//", load of the film, "//law)
   end subroutine compare_shares

end module test_derivatives
