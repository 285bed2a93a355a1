!> What a turn of a flexible train is judged by: largest and smallest values, means, impacts, losses.
!>
!> In: the steps of a turn. Out: measures by number; a name, a unit and a meaning for each. Integrals are taken over each step with
!> the state on the step's own curve, extremes from the points of that rule, the ends of steps, and the state where the parabola
!> through three points in a row has its vertex. Joint and check valve open and close between points, where straight lines between
!> them pass through zero.
module camroller_flexible_measures
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_trajectory, only : trajectory_t, interpolate_state
   use camroller_quadrature, only : gauss_legendre
   use camroller_flexible_measure_list, only : largest_load, largest_load_angle, smallest_event_load, &
      & event_pivot_force, seating_speed, bounce_height, bounces, losses_of_contact, drive_torque, loss_torque, &
      & damping_torque, tension_share, highest_plunger, leak_volume, check_share, residual_work, gallery_torque, &
      & event_check_share, damper_works, lift_at_nose, speed_at_nose, closed_load, extremes, smallest, most_lift_error, &
      & float_share, seated_share
   use camroller_flexible_sample, only : sample_t, look, is_closed
   use camroller_flexible_train, only : flexible_state_t, resolution_t, at_lift, at_speed
   use camroller_flexible_energy, only : powers_t, evaluate_powers
   use camroller_torque_list, only : is_loss, of_damping
   implicit none
   private

   public :: measure_turn, largest_lift

   !> Points of the rule for a step
   integer, parameter :: points = 3

contains

   !> Measure a turn.
   subroutine measure_turn(model, trajectory, resolution, values, error)
      !> The model
      type(model_t), intent(in) :: model
      !> Its steps
      type(trajectory_t), intent(in) :: trajectory
      !> What its integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> The measures [unit of the measure]
      real(wp), intent(out) :: values(:)
      !> Convergence error where a state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      ! Places and weights of the rule on [-1, 1] [-]; length of a step [rad], largest rigid lift [m]
      real(wp) :: places(points), weights(points), length, top
      ! The last three points, the newest last
      type(sample_t) :: samples(3)
      real(wp) :: state(size(trajectory%state, 1)) ! at full lift [state]
      integer :: step, i, hint
      logical :: has_met, has_touched

      call gauss_legendre(places, weights)
      values = 0.0_wp
      associate (least => smallest(:count(smallest <= size(values))))
         values(least) = huge(1.0_wp)
      end associate
      values(most_lift_error) = -huge(1.0_wp)
      if (size(values) > residual_work) values(highest_plunger) = -huge(1.0_wp)
      top = largest_lift(model)
      has_met = .false.
      has_touched = .false.
      do step = 1, trajectory%count - 1
         length = trajectory%time(step + 1) - trajectory%time(step)
         do i = 1, points
            ! From one side of a stop to the other
            if (length <= 1.0e-13_wp) exit
            call add(trajectory%time(step) + 0.5_wp*length*(1.0_wp + places(i)), 0.5_wp*length*weights(i)/two_pi)
            if (allocated(error)) return
         end do
         call add(trajectory%time(step + 1), 0.0_wp)
         if (allocated(error)) return
         associate (last => samples(3))
            if (has_touched .and. .not. last%touches) values(losses_of_contact) = values(losses_of_contact) + 1.0_wp
            has_touched = last%touches
            ! What the valve does before it opens is no bounce, be it the rattle of a finger with lash or a second lift
            if (last%is_rising) has_met = .false.
         end associate
         call follow_seat(trajectory%state([at_lift, at_speed], step), trajectory%state([at_lift, at_speed], step + 1), has_met, &
            & values)
      end do
      ! Means over the turn become energies and a volume of it
      values(residual_work) = values(residual_work)*two_pi
      associate (works => damper_works(:count(damper_works <= size(values))))
         values(works) = values(works)*two_pi
      end associate
      if (size(values) > residual_work) values(leak_volume) = values(leak_volume)*two_pi
      hint = 1
      call interpolate_state(trajectory, 0.0_wp, hint, state)
      values([lift_at_nose, speed_at_nose]) = state([at_lift, at_speed])

   contains

      !> Take a point of the step into the measures, and what lies between it and the ones before.
      subroutine add(angle, weight)
         !> Cam angle [rad]; part of the turn that it stands for [-]
         real(wp), intent(in) :: angle, weight

         hint = step
         call interpolate_state(trajectory, angle, hint, state)
         samples(:2) = samples(2:)
         call add_point(model, angle, state, resolution, weight, top, values, samples(3), error)
         if (allocated(error)) return
         samples(3)%has_met = has_met .and. .not. samples(3)%is_rising
         call take_extremes(samples(3), values)
         call add_interval(samples(2), samples(3), values)
         call add_vertices(model, trajectory, resolution, top, samples, values, error)
         if (.not. allocated(error)) call add_edge(model, trajectory, resolution, top, samples(2:), values, error)
      end subroutine add

   end subroutine measure_turn

   !> Largest lift of the rigid train.
   function largest_lift(model) result(top)
      !> The model
      type(model_t), intent(in) :: model
      !> The lift [m]
      real(wp) :: top

      type(position_t) :: position
      integer :: i, status

      top = 0.0_wp
      do i = -180, 179
         call evaluate_geometry(model, i*degree, position, status)
         if (status == 0) top = max(top, position%lift)
      end do
   end function largest_lift

   !> Take the means at a point into the measures.
   subroutine add_point(model, angle, state, resolution, weight, top, values, sample, error)
      type(model_t), intent(in) :: model
      !> Cam angle [rad]
      real(wp), intent(in) :: angle
      !> State there [state]
      real(wp), intent(in) :: state(:)
      !> What the integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Part of the turn that it stands for [-]
      real(wp), intent(in) :: weight
      !> Largest lift of the rigid train [m]
      real(wp), intent(in) :: top
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)
      !> What is kept of the point
      type(sample_t), intent(out) :: sample
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      type(flexible_state_t) :: now
      type(powers_t) :: powers
      type(position_t) :: position

      call look(model, angle, state, resolution, top, now, position, sample, error)
      if (allocated(error)) return
      if (weight <= 0.0_wp) return
      call evaluate_powers(model, state, now, powers)
      if (position%lift > 0.0_wp .and. .not. sample%load > 0.0_wp) values(float_share) = values(float_share) + weight
      if (state(at_lift) <= 0.0_wp) values(seated_share) = values(seated_share) + weight
      values(drive_torque) = values(drive_torque) + weight*powers%drive/model%speed
      values(loss_torque) = values(loss_torque) + weight*sum(powers%losses, mask=is_loss)/model%speed
      values(damping_torque) = values(damping_torque) + weight*powers%losses(of_damping)/model%speed
      values(residual_work) = values(residual_work) + weight*powers%residual/model%speed
      associate (works => damper_works(:count(damper_works <= size(values))))
         values(works) = values(works) + weight*powers%dampers(:size(works))/model%speed
      end associate
      if (size(values) == residual_work) return
      values(leak_volume) = values(leak_volume) + weight*now%flows%leak/model%speed
      values(gallery_torque) = values(gallery_torque) + weight*powers%gallery/model%speed
   end subroutine add_point

   !> Does a point count for a measure that is an extreme?
   elemental function does_count(sample, measure) result(verdict)
      type(sample_t), intent(in) :: sample
      !> Its number
      integer, intent(in) :: measure
      !> Does it?
      logical :: verdict

      select case (measure)
      case (smallest_event_load, event_pivot_force)
         verdict = sample%height >= 0.0_wp
      case (closed_load)
         verdict = sample%is_closed
      case (bounce_height)
         verdict = sample%has_met
      case default
         verdict = .true.
      end select
   end function does_count

   !> Take what a point has into the measures that are extremes.
   pure subroutine take_extremes(sample, values)
      type(sample_t), intent(in) :: sample
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)

      integer :: i

      if (sample%load > values(largest_load)) values(largest_load_angle) = sample%angle
      do i = 1, size(extremes)
         associate (measure => extremes(i))
            if (measure > size(values)) return
            if (.not. does_count(sample, measure)) cycle
            if (any(smallest == measure)) then
               values(measure) = min(values(measure), sample%extremes(measure))
            else
               values(measure) = max(values(measure), sample%extremes(measure))
            end if
         end associate
      end do
   end subroutine take_extremes

   !> Take the state at each vertex between three points into the measures that are extremes, if the parabola has a better value
   !> there.
   subroutine add_vertices(model, trajectory, resolution, top, samples, values, error)
      type(model_t), intent(in) :: model
      type(trajectory_t), intent(in) :: trajectory
      !> What the integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Largest lift of the rigid train [m]
      real(wp), intent(in) :: top
      !> The points in a row
      type(sample_t), intent(in) :: samples(3)
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      ! Angles [rad], values with their sign turned for a smallest one, that of the parabola [unit of the measure], its place [rad]
      real(wp) :: angles(3), three(3), sense, best, place
      integer :: i

      angles = samples%angle
      if (angles(1) >= angles(2) .or. angles(2) >= angles(3)) return
      do i = 1, size(extremes)
         associate (measure => extremes(i))
            if (measure > size(values)) return
            sense = merge(-1.0_wp, 1.0_wp, any(smallest == measure))
            three = sense*samples%extremes(measure)
            if (three(2) < maxval(three) .or. .not. three(2) > minval(three)) cycle
            if (.not. all(does_count(samples, measure))) cycle
            call find_vertex(angles, three, place, best)
            if (.not. best > sense*values(measure)) cycle
         end associate
         call take_state(model, trajectory, resolution, top, place, all(samples%has_met), values, error)
         if (allocated(error)) return
      end do
   end subroutine add_vertices

   !> Take the state where the event begins or ends between two points into the measures, on the side on which the valve is closed:
   !> the load may be largest there.
   subroutine add_edge(model, trajectory, resolution, top, samples, values, error)
      type(model_t), intent(in) :: model
      type(trajectory_t), intent(in) :: trajectory
      !> What the integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Largest lift of the rigid train [m]
      real(wp), intent(in) :: top
      !> The points
      type(sample_t), intent(in) :: samples(2)
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      ! Halvings of the way between the points
      integer, parameter :: halvings = 40
      type(position_t) :: position
      ! Angles on the closed side and on the other one, between them [rad]
      real(wp) :: closed, open, middle
      integer :: i, status

      if (samples(1)%angle >= samples(2)%angle .or. (samples(1)%is_closed .eqv. samples(2)%is_closed)) return
      closed = merge(samples(1)%angle, samples(2)%angle, samples(1)%is_closed)
      open = merge(samples(2)%angle, samples(1)%angle, samples(1)%is_closed)
      do i = 1, halvings
         middle = 0.5_wp*(closed + open)
         call evaluate_geometry(model, middle, position, status)
         if (status /= 0) exit
         if (is_closed(model, middle, position%lift, top)) then
            closed = middle
         else
            open = middle
         end if
      end do
      call take_state(model, trajectory, resolution, top, closed, all(samples%has_met), values, error)
   end subroutine add_edge

   !> Take the state at an angle of a turn into the measures that are extremes.
   subroutine take_state(model, trajectory, resolution, top, angle, has_met, values, error)
      type(model_t), intent(in) :: model
      type(trajectory_t), intent(in) :: trajectory
      !> What the integration did not tell apart
      type(resolution_t), intent(in) :: resolution
      !> Largest lift of the rigid train [m]; cam angle [rad]
      real(wp), intent(in) :: top, angle
      !> Has the valve met its seat after the event?
      logical, intent(in) :: has_met
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      type(flexible_state_t) :: now
      type(position_t) :: position
      type(sample_t) :: sample
      real(wp) :: state(size(trajectory%state, 1)) ! [state]
      integer :: hint

      hint = 1
      call interpolate_state(trajectory, angle, hint, state)
      call look(model, angle, state, resolution, top, now, position, sample, error)
      if (allocated(error)) return
      sample%has_met = has_met
      call take_extremes(sample, values)
   end subroutine take_state

   !> Highest point of the parabola through three points of which the second is not the lowest of all.
   pure subroutine find_vertex(angles, three, place, best)
      !> Angles, which grow [rad], and values of the points, the second the largest or beside an equal one [any]
      real(wp), intent(in) :: angles(3), three(3)
      !> Angle [rad] and value [any] of the vertex
      real(wp), intent(out) :: place, best

      ! Lengths of both intervals [rad], their slopes, that of the parabola at the second point [any/rad], its bend [any/rad^2]
      real(wp) :: lengths(2), slopes(2), slope, bend

      lengths = [angles(2) - angles(1), angles(3) - angles(2)]
      slopes = [three(2) - three(1), three(3) - three(2)]/lengths
      bend = (slopes(2) - slopes(1))/(angles(3) - angles(1))
      slope = slopes(1) + bend*lengths(1)
      place = angles(2) - 0.5_wp*slope/bend
      best = three(2) - slope**2/(4.0_wp*bend)
   end subroutine find_vertex

   !> Take the interval between two points into the measures: where the event begins or ends in it, and what opens or closes.
   pure subroutine add_interval(last, sample, values)
      !> Its two points
      type(sample_t), intent(in) :: last, sample
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)

      ! Length over the turn [-], part of it with the check valve open [-], place of the event's edge [-]
      real(wp) :: length, open, place
      integer :: places(2)

      places = [smallest_event_load, event_pivot_force]
      if (last%angle > sample%angle) return
      if ((last%height < 0.0_wp) .neqv. (sample%height < 0.0_wp)) then
         place = last%height/(last%height - sample%height)
         values(places) = min(values(places), [last%load + place*(sample%load - last%load), last%joint + place*(sample%joint &
            & - last%joint)])
      end if
      length = (sample%angle - last%angle)/two_pi
      values(tension_share) = values(tension_share) + length*negative_part(last%joint, sample%joint)
      if (size(values) == residual_work) return
      open = negative_part(last%shut, sample%shut)
      values(check_share) = values(check_share) + length*open
      if (last%is_low .and. sample%is_low) return
      if (min(last%height, sample%height) >= 0.0_wp) values(event_check_share) = values(event_check_share) + length*open
   end subroutine add_interval

   !> Part of a straight line below zero.
   pure function negative_part(first, last) result(part)
      !> Its ends [any]
      real(wp), intent(in) :: first, last
      !> The part [-]
      real(wp) :: part

      part = merge(1.0_wp, 0.0_wp, max(first, last) < 0.0_wp)
      if (min(first, last) < 0.0_wp .and. max(first, last) >= 0.0_wp) part = min(first, last)/(min(first, last) - max(first, last))
   end function negative_part

   !> Take a step at the seat into the measures: the valve meets its seat where its lift passes zero.
   pure subroutine follow_seat(start, end, has_met, values)
      !> Lift [m] and speed [m/s] of the valve at both ends of the step
      real(wp), intent(in) :: start(2), end(2)
      !> Has it met its seat after the event?
      logical, intent(inout) :: has_met
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)

      ! Place of the meeting in the step [-]
      real(wp) :: place

      if (start(1) > 0.0_wp .and. end(1) <= 0.0_wp) then
         place = start(1)/(start(1) - end(1))
         values(seating_speed) = max(values(seating_speed), -(start(2) + place*(end(2) - start(2))))
         has_met = .true.
      else if (has_met .and. start(1) <= 0.0_wp .and. end(1) > 0.0_wp) then
         values(bounces) = values(bounces) + 1.0_wp
      end if
   end subroutine follow_seat

end module camroller_flexible_measures
