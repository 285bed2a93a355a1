!> A flexible train in a deck: its keys, what they give, and the rules between them.
!>
!> In: keys, settings. Out: the groups; components of a case; a mistake for each broken rule.
module camroller_deck_dynamics
   use camroller_accuracy, only : has_error_control
   use camroller_case, only : case_t, energy_names, energy_source
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : group_effect, positive, not_negative, from_to, range_t
   use camroller_kinds, only : pi, wp
   use camroller_lash_adjuster, only : lash_adjuster_t, leak_end_names, usual_supply
   use camroller_mistakes, only : mistakes_t
   use camroller_number_text, only : number_text
   use camroller_settings, only : get_word, has_group, is_known, is_wrong, settings_t, take
   use camroller_spring_modes, only : most_modes
   implicit none
   private

   public :: bind_dynamics, check_dynamics

contains

   !> Groups of a flexible train, and the components of a case.
   subroutine bind_dynamics(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call bind_train(keys, case)
      call bind_surge(keys, case)
      call bind_adjuster(keys, case)
   end subroutine bind_dynamics

   !> The train.
   subroutine bind_train(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("dynamics", group_effect, "a train that bends, leaves contact and returns")
      if (.not. keys%are_wanted(allocated(case%dynamics))) return
      if (.not. allocated(case%dynamics)) allocate (case%dynamics)
      associate (dynamics => case%dynamics)
         ! A steel finger, its pad and a seat yield by some micrometres under some hundred newtons; stamped fingers and thin
         ! valve heads are the softest, by an order, forged ones of trucks the stiffest
         call keys%number("finger_stiffness_N_m", positive, "stiffness of the finger in bending, with pin and shaft, at the "// &
            & "roller; the default, as those of pad and seat, is of a train with mechanism.pivot_to_roller_mm = 20.8, and "// &
            & "stiffness goes with the size", dynamics%finger_stiffness, usual=[1.0e6_wp, 1.0e9_wp])
         ! Steel gives back all but a tenth to three quarters of the speed of an impact at some tenths of a metre per second
         call keys%number("contact_damping_s_m", not_negative, &
            & "damping of cam and roller: force over the elastic one less 1, per speed of approach", dynamics%contact_damping, &
            & usual=[0.0_wp, 10.0_wp])
         call keys%number("pad_stiffness_N_m", positive, "stiffness of the finger's pad and the valve's stem", &
            & dynamics%pad_stiffness, usual=[1.0e6_wp, 1.0e9_wp])
         call keys%number("pad_damping_s_m", not_negative, "damping of the pad, as of cam and roller", dynamics%pad_damping, &
            & usual=[0.0_wp, 10.0_wp])
         call keys%number("seat_stiffness_N_m", positive, "stiffness of the seat and the valve's head; with &gas_force it "// &
            & "decides how far the gas presses the closed valve, and the finger onto the cam", dynamics%seat_stiffness, &
            & usual=[1.0e6_wp, 1.0e9_wp])
         call keys%number("seat_damping_s_m", not_negative, "damping of the seat, as of cam and roller", dynamics%seat_damping, &
            & usual=[0.0_wp, 20.0_wp])
         call keys%number("seat_restitution", range_t(0.0_wp, 1.0_wp, .false., .false.), &
            & "speed after over speed before an impact on the seat without other forces, in the place of seat_damping_s_m", &
            & dynamics%seat_restitution, is_optional=.true., usual=[0.05_wp, 0.95_wp])
         call keys%number("seat_restitution_speed_m_s", positive, "speed of that impact", dynamics%seat_restitution_speed, &
            & usual=[0.02_wp, 3.0_wp])
         ! Cold clearances are 0.1 to 0.4 mm, of large exhaust valves up to 0.8 mm
         call keys%number("lash_mm", not_negative, "clearance at the pad of a valve that touches its seat without force, of a "// &
            & "train without a lash adjuster; 0: the base circle load presses it together. The closed valve sinks into its "// &
            & "seat by the spring's force over seat_stiffness_N_m, and has as much less: below that the spring presses the "// &
            & "roller onto the base circle", dynamics%lash, usual=[0.0_wp, 1.0_wp])
      end associate
   end subroutine bind_train

   !> The spring's mass.
   subroutine bind_surge(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("spring_surge", group_effect, "waves in the valve spring of a flexible train")
      if (.not. keys%are_wanted(allocated(case%spring_surge))) return
      if (.not. allocated(case%spring_surge)) allocate (case%spring_surge)
      ! Wire of 2.5 to 6 mm
      call keys%number("mass_kg", positive, "mass of the spring's active coils, a third of which masses.valve_kg holds", &
         & case%spring_surge%mass, example="0.036", usual=[5.0e-3_wp, 0.5_wp])
      call keys%whole_number("modes", from_to(1.0_wp, real(most_modes, wp)), "number of modes", case%spring_surge%modes)
      call keys%number("damping_ratio", range_t(0.0_wp, 1.0_wp), &
         & "damping ratio of each mode: 0.003 for one wire to 0.05 for nested springs", case%spring_surge%damping_ratio, &
         & usual=[1.0e-3_wp, 0.1_wp])
   end subroutine bind_surge

   !> The lash adjuster.
   subroutine bind_adjuster(keys, case)
      type(keys_t), intent(inout) :: keys
      type(case_t), intent(inout) :: case

      call keys%group("lash_adjuster", group_effect, "hydraulic lash adjuster under the pivot of a flexible train")
      if (.not. keys%are_wanted(allocated(case%lash_adjuster))) return
      if (.not. allocated(case%lash_adjuster)) allocate (case%lash_adjuster)
      associate (adjuster => case%lash_adjuster)
         ! Adjusters of cars have plungers of 8 to 12 mm, those of trucks up to 25 mm, with a selective fit of 2 to 10 um
         call keys%number("diameter_mm", positive, "diameter of the plunger", adjuster%diameter, usual=[4.0_wp, 30.0_wp])
         call keys%number("volume_cm3", positive, "volume of the chamber with the plunger in its middle place", adjuster%volume, &
            & usual=[0.02_wp, 5.0_wp])
         call keys%number("gap_um", positive, "radial gap of the plunger", adjuster%gap, usual=[1.0_wp, 25.0_wp])
         call keys%number("eccentricity", range_t(0.0_wp, 1.0_wp), "eccentricity of the plunger over the gap", &
            & adjuster%eccentricity)
         call keys%number("leak_length_mm", positive, "length of the gap", adjuster%leak_length, usual=[2.0_wp, 40.0_wp])
         call keys%choice("leak_end", leak_end_names, "where the leak ends: in the feed, or outside at ambient pressure", &
            & adjuster%leak_end)
         call keys%number("plunger_mass_kg", positive, "mass of the plunger", adjuster%plunger_mass, usual=[1.0e-3_wp, 0.2_wp])
         call keys%number("plunger_spring_N", positive, "force of the plunger's spring in its middle position; it makes the "// &
            & "base circle load, in the place of spring.base_circle_load_N", adjuster%spring_force, is_optional=.true., &
            & usual=[2.0_wp, 150.0_wp])
         call keys%number("plunger_stiffness_N_m", not_negative, "stiffness of the plunger's spring", adjuster%spring_stiffness, &
            & usual=[0.0_wp, 2.0e4_wp])
         ! A ball of 2 to 6 mm that lifts by some tenths of a millimetre
         call keys%number("check_area_mm2", positive, "area of the check valve", adjuster%check_area, usual=[0.3_wp, 40.0_wp])
         call keys%number("discharge_coefficient", range_t(0.0_wp, 1.0_wp, .false.), "discharge coefficient of the check valve", &
            & adjuster%discharge_coefficient, usual=[0.3_wp, 1.0_wp])
         call keys%number("crack_pressure_kPa", not_negative, "pressure at which the check valve opens", adjuster%crack_pressure, &
            & usual=[0.0_wp, 100.0_wp])
         call keys%number("full_pressure_kPa", positive, "further pressure at which it is full open", adjuster%full_pressure, &
            & usual=[0.5_wp, 300.0_wp])
         call keys%number("transition_pressure_kPa", positive, "pressure difference below which its flow is laminar", &
            & adjuster%transition_pressure, usual=[0.005_wp, 20.0_wp])
         call keys%number("supply_pressure_MPa", positive, "pressure of the oil supply above ambient", adjuster%supply_pressure, &
            & usual=1.0e-6_wp*usual_supply)
         call keys%number("air_content", range_t(1.0e-4_wp, 0.5_wp), &
            & "volume of free air over that of oil and air, at ambient pressure", adjuster%air_content, usual=[1.0e-3_wp, 0.2_wp])
         ! Mineral oil, cold to hot
         call keys%number("oil_modulus_GPa", positive, "bulk modulus of the oil without air", adjuster%oil_modulus, &
            & usual=[0.8_wp, 2.5_wp])
         call keys%number("density_kg_m3", positive, "density of the oil with its air at ambient pressure", adjuster%density, &
            & usual=[700.0_wp, 1050.0_wp])
         call keys%number("lowest_mm", range_t(largest=0.0_wp, with_largest=.false.), &
            & "lower stop of the plunger, from its middle place", adjuster%lowest, usual=[-10.0_wp, -0.1_wp])
         call keys%number("highest_mm", positive, "upper stop of the plunger, towards the cam", adjuster%highest, &
            & usual=[0.1_wp, 10.0_wp])
         call keys%number("stop_stiffness_N_m", positive, "stiffness of both stops", adjuster%stop_stiffness, &
            & usual=[1.0e6_wp, 1.0e9_wp])
         call keys%number("stop_damping_s_m", not_negative, "damping of both stops, as of cam and roller", adjuster%stop_damping, &
            & usual=[0.0_wp, 20.0_wp])
      end associate
   end subroutine bind_adjuster

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
