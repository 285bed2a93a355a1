!> What the temperature along a solved contact depends on, from the model.
!>
!> In: model with heat, speeds of the surfaces. Out: `ehl_heat_t`.
module camroller_contact_heat
   use camroller_asperity, only : boundary_friction_t, find_boundary_friction
   use camroller_ehl_problem, only : ehl_heat_t
   use camroller_heat, only : inlet_none
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_stick, only : has_stick
   use camroller_traction, only : mobilised_share, sliding_direction
   implicit none
   private

   public :: has_hot_contact, set_heat

contains

   !> Does heat change the contact? Solved contacts know no half of it: that of the inlet and that of the contact are one.
   pure function has_hot_contact(model) result(verdict)
      !> The model
      type(model_t), intent(in) :: model
      !> Does it?
      logical :: verdict

      verdict = .false.
      if (allocated(model%heat)) verdict = model%heat%has_contact .or. model%heat%inlet_law /= inlet_none
   end function has_hot_contact

   !> What the temperature along the contact depends on.
   pure subroutine set_heat(model, surface_speed, sliding_speed, rise, heat)
      !> The model, with heat
      type(model_t), intent(in) :: model
      !> Speed of the cam's surface over the contact point, sliding speed [m/s]
      real(wp), intent(in) :: surface_speed, sliding_speed
      !> Rise of the surfaces' temperature where asperities touch [K]
      real(wp), intent(in) :: rise
      !> What follows
      type(ehl_heat_t), intent(out) :: heat

      type(boundary_friction_t) :: friction
      ! Part of boundary friction that slip mobilises [-]
      real(wp) :: part

      heat%hot = model%heat%hot
      heat%bodies = model%heat%bodies
      heat%speeds = sign(1.0_wp, surface_speed - 0.5_wp*sliding_speed)*[surface_speed, surface_speed - sliding_speed]
      heat%conductivity = model%heat%oil_conductivity
      heat%capacity = model%heat%oil_capacity
      heat%expansion = model%heat%oil_expansion
      heat%temperature = model%heat%temperature
      heat%limiting_coefficient = model%limiting_coefficient
      heat%limit_fall = model%heat%limit_fall
      heat%has_local_limit = model%has_local_limit
      heat%limiting_stress = model%limiting_stress
      heat%cap = model%cap
      if (.not. allocated(model%boundary)) return
      call find_boundary_friction(model%boundary, sliding_speed, rise, 0.0_wp, friction)
      part = abs(sliding_direction(sliding_speed))
      if (.not. has_stick(model)) part = abs(mobilised_share(sliding_speed, model%boundary%mobilising_speed))
      heat%boundary_coefficient = friction%coefficient*part
      heat%boundary_stress = model%boundary%film_shear_strength*part
   end subroutine set_heat

end module camroller_contact_heat
