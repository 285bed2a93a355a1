!> Checks on a step beyond its own error estimate: has it missed where the rate saturates, or where the decay ends?
!>
!> Layer: numerics. In: rate with its derivatives at both ends of a step, its curve. Out: its error over the tolerance, raised where
!> there is reason to.
module camroller_step_checks
   use camroller_kinds, only : wp
   use camroller_ode_problem, only : linear_t
   use camroller_trajectory, only : curve_numbers, most_bends
   implicit none
   private

   public :: check_saturation, check_end

   !> Departure from the linear rate over span and size of the rate, up to which a step is taken to have seen a saturation [-]
   real(wp), parameter :: largest_departure = 0.5_wp
   !> Part of the error of a curve's slope at its end that counts: curves are of lower order than the states that they join [-]
   real(wp), parameter :: part_of_curve = 1.0e-2_wp

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

end module camroller_step_checks
