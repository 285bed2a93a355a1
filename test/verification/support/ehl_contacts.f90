!> Line contacts that the tests of the numerical film solve.
module ehl_contacts
   use camroller_kinds, only : wp
   use camroller_lubricant, only : law_roelands
   use camroller_ehl_problem, only : ehl_contact_t
   implicit none
   private

   public :: contact_of_groups, contact_of_row

   !> Reference pressure of Roelands' law [Pa] and ln of its reference viscosity with its sign changed [-]
   real(wp), parameter :: roelands_pressure = 1.0_wp/5.1e-9_wp, roelands_constant = 9.67_wp

contains

   !> Contact with given groups W*, U, G; steel and an ordinary oil unless told otherwise.
   pure function contact_of_groups(load, speed, material, modulus, viscosity, law) result(contact)
      !> W*, U, G [-]
      real(wp), intent(in) :: load, speed, material
      !> E' [Pa], viscosity at ambient pressure [Pa s]
      real(wp), intent(in), optional :: modulus, viscosity
      !> Position in `pressure_law_names`; Roelands where absent
      integer, intent(in), optional :: law
      !> The contact
      type(ehl_contact_t) :: contact

      contact%modulus = 2.2e11_wp
      if (present(modulus)) contact%modulus = modulus
      contact%oil%viscosity = 0.04_wp
      if (present(viscosity)) contact%oil%viscosity = viscosity
      contact%oil%pressure_law = law_roelands
      if (present(law)) contact%oil%pressure_law = law
      contact%radius = 0.01_wp
      contact%line_load = load*contact%modulus*contact%radius
      contact%entrainment_speed = speed*contact%modulus*contact%radius/contact%oil%viscosity
      contact%oil%pressure_viscosity = material/contact%modulus
      contact%oil%roelands_exponent = log(contact%oil%viscosity) + roelands_constant
      contact%oil%roelands_index = contact%oil%pressure_viscosity*roelands_pressure/contact%oil%roelands_exponent
   end function contact_of_groups

   !> Contact of a row of `line_contacts.csv`.
   pure function contact_of_row(row) result(contact)
      !> radius, load, speed, modulus, viscosity, Roelands' index, ... as in the file
      real(wp), intent(in) :: row(:)
      !> The contact
      type(ehl_contact_t) :: contact

      contact%radius = row(1)
      contact%line_load = row(2)
      contact%entrainment_speed = row(3)
      contact%modulus = row(4)
      contact%oil%viscosity = row(5)
      contact%oil%pressure_law = law_roelands
      contact%oil%roelands_index = row(6)
      contact%oil%roelands_exponent = log(contact%oil%viscosity) + roelands_constant
      contact%oil%pressure_viscosity = row(6)*contact%oil%roelands_exponent/roelands_pressure
   end function contact_of_row

end module ehl_contacts
