!> Decks: values that are each possible, and together belong to no train.
!>
!> In: settings, keys that vary or have a remark already. Out: a sentence for each such pair. Nothing is refused for them; values
!> that no train can have at all are mistakes of their own groups.
module camroller_deck_sense
   use camroller_kinds, only : wp, pi, degree
   use camroller_deck_engine, only : strokes_of
   use camroller_engine, only : from_firing
   use camroller_text_lines, only : add_line, line_t
   use camroller_needle, only : has_needles, kind_skf, roller_bearing_names
   use camroller_number_text, only : counted, integer_text, number_text
   use camroller_oil_data, only : smallest_indexed, viscosity_at_40
   use camroller_settings, only : find_value, get_word, has_group, is_known, settings_t, take
   implicit none
   private

   public :: list_odd_pairs

   !> Digits of numbers in sentences
   integer, parameter :: digits = 4
   !> Millimetres of a metre [mm/m], grams per cubic centimetre of a kilogram per cubic metre [-]
   real(wp), parameter :: mm = 1.0e3_wp, g_cm3 = 1.0e-3_wp
   !> Rounding and chamfers: lengths that differ by less agree [-]
   real(wp), parameter :: room = 0.1_wp
   !> Density of a ring as wide as the contact: steel has 7800, ceramics 3200; rings may be twice as wide, or half [kg/m^3]
   real(wp), parameter :: ring_density(2) = [1500.0_wp, 16000.0_wp]
   !> Viscosity index of engine oils: plain mineral oils have 60 to 100, the best multigrade oils 250 [-]
   real(wp), parameter :: usual_index(2) = [50.0_wp, 300.0_wp]

contains

   !> All of them.
   subroutine list_odd_pairs(settings, varied, left_out, remarks)
      !> The settings
      type(settings_t), intent(in) :: settings
      !> Keys that vary, as `group.key`
      character(len=*), intent(in) :: varied(:)
      !> Keys of which nothing is said: those that vary, and those that have a remark of their own
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      call compare_masses(settings, left_out, remarks)
      call compare_roller_bearing(settings, left_out, remarks)
      call compare_guide(settings, left_out, remarks)
      call compare_viscosities(settings, left_out, remarks)
      call compare_lash(settings, left_out, remarks)
      call compare_boundary(settings, left_out, remarks)
      call compare_cams(settings, left_out, remarks)
      call look_at_engine(settings, left_out, remarks)
      call look_at_temperature(settings, varied, remarks)
      if (.not. has_group(settings, "heat")) return
      if (any(left_out == "heat.inlet_law") .or. any(left_out == "heat.contact")) return
      if (get_word(settings, "heat", "inlet_law") == "none" .and. get_word(settings, "heat", "contact") == "none") then
         call add_line(remarks, "&heat has no effect: inlet_law and contact are both 'none'")
      end if
   end subroutine list_odd_pairs

   !> The ring is made of something, and is a part of the finger, whose mass is where the finger is.
   subroutine compare_masses(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Values of keys [SI units]
      real(wp) :: value(4)
      ! Density of the ring [kg/m^3], radius of gyration [m]
      real(wp) :: density, gyration
      logical :: are_there

      call get(settings, left_out, "roller.mass_kg masses.finger_kg", value, are_there)
      if (are_there .and. value(2) > 0.0_wp .and. value(1) >= value(2)) call add_line(remarks, "roller.mass_kg = "// &
         & number_text(value(1), digits)//" is not below masses.finger_kg = "//number_text(value(2), digits)// &
         & ", which holds the roller too")
      call get(settings, left_out, "roller.mass_kg roller.radius_mm roller.wall_thickness_mm mechanism.contact_width_mm", value, &
         & are_there)
      if (are_there) then
         density = value(1)/(pi*value(3)*(2.0_wp*value(2) - value(3))*value(4))
         if (density < ring_density(1) .or. density > ring_density(2)) call add_line(remarks, "roller.mass_kg = "// &
            & number_text(value(1), digits)//": a ring of these radii, as wide as the contact, would have "// &
            & number_text(g_cm3*density, 2)//" g/cm^3; steel has 7.8")
      end if
      call get(settings, left_out, "masses.finger_inertia_kg_m2 masses.finger_kg mechanism.pivot_to_pad_mm", value, are_there)
      if (.not. are_there .or. .not. value(2) > 0.0_wp) return
      gyration = sqrt(value(1)/value(2))
      if (gyration > (1.0_wp + room)*value(3)) call add_line(remarks, "masses.finger_inertia_kg_m2 = "// &
         & number_text(value(1), digits)//": the finger's mass would be "//number_text(mm*gyration, 3)// &
         & " mm from its pivot, whose pad is at "//number_text(mm*value(3), digits)//" mm")
   end subroutine compare_masses

   !> Needles roll between pin and ring.
   subroutine compare_roller_bearing(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Values of keys, radius of the needles, diameter of their circle by the others [m]
      real(wp) :: value(3), needle(1), by_others
      ! Coefficients of friction [-]
      real(wp) :: coefficients(2)
      logical :: are_there, is_there

      call get(settings, left_out, "needle_bearing.friction_coefficient needle_bearing.skf_film_coefficient", coefficients, &
         & are_there)
      if (are_there .and. .not. any(left_out == "needle_bearing.kind")) then
         if (get_word(settings, "needle_bearing", "kind") == roller_bearing_names(kind_skf) .and. &
            & coefficients(1) < coefficients(2)) call add_line(remarks, "needle_bearing.friction_coefficient = "// &
            & number_text(coefficients(1), digits)//" is that of sliding without a film with kind = 'needles_skf', 0.12 to "// &
            & "0.15 as a rule, and less than that under a whole film, "//number_text(coefficients(2), digits))
      end if
      if (.not. has_group(settings, "needle_drag")) return
      if (has_group(settings, "needle_bearing") .and. .not. any(left_out == "needle_bearing.kind")) then
         if (.not. has_needles(get_word(settings, "needle_bearing", "kind"))) then
            call add_line(remarks, "&needle_drag is the oil's drag on needles, and needle_bearing.kind is '"// &
               & get_word(settings, "needle_bearing", "kind")//"'")
            return
         end if
      end if
      call get(settings, left_out, "needle_drag.pitch_diameter_mm roller.radius_mm roller.wall_thickness_mm", value, are_there)
      if (.not. are_there) return
      call get(settings, left_out, "needle_bearing.needle_radius_mm", needle, is_there)
      if (.not. is_there) needle = 0.0_wp
      by_others = 2.0_wp*(value(2) - value(3) - needle(1))
      if (is_there .and. abs(value(1) - by_others) <= room*by_others) return
      if (.not. is_there .and. value(1) <= by_others .and. value(1) >= 0.5_wp*by_others) return
      call add_line(remarks, "needle_drag.pitch_diameter_mm = "//number_text(mm*value(1), digits)// &
         & ": radius, wall and needles of the roller give "//number_text(mm*by_others, digits)//" mm")
   end subroutine compare_roller_bearing

   !> The guide of &valve_guide is that of &guide_side_load; the valve's tip stays above it.
   subroutine compare_guide(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: group = "guide_side_load", lifts(*) = [character(len=11) :: "lift", "second_lift"]
      ! Values of keys [m]
      real(wp) :: value(2)
      logical :: are_there
      integer :: i

      if (.not. has_group(settings, group)) return
      call get(settings, left_out, group//".guide_length_mm valve_guide.length_mm", value, are_there)
      if (are_there .and. abs(value(1) - value(2)) > room*maxval(value)) call add_line(remarks, group//".guide_length_mm = "// &
         & number_text(mm*value(1), digits)//" and valve_guide.length_mm = "//number_text(mm*value(2), digits)// &
         & " are of the same guide")
      do i = 1, size(lifts)
         call get(settings, left_out, group//".tip_height_mm "//trim(lifts(i))//".max_lift_mm", value, are_there)
         if (.not. are_there .or. value(1) >= value(2)) cycle
         call add_line(remarks, group//".tip_height_mm = "//number_text(mm*value(1), digits)//": the valve's tip would go "// &
            & number_text(mm*(value(2) - value(1)), 3)//" mm into its guide, with a lift of "//number_text(mm*value(2), digits)// &
            & " mm")
         exit
      end do
   end subroutine compare_guide

   !> Two viscosities of one oil.
   subroutine compare_viscosities(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Square millimetres of a square metre [mm^2/m^2]
      real(wp), parameter :: mm2 = 1.0e6_wp
      ! Viscosities at 40 and 100 degC [mm^2/s]
      real(wp) :: value(2)
      character(len=:), allocatable :: words
      logical :: are_there

      if (get_word(settings, "lubricant", "temperature_law") /= "data_sheet") return
      call get(settings, left_out, "lubricant.viscosity_at_40_degC_mm2_s lubricant.viscosity_at_100_degC_mm2_s", value, are_there)
      if (.not. are_there) return
      value = mm2*value
      if (value(2) < smallest_indexed) return
      if (value(1) > viscosity_at_40(value(2), usual_index(1))) then
         words = "below "//number_text(usual_index(1))
      else if (value(1) < viscosity_at_40(value(2), usual_index(2))) then
         words = "above "//number_text(usual_index(2))
      else
         return
      end if
      call add_line(remarks, "lubricant: "//number_text(value(1), digits)//" mm^2/s at 40 degC and "// &
         & number_text(value(2), digits)//" at 100 degC are unusual: a viscosity index "//words//"; are they of the same oil?")
   end subroutine compare_viscosities

   !> With lash the base circle load of a rigid train is not there.
   subroutine compare_lash(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Lash [m], load [N]
      real(wp) :: value(2)
      logical :: are_there

      call get(settings, left_out, "dynamics.lash_mm spring.base_circle_load_N", value, are_there)
      if (are_there .and. all(value > 0.0_wp)) call add_line(remarks, "spring.base_circle_load_N = "// &
         & number_text(value(2), digits)//" does not load the flexible train, whose clearance dynamics.lash_mm gives; margins "// &
         & "and estimates of the rigid train have it")
   end subroutine compare_lash

   !> The coefficient of asperities is that of the logarithmic law at its reference, and within its bounds.
   subroutine compare_boundary(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: key = "asperity.boundary_coefficient", group = "boundary_law"
      ! Coefficients [-]
      real(wp) :: value(3)
      logical :: are_there

      if (any(left_out == group//".law")) return
      if (get_word(settings, group, "law") == "table") then
         call compare_points(settings, left_out, remarks)
         return
      end if
      call get(settings, left_out, key//" "//group//".smallest_coefficient "//group//".largest_coefficient", value, are_there)
      if (.not. are_there) return
      if (value(1) > value(3)) call add_line(remarks, key//" = "//number_text(value(1), digits)//" is cut to "//group// &
         & ".largest_coefficient = "//number_text(value(3), digits))
      if (value(1) < value(2)) call add_line(remarks, key//" = "//number_text(value(1), digits)//" is raised to "//group// &
         & ".smallest_coefficient = "//number_text(value(2), digits))
   end subroutine compare_boundary

   !> Bounds of the coefficient and a table of it.
   subroutine compare_points(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: group = "boundary_law", key = group//".coefficient_points"
      ! Bounds, points of the table [-]
      real(wp) :: bounds(4)
      real(wp), allocatable :: points(:)
      logical :: are_there

      call get(settings, left_out, group//".smallest_coefficient "//group//".largest_coefficient", bounds, are_there)
      if (.not. are_there .or. any(left_out == key) .or. .not. is_known(settings, group, "coefficient_points")) return
      call take(settings, group, "coefficient_points", points)
      if (maxval(points) > bounds(2)) call add_line(remarks, key//" goes up to "//number_text(maxval(points), digits)// &
         & " and is cut to "//group//".largest_coefficient = "//number_text(bounds(2), digits))
      if (minval(points) < bounds(1)) call add_line(remarks, key//" goes down to "//number_text(minval(points), digits)// &
         & " and is raised to "//group//".smallest_coefficient = "//number_text(bounds(1), digits))
   end subroutine compare_points

   !> Cams of a shaft stand side by side.
   subroutine compare_cams(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: key = "cam_positions_mm", group = "cam_bearings"
      ! Width of the contacts, places of the cams [m]
      real(wp) :: width(1)
      real(wp), allocatable :: places(:)
      logical :: is_there
      integer :: i, k

      call get(settings, left_out, "mechanism.contact_width_mm", width, is_there)
      if (.not. is_there .or. .not. has_group(settings, group) .or. any(left_out == group//"."//key)) return
      if (.not. is_known(settings, group, key)) return
      call take(settings, group, key, places)
      do i = 1, size(places)
         do k = i + 1, size(places)
            if (abs(places(i) - places(k)) >= (1.0_wp - room)*width(1)) cycle
            call add_line(remarks, group//"."//key//": cams "//integer_text(i)//" and "//integer_text(k)//" are "// &
               & number_text(mm*abs(places(i) - places(k)), digits)//" mm apart and have contacts of "// &
               & number_text(mm*width(1), digits)//" mm width: they overlap")
            return
         end do
      end do
   end subroutine compare_cams

   !> Valves open when their cylinder does not fire, and each cylinder has some.
   subroutine look_at_engine(settings, left_out, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      ! Crank angles of full lift [rad]
      real(wp), allocatable :: full_lift(:)
      ! Nearest to firing that a valve of a four-stroke engine is wide open: exhaust valves are so at 240 to 265 degrees, and half
      ! of that is no crank angle [rad]
      real(wp), parameter :: near_firing = 170.0_wp*degree
      integer, allocatable :: cylinders_of_cams(:), cams(:)
      integer :: cylinders, i, idle

      if (.not. (has_group(settings, "engine") .and. has_group(settings, "cam_bearings"))) return
      if (strokes_of(settings) == 4 .and. is_known(settings, "engine", "full_lift_deg") .and. &
         & .not. any(left_out == "engine.full_lift_deg")) then
         call take(settings, "engine", "full_lift_deg", full_lift)
         do i = 1, size(full_lift)
            if (abs(from_firing(full_lift(i), strokes_of(settings))) >= near_firing) cycle
            call add_line(remarks, "engine.full_lift_deg = "//number_text(full_lift(i)/degree, digits)// &
               & ": a valve would be wide open within "//number_text(near_firing/degree, digits)//" degrees of the "// &
               & "firing of its cylinder, from which full lift counts in degrees of the crankshaft")
            exit
         end do
      end if
      if (.not. (is_known(settings, "engine", "cylinders") .and. is_known(settings, "cam_bearings", "cam_cylinders"))) return
      call take(settings, "engine", "cylinders", cylinders)
      call take(settings, "cam_bearings", "cam_cylinders", cylinders_of_cams)
      cams = [(count(cylinders_of_cams == i), i=1, cylinders)]
      idle = count(cams == 0)
      if (idle > 0) call add_line(remarks, "cam_bearings.cam_cylinders: "//counted(idle, "cylinder")//" of "// &
         & integer_text(cylinders)//" without a cam; torques and friction mean effective pressure are those of the others")
      if (idle == 0 .and. minval(cams) < maxval(cams)) call add_line(remarks, "cam_bearings.cam_cylinders: cylinder "// &
         & integer_text(minloc(cams, 1))//" has "//counted(minval(cams), "cam")//", cylinder "// &
         & integer_text(maxloc(cams, 1))//" has "//integer_text(maxval(cams))//"; is the list right?")
   end subroutine look_at_engine

   !> Temperatures of the oil without a law of its viscosity.
   subroutine look_at_temperature(settings, varied, remarks)
      type(settings_t), intent(in) :: settings
      !> Keys that vary
      character(len=*), intent(in) :: varied(:)
      !> Sentences so far
      type(line_t), allocatable, intent(inout) :: remarks(:)

      character(len=*), parameter :: key = "operating_point.oil_temperature_degC", users(*) = [character(len=17) :: "heat", &
         & "friction_modifier", "boundary_law", "tribofilm", "needle_drag", "shaft_drag"]
      character(len=:), allocatable :: words
      integer :: i

      if (any(varied == "lubricant.temperature_law") .or. get_word(settings, "lubricant", "temperature_law") /= "direct") return
      words = " varies "
      if (.not. any(varied == key)) then
         if (.not. allocated(settings%values(find_value(settings, "operating_point", "oil_temperature_degC"))%source)) return
         words = " is given beside the deck "
      end if
      call add_line(remarks, key//words//trim(merge("but not the oil's viscosity", "without effect             ", &
         & is_known(settings, "lubricant", "pressure_viscosity_points_per_GPa") .or. &
         & any([(has_group(settings, trim(users(i))), i=1, size(users))])))//": lubricant.temperature_law is 'direct', one "// &
         & "viscosity at all temperatures")
   end subroutine look_at_temperature

   !> Values of numbers, where all of them are there and something may be said of each.
   subroutine get(settings, left_out, keys, values, are_there)
      type(settings_t), intent(in) :: settings
      !> Keys of which nothing is said
      character(len=*), intent(in) :: left_out(:)
      !> Their names as `group.key`, single blanks between them
      character(len=*), intent(in) :: keys
      !> The first of them; 0 where not all are there [SI unit of each]
      real(wp), intent(out) :: values(:)
      !> Are they?
      logical, intent(out) :: are_there

      integer :: first, last, dot, i

      values = 0.0_wp
      are_there = .true.
      first = 1
      i = 0
      do while (first <= len(keys) .and. are_there)
         last = first + index(keys(first:)//" ", " ") - 2
         dot = first + index(keys(first:last), ".") - 1
         i = i + 1
         are_there = has_group(settings, keys(first:dot - 1)) .and. .not. any(left_out == keys(first:last))
         if (are_there) are_there = is_known(settings, keys(first:dot - 1), keys(dot + 1:last))
         if (are_there) call take(settings, keys(first:dot - 1), keys(dot + 1:last), values(i))
         first = last + 2
      end do
   end subroutine get

end module camroller_deck_sense
