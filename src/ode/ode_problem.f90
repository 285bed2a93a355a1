!> Abstract type of an initial value problem: right-hand side, Jacobian and counters of the work.
!>
!> In: nothing. Out: `problem_t`, which problems extend, `linear_t` and `counters_t`. By default the Jacobian is a difference
!> quotient. A problem with an exact Jacobian overrides `get_jacobian`, or `linearise` where rate and Jacobian are computed
!> together. A problem whose Jacobian has a structure overrides `factorise` and `solve`.
!>
!> Status of a rate: 0 valid; positive "the trial state is not admissible, try a smaller step"; negative "the problem cannot be
!> evaluated, end".
module camroller_ode_problem
   use camroller_kinds, only : wp
   use camroller_lapack, only : dgetrf, dgetrs
   implicit none
   private

   public :: problem_t, linear_t, counters_t, factors_t, new_linear, copy_linear, new_factors, time_increment
   public :: words_length

   !> Length of a time in words
   integer, parameter :: words_length = 48

   !> Right-hand side of `d state/d time = rate(time, state)`
   type, abstract :: problem_t
      !> Size of each component below which differences between states stop to matter, for difference quotients; 1 where not
      !> allocated; the decay rate is found in units of them [state]
      real(wp), allocatable :: small_state(:)
      !> Components at the end of the state that are integrals: no rate depends on them
      integer :: integrals = 0
      !> Barrier, see `get_clearance`: at time zero, huge where there is none [state]; its slope [state/time]
      real(wp) :: barrier = huge(1.0_wp), barrier_slope = 0.0_wp
   contains
      procedure(rate_interface), deferred :: get_rate
      procedure(words_interface), deferred :: name_time
      procedure :: get_decay_rate => bound_decay_rate
      procedure :: get_jacobian => difference_jacobian
      procedure :: linearise => linearise_in_two
      procedure :: get_clearance => clearance_of_line
      procedure :: factorise => factorise_dense
      procedure :: solve => solve_dense
   end type problem_t

   !> Rate at a point with its first derivatives
   type :: linear_t
      !> Rate [state/time]
      real(wp), allocatable :: rate(:)
      !> Derivative of the rates (row) with respect to the state (column) [1/time]
      real(wp), allocatable :: jacobian(:, :)
      !> Derivative of the rates with respect to time [state/time^2]
      real(wp), allocatable :: time_slope(:)
      !> Part of the rate that saturates within a narrow range of the state, its size; huge where nothing does. Errors of the
      !> state that are small against the largest state may then still throw the rate from one end of its range to the other
      !> [state/time]
      real(wp) :: span = huge(1.0_wp)
      !> Error of the rate that is allowed for an error of the state, over the rate, where something saturates [-]
      real(wp) :: resolution = 1.0_wp
      !> Component of the state whose rate that is
      integer :: saturating = 1
      !> Width of the range within which it saturates [state]
      real(wp) :: width = 0.0_wp
      !> From the first component to the barrier, see `get_clearance` [state]
      real(wp) :: clearance = huge(1.0_wp)
   end type linear_t

   !> Factors of the matrix `shift I - jacobian`
   type :: factors_t
      !> The shift [1/time]
      real(wp) :: shift = 0.0_wp
      !> Factors of the matrix [1/time], or the inverse of what is left of it where some components are eliminated beforehand [time]
      real(wp), allocatable :: matrix(:, :)
      !> Pivots of the factors
      integer, allocatable :: pivots(:)
      !> 1 over the pivots of components that are eliminated beforehand [time]
      real(wp), allocatable :: eliminated(:)
   end type factors_t

   !> Work done, comparable between machines
   type :: counters_t
      !> Calls of the right-hand side, those for difference quotients included
      integer :: evaluations = 0
      !> Calls for the decay rate, which cost about as much as a call of the right-hand side
      integer :: decay_rates = 0
      !> Jacobians formed
      integer :: jacobians = 0
      !> Matrices factorised
      integer :: factorisations = 0
      !> Steps accepted
      integer :: accepted = 0
      !> Steps rejected
      integer :: rejected = 0
   end type counters_t

   abstract interface
      !> Rate of change of the state
      subroutine rate_interface(self, time, state, rate, status)
         import :: problem_t, wp
         !> The problem; read only
         class(problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> State [state]
         real(wp), intent(in) :: state(:)
         !> Rate of change [state/time]
         real(wp), intent(out) :: rate(:)
         !> 0 fine, positive: try a smaller step, negative: give up
         integer, intent(out) :: status
      end subroutine rate_interface

      !> A time in the words of messages, e.g. `cam angle 214.5 deg`
      function words_interface(self, time) result(text)
         import :: problem_t, wp, words_length
         !> The problem; read only
         class(problem_t), intent(in) :: self
         !> Time [time]
         real(wp), intent(in) :: time
         !> It in words
         character(len=words_length) :: text
      end function words_interface
   end interface

contains

   !> Room for a rate with its derivatives.
   pure subroutine new_linear(linear, components)
      !> Rate and derivatives, out: zero; room that is right is kept
      type(linear_t), intent(inout) :: linear
      !> Number of components of the state
      integer, intent(in) :: components

      if (allocated(linear%rate)) then
         if (size(linear%rate) /= components) deallocate (linear%rate, linear%jacobian, linear%time_slope)
      end if
      if (.not. allocated(linear%rate)) allocate (linear%rate(components), linear%jacobian(components, components), &
         & linear%time_slope(components))
      linear%rate = 0.0_wp
      linear%jacobian = 0.0_wp
      linear%time_slope = 0.0_wp
      linear%span = huge(1.0_wp)
      linear%resolution = 1.0_wp
      linear%saturating = 1
      linear%width = 0.0_wp
      linear%clearance = huge(1.0_wp)
   end subroutine new_linear

   !> Room for factors.
   pure subroutine new_factors(factors, components)
      !> The factors
      type(factors_t), intent(out) :: factors
      !> Number of components of the state
      integer, intent(in) :: components

      allocate (factors%matrix(components, components), factors%pivots(components), factors%eliminated(components))
   end subroutine new_factors

   !> Copy a rate and its derivatives, the clearance alone where there are none.
   pure subroutine copy_linear(source, target)
      !> From here
      type(linear_t), intent(in) :: source
      !> To here; has its room
      type(linear_t), intent(inout) :: target

      target%clearance = source%clearance
      if (.not. allocated(source%rate)) return
      target%rate(:) = source%rate
      target%jacobian(:, :) = source%jacobian
      target%time_slope(:) = source%time_slope
      target%span = source%span
      target%resolution = source%resolution
      target%saturating = source%saturating
      target%width = source%width
   end subroutine copy_linear

   !> Rate and its derivatives, one after the other.
   !>
   !> A problem that gets both from one evaluation, or whose rate saturates, overrides this.
   subroutine linearise_in_two(self, time, state, horizon, linear, counters, status)
      !> The problem; read only
      class(problem_t), intent(in) :: self
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Time up to which the right-hand side is smooth; later times are not evaluated [time]
      real(wp), intent(in) :: horizon
      !> Rate and derivatives; has its room
      type(linear_t), intent(inout) :: linear
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      call self%get_clearance(time, state, linear%clearance)
      call self%get_rate(time, state, linear%rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      call self%get_jacobian(time, state, linear%rate, horizon, linear%jacobian, linear%time_slope, counters, status)
   end subroutine linearise_in_two

   !> Fastest decay rate at a state: the size of the largest eigenvalue of the Jacobian, at most, by the sums over its rows
   !> (Gershgorin) in units of `small_state`. Zero where the rate cannot be evaluated.
   !>
   !> A problem that knows better overrides this.
   subroutine bound_decay_rate(self, time, state, decay_rate)
      !> The problem; read only
      class(problem_t), intent(in) :: self
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Decay rate [1/time]
      real(wp), intent(out) :: decay_rate

      type(linear_t) :: linear
      type(counters_t) :: counters
      ! Units of the components [state]
      real(wp) :: units(size(state))
      integer :: i, status

      units = 1.0_wp
      if (allocated(self%small_state)) units = self%small_state
      decay_rate = 0.0_wp
      call new_linear(linear, size(state))
      call self%linearise(time, state, time, linear, counters, status)
      if (status /= 0) return
      do i = 1, size(state)
         decay_rate = max(decay_rate, sum(abs(linear%jacobian(i, :))*units)/units(i))
      end do
   end subroutine bound_decay_rate

   !> Factors of the matrix `shift I - jacobian`; a single component needs none.
   subroutine factorise_dense(self, linear, shift, factors, status)
      !> The problem, of whose structure nothing is known here
      class(problem_t), intent(in) :: self
      !> Rate and derivatives
      type(linear_t), intent(in) :: linear
      !> The shift [1/time]
      real(wp), intent(in) :: shift
      !> Factors; have their room
      type(factors_t), intent(inout) :: factors
      !> 0 fine, positive where the matrix is singular
      integer, intent(out) :: status

      integer :: i, n

      associate (without_structure => self)
         n = size(linear%rate)
      end associate
      factors%shift = shift
      factors%matrix(:, :) = -linear%jacobian
      do i = 1, n
         factors%matrix(i, i) = factors%matrix(i, i) + shift
      end do
      status = 0
      if (n == 1) then
         if (.not. abs(factors%matrix(1, 1)) > 0.0_wp) status = 1
      else
         call dgetrf(n, n, factors%matrix, n, factors%pivots, status)
      end if
   end subroutine factorise_dense

   !> Solve with the factors.
   subroutine solve_dense(self, linear, factors, right_side)
      !> The problem, of whose structure nothing is known here
      class(problem_t), intent(in) :: self
      !> Rate and derivatives of which the factors are
      type(linear_t), intent(in) :: linear
      type(factors_t), intent(in) :: factors
      !> In: right-hand side [state/time]; out: solution [state]
      real(wp), intent(inout) :: right_side(:)

      integer :: info, n

      associate (without_structure => self)
         n = size(linear%rate)
      end associate
      if (n == 1) then
         right_side = right_side/factors%matrix(1, 1)
      else
         call dgetrs("N", n, 1, factors%matrix, n, factors%pivots, right_side, n, info)
      end if
   end subroutine solve_dense

   !> From the first component to its barrier: a place about which the rate may differ so much within so narrow a range that the
   !> state is held there, and that a step may cross without an evaluation there.
   !>
   !> A barrier that is no straight line over time overrides this; `linearise` fills in `clearance` where it is overridden.
   subroutine clearance_of_line(self, time, state, clearance)
      !> The problem; read only
      class(problem_t), intent(in) :: self
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> State at the barrier less the state; huge where there is none [state]
      real(wp), intent(out) :: clearance

      clearance = self%barrier + self%barrier_slope*time - state(1)
   end subroutine clearance_of_line

   !> Jacobian and slope with time by forward differences.
   !>
   !> Increments are the square root of the rounding unit times the size of the variable, which balances truncation
   !> against rounding: half of the figures of a rate are right in the quotient.
   subroutine difference_jacobian(self, time, state, rate, horizon, jacobian, time_slope, counters, status)
      !> The problem; read only
      class(problem_t), intent(in) :: self
      !> Time [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate there [state/time]
      real(wp), intent(in) :: rate(:)
      !> Time up to which the right-hand side is smooth; later times are not evaluated [time]
      real(wp), intent(in) :: horizon
      !> Derivative of the rates (row) with respect to the state (column) [1/time]
      real(wp), intent(out) :: jacobian(:, :)
      !> Derivative of the rates with respect to time [state/time^2]
      real(wp), intent(out) :: time_slope(:)
      !> Work done
      type(counters_t), intent(inout) :: counters
      !> 0 fine, positive: try a smaller step, negative: give up
      integer, intent(out) :: status

      ! State moved [state], time moved [time], rate there [state/time]
      real(wp) :: moved_state(size(state)), moved_time, moved_rate(size(state))
      ! Size of a component [state]
      real(wp) :: small_state
      integer :: i

      counters%jacobians = counters%jacobians + 1
      moved_state = state
      do i = 1, size(state)
         small_state = 1.0_wp
         if (allocated(self%small_state)) small_state = self%small_state(i)
         moved_state(i) = state(i) + sqrt(epsilon(1.0_wp))*max(abs(state(i)), small_state)
         call self%get_rate(time, moved_state, moved_rate, status)
         counters%evaluations = counters%evaluations + 1
         if (status /= 0) return
         jacobian(:, i) = (moved_rate - rate)/(moved_state(i) - state(i))
         moved_state(i) = state(i)
      end do
      moved_time = time + time_increment(time, horizon)
      call self%get_rate(moved_time, state, moved_rate, status)
      counters%evaluations = counters%evaluations + 1
      if (status /= 0) return
      time_slope = (moved_rate - rate)/(moved_time - time)
   end subroutine difference_jacobian

   !> Increment of time for a difference that stays this side of the horizon: forward, at the horizon itself backward.
   pure function time_increment(time, horizon) result(increment)
      !> Time [time]
      real(wp), intent(in) :: time
      !> Time not to be passed, some roundings ahead at least [time]
      real(wp), intent(in) :: horizon
      !> Increment, exact in the time it leads to [time]
      real(wp) :: increment

      if (horizon > time) then
         increment = sqrt(epsilon(1.0_wp))*max(abs(time), horizon - time)
         increment = max(min(increment, 0.5_wp*(horizon - time)), spacing(time))
      else
         increment = -sqrt(epsilon(1.0_wp))*abs(time)
      end if
      increment = (time + increment) - time
   end function time_increment

end module camroller_ode_problem
