!> Mean torque of a bearing of the camshaft over a turn, and the mean flow of its oil.
!>
!> In: what loads the bearing, its oil, its orbit where it has one, the stops of the turn. Out: both means, as good as asked for.
!> The angles follow from the bearing at one temperature and serve for others near it: loads are then not found again.
module camroller_bearing_means
   use camroller_kinds, only : wp, degree, two_pi
   use camroller_accuracy, only : quadrature_part
   use camroller_bearing_asperity, only : bearing_state_t, carry_load
   use camroller_bearing_heat, only : oil_flow
   use camroller_case, only : case_t
   use camroller_error, only : error_t, raise, kind_domain
   use camroller_journal, only : journal_solved, journal_t
   use camroller_journal_motion, only : moving_state
   use camroller_journal_orbit, only : bearing_load_t, orbit_t, place_at
   use camroller_panels, only : panel_places, panel_weights, panels_t, refine_panels, sample_panel, sampled_t, &
      & start_panels, total_of
   use camroller_shaft, only : has_orbits, shaft_t
   implicit none
   private

   public :: bearing_turn_t, choose_angles, mean_accuracy, mean_of_turn

   !> One bearing over the turn
   type :: bearing_turn_t
      !> Start, stops and end of the turn [rad]
      real(wp), allocatable :: stops(:)
      !> Sense in which the shaft turns, 1 from the first axis of the load to the second, or -1 [-]
      real(wp) :: rotation = 1.0_wp
      !> Error allowed of an orbit in a step, over the smallest film of the turn [-]
      real(wp) :: accuracy = 0.0_wp
      !> Ends of the pieces of the turn in a mean, shape (end, piece) [rad]; allocated once they are chosen
      real(wp), allocatable :: ends(:, :)
      !> Angles [rad] and their weights in a mean [-], load there, shape (2, angle) [N]
      real(wp), allocatable :: angles(:), weights(:), loads(:, :)
      !> The bearing with its oil
      type(journal_t) :: journal
      !> Rise of the oil's temperature [K]
      real(wp) :: rise = 0.0_wp
      type(orbit_t) :: orbit
   end type bearing_turn_t

   !> Torque and flow of oil of one bearing over the turn
   type, extends(sampled_t) :: bearing_means_t
      type(shaft_t), pointer :: shaft => null()
      class(bearing_load_t), pointer :: load => null()
      type(bearing_turn_t), pointer :: turn => null()
      !> Does its journal move on an orbit?
      logical :: on_orbit = .false.
   contains
      procedure :: sample => sample_bearing
   end type bearing_means_t

   !> The longest piece of the turn in a mean at first [rad]
   real(wp), parameter :: longest_piece = 30.0_wp*degree
   !> Halvings of such pieces, at most
   integer, parameter :: most_halvings = 1000
   !> Least error aimed at, of a mean over the mean and of a rise over a kelvin: below it rounding counts [-]
   real(wp), parameter :: least_error = 1.0e-10_wp
   !> What to say where a load cannot be found
   character(len=*), parameter :: no_load = "camshaft bearings: the load has no value at some angle of the turn"

contains

   !> Choose the angles at which means are taken: seven in each piece of the turn, and pieces halved until the means of torque and
   !> flow with the bearing's present oil and orbit are as good as asked for. A bearing that has pieces already keeps them.
   subroutine choose_angles(case, shaft, load, turn, is_finer, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The shaft
      type(shaft_t), intent(in), target :: shaft
      !> What loads the bearing
      class(bearing_load_t), intent(in), target :: load
      !> In: the bearing; out: with angles, weights and loads
      type(bearing_turn_t), intent(inout), target :: turn
      !> Are there more pieces than before, or the first ones?
      logical, intent(out) :: is_finer
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      type(bearing_means_t) :: means
      type(panels_t) :: panels
      ! Errors allowed of the integrals of torque and flow [N m rad, m^3 rad/s]; ends of the pieces [rad]
      real(wp) :: allowed(2)
      real(wp), allocatable :: ends(:, :)
      integer :: piece, halvings

      is_finer = .false.
      means%shaft => shaft
      means%load => load
      means%turn => turn
      means%on_orbit = has_orbits(case)
      if (allocated(turn%ends)) then
         ends = turn%ends
      else
         ends = pieces_between(turn%stops)
      end if
      call start_panels(panels, size(allowed), size(ends, 2))
      do piece = 1, size(ends, 2)
         call sample_panel(panels, means, ends(1, piece), ends(2, piece), error)
         if (allocated(error)) return
      end do
      allowed = max(mean_accuracy(turn)*total_of(panels%sizes(:, :panels%count)), tiny(1.0_wp))
      halvings = most_halvings
      call refine_panels(panels, means, allowed, halvings, error)
      if (allocated(error)) return
      is_finer = panels%count > size(ends, 2) .or. .not. allocated(turn%ends)
      if (.not. is_finer) return
      turn%ends = reshape([panels%left(:panels%count), panels%right(:panels%count)], [2, panels%count], order=[2, 1])
      call take_loads(load, turn, error)
   end subroutine choose_angles

   !> Error allowed: of means of torque and flow, over the means; of the rise of temperature, over a kelvin, which changes viscosity
   !> and torque by some per cent.
   pure function mean_accuracy(turn) result(error)
      !> The bearing
      type(bearing_turn_t), intent(in) :: turn
      !> The error [-]
      real(wp) :: error

      error = max(quadrature_part*turn%accuracy, least_error)
   end function mean_accuracy

   !> Pieces of the turn between its stops, none longer than the longest.
   pure function pieces_between(stops) result(ends)
      !> The stops, increasing [rad]
      real(wp), intent(in) :: stops(:)
      !> Both ends of each piece, shape (end, piece) [rad]
      real(wp), allocatable :: ends(:, :)

      ! Number of pieces between a stop and the next
      integer :: pieces(size(stops) - 1)
      integer :: i, n, first

      pieces = ceiling((stops(2:) - stops(:size(stops) - 1))/longest_piece)
      allocate (ends(2, sum(pieces)))
      first = 0
      do i = 1, size(pieces)
         do n = 1, pieces(i)
            ends(:, first + n) = stops(i) + [n - 1, n]*(stops(i + 1) - stops(i))/pieces(i)
         end do
         first = first + pieces(i)
      end do
   end function pieces_between

   !> Take the load at the angles of the means.
   subroutine take_loads(load, turn, error)
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: pieces; out: with angles, weights and loads
      type(bearing_turn_t), intent(inout) :: turn
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      integer :: pieces, i, piece, status

      pieces = size(turn%ends, 2)
      turn%angles = [(turn%ends(1, piece) + panel_places*(turn%ends(2, piece) - turn%ends(1, piece)), piece=1, pieces)]
      turn%weights = [(panel_weights*(turn%ends(2, piece) - turn%ends(1, piece))/two_pi, piece=1, pieces)]
      if (allocated(turn%loads)) deallocate (turn%loads)
      allocate (turn%loads(2, size(turn%angles)))
      do i = 1, size(turn%angles)
         call load%get_load(turn%angles(i), turn%loads(:, i), status)
         if (status /= 0) then
            call raise(error, kind_domain, no_load)
            return
         end if
      end do
   end subroutine take_loads

   !> Torque and flow of oil of a bearing at a cam angle.
   subroutine sample_bearing(self, x, values, error)
      class(bearing_means_t), intent(inout) :: self
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: x
      !> Torque [N m], flow [m^3/s]
      real(wp), intent(out), contiguous :: values(:)
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      real(wp) :: load(2) ! Force of the shaft [N]
      integer :: status, hint

      call self%load%get_load(x, load, status)
      if (status /= 0) then
         call raise(error, kind_domain, no_load)
         return
      end if
      hint = 1
      call find_losses(self%shaft, self%turn, self%on_orbit, x, load, hint, values(1), values(2), error)
   end subroutine sample_bearing

   !> Torque and flow of oil of a bearing under a load.
   subroutine find_losses(shaft, turn, on_orbit, angle, load, hint, torque, flow, error)
      type(shaft_t), intent(in) :: shaft
      !> The bearing with its oil and orbit
      type(bearing_turn_t), intent(in) :: turn
      !> Does its journal move on an orbit?
      logical, intent(in) :: on_orbit
      !> Cam angle of the first cam from full lift [rad], force of the shaft [N]
      real(wp), intent(in) :: angle, load(2)
      !> Where the search on the orbit starts; out: where it ended
      integer, intent(inout) :: hint
      !> Torque [N m], flow of oil [m^3/s]
      real(wp), intent(out) :: torque, flow
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      type(bearing_state_t) :: state
      real(wp) :: place(2) ! Place of the journal [clearance]
      integer :: status

      status = journal_solved
      if (on_orbit) then
         call place_at(turn%orbit, angle, hint, place)
         call moving_state(turn%journal, place, load, state, shaft%touch)
      else
         call carry_load(turn%journal, load, state, status, shaft%touch)
      end if
      torque = state%torque
      flow = oil_flow(turn%journal, shaft%speed, state%eccentricity)
      if (status /= journal_solved) call raise(error, kind_domain, "camshaft bearings: the bearing law has no solution for "// &
         & "a load of the turn")
   end subroutine find_losses

   !> Means of a bearing over the turn.
   subroutine mean_of_turn(case, shaft, turn, torque, flow, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> The bearing with its loads and orbit
      type(bearing_turn_t), intent(in) :: turn
      !> Mean torque [N m], mean flow of oil [m^3/s]
      real(wp), intent(out) :: torque, flow
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      ! Those at an angle [N m], [m^3/s]
      real(wp) :: torque_there, flow_there
      integer :: i, hint

      torque = 0.0_wp
      flow = 0.0_wp
      hint = 1
      do i = 1, size(turn%angles)
         call find_losses(shaft, turn, has_orbits(case), turn%angles(i), turn%loads(:, i), hint, torque_there, flow_there, error)
         if (allocated(error)) return
         torque = torque + turn%weights(i)*torque_there
         flow = flow + turn%weights(i)*flow_there
      end do
   end subroutine mean_of_turn

end module camroller_bearing_means
