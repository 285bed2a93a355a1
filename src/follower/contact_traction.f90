!> Traction between cam and roller at a given load and film: shear of the film at its temperature, boundary friction, and how both
!> follow a motion of the contact. Heat of the shear and of boundary friction is spread over the area that is sheared.
!>
!> In: model, contact with film and load share. Out: forces, temperatures, changes. The temperature of the film is where the heat
!> of the shear at that temperature keeps it: its rise is the one root of `y = g |F(y + y_b)|`, with g the rise per force of the
!> shear and y_b that by boundary friction. F falls with the temperature, so that Newton's method on logarithms, with bisection
!> where its steps go to and fro, stays between 0 and the first value. Where the coefficient of boundary friction follows the
!> temperature of the surfaces, that is the root of `t = f(t)`, with f the rise that friction with the coefficient at t makes, by
!> Newton's method inside a bracket.
module camroller_contact_traction
   use camroller_kinds, only : wp
   use camroller_asperity, only : find_boundary_friction, has_one_coefficient
   use camroller_boundary_law, only : follows_temperature
   use camroller_conjunction, only : hot_oil_t, sheared_film_t, film_shear_t, flash_resistance, film_resistance, hot_shear
   use camroller_contact_state, only : contact_t, setting_t, parts_t, motion_t, slopes_t, follow_strip, length_changes
   use camroller_load_share, only : share_change_t
   use camroller_local_limit, only : limited_shear_t, locally_limited_shear, stress_limit_t
   use camroller_lubricant, only : mean_relative_viscosity
   use camroller_model, only : model_t
   use camroller_traction, only : film_pressure, newtonian_shear, eyring_shear, blunt_shear, limit_shear, law_newtonian, &
      & line_lengths_t, sheared_strip
   implicit none
   private

   public :: set_traction, follow_traction, has_hot_boundary, largest_shear, largest_traction_rate

   !> Change of ln(viscosity) by a step of the temperature that may be the last: the shear follows it linearly to its square [-]
   real(wp), parameter :: last_step = 1.0e-7_wp
   !> Evaluations of the shear at most: bisection would need about 60, Newton's method takes two to five
   integer, parameter :: max_evaluations = 80
   !> Step of the surfaces' temperature that may be the last: round-off of a temperature [K]
   real(wp), parameter :: last_surface_step = 1.0e-10_wp

contains

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

      ! Pressure in the middle of the film [Pa]; slope of the boundary friction over the sliding speed [N s/m]; changes of the
      ! temperatures of film and surfaces with it [K s/m]; change of boundary friction with the latter [N/K]
      real(wp) :: peak, boundary_slope, film_rise, flash_rise, own

      contact%boundary_capacity = 0.0_wp
      contact%boundary_mobilised = 0.0_wp
      boundary_slope = 0.0_wp
      peak = film_pressure(contact%load - contact%asperity_load, contact%apparent_area, contact%real_area)
      contact%sheared_area = contact%apparent_area
      if (model%has_wide_shear) then
         call sheared_strip(model%oil, peak, setting%line%groups%speed, parts%load_group, parts%share%film_load, &
            & parts%share%film_central, parts%strip)
         contact%sheared_area = contact%apparent_area*parts%strip%width
         peak = peak*parts%strip%pressure
      end if
      if (has_hot_film(model)) then
         call flash_resistance(model%heat%band, model%heat%bodies, contact%half_width*parts%strip%width, &
            & [contact%cam_surface_speed, contact%roller_surface_speed], parts%heat%flash, parts%heat%flash_by_width, &
            & parts%heat%flash_by_speed)
      end if
      if (.not. has_hot_film(model)) then
         call set_boundary(model, setting, 0.0_wp, contact, parts)
         call set_shear(model, setting, contact, peak, 0.0_wp, parts)
      else if (has_hot_boundary(model)) then
         call warm_surfaces(model, setting, peak, contact, parts)
      else
         call set_boundary(model, setting, 0.0_wp, contact, parts)
         call warm_film(model, setting, peak, contact, parts)
      end if
      if (allocated(model%boundary)) boundary_slope = contact%boundary_capacity*setting%mobilised_slope &
         & + setting%mobilised*contact%asperity_load*parts%boundary%by_speed
      contact%traction_slope = parts%by_shear*parts%speed_slope + parts%by_speed
      if (has_hot_film(model)) then
         own = setting%mobilised*contact%asperity_load*parts%boundary%by_temperature
         call follow_rises(contact, parts, motion_t(sliding_speed=1.0_wp), contact%traction_slope, boundary_slope, own, 0.0_wp, &
            & 0.0_wp, 0.0_wp, film_rise, flash_rise)
         contact%traction_slope = contact%traction_slope + parts%heat%by_rise*film_rise
         boundary_slope = boundary_slope + own*flash_rise
      end if
      contact%shear = parts%shear*(1.0_wp - parts%share%real_area_ratio)
      contact%traction = contact%shear + contact%boundary_mobilised
      contact%traction_slope = contact%traction_slope*(1.0_wp - parts%share%real_area_ratio) + boundary_slope
   end subroutine set_traction

   !> Boundary friction at a temperature of the surfaces.
   pure subroutine set_boundary(model, setting, rise, contact, parts)
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> Rise of the surfaces' temperature [K]
      real(wp), intent(in) :: rise
      !> State of the contact; load share is set
      type(contact_t), intent(inout) :: contact
      !> Gets the coefficient
      type(parts_t), intent(inout) :: parts

      if (.not. allocated(model%boundary)) return
      call find_boundary_friction(model%boundary, contact%sliding_speed, rise, contact%surfaces%covered, parts%boundary)
      contact%boundary_coefficient = parts%boundary%coefficient
      contact%boundary_capacity = model%boundary%film_shear_strength*contact%real_area &
         & + parts%boundary%coefficient*contact%asperity_load
      contact%boundary_mobilised = contact%boundary_capacity*setting%mobilised
   end subroutine set_boundary

   !> Does the coefficient of boundary friction follow the temperature of the surfaces?
   pure function has_hot_boundary(model) result(verdict)
      !> The model
      type(model_t), intent(in) :: model
      !> Does it?
      logical :: verdict

      verdict = .false.
      if (.not. allocated(model%boundary)) return
      if (allocated(model%boundary%curve)) verdict = follows_temperature(model%boundary%curve)
   end function has_hot_boundary

   !> Is the film sheared at the temperature of the contact?
   pure function has_hot_film(model) result(verdict)
      type(model_t), intent(in) :: model
      !> Is it?
      logical :: verdict

      verdict = .false.
      if (allocated(model%heat)) verdict = model%heat%has_contact
   end function has_hot_film

   !> Shear of the film with its limit, over all of the contact, at a rise of its temperature.
   pure subroutine set_shear(model, setting, contact, peak, rise, parts)
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> State of the contact; film and load share are set
      type(contact_t), intent(in) :: contact
      !> Pressure in the middle of the film [Pa], rise of its temperature [K]
      real(wp), intent(in) :: peak, rise
      !> What slopes are made of
      type(parts_t), intent(inout) :: parts

      ! Mean viscosity ratio and its logarithmic slope over the pressure [-]
      real(wp) :: viscosity, viscosity_slope
      ! Derivatives of the shear with a slip that is not resolved over that without, and over the limit [-]
      real(wp) :: by_free, by_limit
      ! Derivative of the shear before its limit over the rise [N/K]; the limit [N]
      real(wp) :: rise_slope, limit
      type(film_shear_t) :: hot

      if (model%has_local_limit) then
         call set_local_shear(model, setting, contact, peak, rise, parts)
         return
      end if
      limit = model%limiting_coefficient*contact%load
      parts%limit_share = 1.0_wp
      rise_slope = 0.0_wp
      if (has_hot_film(model)) then
         parts%limit_share = exp(-model%heat%limit_fall*rise)
         limit = limit*parts%limit_share
         call hot_shear(sheared_film_t(model%shear_law, contact%sliding_speed, peak, contact%sheared_area, contact%film_central, &
            & model%eyring_stress), model%oil, model%heat%hot, rise, hot)
         parts%free_shear = hot%force
         parts%speed_slope = hot%by_speed
         parts%pressure_slope = hot%by_peak
         rise_slope = hot%by_rise
      else if (model%shear_law == law_newtonian) then
         call mean_relative_viscosity(model%oil, peak, viscosity, viscosity_slope)
         parts%speed_slope = newtonian_shear(1.0_wp, model%oil%viscosity*viscosity, contact%sheared_area, contact%film_central)
         parts%free_shear = parts%speed_slope*contact%sliding_speed
         parts%pressure_slope = parts%free_shear*viscosity_slope
      else
         call eyring_shear(contact%sliding_speed, model%oil, peak, contact%sheared_area, contact%film_central, &
            & model%eyring_stress, parts%free_shear, parts%speed_slope, parts%pressure_slope)
      end if
      parts%shear = parts%free_shear
      by_free = 1.0_wp
      by_limit = 0.0_wp
      parts%by_speed = 0.0_wp
      if (setting%resolution > 0.0_wp) then
         call blunt_shear(contact%sliding_speed, setting%resolution, limit, parts%speed_slope, parts%shear, by_free, &
            & by_limit, parts%by_speed)
      end if
      call limit_shear(model%cap, limit, parts%shear, parts%by_shear, parts%by_limit)
      parts%by_limit = parts%by_limit + parts%by_shear*by_limit
      parts%by_speed = parts%by_shear*parts%by_speed
      parts%by_shear = parts%by_shear*by_free
      if (has_hot_film(model)) parts%heat%by_rise = parts%by_shear*rise_slope - parts%by_limit*limit*model%heat%limit_fall
   end subroutine set_shear

   !> The same where the stress is limited at each point: force and slopes are those of the limited shear, and the load has no part
   !> in the limit but by the pressure.
   pure subroutine set_local_shear(model, setting, contact, peak, rise, parts)
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> State of the contact; film and load share are set
      type(contact_t), intent(in) :: contact
      !> Pressure in the middle of the film [Pa], rise of its temperature [K]
      real(wp), intent(in) :: peak, rise
      !> What slopes are made of
      type(parts_t), intent(inout) :: parts

      type(hot_oil_t) :: hot
      type(stress_limit_t) :: limit
      type(limited_shear_t) :: shear

      limit = stress_limit_t(model%cap, model%limiting_stress, model%limiting_coefficient, 0.0_wp, setting%resolution)
      if (has_hot_film(model)) then
         hot = model%heat%hot
         limit%fall = model%heat%limit_fall
      end if
      call locally_limited_shear(sheared_film_t(model%shear_law, contact%sliding_speed, peak, contact%sheared_area, &
         & contact%film_central, model%eyring_stress), model%oil, hot, rise, limit, shear)
      parts%shear = shear%force
      parts%free_shear = shear%force
      parts%speed_slope = shear%by_rate
      parts%pressure_slope = shear%by_peak
      parts%by_shear = 1.0_wp
      parts%by_limit = 0.0_wp
      parts%limit_share = 1.0_wp
      parts%by_speed = shear%by_slip
      parts%heat%by_rise = shear%by_rise
   end subroutine set_local_shear

   !> Shear of the film that its limit lets through at most, were there no asperities.
   elemental function largest_shear(model, contact) result(force)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Force [N]
      real(wp) :: force

      force = model%limiting_coefficient*contact%load
      if (model%has_local_limit) force = force + model%limiting_stress*contact%sheared_area
   end function largest_shear

   !> Rate of the sliding speed that traction makes at most.
   elemental function largest_traction_rate(model, contact) result(rate)
      !> The model
      type(model_t), intent(in) :: model
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> The rate [m/s per rad]
      real(wp) :: rate

      rate = model%roller_radius**2/(model%roller_inertia*model%speed)*(largest_shear(model, contact) + contact%boundary_capacity)
   end function largest_traction_rate

   !> Rise of the surfaces' temperature that the heat of friction keeps, whose boundary part follows that temperature, and friction
   !> there. The search starts at the oil's temperature, so that a contact nearby has no part in the choice among several roots.
   pure subroutine warm_surfaces(model, setting, peak, contact, parts)
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> Pressure in the middle of the film [Pa]
      real(wp), intent(in) :: peak
      !> State of the contact; in: temperature of the film to try first or zero; out: its own
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of
      type(parts_t), intent(inout) :: parts

      ! Rise tried and next, bracket of it [K]
      real(wp) :: rise, next, low, high
      ! Changes of the boundary friction with the temperature that its coefficient is for [N/K], and of film and surfaces [-]
      real(wp) :: own, by_film, by_surfaces
      integer :: i

      rise = 0.0_wp
      low = 0.0_wp
      high = huge(1.0_wp)
      do i = 1, max_evaluations
         call set_boundary(model, setting, rise, contact, parts)
         call warm_film(model, setting, peak, contact, parts)
         if (abs(contact%flash_rise - rise) <= last_surface_step .or. high - low <= last_surface_step) exit
         if (contact%flash_rise > rise) low = rise
         if (contact%flash_rise < rise) high = rise
         own = setting%mobilised*contact%asperity_load*parts%boundary%by_temperature
         call follow_rises(contact, parts, motion_t(), 0.0_wp, own, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, by_film, by_surfaces)
         next = contact%flash_rise
         if (by_surfaces < 1.0_wp) next = rise + (contact%flash_rise - rise)/(1.0_wp - by_surfaces)
         if (next <= low .or. next >= high) next = merge(contact%flash_rise, 0.5_wp*(low + high), high >= huge(1.0_wp))
         rise = next
      end do
   end subroutine warm_surfaces

   !> Rise of the temperature that the heat of the shear at that temperature keeps, and the shear there.
   pure subroutine warm_film(model, setting, peak, contact, parts)
      type(model_t), intent(in) :: model
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> Pressure in the middle of the film [Pa]
      real(wp), intent(in) :: peak
      !> State of the contact; in: temperature of the film to try first or zero; out: its own
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of; in: resistance of the surfaces
      type(parts_t), intent(inout) :: parts

      ! Sliding speed over area [1/(m s)]; rise per force of the shear [K/N]; rise by boundary friction, by the shear, its bounds,
      ! its next value [K]
      real(wp) :: flux, gain, by_boundary, rise, low, high, next
      ! Shear without its sign [N]; logarithm of what the rise is too large by, relative step and the one before [-]
      real(wp) :: force, excess, step, last
      integer :: i

      parts%heat%film = film_resistance(contact%film_central, model%heat%oil_conductivity)
      flux = abs(contact%sliding_speed)/contact%sheared_area
      gain = flux*(parts%heat%flash*(1.0_wp - parts%share%real_area_ratio) + parts%heat%film)
      by_boundary = flux*parts%heat%flash*abs(contact%boundary_mobilised)
      low = 0.0_wp
      high = huge(1.0_wp)
      rise = contact%film_rise - by_boundary
      if (.not. rise > 0.0_wp) then
         call set_shear(model, setting, contact, peak, by_boundary, parts)
         high = gain*abs(parts%shear)
         rise = first_rise(model%heat%hot%coefficient, gain*abs(parts%free_shear), high)
         ! The shear follows so small a rise along a straight line
         if (high*model%heat%hot%coefficient <= last_step) then
            parts%shear = parts%shear + parts%heat%by_rise*high/(1.0_wp + gain*abs(parts%heat%by_rise))
            rise = 0.0_wp
         end if
      end if
      step = 0.0_wp
      do i = 1, max_evaluations
         if (.not. rise > 0.0_wp) exit
         last = step
         call set_shear(model, setting, contact, peak, rise + by_boundary, parts)
         force = abs(parts%shear)
         excess = 1.0_wp
         if (gain*force > 0.0_wp) excess = log(rise/(gain*force))
         step = -excess
         if (force > 0.0_wp) step = -excess/(1.0_wp + rise*abs(parts%heat%by_rise)/force)
         next = rise*exp(step)
         if (abs(step)*max(rise, next)*model%heat%hot%coefficient <= last_step) then
            parts%shear = parts%shear + parts%heat%by_rise*(next - rise)
            exit
         end if
         if (excess > 0.0_wp) high = rise
         if (excess < 0.0_wp) low = rise
         ! Where the limit gives way to the free shear, steps go to and fro for long
         if (next <= low .or. next >= high .or. (step*last < 0.0_wp .and. abs(step) > 0.5_wp*abs(last))) next = low &
            & + 0.5_wp*(high - low)
         if (next <= low .or. next >= high) exit
         rise = next
      end do
      contact%film_rise = gain*abs(parts%shear) + by_boundary
      contact%flash_rise = flux*parts%heat%flash*(abs(parts%shear)*(1.0_wp - parts%share%real_area_ratio) &
         & + abs(contact%boundary_mobilised))
   end subroutine warm_film

   !> Rise to start from: that of a shear which falls exponentially, `x e^x = z` by `x = ln(1 + z) (1 - ln(1 + ln(1 + z))/(2 + ln(1
   !> + z)))`, which is within 2 %, and not more than that of the limit.
   !>
   !> Source: Winitzki (2003), Computational Science and its Applications, Lecture Notes in Computer Science 2667, 780.
   elemental function first_rise(fall, free, limited) result(rise)
      !> Fall of ln(viscosity) [1/K]
      real(wp), intent(in) :: fall
      !> Rise that the shear without it would make, before its limit and with it [K]
      real(wp), intent(in) :: free, limited
      !> Rise [K]
      real(wp) :: rise

      ! ln(1 + z) [-]
      real(wp) :: large

      large = log(1.0_wp + fall*free)
      rise = min(large*(1.0_wp - log(1.0_wp + large)/(2.0_wp + large))/fall, limited)
   end function first_rise

   !> How shear and boundary friction follow a motion of the contact, with the temperatures of film and surfaces.
   pure subroutine follow_traction(model, setting, contact, parts, motion, change, slopes)
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
      !> How film and load share follow it
      type(share_change_t), intent(in) :: change
      !> Gets the changes of traction, its parts and the temperatures
      type(slopes_t), intent(inout) :: slopes

      ! Changes of the lengths, their logarithms [-]
      type(line_lengths_t) :: lengths
      ! Changes of apparent area, pressure in the film and central film, of the strip's width and pressure over these, their
      ! logarithms [-]; of the shear, of boundary friction with its limit, and with the part of it that slip mobilises [N]
      real(wp) :: area, pressure, film, wider, higher, shear, boundary, mobilised
      ! Change of the limit of boundary friction [N], and with the temperature of the surfaces [N/K]
      real(wp) :: capacity, own

      lengths = length_changes(parts, motion)
      area = 0.5_wp*(motion%load + motion%radius + lengths%mean)
      film = change%film_central + motion%radius
      pressure = change%film_load + motion%radius + lengths%mean - area &
         & + change%real_area_ratio/(1.0_wp - parts%share%real_area_ratio)
      wider = 0.0_wp
      higher = 0.0_wp
      if (model%has_wide_shear) call follow_strip(parts, motion, change, lengths%mean, pressure, wider, higher)
      shear = parts%free_shear*(area + wider) + parts%pressure_slope*(pressure + higher) + parts%speed_slope*(motion%sliding_speed &
         & - contact%sliding_speed*film)
      shear = parts%by_shear*shear + parts%by_limit*model%limiting_coefficient*contact%load*motion%load*parts%limit_share &
         & + parts%by_speed*motion%sliding_speed
      slopes%asperity_load = change%asperity_load*setting%scale + (motion%radius + lengths%mean)*contact%asperity_load
      slopes%real_area = area*contact%real_area + contact%apparent_area*change%real_area_ratio
      capacity = 0.0_wp
      mobilised = 0.0_wp
      if (allocated(model%boundary)) then
         capacity = model%boundary%film_shear_strength*slopes%real_area + parts%boundary%coefficient*slopes%asperity_load
         mobilised = contact%boundary_capacity*setting%mobilised_slope*motion%sliding_speed
         if (.not. has_one_coefficient(model%boundary)) capacity = capacity + contact%asperity_load &
            & *(parts%boundary%by_speed*motion%sliding_speed + parts%boundary%by_covered*motion%covered)
      end if
      boundary = setting%mobilised*capacity
      slopes%film_rise = 0.0_wp
      slopes%flash_rise = 0.0_wp
      if (has_hot_film(model)) then
         own = contact%asperity_load*parts%boundary%by_temperature
         call follow_rises(contact, parts, motion, shear, boundary + mobilised, setting%mobilised*own, area + wider, &
            & film, change%real_area_ratio, slopes%film_rise, slopes%flash_rise)
         shear = shear + parts%heat%by_rise*slopes%film_rise
         capacity = capacity + own*slopes%flash_rise
         boundary = setting%mobilised*capacity
      end if
      slopes%boundary_capacity = capacity
      slopes%shear = shear*(1.0_wp - parts%share%real_area_ratio) - parts%shear*change%real_area_ratio
      slopes%traction = slopes%shear + boundary + mobilised
   end subroutine follow_traction

   !> How the temperatures of film and surfaces follow a motion, with the changes of shear and boundary friction that they make
   !> themselves: two linear equations.
   pure subroutine follow_rises(contact, parts, motion, shear, boundary, own, area, film, real_area_ratio, film_rise, flash_rise)
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> What slopes are made of
      type(parts_t), intent(in) :: parts
      !> Direction of the motion
      type(motion_t), intent(in) :: motion
      !> Changes of the shear and of the boundary friction at the temperatures that are there [N]
      real(wp), intent(in) :: shear, boundary
      !> Change of the boundary friction with the temperature of the surfaces [N/K]
      real(wp), intent(in) :: own
      !> Changes of sheared area and central film, their logarithms, and of the real area ratio [-]
      real(wp), intent(in) :: area, film, real_area_ratio
      !> Changes of the rises of film and surfaces [K]
      real(wp), intent(out) :: film_rise, flash_rise

      ! Changes of the lengths, their logarithms [-]
      type(line_lengths_t) :: lengths
      ! Sliding speed over area [1/(m s)]; change of ln(flash) [-]; changes of the speeds of the contact over cam and roller [m/s]
      real(wp) :: flux, flash, speeds(2)
      ! Changes of both rises with friction at the temperatures that are there: of their part that surfaces make times area over
      ! sliding speed [N m^2 K/W]; both [K]
      real(wp) :: surfaces, film_given, flash_given
      ! What the fall of the shear with the film's temperature takes from both rises, and what boundary friction adds [-]
      real(wp) :: film_take, flash_take, add, whole

      film_rise = 0.0_wp
      flash_rise = 0.0_wp
      if (.not. abs(contact%sliding_speed) > 0.0_wp) return
      associate (heat => parts%heat, ratio => parts%share%real_area_ratio)
         flux = abs(contact%sliding_speed)/contact%sheared_area
         speeds = contact%entrainment_speed*motion%entrainment + [0.5_wp, -0.5_wp]*motion%sliding_speed
         lengths = length_changes(parts, motion)
         flash = heat%flash_by_width*(area - lengths%mean) + sum(heat%flash_by_speed*speeds)
         surfaces = heat%flash*flash*(abs(parts%shear)*(1.0_wp - ratio) + abs(contact%boundary_mobilised))
         film_given = contact%film_rise*(motion%sliding_speed/contact%sliding_speed - area) + flux*(surfaces &
            & + abs(parts%shear)*(heat%film*film - heat%flash*real_area_ratio) &
            & + (heat%flash*(1.0_wp - ratio) + heat%film)*sign(1.0_wp, parts%shear)*shear &
            & + heat%flash*sign(1.0_wp, contact%boundary_mobilised)*boundary)
         flash_given = contact%flash_rise*(motion%sliding_speed/contact%sliding_speed - area) + flux*(surfaces + heat%flash &
            & *((1.0_wp - ratio)*sign(1.0_wp, parts%shear)*shear - abs(parts%shear)*real_area_ratio &
            & + sign(1.0_wp, contact%boundary_mobilised)*boundary))
         film_take = flux*(heat%flash*(1.0_wp - ratio) + heat%film)*abs(heat%by_rise)
         flash_take = flux*heat%flash*(1.0_wp - ratio)*abs(heat%by_rise)
         add = flux*heat%flash*sign(1.0_wp, contact%boundary_mobilised)*own
         whole = (1.0_wp + film_take)*(1.0_wp - add) + add*flash_take
         film_rise = (film_given*(1.0_wp - add) + add*flash_given)/whole
         flash_rise = ((1.0_wp + film_take)*flash_given - flash_take*film_given)/whole
      end associate
   end subroutine follow_rises

end module camroller_contact_traction
