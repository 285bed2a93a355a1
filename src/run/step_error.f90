!> Error of a piece of a host's step that comes from the error of the sliding speed.
!>
!> In: states on the curve of the integration. Out: error of the sliding speed by the defect of the curve, see `error_estimate`, and
!> what it adds to the error of the torque that drives.
!>
!> The integration tries a step over the whole piece. Its error estimate is one number, which goes through zero from one sign to the
!> other as steps and cases differ: now and then a step is accepted that misses the tolerance by a factor of hundred. In its middle
!> the curve then misses the equation by as much.
!>
!> `make step-estimates` compares steps with those at an accuracy of 1e-7: in 249 of 3.5 million steps of 1 to 0.001 degrees the
!> error was above the estimate, up to 3.7 times: noise of a lift table, a contact that had just come back.
module camroller_step_error
   use camroller_kinds, only : wp
   use camroller_contact_traction, only : largest_shear
   use camroller_cycle, only : cycle_t, state_at, step_part
   use camroller_defects, only : defect_at
   use camroller_error, only : error_t
   use camroller_model, only : model_t
   use camroller_ramp, only : follow_ramp
   use camroller_spin, only : decay_rate_of
   use camroller_state, only : state_t
   use camroller_torque_list, only : of_contact
   implicit none
   private

   public :: slip_error_t, judge_point, judge_curve, judge_intervals, is_good, spin_error

   !> Errors so far, at the states that have been looked at
   type :: slip_error_t
      !> Tolerance of the integration [-], and of the sliding speed [m/s]
      real(wp) :: tolerance = 0.0_wp, allowed = 0.0_wp
      !> Largest error of the sliding speed that an interval of the curve makes, over what is allowed [-]
      real(wp) :: excess = 0.0_wp
      !> Largest error of the sliding speed by all steps before, over what is allowed [-]
      real(wp) :: carried = 1.0_wp
      !> Largest rate at which a disturbance decays or grows [1/rad]; largest defect [m/s/rad]
      real(wp) :: decay_rate = 0.0_wp, defect = 0.0_wp
      !> Has the curve been looked at, and is contact lost anywhere?
      logical :: has_defect = .false., loses_contact = .false.
      !> Largest error of the torque that drives [N m]
      real(wp) :: torque = 0.0_wp
   end type slip_error_t

   !> Roundings of the roller's surface speed that an error of the sliding speed may have, and one of the spin itself [-]
   real(wp), parameter :: roundings = 16.0_wp, several = 4.0_wp
   !> Tolerances to which errors of steps, each `step_part` of one, add up at most where they hardly decay [-]: 2.5 were met
   real(wp), parameter :: most_carried = 3.0_wp
   !> Margin of the error of a torque, whose slopes leave out what film and asperities do [-]: true errors without it were up to 1.7
   !> times as large with the bookkeeping of the source
   real(wp), parameter :: margin = 2.0_wp

contains

   !> Take in a state at an end of a piece, where the sliding speed is as good as the tolerance demands, but for errors of earlier
   !> steps that have not decayed. The integration holds the error of the traction within its part of the largest too, see
   !> `step_checks`.
   pure subroutine judge_point(errors, model, length, state)
      !> The errors
      type(slip_error_t), intent(inout) :: errors
      !> Model of the lobe, which follows the inputs
      type(model_t), intent(in) :: model
      !> Length of the piece [rad]
      real(wp), intent(in) :: length
      !> State there
      type(state_t), intent(in) :: state

      call judge_state(errors, model, length, 0.0_wp, decay_rate_of(model, state%contact), state)
   end subroutine judge_point

   !> Take in a state on the curve, well inside an interval.
   !>
   !> A defect that vanishes at both ends and is like a hump `x^2 (1 - x)^2` between leaves 8/15 of its largest value times the
   !> length where nothing decays, and no more than its largest value over the decay rate where decay is fast.
   pure subroutine judge_curve(errors, model, piece, angle, interval, state)
      !> The errors
      type(slip_error_t), intent(inout) :: errors
      !> Model of the lobe, which follows the inputs
      type(model_t), intent(in) :: model
      !> The piece
      type(cycle_t), intent(in) :: piece
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Interval that holds it
      integer, intent(in) :: interval
      !> State there
      type(state_t), intent(in) :: state

      ! Length of the interval [rad]; error of the sliding speed that it makes [m/s]; decay rate of a disturbance [1/rad]; defect
      ! [m/s/rad]
      real(wp) :: length, slip, decay_rate, defect

      associate (times => piece%trajectory%time(:piece%trajectory%count))
         length = times(interval + 1) - times(interval)
         decay_rate = decay_rate_of(model, state%contact)
         defect = abs(defect_at(model, piece, angle, interval, state))
         slip = defect*length/(2.0_wp + max(0.0_wp, decay_rate)*length)
         errors%defect = max(errors%defect, defect)
         errors%has_defect = .true.
         errors%excess = max(errors%excess, slip/(errors%allowed + roundings*spacing(state%contact%rolling_speed)))
         call judge_state(errors, model, times(size(times)) - times(1), slip, decay_rate, state)
      end associate
   end subroutine judge_curve

   !> Take in a state.
   pure subroutine judge_state(errors, model, length, slip, decay_rate, state)
      type(slip_error_t), intent(inout) :: errors
      !> Model of the lobe, which follows the inputs
      type(model_t), intent(in) :: model
      !> Length of the piece [rad]; error of the sliding speed that is known there [m/s]; decay rate of a disturbance [1/rad]
      real(wp), intent(in) :: length, slip, decay_rate
      type(state_t), intent(in) :: state

      ! Errors carried on from earlier steps over what is allowed [-]; error of the traction [N]
      real(wp) :: carried, traction

      carried = 1.0_wp
      if (decay_rate*length < step_part) carried = min(most_carried, step_part/max(decay_rate*length, tiny(1.0_wp)))
      errors%carried = max(errors%carried, carried)
      errors%decay_rate = max(errors%decay_rate, abs(decay_rate))
      associate (contact => state%contact)
         errors%loses_contact = errors%loses_contact .or. .not. contact%is_touching
         if (.not. contact%is_touching) return
         traction = min(carried*abs(contact%traction_slope)*errors%allowed, errors%tolerance*(largest_shear(model, contact) &
            & + contact%boundary_capacity)) + abs(contact%traction_slope)*slip
         errors%torque = max(errors%torque, margin*torque_with(model, state, carried*errors%allowed + slip, traction))
      end associate
   end subroutine judge_state

   !> Take in the middle of each interval of a piece.
   subroutine judge_intervals(errors, model, piece, error)
      !> The errors
      type(slip_error_t), intent(inout) :: errors
      !> Model of the lobe, which follows the inputs
      type(model_t), intent(inout) :: model
      !> The piece
      type(cycle_t), intent(in) :: piece
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angle from full lift [rad]
      real(wp) :: angle
      integer :: i, hint

      hint = 1
      associate (times => piece%trajectory%time(:piece%trajectory%count))
         do i = 1, size(times) - 1
            angle = times(i) + 0.5_wp*(times(i + 1) - times(i))
            ! Two points at a stop are no interval
            if (times(i + 1) - times(i) <= roundings*spacing(times(i))) cycle
            call follow_ramp(model, angle)
            ! What settles is judged as it was: the error of the curve decides about its traction
            call state_at(piece, model, angle, hint, state, error, settles=.false.)
            if (allocated(error)) return
            if (state%contact%is_touching) then
               call judge_curve(errors, model, piece, angle, i, state)
            else
               errors%loses_contact = .true.
            end if
         end do
      end associate
   end subroutine judge_intervals

   !> Is the curve good enough?
   elemental function is_good(errors) result(verdict)
      !> The errors
      type(slip_error_t), intent(in) :: errors
      !> Is it?
      logical :: verdict

      verdict = errors%excess <= 1.0_wp
   end function is_good

   !> Error of the mean torque that drives over a piece by the spin at its ends, whose energies are what the roller's inertia takes:
   !> one at each end where the roller slides; where it rests on friction its spin is exact. Where it slides all the way, the error
   !> at the end is that at the start but for what decays between them and what the defect of the curve adds.
   pure function spin_error(errors, model, piece, spin) result(error)
      !> Errors of the piece
      type(slip_error_t), intent(in) :: errors
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> The piece
      type(cycle_t), intent(in) :: piece
      !> Spin of the roller [rad/s]
      real(wp), intent(in) :: spin
      !> The error [N m]
      real(wp) :: error

      ! Error of the sliding speed at an end, sum of both, rounding of the spin [m/s]; length [rad]
      real(wp) :: slip, both, rounding, length

      error = 0.0_wp
      if (.not. model%is_consistent) return
      associate (path => piece%trajectory)
         length = path%time(path%count) - path%time(1)
         rounding = several*spacing(spin*model%roller_radius)
         slip = errors%allowed*max(errors%carried, errors%excess)
         both = slip*count(abs(path%state(1, [1, path%count])) > 0.0_wp)
         if (all(abs(path%state(1, [1, path%count])) > 0.0_wp) .and. errors%has_defect .and. .not. errors%loses_contact) then
            both = min(both, margin*(errors%decay_rate*slip + errors%defect)*length)
         end if
         error = model%roller_inertia*abs(spin)*(both + 2.0_wp*rounding)/(model%roller_radius*length)
      end associate
   end function spin_error

   !> Error of the torque that drives by errors of sliding speed and traction. Film and capacity stay as they are, and what slip
   !> adds to one loss and takes from another does not cancel. The traction changes the load, and with it the losses beside the
   !> contact.
   pure function torque_with(model, state, slip, traction) result(error)
      !> Model of the lobe, set to the inputs there
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      !> Error of the sliding speed [m/s], and of the traction, of either sign [N]
      real(wp), intent(in) :: slip, traction
      !> The error [N m]
      real(wp) :: error

      associate (contact => state%contact, position => state%position)
         error = abs(contact%bearing_torque)*slip/(model%roller_radius*model%speed)
         if (.not. model%is_consistent) then
            error = error + abs(traction*position%cam_arm)
            return
         end if
         error = error + ((abs(contact%traction) + abs(contact%rolling_resistance))*slip + abs(contact%sliding_speed*traction)) &
            & /model%speed
         if (contact%load > 0.0_wp) error = error + abs(traction*position%tangent_arm/(position%normal_arm*contact%load) &
            & *(state%torque_friction - state%torques(of_contact)))
      end associate
   end function torque_with

end module camroller_step_error
