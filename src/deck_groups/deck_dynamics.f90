!> A flexible train in a deck: its keys, what they give, and the rules between them.
!>
!> In: defaults of the types; settings. Out: groups and keys in the schema; components of a case; a mistake for each broken rule.
module camroller_deck_dynamics
   use camroller_accuracy, only : has_error_control
   use camroller_case, only : case_t, energy_names, energy_source
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : add_group, add_integer, add_name, add_number, from_to, group_effect, not_negative, &
      & positive, range_t, schema_t
   use camroller_flexible_parts, only : dynamics_t
   use camroller_kinds, only : pi, wp
   use camroller_lash_adjuster, only : lash_adjuster_t, leak_end_names
   use camroller_mistakes, only : mistakes_t
   use camroller_number_text, only : number_text
   use camroller_settings, only : get_word, has_group, is_known, is_wrong, settings_t, take
   use camroller_spring_modes, only : most_modes, spring_surge_t
   implicit none
   private

   public :: add_dynamics_keys, fill_dynamics, check_dynamics

contains

   !> Groups of a flexible train.
   subroutine add_dynamics_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(dynamics_t) :: standard

      call add_group(schema, "dynamics", group_effect, "a train that bends, leaves contact and returns")
      call add_number(schema, "finger_stiffness_N_m", positive, "stiffness of the finger in bending, with pin and shaft, at "// &
         & "the roller; the default, as those of pad and seat, is of a train with mechanism.pivot_to_roller_mm = 20.8, and "// &
         & "stiffness goes with the size", default=standard%finger_stiffness)
      call add_number(schema, "contact_damping_s_m", not_negative, "damping of cam and roller: force over the elastic one less "// &
         & "1, per speed of approach", default=standard%contact_damping)
      call add_number(schema, "pad_stiffness_N_m", positive, "stiffness of the finger's pad and the valve's stem", &
         & default=standard%pad_stiffness)
      call add_number(schema, "pad_damping_s_m", not_negative, "damping of the pad, as of cam and roller", &
         & default=standard%pad_damping)
      call add_number(schema, "seat_stiffness_N_m", positive, "stiffness of the seat and the valve's head; with "// &
         & "&gas_force it decides how far the gas presses the closed valve, and the finger onto the cam", &
         & default=standard%seat_stiffness)
      call add_number(schema, "seat_damping_s_m", not_negative, "damping of the seat, as of cam and roller", &
         & default=standard%seat_damping)
      call add_number(schema, "seat_restitution", range_t(0.0_wp, 1.0_wp, .false., .false.), &
         & "speed after over speed before an impact on the seat without other forces, in the place of seat_damping_s_m", &
         & is_optional=.true.)
      call add_number(schema, "seat_restitution_speed_m_s", positive, "speed of that impact", &
         & default=standard%seat_restitution_speed)
      call add_number(schema, "lash_mm", not_negative, "clearance at the pad of a valve that touches its seat without force, "// &
         & "of a train without a lash adjuster; 0: the base circle load presses it together. The closed valve sinks into its "// &
         & "seat by the spring's force over seat_stiffness_N_m, and has as much less: below that the spring presses the "// &
         & "roller onto the base circle", default=standard%lash)
      call add_surge_keys(schema)
      call add_adjuster_keys(schema)
   end subroutine add_dynamics_keys

   !> The spring's mass.
   subroutine add_surge_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(spring_surge_t) :: standard

      call add_group(schema, "spring_surge", group_effect, "waves in the valve spring of a flexible train")
      call add_number(schema, "mass_kg", positive, "mass of the spring's active coils, a third of which masses.valve_kg holds", &
         & example="0.036")
      call add_integer(schema, "modes", from_to(1.0_wp, real(most_modes, wp)), "number of modes", standard%modes)
      call add_number(schema, "damping_ratio", range_t(0.0_wp, 1.0_wp), "damping ratio of each mode: 0.003 for one wire to "// &
         & "0.05 for nested springs", default=standard%damping_ratio)
   end subroutine add_surge_keys

   !> The lash adjuster.
   subroutine add_adjuster_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(lash_adjuster_t) :: standard

      call add_group(schema, "lash_adjuster", group_effect, "hydraulic lash adjuster under the pivot of a flexible train")
      call add_number(schema, "diameter_mm", positive, "diameter of the plunger", default=standard%diameter)
      call add_number(schema, "volume_cm3", positive, "volume of the chamber with the plunger in its middle place", &
         & default=standard%volume)
      call add_number(schema, "gap_um", positive, "radial gap of the plunger", default=standard%gap)
      call add_number(schema, "eccentricity", range_t(0.0_wp, 1.0_wp), "eccentricity of the plunger over the gap", &
         & default=standard%eccentricity)
      call add_number(schema, "leak_length_mm", positive, "length of the gap", default=standard%leak_length)
      call add_name(schema, "leak_end", leak_end_names, standard%leak_end, &
         & "where the leak ends: in the feed, or outside at ambient pressure")
      call add_number(schema, "plunger_mass_kg", positive, "mass of the plunger", default=standard%plunger_mass)
      call add_number(schema, "plunger_spring_N", positive, "force of the plunger's spring in its middle position; it makes "// &
         & "the base circle load, in the place of spring.base_circle_load_N", is_optional=.true.)
      call add_number(schema, "plunger_stiffness_N_m", not_negative, "stiffness of the plunger's spring", &
         & default=standard%spring_stiffness)
      call add_number(schema, "check_area_mm2", positive, "area of the check valve", default=standard%check_area)
      call add_number(schema, "discharge_coefficient", range_t(0.0_wp, 1.0_wp, .false.), &
         & "discharge coefficient of the check valve", default=standard%discharge_coefficient)
      call add_number(schema, "crack_pressure_kPa", not_negative, "pressure at which the check valve opens", &
         & default=standard%crack_pressure)
      call add_number(schema, "full_pressure_kPa", positive, "further pressure at which it is full open", &
         & default=standard%full_pressure)
      call add_number(schema, "transition_pressure_kPa", positive, "pressure difference below which its flow is laminar", &
         & default=standard%transition_pressure)
      call add_number(schema, "supply_pressure_MPa", positive, "pressure of the oil supply above ambient", &
         & default=standard%supply_pressure)
      call add_number(schema, "air_content", range_t(1.0e-4_wp, 0.5_wp), "volume of free air over that of oil and air, at "// &
         & "ambient pressure", default=standard%air_content)
      call add_number(schema, "oil_modulus_GPa", positive, "bulk modulus of the oil without air", default=standard%oil_modulus)
      call add_number(schema, "density_kg_m3", positive, "density of the oil with its air at ambient pressure", &
         & default=standard%density)
      call add_number(schema, "lowest_mm", range_t(largest=0.0_wp, with_largest=.false.), "lower stop of the plunger, from its "// &
         & "middle place", default=standard%lowest)
      call add_number(schema, "highest_mm", positive, "upper stop of the plunger, towards the cam", default=standard%highest)
      call add_number(schema, "stop_stiffness_N_m", positive, "stiffness of both stops", default=standard%stop_stiffness)
      call add_number(schema, "stop_damping_s_m", not_negative, "damping of both stops, as of cam and roller", &
         & default=standard%stop_damping)
   end subroutine add_adjuster_keys

   !> Fill the components of a flexible train.
   subroutine fill_dynamics(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, "dynamics")) return
      allocate (case%dynamics)
      associate (dynamics => case%dynamics)
         call take(settings, "dynamics", "finger_stiffness_N_m", dynamics%finger_stiffness)
         call take(settings, "dynamics", "contact_damping_s_m", dynamics%contact_damping)
         call take(settings, "dynamics", "pad_stiffness_N_m", dynamics%pad_stiffness)
         call take(settings, "dynamics", "pad_damping_s_m", dynamics%pad_damping)
         call take(settings, "dynamics", "seat_stiffness_N_m", dynamics%seat_stiffness)
         call take(settings, "dynamics", "seat_damping_s_m", dynamics%seat_damping)
         call take(settings, "dynamics", "seat_restitution", dynamics%seat_restitution)
         call take(settings, "dynamics", "seat_restitution_speed_m_s", dynamics%seat_restitution_speed)
         call take(settings, "dynamics", "lash_mm", dynamics%lash)
      end associate
      if (has_group(settings, "spring_surge")) then
         allocate (case%spring_surge)
         call take(settings, "spring_surge", "mass_kg", case%spring_surge%mass)
         call take(settings, "spring_surge", "modes", case%spring_surge%modes)
         call take(settings, "spring_surge", "damping_ratio", case%spring_surge%damping_ratio)
      end if
      if (has_group(settings, "lash_adjuster")) call fill_adjuster(settings, case)
   end subroutine fill_dynamics

   !> Fill the lash adjuster.
   subroutine fill_adjuster(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      character(len=*), parameter :: group = "lash_adjuster"

      allocate (case%lash_adjuster)
      associate (adjuster => case%lash_adjuster)
         call take(settings, group, "diameter_mm", adjuster%diameter)
         call take(settings, group, "volume_cm3", adjuster%volume)
         call take(settings, group, "gap_um", adjuster%gap)
         call take(settings, group, "eccentricity", adjuster%eccentricity)
         call take(settings, group, "leak_length_mm", adjuster%leak_length)
         call take(settings, group, "leak_end", adjuster%leak_end)
         call take(settings, group, "plunger_mass_kg", adjuster%plunger_mass)
         call take(settings, group, "plunger_spring_N", adjuster%spring_force)
         call take(settings, group, "plunger_stiffness_N_m", adjuster%spring_stiffness)
         call take(settings, group, "check_area_mm2", adjuster%check_area)
         call take(settings, group, "discharge_coefficient", adjuster%discharge_coefficient)
         call take(settings, group, "crack_pressure_kPa", adjuster%crack_pressure)
         call take(settings, group, "full_pressure_kPa", adjuster%full_pressure)
         call take(settings, group, "transition_pressure_kPa", adjuster%transition_pressure)
         call take(settings, group, "supply_pressure_MPa", adjuster%supply_pressure)
         call take(settings, group, "air_content", adjuster%air_content)
         call take(settings, group, "oil_modulus_GPa", adjuster%oil_modulus)
         call take(settings, group, "density_kg_m3", adjuster%density)
         call take(settings, group, "lowest_mm", adjuster%lowest)
         call take(settings, group, "highest_mm", adjuster%highest)
         call take(settings, group, "stop_stiffness_N_m", adjuster%stop_stiffness)
         call take(settings, group, "stop_damping_s_m", adjuster%stop_damping)
      end associate
   end subroutine fill_adjuster

   !> Rules of a flexible train.
   subroutine check_dynamics(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: parts(*) = [character(len=13) :: "spring_surge", "lash_adjuster"]
      ! Lash [m]
      real(wp) :: lash
      integer :: i

      do i = 1, size(parts)
         if (.not. has_group(settings, trim(parts(i))) .or. has_group(settings, "dynamics")) cycle
         call complain_about_group(mistakes, settings, trim(parts(i)), "&"//trim(parts(i))//" needs &dynamics: it is a part of "// &
            & "a flexible train")
      end do
      call load_is_given_once(settings, mistakes)
      if (.not. has_group(settings, "dynamics")) return
      if (get_word(settings, "case", "energy") == energy_names(energy_source)) call complain_about_group(mistakes, &
         & settings, "dynamics", "&dynamics needs case energy = 'consistent'")
      if (has_group(settings, "asperity")) then
         if (get_word(settings, "asperity", "mobilisation") == "stick_slip") call complain(mistakes, settings, "asperity", &
            & "mobilisation", "'mobilisation' must be 'regularised' with &dynamics")
      end if
      if (.not. has_error_control(get_word(settings, "numerics", "method")) .or. &
         & get_word(settings, "numerics", "method") == "hermite") call complain(mistakes, settings, "numerics", "method", &
         & "'method' must be 'automatic', 'rodas5p', 'radau5' or 'dormand_prince' with &dynamics")
      if (has_group(settings, "lash_adjuster")) then
         lash = 0.0_wp
         call take(settings, "dynamics", "lash_mm", lash)
         if (lash > 0.0_wp) call complain(mistakes, settings, "dynamics", "lash_mm", "'lash_mm' must be 0 with &lash_adjuster, "// &
            & "which leaves no lash")
         call chamber_keeps_a_volume(settings, mistakes)
      end if
      call finger_is_known(settings, mistakes)
      call spring_leaves_a_valve(settings, mistakes)
   end subroutine check_dynamics

   !> The base circle load is given, or the plunger's spring that makes it.
   subroutine load_is_given_once(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      logical :: has_spring

      has_spring = .false.
      if (has_group(settings, "lash_adjuster")) has_spring = is_known(settings, "lash_adjuster", "plunger_spring_N")
      if (is_known(settings, "spring", "base_circle_load_N")) then
         if (has_spring) call complain(mistakes, settings, "lash_adjuster", "plunger_spring_N", "'plunger_spring_N' makes the "// &
            & "base circle load; give it or spring 'base_circle_load_N', not both")
      else if (.not. has_spring .and. has_group(settings, "spring") .and. .not. is_wrong(settings, "spring", &
         & "base_circle_load_N")) then
         call complain_about_group(mistakes, settings, "spring", "&spring needs 'base_circle_load_N'")
      end if
   end subroutine load_is_given_once

   !> The finger's own mass moves with the pivot.
   subroutine finger_is_known(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Masses [kg]
      real(wp) :: finger, valve

      if (.not. has_group(settings, "masses")) return
      finger = 0.0_wp
      call take(settings, "masses", "finger_kg", finger)
      if (finger <= 0.0_wp .and. .not. is_wrong(settings, "masses", "finger_kg")) call complain_about_group(mistakes, settings, &
         & "masses", "&dynamics needs masses 'finger_kg' above 0")
      valve = 1.0_wp
      call take(settings, "masses", "valve_kg", valve)
      if (valve <= 0.0_wp .and. .not. is_wrong(settings, "masses", "valve_kg")) call complain(mistakes, settings, "masses", &
         & "valve_kg", "'valve_kg' must be above 0 with &dynamics")
   end subroutine finger_is_known

   !> Down to its lower stop the plunger leaves a chamber.
   subroutine chamber_keeps_a_volume(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      type(lash_adjuster_t) :: adjuster
      ! Volume that the plunger displaces from its middle place to its lower stop [m^3]
      real(wp) :: displaced

      call take(settings, "lash_adjuster", "diameter_mm", adjuster%diameter)
      call take(settings, "lash_adjuster", "volume_cm3", adjuster%volume)
      call take(settings, "lash_adjuster", "lowest_mm", adjuster%lowest)
      if (min(adjuster%diameter, adjuster%volume) <= 0.0_wp) return
      displaced = 0.25_wp*pi*adjuster%diameter**2*abs(adjuster%lowest)
      if (adjuster%volume > displaced) return
      call complain(mistakes, settings, "lash_adjuster", "volume_cm3", "'volume_cm3' must be above the "// &
         & number_text(1.0e6_wp*displaced, 4)//" cm3 that the plunger displaces down to 'lowest_mm' = "// &
         & number_text(1.0e3_wp*adjuster%lowest, 4))
   end subroutine chamber_keeps_a_volume

   !> The valve's mass holds a third of the spring's.
   subroutine spring_leaves_a_valve(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Masses [kg]
      real(wp) :: spring, valve

      if (.not. has_group(settings, "spring_surge")) return
      if (.not. (is_known(settings, "spring_surge", "mass_kg") .and. is_known(settings, "masses", "valve_kg"))) return
      call take(settings, "spring_surge", "mass_kg", spring)
      call take(settings, "masses", "valve_kg", valve)
      if (spring < 3.0_wp*valve) return
      call complain(mistakes, settings, "spring_surge", "mass_kg", "a third of 'mass_kg' must be below masses 'valve_kg', "// &
         & "which holds it")
   end subroutine spring_leaves_a_valve

end module camroller_deck_dynamics
