!> Steady contacts: two that are timed, and the whole range for which solutions are asked.
module bench_contacts
   use camroller_kinds, only : wp
   use camroller_lubricant, only : law_barus, law_roelands
   use camroller_ehl_problem, only : ehl_contact_t
   implicit none
   private

   public :: contact_of_kind, contact_of_groups, range_size

   !> Materials, loads, speeds, viscosity laws in the range, and all of them
   integer, parameter :: material_count = 5, load_count = 7, speed_count = 9, law_count = 3, &
      & range_size = material_count*load_count*speed_count*law_count
   !> G of the range [-]
   real(wp), parameter :: materials(material_count) = [1000.0_wp, 2000.0_wp, 3000.0_wp, 4500.0_wp, 7500.0_wp]

contains

   !> A soft contact of large rollers, and the nose of a cam at 300 rev/min and 60 degC.
   function contact_of_kind(kind) result(contact)
      !> 1 or 2
      integer, intent(in) :: kind
      !> The contact
      type(ehl_contact_t) :: contact

      if (kind == 1) then
         contact%radius = 0.02_wp
         contact%line_load = 5.0e4_wp
         contact%entrainment_speed = 1.5_wp
         contact%modulus = 2.21e11_wp
         contact%oil%viscosity = 0.02_wp
         contact%oil%roelands_index = 0.68_wp
      else
         contact%radius = 0.004116_wp
         contact%line_load = 54073.0_wp
         contact%entrainment_speed = 0.4884_wp
         contact%modulus = 2.01798e11_wp
         contact%oil%viscosity = 0.0305_wp
         contact%oil%roelands_index = 0.69802_wp
      end if
      contact%oil%pressure_law = law_roelands
      contact%oil%roelands_exponent = log(contact%oil%viscosity) + 9.67_wp
      contact%oil%pressure_viscosity = contact%oil%roelands_index*contact%oil%roelands_exponent*5.1e-9_wp
   end function contact_of_kind

   !> A contact of the range by its number: the law changes first, then speed, load, material.
   subroutine contact_of_groups(number, contact, groups, law)
      !> 1 to `range_size`
      integer, intent(in) :: number
      !> The contact
      type(ehl_contact_t), intent(out) :: contact
      !> W*, U, G [-]
      real(wp), intent(out) :: groups(3)
      !> Viscosity law
      integer, intent(out) :: law

      integer :: rest

      rest = number - 1
      law = law_barus + modulo(rest, law_count)
      rest = rest/law_count
      groups(2) = 10.0_wp**(-13.0_wp + 0.5_wp*modulo(rest, speed_count))
      rest = rest/speed_count
      groups(1) = 10.0_wp**(-6.0_wp + 0.5_wp*modulo(rest, load_count))
      groups(3) = materials(1 + rest/load_count)
      ! Softer where steel would be beyond 1.5 GPa, as contacts with that W* are
      contact%modulus = merge(2.2e11_wp, 5.0e10_wp, groups(1) < 2.0e-4_wp)
      contact%radius = 0.01_wp
      contact%line_load = groups(1)*contact%modulus*contact%radius
      contact%oil%viscosity = 0.04_wp
      contact%entrainment_speed = groups(2)*contact%modulus*contact%radius/contact%oil%viscosity
      contact%oil%pressure_law = law
      contact%oil%pressure_viscosity = groups(3)/contact%modulus
      contact%oil%roelands_exponent = log(contact%oil%viscosity) + 9.67_wp
      contact%oil%roelands_index = contact%oil%pressure_viscosity/(5.1e-9_wp*contact%oil%roelands_exponent)
   end subroutine contact_of_groups

end module bench_contacts
