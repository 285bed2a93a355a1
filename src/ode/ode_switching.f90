!> Initial value problems whose right-hand side has kinks at places that depend on the state: the zeros of its switches, and whole
!> numbers of its markers.
!>
!> In: a problem with switches, a method, tolerances, times at which a step must end. Out: a trajectory whose steps end at the kinks
!> as well. Where Taylor's polynomial from the start of a step foresees a kink, the step is made to a little before it, and the
!> polynomial leads past it: so no step has a kink in it, and each begins with the derivatives of its own side. A step that crosses
!> a kink all the same is made again; where the kink lies, the curve of the step tells.
module camroller_ode_switching
   use camroller_kinds, only : wp
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted
   use camroller_ode_problem, only : problem_t, counters_t, new_linear, copy_linear
   use camroller_ode_method, only : method_t, options_t, step_t, start_step, move_step, take_step, keep_point, keep_stable
   use camroller_step_control, only : control_t, impossible_error, last_part, next_step, safety, shorter_step
   use camroller_step_checks, only : check_end, check_progress
   use camroller_trajectory, only : trajectory_t, start_trajectory, append_straight, append_cubic, curve_state, least_segment, &
      & stop_margin
   implicit none
   private

   public :: switching_problem_t, integrate_switching

   !> Most switches and markers of a problem
   integer, parameter :: most_switches = 4

   !> A problem whose right-hand side has kinks where a switch is zero, or a marker a whole number
   type, abstract, extends(problem_t) :: switching_problem_t
      !> Number of switches, and of the markers behind them
      integer :: switches = 0, markers = 0
   contains
      procedure(switches_interface), deferred :: get_switches
   end type switching_problem_t

   !> Where an integration stands
   type :: walk_t
      !> The step that is being made, from the point reached
      type(step_t) :: step
      !> Step proposed [time]
      real(wp) :: proposed = 0.0_wp
      !> Switches and markers at the start and at the end of the step; zero beyond those that the problem has [any]
      real(wp) :: switches(most_switches) = 0.0_wp, new_switches(most_switches) = 0.0_wp
      !> Where each has its first kink in the direction of the step: zero for a switch [any]
      real(wp) :: kinks(most_switches) = 0.0_wp
      !> Slopes of the switches over the step before [any/time]
      real(wp) :: slopes(most_switches) = 0.0_wp
      !> Place of the first kink in the step; beyond it where there is none [-]
      real(wp) :: kink = 0.0_wp
      !> Length of the step that was proposed before a kink cut it short [time]
      real(wp) :: whole = 0.0_wp
      !> Error over tolerance of the last step that was not cut short, of the last one that was accepted [-]
      real(wp) :: usual_error = 0.0_wp, last_error = 1.0_wp
      !> Is the step cut short, to end at a kink? Has a step with a small enough error told where that is? Is the step one of
      !> Taylor's polynomial, past a kink?
      logical :: is_cut = .false., is_located = .false., is_hop = .false.
   end type walk_t

   !> By the last error alone: a fifth of the steps is tried again, but steps that follow two errors are shorter at the same
   !> tolerance
   type(control_t), parameter :: control = control_t(proportional=1.0_wp, integral=0.0_wp, least_error=1.0e-3_wp, max_growth=4.0_wp)
   !> Kinks this near to the end of a step are at that end, over the step [-]
   real(wp), parameter :: near_end = 1.0e-3_wp
   !> Error over tolerance of a step in which a kink makes no difference: a contact that rests at zero but for rounding would end
   !> every step [-]
   real(wp), parameter :: least_kink = 1.0e-6_wp
   !> Error of a zero on a curve, and how far past it a kink is taken to be, over the step [-]
   real(wp), parameter :: past_zero = 1.0e-6_wp
   !> How far before a kink a step is to end from which Taylor's polynomial leads past it, over the step that no kink has cut short:
   !> the place of a kink that is foreseen errs by half of this [-]
   real(wp), parameter :: margin = 1.0e-3_wp
   !> Last term of the polynomial over the tolerance, and part of the step that no kink has cut short, up to which it may lead [-]
   real(wp), parameter :: hop_error = 1.0e-2_wp, longest_hop = 0.05_wp
   !> A switch may be zero in a step where it would be in so many of them by its slope over the last one [-]
   real(wp), parameter :: reach = 2.0_wp
   !> Part of the step proposed before a kink has cut it short that the step behind the kink may have [-]
   real(wp), parameter :: after_kink = 0.7_wp

   abstract interface
      !> Switches, whose zeros are kinks of the right-hand side, and markers, which have kinks at whole numbers
      subroutine switches_interface(self, time, state, switches, status)
         import :: switching_problem_t, wp
         !> The problem; read only
         class(switching_problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> State [state]
         real(wp), intent(in) :: state(:)
         !> The values [any]
         real(wp), intent(out) :: switches(:)
         !> 0 fine, else the state has none
         integer, intent(out) :: status
      end subroutine switches_interface
   end interface

contains

   !> Integrate from the first to the last of the stop times; each of them ends a step, and so does each kink.
   subroutine integrate_switching(problem, method, options, stops, state, trajectory, counters, error, proposed)
      !> The problem
      class(switching_problem_t), intent(in) :: problem
      !> The method, one with an error estimate
      class(method_t), intent(inout) :: method
      !> Tolerance and steps; `fewest_steps` is not for this, whose problems show their kinks by their switches
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
      !> Step to begin with where the integration goes on from here [time]
      real(wp), intent(out), optional :: proposed

      type(walk_t) :: walk
      ! A few roundings [time]
      real(wp) :: margin
      integer :: segment, status

      call move_step(method%room, walk%step)
      call start_step(walk%step, state)
      walk%proposed = options%step
      margin = stop_margin(stops)
      method%tolerance = options%tolerance
      call start_trajectory(trajectory, size(state))
      call new_linear(method%here, size(state))
      call new_linear(method%there, size(state))
      associate (step => walk%step)
         do segment = 1, size(stops) - 1
            if (stops(segment + 1) - stops(segment) <= least_segment*margin) cycle
            step%time = stops(segment) + margin
            method%horizon = stops(segment + 1) - margin
            call problem%linearise(step%time, step%state, method%horizon, method%here, counters, status)
            if (status == 0) call problem%get_switches(step%time, step%state, walk%switches(:problem%switches + &
               & problem%markers), status)
            if (status /= 0) then
               call raise(error, kind_convergence, "the right-hand side has no value at "//trim(problem%name_time(step%time)))
               return
            end if
            step%rate(:) = method%here%rate
            call append_straight(trajectory, step%time, step%state, step%rate)
            call walk_segment(problem, method, options, walk, trajectory, counters, error)
            if (allocated(error)) return
         end do
         state(:) = step%state
      end associate
      call move_step(walk%step, method%room)
      if (present(proposed)) proposed = walk%proposed
   end subroutine integrate_switching

   !> Integrate to the end of a segment.
   subroutine walk_segment(problem, method, options, walk, trajectory, counters, error)
      class(switching_problem_t), intent(in) :: problem
      !> The method; its horizon is the end of the segment
      class(method_t), intent(inout) :: method
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> Where the integration stands
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      logical :: was_rejected

      walk%is_cut = .false.
      was_rejected = .false.
      do
         call choose_step(problem, method, options, walk, counters)
         if (walk%is_hop) then
            call hop(problem, method, walk, trajectory, counters)
         else
            call try_step(problem, method, walk, counters)
            if (walk%step%scaled_error <= 1.0_wp .and. ends_at_kink(walk)) then
               call accept_step(method, was_rejected, walk, trajectory, counters)
               if (walk%step%is_last) return
            else
               call reject_step(method, was_rejected, walk, counters)
            end if
         end if
         call check_progress(problem, options, walk%step%time, walk%proposed, counters, error)
         if (allocated(error)) return
      end do
   end subroutine walk_segment

   !> Go on to the end of a step, and propose the next one.
   subroutine accept_step(method, was_rejected, walk, trajectory, counters)
      !> The method, with the derivatives at the end of the step
      class(method_t), intent(inout) :: method
      !> Had the step before this an error too large? Out: no
      logical, intent(inout) :: was_rejected
      !> Where the integration stands; out: one step further
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters

      ! Part of the step that the next one is [-]
      real(wp) :: factor

      counters%accepted = counters%accepted + 1
      associate (length => walk%step%length)
         walk%slopes(:) = (walk%new_switches - walk%switches)/length
         walk%switches(:) = walk%new_switches
         call take_step(walk%step)
         call keep_point(method, walk%step, trajectory)
         if (walk%step%is_last) then
            walk%proposed = max(walk%proposed, length)
            return
         end if
         call next_step(control, method%error_order, walk%step%scaled_error, walk%last_error, factor)
         if (was_rejected) factor = min(factor, 1.0_wp)
         walk%proposed = length*factor
         if (walk%is_cut) walk%proposed = max(walk%proposed, after_kink*walk%whole)
      end associate
      call copy_linear(method%there, method%here)
      walk%is_cut = .false.
      was_rejected = .false.
   end subroutine accept_step

   !> Propose a step in the place of one with an error too large, or with a kink in it: to that kink where it may be the cause.
   subroutine reject_step(method, was_rejected, walk, counters)
      class(method_t), intent(in) :: method
      !> Out: was the error too large?
      logical, intent(out) :: was_rejected
      !> Where the integration stands
      type(walk_t), intent(inout) :: walk
      !> Work done
      type(counters_t), intent(inout) :: counters

      ! Part of the step that the next one is, by its error [-]; way to the kink [time]
      real(wp) :: factor, way

      counters%rejected = counters%rejected + 1
      was_rejected = walk%step%scaled_error > 1.0_wp
      factor = shorter_step(method%error_order, walk%step%scaled_error)
      walk%is_cut = .not. ends_at_kink(walk) .and. (.not. was_rejected .or. walk%kink < factor .or. .not. walk%is_cut)
      walk%is_located = walk%is_cut .and. .not. was_rejected
      walk%proposed = walk%step%length*min(factor, safety)
      if (.not. walk%is_cut) return
      way = walk%kink*walk%step%length
      ! Nothing foresees markers: the last bit up to one is a step
      walk%proposed = way
      if (method%needs_jacobian .and. way > 2.0_wp*margin*walk%whole) walk%proposed = way - margin*walk%whole
   end subroutine reject_step

   !> Step that the proposal, the largest step, stability and the end of the segment allow.
   subroutine choose_step(problem, method, options, walk, counters)
      class(switching_problem_t), intent(in) :: problem
      class(method_t), intent(in) :: method
      !> Tolerance and steps
      type(options_t), intent(in) :: options
      !> Where the integration stands; out: with length and end of the step
      type(walk_t), intent(inout) :: walk
      !> Work done
      type(counters_t), intent(inout) :: counters

      associate (step => walk%step, finish => method%horizon)
         step%length = min(walk%proposed, options%max_step)
         call keep_stable(method, problem, step, counters)
         walk%is_hop = .false.
         if (.not. walk%is_cut) then
            walk%is_located = .false.
            walk%whole = step%length
            if (method%needs_jacobian) call foresee_kink(problem, method, walk)
         end if
         step%is_last = step%time + step%length*(1.0_wp + last_part) >= finish
         if (step%is_last) step%length = finish - step%time
         if (.not. step%is_last .and. step%time + 2.0_wp*step%length > finish) step%length = 0.5_wp*(finish - step%time)
         step%end_time = merge(finish, step%time + step%length, step%is_last)
         walk%is_hop = walk%is_hop .and. .not. step%is_last
      end associate
   end subroutine choose_step

   !> Cut a step short where a kink is foreseen, by Taylor's polynomial of third order with the Jacobian at the start of the step.
   subroutine foresee_kink(problem, method, walk)
      class(switching_problem_t), intent(in) :: problem
      !> The method, with the derivatives at the start
      class(method_t), intent(in) :: method
      !> Where the integration stands, with the step as proposed; out: cut short
      type(walk_t), intent(inout) :: walk

      ! Second and third term of the polynomial at the end of the step [state]
      real(wp) :: second(size(walk%step%state)), third(size(walk%step%state))
      integer :: status

      associate (step => walk%step, kink => walk%kink, n => problem%switches)
         if (walk%usual_error <= least_kink) return
         if (.not. any(walk%switches(:n)*walk%slopes(:n) < 0.0_wp &
            & .and. abs(walk%switches(:n)) < reach*abs(walk%slopes(:n))*step%length)) return
         second = (0.5_wp*step%length)*(matmul(method%here%jacobian, step%length*step%rate) + step%length*method%here%time_slope)
         third = (step%length/3.0_wp)*matmul(method%here%jacobian, second)
         step%new_state(:) = step%state + step%length*step%rate + second + third
         step%curve(:, :) = 0.0_wp
         step%curve(:, 1) = -second - third
         step%curve(:, 2) = -third
         walk%new_switches(:) = walk%switches
         call problem%get_switches(step%time + step%length, step%new_state, walk%new_switches(:n + problem%markers), status)
         if (status /= 0) return
         walk%new_switches(n + 1:) = walk%switches(n + 1:)
         walk%kinks(:) = 0.0_wp
         if (.not. any(walk%new_switches(:n)*walk%switches(:n) < 0.0_wp)) return
         call find_first_kink(problem, walk)
         if (kink >= 1.0_wp) return
         walk%is_hop = kink <= longest_hop .and. kink**3*maxval(abs(third)/method%tolerance) <= hop_error
         walk%is_cut = .not. walk%is_hop
         step%length = merge(kink, max(kink - margin, 0.5_wp*kink), walk%is_hop)*step%length
      end associate
   end subroutine foresee_kink

   !> Follow Taylor's polynomial past a kink.
   subroutine hop(problem, method, walk, trajectory, counters)
      class(switching_problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> Where the integration stands, with the polynomial as curve of the whole step; out: past the kink, or with a proposal to go
      !> there by a step
      type(walk_t), intent(inout) :: walk
      !> Accepted points
      type(trajectory_t), intent(inout) :: trajectory
      !> Work done
      type(counters_t), intent(inout) :: counters

      integer :: status

      associate (step => walk%step, m => problem%switches + problem%markers)
         step%new_state(:) = curve_state(step%state, step%new_state, step%curve, walk%kink)
         call problem%get_switches(step%end_time, step%new_state, walk%new_switches(:m), status)
         if (status == 0) call problem%linearise(step%end_time, step%new_state, method%horizon, method%there, counters, status)
         if (status == 0) then
            counters%accepted = counters%accepted + 1
            step%new_rate(:) = method%there%rate
            call take_step(step)
            call append_cubic(trajectory, step%time, step%state, step%rate)
            call copy_linear(method%there, method%here)
            walk%switches(:) = walk%new_switches
         else
            counters%rejected = counters%rejected + 1
            walk%proposed = step%length
            walk%is_cut = .true.
         end if
      end associate
   end subroutine hop

   !> Try a step, and look for the first kink in it.
   subroutine try_step(problem, method, walk, counters)
      class(switching_problem_t), intent(in) :: problem
      class(method_t), intent(inout) :: method
      !> Where the integration stands; out: with the end of the step, its error and its first kink
      type(walk_t), intent(inout) :: walk
      !> Work done
      type(counters_t), intent(inout) :: counters

      integer :: status
      logical :: has_kink

      walk%kink = 2.0_wp
      walk%new_switches(:) = walk%switches
      associate (step => walk%step)
         call method%try_step(problem, step, counters, status)
         step%scaled_error = impossible_error
         if (status /= 0) return
         if (.not. all(abs(step%new_state) < huge(1.0_wp) .and. abs(step%estimate) < huge(1.0_wp))) return
         associate (n => problem%switches, m => problem%switches + problem%markers)
            call problem%get_switches(step%end_time, step%new_state, walk%new_switches(:m), status)
            if (status /= 0) return
            walk%kinks(n + 1:m) = next_whole(walk%switches(n + 1:m), walk%new_switches(n + 1:m))
         end associate
         step%scaled_error = maxval(abs(step%estimate)/method%tolerance)
         if (.not. walk%is_cut) walk%usual_error = step%scaled_error
         has_kink = any((walk%new_switches - walk%kinks)*(walk%switches - walk%kinks) < 0.0_wp)
         if (has_kink .and. step%scaled_error > least_kink) then
            step%curve(:, :) = 0.0_wp
            step%curve(:, :size(method%bends, 2)) = method%bends
            call find_first_kink(problem, walk)
         end if
         if (step%scaled_error > 1.0_wp .or. .not. ends_at_kink(walk)) return
         if (method%needs_jacobian) then
            call problem%linearise(step%end_time, step%new_state, method%horizon, method%there, counters, status)
            step%new_rate(:) = method%there%rate
            if (status == 0) call check_end(method%here, method%there, step)
         end if
         if (status /= 0) step%scaled_error = impossible_error
      end associate
   end subroutine try_step

   !> Is a kink in a step so near to its end that it makes no difference, or is there none?
   pure function ends_at_kink(walk) result(verdict)
      !> Where the integration stands
      type(walk_t), intent(in) :: walk
      !> Is it?
      logical :: verdict

      verdict = walk%kink > 1.0_wp - near_end .or. (walk%is_located .and. walk%kink > 0.5_wp)
   end function ends_at_kink

   !> The first whole number on the way from one value to another, or beyond it.
   elemental function next_whole(before, after) result(whole)
      !> The values [-]
      real(wp), intent(in) :: before, after
      !> The number [-]
      real(wp) :: whole

      whole = real(floor(before), wp)
      if (after > before) whole = whole + 1.0_wp
   end function next_whole

   !> Find the place of the first kink of a switch or marker in a step, on the step's curve, and a little past it.
   subroutine find_first_kink(problem, walk)
      class(switching_problem_t), intent(in) :: problem
      !> The step, with the switches at both ends; out: with the place
      type(walk_t), intent(inout) :: walk

      ! Switches and markers on the curve and at its start, less where they have kinks [any]
      real(wp) :: values(most_switches), starts(most_switches)
      type(bracket_t) :: bracket
      integer :: i, status

      associate (step => walk%step, place => walk%kink)
         place = 1.0_wp
         starts = walk%switches - walk%kinks
         values = walk%new_switches - walk%kinks
         do i = 1, size(values)
            ! A switch that has kept its sign up to the first kink so far has none before
            if (.not. values(i)*starts(i) < 0.0_wp) cycle
            call start_bracket(bracket, 0.0_wp, place, starts(i), values(i), past_zero)
            status = 0
            do while (bracket%status == root_wanted .and. status == 0)
               call evaluate(bracket%trial)
               if (status == 0) call narrow_bracket(bracket, values(i))
            end do
            if (status /= 0) exit
            place = min(place, bracket%trial + past_zero)
            if (.not. any((walk%new_switches(i + 1:) - walk%kinks(i + 1:))*starts(i + 1:) < 0.0_wp)) exit
            call evaluate(place)
            if (status /= 0) exit
         end do
      end associate
      ! A switch that is zero by a few roundings where the step begins is past it
      if (walk%kink <= 4.0_wp*past_zero) walk%kink = 2.0_wp

   contains

      !> Switches and markers on the step's curve.
      subroutine evaluate(part)
         !> Place in the step [-]
         real(wp), intent(in) :: part

         associate (step => walk%step, m => problem%switches + problem%markers)
            step%inner_state(:) = curve_state(step%state, step%new_state, step%curve, part)
            call problem%get_switches(step%time + part*step%length, step%inner_state, values(:m), status)
            values(:m) = values(:m) - walk%kinks(:m)
         end associate
      end subroutine evaluate

   end subroutine find_first_kink

end module camroller_ode_switching
