!> What bearings of a camshaft take from a whole turn: the temperature of their oil, the orbits of their journals.
!>
!> In: a solved case. Out: the same with these in its shaft, where the case asks for them. Or in: the load on one bearing
!> over the turn, from wherever. Out: its temperature, orbit, and means.
!> The temperature of a bearing's oil is a root of `T = T_supply + rise(T)`. Where an oil film bears, friction falls and the flow of
!> oil rises with the temperature: there is one root, below the rise that would follow at the supply's temperature. Where asperities
!> rub, friction rises with the temperature, and there may be none or several: the lowest, at which oil that warms stays, is looked
!> for upwards from the supply's temperature in steps.
module camroller_bearing_turn
   use camroller_kinds, only : wp
   use camroller_bearing_heat, only : bearing_heat_t, check_bearing_heat, direct_advice, temperature_rise
   use camroller_bearing_means, only : bearing_turn_t, choose_angles, mean_accuracy, mean_of_turn
   use camroller_case, only : case_t
   use camroller_error, only : error_t, raise, kind_deck, kind_domain
   use camroller_journal, only : new_journal
   use camroller_journal_orbit, only : bearing_load_t, find_orbit
   use camroller_lobe_curve, only : curve_values
   use camroller_lubricant, only : density_at, get_oil, law_direct, oil_t, temperature_law_names
   use camroller_number_text, only : number_text
   use camroller_roots, only : bracket_t, narrow_bracket, root_found, root_wanted, start_bracket
   use camroller_shaft, only : bearing_number, cam_at, has_orbits, in_common_frame, needs_turn, refine_curves, shaft_stops, &
      & shaft_t, solved_t
   use camroller_torque_list, only : torque_count
   implicit none
   private

   public :: complete_shaft, find_turn

   !> Load on one bearing of a solved case
   type, extends(bearing_load_t) :: cams_load_t
      type(solved_t), pointer :: solved => null()
      !> Part of each cam's force that the bearing takes [-], and of the pull [N]
      real(wp), allocatable :: shares(:)
      real(wp) :: pull(2) = 0.0_wp
   contains
      procedure :: get_load => load_of_cams
   end type cams_load_t

   !> Largest rise of temperature that is looked for [K]
   real(wp), parameter :: largest_rise = 200.0_wp
   !> Step of the search where asperities may rub: the viscosity of the coldest oil falls by two fifths in it, that of
   !> warm oil by a tenth [K]
   real(wp), parameter :: rise_step = 5.0_wp

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
         call find_temperature(case, shaft, case%bearing_heat, load, turn, error)
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
      type(case_t), intent(in) :: case
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

   !> Temperature of a bearing's oil.
   subroutine find_temperature(case, shaft, heat, load, turn, error)
      type(case_t), intent(in) :: case
      type(shaft_t), intent(in) :: shaft
      !> What is given about heat
      type(bearing_heat_t), intent(in) :: heat
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> Out: with the rise of temperature, the bearing with its oil, the orbit, angles and loads of the means
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      logical :: is_finer ! Are there more pieces than at the temperature before?

      call check_bearing_heat(heat, shaft%bearings, error)
      if (allocated(error)) return
      if (case%lubricant%temperature_law == temperature_law_names(law_direct)) then
         call raise(error, kind_deck, direct_advice)
         return
      end if
      is_finer = .true.
      do while (is_finer)
         call warm_bearing(case, shaft, load, turn, error)
         if (.not. allocated(error)) call choose_angles(case, shaft, load, turn, is_finer, error)
         if (is_finer .and. .not. allocated(error)) call balance_heat(case, shaft, heat, load, turn, error)
         if (allocated(error)) return
      end do
   end subroutine find_temperature

   !> Rise of temperature at which the oil carries the friction of the means away.
   subroutine balance_heat(case, shaft, heat, load, turn, error)
      type(case_t), intent(in) :: case
      type(shaft_t), intent(in) :: shaft
      !> What is given about heat
      type(bearing_heat_t), intent(in) :: heat
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: angles and loads of the means; out: with the rise of temperature
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(bracket_t) :: bracket
      ! Both ends; rise less the one that follows from it, there and between [K]
      real(wp) :: first, last, low, high, miss
      ! Error of the rise allowed [K]
      real(wp) :: tolerance

      tolerance = mean_accuracy(turn)
      call try_rise(0.0_wp, low)
      if (allocated(error)) return
      first = 0.0_wp
      last = min(merge(rise_step, -low, allocated(shaft%touch)), largest_rise)
      call try_rise(last, high)
      do while (.not. allocated(error) .and. high < -tolerance .and. last < largest_rise)
         first = last
         low = high
         last = min(first + rise_step, largest_rise)
         call try_rise(last, high)
      end do
      if (allocated(error)) return
      ! Without a change of friction the rise that follows at the supply's temperature is the root, up to rounding
      if (abs(high) <= tolerance) high = 0.0_wp
      call start_bracket(bracket, first, last, low, high, tolerance)
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

   contains

      !> A rise of temperature less the one that follows from it.
      subroutine try_rise(rise, miss)
         !> The rise, the difference [K]
         real(wp), intent(in) :: rise
         real(wp), intent(out) :: miss

         ! Mean torque [N m], mean flow [m^3/s]
         real(wp) :: torque, flow

         miss = 0.0_wp
         turn%rise = rise
         call warm_bearing(case, shaft, load, turn, error)
         if (.not. allocated(error)) call mean_of_turn(case, shaft, turn, torque, flow, error)
         if (allocated(error)) return
         miss = rise - temperature_rise(heat, density_at(case%lubricant, case%operating_point%oil_temperature), &
            & torque*shaft%speed, flow)
      end subroutine try_rise

   end subroutine balance_heat

   !> The bearing with its oil, and the orbit, at its rise of temperature.
   subroutine warm_bearing(case, shaft, load, turn, error)
      type(case_t), intent(in) :: case
      type(shaft_t), intent(in) :: shaft
      !> What loads the bearing
      class(bearing_load_t), intent(in) :: load
      !> In: the rise; out: with bearing and orbit
      type(bearing_turn_t), intent(inout) :: turn
      !> Convergence, deck or domain error
      type(error_t), allocatable, intent(out) :: error

      type(oil_t) :: oil

      call get_oil(case%lubricant, case%operating_point%oil_temperature + turn%rise, oil, error)
      if (.not. allocated(error)) call new_journal(turn%journal, shaft%bearings, oil%viscosity, shaft%speed, error)
      if (.not. allocated(error)) call follow_journal(case, shaft, load, turn, error)
   end subroutine warm_bearing

end module camroller_bearing_turn
