!> Decks: asperities of cam and roller, and the friction modifier on them.
!>
!> In: keys, settings. Out: their groups, the components of a case, and the rules that tie their keys to others.
module camroller_deck_asperity
   use camroller_asperity, only : asperity_law_names, boundary_names, mobilisation_names, law_masjedi_khonsari_asperities, &
      & law_zhao_maietta_chang, smallest_product
   use camroller_boundary_law, only : boundary_law_names, boundary_table
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain, complain_about_group, demand
   use camroller_deck_schema, only : group_effect, positive, not_negative, proper_fraction, above_absolute_zero
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, has_group, is_wrong, take
   implicit none
   private

   public :: bind_asperity, bind_modifier, check_asperities, check_modifier

contains

   !> Asperities.
   subroutine bind_asperity(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group("asperity", group_effect, "asperities that share the load, and boundary friction")
      if (.not. keys%are_wanted(allocated(case%asperity))) return
      if (.not. allocated(case%asperity)) allocate (case%asperity)
      associate (asperity => case%asperity)
         call keys%choice("law", asperity_law_names, "elastic asperities of both surfaces, asperities of one that yield, which "// &
            & "need materials.hardness_GPa, or the regression that goes with film law 'masjedi_khonsari_rough'", asperity%law)
         call keys%number("roughness_product", positive, "asperity density times tip radius times roughness", &
            & asperity%roughness_product, usual=[0.01_wp, 0.15_wp])
         call keys%number("roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
            & asperity%roughness_over_tip_radius, usual=[1.0e-5_wp, 0.1_wp])
         call keys%number("boundary_coefficient", not_negative, "friction coefficient of touching asperities", &
            & asperity%boundary_coefficient, example="0.2", is_optional=.true., usual=[0.0_wp, 0.5_wp])
         call keys%number("film_shear_strength_MPa", not_negative, "shear strength of the surface film on the real contact area", &
            & asperity%film_shear_strength, usual=[0.0_wp, 100.0_wp])
         call keys%choice("boundary", boundary_names, "boundary friction that counts as a loss: the part mobilised by slip, or "// &
            & "all of it", asperity%boundary)
         call keys%choice("mobilisation", mobilisation_names, &
            & "boundary friction as a function of slip: it grows with the sliding speed, or the roller sticks and slides", &
            & asperity%mobilisation)
         call keys%number("mobilising_speed_m_s", positive, "sliding speed that mobilises regularised boundary friction", &
            & asperity%mobilising_speed, usual=[1.0e-6_wp, 0.05_wp])
      end associate
   end subroutine bind_asperity

   !> Friction modifier.
   subroutine bind_modifier(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group("friction_modifier", group_effect, "additive that covers the asperities of cam and roller and lowers "// &
         & "their friction")
      if (.not. keys%are_wanted(allocated(case%friction_modifier))) return
      if (.not. allocated(case%friction_modifier)) allocate (case%friction_modifier)
      associate (modifier => case%friction_modifier)
         call keys%number("coefficient", not_negative, "friction coefficient of touching asperities that it covers", &
            & modifier%coefficient, example="0.06", usual=[0.02_wp, 0.2_wp])
         call keys%number("coverage", proper_fraction, "part of the surfaces that it covers at the reference temperature", &
            & modifier%reference_coverage, example="0.7", usual=[0.01_wp, 0.999_wp])
         call keys%number("reference_temperature_degC", above_absolute_zero, "temperature that the coverage is given for", &
            & modifier%reference_temperature, example="60", usual=[-40.0_wp, 200.0_wp])
         call keys%number("adsorption_heat_kJ_mol", not_negative, &
            & "heat that it gives off as it is adsorbed; more of it means that less is left when hot", modifier%adsorption_heat, &
            & example="40", usual=[5.0_wp, 150.0_wp])
         call keys%number("concentration_ratio", positive, "its concentration over that at which the coverage is given", &
            & modifier%concentration_ratio, usual=[0.001_wp, 1000.0_wp])
      end associate
   end subroutine bind_modifier

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
