!> Energy over a cycle: what comes in, what is lost and what is stored balance at every angle.
!>
!> In: a case. Out: states at even angles of its cycle, for what else a test asks of them.
module energy_checks
   use testdrive, only : error_type, test_failed
   use camroller_kinds, only : wp, two_pi
   use camroller_case, only : case_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_torque_list, only : of_residual
   use closeness, only : check_scaled
   use reference_cases, only : make_cycle, make_model
   implicit none
   private

   public :: check_energy

   !> Angles of a cycle
   integer, parameter :: angles = 720
   !> Largest residual over the mean power lost [-]: round-off of a stored power that is up to 1e3 times larger
   real(wp), parameter :: tolerance = 1.0e-10_wp

contains

   !> Check that no angle of a cycle has an energy residual.
   subroutine check_energy(the_case, states, error, power_lost)
      !> The case
      type(case_t), intent(in) :: the_case
      !> States of its cycle
      type(state_t), allocatable, intent(out) :: states(:)
      !> No state, or a residual
      type(error_type), allocatable, intent(out) :: error
      !> Mean power lost [W]
      real(wp), intent(out), optional :: power_lost

      type(model_t) :: model
      type(cycle_t) :: cycle
      type(error_t), allocatable :: failure
      real(wp) :: lost ! [W]
      integer :: i, hint

      if (present(power_lost)) power_lost = 0.0_wp
      call make_model(the_case, model, error)
      if (allocated(error)) return
      call make_cycle(the_case, model, cycle, error)
      if (allocated(error)) return
      allocate (states(angles))
      hint = 1
      do i = 1, angles
         call state_at(cycle, model, (i - 1)*two_pi/angles, hint, states(i), failure)
         if (allocated(failure)) call test_failed(error, failure%message)
         if (allocated(error)) return
      end do
      lost = sum(states%torque_friction)*model%speed/angles
      call check_scaled(error, maxval([(abs(states(i)%torques(of_residual)), i=1, angles)]), 0.0_wp, lost, tolerance, &
         & "largest energy residual")
      if (present(power_lost)) power_lost = lost
   end subroutine check_energy

end module energy_checks
