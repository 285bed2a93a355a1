!> Sliding speed that is consistent with the slope of the solution where traction saturates within less than the error of the
!> solution.
!>
!> In: model, cam angle, sliding speed and slope of the solution there. Out: the sliding speed nearby at which the roller
!> equation has that slope. A difference of 1e-15 m/s in the sliding speed decides between traction below and at its limit: an
!> error that is negligible for the slip is large for the traction.
module camroller_settled_slip
   use camroller_contact_traction, only : largest_traction_rate
   use camroller_kinds, only : two_pi, wp
   use camroller_model, only : model_t
   use camroller_ode_bridge, only : solve_euler
   use camroller_ode_problem, only : counters_t
   use camroller_spin, only : nearby_t, spin_problem_t, slip_rate
   use camroller_state, only : state_t
   implicit none
   private

   public :: settle

   !> Part of the largest traction by which the curve's own traction may be wrong [-]
   real(wp), parameter :: small_part = 1.0e-3_wp
   !> What is left of a difference of slopes that has settled [-]
   real(wp), parameter :: settled_part = 0.1_wp

contains

   !> Move a sliding speed to where the roller equation has the slope of the curve, within the error that the curve may have.
   !>
   !> That is one step of the implicit Euler method, so short that no traction moves the sliding speed further.
   subroutine settle(model, angle, slope, reach, state, sliding_speed, is_moved)
      !> The model
      type(model_t), intent(in), target :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Slope of the curve [m/s/rad]
      real(wp), intent(in) :: slope
      !> Error that the curve may have [m/s]
      real(wp), intent(in) :: reach
      !> State on the curve
      type(state_t), intent(in) :: state
      !> Sliding speed, from that of the curve [m/s]
      real(wp), intent(inout) :: sliding_speed
      !> Has it been moved?
      logical, intent(out) :: is_moved

      ! Rate at the curve, largest that traction makes [m/s/rad]
      real(wp) :: rate, span

      is_moved = .false.
      if (.not. state%contact%is_touching .or. .not. reach > 0.0_wp) return
      rate = slip_rate(model, state%position, state%spin_acceleration)
      span = largest_traction_rate(model, state%contact)
      if (abs(rate - slope) <= small_part*span) return
      call take_step(model, angle, slope, rate, span, reach, state, sliding_speed, is_moved)
   end subroutine settle

   !> Take that step. It is a procedure of its own since most sliding speeds are where they have to be, and its room is large.
   subroutine take_step(model, angle, slope, rate, span, reach, state, sliding_speed, is_moved)
      type(model_t), intent(in), target :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Slope of the curve, rate of the equation there, largest that traction makes [m/s/rad]
      real(wp), intent(in) :: slope, rate, span
      !> Error that the curve may have [m/s]
      real(wp), intent(in) :: reach
      !> State on the curve
      type(state_t), intent(in) :: state
      !> Sliding speed, from that of the curve [m/s]
      real(wp), intent(inout) :: sliding_speed
      !> Has it been moved?
      logical, intent(out) :: is_moved

      ! Relative error of load and forces, small against what is left of the equation in the end [-]
      real(wp), parameter :: accuracy = 1.0e-10_wp
      type(spin_problem_t) :: problem
      type(nearby_t), target :: nearby
      type(counters_t) :: counters
      ! Step [rad]; sliding speed in the end [m/s]; rate there [m/s/rad]
      real(wp) :: step, settled, new_rate
      integer :: status

      is_moved = .false.
      nearby%last = state%contact
      problem%nearby => nearby
      problem%model => model
      problem%accuracy = accuracy
      ! One turn at most, where forces are next to nothing
      step = reach/max(span + abs(slope), reach/two_pi)
      call solve_euler(problem, span, angle, sliding_speed - step*slope, step, settled, new_rate, counters, status)
      ! Where the traction does not saturate nearby, so short a step changes next to nothing
      if (status /= 0 .or. .not. abs(new_rate - slope) < settled_part*abs(rate - slope)) return
      sliding_speed = settled
      is_moved = .true.
   end subroutine take_step

end module camroller_settled_slip
