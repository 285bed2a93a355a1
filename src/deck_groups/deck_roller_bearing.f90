!> Decks: the bearing between roller and pin.
!>
!> In: keys, settings. Out: the group, the component of a case, and the rules that tie its keys to others.
module camroller_deck_roller_bearing
   use camroller_bearing_asperity, only : clearance_advice, clearance_is_enough
   use camroller_case, only : case_t
   use camroller_deck_binder, only : keys_t
   use camroller_deck_complaint, only : complain, demand
   use camroller_deck_schema, only : group_effect, positive, not_negative, proper_fraction
   use camroller_journal, only : law_covers_width, width_advice
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_needle, only : has_needles, kind_journal, kind_skf, roller_bearing_names
   use camroller_pin_film, only : pin_law_names
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong, take
   implicit none
   private

   public :: bind_roller_bearing, check_roller_bearing

   character(len=*), parameter :: group = "needle_bearing"

contains

   !> Group and keys, and the component of a case.
   subroutine bind_roller_bearing(keys, case)
      !> The keys
      type(keys_t), intent(inout) :: keys
      !> The case
      type(case_t), intent(inout) :: case

      call keys%group(group, group_effect, "bearing between roller and pin")
      if (.not. keys%are_wanted(allocated(case%needle_bearing))) return
      if (.not. allocated(case%needle_bearing)) allocate (case%needle_bearing)
      associate (bearing => case%needle_bearing)
         call keys%choice("kind", roller_bearing_names, "needle bearing with a constant coefficient or by SKF's model, plain "// &
            & "pin with a constant coefficient, or plain pin with an oil film and asperities, a journal bearing", bearing%kind)
         call keys%number("friction_coefficient", not_negative, "friction coefficient; kind 'journal': of touching asperities; "// &
            & "kind 'needles_skf': mu_bl, of sliding without a film", bearing%friction_coefficient, example="0.0015", &
            & usual=[0.0_wp, 0.3_wp])
         call keys%number("needle_radius_mm", positive, "radius of a needle", bearing%needle_radius, example="0.99", &
            & is_optional=.true., usual=[0.3_wp, 5.0_wp])
         call keys%number("reversal_ratio", proper_fraction, &
            & "fraction of the cam's speed within which the bearing torque changes its sign smoothly", bearing%reversal_ratio)
         call keys%number("skf_rolling_factor", positive, "R_1 of the bearing's kind, of its rolling torque, in SKF's units; "// &
            & "of cylindrical rollers about 1.0e-6 to 1.5e-6 with a cage, 2.1e-6 without", bearing%skf%rolling, &
            & is_optional=.true., usual=[2.0e-7_wp, 1.0e-5_wp])
         call keys%number("skf_sliding_factor", positive, "S_2 of the bearing's kind, of its sliding torque by radial load, in "// &
            & "SKF's units; of cylindrical rollers about 0.0015", bearing%skf%sliding, is_optional=.true., &
            & usual=[1.0e-4_wp, 0.01_wp])
         call keys%number("skf_geometry_factor", positive, "K_Z of the bearing's kind, of the oil's return; of cylindrical "// &
            & "rollers about 5 with a cage, 6 without", bearing%skf%geometry, is_optional=.true., usual=[3.0_wp, 12.0_wp])
         call keys%number("skf_replenishment_factor", not_negative, &
            & "K_rs of the lubrication: 3e-8 for an oil jet or a low bath, 6e-8 for grease or oil-air", bearing%skf%replenishment, &
            & usual=[1.0e-8_wp, 1.0e-7_wp])
         call keys%number("skf_film_coefficient", not_negative, "mu_EHL, friction coefficient of sliding under a whole film", &
            & bearing%skf%film_coefficient, usual=[0.001_wp, 0.1_wp])
         call keys%choice("pin_law", pin_law_names, "law of the pin's film", bearing%film%law)
         call keys%number("pin_width_mm", positive, "width of roller and pin where they face each other", bearing%film%width, &
            & is_optional=.true., usual=[2.0_wp, 25.0_wp])
         call keys%number("pin_radial_clearance_um", positive, "radial clearance of the roller on its pin", &
            & bearing%film%radial_clearance, is_optional=.true., usual=[5.0_wp, 100.0_wp])
         call keys%number("pin_roughness_um", positive, "root mean square roughness of roller bore and pin together", &
            & bearing%film%roughness, is_optional=.true., usual=[0.02_wp, 3.0_wp])
         call keys%number("pin_modulus_GPa", positive, "E' of roller and pin, 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]", &
            & bearing%film%modulus, is_optional=.true., usual=[20.0_wp, 300.0_wp])
         call keys%number("pin_roughness_product", positive, "asperity density times tip radius times roughness", &
            & bearing%film%roughness_product, usual=[0.01_wp, 0.15_wp])
         call keys%number("pin_roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
            & bearing%film%roughness_over_tip_radius, usual=[1.0e-5_wp, 0.1_wp])
      end associate
   end subroutine bind_roller_bearing

   !> Rules: the ring's wall is thinner than its radius, needles fit between it and a pin, and a bearing whose torque is not in
   !> proportion to its load has what that needs.
   subroutine check_roller_bearing(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Outer radius, wall thickness and needle radius [m]
      real(wp) :: radius, wall, needle
      character(len=:), allocatable :: kind

      if (.not. (is_known(settings, "roller", "radius_mm") .and. is_known(settings, "roller", &
         & "wall_thickness_mm"))) return
      call take(settings, "roller", "radius_mm", radius)
      call take(settings, "roller", "wall_thickness_mm", wall)
      if (wall >= radius) then
         call complain(mistakes, settings, "roller", "wall_thickness_mm", &
            & "'wall_thickness_mm' must be below 'radius_mm'")
         return
      end if
      if (.not. has_group(settings, group)) return
      kind = get_word(settings, group, "kind")
      if (any(kind == roller_bearing_names([kind_journal, kind_skf]))) call check_company(settings, kind, mistakes)
      if (kind == roller_bearing_names(kind_journal)) call check_pin(settings, radius - wall, mistakes)
      if (.not. has_needles(kind)) return
      if (is_wrong(settings, group, "needle_radius_mm")) return
      if (.not. is_known(settings, group, "needle_radius_mm")) then
         call complain(mistakes, settings, group, "kind", "kind '"//kind//"' needs 'needle_radius_mm'")
         return
      end if
      call take(settings, group, "needle_radius_mm", needle)
      if (2.0_wp*needle < radius - wall) return
      call complain(mistakes, settings, group, "needle_radius_mm", &
         & "'needle_radius_mm' must be below half of the inner radius of the roller, 'radius_mm' less 'wall_thickness_mm', or "// &
         & "no pin is left between the needles")
   end subroutine check_roller_bearing

   !> A bearing whose torque is not in proportion to its load has its numbers, and no company that it is not combined with.
   subroutine check_company(settings, kind, mistakes)
      type(settings_t), intent(in) :: settings
      !> Kind of the bearing, one of these
      character(len=*), intent(in) :: kind
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: pin_numbers(*) = [character(len=23) :: "pin_width_mm", "pin_radial_clearance_um", &
         & "pin_roughness_um", "pin_modulus_GPa"]
      character(len=*), parameter :: skf_numbers(*) = [character(len=23) :: "skf_rolling_factor", "skf_sliding_factor", &
         & "skf_geometry_factor"]
      character(len=:), allocatable :: numbers(:)
      integer :: i

      if (has_group(settings, "needle_drag")) call complain(mistakes, settings, group, "kind", &
         & "kind '"//kind//"' is not combined with the group &needle_drag")
      if (kind == roller_bearing_names(kind_journal)) then
         numbers = pin_numbers
      else
         numbers = skf_numbers
      end if
      do i = 1, size(numbers)
         call demand(settings, group, trim(numbers(i)), "kind '"//kind//"'", mistakes)
      end do
   end subroutine check_company

   !> A pin with a film has a width that its law covers and surfaces that are apart in the middle.
   subroutine check_pin(settings, radius, mistakes)
      type(settings_t), intent(in) :: settings
      !> Radius of the pin [m]
      real(wp), intent(in) :: radius
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      ! Width, clearance, roughness [m]
      real(wp) :: width, clearance, roughness

      if (is_known(settings, group, "pin_width_mm")) then
         call take(settings, group, "pin_width_mm", width)
         if (.not. law_covers_width(get_word(settings, group, "pin_law"), width, 2.0_wp*radius)) call complain(mistakes, settings, &
            & group, "pin_width_mm", width_advice)
      end if
      if (.not. (is_known(settings, group, "pin_roughness_um") .and. is_known(settings, group, "pin_radial_clearance_um"))) return
      call take(settings, group, "pin_roughness_um", roughness)
      call take(settings, group, "pin_radial_clearance_um", clearance)
      if (.not. clearance_is_enough(roughness, clearance)) call complain(mistakes, settings, group, "pin_roughness_um", &
         & clearance_advice)
   end subroutine check_pin

end module camroller_deck_roller_bearing
