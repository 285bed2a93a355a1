!> Rough surfaces in contact: load and real area of the touching asperities.
!>
!> Layer: physics. In: film thickness over roughness, roughness constants, equivalent modulus, apparent area. Out:
!> asperity load and real contact area with their derivatives.
!> Source: Greenwood and Tripp (1970), Proc. Instn Mech. Engrs 185, 625-633; Islam (2019) eqs. (34)-(36) with
!> (eta beta sigma) squared in the real area, too.
module camroller_asperity
   use camroller_kinds, only : wp, pi
   use camroller_names, only : name_length
   use camroller_greenwood_tripp, only : integral_2, integral_5_2, largest_film_ratio
   implicit none
   private

   public :: asperity_t, asperity_constants_t, boundary_names, mobilisation_names, largest_film_ratio
   public :: new_asperity_constants, asperity_load_function, asperity_area_function
   public :: asperity_load, asperity_area

   !> Boundary friction that is counted: all of it, or what the slip mobilises
   character(len=*), parameter :: boundary_names(*) = [character(len=name_length) :: "mobilised", "full"]
   !> How slip mobilises boundary friction: growing with the sliding speed, or at once, with any part of it at rest
   character(len=*), parameter :: mobilisation_names(*) = [character(len=name_length) :: "regularised", "stick_slip"]

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
      !> One of `mobilisation_names`
      character(len=name_length) :: mobilisation = "regularised"
      !> Sliding speed that mobilises regularised boundary friction, v_b [m/s]
      real(wp) :: mobilising_speed = 1.0e-3_wp
   end type asperity_t

   !> What a contact needs of the asperities
   type :: asperity_constants_t
      !> Asperity load over apparent area and F_5/2 [Pa]
      real(wp) :: load_factor = 0.0_wp
      !> Real over apparent area and F_2 [-]
      real(wp) :: area_factor = 0.0_wp
   end type asperity_constants_t

contains

   !> Derive the constants of a pair of surfaces.
   pure subroutine new_asperity_constants(constants, asperity, modulus)
      !> The constants
      type(asperity_constants_t), intent(out) :: constants
      !> Asperities
      type(asperity_t), intent(in) :: asperity
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus

      constants%load_factor = load_factor(asperity%roughness_product, asperity%roughness_over_tip_radius, modulus)
      constants%area_factor = area_factor(asperity%roughness_product)
   end subroutine new_asperity_constants

   !> Asperity load over its value per unit of F_5/2: F_5/2 and its derivative.
   elemental subroutine asperity_load_function(film_ratio, value, slope)
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> F_5/2 [-]
      real(wp), intent(out) :: value
      !> Derivative with respect to the film ratio [-]
      real(wp), intent(out) :: slope

      call integral_5_2(film_ratio, value, slope)
   end subroutine asperity_load_function

   !> Real area over its value per unit of F_2: F_2 and its derivative.
   elemental subroutine asperity_area_function(film_ratio, value, slope)
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> F_2 [-]
      real(wp), intent(out) :: value
      !> Derivative with respect to the film ratio [-]
      real(wp), intent(out) :: slope

      call integral_2(film_ratio, value, slope)
   end subroutine asperity_area_function

   !> Load on the asperities, `W_a = (8 sqrt(2)/15) pi (eta beta sigma)^2 sqrt(sigma/beta) E' A_a F_5/2(h/sigma)`.
   elemental subroutine asperity_load(film_ratio, roughness_product, roughness_over_tip_radius, modulus, area, &
      load, slope)
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> sigma/beta [-]
      real(wp), intent(in) :: roughness_over_tip_radius
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Apparent contact area, A_a [m^2]
      real(wp), intent(in) :: area
      !> Load, W_a [N]
      real(wp), intent(out) :: load
      !> Derivative of the load with respect to the film ratio [N]
      real(wp), intent(out) :: slope

      !> Load for F_5/2 = 1 [N]
      real(wp) :: scale

      scale = load_factor(roughness_product, roughness_over_tip_radius, modulus)*area
      call integral_5_2(film_ratio, load, slope)
      load = scale*load
      slope = scale*slope
   end subroutine asperity_load

   !> Real contact area, `A_r = pi^2 (eta beta sigma)^2 A_a F_2(h/sigma)`.
   elemental subroutine asperity_area(film_ratio, roughness_product, area, real_area, slope)
      !> Film thickness over roughness, h/sigma >= 0 [-]
      real(wp), intent(in) :: film_ratio
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> Apparent contact area, A_a [m^2]
      real(wp), intent(in) :: area
      !> Real contact area, A_r [m^2]
      real(wp), intent(out) :: real_area
      !> Derivative of the real area with respect to the film ratio [m^2]
      real(wp), intent(out) :: slope

      !> Real area for F_2 = 1 [m^2]
      real(wp) :: scale

      scale = area_factor(roughness_product)*area
      call integral_2(film_ratio, real_area, slope)
      real_area = scale*real_area
      slope = scale*slope
   end subroutine asperity_area

   !> Asperity load over apparent area and F_5/2.
   elemental function load_factor(roughness_product, roughness_over_tip_radius, modulus) result(factor)
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> sigma/beta [-]
      real(wp), intent(in) :: roughness_over_tip_radius
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> The factor [Pa]
      real(wp) :: factor

      factor = 8.0_wp*sqrt(2.0_wp)/15.0_wp*pi*roughness_product**2*sqrt(roughness_over_tip_radius)*modulus
   end function load_factor

   !> Real over apparent area and F_2.
   elemental function area_factor(roughness_product) result(factor)
      !> eta beta sigma [-]
      real(wp), intent(in) :: roughness_product
      !> The factor [-]
      real(wp) :: factor

      factor = (pi*roughness_product)**2
   end function area_factor

end module camroller_asperity
