!> What bearings of a camshaft take from a whole turn: the temperature of their oil, the orbits of their journals.
!>
!> In: a solved case. Out: the same with these in its shaft, where the case asks for them. Or in: the load on one bearing
!> over the turn, from wherever. Out: its temperature, orbit, and means.
!> The temperature of a bearing's oil is a root of `T = T_supply + rise(T)`. Where an oil film bears, friction falls and the flow of
!> oil rises with the temperature: there is one root, below the rise that would follow at the supply's temperature. Where asperities
!> rub, friction rises with the temperature, and the root lies higher: it is looked for upwards, in steps of twice what is missing.
module camroller_bearing_turn
   use camroller_kinds, only : wp, degree, two_pi
   use camroller_bearing_asperity, only : bearing_state_t, carry_load
   use camroller_bearing_heat, only : bearing_heat_t, check_bearing_heat, direct_advice, oil_flow, temperature_rise
   use camroller_case, only : case_t
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_journal, only : journal_solved, journal_t, new_journal
   use camroller_journal_motion, only : moving_state
   use camroller_journal_orbit, only : bearing_load_t, find_orbit, orbit_t, place_at
   use camroller_lobe_curve, only : curve_values
   use camroller_lubricant, only : density_at, get_oil, law_direct, oil_t, temperature_law_names
   use camroller_number_text, only : number_text
   use camroller_quadrature, only : gauss_legendre
   use camroller_roots, only : bracket_t, narrow_bracket, root_found, root_wanted, start_bracket
   use camroller_shaft, only : bearing_number, cam_at, has_orbits, in_common_frame, needs_turn, refine_curves, shaft_stops, &
      & shaft_t, solved_t
   use camroller_torque_list, only : torque_count
   implicit none
   private

   public :: bearing_turn_t, complete_shaft, find_turn, mean_of_turn, sample_load

   !> Load on one bearing of a solved case
   type, extends(bearing_load_t) :: cams_load_t
      type(solved_t), pointer :: solved => null()
      !> Part of each cam's force that the bearing takes [-], and of the pull [N]
      real(wp), allocatable :: shares(:)
      real(wp) :: pull(2) = 0.0_wp
   contains
      procedure :: get_load => load_of_cams
   end type cams_load_t

   !> One bearing over the turn
   type :: bearing_turn_t
      !> Start, stops and end of the turn [rad]
      real(wp), allocatable :: stops(:)
      !> Sense in which the shaft turns, 1 from the first axis of the load to the second, or -1 [-]
      real(wp) :: rotation = 1.0_wp
      !> Error of an orbit allowed in a step, over the smallest film of the turn [-]; error of the rise of temperature [K]
      real(wp) :: accuracy = 0.0_wp, rise_tolerance = 1.0e-7_wp
      !> The longest piece of the turn in a mean [rad]
      real(wp) :: longest_piece = 5.0_wp*degree
      !> Angles [rad] and their weights in a mean [-], load there, shape (2, angle) [N]; allocated once they are sampled
      real(wp), allocatable :: angles(:), weights(:), loads(:, :)
      !> The bearing with its oil
      type(journal_t) :: journal
      !> Rise of the oil's temperature [K]
      real(wp) :: rise = 0.0_wp
      type(orbit_t) :: orbit
   end type bearing_turn_t

   !> Places of a mean in each piece of the turn
   integer, parameter :: places_of_piece = 4
   !> Largest rise of temperature that is looked for [K]
   real(wp), parameter :: largest_rise = 200.0_wp

contains

   !> Make what follows from the cycles ready: curves of the lobe shapes, and where the case asks for them temperatures and orbits.
   subroutine complete_shaft(solved, error)
      !> The solved case
      type(solved_t), intent(inout), target :: solved
      !> Convergence error; deck or domain error where a bearing has no temperature
      type(error_t), allocatable, intent(out) :: error

      type(bearing_turn_t), allocatable :: turns(:, :)
      type(cams_load_t) :: load
      integer :: bearing, k

      call refine_curves(solved, error)
      if (allocated(error) .or. .not. needs_turn(solved%case)) return
      allocate (turns(bearing_number(solved%shaft), solved%shaft%count))
      do k = 1, size(turns, 2)
         do bearing = 1, size(turns, 1)
            call set_load(solved, bearing, k, load)
            associate (turn => turns(bearing, k))
               turn%stops = shaft_stops(solved, abs(load%shares) > 0.0_wp)
               ! A cam turns against the sense in which the finger's frame counts where its surface moves away from the pivot
               turn%rotation = -solved%models(1)%linkage%sense
               turn%accuracy = maxval(solved%cycles%tolerance)
               call find_turn(solved%case, solved%shaft, load, turn, error)
            end associate
            if (allocated(error)) return
         end do
      end do
      if (has_orbits(solved%case)) solved%shaft%orbits = turns%orbit
      if (.not. allocated(solved%case%bearing_heat)) return
      solved%shaft%warm = turns%journal
      solved%shaft%rises = turns%rise
   end subroutine complete_shaft

   !> Find temperature and orbit of one bearing, where the case asks for them.
   subroutine find_turn(case, shaft, load, turn, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: stops, rotation and what may be off; out: with the bearing, its oil and orbit
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      turn%journal = shaft%journal
      if (allocated(case%bearing_heat)) then
         if (.not. allocated(turn%angles)) call sample_load(load, turn, error)
         if (.not. allocated(error)) call find_temperature(case, shaft, case%bearing_heat, load, turn, error)
      else
         call follow_journal(case, shaft, load, turn, error)
      end if
   end subroutine find_turn

   !> What loads a bearing.
   subroutine set_load(solved, bearing, k, load)
      !> The solved case
      type(solved_t), intent(in), target :: solved
      !> Bearing and camshaft
      integer, intent(in) :: bearing, k
      !> The load
      type(cams_load_t), intent(out) :: load

      load%solved => solved
      associate (shaft => solved%shaft)
         load%shares = merge(shaft%shares(bearing, :), 0.0_wp, shaft%shafts == k)
         load%pull = shaft%pull(:, bearing)
      end associate
   end subroutine set_load

   !> Force of the shaft on one bearing.
   subroutine load_of_cams(self, angle, load, status)
      !> What loads it
      class(cams_load_t), intent(in) :: self
      !> Cam angle of the first cam from full lift [rad]
      real(wp), intent(in) :: angle
      !> The force [N]
      real(wp), intent(out) :: load(2)
      !> 0 fine, other: it cannot be found
      integer, intent(out) :: status

      type(error_t), allocatable :: error
      ! Torques and force of a cam [N m, N]
      real(wp) :: values(curve_values)
      integer :: cam

      status = 0
      load = self%pull
      do cam = 1, size(self%shares)
         if (.not. abs(self%shares(cam)) > 0.0_wp) cycle
         call cam_at(self%solved, cam, angle, values, error)
         if (allocated(error)) then
            status = 1
            return
         end if
         load = load + self%shares(cam)*in_common_frame(self%solved%shaft, cam, values(torque_count + 1:))
      end do
   end subroutine load_of_cams

   !> Orbit of a bearing's journal, where the case has such.
   subroutine follow_journal(case, shaft, load, turn, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: the bearing with its oil; out: with the orbit
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error

      if (has_orbits(case)) call find_orbit(turn%journal, turn%rotation, load, turn%stops, turn%accuracy, turn%orbit, error, &
         & shaft%touch)
   end subroutine follow_journal

   !> Take the load at the angles of a mean: Gauss' rule in pieces between the stops.
   subroutine sample_load(load, turn, error)
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: stops; out: with angles, weights and loads
      type(bearing_turn_t), intent(inout) :: turn
      !> Domain error
      type(error_t), allocatable, intent(out) :: error

      ! Places and weights in a piece, from -1 to 1 [-]; half the length of a piece [rad]
      real(wp) :: places(places_of_piece), weights(places_of_piece), half
      integer :: i, n, pieces, status

      call gauss_legendre(places, weights)
      allocate (turn%angles(0), turn%weights(0))
      do i = 1, size(turn%stops) - 1
         pieces = ceiling((turn%stops(i + 1) - turn%stops(i))/turn%longest_piece)
         if (pieces == 0) cycle
         half = 0.5_wp*(turn%stops(i + 1) - turn%stops(i))/pieces
         do n = 1, pieces
            turn%angles = [turn%angles, turn%stops(i) + half*(2*n - 1 + places)]
            turn%weights = [turn%weights, half/two_pi*weights]
         end do
      end do
      allocate (turn%loads(2, size(turn%angles)))
      do i = 1, size(turn%angles)
         call load%get_load(turn%angles(i), turn%loads(:, i), status)
         if (status /= 0) then
            call raise(error, kind_domain, "camshaft bearings: the load has no value at some angle of the turn")
            return
         end if
      end do
   end subroutine sample_load

   !> Temperature of a bearing's oil.
   subroutine find_temperature(case, shaft, heat, load, turn, error)
      !> The case
      type(case_t), intent(in) :: case
      !> The shaft
      type(shaft_t), intent(in) :: shaft
      !> What is given about heat
      type(bearing_heat_t), intent(in) :: heat
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: loads; out: with the rise of temperature, the bearing with its oil, the orbit
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      ! Both ends; rise less the one that follows from it, there and between [K]
      real(wp) :: first, last, low, high, miss

      call check_bearing_heat(heat, shaft%bearings, error)
      if (allocated(error)) return
      if (case%lubricant%temperature_law == temperature_law_names(law_direct)) then
         call raise(error, kind_deck, direct_advice)
         return
      end if
      call try_rise(0.0_wp, low)
      if (allocated(error)) return
      first = 0.0_wp
      last = min(-low, largest_rise)
      call try_rise(last, high)
      do while (.not. allocated(error) .and. high < -turn%rise_tolerance .and. last < largest_rise)
         first = last
         low = high
         last = min(first + 2.0_wp*min(-low, largest_rise), largest_rise)
         call try_rise(last, high)
      end do
      if (allocated(error)) return
      ! Without a change of friction the rise that follows at the supply's temperature is the root, up to rounding
      if (abs(high) <= turn%rise_tolerance) high = 0.0_wp
      call start_bracket(bracket, first, last, low, high, turn%rise_tolerance)
      do while (bracket%status == root_wanted)
         call try_rise(bracket%trial, miss)
         if (allocated(error)) return
         call narrow_bracket(bracket, miss)
      end do
      if (bracket%status /= root_found) then
         call raise(error, kind_domain, "the oil of a camshaft bearing would be more than "// &
            & number_text(largest_rise)//" K warmer than its supply: "// &
            & "hardly any leaves a bearing that bears so little, or asperities rub the more the warmer it is; lower "// &
            & "bearing_heat.oil_share, or leave &bearing_heat out")
         return
      end if
      turn%rise = bracket%trial
      call warm_bearing(turn%rise)

   contains

      !> A rise of temperature less the one that follows from it.
      subroutine try_rise(rise, miss)
         !> The rise, the difference [K]
         real(wp), intent(in) :: rise
         real(wp), intent(out) :: miss

         ! Mean torque [N m], mean flow [m^3/s]
         real(wp) :: torque, flow

         miss = 0.0_wp
         call warm_bearing(rise)
         if (.not. allocated(error)) call mean_of_turn(case, shaft, turn, torque, flow, error)
         if (allocated(error)) return
         miss = rise - temperature_rise(heat, density_at(case%lubricant, case%operating_point%oil_temperature), &
            & torque*shaft%speed, flow)
      end subroutine try_rise

      !> The bearing with its oil, and the orbit, at a rise of temperature.
      subroutine warm_bearing(rise)
         !> The rise [K]
         real(wp), intent(in) :: rise

         type(oil_t) :: oil

         call get_oil(case%lubricant, case%operating_point%oil_temperature + rise, oil, error)
         if (.not. allocated(error)) call new_journal(turn%journal, shaft%bearings, oil%viscosity, shaft%speed, error)
         if (.not. allocated(error)) call follow_journal(case, shaft, load, turn, error)
      end subroutine warm_bearing

   end subroutine find_temperature

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

      type(bearing_state_t) :: state
      ! Place of the journal [clearance]
      real(wp) :: place(2)
      integer :: i, status, hint

      torque = 0.0_wp
      flow = 0.0_wp
      hint = 1
      status = journal_solved
      do i = 1, size(turn%angles)
         if (has_orbits(case)) then
            call place_at(turn%orbit, turn%angles(i), hint, place)
            call moving_state(turn%journal, place, turn%loads(:, i), state, shaft%touch)
         else
            call carry_load(turn%journal, turn%loads(:, i), state, status, shaft%touch)
         end if
         if (status /= journal_solved) then
            call raise(error, kind_domain, "camshaft bearings: the bearing law has no solution for a load of the turn")
            return
         end if
         torque = torque + turn%weights(i)*state%torque
         flow = flow + turn%weights(i)*oil_flow(turn%journal, shaft%speed, state%eccentricity)
      end do
   end subroutine mean_of_turn

end module camroller_bearing_turn
