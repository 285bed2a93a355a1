!> Smallest and largest values of the series of a case, at the stops and between the angles met as well, with their errors.
!>
!> In: the solved case, rows of its series, margins. Out: `extremes_t`.
module camroller_series_extremes
   use camroller_kinds, only : two_pi, wp
   use camroller_error, only : error_t
   use camroller_bearing_asperity, only : bearing_state_t
   use camroller_catalogue, only : follower_values, camshaft_values, camshaft_count, lobe_columns, camshaft_columns
   use camroller_cycle, only : state_at
   use camroller_cycle_remarks, only : judge_extremes
   use camroller_error_estimate, only : margin
   use camroller_flexible_follower, only : follower_on_path
   use camroller_flexible_solution, only : error_share
   use camroller_extremes, only : samples_t, search_t, add_sample, beside_jump, narrow_search, start_search
   use camroller_lobe_curve, only : cam_values, contact_near, curve_points, curve_values, lobe_curve_t, &
      & telling_points
   use camroller_margins, only : margins_t
   use camroller_means, only : find_thickest_film, statistics_t
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t, find_quantity
   use camroller_part_series, only : bearing_count
   use camroller_shaft, only : solved_t, shaft_torques
   use camroller_slip_errors, only : error_at, error_of_extreme, relief_t, state_without
   use camroller_state, only : state_t
   use camroller_torque_list, only : torque_count, torque_series, of_contact, of_damping, of_geometric, of_guide_side, &
      & of_needle, of_needle_drag, of_pivot, of_residual, of_roller_inertia, of_seal, of_tip
   implicit none
   private

   public :: extremes_t, find_extremes, find_lobe_extremes

   !> Smallest and largest values
   type :: extremes_t
      !> Of each series [unit of the series]
      real(wp), allocatable :: lowest(:), highest(:)
      !> Smallest contact load of each lobe shape with the valve off its seat [N]
      real(wp), allocatable :: event_load(:)
   end type extremes_t

   !> Distance from a stop of rows of the camshaft that show an extreme close to a kink, whose points lie wider apart [rad]
   real(wp), parameter :: near = 1.0e-3_wp
   !> States that are kept while extremes are searched for
   integer, parameter :: most_kept = 32

   !> The last states that were solved in a search for extremes
   type :: kept_states_t
      !> Number of states so far
      integer :: count = 0
      !> Their cam angles from full lift [rad]
      real(wp) :: angles(most_kept) = 0.0_wp
      type(state_t) :: states(most_kept)
      !> Series without the error of the sliding speed
      type(relief_t) :: relief(most_kept)
      !> Series of the follower, shape (series, state); of a flexible train also those of the turn with a finer tolerance
      !> [unit of the series]
      real(wp), allocatable :: values(:, :), finer(:, :)
      !> Interval of the cycle where the next search starts, and of that turn
      integer :: hint = 1, finer_hint = 1
   end type kept_states_t

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

   !> Smallest and largest value of every series of the followers of a lobe shape, with their errors: at the stops and between the
   !> angles met as well.
   subroutine find_lobe_extremes(solved, lobe, series, margins, statistics, error)
      !> The solved case, with models and cycles
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> All series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Margins of the lobe shape
      type(margins_t), intent(in) :: margins
      !> Its statistics; rows are added; out: with the extremes
      type(statistics_t), intent(inout) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      integer :: columns(2)

      columns = lobe_columns(solved%case, lobe)
      associate (list => series(columns(1):columns(2)))
         call add_stops(solved, lobe, margins, statistics%curve, statistics%rows, error)
         if (allocated(error)) return
         call find_thickest_film(series, statistics)
         allocate (statistics%lowest(size(list)), statistics%highest(size(list)))
         call search_lobe(solved, lobe, list, statistics, statistics%lowest, statistics%highest, error)
         if (allocated(error)) return
         call judge_extremes(list, statistics%lowest, statistics%highest, statistics)
      end associate
      statistics%event_load = smallest_event_load(solved%models(lobe), series, statistics%rows)
   end subroutine find_lobe_extremes

   !> Smallest and largest value of every series: those of the followers as they were found, and those of the camshafts.
   subroutine find_extremes(solved, statistics, torque_rows, series, extremes, error)
      !> The solved case; its search hints move
      type(solved_t), intent(inout) :: solved
      !> Statistics of each lobe shape, with the extremes; out: with the largest error of those of the camshaft
      type(statistics_t), intent(inout) :: statistics(:)
      !> Rows of the camshaft; more are added
      type(samples_t), intent(inout) :: torque_rows
      !> All series of the case
      type(quantity_t), intent(in) :: series(:)
      !> The extremes
      type(extremes_t), intent(out) :: extremes
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: columns(2), lobe

      allocate (extremes%lowest(size(series)), extremes%highest(size(series)), extremes%event_load(size(statistics)))
      extremes%event_load = statistics%event_load
      do lobe = 1, size(statistics)
         columns = lobe_columns(solved%case, lobe)
         extremes%lowest(columns(1):columns(2)) = statistics(lobe)%lowest
         extremes%highest(columns(1):columns(2)) = statistics(lobe)%highest
      end do
      columns = camshaft_columns(solved%case)
      call search_camshaft(solved, statistics, series(columns(1):columns(2)), torque_rows, extremes%lowest(columns(1):columns(2)), &
         & extremes%highest(columns(1):columns(2)), error)
   end subroutine find_extremes

   !> Rows of a lobe's follower at the stops, and at the smallest load of the event without friction.
   subroutine add_stops(solved, lobe, margins, curve, samples, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> Its margins
      type(margins_t), intent(in) :: margins
      !> Its curve, with contacts to start from
      type(lobe_curve_t), intent(in) :: curve
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state
      ! Cam angles from full lift [rad]; a row [unit of the series]
      real(wp) :: angles(3*size(solved%cycles(lobe)%stops) + 1), values(size(samples%values, 1))
      integer :: hint, i

      hint = 1
      associate (stops => solved%cycles(lobe)%stops)
         angles = [stops - beside_jump, stops, stops + beside_jump, margins%event%angle]
      end associate
      do i = 1, size(angles)
         call state_at(solved%cycles(lobe), solved%models(lobe), angles(i), hint, state, error, &
            & contact_near(curve, angles(i)))
         if (allocated(error)) return
         call follower_values(solved%case, solved%models(lobe), state, values)
         ! Kinks of the lift are there for a rigid train: a flexible one may have its extreme close beside them
         call add_sample(samples, angles(i), values, i < size(angles) .and. .not. allocated(solved%cycles(lobe)%flexible))
      end do
   end subroutine add_stops

   !> Smallest and largest values of a lobe's follower, from its rows and between them; the rows alone where the solution itself is
   !> only linear between its points.
   subroutine search_lobe(solved, lobe, list, statistics, lowest, highest, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> The series of the follower
      type(quantity_t), intent(in) :: list(:)
      !> Its statistics, with the rows; out: with the errors of the values
      type(statistics_t), intent(inout) :: statistics
      !> The values [unit of the series]
      real(wp), intent(out) :: lowest(:), highest(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(search_t) :: search
      type(kept_states_t) :: kept
      integer :: series, sense, place

      allocate (statistics%extreme_errors(2, size(lowest)))
      statistics%extreme_errors = 0.0_wp
      associate (cycle => solved%cycles(lobe))
         do series = 1, size(lowest)
            do sense = -1, 1, 2
               call start_search(statistics%rows, series, sense, cycle%tolerance, search, &
                  & sense > 0 .and. index(list(series)%name, "film_") > 0)
               do while (search%is_wanted)
                  call keep_state(kept, solved, lobe, statistics%curve, search%trial, size(lowest), place, error)
                  if (allocated(error)) return
                  call narrow_search(statistics%rows, search, kept%values(series, place))
               end do
               if (sense > 0) lowest(series) = search%value
               if (sense < 0) highest(series) = -search%value
               call keep_state(kept, solved, lobe, statistics%curve, search%point, size(lowest), place, error)
               if (allocated(error)) return
               associate (of_value => statistics%extreme_errors(merge(1, 2, sense > 0), series))
                  if (allocated(cycle%flexible)) then
                     ! What the search leaves is unknown: slopes jump where contacts part, which rows do not mark
                     of_value = abs(kept%values(series, place) - kept%finer(series, place))*error_share
                  else
                     call error_of_extreme(statistics%slip_errors, solved, lobe, kept%states(place), kept%values(:, place), &
                        & kept%relief(place), search%point, series, sense, sense*search%value, search%is_exact, of_value)
                     of_value = of_value + search%left
                  end if
               end associate
            end do
         end do
      end associate
   end subroutine search_lobe

   !> Find the state at a cam angle among the last ones, or solve it: many series have their extremes at the same angles.
   subroutine keep_state(kept, solved, lobe, curve, angle, series, place, error)
      !> The states
      type(kept_states_t), intent(inout) :: kept
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> Its curve, with contacts to start from
      type(lobe_curve_t), intent(in) :: curve
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Number of series of the follower
      integer, intent(in) :: series
      !> Place of the state among those kept
      integer, intent(out) :: place
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state

      if (.not. allocated(kept%values)) allocate (kept%values(series, most_kept), kept%finer(series, most_kept))
      do place = 1, min(kept%count, most_kept)
         if (.not. abs(kept%angles(place) - angle) > 0.0_wp) return
      end do
      kept%count = kept%count + 1
      place = modulo(kept%count - 1, most_kept) + 1
      kept%angles(place) = angle
      kept%relief(place)%is_known = .false.
      call state_at(solved%cycles(lobe), solved%models(lobe), angle, kept%hint, kept%states(place), error, &
         & contact_near(curve, angle))
      if (allocated(error)) return
      call follower_values(solved%case, solved%models(lobe), kept%states(place), kept%values(:, place))
      if (.not. allocated(solved%cycles(lobe)%flexible)) return
      associate (flexible => solved%cycles(lobe)%flexible)
         call follower_on_path(solved%models(lobe), flexible%finer, flexible%finer_resolution, angle, kept%finer_hint, &
            & state, error)
      end associate
      if (.not. allocated(error)) call follower_values(solved%case, solved%models(lobe), state, kept%finer(:, place))
   end subroutine keep_state

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
      integer :: i, lobe, residual, series, sense

      ! It is rounding, of which the rows show enough
      residual = find_quantity(list, trim(torque_series(of_residual)))
      errors = 0.0_wp
      allocate (stops(0), angles(0))
      do lobe = 1, size(statistics)
         points = points_of(statistics(lobe), list)
         do i = 1, size(solved%shaft%lobes)
            ! Cams that do the same stop at the same angles
            if (solved%shaft%lobes(i) /= lobe .or. solved%shaft%twins(i) /= i) cycle
            stops = [stops, solved%cycles(lobe)%stops + solved%shaft%phases(i)]
            angles = [angles, points + solved%shaft%phases(i)]
         end do
      end do
      angles = [stops - near, stops + near, angles]
      stops = [stops - beside_jump, stops, stops + beside_jump]
      angles = [stops, angles]
      do i = 1, size(angles)
         call camshaft_row(solved, angles(i), values, error)
         if (allocated(error)) return
         call add_sample(samples, angles(i), values, i <= size(stops) .and. .not. allocated(solved%cycles(1)%flexible))
      end do
      do series = 1, size(values)
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
            associate (value => kept%values(series, i))
               errors(series) = max(errors(series), search%left + abs(kept%without(series, i) - value)*merge(error_share, margin, &
                  & allocated(solved%cycles(1)%flexible)) + abs(sense*search%value - value))
            end associate
         end do
      end do
      call judge_camshaft(list, lowest, highest, errors, statistics)
   end subroutine search_camshaft

   !> Cam angles from full lift of the points that tell how the torques of a lobe's follower run, without that of the valve guide:
   !> a loss that may take no part in the balance changes no bit of the others' extremes.
   pure function points_of(statistics, list) result(angles)
      !> Its statistics: those of a flexible train with rows of torques
      type(statistics_t), intent(in) :: statistics
      !> The series of these rows
      type(quantity_t), intent(in) :: list(:)
      !> The angles [rad]
      real(wp), allocatable :: angles(:)

      integer, parameter :: telling(*) = [of_geometric, of_contact, of_needle, of_roller_inertia, of_damping, of_tip, of_seal, &
         & of_guide_side, of_pivot, of_needle_drag]
      ! Torques at the points [N m]
      real(wp), allocatable :: torques(:, :)
      integer :: i

      if (allocated(statistics%torque_rows%angle)) then
         angles = statistics%torque_rows%angle(:statistics%torque_rows%count)
         associate (rows => [(find_quantity(list, trim(torque_series(telling(i)))), i=1, size(telling))])
            torques = statistics%torque_rows%values(pack(rows, rows > 0), :size(angles))
         end associate
      else
         call curve_points(statistics%curve, angles, torques)
         torques = torques(telling, :)
      end if
      if (size(angles) > 0) angles = pack(angles, telling_points(torques))
   end function points_of

   !> Find the row of the camshafts at a cam angle among those kept, or solve it, with what it is without the error of the sliding
   !> speed of each follower, or of a flexible train with a finer tolerance: by the states, not by the curves.
   subroutine keep_row(kept, solved, statistics, angle, place, error)
      !> The rows
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
               cams(:, cam) = cam_values(model, state, allocated(shaft%bearings))
               others(:, cam) = cams(:, cam)
               if (allocated(cycle%flexible)) then
                  hint = 1
                  call follower_on_path(model, cycle%flexible%finer, cycle%flexible%finer_resolution, inside, hint, right, error)
                  if (allocated(error)) return
                  others(:, cam) = cam_values(model, right, allocated(shaft%bearings))
               end if
               if (.not. allocated(statistics(lobe)%slip_errors%error)) cycle
               call state_without(model, cycle, inside, state, error_at(statistics(lobe)%slip_errors, inside), right, status)
               if (status == 0) others(:, cam) = cam_values(model, right, allocated(shaft%bearings))
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
      real(wp), intent(out) :: values(:)
      !> Convergence or domain error
      type(error_t), allocatable, intent(out) :: error
      !> What each cam takes from its follower, shape (value, cam) [N m, N]; without it the curves say so
      real(wp), intent(in), optional :: cams(:, :)

      ! Torques on each camshaft [N m]
      real(wp) :: torques(torque_count, solved%shaft%count)
      ! States of the bearings; allocated where they have series
      type(bearing_state_t), allocatable :: bearings(:, :)

      if (bearing_count(solved%case) > 0) allocate (bearings(bearing_count(solved%case), solved%shaft%count))
      call shaft_torques(solved, angle, torques, error, cams, bearings)
      if (allocated(error)) return
      call camshaft_values(solved%case, torques, values, bearings, solved%shaft%has_torque)
   end subroutine camshaft_row

   !> Smallest contact load with the valve off its seat; over the whole cycle where it never leaves it.
   pure function smallest_event_load(model, series, samples) result(load)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Rows of the lobe
      type(samples_t), intent(in) :: samples
      !> The load [N]
      real(wp) :: load

      ! Part of the lift at the seat that counts as all of it at a stop [-]
      real(wp), parameter :: nearly = 1.0_wp - 1.0e-9_wp
      logical :: in_event(samples%count)

      associate (lift => samples%values(find_quantity(series, "valve_lift"), :samples%count), &
         & loads => samples%values(find_quantity(series, "contact_load"), :samples%count))
         in_event = lift > 0.0_wp .and. lift >= nearly*model%train%seat_lift
         if (.not. any(in_event)) in_event = .true.
         load = minval(loads, in_event)
      end associate
   end function smallest_event_load

end module camroller_series_extremes
