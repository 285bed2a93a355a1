!> Standstills of the contact: cam angles at which the entrainment speed passes through zero or stays there; and points of pure
!> rolling, at which the sliding speed does.
!>
!> In: a cycle with the points met on the way round it. Out: the angles, and the states there among the rows of
!> series. At a standstill a film formula gives no film, or where asperities carry the load the gap of the dry surfaces; in pure
!> rolling the friction of the contact is least, and so steep on both sides that the rows beside it may show nothing of it. Whatever
!> the points, they miss both.
!>
!> Also cam angles at which an end of the roller begins or ceases to carry load, where panels end: the load at an end has a kink
!> there and its pressure, like a root, no slope; where an end carries for a part of a panel only, rules of seven and three points
!> may agree by chance.
module camroller_standstills
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_catalogue, only : follower_values
   use camroller_torque_list, only : torque_count
   use camroller_state, only : evaluate_state
   use camroller_extremes, only : add_sample
   use camroller_follower_samples, only : entrainment_of, entrainment_t, follower_samples_t
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   use camroller_trajectory, only : interpolate_state
   use camroller_panels, only : panels_t, split_at
   implicit none
   private

   public :: add_rolling_points, add_standstills, split_at_ends

   !> Accuracy of the angle of a standstill [rad]: its state is that without entrainment, which changes little over it
   real(wp), parameter :: angle_tolerance = 1.0e-10_wp
   !> Accuracy of the angle at which an end begins to carry [rad]: what lies beside a kink adds the square of it to a mean, beside
   !> a root its power 3/2
   real(wp), parameter :: end_tolerance = 1.0e-8_wp

contains

   !> Count how often the entrainment speed passes through zero in contact or stays there, and add the states without entrainment to
   !> the rows.
   subroutine add_standstills(samples, speeds, standstills, first_angle, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: speeds(:)
      !> Number of standstills
      integer, intent(out) :: standstills
      !> Cam angle from full lift of the first [rad]
      real(wp), intent(out) :: first_angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Entrainment speed within which there is none as far as is known [m/s]; angle [rad]
      real(wp) :: none, angle
      ! Last point where there is entrainment, and last where there is none
      integer :: last, still, i
      logical :: is_found

      standstills = 0
      first_angle = 0.0_wp
      none = samples%cycle%tolerance*samples%cycle%scale
      last = 0
      still = 0
      do i = 1, size(speeds)
         if (.not. speeds(i)%is_touching) then
            last = 0
            still = 0
         else if (abs(speeds(i)%entrainment_speed) <= none) then
            still = i
         else
            is_found = still > last
            if (is_found) angle = speeds(still)%angle
            if (last > 0 .and. .not. is_found) then
               if (speeds(last)%entrainment_speed*speeds(i)%entrainment_speed <= 0.0_wp) call find_reversal(samples, &
                  & speeds(last), speeds(i), is_found, angle, error)
               if (allocated(error)) return
            end if
            if (is_found) then
               if (standstills == 0) first_angle = angle
               standstills = standstills + 1
               call add_state_at_rest(samples, angle, error)
               if (allocated(error)) return
            end if
            last = i
         end if
      end do
   end subroutine add_standstills

   !> Angle between two points at which the entrainment speed changes its sign.
   subroutine find_reversal(samples, left, right, is_found, angle, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Points before and after
      type(entrainment_t), intent(in) :: left, right
      !> Is there one?
      logical, intent(out) :: is_found
      !> The angle [rad]
      real(wp), intent(out) :: angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)

      call start_bracket(bracket, left%angle, right%angle, left%entrainment_speed, right%entrainment_speed, angle_tolerance)
      do while (bracket%status == root_wanted)
         call samples%sample(bracket%trial, values, error)
         if (allocated(error)) return
         call narrow_bracket(bracket, samples%state%contact%entrainment_speed)
      end do
      is_found = bracket%status == root_found
      angle = bracket%trial
   end subroutine find_reversal

   !> Add the states at the points of pure rolling to the rows: where the curve of the sliding speed passes through zero between two
   !> points in contact.
   subroutine add_rolling_points(samples, speeds, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: speeds(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      ! Values of all that is sampled [unit of each]; sliding speed [m/s]
      real(wp) :: values(samples%series + torque_count), sliding_speed(1)
      integer :: i, hint

      if (samples%cycle%has_surface_speed .or. allocated(samples%cycle%phases)) return
      hint = 1
      do i = 2, size(speeds)
         if (.not. (speeds(i - 1)%is_touching .and. speeds(i)%is_touching)) cycle
         if ((speeds(i - 1)%sliding_speed > 0.0_wp) .eqv. (speeds(i)%sliding_speed > 0.0_wp)) cycle
         call start_bracket(bracket, speeds(i - 1)%angle, speeds(i)%angle, speeds(i - 1)%sliding_speed, speeds(i)%sliding_speed, &
            & 0.0_wp)
         do while (bracket%status == root_wanted)
            call interpolate_state(samples%cycle%trajectory, bracket%trial, hint, sliding_speed)
            call narrow_bracket(bracket, sliding_speed(1))
         end do
         if (bracket%status == root_found) call samples%sample(bracket%trial, values, error)
         if (allocated(error)) return
      end do
   end subroutine add_rolling_points

   !> Add the state without entrainment at a cam angle to the rows.
   subroutine add_state_at_rest(samples, angle, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)
      integer :: status

      call samples%sample(angle, values, error)
      if (allocated(error)) return
      ! Where both surfaces have opposite speeds the roller slips by twice the speed of the cam's surface
      call evaluate_state(samples%model, angle, 2.0_wp*samples%state%contact%cam_surface_speed, samples%state, status)
      if (status /= 0) return
      associate (series => values(:samples%first_torque - 1))
         call follower_values(samples%case, samples%model, samples%state, series)
         call add_sample(samples%rows, angle, series, .true.)
      end associate
   end subroutine add_state_at_rest

   !> Divide panels where the number of ends that carry load changes between two points in contact.
   subroutine split_at_ends(panels, samples, points, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> The samples, of a model with the load along the roller
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: points(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Next point, behind the changes found
      type(entrainment_t) :: next
      integer :: i, change

      do i = 2, size(points)
         next = points(i - 1)
         ! One end after the other
         do change = 1, 2
            if (.not. (next%is_touching .and. points(i)%is_touching)) exit
            if (next%loaded_ends == points(i)%loaded_ends) exit
            call find_change(samples, points(i), next, error)
            if (allocated(error)) return
            call split_at(panels, samples, next%angle, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine split_at_ends

   !> Find the first change by halving: loads have no sign that would tell how far away it is.
   subroutine find_change(samples, last, point, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Point behind the change
      type(entrainment_t), intent(in) :: last
      !> In: point before it; out: point next behind it
      type(entrainment_t), intent(inout) :: point
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(entrainment_t) :: left, right, middle
      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)

      left = point
      right = last
      do while (right%angle - left%angle > end_tolerance)
         call samples%sample(0.5_wp*(left%angle + right%angle), values, error)
         if (allocated(error)) return
         middle = entrainment_of(samples, 0.5_wp*(left%angle + right%angle))
         if (middle%loaded_ends == left%loaded_ends) then
            left = middle
         else
            right = middle
         end if
      end do
      point = right
   end subroutine find_change

end module camroller_standstills
