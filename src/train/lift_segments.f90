!> A lift whose acceleration is given in straight segments: ramps, flanks and nose as a cam designer draws them.
!>
!> In: cam angles and accelerations at them, of which only the shape counts; the maximum lift. Out: the lift and three derivatives.
!> Accelerations drawn by hand do not bring the valve back to rest. The positive ones before the nose and those behind it are each
!> multiplied by one factor, the negative ones stay, so that slope and lift are zero at the end; then all are multiplied so that
!> the largest lift is the given one. Both factors are positive, as the negative part lies between the positive ones. Source: Norton
!> (2009), Cam Design and Manufacturing Handbook, chapter 3: integration of the acceleration with its two conditions at the end.
module camroller_lift_segments
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t, raise, kind_deck
   implicit none
   private

   public :: segments_t, new_segments, evaluate_segments

   !> A lift between nodes, a cubic in each piece
   type :: segments_t
      !> Cam angles of the nodes from full lift, increasing [rad]
      real(wp), allocatable :: angle(:)
      !> Lift and its first and second derivative there [m, m/rad, m/rad^2]
      real(wp), allocatable :: values(:, :)
   end type segments_t

   !> Fewest nodes: ends, a positive and a negative acceleration, and a positive one again
   integer, parameter :: fewest = 5

contains

   !> Make a lift of its accelerations.
   subroutine new_segments(segments, angle, acceleration, max_lift, error)
      !> The lift
      type(segments_t), intent(out) :: segments
      !> Cam angles from the start of lift: zero first, increasing, within a turn [rad]
      real(wp), intent(in) :: angle(:)
      !> Shape of the acceleration at them, straight between: zero at both ends, positive, negative, positive [any]
      real(wp), intent(in) :: acceleration(:)
      !> Largest lift [m]
      real(wp), intent(in) :: max_lift
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      ! Nodes with those where the acceleration changes its sign [rad], accelerations there [any], their factors [-]
      real(wp), allocatable :: nodes(:), shape(:)
      real(wp) :: factors(3)
      ! Full lift [rad] and the lift there before all is multiplied [any]
      real(wp) :: top, highest

      call check_segments(angle, acceleration, error)
      if (allocated(error)) return
      call add_changes_of_sign(angle, acceleration, nodes, shape)
      call check_signs(shape, error)
      if (allocated(error)) return
      call find_factors(nodes, shape, factors)
      call apply_factors(shape, factors)
      call integrate(nodes, shape, segments)
      call find_top(segments, top, highest)
      segments%angle = segments%angle - top
      segments%values = segments%values*max_lift/highest
      ! round-off of the two conditions
      segments%values(size(nodes), :) = 0.0_wp
   end subroutine new_segments

   !> Refuse lists that are no segments.
   subroutine check_segments(angle, acceleration, error)
      !> Cam angles [rad]
      real(wp), intent(in) :: angle(:)
      !> Accelerations [any]
      real(wp), intent(in) :: acceleration(:)
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: n

      n = size(angle)
      if (n < fewest .or. size(acceleration) /= n) then
         call raise(error, kind_deck, "lift law 'segments' needs five angles or more, and as many accelerations")
      else if (abs(angle(1)) > 0.0_wp .or. any(angle(2:) <= angle(:n - 1)) .or. angle(n) > two_pi) then
         call raise(error, kind_deck, "angles of lift law 'segments' start with 0 and increase, up to 360 deg")
      else if (abs(acceleration(1)) > 0.0_wp .or. abs(acceleration(n)) > 0.0_wp) then
         call raise(error, kind_deck, "accelerations of lift law 'segments' must be 0 at both ends, or they would jump there")
      end if
   end subroutine check_segments

   !> Nodes with one more wherever the acceleration passes through zero between two of them.
   pure subroutine add_changes_of_sign(angle, acceleration, nodes, shape)
      !> Cam angles [rad]
      real(wp), intent(in) :: angle(:)
      !> Accelerations [any]
      real(wp), intent(in) :: acceleration(:)
      !> The nodes [rad]
      real(wp), allocatable, intent(out) :: nodes(:)
      !> Accelerations there [any]
      real(wp), allocatable, intent(out) :: shape(:)

      integer :: i

      nodes = angle(:1)
      shape = acceleration(:1)
      do i = 2, size(angle)
         if (acceleration(i)*acceleration(i - 1) < 0.0_wp) then
            nodes = [nodes, angle(i - 1) + (angle(i) - angle(i - 1))*acceleration(i - 1)/(acceleration(i - 1) - acceleration(i))]
            shape = [shape, 0.0_wp]
         end if
         nodes = [nodes, angle(i)]
         shape = [shape, acceleration(i)]
      end do
   end subroutine add_changes_of_sign

   !> Refuse shapes that are not positive, negative and positive again.
   subroutine check_signs(shape, error)
      !> Accelerations [any]
      real(wp), intent(in) :: shape(:)
      !> Deck error
      type(error_t), allocatable, intent(out) :: error

      integer :: first, last
      logical :: is_one_valley

      first = findloc(shape < 0.0_wp, .true., 1)
      last = findloc(shape < 0.0_wp, .true., 1, back=.true.)
      is_one_valley = first > 0
      if (is_one_valley) is_one_valley = all(shape(first:last) <= 0.0_wp) .and. any(shape(:first) > 0.0_wp) .and. &
         & any(shape(last:) > 0.0_wp)
      if (.not. is_one_valley) call raise(error, kind_deck, "accelerations of lift law 'segments' must be positive, then "// &
         & "negative about full lift, then positive")
   end subroutine check_signs

   !> Factors of the accelerations before, about and behind full lift with which slope and lift vanish at the end.
   pure subroutine find_factors(nodes, shape, factors)
      !> The nodes [rad]
      real(wp), intent(in) :: nodes(:)
      !> Accelerations there [any]
      real(wp), intent(in) :: shape(:)
      !> The factors; the middle one is one [-]
      real(wp), intent(out) :: factors(3)

      ! Slope at the end that each part brings, and that times the distance of its centre from the end [any]
      real(wp) :: slope(3), lift(3), determinant
      integer :: i, part

      slope = 0.0_wp
      lift = 0.0_wp
      do i = 1, size(nodes) - 1
         part = part_of(shape, i)
         associate (h => nodes(i + 1) - nodes(i), rest => nodes(size(nodes)) - nodes(i + 1))
            slope(part) = slope(part) + 0.5_wp*h*(shape(i) + shape(i + 1))
            lift(part) = lift(part) + h**2*(2.0_wp*shape(i) + shape(i + 1))/6.0_wp + rest*0.5_wp*h*(shape(i) + shape(i + 1))
         end associate
      end do
      determinant = slope(1)*lift(3) - slope(3)*lift(1)
      factors = [(slope(3)*lift(2) - slope(2)*lift(3))/determinant, 1.0_wp, &
         & (slope(2)*lift(1) - slope(1)*lift(2))/determinant]
   end subroutine find_factors

   !> Part to which the piece behind a node belongs: 1 before the negative accelerations, 2 they, 3 behind them.
   pure function part_of(shape, node) result(part)
      !> Accelerations [any]
      real(wp), intent(in) :: shape(:)
      integer, intent(in) :: node
      !> The part
      integer :: part

      part = 2
      if (min(shape(node), shape(node + 1)) < 0.0_wp) return
      part = merge(1, 3, node < findloc(shape < 0.0_wp, .true., 1))
   end function part_of

   !> Multiply the accelerations of each part.
   pure subroutine apply_factors(shape, factors)
      !> Accelerations [any]
      real(wp), intent(inout) :: shape(:)
      !> Factors of the parts [-]
      real(wp), intent(in) :: factors(3)

      integer :: valley

      valley = findloc(shape < 0.0_wp, .true., 1)
      where (shape(:valley) > 0.0_wp) shape(:valley) = factors(1)*shape(:valley)
      where (shape(valley:) > 0.0_wp) shape(valley:) = factors(3)*shape(valley:)
   end subroutine apply_factors

   !> Slope and lift at the nodes.
   pure subroutine integrate(nodes, shape, segments)
      !> The nodes [rad]
      real(wp), intent(in) :: nodes(:)
      !> Accelerations there [any]
      real(wp), intent(in) :: shape(:)
      !> The lift
      type(segments_t), intent(inout) :: segments

      integer :: i

      segments%angle = nodes
      allocate (segments%values(size(nodes), 0:2), source=0.0_wp)
      segments%values(:, 2) = shape
      do i = 1, size(nodes) - 1
         associate (h => nodes(i + 1) - nodes(i), values => segments%values)
            values(i + 1, 1) = values(i, 1) + 0.5_wp*h*(shape(i) + shape(i + 1))
            values(i + 1, 0) = values(i, 0) + h*values(i, 1) + h**2*(2.0_wp*shape(i) + shape(i + 1))/6.0_wp
         end associate
      end do
   end subroutine integrate

   !> Full lift: where the slope falls through zero among the negative accelerations.
   pure subroutine find_top(segments, top, highest)
      !> The lift
      type(segments_t), intent(in) :: segments
      !> Its angle [rad] and the lift there [any]
      real(wp), intent(out) :: top, highest

      ! Values at an angle [any], distance from the node, slope of the acceleration [any], discriminant [any]
      real(wp) :: values(0:3), distance, bend
      integer :: i

      ! The slope falls from its largest value to its smallest there
      i = findloc(segments%values(:, 2) < 0.0_wp, .true., 1) - 1
      do while (segments%values(i + 1, 1) > 0.0_wp)
         i = i + 1
      end do
      associate (v => segments%values(i, 1), a => segments%values(i, 2))
         bend = (segments%values(i + 1, 2) - a)/(segments%angle(i + 1) - segments%angle(i))
         ! v + a d + bend d^2/2 = 0, in the form without cancellation
         distance = 2.0_wp*v/(-a + sqrt(max(0.0_wp, a**2 - 2.0_wp*bend*v)))
      end associate
      top = segments%angle(i) + distance
      call evaluate_segments(segments, top, values)
      highest = values(0)
   end subroutine find_top

   !> Lift and its first three derivatives within the event; right-hand values where the third one jumps.
   pure subroutine evaluate_segments(segments, angle, values)
      !> The lift
      type(segments_t), intent(in) :: segments
      !> Cam angle, within the nodes [rad]
      real(wp), intent(in) :: angle
      !> Lift and its derivatives [m, m/rad, m/rad^2, m/rad^3]
      real(wp), intent(out) :: values(0:3)

      real(wp) :: d ! [rad]
      integer :: low, high, middle

      low = 1
      high = size(segments%angle)
      do while (high - low > 1)
         middle = (low + high)/2
         if (segments%angle(middle) <= angle) then
            low = middle
         else
            high = middle
         end if
      end do
      associate (at => segments%values(low, :))
         d = angle - segments%angle(low)
         values(3) = (segments%values(high, 2) - at(3))/(segments%angle(high) - segments%angle(low))
         values(2) = at(3) + d*values(3)
         values(1) = at(2) + d*(at(3) + 0.5_wp*d*values(3))
         values(0) = at(1) + d*(at(2) + d*(0.5_wp*at(3) + d*values(3)/6.0_wp))
      end associate
   end subroutine evaluate_segments

end module camroller_lift_segments
