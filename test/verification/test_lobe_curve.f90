!> The curve by which a camshaft takes a follower's torques and force: that of the states, wherever it says that it is known.
module test_lobe_curve
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp, degree, pi, two_pi
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_catalogue, only : list_series
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_lobe_curve, only : add_piece, cam_values, close_curve, curve_at, curve_values, halve_pieces, keep_state, &
      & lobe_curve_t, start_curve, telling_points
   use camroller_means, only : integrate_lobe, statistics_t
   use camroller_model, only : model_t
   use camroller_panels, only : panel_points
   use camroller_refined_curve, only : follow_steps
   use camroller_result, only : quantity_t
   use camroller_run, only : build_models
   use camroller_shaft, only : new_shaft, solved_t, valves_rest
   use camroller_state, only : state_t
   use camroller_torque_list, only : of_residual, torque_count
   use deck_cases, only : get_deck_case
   use closeness, only : has_failed
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
         new_unittest("the fitted curve covers nearly the whole turn and agrees with the states", test_known), &
         new_unittest("intervals with a kink of the states have no fitted curve", test_bends), &
         new_unittest("the curve of a flexible train with lost contacts agrees with its states", test_flexible), &
         new_unittest("smooth and short pieces of a curve are not halved", test_nothing_to_halve), &
         new_unittest("camshaft bearings change no torque of a curve, nor where the torques are known", test_absent), &
         new_unittest("points that tell how curves run miss no turn and no jump, and none is for rounding", test_telling), &
         new_unittest("the valves of a camshaft rest where none of its cams lifts one and no gas acts", test_rest) &
         ]
   end subroutine collect_lobe_curve

   !> Cams of the reference lift for 70 degrees to both sides of full lift; a second one lifts half a turn later.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      ! Cam angles from full lift [rad], and where the valves rest with one cam, with two of them
      real(wp), parameter :: places(6) = [-180.0_wp, -75.0_wp, -65.0_wp, 0.0_wp, 90.0_wp, 120.0_wp]*degree
      logical, parameter :: expected(6, 2) = reshape([.true., .true., .false., .false., .true., .true., &
         & .false., .true., .false., .false., .true., .false.], [6, 2])
      type(case_t), target :: the_case
      type(model_t), allocatable, target :: models(:)
      type(solved_t) :: solved
      type(error_t), allocatable :: failure
      integer :: cams, i

      call get_deck_case("decks/thesis.nml", the_case, failure)
      if (.not. allocated(failure)) call build_models(the_case, models, failure)
      if (has_failed(failure, error)) return
      solved%case => the_case
      solved%models => models
      do cams = 1, 2
         associate (bearings => the_case%cam_bearings)
            bearings%cam_positions = spread(0.03_wp, 1, cams)
            bearings%cam_phases = [(pi*(i - 1), i=1, cams)]
            bearings%cam_lobes = spread(1, 1, cams)
            bearings%follower_angles = spread(0.0_wp, 1, cams)
         end associate
         call new_shaft(solved%shaft, the_case, models(1)%oil%viscosity, models(1)%speed, failure)
         if (has_failed(failure, error)) return
         call check(error, all([(valves_rest(solved, places(i)), i=1, size(places))] .eqv. expected(:, cams)), "valves at rest")
         if (allocated(error)) return
      end do
      allocate (the_case%gas_force)
      call check(error, .not. valves_rest(solved, places(2)), "gas acts on valves at rest")
   end subroutine test_rest

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

   !> A piece for each step, so that no contact is lost or met within one.
   subroutine test_flexible(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: worst, known

      call compare("test/data/flexible_trains/bearing_pulses/deck.nml", 1, worst, known, error)
      if (allocated(error)) return
      call check(error, worst <= allowed, "beyond the tolerance")
      if (allocated(error)) return
      ! 0.995 of the turn was measured
      call check(error, known >= 0.99_wp, "hardly known")
   end subroutine test_flexible

   !> A curve of equal states is smooth: it has nothing to halve, and is known afterwards. Of a rough one short pieces stay whole.
   subroutine test_nothing_to_halve(error)
      type(error_type), allocatable, intent(out) :: error
      type(lobe_curve_t) :: curve, halved
      type(model_t) :: model
      type(state_t) :: state
      real(wp) :: values(curve_values)
      integer, allocatable :: halves(:)
      integer :: piece, point
      logical :: is_known(2)

      model%linkage%a = 1.0_wp
      model%linkage%sense = 1.0_wp
      state%position%normal_arm = 1.0_wp
      state%position%tangent_arm = 0.0_wp
      state%position%arm_angle = 0.0_wp
      state%contact%load = 1.0_wp
      state%contact%tangential_force = 0.0_wp
      state%torques = 1.0_wp
      call start_curve(curve, 0.0_wp, 8, .true.)
      do piece = 1, 8
         do point = 1, panel_points
            call keep_state(curve, model, state, point)
         end do
         call add_piece(curve, two_pi*piece/8)
      end do
      call close_curve(curve, 1.0e-5_wp)
      call halve_pieces(curve, 0.0_wp, halved, halves)
      call check(error, size(halves), 0)
      if (allocated(error)) return
      do piece = 1, 8
         call curve_at(curve, two_pi*(piece - 0.5_wp)/8, values, is_known)
         call check(error, all(is_known), "a smooth piece is no longer known")
         if (allocated(error)) return
         do point = 1, panel_points
            state%torques = (-1)**point
            call keep_state(curve, model, state, point, piece)
         end do
      end do
      call close_curve(curve, 1.0e-5_wp)
      call halve_pieces(curve, two_pi/7, halved, halves)
      call check(error, size(halves), 0, "short pieces")
      if (allocated(error)) return
      call halve_pieces(curve, two_pi/9, halved, halves)
      call check(error, size(halves), 16, "long pieces")
   end subroutine test_nothing_to_halve

   !> Bearings change neither torques and force of the curve nor where the torques are known.
   subroutine test_absent(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t), target :: the_case
      type(lobe_curve_t) :: with, without
      type(error_t), allocatable :: failure
      real(wp) :: values(curve_values), others(curve_values)
      logical :: is_known(2), are_known(2)
      integer :: i

      call get_deck_case("decks/thesis.nml", the_case, failure, number=1)
      if (.not. allocated(failure)) call get_curve(the_case, with, failure)
      deallocate (the_case%cam_bearings)
      if (.not. allocated(failure)) call get_curve(the_case, without, failure)
      if (has_failed(failure, error)) return
      do i = 1, angles
         call curve_at(with, two_pi*i/angles, values, is_known)
         call curve_at(without, two_pi*i/angles, others, are_known)
         call check(error, (is_known(1) .eqv. are_known(1)) .and. (are_known(2) .or. .not. are_known(1)), &
            "the torques are not known at the same angles")
         if (allocated(error)) return
         if (.not. is_known(1)) cycle
         call check(error, all(abs(values - others) <= 0.0_wp), "torques or force have changed")
         if (allocated(error)) return
      end do
   end subroutine test_absent

   !> Curve of the first lobe shape of a case.
   subroutine get_curve(the_case, curve, failure)
      type(case_t), intent(in), target :: the_case
      type(lobe_curve_t), intent(out) :: curve
      type(error_t), allocatable, intent(out) :: failure
      type(model_t), allocatable, target :: models(:)
      type(cycle_t), target :: cycle

      call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call integrate_cycle(cycle, models(1), the_case%numerics, failure)
      if (.not. allocated(failure)) call make_curve(the_case, models(1), cycle, curve, failure)
   end subroutine get_curve

   !> Curve of a cycle.
   subroutine make_curve(the_case, model, cycle, curve, failure)
      type(case_t), intent(in), target :: the_case
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in), target :: cycle
      type(lobe_curve_t), intent(out) :: curve
      type(error_t), allocatable, intent(out) :: failure
      type(statistics_t) :: statistics
      type(quantity_t), allocatable :: series(:)

      if (allocated(cycle%flexible)) then
         call follow_steps(model, cycle, curve, failure)
      else
         call list_series(the_case, series)
         call integrate_lobe(the_case, series, model, cycle, statistics, failure)
         if (.not. allocated(failure)) curve = statistics%curve
      end if
   end subroutine make_curve

   !> Largest difference between curve and states where the curve is known, over the tolerance of the cycle times the largest
   !> magnitude of the quantity; part of the turn where it is known.
   subroutine compare(path, number, worst, known, error)
      character(len=*), intent(in) :: path
      integer, intent(in) :: number
      real(wp), intent(out) :: worst, known
      type(error_type), allocatable, intent(out) :: error
      type(case_t), target :: the_case
      type(model_t), allocatable, target :: models(:)
      type(cycle_t), target :: cycle
      type(lobe_curve_t) :: lobe_curve
      type(error_t), allocatable :: failure
      type(state_t) :: state
      real(wp) :: exact(curve_values, angles), curve(curve_values, angles), difference
      logical :: is_known(2, angles)
      integer :: i, hint

      call get_deck_case(path, the_case, failure, number=number)
      if (.not. allocated(failure)) call build_models(the_case, models, failure)
      if (.not. allocated(failure)) call integrate_cycle(cycle, models(1), the_case%numerics, failure)
      if (.not. allocated(failure)) call make_curve(the_case, models(1), cycle, lobe_curve, failure)
      hint = 1
      do i = 1, angles
         if (.not. allocated(failure)) call state_at(cycle, models(1), two_pi*i/angles, hint, state, failure)
         if (allocated(failure)) exit
         exact(:, i) = cam_values(models(1), state)
         call curve_at(lobe_curve, two_pi*i/angles, curve(:, i), is_known(:, i))
      end do
      if (has_failed(failure, error)) return
      known = real(count(all(is_known, 1)), wp)/angles
      worst = 0.0_wp
      do i = 1, curve_values
         if (i == of_residual) cycle
         difference = maxval(abs(curve(i, :) - exact(i, :)), is_known(merge(1, 2, i <= torque_count), :))
         if (difference > 1.0e-12_wp*sum(maxval(abs(exact(:torque_count, :)), 2))) worst = max(worst, &
            & difference/(cycle%tolerance*maxval(abs(exact(i, :)))))
      end do
   end subroutine compare

   !> A wave, a step with a narrow peak before it, a slope with a small step in it, a constant, rounding
   subroutine test_telling(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 400, quantities = 5, step = 150, peak = 100, rise = 320
      ! Way from the lines between points, and what a turn is at least, over the extent [-]; angles [rad]; values, values on the
      ! lines, extents [any]
      real(wp), parameter :: bend = 0.02_wp, turn = 1.0e-4_wp
      real(wp) :: angle(n), values(quantities, n), on_line(3), extents(quantities)
      logical :: is_telling(n)
      integer, allocatable :: told(:)
      integer :: i, k

      angle = [(two_pi*i/n, i=1, n)]
      values(1, :) = cos(3.0_wp*angle)
      values(2, :) = [(merge(-7.0_wp, 5.0_wp, i < step), i=1, n)]
      values(2, peak) = -7.0_wp + 13.0_wp*turn
      values(3, :) = [(real(i, wp)/n + 0.1_wp*max(0.0_wp, min(1.0_wp, 0.2_wp*(i - rise))), i=1, n)]
      values(4, :) = 4.0_wp
      values(5, :) = [(1.0_wp + 1.0e-13_wp*modulo(i, 2), i=1, n)]
      is_telling = telling_points(angle, values)
      call check(error, is_telling(peak) .and. all(is_telling(step - 1:step)), "peak and jump")
      if (allocated(error)) return
      call check(error, is_telling(rise) .or. is_telling(rise + 1), "the step in a slope")
      if (allocated(error)) return
      extents = maxval(values, 2) - minval(values, 2)
      told = [1, pack([(i, i=1, n)], is_telling), n]
      do k = 1, size(told) - 1
         associate (first => told(k), last => told(k + 1))
            do i = first + 1, last - 1
               on_line = values(:3, first) + (values(:3, last) - values(:3, first))*(i - first)/(last - first)
               ! Bounds of slopes hold lines to twice the way, since a line ends in a point
               call check(error, all(abs(values(:3, i) - on_line) <= 2.0_wp*bend*extents(:3)), "the curve leaves the lines")
               if (allocated(error)) return
            end do
         end associate
      end do
      ! Eight lines for each half of a wave, peak, jump and step; rounding would tell at every point
      call check(error, count(is_telling) < 60, "points that tell nothing")
      if (allocated(error)) return
      call check(error, count(telling_points(angle, values(4:5, :))) == 0, "rounding tells")
   end subroutine test_telling

end module test_lobe_curve
