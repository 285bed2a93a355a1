!> Optional effects of a case: their names, how to remove one, and the decision on each.
!>
!> In: a case. Out: the case without an effect, or with the simpler law in its place.
module camroller_effect_list
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_names, only : name_length
   use camroller_case, only : case_t, quasi_static, automatic_method, quantity_names
   use camroller_asperity, only : asperity_law_names, law_masjedi_khonsari_asperities
   use camroller_boundary_law, only : given_coefficients
   use camroller_film, only : film_law_names, law_dowson_higginson, law_masjedi_khonsari, law_masjedi_khonsari_rough, law_moes
   use camroller_flexible_setup, only : base_load
   use camroller_heat, only : inlet_law_names, contact_heat_names, inlet_none, contact_heat_none
   use camroller_journal, only : journal_motion_names, motion_orbit, motion_quasi_steady
   use camroller_kinematics, only : linkage_t, position_t, new_linkage, evaluate_position
   use camroller_lubricant, only : pressure_law_names, law_cameron
   use camroller_traction, only : rolling_law_names, rolling_none, shear_law_names, law_newtonian
   implicit none
   private

   public :: effect_names, effect_count, decision_t, choice_t, leave_out, leave_all_but, has_effect, has_single_cam
   public :: effect_asperity, effect_needle, effect_guide, effect_bearings, effect_gas, effect_rolling, effect_film, &
      & effect_pressure, effect_shear, effect_spin, effect_ehl, effect_tip, effect_seal, effect_side, effect_pivot, &
      & effect_drag, effect_inlet_heat, effect_contact_heat, effect_dynamics, effect_surge, effect_adjuster, is_part_of_train, &
      & effect_bearing_asperity, effect_belt_pull, effect_modifier, effect_orbit, effect_bearing_heat, effect_profile, &
      & effect_boundary_law, effect_shaft_drag, needs_bearings

   !> Effects: groups of the deck, and laws that have a simpler one beside them
   character(len=*), parameter :: effect_names(*) = [character(len=name_length) :: "asperity", "needle_bearing", "valve_guide", &
      & "cam_bearings", "gas_force", "rolling_resistance", "film_law", "pressure_law", "shear_law", "roller_equation", &
      & "ehl", "valve_tip", "stem_seal", "guide_side_load", "finger_pivot", "needle_drag", "inlet_heat", "contact_heat", &
      & "dynamics", "spring_surge", "lash_adjuster", "bearing_asperity", "belt_pull", &
      & "friction_modifier", "journal_orbit", "bearing_heat", "roller_profile", "boundary_law", "running_in", &
      & "shaft_drag"]
   !> Positions in it
   integer, parameter :: effect_asperity = 1, effect_needle = 2, effect_guide = 3, effect_bearings = 4, effect_gas = 5, &
      & effect_rolling = 6, effect_film = 7, effect_pressure = 8, effect_shear = 9, effect_spin = 10, effect_ehl = 11, &
      & effect_tip = 12, effect_seal = 13, effect_side = 14, effect_pivot = 15, effect_drag = 16, &
      & effect_inlet_heat = 17, effect_contact_heat = 18, effect_dynamics = 19, effect_surge = 20, effect_adjuster = 21, &
      & effect_bearing_asperity = 22, effect_belt_pull = 23, effect_modifier = 24, &
      & effect_orbit = 25, effect_bearing_heat = 26, effect_profile = 27, effect_boundary_law = 28, effect_running_in = 29, &
      & effect_shaft_drag = 30
   !> Effects of the camshaft bearings: nothing else depends on them, and without these bearings they are of no effect
   integer, parameter :: needs_bearings(*) = [effect_bearing_asperity, effect_belt_pull, effect_orbit, effect_bearing_heat, &
      & effect_shaft_drag]
   !> Their number
   integer, parameter :: effect_count = size(effect_names)
   !> Words of a reason
   integer, parameter :: reason_length = 120

   !> What was decided about an effect of a case
   type :: decision_t
      !> Position in `effect_names`
      integer :: effect
      !> Is it part of the run?
      logical :: is_used
      !> Largest relative change expected without it, one per name in `quantity_names` [-]; huge where there is no estimate
      real(wp) :: estimates(size(quantity_names))
      !> Why, in words
      character(len=reason_length) :: reason
   end type decision_t

   !> What was decided about a case
   type :: choice_t
      !> Position in `quantity_names` of the quantity that counts
      integer :: quantity
      !> Change of it that may be neglected [-]
      real(wp) :: negligible
      !> Sum of the estimates of what is left out [-]
      real(wp) :: bound
      !> Evaluations of the contact that the estimates took
      integer :: evaluations
      !> One for each effect that the case has
      type(decision_t), allocatable :: decisions(:)
   end type choice_t

contains

   !> Is an effect one that a flexible train alone can have, so that it goes where the train is made rigid?
   elemental function is_part_of_train(effect) result(is_part)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> Is it?
      logical :: is_part

      is_part = effect == effect_surge .or. effect == effect_adjuster
   end function is_part_of_train

   !> Leave an effect out, or put the simpler law in its place. A rigid train has neither a spring that surges nor an adjuster that
   !> gives way.
   ! style: procedure because it is one list
   subroutine leave_out(variant, effect)
      !> In: a case; out: the case without the effect, the same where it has not got it
      type(case_t), intent(inout) :: variant
      !> Position in `effect_names`
      integer, intent(in) :: effect

      select case (effect)
      case (effect_asperity)
         call leave_asperities_out(variant)
      case (effect_needle)
         if (allocated(variant%needle_bearing)) deallocate (variant%needle_bearing)
      case (effect_guide)
         if (allocated(variant%valve_guide)) deallocate (variant%valve_guide)
      case (effect_bearings)
         call leave_bearings_out(variant)
      case (effect_gas)
         if (allocated(variant%gas_force)) deallocate (variant%gas_force)
      case (effect_rolling)
         variant%traction%rolling_law = rolling_law_names(rolling_none)
      case (effect_film)
         if (variant%film%law == film_law_names(law_moes)) variant%film%law = film_law_names(law_dowson_higginson)
         if (has_rough_film(variant)) variant%film%law = film_law_names(law_masjedi_khonsari)
      case (effect_pressure)
         variant%lubricant%pressure_law = pressure_law_names(law_cameron)
      case (effect_shear)
         variant%traction%shear_law = shear_law_names(law_newtonian)
      case (effect_spin)
         variant%numerics%method = quasi_static
      case (effect_ehl)
         if (allocated(variant%ehl)) deallocate (variant%ehl)
      case (effect_tip)
         if (allocated(variant%valve_tip)) deallocate (variant%valve_tip)
      case (effect_seal)
         if (allocated(variant%stem_seal)) deallocate (variant%stem_seal)
      case (effect_side)
         if (allocated(variant%guide_side_load)) deallocate (variant%guide_side_load)
      case (effect_pivot)
         if (allocated(variant%finger_pivot)) deallocate (variant%finger_pivot)
      case (effect_drag)
         if (allocated(variant%needle_drag)) deallocate (variant%needle_drag)
      case (effect_bearing_asperity)
         if (allocated(variant%bearing_asperity)) deallocate (variant%bearing_asperity)
      case (effect_belt_pull)
         if (allocated(variant%belt_pull)) deallocate (variant%belt_pull)
      case (effect_orbit)
         if (allocated(variant%cam_bearings)) variant%cam_bearings%journal_motion = journal_motion_names(motion_quasi_steady)
      case (effect_bearing_heat)
         if (allocated(variant%bearing_heat)) deallocate (variant%bearing_heat)
      case (effect_shaft_drag)
         if (allocated(variant%shaft_drag)) deallocate (variant%shaft_drag)
      case (effect_profile)
         if (allocated(variant%roller_profile)) deallocate (variant%roller_profile)
      case (effect_modifier)
         if (allocated(variant%friction_modifier)) deallocate (variant%friction_modifier)
      case (effect_boundary_law)
         call leave_boundary_law_out(variant)
      case (effect_running_in)
         call leave_running_in_out(variant)
      case (effect_inlet_heat)
         if (allocated(variant%heat)) variant%heat%inlet_law = inlet_law_names(inlet_none)
      case (effect_contact_heat)
         if (allocated(variant%heat)) variant%heat%contact = contact_heat_names(contact_heat_none)
      case (effect_dynamics)
         call fix_pivot(variant)
         if (allocated(variant%spring_surge)) deallocate (variant%spring_surge)
         if (allocated(variant%dynamics)) deallocate (variant%dynamics)
      case (effect_surge)
         if (allocated(variant%spring_surge)) deallocate (variant%spring_surge)
      case (effect_adjuster)
         call fix_pivot(variant)
      end select
   end subroutine leave_out

   !> Leave asperities out, with all that needs them.
   pure subroutine leave_asperities_out(variant)
      !> In: a case; out: without them
      type(case_t), intent(inout) :: variant

      if (allocated(variant%asperity)) deallocate (variant%asperity)
      if (allocated(variant%friction_modifier)) deallocate (variant%friction_modifier)
      if (allocated(variant%boundary_law)) deallocate (variant%boundary_law)
      if (allocated(variant%wear)) deallocate (variant%wear)
      call leave_running_in_out(variant)
   end subroutine leave_asperities_out

   !> Leave the law of boundary friction out: the coefficient is that at its references, of a table the mean of its points.
   pure subroutine leave_boundary_law_out(variant)
      !> In: a case; out: with a constant coefficient
      type(case_t), intent(inout) :: variant

      real(wp), allocatable :: coefficients(:) ! [-]

      if (.not. (allocated(variant%boundary_law) .and. allocated(variant%asperity))) return
      coefficients = given_coefficients(variant%boundary_law, variant%asperity%boundary_coefficient)
      variant%asperity%boundary_coefficient = sum(coefficients)/size(coefficients)
      deallocate (variant%boundary_law)
   end subroutine leave_boundary_law_out

   !> Leave the hours of running out, with the film that grows in them.
   pure subroutine leave_running_in_out(variant)
      !> In: a case; out: with its surfaces as they are at first
      type(case_t), intent(inout) :: variant

      if (allocated(variant%running_in)) deallocate (variant%running_in)
      if (allocated(variant%tribofilm)) deallocate (variant%tribofilm)
   end subroutine leave_running_in_out

   !> Take the lash adjuster away: the pivot stays where the adjuster holds it at rest, and the base circle keeps its load.
   subroutine fix_pivot(variant)
      !> In: a case; out: without an adjuster
      type(case_t), intent(inout) :: variant

      type(linkage_t) :: linkage
      type(position_t) :: closed
      type(error_t), allocatable :: error
      integer :: status

      if (.not. allocated(variant%lash_adjuster)) return
      call new_linkage(linkage, variant%mechanism, error)
      if (.not. allocated(error)) then
         call evaluate_position(linkage, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], closed, status)
         if (status == 0) variant%spring%base_circle_load = base_load(variant, linkage, closed)
      end if
      deallocate (variant%lash_adjuster)
   end subroutine fix_pivot

   !> Are there camshaft bearings, and between them one cam of the first lobe shape at phase 0, as a case without them has it?
   pure function has_single_cam(case) result(has)
      !> The case
      type(case_t), intent(in) :: case
      !> True for such a cam
      logical :: has

      has = .false.
      if (.not. allocated(case%cam_bearings)) return
      if (size(case%cam_bearings%cam_positions) /= 1) return
      has = case%cam_bearings%cam_lobes(1) == 1 .and. abs(case%cam_bearings%cam_phases(1)) <= 0.0_wp
   end function has_single_cam

   !> Leave the camshaft bearings out, with what needs them. Cams stay: a single one is that of a case without bearings, others are
   !> kept with bearings that have no friction.
   pure subroutine leave_bearings_out(variant)
      !> In: a case; out: with the same cams
      type(case_t), intent(inout) :: variant

      if (has_single_cam(variant)) then
         deallocate (variant%cam_bearings)
         if (allocated(variant%second_lift)) deallocate (variant%second_lift)
      else if (allocated(variant%cam_bearings)) then
         variant%cam_bearings%has_friction = .false.
         variant%cam_bearings%by_bearing = .false.
         variant%cam_bearings%journal_motion = journal_motion_names(motion_quasi_steady)
      end if
      if (allocated(variant%bearing_asperity)) deallocate (variant%bearing_asperity)
      if (allocated(variant%belt_pull)) deallocate (variant%belt_pull)
      if (allocated(variant%bearing_heat)) deallocate (variant%bearing_heat)
      if (allocated(variant%shaft_drag)) deallocate (variant%shaft_drag)
   end subroutine leave_bearings_out

   !> Has a case a rough film that a smooth one may stand for? Not where its asperities come with it.
   pure function has_rough_film(case) result(has)
      type(case_t), intent(in) :: case
      !> Has it one?
      logical :: has

      has = case%film%law == film_law_names(law_masjedi_khonsari_rough)
      if (has .and. allocated(case%asperity)) has = case%asperity%law /= asperity_law_names(law_masjedi_khonsari_asperities)
   end function has_rough_film

   !> Leave out every effect but one; the roller's equation stays.
   subroutine leave_all_but(case, effect)
      !> In: a case; out: with one effect
      type(case_t), intent(inout) :: case
      !> Position in `effect_names`; 0: none at all
      integer, intent(in) :: effect

      integer :: other

      do other = 1, effect_count
         if (other == effect .or. other == effect_spin) cycle
         if (other == effect_dynamics .and. is_part_of_train(effect)) cycle
         call leave_out(case, other)
      end do
   end subroutine leave_all_but

   !> Does a case have an effect that can be left out?
   ! style: procedure because it is one list
   pure function has_effect(case, effect) result(has)
      !> The case
      type(case_t), intent(in) :: case
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> True where the case would be another one without it
      logical :: has

      has = .false.
      select case (effect)
      case (effect_asperity)
         has = allocated(case%asperity)
      case (effect_needle)
         has = allocated(case%needle_bearing)
      case (effect_guide)
         has = allocated(case%valve_guide)
      case (effect_bearings)
         if (allocated(case%cam_bearings)) has = case%cam_bearings%has_friction
      case (effect_gas)
         has = allocated(case%gas_force)
      case (effect_rolling)
         has = case%traction%rolling_law /= rolling_law_names(rolling_none)
      case (effect_film)
         has = case%film%law == film_law_names(law_moes) .or. has_rough_film(case)
         has = has .and. .not. allocated(case%ehl)
      case (effect_pressure)
         has = case%lubricant%pressure_law /= pressure_law_names(law_cameron)
      case (effect_shear)
         has = case%traction%shear_law /= shear_law_names(law_newtonian)
      case (effect_spin)
         has = case%numerics%method == automatic_method .and. .not. allocated(case%dynamics)
      case (effect_ehl)
         has = allocated(case%ehl)
      case (effect_tip)
         has = allocated(case%valve_tip)
      case (effect_seal)
         has = allocated(case%stem_seal)
      case (effect_side)
         has = allocated(case%guide_side_load)
      case (effect_pivot)
         has = allocated(case%finger_pivot)
      case (effect_drag)
         has = allocated(case%needle_drag)
      case (effect_bearing_asperity)
         has = allocated(case%bearing_asperity)
      case (effect_belt_pull)
         has = allocated(case%belt_pull)
      case (effect_orbit)
         if (allocated(case%cam_bearings)) has = case%cam_bearings%journal_motion == journal_motion_names(motion_orbit)
      case (effect_bearing_heat)
         has = allocated(case%bearing_heat)
      case (effect_shaft_drag)
         has = allocated(case%shaft_drag)
      case (effect_profile)
         has = allocated(case%roller_profile)
      case (effect_modifier)
         has = allocated(case%asperity) .and. allocated(case%friction_modifier)
      case (effect_boundary_law)
         has = allocated(case%asperity) .and. allocated(case%boundary_law)
      case (effect_running_in)
         has = allocated(case%asperity) .and. allocated(case%running_in)
      case (effect_inlet_heat)
         if (allocated(case%heat)) has = case%heat%inlet_law /= inlet_law_names(inlet_none)
      case (effect_contact_heat)
         if (allocated(case%heat)) has = case%heat%contact /= contact_heat_names(contact_heat_none)
      case (effect_dynamics)
         has = allocated(case%dynamics)
      case (effect_surge)
         has = allocated(case%dynamics) .and. allocated(case%spring_surge)
      case (effect_adjuster)
         has = allocated(case%dynamics) .and. allocated(case%lash_adjuster)
      end select
   end function has_effect

end module camroller_effect_list
