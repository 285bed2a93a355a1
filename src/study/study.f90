!> Cost of accuracy: a case computed with many methods and settings, each with its errors relative to one reference, its work and
!> its time.
!>
!> In: a case. Out: rows of one table. Each family of methods has a reference of its own: two unlike integration methods that
!> must agree, the finest table of numerical films, or the finest solution of the contact over the cycle.
module camroller_study
   use camroller_kinds, only : wp, degree, not_a_number
   use camroller_names, only : name_length
   use camroller_error, only : error_t, raise, add_context, kind_convergence
   use camroller_case, only : case_t, automatic_method, quasi_static, select_listed, select_names
   use camroller_number_text, only : integer_text, number_text
   use camroller_ode_methods, only : method_facts
   use camroller_study_table, only : study_table_t, add_numbers, add_words, new_row, set_number, set_word
   use camroller_study_trial, only : trial_t, run_trial, solve_trial, errors_against, smallest_error
   implicit none
   private

   public :: way_t, plan_t, plan_for, new_study_table, study_case, study_film, check_agreement, list_ways, apply_way
   public :: dial_reference

   !> A way to compute a case
   type :: way_t
      !> Method, film law or model
      character(len=name_length) :: name = ""
      !> What its setting is: one of the names below
      character(len=name_length) :: dial = ""
      !> The setting; a fixed step in degrees, not a number where there is none [-]
      real(wp) :: setting = 0.0_wp
   end type way_t

   !> Dials of the ways
   character(len=*), parameter :: dial_accuracy = "accuracy", dial_tolerance = "tolerance", dial_step = "step [deg]", &
      & dial_film = "film accuracy", dial_nodes = "nodes", dial_none = "", dial_reference = "reference"

   !> How a case is studied: what counts as right, and what is tried
   type :: plan_t
      !> Two unlike methods of the reference
      character(len=name_length) :: methods(2) = [character(len=name_length) :: "rodas5p", "dormand_prince"]
      !> Their tolerances; periodicity of both [-]
      real(wp) :: tolerances(2) = [1.0e-11_wp, 1.0e-13_wp], periodicity = 1.0e-10_wp
      !> Error below which two results count as equal: the smallest that is shown [-]
      real(wp) :: smallest_error = smallest_error
      !> Tightest accuracy and tolerance that are tried [-]
      real(wp) :: tightest_accuracy = 1.0e-7_wp, tightest_tolerance = 1.0e-8_wp
      !> Is the train flexible? It takes no method that controls no error, and none for one unknown
      logical :: is_flexible = .false.
   end type plan_t

   !> Method in the place of the second one where that has no result: implicit, as the first one, and not of its family
   character(len=*), parameter :: other_method = "radau5"
   !> Part of the smallest error shown by which the two references may differ [-]
   real(wp), parameter :: agreement = 0.1_wp
   !> Accuracies asked for, tolerances, fixed steps [deg]; those of a quick study
   real(wp), parameter :: accuracies(*) = [1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp, 1.0e-5_wp, 1.0e-6_wp, 1.0e-7_wp], &
      & tolerances(*) = [1.0e-1_wp, 1.0e-2_wp, 1.0e-3_wp, 1.0e-4_wp, 1.0e-5_wp, 1.0e-6_wp, 1.0e-7_wp, 1.0e-8_wp], &
      & steps(*) = [2.0_wp, 1.0_wp, 0.5_wp, 0.2_wp, 0.1_wp, 0.05_wp, 0.02_wp, 0.01_wp, 0.005_wp, 0.002_wp, 0.001_wp], &
      & few_tolerances(*) = [1.0e-2_wp, 1.0e-4_wp, 1.0e-6_wp], few_steps(*) = [1.0_wp, 0.1_wp]
   !> Accuracies of a table of numerical films, that of the reference [-]
   real(wp), parameter :: film_accuracies(*) = [1.0e-1_wp, 3.0e-2_wp, 1.0e-2_wp, 3.0e-3_wp], film_reference = 1.0e-3_wp
   !> Nodes of contacts solved over the cycle, those of the reference; errors of a step of both [-]
   integer, parameter :: nodes(*) = [33, 65, 129], reference_nodes = 257
   real(wp), parameter :: step_error = 1.0e-3_wp, reference_step_error = 3.0e-4_wp ! [-]
   !> Trials of a quick study of films, its nodes of the reference
   integer, parameter :: quick_trials = 2, quick_nodes = 129

contains

   !> The empty table.
   subroutine new_study_table(table)
      !> The table
      type(study_table_t), intent(out) :: table

      call add_words(table, "way", "method, film law or model", "study")
      call add_words(table, "dial", "what the setting is; 'reference' for what counts as right", "study")
      call add_words(table, "message", "error message; of a reference that is there, why it is by other methods; or empty", &
         & "study")
      call add_numbers(table, "case", "1", "case of the sweep", "study")
      call add_numbers(table, "status", "1", "0, or the kind of the error", "study")
      call add_numbers(table, "setting", "1", "accuracy, tolerance, fixed step in degrees, or nodes", "study")
      call add_numbers(table, "error_sliding_speed", "1", "largest error of the sliding speed relative to its largest value", &
         & "study")
      call add_numbers(table, "error_mean_friction", "1", "relative error of the mean torque for all losses", "study")
      call add_numbers(table, "error_smallest_film", "1", "relative error of the smallest film", "study")
      call add_numbers(table, "estimated_error", "1", "error of the sliding speed as the program estimates it", "study")
      call add_numbers(table, "evaluations", "1", "evaluations of the roller equation", "study")
      call add_numbers(table, "steps", "1", "accepted steps", "study")
      call add_numbers(table, "time", "s", "median processor time of a whole run", "study")
   end subroutine new_study_table

   !> Every method over its tolerances or steps, and the accuracy that a deck asks for, all with the effects that the deck lists:
   !> which of them a case needs depends on the method.
   subroutine study_case(table, position, case, repeats, is_quick, error)
      !> Table to extend
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Runs whose median time counts
      integer, intent(in) :: repeats
      !> A few trials only?
      logical, intent(in) :: is_quick
      !> Why there is no reference
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: listed
      type(trial_t) :: reference, trial
      type(plan_t) :: plan
      type(way_t), allocatable :: ways(:)
      ! What the two references differ by [-]
      real(wp) :: disagreement
      character(len=:), allocatable :: note
      integer :: i

      listed = case
      listed%effects%select = select_names(select_listed)
      plan = plan_for(case)
      call make_reference(plan, listed, reference, disagreement, note, error)
      call add_reference(table, position, "two methods", reference, disagreement, error, note)
      if (allocated(error)) return
      call list_ways(plan, ways, is_quick)
      do i = 1, size(ways)
         call run_trial(apply_way(ways(i), listed), repeats, trial)
         call add_trial(table, position, ways(i), reference, trial, plan%smallest_error)
      end do
   end subroutine study_case

   !> How a case is studied. The state of a flexible train has components of very different sizes and dozens of stops a cycle: its
   !> references agree to a tenth of 1e-6 at tolerances that cost a second each.
   pure function plan_for(case) result(plan)
      !> The case
      type(case_t), intent(in) :: case
      !> How it is studied
      type(plan_t) :: plan

      plan%is_flexible = allocated(case%dynamics)
      if (.not. plan%is_flexible) return
      plan%methods(2) = "radau5"
      plan%tolerances = 1.0e-8_wp
      plan%smallest_error = 1.0e-6_wp
      plan%tightest_accuracy = 1.0e-5_wp
      plan%tightest_tolerance = 1.0e-6_wp
   end function plan_for

   !> The result by two unlike methods at tight tolerances; an error where they disagree. Where the second one, which is explicit,
   !> has none, as with slip that decays too fast for its steps, another implicit method takes its place.
   subroutine make_reference(plan, case, reference, disagreement, note, error)
      !> How it is made; out: with the methods that made it
      type(plan_t), intent(inout) :: plan
      type(case_t), intent(in) :: case
      !> What counts as right
      type(trial_t), intent(out) :: reference
      !> Largest of the errors of one against the other [-]
      real(wp), intent(out) :: disagreement
      !> Why other methods than planned made it; empty where none did
      character(len=:), allocatable, intent(out) :: note
      !> Error of a trial, convergence error where they disagree
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: variant
      type(trial_t) :: trials(2)
      integer :: i

      note = ""
      disagreement = not_a_number()
      variant = case
      variant%numerics%periodicity = min(case%numerics%periodicity, plan%periodicity)
      do i = 1, size(trials)
         call run_method(i)
         if (i == 2 .and. trials(i)%status == kind_convergence .and. plan%methods(i) /= other_method) then
            note = "reference by "//trim(plan%methods(1))//" and "//other_method//", two implicit methods, since "// &
               & trim(plan%methods(i))//", which is explicit, has no result"
            plan%methods(i) = other_method
            plan%tolerances(i) = plan%tolerances(1)
            call run_method(i)
         end if
         call raise_failure(trials(i), trim(plan%methods(i)), error)
         if (.not. allocated(error)) call check_period(trials(i)%period, error)
         if (allocated(error)) return
      end do
      reference = trials(1)
      disagreement = maxval(errors_against(trials(1), trials(2)))
      call check_agreement(plan, disagreement, error)

   contains

      !> The case by one of the methods.
      subroutine run_method(i)
         !> Which
         integer, intent(in) :: i

         variant%numerics%method = plan%methods(i)
         variant%numerics%tolerance = plan%tolerances(i)
         call run_trial(variant, 1, trials(i))
      end subroutine run_method

   end subroutine make_reference

   !> Refuse a reference whose turns differ: the last turn of a way may be another one.
   subroutine check_period(period, error)
      !> Cycles of its period, 0 where it has none
      integer, intent(in) :: period
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (period > 1) then
         call raise(error, kind_convergence, "no reference: the motion of the train repeats after "//integer_text(period)// &
            & " cycles only, and two ways may end with different turns of them")
      else if (period == 0) then
         call raise(error, kind_convergence, "no reference: the motion of the train has no period, and no two ways have the "// &
            & "same turns")
      end if
   end subroutine check_period

   !> Refuse references that differ by too much of the smallest error that is shown.
   subroutine check_agreement(plan, disagreement, error)
      !> How they were made
      type(plan_t), intent(in) :: plan
      !> What two methods differ by [-]
      real(wp), intent(in) :: disagreement
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (disagreement <= agreement*plan%smallest_error) return
      call raise(error, kind_convergence, "no reference: the results of "//trim(plan%methods(1))//" and "// &
         & trim(plan%methods(2))//" differ by "//trim(number_text(disagreement, 2))//"; "// &
         & trim(number_text(agreement*plan%smallest_error, 2))//" is allowed")
   end subroutine check_agreement

   !> The failure of a reference as an error.
   subroutine raise_failure(trial, name, error)
      type(trial_t), intent(in) :: trial
      !> Its method or model
      character(len=*), intent(in) :: name
      !> Its error, if it has one
      type(error_t), allocatable, intent(out) :: error

      if (trial%status == 0) return
      call raise(error, trial%status, trial%message)
      call add_context(error, "reference by "//name)
   end subroutine raise_failure

   !> All ways to integrate a case.
   subroutine list_ways(plan, ways, is_quick)
      !> How the case is studied
      type(plan_t), intent(in) :: plan
      !> The ways
      type(way_t), allocatable, intent(out) :: ways(:)
      !> A few only?
      logical, intent(in) :: is_quick

      ! Settings of the ways [unit of the dial]
      real(wp), allocatable :: fine(:), fixed(:), wanted(:)
      integer :: method, i

      fine = tolerances
      fixed = steps
      if (is_quick) then
         fine = few_tolerances
         fixed = few_steps
      end if
      fine = pack(fine, fine > 0.9_wp*plan%tightest_tolerance)
      wanted = pack(accuracies, accuracies > 0.9_wp*plan%tightest_accuracy)
      ways = [(way_t(automatic_method, dial_accuracy, wanted(i)), i=1, size(wanted))]
      do method = 1, size(method_facts)
         if (plan%is_flexible .and. (method_facts(method)%companion_order == 0 .or. method_facts(method)%max_components == 1)) cycle
         if (method_facts(method)%companion_order > 0) then
            ways = [ways, (way_t(method_facts(method)%name, dial_tolerance, fine(i)), i=1, size(fine))]
         else
            ways = [ways, (way_t(method_facts(method)%name, dial_step, fixed(i)), i=1, size(fixed))]
         end if
      end do
      if (.not. plan%is_flexible) ways = [ways, way_t(quasi_static, dial_tolerance, few_tolerances(1))]
   end subroutine list_ways

   !> A case that is to be computed in some way.
   pure function apply_way(way, case) result(variant)
      !> The way
      type(way_t), intent(in) :: way
      !> The case
      type(case_t), intent(in) :: case
      !> The case, with other numerics or another film
      type(case_t) :: variant

      variant = case
      select case (way%dial)
      case (dial_accuracy)
         variant%numerics%method = way%name
         variant%numerics%tolerance = 0.0_wp
         variant%numerics%accuracy = way%setting
      case (dial_tolerance)
         variant%numerics%method = way%name
         variant%numerics%tolerance = way%setting
      case (dial_step)
         variant%numerics%method = way%name
         variant%numerics%step = way%setting*degree
      case (dial_film)
         if (.not. allocated(variant%ehl)) allocate (variant%ehl)
         variant%ehl%accuracy = way%setting
      case (dial_none)
         if (allocated(variant%ehl)) deallocate (variant%ehl)
      end select
   end function apply_way

   !> The numerical film: as a law over the accuracy of its table, and solved over the cycle over nodes, beside the film law.
   subroutine study_film(table, position, case, repeats, is_quick, error)
      !> Table to extend
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> The case
      type(case_t), intent(in) :: case
      !> Trials whose median time counts
      integer, intent(in) :: repeats
      !> A few trials only?
      logical, intent(in) :: is_quick
      !> Why there is no reference
      type(error_t), allocatable, intent(out) :: error

      type(case_t) :: follower
      type(trial_t) :: reference, trial
      type(way_t) :: law
      type(error_t), allocatable :: failure
      integer :: i

      follower = case
      follower%effects%select = select_names(select_listed)
      if (allocated(follower%cam_bearings)) deallocate (follower%cam_bearings)
      if (.not. allocated(follower%ehl)) allocate (follower%ehl)
      follower%ehl%profiles = .false.
      law = way_t(case%film%law, dial_none, not_a_number())

      call run_trial(apply_way(way_t("", dial_film, film_reference), follower), 1, reference)
      call raise_failure(reference, "numerical film", error)
      call add_reference(table, position, "numerical film", reference, not_a_number(), error)
      if (.not. allocated(error)) then
         call run_trial(apply_way(law, follower), repeats, trial)
         call add_trial(table, position, law, reference, trial)
         do i = 1, merge(quick_trials, size(film_accuracies), is_quick)
            associate (way => way_t("numerical film", dial_film, film_accuracies(i)))
               call run_trial(apply_way(way, follower), repeats, trial)
               call add_trial(table, position, way, reference, trial)
            end associate
         end do
      end if

      ! Like with like: the film that is solved over the cycle has one temperature
      if (allocated(follower%heat)) deallocate (follower%heat)
      call solve_trial(follower, merge(quick_nodes, reference_nodes, is_quick), reference_step_error, 1, reference)
      call raise_failure(reference, "film solved over the cycle", failure)
      call add_reference(table, position, "solved over cycle", reference, not_a_number(), failure)
      if (allocated(failure)) then
         if (.not. allocated(error)) call move_alloc(failure, error)
         return
      end if
      do i = 1, merge(quick_trials, size(nodes), is_quick)
         call solve_trial(follower, nodes(i), step_error, repeats, trial)
         call add_trial(table, position, way_t("solved over cycle", dial_nodes, real(nodes(i), wp)), reference, trial)
      end do
      call run_trial(follower, repeats, trial)
      call add_trial(table, position, way_t("steady film", dial_film, follower%ehl%accuracy), reference, trial)
   end subroutine study_film

   !> Add what counts as right, or why nothing does.
   subroutine add_reference(table, position, name, reference, disagreement, error, note)
      !> Table to extend
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1
      integer, intent(in) :: position
      !> Name of the reference
      character(len=*), intent(in) :: name
      !> What counts as right
      type(trial_t), intent(in) :: reference
      !> What two methods differ by; not a number where there is one [-]
      real(wp), intent(in) :: disagreement
      !> Why there is no reference, if there is none
      type(error_t), allocatable, intent(in) :: error
      !> Why it is by other methods than usual; absent or empty: it is not
      character(len=*), intent(in), optional :: note

      call new_row(table)
      call set_number(table, "case", real(position - 1, wp))
      call set_word(table, "way", name)
      call set_word(table, "dial", dial_reference)
      if (allocated(error)) then
         call set_number(table, "status", real(error%kind, wp))
         call set_word(table, "message", error%message)
      else
         call set_number(table, "status", 0.0_wp)
         if (present(note)) call set_word(table, "message", note)
         call set_number(table, "error_sliding_speed", disagreement)
         call set_work(table, reference)
      end if
   end subroutine add_reference

   !> Add a trial with its errors.
   subroutine add_trial(table, position, way, reference, trial, least)
      !> Table to extend
      type(study_table_t), intent(inout) :: table
      !> Number of the case, from 1
      integer, intent(in) :: position
      type(way_t), intent(in) :: way
      !> What counts as right
      type(trial_t), intent(in) :: reference
      !> Outcome of the trial
      type(trial_t), intent(in) :: trial
      !> Smallest error that is shown; absent: that of a rigid train [-]
      real(wp), intent(in), optional :: least

      ! Errors of sliding speed, mean torque for losses and smallest film [-]
      real(wp) :: errors(3)

      call new_row(table)
      call set_number(table, "case", real(position - 1, wp))
      call set_number(table, "status", real(trial%status, wp))
      call set_number(table, "setting", way%setting)
      call set_word(table, "way", way%name)
      call set_word(table, "dial", way%dial)
      call set_word(table, "message", trial%message)
      if (trial%status /= 0) return
      errors = max(errors_against(reference, trial), smallest_error)
      if (present(least)) errors = max(errors, least)
      call set_number(table, "error_sliding_speed", errors(1))
      call set_number(table, "error_mean_friction", errors(2))
      call set_number(table, "error_smallest_film", errors(3))
      call set_work(table, trial)
   end subroutine add_trial

   !> Give the last row what a run says of itself.
   subroutine set_work(table, trial)
      type(study_table_t), intent(inout) :: table
      !> The run
      type(trial_t), intent(in) :: trial

      call set_number(table, "estimated_error", trial%estimated_error)
      call set_number(table, "evaluations", trial%evaluations)
      call set_number(table, "steps", trial%steps)
      call set_number(table, "time", trial%time)
   end subroutine set_work

end module camroller_study
