!> Initial value problems with known solutions, for the tests of the integration methods.
module ode_problems
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, counters_t, words_length
   implicit none
   private

   public :: decay_t, rough_t, line_t, bent_t, work_t, power_t, pair_t, switch_t, wall_t, stable_methods

   !> Methods that are stable for every decay rate, whatever the step
   character(len=*), parameter :: stable_methods(*) = [character(len=7) :: "rodas5p", "radau5", "hermite"]

   !> Calls that a problem has seen
   type, abstract, extends(problem_t) :: counted_t
      integer, pointer :: calls => null()
   contains
      procedure :: count_call
      procedure :: get_decay_rate => no_decay
      procedure :: name_time
   end type counted_t

   !> Prothero and Robinson (1974): y' = -decay (y - cos t) - sin t, y = cos t
   type, extends(counted_t) :: decay_t
      real(wp) :: decay = 1.0_wp
   contains
      procedure :: get_rate => decay_rate_of_change
      procedure :: get_decay_rate => given_decay
      procedure :: get_jacobian => decay_jacobian
   end type decay_t

   !> The same with a Jacobian that is wrong by a factor
   type, extends(decay_t) :: rough_t
      real(wp) :: factor = 1.0_wp
   contains
      procedure :: get_jacobian => rough_jacobian
   end type rough_t

   !> y' = -decay (y - t) + 1, y = t + y(0) exp(-decay t)
   type, extends(decay_t) :: line_t
   contains
      procedure :: get_rate => line_rate_of_change
      procedure :: get_jacobian => line_jacobian
   end type line_t

   !> y' = -decay sin y, tan(y/2) = tan(y(0)/2) exp(-decay t)
   type, extends(decay_t) :: bent_t
   contains
      procedure :: get_rate => bent_rate_of_change
      procedure :: get_jacobian => bent_jacobian
   end type bent_t

   !> Prothero and Robinson's problem with an integral beside it: y1' as in `decay_t`, y2' = y1**2
   type, extends(decay_t) :: work_t
   contains
      procedure :: get_rate => work_rate_of_change
      procedure :: get_jacobian => work_jacobian
   end type work_t

   !> y' = power t**(power - 1)
   type, extends(counted_t) :: power_t
      integer :: power = 1
   contains
      procedure :: get_rate => power_rate_of_change
      procedure :: get_jacobian => power_jacobian
   end type power_t

   !> y1' = y1**2/y2 cos t, y2' = y2 cos t: y1 = y2 = exp(sin t), with every derivative in play; alone y' = y**2 exp(-sin t) cos t
   type, extends(counted_t) :: pair_t
   contains
      procedure :: get_rate => pair_rate_of_change
      procedure :: get_decay_rate => unit_decay
      procedure :: get_jacobian => pair_jacobian
   end type pair_t

   !> y' = slopes(1) before the switch, slopes(2) after it
   type, extends(counted_t) :: switch_t
      real(wp) :: switch = 0.0_wp, slopes(2) = 0.0_wp
   contains
      procedure :: get_rate => switch_rate_of_change
   end type switch_t

   !> y' = -decay y, where no state below `lowest` and no time after `last` can be evaluated
   type, extends(counted_t) :: wall_t
      real(wp) :: decay = 1.0_wp, lowest = -huge(1.0_wp), last = huge(1.0_wp)
      integer :: answer = 1
   contains
      procedure :: get_rate => wall_rate_of_change
   end type wall_t

contains

   subroutine count_call(self)
      class(counted_t), intent(in) :: self

      if (associated(self%calls)) self%calls = self%calls + 1
   end subroutine count_call

   subroutine no_decay(self, time, state, decay_rate)
      class(counted_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      associate (unused_self => self, unused_time => time, unused_state => state)
      end associate
      decay_rate = 0.0_wp
   end subroutine no_decay

   subroutine unit_decay(self, time, state, decay_rate)
      class(pair_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      associate (unused_self => self, unused_state => state)
      end associate
      decay_rate = 2.0_wp*abs(cos(time))
   end subroutine unit_decay

   subroutine given_decay(self, time, state, decay_rate)
      class(decay_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      associate (unused_time => time, unused_state => state)
      end associate
      decay_rate = self%decay
   end subroutine given_decay

   function name_time(self, time) result(text)
      class(counted_t), intent(in) :: self
      real(wp), intent(in) :: time
      character(len=words_length) :: text

      character(len=16) :: buffer

      associate (unused_self => self)
      end associate
      write (buffer, "(f0.3)") time
      text = "time "//trim(buffer)
   end function name_time

   subroutine decay_rate_of_change(self, time, state, rate, status)
      class(decay_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      rate = -self%decay*(state - cos(time)) - sin(time)
      status = 0
   end subroutine decay_rate_of_change

   subroutine decay_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(decay_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      integer :: i

      associate (unused_state => state, unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = 0.0_wp
      do i = 1, size(state)
         jacobian(i, i) = -self%decay
      end do
      time_slope = -self%decay*sin(time) - cos(time)
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine decay_jacobian

   subroutine rough_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(rough_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      call decay_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      jacobian = self%factor*jacobian
   end subroutine rough_jacobian

   subroutine work_rate_of_change(self, time, state, rate, status)
      class(work_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      rate = [-self%decay*(state(1) - cos(time)) - sin(time), state(1)**2]
      status = 0
   end subroutine work_rate_of_change

   subroutine work_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(work_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = 0.0_wp
      jacobian(:, 1) = [-self%decay, 2.0_wp*state(1)]
      time_slope = [-self%decay*sin(time) - cos(time), 0.0_wp]
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine work_jacobian

   subroutine line_rate_of_change(self, time, state, rate, status)
      class(line_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      rate = -self%decay*(state - time) + 1.0_wp
      status = 0
   end subroutine line_rate_of_change

   subroutine line_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(line_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_time => time, unused_state => state, unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = -self%decay
      time_slope = self%decay
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine line_jacobian

   subroutine bent_rate_of_change(self, time, state, rate, status)
      class(bent_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      associate (unused_time => time)
      end associate
      call self%count_call()
      rate = -self%decay*sin(state)
      status = 0
   end subroutine bent_rate_of_change

   subroutine bent_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(bent_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_time => time, unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = -self%decay*cos(state(1))
      time_slope = 0.0_wp
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine bent_jacobian

   subroutine power_rate_of_change(self, time, state, rate, status)
      class(power_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      associate (unused_state => state)
      end associate
      call self%count_call()
      rate = self%power*time**(self%power - 1)
      status = 0
   end subroutine power_rate_of_change

   subroutine power_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(power_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_state => state, unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = 0.0_wp
      time_slope = 0.0_wp
      if (self%power > 1) time_slope = self%power*(self%power - 1)*time**(self%power - 2)
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine power_jacobian

   subroutine pair_rate_of_change(self, time, state, rate, status)
      class(pair_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      if (size(state) == 1) then
         rate = state**2*exp(-sin(time))*cos(time)
      else
         rate = [state(1)**2/state(2), state(2)]*cos(time)
      end if
      status = 0
   end subroutine pair_rate_of_change

   subroutine pair_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(pair_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      associate (unused_self => self, unused_rate => rate, unused_horizon => horizon)
      end associate
      if (size(state) == 1) then
         jacobian = 2.0_wp*state(1)*exp(-sin(time))*cos(time)
         time_slope = -state**2*exp(-sin(time))*(cos(time)**2 + sin(time))
      else
         jacobian(:, 1) = [2.0_wp*state(1)/state(2), 0.0_wp]*cos(time)
         jacobian(:, 2) = [-(state(1)/state(2))**2, 1.0_wp]*cos(time)
         time_slope = -[state(1)**2/state(2), state(2)]*sin(time)
      end if
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine pair_jacobian

   subroutine switch_rate_of_change(self, time, state, rate, status)
      class(switch_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      associate (unused_state => state)
      end associate
      call self%count_call()
      rate = merge(self%slopes(1), self%slopes(2), time < self%switch)
      status = 0
   end subroutine switch_rate_of_change

   subroutine wall_rate_of_change(self, time, state, rate, status)
      class(wall_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      rate = -self%decay*state
      status = merge(self%answer, 0, any(state < self%lowest) .or. time > self%last)
   end subroutine wall_rate_of_change

end module ode_problems
