!> Parts beside the contact: finger and spring, seat, gas, roller, its bearing, guide, torques. Numbers by hand.
module test_train
   use, intrinsic :: iso_fortran_env, only : int64
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, kind_deck, kind_domain
   use camroller_kinematics, only : mechanism_t, linkage_t, position_t, arm_angle_at, new_linkage, evaluate_position
   use camroller_dynamics, only : train_t, moments_t, gas_force_t, seat_force, unseated_share, evaluate_moments, stored_energy
   use camroller_gas, only : gas_law_t, new_gas_law, gas_force
   use camroller_needle, only : needle_bearing_t, friction_radius, bearing_torque
   use camroller_guide, only : find_guide_drag, guide_drag_coefficient, guide_part_t, new_guide_part, set_guide_oil, valve_guide_t
   use camroller_roller, only : ring_inertia, spin_acceleration
   use camroller_torque, only : cam_torque, contact_power, normal_direction
   implicit none
   private

   public :: collect_train

   !> A hundred roundings [-]
   real(wp), parameter :: roundings = 100.0_wp*epsilon(1.0_wp)

contains

   subroutine collect_train(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("seat force falls from the closed valve's to zero, without a kink", test_seat), &
         new_unittest("without a seat everything rests on the train", test_no_seat), &
         new_unittest("moments about the pivot of a worked example", test_moments), &
         new_unittest("stored energy is zero for the closed valve, and that of spring and masses when it is open", test_energy), &
         new_unittest("gas force passes through its table and repeats itself", test_gas), &
         new_unittest("gas tables that cannot be are refused in words", test_gas_refusals), &
         new_unittest("ring: thin and solid limits", test_ring), &
         new_unittest("spin follows traction less rolling resistance less bearing", test_spin), &
         new_unittest("needles act at their pitch circle, a pin at the bore", test_friction_radius), &
         new_unittest("bearing torque is Coulomb's but close to reversal", test_bearing), &
         new_unittest("guide drag of a worked example", test_guide), &
         new_unittest("cam torque and contact power of worked examples", test_torque), &
         new_unittest("normal and tangent are unit vectors, upright on each other, with the arms they come from", test_normal), &
         new_unittest("geometry for moments alone is that of all", test_moments_only), &
         new_unittest("impossible mechanisms are refused in words", test_mechanism_refusals), &
         new_unittest("a lift out of the finger's reach is told", test_reach) &
         ]
   end subroutine collect_train

   !> Spring of 25 N/mm compressed by 8 mm, seat of 100 N over 0.02 mm.
   pure function sample_train() result(train)
      type(train_t) :: train

      train = train_t(0.04_wp, 5.0e-5_wp, 25.0e3_wp, 8.0e-3_wp, 100.0_wp, 2.0e-5_wp)
   end function sample_train

   !> A position with round numbers; what does not matter is zero.
   pure function sample_position(lift) result(position)
      real(wp), intent(in) :: lift
      type(position_t) :: position

      position = position_t(lift, 1.0e-2_wp, -2.0e-2_wp, 0.0_wp, 0.3_wp, -0.5_wp, 0.035_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
   end function sample_position

   subroutine test_seat(error)
      type(error_type), allocatable, intent(out) :: error
      type(train_t) :: train
      ! Lift [m], step [m]
      real(wp), parameter :: lifts(5) = [0.0_wp, 0.5e-5_wp, 1.0e-5_wp, 2.0e-5_wp, 1.0e-3_wp], step = 1.0e-11_wp

      train = sample_train()
      call check(error, all(abs(seat_force(train, lifts) - [100.0_wp, 56.25_wp, 25.0_wp, 0.0_wp, 0.0_wp]) <= 100.0_wp*roundings))
      if (allocated(error)) return
      call check(error, all(abs(unseated_share(train, lifts) - [0.0_wp, 0.4375_wp, 0.75_wp, 1.0_wp, 1.0_wp]) <= roundings))
      if (allocated(error)) return
      ! slope 2 S0/l_s (1 - l/l_s) = 1e7 N/m at the start; at the end the force is S0 (step/l_s)^2
      call check(error, (seat_force(train, 0.0_wp) - seat_force(train, step))/step, 1.0e7_wp, thr=1.0e-5_wp, rel=.true.)
      if (allocated(error)) return
      call check(error, seat_force(train, lifts(4) - step) < 1.0e-9_wp, "kink at the end")
   end subroutine test_seat

   subroutine test_no_seat(error)
      type(error_type), allocatable, intent(out) :: error
      type(train_t) :: train

      train%stiffness = 25.0e3_wp
      call check(error, abs(seat_force(train, 0.0_wp)) <= 0.0_wp .and. abs(unseated_share(train, 0.0_wp) - 1.0_wp) <= 0.0_wp)
   end subroutine test_no_seat

   subroutine test_moments(error)
      type(error_type), allocatable, intent(out) :: error
      type(moments_t) :: moments

      call evaluate_moments(sample_train(), sample_position(1.0e-5_wp), 100.0_wp, 200.0_wp, moments)
      ! 25e3 (0.00001 + 0.008) = 200.25 N; 25 N of the seat; 0.04 1e4 (-0.02) = -8 N; 5e-5 1e4 (-0.5) = -0.25 N m;
      ! 0.75 of 200 N, each but the finger's on 35 mm
      call check(error, moments%spring, 200.25_wp*0.035_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, moments%seat, 25.0_wp*0.035_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, moments%valve, -8.0_wp*0.035_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, moments%finger, -0.25_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, moments%gas, 150.0_wp*0.035_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, moments%total, (200.25_wp - 25.0_wp - 8.0_wp + 150.0_wp)*0.035_wp - 0.25_wp, thr=roundings, rel=.true.)
   end subroutine test_moments

   subroutine test_energy(error)
      type(error_type), allocatable, intent(out) :: error
      type(position_t) :: position

      position = sample_position(0.0_wp)
      position%lift_slope = 0.0_wp
      position%finger_slope = 0.0_wp
      call check(error, abs(stored_energy(sample_train(), position, 100.0_wp)) <= 0.0_wp, "closed and at rest")
      if (allocated(error)) return
      ! spring 25e3 0.005 (0.0025 + 0.008) = 1.3125 J; seat 100 2e-5/3; valve 0.02 1e4 1e-4 = 0.02 J;
      ! finger 2.5e-5 1e4 0.09 = 0.0225 J
      call check(error, stored_energy(sample_train(), sample_position(5.0e-3_wp), 100.0_wp), &
         1.3125_wp - 2.0e-3_wp/3.0_wp + 0.02_wp + 0.0225_wp, thr=roundings, rel=.true.)
   end subroutine test_energy

   !> A pressure table over one turn.
   subroutine make_table(gas)
      type(gas_force_t), intent(out) :: gas
      integer :: i

      gas%angle = [(-pi + i*two_pi/12, i=0, 12)]
      gas%pressure = 2.0e5_wp*(1.0_wp + sin(gas%angle))
      gas%pressure(13) = gas%pressure(1)
      gas%valve_area = 5.0e-4_wp
   end subroutine make_table

   subroutine test_gas(error)
      type(error_type), allocatable, intent(out) :: error
      type(gas_force_t) :: gas
      type(gas_law_t) :: law
      type(error_t), allocatable :: failure
      integer :: i, turn

      call make_table(gas)
      call new_gas_law(law, gas, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
      if (allocated(error)) return
      do i = 1, 13
         do turn = -1, 1
            ! a turn more or less costs some roundings of the angle
            call check(error, gas_force(law, gas%angle(i) + turn*two_pi), gas%pressure(i)*gas%valve_area, thr=1.0e-12_wp*200.0_wp)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_gas

   subroutine test_gas_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(gas_force_t) :: gas
      type(gas_law_t) :: law
      type(error_t), allocatable :: failure

      call new_gas_law(law, gas, failure)
      call check(error, said(failure, kind_deck, "as many pressures as angles"), "no table at all")
      if (allocated(error)) return
      call make_table(gas)
      gas%pressure = gas%pressure(:12)
      call new_gas_law(law, gas, failure)
      call check(error, said(failure, kind_deck, "as many pressures as angles"))
      if (allocated(error)) return
      call make_table(gas)
      gas%angle = 0.9_wp*gas%angle
      call new_gas_law(law, gas, failure)
      call check(error, said(failure, kind_deck, "must span one turn"))
      if (allocated(error)) return
      call make_table(gas)
      gas%angle(3:4) = gas%angle(4:3:-1)
      call new_gas_law(law, gas, failure)
      call check(error, allocated(failure), "a table out of order is taken")
   end subroutine test_gas_refusals

   !> Is there an error of a kind with these words?
   function said(failure, kind, words) result(it_was)
      type(error_t), allocatable, intent(in) :: failure
      integer, intent(in) :: kind
      character(len=*), intent(in) :: words
      logical :: it_was

      it_was = .false.
      if (allocated(failure)) it_was = failure%kind == kind .and. index(failure%message, words) > 0
   end function said

   subroutine test_ring(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, ring_inertia(0.01_wp, 8.0e-3_wp, 8.0e-3_wp), 0.01_wp*64.0e-6_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, ring_inertia(0.01_wp, 8.0e-3_wp, 0.0_wp), 0.005_wp*64.0e-6_wp, thr=roundings, rel=.true.)
   end subroutine test_ring

   subroutine test_spin(error)
      type(error_type), allocatable, intent(out) :: error

      ! ((5 - 1) 0.0085 - 0.004)/5e-7
      call check(error, spin_acceleration(5.0_wp, 1.0_wp, 8.5e-3_wp, 4.0e-3_wp, 5.0e-7_wp), 6.0e4_wp, thr=roundings, rel=.true.)
   end subroutine test_spin

   subroutine test_friction_radius(error)
      type(error_type), allocatable, intent(out) :: error
      type(needle_bearing_t) :: bearing

      bearing%needle_radius = 1.0e-3_wp
      call check(error, friction_radius(bearing, 6.0e-3_wp), 5.0e-3_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      bearing%kind = "plain_pin"
      call check(error, friction_radius(bearing, 6.0e-3_wp), 6.0e-3_wp, thr=roundings, rel=.true.)
   end subroutine test_friction_radius

   subroutine test_bearing(error)
      type(error_type), allocatable, intent(out) :: error

      call check(error, bearing_torque(0.0015_wp, 800.0_wp, 5.0e-3_wp, 60.0_wp, 0.3_wp), 6.0e-3_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, bearing_torque(0.0015_wp, 800.0_wp, 5.0e-3_wp, -60.0_wp, 0.3_wp), -6.0e-3_wp, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call check(error, abs(bearing_torque(0.0015_wp, 800.0_wp, 5.0e-3_wp, 0.0_wp, 0.3_wp)) <= 0.0_wp)
      if (allocated(error)) return
      ! a fifth of the cam's speed is twenty times the reversal's hundredth: 1 - tanh(20) = 8e-18
      call check(error, abs(tanh(20.0_wp) - 1.0_wp) <= epsilon(1.0_wp), "the sign is not yet exact")
   end subroutine test_bearing

   subroutine test_guide(error)
      type(error_type), allocatable, intent(out) :: error
      type(guide_part_t) :: part
      ! Drag over the speed of the valve, its slope [N s/m]
      real(wp) :: drag(3), slope(3)

      ! 0.1 pi 5e-3 0.04/2e-5 = pi
      call check(error, guide_drag_coefficient(0.1_wp, 0.04_wp, 5.0e-3_wp, 2.0e-5_wp), pi, thr=roundings, rel=.true.)
      if (allocated(error)) return
      call new_guide_part(part, valve_guide_t(length=0.04_wp, stem_diameter=5.0e-3_wp, radial_clearance=2.0e-5_wp))
      call set_guide_oil(part, 0.2_wp)
      call set_guide_oil(part, 0.1_wp)
      ! A film's shear: at any speed the force pi v
      call find_guide_drag(part, [-2.0_wp, 0.0_wp, 3.0_wp], drag, slope)
      call check(error, all(abs([drag, slope] - pi) <= roundings*pi), "drag and slope of a film's shear")
   end subroutine test_guide

   subroutine test_torque(error)
      type(error_type), allocatable, intent(out) :: error

      ! 500 0.02 0.3 + 4 0.018 + 2 1.5 0.005
      call check(error, cam_torque(500.0_wp, 0.02_wp, 0.3_wp, 4.0_wp, 0.018_wp, 1.5_wp, 5.0e-3_wp), 3.087_wp, thr=roundings, &
         rel=.true.)
      if (allocated(error)) return
      ! 4 0.05 + 1.5 (0.6 + 0.55)
      call check(error, contact_power(4.0_wp, 0.05_wp, 1.5_wp, 0.6_wp, 0.55_wp), 1.925_wp, thr=roundings, rel=.true.)
   end subroutine test_torque

   subroutine test_normal(error)
      type(error_type), allocatable, intent(out) :: error
      type(mechanism_t) :: mechanism
      type(linkage_t) :: linkage
      type(position_t) :: position
      type(error_t), allocatable :: failure
      ! Unit vectors [-], roller centre from the pivot [m]
      real(wp) :: normal(2), tangent(2), centre(2)
      integer :: status, i

      do i = 1, 2
         mechanism = sample_mechanism()
         if (i == 2) mechanism%rotation = "towards_pivot"
         call new_linkage(linkage, mechanism, failure)
         call evaluate_position(linkage, [4.0e-3_wp, 1.2e-2_wp, -1.0e-2_wp, 0.0_wp], position, status)
         call normal_direction(position%normal_arm, position%tangent_arm, linkage%a, position%arm_angle, linkage%sense, normal, &
            tangent)
         centre = linkage%a*[cos(position%arm_angle), sin(position%arm_angle)]
         call check(error, norm2(normal), 1.0_wp, thr=roundings)
         if (allocated(error)) return
         call check(error, norm2(tangent), 1.0_wp, thr=roundings)
         if (allocated(error)) return
         call check(error, abs(dot_product(normal, tangent)) <= roundings, "not upright on each other")
         if (allocated(error)) return
         call check(error, centre(1)*normal(2) - centre(2)*normal(1), position%normal_arm, thr=roundings, rel=.true.)
         if (allocated(error)) return
         call check(error, centre(1)*tangent(2) - centre(2)*tangent(1), linkage%sense*position%tangent_arm, thr=roundings, &
            rel=.true.)
         if (allocated(error)) return
         ! the moment of the tangential force at the contact about the cam centre, against the sense of rotation
         centre = centre - linkage%roller_radius*normal - [linkage%d, 0.0_wp]
         call check(error, linkage%sense*(centre(2)*tangent(1) - centre(1)*tangent(2)), position%cam_arm, thr=roundings, &
            rel=.true.)
         if (allocated(error)) return
      end do
   end subroutine test_normal

   !> To the last bit, since stops and margins would otherwise not be those of the states.
   subroutine test_moments_only(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(position_t) :: all_of_it, alone
      type(error_t), allocatable :: failure
      real(wp), parameter :: lift(0:3) = [4.0e-3_wp, 1.2e-2_wp, -1.0e-2_wp, 0.05_wp] ! [m/rad^n]
      integer :: status

      call new_linkage(linkage, sample_mechanism(), failure)
      call evaluate_position(linkage, lift, all_of_it, status)
      call evaluate_position(linkage, lift, alone, status, moments_only=.true.)
      alone%arm_angle = arm_angle_at(linkage, alone%lift)
      call check(error, all(transfer(listed(alone), [0_int64]) == transfer(listed(all_of_it), [0_int64])), "they differ")

   contains

      !> What moments take.
      pure function listed(position) result(values)
         !> The position
         type(position_t), intent(in) :: position
         real(wp) :: values(10) ! [any]

         values = [position%lift, position%lift_slope, position%lift_curvature, position%arm_angle, position%finger_slope, &
            & position%finger_curvature, position%valve_arm, position%normal_arm, position%parallel_arm, position%tangent_arm]
      end function listed
   end subroutine test_moments_only

   !> The thesis's mechanism.
   pure function sample_mechanism() result(mechanism)
      type(mechanism_t) :: mechanism

      mechanism = mechanism_t(pivot_to_roller=20.8e-3_wp, pivot_to_pad=35.5e-3_wp, pivot_to_cam=31.5e-3_wp, &
         & roller_arm_angle=-3.5_wp*degree, valve_axis_angle=37.5_wp*degree, base_radius=18.0e-3_wp, roller_radius=8.5e-3_wp, &
         & contact_width=13.7e-3_wp)
   end function sample_mechanism

   subroutine test_mechanism_refusals(error)
      type(error_type), allocatable, intent(out) :: error
      type(mechanism_t) :: mechanism
      type(linkage_t) :: linkage
      type(error_t), allocatable :: failure

      mechanism = sample_mechanism()
      mechanism%pivot_to_roller = -1.0e-3_wp
      call new_linkage(linkage, mechanism, failure)
      call check(error, said(failure, kind_domain, "every length must be positive"))
      if (allocated(error)) return
      mechanism = sample_mechanism()
      mechanism%pivot_to_cam = 60.0e-3_wp
      call new_linkage(linkage, mechanism, failure)
      call check(error, said(failure, kind_domain, "no closed triangle"))
      if (allocated(error)) return
      mechanism = sample_mechanism()
      mechanism%valve_axis_angle = 130.0_wp*degree
      call new_linkage(linkage, mechanism, failure)
      call check(error, said(failure, kind_domain, "wrong side of the valve's axis"))
      if (allocated(error)) return
      mechanism = sample_mechanism()
      mechanism%rotation = "clockwise"
      call new_linkage(linkage, mechanism, failure)
      call check(error, said(failure, kind_deck, "away_from_pivot"))
   end subroutine test_mechanism_refusals

   subroutine test_reach(error)
      type(error_type), allocatable, intent(out) :: error
      type(linkage_t) :: linkage
      type(position_t) :: position
      type(error_t), allocatable :: failure
      integer :: status

      call new_linkage(linkage, sample_mechanism(), failure)
      call evaluate_position(linkage, [9.5e-3_wp, 0.0_wp, 0.0_wp, 0.0_wp], position, status)
      call check(error, status, 0)
      if (allocated(error)) return
      call evaluate_position(linkage, [45.0e-3_wp, 0.0_wp, 0.0_wp, 0.0_wp], position, status)
      call check(error, status < 0, "a lift out of reach is taken")
   end subroutine test_reach

end module test_train
