!> The contact at one cam angle and one sliding speed: load, film, load share, traction and torque of the roller's bearing,
!> solved simultaneously.
!>
!> In: model, geometry, moments, sliding speed. Out: `contact_t`. The load is the one at which the finger is in equilibrium with
!> the traction, rolling resistance, bearing torque and friction of the pivot that this load causes: one equation in the load,
!> solved by Newton's method with the exact derivative from `contact_forces`, safeguarded by a bracket.
module camroller_contact
   use camroller_kinds, only : wp
   use camroller_hertz, only : half_width
   use camroller_model, only : model_t
   use camroller_kinematics, only : position_t
   use camroller_dynamics, only : moments_t
   use camroller_dual, only : dual_t
   use camroller_joint_forces, only : find_contact_moment, has_pivot_friction, joint_basis_t
   use camroller_pivot_friction, only : pivot_forces_t, pivot_moment, hold_forces
   use camroller_contact_forces, only : contact_t, setting_t, parts_t, motion_t, slopes_t, set_speeds, prepare_contact, &
      & evaluate_contact, follow_contact, has_curved_bearing, release_contact
   implicit none
   private

   public :: contact_basis_t, solve_contact, solve_at_speeds

   !> What the slopes of a contact with a load are made of
   type :: contact_basis_t
      !> What does not change with the load
      type(setting_t) :: setting
      !> What does
      type(parts_t) :: parts
   end type contact_basis_t

   !> What the friction of the pivot is made of
   type :: hinge_t
      !> Forces at a cam angle that is held
      type(pivot_forces_t) :: forces
      !> Friction without a contact load [N m]
      type(dual_t) :: unloaded
   end type hinge_t

   !> Balance of the finger: loss of figures allowed against the moment [-]; a few roundings
   real(wp), parameter :: balance_tolerance = 8.0_wp*epsilon(1.0_wp)
   !> Change of the film ratio below which its square is round-off [-]
   real(wp), parameter :: share_tolerance = 1.0e-8_wp
   !> Curvature of the balance over the load: the error after a step is about this times the square of the relative change [-]
   real(wp), parameter :: step_curvature = 5.0_wp
   !> Iterations that a bracketed search may take: bisection alone would need about 60
   integer, parameter :: max_iterations = 100
   !> Iterations after which the share is found to round-off in each
   integer, parameter :: usual_iterations = 8
   !> Loads below this part of the frictionless load count as lost contact [-]
   real(wp), parameter :: lost_load = 1.0e-12_wp

contains

   !> Solve the contact.
   pure subroutine solve_contact(model, position, moments, sliding_speed, contact, status, accuracy, mobilised, start, joints)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> Sliding speed, V_s [m/s]
      real(wp), intent(in) :: sliding_speed
      !> State of the contact
      type(contact_t), intent(out) :: contact
      !> 0 fine, positive where the balance was not reached
      integer, intent(out) :: status
      !> Relative error of load and forces that is good enough; absent: round-off [-]
      real(wp), intent(in), optional :: accuracy
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> What the joints have at this angle, where the balance takes it
      type(joint_basis_t), allocatable, intent(out), optional :: joints

      type(contact_basis_t) :: basis

      call set_speeds(model, position, sliding_speed, contact)
      call solve_at_speeds(model, position, moments, contact, basis, status, accuracy, mobilised, start, joints)
   end subroutine solve_contact

   !> Solve a contact whose speeds are set (`set_speeds`), and keep what its slopes are made of.
   pure subroutine solve_at_speeds(model, position, moments, contact, basis, status, accuracy, mobilised, start, joints)
      !> The model
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moments about the pivot at this angle
      type(moments_t), intent(in) :: moments
      !> State of the contact; in: its speeds
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of, where there is a load
      type(contact_basis_t), intent(out) :: basis
      !> 0 fine, positive where the balance was not reached
      integer, intent(out) :: status
      !> Relative error of load and forces that is good enough; absent: round-off [-]
      real(wp), intent(in), optional :: accuracy
      !> Mobilised part of the boundary friction; absent: as the sliding speed has it [-]
      real(wp), intent(in), optional :: mobilised
      !> A contact nearby to start from, where it touches
      type(contact_t), intent(in), optional :: start
      !> What the joints have at this angle, where the balance takes it
      type(joint_basis_t), allocatable, intent(out), optional :: joints

      ! Moment that the contact load balances [N m]; load without friction [N]
      real(wp) :: moment, load
      ! Relative change of the film ratio in the last step; relative error that is good enough [-]
      real(wp) :: change, enough
      type(hinge_t) :: hinge

      status = 0
      call find_contact_moment(model, position, moments, moment, hinge%forces, hinge%unloaded, joints)
      if (has_pivot_friction(model)) call hold_forces(hinge%forces)
      load = moment/merge(position%normal_arm, position%parallel_arm, model%has_exact_arm)
      if (model%takes_maximum_load) load = max(model%base_circle_load, load)
      if (.not. load > 0.0_wp) then
         call release_contact(contact)
         return
      end if
      contact%load = load
      enough = 0.0_wp
      if (present(accuracy)) enough = accuracy
      call prepare_contact(model, position, contact, enough, basis%setting, mobilised)
      contact%film_ratio = 0.0_wp
      if (model%is_consistent) then
         if (present(start)) then
            if (start%is_touching) call start_nearby(model, position, moment, hinge, start, contact)
         end if
         call balance_finger(model, position, moment, hinge, enough, contact, basis, status)
      else
         call evaluate_contact(model, position, basis%setting, load, contact, basis%parts, change)
      end if
   end subroutine solve_at_speeds

   !> Load with the friction of a contact nearby, and its film ratio.
   pure subroutine start_nearby(model, position, moment, hinge, nearby, contact)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moment to be balanced [N m]
      real(wp), intent(in) :: moment
      !> What the friction of the pivot is made of, where it has any
      type(hinge_t), intent(in) :: hinge
      !> The other contact
      type(contact_t), intent(in) :: nearby
      !> State of the contact, with the load without friction; out: with another where that is not far off
      type(contact_t), intent(inout) :: contact

      ! Part of the load without friction below which the other contact is too far away [-]
      real(wp), parameter :: least_part = 0.5_wp
      ! Load [N]
      real(wp) :: load
      ! Friction of the pivot, over the load [N m]
      type(dual_t) :: friction

      load = (moment - model%linkage%sense*(nearby%tangential_force*position%tangent_arm + nearby%bearing_torque)) &
         & /position%normal_arm
      if (has_pivot_friction(model)) then
         friction = pivot_moment(model%joints%pivot, hinge%forces, dual_t(load, 1.0_wp), dual_t(nearby%tangential_force, 0.0_wp))
         load = load + (friction%value - hinge%unloaded%value)/(position%normal_arm - friction%slope)
      end if
      if (.not. (load >= least_part*contact%load .and. load <= contact%load/least_part)) return
      contact%load = load
      contact%film_ratio = nearby%film_ratio
   end subroutine start_nearby

   !> Load at which `W h_W + sense (T' h_t + T_B) = moment + M_pivot`, by Newton's method inside a bracket.
   !>
   !> Friction changes the load by a few per cent at most, so the second evaluation is good to about 1e-5 and the third to
   !> 1e-10. Without a load at which friction lets the balance be, contact is lost.
   pure subroutine balance_finger(model, position, moment, hinge, enough, contact, basis, status)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moment to be balanced, with the friction of the pivot as it is without load, positive [N m]
      real(wp), intent(in) :: moment
      !> What the friction of the pivot is made of, where it has any
      type(hinge_t), intent(in) :: hinge
      !> Relative error of load and forces that is good enough [-]
      real(wp), intent(in) :: enough
      !> State of the contact; in: with the load to start from and the film ratio there, or zero
      type(contact_t), intent(inout) :: contact
      !> What slopes are made of; in: what does not change with the load
      type(contact_basis_t), intent(inout) :: basis
      !> 0 fine, positive where the balance was not reached
      integer, intent(out) :: status

      type(slopes_t) :: slopes
      ! Load, next load, bracket [N]
      real(wp) :: load, next_load, low, high
      ! Moment too much, and its derivative over ln(load) [N m]
      real(wp) :: excess, slope
      ! Relative change of the film ratio in the last step, of the load in the next [-]
      real(wp) :: change, shift
      integer :: iteration

      status = 0
      load = contact%load
      low = 0.0_wp
      high = huge(1.0_wp)
      do iteration = 1, max_iterations
         ! A share that is not quite found narrows no bracket: what has taken so long needs all of its figures
         if (iteration > usual_iterations) basis%setting%coarse = 0.0_wp
         call evaluate_contact(model, position, basis%setting, load, contact, basis%parts, change)
         slopes = follow_contact(model, basis%setting, contact, basis%parts, motion_t(load=1.0_wp))
         excess = load*position%normal_arm - moment &
            & + model%linkage%sense*(contact%tangential_force*position%tangent_arm + contact%bearing_torque)
         slope = load*position%normal_arm &
            & + model%linkage%sense*(slopes%tangential_force*position%tangent_arm + slopes%bearing_torque)
         if (has_pivot_friction(model)) call take_pivot(model, hinge, contact, slopes, excess, slope)
         shift = -1.0_wp
         if (slope > 0.0_wp) shift = -excess/slope
         if (abs(shift)*step_curvature*max(abs(shift), share_tolerance) + change**2 <= enough) then
            call shift_contact(model, position, moment, basis, hinge, slopes, shift, contact)
            if (contact%load > 0.0_wp) return
            ! That was no step: the contact at this load again
            call evaluate_contact(model, position, basis%setting, load, contact, basis%parts, change)
         end if
         ! Only a converged share tells on which side of the root the load lies
         if (abs(change) <= share_tolerance) then
            if (abs(excess) <= balance_tolerance*moment) return
            if (excess > 0.0_wp) high = load
            if (excess < 0.0_wp) low = load
         end if
         if (high - low <= 2.0_wp*epsilon(1.0_wp)*load) return
         if (high < lost_load*moment/position%normal_arm) then
            call release_contact(contact)
            return
         end if
         next_load = load*(1.0_wp + shift)
         if (next_load <= low .or. next_load >= high) then
            next_load = merge(2.0_wp*load, low + 0.5_wp*(high - low), high >= huge(1.0_wp))
            contact%film_ratio = 0.0_wp
         else
            contact%film_ratio = contact%film_ratio*(1.0_wp + slopes%film_ratio*shift)
         end if
         load = next_load
      end do
      status = 1
   end subroutine balance_finger

   !> Take the pivot's friction, as far as the load makes it, from the moment too much and from its slope.
   pure subroutine take_pivot(model, hinge, contact, slopes, excess, slope)
      !> The model, whose pivot has friction
      type(model_t), intent(in) :: model
      !> What the friction is made of
      type(hinge_t), intent(in) :: hinge
      !> State of the contact
      type(contact_t), intent(in) :: contact
      !> Its derivatives over ln(load)
      type(slopes_t), intent(in) :: slopes
      !> Moment too much, and its derivative over ln(load) [N m]
      real(wp), intent(inout) :: excess, slope

      ! Friction of the pivot [N m]
      type(dual_t) :: friction

      friction = pivot_moment(model%joints%pivot, hinge%forces, dual_t(contact%load, contact%load), &
         & dual_t(contact%tangential_force, slopes%tangential_force))
      excess = excess - (friction%value - hinge%unloaded%value)
      slope = slope - friction%slope
   end subroutine take_pivot

   !> Move a contact along its slopes by the last, small step. The load is then the one that balances the forces there.
   pure subroutine shift_contact(model, position, moment, basis, hinge, slopes, shift, contact)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moment to be balanced [N m]
      real(wp), intent(in) :: moment
      !> What slopes are made of
      type(contact_basis_t), intent(in) :: basis
      !> What the friction of the pivot is made of, where it has any
      type(hinge_t), intent(in) :: hinge
      !> Derivatives over ln(load)
      type(slopes_t), intent(in) :: slopes
      !> Relative change of the load [-]
      real(wp), intent(in) :: shift
      !> State of the contact
      type(contact_t), intent(inout) :: contact

      contact%load = contact%load*(1.0_wp + shift)
      contact%rolling_resistance = contact%rolling_resistance + slopes%rolling_resistance*shift
      contact%shear = contact%shear + slopes%shear*shift
      contact%boundary_capacity = contact%boundary_capacity + slopes%boundary_capacity*shift
      contact%boundary_mobilised = contact%boundary_capacity*basis%setting%mobilised
      contact%traction = contact%shear + contact%boundary_mobilised
      contact%tangential_force = contact%traction + contact%rolling_resistance*basis%parts%rolling_part
      if (has_curved_bearing(model)) contact%bearing_torque = contact%bearing_torque + slopes%bearing_torque*shift
      call rebalance(model, position, moment, basis%setting, hinge, contact)
      ! Where friction nearly lifts the roller off, what these derivatives leave out may be more than the load
      if (.not. contact%load > 0.0_wp) return
      contact%length = contact%length*(1.0_wp + basis%parts%lengths_by_load%mean*shift)
      contact%half_width = half_width(contact%load, position%equivalent_radius, contact%length, model%modulus)
      contact%apparent_area = 2.0_wp*contact%half_width*contact%length
      contact%sheared_area = contact%apparent_area*basis%parts%strip%width
      contact%film_min = contact%film_min*(1.0_wp + slopes%film_ratio*shift)
      contact%film_ratio = contact%film_min/contact%surfaces%roughness
      contact%film_central = contact%film_central*(1.0_wp + slopes%film_central*shift)
      contact%inlet_factor = contact%inlet_factor*(1.0_wp + slopes%inlet_factor*shift)
      contact%asperity_load = min(max(0.0_wp, contact%asperity_load + slopes%asperity_load*shift), contact%load)
      contact%real_area = max(0.0_wp, contact%real_area + slopes%real_area*shift)
      contact%film_rise = contact%film_rise + slopes%film_rise*shift
      contact%flash_rise = contact%flash_rise + slopes%flash_rise*shift
      contact%boundary_coefficient = contact%boundary_coefficient &
         & + basis%parts%boundary%by_temperature*slopes%flash_rise*shift
   end subroutine shift_contact

   !> Load that balances the forces which a contact has, and the torque of a bearing that is in proportion to it: one step,
   !> so small that it is exact, so that no energy is lost between them.
   pure subroutine rebalance(model, position, moment, setting, hinge, contact)
      type(model_t), intent(in) :: model
      !> Geometry at this angle
      type(position_t), intent(in) :: position
      !> Moment to be balanced [N m]
      real(wp), intent(in) :: moment
      !> What does not change with the load
      type(setting_t), intent(in) :: setting
      !> What the friction of the pivot is made of, where it has any
      type(hinge_t), intent(in) :: hinge
      !> State of the contact, nearly balanced
      type(contact_t), intent(inout) :: contact

      type(slopes_t) :: held
      ! Torque of the bearing over the load [m]; moment too much, and its derivative over ln(load) [N m]
      real(wp) :: arm, excess, slope

      arm = setting%bearing_arm
      if (has_curved_bearing(model)) arm = 0.0_wp
      if (.not. has_curved_bearing(model)) contact%bearing_torque = arm*contact%load + contact%bearing_drag
      held%tangential_force = 0.0_wp
      excess = contact%load*position%normal_arm - moment &
         & + model%linkage%sense*(contact%tangential_force*position%tangent_arm + contact%bearing_torque)
      slope = contact%load*(position%normal_arm + model%linkage%sense*arm)
      if (has_pivot_friction(model)) call take_pivot(model, hinge, contact, held, excess, slope)
      contact%load = contact%load*(1.0_wp - excess/slope)
      if (.not. has_curved_bearing(model)) contact%bearing_torque = arm*contact%load + contact%bearing_drag
   end subroutine rebalance

end module camroller_contact
