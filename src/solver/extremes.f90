!> Extremes of a cycle: those of the curve and not of the points that it was looked at, and standstills of the contact.
!>
!> Layer: solver. In: a cycle with the points met on the way round it. Out: smallest and largest load, pressure, film and sliding
!> speed to a millionth of their range, each near the point that had it, and the angles at which the entrainment speed changes its
!> sign. There a film formula gives no film, or where asperities carry the load the gap of the dry surfaces; whatever the points, they miss it.
module camroller_extremes
   use camroller_kinds, only : wp, two_pi
   use camroller_error, only : error_t
   use camroller_catalogue, only : follower_torques, series_values, torque_count
   use camroller_state, only : evaluate_state
   use camroller_extremum, only : extremum_t, start_extremum, narrow_extremum
   use camroller_follower_samples, only : follower_samples_t, look_t, look_of, tracked_count
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   implicit none
   private

   public :: refine_extremes, add_standstills

   !> Gain of an extreme that is not worth an evaluation, over the range of the quantity [-]
   real(wp), parameter :: worth = 1.0e-6_wp
   !> Accuracy of the angle of a standstill [rad]: its state is that without entrainment, which changes little over it
   real(wp), parameter :: angle_tolerance = 1.0e-10_wp

contains

   !> Take smallest and largest values of the tracked quantities from the curve near the points that had them.
   subroutine refine_extremes(samples, looks, error)
      !> The samples, whose extremes widen
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order, the first one following on the last
      type(look_t), intent(in) :: looks(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(extremum_t) :: search
      type(look_t) :: look
      ! Values of all that is sampled [unit of each]; three angles [rad]; extent of a quantity [unit of it]
      real(wp) :: values(samples%series + torque_count), angles(3), extent
      integer :: quantity, sense, middle, before, after

      do quantity = 1, tracked_count
         extent = maxval(looks%tracked(quantity)) - minval(looks%tracked(quantity))
         do sense = -1, 1, 2
            middle = minloc(sense*looks%tracked(quantity), 1)
            before = modulo(middle - 2, size(looks)) + 1
            after = modulo(middle, size(looks)) + 1
            if (.not. all(looks([before, middle, after])%is_touching)) cycle
            angles = looks([before, middle, after])%angle
            if (before > middle) angles(1) = angles(1) - two_pi
            if (after < middle) angles(3) = angles(3) + two_pi
            call start_extremum(search, angles, sense*looks([before, middle, after])%tracked(quantity), worth*extent)
            do while (search%is_wanted)
               call samples%sample(search%trial, values, error)
               if (allocated(error)) return
               look = look_of(samples, search%trial)
               call narrow_extremum(search, sense*look%tracked(quantity))
            end do
         end do
      end do
   end subroutine refine_extremes

   !> Count the angles at which the entrainment speed changes its sign in contact, and take the states there among the extremes.
   subroutine add_standstills(samples, looks, standstills, first_angle, error)
      !> The samples, whose extremes widen
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(look_t), intent(in) :: looks(:)
      !> Number of changes of sign
      integer, intent(out) :: standstills
      !> Cam angle from full lift of the first [rad]
      real(wp), intent(out) :: first_angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)
      integer :: i

      standstills = 0
      first_angle = 0.0_wp
      do i = 2, size(looks)
         if (.not. all(looks(i - 1:i)%is_touching)) cycle
         call start_bracket(bracket, looks(i - 1)%angle, looks(i)%angle, looks(i - 1)%entrainment_speed, &
            & looks(i)%entrainment_speed, angle_tolerance)
         do while (bracket%status == root_wanted)
            call samples%sample(bracket%trial, values, error)
            if (allocated(error)) return
            call narrow_bracket(bracket, samples%state%contact%entrainment_speed)
         end do
         if (bracket%status /= root_found) cycle
         standstills = standstills + 1
         if (standstills == 1) first_angle = bracket%trial
         call add_state_at_rest(samples, bracket%trial)
      end do
   end subroutine add_standstills

   !> Take the state without entrainment at a cam angle among the extremes.
   subroutine add_state_at_rest(samples, angle)
      !> The samples, whose extremes widen
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift, that of the last sample or all but that [rad]
      real(wp), intent(in) :: angle

      ! Series [unit of the series]
      real(wp) :: values(samples%series)
      integer :: status

      ! Where both surfaces have opposite speeds the roller slips by twice the speed of the cam's surface
      call evaluate_state(samples%model, angle, 2.0_wp*samples%state%contact%cam_surface_speed, samples%state, status)
      if (status /= 0) return
      call series_values(samples%case, samples%model, samples%state, follower_torques(samples%state), 0.0_wp, values)
      samples%lowest = min(samples%lowest, values)
      samples%highest = max(samples%highest, values)
   end subroutine add_state_at_rest

end module camroller_extremes
