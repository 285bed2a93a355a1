!> Series of parts: of heat in the contact, of surfaces that wear, of the contact along the roller, of single camshaft bearings.
!>
!> In: a case, state of the follower, states of its bearings. Out: how many series of bearings there are, and the series.
module camroller_part_series
   use camroller_kinds, only : wp, two_pi
   use camroller_axial_film, only : smallest_film
   use camroller_axial_loads, only : solved_loads
   use camroller_axial_table, only : axial_state_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_boundary_law, only : given_coefficients
   use camroller_cam_surface, only : value_at_angle
   use camroller_case, only : camshaft_number, case_t
   use camroller_contact_forces, only : film_groups
   use camroller_effect_list, only : effect_contact_heat, effect_inlet_heat, has_effect
   use camroller_film, only : film_line_t, new_film_line
   use camroller_hertz, only : peak_pressure
   use camroller_materials, only : combined_roughness
   use camroller_model, only : model_t
   use camroller_needle, only : kind_journal, roller_bearing_names
   use camroller_number_text, only : integer_text
   use camroller_pin_film, only : pin_state_t, solve_pin
   use camroller_result, only : quantity_list_t, add => append_quantity, scope_camshaft
   use camroller_shaft, only : has_orbits
   use camroller_state, only : state_t
   use camroller_wear, only : largest_shear, orthogonal_shear, sliding_distance, time_in_contact, worn_per_second
   implicit none
   private

   public :: add_asperities, add_axial, add_axial_film, add_heat, add_pin, add_surfaces, add_bearings, bearing_count, &
      & bearing_series_count, largest_pressure, least_force, least_share, load_part, thinnest_film

   !> Part of a friction or a load that counts as none [-]: coefficients of friction are known to two digits
   real(wp), parameter :: least_share = 1.0e-6_wp
   !> Force that counts as none, of asperities and of friction in joints: so small a part of a newton [N]; area of asperities that
   !> bear it with 1 GPa [m^2]
   real(wp), parameter :: least_force = least_share, least_area = 1.0e-9_wp*least_force
   !> Wear that counts as none: less than an atom in ten thousand million turns [m], or in three hundred years [m/s]
   real(wp), parameter :: least_wear = 1.0e-20_wp, least_wear_rate = 1.0e-20_wp
   !> What the name of a series of the first part of the load on a bearing ends with; that of the second part follows it
   character(len=*), parameter :: load_part = "load_x"

contains

   !> The smallest film along the roller.
   pure subroutine add_axial_film(list, model, state, along)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> What matters of the load along the roller; zero all over without contact
      type(axial_state_t), intent(out) :: along

      real(wp) :: film ! [m]

      film = 0.0_wp
      along = axial_state_t(0.0_wp, 0.0_wp, [0.0_wp, 0.0_wp])
      if (allocated(model%axial) .and. state%contact%is_touching) then
         along = state%along
         film = thinnest_film(model, state)
      end if
      call add(list, "film_thickness_axial_min", "m", "smallest minimum film along the roller", "roller_profile", film)
   end subroutine add_axial_film

   !> Smallest film of a contact: where along the roller the load is largest.
   pure function thinnest_film(model, state) result(film)
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower, in contact
      type(state_t), intent(in) :: state
      !> The film [m]
      real(wp) :: film

      type(film_line_t) :: line

      film = state%contact%film_min
      if (.not. allocated(model%axial)) return
      call new_film_line(line, model%film_law, film_groups(model, state%position, state%contact), model%film_table)
      line%log_factor = log(state%contact%inlet_factor)
      film = smallest_film(line, state%along%peak*state%contact%load/model%contact_width, state%position%equivalent_radius, &
         & model%modulus, model%boundary)
   end function thinnest_film

   !> Largest pressure of the dry contact: in the middle of its width, and where along the roller the load is largest.
   pure function largest_pressure(model, state) result(pressure)
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> The pressure; zero without contact [Pa]
      real(wp) :: pressure

      pressure = 0.0_wp
      if (.not. state%contact%is_touching) return
      associate (contact => state%contact, radius => state%position%equivalent_radius)
         if (allocated(model%axial)) then
            pressure = peak_pressure(state%along%peak*contact%load/model%contact_width, radius, 1.0_wp, model%modulus)
         else
            pressure = peak_pressure(contact%load, radius, contact%length, model%modulus)
         end if
      end associate
   end function largest_pressure

   !> What asperities carry.
   pure subroutine add_asperities(list, case, state)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> State of the follower
      type(state_t), intent(in) :: state

      call add(list, "asperity_load", "N", "load carried by asperities", "asperity", state%contact%asperity_load, least=least_force)
      call add(list, "real_contact_area", "m2", "contact area of the asperities", "asperity", state%contact%real_area, &
         & least=least_area)
      if (allocated(case%boundary_law) .or. allocated(case%tribofilm)) call add(list, "boundary_coefficient", "1", &
         & "friction coefficient of the asperities", "asperity", state%contact%boundary_coefficient, &
         & least=largest_coefficient_change(case))
   end subroutine add_asperities

   !> Series of heat in the contact.
   pure subroutine add_heat(list, case, state)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case, with heat of its contact
      type(case_t), intent(in) :: case
      !> State of the follower
      type(state_t), intent(in) :: state

      if (has_effect(case, effect_inlet_heat)) call add(list, "inlet_heat_factor", "1", "factor on the film by heat in its inlet", &
         & "heat", state%contact%inlet_factor)
      if (has_effect(case, effect_contact_heat)) then
         call add(list, "film_temperature_rise", "K", "mean temperature of the film above that of the oil", "heat", &
            & state%contact%film_rise)
         call add(list, "flash_temperature_rise", "K", "mean temperature of both surfaces above that of the oil", "heat", &
            & state%contact%flash_rise)
      end if
   end subroutine add_heat

   !> Series of wear, and of surfaces after hours of running: at each cam angle those of the place on the cam that is in contact.
   pure subroutine add_surfaces(list, case, model, state)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> The model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state

      ! Peak pressure [Pa]; turn of the cam [s]; thickness, depth [m] and slope [m/rad]
      real(wp) :: peak, period, film, depth, slope
      ! What a film can change at most of its thickness and of the roughness [m]
      real(wp) :: largest, rough

      film = 0.0_wp
      depth = 0.0_wp
      period = 0.0_wp
      if (model%speed > 0.0_wp) period = two_pi/model%speed
      associate (contact => state%contact)
         if (allocated(case%wear)) then
            peak = largest_pressure(model, state)
            call add(list, "subsurface_shear_stress", "Pa", "largest shear stress below the surface, without traction", "wear", &
               & largest_shear*peak)
            call add(list, "orthogonal_shear_stress", "Pa", "largest shear stress along the surface below it, without traction", &
               & "wear", orthogonal_shear*peak)
            call add(list, "sliding_distance", "m", "distance that the roller slides over the place on the cam in a passage", &
               & "wear", sliding_distance(contact%half_width, contact%sliding_speed, contact%cam_surface_speed, period))
            call add(list, "cam_wear_per_turn", "m", "depth worn away from the place on the cam in a turn", "wear", period &
               & *time_in_contact(contact%half_width, contact%cam_surface_speed, period)*worn_per_second(case%wear%cam_rate, &
               & contact%asperity_load, contact%apparent_area, contact%sliding_speed), least=least_wear)
            call add(list, "roller_wear_rate", "m s-1", "rate at which the roller becomes thinner all round", "wear", &
               & contact%half_width/(0.5_wp*two_pi*model%roller_radius)*worn_per_second(case%wear%roller_rate, &
               & contact%asperity_load, contact%apparent_area, contact%sliding_speed), least=least_wear_rate)
         end if
         if (.not. allocated(case%running_in)) return
         ! Errors are relative to what a film can change at most
         largest = 0.0_wp
         rough = 0.0_wp
         if (allocated(case%tribofilm)) then
            largest = case%tribofilm%largest_thickness
            associate (bare => combined_roughness(case%surface%cam_roughness, case%surface%roller_roughness), &
               & most => case%tribofilm%roughness_ratio*largest)
               rough = norm2([bare, most, most]) - bare
            end associate
         end if
         if (allocated(model%surface)) then
            call value_at_angle(model%surface%film_curve, state%position%angle, film, slope)
            call value_at_angle(model%surface%wear_curve, state%position%angle, depth, slope)
         end if
         call add(list, "composite_roughness", "m", "composite roughness of cam and roller with their films", "running_in", &
            & contact%surfaces%roughness, least=rough)
         if (allocated(case%tribofilm)) call add(list, "cam_film_thickness", "m", "thickness of the tribofilm on the cam", &
            & "running_in", film, least=largest)
         if (allocated(case%wear)) call add(list, "cam_wear_depth", "m", "depth worn away from the cam", "running_in", depth)
      end associate
   end subroutine add_surfaces

   !> What a tribofilm that grows over hours can change of the asperities' coefficient at most: the scale of its errors.
   pure function largest_coefficient_change(case) result(change)
      type(case_t), intent(in) :: case
      !> The change; zero without such a film [-]
      real(wp) :: change

      real(wp), allocatable :: bare(:) ! [-]

      change = 0.0_wp
      if (.not. (allocated(case%tribofilm) .and. allocated(case%running_in) .and. allocated(case%asperity))) return
      bare = [case%asperity%boundary_coefficient]
      if (allocated(case%boundary_law)) bare = given_coefficients(case%boundary_law, case%asperity%boundary_coefficient)
      change = maxval(abs(case%tribofilm%coefficient - bare))
   end function largest_coefficient_change

   !> Series of a roller's pin with an oil film.
   pure subroutine add_pin(list, case, model, state)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case, with a bearing of its roller
      type(case_t), intent(in) :: case
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state

      type(pin_state_t) :: pin

      if (case%needle_bearing%kind /= roller_bearing_names(kind_journal)) return
      if (allocated(model%bearing)) call solve_pin(model%bearing%film, state%contact%load, state%contact%relative_spin, &
         & model%bearing%reversal_spin, pin)
      call add(list, "pin_eccentricity", "1", "eccentricity of the roller on its pin relative to the radial clearance", &
         & "needle_bearing", pin%eccentricity)
      call add(list, "pin_film_min", "m", "smallest film between roller and pin", "needle_bearing", pin%film)
      call add(list, "pin_asperity_share", "1", "load of the asperities along the line of centres relative to the pin's load", &
         & "needle_bearing", pin%asperity_share, least=least_share)
   end subroutine add_pin

   !> Series of the contact along the roller.
   pure subroutine add_axial(list, case, model, state, along)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case, with a profile of its roller
      type(case_t), intent(in) :: case
      !> The model of its lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> What matters of the load along the roller
      type(axial_state_t), intent(in) :: along

      ! Loads per length, in the mean [N/m] and of the slices over that [-]; largest pressure, that at the ends [Pa]
      real(wp) :: mean, pressure, edge_pressure
      real(wp), allocatable :: loads(:)
      character(len=:), allocatable :: name, words
      integer :: i

      allocate (loads(case%roller_profile%slices), source=0.0_wp)
      mean = 0.0_wp
      pressure = 0.0_wp
      edge_pressure = 0.0_wp
      if (allocated(model%axial) .and. state%contact%is_touching) then
         mean = state%contact%load/model%contact_width
         pressure = largest_pressure(model, state)
         edge_pressure = peak_pressure(maxval(along%ends)*mean, state%position%equivalent_radius, 1.0_wp, model%modulus)
         if (case%roller_profile%slice_series) call solved_loads(model%axial, state%contact%load, &
            & state%position%equivalent_radius, loads)
      end if
      call add(list, "effective_contact_length", "m", "length of the line contact that stands for the roller; zero without "// &
         & "contact", "roller_profile", merge(state%contact%length, 0.0_wp, state%contact%is_touching))
      call add(list, "axial_pressure_max", "Pa", "largest pressure along the roller, dry contact", "roller_profile", pressure)
      call add(list, "axial_pressure_place", "m", "where along the roller the largest pressure is, from its middle", &
         & "roller_profile", along%place, least=case%mechanism%contact_width)
      call add(list, "edge_pressure", "Pa", "pressure at the end with the larger one, dry contact", "roller_profile", edge_pressure)
      call add(list, "line_load_negative_end", "N m-1", "load per length at the end at negative places", "roller_profile", &
         & mean*along%ends(1), least=closed_load(case))
      call add(list, "line_load_positive_end", "N m-1", "load per length at the end at positive places", "roller_profile", &
         & mean*along%ends(2), least=closed_load(case))
      if (.not. case%roller_profile%slice_series) return
      name = ""
      words = ""
      do i = 1, size(loads)
         if (allocated(list%items)) then
            name = "line_load_"//integer_text(i)
            words = "load per length of slice "//integer_text(i)//", from the negative end"
         end if
         call add(list, name, "N m-1", words, "roller_profile", mean*loads(i), least=closed_load(case))
      end do
   end subroutine add_axial

   !> Load per length of an even contact with the valve closed, on the base circle or by its spring: a slice that is loaded for a
   !> moment alone begins and ends with kinks, and errors are not relative to its own small mean.
   pure function closed_load(case) result(load)
      type(case_t), intent(in) :: case
      !> The load per length [N/m]
      real(wp) :: load

      load = max(case%spring%base_circle_load, case%spring%stiffness*case%spring%precompression)/case%mechanism%contact_width
   end function closed_load

   !> Number of bearings of each camshaft that have series of their own.
   pure function bearing_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      count = 0
      if (.not. allocated(case%cam_bearings)) return
      if (case%cam_bearings%by_bearing) count = size(case%cam_bearings%bearing_positions)
   end function bearing_count

   !> Number of series of single bearings: the last ones of the camshafts.
   pure function bearing_series_count(case) result(count)
      !> The case
      type(case_t), intent(in) :: case
      !> The number
      integer :: count

      type(quantity_list_t) :: list

      count = 0
      if (bearing_count(case) == 0) return
      allocate (list%values(0))
      call add_bearings(list, case)
      count = list%count
   end function bearing_series_count

   !> Series of all bearings, one camshaft after the other.
   pure subroutine add_bearings(list, case, states)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      !> The case
      type(case_t), intent(in) :: case
      !> State of each, shape (bearing, camshaft); zero all over where it is not given
      type(bearing_state_t), intent(in), optional :: states(:, :)

      type(bearing_state_t) :: state
      integer :: bearing, shaft

      do shaft = 1, camshaft_number(case)
         do bearing = 1, bearing_count(case)
            if (present(states)) state = states(bearing, shaft)
            if (camshaft_number(case) > 1) then
               call add_bearing(list, case, state, bearing, shaft)
            else
               call add_bearing(list, case, state, bearing)
            end if
         end do
      end do
   end subroutine add_bearings

   !> Series of one bearing.
   pure subroutine add_bearing(list, case, state, bearing, shaft)
      !> List to extend
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      !> State of the bearing
      type(bearing_state_t), intent(in) :: state
      !> Its number on the shaft, from 1
      integer, intent(in) :: bearing
      !> Camshaft, where there are several
      integer, intent(in), optional :: shaft

      character(len=:), allocatable :: name, words, scope

      ! Words are made only where names are wanted: rows of values are many
      if (allocated(list%items)) then
         scope = "bearing "//integer_text(bearing)
         name = "bearing_"//integer_text(bearing)//"_"
         words = ", bearing "//integer_text(bearing)
         if (present(shaft)) then
            scope = scope_camshaft//" "//integer_text(shaft)//" "//scope
            name = "camshaft_"//integer_text(shaft)//"_"//name
            words = words//" of camshaft "//integer_text(shaft)
         end if
      end if
      call append(list, "load", "N", "force of the shaft", "cam_bearings", norm2(state%load))
      call append(list, load_part, "N", "part of the force along the line from the first follower's pivot to the cam's centre", &
         & "cam_bearings", state%load(1))
      call append(list, "load_y", "N", "part of the force across that, positive the way a finger turns as it opens its valve", &
         & "cam_bearings", state%load(2))
      call append(list, "eccentricity", "1", "eccentricity of the journal relative to the radial clearance", "cam_bearings", &
         & state%eccentricity)
      if (has_orbits(case)) then
         call append(list, "eccentricity_x", "1", "part of the eccentricity along the line from the first follower's pivot to "// &
            & "the cam's centre", "cam_bearings", state%place(1))
         call append(list, "eccentricity_y", "1", "part of the eccentricity across that, positive the way a finger turns as it "// &
            & "opens its valve", "cam_bearings", state%place(2))
      end if
      call append(list, "film_min", "m", "smallest film", "cam_bearings", state%film)
      call append(list, "torque", "N m", "friction torque", "cam_bearings", state%torque)
      if (allocated(case%bearing_heat)) then
         call append(list, "temperature_rise", "K", "mean temperature of the oil above that supplied", "bearing_heat", &
            & state%temperature_rise)
         call append(list, "oil_flow", "m3 s-1", "oil that leaves at the sides", "bearing_heat", state%oil_flow)
      end if
      if (.not. allocated(case%bearing_asperity)) return
      call append(list, "film_ratio", "1", "smallest film relative to roughness", "bearing_asperity", &
         & state%film/case%bearing_asperity%roughness)
      call append(list, "asperity_load", "N", "part of the load carried by asperities along the line of centres", &
         & "bearing_asperity", state%asperity_load)
      call append(list, "torque_boundary", "N m", "part of the friction torque due to asperities", "bearing_asperity", &
         & state%boundary_torque)

   contains

      !> Append a series.
      pure subroutine append(list, quantity, unit, meaning, source, value)
         !> List to extend
         type(quantity_list_t), intent(inout) :: list
         !> What it is of the bearing, its unit, meaning, part of the model
         character(len=*), intent(in) :: quantity, unit, meaning, source
         !> Value [unit of the series]
         real(wp), intent(in) :: value

         if (allocated(list%items)) then
            call add(list, name//quantity, unit, meaning//words, source, value, scope)
         else
            call add(list, "", "", "", "", value)
         end if
      end subroutine append

   end subroutine add_bearing

end module camroller_part_series
