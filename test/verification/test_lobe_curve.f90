!> The curve by which a camshaft takes a follower's torques and force: that of the states, wherever it says that it is known.
module test_lobe_curve
   use testdrive, only : unittest_type, new_unittest, error_type, check, test_failed
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_catalogue, only : camshaft_count, follower_count
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_deck, only : deck_t, override_t, read_deck, make_sweep_case
   use camroller_lobe_curve, only : cam_values, curve_at, curve_values
   use camroller_means, only : integrate_lobe, statistics_t
   use camroller_model, only : model_t
   use camroller_run, only : build_models
   use camroller_state, only : state_t
   use camroller_torque_list, only : of_residual, torque_count
   implicit none
   private

   public :: collect_lobe_curve

   !> Tolerances of the cycle that may be missed: the tolerance is a hundredth of the accuracy [-]
   real(wp), parameter :: allowed = 5.0_wp
   !> Angles of the comparison
   integer, parameter :: angles = 3001

contains

   subroutine collect_lobe_curve(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a curve is known nearly everywhere, and is that of the states", test_known), &
         new_unittest("where states bend within a piece no curve is known", test_bends) &
         ]
   end subroutine collect_lobe_curve

   subroutine test_known(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: worst, known
      integer :: number

      do number = 1, 9, 4
         call compare("decks/thesis.nml", number, worst, known, error)
         if (allocated(error)) return
         call check(error, worst <= allowed, "decks/thesis.nml: beyond the tolerance")
         if (allocated(error)) return
         call check(error, known >= 0.7_wp, "decks/thesis.nml: hardly known")
         if (allocated(error)) return
      end do
   end subroutine test_known

   !> The bookkeeping of the source has kinks where a speed changes its sign, at no stop of the integration.
   subroutine test_bends(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: worst, known
      integer :: number

      do number = 1, 9, 2
         call compare("decks/thesis_source.nml", number, worst, known, error)
         if (allocated(error)) return
         call check(error, worst <= allowed, "decks/thesis_source.nml")
         if (allocated(error)) return
      end do
   end subroutine test_bends

   !> Largest difference between curve and states where the curve is known, over the tolerance of the cycle times the largest
   !> magnitude of the quantity; part of the turn where it is known.
   subroutine compare(path, number, worst, known, error)
      character(len=*), intent(in) :: path
      integer, intent(in) :: number
      real(wp), intent(out) :: worst, known
      type(error_type), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(case_t), target :: the_case
      type(model_t), allocatable, target :: models(:)
      type(cycle_t), target :: cycle
      type(statistics_t) :: statistics
      type(error_t), allocatable :: failure
      type(override_t) :: none(0)
      type(state_t) :: state
      real(wp) :: exact(curve_values, angles), curve(curve_values, angles), difference
      logical :: is_known(angles)
      integer :: i, hint

      call read_deck(deck, path, none, failure)
      if (.not. allocated(failure)) call make_sweep_case(deck, number, the_case, failure)
      if (.not. allocated(failure)) call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call integrate_cycle(cycle, models(1), the_case%numerics, failure)
      if (.not. allocated(failure)) call integrate_lobe(the_case, models(1), cycle, follower_count(the_case) &
         & + camshaft_count(the_case), statistics, failure)
      hint = 1
      do i = 1, angles
         if (.not. allocated(failure)) call state_at(cycle, models(1), two_pi*i/angles, hint, state, failure)
         if (allocated(failure)) exit
         exact(:, i) = cam_values(models(1), state)
         call curve_at(statistics%curve, two_pi*i/angles, curve(:, i), is_known(i))
      end do
      if (allocated(failure)) then
         call test_failed(error, failure%message)
         return
      end if
      known = real(count(is_known), wp)/angles
      worst = 0.0_wp
      do i = 1, curve_values
         if (i == of_residual) cycle
         difference = maxval(abs(curve(i, :) - exact(i, :)), is_known)
         if (difference > 1.0e-12_wp*sum(maxval(abs(exact(:torque_count, :)), 2))) worst = max(worst, &
            & difference/(cycle%tolerance*maxval(abs(exact(i, :)))))
      end do
   end subroutine compare

end module test_lobe_curve
