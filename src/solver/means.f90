!> Means over the cycle, integrated with the solution itself.
!>
!> Layer: solver. In: cycles. Out: mean and extremes of the series of the first follower, mean torques of every lobe shape, mean
!> torque of the camshaft bearings. Each interval between accepted points, and so each segment between stops, gets its own
!> Gauss-Legendre rule of order six; a solution that is only linear between its points gets the trapezoidal rule.
module camroller_means
   use camroller_kinds, only : wp, two_pi, degree
   use camroller_error, only : error_t
   use camroller_case, only : case_t
   use camroller_model, only : model_t
   use camroller_state, only : state_t, evaluate_spin
   use camroller_contact_forces, only : contact_t, film_groups
   use camroller_film, only : is_in_range
   use camroller_cycle, only : cycle_t, state_at
   use camroller_catalogue, only : series_values, follower_torques, torque_count
   use camroller_error_estimate, only : estimate_t, add_defect, end_interval, estimated_error
   use camroller_shaft, only : shaft_t, shaft_torques
   use camroller_spin, only : decay_rate_of, full_decay_rate, rolling_speed_slope
   use camroller_trajectory, only : curve_slope
   use camroller_events, only : cycle_stops
   implicit none
   private

   public :: statistics_t, integrate_lobe, integrate_torques, mean_bearing_torque

   !> Means over the cycle of one lobe shape
   type :: statistics_t
      !> Mean of each series of the follower, as if it were alone [unit of the series]
      real(wp), allocatable :: mean(:)
      !> Smallest and largest values met [unit of the series]
      real(wp), allocatable :: lowest(:), highest(:)
      !> Mean torques of the follower [N m], last the energy residual [W]
      real(wp) :: torques(torque_count) = 0.0_wp
      !> Part of the cycle without contact, and outside the film law's range [-]
      real(wp) :: lost_share = 0.0_wp, outside_share = 0.0_wp
      !> Cam angle from full lift where the film law's range is first left [rad]
      real(wp) :: first_outside = 0.0_wp
      !> Largest size of the sliding speed met [m/s]
      real(wp) :: largest_sliding = 0.0_wp
      !> Estimate of the error of the sliding speed over its largest value [-]
      real(wp) :: error = 0.0_wp
      !> Cam angle from full lift at the end of the interval where that error is largest [rad]
      real(wp) :: error_angle = 0.0_wp
   end type statistics_t

   !> Three-point Gauss-Legendre quadrature on [0, 1]: nodes and weights [-]
   real(wp), parameter :: gauss_nodes(3) = 0.5_wp*[1.0_wp - sqrt(0.6_wp), 1.0_wp, 1.0_wp + sqrt(0.6_wp)]
   real(wp), parameter :: gauss_weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
   !> Trapezoidal rule on [0, 1] [-]
   real(wp), parameter :: trapezoid_nodes(2) = [0.0_wp, 1.0_wp]
   real(wp), parameter :: trapezoid_weights(2) = [0.5_wp, 0.5_wp]
   !> Longest panel for the camshaft bearings [rad]
   real(wp), parameter :: longest_panel = 2.0_wp*degree

contains

   !> Means and extremes over the cycle of one lobe shape.
   subroutine integrate_lobe(case, model, cycle, series_count, statistics, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Number of series of the case
      integer, intent(in) :: series_count
      !> Means and extremes
      type(statistics_t), intent(out) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      ! Angles [rad] and weights [-] of the rule over the cycle
      real(wp), allocatable :: angles(:), weights(:)
      ! Places of the rule in an interval [-]
      real(wp), allocatable :: nodes(:)
      type(estimate_t) :: estimate
      ! Largest error so far [m/s]
      real(wp) :: largest
      integer :: point, hint

      allocate (statistics%mean(series_count), statistics%lowest(series_count), statistics%highest(series_count))
      statistics%mean = 0.0_wp
      statistics%lowest = huge(1.0_wp)
      statistics%highest = -huge(1.0_wp)
      call list_points(cycle, angles, weights)
      nodes = gauss_nodes
      if (cycle%is_linear) nodes = trapezoid_nodes
      hint = 1
      do point = 1, size(angles)
         call add_point(case, model, cycle, angles(point), weights(point), hint, statistics, estimate, error)
         if (allocated(error)) return
         if (estimate%points < size(nodes)) cycle
         associate (first => (point - 1)/size(nodes) + 1)
            largest = estimate%largest
            call close_interval(cycle, first, nodes, estimate)
            if (estimate%largest > largest) statistics%error_angle = angles(point)
         end associate
      end do
      ! What start and end differ by comes again in every cycle that the periodic one is away
      statistics%error = cycle%closure/max(1.0_wp - estimate%contraction, epsilon(1.0_wp)) &
         & + estimated_error(estimate)/max(statistics%largest_sliding, cycle%scale, tiny(1.0_wp))
   end subroutine integrate_lobe

   !> Carry the estimate of the error over an interval, with the defects at its ends where the rates of the equation are kept there.
   pure subroutine close_interval(cycle, interval, nodes, estimate)
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Interval of its trajectory
      integer, intent(in) :: interval
      !> Places of the points in it [-]
      real(wp), intent(in) :: nodes(:)
      !> The estimate
      type(estimate_t), intent(inout) :: estimate

      ! Slope at an end [m/s/rad], defects at both [m/s/rad]
      real(wp) :: slope(1), ends(2)
      integer :: i

      associate (trajectory => cycle%trajectory, &
         & length => cycle%trajectory%time(interval + 1) - cycle%trajectory%time(interval))
         if (cycle%is_linear .or. allocated(cycle%phases) .or. .not. length > 0.0_wp) then
            call end_interval(estimate, nodes, length)
            return
         end if
         do i = 0, 1
            call curve_slope(trajectory, trajectory%time(interval + i), interval, slope)
            ends(i + 1) = slope(1) - trajectory%rate(1, interval + i)
         end do
         call end_interval(estimate, nodes, length, ends)
      end associate
   end subroutine close_interval

   !> Mean torques of a follower over a cycle or a piece of one.
   subroutine integrate_torques(model, cycle, torques, error)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cycle or a piece of one
      type(cycle_t), intent(in) :: cycle
      !> Mean torques [N m], last the energy residual [W]
      real(wp), intent(out) :: torques(torque_count)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Angles [rad] and weights [-] of the rule
      real(wp), allocatable :: angles(:), weights(:)
      integer :: point, hint

      torques = 0.0_wp
      call list_points(cycle, angles, weights)
      hint = 1
      do point = 1, size(angles)
         call state_at(cycle, model, angles(point), hint, state, error)
         if (allocated(error)) return
         torques = torques + weights(point)*follower_torques(state)
      end do
   end subroutine integrate_torques

   !> Points and weights of the rule over all intervals of a trajectory; the weights add up to one.
   pure subroutine list_points(cycle, angles, weights)
      !> Cycle or a piece of one
      type(cycle_t), intent(in) :: cycle
      !> Cam angles from full lift [rad]
      real(wp), allocatable, intent(out) :: angles(:)
      !> Weights [-]
      real(wp), allocatable, intent(out) :: weights(:)

      ! Rule on [0, 1] [-]
      real(wp), allocatable :: rule_nodes(:), rule_weights(:)
      ! Length of an interval and of all [rad]
      real(wp) :: length, span
      integer :: interval, points, first

      rule_nodes = gauss_nodes
      rule_weights = gauss_weights
      if (cycle%is_linear) then
         rule_nodes = trapezoid_nodes
         rule_weights = trapezoid_weights
      end if
      points = size(rule_nodes)
      associate (times => cycle%trajectory%time(:cycle%trajectory%count))
         span = times(size(times)) - times(1)
         allocate (angles(points*(size(times) - 1)), weights(points*(size(times) - 1)))
         do interval = 1, size(times) - 1
            length = times(interval + 1) - times(interval)
            first = points*(interval - 1)
            angles(first + 1:first + points) = times(interval) + rule_nodes*length
            weights(first + 1:first + points) = rule_weights*length/span
         end do
      end associate
   end subroutine list_points

   !> Add one point of the rule.
   subroutine add_point(case, model, cycle, angle, weight, hint, statistics, estimate, error)
      !> The case
      type(case_t), intent(in) :: case
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Cycle of the lobe
      type(cycle_t), intent(in) :: cycle
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Weight of the point over the cycle [-]
      real(wp), intent(in) :: weight
      !> Interval where the search starts
      integer, intent(inout) :: hint
      !> Means and extremes so far
      type(statistics_t), intent(inout) :: statistics
      !> Estimate of the error so far
      type(estimate_t), intent(inout) :: estimate
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Errors of steps that add up to one of the cycle [-]
      real(wp), parameter :: few = 5.0_wp
      ! Values of the series [unit of the series]; torques [N m]; defect [m/s/rad]; decay rate [1/rad]
      real(wp) :: values(size(statistics%mean)), torques(torque_count), defect, decay_rate

      call state_at(cycle, model, angle, hint, state, error)
      if (allocated(error)) return
      torques = follower_torques(state)
      call series_values(case, model, state, torques, 0.0_wp, values)
      statistics%mean = statistics%mean + weight*values
      statistics%lowest = min(statistics%lowest, values)
      statistics%highest = max(statistics%highest, values)
      statistics%torques = statistics%torques + weight*torques
      statistics%largest_sliding = max(statistics%largest_sliding, abs(state%contact%sliding_speed))
      defect = defect_at(model, cycle, angle, hint, state)
      decay_rate = decay_rate_of(model, state%contact)
      if (.not. allocated(cycle%phases)) decay_rate = decay_rate_at(model, angle, state)
      if (.not. (cycle%is_linear .or. allocated(cycle%phases))) call weaken_decay(model, state, defect, decay_rate)
      if (decay_rate < 0.0_wp) call limit_growth(model, state, max(few*cycle%step_error, abs(estimate%error)), decay_rate)
      call add_defect(estimate, defect, decay_rate)
      if (.not. state%contact%is_touching) statistics%lost_share = statistics%lost_share + weight
      if (.not. has_film_in_range(model, state)) then
         if (statistics%outside_share <= 0.0_wp) statistics%first_outside = angle
         statistics%outside_share = statistics%outside_share + weight
      end if
   end subroutine add_point

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
      rate = model%roller_radius*state%spin_acceleration/model%speed
      if (.not. cycle%has_surface_speed) rate = rolling_speed_slope(model, state%position) - rate
      defect = slope(1) - rate
   end function defect_at

   !> Decay rate over the distance that a defect would move the sliding speed, where it is less than at the point itself.
   !>
   !> Traction saturates: what decays fast at the sliding speed of the curve may hardly decay at the right one, and a roller that
   !> the curve takes as held by friction may have broken away.
   pure subroutine weaken_decay(model, state, defect, decay_rate)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State on the curve
      type(state_t), intent(in) :: state
      !> Defect there [m/s/rad]
      real(wp), intent(in) :: defect
      !> Decay rate, in: at the point; out: over the distance [1/rad]
      real(wp), intent(inout) :: decay_rate

      ! Part of a decay rate that is as good as all of it [-]; evaluations at most
      real(wp), parameter :: good_part = 0.5_wp
      integer, parameter :: most = 12
      ! Part of the traction that may be rounding [-]
      real(wp), parameter :: rounding = 1.0e-9_wp
      type(contact_t) :: contact
      ! Distance [m/s]; acceleration of the roller [rad/s^2]; decay rate over the distance [1/rad]
      real(wp) :: distance, acceleration, secant
      integer :: i, status

      if (.not. state%contact%is_touching) return
      if (abs(defect) <= rounding*(abs(state%contact%shear) + state%contact%boundary_capacity)*model%roller_radius**2 &
         & /(model%roller_inertia*model%speed)) return
      do i = 1, most
         if (.not. decay_rate > 0.0_wp) return
         distance = -defect/decay_rate
         if (.not. abs(distance) > 4.0_wp*spacing(state%contact%sliding_speed)) return
         if (abs(distance) > abs(state%contact%rolling_speed)) return
         call evaluate_spin(model, state%position, state%moments, state%contact%sliding_speed + distance, contact, &
            & acceleration, status)
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

   !> Is the film law inside its published range? True where there is no contact.
   pure function has_film_in_range(model, state) result(inside)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> State of the follower
      type(state_t), intent(in) :: state
      !> True inside
      logical :: inside

      inside = .true.
      if (state%contact%is_touching) then
         inside = is_in_range(model%film_law, film_groups(model, state%position, state%contact), model%film_table)
      end if
   end function has_film_in_range

   !> Mean torque of all camshaft bearings, over panels that end at the stops of every cam.
   subroutine mean_bearing_torque(shaft, models, cycles, mean, error)
      !> The shaft
      type(shaft_t), intent(inout) :: shaft
      !> Model of each lobe shape
      type(model_t), intent(in) :: models(:)
      !> Cycle of each lobe shape
      type(cycle_t), intent(in) :: cycles(:)
      !> Mean torque [N m]
      real(wp), intent(out) :: mean
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Stops of all cams [rad]
      real(wp), allocatable :: stops(:)
      ! Torques of the followers and of the bearings [N m]
      real(wp) :: torques(torque_count), bearing_torque
      ! Length of a panel, angle [rad]
      real(wp) :: length, angle
      integer :: cam, segment, panels, panel, node

      mean = 0.0_wp
      allocate (stops(0))
      do cam = 1, size(shaft%lobes)
         stops = [stops, cycles(shaft%lobes(cam))%stops + shaft%phases(cam)]
      end do
      stops = cycle_stops(stops, cycles(shaft%lobes(1))%start)
      do segment = 1, size(stops) - 1
         panels = ceiling((stops(segment + 1) - stops(segment))/longest_panel)
         if (panels == 0) cycle
         length = (stops(segment + 1) - stops(segment))/panels
         do panel = 0, panels - 1
            do node = 1, size(gauss_nodes)
               angle = stops(segment) + (panel + gauss_nodes(node))*length
               call shaft_torques(shaft, models, cycles, angle, state, torques, bearing_torque, error)
               if (allocated(error)) return
               mean = mean + gauss_weights(node)*length/two_pi*bearing_torque
            end do
         end do
      end do
   end subroutine mean_bearing_torque

end module camroller_means
