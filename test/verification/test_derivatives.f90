!> Derivatives that kernels give beside their values, against central differences of the values.
module test_derivatives
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_lift, only : lift_t, lift_law_t, new_lift_law, evaluate_lift
   use camroller_kinematics, only : mechanism_t, linkage_t, position_t, rotation_names, new_linkage, evaluate_position
   use camroller_dynamics, only : train_t, stored_energy, stored_power
   use camroller_film, only : film_law_names, film_shape_t, groups_t, film_shape
   use camroller_lubricant, only : lubricant_t, oil_t, pressure_law_names, get_oil
   use camroller_traction, only : cap_names, eyring_shear, limit_shear
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
         new_unittest("stored power is the rate of the stored energy", test_power), &
         new_unittest("film laws: slopes over load and speed", test_film), &
         new_unittest("Eyring shear: slope over sliding speed", test_eyring), &
         new_unittest("limited shear: slope over sliding speed", test_limit) &
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
   function film_logs(law, groups, load_factor, speed_factor) result(logs)
      !> Place in the list of laws
      integer, intent(in) :: law
      type(groups_t), intent(in) :: groups
      !> Factors of load and speed [-]
      real(wp), intent(in) :: load_factor, speed_factor
      !> Logarithms [-]
      real(wp) :: logs(2)
      type(groups_t) :: changed
      type(film_shape_t) :: shape

      changed = groups
      changed%load = groups%load*load_factor
      changed%speed = groups%speed*speed_factor
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
               quotient = (film_logs(law, groups, exp(h), 1.0_wp) - film_logs(law, groups, exp(-h), 1.0_wp))/(2.0_wp*h)
               call check(error, all(abs(quotient - [shape%minimum_load_slope, &
                  shape%central_load_slope]) < tolerance), &
                  "load, "//film_law_names(law))
               if (allocated(error)) return
               quotient = (film_logs(law, groups, 1.0_wp, exp(h)) - film_logs(law, groups, 1.0_wp, exp(-h)))/(2.0_wp*h)
               call check(error, all(abs(quotient - [shape%minimum_speed_slope, &
                  shape%central_speed_slope]) < tolerance), &
                  "speed, "//film_law_names(law))
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
      real(wp) :: sliding, low, mid, high, slope, unused
      integer :: i, law

      lubricant%viscosity = 0.0305_wp
      lubricant%pressure_viscosity = 2.2e-8_wp
      do law = 1, size(pressure_law_names)
         lubricant%pressure_law = pressure_law_names(law)
         call get_oil(lubricant, 333.15_wp, oil, failure)
         do i = -4, 1
            sliding = 3.0_wp*10.0_wp**i
            call eyring_shear(sliding*(1.0_wp - h), oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, low, unused)
            call eyring_shear(sliding, oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, mid, slope)
            call eyring_shear(sliding*(1.0_wp + h), oil, 5.0e8_wp, 1.4e-6_wp, 2.0e-7_wp, 5.0e6_wp, high, unused)
            call check(error, abs((high - low)/(2.0_wp*h) - slope*sliding) < tolerance*mid, pressure_law_names(law))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_eyring

   subroutine test_limit(error)
      type(error_type), allocatable, intent(out) :: error
      ! Limit [N], slope before the limit [N s/m]
      real(wp), parameter :: limit = 50.0_wp, rate = 2.0e4_wp
      real(wp) :: sliding, low, mid, high, slope, unused
      integer :: cap, i

      do cap = 1, size(cap_names)
         do i = -10, 10
            sliding = 1.03e-3_wp*real(i, wp) + 1.0e-5_wp
            low = rate*(sliding - h*1.0e-3_wp)
            mid = rate*sliding
            high = rate*(sliding + h*1.0e-3_wp)
            unused = rate
            call limit_shear(cap, limit, low, unused)
            slope = rate
            call limit_shear(cap, limit, mid, slope)
            unused = rate
            call limit_shear(cap, limit, high, unused)
            call check(error, abs((high - low)/(2.0_wp*h*1.0e-3_wp) - slope) < 10.0_wp*tolerance*rate, cap_names(cap))
            if (allocated(error)) return
            call check(error, abs(mid) <= limit, "limit exceeded, "//cap_names(cap))
            if (allocated(error)) return
         end do
      end do
   end subroutine test_limit

end module test_derivatives
