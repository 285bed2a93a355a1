!> Decks: heat in the contact of cam and roller.
!>
!> In: keys, settings. Out: the group, the component of a case, and the rules that tie its keys to others.
module camroller_deck_heat
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : group_effect, positive, not_negative
   use camroller_heat, only : contact_heat_names, inlet_law_names
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong
   implicit none
   private

   public :: bind_heat, check_heat

   character(len=*), parameter :: group = "heat", fall_key = "viscosity_fall_per_K"

contains

   !> Group and keys, and the component of a case.
   subroutine bind_heat(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group(group, group_effect, "heat that thins the film at its inlet and the oil within the contact")
      if (.not. keys%are_wanted(allocated(case%heat))) return
      if (.not. allocated(case%heat)) allocate (case%heat)
      call keys%choice("inlet_law", inlet_law_names, "factor on the film by shear heating of its inlet", case%heat%inlet_law)
      call keys%choice("contact", contact_heat_names, "temperature that the film is sheared at: that of the oil, or the mean "// &
         & "over the contact with the heat of friction", case%heat%contact)
      call keys%number("oil_conductivity_W_m_K", positive, "thermal conductivity of the oil", case%heat%oil_conductivity, &
         & usual=[0.05_wp, 0.5_wp])
      call keys%number("oil_heat_capacity_J_kg_K", positive, "heat capacity of the oil", case%heat%oil_heat_capacity, &
         & usual=[1500.0_wp, 2700.0_wp])
      call keys%number("viscosity_fall_per_K", positive, "fall of ln(viscosity) per kelvin; for lubricant temperature_law "// &
         & "'direct' alone", case%heat%viscosity_fall, is_optional=.true., usual=[0.01_wp, 0.12_wp])
      call keys%number("limit_fall_per_K", not_negative, "fall of ln(limiting traction coefficient) per kelvin", &
         & case%heat%limit_fall, usual=[0.0_wp, 0.02_wp])
      call keys%number("cam_conductivity_W_m_K", positive, "thermal conductivity of the cam", case%heat%conductivity(1), &
         & usual=[1.0_wp, 200.0_wp])
      call keys%number("cam_density_kg_m3", positive, "density of the cam", case%heat%density(1), usual=[2000.0_wp, 9000.0_wp])
      call keys%number("cam_heat_capacity_J_kg_K", positive, "heat capacity of the cam", case%heat%heat_capacity(1), &
         & usual=[300.0_wp, 1000.0_wp])
      call keys%number("roller_conductivity_W_m_K", positive, "thermal conductivity of the roller", case%heat%conductivity(2), &
         & usual=[1.0_wp, 200.0_wp])
      call keys%number("roller_density_kg_m3", positive, "density of the roller", case%heat%density(2), &
         & usual=[2000.0_wp, 9000.0_wp])
      call keys%number("roller_heat_capacity_J_kg_K", positive, "heat capacity of the roller", case%heat%heat_capacity(2), &
         & usual=[300.0_wp, 1000.0_wp])
   end subroutine bind_heat

   !> Rule: one law of the viscosity over the temperature.
   subroutine check_heat(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      logical :: is_direct

      if (.not. has_group(settings, group)) return
      is_direct = get_word(settings, "lubricant", "temperature_law") == "direct"
      if (is_direct .and. .not. (is_known(settings, group, fall_key) .or. is_wrong(settings, group, fall_key))) then
         call complain_about_group(mistakes, settings, group, "&heat needs '"//fall_key// &
            & "' with lubricant temperature_law = 'direct'")
      else if (.not. is_direct .and. is_known(settings, group, fall_key)) then
         call complain(mistakes, settings, group, fall_key, "'"//fall_key// &
            & "' goes with lubricant temperature_law = 'direct'; other laws have a fall of their own")
      end if
   end subroutine check_heat

end module camroller_deck_heat
