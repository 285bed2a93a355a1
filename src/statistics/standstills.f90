!> Standstills of the contact: cam angles at which the entrainment speed passes through zero or stays there; points of pure
!> rolling, at which the sliding speed does; and points at which the surface of the cam or of the roller is at rest in the contact.
!>
!> In: a cycle with the points met on the way round it. Out: the angles, and the states there among the rows of series. At a
!> standstill a film formula gives no film, or where asperities carry the load the gap of the dry surfaces; in pure rolling the
!> friction of the contact is least, and so steep on both sides that the rows beside it may show nothing of it. A surface at rest
!> takes none of the heat of the contact, whose temperature has a cusp there. Whatever the points, they miss all three.
!>
!> Also cam angles where panels end because the load along the roller changes: at which an end of the roller begins or ceases to
!> carry load, where the load at an end has a kink and its pressure, like a root, no slope; and at which the largest pressure jumps
!> to another place along the roller. Where such a change is within a panel, rules of seven and three points may agree by chance.
module camroller_standstills
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_catalogue, only : follower_values
   use camroller_torque_list, only : torque_count
   use camroller_cycle, only : state_at
   use camroller_state, only : evaluate_state, state_t
   use camroller_sampled_extremes, only : add_sample
   use camroller_follower_samples, only : entrainment_of, entrainment_t, follower_samples_t
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   use camroller_trajectory, only : interpolate_state
   use camroller_panels, only : panels_t, split_at
   implicit none
   private

   public :: add_rolling_points, add_standstills, add_surfaces_at_rest, split_at_changes

   !> Accuracy of the angle of a standstill [rad]: its state is that without entrainment, which changes little over it
   real(wp), parameter :: angle_tolerance = 1.0e-10_wp
   !> Accuracy of the angle at which the load along the roller changes [rad]: what lies beside a kink adds the square of it to a
   !> mean, beside a root its power 3/2, beside a jump itself, over the 2 pi of a turn
   real(wp), parameter :: change_tolerance = 1.0e-8_wp
   !> Widths of a slice by which the place of the largest pressure moves without a jump: that of a parabola over three slices [-]
   real(wp), parameter :: smooth = 2.0_wp

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
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)

      call samples%sample(angle, values, error)
      ! Where both surfaces have opposite speeds the roller slips by twice the speed of the cam's surface
      if (.not. allocated(error)) call add_exact_state(samples, angle, 2.0_wp*samples%state%contact%cam_surface_speed)
   end subroutine add_state_at_rest

   !> Add the state at a cam angle with a sliding speed that is known exactly to the rows.
   subroutine add_exact_state(samples, angle, sliding_speed)
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Sliding speed [m/s]
      real(wp), intent(in) :: sliding_speed

      ! A row [unit of the series]
      real(wp) :: series(samples%first_torque - 1)
      integer :: status

      call evaluate_state(samples%model, angle, sliding_speed, samples%state, status)
      if (status /= 0) return
      call follower_values(samples%case, samples%model, samples%state, series)
      call add_sample(samples%rows, angle, series, is_kink=.true., is_exact=.true.)
   end subroutine add_exact_state

   !> Add the states in which the surface of the cam or of the roller is at rest in the contact to the rows, where the film is
   !> sheared at the temperature of the contact.
   subroutine add_surfaces_at_rest(samples, speeds, error)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: speeds(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      type(state_t) :: state
      ! Speeds of the surfaces of cam and roller over the contact at two points [m/s]
      real(wp) :: before(2), after(2)
      integer :: i, body, hint

      if (.not. allocated(samples%model%heat)) return
      if (.not. samples%model%heat%has_contact) return
      hint = 1
      do i = 2, size(speeds)
         if (.not. (speeds(i - 1)%is_touching .and. speeds(i)%is_touching)) cycle
         before = surface_speeds(speeds(i - 1))
         after = surface_speeds(speeds(i))
         do body = 1, size(before)
            if ((before(body) > 0.0_wp) .eqv. (after(body) > 0.0_wp)) cycle
            call start_bracket(bracket, speeds(i - 1)%angle, speeds(i)%angle, before(body), after(body), angle_tolerance)
            do while (bracket%status == root_wanted)
               call state_at(samples%cycle, samples%model, bracket%trial, hint, state, error, samples%state%contact)
               if (allocated(error)) return
               associate (contact => state%contact)
                  call narrow_bracket(bracket, merge(contact%cam_surface_speed, contact%roller_surface_speed, body == 1))
               end associate
            end do
            if (bracket%status /= root_found) cycle
            call state_at(samples%cycle, samples%model, bracket%trial, hint, state, error, samples%state%contact)
            if (allocated(error)) return
            associate (contact => state%contact)
               call add_exact_state(samples, bracket%trial, merge(contact%sliding_speed, contact%cam_surface_speed, body == 1))
            end associate
         end do
      end do
   end subroutine add_surfaces_at_rest

   !> Speeds of the surfaces of cam and roller over the contact.
   pure function surface_speeds(point) result(speeds)
      !> A point of the cycle
      type(entrainment_t), intent(in) :: point
      !> The speeds [m/s]
      real(wp) :: speeds(2)

      speeds = point%entrainment_speed + [0.5_wp, -0.5_wp]*point%sliding_speed
   end function surface_speeds

   !> Divide panels where the load along the roller changes between two points in contact.
   subroutine split_at_changes(panels, samples, points, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> The samples, of a model with the load along the roller
      type(follower_samples_t), intent(inout) :: samples
      !> Points of the cycle in order
      type(entrainment_t), intent(in) :: points(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Changes between two points at most: of both ends, and of the place of the largest pressure
      integer, parameter :: most_changes = 3
      ! Next point, behind the changes found
      type(entrainment_t) :: next
      integer :: i, number

      do i = 2, size(points)
         next = points(i - 1)
         ! One change after the other
         do number = 1, most_changes
            if (change_between(next, points(i)) <= smooth) exit
            call find_change(samples, points(i), next, error)
            if (allocated(error)) return
            call split_at(panels, samples, next%angle, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine split_at_changes

   !> Change of the load along the roller between two points in contact: how far the place of the largest pressure moves, in widths
   !> of a slice, and more than any such move where the number of loaded ends changes.
   elemental function change_between(one, other) result(change)
      !> The points
      type(entrainment_t), intent(in) :: one, other
      !> The change [-]
      real(wp) :: change

      change = 0.0_wp
      if (.not. (one%is_touching .and. other%is_touching)) return
      change = abs(one%peak_slice - other%peak_slice)
      if (one%loaded_ends /= other%loaded_ends) change = change + 1.0_wp/epsilon(1.0_wp)
   end function change_between

   !> Find the largest change by halving, the first of equal ones: loads have no sign that would tell how far away it is.
   subroutine find_change(samples, last, point, error)
      type(follower_samples_t), intent(inout) :: samples
      !> Point behind the change
      type(entrainment_t), intent(in) :: last
      !> In: point before it; out: point next behind it, or behind a part in which the place of the largest pressure moves smoothly
      type(entrainment_t), intent(inout) :: point
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(entrainment_t) :: left, right, middle
      ! Values of all that is sampled [unit of each]
      real(wp) :: values(samples%series + torque_count)

      left = point
      right = last
      do while (right%angle - left%angle > change_tolerance .and. change_between(left, right) > smooth)
         call samples%sample(0.5_wp*(left%angle + right%angle), values, error)
         if (allocated(error)) return
         middle = entrainment_of(samples, 0.5_wp*(left%angle + right%angle))
         if (change_between(left, middle) >= change_between(middle, right)) then
            right = middle
         else
            left = middle
         end if
      end do
      point = right
   end subroutine find_change

end module camroller_standstills
