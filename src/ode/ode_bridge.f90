!> Steps across a narrow range of the state in which the rate saturates and which the step sizes of a method cannot resolve.
!>
!> In: a problem of one component and a point. Out: the states in the middle and at the end of a step, by the implicit Euler
!> method. Its equation `y = y_0 + h f(t_0 + h, y)` is solved by bisection, without derivatives, so that a step may begin, end or
!> lie in such a range whatever its size. Where disturbances decay, the method is contractive; the error of a step is estimated
!> by comparison with two steps of half the size.
module camroller_ode_bridge
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, linear_t, counters_t
   implicit none
   private

   public :: footing_t, bridge_t, watch, is_stuck, try_bridge, note_bridge, solve_euler

   !> Two steps of the implicit Euler method
   type :: bridge_t
      !> Size of both together [time]
      real(wp) :: step = 0.0_wp
      !> State after one and after both [state], rates there [state/time]
      real(wp) :: states(2) = 0.0_wp, rates(2) = 0.0_wp
      !> Step that may follow [time]
      real(wp) :: next_step = 0.0_wp
      !> Was a step found?
      logical :: is_found = .false.
   end type bridge_t

   !> Progress of an integration
   type :: footing_t
      !> Factor on the limits below which a method makes no progress; one where it has progressed without bridges [-]
      real(wp) :: reach = 1.0_wp
      !> Time of the last point [time]
      real(wp) :: time = -huge(1.0_wp)
      !> Is the step to be tried much larger than the one before, or does it follow a bridge? Then the method is given a try
      logical :: is_fresh = .true.
   end type footing_t

   !> Change of the state that the largest rate makes in a step, over the error allowed, below which a method makes no progress [-]
   real(wp), parameter :: slow = 100.0_wp
   !> Step over the spacing of numbers near its time, below which the same holds [-]
   real(wp), parameter :: short = 1.0e4_wp
   !> Factors of the limits after a bridge and after a step without one; the largest product. Where bridges follow each other, with
   !> next to nothing between, they grow longer [-]
   real(wp), parameter :: wider = 4.0_wp, closer = 0.5_wp, farthest = 1.0e4_wp
   !> Step relative to the one before from which on a method makes good progress [-]
   real(wp), parameter :: growing = 2.0_wp
   !> First step over one with which a method gets nowhere; largest growth and shrinkage; part of the best step that is taken [-]
   real(wp), parameter :: start_growth = 4.0_wp, max_growth = 10.0_wp, max_shrinkage = 0.1_wp, safety = 0.9_wp
   !> Shrinkages of a step; evaluations to find one state
   integer, parameter :: most_tries = 12, most_trials = 300

contains

   !> Does a step change the state by little more than the error allowed, whatever happens in it?
   !>
   !> Steps that grow are not stuck, however small. Where a load comes from zero, the largest rate at the start of a step is none,
   !> and without a try of the method bridges would follow each other long after there is reason to.
   pure function is_stuck(here, time, step, tolerance, footing) result(verdict)
      !> Rate with its derivatives at the start
      type(linear_t), intent(in) :: here
      !> Time at the start, size of the step [time]
      real(wp), intent(in) :: time, step
      !> Error allowed per step [state]
      real(wp), intent(in) :: tolerance(:)
      !> Progress of the integration
      type(footing_t), intent(in) :: footing
      !> Does it? Never where nothing saturates
      logical :: verdict

      ! Times the limits [-]
      real(wp) :: reach

      verdict = size(tolerance) == 1 .and. here%span < huge(1.0_wp)
      reach = merge(1.0_wp, footing%reach, footing%is_fresh)
      if (verdict) verdict = (step*(here%span + abs(here%rate(1))) <= slow*reach*tolerance(1) .and. .not. footing%is_fresh) .or. &
         & step <= short*reach*spacing(abs(time))
   end function is_stuck

   !> Look at a point that an integration has reached by a step.
   pure subroutine watch(footing, time, step)
      !> Progress of the integration
      type(footing_t), intent(inout) :: footing
      !> Time of the point, size of the step that is to follow [time]
      real(wp), intent(in) :: time, step

      if (.not. time > footing%time) return
      footing%reach = max(1.0_wp, closer*footing%reach)
      footing%is_fresh = footing%is_fresh .or. step/growing >= time - footing%time
      footing%time = time
   end subroutine watch

   !> Take note of a bridge.
   pure subroutine note_bridge(footing, time)
      !> Progress of the integration
      type(footing_t), intent(inout) :: footing
      !> Time at its end [time]
      real(wp), intent(in) :: time

      footing = footing_t(min(farthest, wider*footing%reach), time, .true.)
   end subroutine note_bridge

   !> Find the largest step that is accurate enough, and make it.
   subroutine try_bridge(problem, here, time, state, step, largest, tolerance, bridge, counters)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> Rate with its derivatives at the start
      type(linear_t), intent(in) :: here
      !> Time at the start [time], state there [state]
      real(wp), intent(in) :: time, state
      !> Step with which another method gets nowhere, largest possible step [time]
      real(wp), intent(in) :: step, largest
      !> Error allowed [state]
      real(wp), intent(in) :: tolerance
      !> The steps
      type(bridge_t), intent(out) :: bridge
      !> Work done so far
      type(counters_t), intent(inout) :: counters

      ! State after one step of the whole size [state]; its rate [state/time]; error over tolerance, growth of the step [-]
      real(wp) :: whole, rate, scaled_error, factor
      integer :: i, status

      bridge%step = min(start_growth*step, largest)
      do i = 1, most_tries
         call solve_euler(problem, here%span, time + bridge%step, state, bridge%step, whole, rate, counters, status)
         if (status == 0) call solve_euler(problem, here%span, time + 0.5_wp*bridge%step, state, 0.5_wp*bridge%step, &
            & bridge%states(1), bridge%rates(1), counters, status)
         if (status == 0) call solve_euler(problem, here%span, time + bridge%step, bridge%states(1), 0.5_wp*bridge%step, &
            & bridge%states(2), bridge%rates(2), counters, status)
         factor = max_shrinkage
         if (status == 0) then
            ! The second is that of straight lines between the points
            scaled_error = max(abs(bridge%states(2) - whole), &
               & 0.25_wp*abs(state - 2.0_wp*bridge%states(1) + bridge%states(2)))/tolerance
            factor = min(max_growth, max(max_shrinkage, safety/sqrt(max(scaled_error, tiny(1.0_wp)))))
            bridge%is_found = scaled_error <= 1.0_wp
         end if
         if (bridge%is_found .or. status < 0) exit
         bridge%step = factor*bridge%step
         if (bridge%step <= 16.0_wp*spacing(abs(time))) exit
      end do
      bridge%next_step = factor*bridge%step
   end subroutine try_bridge

   !> One step by the implicit Euler method.
   subroutine solve_euler(problem, span, time, state, step, new_state, rate, counters, status)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> Largest part of the rate that saturates [state/time]
      real(wp), intent(in) :: span
      !> Time at the end [time]
      real(wp), intent(in) :: time
      !> State at the start [state]
      real(wp), intent(in) :: state
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> State at the end [state]
      real(wp), intent(out) :: new_state
      !> Rate there [state/time]
      real(wp), intent(out) :: rate
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: no solution found, negative: give up
      integer, intent(out) :: status

      ! Fraction of the largest rate that counts as zero [-]
      real(wp), parameter :: part = 1.0e-8_wp
      ! Lower and upper end of the bracket, a state between [state]; rate there [state/time]; what is left of the equation, at both
      ! ends of the bracket and between [state]
      real(wp) :: lower, upper, trial(1), rates(1), rest, rest_lower, rest_upper
      ! Barrier of the problem at the end [state]
      real(wp) :: barrier
      integer :: i
      logical :: is_below

      call look_for_barrier(problem, time, state, step, barrier, is_below, trial(1))
      lower = -huge(1.0_wp)
      upper = huge(1.0_wp)
      rest_lower = 0.0_wp
      rest_upper = 0.0_wp
      do i = 1, most_trials
         call problem%get_rate(time, trial, rates, status)
         counters%evaluations = counters%evaluations + 1
         new_state = trial(1)
         rate = rates(1)
         if (status /= 0) return
         rest = trial(1) - state - step*rate
         if (rest > 0.0_wp) then
            upper = trial(1)
            rest_upper = rest
         else
            lower = trial(1)
            rest_lower = rest
         end if
         if (abs(rest) <= step*part*(span + abs(rate))) return
         if (lower <= -huge(1.0_wp) .or. upper >= huge(1.0_wp)) then
            ! first to where the rate at the start leads, then further and further
            trial = trial - sign(max(2.0_wp*abs(rest), 8.0_wp*spacing(trial(1))), rest)
            if (is_below .and. lower < barrier) trial = min(trial, barrier)
            if (.not. is_below .and. upper > barrier) trial = max(trial, barrier)
         else
            trial = halfway(lower, upper)
            ! the secant and bisection take turns
            if (modulo(i, 2) == 0 .and. lower*upper > 0.0_wp) then
               trial = lower - rest_lower*(upper - lower)/(rest_upper - rest_lower)
            end if
            if (.not. (trial(1) > lower .and. trial(1) < upper)) return
         end if
      end do
      status = 1
   end subroutine solve_euler

   !> Where is the barrier of a problem at the end of a step, and on which side of it is the state at the start?
   !>
   !> A state is held at a barrier on its own side. So the search begins on that side, and goes beyond the barrier only after the
   !> barrier itself has been tried.
   subroutine look_for_barrier(problem, time, state, step, barrier, is_below, first)
      class(problem_t), intent(in) :: problem
      !> Time at the end [time]
      real(wp), intent(in) :: time
      !> State at the start [state]
      real(wp), intent(in) :: state
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Barrier at the end; huge where there is none [state]
      real(wp), intent(out) :: barrier
      !> Is the state at the start below the barrier of that time?
      logical, intent(out) :: is_below
      !> State to try first [state]
      real(wp), intent(out) :: first

      ! Roundings of a state, by which the barrier is kept off: the rate may have no limit there [-]
      real(wp), parameter :: roundings = 4.0_wp
      ! Clearance at the start and at the end [state]
      real(wp) :: before, after

      call problem%get_clearance(time - step, [state], before)
      call problem%get_clearance(time, [state], after)
      is_below = before >= 0.0_wp
      first = state
      barrier = merge(huge(1.0_wp), -huge(1.0_wp), is_below)
      if (abs(before) >= huge(1.0_wp) .or. abs(after) >= huge(1.0_wp)) return
      barrier = state + after
      barrier = barrier - sign(roundings*spacing(barrier), before)
      if (is_below .neqv. after >= 0.0_wp) first = barrier
   end subroutine look_for_barrier

   !> A point between two others that halves the number of digits between them while they are far apart.
   pure function halfway(lower, upper) result(middle)
      !> Two points [state]
      real(wp), intent(in) :: lower, upper
      !> The point [state]
      real(wp) :: middle

      ! Ratio from which on digits are halved [-]
      real(wp), parameter :: far = 4.0_wp
      ! The sizes [state]
      real(wp) :: small, large

      middle = 0.0_wp
      if (lower < 0.0_wp .and. upper > 0.0_wp) return
      small = max(min(abs(lower), abs(upper)), tiny(1.0_wp))
      large = max(abs(lower), abs(upper))
      middle = 0.5_wp*(small + large)
      if (large > far*small) middle = sqrt(small)*sqrt(large)
      if (lower < 0.0_wp) middle = -middle
   end function halfway

end module camroller_ode_bridge
