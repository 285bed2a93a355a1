!> The series that a result can hold: name, unit, meaning, and the part of the model each comes from.
!>
!> In: a case and states. Out: the list of series that the case has, and their values in the same order.
!> Name and value of a series stand in one line, in `add_follower` or `add_camshaft`; the former is read for each lobe.
module camroller_catalogue
   use, intrinsic :: iso_fortran_env, only : int8
   use camroller_kinds, only : wp
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_case, only : camshaft_number, has_engine, case_t
   use camroller_case_torques, only : torque_rows
   use camroller_model, only : model_t
   use camroller_number_text, only : integer_text
   use camroller_flexible_parts, only : damper_count, damper_meanings, damper_series, dampers_without_adjuster
   use camroller_result, only : quantity_t, quantity_list_t, append_numbered, append_quantity, lobe_scope, scope_camshaft, &
      & scope_case, scope_engine, scope_length, take_quantities
   use camroller_axial_table, only : axial_state_t
   use camroller_part_series, only : add_asperities, add_axial, add_axial_film, add_bearings, add_heat, add_pin, &
      & add_surfaces, bearing_count, least_force, least_share
   use camroller_state, only : state_t, flexible_values_t
   use camroller_torque_list, only : torque_list, torque_count, is_torque, of_residual, sum_of_losses, &
      & sum_of_torques, torque_series
   use camroller_hertz, only : peak_pressure
   use camroller_joint_forces, only : joint_values_t
   use camroller_traction, only : rolling_law_names, rolling_none
   implicit none
   private

   public :: list_series, follower_values, camshaft_values, series_values
   public :: follower_count, camshaft_count, lobe_columns, camshaft_columns, lobe_prefix

   !> Beginning of the names of series of one of several camshafts
   character(len=*), parameter :: camshaft_prefix = "camshaft_"
   !> Coefficient of a friction that has no share: far below the rounding of the load [-]
   real(wp), parameter :: no_friction = 1.0e-20_wp

contains

   !> The series of a case: those of the first lobe's follower, those of the camshaft, those of the second lobe's follower.
   subroutine list_series(case, series)
      !> The case
      type(case_t), intent(in) :: case
      !> Its series
      type(quantity_t), allocatable, intent(out) :: series(:)

      type(quantity_list_t) :: list
      type(model_t) :: model
      type(state_t) :: state
      ! Torques of each camshaft [N m], last the energy residual [W]
      real(wp) :: none(torque_count, camshaft_number(case))
      integer :: lobe, first

      allocate (list%items(0), list%values(0))
      none = 0.0_wp
      call set_blank(model, state)
      do lobe = 1, merge(2, 1, allocated(case%second_lift))
         first = list%count + 1
         call add_follower(list, case, model, state)
         list%items(first:list%count)%scope = lobe_scope(lobe)
         call name_lobe(list%items(first:list%count), lobe)
         if (lobe > 1) cycle
         first = list%count + 1
         call add_camshafts(list, case, torque_rows(case), none)
         call set_camshaft_scopes(list%items(first:list%count), merge(scope_engine, scope_camshaft, has_engine(case)))
      end do
      call take_quantities(list, series)
   end subroutine list_series

   !> Number of series of one follower.
   pure function follower_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(quantity_list_t) :: list
      type(model_t) :: model
      type(state_t) :: state

      call set_blank(model, state)
      allocate (list%values(0))
      call add_follower(list, case, model, state)
      count = list%count
   end function follower_count

   !> Number of series of the camshaft.
   pure function camshaft_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(quantity_list_t) :: list
      ! Torques of each camshaft [N m], last the energy residual [W]
      real(wp) :: none(torque_count, camshaft_number(case))

      none = 0.0_wp
      allocate (list%values(0))
      call add_camshafts(list, case, torque_rows(case), none)
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
      real(wp), intent(out), target, contiguous :: values(:)

      type(quantity_list_t) :: list

      list%room => values
      call add_follower(list, case, model, state)
   end subroutine follower_values

   !> Values of the series of the camshafts.
   pure subroutine camshaft_values(case, torques, values, bearings, has)
      !> The case
      type(case_t), intent(in) :: case
      !> Torques on each camshaft, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(:, :)
      !> Values, in the order of `list_series` [unit of the series]
      real(wp), intent(out), target, contiguous :: values(:)
      !> States of the bearings, shape (bearing, camshaft); without them their series are zero
      type(bearing_state_t), intent(in), optional :: bearings(:, :)
      !> Which torques the case has, by `torque_rows`, where the caller asks often
      logical, intent(in), optional :: has(torque_count)

      type(quantity_list_t) :: list

      list%room => values
      if (present(has)) then
         call add_camshafts(list, case, has, torques, bearings)
      else
         call add_camshafts(list, case, torque_rows(case), torques, bearings)
      end if
   end subroutine camshaft_values

   !> Values of the series of one follower, then of the camshafts, with the follower on the first one.
   pure subroutine series_values(case, model, state, torques, values)
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the follower's lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> Torques, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)
      !> Values [unit of the series]
      real(wp), intent(out), target, contiguous :: values(:)

      type(quantity_list_t) :: list
      ! Torques on each camshaft [N m], last the energy residual [W]
      real(wp) :: of_shafts(torque_count, camshaft_number(case))

      of_shafts = 0.0_wp
      of_shafts(:, 1) = torques
      list%room => values
      call add_follower(list, case, model, state)
      call add_camshafts(list, case, torque_rows(case), of_shafts)
   end subroutine series_values

   !> Append a series: its value alone, without a call, where no names are wanted.
   pure subroutine add(list, name, unit, description, source, value, least)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Name, unit, meaning, part of the model
      character(len=*), intent(in) :: name, unit, description, source
      !> Value [unit of the quantity]
      real(wp), intent(in) :: value
      !> Magnitude below which it counts as none; 0 where absent [unit of the quantity]
      real(wp), intent(in), optional :: least

      if (associated(list%room)) then
         list%count = list%count + 1
         list%room(list%count) = value
      else
         call append_quantity(list, name, unit, description, source, value, least=least)
      end if
   end subroutine add

   !> Series of one follower: the one place where each has its name, unit, meaning, part of the model and value.
   pure subroutine add_follower(list, case, model, state)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state

      type(axial_state_t) :: along

      call add(list, "valve_lift", "m", "valve lift", "lift", state%position%lift)
      call add(list, "valve_velocity", "m s-1", "speed of the valve, positive while it opens", "lift", &
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
         & peak_pressure(state%contact%load, state%position%equivalent_radius, state%contact%length, model%modulus))
      call add(list, "film_thickness_min", "m", "minimum film thickness; zero without contact", "film", state%contact%film_min)
      call add(list, "film_thickness_central", "m", "central film thickness; zero without contact", "film", &
         & state%contact%film_central)
      if (allocated(case%roller_profile)) call add_axial_film(list, model, state, along)
      call add(list, "film_ratio", "1", "minimum film thickness relative to composite roughness; zero "// &
         & "without contact", "film", state%contact%film_ratio)
      if (allocated(case%heat)) call add_heat(list, case, state)
      if (allocated(case%asperity)) call add_asperities(list, case, state)
      call add(list, "friction_hydrodynamic", "N", "shear force of the film beside the asperities", "traction", state%contact%shear)
      if (allocated(case%asperity)) then
         call add(list, "friction_boundary", "N", "limit of the boundary friction", "asperity", state%contact%boundary_capacity, &
            & least=least_force)
         call add(list, "friction_boundary_mobilised", "N", "boundary friction mobilised by slip", "asperity", &
            & state%contact%boundary_mobilised, least=least_force)
      end if
      if (case%traction%rolling_law /= rolling_law_names(rolling_none)) call add(list, "friction_rolling", "N", &
         & "rolling resistance of each surface", "traction", state%contact%rolling_resistance)
      call add(list, "traction", "N", "tangential force that drives the roller", "traction", state%contact%traction)
      call add(list, "friction_contact", "N", "friction of the contact: shear, boundary and rolling", "traction", &
         & state%contact_friction)
      if (allocated(case%asperity)) then
         call add(list, "asperity_friction_share", "1", "fraction of boundary friction in contact friction", "asperity", &
            & state%boundary_friction/max(state%contact_friction, no_friction*state%contact%load, tiny(1.0_wp)), &
            & least=least_share)
      end if
      if (allocated(case%roller_profile)) call add_axial(list, case, model, state, along)
      if (allocated(case%needle_bearing)) call add_pin(list, case, model, state)
      if (allocated(case%wear) .or. allocated(case%running_in)) call add_surfaces(list, case, model, state)
      call add_joints(list, case, state%joints)
      if (allocated(case%dynamics)) call add_flexible(list, case, state%flexible)
   end subroutine add_follower

   !> Series of the sliding joints.
   pure subroutine add_joints(list, case, joints)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> Their values
      type(joint_values_t), intent(in) :: joints

      if (allocated(case%valve_tip)) then
         call add(list, "tip_force", "N", "force of the finger on the valve's tip, along the valve's axis", "valve_tip", &
            & joints%tip_force)
         call add(list, "tip_sliding_speed", "m s-1", "speed of the pad over the valve's tip, positive away from the pivot", &
            & "valve_tip", joints%tip_speed)
         call add(list, "friction_tip", "N", "friction on the valve's tip, positive away from the pivot", "valve_tip", &
            & joints%tip_friction, least=least_force)
      end if
      if (allocated(case%stem_seal)) call add(list, "friction_seal", "N", "friction of the stem seal, positive against opening", &
         & "stem_seal", joints%seal_friction, least=least_force)
      if (allocated(case%guide_side_load)) then
         call add(list, "guide_upper_force", "N", "magnitude of the force of the guide's upper end on the stem", &
            & "guide_side_load", joints%upper_force)
         call add(list, "guide_lower_force", "N", "magnitude of the force of the guide's lower end on the stem", &
            & "guide_side_load", joints%lower_force)
         call add(list, "friction_guide_side", "N", "friction of the stem at both ends of its guide, positive against opening", &
            & "guide_side_load", joints%side_friction, least=least_force)
      end if
      if (allocated(case%finger_pivot)) call add(list, "pivot_force", "N", "magnitude of the force of the pivot on the finger", &
         & "finger_pivot", joints%pivot_force)
   end subroutine add_joints

   !> Series of a flexible train.
   pure subroutine add_flexible(list, case, train)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> What the train has beside a rigid one
      type(flexible_values_t), intent(in) :: train

      integer :: n

      call add(list, "lift_error", "m", "valve lift less that of a rigid train", "dynamics", train%lift_error)
      call add(list, "valve_acceleration", "m s-2", "acceleration of the valve, positive in the direction of opening", "dynamics", &
         & train%valve_acceleration)
      call add(list, "contact_gap", "m", "gap between cam and roller", "dynamics", train%gap)
      call add(list, "contact_turn", "rad", "angle by which the point of contact is ahead of the cam", "dynamics", &
         & train%contact_turn)
      call add(list, "load_error", "N", "contact load less what a rigid train without friction needs; that is negative where "// &
         & "it would lose contact", "dynamics", train%load_error)
      call add(list, "pad_force", "N", "force between finger and valve", "dynamics", train%pad_force)
      call add(list, "seat_force", "N", "force of the seat on the valve", "dynamics", train%seat_force)
      call add(list, "joint_force", "N", "force in the joint of finger and pivot; negative: the socket would open", "dynamics", &
         & train%joint_force)
      call add(list, "spring_force", "N", "force of the spring on the valve", "dynamics", train%spring_force)
      call add(list, "stored_energy", "J", "energy stored in springs, contacts, oil and motion", "dynamics", train%stored_energy)
      if (allocated(case%lash_adjuster)) then
         call add(list, "plunger_travel", "m", "position of the adjuster's plunger, positive towards the cam", "lash_adjuster", &
            & train%plunger_travel)
         call add(list, "chamber_pressure", "Pa", "pressure in the adjuster's chamber above that outside", "lash_adjuster", &
            & train%chamber_pressure)
         call add(list, "leak_flow", "m3 s-1", "oil that leaks along the plunger", "lash_adjuster", train%leak_flow)
         call add(list, "check_valve_flow", "m3 s-1", "oil that enters through the check valve", "lash_adjuster", train%check_flow)
      end if
      do n = 1, merge(damper_count, dampers_without_adjuster, allocated(case%lash_adjuster))
         call add(list, trim(damper_series(n)), "W", trim(damper_meanings(n)), "dynamics", train%damping_powers(n))
      end do
      if (.not. allocated(case%spring_surge)) return
      do n = 1, case%spring_surge%modes
         call append_numbered(list, "spring_mode_", n, "", "m", "amplitude of the spring's mode", "spring_surge", train%modes(n))
      end do
   end subroutine add_flexible

   !> Series of all camshafts together, then, where there are several, of each, last those of the bearings.
   pure subroutine add_camshafts(list, case, has, torques, bearings)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> Which torques it has
      logical, intent(in) :: has(torque_count)
      !> Torques on each camshaft, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(:, :)
      !> States of the bearings, shape (bearing, camshaft)
      type(bearing_state_t), intent(in), optional :: bearings(:, :)

      ! Torques of all camshafts [N m], last the energy residual [W]
      real(wp) :: all_of(torque_count)
      integer :: k

      all_of = torques(:, 1)
      do k = 2, size(torques, 2)
         all_of = all_of + torques(:, k)
      end do
      call add_camshaft(list, has, all_of)
      do k = 1, merge(0, size(torques, 2), size(torques, 2) == 1)
         call append_numbered(list, camshaft_prefix, k, "_torque_friction", "N m", "torque for all losses of camshaft", "torque", &
            & sum_of_losses(torques(:, k)))
         call append_numbered(list, camshaft_prefix, k, "_torque_drive", "N m", "torque that drives camshaft", "torque", &
            & sum_of_torques(torques(:, k)))
      end do
      if (bearing_count(case) > 0) call add_bearings(list, case, bearings)
   end subroutine add_camshafts

   !> Give series their scope: that of all camshafts, or of one of several. Those of bearings have theirs.
   pure subroutine set_camshaft_scopes(series, of_all)
      !> Series of camshafts
      type(quantity_t), intent(inout) :: series(:)
      !> Scope of all camshafts
      character(len=*), intent(in) :: of_all

      integer :: i, length

      do i = 1, size(series)
         if (series(i)%scope /= scope_case) cycle
         series(i)%scope = of_all
         if (index(series(i)%name, camshaft_prefix) /= 1) cycle
         length = index(series(i)%name(len(camshaft_prefix) + 1:), "_") - 1
         series(i)%scope = scope_camshaft//" "//series(i)%name(len(camshaft_prefix) + 1:len(camshaft_prefix) + length)
      end do
   end subroutine set_camshaft_scopes

   !> Series of the camshaft: the torques that the case has, and their sums.
   pure subroutine add_camshaft(list, has, torques)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> Which torques the case has
      logical, intent(in) :: has(torque_count)
      !> Torques of all followers and bearings together, the rows of `torque_list` [N m], last the energy residual [W]
      real(wp), intent(in) :: torques(torque_count)

      integer :: row

      do row = 1, torque_count
         if (is_torque(row) .and. has(row)) call add(list, torque_series(row), "N m", torque_list(row)%meaning, &
            & torque_list(row)%source, torques(row))
      end do
      call add(list, "torque_friction", "N m", "torque for all losses", "torque", sum_of_losses(torques))
      call add(list, "torque_drive", "N m", "torque that drives the camshaft", "torque", sum_of_torques(torques))
      if (has(of_residual)) call add(list, torque_series(of_residual), "W", &
         & torque_list(of_residual)%meaning, torque_list(of_residual)%source, torques(of_residual))
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

   !> What series are named from: a state that is zero all over, but for what series divide by.
   pure subroutine set_blank(model, state)
      !> Model: what series take from it
      type(model_t), intent(out) :: model
      !> State: what series take from it
      type(state_t), intent(out) :: state

      integer :: i

      state = transfer([(0_int8, i=1, storage_size(state)/storage_size(0_int8))], state)
      state%position%equivalent_radius = 1.0_wp
      model%speed = 0.0_wp
      state%contact%length = 1.0_wp
      model%modulus = 1.0_wp
      model%roller_radius = 1.0_wp
   end subroutine set_blank

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

end module camroller_catalogue
