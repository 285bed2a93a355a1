!> Energy of a flexible train: what drives it, what is lost, what is stored, and how the three agree.
!>
!> In: everything at a state. Out: powers, each from its own forces and speeds; the stored energy and its rate. Drive and oil
!> gallery less losses less work on the gas less what is stored is round-off at every state, in contact or not.
module camroller_flexible_energy
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_torque, only : contact_power
   use camroller_torque_list, only : torque_count, of_contact, of_needle, of_needle_drag, of_guide, of_damping, &
      & of_gas_damping, of_tip, of_seal, of_guide_side, of_pivot
   use camroller_contact_compliance, only : series_energy
   use camroller_flexible_parts, only : damper_count
   use camroller_spring_modes, only : mode_energy
   use camroller_lash_adjuster, only : relative_volume, bulk_modulus, pressure_work, chamber_volume, oil_energy
   use camroller_flexible_geometry, only : dot, imaginary
   use camroller_flexible_train, only : flexible_state_t, first_mode, at_finger, at_finger_rate, at_lift, at_speed, at_sliding, &
      & at_plunger, at_plunger_rate, at_pressure
   implicit none
   private

   public :: powers_t, evaluate_powers, stored_energy, energy_slopes

   !> Dampers in the order of `damper_series`
   enum, bind(C)
      enumerator :: at_cam = 1, at_pad, at_seat, in_spring, at_plunger_wall, at_stops, through_leak, through_check_valve
   end enum

   !> Powers at a state [W]
   type :: powers_t
      !> Of the cam and of the oil gallery, into the train [W]
      real(wp) :: drive = 0.0_wp, gallery = 0.0_wp
      !> On the gas in the cylinder [W]
      real(wp) :: gas = 0.0_wp
      !> Losses, the rows of `torque_list` [W]; damping, and damping that the gas pays, are together the sum of those below
      real(wp) :: losses(torque_count) = 0.0_wp
      !> Losses of each damper [W]
      real(wp) :: dampers(damper_count) = 0.0_wp
      !> Rate of the energy that is stored: without the roller's spin, and that of the spin [W]
      real(wp) :: stored = 0.0_wp, spin = 0.0_wp
      !> What is left of drive and gallery: round-off [W]
      real(wp) :: residual = 0.0_wp
   end type powers_t

contains

   !> Powers at a state.
   pure subroutine evaluate_powers(model, state, now, powers)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The powers
      type(powers_t), intent(out) :: powers

      integer :: first, i

      associate (contact => now%contact, touch => now%touch, modes => model%flexible%modes)
         powers%drive = model%speed*(contact%load*touch%normal_arm + contact%tangential_force*touch%tangent_arm &
            & + 2.0_wp*contact%rolling_resistance*touch%position%equivalent_radius)
         powers%gas = now%gas_force*state(at_speed)
         powers%losses(of_contact) = contact_power(contact%traction, contact%sliding_speed, contact%rolling_resistance, &
            & contact%cam_surface_speed, contact%roller_surface_speed)
         if (allocated(model%drag)) powers%losses(of_needle_drag) = contact%bearing_drag*contact%relative_spin
         powers%losses(of_needle) = contact%bearing_torque*contact%relative_spin - powers%losses(of_needle_drag)
         powers%losses(of_guide) = now%guide_drag*state(at_speed)**2
         if (allocated(now%joint_friction)) then
            associate (stem => now%joint_friction%stem, ball => now%joint_friction%ball)
               powers%losses([of_tip, of_seal, of_guide_side, of_pivot]) = [now%tip_friction*stem%tip_speed%value, &
                  & stem%seal_friction%value*state(at_speed), stem%side_friction%value*state(at_speed), &
                  & ball%moment*state(at_finger_rate)]
            end associate
         end if
         powers%dampers(at_cam) = (contact%load - now%cam%elastic)*now%cam%rate
         powers%dampers(at_pad) = (now%pad%force - now%pad%elastic)*now%pad%rate
         powers%dampers(at_seat) = (now%seat%force - now%seat%elastic)*now%seat%rate
         powers%dampers(at_stops) = sum((now%stops%force - now%stops%elastic)*now%stops%rate)
         first = first_mode(model)
         if (modes%count > 0) powers%dampers(in_spring) = modes%mass*modes%damping_ratio &
            & *sum(modes%frequency*state(first + 1::2)**2)
         powers%spin = model%roller_inertia*contact%roller_spin*now%spin_acceleration
      end associate
      if (allocated(model%flexible%adjuster)) call add_oil(model, now, powers)
      powers%stored = stored_rate(model, state, now)
      powers%losses(of_gas_damping) = gas_share(model, now)*sum(powers%dampers)
      powers%losses(of_damping) = sum(powers%dampers) - powers%losses(of_gas_damping)
      powers%residual = powers%drive + powers%gallery - powers%gas
      do i = 1, torque_count
         powers%residual = powers%residual - powers%losses(i)
      end do
      powers%residual = powers%residual - powers%spin - powers%stored
   end subroutine evaluate_powers

   !> Part of what dampers take that gas on a closed valve pays: that of the gas in gas and inertia, which bring energy to the seat
   !> and to the finger. The spring gives while the valve sinks what it takes while it rises; inertia brings that of an impact.
   pure function gas_share(model, now) result(share)
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      !> The part [-]
      real(wp) :: share

      share = 0.0_wp
      if (now%gas_force > 0.0_wp .and. now%seat%elastic > 0.0_wp) share = now%gas_force/(now%gas_force &
         & + model%train%valve_mass*abs(now%valve_acceleration))
   end function gas_share

   !> Powers of the oil: from the gallery, and lost in leak, check valve and the plunger's gap.
   pure subroutine add_oil(model, now, powers)
      !> The model, with an adjuster
      type(model_t), intent(in) :: model
      !> Everything at the state
      type(flexible_state_t), intent(in) :: now
      type(powers_t), intent(inout) :: powers

      ! Density over that at ambient pressure [-]; work to the pressures of chamber, supply and leak's end [Pa]
      real(wp) :: density, work, supply_work, end_work

      associate (adjuster => model%flexible%adjuster, flows => now%flows)
         density = 1.0_wp/relative_volume(adjuster%given, now%pressure)
         work = pressure_work(adjuster%given, now%pressure)
         supply_work = pressure_work(adjuster%given, adjuster%supply_pressure)
         end_work = pressure_work(adjuster%given, adjuster%end_pressure)
         powers%gallery = density*(flows%check*supply_work - flows%leak*end_work)
         powers%dampers(through_leak) = density*flows%leak*(work - end_work)
         powers%dampers(through_check_valve) = density*flows%check*(supply_work - work)
         powers%dampers(at_plunger_wall) = adjuster%drag*now%pivot_rate**2
      end associate
   end subroutine add_oil

   !> Rate of the energy that is stored, without the roller's spin.
   pure function stored_rate(model, state, now) result(rate)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The rate [W]
      real(wp) :: rate

      ! Acceleration of a mode [m/s^2]; bulk modulus [Pa], its slope [-], volume [m^3], work over volume [Pa]
      real(wp) :: acceleration, modulus, slope, volume, work
      integer :: n, place

      associate (flexible => model%flexible, modes => model%flexible%modes, finger_rate => state(at_finger_rate))
         rate = model%train%finger_inertia*finger_rate*now%finger_acceleration &
            & + (model%train%valve_mass*now%valve_acceleration + model%train%stiffness*(state(at_lift) &
            & + model%train%precompression))*state(at_speed) + now%cam%elastic*now%cam%rate + now%pad%elastic*now%pad%rate &
            & + now%seat%elastic*now%seat%rate + sum(now%stops%elastic*now%stops%rate)
         place = first_mode(model)
         do n = 1, modes%count
            acceleration = -modes%frequency(n)*(modes%frequency(n)*state(place) + 2.0_wp*modes%damping_ratio*state(place + 1)) &
               & - 2.0_wp*modes%share(n)*now%valve_acceleration
            rate = rate + modes%mass*(modes%share(n)*(now%valve_acceleration*state(place + 1) + state(at_speed)*acceleration) &
               & + 0.5_wp*state(place + 1)*(acceleration + modes%frequency(n)**2*state(place)))
            place = place + 2
         end do
         if (.not. allocated(flexible%adjuster)) return
         rate = rate + ((flexible%finger_mass + flexible%adjuster%given%plunger_mass)*now%pivot_rate &
            & + flexible%finger_mass*now%centre_slope*finger_rate)*now%pivot_acceleration &
            & + flexible%finger_mass*now%pivot_rate*(now%centre_slope*now%finger_acceleration &
            & + now%centre_curvature*finger_rate**2)
         rate = rate - (flexible%adjuster%spring_force - flexible%adjuster%given%spring_stiffness*now%pivot)*now%pivot_rate
         call bulk_modulus(flexible%adjuster%given, now%pressure, modulus, slope)
         volume = chamber_volume(flexible%adjuster, now%pivot)
         work = pressure_work(flexible%adjuster%given, now%pressure)/relative_volume(flexible%adjuster%given, now%pressure)
         rate = rate + flexible%adjuster%area*now%pivot_rate*(work - now%pressure) + volume*work/modulus*now%pressure_rate
      end associate
   end function stored_rate

   !> Energy that is stored, with the roller's spin; zero for the unloaded train with the spring as long as it was before assembly.
   pure function stored_energy(model, state, now) result(energy)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> Energy [J]
      real(wp) :: energy

      integer :: first

      first = first_mode(model)
      associate (flexible => model%flexible, finger_rate => state(at_finger_rate))
         energy = 0.5_wp*(model%train%finger_inertia*finger_rate**2 + model%train%valve_mass*state(at_speed)**2 &
            & + model%train%stiffness*(state(at_lift) + model%train%precompression)**2 &
            & + model%roller_inertia*now%contact%roller_spin**2) &
            & + mode_energy(flexible%modes, state(first::2), state(first + 1::2), state(at_speed)) &
            & + series_energy(flexible%compliance, flexible%finger_stiffness, now%cam%elastic) &
            & + 0.5_wp*(now%pad%elastic**2/flexible%pad_stiffness + now%seat%elastic**2/flexible%seat_stiffness)
         if (.not. allocated(flexible%adjuster)) return
         associate (given => flexible%adjuster%given)
            energy = energy + 0.5_wp*(flexible%finger_mass + given%plunger_mass)*now%pivot_rate**2 &
               & + flexible%finger_mass*now%centre_slope*now%pivot_rate*finger_rate &
               & + 0.5_wp*sum(now%stops%elastic**2)/given%stop_stiffness &
               & - flexible%adjuster%spring_force*now%pivot + 0.5_wp*given%spring_stiffness*now%pivot**2 &
               & + oil_energy(flexible%adjuster, now%pivot, now%pressure)
         end associate
      end associate
   end function stored_energy

   !> Derivatives of the stored energy over the state, the cam's turn and speed as they are.
   pure function energy_slopes(model, state, now) result(slopes)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The derivatives [J over the unit of the component]
      real(wp) :: slopes(size(state))

      ! Angular momentum of the roller over its radius [kg m/s]; bulk modulus [Pa], its slope [-], work over volume [Pa]
      real(wp) :: spin, modulus, slope, work
      integer :: first

      first = first_mode(model)
      associate (flexible => model%flexible, modes => model%flexible%modes, touch => now%touch, coils => state(first::2), &
         & rates => state(first + 1::2))
         spin = model%roller_inertia*now%contact%roller_spin/model%roller_radius
         slopes(at_finger) = -now%cam%elastic*dot(touch%normal, imaginary*touch%arm) &
            & + now%pad%elastic*model%linkage%b*now%pad_sine + spin*travel(imaginary*touch%arm, -state(at_finger_rate)*touch%arm)
         slopes(at_finger_rate) = model%train%finger_inertia*state(at_finger_rate) + spin*dot(touch%forward, imaginary*touch%arm)
         slopes(at_lift) = model%train%stiffness*(state(at_lift) + model%train%precompression) - now%pad%elastic - now%seat%elastic
         slopes(at_speed) = model%train%valve_mass*state(at_speed)
         slopes(at_sliding) = -spin
         if (modes%count > 0) then
            slopes(at_speed) = slopes(at_speed) + modes%mass*sum(modes%share*rates)
            slopes(first::2) = 0.5_wp*modes%mass*modes%frequency**2*coils
            slopes(first + 1::2) = modes%mass*(modes%share*state(at_speed) + 0.5_wp*rates)
         end if
         if (.not. allocated(flexible%adjuster)) return
         associate (given => flexible%adjuster%given)
            slopes(at_finger) = slopes(at_finger) + flexible%finger_mass*now%centre_curvature*now%pivot_rate*state(at_finger_rate)
            slopes(at_finger_rate) = slopes(at_finger_rate) + flexible%finger_mass*now%centre_slope*now%pivot_rate
            call bulk_modulus(given, now%pressure, modulus, slope)
            work = pressure_work(given, now%pressure)/relative_volume(given, now%pressure)
            slopes(at_plunger) = -now%cam%elastic*dot(touch%normal, flexible%axis) - now%pad%elastic*flexible%tilt_cosine &
               & - flexible%adjuster%spring_force + given%spring_stiffness*now%pivot - now%stops(1)%elastic &
               & + now%stops(2)%elastic + flexible%adjuster%area*(work - now%pressure) &
               & + spin*travel(flexible%axis, (0.0_wp, 0.0_wp))
            slopes(at_plunger_rate) = (flexible%finger_mass + given%plunger_mass)*now%pivot_rate &
               & + flexible%finger_mass*now%centre_slope*state(at_finger_rate) + spin*dot(touch%forward, flexible%axis)
            slopes(at_pressure) = chamber_volume(flexible%adjuster, now%pivot)*work/modulus
         end associate
      end associate

   contains

      !> Change of the speed of the roller's centre over the cam [m/s] with its place and its velocity.
      pure function travel(way, velocity) result(change)
         !> Changes of place [m] and velocity [m/s]
         complex(wp), intent(in) :: way, velocity
         !> The change [m/s]
         real(wp) :: change

         associate (touch => now%touch)
            change = touch%position%pitch_curvature/touch%uniqueness*dot(touch%forward, way)*touch%approach_rate &
               & + dot(touch%forward, velocity + imaginary*model%linkage%sense*model%speed*way)
         end associate
      end function travel

   end function energy_slopes

end module camroller_flexible_energy
