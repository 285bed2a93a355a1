!> Rigid followers drawn at random over everything that a deck may hold, driven by a host in steps of a degree at constant inputs
!> until their turns repeat: the mean torques are those of a run of the case.
!>
!> The environment variables HOST_CASES and HOST_SEED choose how many and which; `make random-hosts` sets them. WIDE_FOLDER names a
!> folder for decks of cases that fail.
module test_random_hosts
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, test_failed
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t, numerics_t, selection_t
   use camroller_deck, only : deck_t, override_t, parse_deck, make_case
   use camroller_deck_keys, only : new_schema
   use camroller_deck_schema, only : schema_t
   use camroller_result, only : result_t
   use camroller_run, only : run_case
   use camroller_simulation, only : simulation_t, outcome_t, start_simulation, advance
   use camroller_torque_list, only : torque_count, is_loss, torque_series
   use result_checks, only : scalar_of
   use run_settings, only : has_checks, number_from
   use wide_decks, only : wide_deck_t, draw_wide_deck, save_wide_deck
   use wide_draft, only : style_t
   implicit none
   private

   public :: collect_random_hosts

   !> Cases of a test run with and without run-time checks, and the seed of the first: none of them takes more than two seconds
   integer, parameter :: usual_cases = 12, few_cases = 4, usual_seed = 972000008
   !> Accuracy asked for of run and steps [-]
   real(wp), parameter :: accuracy = 1.0e-4_wp
   !> Steps of a turn; turns after which a case that does not repeat yet is left out, as most of a roller's spin may be kept
   integer, parameter :: steps = 360, most_turns = 30
   !> Change of the drive torque from turn to turn that counts as none, over the accuracy [-]
   real(wp), parameter :: repeated = 0.02_wp
   !> Failures that are shown
   integer, parameter :: most_shown = 20

   !> What steps come to
   type :: turn_t
      !> Mean torques of a turn [N m]; mean torque that drives, mean of its estimated error [N m]
      real(wp) :: torques(torque_count) = 0.0_wp, drive = 0.0_wp, estimated_error = 0.0_wp
   end type turn_t

contains

   !> Collect the tests.
   subroutine collect_random_hosts(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("random followers stepped by a host have the mean torques of their runs", test_hosts)]
   end subroutine collect_random_hosts

   subroutine test_hosts(error)
      type(error_type), allocatable, intent(out) :: error
      type(schema_t) :: schema
      type(style_t) :: style
      type(wide_deck_t) :: deck
      character(len=:), allocatable :: trouble, list
      character(len=20) :: buffer
      ! Cases compared, of how many drawn; failures
      integer :: compared, cases, failures, seed, i
      logical :: is_compared

      call new_schema(schema)
      cases = number_from("HOST_CASES", merge(few_cases, usual_cases, has_checks()))
      list = ""
      compared = 0
      failures = 0
      do i = 1, cases
         seed = number_from("HOST_SEED", usual_seed) + i - 1
         call draw_wide_deck(seed, schema, style, deck)
         call compare_with_run(deck, is_compared, trouble)
         if (is_compared) compared = compared + 1
         if (trouble == "") cycle
         write (buffer, "(i0)") seed
         call save_wide_deck(deck, trim(buffer), trouble)
         failures = failures + 1
         list = list//new_line("a")//"HOST_SEED="//trim(buffer)//": "//trouble
         if (failures >= most_shown) exit
      end do
      write (error_unit, "(3x, i0, a, i0, a)") compared, " of ", cases, " random followers compared with their runs"
      if (2*compared < cases .and. failures < most_shown) list = list//new_line("a")//"too few followers were compared"
      if (list /= "") call test_failed(error, list)
   end subroutine test_hosts

   !> One deck as a single rigid follower, without what belongs to a camshaft or to hours of running.
   subroutine compare_with_run(deck, is_compared, trouble)
      type(wide_deck_t), intent(in) :: deck
      !> Has it a result, and do its turns repeat?
      logical, intent(out) :: is_compared
      character(len=:), allocatable, intent(out) :: trouble
      type(deck_t) :: parsed
      type(override_t) :: none(0)
      type(case_t) :: case
      type(result_t) :: result
      type(turn_t) :: turn
      type(error_t), allocatable :: error
      ! Mean friction torque of the run, what a torque of the turn may differ by, and what it differs by [N m]
      real(wp) :: friction, allowed, difference
      character(len=100) :: buffer
      integer :: i

      trouble = ""
      is_compared = .false.
      call parse_deck(parsed, deck%text, "random deck", "", none, error, deck%tables)
      if (.not. allocated(error)) call make_case(parsed, none, case, error)
      if (allocated(error)) return
      if (allocated(case%ehl) .or. allocated(case%dynamics)) return
      call leave_out(case)
      call run_case(case, result, error)
      if (allocated(error)) return
      call drive_until_repeated(case, scalar_of(result, "mean_torque_friction"), turn, is_compared, error)
      if (allocated(error)) then
         trouble = "a step fails, and the run does not: "//error%message
         return
      end if
      if (.not. is_compared) return
      friction = scalar_of(result, "mean_torque_friction")
      ! The accuracy of each, and what the steps say of themselves beyond that
      allowed = 2.0_wp*accuracy*friction + turn%estimated_error
      difference = abs(turn%drive - scalar_of(result, "mean_torque_drive"))
      write (buffer, "(a, 2es10.2)") "drive torque differs by, over friction, allowed", [difference, allowed]/friction
      if (.not. difference <= allowed) trouble = trim(buffer)
      do i = 1, torque_count
         if (.not. is_loss(i)) cycle
         ! A loss that the case does not have is zero in both
         difference = abs(turn%torques(i) - scalar_of(result, "mean_"//trim(torque_series(i))))
         write (buffer, "(2a, 2es10.2)") trim(torque_series(i)), " differs by, over friction, allowed", &
            & [difference, allowed]/friction
         if (.not. difference <= allowed) trouble = trouble//" "//trim(buffer)
      end do
   end subroutine compare_with_run

   !> Leave out what a single follower does not have, and ask for an accuracy.
   subroutine leave_out(case)
      type(case_t), intent(inout) :: case

      if (allocated(case%second_lift)) deallocate (case%second_lift)
      if (allocated(case%cam_bearings)) deallocate (case%cam_bearings)
      if (allocated(case%bearing_asperity)) deallocate (case%bearing_asperity)
      if (allocated(case%belt_pull)) deallocate (case%belt_pull)
      if (allocated(case%bearing_heat)) deallocate (case%bearing_heat)
      if (allocated(case%shaft_drag)) deallocate (case%shaft_drag)
      if (allocated(case%engine)) deallocate (case%engine)
      if (allocated(case%tribofilm)) deallocate (case%tribofilm)
      if (allocated(case%wear)) deallocate (case%wear)
      if (allocated(case%running_in)) deallocate (case%running_in)
      if (allocated(case%spring_surge)) deallocate (case%spring_surge)
      if (allocated(case%lash_adjuster)) deallocate (case%lash_adjuster)
      case%effects = selection_t()
      case%numerics = numerics_t(accuracy=accuracy)
   end subroutine leave_out

   !> Turns at constant inputs until one is as the one before.
   subroutine drive_until_repeated(case, friction, turn, has_repeated, error)
      type(case_t), intent(in) :: case
      !> Mean friction torque [N m]
      real(wp), intent(in) :: friction
      !> The last turn
      type(turn_t), intent(out) :: turn
      !> Is it?
      logical, intent(out) :: has_repeated
      type(error_t), allocatable, intent(out) :: error
      type(simulation_t) :: simulation
      type(outcome_t) :: outcome
      type(turn_t) :: now
      integer :: i, k

      has_repeated = .false.
      call start_simulation(simulation, case, 0.0_wp, error)
      do i = 1, most_turns
         now = turn_t()
         do k = 1, steps
            if (.not. allocated(error)) call advance(simulation, two_pi*((i - 1)*steps + k)/steps, case%operating_point%speed, &
               & case%operating_point%oil_temperature, outcome, error)
            if (allocated(error)) return
            now%torques = now%torques + outcome%mean_torques/steps
            now%drive = now%drive + outcome%mean_torque_drive/steps
            now%estimated_error = now%estimated_error + outcome%estimated_error/steps
         end do
         has_repeated = i > 1 .and. abs(now%drive - turn%drive) <= repeated*accuracy*friction
         turn = now
         if (has_repeated) return
      end do
   end subroutine drive_until_repeated

end module test_random_hosts
