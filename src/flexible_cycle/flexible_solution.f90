!> The solution of a case with a flexible train: its periodic state, all turns of a period, measures with their scatter, its error.
!>
!> In: model, numerics. Out: `flexible_solution_t`. Where no number of cycles repeats itself, it holds as many turns as make
!> statistics, and says so.
module camroller_flexible_solution
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, add_context, kind_deck
   use camroller_accuracy, only : has_error_control
   use camroller_balance, only : least_slip
   use camroller_case, only : numerics_t
   use camroller_names, only : name_length
   use camroller_model, only : model_t
   use camroller_ode_problem, only : counters_t
   use camroller_trajectory, only : trajectory_t, interpolate_state
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, at_sliding
   use camroller_flexible_cycle, only : flexible_cycle_t, find_periodic, extrapolate, rest_of_train
   use camroller_flexible_moves, only : is_possible
   use camroller_flexible_turn, only : turn_t, start_turns, set_tolerance, integrate_turn
   use camroller_flexible_measure_list, only : largest_load, largest_load_angle, measure_count, seating_speed, smallest_lift
   use camroller_flexible_measures, only : measure_turn
   use camroller_flexible_trend, only : find_trend, trend_t
   implicit none
   private

   public :: flexible_solution_t, solve_flexible, train_method, statistical_turns, error_share

   !> Turns that make statistics where there is no period
   integer, parameter :: statistical_turns = 40
   !> Fewer of them, where their steps are so many that the search for a period was given up
   integer, parameter :: least_statistics = 10
   !> Cycles that are allowed at least
   integer, parameter :: least_cycles = 40
   !> Cycles that are allowed of a search with a larger tolerance: most trains take fewer, and one without a period loses little
   integer, parameter :: few_cycles = 20
   !> Steps a cycle, on average over all that are allowed, after which the search for a period is given up, at the tolerance below
   !> or a larger one: trains without a period take up to 2900, `decks/dynamics.nml` at 4500 rev/min, and 5000 to 15000 where
   !> contacts part a hundred times in a turn
   integer, parameter :: search_steps = 4000
   !> That tolerance; exponent with which steps grow as it falls, for a method of order 5 [-]
   real(wp), parameter :: usual_tolerance = 4.0e-7_wp, steps_exponent = 0.2_wp
   !> Steps of all turns together after which a train is given up: ten times as many as a usual train takes without a period, and a
   !> minute of work
   integer, parameter :: most_work = 2000000
   !> Method for a single unknown, which the roller alone is, and the one that takes its place
   character(len=*), parameter :: single_method = "hermite"
   character(len=*), parameter :: method_for_trains = "rodas5p"
   !> Tolerance of a step over that of the roller's equation for the same accuracy: with it estimates of the error of load and slip
   !> stay near the accuracy [-]
   real(wp), parameter, public :: tolerance_ratio = 0.4_wp
   !> Distance from the periodic state that is near enough, over the tolerance [-]
   real(wp), parameter :: closure_ratio = 10.0_wp
   !> Tolerance of a search over that of the next, a turn of which takes two to four times the steps; the largest one, with which
   !> loads are good to a hundredth or two [-] (`doc/notes/dynamics.md`, cycles to the periodic state)
   real(wp), parameter :: level_ratio = 100.0_wp, largest_level = 5.0e-4_wp
   !> Tolerance of the turn that the error is estimated with, over the tolerance, and how much it errs at most, over the error [-]:
   !> a method of order 5 errs as its tolerance to the power 4/5 or 1, and less regularly where contacts open. A turn that errs
   !> more in the place of one that errs less would tell less: where steps are long, errors hardly grow with the tolerance
   real(wp), parameter :: finer = 0.25_wp, better = 0.5_wp
   !> Error over the difference of both turns [-]
   real(wp), parameter :: error_share = 1.0_wp/(1.0_wp - better)

   !> Periodic state or turns without a period
   type :: flexible_solution_t
      type(flexible_cycle_t) :: cycle
      !> Turns of the period, or those for statistics
      type(trajectory_t), allocatable :: turns(:)
      !> Measures of each turn, shape (measure, turn) [unit of the measure]
      real(wp), allocatable :: values(:, :)
      !> Means of the measures over the turns that have them, their standard deviations, smallest and largest [unit of the measure];
      !> the angle of the largest load is that of the turn with the largest of all
      real(wp), allocatable :: mean(:), deviation(:), lowest(:), highest(:)
      !> How the turns for statistics change from one to the next
      type(trend_t) :: trend
      !> Was the search for a period given up before the turns allowed, since they take so many steps?
      logical :: is_cut_short = .false.
      !> Turns of that search, without those with larger tolerances before it
      integer :: tried = 0
      !> The last turn again, with a finer tolerance, and what its integration did not tell apart
      type(trajectory_t) :: finer
      type(resolution_t) :: finer_resolution
      !> Estimated error of load and sliding speed over the largest [-]
      real(wp) :: error = 0.0_wp
      !> Cam angle where that error is largest [rad]
      real(wp) :: error_angle = 0.0_wp
   end type flexible_solution_t

contains

   !> Solve a model's train.
   subroutine solve_flexible(solution, model, numerics, error, start)
      !> The solution
      type(flexible_solution_t), intent(out) :: solution
      !> The model, with a flexible train
      type(model_t), intent(in), target :: model
      !> Numerics with method and tolerance
      type(numerics_t), intent(in) :: numerics
      !> Deck error for a method that cannot; convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Start of a turn near the periodic state; absent or not allocated: not known [state]
      real(wp), allocatable, intent(in), optional :: start(:)

      type(turn_t) :: turn
      ! State [state]
      real(wp), allocatable :: state(:)
      character(len=name_length) :: method
      integer :: max_cycles
      logical :: is_near

      method = train_method(numerics)
      if (.not. has_error_control(numerics%method)) then
         call raise(error, kind_deck, "numerics.method = '"//trim(method)//"' controls no error, which a flexible train needs; "// &
            & "take '"//method_for_trains//"' or 'radau5'")
         return
      end if
      solution%cycle%tolerance = tolerance_ratio*numerics%tolerance
      call start_turns(turn, model, method, solution%cycle%tolerance, error)
      if (present(start)) then
         if (allocated(start)) state = start
      end if
      is_near = allocated(state)
      if (.not. (is_near .or. allocated(error))) call rest_of_train(model, state, error)
      max_cycles = max(least_cycles, numerics%max_cycles)
      turn%most_work = most_work
      turn%most_search = int(min(real(most_work, wp), real(search_steps, wp)*max_cycles &
         & *max(1.0_wp, usual_tolerance/solution%cycle%tolerance)**steps_exponent))
      if (.not. allocated(error)) call search_by_levels(solution, turn, state, max_cycles, is_near, error)
      if (.not. allocated(error)) call take_turns(solution, turn, state, error)
      call add_context(error, "integrating the flexible train")
      if (.not. allocated(error)) call take_measures(solution, model, error)
      if (.not. allocated(error)) call estimate_error(solution, turn, error)
   end subroutine solve_flexible

   !> Look for the periodic state with large tolerances first, whose turns take fewer steps, and from there with the one wanted;
   !> with that alone where it is near.
   subroutine search_by_levels(solution, turn, state, max_cycles, is_near, error)
      !> The solution, with the tolerance
      type(flexible_solution_t), intent(inout) :: solution
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> In: where the first turn starts; out: where the last one ends [state]
      real(wp), intent(inout) :: state(:)
      !> Turns at most of the search with the tolerance wanted
      integer, intent(in) :: max_cycles
      !> Is the periodic state near?
      logical, intent(in) :: is_near
      !> Convergence error where a turn cannot be integrated
      type(error_t), allocatable, intent(out) :: error

      ! Tolerance over the one wanted [-]
      real(wp) :: ratio
      ! Steps of a search at most, those of the searches before; turns of these
      integer :: most_search, steps, cycles

      most_search = turn%most_search
      ratio = 1.0_wp
      do while (level_ratio*ratio*solution%cycle%tolerance <= largest_level .and. .not. is_near)
         ratio = level_ratio*ratio
      end do
      associate (cycle => solution%cycle)
         do
            cycles = cycle%cycles
            steps = cycle%counters%accepted + cycle%counters%rejected
            turn%most_search = steps + most_search
            call set_tolerance(turn, ratio*cycle%tolerance*turn%scales)
            call find_periodic(cycle, turn, state, closure_ratio*ratio*cycle%tolerance, merge(max_cycles, few_cycles, &
               & ratio <= 1.0_wp), error)
            if (allocated(error)) return
            if (.not. ratio > 1.0_wp) exit
            cycle%period = 0
            ratio = ratio/level_ratio
         end do
         solution%tried = cycle%cycles - cycles
         solution%is_cut_short = cycle%period == 0 .and. solution%tried < max_cycles
      end associate
   end subroutine search_by_levels

   !> Turns of the period, or those for statistics: where the search for a period was given up, as many as it took, within limits.
   subroutine take_turns(solution, turn, state, error)
      !> The solution, with what the search has found
      type(flexible_solution_t), intent(inout) :: solution
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> State at the end of the search; out: at the end of the turns [state]
      real(wp), intent(inout) :: state(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: i, count

      count = merge(solution%cycle%period, statistical_turns, solution%cycle%period > 0)
      if (solution%is_cut_short) count = min(statistical_turns, max(least_statistics, solution%cycle%cycles))
      allocate (solution%turns(count))
      if (count == 1) then
         solution%turns(1) = solution%cycle%trajectory
         return
      end if
      do i = 1, count
         call integrate_turn(turn, state, solution%turns(i), solution%cycle%counters, error)
         if (allocated(error)) return
      end do
      solution%cycle%trajectory = solution%turns(count)
      ! Fewer turns may seem to have a trend by chance
      if (solution%cycle%period == 0 .and. count == statistical_turns) call note_trend(solution, turn%scales)
   end subroutine take_turns

   !> How the turns for statistics change from one to the next.
   subroutine note_trend(solution, scales)
      !> The solution, with its turns
      type(flexible_solution_t), intent(inout) :: solution
      !> Sizes of the components [state]
      real(wp), intent(in) :: scales(:)

      ! Starts of the turns, in units of the scales [-]
      real(wp) :: starts(size(scales), size(solution%turns))
      integer :: i

      do i = 1, size(solution%turns)
         starts(:, i) = solution%turns(i)%state(:, 1)/scales
      end do
      call find_trend(starts, solution%trend)
   end subroutine note_trend

   !> Method that integrates a flexible train: the one given, or another in the place of that for a single unknown.
   pure function train_method(numerics) result(method)
      !> Numerics with a method
      type(numerics_t), intent(in) :: numerics
      !> Its name
      character(len=name_length) :: method

      method = numerics%method
      if (method == single_method) method = method_for_trains
   end function train_method

   !> Measures of all turns, and what they come to.
   subroutine take_measures(solution, model, error)
      type(flexible_solution_t), intent(inout) :: solution
      type(model_t), intent(in) :: model
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: i, n

      n = size(solution%turns)
      allocate (solution%values(measure_count(merge(2, 1, allocated(model%flexible%adjuster))), n))
      do i = 1, n
         call measure_turn(model, solution%turns(i), solution%cycle%resolution, solution%values(:, i), error)
         if (allocated(error)) return
      end do
      n = size(solution%values, 1)
      allocate (solution%mean(n), solution%deviation(n), solution%lowest(n), solution%highest(n))
      associate (values => solution%values)
         do i = 1, n
            select case (i)
            case (seating_speed)
               call describe(pack(values(i, :), values(smallest_lift, :) <= 0.0_wp), solution, i)
            case (largest_load_angle)
               ! Angles have no mean: that of the turn with the largest load counts
               call describe([values(i, maxloc(values(largest_load, :), 1))], solution, i)
            case default
               call describe(values(i, :), solution, i)
            end select
         end do
      end associate
   end subroutine take_measures

   !> Mean, scatter and range of a measure over turns; zero where no turn has it.
   subroutine describe(values, solution, place)
      !> The measure in the turns that have it [unit of the measure]
      real(wp), intent(in) :: values(:)
      !> Gets them
      type(flexible_solution_t), intent(inout) :: solution
      !> Number of the measure
      integer, intent(in) :: place

      associate (mean => solution%mean(place), n => size(values))
         mean = 0.0_wp
         solution%deviation(place) = 0.0_wp
         solution%lowest(place) = 0.0_wp
         solution%highest(place) = 0.0_wp
         if (n == 0) return
         mean = sum(values)/n
         solution%deviation(place) = sqrt(sum((values - mean)**2)/max(1, n - 1))
         solution%lowest(place) = minval(values)
         solution%highest(place) = maxval(values)
      end associate
   end subroutine describe

   !> Error of the last turn: its difference from one with a finer tolerance, which errs less and starts where that has its periodic
   !> state.
   subroutine estimate_error(solution, turn, error)
      type(flexible_solution_t), intent(inout) :: solution
      !> What integrates
      type(turn_t), intent(inout) :: turn
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(counters_t) :: counters
      type(flexible_state_t) :: now
      ! States of both turns [state] at an angle [rad], their loads [N] and sliding speeds [m/s]
      real(wp) :: state(size(turn%scales)), other_state(size(turn%scales)), angle, loads(2), speeds(2)
      ! Largest load [N] and sliding speed [m/s], largest differences [N], [m/s]
      real(wp) :: largest(2), differences(2)
      ! Parts of a step at whose ends both turns are compared
      integer, parameter :: parts = 4
      integer :: i, hint, other_hint, status

      call set_tolerance(turn, finer*turn%options%tolerance)
      associate (path => solution%cycle%trajectory, model => turn%problem%model, other => solution%finer, &
         & resolution => solution%cycle%resolution, other_resolution => solution%finer_resolution)
         other_resolution = resolution_t(sliding_speed=turn%problem%resolution%sliding_speed)
         call start_finer(solution, turn, state, error)
         if (.not. allocated(error)) call integrate_turn(turn, state, other, counters, error)
         call add_context(error, "estimating the error of the flexible train")
         if (allocated(error)) return
         hint = 1
         other_hint = 1
         largest = [tiny(1.0_wp), least_slip*model%speed*model%roller_radius]
         differences = 0.0_wp
         do i = 0, parts*(path%count - 1)
            ! Between points the curve may be worse
            angle = path%time(1 + i/parts)
            if (modulo(i, parts) > 0) angle = angle + modulo(i, parts)*(path%time(2 + i/parts) - angle)/parts
            call interpolate_state(path, angle, hint, state)
            call interpolate_state(other, min(angle, other%time(other%count)), other_hint, other_state)
            call evaluate_train(model, angle, state, resolution, now, status)
            loads(1) = now%contact%load
            call evaluate_train(model, angle, other_state, other_resolution, now, status)
            loads(2) = now%contact%load
            speeds = [state(at_sliding), other_state(at_sliding)]
            largest = max(largest, [loads(1), abs(speeds(1))])
            if (abs(loads(1) - loads(2)) > differences(1)) solution%error_angle = angle
            differences = max(differences, abs([loads(1) - loads(2), speeds(1) - speeds(2)]))
         end do
         solution%error = maxval(differences/largest)*error_share
      end associate
   end subroutine estimate_error

   !> Start of the turn that the error is estimated with: where the turns so far and one with the finer tolerance say that its
   !> periodic state is. So what is left to the periodic state counts, and what the errors of the turns before have made of the
   !> start: where a disturbance lasts, many times the error of a turn. Without a period of one turn it is the start of the last
   !> turn.
   subroutine start_finer(solution, turn, state, error)
      type(flexible_solution_t), intent(inout) :: solution
      !> What integrates, with the finer tolerance
      type(turn_t), intent(inout) :: turn
      !> The state [state]
      real(wp), intent(out) :: state(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(counters_t) :: counters
      ! Start of the last turn, where the periodic state should be, in units of the scales [-]
      real(wp), dimension(size(state)) :: start, aim

      associate (path => solution%cycle%trajectory)
         state = path%state(:, 1)
         if (solution%cycle%period /= 1) return
         start = state/turn%scales
         call integrate_turn(turn, state, solution%finer, counters, error)
         if (allocated(error)) return
         call extrapolate(solution%cycle%history, start, state/turn%scales - start, aim)
         if (is_possible(turn, aim)) state = aim*turn%scales
      end associate
   end subroutine start_finer

end module camroller_flexible_solution
