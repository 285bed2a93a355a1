!> Quantities of a cycle of solved contacts by name, with those of the film and friction formulas at the same load and slip.
!>
!> In: model, cycle of solved contacts. Out: `ehl_record_t`: profiles and quantities over the cam angle. Torques and energy
!> residual are computed by the same procedures as for every other state, with the solved contact in the place of the formulas.
module camroller_ehl_record
   use camroller_kinds, only : wp
   use camroller_contact_forces, only : contact_t, parts_t, setting_t, evaluate_contact, prepare_contact, release_contact, &
      & set_speeds
   use camroller_ehl_cycle, only : ehl_cycle_t
   use camroller_ehl_balance, only : bearing_moment
   use camroller_ehl_step, only : moment_t
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t, find_quantity
   use camroller_roller, only : spin_acceleration
   use camroller_state, only : state_t, add_torques, evaluate_loading
   use camroller_stick, only : has_stick
   use camroller_torque_list, only : of_contact, of_residual
   implicit none
   private

   public :: ehl_record_t, list_ehl_quantities, make_ehl_record, keep_nodes, solved_state, column, cycle_quantities, &
      & profile_quantities

   !> Pressure, film and quantities of a cycle
   type :: ehl_record_t
      !> Angles from full lift, increasing [rad]
      real(wp), allocatable :: angle(:)
      !> Nodes [half widths]; pressure [Pa], film [m] and, of profiles with heat, rise of its temperature [K] there, shape
      !> (node, angle)
      real(wp), allocatable :: nodes(:), pressure(:, :), film(:, :), film_rise(:, :)
      !> Values in the order of `list_ehl_quantities`, shape (angle, quantity) [unit of the quantity]
      real(wp), allocatable :: values(:, :)
   end type ehl_record_t

   !> Number of quantities of a cycle of solved contacts, and of profiles at load and slip of a run: without torques, which would
   !> be of neither
   integer, parameter :: cycle_quantities = 21, profile_quantities = 17

contains

   !> The quantities of a record.
   subroutine list_ehl_quantities(count, list)
      !> How many it has, `cycle_quantities` or `profile_quantities`
      integer, intent(in) :: count
      !> The list
      type(quantity_t), allocatable, intent(out) :: list(:)

      integer :: n

      allocate (list(cycle_quantities))
      n = 0
      call add("half_width", "m", "length unit of the node positions")
      call add("load", "N", "contact load")
      call add("sliding_speed", "m s-1", "sliding speed of the roller")
      call add("peak_pressure", "Pa", "largest pressure")
      call add("film_min", "m", "smallest film")
      call add("film_min_formula", "m", "smallest film by the film law at this load and slip")
      call add("film_central", "m", "film in the middle of the dry contact")
      call add("film_central_formula", "m", "central film by the film law at this load and slip")
      call add("asperity_share", "1", "fraction of the load that asperities carry")
      call add("asperity_share_formula", "1", "the same with the load shared by the smallest film alone")
      call add("shear", "N", "shear of the film integrated over the contact, limited")
      call add("shear_formula", "N", "shear of the film by the closed formula at this load and slip, limited")
      call add("rolling_resistance", "N", "rolling resistance of each surface, integrated over the contact")
      call add("rolling_resistance_formula", "N", "rolling resistance by the closed formula at this load and slip")
      call add("boundary_friction", "N", "mobilised boundary friction")
      call add("boundary_friction_formula", "N", "mobilised boundary friction where the smallest film shares the load")
      call add("traction", "N", "tangential force that drives the roller")
      call add("torque_contact", "N m", "torque of this follower for the losses of the contact")
      call add("torque_friction", "N m", "torque of this follower for all losses")
      call add("torque_drive", "N m", "torque that drives the camshaft for this follower")
      call add("energy_residual", "W", "drive power minus losses minus stored power")
      list = list(:count)

   contains

      !> Append a quantity.
      subroutine add(name, unit, meaning)
         !> Name, unit, meaning
         character(len=*), intent(in) :: name, unit, meaning

         n = n + 1
         list(n)%name = trim(name)
         list(n)%unit = unit
         list(n)%description = meaning
         list(n)%source = "ehl"
      end subroutine add
   end subroutine list_ehl_quantities

   !> Record of a cycle.
   subroutine make_ehl_record(record, model, cycle, count)
      !> The record
      type(ehl_record_t), intent(out) :: record
      !> The model
      type(model_t), intent(in) :: model
      !> The cycle, with or without profiles
      type(ehl_cycle_t), intent(in) :: cycle
      !> Number of quantities, `cycle_quantities` or `profile_quantities`
      integer, intent(in) :: count

      type(state_t) :: state
      type(contact_t) :: closed
      integer :: i

      record%angle = cycle%angle
      record%nodes = cycle%nodes
      if (allocated(cycle%pressure)) then
         record%pressure = cycle%pressure
         record%film = cycle%film
         if (allocated(cycle%film_rise)) record%film_rise = cycle%film_rise
      end if
      allocate (record%values(size(cycle%angle), cycle_quantities))
      do i = 1, size(cycle%angle)
         call solved_state(model, cycle%moments(i), state)
         call closed_contact(model, cycle%moments(i), state, closed)
         record%values(i, :) = [cycle%moments(i)%length_scale, state%contact%load, state%contact%sliding_speed, &
            & cycle%moments(i)%films%peak, state%contact%film_min, closed%film_min, state%contact%film_central, &
            & closed%film_central, cycle%moments(i)%films%asperity_share, closed%asperity_load/max(closed%load, tiny(1.0_wp)), &
            & state%contact%shear, closed%shear, state%contact%rolling_resistance, closed%rolling_resistance, &
            & state%contact%boundary_mobilised, closed%boundary_mobilised, state%contact%traction, state%torques(of_contact), &
            & state%torque_friction, state%torque_drive, state%torques(of_residual)]
      end do
      record%values = record%values(:, :count)
   end subroutine make_ehl_record

   !> Keep some of the nodes only, those of a coarser grid that the record's is nested in.
   pure subroutine keep_nodes(record, nodes)
      !> The record, with profiles
      type(ehl_record_t), intent(inout) :: record
      !> Number of nodes of the coarser grid; one less divides one less than the number of those of the record
      integer, intent(in) :: nodes

      integer :: step

      step = (size(record%nodes) - 1)/(nodes - 1)
      record%nodes = record%nodes(1::step)
      record%pressure = record%pressure(1::step, :)
      record%film = record%film(1::step, :)
   end subroutine keep_nodes

   !> State of the follower with the contact that was solved.
   pure subroutine solved_state(model, now, state)
      !> The model
      type(model_t), intent(in) :: model
      !> The contact
      type(moment_t), intent(in) :: now
      !> The state
      type(state_t), intent(out) :: state

      integer :: status

      call evaluate_loading(model, now%angle, state%position, state%gas_force, state%moments, status)
      associate (contact => state%contact)
         call set_speeds(model, state%position, now%sliding_speed, contact)
         call release_contact(contact)
         contact%load = now%load
         contact%is_touching = now%load > 0.0_wp
         contact%half_width = now%length_scale
         contact%apparent_area = 2.0_wp*now%length_scale*model%contact_width
         contact%sheared_area = contact%apparent_area
         contact%film_min = now%films%minimum
         contact%film_central = now%films%central
         contact%film_ratio = now%films%minimum/model%roughness
         contact%asperity_load = now%films%asperity_share*now%load
         contact%real_area = now%films%real_area*model%contact_width
         contact%shear = now%shear
         contact%boundary_capacity = now%boundary_capacity
         contact%boundary_mobilised = now%traction - now%shear
         contact%rolling_resistance = now%rolling_resistance
         contact%traction = now%traction
         contact%tangential_force = now%traction &
            & + now%rolling_resistance*(2.0_wp*state%position%equivalent_radius/model%roller_radius - 1.0_wp)
         contact%bearing_torque = bearing_moment(model, state%position, now%load, now%sliding_speed)
         state%spin_acceleration = spin_acceleration(contact%traction, merge(contact%rolling_resistance, 0.0_wp, &
            & model%has_rolling_in_balance), model%roller_radius, contact%bearing_torque, model%roller_inertia)
      end associate
      call add_torques(model, state)
   end subroutine solved_state

   !> Contact by the closed formulas at the load and the slip of a state; at rest with the same part of boundary friction.
   pure subroutine closed_contact(model, now, state, contact)
      type(model_t), intent(in) :: model
      !> The contact that was solved
      type(moment_t), intent(in) :: now
      type(state_t), intent(in) :: state
      type(contact_t), intent(out) :: contact

      type(setting_t) :: setting
      type(parts_t) :: parts
      ! Accuracy of the load share, change that is left of it [-]
      real(wp) :: change
      real(wp), parameter :: accuracy = 1.0e-8_wp
      integer, parameter :: most_rounds = 20
      integer :: round

      call set_speeds(model, state%position, state%contact%sliding_speed, contact)
      call release_contact(contact)
      if (.not. state%contact%film_min > 0.0_wp) return
      if (has_stick(model)) then
         call prepare_contact(model, state%position, contact, accuracy, setting, &
            & (now%traction - now%shear)/max(now%boundary_capacity, tiny(1.0_wp)))
      else
         call prepare_contact(model, state%position, contact, accuracy, setting)
      end if
      do round = 1, most_rounds
         call evaluate_contact(model, state%position, setting, state%contact%load, contact, parts, change)
         if (abs(change) <= accuracy) exit
      end do
   end subroutine closed_contact

   !> Values of a quantity of a record by its name.
   function column(record, name) result(values)
      !> The record
      type(ehl_record_t), intent(in) :: record
      !> Name of the quantity
      character(len=*), intent(in) :: name
      !> Its values over the angle [unit of the quantity]
      real(wp) :: values(size(record%angle))

      type(quantity_t), allocatable :: list(:)

      call list_ehl_quantities(cycle_quantities, list)
      values = record%values(:, find_quantity(list, name))
   end function column

end module camroller_ehl_record
