module camroller_needle
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: needle_bearing_t, roller_bearing_names

   !> What the roller turns on
   character(len=*), parameter :: roller_bearing_names(*) = [character(len=name_length) :: "needles", "plain_pin"]

   !> Bearing between roller and pin
   type :: needle_bearing_t
      !> One of `roller_bearing_names`
      character(len=name_length) :: kind = "needles"
      !> Friction coefficient, mu_p [-]
      real(wp) :: friction_coefficient = 0.0_wp
      !> Radius of a needle [m]; kind `needles`
      real(wp) :: needle_radius = 0.0_wp
      !> Reversal of the torque is spread over this part of the cam's speed [-]
      real(wp) :: reversal_ratio = 0.01_wp
   end type needle_bearing_t

end module camroller_needle
