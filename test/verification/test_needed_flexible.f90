!> A flexible train, its spring's modes and its adjuster are left out where they do not matter, and nowhere else.
!>
!> The environment variables NEEDED_FLEXIBLE and NEEDED_SEED choose how many random trains and which; `make needed` sets them, and
!> NEEDED_TABLE, which asks for a table of how far below their estimates the changes are. A train takes as long as hundreds of rigid
!> ones: a usual run has few.
module test_needed_flexible
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed, check
   use camroller_kinds, only : wp, pi
   use camroller_case, only : case_t, numerics_t, quantity_names
   use camroller_effect_choice, only : choose_effects
   use camroller_effect_list, only : choice_t, effect_dynamics, effect_surge
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_result, only : result_t, find_quantity
   use camroller_run, only : build_models, run_case
   use camroller_samples, only : sample_independent
   use camroller_study_table, only : study_table_t
   use change_tally, only : tally_t, start_tally, audit, compare, print_tally
   use flexible_cases, only : add_dynamics, add_joints
   use reference_cases, only : thesis_case, set_point
   use run_settings, only : has_checks, number_from
   use closeness, only : has_failed
   implicit none
   private

   public :: collect_needed_flexible

   !> Trains of a test run with and without run-time checks, and the number of the first, which has estimates
   integer, parameter :: usual_cases = 2, few_cases = 1, usual_seed = 3

contains

   !> Collect the tests.
   subroutine collect_needed_flexible(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("no change is larger than its estimate, for random flexible trains", test_flexible), &
         new_unittest("a flexible train is left out where it does not matter, and its parts", test_train), &
         new_unittest("no estimate where a train parts, pumps up, has lash or friction that falls with speed", test_wild_train) &
         ]
   end subroutine collect_needed_flexible

   !> Random flexible trains around the reference train; the accuracy of their runs is that which tells changes from estimates.
   subroutine test_flexible(error)
      type(error_type), allocatable, intent(out) :: error
      ! Accuracy of the runs, and of those that decide [-]
      real(wp), parameter :: usual = 1.0e-3_wp, fine = 1.0e-5_wp
      type(tally_t) :: tally, trial
      type(study_table_t) :: table
      type(case_t) :: case
      character(len=40) :: name
      integer :: seed, first, cases, status

      cases = number_from("NEEDED_FLEXIBLE", merge(few_cases, usual_cases, has_checks()))
      first = number_from("NEEDED_SEED", usual_seed)
      call start_tally(tally)
      do seed = first, first + cases - 1
         call draw_train(seed, case)
         call audit(case, usual, table)
         call start_tally(trial)
         call compare(table, "", usual, trial)
         write (name, "(a, i0)") "NEEDED_FLEXIBLE, seed ", seed
         if (trial%misses == "") then
            call compare(table, trim(name), usual, tally)
            cycle
         end if
         call audit(case, fine, table)
         tally%repeated = tally%repeated + 1
         call compare(table, trim(name), fine, tally)
      end do
      call get_environment_variable("NEEDED_TABLE", status=status)
      if (status == 0) call print_tally(tally, cases, seed)
      if (tally%misses == "" .and. sum(tally%known(effect_dynamics, :)) == 0 .and. cases > 0) tally%misses = &
         & "nothing is estimated"
      if (tally%misses /= "") call test_failed(error, tally%misses)
   end subroutine test_flexible

   !> A flexible train by its number.
   subroutine draw_train(seed, case)
      integer, intent(in) :: seed
      type(case_t), intent(out) :: case
      ! Numbers from 0 to 1 [-]
      real(wp) :: x(16)
      integer :: i

      x = [(sample_independent(seed, i, 18), i=1, size(x))]
      case = thesis_case()
      case%numerics = numerics_t()
      call set_point(case, between(100.0_wp, 1200.0_wp, x(1))*pi/30.0_wp, between(0.005_wp, 0.15_wp, x(2)))
      call add_dynamics(case, merge(1 + int(5.0_wp*x(3)), 0, x(4) < 0.6_wp), x(5) < 0.4_wp)
      case%dynamics%finger_stiffness = between(1.0e7_wp, 1.0e9_wp, x(6))
      case%dynamics%pad_stiffness = between(1.0e7_wp, 1.0e9_wp, x(7))
      case%dynamics%seat_stiffness = between(1.0e7_wp, 1.0e9_wp, x(8))
      case%dynamics%contact_damping = between(0.02_wp, 1.0_wp, x(9))
      case%dynamics%seat_damping = between(0.3_wp, 10.0_wp, x(10))
      case%spring%seat_stiffness = between(3.0e6_wp, 3.0e8_wp, x(11))
      case%spring%stiffness = case%spring%stiffness*between(0.7_wp, 2.0_wp, x(12))
      case%masses%valve = case%masses%valve*between(0.7_wp, 1.5_wp, x(13))
      case%lift%max_lift = case%lift%max_lift*between(0.6_wp, 1.1_wp, x(14))
      if (allocated(case%lash_adjuster)) then
         case%lash_adjuster%gap = between(2.0e-6_wp, 8.0e-6_wp, x(15))
         case%lash_adjuster%air_content = between(0.001_wp, 0.05_wp, x(16))
      end if
      ! Which quantity counts decides what is left out
      case%effects%quantity = quantity_names(modulo(seed, size(quantity_names)) + 1)
      case%effects%negligible = between(1.0e-3_wp, 1.0e-1_wp, x(16))
   end subroutine draw_train

   !> A number between two, evenly in its logarithm.
   elemental function between(low, high, place) result(number)
      !> Bounds [any], place between them [-]
      real(wp), intent(in) :: low, high, place
      !> The number [any]
      real(wp) :: number

      number = low*(high/low)**place
   end function between

   !> The reference train with a fixed pivot or an adjuster, slow and in hot oil, and what is decided about it.
   subroutine decide(case, choice, chosen, error)
      type(case_t), intent(in) :: case
      type(choice_t), intent(out) :: choice
      type(case_t), intent(out) :: chosen
      type(error_type), allocatable, intent(out) :: error
      type(model_t), allocatable :: models(:)
      type(error_t), allocatable :: failure

      call build_models(case, models, failure)
      if (.not. allocated(failure)) call choose_effects(case, models, chosen, choice, failure)
      if (allocated(failure)) call test_failed(error, failure%message)
   end subroutine decide

   subroutine test_train(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: case, chosen, rigid
      type(choice_t) :: choice
      type(result_t) :: needed, expected
      type(error_t), allocatable :: failure

      call reference_train(300.0_wp, .false., case)
      case%effects%negligible = 5.0e-2_wp
      call decide(case, choice, chosen, error)
      if (allocated(error)) return
      call check(error, .not. (allocated(chosen%dynamics) .or. allocated(chosen%spring_surge)), &
         "a train that does not matter stays")
      if (allocated(error)) return
      ! the parts that a rigid train cannot have are in the estimate of the whole
      call check(error, choice%bound <= (estimate_of(choice, effect_dynamics) + sum(choice%decisions%estimates(1), &
         mask=.not. choice%decisions%is_used .and. choice%decisions%effect /= effect_dynamics &
         .and. choice%decisions%effect /= effect_surge))*(1.0_wp + 1.0e-12_wp), "a part of the train counts twice")
      if (allocated(error)) return
      rigid = chosen
      rigid%effects%select = "listed"
      case%effects%select = "needed"
      call run_case(rigid, expected, failure)
      if (.not. allocated(failure)) call run_case(case, needed, failure)
      if (has_failed(failure, error)) return
      call check(error, find_quantity(needed%series, "lift_error"), 0, "a rigid train has a flexible one's series")
      if (allocated(error)) return
      call check(error, all(abs(needed%series_values - expected%series_values) <= 0.0_wp), "it is not the rigid train")
      if (allocated(error)) return
      case%effects%negligible = 2.0e-3_wp
      call decide(case, choice, chosen, error)
      if (allocated(error)) return
      call check(error, allocated(chosen%dynamics) .and. .not. allocated(chosen%spring_surge), &
         "the spring's modes matter, or the train does not")
      if (allocated(error)) return
      call reference_train(300.0_wp, .true., case)
      case%effects%negligible = 5.0e-2_wp
      call decide(case, choice, chosen, error)
      if (allocated(error)) return
      call check(error, allocated(chosen%lash_adjuster) .and. .not. allocated(chosen%spring_surge), &
         "an adjuster that takes three per cent of the torque is left out")
      if (allocated(error)) return
      ! What the rigid train says of the others is of no use where the train itself is another: a wide gap that leaks
      call reference_train(100.0_wp, .true., case)
      case%lash_adjuster%gap = 8.0e-6_wp
      call decide(case, choice, chosen, error)
      if (allocated(error)) return
      call check(error, index(choice%decisions(1)%reason, "not estimated") == 0 .and. all(choice%decisions%estimates(1) > 1.0_wp), &
         "an effect is estimated beside a train that changes the torque too much to be estimated")
   end subroutine test_train

   subroutine test_wild_train(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case, chosen
      type(choice_t) :: choice
      character(len=*), parameter :: words(*) = [character(len=9) :: "lash on", "pumps up", "part", "falls"]
      integer :: i

      do i = 1, size(words)
         select case (i)
         case (1)
            call reference_train(300.0_wp, .false., the_case)
            the_case%dynamics%lash = 1.0e-4_wp
         case (2)
            call reference_train(2100.0_wp, .true., the_case)
            the_case%spring%base_circle_load = 300.0_wp
         case (3)
            call reference_train(2900.0_wp, .false., the_case)
         case (4)
            call reference_train(300.0_wp, .false., the_case)
            call add_joints(the_case, 4)
         end select
         the_case%effects%negligible = 0.9_wp
         call decide(the_case, choice, chosen, error)
         if (allocated(error)) return
         call check(error, all(choice%decisions%is_used) .and. index(choice%decisions(1)%reason, trim(words(i))) > 0, &
            "estimates of a train although: "//trim(words(i))//" ("//trim(choice%decisions(1)%reason)//")")
         if (allocated(error)) return
      end do
   end subroutine test_wild_train

   !> The reference train in hot oil at a speed in rev/min.
   subroutine reference_train(speed, has_adjuster, case)
      real(wp), intent(in) :: speed
      logical, intent(in) :: has_adjuster
      type(case_t), intent(out) :: case

      case = thesis_case()
      case%numerics = numerics_t(accuracy=1.0e-3_wp)
      call set_point(case, speed*pi/30.0_wp, 0.01_wp)
      call add_dynamics(case, 5, has_adjuster)
   end subroutine reference_train

   !> Estimate of an effect for the mean torque.
   function estimate_of(choice, effect) result(estimate)
      type(choice_t), intent(in) :: choice
      integer, intent(in) :: effect
      real(wp) :: estimate

      estimate = choice%decisions(findloc(choice%decisions%effect, effect, 1))%estimates(1)
   end function estimate_of

end module test_needed_flexible
