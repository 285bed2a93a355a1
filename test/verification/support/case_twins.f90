!> Twins of a case: the same train in other units, or told in another way. Their results mean the same.
module case_twins
   use camroller_kinds, only : wp
   use camroller_case, only : case_t
   use camroller_dynamics, only : gas_force_t
   use camroller_lift, only : lift_t
   use camroller_result, only : find_quantity, result_t
   use camroller_sliding_friction, only : sliding_t
   use unit_systems, only : units_t, dimension_t, scaled, number, angular_speed, area, drag, force, inertia, length, mass, &
      & per_pressure, per_speed, pressure, speed, stiffness, torque, viscosity, conductivity, density, heat_capacity, &
      & temperature, per_temperature
   implicit none
   private

   public :: leave_constants_out, rescale_case, compare_twins, dimension_of_unit

contains

   !> Take laws that hold no constants with dimensions, in place of those that do: Roelands' and Cameron's reference pressure, the
   !> temperatures of Vogel's and Walther's oils, needles' drag, the range of numerical films, the usual place of the
   !> finger's centre of mass.
   subroutine leave_constants_out(case)
      !> The case
      type(case_t), intent(inout) :: case

      ! Of the order of engine oils when hot; oils of a data sheet have no points [Pa s]
      real(wp), parameter :: usual_viscosity = 1.0e-2_wp

      if (case%lubricant%temperature_law /= "direct") then
         case%lubricant%viscosity = usual_viscosity
         if (allocated(case%lubricant%viscosity_points)) case%lubricant%viscosity = case%lubricant%viscosity_points(2)
      end if
      case%lubricant%temperature_law = "direct"
      case%lubricant%pressure_law = "barus"
      if (.not. case%lubricant%pressure_viscosity > 0.0_wp) case%lubricant%pressure_viscosity = 2.0e-8_wp
      case%lubricant%roelands_index = 0.0_wp
      if (allocated(case%lubricant%pressure_viscosity_points)) deallocate (case%lubricant%pressure_viscosity_points)
      if (allocated(case%ehl)) deallocate (case%ehl)
      if (allocated(case%needle_drag)) deallocate (case%needle_drag)
      if (allocated(case%needle_bearing)) then
         if (case%needle_bearing%kind == "needles_skf") case%needle_bearing%kind = "needles"
      end if
      if (allocated(case%heat)) then
         if (.not. case%heat%viscosity_fall > 0.0_wp) case%heat%viscosity_fall = 0.04_wp
      end if
      ! What follows the temperature itself
      if (allocated(case%boundary_law)) then
         case%boundary_law%temperature_slope = 0.0_wp
         if (allocated(case%boundary_law%temperature_points)) then
            case%boundary_law%temperature_points = case%boundary_law%temperature_points(:1)
            case%boundary_law%coefficient_points = case%boundary_law%coefficient_points(:size(case%boundary_law%speed_points))
         end if
      end if
      if (allocated(case%tribofilm)) then
         ! Of the order of what a barrier leaves
         case%tribofilm%growth_rate = case%tribofilm%growth_rate*exp(-25.0_wp)
         case%tribofilm%activation_energy = 0.0_wp
      end if
      ! The usual place of the finger's centre of mass is in millimetres; this one is within every radius of gyration
      if (.not. case%masses%finger_centre > 0.0_wp) case%masses%finger_centre = 1.0e-3_wp
   end subroutine leave_constants_out

   !> The same case in other units.
   subroutine rescale_case(case, units)
      !> The case
      type(case_t), intent(inout) :: case
      !> The units
      type(units_t), intent(in) :: units

      call change(case%operating_point%speed, angular_speed)
      call change(case%mechanism%pivot_to_roller, length)
      call change(case%mechanism%pivot_to_pad, length)
      call change(case%mechanism%pivot_to_cam, length)
      call change(case%mechanism%base_radius, length)
      call change(case%mechanism%roller_radius, length)
      call change(case%mechanism%contact_width, length)
      call change(case%mechanism%grinding_wheel_radius, length)
      call change(case%roller%mass, mass)
      call change(case%roller%wall_thickness, length)
      call change_lift(case%lift)
      if (allocated(case%second_lift)) call change_lift(case%second_lift)
      call change(case%masses%valve, mass)
      call change(case%masses%finger, mass)
      call change(case%masses%finger_inertia, inertia)
      call change(case%masses%finger_centre, length)
      call change(case%spring%stiffness, stiffness)
      call change(case%spring%precompression, length)
      call change(case%spring%base_circle_load, force)
      call change(case%spring%seat_stiffness, stiffness)
      if (allocated(case%gas_force)) call change_gas(case%gas_force)
      call change(case%materials%cam_modulus, pressure)
      call change(case%materials%roller_modulus, pressure)
      call change(case%materials%hardness, pressure)
      call change(case%surface%cam_roughness, length)
      call change(case%surface%roller_roughness, length)
      call change(case%lubricant%viscosity, viscosity)
      call change(case%lubricant%pressure_viscosity, per_pressure)
      call change(case%traction%eyring_stress, pressure)
      call change(case%traction%limiting_stress, pressure)
      if (allocated(case%roller_profile)) then
         call change(case%roller_profile%crown_radius, length)
         call change(case%roller_profile%design_load, force)
         call change(case%roller_profile%end_drop, length)
      end if
      if (allocated(case%heat)) then
         call change(case%heat%oil_conductivity, conductivity)
         call change(case%heat%oil_heat_capacity, heat_capacity)
         call change(case%heat%viscosity_fall, per_temperature)
         call change(case%heat%limit_fall, per_temperature)
         call change(case%heat%conductivity, conductivity)
         call change(case%heat%density, density)
         call change(case%heat%heat_capacity, heat_capacity)
      end if
      if (allocated(case%asperity)) call change(case%asperity%film_shear_strength, pressure)
      if (allocated(case%asperity)) call change(case%asperity%mobilising_speed, speed)
      if (allocated(case%valve_guide)) call change(case%valve_guide%length, length)
      if (allocated(case%valve_guide)) call change(case%valve_guide%stem_diameter, length)
      if (allocated(case%valve_guide)) call change(case%valve_guide%radial_clearance, length)
      call change_surfaces()
      call change_joints()
      call change_flexible()
      call change_bearings()

   contains

      !> A number in other units.
      elemental subroutine change(value, dimension)
         !> The number [any]
         real(wp), intent(inout) :: value
         !> Its dimension
         type(dimension_t), intent(in) :: dimension

         value = scaled(units, value, dimension)
      end subroutine change

      !> Cylinder pressure and valves in other units.
      subroutine change_gas(gas)
         !> The pressure and its valves
         type(gas_force_t), intent(inout) :: gas

         call change(gas%pressure, pressure)
         call change(gas%valve_area, area)
         if (allocated(gas%second_valve_area)) call change(gas%second_valve_area, area)
      end subroutine change_gas

      !> Boundary friction, wear and films of surfaces in other units.
      subroutine change_surfaces()
         type(dimension_t), parameter :: time = dimension_t(0, 0, 1), per_time = dimension_t(0, 0, -1)

         if (allocated(case%boundary_law)) then
            call change(case%boundary_law%reference_speed, speed)
            call change(case%boundary_law%lowest_speed, speed)
            if (allocated(case%boundary_law%speed_points)) call change(case%boundary_law%speed_points, speed)
         end if
         if (allocated(case%wear)) call change(case%wear%cam_rate, per_pressure)
         if (allocated(case%wear)) call change(case%wear%roller_rate, per_pressure)
         if (allocated(case%tribofilm)) then
            call change(case%tribofilm%growth_rate, speed)
            call change(case%tribofilm%removal_rate, per_time)
            call change(case%tribofilm%largest_thickness, length)
         end if
         if (allocated(case%running_in)) call change(case%running_in%duration, time)
      end subroutine change_surfaces

      !> Bearings of roller and camshaft, and what comes on top of them, in other units.
      subroutine change_bearings()
         if (allocated(case%needle_bearing)) then
            call change(case%needle_bearing%needle_radius, length)
            call change(case%needle_bearing%film%width, length)
            call change(case%needle_bearing%film%radial_clearance, length)
            call change(case%needle_bearing%film%roughness, length)
            call change(case%needle_bearing%film%modulus, pressure)
         end if
         if (allocated(case%cam_bearings)) then
            call change(case%cam_bearings%diameter, length)
            call change(case%cam_bearings%width, length)
            call change(case%cam_bearings%radial_clearance, length)
            call change(case%cam_bearings%bearing_positions, length)
            call change(case%cam_bearings%cam_positions, length)
         end if
         if (allocated(case%bearing_asperity)) call change(case%bearing_asperity%roughness, length)
         if (allocated(case%bearing_asperity)) call change(case%bearing_asperity%modulus, pressure)
         if (allocated(case%belt_pull)) call change(case%belt_pull%force, force)
         if (allocated(case%belt_pull)) call change(case%belt_pull%position, length)
         if (allocated(case%shaft_drag)) call change(case%shaft_drag%speed_points, angular_speed)
         if (allocated(case%shaft_drag)) call change(case%shaft_drag%torque_points, torque)
      end subroutine change_bearings

      !> The sliding joints in other units.
      subroutine change_joints()
         if (allocated(case%valve_tip)) call change(case%valve_tip%pad_radius, length)
         if (allocated(case%valve_tip)) call change_sliding(case%valve_tip%sliding)
         if (allocated(case%finger_pivot)) call change(case%finger_pivot%ball_radius, length)
         if (allocated(case%finger_pivot)) call change_sliding(case%finger_pivot%sliding)
         if (allocated(case%guide_side_load)) then
            call change(case%guide_side_load%guide_length, length)
            call change(case%guide_side_load%tip_height, length)
            call change(case%guide_side_load%stem_axis, length)
            call change_sliding(case%guide_side_load%sliding)
         end if
         if (allocated(case%stem_seal)) then
            call change(case%stem_seal%lip_force, force)
            call change(case%stem_seal%viscous_drag, drag)
            call change(case%stem_seal%reference_viscosity, viscosity)
            call change(case%stem_seal%reversal_speed, speed)
         end if
      end subroutine change_joints

      !> A flexible train in other units; in an adjuster the pressure of the surroundings stays as it is.
      subroutine change_flexible()
         if (allocated(case%dynamics)) then
            call change(case%dynamics%finger_stiffness, stiffness)
            call change(case%dynamics%contact_damping, per_speed)
            call change(case%dynamics%pad_stiffness, stiffness)
            call change(case%dynamics%pad_damping, per_speed)
            call change(case%dynamics%seat_stiffness, stiffness)
            call change(case%dynamics%seat_damping, per_speed)
            call change(case%dynamics%seat_restitution_speed, speed)
            call change(case%dynamics%lash, length)
         end if
         if (allocated(case%spring_surge)) call change(case%spring_surge%mass, mass)
         if (.not. allocated(case%lash_adjuster)) return
         associate (adjuster => case%lash_adjuster)
            call change(adjuster%diameter, length)
            call change(adjuster%volume, dimension_t(3, 0, 0))
            call change(adjuster%gap, length)
            call change(adjuster%leak_length, length)
            call change(adjuster%plunger_mass, mass)
            call change(adjuster%spring_stiffness, stiffness)
            call change(adjuster%spring_force, force)
            call change(adjuster%check_area, area)
            call change(adjuster%crack_pressure, pressure)
            call change(adjuster%full_pressure, pressure)
            call change(adjuster%transition_pressure, pressure)
            call change(adjuster%supply_pressure, pressure)
            call change(adjuster%oil_modulus, pressure)
            call change(adjuster%density, density)
            call change(adjuster%lowest, length)
            call change(adjuster%highest, length)
            call change(adjuster%stop_stiffness, stiffness)
            call change(adjuster%stop_damping, per_speed)
         end associate
      end subroutine change_flexible

      !> A coefficient of friction in other units.
      subroutine change_sliding(sliding)
         !> The coefficient
         type(sliding_t), intent(inout) :: sliding

         call change(sliding%decay_speed, speed)
         call change(sliding%viscous_part, per_speed)
         call change(sliding%reference_viscosity, viscosity)
         call change(sliding%reference_load, force)
         call change(sliding%reversal_speed, speed)
      end subroutine change_sliding

      !> A lift in other units.
      subroutine change_lift(lift)
         !> The lift
         type(lift_t), intent(inout) :: lift

         call change(lift%max_lift, length)
         call change(lift%smoothing, length)
         if (allocated(lift%table_lift)) call change(lift%table_lift, length)
      end subroutine change_lift

   end subroutine rescale_case

   !> Do two results mean the same, one of them in other units? By the units that the result itself names.
   function compare_twins(one, other, units, allowed) result(trouble)
      !> Result in SI, result in other units
      type(result_t), intent(in) :: one, other
      !> The units
      type(units_t), intent(in) :: units
      !> Difference allowed, over the largest value of a series [-]
      real(wp), intent(in) :: allowed
      !> What is wrong; blank where all is well
      character(len=:), allocatable :: trouble
      ! Difference, largest value, largest friction torque [unit of the series]
      real(wp) :: found, largest, friction
      character(len=12) :: buffer
      integer :: i

      trouble = ""
      if (size(one%series) /= size(other%series) .or. size(one%summary) /= size(other%summary)) trouble = "other quantities"
      if (trouble /= "") return
      friction = maxval(abs(one%series_values(:, find_quantity(one%series, "torque_friction"))))
      do i = 1, size(one%series)
         if (one%series(i)%name == "energy_residual") cycle
         largest = maxval(abs(one%series_values(:, i)))
         ! What spins the roller up is the difference of the torques on it, which at low speed are far larger
         if (index(one%series(i)%name, "torque_roller_inertia") > 0) largest = max(largest, friction)
         associate (dimension => dimension_of_unit(one%series(i)%unit))
            found = maxval(abs(scaled(units, one%series_values(:, i), dimension) - other%series_values(:, i))) &
               & /max(scaled(units, largest, dimension), tiny(1.0_wp))
         end associate
         write (buffer, "(es9.2)") found
         if (.not. found <= allowed) trouble = trouble//" "//one%series(i)%name//buffer
      end do
   end function compare_twins

   !> Dimension of a unit as results name it.
   pure function dimension_of_unit(unit) result(dimension)
      !> The unit
      character(len=*), intent(in) :: unit
      !> Its dimension
      type(dimension_t) :: dimension
      character(len=*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
      character(len=:), allocatable :: rest, word
      type(dimension_t) :: one
      integer :: last, power, status

      dimension = number
      rest = trim(unit)
      do while (rest /= "")
         last = index(rest//" ", " ")
         word = rest(:last - 1)
         rest = adjustl(rest(min(last, len(rest) + 1):))
         last = verify(word, letters)
         power = 1
         if (last > 1) then
            read (word(last:), *, iostat=status) power
            if (status /= 0) power = 100
            word = word(:last - 1)
         end if
         select case (word)
         case ("m")
            one = length
         case ("kg")
            one = mass
         case ("s")
            one = dimension_t(0, 0, 1)
         case ("N")
            one = force
         case ("Pa")
            one = pressure
         case ("J")
            one = dimension_t(2, 1, -2)
         case ("W")
            one = dimension_t(2, 1, -3)
         case ("K")
            one = temperature
         case ("1", "rad", "deg", "degree")
            one = number
         case default
            one = dimension_t(100, 100, 100)
         end select
         dimension = dimension_t(dimension%length + power*one%length, dimension%mass + power*one%mass, &
            & dimension%time + power*one%time, dimension%temperature + power*one%temperature)
      end do
   end function dimension_of_unit

end module case_twins
