!> Where the joints of a flexible train have the spikes of Stribeck's friction: on both sides of each turning of valve or finger.
!>
!> In: model, a step of a turn. Out: cam angles at which friction is largest beside a turning; in cold oil they are so close to it
!> that the points of a step miss them.
module camroller_flexible_spikes
   use camroller_kinds, only : wp
   use camroller_flexible_follower, only : evaluate_follower
   use camroller_flexible_train, only : at_finger_rate, at_lift, at_speed, resolution_t
   use camroller_joints, only : has_curves
   use camroller_model, only : model_t
   use camroller_sliding_friction, only : speed_of_peak
   use camroller_state, only : state_t
   use camroller_trajectory, only : interpolate_state, trajectory_t
   implicit none
   private

   public :: has_spikes, spike_angles

   !> Parts of a step that are looked at for a turning: impacts turn the valve twice within one
   integer, parameter :: parts = 4
   !> Halvings of a part: the angle is then known to rounding
   integer, parameter :: halvings = 40

contains

   !> Has the train such friction?
   pure function has_spikes(model) result(has)
      !> The model, with a flexible train
      type(model_t), intent(in) :: model
      !> Has it?
      logical :: has

      has = allocated(model%joints)
      if (has) has = has_curves(model%joints)
   end function has_spikes

   !> Angles of the spikes in a step.
   function spike_angles(model, path, resolution, step) result(angles)
      !> The model, with such friction
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> The step
      integer, intent(in) :: step
      !> The angles, within the step [rad]
      real(wp), allocatable :: angles(:)

      ! Distances of the spikes from a turning [rad]
      real(wp), allocatable :: ways(:)
      ! Ends of the parts [rad], rates of finger and valve there [rad/s], [m/s]; angle of a turning [rad]
      real(wp) :: times(0:parts), rates(2, 0:parts), turning
      integer :: part, which

      allocate (angles(0))
      do part = 0, parts
         times(part) = path%time(step) + (path%time(step + 1) - path%time(step))*part/parts
         rates(:, part) = rates_at(path, times(part), step)
      end do
      do part = 1, parts
         do which = 1, 2
            if (.not. rates(which, part - 1)*rates(which, part) < 0.0_wp) cycle
            turning = find_turning(path, step, times(part - 1), times(part), which)
            ways = spike_ways(model, path, resolution, step, turning, times(part) - times(part - 1), which)
            angles = [angles, turning - ways, turning + ways]
         end do
      end do
      angles = pack(angles, angles > path%time(step) .and. angles < path%time(step + 1))
   end function spike_angles

   !> Rates of finger and valve.
   function rates_at(path, angle, step) result(rates)
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> The step it is in
      integer, intent(in) :: step
      !> Rates [rad/s], [m/s]
      real(wp) :: rates(2)

      ! State of the train [state]
      real(wp) :: train(size(path%state, 1))
      integer :: hint

      hint = step
      call interpolate_state(path, angle, hint, train)
      rates = train([at_finger_rate, at_speed])
   end function rates_at

   !> Angle at which finger or valve turns, by halving.
   function find_turning(path, step, from, to, which) result(angle)
      !> The turn
      type(trajectory_t), intent(in) :: path
      integer, intent(in) :: step
      !> Angles between which it turns once [rad]
      real(wp), intent(in) :: from, to
      !> 1 the finger, 2 the valve
      integer, intent(in) :: which
      !> The angle [rad]
      real(wp) :: angle

      ! Ends of what is left [rad]; rates at its beginning and in its middle [rad/s], [m/s]
      real(wp) :: low, high, first(2), middle(2)
      integer :: i

      low = from
      high = to
      first = rates_at(path, low, step)
      do i = 1, halvings
         angle = 0.5_wp*(low + high)
         middle = rates_at(path, angle, step)
         if (first(which)*middle(which) > 0.0_wp) then
            low = angle
         else
            high = angle
         end if
      end do
      angle = 0.5_wp*(low + high)
   end function find_turning

   !> How far from a turning the friction of each joint that turns is largest.
   function spike_ways(model, path, resolution, step, turning, length, which) result(ways)
      type(model_t), intent(in) :: model
      !> The turn
      type(trajectory_t), intent(in) :: path
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      integer, intent(in) :: step
      !> Angle of the turning, length of the part it is in [rad]
      real(wp), intent(in) :: turning, length
      !> 1 the finger turns, 2 the valve
      integer, intent(in) :: which
      !> The distances [rad]
      real(wp), allocatable :: ways(:)

      ! Part of the length over which the rate's slope is taken [-]
      real(wp), parameter :: near = 1.0e-4_wp
      type(state_t) :: state
      ! State of the train [state]; rates beside the turning [rad/s], [m/s]; rates at which friction is largest [rad/s or m/s]
      real(wp) :: train(size(path%state, 1)), before(2), after(2)
      real(wp), allocatable :: peaks(:)
      integer :: hint, status

      allocate (ways(0), peaks(0))
      hint = step
      call interpolate_state(path, turning, hint, train)
      call evaluate_follower(model, turning, train, resolution, state, status)
      if (status /= 0) return
      associate (joints => model%joints, values => state%joints)
         if (which == 2 .and. allocated(joints%side)) peaks = [speed_of_peak(joints%side%law, values%upper_force), &
            & speed_of_peak(joints%side%law, values%lower_force)]
         if (which == 1 .and. allocated(joints%tip)) peaks = [speed_of_peak(joints%tip%law, values%tip_force) &
            & /max(abs(model%linkage%b*model%linkage%base_cosine - train(at_lift) - joints%tip%pad_radius), tiny(1.0_wp))]
         if (which == 1 .and. allocated(joints%pivot)) peaks = [peaks, speed_of_peak(joints%pivot%law, values%pivot_force) &
            & /joints%pivot%ball_radius]
      end associate
      before = rates_at(path, turning - near*length, step)
      after = rates_at(path, turning + near*length, step)
      peaks = pack(peaks, peaks > 0.0_wp)
      if (abs(after(which) - before(which)) > 0.0_wp) ways = peaks*(2.0_wp*near*length)/abs(after(which) - before(which))
   end function spike_ways

end module camroller_flexible_spikes
