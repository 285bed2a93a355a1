!> Why an effect matters or does not, in words and numbers.
!>
!> In: a survey of the cycle. Out: one line for each effect: the film ratio that decides about asperities, Moes'
!> numbers that decide about the film law, and so on.
module camroller_effect_reasons
   use camroller_kinds, only : wp, degree
   use camroller_model, only : model_t
   use camroller_contact_forces, only : film_groups
   use camroller_contact_traction, only : largest_shear
   use camroller_effect_list, only : effect_names, effect_asperity, effect_needle, effect_guide, effect_bearings, effect_gas, &
      & effect_rolling, effect_film, effect_pressure, effect_shear, effect_spin, effect_ehl, effect_tip, effect_seal, effect_side, &
      & effect_pivot, effect_drag, effect_inlet_heat, effect_contact_heat, effect_dynamics, effect_surge, effect_adjuster, &
      & effect_boundary_law, effect_modifier, effect_profile, effect_bearing_asperity, effect_belt_pull, effect_orbit, &
      & effect_bearing_heat, effect_shaft_drag
   use camroller_effect_grid, only : points, mean_over
   use camroller_effect_survey, only : survey_t
   use camroller_effect_train, only : train_change_t, train_load_t
   use camroller_film, only : groups_t
   use camroller_hertz, only : peak_pressure
   use camroller_number_text, only : fixed_text, scientific_text
   use camroller_torque_list, only : torque_list
   implicit none
   private

   public :: find_reason, find_train_reason

   !> Length of a number in words
   integer, parameter :: number_length = 12
   !> Pascal in a gigapascal [-]
   real(wp), parameter :: giga = 1.0e9_wp
   !> Micrometres in a metre [-]
   real(wp), parameter :: micro = 1.0e6_wp

contains

   !> What decides about an effect.
   subroutine find_reason(effect, model, survey, share, reason)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> The model of the first lobe
      type(model_t), intent(in) :: model
      !> Survey of its cycle
      type(survey_t), intent(in) :: survey
      !> Fraction of the mean torque for losses due to camshaft bearings [-]
      real(wp), intent(in) :: share
      !> A few words
      character(len=*), intent(out) :: reason

      ! Mean of a loss as torque [N m], or a part [-]; all losses
      real(wp) :: lost, all_lost
      ! Losses at the angles [N m]
      real(wp) :: losses(points)

      associate (states => survey%states, contact => survey%states%contact)
         losses = states%torque_friction
         all_lost = mean_over(survey%grid, losses)
         select case (effect)
         case (effect_asperity)
            reason = "film ratio from "//trim(text(minval(contact%film_ratio)))//" to "//trim(text(maxval(contact%film_ratio))) &
               & //", asperities carry up to "//trim(percent(maxval(contact%asperity_load/contact%load)))//" of the load"
         case (effect_modifier)
            reason = "changes the boundary coefficient from "//trim(text(model%boundary%bare_coefficient))//" to "// &
               & trim(text(model%boundary%coefficient))
         case (effect_boundary_law)
            reason = "has a boundary coefficient from "//trim(text(minval(contact%boundary_coefficient)))//" to "// &
               & trim(text(maxval(contact%boundary_coefficient)))
         case (effect_profile)
            reason = "a line contact of "//trim(percent(minval(contact%length)/model%contact_width))//" to "// &
               & trim(percent(maxval(contact%length)/model%contact_width))//" of the roller's length stands for it"
         case (effect_needle, effect_guide, effect_tip, effect_seal, effect_side, effect_pivot, effect_drag)
            losses = states%torques(findloc(torque_list%source, effect_names(effect), 1))
            lost = mean_over(survey%grid, losses)
            reason = "takes "//trim(percent(lost/all_lost))//" of the follower's friction torque"
         case (effect_bearings)
            reason = "take "//trim(percent(share))//" of the friction torque; film and slip do not depend on them"
         case (effect_shaft_drag)
            reason = "acts on nothing else; with the camshaft bearings it takes "//trim(percent(share))//" of the friction torque"
         case (effect_bearing_asperity, effect_belt_pull, effect_orbit, effect_bearing_heat)
            reason = "acts on the camshaft bearings alone, which take "//trim(percent(share))//" of the friction torque"
         case (effect_gas)
            reason = "presses the valve with up to "//trim(text(maxval(abs(states%gas_force))))//" N"
         case (effect_rolling)
            lost = mean_over(survey%grid, &
               & contact%rolling_resistance*(contact%cam_surface_speed + contact%roller_surface_speed))/model%speed
            reason = "takes "//trim(percent(lost/all_lost))//" of the follower's friction torque"
         case (effect_film, effect_ehl)
            call find_moes_numbers(model, survey, reason)
         case (effect_pressure)
            reason = "peak pressure up to "//trim(text(maxval(peak_pressure(contact%load, states%position%equivalent_radius, &
               & contact%length, model%modulus))/giga))//" GPa"
         case (effect_shear)
            lost = maxval(abs(contact%shear)/contact%sheared_area)/model%eyring_stress
            reason = "mean shear stress up to "//trim(percent(lost))//" of the Eyring stress"
         case (effect_inlet_heat)
            reason = "heat in the inlet thins the film by up to "//trim(percent(1.0_wp - minval(contact%inlet_factor)))
         case (effect_contact_heat)
            reason = "the film is up to "//trim(text(maxval(contact%film_rise)))//" K warmer than the oil"
         case (effect_spin)
            lost = maxval(abs(contact%traction)/(largest_shear(model, contact) + contact%boundary_capacity))
            reason = "traction up to "//trim(percent(lost))//" of what the contact can bear; slip follows its balance within "// &
               & trim(text(1.0_wp/(minval(survey%decay)*degree)))//" deg"
         end select
      end associate
   end subroutine find_reason

   !> What decides about a part of a flexible train.
   subroutine find_train_reason(effect, train, change, reason)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> The train
      type(train_load_t), intent(in) :: train
      !> What the load changes by without the effect
      type(train_change_t), intent(in) :: change
      !> A few words
      character(len=*), intent(out) :: reason

      select case (effect)
      case (effect_dynamics)
         reason = "train frequency "//trim(text(train%frequency))//" Hz, "
      case (effect_surge)
         reason = "modes of the spring pull with up to "//trim(text(train%surge))//" N, "
      case (effect_adjuster)
         reason = "the plunger sinks by up to "//trim(text(micro*train%sink))//" um, "
      end select
      reason = trim(reason)//" load changes by "//trim(percent(change%share))//" in the mean"
   end subroutine find_train_reason

   !> Moes' numbers round the cycle.
   subroutine find_moes_numbers(model, survey, reason)
      type(model_t), intent(in) :: model
      !> Survey of its cycle
      type(survey_t), intent(in) :: survey
      !> A few words
      character(len=*), intent(out) :: reason

      type(groups_t) :: groups
      ! Load and material parameter, M and L [-]
      real(wp) :: m(size(survey%states)), l(size(survey%states)), root
      integer :: i

      do i = 1, size(m)
         groups = film_groups(model, survey%states(i)%position, survey%states(i)%contact)
         root = sqrt(2.0_wp*max(groups%speed, tiny(1.0_wp)))
         m(i) = groups%load/root
         l(i) = groups%material*sqrt(root)
      end do
      reason = "Moes numbers M "//trim(text(minval(m)))//" to "//trim(text(maxval(m)))//", L "// &
         & trim(text(minval(l)))//" to "//trim(text(maxval(l)))
   end subroutine find_moes_numbers

   !> A number with three digits.
   function text(number)
      !> The number [any]
      real(wp), intent(in) :: number
      !> It in words
      character(len=number_length) :: text

      text = scientific_text(number, 2)
      if (abs(number) < 9999.5_wp .and. abs(number) >= 9.995_wp) text = fixed_text(number, 1)
      if (abs(number) < 9.995_wp .and. abs(number) >= 0.01_wp) text = fixed_text(number, 3)
   end function text

   !> A part of one in per cent.
   function percent(part)
      !> The part [-]
      real(wp), intent(in) :: part
      !> It in words
      character(len=number_length) :: percent

      percent = text(100.0_wp*part)
      percent = trim(percent)//" %"
   end function percent

end module camroller_effect_reasons
