!> A model: the case made ready for evaluation, laws chosen and constants derived, for one lobe shape.
!>
!> In: `case_t`. Out: `model_t`. While a cycle is integrated, only inputs change that a host moves within a step (`follow_ramp`);
!> running-in changes the surfaces between cycles. An effect of the case is an allocated component here as well.
module camroller_model
   use camroller_kinds, only : wp, pi, degree
   use camroller_engine, only : cam_turns
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : find_name
   use camroller_axial_setup, only : nose_length, set_axial
   use camroller_axial_table, only : axial_part_t
   use camroller_accuracy, only : check_numerics, is_within, above_zero
   use camroller_cam_surface, only : cam_surface_t
   use camroller_cam_lists, only : check_cam_lists
   use camroller_case, only : case_t, check_bookkeeping, contact_policy_names, energy_names, gas_force_of
   use camroller_lift, only : lift_law_t, new_lift_law, evaluate_lift, stop_angles
   use camroller_kinematics, only : linkage_t, position_t, new_linkage, evaluate_position
   use camroller_dynamics, only : gas_force_t, train_t, moments_t, evaluate_moments, seating_names, load_arm_names
   use camroller_input_ramp, only : ramp_t
   use camroller_pivot, only : assumed_inertia, new_pivot, pivot_t
   use camroller_flexible_parts, only : flexible_t
   use camroller_lash_adjuster, only : set_adjuster_oil
   use camroller_flexible_setup, only : base_load, check_ball, set_flexible
   use camroller_materials, only : combined_modulus, combined_roughness
   use camroller_lubricant, only : lubricant_t, oil_t, get_oil, density_at
   use camroller_film, only : film_law_names, range_policy_names, range_stop, law_masjedi_khonsari_rough, law_table
   use camroller_film_table, only : film_table_t
   use camroller_ehl_problem, only : largest_dry_pressure, speed_range, load_range
   use camroller_ehl_table, only : ehl_t, build_film_table
   use camroller_asperity, only : boundary_part_t, new_boundary_part, set_boundary_temperature
   use camroller_number_text, only : number_text
   use camroller_traction, only : shear_law_names, law_eyring, zone_names, zone_rigid_to_elastic, limit_names, limit_local, &
      & cap_names, rolling_law_names
   use camroller_heat, only : heat_part_t, new_heat_part, set_heat_oil
   use camroller_needle, only : bearing_part_t, new_bearing_part, set_bearing_oil
   use camroller_needle_drag, only : drag_part_t, new_drag_part, set_drag_oil, set_drag_speed
   use camroller_guide, only : guide_part_t, new_guide_part, set_guide_oil
   use camroller_joints, only : joints_t, set_joint_oil
   use camroller_joint_setup, only : set_joints
   use camroller_roller, only : spin_names, ring_inertia
   use camroller_gas, only : gas_law_t, new_gas_law, gas_force
   implicit none
   private

   public :: model_t, new_model, revise_model, set_operating_point, set_speed, evaluate_geometry

   !> A model of one lobe and its follower
   type :: model_t
      !> Lobe shape: 1 with the case's lift, 2 with its second lift
      integer :: lobe = 1
      !> Is the energy balance closed?
      logical :: is_consistent
      !> Is the contact normal's exact arm used? Does pure rolling follow the turning of that normal?
      logical :: has_exact_arm, has_exact_spin
      !> Is the load the larger of base circle load and event load?
      logical :: takes_maximum_load
      !> Does rolling resistance act on the roller's spin? Is the film's stress limited at each point? Is the film sheared over the
      !> strip from rigid to elastic contacts?
      logical :: has_rolling_in_balance, has_local_limit, has_wide_shear
      !> End with an error where the film law is used outside its range, where contact is lost?
      logical :: stops_outside_range, stops_without_contact
      !> Positions in the lists of names of the laws
      integer :: film_law, shear_law, cap, rolling_law
      type(linkage_t) :: linkage
      type(train_t) :: train
      !> Joint between finger and adjuster; allocated where the finger's mass is known
      type(pivot_t), allocatable :: pivot
      !> What bends and leaves contact; allocated where the train is flexible
      type(flexible_t), allocatable :: flexible
      type(lift_law_t) :: lift_law
      type(gas_law_t), allocatable :: gas
      type(lubricant_t) :: lubricant
      type(oil_t) :: oil
      type(boundary_part_t), allocatable :: boundary
      !> Surfaces of cam and roller that differ from those of the case, after hours of running
      type(cam_surface_t), allocatable :: surface
      type(heat_part_t), allocatable :: heat
      !> Load along the roller
      type(axial_part_t), allocatable :: axial
      type(bearing_part_t), allocatable :: bearing
      !> Drag of the oil in that bearing
      type(drag_part_t), allocatable :: drag
      !> Numerical film: how, and films over speed and load for the oil at its temperature
      type(ehl_t), allocatable :: ehl
      type(film_table_t), allocatable :: film_table
      !> Guide of the valve
      type(guide_part_t), allocatable :: guide
      !> Sliding joints; allocated where the case has any
      type(joints_t), allocatable :: joints
      !> Equivalent modulus, E' [Pa]
      real(wp) :: modulus
      !> Composite roughness, sigma [m]
      real(wp) :: roughness
      !> Hardness of the softer body [Pa]
      real(wp) :: hardness
      !> Length of the contact, L [m]
      real(wp) :: contact_width
      !> Outer radius of the roller, r_R [m]
      real(wp) :: roller_radius
      !> Inertia of the roller about its axis, I_R [kg m^2]
      real(wp) :: roller_inertia
      !> Base circle load, W_base [N]
      real(wp) :: base_circle_load
      !> Limiting traction coefficient [-]; limiting stress without pressure, zero where the limit is that of all of the film [Pa]
      real(wp) :: limiting_coefficient, limiting_stress
      !> Eyring stress [Pa]
      real(wp) :: eyring_stress
      !> Cam speed, omega [rad/s]
      real(wp) :: speed
      !> Its change with the cam angle, over a step of a host program [rad/s over rad]
      real(wp) :: speed_slope = 0.0_wp
      !> Turns of the crankshaft in one of the camshaft, 0 without an engine, for messages [-]
      real(wp) :: crank_turns = 0.0_wp
      type(ramp_t) :: ramp
      !> Cam angles from full lift, within one turn, where the lift's third derivative jumps [rad]
      real(wp), allocatable :: lift_stops(:)
   end type model_t

   !> Numerical film: by how much slip and asperities may lower or raise speed and load of the film, and the smallest part of the
   !> largest that is solved for; beyond them the film goes on as a power law [-]
   real(wp), parameter :: table_margins(2) = [0.4_wp, 1.3_wp], smallest_part = 1.0e-3_wp

contains

   !> Build a model from a case; refuses what cannot be put together.
   subroutine new_model(model, case, lobe, error)
      !> The model
      type(model_t), intent(out) :: model
      !> A case
      type(case_t), intent(in) :: case
      !> Lobe shape: 1 with the case's lift, 2 with its second lift, which must be there
      integer, intent(in) :: lobe
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      call choose_laws(model, case, error)
      if (allocated(error)) return
      call check_bookkeeping(case, error)
      if (allocated(error)) return
      call new_linkage(model%linkage, case%mechanism, error)
      if (allocated(error)) return
      model%lobe = lobe
      if (lobe == 1) then
         call new_lift_law(model%lift_law, case%lift, error)
      else
         call new_lift_law(model%lift_law, case%second_lift, error)
      end if
      if (allocated(error)) return
      model%lift_stops = stop_angles(model%lift_law)
      call set_contact(model, case, error)
      if (allocated(error)) return
      call set_train(model, case, error)
      if (allocated(error)) return
      call set_effects(model, case, error)
      if (allocated(error)) return
      call set_operating_point(model, case%operating_point%speed, case%operating_point%oil_temperature, error)
   end subroutine new_model

   !> Give a model the effects and laws of another case with the same geometry, masses and spring: no spline is fitted again, and
   !> films are not solved again where oil and solution stay as they are.
   subroutine revise_model(model, case, error)
      !> The model of a case that differs in effects and laws alone
      type(model_t), intent(inout) :: model
      !> A case
      type(case_t), intent(in) :: case
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(ehl_t), allocatable :: ehl
      logical :: has_same_films

      has_same_films = allocated(model%film_table) .and. allocated(case%ehl) .and. &
         & model%lubricant%pressure_law == case%lubricant%pressure_law
      if (allocated(model%boundary)) deallocate (model%boundary)
      if (allocated(model%surface)) deallocate (model%surface)
      if (allocated(model%heat)) deallocate (model%heat)
      if (allocated(model%bearing)) deallocate (model%bearing)
      if (allocated(model%drag)) deallocate (model%drag)
      if (allocated(model%guide)) deallocate (model%guide)
      if (allocated(model%gas)) deallocate (model%gas)
      if (allocated(model%joints)) deallocate (model%joints)
      if (allocated(model%flexible)) deallocate (model%flexible)
      if (allocated(model%ehl)) deallocate (model%ehl)
      call choose_laws(model, case, error)
      if (allocated(error)) return
      call check_bookkeeping(case, error)
      if (allocated(error)) return
      call set_contact(model, case, error)
      if (allocated(error)) return
      call set_effects(model, case, error)
      if (allocated(error)) return
      if (has_same_films) then
         call move_alloc(model%ehl, ehl)
      else if (allocated(model%film_table)) then
         deallocate (model%film_table)
      end if
      call set_operating_point(model, case%operating_point%speed, case%operating_point%oil_temperature, error)
      if (allocated(ehl)) call move_alloc(ehl, model%ehl)
   end subroutine revise_model

   !> Speed and temperature: everything that follows from them. After an error the model is of no use.
   subroutine set_operating_point(model, speed, oil_temperature, error)
      !> The model
      type(model_t), intent(inout) :: model
      !> Cam speed [rad/s]
      real(wp), intent(in) :: speed
      !> Temperature of the oil [K]
      real(wp), intent(in) :: oil_temperature
      !> Deck or domain error
      type(error_t), allocatable, intent(out) :: error

      if (.not. is_within(speed, above_zero, huge(speed))) then
         call raise(error, kind_deck, "operating point: the speed must be positive and finite")
      else if (.not. is_within(oil_temperature, above_zero, huge(speed))) then
         call raise(error, kind_deck, "operating point: the oil temperature must be finite and above -273.15 degC, 0 K")
      end if
      if (allocated(error)) return
      call set_speed(model, speed)
      call get_oil(model%lubricant, oil_temperature, model%oil, error)
      if (allocated(error)) return
      if (allocated(model%boundary)) call set_boundary_temperature(model%boundary, oil_temperature)
      if (allocated(model%guide)) call set_guide_oil(model%guide, model%oil%viscosity)
      if (allocated(model%joints)) call set_joint_oil(model%joints, model%oil%viscosity)
      if (allocated(model%flexible)) then
         if (allocated(model%flexible%adjuster)) call set_adjuster_oil(model%flexible%adjuster, model%oil%viscosity)
      end if
      if (allocated(model%bearing)) call set_bearing_oil(model%bearing, model%oil%viscosity, &
         & density_at(model%lubricant, oil_temperature))
      if (allocated(model%drag)) call set_drag_oil(model%drag, model%oil%viscosity/density_at(model%lubricant, oil_temperature))
      if (allocated(model%heat)) call set_heat_oil(model%heat, model%lubricant, oil_temperature, model%oil, error)
      if (allocated(error)) return
      if (allocated(model%ehl)) call set_film_table(model, error)
   end subroutine set_operating_point

   !> Speed alone, with the oil as it is. Films solved beforehand stay.
   pure subroutine set_speed(model, speed)
      !> The model
      type(model_t), intent(inout) :: model
      !> Cam speed, above zero [rad/s]
      real(wp), intent(in) :: speed

      model%speed = speed
      if (allocated(model%bearing)) model%bearing%reversal_spin = model%bearing%reversal_ratio*speed
      if (allocated(model%drag)) call set_drag_speed(model%drag, speed)
   end subroutine set_speed

   !> Films for every speed and load that the cycle may have.
   subroutine set_film_table(model, error)
      type(model_t), intent(inout) :: model
      !> Domain error beyond the range of numerical solutions; convergence error where their accuracy is not reached
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: position
      type(moments_t) :: moments
      ! Groups U in pure rolling and W* without friction, smallest and largest; one of them [-]; gas force, load [N]; E'R [N/m]
      real(wp) :: speeds(2), loads(2), group, force, load, scale
      integer :: i, status

      speeds = [huge(1.0_wp), 0.0_wp]
      loads = [huge(1.0_wp), 0.0_wp]
      force = 0.0_wp
      do i = 1, 180
         call evaluate_geometry(model, 2.0_wp*i*degree, position, status)
         if (status /= 0) cycle
         if (allocated(model%gas)) force = gas_force(model%gas, 2.0_wp*i*degree)
         call evaluate_moments(model%train, position, model%speed, force, moments)
         scale = model%modulus*position%equivalent_radius
         group = model%oil%viscosity*model%speed*abs(position%surface_travel)/scale
         speeds = [min(speeds(1), group), max(speeds(2), group)]
         load = moments%total/position%normal_arm
         if (model%takes_maximum_load) load = max(load, model%base_circle_load)
         if (load <= 0.0_wp) cycle
         group = load/(scale*model%contact_width)
         loads = [min(loads(1), group), max(loads(2), group)]
      end do
      speeds = [max(speeds(1)*table_margins(1), speeds(2)*smallest_part, speed_range(1)), speeds(2)*table_margins(2)]
      loads = [max(loads(1)*table_margins(1), loads(2)*smallest_part, load_range(1)), &
         & max(loads(2), min(loads(2)*table_margins(2), 2.0_wp*pi*(largest_dry_pressure/model%modulus)**2))]
      if (allocated(model%film_table)) deallocate (model%film_table)
      allocate (model%film_table)
      call build_film_table(model%film_table, model%ehl, model%oil, model%modulus, speeds, loads, error)
   end subroutine set_film_table

   !> Geometry at a cam angle.
   pure subroutine evaluate_geometry(model, angle, position, status, path_only, moments_only)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Geometry there
      type(position_t), intent(out) :: position
      !> 0 fine, negative: the finger cannot reach this lift
      integer, intent(out) :: status
      !> Is the roller's path over the cam all that is wanted, or what moments take? See `evaluate_position`
      logical, intent(in), optional :: path_only, moments_only

      real(wp) :: lift(0:3) ! lift and its first three derivatives [m/rad^n]

      call evaluate_lift(model%lift_law, angle, lift)
      call evaluate_position(model%linkage, lift, position, status, path_only, moments_only)
      position%angle = angle
   end subroutine evaluate_geometry

   !> Laws by name; numerics that mean nothing are refused.
   subroutine choose_laws(model, case, error)
      type(model_t), intent(inout) :: model
      type(case_t), intent(in) :: case
      !> Deck error that lists the known names
      type(error_t), allocatable, intent(out) :: error

      integer :: choice

      call check_numerics(case%numerics, error)
      if (allocated(case%cam_bearings) .and. .not. allocated(error)) call check_cam_lists(case%cam_bearings, &
         & allocated(case%second_lift), error)
      if (allocated(error)) return
      call find_name("energy bookkeeping", case%energy, energy_names, choice, error)
      if (allocated(error)) return
      model%is_consistent = choice == 1
      call find_name("load arm", case%spring%load_arm, load_arm_names, choice, error)
      if (allocated(error)) return
      model%has_exact_arm = choice == 1
      call find_name("spin", case%roller%spin, spin_names, choice, error)
      if (allocated(error)) return
      model%has_exact_spin = choice == 1
      call find_name("seating", case%spring%seating, seating_names, choice, error)
      if (allocated(error)) return
      model%takes_maximum_load = choice == 2
      call find_name("range policy", case%film%range_policy, range_policy_names, choice, error)
      if (allocated(error)) return
      model%stops_outside_range = choice == range_stop
      call find_name("contact policy", case%contact_policy, contact_policy_names, choice, error)
      if (allocated(error)) return
      model%stops_without_contact = choice == 2
      ! A lash parts cam and roller in every turn
      if (allocated(case%dynamics)) model%stops_without_contact = choice == 2 .and. case%dynamics%lash <= 0.0_wp
      call find_name("film law", case%film%law, film_law_names, model%film_law, error)
      if (allocated(error)) return
      if (allocated(case%ehl)) then
         model%ehl = case%ehl
         model%film_law = law_table
      end if
      call find_name("shear law", case%traction%shear_law, shear_law_names, model%shear_law, error)
      if (allocated(error)) return
      call find_name("sheared zone", case%traction%sheared_zone, zone_names, choice, error)
      if (allocated(error)) return
      model%has_wide_shear = choice == zone_rigid_to_elastic
      call find_name("traction limit", case%traction%limit, limit_names, choice, error)
      if (allocated(error)) return
      model%has_local_limit = choice == limit_local
      call find_name("traction cap", case%traction%cap, cap_names, model%cap, error)
      if (allocated(error)) return
      call find_name("rolling law", case%traction%rolling_law, rolling_law_names, model%rolling_law, error)
   end subroutine choose_laws

   !> Constants of the contact.
   subroutine set_contact(model, case, error)
      type(model_t), intent(inout) :: model
      type(case_t), intent(in) :: case
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      model%modulus = combined_modulus(case%materials%cam_modulus, case%materials%cam_poisson_ratio, &
         & case%materials%roller_modulus, case%materials%roller_poisson_ratio)
      model%roughness = combined_roughness(case%surface%cam_roughness, case%surface%roller_roughness)
      model%hardness = case%materials%hardness
      model%contact_width = case%mechanism%contact_width
      model%roller_radius = case%mechanism%roller_radius
      model%lubricant = case%lubricant
      model%limiting_coefficient = case%traction%limiting_coefficient
      model%limiting_stress = merge(case%traction%limiting_stress, 0.0_wp, model%has_local_limit)
      model%eyring_stress = case%traction%eyring_stress
      model%has_rolling_in_balance = case%traction%in_roller_balance
      if (.not. model%roughness > 0.0_wp) then
         call raise(error, kind_deck, "surface: the composite roughness must be positive")
      else if (.not. (model%contact_width > 0.0_wp .and. model%modulus > 0.0_wp)) then
         call raise(error, kind_deck, "mechanism and materials: contact width and moduli must be positive")
      else if (.not. (model%limiting_coefficient > 0.0_wp .and. case%traction%limiting_stress >= 0.0_wp)) then
         call raise(error, kind_deck, "traction: the limiting coefficient must be positive, the limiting stress not negative")
      else if (model%shear_law == law_eyring .and. .not. model%eyring_stress > 0.0_wp) then
         call raise(error, kind_deck, "traction: the Eyring law needs a positive eyring stress")
      else if (model%film_law == law_masjedi_khonsari_rough .and. .not. model%hardness > 0.0_wp) then
         call raise(error, kind_deck, "materials: the film law 'masjedi_khonsari_rough' needs the hardness")
      end if
   end subroutine set_contact

   !> Masses, spring and seat.
   !>
   !> The adjuster presses the closed valve's tip with `W_base h_W/(B sin(gamma_B + chi))`; the seat carries what is left of the
   !> spring's preload, and needs some to carry.
   subroutine set_train(model, case, error)
      !> The model with its linkage
      type(model_t), intent(inout) :: model
      type(case_t), intent(in) :: case
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(position_t) :: closed
      ! Force of the adjuster at the valve's tip [N]
      real(wp) :: tip_force
      integer :: status

      call evaluate_position(model%linkage, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], closed, status)
      model%base_circle_load = base_load(case, model%linkage, closed)
      model%train%valve_mass = case%masses%valve
      model%train%finger_inertia = case%masses%finger_inertia
      if (case%masses%finger_inertia <= 0.0_wp) model%train%finger_inertia = assumed_inertia(case%masses%finger, &
         & case%mechanism%pivot_to_pad)
      model%train%stiffness = case%spring%stiffness
      model%train%precompression = case%spring%precompression
      model%roller_inertia = ring_inertia(case%roller%mass, model%roller_radius, model%roller_radius - case%roller%wall_thickness)
      if (.not. model%roller_inertia > 0.0_wp .or. case%roller%wall_thickness > model%roller_radius) then
         call raise(error, kind_deck, "roller: the mass must be positive and the wall thinner than the radius")
         return
      end if
      if (case%masses%finger > 0.0_wp) then
         allocate (model%pivot)
         call new_pivot(model%pivot, case%masses%finger, model%train%finger_inertia, case%masses%finger_centre, &
            & case%mechanism%valve_axis_angle, case%mechanism%adjuster_tilt, error)
      end if
      if (allocated(error) .or. model%takes_maximum_load) return

      tip_force = model%base_circle_load*merge(closed%normal_arm, closed%parallel_arm, model%has_exact_arm)/closed%valve_arm
      model%train%closed_seat_force = model%train%stiffness*model%train%precompression - tip_force
      if (model%train%closed_seat_force <= 0.0_wp) then
         call raise(error, kind_deck, "the lash adjuster lifts the valve off its seat: spring.base_circle_load_N presses the "// &
            & "valve with "//number_text(tip_force, 6)//" N, the closed spring holds "// &
            & number_text(model%train%stiffness*model%train%precompression, 6)//" N; lower it, raise "// &
            & "spring.stiffness_N_m or spring.precompression_mm, or choose seating = 'maximum' with energy = 'source'")
         return
      end if
      model%train%seat_lift = 2.0_wp*model%train%closed_seat_force/case%spring%seat_stiffness
   end subroutine set_train

   !> Effects that the case has.
   subroutine set_effects(model, case, error)
      type(model_t), intent(inout) :: model
      type(case_t), intent(in) :: case
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(gas_force_t) :: gas

      call set_axial(model%axial, case%roller_profile, allocated(case%ehl), model%linkage, model%lift_law, model%contact_width, &
         & model%modulus, error)
      if (allocated(error)) return
      model%crank_turns = 0.0_wp
      if (allocated(case%engine)) model%crank_turns = cam_turns(case%engine)
      if (allocated(case%asperity)) then
         allocate (model%boundary)
         call new_boundary_part(model%boundary, case%asperity, model%modulus, model%hardness, &
            & model%film_law == law_masjedi_khonsari_rough, error, case%friction_modifier, case%boundary_law)
         if (allocated(error)) return
      end if
      if (allocated(case%heat)) then
         allocate (model%heat)
         call new_heat_part(model%heat, case%heat, error)
         if (allocated(error)) return
      end if
      if (allocated(case%needle_bearing)) then
         allocate (model%bearing)
         call new_bearing_part(model%bearing, case%needle_bearing, model%roller_radius - case%roller%wall_thickness, &
            & allocated(case%needle_drag), error)
         if (allocated(error)) return
      end if
      if (allocated(case%needle_drag)) then
         allocate (model%drag)
         call new_drag_part(model%drag, case%needle_drag, error)
         if (allocated(error)) return
      end if
      if (allocated(case%valve_guide)) then
         allocate (model%guide)
         call new_guide_part(model%guide, case%valve_guide)
      end if
      call set_joints(model%joints, case, model%linkage, model%lift_law, error)
      if (allocated(error)) return
      if (allocated(case%gas_force)) then
         allocate (model%gas)
         call gas_force_of(case, model%lobe, gas)
         call new_gas_law(model%gas, gas, error)
         if (allocated(error)) return
      end if
      if (allocated(case%dynamics)) then
         allocate (model%flexible)
         call set_flexible(model%flexible, case, model%lift_law, model%linkage, model%train, model%pivot, model%modulus, &
            & nose_length(model%contact_width, model%linkage, model%lift_law, model%train, model%axial), &
            & model%base_circle_load, error)
         if (.not. allocated(error) .and. allocated(model%joints)) call check_ball(model%flexible, model%train, &
            & model%joints%pivot, error)
      end if
   end subroutine set_effects

end module camroller_model
