!> Accepted points of an integration, and the interpolation between them.
!>
!> In: time, state and rate at each accepted point. Out: the state at any time between, by the dense output of the method where
!> it has one, by cubic Hermite interpolation of states and rates where it has none, or linear where the method itself is of
!> first order.
!>
!> Between points `left` and `right`, at the relative position `p` in the interval, the interpolant is `left + p (right - left) +
!> p (1 - p) (b1 + p (b2 + p (b3 + p b4))) + a (exp(z p) - 1 - p (exp(z) - 1))` with the coefficients b1 to b4 and, if there is
!> one, a boundary layer of height a that decays with the exponent z.
module camroller_trajectory
   use camroller_kinds, only : wp
   implicit none
   private

   public :: trajectory_t, stop_margin, start_trajectory, release_room, append_cubic, append_curve, append_straight, append_until, &
      & interpolate_state, curve_state, curve_slope

   !> Accepted points, in order of time; at a stop, where rates may jump, two points are two margins apart (`stop_margin`)
   type :: trajectory_t
      !> Number of points in use
      integer :: count = 0
      !> Time of each point [time]
      real(wp), allocatable :: time(:)
      !> State at each point, shape (component, point) [state]
      real(wp), allocatable :: state(:, :)
      !> Rate at each point, shape (component, point) [state/time]
      real(wp), allocatable :: rate(:, :)
      !> Curve that ends at each point, shape (component, 6, point): bends b1 to b4, height of the layer [state], its exponent [-]
      real(wp), allocatable :: bends(:, :, :)
      !> Its exp(z) - 1, which each place on the curve takes, shape (component, point) [-]
      real(wp), allocatable :: rises(:, :)
      !> Interpolate linearly?
      logical :: is_linear = .false.
   end type trajectory_t

   !> Points for which a new trajectory has room
   integer, parameter :: first_room = 64
   !> Numbers that make a curve
   integer, parameter, public :: curve_numbers = 6
   !> A margin over the spacing of numbers at its stop [-]
   real(wp), parameter :: margin_spacings = 4.0_wp
   !> Shortest segment that is integrated, and longest interval that is no step but one that was passed over, over the margin at a
   !> stop: two margins more, and some for the margin's own rounding [-]
   real(wp), parameter, public :: least_segment = 64.0_wp
   real(wp), parameter :: longest_gap = least_segment + 16.0_wp

contains

   !> Distance from a stop at which integration ends before it and begins behind it, a few roundings: rates may jump there.
   pure function stop_margin(stops) result(margin)
      !> First and last stop at least [time]
      real(wp), intent(in) :: stops(:)
      !> The distance [time]
      real(wp) :: margin

      margin = margin_spacings*spacing(maxval(abs(stops)))
   end function stop_margin

   !> Empty a trajectory; its memory is kept.
   subroutine start_trajectory(trajectory, components)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Number of components of the state
      integer, intent(in) :: components

      trajectory%count = 0
      if (allocated(trajectory%state)) then
         if (size(trajectory%state, 1) == components) return
         deallocate (trajectory%time, trajectory%state, trajectory%rate, trajectory%bends, trajectory%rises)
      end if
      allocate (trajectory%time(first_room), trajectory%state(components, first_room), &
         & trajectory%rate(components, first_room), trajectory%bends(components, curve_numbers, first_room), &
         & trajectory%rises(components, first_room))
   end subroutine start_trajectory

   !> Empty a trajectory; of its memory no more is kept than what a new one has.
   pure subroutine release_room(trajectory)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory

      trajectory%count = 0
      if (.not. allocated(trajectory%time)) return
      if (size(trajectory%time) > first_room) deallocate (trajectory%time, trajectory%state, trajectory%rate, trajectory%bends, &
         & trajectory%rises)
   end subroutine release_room

   !> Append a point, reached by the cubic Hermite curve on the rates at both ends, or linearly.
   pure subroutine append_cubic(trajectory, time, state, rate)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Time, not before the last point [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate [state/time]
      real(wp), intent(in) :: rate(:)

      ! Length of the curve [time]; change of a component along it [state]
      real(wp) :: length, change
      integer :: i, last

      last = trajectory%count
      call append_straight(trajectory, time, state, rate)
      if (last == 0 .or. trajectory%is_linear) return
      length = time - trajectory%time(last)
      do i = 1, size(state)
         change = state(i) - trajectory%state(i, last)
         trajectory%bends(i, 1, last + 1) = length*trajectory%rate(i, last) - change
         trajectory%bends(i, 2, last + 1) = 2.0_wp*change - length*(trajectory%rate(i, last) + rate(i))
      end do
   end subroutine append_cubic

   !> Append a point and the curve that reaches it.
   pure subroutine append_curve(trajectory, time, state, rate, bends)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Time, not before the last point [time]
      real(wp), intent(in) :: time
      !> State [state]
      real(wp), intent(in) :: state(:)
      !> Rate [state/time]
      real(wp), intent(in) :: rate(:)
      !> The first numbers of the curve, as many as there are, shape (component, up to `curve_numbers`): bends, height of the layer
      !> [state], its exponent [-]; the others are zero
      real(wp), intent(in) :: bends(:, :)

      call append_straight(trajectory, time, state, rate)
      trajectory%bends(:, :size(bends, 2), trajectory%count) = bends
      if (size(bends, 2) == curve_numbers) then
         where (abs(bends(:, 5)) > 0.0_wp) trajectory%rises(:, trajectory%count) = exp(bends(:, 6)) - 1.0_wp
      end if
   end subroutine append_curve

   !> Append a point, reached by a straight line: also the start of a segment, behind a stop, since over the gap of a few roundings
   !> from the segment before nothing changes, however far the rates on both sides are apart.
   pure subroutine append_straight(trajectory, time, state, rate)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Time [time], state [state] and rate [state/time]
      real(wp), intent(in) :: time, state(:), rate(:)

      if (trajectory%count == size(trajectory%time)) call grow(trajectory)
      trajectory%count = trajectory%count + 1
      trajectory%time(trajectory%count) = time
      trajectory%state(:, trajectory%count) = state
      trajectory%rate(:, trajectory%count) = rate
      trajectory%bends(:, :, trajectory%count) = 0.0_wp
      trajectory%rises(:, trajectory%count) = 0.0_wp
   end subroutine append_straight

   !> Append another trajectory up to a time; the curve that holds the time is cut there.
   pure subroutine append_until(trajectory, source, time)
      !> The trajectory
      type(trajectory_t), intent(inout) :: trajectory
      !> Points to append; later than those of the trajectory
      type(trajectory_t), intent(in) :: source
      !> Time up to which they are taken [time]
      real(wp), intent(in) :: time

      ! State where it is cut [state]; bends of the curve that is left [state]
      real(wp) :: state(size(source%state, 1)), bends(size(source%state, 1), curve_numbers)
      ! Part of the curve that is left [-]
      real(wp) :: part
      integer :: point

      do point = 1, source%count
         if (source%time(point) > time) exit
         call append_curve(trajectory, source%time(point), source%state(:, point), source%rate(:, point), &
            & merge(0.0_wp, 1.0_wp, point == 1)*source%bends(:, :, point))
      end do
      if (point == 1 .or. point > source%count) return
      if (source%time(point - 1) >= time) return

      part = (time - source%time(point - 1))/(source%time(point) - source%time(point - 1))
      associate (b => source%bends(:, :, point))
         bends(:, 4) = part**5*b(:, 4)
         bends(:, 3) = bends(:, 4) - part**4*(b(:, 4) - b(:, 3))
         bends(:, 2) = bends(:, 3) - part**3*(b(:, 3) - b(:, 2))
         bends(:, 1) = bends(:, 2) - part**2*(b(:, 2) - b(:, 1))
         bends(:, 5) = b(:, 5)
         bends(:, 6) = part*b(:, 6)
         state = curve_state(source%state(:, point - 1), source%state(:, point), b, part)
      end associate
      call append_curve(trajectory, time, state, source%rate(:, point), bends)
   end subroutine append_until

   !> Twice the room.
   pure subroutine grow(trajectory)
      type(trajectory_t), intent(inout) :: trajectory

      ! Larger copies [time], [state], [state/time], [state], [-]
      real(wp), allocatable :: time(:), state(:, :), rate(:, :), bends(:, :, :), rises(:, :)
      integer :: n

      n = trajectory%count
      allocate (time(2*n), state(size(trajectory%state, 1), 2*n), rate(size(trajectory%state, 1), 2*n), &
         & bends(size(trajectory%state, 1), curve_numbers, 2*n), rises(size(trajectory%state, 1), 2*n))
      time(:n) = trajectory%time
      state(:, :n) = trajectory%state
      rate(:, :n) = trajectory%rate
      bends(:, :, :n) = trajectory%bends
      rises(:, :n) = trajectory%rises
      call move_alloc(time, trajectory%time)
      call move_alloc(state, trajectory%state)
      call move_alloc(rate, trajectory%rate)
      call move_alloc(bends, trajectory%bends)
      call move_alloc(rises, trajectory%rises)
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
      associate (left => trajectory%state(:, hint), right => trajectory%state(:, hint + 1), &
         & bends => trajectory%bends(:, :, hint + 1), rises => trajectory%rises(:, hint + 1))
         state = curve_state(left, right, bends, place, rises)
      end associate
   end subroutine interpolate_state

   !> State at a place of a curve.
   pure function curve_state(left, right, bends, place, rises) result(state)
      !> State at both ends [state]
      real(wp), intent(in) :: left(:), right(:)
      !> Bends, height and exponent of the layer, shape (component, 6) [state] and [-]
      real(wp), intent(in) :: bends(:, :)
      !> Place, from zero to one [-]
      real(wp), intent(in) :: place
      !> exp(z) - 1 of each component, where it is known [-]
      real(wp), intent(in), optional :: rises(:)
      !> State there [state]
      real(wp) :: state(size(left))

      ! Place on the layer, which must not be continued beyond its ends; exp(z) - 1 [-]
      real(wp) :: inside, rise
      integer :: i

      inside = min(max(place, 0.0_wp), 1.0_wp)
      do i = 1, size(left)
         state(i) = left(i) + place*(right(i) - left(i)) + place*(1.0_wp - place)*(bends(i, 1) + place*(bends(i, 2) &
            & + place*(bends(i, 3) + place*bends(i, 4))))
         if (.not. abs(bends(i, 5)) > 0.0_wp) cycle
         if (present(rises)) then
            rise = rises(i)
         else
            rise = exp(bends(i, 6)) - 1.0_wp
         end if
         state(i) = state(i) + bends(i, 5)*(exp(bends(i, 6)*inside) - 1.0_wp - inside*rise)
      end do
   end function curve_state

   !> Slope of the curve at a time, in the interval where `interpolate_state` has found it. At a stop, in the gap between two
   !> steps, it is that at the end of the step before, or else at the start of the next one: the difference of two rates over a few
   !> roundings is no slope.
   pure subroutine curve_slope(trajectory, time, interval, slope)
      !> The trajectory, with two points at least
      type(trajectory_t), intent(in) :: trajectory
      !> Time inside the interval [time]
      real(wp), intent(in) :: time
      !> The interval
      integer, intent(in) :: interval
      !> Slope [state/time]
      real(wp), intent(out) :: slope(:)

      ! Length of the interval [time], place in it [-], change of a component along it [state]
      real(wp) :: length, place, change
      integer :: i, step

      step = interval
      if (is_gap(trajectory, interval)) then
         if (interval > 1) then
            step = interval - 1
         else if (interval < trajectory%count - 1) then
            step = interval + 1
         end if
      end if
      associate (times => trajectory%time)
         length = times(step + 1) - times(step)
         if (length <= 0.0_wp) then
            slope = 0.0_wp
            return
         end if
         place = min(max((time - times(step))/length, 0.0_wp), 1.0_wp)
      end associate
      do i = 1, size(slope)
         change = trajectory%state(i, step + 1) - trajectory%state(i, step)
         associate (b1 => trajectory%bends(i, 1, step + 1), b2 => trajectory%bends(i, 2, step + 1), &
            & b3 => trajectory%bends(i, 3, step + 1), b4 => trajectory%bends(i, 4, step + 1), &
            & height => trajectory%bends(i, 5, step + 1), exponent => trajectory%bends(i, 6, step + 1))
            slope(i) = change + (1.0_wp - 2.0_wp*place)*(b1 + place*(b2 + place*(b3 + place*b4))) &
               & + place*(1.0_wp - place)*(b2 + place*(2.0_wp*b3 + place*3.0_wp*b4))
            if (abs(height) > 0.0_wp) slope(i) = slope(i) + height*(exponent*exp(exponent*place) &
               & - trajectory%rises(i, step + 1))
         end associate
         slope(i) = slope(i)/length
      end do
   end subroutine curve_slope

   !> Is an interval no step, but the gap at a stop?
   pure function is_gap(trajectory, interval) result(verdict)
      !> The trajectory, with two points at least
      type(trajectory_t), intent(in) :: trajectory
      !> Number of its first point
      integer, intent(in) :: interval
      !> Is it?
      logical :: verdict

      associate (first => trajectory%time(1), last => trajectory%time(trajectory%count), &
         & length => trajectory%time(interval + 1) - trajectory%time(interval))
         ! A margin is never wider than by `epsilon` in the place of `spacing`, which takes longer to find
         verdict = length <= longest_gap*margin_spacings*epsilon(1.0_wp)*max(abs(first), abs(last), 1.0_wp)
         if (verdict) verdict = length <= longest_gap*stop_margin([first, last])
      end associate
   end function is_gap

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
