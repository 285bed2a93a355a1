!> Decks: what laws of asperities need of other groups.
!>
!> In: settings. Out: mistakes.
module camroller_deck_asperity
   use camroller_asperity, only : asperity_law_names, law_masjedi_khonsari, law_zhao_maietta_chang, smallest_product
   use camroller_deck_complaint, only : complain, demand
   use camroller_film, only : film_law_names, law_masjedi_khonsari_rough
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, get_word, is_wrong, take
   implicit none
   private

   public :: check_asperities

contains

   !> Asperities that yield have a hardness, and their summits a scatter; a regression goes with its film.
   subroutine check_asperities(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Product of density, tip radius and roughness [-]; strength of a surface film [Pa]
      real(wp) :: product, strength
      character(len=*), parameter :: law = asperity_law_names(law_zhao_maietta_chang)

      if (get_word(settings, "asperity", "law") == asperity_law_names(law_masjedi_khonsari)) then
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
