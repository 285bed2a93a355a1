!> Smallest and largest values of the series of a cycle, between the angles at which they were sampled as well.
!>
!> In: rows of series at cam angles, in any order. Out: for each series the search for its smallest and largest value, for which the
!> caller evaluates the series, and what may be left to gain:
!>
!>     call start_search(samples, series, sense, tolerance, search)
!>     do while (search%is_wanted)
!>        call narrow_search(samples, search, value of the series at search%trial)
!>     end do
!>
!> It looks near the row that has the extreme, and near every other at which the series turns and that may hide a value beyond it:
!> of two summits of nearly the same height, rows may show the lower one as the higher. A value counts only where it was evaluated,
!> so that an extreme is never outside what the series takes.
module camroller_sampled_extremes
   use camroller_kinds, only : wp, two_pi
   use camroller_minimum, only : minimum_t, narrow_minimum, start_minimum
   use camroller_sorting, only : find_order
   implicit none
   private

   public :: samples_t, search_t, start_samples, add_sample, move_samples, start_search, narrow_search
   public :: beside_jump

   !> Distance from an angle where series may jump of the rows on both sides of it: nothing is looked for between rows that close
   !> [rad]
   real(wp), parameter :: beside_jump = 1.0e-9_wp
   !> Neighbours on both sides are as close as that
   integer, parameter :: on_both_sides = 4

   !> Rows that are looked near at most: cylinders that do the same one after another have an extreme each, and each may hide it
   !> beside some rows of unlike distance
   integer, parameter :: most_rows = 32

   !> Rows of series over one turn
   type :: samples_t
      !> Number of rows
      integer :: count = 0
      !> Cam angle of each row, within one turn [rad]
      real(wp), allocatable :: angle(:)
      !> Values, shape (series, row) [unit of the series]
      real(wp), allocatable :: values(:, :)
      !> Is the row one at which the slope of series jumps? Is it exact, whatever the error of the curve?
      logical, allocatable, private :: is_kink(:), is_exact(:)
      !> For the first `sorted` rows: they by their angles; for each the last row at a smaller angle and the first at a larger one,
      !> round the turn, shape (side, row)
      integer, allocatable, private :: order(:), beside(:, :)
      integer, private :: sorted = 0
      !> Among them by angle: places of the smallest and the largest value of each series, shape (2, series); how many places there
      !> are where it may turn, and these places, shape (turn, series)
      integer, allocatable, private :: ends(:, :), turn_counts(:), turns(:, :)
   end type samples_t

   !> Search for the smallest or largest value of a series; for the largest all values have the opposite sign
   type :: search_t
      !> Is the value at `trial` wanted?
      logical :: is_wanted = .false.
      !> Cam angle where it is wanted, that of the extreme so far [rad]
      real(wp) :: trial = 0.0_wp, point = 0.0_wp
      !> The extreme so far [unit of the series]
      real(wp) :: value = 0.0_wp
      !> What there may be beyond it [unit of the series]
      real(wp) :: left = 0.0_wp
      !> Is it the value of a row that is exact?
      logical :: is_exact = .false.
      integer, private :: series = 0, sense = 1
      !> Rows to look near, how many of them are done, and the search near one
      integer, private :: rows(most_rows) = 0, row_count = 0, done = 0
      type(minimum_t), private :: now
      !> What a gain is small against, the extent of the series as a rule; lowest value that there may be where the search is done
      !> [unit of the series]
      real(wp), private :: extent = 0.0_wp, bound = 0.0_wp
      !> Gain that is not worth a value, what may be left at a kink, over the extent [-]
      real(wp), private :: worth = 0.0_wp, coarse = 0.0_wp
   end type search_t

   !> Values that are asked for near a row at most, and at a kink, where each about halves what is left
   integer, parameter :: most_steps = 8, most_halvings = 30
   !> Gain of an extreme that is not worth a value, over the extent of its series: over the tolerance, which makes a hundredth of
   !> the accuracy, at least, and at most [-]
   real(wp), parameter :: worth_part = 3.0_wp, least_worth = 1.0e-7_wp, most_worth = 1.0e-5_wp
   !> Widest distance to a neighbour that a search may begin with; distance of rows that share an angle but for rounding [rad]
   real(wp), parameter :: widest = two_pi/24.0_wp, same_angle = 1.0e-12_wp
   !> Rows for which there is room at first
   integer, parameter :: first_room = 1536

contains

   !> No rows yet.
   pure subroutine start_samples(samples, series)
      !> The rows
      type(samples_t), intent(out) :: samples
      !> Number of series
      integer, intent(in) :: series

      allocate (samples%angle(first_room), samples%values(series, first_room), samples%is_kink(first_room), &
         & samples%is_exact(first_room))
   end subroutine start_samples

   !> Add a row.
   pure subroutine add_sample(samples, angle, values, is_kink, is_exact)
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> Cam angle, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Value of each series [unit of the series]
      real(wp), intent(in) :: values(:)
      !> Does the slope of series jump there?
      logical, intent(in) :: is_kink
      !> Is the row exact, whatever the error of the curve? Not where absent
      logical, intent(in), optional :: is_exact

      if (samples%count == size(samples%angle)) call make_room(samples)
      samples%count = samples%count + 1
      samples%angle(samples%count) = modulo(angle, two_pi)
      samples%values(:, samples%count) = values
      samples%is_kink(samples%count) = is_kink
      samples%is_exact(samples%count) = .false.
      if (present(is_exact)) samples%is_exact(samples%count) = is_exact
   end subroutine add_sample

   !> Hand rows over without a copy.
   pure subroutine move_samples(from, to)
      !> The rows; out: none, and no room for any
      type(samples_t), intent(inout) :: from
      !> The same rows
      type(samples_t), intent(out) :: to

      to%count = from%count
      from%count = 0
      call move_alloc(from%angle, to%angle)
      call move_alloc(from%values, to%values)
      call move_alloc(from%is_kink, to%is_kink)
      call move_alloc(from%is_exact, to%is_exact)
   end subroutine move_samples

   !> Double the room for rows.
   pure subroutine make_room(samples)
      !> The rows
      type(samples_t), intent(inout) :: samples

      ! Longer lists [rad], [unit of the series]
      real(wp), allocatable :: angles(:), rows(:, :)
      logical, allocatable :: kinks(:), exact(:)

      associate (n => samples%count)
         allocate (angles(2*n), rows(size(samples%values, 1), 2*n), kinks(2*n), exact(2*n))
         angles(:n) = samples%angle
         rows(:, :n) = samples%values
         kinks(:n) = samples%is_kink
         exact(:n) = samples%is_exact
      end associate
      call move_alloc(angles, samples%angle)
      call move_alloc(rows, samples%values)
      call move_alloc(kinks, samples%is_kink)
      call move_alloc(exact, samples%is_exact)
   end subroutine make_room

   !> Find the neighbours of every row.
   pure subroutine find_neighbours(samples)
      !> The rows
      type(samples_t), intent(inout) :: samples

      integer :: place, before

      if (allocated(samples%order)) deallocate (samples%order, samples%beside)
      allocate (samples%order(samples%count), samples%beside(2, samples%count))
      call find_order(samples%angle(:samples%count), samples%order)
      samples%sorted = samples%count
      associate (order => samples%order)
         ! Rows that share an angle share their neighbours
         before = order(samples%count)
         do place = 1, samples%count
            if (place > 1) then
               if (samples%angle(order(place)) > samples%angle(order(place - 1)) + same_angle) before = order(place - 1)
            end if
            samples%beside(1, order(place)) = before
         end do
         before = order(1)
         do place = samples%count, 1, -1
            if (place < samples%count) then
               if (samples%angle(order(place)) < samples%angle(order(place + 1)) - same_angle) before = order(place + 1)
            end if
            samples%beside(2, order(place)) = before
         end do
      end associate
      call find_turns(samples)
   end subroutine find_neighbours

   !> Find the smallest and the largest value of every series, the first of equal ones, and the places where it may turn: where it
   !> is beyond both places beside it, or as far as one of them.
   pure subroutine find_turns(samples)
      !> The rows; their neighbours are known
      type(samples_t), intent(inout) :: samples

      ! Smallest and largest values so far, shape (2, series) [unit of each]
      real(wp), allocatable :: extremes(:, :)
      integer :: place, before, here, after

      if (allocated(samples%ends)) deallocate (samples%ends, samples%turn_counts, samples%turns)
      associate (order => samples%order, values => samples%values, rows => samples%count, count => size(samples%values, 1))
         allocate (samples%ends(2, count), samples%turn_counts(count), samples%turns(rows, count))
         samples%ends = 1
         samples%turn_counts = 0
         before = order(rows)
         here = order(1)
         extremes = spread(values(:, here), 1, 2)
         do place = 1, rows
            after = order(merge(1, place + 1, place == rows))
            call look_at_place(place, samples%beside(1, here) == before .and. samples%beside(2, here) == after, rows, count, &
               & values(:, before), values(:, here), values(:, after), extremes, samples%ends, samples%turn_counts, samples%turns)
            before = here
            here = after
         end do
      end associate
   end subroutine find_turns

   !> Look whether series may turn at a place, or have an extreme there.
   pure subroutine look_at_place(place, is_alone, rows, count, before, here, after, extremes, ends, turn_counts, turns)
      !> The place among the rows by angle
      integer, intent(in) :: place
      !> Has no other row its angle?
      logical, intent(in) :: is_alone
      !> Number of rows and of series
      integer, intent(in) :: rows, count
      !> Values at the place before, here, and at the one after [unit of each]
      real(wp), intent(in) :: before(count), here(count), after(count)
      !> Smallest and largest values of the places before [unit of each], and their places
      real(wp), intent(inout) :: extremes(2, count)
      integer, intent(inout) :: ends(2, count)
      !> Number of places where each may turn, and these places
      integer, intent(inout) :: turn_counts(count), turns(rows, count)

      integer :: i

      do i = 1, count
         if ((here(i) > before(i) .and. here(i) < after(i)) .or. (here(i) < before(i) .and. here(i) > after(i))) cycle
         if (here(i) < extremes(1, i)) then
            extremes(1, i) = here(i)
            ends(1, i) = place
         else if (here(i) > extremes(2, i)) then
            extremes(2, i) = here(i)
            ends(2, i) = place
         end if
         if (is_alone .and. max(before(i), after(i)) <= here(i) .and. min(before(i), after(i)) >= here(i)) cycle
         turn_counts(i) = turn_counts(i) + 1
         turns(turn_counts(i), i) = place
      end do
   end subroutine look_at_place

   !> Begin the search for the smallest or largest value of a series. Each series is searched by itself, so that what else is
   !> sampled changes no bit of it.
   pure subroutine start_search(samples, series, sense, tolerance, search, by_itself, among)
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> The series
      integer, intent(in) :: series
      !> 1 for the smallest value, -1 for the largest
      integer, intent(in) :: sense
      !> What may be left at a kink, over the extent of the series [-]
      real(wp), intent(in) :: tolerance
      !> The search; nothing is wanted near a kink, or without a row close by on both sides
      type(search_t), intent(out) :: search
      !> Is the extreme itself what a gain is small against, where it is less than the extent?
      logical, intent(in), optional :: by_itself
      !> Rows of the part of the turn that alone is searched, one of them at least; all where absent
      logical, intent(in), optional :: among(:)

      integer :: extreme

      if (samples%sorted < samples%count) call find_neighbours(samples)
      search%series = series
      search%sense = sense
      search%worth = min(max(least_worth, worth_part*tolerance), most_worth)
      search%coarse = max(least_worth, tolerance)
      associate (lowest => samples%order(samples%ends(1, series)), highest => samples%order(samples%ends(2, series)))
         extreme = merge(lowest, highest, sense > 0)
         search%extent = samples%values(series, highest) - samples%values(series, lowest)
      end associate
      if (present(among)) extreme = minloc(sense*samples%values(series, :samples%count), 1, among)
      search%value = sense*samples%values(series, extreme)
      if (present(by_itself)) then
         if (by_itself) search%extent = min(search%extent, abs(search%value))
      end if
      call list_rows(samples, extreme, search, among)
      call enter_row(samples, search)
   end subroutine start_search

   !> Take the value of the series at the trial angle.
   pure subroutine narrow_search(samples, search, value)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> The search
      type(search_t), intent(inout) :: search
      !> The value, with its own sign [unit of the series]
      real(wp), intent(in) :: value

      call narrow_minimum(search%now, search%sense*value)
      search%trial = search%now%trial
      search%is_wanted = search%now%is_wanted
      if (search%now%steps >= most_steps) search%is_wanted = search%is_wanted .and. search%now%left > search%coarse*search%extent
      search%is_wanted = search%is_wanted .and. may_gain(search)
      if (search%is_wanted) return
      call leave_row(search)
      call enter_row(samples, search)
   end subroutine narrow_search

   !> Rows near which there may be an extreme: the extreme one, then those that may hide a value beyond it, the most promising
   !> first. Not those where slopes jump, nor those at an end of the part of the turn that is searched.
   pure subroutine list_rows(samples, extreme, search, among)
      !> The rows
      type(samples_t), intent(in) :: samples
      integer, intent(in) :: extreme
      type(search_t), intent(inout) :: search
      !> As of `start_search`
      logical, intent(in), optional :: among(:)

      ! The lowest values that the rows may hide, in rising order from behind the extreme one; that of a row [unit of the series]
      real(wp) :: bounds(most_rows), bound
      integer :: turn, first, place

      search%bound = search%value
      search%point = samples%angle(extreme)
      search%is_exact = samples%is_exact(extreme)
      first = merge(0, 1, samples%is_kink(extreme))
      if (present(among)) first = merge(first, 0, is_within(samples, extreme, among))
      search%rows(:first) = extreme
      search%row_count = first
      do turn = 1, samples%turn_counts(search%series)
         associate (row => samples%order(samples%turns(turn, search%series)))
            if (row == extreme .or. samples%is_kink(row)) cycle
            if (present(among)) then
               if (.not. is_within(samples, row, among)) cycle
            end if
            bound = lowest_hidden(samples, search, row)
            if (bound >= search%value - search%worth*search%extent) then
               search%bound = min(search%bound, bound)
               cycle
            end if
            if (search%row_count == most_rows) then
               ! One too many: the last one is not looked near
               search%bound = min(search%bound, max(bound, bounds(most_rows)))
               if (bound >= bounds(most_rows)) cycle
               search%row_count = most_rows - 1
            end if
            do place = search%row_count + 1, first + 2, -1
               if (bounds(place - 1) <= bound) exit
               search%rows(place) = search%rows(place - 1)
               bounds(place) = bounds(place - 1)
            end do
            search%rows(place) = row
            bounds(place) = bound
            search%row_count = search%row_count + 1
         end associate
      end do
   end subroutine list_rows

   !> Are a row and its neighbours in the part of the turn that is searched?
   pure function is_within(samples, row, among)
      !> The rows; their neighbours are known
      type(samples_t), intent(in) :: samples
      integer, intent(in) :: row
      !> As of `start_search`
      logical, intent(in) :: among(:)
      logical :: is_within

      is_within = among(row) .and. among(samples%beside(1, row)) .and. among(samples%beside(2, row))
   end function is_within

   !> Lowest value that there may be beside a row at which the series turns. A curve that is bent to one side is nowhere below the
   !> straight lines through the row and its neighbours, continued to the neighbour on the other side; beside a jump, below the line
   !> through its neighbour and the next one, continued to the row.
   pure function lowest_hidden(samples, search, row) result(bound)
      !> The rows
      type(samples_t), intent(in) :: samples
      type(search_t), intent(in) :: search
      integer, intent(in) :: row
      !> The value; large where the series does not turn [unit of the series]
      real(wp) :: bound

      ! As of `look_near`: [rad], [unit of the series], both; rises from the row to its neighbours [unit of the series]
      real(wp) :: x(3), values(3), outer(2), rises(2)
      integer :: jump

      bound = huge(1.0_wp)
      call look_near(samples, search, row, x, values, jump, outer)
      rises = values([1, 3]) - values(2)
      if (min(rises(1), rises(2)) < 0.0_wp .or. max(rises(1), rises(2)) <= 0.0_wp) return
      if (x(3) - x(1) > 2.0_wp*widest .or. jump == on_both_sides) return
      if (jump == 0) then
         bound = values(2) - max(-rises(1)*x(3)/x(1), -rises(2)*x(1)/x(3))
      else
         associate (side => 4 - jump)
            bound = min(values(2), values(side) + (outer(2) - values(side))*x(side)/(x(side) - outer(1)))
         end associate
      end if
   end function lowest_hidden

   !> A row and its neighbours, by angles from that of the row. A neighbour as close as rows beside a jump has nothing to tell of
   !> the curve on the other side; there the row beyond the other neighbour has.
   pure subroutine look_near(samples, search, row, x, values, jump, outer)
      !> The rows
      type(samples_t), intent(in) :: samples
      type(search_t), intent(in) :: search
      integer, intent(in) :: row
      !> Angles of neighbour, row, and neighbour [rad], values there [unit of the series]
      real(wp), intent(out) :: x(3), values(3)
      !> The neighbour that is that close, 1 or 3, 0 for none, or `on_both_sides`
      integer, intent(out) :: jump
      !> Angle of the row beyond the other neighbour [rad], value there [unit of the series]; 0 without a jump on one side
      real(wp), intent(out) :: outer(2)

      integer :: next

      associate (left => samples%beside(1, row), right => samples%beside(2, row))
         values(1) = search%sense*samples%values(search%series, left)
         values(2) = search%sense*samples%values(search%series, row)
         values(3) = search%sense*samples%values(search%series, right)
         x = [-way(samples, left, row), 0.0_wp, way(samples, row, right)]
      end associate
      outer = 0.0_wp
      jump = 0
      if (-x(1) < 1.5_wp*beside_jump) jump = 1
      if (x(3) < 1.5_wp*beside_jump) jump = merge(on_both_sides, 3, jump == 1)
      if (jump == 1) then
         next = samples%beside(2, samples%beside(2, row))
         outer = [x(3) + way(samples, samples%beside(2, row), next), search%sense*samples%values(search%series, next)]
      else if (jump == 3) then
         next = samples%beside(1, samples%beside(1, row))
         outer = [x(1) - way(samples, next, samples%beside(1, row)), search%sense*samples%values(search%series, next)]
      end if
   end subroutine look_near

   !> Angle from one row on to another [rad].
   pure function way(samples, from, to)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> The two
      integer, intent(in) :: from, to
      real(wp) :: way ! [rad]

      way = samples%angle(to) - samples%angle(from)
      if (way < 0.0_wp) then
         way = way + two_pi
      else if (way >= two_pi) then
         way = way - two_pi
      end if
   end function way

   !> Begin near the next row where there is anything to look for.
   pure subroutine enter_row(samples, search)
      !> The rows
      type(samples_t), intent(in) :: samples
      type(search_t), intent(inout) :: search

      ! As of `look_near`: [rad], [unit of the series], both
      real(wp) :: x(3), values(3), outer(2)
      integer :: jump

      do while (search%done < search%row_count)
         search%done = search%done + 1
         associate (row => search%rows(search%done))
            call look_near(samples, search, row, x, values, jump, outer)
            if (max(-x(1), x(3)) > widest .or. jump == on_both_sides) cycle
            call start_minimum(search%now, samples%angle(row) + x, values, search%worth*search%extent, most_halvings, jump, &
               & outer + [samples%angle(row), 0.0_wp])
         end associate
         search%is_wanted = search%now%is_wanted .and. may_gain(search)
         search%trial = search%now%trial
         if (search%is_wanted) return
         call leave_row(search)
      end do
      search%left = search%value - min(search%value, search%bound)
   end subroutine enter_row

   !> May there be a value near the present row that is lower than the extreme so far by more than what is not worth a value?
   pure function may_gain(search)
      type(search_t), intent(in) :: search
      logical :: may_gain

      may_gain = search%now%value(2) - search%now%left < search%value - search%worth*search%extent
   end function may_gain

   !> Take what was found near a row.
   pure subroutine leave_row(search)
      type(search_t), intent(inout) :: search

      search%bound = min(search%bound, search%now%value(2) - search%now%left)
      if (search%now%value(2) >= search%value) return
      search%value = search%now%value(2)
      search%point = search%now%point(2)
      search%is_exact = .false.
   end subroutine leave_row

end module camroller_sampled_extremes
