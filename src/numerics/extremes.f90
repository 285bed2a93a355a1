!> Smallest and largest values of the series of a cycle, between the angles at which they were sampled as well.
!>
!> In: rows of series at cam angles, in any order. Out: for each series the search for its smallest and largest
!> value near the row that has it, for which the caller evaluates the series. A value counts only where it was evaluated, so that
!> an extreme is never outside what the series takes.
module camroller_extremes
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_extremum, only : extremum_t, start_extremum
   implicit none
   private

   public :: samples_t, start_samples, add_sample, start_search, most_steps

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
      !> Is the row one at which the slope of series jumps?
      logical, allocatable, private :: is_kink(:)
   end type samples_t

   !> Values of an extreme that are asked for at most
   integer, parameter :: most_steps = 8
   !> Gain of an extreme that is not worth a value, over the extent of its series [-]
   real(wp), parameter :: worth = 1.0e-6_wp
   !> Widest distance to a neighbour that a search may begin with, in sectors
   integer, parameter :: widest = 30
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
      allocate (samples%is_kink(first_room))
      allocate (samples%lowest(series), samples%highest(series))
      samples%lowest = 1
      samples%highest = 1
   end subroutine start_samples

   !> Add a row.
   pure subroutine add_sample(samples, angle, values, is_kink)
      !> The rows
      type(samples_t), intent(inout) :: samples
      !> Cam angle, of any turn [rad]
      real(wp), intent(in) :: angle
      !> Value of each series [unit of the series]
      real(wp), intent(in) :: values(:)
      !> Does the slope of series jump there?
      logical, intent(in) :: is_kink

      integer :: row, sector, i

      if (samples%count == size(samples%angle)) call make_room(samples)
      row = samples%count + 1
      samples%count = row
      samples%angle(row) = modulo(angle, two_pi)
      samples%values(:, row) = values
      samples%is_kink(row) = is_kink
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
      logical, allocatable :: kinks(:)

      associate (n => samples%count)
         allocate (angles(2*n), rows(size(samples%values, 1), 2*n), before(2*n), kinks(2*n))
         angles(:n) = samples%angle
         rows(:, :n) = samples%values
         before(:n) = samples%before
         kinks(:n) = samples%is_kink
      end associate
      call move_alloc(angles, samples%angle)
      call move_alloc(rows, samples%values)
      call move_alloc(before, samples%before)
      call move_alloc(kinks, samples%is_kink)
   end subroutine make_room

   !> Sector of the turn that an angle is in.
   pure function sector_of(angle) result(sector)
      !> Cam angle within one turn [rad]
      real(wp), intent(in) :: angle
      !> The sector, from 0
      integer :: sector

      sector = min(int(angle/two_pi*sectors), sectors - 1)
   end function sector_of

   !> Begin the search for the smallest or largest value of a series near the row that has it. Each series is searched by itself, so
   !> that what else is sampled changes no bit of it.
   pure subroutine start_search(samples, series, sense, search)
      !> The rows
      type(samples_t), intent(in) :: samples
      !> The series
      integer, intent(in) :: series
      !> 1 for the smallest value, -1 for the largest
      integer, intent(in) :: sense
      !> The search, with the signs of all values changed for the largest; nothing is wanted where the row that has it is a kink or
      !> has no row close by on a side
      type(extremum_t), intent(out) :: search

      ! Angles from that of the extreme row [rad]; extent of the series [unit of the series]
      real(wp) :: x(3), extent
      integer :: rows(3)

      rows = merge(samples%lowest(series), samples%highest(series), sense > 0)
      extent = samples%values(series, samples%highest(series)) - samples%values(series, samples%lowest(series))
      if (.not. samples%is_kink(rows(2))) then
         call find_neighbours(samples, rows, x)
         if (all(rows > 0)) then
            call start_extremum(search, samples%angle(rows(2)) + x, sense*samples%values(series, rows), worth*extent)
            return
         end if
      end if
      search%point(2) = samples%angle(rows(2))
      search%value(2) = sense*samples%values(series, rows(2))
   end subroutine start_search

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

end module camroller_extremes
