!> What is peculiar to single methods: functions of the Jacobian, integrals beside the unknown, iterations with a rough Jacobian.
module test_ode_special
   use testdrive, only : unittest_type, new_unittest, error_type, check
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, kind_domain
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_ode_problem, only : problem_t
   use camroller_ode_methods, only : new_method
   use camroller_phi, only : phi_functions
   use camroller_trajectory, only : trajectory_t, interpolate_state
   use ode_problems, only : known_t, line, bent, pair, work
   implicit none
   private

   public :: collect_ode_special

contains

   subroutine collect_ode_special(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("hermite: functions at known arguments, and no seam between series and recurrence", test_functions), &
         new_unittest("hermite: order 6 once the first step is short", test_hermite_order), &
         new_unittest("hermite: linear problems are solved exactly, the layer between the points included", test_hermite_linear), &
         new_unittest("hermite: one evaluation a step", test_hermite_cost), &
         new_unittest("hermite: far from the slow motion a long first step is not tried in vain", test_hermite_start), &
         new_unittest("hermite: an integral beside the unknown, at its end and between the points", test_hermite_integral), &
         new_unittest("hermite: more than one unknown is refused", test_refusal), &
         new_unittest("radau5: a rough Jacobian costs iterations, not accuracy", test_rough), &
         new_unittest("radau5: without convergence the step becomes smaller", test_no_convergence) &
         ]
   end subroutine collect_ode_special

   !> Integrate with steps of one size and count.
   subroutine integrate_evenly(problem, name, step, finish, state, trajectory, counters, failure)
      class(problem_t), intent(in) :: problem
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: step, finish
      real(wp), intent(inout) :: state(:)
      type(trajectory_t), intent(inout) :: trajectory
      type(counters_t), intent(out) :: counters
      type(error_t), allocatable, intent(out) :: failure

      class(method_t), allocatable :: method
      type(options_t) :: options

      call new_method(method, name, size(state), failure)
      if (allocated(failure)) return
      options%tolerance = spread(1.0e-9_wp, 1, size(state))
      options%step = step
      options%is_fixed = .true.
      call integrate(problem, method, options, [0.0_wp, finish], state, trajectory, counters, failure)
   end subroutine integrate_evenly

   subroutine test_functions(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: phi(3), other(3)
      integer :: i

      phi = phi_functions(3, 0.0_wp)
      call check(error, all(abs(phi - [1.0_wp, 0.5_wp, 1.0_wp/6.0_wp]) < epsilon(1.0_wp)), "at zero")
      if (allocated(error)) return
      phi = phi_functions(3, -1.0_wp) - [1.0_wp - exp(-1.0_wp), exp(-1.0_wp), 0.5_wp - exp(-1.0_wp)]
      call check(error, all(abs(phi) < 4.0_wp*epsilon(1.0_wp)), "at -1")
      if (allocated(error)) return
      ! limits: -1/z, -1/z - 1/z^2, -1/(2 z) - 1/z^2 - 1/z^3
      phi = phi_functions(3, -1.0e5_wp) - [1.0e-5_wp, 1.0e-5_wp - 1.0e-10_wp, 0.5e-5_wp - 1.0e-10_wp + 1.0e-15_wp]
      call check(error, all(abs(phi) < 4.0e-5_wp*epsilon(1.0_wp)), "at -100000")
      if (allocated(error)) return
      do i = -1, 1, 2
         phi = phi_functions(3, real(i, wp))
         other = phi_functions(3, i*(1.0_wp - epsilon(1.0_wp)))
         ! the recurrence loses a figure of differences at arguments of one
         call check(error, all(abs(phi - other) < 10.0_wp*epsilon(1.0_wp)), "seam")
         if (allocated(error)) return
      end do
   end subroutine test_functions

   !> Integrate with steps that grow up to a largest one, whatever their error.
   subroutine integrate_growing(problem, name, largest, finish, state, trajectory, counters, failure)
      class(problem_t), intent(in) :: problem
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: largest, finish
      real(wp), intent(inout) :: state(:)
      type(trajectory_t), intent(inout) :: trajectory
      type(counters_t), intent(out) :: counters
      type(error_t), allocatable, intent(out) :: failure

      class(method_t), allocatable :: method
      type(options_t) :: options

      call new_method(method, name, size(state), failure, size(state) - 1)
      if (allocated(failure)) return
      options%tolerance = spread(1.0e3_wp, 1, size(state))
      options%step = 1.0e-3_wp*largest
      options%max_step = largest
      call integrate(problem, method, options, [0.0_wp, finish], state, trajectory, counters, failure)
   end subroutine integrate_growing

   subroutine test_hermite_order(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1), errors(2)
      integer :: k

      problem%kind = pair
      do k = 1, 2
         state = 1.0_wp
         call integrate_growing(problem, "hermite", 0.05_wp/2**(k - 1), 4.0_wp, state, trajectory, counters, failure)
         call check(error, .not. allocated(failure), "fails")
         if (allocated(error)) return
         errors(k) = maxval(abs(trajectory%state(1, :trajectory%count) - exp(sin(trajectory%time(:trajectory%count)))))
      end do
      ! 64, and more or less by the next order: the relative step, times a factor of a few
      call check(error, abs(errors(1)/errors(2) - 64.0_wp) < 0.25_wp*64.0_wp, "another order")
   end subroutine test_hermite_order

   subroutine test_hermite_linear(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1), time, allowed
      integer :: k, n, hint

      problem%kind = line
      do k = -1, 5
         problem%decay = 10.0_wp**k
         state = 1.0_wp
         call integrate_evenly(problem, "hermite", 0.5_wp, 1.0_wp, state, trajectory, counters, failure)
         call check(error, .not. allocated(failure), "fails")
         if (allocated(error)) return
         hint = 1
         do n = 0, 20
            time = 0.05_wp*n
            call interpolate_state(trajectory, time, hint, state)
            ! sums of terms of the size of rate times step, with coefficients up to 50; layers with exponents up to two are a
            ! polynomial of degree 5, which errs by z**6/6! times a product of distances below 4e-3; layers below a thousandth of
            ! the tolerance, 1e-9, are left out
            allowed = 100.0_wp*max(problem%decay, 1.0_wp)*epsilon(1.0_wp) + 1.0e-12_wp
            if (k < 1) allowed = allowed + (0.5_wp*problem%decay)**6*4.0e-3_wp/720.0_wp
            call check(error, abs(state(1) - time - exp(-problem%decay*time)) < allowed, "curve")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_hermite_linear

   subroutine test_hermite_cost(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)

      problem%decay = 100.0_wp
      state = 2.0_wp
      call integrate_evenly(problem, "hermite", 0.1_wp, 10.0_wp, state, trajectory, counters, failure)
      call check(error, .not. allocated(failure) .and. counters%evaluations == counters%accepted + 1 .and. &
         & counters%jacobians == counters%evaluations)
   end subroutine test_hermite_cost

   subroutine test_hermite_start(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp), parameter :: tolerance = 1.0e-6_wp
      real(wp) :: state(1), exact

      problem%kind = bent
      problem%decay = 1000.0_wp
      call new_method(method, "hermite", 1, failure)
      options%tolerance = [tolerance]
      options%step = 0.02_wp
      options%fewest_steps = 1
      state = 1.0_wp
      call integrate(problem, method, options, [0.0_wp, 0.02_wp], state, trajectory, counters, failure)
      exact = 2.0_wp*atan(tan(0.5_wp)*exp(-20.0_wp))
      ! A first step of twenty decay lengths is rejected four times until it is short enough
      call check(error, .not. allocated(failure) .and. counters%rejected <= 2 .and. abs(state(1) - exact) < 10.0_wp*tolerance)
   end subroutine test_hermite_start

   subroutine test_hermite_integral(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(2), time, errors(2)
      integer :: i, k, n, hint

      problem%kind = work
      do i = 0, 4
         problem%decay = 10.0_wp**i
         do k = 1, 2
            state = [1.0_wp, 0.0_wp]
            call integrate_growing(problem, "hermite", 0.1_wp/2**(k - 1), 4.0_wp, state, trajectory, counters, failure)
            call check(error, .not. allocated(failure), "fails")
            if (allocated(error)) return
            errors(k) = 0.0_wp
            hint = 1
            do n = 1, 400
               time = 0.01_wp*n - 1.0e-3_wp
               call interpolate_state(trajectory, time, hint, state)
               errors(k) = max(errors(k), abs(state(2) - 0.5_wp*time - 0.25_wp*sin(2.0_wp*time)))
            end do
         end do
         ! the curve is a quartic: the fifth power of the step over 5! with distances below 1/100 and derivatives up to 16,
         ! times 100 where the decay is of the order of the step
         call check(error, errors(1) < 1.0e-6_wp .and. errors(2) < errors(1)/8.0_wp, "integral")
         if (allocated(error)) return
      end do
   end subroutine test_hermite_integral

   subroutine test_refusal(error)
      type(error_type), allocatable, intent(out) :: error
      class(method_t), allocatable :: method
      type(error_t), allocatable :: failure

      call new_method(method, "hermite", 2, failure)
      call check(error, allocated(failure), "two unknowns accepted")
      if (allocated(error)) return
      call check(error, failure%kind == kind_domain .and. index(failure%message, "hermite") > 0, failure%message)
   end subroutine test_refusal

   subroutine test_rough(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      type(trajectory_t) :: trajectory
      type(counters_t) :: good, rough
      type(error_t), allocatable :: failure
      real(wp) :: state(1), reference

      problem%decay = 1.0e3_wp
      problem%factor = 1.0_wp
      state = 1.0_wp
      call integrate_evenly(problem, "radau5", 0.05_wp, 1.0_wp, state, trajectory, good, failure)
      reference = state(1)
      problem%factor = 1.2_wp
      state = 1.0_wp
      call integrate_evenly(problem, "radau5", 0.05_wp, 1.0_wp, state, trajectory, rough, failure)
      call check(error, .not. allocated(failure), "fails")
      if (allocated(error)) return
      ! the tolerance of the iteration is a part of this
      call check(error, abs(state(1) - reference) < 1.0e-9_wp, "another result")
      if (allocated(error)) return
      call check(error, rough%evaluations > good%evaluations, "the test cannot fail")
   end subroutine test_rough

   subroutine test_no_convergence(error)
      type(error_type), allocatable, intent(out) :: error
      type(known_t) :: problem
      class(method_t), allocatable :: method
      type(trajectory_t) :: trajectory
      type(options_t) :: options
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      real(wp) :: state(1)

      problem%decay = 100.0_wp
      problem%factor = -1.0_wp
      call new_method(method, "radau5", 1, failure)
      options%tolerance = [1.0e-6_wp]
      options%step = 0.5_wp
      state = 1.0_wp
      call integrate(problem, method, options, [0.0_wp, 1.0_wp], state, trajectory, counters, failure)
      call check(error, .not. allocated(failure) .and. counters%rejected > 0, "no step rejected")
      if (allocated(error)) return
      call check(error, abs(state(1) - cos(1.0_wp)) < 1.0e-5_wp, "wrong end")
   end subroutine test_no_convergence

end module test_ode_special
