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
   use camroller_ode_method, only : method_t, options_t, step_t, start_step, move_step, take_step, keep_point, keep_stable
   use camroller_step_control, only : control_t, impossible_error, last_part, next_step, shorter_step
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_straight, append_curve, least_segment, stop_margin
   use camroller_step_checks, only : check_progress, check_step
   use camroller_ode_bridge, only : footing_t, bridge_t, watch, is_stuck, try_bridge, note_bridge
   implicit none
   private

   public :: problem_t, counters_t, method_t, options_t, step_t, integrate

   !> Largest growth of a step; error over tolerance below which smaller ones make no difference [-]
   real(wp), parameter :: max_growth = 5.0_wp, least_error = 1.0e-4_wp

   !> Where an integration stands
   type :: walk_t
      !> The step that is being made, from the point reached
      type(step_t) :: step
      !> Step proposed by the controller [time]
      real(wp) :: proposed = 0.0_wp
      !> Largest step of the segment [time]
      real(wp) :: max_step = huge(1.0_wp)
      !> Error of the last accepted step over its tolerance [-]
      real(wp) :: last_error = 1.0_wp
      !> Was the last try rejected?
      logical :: was_rejected = .false.
      !> What tells whether the method makes progress
      type(footing_t) :: footing
   end type walk_t

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

      type(walk_t) :: walk
      ! A few roundings [time]
      real(wp) :: margin
      integer :: segment, segments, status

      call move_step(method%room, walk%step)
      call start_step(walk%step, state)
      walk%max_step = options%max_step
      walk%proposed = options%step
      if (walk%proposed <= 0.0_wp) walk%proposed = 1.0e-4_wp*(stops(size(stops)) - stops(1))
      margin = stop_margin(stops)
      segments = count(stops(2:) - stops(:size(stops) - 1) > least_segment*margin)
      if (allocated(options%tolerance)) method%tolerance = options%tolerance
      call start_trajectory(trajectory, size(state))
      if (method%needs_jacobian) then
         call new_linear(method%here, size(state))
         call new_linear(method%there, size(state))
      end if
      do segment = 1, size(stops) - 1
         if (stops(segment + 1) - stops(segment) <= least_segment*margin) cycle
         associate (step => walk%step)
            step%time = stops(segment) + margin
            method%horizon = stops(segment + 1) - margin
            call rate_here(problem, method, step, counters, status)
            if (status /= 0) then
               call raise(error, kind_convergence, "the right-hand side cannot be evaluated at "// &
                  & trim(problem%name_time(step%time)))
               return
            end if
            call append_straight(trajectory, step%time, step%state, step%rate)
            if (.not. is_fixed(method, options)) walk%proposed = min(walk%proposed, method%longest_first_step(step))
            if (.not. is_fixed(method, options)) walk%max_step = min(options%max_step, &
               & (method%horizon - step%time)/max(1, options%fewest_steps/segments))
         end associate
         call integrate_segment(problem, method, options, walk, trajectory, counters, error)
         state(:) = walk%step%state
         if (allocated(error)) return
      end do
      call move_step(walk%step, method%room)
   end subroutine integrate

   !> Rate where a segment begins, with its derivatives where the method needs them.
   subroutine rate_here(problem, method, step, counters, status)
      class(problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> The first step; out: with the rate at its start
      type(step_t), intent(inout) :: step
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      if (method%needs_jacobian) then
         call problem%linearise(step%time, step%state, method%horizon, method%here, counters, status)
         step%rate(:) = method%here%rate
      else
         call problem%get_rate(step%time, step%state, step%rate, status)
         call problem%get_clearance(step%time, step%state, method%here%clearance)
         counters%evaluations = counters%evaluations + 1
      end if
   end subroutine rate_here

   !> Integrate from one stop to the next, the horizon of the method.
   subroutine integrate_segment(problem, method, options, walk, trajectory, counters, error)
      class(problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Where the integration stands
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: status
      logical :: was_crossed

      walk%footing = footing_t()
      walk%was_rejected = .false.
      do
         call choose_step(problem, method, options, walk, counters)
         call cross(problem, method, options, walk, trajectory, counters, was_crossed)
         if (was_crossed) then
            if (walk%step%is_last) return
            walk%proposed = walk%step%length
         else
            call try_checked_step(problem, method, options, walk%step, counters, status)
            if (status /= 0) then
               call raise(error, kind_convergence, "the integration met a state that cannot be evaluated at "// &
                  & trim(problem%name_time(walk%step%time)))
            else if (walk%step%scaled_error <= 1.0_wp) then
               counters%accepted = counters%accepted + 1
               call take_step(walk%step)
               call keep_point(method, walk%step, trajectory)
               if (.not. is_fixed(method, options)) call adapt_step(method, walk)
               if (walk%step%is_last) return
               call copy_linear(method%there, method%here)
               walk%was_rejected = .false.
            else
               counters%rejected = counters%rejected + 1
               walk%was_rejected = .true.
               walk%proposed = walk%step%length*shorter_step(method%error_order, walk%step%scaled_error)
            end if
         end if
         if (walk%was_rejected .and. is_fixed(method, options) .and. .not. allocated(error)) call raise(error, kind_convergence, &
            & "a fixed step failed at "//trim(problem%name_time(walk%step%time)))
         if (.not. allocated(error)) call check_progress(problem, options, walk%step%time, walk%proposed, counters, error)
         if (allocated(error)) return
      end do
   end subroutine integrate_segment

   !> Go on by a bridge where the method gets nowhere, if there is one.
   subroutine cross(problem, method, options, walk, trajectory, counters, was_crossed)
      class(problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Where the integration stands, with the step that is to be made; out: with the length of the next, after a bridge
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Was there a bridge?
      logical, intent(out) :: was_crossed

      type(bridge_t) :: bridge
      ! No bends [state]
      real(wp) :: straight(1, 1)
      integer :: status

      was_crossed = .false.
      if (is_fixed(method, options) .or. .not. method%needs_jacobian) return
      associate (step => walk%step, footing => walk%footing)
         call watch(footing, step%time, step%length)
         if (.not. is_stuck(method%here, step%time, step%length, method%tolerance, footing)) then
            footing%is_fresh = .false.
            return
         end if
         straight = 0.0_wp
         call try_bridge(problem, method%here, step%time, step%state(1), step%length, method%horizon - step%time, &
            & method%tolerance(1), bridge, counters)
         if (.not. bridge%is_found) return
         step%is_last = .not. step%time + bridge%step*(1.0_wp + last_part) < method%horizon
         step%end_time = merge(method%horizon, step%time + bridge%step, step%is_last)
         call problem%linearise(step%end_time, bridge%states(2:2), method%horizon, method%there, counters, status)
         if (status /= 0) return
         was_crossed = .true.
         counters%accepted = counters%accepted + 2
         call append_curve(trajectory, step%time + 0.5_wp*bridge%step, bridge%states(1:1), bridge%rates(1:1), straight)
         step%new_state(:) = bridge%states(2)
         step%new_rate(:) = method%there%rate
         call take_step(step)
         step%length = bridge%next_step
         call append_curve(trajectory, step%time, step%state, step%rate, straight)
         call copy_linear(method%there, method%here)
         call note_bridge(footing, step%time)
      end associate
   end subroutine cross

   !> Are the steps fixed, by choice or for want of an error estimate?
   pure function is_fixed(method, options)
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Are they?
      logical :: is_fixed

      is_fixed = options%is_fixed .or. method%error_order == 0
   end function is_fixed

   !> Step that tolerance, largest step, stability and the end of the segment allow.
   !>
   !> A step that would leave a short remainder is cut to half of what is left.
   subroutine choose_step(problem, method, options, walk, counters)
      class(problem_t), intent(in) :: problem
      class(method_t), intent(in) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> Where the integration stands; out: with length and end of the step
      type(walk_t), intent(inout) :: walk
      !> Work done
      type(counters_t), intent(inout) :: counters

      associate (step => walk%step, finish => method%horizon)
         step%length = min(walk%proposed, walk%max_step)
         if (.not. is_fixed(method, options)) call keep_stable(method, problem, step, counters)
         step%is_last = step%time + step%length*(1.0_wp + last_part) >= finish
         if (step%is_last) step%length = finish - step%time
         if (.not. (step%is_last .or. is_fixed(method, options))) step%length = min(step%length, 0.5_wp*(finish - step%time))
         step%end_time = merge(finish, step%time + step%length, step%is_last)
      end associate
   end subroutine choose_step

   !> Try a step; a trial without a value, or with one that is no number, has an error far beyond its tolerance.
   subroutine try_checked_step(problem, method, options, step, counters, status)
      class(problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> Tolerance or step
      type(options_t), intent(in) :: options
      !> The step; out: with its end and its error
      type(step_t), intent(inout) :: step
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0, or negative: give up
      integer, intent(out) :: status

      call method%try_step(problem, step, counters, status)
      step%scaled_error = impossible_error
      if (status == 0) then
         step%scaled_error = 0.0_wp
         if (.not. is_fixed(method, options)) step%scaled_error = maxval(abs(step%estimate)/method%tolerance)
         if (.not. all(abs(step%new_state) < huge(1.0_wp) .and. abs(step%estimate) < huge(1.0_wp))) then
            step%scaled_error = impossible_error
         end if
      end if
      if (status == 0 .and. step%scaled_error <= 1.0_wp .and. .not. method%gives_rate) then
         if (method%needs_jacobian .and. step%end_time < method%horizon) then
            call problem%linearise(step%end_time, step%new_state, method%horizon, method%there, counters, status)
            step%new_rate(:) = method%there%rate
         else
            call problem%get_rate(step%end_time, step%new_state, step%new_rate, status)
            counters%evaluations = counters%evaluations + 1
         end if
         if (status > 0) step%scaled_error = impossible_error
      end if
      if (status == 0 .and. step%scaled_error <= 1.0_wp) then
         call check_step(problem, method, is_fixed(method, options), step, counters)
      end if
      status = min(status, 0)
   end subroutine try_checked_step

   !> Proposal for the next step after an accepted one: proportional-integral control.
   !>
   !> A step that was cut short by the end of its segment says nothing about the next one unless it may grow.
   pure subroutine adapt_step(method, walk)
      class(method_t), intent(in) :: method
      !> Where the integration stands, the step taken
      type(walk_t), intent(inout) :: walk

      real(wp) :: factor ! new step over this one [-]

      call next_step(control_t(method%proportional, method%integral, least_error, max_growth), method%error_order, &
         & walk%step%scaled_error, walk%last_error, factor)
      if (walk%was_rejected) factor = min(factor, 1.0_wp)
      if (walk%step%is_last) then
         walk%proposed = max(walk%proposed, walk%step%length*factor)
      else
         walk%proposed = walk%step%length*factor
      end if
   end subroutine adapt_step

end module camroller_ode
