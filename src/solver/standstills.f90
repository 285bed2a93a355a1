!> Standstills of the contact: cam angles at which the entrainment speed changes its sign.
!>
!> Layer: solver. In: a cycle with the points met on the way round it. Out: the angles, and the states there among the rows of
!> series. There a film formula gives no film, or where asperities carry the load the gap of the dry surfaces; whatever the points,
!> they miss it.
module camroller_standstills
   use camroller_kinds, only : wp
   use camroller_error, only : error_t
   use camroller_catalogue, only : follower_values, torque_count
   use camroller_state, only : evaluate_state
   use camroller_extremes, only : add_sample
   use camroller_follower_samples, only : follower_samples_t, look_t
   use camroller_roots, only : bracket_t, start_bracket, narrow_bracket, root_wanted, root_found
   implicit none
   private

   public :: add_standstills

   !> Accuracy of the angle of a standstill [rad]: its state is that without entrainment, which changes little over it
   real(wp), parameter :: angle_tolerance = 1.0e-10_wp

contains

   !> Count the angles at which the entrainment speed changes its sign in contact, and add the states there to the rows.
   subroutine add_standstills(samples, looks, standstills, first_angle, error)
      !> The samples
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

   !> Add the state without entrainment at a cam angle to the rows.
   subroutine add_state_at_rest(samples, angle)
      !> The samples
      type(follower_samples_t), intent(inout) :: samples
      !> Cam angle from full lift, that of the last sample or all but that [rad]
      real(wp), intent(in) :: angle

      ! Series of the follower [unit of the series]
      real(wp) :: values(samples%first_torque - 1)
      integer :: status

      ! Where both surfaces have opposite speeds the roller slips by twice the speed of the cam's surface
      call evaluate_state(samples%model, angle, 2.0_wp*samples%state%contact%cam_surface_speed, samples%state, status)
      if (status /= 0) return
      call follower_values(samples%case, samples%model, samples%state, values)
      call add_sample(samples%rows, angle, values, .true.)
   end subroutine add_state_at_rest

end module camroller_standstills
