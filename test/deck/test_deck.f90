!> Tests of reading decks: values arrive in SI, and every mistake is told with its place and with advice.
module test_deck
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, pi, degree
   use camroller_error, only : error_t, kind_file
   use camroller_case, only : case_t
   use camroller_deck, only : deck_t, override_t, parse_deck, read_deck, make_case
   use deck_samples, only : sample_deck, changed_deck, parse_sample, expect_mistake, expect_valid
   implicit none
   private

   public :: collect_deck

   character(len=*), parameter :: n = new_line("a")
   !> Values go through one multiplication and one division [-]
   real(wp), parameter :: round_off = 4.0_wp*epsilon(1.0_wp)

contains

   !> All tests of this suite.
   subroutine collect_deck(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("values arrive in SI", values_in_si), &
         new_unittest("what is not given keeps the default of its type", defaults_are_those_of_types), &
         new_unittest("an effect is in the case where its group is in the deck", groups_are_effects), &
         new_unittest("the notation of Fortran is understood", notation_is_fortran), &
         new_unittest("mistakes in the shape are told with place and advice", shape_mistakes), &
         new_unittest("unknown groups and keys are told with the nearest known one", unknown_names), &
         new_unittest("values that are none are told with place and what is expected", value_mistakes), &
         new_unittest("values out of range are told with the range", range_mistakes), &
         new_unittest("missing groups and keys are told with their meaning", missing_parts), &
         new_unittest("the closed energy balance demands its bookkeeping", energy_relations), &
         new_unittest("laws demand what they need", law_relations), &
         new_unittest("pressure-viscosity coefficients go with as many temperatures, and alone", points_of_coefficient), &
         new_unittest("camshaft, roller and report hold together", geometry_relations), &
         new_unittest("all mistakes are reported at once, in order of place", all_at_once), &
         new_unittest("the message shows the line and a caret below the mistake", line_and_caret), &
         new_unittest("an override replaces a value and nothing else", override_replaces), &
         new_unittest("a wrong override is told as such", wrong_overrides), &
         new_unittest("a deck that is no file is a file error", no_such_file) &
         ]
   end subroutine collect_deck

   subroutine values_in_si(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case

      call sample_case(error, sample_deck(), case)
      if (allocated(error)) return
      call check(error, case%operating_point%speed, 20.0_wp*pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%operating_point%oil_temperature, 333.15_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%mechanism%base_radius, 0.018_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%mechanism%roller_arm_angle, -3.5_wp*degree, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%materials%cam_modulus, 1.7e11_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%surface%cam_roughness, 1.0e-7_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%lubricant%pressure_viscosity, 2.2e-8_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%lift%closing_half_angle, 70.0_wp*degree, rel=.true., thr=round_off)
   end subroutine values_in_si

   subroutine defaults_are_those_of_types(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case, standard

      call sample_case(error, changed_deck("", &
         & "&asperity boundary_coefficient = 0 / &needle_bearing friction_coefficient = 0"// &
         & " needle_radius_mm = 1 /"), case)
      if (allocated(error)) return
      allocate (standard%asperity, standard%needle_bearing)
      call check(error, case%energy, standard%energy)
      if (allocated(error)) return
      call check(error, case%spring%seating, standard%spring%seating)
      if (allocated(error)) return
      call check(error, case%numerics%method, standard%numerics%method)
      if (allocated(error)) return
      call check(error, case%numerics%max_cycles, standard%numerics%max_cycles)
      if (allocated(error)) return
      call check(error, case%traction%in_roller_balance .eqv. standard%traction%in_roller_balance)
      if (allocated(error)) return
      call same(error, "step", case%numerics%step, standard%numerics%step)
      call same(error, "output step", case%numerics%output_step, standard%numerics%output_step)
      call same(error, "tolerance", case%numerics%tolerance, standard%numerics%tolerance)
      call same(error, "periodicity", case%numerics%periodicity, standard%numerics%periodicity)
      call same(error, "seat", case%spring%seat_stiffness, standard%spring%seat_stiffness)
      call same(error, "density", case%lubricant%density, standard%lubricant%density)
      call same(error, "expansion", case%lubricant%thermal_expansion, standard%lubricant%thermal_expansion)
      call same(error, "limit", case%traction%limiting_coefficient, standard%traction%limiting_coefficient)
      call same(error, "hardness", case%materials%hardness, standard%materials%hardness)
      call same(error, "roughness", case%asperity%roughness_product, standard%asperity%roughness_product)
      call same(error, "tips", case%asperity%roughness_over_tip_radius, standard%asperity%roughness_over_tip_radius)
      call same(error, "mobilising", case%asperity%mobilising_speed, standard%asperity%mobilising_speed)
      call same(error, "reversal", case%needle_bearing%reversal_ratio, standard%needle_bearing%reversal_ratio)
   end subroutine defaults_are_those_of_types

   subroutine groups_are_effects(error)
      type(error_type), allocatable, intent(out) :: error

      type(case_t) :: case

      call sample_case(error, sample_deck(), case)
      if (allocated(error)) return
      call check(error, &
         & .not. (allocated(case%asperity) .or. allocated(case%needle_bearing) .or. allocated(case%valve_guide) &
         & .or. allocated(case%cam_bearings) .or. allocated(case%gas_force) .or. allocated(case%second_lift)))
      if (allocated(error)) return
      call sample_case(error, changed_deck("", &
         & "&valve_guide length_mm = 36 stem_diameter_mm = 5 radial_clearance_um = 20 /"// &
         & "&cam_bearings diameter_mm = 23 width_mm = 20 radial_clearance_um = 47.5 bearing_positions_mm = 0 60 120"// &
         & " cam_positions_mm = 20, 90 cam_lobes = 1 2 / &second_lift law = 'cycloidal' max_lift_mm = 8"// &
         & " opening_half_angle_deg = 60 closing_half_angle_deg = 65 /"), case)
      if (allocated(error)) return
      call check(error, case%valve_guide%radial_clearance, 2.0e-5_wp, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, size(case%cam_bearings%bearing_positions), 3)
      if (allocated(error)) return
      call check(error, size(case%cam_bearings%cam_phases), 2, "phases are zero for every cam where not given")
      if (allocated(error)) return
      call check(error, case%cam_bearings%cam_lobes(2), 2)
      if (allocated(error)) return
      call check(error, case%second_lift%closing_half_angle, 65.0_wp*degree, rel=.true., thr=round_off)
   end subroutine groups_are_effects

   subroutine notation_is_fortran(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_valid(error, "speed_rpm = 600", "SPEED_RPM=6.0d2,")
      call expect_valid(error, "speed_rpm = 600", "speed_rpm"//char(9)//"="//n//"! a comment with / & and 'quote"//n// &
         & "600"//n)
      call expect_valid(error, "", "&case title = 'it''s a / &"//" ! = title' / ! the end")
      call expect_valid(error, "", '&case title = "double" energy="source"/')
   end subroutine notation_is_fortran

   subroutine shape_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_mistake(error, "wall_thickness_mm = 2.4 /", "wall_thickness_mm = 2.4", &
         & "4:1: &roller has no '/' at its end")
      call expect_mistake(error, "", "&film law = 'moes'", "11:1: &film has no '/' at its end")
      call expect_mistake(error, "", "&film law = 'moes' /"//n//"&film law = 'moes' /", &
         & "12:1: group &film is there twice")
      call expect_mistake(error, "speed_rpm = 600", "speed_rpm = 600 speed_rpm = 700", &
         & "1:34: key 'speed_rpm' is there twice in &operating_point")
      call expect_mistake(error, "", "stray words", "11:1: text outside of a group")
      call expect_mistake(error, "exponents = 4", "exponents(1) = 4", "5:53: indexed keys are not taken")
      call expect_mistake(error, "", "&case title = 'no end /"//n//"/", "11:15: quoted text without a closing quote")
      call expect_mistake(error, "", "&film 'moes' /", "11:7: ''moes'' belongs to no key")
      call expect_mistake(error, "", "&film law = 'moes' &end", "11:20: a group ends with '/'")
      call expect_mistake(error, "speed_rpm = 600", "speed_rpm = = 600", "1:30: '=' without the name of a key")
   end subroutine shape_mistakes

   subroutine unknown_names(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_mistake(error, "speed_rpm", "speed_rmp", &
         & "1:18: unknown key 'speed_rmp' in &operating_point; did you mean 'speed_rpm'?")
      call expect_mistake(error, "speed_rpm", "speed", &
         & "1:18: unknown key 'speed' in &operating_point; did you mean 'speed_rpm'?")
      call expect_mistake(error, "&masses", "&mass", "6:1: unknown group &mass; did you mean 'masses'?")
      call expect_mistake(error, "valve_axis", "mass_kg = 3 valve_axis", &
         & "3:4: unknown key 'mass_kg' in &mechanism; it belongs to &roller")
      call expect_mistake(error, "precompression", "contact_policy = 'stop' precompression", &
         & "7:31: unknown key 'contact_policy' in &spring; it belongs to &case")
      call expect_mistake(error, "", "&film thickness_law_of_choice = 3 /", &
         & "11:7: unknown key 'thickness_law_of_choice' in &film; it has 'law', 'range_policy'")
      call expect_mistake(error, "", "&film law = 'moess' /", "11:13: 'law' must be one of 'dowson_higginson'")
      call expect_mistake(error, "", "&turbocharger /", "11:1: unknown group &turbocharger; known are 'case', ")
   end subroutine unknown_names

   subroutine value_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_mistake(error, "= 600", "= fast", "1:30: 'speed_rpm' takes one number, not fast")
      call expect_mistake(error, "= 600", "= '600'", "1:30: 'speed_rpm' takes one number, not '600'")
      call expect_mistake(error, "= 600", "= 600 rpm", "1:30: 'speed_rpm' takes one number, not 600 rpm")
      call expect_mistake(error, "= 600", "= 6,5", "1:30: 'speed_rpm' takes one number, not 2: 6,5")
      call expect_mistake(error, "= 600", "= nan", "1:30: 'speed_rpm' must be finite")
      call expect_mistake(error, "= 600", "= -Infinity", "1:30: 'speed_rpm' must be finite")
      call expect_mistake(error, "= 600", "= 1e400", "1:30: 'speed_rpm' must be finite")
      call expect_mistake(error, "= 600", "= 600000e305", "1:30: 'speed_rpm' must be finite")
      call expect_mistake(error, "= 600", "=", "1:18: 'speed_rpm' has no value")
      call expect_mistake(error, "= 600", "= ,", "1:30: 'speed_rpm' has no value")
      call expect_mistake(error, "= 4", "= 2.5", "5:65: 'exponents' takes a list of whole numbers, not 2.5")
      call expect_mistake(error, "", "&numerics max_cycles = 99999999999 /", &
         & "11:24: 'max_cycles' takes one whole number")
      call expect_mistake(error, "", "&output series = 1 /", "11:18: 'series' takes .true. or .false., not 1")
      call expect_mistake(error, "", "&film law = moes /", &
         & "11:13: 'law' takes one text in quotes, not moes; it is one of")
      call expect_mistake(error, "", "&case title = '"//repeat("x", 600)//"' /", &
         & "11:15: 'title' is longer than 510 characters")
      call expect_mistake(error, "", "&film law = '"//repeat("x", 40)//"' /", "11:13: 'law' must be one of")
      call expect_mistake(error, "", "&cam_bearings diameter_mm = 23 width_mm = 20 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0,,60 cam_positions_mm = 30 /", "11:94: 'bearing_positions_mm' has an empty place")
   end subroutine value_mistakes

   subroutine range_mistakes(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_mistake(error, "= 600", "= 0", "1:30: 'speed_rpm' must be above 0, not 0")
      call expect_mistake(error, "= 18", "= -18", "3:49: 'base_radius_mm' must be above 0, not -18")
      call expect_mistake(error, "= 60 /", "= -300 /", "1:57: 'oil_temperature_degC' must be above -273.15, not -300")
      call expect_mistake(error, "= 70", "= 181", "5:50: 'opening_half_angle_deg' must be above 0 and not above 180")
      call expect_mistake(error, "= 0.28", "= 0.6", "8:79: 'cam_poisson_ratio' must be from 0 to 0.5, not 0.6")
      call expect_mistake(error, "", "&numerics max_cycles = 0 /", "11:24: 'max_cycles' must be 1 or more, not 0")
   end subroutine range_mistakes

   subroutine missing_parts(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_mistake(error, "&surface cam_roughness_um = 0.1 roller_roughness_um = 0.1 /", "", &
         & " the group &surface is missing (roughness of cam and roller)")
      call expect_mistake(error, "mass_kg = 0.0088", "", "4:1: &roller needs 'mass_kg' (mass of the ring)")
      call expect_mistake(error, "", "&asperity /", "11:1: friction of asperities without boundary law 'table' needs")
   end subroutine missing_parts

   subroutine energy_relations(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: source = "&case energy = 'source' /"

      call expect_mistake(error, "= 64", "= 64 load_arm = 'parallel'", &
         & "7:90: 'load_arm' must be 'exact' with case energy")
      call expect_mistake(error, "= 2.4", "= 2.4 spin = 'thesis'", "4:73: 'spin' must be 'exact' with case energy")
      call expect_mistake(error, "", "&asperity boundary_coefficient = 0.1 boundary = 'full' /", &
         & "11:49: 'boundary' must be 'mobilised' with case energy")
      call expect_mistake(error, "", "&traction in_roller_balance = .false. /", &
         & "11:31: 'in_roller_balance' must be .true.")
      call expect_valid(error, "", source//"&traction in_roller_balance = .false. rolling_law = 'none' /")
      call expect_valid(error, "", source//"&asperity boundary_coefficient = 0.1 boundary = 'full' /")
   end subroutine energy_relations

   subroutine law_relations(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: sticking = "&asperity boundary_coefficient = 0.1 mobilisation = 'stick_slip' / "

      call expect_mistake(error, "", sticking//"&numerics method = 'euler' /", &
         & "11:53: 'stick_slip' needs an integration method with error control")
      call expect_valid(error, "", sticking//"&numerics method = 'radau5' /")
      call expect_mistake(error, "exponents = 4", "", "5:1: lift law 'power' needs 'exponents' in &lift")
      call expect_mistake(error, "exponents = 4", "exponents = 2", &
         & "5:65: the smallest exponent of lift law 'power' is 3")
      call expect_mistake(error, "exponents = 4", "exponents = 4, 6", &
         & "5:65: lift law 'power' takes one exponent, not 2")
      call expect_mistake(error, "exponents = 4", "exponents = 4 law = 'polydyne'", &
         & "5:65: lift law 'polydyne' takes four exponents, not 1")
      call expect_mistake(error, "exponents = 4", "exponents = 4 8 6 10 law = 'polydyne'", &
         & "5:65: the exponents must increase")
      call expect_mistake(error, "exponents = 4", "law = 'table'", "5:1: lift law 'table' needs 'table' in &lift")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", "", "10:1: temperature law 'direct' needs 'viscosity_Pa_s'")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", "viscosity_Pa_s = 0.0305 hths_viscosity_mPa_s = 3.5", &
         & "10:59: 'hths_viscosity_mPa_s' is compared with the viscosity at 150 degC, which temperature law 'direct'")
      call expect_mistake(error, "pressure_viscosity_coefficient_per_GPa = 22", "", &
         & "10:1: the oil, without a 'roelands_index', needs 'pressure_viscosity_coefficient_per_GPa'")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", &
         & "temperature_law = 'walther' temperature_points_degC = 40, 100 "// &
         & "viscosity_points_Pa_s = 0.01, 0.05", "10:98: 'viscosity_points_Pa_s' must fall")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", &
         & "temperature_law = 'walther' temperature_points_degC = 100, 40 "// &
         & "viscosity_points_Pa_s = 0.05, 0.01", "10:66: 'temperature_points_degC' must increase")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", &
         & "temperature_law = 'data_sheet' density_kg_m3 = 855", "10:1: temperature law 'data_sheet', without an 'sae_grade', "// &
         & "needs 'viscosity_at_100_degC_mm2_s' in &lubricant")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", &
         & "temperature_law = 'data_sheet' sae_grade = '5W-30' viscosity_at_40_degC_mm2_s = 64", &
         & "10:92: 'sae_grade' takes the place of viscosities")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", "temperature_law = 'data_sheet' viscosity_at_40_degC_mm2_s = 64 "// &
         & "viscosity_at_100_degC_mm2_s = 11 viscosity_index = 160", "10:126: 'viscosity_index' takes the place of")
      call expect_mistake(error, "viscosity_Pa_s = 0.0305", &
         & "temperature_law = 'vogel' temperature_points_degC = 25 60 95 "// &
         & "viscosity_points_Pa_s = 0.05, 0.01", "10:97: temperature law 'vogel' takes 3 points, not 2")
      call expect_mistake(error, "", "&traction shear_law = 'eyring' /", &
         & "11:1: shear law 'eyring' needs 'eyring_stress_MPa'")
      call expect_mistake(error, "", "&film law = 'masjedi_khonsari_rough' /", &
         & "8:1: film law 'masjedi_khonsari_rough' needs")
      call expect_mistake(error, "", "&asperity boundary_coefficient = 0.1 law = 'masjedi_khonsari' /", &
         & "11:44: asperity law 'masjedi_khonsari' goes with film law 'masjedi_khonsari_rough'")
      if (allocated(error)) return
      call expect_mistake(error, "", "&asperity boundary_coefficient = 0.1 law = 'zhao_maietta_chang' /", &
         & "8:1: asperity law 'zhao_maietta_chang' needs 'hardness_GPa'")
      call expect_mistake(error, "ratio = 0.29 /", "ratio = 0.29 hardness_GPa = 8 / "// &
         & "&asperity boundary_coefficient = 0.1 law = 'zhao_maietta_chang' roughness_product = 0.02 /", &
         & "8:215: asperity law 'zhao_maietta_chang' needs a 'roughness_product' of 0.025 or more")
      call expect_mistake(error, "", "&valve_tip pad_radius_mm = 8 law = 'stribeck' friction_coefficient = 0.1 "// &
         & "reference_viscosity_Pa_s = 0.01 reference_load_N = 300 /", &
         & "11:36: law 'stribeck' needs 'decay_speed_m_s'")
      call expect_mistake(error, "finger_kg = 0.0418", "", "6:1: &masses needs 'finger_kg', 'finger_inertia_kg_m2' or both")
   end subroutine law_relations

   subroutine points_of_coefficient(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: coefficient = "pressure_viscosity_coefficient_per_GPa = 22", &
         & points = "pressure_viscosity_points_per_GPa", temperatures = "pressure_viscosity_temperatures_degC"

      call expect_mistake(error, coefficient, temperatures//" = 20 60", "10:1: '"//temperatures//"' needs '"//points//"'")
      call expect_mistake(error, coefficient, points//" = 22 18", "10:1: '"//points//"' needs '"//temperatures//"'")
      call expect_mistake(error, coefficient, temperatures//" = 20 60 "//points//" = 18 22", &
         & "10:117: '"//points//"' must not rise with the temperature")
      call expect_mistake(error, coefficient, temperatures//" = 20 60 "//points//" = 22", &
         & "10:117: '"//points//"' has 1 values for 2 temperatures")
      call expect_mistake(error, coefficient, temperatures//" = 60 20 "//points//" = 22 18", &
         & "10:75: '"//temperatures//"' must increase")
      call expect_mistake(error, coefficient, temperatures//" = 60 "//points//" = 22", &
         & "10:75: '"//temperatures//"' takes two temperatures or more")
      call expect_mistake(error, coefficient, "roelands_index = 0.6 "//temperatures//" = 20 60 "//points//" = 22 18", &
         & "10:53: '"//points//"' takes the place of 'roelands_index'; give one of them")
   end subroutine points_of_coefficient

   subroutine geometry_relations(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: shaft = "&cam_bearings diameter_mm = 23 width_mm = 20 radial_clearance_um = 50 "

      call expect_mistake(error, "= 2.4", "= 8.5", "4:62: 'wall_thickness_mm' must be below 'radius_mm'")
      call expect_mistake(error, "", "&needle_bearing friction_coefficient = 0 needle_radius_mm = 6.2 /", &
         & "11:61: 'needle_radius_mm' must be below half of the inner radius")
      ! The bore has a radius of 8.5 - 2.4 = 6.1 mm
      call expect_mistake(error, "", "&needle_bearing friction_coefficient = 0 needle_radius_mm = 3.06 /", &
         & "11:61: 'needle_radius_mm' must be below half of the inner radius")
      call expect_valid(error, "", "&needle_bearing friction_coefficient = 0 needle_radius_mm = 3.0 /")
      call expect_mistake(error, "", "&needle_bearing friction_coefficient = 0 /", "11:1: kind 'needles' needs")
      call expect_valid(error, "", "&needle_bearing friction_coefficient = 0 kind = 'plain_pin' /")
      call expect_mistake(error, "", shaft//"bearing_positions_mm = 0 60 cam_positions_mm = 61 /", &
         & "11:118: each cam must stand between the first and the last bearing")
      call expect_mistake(error, "", shaft//"bearing_positions_mm = 60 0 cam_positions_mm = 30 /", &
         & "11:94: 'bearing_positions_mm' must increase")
      call expect_mistake(error, "", shaft//"bearing_positions_mm = 0 cam_positions_mm = 0 /", &
         & "11:94: a camshaft needs two bearings or more")
      call expect_mistake(error, "", shaft// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 40 cam_phases_deg = 90 /", &
         & "11:141: 'cam_phases_deg' has 1 entries for 2 cams")
      call expect_mistake(error, "", shaft//"bearing_positions_mm = 0 60 cam_positions_mm = 20 cam_lobes = 2 /", &
         & "11:133: a cam of lobe 2 needs the group &second_lift")
      call expect_mistake(error, "", "&cam_bearings law = 'finite' diameter_mm = 23 width_mm = 23.1 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 /", &
         & "11:58: journal bearing law 'finite', the default, covers widths from 0.1 to 1")
      call expect_mistake(error, "", "&cam_bearings law = 'finite' diameter_mm = 23 width_mm = 2.2 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 /", &
         & "11:58: journal bearing law 'finite', the default, covers widths from 0.1 to 1")
      call expect_mistake(error, "", "&cam_bearings diameter_mm = 23 width_mm = 23.1 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 /", "11:43: journal bearing law 'finite', the default, covers")
      call expect_valid(error, "", "&cam_bearings law = 'finite' diameter_mm = 23 width_mm = 23 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 /")
      call expect_valid(error, "", "&cam_bearings law = 'short_ocvirk' diameter_mm = 23 width_mm = 2 radial_clearance_um = 50 "// &
         & "bearing_positions_mm = 0 60 cam_positions_mm = 20 /")
      call expect_mistake(error, "", "&second_lift max_lift_mm = 9 opening_half_angle_deg = 70 exponents = 4 /", &
         & "11:1: &second_lift is used by no cam")
      call expect_mistake(error, "", "&numerics accuracy = 1e-3, tolerance = 1e-4 /", &
         & "11:40: 'tolerance' takes the place of 'accuracy'; give one of them")
      if (allocated(error)) return
      call expect_valid(error, "", "&numerics method = 'radau5', tolerance = 1e-4 /")
      if (allocated(error)) return
      call expect_mistake(error, "", "&output angle_step_deg = 0.7 /", "11:26: 360 must be a whole multiple")
      call expect_valid(error, "", "&output angle_step_deg = 0.1 /")
      call expect_mistake(error, "cam_roughness_um = 0.1 roller_roughness_um = 0.1", "cam_roughness_um = 0 "// &
         & "roller_roughness_um = 0 / &asperity boundary_coefficient = 0", "9:29: &asperity needs a roughness")
   end subroutine geometry_relations

   subroutine all_at_once(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      integer :: first, second, third

      call parse_sample("&roller radius_mm = -1 mass = 3 wall_thickness_mm = 1 /"//n//"&lift law = 'none' /", deck, &
         & raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, index(raised%message, "10 mistakes in sample.nml"), 1, raised%message)
      if (allocated(error)) return
      first = index(raised%message, "'radius_mm' must be above 0")
      second = index(raised%message, "unknown key 'mass'")
      third = index(raised%message, "'law' must be one of")
      call check(error, 0 < first .and. first < second .and. second < third, raised%message)
   end subroutine all_at_once

   subroutine line_and_caret(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised

      call parse_sample(changed_deck("&surface", char(9)//"&surfac"), deck, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, raised%message, "sample.nml:9:2: unknown group &surfac; did you mean 'surface'?"//n// &
         & "    9 |  &surfac cam_roughness_um = 0.1 roller_roughness_um = 0.1 /"//n//"      |  ^^^^^^^")
   end subroutine line_and_caret

   subroutine override_replaces(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(case_t) :: case
      type(error_t), allocatable :: raised

      call parse_deck(deck, sample_deck(), "sample.nml", "", [override_t("film.law=moes"), &
         & override_t("operating_point.speed_rpm=900")], raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call make_case(deck, [override_t("lift.opening_half_angle_deg=60"), override_t("case.title='a title'")], case, &
         & raised)
      if (allocated(raised)) call test_failed(error, raised%message)
      if (allocated(error)) return
      call check(error, case%film%law, "moes")
      if (allocated(error)) return
      call check(error, case%title, "a title")
      if (allocated(error)) return
      call check(error, case%operating_point%speed, 30.0_wp*pi, rel=.true., thr=round_off)
      if (allocated(error)) return
      call check(error, case%lift%closing_half_angle, 60.0_wp*degree, rel=.true., thr=round_off, &
         & message="what follows from the value follows")
   end subroutine override_replaces

   subroutine wrong_overrides(error)
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: texts(*) = [character(len=32) :: "speed_rpm=900", &
         & "operating_point.speed_rmp=900", &
         & "operating_point.speed_rpm=fast", "operating_point.speed_rpm", "asperity.boundary=full", "film.law=moess", &
         & "operating_point.speed_rpm=-1", "roller.wall_thickness_mm=9", "operating_point.speed_rpm=9 /"]
      character(len=*), parameter :: messages(*) = [character(len=56) :: "expected group.key=value", &
         & "did you mean 'speed_rpm'?", &
         & "takes one number, not fast", "expected group.key=value", "&asperity is not in the deck", &
         & "did you mean 'moes'?", &
         & "must be above 0", "must be below 'radius_mm'", "is no value of 'speed_rpm'"]
      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      integer :: i

      do i = 1, size(texts)
         call parse_deck(deck, sample_deck(), "sample.nml", "", [override_t(trim(texts(i)))], raised)
         call check(error, allocated(raised), "accepted: "//texts(i))
         if (allocated(error)) return
         call check(error, index(raised%message, "override: ") == 1 .and. index(raised%message, &
            & trim(messages(i))) > 0 .and. &
            & index(raised%message, "      | "//trim(texts(i))//n) > 0, raised%message)
         if (allocated(error)) return
      end do
   end subroutine wrong_overrides

   subroutine no_such_file(error)
      type(error_type), allocatable, intent(out) :: error

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(override_t) :: none(0)

      call read_deck(deck, "test/data/no_such_deck.nml", none, raised)
      call check(error, allocated(raised))
      if (allocated(error)) return
      call check(error, raised%kind, kind_file)
      if (allocated(error)) return
      call check(error, raised%message, "there is no file 'test/data/no_such_deck.nml'")
   end subroutine no_such_file

   !> Case of a text.
   subroutine sample_case(error, text, case)
      !> Outcome of the test
      type(error_type), allocatable, intent(out) :: error
      !> The deck
      character(len=*), intent(in) :: text
      !> Its case
      type(case_t), intent(out) :: case

      type(deck_t) :: deck
      type(error_t), allocatable :: raised
      type(override_t) :: none(0)

      call parse_sample(text, deck, raised)
      if (.not. allocated(raised)) call make_case(deck, none, case, raised)
      if (allocated(raised)) call test_failed(error, raised%message)
   end subroutine sample_case

   !> Are two numbers the same?
   subroutine same(error, what, actual, expected)
      !> Outcome of the test; nothing is tried where it is known already
      type(error_type), allocatable, intent(inout) :: error
      !> What they are
      character(len=*), intent(in) :: what
      !> The numbers [any unit]
      real(wp), intent(in) :: actual, expected

      if (allocated(error)) return
      call check(error, abs(actual - expected) <= round_off*abs(expected), what)
   end subroutine same

end module test_deck
