!> What the followers of a step of a camshaft or an engine give, added up with the bearings that carry the camshafts.
!>
!> In: case, shaft, forces and torques of all followers at equally spaced angles of the step, inputs at both ends. Out: torques by
!> source, means over the step and values at its end, extremes.
!>
!> Forces on the cams are taken at angles a degree apart at most, half a degree with flexible trains; between them the bearings'
!> torque follows Simpson's rule, whose difference from the trapezoidal rule counts for the error, by its magnitude over each pair
!> of intervals: over a step in which trains vibrate these differences change their sign.
module camroller_camshaft_step
   use camroller_kinds, only : wp, degree
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_case, only : case_t
   use camroller_lubricant, only : oil_t, get_oil
   use camroller_follower_step, only : place_t, outcome_t, piece_number
   use camroller_shaft, only : shaft_t, bearing_number, set_drag, set_journal, in_common_frame, bearing_torques
   use camroller_step_inputs, only : inputs_t, inputs_between, part_number
   use camroller_torque_list, only : torque_count, sum_of_losses, sum_of_torques, of_bearings, of_shaft_drag
   implicit none
   private

   public :: shaft_outcome_t, step_room_t, make_room, add_up

   !> What one step gives
   type :: shaft_outcome_t
      !> Torque that drives all camshafts: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_drive = 0.0_wp, torque_drive = 0.0_wp
      !> The part of it for losses: mean over the step, and at its end [N m]
      real(wp) :: mean_torque_friction = 0.0_wp, torque_friction = 0.0_wp
      !> By source, the rows of `torque_list`: mean over the step, and at its end [N m]; last the energy residual [W]
      real(wp) :: mean_torques(torque_count) = 0.0_wp, torques(torque_count) = 0.0_wp
      !> Smallest and largest torque that drives, at the angles at which forces are taken; of one follower without bearings, seals
      !> and drive also at the points that its means are made of [N m]
      real(wp) :: extreme_torque(2) = 0.0_wp
      !> Estimate of the error of the mean torque that drives, as in `outcome_t` [N m]
      real(wp) :: estimated_error = 0.0_wp
      !> The same on each camshaft at the end, shape (torque, camshaft) [N m]
      real(wp), allocatable :: by_camshaft(:, :)
      !> States of the bearings at the end, shape (bearing, camshaft); allocated where the case has bearings
      type(bearing_state_t), allocatable :: bearings(:, :)
      !> What the follower of each cam gives
      type(outcome_t), allocatable :: followers(:)
   end type shaft_outcome_t

   !> An error of one of several cams
   type :: failure_t
      type(error_t), allocatable :: error
   end type failure_t

   !> Room that a step needs and the next one uses again
   type :: step_room_t
      !> Where each follower was before the step, its error in it
      type(place_t), allocatable :: before(:)
      type(failure_t), allocatable :: failures(:)
      !> Force on each cam and its torque over the step, shape (3, angle, cam) [N, N m]
      real(wp), allocatable :: nodes(:, :, :)
      !> Torque of all bearings, and of seals and drive, at these angles, shape (angle, 2); of the bearings of each camshaft [N m]
      real(wp), allocatable :: losses(:, :), by_shaft(:)
      !> Forces at one of the angles in the frame of the first follower, shape (2, cam) [N]
      real(wp), allocatable :: turned(:, :)
   end type step_room_t

   !> Largest distance of angles at which forces on the cams are taken, of rigid trains and of flexible ones, whose vibration a
   !> degree does not resolve [rad]
   real(wp), parameter :: node_spacing(2) = [1.0_wp, 0.5_wp]*degree

contains

   !> Make room for a step where it is not there from an earlier one.
   pure subroutine make_room(room, span, is_flexible, cams, camshafts)
      !> The room
      type(step_room_t), intent(inout) :: room
      !> Cam angle of the step [rad]
      real(wp), intent(in) :: span
      !> Are the trains flexible?
      logical, intent(in) :: is_flexible
      !> Number of cams, of camshafts
      integer, intent(in) :: cams, camshafts

      integer :: intervals

      intervals = interval_number(span, node_spacing(merge(2, 1, is_flexible)))
      if (.not. allocated(room%before)) allocate (room%before(cams), room%failures(cams), room%turned(2, cams), &
         & room%by_shaft(camshafts))
      if (allocated(room%nodes)) then
         if (ubound(room%nodes, 2) /= intervals) deallocate (room%nodes, room%losses)
      end if
      if (.not. allocated(room%nodes)) allocate (room%nodes(3, 0:intervals, cams), room%losses(0:intervals, 2))
   end subroutine make_room

   !> Intervals between the angles at which forces are taken: an even number in each piece of a step.
   elemental function interval_number(span, spacing) result(intervals)
      !> Cam angle of the step, largest distance of the angles [rad]
      real(wp), intent(in) :: span, spacing
      !> The number
      integer :: intervals

      intervals = 2*piece_number(span)*part_number(span/piece_number(span), 2.0_wp*spacing)
   end function interval_number

   !> Add the followers and their bearings up.
   subroutine add_up(case, shaft, room, start, finish, outcome, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Its shaft; bearings, seals and drive are set to the inputs
      type(shaft_t), intent(inout) :: shaft
      !> Room, with what the followers give over the step
      type(step_room_t), intent(inout) :: room
      !> Inputs at both ends
      type(inputs_t), intent(in) :: start, finish
      !> What the followers give; out: all of it
      type(shaft_outcome_t), intent(inout) :: outcome
      !> Domain error of the bearings
      type(error_t), allocatable, intent(out) :: error

      ! Torque that drives everything at one of the angles; means by Simpson's rule and their errors [N m]
      real(wp) :: drive, mean(2), errors(2)
      integer :: i, k, last

      last = ubound(room%nodes, 2)
      call fit_outcome(outcome, shaft%count, bearing_number(shaft))
      outcome%mean_torques = 0.0_wp
      outcome%estimated_error = 0.0_wp
      outcome%by_camshaft = 0.0_wp
      do i = 1, size(outcome%followers)
         k = shaft%shafts(i)
         outcome%mean_torques = outcome%mean_torques + outcome%followers(i)%mean_torques
         outcome%by_camshaft(:, k) = outcome%by_camshaft(:, k) + outcome%followers(i)%torques
         outcome%estimated_error = outcome%estimated_error + outcome%followers(i)%estimated_error
      end do
      outcome%extreme_torque = [huge(1.0_wp), -huge(1.0_wp)]
      do i = 0, last
         call bearings_at(case, shaft, inputs_between(start, finish, real(i, wp)/last), room%nodes(:2, i, :), &
            & room%turned, room%by_shaft, error, outcome%bearings)
         if (allocated(error)) return
         associate (losses => room%losses)
            losses(i, 1) = sum(room%by_shaft)
            losses(i, 2) = shaft%count*shaft%drag
            drive = sum(room%nodes(3, i, :)) + losses(i, 1) + losses(i, 2)
         end associate
         outcome%extreme_torque = [min(outcome%extreme_torque(1), drive), max(outcome%extreme_torque(2), drive)]
      end do
      do i = 1, 2
         call take_mean(room%losses(:, i), mean(i), errors(i))
      end do
      outcome%by_camshaft(of_bearings, :) = room%by_shaft
      outcome%by_camshaft(of_shaft_drag, :) = shaft%drag
      outcome%torques = sum(outcome%by_camshaft, 2)
      outcome%mean_torques([of_bearings, of_shaft_drag]) = mean
      outcome%estimated_error = outcome%estimated_error + sum(errors)
      outcome%mean_torque_friction = sum_of_losses(outcome%mean_torques)
      outcome%mean_torque_drive = sum_of_torques(outcome%mean_torques)
      outcome%torque_friction = sum_of_losses(outcome%torques)
      outcome%torque_drive = sum_of_torques(outcome%torques)
      ! At the end the same sum in another order
      outcome%extreme_torque = [min(outcome%extreme_torque(1), outcome%torque_drive), &
         & max(outcome%extreme_torque(2), outcome%torque_drive)]
      ! A follower alone knows what lies between the angles
      if (size(outcome%followers) > 1 .or. bearing_number(shaft) > 0 .or. shaft%drag > 0.0_wp) return
      associate (alone => outcome%followers(1)%extremes%torque_drive)
         outcome%extreme_torque = [min(outcome%extreme_torque(1), alone(1)), max(outcome%extreme_torque(2), alone(2))]
      end associate
   end subroutine add_up

   !> Give an outcome the shape of a shaft: another one may have filled it before.
   pure subroutine fit_outcome(outcome, camshafts, bearings)
      type(shaft_outcome_t), intent(inout) :: outcome
      !> Number of camshafts, and of the bearings of each
      integer, intent(in) :: camshafts, bearings

      if (allocated(outcome%by_camshaft)) then
         if (size(outcome%by_camshaft, 2) /= camshafts) deallocate (outcome%by_camshaft)
      end if
      if (.not. allocated(outcome%by_camshaft)) allocate (outcome%by_camshaft(torque_count, camshafts))
      if (allocated(outcome%bearings)) then
         if (any(shape(outcome%bearings) /= [bearings, camshafts])) deallocate (outcome%bearings)
      end if
      if (bearings > 0 .and. .not. allocated(outcome%bearings)) allocate (outcome%bearings(bearings, camshafts))
   end subroutine fit_outcome

   !> Mean of what is sampled at equal distances, and its error.
   pure subroutine take_mean(samples, mean, error)
      !> The samples, an even number after the first [any]
      real(wp), intent(in) :: samples(0:)
      !> Mean by Simpson's rule; what the trapezoidal rule differs from it in each pair of intervals, magnitudes added [any]
      real(wp), intent(out) :: mean, error

      integer :: k, last

      last = ubound(samples, 1)
      mean = 0.0_wp
      error = 0.0_wp
      do k = 2, last, 2
         mean = mean + (samples(k - 2) + 4.0_wp*samples(k - 1) + samples(k))
         error = error + abs(samples(k - 2) - 2.0_wp*samples(k - 1) + samples(k))
      end do
      mean = mean/(3.0_wp*last)
      error = error/(6.0_wp*last)
   end subroutine take_mean

   !> Torque of the bearings of each camshaft at inputs and forces.
   subroutine bearings_at(case, shaft, inputs, forces, turned, torques, error, bearings)
      type(case_t), intent(in) :: case
      !> The shaft; its bearings, seals and drive are set to the inputs
      type(shaft_t), intent(inout) :: shaft
      !> Speed and oil temperature
      type(inputs_t), intent(in) :: inputs
      !> Force on each cam in the frame of its own follower, shape (2, cam) [N]
      real(wp), intent(in) :: forces(:, :)
      !> The same in the frame of the first follower, same shape [N]
      real(wp), intent(out), contiguous :: turned(:, :)
      !> The torques [N m]
      real(wp), intent(out) :: torques(:)
      !> Domain error where a bearing law has no solution
      type(error_t), allocatable, intent(out) :: error
      !> States of the bearings, shape (bearing, camshaft)
      type(bearing_state_t), intent(out), optional :: bearings(:, :)

      type(oil_t) :: oil
      integer :: cam

      torques = 0.0_wp
      turned = 0.0_wp
      if (.not. allocated(shaft%journal)) return
      call get_oil(case%lubricant, inputs%oil_temperature, oil, error)
      if (.not. allocated(error)) call set_journal(shaft, oil%viscosity, inputs%speed, error)
      if (.not. allocated(error)) call set_drag(shaft, inputs%speed, inputs%oil_temperature, error)
      if (allocated(error)) return
      do cam = 1, size(forces, 2)
         turned(:, cam) = in_common_frame(shaft, cam, forces(:, cam))
      end do
      call bearing_torques(shaft, turned, torques, error, bearings)
   end subroutine bearings_at

end module camroller_camshaft_step
