!> Defect of the roller equation for the computed solution of a cycle, and decay rate of a disturbance.
!>
!> In: model, cycle, state at a point. Out: defect and decay rate, for `error_estimate`.
module camroller_defects
   use camroller_kinds, only : wp
   use camroller_model, only : model_t
   use camroller_state, only : state_t, evaluate_spin
   use camroller_contact_forces, only : contact_t
   use camroller_cycle, only : cycle_t
   use camroller_error_estimate, only : contact_accuracy_for
   use camroller_spin, only : decay_rate_of, full_decay_rate, slip_rate, surface_rate
   use camroller_trajectory, only : curve_slope
   implicit none
   private

   public :: defect_at, find_defect

contains

   !> Defect of the curve at a point, and the decay rate that holds over the distance that an error reaches there.
   subroutine find_defect(model, cycle, angle, interval, state, error_so_far, defect, decay_rate)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Cam angle from full lift, in the trajectory [rad]
      real(wp), intent(in) :: angle
      !> Interval of the trajectory that holds it
      integer, intent(in) :: interval
      !> State there
      type(state_t), intent(in) :: state
      !> Error that the cycle has piled up before this interval [m/s]
      real(wp), intent(in) :: error_so_far
      !> Slope of the curve less rate of the equation [m/s/rad]
      real(wp), intent(out) :: defect
      !> Decay rate of a disturbance [1/rad]
      real(wp), intent(out) :: decay_rate

      ! Errors of steps that add up to one of the cycle [-]
      real(wp), parameter :: few = 5.0_wp

      defect = defect_at(model, cycle, angle, interval, state)
      decay_rate = decay_rate_of(model, state%contact)
      if (.not. allocated(cycle%phases)) decay_rate = decay_rate_at(model, angle, state)
      if (.not. (cycle%is_linear .or. allocated(cycle%phases))) call weaken_decay(model, cycle, state, defect, decay_rate)
      if (decay_rate < 0.0_wp) call limit_growth(model, state, max(few*cycle%step_error, abs(error_so_far)), decay_rate)
   end subroutine find_defect

   !> Decay rate of a disturbance of the spin.
   !>
   !> Film and load follow the slip through the entrainment speed, which changes forces by about their size over that speed. Where
   !> the slope of the traction at constant film is large against that, it is good enough; beyond a sharp limit of the traction it
   !> is zero, and all decay there is comes from the film.
   function decay_rate_at(model, angle, state) result(decay_rate)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> State there
      type(state_t), intent(in) :: state
      !> Decay rate [1/rad]
      real(wp) :: decay_rate

      ! Slope at constant film over that of the film, from which on the first is good enough [-]; accuracy of the other [-]
      real(wp), parameter :: large = 5.0_wp, accuracy = 1.0e-4_wp
      ! Decay rate that the film may make, about [1/rad]
      real(wp) :: by_film

      decay_rate = decay_rate_of(model, state%contact)
      associate (contact => state%contact)
         if (.not. contact%is_touching) return
         by_film = model%roller_radius**2*(abs(contact%traction) + abs(contact%rolling_resistance)) &
            & /(model%roller_inertia*model%speed)
         if (decay_rate*abs(contact%entrainment_speed) >= large*by_film) return
         decay_rate = full_decay_rate(model, angle, state%position, state%moments, contact%sliding_speed, accuracy)
      end associate
   end function decay_rate_at

   !> Slope of the cycle's curve less the rate of the roller equation.
   pure function defect_at(model, cycle, angle, interval, state) result(defect)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Cam angle from full lift, in the trajectory [rad]
      real(wp), intent(in) :: angle
      !> Interval of the trajectory that holds it
      integer, intent(in) :: interval
      !> State there
      type(state_t), intent(in) :: state
      !> The defect [m/s/rad]
      real(wp) :: defect

      ! Slope of the curve, rate of the equation [m/s/rad]
      real(wp) :: slope(1), rate

      call curve_slope(cycle%trajectory, angle, interval, slope)
      rate = surface_rate(model, state%spin_acceleration)
      if (.not. cycle%has_surface_speed) rate = slip_rate(model, state%position, state%spin_acceleration)
      defect = slope(1) - rate
   end function defect_at

   !> Decay rate over the distance that a defect would move the sliding speed, where it is less than at the point itself.
   !>
   !> Traction saturates: what decays fast at the sliding speed of the curve may hardly decay at the right one, and a roller that
   !> the curve takes as held by friction may have broken away.
   pure subroutine weaken_decay(model, cycle, state, defect, decay_rate)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      type(cycle_t), intent(in) :: cycle
      !> State on the curve
      type(state_t), intent(in) :: state
      !> Defect there [m/s/rad]
      real(wp), intent(in) :: defect
      !> Decay rate, in: at the point; out: over the distance [1/rad]
      real(wp), intent(inout) :: decay_rate

      ! Part of a decay rate that is as good as all of it [-]; evaluations at most
      real(wp), parameter :: good_part = 0.5_wp
      integer, parameter :: most = 12
      ! Part of the traction that may be an error of the contact, over the accuracy of that, and at least [-]
      real(wp), parameter :: several = 10.0_wp, rounding = 1.0e-9_wp
      type(contact_t) :: contact
      ! Relative error of load and forces [-]; distance [m/s]; acceleration of the roller [rad/s^2]; decay rate over the distance
      ! [1/rad]
      real(wp) :: accuracy, distance, acceleration, secant
      integer :: i, status

      if (.not. state%contact%is_touching) return
      accuracy = contact_accuracy_for(cycle%tolerance)
      if (abs(defect) <= max(several*accuracy, rounding)*(abs(state%contact%shear) + state%contact%boundary_capacity) &
         & *model%roller_radius**2/(model%roller_inertia*model%speed)) return
      do i = 1, most
         if (.not. decay_rate > 0.0_wp) return
         distance = -defect/decay_rate
         if (.not. abs(distance) > 4.0_wp*spacing(state%contact%sliding_speed)) return
         if (abs(distance) > abs(state%contact%rolling_speed)) return
         call evaluate_spin(model, state%position, state%moments, state%contact%sliding_speed + distance, contact, &
            & acceleration, status, accuracy, start=state%contact)
         if (status /= 0) return
         secant = model%roller_radius*(acceleration - state%spin_acceleration)/(model%speed*distance)
         if (secant >= good_part*decay_rate) return
         decay_rate = max(secant, 0.0_wp)
      end do
   end subroutine weaken_decay

   !> Growth rate over the range that an error reaches, where a disturbance grows at the point itself.
   !>
   !> Near zero entrainment the traction falls with the sliding speed, within a range that may be far less than any error; beyond it
   !> errors do not grow on.
   pure subroutine limit_growth(model, state, reach, decay_rate)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State on the curve
      type(state_t), intent(in) :: state
      !> Size of an error [m/s]
      real(wp), intent(in) :: reach
      !> Decay rate, in: at the point, negative; out: over the range, negative or zero [1/rad]
      real(wp), intent(inout) :: decay_rate

      type(contact_t) :: contact
      ! Accelerations of the roller [rad/s^2]
      real(wp) :: accelerations(2)
      integer :: i, status

      do i = 1, 2
         status = 1
         if (reach > 4.0_wp*spacing(state%contact%sliding_speed)) call evaluate_spin(model, state%position, state%moments, &
            & state%contact%sliding_speed + (2*i - 3)*reach, contact, accelerations(i), status)
         if (status /= 0) decay_rate = 0.0_wp
         if (status /= 0) return
      end do
      decay_rate = max(decay_rate, min(0.0_wp, 0.5_wp*model%roller_radius*(accelerations(2) - accelerations(1)) &
         & /(model%speed*reach)))
   end subroutine limit_growth

end module camroller_defects
