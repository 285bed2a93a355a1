!> All forces in the contact at a given load, and their derivatives with respect to load, sliding speed and geometry.
!>
!> In: model, geometry, sliding speed, load. Out: `contact_t` and `slopes_t`. The load is found by `contact`.
module camroller_contact_forces
   use camroller_kinds, only : wp
   use camroller_axial_table, only : effective_lengths
   use camroller_cam_surface, only : meet_surfaces
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_contact_state, only : contact_t, setting_t, parts_t, motion_t, slopes_t, length_changes, release_contact
   use camroller_contact_traction, only : set_traction, follow_traction
   use camroller_heat, only : inlet_factor
   use camroller_hertz, only : half_width, peak_pressure
   use camroller_film, only : groups_t, new_film_line, takes_whole_load
   use camroller_load_share, only : share_change_t, share_load, improve_share, share_change
   use camroller_traction, only : mobilised_share, sliding_direction, rolling_resistance, resistance_speed_slope, &
      & resistance_length_slope, rolling_biboulet_houpert, line_lengths_t, same_lengths
   use camroller_needle, only : bearing_torque, bearing_torque_slope, loaded_torque
   use camroller_needle_drag, only : drag_torque, drag_torque_slope, drag_torque_by_reversal
   use camroller_pin_film, only : unloaded_torque
   implicit none
   private

   public :: contact_t, setting_t, parts_t, motion_t, slopes_t, set_speeds, start_heat, prepare_contact, evaluate_contact, &
      & follow_contact, release_contact, film_groups, law_part, set_surfaces, has_curved_bearing, has_oil_drag, oil_drag_slope, &
      & bearing_by_reversal, bearing_slope, find_bearing_torque, set_bearing_drag

   !> Change of the film ratio that may be the last, over the root of the relative error that is good enough: its square is the
   !> error left, times a factor of a few [-]
   real(wp), parameter :: coarse_part = 0.3_wp

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
      contact%length = model%contact_width
      call set_surfaces(model, position, contact)
      contact%relative_spin = contact%roller_spin - model%linkage%sense*position%finger_slope*model%speed
      if (allocated(model%heat)) call start_heat(model, contact)
      call set_bearing_drag(model, contact)
   end subroutine set_speeds

   !> Torque of the oil in the roller's bearing that does not depend on the load.
   pure subroutine set_bearing_drag(model, contact)
      !> The model
      type(model_t), intent(in) :: model
      !> In: spin relative to the finger; out: with the torque
      type(contact_t), intent(inout) :: contact

      contact%bearing_drag = oil_drag(model, contact%relative_spin)
   end subroutine set_bearing_drag

   !> Torque of the roller's bearing that the oil makes in it, whatever the load.
   pure function oil_drag(model, spin) result(torque)
      type(model_t), intent(in) :: model
      !> Spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: spin
      !> Torque [N m]
      real(wp) :: torque

      torque = 0.0_wp
      if (allocated(model%drag)) torque = drag_torque(model%drag, spin)
      if (has_pin_film(model)) torque = unloaded_torque(model%bearing%film)*spin
   end function oil_drag

   !> Whole torque of the roller's bearing under a load.
   pure subroutine find_bearing_torque(model, load, spin, torque, by_load)
      !> The model
      type(model_t), intent(in) :: model
      !> Load [N], spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: load, spin
      !> Torque [N m], its derivative over the load [m]
      real(wp), intent(out) :: torque, by_load

      ! Part of the load [N m], its slopes that are not wanted
      real(wp) :: part, by_spin, by_reversal

      torque = oil_drag(model, spin)
      by_load = 0.0_wp
      if (.not. allocated(model%bearing)) return
      if (has_curved_bearing(model)) then
         if (.not. load > 0.0_wp) return
         call loaded_torque(model%bearing, load, spin, part, by_load, by_spin, by_reversal)
         by_load = by_load/load
      else
         by_load = bearing_torque(model%bearing%friction_coefficient, 1.0_wp, model%bearing%radius, spin, &
            & model%bearing%reversal_spin)
         part = by_load*max(load, 0.0_wp)
      end if
      torque = torque + part
   end subroutine find_bearing_torque

   !> Does the roller turn on a pin with an oil film?
   pure function has_pin_film(model) result(has)
      type(model_t), intent(in) :: model
      !> Does it?
      logical :: has

      has = allocated(model%bearing)
      if (has) has = allocated(model%bearing%film)
   end function has_pin_film

   !> Are torque and load of the roller's bearing not in proportion?
   pure function has_curved_bearing(model) result(has)
      !> The model
      type(model_t), intent(in) :: model
      !> Are they not?
      logical :: has

      has = allocated(model%bearing)
      if (has) has = allocated(model%bearing%film) .or. allocated(model%bearing%skf)
   end function has_curved_bearing

   !> Does the oil in the roller's bearing hold the roller without load too?
   pure function has_oil_drag(model) result(has)
      !> The model
      type(model_t), intent(in) :: model
      !> Does it?
      logical :: has

      has = allocated(model%drag) .or. has_pin_film(model)
   end function has_oil_drag

   !> Derivative of the torque that this oil makes, whatever the load, over the roller's spin relative to the finger.
   pure function oil_drag_slope(model, spin) result(slope)
      !> The model
      type(model_t), intent(in) :: model
      !> Spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: spin
      !> Derivative [N m s/rad]
      real(wp) :: slope

      slope = 0.0_wp
      if (allocated(model%drag)) slope = drag_torque_slope(model%drag, spin)
      if (has_pin_film(model)) slope = unloaded_torque(model%bearing%film)
   end function oil_drag_slope

   !> Derivative of the load's part of the bearing's torque over that spin.
   pure function bearing_slope(model, load, spin) result(slope)
      !> The model, with a bearing
      type(model_t), intent(in) :: model
      !> Load [N], spin of the roller relative to the finger [rad/s]
      real(wp), intent(in) :: load, spin
      !> Derivative [N m s/rad]
      real(wp) :: slope

      ! Torque and its derivatives over the logarithms of load and reversal spin [N m]
      real(wp) :: torque, by_load, by_reversal

      if (has_curved_bearing(model)) then
         call loaded_torque(model%bearing, load, spin, torque, by_load, slope, by_reversal)
      else
         slope = bearing_torque_slope(model%bearing%friction_coefficient, load, model%bearing%radius, spin, &
            & model%bearing%reversal_spin)
      end if
   end function bearing_slope

   !> Roughness of the surfaces that meet, and what covers them.
   pure subroutine set_surfaces(model, position, contact)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact: surfaces
      type(contact_t), intent(inout) :: contact

      if (allocated(model%surface)) then
         call meet_surfaces(model%surface, position%angle, model%roughness, contact%surfaces)
      else
         contact%surfaces%roughness = model%roughness
      end if
   end subroutine set_surfaces

   !> Heat of a contact without load: no temperature, and the factor that a film has there.
   pure subroutine start_heat(model, contact)
      !> The model, with heat
      type(model_t), intent(in) :: model
      !> State of the contact; the speeds are set
      type(contact_t), intent(inout) :: contact

      ! Logarithm of the factor, its slopes [any]
      real(wp) :: log_factor, unused(3)

      contact%film_rise = 0.0_wp
      contact%flash_rise = 0.0_wp
      call inlet_factor(model%heat%inlet_law, model%heat%loading, contact%entrainment_speed, contact%sliding_speed, 0.0_wp, &
         & log_factor, unused(1), unused(2), unused(3))
      contact%inlet_factor = exp(log_factor)
   end subroutine start_heat

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
      setting%scale = model%modulus*position%equivalent_radius*contact%length
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
      groups%load = contact%load/(model%modulus*position%equivalent_radius*contact%length)
      groups%roughness = contact%surfaces%roughness/position%equivalent_radius
      groups%hardness = model%hardness/model%modulus
   end function film_groups

   !> Part of the load with which the film's law is used: all of it, or where the law is one of the film's own load, what asperities
   !> do not carry.
   pure function law_part(model, contact) result(part)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact, which touches
      type(contact_t), intent(in) :: contact
      !> The part [-]
      real(wp) :: part

      part = 1.0_wp
      if (.not. takes_whole_load(model%film_law)) part = 1.0_wp - contact%asperity_load/contact%load
   end function law_part

   !> Everything in the contact at a given load.
   pure subroutine evaluate_contact(model, position, setting, load, contact, parts, change)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> What does not change with the load; the factor on the film follows it
      type(setting_t), intent(inout) :: setting
      !> Normal load, W, positive [N]
      real(wp), intent(in) :: load
      !> State of the contact; the speeds are set, and the film ratio is that of a contact nearby or zero
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of
      type(parts_t), intent(out) :: parts
      !> Relative change of the film ratio that was made; its square is about the error left [-]
      real(wp), intent(out) :: change

      ! Lengths of the contact [m]
      type(line_lengths_t) :: lengths
      ! Part of the load group that the rolling law takes [-]
      real(wp) :: rolling_load

      contact%load = load
      contact%is_touching = .true.
      if (allocated(model%axial)) then
         call effective_lengths(model%axial, load, position%equivalent_radius, lengths, parts%lengths_by_load, &
            & parts%lengths_by_radius)
         contact%length = lengths%mean
         setting%scale = model%modulus*position%equivalent_radius*contact%length
      else
         lengths = same_lengths(contact%length)
      end if
      contact%half_width = half_width(load, position%equivalent_radius, contact%length, model%modulus)
      contact%apparent_area = 2.0_wp*contact%half_width*contact%length
      parts%load_group = load/setting%scale
      change = 0.0_wp
      if (allocated(model%heat)) call set_inlet_factor(model, position, contact, setting, parts)
      if (allocated(model%boundary)) then
         call improve_share(setting%line, parts%load_group, parts%share, model%boundary%constants, &
            & contact%apparent_area/setting%scale, contact%film_ratio, change, setting%coarse)
      else
         call share_load(setting%line, parts%load_group, parts%share)
      end if
      contact%film_min = parts%share%film_min*position%equivalent_radius
      contact%film_central = parts%share%film_central*position%equivalent_radius
      contact%film_ratio = contact%film_min/contact%surfaces%roughness
      contact%asperity_load = min(max(0.0_wp, parts%share%asperity_load)*setting%scale, load)
      contact%real_area = parts%share%real_area_ratio*contact%apparent_area
      call set_traction(model, setting, contact, parts)

      rolling_load = parts%load_group
      if (model%rolling_law == rolling_biboulet_houpert) rolling_load = parts%share%film_load
      call rolling_resistance(model%rolling_law, setting%line%groups%speed, rolling_load, model%modulus, &
         & position%equivalent_radius, lengths, model%oil%pressure_viscosity, contact%rolling_resistance, &
         & parts%rolling_load_slope)
      parts%rolling_speed_slope = resistance_speed_slope(model%rolling_law, parts%rolling_load_slope)
      call limit_rolling(contact, parts)
      contact%rolling_resistance = sign(contact%rolling_resistance, contact%entrainment_speed)
      parts%rolling_part = 2.0_wp*position%equivalent_radius/model%roller_radius - 1.0_wp
      contact%tangential_force = contact%traction + contact%rolling_resistance*parts%rolling_part
      contact%bearing_torque = setting%bearing_arm*load + contact%bearing_drag
      if (has_curved_bearing(model)) call load_bearing(model, contact, parts)
   end subroutine evaluate_contact

   !> Rolling resistance held by the load, `F W/(F^8 + W^8)^(1/8)`. Its laws go with a root of the load at most: their slope has no
   !> limit where the load tends to zero, and their resistance would then lift the roller off at once. Resistance below a hundredth
   !> of the load stays as it is to the last bit, a tenth of the load is changed by 1e-9 of it. Our own.
   pure subroutine limit_rolling(contact, parts)
      !> State of the contact; in: with the size of the resistance by its law
      type(contact_t), intent(inout) :: contact
      !> Gets what slopes are made of
      type(parts_t), intent(inout) :: parts

      ! The smaller and the larger of resistance and load [N]; eighth power of their ratio [-]
      real(wp) :: small, large, power

      small = min(contact%rolling_resistance, contact%load)
      large = max(contact%rolling_resistance, contact%load)
      power = (((small/large)**2)**2)**2
      parts%rolling_held = 0.0_wp
      if (contact%rolling_resistance < contact%load .and. power < epsilon(1.0_wp)) return
      parts%rolling_held = merge(power, 1.0_wp, contact%rolling_resistance < contact%load)/(1.0_wp + power)
      contact%rolling_resistance = small/sqrt(sqrt(sqrt(1.0_wp + power)))
   end subroutine limit_rolling

   !> Torque of a bearing where it is not in proportion to the load.
   pure subroutine load_bearing(model, contact, parts)
      !> The model, with such a bearing
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(inout) :: contact
      !> Gets the slopes
      type(parts_t), intent(inout) :: parts

      ! Torque of the load [N m]
      real(wp) :: torque

      call loaded_torque(model%bearing, contact%load, contact%relative_spin, torque, parts%bearing_by_load, &
         & parts%bearing_by_spin, parts%bearing_by_reversal)
      contact%bearing_torque = torque + contact%bearing_drag
   end subroutine load_bearing

   !> Factor on both films by heat in the inlet.
   pure subroutine set_inlet_factor(model, position, contact, setting, parts)
      !> The model, with heat
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact; load and speeds are set
      type(contact_t), intent(inout) :: contact
      !> Gets the factor
      type(setting_t), intent(inout) :: setting
      !> Gets its slopes
      type(parts_t), intent(inout) :: parts

      call inlet_factor(model%heat%inlet_law, model%heat%loading, contact%entrainment_speed, contact%sliding_speed, &
         & peak_pressure(contact%load, position%equivalent_radius, contact%length, model%modulus)/model%modulus, &
         & setting%line%log_factor, parts%heat%inlet_by_speed, parts%heat%inlet_by_sliding, parts%heat%inlet_by_pressure)
      contact%inlet_factor = exp(setting%line%log_factor)
   end subroutine set_inlet_factor

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
      ! Changes of the lengths, their logarithms [-]
      type(line_lengths_t) :: lengths
      ! Changes of load group, radius over roughness and rolling resistance, their logarithms [-]
      real(wp) :: group, relative, rolling

      lengths = line_lengths_t(0.0_wp, 0.0_wp, 0.0_wp)
      if (allocated(model%axial)) lengths = length_changes(parts, motion)
      relative = motion%radius - motion%roughness
      group = motion%load - motion%radius - lengths%mean
      slopes%inlet_factor = 0.0_wp
      if (allocated(model%heat)) then
         slopes%inlet_factor = parts%heat%inlet_by_speed*motion%entrainment + parts%heat%inlet_by_sliding*motion%sliding_speed &
            & + 0.5_wp*parts%heat%inlet_by_pressure*group
         change = share_change(setting%line, parts%load_group, parts%share, group, &
            & motion%entrainment - motion%radius, relative, slopes%inlet_factor)
      else
         change = share_change(setting%line, parts%load_group, parts%share, group, &
            & motion%entrainment - motion%radius, relative)
      end if
      slopes%film_ratio = change%film_min + motion%radius
      slopes%film_central = change%film_central + motion%radius
      call follow_traction(model, setting, contact, parts, motion, change, slopes)

      rolling = group
      if (model%rolling_law == rolling_biboulet_houpert) rolling = change%film_load
      rolling = motion%radius + resistance_length_slope(model%rolling_law, parts%rolling_load_slope, lengths) &
         & + parts%rolling_load_slope*rolling + parts%rolling_speed_slope*(motion%entrainment - motion%radius)
      slopes%rolling_resistance = contact%rolling_resistance*(rolling + parts%rolling_held*(motion%load - rolling))
      slopes%tangential_force = slopes%traction + slopes%rolling_resistance*parts%rolling_part &
         & + contact%rolling_resistance*(parts%rolling_part + 1.0_wp)*motion%radius
      slopes%bearing_torque = (contact%bearing_torque - contact%bearing_drag)*motion%load
      if (allocated(model%drag)) slopes%bearing_torque = slopes%bearing_torque &
         & + motion%relative_spin*drag_torque_slope(model%drag, contact%relative_spin)
      if (has_curved_bearing(model)) then
         slopes%bearing_torque = parts%bearing_by_load*motion%load &
            & + (parts%bearing_by_spin + oil_drag_slope(model, contact%relative_spin))*motion%relative_spin
      else if (allocated(model%bearing) .and. abs(motion%relative_spin) > 0.0_wp) then
         slopes%bearing_torque = slopes%bearing_torque + motion%relative_spin*bearing_torque_slope( &
            & model%bearing%friction_coefficient, contact%load, model%bearing%radius, contact%relative_spin, &
            & model%bearing%reversal_spin)
      end if
   end function follow_contact

   !> Derivative of the torque of the roller's bearing over the logarithm of the spin over which it reverses.
   pure function bearing_by_reversal(model, contact, parts) result(slope)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> What slopes are made of, where it touches
      type(parts_t), intent(in) :: parts
      !> Derivative [N m]
      real(wp) :: slope

      slope = 0.0_wp
      if (allocated(model%drag)) slope = drag_torque_by_reversal(model%drag, contact%relative_spin)
      if (.not. contact%is_touching) return
      if (has_curved_bearing(model)) then
         slope = slope + parts%bearing_by_reversal
      else if (allocated(model%bearing)) then
         slope = slope - contact%relative_spin*bearing_torque_slope(model%bearing%friction_coefficient, contact%load, &
            & model%bearing%radius, contact%relative_spin, model%bearing%reversal_spin)
      end if
   end function bearing_by_reversal

end module camroller_contact_forces
