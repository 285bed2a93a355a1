!> Valve lift as a function of the cam angle: analytic laws and tables, with three derivatives.
!>
!> In: the lift's data from the case. Out: lift and its first three derivatives at any cam angle from full lift, zero outside the
!> event; the angles where a derivative jumps, at which an integrator must stop. Sources: Dudley (1948), SAE Quarterly
!> Transactions 2(1), and Stoddart (1953), Machine Design 25, for the polydyne form; Norton (2009), Cam Design and Manufacturing
!> Handbook, for the rise functions.
module camroller_lift
   use camroller_kinds, only : wp, pi, two_pi
   use camroller_error, only : error_t, raise, kind_deck
   use camroller_names, only : name_length, find_name
   use camroller_number_text, only : integer_text
   use camroller_spline, only : spline_t, evaluate_spline
   use camroller_lift_segments, only : evaluate_segments, new_segments, segments_t
   use camroller_lift_shapes, only : polydyne_shape, power_shape
   use camroller_lift_table, only : fit_event, least_step, new_table_event
   implicit none
   private

   public :: lift_t, lift_law_t, lift_law_names
   public :: law_power, law_polydyne, law_345, law_4567, law_cycloidal, law_segments, law_table
   public :: new_lift_law, given_table, evaluate_lift, is_at_rest, is_tabulated, stop_angles, highest_lift, resolving_angles
   public :: event_ends, largest_exponent

   !> Lift laws that can be chosen by name
   character(len=*), parameter :: lift_law_names(*) = [character(len=name_length) :: &
      "power", "polydyne", "polynomial_345", "polynomial_4567", "cycloidal", "segments", "table"]
   !> Places in `lift_law_names`
   integer, parameter :: law_power = 1, law_polydyne = 2, law_345 = 3, law_4567 = 4, law_cycloidal = 5, law_segments = 6, &
      & law_table = 7

   !> Smallest exponent of `power` with a continuous curvature at the ends of the event
   integer, parameter :: min_power = 3
   !> Largest exponent: with it the lift bends within a 200th of the half angle, a third of a degree, which no cam is ground to
   integer, parameter :: largest_exponent = 200
   !> Exponents of `polydyne` beside the constant and the square
   integer, parameter :: n_polydyne = 4
   !> Even angles of a turn for a lift without close rows, fewest of them from a close row to the next
   integer, parameter :: usual_angles = 720, angles_per_row = 4
   !> Difference of the half angles that counts as none [rad]
   real(wp), parameter :: angle_tolerance = 1.0e-9_wp

   !> What a case says about its lift; angles are cam angles from full lift, in the order of time
   type :: lift_t
      !> One of `lift_law_names`
      character(len=name_length) :: law = "power"
      !> Maximum lift of the valve [m]; analytic laws only
      real(wp) :: max_lift = 0.0_wp
      !> Angle from the start of lift to full lift [rad]; analytic laws only
      real(wp) :: opening_half_angle = 0.0_wp
      !> Angle from full lift to the end of lift [rad]; analytic laws only
      real(wp) :: closing_half_angle = 0.0_wp
      !> `power`: one exponent n of (1 - x^2)^n; `polydyne`: four exponents of x above 2
      integer, allocatable :: exponents(:)
      !> `segments`: cam angles from the start of lift [rad], and the shape of the acceleration at them [any]
      real(wp), allocatable :: segment_angles(:), segment_accelerations(:)
      !> Table: cam angle from full lift [rad], increasing
      real(wp), allocatable :: table_angle(:)
      !> Table: lift of the valve [m]
      real(wp), allocatable :: table_lift(:)
      !> Root mean square distance allowed between a smoothed curve and the table, as it was given [m]; zero interpolates
      real(wp) :: smoothing = 0.0_wp
      !> Table that was given, where the one above was made of its smoothed rows: cam or polar angle from the nose [rad]
      real(wp), allocatable :: given_angle(:)
      !> Its lift of the roller, or height of the cam over its base circle [m]
      real(wp), allocatable :: given_lift(:)
   end type lift_t

   !> A lift law ready for evaluation; read only, so that any number of threads may share it
   type :: lift_law_t
      private
      !> Place in `lift_law_names`
      integer :: law = law_power
      !> Maximum lift [m]
      real(wp) :: max_lift = 0.0_wp
      !> Start and end of the event, start within a turn before the end [rad]
      real(wp) :: first = 0.0_wp, last = 0.0_wp
      !> Half angles of opening and closing [rad]
      real(wp) :: half_angle(2) = 1.0_wp
      !> Exponents of the distance from the nose
      integer :: exponents(0:n_polydyne + 1) = 0
      !> Coefficients of these powers [-]
      real(wp) :: coefficients(0:n_polydyne + 1) = 0.0_wp
      !> Distance of the closest rows of a table; a turn without one [rad]
      real(wp) :: row_step = two_pi
      !> The table, or the segments
      type(spline_t) :: table
      type(segments_t) :: segments
      !> Angles where a derivative up to the third jumps, in [-pi, pi), increasing [rad]
      real(wp), allocatable :: stops(:)
   end type lift_law_t

contains

   !> Make a lift law from what a case says.
   !>
   !> Errors (deck): unknown name; lift or angles not positive; halves that would make the curvature jump; exponents too
   !> small or not increasing; a table that is missing, unsorted, not finite, or does not start and end at zero.
   subroutine new_lift_law(law, lift, error)
      !> The law
      type(lift_law_t), intent(out) :: law
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      call find_name("lift law", lift%law, lift_law_names, law%law, error)
      if (allocated(error)) return
      if (law%law == law_table) then
         call take_table(law, lift, error)
         return
      end if
      if (law%law == law_segments) then
         call take_segments(law, lift, error)
         return
      end if
      call check_event(lift, error)
      if (allocated(error)) return
      law%max_lift = lift%max_lift
      law%half_angle = [lift%opening_half_angle, lift%closing_half_angle]
      law%first = -lift%opening_half_angle
      law%last = lift%closing_half_angle
      select case (law%law)
      case (law_power, law_polydyne)
         call check_symmetry(lift, error)
         if (allocated(error)) return
         call take_exponents(law, lift, error)
         if (allocated(error)) return
      end select
      law%stops = [law%first, law%last]
      if (third_derivative_jumps_at_nose(law)) law%stops = [law%first, 0.0_wp, law%last]
      call wrap_stops(law%stops)
   end subroutine new_lift_law

   !> The table of a lift as it was given: the lift of the valve, or what that was made of.
   pure function given_table(lift) result(given)
      !> A lift by a table
      type(lift_t), intent(in) :: lift
      !> The table for a lift, to be smoothed as given
      type(lift_t) :: given

      given = lift
      if (.not. allocated(lift%given_lift)) return
      given%table_angle = lift%given_angle
      given%table_lift = lift%given_lift
      deallocate (given%given_angle, given%given_lift)
   end function given_table

   !> Lift and its first three derivatives at a cam angle; right-hand values where one jumps.
   pure subroutine evaluate_lift(law, angle, values)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> Cam angle from full lift, any turn [rad]
      real(wp), intent(in) :: angle
      !> Lift and its derivatives [m, m/rad, m/rad^2, m/rad^3]
      real(wp), intent(out) :: values(0:3)

      !> Angle within the turn that begins with the event [rad]
      real(wp) :: local
      !> Distance from the nose as a part of the half angle [-]
      real(wp) :: y
      !> Derivative of y with respect to the angle [1/rad]
      real(wp) :: y_1
      !> Lift over maximum lift and its derivatives with respect to y [-]
      real(wp) :: f(0:3)

      values = 0.0_wp
      local = angle
      if (local < law%first .or. local >= law%first + two_pi) then
         local = local - two_pi*real(floor((local - law%first)/two_pi), wp)
      end if
      if (local >= law%last .and. law%last < law%first + two_pi) return
      if (law%law == law_table) then
         call evaluate_spline(law%table, min(max(local, law%first), law%last), values)
         return
      else if (law%law == law_segments) then
         call evaluate_segments(law%segments, local, values)
         return
      end if
      y_1 = 1.0_wp/law%half_angle(2)
      if (local < 0.0_wp) y_1 = -1.0_wp/law%half_angle(1)
      y = min(local*y_1, 1.0_wp)
      select case (law%law)
      case (law_power)
         call power_shape(law%exponents(0), y, f)
      case (law_polydyne)
         call polydyne_shape(law%exponents, law%coefficients, y, f)
      case default
         call rise_shape(law%law, 1.0_wp - y, f)
         f(1:3:2) = -f(1:3:2)
      end select
      values = law%max_lift*f*[1.0_wp, y_1, y_1**2, y_1**3]
   end subroutine evaluate_lift

   !> Largest lift of a law.
   pure function highest_lift(law) result(lift)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> The lift [m]
      real(wp) :: lift

      lift = law%max_lift
   end function highest_lift

   !> Where the event of a law starts and ends; a turn apart where it has no rest.
   pure function event_ends(law) result(angles)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> Cam angles from full lift [rad]
      real(wp) :: angles(2)

      angles = [law%first, law%last]
   end function event_ends

   !> How many even angles of a turn show the curvature of a lift: with rows of a table closer than a degree, whose noise is in it
   !> from row to row, four for each.
   pure function resolving_angles(law) result(angles)
      !> The law
      type(lift_law_t), intent(in) :: law
      integer :: angles

      ! Angles from a row to the next, with the usual ones [-]
      real(wp) :: per_row

      angles = usual_angles
      per_row = law%row_step*usual_angles/two_pi
      if (per_row < 2.0_wp - angle_tolerance) angles = usual_angles*ceiling(angles_per_row/per_row - angle_tolerance)
   end function resolving_angles

   !> Is the valve closed, with no lift on either side of the angle but at the ends of the event?
   pure function is_at_rest(law, angle) result(at_rest)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> Cam angle from full lift, any turn [rad]
      real(wp), intent(in) :: angle
      !> True from the end of the event to its start
      logical :: at_rest

      at_rest = .false.
      if (law%last < law%first + two_pi) then
         at_rest = angle - two_pi*real(floor((angle - law%first)/two_pi), wp) >= law%last
      end if
   end function is_at_rest

   !> Does the lift come from a table, so that noise may be all of it where it is small?
   pure function is_tabulated(law) result(from_table)
      !> The law
      type(lift_law_t), intent(in) :: law
      logical :: from_table

      from_table = law%law == law_table
   end function is_tabulated

   !> Angles where a derivative of the lift up to the third jumps: ends of the event, and the nose where its halves
   !> differ.
   pure function stop_angles(law) result(angles)
      !> The law
      type(lift_law_t), intent(in) :: law
      !> The angles, in [-pi, pi), increasing [rad]; none for a table without a dwell
      real(wp), allocatable :: angles(:)

      angles = law%stops
   end function stop_angles

   !> Rise from 0 to 1 over u from 0 to 1, with no slope and no curvature at either end.
   pure subroutine rise_shape(law, u, f)
      !> Place in `lift_law_names`
      integer, intent(in) :: law
      !> Part of the half angle since the end of the event [-]
      real(wp), intent(in) :: u
      !> Value and derivatives with respect to u [-]
      real(wp), intent(out) :: f(0:3)

      !> 1 - u [-]
      real(wp) :: w

      w = 1.0_wp - u
      select case (law)
      case (law_345)
         f(0) = u**3*(10.0_wp - u*(15.0_wp - 6.0_wp*u))
         f(1) = 30.0_wp*(u*w)**2
         f(2) = 60.0_wp*u*w*(w - u)
         f(3) = 60.0_wp*(1.0_wp - 6.0_wp*u*w)
      case (law_4567)
         f(0) = u**4*(35.0_wp - u*(84.0_wp - u*(70.0_wp - 20.0_wp*u)))
         f(1) = 140.0_wp*(u*w)**3
         f(2) = 420.0_wp*(u*w)**2*(w - u)
         f(3) = 840.0_wp*u*w*(1.0_wp - 5.0_wp*u*w)
      case default
         f(0) = u - sin(two_pi*u)/two_pi
         f(1) = 2.0_wp*sin(pi*u)**2
         f(2) = two_pi*sin(two_pi*u)
         f(3) = two_pi**2*cos(two_pi*u)
      end select
   end subroutine rise_shape

   !> Whether the third derivative differs on both sides of the nose.
   pure function third_derivative_jumps_at_nose(law) result(it_jumps)
      !> The law, complete but for its stops
      type(lift_law_t), intent(in) :: law
      !> Whether it jumps
      logical :: it_jumps

      select case (law%law)
      case (law_345, law_cycloidal)
         it_jumps = .true.
      case (law_polydyne)
         it_jumps = any(law%exponents == 3)
      case default
         it_jumps = .false.
      end select
   end function third_derivative_jumps_at_nose

   !> Refuse an event that is no event.
   subroutine check_event(lift, error)
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      if (.not. lift%max_lift > 0.0_wp) then
         call raise(error, kind_deck, "lift law '"//trim(lift%law)//"' needs a maximum lift above zero")
      else if (.not. (is_half_angle(lift%opening_half_angle) .and. is_half_angle(lift%closing_half_angle))) then
         call raise(error, kind_deck, "lift law '"//trim(lift%law)// &
            "' needs an opening and a closing half angle above 0 and up to 180 deg")
      end if
   end subroutine check_event

   !> Refuse half angles that differ, for laws with a curvature at the nose.
   subroutine check_symmetry(lift, error)
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      if (abs(lift%opening_half_angle - lift%closing_half_angle) > angle_tolerance) then
         call raise(error, kind_deck, "opening and closing half angle of lift law '"//trim(lift%law)// &
            "' must be equal, or the acceleration would jump at full lift; laws with free half angles are "// &
            "'polynomial_345', 'polynomial_4567', 'cycloidal', 'segments' and 'table'")
      end if
   end subroutine check_symmetry

   !> Whether a number can be a half angle.
   pure function is_half_angle(angle) result(it_is)
      !> The number [rad]
      real(wp), intent(in) :: angle
      !> Whether it can
      logical :: it_is

      it_is = angle > 0.0_wp .and. angle <= pi*(1.0_wp + epsilon(pi))
   end function is_half_angle

   !> Take the exponents of `power` and `polydyne`, and find the coefficients of the latter.
   !>
   !> `polydyne` is `1 + c_2 y^2 + c_p y^p + c_q y^q + c_r y^r + c_s y^s` with value and four derivatives zero at y = 1.
   !> In the exponents e_i these are interpolation conditions, solved by Lagrange's formula: `c_i = -product over j /= i
   !> of e_j/(e_j - e_i)`.
   subroutine take_exponents(law, lift, error)
      type(lift_law_t), intent(inout) :: law
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      integer :: i, j
      integer, allocatable :: given(:)
      character(len=:), allocatable :: too_large

      too_large = "an exponent of a lift law is at most "//integer_text(largest_exponent)//": with a larger one the lift bends "// &
         & "within less than a "//integer_text(largest_exponent)//"th of the half angle"
      allocate (given(0))
      if (allocated(lift%exponents)) given = lift%exponents
      if (law%law == law_power) then
         if (size(given) /= 1) then
            call raise(error, kind_deck, "lift law 'power' needs one exponent")
         else if (given(1) < min_power) then
            call raise(error, kind_deck, "exponent of lift law 'power' must be at least "//integer_text(min_power)//", "// &
               "or the acceleration would jump at the ends of the event")
         else if (given(1) > largest_exponent) then
            call raise(error, kind_deck, too_large)
         else
            law%exponents(0) = given(1)
         end if
         return
      end if
      if (size(given) /= n_polydyne) then
         call raise(error, kind_deck, "lift law 'polydyne' needs four exponents")
         return
      end if
      if (any(given > largest_exponent)) then
         call raise(error, kind_deck, too_large)
         return
      end if
      law%exponents = [0, 2, given]
      if (any(law%exponents(2:) <= law%exponents(1:n_polydyne))) then
         call raise(error, kind_deck, "exponents of lift law 'polydyne' must be above 2 and increase")
         return
      end if
      law%coefficients(0) = 1.0_wp
      do i = 1, n_polydyne + 1
         law%coefficients(i) = -1.0_wp
         do j = 1, n_polydyne + 1
            if (j == i) cycle
            law%coefficients(i) = law%coefficients(i)*real(law%exponents(j), wp) &
               /real(law%exponents(j) - law%exponents(i), wp)
         end do
      end do
   end subroutine take_exponents

   !> Take segments of the acceleration.
   subroutine take_segments(law, lift, error)
      type(lift_law_t), intent(inout) :: law
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      if (.not. lift%max_lift > 0.0_wp) then
         call raise(error, kind_deck, "lift law 'segments' needs a maximum lift above zero")
      else if (.not. (allocated(lift%segment_angles) .and. allocated(lift%segment_accelerations))) then
         call raise(error, kind_deck, "lift law 'segments' needs angles and accelerations")
      else
         call new_segments(law%segments, lift%segment_angles, lift%segment_accelerations, lift%max_lift, error)
      end if
      if (allocated(error)) return
      law%max_lift = lift%max_lift
      law%stops = law%segments%angle
      law%first = law%stops(1)
      law%last = law%stops(size(law%stops))
      call wrap_stops(law%stops)
   end subroutine take_segments

   !> Take a table.
   subroutine take_table(law, lift, error)
      type(lift_law_t), intent(inout) :: law
      !> What the case says
      type(lift_t), intent(in) :: lift
      !> What is wrong
      type(error_t), allocatable, intent(out) :: error

      logical :: is_periodic

      if (.not. (allocated(lift%table_angle) .and. allocated(lift%table_lift))) then
         call raise(error, kind_deck, "lift law 'table' needs a table")
         return
      end if
      if (allocated(lift%given_lift)) then
         call fit_event(law%table, lift%table_angle, lift%table_lift, 0.0_wp, law%first, law%last, is_periodic, error)
      else
         call new_table_event(law%table, lift%table_angle, lift%table_lift, lift%smoothing, &
            law%first, law%last, is_periodic, error)
      end if
      if (allocated(error)) return
      law%max_lift = maxval(lift%table_lift)
      law%row_step = least_step(lift%table_angle, law%first, law%last)
      allocate (law%stops(0))
      if (is_periodic) return
      law%stops = [law%first, law%last]
      call wrap_stops(law%stops)
   end subroutine take_table

   !> Bring angles into [-pi, pi), sort them and drop repeated ones.
   pure subroutine wrap_stops(angles)
      !> The angles [rad]
      real(wp), allocatable, intent(inout) :: angles(:)

      !> The smallest angle left [rad]
      real(wp) :: next
      !> Angles in order [rad]
      real(wp), allocatable :: sorted(:)

      where (angles < -pi .or. angles >= pi) angles = angles - two_pi*floor((angles + pi)/two_pi)
      allocate (sorted(0))
      do while (size(angles) > 0)
         next = minval(angles)
         sorted = [sorted, next]
         angles = pack(angles, angles > next + angle_tolerance)
      end do
      angles = sorted
   end subroutine wrap_stops

end module camroller_lift
