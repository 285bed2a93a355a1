!> Decks: the bearing between roller and pin.
!>
!> In: schema, settings. Out: group and keys, the component of a case, and the rules that tie its keys to others.
module camroller_deck_roller_bearing
   use camroller_bearing_asperity, only : clearance_advice, clearance_is_enough
   use camroller_case, only : case_t
   use camroller_deck_complaint, only : complain, demand
   use camroller_deck_schema, only : schema_t, add_group, add_name, add_number, group_effect, not_negative, positive, &
      & proper_fraction
   use camroller_journal, only : law_covers_width, width_advice
   use camroller_kinds, only : wp
   use camroller_mistakes, only : mistakes_t
   use camroller_needle, only : needle_bearing_t, has_needles, kind_journal, kind_skf, roller_bearing_names
   use camroller_pin_film, only : pin_law_names
   use camroller_settings, only : settings_t, get_word, has_group, is_known, is_wrong, take
   implicit none
   private

   public :: add_roller_bearing_keys, fill_roller_bearing, check_roller_bearing

   character(len=*), parameter :: group = "needle_bearing"

contains

   !> Group and keys.
   subroutine add_roller_bearing_keys(schema)
      !> Schema to add to
      type(schema_t), intent(inout) :: schema

      type(needle_bearing_t) :: standard

      call add_group(schema, group, group_effect, "bearing between roller and pin")
      call add_name(schema, "kind", roller_bearing_names, standard%kind, &
         & "needle bearing with a constant coefficient or by SKF's model, plain pin with a constant coefficient, or plain "// &
         & "pin with an oil film and asperities, a journal bearing")
      call add_number(schema, "friction_coefficient", not_negative, &
         & "friction coefficient; kind 'journal': of touching asperities; kind 'needles_skf': mu_bl, of sliding without a film", &
         & example="0.0015")
      call add_number(schema, "needle_radius_mm", positive, "radius of a needle", example="0.99", &
         & is_optional=.true.)
      call add_number(schema, "reversal_ratio", proper_fraction, &
         & "fraction of the cam's speed within which the bearing torque changes its sign smoothly", default=standard%reversal_ratio)
      call add_number(schema, "skf_rolling_factor", positive, &
         & "R_1 of the bearing's kind, of its rolling torque, in SKF's units; of cylindrical rollers about 1.0e-6 to 1.5e-6 "// &
         & "with a cage, 2.1e-6 without", is_optional=.true.)
      call add_number(schema, "skf_sliding_factor", positive, &
         & "S_2 of the bearing's kind, of its sliding torque by radial load, in SKF's units; of cylindrical rollers about "// &
         & "0.0015", is_optional=.true.)
      call add_number(schema, "skf_geometry_factor", positive, &
         & "K_Z of the bearing's kind, of the oil's return; of cylindrical rollers about 5 with a cage, 6 without", &
         & is_optional=.true.)
      call add_number(schema, "skf_replenishment_factor", not_negative, &
         & "K_rs of the lubrication: 3e-8 for an oil jet or a low bath, 6e-8 for grease or oil-air", &
         & default=standard%skf%replenishment)
      call add_number(schema, "skf_film_coefficient", not_negative, "mu_EHL, friction coefficient of sliding under a whole film", &
         & default=standard%skf%film_coefficient)
      call add_name(schema, "pin_law", pin_law_names, standard%film%law, "law of the pin's film")
      call add_number(schema, "pin_width_mm", positive, "width of roller and pin where they face each other", &
         & is_optional=.true.)
      call add_number(schema, "pin_radial_clearance_um", positive, "radial clearance of the roller on its pin", &
         & is_optional=.true.)
      call add_number(schema, "pin_roughness_um", positive, "root mean square roughness of roller bore and pin together", &
         & is_optional=.true.)
      call add_number(schema, "pin_modulus_GPa", positive, "E' of roller and pin, 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]", &
         & is_optional=.true.)
      call add_number(schema, "pin_roughness_product", positive, "asperity density times tip radius times roughness", &
         & default=standard%film%roughness_product)
      call add_number(schema, "pin_roughness_over_tip_radius", positive, "ratio of roughness to tip radius", &
         & default=standard%film%roughness_over_tip_radius)
   end subroutine add_roller_bearing_keys

   !> Fill the component of a case.
   subroutine fill_roller_bearing(settings, case)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> The case
      type(case_t), intent(inout) :: case

      if (.not. has_group(settings, group)) return
      allocate (case%needle_bearing)
      associate (bearing => case%needle_bearing)
         call take(settings, group, "kind", bearing%kind)
         call take(settings, group, "friction_coefficient", bearing%friction_coefficient)
         call take(settings, group, "needle_radius_mm", bearing%needle_radius)
         call take(settings, group, "reversal_ratio", bearing%reversal_ratio)
         call take(settings, group, "skf_rolling_factor", bearing%skf%rolling)
         call take(settings, group, "skf_sliding_factor", bearing%skf%sliding)
         call take(settings, group, "skf_geometry_factor", bearing%skf%geometry)
         call take(settings, group, "skf_replenishment_factor", bearing%skf%replenishment)
         call take(settings, group, "skf_film_coefficient", bearing%skf%film_coefficient)
         call take(settings, group, "pin_law", bearing%film%law)
         call take(settings, group, "pin_width_mm", bearing%film%width)
         call take(settings, group, "pin_radial_clearance_um", bearing%film%radial_clearance)
         call take(settings, group, "pin_roughness_um", bearing%film%roughness)
         call take(settings, group, "pin_modulus_GPa", bearing%film%modulus)
         call take(settings, group, "pin_roughness_product", bearing%film%roughness_product)
         call take(settings, group, "pin_roughness_over_tip_radius", bearing%film%roughness_over_tip_radius)
      end associate
   end subroutine fill_roller_bearing

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
      !> The settings
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
      !> The settings
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
