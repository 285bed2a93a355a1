!> A number that tells one model from another, to be saved with what was computed with it.
!>
!> In: a model as a case makes it, the case. Out: the mark, of states at the operating point of the case and of slow ones in hot
!> oil, where surfaces touch, and of what steps may meet elsewhere: the laws of the oil and of boundary friction, the table of
!> gas pressure, a flexible train. What no state follows is not in it.
module camroller_model_mark
   use, intrinsic :: iso_fortran_env, only : int64
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_asperity, only : boundary_friction_t, boundary_part_t, find_boundary_friction, set_boundary_temperature
   use camroller_case, only : case_t, gas_force_of
   use camroller_dynamics, only : gas_force_t
   use camroller_error, only : error_t
   use camroller_flexible_parts, only : flexible_t
   use camroller_lubricant, only : density_at, get_oil, lubricant_t, oil_t
   use camroller_model, only : model_t
   use camroller_ramp, only : keep_films
   use camroller_state, only : state_t, evaluate_state
   implicit none
   private

   public :: mark_model, mixed, beginning

   !> What blocks of saved followers begin with
   integer(int64), parameter :: beginning = 7237970109966541155_int64
   !> Cam angles at which states make up the mark
   integer, parameter :: places = 36
   !> Cam speed [rad/s] and temperature [K] at which films are so thin that surfaces touch
   real(wp), parameter :: slow = 1.0_wp, hot = 425.0_wp
   !> Temperatures at which the laws of oil and boundary friction do [K]
   real(wp), parameter :: temperatures(*) = [250.0_wp, 275.0_wp, 300.0_wp, 325.0_wp, 350.0_wp, 375.0_wp, 400.0_wp, 425.0_wp]
   !> Sliding speeds at which boundary friction does [m/s]
   real(wp), parameter :: sliding_speeds(*) = [0.01_wp, 1.0_wp]

contains

   !> Mark of a model: states over the turn, and how it is integrated.
   subroutine mark_model(model, case, mark)
      !> The model, at the operating point of its case
      type(model_t), intent(in) :: model
      !> The case
      type(case_t), intent(in) :: case
      !> The mark
      integer(int64), intent(out) :: mark

      type(model_t) :: other
      type(gas_force_t) :: gas
      ! Where the oil has no value, which is part of the mark as well
      type(error_t), allocatable :: error
      integer(int64) :: parts(5*places, 2)

      parts = 0_int64
      call follow_states(model, parts(:, 1))
      other = model
      call keep_films(other, slow, hot, error)
      if (.not. allocated(error)) call follow_states(other, parts(:, 2))
      associate (numerics => case%numerics)
         mark = mixed([pack(parts, .true.), transfer([numerics%accuracy, numerics%tolerance], parts), &
            & transfer(numerics%method, parts)])
      end associate
      call mark_oil(case%lubricant, mark)
      if (allocated(model%boundary)) call mark_boundary(model%boundary, mark)
      if (allocated(case%gas_force)) then
         call gas_force_of(case, model%lobe, gas)
         mark = mixed([mark, transfer([gas%valve_area, gas%angle, gas%pressure], parts)])
      end if
      if (allocated(model%flexible)) call mark_train(model%flexible, mark)
   end subroutine mark_model

   !> Loads, friction and torques of states over the turn.
   subroutine follow_states(model, parts)
      type(model_t), intent(in) :: model
      !> Five numbers of each state, 0 where there is none
      integer(int64), intent(inout) :: parts(:)

      type(state_t) :: state
      ! Cam angle from full lift [rad]; sliding speed [m/s]
      real(wp) :: angle, sliding_speed
      integer :: i, status

      do i = 1, places
         angle = -pi + (i - 0.37_wp)*two_pi/places
         sliding_speed = 0.02_wp*modulo(i, 3)*model%speed*model%roller_radius
         call evaluate_state(model, angle, sliding_speed, state, status)
         if (status /= 0) cycle
         parts(5*i - 4:5*i) = transfer([state%contact%load, state%contact%traction, state%spin_acceleration, &
            & state%torque_friction, state%torque_drive], parts)
      end do
   end subroutine follow_states

   !> Take the laws of an oil into a mark.
   subroutine mark_oil(lubricant, mark)
      !> The oil
      type(lubricant_t), intent(in) :: lubricant
      integer(int64), intent(inout) :: mark

      type(oil_t) :: oil
      ! Where the law has no value, which is part of the mark as well
      type(error_t), allocatable :: error
      integer(int64) :: parts(4*size(temperatures))
      integer :: i

      parts = 0_int64
      do i = 1, size(temperatures)
         call get_oil(lubricant, temperatures(i), oil, error)
         if (allocated(error)) cycle
         parts(4*i - 3:4*i) = transfer([oil%viscosity, oil%pressure_viscosity, oil%roelands_index, &
            & density_at(lubricant, temperatures(i))], parts)
      end do
      mark = mixed([mark, parts])
   end subroutine mark_oil

   !> Take the law of boundary friction into a mark.
   subroutine mark_boundary(boundary, mark)
      !> Asperities and their friction
      type(boundary_part_t), intent(in) :: boundary
      integer(int64), intent(inout) :: mark

      type(boundary_part_t) :: part
      type(boundary_friction_t) :: friction
      integer(int64) :: parts(size(sliding_speeds), size(temperatures))
      integer :: i, k

      part = boundary
      do k = 1, size(temperatures)
         call set_boundary_temperature(part, temperatures(k))
         do i = 1, size(sliding_speeds)
            call find_boundary_friction(part, sliding_speeds(i), 0.0_wp, 0.0_wp, friction)
            parts(i, k) = transfer(friction%coefficient, 0_int64)
         end do
      end do
      mark = mixed([mark, pack(parts, .true.)])
   end subroutine mark_boundary

   !> Take a flexible train into a mark.
   subroutine mark_train(flexible, mark)
      !> The train
      type(flexible_t), intent(in) :: flexible
      integer(int64), intent(inout) :: mark

      integer(int64), allocatable :: parts(:)

      allocate (parts(0))
      associate (modes => flexible%modes)
         parts = transfer([flexible%compliance, flexible%finger_stiffness, flexible%contact_damping, flexible%pad_stiffness, &
            & flexible%pad_damping, flexible%seat_stiffness, flexible%seat_damping, flexible%lash, flexible%pivot_place, &
            & flexible%effective_mass, flexible%finger_mass, flexible%finger_centre, real(flexible%axis, wp), &
            & aimag(flexible%axis), flexible%tilt_cosine, modes%mass, modes%stiffness, modes%damping_ratio, &
            & real(modes%count, wp)], parts)
      end associate
      if (allocated(flexible%adjuster)) parts = [parts, transfer(flexible%adjuster%given, parts), &
         & transfer([flexible%adjuster%spring_force, flexible%adjuster%conductance], parts)]
      mark = mixed([mark, parts])
   end subroutine mark_train

   !> A number that changes with every bit of others and with their order.
   pure function mixed(list) result(mix)
      !> The others
      integer(int64), intent(in) :: list(:)
      !> The number
      integer(int64) :: mix

      integer :: i, turn

      mix = beginning
      do i = 1, size(list)
         mix = ieor(ishftc(mix, 9), list(i))
         do turn = 1, 3
            mix = ieor(mix, ieor(ishftc(mix, 23), ishftc(mix, 47)))
            mix = ieor(mix, iand(ishftc(mix, 7), not(ishftc(mix, 1))))
         end do
      end do
   end function mixed

end module camroller_model_mark
