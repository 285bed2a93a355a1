!> Influence and cost of each effect of a case: the case with all of them, with each left out, with each alone, and with those
!> that `select = 'needed'` keeps.
!>
!> In: a case. Out: rows of `study_table_t`. A variant that fails is a row with a message and no numbers.
module camroller_audit
   use camroller_kinds, only : infinite_if_huge, wp
   use camroller_error, only : error_t, raise
   use camroller_case, only : case_t, select_listed, select_names, select_needed
   use camroller_effect_choice, only : choose_effects
   use camroller_effect_list, only : choice_t, decision_t, effect_names, effect_count, effect_bearings, effect_ehl, &
      & effect_rolling, has_effect, leave_all_but, leave_out, needs_bearings
   use camroller_model, only : model_t
   use camroller_run, only : build_models
   use camroller_study_table, only : study_table_t, add_numbers, add_words, new_row, set_number, set_word
   use camroller_study_trial, only : trial_t, run_trial
   use camroller_summary, only : slip_meaning
   implicit none
   private

   public :: new_audit_table, audit_case
   public :: run_listed

   !> Runs of an audit: everything; without an effect; without all; with one alone; with those that are needed
   character(len=*), parameter :: run_listed = "listed", run_without = "without", run_none = "none", run_alone = "alone", &
      & run_needed = "needed"
   !> What an estimate is that says nothing
   character(len=*), parameter :: no_bound = "infinite where there is no bound"

   !> What effects are judged by, as columns, in the order of `quantity_names`
   character(len=*), parameter, public :: judged(*) = [character(len=12) :: "mean_torque", "minimum_film", "slip"]

contains

   !> Table of an audit, one row a run.
   subroutine new_audit_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call add_words(table, "effect", "effect that is left out, or the only one", "audit")
      call add_words(table, "run", "all effects, without one, none, one alone, or those that are needed", "audit")
      call add_words(table, "reason", "indicator that decides about the effect", "audit")
      call add_words(table, "message", "error message, or empty", "audit")
      call add_numbers(table, "case", "1", "case of the sweep", "audit")
      call add_numbers(table, "status", "1", "0, or the kind of the error", "audit")
      call add_numbers(table, "mean_torque", "N m", "mean torque for all losses", "torque")
      call add_numbers(table, "minimum_film", "m", "smallest film", "film")
      call add_numbers(table, "slip", "1", slip_meaning, "roller")
      call add_numbers(table, "change_mean_torque", "1", "change of the mean torque relative to the value with all effects", &
         & "audit")
      call add_numbers(table, "change_minimum_film", "1", "change of the smallest film relative to the value with all effects", &
         & "audit")
      call add_numbers(table, "change_slip", "1", "change of the slip relative to the magnitude of the value with all effects", &
         & "audit")
      call add_numbers(table, "estimate_mean_torque", "1", "largest change of the mean torque expected before the run; "// &
         & no_bound, "audit")
      call add_numbers(table, "estimate_minimum_film", "1", "largest change of the smallest film expected before the run; "// &
         & no_bound, "audit")
      call add_numbers(table, "estimate_slip", "1", "largest change of the slip expected before the run; "// &
         & no_bound, "audit")
      call add_numbers(table, "is_left_out", "1", "1 where the choice of needed effects leaves it out", "audit")
      call add_numbers(table, "evaluations", "1", "evaluations of the roller equation", "audit")
      call add_numbers(table, "time", "s", "median processor time of a run", "audit")
      call add_numbers(table, "time_share", "1", "fraction of the time of the run with all effects that is saved", "audit")
   end subroutine new_audit_table

   !> Every run of a case.
   subroutine audit_case(table, position, case, repeats, with_alone, error)
      !> The table
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1; the table counts from 0
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Runs of which the quickest counts
      integer, intent(in) :: repeats
      !> Runs with one effect alone, too?
      logical, intent(in) :: with_alone
      !> What went wrong with the case as it is
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: listed, variant
      type(choice_t) :: choice
      type(model_t), allocatable :: models(:)
      type(trial_t) :: full, none, outcome
      integer :: i

      listed = case
      listed%effects%select = select_names(select_listed)
      call build_models(listed, models, error)
      if (.not. allocated(error)) call choose_effects(listed, models, variant, choice, error)
      if (allocated(error)) return
      call run_trial(listed, repeats, full)
      if (full%status /= 0) call raise(error, full%status, full%message)
      call add_outcome(table, position, run_listed, full, full, full)
      variant = listed
      variant%effects%select = select_names(select_needed)
      call run_trial(variant, repeats, outcome)
      call add_outcome(table, position, run_needed, full, full, outcome, choice=choice)
      do i = 1, size(choice%decisions)
         variant = listed
         call leave_out(variant, choice%decisions(i)%effect)
         call run_trial(variant, repeats, outcome)
         call add_outcome(table, position, run_without, full, full, outcome, choice%decisions(i))
      end do
      if (.not. with_alone) return
      variant = listed
      call leave_all_but(variant, 0)
      call run_trial(variant, repeats, none)
      call add_outcome(table, position, run_none, full, full, none)
      do i = 1, effect_count
         ! A law has always another in its place, and bearings need what presses on them
         if (.not. has_effect(listed, i) .or. (i > effect_rolling .and. i <= effect_ehl) &
            & .or. any(i == [effect_bearings, needs_bearings])) cycle
         variant = listed
         call leave_all_but(variant, i)
         call run_trial(variant, repeats, outcome)
         call add_outcome(table, position, run_alone, full, none, outcome, effect=i)
      end do
   end subroutine audit_case

   !> Row of a run.
   subroutine add_outcome(table, position, run, full, base, outcome, decision, effect, choice)
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> Name of the run
      character(len=*), intent(in) :: run
      !> What came of the run with all effects, of the one that it is compared with, of itself
      type(trial_t), intent(in) :: full, base, outcome
      !> What was decided about the effect that is left out
      type(decision_t), intent(in), optional :: decision
      !> Effect that is alone, position in `effect_names`
      integer, intent(in), optional :: effect
      !> What was decided, for the run with the effects that are needed
      type(choice_t), intent(in), optional :: choice

      ! Mean torque [N m], smallest film [m] and slip [-] of the run; their changes over the values with all effects [-]
      real(wp), dimension(size(judged)) :: values, changes
      integer :: i

      call new_row(table)
      call set_number(table, "case", real(position - 1, wp))
      call set_number(table, "status", real(outcome%status, wp))
      call set_word(table, "run", run)
      call set_word(table, "message", outcome%message)
      if (outcome%status == 0) then
         values = quantities_of(outcome)
         do i = 1, size(judged)
            call set_number(table, trim(judged(i)), values(i))
         end do
         call set_number(table, "evaluations", outcome%evaluations)
         call set_number(table, "time", outcome%time)
         if (full%status == 0 .and. base%status == 0) then
            changes = (values - quantities_of(base))/max(abs(quantities_of(full)), tiny(1.0_wp))
            do i = 1, size(judged)
               call set_number(table, "change_"//trim(judged(i)), changes(i))
            end do
            call set_number(table, "time_share", (base%time - outcome%time)/max(full%time, tiny(1.0_wp)))
         end if
      end if
      if (present(effect)) call set_word(table, "effect", effect_names(effect))
      if (present(decision)) then
         call set_word(table, "effect", effect_names(decision%effect))
         call set_word(table, "reason", decision%reason)
         do i = 1, size(judged)
            call set_number(table, "estimate_"//trim(judged(i)), infinite_if_huge(decision%estimates(i)))
         end do
         call set_number(table, "is_left_out", merge(0.0_wp, 1.0_wp, decision%is_used))
      end if
      if (present(choice)) call set_number(table, "estimate_"//trim(judged(choice%quantity)), choice%bound)
   end subroutine add_outcome

   !> What effects are judged by, in the order of `quantity_names`.
   pure function quantities_of(trial) result(values)
      type(trial_t), intent(in) :: trial
      !> Mean torque for all losses [N m], smallest film [m], slip per revolution [-]
      real(wp) :: values(size(judged))

      values = [trial%mean_friction, trial%smallest_film, trial%revolution_slip]
   end function quantities_of

end module camroller_audit
