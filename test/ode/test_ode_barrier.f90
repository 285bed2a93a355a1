!> A state that is held at a moving barrier, within a range that no step meets by chance, and is let go again.
module test_ode_barrier
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_ode_problem, only : problem_t, linear_t, words_length
   use camroller_ode_methods, only : new_method
   use camroller_trajectory, only : trajectory_t, interpolate_state
   implicit none
   private

   public :: collect_ode_barrier

   !> Growth of the drive [state/time^2], half of the width of the range [state], slope of the barrier [state/time], its place at
   !> time zero [state]
   real(wp), parameter :: growth = 2.0_wp, narrow = 1.0e-9_wp, slope = 0.5_wp, place = 0.5_wp
   !> Largest resistance that holds the state, and one that does not [state/time]; end of the integration [time]
   real(wp), parameter :: strong = 4.0_wp, weak = 1.0_wp, finish = 3.0_wp
   !> Part of the resistance that the rate may be wrong by while the state is held [-]
   real(wp), parameter :: resolution = 1.0e-4_wp
   !> State at the end [state]: with the strong resistance it is let go at t = 9/4
   real(wp), parameter :: held = 5.5625_wp, free = 9.0_wp

   !> `dy/dt = growth t - resistance max(0, 1 - |y - b|/narrow)` with the barrier `b = place + slope t`, from y = 0: y = t^2 up to
   !> the barrier, which it meets at t = 1; there it stays as long as `growth t < resistance + slope`
   type, extends(problem_t) :: latch_t
      !> Largest resistance [state/time]
      real(wp) :: resistance = strong
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: linearise
      procedure :: name_time
   end type latch_t

contains

   subroutine collect_ode_barrier(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [ &
         new_unittest("a barrier within a range that no step meets holds a state and lets it go", test_held), &
         new_unittest("a barrier that does not hold costs little", test_free), &
         new_unittest("a method whose steps cannot hold a state says so", test_explicit) &
         ]
   end subroutine collect_ode_barrier

   subroutine test_held(error)
      type(error_type), allocatable, intent(out) :: error

      call try_methods(strong, held, 2.125_wp*slope + place, 1000, error)
   end subroutine test_held

   subroutine test_free(error)
      type(error_type), allocatable, intent(out) :: error

      call try_methods(weak, free, 2.125_wp**2, 150, error)
   end subroutine test_free

   !> Every method with derivatives finds the state at the end and at t = 2.125, with no more steps than are given.
   subroutine try_methods(resistance, wanted, between, most_steps, error)
      ! Resistance [state/time], state at the end and between [state]
      real(wp), intent(in) :: resistance, wanted, between
      integer, intent(in) :: most_steps
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=8) :: "hermite", "rodas5p", "radau5"]
      ! Error of a step [state]
      real(wp), parameter :: tolerance = 1.0e-6_wp
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      ! State at the end and between [state], error of the rate [state/time]
      real(wp) :: state, middle, wrong
      character(len=120) :: buffer
      integer :: i

      do i = 1, size(names)
         call follow_latch(trim(names(i)), resistance, tolerance, state, middle, counters, failure)
         if (allocated(failure)) then
            call test_failed(error, trim(names(i))//": "//failure%message)
            return
         end if
         ! Errors add up over the steps; an error of the rate at either end of a step lets the state go early or late, with a jump
         wrong = 2.0_wp*resolution*(resistance + 2.0_wp*slope)
         if (abs(state - wanted) <= tolerance*counters%accepted + resistance*wrong/growth .and. &
            & abs(middle - between) <= tolerance*counters%accepted .and. counters%accepted &
            & + counters%rejected <= most_steps) cycle
         write (buffer, "(2a, 2es10.2, 2i7)") trim(names(i)), ": errors at the end and between, steps", state - wanted, &
            & middle - between, counters%accepted, counters%rejected
         call test_failed(error, trim(buffer))
         return
      end do
   end subroutine try_methods

   subroutine test_explicit(error)
      type(error_type), allocatable, intent(out) :: error
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      ! State at the end and between [state]
      real(wp) :: state, middle

      call follow_latch("dormand_prince", strong, 1.0e-6_wp, state, middle, counters, failure)
      if (.not. allocated(failure)) then
         call test_failed(error, "dormand_prince says nothing")
      else if (index(failure%message, "steps is reached at time") == 0) then
         call test_failed(error, failure%message)
      end if
   end subroutine test_explicit

   !> Integrate with a method.
   subroutine follow_latch(name, resistance, tolerance, state, middle, counters, failure)
      character(len=*), intent(in) :: name
      ! Resistance [state/time], error of a step [state]
      real(wp), intent(in) :: resistance, tolerance
      ! State at the end and at t = 2.125 [state]
      real(wp), intent(out) :: state, middle
      type(counters_t), intent(out) :: counters
      type(error_t), allocatable, intent(out) :: failure
      type(latch_t) :: problem
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(trajectory_t) :: trajectory
      ! States [state]
      real(wp) :: last(1), inside(1)
      integer :: hint

      problem%resistance = resistance
      problem%barrier = place
      problem%barrier_slope = slope
      options%tolerance = [tolerance]
      options%step = 0.01_wp
      options%max_steps = 2000
      state = 0.0_wp
      middle = 0.0_wp
      last = 0.0_wp
      call new_method(method, name, 1, failure)
      if (.not. allocated(failure)) call integrate(problem, method, options, [0.0_wp, finish], last, trajectory, counters, failure)
      if (allocated(failure)) return
      state = last(1)
      hint = 1
      call interpolate_state(trajectory, 2.125_wp, hint, inside)
      middle = inside(1)
   end subroutine follow_latch

   subroutine get_rate(self, time, state, rate, status)
      class(latch_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status
      ! [state]
      real(wp) :: clearance

      call self%get_clearance(time, state, clearance)
      rate = growth*time - self%resistance*max(0.0_wp, 1.0_wp - abs(clearance)/narrow)
      status = 0
   end subroutine get_rate

   subroutine get_decay_rate(self, time, state, decay_rate)
      class(latch_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate
      ! [state]
      real(wp) :: clearance

      call self%get_clearance(time, state, clearance)
      decay_rate = merge(self%resistance/narrow, 0.0_wp, abs(clearance) < narrow)
   end subroutine get_decay_rate

   subroutine linearise(self, time, state, horizon, linear, counters, status)
      class(latch_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(in) :: horizon
      type(linear_t), intent(inout) :: linear
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_horizon => horizon)
      end associate
      counters%evaluations = counters%evaluations + 1
      call self%get_rate(time, state, linear%rate, status)
      call self%get_clearance(time, state, linear%clearance)
      linear%jacobian = 0.0_wp
      if (abs(linear%clearance) < narrow) linear%jacobian = -sign(self%resistance/narrow, linear%clearance)
      linear%time_slope = growth - slope*linear%jacobian(1, 1)
      linear%span = self%resistance
      linear%resolution = resolution
   end subroutine linearise

   function name_time(self, time) result(text)
      class(latch_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text

      associate (unused_self => self)
      end associate
      write (text, "(a, f0.3)") "time ", time
   end function name_time

end module test_ode_barrier
