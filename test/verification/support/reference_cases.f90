!> Cases built by hand for verification: the valve train of Islam (2019), Appendix B, and an asymmetric one of our own.
!>
!> Appendix B is taken with a spring of 25 000 N/m and a guide clearance of 0.02 mm, each ten times the printed value, and with an
!> assumed lift of 9.5 mm.
module reference_cases
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t, new_model
   use camroller_sliding_friction, only : sliding_t
   use camroller_cycle, only : cycle_t, integrate_cycle
   implicit none
   private

   public :: thesis_case, source_case, skewed_case, named_case, make_model, make_cycle, set_point, add_gas_force, add_joints, &
      & add_boundary_law, add_heat, add_pin_film, add_skf_needles, add_profile
   public :: point_speeds, point_viscosities

   !> Speeds of the nine operating points [rad/s]
   real(wp), parameter :: point_speeds(3) = [300.0_wp, 600.0_wp, 900.0_wp]*pi/30.0_wp
   !> Viscosities of the nine operating points: 25, 60 and 95 degC [Pa s]
   real(wp), parameter :: point_viscosities(3) = [0.15_wp, 0.0305_wp, 0.01_wp]
   !> Half angle of the skewed lift [rad]
   real(wp), parameter :: skewed_half_angle = 55.0_wp*degree
   !> Rows of the table of the skewed lift: every quarter of a degree
   integer, parameter :: skewed_rows = 441

contains

   !> The valve train of Islam (2019) with a closed energy balance, without camshaft bearings.
   function thesis_case() result(the_case)
      !> The case at 300 rev/min and 95 degC
      type(case_t) :: the_case

      the_case%title = "thesis"
      the_case%mechanism%pivot_to_roller = 20.8e-3_wp
      the_case%mechanism%pivot_to_pad = 35.5e-3_wp
      the_case%mechanism%pivot_to_cam = 31.5e-3_wp
      the_case%mechanism%roller_arm_angle = -3.5_wp*degree
      the_case%mechanism%valve_axis_angle = 37.5_wp*degree
      the_case%mechanism%base_radius = 18.0e-3_wp
      the_case%mechanism%roller_radius = 8.5e-3_wp
      the_case%mechanism%contact_width = 13.7e-3_wp
      the_case%lift%law = "power"
      the_case%lift%exponents = [4]
      the_case%lift%max_lift = 9.5e-3_wp
      the_case%lift%opening_half_angle = 70.0_wp*degree
      the_case%lift%closing_half_angle = 70.0_wp*degree
      the_case%masses%valve = 0.0432_wp
      the_case%masses%finger = 0.0418_wp
      the_case%spring%stiffness = 25.0e3_wp
      the_case%spring%precompression = 8.4e-3_wp
      the_case%spring%base_circle_load = 64.0_wp
      the_case%spring%seat_stiffness = 1.0e7_wp
      the_case%materials%cam_modulus = 170.0e9_wp
      the_case%materials%cam_poisson_ratio = 0.28_wp
      the_case%materials%roller_modulus = 204.0e9_wp
      the_case%materials%roller_poisson_ratio = 0.29_wp
      the_case%materials%hardness = 2.0e9_wp
      the_case%surface%cam_roughness = 0.14e-6_wp
      the_case%surface%roller_roughness = 0.14e-6_wp
      the_case%lubricant%pressure_viscosity = 2.2e-8_wp
      the_case%roller%mass = 0.0088_wp
      the_case%roller%wall_thickness = 2.4e-3_wp
      call add_effects(the_case)
      call set_point(the_case, point_speeds(1), point_viscosities(3))
      the_case%numerics%method = "hermite"
      the_case%numerics%tolerance = 1.0e-6_wp
   end function thesis_case

   !> Asperities, needle bearing and valve guide of Islam (2019).
   subroutine add_effects(the_case)
      !> The case
      type(case_t), intent(inout) :: the_case

      allocate (the_case%asperity, the_case%needle_bearing, the_case%valve_guide)
      the_case%asperity%boundary_coefficient = 0.2_wp
      the_case%needle_bearing%friction_coefficient = 0.0015_wp
      the_case%needle_bearing%needle_radius = 0.99e-3_wp
      the_case%valve_guide%length = 36.0e-3_wp
      the_case%valve_guide%stem_diameter = 5.0e-3_wp
      the_case%valve_guide%radial_clearance = 0.02e-3_wp
   end subroutine add_effects

   !> Speed and viscosity.
   subroutine set_point(the_case, speed, viscosity)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Viscosity [Pa s]
      real(wp), intent(in) :: viscosity

      the_case%operating_point%speed = speed
      the_case%operating_point%oil_temperature = 333.15_wp
      the_case%lubricant%temperature_law = "direct"
      the_case%lubricant%viscosity = viscosity
   end subroutine set_point

   !> The same with the bookkeeping of the thesis.
   function source_case() result(the_case)
      !> The case at 300 rev/min and 95 degC
      type(case_t) :: the_case

      the_case = thesis_case()
      the_case%energy = "source"
      the_case%spring%load_arm = "parallel"
      the_case%roller%spin = "thesis"
      the_case%asperity%boundary = "full"
      the_case%traction%rolling_law = "goksem_hargreaves"
   end function source_case

   !> Another geometry, with hollow flanks and an asymmetric lift `9 mm (1 - x^2)^3 (1 + 0.1 x)`, x = angle/55 deg, as a table.
   function skewed_case(rotation) result(the_case)
      !> Sense of rotation
      character(len=*), intent(in) :: rotation
      !> The case at 600 rev/min and 60 degC
      type(case_t) :: the_case

      ! Part of the half angle [-]
      real(wp) :: x(skewed_rows)
      integer :: i

      the_case = thesis_case()
      the_case%title = "skewed"
      the_case%mechanism%pivot_to_roller = 24.0e-3_wp
      the_case%mechanism%pivot_to_pad = 42.0e-3_wp
      the_case%mechanism%pivot_to_cam = 37.0e-3_wp
      the_case%mechanism%roller_arm_angle = 5.0_wp*degree
      the_case%mechanism%valve_axis_angle = 30.0_wp*degree
      the_case%mechanism%base_radius = 17.0e-3_wp
      the_case%mechanism%roller_radius = 9.0e-3_wp
      the_case%mechanism%rotation = rotation
      x = [(real(2*i, wp)/real(skewed_rows - 1, wp) - 1.0_wp, i=0, skewed_rows - 1)]
      the_case%lift%law = "table"
      the_case%lift%table_angle = x*skewed_half_angle
      the_case%lift%table_lift = 9.0e-3_wp*((1.0_wp - x)*(1.0_wp + x))**3*(1.0_wp + 0.1_wp*x)
      call set_point(the_case, point_speeds(2), point_viscosities(2))
   end function skewed_case

   !> The case that a row of the cycle reference belongs to.
   function named_case(name) result(the_case)
      !> Name in the table
      character(len=*), intent(in) :: name
      !> The case
      type(case_t) :: the_case

      select case (name)
      case ("source_hot_slow")
         the_case = source_case()
      case ("skewed_reversed")
         the_case = skewed_case("towards_pivot")
      case default
         the_case = thesis_case()
         if (name == "warm") call set_point(the_case, point_speeds(2), point_viscosities(2))
         if (name == "cold_fast") call set_point(the_case, point_speeds(3), point_viscosities(1))
      end select
   end function named_case

   !> A cylinder pressure that rises and falls before and while the valve opens.
   subroutine add_gas_force(the_case)
      !> The case
      type(case_t), intent(inout) :: the_case

      ! Rows of the table: every five degrees
      integer, parameter :: rows = 73
      integer :: i

      allocate (the_case%gas_force)
      the_case%gas_force%angle = [(real(5*i - 180, wp)*degree, i=0, rows - 1)]
      the_case%gas_force%pressure = 4.0e5_wp*(1.0_wp + cos(the_case%gas_force%angle + 1.1_wp))**3/8.0_wp
      the_case%gas_force%pressure(rows) = the_case%gas_force%pressure(1)
      the_case%gas_force%valve_area = 6.0e-4_wp
   end subroutine add_gas_force

   !> Friction at valve tip, stem seal, ends of the guide and pivot, as `joint_reference.csv` has it, or by Stribeck's curve.
   subroutine add_joints(the_case, law)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Law of the coefficients
      character(len=*), intent(in) :: law

      allocate (the_case%valve_tip, the_case%stem_seal, the_case%guide_side_load, the_case%finger_pivot)
      the_case%valve_tip%pad_radius = 8.0e-3_wp
      the_case%valve_tip%sliding = sliding_t(law, 0.1_wp, 0.05_wp, 0.02_wp, 0.01_wp, 300.0_wp)
      the_case%stem_seal%lip_force = 8.0_wp
      the_case%guide_side_load%guide_length = 36.0e-3_wp
      the_case%guide_side_load%tip_height = 25.0e-3_wp
      the_case%guide_side_load%stem_axis = 34.0e-3_wp
      the_case%guide_side_load%sliding = sliding_t(law, 0.08_wp, 0.2_wp, 0.01_wp, 0.01_wp, 20.0_wp)
      the_case%finger_pivot%ball_radius = 5.0e-3_wp
      the_case%finger_pivot%sliding = sliding_t(law, 0.12_wp, 0.01_wp, 0.1_wp, 0.01_wp, 300.0_wp)
      if (law == "constant") return
      the_case%stem_seal%viscous_drag = 10.0_wp
      the_case%stem_seal%reference_viscosity = 0.01_wp
   end subroutine add_joints

   !> Heat in inlet and contact, with an oil that thins as SAE 30 at 60 degC does.
   subroutine add_heat(the_case)
      !> The case
      type(case_t), intent(inout) :: the_case

      allocate (the_case%heat)
      the_case%heat%viscosity_fall = 0.04_wp
      the_case%heat%limit_fall = 2.0e-3_wp
      the_case%heat%conductivity(2) = 20.0_wp
   end subroutine add_heat

   !> A plain pin with an oil film, on which asperities touch at the hot points.
   subroutine add_pin_film(the_case, law)
      !> The case
      type(case_t), intent(inout) :: the_case
      !> Law of its film
      character(len=*), intent(in) :: law

      associate (bearing => the_case%needle_bearing)
         bearing%kind = "journal"
         bearing%friction_coefficient = 0.1_wp
         bearing%film%law = law
         bearing%film%width = 9.0e-3_wp
         bearing%film%radial_clearance = 20.0e-6_wp
         bearing%film%roughness = 0.3e-6_wp
         bearing%film%modulus = 110.0e9_wp
      end associate
   end subroutine add_pin_film

   !> Needles by SKF's model, with the constants of full complements of cylindrical rollers.
   subroutine add_skf_needles(the_case)
      !> The case, with needles
      type(case_t), intent(inout) :: the_case

      the_case%needle_bearing%kind = "needles_skf"
      the_case%needle_bearing%friction_coefficient = 0.12_wp
      the_case%needle_bearing%skf%rolling = 2.13e-6_wp
      the_case%needle_bearing%skf%sliding = 0.0015_wp
      the_case%needle_bearing%skf%geometry = 6.2_wp
   end subroutine add_skf_needles

   !> Boundary friction that follows sliding speed and temperature, or a table of both.
   subroutine add_boundary_law(the_case, law)
      !> The case, with asperities
      type(case_t), intent(inout) :: the_case
      !> Name of the law
      character(len=*), intent(in) :: law

      allocate (the_case%boundary_law)
      associate (boundary => the_case%boundary_law)
         boundary%law = law
         boundary%reference_speed = 0.1_wp
         boundary%reference_temperature = 360.0_wp
         boundary%change_per_decade = 0.01_wp
         boundary%temperature_slope = 2.0e-4_wp
         boundary%lowest_speed = 1.0e-4_wp
         if (law /= "table") return
         boundary%speed_points = [1.0e-3_wp, 3.0e-2_wp, 1.0_wp]
         boundary%temperature_points = [290.0_wp, 350.0_wp, 390.0_wp, 450.0_wp]
         boundary%coefficient_points = [0.10_wp, 0.11_wp, 0.13_wp, 0.12_wp, 0.09_wp, 0.10_wp, 0.11_wp, 0.12_wp, 0.12_wp, 0.12_wp, &
            & 0.14_wp, 0.15_wp]
      end associate
   end subroutine add_boundary_law

   !> A crowned roller that stands askew.
   subroutine add_profile(the_case)
      !> The case
      type(case_t), intent(inout) :: the_case

      allocate (the_case%roller_profile)
      the_case%roller_profile%profile = "crowned"
      the_case%roller_profile%crown_radius = 2.0_wp
      the_case%roller_profile%tilt = 4.0e-4_wp
   end subroutine add_profile

   !> Model of a case.
   subroutine make_model(the_case, model, error)
      !> The case
      type(case_t), intent(in) :: the_case
      !> Its model
      type(model_t), intent(out) :: model
      !> The case was refused
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: failure

      call new_model(model, the_case, 1, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine make_model

   !> Periodic cycle of a model.
   subroutine make_cycle(the_case, model, cycle, error)
      !> The case
      type(case_t), intent(in) :: the_case
      !> Its model
      type(model_t), intent(in), target :: model
      !> Its cycle
      type(cycle_t), intent(out) :: cycle
      !> No periodic solution
      type(error_type), allocatable, intent(out) :: error

      type(error_t), allocatable :: failure

      call integrate_cycle(cycle, model, the_case%numerics, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine make_cycle

end module reference_cases
