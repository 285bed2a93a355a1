module camroller_dynamics
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: masses_t, spring_t, gas_force_t, seating_names, load_arm_names

   !> How the contact load passes from the base circle to the event
   character(len=*), parameter :: seating_names(*) = [character(len=name_length) :: "continuous", "maximum"]
   !> Arm of the contact normal about the pivot: exact, or with the normal taken parallel to the valve's axis
   character(len=*), parameter :: load_arm_names(*) = [character(len=name_length) :: "exact", "parallel"]

   !> Moving masses
   type :: masses_t
      !> Mass moving with the valve: valve, retainer, a third of the spring [kg]
      real(wp) :: valve = 0.0_wp
      !> Mass of the finger, taken at the pad [kg]; used where no inertia is given
      real(wp) :: finger = 0.0_wp
      !> Moment of inertia of the finger about its pivot [kg m^2]; zero where not given
      real(wp) :: finger_inertia = 0.0_wp
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
      !> Cam angle from full lift, one cycle, increasing [rad]
      real(wp), allocatable :: angle(:)
      !> Gauge pressure that presses the valve shut [Pa]
      real(wp), allocatable :: pressure(:)
      !> Area of the valve head [m^2]
      real(wp) :: valve_area = 0.0_wp
   end type gas_force_t

end module camroller_dynamics
