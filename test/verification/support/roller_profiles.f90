!> Profiles of rollers for tests.
module roller_profiles
   use camroller_kinds, only : wp
   use camroller_roller_profile, only : roller_profile_t
   implicit none
   private

   public :: profiles

contains

   !> A few profiles.
   pure function profiles(number) result(profile)
      !> Which
      integer, intent(in) :: number
      !> The profile
      type(roller_profile_t) :: profile

      select case (number)
      case (1)
         profile%profile = "crowned"
         profile%crown_radius = 3.0_wp
      case (2)
         profile%profile = "logarithmic"
         profile%design_load = 600.0_wp
         profile%end_drop = 5.0e-6_wp
      case (3)
         profile%profile = "crowned"
         profile%crown_radius = 2.0_wp
         profile%tilt = 4.0e-4_wp
      case (4)
         profile%tilt = 2.0e-4_wp
         profile%coupling = "none"
      end select
   end function profiles

end module roller_profiles
