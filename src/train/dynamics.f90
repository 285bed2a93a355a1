!> Moments about the finger's pivot that press the roller onto the cam.
!>
!> In: position, masses, spring, seat, gas force, cam speed. Out: the single moments and the stored energy. Sources: Ball (1988);
!> Islam (2019) eqs. (16)-(22). Our own, derived in `doc/theory.md`: the share of the seat, and the gas force.
module camroller_dynamics
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   use camroller_kinematics, only : position_t
   implicit none
   private

   public :: masses_t, spring_t, gas_force_t, train_t, moments_t, seating_names, load_arm_names
   public :: seat_force, unseated_share, evaluate_moments, moment_slope, stored_energy, stored_power
   public :: add_acceleration, acceleration_slope, speed_slope_of_moments, kinetic_energy

   !> How the contact load passes from the base circle to the event
   character(len=*), parameter :: seating_names(*) = [character(len=name_length) :: "continuous", "maximum"]
   !> Arm of the contact normal about the pivot: exact, or with the normal taken parallel to the valve's axis
   character(len=*), parameter :: load_arm_names(*) = [character(len=name_length) :: "exact", "parallel"]

   !> Moving masses
   type :: masses_t
      !> Mass moving with the valve: valve, retainer, a third of the spring [kg]
      real(wp) :: valve = 0.0_wp
      !> Mass of the finger with its roller [kg]; taken at the pad for its inertia where none is given; zero where not given
      real(wp) :: finger = 0.0_wp
      !> Moment of inertia of the finger about its pivot [kg m^2]; zero where not given
      real(wp) :: finger_inertia = 0.0_wp
      !> Distance from the pivot to the finger's centre of mass, on the roller arm [m]; where it is zero 20 mm, or the radius of
      !> gyration if that is less
      real(wp) :: finger_centre = 0.0_wp
   end type masses_t

   !> Valve spring, seat and lash adjuster
   type :: spring_t
      !> Stiffness of the valve spring [N/m]
      real(wp) :: stiffness = 0.0_wp
      !> Compression of the spring with the valve closed [m]
      real(wp) :: precompression = 0.0_wp
      !> Contact load on the base circle, set by the lash adjuster [N]
      real(wp) :: base_circle_load = 0.0_wp
      !> One of `seating_names`
      character(len=name_length) :: seating = "continuous"
      !> Stiffness of train and seat seen at the valve [N/m]
      real(wp) :: seat_stiffness = 1.0e7_wp
      !> One of `load_arm_names`
      character(len=name_length) :: load_arm = "exact"
   end type spring_t

   !> Cylinder pressure on the valve
   type :: gas_force_t
      !> Cam angle from full lift, of the first lobe shape where an engine ties the shapes together, one cycle, increasing [rad]
      real(wp), allocatable :: angle(:)
      !> Gauge pressure that presses the valve shut [Pa]
      real(wp), allocatable :: pressure(:)
      !> Area of the valve head [m^2]
      real(wp) :: valve_area = 0.0_wp
      !> Area of the head of a valve that the second lobe shape lifts; not allocated where it is the same [m^2]
      real(wp), allocatable :: second_valve_area
   end type gas_force_t

   !> Masses and stiffnesses made ready for evaluation
   type :: train_t
      !> Mass at the valve [kg]
      real(wp) :: valve_mass = 0.0_wp
      !> Inertia of the finger about its pivot [kg m^2]
      real(wp) :: finger_inertia = 0.0_wp
      !> Spring stiffness [N/m]
      real(wp) :: stiffness = 0.0_wp
      !> Spring compression with the valve closed [m]
      real(wp) :: precompression = 0.0_wp
      !> Force between closed valve and seat, S0 [N]; zero where the seat plays no part
      real(wp) :: closed_seat_force = 0.0_wp
      !> Lift at which the valve has left its seat, l_s = 2 S0/K_s [m]; zero where the seat plays no part
      real(wp) :: seat_lift = 0.0_wp
   end type train_t

   !> Moments about the pivot, positive where they press the roller on the cam
   type :: moments_t
      !> Spring [N m]
      real(wp) :: spring
      !> Seat, to be subtracted [N m]
      real(wp) :: seat
      !> Valve inertia [N m]
      real(wp) :: valve
      !> Finger inertia [N m]
      real(wp) :: finger
      !> Gas force [N m]
      real(wp) :: gas
      !> Sum of all with their signs [N m]
      real(wp) :: total
   end type moments_t

contains

   !> Force of the seat on the valve, `S0 (1 - l/l_s)^2` for l < l_s, else zero.
   elemental function seat_force(train, lift) result(force)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Valve lift [m]
      real(wp), intent(in) :: lift
      !> Seat force [N]
      real(wp) :: force

      force = train%closed_seat_force*(1.0_wp - unseated_share(train, lift))
   end function seat_force

   !> Does the seat carry part of the valve's load? Never where it plays no part, even for a curve that dips below zero lift.
   elemental function is_seated(train, lift) result(seated)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Valve lift [m]
      real(wp), intent(in) :: lift
      !> True where it does
      logical :: seated

      seated = train%seat_lift > 0.0_wp .and. lift < train%seat_lift
   end function is_seated

   !> Part of the closed-valve forces that has passed from the seat to the train, `1 - (1 - l/l_s)^2`.
   elemental function unseated_share(train, lift) result(share)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Valve lift [m]
      real(wp), intent(in) :: lift
      !> Part between zero and one [-]
      real(wp) :: share

      share = 1.0_wp
      if (is_seated(train, lift)) share = lift/train%seat_lift*(2.0_wp - lift/train%seat_lift)
   end function unseated_share

   !> Moments about the pivot at one position.
   pure subroutine evaluate_moments(train, position, speed, gas_force, moments)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> Cylinder pressure times valve area; zero without gas force [N]
      real(wp), intent(in) :: gas_force
      !> Moments, each apart
      type(moments_t), intent(out) :: moments

      moments%spring = train%stiffness*(position%lift + train%precompression)*position%valve_arm
      moments%seat = seat_force(train, position%lift)*position%valve_arm
      moments%valve = train%valve_mass*speed**2*position%lift_curvature*position%valve_arm
      moments%finger = train%finger_inertia*speed**2*position%finger_curvature
      moments%gas = gas_force*unseated_share(train, position%lift)*position%valve_arm
      moments%total = moments%spring - moments%seat + moments%valve + moments%finger + moments%gas
   end subroutine evaluate_moments

   !> Add what a cam that gains speed asks of the masses.
   pure subroutine add_acceleration(train, position, acceleration, moments)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Angular acceleration of the cam [rad/s^2]
      real(wp), intent(in) :: acceleration
      !> Moments at a steady speed; out: at this acceleration
      type(moments_t), intent(inout) :: moments

      ! Moments of valve and finger [N m]
      real(wp) :: valve, finger

      valve = train%valve_mass*acceleration*position%lift_slope*position%valve_arm
      finger = train%finger_inertia*acceleration*position%finger_slope
      moments%valve = moments%valve + valve
      moments%finger = moments%finger + finger
      moments%total = moments%total + valve + finger
   end subroutine add_acceleration

   !> Derivative of those moments with respect to the cam angle at a constant acceleration.
   pure function acceleration_slope(train, position, acceleration) result(slope)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Angular acceleration of the cam [rad/s^2]
      real(wp), intent(in) :: acceleration
      !> Derivative [N m/rad]
      real(wp) :: slope

      slope = acceleration*(train%valve_mass*(position%lift_curvature*position%valve_arm &
         & + position%lift_slope*position%valve_arm_slope) + train%finger_inertia*position%finger_curvature)
   end function acceleration_slope

   !> Derivative of the moments of the masses over the cam speed, with the acceleration `omega omega'` that goes with it.
   pure function speed_slope_of_moments(train, position, speed, speed_slope) result(slope)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed [rad/s], its change with the cam angle, omega' [rad/s/rad]
      real(wp), intent(in) :: speed, speed_slope
      !> Derivative [N m s]
      real(wp) :: slope

      slope = train%valve_mass*position%valve_arm*(2.0_wp*speed*position%lift_curvature + speed_slope*position%lift_slope) &
         & + train%finger_inertia*(2.0_wp*speed*position%finger_curvature + speed_slope*position%finger_slope)
   end function speed_slope_of_moments

   !> Energy of the moving masses without the roller's spin, `m omega^2 l'^2/2 + I_f omega^2 gamma'^2/2`.
   elemental function kinetic_energy(train, position, speed) result(energy)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> Energy [J]
      real(wp) :: energy

      energy = 0.5_wp*speed**2*(train%valve_mass*position%lift_slope**2 + train%finger_inertia*position%finger_slope**2)
   end function kinetic_energy

   !> Derivative of the sum of the moments with respect to the cam angle.
   pure function moment_slope(train, position, speed, gas_force, gas_slope) result(slope)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> Cylinder pressure times valve area [N], and its derivative with respect to the cam angle [N/rad]
      real(wp), intent(in) :: gas_force, gas_slope
      !> Derivative [N m/rad]
      real(wp) :: slope

      ! Force at the valve [N], its derivative with respect to the cam angle [N/rad]
      real(wp) :: force, force_slope
      ! Derivative of the unseated share with respect to the lift [1/m]
      real(wp) :: share_slope

      share_slope = 0.0_wp
      if (is_seated(train, position%lift)) share_slope = 2.0_wp*(1.0_wp - position%lift/train%seat_lift)/train%seat_lift
      force = train%stiffness*(position%lift + train%precompression) - seat_force(train, position%lift) &
         & + train%valve_mass*speed**2*position%lift_curvature + gas_force*unseated_share(train, position%lift)
      force_slope = (train%stiffness + (train%closed_seat_force + gas_force)*share_slope)*position%lift_slope &
         & + train%valve_mass*speed**2*position%lift_jerk + gas_slope*unseated_share(train, position%lift)
      slope = force_slope*position%valve_arm + force*position%valve_arm_slope + train%finger_inertia*speed**2*position%finger_jerk
   end function moment_slope

   !> Energy stored in spring, seat and moving masses without the roller's spin, zero for the closed valve at rest.
   !>
   !> `k l (l/2 + delta) - int_0^l F_seat dl + m omega^2 l'^2/2 + I_f omega^2 gamma'^2/2`.
   elemental function stored_energy(train, position, speed) result(energy)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> Energy [J]
      real(wp) :: energy

      ! Part of the seat's travel that is left, 1 - l/l_s [-]
      real(wp) :: left

      left = 0.0_wp
      if (is_seated(train, position%lift)) left = 1.0_wp - position%lift/train%seat_lift
      energy = train%stiffness*position%lift*(0.5_wp*position%lift + train%precompression) &
         & - train%closed_seat_force*train%seat_lift/3.0_wp*(1.0_wp - left**3) + kinetic_energy(train, position, speed)
   end function stored_energy

   !> Rate of change of `stored_energy`, plus the work done on the gas.
   !>
   !> `omega l' (k (l + delta) - F_seat + F_gas + m omega^2 l'') + I_f omega^3 gamma' gamma''`.
   elemental function stored_power(train, position, speed, gas_force) result(power)
      !> Masses and stiffnesses
      type(train_t), intent(in) :: train
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Cam speed, omega [rad/s]
      real(wp), intent(in) :: speed
      !> Cylinder pressure times valve area [N]
      real(wp), intent(in) :: gas_force
      !> Power that goes into store and gas [W]
      real(wp) :: power

      power = speed*position%lift_slope*(train%stiffness*(position%lift + train%precompression) &
         & - seat_force(train, position%lift) + gas_force*unseated_share(train, position%lift) &
         & + train%valve_mass*speed**2*position%lift_curvature) &
         & + train%finger_inertia*speed**3*position%finger_slope*position%finger_curvature
   end function stored_power

end module camroller_dynamics
