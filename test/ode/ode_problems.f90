!> Initial value problems with known solutions, for the tests of the integration methods.
module ode_problems
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, counters_t, words_length
   implicit none
   private

   public :: known_t, cosine, line, bent, work, power, pair, switch_t, wall_t, stable_methods

   !> Methods that are stable for every decay rate, whatever the step
   character(len=*), parameter :: stable_methods(*) = [character(len=7) :: "rodas5p", "radau5", "hermite"]

   !> Prothero and Robinson (1974): y' = -decay (y - cos t) - sin t, y = cos t
   integer, parameter :: cosine = 1
   !> y' = -decay (y - t) + 1, y = t + y(0) exp(-decay t)
   integer, parameter :: line = 2
   !> y' = -decay sin y, tan(y/2) = tan(y(0)/2) exp(-decay t)
   integer, parameter :: bent = 3
   !> Prothero and Robinson's problem with an integral beside it: y1' as in `cosine`, y2' = y1**2
   integer, parameter :: work = 4
   !> y' = degree t**(degree - 1)
   integer, parameter :: power = 5
   !> y1' = y1**2/y2 cos t, y2' = y2 cos t: y1 = y2 = exp(sin t), with every derivative in play; alone y' = y**2 exp(-sin t) cos t
   integer, parameter :: pair = 6

   !> Calls that a problem has seen
   type, abstract, extends(problem_t) :: counted_t
      integer, pointer :: calls => null()
   contains
      procedure :: count_call
      procedure :: get_decay_rate => no_decay
      procedure :: name_time
   end type counted_t

   !> One of those above, with its Jacobian
   type, extends(counted_t) :: known_t
      integer :: kind = cosine
      real(wp) :: decay = 1.0_wp
      integer :: degree = 1
      !> By this factor the Jacobian is wrong
      real(wp) :: factor = 1.0_wp
   contains
      procedure :: get_rate => known_rate
      procedure :: get_decay_rate => known_decay
      procedure :: get_jacobian => known_jacobian
   end type known_t

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

   subroutine known_rate(self, time, state, rate, status)
      class(known_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: rate(:)
      integer, intent(out) :: status

      call self%count_call()
      select case (self%kind)
      case (cosine)
         rate = -self%decay*(state - cos(time)) - sin(time)
      case (line)
         rate = -self%decay*(state - time) + 1.0_wp
      case (bent)
         rate = -self%decay*sin(state)
      case (work)
         rate = [-self%decay*(state(1) - cos(time)) - sin(time), state(1)**2]
      case (power)
         rate = self%degree*time**(self%degree - 1)
      case (pair)
         if (size(state) == 1) then
            rate = state**2*exp(-sin(time))*cos(time)
         else
            rate = [state(1)**2/state(2), state(2)]*cos(time)
         end if
      end select
      status = 0
   end subroutine known_rate

   subroutine known_decay(self, time, state, decay_rate)
      class(known_t), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(in) :: state(:)
      real(wp), intent(out) :: decay_rate

      associate (unused_state => state)
      end associate
      decay_rate = self%decay
      if (self%kind == power) decay_rate = 0.0_wp
      if (self%kind == pair) decay_rate = 2.0_wp*abs(cos(time))
   end subroutine known_decay

   subroutine known_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      class(known_t), intent(in) :: self
      real(wp), intent(in) :: time, state(:), rate(:), horizon
      real(wp), intent(out) :: jacobian(:, :), time_slope(:)
      type(counters_t), intent(inout) :: counters
      integer, intent(out) :: status

      integer :: i

      associate (unused_rate => rate, unused_horizon => horizon)
      end associate
      jacobian = 0.0_wp
      time_slope = 0.0_wp
      select case (self%kind)
      case (cosine)
         do i = 1, size(state)
            jacobian(i, i) = -self%decay
         end do
         time_slope = -self%decay*sin(time) - cos(time)
      case (line)
         jacobian = -self%decay
         time_slope = self%decay
      case (bent)
         jacobian = -self%decay*cos(state(1))
      case (work)
         jacobian(:, 1) = [-self%decay, 2.0_wp*state(1)]
         time_slope(1) = -self%decay*sin(time) - cos(time)
      case (power)
         if (self%degree > 1) time_slope = self%degree*(self%degree - 1)*time**(self%degree - 2)
      case (pair)
         if (size(state) == 1) then
            jacobian = 2.0_wp*state(1)*exp(-sin(time))*cos(time)
            time_slope = -state**2*exp(-sin(time))*(cos(time)**2 + sin(time))
         else
            jacobian(:, 1) = [2.0_wp*state(1)/state(2), 0.0_wp]*cos(time)
            jacobian(:, 2) = [-(state(1)/state(2))**2, 1.0_wp]*cos(time)
            time_slope = -[state(1)**2/state(2), state(2)]*sin(time)
         end if
      end select
      jacobian = self%factor*jacobian
      counters%jacobians = counters%jacobians + 1
      status = 0
   end subroutine known_jacobian

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
