module camroller_asperity
   use camroller_kinds, only : wp
   use camroller_names, only : name_length
   implicit none
   private

   public :: asperity_t, boundary_names

   !> Boundary friction that is counted: all of it, or what the slip mobilises
   character(len=*), parameter :: boundary_names(*) = [character(len=name_length) :: "mobilised", "full"]

   !> Asperities and their friction
   type :: asperity_t
      !> Product of asperity density, tip radius and roughness, eta beta sigma [-]
      real(wp) :: roughness_product = 0.04_wp
      !> Roughness over tip radius, sigma/beta [-]
      real(wp) :: roughness_over_tip_radius = 0.01_wp
      !> Friction coefficient of touching asperities, mu_B [-]
      real(wp) :: boundary_coefficient = 0.0_wp
      !> Shear strength of the surface film on the real contact area, tau_0 [Pa]
      real(wp) :: film_shear_strength = 0.0_wp
      !> One of `boundary_names`
      character(len=name_length) :: boundary = "mobilised"
      !> Sliding speed that mobilises boundary friction, v_b [m/s]
      real(wp) :: mobilising_speed = 1.0e-3_wp
   end type asperity_t

end module camroller_asperity
