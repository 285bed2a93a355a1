!> Fraction of a disturbance of the roller's spin that is left after one cycle.
!>
!> In: a cycle's trajectory. Out: the contraction factor c. A cycle whose end differs from its start by d differs by `d/(1 - c)`
!> from the periodic one at its start: with little damping of the spin, a small difference between start and end does not prove
!> periodicity.
module camroller_contraction
   use camroller_kinds, only : wp
   use camroller_spin, only : spin_problem_t
   use camroller_stick_slip, only : phase_t, direction_at
   use camroller_trajectory, only : trajectory_t
   implicit none
   private

   public :: largest_contraction

   !> Decay over a cycle beyond which `1/(1 - c)` is one to a hundredth [-]
   real(wp), parameter :: enough = 5.0_wp
   !> Disturbance over the largest state, below which rounding hides what it does to the rate [-]
   real(wp), parameter :: least_difference = 1.0e-10_wp

contains

   !> Upper bound of the part of a disturbance that a cycle leaves: `exp(-integral of the decay rate)`, with the smaller of the
   !> rates at both ends of each step. It looks at as many steps as settle the matter, few as a rule, since cycles start where the
   !> decay is fastest. A roller that sticks forgets everything.
   !>
   !> Where traction saturates within less than the disturbance in question, the slope at a point says nothing of how that decays,
   !> and the mean slope over it counts.
   subroutine largest_contraction(problem, trajectory, phases, difference, contraction, evaluations)
      !> The roller's spin
      type(spin_problem_t), intent(in) :: problem
      !> Accepted points of the cycle
      type(trajectory_t), intent(in) :: trajectory
      !> Phases of sliding and sticking, where boundary friction is set-valued
      type(phase_t), allocatable, intent(in) :: phases(:)
      !> The disturbance [m/s]
      real(wp), intent(in) :: difference
      !> The contraction [-]
      real(wp), intent(out) :: contraction
      !> Evaluations of the contact, counted on
      integer, intent(inout) :: evaluations

      type(spin_problem_t) :: local
      ! Decay up to a point [-]; decay rates at both ends of a step [1/rad]
      real(wp) :: decay, rate, rate_before
      integer :: point

      contraction = 0.0_wp
      local = problem
      if (allocated(phases)) then
         if (any(phases%direction == 0)) return
      end if
      decay = 0.0_wp
      rate_before = 0.0_wp
      do point = 1, trajectory%count
         if (allocated(phases)) local%mobilised = real(direction_at(phases, trajectory%time(point)), wp)
         call local%get_decay_rate(trajectory%time(point), trajectory%state(:, point), rate)
         evaluations = evaluations + 1
         if (abs(difference) > least_difference*maxval(abs(trajectory%state(1, :trajectory%count)))) then
            call lower_rate(local, trajectory%time(point), trajectory%state(1, point), difference, rate, evaluations)
         end if
         rate = max(rate, 0.0_wp)
         if (point > 1) decay = decay + min(rate_before, rate)*(trajectory%time(point) - trajectory%time(point - 1))
         if (decay > enough) exit
         rate_before = rate
      end do
      contraction = exp(-decay)
   end subroutine largest_contraction

   !> Take the mean decay rate over a disturbance where that is less than the rate at its start.
   subroutine lower_rate(problem, time, state, difference, rate, evaluations)
      !> The roller's spin
      type(spin_problem_t), intent(in) :: problem
      !> Cam angle [rad]
      real(wp), intent(in) :: time
      !> Sliding speed, the disturbance [m/s]
      real(wp), intent(in) :: state, difference
      !> Decay rate [1/rad]
      real(wp), intent(inout) :: rate
      !> Evaluations of the contact, counted on
      integer, intent(inout) :: evaluations

      type(spin_problem_t) :: exact
      ! Rates of change without and with the disturbance [m/s/rad]
      real(wp) :: here(1), there(1)
      integer :: status

      exact = problem
      exact%accuracy = 0.0_wp
      call exact%get_rate(time, [state], here, status)
      if (status == 0) call exact%get_rate(time, [state + difference], there, status)
      evaluations = evaluations + 2
      if (status == 0) rate = min(rate, (here(1) - there(1))/difference)
   end subroutine lower_rate

end module camroller_contraction
