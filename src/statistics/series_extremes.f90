!> Smallest and largest values of the series of a case, at the stops and between the angles met as well, with their errors.
!>
!> In: the solved case, rows of its series, margins. Out: `series_extremes_t`.
module camroller_series_extremes
   use camroller_kinds, only : wp, two_pi
   use camroller_camshaft_statistics, only : search_camshaft
   use camroller_catalogue, only : follower_values, lobe_columns, camshaft_columns
   use camroller_cycle, only : state_at
   use camroller_error, only : error_t
   use camroller_sampled_extremes, only : samples_t, search_t, add_sample, beside_jump, narrow_search, start_search
   use camroller_flexible_follower, only : follower_on_path
   use camroller_flexible_solution, only : error_share
   use camroller_lift, only : is_at_rest
   use camroller_lobe_curve, only : contact_near, lobe_curve_t
   use camroller_margins, only : margins_t
   use camroller_means, only : find_thickest_film, has_film_limit, statistics_t
   use camroller_model, only : model_t
   use camroller_result, only : quantity_t, find_quantity, is_film
   use camroller_roots, only : bracket_t, narrow_bracket, root_found, root_wanted, start_bracket
   use camroller_shaft, only : solved_t
   use camroller_slip_errors, only : error_of_extreme, relief_t
   use camroller_sorting, only : find_order
   use camroller_state, only : state_t
   implicit none
   private

   public :: series_extremes_t, find_extremes, find_lobe_extremes

   !> Smallest and largest values
   type :: series_extremes_t
      !> Of each series [unit of the series]
      real(wp), allocatable :: lowest(:), highest(:)
      !> Smallest contact load of each lobe shape with the valve off its seat [N]
      real(wp), allocatable :: event_load(:)
   end type series_extremes_t

   !> Error over the value that is rounding [-]
   real(wp), parameter :: rounding = 1.0e-12_wp
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
         if (allocated(solved%cycles(lobe)%flexible)) call add_event_ends(solved, lobe, series, statistics, error)
         if (allocated(error)) return
         call find_thickest_film(series, statistics)
         allocate (statistics%lowest(size(list)), statistics%highest(size(list)))
         call search_lobe(solved, lobe, series, statistics, statistics%lowest, statistics%highest, error)
         if (allocated(error)) return
         call judge_extremes(list, statistics%lowest, statistics%highest, statistics)
      end associate
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
      type(series_extremes_t), intent(out) :: extremes
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

   !> Rows of a flexible train at the ends of its event, which are no stops: the load of the event may be smallest there.
   subroutine add_event_ends(solved, lobe, series, statistics, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> All series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Statistics of the lobe; rows are added
      type(statistics_t), intent(inout) :: statistics
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      type(state_t) :: state
      integer :: order(statistics%rows%count), place, lift, hint
      logical :: inside(statistics%rows%count)
      ! Cam angles of a row and the next one from full lift [rad]; lifts of all rows above that at the seat [m]; a row [unit of the
      ! series]
      real(wp) :: angles(2), excess(statistics%rows%count), values(size(statistics%rows%values, 1))

      hint = 1
      lift = find_quantity(series, "valve_lift")
      associate (rows => statistics%rows, turn => solved%cycles(lobe), model => solved%models(lobe), n => size(order))
         inside = in_event(model, series, rows)
         excess = rows%values(lift, :n) - model%train%seat_lift
         call find_order(rows%angle(:n), order)
         do place = 1, n
            associate (pair => order([place, 1 + modulo(place, n)]))
               if (inside(pair(1)) .eqv. inside(pair(2))) cycle
               angles = rows%angle(pair)
               if (place == n) angles(2) = angles(2) + two_pi
               call start_bracket(bracket, angles(1), angles(2), excess(pair(1)), excess(pair(2)), 0.0_wp)
            end associate
            do while (bracket%status == root_wanted)
               call state_at(turn, model, bracket%trial, hint, state, error, contact_near(statistics%curve, bracket%trial))
               if (allocated(error)) return
               call narrow_bracket(bracket, state%position%lift - model%train%seat_lift)
            end do
            if (bracket%status /= root_found) cycle
            call state_at(turn, model, bracket%trial, hint, state, error, contact_near(statistics%curve, bracket%trial))
            if (allocated(error)) return
            call follower_values(solved%case, model, state, values)
            call add_sample(rows, bracket%trial, values, .false.)
         end do
      end associate
   end subroutine add_event_ends

   !> Smallest and largest values of a lobe's follower, from its rows and between them.
   subroutine search_lobe(solved, lobe, series, statistics, lowest, highest, error)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> All series of the case: those of the first lobe's follower stand in the order of every lobe's
      type(quantity_t), intent(in) :: series(:)
      !> Its statistics, with the rows; out: with the errors of the values, and the smallest load of the event
      type(statistics_t), intent(inout) :: statistics
      !> The values [unit of the series]
      real(wp), intent(out) :: lowest(:), highest(:)
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(kept_states_t) :: kept
      ! Rows with contact; not allocated where it is never lost
      logical, allocatable :: touching(:)
      integer :: i, load
      real(wp) :: error_of_load ! [N]

      allocate (kept%values(size(lowest), most_kept), kept%finer(size(lowest), most_kept))
      allocate (statistics%extreme_errors(2, size(lowest)))
      load = find_quantity(series, "contact_load")
      touching = statistics%rows%values(load, :statistics%rows%count) > 0.0_wp
      if (all(touching) .or. .not. any(touching)) deallocate (touching)
      associate (errors => statistics%extreme_errors)
         do i = 1, size(lowest)
            call search_series(solved, lobe, series(i), i, -1, statistics, kept, highest(i), errors(2, i), error)
            if (allocated(error)) return
            if (is_film(series(i))) then
               call search_series(solved, lobe, series(i), i, 1, statistics, kept, lowest(i), errors(1, i), error, touching)
            else
               call search_series(solved, lobe, series(i), i, 1, statistics, kept, lowest(i), errors(1, i), error)
            end if
            if (allocated(error)) return
         end do
         call search_series(solved, lobe, series(load), load, 1, statistics, kept, statistics%event_load, error_of_load, error, &
            & in_event(solved%models(lobe), series, statistics%rows))
         ! It is a smallest load as well
         errors(1, load) = max(errors(1, load), error_of_load)
      end associate
   end subroutine search_lobe

   !> Smallest or largest value of one series of a lobe's follower, with its error.
   subroutine search_series(solved, lobe, quantity, series, sense, statistics, kept, value, value_error, error, among)
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> The series, of the first lobe
      type(quantity_t), intent(in) :: quantity
      !> Its number among those of the follower
      integer, intent(in) :: series
      !> 1 for the smallest value, -1 for the largest
      integer, intent(in) :: sense
      !> Statistics of the lobe, with the rows
      type(statistics_t), intent(inout) :: statistics
      !> The last states
      type(kept_states_t), intent(inout) :: kept
      !> The value, its error [unit of the series]
      real(wp), intent(out) :: value, value_error
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Rows of the part of the turn that alone counts; all where absent
      logical, intent(in), optional :: among(:)

      type(search_t) :: search
      integer :: place
      logical :: needs_contact

      needs_contact = sense > 0 .and. is_film(quantity)
      associate (cycle => solved%cycles(lobe))
         call start_search(statistics%rows, series, sense, cycle%tolerance, search, &
            & sense > 0 .and. index(quantity%name, "film_") > 0, among)
         do while (search%is_wanted)
            call keep_state(kept, solved, lobe, statistics%curve, search%trial, place, error)
            if (allocated(error)) return
            if (needs_contact .and. .not. kept%states(place)%contact%is_touching) then
               ! No film is smallest where contact is lost between two rows
               call narrow_search(statistics%rows, search, maxval(statistics%rows%values(series, :statistics%rows%count)))
            else
               call narrow_search(statistics%rows, search, kept%values(series, place))
            end if
         end do
         value = sense*search%value
         call keep_state(kept, solved, lobe, statistics%curve, search%point, place, error)
         if (allocated(error)) return
         if (allocated(cycle%flexible)) then
            ! What the search leaves is unknown: slopes jump where contacts part, which rows do not mark
            value_error = abs(kept%values(series, place) - kept%finer(series, place))*error_share
         else
            call error_of_extreme(statistics%slip_errors, solved, lobe, kept%states(place), kept%values(:, place), &
               & kept%relief(place), search%point, series, sense, value, search%is_exact, present(among), value_error)
            value_error = value_error + search%left
         end if
      end associate
      ! What is constant has a range of rounding, which no error is to be compared with
      if (value_error <= rounding*abs(value)) value_error = 0.0_wp
   end subroutine search_series

   !> Rows of the event, with the valve off its seat; all where it never leaves it. Beside a stop the lift of a rigid train may be
   !> nothing but rounding, whether the valve moves or not.
   pure function in_event(model, series, samples)
      !> Model of the lobe
      type(model_t), intent(in) :: model
      !> Series of the case
      type(quantity_t), intent(in) :: series(:)
      !> Rows of the lobe
      type(samples_t), intent(in) :: samples
      logical :: in_event(samples%count)

      ! Part of the lift at the seat that counts as all of it at a stop [-]
      real(wp), parameter :: nearly = 1.0_wp - 1.0e-9_wp
      integer :: i

      associate (lift => samples%values(find_quantity(series, "valve_lift"), :samples%count))
         if (allocated(model%flexible)) then
            in_event = lift > 0.0_wp
         else
            ! An end of the event is no part of it: a force may jump there
            in_event = [(.not. (is_at_rest(model%lift_law, samples%angle(i)) .or. is_at_rest(model%lift_law, &
               & samples%angle(i) - 0.5_wp*beside_jump)), i=1, samples%count)]
         end if
         in_event = in_event .and. lift >= nearly*model%train%seat_lift
      end associate
      if (.not. any(in_event)) in_event = .true.
   end function in_event

   !> Find the state at a cam angle among the last ones, or solve it: many series have their extremes at the same angles.
   subroutine keep_state(kept, solved, lobe, curve, angle, place, error)
      type(kept_states_t), intent(inout) :: kept
      !> The solved case
      type(solved_t), intent(in) :: solved
      !> The lobe shape, from 1
      integer, intent(in) :: lobe
      !> Its curve, with contacts to start from
      type(lobe_curve_t), intent(in) :: curve
      !> Cam angle from full lift [rad]
      real(wp), intent(in) :: angle
      !> Place of the state among those kept
      integer, intent(out) :: place
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      type(state_t) :: state

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

   !> Largest error of a smallest or largest value, relative to the range of its series; the smallest film counts by itself, and so
   !> does that of every film where the largest has no limit. Dampers count by the largest of them: they are one loss together.
   pure subroutine judge_extremes(series, lowest, highest, statistics)
      !> The series of the follower
      type(quantity_t), intent(in) :: series(:)
      !> Smallest and largest values [unit of the series]
      real(wp), intent(in) :: lowest(:), highest(:)
      !> Statistics of the lobe; out: with the largest error
      type(statistics_t), intent(inout) :: statistics

      ! Errors over the range [-]; ranges [unit of the series]
      real(wp) :: relative(size(series)), ranges(size(series))
      ! Is a series what a damper loses?
      logical :: is_damper(size(series))
      ! Range that counts as none, whose quotients do not overflow [unit of the series]
      real(wp), parameter :: least = sqrt(tiny(1.0_wp))
      integer :: i

      ranges = max(highest - lowest, series%least, least)
      is_damper = [(index(series(i)%name, "damping_power_") > 0, i=1, size(series))]
      where (is_damper) ranges = maxval(ranges, mask=is_damper)
      associate (errors => statistics%extreme_errors)
         do i = 1, size(series)
            relative(i) = 0.0_wp
            ! A quantity that is zero throughout has no error
            if (.not. maxval(errors(:, i)) > 0.0_wp) cycle
            if (index(series(i)%name, "film_") > 0 .and. .not. has_film_limit(statistics)) then
               if (lowest(i) > least) relative(i) = errors(1, i)/lowest(i)
               cycle
            end if
            relative(i) = maxval(errors(:, i))/ranges(i)
            if (index(series(i)%name, "film_thickness_min") > 0) relative(i) = max(relative(i), errors(1, i)/max(lowest(i), least))
         end do
      end associate
      ! Where oil is missing, so is an opening of the check valve, or a part of one
      i = findloc([(index(series(i)%name, "check_valve_flow") > 0, i=1, size(series))], .true., 1)
      if (i > 0) relative(i) = max(relative(i), statistics%missing_oil)
      i = maxloc(relative, 1)
      statistics%extreme_error = relative(i)
      statistics%worst_extreme = series(i)%name
   end subroutine judge_extremes

end module camroller_series_extremes
