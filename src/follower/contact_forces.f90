!> All forces in the contact at a given load, and their derivatives with respect to load, sliding speed and geometry.
!>
!> In: model, geometry, sliding speed, load. Out: `contact_t` and `slopes_t`. The load is found by `contact`.
module camroller_contact_forces
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_hertz, only : half_width
   use camroller_lubricant, only : mean_relative_viscosity
   use camroller_film, only : groups_t, film_line_t, new_film_line
   use camroller_load_share, only : share_t, share_change_t, share_load, improve_share, share_change
   use camroller_traction, only : film_pressure, newtonian_shear, eyring_shear, blunt_shear, limit_shear, mobilised_share, &
      & sliding_direction, rolling_resistance, resistance_speed_slope, law_newtonian, rolling_biboulet_houpert
   use camroller_needle, only : bearing_torque, bearing_torque_slope
   use camroller_needle_drag, only : drag_torque, drag_torque_slope
   implicit none
   private

   public :: contact_t, setting_t, parts_t, motion_t, slopes_t, set_speeds, prepare_contact, evaluate_contact, follow_contact, &
      & release_contact, film_groups

   !> State of the contact
   type :: contact_t
      !> Do cam and roller touch?
      logical :: is_touching
      !> Speed of the contact point over the cam and over the roller, V_c and V_f [m/s]
      real(wp) :: cam_surface_speed, roller_surface_speed
      !> Speed of the roller's surface in pure rolling, V_roll, and sliding speed, V_s [m/s]
      real(wp) :: rolling_speed, sliding_speed
      !> Mean surface speed, V_e [m/s]
      real(wp) :: entrainment_speed
      !> Spin of the roller; spin relative to the finger [rad/s]
      real(wp) :: roller_spin, relative_spin
      !> Normal load, W [N]
      real(wp) :: load
      !> Half width [m] and apparent area [m^2] of the contact
      real(wp) :: half_width, apparent_area
      !> Minimum and central film [m]
      real(wp) :: film_min, film_central
      !> Minimum film over composite roughness [-]
      real(wp) :: film_ratio
      !> Load carried by asperities, W_a [N], and their real contact area, A_r [m^2]
      real(wp) :: asperity_load, real_area
      !> Shear of the film over the part that the asperities leave, (1 - A_r/A_a) F_h [N]
      real(wp) :: shear
      !> Boundary friction that the asperities can bear, F_b, and the part that the slip mobilises, with its sign [N]
      real(wp) :: boundary_capacity, boundary_mobilised
      !> Rolling resistance of each surface, F_r, with the sign of the entrainment [N]
      real(wp) :: rolling_resistance
      !> Traction, F_t [N]; its slope over the sliding speed at constant load and film [N s/m]
      real(wp) :: traction, traction_slope
      !> Net tangential force on the roller, T' = F_t + F_r (2 R/r_R - 1) [N]
      real(wp) :: tangential_force
      !> Torque of the roller's bearing, T_B [N m]
      real(wp) :: bearing_torque
      !> Its part that the oil makes, whatever the load [N m]
      real(wp) :: bearing_drag
   end type contact_t

   !> What does not change with the load while the balance is sought
   type :: setting_t
      !> Film over the load at the entrainment speed
      type(film_line_t) :: line
      !> E' R L [N]
      real(wp) :: scale
      !> Mobilised part of the boundary friction [-]
      real(wp) :: mobilised
      !> Its derivative over the sliding speed [s/m]
      real(wp) :: mobilised_slope
      !> Torque of the roller's bearing over the load [m]
      real(wp) :: bearing_arm
      !> Relative change of the film ratio that may be the last where the load share is iterated again [-]
      real(wp) :: coarse
      !> Difference of sliding speeds that need not be resolved; zero: all are [m/s]
      real(wp) :: resolution
   end type setting_t

   !> Change of the film ratio that may be the last, over the root of the relative error that is good enough: its square is the
   !> error left, times a factor of a few [-]
   real(wp), parameter :: coarse_part = 0.3_wp

   !> What the slopes of the forces are made of, kept from their evaluation
   type :: parts_t
      !> Film and load share
      type(share_t) :: share
      !> Load over E' R L [-]
      real(wp) :: load_group
      !> Shear of the film after its limit, over all of the contact [N]
      real(wp) :: shear
      !> Derivative of that over the shear before the limit and over the limit [-], and over the sliding speed beside these [N s/m]
      real(wp) :: by_shear, by_limit, by_speed
      !> Shear before its limit [N], derivative over ln(pressure) [N] and over the sliding speed [N s/m]
      real(wp) :: free_shear, pressure_slope, speed_slope
      !> Logarithmic slopes of the rolling resistance over load and speed group [-]
      real(wp) :: rolling_load_slope, rolling_speed_slope
      !> 2 R/r_R - 1 [-]
      real(wp) :: rolling_part
   end type parts_t

   !> A direction in which a contact may move
   type :: motion_t
      !> Change of load, entrainment speed and equivalent radius, their logarithms [-]
      real(wp) :: load = 0.0_wp, entrainment = 0.0_wp, radius = 0.0_wp
      !> Change of sliding speed [m/s] and of the roller's spin relative to the finger [rad/s]
      real(wp) :: sliding_speed = 0.0_wp, relative_spin = 0.0_wp
   end type motion_t

   !> Changes that follow
   type :: slopes_t
      !> ln of the film ratio [-]
      real(wp) :: film_ratio
      !> Traction, rolling resistance, tangential force [N]
      real(wp) :: traction, rolling_resistance, tangential_force
      !> Torque of the roller's bearing [N m]
      real(wp) :: bearing_torque
   end type slopes_t

contains

   !> Speeds of the surfaces for a sliding speed.
   pure subroutine set_speeds(model, position, sliding_speed, contact)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> State of the contact: speeds
      type(contact_t), intent(inout) :: contact

      contact%cam_surface_speed = model%speed*position%surface_travel
      contact%rolling_speed = contact%cam_surface_speed
      if (model%has_exact_spin) contact%rolling_speed = model%speed*position%rolling_travel
      contact%sliding_speed = sliding_speed
      contact%roller_surface_speed = contact%cam_surface_speed - sliding_speed
      contact%entrainment_speed = contact%cam_surface_speed - 0.5_wp*sliding_speed
      contact%roller_spin = (contact%rolling_speed - sliding_speed)/model%roller_radius
      contact%relative_spin = contact%roller_spin - model%linkage%sense*position%finger_slope*model%speed
      contact%bearing_drag = 0.0_wp
      if (allocated(model%drag)) contact%bearing_drag = drag_torque(model%drag, contact%relative_spin)
   end subroutine set_speeds

   !> What the speeds alone decide.
   pure subroutine prepare_contact(model, position, contact, enough, setting, mobilised, resolution)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact; the speeds are set
      type(contact_t), intent(in) :: contact
      !> Relative error of the forces that is good enough [-]
      real(wp), intent(in) :: enough
      !> What does not change with the load
      type(setting_t), intent(out) :: setting
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> Difference of sliding speeds that need not be resolved; absent: none [m/s]
      real(wp), intent(in), optional :: resolution

      setting%resolution = 0.0_wp
      if (present(resolution)) setting%resolution = resolution
      setting%scale = model%modulus*position%equivalent_radius*model%contact_width
      setting%coarse = coarse_part*sqrt(enough)
      call new_film_line(setting%line, model%film_law, film_groups(model, position, contact), model%film_table)
      setting%mobilised = 0.0_wp
      setting%mobilised_slope = 0.0_wp
      if (present(mobilised)) then
         setting%mobilised = mobilised
      else if (allocated(model%boundary)) then
         if (model%boundary%is_set_valued) then
            setting%mobilised = sliding_direction(contact%sliding_speed)
         else
            associate (speed => model%boundary%mobilising_speed + setting%resolution)
               setting%mobilised = mobilised_share(contact%sliding_speed, speed)
               setting%mobilised_slope = (1.0_wp - setting%mobilised)*(1.0_wp + setting%mobilised)/speed
            end associate
         end if
      end if
      setting%bearing_arm = 0.0_wp
      if (allocated(model%bearing)) then
         setting%bearing_arm = bearing_torque(model%bearing%friction_coefficient, 1.0_wp, model%bearing%radius, &
            & contact%relative_spin, model%bearing%reversal_spin)
      end if
   end subroutine prepare_contact

   !> Dimensionless groups of the contact.
   pure function film_groups(model, position, contact) result(groups)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact; load and speeds are set
      type(contact_t), intent(in) :: contact
      !> The groups
      type(groups_t) :: groups

      groups%speed = model%oil%viscosity*abs(contact%entrainment_speed)/(model%modulus*position%equivalent_radius)
      groups%material = model%oil%pressure_viscosity*model%modulus
      groups%load = contact%load/(model%modulus*position%equivalent_radius*model%contact_width)
      groups%roughness = model%roughness/position%equivalent_radius
      groups%hardness = model%hardness/model%modulus
   end function film_groups

   !> Everything in the contact at a given load.
   pure subroutine evaluate_contact(model, position, setting, load, contact, parts, change)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> Normal load, W, positive [N]
      real(wp), intent(in) :: load
      !> State of the contact; the speeds are set, and the film ratio is that of a contact nearby or zero
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of
      type(parts_t), intent(out) :: parts
      !> Relative change of the film ratio that was made; its square is about the error left [-]
      real(wp), intent(out) :: change

      ! Part of the load group that the rolling law takes [-]
      real(wp) :: rolling_load

      contact%load = load
      contact%is_touching = .true.
      contact%half_width = half_width(load, position%equivalent_radius, model%contact_width, model%modulus)
      contact%apparent_area = 2.0_wp*contact%half_width*model%contact_width
      parts%load_group = load/setting%scale
      change = 0.0_wp
      if (allocated(model%boundary)) then
         call improve_share(setting%line, parts%load_group, parts%share, model%boundary%constants, &
            & contact%apparent_area/setting%scale, contact%film_ratio, change, setting%coarse)
      else
         call share_load(setting%line, parts%load_group, parts%share)
      end if
      contact%film_min = parts%share%film_min*position%equivalent_radius
      contact%film_central = parts%share%film_central*position%equivalent_radius
      contact%film_ratio = contact%film_min/model%roughness
      contact%asperity_load = min(max(0.0_wp, parts%share%asperity_load)*setting%scale, load)
      contact%real_area = parts%share%real_area_ratio*contact%apparent_area
      call set_traction(model, setting, contact, parts)

      rolling_load = parts%load_group
      if (model%rolling_law == rolling_biboulet_houpert) rolling_load = parts%share%film_load
      call rolling_resistance(model%rolling_law, setting%line%groups%speed, rolling_load, model%modulus, &
         & position%equivalent_radius, model%contact_width, model%oil%pressure_viscosity, contact%rolling_resistance, &
         & parts%rolling_load_slope)
      parts%rolling_speed_slope = resistance_speed_slope(model%rolling_law, parts%rolling_load_slope)
      contact%rolling_resistance = sign(contact%rolling_resistance, contact%entrainment_speed)
      parts%rolling_part = 2.0_wp*position%equivalent_radius/model%roller_radius - 1.0_wp
      contact%tangential_force = contact%traction + contact%rolling_resistance*parts%rolling_part
      contact%bearing_torque = setting%bearing_arm*load + contact%bearing_drag
   end subroutine evaluate_contact

   !> Shear of the film, boundary friction and their sum.
   pure subroutine set_traction(model, setting, contact, parts)
      !> The model
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> State of the contact; film and load share are set
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of; the load share is set
      type(parts_t), intent(inout) :: parts

      ! Pressure in the middle of the film [Pa]
      real(wp) :: peak
      ! Mean viscosity ratio and its logarithmic slope over the pressure [-]
      real(wp) :: viscosity, viscosity_slope
      ! Derivatives of the shear with a slip that is not resolved over that without, and over the limit [-]
      real(wp) :: by_free, by_limit

      peak = film_pressure(contact%load - contact%asperity_load, contact%apparent_area, contact%real_area)
      if (model%shear_law == law_newtonian) then
         call mean_relative_viscosity(model%oil, peak, viscosity, viscosity_slope)
         parts%speed_slope = newtonian_shear(1.0_wp, model%oil%viscosity*viscosity, contact%apparent_area, contact%film_central)
         parts%free_shear = parts%speed_slope*contact%sliding_speed
         parts%pressure_slope = parts%free_shear*viscosity_slope
      else
         call eyring_shear(contact%sliding_speed, model%oil, peak, contact%apparent_area, contact%film_central, &
            & model%eyring_stress, parts%free_shear, parts%speed_slope, parts%pressure_slope)
      end if
      parts%shear = parts%free_shear
      by_free = 1.0_wp
      by_limit = 0.0_wp
      parts%by_speed = 0.0_wp
      if (setting%resolution > 0.0_wp) then
         call blunt_shear(contact%sliding_speed, setting%resolution, model%limiting_coefficient*contact%load, parts%speed_slope, &
            & parts%shear, by_free, by_limit, parts%by_speed)
      end if
      call limit_shear(model%cap, model%limiting_coefficient*contact%load, parts%shear, parts%by_shear, parts%by_limit)
      parts%by_limit = parts%by_limit + parts%by_shear*by_limit
      parts%by_speed = parts%by_shear*parts%by_speed
      parts%by_shear = parts%by_shear*by_free

      contact%shear = parts%shear*(1.0_wp - parts%share%real_area_ratio)
      contact%traction = contact%shear
      contact%traction_slope = (parts%by_shear*parts%speed_slope + parts%by_speed)*(1.0_wp - parts%share%real_area_ratio)
      contact%boundary_capacity = 0.0_wp
      contact%boundary_mobilised = 0.0_wp
      if (.not. allocated(model%boundary)) return

      contact%boundary_capacity = model%boundary%film_shear_strength*contact%real_area &
         & + model%boundary%coefficient*contact%asperity_load
      contact%boundary_mobilised = contact%boundary_capacity*setting%mobilised
      contact%traction = contact%traction + contact%boundary_mobilised
      contact%traction_slope = contact%traction_slope + contact%boundary_capacity*setting%mobilised_slope
   end subroutine set_traction

   !> How the forces follow a motion of the contact.
   pure function follow_contact(model, setting, contact, parts, motion) result(slopes)
      !> The model
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> What slopes are made of
      type(parts_t), intent(in) :: parts
      !> Direction of the motion
      type(motion_t), intent(in) :: motion
      !> What follows
      type(slopes_t) :: slopes

      type(share_change_t) :: change
      ! Changes of apparent area, pressure in the film and rolling resistance, their logarithms [-]; of the shear [N]
      real(wp) :: area, pressure, rolling, shear

      change = share_change(setting%line, parts%load_group, parts%share, motion%load - motion%radius, &
         & motion%entrainment - motion%radius, motion%radius)
      slopes%film_ratio = change%film_min + motion%radius
      area = 0.5_wp*(motion%load + motion%radius)
      pressure = change%film_load + motion%radius - area + change%real_area_ratio/(1.0_wp - parts%share%real_area_ratio)
      shear = parts%free_shear*area + parts%pressure_slope*pressure + parts%speed_slope*(motion%sliding_speed &
         & - contact%sliding_speed*(change%film_central + motion%radius))
      shear = parts%by_shear*shear + parts%by_limit*model%limiting_coefficient*contact%load*motion%load &
         & + parts%by_speed*motion%sliding_speed
      slopes%traction = shear*(1.0_wp - parts%share%real_area_ratio) - parts%shear*change%real_area_ratio
      if (allocated(model%boundary)) then
         slopes%traction = slopes%traction + setting%mobilised*(model%boundary%film_shear_strength &
            & *(area*contact%real_area + contact%apparent_area*change%real_area_ratio) &
            & + model%boundary%coefficient*(change%asperity_load*setting%scale + motion%radius*contact%asperity_load)) &
            & + contact%boundary_capacity*setting%mobilised_slope*motion%sliding_speed
      end if

      rolling = motion%load - motion%radius
      if (model%rolling_law == rolling_biboulet_houpert) rolling = change%film_load
      rolling = motion%radius + parts%rolling_load_slope*rolling + parts%rolling_speed_slope*(motion%entrainment - motion%radius)
      slopes%rolling_resistance = contact%rolling_resistance*rolling
      slopes%tangential_force = slopes%traction + slopes%rolling_resistance*parts%rolling_part &
         & + contact%rolling_resistance*(parts%rolling_part + 1.0_wp)*motion%radius
      slopes%bearing_torque = (contact%bearing_torque - contact%bearing_drag)*motion%load
      if (allocated(model%drag)) slopes%bearing_torque = slopes%bearing_torque &
         & + motion%relative_spin*drag_torque_slope(model%drag, contact%relative_spin)
      if (allocated(model%bearing) .and. abs(motion%relative_spin) > 0.0_wp) then
         slopes%bearing_torque = slopes%bearing_torque + motion%relative_spin*bearing_torque_slope( &
            & model%bearing%friction_coefficient, contact%load, model%bearing%radius, contact%relative_spin, &
            & model%bearing%reversal_spin)
      end if
   end function follow_contact

   !> No contact: no force but the drag of the roller's bearing; the film is reported as zero, since there is none to speak of.
   pure subroutine release_contact(contact)
      !> State of the contact; the speeds are kept
      type(contact_t), intent(inout) :: contact

      contact%is_touching = .false.
      contact%load = 0.0_wp
      contact%half_width = 0.0_wp
      contact%apparent_area = 0.0_wp
      contact%film_min = 0.0_wp
      contact%film_central = 0.0_wp
      contact%film_ratio = 0.0_wp
      contact%asperity_load = 0.0_wp
      contact%real_area = 0.0_wp
      contact%shear = 0.0_wp
      contact%boundary_capacity = 0.0_wp
      contact%boundary_mobilised = 0.0_wp
      contact%rolling_resistance = 0.0_wp
      contact%traction = 0.0_wp
      contact%traction_slope = 0.0_wp
      contact%tangential_force = 0.0_wp
      contact%bearing_torque = contact%bearing_drag
   end subroutine release_contact

end module camroller_contact_forces
