!> Checks on a step beyond its own error estimate: has it missed where the rate saturates, or where the decay ends?
!>
!> Layer: numerics. In: rate with its derivatives at both ends of a step, its curve. Out: its error over the tolerance, raised where
!> there is reason to.
module camroller_step_checks
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : problem_t, linear_t, counters_t
   use camroller_trajectory, only : curve_numbers, most_bends, curve_state
   implicit none
   private

   public :: check_saturation, check_end, check_middle

   !> Departure from the linear rate over span and size of the rate, up to which a step is taken to have seen a saturation [-]
   real(wp), parameter :: largest_departure = 0.5_wp
   !> Part of the error of a curve's slope at its end that counts: curves are of lower order than the states that they join [-]
   real(wp), parameter :: part_of_curve = 1.0e-2_wp
   !> Part of the error of a curve in its middle that counts [-]
   real(wp), parameter :: part_of_middle = 0.1_wp

contains

   !> Raise the error of a step that crosses a range of the state within which the rate saturates, without seeing it.
   !>
   !> Two signs: an error of the state that the Jacobian turns into more than the allowed error of the rate, and a rate at
   !> the end that is far from the linear one. Without them a step may jump from one side of a narrow range to the other,
   !> again and again.
   pure subroutine check_saturation(here, there, error_order, step, rate, change, new_rate, estimate, scaled_error)
      !> Rate with its derivatives at the start and at the end
      type(linear_t), intent(in) :: here, there
      !> Order of the error estimate plus one
      integer, intent(in) :: error_order
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Rate at the start [state/time], change of the state [state], rate at the end [state/time]
      real(wp), intent(in) :: rate(:), change(:), new_rate(:)
      !> Error of the step [state]
      real(wp), intent(in) :: estimate(:)
      !> Error over tolerance [-]
      real(wp), intent(inout) :: scaled_error

      ! Departure from the linear rate, error of the rate, and size of the rates [state/time]
      real(wp) :: departure, error, span
      integer :: i

      span = here%span
      if (there%span < huge(1.0_wp)) span = max(span, there%span)
      do i = 1, size(change)
         associate (row => here%jacobian(i, :), size_of_rate => span + abs(rate(i)) + abs(new_rate(i)))
            if (.not. size_of_rate > 0.0_wp) cycle
            departure = new_rate(i) - rate(i) - sum(row*change) - here%time_slope(i)*step
            error = sum(row*estimate)
            scaled_error = max(scaled_error, abs(error)/(here%resolution*size_of_rate), &
               & (abs(departure)/(largest_departure*size_of_rate))**error_order)
         end associate
      end do
   end subroutine check_saturation

   !> Raise the error of a step whose curve ends with a slope far from the rate there.
   !>
   !> Where the decay collapses within a step, all stages may lie before, and the end is a state that does not stay. What is left of
   !> the rate there tells: over the decay rate at the end, or over the step where that is slow, it is an error of the state.
   pure subroutine check_end(there, bends, tolerance, step, change, new_rate, scaled_error)
      !> Rate with its derivatives at the end
      type(linear_t), intent(in) :: there
      !> Curve of the step, as a trajectory takes it, shape (component, numbers given) [state]; error allowed [state]
      real(wp), intent(in) :: bends(:, :), tolerance(:)
      !> Size of the step [time]
      real(wp), intent(in) :: step
      !> Change of the state over the step [state], rate at the end [state/time]
      real(wp), intent(in) :: change(:), new_rate(:)
      !> Error over tolerance [-]
      real(wp), intent(inout) :: scaled_error

      ! Slope of the curve at the end less the rate there [state/time]
      real(wp) :: defect
      integer :: i

      do i = 1, size(change)
         defect = (change(i) - sum(bends(i, :min(size(bends, 2), most_bends))))/step - new_rate(i)
         if (size(bends, 2) == curve_numbers) then
            associate (height => bends(i, curve_numbers - 1), exponent => bends(i, curve_numbers))
               defect = defect + height*(1.0_wp + (exponent - 1.0_wp)*exp(exponent))/step
            end associate
         end if
         scaled_error = max(scaled_error, &
            & part_of_curve*abs(defect)/((abs(there%jacobian(i, i)) + 1.0_wp/step)*tolerance(i)))
      end do
   end subroutine check_end

   !> Raise the error of a step whose curve does not satisfy the equation in its middle.
   !>
   !> Where the decay is fast, the state at the end is right whatever the step, and the error estimate, which is that of the end,
   !> says nothing of the curve between. The middle is looked at where the size of the step is not the estimate's choice and the
   !> decay is fast at both ends.
   subroutine check_middle(problem, here, there, bends, tolerance, time, step, state, new_state, counters, scaled_error)
      !> The problem
      class(problem_t), intent(in) :: problem
      !> Rate with its derivatives at both ends
      type(linear_t), intent(in) :: here, there
      !> Curve of the step, as a trajectory takes it, shape (component, numbers given) [state]; error allowed [state]
      real(wp), intent(in) :: bends(:, :), tolerance(:)
      !> Start and size of the step [time]
      real(wp), intent(in) :: time, step
      !> State at the start and at the end [state]
      real(wp), intent(in) :: state(:), new_state(:)
      !> Work done so far
      type(counters_t), intent(inout) :: counters
      !> Error over tolerance [-]
      real(wp), intent(inout) :: scaled_error

      ! Decay exponent of a step from which on the end forgets the start [-]
      real(wp), parameter :: fast_decay = 10.0_wp
      ! Places beside the middle between which a slope is taken [-]
      real(wp), parameter :: left = 0.499_wp, right = 0.501_wp
      ! The curve with all its numbers, those that are not given zero [state]
      real(wp) :: curve(size(state), curve_numbers)
      ! Rate in the middle [state/time], slope of the curve less that rate [state/time], decay rate [1/time]
      real(wp) :: rate(size(state)), defect(size(state)), decay
      integer :: i, status

      if (any([(step*min(abs(here%jacobian(i, i)), abs(there%jacobian(i, i))) < fast_decay, i=1, size(state))])) return
      curve = 0.0_wp
      curve(:, :size(bends, 2)) = bends
      call problem%get_rate(time + 0.5_wp*step, curve_state(state, new_state, curve, 0.5_wp), rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      defect = (curve_state(state, new_state, curve, right) - curve_state(state, new_state, curve, left)) &
         & /((right - left)*step) - rate
      do i = 1, size(state)
         decay = max(abs(here%jacobian(i, i)), abs(there%jacobian(i, i))) + 1.0_wp/step
         scaled_error = max(scaled_error, part_of_middle*abs(defect(i))/(decay*tolerance(i)))
      end do
   end subroutine check_middle

end module camroller_step_checks
