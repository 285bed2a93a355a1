!> Smallest and largest values of the series of a cycle, between the angles at which they were sampled as well.
!>
!> Layer: solver. In: rows of series at cam angles, in any order. Out: for each series its smallest and largest value, and before that
!> the angles at which rows are wanted: where the parabola through the lowest or highest row and its neighbours has its vertex. A
!> value counts only where a row has it, so that an extreme is never outside what the series takes.
module camroller_extremes
   use camroller_kinds, only : wp, pi, two_pi
   implicit none
   private

   public :: samples_t, start_samples, add_sample, next_sample, smallest_of, largest_of

   !> Sectors of a turn by which rows are found
   integer, parameter :: sectors = 720

   !> Rows of series over one turn
   type :: samples_t
      !> Number of rows
      integer :: count = 0
      !> Cam angle of each row, within one turn [rad]
      real(wp), allocatable :: angle(:)
      !> Values, shape (series, row) [unit of the series]
      real(wp), allocatable :: values(:, :)
      !> Rows with the smallest and the largest value of each series
      integer, allocatable, private :: lowest(:), highest(:)
      !> Rows by their angles: the last row of each sector of the turn, and for each row the one before it in its sector; 0 for none
      integer, private :: last(0:sectors - 1) = 0
      integer, allocatable, private :: before(:)
      !> Extreme that is being refined: series twice over, smallest before largest; and rows asked for it
      integer, private :: extreme = 1, tries = 0
   end type samples_t

   !> Rows that are asked for each extreme at most
   integer, parameter :: most_tries = 3
   !> Gain of an extreme over the range of its series that is worth a row [-]
   real(wp), parameter :: worth_a_row = 1.0e-7_wp
   !> Widest distance to a neighbour that a parabola may bridge, in sectors
   integer, parameter :: widest = 10
   !> Rows for which there is room at first
   integer, parameter :: first_room = 1536

contains

   !> No rows yet.
   pure subroutine start_samples(samples, series)
      !> The rows
      type(samples_t), intent(out) :: samples
      !> Number of series
      integer, intent(in) :: series

      allocate (samples%angle(first_room), samples%values(series, first_room), samples%before(first_room))
      allocate (samples%lowest(series), samples%highest(series))
      samples%lowest = 1
      samples%highest = 1
   end subroutine start_samples

   !> Add a row.
   pure subroutine add_sample(samples, angle, values)
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> Cam angle, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Value of each series [unit of the series]
      real(wp), intent(in) :: values(:)

      integer :: row, sector, i

      if (samples%count == size(samples%angle)) call make_room(samples)
      row = samples%count + 1
      samples%count = row
      samples%angle(row) = modulo(angle, two_pi)
      samples%values(:, row) = values
      sector = sector_of(samples%angle(row))
      samples%before(row) = samples%last(sector)
      samples%last(sector) = row
      do i = 1, size(values)
         if (values(i) < samples%values(i, samples%lowest(i))) samples%lowest(i) = row
         if (values(i) > samples%values(i, samples%highest(i))) samples%highest(i) = row
      end do
   end subroutine add_sample

   !> Double the room for rows.
   pure subroutine make_room(samples)
      !> The rows
      type(samples_t), intent(inout) :: samples

      ! Longer lists [rad], [unit of the series]
      real(wp), allocatable :: angles(:), rows(:, :)
      integer, allocatable :: before(:)

      associate (n => samples%count)
         allocate (angles(2*n), rows(size(samples%values, 1), 2*n), before(2*n))
         angles(:n) = samples%angle
         rows(:, :n) = samples%values
         before(:n) = samples%before
      end associate
      call move_alloc(angles, samples%angle)
      call move_alloc(rows, samples%values)
      call move_alloc(before, samples%before)
   end subroutine make_room

   !> Sector of the turn that an angle is in.
   pure function sector_of(angle) result(sector)
      !> Cam angle within one turn [rad]
      real(wp), intent(in) :: angle
      !> The sector, from 0
      integer :: sector

      sector = min(int(angle/two_pi*sectors), sectors - 1)
   end function sector_of

   !> The next angle at which a row may lower or raise an extreme.
   pure subroutine next_sample(samples, angle, is_wanted)
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> The angle [rad]
      real(wp), intent(out) :: angle
      !> Is a row wanted?
      logical, intent(out) :: is_wanted

      do while (samples%extreme <= 2*size(samples%values, 1))
         call try_extreme(samples, angle, is_wanted)
         samples%tries = samples%tries + 1
         if (is_wanted) return
         samples%extreme = samples%extreme + 1
         samples%tries = 0
      end do
      angle = 0.0_wp
      is_wanted = .false.
   end subroutine next_sample

   !> Where the extreme in hand may have its place.
   pure subroutine try_extreme(samples, angle, is_wanted)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> The angle [rad]
      real(wp), intent(out) :: angle
      !> Is a row there worth its while?
      logical, intent(out) :: is_wanted

      ! Angles of the extreme row and its neighbours, from that row [rad]; values there, the extreme one lowest
      ! [unit of the series]; slopes away from it [unit of the series/rad]; range [unit of the series]
      real(wp) :: x(3), f(3), slopes(2), range
      integer :: rows(3), series

      angle = 0.0_wp
      is_wanted = .false.
      if (samples%tries == most_tries) return
      series = (samples%extreme + 1)/2
      range = samples%values(series, samples%highest(series)) - samples%values(series, samples%lowest(series))
      rows(2) = samples%lowest(series)
      if (modulo(samples%extreme, 2) == 0) rows(2) = samples%highest(series)
      call find_neighbours(samples, rows, x)
      if (any(rows == 0)) return
      f = samples%values(series, rows)
      if (modulo(samples%extreme, 2) == 0) f = -f
      ! what the parabola loses from its middle point to its vertex
      slopes = [(f(1) - f(2))/(x(2) - x(1)), (f(3) - f(2))/(x(3) - x(2))]
      if (.not. sum(slopes) > 0.0_wp) return
      angle = 0.5_wp*(x(3)*slopes(1) + x(1)*slopes(2))/sum(slopes)
      is_wanted = angle**2*sum(slopes)/(x(3) - x(1)) > worth_a_row*range
      angle = samples%angle(rows(2)) + angle
   end subroutine try_extreme

   !> Rows next to one, on either side and round the turn.
   pure subroutine find_neighbours(samples, rows, x)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> In: the middle one; out: the nearest before and after it as well, 0 where there is none close by
      integer, intent(inout) :: rows(3)
      !> Their angles, from the middle one [rad]
      real(wp), intent(out) :: x(3)

      ! Way from the middle row to another, backwards negative [rad]
      real(wp) :: way
      integer :: distance, side, sector, row

      rows([1, 3]) = 0
      x = [-pi, 0.0_wp, pi]
      do distance = 0, widest
         do side = -1, merge(0, 1, distance == 0), 2
            sector = modulo(sector_of(samples%angle(rows(2))) + side*distance, sectors)
            row = samples%last(sector)
            do while (row > 0)
               way = modulo(samples%angle(row) - samples%angle(rows(2)) + pi, two_pi) - pi
               if (way > 0.0_wp .and. way < x(3)) then
                  x(3) = way
                  rows(3) = row
               else if (way < 0.0_wp .and. way > x(1)) then
                  x(1) = way
                  rows(1) = row
               end if
               row = samples%before(row)
            end do
         end do
         if (all(rows > 0)) return
      end do
   end subroutine find_neighbours

   !> Smallest value of each series.
   pure function smallest_of(samples) result(values)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> One for each series [unit of the series]
      real(wp) :: values(size(samples%values, 1))

      integer :: i

      values = [(samples%values(i, samples%lowest(i)), i=1, size(values))]
   end function smallest_of

   !> Largest value of each series.
   pure function largest_of(samples) result(values)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> One for each series [unit of the series]
      real(wp) :: values(size(samples%values, 1))

      integer :: i

      values = [(samples%values(i, samples%highest(i)), i=1, size(values))]
   end function largest_of

end module camroller_extremes
