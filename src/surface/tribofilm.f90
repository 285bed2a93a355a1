!> Growth of a tribofilm on a surface, and its removal, while the surface is in contact.
!>
!> In: stress, temperature, time in contact. Out: rates, thickness after a time.
!> Growth is a reaction that stress and heat activate: Gosvami, Bares, Mangolini, Konicek, Yablon and Carpick (2015), Science 348,
!> 102-106; Zhang and Spikes (2016), Tribol. Lett. 63, 24. `dh/dt = k_g exp(-(E_a - tau v_a)/(k_B T)) (1 - h/h_max) - k_w h`.
module camroller_tribofilm
   use camroller_kinds, only : wp, gas_constant
   implicit none
   private

   public :: tribofilm_t, running_in_t, growth_rate, thickness_after

   !> A film that grows
   type :: tribofilm_t
      !> Rate without a barrier, k_g [m/s]
      real(wp) :: growth_rate = 0.0_wp
      !> Height of the barrier, E_a [J/mol], and the volume over which shear stress lowers it, v_a [m^3]
      real(wp) :: activation_energy = 0.0_wp, activation_volume = 0.0_wp
      !> Rate at which contact removes the film, relative to its thickness, k_w [1/s]
      real(wp) :: removal_rate = 0.0_wp
      !> Thickness at which growth ends, h_max [m]
      real(wp) :: largest_thickness = 0.0_wp
      !> Its roughness over its thickness [-]
      real(wp) :: roughness_ratio = 0.0_wp
      !> Friction coefficient of asperities that it covers [-]
      real(wp) :: coefficient = 0.0_wp
   end type tribofilm_t

   !> Hours of running before the cycle that is the result
   type :: running_in_t
      !> How long [s]
      real(wp) :: duration = 0.0_wp
      !> Error allowed for thickness and depth after that, relative to the largest possible thickness and to the largest depth [-]
      real(wp) :: accuracy = 1.0e-3_wp
      !> Places on the cam
      integer :: places = 360
   end type running_in_t

   !> Avogadro constant, exact since 2019 [1/mol]
   real(wp), parameter :: avogadro = 6.02214076e23_wp

contains

   !> Growth of a bare surface in contact, `k_g exp(-(E_a - tau v_a)/(k_B T))`; k_g where the stress takes all of the barrier away.
   elemental function growth_rate(film, shear_stress, temperature) result(rate)
      !> The film
      type(tribofilm_t), intent(in) :: film
      !> Shear stress in the contact, of either sign [Pa]; temperature of the surfaces [K]
      real(wp), intent(in) :: shear_stress, temperature
      !> The rate [m/s]
      real(wp) :: rate

      ! What is left of the barrier [J/mol]
      real(wp) :: barrier

      barrier = film%activation_energy - avogadro*film%activation_volume*abs(shear_stress)
      rate = film%growth_rate*exp(-max(barrier, 0.0_wp)/(gas_constant*temperature))
   end function growth_rate

   !> Thickness after a time in which `dh/dt = a - b h`: `h = a/b + (h_0 - a/b) exp(-b t)`.
   elemental function thickness_after(start, growth, decay, time) result(thickness)
      !> Thickness at first, h_0 [m]; rate of growth, a [m/s]; rate of decay, b >= 0 [1/s]; time, t [s]
      real(wp), intent(in) :: start, growth, decay, time
      !> Thickness [m]
      real(wp) :: thickness

      ! Part of what decays that is gone, over b t [-]
      real(wp) :: mean

      associate (x => decay*time)
         ! Its power series where the difference would cancel; the next term is x^3/24, at most 5e-14
         mean = 1.0_wp - x*(0.5_wp - x/6.0_wp)
         if (x > 1.0e-4_wp) mean = (1.0_wp - exp(-x))/x
         thickness = start*exp(-x) + growth*time*mean
      end associate
   end function thickness_after

end module camroller_tribofilm
