!> Margins against loss of contact, against opening of the pivot's joint and against gas that opens the valve: smallest force, its
!> cam angle, and the cam speed at which it would be zero. Computed without friction, so they depend on the cam angle only.
!>
!> In: model, stops of a cycle. Out: margins of the event, of the base circle and of the pivot. Between two stops every force is
!> a smooth function of the cam angle; each such interval is scanned, ends included, and an interior minimum is located to
!> round-off.
module camroller_margins
   use camroller_kinds, only : wp, pi, degree, infinite_if_huge
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_gas, only : gas_force
   use camroller_lift, only : is_at_rest
   use camroller_minimum, only : minimum_t, start_minimum, narrow_minimum
   use camroller_kinematics, only : position_t, arm_angle_at, evaluate_position
   use camroller_dynamics, only : moments_t
   use camroller_pivot, only : pivot_force
   use camroller_state, only : evaluate_loading
   use camroller_torque, only : normal_direction
   implicit none
   private

   public :: margin_t, margins_t, find_margins

   !> One margin
   type :: margin_t
      !> Smallest force [N]; negative: so much is missing to keep the bodies together
      real(wp) :: force = huge(1.0_wp)
      !> Cam angle from full lift where it is smallest [rad]
      real(wp) :: angle = -pi
      !> Cam speed at which a force is first zero, infinite if never [rad/s]
      real(wp) :: speed = huge(1.0_wp)
   end type margin_t

   !> Margins of one lobe and its follower
   type :: margins_t
      !> Contact load while the valve is off its seat, and while it is on it or about to leave or reach it
      type(margin_t) :: event, base_circle
      !> Force in the pivot's joint while the valve is off its seat; allocated where the finger's mass is known
      type(margin_t), allocatable :: pivot
      !> Force between a valve on the base circle and its seat, the same at all speeds; allocated where gas acts on a rigid train
      type(margin_t), allocatable :: seat
      !> May there be a lash adjuster? A rigid train does not tell, a flexible one has one or has none
      logical :: may_have_adjuster = .true.
      !> Force of the lash adjuster on the base circle [N], and the cam speed at which the pivot's force first falls to it [rad/s]
      real(wp) :: adjuster_force = 0.0_wp, pump_up_speed = huge(1.0_wp)
   end type margins_t

   !> A force that depends on the square of the speed
   type :: split_t
      !> Without inertia, and what inertia adds at the model's speed [N]
      real(wp) :: static = 0.0_wp, inertia = 0.0_wp
   end type split_t

   !> Forces of a split: contact load, pivot force, pivot force above the adjuster's
   integer, parameter :: contact_load = 1, pivot_load = 2, above_adjuster = 3, split_count = 3
   !> Longest step of a scan [rad], and least number of steps of a piece
   real(wp), parameter :: longest_step = 0.5_wp*degree
   integer, parameter :: least_steps = 16
   !> Part of the adjuster's force that is rounding of the moments: a soft seat passes the load on to the event without a step [-]
   real(wp), parameter, public :: joint_rounding = 1.0e-9_wp
   !> Gain of a lowest value that is not worth an evaluation, over the largest value of the piece [-]
   real(wp), parameter :: worth = 1.0e-13_wp

contains

   !> All margins of a model.
   subroutine find_margins(model, ends, margins)
      !> The model
      type(model_t), intent(in) :: model
      !> Stops of a cycle, with its start and its end a turn later: ends of the pieces [rad]
      real(wp), intent(in) :: ends(:)
      !> The margins
      type(margins_t), intent(out) :: margins

      ! Pivot force above the adjuster's
      type(margin_t) :: pump_up
      logical, allocatable :: in_event(:)
      integer :: i

      in_event = is_event(model, ends)
      if (allocated(model%flexible)) margins%may_have_adjuster = allocated(model%flexible%adjuster)
      if (allocated(model%pivot)) then
         allocate (margins%pivot)
         margins%adjuster_force = adjuster_force(model)
      end if
      do i = 1, size(in_event)
         if (.not. in_event(i)) then
            call scan_piece(model, margins%adjuster_force, ends(i:i + 1), margins%base_circle)
         else if (allocated(model%pivot)) then
            call scan_piece(model, margins%adjuster_force, ends(i:i + 1), margins%event, margins%pivot, pump_up)
         else
            call scan_piece(model, margins%adjuster_force, ends(i:i + 1), margins%event)
         end if
      end do
      if (allocated(model%gas) .and. .not. (model%takes_maximum_load .or. allocated(model%flexible))) then
         margins%seat = seat_margin(model)
      end if
      ! with 'maximum' the adjuster holds the base circle load whatever the train does
      if (model%takes_maximum_load .or. all(in_event)) margins%base_circle = margin_t(model%base_circle_load)
      margins%pump_up_speed = infinite_if_huge(pump_up%speed)
      margins%event%speed = infinite_if_huge(margins%event%speed)
      margins%base_circle%speed = infinite_if_huge(margins%base_circle%speed)
      if (allocated(margins%pivot)) margins%pivot%speed = infinite_if_huge(margins%pivot%speed)
   end subroutine find_margins

   !> Smallest force between the closed valve and its seat, at angles as far apart as those of a scan.
   function seat_margin(model) result(margin)
      !> The model, with gas
      type(model_t), intent(in) :: model
      !> The margin
      type(margin_t) :: margin

      ! Cam angle [rad], force there [N]
      real(wp) :: angle, force
      integer :: i

      do i = 0, nint(2.0_wp*pi/longest_step) - 1
         angle = -pi + i*longest_step
         if (.not. is_at_rest(model%lift_law, angle)) cycle
         force = model%train%closed_seat_force + gas_force(model%gas, angle)
         if (force < margin%force) margin = margin_t(force, angle)
      end do
   end function seat_margin

   !> Which pieces between stops belong to the event: those with the valve off its seat; where it never leaves it, those without a
   !> valve at rest; else all.
   function is_event(model, ends) result(in_event)
      type(model_t), intent(in) :: model
      !> Ends of the pieces [rad]
      real(wp), intent(in) :: ends(:)
      !> One for each piece
      logical, allocatable :: in_event(:)

      type(position_t) :: position
      logical :: is_resting(size(ends) - 1)
      integer :: i, status

      allocate (in_event(size(ends) - 1))
      do i = 1, size(in_event)
         associate (middle => 0.5_wp*(ends(i) + ends(i + 1)))
            is_resting(i) = is_at_rest(model%lift_law, middle)
            call evaluate_geometry(model, middle, position, status)
            in_event(i) = .not. is_resting(i) .and. position%lift > model%train%seat_lift
         end associate
      end do
      if (.not. any(in_event)) in_event = .not. is_resting
      if (.not. any(in_event)) in_event = .true.
   end function is_event

   !> Lower margins to what the forces have between two angles.
   subroutine scan_piece(model, adjuster, ends, contact, pivot, pump_up)
      type(model_t), intent(in) :: model
      !> Force of the adjuster [N]
      real(wp), intent(in) :: adjuster
      !> The angles [rad]
      real(wp), intent(in) :: ends(2)
      !> Margin of the contact load
      type(margin_t), intent(inout) :: contact
      !> Margins of the pivot's joint, and of the force there above the adjuster's
      type(margin_t), intent(inout), optional :: pivot, pump_up

      ! Angles of the scan [rad]
      real(wp), allocatable :: angles(:)
      type(split_t), allocatable :: splits(:, :)
      integer :: i, steps

      steps = max(least_steps, ceiling((ends(2) - ends(1))/longest_step))
      if (is_at_rest(model%lift_law, 0.5_wp*(ends(1) + ends(2)))) steps = 1
      angles = [(ends(1) + (ends(2) - ends(1))*i/steps, i=0, steps - 1), ends(2)]
      allocate (splits(merge(split_count, contact_load, present(pivot)), steps + 1))
      do i = 1, steps + 1
         call take_forces(model, adjuster, angles(i), splits(:, i))
      end do
      call lower_margin(model, contact_load, adjuster, angles, splits(contact_load, :), contact)
      if (.not. present(pivot)) return
      call lower_margin(model, pivot_load, adjuster, angles, splits(pivot_load, :), pivot)
      call lower_margin(model, above_adjuster, adjuster, angles, splits(above_adjuster, :), pump_up)
   end subroutine scan_piece

   !> Lower a margin to what one of the forces has in a scan and between its points.
   subroutine lower_margin(model, kind, adjuster, angles, splits, margin)
      type(model_t), intent(in) :: model
      !> Which of the forces
      integer, intent(in) :: kind
      !> Force of the adjuster [N]
      real(wp), intent(in) :: adjuster
      !> Angles of the scan [rad]
      real(wp), intent(in) :: angles(:)
      !> The force there
      type(split_t), intent(in) :: splits(:)
      type(margin_t), intent(inout) :: margin

      ! Forces [N] and relative inertia [-] at the angles
      real(wp) :: forces(size(angles)), ratios(size(angles))
      ! Lowest force [N] or relative inertia [-], and its cam angle [rad]
      real(wp) :: lowest, place

      forces = splits%static + splits%inertia
      if (any(splits%static <= 0.0_wp)) margin%speed = 0.0_wp
      ratios = relative_inertia(splits)
      call find_lowest(model, kind, adjuster, .false., angles, forces, lowest, place)
      if (lowest < margin%force) then
         margin%force = lowest
         margin%angle = place
      end if
      if (margin%speed <= 0.0_wp) return
      call find_lowest(model, kind, adjuster, .true., angles, ratios, lowest, place)
      if (lowest < -epsilon(1.0_wp)) margin%speed = min(margin%speed, model%speed/sqrt(-lowest))
   end subroutine lower_margin

   !> Lowest value of a scan and between its points.
   subroutine find_lowest(model, kind, adjuster, is_ratio, angles, values, lowest, place)
      type(model_t), intent(in) :: model
      !> Which of the forces
      integer, intent(in) :: kind
      !> Force of the adjuster [N]
      real(wp), intent(in) :: adjuster
      !> Is it the relative inertia that is wanted, not the force?
      logical, intent(in) :: is_ratio
      !> Angles of the scan [rad]
      real(wp), intent(in) :: angles(:)
      !> Values there [N] or [-]
      real(wp), intent(in) :: values(:)
      !> Lowest value [N] or [-], and its cam angle [rad]
      real(wp), intent(out) :: lowest, place

      type(minimum_t) :: search
      type(split_t) :: splits(kind)
      integer :: i

      i = minloc(values, 1)
      lowest = values(i)
      place = angles(i)
      if (i == 1 .or. i == size(values)) return
      call start_minimum(search, angles(i - 1:i + 1), values(i - 1:i + 1), worth*maxval(abs(values)))
      do while (search%is_wanted)
         call take_forces(model, adjuster, search%trial, splits)
         call narrow_minimum(search, merge(relative_inertia(splits(kind)), splits(kind)%static + splits(kind)%inertia, is_ratio))
      end do
      lowest = search%value(2)
      place = search%point(2)
   end subroutine find_lowest

   !> The first of the forces at a cam angle, as many as are wanted.
   subroutine take_forces(model, adjuster, angle, splits)
      type(model_t), intent(in) :: model
      !> Force of the adjuster [N]
      real(wp), intent(in) :: adjuster
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> The forces, in their order
      type(split_t), intent(out) :: splits(:)

      type(position_t) :: position
      type(moments_t) :: moments
      ! Gas force [N]; unit vectors of load and traction [-]
      real(wp) :: force, normal(2), tangent(2)
      integer :: status

      call evaluate_loading(model, angle, position, force, moments, status, moments_only=.true.)
      associate (arm => merge(position%normal_arm, position%parallel_arm, model%has_exact_arm), &
         & inertia => moments%valve + moments%finger)
         splits(contact_load) = split_t((moments%total - inertia)/arm, inertia/arm)
      end associate
      if (size(splits) == contact_load) return
      position%arm_angle = arm_angle_at(model%linkage, position%lift)
      call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, &
         & model%linkage%sense, normal, tangent)
      associate (arm => position%normal_arm, tip_arm => position%valve_arm)
         associate (inertia => moments%valve + moments%finger)
            splits(pivot_load)%inertia = pivot_force(model%pivot, inertia/arm, normal, moments%valve/tip_arm, position%arm_angle, &
               & position%finger_slope, position%finger_curvature, model%speed)
            splits(pivot_load)%static = pivot_force(model%pivot, (moments%total - inertia)/arm, normal, &
               & (moments%spring - moments%seat + moments%gas)/tip_arm, position%arm_angle, 0.0_wp, 0.0_wp, 0.0_wp)
         end associate
      end associate
      if (size(splits) == pivot_load) return
      splits(above_adjuster) = split_t(splits(pivot_load)%static - adjuster, splits(pivot_load)%inertia)
      if (abs(splits(above_adjuster)%static) <= joint_rounding*adjuster) splits(above_adjuster)%static = joint_rounding*adjuster
   end subroutine take_forces

   !> Force of the lash adjuster that presses the roller on the base circle with the base circle load.
   function adjuster_force(model) result(force)
      type(model_t), intent(in) :: model
      !> The force [N]
      real(wp) :: force

      type(position_t) :: position
      ! Unit vectors of load and traction [-]
      real(wp) :: normal(2), tangent(2)
      integer :: status

      call evaluate_position(model%linkage, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], position, status)
      call normal_direction(position%normal_arm, position%tangent_arm, model%linkage%a, position%arm_angle, &
         & model%linkage%sense, normal, tangent)
      force = pivot_force(model%pivot, model%base_circle_load, normal, model%base_circle_load*position%normal_arm &
         & /position%valve_arm, position%arm_angle, 0.0_wp, 0.0_wp, 0.0_wp)
   end function adjuster_force

   !> Inertia relative to the static force: -1 where they cancel at the model's speed; zero where nothing is static.
   elemental function relative_inertia(split) result(ratio)
      !> The force
      type(split_t), intent(in) :: split
      !> The ratio [-]
      real(wp) :: ratio

      ratio = 0.0_wp
      if (split%static > 0.0_wp) ratio = split%inertia/split%static
   end function relative_inertia

end module camroller_margins
