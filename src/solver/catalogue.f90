!> The series that a result can hold: name, unit, meaning, and the part of the model each comes from.
!>
!> Layer: solver. In: a case and states. Out: the list of series that the case has, and their values in the same order.
!> Name and value of a series stand next to each other: `list_series` and `series_values` are one list read twice.
module camroller_catalogue
   use camroller_kinds, only : wp
   use camroller_case, only : case_t, energy_names
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t
   use camroller_state, only : state_t
   use camroller_hertz, only : peak_pressure
   use camroller_traction, only : rolling_law_names, rolling_none
   implicit none
   private

   public :: list_series, series_values, max_series, follower_torques, torque_count

   !> More series than any case has
   integer, parameter :: max_series = 48
   !> Number of torques of one follower that `follower_torques` gives
   integer, parameter :: torque_count = 6

   !> A list that is being written
   type :: list_t
      integer :: count = 0
      type(quantity_t) :: items(max_series)
   end type list_t

contains

   !> The series of a case, in the order of `series_values`.
   subroutine list_series(case, series)
      !> The case
      type(case_t), intent(in) :: case
      !> Its series
      type(quantity_t), allocatable, intent(out) :: series(:)

      type(list_t) :: list

      call add(list, "valve_lift", "m", "valve lift", "lift")
      call add(list, "valve_velocity", "m s-1", "speed of the valve, opening positive", "lift")
      call add(list, "contact_load", "N", "normal load between cam and roller", "dynamics")
      call add(list, "equivalent_radius", "m", "equivalent radius of the contact", "kinematics")
      call add(list, "cam_surface_speed", "m s-1", "speed of the contact point over the cam surface", "kinematics")
      call add(list, "rolling_speed", "m s-1", "speed of the roller's surface in pure rolling", "kinematics")
      call add(list, "roller_surface_speed", "m s-1", "speed of the contact point over the roller surface", "roller")
      call add(list, "roller_spin", "rad s-1", "angular speed of the roller", "roller")
      call add(list, "sliding_speed", "m s-1", "sliding speed, positive where the roller lags", "roller")
      call add(list, "entrainment_speed", "m s-1", "mean of both surface speeds", "roller")
      call add(list, "slip_ratio", "1", "sliding speed over speed in pure rolling", "roller")
      call add(list, "hertz_half_width", "m", "half width of the dry contact", "hertz")
      call add(list, "hertz_pressure", "Pa", "peak pressure of the dry contact", "hertz")
      call add(list, "film_thickness_min", "m", "minimum film thickness", "film")
      call add(list, "film_thickness_central", "m", "central film thickness", "film")
      call add(list, "film_ratio", "1", "minimum film thickness over composite roughness", "film")
      if (allocated(case%asperity)) then
         call add(list, "asperity_load", "N", "load carried by asperities", "asperity")
         call add(list, "real_contact_area", "m2", "contact area of the asperities", "asperity")
      end if
      call add(list, "friction_hydrodynamic", "N", "shear force of the film", "traction")
      if (allocated(case%asperity)) then
         call add(list, "friction_boundary", "N", "boundary friction that the asperities can bear", "asperity")
         call add(list, "friction_boundary_mobilised", "N", "boundary friction that the slip mobilises", "asperity")
      end if
      if (has_rolling(case)) call add(list, "friction_rolling", "N", "rolling resistance of each surface", "traction")
      call add(list, "traction", "N", "tangential force that drives the roller", "traction")
      call add(list, "friction_contact", "N", "friction of the contact: shear, boundary and rolling", "traction")
      if (allocated(case%asperity)) then
         call add(list, "asperity_friction_share", "1", "part of boundary friction in the friction of the contact", "asperity")
      end if
      call add_torques(list, case)
      series = list%items(:list%count)
   end subroutine list_series

   !> The torques of a case: last in the list of series, and the same list for one follower or a whole camshaft.
   subroutine add_torques(list, case)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case

      call add(list, "torque_geometric", "N m", "torque against spring, inertia and gas force", "torque")
      call add(list, "torque_contact", "N m", "torque for the losses of the contact", "torque")
      if (allocated(case%needle_bearing)) then
         call add(list, "torque_needle", "N m", "torque for the roller's bearing", "needle_bearing")
      end if
      if (allocated(case%valve_guide)) call add(list, "torque_guide", "N m", "torque for the valve guide", "valve_guide")
      if (allocated(case%cam_bearings)) then
         call add(list, "torque_bearings", "N m", "torque for the camshaft bearings", "cam_bearings")
      end if
      if (case%energy == energy_names(1)) then
         call add(list, "torque_roller_inertia", "N m", "torque that spins the roller up", "roller")
      end if
      call add(list, "torque_friction", "N m", "torque for all losses", "torque")
      call add(list, "torque_drive", "N m", "torque that drives the camshaft", "torque")
      if (case%energy == energy_names(1)) then
         call add(list, "energy_residual", "W", "power by the cam's equilibrium less losses less stored power", "torque")
      end if
   end subroutine add_torques

   !> Values of the series of a case, in the order of `list_series`.
   pure subroutine series_values(case, model, state, torques, bearing_torque, values)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the first lobe
      type(model_t), intent(in) :: model
      !> State of the first follower
      type(state_t), intent(in) :: state
      !> Torques of all followers together, as `follower_torques` orders them [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)
      !> Torque of all camshaft bearings [N m]
      real(wp), intent(in) :: bearing_torque
      !> Values, one per series of the case [unit of the series]
      real(wp), intent(out) :: values(:)

      integer :: n

      n = 0
      call put(values, n, state%position%lift)
      call put(values, n, model%speed*state%position%lift_slope)
      call put(values, n, state%contact%load)
      call put(values, n, state%position%equivalent_radius)
      call put(values, n, state%contact%cam_surface_speed)
      call put(values, n, state%contact%rolling_speed)
      call put(values, n, state%contact%roller_surface_speed)
      call put(values, n, state%contact%roller_spin)
      call put(values, n, state%contact%sliding_speed)
      call put(values, n, state%contact%entrainment_speed)
      call put(values, n, ratio(state%contact%sliding_speed, state%contact%rolling_speed))
      call put(values, n, state%contact%half_width)
      call put(values, n, peak_pressure(state%contact%load, state%position%equivalent_radius, model%contact_width, model%modulus))
      call put(values, n, state%contact%film_min)
      call put(values, n, state%contact%film_central)
      call put(values, n, state%contact%film_ratio)
      if (allocated(case%asperity)) then
         call put(values, n, state%contact%asperity_load)
         call put(values, n, state%contact%real_area)
      end if
      call put(values, n, state%contact%shear)
      if (allocated(case%asperity)) then
         call put(values, n, state%contact%boundary_capacity)
         call put(values, n, state%contact%boundary_mobilised)
      end if
      if (has_rolling(case)) call put(values, n, state%contact%rolling_resistance)
      call put(values, n, state%contact%traction)
      call put(values, n, state%contact_friction)
      if (allocated(case%asperity)) call put(values, n, ratio(state%boundary_friction, state%contact_friction))

      call put(values, n, torques(1))
      call put(values, n, torques(2))
      if (allocated(case%needle_bearing)) call put(values, n, torques(3))
      if (allocated(case%valve_guide)) call put(values, n, torques(4))
      if (allocated(case%cam_bearings)) call put(values, n, bearing_torque)
      if (case%energy == energy_names(1)) call put(values, n, torques(5))
      call put(values, n, sum(torques(2:4)) + bearing_torque)
      call put(values, n, sum(torques(1:5)) + bearing_torque)
      if (case%energy == energy_names(1)) call put(values, n, torques(6))
   end subroutine series_values

   !> Torques of one follower in a fixed order: geometric, contact, needle, guide, roller inertia; last the energy residual.
   pure function follower_torques(state) result(torques)
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Torques [N m], last the energy residual [W]
      real(wp) :: torques(torque_count)

      torques = [state%torque_geometric, state%torque_contact, state%torque_needle, state%torque_guide, &
         & state%torque_roller_inertia, state%energy_residual]
   end function follower_torques

   !> Does the case have rolling resistance?
   pure function has_rolling(case) result(has)
      !> The case
      type(case_t), intent(in) :: case
      !> True where a law is chosen
      logical :: has

      has = case%traction%rolling_law /= rolling_law_names(rolling_none)
   end function has_rolling

   !> Quotient, zero where the denominator is zero.
   elemental function ratio(numerator, denominator) result(quotient)
      !> Numerator [any]
      real(wp), intent(in) :: numerator
      !> Denominator [any]
      real(wp), intent(in) :: denominator
      !> Quotient [any]
      real(wp) :: quotient

      quotient = 0.0_wp
      if (abs(denominator) > 0.0_wp) quotient = numerator/denominator
   end function ratio

   !> Append a quantity to a list.
   subroutine add(list, name, unit, description, source)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source

      list%count = list%count + 1
      list%items(list%count)%name = name
      list%items(list%count)%unit = unit
      list%items(list%count)%description = description
      list%items(list%count)%source = source
   end subroutine add

   !> Append a value to a list.
   pure subroutine put(values, count, value)
      !> Values [unit of the series]
      real(wp), intent(inout) :: values(:)
      !> Number of values so far
      integer, intent(inout) :: count
      !> Value to append [unit of the series]
      real(wp), intent(in) :: value

      count = count + 1
      values(count) = value
   end subroutine put

end module camroller_catalogue
