!> A block that friction stops and lets go again, with friction spread over a speed that no step resolves.
module test_ode_bridge
   use testdrive, only : unittest_type, new_unittest, error_type, test_failed
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_ode, only : method_t, options_t, counters_t, integrate
   use camroller_ode_problem, only : problem_t, linear_t, words_length
   use camroller_ode_methods, only : new_method
   use camroller_trajectory, only : trajectory_t, interpolate_state
   implicit none
   private

   public :: collect_ode_bridge

   !> Largest friction, growth of the drive [state/time, state/time^2], speed over which friction reverses [state]
   real(wp), parameter :: limit = 10.0_wp, growth = 20.0_wp, narrow = 1.0e-30_wp

   !> `d v/dt = growth t - limit clip(v/narrow)`, from v = 1: it stops at t = (5 - sqrt(15))/10, is let go at t = 1/2 and then is
   !> `10 (t - 1/2)^2`
   type, extends(problem_t) :: block_t
   contains
      procedure :: get_rate
      procedure :: get_decay_rate
      procedure :: linearise
      procedure :: name_time
   end type block_t

contains

   subroutine collect_ode_bridge(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("friction within a range that no step resolves stops a block and lets it go", test_block)]
   end subroutine collect_ode_bridge

   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), parameter :: names(*) = [character(len=8) :: "hermite", "rodas5p", "radau5"]
      ! Error of a step [state]; steps that are more than enough
      real(wp), parameter :: tolerance = 1.0e-6_wp
      integer, parameter :: many = 2000
      type(block_t) :: problem
      class(method_t), allocatable :: method
      type(options_t) :: options
      type(trajectory_t) :: trajectory
      type(counters_t) :: counters
      type(error_t), allocatable :: failure
      ! State at the end, at rest [state]
      real(wp) :: state(1), rest(1)
      character(len=120) :: buffer
      integer :: i, hint

      options%tolerance = [tolerance]
      options%step = 0.01_wp
      do i = 1, size(names)
         call new_method(method, trim(names(i)), 1, failure)
         if (.not. method%needs_jacobian) cycle
         state = 1.0_wp
         counters = counters_t()
         call integrate(problem, method, options, [0.0_wp, 1.0_wp], state, trajectory, counters, failure)
         if (allocated(failure)) then
            call test_failed(error, trim(names(i))//": "//failure%message)
            return
         end if
         hint = 1
         call interpolate_state(trajectory, 0.3_wp, hint, rest)
         ! Friction is exact to its own size at rest; errors add up over the steps, and where the block is let go they grow
         if (abs(state(1) - 2.5_wp) <= tolerance*counters%accepted .and. abs(rest(1)) <= narrow &
            & .and. counters%accepted < many) cycle
         write (buffer, "(2a, 2es10.2, i7)") trim(names(i)), ": error, state at rest, steps", state(1) - 2.5_wp, rest(1), &
               & counters%accepted
         call test_failed(error, trim(buffer))
         return
      end do
   end subroutine test_block

   subroutine get_rate(self, time, state, rate, status)
      class(block_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      associate (unused_self => self)
      end associate
      rate = growth*time - limit*max(-1.0_wp, min(1.0_wp, state/narrow))
      status = 0
   end subroutine get_rate

   subroutine get_decay_rate(self, time, state, decay_rate)
      class(block_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      associate (unused_self => self, unused_time => time)
      end associate
      decay_rate = merge(limit/narrow, 0.0_wp, abs(state(1)) < narrow)
   end subroutine get_decay_rate

   subroutine linearise(self, time, state, horizon, linear, counters, status)
      class(block_t), intent(in) :: self
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
      linear%jacobian(1, 1) = merge(-limit/narrow, 0.0_wp, abs(state(1)) < narrow)
      linear%time_slope = growth
      linear%span = limit
      linear%resolution = 0.01_wp
   end subroutine linearise

   function name_time(self, time) result(text)
      class(block_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text

      associate (unused_self => self)
      end associate
      write (text, "(a, f0.3)") "time ", time
   end function name_time

end module test_ode_bridge
