!> What is decided before a random deck is written, since several keys hang on it, and the rules that tie keys together.
module wide_draft
   use camroller_kinds, only : wp
   use camroller_deck_schema, only : key_t
   use camroller_number_text, only : integer_text
   use random_decks, only : random_t, draw
   use wide_words, only : deck_group, deck_word
   implicit none
   private

   public :: draft_t, style_t, draft_cams, draft_engine, draft_oil_and_train, decided_number, may_have, keep_rules, is_allowed, &
      & has_source, needs_table

   !> How much of what is hard or slow there is in decks
   type :: style_t
      !> Part of the numbers at an end of their range [-]
      real(wp) :: ends_share = 0.0_wp
      !> Part of the decks with a numerical film, which takes a hundred times as long as a formula [-]
      real(wp) :: ehl_share = 0.001_wp
      !> Part of the decks with a method of their own; some take a hundred times as long as the one that the program chooses [-]
      real(wp) :: method_share = 0.1_wp
      !> Part of the decks with a flexible train, which takes a thousand times as long as a rigid one [-]
      real(wp) :: dynamics_share = 0.0_wp
      !> Part of the decks with hours of running, which take as long as a hundred others [-]
      real(wp) :: hours_share = 0.02_wp
   end type style_t

   !> How a data sheet gives the viscosity: at two temperatures, at one with the viscosity index, or by a grade
   integer, parameter, public :: oil_by_points = 1, oil_by_index = 2, oil_by_grade = 3
   !> Keys of a boundary coefficient that follows the logarithm of the speed
   character(len=*), parameter :: logarithmic_keys(*) = [character(len=26) :: "reference_speed_m_s", "reference_temperature_degC", &
      & "change_per_decade", "change_per_K", "lowest_speed_m_s"]

   !> What is decided before a deck is written
   type :: draft_t
      !> Has the camshaft bearings, lobe shapes for its cams, a second one among them?
      logical :: has_cams = .false., has_lobes = .false., has_second = .false.
      !> Bearings and cams
      integer :: bearings = 2, cams = 1
      !> Lobe shape of each cam
      integer, allocatable :: lobes(:)
      !> Is the first of two keys given that take each other's place?
      logical :: is_first = .true.
      !> How a data sheet gives the viscosity: one of those below
      integer :: oil_by = oil_by_points
      !> Is the coefficient of pressure left to its estimate, where there is one?
      logical :: has_estimate = .false.
      !> Does a tribofilm grow over hours?
      logical :: has_hours = .false.
      !> Has the deck an engine? Its cylinders, camshafts, strokes
      logical :: has_engine = .false.
      integer :: cylinders = 1, camshafts = 1, strokes = 4
      !> Is the train flexible, with a spring that has mass, with a lash adjuster whose plunger has a spring that is given?
      logical :: has_dynamics = .false., has_surge = .false., has_adjuster = .false., has_plunger = .false.
   end type draft_t

   !> Groups that a closed balance of energy must go with
   character(len=*), parameter :: joint_groups(*) = [character(len=15) :: &
      & "valve_tip", "stem_seal", "guide_side_load", "finger_pivot"]

contains

   !> Bearings and cams, which several groups need to know.
   subroutine draft_cams(random, draft)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(out) :: draft
      ! [-]
      real(wp) :: number
      integer :: i

      call draw(random, number)
      draft%has_cams = number < 0.5_wp
      call draw(random, number)
      draft%cams = 1 + int(4.0_wp*number**2)
      draft%bearings = 2 + int(3.0_wp*number)
      allocate (draft%lobes(draft%cams))
      do i = 1, draft%cams
         call draw(random, number)
         draft%lobes(i) = merge(2, 1, number < 0.3_wp)
      end do
      call draw(random, number)
      draft%has_lobes = draft%has_cams .and. number < 0.7_wp
      draft%has_second = draft%has_lobes .and. any(draft%lobes == 2)
   end subroutine draft_cams

   !> The engine of a camshaft, which cams and lobe shapes must know.
   subroutine draft_engine(random, draft)
      !> The generator
      type(random_t), intent(inout) :: random
      !> What is decided
      type(draft_t), intent(inout) :: draft
      ! Part of the camshafts that belong to an engine [-]
      real(wp), parameter :: engine_share = 0.3_wp
      integer, parameter :: most_cylinders = 8
      ! [-]
      real(wp) :: number

      call draw(random, number)
      draft%has_engine = draft%has_cams .and. number < engine_share
      call draw(random, number)
      draft%cylinders = 1 + int(most_cylinders*number)
      call draw(random, number)
      draft%strokes = merge(2, 4, number < 0.3_wp)
      call draw(random, number)
      if (.not. draft%has_engine .or. number < 0.5_wp) return
      ! The second camshaft has the second lobe shape
      draft%camshafts = 2
      draft%has_lobes = .false.
      draft%has_second = .true.
   end subroutine draft_engine

   !> How the oil is given, and what a flexible train has.
   subroutine draft_oil_and_train(random, style, draft)
      !> The generator
      type(random_t), intent(inout) :: random
      !> How hard and slow the deck may be
      type(style_t), intent(in) :: style
      !> What is decided
      type(draft_t), intent(inout) :: draft
      ! [-]
      real(wp) :: number

      call draw(random, number)
      draft%oil_by = oil_by_points + int(3.0_wp*number)
      call draw(random, number)
      draft%has_dynamics = number < style%dynamics_share
      call draw(random, number)
      draft%has_surge = draft%has_dynamics .and. number < 0.5_wp
      call draw(random, number)
      draft%has_adjuster = draft%has_dynamics .and. number < 0.5_wp
      call draw(random, number)
      draft%has_plunger = draft%has_adjuster .and. number < 0.5_wp
      call draw(random, number)
      draft%has_estimate = number < 0.3_wp
      call draw(random, number)
      draft%has_hours = number < style%hours_share .and. .not. draft%has_dynamics
   end subroutine draft_oil_and_train

   !> May a deck have a group, after what it has already? Sliding joints need a closed balance, that of the pivot a finger's mass.
   pure function may_have(draft, text, group)
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Name of the group
      character(len=*), intent(in) :: group
      logical :: may_have

      may_have = .true.
      if (any(group == joint_groups)) may_have = .not. has_source(text)
      if (group == "roller_profile") may_have = index(text, "&ehl") == 0
      if (any(group == [character(len=16) :: "bearing_asperity", "belt_pull", "shaft_drag"])) may_have = draft%has_cams
      ! Oil leaves a long bearing at its sides in the width of a diameter alone, and widths are drawn without a look at that
      if (group == "bearing_heat") may_have = draft%has_cams .and. any(deck_word(text, "lubricant", "temperature_law") == &
         & [character(len=10) :: "vogel", "walther", "data_sheet"]) .and. any(deck_word(text, "cam_bearings", "law") == &
         & [character(len=12) :: "short_ocvirk", "finite"])
      if (group == "friction_modifier" .or. group == "boundary_law" .or. group == "wear") may_have = index(text, "&asperity") > 0
      if (group == "tribofilm") may_have = index(text, "&asperity") > 0
      if (group == "running_in") may_have = index(text, "&tribofilm") > 0
      if (group == "needle_drag") may_have = all(deck_word(text, "needle_bearing", "kind") &
         & /= [character(len=11) :: "journal", "needles_skf"])
      if (group == "finger_pivot") may_have = may_have .and. deck_word(text, "masses", "finger_kg") /= ""
   end function may_have

   !> Do asperities lack the coefficient of friction, which a table of &boundary_law then gives?
   pure function needs_table(text)
      !> The deck so far
      character(len=*), intent(in) :: text
      logical :: needs_table

      needs_table = deck_word(text, "asperity", "boundary_coefficient") == ""
      if (needs_table) needs_table = deck_group(text, "asperity") /= ""
   end function needs_table

   !> Numbers that other keys hang on; blank for others.
   pure function decided_number(draft, name) result(words)
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> Group and key
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: words

      select case (name)
      case ("engine.cylinders")
         words = integer_text(draft%cylinders)
      case ("engine.camshafts")
         words = integer_text(draft%camshafts)
      case ("engine.strokes")
         words = integer_text(draft%strokes)
      case default
         words = ""
      end select
   end function decided_number

   !> Is the bookkeeping that of the source, which may be open?
   pure function has_source(text)
      !> The deck so far
      character(len=*), intent(in) :: text
      logical :: has_source

      has_source = deck_word(text, "case", "energy") == "source"
   end function has_source

   !> Which keys go with a law of the lift.
   pure subroutine keep_lift_rules(law, key, is_given)
      !> Name of the law
      character(len=*), intent(in) :: law
      !> Name of the key
      character(len=*), intent(in) :: key
      !> In: is the key wanted; out: is it given
      logical, intent(inout) :: is_given

      select case (key)
      case ("max_lift_mm")
         is_given = law /= "table"
      case ("opening_half_angle_deg")
         is_given = law /= "table" .and. law /= "segments"
      case ("closing_half_angle_deg")
         is_given = is_given .and. all(law /= [character(len=8) :: "table", "power", "polydyne", "segments"])
      case ("segment_angles_deg", "segment_accelerations")
         is_given = law == "segments"
      case ("exponents")
         is_given = law == "power" .or. law == "polydyne"
      end select
   end subroutine keep_lift_rules

   !> Is a key of a law of boundary friction given?
   pure function is_of_boundary_law(law, key, is_wanted) result(is_given)
      !> Name of the law and of the key
      character(len=*), intent(in) :: law, key
      !> Is the key wanted?
      logical, intent(in) :: is_wanted
      logical :: is_given

      is_given = is_wanted
      if (index(key, "_points") > 0) is_given = law == "table"
      if (any(key == logarithmic_keys)) is_given = law == "logarithmic"
   end function is_of_boundary_law

   !> Whether a key of &needle_bearing is given: what its kind cannot do without is.
   pure function is_of_bearing(kind, key, is_wanted) result(is_given)
      !> Kind of the bearing, name of the key
      character(len=*), intent(in) :: kind, key
      !> Is the key wanted?
      logical, intent(in) :: is_wanted
      logical :: is_given

      is_given = is_wanted
      select case (key)
      case ("needle_radius_mm")
         is_given = is_given .or. index(kind, "needles") > 0
      case ("skf_rolling_factor", "skf_sliding_factor", "skf_geometry_factor")
         is_given = is_given .or. kind == "needles_skf"
      case ("pin_width_mm", "pin_radial_clearance_um", "pin_roughness_um", "pin_modulus_GPa")
         is_given = is_given .or. kind == "journal"
      end select
   end function is_of_bearing

   !> Which keys go together.
   pure subroutine keep_rules(draft, text, group, key, is_given)
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Names of group and key
      character(len=*), intent(in) :: group, key
      !> In: is the key wanted; out: is it given
      logical, intent(inout) :: is_given
      character(len=:), allocatable :: law

      law = deck_word(text, group, "law")
      if (group == "lubricant") call keep_oil_rules(draft, text, key, is_given)
      if (group == "lift" .or. group == "second_lift") call keep_lift_rules(law, key, is_given)
      if (group == "boundary_law") is_given = is_of_boundary_law(law, key, is_given)
      if (group == "needle_bearing") is_given = is_of_bearing(deck_word(text, group, "kind"), key, is_given)
      ! Where it is not there, there is a table in its place
      if (key == "boundary_coefficient") is_given = is_given .or. draft%is_first
      if (key == "limiting_stress_MPa") is_given = is_given .and. deck_word(text, group, "limit") == "local"
      select case (key)
      case ("table")
         is_given = law == "table" .or. group == "gas_force"
      case ("table_unit", "table_kind", "smoothing_um")
         is_given = is_given .and. law == "table"
      case ("table_nose_angle_deg")
         is_given = is_given .and. (law == "table" .or. group == "gas_force")
      case ("second_valve_diameter_mm")
         is_given = is_given .and. draft%has_second
      case ("finger_kg")
         is_given = is_given .or. draft%is_first .or. draft%has_dynamics
      case ("finger_inertia_kg_m2")
         is_given = (is_given .and. .not. draft%is_first) .or. index(text, "finger_kg") == 0
      case ("finger_centre_mm")
         ! Beyond the radius of gyration it is refused; without an inertia that is the pad's radius
         is_given = is_given .and. index(text, "finger_inertia_kg_m2") == 0
      case ("hardness_GPa")
         ! Where it is not there, laws that need it are not drawn
         is_given = is_given .or. draft%has_lobes
      case ("decay_speed_m_s", "reference_load_N")
         is_given = law == "stribeck"
      case ("reference_viscosity_Pa_s")
         is_given = law == "stribeck" .or. group == "stem_seal"
      case ("film_shear_strength_MPa")
         is_given = is_given .and. law /= "masjedi_khonsari"
      case ("eyring_stress_MPa")
         is_given = is_given .or. deck_word(text, group, "shear_law") == "eyring"
      case ("crown_radius_mm", "design_load_N")
         is_given = deck_word(text, group, "profile") == merge("crowned    ", "logarithmic", key == "crown_radius_mm")
      case ("grinding_wheel_radius_mm", "tolerance")
         is_given = is_given .and. (draft%is_first .neqv. key == "tolerance")
      case ("cam_cylinders")
         is_given = draft%has_engine
      case ("cam_phases_deg")
         is_given = is_given .and. .not. draft%has_engine
      case ("camshafts")
         is_given = is_given .or. draft%camshafts == 2
      case ("viscosity_fall_per_K")
         is_given = deck_word(text, "lubricant", "temperature_law") == "direct"
      case ("base_circle_load_N", "plunger_spring_N")
         is_given = draft%has_plunger .eqv. key == "plunger_spring_N"
      case ("lash_mm")
         ! Nothing holds such a finger, so that hardly any of these trains has a period
         is_given = is_given .and. draft%is_first .and. .not. draft%has_adjuster
      case ("cam_lobes")
         is_given = draft%has_lobes
      case ("accuracy")
         if (group == "numerics") is_given = is_given .and. draft%is_first
      end select
   end subroutine keep_rules

   !> Which keys of the oil go together.
   pure subroutine keep_oil_rules(draft, text, key, is_given)
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> Name of the key
      character(len=*), intent(in) :: key
      !> In: is the key wanted; out: is it given
      logical, intent(inout) :: is_given
      character(len=:), allocatable :: law
      ! Does the law tell the coefficient of pressure where it is not given?
      logical :: is_estimated

      law = deck_word(text, "lubricant", "temperature_law")
      is_estimated = draft%has_estimate .and. (law == "walther" .or. law == "data_sheet")
      select case (key)
      case ("viscosity_Pa_s")
         is_given = law == "direct"
      case ("temperature_points_degC", "viscosity_points_Pa_s")
         is_given = index(" vogel walther ", " "//law//" ") > 0
      case ("viscosity_at_40_degC_mm2_s")
         is_given = law == "data_sheet" .and. draft%oil_by == oil_by_points
      case ("viscosity_at_100_degC_mm2_s")
         is_given = law == "data_sheet" .and. draft%oil_by /= oil_by_grade
      case ("viscosity_index")
         is_given = law == "data_sheet" .and. (draft%oil_by == oil_by_index .or. (is_given .and. draft%oil_by == oil_by_grade))
      case ("hths_viscosity_mPa_s")
         is_given = is_given .and. law /= "direct"
      case ("sae_grade")
         is_given = law == "data_sheet" .and. (is_given .or. draft%oil_by == oil_by_grade)
      case ("pressure_viscosity_coefficient_per_GPa")
         is_given = (draft%is_first .or. (is_given .and. deck_word(text, "lubricant", "pressure_law") /= "roelands")) &
            & .and. .not. is_estimated
      case ("pressure_viscosity_temperatures_degC")
         is_given = is_given .and. index(text, "pressure_viscosity_coefficient") == 0 .and. .not. is_estimated
      case ("pressure_viscosity_points_per_GPa")
         is_given = index(text, "pressure_viscosity_temperatures") > 0
      case ("roelands_index")
         if (index(text, "pressure_viscosity_points") > 0) then
            is_given = .false.
            return
         end if
         is_given = (.not. draft%is_first .or. (is_given .and. deck_word(text, "lubricant", "pressure_law") /= "roelands")) &
            & .and. .not. is_estimated
      end select
   end subroutine keep_oil_rules

   !> Does a choice go with those made before?
   pure function is_allowed(draft, text, key, words)
      !> What is decided
      type(draft_t), intent(in) :: draft
      !> The deck so far
      character(len=*), intent(in) :: text
      !> The key
      type(key_t), intent(in) :: key
      !> The name, in quotes
      character(len=*), intent(in) :: words
      logical :: is_allowed

      is_allowed = .true.
      select case (trim(key%name))
      case ("law")
         is_allowed = index(text, "hardness_GPa") > 0 .or. all(words /= [character(len=26) :: "'masjedi_khonsari_rough'", &
            & "'zhao_maietta_chang'"])
         if (index(text, "&asperity") > 0 .and. words == "'masjedi_khonsari'") is_allowed = &
            & index(text, "'masjedi_khonsari_rough'") > 0 .and. index(text, "film_shear_strength") == 0
         if (words == "'logarithmic'") is_allowed = .not. needs_table(text)
      case ("load_arm", "spin", "boundary", "seating")
         is_allowed = has_source(text) .or. words == key%default
      case ("method")
         if (words == "'euler'" .or. words == "'quasi_static'") is_allowed = deck_word(text, "asperity", "mobilisation") &
            & /= "stick_slip" .and. .not. draft%has_dynamics
         if (words == "'hermite'") is_allowed = .not. draft%has_dynamics
      case ("journal_motion")
         is_allowed = words == key%default .or. index(" short_ocvirk finite ", " "//deck_word(text, "cam_bearings", "law")//" ") > 0
      case ("sae_grade")
         is_allowed = words == key%default .neqv. draft%oil_by == oil_by_grade
      case ("energy", "mobilisation")
         is_allowed = .not. draft%has_dynamics .or. words == key%default
      end select
   end function is_allowed

end module wide_draft
