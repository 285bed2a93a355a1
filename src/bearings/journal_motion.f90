!> A journal that moves in its bearing: how fast its film lets it move under a load, and what that takes.
!>
!> In: a bearing at a speed, place of the journal, load vector. Out: velocity of the journal, state of the bearing.
!>
!> Of a journal of negligible mass the load and the film's force are equal and opposite at each instant. Seen from a frame that
!> turns with the mean angular velocity of journal and bearing, half the shaft's, the film is squeezed only, with the velocity `v`,
!> and the force depends on v alone (Booker 1965). Places are in clearances, velocities in clearances per radian of the shaft, loads
!> in `journal_t%unit_load`.
!>
!> Short bearing: the force is `4 (L/D)^2 A v` with `A = int n n^T/h^3` over the half of the bearing where the film is squeezed,
!> `n . v > 0`, n the normal at an angle and `h = 1 - place . n`. It is the gradient of a convex function of v (half the
!> dissipation), and A is its second derivative: the velocity under a given force is unique, and `v <- A^-1 force` is Newton's
!> method. In closed form by the variable of Sommerfeld (1904); the same as Capone (1986), who writes the force over place and
!> velocity. With the journal at rest it is the bearing of Ocvirk (1952).
!>
!> Finite width: the velocity of the short bearing times `1 + k (L/D)^2/(1 - xi)`, with k of its own along the load and across it,
!> the form of the mobilities of Moes (Childs, Moes and van Leeuwen 1977), whose k are constant, 0.472 and 0.278. Here they follow
!> the place of the journal, `xi` along the load and `eta` across it, and L/D: fits to 630 solutions of Reynolds' equation with
!> Reynolds' boundary condition, L/D from 0.1 to 1 and eccentricities to 0.98, which they meet within 12 % in size and 4 degrees in
!> direction (`test/reference/journal_reference.py`).
module camroller_journal_motion
   use camroller_kinds, only : wp, pi
   use camroller_bearing_asperity, only : bearing_state_t, tabulated_forces, bearing_touch_t
   use camroller_journal, only : journal_t, moves_like_finite
   implicit none
   private

   public :: film_velocity, journal_velocity, moving_state, largest_fitted

   !> Eccentricity up to which the velocities of finite width were fitted [-]
   real(wp), parameter :: largest_fitted = 0.98_wp

contains

   !> Velocity with which a load squeezes the film of a bearing.
   pure function film_velocity(journal, place, load) result(velocity)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Place of the journal, below one in size [clearance]
      real(wp), intent(in) :: place(2)
      !> Load of the film [unit load]
      real(wp), intent(in) :: load(2)
      !> Velocity in the frame that turns with half the shaft's speed [clearance/rad]
      real(wp) :: velocity(2)

      ! Eccentricity [-], direction of the line of centres, of the load in its frame [-]
      real(wp) :: e, along(2), direction(2)
      ! Velocity in the frame of the line of centres, in that of the load [clearance/rad]; places along and across the load
      ! [clearance]
      real(wp) :: v(2), parts(2), xi, eta

      velocity = 0.0_wp
      if (.not. norm2(load) > 0.0_wp) return
      call line_of_centres(place, e, along)
      v = in_frame(along, load)/(4.0_wp*journal%width_ratio**2)
      direction = v/norm2(v)
      call solve_short(e, v)
      if (moves_like_finite(journal)) then
         xi = e*direction(1)
         eta = -e*direction(2)
         parts = in_frame(direction, v)*(1.0_wp + width_factors(journal%width_ratio, xi, eta)*journal%width_ratio**2/(1.0_wp - xi))
         v = from_frame(direction, parts)
      end if
      velocity = from_frame(along, v)
   end function film_velocity

   !> Factors k of finite width, along the load and across it.
   pure function width_factors(width_ratio, xi, eta) result(k)
      !> Width over diameter [-]
      real(wp), intent(in) :: width_ratio
      !> Place of the journal along the load and across it [clearance]
      real(wp), intent(in) :: xi, eta
      !> The factors [-]
      real(wp) :: k(2)

      k = [0.50_wp, 0.26_wp] + [0.28_wp, 0.27_wp]*xi + [0.56_wp, 0.27_wp]*eta**2 - [0.25_wp, 0.165_wp]*width_ratio
   end function width_factors

   !> Velocity of a short bearing's journal under a force: Newton's method on its direction, in a bracket, since the direction of
   !> the force turns the same way as that of the velocity and is never a right angle away.
   pure subroutine solve_short(e, vector)
      !> Eccentricity, below one [clearance]
      real(wp), intent(in) :: e
      !> In: force over `4 (L/D)^2 unit_load`, in the frame of the line of centres [-]; out: velocity there [clearance/rad]
      real(wp), intent(inout) :: vector(2)

      ! Change of direction whose square is round-off [rad]
      real(wp), parameter :: last_change = 1.0e-9_wp
      ! Steps at most: as many halvings leave round-off of the bracket
      integer, parameter :: most_steps = 60
      ! Directions [rad], force and integrals with the powers of s = sqrt(1 - e^2) taken out, velocity [-]
      real(wp) :: s, angle, next, low, high, force(2), integrals(3), part(2)
      integer :: step

      s = sqrt((1.0_wp - e)*(1.0_wp + e))
      angle = atan2(vector(2), vector(1))
      low = angle - 0.5_wp*pi
      high = angle + 0.5_wp*pi
      force = vector*[s**4, s**3]
      do step = 1, most_steps
         integrals = half_integrals(e, s, angle)
         part = [integrals(3)*force(1) - integrals(2)*force(2), integrals(1)*force(2) - integrals(2)*force(1)] &
            & /(integrals(1)*integrals(3) - integrals(2)**2)
         part(1) = s*part(1)
         next = angle + turn(angle, part)
         if (next > angle) then
            low = angle
         else
            high = angle
         end if
         if (.not. (next > low .and. next < high)) next = 0.5_wp*(low + high)
         if (abs(next - angle) <= last_change) exit
         angle = next
      end do
      vector = part
   end subroutine solve_short

   !> Angle from a direction to that of a vector, from -pi to pi.
   pure function turn(angle, vector)
      !> The direction [rad]
      real(wp), intent(in) :: angle
      !> The vector [any]
      real(wp), intent(in) :: vector(2)
      !> The angle [rad]
      real(wp) :: turn

      turn = atan2(cos(angle)*vector(2) - sin(angle)*vector(1), cos(angle)*vector(1) + sin(angle)*vector(2))
   end function turn

   !> Integrals of `cos^2`, `sin cos` and `sin^2` over `h^3`, `h = 1 - e cos`, over half a turn about a direction, times the fifth,
   !> fourth and third power of s: polynomials of Sommerfeld's angle psi, `cos psi = (cos - e)/h`, `sin psi = s sin/h`.
   pure function half_integrals(e, s, angle) result(integrals)
      !> Eccentricity, below one; sqrt(1 - e^2) [-]
      real(wp), intent(in) :: e, s
      !> The direction, from the line of centres [rad]
      real(wp), intent(in) :: angle
      !> The integrals [-]
      real(wp) :: integrals(3)

      ! Middle of the range of psi and half its width [rad]
      real(wp) :: first, last, middle, half
      ! Integral of cos 2 psi over two [-]
      real(wp) :: double

      first = atan2(-s*cos(angle), sin(angle) - e)
      last = atan2(s*cos(angle), -sin(angle) - e)
      if (last <= first) last = last + 2.0_wp*pi
      middle = 0.5_wp*(first + last)
      half = 0.5_wp*(last - first)
      double = 0.5_wp*sin(2.0_wp*half)*cos(2.0_wp*middle)
      integrals(1) = half + double + 2.0_wp*e*(2.0_wp*cos(middle)*sin(half) + e*half)
      integrals(2) = sin(middle)*sin(half)*(2.0_wp*cos(middle)*cos(half) + 2.0_wp*e)
      integrals(3) = half - double
   end function half_integrals

   !> Velocity of a journal under a load that film and asperities carry.
   pure subroutine journal_velocity(journal, place, load, rotation, velocity, touch)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Place of the journal in the bearing, below one in size [clearance]
      real(wp), intent(in) :: place(2)
      !> Force of the shaft on the bearing [N]
      real(wp), intent(in) :: load(2)
      !> Sense in which the shaft turns, 1 from the first axis to the second, or -1 [-]
      real(wp), intent(in) :: rotation
      !> Velocity [clearance/rad]
      real(wp), intent(out) :: velocity(2)
      !> Its surfaces; without them there is a film only
      type(bearing_touch_t), intent(in), optional :: touch

      ! Load of the film [N], of asperities along the line of centres, sum of their normal forces [N]
      real(wp) :: film(2), along, normal

      call share_moving(journal, place, load, film, along, normal, touch)
      velocity = film_velocity(journal, place, film/journal%unit_load) + 0.5_wp*rotation*[-place(2), place(1)]
   end subroutine journal_velocity

   !> State of a bearing whose journal moves.
   !>
   !> The torque is the power that film and asperities turn into heat over the speed: shear of the film, which is Petroff's over
   !> `sqrt(1 - e^2)`, the work of the film's load on the squeezed film, and boundary friction. With the journal at rest the second
   !> part is the half moment of the load.
   pure subroutine moving_state(journal, place, load, state, touch)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Place of the journal, below one in size [clearance]
      real(wp), intent(in) :: place(2)
      !> Force of the shaft on the bearing [N]
      real(wp), intent(in) :: load(2)
      !> Its state
      type(bearing_state_t), intent(out) :: state
      !> Its surfaces; without them there is a film only
      type(bearing_touch_t), intent(in), optional :: touch

      ! Load of the film [N], sum of normal forces of asperities [N]; radial clearance [m]
      real(wp) :: film(2), normal, clearance

      clearance = journal%clearance_ratio*journal%radius
      call share_moving(journal, place, load, film, state%asperity_load, normal, touch)
      state%load = load
      state%place = place
      state%eccentricity = norm2(place)
      state%film = clearance*(1.0_wp - state%eccentricity)
      state%torque = journal%petroff_friction*journal%radius/sqrt((1.0_wp - state%eccentricity)*(1.0_wp + state%eccentricity)) &
         & + clearance*dot_product(film, film_velocity(journal, place, film/journal%unit_load))
      if (.not. present(touch)) return
      state%boundary_torque = touch%boundary_coefficient*normal*journal%radius
      state%torque = state%torque + state%boundary_torque
   end subroutine moving_state

   !> What film and asperities carry of a load.
   pure subroutine share_moving(journal, place, load, film, along, normal, touch)
      !> The bearing
      type(journal_t), intent(in) :: journal
      !> Place of the journal, below one in size [clearance]
      real(wp), intent(in) :: place(2)
      !> Force of the shaft on the bearing [N]
      real(wp), intent(in) :: load(2)
      !> Load of the film; of asperities, along the line of centres; sum of their normal forces [N]
      real(wp), intent(out) :: film(2), along, normal
      !> Its surfaces; without them there is a film only
      type(bearing_touch_t), intent(in), optional :: touch

      ! Eccentricity [-], direction of the line of centres [-]
      real(wp) :: e, direction(2)
      ! Slopes of the loads of asperities [N]
      real(wp) :: unused(2)

      film = load
      along = 0.0_wp
      normal = 0.0_wp
      if (.not. present(touch)) return
      call line_of_centres(place, e, direction)
      call tabulated_forces(journal, touch, e/sqrt((1.0_wp - e)*(1.0_wp + e)), along, normal, unused(1), unused(2))
      film = load - along*direction
   end subroutine share_moving

   !> Line of centres; the first axis where there is none.
   pure subroutine line_of_centres(place, e, along)
      !> Place of the journal [clearance]
      real(wp), intent(in) :: place(2)
      !> Eccentricity [clearance], direction of the line [-]
      real(wp), intent(out) :: e, along(2)

      e = norm2(place)
      along = [1.0_wp, 0.0_wp]
      if (e > tiny(1.0_wp)) along = place/e
   end subroutine line_of_centres

   !> Vector in a frame.
   pure function in_frame(along, vector) result(parts)
      !> First axis of the frame [-]
      real(wp), intent(in) :: along(2)
      !> The vector [any]
      real(wp), intent(in) :: vector(2)
      !> Its parts along the axis and across it [any]
      real(wp) :: parts(2)

      parts = [along(1)*vector(1) + along(2)*vector(2), along(1)*vector(2) - along(2)*vector(1)]
   end function in_frame

   !> Vector from its parts in a frame.
   pure function from_frame(along, parts) result(vector)
      !> First axis of the frame [-]
      real(wp), intent(in) :: along(2)
      !> Parts along the axis and across it [any]
      real(wp), intent(in) :: parts(2)
      !> The vector [any]
      real(wp) :: vector(2)

      vector = [along(1)*parts(1) - along(2)*parts(2), along(2)*parts(1) + along(1)*parts(2)]
   end function from_frame

end module camroller_journal_motion
