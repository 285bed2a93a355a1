!> Means, smallest and largest values of the series of the camshafts.
!>
!> In: the solved case, statistics of its lobe shapes. Out: mean torque of the bearings and means of the series of single ones over
!> a turn to the tolerance of the cycles, with an estimate of their error; rows of the series at the angles evaluated; with these
!> the smallest and largest values, between the angles met as well, with the largest of their errors in the statistics.
module camroller_camshaft_statistics
   use camroller_accuracy, only : quadrature_part
   use camroller_kinds, only : degree, two_pi, wp
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_catalogue, only : camshaft_columns, camshaft_count, camshaft_values
   use camroller_cycle, only : state_at
   use camroller_error_estimate, only : margin
   use camroller_sampled_extremes, only : samples_t, search_t, add_sample, beside_jump, move_samples, narrow_search, &
      & start_samples, start_search
   use camroller_flexible_follower, only : follower_on_path
   use camroller_flexible_solution, only : error_share
   use camroller_lobe_curve, only : cam_values, contact_near, curve_points, curve_values, telling_points
   use camroller_means, only : mean_tolerance, most_halvings, statistics_t
   use camroller_panels, only : sampled_t, panels_t, start_panels, sample_panel, refine_panels, total_of
   use camroller_part_series, only : bearing_count, bearing_series_count, load_part
   use camroller_result, only : quantity_t, find_quantity, series_name_length
   use camroller_shaft, only : bearing_number, shaft_stops, solved_t, shaft_torques, valves_rest
   use camroller_slip_errors, only : error_at, state_without
   use camroller_sorting, only : find_order
   use camroller_state, only : state_t
   use camroller_torque_list, only : torque_count, torque_series, of_bearings, of_contact, of_damping, of_geometric, &
      & of_gas_damping, of_guide_side, of_needle, of_needle_drag, of_pivot, of_residual, of_roller_inertia, of_seal, of_tip
   implicit none
   private

   public :: mean_bearing_torque, search_camshaft

   !> Longest panel, and where nothing but friction changes the load [rad]
   real(wp), parameter :: longest_panel = 15.0_wp*degree, longest_at_rest = 45.0_wp*degree

   !> Bearings of a camshaft on its turn
   type, extends(sampled_t) :: bearing_samples_t
      type(solved_t), pointer :: solved => null()
      !> Series of the camshaft at the angles evaluated, and their number
      type(samples_t) :: rows
      integer :: series = 0
      !> Those of them that are of single bearings, the last ones
      integer :: of_bearings = 0
      logical :: keeps_rows = .true.
      !> Room for torques on each camshaft [N m], for a row [unit of the series]
      real(wp), allocatable :: torques(:, :), row(:)
      !> Room for the bearings, none where the case has none
      type(bearing_state_t), allocatable :: bearings(:, :)
      !> Smallest film of each bearing of each camshaft at the same angles [m]
      type(samples_t) :: films
      !> Room for a row of it [m]
      real(wp), allocatable :: film(:)
   contains
      procedure :: sample => sample_bearings
   end type bearing_samples_t

   !> Distance from a stop of rows that show an extreme close to a kink, whose points lie wider apart [rad]
   real(wp), parameter :: near = 1.0e-3_wp
   !> Rows that are kept for the errors of extremes
   integer, parameter :: most_kept = 32

   !> Rows of the camshafts that were solved for the errors of extremes
   type :: kept_rows_t
      !> Number of rows so far, and places in use
      integer :: count = 0, used = 0
      !> Their cam angles from full lift [rad]
      real(wp) :: angles(most_kept) = 0.0_wp
      !> The rows, and what they are without the error of the sliding speed, shape (series, row) [unit of the series]
      real(wp), allocatable :: values(:, :), without(:, :)
   end type kept_rows_t

contains

   !> Mean torque of the bearings of each camshaft, and means of the series of single bearings, over panels that end at the stops
   !> of every cam.
   subroutine mean_bearing_torque(solved, series, single, mean, mean_error, worst, rows, films, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout), target :: solved
      !> All series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Means of the series of single bearings, as many as there are [unit of the series]
      real(wp), intent(out) :: single(:)
      !> Mean torque of each camshaft [N m]
      real(wp), intent(out) :: mean(:)
      !> Largest estimate of the error relative to the mean magnitude [-]
      real(wp), intent(out) :: mean_error
      !> Name of the series that this is the error of
      character(len=series_name_length), intent(out) :: worst
      !> Series of the camshaft at the angles evaluated
      type(samples_t), intent(out) :: rows
      !> Smallest film of each bearing of each camshaft at these angles, in order round a turn [m]
      type(samples_t), intent(out) :: films
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(bearing_samples_t) :: samples
      type(panels_t) :: panels
      ! Stops of all cams [rad]
      real(wp), allocatable :: stops(:)
      ! Length of a panel [rad]
      real(wp) :: length
      ! Error estimates allowed [unit of each times rad], errors relative to the mean magnitudes [-]
      real(wp), dimension(size(mean) + size(single)) :: allowed, errors
      integer :: segment, count, panel, halvings, columns(2), place

      mean = 0.0_wp
      mean_error = 0.0_wp
      samples%solved => solved
      samples%series = camshaft_count(solved%case)
      samples%of_bearings = size(single)
      allocate (samples%torques(torque_count, solved%shaft%count), samples%row(samples%series), &
         & samples%bearings(bearing_number(solved%shaft), solved%shaft%count), &
         & samples%film(bearing_number(solved%shaft)*solved%shaft%count))
      call start_samples(samples%rows, samples%series)
      call start_samples(samples%films, size(samples%film))
      stops = shaft_stops(solved, spread(.true., 1, size(solved%shaft%lobes)))
      call start_panels(panels, size(allowed), 2*size(stops) + ceiling(two_pi/longest_panel))
      do segment = 1, size(stops) - 1
         count = ceiling((stops(segment + 1) - stops(segment))/merge(longest_at_rest, longest_panel, &
            & valves_rest(solved, 0.5_wp*(stops(segment) + stops(segment + 1)))))
         length = (stops(segment + 1) - stops(segment))/max(count, 1)
         do panel = 1, count
            call sample_panel(panels, samples, stops(segment) + (panel - 1)*length, stops(segment) + panel*length, error)
            if (allocated(error)) return
         end do
      end do
      ! Not those of halved panels: what bearings ask for changes nothing but their own torque
      call move_samples(samples%rows, rows)
      call move_samples(samples%films, films)
      samples%keeps_rows = .false.
      halvings = most_halvings
      allowed = max(quadrature_part*mean_tolerance(maxval(solved%cycles%tolerance))*total_of(panels%sizes(:, :panels%count)), &
         & tiny(1.0_wp))
      ! First for the torque alone, which is the same whether or not single bearings have series
      call refine_panels(panels, samples, [allowed(:size(mean)), spread(huge(1.0_wp), 1, size(single))], halvings, error)
      if (allocated(error)) return
      mean = sum(panels%integrals(:size(mean), :panels%count), 2)/two_pi
      errors = total_of(panels%errors(:, :panels%count))/max(total_of(panels%sizes(:, :panels%count)), tiny(1.0_wp))
      mean_error = maxval(errors(:size(mean)))
      worst = torque_series(of_bearings)
      if (size(single) == 0) return
      call refine_panels(panels, samples, allowed, halvings, error)
      if (allocated(error)) return
      single = sum(panels%integrals(size(mean) + 1:, :panels%count), 2)/two_pi
      errors = total_of(panels%errors(:, :panels%count))/max(total_of(panels%sizes(:, :panels%count)), tiny(1.0_wp))
      if (maxval(errors(size(mean) + 1:)) <= mean_error) return
      columns = camshaft_columns(solved%case)
      place = maxloc(errors(size(mean) + 1:), 1)
      mean_error = errors(size(mean) + place)
      worst = series(columns(2) - size(single) + place)%name
   end subroutine mean_bearing_torque

   !> Torque of the bearings of each camshaft at a cam angle, and series of single bearings.
   subroutine sample_bearings(self, x, values, error)
      !> The shaft with its cycles
      class(bearing_samples_t), intent(inout) :: self
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: x
      !> The torques [N m], the series [unit of each]
      real(wp), intent(out), contiguous :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: k

      call shaft_torques(self%solved, x, self%torques, error, bearings=self%bearings)
      if (allocated(error)) return
      values(:self%solved%shaft%count) = self%torques(of_bearings, :)
      if (self%of_bearings == 0 .and. .not. self%keeps_rows) return
      call camshaft_values(self%solved%case, self%torques, self%row, self%bearings, self%solved%shaft%has_torque)
      values(self%solved%shaft%count + 1:) = self%row(self%series - self%of_bearings + 1:)
      if (.not. self%keeps_rows) return
      call add_sample(self%rows, x, self%row, .false.)
      do k = 1, size(self%bearings, 2)
         self%film((k - 1)*size(self%bearings, 1) + 1:k*size(self%bearings, 1)) = self%bearings(:, k)%film
      end do
      call add_sample(self%films, x, self%film, .false.)
   end subroutine sample_bearings

   !> Smallest and largest values of the camshaft's series, with the largest of their errors.
   subroutine search_camshaft(solved, statistics, list, samples, lowest, highest, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Statistics of each lobe shape; out: with that error
      type(statistics_t), intent(inout) :: statistics(:)
      !> The series of the camshaft
      type(quantity_t), intent(in) :: list(:)
      !> Rows of the camshaft; those of the stops are added
      type(samples_t), intent(inout) :: samples
      !> The values [unit of the series]
      real(wp), intent(out) :: lowest(:), highest(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(search_t) :: search
      type(kept_rows_t) :: kept
      ! Points that tell how torques of a shape run; stops of all cams, with points near them and those that tell [rad]; a row,
      ! larger error of smallest and largest value [unit of the series]
      real(wp), allocatable :: points(:), stops(:), angles(:)
      real(wp), dimension(size(lowest)) :: values, errors
      ! The first series of a single bearing, which are the last ones; turns that make rows, of a flexible train
      integer :: single, turns, kinks, i, lobe, residual, series, sense

      ! It is rounding, of which the rows show enough
      residual = find_quantity(list, trim(torque_series(of_residual)))
      errors = 0.0_wp
      turns = 0
      allocate (stops(0), angles(0))
      do lobe = 1, size(statistics)
         if (allocated(solved%cycles(lobe)%flexible)) turns = max(turns, size(solved%cycles(lobe)%flexible%turns))
         points = points_of(statistics(lobe), list)
         do i = 1, size(solved%shaft%lobes)
            ! Cams that do the same stop at the same angles
            if (solved%shaft%lobes(i) /= lobe .or. solved%shaft%twins(i) /= i) cycle
            stops = [stops, solved%cycles(lobe)%stops + solved%shaft%phases(i)]
            angles = [angles, points + solved%shaft%phases(i)]
         end do
      end do
      kinks = merge(size(stops), 0, turns == 0)
      angles = [stops, stops - beside_jump, stops + beside_jump, stops - near, stops + near, angles]
      do i = 1, size(angles)
         call camshaft_row(solved, angles(i), values, error)
         if (allocated(error)) return
         call add_sample(samples, angles(i), values, is_kink=i <= kinks)
      end do
      single = size(values) - bearing_series_count(solved%case) + 1
      do series = 1, size(values)
         ! Once the torques are done: the rows that single bearings add change no bit of an extreme of theirs
         if (series == single) call add_small_loads(solved, list, samples, error)
         if (allocated(error)) return
         if (series == residual) then
            lowest(series) = minval(samples%values(series, :samples%count))
            highest(series) = maxval(samples%values(series, :samples%count))
            cycle
         end if
         do sense = -1, 1, 2
            call start_search(samples, series, sense, maxval(solved%cycles%tolerance), search)
            do while (search%is_wanted)
               call camshaft_row(solved, search%trial, values, error)
               if (allocated(error)) return
               call narrow_search(samples, search, values(series))
            end do
            if (sense > 0) lowest(series) = search%value
            if (sense < 0) highest(series) = -search%value
            call keep_row(kept, solved, statistics, search%point, i, error)
            if (allocated(error)) return
            ! What the search leaves of a flexible train is unknown, and what it found may be of another turn than the last
            errors(series) = max(errors(series), abs(kept%without(series, i) - kept%values(series, i))*merge(margin, error_share, &
               & turns == 0) + merge(search%left, 0.0_wp, turns == 0) + merge(abs(sense*search%value - kept%values(series, i)), &
               & 0.0_wp, turns <= 1))
         end do
      end do
      call judge_camshaft(list, lowest, highest, errors, statistics)
   end subroutine search_camshaft

   !> Rows where the load of a single bearing passes close by zero between two others: what follows from its size turns there,
   !> though neither of its parts does.
   subroutine add_small_loads(solved, list, samples, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> The series of the camshaft
      type(quantity_t), intent(in) :: list(:)
      !> Rows of the camshaft; more are added
      type(samples_t), intent(inout) :: samples
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Angles of all rows in their order, last that of the first again [rad]; loads of a bearing there [N]
      real(wp), allocatable :: angles(:), loads(:, :)
      integer, allocatable :: order(:)
      integer :: series, i, n

      if (bearing_count(solved%case) == 0) return
      n = samples%count
      allocate (order(n))
      call find_order(samples%angle(:n), order)
      order = [order, order(1)]
      angles = samples%angle(order)
      angles(n + 1) = angles(n + 1) + two_pi
      do series = 1, size(list)
         ! The other part follows
         if (index(list(series)%name//" ", load_part//" ") == 0) cycle
         loads = samples%values([series, series + 1], order)
         do i = 1, n
            call close_in(solved, series, angles(i:i + 1), loads(:, i:i + 1), samples, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine add_small_loads

   !> Rows between two others where the load of a bearing passes zero closer than at both, until one is about as close as the load
   !> comes: where the straight line between two loads is nearest, and half the way between them, by turns.
   subroutine close_in(solved, series, angles, loads, samples, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Which series of the camshaft the first part of the load is
      integer, intent(in) :: series
      !> Cam angles at both ends [rad], loads there, shape (2, end) [N]
      real(wp), intent(in) :: angles(2), loads(2, 2)
      !> Rows of the camshaft; more are added
      type(samples_t), intent(inout) :: samples
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      ! Rows at most
      integer, parameter :: most = 16
      ! Load of the last one over the nearest of the straight line: from there on the search for extremes sees a smooth curve [-]
      real(wp), parameter :: near = 1.1_wp
      ! Ends and a place between [rad], loads there [N]; the row there [unit of the series]
      real(wp) :: places(3), between(2, 3), values(size(samples%values, 1))
      ! Part of the way where the line is nearest, in what is left and in both pieces of it [-]; distances from zero there [N]
      real(wp) :: part, parts(2), distance, distances(2)
      integer :: i, half

      places([1, 3]) = angles
      between(:, [1, 3]) = loads
      call find_nearest(loads, part, distance)
      do i = 1, most
         if (distance >= huge(1.0_wp)) return
         places(2) = places(1) + merge(part, 0.5_wp, modulo(i, 2) == 1)*(places(3) - places(1))
         call camshaft_row(solved, places(2), values, error)
         if (allocated(error)) return
         call add_sample(samples, places(2), values, .false.)
         between(:, 2) = values([series, series + 1])
         if (norm2(between(:, 2)) <= near*distance) return
         do half = 1, 2
            call find_nearest(between(:, half:half + 1), parts(half), distances(half))
         end do
         half = minloc(distances, 1)
         part = parts(half)
         distance = distances(half)
         places([1, 3]) = places(half:half + 1)
         between(:, [1, 3]) = between(:, half:half + 1)
      end do
   end subroutine close_in

   !> Where the straight line from one load to another is nearest to zero.
   pure subroutine find_nearest(loads, part, distance)
      !> The loads, shape (2, end) [N]
      real(wp), intent(in) :: loads(2, 2)
      !> Part of the way there [-]
      real(wp), intent(out) :: part
      !> Its distance from zero; huge where one of the loads themselves is about as near [N]
      real(wp), intent(out) :: distance

      ! Least distance over that of the nearer load beyond which the two tell as much [-]
      real(wp), parameter :: close = 0.9_wp
      real(wp) :: way(2), length ! Way from the one to the other [N], its length squared [N^2]

      way = loads(:, 2) - loads(:, 1)
      length = dot_product(way, way)
      part = -dot_product(loads(:, 1), way)
      distance = huge(1.0_wp)
      if (.not. (part > 0.0_wp .and. part < length)) return
      part = part/length
      distance = norm2(loads(:, 1) + part*way)
      if (distance >= close*min(norm2(loads(:, 1)), norm2(loads(:, 2)))) distance = huge(1.0_wp)
   end subroutine find_nearest

   !> Cam angles from full lift of the points that tell how the torques of a lobe's follower run, and the size of its force on the
   !> cam. Without the torque of the valve guide: a loss that may take no part in the balance changes no bit of other extremes.
   pure function points_of(statistics, list) result(angles)
      !> Its statistics: those of a flexible train with rows of torques
      type(statistics_t), intent(in) :: statistics
      !> The series of these rows
      type(quantity_t), intent(in) :: list(:)
      !> The angles [rad]
      real(wp), allocatable :: angles(:)

      integer, parameter :: telling(*) = [of_geometric, of_contact, of_needle, of_roller_inertia, of_damping, of_tip, of_seal, &
         & of_guide_side, of_pivot, of_needle_drag, of_gas_damping]
      ! Torques and force at the points [N m, N]
      real(wp), allocatable :: values(:, :)
      integer :: i

      if (allocated(statistics%torque_rows%angle)) then
         angles = statistics%torque_rows%angle(:statistics%torque_rows%count)
         associate (rows => [(find_quantity(list, trim(torque_series(telling(i)))), i=1, size(telling))])
            values = statistics%torque_rows%values(pack(rows, rows > 0), :size(angles))
         end associate
      else
         call curve_points(statistics%curve, angles, values)
         values(torque_count + 1, :) = norm2(values(torque_count + 1:, :), 1)
         values = values([telling, torque_count + 1], :)
      end if
      if (size(angles) > 0) angles = pack(angles, telling_points(angles, values))
   end function points_of

   !> Find the row of the camshafts at a cam angle among those kept, or solve it, with what it is without the error of the sliding
   !> speed of each follower, or of a flexible train with a finer tolerance: by the states, not by the curves.
   subroutine keep_row(kept, solved, statistics, angle, place, error)
      type(kept_rows_t), intent(inout) :: kept
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Statistics of each lobe shape
      type(statistics_t), intent(in) :: statistics(:)
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> Place of the row among those kept
      integer, intent(out) :: place
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state, right
      ! What each cam takes from its follower, and without the error of the sliding speed, or from the turn of a flexible train with
      ! a finer tolerance [N m, N]; angle within the cycle [rad]
      real(wp), dimension(curve_values, size(solved%shaft%lobes)) :: cams, others
      real(wp) :: inside
      integer :: cam, status, hint

      if (.not. allocated(kept%values)) allocate (kept%values(camshaft_count(solved%case), most_kept), &
         & kept%without(camshaft_count(solved%case), most_kept))
      do place = 1, kept%used
         if (.not. abs(kept%angles(place) - angle) > 0.0_wp) return
      end do
      place = modulo(kept%count, most_kept) + 1
      kept%count = kept%count + 1
      kept%used = max(kept%used, place)
      kept%angles(place) = angle
      do cam = 1, size(solved%shaft%lobes)
         associate (shaft => solved%shaft, lobe => solved%shaft%lobes(cam), twin => solved%shaft%twins(cam))
            if (twin < cam) cycle
            associate (model => solved%models(lobe), cycle => solved%cycles(lobe))
               inside = cycle%start + modulo(angle - shaft%phases(cam) - cycle%start, two_pi)
               call state_at(cycle, model, inside, shaft%hints(cam), state, error, &
                  & contact_near(statistics(lobe)%curve, inside))
               if (allocated(error)) return
               cams(:, cam) = cam_values(model, state)
               others(:, cam) = cams(:, cam)
               if (allocated(cycle%flexible)) then
                  hint = 1
                  call follower_on_path(model, cycle%flexible%finer, cycle%flexible%finer_resolution, inside, hint, right, error)
                  if (allocated(error)) return
                  others(:, cam) = cam_values(model, right)
               end if
               if (.not. allocated(statistics(lobe)%slip_errors%error)) cycle
               call state_without(model, cycle, inside, state, error_at(statistics(lobe)%slip_errors, inside), right, status)
               if (status == 0) others(:, cam) = cam_values(model, right)
            end associate
         end associate
      end do
      call camshaft_row(solved, angle, kept%values(:, place), error, cams)
      if (.not. allocated(error)) call camshaft_row(solved, angle, kept%without(:, place), error, others)
   end subroutine keep_row

   !> Largest error of a smallest or largest value of the camshaft, relative to the range of its series; that of a torque relative
   !> to the range of the friction torque where this is larger.
   pure subroutine judge_camshaft(list, lowest, highest, errors, statistics)
      !> The series of the camshaft
      type(quantity_t), intent(in) :: list(:)
      !> Smallest and largest values, their larger error [unit of the series]
      real(wp), intent(in) :: lowest(:), highest(:), errors(:)
      !> Statistics of each lobe shape; out: with that error where it is the largest
      type(statistics_t), intent(inout) :: statistics(:)

      ! Error over the magnitude of a series that is rounding [-]; range that counts as none [unit of the series]
      real(wp), parameter :: rounding = 1.0e-12_wp, least = sqrt(tiny(1.0_wp))
      ! Error over the range [-], ranges [unit of the series]
      real(wp) :: relative, ranges(size(list))
      integer :: friction, i

      ranges = max(highest - lowest, least)
      friction = find_quantity(list, "torque_friction")
      do i = 1, size(list)
         if (errors(i) <= rounding*max(abs(lowest(i)), abs(highest(i)))) cycle
         relative = errors(i)/ranges(i)
         if (list(i)%unit == "N m") relative = errors(i)/max(ranges(i), ranges(friction))
         if (relative <= maxval(statistics%extreme_error)) cycle
         statistics(1)%extreme_error = relative
         statistics(1)%worst_extreme = list(i)%name
      end do
   end subroutine judge_camshaft

   !> The camshaft's series at a cam angle.
   subroutine camshaft_row(solved, angle, values, error, cams)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> The series [unit of the series]
      real(wp), intent(out), contiguous :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error
      !> What each cam takes from its follower, shape (value, cam) [N m, N]; without it the curves say so
      real(wp), intent(in), contiguous, optional :: cams(:, :)

      ! Torques on each camshaft [N m]
      real(wp) :: torques(torque_count, solved%shaft%count)
      ! States of the bearings; allocated where they have series
      type(bearing_state_t), allocatable :: bearings(:, :)

      if (bearing_count(solved%case) > 0) allocate (bearings(bearing_count(solved%case), solved%shaft%count))
      if (present(cams)) call shaft_torques(solved, angle, torques, error, cams, bearings)
      if (.not. present(cams)) call shaft_torques(solved, angle, torques, error, bearings=bearings)
      if (.not. allocated(error)) call camshaft_values(solved%case, torques, values, bearings, solved%shaft%has_torque)
   end subroutine camshaft_row

end module camroller_camshaft_statistics
