!> Initial value problems: the integration loop, common to all methods.
!>
!> In: a problem (`ode_problem`), a method (`ode_method`), a tolerance or step, times at which a step must end. Out: a trajectory
!> and counters. A method supplies single steps; step-size control, stop times and the loop are here, so a new method takes one
!> file and one line in `ode_methods`.
!>
!> Status of a step: 0 accepted; positive "the trial state is not admissible, try a smaller step"; negative "the problem cannot
!> be evaluated, end".
module camroller_ode
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_ode_problem, only : problem_t, counters_t, new_linear, copy_linear
   use camroller_ode_method, only : method_t, options_t
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_point, append_curve
   use camroller_step_checks, only : check_step
   use camroller_ode_bridge, only : footing_t, bridge_t, watch, is_stuck, try_bridge, note_bridge
   implicit none
   private

   public :: problem_t, counters_t, method_t, options_t, integrate

   !> Step-size control: part of the optimal step that is taken [-]
   real(wp), parameter :: safety = 0.9_wp
   !> Largest growth and shrinkage of a step [-]
   real(wp), parameter :: max_growth = 5.0_wp, max_shrinkage = 0.2_wp
   !> Error over tolerance below which smaller ones make no difference [-]
   real(wp), parameter :: least_error = 1.0e-4_wp
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
      !> Convergence error where a step would vanish or the number of steps or evaluations is used up
      type(error_t), allocatable, intent(out) :: error

      ! Rate at the present point [state/time]
      real(wp) :: rate(size(state))
      ! Step proposed by the controller, a few roundings, start and end of the segment [time]
      real(wp) :: step, margin, start, finish
      ! Error of the step before over its tolerance [-]
      real(wp) :: last_error
      type(options_t) :: limits
      integer :: segment, segments, status

      limits = options
      step = options%step
      if (step <= 0.0_wp) step = 1.0e-4_wp*(stops(size(stops)) - stops(1))
      last_error = 1.0_wp
      margin = 4.0_wp*spacing(maxval(abs(stops)))
      segments = count(stops(2:) - stops(:size(stops) - 1) > 64.0_wp*margin)
      if (allocated(options%tolerance)) method%tolerance = options%tolerance
      call start_trajectory(trajectory, size(state))
      if (method%needs_jacobian) then
         call new_linear(method%here, size(state))
         call new_linear(method%there, size(state))
      end if
      do segment = 1, size(stops) - 1
         if (stops(segment + 1) - stops(segment) <= 64.0_wp*margin) cycle
         start = stops(segment) + margin
         finish = stops(segment + 1) - margin
         call rate_here(problem, method, start, state, finish, rate, counters, status)
         if (status /= 0) then
            call raise(error, kind_convergence, "the right-hand side cannot be evaluated at "//trim(problem%name_time(start)))
            return
         end if
         call append_point(trajectory, start, state, rate)
         if (.not. is_fixed(method, options)) then
            limits%max_step = min(options%max_step, (finish - start)/max(1, options%fewest_steps/segments))
         end if
         call integrate_segment(problem, method, limits, start, finish, state, rate, step, last_error, trajectory, &
            & counters, error)
         if (allocated(error)) return
      end do
   end subroutine integrate

   !> Rate where a segment begins, with its derivatives where the method needs them.
   subroutine rate_here(problem, method, time, state, horizon, rate, counters, status)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> End of the segment [time]
      real(wp), intent(in) :: horizon
      !> Rate [state/time]
      real(wp), intent(out) :: rate(:)
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      if (method%needs_jacobian) then
         call problem%linearise(time, state, horizon, method%here, counters, status)
         rate = method%here%rate
      else
         call problem%get_rate(time, state, rate, status)
         call problem%get_clearance(time, state, method%here%clearance)
         counters%evaluations = counters%evaluations + 1
      end if
   end subroutine rate_here

   !> Integrate from one stop to the next.
   subroutine integrate_segment(problem, method, options, start, finish, state, rate, step, last_error, trajectory, &
      & counters, error)
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

      ! Time, its end, size of this step [time]
      real(wp) :: time, new_time, this_step
      ! Trial state [state], its rate [state/time]
      real(wp) :: new_state(size(state)), new_rate(size(state))
      ! Error over tolerance [-]
      real(wp) :: scaled_error
      type(footing_t) :: footing
      integer :: status
      logical :: is_last, is_over, was_rejected

      time = start
      method%horizon = finish
      was_rejected = .false.
      do
         call choose_step(problem, method, options, time, finish, state, step, this_step, new_time, is_last, counters)
         call cross(problem, method, options, finish, this_step, footing, time, state, rate, is_last, trajectory, counters, is_over)
         if (is_over) then
            if (is_last) return
            step = this_step
            call check_progress(problem, method, options, time, step, .false., counters, error)
            if (allocated(error)) return
            cycle
         end if
         call try_checked_step(problem, method, options, time, new_time, finish, this_step, state, rate, new_state, &
            & new_rate, scaled_error, counters, status)
         if (status /= 0) then
            call raise(error, kind_convergence, "the integration met a state that cannot be evaluated at "// &
               & trim(problem%name_time(time)))
         else if (scaled_error <= 1.0_wp) then
            counters%accepted = counters%accepted + 1
            time = new_time
            state = new_state
            rate = new_rate
            call keep_point(method, time, state, rate, trajectory)
            if (.not. is_fixed(method, options)) then
               call adapt_step(method, this_step, is_last, was_rejected, scaled_error, last_error, step)
            end if
            if (is_last) return
            call copy_linear(method%there, method%here)
            was_rejected = .false.
         else
            counters%rejected = counters%rejected + 1
            was_rejected = .true.
            step = this_step*max(max_shrinkage, safety*scaled_error**(-1.0_wp/max(method%error_order, 1)))
         end if
         if (.not. allocated(error)) call check_progress(problem, method, options, time, step, was_rejected, &
            & counters, error)
         if (allocated(error)) return
      end do
   end subroutine integrate_segment

   !> May bridges take the place of a method's steps?
   pure function may_bridge(method, options) result(verdict)
      !> The method
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> May they?
      logical :: verdict

      verdict = method%needs_jacobian .and. .not. is_fixed(method, options)
   end function may_bridge

   !> Go on by a bridge where the method gets nowhere, if there is one.
   subroutine cross(problem, method, options, finish, step, footing, time, state, rate, is_last, trajectory, counters, was_crossed)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> End of the segment [time]
      real(wp), intent(in) :: finish
      !> Size of the step that is to be made; out: of the next, after a bridge [time]
      real(wp), intent(inout) :: step
      !> Progress of the integration
      type(footing_t), intent(inout) :: footing
      !> Time, from start to end [time]
      real(wp), intent(inout) :: time
      !> State, from start to end [state]
      real(wp), intent(inout) :: state(:)
      !> Rate, from start to end [state/time]
      real(wp), intent(inout) :: rate(:)
      !> Does the step end the segment?
      logical, intent(inout) :: is_last
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Was there one?
      logical, intent(out) :: was_crossed

      type(bridge_t) :: bridge
      ! No bends [state]; end [time]
      real(wp) :: straight(1, 1), new_time
      integer :: status

      was_crossed = .false.
      if (.not. may_bridge(method, options)) return
      call watch(footing, method%here, time, step)
      if (.not. is_stuck(method%here, time, step, method%tolerance, footing)) then
         footing%is_fresh = .false.
         return
      end if
      straight = 0.0_wp
      call try_bridge(problem, method%here, time, state(1), step, finish - time, method%tolerance(1), bridge, counters)
      if (.not. bridge%is_found) return
      is_last = .not. time + bridge%step*(1.0_wp + 1.0e-9_wp) < finish
      new_time = merge(finish, time + bridge%step, is_last)
      call problem%linearise(new_time, bridge%states(2:2), finish, method%there, counters, status)
      if (status /= 0) return
      was_crossed = .true.
      counters%accepted = counters%accepted + 2
      call append_curve(trajectory, time + 0.5_wp*bridge%step, bridge%states(1:1), bridge%rates(1:1), straight)
      time = new_time
      state = bridge%states(2)
      rate = method%there%rate
      step = bridge%next_step
      call append_curve(trajectory, time, state, rate, straight)
      call copy_linear(method%there, method%here)
      call note_bridge(footing, time, rate(1))
   end subroutine cross

   !> Are the steps fixed, by choice or for want of an error estimate?
   pure function is_fixed(method, options)
      !> The method
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Are they?
      logical :: is_fixed

      is_fixed = options%is_fixed .or. method%error_order == 0
   end function is_fixed

   !> Append an accepted point to the trajectory, with the curve that the method has left, if any.
   pure subroutine keep_point(method, time, state, rate, trajectory)
      !> The method
      class(method_t), intent(in) :: method
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate [state/time]
      real(wp), intent(in) :: rate(:)
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory

      if (method%has_curve) then
         call append_curve(trajectory, time, state, rate, method%bends)
      else
         call append_point(trajectory, time, state, rate)
      end if
   end subroutine keep_point

   !> Step that tolerance, largest step, stability and the end of the segment allow.
   !>
   !> A step that would leave a short remainder is cut to half of what is left.
   subroutine choose_step(problem, method, options, time, finish, state, step, this_step, new_time, is_last, counters)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Time [time]
      real(wp), intent(in) :: time
      !> End of the segment [time]
      real(wp), intent(in) :: finish
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Step proposed by the controller [time]
      real(wp), intent(in) :: step
      !> Step to take, its end [time]
      real(wp), intent(out) :: this_step, new_time
      !> Does it end the segment?
      logical, intent(out) :: is_last
      !> Work done
      type(counters_t), intent(inout) :: counters

      ! Fastest decay rate [1/time]
      real(wp) :: decay_rate

      this_step = min(step, options%max_step)
      if (.not. is_fixed(method, options) .and. method%stability_limit < huge(1.0_wp)) then
         call problem%get_decay_rate(time, state, decay_rate)
         counters%decay_rates = counters%decay_rates + 1
         if (decay_rate*this_step > stability_margin*method%stability_limit) then
            this_step = stability_margin*method%stability_limit/decay_rate
         end if
      end if
      is_last = time + this_step*(1.0_wp + 1.0e-9_wp) >= finish
      if (is_last) this_step = finish - time
      if (.not. (is_last .or. is_fixed(method, options))) this_step = min(this_step, 0.5_wp*(finish - time))
      new_time = merge(finish, time + this_step, is_last)
   end subroutine choose_step

   !> Try a step; a trial without a value, or with one that is no number, has an error far beyond its tolerance.
   subroutine try_checked_step(problem, method, options, time, new_time, finish, this_step, state, rate, new_state, &
      & new_rate, scaled_error, counters, status)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Time at the start and at the end of the step, end of the segment, size of the step [time]
      real(wp), intent(in) :: time, new_time, finish, this_step
      !> State at the start [state]
      real(wp), intent(in) :: state(:)
      !> Rate at the start [state/time]
      real(wp), intent(in) :: rate(:)
      !> State at the end [state]
      real(wp), intent(out) :: new_state(:)
      !> Rate at the end [state/time]
      real(wp), intent(out) :: new_rate(:)
      !> Error over tolerance [-]
      real(wp), intent(out) :: scaled_error
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0, or negative: give up
      integer, intent(out) :: status

      ! Error over tolerance that stands for an impossible trial [-]
      real(wp), parameter :: impossible = 1.0e3_wp
      ! Error of the step [state]
      real(wp) :: estimate(size(state))

      call method%try_step(problem, time, state, rate, this_step, new_state, new_rate, estimate, counters, status)
      scaled_error = impossible
      if (status == 0) then
         scaled_error = 0.0_wp
         if (.not. is_fixed(method, options)) scaled_error = maxval(abs(estimate)/method%tolerance)
         if (.not. all(abs(new_state) < huge(1.0_wp) .and. abs(estimate) < huge(1.0_wp))) scaled_error = impossible
      end if
      if (status == 0 .and. scaled_error <= 1.0_wp .and. .not. method%gives_rate) then
         if (method%needs_jacobian .and. new_time < finish) then
            call problem%linearise(new_time, new_state, finish, method%there, counters, status)
            new_rate = method%there%rate
         else
            call problem%get_rate(new_time, new_state, new_rate, status)
            counters%evaluations = counters%evaluations + 1
         end if
         if (status > 0) scaled_error = impossible
      end if
      if (status == 0 .and. scaled_error <= 1.0_wp) then
         call check_step(problem, method, is_fixed(method, options), time, new_time, finish, this_step, state, &
            & rate, new_state, new_rate, estimate, counters, scaled_error)
      end if
      status = min(status, 0)
   end subroutine try_checked_step

   !> Proposal for the next step after an accepted one: proportional-integral control.
   !>
   !> A step that was cut short by the end of its segment says nothing about the next one unless it may grow.
   pure subroutine adapt_step(method, this_step, is_last, was_rejected, scaled_error, last_error, step)
      !> The method
      class(method_t), intent(in) :: method
      !> Step taken [time]
      real(wp), intent(in) :: this_step
      !> Did it end its segment?
      logical, intent(in) :: is_last
      !> Was a longer step rejected just before?
      logical, intent(in) :: was_rejected
      !> Error of this step over tolerance [-]
      real(wp), intent(in) :: scaled_error
      !> The same of the step before; out: of this one [-]
      real(wp), intent(inout) :: last_error
      !> Step proposed [time]
      real(wp), intent(inout) :: step

      ! New step over this one, smallest error that counts [-]
      real(wp) :: factor, error_in_use

      error_in_use = max(scaled_error, least_error)
      factor = safety*error_in_use**(-method%proportional/method%error_order) &
         & *last_error**(method%integral/method%error_order)
      factor = min(max_growth, max(max_shrinkage, factor))
      if (was_rejected) factor = min(factor, 1.0_wp)
      if (is_last) then
         step = max(step, this_step*factor)
      else
         step = this_step*factor
      end if
      last_error = error_in_use
   end subroutine adapt_step

   !> Refuse an integration that does not come on.
   subroutine check_progress(problem, method, options, time, step, was_rejected, counters, error)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Time [time]
      real(wp), intent(in) :: time
      !> Step proposed [time]
      real(wp), intent(in) :: step
      !> Was the step just tried rejected?
      logical, intent(in) :: was_rejected
      !> Work done
      type(counters_t), intent(in) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (was_rejected .and. is_fixed(method, options)) then
         call raise(error, kind_convergence, "a fixed step failed at "//trim(problem%name_time(time)))
      else if (counters%accepted + counters%rejected > options%max_steps) then
         call raise(error, kind_convergence, "the largest number of steps is reached at "//trim(problem%name_time(time)))
      else if (counters%evaluations > options%max_evaluations) then
         call raise(error, kind_convergence, "the largest number of evaluations is reached at "//trim(problem%name_time(time)))
      else if (step <= 16.0_wp*spacing(abs(time))) then
         call raise(error, kind_convergence, "the step size fell below its minimum at "//trim(problem%name_time(time)))
      end if
   end subroutine check_progress

end module camroller_ode
