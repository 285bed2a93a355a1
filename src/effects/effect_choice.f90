!> Which of the listed effects a case needs.
!>
!> In: a case. Out: what leaving each effect out would change, at most, and the case without those that together
!> change the quantity of interest by less than what is negligible.
!>
!> The estimates come from a survey of the cycle (`camroller_effect_survey`) at a fraction of the work of a run. They are empirical
!> bounds, not proved ones: magnitudes of changes are added over the cycle, with a margin, and where the survey has no estimate
!> the effect stays.
module camroller_effect_choice
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_names, only : find_name
   use camroller_accuracy, only : has_error_control
   use camroller_case, only : case_t, quasi_static, select_names, select_needed, quantity_names, quantity_torque, quantity_film, &
      & quantity_slip
   use camroller_effect_bearings, only : mean_bearing_torque
   use camroller_effect_list, only : choice_t, decision_t, effect_count, effect_asperity, effect_bearings, &
      & effect_dynamics, effect_ehl, effect_film, effect_spin, has_effect, has_single_cam, is_part_of_train, leave_out, &
      & needs_bearings
   use camroller_effect_reasons, only : find_reason, find_train_reason
   use camroller_effect_survey, only : survey_t, response_t, make_survey, respond
   use camroller_effect_train, only : compare_trains, estimate_train, train_change_t, train_load_t
   use camroller_film, only : range_policy_names, range_stop
   use camroller_model, only : model_t, revise_model
   use camroller_shaft, only : needs_turn
   implicit none
   private

   public :: wants_choice, choose_effects

   !> Factor of the estimates on the changes that the survey of the cycle finds [-]
   real(wp), parameter :: margin = 5.0_wp
   !> Changes beyond this are too large to be estimated from small ones [-]
   real(wp), parameter :: largest_estimate = 1.0_wp
   !> Why nothing is said of the bearings of several cams
   character(len=*), parameter :: not_surveyed = &
      & "not estimated for several cams, or one that is not of the first lobe shape at phase 0"

   !> Mean torque for losses
   type :: mean_torque_t
      !> Of the followers, its uncertainty, of the bearings [N m]
      real(wp) :: followers = 0.0_wp, error = 0.0_wp, bearings = 0.0_wp
      !> Why that of the bearings is not known; not allocated where it is, or where there are none
      character(len=:), allocatable :: trouble
   end type mean_torque_t

contains

   !> Does a case leave the choice to the program?
   pure function wants_choice(case) result(wants)
      !> The case
      type(case_t), intent(in) :: case
      !> True for `select = 'needed'`
      logical :: wants

      wants = case%effects%select == select_names(select_needed)
   end function wants_choice

   !> Leave out what a case does not need.
   subroutine choose_effects(case, models, chosen, choice, error)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> The case with those that matter
      type(case_t), intent(out) :: chosen
      !> What was decided and why
      type(choice_t), intent(out) :: choice
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      ! Smallest estimate of the effects not surveyed yet; what it adds to the bound [-]
      real(wp) :: least, added
      integer :: i, next
      logical, allocatable :: is_open(:)

      chosen = case
      call weigh_effects(case, models, choice, error)
      if (allocated(error)) return
      choice%bound = 0.0_wp
      allocate (is_open(size(choice%decisions)), source=.true.)
      do while (any(is_open))
         least = huge(1.0_wp)
         next = 0
         do i = 1, size(choice%decisions)
            if (.not. is_open(i)) cycle
            if (next > 0 .and. choice%decisions(i)%estimates(choice%quantity) >= least) cycle
            least = choice%decisions(i)%estimates(choice%quantity)
            next = i
         end do
         is_open(next) = .false.
         associate (all => choice%decisions, effect => choice%decisions(next)%effect)
            added = least
            ! A rigid train has no parts of a flexible one: its estimate is for all of them
            if (effect == effect_dynamics) added = least - sum(all%estimates(choice%quantity), &
               & mask=is_part_of_train(all%effect) .and. .not. all%is_used)
            if (added > choice%negligible - choice%bound) cycle
            choice%bound = choice%bound + added
            all(next)%is_used = .false.
            call leave_out(chosen, effect)
            if (effect /= effect_dynamics) cycle
            where (is_part_of_train(all%effect))
               all%is_used = .false.
               is_open = .false.
            end where
         end associate
      end do
   end subroutine choose_effects

   !> What leaving each effect out would change.
   subroutine weigh_effects(case, models, choice, error)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Estimates and reasons; nothing is left out yet
      type(choice_t), intent(out) :: choice
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(survey_t), allocatable :: surveys(:)
      type(train_load_t), allocatable :: trains(:)
      type(mean_torque_t) :: torque
      type(error_t), allocatable :: failure
      integer :: lobe, effect

      call find_name("quantity", case%effects%quantity, quantity_names, choice%quantity, error)
      if (allocated(error)) return
      choice%negligible = case%effects%negligible
      choice%bound = 0.0_wp
      choice%evaluations = 0
      allocate (choice%decisions(0), surveys(size(models)), trains(size(models)))
      do lobe = 1, size(models)
         call make_survey(models(lobe), surveys(lobe))
         if (.not. has_error_control(case%numerics%method) .and. case%numerics%method /= quasi_static) surveys(lobe)%trouble = &
            & "a fixed step may not resolve the cycle"
         if (allocated(case%running_in)) surveys(lobe)%trouble = "the surfaces change over the hours of running"
         choice%evaluations = choice%evaluations + surveys(lobe)%evaluations
         call estimate_train(models(lobe), trains(lobe))
         if (allocated(trains(lobe)%trouble)) surveys(lobe)%trouble = trains(lobe)%trouble
         if (allocated(surveys(lobe)%trouble)) cycle
         torque%followers = torque%followers + followers_of(case, lobe)*surveys(lobe)%torque
         torque%error = torque%error + followers_of(case, lobe)*surveys(lobe)%torque_error
      end do
      if (has_single_cam(case) .and. .not. allocated(surveys(1)%trouble)) then
         call mean_bearing_torque(case, models(1), surveys(1), needs_turn(case), torque%bearings, failure)
         if (allocated(failure)) torque%trouble = failure%message
         ! What is not known stands in no denominator
         if (allocated(failure)) torque%bearings = 0.0_wp
      end if
      do effect = 1, effect_count
         if (.not. has_effect(case, effect)) cycle
         call weigh_effect(case, models, surveys, trains, effect, torque, choice, error)
         if (allocated(error)) return
      end do
      call doubt_others(choice)
   end subroutine weigh_effects

   !> The cycle of a rigid train says nothing where a flexible one is another in ways that are not estimated.
   subroutine doubt_others(choice)
      !> What is to be decided
      type(choice_t), intent(inout) :: choice

      integer :: i, k

      do i = 1, size(choice%decisions)
         if (choice%decisions(i)%effect /= effect_dynamics) cycle
         do k = 1, size(quantity_names)
            if (choice%decisions(i)%estimates(k) > largest_estimate) choice%decisions%estimates(k) = huge(1.0_wp)
         end do
      end do
   end subroutine doubt_others

   !> What leaving one effect out would change.
   subroutine weigh_effect(case, models, surveys, trains, effect, torque, choice, error)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each
      type(survey_t), intent(in) :: surveys(:)
      !> Load of each
      type(train_load_t), intent(in) :: trains(:)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      !> Gets a decision
      type(choice_t), intent(inout) :: choice
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(decision_t) :: decision
      type(response_t), allocatable :: responses(:)
      integer :: lobe

      decision%effect = effect
      decision%is_used = .true.
      decision%estimates = huge(1.0_wp)
      decision%reason = ""
      if (effect == effect_asperity .and. allocated(case%wear)) then
         decision%reason = "not estimated: they make the wear that is asked for"
      else if (any(effect == [effect_film, effect_ehl]) .and. case%film%range_policy == range_policy_names(range_stop)) then
         decision%reason = "not estimated: a simpler law outside its range would end the run, by film.range_policy"
      end if
      if (effect == effect_bearings) call weigh_bearings(case, surveys, torque, decision)
      if (any(effect == needs_bearings)) call weigh_bearing_part(case, models, surveys, torque, decision)
      lobe = 1
      do while (lobe < size(surveys) .and. .not. allocated(surveys(lobe)%trouble))
         lobe = lobe + 1
      end do
      if (allocated(surveys(lobe)%trouble)) then
         if (decision%reason == "") decision%reason = "not estimated: "//surveys(lobe)%trouble
      else if (decision%reason == "") then
         if (effect == effect_dynamics .or. is_part_of_train(effect)) then
            call weigh_train(case, models, surveys, trains, effect, torque, choice, decision, error)
            choice%decisions = [choice%decisions, decision]
            return
         end if
         call find_reason(effect, models(1), surveys(1), torque%bearings/(torque%followers + torque%bearings), decision%reason)
         ! The roller equation is as quick as its limit: there is nothing to be saved
         if (all(effect /= [effect_bearings, effect_spin, needs_bearings])) then
            call find_responses(case, models, surveys, effect, responses, error)
            if (allocated(error)) return
            call set_estimates(case, surveys(1), responses, torque, choice, decision)
            if (allocated(case%cam_bearings)) call add_bearings(case, models(1), responses, torque, decision)
         end if
      end if
      choice%decisions = [choice%decisions, decision]
   end subroutine weigh_effect

   !> What a flexible train changes as a whole, or its spring or adjuster: the load, and losses of its own.
   subroutine weigh_train(case, models, surveys, trains, effect, torque, choice, decision, error)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each
      type(survey_t), intent(in) :: surveys(:)
      !> Load of each
      type(train_load_t), intent(in) :: trains(:)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      !> Counts the work
      type(choice_t), intent(inout) :: choice
      !> Gets estimates and reason
      type(decision_t), intent(inout) :: decision
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: variant
      type(model_t) :: model
      type(train_load_t) :: other
      type(train_change_t) :: change
      type(response_t) :: responses(size(models)), peak
      ! Largest part of the load that changes, in the mean [-]
      real(wp) :: share
      integer :: lobe

      variant = case
      call leave_out(variant, effect)
      share = 0.0_wp
      do lobe = 1, size(models)
         model = models(lobe)
         call revise_model(model, variant, error)
         if (allocated(error)) return
         call estimate_train(model, other)
         if (allocated(other%trouble)) then
            decision%reason = "not estimated: without it "//other%trouble
            return
         end if
         call compare_trains(trains(lobe), other, surveys(lobe)%grid, change)
         call respond(surveys(lobe), models(lobe), models(lobe), responses(lobe), change%mean)
         call respond(surveys(lobe), models(lobe), models(lobe), peak, change%largest)
         responses(lobe)%is_known = responses(lobe)%is_known .and. peak%is_known
         responses(lobe)%evaluations = responses(lobe)%evaluations + peak%evaluations
         responses(lobe)%film = peak%film
         responses(lobe)%torque = responses(lobe)%torque + change%loss
         share = max(share, change%share)
         if (lobe == 1) call find_train_reason(effect, trains(1), change, decision%reason)
      end do
      call set_estimates(case, surveys(1), responses, torque, choice, decision)
      ! Camshaft bearings follow the load no more than in proportion
      if (allocated(case%cam_bearings)) decision%estimates(quantity_torque) = max(decision%estimates(quantity_torque), margin*share)
   end subroutine weigh_train

   !> Estimates from how every lobe's cycle answers.
   subroutine set_estimates(case, survey, responses, torque, choice, decision)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Cycle of the first lobe
      type(survey_t), intent(in) :: survey
      !> The answers
      type(response_t), intent(in) :: responses(:)
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      !> Counts the work
      type(choice_t), intent(inout) :: choice
      !> Gets the estimates
      type(decision_t), intent(inout) :: decision

      ! Change of the torque [N m]
      real(wp) :: change
      integer :: lobe

      choice%evaluations = choice%evaluations + sum(responses%evaluations)
      decision%estimates = huge(1.0_wp)
      if (.not. all(responses%is_known)) return
      change = 0.0_wp
      do lobe = 1, size(responses)
         change = change + followers_of(case, lobe)*responses(lobe)%torque
      end do
      decision%estimates(quantity_torque) = relative(change, least_torque(torque))
      decision%estimates(quantity_film) = margin*responses(1)%film
      decision%estimates(quantity_slip) = relative(responses(1)%sliding, abs(survey%slip) - survey%slip_error)
      where (decision%estimates > largest_estimate) decision%estimates = huge(1.0_wp)
   end subroutine set_estimates

   !> Camshaft bearings feel what changes the load: a single cam's are solved with the other load; those of several follow it no
   !> more than in proportion.
   subroutine add_bearings(case, model, responses, torque, decision)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of the first lobe shape
      type(model_t), intent(in) :: model
      !> How the cycle of each answers
      type(response_t), intent(in) :: responses(:)
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      !> Gets a larger estimate of the torque
      type(decision_t), intent(inout) :: decision

      type(error_t), allocatable :: failure
      ! Mean torque of the bearings without the effect [N m]
      real(wp) :: without

      associate (estimate => decision%estimates(quantity_torque))
         if (estimate > largest_estimate) return
         if (has_single_cam(case) .and. .not. allocated(torque%trouble)) then
            call mean_bearing_torque(case, model, responses(1)%changed, needs_turn(case), without, failure)
            estimate = estimate + relative(abs(torque%bearings - without), least_torque(torque))
            if (allocated(failure)) estimate = huge(1.0_wp)
         else
            estimate = max(estimate, margin*maxval(responses%load))
         end if
         if (estimate > largest_estimate) estimate = huge(1.0_wp)
      end associate
   end subroutine add_bearings

   !> How every lobe's cycle answers to a case without an effect.
   subroutine find_responses(case, models, surveys, effect, responses, error)
      !> The case with all its effects
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each
      type(survey_t), intent(in) :: surveys(:)
      !> Position in `effect_names`
      integer, intent(in) :: effect
      !> The answers
      type(response_t), allocatable, intent(out) :: responses(:)
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: variant
      type(model_t) :: model
      integer :: lobe

      allocate (responses(size(models)))
      variant = case
      call leave_out(variant, effect)
      do lobe = 1, size(models)
         model = models(lobe)
         call revise_model(model, variant, error)
         if (allocated(error)) return
         call respond(surveys(lobe), models(lobe), model, responses(lobe))
      end do
   end subroutine find_responses

   !> Camshaft bearings: they take torque and do nothing else. Several cams are not surveyed.
   subroutine weigh_bearings(case, surveys, torque, decision)
      type(case_t), intent(in) :: case
      !> Cycle of each lobe shape
      type(survey_t), intent(in) :: surveys(:)
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      type(decision_t), intent(inout) :: decision

      if (.not. has_single_cam(case)) then
         decision%reason = not_surveyed
         return
      end if
      decision%estimates([quantity_film, quantity_slip]) = 0.0_wp
      if (allocated(torque%trouble)) then
         decision%reason = "not estimated: "//torque%trouble
      else if (.not. allocated(surveys(1)%trouble)) then
         decision%estimates(quantity_torque) = relative(torque%bearings, least_torque(torque))
      end if
   end subroutine weigh_bearings

   !> What changes the friction of the camshaft bearings and nothing else.
   subroutine weigh_bearing_part(case, models, surveys, torque, decision)
      type(case_t), intent(in) :: case
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each
      type(survey_t), intent(in) :: surveys(:)
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      type(decision_t), intent(inout) :: decision

      type(case_t) :: variant
      type(error_t), allocatable :: failure
      ! Mean torque of the bearings without the effect [N m]
      real(wp) :: without

      decision%estimates([quantity_film, quantity_slip]) = 0.0_wp
      if (.not. has_single_cam(case)) then
         decision%reason = not_surveyed
      else if (allocated(torque%trouble)) then
         decision%reason = "not estimated: "//torque%trouble
      else if (.not. allocated(surveys(1)%trouble)) then
         variant = case
         call leave_out(variant, decision%effect)
         call mean_bearing_torque(variant, models(1), surveys(1), needs_turn(case), without, failure)
         if (allocated(failure)) then
            decision%reason = "not estimated: without it "//failure%message
         else
            decision%estimates(quantity_torque) = relative(abs(torque%bearings - without), least_torque(torque))
         end if
      end if
   end subroutine weigh_bearing_part

   !> Mean torque for all losses, less its uncertainty.
   pure function least_torque(torque) result(least)
      !> Mean torque for losses
      type(mean_torque_t), intent(in) :: torque
      !> It may be as little as this [N m]
      real(wp) :: least

      least = torque%followers - torque%error + torque%bearings
   end function least_torque

   !> Number of followers that a lobe shape drives.
   pure function followers_of(case, lobe) result(followers)
      type(case_t), intent(in) :: case
      !> Lobe shape
      integer, intent(in) :: lobe
      !> Their number
      integer :: followers

      followers = merge(1, 0, lobe == 1)
      if (allocated(case%cam_bearings)) followers = count(case%cam_bearings%cam_lobes == lobe)
   end function followers_of

   !> Relative change with the margin; huge where there is nothing, or perhaps nothing, that it could be relative to.
   pure function relative(change, whole)
      !> Change, and the least that it may be relative to [any]
      real(wp), intent(in) :: change, whole
      !> The change, with its margin [-]
      real(wp) :: relative

      relative = huge(1.0_wp)
      if (change <= 0.0_wp) relative = 0.0_wp
      if (whole > margin*change*tiny(1.0_wp)**0.25_wp) relative = margin*change/whole
   end function relative

end module camroller_effect_choice
