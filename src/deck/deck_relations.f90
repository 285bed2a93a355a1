!> Rules that tie the values of several keys together.
!>
!> In: settings whose values are each in range. Out: a mistake for each broken rule, at the key that breaks it. A rule is silent
!> where one of its values is wrong already. What needs the geometry worked out is checked by the model.
module camroller_deck_relations
   use camroller_kinds, only : wp
   use camroller_accuracy, only : divides_turn, has_error_control
   use camroller_journal, only : law_can_orbit, law_covers_width, orbit_advice, width_advice
   use camroller_number_text, only : integer_text
   use camroller_mistakes, only : mistakes_t
   use camroller_settings, only : settings_t, take, find_value, is_known, is_wrong, get_word, has_group
   use camroller_deck_asperity, only : check_asperities, check_modifier
   use camroller_deck_dynamics, only : check_dynamics
   use camroller_deck_heat, only : check_heat
   use camroller_deck_profile, only : check_profile
   use camroller_deck_roller_bearing, only : check_roller_bearing
   use camroller_deck_joints, only : check_joints
   use camroller_deck_boundary_law, only : check_boundary_law
   use camroller_deck_running_in, only : check_running_in
   use camroller_deck_complaint, only : complain, complain_about_group, demand
   use camroller_deck_cam_bearings, only : check_bearing_parts
   use camroller_deck_engine, only : check_engine
   implicit none
   private

   public :: check_relations

   !> Pressure-viscosity coefficients over the temperature
   character(len=*), parameter :: points_key = "pressure_viscosity_points_per_GPa", &
      & temperatures_key = "pressure_viscosity_temperatures_degC"

contains

   !> All rules.
   subroutine check_relations(settings, mistakes)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      call energy_needs_its_bookkeeping(settings, mistakes)
      call check_roller_bearing(settings, mistakes)
      call finger_has_a_mass(settings, mistakes)
      call lift_has_what_its_law_needs(settings, "lift", mistakes)
      if (has_group(settings, "second_lift")) call lift_has_what_its_law_needs(settings, "second_lift", mistakes)
      call second_lift_is_used(settings, mistakes)
      call oil_has_what_its_law_needs(settings, mistakes)
      call contact_has_what_its_laws_need(settings, mistakes)
      if (has_group(settings, "cam_bearings")) call bearings_suit_their_law(settings, mistakes)
      if (has_group(settings, "cam_bearings")) call cams_stand_between_bearings(settings, mistakes)
      call check_bearing_parts(settings, mistakes)
      call check_engine(settings, mistakes)
      call accuracy_or_tolerance(settings, mistakes)
      call output_step_divides_the_turn(settings, mistakes)
      call stick_slip_has_a_method(settings, mistakes)
      call check_joints(settings, mistakes)
      call check_profile(settings, mistakes)
      call check_heat(settings, mistakes)
      call check_modifier(settings, mistakes)
      call check_boundary_law(settings, mistakes)
      call check_running_in(settings, mistakes)
      call check_dynamics(settings, mistakes)
   end subroutine check_relations

   !> The closed energy balance needs exact arm and spin, mobilised boundary friction, rolling resistance in the
   !> balance.
   subroutine energy_needs_its_bookkeeping(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: advice = " with case energy = 'consistent'; set that to 'source' for anything else"
      logical :: is_in_balance

      if (get_word(settings, "case", "energy") /= "consistent") return
      if (get_word(settings, "spring", "load_arm") == "parallel") then
         call complain(mistakes, settings, "spring", "load_arm", "'load_arm' must be 'exact'"//advice)
      end if
      if (get_word(settings, "roller", "spin") == "thesis") then
         call complain(mistakes, settings, "roller", "spin", "'spin' must be 'exact'"//advice)
      end if
      if (has_group(settings, "asperity") .and. get_word(settings, "asperity", "boundary") == "full") then
         call complain(mistakes, settings, "asperity", "boundary", "'boundary' must be 'mobilised'"//advice)
      end if
      is_in_balance = .true.
      call take(settings, "traction", "in_roller_balance", is_in_balance)
      if (is_in_balance) return
      call complain(mistakes, settings, "traction", "in_roller_balance", "'in_roller_balance' must be .true."//advice)
   end subroutine energy_needs_its_bookkeeping

   !> Only methods with error control tell sticking from sliding.
   subroutine stick_slip_has_a_method(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (.not. has_group(settings, "asperity")) return
      if (get_word(settings, "asperity", "mobilisation") /= "stick_slip") return
      if (.not. has_error_control(get_word(settings, "numerics", "method"))) call complain(mistakes, settings, "asperity", &
         & "mobilisation", "'stick_slip' needs an integration method with error control; choose another 'method' in &numerics")
   end subroutine stick_slip_has_a_method

   !> The finger has a mass, a moment of inertia or both.
   subroutine finger_has_a_mass(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (is_known(settings, "masses", "finger_kg") .or. is_known(settings, "masses", "finger_inertia_kg_m2")) return
      if (is_wrong(settings, "masses", "finger_kg") .or. is_wrong(settings, "masses", "finger_inertia_kg_m2")) return
      if (.not. has_group(settings, "masses")) return
      call complain_about_group(mistakes, settings, "masses", "&masses needs 'finger_kg', 'finger_inertia_kg_m2' or both")
   end subroutine finger_has_a_mass

   !> A lift law comes with its lengths, angles and exponents, or with its table.
   subroutine lift_has_what_its_law_needs(settings, group, mistakes)
      type(settings_t), intent(in) :: settings
      !> Name of the lift's group
      character(len=*), intent(in) :: group
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=:), allocatable :: law

      if (.not. has_group(settings, group)) return
      law = get_word(settings, group, "law")
      select case (law)
      case ("")
         return
      case ("table")
         call demand(settings, group, "table", "lift law 'table'", mistakes)
         return
      end select
      call demand(settings, group, "max_lift_mm", "lift law '"//law//"'", mistakes)
      if (law == "segments") then
         call demand(settings, group, "segment_angles_deg", "lift law 'segments'", mistakes)
         call demand(settings, group, "segment_accelerations", "lift law 'segments'", mistakes)
         return
      end if
      call demand(settings, group, "opening_half_angle_deg", "lift law '"//law//"'", mistakes)
      select case (law)
      case ("power")
         call demand_exponents(settings, group, law, 1, mistakes)
      case ("polydyne")
         call demand_exponents(settings, group, law, 4, mistakes)
      end select
   end subroutine lift_has_what_its_law_needs

   !> The exponents of a lift law, increasing and each large enough for two continuous derivatives.
   subroutine demand_exponents(settings, group, law, number, mistakes)
      type(settings_t), intent(in) :: settings
      !> Names of the lift's group and of its law
      character(len=*), intent(in) :: group, law
      !> Number of exponents
      integer, intent(in) :: number
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Below it the acceleration jumps
      integer, parameter :: smallest = 3
      integer, allocatable :: exponents(:)

      call demand(settings, group, "exponents", "lift law '"//law//"'", mistakes)
      if (.not. is_known(settings, group, "exponents")) return
      call take(settings, group, "exponents", exponents)
      if (size(exponents) /= number) then
         call complain(mistakes, settings, group, "exponents", "lift law '"//law//"' takes "// &
            & trim(merge("one exponent  ", "four exponents", number == 1))//", not "//integer_text(size(exponents)))
      else if (exponents(1) < smallest) then
         call complain(mistakes, settings, group, "exponents", "the smallest exponent of lift law '"//law//"' is "// &
            & integer_text(smallest)//", or the acceleration would jump")
      else if (any(exponents(2:) <= exponents(:number - 1))) then
         call complain(mistakes, settings, group, "exponents", "the exponents must increase")
      end if
   end subroutine demand_exponents

   !> A second lobe shape has a cam, and a cam of the second lobe shape has a lift.
   subroutine second_lift_is_used(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      integer, allocatable :: lobes(:)
      logical :: is_used
      integer :: camshafts

      ! A second camshaft has the second lobe shape
      camshafts = 1
      if (has_group(settings, "engine")) call take(settings, "engine", "camshafts", camshafts)
      if (camshafts == 2) return
      allocate (lobes(0))
      if (has_group(settings, "cam_bearings")) then
         if (is_wrong(settings, "cam_bearings", "cam_lobes")) return
         call take(settings, "cam_bearings", "cam_lobes", lobes)
      end if
      is_used = any(lobes == 2)
      if (is_used .eqv. has_group(settings, "second_lift")) return
      if (is_used) then
         call complain(mistakes, settings, "cam_bearings", "cam_lobes", "a cam of lobe 2 needs the group &second_lift")
      else
         call complain_about_group(mistakes, settings, "second_lift", &
            & "&second_lift is used by no cam: 'cam_lobes' of &cam_bearings has no 2")
      end if
   end subroutine second_lift_is_used

   !> Viscosity is given as its law takes it, and the pressure-viscosity coefficient directly or by Roelands' index.
   subroutine oil_has_what_its_law_needs(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (.not. has_group(settings, "lubricant")) return
      call check_pressure_points(settings, mistakes)
      select case (get_word(settings, "lubricant", "temperature_law"))
      case ("direct")
         call demand(settings, "lubricant", "viscosity_Pa_s", "temperature law 'direct'", mistakes)
         if (is_known(settings, "lubricant", "hths_viscosity_mPa_s")) call complain(mistakes, settings, "lubricant", &
            & "hths_viscosity_mPa_s", "'hths_viscosity_mPa_s' is compared with the viscosity at 150 degC, which temperature "// &
            & "law 'direct' does not tell")
      case ("vogel")
         call demand_points(settings, "vogel", 3, mistakes)
      case ("walther")
         call demand_points(settings, "walther", 2, mistakes)
         return
      case ("data_sheet")
         call demand_data_sheet(settings, mistakes)
         return
      end select
      if (is_known(settings, "lubricant", "roelands_index") .or. is_wrong(settings, "lubricant", &
         & "roelands_index")) return
      if (any([is_known(settings, "lubricant", points_key), is_wrong(settings, "lubricant", points_key), &
         & is_known(settings, "lubricant", temperatures_key), is_wrong(settings, "lubricant", temperatures_key)])) return
      call demand(settings, "lubricant", "pressure_viscosity_coefficient_per_GPa", &
         & "the oil, without a 'roelands_index',", &
         & mistakes)
   end subroutine oil_has_what_its_law_needs

   !> Pressure-viscosity coefficients over the temperature: as many as temperatures, in order, and no other coefficient.
   subroutine check_pressure_points(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: group = "lubricant", others(*) = [character(len=38) :: &
         & "pressure_viscosity_coefficient_per_GPa", "roelands_index"]
      !> Temperatures [K] and coefficients [1/Pa]
      real(wp), allocatable :: temperatures(:), coefficients(:)
      integer :: i

      if (is_known(settings, group, temperatures_key)) call demand(settings, group, points_key, "'"//temperatures_key//"'", &
         & mistakes)
      if (.not. is_known(settings, group, points_key)) return
      call demand(settings, group, temperatures_key, "'"//points_key//"'", mistakes)
      do i = 1, size(others)
         if (is_known(settings, group, trim(others(i)))) call complain(mistakes, settings, group, trim(others(i)), &
            & "'"//points_key//"' takes the place of '"//trim(others(i))//"'; give one of them")
      end do
      if (.not. is_known(settings, group, temperatures_key)) return
      call take(settings, group, temperatures_key, temperatures)
      call take(settings, group, points_key, coefficients)
      if (size(temperatures) < 2) then
         call complain(mistakes, settings, group, temperatures_key, "'"//temperatures_key//"' takes two temperatures or more")
      else if (any(temperatures(2:) <= temperatures(:size(temperatures) - 1))) then
         call complain(mistakes, settings, group, temperatures_key, "'"//temperatures_key//"' must increase")
      else if (size(coefficients) /= size(temperatures)) then
         call complain(mistakes, settings, group, points_key, "'"//points_key//"' has "//integer_text(size(coefficients))// &
            & " values for "//integer_text(size(temperatures))//" temperatures")
      else if (any(coefficients(2:) > coefficients(:size(coefficients) - 1))) then
         call complain(mistakes, settings, group, points_key, "'"//points_key//"' must not rise with the temperature")
      end if
   end subroutine check_pressure_points

   !> A data sheet gives two viscosities, or one with the viscosity index, or a grade; and nothing twice.
   subroutine demand_data_sheet(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: group = "lubricant", at_40 = "viscosity_at_40_degC_mm2_s", &
         & at_100 = "viscosity_at_100_degC_mm2_s", needs = "temperature law 'data_sheet'"

      if (get_word(settings, group, "sae_grade") /= "none") then
         if (is_known(settings, group, at_40)) call complain(mistakes, settings, group, at_40, &
            & "'sae_grade' takes the place of viscosities; give one of them")
         if (is_known(settings, group, at_100)) call complain(mistakes, settings, group, at_100, &
            & "'sae_grade' takes the place of viscosities; give one of them")
         return
      end if
      call demand(settings, group, at_100, needs//", without an 'sae_grade',", mistakes)
      if (.not. is_known(settings, group, at_100)) return
      if (is_known(settings, group, at_40) .and. is_known(settings, group, "viscosity_index")) then
         call complain(mistakes, settings, group, "viscosity_index", "'viscosity_index' takes the place of '"//at_40// &
            & "'; give one of them")
      else if (.not. is_known(settings, group, "viscosity_index") .and. .not. is_wrong(settings, group, "viscosity_index")) then
         call demand(settings, group, at_40, needs//", without a 'viscosity_index',", mistakes)
      end if
   end subroutine demand_data_sheet

   !> Points of a viscosity-temperature law.
   subroutine demand_points(settings, law, number, mistakes)
      type(settings_t), intent(in) :: settings
      character(len=*), intent(in) :: law
      !> Number of points
      integer, intent(in) :: number
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: group = "lubricant", t_key = "temperature_points_degC", &
         & v_key = "viscosity_points_Pa_s"
      !> Temperatures [K] and viscosities [Pa s]
      real(wp), allocatable :: temperatures(:), viscosities(:)
      character(len=:), allocatable :: words

      call demand(settings, group, t_key, "temperature law '"//law//"'", mistakes)
      call demand(settings, group, v_key, "temperature law '"//law//"'", mistakes)
      words = "temperature law '"//law//"' takes "//integer_text(number)//" points, not "
      if (is_known(settings, group, t_key)) then
         call take(settings, group, t_key, temperatures)
         if (size(temperatures) /= number) then
            call complain(mistakes, settings, group, t_key, words//integer_text(size(temperatures)))
         else if (any(temperatures(2:) <= temperatures(:number - 1))) then
            call complain(mistakes, settings, group, t_key, "'"//t_key//"' must increase")
         end if
      end if
      if (is_known(settings, group, v_key)) then
         call take(settings, group, v_key, viscosities)
         if (size(viscosities) /= number) then
            call complain(mistakes, settings, group, v_key, words//integer_text(size(viscosities)))
         else if (any(viscosities(2:) >= viscosities(:number - 1))) then
            call complain(mistakes, settings, group, v_key, "'"//v_key//"' must fall")
         end if
      end if
   end subroutine demand_points

   !> Eyring's law has its stress, the rough film law hardness and roughness, asperities a roughness.
   subroutine contact_has_what_its_laws_need(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Roughness of cam and roller [m]
      real(wp) :: cam, roller
      character(len=:), allocatable :: needer

      if (get_word(settings, "traction", "shear_law") == "eyring") then
         call demand(settings, "traction", "eyring_stress_MPa", "shear law 'eyring'", mistakes)
      end if
      needer = ""
      if (has_group(settings, "asperity")) then
         needer = "&asperity"
         call check_asperities(settings, mistakes)
      end if
      if (get_word(settings, "film", "law") == "masjedi_khonsari_rough") then
         call demand(settings, "materials", "hardness_GPa", "film law 'masjedi_khonsari_rough'", mistakes)
         needer = "film law 'masjedi_khonsari_rough'"
      end if
      if (needer == "" .or. .not. is_known(settings, "surface", "cam_roughness_um")) return
      if (.not. is_known(settings, "surface", "roller_roughness_um")) return
      call take(settings, "surface", "cam_roughness_um", cam)
      call take(settings, "surface", "roller_roughness_um", roller)
      if (cam > 0.0_wp .or. roller > 0.0_wp) return
      call complain(mistakes, settings, "surface", "cam_roughness_um", needer// &
         & " needs a roughness of cam or roller above 0")
   end subroutine contact_has_what_its_laws_need

   !> Bearings are in order, each cam stands between two of them, and each list has an entry for every cam.
   subroutine cams_stand_between_bearings(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      character(len=*), parameter :: group = "cam_bearings"
      !> Places of bearings and cams along the shaft [m]
      real(wp), allocatable :: bearings(:), cams(:)
      integer :: n

      if (.not. is_known(settings, group, "cam_positions_mm")) return
      call take(settings, group, "cam_positions_mm", cams)
      call check_cams(settings, "cam_phases_deg", size(cams), mistakes)
      call check_cams(settings, "cam_lobes", size(cams), mistakes)
      call check_cams(settings, "follower_angles_deg", size(cams), mistakes)
      if (.not. is_known(settings, group, "bearing_positions_mm")) return
      call take(settings, group, "bearing_positions_mm", bearings)
      n = size(bearings)
      if (n < 2) then
         call complain(mistakes, settings, group, "bearing_positions_mm", "a camshaft needs two bearings or more")
      else if (any(bearings(2:) <= bearings(:n - 1))) then
         call complain(mistakes, settings, group, "bearing_positions_mm", "'bearing_positions_mm' must increase")
      else if (any(cams < bearings(1)) .or. any(cams > bearings(n))) then
         call complain(mistakes, settings, group, "cam_positions_mm", &
            & "each cam must stand between the first and the last bearing")
      end if
   end subroutine cams_stand_between_bearings

   !> The law of finite width covers some widths, a law may have no orbits.
   subroutine bearings_suit_their_law(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Dimensions of a bearing [m]
      real(wp) :: width, diameter

      if (.not. law_can_orbit(get_word(settings, "cam_bearings", "law"), get_word(settings, "cam_bearings", &
         & "journal_motion"))) then
         call complain(mistakes, settings, "cam_bearings", "journal_motion", orbit_advice)
      end if
      if (.not. (is_known(settings, "cam_bearings", "width_mm") .and. is_known(settings, "cam_bearings", "diameter_mm"))) return
      call take(settings, "cam_bearings", "width_mm", width)
      call take(settings, "cam_bearings", "diameter_mm", diameter)
      if (law_covers_width(get_word(settings, "cam_bearings", "law"), width, diameter)) return
      call complain(mistakes, settings, "cam_bearings", "width_mm", width_advice)
   end subroutine bearings_suit_their_law

   !> One entry for each cam; angles count from the first one.
   subroutine check_cams(settings, key, cams, mistakes)
      type(settings_t), intent(in) :: settings
      !> Name of the list
      character(len=*), intent(in) :: key
      !> Number of cams
      integer, intent(in) :: cams
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> The list [rad]; sine of half the first angle that is rounding of whole turns [-]
      real(wp), allocatable :: numbers(:)
      real(wp), parameter :: rounding = 1.0e-12_wp
      integer, allocatable :: integers(:)
      integer :: length

      if (.not. is_known(settings, "cam_bearings", key)) return
      if (key == "cam_lobes") then
         call take(settings, "cam_bearings", key, integers)
         length = size(integers)
      else
         call take(settings, "cam_bearings", key, numbers)
         length = size(numbers)
      end if
      if (length /= cams) then
         call complain(mistakes, settings, "cam_bearings", key, "'"//key//"' has "//integer_text(length)//" entries for "// &
            & integer_text(cams)//" cams of 'cam_positions_mm'")
      else if (allocated(numbers)) then
         if (abs(sin(0.5_wp*numbers(1))) > rounding) call complain(mistakes, settings, "cam_bearings", key, &
            & "'"//key//"' must begin with 0: its angles count from the first cam's")
      end if
   end subroutine check_cams

   !> A tolerance takes the place of an accuracy.
   subroutine accuracy_or_tolerance(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      if (.not. settings%values(find_value(settings, "numerics", "accuracy"))%is_given) return
      if (.not. settings%values(find_value(settings, "numerics", "tolerance"))%is_given) return
      call complain(mistakes, settings, "numerics", "tolerance", "'tolerance' takes the place of 'accuracy'; give one of them")
   end subroutine accuracy_or_tolerance

   !> The reported angles are the same in every cycle.
   subroutine output_step_divides_the_turn(settings, mistakes)
      type(settings_t), intent(in) :: settings
      !> Mistakes so far
      type(mistakes_t), intent(inout) :: mistakes

      !> Step [rad]
      real(wp) :: step

      if (.not. is_known(settings, "output", "angle_step_deg")) return
      call take(settings, "output", "angle_step_deg", step)
      if (divides_turn(step)) return
      call complain(mistakes, settings, "output", "angle_step_deg", &
         & "360 must be a whole multiple of 'angle_step_deg', with fewer than a million points")
   end subroutine output_step_divides_the_turn

end module camroller_deck_relations
