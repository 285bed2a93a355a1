!> The contact at one cam angle and one sliding speed: load, film, load share, traction and torque of the roller's bearing, solved
!> together.
!>
!> Layer: solver. In: model, geometry, moments, sliding speed. Out: `contact_t`. Two nested equations in one unknown each:
!> the film ratio at which asperities and film share a given load, and the load at which the finger is in balance with the
!> traction that this load brings. Both are solved to round-off, with brackets that cannot be left; nothing is lagged.
module camroller_contact
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_hertz, only : half_width
   use camroller_lubricant, only : mean_relative_viscosity
   use camroller_film, only : groups_t, film_line_t, new_film_line, is_in_range
   use camroller_load_share, only : share_t, share_load, improve_share
   use camroller_traction, only : film_pressure, newtonian_shear, eyring_shear, limit_shear, mobilised_share, &
      & rolling_resistance, law_newtonian, rolling_biboulet_houpert
   use camroller_needle, only : bearing_torque
   implicit none
   private

   public :: contact_t, solve_contact

   !> State of the contact
   type :: contact_t
      !> Do cam and roller touch?
      logical :: is_touching
      !> Were the groups inside the film law's range?
      logical :: is_in_range
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
   end type contact_t

   !> What does not change with the load while the balance is sought
   type :: setting_t
      !> Film over the load at the entrainment speed
      type(film_line_t) :: line
      !> E' R L [N]
      real(wp) :: scale
      !> Mobilised part of the boundary friction [-]
      real(wp) :: mobilised
      !> Torque of the roller's bearing over the load [m]
      real(wp) :: bearing_arm
   end type setting_t

   !> Balance of the finger: loss of figures allowed against the largest moment [-]; a few roundings
   real(wp), parameter :: balance_tolerance = 8.0_wp*epsilon(1.0_wp)
   !> Change of the film ratio below which its square is round-off [-]
   real(wp), parameter :: share_tolerance = 1.0e-8_wp
   !> Iterations that a bracketed secant may take: bisection alone would need about 60
   integer, parameter :: max_iterations = 100
   !> Loads below this part of the frictionless load count as lost contact [-]
   real(wp), parameter :: lost_load = 1.0e-12_wp

contains

   !> Solve the contact.
   pure subroutine solve_contact(model, position, moments, sliding_speed, contact, status)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> State of the contact
      type(contact_t), intent(out) :: contact
      !> 0 fine, positive where the balance was not reached
      integer, intent(out) :: status

      type(setting_t) :: setting
      ! Moment that the contact load balances [N m]; arm of the load [m]; load without friction [N]
      real(wp) :: moment, arm, load
      ! Relative change of the film ratio in the last step [-]
      real(wp) :: change

      status = 0
      call set_speeds(model, position, sliding_speed, contact)
      arm = merge(position%normal_arm, position%parallel_arm, model%has_exact_arm)
      moment = moments%total
      if (model%is_consistent .and. allocated(model%guide_drag)) then
         moment = moment + model%guide_drag*model%speed*position%lift_slope*position%valve_arm
      end if
      load = moment/arm
      if (model%takes_maximum_load) load = max(model%base_circle_load, load)
      if (.not. load > 0.0_wp) then
         call release(contact)
         return
      end if
      call prepare(model, position, contact, setting)
      if (model%is_consistent) then
         call balance_finger(model, position, setting, moment, contact, status)
      else
         contact%film_ratio = 0.0_wp
         call evaluate_contact(model, position, setting, load, contact, change)
      end if
   end subroutine solve_contact

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
   end subroutine set_speeds

   !> What the speeds alone decide.
   pure subroutine prepare(model, position, contact, setting)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> State of the contact; the speeds are set
      type(contact_t), intent(in) :: contact
      !> What does not change with the load
      type(setting_t), intent(out) :: setting

      type(groups_t) :: groups

      setting%scale = model%modulus*position%equivalent_radius*model%contact_width
      groups%speed = model%oil%viscosity*abs(contact%entrainment_speed)/(model%modulus*position%equivalent_radius)
      groups%material = model%oil%pressure_viscosity*model%modulus
      groups%load = 0.0_wp
      groups%roughness = model%roughness/position%equivalent_radius
      groups%hardness = model%hardness/model%modulus
      call new_film_line(setting%line, model%film_law, groups)
      setting%mobilised = 0.0_wp
      if (allocated(model%boundary)) then
         setting%mobilised = mobilised_share(contact%sliding_speed, model%boundary%mobilising_speed)
      end if
      setting%bearing_arm = 0.0_wp
      if (allocated(model%bearing)) then
         setting%bearing_arm = bearing_torque(model%bearing%friction_coefficient, 1.0_wp, model%bearing%radius, &
            & contact%relative_spin, model%bearing%reversal_spin)
      end if
   end subroutine prepare

   !> Load at which `W h_W + sense (T' h_t + T_B) = moment`, by a bracketed secant.
   !>
   !> Friction changes the load by a few per cent at most, so two or three secant steps reach round-off. Without a load at
   !> which friction lets the balance be, contact is lost.
   pure subroutine balance_finger(model, position, setting, moment, contact, status)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> Moment to be balanced, positive [N m]
      real(wp), intent(in) :: moment
      !> State of the contact
      type(contact_t), intent(inout) :: contact
      !> 0 fine, positive where the balance was not reached
      integer, intent(out) :: status

      ! Load, load before, next load, bracket [N]
      real(wp) :: load, last_load, next_load, low, high
      ! Moment too much at the load and at the load before [N m]
      real(wp) :: excess, last_excess
      ! Slope of the excess [m]
      real(wp) :: slope
      ! Relative change of the film ratio in the last step [-]
      real(wp) :: change
      integer :: iteration

      status = 0
      load = moment/position%normal_arm
      low = 0.0_wp
      high = huge(1.0_wp)
      slope = position%normal_arm
      last_load = 0.0_wp
      last_excess = 0.0_wp
      contact%film_ratio = 0.0_wp
      do iteration = 1, max_iterations
         call evaluate_contact(model, position, setting, load, contact, change)
         excess = load*position%normal_arm - moment &
            & + model%linkage%sense*(contact%tangential_force*position%tangent_arm + contact%bearing_torque)
         ! Only a converged share tells on which side of the root the load lies
         if (abs(change) <= share_tolerance) then
            if (abs(excess) <= balance_tolerance*moment) return
            if (excess > 0.0_wp) high = load
            if (excess < 0.0_wp) low = load
         end if
         if (high - low <= 2.0_wp*epsilon(1.0_wp)*load) return
         if (high < lost_load*moment/position%normal_arm) then
            call release(contact)
            return
         end if
         if (iteration > 1 .and. abs(load - last_load) > 0.0_wp) slope = (excess - last_excess)/(load - last_load)
         next_load = load
         if (slope > 0.0_wp) next_load = load - excess/slope
         if (next_load <= low .or. next_load >= high .or. .not. abs(next_load - load) > 0.0_wp) then
            next_load = merge(2.0_wp*load, low + 0.5_wp*(high - low), high >= huge(1.0_wp))
         end if
         last_load = load
         last_excess = excess
         load = next_load
      end do
      status = 1
   end subroutine balance_finger

   !> Everything in the contact at a given load.
   pure subroutine evaluate_contact(model, position, setting, load, contact, change)
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
      !> Relative change of the film ratio that was made; its square is about the error left [-]
      real(wp), intent(out) :: change

      type(share_t) :: share
      type(groups_t) :: groups
      ! Pressure in the middle of the film [Pa]; load over E' R L that the rolling law takes [-]
      real(wp) :: peak, rolling_load

      contact%load = load
      contact%is_touching = .true.
      contact%half_width = half_width(load, position%equivalent_radius, model%contact_width, model%modulus)
      contact%apparent_area = 2.0_wp*contact%half_width*model%contact_width
      groups = setting%line%groups
      groups%load = load/setting%scale
      contact%is_in_range = is_in_range(model%film_law, groups)
      if (allocated(model%boundary)) then
         call improve_share(setting%line, groups%load, share, model%boundary%constants, &
            & contact%apparent_area/setting%scale, contact%film_ratio, change)
      else
         change = 0.0_wp
         call share_load(setting%line, groups%load, share)
      end if
      contact%film_min = share%film_min*position%equivalent_radius
      contact%film_central = share%film_central*position%equivalent_radius
      contact%film_ratio = contact%film_min/model%roughness
      contact%asperity_load = share%asperity_load*setting%scale
      contact%real_area = share%real_area_ratio*contact%apparent_area

      peak = film_pressure(load - contact%asperity_load, contact%apparent_area, contact%real_area)
      call set_traction(model, peak, share%real_area_ratio, setting%mobilised, contact)
      rolling_load = groups%load
      if (model%rolling_law == rolling_biboulet_houpert) rolling_load = groups%load - share%asperity_load
      contact%rolling_resistance = sign(rolling_resistance(model%rolling_law, groups%speed, rolling_load, model%modulus, &
         & position%equivalent_radius, model%contact_width, model%oil%pressure_viscosity), contact%entrainment_speed)
      contact%tangential_force = contact%traction &
         & + contact%rolling_resistance*(2.0_wp*position%equivalent_radius/model%roller_radius - 1.0_wp)
      contact%bearing_torque = setting%bearing_arm*load
   end subroutine evaluate_contact

   !> Shear of the film, boundary friction and their sum.
   pure subroutine set_traction(model, peak, real_area_ratio, mobilised, contact)
      !> The model
      type(model_t), intent(in) :: model
      !> Pressure in the middle of the film [Pa]
      real(wp), intent(in) :: peak
      !> Real over apparent contact area [-]
      real(wp), intent(in) :: real_area_ratio
      !> Mobilised part of the boundary friction [-]
      real(wp), intent(in) :: mobilised
      !> State of the contact; film and load share are set
      type(contact_t), intent(inout) :: contact

      ! Slope of the shear over the sliding speed [N s/m]
      real(wp) :: slope

      if (model%shear_law == law_newtonian) then
         slope = newtonian_shear(1.0_wp, model%oil%viscosity*mean_relative_viscosity(model%oil, peak), &
            & contact%apparent_area, contact%film_central)
         contact%shear = slope*contact%sliding_speed
      else
         call eyring_shear(contact%sliding_speed, model%oil, peak, contact%apparent_area, contact%film_central, &
            & model%eyring_stress, contact%shear, slope)
      end if
      call limit_shear(model%cap, model%limiting_coefficient*contact%load, contact%shear, slope)
      contact%shear = contact%shear*(1.0_wp - real_area_ratio)
      contact%traction = contact%shear
      contact%traction_slope = slope*(1.0_wp - real_area_ratio)
      contact%boundary_capacity = 0.0_wp
      contact%boundary_mobilised = 0.0_wp
      if (.not. allocated(model%boundary)) return

      contact%boundary_capacity = model%boundary%film_shear_strength*contact%real_area &
         & + model%boundary%coefficient*contact%asperity_load
      contact%boundary_mobilised = contact%boundary_capacity*mobilised
      contact%traction = contact%traction + contact%boundary_mobilised
      contact%traction_slope = contact%traction_slope &
         & + contact%boundary_capacity*(1.0_wp - mobilised)*(1.0_wp + mobilised)/model%boundary%mobilising_speed
   end subroutine set_traction

   !> No contact: no force; the film is reported as zero, since there is none to speak of.
   pure subroutine release(contact)
      !> State of the contact; the speeds are kept
      type(contact_t), intent(inout) :: contact

      contact%is_touching = .false.
      contact%is_in_range = .true.
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
      contact%bearing_torque = 0.0_wp
   end subroutine release

end module camroller_contact
