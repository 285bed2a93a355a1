!> Energy over a cycle: what comes in, what is lost and what is stored balance at every angle.
!>
!> In: a case. Out: states at even angles of its cycle, for what else a test asks of them.
module energy_checks
   use testdrive, only : check, error_type, test_failed
   use camroller_kinds, only : wp, two_pi
   use camroller_case, only : case_t
   use camroller_cycle, only : cycle_t, state_at
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t
   use camroller_torque_list, only : of_needle, of_residual
   use closeness, only : check_scaled
   use reference_cases, only : make_cycle, make_model, point_speeds, point_viscosities, set_point
   implicit none
   private

   public :: check_energy, check_bearing_energy

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

   !> The same for a roller's bearing in oil of three temperatures, the last time so fast that contact is lost; and the bearing
   !> takes power.
   subroutine check_bearing_energy(cases, least_share, error)
      !> Three cases; they get their points
      type(case_t), intent(inout) :: cases(:)
      !> Least part of the power lost that the bearing takes [-]
      real(wp), intent(in) :: least_share
      !> A residual, or a bearing that does nothing
      type(error_type), allocatable, intent(out) :: error

      type(state_t), allocatable :: states(:)
      real(wp) :: lost, by_bearing ! Mean power lost, that of the bearing [W]
      integer :: i, k

      do k = 1, size(cases)
         call set_point(cases(k), merge(6.0_wp, 1.0_wp, k == size(cases))*point_speeds(3), point_viscosities(k))
         call check_energy(cases(k), states, error, lost)
         if (allocated(error)) return
         by_bearing = sum([(states(i)%torques(of_needle), i=1, angles)])/angles*cases(k)%operating_point%speed
         call check(error, by_bearing > least_share*lost, "the bearing takes no power")
         if (allocated(error)) return
         call check(error, all(states%contact%is_touching) .neqv. k == size(cases), "contact is lost at the last point alone")
         if (allocated(error)) return
      end do
   end subroutine check_bearing_energy

end module energy_checks
