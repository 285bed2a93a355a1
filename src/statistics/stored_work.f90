!> Work of the torque against spring, seat and inertia, and of the one that spins the roller up: differences of stored energy.
!>
!> In: the points of a cycle or a piece of one, in order. Out: work, and the angle without contact. What the cam puts into spring,
!> seat and masses while the roller touches it is the change of `stored_energy`; without contact it puts nothing there. So only the
!> energies count at the angles where contact is lost or comes back, and at the ends of a piece. Over a closed cycle that never
!> loses contact the work is zero.
module camroller_stored_work
   use camroller_kinds, only : wp, two_pi
   use camroller_contact_forces, only : has_oil_drag
   use camroller_error, only : error_t
   use camroller_dynamics, only : stored_energy
   use camroller_follower_samples, only : follower_samples_t
   use camroller_kinematics, only : position_t
   use camroller_model, only : evaluate_geometry, model_t
   use camroller_panels, only : panels_t, split_at
   use camroller_ramp, only : follow_ramp, speed_on_ramp
   use camroller_spin, only : rolling_speed_at
   use camroller_state, only : state_t
   use camroller_cycle, only : state_at
   implicit none
   private

   public :: stored_work_t, follow_contact, end_work, spin_work, lost_angle, split_at_losses

   !> Work so far
   type :: stored_work_t
      private
      !> Number of points so far
      integer :: points = 0
      !> Was there contact at the first point, and at the last?
      logical :: touched_first = .false., touched_last = .false.
      !> Cam angles of the first and the last point from full lift, angle without contact between them [rad]
      real(wp) :: first_angle = 0.0_wp, angle = 0.0_wp, lost = 0.0_wp
      !> Energy at losses of contact less energy at returns [J]
      real(wp) :: energy = 0.0_wp
      !> Losses and returns that need not be at stops [rad]
      real(wp), allocatable :: free_changes(:)
   end type stored_work_t

   !> Halvings of the angle between two points that have a loss or a return of contact between them and no stop: to a millionth
   integer, parameter :: halvings = 20
   !> Fraction of a turn that a trajectory may leave out and still be closed [-]
   real(wp), parameter :: left_out = 1.0e-6_wp

contains

   !> Take in the point that was sampled last.
   subroutine follow_contact(work, samples, angle, panel_start, error)
      !> The work
      type(stored_work_t), intent(inout) :: work
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Cam angle of the point from full lift [rad]
      real(wp), intent(in) :: angle
      !> Start of the panel that holds it; a stop may be there and none inside [rad]
      real(wp), intent(in) :: panel_start
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Angles before and after the change, trial [rad]
      real(wp) :: left, right, middle
      integer :: i, hint

      associate (is_touching => samples%state%contact%is_touching)
         if (work%points == 0) then
            work%touched_first = is_touching
            work%first_angle = angle
            work%angle = angle
         end if
         right = work%angle
         if (work%points > 0 .and. (is_touching .neqv. work%touched_last)) then
            left = work%angle
            right = angle
            hint = samples%hint
            if (left <= panel_start .and. .not. has_free_losses(samples%model)) then
               left = panel_start
               right = panel_start
            end if
            do i = 1, halvings
               if (.not. right > left) exit
               middle = 0.5_wp*(left + right)
               call follow_ramp(samples%model, middle)
               call state_at(samples%cycle, samples%model, middle, hint, state, error)
               if (allocated(error)) return
               if (state%contact%is_touching .eqv. work%touched_last) then
                  left = middle
               else
                  right = middle
               end if
            end do
            call follow_ramp(samples%model, angle)
            work%energy = work%energy + merge(1.0_wp, -1.0_wp, work%touched_last)*energy_at(samples, right)
            if (has_free_losses(samples%model)) then
               if (.not. allocated(work%free_changes)) allocate (work%free_changes(0))
               work%free_changes = [work%free_changes, right]
            end if
         end if
         if (.not. work%touched_last .and. work%points > 0) work%lost = work%lost + right - work%angle
         if (.not. is_touching) work%lost = work%lost + angle - right
         work%points = work%points + 1
         work%touched_last = is_touching
         work%angle = angle
      end associate
   end subroutine follow_contact

   !> May contact be lost and return at angles that are not known before the integration? With drag of the roller's bearing its
   !> spin has a part in them, and with a speed that changes stops are those of the mean speed.
   pure function has_free_losses(model)
      type(model_t), intent(in) :: model
      !> True where they may
      logical :: has_free_losses

      has_free_losses = has_oil_drag(model) .or. model%ramp%is_moving
   end function has_free_losses

   !> Divide panels at losses and returns of contact that are no stops: torque on the cam jumps there.
   subroutine split_at_losses(panels, samples, work, error)
      !> The panels
      type(panels_t), intent(inout) :: panels
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> The work at the last point
      type(stored_work_t), intent(in) :: work
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: i

      if (.not. allocated(work%free_changes)) return
      do i = 1, size(work%free_changes)
         call split_at(panels, samples, work%free_changes(i), error)
         if (allocated(error)) return
      end do
   end subroutine split_at_losses

   !> Angle without contact of a cycle.
   pure function lost_angle(work, span) result(lost)
      !> The work at the last point
      type(stored_work_t), intent(in) :: work
      !> Length of the cycle [rad]
      real(wp), intent(in) :: span
      !> The angle [rad]
      real(wp) :: lost

      lost = work%lost
      ! From the last point to the end, and from the start to the first
      if (.not. work%touched_last) lost = lost + span - (work%angle - work%first_angle)
   end function lost_angle

   !> Work of the torque against spring, seat and inertia over the cycle or the piece.
   function end_work(work, samples) result(done)
      !> The work at the last point
      type(stored_work_t), intent(in) :: work
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Work [J]
      real(wp) :: done

      done = work%energy
      associate (times => samples%cycle%trajectory%time(:samples%cycle%trajectory%count))
         if (times(size(times)) - times(1) > (1.0_wp - left_out)*two_pi .and. (work%touched_first .eqv. work%touched_last)) return
         if (work%touched_first) done = done - energy_at(samples, times(1))
         if (work%touched_last) done = done + energy_at(samples, times(size(times)))
      end associate
   end function end_work

   !> Work that spins the roller up from start to end.
   function spin_work(samples) result(done)
      !> The samples
      type(follower_samples_t), intent(in) :: samples
      !> Work [J]
      real(wp) :: done

      ! Spin at start and end [rad/s]
      real(wp) :: spins(2)
      type(position_t) :: position
      integer :: i, point, status

      associate (path => samples%cycle%trajectory, model => samples%model)
         do i = 1, 2
            point = merge(1, path%count, i == 1)
            spins(i) = path%state(1, point)/model%roller_radius
            if (samples%cycle%has_surface_speed) cycle
            call evaluate_geometry(model, path%time(point), position, status)
            spins(i) = rolling_speed_at(model, position)/model%roller_radius*(speed_on_ramp(model, path%time(point))/model%speed) &
               & - spins(i)
         end do
         done = 0.5_wp*model%roller_inertia*(spins(2) - spins(1))*(spins(2) + spins(1))
      end associate
   end function spin_work

   !> Energy stored in spring, seat and moving masses at a cam angle.
   function energy_at(samples, angle) result(energy)
      type(follower_samples_t), intent(in) :: samples
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Energy [J]
      real(wp) :: energy

      type(position_t) :: position
      integer :: status

      call evaluate_geometry(samples%model, angle, position, status)
      energy = stored_energy(samples%model%train, position, speed_on_ramp(samples%model, angle))
   end function energy_at

end module camroller_stored_work
