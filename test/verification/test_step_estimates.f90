!> Steps of a host's followers, from a degree to a thousandth of one: the error of the mean torque that drives beside its estimate.
!>
!> Rigid decks of the project go round twice at accuracies of 1e-3 and 1e-4, at steady speed and with a ripple of 3 %, beside the
!> same steps at an accuracy of 1e-7. In each degree steps have one of five lengths, in turn. The environment variable STEP_POINTS
!> chooses up to how many operating points of each deck have all drives; `make step-estimates` sets it, and prints a table. A usual
!> run takes one drive of every other deck over half a turn.
module test_step_estimates
   use, intrinsic :: iso_fortran_env, only : error_unit
   use testdrive, only : new_unittest, unittest_type, error_type, check, test_failed
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t, numerics_t
   use camroller_deck, only : deck_t, override_t, read_deck, make_sweep_case
   use camroller_deck_sweep, only : sweep_size
   use camroller_raw_file, only : find_files
   use camroller_simulation, only : simulation_t, outcome_t, inputs_t, start_simulation, advance
   use camroller_text_lines, only : line_t
   use run_settings, only : has_checks, number_from
   implicit none
   private

   public :: collect_step_estimates

   !> Lengths of steps [deg], and how many of one length are taken in a degree at most
   real(wp), parameter :: lengths(*) = [1.0_wp, 0.5_wp, 0.1_wp, 0.01_wp, 0.001_wp]
   integer, parameter :: most_steps = 20
   !> Accuracies of the steps and of those that they are compared with [-], ripple of the speed [-]
   real(wp), parameter :: accuracies(*) = [1.0e-3_wp, 1.0e-4_wp], exact = 1.0e-7_wp, ripples(*) = [0.0_wp, 0.03_wp]
   !> Degrees after the start in which the exact follower finds its path, of all and of a usual run
   integer, parameter :: first = 10, all_degrees = 720, usual_degrees = 190
   !> Part of the steps whose error may be above the estimate: 7e-5 of 3.5 million were; how many times the estimate, 3.7 were met;
   !> errors below that part of the largest torque may be anything, as those of contacts solved to less than rounding [-]
   real(wp), parameter :: most_above = 2.0e-4_wp, most_times = 5.0_wp, of_torque = 1.0e-9_wp

   !> Steps of one length
   type :: tally_t
      !> Steps, those whose error is above the estimate
      integer :: steps = 0, above = 0
      !> Largest error over its estimate of these, but for the smallest errors [-]
      real(wp) :: worst = 0.0_wp
      !> Sum of the logarithms of the estimate over the step's mean torque of friction [-], and of how many steps: not of those with
      !> hardly any friction
      real(wp) :: logarithms = 0.0_wp
      integer :: rubbing = 0
   end type tally_t

contains

   !> Collect the tests.
   subroutine collect_step_estimates(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("errors of steps of any length are within their estimates, but for few", test_estimates)]
   end subroutine collect_step_estimates

   subroutine test_estimates(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: folders(2) = [character(len=11) :: "decks/", "decks/hard/"], ending = ".nml"
      type(tally_t) :: tallies(size(lengths))
      type(line_t), allocatable :: paths(:)
      character(len=:), allocatable :: trouble
      integer :: points, every, i, k

      every = merge(10, 2, has_checks())
      points = number_from("STEP_POINTS", 0)
      trouble = ""
      do k = 1, size(folders)
         call find_files(trim(folders(k)), paths)
         do i = 1, size(paths)
            associate (path => paths(i)%text)
               if (path(max(1, len(path) - len(ending) + 1):) /= ending) cycle
               if (points == 0 .and. modulo(i, every) /= 0) cycle
               call drive_deck(path, points, i, tallies, trouble)
            end associate
         end do
      end do
      if (points > 0) write (error_unit, "(a)") "   step [deg]     steps  above  largest error/estimate  usual estimate/friction"
      do i = 1, merge(size(lengths), 0, points > 0)
         associate (tally => tallies(i))
            write (error_unit, "(f13.3, i10, i7, f24.2, es25.1)") lengths(i), tally%steps, tally%above, tally%worst, &
               & 10.0_wp**(tally%logarithms/max(1, tally%rubbing))
         end associate
      end do
      if (trouble /= "") call test_failed(error, trouble)
      if (allocated(error)) return
      call check(error, minval(tallies%steps) > 1000/every, "hardly any steps were taken")
      if (allocated(error)) return
      call check(error, sum(tallies%above) <= most_above*sum(tallies%steps), "too many errors are above their estimates")
   end subroutine test_estimates

   !> Steps of one deck, if its train is rigid.
   subroutine drive_deck(path, points, number, tallies, trouble)
      !> Path of the deck
      character(len=*), intent(in) :: path
      !> Operating points at most; 0 for one drive, which the number of the deck chooses
      integer, intent(in) :: points, number
      type(tally_t), intent(inout) :: tallies(:)
      !> What went wrong
      character(len=:), allocatable, intent(inout) :: trouble
      type(deck_t) :: deck
      type(case_t) :: case
      type(override_t) :: none(0)
      type(error_t), allocatable :: error
      integer :: cases, used, i, accuracy, ripple

      call read_deck(deck, path, none, error)
      ! Some hard decks are none
      if (allocated(error)) return
      cases = sweep_size(deck%sweep)
      used = min(cases, max(1, points))
      do i = 1, used
         call make_sweep_case(deck, 1 + (i - 1)*(cases - 1)/max(1, used - 1), case, error)
         if (allocated(error)) cycle
         if (allocated(case%dynamics) .or. allocated(case%ehl)) return
         if (points == 0) then
            call compare_steps(path, case, accuracies(1 + modulo(number, 2)), ripples(1 + modulo(number/2, 2)), number, &
               & usual_degrees, tallies, trouble)
            return
         end if
         do accuracy = 1, size(accuracies)
            do ripple = 1, size(ripples)
               call compare_steps(path, case, accuracies(accuracy), ripples(ripple), 3*i + ripple + accuracy, all_degrees, &
                  & tallies, trouble)
            end do
         end do
      end do
   end subroutine drive_deck

   !> Drive a case with its accuracy and with one far below.
   subroutine compare_steps(path, given, accuracy, ripple, offset, degrees, tallies, trouble)
      character(len=*), intent(in) :: path
      type(case_t), intent(in) :: given
      !> Accuracy of the steps [-], ripple of the speed [-]
      real(wp), intent(in) :: accuracy, ripple
      !> Number that chooses which degrees have which steps; degrees at all
      integer, intent(in) :: offset, degrees
      type(tally_t), intent(inout) :: tallies(:)
      character(len=:), allocatable, intent(inout) :: trouble
      type(case_t) :: case
      type(simulation_t) :: rough, fine
      type(outcome_t) :: outcome, exact_outcome
      type(error_t), allocatable :: error
      ! Cam angles at start and end of a step [rad]; largest torque that drives [N m]
      real(wp) :: start, finish, largest
      character(len=120) :: words
      integer :: cell, which, steps, i

      case = given
      case%numerics = numerics_t(accuracy=accuracy)
      call start_simulation(rough, case, 0.0_wp, error)
      if (.not. allocated(error)) call start_simulation(fine, case, 0.0_wp, error)
      largest = 0.0_wp
      do i = 10, 360, 10
         if (.not. allocated(error)) call advance(fine, i*degree, inputs_at(0.0_wp), inputs_at(0.0_wp), exact_outcome, error)
         largest = max(largest, abs(exact_outcome%mean_torque_drive))
      end do
      case%numerics%accuracy = exact
      if (.not. allocated(error)) call start_simulation(fine, case, 0.0_wp, error)
      ! Some hard decks cannot be driven, which other tests look at
      if (allocated(error)) return
      start = 0.0_wp
      do cell = 1, degrees
         which = 1 + modulo(7*cell + offset, size(lengths))
         steps = min(most_steps, nint(1.0_wp/lengths(which)))
         do i = 1, merge(steps, steps + 1, steps*lengths(which) >= 1.0_wp)
            finish = (cell - 1 + min(1.0_wp, i*lengths(which)))*degree
            if (i > steps) finish = cell*degree
            call advance(rough, finish, inputs_at(start), inputs_at(finish), outcome, error)
            if (.not. allocated(error)) call advance(fine, finish, inputs_at(start), inputs_at(finish), exact_outcome, error)
            if (allocated(error)) return
            start = finish
            if (i > steps .or. cell <= first) cycle
            call judge(tallies(which), abs(outcome%mean_torque_drive - exact_outcome%mean_torque_drive), outcome%estimated_error)
         end do
      end do

   contains

      !> Inputs of the host.
      function inputs_at(angle) result(inputs)
         !> Cam angle [rad]
         real(wp), intent(in) :: angle
         type(inputs_t) :: inputs

         inputs%speed = given%operating_point%speed*(1.0_wp + ripple*sin(3.0_wp*angle))
         inputs%oil_temperature = given%operating_point%oil_temperature
      end function inputs_at

      !> Count a step.
      subroutine judge(tally, difference, estimate)
         type(tally_t), intent(inout) :: tally
         !> Its error, the estimate [N m]
         real(wp), intent(in) :: difference, estimate

         tally%steps = tally%steps + 1
         if (exact_outcome%mean_torque_friction > of_torque*largest) then
            tally%logarithms = tally%logarithms + log10(estimate/exact_outcome%mean_torque_friction)
            tally%rubbing = tally%rubbing + 1
         end if
         if (difference <= estimate) return
         tally%above = tally%above + 1
         if (difference <= estimate + of_torque*largest) return
         tally%worst = max(tally%worst, difference/estimate)
         if (difference <= most_times*estimate) return
         write (words, "(a, f8.3, a, f6.3, a, 2es11.2)") ": step to ", finish/degree, " deg, length ", lengths(which), &
            & " deg, error, estimate [N m]", difference, estimate
         trouble = trouble//new_line("a")//path//trim(words)
      end subroutine judge

   end subroutine compare_steps

end module test_step_estimates
