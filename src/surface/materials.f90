!> The two bodies in contact: elasticity and surface finish.
!>
!> In: moduli, Poisson ratios, roughness of each body. Out: their combined values.
module camroller_materials
   use camroller_kinds, only : wp
   implicit none
   private

   public :: materials_t, surface_t, combined_modulus, combined_roughness

   !> Elasticity of cam and roller
   type :: materials_t
      !> Young's modulus of the cam [Pa]
      real(wp) :: cam_modulus = 0.0_wp
      !> Young's modulus of the roller [Pa]
      real(wp) :: roller_modulus = 0.0_wp
      !> Poisson's ratio of the cam [-]
      real(wp) :: cam_poisson_ratio = 0.0_wp
      !> Poisson's ratio of the roller [-]
      real(wp) :: roller_poisson_ratio = 0.0_wp
      !> Hardness of the softer body [Pa]; zero where not given (needed by the rough film law and by asperities that yield)
      real(wp) :: hardness = 0.0_wp
   end type materials_t

   !> Surface finish of cam and roller
   type :: surface_t
      !> Root mean square roughness of the cam [m]
      real(wp) :: cam_roughness = 0.0_wp
      !> Root mean square roughness of the roller [m]
      real(wp) :: roller_roughness = 0.0_wp
   end type surface_t

contains

   !> Equivalent modulus of two elastic bodies, `2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2`.
   !>
   !> Source: Hertz (1881), in the form of Islam (2019) eq. (28).
   elemental function combined_modulus(modulus_1, poisson_ratio_1, modulus_2, poisson_ratio_2) result(combined)
      !> Young's modulus of the first body [Pa]
      real(wp), intent(in) :: modulus_1
      !> Poisson's ratio of the first body [-]
      real(wp), intent(in) :: poisson_ratio_1
      !> Young's modulus of the second body [Pa]
      real(wp), intent(in) :: modulus_2
      !> Poisson's ratio of the second body [-]
      real(wp), intent(in) :: poisson_ratio_2
      !> Equivalent modulus E' [Pa]
      real(wp) :: combined

      combined = 2.0_wp/((1.0_wp - poisson_ratio_1**2)/modulus_1 + (1.0_wp - poisson_ratio_2**2)/modulus_2)
   end function combined_modulus

   !> Root mean square roughness of two uncorrelated surfaces seen as one.
   !>
   !> Source: Islam (2019) eq. (32).
   elemental function combined_roughness(roughness_1, roughness_2) result(combined)
      !> Root mean square roughness of the first surface [m]
      real(wp), intent(in) :: roughness_1
      !> Root mean square roughness of the second surface [m]
      real(wp), intent(in) :: roughness_2
      !> Composite roughness sigma [m]
      real(wp) :: combined

      combined = sqrt(roughness_1**2 + roughness_2**2)
   end function combined_roughness

end module camroller_materials
