!> Initial value problems: what a problem and a method are, and the loop that drives them.
!>
!> Layer: numerics. In: a problem, a method, a tolerance or step, angles at which a step must end. Out: a trajectory and
!> counters. Methods supply single steps (`ode_explicit`); step-size control, stop times and the loop are here, so that
!> a method is added by adding a file.
!>
!> Status of a rate: 0 fine, positive "this trial state is impossible, try a smaller step", negative "give up".
module camroller_ode
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_point
   implicit none
   private

   public :: problem_t, method_t, options_t, counters_t, integrate

   !> Right-hand side of `d state/d time = rate(time, state)`
   type, abstract :: problem_t
   contains
      procedure(rate_interface), deferred :: get_rate
      procedure(decay_interface), deferred :: get_decay_rate
      procedure(words_interface), deferred :: name_time
   end type problem_t

   !> Work done, comparable between machines
   type :: counters_t
      !> Calls of the right-hand side
      integer :: evaluations = 0
      !> Jacobians formed
      integer :: jacobians = 0
      !> Steps accepted
      integer :: accepted = 0
      !> Steps rejected
      integer :: rejected = 0
   end type counters_t

   !> A way to make one step
   type, abstract :: method_t
      !> Order of the error estimate plus one: the local error grows with the step to this power; 0 for a fixed step
      integer :: error_order = 0
      !> Product of decay rate and step at which the method turns unstable [-]
      real(wp) :: stability_limit = huge(1.0_wp)
   contains
      procedure(step_interface), deferred :: try_step
   end type method_t

   !> How to integrate
   type :: options_t
      !> Error allowed per step, one value per component [state]; methods with an error estimate
      real(wp), allocatable :: tolerance(:)
      !> Step of a method without error estimate, first step of the others [time]
      real(wp) :: step = 0.0_wp
      !> Largest step [time]
      real(wp) :: max_step = huge(1.0_wp)
      !> Steps after which the integration is given up
      integer :: max_steps = 10000000
   end type options_t

   abstract interface
      !> Rate of change of the state
      subroutine rate_interface(self, time, state, rate, status)
         import :: problem_t, wp
         !> The problem; read only
         class(problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> State [state]
         real(wp), intent(in) :: state(:)
         !> Rate of change [state/time]
         real(wp), intent(out) :: rate(:)
         !> 0 fine, positive: try a smaller step, negative: give up
         integer, intent(out) :: status
      end subroutine rate_interface

      !> Fastest decay rate of the problem at a state: size of the largest eigenvalue of the Jacobian
      subroutine decay_interface(self, time, state, decay_rate)
         import :: problem_t, wp
         !> The problem; read only
         class(problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> State [state]
         real(wp), intent(in) :: state(:)
         !> Decay rate, zero where the problem does not know it [1/time]
         real(wp), intent(out) :: decay_rate
      end subroutine decay_interface

      !> A time in the words of messages, e.g. `cam angle 214.5 deg`
      function words_interface(self, time) result(text)
         import :: problem_t, wp
         !> The problem; read only
         class(problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> It in words
         character(len=:), allocatable :: text
      end function words_interface

      !> One step from an accepted point, which it leaves untouched
      subroutine step_interface(self, problem, time, state, rate, step, new_state, new_rate, error_estimate, &
         counters, status)
         import :: method_t, problem_t, counters_t, wp
         !> The method with its work space
         class(method_t), intent(inout) :: self
         !> The problem
         class(problem_t), intent(in) :: problem
         !> Time at the start of the step [time]
         real(wp), intent(in) :: time
         !> State there [state]
         real(wp), intent(in) :: state(:)
         !> Rate there [state/time]
         real(wp), intent(in) :: rate(:)
         !> Size of the step [time]
         real(wp), intent(in) :: step
         !> State at the end [state]
         real(wp), intent(out) :: new_state(:)
         !> Rate at the end [state/time]
         real(wp), intent(out) :: new_rate(:)
         !> Estimate of the error made in this step [state]; zero where the method has none
         real(wp), intent(out) :: error_estimate(:)
         !> Work done so far
         type(counters_t), intent(inout) :: counters
         !> 0 fine, positive: try a smaller step, negative: give up
         integer, intent(out) :: status
      end subroutine step_interface
   end interface

   !> Step-size control: part of the optimal step that is taken, and the exponents of a proportional-integral controller
   !> divided by the order of the error estimate. Source: Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533; values as
   !> usual for explicit methods at their stability limit [-]
   real(wp), parameter :: safety = 0.9_wp, proportional = 0.7_wp, integral = 0.4_wp
   !> Largest growth and shrinkage of a step [-]
   real(wp), parameter :: max_growth = 5.0_wp, max_shrinkage = 0.2_wp
   !> Part of the stability limit that a step may use [-]
   real(wp), parameter :: stability_margin = 0.95_wp

contains

   !> Integrate from the first to the last of the stop times; each of them ends a step, none is stepped over.
   !>
   !> The rate may jump or kink at a stop. Each segment therefore begins and ends a few roundings inside its stops, so
   !> that every evaluation sees the segment's own side; the state is continuous and does not notice.
   subroutine integrate(problem, method, options, stops, state, trajectory, counters, error)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Start, times at which the right-hand side has kinks, end; increasing [time]
      real(wp), intent(in) :: stops(:)
      !> In: state at the start; out: state at the end [state]
      real(wp), intent(inout) :: state(:)
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done, added to what they hold
      type(counters_t), intent(inout) :: counters
      !> Convergence error where a step would vanish or the number of steps is used up
      type(error_t), allocatable, intent(out) :: error

      ! Rate at the present point [state/time]
      real(wp) :: rate(size(state))
      ! Step proposed by the controller, a few roundings, start of the segment [time]
      real(wp) :: step, margin, start
      ! Error of the step before over its tolerance [-]
      real(wp) :: last_error
      integer :: segment, status

      step = options%step
      if (step <= 0.0_wp) step = 1.0e-4_wp*(stops(size(stops)) - stops(1))
      last_error = 1.0_wp
      margin = 4.0_wp*spacing(maxval(abs(stops)))
      call start_trajectory(trajectory, size(state))
      do segment = 1, size(stops) - 1
         if (stops(segment + 1) - stops(segment) <= 64.0_wp*margin) cycle
         start = stops(segment) + margin
         call problem%get_rate(start, state, rate, status)
         counters%evaluations = counters%evaluations + 1
         if (status /= 0) then
            call raise(error, kind_convergence, "the right-hand side has no value at "//problem%name_time(start))
            return
         end if
         call append_point(trajectory, start, state, rate)
         call integrate_segment(problem, method, options, start, stops(segment + 1) - margin, state, rate, step, &
            last_error, &
            & trajectory, counters, error)
         if (allocated(error)) return
      end do
   end subroutine integrate

   !> Integrate from one stop to the next.
   subroutine integrate_segment(problem, method, options, start, finish, state, rate, step, last_error, &
      trajectory, counters, &
      & error)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Start of the segment [time]
      real(wp), intent(in) :: start
      !> End of the segment [time]
      real(wp), intent(in) :: finish
      !> State, from start to end [state]
      real(wp), intent(inout) :: state(:)
      !> Rate, from start to end [state/time]
      real(wp), intent(inout) :: rate(:)
      !> Step proposed by the controller [time]
      real(wp), intent(inout) :: step
      !> Error of the last accepted step over its tolerance [-]
      real(wp), intent(inout) :: last_error
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Time, size of this step [time]
      real(wp) :: time, this_step
      ! Trial state [state], its rate [state/time] and error [state]
      real(wp) :: new_state(size(state)), new_rate(size(state)), estimate(size(state))
      ! Error over tolerance [-]
      real(wp) :: scaled_error
      integer :: status
      logical :: is_last

      time = start
      do
         this_step = limited_step(problem, method, options, time, state, step)
         is_last = time + this_step*(1.0_wp + 1.0e-9_wp) >= finish
         if (is_last) this_step = finish - time
         if (.not. is_last .and. method%error_order > 0) this_step = min(this_step, 0.5_wp*(finish - time))
         call method%try_step(problem, time, state, rate, this_step, new_state, new_rate, estimate, counters, status)
         scaled_error = 0.0_wp
         if (status > 0) scaled_error = 1.0e3_wp
         if (status == 0 .and. method%error_order > 0) scaled_error = maxval(abs(estimate)/options%tolerance)
         if (status < 0 .or. .not. scaled_error < huge(1.0_wp)) then
            call raise(error, kind_convergence, &
               "the integration met a state that cannot be evaluated at "//problem%name_time(time))
            return
         end if

         if (scaled_error <= 1.0_wp) then
            counters%accepted = counters%accepted + 1
            time = time + this_step
            if (is_last) time = finish
            state = new_state
            rate = new_rate
            call append_point(trajectory, time, state, rate)
            if (method%error_order > 0) then
               if (.not. is_last .or. this_step >= step) step = this_step*growth(scaled_error, last_error, &
                  method%error_order)
               last_error = max(scaled_error, 1.0e-4_wp)
            end if
            if (is_last) return
         else
            counters%rejected = counters%rejected + 1
            step = this_step*max(max_shrinkage, safety*scaled_error**(-1.0_wp/max(method%error_order, 1)))
            if (method%error_order == 0) then
               call raise(error, kind_convergence, "a fixed step failed at "//problem%name_time(time))
               return
            end if
         end if
         if (counters%accepted + counters%rejected > options%max_steps) then
            call raise(error, kind_convergence, "the number of steps is used up at "//problem%name_time(time))
            return
         end if
         if (step <= 16.0_wp*spacing(max(abs(start), abs(finish)))) then
            call raise(error, kind_convergence, "the step has become too small at "//problem%name_time(time))
            return
         end if
      end do
   end subroutine integrate_segment

   !> Step that tolerance, largest step and stability allow.
   function limited_step(problem, method, options, time, state, step) result(limited)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Step proposed by the controller [time]
      real(wp), intent(in) :: step
      !> Step to take [time]
      real(wp) :: limited

      ! Fastest decay rate [1/time]
      real(wp) :: decay_rate

      limited = min(step, options%max_step)
      if (method%error_order == 0 .or. method%stability_limit >= huge(1.0_wp)) return
      call problem%get_decay_rate(time, state, decay_rate)
      if (decay_rate*limited > stability_margin*method%stability_limit) then
         limited = stability_margin*method%stability_limit/decay_rate
      end if
   end function limited_step

   !> Growth of the step after an accepted one: proportional-integral control.
   pure function growth(scaled_error, last_error, error_order) result(factor)
      !> Error over tolerance of this step [-]
      real(wp), intent(in) :: scaled_error
      !> Error over tolerance of the step before [-]
      real(wp), intent(in) :: last_error
      !> Power of the step in the local error
      integer, intent(in) :: error_order
      !> New step over this step [-]
      real(wp) :: factor

      factor = safety*max(scaled_error, 1.0e-4_wp)**(-proportional/error_order)*last_error**(integral/error_order)
      factor = min(max_growth, max(max_shrinkage, factor))
   end function growth

end module camroller_ode
