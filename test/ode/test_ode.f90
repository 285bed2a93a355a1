!> Integration: what every method keeps, whatever its name; the loop's promises; failures in words.
module test_ode
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_convergence, kind_deck
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_ode_problem, only : problem_t
   use camroller_ode_methods, only : method_facts, method_names, new_method
   use camroller_trajectory, only : trajectory_t, curve_slope, interpolate_state
   use ode_problems, only : known_t, pair, power, switch_t, wall_t, stable_methods
   implicit none
   private

   public :: collect_ode

contains

   subroutine collect_ode(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("each method shows its order on a smooth problem", test_order), &
         new_unittest("the curve between points is as good as the method, order 3 or more where it matters", test_curve), &
         new_unittest("each method integrates the powers of its order exactly", test_powers), &
         new_unittest("stiffly stable methods follow a slow solution whatever the decay rate", test_slow), &
         new_unittest("stiffly stable methods lose a disturbance in a single long step", test_disturbance), &
         new_unittest("the curve of stiffly stable methods stays smooth where the rates at its ends are not", test_stiff_curve), &
         new_unittest("a smaller tolerance gives a smaller error, in proportion", test_tolerance), &
         new_unittest("explicit methods keep within their stability limit", test_stability), &
         new_unittest("stops are never stepped over, however long the allowed step", test_stops), &
         new_unittest("at a stop the curve is that of the step before, however far rates on both sides are apart", test_gap), &
         new_unittest("a trial without a value makes the step smaller and leaves the point untouched", test_rejection), &
         new_unittest("a method that has forgotten its steps is as good as new, to the last bit", test_forget), &
         new_unittest("evaluations are counted one by one", test_counters), &
         new_unittest("an unknown method is refused with the known ones", test_unknown), &
         new_unittest("failures name the time", test_failures) &
         ]
   end subroutine collect_ode

   !> Integrate with a method in steps of one size.
   subroutine integrate_evenly(problem, name, step, times, state, trajectory)
      class(problem_t), intent(in) :: problem
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: step, times(:)
      real(wp), intent(inout) :: state(:)
      type(trajectory_t), intent(inout) :: trajectory

      class(method_t), allocatable :: method
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure

      call new_method(method, name, size(state), failure)
      ! the tolerance of iterations
      options%tolerance = spread(1.0e-12_wp, 1, size(state))
      options%step = step
      options%is_fixed = .true.
      call integrate(problem, method, options, times, state, trajectory, counters, failure)
      if (allocated(failure)) state = -huge(1.0_wp)
   end subroutine integrate_evenly

   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp), allocatable :: state(:)
      real(wp) :: errors(2), order
      integer :: i, k

      problem%kind = pair
      do i = 1, size(method_names)
         ! the first step is of another order; see ode_special
         if (method_names(i) == "hermite") cycle
         do k = 1, 2
            state = spread(1.0_wp, 1, min(2, method_facts(i)%max_components))
            call integrate_evenly(problem, method_names(i), 0.05_wp/2**(k - 1), [0.0_wp, 1.0_wp], state, trajectory)
            errors(k) = maxval(abs(state - exp(sin(1.0_wp))))
         end do
         order = log(errors(1)/errors(2))/log(2.0_wp)
         ! halving the step once more would change the figure by about the relative step, times a factor of a few
         call check(error, abs(order - method_facts(i)%order) < 0.5_wp, trim(method_names(i))//" has another order")
         if (allocated(error)) return
      end do
   end subroutine test_order

   subroutine test_curve(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp), allocatable :: state(:)
      real(wp) :: errors(2), order, time
      character(len=*), parameter :: quartics(*) = [character(len=14) :: "rodas5p", "hermite", "dormand_prince"]
      integer :: i, k, n, hint

      problem%kind = pair
      do i = 1, size(method_names)
         do k = 1, 2
            state = spread(1.0_wp, 1, min(2, method_facts(i)%max_components))
            trajectory%is_linear = method_facts(i)%companion_order == 0
            call integrate_evenly(problem, method_names(i), 0.05_wp/2**(k - 1), [0.0_wp, 1.0_wp], state, trajectory)
            errors(k) = 0.0_wp
            hint = 1
            do n = 1, 999
               time = 0.001_wp*n
               call interpolate_state(trajectory, time, hint, state)
               errors(k) = max(errors(k), maxval(abs(state - exp(sin(time)))))
            end do
         end do
         order = log(errors(1)/errors(2))/log(2.0_wp)
         ! cubics are of order 4 everywhere, quartics of 5; only fixed steps of order 1 are joined by lines
         call check(error, order > merge(5, min(method_facts(i)%order, 4), any(method_names(i) == quartics)) - 0.5_wp, &
            & trim(method_names(i))//" has a poorer curve")
         if (allocated(error)) return
      end do
   end subroutine test_curve

   subroutine test_powers(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp) :: state(1)
      integer :: i

      problem%kind = power
      do i = 1, size(method_names)
         state = 1.0_wp
         problem%degree = method_facts(i)%order
         ! of the order of its first step
         if (method_names(i) == "hermite") problem%degree = 4
         call integrate_evenly(problem, method_names(i), 0.5_wp, [1.0_wp, 2.0_wp], state, trajectory)
         ! values up to 32; coefficients of tables reach 100 and are printed to 16 figures
         call check(error, abs(state(1) - 2.0_wp**problem%degree) < 1.0e4_wp*epsilon(1.0_wp), &
            & trim(method_names(i))//" misses its power")
         if (allocated(error)) return
         ! quadrature of some tables is one order better than the method
         problem%degree = method_facts(i)%order + 3
         state = 1.0_wp
         call integrate_evenly(problem, method_names(i), 0.5_wp, [1.0_wp, 2.0_wp], state, trajectory)
         call check(error, abs(state(1) - 2.0_wp**problem%degree) > 1.0e-8_wp, "the test cannot fail")
         if (allocated(error)) return
      end do
   end subroutine test_powers

   subroutine test_slow(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp) :: state(1)
      integer :: i, k

      do i = 1, size(stable_methods)
         do k = 0, 5
            problem%decay = 10.0_wp**k
            state = 1.0_wp
            call integrate_evenly(problem, stable_methods(i), 0.1_wp, [0.0_wp, 2.0_wp], state, trajectory)
            ! the reduced order of the poorest: second order at moderate decay, h^2/10 with the derivatives of the cosine
            call check(error, abs(state(1) - cos(2.0_wp)) < 1.0e-3_wp/max(1.0_wp, problem%decay/100.0_wp), &
               & trim(stable_methods(i))//" loses the slow solution")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_slow

   subroutine test_disturbance(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp) :: state(1)
      integer :: i, k

      do i = 1, size(stable_methods)
         do k = 2, 5
            problem%decay = 10.0_wp**k
            state = 2.0_wp
            call integrate_evenly(problem, stable_methods(i), 0.1_wp, [0.0_wp, 0.1_wp], state, trajectory)
            ! L-stability: what is left falls at least as 1/(decay step), with up to 13 in front for the tables at hand
            call check(error, abs(state(1) - cos(0.1_wp)) < 20.0_wp/(0.1_wp*problem%decay), &
               & trim(stable_methods(i))//" keeps a disturbance")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_disturbance

   subroutine test_stiff_curve(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      real(wp) :: state(1), worst, time
      integer :: i, n, hint

      problem%decay = 1.0e5_wp
      do i = 1, size(stable_methods)
         state = 1.0_wp
         call integrate_evenly(problem, stable_methods(i), 0.1_wp, [0.0_wp, 2.0_wp], state, trajectory)
         worst = 0.0_wp
         hint = 1
         do n = 1, 199
            time = 0.01_wp*n
            call interpolate_state(trajectory, time, hint, state)
            worst = max(worst, abs(state(1) - cos(time)))
         end do
         ! a parabola through the solution errs by h^3/(9 sqrt(3) 6) = 1e-5; factor 10 for methods
         call check(error, worst < 1.0e-4_wp, trim(stable_methods(i))//" has a rough curve")
         if (allocated(error)) return
      end do
   end subroutine test_stiff_curve

   subroutine test_tolerance(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)
      integer :: i, k

      problem%decay = 50.0_wp
      do i = 1, size(method_names)
         if (method_facts(i)%companion_order == 0) cycle
         call new_method(method, method_names(i), 1, failure)
         do k = 4, 8, 2
            options%tolerance = [10.0_wp**(-k)]
            state = 2.0_wp
            call integrate(problem, method, options, [0.0_wp, 3.0_wp], state, trajectory, counters, failure)
            call check(error, .not. allocated(failure), trim(method_names(i))//" fails")
            if (allocated(error)) return
            ! errors per step die out with the decay, so that a few of them are left
            call check(error, abs(state(1) - cos(3.0_wp)) < 10.0_wp*options%tolerance(1), trim(method_names(i))//" errs")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_tolerance

   subroutine test_stability(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1), longest
      integer :: i

      problem%decay = 1.0e3_wp
      do i = 1, size(method_names)
         if (method_facts(i)%companion_order == 0 .or. any(stable_methods == method_names(i))) cycle
         call new_method(method, method_names(i), 1, failure)
         if (method%stability_limit >= huge(1.0_wp)) cycle
         counters = counters_t()
         options%tolerance = [1.0_wp]
         state = 1.0_wp
         call integrate(problem, method, options, [0.0_wp, 1.0_wp], state, trajectory, counters, failure)
         longest = maxval(trajectory%time(2:trajectory%count) - trajectory%time(:trajectory%count - 1))
         call check(error, longest*problem%decay < method%stability_limit, "beyond the limit")
         if (allocated(error)) return
         call check(error, counters%accepted < 1.2_wp*problem%decay/(0.95_wp*method%stability_limit), "too short steps")
         if (allocated(error)) return
      end do
   end subroutine test_stability

   subroutine test_stops(error)
      type(error_type), allocatable, intent(out) :: error
      type(switch_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)
      integer :: i

      ! a dwell of 100 before a slope over 0.01
      problem%switch = 100.0_wp
      problem%slopes = [0.0_wp, 1.0_wp]
      do i = 1, size(method_names)
         call new_method(method, method_names(i), 1, failure)
         options%tolerance = [1.0_wp]
         options%step = 1.0e3_wp
         state = 0.0_wp
         call integrate(problem, method, options, [0.0_wp, 100.0_wp, 100.01_wp], state, trajectory, counters, failure)
         ! the segment begins four roundings of the end after the stop
         call check(error, abs(state(1) - 0.01_wp) < 20.0_wp*spacing(100.0_wp), trim(method_names(i))//" misses the slope")
         if (allocated(error)) return
         call check(error, any(abs(trajectory%time(:trajectory%count) - 100.0_wp) < 10.0_wp*spacing(100.0_wp)), &
            & trim(method_names(i))//" steps over the stop")
         if (allocated(error)) return
      end do
   end subroutine test_stops

   !> A slope that jumps to 1e13 at a stop: in the gap of some 1e-13 a curve through both rates would leave the state by 0.1.
   subroutine test_gap(error)
      type(error_type), allocatable, intent(out) :: error
      type(switch_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp), parameter :: stop_time = 100.0_wp, before = 0.5_wp
      real(wp) :: state(1), slope(1), time
      integer :: i, k, hint

      problem = switch_t(switch=stop_time, slopes=[before, 1.0e13_wp])
      do i = 1, size(method_names)
         call new_method(method, method_names(i), 1, failure)
         options = options_t(tolerance=[1.0_wp], step=1.0_wp)
         state = 0.0_wp
         call integrate(problem, method, options, [0.0_wp, stop_time, 101.0_wp], state, trajectory, counters, failure)
         hint = 1
         do k = -3, 3
            time = stop_time + k*spacing(stop_time)
            call interpolate_state(trajectory, time, hint, state)
            call curve_slope(trajectory, time, hint, slope)
            call check(error, all(abs([state/stop_time, slope] - before) < 1.0e-9_wp), trim(method_names(i))//" bends in the gap")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_gap

   subroutine test_rejection(error)
      type(error_type), allocatable, intent(out) :: error
      type(wall_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)
      integer :: i

      problem%decay = 1.0_wp
      ! a long step falls below this, the solution does not
      problem%lowest = 0.6_wp*exp(-1.1_wp)
      do i = 1, size(method_names)
         if (method_facts(i)%companion_order == 0) cycle
         call new_method(method, method_names(i), 1, failure)
         counters = counters_t()
         options%tolerance = [1.0e-6_wp]
         options%step = 6.0_wp
         state = 1.0_wp
         call integrate(problem, method, options, [0.0_wp, 1.1_wp], state, trajectory, counters, failure)
         call check(error, .not. allocated(failure), trim(method_names(i))//" gives up")
         if (allocated(error)) return
         call check(error, counters%accepted == trajectory%count - 1, trim(method_names(i))//" keeps a rejected point")
         if (allocated(error)) return
         call check(error, maxval(abs(trajectory%state(1, :trajectory%count) - exp(-trajectory%time(:trajectory%count)))) &
            & < 1.0e-4_wp, trim(method_names(i))//" carries a rejected state on")
         if (allocated(error)) return
      end do
   end subroutine test_rejection

   subroutine test_counters(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      integer, target :: calls
      real(wp), allocatable :: state(:)
      integer :: i

      problem%kind = pair
      problem%calls => calls
      do i = 1, size(method_names)
         state = spread(1.0_wp, 1, min(2, method_facts(i)%max_components))
         call new_method(method, method_names(i), size(state), failure)
         counters = counters_t()
         problem%calls = 0
         options%tolerance = spread(1.0e-6_wp, 1, size(state))
         options%step = 0.5_wp
         call integrate(problem, method, options, [0.0_wp, 1.0_wp, 2.5_wp], state, trajectory, counters, failure)
         call check(error, counters%evaluations, problem%calls, trim(method_names(i))//" miscounts its evaluations")
         if (allocated(error)) return
         ! one point more than steps in each of two segments
         call check(error, counters%accepted == trajectory%count - 2, trim(method_names(i))//" miscounts its steps")
         if (allocated(error)) return
         call check(error, method%needs_jacobian .eqv. counters%jacobians > 0, trim(method_names(i))//" miscounts Jacobians")
         if (allocated(error)) return
      end do
   end subroutine test_counters

   !> One step, then with the same method and another rate a second one, from the same point, or from the state that the first one
   !> ended with: what a method remembers of the first one would serve in the second.
   subroutine test_forget(error)
      type(error_type), allocatable, intent(out) :: error
      class(method_t), allocatable :: kept, fresh
      type(error_t), allocatable :: failure
      real(wp) :: first(1), second(1), expected(1)
      integer :: i, k

      do i = 1, size(method_names)
         do k = 1, 2
            call new_method(kept, method_names(i), 1, failure)
            call new_method(fresh, method_names(i), 1, failure)
            first = 2.0_wp
            call make_step(kept, 2.0_wp, first)
            second = merge(2.0_wp, first, k == 1)
            expected = second
            call kept%forget()
            call make_step(kept, 3.0_wp, second)
            call make_step(fresh, 3.0_wp, expected)
            call check(error, abs(second(1) - expected(1)) <= 0.0_wp, trim(method_names(i))//" remembers an earlier step")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_forget

   !> One step of a method from time zero with a rate of decay.
   subroutine make_step(method, decay, state)
      class(method_t), intent(inout) :: method
      real(wp), intent(in) :: decay
      real(wp), intent(inout) :: state(:)

      type(known_t) :: problem
      type(options_t) :: options
      type(counters_t) :: counters
      type(trajectory_t) :: trajectory
      type(error_t), allocatable :: failure

      problem%decay = decay
      ! that of iterations: beyond round-off, so that their start shows
      options%tolerance = [1.0e-6_wp]
      options%step = 0.25_wp
      options%is_fixed = .true.
      call integrate(problem, method, options, [0.0_wp, 0.25_wp], state, trajectory, counters, failure)
      if (allocated(failure)) state = huge(1.0_wp)
   end subroutine make_step

   subroutine test_unknown(error)
      type(error_type), allocatable, intent(out) :: error
      class(method_t), allocatable :: method
      type(error_t), allocatable :: failure

      call new_method(method, "gear", 1, failure)
      call check(error, allocated(failure), "an unknown method was made")
      if (allocated(error)) return
      call check(error, failure%kind == kind_deck .and. index(failure%message, "rodas5p") > 0, failure%message)
   end subroutine test_unknown

   subroutine test_failures(error)
      type(error_type), allocatable, intent(out) :: error
      type(wall_t) :: problem
      type(options_t) :: options
      integer :: i

      options%tolerance = [1.0e-3_wp]
      options%step = 0.1_wp
      problem%last = 0.5_wp
      do i = 1, size(method_names)
         if (method_facts(i)%companion_order == 0) cycle
         problem%answer = 1
         call expect(problem, options, method_names(i), "at time .500", error)
         if (allocated(error)) return
         problem%answer = -1
         call expect(problem, options, method_names(i), "a state that cannot be evaluated at time", error)
         if (allocated(error)) return
      end do
      problem%answer = 1
      call expect(problem, options, "euler", "fixed step failed at time", error)
      if (allocated(error)) return
      problem%last = -1.0_wp
      call expect(problem, options, "rodas5p", "right-hand side cannot be evaluated at time .000", error)
      if (allocated(error)) return
      problem%last = huge(1.0_wp)
      options%max_steps = 3
      options%max_step = 0.1_wp
      call expect(problem, options, "rodas5p", "steps is reached at time", error)
      if (allocated(error)) return
      options%max_steps = huge(1)
      options%max_evaluations = 3
      call expect(problem, options, "rodas5p", "evaluations is reached at time", error)
   end subroutine test_failures

   !> Integrate and expect words in the message of a convergence error.
   subroutine expect(problem, options, name, words, error)
      class(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      character(len=*), intent(in) :: name, words
      type(error_type), allocatable, intent(inout) :: error

      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)

      state = 1.0_wp
      call new_method(method, name, 1, failure)
      call integrate(problem, method, options, [0.0_wp, 1.0_wp], state, trajectory, counters, failure)
      call check(error, allocated(failure), trim(name)//" saw no failure")
      if (allocated(error)) return
      call check(error, failure%kind == kind_convergence .and. index(failure%message, words) > 0, trim(name)//": "//failure%message)
   end subroutine expect

end module test_ode
