!> The orbit of a journal in its bearing over a turn of the shaft, periodic.
!>
!> In: a bearing, the load on it at any angle. Out: the path of the journal. Turns are integrated one after the other until one ends
!> where it began. Where turns approach it slowly, as those of a lightly loaded journal do, which whirls at half the shaft's speed,
!> the next one starts at the zero of the line through the last three starts and ends (secant method in two unknowns).
module camroller_journal_orbit
   use camroller_kinds, only : wp, two_pi
   use camroller_bearing_asperity, only : bearing_state_t, carry_load, bearing_touch_t
   use camroller_cam_angle, only : cam_angle_text
   use camroller_error, only : error_t, raise, kind_convergence
   use camroller_journal, only : film_at, film_t, journal_solved, journal_t
   use camroller_journal_motion, only : journal_velocity
   use camroller_number_text, only : integer_text
   use camroller_ode, only : counters_t, integrate, method_t, options_t, problem_t
   use camroller_ode_methods, only : new_method
   use camroller_ode_problem, only : words_length
   use camroller_trajectory, only : interpolate_state, trajectory_t
   implicit none
   private

   public :: orbit_t, bearing_load_t, find_orbit, place_at

   !> Load on a bearing over the turn
   type, abstract :: bearing_load_t
   contains
      procedure(load_interface), deferred :: get_load
   end type bearing_load_t

   abstract interface
      !> Force of the shaft on the bearing
      subroutine load_interface(self, angle, load, status)
         import :: bearing_load_t, wp
         !> What loads the bearing
         class(bearing_load_t), intent(in) :: self
         !> Angle of the shaft [rad]
         real(wp), intent(in) :: angle
         !> The force [N]
         real(wp), intent(out) :: load(2)
         !> 0 fine, other: it cannot be found
         integer, intent(out) :: status
      end subroutine load_interface
   end interface

   !> The path of a journal
   type :: orbit_t
      !> Angle where the turn starts [rad]
      real(wp) :: start = 0.0_wp
      !> Place over the angle [clearance]
      type(trajectory_t) :: path
      !> Turns integrated
      integer :: turns = 0
      !> Work done
      type(counters_t) :: counters
   end type orbit_t

   !> A journal under its load; the state is its place [clearance], time the angle [rad]
   type, extends(problem_t) :: orbit_problem_t
      type(journal_t) :: journal
      type(bearing_touch_t), allocatable :: touch
      !> Sense in which the shaft turns [-]
      real(wp) :: rotation = 1.0_wp
      class(bearing_load_t), pointer :: load => null()
   contains
      procedure :: get_rate => orbit_rate
      procedure :: name_time => name_orbit_angle
   end type orbit_problem_t

   !> Method: journals in thin films are stiff
   character(len=*), parameter :: method_name = "radau5"
   !> Turns at most
   integer, parameter :: most_turns = 200
   !> Part of the distance of the turn before that is left, above which turns approach slowly [-]
   real(wp), parameter :: slow = 0.2_wp
   !> Largest eccentricity that a turn starts with [-]
   real(wp), parameter :: largest_start = 0.999_wp
   !> Distance of a turn's end from its start that is near enough, over the error allowed in a step [-]
   real(wp), parameter :: near_enough = 5.0_wp

contains

   !> Find the orbit of a journal.
   !>
   !> Convergence error where the integration fails or turns do not repeat themselves.
   subroutine find_orbit(journal, rotation, load, stops, accuracy, orbit, error, touch)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Sense in which the shaft turns, 1 from the first axis of the load to the second, or -1 [-]
      real(wp), intent(in) :: rotation
      !> What loads it
      class(bearing_load_t), intent(in), target :: load
      !> Start of the turn, angles where the load may have kinks, end of the turn [rad]
      real(wp), intent(in) :: stops(:)
      !> Error allowed in a step, over the smallest film of the turn [-]
      real(wp), intent(in) :: accuracy
      !> The orbit
      type(orbit_t), intent(out) :: orbit
      !> Convergence error
      type(error_t), allocatable, intent(out) :: error
      !> Surfaces of the bearing; without them there is a film only
      type(bearing_touch_t), intent(in), optional :: touch

      type(orbit_problem_t) :: problem
      type(options_t) :: options
      class(method_t), allocatable :: method
      ! Starts of the last turns and what their ends are away from them, the newest first [clearance]
      real(wp) :: starts(2, 3), misses(2, 3)
      ! Place [clearance]; tolerance that the smallest film asks for, distance of end from start, that of the turn before
      ! [clearance]
      real(wp) :: place(2), wanted, distance, last_distance
      integer :: kept, i

      problem%journal = journal
      if (present(touch)) problem%touch = touch
      problem%rotation = rotation
      problem%load => load
      orbit%start = stops(1)
      call new_method(method, method_name, 2, error)
      if (allocated(error)) return
      call start_place(problem, orbit%start, place)
      options%tolerance = accuracy*(1.0_wp - norm2(place))*[1.0_wp, 1.0_wp]
      kept = 0
      last_distance = huge(1.0_wp)
      do while (orbit%turns < most_turns)
         starts(:, 2:) = starts(:, :2)
         misses(:, 2:) = misses(:, :2)
         starts(:, 1) = place
         options%max_steps = 100000 + orbit%counters%accepted + orbit%counters%rejected
         call integrate(problem, method, options, stops, place, orbit%path, orbit%counters, error)
         if (allocated(error)) return
         orbit%turns = orbit%turns + 1
         misses(:, 1) = place - starts(:, 1)
         kept = min(kept + 1, 3)
         distance = norm2(misses(:, 1))
         wanted = accuracy*minval([(1.0_wp - norm2(orbit%path%state(:, i)), i=1, orbit%path%count)])
         if (distance <= near_enough*wanted .and. options%tolerance(1) <= 2.0_wp*wanted) return
         options%tolerance = wanted
         if (distance > slow*last_distance .and. kept == 3) call follow_secant(starts, misses, place, kept)
         last_distance = distance
      end do
      call raise(error, kind_convergence, "the orbit of a camshaft bearing's journal has not closed after "// &
         & integer_text(most_turns)//" turns")
   end subroutine find_orbit

   !> Where the first turn starts: where a steady load would hold the journal, but not too close to the bearing.
   subroutine start_place(problem, angle, place)
      !> The journal
      type(orbit_problem_t), intent(in) :: problem
      !> Angle of the shaft [rad]
      real(wp), intent(in) :: angle
      !> Place [clearance]
      real(wp), intent(out) :: place(2)

      type(bearing_state_t) :: state
      type(film_t) :: film
      ! Load [N], angle of the place from it [rad]
      real(wp) :: load(2), attitude
      integer :: status

      place = 0.0_wp
      call problem%load%get_load(angle, load, status)
      if (status /= 0) return
      call carry_load(problem%journal, load, state, status, problem%touch)
      if (status /= journal_solved .or. .not. state%eccentricity > 0.0_wp) return
      film = film_at(problem%journal, state%eccentricity/sqrt((1.0_wp - state%eccentricity)*(1.0_wp + state%eccentricity) &
         & + tiny(1.0_wp)))
      attitude = problem%rotation*film%angle
      place = min(state%eccentricity, largest_start)/norm2(load)*[cos(attitude)*load(1) - sin(attitude)*load(2), &
         & sin(attitude)*load(1) + cos(attitude)*load(2)]
   end subroutine start_place

   !> Start of the next turn by the last three, where that is a place for a journal.
   pure subroutine follow_secant(starts, misses, place, kept)
      !> Starts and what their ends are away from them, the newest first [clearance]
      real(wp), intent(in) :: starts(2, 3), misses(2, 3)
      !> In: end of the last turn; out: start of the next [clearance]
      real(wp), intent(inout) :: place(2)
      !> Turns that the next line may go through; none older where the place was not one for a journal
      integer, intent(inout) :: kept

      ! Changes of misses and of starts, their weights [clearance, -]; start of the next turn [clearance]
      real(wp) :: change(2, 2), moved(2, 2), weights(2), next(2)
      ! Determinant, its size where the changes are at right angles [clearance^2]
      real(wp) :: determinant, size_of

      change = misses(:, 1:2) - misses(:, 2:3)
      moved = starts(:, 1:2) - starts(:, 2:3)
      determinant = change(1, 1)*change(2, 2) - change(1, 2)*change(2, 1)
      size_of = norm2(change(:, 1))*norm2(change(:, 2))
      if (.not. abs(determinant) > 1.0e-6_wp*size_of) return
      weights = [change(2, 2)*misses(1, 1) - change(1, 2)*misses(2, 1), change(1, 1)*misses(2, 1) - change(2, 1)*misses(1, 1)] &
         & /determinant
      next = starts(:, 1) - matmul(moved, weights)
      if (norm2(next) < largest_start) then
         place = next
      else
         kept = 1
      end if
   end subroutine follow_secant

   !> Place of the journal at an angle of the shaft.
   pure subroutine place_at(orbit, angle, hint, place)
      !> The orbit
      type(orbit_t), intent(in) :: orbit
      !> Angle of the shaft, any turn [rad]
      real(wp), intent(in) :: angle
      !> Interval where the search starts; out: interval that holds the angle
      integer, intent(inout) :: hint
      !> Place [clearance]
      real(wp), intent(out) :: place(2)

      ! Angle within the turn [rad]
      real(wp) :: inside

      inside = orbit%start + modulo(angle - orbit%start, two_pi)
      associate (path => orbit%path)
         call interpolate_state(path, min(max(inside, path%time(1)), path%time(path%count)), hint, place)
      end associate
   end subroutine place_at

   !> Velocity of the journal.
   subroutine orbit_rate(self, time, state, rate, status)
      !> The journal
      class(orbit_problem_t), intent(in) :: self
      !> Angle of the shaft [rad]
      real(wp), intent(in) :: time
      !> Place [clearance]
      real(wp), intent(in) :: state(:)
      !> Velocity [clearance/rad]
      real(wp), intent(out) :: rate(:)
      !> 0 fine, positive: the journal would be outside its bearing, negative: no load can be found
      integer, intent(out) :: status

      ! Load [N]
      real(wp) :: load(2)

      rate = 0.0_wp
      status = 1
      if (.not. norm2(state) < 1.0_wp) return
      call self%load%get_load(time, load, status)
      if (status /= 0) then
         status = -1
         return
      end if
      call journal_velocity(self%journal, state, load, self%rotation, rate, self%touch)
   end subroutine orbit_rate

   !> Angle of the shaft in words.
   function name_orbit_angle(self, time) result(text)
      !> The journal
      class(orbit_problem_t), intent(in) :: self
      !> Angle of the shaft [rad]
      real(wp), intent(in) :: time
      !> It in words
      character(len=words_length) :: text

      text = cam_angle_text(time, 3)//" of a journal's orbit"
      associate (unused => self)
      end associate
   end function name_orbit_angle

end module camroller_journal_orbit
