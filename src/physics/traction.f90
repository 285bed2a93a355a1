module camroller_traction
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: traction_t, shear_law_names, cap_names, rolling_law_names

   !> Shear of the film
   character(len=*), parameter :: shear_law_names(*) = [character(len=name_length) :: "newtonian", "eyring"]
   !> How the limiting traction is approached
   character(len=*), parameter :: cap_names(*) = [character(len=name_length) :: "smooth", "sharp"]
   !> Rolling resistance
   character(len=*), parameter :: rolling_law_names(*) = [character(len=name_length) :: &
      "biboulet_houpert", "goksem_hargreaves", "none"]

   !> Friction of the film
   type :: traction_t
      !> One of `shear_law_names`
      character(len=name_length) :: shear_law = "newtonian"
      !> Eyring stress of the oil [Pa]; law `eyring`
      real(wp) :: eyring_stress = 0.0_wp
      !> Limiting traction coefficient of the film [-]
      real(wp) :: limiting_coefficient = 0.08_wp
      !> One of `cap_names`
      character(len=name_length) :: cap = "smooth"
      !> One of `rolling_law_names`
      character(len=name_length) :: rolling_law = "biboulet_houpert"
      !> Does rolling resistance act on the roller's spin?
      logical :: in_roller_balance = .true.
   end type traction_t

end module camroller_traction
