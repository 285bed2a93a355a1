!> Decks: heat in the contact of cam and roller.
!>
!> In: schema, settings. Out: group and keys, the component of a case, and the rules that tie its keys to others.
module camroller_deck_heat
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group
   use camroller_deck_schema, only : schema_t, add_group, add_name, add_number, group_effect, not_negative, positive
   use camroller_heat, only : heat_t, contact_heat_names, inlet_law_names
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong, take
   implicit none
   private

   public :: add_heat_keys, fill_heat, check_heat

   character(len=*), parameter :: group = "heat", fall_key = "viscosity_fall_per_K"

contains

   !> Group and keys.
   subroutine add_heat_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(heat_t) :: standard

      call add_group(schema, "heat", group_effect, "heat that thins the film at its inlet and the oil within the contact")
      call add_name(schema, "inlet_law", inlet_law_names, standard%inlet_law, "factor on the film by shear heating of its inlet")
      call add_name(schema, "contact", contact_heat_names, standard%contact, &
         & "temperature that the film is sheared at: that of the oil, or the mean over the contact with the heat of friction")
      call add_number(schema, "oil_conductivity_W_m_K", positive, "thermal conductivity of the oil", &
         & default=standard%oil_conductivity)
      call add_number(schema, "oil_heat_capacity_J_kg_K", positive, "heat capacity of the oil", &
         & default=standard%oil_heat_capacity)
      call add_number(schema, "viscosity_fall_per_K", positive, &
         & "fall of ln(viscosity) per kelvin; for lubricant temperature_law 'direct' alone", is_optional=.true.)
      call add_number(schema, "limit_fall_per_K", not_negative, "fall of ln(limiting traction coefficient) per kelvin", &
         & default=standard%limit_fall)
      call add_number(schema, "cam_conductivity_W_m_K", positive, "thermal conductivity of the cam", &
         & default=standard%conductivity(1))
      call add_number(schema, "cam_density_kg_m3", positive, "density of the cam", default=standard%density(1))
      call add_number(schema, "cam_heat_capacity_J_kg_K", positive, "heat capacity of the cam", &
         & default=standard%heat_capacity(1))
      call add_number(schema, "roller_conductivity_W_m_K", positive, "thermal conductivity of the roller", &
         & default=standard%conductivity(2))
      call add_number(schema, "roller_density_kg_m3", positive, "density of the roller", default=standard%density(2))
      call add_number(schema, "roller_heat_capacity_J_kg_K", positive, "heat capacity of the roller", &
         & default=standard%heat_capacity(2))
   end subroutine add_heat_keys

   !> Fill the component of a case.
   subroutine fill_heat(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, group)) return
      allocate (case%heat)
      call take(settings, group, "inlet_law", case%heat%inlet_law)
      call take(settings, group, "contact", case%heat%contact)
      call take(settings, group, "oil_conductivity_W_m_K", case%heat%oil_conductivity)
      call take(settings, group, "oil_heat_capacity_J_kg_K", case%heat%oil_heat_capacity)
      call take(settings, group, "viscosity_fall_per_K", case%heat%viscosity_fall)
      call take(settings, group, "limit_fall_per_K", case%heat%limit_fall)
      call take(settings, "heat", "cam_conductivity_W_m_K", case%heat%conductivity(1))
      call take(settings, "heat", "cam_density_kg_m3", case%heat%density(1))
      call take(settings, "heat", "cam_heat_capacity_J_kg_K", case%heat%heat_capacity(1))
      call take(settings, "heat", "roller_conductivity_W_m_K", case%heat%conductivity(2))
      call take(settings, "heat", "roller_density_kg_m3", case%heat%density(2))
      call take(settings, "heat", "roller_heat_capacity_J_kg_K", case%heat%heat_capacity(2))
   end subroutine fill_heat

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
