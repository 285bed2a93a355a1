!> What a turn of a flexible train is judged by: largest and smallest values, means, impacts, losses.
!>
!> In: the steps of a turn. Out: measures by number; a name, a unit and a meaning for each. Integrals are taken over each step with
!> the state on the step's own curve, extremes from the points of that rule and the ends of steps. Joint and check valve open and
!> close between such points, where straight lines between them pass through zero.
module camroller_flexible_measures
   use camroller_kinds, only : wp, two_pi, pi, degree
   use camroller_names, only : name_length
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_kinematics, only : position_t
   use camroller_trajectory, only : trajectory_t, interpolate_state
   use camroller_lash_adjuster, only : lash_adjuster_t, opening_pressure
   use camroller_lift, only : is_at_rest, is_tabulated
   use camroller_quadrature, only : gauss_legendre
   use camroller_flexible_geometry, only : dot
   use camroller_flexible_train, only : flexible_state_t, resolution_t, evaluate_train, first_mode, at_finger_rate, at_lift, &
      & at_speed
   use camroller_flexible_energy, only : powers_t, evaluate_powers
   use camroller_flexible_parts, only : damper_count
   use camroller_spring_modes, only : wave_compression
   use camroller_torque_list, only : is_loss, of_damping
   implicit none
   private

   public :: measures, measure_count, measure_turn, pivot_force, largest_lift, largest_load, largest_load_angle, &
      & smallest_event_load, event_pivot_force, least_lift_error, seating_speed, bounce_height, bounces, &
      & losses_of_contact, drive_torque, loss_torque, damping_torque, smallest_pivot_force, tension_share, &
      & surge_force, coil_ratio, coil_compression, lowest_plunger, highest_plunger, largest_chamber_pressure, leak_volume, &
      & check_share, residual_work, &
      & gallery_torque, event_check_share, damper_works, lift_at_nose, speed_at_nose, smallest_lift, closed_load

   !> A measure: its name, unit and meaning
   type :: measure_t
      character(len=name_length) :: name
      character(len=12) :: unit
      character(len=100) :: meaning
   end type measure_t

   !> What is kept of a point for the interval to the next one
   type :: sample_t
      !> Cam angle; huge before the first point [rad]
      real(wp) :: angle = huge(1.0_wp)
      !> Rigid lift less that above which a load counts as one of the event [m], contact load [N]
      real(wp) :: height = -1.0_wp, load = 0.0_wp
      !> Force in the joint [N]; pressure above that at which the check valve opens [Pa]
      real(wp) :: joint, shut
      !> Does the rigid lift rise there, above what is none of it? Is the plunger on its lower stop?
      logical :: is_rising = .false., is_low = .false.
      !> Cam angle of the point before [rad], force in the joint there [N]
      real(wp) :: angle_before = huge(1.0_wp), joint_before = 0.0_wp
   end type sample_t

   !> Places in the list
   integer, parameter :: largest_load = 1, largest_load_angle = 2, smallest_event_load = 3, least_lift_error = 4, &
      & most_lift_error = 5, seating_speed = 6, bounce_height = 7, bounces = 8, float_share = 9, losses_of_contact = 10, &
      & drive_torque = 11, loss_torque = 12, damping_torque = 13, smallest_pivot_force = 14, tension_share = 15, &
      & surge_force = 16, coil_ratio = 17, event_pivot_force = 18, lift_at_nose = 19, speed_at_nose = 20, smallest_lift = 25, &
      & seated_share = 26, closed_load = 27, coil_compression = 28, residual_work = 29, lowest_plunger = 30, highest_plunger = 31, &
      & largest_chamber_pressure = 32, leak_volume = 33, check_share = 34, gallery_torque = 35, event_check_share = 36
   !> Places of the energies lost in the dampers, in the order of `powers_t`; the last four are of the adjuster
   integer, parameter :: damper_works(damper_count) = [21, 22, 23, 24, 37, 38, 39, 40]

   !> The measures; those of the adjuster last
   type(measure_t), parameter :: measures(*) = [ &
      & measure_t("dynamic_load_max", "N", "largest contact load"), &
      & measure_t("dynamic_load_max_angle", "rad", "cam angle of the largest contact load; full lift is at 180 deg"), &
      & measure_t("dynamic_load_min", "N", "smallest contact load with the valve in the upper three quarters of its lift"), &
      & measure_t("lift_error_min", "m", "smallest lift less that of a rigid train"), &
      & measure_t("lift_error_max", "m", "largest lift less that of a rigid train"), &
      & measure_t("seating_speed", "m s-1", "largest speed at which the valve meets its seat; 0 where it does not close"), &
      & measure_t("bounce_height", "m", "largest lift after the valve has first met its seat"), &
      & measure_t("bounces", "1", "times that the valve leaves its seat after it has first met it"), &
      & measure_t("float_share", "1", "part of the cycle with the rigid train in its event and no load between cam and roller"), &
      & measure_t("losses_of_contact", "1", "times that cam and roller part"), &
      & measure_t("dynamic_torque", "N m", "mean torque of cam and follower"), &
      & measure_t("dynamic_loss_torque", "N m", "mean torque of all losses of cam and follower, but those that the gas pays"), &
      & measure_t("damping_torque", "N m", "mean torque of the losses in dampers, leak and check valve, but those that the "// &
      & "gas pays"), &
      & measure_t("joint_force_min", "N", "smallest force in the joint of finger and pivot; negative: the socket would open"), &
      & measure_t("joint_tension_share", "1", "part of the cycle with tension in that joint"), &
      & measure_t("surge_force", "N", "largest force of the spring's first mode"), &
      & measure_t("coil_ratio", "1", "largest part of the spring's compression that waves take from coils; at 1 none is left"), &
      & measure_t("joint_force_min_event", "N", "smallest force in that joint in the upper three quarters of the lift"), &
      & measure_t("valve_lift_at_nose", "m", "lift at the cam angle of full lift"), &
      & measure_t("valve_velocity_at_nose", "m s-1", "speed of the valve at the cam angle of full lift"), &
      & measure_t("damping_work_cam", "J", "energy lost per turn in the damping of cam and roller"), &
      & measure_t("damping_work_pad", "J", "energy lost per turn in the damping of the pad at the valve"), &
      & measure_t("damping_work_seat", "J", "energy lost per turn in the damping of the valve seat"), &
      & measure_t("damping_work_spring", "J", "energy lost per turn in the damping of the spring's modes"), &
      & measure_t("least_valve_lift", "m", "smallest lift of the turn; above 0 where the valve does not close"), &
      & measure_t("seated_share", "1", "part of the cycle with the valve on its seat"), &
      & measure_t("closed_load_max", "N", "largest contact load with the rigid train's valve closed"), &
      & measure_t("coil_compression_max", "m", "largest compression of a part of the spring from free length, as of all of it"), &
      & measure_t("energy_residual_work", "J", "drive less losses less stored energy over the turn, and gallery"), &
      & measure_t("plunger_lowest", "m", "lowest place of the plunger"), &
      & measure_t("plunger_highest", "m", "highest place of the plunger"), &
      & measure_t("chamber_pressure_max", "Pa", "largest pressure in the adjuster's chamber"), &
      & measure_t("leak_volume", "m3", "oil that leaks along the plunger in a turn"), &
      & measure_t("check_valve_share", "1", "part of the cycle with the check valve open"), &
      & measure_t("gallery_torque", "N m", "mean power from the oil gallery over the cam's speed"), &
      & measure_t("pump_up_share", "1", "part of the cycle with the check valve open and the plunger off its lower stop in the "// &
      & "event"), &
      & measure_t("damping_work_plunger", "J", "energy lost per turn in the oil film between plunger and bore"), &
      & measure_t("damping_work_stops", "J", "energy lost per turn in the damping of the plunger's stops"), &
      & measure_t("damping_work_leak", "J", "energy lost per turn by the oil that leaks along the plunger"), &
      & measure_t("damping_work_check_valve", "J", "energy lost per turn by the oil that passes the check valve")]
   !> How many there are without an adjuster, and with one
   integer, parameter :: measure_count(2) = [residual_work, size(measures)]
   !> Part of the largest lift above which a load counts as one of the event [-]
   real(wp), parameter, public :: event_part = 0.25_wp
   !> What is above it, in words
   character(len=*), parameter, public :: event_words = "upper 3/4 of the lift"
   !> Part of the largest lift below which a table's noise may be all that rises [-]
   real(wp), parameter :: noise_part = 1.0e-3_wp
   !> Part of a plunger's travel above its lower stop in which it counts as on it: it may tremble and bounce there [-]
   real(wp), parameter :: low_part = 0.05_wp
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

      ! Places and weights of the rule on [-1, 1] [-]; length of a step and angle [rad], state [state]; largest rigid lift [m]
      real(wp) :: places(points), weights(points), length, angle, state(size(trajectory%state, 1)), top
      type(sample_t) :: last
      integer :: step, i, hint
      logical :: has_met, touches, has_touched

      call gauss_legendre(places, weights)
      values = 0.0_wp
      values([smallest_event_load, least_lift_error, smallest_pivot_force, event_pivot_force, smallest_lift]) = huge(1.0_wp)
      values(most_lift_error) = -huge(1.0_wp)
      if (size(values) > residual_work) then
         values(lowest_plunger) = huge(1.0_wp)
         values(highest_plunger) = -huge(1.0_wp)
      end if
      top = largest_lift(model)
      has_met = .false.
      has_touched = .false.
      do step = 1, trajectory%count - 1
         length = trajectory%time(step + 1) - trajectory%time(step)
         if (length <= 1.0e-13_wp) cycle
         do i = 1, points
            angle = trajectory%time(step) + 0.5_wp*length*(1.0_wp + places(i))
            hint = step
            call interpolate_state(trajectory, angle, hint, state)
            call add_point(model, angle, state, resolution, 0.5_wp*length*weights(i)/two_pi, top, values, last, touches, error)
            if (allocated(error)) return
         end do
         call add_point(model, trajectory%time(step + 1), trajectory%state(:, step + 1), resolution, 0.0_wp, top, values, last, &
            & touches, error)
         if (allocated(error)) return
         if (has_touched .and. .not. touches) values(losses_of_contact) = values(losses_of_contact) + 1.0_wp
         has_touched = touches
         ! What the valve does before it opens is no bounce, be it the rattle of a finger with lash or a second lift
         if (last%is_rising) has_met = .false.
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

   !> Take a point into the measures.
   subroutine add_point(model, angle, state, resolution, weight, top, values, last, touches, error)
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
      !> In: the point before; out: this one
      type(sample_t), intent(inout) :: last
      !> Do cam and roller touch there?
      logical, intent(out) :: touches
      !> Convergence error where the state cannot be evaluated
      type(error_t), allocatable, intent(out) :: error

      type(flexible_state_t) :: now
      type(powers_t) :: powers
      type(position_t) :: position
      type(sample_t) :: sample
      ! Smallest force in the joint between the last points [N]
      real(wp) :: least
      integer :: status

      touches = .false.
      call evaluate_train(model, angle, state, resolution, now, status)
      if (status == 0) call evaluate_geometry(model, angle, position, status)
      if (status /= 0) then
         call raise(error, kind_convergence, "a state between the steps of the flexible train cannot be evaluated")
         return
      end if
      touches = now%contact%is_touching
      call evaluate_powers(model, state, now, powers)
      if (now%contact%load > values(largest_load)) then
         values(largest_load) = now%contact%load
         values(largest_load_angle) = angle
      end if
      call add_lift(state(at_lift), position%lift, is_at_rest(model%lift_law, angle) .or. (is_tabulated(model%lift_law) &
         & .and. position%lift <= noise_part*top), now%contact%load, weight, values)
      sample = sample_t(angle, position%lift - event_part*top, now%contact%load, pivot_force(model, state, now), 0.0_wp, &
         & position%lift_slope > 0.0_wp .and. position%lift > noise_part*top)
      if (allocated(model%flexible%adjuster)) then
         sample%shut = now%pressure - opening_pressure(model%flexible%adjuster)
         sample%is_low = is_on_stop(model%flexible%adjuster%given, now%pivot)
      end if
      call add_interval(last, sample, values)
      least = least_joint_force(last, sample)
      values(smallest_pivot_force) = min(values(smallest_pivot_force), sample%joint, least)
      if (last%height >= 0.0_wp) values(event_pivot_force) = min(values(event_pivot_force), least)
      sample%angle_before = last%angle
      sample%joint_before = last%joint
      last = sample
      values(drive_torque) = values(drive_torque) + weight*powers%drive/model%speed
      values(loss_torque) = values(loss_torque) + weight*sum(powers%losses, mask=is_loss)/model%speed
      values(damping_torque) = values(damping_torque) + weight*powers%losses(of_damping)/model%speed
      values(residual_work) = values(residual_work) + weight*powers%residual/model%speed
      associate (works => damper_works(:count(damper_works <= size(values))))
         values(works) = values(works) + weight*powers%dampers(:size(works))/model%speed
      end associate
      call add_spring(model, state, values)
      if (size(values) == residual_work) return
      values(lowest_plunger) = min(values(lowest_plunger), now%pivot)
      values(highest_plunger) = max(values(highest_plunger), now%pivot)
      values(largest_chamber_pressure) = max(values(largest_chamber_pressure), now%pressure)
      values(leak_volume) = values(leak_volume) + weight*now%flows%leak/model%speed
      values(gallery_torque) = values(gallery_torque) + weight*powers%gallery/model%speed
   end subroutine add_point

   !> Is a plunger on its lower stop?
   pure function is_on_stop(given, place) result(is_low)
      type(lash_adjuster_t), intent(in) :: given
      !> Place of the plunger [m]
      real(wp), intent(in) :: place
      logical :: is_low

      is_low = place <= given%lowest + low_part*(given%highest - given%lowest)
   end function is_on_stop

   !> Take a lift, and the load at it, into the measures.
   pure subroutine add_lift(lift, rigid, is_closed, load, weight, values)
      !> Lift of the valve, and that of a rigid train [m]
      real(wp), intent(in) :: lift, rigid
      !> Is the latter at rest, or what of it may be noise of a table?
      logical, intent(in) :: is_closed
      !> Contact load [N]
      real(wp), intent(in) :: load
      !> Part of the turn that it stands for [-]
      real(wp), intent(in) :: weight
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)

      if (rigid > 0.0_wp .and. .not. load > 0.0_wp) values(float_share) = values(float_share) + weight
      if (is_closed) values(closed_load) = max(values(closed_load), load)
      values(smallest_lift) = min(values(smallest_lift), lift)
      if (lift <= 0.0_wp) values(seated_share) = values(seated_share) + weight
      values(least_lift_error) = min(values(least_lift_error), lift - rigid)
      values(most_lift_error) = max(values(most_lift_error), lift - rigid)
   end subroutine add_lift

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
      if (sample%height >= 0.0_wp) values(places) = min(values(places), [sample%load, sample%joint])
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

   !> Smallest force in the joint between points, by the parabola through three in a row of which the middle one is the lowest.
   pure function least_joint_force(last, sample) result(force)
      !> The second of the three, with what it knows of the first; the third
      type(sample_t), intent(in) :: last, sample
      !> The force; huge where another one is lower [N]
      real(wp) :: force

      ! Longer over shorter interval above which a parabola goes far below its points where the force has a kink [-]
      real(wp), parameter :: longest_ratio = 4.0_wp
      ! Lengths of both intervals [rad], their slopes, that of the parabola at the second point [N/rad], its bend [N/rad^2]
      real(wp) :: lengths(2), slopes(2), slope, bend

      force = huge(1.0_wp)
      if (last%angle_before >= last%angle .or. last%angle >= sample%angle) return
      if (last%joint >= min(last%joint_before, sample%joint)) return
      lengths = [last%angle - last%angle_before, sample%angle - last%angle]
      if (maxval(lengths) > longest_ratio*minval(lengths)) return
      slopes = [last%joint - last%joint_before, sample%joint - last%joint]/lengths
      bend = (slopes(2) - slopes(1))/(sample%angle - last%angle_before)
      slope = slopes(1) + bend*(last%angle - last%angle_before)
      force = last%joint - slope**2/(4.0_wp*bend)
   end function least_joint_force

   !> Part of a straight line below zero.
   pure function negative_part(first, last) result(part)
      !> Its ends [any]
      real(wp), intent(in) :: first, last
      !> The part [-]
      real(wp) :: part

      part = merge(1.0_wp, 0.0_wp, max(first, last) < 0.0_wp)
      if (min(first, last) < 0.0_wp .and. max(first, last) >= 0.0_wp) part = min(first, last)/(min(first, last) - max(first, last))
   end function negative_part

   !> Take the spring's modes into the measures.
   pure subroutine add_spring(model, state, values)
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> The measures [unit of the measure]
      real(wp), intent(inout) :: values(:)

      ! Compression of the whole spring; what waves add to it, at least and at most [m]
      real(wp) :: compression, added(2)
      integer :: first

      compression = state(at_lift) + model%train%precompression
      values(coil_compression) = max(values(coil_compression), compression)
      if (model%flexible%modes%count == 0) return
      first = first_mode(model)
      added = wave_compression(model%flexible%modes, state(first:first + 2*model%flexible%modes%count - 2:2))
      values(coil_compression) = max(values(coil_compression), compression + added(2))
      values(surge_force) = max(values(surge_force), model%train%stiffness*pi*abs(state(first)))
      values(coil_ratio) = max(values(coil_ratio), -added(1)/compression)
   end subroutine add_spring

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

      if (has_met) values(bounce_height) = max(values(bounce_height), end(1))
      if (start(1) > 0.0_wp .and. end(1) <= 0.0_wp) then
         place = start(1)/(start(1) - end(1))
         values(seating_speed) = max(values(seating_speed), -(start(2) + place*(end(2) - start(2))))
         has_met = .true.
      else if (has_met .and. start(1) <= 0.0_wp .and. end(1) > 0.0_wp) then
         values(bounces) = values(bounces) + 1.0_wp
      end if
   end subroutine follow_seat

   !> Force in the joint of finger and pivot along the adjuster's axis; negative where the socket would open.
   pure function pivot_force(model, state, now) result(force)
      !> The model
      type(model_t), intent(in) :: model
      !> The state [state]
      real(wp), intent(in) :: state(:)
      !> Everything there
      type(flexible_state_t), intent(in) :: now
      !> The force [N]
      real(wp) :: force

      associate (flexible => model%flexible, touch => now%touch)
         if (allocated(flexible%adjuster)) then
            force = now%hydraulic_force + now%stops(1)%force - now%stops(2)%force &
               & - flexible%adjuster%given%plunger_mass*now%pivot_acceleration
         else
            force = -dot(flexible%axis, now%contact%load*touch%normal &
               & - now%contact%tangential_force*touch%forward) - flexible%tilt_cosine*now%pad%force &
               & + flexible%tilt_sine*now%tip_friction &
               & + flexible%finger_mass*(now%centre_slope*now%finger_acceleration + now%centre_curvature*state(at_finger_rate)**2)
         end if
      end associate
   end function pivot_force

end module camroller_flexible_measures
