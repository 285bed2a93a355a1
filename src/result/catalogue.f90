!> The series that a result can hold: name, unit, meaning, and the part of the model each comes from.
!>
!> In: a case and states. Out: the list of series that the case has, and their values in the same order.
!> Name and value of a series stand in one line, in `add_follower` or `add_camshaft`; the former is read for each lobe.
module camroller_catalogue
   use camroller_kinds, only : wp
   use camroller_case, only : camshaft_number, has_engine, case_t, energy_names
   use camroller_model, only : model_t
   use camroller_number_text, only : integer_text
   use camroller_result, only : quantity_t, lobe_scope, scope_camshaft, scope_engine, scope_length
   use camroller_state, only : state_t, flexible_values_t, most_surge_modes
   use camroller_hertz, only : peak_pressure
   use camroller_traction, only : rolling_law_names, rolling_none
   implicit none
   private

   public :: list_series, follower_values, camshaft_values, series_values, follower_torques, torque_count
   public :: follower_count, camshaft_count, lobe_columns, camshaft_columns, lobe_prefix

   !> More series than any case has
   integer, parameter :: max_series = 160
   !> Number of torques of one follower that `follower_torques` gives
   integer, parameter :: torque_count = 7
   !> Beginning of the names of series of one of several camshafts
   character(len=*), parameter :: camshaft_prefix = "camshaft_"

   !> Series that are being named, read, or both
   type :: list_t
      integer :: count = 0
      !> Values [unit of the series]
      real(wp) :: values(max_series)
      !> Their meaning; allocated where it is wanted
      type(quantity_t), allocatable :: items(:)
   end type list_t

contains

   !> The series of a case: those of the first lobe's follower, those of the camshaft, those of the second lobe's follower.
   subroutine list_series(case, series)
      !> The case
      type(case_t), intent(in) :: case
      !> Its series
      type(quantity_t), allocatable, intent(out) :: series(:)

      type(list_t) :: list
      type(model_t) :: model
      type(state_t) :: state
      ! Torques of each camshaft [N m], last the energy residual [W]
      real(wp), allocatable :: none(:, :)
      integer :: lobe, first

      allocate (list%items(max_series), none(torque_count, camshaft_number(case)))
      none = 0.0_wp
      call set_blank(model, state)
      do lobe = 1, merge(2, 1, allocated(case%second_lift))
         first = list%count + 1
         call add_follower(list, case, model, state)
         list%items(first:list%count)%scope = lobe_scope(lobe)
         call name_lobe(list%items(first:list%count), lobe)
         if (lobe > 1) cycle
         first = list%count + 1
         call add_camshafts(list, case, none, none(1, :))
         list%items(first:list%count)%scope = merge(scope_engine, scope_camshaft, has_engine(case))
         call set_camshaft_scopes(list%items(first:list%count))
      end do
      series = list%items(:list%count)
   end subroutine list_series

   !> Number of series of one follower.
   pure function follower_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(list_t) :: list
      type(model_t) :: model
      type(state_t) :: state

      call set_blank(model, state)
      call add_follower(list, case, model, state)
      count = list%count
   end function follower_count

   !> Number of series of the camshaft.
   pure function camshaft_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(list_t) :: list
      ! Torques of each camshaft [N m], last the energy residual [W]
      real(wp), allocatable :: none(:, :)

      allocate (none(torque_count, camshaft_number(case)))
      none = 0.0_wp
      call add_camshafts(list, case, none, none(1, :))
      count = list%count
   end function camshaft_count

   !> Places of the series of a lobe's follower among all, the first and the last.
   pure function lobe_columns(case, lobe) result(columns)
      !> The case
      type(case_t), intent(in) :: case
      !> Its lobe shape, from 1
      integer, intent(in) :: lobe
      !> The places
      integer :: columns(2)

      integer :: count

      count = follower_count(case)
      columns = [1, count] + (lobe - 1)*count
      if (lobe > 1) columns = columns + camshaft_count(case)
   end function lobe_columns

   !> Places of the series of the camshaft among all, the first and the last.
   pure function camshaft_columns(case) result(columns)
      !> The case
      type(case_t), intent(in) :: case
      !> The places
      integer :: columns(2)

      columns = follower_count(case) + [1, camshaft_count(case)]
   end function camshaft_columns

   !> Values of the series of one follower.
   pure subroutine follower_values(case, model, state, values)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Values, in the order of `list_series` [unit of the series]
      real(wp), intent(out) :: values(:)

      type(list_t) :: list

      call add_follower(list, case, model, state)
      values = list%values(:list%count)
   end subroutine follower_values

   !> Values of the series of the camshafts.
   pure subroutine camshaft_values(case, torques, bearing_torque, values)
      !> The case
      type(case_t), intent(in) :: case
      !> Torques of all followers of each camshaft, as `follower_torques` orders them [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(:, :)
      !> Torque of all bearings of each camshaft [N m]
      real(wp), intent(in) :: bearing_torque(:)
      !> Values, in the order of `list_series` [unit of the series]
      real(wp), intent(out) :: values(:)

      type(list_t) :: list

      call add_camshafts(list, case, torques, bearing_torque)
      values = list%values(:list%count)
   end subroutine camshaft_values

   !> Values of the series of one follower, then of the camshafts, with the follower on the first one.
   pure subroutine series_values(case, model, state, torques, bearing_torque, values)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the follower's lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Torques, as `follower_torques` orders them [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)
      !> Torque of all camshaft bearings [N m]
      real(wp), intent(in) :: bearing_torque
      !> Values [unit of the series]
      real(wp), intent(out) :: values(:)

      type(list_t) :: list
      ! Torques of each camshaft [N m], last the energy residual [W]; of its bearings [N m]
      real(wp), dimension(torque_count, camshaft_number(case)) :: of_shafts
      real(wp), dimension(camshaft_number(case)) :: of_bearings

      of_shafts = 0.0_wp
      of_shafts(:, 1) = torques
      of_bearings = 0.0_wp
      of_bearings(1) = bearing_torque
      call add_follower(list, case, model, state)
      call add_camshafts(list, case, of_shafts, of_bearings)
      values = list%values(:list%count)
   end subroutine series_values

   !> Series of one follower: the one place where each has its name, unit, meaning, part of the model and value.
   pure subroutine add_follower(list, case, model, state)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state

      call add(list, "valve_lift", "m", "valve lift", "lift", state%position%lift)
      call add(list, "valve_velocity", "m s-1", "speed of the valve, opening positive", "lift", &
         & model%speed*state%position%lift_slope)
      call add(list, "contact_load", "N", "normal load between cam and roller", "dynamics", state%contact%load)
      call add(list, "equivalent_radius", "m", "equivalent radius of the contact", "kinematics", &
         & state%position%equivalent_radius)
      call add(list, "cam_surface_speed", "m s-1", "speed of the contact point over the cam surface", "kinematics", &
         & state%contact%cam_surface_speed)
      call add(list, "rolling_speed", "m s-1", "speed of the roller's surface in pure rolling", "kinematics", &
         & state%contact%rolling_speed)
      call add(list, "roller_surface_speed", "m s-1", "speed of the contact point over the roller surface", "roller", &
         & state%contact%roller_surface_speed)
      call add(list, "roller_spin", "rad s-1", "angular speed of the roller", "roller", state%contact%roller_spin)
      call add(list, "sliding_speed", "m s-1", "sliding speed, positive where the roller lags", "roller", &
         & state%contact%sliding_speed)
      call add(list, "entrainment_speed", "m s-1", "mean of both surface speeds", "roller", state%contact%entrainment_speed)
      call add(list, "slip_ratio", "1", "sliding speed relative to the speed in pure rolling", "roller", &
         & ratio(state%contact%sliding_speed, state%contact%rolling_speed))
      call add(list, "hertz_half_width", "m", "half width of the dry contact", "hertz", state%contact%half_width)
      call add(list, "hertz_pressure", "Pa", "peak pressure of the dry contact", "hertz", &
         & peak_pressure(state%contact%load, state%position%equivalent_radius, model%contact_width, model%modulus))
      call add(list, "film_thickness_min", "m", "minimum film thickness", "film", state%contact%film_min)
      call add(list, "film_thickness_central", "m", "central film thickness", "film", state%contact%film_central)
      call add(list, "film_ratio", "1", "minimum film thickness relative to composite roughness", "film", state%contact%film_ratio)
      if (allocated(case%asperity)) then
         call add(list, "asperity_load", "N", "load carried by asperities", "asperity", state%contact%asperity_load)
         call add(list, "real_contact_area", "m2", "contact area of the asperities", "asperity", state%contact%real_area)
      end if
      call add(list, "friction_hydrodynamic", "N", "shear force of the film", "traction", state%contact%shear)
      if (allocated(case%asperity)) then
         call add(list, "friction_boundary", "N", "limit of the boundary friction", "asperity", &
            & state%contact%boundary_capacity)
         call add(list, "friction_boundary_mobilised", "N", "boundary friction mobilised by slip", "asperity", &
            & state%contact%boundary_mobilised)
      end if
      if (has_rolling(case)) call add(list, "friction_rolling", "N", "rolling resistance of each surface", "traction", &
         & state%contact%rolling_resistance)
      call add(list, "traction", "N", "tangential force that drives the roller", "traction", state%contact%traction)
      call add(list, "friction_contact", "N", "friction of the contact: shear, boundary and rolling", "traction", &
         & state%contact_friction)
      if (allocated(case%asperity)) then
         call add(list, "asperity_friction_share", "1", "fraction of boundary friction in contact friction", "asperity", &
            & ratio(state%boundary_friction, state%contact_friction))
      end if
      if (allocated(case%dynamics)) call add_flexible(list, case, state%flexible)
   end subroutine add_follower

   !> Series of a flexible train.
   pure subroutine add_flexible(list, case, train)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> What the train has beside a rigid one
      type(flexible_values_t), intent(in) :: train

      integer :: n

      call add(list, "lift_error", "m", "valve lift less that of a rigid train", "dynamics", train%lift_error)
      call add(list, "contact_gap", "m", "gap between cam and roller", "dynamics", train%gap)
      call add(list, "contact_turn", "rad", "angle by which the place of contact is ahead of the cam", "dynamics", &
         & train%contact_turn)
      call add(list, "load_ratio", "1", "contact load over that of a rigid train without friction; zero where that has none", &
         & "dynamics", train%load_ratio)
      call add(list, "pad_force", "N", "force between finger and valve", "dynamics", train%pad_force)
      call add(list, "seat_force", "N", "force of the seat on the valve", "dynamics", train%seat_force)
      call add(list, "joint_force", "N", "force in the joint of finger and pivot; negative: the socket would open", "dynamics", &
         & train%joint_force)
      call add(list, "spring_force", "N", "force of the spring on the valve", "dynamics", train%spring_force)
      call add(list, "stored_energy", "J", "energy stored in springs, contacts, oil and motion", "dynamics", train%stored_energy)
      if (allocated(case%lash_adjuster)) then
         call add(list, "plunger_travel", "m", "place of the adjuster's plunger, towards the cam positive", "lash_adjuster", &
            & train%plunger_travel)
         call add(list, "chamber_pressure", "Pa", "pressure in the adjuster's chamber above that outside", "lash_adjuster", &
            & train%chamber_pressure)
         call add(list, "leak_flow", "m3 s-1", "oil that leaks along the plunger", "lash_adjuster", train%leak_flow)
         call add(list, "check_valve_flow", "m3 s-1", "oil that enters through the check valve", "lash_adjuster", train%check_flow)
      end if
      if (.not. allocated(case%spring_surge)) return
      do n = 1, case%spring_surge%modes
         call add(list, "spring_mode_"//integer_text(n), "m", "amplitude of the spring's mode "//integer_text(n), "spring_surge", &
            & train%modes(n))
      end do
   end subroutine add_flexible

   !> Series of all camshafts together, then, where there are several, of each.
   pure subroutine add_camshafts(list, case, torques, bearing_torque)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> Torques of all followers of each camshaft, as `follower_torques` orders them [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(:, :)
      !> Torque of all bearings of each camshaft [N m]
      real(wp), intent(in) :: bearing_torque(:)

      integer :: k

      call add_camshaft(list, case, sum(torques, 2), sum(bearing_torque))
      if (size(bearing_torque) == 1) return
      do k = 1, size(bearing_torque)
         call add(list, camshaft_prefix//integer_text(k)//"_torque_friction", "N m", "torque for all losses of camshaft "// &
            & integer_text(k), "torque", sum(torques(2:4, k)) + torques(6, k) + bearing_torque(k))
         call add(list, camshaft_prefix//integer_text(k)//"_torque_drive", "N m", "torque that drives camshaft "// &
            & integer_text(k), "torque", sum(torques(1:6, k)) + bearing_torque(k))
      end do
   end subroutine add_camshafts

   !> Give series of one of several camshafts its scope.
   pure subroutine set_camshaft_scopes(series)
      !> Series of camshafts
      type(quantity_t), intent(inout) :: series(:)

      integer :: i, length

      do i = 1, size(series)
         if (index(series(i)%name, camshaft_prefix) /= 1) cycle
         length = index(series(i)%name(len(camshaft_prefix) + 1:), "_") - 1
         series(i)%scope = scope_camshaft//" "//series(i)%name(len(camshaft_prefix) + 1:len(camshaft_prefix) + length)
      end do
   end subroutine set_camshaft_scopes

   !> Series of the camshaft: torques of all followers and bearings.
   pure subroutine add_camshaft(list, case, torques, bearing_torque)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> Torques of all followers together, as `follower_torques` orders them [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)
      !> Torque of all camshaft bearings [N m]
      real(wp), intent(in) :: bearing_torque

      call add(list, "torque_geometric", "N m", "torque against spring, inertia and gas force", "torque", torques(1))
      call add(list, "torque_contact", "N m", "torque for the losses of the contact", "torque", torques(2))
      if (allocated(case%needle_bearing)) then
         call add(list, "torque_needle", "N m", "torque for the roller's bearing", "needle_bearing", torques(3))
      end if
      if (allocated(case%valve_guide)) call add(list, "torque_guide", "N m", "torque for the valve guide", "valve_guide", &
         & torques(4))
      if (allocated(case%cam_bearings)) then
         call add(list, "torque_bearings", "N m", "torque for the camshaft bearings", "cam_bearings", bearing_torque)
      end if
      if (allocated(case%dynamics)) then
         call add(list, "torque_damping", "N m", "torque for the losses in dampers, leak and check valve", "dynamics", torques(6))
      end if
      if (case%energy == energy_names(1)) then
         call add(list, "torque_roller_inertia", "N m", "torque for the inertia of the roller", "roller", torques(5))
      end if
      call add(list, "torque_friction", "N m", "torque for all losses", "torque", sum(torques(2:4)) + torques(6) &
         & + bearing_torque)
      call add(list, "torque_drive", "N m", "torque that drives the camshaft", "torque", sum(torques(1:6)) &
         & + bearing_torque)
      if (case%energy == energy_names(1)) then
         call add(list, "energy_residual", "W", "drive power less losses less stored power", "torque", &
            & torques(7))
      end if
   end subroutine add_camshaft

   !> Beginning of the names of series and scalars of a lobe; blank for the first one.
   pure function lobe_prefix(lobe) result(prefix)
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> The beginning
      character(len=scope_length) :: prefix

      prefix = ""
      if (lobe > 1) prefix = "lobe_"//integer_text(lobe)//"_"
   end function lobe_prefix

   !> Give series the name of their lobe, where it is not the first.
   pure subroutine name_lobe(series, lobe)
      !> Series of a follower
      type(quantity_t), intent(inout) :: series(:)
      !> Its lobe shape, from 1
      integer, intent(in) :: lobe

      integer :: i

      if (lobe == 1) return
      do i = 1, size(series)
         series(i)%name = trim(lobe_prefix(lobe))//series(i)%name
         series(i)%description = series(i)%description//", "//trim(lobe_scope(lobe))
      end do
   end subroutine name_lobe

   !> What series are named from: a state in which all of them are zero.
   pure subroutine set_blank(model, state)
      !> Model: what series take from it
      type(model_t), intent(out) :: model
      !> State: what series take from it
      type(state_t), intent(out) :: state

      model%speed = 0.0_wp
      model%contact_width = 1.0_wp
      model%modulus = 1.0_wp
      state%position%lift = 0.0_wp
      state%position%lift_slope = 0.0_wp
      state%position%equivalent_radius = 1.0_wp
      state%contact%load = 0.0_wp
      state%contact%cam_surface_speed = 0.0_wp
      state%contact%rolling_speed = 0.0_wp
      state%contact%roller_surface_speed = 0.0_wp
      state%contact%roller_spin = 0.0_wp
      state%contact%sliding_speed = 0.0_wp
      state%contact%entrainment_speed = 0.0_wp
      state%contact%half_width = 0.0_wp
      state%contact%film_min = 0.0_wp
      state%contact%film_central = 0.0_wp
      state%contact%film_ratio = 0.0_wp
      state%contact%asperity_load = 0.0_wp
      state%contact%real_area = 0.0_wp
      state%contact%shear = 0.0_wp
      state%contact%boundary_capacity = 0.0_wp
      state%contact%boundary_mobilised = 0.0_wp
      state%contact%rolling_resistance = 0.0_wp
      state%contact%traction = 0.0_wp
      state%contact_friction = 0.0_wp
      state%boundary_friction = 0.0_wp
      state%flexible = flexible_values_t(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, spread(0.0_wp, 1, most_surge_modes))
   end subroutine set_blank

   !> Torques of one follower in a fixed order: geometric, contact, needle, guide, roller inertia, damping; last energy residual.
   pure function follower_torques(state) result(torques)
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Torques [N m], last the energy residual [W]
      real(wp) :: torques(torque_count)

      torques = [state%torque_geometric, state%torque_contact, state%torque_needle, state%torque_guide, &
         & state%torque_roller_inertia, state%torque_damping, state%energy_residual]
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

   !> Append a series to a list.
   pure subroutine add(list, name, unit, description, source, value)
      !> List to extend
      type(list_t), intent(inout) :: list
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source
      !> Value [unit of the series]
      real(wp), intent(in) :: value

      list%count = list%count + 1
      list%values(list%count) = value
      if (.not. allocated(list%items)) return
      list%items(list%count)%name = name
      list%items(list%count)%unit = unit
      list%items(list%count)%description = description
      list%items(list%count)%source = source
   end subroutine add

end module camroller_catalogue
