!> Points that an integration has accepted, and the curve through them.
!>
!> Layer: numerics. In: time, state and rate at each accepted point. Out: the state at any time between, by cubic
!> Hermite interpolation on the rates, or linear where the method itself is no better.
module camroller_trajectory
   use camroller_kinds, only : wp
   implicit none
   private

   public :: trajectory_t, start_trajectory, append_point, interpolate_state

   !> Accepted points, in order of time; at a kink of the rate two points share a time
   type :: trajectory_t
      !> Number of points in use
      integer :: count = 0
      !> Time of each point [time]
      real(wp), allocatable :: time(:)
      !> State at each point, shape (component, point) [state]
      real(wp), allocatable :: state(:, :)
      !> Rate at each point, shape (component, point) [state/time]
      real(wp), allocatable :: rate(:, :)
      !> Interpolate linearly?
      logical :: is_linear = .false.
   end type trajectory_t

   !> Points for which a new trajectory has room
   integer, parameter :: first_room = 512

contains

   !> Empty a trajectory; its memory is kept.
   subroutine start_trajectory(trajectory, components)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Number of components of the state
      integer, intent(in) :: components

      trajectory%count = 0
      if (allocated(trajectory%state)) then
         if (size(trajectory%state, 1) == components) return
         deallocate (trajectory%time, trajectory%state, trajectory%rate)
      end if
      allocate (trajectory%time(first_room), trajectory%state(components, first_room), trajectory%rate(components, &
         first_room))
   end subroutine start_trajectory

   !> Append a point.
   subroutine append_point(trajectory, time, state, rate)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Time, not before the last point [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate [state/time]
      real(wp), intent(in) :: rate(:)

      if (trajectory%count == size(trajectory%time)) call grow(trajectory)
      trajectory%count = trajectory%count + 1
      trajectory%time(trajectory%count) = time
      trajectory%state(:, trajectory%count) = state
      trajectory%rate(:, trajectory%count) = rate
   end subroutine append_point

   !> Twice the room.
   subroutine grow(trajectory)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory

      ! Larger copies [time], [state], [state/time]
      real(wp), allocatable :: time(:), state(:, :), rate(:, :)
      integer :: n

      n = trajectory%count
      allocate (time(2*n), state(size(trajectory%state, 1), 2*n), rate(size(trajectory%state, 1), 2*n))
      time(:n) = trajectory%time
      state(:, :n) = trajectory%state
      rate(:, :n) = trajectory%rate
      call move_alloc(time, trajectory%time)
      call move_alloc(state, trajectory%state)
      call move_alloc(rate, trajectory%rate)
   end subroutine grow

   !> State at a time inside the trajectory; the search starts from a hint, so that rising times cost nothing.
   pure subroutine interpolate_state(trajectory, time, hint, state)
      !> The trajectory, with two points at least
      type(trajectory_t), intent(in) :: trajectory
      !> Time, between the first and the last point [time]
      real(wp), intent(in) :: time
      !> Interval where the search starts; out: interval that holds the time
      integer, intent(inout) :: hint
      !> State there [state]
      real(wp), intent(out) :: state(:)

      ! Length of the interval [time], place in it [-]
      real(wp) :: length, place

      call find_interval(trajectory%time(:trajectory%count), time, hint)
      length = trajectory%time(hint + 1) - trajectory%time(hint)
      if (length <= 0.0_wp) then
         state = trajectory%state(:, hint)
         return
      end if
      place = (time - trajectory%time(hint))/length
      associate (left => trajectory%state(:, hint), right => trajectory%state(:, hint + 1))
         state = left + place*(right - left)
         if (trajectory%is_linear) return
         state = state + place*(1.0_wp - place)*((1.0_wp - place)*(length*trajectory%rate(:, hint) - (right - left)) &
            & - place*(length*trajectory%rate(:, hint + 1) - (right - left)))
      end associate
   end subroutine interpolate_state

   !> Interval of a table of rising times that holds a time: a few steps from the hint, else by bisection.
   pure subroutine find_interval(times, time, hint)
      !> Rising times [time]
      real(wp), intent(in) :: times(:)
      !> Time looked for [time]
      real(wp), intent(in) :: time
      !> In: where to start; out: interval
      integer, intent(inout) :: hint

      ! Most steps from the hint before bisection
      integer, parameter :: patience = 8
      integer :: low, high, middle, i

      hint = min(max(hint, 1), size(times) - 1)
      do i = 1, patience
         if (time > times(hint + 1) .and. hint < size(times) - 1) then
            hint = hint + 1
         else if (time < times(hint) .and. hint > 1) then
            hint = hint - 1
         else
            return
         end if
      end do
      low = 1
      high = size(times)
      do while (high - low > 1)
         middle = (low + high)/2
         if (times(middle) <= time) then
            low = middle
         else
            high = middle
         end if
      end do
      hint = low
   end subroutine find_interval

end module camroller_trajectory
