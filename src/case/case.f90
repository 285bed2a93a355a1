!> A case: everything that defines one run, as plain validated numbers in SI units.
!>
!> In: component types of the sub-models. Out: `case_t`. An optional effect is an allocatable component:
!> allocated means that it is part of the case. `new_model` checks the laws of a case that was made by
!> hand and what ties its components to each other, `check_case` each number against the range that decks allow.
module camroller_case
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length
   use camroller_ode_methods, only : ode_method_names => method_names
   use camroller_lift, only : lift_t
   use camroller_kinematics, only : mechanism_t
   use camroller_dynamics, only : masses_t, spring_t, gas_force_t, seating_names, load_arm_names
   use camroller_materials, only : materials_t, surface_t
   use camroller_lubricant, only : lubricant_t
   use camroller_ehl_table, only : ehl_t
   use camroller_film, only : film_t
   use camroller_asperity, only : asperity_t, boundary_names, friction_modifier_t
   use camroller_boundary_law, only : boundary_law_t
   use camroller_tribofilm, only : running_in_t, tribofilm_t
   use camroller_wear, only : wear_t
   use camroller_traction, only : traction_t
   use camroller_heat, only : heat_t
   use camroller_needle, only : needle_bearing_t
   use camroller_needle_drag, only : needle_drag_t
   use camroller_guide, only : valve_guide_t
   use camroller_stem_friction, only : valve_tip_t, stem_seal_t, guide_side_load_t
   use camroller_pivot_friction, only : finger_pivot_t
   use camroller_roller, only : roller_t, spin_names
   use camroller_roller_profile, only : roller_profile_t
   use camroller_journal, only : cam_bearings_t
   use camroller_bearing_asperity, only : bearing_asperity_t
   use camroller_bearing_heat, only : bearing_heat_t
   use camroller_bearing_loads, only : belt_pull_t
   use camroller_shaft_drag, only : shaft_drag_t
   use camroller_engine, only : engine_t, lobe_lag
   use camroller_flexible_parts, only : dynamics_t
   use camroller_spring_modes, only : spring_surge_t
   use camroller_lash_adjuster, only : lash_adjuster_t
   implicit none
   private

   public :: case_t, operating_point_t, numerics_t, selection_t, camshaft_number, has_engine, gas_force_of, check_bookkeeping, &
      & energy_names, energy_source, contact_policy_names, quasi_static, method_choices, automatic_method, select_names, &
      & select_listed, select_needed, quantity_names, quantity_torque, quantity_film, quantity_slip

   !> Name of the model that takes the roller's spin from its quasi-static balance
   character(len=name_length), parameter :: quasi_static = "quasi_static"
   !> Ways to find the roller's spin: the integration methods, and the quasi-static limit
   character(len=name_length), parameter :: method_names(*) = [ode_method_names, quasi_static]
   !> Bookkeeping of forces and losses: closed energy balance, or as in the source thesis
   character(len=*), parameter :: energy_names(*) = [character(len=name_length) :: "consistent", "source"]
   !> Position of that of the thesis
   integer, parameter :: energy_source = 2
   !> What to do where cam and roller lose contact: a remark, or no result
   character(len=*), parameter :: contact_policy_names(*) = [character(len=name_length) :: "warn", "stop"]

   !> Let the program choose the method
   character(len=*), parameter :: automatic_method = "automatic"
   !> Methods that a case can name
   character(len=*), parameter :: method_choices(*) = [character(len=name_length) :: automatic_method, method_names]

   !> Effects that take part: all that are listed, or those of them that matter
   character(len=*), parameter :: select_names(*) = [character(len=name_length) :: "listed", "needed"]
   !> Positions in `select_names`
   integer, parameter :: select_listed = 1, select_needed = 2
   !> What an effect has to matter for: mean torque for all losses, smallest film of the cycle, slip per revolution
   character(len=*), parameter :: quantity_names(*) = [character(len=name_length) :: "mean_torque", "minimum_film", "slip"]
   !> Positions in `quantity_names`
   integer, parameter :: quantity_torque = 1, quantity_film = 2, quantity_slip = 3

   !> Which effects take part
   type :: selection_t
      !> One of `select_names`
      character(len=name_length) :: select = "listed"
      !> Relative change of the quantity that all effects left out may make together [-]
      real(wp) :: negligible = 1.0e-3_wp
      !> One of `quantity_names`
      character(len=name_length) :: quantity = "mean_torque"
   end type selection_t

   !> Speed and temperature
   type :: operating_point_t
      !> Speed of the camshaft [rad/s]
      real(wp) :: speed = 0.0_wp
      !> Temperature of the oil [K]
      real(wp) :: oil_temperature = 0.0_wp
   end type operating_point_t

   !> How the case is integrated and reported
   type :: numerics_t
      !> Error allowed: of the sliding speed relative to its largest value, of each mean relative to its mean magnitude, of smallest
      !> and largest values relative to their range [-]
      real(wp) :: accuracy = 1.0e-4_wp
      !> One of `method_choices`
      character(len=name_length) :: method = automatic_method
      !> Error of a step relative to the largest sliding speed; follows from the accuracy where zero [-]
      real(wp) :: tolerance = 0.0_wp
      !> Cam angle of a step [rad]; method `euler`
      real(wp) :: step = degree
      !> Largest difference between start and end of the reported cycle, relative to the largest sliding speed, beside a tolerance,
      !> a tenth of which is enough; follows from the accuracy without one [-]
      real(wp) :: periodicity = 1.0e-6_wp
      !> Cycles after which a case that is not periodic is given up
      integer :: max_cycles = 20
      !> Cam angle between reported points [rad]
      real(wp) :: output_step = 0.5_wp*degree
   end type numerics_t

   !> One case
   type :: case_t
      !> One line that says what the case is
      character(len=:), allocatable :: title
      !> One of `energy_names`
      character(len=name_length) :: energy = "consistent"
      !> One of `contact_policy_names`
      character(len=name_length) :: contact_policy = "warn"
      type(operating_point_t) :: operating_point
      type(mechanism_t) :: mechanism
      type(lift_t) :: lift
      !> Lift of the camshaft's second lobe shape
      type(lift_t), allocatable :: second_lift
      type(masses_t) :: masses
      type(spring_t) :: spring
      type(gas_force_t), allocatable :: gas_force
      type(materials_t) :: materials
      type(surface_t) :: surface
      type(lubricant_t) :: lubricant
      type(roller_t) :: roller
      !> Load along the roller; without it the same everywhere
      type(roller_profile_t), allocatable :: roller_profile
      type(film_t) :: film
      type(traction_t) :: traction
      !> Heat in inlet and contact
      type(heat_t), allocatable :: heat
      type(asperity_t), allocatable :: asperity
      !> Additive of the oil; of no effect without asperities
      type(friction_modifier_t), allocatable :: friction_modifier
      !> Law of the boundary coefficient; without it, or without asperities, it is constant
      type(boundary_law_t), allocatable :: boundary_law
      !> Wear of cam and roller; a film that grows on them, and the hours in which both change the surfaces before the cycle that is
      !> the result; of no effect without asperities
      type(wear_t), allocatable :: wear
      type(tribofilm_t), allocatable :: tribofilm
      type(running_in_t), allocatable :: running_in
      type(needle_bearing_t), allocatable :: needle_bearing
      type(needle_drag_t), allocatable :: needle_drag
      !> Numerical film in place of the film law
      type(ehl_t), allocatable :: ehl
      type(valve_guide_t), allocatable :: valve_guide
      !> Friction at valve tip, stem seal, ends of the guide and pivot
      type(valve_tip_t), allocatable :: valve_tip
      type(stem_seal_t), allocatable :: stem_seal
      type(guide_side_load_t), allocatable :: guide_side_load
      type(finger_pivot_t), allocatable :: finger_pivot
      type(cam_bearings_t), allocatable :: cam_bearings
      !> Mixed friction in these bearings, pull of the belt or chain on each camshaft, heat balance, torque of seals and drive; of
      !> no effect without bearings
      type(bearing_asperity_t), allocatable :: bearing_asperity
      type(belt_pull_t), allocatable :: belt_pull
      type(bearing_heat_t), allocatable :: bearing_heat
      type(shaft_drag_t), allocatable :: shaft_drag
      !> Engine that the camshafts belong to; of no effect without their bearings
      type(engine_t), allocatable :: engine
      !> A train that bends and leaves contact; with it, a spring that surges and a hydraulic lash adjuster
      type(dynamics_t), allocatable :: dynamics
      type(spring_surge_t), allocatable :: spring_surge
      type(lash_adjuster_t), allocatable :: lash_adjuster
      type(selection_t) :: effects
      type(numerics_t) :: numerics
   end type case_t

contains

   !> Number of camshafts.
   pure function camshaft_number(case) result(number)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: number

      number = 1
      if (.not. allocated(case%cam_bearings)) return
      if (allocated(case%cam_bearings%cam_shafts)) number = maxval(case%cam_bearings%cam_shafts)
   end function camshaft_number

   !> Do the camshafts of a case belong to an engine?
   pure function has_engine(case) result(verdict)
      !> The case
      type(case_t), intent(in) :: case
      !> Do they?
      logical :: verdict

      verdict = allocated(case%engine) .and. allocated(case%cam_bearings)
   end function has_engine

   !> Cylinder pressure as the follower of a lobe shape feels it: over its own cam angle, on its own valve.
   !>
   !> All valves of a cylinder feel its pressure at the same crank angle. A lobe shape whose full lift follows that of the first by
   !> some cam angle therefore meets each row of the table as much earlier, counted from its own full lift.
   pure subroutine gas_force_of(case, lobe, gas)
      !> The case, with gas force
      type(case_t), intent(in) :: case
      !> The lobe shape
      integer, intent(in) :: lobe
      !> Table and area
      type(gas_force_t), intent(out) :: gas

      gas = case%gas_force
      if (lobe == 1) return
      if (allocated(gas%second_valve_area)) gas%valve_area = gas%second_valve_area
      if (has_engine(case) .and. allocated(gas%angle)) gas%angle = gas%angle - lobe_lag(case%engine, lobe)
   end subroutine gas_force_of

   !> A closed energy balance needs the exact arm and spin, mobilised friction and rolling resistance in the roller's balance.
   subroutine check_bookkeeping(case, error)
      !> A case
      type(case_t), intent(in) :: case
      !> Deck error that names every contradiction
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: clashes

      if (case%energy /= energy_names(1)) return
      clashes = ""
      if (case%spring%load_arm /= load_arm_names(1)) clashes = clashes//", spring load_arm 'exact'"
      if (case%roller%spin /= spin_names(1)) clashes = clashes//", roller spin 'exact'"
      if (.not. case%traction%in_roller_balance) clashes = clashes//", traction in_roller_balance = .true."
      if (case%spring%seating == seating_names(2)) clashes = clashes//", spring seating 'continuous'"
      if (allocated(case%asperity)) then
         if (case%asperity%boundary /= boundary_names(1)) clashes = clashes//", asperity boundary 'mobilised'"
      end if
      if (len(clashes) > 0) call raise(error, kind_deck, "energy = 'consistent' needs "//clashes(3:))
   end subroutine check_bookkeeping

end module camroller_case
