!> Wear of cam and roller, and the stress below their surfaces.
!>
!> In: load, speeds and width of the contact. Out: sliding distance, depth that is worn away, stresses.
!> Sources: Archard (1953), J. Appl. Phys. 24, 981-988: depth k p s for a pressure p over a sliding distance s. Johnson (1985),
!> Contact Mechanics, section 4.2: stresses below a line contact without traction.
module camroller_wear
   use camroller_kinds, only : wp
   implicit none
   private

   public :: wear_t, time_in_contact, sliding_distance, worn_per_second
   public :: largest_shear, orthogonal_shear

   !> Specific wear rates: volume worn away over load and sliding distance
   type :: wear_t
      !> Of the cam and of the roller [m^2/N]
      real(wp) :: cam_rate = 0.0_wp, roller_rate = 0.0_wp
   end type wear_t

   !> Largest shear stress below a line contact over the peak pressure: the largest of `z - z^2/sqrt(1 + z^2)` over the depth z [-]
   real(wp), parameter :: largest_shear = 0.3002831060007776_wp
   !> The same of the amplitude of the shear stress along the surface, which changes its sign in a passage [-]
   real(wp), parameter :: orthogonal_shear = 0.25_wp

contains

   !> Part of the time in which a place of a surface is in contact: the contact of a width 2 b passes it at a speed, once a period.
   elemental function time_in_contact(half_width, speed, period) result(part)
      !> Half width, b [m], speed of the contact over the surface, of either sign [m/s]
      real(wp), intent(in) :: half_width, speed
      !> Time between passages [s]
      real(wp), intent(in) :: period
      !> The part; not more than all of it [-]
      real(wp) :: part

      part = 1.0_wp
      if (2.0_wp*half_width < abs(speed)*period) part = 2.0_wp*half_width/(abs(speed)*period)
   end function time_in_contact

   !> Distance that the other surface slides over a place of a surface in a passage.
   elemental function sliding_distance(half_width, sliding_speed, speed, period) result(distance)
      !> Half width [m], sliding speed and speed of the contact over the surface, of either sign [m/s]
      real(wp), intent(in) :: half_width, sliding_speed, speed
      !> Time between passages [s]
      real(wp), intent(in) :: period
      !> Distance [m]
      real(wp) :: distance

      distance = abs(sliding_speed)*time_in_contact(half_width, speed, period)*period
   end function sliding_distance

   !> Depth that wears away in a second where the contact is all of the time: the rate times the mean pressure on asperities times
   !> the sliding speed.
   elemental function worn_per_second(rate, asperity_load, area, sliding_speed) result(depth)
      !> Specific wear rate [m^2/N]
      real(wp), intent(in) :: rate
      !> Load on asperities [N], apparent area [m^2], sliding speed of either sign [m/s]
      real(wp), intent(in) :: asperity_load, area, sliding_speed
      !> Depth [m/s]
      real(wp) :: depth

      depth = 0.0_wp
      if (area > 0.0_wp) depth = rate*asperity_load/area*abs(sliding_speed)
   end function worn_per_second

end module camroller_wear
