!> Start of a cycle: the cam angle of fastest decay, the sliding speed in the quasi-static balance there, and the run-up to it.
!>
!> In: model. Out: start angle, sliding speed, scale of the sliding speed, stops of the run-up.
module camroller_cycle_start
   use camroller_kinds, only : wp, pi, two_pi, degree
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_model, only : model_t, evaluate_geometry
   use camroller_ramp, only : speed_on_ramp
   use camroller_kinematics, only : position_t
   use camroller_lift, only : is_at_rest
   use camroller_number_text, only : integer_text, number_text
   use camroller_spin, only : rolling_speed_at
   use camroller_balance, only : follow_balance, least_slip
   use camroller_ode_explicit, only : dormand_prince_limit
   implicit none
   private

   public :: balance_points, choose_start, check_steps, run_up_stops, rolling_speed_at_angle

   !> Angles at which the quasi-static balance is tried
   integer, parameter :: balance_points = 36
   !> Accuracy of the balance over the speed of pure rolling: for a scale, and for the start of the run-up [-]
   real(wp), parameter :: scan_tolerance = 1.0e-5_wp, start_tolerance = 1.0e-10_wp
   !> Cam angle over which the difference between quasi-static balance and periodic state decays before the cycle [rad]
   real(wp), parameter :: run_up_angle = 5.0_wp*degree

contains

   !> Angle of fastest decay with the quasi-static balance there, and the scale of the sliding speed.
   subroutine choose_start(model, start, sliding_speed, scale, least_scale, evaluations, decay_rates)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(out) :: start
      !> Sliding speed there [m/s]
      real(wp), intent(out) :: sliding_speed
      !> Largest sliding speed of the quasi-static balance; sliding speed below which it counts as zero [m/s]
      real(wp), intent(out) :: scale, least_scale
      !> Evaluations of the contact, counted on
      integer, intent(inout) :: evaluations
      !> Decay rates of the slip at these angles, evenly spaced; zero where there is no balance [1/rad]
      real(wp), intent(out), optional :: decay_rates(balance_points)

      type(position_t) :: position
      ! The decay rates [1/rad]
      real(wp) :: rates(balance_points)
      ! Angle [rad], sliding speed of the balance [m/s], decay rate [1/rad], fastest of them
      real(wp) :: angle, balance, decay_rate, fastest
      ! Largest speed of pure rolling, accuracy of the scan [m/s]
      real(wp) :: largest_rolling, tolerance
      integer :: i
      ! Is there a balance; is it one of a valve at rest, the same at all angles of the rest, as it was at the angle before?
      logical :: is_found, rests, rested

      start = 0.0_wp
      sliding_speed = 0.0_wp
      scale = 0.0_wp
      fastest = -1.0_wp
      largest_rolling = 0.0_wp
      balance = 0.0_wp
      is_found = .false.
      rests = .false.
      tolerance = scan_tolerance*abs(rolling_speed_at_angle(model, -pi))
      do i = 0, balance_points - 1
         angle = -pi + (i + 0.5_wp)*two_pi/balance_points
         rested = rests .and. is_found
         rests = is_at_rest(model%lift_law, angle) .and. .not. (allocated(model%gas) .or. allocated(model%surface) .or. &
            & model%ramp%is_moving)
         if (.not. (rests .and. rested)) then
            decay_rate = 0.0_wp
            call follow_balance(model, angle, tolerance, position, balance, decay_rate, evaluations, is_found)
         end if
         rates(i + 1) = merge(decay_rate, 0.0_wp, is_found)
         if (rests .and. rested) cycle
         largest_rolling = max(largest_rolling, abs(rolling_speed_at(model, position)))
         if (.not. is_found) cycle
         scale = max(scale, abs(balance))
         if (decay_rate > fastest) then
            fastest = decay_rate
            start = angle
            sliding_speed = balance
         end if
      end do
      if (present(decay_rates)) decay_rates = rates
      least_scale = least_slip*largest_rolling
      scale = max(scale, least_scale)
      if (.not. fastest >= 0.0_wp) return
      tolerance = start_tolerance*max(abs(rolling_speed_at_angle(model, start)), scale)
      call follow_balance(model, start, tolerance, position, sliding_speed, decay_rate, evaluations, is_found)
   end subroutine choose_start

   !> Refuse an explicit method that would take more steps than it may: each is stable over a few times what the slip decays in.
   !> Between two of the angles the slip is taken to decay at the lower rate of both.
   subroutine check_steps(method, most_steps, decay_rates, error)
      !> Name of the method
      character(len=*), intent(in) :: method
      !> Steps that it may take in a turn
      integer, intent(in) :: most_steps
      !> Decay rates of the slip at angles evenly spaced over the turn [1/rad]
      real(wp), intent(in) :: decay_rates(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Steps that the turn takes at least [-]
      real(wp) :: steps

      steps = sum(min(decay_rates, cshift(decay_rates, 1)))*two_pi/(size(decay_rates)*dormand_prince_limit)
      if (steps <= most_steps) return
      call raise(error, kind_convergence, "method '"//trim(method)//"' is explicit, and its steps are stable over a few times "// &
         & "what the slip decays in, down to "//number_text(1.0_wp/(maxval(decay_rates)*degree), 2)//" deg: "// &
         & "the turn takes more than "//number_text(steps, 3)//" steps, with "//integer_text(most_steps)//" allowed; "// &
         & "take method 'automatic'")
   end subroutine check_steps

   !> Stops of the run-up to a cycle: the last degrees before its start.
   pure function run_up_stops(stops) result(run_up)
      !> Stops of the cycle, with start and end [rad]
      real(wp), intent(in) :: stops(:)
      !> Stops of the run-up, with start and end [rad]
      real(wp), allocatable :: run_up(:)

      ! Stops one turn earlier [rad]
      real(wp) :: earlier(size(stops))

      earlier = stops - two_pi
      run_up = [stops(1) - run_up_angle, pack(earlier, earlier > stops(1) - run_up_angle)]
   end function run_up_stops

   !> Speed of the roller's surface in pure rolling at a cam angle, where a host's speed changes at the speed of the cam there.
   function rolling_speed_at_angle(model, angle) result(speed)
      !> The model
      type(model_t), intent(in) :: model
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> V_roll [m/s]
      real(wp) :: speed

      type(position_t) :: position
      integer :: status

      call evaluate_geometry(model, angle, position, status)
      speed = rolling_speed_at(model, position)
      if (model%ramp%is_moving) speed = speed*speed_on_ramp(model, angle)/model%speed
   end function rolling_speed_at_angle

end module camroller_cycle_start
