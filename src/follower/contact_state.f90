!> State of the contact of cam and roller, and what its slopes are made of: the types that its procedures share.
module camroller_contact_state
   use camroller_kinds, only : wp
   use camroller_asperity, only : boundary_friction_t
   use camroller_cam_surface, only : meeting_t
   use camroller_film, only : film_line_t
   use camroller_load_share, only : share_t, share_change_t
   use camroller_traction, only : line_lengths_t, strip_t
   implicit none
   private

   public :: contact_t, setting_t, parts_t, motion_t, slopes_t, follow_strip, length_changes, release_contact

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
      !> Area of the film that is sheared [m^2]
      real(wp) :: sheared_area
      !> Length of the line contact that stands for the roller: its own, or shorter where the load is not the same along it [m]
      real(wp) :: length
      !> Composite roughness and what covers the surfaces here
      type(meeting_t) :: surfaces
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
      !> Friction coefficient of the asperities; zero without them [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Rolling resistance of each surface, F_r, with the sign of the entrainment [N]
      real(wp) :: rolling_resistance
      !> Traction, F_t [N]; its slope over the sliding speed at constant load and film, which the film's temperature
      !> follows [N s/m]
      real(wp) :: traction, traction_slope
      !> Net tangential force on the roller, T' = F_t + F_r (2 R/r_R - 1) [N]
      real(wp) :: tangential_force
      !> Factor on both films by heat in the inlet [-]
      real(wp) :: inlet_factor = 1.0_wp
      !> Mean rise of the film's temperature over that of the oil around, and that of both surfaces [K]
      real(wp) :: film_rise = 0.0_wp, flash_rise = 0.0_wp
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

   !> What the slopes of heat in the contact are made of
   type :: heat_slopes_t
      !> Derivatives of ln(factor of the inlet) over ln(entrainment speed) [-], sliding speed [s/m] and ln(peak pressure) [-]
      real(wp) :: inlet_by_speed = 0.0_wp, inlet_by_sliding = 0.0_wp, inlet_by_pressure = 0.0_wp
      !> Rise of the surfaces per heat flux into both, of the film above them per heat flux in it [m^2 K/W]
      real(wp) :: flash = 0.0_wp, film = 0.0_wp
      !> Derivatives of ln(flash) over ln(half width) [-] and over the speeds of the contact on cam and roller [s/m]
      real(wp) :: flash_by_width = 0.0_wp, flash_by_speed(2) = 0.0_wp
      !> Derivative of the limited shear over the rise of the film's temperature [N/K]
      real(wp) :: by_rise = 0.0_wp
   end type heat_slopes_t

   !> What the slopes of the forces are made of, kept from their evaluation
   type :: parts_t
      !> Film and load share
      type(share_t) :: share
      !> Load over E' R L [-]
      real(wp) :: load_group
      !> Strip of the film that is sheared
      type(strip_t) :: strip
      !> Shear of the film after its limit, over all of the contact [N]
      real(wp) :: shear
      !> Derivative of that over the shear before the limit and over the limit [-], and over the sliding speed beside these [N s/m]
      real(wp) :: by_shear, by_limit, by_speed
      !> Shear before its limit [N], derivative over ln(pressure) [N] and over the sliding speed [N s/m]; where the stress is
      !> limited at each point all of them after it
      real(wp) :: free_shear, pressure_slope, speed_slope
      !> Limit of the shear over that of a film as cold as the oil around [-]
      real(wp) :: limit_share
      !> Friction coefficient of the asperities
      type(boundary_friction_t) :: boundary
      !> Heat, where the case has it
      type(heat_slopes_t) :: heat
      !> Logarithmic slopes of the rolling resistance by its law over load and speed group; part in which its limit, the load, holds
      !> it: it follows the load by this part and the law by the rest [-]
      real(wp) :: rolling_load_slope, rolling_speed_slope, rolling_held
      !> Derivatives of the logarithms of the contact's lengths over ln(load) and ln(radius) [-]
      type(line_lengths_t) :: lengths_by_load, lengths_by_radius
      !> 2 R/r_R - 1 [-]
      real(wp) :: rolling_part
      !> Derivatives of the torque of a curved bearing over ln(load) [N m], spin [N m s/rad] and ln(reversal spin) [N m], less that
      !> without load
      real(wp) :: bearing_by_load = 0.0_wp, bearing_by_spin = 0.0_wp, bearing_by_reversal = 0.0_wp
   end type parts_t

   !> A direction in which a contact may move
   type :: motion_t
      !> Change of load, entrainment speed and equivalent radius, their logarithms [-]
      real(wp) :: load = 0.0_wp, entrainment = 0.0_wp, radius = 0.0_wp
      !> Change of sliding speed [m/s] and of the roller's spin relative to the finger [rad/s]
      real(wp) :: sliding_speed = 0.0_wp, relative_spin = 0.0_wp
      !> Change of the composite roughness, its logarithm, and of the part that a tribofilm covers [-]
      real(wp) :: roughness = 0.0_wp, covered = 0.0_wp
   end type motion_t

   !> Changes that follow
   type :: slopes_t
      !> ln of minimum and central film, ln of the factor on both by heat in the inlet [-]
      real(wp) :: film_ratio, film_central, inlet_factor
      !> Load of the asperities [N], their real contact area [m^2]
      real(wp) :: asperity_load, real_area
      !> Rises of the temperatures of film and surfaces [K]
      real(wp) :: film_rise, flash_rise
      !> Shear of the film beside the asperities, boundary friction that these can bear [N]
      real(wp) :: shear, boundary_capacity
      !> Traction, rolling resistance, tangential force [N]
      real(wp) :: traction, rolling_resistance, tangential_force
      !> Torque of the roller's bearing [N m]
      real(wp) :: bearing_torque
   end type slopes_t

contains

   !> Changes of the contact's lengths along a motion, their logarithms.
   elemental function length_changes(parts, motion) result(change)
      !> What slopes are made of
      type(parts_t), intent(in) :: parts
      !> Direction of the motion
      type(motion_t), intent(in) :: motion
      !> The changes [-]
      type(line_lengths_t) :: change

      associate (by_load => parts%lengths_by_load, by_radius => parts%lengths_by_radius)
         change%mean = by_load%mean*motion%load + by_radius%mean*motion%radius
         change%root = by_load%root*motion%load + by_radius%root*motion%radius
         change%loaded = by_load%loaded*motion%load + by_radius%loaded*motion%radius
      end associate
   end function length_changes

   !> How the strip that is sheared follows a motion.
   pure subroutine follow_strip(parts, motion, change, length, pressure, wider, higher)
      !> What slopes are made of
      type(parts_t), intent(in) :: parts
      !> Direction of the motion
      type(motion_t), intent(in) :: motion
      !> How film and load share follow it
      type(share_change_t), intent(in) :: change
      !> Changes of the contact's length and of the pressure on the dry contact, their logarithms [-]
      real(wp), intent(in) :: length, pressure
      !> Changes of the strip's width and pressure over those of the dry contact, their logarithms [-]
      real(wp), intent(out) :: wider, higher

      ! Changes of load group and rigidity, their logarithms [-]
      real(wp) :: load_group, rigidity

      load_group = motion%load - motion%radius - length
      rigidity = motion%entrainment - motion%radius - load_group - change%film_load
      wider = parts%strip%width_by_rigidity*rigidity + parts%strip%width_by_film*(change%film_central - load_group)
      higher = parts%strip%pressure_by_rigidity*rigidity + parts%strip%pressure_by_peak*pressure
   end subroutine follow_strip

   !> No contact: no force but the drag of the roller's bearing; the film is reported as zero, since there is none to speak of.
   pure subroutine release_contact(contact)
      !> State of the contact; the speeds are kept
      type(contact_t), intent(inout) :: contact

      contact%is_touching = .false.
      contact%load = 0.0_wp
      contact%half_width = 0.0_wp
      contact%apparent_area = 0.0_wp
      contact%sheared_area = 0.0_wp
      contact%film_min = 0.0_wp
      contact%film_central = 0.0_wp
      contact%film_ratio = 0.0_wp
      contact%asperity_load = 0.0_wp
      contact%real_area = 0.0_wp
      contact%shear = 0.0_wp
      contact%boundary_capacity = 0.0_wp
      contact%boundary_mobilised = 0.0_wp
      contact%boundary_coefficient = 0.0_wp
      contact%rolling_resistance = 0.0_wp
      contact%film_rise = 0.0_wp
      contact%flash_rise = 0.0_wp
      contact%traction = 0.0_wp
      contact%traction_slope = 0.0_wp
      contact%tangential_force = 0.0_wp
      contact%bearing_torque = contact%bearing_drag
   end subroutine release_contact

end module camroller_contact_state
