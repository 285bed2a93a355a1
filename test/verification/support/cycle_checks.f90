!> What every cycle must be, however extreme its case: finite, periodic, energy closed, free of chatter, and the same by every
!> method. Each check gives a message, blank where all is well.
module cycle_checks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t
   use camroller_accuracy, only : resolve_numerics
   use camroller_case, only : numerics_t
   use camroller_model, only : model_t
   use camroller_cycle, only : cycle_t, integrate_cycle, state_at
   use camroller_state, only : state_t
   use camroller_torque_list, only : is_torque, of_residual
   implicit none
   private

   public :: sample_t, take_sample, compare_samples, difference, least_slip

   !> Points at which a cycle is looked at: every half degree, off the places where kinks are likely
   integer, parameter :: points = 720
   !> Place of a point between two of them [-]
   real(wp), parameter :: offset = 0.37_wp
   !> Energy left over, over the largest power: the load is solved to 8 roundings of the largest moment, and the power is a sum of
   !> ten terms of which each has some roundings [-]
   real(wp), parameter :: energy_tolerance = 200.0_wp*epsilon(1.0_wp)
   !> Sliding speed that counts as none, over the speed of pure rolling [-]: what the integration takes as the least scale
   real(wp), parameter :: least_slip = 1.0e-5_wp

   !> A cycle as its checks see it
   type :: sample_t
      !> Why there is no cycle, or what is wrong with it; blank where all is well
      character(len=:), allocatable :: trouble
      !> Did the integration end with an error?
      logical :: has_ended = .false.
      !> Sliding speed at the points [m/s]
      real(wp) :: sliding_speed(points) = 0.0_wp
      !> What sliding speeds are judged by: the largest of them, or the least scale [m/s]
      real(wp) :: scale = 0.0_wp
      !> Largest error that error control leaves to each method: the tolerance once for each step [-]
      real(wp) :: error_bound = 0.0_wp
   end type sample_t

contains

   !> Integrate a cycle and look at it from all sides.
   subroutine take_sample(model, numerics, method, tolerance, sample)
      !> The model
      type(model_t), intent(in) :: model
      !> Numerics of the case
      type(numerics_t), intent(in) :: numerics
      !> Method instead of that of the case
      character(len=*), intent(in) :: method
      !> Tolerance instead of that of the case [-]
      real(wp), intent(in) :: tolerance
      !> The sample
      type(sample_t), intent(out) :: sample

      type(numerics_t) :: changed, wanted
      type(cycle_t) :: cycle
      type(error_t), allocatable :: error

      changed = numerics
      changed%method = method
      changed%tolerance = tolerance
      sample%trouble = ""
      call integrate_cycle(cycle, model, changed, error)
      if (allocated(error)) then
         sample%has_ended = .true.
         sample%trouble = error%message
         return
      end if
      sample%error_bound = tolerance*cycle%counters%accepted
      wanted = resolve_numerics(changed)
      if (.not. cycle%closure <= wanted%periodicity) sample%trouble = "the cycle is not periodic"
      call look_at_states(model, cycle, sample)
      if (sample%trouble /= "") sample%trouble = trim(method)//": "//sample%trouble
   end subroutine take_sample

   !> States at the points: numbers that are finite and possible, energy that closes.
   subroutine look_at_states(model, cycle, sample)
      !> The model
      type(model_t), intent(in) :: model
      !> Its cycle
      type(cycle_t), intent(in) :: cycle
      !> The sample
      type(sample_t), intent(inout) :: sample

      type(state_t) :: state
      type(error_t), allocatable :: error
      ! Largest energy left over and largest sum of powers [W], smallest and largest numbers that must be possible
      real(wp) :: residual, power
      character(len=48) :: fault
      integer :: i, hint

      hint = 1
      residual = 0.0_wp
      power = 0.0_wp
      sample%scale = 0.0_wp
      do i = 1, points
         call state_at(cycle, model, -pi + (i - offset)*two_pi/points, hint, state, error)
         if (allocated(error)) then
            sample%trouble = error%message
            return
         end if
         fault = fault_of(state)
         if (fault /= "") sample%trouble = trim(fault)
         sample%sliding_speed(i) = state%contact%sliding_speed
         sample%scale = max(sample%scale, abs(state%contact%sliding_speed), least_slip*abs(state%contact%rolling_speed))
         residual = max(residual, abs(state%torques(of_residual)))
         power = max(power, model%speed*sum(abs(state%torques), mask=is_torque))
      end do
      if (.not. residual <= energy_tolerance*power) sample%trouble = "energy does not close"
   end subroutine look_at_states

   !> What is wrong with the numbers of a state; blank where all are finite, and positive where they must be.
   pure function fault_of(state) result(fault)
      !> The state
      type(state_t), intent(in) :: state
      !> The fault
      character(len=48) :: fault

      fault = ""
      associate (contact => state%contact)
         if (.not. all(ieee_is_finite([contact%sliding_speed, contact%traction, contact%traction_slope, contact%load, &
            & contact%film_min, contact%film_central, contact%asperity_load, contact%rolling_resistance, contact%bearing_torque, &
            & state%torque_drive, state%torque_friction, state%torques, state%spin_acceleration]))) then
            fault = "a number is not finite"
            return
         end if
         if (min(contact%load, contact%film_min, contact%asperity_load, contact%real_area, contact%boundary_capacity) &
            & < 0.0_wp) then
            fault = "a load, a film or an area is negative"
         end if
         if (contact%asperity_load > contact%load) fault = "asperities carry more than the load"
         if (contact%real_area > contact%apparent_area) fault = "the real area is above the apparent one"
         if (contact%film_min > contact%film_central) fault = "the smallest film is above the central one"
         ! Traction falls with the slip where the film is warm alone
         if (contact%traction_slope < 0.0_wp .and. .not. contact%film_rise > 0.0_wp) fault = "traction falls with the slip"
      end associate
   end function fault_of

   !> Largest difference of the sliding speeds, over the scale.
   pure function difference(one, other)
      !> Two samples of a case
      type(sample_t), intent(in) :: one, other
      !> The difference [-]
      real(wp) :: difference

      difference = maxval(abs(one%sliding_speed - other%sliding_speed))/max(one%scale, other%scale)
   end function difference

   !> Do two ways to integrate a case agree, and does the first one chatter?
   !>
   !> Each step leaves an error within the tolerance, which appears and decays and so adds twice its size to the total variation at
   !> most; a fifth of the tolerance is what steps are allowed. The sum of the tolerances over all steps therefore bounds both the
   !> difference and what errors add to the variation; chatter at every step adds the slip itself as often.
   function compare_samples(one, other) result(trouble)
      !> Two samples of a case
      type(sample_t), intent(in) :: one, other
      !> What is wrong; blank where all is well
      character(len=:), allocatable :: trouble

      ! Error that both may have, difference [-]
      real(wp) :: allowed, found
      character(len=80) :: buffer

      trouble = ""
      allowed = one%error_bound + other%error_bound
      found = difference(one, other)
      if (.not. found <= allowed) then
         write (buffer, "(a, es9.2, a, es9.2)") "sliding speeds differ by", found, " of the largest, allowed are", allowed
         trouble = trim(buffer)
      else if (.not. variation(one) <= variation(other) + allowed) then
         trouble = "the sliding speed chatters"
      end if
   end function compare_samples

   !> Total variation of the sliding speed, over the scale.
   pure function variation(sample)
      !> The sample
      type(sample_t), intent(in) :: sample
      !> Total variation [-]
      real(wp) :: variation

      variation = sum(abs(sample%sliding_speed(2:) - sample%sliding_speed(:points - 1)))/sample%scale
   end function variation

end module cycle_checks
