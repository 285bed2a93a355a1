!> Decks: what laws of asperities need of other groups; the friction modifier on them.
!>
!> In: schema, settings. Out: the modifier's group and keys and its component of a case; mistakes.
module camroller_deck_asperity
   use camroller_asperity, only : asperity_law_names, friction_modifier_t, law_masjedi_khonsari_asperities, &
      & law_zhao_maietta_chang, smallest_product
   use camroller_boundary_law, only : boundary_law_names, boundary_table
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, complain_about_group, demand
   use camroller_deck_schema, only : schema_t, add_group, add_number, group_effect, not_negative, positive, proper_fraction, &
      & above_absolute_zero
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_wrong, take
   implicit none
   private

   public :: add_modifier_keys, fill_modifier, check_asperities, check_modifier

contains

   !> Group and keys of the friction modifier.
   subroutine add_modifier_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(friction_modifier_t) :: standard

      call add_group(schema, "friction_modifier", group_effect, &
         & "additive that covers the asperities of cam and roller and lowers their friction")
      call add_number(schema, "coefficient", not_negative, "friction coefficient of touching asperities that it covers", &
         & example="0.06")
      call add_number(schema, "coverage", proper_fraction, "part of the surfaces that it covers at the reference temperature", &
         & example="0.7")
      call add_number(schema, "reference_temperature_degC", above_absolute_zero, &
         & "temperature that the coverage is given for", example="60")
      call add_number(schema, "adsorption_heat_kJ_mol", not_negative, "heat that it gives off as it is adsorbed; more of it "// &
         & "means that less is left when hot", example="40")
      call add_number(schema, "concentration_ratio", positive, "its concentration over that at which the coverage is given", &
         & default=standard%concentration_ratio)
   end subroutine add_modifier_keys

   !> Fill the friction modifier of a case.
   subroutine fill_modifier(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, "friction_modifier")) return
      allocate (case%friction_modifier)
      associate (modifier => case%friction_modifier)
         call take(settings, "friction_modifier", "coefficient", modifier%coefficient)
         call take(settings, "friction_modifier", "coverage", modifier%reference_coverage)
         call take(settings, "friction_modifier", "reference_temperature_degC", modifier%reference_temperature)
         call take(settings, "friction_modifier", "adsorption_heat_kJ_mol", modifier%adsorption_heat)
         call take(settings, "friction_modifier", "concentration_ratio", modifier%concentration_ratio)
      end associate
   end subroutine fill_modifier

   !> A friction modifier covers asperities.
   subroutine check_modifier(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (has_group(settings, "friction_modifier") .and. .not. has_group(settings, "asperity")) call complain_about_group( &
         & mistakes, settings, "friction_modifier", "&friction_modifier needs the group &asperity")
   end subroutine check_modifier

   !> Asperities that yield have a hardness, and their summits a scatter; a regression goes with its film.
   subroutine check_asperities(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Product of density, tip radius and roughness [-]; strength of a surface film [Pa]
      real(wp) :: product, strength
      character(len=*), parameter :: law = asperity_law_names(law_zhao_maietta_chang), &
         & table = boundary_law_names(boundary_table)

      if (get_word(settings, "boundary_law", "law") /= table .or. .not. has_group(settings, "boundary_law")) call demand(settings, &
         & "asperity", "boundary_coefficient", "friction of asperities without boundary law '"//trim(table)//"'", mistakes)
      if (get_word(settings, "asperity", "law") == asperity_law_names(law_masjedi_khonsari_asperities)) then
         if (get_word(settings, "film", "law") /= film_law_names(law_masjedi_khonsari_rough)) call complain(mistakes, settings, &
            & "asperity", "law", "asperity law 'masjedi_khonsari' goes with film law 'masjedi_khonsari_rough'")
         strength = 0.0_wp
         call take(settings, "asperity", "film_shear_strength_MPa", strength)
         if (strength > 0.0_wp) call complain(mistakes, settings, "asperity", "film_shear_strength_MPa", &
            & "asperity law 'masjedi_khonsari' has no real area that could be sheared")
      end if
      if (get_word(settings, "asperity", "law") /= law) return
      call demand(settings, "materials", "hardness_GPa", "asperity law '"//trim(law)//"'", mistakes)
      if (is_wrong(settings, "asperity", "roughness_product")) return
      product = smallest_product
      call take(settings, "asperity", "roughness_product", product)
      if (product < smallest_product) call complain(mistakes, settings, "asperity", "roughness_product", &
         & "asperity law '"//trim(law)//"' needs a 'roughness_product' of 0.025 or more")
   end subroutine check_asperities

end module camroller_deck_asperity
