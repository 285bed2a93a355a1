!> Checks of a step in addition to its error estimate: did the step pass over a saturation of the rate, or an interval in which
!> the state is held at a barrier?
!>
!> In: rate with its derivatives at both ends of a step, its dense output. Out: the ratio of error to tolerance, raised where a
!> check fails.
module camroller_step_checks
   use camroller_error, only : error_t, kind_convergence, raise
   use camroller_kinds, only : wp
   use camroller_ode_method, only : method_t, options_t, step_t
   use camroller_ode_problem, only : problem_t, linear_t, counters_t
   use camroller_step_control, only : shortest_step
   use camroller_trajectory, only : curve_numbers, curve_state
   implicit none
   private

   public :: check_step, check_end, check_progress

   !> Error over tolerance that stands for a step that must be shorter [-]
   real(wp), parameter :: far_too_large = 1.0e3_wp

contains

   !> Refuse an integration that does not come on.
   subroutine check_progress(problem, options, time, proposed, counters, error)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> How many steps and evaluations it may take
      type(options_t), intent(in) :: options
      !> Time reached, step proposed [time]
      real(wp), intent(in) :: time, proposed
      !> Work done
      type(counters_t), intent(in) :: counters
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason

      if (counters%accepted + counters%rejected > options%max_steps) then
         reason = "the largest number of steps is reached"
      else if (counters%evaluations > options%max_evaluations) then
         reason = "the largest number of evaluations is reached"
      else if (proposed <= shortest_step*spacing(abs(time))) then
         reason = "the step size fell below its minimum"
      end if
      if (allocated(reason)) call raise(error, kind_convergence, reason//" at "//trim(problem%name_time(time)))
   end subroutine check_progress

   !> Raise the error of a step for which one of the checks finds a reason.
   subroutine check_step(problem, method, is_fixed, step, counters)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> The method after the step
      class(method_t), intent(inout) :: method
      !> Is the size of the step fixed?
      logical, intent(in) :: is_fixed
      !> The step
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters

      logical :: has_derivatives

      has_derivatives = method%needs_jacobian .and. (method%gives_rate .or. step%end_time < method%horizon)
      if (method%needs_jacobian .and. method%here%span < huge(1.0_wp)) then
         associate (here => method%here, i => method%here%saturating)
            call check_saturation(here, method%there, abs(here%jacobian(i, i)), step)
         end associate
      end if
      if (is_fixed .or. step%scaled_error > 1.0_wp) return
      if (.not. has_derivatives) call problem%get_clearance(step%end_time, step%new_state, method%there%clearance)
      associate (before => method%here%clearance, after => method%there%clearance)
         if (max(abs(before), abs(after)) >= huge(1.0_wp)) return
         if ((before >= 0.0_wp .eqv. after >= 0.0_wp) .or. .not. abs(before) > 0.0_wp) return
      end associate
      call check_barrier(problem, method, step, counters)
   end subroutine check_step

   !> The same for a step whose end is known with its derivatives before the step is accepted.
   !>
   !> A state that comes to the range at a large rate, to be held in it, may leave such a step on any side of it, by many times the
   !> error that the method estimates: its stages have met the one end of the rate and the other. Then the step changes the state by
   !> another rate than the mean of those at its ends. Where that which saturates moves the state by no more than the width of the
   !> range within the step, the range is as smooth as any law.
   pure subroutine check_end(here, there, step)
      !> Rate with its derivatives at the start and at the end
      type(linear_t), intent(in) :: here, there
      !> The step
      type(step_t), intent(inout) :: step

      ! Difference of both rates over what saturates [-]: with 0.2 three slides of two thousand pass the range all the same
      real(wp), parameter :: much = 0.1_wp
      ! What saturates, mean rate over the step less that of its ends [state/time]; derivative over the state [1/time]
      real(wp) :: span, difference, slope

      span = max(here%span, there%span)
      if (.not. span < huge(1.0_wp)) return
      associate (i => there%saturating)
         if (step%length*span > there%width) then
            difference = (step%new_state(i) - step%state(i))/step%length - 0.5_wp*(step%rate(i) + step%new_rate(i))
            if (abs(difference) > much*span) step%scaled_error = max(step%scaled_error, far_too_large)
         end if
         slope = max(abs(here%jacobian(i, i)), abs(there%jacobian(i, i)))
      end associate
      call check_saturation(here, there, slope, step)
   end subroutine check_end

   !> Raise the error of a step that crosses a range of the state within which the rate saturates, without seeing it.
   !>
   !> Its sign is an error of the state that the Jacobian turns into more than the allowed error of the rate. Without this check a
   !> step may jump from one side of a narrow range to the other, again and again.
   pure subroutine check_saturation(here, there, slope, step)
      !> Rate with its derivatives at the start and at the end
      type(linear_t), intent(in) :: here, there
      !> Size of the derivative of the rate that saturates over its own component [1/time]
      real(wp), intent(in) :: slope
      type(step_t), intent(inout) :: step

      ! Largest rate, and that with the rates at both ends [state/time]
      real(wp) :: span, size_of_rate

      span = here%span
      if (there%span < huge(1.0_wp)) span = max(span, there%span)
      associate (i => here%saturating)
         size_of_rate = span + abs(step%rate(i)) + abs(step%new_rate(i))
         if (size_of_rate > 0.0_wp) step%scaled_error = max(step%scaled_error, slope*abs(step%estimate(i)) &
            & /(here%resolution*size_of_rate))
      end associate
   end subroutine check_saturation

   !> Raise the error of a step that crosses the barrier of a problem where the state would have been held.
   !>
   !> What happens at a barrier may be too narrow for any step to meet it by chance. So where a step crosses it, the rate at the
   !> barrier itself, some roundings before it since the rate may have no limit there, is asked: if it moves the state back to where
   !> it came from, faster than the barrier moves, the step is wrong.
   subroutine check_barrier(problem, method, step, counters)
      class(problem_t), intent(in) :: problem
      !> The method after the step, with clearances of different signs at its ends; a step without a curve is a straight line
      class(method_t), intent(in) :: method
      type(step_t), intent(inout) :: step
      !> Work done so far
      type(counters_t), intent(inout) :: counters

      ! Distance of two places for a slope [-]
      real(wp), parameter :: apart = 1.0e-3_wp
      ! Roundings of a state [-]
      real(wp), parameter :: roundings = 4.0_wp
      ! The curve as a trajectory takes it; states on it, moved to the barrier at last [state]
      real(wp) :: curve(size(step%state), curve_numbers), between(size(step%state))
      ! Ends of a bracket and place of the crossing, places beside it [-]; clearances at these [state]
      real(wp) :: left, right, place, beside(2), clearance_left, clearance_right, clearance
      ! Places of the barrier [state]; its slope, rate there [state/time]
      real(wp) :: barriers(2), slope, rate(size(step%state))
      ! Times that the crossing is narrowed down
      integer, parameter :: few = 4
      integer :: i, status

      clearance_left = method%here%clearance
      clearance_right = method%there%clearance
      curve = 0.0_wp
      if (method%has_curve) curve(:, :size(method%bends, 2)) = method%bends
      left = 0.0_wp
      right = 1.0_wp
      do i = 1, few
         place = left + (right - left)*clearance_left/(clearance_left - clearance_right)
         between = curve_state(step%state, step%new_state, curve, place)
         call problem%get_clearance(step%time + place*step%length, between, clearance)
         if (i == few .or. abs(clearance) >= huge(1.0_wp)) exit
         if (clearance >= 0.0_wp .eqv. clearance_left >= 0.0_wp) then
            left = place
            clearance_left = clearance
         else
            right = place
            clearance_right = clearance
         end if
      end do
      if (abs(clearance) >= huge(1.0_wp)) return
      between(1) = between(1) + clearance
      between(1) = between(1) - sign(roundings*spacing(between(1)), method%here%clearance)
      call problem%get_rate(step%time + place*step%length, between, rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      beside = [max(place - apart, 0.0_wp), min(place + apart, 1.0_wp)]
      do i = 1, 2
         call problem%get_clearance(step%time + beside(i)*step%length, between, barriers(i))
      end do
      slope = (barriers(2) - barriers(1))/((beside(2) - beside(1))*step%length)
      if (sign(1.0_wp, method%here%clearance)*(slope - rate(1)) > 0.0_wp) step%scaled_error = max(step%scaled_error, far_too_large)
   end subroutine check_barrier

end module camroller_step_checks
