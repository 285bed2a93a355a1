!> Every deck in `decks/hard` with a numerical film: as a film law and with contacts solved over the cycle, or the error that it has
!> to end with.
module test_hard_ehl
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_ehl_cycle, only : ehl_cycle_t, ehl_cycle_options_t, integrate_ehl_cycle
   use camroller_ehl_profiles, only : plain_model
   use camroller_ehl_table, only : ehl_t
   use camroller_model, only : model_t
   use camroller_run, only : build_models
   use cycle_checks, only : sample_t, take_sample, compare_samples
   use deck_cases, only : get_deck_case
   use ehl_checks, only : cycle_facts_t, solve_and_check
   use run_settings, only : has_checks
   implicit none
   private

   public :: collect_hard_ehl

   !> What a deck with `&ehl` comes to
   type :: outcome_t
      character(len=28) :: deck
      !> What the error says with the numerical film as a law, and with contacts solved over the cycle; blank: none
      character(len=24) :: law = "", cycle = ""
      !> May the law give a cycle all the same? Where a turn leaves all but a hundred thousandth of a disturbance, the last digits
      !> decide whether errors of an integration keep the cycle open
      logical :: may_run = .false.
   end type outcome_t

   character(len=*), parameter :: heavy = "above 1.5 GPa", fast = "U outside", light = "W* outside", undercut = "undercut"

   !> All of them
   type(outcome_t), parameter :: outcomes(*) = [ &
      outcome_t("coarse_table"), outcome_t("cold_start_minus_20"), outcome_t("cold_start_minus_30"), &
      outcome_t("contact_loss_3200_rpm"), outcome_t("contact_loss_5000_rpm"), outcome_t("cranking_1_rpm"), &
      outcome_t("cranking_20_rpm_cold"), outcome_t("event_touches_cycle_end"), outcome_t("fine_table"), &
      outcome_t("frictionless_contact", "did not become periodic", "did not become periodic", .true.), &
      outcome_t("heavy_roller"), outcome_t("hollow_flank", "", heavy), outcome_t("hot_thin_film"), outcome_t("jumping_friction"), &
      outcome_t("touching_bearings"), &
      & outcome_t("hot_contact_of_cold_oil", "", "no film was found"), &
      outcome_t("large_fixed_steps"), outcome_t("light_base_circle_load"), outcome_t("light_roller"), &
      outcome_t("load_touches_zero"), outcome_t("narrow_contact", heavy, heavy), &
      outcome_t("near_standstill", fast, fast), outcome_t("nearly_undercut_nose", heavy, heavy), outcome_t("no_dwell"), &
      outcome_t("no_needle_friction"), outcome_t("no_rolling_resistance"), outcome_t("noisy_table"), &
      outcome_t("noisy_table_smoothed"), outcome_t("outside_film_law", fast, fast), outcome_t("outside_film_law_stop"), &
      outcome_t("periodic_table"), outcome_t("pressure_1500_MPa_barus"), outcome_t("pressure_1500_MPa_roelands"), &
      outcome_t("pressure_4000_MPa_barus", heavy, heavy), outcome_t("rigid_spring", heavy, heavy), &
      outcome_t("roller_started_backwards"), outcome_t("rough_surfaces"), outcome_t("sharp_cap"), &
      outcome_t("sharp_cap_eyring"), outcome_t("short_event"), outcome_t("short_undercut", undercut, undercut), &
      outcome_t("smooth_surfaces"), outcome_t("soft_spring"), outcome_t("steep_ramp"), outcome_t("stick_slip_boundary"), &
      outcome_t("stick_slip_boundary_reversal"), outcome_t("stick_slip_true"), outcome_t("straight_flank"), &
      outcome_t("stuck_roller"), outcome_t("towards_pivot_flight"), outcome_t("unloaded_base_circle"), &
      outcome_t("very_noisy_table", heavy, undercut), outcome_t("wide_contact", light, light)]
   !> Tables whose noise asks for thousands of short steps: one cycle with the larger error
   character(len=*), parameter :: noisy(*) = [character(len=12) :: "fine_table", "noisy_table"]
   !> Decks that differ from another in how the roller's spin is integrated, which solved contacts do not ask for
   character(len=*), parameter :: same(*) = [character(len=24) :: "large_fixed_steps", "roller_started_backwards"]

   !> Accuracy of the film law [-]; tolerances of both integrations with it [-]; nodes; errors of a step [-]
   real(wp), parameter :: film_accuracy = 5.0e-2_wp, tolerances(2) = [1.0e-6_wp, 1.0e-4_wp], &
      & step_errors(2) = [1.0e-3_wp, 1.0e-2_wp]
   integer, parameter :: nodes(2) = [65, 49]
   !> With run-time checks, which make a deck take ten times as long, one deck of so many
   integer, parameter :: checked_stride = 3
   !> What two grids of 65 and 49 nodes may differ by: the film, whose error is a few tenths of a per cent, and the slip, which is
   !> the film over a viscosity that the pressure raises; growth of the total variation of the slip with ten times smaller errors of
   !> a step, which is 0.95 to 1.13 here [-]
   real(wp), parameter :: usual_difference = 0.03_wp, most_variation = 1.25_wp

contains

   subroutine collect_hard_ehl(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("every hard deck with the numerical film as law passes the checks of a cycle, or its error names the cause", &
            & test_law), &
         new_unittest("contacts of every hard deck solved over the cycle pass the checks, or an error names the cause", &
            & test_cycle), &
         new_unittest("cycles of steady films find the balance at each angle, or an error says that it jumps", test_steady) &
         ]
   end subroutine collect_hard_ehl

   !> Read a hard deck and give it a numerical film.
   subroutine get_case(name, case, failure)
      character(len=*), intent(in) :: name
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: failure

      call get_deck_case("decks/hard/"//trim(name)//".nml", case, failure)
      if (.not. allocated(failure)) case%ehl = ehl_t(accuracy=film_accuracy)
   end subroutine get_case

   subroutine test_law(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: list, trouble
      integer :: i

      list = ""
      do i = 1, size(outcomes), merge(checked_stride, 1, has_checks())
         call run_law(outcomes(i), trouble)
         if (trouble == "" .and. outcomes(i)%may_run) cycle
         call compare(outcomes(i)%deck, outcomes(i)%law, trouble, list)
      end do
      if (list /= "") call test_failed(error, list)
   end subroutine test_law

   !> Note where what happened is not what was expected.
   subroutine compare(deck, expected, trouble, list)
      character(len=*), intent(in) :: deck, expected, trouble
      character(len=:), allocatable, intent(inout) :: list

      if (trouble == "" .and. expected == "") return
      if (expected /= "" .and. index(trouble, trim(expected)) > 0) return
      list = list//new_line("a")//trim(deck)//": "//trim(trouble)
      if (expected /= "") list = list//" (expected: "//trim(expected)//")"
   end subroutine compare

   !> The numerical film as a law: two methods with two tolerances agree on a cycle that passes every check.
   subroutine run_law(outcome, trouble)
      type(outcome_t), intent(in) :: outcome
      character(len=:), allocatable, intent(out) :: trouble
      type(case_t) :: case
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure
      type(sample_t) :: reference, sample

      call get_case(outcome%deck, case, failure)
      if (.not. allocated(failure)) call build_models(case, models, failure)
      if (allocated(failure)) then
         trouble = failure%message
         return
      end if
      call take_sample(models(1), case%numerics, "rodas5p", tolerances(1), reference)
      trouble = reference%trouble
      if (trouble /= "") return
      ! Where a turn leaves nearly all of a disturbance, a start that closes to the larger tolerance may be far from the cycle's
      call take_sample(models(1), case%numerics, "hermite", tolerances(merge(1, 2, outcome%may_run)), sample)
      trouble = sample%trouble
      if (trouble == "") trouble = compare_samples(sample, reference)
   end subroutine run_law

   subroutine test_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: list, trouble
      integer :: i

      list = ""
      do i = 1, size(outcomes), merge(checked_stride, 1, has_checks())
         call run_cycle(outcomes(i)%deck, trouble)
         call compare(outcomes(i)%deck, outcomes(i)%cycle, trouble, list)
      end do
      if (list /= "") call test_failed(error, list)
   end subroutine test_cycle

   !> Steady films where a spike of the pressure, narrower than the nodes, holds the roller: friction and load change each other by
   !> more than their own change.
   subroutine test_steady(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: decks(2) = [character(len=24) :: "contact_loss_5000_rpm", "sharp_cap"]
      integer, parameter :: sizes(2) = [65, 129]
      type(case_t) :: case
      type(model_t) :: model
      type(ehl_cycle_t) :: solved
      type(error_t), allocatable :: failure
      integer :: i, k

      do i = 1, size(decks)
         call get_case(decks(i), case, failure)
         if (.not. allocated(failure)) call plain_model(model, case, .false., failure)
         do k = 1, size(sizes)
            if (.not. allocated(failure)) call integrate_ehl_cycle(solved, model, &
               & ehl_cycle_options_t(nodes=sizes(k), is_transient=.false.), failure)
            if (.not. allocated(failure)) cycle
            if (sizes(k) > 65 .and. index(failure%message, "the balance of load and friction") > 0) deallocate (failure)
            if (allocated(failure)) call test_failed(error, trim(decks(i))//": "//failure%message)
            if (allocated(error)) return
         end do
      end do
   end subroutine test_steady

   !> Contacts solved over the cycle: two step errors and two grids agree on cycles that pass every check.
   subroutine run_cycle(name, trouble)
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: trouble
      type(case_t) :: case
      type(model_t) :: model
      type(error_t), allocatable :: failure
      type(cycle_facts_t) :: facts(3)
      integer :: i
      logical :: is_noisy

      trouble = ""
      if (any(same == name)) return
      call get_case(name, case, failure)
      if (.not. allocated(failure)) call plain_model(model, case, .false., failure)
      is_noisy = any(noisy == name)
      do i = 1, merge(1, 3, is_noisy)
         if (allocated(failure) .or. trouble /= "") exit
         call solve_and_check(model, nodes(merge(2, 1, i == 3)), step_errors(merge(1, 2, i == 1 .and. .not. is_noisy)), facts(i), &
            & trouble, failure)
      end do
      if (allocated(failure)) trouble = failure%message
      if (trouble /= "" .or. is_noisy) return
      trouble = disagreement(facts, differences_of(name))
   end subroutine run_cycle

   !> What two grids may differ by: film, and slip over its largest size.
   pure function differences_of(name) result(differences)
      character(len=*), intent(in) :: name
      real(wp) :: differences(2)

      select case (name)
      case ("cranking_1_rpm")
         ! Asperities carry the load, and the inlet of a film of a nanometre is narrower than the steps of either grid
         differences = [0.2_wp, usual_difference]
      case ("pressure_1500_MPa_barus", "pressure_1500_MPa_roelands")
         ! Viscosity grows up to 10^14-fold, and what holds the roller comes from the few nodes of the pressure spike
         differences = [usual_difference, 0.06_wp]
      case default
         differences = usual_difference
      end select
   end function differences_of

   !> Where the cycles of a deck do not agree: the second has longer steps than the first, the third fewer nodes than the second.
   pure function disagreement(facts, differences) result(trouble)
      type(cycle_facts_t), intent(in) :: facts(3)
      real(wp), intent(in) :: differences(2)
      character(len=:), allocatable :: trouble

      trouble = ""
      if (.not. abs(facts(2)%film/facts(1)%film - 1.0_wp) <= step_errors(2)) trouble = "film by other steps"
      if (.not. abs(facts(2)%slip - facts(1)%slip) <= 3.0_wp*step_errors(2)*facts(1)%largest_slip) trouble = "slip by other steps"
      ! Steps that chatter chatter more the more there are of them
      if (.not. facts(1)%variation <= most_variation*facts(2)%variation) trouble = "the slip chatters"
      if (.not. abs(facts(3)%film/facts(2)%film - 1.0_wp) <= differences(1)) trouble = "film on another grid"
      if (.not. abs(facts(3)%slip - facts(2)%slip) <= differences(2)*facts(1)%largest_slip) trouble = "slip on another grid"
   end function disagreement

end module test_hard_ehl
