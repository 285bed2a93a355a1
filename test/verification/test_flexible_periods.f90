!> How a flexible train finds its periodic state: in few cycles, from far away, and not where it is unstable.
module test_flexible_periods
   use testdrive, only : new_unittest, unittest_type, error_type, check, test_failed
   use camroller_kinds, only : wp, pi
   use camroller_case, only : case_t, numerics_t
   use camroller_error, only : error_t, kind_convergence, kind_domain
   use camroller_model, only : model_t
   use camroller_flexible_cycle, only : extrapolate, find_periodic, flexible_cycle_t, history_t, &
      & is_alternating, rest_of_train
   use camroller_flexible_solution, only : flexible_solution_t, solve_flexible, tolerance_ratio
   use camroller_flexible_trend, only : find_trend, trend_t
   use camroller_flexible_turn, only : start_turns, turn_t
   use camroller_flexible_train, only : at_finger, at_lift, at_plunger, at_sliding
   use camroller_number_text, only : integer_text, number_text
   use camroller_remarks, only : missed_accuracy, missed_means, remark_lines
   use camroller_result, only : find_quantity, result_t
   use camroller_run, only : run_case
   use camroller_turn_scatter, only : scatter_error
   use closeness, only : check_scaled, expect_error, expect_success, has_failed
   use deck_cases, only : get_deck_case
   use flexible_cases, only : add_dynamics
   use reference_cases, only : make_model, set_point, thesis_case
   use result_checks, only : scalar_of
   use run_settings, only : has_checks
   implicit none
   private

   public :: collect_flexible_periods

   !> Distance of end and start that counts as closed, in units of the scales, and tolerance of a step [-]
   real(wp), parameter :: closure = 1.0e-3_wp, tolerance = 1.0e-4_wp
   !> Cycles to that closure at most, on a fixed pivot and with adjuster. The kink of an adjuster's check valve makes the number a
   !> matter of rounding: speeds that differ by 1e-7 of their value take 8 to 10 at 1200 rev/min and 6 to 8 at 1500
   integer, parameter :: most_cycles(2) = [8, 10]

contains

   !> Collect the tests.
   subroutine collect_flexible_periods(testsuite)
      !> The tests
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("up to 1500 rev/min a fixed pivot has its periodic state in 8 cycles, an adjuster in 10", test_few), &
         new_unittest("an adjuster that stands 30 um too high leaks down to the state that it has from rest, in few cycles", &
            & test_drift), &
         new_unittest("a cycle whose disturbances come back with the other sign, and larger, is not found", test_unstable), &
         new_unittest("a state that loses a hundredth a turn is extrapolated from three turns", test_extrapolation), &
         new_unittest("turns alternate where a disturbance comes back with the other sign, not where little is left", &
            & test_alternating), &
         new_unittest("a train that takes more steps than it may is given up with words for its fastest part", test_work), &
         new_unittest("a train whose roller is held where nothing is entrained is given up with words for that", test_held), &
         new_unittest("the search for a period ends after as many steps as it may take, without an error", test_search), &
         new_unittest("coarse turns first lead to the same periodic state in fewer steps", test_coarse), &
         new_unittest("a train without a period takes 20 coarse turns and the 40 with its tolerance", test_aperiodic), &
         new_unittest("a train that rattles without a period is not integrated again with a smaller tolerance", test_scatter), &
         new_unittest("means of turns without a period err by what the turns scatter at least", test_scatter_of_means), &
         new_unittest("what turns swing by within a part of them is no error of their mean", test_scatter_error), &
         new_unittest("turns that drift or approach a period are told from those that scatter", test_trend) &
         ]
   end subroutine collect_flexible_periods

   !> The reference train and its periodic state.
   subroutine find(speed, viscosity, raised, has_adjuster, most, cycle, state, error, part)
      !> Speed [rev/min], viscosity of the oil [Pa s], how much the plunger stands above its rest [m]
      real(wp), intent(in) :: speed, viscosity, raised
      logical, intent(in) :: has_adjuster
      !> Cycles at most
      integer, intent(in) :: most
      type(flexible_cycle_t), intent(out) :: cycle
      !> End of the last cycle, in units of the scales [-]
      real(wp), allocatable, intent(out) :: state(:)
      type(error_type), allocatable, intent(out) :: error
      !> Closure and tolerance over the usual ones [-]
      real(wp), intent(in), optional :: part
      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      type(error_t), allocatable :: failure
      ! That part, or 1 [-]
      real(wp) :: factor

      factor = 1.0_wp
      if (present(part)) factor = part
      the_case = thesis_case()
      call set_point(the_case, speed*pi/30.0_wp, viscosity)
      call add_dynamics(the_case, 5, has_adjuster)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", factor*tolerance, failure)
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (.not. allocated(failure)) then
         if (raised > 0.0_wp) then
            ! The finger turns about the roller
            state(at_plunger) = state(at_plunger) + raised
            state(at_finger) = state(at_finger) + raised/model%linkage%a
            state(at_lift) = raised*(model%linkage%b/model%linkage%a - 1.0_wp)
         end if
         call find_periodic(cycle, turn, state, factor*closure, most, failure)
      end if
      if (allocated(failure)) call test_failed(error, failure%message)
      state = state/turn%scales
   end subroutine find

   subroutine test_few(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: speeds(*) = [300.0_wp, 600.0_wp, 900.0_wp, 1200.0_wp, 1500.0_wp]
      type(flexible_cycle_t) :: cycle
      real(wp), allocatable :: state(:)
      integer :: i, k

      do i = merge(size(speeds), 1, has_checks()), size(speeds)
         do k = 1, 2
            call find(speeds(i), 0.01_wp, 0.0_wp, k == 2, most_cycles(k), cycle, state, error)
            if (allocated(error)) return
            call check(error, cycle%period, 1, number_text(speeds(i), 4)//" rev/min"//merge(" with adjuster", "              ", &
               & k == 2)//": not periodic after "//integer_text(most_cycles(k))//" cycles")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_few

   !> It leaks down by the same step turn after turn until its check valve opens.
   subroutine test_drift(error)
      type(error_type), allocatable, intent(out) :: error
      ! Height [m], speeds [rev/min], viscosities at 60, 60 and 25 degC [Pa s]
      real(wp), parameter :: height = 30.0e-6_wp, speeds(*) = [300.0_wp, 900.0_wp, 900.0_wp], &
         & viscosities(*) = [0.0305_wp, 0.0305_wp, 0.15_wp]
      ! Cycles: a third more than it takes. In the last one rounding, which differs from processor to processor, decides when it
      ! jumps: of 28 speeds within 1.5e-6 of it, on two processors, 11 take 39 to 41, the others 71 to 115, with a mean of 87 and a
      ! standard deviation of 13; without a jump it takes more than 200
      integer, parameter :: most(*) = [10, 35, 160]
      type(flexible_cycle_t) :: cycle
      ! Periodic states, from rest and from above [-]
      real(wp), allocatable :: usual(:), state(:)
      integer :: i

      do i = 1, merge(1, size(speeds), has_checks())
         call find(speeds(i), viscosities(i), 0.0_wp, .true., most_cycles(2), cycle, usual, error)
         if (allocated(error)) return
         call find(speeds(i), viscosities(i), height, .true., most(i), cycle, state, error)
         if (allocated(error)) return
         call check(error, cycle%period, 1, number_text(speeds(i), 4)//" rev/min: not periodic after "//integer_text(most(i))// &
            & " cycles")
         if (allocated(error)) return
         ! Both are as near to the periodic state as was asked for
         call check_scaled(error, state(at_plunger), usual(at_plunger), 1.0_wp, 2.0_wp*closure, "place of the plunger")
         if (allocated(error)) return
      end do
   end subroutine test_drift

   !> At 2000 rev/min the plunger's disturbances come back as -1.01 of what they were, and no number of turns repeats itself.
   !> Extrapolation comes near the single cycle at one speed or another, as rounding decides; the last change from turn to turn,
   !> from which it has taken what alternates, showed it at two of these four.
   subroutine test_unstable(error)
      type(error_type), allocatable, intent(out) :: error
      type(flexible_cycle_t) :: cycle
      real(wp), allocatable :: state(:)
      integer :: i

      do i = 0, merge(0, 3, has_checks())
         call find(2000.0_wp*(1.0_wp + 1.0e-7_wp*i), 0.01_wp, 0.0_wp, .true., 20, cycle, state, error, 0.1_wp)
         if (allocated(error)) return
         call check(error, cycle%period /= 1, "a single cycle is found where it is unstable")
         if (allocated(error)) return
      end do
   end subroutine test_unstable

   !> The roller slows down under load at 170 deg, and steps of 1e-9 rad follow the crest of its traction.
   subroutine test_held(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      type(flexible_cycle_t) :: cycle
      type(error_t), allocatable :: failure
      ! State [state]
      real(wp), allocatable :: state(:)

      call get_deck_case("test/data/flexible_trains/held_roller/deck.nml", the_case, failure)
      call expect_success(error, failure)
      if (.not. allocated(error)) call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "radau5", 4.0e-6_wp, failure)
      ! A turn takes 700 at ten times the tolerance and 2500 at a tenth of it
      turn%options%max_steps = 5000
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (.not. allocated(failure)) call find_periodic(cycle, turn, state, closure, 5, failure)
      call expect_error(error, failure, kind_convergence, "surfaces of cam and roller move in opposite directions at one speed")
   end subroutine test_held

   !> Look for the period of a train at 300 rev/min, whose turns take two thousand steps.
   subroutine find_within(cycle, failure, error, most_work, most_search)
      type(flexible_cycle_t), intent(out) :: cycle
      type(error_t), allocatable, intent(out) :: failure
      type(error_type), allocatable, intent(out) :: error
      ! Most steps of all turns, and of those that look for a period
      integer, intent(in), optional :: most_work, most_search
      type(case_t) :: the_case
      type(model_t), target :: model
      type(turn_t) :: turn
      ! State [state]
      real(wp), allocatable :: state(:)

      the_case = thesis_case()
      call set_point(the_case, 10.0_wp*pi, 0.01_wp)
      call add_dynamics(the_case, 5, .true.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", tolerance, failure)
      if (present(most_work)) turn%most_work = most_work
      if (present(most_search)) turn%most_search = most_search
      if (.not. allocated(failure)) call rest_of_train(model, state, failure)
      if (.not. allocated(failure)) call find_periodic(cycle, turn, state, closure, 5, failure)
   end subroutine find_within

   subroutine test_work(error)
      type(error_type), allocatable, intent(out) :: error
      type(flexible_cycle_t) :: cycle
      type(error_t), allocatable :: failure

      call find_within(cycle, failure, error, most_work=300)
      if (allocated(error)) return
      call check(error, allocated(failure), "the work has no end")
      if (allocated(error)) return
      ! The ball of the check valve: oil of 8.6e7 Pa in 0.3 cm^3, and 0.1 mm^3/s more a pascal
      call check(error, failure%kind == kind_domain .and. index(failure%message, "its turns take more than 300 steps; the "// &
         & "fastest part of the train, with ") == 1 .and. index(failure%message, "is that of lash_adjuster.check_area_mm2") > 0, &
         & failure%message)
   end subroutine test_work

   subroutine test_search(error)
      type(error_type), allocatable, intent(out) :: error
      type(flexible_cycle_t) :: cycle
      type(error_t), allocatable :: failure

      call find_within(cycle, failure, error, most_search=300)
      if (allocated(error)) return
      if (has_failed(failure, error)) return
      call check(error, cycle%cycles == 1 .and. cycle%period == 0, "cycles that were tried: "//integer_text(cycle%cycles))
   end subroutine test_search

   !> At 2500 rev/min a turn leaves a tenth of a disturbance or less: both ends are within a ninth of the closure from the periodic
   !> state.
   subroutine test_coarse(error)
      type(error_type), allocatable, intent(out) :: error
      ! Speed [rev/min], tolerance over that of the other tests [-]
      real(wp), parameter :: speed = 2500.0_wp, part = 0.04_wp
      type(case_t) :: the_case
      type(model_t), target :: model
      type(flexible_solution_t) :: solution
      type(flexible_cycle_t) :: cycle
      type(turn_t) :: turn
      type(error_t), allocatable :: failure
      ! End of the cycle without coarse turns, in units of the scales [-]; the scales [state]
      real(wp), allocatable :: state(:)

      call find(speed, 0.01_wp, 0.0_wp, .false., 40, cycle, state, error, part)
      if (allocated(error)) return
      the_case = thesis_case()
      call set_point(the_case, speed*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, 5, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call start_turns(turn, model, "rodas5p", part*tolerance, failure)
      if (.not. allocated(failure)) call solve_flexible(solution, model, numerics_t(method="rodas5p", &
         & tolerance=part*tolerance/tolerance_ratio), failure)
      if (has_failed(failure, error)) return
      call check(error, all([cycle%period, solution%cycle%period] == 1), "no period")
      if (allocated(error)) return
      ! It is two thirds; a coarse turn takes 0.4 of the steps
      call check(error, real(solution%cycle%counters%accepted, wp)/cycle%counters%accepted < 0.8_wp, "steps: "// &
         & integer_text(solution%cycle%counters%accepted)//", without coarse turns "//integer_text(cycle%counters%accepted))
      if (allocated(error)) return
      associate (path => solution%cycle%trajectory)
         state = path%state(:, path%count)/turn%scales - state
         ! Its scale is one of the search
         state(at_sliding) = 0.0_wp
         call check(error, maxval(abs(state)) <= part*closure, "ends differ")
      end associate
   end subroutine test_coarse

   !> Overspeed: the train has lost its cam.
   subroutine test_aperiodic(error)
      type(error_type), allocatable, intent(out) :: error
      type(case_t) :: the_case
      type(model_t), target :: model
      type(flexible_solution_t) :: solution
      type(error_t), allocatable :: failure

      the_case = thesis_case()
      call set_point(the_case, 3300.0_wp*pi/30.0_wp, 0.01_wp)
      call add_dynamics(the_case, 2, .false.)
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call solve_flexible(solution, model, numerics_t(method="rodas5p", tolerance=1.2e-5_wp), failure)
      if (has_failed(failure, error)) return
      call check(error, solution%cycle%period == 0 .and. .not. solution%is_cut_short .and. size(solution%turns) == 40, &
         & "period "//integer_text(solution%cycle%period))
      if (allocated(error)) return
      call check(error, solution%cycle%cycles, 60)
   end subroutine test_aperiodic

   !> With lash. Rounding may decide whether a period is found at a speed, and how large the error is: the first speed shows what is
   !> looked for, on another processor perhaps one of the others.
   subroutine test_scatter(error)
      type(error_type), allocatable, intent(out) :: error
      ! Accuracy [-], lash [m], speeds [rev/min]
      real(wp), parameter :: accuracy = 0.05_wp, lash = 1.0e-4_wp, speeds(*) = [3000.0_wp, 2995.0_wp, 3005.0_wp, 2950.0_wp]
      type(result_t) :: result
      type(error_t), allocatable :: failure
      integer :: i

      do i = 1, size(speeds)
         call run_rattling(lash, speeds(i), accuracy, result, failure)
         if (has_failed(failure, error)) return
         if (scalar_of(result, "period_cycles") > 0.5_wp .or. scalar_of(result, "estimated_error") <= accuracy) cycle
         call check(error, any(result%remarks%kind == missed_accuracy) .and. &
            & index(remark_lines(result%remarks), "is known by its statistics alone") > 0, remark_lines(result%remarks))
         return
      end do
      call test_failed(error, "all errors are below the accuracy")
   end subroutine test_scatter

   !> The torque of all losses turn by turn, whose mean is that of a series. The difference of two turns from the same start tells
   !> less the smaller the tolerance: at 1e-3 means by two methods were up to 100 times as far apart. Speeds as above.
   subroutine test_scatter_of_means(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: accuracy = 0.01_wp, lash = 1.0e-4_wp, speeds(*) = [2950.0_wp, 3000.0_wp, 2995.0_wp, 3005.0_wp]
      type(result_t) :: result
      type(error_t), allocatable :: failure
      ! Means over fifths of the turns, what 95 of 100 means keep to by Student's distribution with 4 degrees of freedom [N m]
      real(wp) :: fifths(5), scatter
      integer :: i

      do i = 1, size(speeds)
         call run_rattling(lash, speeds(i), accuracy, result, failure)
         if (has_failed(failure, error)) return
         if (scalar_of(result, "period_cycles") < 0.5_wp .and. nint(scalar_of(result, "summary_cycles")) == 40) exit
      end do
      call check(error, i <= size(speeds), "all speeds have a period")
      if (allocated(error)) return
      associate (torques => result%history_values(:, find_quantity(result%history, "dynamic_loss_torque")))
         fifths = sum(reshape(torques, [8, 5]), 1)/8
      end associate
      associate (mean => scalar_of(result, "mean_torque_friction"))
         scatter = 2.776_wp*sqrt(sum((fifths - mean)**2)/(5*4))
         call check(error, scatter <= 1.001_wp*scalar_of(result, "estimated_error_of_means")*mean, "scatter beyond the estimate")
      end associate
      if (allocated(error)) return
      call check(error, any(result%remarks%kind == missed_means), remark_lines(result%remarks))
   end subroutine test_scatter_of_means

   !> Parts of eight turns whose means are 1 to 5 deviate by the root of 2.5 from their mean. To either side comes what cancels in
   !> each part. Parts of 23 turns are uneven, which a constant does not show.
   subroutine test_scatter_error(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: means(2, 40) ! [-]
      integer :: i

      means(1, :) = [(real(1 + shiftr(i - 1, 3) + 7*(-1)**i, wp), i=1, 40)]
      means(2, :) = [(sin(0.25_wp*pi*i), i=1, 40)]
      call check_scaled(error, maxval(abs(scatter_error(means) - [2.776445_wp*sqrt(2.5_wp/5), 0.0_wp])), 0.0_wp, 1.0_wp, &
         & 1.0e-12_wp, "parts of 40 turns")
      if (allocated(error)) return
      means = 1.0_wp
      call check_scaled(error, maxval(scatter_error(means(:, :23))), 0.0_wp, 1.0_wp, 1.0e-12_wp, "a constant")
   end subroutine test_scatter_error

   !> Run the train of `decks/dynamics.nml` with lash, without surge of its spring.
   subroutine run_rattling(lash, speed, accuracy, result, failure)
      !> Lash [m], speed [rev/min], accuracy [-]
      real(wp), intent(in) :: lash, speed, accuracy
      type(result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: failure
      type(case_t) :: the_case

      call get_deck_case("decks/dynamics.nml", the_case, failure)
      if (allocated(failure)) return
      deallocate (the_case%spring_surge)
      call set_point(the_case, speed*pi/30.0_wp, 0.01_wp)
      the_case%dynamics%lash = lash
      the_case%numerics%accuracy = accuracy
      call run_case(the_case, result, failure)
   end subroutine run_rattling

   !> Starts of 40 turns: of a chaotic map, the same on a slope, and what approaches a fixed point or a period of two.
   subroutine test_trend(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: n = 40
      ! Starts [-]
      real(wp) :: chaos(1, n), starts(1, n)
      type(trend_t) :: trend
      integer :: i

      chaos(1, 1) = 0.3_wp
      do i = 2, n
         chaos(1, i) = 3.9_wp*chaos(1, i - 1)*(1.0_wp - chaos(1, i - 1))
      end do
      call find_trend(chaos, trend)
      call check(error, .not. trend%drifts .and. trend%approached == 0, "a chaotic map has a trend")
      if (allocated(error)) return
      starts(1, :) = chaos(1, :) + [(0.05_wp*i, i=1, n)]
      call find_trend(starts, trend)
      call check(error, trend%drifts .and. trend%approached == 0, "a drift is not seen")
      if (allocated(error)) return
      ! A first turn that lies farther off than all of the drift
      starts(1, :) = [-2.0_wp*n, (-0.01_wp*i, i=2, n)]
      call find_trend(starts, trend)
      call check(error, trend%drifts, "a drift behind one turn that is far off is not seen")
      if (allocated(error)) return
      starts(1, :) = 0.0_wp
      call find_trend(starts, trend)
      call check(error, .not. trend%drifts, "a constant drifts")
      if (allocated(error)) return
      starts(1, :) = [(0.9_wp**i, i=1, n)]
      call find_trend(starts, trend)
      call check(error, trend%approached, 1, "a fixed point")
      if (allocated(error)) return
      starts(1, :) = [((-1.0_wp)**i*(1.0_wp + 0.95_wp**i), i=1, n)]
      call find_trend(starts, trend)
      call check(error, trend%approached, 2, "a period of two")
   end subroutine test_trend

   !> Two turns whose starts differ in the first component alone: half of that goes to the second one and a hundredth comes back
   !> with the other sign; then nearly all comes back so.
   subroutine test_alternating(error)
      type(error_type), allocatable, intent(out) :: error
      ! Differences of the ends [-]
      real(wp), parameter :: ends(2, 2) = reshape([-0.01_wp, 0.5_wp, -0.95_wp, 0.0_wp], [2, 2])
      type(history_t) :: history
      integer :: i

      allocate (history%starts(2, 2), history%residuals(2, 2), source=0.0_wp)
      history%kept = 2
      history%starts(1, 1) = 1.0_wp
      do i = 1, 2
         history%residuals(:, 1) = ends(:, i) - history%starts(:, 1)
         call check(error, is_alternating(history, closure) .eqv. i == 2)
         if (allocated(error)) return
      end do
   end subroutine test_alternating

   !> Turns of a linear map: the first component loses a hundredth a turn, the second nine tenths, to a fixed point at 1 and 2.
   subroutine test_extrapolation(error)
      type(error_type), allocatable, intent(out) :: error
      ! Parts that a turn leaves, fixed point [-]
      real(wp), parameter :: left(2) = [0.99_wp, 0.1_wp], fixed(2) = [1.0_wp, 2.0_wp]
      type(history_t) :: history
      ! Starts of three turns, their residuals, what is extrapolated [-]
      real(wp) :: starts(2, 3), residuals(2, 3), aim(2)
      integer :: i

      starts(:, 1) = 0.0_wp
      do i = 1, 3
         residuals(:, i) = (left - 1.0_wp)*(starts(:, i) - fixed)
         if (i < 3) starts(:, i + 1) = starts(:, i) + residuals(:, i)
      end do
      allocate (history%starts(2, 3), history%residuals(2, 3))
      history%starts = starts(:, 3:1:-1)
      history%residuals = residuals(:, 3:1:-1)
      history%kept = 3
      call extrapolate(history, starts(:, 3), residuals(:, 3), aim)
      do i = 1, 2
         ! The square of what is slow is 1e-8 of that of what is fast, and 1e-10 of this keeps the normal equations regular
         call check_scaled(error, aim(i), fixed(i), 1.0_wp, 1.0e-2_wp, "extrapolated state")
         if (allocated(error)) return
      end do
   end subroutine test_extrapolation

end module test_flexible_periods
