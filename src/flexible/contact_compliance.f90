!> Contacts that give way: cam and roller in series with the finger's bending; pad, seat and stops as one-sided springs, each with
!> a damping that is proportional to the force it carries.
!>
!> In: approaches and their rates. Out: forces with derivatives, stored energies, restitution.
!> Sources: Palmgren (1959) for the approach of a line contact, 3.84e-5 Q^0.9/l^0.8 in mm and N for steel; Hunt and Crossley,
!> J. Applied Mechanics 42 (1975) 440, for the damping.
module camroller_contact_compliance
   use camroller_kinds, only : wp
   implicit none
   private

   public :: line_compliance, line_approach, series_approach, series_load, series_energy, damping_factor, &
      & one_sided_force, restitution
   public :: damping_of_restitution

   !> Power of the load in Palmgren's approach [-]
   real(wp), parameter :: power = 0.9_wp
   !> Approach over Q^0.9/l^0.8 for steel on steel [m/N^0.9 m^0.8]: 3.84e-8 m mm^0.8/N^0.9
   real(wp), parameter :: steel_approach = 1.5287e-10_wp
   !> Equivalent modulus of steel on steel that it stands for [Pa]
   real(wp), parameter :: steel_modulus = 226.4e9_wp
   !> Steps of Newton's method at most; it is monotone and takes three to six
   integer, parameter :: most_steps = 40

contains

   !> Approach of a line contact over its load to the power 0.9, scaled to the equivalent modulus.
   elemental function line_compliance(modulus, length) result(compliance)
      !> Equivalent modulus, E' [Pa]
      real(wp), intent(in) :: modulus
      !> Length of the contact [m]
      real(wp), intent(in) :: length
      !> c_H [m/N^0.9]
      real(wp) :: compliance

      compliance = steel_approach*(steel_modulus/modulus)**power/length**0.8_wp
   end function line_compliance

   !> Approach of a line contact, `c_H W^0.9`.
   elemental function line_approach(compliance, load) result(approach)
      !> c_H [m/N^0.9]
      real(wp), intent(in) :: compliance
      !> Load, W [N]
      real(wp), intent(in) :: load
      !> The approach [m]
      real(wp) :: approach

      approach = compliance*load**power
   end function line_approach

   !> Approach of a line contact in series with a spring, `c_H W^0.9 + W/k_b`.
   elemental function series_approach(compliance, stiffness, load) result(approach)
      !> c_H [m/N^0.9]
      real(wp), intent(in) :: compliance
      !> k_b [N/m]
      real(wp), intent(in) :: stiffness
      !> Load, W [N]
      real(wp), intent(in) :: load
      !> The approach [m]
      real(wp) :: approach

      approach = line_approach(compliance, load) + load/stiffness
   end function series_approach

   !> Elastic load of a line contact in series with a spring, `delta = c_H W^0.9 + W/k_b`; zero without approach.
   !>
   !> Newton's method on u = W^0.1 from above the root, where the function is convex and rising.
   elemental subroutine series_load(compliance, stiffness, approach, load, slope)
      !> c_H [m/N^0.9]
      real(wp), intent(in) :: compliance
      !> k_b [N/m]
      real(wp), intent(in) :: stiffness
      !> Approach, delta [m]
      real(wp), intent(in) :: approach
      !> Load, W_e [N]
      real(wp), intent(out) :: load
      !> Its derivative over the approach [N/m]
      real(wp), intent(out) :: slope

      ! W^0.1 [N^0.1], its powers 8 and 9, change of it
      real(wp) :: u, u8, u9, change
      integer :: i

      load = 0.0_wp
      slope = 0.0_wp
      if (.not. approach > 0.0_wp) return
      u = min((approach/compliance)**(1.0_wp/9.0_wp), (approach*stiffness)**0.1_wp)
      do i = 1, most_steps
         u8 = ((u*u)**2)**2
         u9 = u8*u
         change = (compliance*u9 + u9*u/stiffness - approach)/(9.0_wp*compliance*u8 + 10.0_wp*u9/stiffness)
         u = u - change
         if (change <= 4.0_wp*epsilon(u)*u) exit
      end do
      u9 = ((u*u)**2)**2*u
      load = u9*u
      slope = 1.0_wp/(power*compliance/u + 1.0_wp/stiffness)
   end subroutine series_load

   !> Energy stored by that contact and spring.
   elemental function series_energy(compliance, stiffness, load) result(energy)
      !> c_H [m/N^0.9]
      real(wp), intent(in) :: compliance
      !> k_b [N/m]
      real(wp), intent(in) :: stiffness
      !> Elastic load, W_e [N]
      real(wp), intent(in) :: load
      !> Energy [J]
      real(wp) :: energy

      energy = compliance*power/(1.0_wp + power)*load**(1.0_wp + power) + 0.5_wp*load**2/stiffness
   end function series_energy

   !> Force over its elastic part, `max(0, 1 + a rate)`: nothing sticks.
   elemental function damping_factor(damping, rate) result(factor)
      !> Damping, a [s/m]
      real(wp), intent(in) :: damping
      !> Rate of approach [m/s]
      real(wp), intent(in) :: rate
      !> Factor [-]
      real(wp) :: factor

      factor = max(0.0_wp, 1.0_wp + damping*rate)
   end function damping_factor

   !> Force of a spring that only pushes, `k max(delta, 0) max(0, 1 + a rate)`.
   elemental subroutine one_sided_force(stiffness, damping, approach, rate, force, elastic, by_approach, by_rate)
      !> k [N/m]
      real(wp), intent(in) :: stiffness
      !> a [s/m]
      real(wp), intent(in) :: damping
      !> delta [m]
      real(wp), intent(in) :: approach
      !> Its rate [m/s]
      real(wp), intent(in) :: rate
      !> Force and its elastic part [N]
      real(wp), intent(out) :: force, elastic
      !> Derivatives of the force over approach [N/m] and rate [N s/m]
      real(wp), intent(out) :: by_approach, by_rate

      ! Force over its elastic part [-]
      real(wp) :: factor

      force = 0.0_wp
      elastic = 0.0_wp
      by_approach = 0.0_wp
      by_rate = 0.0_wp
      if (.not. approach > 0.0_wp) return
      elastic = stiffness*approach
      factor = damping_factor(damping, rate)
      force = elastic*factor
      by_approach = stiffness*factor
      if (factor > 0.0_wp) by_rate = elastic*damping
   end subroutine one_sided_force

   !> Speed after an impact over the speed before, for any elastic law: `D (1 + e) = ln((1 + D)/(1 - D e))`, D damping times speed.
   elemental function restitution(number) result(ratio)
      !> D [-]
      real(wp), intent(in) :: number
      !> e [-]
      real(wp) :: ratio

      ! Bracket of D e, its middle, the function there [-]
      real(wp) :: low, high, middle, value
      integer :: i

      ratio = 1.0_wp
      if (number < 1.0e-6_wp) then
         ratio = 1.0_wp - 2.0_wp*number/3.0_wp
         return
      end if
      low = 0.0_wp
      high = min(number, 1.0_wp)
      do i = 1, 60
         middle = 0.5_wp*(low + high)
         value = 1.0_wp
         if (middle < 1.0_wp) value = log((1.0_wp + number)/(1.0_wp - middle)) - number - middle
         if (value < 0.0_wp) low = middle
         if (value >= 0.0_wp) high = middle
      end do
      ratio = 0.5_wp*(low + high)/number
   end function restitution

   !> Damping that makes a body leave with a given part of the speed at which it arrives.
   elemental function damping_of_restitution(ratio, speed) result(damping)
      !> e, between 0 and 1 [-]
      real(wp), intent(in) :: ratio
      !> Speed of arrival [m/s]
      real(wp), intent(in) :: speed
      !> a [s/m]
      real(wp) :: damping

      ! Bracket of ln(D), its middle [-]
      real(wp) :: low, high, middle
      integer :: i

      low = log(1.0e-9_wp)
      high = log(1.0e6_wp)
      do i = 1, 60
         middle = 0.5_wp*(low + high)
         if (restitution(exp(middle)) > ratio) then
            low = middle
         else
            high = middle
         end if
      end do
      damping = exp(0.5_wp*(low + high))/speed
   end function damping_of_restitution

end module camroller_contact_compliance
